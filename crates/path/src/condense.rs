//! From a body to its contact side: K and the loads condensed exactly, in the directions of each
//! contact candidate.
//!
//! One Schur complement gives both: with i the dofs of no candidate and c the others,
//!
//! ```text
//! [C | h] = [K_cc | f_c] - K_ci K_ii^-1 [K_ic | f_i]
//! ```
//!
//! Then the two dofs of each candidate are turned into its tangent and its normal. Input is a
//! [`System`]; the states of its particles play no part.

use super::contact::{Contact, ContactSide};
use super::error::PathError;
use mceip_exact::{Rational, Sparse, schur_complement};
use mceip_model::{Direction, ModelError, Particle, System};
use num_traits::{One, Zero};

impl Contact {
    /// Condenses a body: the one long step of a path (seconds for 800 elements). Each of the
    /// `loads` is a force over all dofs, `gaps` are those of the particles in file order.
    ///
    /// # Errors
    /// [`PathError::Condensation`] for a body that is not held; [`PathError::Model`] for a load or
    /// gaps of another length; [`PathError::NegativeGap`].
    pub fn condense(
        system: &System,
        gaps: &[Rational],
        loads: &[Vec<Rational>],
    ) -> Result<Contact, PathError> {
        let dofs = system.dofs();
        for load in loads {
            require_length(load.len(), dofs)?;
        }

        let mut contact = Vec::new();
        let mut is_inside = vec![true; dofs];
        for particle in system.particles() {
            for dof in [particle.tangential, particle.normal] {
                contact.push(dof);
                is_inside[dof] = false;
            }
        }

        let inside: Vec<usize> = (0..dofs).filter(|&dof| is_inside[dof]).collect();
        let condensed = condensed(system.stiffness(), loads, &inside, &contact)?;

        let turn = Turn::of(system.particles());
        let order = contact.len();
        let stiffness = turn.rows_and_columns(&columns(&condensed, 0..order));
        let loads = columns(&condensed, order..condensed.cols())
            .iter()
            .map(|load| turn.vector(load))
            .collect();
        let factors = system.particles().iter();

        Contact::new(ContactSide {
            stiffness,
            loads,
            gaps: gaps.to_vec(),
            friction_factors: factors.map(|p| p.friction_factor.clone()).collect(),
        })
    }
}

fn require_length(got: usize, dofs: usize) -> Result<(), ModelError> {
    if got == dofs {
        return Ok(());
    }

    Err(ModelError::Shape {
        equation: "E5",
        what: "load",
        expected_rows: dofs,
        expected_cols: 1,
        rows: got,
        cols: 1,
    })
}

/// [C | h] over the dofs of the candidates.
fn condensed(
    stiffness: &Sparse,
    loads: &[Vec<Rational>],
    inside: &[usize],
    contact: &[usize],
) -> Result<Sparse, PathError> {
    let beside = |rows: &[usize]| beside_loads(stiffness, loads, rows, contact);
    let contact_rows = beside(contact);
    if inside.is_empty() {
        return Ok(contact_rows);
    }

    Ok(schur_complement(
        &stiffness.submatrix(inside, inside),
        &beside(inside),
        &stiffness.submatrix(contact, inside),
        &contact_rows,
    )?)
}

/// [K_rc | f_r] for the rows r.
fn beside_loads(
    stiffness: &Sparse,
    loads: &[Vec<Rational>],
    rows: &[usize],
    contact: &[usize],
) -> Sparse {
    let block = stiffness.submatrix(rows, contact);
    let mut entries: Vec<(usize, usize, Rational)> = Vec::new();
    for (i, j, value) in block.entries() {
        entries.push((i, j, value.clone()));
    }

    for (k, load) in loads.iter().enumerate() {
        for (i, &row) in rows.iter().enumerate() {
            if !load[row].is_zero() {
                entries.push((i, contact.len() + k, load[row].clone()));
            }
        }
    }

    Sparse::from_entries(rows.len(), contact.len() + loads.len(), entries)
}

/// These columns of a matrix, each as a vector.
fn columns(matrix: &Sparse, range: std::ops::Range<usize>) -> Vec<Vec<Rational>> {
    let mut columns = vec![vec![Rational::zero(); matrix.rows()]; range.len()];
    for (i, j, value) in matrix.entries() {
        if range.contains(&j) {
            columns[j - range.start][i] = value.clone();
        }
    }

    columns
}

