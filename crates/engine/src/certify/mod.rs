//! From a candidate in doubles to a claim that `check` has accepted ([`certify`], [`Certifier`]).
//!
//! ```text
//! candidate -> supports -> a claim for each: exact, or a box -> check -> the first one accepted
//! ```
//!
//! A candidate is a value t and x in doubles. `support` guesses which components of x are positive,
//! `proposals` goes through the guesses, `exact_claim` and `enclose` make a claim about one
//! support, and `accepted` has the checker decide. `lifted` rewrites an exact claim about the
//! reduced pencil as one about the mechanical system. `rows` is the pencil over the integers,
//! `precise` a null vector with any number of bits for the search, `failure` the reasons why
//! nothing was certified.
//!
//! Nothing here is trusted: a claim counts because the checker has accepted it. What a certificate
//! says is chapter 5 of the book (`spec/certificates.md`).

mod accepted;
mod enclose;
mod exact_claim;
mod failure;
mod lifted;
mod precise;
mod proposals;
pub(crate) mod rows;
mod support;

pub use accepted::{Certifier, certify};
pub use failure::{AttemptFailure, NotCertified, SupportAttempt};
pub use lifted::{flattened, lifted};
pub(crate) use precise::{PreciseNull, precise_null};
pub use proposals::{
    ENCLOSED_ORDER, EXACT_BITS, EXACT_FIRST_ORDER, EXACT_ORDER, Preference, propose,
};

use mceip_check::certificate::Certificate;
use mceip_check::{Proved, Rejected};
use mceip_model::Problem;

/// A certificate for the problem that says what one of the reflected problem says, of values below
/// 0, and nothing else.
pub fn of_negative_values(problem: &Problem, reflected: Certificate) -> Certificate {
    Certificate::of_claims(problem, Vec::new()).with_negative(reflected)
}

/// The certificates for an eigenvalue problem, and those for its reflection, in as few files as
/// they have.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails.
pub fn of_both_signs(
    problem: &Problem,
    non_negative: Vec<Proved<Certificate>>,
    reflected: Vec<Proved<Certificate>>,
) -> Result<Vec<Proved<Certificate>>, Rejected> {
    let mut non_negative = non_negative.into_iter();
    let mut files = Vec::new();
    for reflected in reflected {
        files.push(match non_negative.next() {
            Some(own) => own.with_negative(problem, reflected)?,
            None => {
                let reflected = reflected.into_certificate();
                Proved::new(problem, of_negative_values(problem, reflected))?
            }
        });
    }

    files.extend(non_negative);
    Ok(files)
}
