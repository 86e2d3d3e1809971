//! Near a threshold: relative distances of 1e-3 to 1e-15 from where a solution appears or
//! disappears.
//!
//! Each problem is built so that something degenerate happens exactly there: a threshold of
//! Table 1, a biactive index, a double root, a value at the end of the window. One number is then
//! moved by [`distance`]. Input: a source of random numbers. Called by the campaign's families
//! `table1`, `table1-near`, `near` and `planted`.

use super::power_of_ten;
use crate::pareto::{Planted, planted};
use mceip_exact::{Integer, Rational, Sparse, rational, whole};
use mceip_model::{Body, ModelError, Pencil, Problem, Unknown, Window};
use mceip_oracle::TwoParticles;
use num_traits::One;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// A relative distance: 0 (one in eight) or +-10^-k with k from 3 to 15.
pub fn distance(rng: &mut ChaCha8Rng) -> Rational {
    let sign = whole(if rng.random_range(0..2) == 0 { 1 } else { -1 });
    match rng.random_range(0..8) {
        0 => whole(0),
        _ => sign * power_of_ten(-rng.random_range(3..=15)),
    }
}

/// The two particles at a random rational angle. `distance` is None for mu between 1/4 and 30;
/// otherwise mu is a threshold of Table 1 times 1 + distance.
pub fn two_particles_data(rng: &mut ChaCha8Rng, distance: Option<Rational>) -> TwoParticles {
    // c = (p^2 - q^2) / h, s = 2pq / h with h = p^2 + q^2, p > q > 0.
    let q = rng.random_range(1..=12i64);
    let p = q + rng.random_range(1..=12i64);
    let h = p * p + q * q;
    let c = rational(p * p - q * q, h);
    let s = rational(2 * p * q, h);

    let k = positive(rng);
    let m = positive(rng);
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)][rng.random_range(0..4)];

    let mu = match distance {
        None => rational(rng.random_range(1..=120), 4),
        Some(d) => threshold(rng, signs, &c, &s) * (Rational::one() + d),
    };

    TwoParticles {
        c,
        s,
        k,
        m,
        mu,
        signs,
    }
}

/// A stiffness or a mass: a fraction of 1 to 40 over 1 to 9.
fn positive(rng: &mut ChaCha8Rng) -> Rational {
    let numerator = rng.random_range(1..=40);
    let denominator = rng.random_range(1..=9);
    rational(numerator, denominator)
}

/// mu at which a solution of Table 1 appears: (c^2 + 1)/(cs) and (c^2 + 2)/(cs) for S = (+1, -1),
/// else sqrt(c^2 + 2)/s, rounded down to 20 digits.
fn threshold(rng: &mut ChaCha8Rng, signs: (i8, i8), c: &Rational, s: &Rational) -> Rational {
    if signs.0 != signs.1 {
        return (c * c + whole(rng.random_range(1..=2))) / (c * s);
    }

    let square = (c * c + whole(2)) / (s * s);
    let scale = num_traits::pow(Integer::from(10), 40);
    let scaled_root = (square.numer() * &scale / square.denom()).sqrt();
    Rational::new(scaled_root, num_traits::pow(Integer::from(10), 20))
}

/// A planted solution with y_i moved by a relative distance for each complementarity variable at
/// rest, so that biactive indices become barely positive or barely negative.
///
/// # Errors
/// [`ModelError`] for no complementarity variables.
pub fn nearly_biactive(rng: &mut ChaCha8Rng, n: usize, free: usize) -> Result<Problem, ModelError> {
    let Planted { problem, x, .. } = planted(n, free, rng.random_range(0..u64::MAX))?;
    let Body::Pencil(pencil) = problem.body() else {
        return Ok(problem);
    };

    // The first complementarity variable slips: column `free` moves y_i by what is added to A_i
    // times x.
    let mut moved = Vec::new();
    for i in 0..n {
        if !pencil.free().contains(&i) {
            moved.push((i, free, distance(rng) / &x[free]));
        }
    }
    let moved = Sparse::from_entries(n, n, moved);
    let a = pencil.a().add_scaled(&Rational::one(), &moved);

    let pencil = Pencil::new(a, pencil.b().clone(), pencil.free().to_vec())?;
    Problem::new(Body::Pencil(pencil), problem.unknown(), Window::all())
}

/// A double root on the full support of two variables, one entry moved: two close roots, one, or
/// none. Above it an independent third variable, so that the support is not the whole.
///
/// # Errors
/// [`ModelError`]; none for the data as given.
pub fn nearly_repeated(rng: &mut ChaCha8Rng) -> Result<Problem, ModelError> {
    // [d, -p; q, e] with (d - e)^2 = 4pq: t = -(d + e)/2 twice, with x_1/x_2 = 2p/(d - e) > 0.
    const ENTRIES: [(i64, i64, i64); 5] = [(1, 1, 2), (4, 1, 4), (9, 1, 6), (2, 2, 4), (8, 2, 8)];
    let (p, q, gap) = ENTRIES[rng.random_range(0..5)];
    let e = rng.random_range(-8..=0i64);
    let with_double_root = Sparse::from_ints(&[
        &[e + gap, -p, 0],
        &[q, e, 0],
        &[1, 1, rng.random_range(-3..=3)],
    ]);

    let row = rng.random_range(0..2);
    let column = rng.random_range(0..2);
    let change = distance(rng) * whole(p);
    let moved = Sparse::from_entries(3, 3, [(row, column, change)]);
    let a = with_double_root.add_scaled(&Rational::one(), &moved);

    let pencil = Pencil::new(a, Sparse::identity(3), vec![])?;
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())
}

/// A planted solution and a window that ends beside its value.
pub struct NearTheEnd {
    /// The problem with this window, the planted value and vector.
    pub planted: Planted,
    /// Does the closed window hold the value?
    pub is_inside: bool,
}

/// A window whose end is at a relative distance from a planted value: inside, on the end, or
/// outside.
///
/// # Errors
/// [`ModelError`] for no complementarity variables.
pub fn near_the_windows_end(
    rng: &mut ChaCha8Rng,
    n: usize,
    free: usize,
) -> Result<NearTheEnd, ModelError> {
    let plan = planted(n, free, rng.random_range(0..u64::MAX))?;
    let end = &plan.value * (Rational::one() + distance(rng));
    let is_lower_end = rng.random_range(0..2) == 0;

    let is_inside = if is_lower_end {
        end <= plan.value
    } else {
        end >= plan.value
    };
    let window = if is_lower_end {
        Window::new(end, None)?
    } else {
        Window::new(whole(0), Some(end))?
    };

    Ok(NearTheEnd {
        planted: Planted {
            problem: plan.problem.with_window(window),
            ..plan
        },
        is_inside,
    })
}
