//! The complete search with its proof: search and check apart, one run each, one thread.
//!
//! `cargo bench --bench complete` prints the whole table; `-- NAME...` the cases whose name contains one
//! of the words. "condensed": from the condensed pencil (exact for the published states; made in doubles
//! and taken as exact data for the others). "mesh": from K, the condensation inside the certificate.

use mceip::check::check;
use mceip::model::{Admissible, Body, Problem, Unknown, Window};
use mceip::reduction::{condense, reduce};
use mceip::search::complete::{CompleteError, Completed, Options, complete};
use mceip::source::{Block, MassKind, PublishedState};
use mceip::testkit::{backslash_block, condensed_in_doubles, known, mechanical_pencil, refined_block};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// A run is stopped after this and reported with what is open. `BENCH_LIMIT` (seconds) changes it.
const LIMIT_SECONDS: u64 = 120;

struct Measured {
    search: f64,
    check: f64,
    completed: Completed,
}

/// `complete` includes one check: it is timed again and taken off.
fn measure(problem: &Problem) -> Result<Measured, CompleteError> {
    let limit = std::env::var("BENCH_LIMIT").ok().and_then(|t| t.parse().ok()).unwrap_or(LIMIT_SECONDS);
    let (start, limit, stop) = (Instant::now(), Duration::from_secs(limit), AtomicBool::new(false));
    let options = Options { threads: Some(1), ..Options::default() };
    let hear = |_| stop.fetch_or(start.elapsed() > limit, std::sync::atomic::Ordering::Relaxed);
    let completed = complete(problem, &options, &stop, &|p| {
        hear(p);
    })?;
    let total = start.elapsed().as_secs_f64();
    let start = Instant::now();
    check(problem, &completed.certificate).expect("accepted before");
    let check = start.elapsed().as_secs_f64();
    Ok(Measured { search: total - check, check, completed })
}

fn row(name: &str, problem: &Problem) {
    let m = match measure(problem) {
        Ok(m) => m,
        Err(e) => return println!("{name:<44} {e}"),
    };
    let (cover, size) = (&m.completed.cover, m.completed.certificate.to_json().len().div_ceil(1000));
    println!(
        "{name:<44} {:>8.3} {:>8.3} {:>7} {:>6} {:>5} {size:>8}",
        m.search,
        m.check,
        cover.leaves,
        cover.solutions.len(),
        cover.open.len()
    );
}

/// `count` seeds: the sum of solutions, medians and maxima, how many are closed.
fn random(n: usize, unknown: Unknown, count: u64) {
    let (mut search, mut check, mut leaves, mut closed, mut solutions) = (Vec::new(), Vec::new(), Vec::new(), 0, Vec::new());
    for seed in 1..=count {
        let m = match measure(&mechanical_pencil(n, unknown, seed).expect("n > 0")) {
            Ok(m) => m,
            Err(e) => {
                println!("    n={n} {} seed {seed}: {e}", unknown.word());
                continue;
            }
        };
        search.push(m.search);
        check.push(m.check);
        leaves.push(m.completed.cover.leaves);
        closed += u64::from(m.completed.is_complete());
        solutions.push(m.completed.cover.solutions.len());
    }
    if search.is_empty() {
        return;
    }
    search.sort_by(f64::total_cmp);
    check.sort_by(f64::total_cmp);
    leaves.sort_unstable();
    let (mid, last) = (search.len() / 2, search.len() - 1);
    println!(
        "random mechanical n={n} {}: {closed}/{count} closed; search {:.3} median {:.3} max; check {:.3} median {:.3} max; leaves {} median {} max; solutions {solutions:?}",
        unknown.word(),
        search[mid],
        search[last],
        check[mid],
        check[last],
        leaves[mid],
        leaves[last],
    );
}

fn published() {
    let start = Instant::now();
    let block = Block::of_the_paper(MassKind::Consistent);
    for state in PublishedState::ALL {
        let problem = state.problem(&block).expect("as published");
        let reduced = reduce(&problem).expect("as published");
        let begun = Instant::now();
        let small = condense(&Admissible::new(&reduced.pencil, Unknown::Mu).expect("admissible")).expect("definite");
        println!("    exact condensation {:.2} s", begun.elapsed().as_secs_f64());
        let small = Problem::new(Body::Pencil(small), Unknown::Mu, Window::all()).expect("as published");
        row(&format!("published {}, condensed", state.name()), &small);
        row(&format!("published {}, mesh", state.name()), &problem);
    }
    println!("    both, from nothing, all of it: {:.2} s", start.elapsed().as_secs_f64());
}

fn refined(slip: usize, tenth_stuck: bool, from_mesh: bool) {
    let problem = refined_block(slip, tenth_stuck).expect("within limits");
    let n = reduce(&problem).expect("a model").pencil.slip().len();
    let kind = if tenth_stuck { "tenth stuck" } else { "all slip" };
    if from_mesh {
        row(&format!("refined {kind} n_s={n}, mesh"), &problem);
    }
    let begun = Instant::now();
    let small = condensed_in_doubles(&problem).expect("definite");
    let seconds = begun.elapsed().as_secs_f64();
    row(&format!("refined {kind} n_s={n}, condensed ({seconds:.1} s)"), &small);
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| words.is_empty() || words.iter().any(|w| name.contains(w.as_str()));
    println!("{:<44} {:>8} {:>8} {:>7} {:>6} {:>5} {:>8}", "case", "search s", "check s", "leaves", "found", "open", "kB");
    if wanted("published") {
        published();
    }
    for (slip, tenth_stuck, from_mesh) in [
        (24, false, true),
        (40, false, true),
        (60, false, true),
        (80, false, true),
        (24, true, true),
        (40, true, true),
        (60, true, true),
        (80, true, true),
        (150, false, false),
    ] {
        if wanted(&format!("refined-{slip}{}", if tenth_stuck { "-stuck" } else { "" })) {
            refined(slip, tenth_stuck, from_mesh);
        }
    }
    if wanted("complete-graph") {
        row("complete graph n=12", &known::complete_graph(12).expect("n > 0").problem);
    }
    if wanted("backslash") {
        let problem = backslash_block().expect("as given");
        row("backslash plane strain n_s=17, condensed", &condensed_in_doubles(&problem).expect("definite"));
        row("backslash plane strain n_s=17, mesh", &problem);
    }
    for unknown in [Unknown::Mu, Unknown::Lambda2] {
        for (n, count) in [(20, 20), (30, 10), (40, 10), (50, 3)] {
            if wanted(&format!("random-{n}-{}", unknown.word())) {
                random(n, unknown, count);
            }
        }
    }
}
