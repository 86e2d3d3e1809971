//! A loading path as it was followed: the stretches between events, and why it ends. `trace` makes
//! it; reports and pictures read it.

use super::line::{Bound, Equilibrium};
use super::load_steps::LoadSteps;
use super::rates::Unsolved;
use super::stretch::{Event, Stretch};
use mceip_exact::Rational;
use mceip_model::ContactState;
use std::cmp::Ordering;

/// Why a path ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LoadingPathEnd {
    /// The last stretch never ends: as a rule all candidates in contact slide
    /// ([`LoadingPath::slides`]).
    NoFurtherEvent,
    /// All loads are applied.
    AllApplied,
    /// At the end of the last stretch no states satisfy the rate conditions: the quasi-static path
    /// stops here, and what follows is dynamic. Met with much friction (mu >= 1.7 on coarse
    /// meshes of the paper's block).
    NoContinuation {
        /// The bounds that became zero there.
        causes: Vec<Bound>,
        /// Why none were found.
        why: Unsolved,
    },
    /// Whoever watched the progress stopped it; what was found is kept.
    Interrupted,
}

/// A loading path: stretches between exactly located events.
#[derive(Debug, Clone)]
pub struct LoadingPath {
    /// How the body was loaded.
    pub steps: LoadSteps,
    /// The stretches, in order.
    pub stretches: Vec<Stretch>,
    /// Why it ends.
    pub end: LoadingPathEnd,
}

impl LoadingPath {
    /// Does it reach the end of the loads, or the last event of a load without end?
    pub fn is_whole(&self) -> bool {
        match self.end {
            LoadingPathEnd::NoFurtherEvent | LoadingPathEnd::AllApplied => true,
            LoadingPathEnd::NoContinuation { .. } | LoadingPathEnd::Interrupted => false,
        }
    }

    /// Does the path end in sliding: some candidate slides for ever, and none sticks?
    pub fn slides(&self) -> bool {
        let last = self.stretches.last();
        let Some(last) = last.filter(|_| self.end == LoadingPathEnd::NoFurtherEvent) else {
            return false;
        };

        let slides = |node: usize| {
            let is_slip = matches!(last.states[node], ContactState::Slip { .. });
            is_slip && last.start.displacement(node).0 != last.inside.displacement(node).0
        };
        let sticks = last.states.contains(&ContactState::Stick);
        !sticks && (0..last.states.len()).any(slides)
    }

    /// How much of each load is applied at an equilibrium of a stretch: all of the steps before,
    /// nothing of those after it.
    pub fn applied_at(&self, stretch: &Stretch, equilibrium: &Equilibrium) -> Vec<Rational> {
        let steps = self.steps.amounts.iter().enumerate();
        let applied = steps.map(|(step, whole)| match step.cmp(&stretch.step) {
            Ordering::Less => whole.clone().unwrap_or_default(),
            Ordering::Equal => equilibrium.amount().clone(),
            Ordering::Greater => Rational::default(),
        });
        applied.collect()
    }

    /// The event that ends a stretch, `None` for the last one.
    pub fn ending(&self, stretch: usize) -> Option<&Event> {
        let next = self.stretches.get(stretch + 1)?;
        Some(&next.begin)
    }

    /// The stretches with exactly these states, in order.
    pub fn stretches_with(&self, states: &[ContactState]) -> Vec<usize> {
        (0..self.stretches.len())
            .filter(|&i| self.stretches[i].states == states)
            .collect()
    }
}
