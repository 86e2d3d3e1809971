//! A loading path as it was followed: the pressing, the stretches between events, and why it ends.
//! `trace` makes it; reports, pictures and [`super::Comparison`] read it.

use super::line::{Bound, Equilibrium};
use super::loading::Loading;
use super::stretch::{Event, Interval};
use mceip_exact::Rational;
use mceip_model::ContactState;

/// Why a path ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PathEnd {
    /// The last stretch never ends: as a rule all nodes in contact slide ([`LoadingPath::slides`]).
    NoFurtherEvent,
    /// The range asked for is reached.
    Range,
    /// At the end of the last stretch no states satisfy the rate conditions: the quasi-static path
    /// stops here, and what follows is dynamic. Met with much friction (mu >= 1.7 on coarse
    /// meshes).
    NoContinuation {
        /// The bounds that became zero there.
        causes: Vec<Bound>,
        /// Sets of states tried (some of them more than once).
        tried: usize,
        /// Every set was tried and none was singular: it is proved that there is no continuation.
        proved: bool,
    },
    /// Whoever watched the progress stopped it; what was found is kept.
    Interrupted,
}

/// A loading path: pressing, then stretches between exactly located events.
#[derive(Debug, Clone)]
pub struct LoadingPath {
    /// How the block was loaded.
    pub loading: Loading,
    /// Depth of the pressing, mm.
    pub depth: Rational,
    /// States of the contact nodes during the pressing.
    pub pressing: Vec<ContactState>,
    /// The equilibrium at its end.
    pub pressed: Equilibrium,
    /// The stretches, in order of the motion.
    pub intervals: Vec<Interval>,
    /// Why it ends.
    pub end: PathEnd,
}

impl LoadingPath {
    /// Does the path end in sliding: no node sticks, and nothing changes any more?
    pub fn slides(&self) -> bool {
        if self.end != PathEnd::NoFurtherEvent {
            return false;
        }

        match self.intervals.last() {
            Some(last) => !last.states.contains(&ContactState::Stick),
            None => false,
        }
    }

    /// The event that ends a stretch, `None` for the last one.
    pub fn ending(&self, stretch: usize) -> Option<&Event> {
        let next = self.intervals.get(stretch + 1)?;
        Some(&next.begin)
    }

    /// The stretches with exactly these states, in order.
    pub fn stretches_with(&self, states: &[ContactState]) -> Vec<usize> {
        (0..self.intervals.len())
            .filter(|&i| self.intervals[i].states == states)
            .collect()
    }
}
