//! The pivot loop: along the path from t = 0 until t = 1, a ray, a cycle or a limit.

use super::super::RatioTest;
use super::super::tolerance::{RAY_STEP, TIE};
use super::number::{Number, largest};
use super::ratio::{Block, ratio_test};
use super::tableau::Tableau;
use super::variable::{Pivot, PivotKind, Variable};
use super::{Knot, Limits, Path, PathEnd, Start};
use nalgebra::DVector;

/// A path under way.
pub(super) struct Walk<'a, T: Number> {
    tableau: Tableau<'a, T>,
    limits: Limits,
    kind: Start,
    knots: Vec<Knot<T>>,
    pivots: Vec<Pivot>,
    best_t: T,
    /// Times each unknown has begun to move since the last new maximum of t: Z, W, V of each index.
    entries: Vec<[usize; 3]>,
}

impl<'a, T: Number> Walk<'a, T> {
    pub(super) fn new(tableau: Tableau<'a, T>, kind: Start, limits: Limits) -> Self {
        let entries = vec![[0; 3]; tableau.z.len()];
        let mut walk = Walk { tableau, limits, kind, knots: Vec::new(), pivots: Vec::new(), best_t: T::zero(), entries };
        walk.record_knot();
        walk
    }

    /// Walks to the end.
    pub(super) fn run(mut self) -> Path<T> {
        let end = self.pivot_until_end();
        Path { knots: self.knots, pivots: self.pivots, end, start: self.kind, factorisations: 2 + self.tableau.basis.refreshed }
    }

    fn pivot_until_end(&mut self) -> PathEnd {
        while self.pivots.len() < self.limits.pivots {
            let column = self.tableau.column();
            let rates = &column * -self.tableau.sign.clone();
            let Some(block) = ratio_test(&self.tableau, &rates, self.limits.rule, self.pivots.len()) else {
                self.step_along_ray(&rates);
                return PathEnd::Ray;
            };
            self.tableau.advance(&rates, block.step.clone());
            self.record_knot();
            if let Some(end) = self.turn(&block, &column) {
                return end;
            }
        }
        PathEnd::PivotLimit
    }

    /// At a breakpoint: complete, flip or exchange.
    fn turn(&mut self, block: &Block<T>, column: &DVector<T>) -> Option<PathEnd> {
        let entering = self.tableau.entering;
        let leaving = block.place.map_or(entering, |place| self.tableau.basis.variables[place]);
        let kind = match (leaving, block.place) {
            (Variable::T, _) => PivotKind::Complete,
            (_, None) => PivotKind::Flip,
            (Variable::Artificial(_), _) => PivotKind::ArtificialLeaves,
            _ => PivotKind::Exchange,
        };
        self.pivots.push(Pivot { t: self.tableau.t.to_double(), entering, leaving, kind });
        match block.place {
            _ if kind == PivotKind::Complete => return Some(self.complete()),
            None => self.tableau.flip(),
            Some(place) => {
                if !self.tableau.exchange(place, block.at_upper, column) {
                    return Some(PathEnd::Singular);
                }
                if self.limits.rule == RatioTest::Expand {
                    self.tableau.settle();
                }
            }
        }
        self.is_cycling().then_some(PathEnd::Cycle)
    }

    /// The last knot stands at t = 1 exactly.
    fn complete(&mut self) -> PathEnd {
        if let Some(last) = self.knots.last_mut() {
            last.t = T::one();
        }
        if let Some(last) = self.pivots.last_mut() {
            last.t = 1.0;
        }
        PathEnd::Complete
    }

    /// A point a little along the ray, as the last knot.
    fn step_along_ray(&mut self, rates: &DVector<T>) {
        let speed = largest(rates).larger(T::one());
        let step = T::from_double(RAY_STEP) * (T::one() + largest(&self.tableau.z)) / speed;
        self.tableau.advance(rates, step);
        self.record_knot();
    }

    fn record_knot(&mut self) {
        let (t, z, multiplier) = (self.tableau.t.clone(), self.tableau.z.clone(), self.tableau.multiplier.clone());
        self.knots.push(Knot { t, z, multiplier });
    }

    /// Counts how often each unknown begins to move; the counts restart at each new maximum of t.
    /// A ray start has no guard: its lexicographic order excludes cycles.
    fn is_cycling(&mut self) -> bool {
        if self.kind == Start::Ray {
            return false;
        }
        if self.tableau.t > self.best_t.clone() + T::tolerance(TIE) {
            self.best_t = self.tableau.t.clone();
            self.entries.iter_mut().for_each(|counts| *counts = [0; 3]);
        }
        let (index, slot) = match self.tableau.entering {
            Variable::Z(i) => (i, 0),
            Variable::W(i) => (i, 1),
            Variable::V(i) => (i, 2),
            Variable::Artificial(_) | Variable::T => return false,
        };
        self.entries[index][slot] += 1;
        self.entries[index][slot] > self.limits.cycle_entries
    }
}
