//! The f64 view of the family of matrices that the checker encloses, row for row in the same scale.

use crate::tolerance::CONDENSATION_NOISE;
use mceip_exact::{Integer, Rational, common_denominator, to_f64};
use mceip_model::Pencil;
use num_traits::One;

/// A dense square matrix by rows.
pub(crate) type Matrix = Vec<Vec<f64>>;

/// The pencil on the complementarity variables: one polynomial matrix, or several about their
/// centres.
pub(crate) struct View {
    /// Complementarity variables by position.
    pub(crate) index: Vec<usize>,
    /// Scale of the unknown: |A| / |B|.
    pub(crate) scale: f64,
    pub(crate) expansions: Vec<Expansion>,
}

/// Z(d) +- weight_i |l_i(d)| |r_j(d)|, d = t - center.
#[derive(Clone)]
pub(crate) struct Expansion {
    pub(crate) center: f64,
    pub(crate) z: Vec<Matrix>,
    pub(crate) left: Vec<Vec<f64>>,
    pub(crate) right: Vec<Vec<f64>>,
    pub(crate) weight: Vec<f64>,
    /// At t the weights are divided by 1 + gain t.
    pub(crate) gain: f64,
    /// |V_i| and the rounding in |r_j|, coefficient by coefficient.
    pub(crate) v: Vec<Vec<f64>>,
    pub(crate) rounding: Vec<Vec<f64>>,
    /// What the remainder, itself computed in doubles, is multiplied by.
    pub(crate) caution: f64,
    /// W_k by columns: x_f = -W(d) x_s.
    pub(crate) free: Vec<Vec<Vec<f64>>>,
    /// Is this T(t) / t in powers of 1 / t - center?
    pub(crate) reversed: bool,
}

/// Both ends of an interval, the radius around the chord between them.
pub(crate) struct Ends {
    pub(crate) lo: f64,
    /// Infinite for an unbounded interval, whose m[1] is the direction B.
    pub(crate) hi: f64,
    pub(crate) m: [Matrix; 2],
    /// `None` where the chord is exact.
    pub(crate) r: Option<Matrix>,
    /// (hi - lo) T' lies within this of m[1] - m[0]; `None` likewise.
    pub(crate) slope: Option<Matrix>,
}

impl View {
    /// The expansion of a piece with this anchor. Without a condensation there is one, and anchors
    /// are ignored.
    pub(crate) fn expansion(&self, anchor: Option<usize>) -> &Expansion {
        let named = anchor.and_then(|k| self.expansions.get(k));
        named.unwrap_or(&self.expansions[0])
    }

    /// The view of a pencil without free variables.
    pub(crate) fn of(pencil: &Pencil) -> View {
        let n = pencil.order();
        let (mut a, mut b) = (vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]);
        for i in 0..n {
            let factor = row_factor(pencil, i);
            for (m, row) in [(&mut a, pencil.a().row(i)), (&mut b, pencil.b().row(i))] {
                row.iter()
                    .for_each(|(j, v)| m[i][*j] = to_f64(&(v * &factor)));
            }
        }
        let expansion = Expansion::linear(a, b);
        View {
            index: (0..n).collect(),
            scale: scale(&expansion.z),
            expansions: vec![expansion],
        }
    }

    pub(crate) fn order(&self) -> usize {
        self.index.len()
    }

    /// Position of t in [0, 1]: t / (scale + t).
    pub(crate) fn theta(&self, t: f64) -> f64 {
        if t.is_infinite() {
            1.0
        } else {
            t / (self.scale + t)
        }
    }

    /// The value at a position.
    pub(crate) fn value(&self, theta: f64) -> f64 {
        self.scale * theta / (1.0 - theta)
    }
}

/// What the checker multiplies row i by: denominators cleared, largest entry of A below one.
pub(crate) fn row_factor(pencil: &Pencil, i: usize) -> Rational {
    let (a, b) = (pencil.a().row(i), pencil.b().row(i));
    let clear = common_denominator(a.iter().chain(b).map(|(_, v)| v));
    let bits = a
        .iter()
        .map(|(_, v)| (v.numer() * (&clear / v.denom())).bits())
        .max()
        .unwrap_or(0)
        .max(1);
    Rational::new(clear, Integer::one() << bits)
}

pub(crate) fn scale(z: &[Matrix]) -> f64 {
    let largest = |m: &Matrix| m.iter().flatten().fold(0.0f64, |s, v| s.max(v.abs()));
    let (a, b) = (largest(&z[0]), largest(&z[1]));
    if a > 0.0 && b > 0.0 && (a / b).is_finite() {
        a / b
    } else {
        1.0
    }
}

impl Expansion {
    /// What the expansion is in: the value, or its reciprocal.
    fn argument(&self, t: f64) -> f64 {
        if self.reversed { 1.0 / t } else { t }
    }

    /// T(t), the remainder left out.
    pub(crate) fn at(&self, t: f64) -> Matrix {
        self.polynomial(self.argument(t))
    }

    fn polynomial(&self, s: f64) -> Matrix {
        let d = s - self.center;
        let mut out = self.zero();
        for z in self.z.iter().rev() {
            for (o, v) in out.iter_mut().flatten().zip(z.iter().flatten()) {
                *o = *o * d + v;
            }
        }
        out
    }

