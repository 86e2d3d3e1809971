//! The verification run as a test: a smaller one than `mceip verify`, the same code.
//!
//! The run compares the solver with the oracle, closed forms and proofs. Its report must have no
//! disagreement, and must show that it reached the cases it is there for: a generator that no
//! longer makes one of them fails here.
#![cfg(feature = "testkit")]

use mceip_engine::multistart::Search;
use mceip_engine::run::{Cancel, Watch};
use mceip_paper::PublishedState;
use mceip_testkit::floors::{Starts, floor};
use mceip_testkit::verified::VerifiedChecker;
use mceip_testkit::{
    BLOCK_STARTS, Corner, Instance, Treatment, Verification, degenerate, random_pencils, verify,
    verify_family,
};
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// The run, one for the tests of this file. The verified checker reads its certificates too, where
/// the build has found it.
static VERIFICATION: LazyLock<Verification> = LazyLock::new(|| {
    let checker = cfg!(has_verified_checker).then(|| VerifiedChecker::find(None).unwrap());
    verify(60, 1, checker.as_ref(), &Watch::nobody()).unwrap()
});

#[test]
fn no_disagreement() {
    use Corner::*;

    let verification = &*VERIFICATION;
    for family in &verification.families {
        let name = &family.name;
        let tally = &family.tally;
        let disagreements = &tally.disagreements;
        assert!(disagreements.is_empty(), "{name}: {disagreements:#?}");
        assert_eq!(tally.instances, family.instances as u64);

        println!(
            "{name}: found {} of {}, corners {:?}",
            tally.found, tally.findable, tally.corners
        );
    }

    assert_eq!(verification.disagreements(), 0);

    // Table 1: every solution the oracle lists is found, also from starts that are no solutions.
    let table1 = &verification.families[0].tally;
    assert_eq!(table1.found, table1.findable);
    assert_eq!(table1.solutions, table1.findable);

    for starts in Starts::ALL {
        assert!(table1.coverage.contains_key(starts.word()), "{starts:?}");
    }

    if cfg!(has_verified_checker) {
        let verified = verification.verified();
        assert!(verified.accepted > 500, "{verified:#?}");
        assert_eq!(verified.refused, 0, "{verified:#?}");
        assert!(verified.not_verified.is_empty(), "{verified:#?}");
    }

    // Every rate has a floor to be held against.
    for covered in verification.covered() {
        let floor = floor(&covered.family, covered.starts);
        assert!(floor.is_some(), "{covered:?}");
        assert!(covered.coverage.solvable > 5, "{covered:?}");
    }

    // The generators reach the corners they are there for.
    let mut reached: BTreeSet<Corner> = BTreeSet::new();
    for family in &verification.families {
        reached.extend(family.tally.corners().map(|(corner, _)| corner));
    }

    for corner in [
        Biactive,
        Repeated,
        ZeroValue,
        WideKernel,
        Singular,
        Threshold,
        OneByOne,
        FreeVariables,
        Oblique,
        Stick,
        CoupledMass,
        Quadratic,
    ] {
        assert!(reached.contains(&corner), "{corner:?} not reached");
    }
}

/// Both states of section 5, on the full K.
#[test]
fn published_states_are_found_certified_and_accepted() {
    // The decimals are regression values, three digits fewer than printed by a run of this project
    // on 2026-11-21.
    let expected = [
        (PublishedState::FifteenSlip, "60.805842", 14),
        (PublishedState::SeventeenSlip, "1.7048043", 17),
    ];

    assert_eq!(VERIFICATION.block.len(), expected.len());
    for (report, (state, decimals, slipping)) in VERIFICATION.block.iter().zip(expected) {
        assert_eq!(report.state, state);
        assert_eq!(report.accepted.len(), 1, "{}", state.name());
        assert!(report.uncertified.is_empty(), "{:?}", report.uncertified);

        let claim = &report.accepted[0];
        assert!(claim.value.starts_with(decimals), "{}", claim.value);
        assert_eq!(claim.slipping, slipping);

        assert_eq!(report.rejected_forgeries, report.forgeries);
        assert!(report.forgeries > 0);

        assert!(report.refused.is_empty(), "{:?}", report.refused);
        assert_eq!(report.path.solvable, BLOCK_STARTS as u64);
        assert_eq!(report.unfound, 0);
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mut instances = random_pencils(10, 3).unwrap();
    instances.extend(degenerate().unwrap());

    let report_of_one = report_with_threads(1, &instances);
    let report_of_four = report_with_threads(4, &instances);

    assert_eq!(report_of_one, report_of_four);
}

/// The whole report of a family, as text, computed by so many threads.
fn report_with_threads(threads: usize, instances: &[Instance]) -> String {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    let treatment = Treatment::of(&Search::default());

    pool.install(|| {
        let report = verify_family("few", instances, &treatment, &Watch::nobody());
        format!("{report:?}")
    })
}

#[test]
fn a_stopped_run_keeps_what_was_done_and_says_so() {
    let stop = Cancel::requested();

    let verification = verify(4, 1, None, &Watch::silent(&stop)).unwrap();

    assert!(verification.interrupted);
    assert!(verification.block.is_empty());

    for family in &verification.families {
        assert_eq!(family.tally.instances, 0);
        assert!(family.instances > 0);
    }
}
