//! The pivotal path of the linear subproblem, from t = 0 at the current point to the Newton point
//! at t = 1 (Ralph 1994; Dirkse and Ferris 1995, section 3).
//!
//! M z - w + v + t r = r - q, z in [l, u], w complementary to z at l, v to z at u. At t = 0 the
//! current normal-map point solves it. Ties are broken lexicographically: the right-hand side is
//! thought perturbed by B_0 (eps, eps^2, ...), so in exact arithmetic no basis repeats.

use super::basis::{Basis, Columns};
use super::tolerance::{PIVOT, TIE};
use nalgebra::{DMatrix, DVector};
use std::cmp::Ordering;

/// A variable of the linear subproblem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Variable {
    /// z_i, strictly between its bounds when basic.
    Z(usize),
    /// w_i, complementary to z_i at its lower bound.
    W(usize),
    /// v_i, complementary to z_i at its upper bound.
    V(usize),
    /// The path parameter.
    T,
}

/// One pivot: at `t`, `leaving` reached a bound and `entering` takes its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pivot {
    /// Path parameter at the pivot.
    pub t: f64,
    /// The variable that left the basis (`T` at the very end).
    pub leaving: Variable,
    /// The variable that moves from here on.
    pub entering: Variable,
}

/// Why a path ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PathEnd {
    Complete,
    Ray,
    Cycle,
    PivotLimit,
    Singular,
}

/// A breakpoint of the piecewise-linear path: z and the multipliers w - v.
#[derive(Debug, Clone)]
pub(super) struct Knot {
    pub(super) t: f64,
    pub(super) z: DVector<f64>,
    /// w - v, so that the normal-map point is z - multiplier.
    pub(super) multiplier: DVector<f64>,
}

pub(super) struct Path {
    pub(super) knots: Vec<Knot>,
    pub(super) pivots: Vec<Pivot>,
    pub(super) end: PathEnd,
}

/// The linear subproblem with its bounds and the residual that the path removes.
pub(super) struct Subproblem<'a> {
    pub(super) m: &'a DMatrix<f64>,
    pub(super) q: &'a DVector<f64>,
    pub(super) lower: &'a [f64],
    pub(super) upper: &'a [f64],
}

/// Limits on one path.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    pub(super) pivots: usize,
    pub(super) cycle: usize,
}

/// Follows the path from the normal-map point z - multiplier. `None` if the first basis is singular.
pub(super) fn follow(sub: &Subproblem<'_>, z: &DVector<f64>, multiplier: &DVector<f64>, limits: Limits) -> Option<Path> {
    let r = sub.m * z + sub.q - multiplier;
    let columns = Columns { m: sub.m, r: &r };
    let mut walker = Walker::new(sub, &columns, z, multiplier, limits)?;
    let end = walker.run();
    Some(Path { knots: walker.knots, pivots: walker.pivots, end })
}

/// What stops the entering variable.
struct Block {
    step: f64,
    /// Row of the blocking basic variable; `None` if the entering one reaches its other bound.
    row: Option<usize>,
    at_upper: bool,
}

struct Walker<'a> {
    sub: &'a Subproblem<'a>,
    columns: &'a Columns<'a>,
    basis: Basis,
    /// Values of the basic variables, row by row.
    values: DVector<f64>,
    /// Values of all z, also of the non-basic ones at their bounds.
    z: DVector<f64>,
    entering: Variable,
    /// +1 if the entering variable increases.
    sign: f64,
    t: f64,
    best_t: f64,
    entries: Vec<usize>,
    knots: Vec<Knot>,
    pivots: Vec<Pivot>,
    limits: Limits,
}

impl<'a> Walker<'a> {
    fn new(sub: &'a Subproblem<'a>, columns: &'a Columns<'a>, z: &DVector<f64>, multiplier: &DVector<f64>, limits: Limits) -> Option<Self> {
        let n = z.len();
        // At a bound the multiplier is basic; strictly inside z is.
        let variable = |i: usize| {
            if z[i] <= sub.lower[i] && multiplier[i] >= 0.0 {
                Variable::W(i)
            } else if z[i] >= sub.upper[i] {
                Variable::V(i)
            } else {
                Variable::Z(i)
            }
        };
        let variables: Vec<Variable> = (0..n).map(variable).collect();
        let values = DVector::from_fn(n, |i, _| match variables[i] {
            Variable::W(_) => multiplier[i],
            Variable::V(_) => -multiplier[i],
            _ => z[i],
        });
        let basis = Basis::new(columns, variables)?;
        let start = Knot { t: 0.0, z: z.clone(), multiplier: multiplier.clone() };
        Some(Walker {
            sub,
            columns,
            basis,
            values,
            z: z.clone(),
            entering: Variable::T,
            sign: 1.0,
            t: 0.0,
            best_t: 0.0,
            entries: vec![0; 3 * n],
            knots: vec![start],
            pivots: Vec::new(),
            limits,
        })
    }

