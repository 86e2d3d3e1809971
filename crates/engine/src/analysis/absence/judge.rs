//! Is a box empty? Doubles look for a reason, integers decide whether it is one.

use super::strip::Strip;
use crate::search::complete::game;
use crate::tolerance::{DEFINITE_PIVOT, WITNESS_MARGIN};
use mceip_exact::{Rational, Sparse, positive_definite};

/// State of a slip variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum State {
    /// Not decided.
    Open,
    /// x_i = 0.
    Rest,
    /// x_i > 0, y_i = 0.
    Moving,
}

/// What to do with a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Proved to hold no solution.
    Empty,
    /// Decide this variable.
    Branch(usize),
    /// Halve it, along m or s; `hopeful` if its middle can be proved empty.
    Split {
        /// Along m rather than s.
        along_m: bool,
        /// Can the middle be proved empty?
        hopeful: bool,
    },
}

/// The condensed family at the four corners of a box, in integers times 2^m_level, and its radius.
pub(super) struct Corners {
    n: usize,
    /// (s0, m0), (s1, m0), (s0, m1), (s1, m1).
    at: [Vec<i128>; 4],
    /// At m0 and m1.
    radius: [Vec<i128>; 2],
}

/// Bits of a Farkas vector's largest weight.
const WEIGHT_BITS: f64 = 24.0;

impl Corners {
    pub(super) fn new(strip: &Strip, m: u64, m_level: u32) -> Corners {
        let mix = |zero: &[i64], one: &[i64], m: u64| -> Vec<i128> {
            let (a, b) = (i128::from((1u64 << m_level) - m), i128::from(m));
            zero.iter()
                .zip(one)
                .map(|(x, y)| a * i128::from(*x) + b * i128::from(*y))
                .collect()
        };
        let z = |e: usize, m: u64| mix(&strip.z[0][e], &strip.z[1][e], m);
        let radius = [m, m + 1].map(|m| mix(&strip.radius[0], &strip.radius[1], m));
        let at = [z(0, m), z(1, m), z(0, m + 1), z(1, m + 1)];
        let n = at[0].len().isqrt();
        Corners { n, at, radius }
    }

    pub(super) fn judge(&self, states: &[State]) -> Verdict {
        let moves: Vec<usize> = (0..self.n).filter(|&j| states[j] != State::Rest).collect();
        if moves.is_empty() {
            return Verdict::Empty; // x_s = 0, and then x_f = 0
        }
        let real: Vec<Vec<f64>> = self.at.iter().map(|m| self.reals(m)).collect();
        let either: Vec<bool> = states.iter().map(|s| *s == State::Moving).collect();
        let columns: Vec<Vec<f64>> = real
            .iter()
            .flat_map(|m| moves.iter().map(|&j| self.column(m, j)))
            .collect();
        let solved = game::solve(&either, &columns);
        if solved.value > WITNESS_MARGIN && self.is_farkas(&round(&solved.w), &moves, states) {
            return Verdict::Empty;
        }
        if (real.iter().all(|m| self.seems_definite(m, &moves, 1.0)) && self.is_definite(&moves, 1))
            || (real.iter().all(|m| self.seems_definite(m, &moves, -1.0))
                && self.is_definite(&moves, -1))
        {
            return Verdict::Empty;
        }
        let middle: Vec<f64> = (0..self.n * self.n)
            .map(|k| real.iter().map(|m| 0.25 * m[k]).sum())
            .collect();
        let columns: Vec<Vec<f64>> = moves.iter().map(|&j| self.column(&middle, j)).collect();
        let here = game::solve(&either, &columns);
        let hopeful = here.value > WITNESS_MARGIN;
        if !hopeful && let Some(i) = self.most_broken(&middle, &moves, &here.mix, states) {
            return Verdict::Branch(i);
        }
        Verdict::Split {
            along_m: self.varies_more_along_m(&real),
            hopeful,
        }
    }

    fn reals(&self, m: &[i128]) -> Vec<f64> {
        let largest = self
            .at
            .iter()
            .flatten()
            .map(|v| v.unsigned_abs())
            .max()
            .unwrap_or(1)
            .max(1) as f64;
        m.iter().map(|v| *v as f64 / largest).collect()
    }

