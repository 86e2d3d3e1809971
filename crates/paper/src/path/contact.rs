//! The block seen from its contact side: the condensed stiffness in tangential and normal
//! directions, exactly, and the loads, the friction and the responses of its nodes.
//!
//! With c the dofs of the contact nodes and i all others, C = K_cc - K_ci K_ii^-1 K_ic. Reactions
//! are r = C (u - g), where u are the displacements of the contact nodes and g is the rigid motion
//! of the glued side. The assembled K of a [`Block`] goes in; all of `path` reads C from here.

use super::error::PathError;
use crate::block::Block;
use mceip_exact::{Integer, Rational, Sparse, common_denominator, schur_complement};
use num_traits::{One, Zero};

/// K condensed to the contact nodes, C = K_cc - K_ci K_ii^-1 K_ic, as integers over one
/// denominator.
///
/// Component 2k is u_T of node k (positive to the right), 2k + 1 is u_N (positive *into* the
/// obstacle, the paper's direction). The glued side does not appear: when it moves as a rigid
/// body by g, the reactions are those of the displacements relative to it, r = C (u - g), because
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
        let stiffness = &block.stiffness;

        let mut contact = Vec::new();
        let mut is_inside = vec![true; stiffness.rows()];
        for &node in &block.contact {
            for dof in [2 * node, 2 * node + 1] {
                contact.push(dof);
                is_inside[dof] = false;
            }
        }

        let inside: Vec<usize> = (0..stiffness.rows()).filter(|&d| is_inside[d]).collect();

        let condensed = schur_complement(
            &stiffness.submatrix(&inside, &inside),
            &stiffness.submatrix(&inside, &contact),
            &stiffness.submatrix(&contact, &inside),
            &stiffness.submatrix(&contact, &contact),
        )?;
        Ok(Contact::from_condensed(&condensed))
    }

    /// From the condensed stiffness in (x, y) of each node, the obstacle below.
    pub(super) fn from_condensed(condensed: &Sparse) -> Contact {
        let order = condensed.rows();
        let denominator = common_denominator(condensed.entries().map(|entry| entry.2));

        // The normal direction is -y, so entries that couple x and y change their sign.
        let mut rows = vec![vec![Integer::zero(); order]; order];
        for (i, j, value) in condensed.entries() {
            let numerator = value.numer() * (&denominator / value.denom());
            let couples_x_and_y = !(i + j).is_multiple_of(2);
            rows[i][j] = if couples_x_and_y {
                -numerator
            } else {
                numerator
            };
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

    /// The common denominator of C (positive).
    pub(super) fn denominator(&self) -> &Integer {
        &self.denominator
    }

    /// The numerators of C, by rows.
    pub(super) fn rows(&self) -> &[Vec<Integer>] {
        &self.rows
    }

    /// Numerators of C w.
    pub(super) fn times(&self, w: &[Integer]) -> Vec<Integer> {
        let mut product = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let mut sum = Integer::zero();
            for (entry, component) in row.iter().zip(w) {
                if !component.is_zero() {
                    sum += entry * component;
                }
            }

            product.push(sum);
        }

        product
    }

    /// The displacement -g of every contact node relative to the glued side, per mm of a load: when
    /// the glued side moves by g, the nodes move the other way.
    pub(super) fn relative(&self, load: Load) -> Vec<Integer> {
        let mut relative = vec![Integer::zero(); self.rows.len()];
        match load {
            // g = e_N
            Load::Press => {
                for normal in relative.iter_mut().skip(1).step_by(2) {
                    *normal = -Integer::one();
                }
            }
            // g = -e_T
            Load::Left => {
                for tangential in relative.iter_mut().step_by(2) {
                    *tangential = Integer::one();
                }
            }
            Load::Held(node) => relative[2 * node] = Integer::one(),
        }

        relative
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
    /// By load, then by component.
    pub(super) u: Vec<Vec<Integer>>,
    /// By load, then by component.
    pub(super) r: Vec<Vec<Integer>>,
}

/// Displacements and reactions of all contact nodes, or their rates. Each of the two vectors is
/// given up to a positive factor: only signs and zeros are asked for.
#[derive(Clone, Copy)]
pub(super) struct NodalValues<'a> {
    /// u_T and u_N of each node in turn.
    pub(super) u: &'a [Integer],
    /// r_T and r_N of each node in turn.
    pub(super) r: &'a [Integer],
}

/// Coefficient of friction as a pair of positive integers.
#[derive(Debug, Clone)]
pub(super) struct Friction {
    pub(super) numerator: Integer,
    pub(super) denominator: Integer,
}

/// Coefficients of r_T and r_N in the condition that a node is on the friction cone.
pub(super) struct ConeRow {
    pub(super) tangential: Integer,
    pub(super) normal: Integer,
}

impl Friction {
    pub(super) fn new(mu: &Rational) -> Friction {
        Friction {
            numerator: mu.numer().clone(),
            denominator: mu.denom().clone(),
        }
    }

    /// The coefficient of friction mu.
    pub(super) fn coefficient(&self) -> Rational {
        Rational::new(self.numerator.clone(), self.denominator.clone())
    }

    /// The combination of a slip node's rows that vanishes, r_T + S mu r_N = 0, times the
    /// denominator of mu. // (7)
    pub(super) fn on_cone(&self, sign: i8) -> ConeRow {
        ConeRow {
            tangential: self.denominator.clone(),
            normal: &self.numerator * Integer::from(sign),
        }
    }
}