    fn run(&mut self) -> PathEnd {
        for _ in 0..self.limits.pivots {
            let direction = self.basis.solve(&self.columns.of(self.entering)) * -self.sign;
            let Some(block) = self.ratio_test(&direction) else { return PathEnd::Ray };
            self.advance(&direction, block.step);
            if self.entering == Variable::T && self.t >= 1.0 {
                return PathEnd::Complete;
            }
            let Some(row) = block.row else {
                self.flip();
                continue;
            };
            let leaving = self.basis.variables[row];
            if leaving == Variable::T {
                if let (true, Some(last)) = (block.at_upper, self.knots.last_mut()) {
                    (self.t, last.t) = (1.0, 1.0); // t has reached 1, whatever rounding says
                }
                self.pivots.push(Pivot { t: self.t, leaving, entering: self.entering });
                // Back at t = 0 the path has closed on itself: no way to 1 from here.
                return if block.at_upper { PathEnd::Complete } else { PathEnd::Ray };
            }
            if !self.pivot(row, leaving, block.at_upper, &direction) {
                return PathEnd::Singular;
            }
            if self.is_cycling() {
                return PathEnd::Cycle;
            }
        }
        PathEnd::PivotLimit
    }

    /// Bounds of a variable.
    fn bounds(&self, variable: Variable) -> (f64, f64) {
        match variable {
            Variable::Z(i) => (self.sub.lower[i], self.sub.upper[i]),
            Variable::W(_) | Variable::V(_) => (0.0, f64::INFINITY),
            Variable::T => (0.0, 1.0),
        }
    }

    /// The first bound met. Reaching t = 1 wins ties, then the lexicographic order decides.
    fn ratio_test(&self, direction: &DVector<f64>) -> Option<Block> {
        let threshold = PIVOT * direction.amax().max(1.0);
        let mut blocks: Vec<Block> = Vec::new();
        for (row, (&variable, &d)) in self.basis.variables.iter().zip(direction.iter()).enumerate() {
            if d.abs() <= threshold {
                continue;
            }
            let (lo, hi) = self.bounds(variable);
            let bound = if d > 0.0 { hi } else { lo };
            if bound.is_finite() {
                let step = ((bound - self.values[row]) / d).max(0.0);
                blocks.push(Block { step, row: Some(row), at_upper: d > 0.0 });
            }
        }
        let own = self.own_room();
        if own.is_finite() {
            blocks.push(Block { step: own, row: None, at_upper: self.sign > 0.0 });
        }
        let least = blocks.iter().map(|b| b.step).fold(f64::INFINITY, f64::min);
        let tied = blocks.into_iter().filter(|b| b.step <= least + TIE * (1.0 + least.abs()));
        tied.min_by(|a, b| self.prefer(a, b, direction))
    }

    /// How far the entering variable may go on its own.
    fn own_room(&self) -> f64 {
        match self.entering {
            Variable::T => 1.0 - self.t,
            Variable::Z(i) => self.sub.upper[i] - self.sub.lower[i],
            _ => f64::INFINITY,
        }
    }

    /// t reaching 1 first, then the lexicographic order of the perturbed steps.
    fn prefer(&self, a: &Block, b: &Block, direction: &DVector<f64>) -> Ordering {
        let ends = |block: &Block| match block.row {
            Some(row) => self.basis.variables[row] == Variable::T && block.at_upper,
            None => self.entering == Variable::T,
        };
        let perturbed = |block: &Block| match block.row {
            // step = (bound - value - eps perturbation) / d
            Some(row) => self.basis.perturbation(row) / -direction[row],
            None => DVector::zeros(direction.len()),
        };
        ends(b).cmp(&ends(a)).then_with(|| lexicographic(&perturbed(a), &perturbed(b)))
    }

    /// Moves along the direction and records the knot.
    fn advance(&mut self, direction: &DVector<f64>, step: f64) {
        self.values += direction * step;
        match self.entering {
            Variable::T => self.t = (self.t + step).min(1.0),
            Variable::Z(i) => self.z[i] += self.sign * step,
            _ => {}
        }
        let mut multiplier = DVector::zeros(self.z.len());
        for (row, &variable) in self.basis.variables.iter().enumerate() {
            match variable {
                Variable::Z(i) => self.z[i] = self.values[row],
                Variable::W(i) => multiplier[i] = self.values[row],
                Variable::V(i) => multiplier[i] = -self.values[row],
                Variable::T => self.t = self.values[row].clamp(0.0, 1.0),
            }
        }
        match self.entering {
            Variable::W(i) => multiplier[i] = step,
            Variable::V(i) => multiplier[i] = -step,
            _ => {}
        }
        self.knots.push(Knot { t: self.t, z: self.z.clone(), multiplier });
    }

