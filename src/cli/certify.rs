//! `mceip certify`: somebody's floats to a certificate.

use super::common::{CliError, exit, load, print, text, write_whole};
use crate::candidate::read_report;
use crate::certify::{certificate, certify};
use crate::reduction::reduce;
use std::path::PathBuf;

/// Arguments of `certify`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Solution report (mceip-solutions/1); only `value` and `x` of each solution are used.
    report: PathBuf,
    /// Write the certificate here instead of to stdout.
    #[arg(long)]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let (digest, candidates) = read_report(&text("the report", &args.report)?)
        .map_err(|source| CliError::File { path: args.report.display().to_string(), source })?;
    if let Some(got) = digest.filter(|d| *d != problem.sha256()) {
        eprintln!("rejected: the report names another problem: expected {}, got {got}", problem.sha256());
        return Ok(exit::REJECTED);
    }
    let reduced = reduce(&problem)?;
    let mut claims = Vec::new();
    let mut failed = 0;
    for (k, candidate) in candidates.iter().enumerate() {
        match certify(&reduced.pencil, problem.window(), candidate) {
            Ok(claim) => claims.push(claim),
            Err(reason) => {
                failed += 1;
                eprintln!("solution {k} (value {}): uncertified: {reason}", candidate.value);
            }
        }
    }
    eprintln!("{} of {} solutions certified", claims.len(), candidates.len());
    if claims.is_empty() {
        return Ok(exit::UNDECIDED);
    }
    let json = certificate(&problem, claims).to_json();
    match &args.out {
        Some(path) => write_whole(path, &json)?,
        None => print(&format!("{json}\n")),
    }
    Ok(if failed == 0 { exit::DONE } else { exit::UNDECIDED })
}
