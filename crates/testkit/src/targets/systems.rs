//! Mechanical systems of any bytes: signs S, contact states, friction, rational frames; reduction
//! (10)-(16) and lift; Table 1 in closed form against enumerator and solver.
//!
//! Input: bytes of a fuzzer, which make a system (1)-(9) or the data of Table 1. A disagreement of
//! two engines is a panic. Called by the fuzz targets `mechanical_systems` and
//! `two_particle_problems`.

use super::coverage::Counter;
use super::engines_agree;
use crate::compare::Treatment;
use crate::families::Instance;
use crate::generators::{gram_of, sparse};
use mceip_check::check;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::file::write_problem;
use mceip_model::reduction::reduce;
use mceip_model::{
    Body, ContactState, Curvature, Particle, Pencil, Problem, Reduced, System, Unknown, Window,
};
use mceip_oracle::TwoParticles;
use mceip_paper::two_particles;
use num_traits::{One, Zero};

/// Process-wide counts of [`mechanical_systems`].
pub static SYSTEMS: Counter = Counter::new("fuzz: mechanical_systems");
/// Process-wide counts of [`two_particle_problems`].
pub static TWO_PARTICLES: Counter = Counter::new("fuzz: two_particle_problems");

/// Nodes per piece of the complete search.
const NODES: usize = 300;

/// Bytes one after the other, zeros past the end.
struct Bytes<'a> {
    data: &'a [u8],
    at: usize,
}

impl Bytes<'_> {
    /// The next byte.
    fn next(&mut self) -> u8 {
        let byte = self.data.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        byte
    }

    /// A number from 0 to `count` - 1.
    fn below(&mut self, count: u8) -> u8 {
        self.next() % count
    }

    /// A positive rational n / d with n up to 256 and d up to 16.
    fn positive(&mut self) -> Rational {
        let numerator = i64::from(self.next()) + 1;
        rational(numerator, i64::from(self.below(16)) + 1)
    }
}

/// Random systems through reduction, enumerator, lift, complete search, checker and solver.
///
/// * The pencil of [`reduce`] is that of the definitions (10) and (11), formed here entry by entry.
/// * Lifted solutions satisfy each line of (9).
/// * A certificate of the complete set is judged alike on the system, whose pencil the checker
///   forms by itself, and on the reduced pencil given as matrices.
/// * The solver is sound, and finds as much as its floor asks for.
pub fn mechanical_systems(data: &[u8]) {
    mechanical_systems_by(data, &fuzz_treatment(), &SYSTEMS);
}

/// [`mechanical_systems`] with a solver and a counter of one's own.
pub fn mechanical_systems_by(data: &[u8], treatment: &Treatment, counter: &Counter) {
    let Some(problem) = system_problem(data) else {
        return;
    };

    let Body::System(system) = problem.body() else {
        return;
    };

    let Ok(reduced) = reduce(&problem).and_then(Reduced::without_zero) else {
        panic!(
            "a system of the generator is refused: {}",
            write_problem(&problem)
        )
    };

    let defined = pencil_by_definition(system, problem.unknown());
    assert!(
        reduced.pencil == defined,
        "reduction and definition differ: {}",
        write_problem(&problem)
    );

    same_verdict(&problem, &reduced.pencil);

    let instance = Instance::new(format!("fuzz {data:?}"), problem, Vec::new());
    engines_agree(&instance, treatment, counter);
}

/// Table 1: closed form, enumerator, complete search, certificates and solver on two particles of
/// any data.
pub fn two_particle_problems(data: &[u8]) {
    two_particle_problems_by(data, &fuzz_treatment(), &TWO_PARTICLES);
}

/// [`two_particle_problems`] with a solver and a counter of one's own.
pub fn two_particle_problems_by(data: &[u8], treatment: &Treatment, counter: &Counter) {
    let data = two_particle_data(data);
    let Ok(system) = two_particles(&data) else {
        panic!("refused: {data:?}")
    };

    let Ok(problem) = Problem::new(Body::System(system), Unknown::Lambda2, Window::all()) else {
        panic!("refused: {data:?}")
    };

    let mut instance = Instance::new(format!("{data:?}"), problem, Vec::new());
    instance.closed_form = Some(data);
    engines_agree(&instance, treatment, counter);
}

/// A search that takes milliseconds on the small problems of a fuzzer.
pub fn fuzz_treatment() -> Treatment {
    let search = mceip_engine::multistart::Search {
        starts: 6,
        window_starts: 1,
        ..Default::default()
    };

    Treatment::of(&search)
}

