//! The box that is proposed: where its centre lies, how wide it is, and what is told instead of it.

use super::*;
use crate::exact::{Sparse, parse, rational, whole};
use crate::tolerance::PRECONDITIONER_BITS;

/// [[-1, -2], [-2, -1]] + t I: x = (1/2, 1/2), t = 3; a third variable rests with y = `rest` times x. All rows times a factor.
fn pencil(rest: [i64; 2], factor: &Rational) -> Pencil {
    let a = [[-1, -2, 0], [-2, -1, 0], [rest[0], rest[1], 9]];
    let times = |v: i64| whole(v) * factor;
    let a = Sparse::from_entries(
        3,
        3,
        (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| (i, j, times(a[i][j]))).collect::<Vec<_>>(),
    );
    Pencil::new(a, Sparse::from_entries(3, 3, (0..3).map(|i| (i, i, factor.clone()))), vec![]).unwrap()
}

fn of(p: &Pencil, window: &Window, support: &[usize], value: f64, x: [f64; 3]) -> Result<EnclosedSolution, AttemptFailure> {
    make(p, &IntegralRows::of(p), window, support, &Candidate { value, x: x.to_vec() })
}

const X: [f64; 3] = [0.5 + 1e-7, 0.5 - 2e-7, 0.0];

/// From a candidate some digits off the centre comes within the grid of the truth, for rows of any size.
#[test]
fn the_centre_is_polished() {
    for factor in [whole(1), rational(1, 7), parse("1e-400").unwrap(), parse("1e400").unwrap(), parse("1234567e900").unwrap()] {
        // The factor of the first row alone: denominators are cleared row by row.
        let mut p = pencil([1, 1], &whole(1));
        if !factor.is_integer() || factor > whole(1) {
            let scaled = |m: &Sparse| m.entries().map(|(i, j, v)| (i, j, if i == 0 { v * &factor } else { v.clone() })).collect::<Vec<_>>();
            p = Pencil::new(Sparse::from_entries(3, 3, scaled(p.a())), Sparse::from_entries(3, 3, scaled(p.b())), vec![]).unwrap();
        }
        let c = of(&p, &Window::all(), &[0, 1], 3.0 + 1e-7, X).unwrap();
        let off = |k: usize, v: Rational| (&c.center[k].0 - v).abs();
        let limit = rational(1, 1 << 60);
        assert!(off(0, rational(1, 2)) < limit && off(1, rational(1, 2)) < limit && off(2, whole(3)) < limit, "{factor}");
    }
}

/// The ends of the window belong to it; what lies beside it is no root there.
#[test]
fn a_value_beside_the_window_is_none() {
    let p = pencil([1, 1], &whole(1));
    let at =
        |min: i64, max: Option<i64>| of(&p, &Window::new(whole(min), max.map(whole)).unwrap(), &[0, 1], 3.0, [0.5, 0.5, 0.0]).map(|_| ());
    assert_eq!([at(0, None), at(3, None), at(0, Some(3)), at(3, Some(3))], [Ok(()), Ok(()), Ok(()), Ok(())]);
    for (min, max) in [(4, None), (4, Some(5)), (0, Some(2))] {
        assert!(matches!(at(min, max), Err(AttemptFailure::NoRootNear { .. })), "{min} {max:?}");
    }
}

/// How far the polished centre may be: X_RADIUS, or VALUE_RADIUS (1 + value) if that is more.
#[test]
fn a_candidate_too_far_away_is_not_the_solution() {
    // [[1 - s, ...]]: the value is 10^6, so that 100 is near and 200 is not.
    let a = Sparse::from_ints(&[&[-1_000_000]]);
    let p = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
    let at = |value: f64| make(&p, &IntegralRows::of(&p), &Window::all(), &[0], &Candidate { value, x: vec![1.0] }).map(|_| ());
    assert_eq!([at(1_000_000.0), at(1_000_090.0), at(999_910.0)], [Ok(()), Ok(()), Ok(())]);
    assert!([1_000_150.0, 999_850.0].iter().all(|v| matches!(at(*v), Err(AttemptFailure::TooFar { .. }))));
    // At 10 it is 0.0011.
    let p = Pencil::new(Sparse::from_ints(&[&[-10]]), Sparse::identity(1), vec![]).unwrap();
    let at = |value: f64| make(&p, &IntegralRows::of(&p), &Window::all(), &[0], &Candidate { value, x: vec![1.0] }).map(|_| ());
    assert!(at(10.00105).is_ok() && at(10.00115).is_err());
    // At zero the value is no scale.
    let p = Pencil::new(Sparse::from_entries(1, 1, []), Sparse::identity(1), vec![]).unwrap();
    assert!(make(&p, &IntegralRows::of(&p), &Window::all(), &[0], &Candidate { value: 0.0, x: vec![1.0] }).is_ok());
    // At a value near zero the bound is X_RADIUS itself, not the ten times smaller one of values.
    let p = Pencil::new(Sparse::from_entries(1, 1, [(0, 0, rational(-1, 1000))]), Sparse::identity(1), vec![]).unwrap();
    let at = |value: f64| make(&p, &IntegralRows::of(&p), &Window::all(), &[0], &Candidate { value, x: vec![1.0] }).map(|_| ());
    assert_eq!(at(0.0015), Ok(()));
    assert!(matches!(at(0.0035), Err(AttemptFailure::TooFar { .. })));
}

