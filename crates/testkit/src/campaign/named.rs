//! How an instance of each family is made from its three numbers. Orders are small: no instance may
//! take more than seconds in exact arithmetic.
//!
//! One function for each name in [`super::FAMILIES`]. Input: the seed. Output: the problem, the
//! corners that it reaches, and what is known of its answer. The functions call the generators of
//! `families`, `generators`, `known` and `pareto`; half of the indices have lambda^2 as unknown,
//! the other half mu.

use super::expected::Made;
use crate::families::Corner;
use crate::generators::near::NearTheEnd;
use crate::generators::scales::Exponents;
use crate::generators::{
    Seed, near, permuted, raw, scales, states as mixtures, unknown, window, with_scaled_rows,
};
use crate::pareto::pareto_matrices;
use crate::{families, known as theorems};
use mceip_exact::{Rational, rational, whole};
use mceip_model::{Body, ModelError, Pencil, Problem, Unknown, Window};
use mceip_oracle::TwoParticles;
use mceip_paper::two_particles;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

type Result<T> = std::result::Result<T, ModelError>;

pub(super) fn table1(seed: &Seed) -> Result<Made> {
    let data = near::two_particles_data(&mut seed.rng(), None);
    of_two_particles(data, vec![])
}

pub(super) fn table1_near(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let distance = near::distance(&mut rng);
    let is_zero = distance == whole(0);
    let data = near::two_particles_data(&mut rng, Some(distance));

    // The thresholds of S1 = S2 are irrational and therefore rounded.
    let is_on_the_threshold = is_zero && data.signs.0 != data.signs.1;
    let corner = if is_on_the_threshold {
        Corner::Threshold
    } else {
        Corner::NearThreshold
    };
    of_two_particles(data, vec![corner])
}

fn of_two_particles(data: TwoParticles, corners: Vec<Corner>) -> Result<Made> {
    let system = two_particles(&data)?;
    let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;

    let mut made = Made::new(problem, corners);
    made.instance.closed_form = Some(data);
    Ok(made)
}

pub(super) fn elements(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let unknown = unknown(seed.index);
    let n_s = rng.random_range(1..=7);
    let n_f = free_count(&mut rng);

    let pencil = raw::elements(unknown, &mut rng, n_s, n_f)?;
    in_a_window(&mut rng, pencil, unknown)
}

pub(super) fn states(seed: &Seed) -> Result<Made> {
    let mut corners = Vec::new();
    let mut rng = seed.rng();
    let unknown = unknown(seed.index);
    let mixture = mixtures::mixture(seed.index / 2);
    let mut system = mixtures::system(&mut rng, &mixture, &mut corners)?;
    if unknown == Unknown::Lambda2 && rng.random_range(0..2) == 0 {
        system = mixtures::on_curved_obstacles(&mut rng, &system, &mut corners)?;
    }

    let problem = Problem::new(Body::System(system), unknown, Window::all())?;
    Ok(Made::new(problem, corners))
}

pub(super) fn systems(seed: &Seed) -> Result<Made> {
    let instance = families::mechanical_system(seed.index as usize, seed.seed)?;
    Ok(instance.into())
}

pub(super) fn pencils(seed: &Seed) -> Result<Made> {
    let instance = families::random_pencil(seed.index as usize, seed.seed)?;
    Ok(instance.into())
}

pub(super) fn eigenvalues(seed: &Seed) -> Result<Made> {
    let instance = families::eigenvalue_problem(seed.index as usize, seed.seed)?;
    Ok(instance.into())
}

pub(super) fn digits(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let n_s = rng.random_range(1..=7);
    let n_f = free_count(&mut rng);

    let pencil = raw::digits(&mut rng, n_s, n_f)?;
    in_a_window(&mut rng, pencil, Unknown::Mu)
}

pub(super) fn integers(seed: &Seed) -> Result<Made> {
    raw_family(seed, 6, |rng, n| {
        if n == 1 || rng.random_range(0..4) > 0 {
            scales::integers(rng, n)
        } else {
            raw::signs(rng, n)
        }
    })
}

pub(super) fn doubles(seed: &Seed) -> Result<Made> {
    raw_family(seed, 5, |rng, n| {
        if rng.random_range(0..3) == 0 {
            raw::fractions(rng, n)
        } else {
            scales::doubles(rng, n)
        }
    })
}

pub(super) fn zeros(seed: &Seed) -> Result<Made> {
    raw_family(seed, 6, raw::zeros)
}

pub(super) fn identity(seed: &Seed) -> Result<Made> {
    raw_family(seed, 6, raw::identity)
}

pub(super) fn graph(seed: &Seed) -> Result<Made> {
    raw_family(seed, 6, raw::graph)
}

pub(super) fn doubled(seed: &Seed) -> Result<Made> {
    raw_family(seed, 5, |rng, n| raw::doubled(rng, n.max(2)))
}

pub(super) fn free_anywhere(seed: &Seed) -> Result<Made> {
    raw_family(seed, 6, raw::free_anywhere)
}

pub(super) fn degenerate(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let mut list = families::degenerate()?;
    let place = (seed.index % list.len() as u64) as usize;
    let mut instance = list.swap_remove(place);
    let Body::Pencil(pencil) = instance.problem.body() else {
        return Ok(instance.into());
    };

    let pencil = permuted(&mut rng, pencil);
    let pencil = with_scaled_rows(&mut rng, &pencil);
    let unknown = instance.problem.unknown();
    instance.problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
    Ok(instance.into())
}

