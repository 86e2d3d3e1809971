//! Enclosed claims: a box around a candidate in which Krawczyk's test holds.
//!
//! The centre comes from Newton's method with exact residuals ([`newton`]), the radii from
//! Krawczyk's inequality ([`krawczyk`]). Both start on a grid of [`FIRST_GRID_BITS`] bits. Where a
//! sign that the claim needs is not decided over the box (a local mode has components of 1e-20 of
//! the largest), the grid is made finer and the box shrinks with it, down to [`LAST_GRID_BITS`].
//!
//! Input: a candidate in doubles and a support. Output: a claim (`spec/certificates.md`, 5.5), not
//! checked. Called by `proposals`, for supports or numbers that are too large for exact claims.

mod krawczyk;
pub(super) mod newton;

use super::failure::AttemptFailure;
use super::rows::IntegralRows;
use crate::candidate::{Candidate, distance, scaled_exactly};
use crate::tolerance::{VALUE_RADIUS, X_RADIUS};
use krawczyk::GridKrawczyk;
use mceip_check::certificate::EnclosedSolution;
use mceip_exact::{Integer, Rational, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use newton::{Newton, NewtonPoint};
use num_traits::{Signed, Zero as _};

/// Bits of the centre's largest component of x, and of its value, that are tried first. Basis: a
/// value is printed with 17 digits, which are 57 bits.
const FIRST_GRID_BITS: u32 = 64;
/// The same, tried last; each try has twice the bits of the previous one. Basis: components of
/// 1e-150 of the largest are decided, and a component that is zero costs four tries.
const LAST_GRID_BITS: u32 = 512;

/// A box around the candidate in which Krawczyk's test should hold; `check` decides whether it
/// does.
///
/// # Errors
/// The Jacobian is singular in doubles, no box maps into itself, the box is not the candidate's, or
/// a sign is wrong or undecided on the finest grid.
pub(super) fn make(
    pencil: &Pencil,
    rows: &IntegralRows,
    window: &Window,
    support: &[usize],
    candidate: &Candidate,
) -> Result<EnclosedSolution, AttemptFailure> {
    if support.is_empty() {
        return Err(AttemptFailure::ZeroX);
    }

    let newton = Newton::new(pencil, rows, support);
    let mut point = newton.start(candidate, FIRST_GRID_BITS)?;
    let first_inverse = newton.inverse(&point)?;
    newton.polish(&mut point, &first_inverse);
    require_near(&newton, &point, candidate)?;

    // At the polished centre the inverse is better.
    let inverse = newton.inverse(&point)?;
    let krawczyk = GridKrawczyk::new(&newton, &point, &inverse)?;

    let mut bits = FIRST_GRID_BITS;
    loop {
        newton.polish(&mut point, &inverse);
        let radius = krawczyk.radii(&newton, &point)?;
        let enclosure = Enclosure {
            newton: &newton,
            point: &point,
            radius: &radius,
        };

        match enclosure.undecided(window)? {
            None => return Ok(claim(support, &point, &radius, krawczyk)),
            Some(sign) if bits >= LAST_GRID_BITS => return Err(sign.failure(bits)),
            Some(_) => {}
        }
        point.refine(bits);
        bits *= 2;
    }
}

/// Puts the claim together: centre, radii and preconditioner as the file has them.
fn claim(
    support: &[usize],
    point: &NewtonPoint,
    radius: &[Integer],
    krawczyk: GridKrawczyk,
) -> EnclosedSolution {
    let mut center = Vec::new();
    let mut widths = Vec::new();
    for (k, units) in radius.iter().enumerate() {
        center.push(Number(point.value(k)));
        widths.push(Number(point.in_units(k, units)));
    }

    let (preconditioner, exponent) = krawczyk.into_preconditioner();
    EnclosedSolution {
        support: support.to_vec(),
        center,
        radius: widths,
        preconditioner,
        exponent,
    }
}

/// Demands that the polished point is the candidate, up to its rounding: in the value, and in x
/// ([`distance`]).
fn require_near(
    newton: &Newton<'_>,
    point: &NewtonPoint,
    candidate: &Candidate,
) -> Result<(), AttemptFailure> {
    let order = point.x.len();
    let mut x = vec![Rational::zero(); candidate.x.len()];
    for (k, &index) in newton.active.iter().enumerate() {
        x[index] = point.value(k);
    }
    let x = scaled_exactly(&x).ok_or(AttemptFailure::ZeroX)?;

    let of_x = distance(&x, &candidate.x);
    let of_value = (to_f64(&point.value(order)) - candidate.value).abs();
    let value_limit = X_RADIUS.max(VALUE_RADIUS * (1.0 + candidate.value.abs()));
    if of_x > X_RADIUS {
        Err(AttemptFailure::TooFar {
            distance: of_x,
            limit: X_RADIUS,
        })
    } else if of_value > value_limit {
        Err(AttemptFailure::TooFar {
            distance: of_value,
            limit: value_limit,
        })
    } else {
        Ok(())
    }
}

/// A sign that the claim needs and that is not the same all over the box.
enum Undecided {
    /// Of the value's distance to an end of the window.
    Value,
    X(usize),
    Y(usize),
}

impl Undecided {
    fn failure(self, bits: u32) -> AttemptFailure {
        let what = match self {
            Undecided::Value => "value - end of the window".into(),
            Undecided::X(index) => format!("x[{index}]"),
            Undecided::Y(index) => format!("y[{index}]"),
        };
        AttemptFailure::Undecided { what, bits }
    }
}

/// A number known up to its radius, both in one unit.
struct IntegerBall {
    center: Integer,
    radius: Integer,
}

/// The sign that all numbers of a ball have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CommonSign {
    Positive,
    Negative,
    /// Some are zero, or both signs occur.
    Undecided,
}

