//! Is a rational point a solution? Exact: it multiplies and compares.

use super::ExactMcp;
use crate::exact::Rational;
use num_traits::Signed;

/// The first line of the definition that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Violated {
    /// The point has the wrong length.
    #[error("expected {expected} components, got {got}")]
    Length {
        /// Unknowns of the problem.
        expected: usize,
        /// Components given.
        got: usize,
    },
    /// z_i is outside its bounds.
    #[error("z[{index}]: expected between its bounds, got {got}")]
    Bounds {
        /// The unknown.
        index: usize,
        /// Its value.
        got: Rational,
    },
    /// F_i has the wrong sign for where z_i stands.
    #[error("F[{index}]: expected {expected}, got {got}")]
    Sign {
        /// The row.
        index: usize,
        /// What the place of z_i asks for.
        expected: &'static str,
        /// Its value.
        got: Rational,
    },
}

/// Checks l <= z <= u, F_i >= 0 at the lower bound, <= 0 at the upper one, = 0 between.
///
/// # Errors
/// [`Violated`], the first line that fails.
pub fn check(problem: &ExactMcp, z: &[Rational]) -> Result<(), Violated> {
    if z.len() != problem.dimension() {
        return Err(Violated::Length { expected: problem.dimension(), got: z.len() });
    }
    for (index, (z_i, f_i)) in z.iter().zip(problem.function(z)).enumerate() {
        let (lower, upper) = problem.bounds(index);
        if lower.is_some_and(|l| z_i < l) || upper.is_some_and(|u| z_i > u) {
            return Err(Violated::Bounds { index, got: z_i.clone() });
        }
        let (at_lower, at_upper) = (lower == Some(z_i), upper == Some(z_i));
        let (holds, expected) = match (at_lower, at_upper) {
            (true, true) => (true, "anything"),
            (true, false) => (!f_i.is_negative(), ">= 0 at the lower bound"),
            (false, true) => (!f_i.is_positive(), "<= 0 at the upper bound"),
            (false, false) => (!f_i.is_negative() && !f_i.is_positive(), "0 between the bounds"),
        };
        if !holds {
            return Err(Violated::Sign { index, expected, got: f_i });
        }
    }
    Ok(())
}
