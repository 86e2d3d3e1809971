//! The bounds again, in rational numbers and term by term as the formulas stand; the short form;
//! the reversed pencil.

use super::super::family::{AnchorExpansion, Family};
use super::*;
use mceip_exact::{rational, whole};

fn grid(n: usize, entry: impl Fn(usize, usize) -> Integer) -> LongMatrix {
    (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect()
}

fn without_short(expanded: Expanded) -> AnchorExpansion {
    AnchorExpansion {
        expanded,
        short: None,
    }
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
    let family = Family::Condensed(vec![
        Some(without_short(linear())),
        Some(without_short(reversed())),
    ]);
    assert_eq!(
        [None, Some(0), Some(1), Some(2)].map(|k| family.is_reversed(k)),
        [false, false, true, false]
    );
}

fn big(rows: &[&[i64]]) -> Vec<Vec<Integer>> {
    rows.iter()
        .map(|r| r.iter().map(|v| Integer::from(*v)).collect())
        .collect()
}

/// Linear in t itself, with the two remainders of different sizes.
fn in_t() -> Expanded {
    Expanded {
        center: whole(0),
        z: vec![
            big(&[&[300, -500], &[0, 700]]),
            big(&[&[-100, 200], &[0, 9000]]),
        ],
        unit: Integer::from(1024),
        left: big(&[&[1, 2], &[3, 4]]),
        right: big(&[&[5, 6], &[0, 0]]),
        weight: vec![rational(1, 30_000), rational(1, 40_000)],
        v: big(&[&[7, 1], &[0, 3]]),
        rounding: big(&[&[2, 1]]),
        rounding_weight: vec![rational(1, 50_000), rational(1, 60_000)],
        drift: whole(0),
        gain: whole(0),
        bound_bits: 0,
        coefficients: 4,
        reversed: false,
    }
}

/// Z(t) and its remainders, in the fixed unit.
fn linear_entry(e: &Expanded, t: &Rational, i: usize, j: usize) -> [Rational; 2] {
    let z = |k: usize| Rational::new(e.z[k][i][j].clone(), e.unit.clone());
    let remainder = &e.weight[i] * sum(&e.left, i, t) * sum(&e.right, j, t)
        + &e.rounding_weight[i] * sum(&e.v, i, t) * sum(&e.rounding, j, t);
    [(z(0) + t * z(1)) * unit(), remainder * unit()]
}

#[test]
fn the_short_form_of_a_linear_family_encloses_it_closely() {
    let e = in_t();
    let [a, b] = e.short().unwrap();
    for t in [whole(0), rational(1, 3), whole(7), rational(100_001, 7)] {
        let short = a.plus_multiple(&b, &t).unwrap();
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let [value, remainder] = linear_entry(&e, &t, i, j);
            assert_close(&short, [i, j], [value, remainder]);
        }
    }
}

/// Does an entry contain the number with its radius, and hardly more?
fn assert_close(short: &Short, [i, j]: [usize; 2], [value, radius]: [Rational; 2]) {
    let [short_center, short_radius] = short.entry(i, j);
    let needed = (&value - short_center).abs() + &radius;
    let rounding = rational(1, 1 << 40) * unit();

    assert!(needed <= short_radius, "({i}, {j})");
    assert!(short_radius <= radius + rounding, "({i}, {j}) is too wide");
}

/// The formula of the module, without rounding.
fn check_short(e: Expanded, lo: &Rational, hi: &Rational) {
    let polynomial = ShortForm::of(&e).unwrap();
    let short = polynomial.ends(&e, lo, Some(hi)).unwrap();
    let own = if e.reversed {
        [hi.recip(), lo.recip()]
    } else {
        [lo.clone(), hi.clone()]
    };
    let weight = weights(&e, &own[0]);
    let d = own.each_ref().map(|t| t - &e.center);
    let reach = d[0].abs().max(d[1].abs());
    let width = &d[1] - &d[0];

    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let mut second = whole(0);
        for (k, z) in e.z.iter().enumerate().skip(2) {
            let falling = Rational::from_integer(z[i][j].abs() * k * (k - 1));
            second += falling * power(&reach, k - 2);
        }
        let scale = unit() / Rational::from_integer(e.unit.clone());
        let chord = second * &width * &width * rational(1, 8) * &scale;
        let remainder = &weight[i] * sum(&e.left, i, &reach) * sum(&e.right, j, &reach)
            + &e.rounding_weight[i] * sum(&e.v, i, &reach) * sum(&e.rounding, j, &reach);
        let radius = chord + remainder * unit();

        for (end, at) in d.iter().enumerate() {
            let of_t = if e.reversed { 1 - end } else { end };
            let mut value = whole(0);
            for (k, z) in e.z.iter().enumerate() {
                value += Rational::from_integer(z[i][j].clone()) * power(at, k);
            }
            assert_close(&short[of_t], [i, j], [value * &scale, radius.clone()]);
        }
    }
}

