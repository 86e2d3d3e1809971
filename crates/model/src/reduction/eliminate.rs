//! The elimination (10)-(16): from a mechanical system to the pencil of its eigenproblem.
//!
//! Stick particles and the normal degrees of freedom of slip particles leave the problem (v = 0),
//! and v_T = -S x turns the slip rates into x >= 0. With G = lambda^2 M + K, f the free degrees of
//! freedom, T and N the tangential and normal directions of the slip particles, the lines w_f = 0
//! and -(S w_T + mu w_N) = y of (9) become, by (16),
//!
//! ```text
//! K0 = [  K_ff     -K_fT S  ]      K1 = [   0       0     ]
//!      [ -S K_Tf  S K_TT S  ],          [ -K_Nf   K_NT S  ],
//! ```
//!
//! M0 and M1 likewise. MCEIP-mu is the pencil K0 + mu K1; MCEIP-lambda2 is K* + lambda^2 M* with
//! K* = K0 + mu K1 and M* = M0 + mu M1.
//!
//! Directions t_p and n_p may be oblique: the entries of K_TT are t_p' K t_q, those of K_NT are
//! n_p' K t_q, and the columns of K_fT are (K t_q)_f. Where a particle has a friction factor of its
//! own, its row of K1 is multiplied by that factor: n_p is its friction direction.
//!
//! Input: a [`Problem`] or [`System`] whose preconditions have been established (K and M are
//! symmetric). Called by everything that solves or enumerates, never by `check`, which has its own
//! way.

use crate::{Body, Direction, ModelError, Pencil, Problem, System, Unknown, ZeroVariables};
use mceip_exact::{Rational, Sparse};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// What a variable of the reduced pencil stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Variable {
    /// x = v at a degree of freedom of f.
    Free {
        /// The degree of freedom.
        dof: usize,
    },
    /// x = -S v_T of a particle in impending slip.
    Slip {
        /// S = sign(r_T).
        sign: i8,
        /// Its unit tangent.
        tangent: Direction,
        /// Its unit normal into the obstacle.
        normal: Direction,
    },
    /// One of the three variables of a particle in contact with zero reaction.
    Zero {
        /// Their places.
        variables: ZeroVariables,
        /// Which of the three.
        part: ZeroPart,
        /// The motion that belongs to x = 1.
        column: Direction,
    },
}

/// The variables of a particle in contact with zero reaction (`spec/zero-reaction.md`, Z.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ZeroPart {
    /// g = -v_N.
    Gap,
    /// v+ = max(v_T, 0).
    Right,
    /// v- = max(-v_T, 0).
    Left,
}

impl ZeroPart {
    /// The word of reports.
    pub fn word(self) -> &'static str {
        match self {
            ZeroPart::Gap => "gap",
            ZeroPart::Right => "right",
            ZeroPart::Left => "left",
        }
    }
}

impl Variable {
    /// The motion v that belongs to x = 1. // (10)
    pub fn column(&self) -> Direction {
        match self {
            Variable::Free { dof } => vec![(*dof, Rational::one())],
            Variable::Zero { column, .. } => column.clone(),
            Variable::Slip { sign, tangent, .. } => {
                let minus_s = Rational::from_integer((-sign).into());
                tangent.iter().map(|(d, c)| (*d, c * &minus_s)).collect()
            }
        }
    }
}

/// A pencil with the meaning of its variables: f ascending, then slip particles in file order, then
/// gap, right and left of each particle in contact with zero reaction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reduced {
    /// The pencil of (12) or (21).
    pub pencil: Pencil,
    /// One entry per variable; empty for a problem that was given as a pencil.
    pub variables: Vec<Variable>,
}

impl Reduced {
    /// The variables of e'x_s, by which solutions are normalised: the complementarity variables but
    /// those of particles in contact with zero reaction.
    pub fn normalised(&self) -> Vec<usize> {
        let mut slip = self.pencil.slip();
        slip.retain(|&i| !matches!(self.variables.get(i), Some(Variable::Zero { .. })));
        slip
    }

    /// The variables of the particles in contact with zero reaction, in file order.
    pub fn zero_variables(&self) -> Vec<ZeroVariables> {
        let mut zero = Vec::new();
        for variable in &self.variables {
            if let Variable::Zero {
                variables,
                part: ZeroPart::Gap,
                ..
            } = variable
            {
                zero.push(*variables);
            }
        }

        zero
    }
}

/// The pencil of a problem. A pencil stands for itself; a system goes through (10)-(16).
///
/// # Errors
/// [`ModelError::Missing`] if the system lacks what the unknown needs,
/// [`ModelError::NothingSlips`], [`ModelError::ZeroReaction`] with z particles:
/// [`super::reduce_with_zero`] treats those.
pub fn reduce(problem: &Problem) -> Result<Reduced, ModelError> {
    match problem.body() {
        Body::Pencil(pencil) => Ok(Reduced {
            pencil: pencil.clone(),
            variables: Vec::new(),
        }),
        Body::System(system) => reduce_system(system, problem.unknown()),
    }
}

