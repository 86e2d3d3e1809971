//! Linear problems without an outer loop: Lemke's method with a lexicographic ray start (Lemke
//! 1965; Cottle, Pang and Stone 1992, chapter 4).
//!
//! The problem F(z) = M z + q is its own linearisation, so that one path from Lemke's ray is all.
//! Where the options say so, unknowns that their bounds decide are taken out first (`preprocess`);
//! point, pivots and residuals that are reported are those of the whole problem.

use super::error::SolverError;
use super::evaluation::Evaluated;
use super::options::Options;
use super::outcome::{Counters, MajorRecord, Outcome, PathRecord, StepKind, Termination};
use super::path::{Path, PathEnd, PathLimits, PathStorage, Start, Subproblem};
use super::preprocess::Preprocessed;
use super::residual::Residuals;
use crate::mcp::{LinearMcp, Mcp};
use nalgebra::DVector;

/// One path from Lemke's ray to the end of it (Lemke 1965; Cottle, Pang and Stone 1992, chapter 4).
///
/// A complete path ends with [`Termination::ToleranceReached`] if the residuals agree, else with
/// `NoProgress`; a secondary ray with `Ray` and a point a little along it. `minor_iteration_limit`
/// is the limit on pivots. For a P matrix the path is complete and t rises.
///
/// # Errors
/// [`SolverError::Option`] for an option out of range.
///
/// ```
/// use mceip_mcp::{mcp::LinearMcp, solver::{solve_linear, Options}};
/// let lcp = LinearMcp::lcp(nalgebra::dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
/// let outcome = solve_linear(&lcp, &Options::default()).unwrap();
/// assert!(outcome.termination.reached_tolerance());
/// assert!((outcome.point[0] - 4.0 / 3.0).abs() < 1e-14);
/// ```
pub fn solve_linear(problem: &LinearMcp, options: &Options) -> Result<Outcome, SolverError> {
    options.validate()?;
    let preprocessed = if options.preprocess {
        Preprocessed::new(problem)
    } else {
        Preprocessed::nothing(problem.dimension())
    };

    let reduced = preprocessed.reduced.as_ref().unwrap_or(problem);
    let mut path = lemke(reduced, options);

    for pivot in &mut path.pivots {
        *pivot = pivot.renamed(&preprocessed.kept);
    }

    let origin = vec![0.0; reduced.dimension()];
    let first = preprocessed.restore(path.first().unwrap_or(&origin));
    let last = preprocessed.restore(path.last().unwrap_or(&origin));
    let mut evaluated = Evaluated::new(problem);
    let before = evaluated.point(&DVector::from_vec(first));
    let point = evaluated.point(&DVector::from_vec(last));

    let residuals = Residuals::at(problem, point.z.as_slice());
    let is_within = residuals.within(options.convergence_tolerance);
    let is_complete = path.end == PathEnd::Complete;
    let termination = if is_complete && is_within {
        Termination::ToleranceReached
    } else {
        Termination::of(path.end)
    };

    let counters = Counters {
        majors: 1,
        pivots: path.pivots.len(),
        ray_starts: 1,
        factorisations: path.factorisations,
        ..evaluated.counters
    };

    Ok(Outcome {
        point: point.z.as_slice().to_vec(),
        residuals,
        termination,
        log: vec![record(path, before.merit)],
        counters,
    })
}

/// The path from Lemke's ray.
fn lemke(problem: &LinearMcp, options: &Options) -> Path {
    let subproblem = Subproblem {
        m: problem.matrix(),
        q: problem.vector(),
        lower: problem.lower(),
        upper: problem.upper(),
    };

    let limits = PathLimits {
        pivots: options.minor_iteration_limit,
        cycle_entries: options.cycle_entry_limit,
        rule: options.ratio_test,
    };

    let origin = vec![0.0; problem.dimension()];
    let mut path = Path::default();
    PathStorage::default().follow(&subproblem, Start::Ray, &origin, limits, &mut path);

    path
}

