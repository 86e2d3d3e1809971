//! Trace files: problem, options and seed in the first line, every run and pivot in the others; and
//! the replay, which must come out byte for byte.

use super::super::common::{CliError, exit, print, text};
use super::search::{plain_search_of, search_of};
use mceip_engine::lcp;
use mceip_engine::multistart::{Found, Search, SearchError, multistart_large};
use mceip_engine::reduction::reduce;
use mceip_engine::run::Watch;
use mceip_model::file::{from_json, read_problem, require_format, write_problem};
use mceip_model::{Admissible, Problem};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The format of trace files.
const TRACE_FORMAT: &str = "mceip-trace/1";

/// First line of a trace: all that the run depends on.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header {
    format: String,
    version: String,
    starts: usize,
    seed: u64,
    all: bool,
    /// The options in words; they are those of a search in this version.
    options: String,
    /// The problem, inlined.
    problem: String,
}

impl Header {
    pub(super) fn new(problem: &Problem, search: &Search, all: bool) -> Header {
        Header {
            format: TRACE_FORMAT.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            starts: search.starts,
            seed: search.seed,
            all,
            options: format!("{:?}", search.options),
            problem: write_problem(problem),
        }
    }

    /// Of a plain problem.
    pub(super) fn plain(problem: &lcp::ExactMcp, search: &lcp::Search) -> Header {
        Header {
            format: TRACE_FORMAT.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            starts: search.starts,
            seed: search.seed,
            all: search.all,
            options: format!("{:?}", search.options),
            problem: lcp::write_mcp(problem),
        }
    }
}

/// A header made again, in the words of the recorded one: before there was a choice traces did not
/// name the crash.
fn in_old_words(again: Header, recorded: &Header) -> Header {
    let names_it = recorded.options.contains("crash_method: ");
    let options = if names_it {
        again.options
    } else {
        again
            .options
            .replacen("crash_method: ProjectedNewton, ", "", 1)
    };
    Header { options, ..again }
}

/// The whole trace.
pub(super) fn render(header: &Header, found: &Found) -> String {
    // Serialising strings and numbers cannot fail.
    let head = serde_json::to_string(header).unwrap_or_default();
    let mut out = format!("{head}\n");
    found.trace.iter().for_each(|run| out += run);
    for c in &found.certified {
        out += &format!("certified in run {}: {:?}\n", c.run, c.candidate);
    }
    for u in &found.uncertified {
        out += &format!("uncertified: {:?}: {}\n", u.candidate, u.reason);
    }
    out
}

/// The whole trace of a plain problem.
pub(super) fn render_plain(header: &Header, found: &lcp::Found) -> String {
    let head = serde_json::to_string(header).unwrap_or_default();
    let mut out = format!("{head}\n");
    found.trace.iter().for_each(|run| out += run);
    for z in &found.certified {
        out += &format!(
            "certified: {}\n",
            z.iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join(" ")
        );
    }
    for (z, reason) in &found.uncertified {
        out += &format!("uncertified: {z:?}: {reason}\n");
    }
    out
}

/// Runs a trace again and compares.
pub(super) fn replay(path: &Path) -> Result<u8, CliError> {
    let recorded = text("the trace", path)?;
    let file = |source| CliError::File {
        path: path.display().to_string(),
        source,
    };
    let head = recorded.lines().next().unwrap_or_default();
    require_format(head, TRACE_FORMAT).map_err(file)?;
    let header: Header = from_json(head).map_err(file)?;
    if header.starts == 0 {
        return Err(CliError::Option {
            option: "replay",
            expected: "a trace of at least 1 start",
            got: "starts: 0".into(),
        });
    }
    let is_plain = require_format(&header.problem, lcp::MCP_FORMAT).is_ok();
    let (again, runs) = if is_plain {
        again_plain(&header, path)?
    } else {
        again(&header, path)?
    };
    if again == recorded {
        print(&format!(
            "IDENTICAL: {runs} runs, {} bytes\n",
            recorded.len()
        ))?;
        return Ok(exit::DONE);
    }
    let line = again
        .lines()
        .zip(recorded.lines())
        .take_while(|(a, b)| a == b)
        .count();
    print(&format!(
        "DIFFERENT: first in line {} of the trace\n",
        line + 1
    ))?;
    Ok(exit::REJECTED)
}

/// The trace of a header's eigenproblem, made again, with its number of runs.
fn again(header: &Header, path: &Path) -> Result<(String, usize), CliError> {
    let problem =
        read_problem(&header.problem, Path::new(".")).map_err(|source| CliError::File {
            path: path.display().to_string(),
            source,
        })?;
    let search = search_of(header.starts, header.seed, header.all, true);
    let reduced = reduce(&problem)?;
    let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
    let (found, _) = multistart_large(&problem, &admissible, &search, &Watch::nobody())?;
    Ok((
        render(
            &in_old_words(Header::new(&problem, &search, header.all), header),
            &found,
        ),
        found.runs,
    ))
}

/// The same for a plain problem.
fn again_plain(header: &Header, path: &Path) -> Result<(String, usize), CliError> {
    let problem = lcp::read_mcp(&header.problem).map_err(|source| CliError::Plain {
        path: path.display().to_string(),
        source,
    })?;
    let search = plain_search_of(header.starts, header.seed, header.all, true);
    let found = lcp::search(&problem, &search).map_err(SearchError::from)?;
    Ok((
        render_plain(
            &in_old_words(Header::plain(&problem, &search), header),
            &found,
        ),
        found.runs,
    ))
}
