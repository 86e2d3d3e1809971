//! `mceip verify`: the main job, a table and a verdict.
//!
//! The work is `mceip_testkit::verify`: problems of many families and the two states of the block
//! are solved, certified, checked and compared with the oracle. With `--verified` each certificate
//! is also given to the verified checker of `proofs/`. Here the outcome is printed.

use super::common::{CliError, exit, print_answer, require_count};
use super::job::Job;
use mceip_engine::report::{Table, counted};
use mceip_testkit::floors::{Covered, Shortfall, floor};
use mceip_testkit::verified::{VerifiedChecker, VerifiedCounts};
use mceip_testkit::{BlockReport, FamilyReport, Verification, verify};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Arguments of `verify`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Number of random pencils (a quarter as many random systems).
    #[arg(long, default_value_t = 200)]
    random: usize,
    /// Seed of the random families and starts.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Give each accepted certificate to the verified checker, too (`make -C proofs program` builds
    /// it). Without PATH: the program that the environment variable MCEIP_VERIFIED names, or
    /// proofs/mceip-verified in this folder or above it.
    #[arg(long, value_name = "PATH")]
    verified: Option<Option<PathBuf>>,
    /// List the points without certificate, too, and the corner cases that were reached.
    #[arg(long)]
    verbose: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// More random pencils than any machine verifies in a year.
const MAX_RANDOM: u64 = 1_000_000_000;

/// Verifies and prints the outcome.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let checker = match &args.verified {
        Some(path) => Some(VerifiedChecker::find(path.as_deref())?),
        None => None,
    };

    require_count("random", args.random as u64, 0..=MAX_RANDOM)?;
    let job = Job::begin("verify");
    let outcome = job.watched(|watch| verify(args.random, args.seed, checker.as_ref(), watch))?;
    job.end();

    let counts = checker.is_some().then(|| outcome.verified());
    print_answer(
        args.json,
        || json_of(&outcome, counts.as_ref()),
        || text_of(&outcome, counts.as_ref(), args.verbose),
    )?;

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

/// Lists, if they are asked for, then tables, and the verdict last. `counts`: verdicts of the
/// verified checker, if it was asked.
fn text_of(v: &Verification, counts: Option<&VerifiedCounts>, is_verbose: bool) -> String {
    let mut out = String::new();
    if is_verbose {
        for family in &v.families {
            out += &details_of(family);
        }
        out += "\n";
    }

    out += &format!("{}\n", families_table(&v.families));
    out += &format!("{}\n", coverage_text(&v.covered(), &v.shortfalls()));
    out += &super::block::text_of(&v.block);
    for state in &v.block {
        out += &block_text(state);
    }
    if let Some(counts) = counts {
        out += &format!("\n{}", verified_text(counts));
    }

    out += "\n";
    for family in &v.families {
        for disagreement in &family.tally.disagreements {
            out += &format!("DISAGREEMENT: {}: {disagreement}\n", family.name);
        }
    }
    out + &format!("{}\n", verdict(v))
}

fn families_table(families: &[FamilyReport]) -> Table {
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
    for family in families {
        table.row(row(family));
    }

    table
}

/// Verdicts of the verified checker: by kind of evidence, then what it has no theorem for.
fn verified_text(counts: &VerifiedCounts) -> String {
    let mut table = Table::new(&[
        "verified checker",
        "certificates",
        "accepted",
        "not verified",
        "refused",
    ]);
    for (kind, of_kind) in &counts.kinds {
        table.row(vec![
            kind.to_string(),
            of_kind.total().to_string(),
            of_kind.accepted.to_string(),
            of_kind.not_verified.to_string(),
            of_kind.refused.to_string(),
        ]);
    }

    let mut out = table.to_string();
    for (what, count) in &counts.not_verified {
        out += &format!("not verified: {what}: {count}\n");
    }

    let accepted = counts.accepted;
    let not_verified = counts.total_not_verified();
    let refused = counts.refused;
    let total = accepted + not_verified + refused;
    out + &format!(
        "verified checker: {accepted} of {total} certificates accepted, {not_verified} not \
         verified, {refused} refused\n"
    )
}

fn row(family: &FamilyReport) -> Vec<String> {
    let tally = &family.tally;
    vec![
        family.name.to_string(),
        count(family),
        tally.solutions.to_string(),
        format!("{}/{}", tally.found, tally.findable),
        format!("{}/{}", tally.closed, tally.instances),
        tally.accepted.to_string(),
        tally.uncertified.to_string(),
        family.rejected.to_string(),
        tally.degenerate.to_string(),
        tally.disagreements.len().to_string(),
    ]
}

