//! Leaves whose pencil has one null vector at most, and what it is.
//!
//! With k the pivot, T' the moving block without it, Y ~ T'^-1, v and u the right and left vectors:
//! |I - Y T'| < 1 makes T' regular, so a null vector of T has a component k other than zero and is
//! unique where the Schur complement phi(t) = T_kk - T_k' T'^-1 T_'k vanishes. phi' = u_true'
//! (dT/dt) v_true of one sign leaves one t at most. |v_true - v| <= |Y (T_'k + T'v)| / (1 - |I -
//! YT'|), likewise u with |I - T'Y|. phi = u'Tv - (residual of u)' T'^-1 (residual of v) locates
//! the sign change.

use super::family::{Ends, Matrix};
use super::{CoverFault, Region, State};
use crate::certificate::{Root, RootOutcome};
use mceip_exact::{Integer, Rational};
use num_traits::{One, Signed, Zero};

/// Largest binary exponent of a witness.
const MAX_EXPONENT: u32 = 1 << 14;

/// `wide`: ends over the hull of the leaf and the root's interval; `narrow`: over that interval.
/// For [`RootOutcome::Claim`] and [`RootOutcome::Infinity`] only uniqueness is checked here.
pub(super) fn check(
    region: &Region,
    wide: &Ends,
    narrow: impl FnOnce() -> Result<Ends, CoverFault>,
    index: &[usize],
    root: &Root,
) -> Result<(), CoverFault> {
    let system = System::new(region, index, root)?;
    let (rho, eta) = (
        system.norm(wide, Side::Right)?,
        system.norm(wide, Side::Left)?,
    );
    let right = system.error(wide, Side::Right, &rho);
    let left = system.error(wide, Side::Left, &eta);
    if !system.monotone(wide, &left, &right) {
        return Err(CoverFault::NotMonotone);
    }
    let at_wide_ends = || system.schur_sign(wide, 0, &rho) * system.schur_sign(wide, 1, &rho);
    match root.outcome {
        RootOutcome::Claim(_) | RootOutcome::Infinity(_) => return Ok(()),
        RootOutcome::Absent if at_wide_ends() == 1 => return Ok(()),
        RootOutcome::Absent => return Err(CoverFault::SignChange),
        _ => {}
    }
    let narrow = narrow()?;
    if system.schur_sign(&narrow, 0, &rho) * system.schur_sign(&narrow, 1, &rho) != -1 {
        let [lo, hi] = &root.interval;
        return Err(CoverFault::NoSignChange {
            lo: lo.0.clone(),
            hi: hi.0.clone(),
        });
    }
    let error = system.error(&narrow, Side::Right, &rho);
    system.signs(region, &narrow, &error, index, root)
}

enum Side {
    Left,
    Right,
}

/// The witness, with positions among the complementarity variables. All vectors are over `moving`,
/// whose last entry is the pivot, with component 1.
struct System<'a> {
    moving: Vec<usize>,
    /// Y, and 1 in its units.
    y: &'a Matrix,
    y_one: Integer,
    u: Vec<Integer>,
    v: Vec<Integer>,
    /// 1 in units of u and v.
    one: Integer,
}

impl<'a> System<'a> {
    fn new(region: &Region, index: &[usize], root: &'a Root) -> Result<Self, CoverFault> {
        let all_decided = region.states.iter().all(|s| *s != State::Open);
        let mut moving: Vec<usize> = (0..index.len())
            .filter(|&i| region.states[i] == State::Moving)
            .collect();
        if !all_decided || moving.is_empty() {
            return Err(CoverFault::RootTooEarly);
        }
        let pivot = moving
            .iter()
            .position(|&i| index[i] == root.pivot)
            .ok_or(CoverFault::Pivot { index: root.pivot })?;
        let pivot = moving.remove(pivot);
        let n = moving.len();
        moving.push(pivot);
        let lengths = [
            ("left", root.left.len()),
            ("right", root.right.len()),
            ("inverse", root.inverse.len()),
        ];
        for (what, got) in lengths
            .into_iter()
            .chain(root.inverse.iter().map(|r| ("inverse row", r.len())))
        {
            if got != n {
                return Err(CoverFault::Length {
                    what,
                    expected: n,
                    got,
                });
            }
        }
        let largest = root.exponent.max(root.inverse_exponent);
        if largest > MAX_EXPONENT {
            return Err(CoverFault::TooLarge {
                what: "exponent",
                limit: MAX_EXPONENT.into(),
                got: largest.into(),
            });
        }
        let one = Integer::one() << root.exponent;
        let with_one = |list: &[Integer]| list.iter().cloned().chain([one.clone()]).collect();
        let (u, v) = (with_one(&root.left), with_one(&root.right));
        Ok(System {
            moving,
            y: &root.inverse,
            y_one: Integer::one() << root.inverse_exponent,
            u,
            v,
            one,
        })
    }

