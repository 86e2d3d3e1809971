//! A body under loads: K, M, mu, contact candidates with their gaps, and loads that are applied one
//! after the other. From it come the contact states with which a [`System`] begins.
//!
//! ```text
//! M u'' + K u = sum_l a_l f_l + r,    u_p = sum_l a_l d_l on the held dofs p
//! ```
//!
//! Held dofs are eliminated: with the others k, the loads are f_k - K_kp d, and K, M become K_kk,
//! M_kk. Input: matrices over all dofs and the loads as (dof, value) pairs. [`LoadedBody`] is what
//! a file `mceip-loads/1` holds and `mceip_path` follows.

use super::canonical;
use super::{ContactState, ModelError, Particle, Problem, System, Unknown, Window};
use crate::problem::Body;
use mceip_exact::{Rational, Sparse, to_f64};
use num_traits::{Signed, Zero};

/// A contact candidate: a particle whose state is not known yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ContactCandidate {
    /// Its dofs and directions; state and reaction play no part.
    pub particle: Particle,
    /// Its distance from the obstacle in the unloaded body, >= 0.
    pub gap: Rational,
}

/// A load: it grows from nothing, and stays while the next one grows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadStep {
    /// A name for people.
    pub name: String,
    /// Forces, as (dof, value) pairs.
    pub forces: Vec<(usize, Rational)>,
    /// Displacements of held dofs, as (dof, value) pairs.
    pub displacements: Vec<(usize, Rational)>,
    /// Does it grow until nothing more happens, instead of up to these values?
    pub is_endless: bool,
}

/// The parts of a [`LoadedBody`], over all dofs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadedParts {
    /// K, symmetric; positive definite without the held dofs and those of the candidates.
    pub stiffness: Sparse,
    /// M.
    pub mass: Option<Sparse>,
    /// mu.
    pub friction: Option<Rational>,
    /// What may come into contact.
    pub candidates: Vec<ContactCandidate>,
    /// Dofs that do not move unless a step moves them.
    pub held: Vec<usize>,
    /// The loads, in the order in which they are applied.
    pub steps: Vec<LoadStep>,
}

/// A body under loads, its held dofs eliminated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadedBody {
    system: System,
    gaps: Vec<Rational>,
    steps: Vec<LoadStep>,
    loads: Vec<Vec<Rational>>,
    /// The dof of the system that each given one is, `None` for those held.
    places: Vec<Option<usize>>,
}

impl LoadedBody {
    /// Establishes every precondition and eliminates the held dofs: those of `held` and those that
    /// a step displaces.
    ///
    /// # Errors [`ModelError::Loads`] for dofs out of range, a candidate or a force on a held dof,
    /// a dof named twice, a negative gap, no step, an endless step before another; what
    /// [`System::new`] refuses.
    pub fn new(parts: LoadedParts) -> Result<LoadedBody, ModelError> {
        require_matrices(&parts)?;
        let dofs = parts.stiffness.rows();
        let is_held = held_dofs(dofs, &parts)?;
        require_steps(&parts.steps)?;
        require_forces(dofs, &parts.steps, &is_held)?;

        let kept: Vec<usize> = (0..dofs).filter(|&dof| !is_held[dof]).collect();
        let mut places = vec![None; dofs];
        for (place, &dof) in kept.iter().enumerate() {
            places[dof] = Some(place);
        }

        let mut particles = Vec::with_capacity(parts.candidates.len());
        let mut gaps = Vec::with_capacity(parts.candidates.len());
        for (index, candidate) in parts.candidates.iter().enumerate() {
            particles.push(particle(index, candidate, &places)?);
            gaps.push(gap(index, candidate)?);
        }
        if particles.is_empty() {
            return Err(refused("at least one contact candidate", "none"));
        }

        let mut loads = Vec::with_capacity(parts.steps.len());
        for step in &parts.steps {
            let load = load(step, &parts.stiffness, &kept);
            require_doubles(&load, &step.name)?;
            loads.push(load);
        }
        let mass = parts.mass.as_ref().map(|mass| mass.submatrix(&kept, &kept));
        let stiffness = parts.stiffness.submatrix(&kept, &kept);

        Ok(LoadedBody {
            system: System::new(stiffness, mass, parts.friction, particles)?,
            gaps,
            steps: parts.steps,
            loads,
            places,
        })
    }

    /// The body without the held dofs, all candidates stuck.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Distance of each candidate from the obstacle in the unloaded body.
    pub fn gaps(&self) -> &[Rational] {
        &self.gaps
    }

    /// The steps as they were given.
    pub fn steps(&self) -> &[LoadStep] {
        &self.steps
    }

    /// The load of each step over the dofs of the system: forces, and what the held dofs exert.
    pub fn loads(&self) -> &[Vec<Rational>] {
        &self.loads
    }

    /// The dof of the system that each given one is; `None` for those held.
    pub fn places(&self) -> &[Option<usize>] {
        &self.places
    }

    /// SHA-256 of the canonical form (`spec/formats.md`) in lower-case hexadecimal.
    pub fn sha256(&self) -> String {
        canonical::sha256(&canonical::loads_text(self))
    }

