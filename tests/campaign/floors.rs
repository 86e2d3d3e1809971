//! Floors of coverage: measured here on request; held against solvers that miss solutions on
//! purpose.
//!
//! A floor is the least part of the solutions that the solver must find in a family of instances.
//! That it notices a fault is the claim of this file: each planted solver, which forgets solutions,
//! falls below a floor, and the project's own solver does not.
//!
//! `FLOOR_SEEDS=9001,9002 FLOOR_COUNT=200 cargo test --release --test campaign -- --ignored
//! --nocapture floors::`
#![cfg(feature = "testkit")]

use mceip_engine::multistart::{Found, Search, SearchError, multistart};
use mceip_engine::reduction::condense;
use mceip_engine::run::{Cancel, Watch};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Problem, Reduced, Unknown};
use mceip_paper::{Block, MassKind, PublishedState};
use mceip_testkit::campaign::{
    Campaign, Engine, FAMILIES, Id, Limit, Pipeline, State, case, treatment,
};
use mceip_testkit::floors::{Coverage, Shortfall, Starts, shortfalls};
use mceip_testkit::targets::{self, Counter, fuzz_treatment};
use mceip_testkit::{
    BLOCK_STARTS, Instance, Solver, Treatment, Verification, coverage_of, degenerate, mechanical,
};
use mceip_testkit::{path_coverage, random_pencils, table1_grid, verify_family};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

type ByStarts = BTreeMap<Starts, Coverage>;

fn measured(instances: &[Instance], treatment: &Treatment) -> ByStarts {
    let reports: Vec<Vec<(Starts, Coverage)>> = instances
        .par_iter()
        .map(|instance| coverage_of(instance, treatment).unwrap().coverage())
        .collect();

    let mut sum = ByStarts::new();
    for report in reports {
        add(&mut sum, report);
    }
    sum
}

/// A row of the table in `crates/testkit/src/floors.rs`.
fn print(family: &str, sum: &ByStarts) {
    for (starts, coverage) in sum {
        let solvable = coverage.solvable;
        let first = percent(coverage.first, solvable);
        let all = percent(coverage.all, solvable);

        // A floor lies two points below what was measured.
        let least_first = (first - 2.0).max(0.0);
        let least_all = (all - 2.0).max(0.0);
        println!(
            "    row({family:?}, Starts::{starts:?}, {least_first:.1}, {least_all:.1}), // \
             {first:.2}, {all:.2} of {solvable}"
        );
    }
}

fn percent(count: u64, of: u64) -> f64 {
    100.0 * count as f64 / of.max(1) as f64
}

/// The numbers of an environment variable, parted by commas.
fn numbers(name: &str, default: &str) -> Vec<u64> {
    let text = std::env::var(name).unwrap_or_else(|_| default.into());
    text.split(',')
        .map(|number| number.trim().parse().unwrap())
        .collect()
}

