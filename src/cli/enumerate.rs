//! `mceip enumerate`: the oracle, or the screened enumerator; checkpoints and parts.

use super::common::{CliError, exit, interrupt_flag, load, print, progress_bar};
use super::output::Output;
use super::record::{CHECKPOINT, Engine, PART, Record, refused};
use crate::model::file::write_problem;
use crate::model::{Pencil, Problem};
use crate::oracle::{self, Enumeration, OracleError};
use crate::reduction::{Reduced, reduce};
use crate::report::{Listed, Report, solutions_json, solutions_text};
use crate::search::screen::{MAX_BITS, Screen, ScreenError, coefficient_bits, examine_one};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// Arguments of `enumerate`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Use the screened enumerator: the same answer, most supports discarded with proof.
    #[arg(long)]
    screened: bool,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Resume from this file if it exists, and keep it up to date.
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Examine only the i-th of n equal ranges of supports and write a part for `merge`.
    #[arg(long, value_name = "i/n", allow_hyphen_values = true)]
    shard: Option<String>,
    /// Write the part to this file instead of to stdout.
    #[arg(long, value_name = "PART", requires = "shard")]
    out: Option<PathBuf>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

/// How often a checkpoint is brought up to date.
const SAVE_EVERY: Duration = Duration::from_secs(5);

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, args.window.as_deref())?;
    let reduced = reduce(&problem)?;
    let engine = if args.screened { Engine::Screened } else { Engine::Plain };
    let screen = within_limits(engine, &reduced.pencil, &problem)?;
    let supports = 1u64 << reduced.pencil.slip().len();
    let range = args.shard.as_deref().map_or(Ok([0, supports]), |s| shard_range(s, supports))?;
    let out = args.out.as_ref().map(|path| Output::prepare("out", path, &[&args.file])).transpose()?;
    let mut record = Record::new(&problem, engine, supports, range);
    let mut found = Enumeration { supports_total: supports, ..Enumeration::default() };
    if let Some(path) = &args.checkpoint {
        if path.exists() {
            let old = Record::read(path, CHECKPOINT)?;
            old.require_same(&record, true).map_err(|e| refused(path, e))?;
            found = old.recompute(&reduced.pencil, problem.window()).map_err(|e| refused(path, e))?;
            record = old;
            eprintln!("resumed from {}: {} of {} supports done", path.display(), record.done - range[0], range[1] - range[0]);
        }
        drop(Output::prepare("checkpoint", path, &[&args.file])?); // writable, before the work
    }
    work(args, &problem, &reduced.pencil, screen.as_ref(), &mut record, &mut found)?;
    if args.shard.is_some() {
        return write_part(out, &problem, record);
    }
    found.describe(&reduced.pencil, problem.window());
    print(&report(&problem, &reduced, &found, &record, args.json))?;
    Ok(code(&found))
}

/// Refuses what would never end, before the work; prepares the screened engine.
fn within_limits<'a>(engine: Engine, pencil: &'a Pencil, problem: &'a Problem) -> Result<Option<Screen<'a>>, CliError> {
    if engine == Engine::Screened {
        return Ok(Some(Screen::new(pencil, problem.window())?));
    }
    let counts = [("slip variables", oracle::MAX_SLIP, pencil.slip().len()), ("free variables", oracle::MAX_FREE, pencil.free().len())];
    if let Some((what, limit, got)) = counts.into_iter().find(|(_, limit, got)| got > limit) {
        return Err(OracleError::TooLarge { what, limit, got }.into());
    }
    let got = coefficient_bits(pencil);
    if got > MAX_BITS {
        return Err(ScreenError::TooLarge { what: "bits of a determinant's coefficients", limit: MAX_BITS, got }.into());
    }
    Ok(None)
}

/// The range of supports of `i/n`, 1 <= i <= n <= supports.
fn shard_range(text: &str, supports: u64) -> Result<[u64; 2], CliError> {
    let bad = || CliError::Option { option: "shard", expected: "i/n with 1 <= i <= n <= 2^n_s", got: text.chars().take(60).collect() };
    let (i, n) = text.split_once('/').ok_or_else(bad)?;
    let (i, n): (u64, u64) = (i.parse().map_err(|_| bad())?, n.parse().map_err(|_| bad())?);
    if i < 1 || i > n || n > supports {
        return Err(bad());
    }
    let cut = |k: u64| (u128::from(supports) * u128::from(k) / u128::from(n)) as u64; // at most `supports`
    Ok([cut(i - 1), cut(i)])
}

