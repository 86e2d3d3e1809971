//! Quasi-static loading paths, event by event: a body with contact candidates under loads that are
//! applied one after the other, with unilateral contact (1) and Coulomb friction (2).
//!
//! Sections 2 to 5 of the paper begin with an equilibrium and its contact states. This crate finds
//! them from the loads. A path is piecewise linear in the amount of the load, so nothing is
//! stepped: on each stretch everything is affine, and the amount at which the next candidate
//! reaches a limit is a rational number. There the rate problem - which candidates stick, slip,
//! open or close in the next moment - is solved exactly: by an active set from the states before,
//! all violated candidates at once and then one at a time; where that comes back to a set of states
//! it has tried, or meets a singular one, from states that Lemke's method proposes in doubles; at
//! last by trying every set.
//!
//! A rate problem may have several solutions (with much friction it often has, `rates_oracle`). The
//! first that the search meets, which begins with the states before, is taken and verified, unless
//! another one is asked for ([`LoadSteps::taken`]). [`LoadingPath::rate_solutions`] lists them, or
//! says that there is one, whatever load grows.
//!
//! A user makes a [`Contact`] of a [`mceip_model::System`] and its loads ([`Contact::condense`]),
//! follows a [`LoadingPath`] and takes from it the contact states whose eigenproblems are solved.
//! The files, from the input on:
//!
//! | file | what |
//! |---|---|
//! | `condense` | from the body to its contact candidates, exactly or in doubles |
//! | `contact`, `load_steps` | the condensed stiffness C and loads; friction and amounts |
//! | `trace` | the walk from event to event |
//! | `rates`, `propose` | the states after an event; proposals by Lemke's method in doubles |
//! | `respond`, `linear` | displacements and reactions in given states, by exact linear algebra |
//! | `line` | w and r as functions of the load, the next event, the classes of candidates there |
//! | `check` | the laws at a point of the path, from their definitions |
//! | `loading_path`, `stretch` | the result |
//! | `pencils` | the condensed pencil of a set of states |
//! | `unique` | is the path the only one? |
//! | `loose` | where rounding alone holds the body, in doubles |
#![deny(clippy::float_arithmetic)]

mod check;
mod condense;
mod contact;
mod deformed;
mod error;
mod line;
mod linear;
mod load_steps;
mod loading_path;
mod loose;
mod pencils;
mod propose;
mod rates;
#[cfg(test)]
mod rates_oracle;
mod respond;
mod stretch;
mod trace;
mod unique;

pub use contact::{Contact, ContactSide};
pub use error::PathError;
pub use line::{Bound, Equilibrium};
pub use load_steps::{LoadSteps, require_positive};
pub use loading_path::{LoadingPath, LoadingPathEnd};
pub use pencils::Pencils;
pub use rates::{Finder, Unsolved};
pub use stretch::{Change, Event, Stretch};
pub use trace::PathProgress;
pub use unique::RateSolutions;

use std::ops::ControlFlow;

impl LoadingPath {
    /// Follows the path of a body that is unloaded at its beginning; `progress` hears of each
    /// stretch and may break off.
    ///
    /// # Errors
    /// [`PathError`]: steps that do not fit the loads. A path that cannot go on is no error, but a
    /// [`LoadingPathEnd`].
    ///
    /// ```
    /// use mceip_exact::{Sparse, rational, whole};
    /// use mceip_model::{ContactState, Particle, System};
    /// use mceip_path::{Contact, LoadSteps, LoadingPath};
    /// use std::ops::ControlFlow;
    ///
    /// // One particle on two springs, pressed by 3 and then pushed along with mu = 1/2.
    /// let candidate = Particle::plain(0, 1, ContactState::Free);
    /// let body = System::new(Sparse::from_ints(&[&[2, 0], &[0, 1]]), None, None, vec![candidate]);
    /// let press = vec![whole(0), whole(3)];
    /// let push = vec![whole(1), whole(0)];
    /// let contact = Contact::condense(&body.unwrap(), &[whole(0)], &[press, push]).unwrap();
    /// let steps = LoadSteps::new(rational(1, 2), vec![Some(whole(1)), Some(whole(2))]);
    /// let path = LoadingPath::follow(&contact, &steps, &|_| ControlFlow::Continue(())).unwrap();
    ///
    /// // It sticks until the push reaches mu N = 3/2.
    /// let last = path.stretches.last().unwrap();
    /// assert_eq!(last.start.amount(), &rational(3, 2));
    /// assert_eq!(last.states, [ContactState::Slip { sign: -1 }]);
    /// ```
    pub fn follow(
        contact: &Contact,
        steps: &LoadSteps,
        progress: &dyn Fn(PathProgress<'_>) -> ControlFlow<()>,
    ) -> Result<LoadingPath, PathError> {
        trace::trace(contact, steps, progress)
    }
}
