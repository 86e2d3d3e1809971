//! What the enumerator finds in a window: solutions, cones, ranges, and what it met on the way.
//!
//! An [`Enumeration`] is filled in two steps: `plain` names what it meets (kernels of more than one
//! dimension, singular supports), `describe` says what these hold.

use super::degenerate::{Cone, SupportRange, Undescribed};
use super::solution::{Solution, equal_values};
use mceip_exact::Algebraic;

/// A support and value whose kernel has more than one dimension, as met; [`Enumeration::cones`] and
/// [`Enumeration::solutions`] say what it holds.
#[derive(Debug, Clone)]
pub struct WideKernel {
    /// The value.
    pub value: Algebraic,
    /// The complementarity variables assumed to slip.
    pub support: Vec<usize>,
    /// Dimension of the kernel.
    pub dimension: usize,
}

/// Everything the enumerator found in the window, in canonical order: by value, then by slip set.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    /// Solutions that are the only ones with their value and support.
    pub solutions: Vec<Solution>,
    /// Maximal cones of dimension > 1.
    pub cones: Vec<Cone>,
    /// Supports that have a solution for whole intervals of values, by support.
    pub ranges: Vec<SupportRange>,
    /// Singular supports left undescribed, by support.
    pub undescribed: Vec<Undescribed>,
    /// Kernels of dimension > 1 that were met.
    pub wide: Vec<WideKernel>,
    /// Supports whose pencil is singular: every t is an eigenvalue of them.
    pub continua: Vec<Vec<usize>>,
    /// Supports examined.
    pub supports_done: u64,
    /// Supports there are: 2^n_s.
    pub supports_total: u64,
    /// How many of `wide` and of `continua` have been described.
    pub described: (usize, usize),
}

impl Enumeration {
    /// Were all supports examined?
    pub fn is_finished(&self) -> bool {
        self.supports_done == self.supports_total
    }

    /// Is this the complete answer: all supports examined, and everything met described?
    pub fn is_complete_list(&self) -> bool {
        self.is_finished()
            && self.described == (self.wide.len(), self.continua.len())
            && self.undescribed.is_empty()
    }

    /// Is nothing listed?
    pub fn is_empty(&self) -> bool {
        self.solutions.is_empty() && self.cones.is_empty() && self.ranges.is_empty()
    }

    /// Is the answer a plain list: nothing but `solutions`?
    pub fn is_plain_list(&self) -> bool {
        let has_families = !self.cones.is_empty() || !self.ranges.is_empty();
        self.is_complete_list() && !has_families
    }

    /// Is there a solution with x_s = 0, which Propositions 1 and 2 exclude by their hypotheses?
    pub fn is_outside_propositions(&self) -> bool {
        self.solutions.iter().any(Solution::is_free_only)
            || self
                .cones
                .iter()
                .any(|cone| cone.slip.is_empty() || !cone.lineality.is_empty())
            || self.ranges.iter().any(|range| range.support.is_empty())
    }

    /// Dimension of the kernel that a listed solution comes from: 1 unless it was met as a wide
    /// kernel.
    pub fn kernel_dimension(&self, solution: &Solution) -> usize {
        self.wide
            .iter()
            .find(|kernel| {
                kernel.support == solution.slip && equal_values(&kernel.value, &solution.value)
            })
            .map_or(1, |kernel| kernel.dimension)
    }
}
