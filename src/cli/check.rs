//! `mceip check`: a certificate against a problem, one verdict.

use super::common::{CliError, exit, load, print, text};
use super::complete::solutions_text;
use crate::certificate::Certificate;
use crate::check::check;
use crate::exact::enclosing_decimals;
use std::path::PathBuf;

/// Arguments of `check`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Certificate (mceip-certificate/1).
    certificate: PathBuf,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let certificate = Certificate::from_json(&text("the certificate", &args.certificate)?)
        .map_err(|source| CliError::File { path: args.certificate.display().to_string(), source })?;
    match check(&problem, &certificate) {
        Ok(accepted) => {
            let mut out = String::new();
            for c in &accepted.claims {
                let (lo, hi) = enclosing_decimals(&c.value, 17);
                out += &format!("solution: {} in [{lo}, {hi}], slip {:?}\n", problem.unknown().word(), c.support);
            }
            let (w, n) = (&certificate.window, accepted.claims.len());
            let max = w.max().map_or_else(|| "infinity)".into(), |m| format!("{m}]"));
            let within = format!("for problem {} in [{}, {max}", problem.sha256(), w.min());
            let Some(cover) = &accepted.cover else {
                print(&format!("{out}ACCEPTED: {n} claim(s) proved {within}\n"))?;
                return Ok(exit::DONE);
            };
            if cover.solutions.is_empty() && cover.open.is_empty() {
                let (word, leaves) = (problem.unknown().word(), cover.leaves);
                print(&format!(
                    "ABSENT in [{}, {max}: no solution ({word}, problem {}, {leaves} leaves accepted)\n",
                    w.min(),
                    problem.sha256()
                ))?;
                return Ok(exit::DONE);
            }
            // The solutions of a cover include those claimed beside it.
            let windowed = problem.clone().with_window(w.clone());
            let verdict = if cover.open.is_empty() { "ACCEPTED" } else { "ACCEPTED as undecided" };
            print(&format!("{}{verdict} {within}\n", solutions_text(&windowed, cover)))?;
            Ok(if cover.open.is_empty() { exit::DONE } else { exit::UNDECIDED })
        }
        Err(rejected) => {
            print(&format!("REJECTED: {rejected}\n"))?;
            Ok(exit::REJECTED)
        }
    }
}
