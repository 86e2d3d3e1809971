//! A stretch of the path between two events, with the event it begins with: what `trace` puts
//! together and users of a [`super::LoadingPath`] read.

use super::line::{Bound, Equilibrium};
use super::rates::Finder;
use mceip_exact::Rational;
use mceip_model::ContactState;

/// A node that goes from one state to another at an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// Contact candidate, from 0.
    pub node: usize,
    /// State before.
    pub from: ContactState,
    /// State after.
    pub to: ContactState,
}

/// What happens between two stretches of the path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// The bounds that became zero; none where a step begins.
    pub causes: Vec<Bound>,
    /// The nodes that change state.
    pub changes: Vec<Change>,
    /// How the states after it were found.
    pub finder: Finder,
    /// Sets of states tried.
    pub tried: usize,
}

/// A stretch of the path with constant states; (1), (2), (5), (7) were verified at both ends.
#[derive(Debug, Clone)]
pub struct Interval {
    /// The step whose load grows, from 0.
    pub step: usize,
    /// The event it begins with.
    pub begin: Event,
    /// What each candidate does inside the stretch: the states of the rate problem.
    pub states: Vec<ContactState>,
    /// The contact states of the equilibria inside the stretch, by their reactions alone: a
    /// candidate that sticks on the friction cone is in impending slip, one without reaction is in
    /// z.
    pub equilibrium_states: Vec<ContactState>,
    /// The equilibrium at its beginning.
    pub start: Equilibrium,
    /// The equilibrium at its end, `None` if it never ends.
    pub stop: Option<Equilibrium>,
}

impl Interval {
    /// Number of nodes that stick, slip to the left (S = 1), slip to the right (S = -1), are free.
    pub fn counts(&self) -> [usize; 4] {
        [
            self.count(ContactState::Stick),
            self.count(ContactState::Slip { sign: 1 }),
            self.count(ContactState::Slip { sign: -1 }),
            self.count(ContactState::Free),
        ]
    }

    /// Number of nodes in this state.
    fn count(&self, state: ContactState) -> usize {
        self.states.iter().filter(|s| **s == state).count()
    }

    /// The stretch of the same body with all gaps and loads times `factor` > 0.
    pub(super) fn scaled(&self, factor: &Rational) -> Interval {
        Interval {
            start: self.start.scaled(factor),
            stop: self.stop.as_ref().map(|stop| stop.scaled(factor)),
            ..self.clone()
        }
    }

    /// One letter for each node: `.` stick, `<` slip to the left, `>` to the right, `o` free.
    pub fn picture(&self) -> String {
        self.states.iter().map(|state| letter(*state)).collect()
    }
}

/// `.` stick, `<` slip to the left (S = 1), `>` slip to the right, `o` free.
fn letter(state: ContactState) -> char {
    match state {
        ContactState::Free | ContactState::Zero => 'o',
        ContactState::Stick => '.',
        ContactState::Slip { sign } if sign > 0 => '<',
        ContactState::Slip { .. } => '>',
    }
}
