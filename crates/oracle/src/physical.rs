//! The conditions (9) themselves, in the physical variables v and w: a second enumerator.
//!
//! ```text
//! w = (K + t M) v      (t = lambda^2),      or      w = K v, with mu = t the unknown
//! ```
//!
//! No variable is eliminated and none is renamed: this file shares no code with the reduction of
//! chapter 2, so that the two can be held against each other. Particles in contact with zero
//! reaction (z), which section 3 of the paper leaves out, are treated as well.
//!
//! Each particle is in one of three *modes*. With its unit tangent, its unit normal into the
//! obstacle, and cone(S) = S w_T + mu w_N (on a curved obstacle with the rates w_T + phi r_N and
//! w_N - phi r_T of the reaction in directions that turn by phi = kappa v_T, `spec/curvature.md`):
//!
//! | mode | equations |
//! |---|---|
//! | open | w_T = 0, w_N = 0 |
//! | sticking | v_T = 0, v_N = 0 |
//! | slipping with the sign S | v_N = 0, cone(S) = 0 |
//!
//! The state of a particle says which modes it may have, and with which inequalities:
//!
//! | state | modes |
//! |---|---|
//! | f | open |
//! | d | sticking |
//! | s with the sign S | sticking with cone(S) <= 0; slipping with S, S v_T < 0 |
//! | z | open, v_N < 0; sticking, cone(1), cone(-1), w_N <= 0; slipping, S v_T < 0, w_N <= 0 |
//!
//! The strict inequalities make the modes disjoint: a motion has one mode for each particle. For
//! each choice of modes the equations are N linear equations in v with coefficients linear in t;
//! the roots of their determinant are the candidates, and the kernel there is the motion.
//!
//! Choices whose determinant vanishes identically, and kernels of more than one dimension, are
//! listed and not described.
//!
//! Book: `spec/problem.md` (1.3) and `spec/zero-reaction.md`.

use super::integer_pencil::IntegerPencil;
use mceip_exact::{Algebraic, Poly, Rational, Sign, Sparse, cleared, common_denominator, roots_in};
use mceip_model::{ContactState, Direction, ModelError, Pencil, System, Unknown, Window};
use num_traits::{One, Zero};

/// What a contact particle does at the equilibrium, the particles of zero reaction included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PhysicalState {
    /// f: not in contact.
    Free,
    /// d: reaction strictly inside the friction cone.
    Stick,
    /// s: reaction on the friction cone, not zero; S = sign(r_T).
    Slip {
        /// 1 or -1.
        sign: i8,
    },
    /// z: in contact, reaction zero.
    Zero,
}

/// A contact particle: its directions over all degrees of freedom, and its state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhysicalParticle {
    /// The unit tangent.
    pub tangent: Direction,
    /// The unit normal into the obstacle.
    pub normal: Direction,
    /// Its coefficient of friction over mu.
    pub friction_factor: Rational,
    /// The curvature of the obstacle times the normal reaction at equilibrium, where it slips.
    pub geometric_stiffness: Rational,
    /// The state.
    pub state: PhysicalState,
}

/// The data of (9).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhysicalSystem {
    /// K, N x N.
    pub stiffness: Sparse,
    /// M, N x N: lambda^2 is the unknown; `None`: mu is.
    pub mass: Option<Sparse>,
    /// mu, where lambda^2 is the unknown; not used where mu is.
    pub friction: Rational,
    /// The contact particles; all other degrees of freedom are free.
    pub particles: Vec<PhysicalParticle>,
}

impl PhysicalSystem {
    /// The data of a system, for one of the two questions.
    ///
    /// # Errors
    /// [`ModelError::Missing`] without mass or friction if lambda^2 is the unknown.
    pub fn of(system: &System, unknown: Unknown) -> Result<PhysicalSystem, ModelError> {
        system.require_for(unknown)?;

        let mut particles = Vec::new();
        for particle in system.particles() {
            let state = match particle.state {
                ContactState::Free => PhysicalState::Free,
                ContactState::Stick => PhysicalState::Stick,
                ContactState::Slip { sign } => PhysicalState::Slip { sign },
                ContactState::Zero => PhysicalState::Zero,
            };
            particles.push(PhysicalParticle {
                tangent: particle.tangent(),
                normal: particle.into_obstacle(),
                friction_factor: particle.friction_factor.clone(),
                geometric_stiffness: match &particle.curvature {
                    Some(curvature) => &curvature.value * &curvature.normal_reaction,
                    None => Rational::zero(),
                },
                state,
            });
        }

        let mass = match unknown {
            Unknown::Lambda2 => system.mass().cloned(),
            Unknown::Mu | Unknown::Eigenvalue => None, // an eigenvalue is refused above
        };
        Ok(PhysicalSystem {
            stiffness: system.stiffness().clone(),
            mass,
            friction: system.friction().cloned().unwrap_or_default(),
            particles,
        })
    }
}

