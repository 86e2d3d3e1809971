//! What a curve is followed by and what it leaves: the sense at its start, the solutions it met
//! and why it ended. Data only; `continuation` fills it.

use super::super::outcome::Counters;

/// Which way a curve is followed at first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sense {
    /// s decreases.
    Down,
    /// s increases.
    Up,
}

/// Why a curve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum CurveEnd {
    /// The number of solutions asked for.
    Enough,
    /// z or s has left every bounded region.
    Ray,
    /// The limit on steps.
    StepLimit,
    /// Back at its start or at a solution it has met before: the curve is closed.
    Closed,
    /// No step is short enough: a bifurcation, a degenerate corner, or F not finite.
    Stuck,
}

/// What a curve met.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Points with s = 0, in order; within the bounds.
    pub solutions: Vec<Vec<f64>>,
    /// Why it ended.
    pub end: CurveEnd,
    /// The work done.
    pub counters: Counters,
}
