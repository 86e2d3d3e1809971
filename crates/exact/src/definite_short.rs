//! A first try at definiteness in machine integers, for large sparse matrices that are not close to
//! singular.
//!
//! A is rounded down to multiples of a unit u = 2^(bits - 48), 2^bits above its largest diagonal
//! entry, and each diagonal entry loses what the rounding of its row took away (less than u an
//! entry). If the rest is definite ([`machine_definite`]), so is A.
//!
//! `true` is a proof of definiteness, a hundred times faster than long numbers; `false` says
//! nothing.

use super::dominance::{MACHINE_BITS, MachineRow, machine_definite};
use super::{Integer, Rational, Sparse};
use num_traits::{One, Signed, ToPrimitive};

/// The shift, in units of A: covers a row of 2^12 roundings of the factors, each of at most 2^12
/// units.
const SHIFT: i64 = 1 << (MACHINE_BITS - 24);

/// `true` proves that a symmetric matrix is positive definite; `false` says nothing.
pub(super) fn certainly_definite(m: &Sparse) -> bool {
    let least = least_lower_triangle(m);
    least.is_some_and(|lower| machine_definite(&lower, SHIFT).is_ok())
}

/// The lower triangle rounded down to the fixed unit, less the rounding on its diagonal; `None`
/// where a number does not fit.
fn least_lower_triangle(m: &Sparse) -> Option<Vec<MachineRow>> {
    let unit = Unit::of(m)?;
    let mut rows = Vec::with_capacity(m.rows());
    for i in 0..m.rows() {
        let lower: Vec<&(usize, Rational)> = m.row(i).iter().filter(|(j, _)| *j <= i).collect();
        let first = lower.first().map_or(i, |(j, _)| *j);
        let mut entries = vec![0; i + 1 - first];
        for (j, value) in lower {
            entries[j - first] = unit.round_down(value)?;
        }

        let diagonal = &mut entries[i - first];
        *diagonal = diagonal.checked_sub(i64::try_from(m.row(i).len()).ok()?)?;
        rows.push(MachineRow { first, entries });
    }

    Some(rows)
}

/// The unit of A as `down / up`, one of them 1 and the other a power of two.
struct Unit {
    up: Integer,
    down: Integer,
}

impl Unit {
    /// 2^-48 of a power of two above the largest diagonal entry; `None` if that is not positive.
    fn of(m: &Sparse) -> Option<Unit> {
        let largest = (0..m.rows()).map(|i| m.get(i, i)).max()?;
        if !largest.is_positive() {
            return None;
        }

        let bits = largest.numer().bits() as i64 - largest.denom().bits() as i64 + 1;
        let exponent = bits - i64::from(MACHINE_BITS);
        Some(Unit {
            up: Integer::one() << (-exponent).max(0).unsigned_abs(),
            down: Integer::one() << exponent.max(0).unsigned_abs(),
        })
    }

    fn round_down(&self, value: &Rational) -> Option<i64> {
        let numerator = value.numer() * &self.up;
        let denominator = value.denom() * &self.down;
        num_integer::Integer::div_floor(&numerator, &denominator).to_i64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    /// tridiag(-1, d, -1): definite exactly for d > 2 cos(pi/(n+1)), times a factor.
    fn chain(n: usize, d: Rational, factor: &Rational) -> Sparse {
        let off = (1..n).flat_map(|i| [(i, i - 1, -factor.clone()), (i - 1, i, -factor.clone())]);
        Sparse::from_entries(n, n, (0..n).map(|i| (i, i, &d * factor)).chain(off))
    }

    /// u = 2^-46: the diagonal 2 is 2^47 units, less one for each of the two entries of its row, of
    /// which the rounding of 1/3 took a part.
    #[test]
    fn the_diagonal_loses_what_rounding_took() {
        let third = rational(1, 3);
        let entries = [
            (0, 0, whole(2)),
            (0, 1, third.clone()),
            (1, 0, third),
            (1, 1, whole(2)),
        ];
        let lower = least_lower_triangle(&Sparse::from_entries(2, 2, entries)).unwrap();

        let [first, second] = &lower[..] else {
            panic!("two rows")
        };
        assert_eq!(first.entries, [(1 << 47) - 2]);
        assert_eq!(second.entries, [(1 << 46) / 3, (1 << 47) - 2]);
    }

    #[test]
    fn definite_chains_are_seen_at_every_scale() {
        for factor in [
            whole(1),
            rational(1, 3),
            rational(7, 1_000_000_007),
            whole(i64::MAX),
        ] {
            assert!(certainly_definite(&chain(100, whole(2), &factor)));
            assert!(!certainly_definite(&chain(100, rational(19, 10), &factor)));
        }

        assert!(!certainly_definite(&Sparse::zeros(3, 3)));
    }

    /// Definite by 2^-40 only, exactly singular, indefinite by 2^-40: none is accepted.
    #[test]
    fn nearly_singular_is_never_accepted() {
        let tiny = rational(1, 1 << 40);
        for corner in [whole(1) + &tiny, whole(1), whole(1) - &tiny] {
            let m = Sparse::from_entries(
                2,
                2,
                [
                    (0, 0, whole(1)),
                    (0, 1, whole(1)),
                    (1, 0, whole(1)),
                    (1, 1, corner),
                ],
            );
            assert!(!certainly_definite(&m));
        }

        // Entries off the diagonal that are larger than all of it.
        let off = Sparse::from_entries(
            2,
            2,
            [
                (0, 0, whole(1)),
                (0, 1, whole(99)),
                (1, 0, whole(99)),
                (1, 1, whole(1)),
            ],
        );

        assert!(!certainly_definite(&off));
    }
}
