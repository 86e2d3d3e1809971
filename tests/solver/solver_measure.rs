//! Measures, printed with `cargo test --release --test solver -- --ignored --nocapture
//! solver_measure::`; seeds by MEASURE_SEEDS=101,102. MEASURE_ONLY=first: only first starts; else a
//! part of the name of a search. MEASURE_FAMILY=mu20.
#![cfg(feature = "testkit")]

use crate::families::*;
use mceip_engine::multistart::{Found, Search, multistart, same, support};
use mceip_engine::reduction::{Embedding, Side};
use mceip_mcp::solver::{Options, solve};
use mceip_model::{Admissible, Window};
use mceip_oracle::enumerate;

#[derive(Default)]
struct Tally {
    solvable: usize,
    first: usize,
    first_in_search: usize,
    found: usize,
    truth: usize,
    complete: usize,
    false_claims: usize,
    uncertified: usize,
    pivots: usize,
    factorisations: usize,
    runs: usize,
    first_us: Vec<f64>,
    missed_first: Vec<String>,
    curves: std::collections::BTreeMap<mceip_mcp::solver::CurveEnd, usize>,
    origins: std::collections::BTreeMap<mceip_engine::multistart::Origin, usize>,
}

impl Tally {
    /// Without a search only the first start is made.
    fn add(&mut self, case: &Case, search: Option<&Search>) {
        let truth = enumerate(&case.pencil, &Window::all()).unwrap();
        if truth.solutions.is_empty() {
            return;
        }
        let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
        self.solvable += 1;
        self.truth += truth.solutions.len();
        let embedding = Embedding::new(&admissible, Side::Above(0.0));
        let start = &embedding.starts(1, 0)[0];
        let clock = std::time::Instant::now();
        let outcome = solve(&embedding, start, &Options::default()).unwrap();
        if outcome.termination.reached_tolerance() {
            self.first += 1;
            self.first_us.push(clock.elapsed().as_secs_f64() * 1e6);
        } else {
            self.missed_first
                .push(format!("{} {:?}", case.label, outcome.termination));
        }
        let Some(search) = search else { return };
        let found = multistart(&case.problem(), &admissible, search).unwrap();
        self.count(&found, &truth.solutions);
        for (end, count) in &found.curves {
            *self.curves.entry(*end).or_default() += count;
        }
        let missed = |s: &&mceip_oracle::Solution| {
            !found.certified.iter().any(|c| support(&c.claim) == s.slip)
        };
        if let Some(s) = truth.solutions.iter().find(missed) {
            let got: Vec<f64> = found.certified.iter().map(|c| c.candidate.value).collect();
            println!(
                "   missed {} slip {:?} in {} with {} of {}: {got:?}",
                s.decimal(5),
                s.slip,
                case.label,
                got.len(),
                truth.solutions.len()
            );
        }
    }

    fn count(&mut self, found: &Found, truth: &[mceip_oracle::Solution]) {
        let matches = |s: &mceip_oracle::Solution| {
            let value: f64 = s.decimal(17).parse().unwrap();
            let near = |c: &f64| (c - value).abs() <= 1e-6 * (1.0 + value);
            found
                .certified
                .iter()
                .filter(|c| support(&c.claim) == s.slip && near(&c.candidate.value))
                .count()
        };
        let seen = truth.iter().filter(|s| matches(s) > 0).count();
        self.found += seen;
        self.complete += usize::from(seen == truth.len());
        self.false_claims += found
            .certified
            .len()
            .saturating_sub(truth.iter().map(matches).sum());
        self.uncertified += found.uncertified.len();
        self.first_in_search += usize::from(found.certified.iter().any(|c| c.run == 0));
        self.pivots += found.pivots;
        self.factorisations += found.factorisations;
        self.runs += found.runs;
        found
            .certified
            .iter()
            .for_each(|c| *self.origins.entry(c.origin).or_default() += 1);
        assert!(found.certified.iter().enumerate().all(|(i, a)| {
            found.certified[..i]
                .iter()
                .all(|b| !same(&a.claim, &b.claim))
        }));
    }

    fn print(&mut self, name: &str) {
        self.first_us.sort_by(f64::total_cmp);
        println!(
            "{name}: solvable {}; first start {} ({:.1} %, certified {}); found {}/{} ({:.1} %); \
             all of {}; extra {} uncertified {}; runs {} pivots {} factorisations {}; median {:.0} \
             us; {:?}; {:?}; misses {:?}",
            self.solvable,
            self.first,
            100.0 * self.first as f64 / self.solvable.max(1) as f64,
            self.first_in_search,
            self.found,
            self.truth,
            100.0 * self.found as f64 / self.truth.max(1) as f64,
            self.complete,
            self.false_claims,
            self.uncertified,
            self.runs,
            self.pivots,
            self.factorisations,
            self.first_us
                .get(self.first_us.len() / 2)
                .copied()
                .unwrap_or(f64::NAN),
            self.origins,
            self.curves,
            self.missed_first
        );
    }
}

fn seeds() -> Vec<u64> {
    let text = std::env::var("MEASURE_SEEDS").unwrap_or_else(|_| "101,102".into());
    text.split(',').map(|s| s.trim().parse().unwrap()).collect()
}

/// What MEASURE_ONLY asks for: no search at all, or those whose name contains it.
fn searches() -> Vec<(&'static str, Option<Search>)> {
    let only = std::env::var("MEASURE_ONLY").unwrap_or_default();
    if only == "first" {
        return vec![("first", None)];
    }
    // What 22 runs would cost, in pivots and factorisations.
    let budget = Some(std::env::var("MEASURE_BUDGET").map_or(22, |v| v.parse().unwrap()));
    let options = Options {
        curve_step_limit: 0,
        ..Options::for_search()
    };
    let plain = Search {
        window_starts: 0,
        curves: false,
        options,
        ..Search::default()
    };
    let search = Search {
        starts: 10,
        window_starts: 0,
        budget,
        ..Search::default()
    };
    [("plain 22", Some(plain)), ("search", Some(search))]
        .into_iter()
        .filter(|(name, _)| name.contains(&only))
        .collect()
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn random_pencils() {
    for (name, search) in searches() {
        for (family, n) in [
            ("lambda2", 5),
            ("lambda2", 10),
            ("lambda2", 20),
            ("mu", 5),
            ("mu", 10),
            ("mu", 15),
            ("mu", 20),
        ] {
            if std::env::var("MEASURE_FAMILY").is_ok_and(|f| f != format!("{family}{n}")) {
                continue;
            }
            let mut tally = Tally::default();
            for seed in seeds() {
                for k in 0..40 {
                    tally.add(&random_case(family, n, seed, k), search.as_ref());
                }
            }
            tally.print(&format!("{name} {family} n={n}"));
        }
    }
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn table_one() {
    for (name, search) in searches() {
        for seed in seeds() {
            let mut tally = Tally::default();
            for case in table1_cases() {
                tally.add(
                    &case,
                    search
                        .clone()
                        .map(|search| Search { seed, ..search })
                        .as_ref(),
                );
            }
            tally.print(&format!("{name} table 1 seed {seed}"));
        }
    }
}
