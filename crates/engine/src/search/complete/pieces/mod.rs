//! The pieces of the window, and the matrices with which each of them is searched.
//!
//! | file | what |
//! |---|---|
//! | [`prepared`] | the division of the window into pieces |
//! | [`view`], [`expansion`] | the pencil on the complementarity variables, enclosed |
//! | [`condense`] | elimination of the free variables, with its evidence |
//! | [`anchor`], [`precise_anchor`], [`reverse`] | the elimination about one value |
//! | [`wide`] | anchors of wide reach, where sym(T) is definite |
//! | [`blocks`], [`skyline`], [`massless`], [`matrix`] | linear algebra in doubles |

pub(crate) mod anchor;
pub(crate) mod blocks;
pub(crate) mod condense;
pub(crate) mod expansion;
pub(crate) mod massless;
pub(crate) mod matrix;
pub(crate) mod precise_anchor;
pub(crate) mod prepared;
pub(crate) mod reverse;
pub(crate) mod skyline;
pub(crate) mod view;
pub(crate) mod wide;
