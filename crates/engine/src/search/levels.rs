//! The curves mu(lambda^2) of a contact state, level by level.
//!
//! For a fixed lambda^2 MCEIP-lambda2 is MCEIP-mu with K* = K + lambda^2 M in the place of K, so a
//! complete search finds every mu of a level. The pencil of a level is condensed in doubles
//! ([`SparseCondensation`]); its complete set is that of the rounded pencil. For pictures, and for
//! starts of what is certified elsewhere. Called by `mceip path` and `analyze`.

use super::complete::{CompleteError, CompleteOptions, complete};
use crate::reduction::{SparseCondensation, SparseCondensed};
use crate::run::Watch;
use mceip_exact::{Sparse, from_f64, to_f64};
use mceip_mcp::linear;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

/// A solution on a level.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelSolution {
    /// Coefficient of friction.
    pub mu: f64,
    /// Slip variables with x > 0.
    pub support: Vec<usize>,
    /// x of the slip variables, e'x = 1.
    pub x: Vec<f64>,
}

/// Every solution of the level lambda^2 = t as rounded, and whether nothing is left open.
///
/// # Errors
/// [`CompleteError`]; entries that are not finite are refused.
pub fn level_solutions(
    level: &SparseCondensed<'_>,
    watch: &Watch<'_>,
) -> Result<(Vec<LevelSolution>, bool), CompleteError> {
    let singular = || CompleteError::SingularLevel { lambda2: level.t };
    let a = exact(&level.a).ok_or_else(singular)?;
    let b = exact(&level.b).ok_or_else(singular)?;
    let pencil = Pencil::new(a, b, Vec::new())?;
    let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?;
    let found = complete(&problem, &CompleteOptions::default(), watch)?;

    let mut solutions = Vec::new();
    for (claim, x) in found.solutions() {
        solutions.push(LevelSolution {
            mu: to_f64(&claim.value.mid()),
            support: claim.support.clone(),
            x: x.to_vec(),
        });
    }

    Ok((solutions, found.cover.is_plain_list()))
}

/// A measure of lambda^2, 1/s^2: the square of the lowest frequency of the body whose slip
/// particles move without friction, and whose free degrees of freedom follow them as in a static
/// load. `None` without a mass.
pub fn static_frequency2(condensation: &SparseCondensation) -> Option<f64> {
    let at_rest = condensation.at(0.0).ok()?;
    let order = condensation.slip_count();
    let mut mass = Vec::with_capacity(order);
    for column in 0..order {
        let mut unit = vec![0.0; order];
        unit[column] = 1.0;
        mass.push(at_rest.slope(0.0, &unit)?); // A'(0) = E' M E
    }

    let reciprocals = linear::definite_eigenvalues(&mass, &at_rest.a)?;
    let largest = *reciprocals.last()?;
    (largest > 0.0).then(|| largest.recip())
}

/// A matrix of doubles as it is; `None` where an entry is not finite.
fn exact(rows: &[Vec<f64>]) -> Option<Sparse> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, v) in row.iter().enumerate() {
            entries.push((i, j, from_f64(*v).ok()?));
        }
    }

    Some(Sparse::from_entries(rows.len(), rows.len(), entries))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use mceip_model::reduction::reduce;
    use mceip_oracle::{TwoParticles, enumerate};
    use mceip_paper::{Block, BlockModel, two_particles};

    /// Table 1 for (+1, -1): t = q - p twice and t = q - p - 1, so at a level t mu = (t + p) / cs.
    #[test]
    fn levels_of_the_two_particles_in_closed_form() {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(1),
            m: whole(1),
            mu: whole(1),
            signs: (1, -1),
        };

        let system = two_particles(&data).unwrap();
        let condensation = SparseCondensation::of_system(&system).unwrap();

        for t in [0.0, 0.5, 3.0] {
            let level = condensation.at(t).unwrap();
            let (found, is_complete) = level_solutions(&level, &Watch::nobody()).unwrap();

            let mut values: Vec<f64> = found.iter().map(|s| s.mu).collect();
            values.sort_by(f64::total_cmp);
            let first = (t + 1.36) / 0.48;
            let second = (t + 2.36) / 0.48;
            assert!(is_complete);
            assert_eq!(values.len(), 3, "{values:?}");
            for (value, expected) in values.iter().zip([first, first, second]) {
                assert!((value - expected).abs() < 1e-9 * expected, "{values:?}");
            }
        }
    }

    /// Row i of a matrix times v.
    fn row_times(matrix: &Sparse, i: usize, v: &[f64]) -> f64 {
        matrix.row(i).iter().map(|(j, k)| to_f64(k) * v[*j]).sum()
    }

    /// A solution at some (lambda^2, mu) read both ways: at this mu the exact enumerator finds
    /// lambda^2; and the lifted mode has no forces at free nodes.
    #[test]
    fn a_level_of_a_block_and_the_enumerator_at_its_mu() {
        let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
        let states = block.sliding_states(0, 2).unwrap();
        let system = block.system(&states, None).unwrap();
        let condensation = SparseCondensation::of_system(&system).unwrap();
        let lambda2 = static_frequency2(&condensation).unwrap();
        let level = condensation.at(lambda2).unwrap();
        let (found, is_complete) = level_solutions(&level, &Watch::nobody()).unwrap();

        assert!(is_complete && !found.is_empty());
        for solution in &found {
            let mu = from_f64(solution.mu).unwrap();
            let problem = block.problem(&states, Some(mu)).unwrap();
            let pencil = reduce(&problem).unwrap().pencil;
            let at_mu = enumerate(&pencil, problem.window()).unwrap().solutions;
            let is_found = at_mu.iter().any(|s| {
                let value: f64 = s.decimal(17).parse().unwrap();
                (value / lambda2 - 1.0).abs() < 1e-6
            });
            assert!(is_found);

            let v = level.lift(&solution.x);
            let contact_nodes = &block.contact[..2];
            let size = to_f64(&block.stiffness.get(0, 0));
            for i in (0..v.len()).filter(|i| !contact_nodes.contains(&(i / 2))) {
                let elastic = row_times(&block.stiffness, i, &v);
                let inertial = lambda2 * row_times(&block.mass, i, &v);
                assert!((elastic + inertial).abs() < 1e-9 * size);
            }

            for &node in contact_nodes {
                let is_to_the_left = v[2 * node] <= 0.0;
                assert!(
                    v[2 * node + 1] == 0.0 && is_to_the_left,
                    "along the obstacle"
                );
            }
        }
    }
}
