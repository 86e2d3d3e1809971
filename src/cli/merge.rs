//! `mceip merge --problem FILE CERTIFICATE...`: the parts of a complete search put together, or
//! refused.

use super::common::{CliError, exit, load, print};
use super::complete::{read, report_json, solutions_text};
use super::output::Output;
use crate::certificate::Certificate;
use crate::check::check;
use crate::model::Problem;
use crate::run::{Cancel, Watch};
use crate::search::complete::{CompleteError, Options, merge, resume};
use std::path::{Path, PathBuf};

/// Arguments of `merge`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Parts of a complete search in any order (mceip-certificate/1, from `complete --shard`) that
    /// cover every piece.
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// The problem file; certificates do not hold it.
    #[arg(long, value_name = "FILE")]
    problem: PathBuf,
    /// The window of the certificates, where it is not the problem file's.
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Write the merged certificate to this file.
    #[arg(long, value_name = "OUT")]
    certificate: Option<PathBuf>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let file = args.problem.as_path();
    let problem = load(file, args.window.as_deref())?;
    let parts = args
        .parts
        .iter()
        .map(|path| read(path))
        .collect::<Result<Vec<_>, _>>()?;
    let inputs: Vec<&Path> = std::iter::once(file)
        .chain(args.parts.iter().map(PathBuf::as_path))
        .collect();
    let output = args
        .certificate
        .as_ref()
        .map(|path| Output::prepare("certificate", path, &inputs))
        .transpose()?;
    let (certificate, cover) =
        merge(&problem, &parts).map_err(|e| blame(&problem, &args.parts, &parts, e))?;
    let out = if args.json {
        to_json(&problem, &certificate)?
    } else {
        solutions_text(&problem, &cover)
    };
    print(&out)?;
    if let Some(output) = output {
        output.write(&certificate.to_json())?;
    }
    Ok(if cover.open.is_empty() {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}

/// The solutions with their x: a search that goes on with the merged certificate and is stopped at
/// once.
fn to_json(problem: &Problem, certificate: &Certificate) -> Result<String, CliError> {
    let completed = resume(
        problem,
        certificate,
        &Options::default(),
        &Watch::silent(&Cancel::requested()),
    )?;
    Ok(format!("{}\n", report_json(problem, &completed)?))
}

/// Names the part at fault, where one is.
fn blame(
    problem: &Problem,
    paths: &[PathBuf],
    parts: &[Certificate],
    e: CompleteError,
) -> CliError {
    let at_fault = match &e {
        CompleteError::OtherProblem { .. } => parts
            .iter()
            .position(|p| p.problem_sha256 != problem.sha256()),
        CompleteError::OtherWindow { .. } => {
            parts.iter().position(|p| p.window != *problem.window())
        }
        CompleteError::NoCompleteSet => parts.iter().position(|p| p.complete_set.is_none()),
        CompleteError::OtherPieces { part } => Some(*part),
        CompleteError::Rejected(_) => parts.iter().position(|p| check(problem, p).is_err()),
        _ => None,
    };
    match at_fault.and_then(|k| paths.get(k)) {
        Some(path) => CliError::Part {
            path: path.display().to_string(),
            source: e,
        },
        None => CliError::Complete(e),
    }
}
