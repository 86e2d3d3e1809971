//! `mceip enumerate`: every support of a small problem by exact arithmetic (the oracle).

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

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, args.window.as_deref())?;
    let reduced = reduce(&problem)?;

    let job = Job::begin("supports");
    let told = |done: u64, total: u64| {
        job.say(Progress::of("supports", done as usize, total as usize));
        job.flow()
    };
    let found = enumerate_with(&reduced.pencil, problem.window(), told)?;
    job.end();

    print(&report(&problem, &reduced, &found, args.json))?;
    Ok(code(&found))
}

fn report(problem: &Problem, reduced: &Reduced, found: &Enumeration, is_json: bool) -> String {
    let how = "every one by exact arithmetic";
    let (done, total) = (found.supports_done, found.supports_total);
    let evidence = match (found.is_finished(), found.is_complete_list()) {
        (true, true) => format!("complete, by the plain enumeration of {total} supports: {how}"),
        (true, false) => {
            format!(
                "all {total} supports examined by the plain enumeration: {how}; what is named \
                 without a description is left open"
            )
        }
        (false, _) => {
            format!("the plain enumeration was interrupted after {done} of {total} supports: {how}")
        }
    };

    let solutions = found
        .solutions
        .iter()
        .map(|s| Listed::of_solution(problem, reduced, s))
        .collect();
    let claim = Claimed::complete_if(found.is_complete_list());
    let report = Report {
        problem,
        reduced,
        solutions,
        claim,
        evidence,
        enumeration: Some(found),
        cover: None,
    };
    if is_json {
        format!("{}\n", solutions_json(&report))
    } else {
        solutions_text(&report)
    }
}

fn code(found: &Enumeration) -> u8 {
    match (found.is_finished(), found.is_complete_list()) {
        (false, _) => exit::INTERRUPTED,
        (true, true) => exit::DONE,
        (true, false) => exit::UNDECIDED, // what is left open has been named
    }
}
