//! The curves mu(lambda^2) of a contact state, level by level: for a fixed lambda^2 MCEIP-lambda2
//! is MCEIP-mu with K + lambda^2 M in the place of K, so a complete search finds every mu of a
//! level.
//!
//! The pencil of a level is condensed in doubles; its complete set is that of the rounded pencil.
//! For pictures, and for starts of what is certified elsewhere.

use super::complete::{CompleteError, Options, complete};
use crate::reduction::{Variable, mu_family};
use crate::run::Watch;
use mceip_exact::{Sparse, from_f64, to_f64};
use mceip_mcp::linear;
use mceip_model::{Body, ModelError, Pencil, Problem, System, Unknown, Window};

/// Why there are no levels.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LevelError {
    /// The system was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The search refuses.
    #[error(transparent)]
    Complete(#[from] CompleteError),
    /// K_ff + lambda^2 M_ff cannot be eliminated in doubles.
    #[error(
        "E16: expected K_ff + lambda^2 M_ff invertible in doubles, got a singular matrix at \
         lambda^2 = {lambda2}"
    )]
    Singular {
        /// The level.
        lambda2: f64,
    },
}

/// A system in doubles, by the blocks of (16).
#[derive(Debug, Clone)]
pub struct Levels {
    variables: Vec<Variable>,
    dofs: usize,
    free: usize,
    /// K0, K1, M0, M1 over f, then s.
    blocks: [Vec<Vec<f64>>; 4],
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
    /// [`LevelError::Model`] if the system has no stiffness that (16) could take.
    pub fn new(system: &System) -> Result<Levels, LevelError> {
        let family = mu_family(system)?;
        let n = family.stiffness.order();
        let both = |p: &Pencil| (doubles(p.a()), doubles(p.b()));
        let (k0, k1) = both(&family.stiffness);
        let (m0, m1) = family
            .mass
            .as_ref()
            .map_or_else(|| (vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]), both);
        let free = family.stiffness.free().len();
        Ok(Levels {
            variables: family.variables,
            dofs: system.stiffness().rows(),
            free,
            blocks: [k0, k1, m0, m1],
        })
    }

    /// The square of the lowest natural frequency of K0, M0 (the slip nodes free to move along the
    /// obstacle without friction), 1/s^2: the measure of lambda^2. `None` without a mass.
    pub fn lowest_frequency2(&self) -> Option<f64> {
        let [k0, _, m0, _] = &self.blocks;
        let largest = *linear::definite_eigenvalues(m0, k0)?.last()?;
        (largest > 0.0).then(|| largest.recip())
    }

    /// The level lambda^2 >= 0.
    ///
    /// # Errors
    /// [`LevelError::Singular`].
    pub fn at(&self, lambda2: f64) -> Result<Level, LevelError> {
        let (f, n) = (self.free, self.blocks[0].len());
        let [k0, k1, m0, m1] = &self.blocks;
        let star0 = |i: usize, j: usize| k0[i][j] + lambda2 * m0[i][j];
        let star1 = |i: usize, j: usize| k1[i][j] + lambda2 * m1[i][j];
        let inside: Vec<Vec<f64>> = (0..f)
            .map(|i| (0..f).map(|j| star0(i, j)).collect())
            .collect();
        let columns: Vec<Vec<f64>> = (f..n)
            .map(|j| (0..f).map(|i| -star0(i, j)).collect())
            .collect();
        let follow = if f == 0 {
            vec![Vec::new(); n]
        } else {
            linear::solve(&inside, &columns).ok_or(LevelError::Singular { lambda2 })?
        };
        let condensed = |star: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
            let row: Vec<Vec<f64>> = (f..n)
                .map(|i| (0..f).map(|k| star(i, k)).collect())
                .collect();
            let dot = |i: usize, j: usize| {
                row[i - f]
                    .iter()
                    .zip(&follow[j - f])
                    .map(|(r, w)| r * w)
                    .sum::<f64>()
            };
            (f..n)
                .map(|i| (f..n).map(|j| star(i, j) + dot(i, j)).collect())
                .collect()
        };
        let (a, b) = (condensed(&star0), condensed(&star1));
        Ok(Level {
            lambda2,
            a,
            b,
            follow,
        })
    }

    /// v over all degrees of freedom of a solution on a level.
    pub fn mode(&self, level: &Level, x: &[f64]) -> Vec<f64> {
        let free = (0..self.free).map(|i| {
            x.iter()
                .zip(&level.follow)
                .map(|(x, w)| x * w[i])
                .sum::<f64>()
        });
        let all: Vec<f64> = free.chain(x.iter().copied()).collect();
        mode(&self.variables, &all, self.dofs)
    }
}

