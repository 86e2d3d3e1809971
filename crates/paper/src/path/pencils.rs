//! The condensed MCEIP-mu pencil of any contact state, from the one condensation of the path: only
//! the free contact nodes are left to eliminate.

use super::contact::Contact;
use super::error::PathError;
use super::linear::{Images, solve};
use mceip_exact::{Integer, Rational, Sparse};
use mceip_model::{ContactState, ModelError, Pencil};
use num_integer::Integer as _;
use num_traits::{One, Zero};

/// Makes condensed pencils; keeps what they share.
pub struct Pencils<'a> {
    contact: &'a Contact,
    images: Images,
}

impl Contact {
    /// A maker of condensed pencils for many states of this block.
    pub fn pencils(&self) -> Pencils<'_> {
        Pencils {
            contact: self,
            images: Images::default(),
        }
    }
}

impl Pencils<'_> {
    /// A + mu B of order n_s, exactly: variables x = -S v_T of the slip nodes, left to right. The
    /// same matrices as `mceip_engine::reduction::condense` of the state's MCEIP-mu problem. // E16
    ///
    /// # Errors
    /// [`PathError::Model`] for a number of states other than that of contact nodes, or no slip
    /// node.
    pub fn of(&mut self, states: &[ContactState]) -> Result<Pencil, PathError> {
        let nodes = self.contact.nodes();
        if states.len() != nodes {
            let (expected_rows, rows) = (nodes, states.len());
            return Err(ModelError::Shape {
                equation: "E9",
                what: "contact states",
                expected_rows,
                expected_cols: 1,
                rows,
                cols: 1,
            }
            .into());
        }
        let free: Vec<usize> = (0..2 * nodes)
            .filter(|i| states[i / 2] == ContactState::Free)
            .collect();
        let sign = |k: usize| match states[k] {
            ContactState::Slip { sign } => Some((k, Integer::from(sign))),
            _ => None,
        };
        let slip: Vec<(usize, Integer)> = (0..nodes).filter_map(sign).collect();
        if slip.is_empty() {
            return Err(ModelError::Empty {
                what: "the slip particles of the system",
            }
            .into());
        }
        let equations: Vec<_> = free.iter().map(|&i| vec![(i, Integer::one())]).collect();
        let unit = |k: usize| {
            (0..2 * nodes)
                .map(|i| Integer::from(i64::from(i == 2 * k)))
                .collect()
        };
        let imposed: Vec<Vec<Integer>> = slip.iter().map(|(k, _)| unit(*k)).collect();
        let solved = solve(self.contact, &mut self.images, &free, &equations, &imposed);
        let (den, w) = solved.ok_or(PathError::SingularFreeNodes)?;
        // Reactions for v_T = 1 at each slip node in turn, over den times the contact's
        // denominator.
        let r: Vec<Vec<Integer>> = w.iter().map(|w| self.contact.times(w)).collect();
        let scale = Scale::of(den * self.contact.denominator(), &r);
        let n = slip.len();
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for (p, (k, s_p)) in slip.iter().enumerate() {
            for (q, (_, s_q)) in slip.iter().enumerate() {
                a.push((p, q, scale.value(&(&r[q][2 * k] * s_p * s_q)))); // S K_TT S
                b.push((p, q, scale.value(&(&r[q][2 * k + 1] * s_q)))); // K_NT S
            }
        }
        Ok(Pencil::new(
            Sparse::from_entries(n, n, a),
            Sparse::from_entries(n, n, b),
            Vec::new(),
        )?)
    }
}

/// A common denominator, and the factor that it shares with all numerators: dividing it out first
/// halves the numbers whose fractions are then reduced one by one.
struct Scale {
    denominator: Integer,
    shared: Integer,
}

impl Scale {
    fn of(denominator: Integer, numerators: &[Vec<Integer>]) -> Scale {
        let shared = numerators.iter().flatten().filter(|v| !v.is_zero()).fold(
            denominator.clone(),
            |g, v| {
                // A long gcd only while it still changes.
                if (v % &g).is_zero() { g } else { g.gcd(v) }
            },
        );
        Scale {
            denominator: denominator / &shared,
            shared,
        }
    }

    fn value(&self, numerator: &Integer) -> Rational {
        Rational::new(numerator / &self.shared, self.denominator.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Block, BlockModel, MeshKind, Plane};
    use mceip_engine::reduction::{condense, reduce};
    use mceip_model::{Admissible, Unknown};

    /// Two ways to the same exact matrices: through (10)-(16) and the uncondensed K, and from S.
    #[test]
    fn pencils_are_those_of_the_reduction() {
        let slip = |sign| ContactState::Slip { sign };
        let states = [
            vec![
                ContactState::Stick,
                slip(1),
                slip(1),
                slip(1),
                ContactState::Free,
            ],
            vec![
                ContactState::Free,
                slip(1),
                slip(-1),
                ContactState::Stick,
                slip(-1),
            ],
            vec![slip(1); 5],
        ];
        let model = BlockModel {
            mesh: MeshKind::UnionJack,
            plane: Plane::Strain,
            ..BlockModel::of_the_paper().with_cells(4, 2)
        };
        let block = Block::new(&model).unwrap();
        let contact = Contact::of(&block).unwrap();
        let mut pencils = contact.pencils();
        for states in &states {
            let reduced = reduce(&block.problem(states, None).unwrap())
                .unwrap()
                .pencil;
            let expected = condense(&Admissible::new(&reduced, Unknown::Mu).unwrap()).unwrap();
            assert_eq!(pencils.of(states).unwrap(), expected);
        }
        assert!(matches!(
            pencils.of(&states[0][1..]),
            Err(PathError::Model(ModelError::Shape { .. }))
        ));
        assert!(matches!(
            pencils.of(&[ContactState::Stick; 5]),
            Err(PathError::Model(ModelError::Empty { .. }))
        ));
    }
}
