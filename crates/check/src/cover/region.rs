//! Regions: an interval of the unknown and what is known of the support.

use super::budget::WorkBudget;
use super::ends::Ends;
use super::fault::CoverFault;
use super::short::Short;
use mceip_exact::Rational;
use std::cell::{Cell, RefCell};
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
    /// Regions share their ends: a cut may be a long number, and many regions may be pending.
    pub(super) lo: Rc<Rational>,
    pub(super) hi: Option<Rc<Rational>>,
    /// One per complementarity variable, ascending.
    pub(super) states: Vec<State>,
    pub(super) matrices: Rc<Matrices>,
}

impl Region {
    /// The values up to a cut and those from it on.
    pub(super) fn split(self, at: &Rational) -> Result<[Region; 2], CoverFault> {
        let is_above_lo = at > self.lo.as_ref();
        let is_below_hi = self.hi.as_deref().is_none_or(|hi| at < hi);
        if !is_above_lo || !is_below_hi {
            return Err(CoverFault::Cut {
                lo: Rational::clone(&self.lo),
                hi: end(self.hi.as_deref()),
                got: at.clone(),
            });
        }

        self.matrices.forget();
        let cut = Rc::new(at.clone());
        let upper = Region {
            lo: Rc::clone(&cut),
            hi: self.hi,
            states: self.states.clone(),
            matrices: Rc::default(),
        };
        let lower = Region {
            lo: self.lo,
            hi: Some(cut),
            states: self.states,
            matrices: Rc::default(),
        };
        Ok([lower, upper])
    }

    /// x_i = 0 and x_i > 0 for the undecided variable i of the problem; `indices` are those of the
    /// complementarity variables. Where i is one half of v_T of a particle with zero reaction and
    /// moves, the other half is at rest: a motion has at most one of them
    /// (`spec/zero-reaction.md`, Z.3).
    pub(super) fn branch(
        self,
        index: usize,
        indices: &[usize],
        other_half: Option<usize>,
    ) -> Result<[Region; 2], CoverFault> {
        let position = indices.iter().position(|&i| i == index);
        let position = position
            .filter(|&p| self.states[p] == State::Undecided)
            .ok_or(CoverFault::Branch { index })?;

        let mut at_zero = self.states.clone();
        at_zero[position] = State::AtZero;
        let mut in_support = self.states;
        in_support[position] = State::InSupport;

        let other = indices.iter().position(|&i| Some(i) == other_half);
        if let Some(other) = other {
            in_support[other] = State::AtZero;
        }

        Ok([at_zero, in_support].map(|states| Region {
            lo: Rc::clone(&self.lo),
            hi: self.hi.clone(),
            states,
            matrices: Rc::clone(&self.matrices),
        }))
    }

    /// The same region.
    pub(super) fn same(&self) -> Region {
        Region {
            lo: Rc::clone(&self.lo),
            hi: self.hi.clone(),
            states: self.states.clone(),
            matrices: Rc::clone(&self.matrices),
        }
    }

    /// Demands that the region lies above the value from which on the condensation's tail excludes
    /// solutions.
    pub(super) fn is_in_tail(&self, tail: Option<&Rational>) -> Result<(), CoverFault> {
        match tail {
            Some(from) if from <= self.lo.as_ref() => Ok(()),
            _ => Err(CoverFault::Hypothesis {
                expected: "a tail that begins at or below the region",
                row: 0,
            }),
        }
    }

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
    is_counted: Cell<bool>,
}

impl Matrices {
    /// Takes the work of the long numbers from a budget, once until they are forgotten, whether the
    /// long numbers are needed or the short ones do: what a file may cost does not depend on that.
    pub(super) fn count(&self, budget: &WorkBudget, work: u64) -> Result<(), CoverFault> {
        if !self.is_counted.replace(true) {
            budget.spend(work)?;
        }

        Ok(())
    }

    /// The long numbers, computed where they are not yet known.
    pub(super) fn ends(
        &self,
        compute: impl FnOnce() -> Result<Ends, CoverFault>,
    ) -> Result<Rc<Ends>, CoverFault> {
        if let Some(ends) = &*self.exact.borrow() {
            return Ok(Rc::clone(ends));
        }

        let ends = Rc::new(compute()?);
        self.exact.replace(Some(Rc::clone(&ends)));
        Ok(ends)
    }

    /// The short numbers, computed where they are not yet known.
    pub(super) fn short(
        &self,
        compute: impl FnOnce() -> Option<[Short; 2]>,
    ) -> Option<Rc<[Short; 2]>> {
        if let Some(known) = &*self.short.borrow() {
            return known.clone();
        }

        let short = compute().map(Rc::new);
        self.short.replace(Some(short.clone()));
        short
    }

    /// Frees the memory. A region that is split needs its matrices no more, and its siblings
    /// compute them again, so that a deep tree of splits holds the matrices of one interval.
    pub(super) fn forget(&self) {
        self.exact.take();
        self.short.take();
        self.is_counted.set(false);
    }
}

/// An upper end as messages say it.
pub(super) fn end(max: Option<&Rational>) -> String {
    match max {
        Some(max) => max.to_string(),
        None => "infinity".into(),
    }
}