/// What a particle does in a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ParticleMode {
    /// It has no reaction.
    Open,
    /// It does not move.
    Sticking,
    /// It slides on the obstacle against the sign of its tangential reaction.
    Slipping {
        /// 1 or -1.
        sign: i8,
    },
}

/// A solution of (9), up to a positive factor that v and w share.
#[derive(Debug, Clone)]
pub struct Motion {
    /// lambda^2, or mu.
    pub value: Algebraic,
    /// The mode of each particle.
    pub modes: Vec<ParticleMode>,
    /// v over all degrees of freedom: integer polynomials to be evaluated at `value`.
    pub v: Vec<Poly>,
}

/// A choice of modes that is listed and not described.
#[derive(Debug, Clone)]
pub struct DegenerateModes {
    /// The mode of each particle.
    pub modes: Vec<ParticleMode>,
    /// The value with a kernel of more than one dimension; `None`: singular at every value.
    pub value: Option<Algebraic>,
}

/// What the enumerator found.
#[derive(Debug, Clone, Default)]
pub struct Motions {
    /// The motions, in the order of the choices of modes, then by value.
    pub motions: Vec<Motion>,
    /// What is not described.
    pub degenerate: Vec<DegenerateModes>,
    /// Choices of modes examined.
    pub choices: u64,
}

/// All solutions of (9) with a value in the window.
///
/// The work is (2^n_s 4^n_z) determinants of order N: meant for a few particles.
///
/// # Errors
/// [`ModelError`] where the matrices have not the order N.
pub fn enumerate_motions(system: &PhysicalSystem, window: &Window) -> Result<Motions, ModelError> {
    let mut found = Motions::default();
    for modes in all_choices(&system.particles) {
        examine(system, &modes, window, &mut found)?;
        found.choices += 1;
    }

    Ok(found)
}

/// The modes that a state admits.
fn admitted(state: PhysicalState) -> Vec<ParticleMode> {
    match state {
        PhysicalState::Free => vec![ParticleMode::Open],
        PhysicalState::Stick => vec![ParticleMode::Sticking],
        PhysicalState::Slip { sign } => {
            vec![ParticleMode::Sticking, ParticleMode::Slipping { sign }]
        }
        PhysicalState::Zero => vec![
            ParticleMode::Open,
            ParticleMode::Sticking,
            ParticleMode::Slipping { sign: 1 },
            ParticleMode::Slipping { sign: -1 },
        ],
    }
}

/// Every choice of one admitted mode for each particle.
fn all_choices(particles: &[PhysicalParticle]) -> Vec<Vec<ParticleMode>> {
    let mut choices: Vec<Vec<ParticleMode>> = vec![Vec::new()];
    for particle in particles {
        let mut longer = Vec::new();
        for choice in &choices {
            for mode in admitted(particle.state) {
                let mut extended = choice.clone();
                extended.push(mode);
                longer.push(extended);
            }
        }
        choices = longer;
    }

    choices
}

/// One choice of modes: its equations, the roots of their determinant, the kernels there.
fn examine(
    system: &PhysicalSystem,
    modes: &[ParticleMode],
    window: &Window,
    found: &mut Motions,
) -> Result<(), ModelError> {
    let equations = equations(system, modes);
    let pencil = square_pencil(&equations)?;
    let integers = IntegerPencil::from(&pencil);
    let all = integers.active(&[]);

    let det = integers.determinant(&all);
    if det.is_zero() {
        found.degenerate.push(DegenerateModes {
            modes: modes.to_vec(),
            value: None,
        });
        return Ok(());
    }

    let roots = roots_in(&det, window.min(), window.max());
    for eigenspace in integers.eigenspaces(&all, roots) {
        let [v] = &eigenspace.basis[..] else {
            found.degenerate.push(DegenerateModes {
                modes: modes.to_vec(),
                value: Some(eigenspace.value),
            });
            continue;
        };

        let opposite: Vec<Poly> = v.iter().map(|v_i| -v_i).collect();
        for v in [v.clone(), opposite] {
            let mut value = eigenspace.value.clone();
            if satisfies_inequalities(system, modes, &v, &mut value) {
                found.motions.push(Motion {
                    value,
                    modes: modes.to_vec(),
                    v,
                });
            }
        }
    }

    Ok(())
}

