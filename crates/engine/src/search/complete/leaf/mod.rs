//! One file per kind of leaf.

pub(crate) mod farkas;
pub(crate) mod infinity;
pub(crate) mod ldl;
pub(crate) mod root;
pub(crate) mod support;
