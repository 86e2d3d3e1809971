//! `mceip enumerate`: every support of a small problem by exact arithmetic (the oracle).
//!
//! (24)-(26): for each support the values at which its equations have a solution, and of those the
//! ones that meet the inequalities. With particles in contact with zero reaction the same for each
//! choice of modes (`spec/zero-reaction.md`, Z.3).

use super::common::{CliError, exit, print_answer};
use super::job::Job;
use super::question::{Question, load_question};
use crate::Problem;
use std::path::PathBuf;

/// Arguments of `enumerate`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end; of
    /// eigenvalues a empty or -inf: no lower end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

/// Enumerates and prints the solutions.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = match load_question(&args.file, args.window.as_deref())? {
        Question::Problem(problem) => Problem::from(*problem),
        Question::NoSolution(answer) => return answer.print(args.json, None),
    };

    let job = Job::begin("enumerating");
    let question = problem.enumerate().cancel(job.cancel());
    let found = question.on_progress(|progress| job.say(progress)).run()?;
    job.end();

    print_answer(args.json, || found.to_json(), || found.to_string())?;

    Ok(if !found.is_finished() {
        exit::INTERRUPTED
    } else if found.is_complete() {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}
