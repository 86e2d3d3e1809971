//! `mceip verify`: the main job, a table and a verdict.

use super::common::{CliError, exit, print};
use super::job::Job;
use mceip_engine::report::Table;
use mceip_testkit::floors::{Covered, floor};
use mceip_testkit::{FamilyReport, Verification, verify};
use serde_json::{Value, json};

/// Arguments of `verify`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Number of random pencils (a quarter as many random systems).
    #[arg(long, default_value_t = 200)]
    random: usize,
    /// Seed of the random families and starts.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let job = Job::begin("verify");
    let outcome = job.watched(|watch| verify(args.random, args.seed, watch))?;
    job.end();
    print(&if args.json {
        format!("{}\n", json_of(&outcome))
    } else {
        text_of(&outcome)
    })?;
    Ok(exit_code(&outcome))
}

/// A shortfall of coverage is a disagreement like any other: exit 1.
fn exit_code(v: &Verification) -> u8 {
    match (v.disagreements(), v.interrupted) {
        (0, false) => exit::DONE,
        (0, true) => exit::INTERRUPTED,
        _ => exit::REJECTED,
    }
}

fn text_of(v: &Verification) -> String {
    let header = [
        "family",
        "instances",
        "oracle",
        "found/findable",
        "proved complete",
        "accepted",
        "uncertified",
        "forgeries rejected",
        "degenerate",
        "disagreements",
    ];
    let mut table = Table::new(&header);
    for f in &v.families {
        let numbers = [
            count(f),
            f.oracle.to_string(),
            format!("{}/{}", f.found, f.findable),
            format!("{}/{}", f.completed, f.done),
            f.accepted.to_string(),
            f.uncertified.len().to_string(),
            f.rejected.to_string(),
            f.degenerate.to_string(),
            f.disagreements.len().to_string(),
        ];
        table.row([f.name.to_string()].into_iter().chain(numbers).collect());
    }
    let mut out = format!("{table}\n{}\n", coverage_of(v));
    for f in &v.families {
        out += &format!(
            "{}: corners reached {:?}, {} pivots\n",
            f.name, f.corners, f.pivots
        );
        out += &f
            .uncertified
            .iter()
            .map(|u| format!("  uncertified: {u}\n"))
            .collect::<String>();
        out += &f
            .disagreements
            .iter()
            .map(|d| format!("  DISAGREEMENT: {d}\n"))
            .collect::<String>();
    }
    out += &format!("\n{}", super::block::text_of(&v.block));
    for b in &v.block {
        out += &format!(
            "{}: {} of {} forgeries rejected\n",
            b.state.name(),
            b.rejected_forgeries,
            b.forgeries
        );
        if b.unfound > 0 {
            out += &format!(
                "  DISAGREEMENT: {} solutions of the complete set were not found\n",
                b.unfound
            );
        }
    }
    out + &format!("\n{}\n", verdict(v))
}

/// What was found of the instances that have solutions, each rate beside its floor; then the rates
/// below it.
fn coverage_of(v: &Verification) -> String {
    let mut table = Table::new(&["coverage", "starts", "first start", "all solutions"]);
    for c in v.covered() {
        table.row(vec![
            c.family.clone(),
            c.starts.word().into(),
            c.first_text(),
            c.all_text(),
        ]);
    }

    let mut out = table.to_string();
    for shortfall in v.shortfalls() {
        out += &format!("  DISAGREEMENT: coverage: {shortfall}\n");
    }
    out
}

fn count(f: &FamilyReport) -> String {
    if f.done == f.instances {
        f.done.to_string()
    } else {
        format!("{} of {}", f.done, f.instances)
    }
}

fn verdict(v: &Verification) -> String {
    let (instances, accepted) = v
        .families
        .iter()
        .fold((0, 0), |(i, a), f| (i + f.done, a + f.accepted));
    match (v.disagreements(), v.interrupted) {
        (0, false) => format!(
            "VERIFIED: no disagreement in {instances} instances and {accepted} accepted \
             certificates (seed {})",
            v.seed
        ),
        (0, true) => format!(
            "INTERRUPTED: no disagreement in the {instances} instances treated (seed {})",
            v.seed
        ),
        (n, _) => format!("DISAGREEMENT: {n} (seed {})", v.seed),
    }
}