    /// The entering z went from one bound to the other: its complement at that bound enters.
    fn flip(&mut self) {
        if let Variable::Z(i) = self.entering {
            let at_upper = self.sign > 0.0;
            self.z[i] = if at_upper { self.sub.upper[i] } else { self.sub.lower[i] };
            let entering = if at_upper { Variable::V(i) } else { Variable::W(i) };
            self.pivots.push(Pivot { t: self.t, leaving: self.entering, entering });
            self.entering = entering;
            self.sign = 1.0;
        }
    }

    /// Puts the entering variable into the basis; the complement of the leaving one moves next.
    fn pivot(&mut self, row: usize, leaving: Variable, at_upper: bool, direction: &DVector<f64>) -> bool {
        let entering = self.entering;
        let value = match entering {
            Variable::T => self.t,
            Variable::Z(i) => self.z[i],
            Variable::W(i) | Variable::V(i) => self.knots.last().map_or(0.0, |k| k.multiplier[i].abs()),
        };
        // `direction` is -sign B^-1 a; the update wants B^-1 a.
        if !self.basis.replace(self.columns, row, entering, &(direction * -self.sign)) {
            return false;
        }
        self.values[row] = value;
        let (next, sign) = match leaving {
            Variable::Z(i) if at_upper => {
                self.z[i] = self.sub.upper[i];
                (Variable::V(i), 1.0)
            }
            Variable::Z(i) => {
                self.z[i] = self.sub.lower[i];
                (Variable::W(i), 1.0)
            }
            Variable::W(i) => (Variable::Z(i), 1.0),
            Variable::V(i) => (Variable::Z(i), -1.0),
            Variable::T => (Variable::T, 1.0), // handled by the caller
        };
        self.pivots.push(Pivot { t: self.t, leaving, entering: next });
        self.entering = next;
        self.sign = sign;
        if self.basis.is_fresh() {
            self.recompute();
        }
        true
    }

    /// Values of the basic variables from scratch: B x_B = r - q - (non-basic z at their bounds).
    fn recompute(&mut self) {
        let mut rest = self.columns.r - self.sub.q;
        let is_basic = |v: Variable| self.basis.variables.contains(&v);
        for i in (0..self.z.len()).filter(|&i| !is_basic(Variable::Z(i))) {
            rest -= self.sub.m.column(i) * self.z[i];
        }
        self.values = self.basis.solve(&rest);
    }

    /// Counts entries per variable; the counts start again at each new maximum of t.
    fn is_cycling(&mut self) -> bool {
        if self.t > self.best_t + TIE {
            self.best_t = self.t;
            self.entries.iter_mut().for_each(|c| *c = 0);
        }
        let n = self.z.len();
        let slot = match self.entering {
            Variable::Z(i) => i,
            Variable::W(i) => n + i,
            Variable::V(i) => 2 * n + i,
            Variable::T => return false,
        };
        self.entries[slot] += 1;
        self.entries[slot] > self.limits.cycle
    }
}

/// First component in which two vectors differ decides; components within rounding are equal.
fn lexicographic(a: &DVector<f64>, b: &DVector<f64>) -> Ordering {
    let scale = a.amax().max(b.amax()).max(f64::MIN_POSITIVE);
    let differs = a.iter().zip(b.iter()).find(|(x, y)| (*x - *y).abs() > TIE * scale);
    differs.map_or(Ordering::Equal, |(x, y)| x.total_cmp(y))
}

impl Path {
    /// The point of the path where it first reaches t, linearly between knots.
    pub(super) fn at(&self, t: f64) -> Option<(DVector<f64>, DVector<f64>)> {
        let k = self.knots.windows(2).position(|w| w[0].t < t && w[1].t >= t)?;
        let (a, b) = (&self.knots[k], &self.knots[k + 1]);
        let s = (t - a.t) / (b.t - a.t);
        Some((a.z.lerp(&b.z, s), a.multiplier.lerp(&b.multiplier, s)))
    }

    /// Largest t reached.
    pub(super) fn reach(&self) -> f64 {
        self.knots.iter().map(|k| k.t).fold(0.0, f64::max)
    }
}
