//! Elimination (10)-(16): stick particles and normal dofs of slip particles leave, signs turn.

use crate::{Body, Direction, ModelError, Pencil, Problem, System, Unknown};
use mceip_exact::{Rational, Sparse};
use num_traits::Zero;

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
}

/// A pencil with the meaning of its variables: f ascending, then slip particles in file order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reduced {
    /// The pencil of (12) or (21).
    pub pencil: Pencil,
    /// One entry per variable; empty for a problem that was given as a pencil.
    pub variables: Vec<Variable>,
}

/// The pencil of a problem. A pencil stands for itself; a system goes through (10)-(16).
///
/// # Errors
/// [`ModelError::Missing`] if the system lacks what the unknown needs.
pub fn reduce(problem: &Problem) -> Result<Reduced, ModelError> {
    match problem.body() {
        Body::Pencil(p) => Ok(Reduced {
            pencil: p.clone(),
            variables: Vec::new(),
        }),
        Body::System(s) => reduce_system(s, problem.unknown()),
    }
}

/// K* and M* as functions of mu, before a value of mu is put in. // E15
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
/// [`ModelError::Empty`] if no particle slips.
pub fn mu_family(system: &System) -> Result<MuFamily, ModelError> {
    system.require_for(Unknown::Mu)?;
    let blocks = Blocks::of(system);
    let pencil = |m: &Sparse| {
        let (at_zero, slope) = blocks.star(m);
        Pencil::new(at_zero, slope, (0..blocks.free.len()).collect())
    };
    Ok(MuFamily {
        stiffness: pencil(system.stiffness())?,
        mass: system.mass().map(pencil).transpose()?,
        variables: blocks.variables(),
    })
}

fn reduce_system(system: &System, unknown: Unknown) -> Result<Reduced, ModelError> {
    system.require_for(unknown)?;
    let blocks = Blocks::of(system);
    let (k0, k1) = blocks.star(system.stiffness());
    let (a, b) = match (unknown, system.mass(), system.friction()) {
        (Unknown::Lambda2, Some(mass), Some(mu)) => {
            let (m0, m1) = blocks.star(mass); // E15
            (k0.add_scaled(mu, &k1), m0.add_scaled(mu, &m1))
        }
        _ => (k0, k1), // E21; require_for has refused lambda2 without M and mu
    };
    let free = (0..blocks.free.len()).collect();
    Ok(Reduced {
        pencil: Pencil::new(a, b, free)?,
        variables: blocks.variables(),
    })
}

/// The index sets of (10)-(16), with the directions of each slip particle.
struct Blocks {
    free: Vec<usize>,
    slip: Vec<(i8, Direction, Direction)>,
}

impl Blocks {
    fn of(system: &System) -> Blocks {
        let slip = system
            .slip_particles()
            .into_iter()
            .map(|(p, sign)| (sign, p.tangent(), p.into_obstacle()))
            .collect();
        Blocks {
            free: system.free_dofs(),
            slip,
        }
    }

    fn variables(&self) -> Vec<Variable> {
        let free = self.free.iter().map(|&dof| Variable::Free { dof });
        let slip = self.slip.iter().map(|(sign, t, n)| Variable::Slip {
            sign: *sign,
            tangent: t.clone(),
            normal: n.clone(),
        });
        free.chain(slip).collect()
    }

    /// (K0, K1) of (16) from K; the same for M. // E16
    ///
    /// K0 = [ K_ff, -K_fT S; -S K_Tf, S K_TT S ],  K1 = [ 0, 0; -K_Nf, K_NT S ].
    fn star(&self, k: &Sparse) -> (Sparse, Sparse) {
        let n_f = self.free.len();
        let order = n_f + self.slip.len();
        let mut e0 = Vec::new();
        let mut e1 = Vec::new();
        for (i, j, v) in k.submatrix(&self.free, &self.free).entries() {
            e0.push((i, j, v.clone())); // K_ff
        }
        for (q, (s_q, t_q, _)) in self.slip.iter().enumerate() {
            let s_q = Rational::from_integer((*s_q).into());
            let k_t = column(k, t_q); // K t_q
            for (i, &dof) in self.free.iter().enumerate() {
                let value = -&k_t[dof] * &s_q; // -K_fT S and its mirror
                e0.push((i, n_f + q, value.clone()));
                e0.push((n_f + q, i, value));
            }
            for (p, (s_p, t_p, n_p)) in self.slip.iter().enumerate() {
                let s_p = Rational::from_integer((*s_p).into());
                e0.push((n_f + p, n_f + q, &s_p * inner(t_p, &k_t) * &s_q)); // S K_TT S
                e1.push((n_f + p, n_f + q, inner(n_p, &k_t) * &s_q)); // K_NT S
            }
        }
        for (p, (_, _, n_p)) in self.slip.iter().enumerate() {
            let k_n = column(k, n_p); // K symmetric: n_p' K as a column
            for (i, &dof) in self.free.iter().enumerate() {
                e1.push((n_f + p, i, -&k_n[dof])); // -K_Nf
            }
        }
        (
            Sparse::from_entries(order, order, e0),
            Sparse::from_entries(order, order, e1),
        )
    }
}

/// K d for a direction d (K symmetric, so rows serve as columns).
fn column(k: &Sparse, d: &Direction) -> Vec<Rational> {
    let mut out = vec![Rational::zero(); k.rows()];
    for (dof, c) in d {
        for (j, v) in k.row(*dof) {
            out[*j] += c * v;
        }
    }
    out
}

fn inner(d: &Direction, v: &[Rational]) -> Rational {
    d.iter().map(|(dof, c)| c * &v[*dof]).sum()
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
        // -K_fT S = 1, S K_TT S = 8.
        assert_eq!(*reduced.pencil.a(), Sparse::from_ints(&[&[9, 1], &[1, 8]]));
        assert_eq!(
            *reduced.pencil.b(),
            Sparse::from_ints(&[&[0, 0], &[-2, -5]])
        ); // -K_Nf, K_NT S
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
        let slip = |t, n, sign| Particle::plain(t, n, ContactState::Slip { sign });
        let system = System::new(k, None, None, vec![slip(0, 1, 1), slip(2, 3, -1)]).unwrap();
        let pencil =
            reduce(&Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap())
                .unwrap()
                .pencil;
        assert_eq!(*pencil.a(), Sparse::from_ints(&[&[20, -1], &[-1, 20]])); // S K_TT S
        assert_eq!(*pencil.b(), Sparse::from_ints(&[&[2, -4], &[3, -5]])); // K_NT S
    }

    #[test]
    fn consistent_mass_gets_the_same_blocks_and_friction() {
        let k = Sparse::from_ints(&[&[2, 0], &[0, 2]]);
        let m = Sparse::from_entries(
            2,
            2,
            [
                (0, 0, whole(2)),
                (0, 1, whole(1)),
                (1, 0, whole(1)),
                (1, 1, whole(2)),
            ],
        );
        let system = System::new(
            k,
            Some(m),
            Some(rational(1, 2)),
            vec![Particle::plain(0, 1, ContactState::Slip { sign: 1 })],
        )
        .unwrap();
        let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap();
        let pencil = reduce(&problem).unwrap().pencil;
        assert_eq!(pencil.a().get(0, 0), whole(2)); // K_TT + mu K_NT S = 2
        assert_eq!(pencil.b().get(0, 0), rational(5, 2)); // M_TT + mu M_NT S
    }
}
