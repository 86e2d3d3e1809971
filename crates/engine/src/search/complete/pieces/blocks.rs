//! The blocks of a pencil A + tB that the elimination of its free variables needs: those of
//! F = A_ff + t B_ff, and the columns of A_fs, B_fs, A_sf' and B_sf'.

use crate::search::complete::pieces::skyline::{Skyline, dot};
use mceip_exact::{Sparse, to_f64};
use mceip_model::Pencil;

/// The blocks of the pencil that the elimination needs, sparse columns in doubles.
pub(crate) struct Blocks {
    pub(crate) free: Vec<usize>,
    pub(crate) slip: Vec<usize>,
    /// A_ff and B_ff.
    pub(crate) stiffness: Skyline,
    pub(crate) mass: Skyline,
    pub(crate) mass_is_zero: bool,
    /// Rows of A_ff and B_ff.
    pub(crate) ff: [Vec<Vec<(usize, f64)>>; 2],
    /// First asymmetric row of A_ff and B_ff.
    pub(crate) asymmetry: [Option<usize>; 2],
    /// A_fs, B_fs; A_sf', B_sf': columns by complementarity variable.
    pub(crate) fs: [Vec<Vec<f64>>; 2],
    pub(crate) sf: [Vec<Vec<f64>>; 2],
}

impl Blocks {
    pub(crate) fn of(pencil: &Pencil) -> Blocks {
        let (free, slip) = (pencil.free().to_vec(), pencil.slip());
        let ff = [pencil.a(), pencil.b()].map(|m| m.submatrix(&free, &free));
        let columns = |m: Sparse| {
            let mut out = vec![vec![0.0; m.rows()]; m.cols()];
            m.entries().for_each(|(i, j, v)| out[j][i] = to_f64(v));
            out
        };
        let fs = [pencil.a(), pencil.b()].map(|m| columns(m.submatrix(&free, &slip)));
        let sf = [pencil.a(), pencil.b()].map(|m| columns(m.submatrix(&slip, &free).transpose()));
        let (stiffness, mass) = (Skyline::symmetric(&ff[0]), Skyline::symmetric(&ff[1]));
        let mass_is_zero = ff[1].entries().next().is_none();
        let asymmetry = [0, 1].map(|k| ff[k].first_asymmetry().map(|(i, _)| i));
        let ff = ff.map(|m| {
            (0..m.rows())
                .map(|i| m.row(i).iter().map(|(j, v)| (*j, to_f64(v))).collect())
                .collect()
        });
        Blocks {
            free,
            slip,
            stiffness,
            mass,
            mass_is_zero,
            ff,
            asymmetry,
            fs,
            sf,
        }
    }

    /// The Cholesky factor of F at a value; `None` where F is not definite in doubles.
    pub(crate) fn factor_at(&self, value: f64) -> Option<Skyline> {
        self.stiffness.combine(value, &self.mass, 0.0).cholesky()
    }
}

/// Smallest eigenvalue of (A_ff, B_ff), estimated by inverse iteration on the pencil.
pub(crate) fn lowest_frequency(blocks: &Blocks, stiffness: &Skyline) -> f64 {
    let n = blocks.free.len();
    let mut v = vec![1.0; n];
    let mut estimate = 1.0;
    for _ in 0..20 {
        let mut w = times(&blocks.ff[1], &v);
        let energy = dot(&v, &w);
        stiffness.solve(&mut w);
        let back = times(&blocks.ff[1], &w);
        let next = dot(&v, &back);
        if !(energy > 0.0 && next > 0.0) {
            return 1.0;
        }
        estimate = energy / next;
        let norm = dot(&w, &back).sqrt();
        v = w.into_iter().map(|x| x / norm).collect();
    }
    estimate
}

pub(crate) fn times(m: &[Vec<(usize, f64)>], x: &[f64]) -> Vec<f64> {
    m.iter()
        .map(|row| row.iter().map(|(j, v)| v * x[*j]).sum())
        .collect()
}
