//! A solver that keeps its storage: run after run, on one problem or many, without allocating
//! again (book, 3.8). The public form of `newton`.

use super::error::SolverError;
use super::newton::{NewtonRun, Workspace};
use super::options::Options;
use super::outcome::{Counters, Outcome, Termination};
use super::residual::Residuals;
use super::validate::validate;
use crate::mcp::Mcp;

/// How a run of a [`Solver`] ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ended {
    /// Why it stopped.
    pub termination: Termination,
    /// The five residuals of the best point.
    pub residuals: Residuals,
    /// The work done.
    pub counters: Counters,
}

/// [`super::solve`] with storage that is kept from run to run.
///
/// A run like one before (no more unknowns, steps, paths and pivots) allocates nothing in crash,
/// linearisation, pivoting, line search and gradient steps; curves of the Newton homotopy, which
/// only follow where the first attempt fails, do. The same input gives the same result whatever was
/// solved before.
///
/// ```
/// use mceip_mcp::{
///     mcp::LinearMcp,
///     solver::{Options, Solver},
/// };
/// let lcp = LinearMcp::lcp(nalgebra::dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
/// let mut solver = Solver::new();
/// for start in [[0.0, 0.0], [9.0, 1.0]] {
///     assert!(
///         solver
///             .run(&lcp, &start, &Options::default())
///             .unwrap()
///             .termination
///             .reached_tolerance()
///     );
///     assert!((solver.point()[0] - 4.0 / 3.0).abs() < 1e-12);
/// }
/// ```
#[derive(Default)]
pub struct Solver {
    space: Workspace,
}

impl Solver {
    /// A solver that owns nothing yet.
    pub fn new() -> Solver {
        Solver::default()
    }

    /// Runs from `start` (length n, projected onto the bounds) until a reason to stop.
    ///
    /// # Errors
    /// [`SolverError`] as [`super::solve`].
    pub fn run<P: Mcp + ?Sized>(
        &mut self,
        problem: &P,
        start: &[f64],
        options: &Options,
    ) -> Result<Ended, SolverError> {
        validate(problem, start, options)?;

        let space = std::mem::take(&mut self.space);
        let finished = NewtonRun::new(problem, options, space).run(start);
        self.space = finished.space;

        Ok(Ended {
            termination: finished.termination,
            residuals: finished.residuals,
            counters: finished.counters,
        })
    }

    /// The point of least merit that the last run met, or the one within the tolerance; of length
    /// n, within the bounds. Empty before the first run.
    pub fn point(&self) -> &[f64] {
        &self.space.point
    }

    /// The last run with its log. This copies.
    pub fn outcome(&self, ended: Ended) -> Outcome {
        Outcome {
            point: self.space.point.clone(),
            residuals: ended.residuals,
            termination: ended.termination,
            log: self.space.log.records(),
            counters: ended.counters,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::dmatrix;

    #[test]
    fn the_point_is_that_of_the_last_run() {
        let mut solver = Solver::new();
        assert!(solver.point().is_empty());

        for q in [-3.0, -7.0, 5.0] {
            let lcp = LinearMcp::lcp(dmatrix![2.0], vec![q]).unwrap();
            let ended = solver.run(&lcp, &[1.0], &Options::default()).unwrap();
            assert_eq!(solver.point(), [f64::max(-q / 2.0, 0.0)]);

            let outcome = solver.outcome(ended);
            assert_eq!(outcome.point, solver.point());
            assert_eq!(outcome.termination, ended.termination);
            assert_eq!(outcome.counters, ended.counters);
        }
    }
}
