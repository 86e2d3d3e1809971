//! `mceip check`: a certificate or somebody's solutions against a problem, one verdict.

pub(super) mod plain;

use super::common::{CliError, exit, load, print, text};
use super::complete::solutions_text;
use crate::candidate::SOLUTIONS_FORMAT;
use crate::certificate::Certificate;
use crate::check::check;
use crate::exact::enclosing_decimals;
use crate::foreign::{ForeignError, ForeignReport, Verdict, judge};
use crate::lcp::MCP_FORMAT;
use crate::model::Problem;
use crate::model::file::require_format;
use crate::reduction::reduce;
use std::path::{Path, PathBuf};

/// Arguments of `check`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1), or a plain LCP or MCP (mceip-mcp/1).
    file: PathBuf,
    /// Certificate (mceip-certificate/1), or somebody's solutions (mceip-solutions/1): each of those
    /// is certified and checked, or refuted. Of a plain problem: its solution file (mceip-mcp-solution/1).
    certificate: PathBuf,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if args.file.as_path() == Path::new("-") && args.certificate.as_path() == Path::new("-") {
        return Err(CliError::Option { option: "certificate", expected: "only one of the two files to be stdin", got: "-".into() });
    }
    let problem = text("the problem", &args.file)?;
    if require_format(&problem, MCP_FORMAT).is_ok() {
        return plain::verdict(&args.file, &problem, &args.certificate);
    }
    let problem = load(&args.file, None)?;
    let source = text("the certificate", &args.certificate)?;
    if require_format(&source, SOLUTIONS_FORMAT).is_ok() {
        return foreign(args, &problem, &source);
    }
    let certificate =
        Certificate::from_json(&source).map_err(|source| CliError::File { path: args.certificate.display().to_string(), source })?;
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
            if cover.proves_absence() {
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

/// One line per solution of a foreign report; the exit code is that of the worst.
fn foreign(args: &Args, problem: &Problem, source: &str) -> Result<u8, CliError> {
    let reduced = reduce(problem)?;
    let report = match ForeignReport::read(source, problem, &reduced) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => {
            print(&format!("REJECTED: {e}\n"))?;
            return Ok(exit::REJECTED);
        }
        Err(source) => return Err(CliError::Foreign { path: args.certificate.display().to_string(), source }),
    };
    let (mut out, mut undecided, mut rejected) = (String::new(), report.solutions.is_empty(), false);
    for solution in &report.solutions {
        let line = match solution {
            Ok(candidate) => {
                let verdict = judge(problem, &reduced, candidate);
                undecided |= matches!(verdict, Verdict::Undecided { .. });
                rejected |= matches!(verdict, Verdict::Rejected(_));
                verdict.line(problem, candidate.value)
            }
            Err(off) => {
                rejected = true;
                format!("REJECTED: {off}")
            }
        };
        out += &format!("{line}\n");
    }
    if report.solutions.is_empty() {
        out += "UNDECIDED: the report lists no solution; that there is none is not checked here (see mceip complete)\n";
    }
    print(&out)?;
    Ok(match (rejected, undecided) {
        (true, _) => exit::REJECTED,
        (false, true) => exit::UNDECIDED,
        (false, false) => exit::DONE,
    })
}
