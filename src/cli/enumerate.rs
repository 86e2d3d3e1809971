//! `mceip enumerate`: every support of a small problem by exact arithmetic (the oracle).
//!
//! (24)-(26): for each support the values at which its equations have a solution, and of those the
//! ones that meet the inequalities.

use super::common::{CliError, exit, load, print};
use super::job::Job;
use mceip_engine::reduction::{Reduced, reduce};
use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_engine::run::Progress;
use mceip_model::Problem;
use mceip_oracle::{Enumeration, enumerate_with};
use std::path::PathBuf;

/// Arguments of `enumerate`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

/// Enumerates the supports and prints the solutions.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, args.window.as_deref())?;
    let reduced = reduce(&problem)?;

    let job = Job::begin("supports");
    let show = |done: u64, total: u64| {
        job.say(Progress::of("supports", done as usize, total as usize));
        job.flow()
    };
    let found = enumerate_with(&reduced.pencil, problem.window(), show)?;
    job.end();

    print(&report(&problem, &reduced, &found, args.json))?;
    Ok(exit_code(&found))
}

fn report(problem: &Problem, reduced: &Reduced, found: &Enumeration, is_json: bool) -> String {
    let mut solutions = Vec::new();
    for solution in &found.solutions {
        solutions.push(Listed::of_solution(problem, reduced, solution));
    }

    let report = Report {
        problem,
        reduced,
        solutions,
        claim: Claimed::complete_if(found.is_complete_list()),
        evidence: evidence(found),
        enumeration: Some(found),
        cover: None,
    };

    if is_json {
        format!("{}\n", solutions_json(&report))
    } else {
        solutions_text(&report)
    }
}

/// What the enumeration has examined.
fn evidence(found: &Enumeration) -> String {
    let done = found.supports_done;
    let total = found.supports_total;
    let how = "every one by exact arithmetic";

    if !found.is_finished() {
        format!("the plain enumeration was interrupted after {done} of {total} supports: {how}")
    } else if found.is_complete_list() {
        format!("complete, by the plain enumeration of {total} supports: {how}")
    } else {
        format!(
            "all {total} supports examined by the plain enumeration: {how}; what is named \
             without a description is left open"
        )
    }
}

fn exit_code(found: &Enumeration) -> u8 {
    if !found.is_finished() {
        exit::INTERRUPTED
    } else if found.is_complete_list() {
        exit::DONE
    } else {
        exit::UNDECIDED
    }
}