#[test]
fn the_short_form_of_a_polynomial_encloses_it_closely() {
    for (lo, hi) in [
        (rational(1, 7), rational(5, 3)),
        (whole(3), rational(22, 5)),
        (rational(1, 9), rational(1, 8)),
    ] {
        check_short(bent(), &lo, &hi);
        check_short(linear(), &lo, &hi);
        let reversed = Expanded {
            reversed: true,
            ..bent()
        };
        check_short(reversed, &lo, &hi);
    }
}

/// Dyadic numbers, so that short numbers cut nothing off, and no remainder.
fn exact() -> Expanded {
    let none = || vec![int(&[0, 0])];
    Expanded {
        center: whole(0),
        z: vec![square([[3, 0], [-1, 2]]), square([[5, -7], [0, 9]])],
        unit: 4.into(),
        left: none(),
        right: none(),
        v: none(),
        rounding: none(),
        ..linear()
    }
}

/// Demands that each short end holds every matrix within the radius of the long one, so that
/// whatever is proved of the short ends is proved of the long ones.
fn assert_holds_long_ends(e: &Expanded, lo: &Rational, hi: Option<&Rational>) {
    let long = e.ends(lo, hi).unwrap();
    let short = ShortForm::of(e).unwrap().ends(e, lo, hi).unwrap();
    let in_fixed_unit = |v: &Integer| Rational::new(v << FRACTION_BITS, long.scale.clone());

    for end in [0, 1] {
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let [center, radius] = short[end].entry(i, j);
            let distance = (in_fixed_unit(&long.at[end].m[i][j]) - center).abs();
            let reach = distance + in_fixed_unit(&long.at[end].r[i][j]);
            assert!(reach <= radius, "end {end}, entry ({i}, {j}), lo {lo}");
        }
    }
}

#[test]
fn short_ends_hold_the_long_ones() {
    let constant = || Expanded {
        z: vec![square([[3, 0], [-1, 2]]), square([[0, 0], [0, 0]])],
        ..exact()
    };
    let reversed = |e: Expanded| Expanded {
        reversed: true,
        ..e
    };
    let off_center = || Expanded {
        center: rational(1, 2),
        ..exact()
    };

    for (lo, hi) in [
        (rational(1, 4), rational(1, 2)),
        (whole(1), whole(8)),
        (rational(1, 7), rational(5, 3)),
    ] {
        for e in [bent(), linear(), in_t(), exact(), constant(), off_center()] {
            assert_holds_long_ends(&e, &lo, Some(&hi));
            let e = reversed(e);
            assert_holds_long_ends(&e, &lo, Some(&hi));
            assert_holds_long_ends(&e, &lo, None);
        }

        for e in [in_t(), exact()] {
            assert_holds_long_ends(&e, &lo, None);
        }
    }
}

/// A half line needs a direction; of a reversed expansion it is an interval.
#[test]
fn a_polynomial_has_no_short_form_at_infinity() {
    let ends = |e: Expanded| ShortForm::of(&e).unwrap().ends(&e, &whole(3), None);
    assert!(ends(bent()).is_none());
    assert!(ends(in_t()).is_some());

    let reversed = Expanded {
        reversed: true,
        ..bent()
    };
    assert!(ends(reversed).is_some());
}

#[test]
fn what_is_not_linear_or_has_another_center_has_no_short_form() {
    let of = |change: fn(&mut Expanded)| {
        let mut e = in_t();
        change(&mut e);
        e.short().is_some()
    };
    assert!(of(|_| {}));
    assert!(!of(|e| e.center = whole(1)));
    assert!(!of(|e| e.reversed = true));
    assert!(!of(|e| e.drift = rational(1, 9)));
    assert!(!of(|e| e.z.push(big(&[&[0, 0], &[1, 0]]))));
    assert!(!of(|e| e.right[1][1] = Integer::one()));
    assert!(!of(|e| e.left.push(vec![Integer::zero(), Integer::one()])));
}
