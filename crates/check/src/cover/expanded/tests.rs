//! The bounds again, in rational numbers and term by term as the formulas stand; the
//! reversed pencil.

use super::super::family::Family;
use super::*;
use mceip_exact::{rational, whole};

fn grid(n: usize, entry: impl Fn(usize, usize) -> Integer) -> LongMatrix {
    (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect()
}

fn int(list: &[i64]) -> Vec<Integer> {
    list.iter().map(|&v| v.into()).collect()
}

fn square(list: [[i64; 2]; 2]) -> LongMatrix {
    list.iter().map(|row| int(row)).collect()
}

/// Linear in t, remainder included.
fn linear() -> Expanded {
    Expanded {
        center: rational(2, 3),
        z: vec![square([[70, -30], [11, 50]]), square([[5, -7], [-2, 9]])],
        unit: 12.into(),
        left: vec![int(&[3, 5]), int(&[2, 7])],
        right: vec![int(&[4, 6])],
        weight: vec![rational(1, 700), rational(2, 900)],
        v: vec![int(&[8, 1]), int(&[3, 5])],
        rounding: vec![int(&[2, 9])],
        rounding_weight: vec![rational(1, 50), rational(3, 70)],
        drift: whole(0),
        gain: rational(3, 5),
        bound_bits: 0,
        coefficients: 4,
        reversed: false,
        spread: None,
    }
}

/// Of degree three, every list with more than one coefficient.
fn bent() -> Expanded {
    let mut e = linear();
    e.z.extend([square([[2, -3], [1, 0]]), square([[-4, 1], [3, 6]])]);
    e.left.push(int(&[1, 2]));
    e.right.extend([int(&[3, 1]), int(&[2, 4])]);
    e.v.push(int(&[6, 2]));
    e.rounding.push(int(&[5, 3]));
    e.drift = rational(7, 4);
    e
}

fn unit() -> Rational {
    Rational::from_integer(Integer::one() << FRACTION_BITS)
}

fn ceil(v: Rational) -> Rational {
    v.ceil()
}

fn power(x: &Rational, k: usize) -> Rational {
    (0..k).fold(whole(1), |p, _| p * x)
}

fn sum(list: &[Vec<Integer>], i: usize, x: &Rational) -> Rational {
    list.iter()
        .enumerate()
        .map(|(k, l)| Rational::from_integer(l[i].clone()) * power(x, k))
        .sum()
}

fn slope(list: &[Vec<Integer>], i: usize, x: &Rational) -> Rational {
    let term = |(k, l): (usize, &Vec<Integer>)| Rational::from_integer(&l[i] * k) * power(x, k - 1);
    list.iter().enumerate().skip(1).map(term).sum()
}

/// A bound rounded up to the fixed unit.
fn up(v: Rational) -> Rational {
    ceil(v * unit())
}

fn weigh(a: &Rational, b: &Rational, w: &Rational) -> Rational {
    ceil(a * b * w / unit())
}

fn at(e: &Expanded, d: &Rational) -> LongMatrix {
    let entry = |i: usize, j: usize| {
        let z: Rational =
            e.z.iter()
                .enumerate()
                .map(|(k, z)| Rational::from_integer(z[i][j].clone()) * power(d, k))
                .sum();
        (z / Rational::from_integer(e.unit.clone()) * unit())
            .floor()
            .to_integer()
    };
    grid(2, entry)
}

fn remainder(e: &Expanded, reach: &Rational, weight: &[Rational], i: usize, j: usize) -> Rational {
    let of = |list: &[Vec<Integer>], i: usize| up(sum(list, i, reach));
    weigh(&of(&e.left, i), &of(&e.right, j), &weight[i])
        + weigh(&of(&e.v, i), &of(&e.rounding, j), &e.rounding_weight[i])
        + whole(1)
}

fn weights(e: &Expanded, lo: &Rational) -> Vec<Rational> {
    e.weight
        .iter()
        .map(|w| w / (whole(1) + &e.gain * lo))
        .collect()
}

fn check_finite(e: &Expanded, is_linear: bool, lo: &Rational, hi: &Rational) {
    let got = e.ends(lo, Some(hi)).unwrap();
    assert!(!got.infinite && got.scale == Integer::one() << FRACTION_BITS);
    let (d, width) = ([lo - &e.center, hi - &e.center], hi - lo);
    let reach = d[0].abs().max(d[1].abs());
    let weight = weights(e, lo);
    let bend = |i: usize, j: usize| {
        let term = |(k, z): (usize, &LongMatrix)| {
            Rational::from_integer(z[i][j].abs() * k * (k - 1)) * power(&reach, k - 2)
        };
        let second: Rational = e.z.iter().enumerate().skip(2).map(term).sum();
        up(second * &width * &width / Rational::from_integer(e.unit.clone()))
    };
    for end in 0..2 {
        assert_eq!(got.at[end].m, at(e, &d[end]));
        let reach = if is_linear {
            d[end].abs()
        } else {
            reach.clone()
        };
        let radius = grid(2, |i, j| {
            ((bend(i, j) / whole(8)).floor() + whole(1) + remainder(e, &reach, &weight, i, j))
                .to_integer()
        });
        assert_eq!(got.at[end].r, radius, "end {end}");
    }
    let of = |list: &[Vec<Integer>], i: usize| up(sum(list, i, &reach));
    let d_of = |list: &[Vec<Integer>], i: usize| up(slope(list, i, &reach));
    let expected = grid(2, |i, j| {
        let (l, r, v, q) = (
            of(&e.left, i),
            of(&e.right, j),
            of(&e.v, i),
            of(&e.rounding, j),
        );
        let (dl, dr, dv, dq) = (
            d_of(&e.left, i),
            d_of(&e.right, j),
            d_of(&e.v, i),
            d_of(&e.rounding, j),
        );
        let w = &weight[i];
        let second = weigh(&dl, &r, w) + weigh(&l, &dr, w) + ceil(weigh(&l, &r, w) * &e.drift);
        let rounding =
            weigh(&dv, &q, &e.rounding_weight[i]) + weigh(&v, &dq, &e.rounding_weight[i]);
        (bend(i, j) + ceil((second + rounding) * &width) + whole(2)).to_integer()
    });
    assert_eq!(e.slope(lo, Some(hi)), Ok(expected));
}

#[test]
fn chord_radius_and_slope_are_those_of_the_formulas() {
    for (lo, hi) in [
        (rational(1, 7), rational(5, 3)),
        (whole(3), rational(22, 5)),
        (whole(0), rational(1, 9)),
    ] {
        check_finite(&bent(), false, &lo, &hi);
        check_finite(&linear(), true, &lo, &hi);
    }
}

#[test]
fn an_infinite_end_has_the_direction_and_its_remainder() {
    let (e, lo) = (linear(), rational(5, 2));
    let got = e.ends(&lo, None).unwrap();
    let d = &lo - &e.center;
    let weight = weights(&e, &lo);
    assert!(got.infinite);
    assert_eq!(e.slope(&lo, None), Ok(grid(2, |_, _| Integer::zero())));
    assert_eq!(got.at[0].m, at(&e, &d));
    assert_eq!(
        got.at[0].r,
        grid(2, |i, j| remainder(&e, &d, &weight, i, j).to_integer())
    );
    let direction = |i: usize, j: usize| {
        (Rational::new(e.z[1][i][j].clone(), e.unit.clone()) * unit())
            .floor()
            .to_integer()
    };
    assert_eq!(got.at[1].m, grid(2, direction));
    let one = |l: &[Integer], i: usize| Rational::from_integer(l[i].clone()) * unit();
    let radius = |i: usize, j: usize| {
        weigh(&one(&e.left[1], i), &one(&e.right[0], j), &e.weight[i])
            + weigh(
                &one(&e.v[1], i),
                &one(&e.rounding[0], j),
                &e.rounding_weight[i],
            )
            + whole(1)
    };
    assert_eq!(got.at[1].r, grid(2, |i, j| radius(i, j).to_integer()));
}

/// Whatever is not linear in t, were it one coefficient, has no direction at infinity.
#[test]
fn only_what_is_linear_reaches_infinity() {
    let mut cases: Vec<Expanded> = (0..6).map(|_| linear()).collect();
    cases[0].z.push(square([[0, 0], [0, 1]]));
    cases[1].left.push(int(&[0, 1]));
    cases[2].right.push(int(&[0, 1]));
    cases[3].v.push(int(&[0, 1]));
    cases[4].rounding.push(int(&[0, 1]));
    cases[5].drift = rational(1, 100);
    for (k, e) in cases.iter().enumerate() {
        assert!(
            matches!(e.ends(&whole(3), None), Err(CoverFault::Hypothesis { .. })),
            "{k}"
        );
        check_finite(e, false, &whole(1), &whole(2));
    }
    // Zeros beyond do not matter.
    let mut same = linear();
    same.left.push(int(&[0, 0]));
    same.right.push(int(&[0, 0]));
    same.z.push(square([[0, 0], [0, 0]]));
    check_finite(&same, true, &whole(1), &whole(2));
    assert!(same.ends(&whole(3), None).is_ok());
}

/// Reversed, the ends are those of s = 1 / t from the other side; s = 0 is t at infinity, and from
/// t = 0 nothing is said.
#[test]
fn reversed_ends_are_those_of_the_reciprocals() {
    let plain = linear();
    let reversed = || Expanded {
        reversed: true,
        ..linear()
    };
    let (lo, hi) = (rational(1, 3), rational(5, 2));
    let (there, here) = (
        plain.ends(&hi.recip(), Some(&lo.recip())).unwrap(),
        reversed().ends(&lo, Some(&hi)).unwrap(),
    );
    assert_eq!(
        (&here.at[0].m, &here.at[1].m),
        (&there.at[1].m, &there.at[0].m)
    );
    assert_eq!(
        (&here.at[0].r, &here.at[1].r),
        (&there.at[1].r, &there.at[0].r)
    );
    assert_eq!(
        reversed().slope(&lo, Some(&hi)),
        plain.slope(&hi.recip(), Some(&lo.recip()))
    );
    let (there, here) = (
        plain.ends(&whole(0), Some(&lo.recip())).unwrap(),
        reversed().ends(&lo, None).unwrap(),
    );
    assert_eq!(
        (&here.at[0].m, &here.at[1].m, here.infinite, there.infinite),
        (&there.at[1].m, &there.at[0].m, true, false)
    );
    assert!(matches!(
        reversed().ends(&whole(0), Some(&hi)),
        Err(CoverFault::Hypothesis { .. })
    ));
    let family = Family::Condensed(vec![Some(linear()), Some(reversed())]);
    assert_eq!(
        [None, Some(0), Some(1), Some(2)].map(|k| family.is_reversed(k)),
        [false, false, true, false]
    );
}
