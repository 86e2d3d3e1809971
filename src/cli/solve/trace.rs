//! Trace files: problem, options and seed in the first line, every run and pivot in the others; and
//! the replay, which must come out byte for byte.

use super::super::common::{CliError, exit, print, text};
use crate::model::file::{from_json, read_problem, require_format, write_problem};
use crate::model::{Admissible, Problem};
use crate::multistart::{Found, Search, multistart_large};
use crate::reduction::reduce;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
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
    /// The options in words; they are the defaults of the version.
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

/// Runs a trace again and compares.
pub(super) fn replay(path: &Path) -> Result<u8, CliError> {
    let recorded = text("the trace", path)?;
    let file = |source| CliError::File { path: path.display().to_string(), source };
    let head = recorded.lines().next().unwrap_or_default();
    require_format(head, TRACE_FORMAT).map_err(file)?;
    let header: Header = from_json(head).map_err(file)?;
    let problem = read_problem(&header.problem, Path::new(".")).map_err(file)?;
    let search = super::search_of(header.starts, header.seed, header.all, true);
    let reduced = reduce(&problem)?;
    let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
    let (found, _) = multistart_large(&admissible, problem.window(), &search, &|_| ControlFlow::Continue(()))?;
    let again = render(&Header::new(&problem, &search, header.all), &found);
    if again == recorded {
        print(&format!("IDENTICAL: {} runs, {} bytes\n", found.runs, recorded.len()))?;
        return Ok(exit::DONE);
    }
    let line = again.lines().zip(recorded.lines()).take_while(|(a, b)| a == b).count();
    print(&format!("DIFFERENT: first in line {} of the trace\n", line + 1))?;
    Ok(exit::REJECTED)
}
