//! mceip
pub mod exact;
pub mod model;
