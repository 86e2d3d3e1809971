//! The mechanical system of section 2: K, M, mu and the contact particles with their states.

use super::ModelError;
use super::pencil::{Unknown, require_definite, require_symmetric};
use mceip_exact::{Rational, Sparse};
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// What a contact candidate particle does at the equilibrium state (the list after (9)).
///
/// Particles in contact with zero reaction (z) are outside section 3 and refused when read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactState {
    /// Not in contact: both degrees of freedom belong to f.
    Free,
    /// d: reaction strictly inside the friction cone.
    Stick,
    /// s: reaction on the friction cone, impending slip.
    Slip {
        /// S = sign(r_T), 1 or -1: opposite to the impending slip.
        sign: i8,
    },
}

impl ContactState {
    /// The word used in files.
    pub fn word(self) -> &'static str {
        match self {
            ContactState::Free => "free",
            ContactState::Stick => "stick",
            ContactState::Slip { .. } => "slip",
        }
    }
}

/// The reaction at equilibrium, in the paper's directions (r_N <= 0 in contact).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reaction {
    /// r_T.
    pub tangential: Rational,
    /// r_N.
    pub normal: Rational,
}

/// A contact candidate particle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Particle {
    /// 0-based degree of freedom along the obstacle (first dof of an oblique particle).
    pub tangential: usize,
    /// 0-based degree of freedom normal to the obstacle (second dof of an oblique particle).
    pub normal: usize,
    /// Its state.
    pub state: ContactState,
    /// 1 if the normal dof is positive into the obstacle (the paper's u_N <= 0), -1 if away.
    pub normal_direction: i8,
    /// Oblique contact: (u_T, u_N) = frame * (first dof, second dof); rows are the directions.
    pub frame: Option<[[Rational; 2]; 2]>,
    /// The reaction at equilibrium, checked against (7) and the sign.
    pub reaction: Option<Reaction>,
}

/// A direction in the space of degrees of freedom: a few (dof, coefficient) pairs.
pub type Direction = Vec<(usize, Rational)>;

impl Particle {
    /// A particle in the paper's own directions, without frame or reaction.
    pub fn plain(tangential: usize, normal: usize, state: ContactState) -> Self {
        Particle {
            tangential,
            normal,
            state,
            normal_direction: 1,
            frame: None,
            reaction: None,
        }
    }

    /// The unit tangent: u_T is its inner product with the displacements.
    pub fn tangent(&self) -> Direction {
        self.direction(0, Rational::one())
    }

    /// The unit normal *into* the obstacle: u_N <= 0 is (1).
    pub fn into_obstacle(&self) -> Direction {
        self.direction(1, Rational::from_integer(self.normal_direction.into()))
    }

    fn direction(&self, row: usize, factor: Rational) -> Direction {
        match &self.frame {
            None if row == 0 => vec![(self.tangential, factor)],
            None => vec![(self.normal, factor)],
            Some(f) => vec![
                (self.tangential, &factor * &f[row][0]),
                (self.normal, &factor * &f[row][1]),
            ],
        }
    }
}

/// A mechanical system in frictional contact that satisfies section 2's hypotheses: K symmetric
/// with K_ff positive definite, M symmetric positive definite where given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct System {
    stiffness: Sparse,
    mass: Option<Sparse>,
    friction: Option<Rational>,
    particles: Vec<Particle>,
}

