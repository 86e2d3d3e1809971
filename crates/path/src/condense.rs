//! From a body to its contact side: K and the loads condensed, exactly or in doubles, in the
//! directions of each contact candidate.
//!
//! With i the dofs of no candidate and c the others,
//!
//! ```text
//! [C | h] = [K_cc | f_c] - K_ci K_ii^-1 [K_ic | f_i]
//! ```
//!
//! where each load is divided by its content. Then the two dofs of each candidate are turned into
//! its tangent and its normal. Exactly it is one Schur complement, modulo primes. In doubles it is
//! a sparse Cholesky factorisation, and the condensed body is taken as it comes out: another body
//! than the one given, by rounding. Input is a [`System`]; the states of its particles play no
//! part.

use super::contact::{Contact, ContactSide, require_length};
use super::error::PathError;
use mceip_exact::{
    Integer, Rational, Sparse, cleared, common_denominator, from_f64, schur_complement, to_f64,
};
use mceip_mcp::linear::{SymbolicAnalysis, Symmetric};
use mceip_model::{Direction, ModelError, Particle, System};
use num_integer::Integer as _;
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
        let contact = dofs_of_candidates(system, loads)?;
        let inside = all_but(system.dofs(), &contact);
        let contents: Vec<Rational> = loads.iter().map(|load| content(load)).collect();
        let short = loads.iter().zip(&contents);
        let short: Vec<Vec<Rational>> = short.map(|(load, content)| over(load, content)).collect();
        let condensed = condensed(system.stiffness(), &short, &inside, &contact)?;

        let order = contact.len();
        Contact::turned(
            system,
            gaps,
            &columns(&condensed, 0..order),
            &columns(&condensed, order..condensed.cols()),
            contents,
        )
    }

    /// [`Contact::condense`] in doubles, for bodies of any size: what comes out is exactly the
    /// contact side of a body whose condensed stiffness and loads are those doubles.
    ///
    /// # Errors
    /// As [`Contact::condense`]; [`PathError::NotDefinite`] for a body that is not held.
    pub fn condense_in_doubles(
        system: &System,
        gaps: &[Rational],
        loads: &[Vec<Rational>],
    ) -> Result<Contact, PathError> {
        let contact = dofs_of_candidates(system, loads)?;
        let entries = system.stiffness().entries();
        let entries = entries.map(|(i, j, entry)| (i, j, to_f64(entry)));
        let stiffness = Symmetric::new(system.dofs(), entries)?;

        let analysis = SymbolicAnalysis::new(&stiffness, &contact, &[], None);
        let factor = analysis.factor(&stiffness).map_err(|e| {
            let dof = e.index;
            PathError::NotDefinite { dof }
        })?;
        let mut condensed_loads = Vec::with_capacity(loads.len());
        for load in loads {
            let load: Vec<f64> = load.iter().map(to_f64).collect();
            condensed_loads.push(exactly(&factor.restrict(&load))?);
        }
        let rows = factor.schur().iter();
        let stiffness = rows
            .map(|row| exactly(row))
            .collect::<Result<Vec<_>, _>>()?;

        let contents = vec![Rational::one(); loads.len()];
        Contact::turned(system, gaps, &stiffness, &condensed_loads, contents)
    }

    /// From C, given by its columns, and h, both along the dofs of the candidates.
    fn turned(
        system: &System,
        gaps: &[Rational],
        stiffness: &[Vec<Rational>],
        loads: &[Vec<Rational>],
        contents: Vec<Rational>,
    ) -> Result<Contact, PathError> {
        let particles = system.particles();
        let turn = Turn::of(particles);
        Contact::new(ContactSide {
            stiffness: turn.rows_and_columns(stiffness),
            loads: loads.iter().map(|load| turn.vector(load)).collect(),
            contents,
            gaps: gaps.to_vec(),
            friction_factors: particles
                .iter()
                .map(|p| p.friction_factor.clone())
                .collect(),
        })
    }
}

/// The two dofs of each candidate in turn.
fn dofs_of_candidates(system: &System, loads: &[Vec<Rational>]) -> Result<Vec<usize>, ModelError> {
    for load in loads {
        require_length("load", load.len(), system.dofs())?;
    }

    let particles = system.particles().iter();
    Ok(particles.flat_map(|p| [p.tangential, p.normal]).collect())
}

/// The largest c > 0 for which load / c is in integers; 1 of a load that is zero.
fn content(load: &[Rational]) -> Rational {
    let denominator = common_denominator(load);
    let mut common = Integer::zero();
    for force in load {
        common = common.gcd(&(cleared(force, &denominator)));
    }

    if common.is_zero() {
        Rational::one()
    } else {
        Rational::new(common, denominator)
    }
}

/// load / content, integers.
fn over(load: &[Rational], content: &Rational) -> Vec<Rational> {
    load.iter().map(|force| force / content).collect()
}

fn all_but(dofs: usize, taken: &[usize]) -> Vec<usize> {
    let mut is_left = vec![true; dofs];
    for &dof in taken {
        is_left[dof] = false;
    }

    (0..dofs).filter(|&dof| is_left[dof]).collect()
}

/// The values of doubles.
fn exactly(values: &[f64]) -> Result<Vec<Rational>, PathError> {
    let values = values.iter();
    Ok(values
        .map(|value| from_f64(*value))
        .collect::<Result<Vec<_>, _>>()?)
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

    /// In doubles the same comes out where doubles are exact; a body that is not held is refused.
    #[test]
    fn doubles_condense_the_same() {
        let stiffness = matrix(&[&[4, 2, -2], &[2, 3, 0], &[-2, 0, 4]]);
        let particle = Particle::plain(1, 2, ContactState::Stick);
        let system = System::new(stiffness, None, None, vec![particle.clone()]).unwrap();
        let load = vec![whole(1), whole(5), whole(6)];
        let (gaps, loads) = ([rational(1, 2)], [load]);

        let exact = Contact::condense(&system, &gaps, &loads).unwrap();
        let doubles = Contact::condense_in_doubles(&system, &gaps, &loads).unwrap();
        assert_eq!(exact.rows_f64(), doubles.rows_f64());

        let loose = matrix(&[&[0, 0, 0], &[0, 3, 0], &[0, 0, 4]]);
        let loose = System::assuming_definite(loose, None, None, vec![particle]).unwrap();
        let refused = Contact::condense_in_doubles(&loose, &gaps, &loads);
        assert!(matches!(refused, Err(PathError::NotDefinite { dof: 0 })));
    }

    /// A candidate whose tangent is turned, without inner dofs: C' = D C D'. The load is five times
    /// (1, 2).
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
                vec![fifths(130), fifths(60), -2.2, fifths(60)],
                vec![fifths(60), fifths(95), -0.4, fifths(95)],
            ]
        );
        assert_eq!(contact.content(0), &whole(5));
        assert!(Contact::condense(&system, &[whole(-1)], &[]).is_err());
        assert!(Contact::condense(&system, &[whole(0)], &[vec![whole(1)]]).is_err());
    }
}
