//! The curves mu(lambda^2) of a contact state, level by level.
//!
//! For a fixed lambda^2 MCEIP-lambda2 is MCEIP-mu with K* = K + lambda^2 M in the place of K, so a
//! complete search finds every mu of a level. With the blocks of (16), the free variables
//! eliminated:
//!
//! ```text
//!     A = K0*_ss - K0*_sf (K0*_ff)^-1 K0*_fs,    B = K1*_ss - K1*_sf (K0*_ff)^-1 K0*_fs.
//! ```
//!
//! The pencil of a level is condensed in doubles; its complete set is that of the rounded pencil.
//! For pictures, and for starts of what is certified elsewhere. Called by `mceip block`.

use super::complete::pieces::matrix::combined;
use super::complete::{CompleteError, Options, complete};
use crate::dense::rounded;
use crate::reduction::mode;
use crate::run::Watch;
use mceip_exact::{Sparse, from_f64, to_f64};
use mceip_mcp::linear;
use mceip_model::reduction::mu_family;
use mceip_model::{Body, Pencil, Problem, System, Unknown, Variable, Window};

/// A system in doubles, by the blocks of (16).
#[derive(Debug, Clone)]
pub struct Levels {
    variables: Vec<Variable>,
    dofs: usize,
    free: usize,
    /// The blocks over f, then s.
    k0: Vec<Vec<f64>>,
    k1: Vec<Vec<f64>>,
    m0: Vec<Vec<f64>>,
    m1: Vec<Vec<f64>>,
}

/// A level: the condensed pencil A + mu B, and how free variables follow the slip variables.
#[derive(Debug, Clone)]
pub struct Level {
    /// lambda^2, 1/s^2 for a system in t, mm, s.
    pub lambda2: f64,
    a: Vec<Vec<f64>>,
    b: Vec<Vec<f64>>,
    /// -F^-1 C by columns: x_f for each slip variable.
    follow: Vec<Vec<f64>>,
}

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

impl Levels {
    /// Takes a system with or without mass (then only lambda^2 = 0 makes sense).
    ///
    /// # Errors
    /// [`CompleteError::Model`] if the system has no stiffness that (16) could take.
    pub fn new(system: &System) -> Result<Levels, CompleteError> {
        system.require_no_zero()?;
        let family = mu_family(system)?;
        let n = family.stiffness.order();
        let massless = vec![vec![0.0; n]; n];
        let mass = family.mass.as_ref();
        Ok(Levels {
            free: family.stiffness.free().len(),
            dofs: system.stiffness().rows(),
            k0: rounded(family.stiffness.a()),
            k1: rounded(family.stiffness.b()),
            m0: mass.map_or_else(|| massless.clone(), |m| rounded(m.a())),
            m1: mass.map_or_else(|| massless.clone(), |m| rounded(m.b())),
            variables: family.variables,
        })
    }

    /// The square of the lowest natural frequency of K0, M0 (the slip nodes free to move along the
    /// obstacle without friction), 1/s^2: the measure of lambda^2. `None` without a mass.
    pub fn lowest_frequency2(&self) -> Option<f64> {
        let reciprocals = linear::definite_eigenvalues(&self.m0, &self.k0)?;
        let largest = *reciprocals.last()?;
        if largest > 0.0 {
            Some(largest.recip())
        } else {
            None
        }
    }

    /// The level lambda^2 >= 0.
    ///
    /// # Errors
    /// [`CompleteError::SingularLevel`].
    pub fn at(&self, lambda2: f64) -> Result<Level, CompleteError> {
        let n = self.k0.len();
        let star0 = combined(&self.k0, lambda2, &self.m0);
        let star1 = combined(&self.k1, lambda2, &self.m1);
        let follow = if self.free == 0 {
            vec![Vec::new(); n]
        } else {
            follow(&star0, self.free).ok_or(CompleteError::SingularLevel { lambda2 })?
        };

        Ok(Level {
            lambda2,
            a: condensed(&star0, &follow, self.free),
            b: condensed(&star1, &follow, self.free),
            follow,
        })
    }

    /// v over all degrees of freedom of a solution on a level.
    pub fn mode(&self, level: &Level, x: &[f64]) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.free + x.len());
        for i in 0..self.free {
            let following = x.iter().zip(&level.follow).map(|(x, w)| x * w[i]);
            all.push(following.sum::<f64>());
        }

        all.extend_from_slice(x);
        mode(&self.variables, &all, self.dofs)
    }
}

/// -F^-1 C by columns, F and C being the free rows over the first `free` and the other columns;
/// `None` where F is singular in doubles.
fn follow(star: &[Vec<f64>], free: usize) -> Option<Vec<Vec<f64>>> {
    let free_rows = &star[..free];
    let mut free_block = Vec::with_capacity(free);
    for row in free_rows {
        free_block.push(row[..free].to_vec());
    }

    let mut columns: Vec<Vec<f64>> = Vec::new();
    for j in free..star.len() {
        columns.push(free_rows.iter().map(|row| -row[j]).collect());
    }

    linear::solve(&free_block, &columns)
}

/// The slip rows with the free variables in terms of the slip variables.
fn condensed(star: &[Vec<f64>], follow: &[Vec<f64>], free: usize) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for row in &star[free..] {
        let mut condensed = row[free..].to_vec();
        for (entry, following) in condensed.iter_mut().zip(follow) {
            let by_free = row[..free].iter().zip(following).map(|(r, w)| r * w);
            *entry += by_free.sum::<f64>();
        }

        rows.push(condensed);
    }

    rows
}

impl Level {
    /// Every solution of the level as rounded, and whether nothing is left open.
    ///
    /// # Errors
    /// [`CompleteError`]; entries that are not finite are refused.
    pub fn solutions(
        &self,
        watch: &Watch<'_>,
    ) -> Result<(Vec<LevelSolution>, bool), CompleteError> {
        let pencil = self.pencil()?;
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?;
        let found = complete(&problem, &Options::default(), watch)?;

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

    /// The condensed pencil as rounded.
    fn pencil(&self) -> Result<Pencil, CompleteError> {
        let singular = CompleteError::SingularLevel {
            lambda2: self.lambda2,
        };

        let Some(a) = exact(&self.a) else {
            return Err(singular);
        };

        let Some(b) = exact(&self.b) else {
            return Err(singular);
        };

        Ok(Pencil::new(a, b, Vec::new())?)
    }
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

        let levels = Levels::new(&two_particles(&data).unwrap()).unwrap();

        for t in [0.0, 0.5, 3.0] {
            let level = levels.at(t).unwrap();
            let (found, is_complete) = level.solutions(&Watch::nobody()).unwrap();

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
        let levels = Levels::new(&block.system(&states, None).unwrap()).unwrap();
        let lambda2 = levels.lowest_frequency2().unwrap();
        let level = levels.at(lambda2).unwrap();
        let (found, is_complete) = level.solutions(&Watch::nobody()).unwrap();

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

            let v = levels.mode(&level, &solution.x);
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
