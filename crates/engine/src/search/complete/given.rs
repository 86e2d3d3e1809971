//! The problem as every stage of a search has it.

use crate::candidate::Candidate;
use crate::certify::Certifier;
use mceip_check::certificate::Claim;
use mceip_exact::Rational;
use mceip_model::{Pencil, Problem, Window};

/// The problem, its pencil, and the certifier of single solutions.
pub(crate) struct Given<'a> {
    pub(crate) problem: &'a Problem,
    /// The reduced pencil of the problem.
    pub(crate) pencil: &'a Pencil,
    certifier: Certifier<'a>,
}

impl<'a> Given<'a> {
    pub(crate) fn new(problem: &'a Problem, pencil: &'a Pencil) -> Given<'a> {
        Given {
            problem,
            pencil,
            certifier: Certifier::new(problem, pencil),
        }
    }

    pub(crate) fn window(&self) -> &'a Window {
        self.problem.window()
    }

    /// Does the window contain [lo, hi]?
    pub(crate) fn has_in_window(&self, interval: &[Rational; 2]) -> bool {
        let [lo, hi] = interval;
        let window = self.window();
        if lo < window.min() {
            return false;
        }

        match window.max() {
            Some(max) => hi <= max,
            None => true,
        }
    }

    /// An exact solution near a value and an x over the complementarity variables, where doubles
    /// cannot tell. Only for pencils without free variables.
    pub(crate) fn certify(&self, value: f64, x: Vec<f64>) -> Option<Claim> {
        if !self.pencil.free().is_empty() {
            return None;
        }

        self.certifier.certify(&Candidate { value, x }).ok()
    }
}
