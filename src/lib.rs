//! mceip
pub mod certificate;
pub mod check;
pub mod exact;
pub mod model;
pub mod oracle;
pub mod reduction;
pub mod source;
