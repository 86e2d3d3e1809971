//! Runs of the solver from random points inside the orthant, none of which is a solution.
//!
//! The search has each unit vector at its Ritz value among its starts. Where one particle slips
//! alone, that start is the solution: to find it says nothing about the solver. Here every x_i of a
//! start is positive and random, so that a start is a solution with probability 0 (and lies in the
//! support of slip-slip solutions only).

use super::floors::Coverage;
use mceip_engine::certify::Certifier;
use mceip_engine::multistart::{Found, Origin, Search};
use mceip_engine::reduction::{Embedding, Side};
use mceip_engine::tolerance::PATH_VALUE;
use mceip_exact::{Sparse, to_f64};
use mceip_mcp::solver::{CrashMethod, Options, Sense, SolverError, continuation, solve};
use mceip_model::{Admissible, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Starts of [`from_interior`] on an instance: as many as [`Search::default`] has.
pub const INTERIOR_STARTS: usize = 22;

/// Options of PATH's own sequence: projected Newton and paths. No Fischer-Burmeister, no curve of
/// the homotopy.
pub fn path_options() -> Options {
    Options {
        crash_method: CrashMethod::ProjectedNewton,
        curve_step_limit: 0,
        ..Options::default()
    }
}

/// A start: a value of the unknown and x.
#[derive(Debug, Clone, PartialEq)]
pub struct InteriorStart {
    /// The value, log-uniform over six decades around |A| / |B|.
    pub value: f64,
    /// Positive slip variables, uniform on the simplex; free variables are 0.
    pub x: Vec<f64>,
}

/// Random starts with every slip variable positive.
pub fn interior_starts(admissible: &Admissible<'_>, count: usize, seed: u64) -> Vec<InteriorStart> {
    let pencil = admissible.pencil();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);

    let unit = match (largest(pencil.a()), largest(pencil.b())) {
        (a, b) if a > 0.0 && b > 0.0 => a / b,
        _ => 1.0,
    };

    let slip = pencil.slip();
    let mut starts = Vec::new();

    for _ in 0..count {
        let mut x = vec![0.0; pencil.order()];
        for &i in &slip {
            let uniform: f64 = rng.random_range(f64::MIN_POSITIVE..1.0);
            x[i] = -uniform.ln();
        }

        let decades: f64 = rng.random_range(-3.0..3.0);
        starts.push(InteriorStart {
            value: unit * 10f64.powf(decades),
            x,
        });
    }

    starts
}

/// Absolute value of the largest entry.
fn largest(matrix: &Sparse) -> f64 {
    matrix
        .entries()
        .map(|(_, _, v)| to_f64(v).abs())
        .fold(0.0, f64::max)
}

/// One run of the solver from each of `search.starts` interior starts and, if `search.curves` says
/// so, the curve of the Newton homotopy from each of them both ways; every end is certified. No
/// windows, and no curve through what was found. The signature is that of
/// [`mceip_engine::multistart::multistart`].
///
/// # Errors
/// [`SolverError`] for options out of range.
pub fn from_interior(
    problem: &Problem,
    admissible: &Admissible<'_>,
    search: &Search,
) -> Result<Found, SolverError> {
    let bottom = to_f64(problem.window().min());
    let certifier = Certifier::new(problem, admissible.pencil());
    let embedding = Embedding::new(admissible, Side::Above(bottom));

    let mut attempt = Attempt {
        certifier,
        embedding,
        found: Found::default(),
    };

    let starts = interior_starts(admissible, search.starts, search.seed);
    let points: Vec<Vec<f64>> = starts
        .iter()
        .map(|s| attempt.embedding.point(bottom + s.value, &s.x))
        .collect();

    for point in &points {
        attempt.run(point, Origin::Start, &search.options)?;
    }

    if search.curves {
        for point in &points {
            for sense in [Sense::Down, Sense::Up] {
                let curve =
                    continuation(&attempt.embedding, point, sense, PER_CURVE, &search.options)?;
                for met in &curve.solutions {
                    attempt.run(met, Origin::Curve, &search.options)?;
                }
            }
        }
    }

    Ok(attempt.found)
}

/// Solutions taken from one curve, at most.
const PER_CURVE: usize = 16;

/// Runs on one problem, and what they found.
struct Attempt<'a> {
    certifier: Certifier<'a>,
    embedding: Embedding,
    found: Found,
}

