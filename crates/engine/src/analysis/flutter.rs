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
use crate::run::Watch;
use crate::search::complete::pieces::matrix::{absolute, largest_entry};
use crate::tolerance::{FLUTTER_ANGLE, FLUTTER_ROUNDING};
use mceip_exact::{Rational, whole};
use mceip_mcp::linear::{eigenvalues, inverse, sensitive_eigenvalues, solve};
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
    /// Where in mu they begin; `None` without any, where that was not looked for, and after an
    /// interrupt.
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

/// Order beyond which it is not tried at more than one mu, and not with eigenvectors.
const LARGEST_ORDER_OF_ONSET: usize = 200;

/// Evenly spread values of mu that are tried for the onset.
const VALUES: i64 = 8;

/// Halvings between two of them.
const HALVINGS: u32 = 12;

/// The complex lambda^2 at mu and their onset; `None` beyond the largest order, without a mass, or
/// where doubles fail. Particles with zero reaction have no such pencil either: their friction
/// depends on the sign of v. An interrupt is heard between the eigenproblems.
pub(super) fn flutter(families: &Families, mu: &Rational, watch: &Watch<'_>) -> Option<Flutter> {
    if !families.zero.is_empty() {
        return None;
    }

    let family = &families.own;
    let mut eigenvalues = complex_at(family, mu, watch)?;
    eigenvalues.sort_by(|p, q| by_ascending_frequency(*p, *q));

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
        let has_some = |mu: &Rational| Some(!complex_at(family, mu, watch)?.is_empty());
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
/// some at 0 already, where doubles fail, or after an interrupt.
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

/// The complex lambda^2 at mu, in no particular order; `None` beyond the largest order, without a
/// mass, where doubles fail, or after an interrupt.
fn complex_at(family: &MuFamily, mu: &Rational, watch: &Watch<'_>) -> Option<Vec<(f64, f64)>> {
    let mass = family.mass.as_ref()?;
    if family.stiffness.order() > LARGEST_ORDER || watch.is_cancelled() {
        return None;
    }

    complex_eigenvalues(&dense_at(&family.stiffness, mu), &dense_at(mass, mu))
}

/// The complex eigenvalues of A = -M^-1 K, those above the real axis, in no particular order.
///
/// A real eigenvalue of multiplicity m becomes m eigenvalues around it in doubles, complex ones
/// among them, at a distance of the m-th root of rounding; so no angle tells them from flutter.
/// What tells is the sensitivity: a change of A by its rounding moves each of them to the real
/// axis. That rounding is what solving with M leaves in each entry, a share of |M^-1| |M| |A|; no
/// change of units of the dofs has a part in it, and none in rows that do not touch the
/// eigenvector. For a large matrix, whose eigenvectors take long, the angle has to do.
fn complex_eigenvalues(stiffness: &[Vec<f64>], mass: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let mut columns = transposed(stiffness);
    for column in &mut columns {
        for entry in column {
            *entry = -*entry;
        }
    }

    let matrix = transposed(&solve(mass, &columns)?);
    let order = matrix.len() as f64;
    if matrix.len() > LARGEST_ORDER_OF_ONSET {
        let mut complex = eigenvalues(&matrix)?;
        let rounding = FLUTTER_ROUNDING * order * largest_entry(&matrix);
        complex.retain(|(re, im)| *im > rounding && *im > FLUTTER_ANGLE * re.hypot(*im));
        return Some(complex);
    }

    let share = FLUTTER_ROUNDING * order;
    let mut changes = product(
        &product(&absolute(&inverse(mass)?), &absolute(mass)),
        &absolute(&matrix),
    );
    for change in changes.iter_mut().flatten() {
        *change *= share;
    }

    let mut complex = sensitive_eigenvalues(&matrix, &changes)?;
    let residuals = FLUTTER_ROUNDING / f64::EPSILON;
    complex.retain(|z| z.im > z.sensitivity + residuals * z.residual);
    Some(complex.iter().map(|z| (z.re, z.im)).collect())
}

/// The product of two square matrices.
fn product(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut product = vec![vec![0.0; b.len()]; a.len()];
    for (i, row) in a.iter().enumerate() {
        for (k, factor) in row.iter().enumerate() {
            for (sum, entry) in product[i].iter_mut().zip(&b[k]) {
                *sum += factor * entry;
            }
        }
    }

    product
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
    use crate::run::Cancel;
    use mceip_exact::rational;
    use mceip_oracle::TwoParticles;
    use mceip_paper::two_particles;

    #[test]
    fn an_interrupt_is_heard_before_an_eigenproblem() {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(1),
            m: whole(2),
            mu: whole(1),
            signs: (1, 1),
        };
        let families = Families::of(&two_particles(&data).unwrap()).unwrap();

        let stopped = Cancel::requested();
        assert!(flutter(&families, &whole(1), &Watch::nobody()).is_some());
        assert!(flutter(&families, &whole(1), &Watch::silent(&stopped)).is_none());
    }

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

    fn identity(order: usize) -> Vec<Vec<f64>> {
        let mut identity = vec![vec![0.0; order]; order];
        for (k, row) in identity.iter_mut().enumerate() {
            row[k] = 1.0;
        }
        identity
    }

    /// The complex eigenvalues of a matrix, as those of a stiffness for M = I.
    fn without_mass(matrix: &[Vec<f64>]) -> Vec<(f64, f64)> {
        let mut stiffness = matrix.to_vec();
        stiffness.iter_mut().flatten().for_each(|v| *v = -*v);
        complex_eigenvalues(&stiffness, &identity(matrix.len())).unwrap()
    }

    /// K = M [[4, -1], [0, 4]] with det M = 1e-4: lambda^2 = -4 twice.
    #[test]
    fn a_double_eigenvalue_of_a_nearly_singular_mass_is_not_complex() {
        let mass = [vec![1.0, 2.25], vec![2.25, 5.0626]];
        let stiffness = [vec![4.0, 8.0], vec![9.0, 18.0004]];

        assert_eq!(complex_eigenvalues(&stiffness, &mass), Some(vec![]));

        // A mass of very different units has no part in it: -1 +- i.
        let mass = [vec![1.0, 0.0], vec![0.0, 1e-9]];
        let stiffness = [vec![1.0, -1.0], vec![1e-9, 1e-9]];
        assert_eq!(complex_eigenvalues(&stiffness, &mass).unwrap().len(), 1);
    }

    /// A = S D S^-1 with S of small whole numbers and the eigenvalue 1 of multiplicity `order`:
    /// doubles find it split by the `order`-th root of rounding.
    fn jordan_block(order: usize, coupling: f64) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; order]; order];
        for row in 0..order {
            rows[row][row] = 1.0;
            if row + 1 < order {
                rows[row][row + 1] = coupling;
            }
        }

        // Rows row += row + 1 times w, columns col + 1 -= col times w: a similarity by I + w E.
        for step in 0..order - 1 {
            let weight = 1.0 + 0.7 * step as f64;
            let below = rows[step + 1].clone();
            for (entry, add) in rows[step].iter_mut().zip(below) {
                *entry += weight * add;
            }
            for row in &mut rows {
                row[step + 1] -= weight * row[step];
            }
            rows = transposed(&rows);
        }
        rows
    }

    #[test]
    fn a_real_eigenvalue_that_doubles_split_is_not_complex() {
        let mut split = 0;
        for order in 2..=7 {
            for coupling in [0.3, 1.0, 7.0] {
                let matrix = jordan_block(order, coupling);
                let found = eigenvalues(&matrix).unwrap();
                split += found.iter().filter(|(_, im)| *im > 1e-10).count();

                let complex = without_mass(&matrix);
                assert!(complex.is_empty(), "order {order}: {found:?}");
            }
        }
        assert!(split > 10, "{split} eigenvalues were split");
    }

    /// K = [[2, 1], [-1, 2]] with the unit of one dof changed, or with a very stiff spring beside
    /// it.
    #[test]
    fn units_and_stiff_springs_elsewhere_have_no_part_in_it() {
        for unit in [1e-12, 1e-7, 1e7, 1e12] {
            let stiffness = [vec![2.0, unit], vec![-unit, 2.0 * unit * unit]];
            let mass = [vec![1.0, 0.0], vec![0.0, unit * unit]];
            let found = complex_eigenvalues(&stiffness, &mass).unwrap();
            assert_eq!(found.len(), 1, "{unit}");
        }

        for spring in [1e14, 1e20] {
            let stiffness = [
                vec![2.0, 1.0, 0.0],
                vec![-1.0, 2.0, 0.0],
                vec![0.0, 0.0, spring],
            ];
            let found = complex_eigenvalues(&stiffness, &identity(3)).unwrap();
            assert_eq!(found.len(), 1, "{spring}");
        }
    }

    #[test]
    fn a_complex_pair_close_to_the_real_axis_is_found() {
        // (1 - t)^2 + d^2 = 0.
        for distance in [1e-1, 1e-3, 1e-5] {
            let matrix = [vec![1.0, distance], vec![-distance, 1.0]];
            assert_eq!(without_mass(&matrix).len(), 1, "{distance}");
        }
    }

    /// -2 +- i beside -2: the real part of the pair is an eigenvalue of its own.
    #[test]
    fn a_complex_pair_beside_a_real_eigenvalue_of_its_real_part_is_found() {
        let matrix = [
            vec![-2.0, 0.0, 0.0],
            vec![0.0, -2.0, -1.0],
            vec![0.0, 1.0, -2.0],
        ];
        assert_eq!(without_mass(&matrix), [(-2.0, 1.0)]);
    }
}
