//! MCEIP-lambda2 at finite-element size: many starts on the condensed problem, each value of
//! lambda^2 by one sparse factorisation. Finds; says nothing about what it does not find, and
//! certifies nothing.

use super::same::repeats;
use crate::candidate::Candidate;
use crate::reduction::{CondensedEmbedding, CondensedEmbeddingError, SparseCondensation};
use crate::run::{Progress, Watch};
use mceip_mcp::linear::solve as solve_dense;
use mceip_mcp::mcp::Mcp;
use mceip_mcp::solver::{Options, SolverError, Termination, solve};
use std::collections::BTreeMap;

/// Newton steps on the places of a point, at most: each doubles the digits.
const POLISH_STEPS: usize = 6;

/// How to search.
#[derive(Debug, Clone, PartialEq)]
pub struct CondensedSearch {
    /// Starts.
    pub starts: usize,
    /// Seed of those that are random.
    pub seed: u64,
    /// Options of each run.
    pub options: Options,
}

impl Default for CondensedSearch {
    fn default() -> Self {
        // A curve costs a factorisation a step: the starts do without.
        CondensedSearch {
            starts: 22,
            seed: 1,
            options: Options {
                curve_step_limit: 0,
                ..Options::for_search()
            },
        }
    }
}

/// A solution in doubles, uncertified.
#[derive(Debug, Clone, PartialEq)]
pub struct CondensedSolution {
    /// lambda^2 (s^-2), with x over the variables of the reduced pencil: f ascending, then slip;
    /// e'x_s = 1.
    pub candidate: Candidate,
    /// x of the slip particles.
    pub slip: Vec<f64>,
    /// y of the slip particles.
    pub reaction: Vec<f64>,
    /// Starts that ended here.
    pub runs: usize,
}

/// What a search found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CondensedFound {
    /// Distinct solutions, by value.
    pub solutions: Vec<CondensedSolution>,
    /// Runs made.
    pub runs: usize,
    /// Sparse factorisations made.
    pub factorisations: usize,
    /// How often each reason ended a run.
    pub terminations: BTreeMap<Termination, usize>,
    /// Was the search cancelled?
    pub interrupted: bool,
}

/// Why a search did not take place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CondensedSearchError {
    /// The problem was refused.
    #[error(transparent)]
    Embedding(#[from] CondensedEmbeddingError),
    /// The options were refused.
    #[error(transparent)]
    Solver(#[from] SolverError),
}

/// Searches MCEIP-lambda2 at friction mu. Progress counts runs; a search that is cancelled keeps
/// what it has found.
///
/// # Errors
/// [`CondensedSearchError`].
pub fn search_condensed(
    condensation: &SparseCondensation,
    mu: f64,
    search: &CondensedSearch,
    watch: &Watch<'_>,
) -> Result<CondensedFound, CondensedSearchError> {
    let embedding = CondensedEmbedding::new(condensation, mu)?;
    let mut found = CondensedFound::default();
    for start in embedding.starts(search.starts, search.seed) {
        let outcome = solve(&embedding, &start, &search.options)?;
        *found.terminations.entry(outcome.termination).or_default() += 1;
        found.runs += 1;
        if outcome.termination.reached_tolerance() {
            file(
                &embedding,
                mu,
                &polished(&embedding, outcome.point),
                &mut found,
            );
        }
        found.factorisations = embedding.factorisations();
        watch.report(&Progress {
            done: found.runs as u64,
            solutions: Some(found.solutions.len() as u64),
            ..Progress::stage("searching")
        });
        if watch.is_cancelled() {
            found.interrupted = true;
            break;
        }
    }
    found
        .solutions
        .sort_by(|p, q| p.candidate.value.total_cmp(&q.candidate.value));
    Ok(found)
}

/// Newton's method on the places of a point (u_i > F_i slips, the others stick), while it gains:
/// runs stop at residuals that leave the value of a near-threshold solution with eight digits.
fn polished(embedding: &CondensedEmbedding<'_>, mut z: Vec<f64>) -> Vec<f64> {
    let n = z.len();
    let mut f = vec![0.0; n];
    embedding.function(&z, &mut f);
    let places: Vec<usize> = (0..n).filter(|&i| i == n - 1 || z[i] > f[i]).collect();
    let size = |f: &[f64]| places.iter().map(|&i| f[i].abs()).fold(0.0, f64::max);
    (0..n)
        .filter(|i| !places.contains(i))
        .for_each(|i| z[i] = 0.0);
    embedding.function(&z, &mut f);
    for _ in 0..POLISH_STEPS {
        let mut j = nalgebra::DMatrix::zeros(n, n);
        embedding.jacobian(&z, &mut j);
        let rows: Vec<Vec<f64>> = places
            .iter()
            .map(|&p| places.iter().map(|&q| j[(p, q)]).collect())
            .collect();
        let right = vec![places.iter().map(|&p| -f[p]).collect()];
        let Some(step) = solve_dense(&rows, &right).and_then(|mut s| s.pop()) else {
            return z;
        };
        let mut next = z.clone();
        places.iter().zip(step).for_each(|(&p, d)| next[p] += d);
        let mut image = vec![0.0; n];
        embedding.function(&next, &mut image);
        if size(&image) >= size(&f)
            || places.iter().any(|&p| next[p] < 0.0)
            || image.iter().any(|v| !v.is_finite())
        {
            return z;
        }
        (z, f) = (next, image);
    }
    z
}

/// Lists a point, once.
fn file(embedding: &CondensedEmbedding<'_>, mu: f64, point: &[f64], found: &mut CondensedFound) {
    let (value, slip) = embedding.value_and_x(point);
    // On the slip particles alone, so that a repeated one costs no lift.
    let small = |x: &[f64]| Candidate {
        value,
        x: x.to_vec(),
    };
    let known = found.solutions.iter_mut().find(|s| {
        let other = Candidate {
            value: s.candidate.value,
            x: s.slip.clone(),
        };
        repeats(&other, &small(&slip))
    });
    if let Some(known) = known {
        known.runs += 1;
        return;
    }
    let Some(zeta) = point.last() else { return };
    let parts = embedding.with(*zeta, |c| {
        let reaction = c
            .pencil(mu)
            .iter()
            .map(|r| r.iter().zip(&slip).map(|(t, x)| t * x).sum())
            .collect();
        (c.reduced(&slip), reaction)
    });
    if let Some((x, reaction)) = parts {
        found.solutions.push(CondensedSolution {
            candidate: Candidate { value, x },
            slip,
            reaction,
            runs: 1,
        });
    }
}
