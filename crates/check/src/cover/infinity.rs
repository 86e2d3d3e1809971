//! Regions that reach to infinity, for leaves that need a chord between two matrices: s = lo / t
//! falls from 1 to 0, and s T(t) = s T(lo) + (1 - s) lo B for a pencil linear in t. A reversed
//! expansion is such a chord already.
//!
//! A null vector of the limit at s = 0 belongs to no value in the window; where there is one null
//! vector at most on the whole chord, nothing else is there.

use super::CoverFault;
use super::family::{Ends, Family, Matrix};
use crate::pencil::Rows;
use mceip_exact::{Integer, Rational};
use num_traits::Zero;

impl Family {
    /// Does the piece's anchor expand B + sA?
    pub(super) fn is_reversed(&self, anchor: Option<usize>) -> bool {
        match self {
            Family::Linear(_) => false,
            Family::Condensed(list) => anchor
                .and_then(|k| list.get(k))
                .is_some_and(|(e, _)| e.reversed),
        }
    }

    /// The ends that a root leaf over the hull [lo, hi] is judged by: those of T itself, over a
    /// half line those of the chord.
    pub(super) fn hull_ends(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<Ends, CoverFault> {
        if hi.is_some() || self.is_reversed(anchor) {
            return self.ends(anchor, lo, hi);
        }
        if lo.is_zero() {
            return Err(CoverFault::RootTooEarly);
        }

        let cone = self.ends(anchor, lo, None)?;
        Ok(chord(&cone, lo))
    }
}

/// The ends T(lo) and lo B of s T(t), s = lo / t from 1 to 0, out of T(lo) and the direction B
/// (`cone`).
///
/// In units of 1 / (scale of the cone times the denominator of lo).
fn chord(cone: &Ends, lo: &Rational) -> Ends {
    let [at_lo, direction] = &cone.m;
    let [radius_at_lo, radius_of_direction] = &cone.r;
    let (p, q) = (lo.numer(), lo.denom());

    let radius = [multiple(q, radius_at_lo), multiple(p, radius_of_direction)];
    // d(sT)/ds = T(lo) - lo B, and each of the two lies within its radius.
    let slope = sum(&radius[0], &radius[1]);

    Ends {
        m: [multiple(q, at_lo), multiple(p, direction)],
        r: radius,
        slope,
        scale: &cone.scale * q,
        infinite: true,
    }
}

fn multiple(factor: &Integer, matrix: &Matrix) -> Matrix {
    matrix
        .iter()
        .map(|row| row.iter().map(|v| factor * v).collect())
        .collect()
}

fn sum(left: &Matrix, right: &Matrix) -> Matrix {
    let row =
        |(l, r): (&Vec<Integer>, &Vec<Integer>)| l.iter().zip(r).map(|(l, r)| l + r).collect();
    left.iter().zip(right).map(row).collect()
}

/// x is a null vector of the limit at infinity on the moving set: B x = 0 on the moving and the
/// free rows, x zero at rest and not zero on the moving set. Free rows that are zero in B have the
/// row of A for their limit, if all are.
pub(super) fn null_vector(
    rows: &Rows,
    moving: &[usize],
    is_infinite: bool,
    reversed: bool,
    x: &[Integer],
) -> Result<(), CoverFault> {
    let fault = |expected, index| Err(CoverFault::NotAtInfinity { expected, index });
    if x.len() != rows.order() {
        return Err(CoverFault::Length {
            what: "infinity",
            expected: rows.order(),
            got: x.len(),
        });
    }
    if !is_infinite {
        return fault("a region that reaches to infinity", 0);
    }
    if moving.iter().all(|&i| x[i].is_zero()) {
        return fault(
            "x not zero on the moving set",
            moving.first().copied().unwrap_or(0),
        );
    }
    for (i, row) in rows.rows.iter().enumerate() {
        let is_active = rows.is_free[i] || moving.contains(&i);
        if !is_active && !x[i].is_zero() {
            return fault("x = 0 off the active variables", i);
        }
        // The free block of B is regular in a reversed expansion, of A in the other.
        let by_a = rows.is_free[i] && !reversed;
        if by_a && row.iter().any(|(_, _, b)| !b.is_zero()) {
            return fault("free rows that are zero in B", i);
        }
        let y: Integer = row
            .iter()
            .map(|(j, a, b)| if by_a { a } else { b } * &x[*j])
            .sum();
        if is_active && !y.is_zero() {
            return fault("B x = 0 on the active rows", i);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::family::Linear;
    use super::*;
    use mceip_exact::{rational, whole};
    use num_traits::One;

    fn rows(rows: &[&[(i64, i64)]], free: &[usize]) -> Rows {
        let row = |r: &&[(i64, i64)]| {
            r.iter()
                .enumerate()
                .map(|(j, (a, b))| (j, Integer::from(*a), Integer::from(*b)))
                .collect()
        };
        let is_free = (0..rows.len()).map(|i| free.contains(&i)).collect();
        Rows {
            rows: rows.iter().map(row).collect(),
            factor: vec![Integer::one(); rows.len()],
            is_free,
        }
    }

    /// The ends of a chord are T(lo) and lo B of the pencil as given, each row divided by its power
    /// of two, whatever the denominator of lo.
    #[test]
    fn a_chord_to_infinity_leads_from_the_pencil_to_its_direction() {
        let given: &[&[(i64, i64)]] = &[&[(3, 1), (-5, 2)], &[(7, -4), (0, 9)]];
        let family = Family::Linear(Linear::of(&rows(given, &[])));
        // The largest entries of A are 5 and 7, both below 8.
        let row_scale = whole(8);

        for lo in [whole(1), rational(3, 2), rational(1, 1000), rational(22, 7)] {
            let chord = family.hull_ends(None, &lo, None).unwrap();
            assert!(chord.infinite);

            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let (a, b) = given[i][j];
                let entry =
                    |end: usize| Rational::new(chord.m[end][i][j].clone(), chord.scale.clone());

                assert_eq!(
                    entry(0) * &row_scale,
                    whole(a) + &lo * whole(b),
                    "T(lo), lo = {lo}"
                );
                assert_eq!(entry(1) * &row_scale, &lo * whole(b), "lo B, lo = {lo}");
            }
        }
        assert!(matches!(
            family.hull_ends(None, &whole(0), None),
            Err(CoverFault::RootTooEarly)
        ));
    }

    /// What the ends may be off T(lo) and B is carried along, and so is what the slope may be.
    #[test]
    fn a_chord_carries_the_radii() {
        let of = |v: i64| vec![vec![Integer::from(v)]];
        let scale = Integer::from(5);
        let cone = Ends {
            m: [of(10), of(1)],
            r: [of(2), of(3)],
            slope: of(0),
            scale,
            infinite: true,
        };

        let chord = chord(&cone, &rational(3, 2));

        // T(lo) = 10/5 +- 2/5, B = 1/5 +- 3/5, lo = 3/2.
        let number = |m: &Matrix| Rational::new(m[0][0].clone(), chord.scale.clone());
        assert_eq!(
            [number(&chord.m[0]), number(&chord.m[1])],
            [whole(2), rational(3, 10)]
        );
        assert_eq!(
            [number(&chord.r[0]), number(&chord.r[1])],
            [rational(2, 5), rational(9, 10)]
        );
        assert_eq!(number(&chord.slope), rational(13, 10));
    }

    #[test]
    fn a_null_vector_at_infinity_is_multiplied_out() {
        let x = |v: &[i64]| v.iter().map(|&v| Integer::from(v)).collect::<Vec<_>>();
        let plain = rows(&[&[(3, 1), (-5, -2)], &[(7, -2), (0, 4)]], &[]);
        assert_eq!(
            null_vector(&plain, &[0, 1], true, false, &x(&[2, 1])),
            Ok(())
        );
        let wrong = |moving: &[usize], infinite, v: &[i64]| {
            null_vector(&plain, moving, infinite, false, &x(v)).unwrap_err()
        };
        assert!(matches!(
            wrong(&[0, 1], true, &[2]),
            CoverFault::Length { .. }
        ));
        assert!(matches!(
            wrong(&[0, 1], false, &[2, 1]),
            CoverFault::NotAtInfinity {
                expected: "a region that reaches to infinity",
                ..
            }
        ));
        assert!(matches!(
            wrong(&[0, 1], true, &[0, 0]),
            CoverFault::NotAtInfinity { .. }
        ));
        assert!(matches!(
            wrong(&[0, 1], true, &[2, 2]),
            CoverFault::NotAtInfinity {
                expected: "B x = 0 on the active rows",
                index: 0
            }
        ));
        assert!(matches!(
            wrong(&[0], true, &[2, 1]),
            CoverFault::NotAtInfinity {
                expected: "x = 0 off the active variables",
                index: 1
            }
        ));
        // A free row: that of A where B has none, that of B if the expansion is reversed.
        let free = rows(&[&[(2, 0), (-1, 0)], &[(1, 4), (1, -2)]], &[0]);
        assert_eq!(null_vector(&free, &[1], true, false, &x(&[1, 2])), Ok(()));
        let mass = rows(&[&[(2, 1), (-1, 3)], &[(1, 3), (1, 9)]], &[0]);
        assert_eq!(null_vector(&mass, &[1], true, true, &x(&[-3, 1])), Ok(()));
        let refused = null_vector(&mass, &[1], true, false, &x(&[-3, 1]));
        assert!(matches!(
            refused,
            Err(CoverFault::NotAtInfinity {
                expected: "free rows that are zero in B",
                index: 0
            })
        ));
    }

    /// The moving row of (1, 1) vanishes and the free one does not: no null vector, in either
    /// expansion.
    #[test]
    fn a_null_vector_at_infinity_meets_the_free_rows() {
        let x = [Integer::one(), Integer::one()];
        let unbalanced = Err(CoverFault::NotAtInfinity {
            expected: "B x = 0 on the active rows",
            index: 0,
        });

        let by_a = rows(&[&[(2, 0), (-1, 0)], &[(1, 4), (1, -4)]], &[0]);
        assert_eq!(null_vector(&by_a, &[1], true, false, &x), unbalanced);

        let by_b = rows(&[&[(2, 1), (-1, 3)], &[(1, 4), (1, -4)]], &[0]);
        assert_eq!(null_vector(&by_b, &[1], true, true, &x), unbalanced);
    }
}
