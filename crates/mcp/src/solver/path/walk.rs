//! The pivot loop: along the path from t = 0 until t = 1, a ray, a cycle or a limit.

use super::super::number::Number;
use super::super::options::RatioTest;
use super::super::tolerance::{RAY_STEP, TIE};
use super::block::Block;
use super::ratio::ratio_test;
use super::record::{Limits, Path, PathEnd, Start};
use super::tableau::Tableau;
use super::variable::{Pivot, PivotKind, Variable};

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
    pub(super) fn new(
        tableau: Tableau<'a, T>,
        limits: Limits,
        entries: &'a mut Vec<[usize; 3]>,
        path: &'a mut Path<T>,
    ) -> Self {
        entries.clear();
        entries.resize(tableau.state.z.len(), [0; 3]);
        let mut walk = Walk {
            tableau,
            limits,
            path,
            best_t: T::zero(),
            entries,
        };
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
            let Some(block) =
                ratio_test(&mut self.tableau, self.limits.rule, self.path.pivots.len())
            else {
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
        let leaving = block
            .place
            .map_or(entering, |place| self.tableau.basis.variables[place]);
        let kind = match (leaving, block.place) {
            (Variable::T, _) => PivotKind::Complete,
            (_, None) => PivotKind::Flip,
            (Variable::Artificial(_), _) => PivotKind::ArtificialLeaves,
            _ => PivotKind::Exchange,
        };
        self.path.pivots.push(Pivot {
            t: self.tableau.t.to_double(),
            entering,
            leaving,
            kind,
        });
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
        let step =
            T::from_double(RAY_STEP) * (T::one() + T::largest(&self.tableau.state.z)) / speed;
        self.tableau.advance(&step);
        self.record_knot();
    }

    fn record_knot(&mut self) {
        self.path.knots.push(
            self.tableau.t.clone(),
            &self.tableau.state.z,
            &self.tableau.state.multiplier,
        );
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

#[cfg(test)]
mod tests {
    use super::super::Subproblem;
    use super::super::tests::at_start;
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    const INF: f64 = f64::INFINITY;

    fn limits(cycle_entries: usize) -> Limits {
        Limits {
            pivots: 100,
            cycle_entries,
            rule: RatioTest::Lexicographic,
        }
    }

    /// Between the last two knots the fastest of all unknowns, also the one that moves, goes
    /// RAY_STEP (1 + |z|).
    #[test]
    fn the_point_on_a_ray_is_a_little_along_it() {
        let cases: [(DMatrix<f64>, [f64; 2]); 4] = [
            (dmatrix![-1.0, 0.0; 0.0, 1.0], [0.0, 7.0]),
            (dmatrix![-1.0, 0.0; 0.0, 1.0], [3.0, 2.0]),
            (dmatrix![-0.25, 0.0; 0.0, 1.0], [2.0, 1.0]),
            (dmatrix![-9.0, -2.0; 0.0, 1.0], [0.5, 0.0]),
        ];
        for (m, current) in cases {
            let sub = Subproblem {
                m: &m,
                q: &[-1.0, -3.0],
                lower: &[0.0; 2],
                upper: &[INF; 2],
            };
            at_start(&sub, Start::Regular, &current, |tableau| {
                let (mut path, mut entries) = (Path::default(), Vec::new());
                path.knots.clear(2);
                Walk::new(tableau, limits(9), &mut entries, &mut path).run();
                assert_eq!(path.end, PathEnd::Ray);
                let [before, last] = [path.knots.len() - 2, path.knots.len() - 1];
                let change = |a: &[f64], b: &[f64]| {
                    a.iter()
                        .zip(b)
                        .map(|(a, b)| (a - b).abs())
                        .fold(0.0, f64::max)
                };
                let [z, m] = [
                    [path.knots.z(before), path.knots.z(last)],
                    [path.knots.multiplier(before), path.knots.multiplier(last)],
                ];
                let moved = change(z[0], z[1])
                    .max(change(m[0], m[1]))
                    .max((path.knots.t(last) - path.knots.t(before)).abs());
                let size = change(z[0], &[0.0; 2]);
                approx::assert_relative_eq!(moved, RAY_STEP * (1.0 + size), max_relative = 1e-12);
            });
        }
    }

    /// Each unknown may begin to move a number of times; a t above the largest so far by more than
    /// a tie starts the counts anew.
    #[test]
    fn entries_are_counted_since_the_last_new_maximum() {
        let m = dmatrix![1.0];
        let sub = Subproblem {
            m: &m,
            q: &[-1.0],
            lower: &[0.0],
            upper: &[INF],
        };
        for start in [Start::Regular, Start::Ray] {
            at_start(&sub, start, &[2.0], |tableau| {
                let (mut path, mut entries) = (
                    Path {
                        start,
                        ..Path::default()
                    },
                    vec![[7; 3]; 9],
                );
                path.knots.clear(1);
                let mut walk = Walk::new(tableau, limits(2), &mut entries, &mut path);
                let cycles = start == Start::Regular; // from a ray there is no guard
                let mut at = |t: f64, entering: Variable| {
                    (walk.tableau.t, walk.tableau.entering) = (t, entering);
                    walk.is_cycling()
                };
                // Each slot has its own count.
                for variable in [Variable::Z(0), Variable::W(0), Variable::V(0)] {
                    assert_eq!(
                        [at(0.0, variable), at(-1.0, variable), at(0.0, variable)],
                        [false, false, cycles]
                    );
                }
                assert!(!at(0.0, Variable::T) && !at(0.0, Variable::Artificial(0)));
                assert_eq!(
                    [0.9, 1.0, 1.1].map(|share| at(share * TIE, Variable::Z(0))),
                    [cycles, cycles, false]
                );
                assert_eq!(
                    [
                        at(0.5, Variable::Z(0)),
                        at(0.25, Variable::Z(0)),
                        at(0.5, Variable::Z(0))
                    ],
                    [false, false, cycles]
                );
            });
        }
    }

    /// As many pivots as the limit says, and no more.
    #[test]
    fn a_path_ends_at_its_limit_of_pivots() {
        let m = dmatrix![2.0, 1.0; 1.0, 2.0];
        let sub = Subproblem {
            m: &m,
            q: &[-5.0, -6.0],
            lower: &[0.0; 2],
            upper: &[INF; 2],
        };
        let ends = |pivots: usize| {
            at_start(&sub, Start::Ray, &[0.0; 2], |tableau| {
                let (mut path, mut entries) = (
                    Path {
                        start: Start::Ray,
                        ..Path::default()
                    },
                    Vec::new(),
                );
                path.knots.clear(2);
                Walk::new(
                    tableau,
                    Limits {
                        pivots,
                        ..limits(9)
                    },
                    &mut entries,
                    &mut path,
                )
                .run();
                (path.end, path.pivots.len(), path.knots.len())
            })
        };
        let (end, needed, _) = ends(100);
        assert_eq!((end, needed), (PathEnd::Complete, 3));
        for pivots in 0..needed {
            assert_eq!(ends(pivots), (PathEnd::PivotLimit, pivots, pivots + 1));
        }
        assert_eq!(ends(needed).0, PathEnd::Complete);
    }
}
