//! The verification run as a test: a smaller one than `mceip verify`, the same code.
#![cfg(feature = "testkit")]

use mceip::multistart::Search;
use mceip::run::{Cancel, Watch};
use mceip::testkit::floors::{Starts, floor};
use mceip::testkit::{
    BLOCK_STARTS, Corner, Treatment, degenerate, random_pencils, verify, verify_family,
};
use std::collections::BTreeSet;

#[test]
fn no_disagreement() {
    let v = verify(60, 1, &Watch::nobody()).unwrap();
    for f in &v.families {
        assert!(
            f.disagreements.is_empty(),
            "{}: {:#?}",
            f.name,
            f.disagreements
        );
        assert_eq!(f.done, f.instances);
        println!(
            "{}: found {} of {}, corners {:?}",
            f.name, f.found, f.findable, f.corners
        );
    }
    assert_eq!(v.disagreements(), 0);
    // Table 1: every solution the oracle lists is found.
    assert_eq!(
        (v.families[0].found, v.families[0].oracle),
        (v.families[0].findable, v.families[0].findable)
    );
    // Table 1 is counted from starts that are no solutions, too; and every rate has a floor to be
    // held against.
    assert_eq!(
        v.families[0].coverage.keys().copied().collect::<Vec<_>>(),
        Starts::ALL
    );
    assert!(
        v.block
            .iter()
            .all(|b| b.path.solvable == BLOCK_STARTS as u64 && b.unfound == 0)
    );
    for c in v.covered() {
        assert!(
            floor(&c.family, c.starts).is_some() && c.coverage.solvable > 5,
            "{c:?}"
        );
    }
    // The generators reach the corners they are there for.
    let reached: BTreeSet<Corner> = v
        .families
        .iter()
        .flat_map(|f| f.corners.keys().copied())
        .collect();
    use Corner::*;
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
    ] {
        assert!(reached.contains(&corner), "{corner:?} not reached");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let instances: Vec<_> = random_pencils(10, 3)
        .unwrap()
        .into_iter()
        .chain(degenerate().unwrap())
        .collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            format!(
                "{:?}",
                verify_family(
                    "few",
                    &instances,
                    &Treatment::of(&Search::default()),
                    &Watch::nobody()
                )
            )
        })
    };
    assert_eq!(run(1), run(4));
}

#[test]
fn a_stopped_run_keeps_what_was_done_and_says_so() {
    let v = verify(4, 1, &Watch::silent(&Cancel::requested())).unwrap();
    assert!(
        v.interrupted
            && v.block.is_empty()
            && v.families.iter().all(|f| f.done == 0 && f.instances > 0)
    );
}
