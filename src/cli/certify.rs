//! `mceip certify`: somebody's floats to a certificate.

use super::common::{CliError, exit, load, print, text};
use super::output::Output;
use crate::candidate::read_report;
use crate::certify::{certificate, certify};
use crate::multistart::same;
use crate::reduction::reduce;
use std::path::PathBuf;

/// Arguments of `certify`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Solution report (mceip-solutions/1); of each solution only `value` and `x` are used. A
    /// `problem_sha256` in it must be the problem's.
    report: PathBuf,
    /// Write the certificate here instead of to stdout.
    #[arg(long)]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let output = args.out.as_ref().map(|path| Output::prepare("out", path, &[&args.file, &args.report])).transpose()?;
    let (digest, candidates) = read_report(&text("the report", &args.report)?)
        .map_err(|source| CliError::File { path: args.report.display().to_string(), source })?;
    if let Some(got) = digest.filter(|d| *d != problem.sha256()) {
        eprintln!("rejected: the report names another problem: expected {}, got {got}", problem.sha256());
        return Ok(exit::REJECTED);
    }
    let reduced = reduce(&problem)?;
    let expected = reduced.pencil.order();
    if let Some((solution, c)) = candidates.iter().enumerate().find(|(_, c)| c.x.len() != expected) {
        return Err(CliError::ReportLength { solution, expected, got: c.x.len() });
    }
    let mut claims: Vec<crate::certificate::Claim> = Vec::new();
    let mut failed = 0;
    for (k, candidate) in candidates.iter().enumerate() {
        match certify(&reduced.pencil, problem.window(), candidate) {
            Ok(claim) if claims.iter().any(|c| same(c, &claim)) => eprintln!("solution {k} (value {}): listed before", candidate.value),
            Ok(claim) => claims.push(claim),
            Err(reason) => {
                failed += 1;
                eprintln!("solution {k} (value {}): uncertified: {reason}", candidate.value);
            }
        }
    }
    eprintln!("{} distinct solutions certified, {failed} of {} uncertified", claims.len(), candidates.len());
    if claims.is_empty() {
        return Ok(exit::UNDECIDED);
    }
    let json = certificate(&problem, claims).to_json();
    match output {
        Some(output) => output.write(&json)?,
        None => print(&format!("{json}\n"))?,
    }
    Ok(if failed == 0 { exit::DONE } else { exit::UNDECIDED })
}
