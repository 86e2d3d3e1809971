//! `mceip complete`: all solutions in a window, with a proof that there are no others.
//!
//! The certificate can be searched in parts (`--shard`, joined by `mceip merge`) and gone on with
//! (`--resume`). What is printed is what the checker has proved of it.

use super::common::{
    CliError, exit, part, print_answer, require_count, require_threads, seconds, shell_word, text,
};
use super::infinity::{AtInfinity, Files, LimitProblem};
use super::job::{CHECKPOINT, Job, is_quiet};
use super::output::Output;
use super::question::{Question, load_question};
use crate::SolutionSet;
use mceip_check::certificate::Certificate;
use mceip_engine::search::complete::CompleteOptions;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Arguments of `complete`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end; of
    /// eigenvalues a empty or -inf: no lower end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Write the certificate to this file; after an interrupt it holds what is left open, and so it
    /// does from time to time while the search goes on.
    #[arg(long, value_name = "OUT")]
    certificate: Option<PathBuf>,
    /// Seconds between two writes of the certificate while the search goes on; twice as long as it
    /// takes to check what is written, where that is more.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = CHECKPOINT.as_secs_f64(),
        requires = "certificate",
        allow_hyphen_values = true
    )]
    checkpoint: f64,
    /// Go on with a certificate that leaves regions open (after an interrupt, or a shard).
    #[arg(long, value_name = "CERTIFICATE")]
    resume: Option<PathBuf>,
    /// Say as well what there is at infinity, the limit of the pencil for large values (window
    /// without upper end); with --certificate OUT proved in OUT.infinity.json, for the reversed
    /// problem OUT.infinity-problem.json.
    #[arg(long)]
    infinity: bool,
    /// Search part i of n of the pieces and leave the others open; `mceip merge` joins the parts.
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,
    /// Pieces the window is cut into; more of them for more shards.
    #[arg(long, default_value_t = CompleteOptions::default().pieces)]
    pieces: usize,
    /// Threads (default: all cores). The certificate does not depend on it.
    #[arg(long)]
    threads: Option<usize>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

/// More pieces than any machine has use for.
const MAX_PIECES: u64 = 100_000;

/// Searches, prints what is proved and writes the certificate.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = match load_question(&args.file, args.window.as_deref())? {
        Question::Problem(problem) => crate::Problem::from(*problem),
        Question::NoSolution(answer) => {
            return answer.print(args.json, args.certificate.as_deref());
        }
    };
    let part = args.shard.as_deref().map(|given| part("shard", given));
    let part = part.transpose()?;
    require_threads(args.threads)?;
    require_count("pieces", args.pieces as u64, 1..=MAX_PIECES)?;
    let limit = if args.infinity {
        Some(LimitProblem::of(&problem)?)
    } else {
        None
    };
    let every = seconds("checkpoint", args.checkpoint)?;

    let earlier = args.resume.as_deref().map(read).transpose()?;
    let path = args.certificate.as_deref();
    let output = Output::prepare_if("certificate", path, &[&args.file])?;
    let files_at_infinity = match path {
        Some(path) if args.infinity => Some(Files::prepare(path, &args.file)?),
        _ => None,
    };

    let job = Job::begin("searching");
    let has_said = AtomicBool::new(false);
    let mut search = problem.complete().pieces(args.pieces).cancel(job.cancel());
    search = search.on_progress(|progress| job.say(progress));
    if let Some(threads) = args.threads {
        search = search.threads(threads);
    }
    if let Some((index, count)) = part {
        search = search.part(index, count);
    }
    if let Some(earlier) = &earlier {
        search = search.resume(earlier);
    }
    if let Some(output) = output.as_ref().filter(|output| !output.is_device()) {
        search = search.keep(every, |kept| {
            let text = kept.certificate.file().map_err(CliError::from);
            let written = text.and_then(|text| output.write(&text));
            say_checkpoint(&job, &written, args, has_said.swap(true, Ordering::Relaxed));
        });
    }

    let set = search.run()?;
    let at_infinity = limit.map(|limit| limit.search(args.threads, job.cancel()));
    job.end();

    // What is proved is in its files before anything is printed; what cannot be written does not
    // take the answer along.
    let written = match &output {
        Some(output) => output.write(&set.proved().file()?),
        None => Ok(()),
    };
    let written_at_infinity = match (&at_infinity, files_at_infinity) {
        (Some(at_infinity), Some(files)) => at_infinity.write(files),
        _ => Ok(()),
    };
    let json = || json(&set, at_infinity.as_ref());
    print_answer(args.json, json, || answer(&set, at_infinity.as_ref()))?;
    written.and(written_at_infinity)?;

    let is_complete_there = at_infinity.is_none_or(|there| there.is_complete());
    Ok(if set.is_complete() && is_complete_there {
        exit::DONE
    } else if job.is_cancelled() {
        exit::INTERRUPTED
    } else {
        exit::UNDECIDED
    })
}

/// Says once that there is a certificate to go on with, and each time that one is not written.
fn say_checkpoint(job: &Job, written: &Result<(), CliError>, args: &Args, has_said: bool) {
    match written {
        Err(e) => job.note(&format!("mceip: {e}; the search goes on")),
        Ok(()) if has_said || is_quiet() => {}
        Ok(()) => {
            let file = shell_word(&args.file);
            let certificate = args.certificate.as_deref().unwrap_or(Path::new("OUT"));
            let certificate = shell_word(certificate);
            let seconds = args.checkpoint;
            job.note(&format!(
                "what is proved so far is in {certificate}, written anew every {seconds} s, or \
                 where it takes long to check ten times as rarely as that takes; if this run ends \
                 early: mceip complete {file} --resume {certificate}"
            ));
        }
    }
}

/// Reads a certificate; errors name the file.
pub(super) fn read(path: &Path) -> Result<Certificate, CliError> {
    let source = text("the certificate", path)?;
    Certificate::from_json(&source).map_err(|source| CliError::file(path, source))
}

/// What is printed for programs.
fn json(set: &SolutionSet, at_infinity: Option<&AtInfinity>) -> Value {
    let mut report = set.to_json();
    if let Some(at_infinity) = at_infinity {
        report["at_infinity"] = at_infinity.json();
    }

    report
}

/// What is printed for people.
fn answer(set: &SolutionSet, at_infinity: Option<&AtInfinity>) -> String {
    let mut out = set.to_string();
    if let Some(at_infinity) = at_infinity {
        out += &at_infinity.text();
    }

    out
}
