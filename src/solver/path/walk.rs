//! The pivot loop: along the path from t = 0 until t = 1, a ray, a cycle or a limit.

use super::super::RatioTest;
use super::super::tolerance::{RAY_STEP, TIE};
use super::number::Number;
use super::ratio::{Block, ratio_test};
use super::tableau::Tableau;
use super::variable::{Pivot, PivotKind, Variable};
use super::{Limits, Path, PathEnd, Start};

/// A path under way.
pub(super) struct Walk<'a, T: Number> {
    tableau: Tableau<'a, T>,
    limits: Limits,
    path: &'a mut Path<T>,
    best_t: T,
    /// Times each unknown has begun to move since the last new maximum of t: Z, W, V of each index.
    entries: &'a mut Vec<[usize; 3]>,
}

impl<'a, T: Number> Walk<'a, T> {
    pub(super) fn new(tableau: Tableau<'a, T>, limits: Limits, entries: &'a mut Vec<[usize; 3]>, path: &'a mut Path<T>) -> Self {
        entries.clear();
        entries.resize(tableau.state.z.len(), [0; 3]);
        let mut walk = Walk { tableau, limits, path, best_t: T::zero(), entries };
        walk.record_knot();
        walk
    }

    /// Walks to the end.
    pub(super) fn run(mut self) {
        self.path.end = self.pivot_until_end();
        self.path.factorisations += self.tableau.basis.refreshed;
    }

    fn pivot_until_end(&mut self) -> PathEnd {
        while self.path.pivots.len() < self.limits.pivots {
            self.tableau.set_rates();
            let Some(block) = ratio_test(&mut self.tableau, self.limits.rule, self.path.pivots.len()) else {
                self.step_along_ray();
                return PathEnd::Ray;
            };
            self.tableau.advance(&block.step);
            self.record_knot();
            if let Some(end) = self.turn(&block) {
                return end;
            }
        }
        PathEnd::PivotLimit
    }

    /// At a breakpoint: complete, flip or exchange.
    fn turn(&mut self, block: &Block<T>) -> Option<PathEnd> {
        let entering = self.tableau.entering;
        let leaving = block.place.map_or(entering, |place| self.tableau.basis.variables[place]);
        let kind = match (leaving, block.place) {
            (Variable::T, _) => PivotKind::Complete,
            (_, None) => PivotKind::Flip,
            (Variable::Artificial(_), _) => PivotKind::ArtificialLeaves,
            _ => PivotKind::Exchange,
        };
        self.path.pivots.push(Pivot { t: self.tableau.t.to_double(), entering, leaving, kind });
        match block.place {
            _ if kind == PivotKind::Complete => return Some(self.complete()),
            None => self.tableau.flip(),
            Some(place) => {
                if !self.tableau.exchange(place, block.at_upper) {
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
        self.path.knots.set_last_t(T::one());
        if let Some(last) = self.path.pivots.last_mut() {
            last.t = 1.0;
        }
        PathEnd::Complete
    }

    /// A point a little along the ray, as the last knot.
    fn step_along_ray(&mut self) {
        let speed = T::largest(&self.tableau.state.rates).larger(T::one());
        let step = T::from_double(RAY_STEP) * (T::one() + T::largest(&self.tableau.state.z)) / speed;
        self.tableau.advance(&step);
        self.record_knot();
    }

    fn record_knot(&mut self) {
        self.path.knots.push(self.tableau.t.clone(), &self.tableau.state.z, &self.tableau.state.multiplier);
    }

    /// Counts how often each unknown begins to move; the counts restart at each new maximum of t.
    /// A ray start has no guard: its lexicographic order excludes cycles.
    fn is_cycling(&mut self) -> bool {
        if self.path.start == Start::Ray {
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
