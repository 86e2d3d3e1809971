//! The rate problem: which candidates on their limits stick, slip, open or stay open in the next
//! moment.
//!
//! The class of a node at an equilibrium ([`Class`]) says which of (9) it has to satisfy, with the
//! rates of displacement and reaction for v and w. A set of states makes these conditions linear
//! equations (`respond`); it solves the rate problem if the signs of the solution contradict no
//! state ([`better`]). Sets are tried in this order: an active set from the states before, all
//! violated nodes at once and then one at a time; what Lemke's method proposes (`propose`); every
//! set there is. All signs are exact. Called by `trace` once for each event.

use super::contact::{Contact, FrictionCoefficients, Load, NodalValues, Response};
use super::error::PathError;
use super::line::{Bound, Class};
use super::linear::Images;
use super::propose::propose;
use super::respond::respond;
use mceip_exact::Integer;
use mceip_model::ContactState;
use num_traits::Signed;
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

/// Why no states were found that solve a rate problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unsolved {
    /// Every set was tried and none was singular: there is no continuation, proved.
    NoneExists,
    /// Every set was tried, and some have no unique rates: the body can move in a way that needs
    /// no force.
    Singular {
        /// Number of sets of states.
        all: usize,
        /// Those that have no unique rates.
        singular: usize,
    },
    /// There are more than 1,024 sets, too many to try all.
    Stopped {
        /// Sets tried (some of them more than once).
        tried: usize,
    },
}

impl Unsolved {
    /// Is it proved that there is no continuation?
    pub fn is_proved(self) -> bool {
        self == Unsolved::NoneExists
    }
}

impl std::fmt::Display for Unsolved {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Unsolved::NoneExists => {
                f.write_str("no states satisfy the rate conditions, every set was tried")
            }
            Unsolved::Singular { all: 1, .. } => f.write_str(
                "the body can move in a way that needs no force, so its rates are not unique",
            ),
            Unsolved::Singular { all, singular } => write!(
                f,
                "no admissible states; in {singular} of all {all} sets of states the body can move \
                 in a way that needs no force, so its rates are not unique"
            ),
            Unsolved::Stopped { tried } => {
                write!(f, "no admissible states among {tried} sets tried")
            }
        }
    }
}

/// Most sets of states that are tried in turn when nothing else helps.
const ENUMERATED: usize = 1024;

/// The rate problem of one moment.
pub(super) struct Rates<'a> {
    pub(super) contact: &'a Contact,
    pub(super) friction: &'a FrictionCoefficients,
    /// The class of each node at this moment.
    pub(super) classes: &'a [Class],
    /// The bounds that candidates have just reached.
    pub(super) causes: &'a [Bound],
    /// What is imposed on the body if the candidates are in given states.
    pub(super) loads: &'a dyn Fn(&[ContactState]) -> Vec<Load>,
    /// The load that grows.
    pub(super) growing: Load,
}

/// Every solution of a rate problem.
pub(super) struct AllRates {
    /// Those with the same rates once.
    pub(super) solved: Vec<Solved>,
    /// Sets of states that have no unique rates.
    pub(super) singular: usize,
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

impl Solved {
    /// The rates of w for a load, times the denominator of the response.
    fn rates(&self, growing: Load) -> Option<&[Integer]> {
        let load = self.loads.iter().position(|&load| load == growing)?;
        Some(&self.response.w[load])
    }
}

impl Rates<'_> {
    /// Solves it; `before` holds the states before.
    ///
    /// # Errors
    /// [`PathError::NoContinuation`] if no set of states that was tried solves it.
    pub(super) fn solve(
        &self,
        images: &mut Images,
        before: &[ContactState],
    ) -> Result<Solved, PathError> {
        let mut start = Vec::with_capacity(before.len());
        for (node, (&class, &state)) in self.classes.iter().zip(before).enumerate() {
            let has_arrived = self.causes.iter().any(|cause| cause.node() == node);
            start.push(first_guess(class, state, has_arrived));
        }

        let mut tried = 0;
        for finder in [Finder::ActiveSet, Finder::OneByOne] {
            if let Some(solved) = self.iterate(images, start.clone(), finder, &mut tried) {
                return Ok(solved);
            }
        }

        let proposed = propose(self.contact, self.friction, self.classes, self.growing);
        if let Some(states) = proposed
            && let Some(solved) = self.iterate(images, states, Finder::Pivoting, &mut tried)
        {
            return Ok(solved);
        }

        self.enumerate(images, &mut tried)
    }

