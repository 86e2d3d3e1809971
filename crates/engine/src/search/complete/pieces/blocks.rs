//! The blocks of a pencil A + tB that the elimination of its free variables needs.
//!
//! With f the free and s the complementarity variables these are F(t) = A_ff + t B_ff, the columns
//! of T_fs(t) = A_fs + t B_fs and those of T_sf(t)'. They are the two sides of the equations
//!
//! ```text
//!     F W = T_fs,        F'V = T_sf'.
//! ```
//!
//! The symmetric part of F is definite; F itself need not be symmetric. All in doubles.

use super::skyline::{Skyline, TOGETHER, dot, side_by_side};
use mceip_exact::{Sparse, to_f64};
use mceip_mcp::linear::SparseLu;
use mceip_model::Pencil;
use std::sync::Arc;

/// Steps of inverse iteration for the lowest frequency.
const FREQUENCY_STEPS: usize = 20;

/// A sparse matrix by rows: column and value of each entry.
#[derive(Clone)]
pub(crate) struct SparseRows(Arc<Vec<Vec<(usize, f64)>>>);

impl SparseRows {
    fn of(matrix: &Sparse) -> SparseRows {
        let mut rows = Vec::with_capacity(matrix.rows());
        for i in 0..matrix.rows() {
            rows.push(matrix.row(i).iter().map(|(j, v)| (*j, to_f64(v))).collect());
        }

        SparseRows(Arc::new(rows))
    }

    /// Row, column and value of each entry.
    fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let rows = self.0.iter().enumerate();
        rows.flat_map(|(i, row)| row.iter().map(move |(j, v)| (i, *j, *v)))
    }

    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        self.0
            .iter()
            .map(|row| row.iter().map(|(j, v)| v * x[*j]).sum())
            .collect()
    }

    /// The products with columns, [`TOGETHER`] in one pass over the matrix, which is larger than
    /// the cache.
    pub(crate) fn times_all(&self, columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut products = Vec::with_capacity(columns.len());
        for group in columns.chunks(TOGETHER) {
            let x = side_by_side(group, group[0].len());
            let mut of_group = vec![Vec::with_capacity(self.0.len()); group.len()];
            for row in self.0.iter() {
                let mut sums = [0.0; TOGETHER];
                for (j, v) in row {
                    for k in 0..TOGETHER {
                        sums[k] += v * x[*j][k];
                    }
                }
                for (product, sum) in of_group.iter_mut().zip(sums) {
                    product.push(sum);
                }
            }
            products.extend(of_group);
        }

        products
    }
}

/// A block C + tD by columns: one column over the free variables per complementarity variable.
pub(crate) struct LinearColumns {
    /// C.
    pub(crate) constant: Vec<Vec<f64>>,
    /// D.
    pub(crate) slope: Vec<Vec<f64>>,
}

impl LinearColumns {
    /// Column j of C + tD.
    pub(crate) fn at(&self, j: usize, t: f64) -> Vec<f64> {
        self.constant[j]
            .iter()
            .zip(&self.slope[j])
            .map(|(c, d)| c + t * d)
            .collect()
    }

    pub(crate) fn is_constant(&self) -> bool {
        for column in &self.slope {
            if column.iter().any(|v| *v != 0.0) {
                return false;
            }
        }

        true
    }
}

/// The equations F W = T_fs, or F'V = T_sf'.
pub(crate) struct FreeEquations {
    /// A_ff and B_ff, or their transposes.
    pub(crate) stiffness: SparseRows,
    pub(crate) mass: SparseRows,
    /// T_fs, or T_sf'.
    pub(crate) given: LinearColumns,
    /// F', not F.
    pub(crate) is_transposed: bool,
}

/// A factor of F at a value.
pub(crate) enum FreeFactor {
    /// L of L L', where F is symmetric.
    Cholesky(Skyline),
    Lu(Box<SparseLu>),
}

impl FreeFactor {
    /// Replaces right-hand sides by solutions with F, or with F'.
    pub(crate) fn solve_all(&self, columns: &mut [Vec<f64>], is_transposed: bool) {
        match self {
            FreeFactor::Cholesky(factor) => factor.solve_all(columns),
            FreeFactor::Lu(factor) if is_transposed => factor.solve_transposed(columns),
            FreeFactor::Lu(factor) => factor.solve(columns),
        }
    }
}

/// The blocks of a pencil.
pub(crate) struct PencilBlocks {
    /// Free variables, then complementarity variables.
    pub(crate) free: Vec<usize>,
    pub(crate) slip: Vec<usize>,
    /// The symmetric parts of A_ff and B_ff.
    pub(crate) stiffness: Skyline,
    pub(crate) mass: Skyline,
    pub(crate) mass_is_zero: bool,
    /// Are A_ff and B_ff symmetric?
    is_symmetric: bool,
    /// F W = T_fs and F'V = T_sf'.
    pub(crate) right: FreeEquations,
    pub(crate) left: FreeEquations,
}

