//! `mceip solve`: the PATH-style solver with many starts, every claim certified.
//!
//! The format of the problem decides what is solved: an eigenproblem here, a plain LCP or MCP in
//! [`plain`]. [`trace`] records a run and repeats it.

mod args;
mod plain;
mod search;
mod trace;

pub(super) use args::Args;

use super::common::{CliError, aside, exit, print_answer, require_count, text};
use super::job::Job;
use super::output::Output;
use super::question::{Question, load_question, print_without_solutions};
use crate::{Error, Found, Problem};
use mceip_engine::lcp::MCP_FORMAT;
use mceip_engine::multistart::{MAX_STARTS, SearchError, trace_outcome};
use mceip_engine::report::Claimed;
use mceip_model::Unknown;
use mceip_model::file::require_format;
use mceip_model::reduction::reduce;
use search::search_of;
use std::path::Path;

/// Solves the problem, or repeats a trace.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    require_count("starts", args.starts as u64, 1..=MAX_STARTS as u64)?;

    if let Some(path) = &args.replay {
        return trace::replay(path);
    }

    let Some(file) = &args.file else {
        return Err(CliError::option("replay", "a file, or a problem", ""));
    };

    let source = text("the problem", file)?;
    let is_plain = require_format(&source, MCP_FORMAT).is_ok();

    if is_plain {
        refuse_window(args)?;
        plain::run(args, file, &source)
    } else {
        refuse_check(args)?;
        eigenproblem(args, file)
    }
}

/// Refuses --window, which a plain problem has no use for.
fn refuse_window(args: &Args) -> Result<(), CliError> {
    let Some(window) = &args.window else {
        return Ok(());
    };

    Err(CliError::Option {
        option: "window",
        expected: "a problem of format mceip-problem/1",
        got: window.clone(),
    })
}

/// Refuses --check, which is for plain problems only.
fn refuse_check(args: &Args) -> Result<(), CliError> {
    let Some(path) = &args.check else {
        return Ok(());
    };

    Err(CliError::Option {
        option: "check",
        expected: "a problem of format mceip-mcp/1 (mceip check for others)",
        got: path.display().to_string(),
    })
}

/// Searches, certifies and prints an `mceip-problem/1`.
fn eigenproblem(args: &Args, file: &Path) -> Result<u8, CliError> {
    let problem = match load_question(file, args.window.as_deref())? {
        Question::Problem(problem) => Problem::from(*problem),
        Question::NoSolution(answer) => {
            return answer.print(args.json, args.certificate.as_deref());
        }
    };
    let output = Output::prepare_if("certificate", args.certificate.as_deref(), &[file])?;
    let trace_output = Output::prepare_if("trace", args.trace.as_deref(), &[file])?;

    let job = Job::begin("searching");
    let mut search = search_of(&problem, args.starts, args.seed, args.all);
    if args.exact {
        search = search.exact();
    }
    if args.trace.is_some() {
        search = search.trace();
    }
    let searched = search
        .cancel(job.cancel())
        .on_progress(|progress| job.say(progress));
    let searched = searched.run();
    job.end();

    let found = match searched {
        Err(Error::Solve(e @ SearchError::BeyondDoubles { .. })) => {
            return undecided(args, problem.unknown(), &e);
        }
        searched => searched?,
    };

    // Proofs first; what cannot be written takes nothing else along.
    let is_found = !found.solutions.is_empty();
    let proofs = match output {
        Some(output) if is_found => output.write_proved(found.certificates()),
        _ => Ok(()),
    };
    let log = match trace_output {
        Some(output) if !found.is_cancelled => {
            output.write(&trace::text_of(&problem, &found, args.all))
        }
        _ => Ok(()),
    };

    print_asides(args, &problem, &found)?;
    print_answer(args.json, || found.to_json(), || found.to_string())?;
    proofs.and(log)?;

    Ok(if found.is_cancelled {
        exit::INTERRUPTED
    } else if is_found {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}

/// A problem whose numbers no search in doubles can take.
fn undecided(args: &Args, unknown: Unknown, reason: &SearchError) -> Result<u8, CliError> {
    let claim = Claimed::Solutions.word();
    let evidence = format!("no search: {reason}");
    let sentence = format!("UNDECIDED: {reason}\n");
    print_without_solutions(unknown, args.json, [claim, &evidence, &sentence])?;
    Ok(exit::UNDECIDED)
}

/// What goes to stderr: points without a certificate, singular supports, the first run's log.
fn print_asides(args: &Args, problem: &Problem, found: &Found) -> Result<(), CliError> {
    let pencil = reduce(problem.as_model())?.pencil;
    let run = found.as_run();
    let word = problem.as_model().unknown().word();
    for point in &found.uncertified {
        let value = point.candidate.value;
        aside(&format!("uncertified: {word} = {value}: {}", point.reason));
    }

    for support in run.singular_supports(pencil.free().len()) {
        aside(&format!(
            "singular pencil: support {support:?} has more values than its order: every value is \
             an eigenvalue, those listed are examples"
        ));
    }

    if let Some(first) = &run.first
        && args.log
    {
        aside(trace_outcome(first).trim_end_matches('\n'));
    }

    Ok(())
}
