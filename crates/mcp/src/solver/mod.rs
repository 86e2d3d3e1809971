//! A solver of mixed complementarity problems in doubles, in the manner of PATH (Dirkse and Ferris
//! 1995; Ralph 1994; book, chapter 3).
//!
//! Find z in [l, u] with F_i(z) >= 0 where z_i = l_i, F_i(z) = 0 strictly inside and F_i(z) <= 0
//! where z_i = u_i. F is linearised at a point, the linear problem is solved by pivoting along a
//! path, and a search decides how far along that path the next point lies. A run ends with a
//! *reason*; whether its point is a solution is decided elsewhere, exactly. In the order of the
//! data flow:
//!
//! | file | what |
//! |---|---|
//! | `options`, `tolerance` | limits with PATH's names; every tolerance |
//! | `validate`, `error` | refusals |
//! | `active_bound` | which bound holds an unknown |
//! | `number`, `dense` | the arithmetic, doubles or exact; dense factors in storage that is kept |
//! | `evaluation`, `jacobian` | F and F', counted |
//! | `fischer`, `normal_map`, `residual` | the merit, the normal map, the five residuals |
//! | `crash` | projected Newton to a good active set |
//! | `crash/semismooth`, `crash/step` | Newton on Fischer-Burmeister; a step of both crashes |
//! | `path/` | the linear subproblem, solved by pivoting along the path |
//! | `search`, `gradient`, `restart` | what makes a step acceptable, and what if none is |
//! | `continuation/` | the Newton homotopy: a curve that meets several solutions |
//! | `newton` | the outer loop |
//! | `structure`, `matching` | Jacobians that are singular by their zeros |
//! | `linear`, `preprocess` | Lemke's method alone; what bounds decide before it |
//! | `reuse` | a solver that keeps its storage from run to run |
//! | `outcome`, `log` | point, residuals, reason, log of every pivot |

mod active_bound;
mod continuation;
mod crash;
mod dense;
mod error;
mod evaluation;
mod fischer;
mod gradient;
mod jacobian;
mod linear;
mod log;
mod matching;
mod newton;
mod normal_map;
mod number;
mod options;
mod outcome;
mod path;
mod preprocess;
#[cfg(test)]
mod probe;
mod residual;
mod restart;
mod reuse;
mod search;
mod structure;
mod tolerance;
mod validate;

pub use continuation::{Curve, CurveEnd, Sense, continuation, continuation_through};
pub use error::SolverError;
pub use linear::solve_linear;
pub use matching::unmatched;
pub use options::{CrashMethod, Options, RatioTest};
pub use outcome::{Counters, MajorRecord, NonFinite, Outcome, PathRecord, StepKind, Termination};
pub use path::{PathEnd, Pivot, PivotKind, Start, Variable};
pub use residual::Residuals;
pub use reuse::{Ended, Solver};
pub(crate) use validate::check_point;

use crate::mcp::Mcp;

/// Runs from `start` (length n, projected onto the bounds) until a reason to stop.
///
/// # Errors
/// [`SolverError`] for bounds, starts and options that make no sense. F or a Jacobian that is not
/// finite on the way is a [`Termination`], with the best finite point.
///
/// ```
/// use mceip_mcp::{mcp::LinearMcp, solver::{solve, Options}};
/// let lcp = LinearMcp::lcp(nalgebra::dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
/// let outcome = solve(&lcp, &[0.0, 0.0], &Options::default()).unwrap();
/// assert!(outcome.termination.reached_tolerance());
/// assert!((outcome.point[0] - 4.0 / 3.0).abs() < 1e-12);
/// ```
pub fn solve<P: Mcp + ?Sized>(
    problem: &P,
    start: &[f64],
    options: &Options,
) -> Result<Outcome, SolverError> {
    let mut solver = Solver::new();
    let ended = solver.run(problem, start, options)?;
    Ok(solver.outcome(ended))
}
