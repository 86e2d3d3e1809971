//! Leaves with one null vector: where it is, and the numbers that let the checker see that.

use crate::search::complete::pieces::view::{Ends, Expansion, Matrix};
use crate::search::complete::region::State;
use crate::tolerance::{ROOT_HALF_WIDTHS, ROUNDING};
use mceip_check::certificate::{Root, RootOutcome};
use mceip_exact::{Integer, Rational, from_f64, truncated};
use mceip_mcp::linear::{inverse, solve};
use mceip_model::file::Number;
use num_traits::One;

/// Newton steps on the nonlinear eigenproblem.
const NEWTON_STEPS: usize = 40;
/// Steps of plain inverse iteration before the value is moved, tried one after the other. A value
/// far above the others has u'Bv so small that what the first vectors have of other null vectors
/// throws Newton's first step far off.
const SETTLING_STEPS: [usize; 2] = [0, 2];
/// Exponent of the null vectors.
const VECTOR_BITS: u32 = 56;
/// Bits tried for the inverse's largest entry.
const INVERSE_BITS: [i32; 4] = [12, 20, 30, 44];

/// A null vector of T on the moving set and its value.
pub(crate) struct Null {
    pub(crate) value: f64,
    moving: Vec<usize>,
    left: Vec<f64>,
    pub(crate) right: Vec<f64>,
}

/// Newton's method from the middle of [lo, hi] for T(t) v = 0 on the moving set, kept if it ends
/// within the interval enlarged by half. (Nonlinear inverse iteration, Unger 1950; Ruhe 1973.)
pub(crate) fn null_vector(
    expansion: &Expansion,
    states: &[State],
    lo: f64,
    hi: f64,
) -> Option<Null> {
    SETTLING_STEPS
        .iter()
        .find_map(|settling| iterate(expansion, states, lo, hi, *settling))
}

fn iterate(
    expansion: &Expansion,
    states: &[State],
    lo: f64,
    hi: f64,
    settling: usize,
) -> Option<Null> {
    let moving: Vec<usize> = (0..states.len())
        .filter(|&i| states[i] == State::Moving)
        .collect();
    let n = moving.len();
    let (mut t, mut left, mut right) = (lo + 0.47 * (hi - lo), vec![1.0; n], vec![1.0; n]);
    let reach = hi - lo;
    for step in 0..NEWTON_STEPS {
        let (m, d) = (
            sub(&expansion.at(t), &moving),
            sub(&expansion.derivative(t), &moving),
        );
        // A singular factorisation means that t is the value, to rounding: move off a little.
        let solved = |m: &Matrix, right: Vec<f64>| solve(m, &[right]).map(|mut c| c.swap_remove(0));
        let (Some(v), Some(u)) = (
            solved(&m, times(&d, &right)),
            solved(&transpose(&m), times(&transpose(&d), &left)),
        ) else {
            t += ROUNDING * (t.abs() + reach);
            continue;
        };
        (right, left) = (normalised(v)?, normalised(u)?);
        if step < settling {
            continue;
        }
        let slope = bilinear(&left, &d, &right);
        let correction = bilinear(&left, &m, &right) / slope;
        t -= correction;
        if !t.is_finite() || t < lo - 0.5 * reach || t > hi + 0.5 * reach {
            return None;
        }
        if correction.abs() <= 4.0 * f64::EPSILON * t.abs().max(reach) {
            break;
        }
    }
    Some(Null {
        value: t,
        moving,
        left,
        right,
    })
}

impl Null {
    /// The witness that this is the only null vector over `wide`, which contains the leaf; `None`
    /// where it is not to be had.
    pub(crate) fn unique(&self, wide: &Ends) -> Option<Unique> {
        let mut order: Vec<usize> = (0..self.moving.len()).collect();
        let weight = |p: &usize| (self.left[*p] * self.right[*p]).abs();
        order.sort_by(|p, q| weight(q).total_cmp(&weight(p)));
        order
            .into_iter()
            .take(3)
            .find_map(|p| Unique::new(self, p, wide))
    }