/// A wrong support is named with the component that gives it away.
#[test]
fn wrong_signs_are_named() {
    let all = Window::all();
    assert_eq!(
        of(&pencil([-1, -1], &whole(1)), &all, &[0, 1], 3.0, [0.5, 0.5, 0.0]).map(|_| ()),
        Err(AttemptFailure::YNegative { index: 2 })
    );
    assert_eq!(
        of(&pencil([1, -1], &whole(1)), &all, &[0, 1], 3.0, [0.5, 0.5, 0.0]).map(|_| ()),
        Err(AttemptFailure::YNegative { index: 2 })
    );
    assert!(of(&pencil([1, 1], &whole(1)), &all, &[0, 1], 3.0, [0.5, 0.5, 0.0]).is_ok());
    // Swapped signs: [[-1, 2], [2, -1]] has x = (1, -1) at t = 3, and e'x = 0 there; a free part gives e'x its sum.
    let a = Sparse::from_ints(&[&[-1, 4], &[1, -1]]);
    let p = Pencil::new(a, Sparse::identity(2), vec![]).unwrap(); // (1 - t)^2 = 4: t = 3, x = (2, -1)
    let got = make(&p, &IntegralRows::of(&p), &all, &[0, 1], &Candidate { value: 3.0, x: vec![2.0, -1.0] }).map(|_| ());
    assert_eq!(got, Err(AttemptFailure::XNotPositive { index: 1 }));
}

/// 2^-40 of the power of two at the largest component of x, and of the value; t is no component.
#[test]
fn radii_follow_x_and_the_value() {
    let unit = rational(1, 1 << 40);
    let of = |list: &[Rational]| radii(list).iter().map(|r| r / &unit).collect::<Vec<_>>();
    let (r, w) = (rational, whole);
    assert_eq!(of(&[r(1, 4), r(-3, 8), w(1000)]), [r(1, 4), r(1, 4), w(512)]);
    assert_eq!(of(&[w(5), w(1), r(1, 1000)]), [w(4), w(4), r(1, 512)]);
    assert_eq!(of(&[w(1), w(0)]), [w(1), w(1)]);
}

/// The largest entry has PRECONDITIONER_BITS bits, or as many after the point as are needed.
#[test]
fn a_preconditioner_keeps_its_bits() {
    let bits = PRECONDITIONER_BITS as u32;
    let y = |v: f64| vec![vec![v, -0.5 * v], vec![0.0, 0.25 * v]];
    for (largest, log) in [(1.0, 0i64), (8.0, 3), (0.125, -3), (1024.0, 10)] {
        let (rows, exponent) = round(&y(largest), &[0, 0], 0.0);
        assert_eq!(i64::from(exponent), i64::from(bits) - log);
        assert_eq!(rows[0], [Integer::from(1) << bits, -(Integer::from(1) << (bits - 1))]);
    }
    let (rows, exponent) = round(&y(1.0), &[3, 0], 100.0);
    let power = |k: u32| Integer::from(1) << k;
    assert_eq!(exponent, 103);
    assert_eq!(rows[0], [power(100), -power(102)]);
}

/// Bits for n entries of a row against the narrowest side: n = 2, reaches 4.25 and 120.5, sides 4 and 1/8: 1928 < 2^11.
#[test]
fn rounding_is_small_beside_the_narrowest_side() {
    let jacobian = [vec![1.0, -2.0], vec![30.0, 4.0]];
    assert_eq!(rounding_bits(&jacobian, &[whole(4), rational(1, 8)]), 11.0 + f64::from(PRECONDITIONER_LOSS_BITS));
}

/// Rows of 66,000 bits would need a preconditioner of as many.
#[test]
fn a_preconditioner_has_no_more_than_so_many_bits() {
    let a_row_times = |bits: u32| {
        let factor = Rational::from_integer(Integer::one() << bits);
        let times = |m: &Sparse| m.entries().map(|(i, j, v)| (i, j, if i == 0 { v * &factor } else { v.clone() })).collect::<Vec<_>>();
        let p = pencil([1, 1], &whole(1));
        let p = Pencil::new(Sparse::from_entries(3, 3, times(p.a())), Sparse::from_entries(3, 3, times(p.b())), vec![]).unwrap();
        of(&p, &Window::all(), &[0, 1], 3.0, X).map(|_| ())
    };
    assert_eq!(a_row_times(60_000), Ok(()));
    assert!(matches!(a_row_times(66_000), Err(AttemptFailure::TooLarge { limit: 65_536, got: 66_000.. })));
}
