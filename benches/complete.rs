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
use mceip_engine::reduction::condense;
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_engine::search::complete::{CompleteError, CompleteOptions, Completed, complete};
use mceip_exact::to_f64;
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, Problem, Unknown, Window};
use mceip_paper::{Block, MassKind, PublishedState};
use mceip_testkit::{
    backslash_block, condensed_in_doubles, known, mechanical_pencil, refined_block,
};
use rustix::time::{ClockId, clock_gettime};

/// A run is stopped after this and reported with what is open. `BENCH_LIMIT` (seconds) changes it.
const LIMIT_SECONDS: u64 = 120;

/// Open regions printed.
const MOST_OPEN_SHOWN: usize = 200;

/// Orders of the meshes of `-- cost`.
const COST: [usize; 10] = [10, 15, 20, 30, 40, 50, 60, 70, 80, 150];

/// Larger refined meshes are measured from K only: their condensation in doubles as exact data
/// takes minutes.
const CONDENSED_UP_TO: usize = 80;

/// A refined mesh of the whole table.
struct Refined {
    /// Nodes in impending slip, before a tenth is stuck.
    slip: usize,
    tenth_stuck: bool,
}

/// The refined meshes of the whole table, in its order.
const REFINED: [Refined; 10] = [
    all_slip(24),
    all_slip(40),
    all_slip(60),
    all_slip(80),
    tenth_stuck(24),
    tenth_stuck(40),
    tenth_stuck(60),
    tenth_stuck(80),
    all_slip(150),
    tenth_stuck(150),
];

const fn all_slip(slip: usize) -> Refined {
    Refined {
        slip,
        tenth_stuck: false,
    }
}

const fn tenth_stuck(slip: usize) -> Refined {
    Refined {
        slip,
        tenth_stuck: true,
    }
}

/// Orders of the random pencils, each with the number of seeds.
const RANDOM: [(usize, u64); 4] = [(20, 20), (30, 10), (40, 10), (50, 10)];

fn main() {
    let words: Vec<String> = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with("--"))
        .collect();

    match words.first().map(String::as_str) {
        Some("draw") => draw(),
        Some("cost") => {
            let orders: Vec<usize> = words.iter().filter_map(|word| word.parse().ok()).collect();
            costs(&orders);
        }
        _ => table(&words),
    }
}

/// Prints the cases whose name contains one of the words; without words, all.
fn table(words: &[String]) {
    println!(
        "{:<44} {:>8} {:>8} {:>7} {:>6} {:>5} {:>8}",
        "case", "search s", "check s", "leaves", "found", "open", "kB"
    );

    if wanted(words, "published") {
        published();
    }

    for mesh in &REFINED {
        let kind = if mesh.tenth_stuck { "stuck" } else { "slip" };
        if wanted(words, &format!("refined-{}-{kind}", mesh.slip)) {
            refined(mesh);
        }
    }

    if wanted(words, "complete-graph") {
        for n in [12, 14] {
            let graph = known::complete_graph(n).expect("n > 0");
            row(&format!("complete graph n={n}"), &graph.problem);
        }
    }

    if wanted(words, "backslash") {
        backslash();
    }

    for unknown in [Unknown::Mu, Unknown::Lambda2] {
        for (order, seeds) in RANDOM {
            if wanted(words, &format!("random-{order}-{}", unknown.word())) {
                random(order, unknown, seeds);
            }
        }
    }
}

fn wanted(words: &[String], name: &str) -> bool {
    words.is_empty() || words.iter().any(|word| name.contains(word.as_str()))
}

/// CPU seconds of this process.
fn cpu() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A complete search, and the CPU seconds that it and one check of its result took.
struct Measured {
    search: f64,
    check: f64,
    completed: Completed,
}

impl Measured {
    /// Length of the certificate.
    fn kilobytes(&self) -> usize {
        self.completed
            .proved
            .certificate()
            .to_json()
            .len()
            .div_ceil(1000)
    }
}

