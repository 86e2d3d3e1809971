//! Floors of coverage: measured here on request; held against solvers that miss solutions on purpose.
//!
//! `FLOOR_SEEDS=9001,9002 FLOOR_COUNT=1000 cargo test --release --test floors -- --ignored --nocapture`
#![cfg(feature = "testkit")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::multistart::Search;
use mceip::testkit::campaign::{FAMILIES, Id, case, treatment};
use mceip::testkit::floors::{Coverage, Starts};
use mceip::testkit::{Instance, Treatment, coverage_of, degenerate, mechanical, random_pencils, table1_grid};
use rayon::prelude::*;
use std::collections::BTreeMap;

type ByStarts = BTreeMap<Starts, Coverage>;

fn measured(instances: &[Instance], treatment: &Treatment) -> ByStarts {
    let reports: Vec<_> = instances.par_iter().map(|i| coverage_of(i, treatment).unwrap().coverage()).collect();
    let mut sum = ByStarts::new();
    for (starts, coverage) in reports.into_iter().flatten() {
        sum.entry(starts).or_default().add(&coverage);
    }
    sum
}

/// A row of the table in `src/testkit/floors.rs`.
fn print(family: &str, sum: &ByStarts) {
    for (starts, c) in sum {
        let percent = |count: u64| 100.0 * count as f64 / c.solvable.max(1) as f64;
        let (first, all) = (percent(c.first), percent(c.all));
        println!("    row({family:?}, Starts::{starts:?}, {:.1}, {:.1}), // {first:.2}, {all:.2} of {}", (first - 2.0).max(0.0), (all - 2.0).max(0.0), c.solvable);
    }
}

fn numbers(name: &str, default: &str) -> Vec<u64> {
    let text = std::env::var(name).unwrap_or_else(|_| default.into());
    text.split(',').map(|s| s.trim().parse().unwrap()).collect()
}

fn add(sum: &mut ByStarts, more: ByStarts) {
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
            let instance = |index: u64| case(&Id { family: family.into(), seed, index }).unwrap().unwrap().instance;
            let instances: Vec<Instance> = (0..count).map(instance).collect();
            add(&mut sum, measured(&instances, &treatment(seed)));
        }
        print(family, &sum);
    }
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_families_of_verify() {
    let count = numbers("FLOOR_COUNT", "500")[0] as usize;
    let mut sums: BTreeMap<&str, ByStarts> = BTreeMap::new();
    for seed in numbers("FLOOR_SEEDS", "9001,9002") {
        let treatment = Treatment::of(&Search { seed, ..Search::default() });
        let families = [
            ("Table 1 (two particles)", table1_grid().unwrap()),
            ("random pencils", random_pencils(count, seed).unwrap()),
            ("mechanical systems", mechanical(count, seed).unwrap()),
            ("degenerate cases", degenerate().unwrap()),
        ];
        for (name, instances) in families {
            add(sums.entry(name).or_default(), measured(&instances, &treatment));
        }
    }
    for (name, sum) in sums {
        print(name, &sum);
    }
}
