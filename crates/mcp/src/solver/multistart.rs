//! Many starts, one after the other: the same starts give the same outcomes.
//!
//! Each run is one of [`super::solve`], in storage that is kept from run to run.

use super::error::SolverError;
use super::options::Options;
use super::outcome::Outcome;
use super::reuse::Solver;
use crate::mcp::Mcp;

/// Runs from every start, in order. It never says that nothing else exists: report coverage.
///
/// # Errors
/// [`SolverError`] of the first problem, option or start that makes no sense, before the runs after
/// it.
///
/// ```
/// use mceip_mcp::{mcp::LinearMcp, solver::{multistart, Options}};
/// let lcp = LinearMcp::lcp(nalgebra::dmatrix![-1.0], vec![1.0]).unwrap(); // solutions 0 and 1
/// let outcomes = multistart(&lcp, [vec![0.0], vec![5.0]], &Options::default()).unwrap();
/// assert_eq!(outcomes.len(), 2);
/// ```
pub fn multistart<P: Mcp + ?Sized>(
    problem: &P,
    starts: impl IntoIterator<Item = Vec<f64>>,
    options: &Options,
) -> Result<Vec<Outcome>, SolverError> {
    let mut solver = Solver::new();
    let mut outcomes = Vec::new();

    for start in starts {
        let ended = solver.run(problem, &start, options)?;
        outcomes.push(solver.outcome(ended));
    }
    Ok(outcomes)
}
