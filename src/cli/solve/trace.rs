//! Trace files: problem, options and seed in the first line, every run and pivot in the others; and
//! the replay, which must come out byte for byte.

use super::super::common::{CliError, exit, print, text};
use super::super::job::Job;
use super::search::{plain_search_of, search_of};
use crate::{Found, Problem};
use mceip_engine::lcp;
use mceip_engine::multistart::{self, MAX_STARTS, Search, SearchError};
use mceip_engine::report::counted;
use mceip_engine::run::Watch;
use mceip_model::file::{from_json_of, read_problem, require_format, to_json_of};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The format of trace files.
const TRACE_FORMAT: &str = "mceip-trace/1";

/// First line of a trace: all that the run depends on.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header {
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
    /// Of an eigenproblem.
    fn new(problem: &Problem, search: &Search, all: bool) -> Header {
        Header {
            version: env!("CARGO_PKG_VERSION").into(),
            starts: search.starts,
            seed: search.seed,
            all,
            options: format!("{:?}", search.options),
            problem: problem.to_json(),
        }
    }

    /// Of a plain problem.
    pub(super) fn plain(problem: &lcp::ExactMcp, search: &lcp::PlainSearch) -> Header {
        Header {
            version: env!("CARGO_PKG_VERSION").into(),
            starts: search.starts,
            seed: search.seed,
            all: search.all,
            options: format!("{:?}", search.options),
            problem: lcp::write_mcp(problem),
        }
    }
}

/// A header made again, in the words of the recorded one: traces recorded before the crash could be
/// chosen do not name it.
fn in_old_words(again: Header, recorded: &Header) -> Header {
    let names_crash = recorded.options.contains("crash_method: ");
    if names_crash {
        return again;
    }

    let crash = "crash_method: ProjectedNewton, ";
    let options = again.options.replacen(crash, "", 1);
    Header { options, ..again }
}

/// The header as the first line of a trace.
fn first_line(header: &Header) -> String {
    to_json_of(TRACE_FORMAT, header) + "\n"
}

/// The whole trace of a search.
pub(super) fn text_of(problem: &Problem, found: &Found, all: bool) -> String {
    render(&Header::new(problem, found.search(), all), found.as_run())
}

fn render(header: &Header, found: &multistart::MultistartFound) -> String {
    let mut out = first_line(header);
    out.extend(found.trace.iter().map(String::as_str));
    for solution in &found.certified {
        let run = solution.run;
        out += &format!("certified in run {run}: {:?}\n", solution.candidate);
    }

    for point in &found.uncertified {
        let reason = &point.reason;
        out += &format!("uncertified: {:?}: {reason}\n", point.candidate);
    }

    out
}

/// The whole trace of a plain problem.
pub(super) fn render_plain(header: &Header, found: &lcp::PlainFound) -> String {
    let mut out = first_line(header);
    out.extend(found.trace.iter().map(String::as_str));
    for z in &found.certified {
        let components: Vec<String> = z.iter().map(ToString::to_string).collect();
        out += &format!("certified: {}\n", components.join(" "));
    }

    for (z, reason) in &found.uncertified {
        out += &format!("uncertified: {z:?}: {reason}\n");
    }

    out
}

/// A trace made again.
struct Repeated {
    trace: String,
    runs: usize,
}

/// Runs a trace again and compares.
pub(super) fn replay(path: &Path) -> Result<u8, CliError> {
    let recorded = text("the trace", path)?;
    let header = read_header(&recorded, path)?;

    let job = Job::begin_with_nothing_to_keep("running the trace again");
    let is_plain = require_format(&header.problem, lcp::MCP_FORMAT).is_ok();
    let again = if is_plain {
        job.watched(|watch| repeat_plain(&header, path, watch))?
    } else {
        repeat(&header, path, &job)?
    };
    job.end();

    if again.trace == recorded {
        let runs = counted(again.runs, "run");
        let bytes = recorded.len();
        print(&format!("IDENTICAL: {runs}, {bytes} bytes\n"))?;
        return Ok(exit::DONE);
    }

    let lines = again.trace.lines().zip(recorded.lines());
    let equal = lines.take_while(|(again, recorded)| again == recorded);
    let line = equal.count() + 1;
    print(&format!("DIFFERENT: first in line {line} of the trace\n"))?;

    Ok(exit::REJECTED)
}

fn read_header(recorded: &str, path: &Path) -> Result<Header, CliError> {
    let head = recorded.lines().next().unwrap_or_default();
    let header = from_json_of(TRACE_FORMAT, head);
    let header: Header = header.map_err(|e| CliError::file(path, e))?;

    if !(1..=MAX_STARTS).contains(&header.starts) {
        let expected = "a trace of 1 to 100000 starts";
        let got = header.starts.to_string();
        return Err(CliError::option("replay", expected, &got));
    }

    Ok(header)
}

/// Makes the trace of a header's eigenproblem again.
fn repeat(header: &Header, path: &Path, job: &Job) -> Result<Repeated, CliError> {
    let problem = read_problem(&header.problem, Path::new("."));
    let problem = Problem::from(problem.map_err(|e| CliError::file(path, e))?);
    let search = search_of(&problem, header.starts, header.seed, header.all).trace();
    let search = search
        .cancel(job.cancel())
        .on_progress(|progress| job.say(progress));
    let found = search.run()?;

    let again = Header::new(&problem, found.search(), header.all);
    Ok(Repeated {
        trace: render(&in_old_words(again, header), found.as_run()),
        runs: found.runs,
    })
}

/// Makes the trace of a header's plain problem again.
fn repeat_plain(header: &Header, path: &Path, watch: &Watch<'_>) -> Result<Repeated, CliError> {
    let problem = lcp::read_mcp(&header.problem).map_err(|e| CliError::other_file(path, e))?;
    let search = plain_search_of(header.starts, header.seed, header.all, true);
    let found = lcp::search(&problem, &search, watch).map_err(SearchError::from)?;

    let again = Header::plain(&problem, &search);
    Ok(Repeated {
        trace: render_plain(&in_old_words(again, header), &found),
        runs: found.runs,
    })
}
