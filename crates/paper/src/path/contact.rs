//! The block seen from its contact side: the condensed stiffness in tangential and normal
//! directions, exactly, and the loads, the friction and the responses of its nodes.

use super::error::PathError;
use crate::block::Block;
use mceip_exact::{Integer, Rational, Sparse, common_denominator, schur_complement};
use num_traits::Zero;

/// K condensed to the contact nodes, S = K_cc - K_ci K_ii^-1 K_ic, as integers over one
/// denominator.
///
/// Component 2k is u_T of node k (positive to the right), 2k + 1 is u_N (positive *into* the
/// obstacle, the paper's direction). The glued side does not appear: when it moves as a rigid
/// body by g, the reactions are those of the displacements relative to it, r = S (u - g), because
/// K vanishes on translations of the whole block.
#[derive(Debug, Clone)]
pub struct Contact {
    rows: Vec<Vec<Integer>>,
    denominator: Integer,
}

impl Contact {
    /// Condenses a block exactly: the one long step of a path (seconds for 800 elements).
    ///
    /// # Errors
    /// [`PathError::Condensation`]; none for a block that was assembled.
    pub fn of(block: &Block) -> Result<Contact, PathError> {
        let k = &block.stiffness;
        let held: Vec<usize> = block
            .contact
            .iter()
            .flat_map(|&node| [2 * node, 2 * node + 1])
            .collect();
        let mut inside = vec![true; k.rows()];
        held.iter().for_each(|&d| inside[d] = false);
        let inside: Vec<usize> = (0..k.rows()).filter(|&d| inside[d]).collect();
        let part = |rows: &[usize], cols: &[usize]| k.submatrix(rows, cols);
        let condensed = schur_complement(
            &part(&inside, &inside),
            &part(&inside, &held),
            &part(&held, &inside),
            &part(&held, &held),
        )?;
        Ok(Contact::from_condensed(&condensed))
    }

    /// From the condensed stiffness in (x, y) of each node, the obstacle below.
    pub(super) fn from_condensed(condensed: &Sparse) -> Contact {
        let n = condensed.rows();
        let denominator = common_denominator(condensed.entries().map(|e| e.2));
        let mut rows = vec![vec![Integer::zero(); n]; n];
        for (i, j, v) in condensed.entries() {
            let value = v.numer() * (&denominator / v.denom());
            rows[i][j] = if (i + j).is_multiple_of(2) {
                value
            } else {
                -value
            }; // N = -y
        }
        Contact { rows, denominator }
    }

    /// Number of contact nodes.
    pub fn nodes(&self) -> usize {
        self.rows.len() / 2
    }

    /// Bits of the common denominator of the condensed stiffness.
    pub fn bits(&self) -> u64 {
        self.denominator.bits()
    }

    /// The common denominator of S (positive).
    pub(super) fn denominator(&self) -> &Integer {
        &self.denominator
    }

    /// The numerators of S, by rows.
    pub(super) fn rows(&self) -> &[Vec<Integer>] {
        &self.rows
    }

    /// Numerators of S w.
    pub(super) fn times(&self, w: &[Integer]) -> Vec<Integer> {
        self.rows
            .iter()
            .map(|row| {
                row.iter()
                    .zip(w)
                    .filter(|(_, w)| !w.is_zero())
                    .map(|(s, w)| s * w)
                    .sum()
            })
            .collect()
    }

    /// The displacement of every contact node under a rigid motion of the glued side, per mm:
    /// relative to it, the nodes move the other way.
    pub(super) fn relative(&self, load: Load) -> Vec<Integer> {
        let n = self.rows.len();
        match load {
            Load::Press => (0..n)
                .map(|i| Integer::from(-i64::from(i % 2 == 1)))
                .collect(), // g = e_N
            Load::Left => (0..n)
                .map(|i| Integer::from(i64::from(i % 2 == 0)))
                .collect(), // g = -e_T
            Load::Held(k) => (0..n)
                .map(|i| Integer::from(i64::from(i == 2 * k)))
                .collect(),
        }
    }
}

/// What is imposed on the block, one unit (mm) of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Load {
    /// The glued side moves towards the obstacle.
    Press,
    /// The glued side moves to the left.
    Left,
    /// A stuck node stands one unit to the right of its natural place.
    Held(usize),
}

/// Displacements and reactions of the contact nodes for one load each: u = `u` / `denominator`,
/// r = `r` / (`denominator` times that of the contact).
pub(super) struct Response {
    pub(super) denominator: Integer,
    pub(super) u: Vec<Vec<Integer>>,
    pub(super) r: Vec<Vec<Integer>>,
}

/// Coefficient of friction as a pair of positive integers.
#[derive(Debug, Clone)]
pub(super) struct Friction {
    pub(super) numerator: Integer,
    pub(super) denominator: Integer,
}

impl Friction {
    pub(super) fn new(mu: &Rational) -> Friction {
        Friction {
            numerator: mu.numer().clone(),
            denominator: mu.denom().clone(),
        }
    }

    /// The combination of a slip node's rows that vanishes: r_T + S mu r_N = 0. // E7
    pub(super) fn on_cone(&self, sign: i8) -> (Integer, Integer) {
        (
            self.denominator.clone(),
            &self.numerator * Integer::from(sign),
        )
    }
}
