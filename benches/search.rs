//! How many solutions the search finds of those that the exact enumerator lists, and at what cost.
//!
//! `cargo bench --bench search` prints it for random pencils and for Table 1; `-- pencils` and
//! `-- table1` for one of them. Settings are environment variables: seeds by MEASURE_SEEDS=101,102;
//! MEASURE_ONLY=first for first starts alone, else a part of the name of a search; a family by
//! MEASURE_FAMILY=mu20; the work of a search in runs by MEASURE_BUDGET=22.
#![allow(clippy::unwrap_used, reason = "a measurement may panic")]

#[path = "../tests/families/mod.rs"]
mod families;

use families::{Case, random_case, table1_cases};
use mceip_engine::multistart::{
    CertifiedCandidate, MultistartFound, Origin, Search, multistart, same, support,
};
use mceip_engine::reduction::{Embedding, Side};
use mceip_engine::run::Watch;
use mceip_mcp::solver::{CurveEnd, Options, solve};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Window};
use mceip_oracle::{Solution, enumerate};
use std::collections::BTreeMap;
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let is_named = |name: &str| words.iter().any(|word| word == name);
    let is_whole = !is_named("pencils") && !is_named("table1");

    if is_whole || is_named("pencils") {
        random_pencils();
    }
    if is_whole || is_named("table1") {
        table_one();
    }
}

/// What came of the problems of a family.
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
    curves: BTreeMap<CurveEnd, usize>,
    origins: BTreeMap<Origin, usize>,
}

impl Tally {
    /// Without a search only the first start is made.
    fn add(&mut self, case: &Case, search: Option<&Search>) {
        let truth = enumerate(&case.pencil, &Window::all()).unwrap().solutions;
        if truth.is_empty() {
            return;
        }
        let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
        self.solvable += 1;
        self.truth += truth.len();
        self.add_first_start(case, &admissible);

        let Some(search) = search else {
            return;
        };
        let problem = case.problem();
        let reduced = reduce(&problem).unwrap();
        let found = multistart(&problem, &reduced, search, &Watch::nobody()).unwrap();
        self.add_search(&found, &truth);
        print_first_missed(case, &found, &truth);
    }

    fn add_first_start(&mut self, case: &Case, admissible: &Admissible<'_>) {
        let embedding = Embedding::new(admissible, Side::Above(0.0));
        let start = &embedding.starts(1, 0)[0];

        let clock = Instant::now();
        let outcome = solve(&embedding, start, &Options::default()).unwrap();
        if outcome.termination.reached_tolerance() {
            self.first += 1;
            self.first_us.push(clock.elapsed().as_secs_f64() * 1e6);
        } else {
            let missed = format!("{} {:?}", case.label, outcome.termination);
            self.missed_first.push(missed);
        }
    }

    fn add_search(&mut self, found: &MultistartFound, truth: &[Solution]) {
        let mut seen = 0;
        let mut matching_claims = 0;
        for solution in truth {
            let claims = count_of_claims(found, solution);
            seen += usize::from(claims > 0);
            matching_claims += claims;
        }

        self.found += seen;
        self.complete += usize::from(seen == truth.len());
        self.false_claims += found.certified.len().saturating_sub(matching_claims);
        self.uncertified += found.uncertified.len();
        self.first_in_search += usize::from(found.certified.iter().any(|c| c.run == 0));
        self.pivots += found.pivots;
        self.factorisations += found.factorisations;
        self.runs += found.runs;
        for certified in &found.certified {
            *self.origins.entry(certified.origin).or_default() += 1;
        }
        for (end, count) in &found.curves {
            *self.curves.entry(*end).or_default() += count;
        }
        assert_no_claim_is_made_twice(&found.certified);
    }

    fn median_us(&mut self) -> f64 {
        self.first_us.sort_by(f64::total_cmp);
        let median = self.first_us.get(self.first_us.len() / 2);
        median.copied().unwrap_or(f64::NAN)
    }

    fn print(&mut self, name: &str) {
        let median_us = self.median_us();
        println!(
            "{name}: solvable {}; first start {} ({:.1} %, certified {}); found {}/{} ({:.1} %); \
             all of {}; extra {} uncertified {}; runs {} pivots {} factorisations {}; median {:.0} \
             us; {:?}; {:?}; misses {:?}",
            self.solvable,
            self.first,
            percent(self.first, self.solvable),
            self.first_in_search,
            self.found,
            self.truth,
            percent(self.found, self.truth),
            self.complete,
            self.false_claims,
            self.uncertified,
            self.runs,
            self.pivots,
            self.factorisations,
            median_us,
            self.origins,
            self.curves,
            self.missed_first
        );
    }
}