/// K* and M* as functions of mu, before a value of mu is put in. // (15)
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MuFamily {
    /// K* = K0 + mu K1.
    pub stiffness: Pencil,
    /// M* = M0 + mu M1, where the system has a mass.
    pub mass: Option<Pencil>,
    /// What the variables stand for.
    pub variables: Vec<Variable>,
}

/// (K0, K1) and (M0, M1) of (16).
///
/// # Errors
/// [`ModelError::NothingSlips`], [`ModelError::ZeroReaction`] with z particles.
pub fn mu_family(system: &System) -> Result<MuFamily, ModelError> {
    system.require_for(Unknown::Mu)?;
    system.require_no_zero()?;
    let kept = KeptVariables::of(system);

    let stiffness = kept.blocks(system.stiffness());
    let stiffness = Pencil::new(stiffness.constant, stiffness.slope, kept.free_indices())?;

    let mass = match system.mass() {
        None => None,
        Some(mass) => {
            let mass = kept.blocks(mass);
            Some(Pencil::new(mass.constant, mass.slope, kept.free_indices())?)
        }
    };

    Ok(MuFamily {
        stiffness,
        mass,
        variables: kept.variables(),
    })
}

fn reduce_system(system: &System, unknown: Unknown) -> Result<Reduced, ModelError> {
    system.require_for(unknown)?;
    system.require_no_zero()?;
    let kept = KeptVariables::of(system);
    let stiffness = kept.blocks(system.stiffness());

    let (a, b) = match (unknown, system.mass(), system.friction()) {
        // (12), (15)
        (Unknown::Lambda2, Some(mass), Some(mu)) => {
            let mass = kept.blocks(mass);
            (stiffness.at(mu), mass.at(mu))
        }
        // (21); require_for has refused lambda2 without M and mu.
        _ => (stiffness.constant, stiffness.slope),
    };

    Ok(Reduced {
        pencil: Pencil::new(a, b, kept.free_indices())?,
        variables: kept.variables(),
    })
}

/// K0 and K1 of (16), or M0 and M1: a matrix that is linear in mu.
struct Blocks {
    constant: Sparse,
    slope: Sparse,
}

impl Blocks {
    /// constant + mu slope. // (15)
    fn at(&self, mu: &Rational) -> Sparse {
        self.constant.add_scaled(mu, &self.slope)
    }
}

/// What is left of the degrees of freedom, in the order of the pencil's variables.
struct KeptVariables {
    /// f, ascending.
    free: Vec<usize>,
    /// The slip particles in file order.
    slip: Vec<SlipDirections>,
}

/// S and the directions of a particle in impending slip.
struct SlipDirections {
    sign: i8,
    tangent: Direction,
    normal: Direction,
    /// The normal times the friction factor.
    friction: Direction,
}

impl SlipDirections {
    fn s(&self) -> Rational {
        Rational::from_integer(self.sign.into())
    }
}

impl KeptVariables {
    fn of(system: &System) -> KeptVariables {
        let mut slip = Vec::new();
        for (particle, sign) in system.slip_particles() {
            slip.push(SlipDirections {
                sign,
                tangent: particle.tangent(),
                normal: particle.into_obstacle(),
                friction: particle.friction_direction(),
            });
        }

        let free = system.free_dofs();

        KeptVariables { free, slip }
    }

    fn variables(&self) -> Vec<Variable> {
        let mut variables = Vec::new();
        for &dof in &self.free {
            variables.push(Variable::Free { dof });
        }

        for particle in &self.slip {
            variables.push(Variable::Slip {
                sign: particle.sign,
                tangent: particle.tangent.clone(),
                normal: particle.normal.clone(),
            });
        }

        variables
    }

    /// The free variables of the pencil: they come first.
    fn free_indices(&self) -> Vec<usize> {
        (0..self.free.len()).collect()
    }

    /// K0 and K1 from K, M0 and M1 from M. // (16)
    fn blocks(&self, k: &Sparse) -> Blocks {
        let n_f = self.free.len();
        let order = n_f + self.slip.len();
        let mut constant = Vec::new();
        let mut slope = Vec::new();

        for (i, j, entry) in k.submatrix(&self.free, &self.free).entries() {
            constant.push((i, j, entry.clone())); // K_ff
        }

        for (q, of_q) in self.slip.iter().enumerate() {
            let column = n_f + q;
            let s_q = of_q.s();
            let k_t = times_direction(k, &of_q.tangent); // K t_q

            for (i, k_ft) in self.free_entries(&k_t) {
                let entry = -k_ft * &s_q; // -K_fT S
                constant.push((i, column, entry.clone()));
                constant.push((column, i, entry)); // -S K_Tf
            }

            for (p, of_p) in self.slip.iter().enumerate() {
                let row = n_f + p;
                let s_p = of_p.s();
                let k_tt = inner_product(&of_p.tangent, &k_t);
                let k_nt = inner_product(&of_p.friction, &k_t);
                constant.push((row, column, &s_p * k_tt * &s_q)); // S K_TT S
                slope.push((row, column, k_nt * &s_q)); // K_NT S
            }
        }

        for (p, of_p) in self.slip.iter().enumerate() {
            let row = n_f + p;
            let k_n = times_direction(k, &of_p.friction); // K n_p, which is (n_p' K)'

            for (i, k_nf) in self.free_entries(&k_n) {
                slope.push((row, i, -k_nf)); // -K_Nf
            }
        }

        Blocks {
            constant: Sparse::from_entries(order, order, constant),
            slope: Sparse::from_entries(order, order, slope),
        }
    }

