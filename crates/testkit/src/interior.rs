//! Runs of the solver from random points inside the orthant, none of which is a solution.
//!
//! The search has each unit vector at its Ritz value among its starts. Where one particle slips
//! alone, that start is the solution: to find it says nothing about the solver. Here every x_i of a
//! start is positive and random, so that a start is a solution with probability 0 (and lies in the
//! support of slip-slip solutions only).
//!
//! Input: a problem that fulfils the hypotheses of Proposition 1 or 2. Output: what was found and
//! certified, or how many starts led to one of the proved values. Called by `compare` for instances
//! of Table 1, and by `block`.

use super::floors::Coverage;
use mceip_engine::certify::Certifier;
use mceip_engine::multistart::{MultistartFound, Origin, Search, SearchError};
use mceip_engine::reduction::{Embedding, Side};
use mceip_engine::run::Watch;
use mceip_engine::tolerance::PATH_VALUE;
use mceip_exact::{Sparse, to_f64};
use mceip_mcp::solver::{CrashMethod, Options, Sense, SolverError, continuation, solve};
use mceip_model::{Admissible, Problem, Reduced};
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

    let size_of_a = largest(pencil.a());
    let size_of_b = largest(pencil.b());
    let unit = if size_of_a > 0.0 && size_of_b > 0.0 {
        size_of_a / size_of_b
    } else {
        1.0
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
    let mut largest = 0.0;
    for (_, _, v) in matrix.entries() {
        largest = f64::max(largest, to_f64(v).abs());
    }
    largest
}

/// One run of the solver from each of `search.starts` interior starts and, if `search.curves` says
/// so, the curve of the Newton homotopy from each of them both ways; every end is certified. No
/// windows, and no curve through what was found. The signature is that of
/// [`mceip_engine::multistart::multistart`].
///
/// # Errors
/// [`SearchError`] for options out of range, and a problem outside the propositions.
pub fn from_interior(
    problem: &Problem,
    reduced: &Reduced,
    search: &Search,
    _: &Watch<'_>,
) -> Result<MultistartFound, SearchError> {
    let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
    let bottom = to_f64(problem.window().min());
    let certifier = Certifier::new(problem, &reduced.pencil);
    let embedding = Embedding::new(&admissible, Side::Above(bottom));

    let mut attempt = InteriorRuns {
        certifier,
        embedding,
        found: MultistartFound::default(),
    };

    let mut points = Vec::new();
    for start in interior_starts(&admissible, search.starts, search.seed) {
        let value = bottom + start.value;
        points.push(attempt.embedding.point(value, &start.x));
    }

    for point in &points {
        attempt.run(point, Origin::Start, &search.options)?;
    }

    if search.curves {
        for point in &points {
            attempt.follow(point, Sense::Down, &search.options)?;
            attempt.follow(point, Sense::Up, &search.options)?;
        }
    }

    Ok(attempt.found)
}

/// Solutions taken from one curve, at most.
const PER_CURVE: usize = 16;

/// Runs on one problem, and what they found.
struct InteriorRuns<'a> {
    certifier: Certifier<'a>,
    embedding: Embedding,
    found: MultistartFound,
}

impl InteriorRuns<'_> {
    /// The curve of the Newton homotopy from the point in one sense, and a run from each solution
    /// on it.
    fn follow(
        &mut self,
        point: &[f64],
        sense: Sense,
        options: &Options,
    ) -> Result<(), SolverError> {
        let curve = continuation(&self.embedding, point, sense, PER_CURVE, options)?;
        for met in &curve.solutions {
            self.run(met, Origin::Curve, options)?;
        }
        Ok(())
    }

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
        let point = embedding.point(start.value, &start.x);
        let outcome = solve(&embedding, &point, &options)?;

        let value = embedding.candidate(&outcome.point).value;
        let is_near = |v: &f64| (v - value).abs() <= PATH_VALUE * v.abs();
        let is_proved = values.iter().any(is_near);
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
    use mceip_mcp::mcp::Mcp;
    use mceip_model::Unknown;
    use mceip_model::reduction::reduce;

    /// Rows of the pencil at a start, scaled to e'x_s = 1: the largest violation of
    /// complementarity.
    fn violation(embedding: &Embedding, point: &[f64]) -> f64 {
        let mut rows = vec![0.0; point.len()];
        embedding.function(point, &mut rows);

        let mut largest = 0.0;
        for (z, f) in point.iter().zip(&rows) {
            largest = f64::max(largest, z.min(*f).abs());
        }
        largest
    }

    /// On Table 1 no interior start is a solution, and among the starts of the search some are.
    #[test]
    fn interior_starts_are_no_solutions_and_ritz_starts_are() {
        let mut interior = 0;
        let mut ritz = 0;
        for instance in table1_grid().unwrap().iter().step_by(5) {
            let reduced = reduce(&instance.problem).unwrap();
            let admissible = Admissible::new(&reduced.pencil, Unknown::Lambda2).unwrap();
            let embedding = Embedding::new(&admissible, Side::Above(0.0));

            for start in interior_starts(&admissible, INTERIOR_STARTS, 7) {
                let point = embedding.point(start.value, &start.x);
                assert!(start.x.iter().all(|x| *x > 0.0));
                assert!(violation(&embedding, &point) > 1e-6, "{}", instance.label);
                interior += 1;
            }

            for start in &embedding.starts(4, 1)[2..] {
                ritz += usize::from(violation(&embedding, start) < 1e-12);
            }
        }

        assert!(interior > 2000, "{interior}");
        assert!(ritz > 20, "{ritz}");
    }

    /// What is found from interior starts is certified, and its run is a start.
    #[test]
    fn interior_runs_find_what_the_search_finds() {
        let mut found = 0;
        for instance in table1_grid().unwrap().iter().step_by(11) {
            let reduced = reduce(&instance.problem).unwrap();
            let problem = &instance.problem;

            let search = Search {
                starts: INTERIOR_STARTS,
                ..Search::default()
            };

            let nobody = Watch::nobody();
            let interior = from_interior(problem, &reduced, &search, &nobody).unwrap();
            let whole = multistart(problem, &reduced, &search, &nobody).unwrap();

            let label = &instance.label;
            assert!(interior.runs >= INTERIOR_STARTS, "{label}");
            assert!(interior.certified.len() <= whole.certified.len(), "{label}");

            for c in &interior.certified {
                assert!(whole.certified.iter().any(|w| same(&w.claim, &c.claim)));
                found += 1;
            }
        }

        assert!(found > 20, "{found}");
    }
}