    /// Follows the violations from `states` until there is none (or a set of states comes back).
    fn iterate(
        &self,
        images: &mut Images,
        mut states: Vec<ContactState>,
        finder: Finder,
        tried: &mut usize,
    ) -> Option<Solved> {
        let changed_at_once = if finder == Finder::OneByOne {
            1
        } else {
            states.len()
        };

        let mut seen = BTreeSet::new();
        while seen.insert(code(&states)) {
            *tried += 1;
            let attempt = self.attempt(images, &states)?;
            if attempt.corrections.is_empty() {
                return Some(attempt.solved(states, finder, *tried));
            }

            for correction in attempt.corrections.iter().take(changed_at_once) {
                states[correction.node] = correction.state;
            }
        }

        None
    }

    /// Tries every set of states, if there are few. Without a singular one among them, a failure
    /// proves that the quasi-static path has no continuation.
    fn enumerate(&self, images: &mut Images, tried: &mut usize) -> Result<Solved, PathError> {
        let Some(sets) = self.sets_of_states() else {
            return Err(PathError::NoContinuation(Unsolved::Stopped {
                tried: *tried,
            }));
        };

        let all = sets.len();
        let mut singular = 0;
        for states in sets {
            *tried += 1;
            match self.attempt(images, &states) {
                None => singular += 1,
                Some(attempt) if attempt.corrections.is_empty() => {
                    return Ok(attempt.solved(states, Finder::Enumeration, *tried));
                }
                Some(_) => {}
            }
        }

        Err(PathError::NoContinuation(match singular {
            0 => Unsolved::NoneExists,
            _ => Unsolved::Singular { all, singular },
        }))
    }

    /// Every solution there is; `None` if there are too many sets of states.
    pub(super) fn all(&self, images: &mut Images) -> Option<AllRates> {
        let mut all = AllRates {
            solved: Vec::new(),
            singular: 0,
        };
        for (k, states) in self.sets_of_states()?.into_iter().enumerate() {
            match self.attempt(images, &states) {
                None => all.singular += 1,
                Some(attempt) if attempt.corrections.is_empty() => {
                    let solved = attempt.solved(states, Finder::Enumeration, k + 1);
                    if !all
                        .solved
                        .iter()
                        .any(|other| self.same_rates(other, &solved))
                    {
                        all.solved.push(solved);
                    }
                }
                Some(_) => {}
            }
        }

        Some(all)
    }

    /// Do two solutions have the same rates? Then they lie where two pieces meet.
    fn same_rates(&self, one: &Solved, other: &Solved) -> bool {
        let (Some(v), Some(w)) = (one.rates(self.growing), other.rates(self.growing)) else {
            return false;
        };

        let (v_unit, w_unit) = (&one.response.denominator, &other.response.denominator);
        v.iter().zip(w).all(|(v, w)| v * w_unit == w * v_unit)
    }

    /// Every choice of a state for each node, the last node varying fastest; `None` if there are
    /// more than [`ENUMERATED`].
    fn sets_of_states(&self) -> Option<Vec<Vec<ContactState>>> {
        let mut sets: Vec<Vec<ContactState>> = vec![Vec::new()];

        for class in self.classes {
            let choices = choices(*class);
            if sets.len() * choices.len() > ENUMERATED {
                return None;
            }

            let mut longer = Vec::with_capacity(sets.len() * choices.len());
            for set in &sets {
                for &state in &choices {
                    let mut set = set.clone();
                    set.push(state);
                    longer.push(set);
                }
            }

            sets = longer;
        }

        Some(sets)
    }

    /// The response in these states and what contradicts them; `None` if singular.
    fn attempt(&self, images: &mut Images, states: &[ContactState]) -> Option<TriedStates> {
        let loads = (self.loads)(states);
        let response = respond(self.contact, images, self.friction, states, &loads)?;

        let growing = loads.iter().position(|&load| load == self.growing)?;
        let rates = NodalValues {
            w: &response.w[growing],
            r: &response.r[growing],
        };
        let mut corrections = Vec::new();
        for (node, &state) in states.iter().enumerate() {
            if let Some(state) = better(node, self.classes[node], state, rates, self.friction) {
                corrections.push(Correction { node, state });
            }
        }

        Some(TriedStates {
            loads,
            response,
            corrections,
        })
    }
}

