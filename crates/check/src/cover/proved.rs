//! What a cover proves, as data.

use crate::AcceptedClaim;
use mceip_exact::{Interval, Rational};

/// What a cover has proved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedCover {
    /// Every solution outside the open regions: exactly one per entry, by value and support.
    pub solutions: Vec<AcceptedClaim>,
    /// Every support that has more than isolated single solutions outside the open regions, and
    /// where.
    pub families: Vec<SolutionFamily>,
    /// Where nothing is proved; empty for a complete set.
    pub open: Vec<OpenRegion>,
    /// Leaves checked.
    pub leaves: usize,
}

impl AcceptedCover {
    /// Is there no solution at all in the window, families included?
    pub fn proves_absence(&self) -> bool {
        self.solutions.is_empty() && self.is_plain_list()
    }

    /// Is `solutions` everything there is: nothing open, and no families beside it?
    pub fn is_plain_list(&self) -> bool {
        self.families.is_empty() && self.open.is_empty()
    }
}

/// Solutions of one support that no list holds: a cone of them at one value, or some at every value
/// of an interval. There is at least one at each value named; they are all x with x_i > 0 on the
/// support that solve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SolutionFamily {
    /// Complementarity variables with x_i > 0.
    pub support: Vec<usize>,
    /// Encloses the value, or the lower end of the open interval of values.
    pub from: Interval,
    /// Encloses the upper end, the same as `from` for a single value; `None` for infinity.
    pub to: Option<Interval>,
    /// One value only?
    pub is_point: bool,
    /// Is there only one solution at each value, up to its factor?
    pub is_alone: bool,
}

/// A part of (supports) x (window) that the cover leaves open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OpenRegion {
    /// Lower end of the interval.
    pub min: Rational,
    /// Upper end, `None` for infinity.
    pub max: Option<Rational>,
    /// Variables known to be in the support: x_i > 0.
    pub moving: Vec<usize>,
    /// Variables not decided.
    pub undecided: Vec<usize>,
}

/// A solution claim that has been accepted, with its biactive set.
pub(crate) struct AcceptedSolution<'a> {
    pub(crate) claim: AcceptedClaim,
    pub(crate) biactive: &'a [usize],
}

/// A solution in a leaf, the only one of its support with a value in `hull`.
pub(super) struct LeafSolution {
    pub(super) solution: AcceptedClaim,
    pub(super) hull: Interval,
}
