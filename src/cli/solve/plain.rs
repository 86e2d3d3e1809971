//! `mceip solve` on a plain LCP or MCP (mceip-mcp/1): exact solutions, each its own certificate.

use super::super::check::plain::verdict;
use super::super::common::{CliError, exit, print};
use super::super::output::Output;
use super::args::Args;
use super::search::plain_search_of;
use super::trace;
use mceip_engine::lcp::{ExactMcp, FileError, Found, read_mcp, search, write_solution};
use mceip_engine::multistart::{SearchError, trace_outcome};
use mceip_exact::{Rational, to_f64};
use std::fmt::Write as _;
use std::path::Path;

/// Solves a plain problem, or checks a solution file of it.
pub(super) fn run(args: &Args, path: &Path, source: &str) -> Result<u8, CliError> {
    if let Some(solution) = &args.check {
        return verdict(path, source, solution);
    }
    let named = |source: FileError| CliError::Plain {
        path: path.display().to_string(),
        source,
    };
    let problem = read_mcp(source).map_err(named)?;
    let output = args
        .certificate
        .as_ref()
        .map(|out| Output::prepare("certificate", out, &[path]))
        .transpose()?;
    let trace_output = args
        .trace
        .as_ref()
        .map(|out| Output::prepare("trace", out, &[path]))
        .transpose()?;
    let how = plain_search_of(args.starts, args.seed, args.all, args.trace.is_some());
    let found = search(&problem, &how).map_err(SearchError::from)?;
    if let Some(output) = trace_output {
        output.write(&trace::render_plain(
            &trace::Header::plain(&problem, &how),
            &found,
        ))?;
    }
    for (point, reason) in &found.uncertified {
        eprintln!("uncertified: z = {point:?}: {reason}");
    }
    if let (true, Some(first)) = (args.log, &found.first) {
        eprint!("{}", trace_outcome(first));
    }
    print(&if args.json {
        json(&problem, &found)
    } else {
        listing(&problem, &found)
    })?;
    let any = !found.certified.is_empty();
    if let (Some(output), true) = (output, any) {
        output.write(&write_solution(&problem, &found.certified))?;
    }
    Ok(if any { exit::DONE } else { exit::UNDECIDED })
}

fn evidence(found: &Found) -> String {
    let (pivots, factorisations) = found.counters;
    format!(
        "{} certified found in {} runs ({pivots} pivots, {factorisations} factorisations, endings \
         {:?}); completeness unknown",
        found.certified.len(),
        found.runs,
        found.terminations
    )
}

fn listing(problem: &ExactMcp, found: &Found) -> String {
    let mut out = String::new();
    for z in &found.certified {
        let _ = writeln!(out, "certified solution");
        for (i, (z_i, f_i)) in z.iter().zip(problem.function(z)).enumerate() {
            let _ = writeln!(
                out,
                "  z[{i}] = {z_i} ({}), F[{i}] = {f_i} ({})",
                to_f64(z_i),
                to_f64(&f_i)
            );
        }
    }
    let _ = writeln!(out, "{}", evidence(found));
    out
}

fn json(problem: &ExactMcp, found: &Found) -> String {
    let texts = |list: &[Rational]| list.iter().map(ToString::to_string).collect::<Vec<_>>();
    let solutions: Vec<_> = found
        .certified
        .iter()
        .map(|z| serde_json::json!({ "z": texts(z), "f": texts(&problem.function(z)) }))
        .collect();
    let uncertified: Vec<_> = found
        .uncertified
        .iter()
        .map(|(z, reason)| serde_json::json!({ "z": z, "reason": reason.to_string() }))
        .collect();
    let value = serde_json::json!({
        "format": "mceip-mcp-solutions/1",
        "problem_sha256": problem.sha256(),
        "claim": "solutions",
        "evidence": evidence(found),
        "solutions": solutions,
        "uncertified": uncertified,
    });
    format!("{value:#}\n")
}