/// The directions of the candidates: D, orthogonal, with a block for each of them.
struct Turn {
    /// For each candidate its tangent and its normal into the obstacle, along its two dofs.
    blocks: Vec<[[Rational; 2]; 2]>,
}

impl Turn {
    fn of(particles: &[Particle]) -> Turn {
        let mut blocks = Vec::with_capacity(particles.len());
        for particle in particles {
            let along = |direction: Direction| {
                [particle.tangential, particle.normal].map(|dof| {
                    let mut entries = direction.iter();
                    let entry = entries.find(|(of, _)| *of == dof);
                    entry.map_or_else(Rational::zero, |(_, value)| value.clone())
                })
            };
            blocks.push([along(particle.tangent()), along(particle.into_obstacle())]);
        }

        Turn { blocks }
    }

    /// D x.
    fn vector(&self, x: &[Rational]) -> Vec<Rational> {
        let mut turned = Vec::with_capacity(x.len());
        for (block, x) in self.blocks.iter().zip(x.chunks(2)) {
            for direction in block {
                turned.push(combination(direction, x));
            }
        }

        turned
    }

    /// D C D' for a symmetric C given by its columns: first D C, then D (D C)'.
    fn rows_and_columns(&self, columns: &[Vec<Rational>]) -> Vec<Vec<Rational>> {
        let turned: Vec<Vec<Rational>> = columns.iter().map(|column| self.vector(column)).collect();
        let transposed: Vec<Vec<Rational>> = (0..turned.len())
            .map(|i| turned.iter().map(|column| column[i].clone()).collect())
            .collect();
        transposed.iter().map(|row| self.vector(row)).collect()
    }
}

/// direction' x, where a direction is as a rule one of the two dofs itself.
fn combination(direction: &[Rational; 2], x: &[Rational]) -> Rational {
    let mut sum = Rational::zero();
    for (coefficient, x) in direction.iter().zip(x) {
        if coefficient.is_one() {
            sum += x;
        } else if !coefficient.is_zero() {
            sum += coefficient * x;
        }
    }

    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use mceip_model::ContactState;

    fn matrix(rows: &[&[i64]]) -> Sparse {
        Sparse::from_ints(rows)
    }

    /// One inner dof between two of a candidate: C and h by hand.
    #[test]
    fn stiffness_and_load_are_condensed_together() {
        // K_ii = 2, K_ci = (1, -1)', K_cc = diag(3, 4); f = (1, 5, 6) with the inner dof first.
        let stiffness = matrix(&[&[2, 1, -1], &[1, 3, 0], &[-1, 0, 4]]);
        let particle = Particle {
            normal_direction: -1,
            ..Particle::plain(1, 2, ContactState::Stick)
        };
        let system = System::new(stiffness, None, None, vec![particle]).unwrap();
        let load = vec![whole(1), whole(5), whole(6)];

        let contact = Contact::condense(&system, &[whole(0)], &[load]).unwrap();

        // C = [[5/2, 1/2], [1/2, 7/2]], h = (9/2, 13/2); the normal points against its dof.
        let half = |n: i64| n as f64 / 2.0;
        assert_eq!(
            contact.rows_f64(),
            vec![
                vec![half(5), half(-1), half(-9), 0.0],
                vec![half(-1), half(7), half(13), 0.0],
            ]
        );
    }

    /// A candidate whose tangent is turned, without inner dofs: C' = D C D'.
    #[test]
    fn oblique_candidates_are_turned() {
        let stiffness = matrix(&[&[2, 0], &[0, 7]]);
        let (c, s) = (rational(3, 5), rational(4, 5));
        let particle = Particle {
            frame: Some([[c.clone(), s.clone()], [-s, c]]),
            ..Particle::plain(0, 1, ContactState::Stick)
        };
        let system = System::new(stiffness, None, None, vec![particle]).unwrap();
        let load = vec![whole(5), whole(10)];

        let contact = Contact::condense(&system, &[whole(1)], &[load]).unwrap();

        let fifths = |n: i64| n as f64 / 25.0;
        assert_eq!(
            contact.rows_f64(),
            vec![
                vec![fifths(130), fifths(60), -11.0, fifths(60)],
                vec![fifths(60), fifths(95), -2.0, fifths(95)],
            ]
        );
        assert!(Contact::condense(&system, &[whole(-1)], &[]).is_err());
        assert!(Contact::condense(&system, &[whole(0)], &[vec![whole(1)]]).is_err());
    }
}