impl PencilBlocks {
    pub(crate) fn of(pencil: &Pencil) -> PencilBlocks {
        let free = pencil.free().to_vec();
        let slip = pencil.slip();
        let a_ff = pencil.a().submatrix(&free, &free);
        let b_ff = pencil.b().submatrix(&free, &free);

        let is_symmetric = [&a_ff, &b_ff].map(Sparse::first_asymmetry) == [None, None];

        let right = FreeEquations {
            stiffness: SparseRows::of(&a_ff),
            mass: SparseRows::of(&b_ff),
            given: LinearColumns {
                constant: columns(&pencil.a().submatrix(&free, &slip)),
                slope: columns(&pencil.b().submatrix(&free, &slip)),
            },
            is_transposed: false,
        };

        let transposed = |own: &SparseRows, matrix: &Sparse| {
            if is_symmetric {
                own.clone()
            } else {
                SparseRows::of(&matrix.transpose())
            }
        };
        let left = FreeEquations {
            stiffness: transposed(&right.stiffness, &a_ff),
            mass: transposed(&right.mass, &b_ff),
            given: LinearColumns {
                constant: columns(&pencil.a().submatrix(&slip, &free).transpose()),
                slope: columns(&pencil.b().submatrix(&slip, &free).transpose()),
            },
            is_transposed: true,
        };

        PencilBlocks {
            free,
            slip,
            stiffness: Skyline::symmetric(&a_ff),
            mass: Skyline::symmetric(&b_ff),
            mass_is_zero: b_ff.entries().next().is_none(),
            is_symmetric,
            right,
            left,
        }
    }

    /// A factor of F at a value; `None` where its symmetric part is not definite in doubles.
    pub(crate) fn factor_at(&self, value: f64) -> Option<FreeFactor> {
        let of_symmetric_part = self.stiffness.combine(value, &self.mass).cholesky()?;
        if self.is_symmetric {
            return Some(FreeFactor::Cholesky(of_symmetric_part));
        }

        let constant = self.right.stiffness.entries();
        let slope = self.right.mass.entries();
        let slope = slope.map(|(i, j, v)| (i, j, value * v));
        let factor = SparseLu::new(self.free.len(), constant.chain(slope))?;
        Some(FreeFactor::Lu(Box::new(factor)))
    }

    /// Is T linear in t, because neither F nor the free rows depend on it?
    pub(crate) fn is_linear(&self) -> bool {
        self.mass_is_zero && self.right.given.is_constant()
    }

    /// Smallest absolute value of an eigenvalue of (A_ff, B_ff), estimated by inverse iteration.
    /// `stiffness_factor` is that of A_ff.
    pub(crate) fn lowest_frequency(&self, stiffness_factor: &FreeFactor) -> f64 {
        match stiffness_factor {
            FreeFactor::Cholesky(factor) => self.lowest_by_energy(factor),
            FreeFactor::Lu(factor) => self.lowest_by_growth(factor),
        }
    }

    /// Eigenvalues may be complex: the iteration turns in a plane, and its growth over many steps
    /// tells their absolute value.
    fn lowest_by_growth(&self, stiffness_factor: &SparseLu) -> f64 {
        let order = self.free.len();
        let mut v = vec![1.0; order];
        let mut growth = 0.0;

        for step in 0..2 * FREQUENCY_STEPS {
            let mut columns = [self.right.mass.times(&v)];
            stiffness_factor.solve(&mut columns);
            let [w] = columns;

            let norm = dot(&w, &w).sqrt();
            if !(norm > 0.0 && norm.is_finite()) {
                return 1.0;
            }

            if step >= FREQUENCY_STEPS {
                growth += norm.ln();
            }
            v = w.into_iter().map(|x| x / norm).collect();
        }

        (-growth / FREQUENCY_STEPS as f64).exp()
    }

    /// The eigenvalues are real: the energies of a vector estimate the lowest from above.
    fn lowest_by_energy(&self, stiffness_factor: &Skyline) -> f64 {
        let mut v = vec![1.0; self.free.len()];
        let mut estimate = 1.0;

        for _ in 0..FREQUENCY_STEPS {
            let mass_v = self.right.mass.times(&v);
            let energy = dot(&v, &mass_v);
            let mut w = mass_v;
            stiffness_factor.solve(&mut w);

            let mass_w = self.right.mass.times(&w);
            let next = dot(&v, &mass_w);
            if !(energy > 0.0 && next > 0.0) {
                return 1.0;
            }

            estimate = energy / next;
            let norm = dot(&w, &mass_w).sqrt();
            v = w.into_iter().map(|x| x / norm).collect();
        }

        estimate
    }
}

/// The dense columns of a sparse matrix.
pub(crate) fn columns(matrix: &Sparse) -> Vec<Vec<f64>> {
    let mut columns = vec![vec![0.0; matrix.rows()]; matrix.cols()];
    for (i, j, v) in matrix.entries() {
        columns[j][i] = to_f64(v);
    }

    columns
}
