//! The block with K and M in doubles: condensed for a search, and as exact data for the backward
//! error of what was found.
//!
//! K and M are those of [`DoubleBlock`], each the mean of itself and its transpose: both uses have
//! the same entries. Called by `lambda2`.

use super::scale;
use super::scale_error::ScaleError;
use mceip_engine::reduction::SparseCondensation;
use mceip_exact::Rational;
use mceip_model::{Body, ContactState, ModelError, Particle, Problem, System, Unknown, Window};
use mceip_paper::{BlockModel, DoubleBlock};

/// A block in doubles with contact states.
pub(super) struct CondensedBlock {
    pub(super) condensation: SparseCondensation,
    particles: Vec<Particle>,
}

impl CondensedBlock {
    pub(super) fn new(
        model: &BlockModel,
        states: &[ContactState],
    ) -> Result<CondensedBlock, ScaleError> {
        let block = DoubleBlock::new(model)?;
        let stiffness = scale::symmetric("K", &block.stiffness)?;
        let mass = scale::symmetric("M", &block.mass)?;

        let particles = block.particles(states);
        let points = Some(block.points.as_slice());
        let condensation = SparseCondensation::new(stiffness, Some(mass), &particles, points)?;

        Ok(CondensedBlock {
            condensation,
            particles,
        })
    }

    /// MCEIP-lambda2 of the system whose K and M are exactly these doubles. That they are positive
    /// definite is not proved.
    pub(super) fn problem(&self, mu: &Rational) -> Result<Problem, ModelError> {
        let order = self.condensation.dofs();
        let stiffness = scale::exact(order, self.condensation.stiffness().entries())?;
        let mass = match self.condensation.mass() {
            Some(mass) => Some(scale::exact(order, mass.entries())?),
            None => None,
        };

        let particles = self.particles.clone();
        let system = System::assuming_definite(stiffness, mass, Some(mu.clone()), particles)?;
        Problem::new(Body::System(system), Unknown::Lambda2, Window::all())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_engine::candidate::Candidate;
    use mceip_engine::multistart::{CondensedSearch, search_condensed};
    use mceip_engine::run::Watch;
    use mceip_exact::{parse, to_f64, whole};

    /// A block of 10 x 5 cells with 8 slip nodes.
    fn block() -> CondensedBlock {
        let model = BlockModel::of_the_paper().with_cells(10, 5);
        CondensedBlock::new(&model, &scale::states(10)).unwrap()
    }

    /// The solutions at mu = 2.
    fn candidates(block: &CondensedBlock) -> Vec<Candidate> {
        let search = CondensedSearch {
            starts: 4,
            ..CondensedSearch::default()
        };
        let found = search_condensed(&block.condensation, 2.0, &search, &Watch::nobody());
        let solutions = found.unwrap().solutions;
        solutions.into_iter().map(|s| s.candidate).collect()
    }

    #[test]
    fn a_solution_in_doubles_has_a_backward_error_of_rounding_size() {
        let block = block();
        let problem = block.problem(&whole(2)).unwrap();
        let candidates = candidates(&block);

        assert!(!candidates.is_empty());
        for candidate in candidates {
            let error = candidate.backward_error(&problem).unwrap();
            assert!(error < parse("1e-10").unwrap(), "{}", to_f64(&error));
        }
    }

    /// A free and a slip component, and the value.
    #[test]
    fn a_number_moved_by_a_millionth_has_a_larger_backward_error() {
        let block = block();
        let problem = block.problem(&whole(2)).unwrap();
        let candidate = candidates(&block).remove(0);
        let last = candidate.x.len() - 1;
        let mut moved = vec![candidate.clone(); 3];

        moved[0].x[0] *= 1.000_001;
        moved[1].x[last] *= 1.000_001;
        moved[2].value *= 1.000_001;

        for candidate in moved {
            let error = candidate.backward_error(&problem).unwrap();
            assert!(error > parse("1e-9").unwrap(), "{}", to_f64(&error));
        }
    }

    /// K and M are definite, so that the system is one of which that is proved.
    #[test]
    fn the_problem_is_that_of_a_system_in_doubles() {
        let problem = block().problem(&whole(2)).unwrap();
        let Body::System(system) = problem.body() else {
            panic!("a pencil")
        };

        let proved = System::new(
            system.stiffness().clone(),
            system.mass().cloned(),
            system.friction().cloned(),
            system.particles().to_vec(),
        );

        assert_eq!(proved.as_ref(), Ok(system));
    }
}
