//! The rate problem: which nodes on their limits stick, slip, open or stay open in the next
//! moment. An active set from the state before, else the project's pivoting; exact signs decide.

use super::PathError;
use super::contact::{Contact, Friction, Load, Response, respond};
use super::line::{Bound, Class};
use super::linear::Images;
use super::propose::propose;
use crate::exact::Integer;
use crate::model::ContactState;
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
}

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
    pub(super) fn solve(&self, images: &mut Images, start: &[ContactState]) -> Result<Solved, PathError> {
        let start: Vec<ContactState> = self.classes.iter().zip(start).map(|(&c, &s)| first_guess(c, s)).collect();
        let mut tried = 0;
        for finder in [Finder::ActiveSet, Finder::OneByOne] {
            if let Some(solved) = self.iterate(images, start.clone(), finder, &mut tried) {
                return Ok(solved);
            }
        }
        if let Some(states) = propose(self.contact, self.friction, self.classes, self.moving) {
            if let Some(solved) = self.iterate(images, states, Finder::Pivoting, &mut tried) {
                return Ok(solved);
            }
        }
        Err(PathError::NoContinuation { tried })
    }

    /// Follows the violations from `states` until there is none (or a set of states comes back).
    fn iterate(&self, images: &mut Images, mut states: Vec<ContactState>, finder: Finder, tried: &mut usize) -> Option<Solved> {
        let mut seen = BTreeSet::new();
        while seen.insert(code(&states)) {
            *tried += 1;
            let loads = (self.loads)(&states);
            let response = respond(self.contact, images, self.friction, &states, &loads)?;
            let at = loads.iter().position(|&l| l == self.moving)?;
            let (u, r) = (&response.u[at], &response.r[at]);
            let better = |k: usize| better(k, self.classes[k], states[k], u, r, self.friction);
            let changes: Vec<(usize, ContactState)> = (0..states.len()).filter_map(|k| better(k).map(|s| (k, s))).collect();
            if changes.is_empty() {
                return Some(Solved { states, loads, response, finder, tried: *tried });
            }
            let count = if finder == Finder::OneByOne { 1 } else { changes.len() };
            changes.into_iter().take(count).for_each(|(k, s)| states[k] = s);
        }
        None
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
fn better(node: usize, class: Class, state: ContactState, u: &[Integer], r: &[Integer], friction: &Friction) -> Option<ContactState> {
    let negative = |b: Bound| b.value(u, r, friction).is_negative();
    let slides_wrongly = |sign: i8| (&u[2 * node] * Integer::from(sign)).is_positive(); // S v_T <= 0
    match (class, state) {
        (Class::Cone(_), ContactState::Slip { sign }) => slides_wrongly(sign).then_some(ContactState::Stick),
        (Class::Cone(sign), ContactState::Stick) => negative(Bound::Cone { node, sign }).then_some(ContactState::Slip { sign }),
        (Class::Zero, ContactState::Free) => negative(Bound::Gap { node }).then_some(ContactState::Stick),
        (Class::Zero, ContactState::Stick | ContactState::Slip { .. }) if negative(Bound::Pressure { node }) => Some(ContactState::Free),
        (Class::Zero, ContactState::Slip { sign }) => slides_wrongly(sign).then_some(ContactState::Stick),
        (Class::Zero, ContactState::Stick) => {
            [1, -1].into_iter().find(|&sign| negative(Bound::Cone { node, sign })).map(|sign| ContactState::Slip { sign })
        }
        _ => None,
    }
}

/// Do the rates fit class and state? The same lines as [`better`], read as (9): used to verify.
pub(super) fn admissible(class: Class, state: ContactState, node: usize, u: &[Integer], r: &[Integer], friction: &Friction) -> bool {
    let possible = match (class, state) {
        (Class::Free, ContactState::Free) | (Class::Stick, ContactState::Stick) | (Class::Cone(_), ContactState::Stick) => true,
        (Class::Cone(s), ContactState::Slip { sign }) => s == sign,
        (Class::Zero, _) => true,
        _ => false,
    };
    possible && better(node, class, state, u, r, friction).is_none() && (state != ContactState::Stick || u[2 * node].is_zero())
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