    /// The problem of an equilibrium with these contact states; mu stays that of the loads.
    ///
    /// # Errors
    /// [`ModelError`] for a number of states other than that of candidates, no slip, or what the
    /// unknown needs.
    pub fn problem(
        &self,
        states: &[ContactState],
        friction: &Rational,
        unknown: Unknown,
    ) -> Result<Problem, ModelError> {
        let system = self.system.with_states(states, Some(friction.clone()))?;
        Problem::new(Body::System(system), unknown, Window::all())
    }
}

/// Refuses matrices that are not square, of one order and symmetric, held dofs included: what is
/// eliminated is believed too.
fn require_matrices(parts: &LoadedParts) -> Result<(), ModelError> {
    let stiffness = parts.stiffness.clone();
    System::assuming_definite(stiffness, parts.mass.clone(), None, Vec::new())?;
    Ok(())
}

/// Refuses loads beyond the range of doubles, in which displacements and reactions are printed.
fn require_doubles(load: &[Rational], step: &str) -> Result<(), ModelError> {
    for value in load {
        if !to_f64(value).is_finite() {
            let expected = format!("loads of step {step:?} that doubles can hold, below 1.8e308");
            return Err(refused(&expected, "a larger one"));
        }
    }

    Ok(())
}

/// Which dofs are held.
fn held_dofs(dofs: usize, parts: &LoadedParts) -> Result<Vec<bool>, ModelError> {
    let mut is_held = vec![false; dofs];
    for &dof in &parts.held {
        *in_range(&mut is_held, dof)? = true;
    }

    for step in &parts.steps {
        let mut is_displaced = vec![false; dofs];
        for &(dof, _) in &step.displacements {
            once(&mut is_displaced, dof, &step.name)?;
            is_held[dof] = true;
        }
    }

    Ok(is_held)
}

fn in_range(of_dofs: &mut [bool], dof: usize) -> Result<&mut bool, ModelError> {
    let limit = of_dofs.len();
    of_dofs.get_mut(dof).ok_or_else(|| {
        let expected = format!("degrees of freedom from 0 to {}", limit.saturating_sub(1));
        refused(&expected, &dof.to_string())
    })
}

/// Marks a dof, and refuses one that is marked.
fn once(is_marked: &mut [bool], dof: usize, step: &str) -> Result<(), ModelError> {
    let mark = in_range(is_marked, dof)?;
    if std::mem::replace(mark, true) {
        let expected = format!("each degree of freedom once in step {step:?}");
        return Err(refused(&expected, &format!("{dof} twice")));
    }

    Ok(())
}

fn require_steps(steps: &[LoadStep]) -> Result<(), ModelError> {
    let Some((_, before)) = steps.split_last() else {
        return Err(refused("at least one step", "none"));
    };

    match before.iter().find(|step| step.is_endless) {
        None => Ok(()),
        Some(step) => Err(refused(
            "an endless step at the end only",
            &format!("{:?} before another", step.name),
        )),
    }
}

fn require_forces(dofs: usize, steps: &[LoadStep], is_held: &[bool]) -> Result<(), ModelError> {
    for step in steps {
        let mut is_loaded = vec![false; dofs];
        for &(dof, _) in &step.forces {
            once(&mut is_loaded, dof, &step.name)?;
            if is_held[dof] {
                let expected = format!(
                    "forces of step {:?} on degrees of freedom that are not held",
                    step.name
                );
                return Err(refused(&expected, &dof.to_string()));
            }
        }
    }

    Ok(())
}

/// The candidate as a stuck particle of the body without the held dofs.
fn particle(
    index: usize,
    candidate: &ContactCandidate,
    places: &[Option<usize>],
) -> Result<Particle, ModelError> {
    let place = |which: &'static str, dof: usize| match places.get(dof) {
        Some(Some(place)) => Ok(*place),
        Some(None) => Err(refused(
            "candidates on degrees of freedom that are not held",
            &format!("candidate {index}, {which} {dof}"),
        )),
        None => Err(ModelError::DofOutOfRange {
            particle: index,
            which,
            dof,
            limit: places.len(),
        }),
    };

    Ok(Particle {
        tangential: place("tangential", candidate.particle.tangential)?,
        normal: place("normal", candidate.particle.normal)?,
        state: ContactState::Stick,
        reaction: None,
        ..candidate.particle.clone()
    })
}

fn gap(index: usize, candidate: &ContactCandidate) -> Result<Rational, ModelError> {
    if candidate.gap.is_negative() {
        let got = format!("candidate {index}, gap {}", candidate.gap);
        return Err(refused("gaps >= 0", &got));
    }
    if !to_f64(&candidate.gap).is_finite() {
        let got = format!("candidate {index}, a larger one");
        return Err(refused("gaps that doubles can hold, below 1.8e308", &got));
    }

    Ok(candidate.gap.clone())
}

