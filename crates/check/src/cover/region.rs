//! Regions: an interval of the unknown and what is known of the support.

use super::ends::Ends;
use super::short::Short;
use mceip_exact::Rational;
use std::cell::RefCell;
use std::rc::Rc;

/// What is known of a complementarity variable in a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Undecided,
    /// x_i = 0.
    AtZero,
    /// x_i > 0, y_i = 0.
    InSupport,
}

/// The part of (supports) x (window) that belongs to a node: values in [lo, hi] and the supports
/// that its states allow. `None` stands for infinity.
pub(super) struct Region {
    pub(super) lo: Rational,
    pub(super) hi: Option<Rational>,
    /// One per complementarity variable, ascending.
    pub(super) states: Vec<State>,
    pub(super) matrices: Rc<Matrices>,
}

impl Region {
    /// Positions of the variables that are in the support.
    pub(super) fn support(&self) -> Vec<usize> {
        self.positions(|state| state == State::InSupport)
    }

    /// Positions of the variables that are or may be in the support.
    pub(super) fn possible_support(&self) -> Vec<usize> {
        self.positions(|state| state != State::AtZero)
    }

    pub(super) fn is_decided(&self) -> bool {
        !self.states.contains(&State::Undecided)
    }

    pub(super) fn positions(&self, holds: impl Fn(State) -> bool) -> Vec<usize> {
        (0..self.states.len())
            .filter(|&i| holds(self.states[i]))
            .collect()
    }
}

/// The matrices at the ends of an interval, computed when they are asked for. Regions of one
/// interval share them.
#[derive(Default)]
pub(super) struct Matrices {
    pub(super) exact: RefCell<Option<Rc<Ends>>>,
    /// `Some(None)`: there are no short numbers for them.
    pub(super) short: RefCell<Option<Option<Rc<[Short; 2]>>>>,
}

impl Matrices {
    /// Frees the memory. A region that is split needs its matrices no more, and its siblings
    /// compute them again, so that a deep tree of splits holds the matrices of one interval.
    pub(super) fn forget(&self) {
        self.exact.take();
        self.short.take();
    }
}
