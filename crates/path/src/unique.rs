//! How many rates solve the rate problem at the beginning of a stretch: is the path the only one?
//!
//! For the candidates on their cones the rates solve 0 <= x ⟂ T(mu) x + q >= 0 with the condensed
//! pencil T(mu) = A + mu B (16) and a q that depends on the load: exactly one x for every q if and
//! only if T(mu) is a P-matrix, all its principal minors positive (Samelson, Thrall and Wesler
//! 1958). A matrix whose symmetric part is positive definite is one: x_i (T x)_i <= 0 for all i
//! gives x'T x <= 0. Else the minors are tested by the recursion of Tsatsomeros and Li.
//!
//! The rates of a candidate without reaction have four pieces: it sticks, slips to either side, or
//! opens. They are sectors of the plane of r' - u', and the map from r' - u' of all candidates to
//! the load is linear on products of sectors and half lines. Its determinants are the principal
//! minors of T(mu) with the candidate left out, slipping to either side, and open, times the
//! determinant of the stiffness of the open candidates; that of a K which is definite on them is
//! positive, and no other is looked at. If all are positive the map is coherently oriented; no face
//! of codimension two has more than four pieces around it, so that the map is bijective (Kuhn and
//! Löwen 1987). A body that can move without force where candidates open has a determinant 0.
//!
//! Where that fails every set of states is tried for the load that grows ([`super::rates`]). All
//! of it is exact; none of it is the work of the checker.

use super::contact::{Contact, FrictionCoefficients, Load, open_components};
use super::error::PathError;
use super::line::Class;
use super::loading_path::LoadingPath;
use super::pencils::Pencils;
use super::rates::Rates;
use mceip_exact::{Integer, Rational, Sparse, positive_definite};
use mceip_model::ContactState;
use num_traits::Signed;

/// The rates that solve a rate problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RateSolutions {
    /// Exactly one, whatever load grows.
    OneForEveryLoad,
    /// For the load that grows: these, and no others where no set is singular.
    Listed {
        /// The states of each solution, those with the same rates once.
        states: Vec<Vec<ContactState>>,
        /// Sets of states in which the body can move without force.
        singular: usize,
    },
    /// More sets of states than are tried.
    NotTried,
    /// The work was cancelled before.
    NotExamined,
}

impl RateSolutions {
    /// Is there exactly one for the load that grows, proved?
    pub fn is_one(&self) -> bool {
        match self {
            RateSolutions::OneForEveryLoad => true,
            RateSolutions::Listed { states, singular } => states.len() == 1 && *singular == 0,
            RateSolutions::NotTried | RateSolutions::NotExamined => false,
        }
    }
}

/// Order up to which all principal minors are tested.
const MINORS_UP_TO: usize = 10;

/// Candidates without reaction up to which all their pieces are gone through.
const ZEROS_UP_TO: usize = 3;

impl LoadingPath {
    /// The rates that solve the rate problem at the beginning of a stretch (from 0); `pencils` of
    /// the condensed body, for all stretches the same.
    ///
    /// # Errors
    /// [`PathError`]: those of condensing to the states there.
    ///
    /// # Panics
    /// For a stretch that there is not.
    pub fn rate_solutions(
        &self,
        pencils: &mut Pencils<'_>,
        stretch: usize,
    ) -> Result<RateSolutions, PathError> {
        let stretch = &self.stretches[stretch];
        let states = stretch.start.contact_states();
        if is_one_for_every_load(pencils, &self.steps.friction, states)? {
            return Ok(RateSolutions::OneForEveryLoad);
        }

        let contact = pencils.contact;

        let classes: Vec<Class> = states.iter().map(|state| Class::of(*state)).collect();
        let growing = Load::Step(stretch.step);
        let problem = Rates {
            contact,
            friction: &FrictionCoefficients::new(&self.steps.friction, contact),
            classes: &classes,
            causes: &[],
            loads: &|_| vec![growing],
            growing,
        };
        Ok(match problem.all(&mut pencils.images) {
            None => RateSolutions::NotTried,
            Some(all) => RateSolutions::Listed {
                states: all.solved.into_iter().map(|solved| solved.states).collect(),
                singular: all.singular,
            },
        })
    }
}

/// Is there one solution for every load at this equilibrium? `false` also where it is not decided.
pub(super) fn is_one_for_every_load(
    pencils: &mut Pencils<'_>,
    mu: &Rational,
    states: &[ContactState],
) -> Result<bool, PathError> {
    let zeros: Vec<usize> = (0..states.len())
        .filter(|&node| states[node] == ContactState::Zero)
        .collect();
    if zeros.len() > ZEROS_UP_TO {
        return Ok(false);
    }
    // Soundness hangs on this: of a K that is not definite, pieces have determinants of both signs.
    if !zeros.is_empty() && !has_definite_stiffness(pencils.contact, states) {
        return Ok(false);
    }

    let pieces = [
        ContactState::Free,
        ContactState::Slip { sign: 1 },
        ContactState::Slip { sign: -1 },
    ];
    let mut states = states.to_vec();
    for choice in 0..pieces.len().pow(zeros.len() as u32) {
        let mut rest = choice;
        for &node in &zeros {
            states[node] = pieces[rest % pieces.len()];
            rest /= pieces.len();
        }
        if !is_p_matrix_at(pencils, mu, &states)? {
            return Ok(false);
        }
    }

    Ok(true)
}

