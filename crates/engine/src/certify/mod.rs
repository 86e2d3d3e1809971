//! From a candidate in doubles to a claim that `check` has accepted ([`certify`], [`Certifier`]).
//! May fail; is not trusted.

mod accepted;
mod enclose;
mod exact_claim;
mod failure;
mod lifted;
mod precise;
mod proposals;
mod rows;
mod support;

pub use accepted::{Certifier, Sifted, certify, sift};
pub use failure::{Attempt, AttemptFailure, NotCertified};
pub use lifted::{flattened, lifted};
pub(crate) use precise::precise_null;
pub use proposals::{ENCLOSED_ORDER, EXACT_BITS, EXACT_ORDER, propose};

use mceip_check::certificate::{Certificate, Claim};
use mceip_model::Problem;

/// A certificate for the problem with the given claims.
pub fn certificate(problem: &Problem, claims: Vec<Claim>) -> Certificate {
    Certificate {
        problem_sha256: problem.sha256(),
        unknown: problem.unknown(),
        window: problem.window().clone(),
        claims,
        complete_set: None,
    }
}
