//! The quasi-static loading of section 5, event by event: press the glued side CD until the normal
//! resultant is N, then move it to the left, with unilateral contact (1) and Coulomb friction (2).
//!
//! The path is piecewise linear in the motion, so nothing is stepped: on each stretch everything
//! is affine, and the motion at which the next node reaches a limit is a rational number. There
//! the rate problem - which nodes stick, slip, open or close in the next moment - is solved by an
//! active set from the states before, exactly; if that comes back to a set of states it has tried,
//! the project's own pivoting proposes states in doubles, which are then verified exactly like the
//! others.
//!
//! The pressing is proportional to its depth, so it is one rate problem from the unloaded block.
//! Sliding has begun when no node sticks: reactions are constant from then on.
//!
//! A rate problem may have several solutions (with much friction it often has, `rates_oracle`). The
//! states nearest to those before are taken, and verified. At a point with a set of nodes on the
//! friction cone its matrix is T(mu), the condensed pencil of these nodes: there is one solution
//! for every load rate if and only if T(mu) is a P-matrix. `tests/paper/path_states.rs` proves that
//! for the path of the paper's block at mu = 1.1; in general it is not claimed.
//!
//! A user makes a [`Contact`] of a [`crate::Block`], follows a [`LoadingPath`] and takes from it
//! the contact states whose eigenproblems are solved, as a problem ([`Interval::problem`]) or as a
//! condensed pencil ([`Pencils`]). The files, from the input on:
//!
//! | file | what |
//! |---|---|
//! | `contact`, `loading` | the condensed stiffness C, the loads; friction, force and range |
//! | `trace` | the walk from event to event |
//! | `rates`, `propose` | the states after an event; proposals by Lemke's method in doubles |
//! | `respond`, `linear` | displacements and reactions in given states, by exact linear algebra |
//! | `line` | u and r as functions of the motion, the next event, the classes of nodes there |
//! | `check` | the laws at a point of the path, from their definitions |
//! | `loading_path`, `stretch` | the result |
//! | `pencils` | the condensed pencil of a set of states |
//! | `step`, `compare` | incremental stepping in doubles, and how far it is from the path |

mod check;
mod compare;
mod contact;
mod error;
mod line;
mod linear;
mod loading;
mod loading_path;
mod pencils;
mod propose;
mod rates;
#[cfg(test)]
mod rates_oracle;
mod respond;
mod step;
mod stretch;
mod trace;

pub use compare::Comparison;
pub use contact::Contact;
pub use error::PathError;
pub use line::{Bound, Equilibrium};
pub use loading::Loading;
pub use loading_path::{LoadingPath, PathEnd};
pub use pencils::Pencils;
pub use rates::Finder;
pub use step::{Step, step_path};
pub use stretch::{Change, Event, Interval};

use mceip_exact::Rational;
use std::ops::ControlFlow;

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
}
