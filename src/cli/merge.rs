//! `mceip merge --problem FILE CERTIFICATE...`: the parts of a complete search put together, or
//! refused.

use super::common::{CliError, exit, load, print_answer};
use super::complete::read;
use super::output::Output;
use crate::{Error, Problem, check};
use mceip_check::certificate::Certificate;
use mceip_engine::search::complete::CompleteError;
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
    let problem = Problem::from(load(file, args.window.as_deref())?);
    let parts = args.parts.iter().map(|path| read(path));
    let parts = parts.collect::<Result<Vec<_>, _>>()?;

    let mut inputs = vec![file];
    inputs.extend(args.parts.iter().map(PathBuf::as_path));
    let output = Output::prepare_if("certificate", args.certificate.as_deref(), &inputs)?;

    let set = problem.merge(&parts);
    let set = set.map_err(|e| blame(&problem, &args.parts, &parts, e))?;
    if let Some(output) = output {
        output.write(&set.proved().file()?)?;
    }

    print_answer(args.json, || set.to_json(), || set.to_string())?;

    Ok(if set.is_complete() {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}

/// Names the part at fault, where one is.
fn blame(problem: &Problem, paths: &[PathBuf], parts: &[Certificate], e: Error) -> CliError {
    let Error::Complete(e) = e else {
        return e.into();
    };

    let mut certificates = parts.iter();
    let at_fault = match &e {
        CompleteError::OtherProblem { .. } => {
            certificates.position(|part| part.problem_sha256 != problem.sha256())
        }
        CompleteError::OtherWindow { .. } => {
            certificates.position(|part| part.window != *problem.as_model().window())
        }
        CompleteError::NoCompleteSet => certificates.position(|part| part.complete_set.is_none()),
        CompleteError::OtherPieces { part } => Some(*part),
        CompleteError::Rejected(_) => certificates.position(|part| check(problem, part).is_err()),
        _ => None,
    };

    match at_fault.and_then(|k| paths.get(k)) {
        Some(path) => CliError::other_file(path, e),
        None => CliError::Complete(e),
    }
}
