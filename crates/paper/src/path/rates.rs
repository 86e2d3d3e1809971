//! The rate problem: which nodes on their limits stick, slip, open or stay open in the next
//! moment. An active set from the state before, else the project's pivoting; exact signs decide.

use super::contact::{Contact, Friction, Load, Response};
use super::error::PathError;
use super::line::{Bound, Class};
use super::linear::Images;
use super::propose::propose;
use super::respond::respond;
use mceip_exact::Integer;
use mceip_model::ContactState;
use num_traits::{Signed, Zero};
use std::collections::BTreeSet;

/// How the states after an event were found (they were verified exactly in any case).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finder {
    /// Every violated node changed at once, from the state before.
    ActiveSet,
    /// One violated node at a time.
    OneByOne,
    /// Lemke's method on the rate problem in doubles.
    Pivoting,
    /// Every set of states in turn.
    Enumeration,
}

/// Most sets of states that are tried in turn when nothing else helps.
const ENUMERATED: usize = 1024;

/// The rate problem of one moment.
pub(super) struct Rates<'a> {
    pub(super) contact: &'a Contact,
    pub(super) friction: &'a Friction,
    pub(super) classes: &'a [Class],
    /// What is imposed, and which of it grows.
    pub(super) loads: &'a dyn Fn(&[ContactState]) -> Vec<Load>,
    pub(super) moving: Load,
}

/// States that solve the rate problem, with the response to every load in them.
pub(super) struct Solved {
    pub(super) states: Vec<ContactState>,
    pub(super) loads: Vec<Load>,
    pub(super) response: Response,
    pub(super) finder: Finder,
    /// Sets of states tried, this one included.
    pub(super) tried: usize,
}

impl Rates<'_> {
    /// Solves it; `start` holds the states before.
    pub(super) fn solve(
        &self,
        images: &mut Images,
        start: &[ContactState],
    ) -> Result<Solved, PathError> {
        let start: Vec<ContactState> = self
            .classes
            .iter()
            .zip(start)
            .map(|(&c, &s)| first_guess(c, s))
            .collect();
        let mut tried = 0;
        for finder in [Finder::ActiveSet, Finder::OneByOne] {
            if let Some(solved) = self.iterate(images, start.clone(), finder, &mut tried) {
                return Ok(solved);
            }
        }
        let proposed = propose(self.contact, self.friction, self.classes, self.moving);
        match proposed.and_then(|states| self.iterate(images, states, Finder::Pivoting, &mut tried))
        {
            Some(solved) => Ok(solved),
            None => self.enumerate(images, &mut tried),
        }
    }

    /// Tries every set of states, if there are few. Without a singular one among them, a failure
    /// proves that the quasi-static path has no continuation.
    fn enumerate(&self, images: &mut Images, tried: &mut usize) -> Result<Solved, PathError> {
        let mut sets: Vec<Vec<ContactState>> = vec![Vec::new()];
        for class in self.classes {
            let choices = choices(*class);
            if sets.len() * choices.len() > ENUMERATED {
                return Err(PathError::NoContinuation {
                    tried: *tried,
                    all: false,
                });
            }
            sets = sets
                .into_iter()
                .flat_map(|set| {
                    choices
                        .iter()
                        .map(move |c| set.iter().copied().chain([*c]).collect())
                })
                .collect();
        }
        let mut singular = false;
        for states in sets {
            *tried += 1;
            match self.attempt(images, &states) {
                None => singular = true,
                Some(attempt) if attempt.changes.is_empty() => {
                    return Ok(attempt.solved(states, Finder::Enumeration, *tried));
                }
                Some(_) => {}
            }
        }
        Err(PathError::NoContinuation {
            tried: *tried,
            all: !singular,
        })
    }

    /// The response in these states and what contradicts them; `None` if singular.
    fn attempt(&self, images: &mut Images, states: &[ContactState]) -> Option<Attempt> {
        let loads = (self.loads)(states);
        let response = respond(self.contact, images, self.friction, states, &loads)?;
        let at = loads.iter().position(|&l| l == self.moving)?;
        let (u, r) = (&response.u[at], &response.r[at]);
        let better = |k: usize| better(k, self.classes[k], states[k], u, r, self.friction);
        let changes = (0..states.len())
            .filter_map(|k| better(k).map(|s| (k, s)))
            .collect();
        Some(Attempt {
            loads,
            response,
            changes,
        })
    }

    /// Follows the violations from `states` until there is none (or a set of states comes back).
    fn iterate(
        &self,
        images: &mut Images,
        mut states: Vec<ContactState>,
        finder: Finder,
        tried: &mut usize,
    ) -> Option<Solved> {
        let mut seen = BTreeSet::new();
        while seen.insert(code(&states)) {
            *tried += 1;
            let attempt = self.attempt(images, &states)?;
            if attempt.changes.is_empty() {
                return Some(attempt.solved(states, finder, *tried));
            }
            let count = if finder == Finder::OneByOne {
                1
            } else {
                states.len()
            };
            attempt
                .changes
                .into_iter()
                .take(count)
                .for_each(|(k, s)| states[k] = s);
        }
        None
    }
}

