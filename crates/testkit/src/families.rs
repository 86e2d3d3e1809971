//! Families of problems: the two particles on a grid, random pencils and systems, degenerate cases.
//! One seed per instance; corners reached on purpose are named and counted.
//!
//! Output: instances, each with the corners known by construction. The random matrices are
//! GG' + I with small integers G, so that all hypotheses of Propositions 1 and 2 hold. Called by
//! `verify`, by the campaign, by the conformance pack and by many tests.

use crate::generators::{gram, raw, sparse, states, unknown, window};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{
    Body, ContactState, ModelError, Particle, Pencil, Problem, System, Unknown, Window,
};
use mceip_oracle::TwoParticles;
use mceip_paper::{pythagorean_angles, two_particles};
use num_traits::{One, Zero};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

worded! {
    /// A corner that a generator reaches on purpose; its word is for tables.
    Corner:
    Biactive "biactive" "x_i = y_i = 0 for some i.",
    Repeated "repeated eigenvalue" "A repeated eigenvalue with a kernel of dimension 1.",
    ZeroValue "value 0" "A solution with value 0.",
    WideKernel "kernel of several dimensions" "A kernel of dimension > 1.",
    Singular "singular support" "A support whose pencil is singular.",
    Threshold "on a threshold of Table 1" "Exactly on a threshold of Table 1.",
    OneByOne "one variable" "One variable.",
    FreeVariables "free variables" "Free variables present.",
    Oblique "oblique particle" "An oblique particle.",
    Curved "curved obstacle" "A particle that slips on a curved obstacle.",
    Quadratic "quadratic pencil" "A quadratic pencil.",
    Stick "stick particle" "A stick particle.",
    CoupledMass "mass that couples T and N" "A mass matrix that couples T and N: M1 does not \
                                             vanish.",
    NearThreshold "near a threshold" "At a relative distance of 10^-3 to 10^-15 from a threshold, \
                                      a double root or a biactive index.",
    IllConditioned "ill-conditioned" "Matrices of large condition number.",
    HugeScale "huge entries" "Entries of 1e12 and more.",
    TinyScale "tiny entries" "Entries of 10^-12 and less.",
    Planted "planted solution" "A solution planted by construction.",
    FiniteWindow "finite window" "A window with two finite ends.",
    PointWindow "window of one value" "A window of one point.",
    Empty "no solution" "No solution at all.",
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

impl Instance {
    /// A problem without a closed form.
    pub fn new(label: String, problem: Problem, corners: Vec<Corner>) -> Instance {
        Instance {
            label,
            problem,
            closed_form: None,
            corners,
        }
    }
}

/// The two particles of Fig. 1: all sign patterns, Pythagorean angles, rational k, m and mu, with
/// mu on, just below and just above each rational threshold.
///
/// # Errors
/// [`ModelError`]; none for the data as given.
pub fn table1_grid() -> Result<Vec<Instance>, ModelError> {
    let plain = [rational(1, 2), whole(2), whole(5), whole(20)];
    let mut out = Vec::new();
    for (c, s) in pythagorean_angles() {
        for (k, m) in [(whole(1), whole(1)), (rational(7, 3), rational(5, 2))] {
            for friction in frictions(&plain, &c, &s) {
                for signs in SIGNS {
                    let data = TwoParticles {
                        c: c.clone(),
                        s: s.clone(),
                        k: k.clone(),
                        m: m.clone(),
                        mu: friction.mu.clone(),
                        signs,
                    };
                    out.push(table1_instance(data, friction.place)?);
                }
            }
        }
    }
    Ok(out)
}

/// The two particles with these data. The rational thresholds are those of S = (+1, -1).
fn table1_instance(data: TwoParticles, place: Option<Corner>) -> Result<Instance, ModelError> {
    let TwoParticles {
        c,
        s,
        k,
        m,
        mu,
        signs,
    } = &data;
    let label = format!("table1 c={c} s={s} k={k} m={m} mu={mu} S={signs:?}");

    let mut corners = Vec::new();
    if place == Some(Corner::Threshold) && data.signs == (1, -1) {
        corners.push(Corner::Threshold);
    }

    let system = two_particles(&data)?;
    Ok(Instance {
        label,
        problem: Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?,
        closed_form: Some(data),
        corners,
    })
}

/// A coefficient of friction of the two particles at an angle.
pub(crate) struct AngleFriction {
    pub(crate) mu: Rational,
    /// On or near a rational threshold of S = (+1, -1), or neither.
    pub(crate) place: Option<Corner>,
}

/// Coefficients of friction for one angle: these, and the two rational thresholds of (+1, -1) with
/// their neighbours at a distance of 10^-9.
pub(crate) fn frictions(plain: &[Rational], c: &Rational, s: &Rational) -> Vec<AngleFriction> {
    let at = |mu: Rational, place| AngleFriction { mu, place };
    let mut list: Vec<AngleFriction> = plain.iter().map(|mu| at(mu.clone(), None)).collect();

    let cs = c * s;
    if cs.is_zero() {
        return list;
    }

    let tiny = rational(1, 1_000_000_000);
    let near = Some(Corner::NearThreshold);
    for top in [c * c + Rational::one(), c * c + whole(2)] {
        let threshold = top / &cs;
        list.push(at(&threshold - &tiny, near));
        list.push(at(threshold.clone(), Some(Corner::Threshold)));
        list.push(at(threshold + &tiny, near));
    }
    list
}

/// The sign patterns S of the two particles.
pub(crate) const SIGNS: [(i8, i8); 4] = [(1, 1), (1, -1), (-1, 1), (-1, -1)];

/// Random admissible pencils in the manner of finite elements: K0 = GG' + I, M = HH' + I, K1
/// arbitrary with zero f rows, small integers; n_s from 1 to 6, n_f from 0 to 3, both unknowns.
///
/// # Errors
/// [`ModelError`]; none, the matrices are definite by construction.
pub fn random_pencils(count: usize, seed: u64) -> Result<Vec<Instance>, ModelError> {
    (0..count).map(|k| random_pencil(k, seed)).collect()
}

/// The `k`-th of [`random_pencils`].
pub(super) fn random_pencil(k: usize, seed: u64) -> Result<Instance, ModelError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_mul(1_000_003).wrapping_add(k as u64));
    let n_s = rng.random_range(1..=6);
    let n_f = if rng.random_range(0..2) == 0 {
        0
    } else {
        rng.random_range(1..=3)
    };
    let n = n_s + n_f;

    let unknown = unknown(k as u64);
    let shape = PencilShape {
        n_s,
        n_f,
        identity: 1,
        coupling: 6,
    };
    let pencil = shape.pencil(&mut rng, unknown)?;

    let mut corners = Vec::new();
    if n_f > 0 {
        corners.push(Corner::FreeVariables);
    }
    if n == 1 {
        corners.push(Corner::OneByOne);
    }

    let word = unknown.word();
    let label = format!("random pencil {k} (seed {seed}) n_s={n_s} n_f={n_f} {word}");
    let problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
    Ok(Instance::new(label, problem, corners))
}

