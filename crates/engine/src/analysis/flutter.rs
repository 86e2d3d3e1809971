//! A warning from doubles: complex lambda^2 of the all-slip pencil at mu. They lie outside (8).
//!
//! With every slip particle slipping (lambda^2 M* + K*) x = 0, so the lambda^2 are the eigenvalues
//! of -M*^-1 K*. A complex one means growing oscillation (flutter), whatever the signs of x. Input:
//! K* and M* as functions of mu. Output: [`Flutter`]; nothing is proved. Called by
//! [`analyse`](super::analyse).

use super::families::Families;
use crate::dense::{rounded, transposed};
use crate::tolerance::FLUTTER_ANGLE;
use mceip_exact::Rational;
use mceip_mcp::linear::{eigenvalues, solve};
use mceip_model::Pencil;
use std::cmp::Ordering;

/// Complex lambda^2 of (lambda^2 M* + K*) x = 0 with every slip particle slipping.
#[derive(Debug, Clone, PartialEq)]
pub struct Flutter {
    /// lambda^2 = re + i im with im > 0, by ascending frequency.
    pub eigenvalues: Vec<(f64, f64)>,
    /// Largest growth rate Re lambda of them, in 1/s, 0 without any.
    pub growth_rate: f64,
    /// Im lambda of that one, rad/s.
    pub frequency: f64,
}

/// Order beyond which the dense eigenproblem is not tried.
const LARGEST_ORDER: usize = 2500;

/// The complex lambda^2 at mu; `None` beyond the largest order, without a mass, or where doubles
/// fail. Particles with zero reaction have no such pencil either: their friction depends on the
/// sign of v.
pub(super) fn flutter(families: &Families, mu: &Rational) -> Option<Flutter> {
    if !families.zero.is_empty() {
        return None;
    }

    let family = &families.own;
    let mass = family.mass.as_ref()?;
    if family.stiffness.order() > LARGEST_ORDER {
        return None;
    }

    // -M*^-1 K*, column by column.
    let mut columns = transposed(&dense_at(&family.stiffness, mu));
    for column in &mut columns {
        for entry in column {
            *entry = -*entry;
        }
    }

    let solved = solve(&dense_at(mass, mu), &columns)?;

    let mut complex = eigenvalues(&transposed(&solved))?;
    complex.retain(|(re, im)| *im > FLUTTER_ANGLE * re.hypot(*im));
    complex.sort_by(|p, q| by_ascending_frequency(*p, *q));

    let mut growth_rate = 0.0;
    let mut frequency = 0.0;
    for eigenvalue in &complex {
        let (growth, at) = root(*eigenvalue);
        if growth > growth_rate {
            growth_rate = growth;
            frequency = at;
        }
    }

    Some(Flutter {
        eigenvalues: complex,
        growth_rate,
        frequency,
    })
}

/// A + mu B by rows, each entry rounded to the nearest double.
fn dense_at(pencil: &Pencil, mu: &Rational) -> Vec<Vec<f64>> {
    rounded(&pencil.a().add_scaled(mu, pencil.b()))
}

/// Smaller Im lambda first; of equal ones the larger Re lambda.
fn by_ascending_frequency(p: (f64, f64), q: (f64, f64)) -> Ordering {
    let (growth_of_p, frequency_of_p) = root(p);
    let (growth_of_q, frequency_of_q) = root(q);
    frequency_of_p
        .total_cmp(&frequency_of_q)
        .then(growth_of_q.total_cmp(&growth_of_p))
}

/// lambda of lambda^2 = re + i im: the square root with positive real part, (Re, Im).
pub(super) fn root((re, im): (f64, f64)) -> (f64, f64) {
    let size = re.hypot(im);
    // |z| + re without cancellation where re < 0.
    let growth = if re >= 0.0 {
        (0.5 * (size + re)).sqrt()
    } else {
        0.5 * im.abs() / (0.5 * (size - re)).sqrt()
    };

    let frequency = 0.5 * im / growth;
    (growth, frequency)
}
