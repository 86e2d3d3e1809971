//! What a process has seen of a fuzz target: found and missed, held against the target's floor.
//!
//! One input says little: a sound solver misses a solution now and then. A process that has seen
//! many inputs says more. The floors of fuzz targets leave ten points, not two, because a fuzzer's
//! inputs are not independent: it changes one input over and over.

use crate::compare::InstanceReport;
use crate::floors::{Coverage, Starts, shortfalls};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Inputs between two comparisons with the floor. Unit: inputs.
const EVERY: u64 = 16;

/// Counts of one fuzz target over the life of a process.
#[derive(Debug)]
pub struct Counter {
    family: &'static str,
    seen: Mutex<Seen>,
}

/// Inputs in which the solver was run, and the coverage by kind of start.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Seen {
    /// Inputs counted.
    pub inputs: u64,
    /// Coverage of those that have solutions.
    pub coverage: BTreeMap<Starts, Coverage>,
}

impl Counter {
    /// Nothing seen yet; `family` is the name in the table of floors.
    pub const fn new(family: &'static str) -> Counter {
        Counter {
            family,
            seen: Mutex::new(Seen {
                inputs: 0,
                coverage: BTreeMap::new(),
            }),
        }
    }

    /// Adds an input.
    ///
    /// # Panics
    /// At every 16th input if a rate is below its floor by more than chance explains: for a fuzz
    /// target a finding.
    pub fn add(&self, report: &InstanceReport) {
        let seen = self.counted(report);
        if !seen.inputs.is_multiple_of(EVERY) {
            return;
        }

        let low = self.below_the_floor(&seen);
        assert!(
            low.is_empty(),
            "coverage over {} inputs of this process, not of the last input: {low:?}",
            seen.inputs
        );
    }

    /// The rates that are below their floors so far.
    pub fn shortfalls(&self) -> Vec<String> {
        self.below_the_floor(&self.seen())
    }

    /// What was counted so far.
    pub fn seen(&self) -> Seen {
        self.seen
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// The counts with this input; the lock is given back before anything can panic.
    fn counted(&self, report: &InstanceReport) -> Seen {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.inputs += 1;

        for (starts, coverage) in report.coverage() {
            seen.coverage.entry(starts).or_default().add(&coverage);
        }

        seen.clone()
    }

    /// The rates of these counts that are below their floors.
    fn below_the_floor(&self, seen: &Seen) -> Vec<String> {
        let mut out = Vec::new();
        for (starts, coverage) in &seen.coverage {
            for shortfall in shortfalls(self.family, *starts, coverage) {
                out.push(shortfall.to_string());
            }
        }
        out
    }
}