/// How large a random admissible pencil is, and how its parts weigh against each other.
pub(crate) struct PencilShape {
    pub(crate) n_s: usize,
    /// Free variables; they come first.
    pub(crate) n_f: usize,
    /// The multiple of I in K0 and M.
    pub(crate) identity: i64,
    /// Largest entry of K1.
    pub(crate) coupling: i64,
}

impl PencilShape {
    /// K0 and M by [`gram`], K1 with entries of either sign; with lambda^2 sought mu = 1/2 to 3.
    ///
    /// # Errors
    /// [`ModelError`]; for order 0 only.
    pub(crate) fn pencil(
        &self,
        rng: &mut ChaCha8Rng,
        unknown: Unknown,
    ) -> Result<Pencil, ModelError> {
        let n = self.n_s + self.n_f;
        let k0 = sparse(&gram(rng, n, self.identity));

        // The rows of K1 of the free variables vanish (16).
        let mut friction_entries = Vec::new();
        for i in self.n_f..n {
            for j in 0..n {
                let entry = rng.random_range(-self.coupling..=self.coupling);
                friction_entries.push((i, j, whole(entry)));
            }
        }
        let k1 = Sparse::from_entries(n, n, friction_entries);

        let free = (0..self.n_f).collect();
        match unknown {
            Unknown::Mu => Pencil::new(k0, k1, free),
            Unknown::Lambda2 | Unknown::Eigenvalue => {
                let friction = rational(rng.random_range(1..=6), 2);
                let mass = sparse(&gram(rng, n, self.identity));
                Pencil::new(k0.add_scaled(&friction, &k1), mass, free)
            }
        }
    }
}

