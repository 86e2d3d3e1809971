//! The pieces of the window, and the matrices with which each of them is searched.
//!
//! | file | what |
//! |---|---|
//! | [`prepared`] | the division of the window into pieces |
//! | [`view`], [`expansion`] | the pencil on the complementarity variables, enclosed |
//! | [`condense`] | elimination of the free variables, with its evidence |
//! | [`anchor`], [`precise_anchor`], [`reverse`] | the elimination about one value |
//! | [`blocks`], [`skyline`], [`massless`], [`matrix`] | linear algebra in doubles |

pub(super) mod anchor;
pub(super) mod blocks;
pub(super) mod condense;
pub(super) mod expansion;
pub(super) mod massless;
pub(super) mod matrix;
pub(super) mod precise_anchor;
pub(super) mod prepared;
pub(super) mod reverse;
pub(super) mod skyline;
pub(super) mod view;