impl IntegerBall {
    fn sign(&self) -> CommonSign {
        if self.center > self.radius {
            CommonSign::Positive
        } else if -&self.center > self.radius {
            CommonSign::Negative
        } else {
            CommonSign::Undecided
        }
    }
}

/// The box of a claim: centre and radii in units of the point's grid.
struct Enclosure<'a> {
    newton: &'a Newton<'a>,
    point: &'a NewtonPoint,
    radius: &'a [Integer],
}

impl Enclosure<'_> {
    /// The first sign that the box leaves undecided: of the value's distance to the ends of the
    /// window, of x on the support, of y off it.
    ///
    /// # Errors
    /// A sign that is wrong all over the box.
    fn undecided(&self, window: &Window) -> Result<Option<Undecided>, AttemptFailure> {
        if let Some(sign) = self.undecided_value(window)? {
            return Ok(Some(sign));
        }
        if let Some(sign) = self.undecided_x()? {
            return Ok(Some(sign));
        }

        self.undecided_y()
    }

    /// Demands that all values of the box lie in the window, whose ends belong to it.
    fn undecided_value(&self, window: &Window) -> Result<Option<Undecided>, AttemptFailure> {
        let last = self.point.x.len();
        let center = self.point.value(last);
        let radius = self.point.in_units(last, &self.radius[last]);
        let lo = &center - &radius;
        let hi = &center + &radius;

        let is_inside = lo >= *window.min() && window.max().is_none_or(|max| hi <= *max);
        let is_outside = hi < *window.min() || window.max().is_some_and(|max| lo > *max);
        if is_inside {
            Ok(None)
        } else if is_outside {
            Err(AttemptFailure::NoRootNear {
                lo: window.min().to_string(),
                hi: window.max().map_or("infinity".into(), ToString::to_string),
            })
        } else {
            Ok(Some(Undecided::Value))
        }
    }

    /// Demands x_i > 0 on the support.
    fn undecided_x(&self) -> Result<Option<Undecided>, AttemptFailure> {
        for (k, &index) in self.newton.active.iter().enumerate() {
            if !self.newton.is_in_support(index) {
                continue;
            }

            let x = IntegerBall {
                center: self.point.x[k].clone(),
                radius: self.radius[k].clone(),
            };
            match x.sign() {
                CommonSign::Positive => {}
                CommonSign::Negative => return Err(AttemptFailure::XNotPositive { index }),
                CommonSign::Undecided => return Ok(Some(Undecided::X(index))),
            }
        }

        Ok(None)
    }

    /// Demands y_i > 0 off the support, but for rows that vanish with those of the support.
    fn undecided_y(&self) -> Result<Option<Undecided>, AttemptFailure> {
        let vanishing = self.newton.vanishing();
        for index in self.newton.inactive() {
            if vanishing.contains(&index) {
                continue;
            }

            match self.y(index).sign() {
                CommonSign::Positive => {}
                CommonSign::Negative => return Err(AttemptFailure::YNegative { index }),
                CommonSign::Undecided => return Ok(Some(Undecided::Y(index))),
            }
        }

        Ok(None)
    }

    /// y_i = sum_j (a_ij + t b_ij) x_j over the box, in units of the grid of x times that of t.
    fn y(&self, index: usize) -> IntegerBall {
        let radius_of_t = &self.radius[self.point.x.len()];
        let mut y = IntegerBall {
            center: Integer::default(),
            radius: Integer::default(),
        };

        for entry in self.newton.active_entries(index) {
            let x = &self.point.x[entry.position];
            let x_radius = &self.radius[entry.position];
            let coefficient = self.point.coefficient(&entry);
            let coefficient_radius = entry.b.abs() * radius_of_t;

            y.center += &coefficient * x;
            y.radius += coefficient.abs() * x_radius;
            y.radius += coefficient_radius * (x.abs() + x_radius);
        }

        y
    }
}

#[cfg(test)]
mod tests;
