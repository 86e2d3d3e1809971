//! The mechanical system of section 2: K, M, mu and the contact particles with their states.
//!
//! ```text
//! M u'' + K u = f^0 + r,   u_N <= 0,   r_N <= 0,   u_N r_N = 0,   |r_T| + mu r_N <= 0      (1)-(3)
//! ```
//!
//! at an equilibrium state, which says of every contact candidate particle whether it is out of
//! contact (f), sticks (d), is about to slip (s, with the sign S of its tangential reaction) or
//! touches the obstacle without a reaction (z). At an s particle the obstacle may be curved
//! (`spec/curvature.md`).
//!
//! Input: matrices over Q of order N, one row per degree of freedom, and the particles. What
//! section 2 supposes is established when a [`System`] is made: every system that exists is one.

use super::ModelError;
use super::pencil::{Unknown, require_definite, require_square, require_symmetric};
use super::radii::{Radii, check_friction_range};
use mceip_exact::{Rational, Sparse};
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// What a contact candidate particle does at the equilibrium state (the list after (9)).
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
    /// z: in contact, reaction zero. Outside section 3 of the paper (`spec/zero-reaction.md`).
    Zero,
}

impl ContactState {
    /// The word used in files.
    pub fn word(self) -> &'static str {
        match self {
            ContactState::Free => "free",
            ContactState::Stick => "stick",
            ContactState::Slip { .. } => "slip",
            ContactState::Zero => "zero",
        }
    }

    /// The word with the direction of slip along the tangent, as in tables of contacts.
    pub fn directed_word(self) -> &'static str {
        match self {
            ContactState::Slip { sign } if sign > 0 => "slip-",
            ContactState::Slip { .. } => "slip+",
            other => other.word(),
        }
    }

    /// The letter used in pictures of many candidates: `<` impending slip against the tangent
    /// (S = 1), `>` along it.
    pub fn letter(self) -> char {
        match self {
            ContactState::Free => 'o',
            ContactState::Zero => 'z',
            ContactState::Stick => '.',
            ContactState::Slip { sign } if sign > 0 => '<',
            ContactState::Slip { .. } => '>',
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

/// The obstacle at a particle in impending slip, where it is not flat.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Curvature {
    /// kappa: 1 / R on a cylinder of radius R, positive where the obstacle is convex.
    pub value: Rational,
    /// r_N < 0 at the equilibrium, which turns with the obstacle.
    pub normal_reaction: Rational,
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
    /// The coefficient of friction of this particle over mu, > 0; 1 where all have the same.
    pub friction_factor: Rational,
    /// The ends of the factors of the members, if it is not exact ([`Radii`]).
    pub friction_factor_range: Option<[Rational; 2]>,
    /// The reaction at equilibrium, checked against (7) and the sign.
    pub reaction: Option<Reaction>,
    /// The curved obstacle that it may slip along; `None`: a flat one, as in a [`System`] where
    /// the curvature is 0.
    pub curvature: Option<Curvature>,
    /// A name for people: no answer and no digest depends on it.
    pub name: Option<String>,
}

/// A direction in the space of degrees of freedom: a few (dof, coefficient) pairs.
pub type Direction = Vec<(usize, Rational)>;

impl Particle {
    /// A particle in the paper's own directions: friction factor 1, no frame, no reaction, on a
    /// flat obstacle.
    pub fn plain(tangential: usize, normal: usize, state: ContactState) -> Self {
        Particle {
            tangential,
            normal,
            state,
            normal_direction: 1,
            frame: None,
            friction_factor: Rational::one(),
            friction_factor_range: None,
            reaction: None,
            curvature: None,
            name: None,
        }
    }

    /// Its name, or else its number.
    pub fn name_or(&self, number: usize) -> String {
        match &self.name {
            Some(name) => name.clone(),
            None => number.to_string(),
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

    /// The normal times the friction factor c: with it, (3) of this particle reads
    /// |r_T| + mu (c r_N) <= 0.
    pub fn friction_direction(&self) -> Direction {
        let normal = self.into_obstacle();
        normal
            .into_iter()
            .map(|(dof, coefficient)| (dof, coefficient * &self.friction_factor))
            .collect()
    }

    /// g = kappa r_N, the force per length by which the reaction that turns with the obstacle
    /// pulls along it; 0 on a flat one. (9) of this particle has S w_T + c mu w_N +
    /// (1 + c^2 mu^2) g S v_T in place of S w_T + c mu w_N.
    pub fn geometric_stiffness(&self) -> Rational {
        match &self.curvature {
            Some(curvature) => &curvature.value * &curvature.normal_reaction,
            None => Rational::zero(),
        }
    }

    /// (1 + c^2 mu^2) g: what the turning reaction adds to the diagonal of K* at this mu.
    pub fn turning_stiffness(&self, mu: &Rational) -> Rational {
        let own_friction = mu * &self.friction_factor;
        (Rational::one() + &own_friction * &own_friction) * self.geometric_stiffness()
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
/// with K_ff positive definite, M symmetric positive definite where given. [`System::new`] proves
/// that they are definite, [`System::assuming_definite`] does not.
///
/// Its data may have radii ([`System::with_radii`], [`Particle::friction_factor_range`]). Then it
/// stands for a set of bodies, and what asks of one body refuses it ([`System::require_exact`]).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct System {
    stiffness: Sparse,
    mass: Option<Sparse>,
    friction: Option<Rational>,
    particles: Vec<Particle>,
    radii: Radii,
}

impl System {
    /// Establishes every precondition.
    ///
    /// # Errors
    /// [`ModelError`] naming the equation, the index, what was expected and what was found: shapes,
    /// symmetry (3), definiteness of K_ff (the dofs of z particles count as f here) and M by exact
    /// LDL', dofs out of range or claimed twice, signs, frames, friction, reactions against (7).
    pub fn new(
        stiffness: Sparse,
        mass: Option<Sparse>,
        friction: Option<Rational>,
        particles: Vec<Particle>,
    ) -> Result<Self, ModelError> {
        let system = System::assuming_definite(stiffness, mass, friction, particles)?;

        // A z particle may open, so its dofs count as free.
        let f =
            system.dofs_outside(|state| matches!(state, ContactState::Free | ContactState::Zero));
        let k_ff = system.stiffness.submatrix(&f, &f);
        require_definite("P1", "K_ff", &k_ff).map_err(|error| match error {
            ModelError::NotDefinite { index, pivot, .. } => ModelError::NotHeld {
                dof: f[index],
                pivot: Some(pivot),
            },
            ModelError::DefinitenessUndecided { index, .. } => ModelError::NotHeld {
                dof: f[index],
                pivot: None,
            },
            other => other,
        })?;
        if let Some(mass) = &system.mass {
            require_definite("E3", "M", mass)?;
        }

        Ok(system)
    }

    /// Establishes every precondition but one: that K_ff and M are positive definite is assumed.
    ///
    /// For matrices so large that a proof costs too much, and questions that have a meaning without
    /// it, as whether numbers satisfy (9) or (12)-(14). Certificates presuppose it.
    ///
    /// # Errors
    /// [`ModelError`] as [`System::new`], but for definiteness.
    pub fn assuming_definite(
        stiffness: Sparse,
        mass: Option<Sparse>,
        friction: Option<Rational>,
        particles: Vec<Particle>,
    ) -> Result<Self, ModelError> {
        let n = stiffness.rows();
        if n == 0 {
            return Err(ModelError::Empty { what: "system" });
        }

        require_square("E3", "K", &stiffness, n)?;
        require_symmetric("E3", "K", &stiffness)?;
        if let Some(mass) = &mass {
            require_square("E3", "M", mass, n)?;
            require_symmetric("E3", "M", mass)?;
        }

        check_friction(friction.as_ref(), &particles)?;
        check_particles(n, &particles, friction.as_ref())?;

        let system = System {
            stiffness,
            mass,
            friction,
            particles: particles.into_iter().map(flat_without_curvature).collect(),
            radii: Radii::NONE,
        };
        system.with_radii(Radii::NONE)
    }

    /// The same with radii of K and M, in place of those it has.
    ///
    /// # Errors
    /// [`ModelError`] for radii of another shape, that are not symmetric or negative, for a radius
    /// of M without M, and for particles in contact with zero reaction and curved obstacles, which
    /// are not treated.
    pub fn with_radii(mut self, radii: Radii) -> Result<Self, ModelError> {
        self.radii = radii.establish(self.dofs(), self.mass.is_some())?;
        if !self.is_exact() {
            self.require_no_zero()?;
            self.require_flat()?;
        }

        Ok(self)
    }

    /// The same body with other contact states, without reactions, and this mu.
    ///
    /// # Errors
    /// [`ModelError`] for a number of states other than that of particles, for curved obstacles,
    /// whose reactions belong to the states given, and as [`System::new`]: other dofs are free.
    pub fn with_states(
        &self,
        states: &[ContactState],
        friction: Option<Rational>,
    ) -> Result<System, ModelError> {
        if states.len() != self.particles.len() {
            return Err(ModelError::Shape {
                equation: "E9",
                what: "contact states",
                expected_rows: self.particles.len(),
                expected_cols: 1,
                rows: states.len(),
                cols: 1,
            });
        }

        self.require_flat()?;
        let mut particles = self.particles.clone();
        for (particle, &state) in particles.iter_mut().zip(states) {
            particle.state = state;
            particle.reaction = None;
        }

        let system = System::new(
            self.stiffness.clone(),
            self.mass.clone(),
            friction,
            particles,
        )?;
        system.with_radii(self.radii.clone())
    }

    /// The same body, mu and radii with other particles.
    ///
    /// # Errors
    /// [`ModelError`] as [`System::new`] and [`System::with_radii`].
    pub fn with_particles(&self, particles: Vec<Particle>) -> Result<System, ModelError> {
        let stiffness = self.stiffness.clone();
        let system = System::new(
            stiffness,
            self.mass.clone(),
            self.friction.clone(),
            particles,
        )?;
        system.with_radii(self.radii.clone())
    }

    /// Refuses a system that lacks what `unknown` needs: M and mu for lambda^2, flat obstacles for
    /// mu, in which K* is quadratic on curved ones.
    ///
    /// # Errors
    /// [`ModelError::Missing`], [`ModelError::Curved`], or [`ModelError::NothingSlips`] for a
    /// system without solutions.
    pub fn require_for(&self, unknown: Unknown) -> Result<(), ModelError> {
        let is_dynamic = match unknown {
            Unknown::Lambda2 => true,
            Unknown::Mu => {
                self.require_flat()?;
                false
            }
            Unknown::Eigenvalue => {
                let got = "a body".into();
                return Err(ModelError::Eigenvalue { got });
            }
        };
        let missing = if is_dynamic && self.mass.is_none() {
            Some("mass")
        } else if is_dynamic && self.friction.is_none() {
            Some("friction")
        } else {
            None
        };

        if let Some(what) = missing {
            return Err(ModelError::Missing {
                equation: "E12",
                what,
                unknown: unknown.word(),
            });
        }

        if self.slip_particles().is_empty() {
            return Err(ModelError::NothingSlips);
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

    /// How far K and M may be off.
    pub fn radii(&self) -> &Radii {
        &self.radii
    }

    /// Is it one body: are there no radii and no intervals of friction factors?
    pub fn is_exact(&self) -> bool {
        let mut particles = self.particles.iter();
        self.radii.is_none() && particles.all(|p| p.friction_factor_range.is_none())
    }

    /// Refuses a system with radii, for what asks of one body.
    ///
    /// # Errors
    /// [`ModelError::NotExact`].
    pub fn require_exact(&self) -> Result<(), ModelError> {
        if self.is_exact() {
            Ok(())
        } else {
            Err(ModelError::NotExact)
        }
    }

    /// The body as given, without its radii.
    #[must_use]
    pub fn as_given(&self) -> System {
        let mut given = self.clone();
        given.radii = Radii::NONE;
        for particle in &mut given.particles {
            particle.friction_factor_range = None;
        }

        given
    }

    /// The body in the middle of all members: K and M as given, the friction factors in the middle
    /// of their intervals ([`Particle::friction_factor_ball`]). It has no reactions, which belong
    /// to the factors as given.
    #[must_use]
    pub fn middle(&self) -> System {
        let mut middle = self.as_given();
        for (particle, given) in middle.particles.iter_mut().zip(&self.particles) {
            (particle.friction_factor, _) = given.friction_factor_ball();
            particle.reaction = None;
        }

        middle
    }

    /// The contact candidate particles in file order.
    pub fn particles(&self) -> &[Particle] {
        &self.particles
    }

    /// The particles in impending slip, in file order, with their S.
    pub fn slip_particles(&self) -> Vec<(&Particle, i8)> {
        let mut slip = Vec::new();
        for particle in &self.particles {
            if let ContactState::Slip { sign } = particle.state {
                slip.push((particle, sign));
            }
        }

        slip
    }

    /// The particles in contact with zero reaction, in file order.
    pub fn zero_particles(&self) -> Vec<&Particle> {
        let particles = self.particles.iter();
        particles
            .filter(|p| p.state == ContactState::Zero)
            .collect()
    }

    /// The system in which the particles in contact with zero reaction are free, as in (19z) of
    /// `spec/zero-reaction.md`, Z.4. Its preconditions hold, because their dofs count as f here.
    #[must_use]
    pub fn with_zero_free(&self) -> System {
        let mut freed = self.clone();
        for particle in &mut freed.particles {
            if particle.state == ContactState::Zero {
                particle.state = ContactState::Free;
                particle.reaction = None;
            }
        }

        freed
    }

    /// Refuses a system with particles in contact with zero reaction, for what does not treat them.
    ///
    /// # Errors
    /// [`ModelError::ZeroReaction`] naming the first of them.
    pub fn require_no_zero(&self) -> Result<(), ModelError> {
        let is_zero = |particle: &Particle| particle.state == ContactState::Zero;
        match self.particles.iter().position(is_zero) {
            Some(particle) => Err(ModelError::ZeroReaction { particle }),
            None => Ok(()),
        }
    }

    /// Refuses a system on curved obstacles, for what does not treat them.
    ///
    /// # Errors
    /// [`ModelError::Curved`] naming the first particle whose reaction turns.
    pub fn require_flat(&self) -> Result<(), ModelError> {
        match self.curved_particle() {
            Some(particle) => Err(ModelError::Curved { particle }),
            None => Ok(()),
        }
    }

    /// The first particle whose reaction turns along a curved obstacle.
    pub fn curved_particle(&self) -> Option<usize> {
        let mut particles = self.particles.iter();
        particles.position(|particle| particle.curvature.is_some())
    }

    /// f: the dofs of no particle in contact, ascending.
    pub fn free_dofs(&self) -> Vec<usize> {
        self.dofs_outside(|state| state == ContactState::Free)
    }

    /// The dofs of no particle but those with such a state, ascending.
    fn dofs_outside(&self, is_outside: fn(ContactState) -> bool) -> Vec<usize> {
        let mut is_held = vec![false; self.dofs()];
        for particle in &self.particles {
            if !is_outside(particle.state) {
                is_held[particle.tangential] = true;
                is_held[particle.normal] = true;
            }
        }

        (0..self.dofs()).filter(|&dof| !is_held[dof]).collect()
    }
}

/// mu >= 0, and mu > 0 with slip particles: their reaction is on the cone and not zero.
fn check_friction(friction: Option<&Rational>, particles: &[Particle]) -> Result<(), ModelError> {
    let Some(mu) = friction else {
        return Ok(());
    };

    if mu.is_negative() {
        return Err(ModelError::FrictionNegative {
            friction: mu.clone(),
        });
    }

    if !mu.is_zero() {
        return Ok(());
    }

    let first_slip = particles
        .iter()
        .position(|p| matches!(p.state, ContactState::Slip { .. }));
    match first_slip {
        Some(particle) => Err(ModelError::FrictionNotPositive {
            particle,
            friction: mu.clone(),
        }),
        None => Ok(()),
    }
}

fn check_particles(
    n: usize,
    particles: &[Particle],
    friction: Option<&Rational>,
) -> Result<(), ModelError> {
    let mut owner: BTreeMap<usize, usize> = BTreeMap::new();
    for (index, particle) in particles.iter().enumerate() {
        for (which, dof) in [
            ("tangential", particle.tangential),
            ("normal", particle.normal),
        ] {
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

        require_sign(index, "normal_direction", particle.normal_direction)?;
        if let ContactState::Slip { sign } = particle.state {
            require_sign(index, "sign", sign)?;
        }
        check_frame(index, particle)?;
        check_friction_factor(index, particle)?;
        check_friction_range(index, particle)?;
        check_reaction(index, particle, friction)?;
        check_curvature(index, particle)?;
    }

    Ok(())
}

fn require_sign(particle: usize, field: &'static str, value: i8) -> Result<(), ModelError> {
    if matches!(value, -1 | 1) {
        return Ok(());
    }

    Err(ModelError::Sign {
        particle,
        field,
        expected: "1 or -1",
        got: value.to_string(),
    })
}

/// The frame [[a, b], [c, d]] is a rotation: unit rows and determinant 1. By Lagrange's identity
/// (ac + bd)^2 = |row 0|^2 |row 1|^2 - (ad - bc)^2 = 0, the rows are orthogonal then.
fn check_frame(index: usize, particle: &Particle) -> Result<(), ModelError> {
    let Some([[a, b], [c, d]]) = &particle.frame else {
        return Ok(());
    };

    let numbers = [
        ("|row 0|^2", a * a + b * b),
        ("|row 1|^2", c * c + d * d),
        ("the determinant", a * d - b * c),
    ];

    for (what, got) in numbers {
        if !got.is_one() {
            return Err(ModelError::FrameNotRotation {
                particle: index,
                got: format!("{what} = {got}"),
            });
        }
    }

    Ok(())
}

/// A particle without friction is not the paper's: its states d and s do not exist.
fn check_friction_factor(index: usize, particle: &Particle) -> Result<(), ModelError> {
    if particle.friction_factor.is_positive() {
        return Ok(());
    }

    Err(ModelError::FrictionFactor {
        particle: index,
        factor: particle.friction_factor.clone(),
    })
}

/// (7), and the definitions of f, d, s after (9).
fn check_reaction(
    index: usize,
    particle: &Particle,
    friction: Option<&Rational>,
) -> Result<(), ModelError> {
    let Some(reaction) = &particle.reaction else {
        return Ok(());
    };

    let friction = friction.map(|mu| mu * &particle.friction_factor);
    let Some(expected) = broken_condition(particle.state, reaction, friction.as_ref()) else {
        return Ok(());
    };

    Err(ModelError::ReactionContradicts {
        particle: index,
        state: particle.state.word(),
        expected,
        tangential: reaction.tangential.clone(),
        normal: reaction.normal.clone(),
    })
}

/// A curvature belongs to a particle that slips, and its r_N is that of the reaction.
fn check_curvature(index: usize, particle: &Particle) -> Result<(), ModelError> {
    let Some(curvature) = &particle.curvature else {
        return Ok(());
    };

    let refused = |expected, got| ModelError::Curvature {
        particle: index,
        expected,
        got,
    };
    if !matches!(particle.state, ContactState::Slip { .. }) {
        let got = format!("one in state {}", particle.state.word());
        return Err(refused("none but in state slip", got));
    }

    let normal_reaction = &curvature.normal_reaction;
    if !normal_reaction.is_negative() {
        let expected = "normal_reaction < 0 (the obstacle pushes)";
        return Err(refused(expected, normal_reaction.to_string()));
    }

    match &particle.reaction {
        Some(reaction) if reaction.normal != *normal_reaction => {
            let got = format!("{normal_reaction} and {}", reaction.normal);
            Err(refused(
                "one normal reaction in curvature and in reaction",
                got,
            ))
        }
        _ => Ok(()),
    }
}

/// The particle without a curvature of value 0: what has one is curved.
fn flat_without_curvature(mut particle: Particle) -> Particle {
    particle.curvature = particle.curvature.filter(|c| !c.value.is_zero());
    particle
}

/// The first condition on a reaction that does not hold; `friction` is that of the particle. Those
/// with mu are left out where mu is the unknown.
fn broken_condition(
    state: ContactState,
    reaction: &Reaction,
    friction: Option<&Rational>,
) -> Option<&'static str> {
    let Reaction { tangential, normal } = reaction;

    if matches!(state, ContactState::Free | ContactState::Zero) {
        let is_zero = normal.is_zero() && tangential.is_zero();
        return (!is_zero).then_some("no reaction");
    }

    if !normal.is_negative() {
        return Some("r_N < 0");
    }

    let cone = friction.map(|mu| -mu * normal); // mu |r_N|
    let size = tangential.abs();

    match state {
        ContactState::Free | ContactState::Zero => None,
        ContactState::Stick => {
            let is_inside = cone.is_none_or(|cone| size < cone);
            (!is_inside).then_some("|r_T| < -mu r_N")
        }
        ContactState::Slip { sign } => {
            if tangential.signum() != Rational::from_integer(sign.into()) {
                return Some("sign(r_T) equal to sign");
            }
            let is_on_cone = cone.is_none_or(|cone| size == cone);
            (!is_on_cone).then_some("|r_T| = -mu r_N")
        }
    }
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
        let particles = vec![
            Particle::plain(0, 1, SLIP),
            Particle::plain(2, 3, ContactState::Free),
        ];

        let system = build(1, particles).unwrap();

        assert_eq!(system.free_dofs(), vec![2, 3]);
        assert_eq!(system.slip_particles().len(), 1);
        assert!(system.require_for(Unknown::Lambda2).is_ok());

        let stuck = build(1, vec![Particle::plain(0, 1, ContactState::Stick)]).unwrap();
        for unknown in [Unknown::Mu, Unknown::Lambda2] {
            assert_eq!(stuck.require_for(unknown), Err(ModelError::NothingSlips));
        }
    }

    /// A z particle belongs neither to f nor to s, and K has to be definite on its dofs.
    #[test]
    fn a_particle_with_zero_reaction_is_free_to_open() {
        let particles = || {
            vec![
                Particle::plain(0, 1, SLIP),
                Particle::plain(3, 2, ContactState::Zero),
            ]
        };

        let system = build(1, particles()).unwrap();
        assert!(system.free_dofs().is_empty());
        assert_eq!(system.zero_particles(), [&system.particles()[1]]);
        assert_eq!(
            system.require_no_zero(),
            Err(ModelError::ZeroReaction { particle: 1 })
        );

        // K has nothing at degree of freedom 2: definite on the slip particle only.
        let ones = [0, 1, 3].map(|i| (i, i, whole(1)));
        let stiffness = Sparse::from_entries(4, 4, ones);
        let singular = System::new(stiffness, None, None, particles());
        assert!(matches!(singular, Err(ModelError::NotHeld { dof: 2, .. })));
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

    /// A system with mu = 2 and one particle with this reaction.
    fn with_reaction(
        state: ContactState,
        tangential: Rational,
        normal: Rational,
    ) -> Result<System, ModelError> {
        let particle = Particle {
            reaction: Some(Reaction { tangential, normal }),
            ..Particle::plain(0, 1, state)
        };
        build(2, vec![particle])
    }

    #[test]
    fn reactions_are_held_against_the_friction_cone() {
        let accepted = [
            (SLIP, whole(2), whole(-1)),
            (ContactState::Free, whole(0), whole(0)),
            (ContactState::Zero, whole(0), whole(0)),
            (ContactState::Stick, rational(19, 10), whole(-1)),
        ];

        for (state, tangential, normal) in accepted {
            assert!(with_reaction(state, tangential, normal).is_ok());
        }

        let refused = [
            (SLIP, whole(-2), whole(-1)),
            (SLIP, rational(19, 10), whole(-1)),
            (SLIP, whole(2), whole(1)),
            (ContactState::Stick, whole(2), whole(-1)),
            (ContactState::Free, whole(0), whole(-1)),
            (ContactState::Zero, whole(0), whole(-1)),
        ];

        for (state, tangential, normal) in refused {
            assert!(matches!(
                with_reaction(state, tangential, normal),
                Err(ModelError::ReactionContradicts { particle: 0, .. })
            ));
        }

        let pulling = [
            (SLIP, whole(1)),
            (SLIP, whole(0)),
            (ContactState::Stick, whole(1)),
            (ContactState::Stick, whole(0)),
        ];

        for (state, normal) in pulling {
            assert!(matches!(
                with_reaction(state, whole(0), normal),
                Err(ModelError::ReactionContradicts {
                    expected: "r_N < 0",
                    ..
                })
            ));
        }
    }

    /// mu = 2 and the factor 3/4: the cone is |r_T| <= 3/2 |r_N|.
    #[test]
    fn reactions_are_held_against_the_cone_of_their_own_particle() {
        let with = |tangential: Rational| {
            let particle = Particle {
                friction_factor: rational(3, 4),
                reaction: Some(Reaction {
                    tangential,
                    normal: whole(-1),
                }),
                ..Particle::plain(0, 1, SLIP)
            };
            build(2, vec![particle])
        };

        assert!(with(rational(3, 2)).is_ok());
        assert!(matches!(
            with(whole(2)),
            Err(ModelError::ReactionContradicts { particle: 0, .. })
        ));
    }

    #[test]
    fn matrices_are_held_against_section_2() {
        let singular = System::new(Sparse::zeros(2, 2), None, None, vec![]);
        assert!(matches!(singular, Err(ModelError::NotHeld { dof: 0, .. })));

        let indefinite_mass =
            System::new(Sparse::identity(2), Some(Sparse::zeros(2, 2)), None, vec![]);
        assert!(matches!(
            indefinite_mass,
            Err(ModelError::NotDefinite { what: "M", .. })
        ));

        let skew =
            Sparse::from_entries(2, 2, [(0, 0, whole(1)), (1, 1, whole(1)), (0, 1, whole(1))]);
        assert!(matches!(
            System::new(skew.clone(), None, None, vec![]),
            Err(ModelError::NotSymmetric { row: 0, col: 1, .. })
        ));

        let assumed = System::assuming_definite(Sparse::zeros(2, 2), None, None, vec![]);
        assert!(assumed.is_ok());
        assert!(matches!(
            System::assuming_definite(skew, None, None, vec![]),
            Err(ModelError::NotSymmetric { row: 0, col: 1, .. })
        ));
    }
}
