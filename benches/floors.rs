//! The rates of which the floors of coverage are made: how many of the solutions that exist the
//! solver finds, family by family. `crates/testkit/src/floors.rs` holds the table, whose rows this
//! prints.
//!
//! `FLOOR_SEEDS=9001,9002 FLOOR_COUNT=200 cargo bench --bench floors -- NAME...` with the names
//! verify, campaign, fuzz, block.
#![allow(clippy::unwrap_used, reason = "a measurement may panic")]

#[path = "../tests/support/solver_targets.rs"]
mod solver_targets;

use mceip_engine::multistart::Search;
use mceip_engine::reduction::condense;
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Unknown};
use mceip_paper::{Block, MassKind, PublishedState};
use mceip_testkit::campaign::{FAMILIES, Id, case, treatment};
use mceip_testkit::floors::{Coverage, Starts};
use mceip_testkit::targets::{Counter, fuzz_treatment};
use mceip_testkit::{
    Instance, Treatment, coverage_of, degenerate, eigenvalue_problems, mechanical, path_coverage,
    random_pencils, table1_grid,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use solver_targets::{SOLVER_TARGETS, random_bytes};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn main() {
    for word in std::env::args().skip(1) {
        match word.as_str() {
            "verify" => measure_the_families_of_verify(),
            "campaign" => measure_the_families_of_the_campaign(),
            "fuzz" => measure_the_fuzz_targets(),
            "block" => measure_the_block(),
            _ => {}
        }
    }
}

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
            (
                "eigenvalue problems",
                eigenvalue_problems(count, seed).unwrap(),
            ),
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
