//! `mceip complete`: all solutions in a window, with a proof that there are no others.
//!
//! The certificate can be searched in parts (`--shard`, joined by `mceip merge`) and gone on with
//! (`--resume`). What is printed is what the checker has proved of it.

use super::common::{CliError, exit, part, print, require_count, require_threads, seconds, text};
use super::infinity::{AtInfinity, Files};
use super::job::{CHECKPOINT, Job, is_quiet};
use super::output::Output;
use super::question::{Question, load_question};
use mceip_check::certificate::Certificate;
use mceip_check::{AcceptedCover, OpenRegion, SolutionFamily};
use mceip_engine::certify::Certifier;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json};
use mceip_engine::run::{Keeper, Kept, Watch};
use mceip_engine::search::complete::{Completed, Options, Shard, complete, resume};
use mceip_exact::enclosing_decimals;
use mceip_model::reduction::reduce;
use mceip_model::{Body, Problem};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Arguments of `complete`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Write the certificate to this file; after an interrupt it holds what is left open, and so it
    /// does every minute while the search goes on.
    #[arg(long, value_name = "OUT")]
    certificate: Option<PathBuf>,
    /// Seconds between two writes of the certificate while the search goes on.
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
    #[arg(long, default_value_t = Options::default().pieces)]
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

/// Families and open regions printed in full.
const SHOWN: usize = 20;

/// Searches, prints what is proved and writes the certificate.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = match load_question(&args.file, args.window.as_deref())? {
        Question::Problem(problem) => *problem,
        Question::NoSolution(answer) => {
            return answer.print(args.json, args.certificate.as_deref());
        }
    };
    let shard = match &args.shard {
        Some(given) => {
            let (index, count) = part("shard", given)?;
            Some(Shard { index, count })
        }
        None => None,
    };
    require_threads(args.threads)?;
    refuse_useless(args, &problem)?;
    let every = seconds("checkpoint", args.checkpoint)?;

    let earlier = args.resume.as_deref().map(read).transpose()?;
    let path = args.certificate.as_deref();
    let output = Output::prepare_if("certificate", path, &[&args.file])?;
    let files_at_infinity = match path {
        Some(path) if args.infinity => Some(Files::prepare(path, &args.file)?),
        _ => None,
    };

    let options = Options {
        pieces: args.pieces,
        threads: args.threads,
        shard,
        ..Options::default()
    };
    let job = Job::begin("searching");
    let kept_in = output.as_ref().filter(|output| !output.is_device());
    let has_said = AtomicBool::new(false);
    let keep = |kept: &Kept<'_>| {
        if let Some(output) = kept_in {
            let written = output.write(kept.certificate);
            say_checkpoint(&job, &written, args, has_said.swap(true, Ordering::Relaxed));
        }
    };
    let keeper = kept_in.map(|_| Keeper::new(every, &keep));
    let completed = job.watched(|watch| {
        let watch = watch.kept_by(keeper);
        match &earlier {
            None => complete(&problem, &options, &watch),
            Some(certificate) => resume(&problem, certificate, &options, &watch),
        }
    })?;
    let at_infinity = if args.infinity {
        let watch = Watch::silent(job.cancel());
        Some(AtInfinity::search(&problem, &options, &watch)?)
    } else {
        None
    };
    job.end();

    // What is proved is in its files before anything is printed.
    if let Some(output) = &output {
        output.write(&completed.proved.file()?)?;
    }
    if let (Some(at_infinity), Some(files)) = (&at_infinity, files_at_infinity) {
        at_infinity.write(files)?;
    }
    print(&answer(args, &problem, &completed, at_infinity.as_ref())?)?;

    let is_complete_there = at_infinity.is_none_or(|there| there.is_complete());
    Ok(if completed.is_complete() && is_complete_there {
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
            let file = args.file.display();
            let certificate = args.certificate.as_deref().unwrap_or(Path::new("OUT"));
            let certificate = certificate.display();
            let seconds = args.checkpoint;
            job.note(&format!(
                "what is proved is in {certificate}, at most {seconds} s old; if this run ends \
                 early: mceip complete {file} --resume {certificate}"
            ));
        }
    }
}

/// Refuses a number of pieces that helps nobody, and --infinity for a window that ends.
fn refuse_useless(args: &Args, problem: &Problem) -> Result<(), CliError> {
    require_count("pieces", args.pieces as u64, 1..=MAX_PIECES)?;
    if args.infinity
        && let Body::System(system) = problem.body()
    {
        system.require_no_zero()?; // the reversed problem is a pencil, of which (9) says nothing
    }

    if args.infinity && problem.window().max().is_some() {
        let expected = "a window without upper end";
        return Err(CliError::option("infinity", expected, "one that ends"));
    }

    Ok(())
}

