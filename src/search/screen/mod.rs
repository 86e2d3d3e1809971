//! The fast 2^n enumerator: the answer of [`crate::oracle::enumerate`], most supports discarded with proof.
//!
//! 1. The determinant of every support, exactly: values modulo primes by a walk through the tree of
//!    supports that shares elimination steps (`minors`; free variables are eliminated once, which
//!    for MCEIP-mu is the condensation), coefficients by interpolation and the Chinese remainder
//!    theorem up to Hadamard's bound (`integral`, `coefficients`).
//! 2. Supports whose determinant has no root in the window: Bernstein coefficients with error
//!    bounds (`bernstein`).
//! 3. Supports refuted by the signs of a row (`signs`).
//! 4. Supports refuted by a Farkas vector on each piece that may hold a root, found in doubles,
//!    verified with a rounding-error bound (`farkas`, on the exactly condensed pencil, `floats`).
//! 5. Everything else, so every solution, every tie, every singular pencil, goes to the oracle's
//!    exact code for that one support.
//!
//! No discard rests on a tolerance: 1 and 3 are exact, 2 and 4 carry proved bounds. The result
//! does not depend on the number of threads.

mod bernstein;
mod coefficients;
mod farkas;
mod filter;
mod floats;
mod integral;
mod minors;
mod run;
mod signs;
mod statistics;

pub use run::{Part, Screen, coefficient_bits, examine_exactly, examine_one, support};
pub use statistics::Statistics;

use crate::model::{Pencil, Window};
use crate::oracle::Enumeration;
use std::ops::ControlFlow;

/// Largest number of complementarity variables: 2^24 supports are minutes, each one more doubles them.
pub const MAX_SLIP: usize = 24;
/// Largest number of free variables: what the oracle's exact code, which treats the rest, takes.
pub const MAX_FREE: usize = crate::oracle::MAX_FREE;
/// Largest bound of a determinant's coefficients, in bits: time grows with the square of it.
pub const MAX_BITS: u64 = 8192;

/// Why the screened enumerator refuses to start.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ScreenError {
    /// Too many supports, too large pencils, or too long numbers.
    #[error("the screened enumerator takes at most {limit} {what}, got {got}")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// The bound.
        limit: u64,
        /// What the problem has.
        got: u64,
    },
    /// A range of supports that the problem does not have.
    #[error("supports {start}..{end}: expected start <= end <= {total}")]
    Range {
        /// First support.
        start: u64,
        /// One past the last.
        end: u64,
        /// Supports of the problem.
        total: u64,
    },
}

/// All solutions of the mixed complementarity eigenproblem with value in the window, as
/// [`crate::oracle::enumerate`] gives them, and how many supports each filter settled.
///
/// # Errors
/// [`ScreenError::TooLarge`] beyond [`MAX_SLIP`], [`MAX_FREE`] or [`MAX_BITS`].
///
/// ```
/// use mceip::{exact::Sparse, model::{Pencil, Window}, search::screen};
/// let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
/// let (found, statistics) = screen::enumerate(&Pencil::new(a, Sparse::identity(2), vec![]).unwrap(), &Window::all()).unwrap();
/// assert_eq!(found.solutions.iter().map(|s| s.decimal(17)).collect::<Vec<_>>(), ["2", "3"]);
/// assert_eq!(statistics.total(), 4);
/// ```
pub fn enumerate(pencil: &Pencil, window: &Window) -> Result<(Enumeration, Statistics), ScreenError> {
    let screen = Screen::new(pencil, window)?;
    let part = screen.run(0..screen.supports(), |_| ControlFlow::Continue(()))?;
    let mut found = part.enumeration;
    found.describe(pencil, window);
    Ok((found, part.statistics))
}