    /// Length of x as a candidate over all positions.
    pub(crate) fn spread(&self, n: usize) -> Vec<f64> {
        let mut x = vec![0.0; n];
        let sign = if self.right.iter().sum::<f64>() < 0.0 {
            -1.0
        } else {
            1.0
        };
        self.moving
            .iter()
            .zip(&self.right)
            .for_each(|(&i, v)| x[i] = sign * v);
        x
    }
}

/// A pivot with Y, u and v that prove uniqueness over an interval.
pub(crate) struct Unique {
    rest: Vec<usize>,
    pivot: usize,
    y: Vec<Vec<Integer>>,
    y_bits: u32,
    u: Vec<f64>,
    v: Vec<f64>,
}

impl Unique {
    fn new(null: &Null, p: usize, wide: &Ends) -> Option<Unique> {
        let pivot = null.moving[p];
        let rest: Vec<usize> = null
            .moving
            .iter()
            .copied()
            .filter(|&i| i != pivot)
            .collect();
        let of = |list: &[f64]| -> Vec<f64> {
            null.moving
                .iter()
                .zip(list)
                .filter(|(i, _)| **i != pivot)
                .map(|(_, v)| v / list[p])
                .collect()
        };
        let (u, v) = (of(&null.left), of(&null.right));
        let middle: Matrix = rest
            .iter()
            .map(|&i| {
                rest.iter()
                    .map(|&j| 0.5 * (wide.m[0][i][j] + wide.m[1][i][j]))
                    .collect()
            })
            .collect();
        let exact = if rest.is_empty() {
            Vec::new()
        } else {
            inverse(&middle)?
        };
        let largest = exact.iter().flatten().fold(0.0f64, |s, v| s.max(v.abs()));
        INVERSE_BITS.iter().find_map(|bits| {
            // Of one moving variable nothing is left to invert, and an empty Y needs no units.
            let y_bits = if rest.is_empty() {
                0
            } else {
                u32::try_from(bits - largest.max(f64::MIN_POSITIVE).log2().ceil() as i32)
                    .unwrap_or(0)
            };
            let unit = f64::from(y_bits).exp2();
            let y: Matrix = exact
                .iter()
                .map(|row| row.iter().map(|v| (v * unit).round() / unit).collect())
                .collect();
            let proof = Bounds::new(wide, &rest, pivot, &y, &u, &v);
            proof
                .is_some_and(|b| b.monotone(wide, &rest, pivot, &u, &v))
                .then(|| {
                    let y = y
                        .iter()
                        .map(|row| row.iter().map(|v| integer(v * unit)).collect())
                        .collect();
                    Unique {
                        rest: rest.clone(),
                        pivot,
                        y,
                        y_bits,
                        u: u.clone(),
                        v: v.clone(),
                    }
                })
        })
    }

    /// The certificate's form; `index` gives the problem's numbers, `window` what the value must
    /// stay in.
    pub(crate) fn witness(
        &self,
        index: &[usize],
        interval: [Rational; 2],
        outcome: RootOutcome,
    ) -> Root {
        let fixed = |list: &[f64]| {
            list.iter()
                .map(|v| integer(v * f64::from(VECTOR_BITS).exp2()))
                .collect()
        };
        Root {
            pivot: index[self.pivot],
            interval: interval.map(Number),
            inverse: self.y.clone(),
            inverse_exponent: self.y_bits,
            left: fixed(&self.u),
            right: fixed(&self.v),
            exponent: VECTOR_BITS,
            outcome,
        }
    }

    /// A narrow interval around the value on which the signs of x and y are certain, and what they
    /// say. A value at an end of its leaf or region gets an interval centred at that end: the leaf
    /// on the other side finds it too, and of two intervals with one centre one holds the other, so
    /// that the checker sees one solution.
    pub(crate) fn outcome(
        &self,
        expansion: &Expansion,
        value: f64,
        ends: [f64; 4],
        states: &[State],
        index: &[usize],
    ) -> Option<([Rational; 2], RootOutcome)> {
        ROOT_HALF_WIDTHS.iter().find_map(|width| {
            let half = width * value.abs();
            let near = ends
                .into_iter()
                .filter(|end| (end - value).abs() <= 0.5 * half);
            // Of several ends the shortest number: what the neighbours have as well.
            let value = near
                .max_by_key(|end| end.to_bits().trailing_zeros())
                .unwrap_or(value);
            let narrow = expansion.ends(value - half, value + half);
            let y: Matrix = self
                .y
                .iter()
                .map(|row| row.iter().map(|v| to_double(v, self.y_bits)).collect())
                .collect();
            let bounds = Bounds::new(&narrow, &self.rest, self.pivot, &y, &self.u, &self.v)?;
            if bounds.sign_product(&narrow, &self.rest, self.pivot, &self.u, &self.v) != -1 {
                return None;
            }
            let outcome = self.signs(&narrow, bounds.right, states, index)?;
            Some((
                [from_f64(value - half).ok()?, from_f64(value + half).ok()?],
                outcome,
            ))
        })
    }