impl System {
    /// Establishes every precondition.
    ///
    /// # Errors
    /// [`ModelError`] naming the equation, the index, what was expected and what was found: shapes,
    /// symmetry (3), definiteness of K_ff and M by exact LDL', dofs out of range or claimed twice,
    /// signs, frames, friction, reactions against (7).
    pub fn new(
        stiffness: Sparse,
        mass: Option<Sparse>,
        friction: Option<Rational>,
        particles: Vec<Particle>,
    ) -> Result<Self, ModelError> {
        let n = stiffness.rows();
        if n == 0 {
            return Err(ModelError::Empty { what: "system" });
        }
        for (what, m) in [("K", Some(&stiffness)), ("M", mass.as_ref())] {
            let Some(m) = m else { continue };
            if (m.rows(), m.cols()) != (n, n) {
                return Err(ModelError::Shape {
                    equation: "E3",
                    what,
                    expected_rows: n,
                    expected_cols: n,
                    rows: m.rows(),
                    cols: m.cols(),
                });
            }
            require_symmetric("E3", what, m)?;
        }
        check_friction(friction.as_ref(), &particles)?;
        check_particles(n, &particles, friction.as_ref())?;
        let system = System {
            stiffness,
            mass,
            friction,
            particles,
        };
        let f = system.free_dofs();
        require_definite("P1", "K_ff", &system.stiffness.submatrix(&f, &f))?;
        if let Some(m) = &system.mass {
            require_definite("E3", "M", m)?;
        }
        Ok(system)
    }

    /// Refuses a system that lacks what `unknown` needs: M and mu for lambda^2.
    ///
    /// # Errors
    /// [`ModelError::Missing`] or [`ModelError::Empty`] (no slip particle: nothing can diverge).
    pub fn require_for(&self, unknown: Unknown) -> Result<(), ModelError> {
        if self.slip_particles().is_empty() {
            return Err(ModelError::Empty {
                what: "the slip particles of the system",
            });
        }
        if unknown == Unknown::Lambda2 {
            for (what, present) in [
                ("mass", self.mass.is_some()),
                ("friction", self.friction.is_some()),
            ] {
                if !present {
                    return Err(ModelError::Missing {
                        equation: "E12",
                        what,
                        unknown: unknown.word(),
                    });
                }
            }
        }
        Ok(())
    }

    /// Number of degrees of freedom, N.
    pub fn dofs(&self) -> usize {
        self.stiffness.rows()
    }

    /// K.
    pub fn stiffness(&self) -> &Sparse {
        &self.stiffness
    }

    /// M, where given.
    pub fn mass(&self) -> Option<&Sparse> {
        self.mass.as_ref()
    }

    /// mu, where given.
    pub fn friction(&self) -> Option<&Rational> {
        self.friction.as_ref()
    }

    /// The contact candidate particles in file order.
    pub fn particles(&self) -> &[Particle] {
        &self.particles
    }

    /// The particles in impending slip, in file order, with their S.
    pub fn slip_particles(&self) -> Vec<(&Particle, i8)> {
        self.particles
            .iter()
            .filter_map(|p| match p.state {
                ContactState::Slip { sign } => Some((p, sign)),
                _ => None,
            })
            .collect()
    }

    /// f: the dofs of no particle in contact, ascending.
    pub fn free_dofs(&self) -> Vec<usize> {
        let mut held = vec![false; self.dofs()];
        for p in self
            .particles
            .iter()
            .filter(|p| p.state != ContactState::Free)
        {
            held[p.tangential] = true;
            held[p.normal] = true;
        }
        (0..self.dofs()).filter(|&i| !held[i]).collect()
    }
}

fn check_friction(friction: Option<&Rational>, particles: &[Particle]) -> Result<(), ModelError> {
    let Some(mu) = friction else { return Ok(()) };
    if mu.is_negative() {
        return Err(ModelError::FrictionNegative {
            friction: mu.clone(),
        });
    }
    match particles
        .iter()
        .position(|p| matches!(p.state, ContactState::Slip { .. }))
    {
        Some(particle) if mu.is_zero() => Err(ModelError::FrictionNotPositive {
            particle,
            friction: mu.clone(),
        }),
        _ => Ok(()),
    }
}