    /// The chord between two matrices, from 0 to 1.
    pub(crate) fn line(ends: &[Matrix; 2]) -> Expansion {
        let slope = ends[0]
            .iter()
            .zip(&ends[1])
            .map(|(a, b)| a.iter().zip(b).map(|(a, b)| b - a).collect())
            .collect();
        Expansion::linear(ends[0].clone(), slope)
    }

    /// A + tB itself.
    fn linear(a: Matrix, b: Matrix) -> Expansion {
        Expansion {
            center: 0.0,
            z: vec![a, b],
            left: Vec::new(),
            right: Vec::new(),
            weight: Vec::new(),
            gain: 0.0,
            v: Vec::new(),
            rounding: Vec::new(),
            caution: 1.0,
            free: Vec::new(),
            reversed: false,
        }
    }

    /// The same without its remainder: to look for solutions, not to prove anything.
    pub(crate) fn without_remainder(&self) -> Expansion {
        Expansion {
            left: Vec::new(),
            right: Vec::new(),
            v: Vec::new(),
            rounding: Vec::new(),
            ..self.clone()
        }
    }

    /// Is this the pencil itself, valid for every value?
    pub(crate) fn is_everywhere(&self) -> bool {
        self.free.is_empty()
    }

    /// The free variables that belong to x_s at t; `None` where there are none.
    pub(crate) fn free_part(&self, t: f64, x: &[f64]) -> Option<Vec<f64>> {
        let d = self.argument(t) - self.center;
        let mut out = vec![0.0; self.free.first()?.first()?.len()];
        for w in self.free.iter().rev() {
            out.iter_mut().for_each(|o| *o *= d);
            for (column, x_j) in w.iter().zip(x) {
                out.iter_mut().zip(column).for_each(|(o, c)| *o -= c * x_j);
            }
        }
        Some(out)
    }

    /// dT/dt, the remainder left out.
    pub(crate) fn derivative(&self, t: f64) -> Matrix {
        let d = self.argument(t) - self.center;
        let chain = if self.reversed { -1.0 / (t * t) } else { 1.0 };
        let mut out = self.zero();
        for (k, z) in self.z.iter().enumerate().skip(1).rev() {
            for (o, v) in out.iter_mut().flatten().zip(z.iter().flatten()) {
                *o = *o * d + k as f64 * v;
            }
        }
        out.iter_mut().flatten().for_each(|v| *v *= chain);
        out
    }

    fn zero(&self) -> Matrix {
        vec![vec![0.0; self.z[0].len()]; self.z[0].len()]
    }

    /// The ends over [lo, hi] as the checker will see them.
    pub(crate) fn ends(&self, lo: f64, hi: f64) -> Ends {
        if !self.reversed {
            return self.between(lo, hi);
        }
        let ends = self.between(1.0 / hi, 1.0 / lo);
        let [m1, m0] = ends.m;
        Ends {
            lo,
            hi,
            m: [m0, m1],
            ..ends
        }
    }

    fn between(&self, lo: f64, hi: f64) -> Ends {
        if hi.is_infinite() {
            return Ends {
                lo,
                hi,
                m: [self.polynomial(lo), self.z[1].clone()],
                r: None,
                slope: None,
            };
        }
        let lower = self.polynomial(lo);
        let m = [
            lower.clone(),
            if lo == hi { lower } else { self.polynomial(hi) },
        ];
        let exact = self.z.len() <= 2 && self.weight.is_empty();
        if exact {
            return Ends {
                lo,
                hi,
                m,
                r: None,
                slope: None,
            };
        }
        let (reach, width) = (
            (lo - self.center).abs().max((hi - self.center).abs()),
            hi - lo,
        );
        let mut bend = self.zero();
        for (k, z) in self.z.iter().enumerate().skip(2).rev() {
            for (o, v) in bend.iter_mut().flatten().zip(z.iter().flatten()) {
                *o = *o * reach + (k * (k - 1)) as f64 * v.abs() * width * width;
            }
        }
        let norm =
            |list: &[Vec<f64>], i: usize| list.iter().rev().fold(0.0, |s, l| s * reach + l[i]);
        let n = self.z[0].len();
        // The z_k themselves come from long sums of terms below one in doubles.
        let size: f64 = m
            .iter()
            .flatten()
            .flatten()
            .fold(1.0, |s, v| s.max(v.abs()));
        let (l, r): (Vec<f64>, Vec<f64>) = (0..n)
            .map(|i| {
                (
                    norm(&self.left, i) * self.weight[i] / (1.0 + self.gain * lo),
                    norm(&self.right, i),
                )
            })
            .unzip();
        let (v, q): (Vec<f64>, Vec<f64>) = (0..n)
            .map(|i| (norm(&self.v, i), norm(&self.rounding, i)))
            .unzip();
        let remainder = |i: usize, j: usize| {
            self.caution * (l[i] * r[j] + v[i] * q[j] + CONDENSATION_NOISE * size)
        };
        let r = (0..n)
            .map(|i| (0..n).map(|j| bend[i][j] / 8.0 + remainder(i, j)).collect())
            .collect();
        // The remainder's slope is at most a few times remainder / width where it matters; the
        // exact check decides.
        let slope = (0..n)
            .map(|i| (0..n).map(|j| bend[i][j] + 4.0 * remainder(i, j)).collect())
            .collect();
        Ends {
            lo,
            hi,
            m,
            r: Some(r),
            slope: Some(slope),
        }
    }
}