pub(super) fn known(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let n = rng.random_range(1..=6);

    let known = match seed.index % 8 {
        0 => theorems::path(n),
        1 => theorems::cycle(n.max(3)),
        2 => theorems::star(n.min(5)),
        3 => theorems::complete_graph(n.min(5)),
        4 => theorems::z_matrix(n),
        5 => theorems::jordan(n, rng.random_range(0..=9), true),
        6 => theorems::jordan(n, rng.random_range(0..=9), false),
        _ => theorems::diagonal(&random_entries(&mut rng, n)),
    }?;

    let unknown = known.problem.unknown();
    let problem = match known.problem.body() {
        Body::Pencil(pencil) => {
            let scaled = with_scaled_rows(&mut rng, pencil);
            Problem::new(Body::Pencil(scaled), unknown, Window::all())?
        }
        Body::Quadratic(_) | Body::System(_) => known.problem,
    };

    let mut made = Made::new(problem, vec![]);
    made.expected.answer = Some(known.expected);
    Ok(made)
}

/// Diagonal entries for [`theorems::diagonal`]: some are negative, some equal.
fn random_entries(rng: &mut ChaCha8Rng, n: usize) -> Vec<Rational> {
    let mut entries = Vec::new();
    for _ in 0..n {
        let numerator = rng.random_range(-3..=6);
        let denominator = rng.random_range(1..=3);
        entries.push(rational(numerator, denominator));
    }
    entries
}

pub(super) fn pareto(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let list = pareto_matrices();
    let pareto = &list[(seed.index % list.len() as u64) as usize];

    let is_raw = rng.random_range(0..2) == 0;
    let problem = if is_raw {
        let problem = pareto.pencil()?;
        let Body::Pencil(pencil) = problem.body() else {
            return Ok(Made::new(problem, vec![]));
        };
        let pencil = permuted(&mut rng, pencil);
        let pencil = with_scaled_rows(&mut rng, &pencil);
        Problem::new(Body::Pencil(pencil), problem.unknown(), Window::all())?
    } else {
        let numerator = rng.random_range(1..=40);
        let denominator = rng.random_range(1..=9);
        let a = rational(numerator, denominator);
        let c = pareto.bound() + rational(rng.random_range(0..=20), 3);
        pareto.system(&a, &c)?
    };

    let mut made = Made::new(problem, vec![]);
    made.expected.count = Some(pareto.count);
    Ok(made)
}

pub(super) fn planted(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let free = free_count(&mut rng);
    let n = free + rng.random_range(1..=5);
    let NearTheEnd { planted, is_inside } = near::near_the_windows_end(&mut rng, n, free)?;

    let corners = vec![Corner::Planted, Corner::NearThreshold];
    let mut made = Made::new(planted.problem, corners);
    made.expected.planted = is_inside.then_some((planted.value, planted.x));
    Ok(made)
}

pub(super) fn near(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let problem = if seed.index.is_multiple_of(3) {
        near::nearly_repeated(&mut rng)?
    } else {
        let free = free_count(&mut rng);
        let n = free + rng.random_range(2..=5);
        near::nearly_biactive(&mut rng, n, free)?
    };

    Ok(Made::new(problem, vec![Corner::NearThreshold]))
}

pub(super) fn scales(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let unknown = unknown(seed.index);
    let n_s = rng.random_range(1..=4);
    let n_f = rng.random_range(0..=2);
    let exponent = [12, 30, 60][rng.random_range(0..3)];

    let huge = Exponents {
        a: exponent,
        b: exponent - 6,
    };
    let tiny = Exponents {
        a: -exponent,
        b: 6 - exponent,
    };

    let kind = seed.index / 2 % 4;
    let pencil = match kind {
        0 => scales::hilbert(unknown, &mut rng, n_s, n_f)?,
        1 => scales::badly_scaled(unknown, &mut rng, n_s, n_f)?,
        2 => scales::scaled(unknown, &mut rng, n_s, n_f, huge)?,
        _ => scales::scaled(unknown, &mut rng, n_s, n_f, tiny)?,
    };
    let corner = match kind {
        0 | 1 => Corner::IllConditioned,
        2 => Corner::HugeScale,
        _ => Corner::TinyScale,
    };

    let problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
    Ok(Made::new(problem, vec![corner]))
}

/// A raw pencil of order 1 to `top` in a random window.
fn raw_family(
    seed: &Seed,
    top: usize,
    make: fn(&mut ChaCha8Rng, usize) -> Result<Pencil>,
) -> Result<Made> {
    let mut rng = seed.rng();
    let n = rng.random_range(1..=top);
    let pencil = make(&mut rng, n)?;
    in_a_window(&mut rng, pencil, unknown(seed.index))
}

/// The pencil in a random window, with the corner that the window is.
fn in_a_window(rng: &mut ChaCha8Rng, pencil: Pencil, unknown: Unknown) -> Result<Made> {
    let window = window(rng);
    let corners = match window.max() {
        Some(max) if max == window.min() => vec![Corner::PointWindow],
        Some(_) => vec![Corner::FiniteWindow],
        None => vec![],
    };

    let problem = Problem::new(Body::Pencil(pencil), unknown, window)?;
    Ok(Made::new(problem, corners))
}

/// Half of the instances have no free variables, the others up to three.
fn free_count(rng: &mut ChaCha8Rng) -> usize {
    if rng.random_range(0..2) == 0 {
        0
    } else {
        rng.random_range(1..=3)
    }
}
