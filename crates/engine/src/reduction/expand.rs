//! The way back from the condensed pencil in doubles: x_f of x_s.
//!
//! The f rows of the pencil say A_ff x_f + A_fs x_s = 0 where the f rows of B vanish (16), so
//!
//!   x_f = -A_ff^-1 A_fs x_s.
//!
//! Input: the full pencil, and candidates of the pencil that `condense` made of it. Output:
//! candidates over all variables; exact arithmetic decides about them later. Called by
//! `multistart`.
#![allow(clippy::float_arithmetic)]

use crate::candidate::Candidate;
use crate::dense::rounded;
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
        let free = pencil.free().to_vec();
        let slip = pencil.slip();
        let a_ff = pencil.a().submatrix(&free, &free);
        let a_fs = pencil.a().submatrix(&free, &slip);

        // The right-hand sides are the columns of A_fs.
        let columns = solve(&rounded(&a_ff), &rounded(&a_fs.transpose()))?;

        Some(Expansion {
            order: pencil.order(),
            free,
            slip,
            columns,
        })
    }

    /// The candidate over all variables of the pencil.
    pub fn expand(&self, condensed: &Candidate) -> Candidate {
        let mut x = vec![0.0; self.order];
        for (s, x_s) in condensed.x.iter().enumerate() {
            x[self.slip[s]] = *x_s;
            for (&f, coefficient) in self.free.iter().zip(&self.columns[s]) {
                x[f] -= coefficient * x_s;
            }
        }

        Candidate {
            value: condensed.value,
            x,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    #[test]
    fn free_rows_balance_after_expansion() {
        let a = Sparse::from_ints(&[&[4, 1, -2], &[1, 5, 0], &[-2, 0, 3]]);
        let pencil = Pencil::new(a, Sparse::zeros(3, 3), vec![0]).unwrap();
        let condensed = Candidate {
            value: 7.0,
            x: vec![1.0, 3.0],
        };

        let full = Expansion::new(&pencil).unwrap().expand(&condensed);

        // 4 x_0 + 1 - 2 * 3 = 0.
        let expected = Candidate {
            value: 7.0,
            x: vec![1.25, 1.0, 3.0],
        };

        assert_eq!(full, expected);
    }
}
