//! How far the data of a body may be off: the members of a problem.
//!
//! A system with radii stands for all its *members*: K' and M' symmetric with
//!
//! ```text
//!     |K' - K| <= R_K,    |M' - M| <= R_M    entry by entry,
//! ```
//!
//! the friction factor of each particle anywhere in its interval, independent of all others, and
//! such that section 2's hypotheses hold (`spec/robust.md`). An entry without a radius is exact.

use super::{ModelError, Particle};
use mceip_exact::{Rational, Sparse, whole};
use num_traits::{Signed as _, Zero as _};

/// R_K and R_M: symmetric matrices of the shape of K and M, no entry negative.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Radii {
    /// R_K, where K is not exact.
    pub stiffness: Option<Sparse>,
    /// R_M, where M is not exact.
    pub mass: Option<Sparse>,
}

impl Radii {
    /// No radius anywhere.
    pub const NONE: Radii = Radii {
        stiffness: None,
        mass: None,
    };

    /// Is everything exact?
    pub fn is_none(&self) -> bool {
        let Radii { stiffness, mass } = self;
        stiffness.is_none() && mass.is_none()
    }

    /// The radius of each entry of a matrix that is not zero: the same for all.
    pub fn absolute(matrix: &Sparse, radius: &Rational) -> Sparse {
        of_entries(matrix, |_| radius.clone())
    }

    /// The radius of each entry of a matrix: a share of its absolute value.
    pub fn relative(matrix: &Sparse, share: &Rational) -> Sparse {
        of_entries(matrix, |entry| entry.abs() * share)
    }

    /// Demands matrices of the order `n` that are symmetric and have no negative entry; a radius of
    /// M without M has no meaning.
    pub(super) fn establish(self, n: usize, has_mass: bool) -> Result<Radii, ModelError> {
        let Radii { stiffness, mass } = self;
        if mass.is_some() && !has_mass {
            return Err(ModelError::RadiusWithoutMass);
        }

        Ok(Radii {
            stiffness: established("the radius of K", stiffness, n)?,
            mass: established("the radius of M", mass, n)?,
        })
    }
}

/// `None` for a matrix of zeros.
fn established(
    what: &'static str,
    radius: Option<Sparse>,
    n: usize,
) -> Result<Option<Sparse>, ModelError> {
    let Some(radius) = radius else {
        return Ok(None);
    };

    super::pencil::require_square("E3", what, &radius, n)?;
    super::pencil::require_symmetric("E3", what, &radius)?;
    if let Some((row, col, value)) = radius.entries().find(|(_, _, r)| r.is_negative()) {
        return Err(ModelError::RadiusNegative {
            what,
            row,
            col,
            got: value.clone(),
        });
    }

    let is_zero = radius.entries().next().is_none();
    Ok((!is_zero).then_some(radius))
}

fn of_entries(matrix: &Sparse, radius: impl Fn(&Rational) -> Rational) -> Sparse {
    let entries = matrix.entries().map(|(i, j, entry)| (i, j, radius(entry)));
    Sparse::from_entries(matrix.rows(), matrix.cols(), entries)
}

impl Particle {
    /// The middle of the interval of its friction factor, > 0, and half its width over that: the
    /// factors of the members are middle (1 + d) with |d| at most the second number, which is 0
    /// where the factor is exact and 1 at most.
    pub fn friction_factor_ball(&self) -> (Rational, Rational) {
        match &self.friction_factor_range {
            None => (self.friction_factor.clone(), Rational::zero()),
            Some([lo, hi]) => ((lo + hi) / whole(2), (hi - lo) / (hi + lo)),
        }
    }
}

/// Demands 0 <= lo < hi with the factor itself between them.
pub(super) fn check_friction_range(index: usize, particle: &Particle) -> Result<(), ModelError> {
    let Some([lo, hi]) = &particle.friction_factor_range else {
        return Ok(());
    };

    let factor = &particle.friction_factor;
    if !lo.is_negative() && lo < hi && lo <= factor && factor <= hi {
        return Ok(());
    }

    Err(ModelError::FrictionFactorRange {
        particle: index,
        factor: factor.clone(),
        lo: lo.clone(),
        hi: hi.clone(),
    })
}
