//! `mceip check`: a certificate or somebody's solutions against a problem, one verdict.

pub(super) mod plain;

use super::common::{CliError, exit, load, parse_window, print, text};
use super::complete::solutions_text;
use mceip_check::certificate::{CERTIFICATE_FORMAT, Certificate};
use mceip_check::{Accepted, AcceptedClaim, Place, check};
use mceip_engine::candidate::SOLUTIONS_FORMAT;
use mceip_engine::foreign::{Effort, ForeignError, ForeignReport, Verdict, judge};
use mceip_engine::lcp::MCP_FORMAT;
use mceip_engine::reduction::reduce;
use mceip_engine::tolerance::{AGREEMENT, AGREEMENT_RANGE, FINEST_AGREEMENT, VALUE_RADIUS};
use mceip_exact::{enclosing_decimals, parse, to_f64};
use mceip_model::file::require_format;
use mceip_model::{Problem, Window};
use std::path::{Path, PathBuf};

/// Arguments of `check`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1), or a plain LCP or MCP (mceip-mcp/1).
    file: PathBuf,
    /// Certificate (mceip-certificate/1), or somebody's solutions (mceip-solutions/1): each of
    /// those is certified and checked, or refuted. Of a plain problem: its solution file
    /// (mceip-mcp-solution/1).
    certificate: PathBuf,
    /// Demand a certificate whose window covers the closed window a,b (b empty or inf: no upper
    /// end); one that does not is rejected.
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Of somebody's solutions: the relative error up to which a value and x (scaled to largest
    /// |x_i| = 1) agree with the proven solution [default: 1e-6].
    #[arg(long, value_name = "ERROR")]
    tolerance: Option<String>,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if args.file.as_path() == Path::new("-") && args.certificate.as_path() == Path::new("-") {
        return Err(CliError::Option {
            option: "certificate",
            expected: "only one of the two files to be stdin",
            got: "-".into(),
        });
    }
    let demanded = args.window.as_deref().map(parse_window).transpose()?;
    let tolerance = args.tolerance.as_deref().map(parse_tolerance).transpose()?;

    let problem = text("the problem", &args.file)?;
    if require_format(&problem, MCP_FORMAT).is_ok() {
        only_of_others(args, "a plain problem")?;
        return plain::verdict(&args.file, &problem, &args.certificate);
    }

    let problem = load(&args.file, None)?;
    let source = text("the certificate", &args.certificate)?;
    if require_format(&source, SOLUTIONS_FORMAT).is_ok() {
        if args.window.is_some() {
            return Err(useless(
                "window",
                "it with a certificate only",
                SOLUTIONS_FORMAT,
            ));
        }
        return foreign(args, &problem, &source, tolerance.unwrap_or(AGREEMENT));
    }
    if tolerance.is_some() {
        return Err(useless(
            "tolerance",
            "it with somebody's solutions only",
            CERTIFICATE_FORMAT,
        ));
    }

    let read = Certificate::from_json(&source);
    let certificate = read.map_err(|source| CliError::File {
        path: args.certificate.display().to_string(),
        source,
    })?;
    match check(&problem, &certificate) {
        Ok(accepted) => say_accepted(&problem, &certificate, &accepted, demanded.as_ref()),
        Err(rejected) => {
            print(&format!("REJECTED: {rejected}\n"))?;
            Ok(exit::REJECTED)
        }
    }
}

/// The complaint about an option that says nothing about a file of this kind.
fn useless(option: &'static str, expected: &'static str, got: &str) -> CliError {
    CliError::Option {
        option,
        expected,
        got: got.into(),
    }
}

/// Refuses the options that a plain problem has no use for.
fn only_of_others(args: &Args, kind: &str) -> Result<(), CliError> {
    if args.window.is_some() {
        return Err(useless("window", "it with a certificate only", kind));
    }
    if args.tolerance.is_some() {
        return Err(useless(
            "tolerance",
            "it with somebody's solutions only",
            kind,
        ));
    }
    Ok(())
}

/// A relative error between [`FINEST_AGREEMENT`] and [`VALUE_RADIUS`], where solutions are looked
/// for.
fn parse_tolerance(given: &str) -> Result<f64, CliError> {
    let bad = || CliError::Option {
        option: "tolerance",
        expected: AGREEMENT_RANGE,
        got: given.chars().take(60).collect(),
    };
    let tolerance = parse(given).map(|v| to_f64(&v)).map_err(|_| bad())?;
    let is_within = (FINEST_AGREEMENT..=VALUE_RADIUS).contains(&tolerance);
    if is_within { Ok(tolerance) } else { Err(bad()) }
}

