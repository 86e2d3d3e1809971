//! The quasi-static loading of section 5, event by event: press the glued side CD until the normal
//! resultant is N, then move it to the left, with unilateral contact (1) and Coulomb friction (2).
//!
//! The path is piecewise linear in the motion, so nothing is stepped: on each stretch everything
//! is affine, and the motion at which the next node reaches a limit is a rational number. There
//! the rate problem - which nodes stick, slip, open or close in the next moment - is solved by an
//! active set from the states before, exactly; if that goes round in circles, the project's own
//! pivoting proposes states in doubles, which are then verified exactly like the others.
//!
//! The pressing is proportional to its depth, so it is one rate problem from the unloaded block.
//! Sliding has begun when no node sticks: reactions are constant from then on.
//!
//! A rate problem may have several solutions (with much friction it often has, `rates_oracle`). The
//! states nearest to those before are taken; they are verified, their uniqueness is not claimed.

mod check;
mod compare;
mod contact;
mod error;
mod line;
mod linear;
mod pencils;
mod propose;
mod rates;
#[cfg(test)]
mod rates_oracle;
mod step;
mod trace;

pub use compare::Comparison;
pub use contact::Contact;
pub use error::PathError;
pub use line::{Bound, Equilibrium};
pub use pencils::Pencils;
pub use rates::Finder;
pub use step::{Step, step_path};

use super::block::Block;
use mceip_exact::{Rational, rational, whole};
use mceip_model::{ContactState, ModelError, Problem};
use num_traits::Signed;
use std::ops::ControlFlow;

/// How the block is loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loading {
    /// Coefficient of friction mu > 0.
    pub friction: Rational,
    /// Normal force N > 0 at the end of the pressing, N.
    pub force: Rational,
    /// Motion of the glued side at which to stop, mm; `None` to follow the path to its last event.
    pub until: Option<Rational>,
}

impl Loading {
    /// The paper's loading: mu = 1.1, 55 N, until nothing more happens.
    pub fn of_the_paper() -> Loading {
        Loading {
            friction: rational(11, 10),
            force: whole(55),
            until: None,
        }
    }

    fn validate(&self) -> Result<(), PathError> {
        let range = self
            .until
            .as_ref()
            .map(|u| ("the range of the motion (mm)", u));
        let all = [
            ("friction", &self.friction),
            ("the normal force (N)", &self.force),
        ];
        match all.into_iter().chain(range).find(|(_, v)| !v.is_positive()) {
            Some((what, v)) => Err(PathError::NotPositive {
                what,
                got: v.clone(),
            }),
            None => Ok(()),
        }
    }
}

/// A node that goes from one state to another at an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// Contact node, from 0 at the left.
    pub node: usize,
    /// State before.
    pub from: ContactState,
    /// State after.
    pub to: ContactState,
}

/// What happens between two stretches of the path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// The bounds that became zero; none at the end of the pressing.
    pub causes: Vec<Bound>,
    /// The nodes that change state.
    pub changes: Vec<Change>,
    /// How the states after it were found.
    pub finder: Finder,
    /// Sets of states tried.
    pub tried: usize,
}

impl Event {
    fn new(causes: Vec<Bound>, changes: Vec<Change>, finder: Finder, tried: usize) -> Event {
        Event {
            causes,
            changes,
            finder,
            tried,
        }
    }
}

/// A stretch of the path with constant states; (1), (2), (5), (7) were verified at both ends.
#[derive(Debug, Clone)]
pub struct Interval {
    /// The event it begins with.
    pub begin: Event,
    /// States of the contact nodes inside the stretch, left to right.
    pub states: Vec<ContactState>,
    /// The equilibrium at its beginning.
    pub start: Equilibrium,
    /// The equilibrium at its end, `None` if it never ends.
    pub stop: Option<Equilibrium>,
}

impl Interval {
    /// Number of nodes that stick, slip to the left (S = 1), slip to the right (S = -1), are free.
    pub fn counts(&self) -> [usize; 4] {
        let count = |f: fn(&ContactState) -> bool| self.states.iter().filter(|s| f(s)).count();
        [
            count(|s| *s == ContactState::Stick),
            count(|s| matches!(s, ContactState::Slip { sign: 1 })),
            count(|s| matches!(s, ContactState::Slip { sign: -1 })),
            count(|s| *s == ContactState::Free),
        ]
    }

    /// One letter for each node: `.` stick, `<` slip to the left, `>` to the right, `o` free.
    pub fn picture(&self) -> String {
        self.states.iter().map(|s| letter(*s)).collect()
    }

    /// The MCEIP-mu problem of its states, or MCEIP-lambda2 at a given mu.
    ///
    /// # Errors
    /// [`ModelError`] if no node slips.
    pub fn problem(
        &self,
        block: &Block,
        friction: Option<Rational>,
    ) -> Result<Problem, ModelError> {
        block.problem(&self.states, friction)
    }
}

/// `.` stick, `<` slip to the left (S = 1), `>` slip to the right, `o` free.
fn letter(state: ContactState) -> char {
    match state {
        ContactState::Free => 'o',
        ContactState::Stick => '.',
        ContactState::Slip { sign } => {
            if sign > 0 {
                '<'
            } else {
                '>'
            }
        }
    }
}

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
    /// Follows the path of a block; `progress` hears of each stretch (its number, the motion in mm)
    /// and may break off.
    ///
    /// # Errors
    /// [`PathError`]: options out of range, a moment after which no states are admissible.
    ///
    /// ```
    /// use mceip_paper::{
    ///     Block, BlockModel,
    ///     path::{Contact, Loading, LoadingPath},
    /// };
    /// let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
    /// let contact = Contact::of(&block).unwrap();
    /// let path = LoadingPath::follow(&contact, &Loading::of_the_paper(), &|_, _| {
    ///     std::ops::ControlFlow::Continue(())
    /// })
    /// .unwrap();
    /// assert!(path.slides());
    /// ```
    pub fn follow(
        contact: &Contact,
        loading: &Loading,
        progress: &dyn Fn(usize, &Rational) -> ControlFlow<()>,
    ) -> Result<LoadingPath, PathError> {
        trace::trace(contact, loading, progress)
    }

    /// Does the path end in sliding: no node sticks, and nothing changes any more?
    pub fn slides(&self) -> bool {
        self.end == PathEnd::NoFurtherEvent
            && self
                .intervals
                .last()
                .is_some_and(|i| !i.states.contains(&ContactState::Stick))
    }

    /// The event that ends a stretch, `None` for the last one.
    pub fn ending(&self, stretch: usize) -> Option<&Event> {
        self.intervals.get(stretch + 1).map(|next| &next.begin)
    }

    /// The stretches with exactly these states, in order.
    pub fn stretches_with(&self, states: &[ContactState]) -> Vec<usize> {
        (0..self.intervals.len())
            .filter(|&i| self.intervals[i].states == states)
            .collect()
    }
}
