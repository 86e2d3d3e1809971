//! Complete answers beyond the oracle's reach: fast, untrusted, each discard proved.

pub mod screen;
