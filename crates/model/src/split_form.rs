//! The pencil of a system with particles in contact with zero reaction, as data.
//!
//! [`crate::reduction::split_form`] makes it; the oracle reads it. `spec/zero-reaction.md`, Z.3.

use super::{Direction, Pencil};

/// The places of the three variables of a z particle.
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

/// The pencil of the split form with the meaning of its variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SplitForm {
    /// f ascending, s in file order, then gap, right and left of each z particle in file order.
    pub pencil: Pencil,
    /// The motion that each variable stands for: v = sum_j x_j d_j.
    pub columns: Vec<Direction>,
    /// The variables of the s particles.
    pub slip: Vec<usize>,
    /// The variables of the z particles.
    pub zero: Vec<ZeroVariables>,
}