/// What the table has no room for: corner cases, and points that stayed without certificate.
fn details_of(family: &FamilyReport) -> String {
    let corners = family.tally.corners();
    let corners: Vec<String> = corners
        .map(|(corner, count)| format!("{} {count}", corner.word()))
        .collect();
    let mut out = format!(
        "{}: {}; {}\n",
        family.name,
        corners.join(", "),
        counted(family.tally.pivots, "pivot")
    );
    for point in &family.uncertified {
        out += &format!("  uncertified: {point}\n");
    }

    out
}

/// The forgeries of a state of the block, and the solutions that the search missed.
fn block_text(state: &BlockReport) -> String {
    let name = state.state.name();
    let rejected = state.rejected_forgeries;
    let forgeries = state.forgeries;
    let mut out = format!("{name}: {rejected} of {forgeries} forgeries rejected\n");

    for reason in &state.refused {
        out += &format!("  DISAGREEMENT: the verified checker refuses a certificate: {reason}\n");
    }

    let unfound = state.unfound;
    if unfound > 0 {
        let unfound = counted(unfound, "solution");
        out += &format!("  DISAGREEMENT: not found: {unfound} of the complete set\n");
    }

    out
}

/// What was found of the instances that have solutions, each rate beside its floor; then the rates
/// below it.
pub(super) fn coverage_text(covered: &[Covered], shortfalls: &[Shortfall]) -> String {
    let mut table = Table::new(&["coverage", "starts", "first start", "all solutions"]);
    for family in covered {
        table.row(vec![
            family.family.clone(),
            family.starts.word().into(),
            family.first_text(),
            family.all_text(),
        ]);
    }

    let mut out = table.to_string();
    for shortfall in shortfalls {
        out += &format!("  DISAGREEMENT: coverage: {shortfall}\n");
    }

    out
}

/// The number of instances treated, and of how many if the run was interrupted.
fn count(family: &FamilyReport) -> String {
    let done = family.tally.instances;
    if done == family.instances as u64 {
        done.to_string()
    } else {
        format!("{done} of {}", family.instances)
    }
}

fn verdict(v: &Verification) -> String {
    let seed = v.seed;
    let tallies = v.families.iter().map(|family| &family.tally);
    let instances: u64 = tallies.clone().map(|tally| tally.instances).sum();
    let instances = counted(instances, "instance");
    let accepted: u64 = tallies.map(|tally| tally.accepted).sum();
    let accepted = counted(accepted, "accepted certificate");

    match (v.disagreements(), v.interrupted) {
        (0, false) => {
            format!("VERIFIED: no disagreement in {instances} and {accepted} (seed {seed})")
        }
        (0, true) => {
            format!("INTERRUPTED: no disagreement in the {instances} treated (seed {seed})")
        }
        (n, _) => format!("DISAGREEMENT: {n} (seed {seed})"),
    }
}

fn json_of(v: &Verification, counts: Option<&VerifiedCounts>) -> Value {
    let families: Vec<Value> = v.families.iter().map(family_json).collect();
    let block: Vec<Value> = v.block.iter().map(block_json).collect();
    let coverage: Vec<Value> = v.covered().iter().map(covered_json).collect();
    let shortfalls: Vec<String> = v.shortfalls().iter().map(ToString::to_string).collect();

    json!({
        "coverage": coverage,
        "shortfalls": shortfalls,
        "seed": v.seed,
        "families": families,
        "block": block,
        "verified": counts,
        "disagreements": v.disagreements(),
        "interrupted": v.interrupted,
        "verdict": verdict(v),
    })
}

fn family_json(family: &FamilyReport) -> Value {
    let tally = &family.tally;
    json!({
        "name": family.name,
        "instances": family.instances,
        "done": tally.instances,
        "oracle_solutions": tally.solutions,
        "findable": tally.findable,
        "found": tally.found,
        "completed": tally.closed,
        "accepted": tally.accepted,
        "uncertified": family.uncertified,
        "forgeries_rejected": family.rejected,
        "degenerate": tally.degenerate,
        "pivots": tally.pivots,
        "corners": tally.corners,
        "disagreements": tally.disagreements,
    })
}

fn block_json(state: &BlockReport) -> Value {
    let mu: Vec<&String> = state.accepted.iter().map(|a| &a.value).collect();
    json!({
        "state": state.state.name(),
        "mu": mu,
        "paper_mu": state.state.printed_mu(),
        "forgeries": state.forgeries,
        "rejected_forgeries": state.rejected_forgeries,
        "unfound": state.unfound,
        "refused_by_verified_checker": state.refused,
    })
}