fn add(sum: &mut ByStarts, more: impl IntoIterator<Item = (Starts, Coverage)>) {
    for (starts, coverage) in more {
        sum.entry(starts).or_default().add(&coverage);
    }
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_families_of_the_campaign() {
    let count = numbers("FLOOR_COUNT", "500")[0];
    for (family, _, _) in FAMILIES {
        let mut sum = ByStarts::new();
        for seed in numbers("FLOOR_SEEDS", "9001,9002") {
            let instances: Vec<Instance> = (0..count)
                .map(|index| drawn_instance(family, seed, index))
                .collect();
            add(&mut sum, measured(&instances, &treatment(seed)));
        }
        print(family, &sum);
    }
}

/// An instance of a family of the campaign.
fn drawn_instance(family: &str, seed: u64, index: u64) -> Instance {
    let id = Id {
        family: family.into(),
        seed,
        index,
    };

    case(&id).unwrap().unwrap().instance
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_families_of_verify() {
    let count = numbers("FLOOR_COUNT", "500")[0] as usize;
    let mut sums: BTreeMap<&str, ByStarts> = BTreeMap::new();

    for seed in numbers("FLOOR_SEEDS", "9001,9002") {
        let treatment = Treatment::of(&Search {
            seed,
            ..Search::default()
        });
        let families = [
            ("Table 1 (two particles)", table1_grid().unwrap()),
            ("random pencils", random_pencils(count, seed).unwrap()),
            ("mechanical systems", mechanical(count, seed).unwrap()),
            ("degenerate cases", degenerate().unwrap()),
        ];

        for (name, instances) in families {
            let sum = sums.entry(name).or_default();
            add(sum, measured(&instances, &treatment));
        }
    }

    for (name, sum) in sums {
        print(name, &sum);
    }
}

/// Random bytes as inputs of the fuzz targets with a solver, and committed inputs with a few bytes
/// changed.
#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_fuzz_targets() {
    let count = numbers("FLOOR_COUNT", "500")[0];
    for target in SOLVER_TARGETS {
        let family = target.family;
        let corpus = corpus(family.trim_start_matches("fuzz: "));
        let random = Counter::new("measured");
        let changed = Counter::new("measured");

        for seed in numbers("FLOOR_SEEDS", "9001,9002") {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            for k in 0..count as usize {
                let bytes = random_bytes(&mut rng, target.length);
                (target.body)(&bytes, &fuzz_treatment(), &random);

                let near_corpus = with_changes(&mut rng, &corpus[k % corpus.len()]);
                (target.body)(&near_corpus, &fuzz_treatment(), &changed);
            }
        }

        print(&format!("{family}, random"), &random.seen().coverage);
        print(&format!("{family}, changed"), &changed.seen().coverage);
    }
}

/// A fuzz target with a solver.
struct SolverTarget {
    /// The family whose floor it is held against.
    family: &'static str,
    /// The length of a random input.
    length: usize,
    /// The body, with a solver of one's own.
    body: fn(&[u8], &Treatment, &Counter),
}

const SOLVER_TARGETS: [SolverTarget; 3] = [
    SolverTarget {
        family: "fuzz: solver_against_oracle",
        length: 34,
        body: targets::solver_against_oracle_by,
    },
    SolverTarget {
        family: "fuzz: mechanical_systems",
        length: 150,
        body: targets::mechanical_systems_by,
    },
    SolverTarget {
        family: "fuzz: two_particle_problems",
        length: 10,
        body: targets::two_particle_problems_by,
    },
];

fn random_bytes(rng: &mut ChaCha8Rng, length: usize) -> Vec<u8> {
    (0..length).map(|_| rng.random_range(0..=255)).collect()
}

/// The committed inputs of a fuzz target.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("fuzz/corpus")
        .join(target);
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();

    files
        .iter()
        .map(|file| std::fs::read(file).unwrap())
        .collect()
}

/// One to four bytes replaced by random ones.
fn with_changes(rng: &mut ChaCha8Rng, bytes: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for _ in 0..rng.random_range(1..=4) {
        if !out.is_empty() {
            let at = rng.random_range(0..out.len());
            out[at] = rng.random_range(0..=255);
        }
    }
    out
}

/// PATH's own sequence on both published states of the block, each start an instance.
#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_block() {
    let block = Block::of_the_paper(MassKind::Consistent);
    for (state, value) in [
        (PublishedState::FifteenSlip, 60.805842443327),
        (PublishedState::SeventeenSlip, 1.704804329580),
    ] {
        let pencil = reduce(&state.problem(&block).unwrap()).unwrap().pencil;
        let condensed = condense(&Admissible::new(&pencil, Unknown::Mu).unwrap()).unwrap();
        let small = Admissible::new(&condensed, Unknown::Mu).unwrap();
        let mut sum = ByStarts::new();
        for seed in numbers("FLOOR_SEEDS", "9001,9002") {
            let coverage = path_coverage(&small, &[value], 1000, seed).unwrap();
            sum.entry(Starts::Path).or_default().add(&coverage);
        }
        print(state.name(), &sum);
    }
}

/// A solver that finds nothing.
fn finds_nothing(
    _: &Problem,
    _: &Reduced,
    _: &Search,
    _: &Watch<'_>,
) -> Result<Found, SearchError> {
    Ok(Found::default())
}

/// A solver that forgets every second solution of an instance, the first one among them.
fn drops_every_second(
    problem: &Problem,
    reduced: &Reduced,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<Found, SearchError> {
    let mut found = multistart(problem, reduced, search, watch)?;
    let mut index = 0;
    found.certified.retain(|_| {
        index += 1;
        index % 2 == 0
    });

    Ok(found)
}

/// A solver that forgets every second solution, the second one first: an instance with one solution
/// is not touched.
fn keeps_every_first(
    problem: &Problem,
    reduced: &Reduced,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<Found, SearchError> {
    let mut found = multistart(problem, reduced, search, watch)?;
    let mut index = 0;
    found.certified.retain(|_| {
        index += 1;
        index % 2 == 1
    });

    Ok(found)
}

/// The solvers with a fault.
const PLANTS: [(&str, Solver); 3] = [
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
                planted.disagreements.is_empty(),
                "{name}: what is found is true: {:?}",
                planted.disagreements
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
        limit: Limit::Count(40),
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
