//! The split form of (9) with particles in contact with zero reaction (z).
//!
//! `spec/zero-reaction.md`, Z.3: each z particle has three complementarity variables,
//!
//! ```text
//! gap:    g  = -v_N          _|_   p  = -w_N
//! right:  v+ = max(v_T, 0)   _|_   s+ =  w_T - c mu w_N
//! left:   v- = max(-v_T, 0)  _|_   s- = -w_T - c mu w_N
//! ```
//!
//! c its friction factor. With v = T x, T of the columns e_dof (f), -S t (s), -n, t, -t (z), and
//! y = P' w, P of the columns e_dof, -(S t + c mu n), -n, t - c mu n, -t - c mu n, the matrix
//! y = P' (K + lambda^2 M) T x is linear in lambda^2 and in mu.
//!
//! The form has solutions x != 0 with v = 0, namely v+ = v- for any z particle and any t. A
//! solution of (9) is a solution of the form in which v+ or v- is 0 for each z particle. So the
//! pencil must not be given to what treats all complementarity variables alike; [`super::reduce`]
//! refuses z.
//!
//! Input: a [`System`]. The program and `engine` call this and hand the [`SplitForm`] to the
//! oracle's `modes`. `check` has its own way.

use super::eliminate::{
    MuFamily, Reduced, Variable, ZeroPart, inner_product, mu_family, reduce, times_direction,
};
use crate::{
    Body, ContactState, Direction, ModelError, Particle, Pencil, Problem, SplitForm, System,
    Unknown, ZeroVariables,
};
use mceip_exact::{Rational, Sparse};
use num_traits::One;

/// The split form of a system; without z particles the pencil of [`super::reduce`].
///
/// # Errors
/// [`ModelError::Missing`] if the system lacks what the unknown needs, or
/// [`ModelError::NothingSlips`].
pub fn split_form(system: &System, unknown: Unknown) -> Result<SplitForm, ModelError> {
    system.require_for(unknown)?;
    let changes = Changes::of(system);
    let stiffness = system.stiffness();

    let plain = products(&changes.rows, stiffness, &changes.columns);
    let friction = products(&changes.friction, stiffness, &changes.columns);

    let (a, b) = match (unknown, system.mass(), system.friction()) {
        (Unknown::Lambda2, Some(mass), Some(mu)) => {
            let plain_mass = products(&changes.rows, mass, &changes.columns);
            let friction_mass = products(&changes.friction, mass, &changes.columns);
            (
                plain.add_scaled(mu, &friction),
                plain_mass.add_scaled(mu, &friction_mass),
            )
        }
        _ => (plain, friction),
    };

    Ok(SplitForm {
        pencil: Pencil::new(a, b, (0..changes.free).collect())?,
        columns: changes.columns,
        slip: changes.slip,
        zero: changes.zero,
    })
}

/// K* and M* as functions of mu, for systems with z particles those of the split form.
///
/// # Errors
/// As [`mu_family`].
pub fn mu_family_with_zero(system: &System) -> Result<MuFamily, ModelError> {
    if system.require_no_zero().is_ok() {
        return mu_family(system);
    }

    let split = split_form(system, Unknown::Mu)?;
    let mass = match system.mass() {
        None => None,
        Some(mass) => {
            let changes = Changes::of(system);
            let constant = products(&changes.rows, mass, &changes.columns);
            let slope = products(&changes.friction, mass, &changes.columns);
            let free = split.pencil.free().to_vec();
            Some(Pencil::new(constant, slope, free)?)
        }
    };

    Ok(MuFamily {
        variables: variables(system, &split),
        stiffness: split.pencil,
        mass,
    })
}

/// The pencil of a problem, for systems with z particles that of the split form.
///
/// # Errors
/// As [`split_form`] and [`reduce`](super::reduce).
pub fn reduce_with_zero(problem: &Problem) -> Result<Reduced, ModelError> {
    let Body::System(system) = problem.body() else {
        return reduce(problem);
    };
    if system.require_no_zero().is_ok() {
        return reduce(problem);
    }

    let split = split_form(system, problem.unknown())?;
    Ok(Reduced {
        variables: variables(system, &split),
        pencil: split.pencil,
    })
}

/// The places of the variables of a system's z particles in its split form, in file order: they
/// come after those of f and of s.
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

