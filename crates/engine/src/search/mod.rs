//! Complete answers beyond the oracle's reach: floats propose, each discard and each claim is
//! proved.

pub mod complete;
pub mod levels;
pub mod near;
