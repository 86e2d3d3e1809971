//! The equations of motion in the coordinates q of the motions that the contact admits.
//!
//! ```text
//! z = sum_c q_c e_c,    q_f = z_f,    q_s = -S z_T      so that q_s' >= 0 is slip
//! M* q'' + K* q = p,    p_f = 0,      0 <= q_s' _|_ p_s >= 0,      p_s = -(S rho_T + mu rho_N)
//! ```
//!
//! Row r of M* is the reaction that p_r names, for each admitted motion: with the functional g_r
//! (the dof itself for f, -(S t + mu n) for an s particle with tangent t and normal n),
//! M*_rc = g_r' M e_c, and K* likewise. The energy has symmetric matrices: e_r' M e_c, e_r' K e_c.

use mceip_exact::{Sparse, to_f64};
use mceip_model::{ContactState, Direction, ModelError, System, Unknown};
use nalgebra::{DMatrix, DVector, RowDVector};

/// Why there is no motion to compute.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The system has no mass, no friction coefficient or no slip particle.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A vector has not one entry for each degree of freedom.
    #[error("motion: expected a displacement of {expected} degrees of freedom, got {got}")]
    Length {
        /// Degrees of freedom.
        expected: usize,
        /// Entries given.
        got: usize,
    },
    /// A length of time or a number of steps that is none.
    #[error("motion: expected a finite time > 0 and at least one step, got {duration} and {steps}")]
    Plan {
        /// Time.
        duration: f64,
        /// Steps.
        steps: usize,
    },
    /// Steps are short enough if the problem of each has one solution.
    #[error("motion: expected steps shorter than {step}, for which a step has one solution")]
    LongStep {
        /// Its length.
        step: f64,
    },
    /// The numbers leave the range of doubles, or a matrix that is definite is not so in doubles.
    #[error("motion: expected numbers that doubles can hold, got {what}")]
    Doubles {
        /// What was met.
        what: &'static str,
    },
    /// Pivoting on the problem of a step ends only if it has one solution.
    #[error(
        "motion: expected one solution of the step at time {time}, got none after {pivots} pivots"
    )]
    Pivots {
        /// Time of the step.
        time: f64,
        /// Pivots made.
        pivots: usize,
    },
}

/// An admitted motion or a functional: a few pairs of a degree of freedom and a coefficient.
type Pairs = Vec<(usize, f64)>;

/// M*, K* and what belongs to them, in doubles. The free coordinates come first.
#[derive(Debug, Clone)]
pub struct Equations {
    dofs: usize,
    /// e_c for each coordinate.
    moved: Vec<Pairs>,
    free: usize,
    slip: Vec<usize>,
    pub(crate) mass: DMatrix<f64>,
    pub(crate) stiffness: DMatrix<f64>,
    pub(crate) energy_mass: DMatrix<f64>,
    pub(crate) energy_stiffness: DMatrix<f64>,
    pub(crate) watched: Vec<WatchedParticle>,
}

/// A particle in contact whose reaction at equilibrium is known.
#[derive(Debug, Clone)]
pub(crate) struct WatchedParticle {
    pub(crate) particle: usize,
    /// Where it may slip.
    pub(crate) slip: Option<WatchedSlip>,
    pub(crate) friction: f64,
    /// r^0_T and r^0_N.
    pub(crate) tangential: f64,
    pub(crate) normal: f64,
    pub(crate) tangential_rate: Reactions,
    pub(crate) normal_rate: Reactions,
}

/// S of an s particle, and its number among the slip coordinates.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WatchedSlip {
    pub(crate) sign: f64,
    pub(crate) number: usize,
}

/// A component of rho as a function of the motion: mass q'' + stiffness q.
#[derive(Debug, Clone)]
pub(crate) struct Reactions {
    pub(crate) mass: RowDVector<f64>,
    pub(crate) stiffness: RowDVector<f64>,
}

