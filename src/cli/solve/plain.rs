//! `mceip solve` on a plain LCP or MCP (mceip-mcp/1): exact solutions, each its own certificate.

use super::super::check::plain::verdict;
use super::super::common::{CliError, aside, exit, print};
use super::super::job::Job;
use super::super::output::Output;
use super::args::Args;
use super::search::plain_search_of;
use super::trace;
use mceip_engine::lcp::{ExactMcp, PlainFound, read_mcp, search, write_solution};
use mceip_engine::multistart::{SearchError, trace_outcome};
use mceip_engine::report::counted;
use mceip_exact::{Rational, to_f64};
use serde_json::json;
use std::path::Path;

/// Solves a plain problem, or checks a solution file of it.
pub(super) fn run(args: &Args, path: &Path, source: &str) -> Result<u8, CliError> {
    if let Some(solution) = &args.check {
        return verdict(path, source, solution);
    }

    let problem = read_mcp(source).map_err(|e| CliError::other_file(path, e))?;
    let output = Output::prepare_if("certificate", args.certificate.as_deref(), &[path])?;
    let trace_output = Output::prepare_if("trace", args.trace.as_deref(), &[path])?;
    let how = plain_search_of(args.starts, args.seed, args.all, args.trace.is_some());
    let job = Job::begin("searching");
    let searched = job.watched(|watch| search(&problem, &how, watch));
    let found = searched.map_err(SearchError::from)?;
    job.end();

    // Solutions first; what cannot be written takes nothing else along.
    let is_found = !found.certified.is_empty();
    let solutions = match output {
        Some(output) if is_found => output.write(&write_solution(&problem, &found.certified)),
        _ => Ok(()),
    };
    let log = match trace_output {
        Some(output) if !found.interrupted => {
            let header = trace::Header::plain(&problem, &how);
            output.write(&trace::render_plain(&header, &found))
        }
        _ => Ok(()),
    };

    for (point, reason) in &found.uncertified {
        aside(&format!("uncertified: z = {point:?}: {reason}"));
    }

    if let Some(first) = &found.first
        && args.log
    {
        aside(trace_outcome(first).trim_end_matches('\n'));
    }

    let text = if args.json {
        json(&problem, &found)
    } else {
        listing(&problem, &found)
    };
    print(&text)?;
    solutions.and(log)?;

    Ok(if found.interrupted {
        exit::INTERRUPTED
    } else if is_found {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}

/// What the search was and how it went.
fn evidence(found: &PlainFound) -> String {
    let (pivots, factorisations) = found.counters;
    let pivots = counted(pivots, "pivot");
    let factorisations = counted(factorisations, "factorisation");
    let runs = counted(found.runs, "run");
    let curves = match found.curves {
        0 => String::new(),
        curves => format!(" and along {}", counted(curves, "curve")),
    };

    format!(
        "{} certified found in {runs}{curves} ({pivots}, {factorisations}, \
         endings of the runs {:?}); completeness unknown",
        found.certified.len(),
        found.terminations
    )
}

/// Each solution z with F(z), for people.
fn listing(problem: &ExactMcp, found: &PlainFound) -> String {
    let mut out = String::new();
    for z in &found.certified {
        out += "certified solution\n";
        let function = problem.function(z);
        for (i, (z_i, f_i)) in z.iter().zip(&function).enumerate() {
            let z_double = to_f64(z_i);
            let f_double = to_f64(f_i);
            out += &format!("  z[{i}] = {z_i} ({z_double}), F[{i}] = {f_i} ({f_double})\n");
        }
    }

    out += &format!("{}\n", evidence(found));
    out
}

/// The same as `mceip-mcp-solutions/1`.
fn json(problem: &ExactMcp, found: &PlainFound) -> String {
    let mut solutions = Vec::new();
    for z in &found.certified {
        solutions.push(json!({ "z": texts(z), "f": texts(&problem.function(z)) }));
    }

    let mut uncertified = Vec::new();
    for (z, reason) in &found.uncertified {
        uncertified.push(json!({ "z": z, "reason": reason.to_string() }));
    }

    let value = json!({
        "format": "mceip-mcp-solutions/1",
        "problem_sha256": problem.sha256(),
        "claim": "solutions",
        "evidence": evidence(found),
        "solutions": solutions,
        "uncertified": uncertified,
    });

    format!("{value:#}\n")
}

fn texts(numbers: &[Rational]) -> Vec<String> {
    numbers.iter().map(ToString::to_string).collect()
}
