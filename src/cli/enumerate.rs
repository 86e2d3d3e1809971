//! `mceip enumerate`: every support of a small problem by exact arithmetic (the oracle).
//!
//! (24)-(26): for each support the values at which its equations have a solution, and of those the
//! ones that meet the inequalities. With particles in contact with zero reaction the same for each
//! choice of modes (`spec/zero-reaction.md`, Z.3).

use super::common::{CliError, exit, print};
use super::job::Job;
use super::question::{Question, load_question};
use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_engine::run::Progress;
use mceip_model::reduction::reduce;
use mceip_model::{Problem, Reduced};
use mceip_oracle::{Enumeration, ModeList, Solution, enumerate_modes_with, enumerate_with};
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
    let problem = match load_question(&args.file, args.window.as_deref())? {
        Question::Problem(problem) => *problem,
        Question::NoSolution(answer) => return answer.print(args.json, None),
    };
    let reduced = reduce(&problem)?;
    if !reduced.zero.is_empty() {
        return run_modes(args, &problem, &reduced);
    }

    let job = Job::begin("supports");
    let show = |done: u64, total: u64| {
        job.say(Progress::of("supports", done as usize, total as usize));
        job.flow()
    };
    let found = enumerate_with(&reduced.pencil, problem.window(), show)?;
    job.end();

    print(&report(&problem, &reduced, &found, args.json))?;
    Ok(exit_code(found.is_finished(), found.is_complete_list()))
}

/// Enumerates the modes of a system with particles in contact with zero reaction.
fn run_modes(args: &Args, problem: &Problem, reduced: &Reduced) -> Result<u8, CliError> {
    let job = Job::begin("choices of modes");
    let show = |done: u64, total: u64| {
        job.say(Progress::of(
            "choices of modes",
            done as usize,
            total as usize,
        ));
        job.flow()
    };
    let found = enumerate_modes_with(reduced, problem.window(), show)?;
    job.end();

    let report = Report {
        problem,
        reduced,
        solutions: listed(problem, reduced, &found.solutions),
        claim: Claimed::complete_if(found.is_complete_list()),
        evidence: evidence_of_modes(&found),
        enumeration: None,
        cover: None,
    };
    print(&text_of(&report, args.json))?;

    Ok(exit_code(found.is_finished(), found.is_complete_list()))
}

fn report(problem: &Problem, reduced: &Reduced, found: &Enumeration, is_json: bool) -> String {
    let report = Report {
        problem,
        reduced,
        solutions: listed(problem, reduced, &found.solutions),
        claim: Claimed::of_enumeration(found),
        evidence: evidence(found),
        enumeration: Some(found),
        cover: None,
    };

    text_of(&report, is_json)
}

fn listed(problem: &Problem, reduced: &Reduced, solutions: &[Solution]) -> Vec<Listed> {
    let of_solution = |solution| Listed::of_solution(problem, reduced, solution);
    solutions.iter().map(of_solution).collect()
}

fn text_of(report: &Report<'_>, is_json: bool) -> String {
    if is_json {
        format!("{}\n", solutions_json(report))
    } else {
        solutions_text(report)
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

/// What the enumeration of modes has examined.
fn evidence_of_modes(found: &ModeList) -> String {
    let done = found.choices;
    let total = found.choices_total;
    let how = "every one by exact arithmetic";

    if !found.is_finished() {
        format!(
            "the plain enumeration was interrupted after {done} of {total} choices of modes: {how}"
        )
    } else if found.is_complete_list() {
        format!("complete, by the plain enumeration of {total} choices of modes: {how}")
    } else {
        let open = found.degenerate.len();
        format!(
            "all {total} choices of modes examined by the plain enumeration: {how}; of {open} \
             of them, which are singular, the solutions are not listed"
        )
    }
}

fn exit_code(is_finished: bool, is_complete: bool) -> u8 {
    if !is_finished {
        exit::INTERRUPTED
    } else if is_complete {
        exit::DONE
    } else {
        exit::UNDECIDED
    }
}
