//! The searches that the options ask for: of an eigenproblem, and of a plain LCP or MCP.

use crate::{Problem, Solve};
use mceip_engine::lcp;
use mceip_mcp::solver::Options;

/// The search that the options ask for.
pub(super) fn search_of(problem: &Problem, starts: usize, seed: u64, all: bool) -> Solve<'_> {
    let search = problem.solve().starts(starts).seed(seed);
    if all { search.all() } else { search }
}

/// The same of a plain problem.
pub(super) fn plain_search_of(
    starts: usize,
    seed: u64,
    all: bool,
    trace: bool,
) -> lcp::PlainSearch {
    lcp::PlainSearch {
        starts,
        all,
        seed,
        trace,
        options: Options::for_search(),
    }
}
