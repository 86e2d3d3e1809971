//! Regions: intervals of the unknown and of the friction, and what is known of the support.

use super::budget::WorkBudget;
use super::ends::Ends;
use super::fault::CoverFault;
use crate::certificate::VariableState;
use mceip_exact::Rational;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The part of (supports) x (window) that belongs to a node: values in [lo, hi], of a tree that
/// covers frictions as well those in `friction`, and the supports that its states allow. `None` as
/// the upper end stands for infinity.
///
/// Regions share their ends: a cut may be a long number, and many regions may be pending.
#[derive(Clone)]
pub(super) struct Region {
    pub(super) lo: Rc<Rational>,
    pub(super) hi: Option<Rc<Rational>>,
    pub(super) friction: Option<[Rc<Rational>; 2]>,
    /// One per complementarity variable, ascending.
    pub(super) states: Vec<VariableState>,
    /// The matrices over [lo, hi]: of T, or of T0 and of T1 where T = T0 + mu T1.
    pub(super) parts: Rc<[Matrices; 2]>,
    /// The matrices T0 + mu T1 at both ends of the interval of friction.
    pub(super) boxed: Rc<Matrices>,
}

impl Region {
    /// A region of these intervals with nothing decided.
    pub(super) fn new(
        lo: Rc<Rational>,
        hi: Option<Rc<Rational>>,
        friction: Option<[Rc<Rational>; 2]>,
        variables: usize,
    ) -> Region {
        Region {
            lo,
            hi,
            friction,
            states: vec![VariableState::Undecided; variables],
            parts: Rc::default(),
            boxed: Rc::default(),
        }
    }

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

        self.parts.iter().for_each(Matrices::forget);
        self.boxed.forget();
        let cut = Rc::new(at.clone());
        let lower = Region {
            hi: Some(Rc::clone(&cut)),
            parts: Rc::default(),
            boxed: Rc::default(),
            ..self.clone()
        };
        let upper = Region {
            lo: cut,
            parts: Rc::default(),
            boxed: Rc::default(),
            ..self
        };
        Ok([lower, upper])
    }

    /// The frictions up to a cut and those from it on.
    pub(super) fn split_friction(self, at: &Rational) -> Result<[Region; 2], CoverFault> {
        let Some([lower, higher]) = &self.friction else {
            return Err(CoverFault::Kind { kind: "friction" });
        };
        if at <= lower.as_ref() || at >= higher.as_ref() {
            return Err(CoverFault::FrictionCut {
                lower: Rational::clone(lower),
                higher: Rational::clone(higher),
                got: at.clone(),
            });
        }

        self.boxed.forget();
        let cut = Rc::new(at.clone());
        let halves = [
            [Rc::clone(lower), Rc::clone(&cut)],
            [cut, Rc::clone(higher)],
        ];
        Ok(halves.map(|friction| Region {
            friction: Some(friction),
            boxed: Rc::default(),
            ..self.clone()
        }))
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
            .filter(|&p| self.states[p] == VariableState::Undecided)
            .ok_or(CoverFault::Branch { index })?;

        let mut at_zero = self.clone();
        at_zero.states[position] = VariableState::AtZero;
        let mut in_support = self;
        in_support.states[position] = VariableState::InSupport;

        let other = indices.iter().position(|&i| Some(i) == other_half);
        if let Some(other) = other {
            in_support.states[other] = VariableState::AtZero;
        }

        Ok([at_zero, in_support])
    }

    /// Positions of the variables that are in the support.
    pub(super) fn support(&self) -> Vec<usize> {
        self.positions(|state| state == VariableState::InSupport)
    }

    /// Positions of the variables that are or may be in the support.
    pub(super) fn possible_support(&self) -> Vec<usize> {
        self.positions(|state| state != VariableState::AtZero)
    }

    pub(super) fn is_decided(&self) -> bool {
        !self.states.contains(&VariableState::Undecided)
    }

    pub(super) fn positions(&self, holds: impl Fn(VariableState) -> bool) -> Vec<usize> {
        (0..self.states.len())
            .filter(|&i| holds(self.states[i]))
            .collect()
    }
}

/// The matrices at the ends of intervals, computed when they are asked for, and shared by all
/// regions of these intervals: both ends of the interval of values, at each friction that is an
/// end.
#[derive(Default)]
pub(super) struct Matrices {
    ends: RefCell<Option<Rc<[Ends]>>>,
    is_counted: Cell<bool>,
}

impl Matrices {
    /// Takes the work of the matrices from a budget, once until they are forgotten.
    pub(super) fn count(&self, budget: &WorkBudget, work: u64) -> Result<(), CoverFault> {
        if !self.is_counted.replace(true) {
            budget.spend(work)?;
        }

        Ok(())
    }

    /// The matrices, computed where they are not yet known.
    pub(super) fn ends(
        &self,
        compute: impl FnOnce() -> Result<Rc<[Ends]>, CoverFault>,
    ) -> Result<Rc<[Ends]>, CoverFault> {
        if let Some(ends) = &*self.ends.borrow() {
            return Ok(Rc::clone(ends));
        }

        let ends = compute()?;
        self.ends.replace(Some(Rc::clone(&ends)));
        Ok(ends)
    }

    /// Frees the memory. A region that is split needs its matrices no more, and its siblings
    /// compute them again, so that a deep tree of splits holds the matrices of one interval.
    fn forget(&self) {
        self.ends.take();
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
