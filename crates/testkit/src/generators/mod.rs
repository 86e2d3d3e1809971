//! Generators of the campaign beside `families`: each instance by a seed and an index.
//!
//! Every function draws from the source of random numbers that it is given, in a fixed order, so
//! that the same [`Seed`] gives the same instance on every machine. This file has what the
//! generators share: matrices of small integers, windows, and changes of a pencil that keep its
//! solutions.

pub mod near;
pub mod raw;
pub mod scales;
pub mod states;
pub mod tails;

use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Pencil, Unknown, Window};
use num_traits::One;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What an instance is drawn from: the same three numbers give the same instance on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seed {
    /// Number of the family, so that families do not share their draws.
    pub family: u64,
    /// The campaign's seed.
    pub seed: u64,
    /// Index of the instance within the family.
    pub index: u64,
}

impl Seed {
    /// The generator's source of numbers: ChaCha8 with the three numbers as its key.
    pub fn rng(&self) -> ChaCha8Rng {
        let mut key = [0; 32];
        let words = [self.family, self.seed, self.index];
        for (chunk, word) in key.chunks_mut(8).zip(words) {
            chunk.copy_from_slice(&word.to_le_bytes());
        }
        ChaCha8Rng::from_seed(key)
    }
}

/// The source of numbers for an instance of a family of random problems that only tests have.
pub fn rng(family: u64, index: u64) -> ChaCha8Rng {
    let seed = 1;
    Seed {
        family,
        seed,
        index,
    }
    .rng()
}

/// lambda^2 for even numbers, mu for odd ones.
pub fn unknown(index: u64) -> Unknown {
    if index.is_multiple_of(2) {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    }
}

/// A matrix of order n by its rows; its entries are drawn row by row.
fn drawn(n: usize, mut entry: impl FnMut() -> i64) -> Vec<Vec<i64>> {
    let mut rows = vec![vec![0; n]; n];
    for value in rows.iter_mut().flatten() {
        *value = entry();
    }
    rows
}

/// A matrix of order n whose entries are functions of row and column, formed row by row.
pub(crate) fn matrix(n: usize, mut entry: impl FnMut(usize, usize) -> Rational) -> Sparse {
    let mut entries = Vec::new();
    for i in 0..n {
        for j in 0..n {
            entries.push((i, j, entry(i, j)));
        }
    }
    Sparse::from_entries(n, n, entries)
}

/// GG' + identity * I with G of entries from -2 to 2: positive definite for identity > 0.
pub fn gram(rng: &mut ChaCha8Rng, n: usize, identity: i64) -> Vec<Vec<i64>> {
    let g = drawn(n, || rng.random_range(-2..=2));
    gram_of(&g, identity)
}

/// The same of a given G.
pub fn gram_of(g: &[Vec<i64>], identity: i64) -> Vec<Vec<i64>> {
    let n = g.len();
    let mut product = vec![vec![0; n]; n];
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                product[i][j] += g[i][k] * g[j][k];
            }
        }
        product[i][i] += identity;
    }

    product
}

/// Integer rows as a matrix.
pub fn sparse(rows: &[Vec<i64>]) -> Sparse {
    let rows: Vec<&[i64]> = rows.iter().map(|r| &r[..]).collect();
    Sparse::from_ints(&rows)
}

/// All of [0, inf), intervals whose ends are small integers (solutions of hand-made problems lie
/// there), and points.
pub fn window(rng: &mut ChaCha8Rng) -> Window {
    let min = rng.random_range(0..=4);
    let window = match rng.random_range(0..6) {
        0 => {
            let max = min + rng.random_range(0..=6);
            Window::new(whole(min), Some(whole(max)))
        }
        1 => Window::new(rational(min, 2), Some(whole(20))),
        2 => Window::new(rational(min, 3), None),
        _ => Ok(Window::all()),
    };

    // No window is refused, because 0 <= min <= max.
    window.unwrap_or_else(|_| Window::all())
}

/// The same solutions from other numbers: rows of A and B multiplied by random positive rationals.
pub fn with_scaled_rows(rng: &mut ChaCha8Rng, pencil: &Pencil) -> Pencil {
    let mut factors = Vec::new();
    for _ in 0..pencil.order() {
        let numerator = rng.random_range(1..=12);
        let denominator = rng.random_range(1..=12);
        factors.push(rational(numerator, denominator));
    }

    rebuilt(pencil, &|i, _, v| v * &factors[i])
}

/// The pencil with a skew part of one-digit integers added to A_ff and B_ff, or to A_ff alone where
/// B_ff is zero: the free block is not symmetric then, its symmetric part is what it was.
pub fn with_skew_free_block(rng: &mut ChaCha8Rng, pencil: &Pencil) -> Pencil {
    let free = pencil.free();
    let mut with_skew_part = |matrix: &Sparse| {
        let is_zero = matrix.submatrix(free, free).entries().next().is_none();
        let mut entries: Vec<_> = matrix
            .entries()
            .map(|(i, j, v)| (i, j, v.clone()))
            .collect();
        for (place, &i) in free.iter().enumerate().filter(|_| !is_zero) {
            for &j in &free[..place] {
                let skew = whole(rng.random_range(-9..=9));
                entries.push((j, i, -&skew));
                entries.push((i, j, skew));
            }
        }

        Sparse::from_entries(pencil.order(), pencil.order(), entries)
    };
    let [a, b] = [pencil.a(), pencil.b()].map(&mut with_skew_part);

    // Nothing is refused, because the shape and the free variables are the same.
    Pencil::new(a, b, free.to_vec()).unwrap_or_else(|_| pencil.clone())
}

/// Another order of the variables, x and y with it.
pub fn permuted(rng: &mut ChaCha8Rng, pencil: &Pencil) -> Pencil {
    let order = random_order(rng, pencil.order());
    let a = pencil.a().submatrix(&order, &order);
    let b = pencil.b().submatrix(&order, &order);
    let free = (0..order.len())
        .filter(|&i| pencil.free().contains(&order[i]))
        .collect();

    // Nothing is refused, because the shape and the number of free variables are the same.
    Pencil::new(a, b, free).unwrap_or_else(|_| pencil.clone())
}

/// The numbers 0 to n - 1 in a random order (Fisher and Yates).
pub(crate) fn random_order(rng: &mut ChaCha8Rng, n: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, rng.random_range(0..=i));
    }
    order
}

/// The pencil with every entry of A and B replaced by a function of row, column and value.
fn rebuilt(pencil: &Pencil, change: &dyn Fn(usize, usize, &Rational) -> Rational) -> Pencil {
    let a = changed(pencil.a(), change);
    let b = changed(pencil.b(), change);
    Pencil::new(a, b, pencil.free().to_vec()).unwrap_or_else(|_| pencil.clone())
}

/// The matrix with every entry replaced by a function of row, column and value.
fn changed(matrix: &Sparse, change: &dyn Fn(usize, usize, &Rational) -> Rational) -> Sparse {
    let entries = matrix.entries().map(|(i, j, v)| (i, j, change(i, j, v)));
    Sparse::from_entries(matrix.rows(), matrix.cols(), entries)
}

/// 10^k, k of either sign.
fn power_of_ten(k: i32) -> Rational {
    let power = num_traits::pow(mceip_exact::Integer::from(10), k.unsigned_abs() as usize);
    if k < 0 {
        Rational::new(One::one(), power)
    } else {
        Rational::from_integer(power)
    }
}