/// What the variables of a split form stand for.
fn variables(system: &System, split: &SplitForm) -> Vec<Variable> {
    let mut list = Vec::new();
    for dof in system.free_dofs() {
        list.push(Variable::Free { dof });
    }

    for (particle, sign) in system.slip_particles() {
        list.push(Variable::Slip {
            sign,
            tangent: particle.tangent(),
            normal: particle.into_obstacle(),
        });
    }

    for &variables in &split.zero {
        let parts = [
            (ZeroPart::Gap, variables.gap),
            (ZeroPart::Right, variables.right),
            (ZeroPart::Left, variables.left),
        ];
        for (part, place) in parts {
            list.push(Variable::Zero {
                variables,
                part,
                column: split.columns[place].clone(),
            });
        }
    }

    list
}

/// The changes of variables v = T x and y = P' w.
#[derive(Default)]
struct Changes {
    /// The number of free variables: these come first.
    free: usize,
    slip: Vec<usize>,
    zero: Vec<ZeroVariables>,
    /// Columns of T.
    columns: Vec<Direction>,
    /// Columns of P for mu = 0.
    rows: Vec<Direction>,
    /// What mu is multiplied by in the columns of P.
    friction: Vec<Direction>,
}

impl Changes {
    fn of(system: &System) -> Changes {
        let mut changes = Changes::default();
        for dof in system.free_dofs() {
            let unit = vec![(dof, Rational::one())];
            changes.add(unit, Vec::new());
        }
        changes.free = changes.columns.len();

        for (particle, sign) in system.slip_particles() {
            changes.slip.push(changes.columns.len());
            let against = scaled(&particle.tangent(), (-sign).into());
            changes.add(against, against_friction(particle));
        }

        changes.zero = zero_variables(system);
        for particle in system.zero_particles() {
            changes.add_zero(particle);
        }

        changes
    }

    fn add_zero(&mut self, particle: &Particle) {
        let tangent = particle.tangent();
        self.add(scaled(&particle.into_obstacle(), -1), Vec::new());
        self.add(tangent.clone(), against_friction(particle));
        self.add(scaled(&tangent, -1), against_friction(particle));
    }

    /// A variable: for mu = 0 its columns of T and P are the same.
    fn add(&mut self, column: Direction, friction: Direction) {
        self.rows.push(column.clone());
        self.columns.push(column);
        self.friction.push(friction);
    }
}

/// -c n.
fn against_friction(particle: &Particle) -> Direction {
    scaled(&particle.friction_direction(), -1)
}

fn scaled(direction: &Direction, factor: i64) -> Direction {
    let factor = Rational::from_integer(factor.into());
    direction.iter().map(|(d, c)| (*d, c * &factor)).collect()
}

/// The matrix of all p_i' K d_j.
fn products(rows: &[Direction], k: &Sparse, columns: &[Direction]) -> Sparse {
    let mut entries = Vec::new();
    for (j, column) in columns.iter().enumerate() {
        let image = times_direction(k, column);
        for (i, row) in rows.iter().enumerate() {
            entries.push((i, j, inner_product(row, &image)));
        }
    }

    Sparse::from_entries(rows.len(), columns.len(), entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Window;
    use mceip_exact::{rational, whole};

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
        let split = split_form(&system(ContactState::Zero), Unknown::Mu).unwrap();

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
    fn without_zero_reaction_it_is_the_reduced_pencil() {
        let system = system(ContactState::Slip { sign: -1 });
        let split = split_form(&system, Unknown::Mu).unwrap();
        let body = Body::System(system);
        let problem = Problem::new(body, Unknown::Mu, Window::all()).unwrap();

        assert_eq!(split.pencil, reduce(&problem).unwrap().pencil);
        assert!(split.zero.is_empty());
    }

    #[test]
    fn what_does_not_treat_zero_reaction_refuses_it() {
        let body = Body::System(system(ContactState::Zero));
        let problem = Problem::new(body, Unknown::Mu, Window::all()).unwrap();

        let refused = reduce(&problem).unwrap_err();
        assert_eq!(refused, ModelError::ZeroReaction { particle: 1 });
    }

    /// The variables name the columns, and e'x_s is the sum over s alone.
    #[test]
    fn the_variables_of_the_split_form_are_its_columns() {
        let system = system(ContactState::Zero);
        let split = split_form(&system, Unknown::Mu).unwrap();
        let body = Body::System(system);
        let problem = Problem::new(body, Unknown::Mu, Window::all()).unwrap();

        let reduced = reduce_with_zero(&problem).unwrap();

        let columns: Vec<Direction> = reduced.variables.iter().map(Variable::column).collect();
        assert_eq!(columns, split.columns);
        assert_eq!(reduced.pencil, split.pencil);
        assert_eq!(reduced.zero_variables(), split.zero);
        assert_eq!(reduced.normalised(), split.slip);
    }
}
