//! Proposition 2 on the condensed matrix: MCEIP-lambda2 as an MCP in the n_s slip variables and t,
//! each t by one sparse factorisation, without a matrix of all degrees of freedom.
//!
//! Unknowns (u, zeta): x = D u with a positive diagonal D, and t = unit zeta. Rows, with the
//! complementary unknowns:
//!
//!   D T(t) D u  complementary to u >= 0,   e'u - 1  complementary to zeta >= 0   (31)-(34)
//!
//! with T(t) = A(t) + mu B(t) of [`SparseCondensation`]. The free variables have been eliminated: K
//! + t M is definite on f for every t >= 0.
//!
//! Input: a condensation with mass and the friction mu. Output: an [`Mcp`] for the solver, its
//! starting points, and t and x of its points. Called by `multistart::condensed`.
#![allow(clippy::float_arithmetic)]

use super::CondensationError;
use super::condense_sparse::{SparseCondensation, SparseCondensed};
use super::embed::{even_weights, power_of_two, random_face, random_zeta};
use mceip_mcp::mcp::Mcp;
use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::cell::{Cell, RefCell};

/// The MCP of Proposition 2, condensed.
#[derive(Debug)]
pub struct CondensedEmbedding<'a> {
    condensation: &'a SparseCondensation,
    mu: f64,
    /// The diagonal of D, powers of two.
    diagonal: Vec<f64>,
    /// t at zeta = 1.
    unit: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The condensation at the t asked for last: a path stays there for several evaluations.
    last: RefCell<Option<SparseCondensed<'a>>>,
    factorisations: Cell<usize>,
}

impl<'a> CondensedEmbedding<'a> {
    /// Embeds MCEIP-lambda2 at this friction.
    ///
    /// # Errors
    /// [`CondensationError`].
    pub fn new(
        condensation: &'a SparseCondensation,
        mu: f64,
    ) -> Result<CondensedEmbedding<'a>, CondensationError> {
        if !(mu >= 0.0 && mu.is_finite()) {
            return Err(CondensationError::Friction { got: mu });
        }

        let at_zero = condensation.at(0.0)?;
        let n = condensation.slip_count();

        // All slip particles moved by one: the frequency squared of this motion is the unit of
        // lambda^2.
        let mass = at_zero
            .kinetic(&vec![1.0; n])
            .ok_or(CondensationError::NoMass)?;
        let stiffness: f64 = at_zero.a.iter().flatten().sum();
        let frequency_squared = stiffness / mass;
        let unit = if frequency_squared > 0.0 && frequency_squared.is_finite() {
            frequency_squared.log2().round().exp2()
        } else {
            1.0
        };

        Ok(CondensedEmbedding {
            condensation,
            mu,
            diagonal: (0..n).map(|i| power_of_two(at_zero.a[i][i])).collect(),
            unit,
            lower: vec![0.0; n + 1],
            upper: vec![f64::INFINITY; n + 1],
            last: RefCell::new(Some(at_zero)),
            factorisations: Cell::new(1),
        })
    }

    /// lambda^2 of a point, and x of its slip particles with e'x = 1.
    pub fn value_and_x(&self, z: &[f64]) -> (f64, Vec<f64>) {
        let value = self.unit * z[self.diagonal.len()];
        let mut x = self.unscaled(z);
        let sum: f64 = x.iter().sum();
        for x_i in &mut x {
            *x_i /= sum;
        }

        (value, x)
    }

    /// D u of a point (u, zeta).
    fn unscaled(&self, z: &[f64]) -> Vec<f64> {
        let u_and_d = z.iter().zip(&self.diagonal);
        let x = u_and_d.map(|(u, d)| u * d);
        x.collect()
    }

    /// `count` starts with e'u = 1: even ones at one unit, 32 units and zero, then seeded random
    /// faces of the simplex at values spread over six decades about the unit.
    pub fn starts(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let n = self.diagonal.len();
        let mut starts = Vec::with_capacity(count.max(3));
        for zeta in [1.0, 32.0, 0.0] {
            starts.push(joined(even_weights(n), zeta));
        }

        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        while starts.len() < count {
            let u = random_face(n, &mut rng);
            let zeta = random_zeta(&mut rng);
            starts.push(joined(u, zeta));
        }

        starts.truncate(count);
        starts
    }

    /// Sparse factorisations made.
    pub fn factorisations(&self) -> usize {
        self.factorisations.get()
    }

    /// The result of `work` on the condensation at t = unit zeta; `None` where K + t M is not
    /// definite. The condensation is kept until another t is asked for.
    pub fn with<T>(&self, zeta: f64, work: impl FnOnce(&SparseCondensed<'a>) -> T) -> Option<T> {
        let t = self.unit * zeta;
        if let Some(last) = self.last.borrow().as_ref()
            && last.t == t
        {
            return Some(work(last));
        }

        let fresh = self.condensation.at(t).ok()?;
        self.factorisations.set(self.factorisations.get() + 1);
        let result = work(&fresh);
        *self.last.borrow_mut() = Some(fresh);
        Some(result)
    }

    /// T x = (A + mu B) x on the condensation at one t.
    fn image(&self, condensed: &SparseCondensed<'_>, x: &[f64]) -> Vec<f64> {
        let mut image = Vec::with_capacity(x.len());
        for (a_row, b_row) in condensed.a.iter().zip(&condensed.b) {
            let entries = a_row.iter().zip(b_row);
            let entries = entries.map(|(a, b)| a + self.mu * b);
            let products = entries.zip(x).map(|(t, x_q)| t * x_q);
            image.push(products.sum());
        }
        image
    }
}

