//! How an instance of each family is made from its three numbers. Orders are small: no instance may
//! take more than seconds in exact arithmetic.

use super::expected::{Expected, Made};
use crate::families::{Corner, Instance};
use crate::generators::{
    Seed, near, permuted, raw, scales, states as mixtures, window, with_scaled_rows,
};
use crate::pareto::{Planted, pareto_matrices};
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
    two_particle_instance(data, vec![])
}

pub(super) fn table1_near(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let distance = near::distance(&mut rng);
    let on = distance == whole(0);
    let data = near::two_particles_data(&mut rng, Some(distance));

    let corner = if on && data.signs.0 != data.signs.1 {
        Corner::Threshold
    } else {
        Corner::NearThreshold
    };

    two_particle_instance(data, vec![corner])
}

fn two_particle_instance(data: TwoParticles, corners: Vec<Corner>) -> Result<Made> {
    let problem = Problem::new(
        Body::System(two_particles(&data)?),
        Unknown::Lambda2,
        Window::all(),
    )?;

    Ok((
        Instance {
            label: String::new(),
            problem,
            closed_form: Some(data),
            corners,
        },
        Expected::default(),
    ))
}

pub(super) fn elements(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let (unknown, n_s, n_f) = (
        unknown(seed.index),
        rng.random_range(1..=7),
        free_count(&mut rng),
    );

    let pencil = raw::elements(unknown, &mut rng, n_s, n_f)?;
    in_a_window(&mut rng, pencil, unknown)
}

pub(super) fn states(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let mut corners = Vec::new();
    let system = mixtures::system(&mut rng, &mixtures::mixture(seed.index / 2), &mut corners)?;
    let problem = Problem::new(Body::System(system), unknown(seed.index), Window::all())?;

    Ok((
        Instance {
            label: String::new(),
            problem,
            closed_form: None,
            corners,
        },
        Expected::default(),
    ))
}

pub(super) fn systems(seed: &Seed) -> Result<Made> {
    Ok((
        families::mechanical_system(seed.index as usize, seed.seed)?,
        Expected::default(),
    ))
}

pub(super) fn pencils(seed: &Seed) -> Result<Made> {
    Ok((
        families::random_pencil(seed.index as usize, seed.seed)?,
        Expected::default(),
    ))
}

pub(super) fn digits(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let (n_s, n_f) = (rng.random_range(1..=7), free_count(&mut rng));
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
    let instance = list.swap_remove((seed.index % list.len() as u64) as usize);
    let Body::Pencil(pencil) = instance.problem.body() else {
        return Ok((instance, Expected::default()));
    };

    let pencil = permuted(&mut rng, pencil);
    let pencil = with_scaled_rows(&mut rng, &pencil);

    let problem = Problem::new(
        Body::Pencil(pencil),
        instance.problem.unknown(),
        Window::all(),
    )?;

    Ok((
        Instance {
            problem,
            ..instance
        },
        Expected::default(),
    ))
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
        _ => theorems::diagonal(
            &(0..n)
                .map(|_| rational(rng.random_range(-3..=6), rng.random_range(1..=3)))
                .collect::<Vec<Rational>>(),
        ),
    }?;

    let problem = match known.problem.body() {
        Body::Pencil(p) => Problem::new(
            Body::Pencil(with_scaled_rows(&mut rng, p)),
            known.problem.unknown(),
            Window::all(),
        )?,
        Body::System(_) => known.problem,
    };

    Ok((
        plain(problem),
        Expected {
            answer: Some(known.expected),
            ..Expected::default()
        },
    ))
}

pub(super) fn pareto(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let list = pareto_matrices();
    let pareto = &list[(seed.index % list.len() as u64) as usize];

    let problem = if rng.random_range(0..2) == 0 {
        let problem = pareto.pencil()?;
        let Body::Pencil(p) = problem.body() else {
            return Ok((plain(problem), Expected::default()));
        };
        let pencil = permuted(&mut rng, p);
        let pencil = with_scaled_rows(&mut rng, &pencil);
        Problem::new(Body::Pencil(pencil), problem.unknown(), Window::all())?
    } else {
        let a = rational(rng.random_range(1..=40), rng.random_range(1..=9));
        pareto.system(
            &a,
            &(pareto.bound() + rational(rng.random_range(0..=20), 3)),
        )?
    };

    Ok((
        plain(problem),
        Expected {
            count: Some(pareto.count),
            ..Expected::default()
        },
    ))
}

pub(super) fn planted(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let free = free_count(&mut rng);
    let n = free + rng.random_range(1..=5);
    let (Planted { problem, value, x }, inside) = near::near_the_windows_end(&mut rng, n, free)?;

    let instance = Instance {
        label: String::new(),
        problem,
        closed_form: None,
        corners: vec![Corner::Planted, Corner::NearThreshold],
    };

    Ok((
        instance,
        Expected {
            planted: inside.then_some((value, x)),
            ..Expected::default()
        },
    ))
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

    Ok((
        Instance {
            label: String::new(),
            problem,
            closed_form: None,
            corners: vec![Corner::NearThreshold],
        },
        Expected::default(),
    ))
}

pub(super) fn scales(seed: &Seed) -> Result<Made> {
    let mut rng = seed.rng();
    let unknown = unknown(seed.index);
    let (n_s, n_f) = (rng.random_range(1..=4), rng.random_range(0..=2));
    let exponent = [12, 30, 60][rng.random_range(0..3)];

    let (pencil, corner) = match seed.index / 2 % 4 {
        0 => (
            scales::hilbert(unknown, &mut rng, n_s, n_f)?,
            Corner::IllConditioned,
        ),
        1 => (
            scales::badly_scaled(unknown, &mut rng, n_s, n_f)?,
            Corner::IllConditioned,
        ),
        2 => (
            scales::scaled(unknown, &mut rng, (n_s, n_f), (exponent, exponent - 6))?,
            Corner::HugeScale,
        ),
        _ => (
            scales::scaled(unknown, &mut rng, (n_s, n_f), (-exponent, 6 - exponent))?,
            Corner::TinyScale,
        ),
    };

    let problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
    Ok((
        Instance {
            label: String::new(),
            problem,
            closed_form: None,
            corners: vec![corner],
        },
        Expected::default(),
    ))
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

fn in_a_window(rng: &mut ChaCha8Rng, pencil: Pencil, unknown: Unknown) -> Result<Made> {
    let window = window(rng);
    let corners = match window.max() {
        Some(max) if max == window.min() => vec![Corner::PointWindow],
        Some(_) => vec![Corner::FiniteWindow],
        None => vec![],
    };

    let problem = Problem::new(Body::Pencil(pencil), unknown, window)?;
    Ok((
        Instance {
            label: String::new(),
            problem,
            closed_form: None,
            corners,
        },
        Expected::default(),
    ))
}

fn plain(problem: Problem) -> Instance {
    Instance {
        label: String::new(),
        problem,
        closed_form: None,
        corners: vec![],
    }
}

fn unknown(index: u64) -> Unknown {
    if index.is_multiple_of(2) {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    }
}

/// Half of the instances have no free variables, the others up to three.
fn free_count(rng: &mut ChaCha8Rng) -> usize {
    if rng.random_range(0..2) == 0 {
        0
    } else {
        rng.random_range(1..=3)
    }
}