/// A set of states tried.
struct TriedStates {
    loads: Vec<Load>,
    response: Response,
    corrections: Vec<Correction>,
}

/// A node whose rates contradict its state.
struct Correction {
    node: usize,
    /// The state to try instead.
    state: ContactState,
}

impl TriedStates {
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
    match class {
        Class::Free => vec![ContactState::Free],
        Class::Stick => vec![ContactState::Stick],
        Class::Cone(sign) => vec![ContactState::Stick, ContactState::Slip { sign }],
        Class::Zero => vec![
            ContactState::Free,
            ContactState::Stick,
            ContactState::Slip { sign: 1 },
            ContactState::Slip { sign: -1 },
        ],
    }
}

/// A candidate that has just arrived at a limit is taken to pass it; one that sticks on its cone
/// already is taken to go on.
fn first_guess(class: Class, before: ContactState, has_arrived: bool) -> ContactState {
    match (class, before) {
        (Class::Free, _) => ContactState::Free,
        (Class::Stick, _) => ContactState::Stick,
        (Class::Cone(_), ContactState::Stick) if !has_arrived => ContactState::Stick,
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
    rates: NodalValues<'_>,
    friction: &FrictionCoefficients,
) -> Option<ContactState> {
    match class {
        Class::Free | Class::Stick => None,
        Class::Cone(side) => better_on_cone(node, side, state, rates, friction),
        Class::Zero => better_without_reaction(node, state, rates, friction),
    }
}

/// On the cone 0 <= x _|_ y >= 0 with x = -S v_T, y = -(S r_T' + mu r_N'): slip has y = 0 and needs
/// x >= 0, stick has x = 0 and needs y >= 0.
fn better_on_cone(
    node: usize,
    side: i8,
    state: ContactState,
    rates: NodalValues<'_>,
    friction: &FrictionCoefficients,
) -> Option<ContactState> {
    match state {
        ContactState::Free | ContactState::Zero => None,
        ContactState::Slip { sign } => {
            slides_with_friction(sign, node, rates).then_some(ContactState::Stick)
        }
        ContactState::Stick => {
            let cone = Bound::Cone { node, sign: side };
            let slip = ContactState::Slip { sign: side };
            cone.falls(rates, friction).then_some(slip)
        }
    }
}

/// In contact with zero reaction, the rates satisfy what displacements and reactions themselves
/// satisfy: contact (1) first, then friction (2).
fn better_without_reaction(
    node: usize,
    state: ContactState,
    rates: NodalValues<'_>,
    friction: &FrictionCoefficients,
) -> Option<ContactState> {
    if state == ContactState::Free {
        let gap = Bound::Gap { node };
        return gap.falls(rates, friction).then_some(ContactState::Stick);
    }

    let pressure = Bound::Pressure { node };
    if pressure.falls(rates, friction) {
        return Some(ContactState::Free);
    }

    if let ContactState::Slip { sign } = state {
        return slides_with_friction(sign, node, rates).then_some(ContactState::Stick);
    }

    for sign in [1, -1] {
        let cone = Bound::Cone { node, sign };
        if cone.falls(rates, friction) {
            return Some(ContactState::Slip { sign });
        }
    }

    None
}

/// S v_T > 0: the node would slide the way friction pushes it, where S v_T <= 0 is wanted.
fn slides_with_friction(sign: i8, node: usize, rates: NodalValues<'_>) -> bool {
    let v_t = &rates.w[2 * node];
    let along = v_t * Integer::from(sign);
    along.is_positive()
}

/// States as small numbers, for the set of those seen.
fn code(states: &[ContactState]) -> Vec<i8> {
    states.iter().map(digit).collect()
}

fn digit(state: &ContactState) -> i8 {
    match state {
        ContactState::Free | ContactState::Zero => 0,
        ContactState::Stick => 2,
        ContactState::Slip { sign } => *sign,
    }
}
