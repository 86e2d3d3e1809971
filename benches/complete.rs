//! The complete search with its proof: search and check apart, one run each, one thread.
//!
//! `cargo bench --bench complete` prints the whole table; `-- NAME...` the cases whose name
//! contains one of the words. "condensed": from the condensed pencil (exact for the published
//! states; made in doubles and taken as exact data for the others). "mesh": from K, the
//! condensation inside the certificate. Seconds are CPU seconds of the process (user and system),
//! so other work on the machine counts little.
//!
//! `-- random-30-mu` and its like: K0 and M = GG'/n + I/2, K1 = G'/sqrt n with G, G' standard
//! normal, MCEIP-mu of (K0, K1) or MCEIP-lambda2 of (K0 + 3 K1, M) over [0, infinity), no free
//! variables; the seeds from 1 on.
//!
//! `-- cost` measures the refined meshes alone, the whole run and a check of its result, and writes
//! `spec/figures/complete-cost.csv` and `.svg`; `-- cost 10 20` these orders only, and writes
//! nothing; `-- draw` draws the figure of the table there is.

#[path = "../tests/support/cost.rs"]
mod cost;

use mceip_check::check;
use mceip_engine::reduction::{condense, reduce};
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_engine::search::complete::{CompleteError, Completed, Options, complete};
use mceip_model::{Admissible, Body, Problem, Unknown, Window};
use mceip_paper::{Block, MassKind, PublishedState};
use mceip_testkit::{
    backslash_block, condensed_in_doubles, known, mechanical_pencil, refined_block,
};
use rustix::time::{ClockId, clock_gettime};

/// A run is stopped after this and reported with what is open. `BENCH_LIMIT` (seconds) changes it.
const LIMIT_SECONDS: u64 = 120;

/// CPU seconds of this process.
fn cpu() -> f64 {
    let t = clock_gettime(ClockId::ProcessCPUTime);
    t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
}

struct Measured {
    search: f64,
    check: f64,
    completed: Completed,
}

/// `complete` includes one check: it is timed again and taken off.
fn measure(problem: &Problem) -> Result<Measured, CompleteError> {
    let limit = std::env::var("BENCH_LIMIT")
        .ok()
        .and_then(|t| t.parse().ok())
        .unwrap_or(LIMIT_SECONDS);
    let start = cpu();
    let cancel = Cancel::new();
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let end_when_late = |_: &Progress<'_>| {
        if cpu() - start > limit as f64 {
            cancel.request();
        }
    };
    let completed = complete(problem, &options, &Watch::new(&cancel, &end_when_late))?;
    let total = cpu() - start;
    let start = cpu();
    check(problem, &completed.certificate).expect("accepted before");
    let check = cpu() - start;
    Ok(Measured {
        search: total - check,
        check,
        completed,
    })
}

fn row(name: &str, problem: &Problem) {
    let m = match measure(problem) {
        Ok(m) => m,
        Err(e) => return println!("{name:<44} {e}"),
    };
    let (cover, size) = (
        &m.completed.cover,
        m.completed.certificate.to_json().len().div_ceil(1000),
    );
    println!(
        "{name:<44} {:>8.3} {:>8.3} {:>7} {:>6} {:>5} {size:>8}",
        m.search,
        m.check,
        cover.leaves,
        cover.solutions.len(),
        cover.open.len()
    );
    for o in cover.open.iter().take(MOST_OPEN_SHOWN) {
        let max = o.max.as_ref().map_or(f64::INFINITY, mceip_exact::to_f64);
        println!(
            "    open: [{:.17e}, {max:.17e}] moving {:?} undecided {:?}",
            mceip_exact::to_f64(&o.min),
            o.moving,
            o.undecided
        );
    }
}

/// Open regions printed.
const MOST_OPEN_SHOWN: usize = 200;

/// `count` seeds: the sum of solutions, medians and maxima, how many are closed.
fn random(n: usize, unknown: Unknown, count: u64) {
    let (mut search, mut check, mut both) = (Vec::new(), Vec::new(), Vec::new());
    let (mut leaves, mut closed, mut solutions) = (Vec::new(), 0, Vec::new());
    for seed in 1..=count {
        let m = match measure(&mechanical_pencil(n, unknown, seed).expect("n > 0")) {
            Ok(m) => m,
            Err(e) => {
                println!("    n={n} {} seed {seed}: {e}", unknown.word());
                continue;
            }
        };
        println!(
            "    n={n} {} seed {seed}: {:.3} {:.3} {}",
            unknown.word(),
            m.search,
            m.check,
            m.completed.cover.leaves
        );
        both.push(m.search + m.check);
        search.push(m.search);
        check.push(m.check);
        leaves.push(m.completed.cover.leaves);
        closed += u64::from(m.completed.is_complete());
        solutions.push(m.completed.cover.solutions.len());
    }
    if search.is_empty() {
        return;
    }
    both.sort_by(f64::total_cmp);
    search.sort_by(f64::total_cmp);
    check.sort_by(f64::total_cmp);
    leaves.sort_unstable();
    let (mid, last) = (search.len() / 2, search.len() - 1);
    println!(
        "random mechanical n={n} {}: {closed}/{count} closed; search + check {:.3} median {:.3} \
         ninth of ten {:.3} max; search {:.3} median {:.3} max; check {:.3} median {:.3} max; \
         leaves {} median {} max; solutions {solutions:?}",
        unknown.word(),
        both[mid],
        both[(9 * both.len()).div_ceil(10) - 1],
        both[last],
        search[mid],
        search[last],
        check[mid],
        check[last],
        leaves[mid],
        leaves[last],
    );
}

