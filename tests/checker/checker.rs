//! What is too long for a file of `spec/corpus`, which has an accepted file and a forgery of every
//! obligation: `tests/data/corpus.rs` demands verdict and reason, `verdicts.rs` what is said.

use crate::corpus_reader::entry;
use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{Reason, check};
use mceip_model::file::read_problem;
use std::path::Path;

/// The preconditioner of `accept/enclosed` in units of 2^-exponent: the largest exponent is taken.
#[test]
fn a_preconditioner_may_be_long() {
    let entry = entry("accept/enclosed");
    let problem = read_problem(&entry.problem, Path::new("/")).unwrap();
    let with_exponent = |exponent: u32| {
        let mut certificate = Certificate::from_json(&entry.certificate).unwrap();
        let Claim::EnclosedSolution(claim) = &mut certificate.claims[0] else {
            panic!("an enclosed claim")
        };
        for entry in claim.preconditioner.iter_mut().flatten() {
            *entry <<= exponent - claim.exponent;
        }
        claim.exponent = exponent;
        check(&problem, &certificate)
    };

    assert!(with_exponent(65_536).is_ok());
    let too_large = Reason::TooLarge {
        what: "exponent",
        limit: 65_536,
        got: 65_537,
    };
    assert_eq!(with_exponent(65_537).unwrap_err().reason, too_large);
}