/// One to three particles, the first in impending slip, up to two further degrees of freedom, K =
/// GG' + I.
fn system_problem(data: &[u8]) -> Option<Problem> {
    let mut bytes = Bytes { data, at: 0 };
    let head = bytes.next();
    let count = usize::from(head % 3) + 1;
    let n = 2 * count + usize::from(head / 3 % 3);

    let unknown = if head & 0x40 == 0 {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    };

    let is_coupled = head & 0x80 != 0;

    let friction = bytes.positive();
    let order = permutation(&mut bytes, n);
    let particles: Vec<Particle> = (0..count)
        .map(|k| particle(&mut bytes, k, &order))
        .collect();
    let stiffness = definite(&mut bytes, n);

    let mass = if is_coupled {
        definite(&mut bytes, n)
    } else {
        Sparse::zeros(n, n).add_scaled(&bytes.positive(), &Sparse::identity(n))
    };

    let particles = particles.into_iter();
    let particles: Vec<Particle> = match unknown {
        Unknown::Lambda2 => particles.map(|p| on_an_obstacle(&mut bytes, p)).collect(),
        Unknown::Mu | Unknown::Eigenvalue => particles.collect(),
    };

    let system = System::new(stiffness, Some(mass), Some(friction), particles).ok()?;
    Problem::new(Body::System(system), unknown, Window::all()).ok()
}

/// The numbers 0 to n - 1 in an order that the bytes choose (Fisher and Yates).
fn permutation(bytes: &mut Bytes<'_>, n: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        let j = usize::from(bytes.next()) % (i + 1);
        order.swap(i, j);
    }

    order
}

/// The `index`-th particle: state, normal direction and frame from one byte each.
fn particle(bytes: &mut Bytes<'_>, index: usize, order: &[usize]) -> Particle {
    let state = match bytes.below(6) {
        0 if index > 0 => ContactState::Free,
        1 if index > 0 => ContactState::Stick,
        k if k % 2 == 0 => ContactState::Slip { sign: 1 },
        _ => ContactState::Slip { sign: -1 },
    };

    let mut particle = Particle::plain(order[2 * index], order[2 * index + 1], state);

    particle.normal_direction = if bytes.below(2) == 0 { 1 } else { -1 };
    let oblique = bytes.next();

    if oblique % 2 == 1 {
        let (c, s) = on_the_circle(oblique / 2);
        particle.frame = Some([[c.clone(), s.clone()], [-s, c]]);
    }

    particle
}

/// The particle on an obstacle of curvature 0 to 31/4, or -1/4 to -8; where the bytes have ended it
/// is flat.
fn on_an_obstacle(bytes: &mut Bytes<'_>, mut particle: Particle) -> Particle {
    let curvature = bytes.next();
    if curvature == 0 || !matches!(particle.state, ContactState::Slip { .. }) {
        return particle;
    }

    particle.curvature = Some(Curvature {
        value: rational(i64::from(curvature.cast_signed()) / 4, 4),
        normal_reaction: -bytes.positive(),
    });
    particle
}

/// A rational point of the unit circle: ((p^2 - q^2) / (p^2 + q^2), 2pq / (p^2 + q^2)) with p, q
/// not both zero.
fn on_the_circle(byte: u8) -> (Rational, Rational) {
    let p = i64::from(byte % 8) + 1;
    let q = i64::from(byte / 8 % 16) - 8;
    let h = p * p + q * q;

    (rational(p * p - q * q, h), rational(2 * p * q, h))
}

/// GG' + I with entries of G from -2 to 2: symmetric and positive definite.
fn definite(bytes: &mut Bytes<'_>, n: usize) -> Sparse {
    let mut g = vec![vec![0; n]; n];
    for entry in g.iter_mut().flatten() {
        *entry = i64::from(bytes.below(5)) - 2;
    }
    sparse(&gram_of(&g, 1))
}

/// c and s of a Pythagorean angle with c, s >= 0, axes included; k, m, mu positive; mu now and then
/// on or beside a threshold of (+1, -1).
fn two_particle_data(data: &[u8]) -> TwoParticles {
    let mut bytes = Bytes { data, at: 0 };
    let head = bytes.next();
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)][usize::from(head % 4)];

    let p = i64::from(bytes.below(12)) + 1;
    let q = i64::from(bytes.next()) % (p + 1);
    let h = p * p + q * q;
    let c = rational(p * p - q * q, h);
    let s = rational(2 * p * q, h);

    let k = bytes.positive();
    let m = bytes.positive();
    let mut mu = bytes.positive();

    let cs = &c * &s;
    let is_near_a_threshold = head & 0x30 != 0;
    if is_near_a_threshold && !cs.is_zero() {
        let top = &c * &c + whole(i64::from(head >> 6 & 1) + 1);
        let beside = rational(i64::from(head >> 4 & 3) - 2, 1_000_000_000);
        mu = top / cs + beside;
    }

    TwoParticles {
        c,
        s,
        k,
        m,
        mu,
        signs,
    }
}

/// Columns over the degrees of freedom, dense.
struct DofVector(Vec<Rational>);

impl DofVector {
    /// The column times a number.
    fn times(&self, factor: &Rational) -> DofVector {
        DofVector(self.0.iter().map(|v| v * factor).collect())
    }
}