/// A linear form in v with coefficients linear in t: the sum of (constant_i + t slope_i) v_i.
#[derive(Debug, Clone)]
struct Form {
    constant: Vec<Rational>,
    slope: Vec<Rational>,
}

impl Form {
    fn zero(n: usize) -> Form {
        Form {
            constant: vec![Rational::zero(); n],
            slope: vec![Rational::zero(); n],
        }
    }

    /// direction . v
    fn motion(n: usize, direction: &Direction) -> Form {
        let mut form = Form::zero(n);
        for (dof, coefficient) in direction {
            form.constant[*dof] += coefficient;
        }
        form
    }

    /// direction . w with w = (K + t M) v, or w = K v.
    fn reaction(system: &PhysicalSystem, direction: &Direction) -> Form {
        let mut form = Form::zero(system.stiffness.rows());
        for (dof, coefficient) in direction {
            for (j, k) in system.stiffness.row(*dof) {
                form.constant[*j] += coefficient * k;
            }
            if let Some(mass) = &system.mass {
                for (j, m) in mass.row(*dof) {
                    form.slope[*j] += coefficient * m;
                }
            }
        }

        form
    }

    /// cone(S) = S w_T + c mu w_N, c the friction factor. Where mu is the unknown, w is constant
    /// and c w_N is the slope.
    fn cone(system: &PhysicalSystem, particle: &PhysicalParticle, sign: i8) -> Form {
        let tangential = Form::reaction(system, &particle.tangent);
        let normal = Form::reaction(system, &particle.normal).times(&particle.friction_factor);
        let sign = Rational::from_integer(sign.into());

        let mut form = tangential.times(&sign);
        if system.mass.is_some() {
            form.add(&normal.times(&system.friction));
            form.add(&Form::turned(system, particle, &sign));
        } else {
            form.slope = normal.constant;
        }

        form
    }

    /// What cone(S) has more in the directions that turn with a curved obstacle:
    /// S phi r_N - c mu phi r_T, where phi r_N = kappa r_N v_T and r_T = -S c mu r_N.
    fn turned(system: &PhysicalSystem, particle: &PhysicalParticle, sign: &Rational) -> Form {
        let n = system.stiffness.rows();
        let phi_r_n = Form::motion(n, &particle.tangent).times(&particle.geometric_stiffness);
        let own_friction = &system.friction * &particle.friction_factor;
        let phi_r_t = phi_r_n.times(&-(sign * &own_friction));

        let mut sum = phi_r_n.times(sign);
        sum.add(&phi_r_t.times(&-own_friction));
        sum
    }

    fn times(&self, factor: &Rational) -> Form {
        Form {
            constant: self.constant.iter().map(|c| c * factor).collect(),
            slope: self.slope.iter().map(|c| c * factor).collect(),
        }
    }

    fn add(&mut self, other: &Form) {
        for (sum, c) in self.constant.iter_mut().zip(&other.constant) {
            *sum += c;
        }
        for (sum, c) in self.slope.iter_mut().zip(&other.slope) {
            *sum += c;
        }
    }

    /// The sign of the form for v, whose entries are polynomials at a value.
    fn sign(&self, v: &[Poly], value: &mut Algebraic) -> Sign {
        let clear = common_denominator(self.constant.iter().chain(&self.slope));
        let mut sum = Poly::default();
        for ((constant, slope), v_i) in self.constant.iter().zip(&self.slope).zip(v) {
            let entry = [constant, slope].map(|c| cleared(c, &clear));
            sum += &(&Poly::new(entry.to_vec()) * v_i);
        }

        value.sign_of(&sum)
    }
}

