//! The curves mu(lambda^2) of a contact state, level by level: for a fixed lambda^2 MCEIP-lambda2 is
//! MCEIP-mu with K + lambda^2 M in the place of K, so a complete search finds every mu of a level.
//!
//! The pencil of a level is condensed in doubles; its complete set is that of the rounded pencil.
//! For pictures, and for starts of what is certified elsewhere.

use super::complete::{CompleteError, Options, complete};
use crate::exact::{Sparse, from_f64, to_f64};
use crate::linear;
use crate::model::{Body, ModelError, Pencil, Problem, System, Unknown, Window};
use crate::reduction::{Reduced, Variable, reduce};
use std::sync::atomic::AtomicBool;

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
    #[error("E16: expected K_ff + lambda^2 M_ff invertible in doubles, got a singular matrix at lambda^2 = {lambda2}")]
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
        let star = |matrix: &Sparse| -> Result<Reduced, ModelError> {
            let only = System::new(matrix.clone(), None, None, system.particles().to_vec())?;
            reduce(&Problem::new(Body::System(only), Unknown::Mu, Window::all())?)
        };
        let stiffness = star(system.stiffness())?;
        let n = stiffness.pencil.order();
        let (m0, m1) = match system.mass() {
            Some(mass) => star(mass).map(|r| (doubles(r.pencil.a()), doubles(r.pencil.b())))?,
            None => (vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]),
        };
        let (k0, k1) = (doubles(stiffness.pencil.a()), doubles(stiffness.pencil.b()));
        let free = stiffness.pencil.free().len();
        Ok(Levels { variables: stiffness.variables, dofs: system.stiffness().rows(), free, blocks: [k0, k1, m0, m1] })
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
        let inside: Vec<Vec<f64>> = (0..f).map(|i| (0..f).map(|j| star0(i, j)).collect()).collect();
        let columns: Vec<Vec<f64>> = (f..n).map(|j| (0..f).map(|i| -star0(i, j)).collect()).collect();
        let follow = if f == 0 { vec![Vec::new(); n] } else { linear::solve(&inside, &columns).ok_or(LevelError::Singular { lambda2 })? };
        let condensed = |star: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
            let row: Vec<Vec<f64>> = (f..n).map(|i| (0..f).map(|k| star(i, k)).collect()).collect();
            let dot = |i: usize, j: usize| row[i - f].iter().zip(&follow[j - f]).map(|(r, w)| r * w).sum::<f64>();
            (f..n).map(|i| (f..n).map(|j| star(i, j) + dot(i, j)).collect()).collect()
        };
        let (a, b) = (condensed(&star0), condensed(&star1));
        Ok(Level { lambda2, a, b, follow })
    }

    /// v over all degrees of freedom of a solution on a level.
    pub fn mode(&self, level: &Level, x: &[f64]) -> Vec<f64> {
        let free = (0..self.free).map(|i| x.iter().zip(&level.follow).map(|(x, w)| x * w[i]).sum::<f64>());
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
            Variable::Slip { sign, tangent, .. } => tangent.iter().for_each(|(dof, c)| v[*dof] -= f64::from(*sign) * to_f64(c) * x),
        }
    }
    v
}

impl Level {
    /// Every solution of the level as rounded, and whether nothing is left open.
    ///
    /// # Errors
    /// [`LevelError`]; entries that are not finite are refused.
    pub fn solutions(&self, stop: &AtomicBool) -> Result<(Vec<LevelSolution>, bool), LevelError> {
        let n = self.a.len();
        let exact = |rows: &[Vec<f64>]| -> Option<Sparse> {
            let entry = |i: usize, j: usize| from_f64(rows[i][j]).ok().map(|v| (i, j, v));
            let entries: Option<Vec<_>> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
            Some(Sparse::from_entries(n, n, entries?))
        };
        let singular = LevelError::Singular { lambda2: self.lambda2 };
        let (Some(a), Some(b)) = (exact(&self.a), exact(&self.b)) else { return Err(singular) };
        // The symmetric part that (16) promises: rounding has broken it.
        let problem = Problem::new(Body::Pencil(Pencil::new(a, b, Vec::new())?), Unknown::Mu, Window::all())?;
        let found = complete(&problem, &Options::default(), stop, &|_| {})?;
        let solution = |(claim, x): (&crate::check::AcceptedClaim, &[f64])| LevelSolution {
            mu: to_f64(&claim.value.mid()),
            support: claim.support.clone(),
            x: x.to_vec(),
        };
        Ok((found.solutions().map(solution).collect(), found.is_complete()))
    }
}

fn doubles(matrix: &Sparse) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.cols()]; matrix.rows()];
    matrix.entries().for_each(|(i, j, v)| rows[i][j] = to_f64(v));
    rows
}
