//! Root leaves: T(t) on a support has at most one null vector over the interval, and what it is.
//!
//! Every variable is decided. Let S be the support, k in S the *pivot*, and T' the block of T on S
//! without k. The witness is Y ~ T'^-1 and vectors v, u ~ the right and left null vectors, with
//! v_k = u_k = 1. All bounds hold for every T(t) of the enclosure:
//!
//! 1. |I - Y T'| <= rho < 1 and |I - T'Y| <= eta < 1 make Y and T' regular. So a null vector of
//!    T_SS has a component k other than zero; scaled to 1 there it is v_true = -T'^-1 T_'k on the
//!    rest, and it exists exactly where the Schur complement phi(t) = T_kk - T_k' T'^-1 T_'k is
//!    zero.
//! 2. |v_true - v| = |T'^-1 (T_'k + T'v)| <= |Y (T_'k + T'v)| / (1 - rho) =: eps_v, as
//!    T'^-1 = (Y T')^-1 Y. Likewise eps_u for u, with Y on the other side and eta.
//! 3. phi' = u_true' (dT/dt) v_true. If this is certainly not zero (*monotone*), phi has at most
//!    one zero t.
//! 4. phi = u'Tv - (residual of u)' T'^-1 (residual of v), where the second term is at most the sum
//!    of |residual of u| times eps_v. So the sign of phi at an end can be told.
//! 5. If phi has the same sign at both ends there is no null vector. If it has opposite signs at
//!    the ends of [a, b], the only null vector is at a t in [a, b], and lies within eps of v there:
//!    signs of x = v_true and of y = T x outside the support decide whether it is a solution.
//!
//! Norms are the largest row sum (right side) and the largest column sum (left side); |v_true - v|
//! is the largest component.
//!
//! Input: the region, the *wide* ends over the hull of its interval and [a, b], the *narrow* ends
//! over [a, b], the witness. Called by the walk, which treats the outcomes `claim` and `infinity`.

use super::ends::{Ends, Matrix};
use super::fault::CoverFault;
use super::region::{Region, State};
use crate::certificate::{Root, RootOutcome};
use mceip_exact::{Integer, Rational};
use num_traits::{One, Signed, Zero};

/// Largest binary exponent of a witness.
const MAX_EXPONENT: u32 = 1 << 14;

/// Checks the witness. `vanishing` are variables at rest of which y = 0 follows from y = 0 on the
/// support: a solution needs no sign there. For [`RootOutcome::Claim`] and
/// [`RootOutcome::Infinity`] it checks uniqueness only, steps 1 to 3.
pub(super) fn check(
    region: &Region,
    wide: &Ends,
    narrow: impl FnOnce() -> Result<Ends, CoverFault>,
    index: &[usize],
    vanishing: &[usize],
    root: &Root,
) -> Result<(), CoverFault> {
    let witness = Witness::new(region, index, root)?;

    let rho = witness.norm(wide, Side::Right)?;
    let eta = witness.norm(wide, Side::Left)?;
    let right = witness.error(wide, Side::Right, &rho);
    let left = witness.error(wide, Side::Left, &eta);
    if !witness.monotone(wide, &left, &right) {
        return Err(CoverFault::NotMonotone);
    }

    match root.outcome {
        RootOutcome::Claim(_) | RootOutcome::Infinity(_) => return Ok(()),
        RootOutcome::Absent if witness.schur_signs(wide, &rho) == 1 => return Ok(()),
        RootOutcome::Absent => return Err(CoverFault::SignChange),
        RootOutcome::Solution | RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) => {}
    }

    let narrow = narrow()?;
    if witness.schur_signs(&narrow, &rho) != -1 {
        let [lo, hi] = &root.interval;
        return Err(CoverFault::NoSignChange {
            lo: lo.0.clone(),
            hi: hi.0.clone(),
        });
    }

    // rho bounds |I - Y T'(t)| for every t of the hull, so for those of [a, b].
    let error = witness.error(&narrow, Side::Right, &rho);
    let indices = [index, vanishing];
    witness.check_outcome(region, &narrow, &error, indices, &root.outcome)
}

