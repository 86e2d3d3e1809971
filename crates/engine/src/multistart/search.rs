//! How to search, and who turns a candidate into an accepted claim.
//!
//! [`Search`] has the numbers of starts and windows, the budget of the curves and the options of
//! the solver; its default is what the command `solve` does.

use crate::candidate::Candidate;
use crate::certify::{NotCertified, Preference};
use mceip_check::certificate::Claim;
use mceip_mcp::solver::{Options, SolverError};

/// The most starts of a search. More than any problem has needed.
pub const MAX_STARTS: usize = 100_000;

/// Numbers in all starts of a search, at most: they are made before the first is used.
const MAX_NUMBERS: usize = 1 << 27;

/// Refuses more starts than [`MAX_STARTS`], and more than there is room for with so many variables.
///
/// # Errors
/// [`SolverError::Option`].
pub(crate) fn require_starts(starts: usize, variables: usize) -> Result<(), SolverError> {
    let expected = if starts > MAX_STARTS {
        "at most 100000"
    } else if starts.saturating_mul(variables) > MAX_NUMBERS {
        "at most 2^27 divided by the number of variables"
    } else {
        return Ok(());
    };

    Err(SolverError::Option {
        name: "starts",
        expected,
        got: starts as f64,
    })
}

/// How to search.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Starts on the whole window.
    pub starts: usize,
    /// Starts above and below each value found (zeta of section 4); 0 for none.
    pub window_starts: usize,
    /// Values around which windows are opened, at most: a singular pencil has a continuum of them.
    pub window_limit: usize,
    /// Further origins from which values above are sought.
    pub origins: Vec<f64>,
    /// Follow curves of the Newton homotopy, from starts and through solutions found?
    pub curves: bool,
    /// Curves on which each solution found is left, each followed both ways. By default half the
    /// slip variables, rounded up, at most 3: each connects it with others.
    pub departures: Option<usize>,
    /// End curves when the pivots and factorisations of everything done reach those of this many
    /// runs of the solver, by the mean of those made, or n (n + 4) / 2 for n variables where that
    /// is more; the last curve may pass it by its last steps and what polishing costs. Within it
    /// further runs are made where a curve costs many. `None` for no such end.
    pub budget: Option<usize>,
    /// Keep the log of every run as text?
    pub trace: bool,
    /// Which form the claims have.
    pub preference: Preference,
    /// Seed of the random starts.
    pub seed: u64,
    /// Options of each run.
    pub options: Options,
}

impl Default for Search {
    fn default() -> Self {
        Search {
            starts: 22,
            window_starts: 4,
            window_limit: 16,
            origins: Vec::new(),
            curves: true,
            departures: None,
            budget: None,
            trace: false,
            preference: Preference::default(),
            seed: 1,
            options: Options::for_search(),
        }
    }
}

/// What turns a candidate into a claim that the checker has accepted: any function, so that a
/// condensed pencil can be searched and the claim made about the full one.
pub(super) type Certify<'a> = dyn Fn(&Candidate) -> Result<Claim, NotCertified> + 'a;