    /// Order of T'.
    fn order(&self) -> usize {
        self.moving.len() - 1
    }

    /// |I - Y T'| in the row norm (right) or |I - T'Y| in the column norm (left) over both ends, <
    /// 1.
    fn norm(&self, ends: &Ends, side: Side) -> Result<Rational, CoverFault> {
        let (n, one) = (self.order(), &self.y_one * &ends.scale);
        let mut largest = Integer::zero();
        for end in 0..2 {
            for i in 0..n {
                let mut sum = Integer::zero();
                for j in 0..n {
                    let (mut product, mut radius) = (Integer::zero(), Integer::zero());
                    for k in 0..n {
                        // Right: (Y T')_ij; left: (T' Y)_ji.
                        let (y, row, col) = match side {
                            Side::Right => (&self.y[i][k], self.moving[k], self.moving[j]),
                            Side::Left => (&self.y[k][i], self.moving[j], self.moving[k]),
                        };
                        product += y * &ends.m[end][row][col];
                        let r = &ends.r[end][row][col];
                        if !r.is_zero() {
                            radius += y.abs() * r;
                        }
                    }
                    if i == j {
                        product -= &one;
                    }
                    sum += product.abs() + radius;
                }
                largest = largest.max(sum);
            }
        }
        let norm = Rational::new(largest, one);
        if norm < Rational::one() {
            Ok(norm)
        } else {
            Err(CoverFault::NotRegular { got: norm })
        }
    }

    /// Residual T_'k + T'v (right) or T_k' + u'T' (left) at an end, each entry with its radius, in
    /// units of 1 / (one scale).
    fn residual(&self, ends: &Ends, end: usize, side: &Side) -> Vec<(Integer, Integer)> {
        let n = self.order();
        (0..n)
            .map(|i| {
                let (mut sum, mut radius) = (Integer::zero(), Integer::zero());
                for j in 0..=n {
                    let (x, row, col) = match side {
                        Side::Right => (&self.v[j], self.moving[i], self.moving[j]),
                        Side::Left => (&self.u[j], self.moving[j], self.moving[i]),
                    };
                    sum += x * &ends.m[end][row][col];
                    let r = &ends.r[end][row][col];
                    if !r.is_zero() {
                        radius += x.abs() * r;
                    }
                }
                (sum, radius)
            })
            .collect()
    }

    /// Bound of |v_true - v| (right) or |u_true - u| (left) in every component over both ends.
    fn error(&self, ends: &Ends, side: Side, norm: &Rational) -> Rational {
        (0..2)
            .map(|end| self.error_at(ends, end, &side, norm))
            .max()
            .unwrap_or_else(Rational::zero)
    }

    fn error_at(&self, ends: &Ends, end: usize, side: &Side, norm: &Rational) -> Rational {
        let n = self.order();
        let residual = self.residual(ends, end, side);
        let largest = (0..n).map(|i| {
            let (mut sum, mut radius) = (Integer::zero(), Integer::zero());
            for (k, (value, around)) in residual.iter().enumerate() {
                let y = if matches!(side, Side::Right) {
                    &self.y[i][k]
                } else {
                    &self.y[k][i]
                };
                sum += y * value;
                radius += y.abs() * around;
            }
            sum.abs() + radius
        });
        let unit = &self.y_one * &self.one * &ends.scale;
        Rational::new(largest.max().unwrap_or_default(), unit) / (Rational::one() - norm)
    }

    /// Is u_true' (dT/dt) v_true certainly not zero over the interval?
    fn monotone(&self, ends: &Ends, left: &Rational, right: &Rational) -> bool {
        let n = self.order();
        let units = |e: &Rational| {
            (e * Rational::from_integer(self.one.clone()))
                .ceil()
                .to_integer()
        };
        let (e_u, e_v) = (units(left), units(right));
        let (mut slope, mut radius) = (Integer::zero(), Integer::zero());
        for i in 0..=n {
            let (u, e_u) = (
                &self.u[i],
                if i < n { e_u.clone() } else { Integer::zero() },
            );
            for j in 0..=n {
                let (v, e_v) = (
                    &self.v[j],
                    if j < n { e_v.clone() } else { Integer::zero() },
                );
                let (row, col) = (self.moving[i], self.moving[j]);
                let d = &ends.m[1][row][col] - &ends.m[0][row][col];
                let around = &ends.slope[row][col];
                slope += u * &d * v;
                radius += around * u.abs() * v.abs()
                    + (d.abs() + around) * (&e_u * v.abs() + u.abs() * &e_v + &e_u * &e_v);
            }
        }
        slope.abs() > radius
    }

