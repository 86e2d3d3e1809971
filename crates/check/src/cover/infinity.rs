//! Root leaves over a half line [lo, infinity).
//!
//! A root leaf needs the convex hull of two matrices, and a half line has none. With s = lo / t,
//! which falls from 1 to 0, s T(t) has the null vectors and the signs of T(t), and for a pencil
//! linear in t
//!
//! ```text
//!     s T(t) = s T(lo) + (1 - s) lo B
//! ```
//!
//! is the chord from T(lo) to lo B. It needs lo > 0. A reversed expansion (B + sA in place of A +
//! tB, see `condensed`) has a chord already.
//!
//! s = 0 is no value of the window. So if the chord has at most one null vector, and one is known
//! at s = 0, there is none at a value of the window ([`null_vector`], outcome `infinity`).
//!
//! Called by the walk for the ends of root leaves and for that outcome.

use super::ball::combination;
use super::ends::Ends;
use super::family::Family;
use super::fault::CoverFault;
use crate::pencil::Rows;
use mceip_exact::{Integer, Rational};
use num_traits::Zero;

impl Family {
    /// Does the piece's anchor expand B + sA?
    pub(super) fn is_reversed(&self, anchor: Option<usize>) -> bool {
        self.anchor(anchor).is_some_and(|e| e.reversed)
    }

    /// The ends that a root leaf over the hull [lo, hi] is judged by, with their slope: those of T
    /// itself, over a half line those of the chord.
    pub(super) fn hull_ends(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<Ends, CoverFault> {
        if hi.is_some() || self.is_reversed(anchor) {
            let ends = self.ends(anchor, lo, hi)?;
            let slope = Some(self.slope(anchor, lo, hi)?);
            return Ok(Ends { slope, ..ends });
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
    let [at_lo, direction] = &cone.at;
    let p = lo.numer();
    let q = lo.denom();

    Ends {
        at: [at_lo.times(q), direction.times(p)],
        // d(sT)/ds = T(lo) - lo B, and each of the two lies within its radius.
        slope: Some(combination(&at_lo.r, q, &direction.r, p)),
        scale: &cone.scale * q,
        infinite: true,
    }
}

/// Demands that x is a null vector of the pencil's limit at infinity on the support.
///
/// That is: B x = 0 on the support and the free rows, x zero off them and not zero on the support.
/// Without a reversed expansion the limit has a free row only where B is zero there: it is the row
/// of A, and all free rows have to be of this kind.
pub(super) fn null_vector(
    rows: &Rows,
    support: &[usize],
    is_infinite: bool,
    is_reversed: bool,
    x: &[Integer],
) -> Result<(), CoverFault> {
    CoverFault::length("infinity", rows.order(), x.len())?;
    if !is_infinite {
        return Err(fault("a region that reaches to infinity", 0));
    }

    if support.iter().all(|&i| x[i].is_zero()) {
        let index = support.first().copied().unwrap_or(0);
        return Err(fault("x not zero on the moving set", index));
    }

    for (i, row) in rows.rows.iter().enumerate() {
        let is_free = rows.is_free[i];
        let is_active = is_free || support.contains(&i);
        if !is_active {
            if !x[i].is_zero() {
                return Err(fault("x = 0 off the active variables", i));
            }

            continue;
        }

        // The free block of B is regular in a reversed expansion, of A in the other.
        let is_row_of_a = is_free && !is_reversed;
        if is_row_of_a && row.iter().any(|(_, _, b)| !b.is_zero()) {
            return Err(fault("free rows that are zero in B", i));
        }

        let mut y = Integer::zero();
        for (j, a, b) in row {
            let entry = if is_row_of_a { a } else { b };
            y += entry * &x[*j];
        }

        if !y.is_zero() {
            return Err(fault("B x = 0 on the active rows", i));
        }
    }

    Ok(())
}

fn fault(expected: &'static str, index: usize) -> CoverFault {
    CoverFault::NotAtInfinity { expected, index }
}

#[cfg(test)]
mod tests {
    use super::super::ball::BallMatrix;
    use super::super::ends::LongMatrix;
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
            halves: vec![],
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
        let family = Family::of_parts(&[&rows(given, &[])], None, None).remove(0);
        // The largest entries of A are 5 and 7, both below 8.
        let row_scale = whole(8);

        for lo in [whole(1), rational(3, 2), rational(1, 1000), rational(22, 7)] {
            let chord = family.hull_ends(None, &lo, None).unwrap();
            assert!(chord.infinite);

            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let (a, b) = given[i][j];
                let entry =
                    |end: usize| Rational::new(chord.at[end].m[i][j].clone(), chord.scale.clone());

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
            at: [(10, 2), (1, 3)].map(|(m, r)| BallMatrix { m: of(m), r: of(r) }),
            slope: None,
            scale,
            infinite: true,
        };

        let chord = chord(&cone, &rational(3, 2));

        // T(lo) = 10/5 +- 2/5, B = 1/5 +- 3/5, lo = 3/2.
        let number = |m: &LongMatrix| Rational::new(m[0][0].clone(), chord.scale.clone());
        assert_eq!(
            [number(&chord.at[0].m), number(&chord.at[1].m)],
            [whole(2), rational(3, 10)]
        );
        assert_eq!(
            [number(&chord.at[0].r), number(&chord.at[1].r)],
            [rational(2, 5), rational(9, 10)]
        );
        assert_eq!(number(&chord.slope.unwrap()), rational(13, 10));
    }

    #[test]
    fn a_null_vector_at_infinity_is_multiplied_out() {
        let integers = |v: &[i64]| v.iter().map(|&v| Integer::from(v)).collect::<Vec<_>>();
        let plain = rows(&[&[(3, 1), (-5, -2)], &[(7, -2), (0, 4)]], &[]);
        assert_eq!(
            null_vector(&plain, &[0, 1], true, false, &integers(&[2, 1])),
            Ok(())
        );
        let wrong = |moving: &[usize], infinite, v: &[i64]| {
            null_vector(&plain, moving, infinite, false, &integers(v)).unwrap_err()
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
        assert_eq!(
            null_vector(&free, &[1], true, false, &integers(&[1, 2])),
            Ok(())
        );
        let mass = rows(&[&[(2, 1), (-1, 3)], &[(1, 3), (1, 9)]], &[0]);
        assert_eq!(
            null_vector(&mass, &[1], true, true, &integers(&[-3, 1])),
            Ok(())
        );
        let refused = null_vector(&mass, &[1], true, false, &integers(&[-3, 1]));
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