/// Is the stiffness of the candidates that are open, or may open, positive definite?
fn has_definite_stiffness(contact: &Contact, states: &[ContactState]) -> bool {
    let open = open_components(states);
    let mut entries = Vec::with_capacity(open.len() * open.len());
    for (i, &row) in open.iter().enumerate() {
        for (j, &column) in open.iter().enumerate() {
            let entry = contact.rows()[row][column].clone();
            entries.push((i, j, Rational::from_integer(entry)));
        }
    }
    let order = open.len();
    positive_definite(&Sparse::from_entries(order, order, entries)).is_ok()
}

/// Is the stiffness of the open candidates regular, and T(mu) of those that slip a P-matrix?
/// `false` also where it is not decided.
fn is_p_matrix_at(
    pencils: &mut Pencils<'_>,
    mu: &Rational,
    states: &[ContactState],
) -> Result<bool, PathError> {
    // Soundness hangs on this: without it a body that floats has one way to go on.
    let Some(t) = pencils.at(mu, states)? else {
        return Ok(false);
    };
    if t.is_empty() || has_definite_symmetric_part(&t) {
        return Ok(true);
    }

    Ok(t.len() <= MINORS_UP_TO && has_positive_minors(&fractions(&t)))
}

impl Pencils<'_> {
    /// Is the symmetric part of T(mu) of these states positive definite? Then T(mu) is a P-matrix.
    ///
    /// # Errors
    /// As [`Pencils::of`].
    pub fn is_definite_at(
        &mut self,
        mu: &Rational,
        states: &[ContactState],
    ) -> Result<bool, PathError> {
        let t = self.at(mu, states)?;
        Ok(t.is_some_and(|t| !t.is_empty() && has_definite_symmetric_part(&t)))
    }
}

fn has_definite_symmetric_part(t: &[Vec<Integer>]) -> bool {
    let order = t.len();
    let mut twice = Vec::with_capacity(order * order);
    for (i, row) in t.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            twice.push((i, j, Rational::from_integer(entry + &t[j][i])));
        }
    }

    positive_definite(&Sparse::from_entries(order, order, twice)).is_ok()
}

fn fractions(matrix: &[Vec<Integer>]) -> Vec<Vec<Rational>> {
    let rows = matrix.iter();
    rows.map(|row| row.iter().cloned().map(Rational::from_integer).collect())
        .collect()
}

/// Are all principal minors positive? They are if and only if the first entry is, and both the
/// matrix without its first row and column and the Schur complement of the first entry have
/// positive principal minors.
fn has_positive_minors(matrix: &[Vec<Rational>]) -> bool {
    let Some((first, others)) = matrix.split_first() else {
        return true;
    };
    let pivot = &first[0];
    if !pivot.is_positive() {
        return false;
    }

    let mut without = Vec::with_capacity(others.len());
    let mut complement = Vec::with_capacity(others.len());
    for row in others {
        let factor = &row[0] / pivot;
        let pairs = row[1..].iter().zip(&first[1..]);
        complement.push(
            pairs
                .map(|(entry, above)| entry - &factor * above)
                .collect(),
        );
        without.push(row[1..].to_vec());
    }

    has_positive_minors(&without) && has_positive_minors(&complement)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn rows(rows: &[&[i64]]) -> Vec<Vec<Rational>> {
        let rows = rows.iter();
        rows.map(|row| row.iter().map(|&entry| whole(entry)).collect())
            .collect()
    }

    #[test]
    fn p_matrices_have_positive_principal_minors() {
        assert!(has_positive_minors(&rows(&[&[1, -3], &[4, 1]])));
        assert!(has_positive_minors(&rows(&[
            &[1, 0, -9],
            &[-9, 1, 0],
            &[0, -9, 1000]
        ])));

        for (entries, what) in [
            (rows(&[&[1, 0], &[0, -1]]), "the second entry"),
            (rows(&[&[1, 2], &[3, 1]]), "the determinant"),
            (rows(&[&[1, 1], &[1, 1]]), "a determinant of 0"),
            (rows(&[&[1, 0, 0], &[0, 1, 2], &[0, 3, 1]]), "rows 1 and 2"),
            (rows(&[&[1, 0, 2], &[0, 1, 0], &[3, 0, 1]]), "rows 0 and 2"),
        ] {
            assert!(!has_positive_minors(&entries), "{what}");
        }
    }
}
