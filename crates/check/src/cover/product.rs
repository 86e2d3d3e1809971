//! Products of a sparse matrix and a dense one, exactly: in machine integers where all sums fit.

use super::family::Matrix;
use crate::pencil::Row;
use mceip_exact::Integer;
use num_traits::{ToPrimitive, Zero};
use std::ops::{AddAssign, Mul};

/// Sums of products below this many bits are formed in machine integers.
const SHORT_BITS: u64 = 127;

/// Rows of a matrix linear in t or d: column, constant, coefficient.
pub(super) type Linear = Vec<Row>;

/// One of the two coefficients of a matrix linear in d.
#[derive(Clone, Copy)]
pub(super) enum Part {
    /// At d = 0.
    Constant,
    /// Of d.
    Linear,
}

/// The product of one part of F and W, exactly; in machine integers where the sums fit into 128
/// bits. `None` where the part is zero.
pub(super) fn times(f: &Linear, part: Part, w: &Matrix, cols: usize) -> Option<Matrix> {
    let pick = |(g, c, l): &'_ (usize, Integer, Integer)| {
        (
            *g,
            if matches!(part, Part::Constant) {
                c.clone()
            } else {
                l.clone()
            },
        )
    };
    let f: Vec<Vec<(usize, Integer)>> = f
        .iter()
        .map(|row| row.iter().map(pick).filter(|(_, v)| !v.is_zero()).collect())
        .collect();
    let terms = f.iter().map(Vec::len).max().filter(|most| *most > 0)?;
    let bits =
        |values: &mut dyn Iterator<Item = &Integer>| values.map(Integer::bits).max().unwrap_or(0);
    let [f_bits, w_bits] = [
        bits(&mut f.iter().flatten().map(|(_, v)| v)),
        bits(&mut w.iter().flatten()),
    ];
    if f_bits + w_bits + u64::from(usize::BITS - terms.leading_zeros()) >= SHORT_BITS {
        return Some(
            f.iter()
                .map(|row| sums(row.iter().map(|(g, c)| (&w[*g], c.clone())), cols))
                .collect(),
        );
    }
    // Nothing is longer than a sum, so that all of it fits.
    let short = |v: &Integer| v.to_i128().unwrap_or_default();
    let w: Vec<Vec<i128>> = w
        .iter()
        .map(|row| row.iter().map(short).collect())
        .collect();
    let row = |row: &Vec<(usize, Integer)>| {
        sums(row.iter().map(|(g, c)| (&w[*g], short(c))), cols)
            .into_iter()
            .map(Integer::from)
            .collect()
    };
    Some(f.iter().map(row).collect())
}

/// sum of rows times factors.
fn sums<'a, T: 'a + Clone + Zero + AddAssign>(
    terms: impl Iterator<Item = (&'a Vec<T>, T)>,
    cols: usize,
) -> Vec<T>
where
    for<'b> &'b T: Mul<&'b T, Output = T>,
{
    let mut sum = vec![T::zero(); cols];
    for (row, factor) in terms {
        sum.iter_mut().zip(row).for_each(|(s, v)| *s += &factor * v);
    }
    sum
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
