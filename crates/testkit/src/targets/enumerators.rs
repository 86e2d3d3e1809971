//! The complete search against the plain enumerator.
//!
//! Input: bytes of a fuzzer, which make a small pencil and a window. A disagreement is a panic.
//! Called by the fuzz target `complete_against_plain`.

use super::{matrix_of, order, problem_of};
use crate::compare::engines;
use crate::completed::compare_within;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::file::write_problem;
use mceip_model::{Problem, Window};

/// The complete search, cut short after few nodes, says nothing that the plain enumerator does not;
/// and a set it calls complete is the plain one's.
pub fn complete_against_plain(data: &[u8]) {
    let Some(problem) = windowed(data) else {
        return;
    };

    let plain = match engines(&problem) {
        Ok((_, plain)) => plain,
        Err(refused) => panic!("{refused}: {}", write_problem(&problem)),
    };

    if let Err(disagreement) = compare_within(&problem, &plain, NODES) {
        panic!("{disagreement}: {}", write_problem(&problem));
    }
}

/// Nodes per piece of the complete search.
const NODES: usize = 300;

/// A bit of the first byte: B is the identity.
const IDENTITY: u8 = 0x20;

/// A pencil of order 1 to 4 in a window. The first byte chooses the form, the second the free
/// variables, the third the window; the others are the entries.
fn windowed(data: &[u8]) -> Option<Problem> {
    let head = *data.first()?;
    let mask = *data.get(1)?;
    let view = *data.get(2)?;
    let entries = &data[3..];

    let n = order(head);
    let matrix = |power: usize| matrix_of(entries, n, power * n * n, |byte| number(head, byte));
    let [a, mut b, c] = [0, 1, 2].map(matrix);
    if head & IDENTITY != 0 {
        b = Sparse::identity(n);
    }

    problem_of([a, b, c], head, mask, window(view)?)
}

/// The lowest three bits are the lower end, the next three the width, both in halves; the highest
/// two say which of the ends there are.
fn window(view: u8) -> Option<Window> {
    let min = rational(i64::from(view & 7), 2);
    let width = rational(i64::from(view >> 3 & 7), 2);
    let window = match view >> 6 {
        0 => Window::new(min.clone(), Some(min + width)),
        1 => Window::new(min, None),
        _ => Ok(Window::all()),
    };
    window.ok()
}

/// Small integers, or numbers of very different size; `head` chooses which.
fn number(head: u8, byte: u8) -> Rational {
    let small = whole(i64::from(byte % 9) - 4);
    match (head >> 6, byte / 9 % 4) {
        (1, 1) => small * whole(1_000_003),
        (1, 2) => small / whole(1_000_003),
        (2, 1) => small + rational(1, 1 << 40),
        (2, 2) => small - rational(1, 1 << 40),
        (3, d) => small / whole(i64::from(d) + 1),
        _ => small,
    }
}