/// Which null vector is meant: T v = 0 or u'T = 0.
#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
}

/// Every number within `radius` of `center`.
#[derive(Default)]
pub(super) struct Ball {
    pub(super) center: Integer,
    pub(super) radius: Integer,
}

impl Ball {
    /// Adds factor * (center +- radius).
    pub(super) fn add(&mut self, factor: &Integer, center: &Integer, radius: &Integer) {
        self.center += factor * center;
        if !radius.is_zero() {
            self.radius += factor.abs() * radius;
        }
    }

    /// The largest absolute value.
    pub(super) fn magnitude(&self) -> Integer {
        self.center.abs() + &self.radius
    }
}

/// The witness, with positions among the complementarity variables. All vectors are over `support`,
/// whose last entry is the pivot, with component 1.
struct Witness<'a> {
    support: Vec<usize>,
    /// Y.
    y: &'a Matrix,
    /// 1 in units of Y.
    y_one: Integer,
    u: Vec<Integer>,
    v: Vec<Integer>,
    /// 1 in units of u and v.
    one: Integer,
}

impl<'a> Witness<'a> {
    fn new(region: &Region, index: &[usize], root: &'a Root) -> Result<Self, CoverFault> {
        let mut support = region.support();
        if !region.is_decided() || support.is_empty() {
            return Err(CoverFault::RootTooEarly);
        }

        let pivot = support
            .iter()
            .position(|&i| index[i] == root.pivot)
            .ok_or(CoverFault::Pivot { index: root.pivot })?;
        let pivot = support.remove(pivot);
        check_shape(root, support.len())?;
        support.push(pivot);

        let one = Integer::one() << root.exponent;
        let mut u = root.left.clone();
        let mut v = root.right.clone();
        u.push(one.clone());
        v.push(one.clone());

        Ok(Witness {
            support,
            y: &root.inverse,
            y_one: Integer::one() << root.inverse_exponent,
            u,
            v,
            one,
        })
    }

    /// Order of T'.
    fn order(&self) -> usize {
        self.support.len() - 1
    }