/// v over `dofs` degrees of freedom of x over the variables of a reduced system: stuck ones and the
/// normal ones of slip particles are zero, v_T = -S x. // E10
pub fn mode(variables: &[Variable], x: &[f64], dofs: usize) -> Vec<f64> {
    let mut v = vec![0.0; dofs];
    for (variable, x) in variables.iter().zip(x) {
        match variable {
            Variable::Free { dof } => v[*dof] += x,
            Variable::Slip { sign, tangent, .. } => tangent
                .iter()
                .for_each(|(dof, c)| v[*dof] -= f64::from(*sign) * to_f64(c) * x),
        }
    }
    v
}

impl Level {
    /// Every solution of the level as rounded, and whether nothing is left open.
    ///
    /// # Errors
    /// [`LevelError`]; entries that are not finite are refused.
    pub fn solutions(&self, watch: &Watch<'_>) -> Result<(Vec<LevelSolution>, bool), LevelError> {
        let n = self.a.len();
        let exact = |rows: &[Vec<f64>]| -> Option<Sparse> {
            let entry = |i: usize, j: usize| from_f64(rows[i][j]).ok().map(|v| (i, j, v));
            let entries: Option<Vec<_>> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
            Some(Sparse::from_entries(n, n, entries?))
        };
        let singular = LevelError::Singular {
            lambda2: self.lambda2,
        };
        let (Some(a), Some(b)) = (exact(&self.a), exact(&self.b)) else {
            return Err(singular);
        };
        let problem = Problem::new(
            Body::Pencil(Pencil::new(a, b, Vec::new())?),
            Unknown::Mu,
            Window::all(),
        )?;
        let found = complete(&problem, &Options::default(), watch)?;
        let solution = |(claim, x): (&mceip_check::AcceptedClaim, &[f64])| LevelSolution {
            mu: to_f64(&claim.value.mid()),
            support: claim.support.clone(),
            x: x.to_vec(),
        };
        Ok((
            found.solutions().map(solution).collect(),
            found.cover.is_plain_list(),
        ))
    }
}

fn doubles(matrix: &Sparse) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.cols()]; matrix.rows()];
    matrix
        .entries()
        .for_each(|(i, j, v)| rows[i][j] = to_f64(v));
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reduction::reduce;
    use mceip_exact::{rational, whole};
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
            let (found, complete) = levels.at(t).unwrap().solutions(&Watch::nobody()).unwrap();
            let mut values: Vec<f64> = found.iter().map(|s| s.mu).collect();
            values.sort_by(f64::total_cmp);
            let first = (t + 1.36) / 0.48;
            let expected = [first, first, (t + 2.36) / 0.48];
            assert!(complete && values.len() == 3, "{values:?}");
            assert!(
                values
                    .iter()
                    .zip(expected)
                    .all(|(v, e)| (v - e).abs() < 1e-9 * e),
                "{values:?}"
            );
        }
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
        let (found, complete) = level.solutions(&Watch::nobody()).unwrap();
        assert!(complete && !found.is_empty());
        for s in &found {
            let problem = block
                .problem(&states, Some(from_f64(s.mu).unwrap()))
                .unwrap();
            let at_mu = enumerate(&reduce(&problem).unwrap().pencil, problem.window())
                .unwrap()
                .solutions;
            let near = |v: &mceip_oracle::Solution| {
                (v.decimal(17).parse::<f64>().unwrap() / lambda2 - 1.0).abs() < 1e-6
            };
            assert!(at_mu.iter().any(near));
            let v = levels.mode(&level, &s.x);
            let force =
                |m: &Sparse, i: usize| m.row(i).iter().map(|(j, k)| to_f64(k) * v[*j]).sum::<f64>();
            let size = to_f64(&block.stiffness.get(0, 0));
            let held = |i: &usize| block.contact[..2].contains(&(i / 2));
            for i in (0..v.len()).filter(|i| !held(i)) {
                assert!(
                    (force(&block.stiffness, i) + lambda2 * force(&block.mass, i)).abs()
                        < 1e-9 * size
                );
            }
            assert!(
                block.contact[..2]
                    .iter()
                    .all(|&k| v[2 * k + 1] == 0.0 && v[2 * k] <= 0.0),
                "to the left along the obstacle"
            );
        }
    }
}
