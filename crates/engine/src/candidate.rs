//! A claimed solution in doubles, untrusted: what solvers and reports hand to `certify`.

use mceip_model::ZeroVariables;

/// The format of solution reports.
pub const SOLUTIONS_FORMAT: &str = "mceip-solutions/1";

/// A claimed solution: a value of the unknown and x over the variables of the pencil.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The value of lambda^2 or mu.
    pub value: f64,
    /// x, in any positive scale.
    pub x: Vec<f64>,
}

impl Candidate {
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
