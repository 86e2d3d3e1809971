//! Proposition 2 on the condensed matrix: MCEIP-lambda2 as an MCP in the n_s slip variables and t,
//! each t by one sparse factorisation, without a matrix of all degrees of freedom.
//!
//! Unknowns (u, zeta): x = D u with a positive diagonal D, t = unit zeta. Rows: D T(t) D u
//! complementary to u, with T(t) = A(t) + mu B(t) of [`SparseCondensation`], and e'u - 1
//! complementary to zeta (31)-(34). f has been eliminated: K + t M is definite on f for every t >=
//! 0.
#![allow(clippy::float_arithmetic)]

use super::condense_sparse::{SparseCondensation, SparseCondensationError, SparseCondensed};
use mceip_mcp::mcp::Mcp;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cell::{Cell, RefCell};

/// The MCP of Proposition 2, condensed.
#[derive(Debug)]
pub struct CondensedEmbedding<'a> {
    condensation: &'a SparseCondensation,
    mu: f64,
    diagonal: Vec<f64>,
    unit: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The condensation at the t asked for last: a path stays there for several evaluations.
    last: RefCell<Option<SparseCondensed<'a>>>,
    factorisations: Cell<usize>,
}

/// Why MCEIP-lambda2 is not embedded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CondensedEmbeddingError {
    /// The system has no mass.
    #[error("E12: expected a mass matrix for unknown lambda2, got none")]
    NoMass,
    /// A friction that is negative, infinite or NaN.
    #[error("E15: expected a finite friction mu >= 0, got {got}")]
    Friction {
        /// mu.
        got: f64,
    },
    /// The stiffness is not definite.
    #[error(transparent)]
    Condensation(#[from] SparseCondensationError),
}

impl<'a> CondensedEmbedding<'a> {
    /// Embeds MCEIP-lambda2 at this friction.
    ///
    /// # Errors
    /// [`CondensedEmbeddingError`].
    pub fn new(
        condensation: &'a SparseCondensation,
        mu: f64,
    ) -> Result<CondensedEmbedding<'a>, CondensedEmbeddingError> {
        if !(mu >= 0.0 && mu.is_finite()) {
            return Err(CondensedEmbeddingError::Friction { got: mu });
        }
        let at_zero = condensation.at(0.0)?;
        let n = condensation.slip_count();
        // The block moved as one: its frequency squared is the scale of lambda^2.
        let even = vec![1.0; n];
        let mass = at_zero
            .kinetic(&even)
            .ok_or(CondensedEmbeddingError::NoMass)?;
        let ratio = at_zero.a.iter().flatten().sum::<f64>() / mass;
        let unit = if ratio > 0.0 && ratio.is_finite() {
            ratio.log2().round().exp2()
        } else {
            1.0
        };
        let diagonal = (0..n).map(|i| power_of_two(at_zero.a[i][i])).collect();
        let (last, factorisations) = (RefCell::new(Some(at_zero)), Cell::new(1));
        let (lower, upper) = (vec![0.0; n + 1], vec![f64::INFINITY; n + 1]);
        Ok(CondensedEmbedding {
            condensation,
            mu,
            diagonal,
            unit,
            lower,
            upper,
            last,
            factorisations,
        })
    }

    /// lambda^2 of a point, and x of its slip particles with e'x = 1.
    pub fn value_and_x(&self, z: &[f64]) -> (f64, Vec<f64>) {
        let n = self.diagonal.len();
        let x: Vec<f64> = z[..n]
            .iter()
            .zip(&self.diagonal)
            .map(|(u, d)| u * d)
            .collect();
        let sum: f64 = x.iter().sum();
        (self.unit * z[n], x.iter().map(|v| v / sum).collect())
    }

    /// Starts with e'u = 1: even and single particles at values spread over six decades about the
    /// unit, then seeded ones.
    pub fn starts(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let n = self.diagonal.len();
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let even = |zeta: f64| [vec![1.0 / n as f64; n], vec![zeta]].concat();
        let mut starts: Vec<Vec<f64>> = [1.0, 32.0, 0.0].map(even).to_vec();
        while starts.len() < count {
            let keep: f64 = rng.random_range(0.2..1.0);
            let mut weight = || {
                let (w, kept): (f64, f64) = (
                    rng.random_range(f64::MIN_POSITIVE..1.0),
                    rng.random_range(0.0..1.0),
                );
                if kept < keep { -w.ln() } else { 0.0 }
            };
            let u: Vec<f64> = (0..n).map(|_| weight()).collect();
            let (sum, zeta) = (
                u.iter().sum::<f64>(),
                10f64.powf(rng.random_range(-3.0..3.0)),
            );
            starts.push(if sum > 0.0 {
                u.iter().map(|v| v / sum).chain([zeta]).collect()
            } else {
                even(zeta)
            });
        }
        starts.truncate(count);
        starts
    }

    /// Sparse factorisations made.
    pub fn factorisations(&self) -> usize {
        self.factorisations.get()
    }

    /// Something of the condensation at t = unit zeta; `None` where K + t M is not definite.
    pub fn with<T>(&self, zeta: f64, work: impl FnOnce(&SparseCondensed<'a>) -> T) -> Option<T> {
        let t = self.unit * zeta;
        if let Some(last) = self.last.borrow().as_ref().filter(|l| l.t == t) {
            return Some(work(last));
        }
        let fresh = self.condensation.at(t).ok()?;
        self.factorisations.set(self.factorisations.get() + 1);
        let result = work(&fresh);
        *self.last.borrow_mut() = Some(fresh);
        Some(result)
    }
}