fn published() {
    let start = cpu();
    let block = Block::of_the_paper(MassKind::Consistent);
    for state in PublishedState::ALL {
        let problem = state.problem(&block).expect("as published");
        let reduced = reduce(&problem).expect("as published");
        let begun = cpu();
        let small = condense(&Admissible::new(&reduced.pencil, Unknown::Mu).expect("admissible"))
            .expect("definite");
        println!("    exact condensation {:.2} s", cpu() - begun);
        let small =
            Problem::new(Body::Pencil(small), Unknown::Mu, Window::all()).expect("as published");
        row(&format!("published {}, condensed", state.name()), &small);
        row(&format!("published {}, mesh", state.name()), &problem);
    }
    println!("    both, from nothing, all of it: {:.2} s", cpu() - start);
}

/// Orders of the meshes of `-- cost`.
const COST: [usize; 10] = [10, 15, 20, 30, 40, 50, 60, 70, 80, 150];

/// Measures the refined meshes; without a list of orders of one's own, table and picture are
/// written.
fn costs(orders: &[usize]) {
    let mut runs = Vec::new();
    for (case, tenth_stuck) in [("all slip", false), ("a tenth stuck", true)] {
        for &order in if orders.is_empty() { &COST[..] } else { orders } {
            let problem = refined_block(order, tenth_stuck).expect("within limits");
            let pencil = reduce(&problem).expect("a model").pencil;
            let m = match measure(&problem) {
                Ok(m) => m,
                Err(e) => {
                    println!("# {case} {order}: {e}");
                    continue;
                }
            };
            let cover = &m.completed.cover;
            let run = cost::Run {
                case: case.into(),
                slip: pencil.slip().len(),
                free: pencil.free().len(),
                complete: m.search + m.check,
                check: m.check,
                leaves: cover.leaves,
                solutions: cover.solutions.len(),
                open: cover.open.len(),
                kilobytes: m.completed.certificate.to_json().len().div_ceil(1000),
            };
            println!("{}", run.line());
            runs.push(run);
        }
    }
    if orders.is_empty() {
        let lines: String = runs.iter().map(|r| r.line() + "\n").collect();
        std::fs::write(cost::CSV, format!("{}\n{lines}", cost::HEAD))
            .expect("spec/figures is there");
        draw();
    }
}

/// The figure of the table as it stands in its file.
fn draw() {
    let runs = std::fs::read_to_string(cost::CSV)
        .ok()
        .and_then(|csv| cost::read(&csv))
        .expect("a table in spec/figures");
    std::fs::write(cost::SVG, cost::picture(&runs).to_svg()).expect("spec/figures is there");
}

/// Larger refined meshes are measured from K only: their condensation in doubles as exact data
/// takes minutes.
const CONDENSED_UP_TO: usize = 80;

fn refined(slip: usize, tenth_stuck: bool, from_mesh: bool) {
    let problem = refined_block(slip, tenth_stuck).expect("within limits");
    let n = reduce(&problem).expect("a model").pencil.slip().len();
    let kind = if tenth_stuck {
        "tenth stuck"
    } else {
        "all slip"
    };
    if from_mesh {
        row(&format!("refined {kind} n_s={n}, mesh"), &problem);
    }
    if slip > CONDENSED_UP_TO {
        return;
    }
    let begun = cpu();
    let small = condensed_in_doubles(&problem).expect("definite");
    let seconds = cpu() - begun;
    row(
        &format!("refined {kind} n_s={n}, condensed ({seconds:.1} s)"),
        &small,
    );
}

fn main() {
    let words: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    if words.first().is_some_and(|w| w == "draw") {
        return draw();
    }
    if words.first().is_some_and(|w| w == "cost") {
        return costs(
            &words[1..]
                .iter()
                .filter_map(|w| w.parse().ok())
                .collect::<Vec<_>>(),
        );
    }
    let wanted = |name: &str| words.is_empty() || words.iter().any(|w| name.contains(w.as_str()));
    println!(
        "{:<44} {:>8} {:>8} {:>7} {:>6} {:>5} {:>8}",
        "case", "search s", "check s", "leaves", "found", "open", "kB"
    );
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
        (150, false, true),
        (150, true, true),
    ] {
        if wanted(&format!(
            "refined-{slip}-{}",
            if tenth_stuck { "stuck" } else { "slip" }
        )) {
            refined(slip, tenth_stuck, from_mesh);
        }
    }
    if wanted("complete-graph") {
        row(
            "complete graph n=12",
            &known::complete_graph(12).expect("n > 0").problem,
        );
    }
    if wanted("backslash") {
        let problem = backslash_block().expect("as given");
        row(
            "backslash plane strain n_s=17, condensed",
            &condensed_in_doubles(&problem).expect("definite"),
        );
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
