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