/// Eigenvalue complementarity problems of pencils and of quadratic ones in turn, each with what may
/// go wrong with its kind. Windows begin at 0 or above: values below 0 are those of another pencil.
///
/// # Errors
/// [`ModelError`]; none, for there are variables.
pub fn eigenvalue_problems(count: usize, seed: u64) -> Result<Vec<Instance>, ModelError> {
    (0..count).map(|k| eigenvalue_problem(k, seed)).collect()
}

/// The `k`-th of [`eigenvalue_problems`].
pub(super) fn eigenvalue_problem(k: usize, seed: u64) -> Result<Instance, ModelError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_mul(5_800_079).wrapping_add(k as u64));
    let kind = (k / 2) as u64;
    let is_quadratic = k % 2 == 1;

    let n = rng.random_range(1..=if is_quadratic { 3 } else { 5 });
    let (body, corners) = if is_quadratic {
        let quadratic = raw::quadratic(&mut rng, kind, n)?;
        (Body::Quadratic(quadratic), vec![Corner::Quadratic])
    } else {
        (Body::Pencil(raw::of_kind(&mut rng, kind, n)?), Vec::new())
    };

    let word = if is_quadratic { "quadratic" } else { "linear" };
    let label = format!("eigenvalue problem {k} (seed {seed}) n={n} {word}");
    let problem = Problem::new(body, Unknown::Eigenvalue, window(&mut rng))?;
    Ok(Instance::new(label, problem, corners))
}

/// Random mechanical systems with every mixture of free, stick and slip particles, oblique frames,
/// both normal directions, lumped and coupled mass.
///
/// # Errors
/// [`ModelError`]; none, the matrices are definite by construction.
pub fn mechanical(count: usize, seed: u64) -> Result<Vec<Instance>, ModelError> {
    (0..count).map(|k| mechanical_system(k, seed)).collect()
}

/// The `k`-th of [`mechanical`].
pub(super) fn mechanical_system(k: usize, seed: u64) -> Result<Instance, ModelError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_mul(7_368_787).wrapping_add(k as u64));
    let contact = rng.random_range(1..=4);
    let inner = rng.random_range(0..=2);

    let mut corners = Vec::new();
    let unknown = unknown(k as u64);
    let system = system_of_size(&mut rng, contact, inner, &mut corners)?;

    let word = unknown.word();
    let label =
        format!("mechanical system {k} (seed {seed}) particles={contact} inner={inner} {word}");
    let problem = Problem::new(Body::System(system), unknown, Window::all())?;
    Ok(Instance::new(label, problem, corners))
}

/// A random system of so many particles with a candidate for contact each, and inner degrees of
/// freedom; what is met on the way is added to `corners`.
///
/// # Errors
/// [`ModelError`]; for no particles only.
pub(crate) fn system_of_size(
    rng: &mut ChaCha8Rng,
    contact: usize,
    inner: usize,
    corners: &mut Vec<Corner>,
) -> Result<System, ModelError> {
    let n = 2 * contact + inner;
    let mut particles = Vec::new();
    for index in 0..contact {
        particles.push(random_particle(rng, index, corners));
    }

    states::of_particles(rng, n, particles, (2, 4..=60), corners)
}

/// The first particle always slips, so that there is a problem.
fn random_particle(rng: &mut ChaCha8Rng, index: usize, corners: &mut Vec<Corner>) -> Particle {
    let sign = if rng.random_range(0..2) == 0 { 1 } else { -1 };
    let state = match rng.random_range(0..4) {
        0 if index > 0 => ContactState::Free,
        1 if index > 0 => ContactState::Stick,
        _ => ContactState::Slip { sign },
    };

    let plain = Particle::plain(2 * index, 2 * index + 1, state);
    states::turned(rng, plain, |_| three_four_five(), corners)
}

