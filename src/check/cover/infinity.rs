//! Regions that reach to infinity, for leaves that need a chord between two matrices: s = lo / t falls from 1 to 0, and
//! s T(t) = s T(lo) + (1 - s) lo B for a pencil linear in t. A reversed expansion is such a chord already.
//!
//! A null vector of the limit at s = 0 belongs to no value in the window; where there is one null vector at most on the
//! whole chord, nothing else is there.

use super::CoverFault;
use super::family::{Ends, Family, Matrix};
use crate::check::pencil::Rows;
use crate::exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Zero};

impl Family {
    /// Does the piece's anchor expand B + sA?
    pub(super) fn is_reversed(&self, anchor: Option<usize>) -> bool {
        match self {
            Family::Linear(_) => false,
            Family::Condensed(list) => anchor.and_then(|k| list.get(k)).is_some_and(|(e, _)| e.reversed),
        }
    }

    /// The ends over a hull and over an interval in it, in one scale: what bounds the inverse over the first bounds it over
    /// the second.
    pub(super) fn nested(
        &self,
        anchor: Option<usize>,
        (lo, hi): (&Rational, Option<&Rational>),
        [a, b]: [&Rational; 2],
    ) -> Result<[Ends; 2], CoverFault> {
        if hi.is_some() || self.is_reversed(anchor) {
            return Ok([self.ends(anchor, lo, hi)?, self.ends(anchor, a, Some(b))?]);
        }
        if lo.is_zero() {
            return Err(CoverFault::RootTooEarly);
        }
        let cone = self.ends(anchor, lo, None)?;
        Ok([chord(&cone, lo, lo, None), chord(&cone, lo, a, Some(b))])
    }
}

/// s T(t) for t from `from` to `to`, out of T(lo) and the direction B (`cone`).
fn chord(cone: &Ends, lo: &Rational, from: &Rational, to: Option<&Rational>) -> Ends {
    let s = [lo / from, to.map_or_else(Rational::zero, |to| lo / to)];
    let common = s[0].denom().lcm(s[1].denom()) * lo.denom();
    let whole = |v: Rational| (v * Rational::from_integer(common.clone())).to_integer(); // common clears it
    let mix = |list: &[Matrix; 2], p: &Integer, q: &Integer| -> Matrix {
        let rows = list[0].iter().zip(&list[1]);
        rows.map(|(a, b)| a.iter().zip(b).map(|(a, b)| p * a + q * b).collect()).collect()
    };
    let end = |list: &[Matrix; 2], s: &Rational| mix(list, &whole(s.clone()), &whole((Rational::one() - s) * lo));
    let width = &s[0] - &s[1];
    Ends {
        m: [end(&cone.m, &s[0]), end(&cone.m, &s[1])],
        r: [end(&cone.r, &s[0]), end(&cone.r, &s[1])],
        // T(lo) and B each lie within their radius.
        slope: mix(&cone.r, &whole(width.clone()), &whole(width * lo)),
        scale: &cone.scale * &common,
        infinite: to.is_none(),
    }
}

