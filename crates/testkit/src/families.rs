//! Families of problems: the two particles on a grid, random pencils and systems, degenerate cases.
//! One seed per instance; corners reached on purpose are named and counted.

use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{
    Body, ContactState, ModelError, Particle, Pencil, Problem, System, Unknown, Window,
};
use mceip_oracle::TwoParticles;
use mceip_paper::{pythagorean_angles, two_particles};
use num_traits::{One, Zero};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A corner that a generator reaches on purpose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Corner {
    /// x_i = y_i = 0 for some i.
    Biactive,
    /// A repeated eigenvalue with a kernel of dimension 1.
    Repeated,
    /// A solution with value 0.
    ZeroValue,
    /// A kernel of dimension > 1.
    WideKernel,
    /// A support whose pencil is singular.
    Singular,
    /// Exactly on a threshold of Table 1.
    Threshold,
    /// One variable.
    OneByOne,
    /// Free variables present.
    FreeVariables,
    /// An oblique particle.
    Oblique,
    /// A stick particle.
    Stick,
    /// A mass matrix that couples T and N, so that M1 does not vanish.
    CoupledMass,
    /// At a relative distance of 1e-3 to 1e-15 from a threshold, a double root or a biactive index.
    NearThreshold,
    /// Matrices of large condition number.
    IllConditioned,
    /// Entries of 1e12 and more.
    HugeScale,
    /// Entries of 1e-12 and less.
    TinyScale,
    /// A solution planted by construction.
    Planted,
    /// A window with two finite ends.
    FiniteWindow,
    /// A window of one point.
    PointWindow,
    /// No solution at all.
    Empty,
}

/// A problem of a family, with the closed form where there is one.
#[derive(Debug, Clone)]
pub struct Instance {
    /// Family, number and data, for messages.
    pub label: String,
    /// The problem.
    pub problem: Problem,
    /// Data of Table 1, where the closed form applies.
    pub closed_form: Option<TwoParticles>,
    /// Corners known by construction.
    pub corners: Vec<Corner>,
}

/// The two particles of Fig. 1: all sign patterns, Pythagorean angles, rational k, m and mu, with
/// mu on, just below and just above each rational threshold.
///
/// # Errors
/// [`ModelError`]; none for the data as given.
pub fn table1_grid() -> Result<Vec<Instance>, ModelError> {
    let mut out = Vec::new();
    for (c, s) in pythagorean_angles() {
        for (k, m) in [(whole(1), whole(1)), (rational(7, 3), rational(5, 2))] {
            for (mu, exact) in frictions(&c, &s) {
                for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
                    let data = TwoParticles {
                        c: c.clone(),
                        s: s.clone(),
                        k: k.clone(),
                        m: m.clone(),
                        mu: mu.clone(),
                        signs,
                    };

                    let problem = Problem::new(
                        Body::System(two_particles(&data)?),
                        Unknown::Lambda2,
                        Window::all(),
                    )?;

                    let label = format!("table1 c={c} s={s} k={k} m={m} mu={mu} S={signs:?}");
                    let corners = if exact && signs == (1, -1) {
                        vec![Corner::Threshold]
                    } else {
                        vec![]
                    };

                    out.push(Instance {
                        label,
                        problem,
                        closed_form: Some(data),
                        corners,
                    });
                }
            }
        }
    }

    Ok(out)
}

/// Coefficients of friction for one angle; true marks those exactly on a threshold.
fn frictions(c: &Rational, s: &Rational) -> Vec<(Rational, bool)> {
    let mut list: Vec<(Rational, bool)> = [rational(1, 2), whole(2), whole(5), whole(20)]
        .map(|mu| (mu, false))
        .to_vec();
    let cs = c * s;

    if !cs.is_zero() {
        let tiny = rational(1, 1_000_000_000);
        for top in [c * c + Rational::one(), c * c + whole(2)] {
            let mu = top / &cs;
            list.extend([
                (&mu - &tiny, false),
                (mu.clone(), true),
                (mu + &tiny, false),
            ]);
        }
    }

    list
}

