//! The pivotal path of the linear subproblem, from t = 0 at the start to the Newton point at t = 1
//! (Ralph 1994; Dirkse and Ferris 1995, section 3).
//!
//! M z - w + v + D a + (1 - t) r + q = 0, with w and v complementary to the bounds of z,
//! artificials a in a singular starting basis, and r minus the residual at the start, so that t = 0
//! holds there. Like Lemke's method, one complementary pair is broken at a time. Ties are broken
//! lexicographically: the right-hand side is thought perturbed by the first basis times (eps,
//! eps^2, ...), so that in exact arithmetic no basis repeats on a path that starts on a ray.
//!
//! | file | what |
//! |---|---|
//! | `variable`, `subproblem`, `record` | names and pivots; M, q and bounds; what a path leaves |
//! | `columns`, `factor`, `basis` | the matrix, its factors, exchanges since |
//! | `start` | the two starts, with the repair of singular ones |
//! | `tableau`, `block`, `ratio`, `walk` | the state and its moves, what stops one, the ratio test, the pivot loop |
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

use super::number::Number;
use basis::Basis;
use columns::Frame;
pub(super) use record::{Limits, Path};
use start::{FreeRows, start_point, starting_basis};
pub(super) use subproblem::Subproblem;
use tableau::{State, Tableau};
use walk::Walk;

/// What paths are followed with.
pub(super) struct Storage<T = f64> {
    frame: Frame<T>,
    basis: Basis<T>,
    state: State<T>,
    entries: Vec<[usize; 3]>,
    free: FreeRows<T>,
}

impl<T> Default for Storage<T> {
    fn default() -> Self {
        Storage {
            frame: Frame::default(),
            basis: Basis::default(),
            state: State::default(),
            entries: Vec::new(),
            free: FreeRows::default(),
        }
    }
}

/// Follows the path from a start into `path`; a regular one begins over `current`, within the
/// bounds.
pub(super) fn follow<T: Number>(
    sub: &Subproblem<'_, T>,
    start: Start,
    current: &[T],
    limits: Limits,
    storage: &mut Storage<T>,
    path: &mut Path<T>,
) {
    let Storage {
        frame,
        basis,
        state,
        entries,
        free,
    } = storage;
    path.knots.clear(current.len());
    path.pivots.clear();
    (path.start, path.end, path.factorisations) = (start, PathEnd::Singular, 0);
    start_point(sub, start, current, state, free);
    frame.set(sub, &state.z, &state.multiplier);
    if starting_basis(sub, frame, basis, state, path) {
        let tableau = Tableau::new(frame.columns(sub), basis, state);
        Walk::new(tableau, limits, entries, path).run();
    }
}

#[cfg(test)]
mod tests;
