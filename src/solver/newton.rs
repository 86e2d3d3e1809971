//! The outer loop: linearise, follow the path to the Newton point, accept by a non-monotone test.

use super::outcome::{Major, Outcome, SolverError, Start, Step, Termination};
use super::path::{Limits, Path, PathEnd, Subproblem, follow};
use super::residual::{Residuals, least_normal};
use super::tolerance::{ARMIJO, PROXIMAL, SMALLEST_STEP, USEFUL_T};
use super::{Options, Pivot};
use crate::mcp::{Mcp, McpError, check_bounds};
use nalgebra::{DMatrix, DVector};
use std::collections::VecDeque;

/// Runs from `start` (projected onto the bounds) until a reason to stop.
///
/// # Errors
/// [`SolverError`] for bounds, starts and options that make no sense; F or a Jacobian that is not
/// finite on the way is a [`Termination`], with the last finite point.
///
/// ```
/// use mceip::{mcp::LinearMcp, solver::{solve, Options}};
/// let inf = f64::INFINITY;
/// let m = nalgebra::dmatrix![2.0, 1.0; 1.0, 2.0];
/// let lcp = LinearMcp::new(m, vec![-5.0, -6.0], vec![0.0; 2], vec![inf; 2]).unwrap();
/// let outcome = solve(&lcp, &[0.0, 0.0], &Options::default()).unwrap();
/// assert!(outcome.termination.reached_tolerance());
/// assert!((outcome.point[0] - 4.0 / 3.0).abs() < 1e-12);
/// assert_eq!(outcome.log[0].t, 1.0); // one complete path
/// ```
pub fn solve<P: Mcp + ?Sized>(problem: &P, start: &[f64], options: &Options) -> Result<Outcome, SolverError> {
    options.validate()?;
    let n = problem.dimension();
    for (what, got) in [("lower", problem.lower().len()), ("upper", problem.upper().len())] {
        if got != n {
            return Err(McpError::Shape { what, expected: n, got }.into());
        }
    }
    check_bounds(problem.lower(), problem.upper())?;
    if start.len() != n {
        return Err(SolverError::StartLength { expected: n, got: start.len() });
    }
    if let Some(index) = start.iter().position(|v| !v.is_finite()) {
        return Err(SolverError::StartNotFinite { index, got: start[index] });
    }
    Ok(Run::new(problem, start, options).run())
}

struct Run<'a, P: Mcp + ?Sized> {
    problem: &'a P,
    options: &'a Options,
    x: DVector<f64>,
    f: DVector<f64>,
    memory: VecDeque<f64>,
    log: Vec<Major>,
    pivots: usize,
}

/// A followed path with the data needed to log it.
struct Followed {
    path: Path,
    start: Start,
    proximal: f64,
}

impl<'a, P: Mcp + ?Sized> Run<'a, P> {
    fn new(problem: &'a P, start: &[f64], options: &'a Options) -> Self {
        let x = project(problem, &DVector::from_column_slice(start));
        let f = evaluate(problem, &x);
        Run { problem, options, x, f, memory: VecDeque::new(), log: Vec::new(), pivots: 0 }
    }

    fn run(mut self) -> Outcome {
        let reason = loop {
            if let Some(reason) = self.stop() {
                break reason;
            }
            if let Err(reason) = self.step() {
                break reason;
            }
        };
        let residuals = Residuals::at(self.problem, self.x.as_slice(), self.f.as_slice());
        Outcome { point: self.x.as_slice().to_vec(), residuals, termination: reason, log: self.log, pivots: self.pivots }
    }

    fn stop(&self) -> Option<Termination> {
        let r = Residuals::at(self.problem, self.x.as_slice(), self.f.as_slice());
        if !self.f.iter().all(|v| v.is_finite()) {
            Some(Termination::NonFinite)
        } else if r.normal_map <= self.options.convergence_tolerance && r.minimum_map <= self.options.convergence_tolerance {
            Some(Termination::ToleranceReached)
        } else if self.log.len() >= self.options.major_iteration_limit {
            Some(Termination::MajorLimit)
        } else if self.pivots >= self.options.cumulative_iteration_limit {
            Some(Termination::PivotLimit)
        } else {
            None
        }
    }

    /// One linearisation and one accepted step.
    fn step(&mut self) -> Result<(), Termination> {
        let merit = self.merit_over(&self.x, &self.f);
        if self.memory.is_empty() {
            self.memory.push_back(merit * self.options.nms_initial_reference_factor);
        }
        let mut jacobian = DMatrix::zeros(self.x.len(), self.x.len());
        self.problem.jacobian(self.x.as_slice(), &mut jacobian);
        if !jacobian.iter().all(|v| v.is_finite()) {
            return Err(Termination::NonFinite);
        }
        let mut failure = Termination::SingularBasis;
        for start in [Start::Regular, Start::Ray] {
            match self.path(&jacobian, start) {
                Some(followed) => match self.accept(followed, merit) {
                    Ok(()) => return Ok(()),
                    Err(reason) => failure = reason,
                },
                None => continue,
            }
        }
        Err(failure)
    }