/// Prints what an accepted certificate has proved: its claims, its cover, and the verdict with its
/// window.
fn say_accepted(
    problem: &Problem,
    certificate: &Certificate,
    accepted: &Accepted,
    demanded: Option<&Window>,
) -> Result<u8, CliError> {
    let mut out = String::new();
    for claim in &accepted.claims {
        let place = accepted
            .cover
            .as_ref()
            .and_then(|cover| cover.place_of(claim));
        out += &claim_text(problem, claim, place);
    }
    let window = &certificate.window;
    let within = window;
    let smaller = smaller_text(window, problem.window());
    let digest = problem.sha256();

    let verdict = match &accepted.cover {
        None => {
            let count = accepted.claims.len();
            out += &format!(
                "ACCEPTED: {count} claim(s) proved for problem {digest} in {within}{smaller}\n"
            );
            exit::DONE
        }
        Some(cover) if cover.proves_absence() => {
            let word = problem.unknown().word();
            let evidence = format!("{word}, problem {digest}, {} leaves accepted", cover.leaves);
            out += &format!("ABSENT in {within}: no solution ({evidence}){smaller}\n");
            exit::DONE
        }
        Some(cover) => {
            let is_closed = cover.open.is_empty();
            let verdict = if is_closed {
                "ACCEPTED"
            } else {
                "ACCEPTED as undecided"
            };
            let windowed = problem.clone().with_window(window.clone());
            out += &solutions_text(&windowed, cover);
            out += &format!("{verdict} for problem {digest} in {within}{smaller}\n");
            if is_closed {
                exit::DONE
            } else {
                exit::UNDECIDED
            }
        }
    };

    let missed = demanded.filter(|demanded| !window.covers(demanded));
    if let Some(demanded) = missed {
        out += &format!(
            "REJECTED: window: expected one that covers {}, got {}\n",
            demanded, window
        );
    }
    print(&out)?;
    Ok(if missed.is_some() {
        exit::REJECTED
    } else {
        verdict
    })
}

/// A proved claim, and its place in the cover beside it.
fn claim_text(problem: &Problem, claim: &AcceptedClaim, place: Option<Place>) -> String {
    let word = problem.unknown().word();
    let ends = enclosing_decimals(&claim.value, 17);
    let proved = format!(
        "{word} in [{}, {}], slip {:?}",
        ends.0, ends.1, claim.support
    );
    match place {
        None => format!("solution: {proved}\n"),
        Some(Place::Solution(k)) => {
            format!("claim: {proved}; solution {} of the list below\n", k + 1)
        }
        Some(Place::Family(k)) => format!("claim: {proved}; in family {} below\n", k + 1),
        Some(Place::Open(k)) => format!("claim: {proved}; in open region {} below\n", k + 1),
    }
}

/// Says that the certificate speaks of a part of the problem's window only.
fn smaller_text(certified: &Window, wanted: &Window) -> String {
    if certified.covers(wanted) {
        return String::new();
    }
    format!("; NOT the whole window {} of the problem", wanted)
}

/// One line per solution of a foreign report; the exit code is that of the worst.
fn foreign(args: &Args, problem: &Problem, source: &str, tolerance: f64) -> Result<u8, CliError> {
    let reduced = reduce(problem)?;
    let report = match ForeignReport::read(source, problem, &reduced) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => {
            print(&format!("REJECTED: {e}\n"))?;
            return Ok(exit::REJECTED);
        }
        Err(source) => {
            return Err(CliError::Foreign {
                path: args.certificate.display().to_string(),
                source,
            });
        }
    };

    let mut out = String::new();
    let mut is_undecided = report.solutions.is_empty();
    let mut is_rejected = false;
    let mut effort = Effort::default();
    for reported in &report.solutions {
        let line = match reported {
            Ok(reported) => {
                let verdict = judge(problem, &reduced, reported, tolerance, &mut effort);
                is_undecided |= matches!(verdict, Verdict::Undecided { .. });
                is_rejected |= matches!(verdict, Verdict::Rejected(_) | Verdict::Inaccurate { .. });
                verdict.line(problem, reported.candidate.value)
            }
            Err(bad) => {
                is_rejected = true;
                format!("REJECTED: {bad}")
            }
        };
        out += &format!("{line}\n");
    }
    if report.solutions.is_empty() {
        out += "UNDECIDED: the report lists no solution; that there is none is not checked here \
                (see mceip complete)\n";
    }
    print(&out)?;
    Ok(match (is_rejected, is_undecided) {
        (true, _) => exit::REJECTED,
        (false, true) => exit::UNDECIDED,
        (false, false) => exit::DONE,
    })
}
