//! The deformed body at an equilibrium: displacements of all its dofs, in doubles, for pictures.
//!
//! A path knows the displacements u_c of the candidates exactly. Those of the other dofs i follow
//! from (5), no reaction acting there:
//!
//! ```text
//!     u_i = K_ii^-1 (f_i - K_ic u_c),     f = sum a_l f_l
//! ```
//!
//! by one sparse Cholesky factorisation. Nothing is claimed of these numbers; no answer rests on
//! them.

use super::error::PathError;
use super::line::Equilibrium;
use super::loading_path::LoadingPath;
use super::stretch::Stretch;
use mceip_exact::to_f64;
use mceip_mcp::linear::{SymbolicAnalysis, Symmetric};
use mceip_model::LoadedBody;

impl LoadingPath {
    /// The displacements at equilibria of this path, each with its stretch: a list over the dofs of
    /// the body's system for each of them.
    ///
    /// # Errors
    /// [`PathError`] for a stiffness that doubles cannot carry, or that is not positive definite in
    /// them without the dofs of the candidates.
    #[allow(clippy::float_arithmetic)]
    pub fn displacements(
        &self,
        body: &LoadedBody,
        equilibria: &[(&Stretch, &Equilibrium)],
    ) -> Result<Vec<Vec<f64>>, PathError> {
        let system = body.system();
        let candidates = system.particles();
        let dofs = candidates.iter().flat_map(|p| [p.tangential, p.normal]);
        let contact: Vec<usize> = dofs.collect();

        let entries = system.stiffness().entries();
        let entries = entries.map(|(i, j, entry)| (i, j, to_f64(entry)));
        let stiffness = Symmetric::new(system.dofs(), entries)?;
        let analysis = SymbolicAnalysis::new(&stiffness, &contact, &[], None);
        let factor = analysis.factor(&stiffness);
        let factor = factor.map_err(|e| PathError::NotDefinite { dof: e.index })?;

        let mut all = Vec::with_capacity(equilibria.len());
        for (stretch, at) in equilibria {
            let mut of_candidates = vec![0.0; system.dofs()];
            for (node, candidate) in candidates.iter().enumerate() {
                let (tangential, normal) = at.displacement(node);
                let directions = [candidate.tangent(), candidate.into_obstacle()];
                for (size, direction) in [tangential, normal].iter().zip(&directions) {
                    for (dof, coefficient) in direction {
                        of_candidates[*dof] += to_f64(size) * to_f64(coefficient);
                    }
                }
            }

            let mut load = vec![0.0; system.dofs()];
            let applied = self.applied_at(stretch, at);
            for (amount, forces) in applied.iter().zip(body.loads()) {
                let amount = to_f64(amount);
                for (sum, force) in load.iter_mut().zip(forces) {
                    *sum += amount * to_f64(force);
                }
            }

            let kept: Vec<f64> = contact.iter().map(|dof| of_candidates[*dof]).collect();
            let mut u = factor.extend(&kept);
            for (sum, of_load) in u.iter_mut().zip(factor.solve(&load)) {
                *sum += of_load;
            }
            all.push(u);
        }

        Ok(all)
    }
}

#[cfg(test)]
#[allow(clippy::float_arithmetic)]
mod tests {
    use crate::{Contact, LoadSteps, LoadingPath};
    use mceip_exact::{Rational, Sparse, rational, to_f64, whole};
    use mceip_model::{
        ContactCandidate, ContactState, LoadStep, LoadedBody, LoadedParts, Particle,
    };
    use std::ops::ControlFlow;

    /// Two candidates, the second one on a slope, and a node that is free of contact.
    fn body() -> LoadedBody {
        let stiffness = Sparse::from_ints(&[
            &[9, 1, -2, 0, -3, 0],
            &[1, 8, 0, -1, 0, -2],
            &[-2, 0, 7, 1, -1, 0],
            &[0, -1, 1, 9, 0, -3],
            &[-3, 0, -1, 0, 8, 1],
            &[0, -2, 0, -3, 1, 7],
        ]);
        let slope = [
            [rational(4, 5), rational(3, 5)],
            [rational(-3, 5), rational(4, 5)],
        ];
        let oblique = Particle {
            frame: Some(slope),
            normal_direction: -1,
            ..Particle::plain(2, 3, ContactState::Free)
        };
        let candidates = [Particle::plain(0, 1, ContactState::Free), oblique];
        let step = |name: &str, forces: &[(usize, i64)]| LoadStep {
            name: name.into(),
            forces: forces.iter().map(|(dof, f)| (*dof, whole(*f))).collect(),
            displacements: Vec::new(),
            is_endless: false,
        };

        LoadedBody::new(LoadedParts {
            stiffness,
            mass: None,
            friction: Some(rational(1, 2)),
            candidates: candidates
                .map(|particle| ContactCandidate {
                    particle,
                    gap: rational(1, 100),
                })
                .to_vec(),
            held: Vec::new(),
            steps: vec![
                step("press", &[(1, 5), (3, -4), (5, 1)]),
                step("push", &[(4, 9)]),
            ],
        })
        .unwrap()
    }

    /// K u - f is the reaction at the candidates and zero elsewhere. // (5)
    #[test]
    fn forces_balance_at_the_end_of_every_stretch() {
        let body = body();
        let system = body.system();
        let contact = Contact::condense(system, body.gaps(), body.loads()).unwrap();
        let steps = LoadSteps::new(rational(1, 2), vec![Some(whole(1)), Some(whole(1))]);
        let path = LoadingPath::follow(&contact, &steps, &|_| ControlFlow::Continue(())).unwrap();
        let places: Vec<_> = path.stretches.iter().map(|s| (s, s.last())).collect();
        assert!(places.len() >= 3, "{}", places.len());

        let all = path.displacements(&body, &places).unwrap();
        for ((stretch, at), u) in places.into_iter().zip(all) {
            let mut left = vec![0.0; system.dofs()];
            for (i, j, entry) in system.stiffness().entries() {
                left[i] += to_f64(entry) * u[j];
            }
            let applied = path.applied_at(stretch, at);
            for (amount, load) in applied.iter().zip(body.loads()) {
                for (sum, force) in left.iter_mut().zip(load) {
                    *sum -= to_f64(amount) * to_f64(force);
                }
            }
            for (node, candidate) in system.particles().iter().enumerate() {
                let (tangential, normal) = at.reaction(node);
                let mut subtract = |size: &Rational, direction: Vec<(usize, Rational)>| {
                    for (dof, coefficient) in direction {
                        left[dof] -= to_f64(size) * to_f64(&coefficient);
                    }
                };
                subtract(&tangential, candidate.tangent());
                subtract(&normal, candidate.into_obstacle());
            }

            let largest = left.iter().fold(0.0_f64, |sum, f| sum.max(f.abs()));
            assert!(largest < 1e-12, "{left:?}");
        }
    }
}