    /// Has the Schur complement one sign over the interval, so that there is no null vector in it?
    pub(crate) fn is_absent(&self, wide: &Ends) -> bool {
        let y: Matrix = self
            .y
            .iter()
            .map(|row| row.iter().map(|v| to_double(v, self.y_bits)).collect())
            .collect();
        Bounds::new(wide, &self.rest, self.pivot, &y, &self.u, &self.v)
            .is_some_and(|b| b.sign_product(wide, &self.rest, self.pivot, &self.u, &self.v) == 1)
    }

    fn signs(
        &self,
        narrow: &Ends,
        error: f64,
        states: &[State],
        index: &[usize],
    ) -> Option<RootOutcome> {
        let error = 2.0 * error + ROUNDING;
        let mut certain = true;
        for (&i, v) in self.rest.iter().zip(&self.v) {
            if *v < -error {
                return Some(RootOutcome::NegativeX(index[i]));
            }
            certain &= *v > error;
        }
        for s in (0..states.len()).filter(|&s| states[s] == State::Rest) {
            let row = |m: &Matrix, r: Option<&Matrix>| {
                let radius = |j: usize| r.map_or(0.0, |r| r[s][j]);
                let entries = self.rest.iter().zip(&self.v).chain([(&self.pivot, &1.0)]);
                entries.fold((0.0, 0.0), |(sum, around), (&j, v)| {
                    (
                        sum + m[s][j] * v,
                        around
                            + radius(j) * v.abs()
                            + error * (m[s][j].abs() + radius(j))
                            + ROUNDING * (m[s][j] * v).abs(),
                    )
                })
            };
            let ends = [
                row(&narrow.m[0], narrow.r.as_ref()),
                row(&narrow.m[1], narrow.r.as_ref()),
            ];
            if ends.iter().all(|(y, around)| -*y > *around) {
                return Some(RootOutcome::NegativeY(index[s]));
            }
            certain &= ends.iter().all(|(y, around)| y > around);
        }
        certain.then_some(RootOutcome::Solution)
    }
}

/// The checker's bounds, in doubles.
struct Bounds {
    /// |v_true - v| and |u_true - u|.
    right: f64,
    left: f64,
}