/// A set of states tried.
struct Attempt {
    loads: Vec<Load>,
    response: Response,
    /// Nodes whose rates contradict their state, with the state to try instead.
    changes: Vec<(usize, ContactState)>,
}

impl Attempt {
    fn solved(self, states: Vec<ContactState>, finder: Finder, tried: usize) -> Solved {
        Solved {
            states,
            loads: self.loads,
            response: self.response,
            finder,
            tried,
        }
    }
}

/// The states that a node of this class may take.
fn choices(class: Class) -> Vec<ContactState> {
    let slip = |sign| ContactState::Slip { sign };
    match class {
        Class::Free => vec![ContactState::Free],
        Class::Stick => vec![ContactState::Stick],
        Class::Cone(sign) => vec![slip(sign), ContactState::Stick],
        Class::Zero => vec![ContactState::Free, ContactState::Stick, slip(1), slip(-1)],
    }
}

/// A node that has just arrived at a limit is taken to pass it.
fn first_guess(class: Class, before: ContactState) -> ContactState {
    match (class, before) {
        (Class::Free, _) => ContactState::Free,
        (Class::Stick, _) => ContactState::Stick,
        (Class::Cone(sign), _) => ContactState::Slip { sign },
        (Class::Zero, ContactState::Slip { .. }) => ContactState::Free,
        (Class::Zero, _) => ContactState::Stick,
    }
}

/// The state to try instead, if the rates contradict this one: (9) with rates for (v, w), and for
/// nodes with zero reaction its last two lines.
fn better(
    node: usize,
    class: Class,
    state: ContactState,
    u: &[Integer],
    r: &[Integer],
    friction: &Friction,
) -> Option<ContactState> {
    let negative = |b: Bound| b.value(u, r, friction).is_negative();
    // S v_T <= 0.
    let slides_wrongly = |sign: i8| (&u[2 * node] * Integer::from(sign)).is_positive();
    match (class, state) {
        (Class::Cone(_), ContactState::Slip { sign }) => {
            slides_wrongly(sign).then_some(ContactState::Stick)
        }
        (Class::Cone(sign), ContactState::Stick) => {
            negative(Bound::Cone { node, sign }).then_some(ContactState::Slip { sign })
        }
        (Class::Zero, ContactState::Free) => {
            negative(Bound::Gap { node }).then_some(ContactState::Stick)
        }
        (Class::Zero, ContactState::Stick | ContactState::Slip { .. })
            if negative(Bound::Pressure { node }) =>
        {
            Some(ContactState::Free)
        }
        (Class::Zero, ContactState::Slip { sign }) => {
            slides_wrongly(sign).then_some(ContactState::Stick)
        }
        (Class::Zero, ContactState::Stick) => [1, -1]
            .into_iter()
            .find(|&sign| negative(Bound::Cone { node, sign }))
            .map(|sign| ContactState::Slip { sign }),
        _ => None,
    }
}

/// Do the rates fit class and state? The same lines as [`better`], read as (9): used to verify.
pub(super) fn admissible(
    class: Class,
    state: ContactState,
    node: usize,
    u: &[Integer],
    r: &[Integer],
    friction: &Friction,
) -> bool {
    let possible = match (class, state) {
        (Class::Free, ContactState::Free)
        | (Class::Stick, ContactState::Stick)
        | (Class::Cone(_), ContactState::Stick) => true,
        (Class::Cone(s), ContactState::Slip { sign }) => s == sign,
        (Class::Zero, _) => true,
        _ => false,
    };
    possible
        && better(node, class, state, u, r, friction).is_none()
        && (state != ContactState::Stick || u[2 * node].is_zero())
}

/// States as small numbers, for the set of those seen.
fn code(states: &[ContactState]) -> Vec<i8> {
    let digit = |s: &ContactState| match s {
        ContactState::Free => 0,
        ContactState::Stick => 2,
        ContactState::Slip { sign } => *sign,
    };
    states.iter().map(digit).collect()
}
