//! `mceip merge --problem FILE CERTIFICATE...`: the parts of a complete search put together, or
//! refused.

use super::common::{CliError, exit, load, print};
use super::complete::{read, report_json, solutions_text};
use super::output::Output;
use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_engine::run::{Cancel, Watch};
use mceip_engine::search::complete::{CompleteError, Completed, Options, merge, resume};
use mceip_model::Problem;
use std::path::PathBuf;

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

/// Merges the parts, prints what they prove and writes the certificate.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let file = args.problem.as_path();
    let problem = load(file, args.window.as_deref())?;
    let parts = args.parts.iter().map(|path| read(path));
    let parts = parts.collect::<Result<Vec<_>, _>>()?;

    let mut inputs = vec![file];
    inputs.extend(args.parts.iter().map(PathBuf::as_path));
    let output = Output::prepare_if("certificate", args.certificate.as_deref(), &inputs)?;

    let merged = merge(&problem, &parts);
    let proved = merged.map_err(|e| blame(&problem, &args.parts, &parts, e))?;
    if let Some(output) = output {
        output.write(&proved.file()?)?;
    }

    let cover = proved.accepted().cover.as_ref();
    let cover = cover.ok_or(CompleteError::NoCompleteSet)?;
    let text = if args.json {
        let completed = with_x(&problem, proved.certificate())?;
        format!("{}\n", report_json(&problem, &completed)?)
    } else {
        solutions_text(&problem, cover)
    };
    print(&text)?;

    Ok(if cover.open.is_empty() {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}

/// The solutions with their x: a search that goes on with the merged certificate and is stopped at
/// once.
fn with_x(problem: &Problem, certificate: &Certificate) -> Result<Completed, CliError> {
    let cancel = Cancel::requested();
    let watch = Watch::silent(&cancel);
    Ok(resume(problem, certificate, &Options::default(), &watch)?)
}

/// Names the part at fault, where one is.
fn blame(
    problem: &Problem,
    paths: &[PathBuf],
    parts: &[Certificate],
    e: CompleteError,
) -> CliError {
    let mut certificates = parts.iter();
    let at_fault = match &e {
        CompleteError::OtherProblem { .. } => {
            certificates.position(|part| part.problem_sha256 != problem.sha256())
        }
        CompleteError::OtherWindow { .. } => {
            certificates.position(|part| part.window != *problem.window())
        }
        CompleteError::NoCompleteSet => certificates.position(|part| part.complete_set.is_none()),
        CompleteError::OtherPieces { part } => Some(*part),
        CompleteError::Rejected(_) => certificates.position(|part| check(problem, part).is_err()),
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