impl Attempt<'_> {
    /// A run of the solver; its end is certified and listed once.
    fn run(&mut self, point: &[f64], origin: Origin, options: &Options) -> Result<(), SolverError> {
        let outcome = solve(&self.embedding, point, options)?;
        let run = self.found.runs;
        self.found.runs += 1;
        self.found.pivots += outcome.counters.pivots;
        self.found.factorisations += outcome.counters.factorisations;

        if !outcome.termination.reached_tolerance() {
            return Ok(());
        }

        let candidate = self.embedding.candidate(&outcome.point);
        if self.found.knows(&candidate) {
            self.found.repeated += 1;
            return Ok(());
        }

        let claim = self.certifier.certify(&candidate);
        self.found.file(candidate, claim, run, origin);
        Ok(())
    }
}

/// Of the interior starts, those from which PATH's own sequence comes to one of the proved
/// `values`; a start counts for both rates. For problems whose certificates cost too much to be
/// made for each start.
///
/// # Errors
/// [`SolverError`]; none, the options are in range.
pub fn path_coverage(
    admissible: &Admissible<'_>,
    values: &[f64],
    count: usize,
    seed: u64,
) -> Result<Coverage, SolverError> {
    let embedding = Embedding::new(admissible, Side::Above(0.0));
    let options = path_options();
    let mut coverage = Coverage::default();

    for start in interior_starts(admissible, count, seed) {
        let outcome = solve(
            &embedding,
            &embedding.point(start.value, &start.x),
            &options,
        )?;

        let value = embedding.candidate(&outcome.point).value;
        let is_proved = values
            .iter()
            .any(|v| (v - value).abs() <= PATH_VALUE * v.abs());
        let found = outcome.termination.reached_tolerance() && is_proved;
        coverage.count(found, found);
    }

    Ok(coverage)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;
    use crate::table1_grid;
    use mceip_engine::multistart::{multistart, same};
    use mceip_engine::reduction::reduce;
    use mceip_mcp::mcp::Mcp;
    use mceip_model::Unknown;

    /// Rows of the pencil at a start, scaled to e'x_s = 1: the largest violation of
    /// complementarity.
    fn violation(embedding: &Embedding, point: &[f64]) -> f64 {
        let mut rows = vec![0.0; point.len()];
        embedding.function(point, &mut rows);

        let pairs = point.iter().zip(&rows);
        pairs.map(|(z, f)| z.min(*f).abs()).fold(0.0, f64::max)
    }

    /// On Table 1 no interior start is a solution, and among the starts of the search some are.
    #[test]
    fn interior_starts_are_no_solutions_and_ritz_starts_are() {
        let (mut interior, mut ritz) = (0, 0);
        for instance in table1_grid().unwrap().iter().step_by(5) {
            let reduced = reduce(&instance.problem).unwrap();
            let admissible = Admissible::new(&reduced.pencil, Unknown::Lambda2).unwrap();
            let embedding = Embedding::new(&admissible, Side::Above(0.0));

            for start in interior_starts(&admissible, INTERIOR_STARTS, 7) {
                assert!(start.x.iter().all(|x| *x > 0.0));
                assert!(
                    violation(&embedding, &embedding.point(start.value, &start.x)) > 1e-6,
                    "{}",
                    instance.label
                );

                interior += 1;
            }

            ritz += embedding.starts(4, 1)[2..]
                .iter()
                .filter(|z| violation(&embedding, z) < 1e-12)
                .count();
        }

        assert!(interior > 2000 && ritz > 20, "{interior} {ritz}");
    }

    /// What is found from interior starts is certified, and its run is a start.
    #[test]
    fn interior_runs_find_what_the_search_finds() {
        let mut found = 0;
        for instance in table1_grid().unwrap().iter().step_by(11) {
            let reduced = reduce(&instance.problem).unwrap();
            let admissible = Admissible::new(&reduced.pencil, Unknown::Lambda2).unwrap();
            let problem = &instance.problem;

            let search = Search {
                starts: INTERIOR_STARTS,
                ..Search::default()
            };

            let interior = from_interior(problem, &admissible, &search).unwrap();
            let whole = multistart(problem, &admissible, &search).unwrap();

            assert!(
                interior.runs >= INTERIOR_STARTS
                    && interior.certified.len() <= whole.certified.len(),
                "{}",
                instance.label
            );

            for c in &interior.certified {
                assert!(whole.certified.iter().any(|w| same(&w.claim, &c.claim)));
                found += 1;
            }
        }

        assert!(found > 20, "{found}");
    }
}