impl Equations {
    /// The equations of a system.
    ///
    /// # Errors
    /// [`MotionError::Model`] without mass, friction coefficient or slip particle, with a particle
    /// in contact with zero reaction, or with a curved obstacle; [`MotionError::Doubles`] where
    /// entries leave their range.
    pub fn new(system: &System) -> Result<Equations, MotionError> {
        system.require_for(Unknown::Lambda2)?;
        system.require_no_zero()?;
        system.require_flat()?;
        let mass = required("mass", system.mass())?;
        let friction = to_f64(required("friction", system.friction())?);
        let free = system.free_dofs();

        let mut moved: Vec<Pairs> = free.iter().map(|dof| vec![(*dof, 1.0)]).collect();
        let mut functionals = moved.clone();
        let mut slip = Vec::new();
        for (index, particle) in system.particles().iter().enumerate() {
            if let ContactState::Slip { sign } = particle.state {
                let opposite = -f64::from(sign);
                let slips = times(opposite, &particle.tangent());
                let mut cone = slips.clone();
                cone.extend(times(-friction, &particle.friction_direction()));

                moved.push(slips);
                functionals.push(cone);
                slip.push(index);
            }
        }

        let motions = AdmittedMotions::new(mass, system, &moved);
        let mut watched = Vec::new();
        for index in 0..system.particles().len() {
            watched.extend(WatchedParticle::new(system, &motions, index, friction));
        }

        let equations = Equations {
            dofs: system.dofs(),
            free: free.len(),
            slip,
            mass: motions.matrix(mass, &functionals),
            stiffness: motions.matrix(system.stiffness(), &functionals),
            energy_mass: motions.matrix(mass, &moved),
            energy_stiffness: motions.matrix(system.stiffness(), &moved),
            watched,
            moved,
        };

        let mut entries = equations.mass.iter().chain(&equations.stiffness);
        if entries.any(|entry| !entry.is_finite()) {
            return Err(MotionError::Doubles {
                what: "an entry that is not finite",
            });
        }
        Ok(equations)
    }

    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.moved.len()
    }

    /// Number of free coordinates, which come first.
    pub fn free(&self) -> usize {
        self.free
    }

    /// The particle of each slip coordinate.
    pub fn slip_particles(&self) -> &[usize] {
        &self.slip
    }

    /// The coordinates of a displacement over the degrees of freedom that the contact admits.
    ///
    /// # Errors
    /// [`MotionError::Length`].
    pub fn coordinates(&self, displacement: &[f64]) -> Result<DVector<f64>, MotionError> {
        if displacement.len() != self.dofs {
            return Err(MotionError::Length {
                expected: self.dofs,
                got: displacement.len(),
            });
        }

        // The e_c are unit vectors with no degree of freedom in common.
        let mut coordinates = DVector::zeros(self.order());
        for (c, motion) in self.moved.iter().enumerate() {
            for (dof, coefficient) in motion {
                coordinates[c] += coefficient * displacement[*dof];
            }
        }

        Ok(coordinates)
    }

    /// The displacement over the degrees of freedom.
    pub fn displacement(&self, coordinates: &DVector<f64>) -> Vec<f64> {
        let mut displacement = vec![0.0; self.dofs];
        for (c, motion) in self.moved.iter().enumerate() {
            for (dof, coefficient) in motion {
                displacement[*dof] += coefficient * coordinates[c];
            }
        }

        displacement
    }

    /// The elastic norm of a displacement: the root of twice its elastic energy.
    pub fn elastic_norm(&self, coordinates: &DVector<f64>) -> f64 {
        coordinates
            .dot(&(&self.energy_stiffness * coordinates))
            .max(0.0)
            .sqrt()
    }

    /// The root of twice the energy, elastic and kinetic.
    pub fn energy_norm(&self, coordinates: &DVector<f64>, velocity: &DVector<f64>) -> f64 {
        let kinetic = velocity.dot(&(&self.energy_mass * velocity));
        self.elastic_norm(coordinates)
            .hypot(kinetic.max(0.0).sqrt())
    }

    /// The longest period of the system if all its s particles slipped without friction.
    ///
    /// Inverse iteration on K e = omega^2 M e; a few digits suffice, it is a unit of time.
    ///
    /// # Errors
    /// [`MotionError::Doubles`] where K is not definite in doubles.
    pub fn longest_period(&self) -> Result<f64, MotionError> {
        const ITERATIONS: usize = 30;

        let factor = self.energy_stiffness.clone().cholesky();
        let factor = factor.ok_or(MotionError::Doubles {
            what: "a K that is not definite",
        })?;

        let mut shape = DVector::from_element(self.order(), 1.0);
        for _ in 0..ITERATIONS {
            shape = factor.solve(&(&self.energy_mass * shape));
            // Not the l2 norm: the squares of a mass in other units may be 0 in doubles.
            shape /= shape.amax();
        }

        let mass = shape.dot(&(&self.energy_mass * &shape));
        let stiffness = shape.dot(&(&self.energy_stiffness * &shape));
        // What rounding may leave of e'Ke where it is zero: the terms that cancel, whatever their
        // units.
        let shape = shape.abs();
        let terms = shape.dot(&(self.energy_stiffness.abs() * &shape));
        let rounding = f64::EPSILON * self.order() as f64 * terms;
        if stiffness <= rounding {
            return Err(MotionError::Doubles {
                what: "a K that is singular on the motions that the contacts leave: one of them \
                       needs no force, so no period measures the time",
            });
        }

        Ok(std::f64::consts::TAU * (mass / stiffness).sqrt())
    }
}

