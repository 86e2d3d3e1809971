//! Witnesses that a region is empty: Farkas vectors in short integers, definite symmetric parts.

use crate::search::complete::game::{self, Game};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::pieces::view::{Ends, Matrix};
use crate::search::complete::region::State;
use crate::tolerance::{CONDENSED_MARGIN, DEFINITE_PIVOT, THIN_MARGIN, WITNESS_MARGIN};

/// Bits tried for the weights, shortest first.
const WEIGHT_BITS: [i32; 5] = [8, 14, 20, 30, 44];

/// The columns of T that may move, at one or both ends, each divided by its largest entry.
pub(crate) struct Columns {
    list: Vec<Vec<f64>>,
    /// Position of each column's variable.
    pub(crate) variable: Vec<usize>,
    /// Radius of each column relative to the same entry: w'T may be larger by |w|'radius.
    radius: Vec<Option<Vec<f64>>>,
    /// What each column was multiplied by.
    unit: Vec<f64>,
    /// Is a column's end infinite, where <= 0 suffices?
    weak: Vec<bool>,
}

impl Columns {
    /// Of one matrix with its radius, for the test at a point.
    pub(crate) fn at(m: &Matrix, r: Option<&Matrix>, states: &[State]) -> Columns {
        let mut columns = Columns {
            list: Vec::new(),
            variable: Vec::new(),
            radius: Vec::new(),
            unit: Vec::new(),
            weak: Vec::new(),
        };
        columns.add(m, r, states, false);
        columns
    }

    /// Of both ends of an interval.
    pub(crate) fn of(ends: &Ends, states: &[State]) -> Columns {
        let mut columns = Columns {
            list: Vec::new(),
            variable: Vec::new(),
            radius: Vec::new(),
            unit: Vec::new(),
            weak: Vec::new(),
        };
        columns.add(&ends.m[0], ends.r.as_ref(), states, false);
        columns.add(&ends.m[1], ends.r.as_ref(), states, ends.hi.is_infinite());
        columns
    }

    fn add(&mut self, m: &Matrix, r: Option<&Matrix>, states: &[State], weak: bool) {
        for j in (0..states.len()).filter(|&j| states[j] != State::Rest) {
            let column: Vec<f64> = m.iter().map(|row| row[j]).collect();
            let largest = column.iter().fold(0.0f64, |s, v| s.max(v.abs()));
            let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
            let scaled = |c: Vec<f64>| c.into_iter().map(|v| v * unit).collect::<Vec<_>>();
            self.list.push(scaled(column));
            self.variable.push(j);
            self.radius
                .push(r.map(|r| scaled(r.iter().map(|row| row[j]).collect())));
            self.unit.push(unit);
            self.weak.push(weak);
        }
    }

    /// The game on these columns. Where the end is infinite the columns are lowered by twice the
    /// margin, so that an entry of zero does not stand in the way.
    pub(crate) fn play(&self, states: &[State]) -> Game {
        let either: Vec<bool> = states.iter().map(|s| *s == State::Moving).collect();
        let lower = |c: &Vec<f64>, w: &bool| {
            if *w {
                c.iter().map(|v| v - 2.0 * WITNESS_MARGIN).collect()
            } else {
                c.clone()
            }
        };
        let list: Vec<Vec<f64>> = self
            .list
            .iter()
            .zip(&self.weak)
            .map(|(c, w)| lower(c, w))
            .collect();
        game::solve(&either, &list)
    }

    /// Rounds the weights to short integers that still prove what they are to prove.
    pub(crate) fn round(&self, w: &[f64]) -> Option<Vec<i64>> {
        let largest = w.iter().fold(0.0f64, |s, v| s.max(v.abs()));
        if largest == 0.0 {
            return self.list.is_empty().then(|| vec![0; w.len()]);
        }
        WEIGHT_BITS.iter().find_map(|bits| {
            let unit = (f64::from(*bits)).exp2() / largest;
            let rounded: Vec<f64> = w.iter().map(|v| (v * unit).round()).collect();
            self.holds(&rounded)
                .then(|| rounded.iter().map(|v| *v as i64).collect())
        })
    }

