//! Is the determinant of some support's block zero for every value of the unknown?
//!
//! The blocks of A + tB on the free variables and a support are evaluated at one number t modulo a
//! prime near 2^62. A block that is regular there is regular for all but finitely many t. One that
//! is singular there is taken for singular at every t, which is wrong with a probability of about
//! 2^-58; then `refute` only gives up early.
//!
//! Called by [`refute`](super::refute), because the enumerator has to describe what such supports
//! hold by all their minors.

use mceip_exact::{Field, Integer, Rational, cleared, common_denominator, primes, submatrix};
use mceip_model::Pencil;
use num_traits::{Signed, ToPrimitive};

/// The number t at which the blocks are evaluated, before reduction.
const SAMPLE: u64 = 0x9E37_79B9_7F4A_7C15;

/// Is there a support whose block is singular for every value? The supports of the complementarity
/// variables `slip` are tried one after the other.
pub(super) fn has_singular_support(pencil: &Pencil, slip: &[usize]) -> bool {
    let Some(prime) = primes().next() else {
        return false;
    };

    let field = Field::new(prime);
    let matrix = at_sample(&field, pencil);

    (0..1u64 << slip.len()).any(|support| {
        let mut active = pencil.free().to_vec();
        for (k, &i) in slip.iter().enumerate() {
            if support >> k & 1 == 1 {
                active.push(i);
            }
        }

        is_singular(&field, submatrix(&matrix, &active, &active))
    })
}

/// A + tB at the sample modulo the prime, rows multiplied by their denominators, in Montgomery
/// form.
fn at_sample(field: &Field, pencil: &Pencil) -> Vec<Vec<u64>> {
    let order = pencil.order();
    let t = field.enter(SAMPLE % field.prime());
    let mut matrix = vec![vec![0; order]; order];

    for (i, row) in matrix.iter_mut().enumerate() {
        let a = pencil.a().row(i);
        let b = pencil.b().row(i);
        let factor = common_denominator(a.iter().chain(b).map(|(_, value)| value));

        for (j, value) in a {
            row[*j] = field.add(row[*j], residue(field, value, &factor));
        }

        for (j, value) in b {
            let product = field.mul(t, residue(field, value, &factor));
            row[*j] = field.add(row[*j], product);
        }
    }

    matrix
}

/// The integer `factor * value` modulo the prime, in Montgomery form; `factor` is a multiple of the
/// denominator.
fn residue(field: &Field, value: &Rational, factor: &Integer) -> u64 {
    let integer = cleared(value, factor);
    let remainder = integer.magnitude() % field.prime();
    let magnitude = field.enter(remainder.to_u64().unwrap_or(0)); // below the prime: it fits

    if integer.is_negative() {
        field.sub(0, magnitude)
    } else {
        magnitude
    }
}

/// Does Gaussian elimination run out of pivots?
fn is_singular(field: &Field, mut matrix: Vec<Vec<u64>>) -> bool {
    let order = matrix.len();
    for k in 0..order {
        let Some(pivot) = (k..order).find(|&i| matrix[i][k] != 0) else {
            return true;
        };
        matrix.swap(k, pivot);

        let (upper, lower) = matrix.split_at_mut(k + 1);
        let pivot_row = &upper[k];
        let inverse = field.invert(pivot_row[k]);
        for row in lower {
            let factor = field.mul(row[k], inverse);
            for j in k..order {
                let multiple = field.mul(factor, pivot_row[j]);
                row[j] = field.sub(row[j], multiple);
            }
        }
    }

    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    fn is_singular_somewhere(a: &[&[i64]], b: &[&[i64]], free: Vec<usize>) -> bool {
        let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free).unwrap();
        has_singular_support(&pencil, &pencil.slip())
    }

    /// Rows (1 + t, 2 + 2t) and (3, 6) are multiples of (1, 2); each diagonal entry is regular.
    #[test]
    fn one_block_that_vanishes_is_found() {
        let a: [&[i64]; 2] = [&[1, 2], &[3, 6]];
        let b: [&[i64]; 2] = [&[1, 2], &[0, 0]];
        assert!(is_singular_somewhere(&a, &b, vec![]));

        let regular: [&[i64]; 2] = [&[1, 2], &[3, 5]];
        assert!(!is_singular_somewhere(&regular, &b, vec![]));
    }

    /// The block of variable 1 alone is zero, but together with the free variable 0 it is not.
    #[test]
    fn blocks_contain_the_free_variables() {
        let a: [&[i64]; 2] = [&[1, 1], &[1, 0]];
        let b: [&[i64]; 2] = [&[0, 0], &[0, 0]];

        assert!(is_singular_somewhere(&a, &b, vec![]));
        assert!(!is_singular_somewhere(&a, &b, vec![0]));
    }
}
