//! The verdict on `mceip-stability/1`: the equilibrium is stable for every friction of an interval.
//!
//! The certificate ([`crate::certificate::StabilityCertificate`]) speaks of the mechanical system
//! of a problem with unknown lambda^2, with mu in [`from`, `to`] in place of the friction of the
//! file. This module demands that it belongs to the problem and says something; `cover::stability`
//! checks its evidence. The obligations are those of `spec/certificates.md`, 5.21.

use crate::certificate::StabilityCertificate;
use crate::critical::friction_parts;
use crate::pencil::FrictionParts;
use crate::reason::{Reason, Rejected};
use crate::{Covers, cover, of_problem};
use mceip_exact::{Rational, Sparse};
use mceip_model::{Body, ContactState, Problem, System};
use num_traits::{Signed, Zero};

/// What an accepted certificate has proved: stability for every mu > 0 in [`from`, `to`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedStability {
    /// Smallest friction; 0 itself is not meant.
    pub from: Rational,
    /// Largest friction.
    pub to: Rational,
    /// Does the mass couple no slip or stick particle with anything? Then the theorem is about
    /// every motion that begins in contact, else about those that keep to the contact states.
    pub is_of_every_motion: bool,
}

/// Checks a certificate of stability on an interval of friction, exactly.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails.
pub fn check_stability(
    problem: &Problem,
    certificate: &StabilityCertificate,
) -> Result<AcceptedStability, Rejected> {
    of_problem(problem, &certificate.problem_sha256, Covers::OneBody)?;
    let parts = friction_parts(problem)?;
    parts.plain.without_zero("stability")?;

    let StabilityCertificate { from, to, .. } = certificate;
    if from.is_negative() || from >= to {
        let (from, to) = (from.clone(), to.clone());
        return Err(Reason::FrictionRange { from, to }.into());
    }

    let Body::System(system) = problem.body() else {
        return Err(Reason::NotASystem.into());
    };
    let is_of_every_motion = system
        .mass()
        .is_some_and(|mass| leaves_contacts_alone(system, mass));
    let dofs = system.dofs();
    let massless = FrictionParts::of(system, &Sparse::zeros(dofs, dofs));
    cover::stability::check(&parts, &massless, certificate)?;

    Ok(AcceptedStability {
        from: from.clone(),
        to: to.clone(),
        is_of_every_motion,
    })
}

/// Does the mass couple the degrees of freedom of each slip and stick particle with nothing, the
/// tangential one not even with the normal one?
fn leaves_contacts_alone(system: &System, mass: &Sparse) -> bool {
    let in_contact = system.particles().iter().filter(|particle| {
        matches!(
            particle.state,
            ContactState::Slip { .. } | ContactState::Stick
        )
    });

    for particle in in_contact {
        let own = [particle.tangential, particle.normal];
        let rows = own.iter().flat_map(|dof| mass.row(*dof));
        let mut others = rows.filter(|(j, value)| !own.contains(j) && !value.is_zero());
        if others.next().is_some() {
            return false;
        }

        let mut coupling = Rational::zero(); // t'Mn
        for (i, t) in particle.tangent() {
            for (j, n) in particle.into_obstacle() {
                coupling += &t * n * mass.get(i, j);
            }
        }
        if !coupling.is_zero() {
            return false;
        }
    }

    true
}
