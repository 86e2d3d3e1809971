//! The elimination (10)-(16): from a mechanical system to the pencil of its eigenproblem.
//!
//! Every motion v with (9) is v = T x, and its reactions w give the rows y = P' w. With
//! G = lambda^2 M + K the lines of (9) become y = P' G T x. The columns of T and P are
//!
//! ```text
//!                      x                    T        P
//! free (f):            v at the dof         e_dof    e_dof
//! impending slip (s):  -S v_T               -S t     -(S t + c mu n)
//! zero reaction (z):   g  = -v_N            -n       -n
//!                      v+ = max(v_T, 0)      t        t - c mu n
//!                      v- = max(-v_T, 0)    -t       -t - c mu n
//! ```
//!
//! t and n the tangent and the normal of the particle, which may be oblique, and c its friction
//! factor. Stick particles and the normal motion of slip particles have no variable: v = 0 there.
//! P = T + mu F, so that K* = P' K T = K0 + mu K1 with
//!
//! ```text
//! K0 = T' K T = [  K_ff     -K_fT S  ]      K1 = F' K T = [   0       0     ]
//!               [ -S K_Tf  S K_TT S  ],                   [ -K_Nf   K_NT S  ]        (16)
//! ```
//!
//! without z, and M0 and M1 likewise. MCEIP-mu is the pencil K0 + mu K1; MCEIP-lambda2 is
//! K* + lambda^2 M* with K* = K0 + mu K1 and M* = M0 + mu M1. On curved obstacles K* has a diagonal
//! that is quadratic in mu as well (`spec/curvature.md`), and MCEIP-mu is refused.
//!
//! With z this is the split form of `spec/zero-reaction.md`, Z.3. It has solutions x != 0 with
//! v = 0, namely v+ = v- for any z particle and any t. A solution of (9) is a solution of the form
//! in which v+ or v- is 0 for each z particle. So the pencil must not be given to what treats all
//! complementarity variables alike: that asks for [`Reduced::without_zero`].
//!
//! Input: a [`Problem`] or [`System`] whose preconditions have been established (K and M are
//! symmetric). Called by everything that solves or enumerates, never by `check`, which has its own
//! way.

use crate::{
    Body, ContactState, Direction, ModelError, MuFamily, Particle, Pencil, Problem, Reduced,
    ReducedVariable, System, Unknown, ZeroPart, ZeroVariables,
};
use mceip_exact::{Rational, Sparse};
use num_traits::{One as _, Signed as _};

/// The pencil of a problem. A pencil stands for itself, a quadratic one for its linear form; a
/// system goes through (10)-(16).
///
/// # Errors
/// As [`reduce_system`].
pub fn reduce(problem: &Problem) -> Result<Reduced, ModelError> {
    let given = |pencil| Reduced {
        pencil,
        variables: Vec::new(),
        zero: Vec::new(),
    };
    match problem.body() {
        Body::Pencil(pencil) => Ok(given(pencil.clone())),
        Body::Quadratic(quadratic) => Ok(given(quadratic.linear_form()?)),
        Body::System(system) => reduce_system(system, problem.unknown()),
    }
}

/// The pencil of a system for an unknown.
///
/// # Errors
/// [`ModelError::Missing`] if the system lacks what the unknown needs,
/// [`ModelError::NothingSlips`], [`ModelError::NotExact`], or [`ModelError::Curved`] with mu as the
/// unknown.
pub fn reduce_system(system: &System, unknown: Unknown) -> Result<Reduced, ModelError> {
    system.require_exact()?;
    system.require_for(unknown)?;
    let changes = Changes::of(system);
    let stiffness = changes.blocks(system.stiffness());

    let (a, b) = match (unknown, system.mass(), system.friction()) {
        // (12), (15)
        (Unknown::Lambda2, Some(mass), Some(mu)) => {
            let mass = changes.blocks(mass);
            let turning = turning_diagonal(system, mu);
            let k_star = stiffness.at(mu).add_scaled(&Rational::one(), &turning);
            (k_star, mass.at(mu))
        }
        // (21); require_for has refused lambda2 without M and mu.
        _ => (stiffness.constant, stiffness.slope),
    };

    Ok(Reduced {
        pencil: Pencil::new(a, b, changes.free())?,
        variables: changes.variables,
        zero: zero_variables(system),
    })
}

/// The diagonal (1 + c^2 mu^2) g of reactions that turn along curved obstacles
/// (`spec/curvature.md`).
fn turning_diagonal(system: &System, mu: &Rational) -> Sparse {
    let free = system.free_dofs().len();
    let slip = system.slip_particles();
    let order = free + slip.len() + 3 * system.zero_particles().len();

    let mut entries = Vec::new();
    for (k, (particle, _)) in slip.iter().enumerate() {
        entries.push((free + k, free + k, particle.turning_stiffness(mu)));
    }

    Sparse::from_entries(order, order, entries)
}

