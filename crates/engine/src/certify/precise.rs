//! A null vector of the pencil on a given set, to any number of bits: signs beyond doubles are read
//! off it.

use super::enclose::newton::Newton;
use super::rows::IntegralRows;
use crate::candidate::Candidate;
use mceip_exact::{Integer, Rational};
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
    let first_inverse = newton.inverse(&point)?;
    newton.polish(&mut point, &first_inverse);

    let inverse = newton.inverse(&point)?;
    point.refine(bits.saturating_sub(FIRST_BITS));
    newton.polish(&mut point, &inverse);

    let is_moving = |index: &usize| moving.contains(index);
    let positions = newton
        .active
        .iter()
        .enumerate()
        .filter(|(_, i)| is_moving(i));
    let x = positions.map(|(k, &i)| (i, point.value(k))).collect();

    let row = |i: usize| -> Integer {
        newton
            .active_entries(i)
            .map(|(k, a, b)| point.entry(a, b) * &point.x[k])
            .sum()
    };
    let y = newton
        .inactive()
        .map(|i| (i, Rational::from_integer(row(i))))
        .collect();
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
        let pencil = Pencil::new(
            Sparse::from_entries(2, 2, entries),
            Sparse::identity(2),
            vec![],
        )
        .unwrap();
        let candidate = Candidate {
            value: 2.0,
            x: vec![1.0, 0.0],
        };

        let both = precise_null(&pencil, &[0, 1], &candidate, 256).unwrap();
        let (index, x) = &both.x[1];
        let expected = -&small / whole(5);
        assert!(
            *index == 1
                && x.is_negative()
                && (x / expected - Rational::one()).abs() < parse("1e-20").unwrap(),
            "{x}"
        );
        assert!((&both.value - whole(2)).abs() < parse("1e-59").unwrap());

        let alone = precise_null(&pencil, &[0], &candidate, 256).unwrap();
        assert!(
            alone.x.len() == 1
                && alone.y.len() == 1
                && alone.y[0].0 == 1
                && alone.y[0].1.is_positive()
        );
        assert_eq!(alone.value, whole(2));
    }

    #[test]
    fn a_candidate_without_a_sum_has_none() {
        let pencil = Pencil::new(
            Sparse::from_ints(&[&[-1, 0], &[0, -1]]),
            Sparse::identity(2),
            vec![],
        )
        .unwrap();
        assert!(
            precise_null(
                &pencil,
                &[0, 1],
                &Candidate {
                    value: 1.0,
                    x: vec![1.0, -1.0]
                },
                128
            )
            .is_none()
        );
    }
}
