//! The complete search against the plain enumerator.

use crate::completed::compare_within;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::file::write_problem;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::enumerate;

/// The complete search, cut short after few nodes, says nothing that the plain enumerator does not;
/// and a set it calls complete is the plain one's.
pub fn complete_against_plain(data: &[u8]) {
    let Some((pencil, unknown, window)) = windowed(data) else {
        return;
    };

    let Ok(problem) = Problem::new(Body::Pencil(pencil.clone()), unknown, window.clone()) else {
        return;
    };

    let Ok(plain) = enumerate(&pencil, &window) else {
        panic!("the enumerator refuses {pencil:?}")
    };

    if let Err(disagreement) = compare_within(&problem, &plain, NODES) {
        panic!("{disagreement}: {}", write_problem(&problem));
    }
}

/// Nodes per piece of the complete search.
const NODES: usize = 300;

/// A pencil of order 1 to 4, its unknown and a window. The first two bytes choose the form, the
/// third the window.
fn windowed(data: &[u8]) -> Option<(Pencil, Unknown, Window)> {
    let (&head, &mask, &view) = (data.first()?, data.get(1)?, data.get(2)?);
    let n = usize::from(head % 4) + 1;

    let unknown = if head & 0x10 == 0 {
        Unknown::Mu
    } else {
        Unknown::Lambda2
    };

    let entry = |k: usize| number(head, data.get(3 + k).copied().unwrap_or(0));
    let matrix =
        |o: usize| Sparse::from_entries(n, n, (0..n * n).map(|k| (k / n, k % n, entry(o + k))));
    let free = (0..n).filter(|i| mask >> i & 1 == 1).collect();

    let b = if head & 0x20 == 0 {
        matrix(n * n)
    } else {
        Sparse::identity(n)
    };

    let min = rational(i64::from(view & 7), 2);
    let window = match view >> 6 {
        0 => Window::new(
            min.clone(),
            Some(min + rational(i64::from(view >> 3 & 7), 2)),
        ),
        1 => Window::new(min, None),
        _ => Ok(Window::all()),
    };

    Some((Pencil::new(matrix(0), b, free).ok()?, unknown, window.ok()?))
}

/// Small integers, or numbers of very different size.
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
