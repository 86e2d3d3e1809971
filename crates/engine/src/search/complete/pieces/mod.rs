//! The pieces of the window, and the matrices of each.

pub(crate) mod anchor;
pub(crate) mod blocks;
pub(crate) mod condense;
pub(crate) mod massless;
pub(crate) mod precise_anchor;
pub(crate) mod prepared;
pub(crate) mod reverse;
pub(crate) mod skyline;
pub(crate) mod view;