/// A rotation by the angle of the Pythagorean triple 3, 4, 5.
fn three_four_five() -> [[Rational; 2]; 2] {
    let c = rational(3, 5);
    let s = rational(4, 5);
    [[c.clone(), s.clone()], [-s, c]]
}

/// Problems built to sit in a degenerate corner.
///
/// # Errors
/// [`ModelError`]; none for the data as given.
#[rustfmt::skip]
pub fn degenerate() -> Result<Vec<Instance>, ModelError> {
    use Corner::{Biactive, OneByOne, Repeated, Singular, WideKernel, ZeroValue};
    use Unknown::{Lambda2, Mu};

    // Name, A, B, free variables, unknown, corner.
    let cases: [Degenerate<'_>; 12] = [
        ("one by one", &[&[-2]], &[&[1]], &[], Lambda2, OneByOne),
        ("one by one without solution", &[&[2]], &[&[1]], &[], Lambda2, OneByOne),
        ("biactive edge", &[&[-1, 5], &[0, 7]], I2, &[], Lambda2, Biactive),
        ("Jordan block", &[&[-1, -1], &[0, -1]], I2, &[], Lambda2, Biactive),
        ("double root on the full support", &[&[1, -4], &[1, -3]], I2, &[], Lambda2, Repeated),
        ("double root with a free variable",
            &[&[2, 1], &[-1, 0]], &[&[1, 0], &[0, -1]], &[0], Lambda2, Repeated),
        ("scalar matrix", &[&[-1, 0], &[0, -1]], I2, &[], Lambda2, WideKernel),
        ("zero eigenvalue", &[&[1, -1], &[-1, 1]], I2, &[], Lambda2, ZeroValue),
        ("singular for every mu", &[&[1, -1], &[-1, 1]], &[&[0, 0], &[0, 0]], &[], Mu, Singular),
        ("singular free block beside", &[&[1, 0, 0], &[0, 0, 0], &[0, 0, -1]],
            &[&[0, 0, 0], &[0, 0, 0], &[0, 0, 1]], &[], Mu, Singular),
        ("fold without a static threshold", &[&[1, -6], &[2, -6]], I2, &[], Lambda2, Repeated),
        ("three equal particles", &[&[-1, 1, 1], &[1, -1, 1], &[1, 1, -1]], I3, &[], Lambda2,
            Repeated),
    ];

    cases.into_iter().map(degenerate_instance).collect()
}

/// A matrix of small integers by rows.
pub(crate) type SmallRows<'a> = &'a [&'a [i64]];

/// Identity matrices.
pub(crate) const I2: SmallRows<'_> = &[&[1, 0], &[0, 1]];
pub(crate) const I3: SmallRows<'_> = &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]];

/// The pencil of small integers A and B over [0, infinity).
pub(crate) fn small_problem(
    a: SmallRows<'_>,
    b: SmallRows<'_>,
    free: &[usize],
    unknown: Unknown,
) -> Result<Problem, ModelError> {
    let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec())?;
    Problem::new(Body::Pencil(pencil), unknown, Window::all())
}

/// A degenerate pencil of small integers: name, A, B, free variables, unknown, corner.
type Degenerate<'a> = (
    &'a str,
    SmallRows<'a>,
    SmallRows<'a>,
    &'a [usize],
    Unknown,
    Corner,
);

fn degenerate_instance(
    (name, a, b, free, unknown, corner): Degenerate<'_>,
) -> Result<Instance, ModelError> {
    let problem = small_problem(a, b, free, unknown)?;
    Ok(Instance::new(
        format!("degenerate: {name}"),
        problem,
        vec![corner],
    ))
}

/// The system of a problem that has one.
///
/// # Panics
/// Where the body is a pencil.
pub fn system_of(problem: &Problem) -> &System {
    match problem.body() {
        Body::System(system) => system,
        Body::Pencil(_) | Body::Quadratic(_) => panic!("a pencil in place of a system"),
    }
}
