//! A null vector of the pencil on a given moving set, to any number of bits.
//!
//! Signs that doubles cannot tell are read off it. Newton's method with exact residuals
//! ([`newton`](super::enclose::newton)) solves (A + tB) x = 0 on the free variables and the moving
//! set, e'x = 1 on the moving set, from a candidate in doubles. Nothing is proved: the digits that
//! are computed are those of a solution only where the method has converged.
//!
//! Called by the search for complete sets, to decide which null vectors are worth a proof.

use super::enclose::newton::Newton;
use super::rows::IntegralRows;
use crate::candidate::Candidate;
use mceip_exact::Rational;
use mceip_model::Pencil;

/// Bits of the grid on which a candidate in doubles is polished first.
const FIRST_BITS: u32 = 64;

/// A null vector of A + tB on the free variables and a moving set, and the rows off them times it.
pub(crate) struct PreciseNull {
    /// t.
    pub(crate) value: Rational,
    /// x of the moving set, by variable; their sum is 1. Their signs may be any.
    pub(crate) x: Vec<(usize, Rational)>,
    /// Rows of (A + tB) x, each times a positive number, of the other complementarity variables.
    pub(crate) y: Vec<(usize, Rational)>,
}

/// Newton's method with exact residuals from a candidate, on a grid with `bits` bits for the
/// largest component of x and for t. `None` where the Jacobian is singular in doubles or the
/// candidate has no sum on the moving set.
pub(crate) fn precise_null(
    pencil: &Pencil,
    moving: &[usize],
    candidate: &Candidate,
    bits: u32,
) -> Option<PreciseNull> {
    let rows = IntegralRows::of(pencil);
    let newton = Newton::new(pencil, &rows, moving);
    let mut point = newton.start(candidate, FIRST_BITS).ok()?;
    let first_inverse = newton.inverse(&point).ok()?;
    newton.polish(&mut point, &first_inverse);

    // At the polished point the inverse is better, and good for all further bits.
    let inverse = newton.inverse(&point).ok()?;
    point.refine(bits.saturating_sub(FIRST_BITS));
    newton.polish(&mut point, &inverse);

    let mut x = Vec::new();
    for (k, &index) in newton.active.iter().enumerate() {
        if moving.contains(&index) {
            x.push((index, point.value(k)));
        }
    }

    let mut y = Vec::new();
    for index in newton.inactive() {
        let row = newton.y(index, &point);
        y.push((index, Rational::from_integer(row)));
    }

    Some(PreciseNull {
        value: point.value(newton.active.len()),
        x,
        y,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, parse, whole};
    use num_traits::{One, Signed};

    /// [[-2, 1e-30], [1e-30, 3]] + t I: on {0, 1} the small eigenvector component is about -1e-30 /
    /// 5, at rest y_1 = 1e-30.
    #[test]
    fn signs_beyond_doubles_are_right() {
        let small = parse("1e-30").unwrap();
        let entries = [
            (0, 0, whole(-2)),
            (0, 1, small.clone()),
            (1, 0, small.clone()),
            (1, 1, whole(3)),
        ];
        let a = Sparse::from_entries(2, 2, entries);
        let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        let candidate = Candidate {
            value: 2.0,
            x: vec![1.0, 0.0],
        };

        let both = precise_null(&pencil, &[0, 1], &candidate, 256).unwrap();
        let (index, x) = &both.x[1];
        let expected = -&small / whole(5);
        let relative_error = (x / expected - Rational::one()).abs();
        assert_eq!(*index, 1);
        assert!(x.is_negative(), "{x}");
        assert!(relative_error < parse("1e-20").unwrap(), "{x}");
        assert!((&both.value - whole(2)).abs() < parse("1e-59").unwrap());

        let alone = precise_null(&pencil, &[0], &candidate, 256).unwrap();
        assert_eq!((alone.x.len(), alone.y.len()), (1, 1));
        let (index, y) = &alone.y[0];
        assert_eq!(*index, 1);
        assert!(y.is_positive(), "{y}");
        assert_eq!(alone.value, whole(2));
    }

    #[test]
    fn a_candidate_without_a_sum_has_none() {
        let a = Sparse::from_ints(&[&[-1, 0], &[0, -1]]);
        let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        let candidate = Candidate {
            value: 1.0,
            x: vec![1.0, -1.0],
        };

        let null = precise_null(&pencil, &[0, 1], &candidate, 128);

        assert!(null.is_none());
    }
}
