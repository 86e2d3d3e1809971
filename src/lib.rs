//! mceip
#[cfg(feature = "solver")]
pub mod candidate;
pub mod certificate;
#[cfg(feature = "solver")]
pub mod certify;
pub mod check;
pub mod exact;
#[cfg(feature = "solver")]
pub mod linear;
pub mod model;
pub mod oracle;
pub mod reduction;
pub mod source;
#[cfg(feature = "solver")]
pub mod tolerance;
