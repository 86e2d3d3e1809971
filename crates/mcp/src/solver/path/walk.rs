//! The pivot loop: along the path from t = 0 until t = 1, a ray, a cycle or a limit.
//!
//! The equations that hold along the path, with the multipliers w and v and the artificials, stand
//! in the module `path`. At t = 1 the residual of the start has left them, so that the point there
//! solves the linear problem. t has the upper bound 1 and no lower one: it leaves the basis only at
//! the end of the path.
//!
//! Each round moves the entering unknown to the first bound that is met (`ratio`), records the
//! knot, and turns there: the path is complete, or the entering unknown flips, or it is exchanged
//! for the one that has stopped it (`tableau`).

use super::super::number::PathNumber;
use super::super::options::RatioTest;
use super::super::tolerance::{RAY_STEP, TIE};
use super::block::BlockingVariable;
use super::ratio::ratio_test;
use super::record::{Path, PathEnd, PathLimits, Start};
use super::tableau::PathTableau;
use super::variable::{Pivot, PivotKind, Variable};

/// How often the unknowns of one index have begun to move since the last new maximum of t.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct EntryCounts {
    z: usize,
    w: usize,
    v: usize,
}

/// A path under way.
pub(super) struct PathWalk<'a, T: PathNumber> {
    tableau: PathTableau<'a, T>,
    limits: PathLimits,
    path: &'a mut Path<T>,
    best_t: T,
    /// By index.
    entries: &'a mut Vec<EntryCounts>,
}

impl<'a, T: PathNumber> PathWalk<'a, T> {
    /// At the start of the tableau, which becomes the first knot.
    pub(super) fn new(
        tableau: PathTableau<'a, T>,
        limits: PathLimits,
        entries: &'a mut Vec<EntryCounts>,
        path: &'a mut Path<T>,
    ) -> Self {
        entries.clear();
        entries.resize(tableau.state.z.len(), EntryCounts::default());
        let mut walk = PathWalk {
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

    /// Pivots until there is a reason to stop.
    fn pivot_until_end(&mut self) -> PathEnd {
        while self.path.pivots.len() < self.limits.pivots {
            self.tableau.set_rates();
            let pivots = self.path.pivots.len();
            let Some(block) = ratio_test(&mut self.tableau, self.limits.rule, pivots) else {
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
    fn turn(&mut self, block: &BlockingVariable<T>) -> Option<PathEnd> {
        let kind = self.record_pivot(block);
        if kind == PivotKind::Complete {
            return Some(self.complete());
        }

        match block.place {
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

    /// Records what the block leads to; returns its kind.
    fn record_pivot(&mut self, block: &BlockingVariable<T>) -> PivotKind {
        let entering = self.tableau.entering;
        let leaving = match block.place {
            Some(place) => self.tableau.basis.variables[place],
            None => entering,
        };
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

        kind
    }

    /// The last knot stands at t = 1 exactly.
    fn complete(&mut self) -> PathEnd {
        self.path.knots.set_last_t(T::one());
        if let Some(last) = self.path.pivots.last_mut() {
            last.t = 1.0;
        }

        PathEnd::Complete
    }

    /// A point a little along the ray, as the last knot: no component moves by more than
    /// RAY_STEP (1 + |z|). The rates are those of the basic unknowns while the entering one moves
    /// at rate 1.
    fn step_along_ray(&mut self) {
        let speed = T::largest(&self.tableau.state.rates).larger(T::one());
        let size = T::one() + T::largest(&self.tableau.state.z);
        let step = T::from_double(RAY_STEP) * size / speed;
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
    ///
    /// A ray start has no such guard: in lexicographic order no basis repeats, and with the other
    /// ratio test the pivot limit ends a cycle.
    fn is_cycling(&mut self) -> bool {
        if self.path.start == Start::Ray {
            return false;
        }

        if self.tableau.t > self.best_t.clone() + T::tolerance(TIE) {
            self.best_t = self.tableau.t.clone();
            self.entries.fill(EntryCounts::default());
        }

        let count = match self.tableau.entering {
            Variable::Z(i) => &mut self.entries[i].z,
            Variable::W(i) => &mut self.entries[i].w,
            Variable::V(i) => &mut self.entries[i].v,
            Variable::Artificial(_) | Variable::T => return false,
        };

        *count += 1;
        *count > self.limits.cycle_entries
    }
}

#[cfg(test)]
mod tests {
    use super::super::Subproblem;
    use super::super::tests::at_start;
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    const INF: f64 = f64::INFINITY;

    fn limits(cycle_entries: usize) -> PathLimits {
        PathLimits {
            pivots: 100,
            cycle_entries,
            rule: RatioTest::Lexicographic,
        }
    }

    /// The largest difference of two components.
    fn distance(a: &[f64], b: &[f64]) -> f64 {
        let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
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
                let mut path = Path::default();
                path.begin(Start::Regular, 2);
                PathWalk::new(tableau, limits(9), &mut Vec::new(), &mut path).run();

                assert_eq!(path.end, PathEnd::Ray);

                let knots = &path.knots;
                let last = knots.len() - 1;
                let before = last - 1;
                let z = distance(knots.z(before), knots.z(last));
                let multipliers = distance(knots.multiplier(before), knots.multiplier(last));
                let t = (knots.t(last) - knots.t(before)).abs();
                let moved = z.max(multipliers).max(t);
                let size = distance(knots.z(before), &[0.0; 2]);

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
                let mut path = Path::default();
                path.begin(start, 1);

                // Counts that another path has left behind.
                let left = EntryCounts { z: 7, w: 7, v: 7 };
                let mut entries = vec![left; 9];
                let mut walk = PathWalk::new(tableau, limits(2), &mut entries, &mut path);
                let cycles = start == Start::Regular; // from a ray there is no guard
                let mut at = |t: f64, entering: Variable| {
                    walk.tableau.t = t;
                    walk.tableau.entering = entering;
                    walk.is_cycling()
                };

                // Each slot has its own count.
                for variable in [Variable::Z(0), Variable::W(0), Variable::V(0)] {
                    assert!(!at(0.0, variable));
                    assert!(!at(-1.0, variable));
                    assert_eq!(at(0.0, variable), cycles);
                }

                assert!(!at(0.0, Variable::T));
                assert!(!at(0.0, Variable::Artificial(0)));
                assert_eq!(
                    [0.9, 1.0, 1.1].map(|share| at(share * TIE, Variable::Z(0))),
                    [cycles, cycles, false]
                );
                assert!(!at(0.5, Variable::Z(0)));
                assert!(!at(0.25, Variable::Z(0)));
                assert_eq!(at(0.5, Variable::Z(0)), cycles);
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
                let mut path = Path::default();
                path.begin(Start::Ray, 2);
                let limits = PathLimits {
                    pivots,
                    ..limits(9)
                };
                PathWalk::new(tableau, limits, &mut Vec::new(), &mut path).run();
                (path.end, path.pivots.len(), path.knots.len())
            })
        };
        let (end, needed, _) = ends(100);

        assert_eq!(end, PathEnd::Complete);
        assert_eq!(needed, 3);

        for pivots in 0..needed {
            assert_eq!(ends(pivots), (PathEnd::PivotLimit, pivots, pivots + 1));
        }

        assert_eq!(ends(needed).0, PathEnd::Complete);
    }
}