impl Bounds {
    fn new(
        ends: &Ends,
        rest: &[usize],
        pivot: usize,
        y: &Matrix,
        u: &[f64],
        v: &[f64],
    ) -> Option<Bounds> {
        let n = rest.len();
        let (mut rho, mut eta, mut right, mut left) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
        let radius = |i: usize, j: usize| ends.r.as_ref().map_or(0.0, |r| r[i][j]);
        for m in &ends.m {
            let t = |i: usize, j: usize| m[rest[i]][rest[j]];
            let around = |i: usize, j: usize| radius(rest[i], rest[j]);
            for i in 0..n {
                let delta = |j: usize| if i == j { 1.0 } else { 0.0 };
                let of = |f: &dyn Fn(usize, usize) -> (f64, f64), j: usize| {
                    (0..n)
                        .map(|k| f(j, k))
                        .fold((-delta(j), 0.0), |s, (p, r)| (s.0 + p, s.1 + r))
                };
                let right = |j: usize, k: usize| (y[i][k] * t(k, j), y[i][k].abs() * around(k, j));
                let left = |j: usize, k: usize| (t(j, k) * y[k][i], around(j, k) * y[k][i].abs());
                rho = rho.max(
                    (0..n)
                        .map(|j| of(&right, j))
                        .map(|(p, r)| p.abs() + r)
                        .sum(),
                );
                eta = eta.max((0..n).map(|j| of(&left, j)).map(|(p, r)| p.abs() + r).sum());
            }
            let rv: Vec<(f64, f64)> = (0..n)
                .map(|i| {
                    let start = (m[rest[i]][pivot], radius(rest[i], pivot));
                    (0..n).fold(start, |s, j| {
                        (s.0 + t(i, j) * v[j], s.1 + around(i, j) * v[j].abs())
                    })
                })
                .collect();
            let ru: Vec<(f64, f64)> = (0..n)
                .map(|j| {
                    let start = (m[pivot][rest[j]], radius(pivot, rest[j]));
                    (0..n).fold(start, |s, i| {
                        (s.0 + u[i] * t(i, j), s.1 + u[i].abs() * around(i, j))
                    })
                })
                .collect();
            for i in 0..n {
                let sum = |list: &[(f64, f64)], y: &dyn Fn(usize) -> f64| {
                    let (p, r) = list.iter().enumerate().fold((0.0, 0.0), |s, (k, e)| {
                        (s.0 + y(k) * e.0, s.1 + y(k).abs() * e.1)
                    });
                    p.abs() + r
                };
                right = right.max(sum(&rv, &|k| y[i][k]));
                left = left.max(sum(&ru, &|k| y[k][i]));
            }
        }
        // Short of 1 by a margin: the exact check must agree.
        if rho < 0.9 && eta < 0.9 {
            Some(Bounds {
                right: right / (1.0 - rho),
                left: left / (1.0 - eta),
            })
        } else {
            None
        }
    }

    fn monotone(&self, ends: &Ends, rest: &[usize], pivot: usize, u: &[f64], v: &[f64]) -> bool {
        let all: Vec<usize> = rest.iter().copied().chain([pivot]).collect();
        let component = |list: &[f64], p: usize, error: f64| {
            if p < rest.len() {
                (list[p], error)
            } else {
                (1.0, 0.0)
            }
        };
        let (mut slope, mut around) = (0.0, 0.0);
        for (p, &i) in all.iter().enumerate() {
            for (q, &j) in all.iter().enumerate() {
                let d = ends.m[1][i][j] - ends.m[0][i][j];
                let r = ends.slope.as_ref().map_or(0.0, |s| s[i][j]);
                let ((u, e_u), (v, e_v)) =
                    (component(u, p, self.left), component(v, q, self.right));
                slope += u * d * v;
                around +=
                    r * (u * v).abs() + (d.abs() + r) * (e_u * v.abs() + u.abs() * e_v + e_u * e_v);
            }
        }
        slope.abs() > 1.05 * around
    }

    /// Product of the certain signs of the Schur complement at both ends.
    fn sign_product(&self, ends: &Ends, rest: &[usize], pivot: usize, u: &[f64], v: &[f64]) -> i8 {
        let all: Vec<usize> = rest.iter().copied().chain([pivot]).collect();
        let component = |list: &[f64], p: usize| if p < rest.len() { list[p] } else { 1.0 };
        let phi = |m: &Matrix| {
            let (mut sum, mut around, mut left) = (0.0, 0.0, 0.0);
            for (q, &j) in all.iter().enumerate() {
                let (mut column, mut size) = (0.0, 0.0);
                for (p, &i) in all.iter().enumerate() {
                    column += component(u, p) * m[i][j];
                    size += component(u, p).abs()
                        * (m[i][j].abs() * 4.0 * f64::EPSILON
                            + ends.r.as_ref().map_or(0.0, |r| r[i][j]));
                }
                sum += column * component(v, q);
                around += size * component(v, q).abs();
                if q < rest.len() {
                    left += column.abs() + size;
                }
            }
            let error = around + 2.0 * left * self.right;
            if sum > error {
                1
            } else if -sum > error {
                -1
            } else {
                0
            }
        };
        phi(&ends.m[0]) * phi(&ends.m[1])
    }
}

fn sub(m: &Matrix, rows: &[usize]) -> Matrix {
    rows.iter()
        .map(|&i| rows.iter().map(|&j| m[i][j]).collect())
        .collect()
}

