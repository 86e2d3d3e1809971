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
use crate::{cover, of_problem};
use mceip_exact::{Rational, Sparse};
use mceip_model::{Body, Problem};
use num_traits::Signed;

/// What an accepted certificate has proved: stability for every mu > 0 in [`from`, `to`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedStability {
    /// Smallest friction; 0 itself is not meant.
    pub from: Rational,
    /// Largest friction.
    pub to: Rational,
}

/// Checks a certificate of stability on an interval of friction, exactly.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails.
pub fn check_stability(
    problem: &Problem,
    certificate: &StabilityCertificate,
) -> Result<AcceptedStability, Rejected> {
    of_problem(problem, &certificate.problem_sha256)?;
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
    let dofs = system.dofs();
    let massless = FrictionParts::of(system, &Sparse::zeros(dofs, dofs));
    cover::stability::check(&parts, &massless, certificate)?;

    Ok(AcceptedStability {
        from: from.clone(),
        to: to.clone(),
    })
}
