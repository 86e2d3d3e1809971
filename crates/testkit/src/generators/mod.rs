//! Generators of the campaign beside `families`: each instance by a seed and an index.

pub mod near;
pub mod raw;
pub mod scales;
pub mod states;
pub mod tails;

use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Pencil, Window};
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
        for (chunk, word) in key.chunks_mut(8).zip([self.family, self.seed, self.index]) {
            chunk.copy_from_slice(&word.to_le_bytes());
        }

        ChaCha8Rng::from_seed(key)
    }
}

/// GG' + identity * I with G of entries from -2 to 2: positive definite for identity > 0.
pub fn gram(rng: &mut ChaCha8Rng, n: usize, identity: i64) -> Vec<Vec<i64>> {
    let g: Vec<Vec<i64>> = (0..n)
        .map(|_| (0..n).map(|_| rng.random_range(-2..=2)).collect())
        .collect();

    (0..n)
        .map(|i| {
            (0..n)
                .map(|j| {
                    (0..n).map(|k| g[i][k] * g[j][k]).sum::<i64>()
                        + if i == j { identity } else { 0 }
                })
                .collect()
        })
        .collect()
}

/// Integer rows as a matrix.
pub fn sparse(rows: &[Vec<i64>]) -> Sparse {
    Sparse::from_ints(&rows.iter().map(|r| &r[..]).collect::<Vec<_>>())
}

/// All of [0, inf), intervals whose ends are small integers (solutions of hand-made problems lie
/// there), and points.
pub fn window(rng: &mut ChaCha8Rng) -> Window {
    let min = rng.random_range(0..=4);
    match rng.random_range(0..6) {
        0 => Window::new(whole(min), Some(whole(min + rng.random_range(0..=6)))),
        1 => Window::new(rational(min, 2), Some(whole(20))),
        2 => Window::new(rational(min, 3), None),
        _ => Ok(Window::all()),
    }
    .unwrap_or_else(|_| Window::all()) // 0 <= min <= max above
}

/// The same solutions from other numbers: rows of A and B multiplied by random positive rationals.
pub fn with_scaled_rows(rng: &mut ChaCha8Rng, pencil: &Pencil) -> Pencil {
    let factors: Vec<Rational> = (0..pencil.order())
        .map(|_| rational(rng.random_range(1..=12), rng.random_range(1..=12)))
        .collect();
    rebuilt(pencil, &|i, _, v| v * &factors[i])
}

/// Another order of the variables, x and y with it.
pub fn permuted(rng: &mut ChaCha8Rng, pencil: &Pencil) -> Pencil {
    let mut order: Vec<usize> = (0..pencil.order()).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, rng.random_range(0..=i)); // Fisher and Yates
    }

    let free = (0..order.len())
        .filter(|&i| pencil.free().contains(&order[i]))
        .collect();
    let (a, b) = (
        pencil.a().submatrix(&order, &order),
        pencil.b().submatrix(&order, &order),
    );

    Pencil::new(a, b, free).unwrap_or_else(|_| pencil.clone()) // the same shape and as many indices
}

/// The pencil with every entry of A and B replaced by a function of row, column and value.
pub(super) fn rebuilt(
    pencil: &Pencil,
    change: &dyn Fn(usize, usize, &Rational) -> Rational,
) -> Pencil {
    let n = pencil.order();
    let each = |m: &Sparse| {
        Sparse::from_entries(n, n, m.entries().map(|(i, j, v)| (i, j, change(i, j, v))))
    };

    Pencil::new(each(pencil.a()), each(pencil.b()), pencil.free().to_vec())
        .unwrap_or_else(|_| pencil.clone())
}

/// 10^k, k of either sign.
pub(super) fn power_of_ten(k: i32) -> Rational {
    let power = num_traits::pow(mceip_exact::Integer::from(10), k.unsigned_abs() as usize);
    if k < 0 {
        Rational::new(One::one(), power)
    } else {
        Rational::from_integer(power)
    }
}