fn check_particles(
    n: usize,
    particles: &[Particle],
    friction: Option<&Rational>,
) -> Result<(), ModelError> {
    let mut owner: BTreeMap<usize, usize> = BTreeMap::new();
    for (index, p) in particles.iter().enumerate() {
        for (which, dof) in [("tangential", p.tangential), ("normal", p.normal)] {
            if dof >= n {
                return Err(ModelError::DofOutOfRange {
                    particle: index,
                    which,
                    dof,
                    limit: n,
                });
            }
            if let Some(first) = owner.insert(dof, index) {
                return Err(ModelError::DofTwice {
                    dof,
                    first,
                    second: index,
                });
            }
        }
        for (field, value) in [
            ("normal_direction", Some(p.normal_direction)),
            ("sign", slip_sign(p)),
        ] {
            if let Some(v) = value.filter(|v| v.abs() != 1) {
                return Err(ModelError::Sign {
                    particle: index,
                    field,
                    expected: "1 or -1",
                    got: v.to_string(),
                });
            }
        }
        check_frame(index, p)?;
        check_reaction(index, p, friction)?;
    }
    Ok(())
}

fn slip_sign(p: &Particle) -> Option<i8> {
    match p.state {
        ContactState::Slip { sign } => Some(sign),
        _ => None,
    }
}

fn check_frame(particle: usize, p: &Particle) -> Result<(), ModelError> {
    let Some([[a, b], [c, d]]) = &p.frame else {
        return Ok(());
    };
    let one = Rational::one();
    let checks = [
        ("|row 0|^2", a * a + b * b, &one),
        ("|row 1|^2", c * c + d * d, &one),
        ("the determinant", a * d - b * c, &one),
    ];
    match checks.iter().find(|(_, got, want)| got != *want) {
        Some((what, got, _)) => Err(ModelError::FrameNotRotation {
            particle,
            got: format!("{what} = {got}"),
        }),
        None => Ok(()), // two unit rows with determinant 1 are orthogonal (Lagrange's identity)
    }
}

