//! The pivotal path of the linear subproblem, from t = 0 at the start to the Newton point at t = 1
//! (Ralph 1994; Dirkse and Ferris 1995, section 3).
//!
//! On the path M z - w + v + D a + (1 - t) r + q = 0. Here w_i >= 0 is the multiplier of the lower
//! bound of z_i, not zero only where z_i is at it, and v_i >= 0 that of the upper bound; r is minus
//! the residual at the start, so that t = 0 holds there; and the artificials a repair a singular
//! starting basis. As in Lemke's method, each pivot exchanges the unknown that reaches a bound for
//! the one that moves, and the complement of the former moves next. Ties are broken
//! lexicographically: the right-hand side is thought perturbed by the first basis times (eps,
//! eps^2, ...), so that in exact arithmetic no basis repeats on a path that starts on a ray.
//!
//! Input: a [`Subproblem`], the kind of start and the current point. Output: a [`Path`], its knots
//! and pivots and the reason why it ended. Called by `newton` and `linear`.
//!
//! | file | what |
//! |---|---|
//! | `variable`, `subproblem`, `record` | names and pivots; M, q and bounds; what a path leaves |
//! | `columns`, `factor`, `basis` | the matrix, its factors, exchanges since |
//! | `start` | the two starts, with the repair of singular ones |
//! | `tableau`, `walk` | the state and its moves; the pivot loop |
//! | `block`, `ratio` | what stops a move; the ratio test |
//! | `knots` | the breakpoints, and points between them |
//!
//! All storage is kept from one path to the next: a path no longer than one before allocates
//! nothing.

mod basis;
mod block;
mod columns;
mod factor;
mod knots;
mod ratio;
mod record;
mod start;
mod subproblem;
mod tableau;
mod variable;
mod walk;

pub use record::{PathEnd, Start};
pub use variable::{Pivot, PivotKind, Variable};

use super::number::PathNumber;
use basis::Basis;
use columns::PathFrame;
pub(super) use record::{Path, PathLimits};
use start::{FreeRows, start_point, starting_basis};
pub(super) use subproblem::Subproblem;
use tableau::{PathState, PathTableau};
use walk::{EntryCounts, PathWalk};

/// What paths are followed with.
pub(super) struct PathStorage<T = f64> {
    frame: PathFrame<T>,
    basis: Basis<T>,
    state: PathState<T>,
    /// Times each unknown has begun to move, for the guard against cycles.
    entries: Vec<EntryCounts>,
    free: FreeRows<T>,
}

impl<T> Default for PathStorage<T> {
    fn default() -> Self {
        PathStorage {
            frame: PathFrame::default(),
            basis: Basis::default(),
            state: PathState::default(),
            entries: Vec::new(),
            free: FreeRows::default(),
        }
    }
}

impl<T: PathNumber> PathStorage<T> {
    /// Follows the path from a start into `path`; a regular one begins over `current`, within the
    /// bounds.
    pub(super) fn follow(
        &mut self,
        sub: &Subproblem<'_, T>,
        start: Start,
        current: &[T],
        limits: PathLimits,
        path: &mut Path<T>,
    ) {
        let PathStorage {
            frame,
            basis,
            state,
            entries,
            free,
        } = self;

        path.begin(start, current.len());

        start_point(sub, start, current, state, free);
        frame.set(sub, &state.z, &state.multiplier);

        if starting_basis(sub, frame, basis, state, path) {
            let tableau = PathTableau::new(frame.columns(sub), basis, state);
            PathWalk::new(tableau, limits, entries, path).run();
        }
    }
}

#[cfg(test)]
mod tests;
