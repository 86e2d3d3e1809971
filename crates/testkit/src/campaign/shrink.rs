//! Smaller instances that still disagree: fewer particles and variables, simpler numbers, the same
//! structure.
//!
//! [`smaller`] lists the neighbours of a case, each smaller in the order of [`Size`]; [`shrink`]
//! goes from neighbour to neighbour as long as the engines disagree in the same way. Input: a case
//! and its finding. Output: the smallest case met, with its finding. Called by the campaign's run
//! before a replay file is written.

use super::engine::{Engine, Finding, judge};
use super::expected::Expected;
use super::family::CampaignCase;
use crate::families::Instance;
use mceip_exact::{Integer, Rational, Sparse, rational, whole};
use mceip_model::{Body, ModelError, Particle, Pencil, Problem, QuadraticPencil, System, Window};
use mceip_oracle::TwoParticles;
use mceip_paper::two_particles;
use num_traits::{One, Signed, Zero};

/// Instances tried for one disagreement, at most: each costs a run of the engines.
pub const MAX_TRIES: usize = 400;

/// Shrinks a case as long as `engines` still find a disagreement of this engine and kind, and
/// returns it with what it then says. What is known by construction goes with the first change of
/// the problem itself.
pub fn shrink(
    case: &CampaignCase,
    finding: &Finding,
    engines: &[Box<dyn Engine>],
) -> (CampaignCase, Finding) {
    let mut best = case.clone();
    let mut says = finding.clone();
    let mut tries = MAX_TRIES;
    let mut improved = true;

    while improved && tries > 0 {
        improved = false;
        for candidate in smaller(&best) {
            if tries == 0 {
                break;
            }

            tries -= 1;
            let again = judge(&candidate, engines)
                .findings
                .into_iter()
                .find(|f| f.kind() == says.kind());

            if let Some(again) = again {
                best = candidate;
                says = again;
                improved = true;
                break;
            }
        }
    }

    (best, says)
}

/// Cases next to this one and smaller, those that drop most first. Every one has fewer variables,
/// or fewer entries and features, or shorter numbers, so that shrinking ends.
pub fn smaller(case: &CampaignCase) -> Vec<CampaignCase> {
    let problem = &case.instance.problem;
    let mut out = Vec::new();

    if let Some(data) = &case.instance.closed_form {
        for simpler in simpler_data(data) {
            out.extend(with_data(case, simpler).ok());
        }
    }

    for body in smaller_bodies(problem.body()) {
        let changed = Problem::new(body, problem.unknown(), problem.window().clone());
        out.extend(changed.ok().map(|p| with_problem(case, p)));
    }

    if *problem.window() != Window::all() {
        let everywhere = problem.clone().with_window(Window::all());
        out.push(with_problem(case, everywhere));
    }

    // A candidate with the same problem drops nothing but the closed form.
    let size = Size::of(case);
    out.retain(|c| Size::of(c) < size && c.instance.problem != *problem);
    out
}

/// How large a case is; compared in the order of the fields.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Size {
    /// Variables of a pencil, degrees of freedom of a system.
    order: usize,
    /// Entries of the matrices that are not zero, frames, reversed normals, a window.
    features: usize,
    /// Bits of all numbers.
    bits: u64,
}

impl Size {
    fn of(case: &CampaignCase) -> Size {
        let problem = &case.instance.problem;
        let mut size = match problem.body() {
            Body::Pencil(pencil) => Size::of_matrices(&[pencil.a(), pencil.b()]),
            Body::Quadratic(quadratic) => Size::of_matrices(&quadratic.coefficients()),
            Body::System(system) => Size::of_system(system),
        };

        size.features += usize::from(*problem.window() != Window::all());
        if let Some(d) = &case.instance.closed_form {
            size.bits += bits(&d.c) + bits(&d.s) + bits(&d.k) + bits(&d.m) + bits(&d.mu);
        }
        size
    }

    fn of_matrices(matrices: &[&Sparse]) -> Size {
        Size {
            order: matrices.first().map_or(0, |matrix| matrix.rows()),
            features: matrices.iter().map(|m| m.entries().count()).sum(),
            bits: matrices.iter().map(|m| bits_of_matrix(m)).sum(),
        }
    }

    fn of_system(system: &System) -> Size {
        let mut features = system.stiffness().entries().count();
        let mut all_bits = bits_of_matrix(system.stiffness());

        if let Some(mass) = system.mass() {
            features += mass.entries().count();
            all_bits += bits_of_matrix(mass);
        }
        if let Some(friction) = system.friction() {
            all_bits += bits(friction);
        }
        for particle in system.particles() {
            features += usize::from(particle.frame.is_some());
            features += usize::from(particle.normal_direction < 0);
        }

        Size {
            order: system.dofs(),
            features,
            bits: all_bits,
        }
    }
}

/// Bits of numerator and denominator.
fn bits(v: &Rational) -> u64 {
    v.numer().bits() + v.denom().bits()
}

/// Bits of all entries.
fn bits_of_matrix(matrix: &Sparse) -> u64 {
    matrix.entries().map(|(_, _, v)| bits(v)).sum()
}

