//! Floors of coverage, held against solvers that miss solutions on purpose.
//!
//! A floor is the least part of the solutions that the solver must find in a family of instances.
//! That it notices a fault is the claim of this file: each planted solver, which forgets solutions,
//! falls below a floor, and the project's own solver does not. `benches/floors.rs` measures them.
#![cfg(feature = "testkit")]

use crate::solver_targets::{SOLVER_TARGETS, random_bytes};
use mceip_engine::multistart::{MultistartFound, Search, SearchError, multistart};
use mceip_engine::run::{Cancel, Watch};
use mceip_model::{Problem, Reduced};
use mceip_paper::PublishedState;
use mceip_testkit::campaign::{Campaign, CampaignLimit, Engine, Pipeline, State, treatment};
use mceip_testkit::floors::{Coverage, Shortfall, Starts, shortfalls};
use mceip_testkit::targets::{Counter, fuzz_treatment};
use mceip_testkit::{
    BLOCK_STARTS, Instance, SearchFunction, Treatment, Verification, degenerate, mechanical,
};
use mceip_testkit::{random_pencils, table1_grid, verify_family};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A solver that finds nothing.
fn finds_nothing(
    _: &Problem,
    _: &Reduced,
    _: &Search,
    _: &Watch<'_>,
) -> Result<MultistartFound, SearchError> {
    Ok(MultistartFound::default())
}

/// A solver that forgets every second solution of an instance, the first one among them.
fn drops_every_second(
    problem: &Problem,
    reduced: &Reduced,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<MultistartFound, SearchError> {
    let found = multistart(problem, reduced, search, watch)?;
    Ok(every_second_from(1, found))
}

/// The same with the second one first: an instance with one solution is not touched.
fn keeps_every_first(
    problem: &Problem,
    reduced: &Reduced,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<MultistartFound, SearchError> {
    let found = multistart(problem, reduced, search, watch)?;
    Ok(every_second_from(0, found))
}

fn every_second_from(first: usize, mut found: MultistartFound) -> MultistartFound {
    found.certified = found.certified.into_iter().skip(first).step_by(2).collect();
    found
}

/// The solvers with a fault.
const PLANTS: [(&str, SearchFunction); 3] = [
    ("finds nothing", finds_nothing),
    ("drops every second", drops_every_second),
    ("keeps every first", keeps_every_first),
];

fn quick_search() -> Search {
    Search {
        starts: 6,
        window_starts: 1,
        ..Search::default()
    }
}

/// Every family of `verify` with each plant has a shortfall, so that `verify` exits 1. That the
/// project's own solver has none is `tests/campaign/verify.rs::no_disagreement`.
#[test]
fn verify_fails_with_a_solver_that_misses_solutions() {
    let stop = Cancel::new();
    let families: [(&'static str, Vec<Instance>); 4] = [
        // Every seventh, so that all four sign patterns occur.
        (
            "Table 1 (two particles)",
            table1_grid().unwrap().into_iter().step_by(7).collect(),
        ),
        ("random pencils", random_pencils(40, 77).unwrap()),
        ("mechanical systems", mechanical(40, 77).unwrap()),
        ("degenerate cases", degenerate().unwrap()),
    ];

    for (name, instances) in &families {
        for (plant, solver) in PLANTS {
            // Most instances of the other families have one solution, which this plant does not
            // touch.
            if plant == "keeps every first" && *name != "Table 1 (two particles)" {
                continue;
            }

            let treatment = Treatment {
                nodes: 1,
                ..Treatment::of(&quick_search())
            };
            let treatment = treatment.with_solver(solver);
            let planted = verify_family(name, instances, &treatment, &Watch::silent(&stop));

            assert!(
                planted.tally.disagreements.is_empty(),
                "{name}: what is found is true: {:?}",
                planted.tally.disagreements
            );

            let verification = Verification {
                seed: 77,
                families: vec![planted],
                block: Vec::new(),
                interrupted: false,
            };
            print_shortfalls(plant, &verification.shortfalls());

            assert!(
                verification.disagreements() > 0,
                "{name}: {plant} goes unnoticed"
            );
        }
    }
}

/// The campaign with each plant: a finding of the family, and none with the project's own solver.
#[test]
fn the_campaign_fails_with_a_solver_that_misses_solutions() {
    let sound = campaign_of_two_families(treatment(3));
    assert_eq!(sound.disagreements(), 0, "{:?}", sound.shortfalls());

    for (plant, solver) in PLANTS {
        let state = campaign_of_two_families(treatment(3).with_solver(solver));

        let shortfalls = state.shortfalls();
        let names: BTreeSet<&str> = shortfalls.iter().map(|s| s.floor.family).collect();
        print_shortfalls(plant, &shortfalls);
        let expected: &[&str] = if plant == "keeps every first" {
            &["table1"]
        } else {
            &["elements", "table1"]
        };

        for family in expected {
            assert!(names.contains(family), "{plant}: {names:?}");
        }

        assert!(state.disagreements() >= expected.len());
    }
}

/// Forty instances of two families by the pipeline, its search held to one node.
fn campaign_of_two_families(treatment: Treatment) -> State {
    let families: Vec<String> = ["elements", "table1"].map(String::from).to_vec();
    let pipeline = Pipeline {
        treatment: Treatment {
            nodes: 1,
            ..treatment
        },
    };
    let engines: [Box<dyn Engine>; 1] = [Box::new(pipeline)];
    let campaign = Campaign {
        engines: &engines,
        limit: CampaignLimit::Count(40),
    };

    let state = State::new(3, (0, 1), families);
    campaign.run(state, &Cancel::new(), &mut |_| {})
}

fn print_shortfalls(plant: &str, shortfalls: &[Shortfall]) {
    let lines: Vec<String> = shortfalls.iter().map(ToString::to_string).collect();
    println!("{plant}: {lines:?}");
}

/// The fuzz targets with a solver panic before they have seen 200 random inputs with a plant, and
/// not without.
#[test]
fn the_fuzz_targets_fail_with_a_solver_that_misses_solutions() {
    for target in SOLVER_TARGETS {
        let family = target.family;
        for (plant, solver) in &PLANTS[..2] {
            let counter = Counter::new(family);
            let mut rng = ChaCha8Rng::seed_from_u64(5);
            let treatment = Treatment {
                nodes: 1,
                ..fuzz_treatment()
            };
            let treatment = treatment.with_solver(*solver);

            let planted = catch_unwind(AssertUnwindSafe(|| {
                for _ in 0..200 {
                    let bytes = random_bytes(&mut rng, target.length);
                    (target.body)(&bytes, &treatment, &counter);
                }
            }));

            let message = *planted.unwrap_err().downcast::<String>().unwrap();
            assert!(
                message.contains("coverage over"),
                "{family}, {plant}: {message}"
            );
        }
    }
}

/// A solver that stops finding the block's solutions is seen: with PATH's own sequence reduced to
/// nothing, below its floor.
#[test]
fn the_block_has_floors_of_its_own() {
    for state in PublishedState::ALL {
        let nothing = Coverage {
            solvable: BLOCK_STARTS as u64,
            first: 0,
            all: 0,
        };
        let found = shortfalls(state.name(), Starts::Path, &nothing);

        assert_eq!(found.len(), 2, "{}", state.name());
    }
}
