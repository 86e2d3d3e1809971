//! Counts what the pieces of a search close, and passes it on to the listener of the run.
//!
//! Every region has a share of the whole search, which its parts divide among them; the shares of
//! all leaves add up to one. Called by `tree` and `splice`, from all threads.

use crate::run::{Keeper, Progress, Watch};
use std::sync::{Mutex, PoisonError};

/// The leaves of a search, counted over all threads.
pub(crate) struct Shares<'a> {
    watch: Watch<'a>,
    count: Mutex<Count>,
}

/// What has been closed so far.
#[derive(Default)]
struct Count {
    leaves: u64,
    /// Leaves in which a solution was met.
    solutions: u64,
    /// Sum of the shares of the leaves.
    share: f64,
}

impl<'a> Shares<'a> {
    /// Counts from zero, for the listener of this watch.
    pub(crate) fn new(watch: Watch<'a>) -> Shares<'a> {
        Shares {
            watch,
            count: Mutex::default(),
        }
    }

    /// Who keeps what is proved meanwhile.
    pub(crate) fn keeper(&self) -> Option<Keeper<'a>> {
        self.watch.keeper()
    }

    /// Should the rest be left open?
    pub(crate) fn is_cancelled(&self) -> bool {
        self.watch.is_cancelled()
    }

    /// A leaf has closed this share of the whole, or left it open; a solution was met in it.
    pub(crate) fn closed(&self, share: f64, has_solution: bool) {
        // A poisoned lock means that a thread panicked; its count is still good.
        let mut count = self.count.lock().unwrap_or_else(PoisonError::into_inner);
        count.leaves += 1;
        count.share += share;
        count.solutions += u64::from(has_solution);

        self.watch.report(&Progress {
            stage: "searching",
            done: count.leaves,
            total: None,
            share: Some(count.share),
            solutions: Some(count.solutions),
        });
    }
}