/// f_k - K_kp d_p.
fn load(step: &LoadStep, stiffness: &Sparse, kept: &[usize]) -> Vec<Rational> {
    let mut given = vec![Rational::zero(); stiffness.rows()];
    for (dof, value) in &step.displacements {
        given[*dof] = -value;
    }

    let mut load = stiffness.times(&given);
    for (dof, value) in &step.forces {
        load[*dof] += value;
    }

    kept.iter().map(|&dof| load[dof].clone()).collect()
}

fn refused(expected: &str, got: &str) -> ModelError {
    ModelError::Loads {
        expected: expected.into(),
        got: got.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{parse, rational, whole};

    /// A chain of three springs of stiffness 1 between four points, all along; the point at the end
    /// touches, with a normal dof on a spring of its own.
    fn chain() -> LoadedParts {
        let stiffness = Sparse::from_ints(&[
            &[1, -1, 0, 0, 0],
            &[-1, 2, -1, 0, 0],
            &[0, -1, 2, -1, 0],
            &[0, 0, -1, 1, 0],
            &[0, 0, 0, 0, 1],
        ]);
        LoadedParts {
            stiffness,
            mass: None,
            friction: Some(rational(1, 2)),
            candidates: vec![ContactCandidate {
                particle: Particle::plain(3, 4, ContactState::Free),
                gap: whole(0),
            }],
            held: Vec::new(),
            steps: vec![LoadStep {
                name: "pull".into(),
                forces: vec![(2, whole(7))],
                displacements: vec![(0, whole(3))],
                is_endless: false,
            }],
        }
    }

    fn refusal(change: impl FnOnce(&mut LoadedParts)) -> String {
        let mut parts = chain();
        change(&mut parts);
        LoadedBody::new(parts).unwrap_err().to_string()
    }

    fn beyond_doubles() -> Rational {
        parse("1e400").unwrap()
    }

    #[test]
    fn displaced_dofs_are_eliminated_into_loads() {
        let body = LoadedBody::new(chain()).unwrap();

        assert_eq!(body.places(), [None, Some(0), Some(1), Some(2), Some(3)]);
        assert_eq!(
            body.system().stiffness(),
            &Sparse::from_ints(&[
                &[2, -1, 0, 0],
                &[-1, 2, -1, 0],
                &[0, -1, 1, 0],
                &[0, 0, 0, 1]
            ])
        );
        // The spring to the displaced point pulls with 3.
        let load = [3, 7, 0, 0].map(whole);
        assert_eq!(body.loads(), [load.to_vec()]);
        assert_eq!(body.system().particles()[0].tangential, 2);
    }

    #[test]
    fn the_problem_of_a_state_has_the_states_and_friction() {
        let body = LoadedBody::new(chain()).unwrap();
        let slips = [ContactState::Slip { sign: 1 }];
        let problem = body.problem(&slips, &rational(1, 3), Unknown::Mu).unwrap();

        let Body::System(system) = problem.body() else {
            panic!("a system")
        };
        assert_eq!(system.particles()[0].state, slips[0]);
        assert_eq!(system.friction(), Some(&rational(1, 3)));
        assert!(body.problem(&[], &whole(1), Unknown::Mu).is_err());
        assert!(
            body.problem(&[ContactState::Stick], &whole(1), Unknown::Mu)
                .is_err()
        );
    }

    #[test]
    fn what_makes_no_sense_is_refused_with_its_place() {
        for (refusal, word) in [
            (refusal(|p| p.held.push(9)), "from 0 to 4, got 9"),
            (refusal(|p| p.held.push(4)), "candidate 0, normal 4"),
            (refusal(|p| p.held.push(2)), "not held, got 2"),
            (
                refusal(|p| p.steps[0].forces.push((2, whole(1)))),
                "2 twice",
            ),
            (
                refusal(|p| p.steps[0].displacements.push((0, whole(1)))),
                "0 twice",
            ),
            (refusal(|p| p.candidates[0].gap = whole(-1)), "gap -1"),
            (refusal(|p| p.candidates[0].gap = beyond_doubles()), "gaps"),
            (
                refusal(|p| p.steps[0].forces[0].1 = beyond_doubles()),
                "loads of step \"pull\" that doubles can hold",
            ),
            (refusal(|p| p.candidates.clear()), "candidate, got none"),
            (refusal(|p| p.steps.clear()), "step, got none"),
            (
                refusal(|p| {
                    let mut endless = p.steps[0].clone();
                    endless.is_endless = true;
                    p.steps.insert(0, endless);
                }),
                "before another",
            ),
            (refusal(|p| p.stiffness = Sparse::zeros(5, 5)), "K_ff"),
            (refusal(|p| p.stiffness = Sparse::zeros(5, 4)), "K"),
            (refusal(|p| p.mass = Some(Sparse::identity(4))), "M"),
            (refusal(|p| p.mass = Some(Sparse::identity(6))), "M"),
            (
                refusal(|p| {
                    let one_sided = Sparse::from_entries(5, 5, [(0, 1, whole(1))]);
                    p.stiffness = p.stiffness.add_scaled(&whole(1), &one_sided);
                }),
                "symmetric",
            ),
        ] {
            assert!(refusal.contains(word), "{refusal}");
        }
    }
}
