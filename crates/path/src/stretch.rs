//! A stretch of the path between two events, with the event it begins with: what `trace` puts
//! together and users of a [`super::LoadingPath`] read.

use super::line::{Bound, Equilibrium};
use super::rates::Finder;
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

/// A stretch of the path with constant states; (1), (2), (5), (7) were verified at both ends and
/// inside.
#[derive(Debug, Clone)]
pub struct Stretch {
    /// The step whose load grows, from 0.
    pub step: usize,
    /// The event it begins with.
    pub begin: Event,
    /// What each candidate does inside the stretch: the states of the rate problem.
    pub states: Vec<ContactState>,
    /// The equilibrium at its beginning.
    pub start: Equilibrium,
    /// An equilibrium inside: in the middle half, or one to two units of the load on where it never
    /// ends, where the amount is the shortest fraction.
    pub inside: Equilibrium,
    /// The equilibrium at its end, `None` if it never ends.
    pub stop: Option<Equilibrium>,
}

impl Stretch {
    /// The contact states of the equilibria inside the stretch.
    pub fn equilibrium_states(&self) -> &[ContactState] {
        self.inside.contact_states()
    }

    /// The last equilibrium: at its end, or inside where it never ends.
    pub fn last(&self) -> &Equilibrium {
        self.stop.as_ref().unwrap_or(&self.inside)
    }

    /// Number of candidates that stick, are in impending slip against their tangent (S = 1) and
    /// along it (S = -1), and are free, at the equilibria inside the stretch.
    pub fn counts(&self) -> [usize; 4] {
        [
            self.count(ContactState::Stick),
            self.count(ContactState::Slip { sign: 1 }),
            self.count(ContactState::Slip { sign: -1 }),
            self.count(ContactState::Free),
        ]
    }

    /// Number of candidates in this state at the equilibria inside the stretch.
    pub fn count(&self, state: ContactState) -> usize {
        let states = self.equilibrium_states().iter();
        states.filter(|s| **s == state).count()
    }

    /// [`Equilibrium::picture`] of the equilibria inside the stretch.
    pub fn picture(&self) -> String {
        self.inside.picture()
    }
}