/// (K0, K1) and (M0, M1) of (16).
///
/// # Errors
/// [`ModelError::NothingSlips`], [`ModelError::NotExact`], [`ModelError::Curved`].
pub fn mu_family(system: &System) -> Result<MuFamily, ModelError> {
    system.require_exact()?;
    system.require_for(Unknown::Mu)?;
    let changes = Changes::of(system);
    let family = |matrix| {
        let Blocks { constant, slope } = changes.blocks(matrix);
        Pencil::new(constant, slope, changes.free())
    };

    Ok(MuFamily {
        stiffness: family(system.stiffness())?,
        mass: system.mass().map(family).transpose()?,
        variables: changes.variables,
    })
}

/// How far (K0, K1) and (M0, M1) of a member may be from those in the middle
/// ([`System::middle`]), entry by entry, but for its friction factors: |T|'R|T| and |F|'R|T|.
///
/// # Errors
/// [`ModelError::NothingSlips`].
pub fn radii_family(system: &System) -> Result<MuFamily, ModelError> {
    let middle = system.middle();
    middle.require_for(Unknown::Mu)?;
    let changes = Changes::of(&middle).magnitudes();
    let order = system.dofs();
    let family = |radius: &Option<Sparse>| {
        let none = Sparse::zeros(order, order);
        let Blocks { constant, slope } = changes.blocks(radius.as_ref().unwrap_or(&none));
        Pencil::new(constant, slope, changes.free())
    };

    Ok(MuFamily {
        stiffness: family(&system.radii().stiffness)?,
        mass: Some(family(&system.radii().mass)?),
        variables: Vec::new(),
    })
}

/// What each variable of a system's pencil stands for.
pub fn variables(system: &System) -> Vec<ReducedVariable> {
    Changes::of(system).variables
}

