//! `mceip merge`: the parts of an enumeration or of a complete search put together, or refused.

use super::common::{CliError, print, text};
use super::enumerate::{code, report};
use super::merge_covers;
use super::record::{PART, Record, RecordError, refused, window_of};
use crate::certificate::CERTIFICATE_FORMAT;
use crate::model::Problem;
use crate::model::file::{from_json, read_problem};
use crate::reduction::reduce;
use crate::search::screen::Statistics;
use std::path::{Path, PathBuf};

/// Arguments of `merge`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Parts in any order: of an enumeration (mceip-part/1) that cover every support once (what they say of supports
    /// without a solution is not examined again), or of a complete search (mceip-certificate/1, from `complete --shard`) that cover every piece.
    #[arg(required = true)]
    pub(super) parts: Vec<PathBuf>,
    /// The problem file; needed for certificates, which do not hold it.
    #[arg(long, value_name = "FILE")]
    pub(super) problem: Option<PathBuf>,
    /// The window of the certificates, where it is not the problem file's.
    #[arg(long, allow_hyphen_values = true)]
    pub(super) window: Option<String>,
    /// Write the merged certificate to this file.
    #[arg(long, value_name = "OUT")]
    pub(super) certificate: Option<PathBuf>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    pub(super) json: bool,
}

/// Why a set of parts is no whole.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub(super) enum MergeError {
    /// A part that was interrupted.
    #[error("{path}: expected a finished part, got {done} of {wanted} supports")]
    Unfinished {
        /// The part.
        path: String,
        /// Supports examined.
        done: u64,
        /// Supports wanted.
        wanted: u64,
    },
    /// Supports covered by two parts.
    #[error("{first} and {second} both cover supports {start}..{end}")]
    Overlap {
        /// The part that begins first.
        first: String,
        /// The other.
        second: String,
        /// First support covered twice.
        start: u64,
        /// One past the last.
        end: u64,
    },
    /// Supports covered by no part.
    #[error("no part covers supports {start}..{end} of {supports}")]
    Gap {
        /// First support missing.
        start: u64,
        /// One past the last.
        end: u64,
        /// Supports of the problem.
        supports: u64,
    },
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    // Each kind of part has its own way of being whole; the first names the kind, and the reader of
    // that kind refuses every other.
    match format_of(&args.parts[0])?.as_str() {
        PART => merge_enumeration(args),
        CERTIFICATE_FORMAT => merge_covers::run(args),
        other => Err(refused(
            &args.parts[0],
            RecordError::Mismatch { what: "format", expected: PART.into(), got: other.chars().take(60).collect() },
        )),
    }
}

/// The `format` field of a file, empty where there is none.
fn format_of(path: &Path) -> Result<String, CliError> {
    #[derive(serde::Deserialize)]
    struct Header {
        format: Option<String>,
    }
    let content = text("the part", path)?;
    let header: Header = from_json(&content).map_err(|e| refused(path, e.into()))?;
    Ok(header.format.unwrap_or_default())
}

fn merge_enumeration(args: &Args) -> Result<u8, CliError> {
    // A part holds its problem and window, and an enumeration has no certificate.
    let given = [("problem", args.problem.is_some()), ("window", args.window.is_some()), ("certificate", args.certificate.is_some())];
    if let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
        return Err(CliError::Option { option, expected: "it with parts of format mceip-certificate/1 only", got: PART.into() });
    }
    let mut parts = args.parts.iter().map(|path| Ok((path, Record::read(path, PART)?))).collect::<Result<Vec<_>, CliError>>()?;
    let (first_path, first) = (parts[0].0, parts[0].1.clone());
    let problem = problem_of(&first).map_err(|e| refused(first_path, e))?;
    for (path, part) in &parts {
        part.require_same(&first, false).map_err(|e| refused(path, e))?;
        problem_of(part).map_err(|e| refused(path, e))?;
    }
    parts.sort_by_key(|(_, p)| p.range);
    require_whole(&parts)?;
    let reduced = reduce(&problem)?;
    let mut whole = Record { range: [0, first.supports], done: first.supports, holders: Vec::new(), ..first };
    whole.statistics = whole.statistics.map(|_| Statistics::default());
    for (_, part) in &parts {
        whole.holders.extend(&part.holders);
        if let (Some(sum), Some(more)) = (&mut whole.statistics, part.statistics) {
            *sum += more;
        }
    }
    if 1u64.checked_shl(reduced.pencil.slip().len() as u32) != Some(whole.supports) {
        return Err(refused(first_path, RecordError::Damaged { what: "its supports are not those of its problem" }));
    }
    let mut found = whole.recompute(&reduced.pencil, problem.window()).map_err(|e| blame(&parts, e))?;
    found.describe(&reduced.pencil, problem.window());
    let text = report(&problem, &reduced, &found, &whole, args.json);
    print(&with_not_verified(text, &whole, args.json))?;
    Ok(code(&found))
}

/// Adds to a report on merged parts what rests on the parts alone: a line, or the field `not_verified`.
fn with_not_verified(report: String, whole: &Record, is_json: bool) -> String {
    let believed = whole.supports - whole.holders.len() as u64;
    let note = format!(
        "that {believed} of {} supports hold no solution is what the parts say; merge has examined the others alone",
        whole.supports
    );
    if !is_json {
        return format!("{report}NOT VERIFIED: {note}\n");
    }
    match serde_json::from_str::<serde_json::Value>(&report) {
        Ok(mut value) => {
            value["not_verified"] = note.into();
            format!("{value}\n")
        }
        Err(_) => report, // our own report is JSON
    }
}

/// Each support in exactly one part; the parts are sorted by range.
fn require_whole(parts: &[(&PathBuf, Record)]) -> Result<(), MergeError> {
    let name = |path: &PathBuf| path.display().to_string();
    if let Some((path, p)) = parts.iter().find(|(_, p)| !p.is_finished()) {
        return Err(MergeError::Unfinished { path: name(path), done: p.done - p.range[0], wanted: p.range[1] - p.range[0] });
    }
    let supports = parts[0].1.supports;
    let mut covered = 0;
    for (k, (path, part)) in parts.iter().enumerate() {
        let [start, end] = part.range;
        if start > covered {
            return Err(MergeError::Gap { start: covered, end: start, supports });
        }
        if start < covered {
            let first = name(parts[k - 1].0); // covered > 0: there is one before
            return Err(MergeError::Overlap { first, second: name(path), start, end: end.min(covered) });
        }
        covered = end;
    }
    if covered < supports { Err(MergeError::Gap { start: covered, end: supports, supports }) } else { Ok(()) }
}

/// The problem inside a part, in the part's window, if it is the one that the digest names.
fn problem_of(part: &Record) -> Result<Problem, RecordError> {
    let inside = part.problem.as_ref().map(ToString::to_string).unwrap_or_default();
    // Parts hold their matrices inline: no folder is looked into.
    let problem = read_problem(&inside, Path::new(""))?.with_window(window_of(part)?);
    let (expected, got) = (part.problem_sha256.clone(), problem.sha256());
    if expected == got { Ok(problem) } else { Err(RecordError::Mismatch { what: "problem_sha256", expected, got }) }
}

/// Names the part that listed a support in vain.
fn blame(parts: &[(&PathBuf, Record)], e: RecordError) -> CliError {
    let at_fault = parts.iter().find(|(_, p)| matches!(&e, RecordError::EmptyHolder { support } if p.holders.contains(support)));
    refused(at_fault.map_or(parts[0].0, |(path, _)| *path), e)
}