/// The case with another problem, of whose answer nothing is known.
fn with_problem(case: &CampaignCase, problem: Problem) -> CampaignCase {
    CampaignCase {
        id: case.id.clone(),
        instance: Instance {
            problem,
            closed_form: None,
            ..case.instance.clone()
        },
        expected: Expected::default(),
    }
}

/// The case with other data of Table 1, and the problem that they make.
fn with_data(case: &CampaignCase, data: TwoParticles) -> Result<CampaignCase, ModelError> {
    let body = Body::System(two_particles(&data)?);
    let unknown = case.instance.problem.unknown();
    let problem = Problem::new(body, unknown, Window::all())?;

    let mut changed = with_problem(case, problem);
    changed.instance.closed_form = Some(data);
    Ok(changed)
}

/// The angle of 3, 4, 5; k = 1; m = 1; a simpler mu.
fn simpler_data(d: &TwoParticles) -> Vec<TwoParticles> {
    let mut out = vec![
        TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            ..d.clone()
        },
        TwoParticles {
            k: Rational::one(),
            ..d.clone()
        },
        TwoParticles {
            m: Rational::one(),
            ..d.clone()
        },
    ];

    for mu in simpler(&d.mu) {
        if mu.is_positive() {
            out.push(TwoParticles { mu, ..d.clone() });
        }
    }
    out
}

/// Shorter numbers in place of `v`: 1 or -1, the integer part, half as many digits after the point
/// or before it. None of them is 0, which callers try by themselves.
fn simpler(v: &Rational) -> Vec<Rational> {
    let mut out = vec![
        v.signum(),
        v.trunc(),
        with_half_the_denominator(v),
        with_half_the_numerator(v),
    ];
    out.retain(|w| !w.is_zero() && bits(w) < bits(v));
    out
}

/// `v` cut to a fraction over a power of 2 with half as many bits as the denominator.
fn with_half_the_denominator(v: &Rational) -> Rational {
    let scale = Integer::one() << (v.denom().bits() / 2);
    let cut = (v * Rational::from_integer(scale.clone())).to_integer();
    Rational::new(cut, scale)
}

/// The integer part of `v` with the lower half of its bits set to zero.
fn with_half_the_numerator(v: &Rational) -> Rational {
    let shift = v.numer().bits() / 2;
    let high = v.to_integer() >> shift;
    Rational::from_integer(high << shift)
}

/// What can be made of a body by one change; what the model refuses is left out.
fn smaller_bodies(body: &Body) -> Vec<Body> {
    match body {
        Body::Pencil(pencil) => smaller_pencils(pencil)
            .into_iter()
            .flatten()
            .map(Body::Pencil)
            .collect(),
        Body::Quadratic(quadratic) => smaller_quadratics(quadratic)
            .into_iter()
            .flatten()
            .map(Body::Quadratic)
            .collect(),
        Body::System(system) => smaller_systems(system)
            .into_iter()
            .flatten()
            .map(Body::System)
            .collect(),
    }
}

/// Bodies that the model may refuse.
type Tried<T> = Vec<Result<T, ModelError>>;

/// The pencil without one variable, or with one simpler entry of A or B.
fn smaller_pencils(pencil: &Pencil) -> Tried<Pencil> {
    let n = pencil.order();
    let mut out = Vec::new();

    for dropped in 0..n {
        let keep: Vec<usize> = (0..n).filter(|i| *i != dropped).collect();
        let a = pencil.a().submatrix(&keep, &keep);
        let b = pencil.b().submatrix(&keep, &keep);
        let free = (0..keep.len())
            .filter(|&k| pencil.free().contains(&keep[k]))
            .collect();
        out.push(Pencil::new(a, b, free));
    }

    for a in simpler_matrices(pencil.a(), MatrixShape::Any) {
        out.push(Pencil::new(a, pencil.b().clone(), pencil.free().to_vec()));
    }
    for b in simpler_matrices(pencil.b(), MatrixShape::Any) {
        out.push(Pencil::new(pencil.a().clone(), b, pencil.free().to_vec()));
    }
    out
}

/// The quadratic pencil without one variable, or with one simpler entry.
fn smaller_quadratics(quadratic: &QuadraticPencil) -> Tried<QuadraticPencil> {
    let n = quadratic.order();
    let [a, b, c] = quadratic.coefficients();
    let mut out = Vec::new();

    for dropped in 0..n {
        let keep: Vec<usize> = (0..n).filter(|i| *i != dropped).collect();
        let [a, b, c] = [a, b, c].map(|matrix| matrix.submatrix(&keep, &keep));
        out.push(QuadraticPencil::new(a, b, c));
    }

    let simpler = |matrix| simpler_matrices(matrix, MatrixShape::Any);
    for simpler_a in simpler(a) {
        out.push(QuadraticPencil::new(simpler_a, b.clone(), c.clone()));
    }
    for simpler_b in simpler(b) {
        out.push(QuadraticPencil::new(a.clone(), simpler_b, c.clone()));
    }
    for simpler_c in simpler(c) {
        out.push(QuadraticPencil::new(a.clone(), b.clone(), simpler_c));
    }
    out
}