/// The places of the variables of a system's z particles, in file order: they come after those of f
/// and of s.
pub fn zero_variables(system: &System) -> Vec<ZeroVariables> {
    let mut gap = system.free_dofs().len() + system.slip_particles().len();
    let mut list = Vec::new();
    for (particle, its) in system.particles().iter().enumerate() {
        if its.state != ContactState::Zero {
            continue;
        }

        list.push(ZeroVariables {
            particle,
            gap,
            right: gap + 1,
            left: gap + 2,
        });
        gap += 3;
    }

    list
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

/// The changes of variables v = T x and y = (T + mu F)' w.
struct Changes {
    variables: Vec<ReducedVariable>,
    /// T.
    motion: ByDof,
    /// F: -c n for each sliding variable.
    friction: ByDof,
}

impl Changes {
    fn of(system: &System) -> Changes {
        let mut changes = Changes {
            variables: Vec::new(),
            motion: ByDof::zero(system.dofs()),
            friction: ByDof::zero(system.dofs()),
        };

        for dof in system.free_dofs() {
            changes.add(ReducedVariable::Free { dof }, None);
        }

        for (particle, sign) in system.slip_particles() {
            let slip = ReducedVariable::Slip {
                sign,
                tangent: particle.tangent(),
                normal: particle.into_obstacle(),
            };
            changes.add(slip, Some(particle));
        }

        for variables in zero_variables(system) {
            changes.add_zero(variables, &system.particles()[variables.particle]);
        }

        changes
    }

    fn add_zero(&mut self, variables: ZeroVariables, particle: &Particle) {
        let right = particle.tangent();
        let left = scaled(&right, -1);
        let gap = scaled(&particle.into_obstacle(), -1);

        for (part, column) in [
            (ZeroPart::Gap, gap),
            (ZeroPart::Right, right),
            (ZeroPart::Left, left),
        ] {
            let sliding = (part != ZeroPart::Gap).then_some(particle);
            let variable = ReducedVariable::Zero {
                variables,
                part,
                column,
            };
            self.add(variable, sliding);
        }
    }

    /// The next variable, and the particle whose sliding it is.
    fn add(&mut self, variable: ReducedVariable, sliding: Option<&Particle>) {
        let place = self.variables.len();
        self.motion.add(place, &variable.column());
        if let Some(particle) = sliding {
            let against_normal = scaled(&particle.friction_direction(), -1);
            self.friction.add(place, &against_normal);
        }
        self.variables.push(variable);
    }

    /// |T| and |F|.
    fn magnitudes(mut self) -> Changes {
        for ByDof(rows) in [&mut self.motion, &mut self.friction] {
            for (_, coefficient) in rows.iter_mut().flatten() {
                *coefficient = coefficient.abs();
            }
        }

        self
    }

    /// The free variables of the pencil.
    fn free(&self) -> Vec<usize> {
        let is_free = |&i: &usize| matches!(self.variables[i], ReducedVariable::Free { .. });
        (0..self.variables.len()).filter(is_free).collect()
    }

    /// T' K T and F' K T. // (16)
    fn blocks(&self, k: &Sparse) -> Blocks {
        let order = self.variables.len();
        Blocks {
            constant: product(order, &self.motion, k, &self.motion),
            slope: product(order, &self.friction, k, &self.motion),
        }
    }
}

/// A matrix with a row for each degree of freedom and a column for each variable.
struct ByDof(Vec<Vec<(usize, Rational)>>);

impl ByDof {
    fn zero(dofs: usize) -> ByDof {
        ByDof(vec![Vec::new(); dofs])
    }

    fn add(&mut self, variable: usize, column: &Direction) {
        for (dof, coefficient) in column {
            self.0[*dof].push((variable, coefficient.clone()));
        }
    }
}

/// left' K right. Entries of K at stick particles meet no variable.
fn product(order: usize, left: &ByDof, k: &Sparse, right: &ByDof) -> Sparse {
    let mut entries = Vec::new();
    for (row_dof, column_dof, entry) in k.entries() {
        for (row, row_factor) in &left.0[row_dof] {
            for (column, column_factor) in &right.0[column_dof] {
                let factor = row_factor * column_factor;
                entries.push((*row, *column, factor * entry));
            }
        }
    }

    Sparse::from_entries(order, order, entries)
}

fn scaled(direction: &Direction, factor: i64) -> Direction {
    let factor = Rational::from_integer(factor.into());
    direction.iter().map(|(d, c)| (*d, c * &factor)).collect()
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
        assert_eq!(reduced.variables[0], ReducedVariable::Free { dof: 0 });

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

    fn system(second: ContactState) -> System {
        let k = Sparse::from_ints(&[
            &[20, 2, 1, 3],
            &[2, 20, 4, 0],
            &[1, 4, 20, 5],
            &[3, 0, 5, 20],
        ]);
        let rough = Particle {
            friction_factor: rational(1, 2),
            ..Particle::plain(2, 3, second)
        };
        let slip = Particle::plain(0, 1, ContactState::Slip { sign: 1 });
        System::new(k, None, None, vec![slip, rough]).unwrap()
    }

    /// Particle 0 slips with S = 1, particle 1 has zero reaction and the factor 1/2.
    #[test]
    fn the_split_form_by_hand() {
        let split = reduce_system(&system(ContactState::Zero), Unknown::Mu).unwrap();

        // (x, g, v+, v-) stands for v = (-x, 0, v+ - v-, -g).
        let a = Sparse::from_ints(&[
            &[20, 3, -1, 1],
            &[3, 20, -5, 5],
            &[-1, -5, 20, -20],
            &[1, 5, -20, 20],
        ]);
        assert_eq!(*split.pencil.a(), a);

        // -w_N1 = 2 x - 4 (v+ - v-), and -w_N2 / 2 = (3 x + 20 g - 5 (v+ - v-)) / 2.
        let of_zero = [rational(3, 2), whole(10), rational(-5, 2), rational(5, 2)];
        let of_slip = [2, 0, -4, 4].map(whole);
        for (j, (slip, zero)) in of_slip.iter().zip(&of_zero).enumerate() {
            assert_eq!(split.pencil.b().get(0, j), *slip);
            assert_eq!(split.pencil.b().get(1, j), whole(0));
            assert_eq!(split.pencil.b().get(2, j), *zero);
            assert_eq!(split.pencil.b().get(3, j), *zero);
        }
    }

    #[test]
    fn what_does_not_treat_zero_reaction_refuses_it() {
        let body = Body::System(system(ContactState::Zero));
        let problem = Problem::new(body, Unknown::Mu, Window::all()).unwrap();

        let refused = reduce(&problem).unwrap().without_zero().unwrap_err();
        assert_eq!(refused, ModelError::ZeroReaction { particle: 1 });
    }

    /// e'x_s is the sum over s alone.
    #[test]
    fn variables_of_zero_reaction_are_not_normalised() {
        let reduced = reduce_system(&system(ContactState::Zero), Unknown::Mu).unwrap();

        let gap = ZeroVariables {
            particle: 1,
            gap: 1,
            right: 2,
            left: 3,
        };
        assert_eq!(reduced.zero, [gap]);
        assert_eq!(reduced.normalised(), [0]);
    }
}