/// 1 / sqrt of a positive number, as a power of two.
fn power_of_two(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() {
        (-0.5 * size.log2()).round().exp2()
    } else {
        1.0
    }
}

impl Mcp for CondensedEmbedding<'_> {
    fn dimension(&self) -> usize {
        self.diagonal.len() + 1
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        let n = self.diagonal.len();
        let x: Vec<f64> = z[..n]
            .iter()
            .zip(&self.diagonal)
            .map(|(u, d)| u * d)
            .collect();
        let row = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .zip(&x)
                .map(|((a, b), x)| (a + self.mu * b) * x)
                .sum::<f64>()
        };
        let y = self.with(z[n], |c| {
            c.a.iter()
                .zip(&c.b)
                .map(|(a, b)| row(a, b))
                .collect::<Vec<f64>>()
        }); // E31
        match y {
            Some(y) => f
                .iter_mut()
                .zip(y)
                .zip(&self.diagonal)
                .for_each(|((f, y), d)| *f = d * y),
            None => f[..n].fill(f64::NAN), // the solver says where F is not finite
        }
        f[n] = z[..n].iter().sum::<f64>() - 1.0; // E33
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.diagonal.len();
        j.fill(0.0);
        let x: Vec<f64> = z[..n]
            .iter()
            .zip(&self.diagonal)
            .map(|(u, d)| u * d)
            .collect();
        let parts = self.with(z[n], |c| (c.pencil(self.mu), c.slope(self.mu, &x)));
        let Some((t, Some(slope))) = parts else {
            j.fill(f64::NAN);
            return;
        };
        for p in 0..n {
            (0..n).for_each(|q| j[(p, q)] = self.diagonal[p] * t[p][q] * self.diagonal[q]);
            j[(p, n)] = self.diagonal[p] * slope[p] * self.unit;
            j[(n, p)] = 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_mcp::linear::Symmetric;
    use mceip_model::ContactState;
    use mceip_paper::{BlockModel, DoubleBlock, DoubleMatrix};

    fn condensation(with_mass: bool) -> SparseCondensation {
        let block = DoubleBlock::new(&BlockModel::of_the_paper().with_cells(6, 3)).unwrap();
        let of = |m: &DoubleMatrix| Symmetric::new(m.order, m.entries.iter().copied()).unwrap();
        let states = [
            ContactState::Stick,
            ContactState::Slip { sign: 1 },
            ContactState::Slip { sign: -1 },
            ContactState::Slip { sign: 1 },
        ];
        let mass = with_mass.then(|| of(&block.mass));
        SparseCondensation::new(
            of(&block.stiffness),
            mass,
            &block.particles(&states),
            Some(&block.points),
        )
        .unwrap()
    }

    /// Central differences: the slope by two half solves is the derivative of the condensed matrix.
    #[test]
    fn the_jacobian_is_the_derivative() {
        let condensation = condensation(true);
        let embedding = CondensedEmbedding::new(&condensation, 1.5).unwrap();
        let z = [0.2, 0.5, 0.3, 0.7];
        let mut j = DMatrix::zeros(4, 4);
        embedding.jacobian(&z, &mut j);
        let h = 1.0 / 4096.0;
        for k in 0..4 {
            let at = |s: f64| {
                let mut moved = z;
                moved[k] += s * h;
                let mut f = [0.0; 4];
                embedding.function(&moved, &mut f);
                f
            };
            let (up, down) = (at(1.0), at(-1.0));
            (0..4).for_each(|i| {
                approx::assert_relative_eq!(
                    (up[i] - down[i]) / (2.0 * h),
                    j[(i, k)],
                    epsilon = 1e-6,
                    max_relative = 1e-6
                )
            });
        }
        let before = embedding.factorisations();
        embedding.function(&z, &mut [0.0; 4]);
        embedding.jacobian(&z, &mut j);
        assert_eq!(embedding.factorisations(), before + 1, "one for both");
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let light = condensation(false);
        assert_eq!(
            CondensedEmbedding::new(&light, 1.0).unwrap_err(),
            CondensedEmbeddingError::NoMass
        );
        let condensation = condensation(true);
        for got in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                CondensedEmbedding::new(&condensation, got),
                Err(CondensedEmbeddingError::Friction { .. })
            ));
        }
        let starts = CondensedEmbedding::new(&condensation, 1.0)
            .unwrap()
            .starts(9, 4);
        assert!(
            starts.len() == 9
                && starts
                    .iter()
                    .all(|z| (z[..3].iter().sum::<f64>() - 1.0).abs() < 1e-12)
        );
    }

    #[test]
    fn the_mcp_has_the_bounds_and_the_row_of_the_proposition() {
        let condensation = condensation(true);
        let mut e = CondensedEmbedding::new(&condensation, 1.5).unwrap();
        e.diagonal = vec![0.5, 1.0, 4.0]; // those of the block are all alike
        assert_eq!(
            (e.dimension(), e.lower(), e.upper()),
            (4, &[0.0; 4][..], &[f64::INFINITY; 4][..])
        );
        let mut f = [0.0; 4];
        e.function(&[0.25, 0.5, 0.75, 0.125], &mut f);
        assert_eq!(f[3], 0.5);
        // y = D T(t) D u at the t and x that the point stands for.
        let z = [0.2, 0.5, 0.3, 0.7];
        e.function(&z, &mut f);
        let (value, x) = e.value_and_x(&z);
        approx::assert_relative_eq!(x.iter().sum::<f64>(), 1.0, max_relative = 1e-12);
        let t = condensation.at(value).unwrap().pencil(1.5);
        let scale: f64 = z.iter().zip(&e.diagonal).map(|(u, d)| u * d).sum();
        for i in 0..3 {
            let y: f64 = t[i].iter().zip(&x).map(|(t, x)| t * x).sum();
            approx::assert_relative_eq!(f[i], e.diagonal[i] * y * scale, max_relative = 1e-9);
            approx::assert_relative_eq!(x[i] * scale, z[i] * e.diagonal[i], max_relative = 1e-12);
        }
    }

    #[test]
    fn scales_are_powers_of_two() {
        assert_eq!(
            [4.0, 16.0, 0.25, 8.0, 5.0].map(power_of_two),
            [0.5, 0.25, 2.0, 0.25, 0.5]
        );
        assert_eq!(
            [0.0, -4.0, f64::INFINITY, f64::NAN].map(power_of_two),
            [1.0; 4]
        );
    }

    /// A particle is kept with probability 0.2 to 1: three fifths of them, all where none was.
    #[test]
    fn starts_lie_on_random_faces() {
        let condensation = condensation(true);
        let e = CondensedEmbedding::new(&condensation, 1.0).unwrap();
        let starts = e.starts(403, 8);
        assert_eq!([starts[0][3], starts[1][3], starts[2][3]], [1.0, 32.0, 0.0]);
        for z in &starts {
            approx::assert_relative_eq!(z[..3].iter().sum::<f64>(), 1.0, max_relative = 1e-12);
            assert!(z.iter().all(|u| *u >= 0.0));
        }
        let moving = starts[3..]
            .iter()
            .flat_map(|z| &z[..3])
            .filter(|u| **u > 0.0)
            .count();
        let even = starts[3..]
            .iter()
            .filter(|z| z[0] == z[1] && z[1] == z[2])
            .count();
        // None kept: the mean of (1 - keep)^3, 0.128.
        assert!(
            (700..950).contains(&moving) && (25..85).contains(&even),
            "{moving} of 1200, {even} of 400"
        );
        assert_eq!((e.starts(2, 8).len(), e.starts(403, 8)), (2, starts));
    }
}
