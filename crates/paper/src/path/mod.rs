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