/// `complete` includes one check: it is timed again and taken off.
fn measure(problem: &Problem) -> Result<Measured, CompleteError> {
    let limit = limit_seconds() as f64;
    let options = CompleteOptions {
        threads: Some(1),
        ..CompleteOptions::default()
    };
    let cancel = Cancel::new();

    let start = cpu();
    let end_when_late = |_: &Progress<'_>| {
        if cpu() - start > limit {
            cancel.request();
        }
    };
    let completed = complete(problem, &options, &Watch::new(&cancel, &end_when_late))?;
    let total = cpu() - start;

    let start = cpu();
    check(problem, completed.proved.certificate()).expect("accepted before");
    let check = cpu() - start;

    Ok(Measured {
        search: total - check,
        check,
        completed,
    })
}

fn limit_seconds() -> u64 {
    match std::env::var("BENCH_LIMIT") {
        Ok(text) => text.parse().unwrap_or(LIMIT_SECONDS),
        Err(_) => LIMIT_SECONDS,
    }
}

/// Measures a problem and prints its line of the table.
fn row(name: &str, problem: &Problem) {
    let measured = match measure(problem) {
        Ok(measured) => measured,
        Err(error) => return println!("{name:<44} {error}"),
    };

    let cover = &measured.completed.cover;
    println!(
        "{name:<44} {:>8.3} {:>8.3} {:>7} {:>6} {:>5} {:>8}",
        measured.search,
        measured.check,
        cover.leaves,
        cover.solutions.len(),
        cover.open.len(),
        measured.kilobytes()
    );

    print_open(&measured.completed);
}

/// Prints the regions that stay open.
fn print_open(completed: &Completed) {
    for open in completed.cover.open.iter().take(MOST_OPEN_SHOWN) {
        let min = open.min.as_ref().map_or(f64::NEG_INFINITY, to_f64);
        let max = open.max.as_ref().map_or(f64::INFINITY, to_f64);
        println!(
            "    open: [{min:.17e}, {max:.17e}] moving {:?} undecided {:?}",
            open.moving, open.undecided
        );
    }
}

/// The published states, from the condensed pencil and from the mesh.
fn published() {
    let start = cpu();
    let block = Block::of_the_paper(MassKind::Consistent);

    for state in PublishedState::ALL {
        let problem = state.problem(&block).expect("as published");
        let reduced = reduce(&problem).expect("as published");

        let begun = cpu();
        let admissible = Admissible::new(&reduced.pencil, Unknown::Mu).expect("admissible");
        let condensed = condense(&admissible).expect("definite");
        println!("    exact condensation {:.2} s", cpu() - begun);

        let condensed = Problem::new(Body::Pencil(condensed), Unknown::Mu, Window::all())
            .expect("as published");
        row(
            &format!("published {}, condensed", state.name()),
            &condensed,
        );
        row(&format!("published {}, mesh", state.name()), &problem);
    }

    println!("    both, from nothing, all of it: {:.2} s", cpu() - start);
}

/// One refined mesh, from K and, if it is not too large, from the condensed pencil.
fn refined(mesh: &Refined) {
    let problem = refined_block(mesh.slip, mesh.tenth_stuck).expect("within limits");
    let n_s = reduce(&problem).expect("a model").pencil.slip().len();
    let kind = if mesh.tenth_stuck {
        "tenth stuck"
    } else {
        "all slip"
    };
    row(&format!("refined {kind} n_s={n_s}, mesh"), &problem);

    if mesh.slip > CONDENSED_UP_TO {
        return;
    }

    let begun = cpu();
    let condensed = condensed_in_doubles(&problem).expect("definite");
    let seconds = cpu() - begun;
    row(
        &format!("refined {kind} n_s={n_s}, condensed ({seconds:.1} s)"),
        &condensed,
    );
}

/// The hard case of [`backslash_block`], both ways.
fn backslash() {
    let problem = backslash_block().expect("as given");
    let condensed = condensed_in_doubles(&problem).expect("definite");
    row("backslash plane strain n_s=17, condensed", &condensed);
    row("backslash plane strain n_s=17, mesh", &problem);
}

