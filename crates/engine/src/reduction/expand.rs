//! The way back from the condensed pencil in doubles: candidates only, exact arithmetic decides
//! later.
#![allow(clippy::float_arithmetic)]

use crate::candidate::Candidate;
use mceip_exact::{Sparse, to_f64};
use mceip_mcp::linear::solve;
use mceip_model::Pencil;

/// From a candidate of the condensed pencil to one of the full pencil: x_f = -A_ff^-1 A_fs x_s.
pub struct Expansion {
    order: usize,
    free: Vec<usize>,
    slip: Vec<usize>,
    /// A_ff^-1 A_fs, column by column.
    columns: Vec<Vec<f64>>,
}

impl Expansion {
    /// Factors A_ff in doubles; `None` if it is numerically singular.
    pub fn new(pencil: &Pencil) -> Option<Expansion> {
        let (free, slip) = (pencil.free().to_vec(), pencil.slip());
        let right = dense(&pencil.a().submatrix(&free, &slip).transpose());
        let columns = solve(&dense(&pencil.a().submatrix(&free, &free)), &right)?;
        Some(Expansion {
            order: pencil.order(),
            free,
            slip,
            columns,
        })
    }

    /// The candidate over all variables of the pencil.
    pub fn expand(&self, small: &Candidate) -> Candidate {
        let mut x = vec![0.0; self.order];
        for ((&i, column), v) in self.slip.iter().zip(&self.columns).zip(&small.x) {
            x[i] = *v;
            self.free
                .iter()
                .zip(column)
                .for_each(|(&k, c)| x[k] -= c * v);
        }
        Candidate {
            value: small.value,
            x,
        }
    }
}

fn dense(m: &Sparse) -> Vec<Vec<f64>> {
    let mut out = vec![vec![0.0; m.cols()]; m.rows()];
    m.entries().for_each(|(i, j, v)| out[i][j] = to_f64(v));
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    #[test]
    fn free_rows_balance_after_expansion() {
        let a = Sparse::from_entries(
            3,
            3,
            [
                (0, 0, 4),
                (0, 1, 1),
                (1, 0, 1),
                (0, 2, -2),
                (2, 0, -2),
                (1, 1, 5),
                (2, 2, 3),
            ]
            .map(|(i, j, v)| (i, j, whole(v))),
        );
        let pencil = Pencil::new(a, Sparse::zeros(3, 3), vec![0]).unwrap();
        let full = Expansion::new(&pencil).unwrap().expand(&Candidate {
            value: 7.0,
            x: vec![1.0, 3.0],
        });
        assert_eq!(
            full,
            Candidate {
                value: 7.0,
                x: vec![1.25, 1.0, 3.0]
            }
        ); // 4 x_0 + 1 - 6 = 0
    }
}