    /// Column j, its largest entry one.
    fn column(&self, m: &[f64], j: usize) -> Vec<f64> {
        let c: Vec<f64> = (0..self.n).map(|i| m[i * self.n + j]).collect();
        let size = c.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
        c.into_iter().map(|v| v / size).collect()
    }

    /// w'G < 0 in every column that may move, at every corner with its radius; w >= 0 off the
    /// moving rows.
    fn is_farkas(&self, w: &[i64], moves: &[usize], states: &[State]) -> bool {
        let signs = (0..self.n).all(|i| w[i] >= 0 || states[i] == State::Moving);
        signs
            && (0..4).all(|corner| {
                let (m, r) = (&self.at[corner], &self.radius[corner / 2]);
                moves.iter().all(|&j| {
                    let sum = |i: usize| {
                        i128::from(w[i]) * m[i * self.n + j]
                            + i128::from(w[i].abs()) * r[i * self.n + j]
                    };
                    (0..self.n).map(sum).sum::<i128>() < 0
                })
            })
    }

    /// Cholesky in doubles of the symmetric part on the variables that may move.
    fn seems_definite(&self, m: &[f64], moves: &[usize], sign: f64) -> bool {
        let n = moves.len();
        let mut a = vec![vec![0.0; n]; n];
        for (p, &i) in moves.iter().enumerate() {
            for (q, &j) in moves.iter().enumerate() {
                a[p][q] = 0.5 * sign * (m[i * self.n + j] + m[j * self.n + i]);
            }
        }
        for k in 0..n {
            if a[k][k] <= DEFINITE_PIVOT {
                return false;
            }
            for i in k + 1..n {
                let factor = a[i][k] / a[k][k];
                for j in k + 1..n {
                    a[i][j] -= factor * a[k][j];
                }
            }
        }
        true
    }

    /// The symmetric part times sign, less its radius, is positive definite at every corner.
    fn is_definite(&self, moves: &[usize], sign: i128) -> bool {
        (0..4).all(|corner| {
            let (m, r) = (&self.at[corner], &self.radius[corner / 2]);
            let entries = moves.iter().enumerate().flat_map(|(p, &i)| {
                moves.iter().enumerate().flat_map(move |(q, &j)| {
                    let (here, mirror) = (i * self.n + j, j * self.n + i);
                    let slack = r[here] + r[mirror];
                    let value = Rational::from_integer((sign * (m[here] + m[mirror])).into());
                    [
                        (p, q, value),
                        (p, p, Rational::from_integer((-slack).into())),
                    ]
                })
            });
            positive_definite(&Sparse::from_entries(moves.len(), moves.len(), entries)).is_ok()
        })
    }

    /// The open variable whose complementarity the relaxed solution of the middle breaks most.
    fn most_broken(
        &self,
        m: &[f64],
        moves: &[usize],
        mix: &[f64],
        states: &[State],
    ) -> Option<usize> {
        let mut x = vec![0.0; self.n];
        moves.iter().zip(mix).for_each(|(&j, q)| x[j] = *q);
        let y = |i: usize| (0..self.n).map(|j| m[i * self.n + j] * x[j]).sum::<f64>();
        let open = (0..self.n).filter(|&i| states[i] == State::Open);
        open.max_by(|&i, &j| x[i].min(y(i)).total_cmp(&x[j].min(y(j))).then(j.cmp(&i)))
    }

    /// Which halving changes the corners more? The radius shrinks with s alone.
    fn varies_more_along_m(&self, real: &[Vec<f64>]) -> bool {
        let change = |a: usize, b: usize| {
            real[a]
                .iter()
                .zip(&real[b])
                .map(|(x, y)| (x - y).abs())
                .fold(0.0, f64::max)
        };
        let radius = self.reals(&self.radius[1]).into_iter().fold(0.0, f64::max);
        change(0, 2).max(change(1, 3)) > change(0, 1).max(change(2, 3)) + 4.0 * radius
    }
}

fn round(w: &[f64]) -> Vec<i64> {
    let largest = w.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
    w.iter()
        .map(|v| (v / largest * WEIGHT_BITS.exp2()).round() as i64)
        .collect()
}