/// Counts and floors of one family and kind of start.
pub(super) fn covered_json(covered: &Covered) -> Value {
    let floor = floor(&covered.family, covered.starts);
    json!({
        "family": covered.family,
        "starts": covered.starts.word(),
        "solvable": covered.coverage.solvable,
        "first_start": covered.coverage.first,
        "first_start_floor_percent": floor.map(|f| f.first),
        "all_solutions": covered.coverage.all,
        "all_solutions_floor_percent": floor.map(|f| f.all),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_testkit::Tally;
    use mceip_testkit::floors::{Coverage, Starts};
    use mceip_testkit::verified::KindCounts;

    /// A run over 100 instances with solutions, found from the first start and all of them in so
    /// many.
    fn run_with_coverage(first: u64, all: u64) -> Verification {
        let coverage = Coverage {
            solvable: 100,
            first,
            all,
        };
        let family = FamilyReport {
            name: "random pencils",
            tally: Tally {
                coverage: [(Starts::Search.word().into(), coverage)].into(),
                ..Tally::default()
            },
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
        let good = run_with_coverage(100, 100);
        assert_eq!(exit_code(&good), exit::DONE);
        assert!(text_of(&good, None, false).contains("VERIFIED"));

        let misses_half = run_with_coverage(100, 50);
        assert_eq!(exit_code(&misses_half), exit::REJECTED);
        let text = text_of(&misses_half, None, false);
        let shortfall =
            "DISAGREEMENT: coverage: random pencils, search: all solutions found in 50 of 100";
        assert!(text.contains(shortfall), "{text}");
        assert!(text.contains("DISAGREEMENT: 1 (seed 1)"), "{text}");
        assert!(!text.contains("VERIFIED"), "{text}");
        let json = json_of(&misses_half, None);
        assert_eq!(json["shortfalls"].as_array().map(Vec::len), Some(1));

        let never_at_once = run_with_coverage(0, 100);
        assert_eq!(exit_code(&never_at_once), exit::REJECTED);

        let interrupted = Verification {
            interrupted: true,
            ..run_with_coverage(100, 100)
        };
        assert_eq!(exit_code(&interrupted), exit::INTERRUPTED);
    }

    /// A certificate that is accepted, one that is not verified, one that is refused.
    fn three_verdicts() -> VerifiedCounts {
        let counts = KindCounts {
            accepted: 1,
            refused: 1,
            not_verified: 1,
        };
        VerifiedCounts {
            accepted: 1,
            refused: 1,
            not_verified: [("support".to_string(), 1)].into(),
            kinds: [("support", counts)].into(),
        }
    }

    #[test]
    fn verdicts_of_the_verified_checker_are_printed_by_kind() {
        let run = run_with_coverage(100, 100);
        let without = text_of(&run, None, false);
        assert!(!without.contains("verified checker"), "{without}");
        assert!(json_of(&run, None)["verified"].is_null());

        let counts = three_verdicts();
        let text = text_of(&run, Some(&counts), false);
        let last = "1 of 3 certificates accepted, 1 not verified, 1 refused";
        assert!(text.contains(last), "{text}");
        assert!(text.contains("not verified: support: 1"), "{text}");

        let json = json_of(&run, Some(&counts));
        assert_eq!(json["verified"]["refused"], 1);
        assert_eq!(json["verified"]["kinds"]["support"]["not_verified"], 1);
    }

    #[test]
    fn a_refusal_is_a_disagreement_and_exit_1() {
        let mut run = run_with_coverage(100, 100);
        run.families[0]
            .tally
            .disagreements
            .push("random pencils 3: the verified checker".into());
        assert_eq!(exit_code(&run), exit::REJECTED);
        let text = text_of(&run, None, false);
        assert!(
            text.contains("\nDISAGREEMENT: random pencils: random pencils 3"),
            "{text}"
        );
    }

    #[test]
    fn points_without_certificate_and_corner_cases_are_listed_where_it_is_asked_for() {
        let mut run = run_with_coverage(100, 100);
        run.families[0]
            .uncertified
            .push("random pencils 5: no root".into());
        let corners = &mut run.families[0].tally.corners;
        corners.insert("WideKernel".into(), 3);

        let short = text_of(&run, None, false);
        assert!(
            !short.contains("no root") && !short.contains("kernel"),
            "{short}"
        );

        let long = text_of(&run, None, true);
        let listed = "random pencils: kernel of several dimensions 3; 0 pivots\n  uncertified: \
                      random pencils 5: no root\n";
        assert!(long.starts_with(listed), "{long}");
        assert!(long.ends_with(&short), "{long}");
    }
}
