//! A claimed solution in doubles, untrusted: what solvers and reports hand to `certify`.

use mceip_check::backward_error;
use mceip_exact::{Rational, from_f64};
use mceip_model::{Problem, ZeroVariables};

/// The format of solution reports.
pub const SOLUTIONS_FORMAT: &str = "mceip-solutions/1";

/// Digits of a backward error that are printed, the last one rounded up.
pub const BACKWARD_ERROR_DIGITS: usize = 2;

/// A claimed solution: a value of the unknown and x over the variables of the pencil.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The value of lambda^2 or mu.
    pub value: f64,
    /// x, in any positive scale.
    pub x: Vec<f64>,
}

impl Candidate {
    /// The backward error of these numbers, found by the checker: [`mceip_check::backward_error`].
    ///
    /// # Errors
    /// The checker's refusal, or the number that is not finite.
    pub fn backward_error(&self, problem: &Problem) -> Result<Rational, String> {
        let value = from_f64(self.value).map_err(|e| e.to_string())?;
        let mut x = Vec::with_capacity(self.x.len());
        for component in &self.x {
            x.push(from_f64(*component).map_err(|e| e.to_string())?);
        }

        backward_error(problem, &value, &x).map_err(|rejected| rejected.to_string())
    }

    /// The same motion, with at most one of v+ and v- positive at each particle in contact with
    /// zero reaction: both less the lesser one.
    pub fn one_sided(&self, zero: &[ZeroVariables]) -> Candidate {
        let mut candidate = self.clone();
        for variables in zero {
            let ZeroVariables { right, left, .. } = *variables;
            let to_right = self.x.get(right).copied().unwrap_or_default();
            let to_left = self.x.get(left).copied().unwrap_or_default();
            let common = to_right.min(to_left);
            if common > 0.0 {
                candidate.x[right] -= common;
                candidate.x[left] -= common;
            }
        }

        candidate
    }
}