    /// Certain sign of phi at an end, 0 if none.
    fn schur_sign(&self, ends: &Ends, end: usize, norm: &Rational) -> i8 {
        let n = self.order();
        let (mut phi, mut radius) = (Integer::zero(), Integer::zero());
        for i in 0..=n {
            for j in 0..=n {
                let (row, col) = (self.moving[i], self.moving[j]);
                phi += &self.u[i] * &ends.m[end][row][col] * &self.v[j];
                radius += self.u[i].abs() * &ends.r[end][row][col] * self.v[j].abs();
            }
        }
        let left: Integer = self
            .residual(ends, end, &Side::Left)
            .iter()
            .map(|(value, around)| value.abs() + around)
            .sum();
        let error = self.error_at(ends, end, &Side::Right, norm);
        let second = (Rational::from_integer(left * &self.one) * error)
            .ceil()
            .to_integer();
        radius += second;
        if phi > radius {
            1
        } else if -phi > radius {
            -1
        } else {
            0
        }
    }

    /// The signs of x and y that the outcome states, over the narrow interval.
    fn signs(
        &self,
        region: &Region,
        ends: &Ends,
        error: &Rational,
        index: &[usize],
        root: &Root,
    ) -> Result<(), CoverFault> {
        // eps' in units of v, as a fraction that is not rounded.
        let error = error * Rational::from_integer(self.one.clone());
        let none = Rational::zero();
        let x = |p: usize| {
            let error = if p < self.order() { &error } else { &none };
            certain(&(&self.v[p] * error.denom()), error.numer())
        };
        let y = |s: usize| {
            let signs = [
                self.row_sign(ends, 0, s, &error),
                self.row_sign(ends, 1, s, &error),
            ];
            if signs[0] == signs[1] { signs[0] } else { 0 }
        };
        let fault = |component, index, expected| {
            Err(CoverFault::Sign {
                component,
                index,
                expected,
            })
        };
        match root.outcome {
            RootOutcome::Solution => {
                if let Some(p) = (0..self.moving.len()).find(|&p| x(p) != 1) {
                    return fault("x", index[self.moving[p]], "> 0");
                }
                match (0..index.len()).find(|&s| region.states[s] == State::Rest && y(s) != 1) {
                    Some(s) => fault("y", index[s], "> 0"),
                    None => Ok(()),
                }
            }
            RootOutcome::NegativeX(i) => match self.moving.iter().position(|&p| index[p] == i) {
                Some(p) if x(p) == -1 => Ok(()),
                _ => fault("x", i, "< 0"),
            },
            RootOutcome::NegativeY(i) => match index.iter().position(|&s| s == i) {
                Some(s) if region.states[s] == State::Rest && y(s) == -1 => Ok(()),
                _ => fault("y", i, "< 0"),
            },
            // Dealt with before.
            RootOutcome::Claim(_) | RootOutcome::Absent | RootOutcome::Infinity(_) => Ok(()),
        }
    }

    /// Certain sign of row s of T v_true at an end; every component of v but the pivot's is within
    /// `error` units.
    fn row_sign(&self, ends: &Ends, end: usize, s: usize, error: &Rational) -> i8 {
        let mut sum = Integer::zero();
        let mut radius = Integer::zero();
        let mut reach = Integer::zero(); // sum of |m| + r, to be multiplied by the error
        for (p, &col) in self.moving.iter().enumerate() {
            let (m, r) = (&ends.m[end][s][col], &ends.r[end][s][col]);
            sum += m * &self.v[p];
            radius += r * self.v[p].abs();
            if p < self.order() {
                reach += m.abs() + r;
            }
        }
        certain(
            &(sum * error.denom()),
            &(radius * error.denom() + reach * error.numer()),
        )
    }
}

/// Sign of every number within `radius` of `value`, 0 if they differ.
fn certain(value: &Integer, radius: &Integer) -> i8 {
    if value > radius {
        1
    } else if &-value > radius {
        -1
    } else {
        0
    }
}

#[cfg(test)]
mod tests;