fn transpose(m: &Matrix) -> Matrix {
    (0..m.len())
        .map(|i| m.iter().map(|row| row[i]).collect())
        .collect()
}

fn times(m: &Matrix, x: &[f64]) -> Vec<f64> {
    m.iter()
        .map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
        .collect()
}

fn bilinear(u: &[f64], m: &Matrix, v: &[f64]) -> f64 {
    u.iter().zip(times(m, v)).map(|(a, b)| a * b).sum()
}

/// Divided by the component of largest modulus.
fn normalised(mut v: Vec<f64>) -> Option<Vec<f64>> {
    let largest = v
        .iter()
        .copied()
        .max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    v.iter_mut().for_each(|x| *x /= largest);
    v.iter().all(|x| x.is_finite()).then_some(v)
}

/// An integer from a double that holds one.
fn integer(v: f64) -> Integer {
    truncated(v.round()).unwrap_or_default()
}

fn to_double(v: &Integer, bits: u32) -> f64 {
    mceip_exact::to_f64(&Rational::new(v.clone(), Integer::one() << bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;
    use mceip_model::Pencil;

    /// The values are 4500.33 and -0.33: like those of eighty supports of the plane-strain `\\`
    /// block, from which Newton's first step went astray.
    #[test]
    fn a_value_far_above_the_others_is_found() {
        let pencil = Pencil::new(
            Sparse::from_ints(&[&[2000, -3000], &[1000, 0]]),
            Sparse::from_ints(&[&[-1001, -2000], &[1000, 2000]]),
            vec![],
        );
        let view = crate::search::complete::pieces::view::View::of(&pencil.unwrap());
        let (expansion, states) = (&view.expansions[0], [State::Moving; 2]);
        assert!(iterate(expansion, &states, 4410.0, 4636.0, 0).is_none());
        let value = null_vector(expansion, &states, 4410.0, 4636.0)
            .unwrap()
            .value;
        // det (A + tB) = -2000 t^2 + 9,000,000 t + 3,000,000 = 0 at 2250 + sqrt(2250^2 + 1500)
        approx::assert_relative_eq!(
            value,
            2250.0 + (2250.0f64 * 2250.0 + 1500.0).sqrt(),
            max_relative = 1e-9
        );
    }

    /// -9 + 4t vanishes at 9/4. Where leaves meet at an end near it their intervals have that end
    /// as centre, of several ends the one with the shortest number, whatever the rounded value; an
    /// end farther away than half the width does not count.
    #[test]
    fn a_value_near_an_end_gets_an_interval_around_that_end() {
        let pencil = Pencil::new(
            Sparse::from_ints(&[&[-9]]),
            Sparse::from_ints(&[&[4]]),
            vec![],
        );
        let view = crate::search::complete::pieces::view::View::of(&pencil.unwrap());
        let (expansion, states) = (&view.expansions[0], [State::Moving]);
        let unique = null_vector(expansion, &states, 2.0, 3.0)
            .unwrap()
            .unique(&expansion.ends(2.0, 3.0))
            .unwrap();
        let half = ROOT_HALF_WIDTHS[0] * 2.25;
        let up = |units: u64| f64::from_bits(2.25f64.to_bits() + units);
        for (value, ends, centre) in [
            (2.25, [2.0, 2.5, 1.0, 3.0], 2.25),
            (up(3), [2.0, 2.5, 1.0, 3.0], up(3)),
            (up(3), [2.25, 2.5, 1.0, 3.0], 2.25),
            (up(3), [2.0, up(5), 1.0, 2.25], 2.25),
            (up(3), [2.0, up(6), 1.0, 3.0], up(6)),
            (up(3), [2.25 + 0.6 * half, 2.5, 1.0, 3.0], up(3)),
        ] {
            let (interval, outcome) = unique
                .outcome(expansion, value, ends, &states, &[0])
                .unwrap();
            assert_eq!(
                interval.map(|end| mceip_exact::to_f64(&end)),
                [centre - half, centre + half],
                "{value} {ends:?}"
            );
            assert_eq!(outcome, RootOutcome::Solution);
        }
    }
}