/// (7), and the definitions of f, d, s after (9).
fn check_reaction(
    particle: usize,
    p: &Particle,
    friction: Option<&Rational>,
) -> Result<(), ModelError> {
    let Some(r) = &p.reaction else { return Ok(()) };
    let cone = friction.map(|mu| -mu * &r.normal); // mu |r_N|
    let expected = match p.state {
        ContactState::Free if !(r.normal.is_zero() && r.tangential.is_zero()) => "no reaction",
        ContactState::Stick | ContactState::Slip { .. } if !r.normal.is_negative() => "r_N < 0",
        ContactState::Stick if cone.as_ref().is_some_and(|c| r.tangential.abs() >= *c) => {
            "|r_T| < -mu r_N"
        }
        ContactState::Slip { sign }
            if r.tangential.signum() != Rational::from_integer(sign.into()) =>
        {
            "sign(r_T) equal to sign"
        }
        ContactState::Slip { .. } if cone.as_ref().is_some_and(|c| r.tangential.abs() != *c) => {
            "|r_T| = -mu r_N"
        }
        _ => return Ok(()),
    };
    Err(ModelError::ReactionContradicts {
        particle,
        state: p.state.word(),
        expected,
        tangential: r.tangential.clone(),
        normal: r.normal.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    const SLIP: ContactState = ContactState::Slip { sign: 1 };

    fn build(mu: i64, particles: Vec<Particle>) -> Result<System, ModelError> {
        System::new(
            Sparse::identity(4),
            Some(Sparse::identity(4)),
            Some(whole(mu)),
            particles,
        )
    }

    #[test]
    fn index_sets_follow_the_states() {
        let system = build(
            1,
            vec![
                Particle::plain(0, 1, SLIP),
                Particle::plain(2, 3, ContactState::Free),
            ],
        )
        .unwrap();
        assert_eq!(system.free_dofs(), vec![2, 3]);
        assert_eq!(system.slip_particles().len(), 1);
        assert!(system.require_for(Unknown::Lambda2).is_ok());
        let stuck = build(1, vec![Particle::plain(0, 1, ContactState::Stick)]).unwrap();
        assert!(matches!(
            stuck.require_for(Unknown::Mu),
            Err(ModelError::Empty { .. })
        ));
    }

    #[test]
    fn contradictions_are_refused_by_name() {
        let slip = |t, n| Particle::plain(t, n, SLIP);
        assert!(matches!(
            build(1, vec![slip(0, 4)]),
            Err(ModelError::DofOutOfRange {
                particle: 0,
                which: "normal",
                dof: 4,
                limit: 4
            })
        ));
        assert!(matches!(
            build(1, vec![slip(0, 1), slip(1, 2)]),
            Err(ModelError::DofTwice {
                dof: 1,
                first: 0,
                second: 1
            })
        ));
        assert!(matches!(
            build(0, vec![slip(0, 1)]),
            Err(ModelError::FrictionNotPositive { particle: 0, .. })
        ));
        assert!(matches!(
            build(-1, vec![slip(0, 1)]),
            Err(ModelError::FrictionNegative { .. })
        ));
        let zero_sign = Particle::plain(0, 1, ContactState::Slip { sign: 0 });
        assert!(matches!(
            build(1, vec![zero_sign]),
            Err(ModelError::Sign { field: "sign", .. })
        ));
        let skew = Particle {
            frame: Some([[whole(1), whole(0)], [whole(0), whole(-1)]]),
            ..slip(0, 1)
        };
        assert!(matches!(
            build(1, vec![skew]),
            Err(ModelError::FrameNotRotation { particle: 0, .. })
        ));
    }

    #[test]
    fn reactions_are_held_against_the_friction_cone() {
        let with = |state, t: Rational, n: Rational| {
            let reaction = Some(Reaction {
                tangential: t,
                normal: n,
            });
            build(
                2,
                vec![Particle {
                    reaction,
                    ..Particle::plain(0, 1, state)
                }],
            )
        };
        assert!(
            with(SLIP, whole(2), whole(-1)).is_ok()
                && with(ContactState::Free, whole(0), whole(0)).is_ok()
        );
        assert!(with(ContactState::Stick, rational(19, 10), whole(-1)).is_ok());
        for (state, t, n) in [
            (SLIP, whole(-2), whole(-1)),
            (SLIP, rational(19, 10), whole(-1)),
            (SLIP, whole(2), whole(1)),
            (ContactState::Stick, whole(2), whole(-1)),
            (ContactState::Free, whole(0), whole(-1)),
        ] {
            assert!(matches!(
                with(state, t, n),
                Err(ModelError::ReactionContradicts { particle: 0, .. })
            ));
        }
        for (state, n) in [
            (SLIP, whole(1)),
            (SLIP, whole(0)),
            (ContactState::Stick, whole(1)),
            (ContactState::Stick, whole(0)),
        ] {
            assert!(matches!(
                with(state, whole(0), n),
                Err(ModelError::ReactionContradicts {
                    expected: "r_N < 0",
                    ..
                })
            ));
        }
    }

    #[test]
    fn matrices_are_held_against_section_2() {
        let singular = System::new(Sparse::zeros(2, 2), None, None, vec![]);
        assert!(matches!(
            singular,
            Err(ModelError::NotDefinite {
                equation: "P1",
                what: "K_ff",
                index: 0,
                ..
            })
        ));
        let indefinite_mass =
            System::new(Sparse::identity(2), Some(Sparse::zeros(2, 2)), None, vec![]);
        assert!(matches!(
            indefinite_mass,
            Err(ModelError::NotDefinite { what: "M", .. })
        ));
        let skew =
            Sparse::from_entries(2, 2, [(0, 0, whole(1)), (1, 1, whole(1)), (0, 1, whole(1))]);
        assert!(matches!(
            System::new(skew, None, None, vec![]),
            Err(ModelError::NotSymmetric { row: 0, col: 1, .. })
        ));
    }
}