    /// The entries at free degrees of freedom, each with the place of its variable.
    fn free_entries<'a>(&self, vector: &'a SparseVector) -> Vec<(usize, &'a Rational)> {
        let mut entries = Vec::new();
        for (dof, entry) in vector {
            if let Ok(place) = self.free.binary_search(dof) {
                entries.push((place, entry));
            }
        }

        entries
    }
}

/// A vector over the degrees of freedom; an entry that is not there is zero.
pub(super) type SparseVector = BTreeMap<usize, Rational>;

/// The product of K or M with a direction. Both are symmetric, so that rows serve as columns.
pub(super) fn times_direction(k: &Sparse, direction: &Direction) -> SparseVector {
    let mut product = SparseVector::new();
    for (dof, coefficient) in direction {
        for (j, entry) in k.row(*dof) {
            *product.entry(*j).or_insert_with(Rational::zero) += coefficient * entry;
        }
    }

    product
}

pub(super) fn inner_product(direction: &Direction, vector: &SparseVector) -> Rational {
    let mut sum = Rational::zero();
    for (dof, coefficient) in direction {
        if let Some(entry) = vector.get(dof) {
            sum += coefficient * entry;
        }
    }

    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ContactState, Particle, Window};
    use mceip_exact::{rational, whole};

    /// Equation (16) written out by hand for one free dof, one stick and one slip particle.
    #[test]
    fn blocks_of_16_by_hand() {
        // dofs: 0 free, (1, 2) slip with S = -1, (3, 4) stick.
        let k = Sparse::from_ints(&[
            &[9, 1, 2, 3, 4],
            &[1, 8, 5, 0, 0],
            &[2, 5, 7, 0, 0],
            &[3, 0, 0, 9, 0],
            &[4, 0, 0, 0, 9],
        ]);
        let particles = vec![
            Particle::plain(1, 2, ContactState::Slip { sign: -1 }),
            Particle::plain(3, 4, ContactState::Stick),
        ];

        let system = System::new(k, None, None, particles).unwrap();
        let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap();

        let reduced = reduce(&problem).unwrap();

        // -K_fT S = 1, S K_TT S = 8; -K_Nf = -2, K_NT S = -5.
        let k0 = Sparse::from_ints(&[&[9, 1], &[1, 8]]);
        let k1 = Sparse::from_ints(&[&[0, 0], &[-2, -5]]);
        assert_eq!(*reduced.pencil.a(), k0);
        assert_eq!(*reduced.pencil.b(), k1);
        assert_eq!(reduced.pencil.free(), &[0]);
        assert_eq!(reduced.variables[0], Variable::Free { dof: 0 });

        // Two slip with S = diag(1, -1): K_NT = [2 4; 3 5] is not symmetric, so its place and side
        // of S count.
        let k = Sparse::from_ints(&[
            &[20, 2, 1, 3],
            &[2, 20, 4, 0],
            &[1, 4, 20, 5],
            &[3, 0, 5, 20],
        ]);
        let particles = vec![
            Particle::plain(0, 1, ContactState::Slip { sign: 1 }),
            Particle::plain(2, 3, ContactState::Slip { sign: -1 }),
        ];

        let system = System::new(k, None, None, particles).unwrap();
        let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap();

        let pencil = reduce(&problem).unwrap().pencil;

        assert_eq!(*pencil.a(), Sparse::from_ints(&[&[20, -1], &[-1, 20]])); // S K_TT S
        assert_eq!(*pencil.b(), Sparse::from_ints(&[&[2, -4], &[3, -5]])); // K_NT S
    }

    #[test]
    fn consistent_mass_gets_the_same_blocks_and_friction() {
        let k = Sparse::from_ints(&[&[2, 0], &[0, 2]]);
        let m = Sparse::from_ints(&[&[2, 1], &[1, 2]]);
        let friction = rational(1, 2);
        let particles = vec![Particle::plain(0, 1, ContactState::Slip { sign: 1 })];
        let system = System::new(k, Some(m), Some(friction), particles).unwrap();
        let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap();

        let pencil = reduce(&problem).unwrap().pencil;

        assert_eq!(pencil.a().get(0, 0), whole(2)); // K_TT + mu K_NT S = 2
        assert_eq!(pencil.b().get(0, 0), rational(5, 2)); // M_TT + mu M_NT S
    }
}