/// The N equations of a choice of modes.
fn equations(system: &PhysicalSystem, modes: &[ParticleMode]) -> Vec<Form> {
    let n = system.stiffness.rows();
    let mut equations = Vec::new();

    for (particle, mode) in system.particles.iter().zip(modes) {
        match mode {
            ParticleMode::Open => {
                equations.push(Form::reaction(system, &particle.tangent));
                equations.push(Form::reaction(system, &particle.normal));
            }
            ParticleMode::Sticking => {
                equations.push(Form::motion(n, &particle.tangent));
                equations.push(Form::motion(n, &particle.normal));
            }
            ParticleMode::Slipping { sign } => {
                equations.push(Form::motion(n, &particle.normal));
                equations.push(Form::cone(system, particle, *sign));
            }
        }
    }

    for dof in dofs_without_particle(system) {
        let direction = vec![(dof, Rational::one())];
        equations.push(Form::reaction(system, &direction));
    }

    equations
}

/// The degrees of freedom that no particle uses.
fn dofs_without_particle(system: &PhysicalSystem) -> Vec<usize> {
    let mut is_used = vec![false; system.stiffness.rows()];
    for particle in &system.particles {
        for (dof, _) in particle.tangent.iter().chain(&particle.normal) {
            is_used[*dof] = true;
        }
    }

    (0..is_used.len()).filter(|&dof| !is_used[dof]).collect()
}

/// The equations as a pencil all of whose variables are free: only determinant and kernel are used.
fn square_pencil(equations: &[Form]) -> Result<Pencil, ModelError> {
    let n = equations.len();
    let mut constants = Vec::new();
    let mut slopes = Vec::new();

    for (i, form) in equations.iter().enumerate() {
        for (j, c) in form.constant.iter().enumerate() {
            constants.push((i, j, c.clone()));
        }
        for (j, c) in form.slope.iter().enumerate() {
            slopes.push((i, j, c.clone()));
        }
    }

    let a = Sparse::from_entries(n, n, constants);
    let b = Sparse::from_entries(n, n, slopes);
    Pencil::new(a, b, (0..n).collect())
}

/// Do the inequalities of the modes hold?
fn satisfies_inequalities(
    system: &PhysicalSystem,
    modes: &[ParticleMode],
    v: &[Poly],
    value: &mut Algebraic,
) -> bool {
    system
        .particles
        .iter()
        .zip(modes)
        .all(|(particle, mode)| admits(system, particle, *mode, v, value))
}

/// Do the inequalities of one particle hold in its mode?
fn admits(
    system: &PhysicalSystem,
    particle: &PhysicalParticle,
    mode: ParticleMode,
    v: &[Poly],
    value: &mut Algebraic,
) -> bool {
    let n = system.stiffness.rows();
    let normal_reaction = Form::reaction(system, &particle.normal);

    match (particle.state, mode) {
        (PhysicalState::Free | PhysicalState::Stick, _) => true,

        (PhysicalState::Slip { sign }, ParticleMode::Sticking) => {
            let cone = Form::cone(system, particle, sign);
            cone.sign(v, value) != Sign::Positive
        }

        (PhysicalState::Slip { .. }, ParticleMode::Slipping { sign }) => {
            slides(n, particle, sign, v, value)
        }

        (PhysicalState::Zero, ParticleMode::Open) => {
            let normal_motion = Form::motion(n, &particle.normal);
            normal_motion.sign(v, value) == Sign::Negative
        }

        (PhysicalState::Zero, ParticleMode::Sticking) => {
            let right = Form::cone(system, particle, -1);
            let left = Form::cone(system, particle, 1);
            right.sign(v, value) != Sign::Positive
                && left.sign(v, value) != Sign::Positive
                && normal_reaction.sign(v, value) != Sign::Positive
        }

        (PhysicalState::Zero, ParticleMode::Slipping { sign }) => {
            slides(n, particle, sign, v, value) && normal_reaction.sign(v, value) != Sign::Positive
        }

        (PhysicalState::Slip { .. }, ParticleMode::Open) => false,
    }
}

/// S v_T < 0
fn slides(
    n: usize,
    particle: &PhysicalParticle,
    sign: i8,
    v: &[Poly],
    value: &mut Algebraic,
) -> bool {
    let tangential = Form::motion(n, &particle.tangent);
    let against = Rational::from_integer(sign.into());
    tangential.times(&against).sign(v, value) == Sign::Negative
}
