//! Measured in doubles: complex lambda^2 of the all-slip pencil at mu. They lie outside (8).
//!
//! With every slip particle slipping (lambda^2 M* + K*) x = 0, so the lambda^2 are the eigenvalues
//! of -M*^-1 K*. A complex one is a growing oscillation (flutter) of *steady sliding*: of a body
//! whose slip particles all slide against their reactions, so that a small x of either sign leaves
//! them sliding. At rest it is no motion: a slip particle moves one way only, x' >= 0, and cannot
//! oscillate through zero velocity. So nothing follows for the equilibrium, which may be stable.
//!
//! Input: K* and M* as functions of mu. Output: [`Flutter`]; nothing is proved.
//!
//! Where such eigenvalues begin is looked for by trying values of mu: evenly spread ones first, and
//! then by halving below the smallest that has some. Called by [`analyse`](super::analyse).

use super::families::Families;
use crate::dense::{rounded, transposed};
use crate::tolerance::{FLUTTER_ANGLE, FLUTTER_NOISE};
use mceip_exact::{Rational, whole};
use mceip_mcp::linear::{eigenvalues, solve};
use mceip_model::{MuFamily, Pencil};
use std::cmp::Ordering;

/// Complex lambda^2 of (lambda^2 M* + K*) x = 0 with every slip particle slipping: flutter of
/// steady sliding in these contact states, not of the equilibrium at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Flutter {
    /// lambda^2 = re + i im with im > 0, by ascending frequency.
    pub eigenvalues: Vec<(f64, f64)>,
    /// Largest growth rate Re lambda of them, in 1/s, 0 without any.
    pub growth_rate: f64,
    /// Im lambda of that one, rad/s.
    pub frequency: f64,
    /// Where in mu they begin; `None` without any, or where that was not looked for.
    pub onset: Option<Onset>,
}

/// Two neighbouring values of mu, of those that were tried.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Onset {
    /// The largest value below `some_at`; it has no complex lambda^2, nor has any smaller one that
    /// was tried.
    pub none_at: Rational,
    /// The smallest value with complex lambda^2.
    pub some_at: Rational,
}

/// A growing oscillation: a pair lambda = growth rate +- i frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillation {
    /// Re lambda, 1/s.
    pub growth_rate: f64,
    /// |Im lambda|, rad/s.
    pub frequency: f64,
}

impl Oscillation {
    /// The frequency in cycles per second.
    pub fn hertz(self) -> f64 {
        self.frequency / std::f64::consts::TAU
    }
}

impl Flutter {
    /// The oscillations of all complex lambda^2, by ascending frequency.
    pub fn pairs(&self) -> Vec<Oscillation> {
        let roots = self.eigenvalues.iter().map(|eigenvalue| root(*eigenvalue));
        roots
            .map(|(growth_rate, frequency)| Oscillation {
                growth_rate,
                frequency,
            })
            .collect()
    }
}

/// Order beyond which the dense eigenproblem is not tried.
const LARGEST_ORDER: usize = 2500;

/// Order beyond which it is not tried at more than one mu.
const LARGEST_ORDER_OF_ONSET: usize = 200;

/// Evenly spread values of mu that are tried for the onset.
const VALUES: i64 = 8;

/// Halvings between two of them.
const HALVINGS: u32 = 12;

/// The complex lambda^2 at mu and their onset; `None` beyond the largest order, without a mass, or
/// where doubles fail. Particles with zero reaction have no such pencil either: their friction
/// depends on the sign of v.
pub(super) fn flutter(families: &Families, mu: &Rational) -> Option<Flutter> {
    if !families.zero.is_empty() {
        return None;
    }

    let family = &families.own;
    let eigenvalues = complex_eigenvalues(family, mu)?;

    let mut growth_rate = 0.0;
    let mut frequency = 0.0;
    for eigenvalue in &eigenvalues {
        let (growth, at) = root(*eigenvalue);
        if growth > growth_rate {
            growth_rate = growth;
            frequency = at;
        }
    }

    let is_cheap = family.stiffness.order() <= LARGEST_ORDER_OF_ONSET;
    let onset = if is_cheap && !eigenvalues.is_empty() {
        let has_some = |mu: &Rational| Some(!complex_eigenvalues(family, mu)?.is_empty());
        onset(mu, &has_some)
    } else {
        None
    };

    Some(Flutter {
        eigenvalues,
        growth_rate,
        frequency,
        onset,
    })
}

/// Where in (0, mu] complex lambda^2 begin, given that there are some at mu. `None` if there are
/// some at 0 already, or where doubles fail.
fn onset(mu: &Rational, has_some: &dyn Fn(&Rational) -> Option<bool>) -> Option<Onset> {
    let step = mu / whole(VALUES);
    let mut onset = Onset {
        none_at: whole(0),
        some_at: mu.clone(),
    };
    if has_some(&onset.none_at)? {
        return None;
    }

    for k in 1..VALUES {
        let tried = &step * whole(k);
        if has_some(&tried)? {
            onset.some_at = tried;
            break;
        }
        onset.none_at = tried;
    }

    for _ in 0..HALVINGS {
        let middle = (&onset.none_at + &onset.some_at) / whole(2);
        if has_some(&middle)? {
            onset.some_at = middle;
        } else {
            onset.none_at = middle;
        }
    }

    Some(onset)
}

/// The complex lambda^2 at mu, by ascending frequency.
fn complex_eigenvalues(family: &MuFamily, mu: &Rational) -> Option<Vec<(f64, f64)>> {
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

    let largest = solved.iter().flatten().fold(0.0f64, |s, v| s.max(v.abs()));
    let noise = FLUTTER_NOISE * largest;
    let mut complex = eigenvalues(&transposed(&solved))?;
    complex.retain(|(re, im)| *im > noise && *im > FLUTTER_ANGLE * re.hypot(*im));
    complex.sort_by(|p, q| by_ascending_frequency(*p, *q));

    Some(complex)
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
fn root((re, im): (f64, f64)) -> (f64, f64) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    /// Complex from 1/3 to 1/2 and from 2 on.
    fn has_some(mu: &Rational) -> Option<bool> {
        Some((rational(1, 3)..rational(1, 2)).contains(mu) || *mu >= whole(2))
    }

    #[test]
    fn the_onset_is_between_neighbours_of_those_tried() {
        // 3/8 is the first of the even values in [1/3, 1/2), and 2 of those up to 4.
        for (mu, expected) in [
            (rational(3, 1), rational(1, 3)),
            (rational(4, 1), rational(2, 1)),
        ] {
            let found = onset(&mu, &has_some).unwrap();

            assert_eq!(has_some(&found.none_at), Some(false));
            assert_eq!(has_some(&found.some_at), Some(true));
            let width = &found.some_at - &found.none_at;
            assert_eq!(width, mu / whole(VALUES << HALVINGS));
            let is_about_it = found.none_at < expected && expected <= found.some_at;
            assert!(is_about_it, "{found:?}");
        }
    }

    #[test]
    fn without_a_value_that_has_none_there_is_no_onset() {
        assert_eq!(onset(&whole(1), &|_| Some(true)), None);
        assert_eq!(onset(&whole(1), &|_| None), None);
    }
}