/// x is a null vector of the limit at infinity on the moving set: B x = 0 on the moving and the free rows, x zero at rest
/// and not zero on the moving set. Free rows that are zero in B have the row of A for their limit, if all are.
pub(super) fn null_vector(rows: &Rows, moving: &[usize], is_infinite: bool, reversed: bool, x: &[Integer]) -> Result<(), CoverFault> {
    let fault = |expected, index| Err(CoverFault::NotAtInfinity { expected, index });
    if x.len() != rows.order() {
        return Err(CoverFault::Length { what: "infinity", expected: rows.order(), got: x.len() });
    }
    if !is_infinite {
        return fault("a region that reaches to infinity", 0);
    }
    if moving.iter().all(|&i| x[i].is_zero()) {
        return fault("x not zero on the moving set", moving.first().copied().unwrap_or(0));
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
        let y: Integer = row.iter().map(|(j, a, b)| if by_a { a } else { b } * &x[*j]).sum();
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
    use crate::exact::{rational, whole};

    fn rows(rows: &[&[(i64, i64)]], free: &[usize]) -> Rows {
        let row = |r: &&[(i64, i64)]| r.iter().enumerate().map(|(j, (a, b))| (j, Integer::from(*a), Integer::from(*b))).collect();
        let is_free = (0..rows.len()).map(|i| free.contains(&i)).collect();
        Rows { rows: rows.iter().map(row).collect(), factor: vec![Integer::one(); rows.len()], is_free }
    }

    /// Each entry of both ends is s T(t) of the pencil, whatever the scale.
    #[test]
    fn a_chord_to_infinity_is_the_pencil_times_lo_over_t() {
        let pencil = rows(&[&[(3, 1), (-5, 2)], &[(7, -4), (0, 9)]], &[]);
        let family = Family::Linear(Linear::of(&pencil));
        let (lo, a, b) = (rational(3, 2), whole(2), rational(16, 3));
        let [wide, narrow] = family.nested(None, (&lo, None), [&a, &b]).unwrap();
        let cone = family.ends(None, &lo, None).unwrap();
        // Rows are scaled by the checker: read their factors off T(lo).
        let entry = |ends: &Ends, end: usize, i: usize, j: usize| Rational::new(ends.m[end][i][j].clone(), ends.scale.clone());
        let value = |i: usize, j: usize, s: &Rational| {
            let [t_lo, direction] = [0, 1].map(|end| entry(&cone, end, i, j));
            s * t_lo + (Rational::one() - s) * &lo * direction
        };
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            assert_eq!(entry(&wide, 0, i, j), value(i, j, &whole(1)));
            assert_eq!(entry(&wide, 1, i, j), value(i, j, &whole(0)));
            assert_eq!(entry(&narrow, 0, i, j), value(i, j, &(&lo / &a)));
            assert_eq!(entry(&narrow, 1, i, j), value(i, j, &(&lo / &b)));
        }
        assert!(wide.infinite && !narrow.infinite);
        assert!(matches!(family.nested(None, (&whole(0), None), [&a, &b]), Err(CoverFault::RootTooEarly)));
    }

    /// What the ends may be off T(lo) and B is carried along, and so is what the slope may be.
    #[test]
    fn a_chord_carries_the_radii() {
        let of = |v: i64| vec![vec![Integer::from(v)]];
        let cone = Ends { m: [of(10), of(1)], r: [of(2), of(3)], slope: of(0), scale: Integer::from(5), infinite: true };
        let (lo, a, b) = (rational(3, 2), whole(2), rational(16, 3));
        let got = chord(&cone, &lo, &a, Some(&b));
        let in_units = |m: &Matrix| Rational::new(m[0][0].clone(), got.scale.clone()) * whole(5);
        let [s0, s1] = [&lo / &a, &lo / &b];
        let off = |s: &Rational| s * whole(2) + (whole(1) - s) * &lo * whole(3);
        assert_eq!([in_units(&got.r[0]), in_units(&got.r[1])], [off(&s0), off(&s1)]);
        let width = s0 - s1;
        assert_eq!(in_units(&got.slope), &width * whole(2) + width * lo * whole(3));
    }

    #[test]
    fn a_null_vector_at_infinity_is_multiplied_out() {
        let x = |v: &[i64]| v.iter().map(|&v| Integer::from(v)).collect::<Vec<_>>();
        let plain = rows(&[&[(3, 1), (-5, -2)], &[(7, -2), (0, 4)]], &[]);
        assert_eq!(null_vector(&plain, &[0, 1], true, false, &x(&[2, 1])), Ok(()));
        let wrong = |moving: &[usize], infinite, v: &[i64]| null_vector(&plain, moving, infinite, false, &x(v)).unwrap_err();
        assert!(matches!(wrong(&[0, 1], true, &[2]), CoverFault::Length { .. }));
        assert!(matches!(wrong(&[0, 1], false, &[2, 1]), CoverFault::NotAtInfinity { expected: "a region that reaches to infinity", .. }));
        assert!(matches!(wrong(&[0, 1], true, &[0, 0]), CoverFault::NotAtInfinity { .. }));
        assert!(matches!(wrong(&[0, 1], true, &[2, 2]), CoverFault::NotAtInfinity { expected: "B x = 0 on the active rows", index: 0 }));
        assert!(matches!(wrong(&[0], true, &[2, 1]), CoverFault::NotAtInfinity { expected: "x = 0 off the active variables", index: 1 }));
        // A free row: that of A where B has none, that of B if the expansion is reversed.
        let free = rows(&[&[(2, 0), (-1, 0)], &[(1, 4), (1, -2)]], &[0]);
        assert_eq!(null_vector(&free, &[1], true, false, &x(&[1, 2])), Ok(()));
        let mass = rows(&[&[(2, 1), (-1, 3)], &[(1, 3), (1, 9)]], &[0]);
        assert_eq!(null_vector(&mass, &[1], true, true, &x(&[-3, 1])), Ok(()));
        let refused = null_vector(&mass, &[1], true, false, &x(&[-3, 1]));
        assert!(matches!(refused, Err(CoverFault::NotAtInfinity { expected: "free rows that are zero in B", index: 0 })));
    }
}