impl WatchedParticle {
    /// `None` for a particle out of contact, or whose reaction is not given.
    fn new(
        system: &System,
        motions: &AdmittedMotions<'_>,
        index: usize,
        mu: f64,
    ) -> Option<WatchedParticle> {
        let particle = &system.particles()[index];
        let reaction = particle.reaction.as_ref()?;
        let before = &system.particles()[..index];
        let slip_before = before
            .iter()
            .filter(|p| matches!(p.state, ContactState::Slip { .. }));
        let slip = match particle.state {
            ContactState::Free | ContactState::Zero => return None,
            ContactState::Stick => None,
            ContactState::Slip { sign } => Some(WatchedSlip {
                sign: f64::from(sign),
                number: slip_before.count(),
            }),
        };

        Some(WatchedParticle {
            particle: index,
            slip,
            friction: mu * to_f64(&particle.friction_factor),
            tangential: to_f64(&reaction.tangential),
            normal: to_f64(&reaction.normal),
            tangential_rate: motions.reactions(&particle.tangent()),
            normal_rate: motions.reactions(&particle.into_obstacle()),
        })
    }
}

/// What the motion needs of a system.
fn required<T>(what: &'static str, given: Option<T>) -> Result<T, ModelError> {
    given.ok_or(ModelError::Missing {
        equation: "E3",
        what,
        unknown: Unknown::Lambda2.word(),
    })
}

/// The direction times a factor, in doubles.
fn times(factor: f64, direction: &Direction) -> Pairs {
    let mut pairs = Vec::new();
    for (dof, coefficient) in direction {
        pairs.push((*dof, factor * to_f64(coefficient)));
    }

    pairs
}

/// The admitted motions by degree of freedom: which coordinates move it, and how far.
struct AdmittedMotions<'a> {
    mass: &'a Sparse,
    stiffness: &'a Sparse,
    order: usize,
    by_dof: Vec<Pairs>,
}

impl<'a> AdmittedMotions<'a> {
    fn new(mass: &'a Sparse, system: &'a System, moved: &[Pairs]) -> AdmittedMotions<'a> {
        let mut by_dof = vec![Vec::new(); system.dofs()];
        for (c, motion) in moved.iter().enumerate() {
            for (dof, coefficient) in motion {
                by_dof[*dof].push((c, *coefficient));
            }
        }

        AdmittedMotions {
            mass,
            stiffness: system.stiffness(),
            order: moved.len(),
            by_dof,
        }
    }

    /// g' A e_c for all c.
    fn row(&self, matrix: &Sparse, functional: &[(usize, f64)]) -> RowDVector<f64> {
        let mut row = RowDVector::zeros(self.order);
        for (i, g_i) in functional {
            for (j, entry) in matrix.row(*i) {
                let force = g_i * to_f64(entry);
                for (c, e_cj) in &self.by_dof[*j] {
                    row[*c] += force * e_cj;
                }
            }
        }

        row
    }

    /// The component of rho in a direction.
    fn reactions(&self, direction: &Direction) -> Reactions {
        let functional = times(1.0, direction);
        Reactions {
            mass: self.row(self.mass, &functional),
            stiffness: self.row(self.stiffness, &functional),
        }
    }

    /// g_r' A e_c for all r and c.
    fn matrix(&self, matrix: &Sparse, functionals: &[Pairs]) -> DMatrix<f64> {
        let rows: Vec<RowDVector<f64>> = functionals.iter().map(|g| self.row(matrix, g)).collect();
        DMatrix::from_rows(&rows)
    }
}