fn json_of(v: &Verification) -> Value {
    let family = |f: &FamilyReport| {
        let corners: serde_json::Map<String, Value> = f
            .corners
            .iter()
            .map(|(c, n)| (format!("{c:?}"), json!(n)))
            .collect();
        json!({
            "name": f.name,
            "instances": f.instances,
            "done": f.done,
            "oracle_solutions": f.oracle,
            "findable": f.findable,
            "found": f.found,
            "completed": f.completed,
            "accepted": f.accepted,
            "uncertified": f.uncertified,
            "forgeries_rejected": f.rejected,
            "degenerate": f.degenerate,
            "pivots": f.pivots,
            "corners": corners,
            "disagreements": f.disagreements,
        })
    };
    let block: Vec<Value> = v
        .block
        .iter()
        .map(|b| {
            let mu: Vec<&String> = b.accepted.iter().map(|a| &a.value).collect();
            json!({
                "state": b.state.name(),
                "mu": mu,
                "paper_mu": b.state.printed_mu(),
                "forgeries": b.forgeries,
                "rejected_forgeries": b.rejected_forgeries,
                "unfound": b.unfound,
            })
        })
        .collect();
    let coverage: Vec<Value> = v.covered().iter().map(covered_json).collect();
    let shortfalls: Vec<String> = v.shortfalls().iter().map(ToString::to_string).collect();
    json!({
        "coverage": coverage,
        "shortfalls": shortfalls,
        "seed": v.seed,
        "families": v.families.iter().map(family).collect::<Vec<_>>(),
        "block": block,
        "disagreements": v.disagreements(),
        "interrupted": v.interrupted,
        "verdict": verdict(v),
    })
}

/// Counts and floors of one family and kind of start.
pub(super) fn covered_json(c: &Covered) -> Value {
    let floor = floor(&c.family, c.starts);
    json!({
        "family": c.family, "starts": c.starts.word(), "solvable": c.coverage.solvable,
        "first_start": c.coverage.first, "first_start_floor_percent": floor.map(|f| f.first),
        "all_solutions": c.coverage.all, "all_solutions_floor_percent": floor.map(|f| f.all),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_testkit::floors::{Coverage, Starts};

    fn with(first: u64, all: u64) -> Verification {
        let coverage = [(
            Starts::Search,
            Coverage {
                solvable: 100,
                first,
                all,
            },
        )]
        .into();
        let family = FamilyReport {
            name: "random pencils",
            coverage,
            ..FamilyReport::default()
        };
        Verification {
            seed: 1,
            families: vec![family],
            block: Vec::new(),
            interrupted: false,
        }
    }

    #[test]
    fn a_rate_below_its_floor_is_exit_1_and_named() {
        assert_eq!(exit_code(&with(100, 100)), exit::DONE);
        assert!(text_of(&with(100, 100)).contains("VERIFIED"));

        let missed = with(100, 50);
        assert_eq!(exit_code(&missed), exit::REJECTED);
        let text = text_of(&missed);
        assert!(
            text.contains(
                "DISAGREEMENT: coverage: random pencils, search: all solutions found in 50 of 100"
            ),
            "{text}"
        );
        assert!(
            text.contains("DISAGREEMENT: 1 (seed 1)") && !text.contains("VERIFIED"),
            "{text}"
        );
        assert_eq!(
            json_of(&missed)["shortfalls"].as_array().map(Vec::len),
            Some(1)
        );

        assert_eq!(exit_code(&with(0, 100)), exit::REJECTED);
        assert_eq!(
            exit_code(&Verification {
                interrupted: true,
                ..with(100, 100)
            }),
            exit::INTERRUPTED
        );
    }
}
