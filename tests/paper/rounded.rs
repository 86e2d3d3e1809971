//! K of the block as a program prints it, with four decimals in N/mm: both values of the paper come
//! out with all their digits, 1.71 and 60.81.
//!
//! For each state a complete set over [0, infinity) is found, written, read back and judged by the
//! checker. With the exact K the first value is 1.7048 (`block`). What is rounded away are zero row
//! sums of K, up to half a unit in each entry: weak springs to the ground.
#![cfg(feature = "testkit")]

use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Sparse, parse, rational, to_f64, whole};
use mceip_paper::PublishedState::{FifteenSlip, SeventeenSlip};
use mceip_paper::{Block, MassKind};

/// Every entry at the nearest multiple of 1e-4.
fn with_four_decimals(exact: &Sparse) -> Sparse {
    let unit = whole(10_000);
    let mut printed = Vec::new();
    for (i, j, value) in exact.entries() {
        printed.push((i, j, (value * &unit).round() / &unit));
    }

    Sparse::from_entries(exact.rows(), exact.cols(), printed)
}

#[test]
fn with_k_in_four_decimals_both_printed_values_come_out() {
    let exact = Block::of_the_paper(MassKind::Lumped);
    let printed = Block {
        stiffness: with_four_decimals(&exact.stiffness),
        ..exact.clone()
    };
    assert_eq!(printed.stiffness.first_asymmetry(), None);

    for (state, decimals, slipping) in
        [(SeventeenSlip, "1.70533", 17), (FifteenSlip, "60.8130", 14)]
    {
        let problem = state.problem(&printed).unwrap();
        let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();

        let read = Certificate::from_json(&found.proved.certificate().to_json()).unwrap();
        let cover = check(&problem, &read).unwrap().cover.unwrap();
        assert!(cover.open.is_empty());
        assert!(cover.families.is_empty());
        let [solution] = &cover.solutions[..] else {
            panic!("{:?}", cover.solutions)
        };
        assert_eq!(solution.support.len(), slipping);

        // Both ends of the enclosure have the same decimals, and round to what is printed.
        let digits = decimals.split('.').nth(1).unwrap().len();
        let half_a_unit = rational(1, 200);
        let paper = parse(state.printed_mu()).unwrap();
        for end in [solution.value.lo(), solution.value.hi()] {
            assert_eq!(format!("{:.digits$}", to_f64(end)), decimals);
            assert!(&paper - &half_a_unit <= *end && *end < &paper + &half_a_unit);
        }

        // The set is that of the rounded K alone.
        let refused = check(&state.problem(&exact).unwrap(), &read).unwrap_err();
        assert_eq!(refused.reason.name(), "Digest");
    }
}