/// Reads a certificate; errors name the file.
pub(super) fn read(path: &Path) -> Result<Certificate, CliError> {
    let source = text("the certificate", path)?;
    Certificate::from_json(&source).map_err(|source| CliError::file(path, source))
}

/// What is printed.
fn answer(
    args: &Args,
    problem: &Problem,
    completed: &Completed,
    at_infinity: Option<&AtInfinity>,
) -> Result<String, CliError> {
    if args.json {
        let mut report = report_json(problem, completed)?;
        if let Some(at_infinity) = at_infinity {
            report["at_infinity"] = at_infinity.json();
        }

        return Ok(format!("{report}\n"));
    }

    let mut out = solutions_text(problem, &completed.cover);
    if let Some(at_infinity) = at_infinity {
        out += &at_infinity.text();
    }

    Ok(out)
}

/// What a cover has proved, for people.
pub(super) fn solutions_text(problem: &Problem, cover: &AcceptedCover) -> String {
    let word = problem.unknown().word();
    let mut out = String::new();
    for solution in &cover.solutions {
        let (lo, hi) = enclosing_decimals(&solution.value, 15);
        let support = &solution.support;
        out += &format!("solution: {word} in [{lo}, {hi}], slip {support:?}\n");
    }

    for family in cover.families.iter().take(SHOWN) {
        out += &format!("family: {}\n", family_text(word, family));
    }

    let more = cover.families.len().saturating_sub(SHOWN);
    if more > 0 {
        out += &format!("family: {more} more (see the certificate)\n");
    }

    for region in cover.open.iter().take(SHOWN) {
        out += &format!("open: {}\n", open_text(word, region));
    }

    let more = cover.open.len().saturating_sub(SHOWN);
    if more > 0 {
        out += &format!("open: {more} more regions (see the certificate)\n");
    }

    out + &verdict_text(problem, cover)
}

/// The last line: is the set complete, and how large is it?
fn verdict_text(problem: &Problem, cover: &AcceptedCover) -> String {
    let window = problem.window();
    let leaves = cover.leaves;
    let open = cover.open.len();
    let count = count_text(cover);
    if open > 0 {
        return format!("UNDECIDED: {count} proved in {window}, {open} regions open\n");
    }

    let is_empty = cover.solutions.is_empty() && cover.families.is_empty();
    let set = if is_empty {
        format!("no solution in {window}")
    } else {
        format!("{count} in {window}, and no other")
    };

    format!("COMPLETE: {set}; {leaves} leaves, accepted by the checker\n")
}

/// "2 solutions and 1 families of them".
fn count_text(cover: &AcceptedCover) -> String {
    let mut count = match cover.solutions.len() {
        1 => "1 solution".into(),
        n => format!("{n} solutions"),
    };
    if !cover.families.is_empty() {
        count += &format!(" and {} families of them", cover.families.len());
    }

    count
}

fn open_text(word: &str, region: &OpenRegion) -> String {
    let max = match &region.max {
        Some(max) => max.to_string(),
        None => "infinity".into(),
    };

    format!(
        "{word} in [{}, {max}], moving {:?}, undecided {:?}",
        region.min, region.moving, region.undecided
    )
}

fn family_text(word: &str, family: &SolutionFamily) -> String {
    let (lo, hi) = enclosing_decimals(&family.from, 15);
    let values = match &family.to {
        _ if family.is_point => format!("{word} in [{lo}, {hi}] (one value)"),
        None => format!("every {word} above a value in [{lo}, {hi}]"),
        Some(to) => {
            let (a, b) = enclosing_decimals(to, 15);
            format!("every {word} between values in [{lo}, {hi}] and [{a}, {b}]")
        }
    };

    let how_many = if family.is_alone {
        "one solution at each"
    } else {
        "a cone of solutions"
    };

    format!("{values}, slip {:?}, {how_many}", family.support)
}

/// The complete set as `mceip-solutions/1`.
pub(super) fn report_json(problem: &Problem, completed: &Completed) -> Result<Value, CliError> {
    let reduced = reduce(problem)?;
    let certifier = Certifier::new(problem, &reduced.pencil);
    let mut solutions = Vec::new();
    for (proved, x) in completed.solutions() {
        solutions.push(Listed::of_cover(problem, &reduced, &certifier, proved, x));
    }

    let cover = &completed.cover;
    let evidence = format!(
        "certificate of a complete set, {} leaves, {} open, accepted by the checker",
        cover.leaves,
        cover.open.len()
    );

    Ok(solutions_json(&Report {
        problem,
        reduced: &reduced,
        solutions,
        claim: Claimed::of_cover(cover),
        evidence,
        enumeration: None,
        cover: Some(cover),
    }))
}