/// Random admissible pencils in the manner of finite elements: K0 = GG' + I, M = HH' + I, K1
/// arbitrary with zero f rows, small integers; n_s from 1 to 6, n_f from 0 to 3, both unknowns.
///
/// # Errors
/// [`ModelError`]; none, the matrices are definite by construction.
pub fn random_pencils(count: usize, seed: u64) -> Result<Vec<Instance>, ModelError> {
    (0..count).map(|k| random_pencil(k, seed)).collect()
}

pub(super) fn random_pencil(k: usize, seed: u64) -> Result<Instance, ModelError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_mul(1_000_003).wrapping_add(k as u64));
    let n_s = rng.random_range(1..=6);

    let n_f = if rng.random_range(0..2) == 0 {
        0
    } else {
        rng.random_range(1..=3)
    };

    let n = n_s + n_f;
    let k0 = gram(&mut rng, n);

    let k1 = Sparse::from_entries(
        n,
        n,
        (n_f..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, whole(rng.random_range(-6..=6)))),
    );

    let unknown = if k.is_multiple_of(2) {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    };

    let (a, b) = match unknown {
        Unknown::Mu => (k0, k1),
        Unknown::Lambda2 => (
            k0.add_scaled(&rational(rng.random_range(1..=6), 2), &k1),
            gram(&mut rng, n),
        ),
    };

    let pencil = Pencil::new(a, b, (0..n_f).collect())?;
    let mut corners = Vec::new();

    if n_f > 0 {
        corners.push(Corner::FreeVariables);
    }

    if n == 1 {
        corners.push(Corner::OneByOne);
    }

    let label = format!(
        "random pencil {k} (seed {seed}) n_s={n_s} n_f={n_f} {}",
        unknown.word()
    );

    Ok(Instance {
        label,
        problem: Problem::new(Body::Pencil(pencil), unknown, Window::all())?,
        closed_form: None,
        corners,
    })
}

/// GG' + I with small integer G: symmetric positive definite.
pub(super) fn gram(rng: &mut ChaCha8Rng, n: usize) -> Sparse {
    let g: Vec<Vec<i64>> = (0..n)
        .map(|_| (0..n).map(|_| rng.random_range(-2..=2)).collect())
        .collect();
    let entry =
        |i: usize, j: usize| (0..n).map(|k| g[i][k] * g[j][k]).sum::<i64>() + i64::from(i == j);

    Sparse::from_entries(
        n,
        n,
        (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, whole(entry(i, j)))),
    )
}

/// Random mechanical systems with every mixture of free, stick and slip particles, oblique frames,
/// both normal directions, lumped and coupled mass.
///
/// # Errors
/// [`ModelError`]; none, the matrices are definite by construction.
pub fn mechanical(count: usize, seed: u64) -> Result<Vec<Instance>, ModelError> {
    (0..count).map(|k| mechanical_system(k, seed)).collect()
}

pub(super) fn mechanical_system(k: usize, seed: u64) -> Result<Instance, ModelError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_mul(7_368_787).wrapping_add(k as u64));
    let (contact, inner) = (rng.random_range(1..=4), rng.random_range(0..=2));
    let n = 2 * contact + inner;
    let mut corners = Vec::new();
    let particles: Vec<Particle> = (0..contact)
        .map(|i| random_particle(&mut rng, i, &mut corners))
        .collect();
    let lumped = rng.random_range(0..2) == 0;

    let mass = if lumped {
        Sparse::zeros(n, n).add_scaled(&whole(2), &Sparse::identity(n))
    } else {
        gram(&mut rng, n)
    };

    if !lumped {
        corners.push(Corner::CoupledMass);
    }

    let unknown = if k.is_multiple_of(2) {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    };

    let friction = rational(rng.random_range(4..=60), 4);
    let system = System::new(gram(&mut rng, n), Some(mass), Some(friction), particles)?;

    let label = format!(
        "mechanical system {k} (seed {seed}) particles={contact} inner={inner} {}",
        unknown.word()
    );

    Ok(Instance {
        label,
        problem: Problem::new(Body::System(system), unknown, Window::all())?,
        closed_form: None,
        corners,
    })
}