/// The system without one particle or one dof, with one simpler particle, with a simpler friction,
/// or with one simpler entry of K or M.
fn smaller_systems(system: &System) -> Tried<System> {
    let mut out = Vec::new();
    for group in removable_dofs(system) {
        out.push(without(system, &group));
    }

    for k in 0..system.particles().len() {
        out.push(with_particle(system, k, |p| p.frame = None));
        out.push(with_particle(system, k, |p| p.normal_direction = 1));
        out.push(with_particle(system, k, |p| p.reaction = None));
        out.push(with_particle(system, k, |p| p.curvature = None));
    }

    for mu in system.friction().into_iter().flat_map(simpler) {
        let stiffness = system.stiffness().clone();
        let mass = system.mass().cloned();
        let particles = system.particles().to_vec();
        out.push(System::new(stiffness, mass, Some(mu), particles));
    }

    for stiffness in simpler_matrices(system.stiffness(), MatrixShape::Symmetric) {
        let mass = system.mass().cloned();
        let particles = system.particles().to_vec();
        out.push(rebuilt(system, stiffness, mass, particles));
    }
    if let Some(mass) = system.mass() {
        for mass in simpler_matrices(mass, MatrixShape::Symmetric) {
            let stiffness = system.stiffness().clone();
            let particles = system.particles().to_vec();
            out.push(rebuilt(system, stiffness, Some(mass), particles));
        }
    }
    out
}

/// The system with the same friction and other matrices and particles.
fn rebuilt(
    system: &System,
    stiffness: Sparse,
    mass: Option<Sparse>,
    particles: Vec<Particle>,
) -> Result<System, ModelError> {
    System::new(stiffness, mass, system.friction().cloned(), particles)
}

/// Sets of dofs that can be taken away together: the two of each particle, then each dof of no
/// particle.
fn removable_dofs(system: &System) -> Vec<Vec<usize>> {
    let mut out = Vec::new();
    for particle in system.particles() {
        out.push(vec![particle.tangential, particle.normal]);
    }

    for dof in 0..system.dofs() {
        let is_owned = system
            .particles()
            .iter()
            .any(|p| p.tangential == dof || p.normal == dof);
        if !is_owned {
            out.push(vec![dof]);
        }
    }
    out
}

/// The system without these dofs; particles that lose one are left out.
fn without(system: &System, dofs: &[usize]) -> Result<System, ModelError> {
    let keep: Vec<usize> = (0..system.dofs()).filter(|d| !dofs.contains(d)).collect();
    let stiffness = system.stiffness().submatrix(&keep, &keep);
    let mass = system.mass().map(|m| m.submatrix(&keep, &keep));

    let mut particles = Vec::new();
    for particle in system.particles() {
        let tangential = keep.iter().position(|k| *k == particle.tangential);
        let normal = keep.iter().position(|k| *k == particle.normal);
        if let (Some(tangential), Some(normal)) = (tangential, normal) {
            particles.push(Particle {
                tangential,
                normal,
                ..particle.clone()
            });
        }
    }

    rebuilt(system, stiffness, mass, particles)
}

/// The system with its `k`-th particle changed.
fn with_particle(
    system: &System,
    k: usize,
    change: fn(&mut Particle),
) -> Result<System, ModelError> {
    let mut particles = system.particles().to_vec();
    change(&mut particles[k]);
    system.with_particles(particles)
}

/// What has to stay true of a matrix.
#[derive(Clone, Copy, PartialEq, Eq)]
enum MatrixShape {
    Any,
    Symmetric,
}

/// The matrix with one entry (and its mirror image, if it is to stay symmetric) zero or simpler,
/// zeros first.
fn simpler_matrices(matrix: &Sparse, shape: MatrixShape) -> Vec<Sparse> {
    let mut with_a_zero = Vec::new();
    let mut with_a_simpler_entry = Vec::new();

    for (i, j, v) in matrix.entries() {
        let is_mirror_image = shape == MatrixShape::Symmetric && i > j;
        if is_mirror_image {
            continue;
        }

        with_a_zero.push(with_entry(matrix, (i, j), &whole(0), shape));
        for simpler in simpler(v) {
            with_a_simpler_entry.push(with_entry(matrix, (i, j), &simpler, shape));
        }
    }

    with_a_zero.append(&mut with_a_simpler_entry);
    with_a_zero
}

/// The matrix with `new` in one place (and its mirror image, if it is to stay symmetric).
fn with_entry(
    matrix: &Sparse,
    place: (usize, usize),
    new: &Rational,
    shape: MatrixShape,
) -> Sparse {
    let mut entries = Vec::new();
    for (row, column, old) in matrix.entries() {
        let is_here = (row, column) == place;
        let is_mirror_image = shape == MatrixShape::Symmetric && (column, row) == place;
        let value = if is_here || is_mirror_image { new } else { old };
        entries.push((row, column, value.clone()));
    }
    Sparse::from_entries(matrix.rows(), matrix.cols(), entries)
}
