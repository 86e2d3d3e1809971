//! mceip
pub mod exact;