    /// What is left of the game's value once the radius has been taken off.
    pub(crate) fn margin(&self, game: &Game) -> f64 {
        let around = |r: &Option<Vec<f64>>| {
            r.as_ref().map_or(0.0, |r| {
                r.iter().zip(&game.w).map(|(r, w)| r * w.abs()).sum()
            })
        };
        let of = |(c, r): (&Vec<f64>, &Option<Vec<f64>>)| -dot(c, &game.w) - around(r);
        if self.radius.iter().all(Option::is_none) {
            game.value
        } else {
            self.list
                .iter()
                .zip(&self.radius)
                .map(of)
                .fold(f64::INFINITY, f64::min)
        }
    }

    /// Every entry of w'T is negative by a margin (at an infinite end: not positive).
    fn holds(&self, w: &[f64]) -> bool {
        let size: f64 = w.iter().map(|v| v.abs()).sum();
        // Doubles know a condensed pencil less well than a given one.
        let least = 0.1
            * if self.radius.iter().all(Option::is_none) {
                THIN_MARGIN
            } else {
                CONDENSED_MARGIN
            };
        self.list
            .iter()
            .zip(&self.radius)
            .zip(&self.weak)
            .all(|((c, r), weak)| {
                let around: f64 = r
                    .as_ref()
                    .map_or(0.0, |r| r.iter().zip(w).map(|(r, w)| r * w.abs()).sum());
                let bound = dot(c, w) + around;
                // Products that are zero one by one are an exact zero, whatever the rounding.
                let exact_zero =
                    *weak && around == 0.0 && c.iter().zip(w).all(|(c, w)| c * w == 0.0);
                bound < -least * size || exact_zero
            })
    }

    /// Part [a, b] of [0, 1] around `from` on which w still works on the chord between the ends.
    pub(crate) fn range(&self, w: &[f64], from: f64) -> Option<(f64, f64)> {
        let half = self.list.len() / 2;
        let size: f64 = w.iter().map(|v| v.abs()).sum();
        let (mut a, mut b) = (0.0f64, 1.0f64);
        for j in 0..half {
            let value = |k: usize| {
                let around: f64 = self.radius[k]
                    .as_ref()
                    .map_or(0.0, |r| r.iter().zip(w).map(|(r, w)| r * w.abs()).sum());
                dot(&self.list[k], w) + around + WITNESS_MARGIN * size
            };
            // Columns are divided by their largest entries: undo the quotient of the two.
            let (v0, v1) = (
                value(j) / self.unit[j],
                value(j + half) / self.unit[j + half],
            );
            if v0 + from * (v1 - v0) > 0.0 {
                return None;
            }
            if v0 > 0.0 {
                a = a.max(v0 / (v0 - v1));
            }
            if v1 > 0.0 {
                b = b.min(v0 / (v0 - v1));
            }
        }
        (a < from && from < b).then_some((a, b))
    }
}

/// Is the symmetric part exactly zero on what may move? Enough at an infinite end.
pub(crate) fn vanishes(m: &Matrix, states: &[State]) -> bool {
    let may_move = |i: &usize| states[*i] != State::Rest;
    (0..states.len()).filter(may_move).all(|i| {
        (0..states.len())
            .filter(may_move)
            .all(|j| m[i][j] + m[j][i] == 0.0)
    })
}

/// Is `sign` sym(m) definite on what may move, with a margin?
pub(crate) fn definite(m: &Matrix, r: Option<&Matrix>, states: &[State], sign: f64) -> bool {
    let moving: Vec<usize> = (0..states.len())
        .filter(|&i| states[i] != State::Rest)
        .collect();
    let n = moving.len();
    let mut s: Matrix = moving
        .iter()
        .map(|&i| moving.iter().map(|&j| sign * (m[i][j] + m[j][i])).collect())
        .collect();
    let largest = s.iter().flatten().fold(0.0f64, |s, v| s.max(v.abs()));
    if let Some(r) = r {
        for (p, &i) in moving.iter().enumerate() {
            s[p][p] -= moving.iter().map(|&j| r[i][j] + r[j][i]).sum::<f64>();
        }
    }
    let least = DEFINITE_PIVOT * largest;
    for k in 0..n {
        if s[k][k] <= least {
            return false;
        }
        let (upper, lower) = s.split_at_mut(k + 1);
        let pivot = &upper[k];
        for row in lower {
            let factor = row[k] / pivot[k];
            for j in k + 1..n {
                row[j] -= factor * pivot[j];
            }
        }
    }
    true
}
