//! The way back in doubles: x_f of x_s from the condensed pencil, and v of x from the pencil.
//!
//! The f rows of the pencil say A_ff x_f + A_fs x_s = 0 where the f rows of B vanish (16), so
//!
//!   x_f = -A_ff^-1 A_fs x_s.
//!
//! Input: the full pencil, and candidates of the pencil that `condense` made of it. Output:
//! candidates over all variables; exact arithmetic decides about them later. Called by
//! `multistart`. At a single value, for B of any form, [`with_free_variables`] does the same by
//! sparse factors; called for the x of complete sets.
//!
//! A variable stands for a motion d_j of the body ([`ReducedVariable::column`]), so v = sum_j x_j
//! d_j. It is for pictures and text; [`lift`](super::lift) does the same exactly.
#![allow(clippy::float_arithmetic)]

use crate::candidate::Candidate;
use crate::dense::rounded;
use mceip_exact::to_f64;
use mceip_mcp::linear::{SparseLu, solve};
use mceip_model::{Pencil, ReducedVariable};

/// From a candidate of the condensed pencil to one of the full pencil: x_f = -A_ff^-1 A_fs x_s.
pub struct FreeExpansion {
    order: usize,
    free: Vec<usize>,
    slip: Vec<usize>,
    /// A_ff^-1 A_fs, column by column.
    columns: Vec<Vec<f64>>,
}

impl FreeExpansion {
    /// Factors A_ff in doubles; `None` if it is numerically singular.
    pub fn new(pencil: &Pencil) -> Option<FreeExpansion> {
        let free = pencil.free().to_vec();
        let slip = pencil.slip();
        let a_ff = pencil.a().submatrix(&free, &free);
        let a_fs = pencil.a().submatrix(&free, &slip);

        // The right-hand sides are the columns of A_fs.
        let columns = solve(&rounded(&a_ff), &rounded(&a_fs.transpose()))?;

        Some(FreeExpansion {
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

/// x over all variables of the pencil at a value t, from its slip components; x_f stays 0 where it
/// is not to be had.
pub(crate) fn with_free_variables(pencil: &Pencil, t: f64, x_slip: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; pencil.order()];
    for (&i, x_i) in pencil.slip().iter().zip(x_slip) {
        x[i] = *x_i;
    }

    if let Some(free) = free_variables(pencil, t, &x) {
        for (&i, x_i) in pencil.free().iter().zip(free) {
            x[i] = x_i;
        }
    }

    x
}

/// x_f of x_s at a value t: (A + tB)_ff x_f = -(A + tB)_fs x_s, in doubles. `x` is over all
/// variables; its free ones are not read. `None` where elimination finds no pivot, or a number is
/// not finite.
fn free_variables(pencil: &Pencil, t: f64, x: &[f64]) -> Option<Vec<f64>> {
    let free = pencil.free();
    let mut block = Vec::new();
    let mut right = vec![0.0; free.len()];
    for (row, &i) in free.iter().enumerate() {
        let of_a = pencil.a().row(i).iter().map(|(j, v)| (*j, to_f64(v)));
        let of_b = pencil.b().row(i).iter().map(|(j, v)| (*j, t * to_f64(v)));
        for (j, entry) in of_a.chain(of_b) {
            match free.binary_search(&j) {
                Ok(column) => block.push((row, column, entry)),
                Err(_) => right[row] -= entry * x[j],
            }
        }
    }

    let mut columns = [right];
    SparseLu::new(free.len(), block)?.solve(&mut columns);
    let [solution] = columns;
    solution.iter().all(|v| v.is_finite()).then_some(solution)
}

/// v over `dofs` degrees of freedom of x over the variables of a reduced system: v = x on the free
/// ones, v_T = -S x on slip particles, 0 on all others. // (10)
///
/// A particle in contact with zero reaction moves by its gap and its slips to the right and to the
/// left.
pub fn mode(variables: &[ReducedVariable], x: &[f64], dofs: usize) -> Vec<f64> {
    let mut v = vec![0.0; dofs];
    for (variable, x_j) in variables.iter().zip(x) {
        for (dof, coefficient) in variable.column() {
            v[dof] += to_f64(&coefficient) * x_j;
        }
    }

    v
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, rational};
    use mceip_model::{ZeroPart, ZeroVariables};

    #[test]
    fn free_rows_balance_after_expansion() {
        let a = Sparse::from_ints(&[&[4, 1, -2], &[1, 5, 0], &[-2, 0, 3]]);
        let pencil = Pencil::new(a, Sparse::zeros(3, 3), vec![0]).unwrap();
        let condensed = Candidate {
            value: 7.0,
            x: vec![1.0, 3.0],
        };

        let full = FreeExpansion::new(&pencil).unwrap().expand(&condensed);

        // 4 x_0 + 1 - 2 * 3 = 0.
        let expected = Candidate {
            value: 7.0,
            x: vec![1.25, 1.0, 3.0],
        };

        assert_eq!(full, expected);
    }

    #[test]
    fn each_variable_moves_the_body_along_its_column() {
        // A free dof 0, a particle on (1, 2) with S = -1, one with zero reaction on (3, 4).
        let direction = |dof, numerator| vec![(dof, rational(numerator, 1))];
        let particle = ZeroVariables {
            particle: 1,
            gap: 2,
            right: 3,
            left: 4,
        };
        let zero = |part, column| ReducedVariable::Zero {
            part,
            variables: particle,
            column,
        };
        let variables = [
            ReducedVariable::Free { dof: 0 },
            ReducedVariable::Slip {
                sign: -1,
                tangent: direction(1, 1),
                normal: direction(2, 1),
            },
            zero(ZeroPart::Gap, direction(4, -1)),
            zero(ZeroPart::Right, direction(3, 1)),
            zero(ZeroPart::Left, direction(3, -1)),
        ];

        let v = mode(&variables, &[3.0, 2.0, 5.0, 7.0, 8.0], 6);

        assert_eq!(v, [3.0, 2.0, 0.0, -1.0, -5.0, 0.0]);
    }
}
