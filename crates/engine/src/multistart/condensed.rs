//! MCEIP-lambda2 at finite-element size: many starts on the condensed problem.
//!
//! The free variables are eliminated at each value of lambda^2 by one sparse factorisation
//! ([`CondensedEmbedding`]), so a run of the solver sees the slip variables and lambda^2 only. A
//! point where a run ends is polished by Newton's method and listed once.
//!
//! The search finds; it says nothing about what it does not find, and certifies nothing. Called by
//! the command `block` and by campaigns.

use super::error::SearchError;
use super::require_starts;
use super::same::repeats;
use crate::candidate::Candidate;
use crate::reduction::{CondensedEmbedding, SparseCondensation};
use crate::run::{Progress, Watch};
use mceip_mcp::linear::solve as solve_dense;
use mceip_mcp::mcp::Mcp;
use mceip_mcp::solver::{Options, Termination, solve};
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// Newton steps on the support of a point, at most: each doubles the digits.
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
        let options = Options {
            curve_step_limit: 0,
            ..Options::for_search()
        };
        CondensedSearch {
            starts: 22,
            seed: 1,
            options,
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

/// Searches MCEIP-lambda2 at friction mu. Progress counts runs; a search that is cancelled keeps
/// what it has found.
///
/// # Errors
/// [`SearchError`].
pub fn search_condensed(
    condensation: &SparseCondensation,
    mu: f64,
    search: &CondensedSearch,
    watch: &Watch<'_>,
) -> Result<CondensedFound, SearchError> {
    let embedding = CondensedEmbedding::new(condensation, mu)?;
    require_starts(search.starts, embedding.dimension())?;
    let mut found = CondensedFound::default();

    for start in embedding.starts(search.starts, search.seed) {
        let outcome = solve(&embedding, &start, &search.options)?;
        *found.terminations.entry(outcome.termination).or_default() += 1;
        found.runs += 1;
        if outcome.termination.reached_tolerance() {
            let point = polished(&embedding, outcome.point);
            found.file(&embedding, mu, &point);
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

    let solutions = &mut found.solutions;
    solutions.sort_by(|p, q| p.candidate.value.total_cmp(&q.candidate.value));
    Ok(found)
}

/// Newton's method on the active set of a point, while it gains: runs stop at residuals that leave
/// the value of a near-threshold solution with eight digits.
fn polished(embedding: &CondensedEmbedding<'_>, mut z: Vec<f64>) -> Vec<f64> {
    let active_set = ActiveSet::at(embedding, &z);
    active_set.clear_inactive(&mut z);
    let mut image = active_set.image(&z);

    for _ in 0..POLISH_STEPS {
        let Some(next) = active_set.newton_step(&z, &image) else {
            return z;
        };
        let next_image = active_set.image(&next);

        let gains_nothing = active_set.size(&next_image) >= active_set.size(&image);
        let is_finite = next_image.iter().all(|v| v.is_finite());
        if gains_nothing || !is_finite || active_set.has_negative(&next) {
            return z;
        }
        z = next;
        image = next_image;
    }

    z
}

/// The variables of the condensed MCP that are not held at zero: those that slip (z_i > F_i), and
/// the last one, which stands for lambda^2.
struct ActiveSet<'a> {
    problem: &'a dyn Mcp,
    positions: Vec<usize>,
}

impl<'a> ActiveSet<'a> {
    fn at(problem: &'a dyn Mcp, z: &[f64]) -> ActiveSet<'a> {
        let mut image = vec![0.0; z.len()];
        problem.function(z, &mut image);
        let mut positions = Vec::new();
        for i in 0..z.len() {
            let is_last = i + 1 == z.len();
            if is_last || z[i] > image[i] {
                positions.push(i);
            }
        }

        ActiveSet { problem, positions }
    }

    /// Sets the other variables to zero.
    fn clear_inactive(&self, z: &mut [f64]) {
        for (i, component) in z.iter_mut().enumerate() {
            if !self.positions.contains(&i) {
                *component = 0.0;
            }
        }
    }

    /// F(z).
    fn image(&self, z: &[f64]) -> Vec<f64> {
        let mut image = vec![0.0; z.len()];
        self.problem.function(z, &mut image);
        image
    }

    /// Largest modulus of F on the active set.
    fn size(&self, image: &[f64]) -> f64 {
        let mut size: f64 = 0.0;
        for &i in &self.positions {
            size = size.max(image[i].abs());
        }

        size
    }

    /// Is a variable of the active set negative?
    fn has_negative(&self, z: &[f64]) -> bool {
        self.positions.iter().any(|&i| z[i] < 0.0)
    }

    /// The point after a Newton step in the variables of the active set; `None` where their
    /// Jacobian is singular.
    fn newton_step(&self, z: &[f64], image: &[f64]) -> Option<Vec<f64>> {
        let mut jacobian = DMatrix::zeros(z.len(), z.len());
        self.problem.jacobian(z, &mut jacobian);

        let mut rows = Vec::new();
        let mut right = Vec::new();
        for &i in &self.positions {
            let row: Vec<f64> = self.positions.iter().map(|&j| jacobian[(i, j)]).collect();
            rows.push(row);
            right.push(-image[i]);
        }

        let step = solve_dense(&rows, &[right])?.pop()?;
        let mut next = z.to_vec();
        for (&i, change) in self.positions.iter().zip(step) {
            next[i] += change;
        }

        Some(next)
    }
}

impl CondensedFound {
    /// Lists a point, once: a point that repeats a solution counts as one more run of it.
    fn file(&mut self, embedding: &CondensedEmbedding<'_>, mu: f64, point: &[f64]) {
        let (value, slip) = embedding.value_and_x(point);
        if let Some(known) = self.known(value, &slip) {
            known.runs += 1;
            return;
        }

        let Some(zeta) = point.last() else { return };
        let lifted = embedding.with(*zeta, |condensed| {
            let rows = condensed.pencil(mu);
            let mut reaction = Vec::new();
            for row in rows.iter() {
                reaction.push(row.iter().zip(&slip).map(|(t, x)| t * x).sum());
            }
            (condensed.reduced(&slip), reaction)
        });
        if let Some((x, reaction)) = lifted {
            self.solutions.push(CondensedSolution {
                candidate: Candidate { value, x },
                slip,
                reaction,
                runs: 1,
            });
        }
    }

    /// The solution with this value and x_s, if it is listed. Only x of the slip particles is
    /// compared, so that a repeated point costs no elimination of the free variables.
    fn known(&mut self, value: f64, slip: &[f64]) -> Option<&mut CondensedSolution> {
        let point = Candidate {
            value,
            x: slip.to_vec(),
        };
        self.solutions.iter_mut().find(|solution| {
            let listed = Candidate {
                value: solution.candidate.value,
                x: solution.slip.clone(),
            };
            repeats(&listed, &point)
        })
    }
}
