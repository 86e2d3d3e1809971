//! From an equilibrium that loads lead to, to a certificate of its contact states that the checker
//! has accepted.
//!
//! The statement makes a pencil ([`EquilibriumPencil`]) with a solution at t = 1 whose support is
//! the load alone. Its free rows (A x)_f = 0 at s = 1 are solved in doubles, and the candidate is
//! certified as any other: a box, or exact numbers on short systems.
//!
//! The pencil is the checker's own. That it is the right one is held by `spec/checker.py`, which
//! forms it anew, and by plain elimination on the uncondensed body (`tests/paper/equilibria.rs`).

use crate::candidate::Candidate;
use crate::certify::{Certifier, NotCertified, Preference};
use mceip_check::certificate::{Claim, EquilibriumCertificate, StatedEquilibrium};
use mceip_check::{EquilibriumPencil, Proved, Reason, Rejected};
use mceip_exact::{Sparse, to_f64};
use mceip_mcp::linear::solve;
use mceip_model::{LoadedBody, ModelError};

/// Largest number of degrees of freedom for which contact states are certified: the certificate
/// holds a dense inverse.
pub const CERTIFIED_DOFS: usize = 1500;

/// Why contact states were not certified. None of these says that they are wrong.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StatesNotCertified {
    /// The body is too large.
    #[error("expected at most {CERTIFIED_DOFS} degrees of freedom, got {dofs}")]
    TooLarge {
        /// Its degrees of freedom.
        dofs: usize,
    },
    /// The statement is none about this body.
    #[error(transparent)]
    Statement(#[from] Reason),
    /// The pencil of the statement is refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The equations have no solution in doubles.
    #[error("the equations of the contact states are singular in doubles")]
    Singular,
    /// No claim was accepted.
    #[error(transparent)]
    NotCertified(#[from] NotCertified),
    /// The certificate is refused.
    #[error(transparent)]
    Rejected(#[from] Rejected),
}

/// Certifies that the body has this equilibrium.
///
/// # Errors
/// [`StatesNotCertified`]: a body that is too large, a statement that no claim proves.
pub fn certify_equilibrium(
    body: &LoadedBody,
    stated: StatedEquilibrium,
) -> Result<Proved<EquilibriumCertificate>, StatesNotCertified> {
    let dofs = body.system().dofs();
    if dofs > CERTIFIED_DOFS {
        return Err(StatesNotCertified::TooLarge { dofs });
    }

    let pencil = EquilibriumPencil::of(body, &stated)?;
    let claim = claim(&pencil)?;
    let certificate = EquilibriumCertificate {
        loads_sha256: body.sha256(),
        stated,
        claim,
    };
    Ok(Proved::new(body, certificate)?)
}

/// A claim about the solution with t = s = 1.
fn claim(equilibrium: &EquilibriumPencil) -> Result<Claim, StatesNotCertified> {
    let problem = &equilibrium.problem;
    let reduced = mceip_model::reduction::reduce(problem)?;
    let a = reduced.pencil.a();
    let load = equilibrium.load;

    let mut x = free_part(a, load).ok_or(StatesNotCertified::Singular)?;
    x.resize(a.rows(), 0.0);
    x[load] = 1.0;
    let candidate = Candidate { value: 1.0, x };

    let certifier = Certifier::new(problem, &reduced.pencil);
    let certifier = certifier.with_preference(Preference::Cheapest);
    Ok(certifier.certify(&candidate)?)
}

/// x_f with A_ff x_f = -A_fs, in doubles; the free variables are those before s.
fn free_part(a: &Sparse, load: usize) -> Option<Vec<f64>> {
    let mut rows = vec![vec![0.0; load]; load];
    let mut right = vec![0.0; load];
    for i in 0..load {
        for (j, value) in a.row(i) {
            if *j < load {
                rows[i][*j] = to_f64(value);
            } else {
                right[i] = -to_f64(value);
            }
        }
    }

    solve(&rows, &[right])?.pop()
}
