//! The blocks of a pencil A + tB that the elimination of its free variables needs.
//!
//! With f the free and s the complementarity variables these are F(t) = A_ff + t B_ff, the columns
//! of T_fs(t) = A_fs + t B_fs and those of T_sf(t)'. All in doubles.

use super::skyline::{Skyline, TOGETHER, dot, side_by_side};
use mceip_exact::{Sparse, to_f64};
use mceip_model::Pencil;

/// Steps of inverse iteration for the lowest frequency.
const FREQUENCY_STEPS: usize = 20;

/// A sparse matrix by rows: column and value of each entry.
pub(crate) struct SparseRows(Vec<Vec<(usize, f64)>>);

impl SparseRows {
    fn of(matrix: &Sparse) -> SparseRows {
        let mut rows = Vec::with_capacity(matrix.rows());
        for i in 0..matrix.rows() {
            rows.push(matrix.row(i).iter().map(|(j, v)| (*j, to_f64(v))).collect());
        }

        SparseRows(rows)
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
            for row in &self.0 {
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

/// The blocks of a pencil.
pub(crate) struct PencilBlocks {
    /// Free variables, then complementarity variables.
    pub(crate) free: Vec<usize>,
    pub(crate) slip: Vec<usize>,
    /// The symmetric parts of A_ff and B_ff.
    pub(crate) stiffness: Skyline,
    pub(crate) mass: Skyline,
    pub(crate) mass_is_zero: bool,
    /// A_ff and B_ff.
    pub(crate) stiffness_rows: SparseRows,
    pub(crate) mass_rows: SparseRows,
    /// First row of A_ff and of B_ff that differs from its column.
    pub(crate) stiffness_asymmetry: Option<usize>,
    pub(crate) mass_asymmetry: Option<usize>,
    /// T_fs and T_sf'.
    pub(crate) fs: LinearColumns,
    pub(crate) sf: LinearColumns,
}

impl PencilBlocks {
    pub(crate) fn of(pencil: &Pencil) -> PencilBlocks {
        let free = pencil.free().to_vec();
        let slip = pencil.slip();
        let a_ff = pencil.a().submatrix(&free, &free);
        let b_ff = pencil.b().submatrix(&free, &free);

        let fs = LinearColumns {
            constant: columns(&pencil.a().submatrix(&free, &slip)),
            slope: columns(&pencil.b().submatrix(&free, &slip)),
        };

        let sf = LinearColumns {
            constant: columns(&pencil.a().submatrix(&slip, &free).transpose()),
            slope: columns(&pencil.b().submatrix(&slip, &free).transpose()),
        };

        PencilBlocks {
            free,
            slip,
            stiffness: Skyline::symmetric(&a_ff),
            mass: Skyline::symmetric(&b_ff),
            mass_is_zero: b_ff.entries().next().is_none(),
            stiffness_rows: SparseRows::of(&a_ff),
            mass_rows: SparseRows::of(&b_ff),
            stiffness_asymmetry: a_ff.first_asymmetry().map(|(i, _)| i),
            mass_asymmetry: b_ff.first_asymmetry().map(|(i, _)| i),
            fs,
            sf,
        }
    }

    /// The Cholesky factor of F at a value; `None` where F is not definite in doubles.
    pub(crate) fn factor_at(&self, value: f64) -> Option<Skyline> {
        self.stiffness.combine(value, &self.mass).cholesky()
    }

    /// Is T linear in t, because neither F nor the free rows depend on it?
    pub(crate) fn is_linear(&self) -> bool {
        self.mass_is_zero && self.fs.is_constant()
    }

    /// Smallest eigenvalue of (A_ff, B_ff), estimated by inverse iteration on the pencil.
    /// `stiffness_factor` is the Cholesky factor of A_ff.
    pub(crate) fn lowest_frequency(&self, stiffness_factor: &Skyline) -> f64 {
        let mut v = vec![1.0; self.free.len()];
        let mut estimate = 1.0;

        for _ in 0..FREQUENCY_STEPS {
            let mass_v = self.mass_rows.times(&v);
            let energy = dot(&v, &mass_v);
            let mut w = mass_v;
            stiffness_factor.solve(&mut w);

            let mass_w = self.mass_rows.times(&w);
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