fn percent(count: usize, total: usize) -> f64 {
    100.0 * count as f64 / total.max(1) as f64
}

/// The claims with the support of a solution and a value close to its value.
fn count_of_claims(found: &MultistartFound, solution: &Solution) -> usize {
    let value: f64 = solution.decimal(17).parse().unwrap();
    let tolerance = 1e-6 * (1.0 + value);

    let mut count = 0;
    for certified in &found.certified {
        let same_support = support(&certified.claim) == solution.slip;
        let is_near = (certified.candidate.value - value).abs() <= tolerance;
        count += usize::from(same_support && is_near);
    }
    count
}

fn assert_no_claim_is_made_twice(certified: &[CertifiedCandidate]) {
    for (i, later) in certified.iter().enumerate() {
        for earlier in &certified[..i] {
            assert!(!same(&later.claim, &earlier.claim));
        }
    }
}

/// Is anything certified of the support of the solution?
fn has_claim(found: &MultistartFound, solution: &Solution) -> bool {
    let mut certified = found.certified.iter();
    certified.any(|c| support(&c.claim) == solution.slip)
}

/// Prints the first solution of whose support nothing is certified, if there is one.
fn print_first_missed(case: &Case, found: &MultistartFound, truth: &[Solution]) {
    let Some(missed) = truth.iter().find(|s| !has_claim(found, s)) else {
        return;
    };

    let certified = found.certified.iter();
    let values: Vec<f64> = certified.map(|c| c.candidate.value).collect();
    println!(
        "   missed {} slip {:?} in {} with {} of {}: {values:?}",
        missed.decimal(5),
        missed.slip,
        case.label,
        values.len(),
        truth.len()
    );
}

fn seeds() -> Vec<u64> {
    let text = std::env::var("MEASURE_SEEDS").unwrap_or_else(|_| "101,102".into());
    text.split(',').map(|s| s.trim().parse().unwrap()).collect()
}

/// A search with its name; `None` for first starts alone.
struct NamedSearch {
    name: &'static str,
    search: Option<Search>,
}

/// What MEASURE_ONLY asks for: no search at all, or those whose name contains it.
fn searches() -> Vec<NamedSearch> {
    let only = std::env::var("MEASURE_ONLY").unwrap_or_default();
    if only == "first" {
        return vec![NamedSearch {
            name: "first",
            search: None,
        }];
    }

    let mut searches = vec![
        NamedSearch {
            name: "plain 22",
            search: Some(plain_search()),
        },
        NamedSearch {
            name: "search",
            search: Some(search_within_budget()),
        },
    ];
    searches.retain(|named| named.name.contains(&only));
    searches
}

/// Runs from fresh starts, without curves.
fn plain_search() -> Search {
    let options = Options {
        curve_step_limit: 0,
        ..Options::for_search()
    };
    Search {
        window_starts: 0,
        curves: false,
        options,
        ..Search::default()
    }
}

/// Runs and curves, of what 22 runs would cost, in pivots and factorisations.
fn search_within_budget() -> Search {
    let budget = std::env::var("MEASURE_BUDGET").map_or(22, |text| text.parse().unwrap());
    Search {
        starts: 10,
        window_starts: 0,
        budget: Some(budget),
        ..Search::default()
    }
}

/// Does MEASURE_FAMILY leave this family out?
fn is_left_out(family: &str, n: usize) -> bool {
    match std::env::var("MEASURE_FAMILY") {
        Ok(wanted) => wanted != format!("{family}{n}"),
        Err(_) => false,
    }
}

fn random_pencils() {
    let families = [
        ("lambda2", 5),
        ("lambda2", 10),
        ("lambda2", 20),
        ("mu", 5),
        ("mu", 10),
        ("mu", 15),
        ("mu", 20),
    ];

    for NamedSearch { name, search } in searches() {
        for (family, n) in families {
            if is_left_out(family, n) {
                continue;
            }
            let mut tally = Tally::default();
            for seed in seeds() {
                for k in 0..40 {
                    let case = random_case(family, n, seed, k);
                    tally.add(&case, search.as_ref());
                }
            }
            tally.print(&format!("{name} {family} n={n}"));
        }
    }
}

fn table_one() {
    for NamedSearch { name, search } in searches() {
        for seed in seeds() {
            let mut search = search.clone();
            if let Some(search) = &mut search {
                search.seed = seed;
            }

            let mut tally = Tally::default();
            for case in table1_cases() {
                tally.add(&case, search.as_ref());
            }
            tally.print(&format!("{name} table 1 seed {seed}"));
        }
    }
}