/// `count` seeds: the sum of solutions, medians and maxima, how many are closed.
fn random(n: usize, unknown: Unknown, count: u64) {
    let name = format!("n={n} {}", unknown.word());

    let mut runs = Vec::new();
    for seed in 1..=count {
        let problem = mechanical_pencil(n, unknown, seed).expect("n > 0");
        match measure(&problem) {
            Ok(run) => {
                let cover = &run.completed.cover;
                println!(
                    "    {name} seed {seed}: {:.3} {:.3} {} leaves",
                    run.search, run.check, cover.leaves
                );
                print_open(&run.completed);
                runs.push(run);
            }
            Err(error) => println!("    {name} seed {seed}: {error}"),
        }
    }

    if !runs.is_empty() {
        print_summary(&name, &runs, count);
    }
}

fn print_summary(name: &str, runs: &[Measured], count: u64) {
    let both = sorted(runs.iter().map(|run| run.search + run.check));
    let search = sorted(runs.iter().map(|run| run.search));
    let check = sorted(runs.iter().map(|run| run.check));
    let mut leaves: Vec<_> = runs.iter().map(|run| run.completed.cover.leaves).collect();
    leaves.sort_unstable();

    let closed = runs
        .iter()
        .filter(|run| run.completed.is_complete())
        .count();
    let solutions: Vec<usize> = runs
        .iter()
        .map(|run| run.completed.cover.solutions.len())
        .collect();

    let median = runs.len() / 2;
    let ninth_of_ten = (9 * runs.len()).div_ceil(10) - 1;
    let last = runs.len() - 1;

    println!(
        "random mechanical {name}: {closed}/{count} closed; search + check {:.3} median {:.3} \
         ninth of ten {:.3} max; search {:.3} median {:.3} max; check {:.3} median {:.3} max; \
         leaves {} median {} max; solutions {solutions:?}",
        both[median],
        both[ninth_of_ten],
        both[last],
        search[median],
        search[last],
        check[median],
        check[last],
        leaves[median],
        leaves[last],
    );
}

fn sorted(seconds: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = seconds.collect();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Measures the refined meshes; without a list of orders of one's own, table and picture are
/// written.
fn costs(own_orders: &[usize]) {
    let orders = if own_orders.is_empty() {
        &COST[..]
    } else {
        own_orders
    };

    let mut runs = Vec::new();
    for (case, tenth_stuck) in [("all slip", false), ("a tenth stuck", true)] {
        for &order in orders {
            match measure_cost(case, order, tenth_stuck) {
                Ok(run) => {
                    println!("{}", run.line());
                    runs.push(run);
                }
                Err(error) => println!("# {case} {order}: {error}"),
            }
        }
    }

    if own_orders.is_empty() {
        let lines: String = runs.iter().map(|run| run.line() + "\n").collect();
        std::fs::write(cost::CSV, format!("{}\n{lines}", cost::HEAD))
            .expect("spec/figures is there");
        draw();
    }
}

/// The line of one refined mesh in the table of costs.
fn measure_cost(case: &str, order: usize, tenth_stuck: bool) -> Result<cost::Run, CompleteError> {
    let problem = refined_block(order, tenth_stuck).expect("within limits");
    let pencil = reduce(&problem).expect("a model").pencil;

    let measured = measure(&problem)?;

    let cover = &measured.completed.cover;
    Ok(cost::Run {
        case: case.into(),
        slip: pencil.slip().len(),
        free: pencil.free().len(),
        complete: measured.search + measured.check,
        check: measured.check,
        leaves: cover.leaves,
        solutions: cover.solutions.len(),
        open: cover.open.len(),
        kilobytes: measured.kilobytes(),
    })
}

/// The figure of the table as it stands in its file.
fn draw() {
    let runs = std::fs::read_to_string(cost::CSV)
        .ok()
        .and_then(|csv| cost::read(&csv))
        .expect("a table in spec/figures");
    std::fs::write(cost::SVG, cost::picture(&runs).to_svg()).expect("spec/figures is there");
}