/// The only step of the log, with the merit where the path begins.
fn record(path: Path, merit: f64) -> MajorRecord {
    let step = if path.end == PathEnd::Complete {
        StepKind::Path { t: 1.0 }
    } else {
        StepKind::Failed
    };

    let path = PathRecord {
        start: path.start,
        end: path.end,
        reach: path.reach(),
        pivots: path.pivots,
    };

    MajorRecord {
        merit,
        step,
        proximal: 0.0,
        paths: vec![path],
    }
}

#[cfg(test)]
mod tests {
    use super::super::solve;
    use super::*;
    use nalgebra::dmatrix;

    /// The step is the whole path or none.
    #[test]
    fn the_step_is_that_of_the_path() {
        let step = |m: f64| {
            solve_linear(
                &LinearMcp::lcp(dmatrix![m], vec![-1.0]).unwrap(),
                &Options {
                    preprocess: false,
                    ..Options::default()
                },
            )
        };

        assert_eq!(
            [2.0, -1.0].map(|m| step(m).unwrap().log[0].step),
            [StepKind::Path { t: 1.0 }, StepKind::Failed]
        );
    }

    /// What is counted is what is in the log: one path from the ray, its pivots and factorisations.
    #[test]
    fn counters_are_those_of_the_path() {
        let lcp = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        let outcome = solve_linear(&lcp, &Options::default()).unwrap();
        let path = &outcome.log[0].paths[0];

        assert!(path.pivots.len() >= 2);
        assert_eq!(outcome.log.len(), 1);

        let c = &outcome.counters;
        assert_eq!(c.majors, 1);
        assert_eq!(c.pivots, path.pivots.len());
        assert_eq!(c.ray_starts, 1);
        assert!(c.factorisations >= 1);
    }

    /// A second path, from the ray, is only followed where the first one ends before t = 1; both
    /// are counted.
    #[test]
    fn the_ray_is_for_paths_that_fail() {
        let options = Options {
            restart_limit: 0,
            ..Options::default()
        };
        let good = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        let outcome = solve(
            &good,
            &[7.0, 9.0],
            &Options {
                crash_iteration_limit: 0,
                ..options.clone()
            },
        )
        .unwrap();

        assert!(outcome.termination.reached_tolerance());

        let paths: Vec<usize> = outcome
            .log
            .iter()
            .map(|m| m.paths.len())
            .filter(|n| *n > 0)
            .collect();

        assert!(!paths.is_empty(), "{paths:?}");
        assert!(paths.iter().all(|n| *n == 1), "{paths:?}");
        assert_eq!(outcome.counters.ray_starts, 0);

        // F = -1 for every z: no path gets anywhere.
        let none = LinearMcp::lcp(dmatrix![0.0], vec![-1.0]).unwrap();
        let outcome = solve(&none, &[1.0], &options).unwrap();

        assert!(!outcome.termination.reached_tolerance());

        let second = outcome.log.iter().filter(|m| m.paths.len() == 2).count();
        assert!(second > 0, "{:?}", outcome.counters);
        assert!(
            outcome.counters.ray_starts >= second,
            "{:?}",
            outcome.counters
        );
    }

    /// The merit that is logged is that of the start of the ray, where free unknowns solve their
    /// rows already.
    #[test]
    fn the_log_begins_at_the_ray() {
        let options = Options {
            preprocess: false,
            ..Options::default()
        };
        let inf = f64::INFINITY;
        let p = LinearMcp::new(dmatrix![2.0], vec![-3.0], vec![-inf], vec![inf]).unwrap();
        let outcome = solve_linear(&p, &options).unwrap();

        assert_eq!(outcome.log[0].merit, 0.0);
        assert_eq!(outcome.point, vec![1.5]);

        let bounded = LinearMcp::new(dmatrix![2.0], vec![-3.0], vec![0.0], vec![inf]).unwrap();
        assert!(solve_linear(&bounded, &options).unwrap().log[0].merit > 1.0);
    }
}
