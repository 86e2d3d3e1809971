//! The reduced pencil with the meaning of its variables, as data.
//!
//! [`crate::reduction::reduce`] makes it; the oracle and the engine read it.

use crate::{Direction, ModelError, Pencil};
use mceip_exact::Rational;
use num_traits::One;

/// What a variable of the reduced pencil stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReducedVariable {
    /// x = v at a degree of freedom of f.
    Free {
        /// The degree of freedom.
        dof: usize,
    },
    /// x = -S v_T of a particle in impending slip.
    Slip {
        /// S = sign(r_T).
        sign: i8,
        /// Its unit tangent.
        tangent: Direction,
        /// Its unit normal into the obstacle.
        normal: Direction,
    },
    /// One of the three variables of a particle in contact with zero reaction.
    Zero {
        /// Their places.
        variables: ZeroVariables,
        /// Which of the three.
        part: ZeroPart,
        /// The motion that belongs to x = 1.
        column: Direction,
    },
}

/// The variables of a particle in contact with zero reaction (`spec/zero-reaction.md`, Z.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ZeroPart {
    /// g = -v_N.
    Gap,
    /// v+ = max(v_T, 0).
    Right,
    /// v- = max(-v_T, 0).
    Left,
}

impl ZeroPart {
    /// The word of reports.
    pub fn word(self) -> &'static str {
        match self {
            ZeroPart::Gap => "gap",
            ZeroPart::Right => "right",
            ZeroPart::Left => "left",
        }
    }
}

/// The places of the three variables of a particle in contact with zero reaction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ZeroVariables {
    /// The particle's number in the system.
    pub particle: usize,
    /// g, the rate at which the gap opens.
    pub gap: usize,
    /// v+, sliding along the tangent.
    pub right: usize,
    /// v-, sliding against the tangent.
    pub left: usize,
}

impl ZeroVariables {
    /// The half of v_T off a support whose y vanishes with those of the support, if there is one.
    ///
    /// y_right + y_left = 2 c mu y_gap for every x, c the friction factor. So where the gap and one
    /// half are in the support, y = 0 at the other half.
    pub fn vanishing(&self, support: &[usize]) -> Option<usize> {
        if !support.contains(&self.gap) {
            return None;
        }

        let slides_right = support.contains(&self.right);
        let slides_left = support.contains(&self.left);
        match (slides_right, slides_left) {
            (true, false) => Some(self.left),
            (false, true) => Some(self.right),
            _ => None,
        }
    }
}

impl ReducedVariable {
    /// Is it v+ or v- of a z particle, of which one is 0 in every motion?
    pub fn is_half(&self) -> bool {
        matches!(self, ReducedVariable::Zero { part, .. } if *part != ZeroPart::Gap)
    }

    /// The motion v that belongs to x = 1. // (10)
    pub fn column(&self) -> Direction {
        match self {
            ReducedVariable::Free { dof } => vec![(*dof, Rational::one())],
            ReducedVariable::Zero { column, .. } => column.clone(),
            ReducedVariable::Slip { sign, tangent, .. } => {
                let minus_s = Rational::from_integer((-sign).into());
                tangent.iter().map(|(d, c)| (*d, c * &minus_s)).collect()
            }
        }
    }
}

/// A pencil with the meaning of its variables: f ascending, then slip particles in file order, then
/// gap, right and left of each particle in contact with zero reaction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reduced {
    /// The pencil of (12) or (21), with z particles that of the split form.
    pub pencil: Pencil,
    /// One entry per variable; empty for a problem that was given as a pencil.
    pub variables: Vec<ReducedVariable>,
    /// The variables of the z particles, in file order.
    pub zero: Vec<ZeroVariables>,
}

impl Reduced {
    /// The same, for what treats all complementarity variables alike.
    ///
    /// # Errors
    /// [`ModelError::ZeroReaction`] with z particles: some solutions of the pencil are no motion.
    pub fn without_zero(self) -> Result<Reduced, ModelError> {
        self.require_no_zero()?;
        Ok(self)
    }

    /// Demands that no particle is in contact with zero reaction.
    ///
    /// # Errors
    /// As [`Reduced::without_zero`].
    pub fn require_no_zero(&self) -> Result<(), ModelError> {
        match self.zero.first() {
            None => Ok(()),
            Some(&ZeroVariables { particle, .. }) => Err(ModelError::ZeroReaction { particle }),
        }
    }

    /// The variables of e'x_s, by which solutions are normalised: the complementarity variables but
    /// those of particles in contact with zero reaction.
    pub fn normalised(&self) -> Vec<usize> {
        let mut slip = self.pencil.slip();
        slip.retain(|&i| !matches!(self.variables.get(i), Some(ReducedVariable::Zero { .. })));
        slip
    }
}

/// K* and M* as functions of mu, before a value of mu is put in. // (15)
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MuFamily {
    /// K* = K0 + mu K1.
    pub stiffness: Pencil,
    /// M* = M0 + mu M1, where the system has a mass.
    pub mass: Option<Pencil>,
    /// What the variables stand for.
    pub variables: Vec<ReducedVariable>,
}
