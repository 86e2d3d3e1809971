//! K* and M* as functions of mu: those whose solutions are sought, and those of condition (19).
//!
//! Without particles of zero reaction both are (15). With such particles solutions are sought in
//! the split form (`spec/zero-reaction.md`, Z.3), whose symmetric part is never definite, while
//! (19z) counts these particles as free (Z.4). A tail rests on the latter as well.
//!
//! Input: a system. Called by [`analyse`](super::analyse), `critical` and `absence`.

use super::absence::{FamilyRadii, parts_of};
use super::conditions::{DefiniteUntil, Necessary, condensed};
use mceip_model::reduction::{mu_family, zero_variables};
use mceip_model::{ModelError, MuFamily, Pencil, System, ZeroVariables};

/// The families of a system.
pub(super) struct Families {
    /// K* and M* of all that moves: those of the split form, if there is zero reaction.
    pub(super) own: MuFamily,
    /// Those of the system in which particles with zero reaction are free, if there are such.
    with_zero_free: Option<MuFamily>,
    /// The variables of the particles with zero reaction.
    pub(super) zero: Vec<ZeroVariables>,
    /// How far members may be from them, where the data have radii.
    pub(super) radii: Option<FamilyRadii>,
}

impl Families {
    /// Those in the middle of all members.
    ///
    /// # Errors
    /// As [`mu_family`].
    pub(super) fn of(system: &System) -> Result<Families, ModelError> {
        let radii = FamilyRadii::of(system)?;
        let middle;
        let system = if radii.is_some() {
            middle = system.middle();
            &middle
        } else {
            system
        };
        let zero = zero_variables(system);
        let with_zero_free = if zero.is_empty() {
            None
        } else {
            Some(mu_family(&system.with_zero_free())?)
        };

        Ok(Families {
            own: mu_family(system)?,
            with_zero_free,
            zero,
            radii,
        })
    }

    /// Where sym T of lambda = 0 is definite; with zero reaction the free variables of the
    /// condition are not those that can be eliminated.
    pub(super) fn condensed(&self, necessary: &Necessary) -> Option<DefiniteUntil> {
        match &self.with_zero_free {
            None => condensed(&self.own.stiffness, &necessary.stiffness),
            Some(_) => None,
        }
    }

    /// The family of conditions (19), (20) and of tails.
    pub(super) fn of_condition(&self) -> &MuFamily {
        self.with_zero_free.as_ref().unwrap_or(&self.own)
    }
}

/// The pencils T0 and T1 of a system, T = T0 + mu T1, as they are condensed: those in the middle of
/// all members, the free rows in both.
///
/// # Errors
/// As [`mu_family`].
pub(crate) fn friction_parts(system: &System) -> Result<[Pencil; 2], ModelError> {
    parts_of(&Families::of(system)?.own)
}
