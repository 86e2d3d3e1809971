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
    /// What the cover of a reflected pencil (A, -B) has proved of (A, B): values change their sign.
    pub(crate) fn reflected(self) -> AcceptedCover {
        let solutions = self.solutions.into_iter().map(AcceptedClaim::reflected);
        let families = self.families.into_iter().map(|family| SolutionFamily {
            from: family.to.as_ref().map(Interval::negated),
            to: family.from.as_ref().map(Interval::negated),
            ..family
        });
        let open = self.open.into_iter().map(|region| OpenRegion {
            min: region.max.map(|max| -max),
            max: region.min.map(|min| -min),
            ..region
        });

        AcceptedCover {
            solutions: solutions.collect(),
            families: families.collect(),
            open: open.collect(),
            leaves: self.leaves,
        }
    }

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
    /// Encloses the value, or the lower end of the open interval of values; `None` for -infinity.
    pub from: Option<Interval>,
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
    /// Lower end of the interval, `None` for -infinity.
    pub min: Option<Rational>,
    /// Upper end, `None` for infinity.
    pub max: Option<Rational>,
    /// Variables known to be in the support: x_i > 0.
    pub moving: Vec<usize>,
    /// Variables not decided.
    pub undecided: Vec<usize>,
}

impl AcceptedClaim {
    /// The same solution as one of the reflected pencil.
    pub fn reflected(self) -> AcceptedClaim {
        AcceptedClaim {
            value: self.value.negated(),
            ..self
        }
    }
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