/// The first particle always slips, so that there is a problem.
fn random_particle(rng: &mut ChaCha8Rng, index: usize, corners: &mut Vec<Corner>) -> Particle {
    let sign = if rng.random_range(0..2) == 0 { 1 } else { -1 };
    let state = match rng.random_range(0..4) {
        0 if index > 0 => ContactState::Free,
        1 if index > 0 => ContactState::Stick,
        _ => ContactState::Slip { sign },
    };

    let mut particle = Particle::plain(2 * index, 2 * index + 1, state);
    particle.normal_direction = if rng.random_range(0..2) == 0 { 1 } else { -1 };

    if rng.random_range(0..3) == 0 {
        let (c, s) = (rational(3, 5), rational(4, 5));
        particle.frame = Some([[c.clone(), s.clone()], [-s, c]]);
        corners.push(Corner::Oblique);
    }

    match state {
        ContactState::Stick => corners.push(Corner::Stick),
        ContactState::Free => corners.push(Corner::FreeVariables),
        ContactState::Slip { .. } => {}
    }

    particle
}

/// Problems built to sit in a degenerate corner.
///
/// # Errors
/// [`ModelError`]; none for the data as given.
pub fn degenerate() -> Result<Vec<Instance>, ModelError> {
    type Case<'a> = (
        &'a str,
        &'a [&'a [i64]],
        &'a [&'a [i64]],
        &'a [usize],
        Unknown,
        Corner,
    );

    let identity: &[&[i64]] = &[&[1, 0], &[0, 1]];
    let cases: [Case<'_>; 12] = [
        (
            "one by one",
            &[&[-2]],
            &[&[1]],
            &[],
            Unknown::Lambda2,
            Corner::OneByOne,
        ),
        (
            "one by one without solution",
            &[&[2]],
            &[&[1]],
            &[],
            Unknown::Lambda2,
            Corner::OneByOne,
        ),
        (
            "biactive edge",
            &[&[-1, 5], &[0, 7]],
            identity,
            &[],
            Unknown::Lambda2,
            Corner::Biactive,
        ),
        (
            "Jordan block",
            &[&[-1, -1], &[0, -1]],
            identity,
            &[],
            Unknown::Lambda2,
            Corner::Biactive,
        ),
        (
            "double root on the full support",
            &[&[1, -4], &[1, -3]],
            identity,
            &[],
            Unknown::Lambda2,
            Corner::Repeated,
        ),
        (
            "double root with a free variable",
            &[&[2, 1], &[-1, 0]],
            &[&[1, 0], &[0, -1]],
            &[0],
            Unknown::Lambda2,
            Corner::Repeated,
        ),
        (
            "scalar matrix",
            &[&[-1, 0], &[0, -1]],
            identity,
            &[],
            Unknown::Lambda2,
            Corner::WideKernel,
        ),
        (
            "zero eigenvalue",
            &[&[1, -1], &[-1, 1]],
            identity,
            &[],
            Unknown::Lambda2,
            Corner::ZeroValue,
        ),
        (
            "singular for every mu",
            &[&[1, -1], &[-1, 1]],
            &[&[0, 0], &[0, 0]],
            &[],
            Unknown::Mu,
            Corner::Singular,
        ),
        (
            "singular free block beside",
            &[&[1, 0, 0], &[0, 0, 0], &[0, 0, -1]],
            &[&[0, 0, 0], &[0, 0, 0], &[0, 0, 1]],
            &[],
            Unknown::Mu,
            Corner::Singular,
        ),
        (
            "fold without a static threshold",
            &[&[1, -6], &[2, -6]],
            identity,
            &[],
            Unknown::Lambda2,
            Corner::Repeated,
        ),
        (
            "three equal particles",
            &[&[-1, 1, 1], &[1, -1, 1], &[1, 1, -1]],
            &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
            &[],
            Unknown::Lambda2,
            Corner::Repeated,
        ),
    ];

    cases
        .into_iter()
        .map(|(name, a, b, free, unknown, corner)| {
            let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec())?;
            let problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
            Ok(Instance {
                label: format!("degenerate: {name}"),
                problem,
                closed_form: None,
                corners: vec![corner],
            })
        })
        .collect()
}