/// The point (u, zeta).
fn joined(mut u: Vec<f64>, zeta: f64) -> Vec<f64> {
    u.push(zeta);
    u
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
        let u = &z[..n];
        let x = self.unscaled(u);

        match self.with(z[n], |condensed| self.image(condensed, &x)) {
            Some(image) => {
                for p in 0..n {
                    f[p] = self.diagonal[p] * image[p]; // (31)
                }
            }
            // The solver reports that F is not finite.
            None => f[..n].fill(f64::NAN),
        }

        f[n] = u.iter().sum::<f64>() - 1.0; // (33)
    }

    /// Columns 0 to n - 1: D T D, and ones in the last row. Column n: dt/dzeta D T'(t) D u.
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.diagonal.len();
        let x = self.unscaled(&z[..n]);
        let matrix_and_slope = self.with(z[n], |condensed| {
            (condensed.pencil(self.mu), condensed.slope(self.mu, &x))
        });
        let Some((t, Some(slope))) = matrix_and_slope else {
            j.fill(f64::NAN);
            return;
        };

        j.fill(0.0);
        for p in 0..n {
            for q in 0..n {
                j[(p, q)] = self.diagonal[p] * t[p][q] * self.diagonal[q];
            }
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

    /// A coarse block with one stick particle and three slip particles.
    fn condensation(with_mass: bool) -> SparseCondensation {
        let block = DoubleBlock::new(&BlockModel::of_the_paper().with_cells(6, 3)).unwrap();
        let states = [
            ContactState::Stick,
            ContactState::Slip { sign: 1 },
            ContactState::Slip { sign: -1 },
            ContactState::Slip { sign: 1 },
        ];
        let mass = with_mass.then(|| symmetric(&block.mass));
        SparseCondensation::new(
            symmetric(&block.stiffness),
            mass,
            &block.particles(&states),
            Some(&block.points),
        )
        .unwrap()
    }

    fn symmetric(matrix: &DoubleMatrix) -> Symmetric {
        Symmetric::new(matrix.order, matrix.entries.iter().copied()).unwrap()
    }

    fn function_at(embedding: &CondensedEmbedding<'_>, z: &[f64]) -> [f64; 4] {
        let mut f = [0.0; 4];
        embedding.function(z, &mut f);
        f
    }

    /// Central differences: the slope by two half solves is the derivative of the condensed matrix.
    #[test]
    fn the_jacobian_is_the_derivative() {
        let condensation = condensation(true);
        let embedding = CondensedEmbedding::new(&condensation, 1.5).unwrap();
        let z = [0.2, 0.5, 0.3, 0.7];
        let step = 1.0 / 4096.0;

        let mut jacobian = DMatrix::zeros(4, 4);
        embedding.jacobian(&z, &mut jacobian);

        for column in 0..4 {
            let mut above = z;
            above[column] += step;
            let mut below = z;
            below[column] -= step;
            let up = function_at(&embedding, &above);
            let down = function_at(&embedding, &below);
            for row in 0..4 {
                approx::assert_relative_eq!(
                    (up[row] - down[row]) / (2.0 * step),
                    jacobian[(row, column)],
                    epsilon = 1e-6,
                    max_relative = 1e-6
                );
            }
        }

        let before = embedding.factorisations();
        function_at(&embedding, &z);
        embedding.jacobian(&z, &mut jacobian);
        assert_eq!(embedding.factorisations(), before + 1, "one for both");
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let massless = condensation(false);
        assert_eq!(
            CondensedEmbedding::new(&massless, 1.0).unwrap_err(),
            CondensationError::NoMass
        );

        let condensation = condensation(true);
        for mu in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                CondensedEmbedding::new(&condensation, mu),
                Err(CondensationError::Friction { .. })
            ));
        }

        let embedding = CondensedEmbedding::new(&condensation, 1.0).unwrap();
        let starts = embedding.starts(9, 4);
        assert_eq!(starts.len(), 9);
        for z in starts {
            let sum: f64 = z[..3].iter().sum();
            assert!((sum - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_mcp_has_the_bounds_and_the_row_of_the_proposition() {
        let condensation = condensation(true);
        let mut embedding = CondensedEmbedding::new(&condensation, 1.5).unwrap();
        // The scales of the block are all alike.
        embedding.diagonal = vec![0.5, 1.0, 4.0];

        assert_eq!(embedding.dimension(), 4);
        assert_eq!(embedding.lower(), [0.0; 4]);
        assert_eq!(embedding.upper(), [f64::INFINITY; 4]);
        assert_eq!(function_at(&embedding, &[0.25, 0.5, 0.75, 0.125])[3], 0.5);

        // y = D T(t) D u at the t and x that the point stands for.
        let z = [0.2, 0.5, 0.3, 0.7];
        let f = function_at(&embedding, &z);
        let (value, x) = embedding.value_and_x(&z);
        approx::assert_relative_eq!(x.iter().sum::<f64>(), 1.0, max_relative = 1e-12);

        let t = condensation.at(value).unwrap().pencil(1.5);
        let du: Vec<f64> = (0..3).map(|i| z[i] * embedding.diagonal[i]).collect();
        let scale: f64 = du.iter().sum();
        for i in 0..3 {
            let y_i: f64 = t[i].iter().zip(&x).map(|(t, x)| t * x).sum();
            let expected = embedding.diagonal[i] * y_i * scale;
            approx::assert_relative_eq!(f[i], expected, max_relative = 1e-9);
            approx::assert_relative_eq!(x[i] * scale, du[i], max_relative = 1e-12);
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

    /// A particle is kept with probability 0.2 to 1: three fifths of them, all where none was. None
    /// is kept with the mean probability of (1 - keep)^3, 0.128.
    #[test]
    fn starts_lie_on_random_faces() {
        let condensation = condensation(true);
        let embedding = CondensedEmbedding::new(&condensation, 1.0).unwrap();

        let starts = embedding.starts(403, 8);

        assert_eq!([starts[0][3], starts[1][3], starts[2][3]], [1.0, 32.0, 0.0]);
        for z in &starts {
            approx::assert_relative_eq!(z[..3].iter().sum::<f64>(), 1.0, max_relative = 1e-12);
            assert!(z.iter().all(|u| *u >= 0.0));
        }

        let random = &starts[3..];
        let weights = random.iter().flat_map(|z| &z[..3]);
        let moving = weights.filter(|u| **u > 0.0).count();
        assert!((700..950).contains(&moving), "{moving} of 1200");
        let is_even = |z: &&Vec<f64>| z[0] == z[1] && z[1] == z[2];
        let even = random.iter().filter(is_even).count();
        assert!((25..85).contains(&even), "{even} of 400");

        assert_eq!(embedding.starts(2, 8).len(), 2);
        assert_eq!(embedding.starts(403, 8), starts);
    }
}