    /// Follows the path of the linearisation, perturbed as little as makes its first basis regular.
    fn path(&mut self, jacobian: &DMatrix<f64>, start: Start) -> Option<Followed> {
        let size = jacobian.amax().max(f64::MIN_POSITIVE);
        let limits = Limits { pivots: self.options.minor_iteration_limit, cycle: self.options.cycle_limit };
        for proximal in PROXIMAL {
            // F'(x) + eps I with the term eps (z - x): the value at x is unchanged.
            let m = jacobian + DMatrix::identity(self.x.len(), self.x.len()) * (proximal * size);
            let q = &self.f - &m * &self.x;
            let sub = Subproblem { m: &m, q: &q, lower: self.problem.lower(), upper: self.problem.upper() };
            let (z, multiplier) = match start {
                Start::Regular => (self.x.clone(), self.multiplier_over(&self.x, &self.f)),
                Start::Ray => ray_start(&sub),
            };
            if let Some(path) = follow(&sub, &z, &multiplier, limits) {
                self.pivots += path.pivots.len();
                return Some(Followed { path, start, proximal });
            }
        }
        None
    }

    /// The non-monotone test, from the end of the path backwards.
    fn accept(&mut self, followed: Followed, merit: f64) -> Result<(), Termination> {
        let Followed { path, start, proximal } = followed;
        let reach = path.reach();
        let complete = path.end == PathEnd::Complete;
        let reference = self.memory.iter().copied().fold(merit, f64::max);
        if complete || (start == Start::Regular && reach >= USEFUL_T) {
            let mut t = if complete { 1.0 } else { reach };
            while t >= SMALLEST_STEP {
                if let Some((z, _)) = path.at(t) {
                    let x = project(self.problem, &z);
                    let f = evaluate(self.problem, &x);
                    let merit_there = self.merit_over(&x, &f);
                    if merit_there <= (1.0 - ARMIJO * t) * reference {
                        let step = if t >= 1.0 { Step::Full } else { Step::Search { t } };
                        self.record(Major { merit, start, proximal, pivots: path.pivots, t: reach, step }, merit_there);
                        (self.x, self.f) = (x, f);
                        return Ok(());
                    }
                }
                if start == Start::Ray {
                    break; // its path does not begin at the iterate: only its end is a Newton point
                }
                t *= 0.5;
            }
            return Err(Termination::NoProgress);
        }
        Err(match path.end {
            PathEnd::Cycle => Termination::Cycle,
            PathEnd::PivotLimit => Termination::PivotLimit,
            PathEnd::Singular => Termination::SingularBasis,
            _ => Termination::Ray,
        })
    }

    fn record(&mut self, major: Major, merit: f64) {
        self.log.push(major);
        self.memory.push_back(merit);
        while self.memory.len() > self.options.nms_memory_size {
            self.memory.pop_front();
        }
    }

    /// w - v of the normal-map point over x with the least residual.
    fn multiplier_over(&self, x: &DVector<f64>, f: &DVector<f64>) -> DVector<f64> {
        let (l, u) = (self.problem.lower(), self.problem.upper());
        DVector::from_fn(x.len(), |i, _| f[i] - least_normal(x[i], f[i], l[i], u[i]))
    }

    /// Merit |F_normal|^2 / 2 at the least point over x; infinite where F is not finite.
    fn merit_over(&self, x: &DVector<f64>, f: &DVector<f64>) -> f64 {
        let (l, u) = (self.problem.lower(), self.problem.upper());
        let sum: f64 = (0..x.len()).map(|i| least_normal(x[i], f[i], l[i], u[i]).powi(2)).sum();
        if sum.is_finite() { 0.5 * sum } else { f64::INFINITY }
    }
}

/// The far end of Lemke's ray: z at the finite bounds (0 where free), multipliers that dominate.
fn ray_start(sub: &Subproblem<'_>) -> (DVector<f64>, DVector<f64>) {
    let n = sub.q.len();
    let z = DVector::from_fn(n, |i, _| {
        if sub.lower[i].is_finite() {
            sub.lower[i]
        } else if sub.upper[i].is_finite() {
            sub.upper[i]
        } else {
            0.0
        }
    });
    let value = sub.m * &z + sub.q;
    let far = 1.0 + value.amax();
    let multiplier = DVector::from_fn(n, |i, _| {
        if sub.lower[i].is_finite() {
            value[i] + far
        } else if sub.upper[i].is_finite() {
            value[i] - far
        } else {
            0.0
        }
    });
    (z, multiplier)
}

fn project<P: Mcp + ?Sized>(problem: &P, z: &DVector<f64>) -> DVector<f64> {
    DVector::from_fn(z.len(), |i, _| z[i].clamp(problem.lower()[i], problem.upper()[i]))
}

fn evaluate<P: Mcp + ?Sized>(problem: &P, x: &DVector<f64>) -> DVector<f64> {
    let mut f = DVector::zeros(x.len());
    problem.function(x.as_slice(), f.as_mut_slice());
    f
}

impl Outcome {
    /// All pivots of the run with their t, path after path.
    pub fn trace(&self) -> impl Iterator<Item = &Pivot> {
        self.log.iter().flat_map(|m| m.pivots.iter())
    }
}
