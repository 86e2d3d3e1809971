//! `mceip solve`: the PATH-style solver with many starts, every claim certified.

mod args;
mod plain;
mod search;
mod trace;

pub(super) use args::Args;

use super::common::{CliError, exit, load, print, text};
use super::job::Job;
use super::output::Output;
use mceip_engine::certify::certificate;
use mceip_engine::lcp::MCP_FORMAT;
use mceip_engine::multistart::{Found, multistart_large, support, trace_outcome};
use mceip_engine::reduction::reduce;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_model::file::require_format;
use mceip_model::{Admissible, Pencil, Problem};
use search::search_of;
use std::collections::BTreeMap;
use std::path::Path;

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if args.starts == 0 {
        return Err(CliError::Option {
            option: "starts",
            expected: "at least 1",
            got: "0".into(),
        });
    }
    let file = match (&args.replay, &args.file) {
        (Some(path), _) => return trace::replay(path),
        (None, Some(file)) => file,
        (None, None) => {
            return Err(CliError::Option {
                option: "replay",
                expected: "a file, or a problem",
                got: String::new(),
            });
        }
    };
    let source = text("the problem", file)?;
    let is_plain = require_format(&source, MCP_FORMAT).is_ok();
    // Options that belong to the other kind of problem are refused, not ignored.
    if let (Some(path), false) = (&args.check, is_plain) {
        let expected = "a problem of format mceip-mcp/1 (mceip check for others)";
        return Err(CliError::Option {
            option: "check",
            expected,
            got: path.display().to_string(),
        });
    }
    if let (Some(window), true) = (&args.window, is_plain) {
        return Err(CliError::Option {
            option: "window",
            expected: "a problem of format mceip-problem/1",
            got: window.clone(),
        });
    }
    if is_plain {
        plain::run(args, file, &source)
    } else {
        eigenproblem(args, file)
    }
}

/// Searches, certifies and prints an `mceip-problem/1`.
fn eigenproblem(args: &Args, file: &Path) -> Result<u8, CliError> {
    let problem = load(file, args.window.as_deref())?;
    let output = args
        .certificate
        .as_ref()
        .map(|path| Output::prepare("certificate", path, &[file]))
        .transpose()?;
    let trace_output = args
        .trace
        .as_ref()
        .map(|path| Output::prepare("trace", path, &[file]))
        .transpose()?;
    let reduced = reduce(&problem)?;
    let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
    let search = search_of(args.starts, args.seed, args.all, args.trace.is_some());
    let job = Job::begin("searching");
    let (found, _) =
        job.watched(|watch| multistart_large(&problem, &admissible, &search, watch))?;
    job.end();
    print_asides(args, &problem, &reduced.pencil, &found);
    if let (Some(output), false) = (trace_output, found.interrupted) {
        output.write(&trace::render(
            &trace::Header::new(&problem, &search, args.all),
            &found,
        ))?;
    }
    let claims: Vec<_> = found.certified.iter().map(|c| c.claim.clone()).collect();
    let solutions = claims
        .iter()
        .map(|c| Listed::of_claim(&problem, &reduced, c))
        .collect();
    let evidence = evidence(args, &found);
    let report = Report {
        problem: &problem,
        reduced: &reduced,
        solutions,
        claim: Claimed::Solutions,
        evidence,
        enumeration: None,
        cover: None,
    };
    print(&if args.json {
        format!("{}\n", solutions_json(&report))
    } else {
        solutions_text(&report)
    })?;
    let any = !claims.is_empty();
    if let (Some(output), true) = (output, any) {
        output.write(&certificate(&problem, claims).to_json())?;
    }
    Ok(match (found.interrupted, any) {
        (true, _) => exit::INTERRUPTED,
        (false, true) => exit::DONE,
        (false, false) => exit::UNDECIDED,
    })
}

/// What goes to stderr: points without a certificate, singular supports, the first run's log.
fn print_asides(args: &Args, problem: &Problem, pencil: &Pencil, found: &Found) {
    for u in &found.uncertified {
        eprintln!(
            "uncertified: {} = {}: {}",
            problem.unknown().word(),
            u.candidate.value,
            u.reason
        );
    }
    for support in singular_supports(pencil, found) {
        eprintln!(
            "singular pencil: support {support:?} has more values than its order: every value is \
             an eigenvalue, those listed are examples"
        );
    }
    if let (true, Some(first)) = (args.log, &found.first) {
        eprint!("{}", trace_outcome(first));
    }
}

fn evidence(args: &Args, found: &Found) -> String {
    format!(
        "{} certified found in {}{} runs (seed {}, {} pivots, {} factorisations, {} repeats, {} \
         outside the window, endings {:?}); completeness unknown",
        found.certified.len(),
        if found.interrupted {
            "an interrupted search of "
        } else {
            ""
        },
        found.runs,
        args.seed,
        found.pivots,
        found.factorisations,
        found.repeated,
        found.outside,
        found.terminations
    )
}

/// Supports with more certified values than a determinant of their order has roots: it vanishes
/// identically.
fn singular_supports(pencil: &Pencil, found: &Found) -> Vec<Vec<usize>> {
    let mut counts: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for c in &found.certified {
        *counts.entry(support(&c.claim).to_vec()).or_default() += 1;
    }
    counts
        .into_iter()
        .filter(|(s, count)| *count > s.len() + pencil.free().len())
        .map(|(s, _)| s)
        .collect()
}