/// Examines what the record lacks; both grow together. An interrupt ends it early.
fn work(
    args: &Args,
    problem: &Problem,
    pencil: &Pencil,
    screen: Option<&Screen<'_>>,
    record: &mut Record,
    found: &mut Enumeration,
) -> Result<(), CliError> {
    let stop = interrupt_flag();
    let bar = progress_bar(record.range[1] - record.range[0], "supports");
    bar.set_position(record.done - record.range[0]);
    bar.reset_eta();
    let mut saved = Instant::now();
    let mut keep = |record: &Record, now: bool| -> Result<(), CliError> {
        bar.set_position(record.done - record.range[0]);
        match &args.checkpoint {
            Some(path) if now || saved.elapsed() > SAVE_EVERY => {
                record.save("checkpoint", path, &[&args.file])?;
                saved = Instant::now();
                Ok(())
            }
            _ => Ok(()),
        }
    };
    let before = record.clone();
    match screen {
        None => {
            for mask in before.done..before.range[1] {
                if stop.load(Ordering::Relaxed) {
                    break;
                }
                if examine_one(pencil, problem.window(), mask, found) {
                    record.holders.push(mask);
                }
                record.done = mask + 1;
                keep(record, false)?;
            }
        }
        Some(screen) => {
            let mut failed = None;
            let part = screen.run(before.done..before.range[1], |part| {
                *record = before.followed_by(part);
                failed = keep(record, false).err();
                if failed.is_some() || stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            })?;
            if let Some(e) = failed {
                return Err(e);
            }
            *record = before.followed_by(&part);
            found.solutions.extend(part.enumeration.solutions);
            found.wide.extend(part.enumeration.wide);
            found.continua.extend(part.enumeration.continua);
        }
    }
    found.supports_done = record.done - record.range[0];
    keep(record, true)?;
    bar.finish_and_clear();
    Ok(())
}

/// Writes the part; one that was interrupted says how far it came, and `merge` will refuse it.
fn write_part(out: Option<Output>, problem: &Problem, mut record: Record) -> Result<u8, CliError> {
    record.format = PART.into();
    // Our own writer's output is JSON.
    record.problem = serde_json::from_str(&write_problem(problem)).ok();
    match out {
        Some(out) => out.write(&record.to_json())?,
        None => print(&record.to_json())?,
    }
    Ok(if record.is_finished() { exit::DONE } else { exit::INTERRUPTED })
}

/// What `enumerate` prints for an enumeration; `merge` prints the same.
pub(super) fn report(problem: &Problem, reduced: &Reduced, found: &Enumeration, record: &Record, json: bool) -> String {
    let how = match record.statistics {
        None => "every one by exact arithmetic".to_string(),
        Some(s) => s.to_string(),
    };
    let engine = record.engine.word();
    let evidence = match (found.is_finished(), found.is_complete_list()) {
        (true, true) => format!("complete, by the {engine} enumeration of {} supports: {how}", found.supports_total),
        (true, false) => format!(
            "all {} supports examined by the {engine} enumeration: {how}; what is named without a description is left open",
            found.supports_total
        ),
        (false, _) => {
            format!("the {engine} enumeration was interrupted after {} of {} supports: {how}", found.supports_done, found.supports_total)
        }
    };
    let solutions = found.solutions.iter().map(|s| Listed::of_solution(problem, reduced, s)).collect();
    let complete = found.is_complete_list();
    let report = Report { problem, reduced, solutions, complete, evidence, enumeration: Some(found) };
    if json { format!("{}\n", solutions_json(&report)) } else { solutions_text(&report) }
}

/// The exit code of an enumeration.
pub(super) fn code(found: &Enumeration) -> u8 {
    match (found.is_finished(), found.is_complete_list()) {
        (false, _) => exit::INTERRUPTED,
        (true, true) => exit::DONE,
        (true, false) => exit::UNDECIDED, // what is left open has been named
    }
}
