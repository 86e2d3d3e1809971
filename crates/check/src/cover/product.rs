//! The product of a sparse matrix linear in d and a dense one, exactly.
//!
//! The sums are formed in machine integers where all of them fit into 128 bits, for speed, and in
//! long integers else; the result is the same. Called by `condensed`.

use super::ends::{Matrix, largest_bits};
use crate::pencil::Row;
use mceip_exact::Integer;
use num_traits::{ToPrimitive, Zero};
use std::ops::{AddAssign, Mul};

/// Sums of products below this many bits are formed in machine integers.
const SHORT_BITS: u64 = 127;

/// Rows of a matrix linear in t or d: column, constant, coefficient.
pub(super) type Linear = Vec<Row>;

/// Rows of a sparse matrix: column, entry.
type Sparse<T> = Vec<Vec<(usize, T)>>;

/// One of the two coefficients of a matrix linear in d.
#[derive(Clone, Copy)]
pub(super) enum Part {
    /// At d = 0.
    Constant,
    /// Of d.
    Linear,
}

/// The product of one part of F and W, which has `cols` columns. `None` where the part is zero.
pub(super) fn times(f: &Linear, part: Part, w: &Matrix, cols: usize) -> Option<Matrix> {
    let f = nonzero(f, part);
    let terms = f.iter().map(Vec::len).max().filter(|most| *most > 0)?;

    let bits_of_f = largest_bits(f.iter().flatten().map(|(_, v)| v));
    let bits_of_w = largest_bits(w.iter().flatten());
    let bits_of_terms = u64::from(usize::BITS - terms.leading_zeros());
    if bits_of_f + bits_of_w + bits_of_terms >= SHORT_BITS {
        return Some(product(&f, w, cols));
    }

    // No entry is longer than a sum, so that all of them fit.
    let f: Sparse<i128> = f
        .iter()
        .map(|row| row.iter().map(|(g, c)| (*g, short(c))).collect())
        .collect();
    let w: Vec<Vec<i128>> = w
        .iter()
        .map(|row| row.iter().map(short).collect())
        .collect();
    let sums = product(&f, &w, cols);
    Some(
        sums.into_iter()
            .map(|row| row.into_iter().map(Integer::from).collect())
            .collect(),
    )
}

/// The entries of one part that are not zero.
fn nonzero(f: &Linear, part: Part) -> Sparse<Integer> {
    let mut rows = Vec::with_capacity(f.len());
    for row in f {
        let mut entries = Vec::with_capacity(row.len());
        for (column, constant, linear) in row {
            let entry = match part {
                Part::Constant => constant,
                Part::Linear => linear,
            };
            if !entry.is_zero() {
                entries.push((*column, entry.clone()));
            }
        }

        rows.push(entries);
    }

    rows
}

fn short(v: &Integer) -> i128 {
    v.to_i128().unwrap_or_default()
}

/// F W: each row is a sum of rows of W times entries of F.
fn product<T: Clone + Zero + AddAssign>(f: &Sparse<T>, w: &[Vec<T>], cols: usize) -> Vec<Vec<T>>
where
    for<'b> &'b T: Mul<&'b T, Output = T>,
{
    let mut product = Vec::with_capacity(f.len());
    for entries in f {
        let mut sum = vec![T::zero(); cols];
        for (g, factor) in entries {
            for (s, v) in sum.iter_mut().zip(&w[*g]) {
                *s += factor * v;
            }
        }

        product.push(sum);
    }

    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;

    /// (2^a - 1) (2^b - 1) summed over three terms has a + b + 2 bits: both sides of the limit.
    #[test]
    fn short_and_long_products_agree_at_the_limit() {
        let ones = |bits: u32| -> Integer { (Integer::one() << bits) - 1 };
        for (f_bits, w_bits) in [
            (3, 4),
            (60, 63),
            (60, 64),
            (62, 62),
            (63, 62),
            (64, 64),
            (124, 1),
            (125, 1),
            (1, 124),
            (200, 3),
        ] {
            let (a, b) = (ones(f_bits), ones(w_bits));
            let f: Linear = vec![
                vec![
                    (0, a.clone(), -&a),
                    (1, a.clone(), a.clone()),
                    (2, a.clone(), Integer::zero()),
                ],
                vec![],
                vec![(1, -&a, Integer::zero())],
            ];
            let w: Matrix = vec![
                vec![b.clone(), -&b],
                vec![b.clone(), -&b],
                vec![b.clone(), b.clone()],
            ];
            let p = &a * &b;
            assert_eq!(
                times(&f, Part::Constant, &w, 2),
                Some(vec![
                    vec![&p * 3, -&p],
                    vec![Integer::zero(); 2],
                    vec![-&p, p.clone()]
                ])
            );
            assert_eq!(
                times(&f, Part::Linear, &w, 2),
                Some(vec![vec![Integer::zero(); 2]; 3])
            );
            assert_eq!(times(&f[1..].to_vec(), Part::Linear, &w, 2), None);
        }
    }

    /// Forty products of 125 bits have a sum of 131.
    #[test]
    fn the_number_of_terms_counts() {
        let (a, b): (Integer, Integer) =
            ((Integer::one() << 62u32) - 1, (Integer::one() << 63u32) - 1);
        let f: Linear = vec![(0..40).map(|g| (g, a.clone(), Integer::zero())).collect()];
        assert_eq!(
            times(&f, Part::Constant, &vec![vec![b.clone()]; 40], 1),
            Some(vec![vec![a * b * 40]])
        );
    }
}
