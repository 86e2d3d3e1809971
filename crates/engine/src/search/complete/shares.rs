//! Counts what the pieces of a search close, and passes it on to the listener of the run.

use crate::run::{Progress, Watch};
use std::sync::{Mutex, PoisonError};

/// The leaves of a search, counted over all threads.
pub(super) struct Shares<'a> {
    watch: Watch<'a>,
    count: Mutex<Count>,
}

#[derive(Default)]
struct Count {
    leaves: u64,
    solutions: u64,
    share: f64,
}

impl<'a> Shares<'a> {
    pub(super) fn new(watch: Watch<'a>) -> Shares<'a> {
        Shares {
            watch,
            count: Mutex::default(),
        }
    }

    /// Should the rest be left open?
    pub(super) fn is_cancelled(&self) -> bool {
        self.watch.is_cancelled()
    }

    /// A leaf has closed this share of the whole, or left it open; a solution was met in it.
    pub(super) fn closed(&self, share: f64, has_solution: bool) {
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
