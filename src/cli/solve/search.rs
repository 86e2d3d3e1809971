//! The searches that the options ask for: of an eigenproblem, and of a plain LCP or MCP.

use mceip_engine::lcp;
use mceip_engine::multistart::Search;
use mceip_mcp::solver::Options;

/// The search that the options ask for.
pub(super) fn search_of(starts: usize, seed: u64, all: bool, trace: bool) -> Search {
    let window_starts = if all {
        Search::default().window_starts
    } else {
        0
    };

    Search {
        starts,
        window_starts,
        curves: all,
        seed,
        trace,
        ..Search::default()
    }
}

/// The same of a plain problem.
pub(super) fn plain_search_of(starts: usize, seed: u64, all: bool, trace: bool) -> lcp::Search {
    lcp::Search {
        starts,
        all,
        seed,
        trace,
        options: Options::for_search(),
    }
}