    /// rho or eta: |I - Y T'| in the row norm (right) or |I - T'Y| in the column norm (left) over
    /// both ends. Demands that it is less than 1.
    fn norm(&self, ends: &Ends, side: Side) -> Result<Rational, CoverFault> {
        let one = &self.y_one * &ends.scale;
        let mut largest = Integer::zero();

        for end in 0..2 {
            for i in 0..self.order() {
                let mut sum = Integer::zero();
                for j in 0..self.order() {
                    let mut product = self.product(ends, end, side, (i, j));
                    if i == j {
                        product.center -= &one;
                    }

                    sum += product.magnitude();
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

    /// (Y T')_ij (right) or (T'Y)_ji (left) at an end.
    fn product(&self, ends: &Ends, end: usize, side: Side, (i, j): (usize, usize)) -> Ball {
        let m = &ends.m[end];
        let r = &ends.r[end];
        let s = &self.support;

        let mut sum = Ball::default();
        for k in 0..self.order() {
            match side {
                Side::Right => sum.add(&self.y[i][k], &m[s[k]][s[j]], &r[s[k]][s[j]]),
                Side::Left => sum.add(&self.y[k][i], &m[s[j]][s[k]], &r[s[j]][s[k]]),
            }
        }

        sum
    }

    /// Residual T_'k + T'v (right) or T_k' + u'T' (left) at an end, in units of 1 / (one scale).
    fn residual(&self, ends: &Ends, end: usize, side: Side) -> Vec<Ball> {
        let m = &ends.m[end];
        let r = &ends.r[end];
        let s = &self.support;

        let mut residual = Vec::with_capacity(self.order());
        for i in 0..self.order() {
            let mut sum = Ball::default();
            for j in 0..s.len() {
                match side {
                    Side::Right => sum.add(&self.v[j], &m[s[i]][s[j]], &r[s[i]][s[j]]),
                    Side::Left => sum.add(&self.u[j], &m[s[j]][s[i]], &r[s[j]][s[i]]),
                }
            }

            residual.push(sum);
        }

        residual
    }

    /// eps: bound of |v_true - v| (right) or |u_true - u| (left) over both ends.
    fn error(&self, ends: &Ends, side: Side, norm: &Rational) -> Rational {
        let lower = self.error_at(ends, 0, side, norm);
        let upper = self.error_at(ends, 1, side, norm);
        lower.max(upper)
    }

    /// The same at one end: the largest component of |Y residual| / (1 - norm).
    fn error_at(&self, ends: &Ends, end: usize, side: Side, norm: &Rational) -> Rational {
        let residual = self.residual(ends, end, side);
        let mut largest = Integer::zero();

        for i in 0..self.order() {
            let mut sum = Ball::default();
            for (k, entry) in residual.iter().enumerate() {
                let y = match side {
                    Side::Right => &self.y[i][k],
                    Side::Left => &self.y[k][i],
                };
                sum.add(y, &entry.center, &entry.radius);
            }

            largest = largest.max(sum.magnitude());
        }

        let unit = &self.y_one * &self.one * &ends.scale;
        Rational::new(largest, unit) / (Rational::one() - norm)
    }

    /// Is u_true' (dT/dt) v_true certainly not zero over the interval?
    ///
    /// `left` and `right` bound |u_true - u| and |v_true - v|. The interval's length times dT/dt
    /// lies within D (`slope`) of M1 - M0.
    fn monotone(&self, ends: &Ends, left: &Rational, right: &Rational) -> bool {
        let left = self.rounded_up(left);
        let right = self.rounded_up(right);
        let exact = Integer::zero();
        let order = self.order();
        let Some(slope_radius) = &ends.slope else {
            return false;
        };

        let mut slope = Integer::zero();
        let mut radius = Integer::zero();
        for (i, &row) in self.support.iter().enumerate() {
            let u = &self.u[i];
            let e_u = if i < order { &left } else { &exact };

            for (j, &column) in self.support.iter().enumerate() {
                let v = &self.v[j];
                let e_v = if j < order { &right } else { &exact };

                let difference = &ends.m[1][row][column] - &ends.m[0][row][column];
                let around = &slope_radius[row][column];
                slope += u * &difference * v;
                radius += around * u.abs() * v.abs();
                radius += (difference.abs() + around) * (e_u * v.abs() + u.abs() * e_v + e_u * e_v);
            }
        }

        slope.abs() > radius
    }

    /// A bound of a component of u or v in their units.
    fn rounded_up(&self, bound: &Rational) -> Integer {
        let in_units = bound * Rational::from_integer(self.one.clone());
        in_units.ceil().to_integer()
    }

    /// 1 if phi certainly has one sign at both ends, -1 if it certainly changes, else 0.
    fn schur_signs(&self, ends: &Ends, norm: &Rational) -> i8 {
        self.schur_sign(ends, 0, norm) * self.schur_sign(ends, 1, norm)
    }

    /// Certain sign of phi at an end, 0 if none.
    fn schur_sign(&self, ends: &Ends, end: usize, norm: &Rational) -> i8 {
        let mut phi = Integer::zero(); // u'Tv
        let mut radius = Integer::zero();
        for (i, &row) in self.support.iter().enumerate() {
            for (j, &column) in self.support.iter().enumerate() {
                phi += &self.u[i] * &ends.m[end][row][column] * &self.v[j];
                radius += self.u[i].abs() * &ends.r[end][row][column] * self.v[j].abs();
            }
        }

        let mut left_residual = Integer::zero();
        for entry in self.residual(ends, end, Side::Left) {
            left_residual += entry.magnitude();
        }

        let error = self.error_at(ends, end, Side::Right, norm);
        let second_term = Rational::from_integer(left_residual * &self.one) * error;
        radius += second_term.ceil().to_integer();

        certain(&phi, &radius)
    }

    /// Demands x > 0 and y > 0 over the narrow interval, but no sign of y where it vanishes;
    /// `error` in units of v.
    fn check_solution(
        &self,
        region: &Region,
        ends: &Ends,
        error: &Rational,
        [index, vanishing]: [&[usize]; 2],
    ) -> Result<(), CoverFault> {
        for (p, &i) in self.support.iter().enumerate() {
            if self.x_sign(p, error) != 1 {
                return Err(sign_fault("x", index[i], "> 0"));
            }
        }

        for i in region.positions(|state| state == State::AtZero) {
            let needs_sign = !vanishing.contains(&index[i]);
            if needs_sign && self.y_sign(ends, i, error) != 1 {
                return Err(sign_fault("y", index[i], "> 0"));
            }
        }

        Ok(())
    }

    /// Demands the signs of x and y that the outcome states, over the narrow interval.
    fn check_outcome(
        &self,
        region: &Region,
        ends: &Ends,
        error: &Rational,
        [index, vanishing]: [&[usize]; 2],
        outcome: &RootOutcome,
    ) -> Result<(), CoverFault> {
        // eps in units of v, as a fraction that is not rounded.
        let error = error * Rational::from_integer(self.one.clone());

        match *outcome {
            RootOutcome::Solution => self.check_solution(region, ends, &error, [index, vanishing]),
            RootOutcome::NegativeX(stated) => {
                match self.support.iter().position(|&i| index[i] == stated) {
                    Some(p) if self.x_sign(p, &error) == -1 => Ok(()),
                    _ => Err(sign_fault("x", stated, "< 0")),
                }
            }
            RootOutcome::NegativeY(stated) => {
                let is_at_zero = |i: &usize| region.states[*i] == State::AtZero;
                match index.iter().position(|&i| i == stated).filter(is_at_zero) {
                    Some(i) if self.y_sign(ends, i, &error) == -1 => Ok(()),
                    _ => Err(sign_fault("y", stated, "< 0")),
                }
            }
            // `check` has returned before for these.
            RootOutcome::Claim(_) | RootOutcome::Absent | RootOutcome::Infinity(_) => Ok(()),
        }
    }

    /// Certain sign of component p of v_true, which is within `error` units of v_p; that of the
    /// pivot is 1.
    fn x_sign(&self, p: usize, error: &Rational) -> i8 {
        if p == self.order() {
            return 1;
        }

        certain(&(&self.v[p] * error.denom()), error.numer())
    }

    /// Certain sign of row i of T v_true over the interval.
    fn y_sign(&self, ends: &Ends, i: usize, error: &Rational) -> i8 {
        let lower = self.row_sign(ends, 0, i, error);
        let upper = self.row_sign(ends, 1, i, error);
        if lower == upper { lower } else { 0 }
    }

    /// Certain sign of row i of T v_true at an end; every component of v but the pivot's is within
    /// `error` units.
    fn row_sign(&self, ends: &Ends, end: usize, i: usize, error: &Rational) -> i8 {
        let mut sum = Ball::default();
        let mut reach = Integer::zero(); // sum of |m| + r, to be multiplied by the error
        for (p, &column) in self.support.iter().enumerate() {
            let m = &ends.m[end][i][column];
            let r = &ends.r[end][i][column];
            sum.add(&self.v[p], m, r);
            if p < self.order() {
                reach += m.abs() + r;
            }
        }

        certain(
            &(sum.center * error.denom()),
            &(sum.radius * error.denom() + reach * error.numer()),
        )
    }
}

/// Demands that u, v and Y have order n, and that their exponents are within the limit.
fn check_shape(root: &Root, n: usize) -> Result<(), CoverFault> {
    CoverFault::length("left", n, root.left.len())?;
    CoverFault::length("right", n, root.right.len())?;
    CoverFault::length("inverse", n, root.inverse.len())?;
    for row in &root.inverse {
        CoverFault::length("inverse row", n, row.len())?;
    }

    let exponent = root.exponent.max(root.inverse_exponent);
    CoverFault::at_most("exponent", MAX_EXPONENT.into(), exponent.into())
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

fn sign_fault(component: &'static str, index: usize, expected: &'static str) -> CoverFault {
    CoverFault::Sign {
        component,
        index,
        expected,
    }
}

#[cfg(test)]
mod tests;
