//! Enclosed claims: a box around a candidate in which Krawczyk's test holds.
//!
//! The centre comes from Newton's method with exact residuals ([`newton`]), the radii from
//! Krawczyk's inequality ([`krawczyk`]). Both start on a grid of [`FIRST_GRID_BITS`] bits. Where a
//! sign that the claim needs is not decided over the box (a local mode has components of 1e-20 of
//! the largest), the grid is made finer and the box shrinks with it, down to [`LAST_GRID_BITS`].

mod krawczyk;
pub(super) mod newton;

use super::failure::AttemptFailure;
use super::rows::IntegralRows;
use crate::candidate::Candidate;
use crate::tolerance::{VALUE_RADIUS, X_RADIUS};
use krawczyk::Krawczyk;
use mceip_check::certificate::EnclosedSolution;
use mceip_exact::{Integer, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use newton::{Newton, Point};
use num_traits::Signed;

/// Bits of the centre's largest component of x, and of its value, that are tried first. Basis: a
/// value is printed with 17 digits, which are 57 bits.
const FIRST_GRID_BITS: u32 = 64;
/// The same, tried last; each try has twice the bits of the one before. Basis: components of 1e-150
/// of the largest are decided, and a component that is zero costs four tries.
const LAST_GRID_BITS: u32 = 512;

/// A box around the candidate in which Krawczyk's test should hold; `check` decides whether it
/// does.
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

    let first_inverse = newton
        .inverse(&point)
        .ok_or(AttemptFailure::SingularJacobian)?;
    newton.polish(&mut point, &first_inverse);
    is_near(&newton, &point, candidate)?;

    // At the polished centre the inverse is better.
    let inverse = newton
        .inverse(&point)
        .ok_or(AttemptFailure::SingularJacobian)?;
    let krawczyk = Krawczyk::new(&newton, &point, &inverse)?;

    let mut bits = FIRST_GRID_BITS;
    loop {
        newton.polish(&mut point, &inverse);
        let radius = krawczyk
            .radii(&newton, &point)
            .ok_or(AttemptFailure::NotContracting)?;
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

fn claim(
    support: &[usize],
    point: &Point,
    radius: &[Integer],
    krawczyk: Krawczyk,
) -> EnclosedSolution {
    let last = point.x.len();
    let number = |k: usize, units: &Integer| Number(point.in_units(k, units));

    let center = (0..=last).map(|k| number(k, point.component(k))).collect();
    let radius = radius
        .iter()
        .enumerate()
        .map(|(k, r)| number(k, r))
        .collect();
    let (preconditioner, exponent) = krawczyk.into_preconditioner();
    EnclosedSolution {
        support: support.to_vec(),
        center,
        radius,
        preconditioner,
        exponent,
    }
}

/// Is the polished point the candidate, up to its rounding?
fn is_near(
    newton: &Newton<'_>,
    point: &Point,
    candidate: &Candidate,
) -> Result<(), AttemptFailure> {
    let start = newton.start(candidate, FIRST_GRID_BITS)?;
    let difference = |k: usize| to_f64(&(point.value(k) - start.value(k))).abs();
    let distance = (0..=point.x.len()).map(difference).fold(0.0, f64::max);

    let limit = X_RADIUS.max(VALUE_RADIUS * (1.0 + candidate.value.abs()));
    if distance > limit {
        Err(AttemptFailure::TooFar {
            distance,
            limit: X_RADIUS,
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
        match self {
            Undecided::Value => AttemptFailure::Undecided {
                what: "value - end of the window".into(),
                bits,
            },
            Undecided::X(index) => AttemptFailure::Undecided {
                what: format!("x[{index}]"),
                bits,
            },
            Undecided::Y(index) => AttemptFailure::Undecided {
                what: format!("y[{index}]"),
                bits,
            },
        }
    }
}

/// A number known up to its radius, both in one unit.
struct Ball {
    center: Integer,
    radius: Integer,
}

/// Where every number of a ball lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Above,
    Below,
    /// Zero, or both signs.
    Around,
}

impl Ball {
    fn side(&self) -> Side {
        if self.center > self.radius {
            Side::Above
        } else if -&self.center > self.radius {
            Side::Below
        } else {
            Side::Around
        }
    }
}

/// The box of a claim: centre and radii in units of the point's grid.
struct Enclosure<'a> {
    newton: &'a Newton<'a>,
    point: &'a Point,
    radius: &'a [Integer],
}

impl Enclosure<'_> {
    /// The first sign that the box leaves open: of the value in the window, of x on the support, of
    /// y off it.
    ///
    /// # Errors
    /// A sign that is wrong all over the box.
    fn undecided(&self, window: &Window) -> Result<Option<Undecided>, AttemptFailure> {
        let outside = || AttemptFailure::NoRootNear {
            lo: window.min().to_string(),
            hi: window.max().map_or("infinity".into(), ToString::to_string),
        };
        match self.value_in(window) {
            Side::Above => {}
            Side::Below => return Err(outside()),
            Side::Around => return Ok(Some(Undecided::Value)),
        }

        for (k, &index) in self.newton.active.iter().enumerate() {
            if !self.newton.is_in_support(index) {
                continue;
            }
            let x = Ball {
                center: self.point.x[k].clone(),
                radius: self.radius[k].clone(),
            };
            match x.side() {
                Side::Above => {}
                Side::Below => return Err(AttemptFailure::XNotPositive { index }),
                Side::Around => return Ok(Some(Undecided::X(index))),
            }
        }

        for index in self.newton.inactive() {
            match self.y(index).side() {
                Side::Above => {}
                Side::Below => return Err(AttemptFailure::YNegative { index }),
                Side::Around => return Ok(Some(Undecided::Y(index))),
            }
        }
        Ok(None)
    }

    /// `Above` where all values of the box lie in the window, whose ends belong to it; `Below`
    /// where none does.
    fn value_in(&self, window: &Window) -> Side {
        let last = self.point.x.len();
        let (center, radius) = (
            self.point.value(last),
            self.point.in_units(last, &self.radius[last]),
        );
        let (lo, hi) = (&center - &radius, &center + &radius);

        let holds = lo >= *window.min() && window.max().is_none_or(|max| hi <= *max);
        let fails = hi < *window.min() || window.max().is_some_and(|max| lo > *max);
        if holds {
            Side::Above
        } else if fails {
            Side::Below
        } else {
            Side::Around
        }
    }

    /// y_i = sum_j (a_ij + t b_ij) x_j over the box, in units of the grid of x times that of t.
    fn y(&self, index: usize) -> Ball {
        let last = self.point.x.len();
        let mut y = Ball {
            center: Integer::default(),
            radius: Integer::default(),
        };

        for (k, a, b) in self.newton.active_entries(index) {
            let (x, around_x) = (&self.point.x[k], &self.radius[k]);
            let entry = self.point.entry(a, b);
            let around_entry = b.abs() * &self.radius[last];

            y.center += &entry * x;
            y.radius += entry.abs() * around_x + around_entry * (x.abs() + around_x);
        }
        y
    }
}

#[cfg(test)]
mod tests;