/// A + tB by the definitions: v = T x with v_T = -S x (10), y = P'w with y = -(S w_T + mu w_N)
/// (11), w = (K + lambda^2 M) v.
///
/// Dense sums over all degrees of freedom, with no block formula (16): a third way beside
/// `reduction` and `check`.
fn pencil_by_definition(system: &System, unknown: Unknown) -> Pencil {
    let n = system.dofs();
    let mut motion = Vec::new();
    let mut normal = Vec::new();

    for dof in system.free_dofs() {
        let mut unit = vec![Rational::zero(); n];
        unit[dof] = Rational::one();
        motion.push(DofVector(unit));
        normal.push(DofVector(vec![Rational::zero(); n]));
    }

    let free = motion.len();
    for particle in system.particles() {
        let ContactState::Slip { sign } = particle.state else {
            continue;
        };

        let axes = Axes::of(particle, n);
        let minus_sign = whole(i64::from(-sign));
        motion.push(axes.tangent.times(&minus_sign));
        normal.push(axes.into.times(&-&particle.friction_factor));
    }

    let k_plain = products(system.stiffness(), &motion, &motion);
    let k_friction = products(system.stiffness(), &normal, &motion);
    let friction = system.friction().cloned().unwrap_or_default();

    let free_variables = (0..free).collect();
    let pencil = match (unknown, system.mass()) {
        (Unknown::Lambda2, Some(mass)) => {
            let m_plain = products(mass, &motion, &motion);
            let m_friction = products(mass, &normal, &motion);
            let mut a = k_plain.add_scaled(&friction, &k_friction);
            for (k, (particle, _)) in system.slip_particles().into_iter().enumerate() {
                let turning = turning(particle, &friction);
                let here =
                    Sparse::from_entries(a.rows(), a.rows(), [(free + k, free + k, turning)]);
                a = a.add_scaled(&Rational::one(), &here);
            }
            let b = m_plain.add_scaled(&friction, &m_friction);
            Pencil::new(a, b, free_variables)
        }
        _ => Pencil::new(k_plain, k_friction, free_variables),
    };
    pencil.unwrap_or_else(|e| panic!("a square pencil is refused: {e}"))
}

/// What a reaction that turns by kappa v_T along a curved obstacle adds to y = -(S w_T + c mu w_N)
/// of x = -S v_T: kappa (r_N - S c mu r_T) with r_T = -S c mu r_N.
fn turning(particle: &Particle, friction: &Rational) -> Rational {
    let Some(curvature) = &particle.curvature else {
        return Rational::zero();
    };

    let own_friction = friction * &particle.friction_factor;
    let normal = &curvature.normal_reaction;
    let tangential_against_slip = &own_friction * normal; // -S r_T
    &curvature.value * (normal + own_friction * tangential_against_slip)
}

/// The two directions of a particle, written out from its frame.
struct Axes {
    /// Along the obstacle.
    tangent: DofVector,
    /// Into the obstacle.
    into: DofVector,
}

impl Axes {
    fn of(particle: &Particle, n: usize) -> Axes {
        let one = Rational::one();
        let upright = [[one.clone(), Rational::zero()], [Rational::zero(), one]];
        let frame = particle.frame.clone().unwrap_or(upright);
        let outward = whole(i64::from(particle.normal_direction));

        let mut tangent = vec![Rational::zero(); n];
        let mut into = vec![Rational::zero(); n];
        let dofs = [particle.tangential, particle.normal];
        for (k, dof) in dofs.into_iter().enumerate() {
            tangent[dof] = frame[0][k].clone();
            into[dof] = &frame[1][k] * &outward;
        }

        Axes {
            tangent: DofVector(tangent),
            into: DofVector(into),
        }
    }
}

/// The matrix of all p' K t.
fn products(matrix: &Sparse, left: &[DofVector], right: &[DofVector]) -> Sparse {
    let mut entries = Vec::new();
    for (i, p) in left.iter().enumerate() {
        for (j, t) in right.iter().enumerate() {
            let mut sum = Rational::zero();
            for (row, column, value) in matrix.entries() {
                sum += &p.0[row] * value * &t.0[column];
            }

            entries.push((i, j, sum));
        }
    }

    Sparse::from_entries(left.len(), right.len(), entries)
}

/// A certificate of the complete set, as far as few nodes lead, has one verdict on the system and
/// on its reduced pencil.
fn same_verdict(problem: &Problem, pencil: &Pencil) {
    let options = CompleteOptions {
        nodes_per_piece: NODES,
        threads: None,
        ..CompleteOptions::default()
    };

    let Ok(found) = complete(problem, &options, &Watch::nobody()) else {
        return;
    };

    let Ok(reduced) = Problem::new(
        Body::Pencil(pencil.clone()),
        problem.unknown(),
        problem.window().clone(),
    ) else {
        return;
    };

    let mut certificate = found.proved.into_certificate();
    let on_the_system = check(problem, &certificate);
    certificate.problem_sha256 = reduced.sha256();

    let on_the_pencil = check(&reduced, &certificate);
    match (on_the_system, on_the_pencil) {
        (Ok(a), Ok(b)) => assert!(
            a == b,
            "accepted with different content: {}",
            write_problem(problem)
        ),
        (a, b) => panic!(
            "on the system {:?}, on its pencil {:?}: {}",
            a.err(),
            b.err(),
            write_problem(problem)
        ),
    }
}
