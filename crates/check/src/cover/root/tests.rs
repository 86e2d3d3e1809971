//! Each bound again, in rational numbers as its formula stands, on a matrix whose every entry has a
//! radius; and each decision at the last number that is refused and the first that is accepted.

use super::super::ball::BallMatrix;
use super::super::ends::LongMatrix;
use super::*;
use crate::certificate::{Root, VariableState};
use mceip_exact::{rational, whole};
use mceip_model::file::Number;
use num_traits::ToPrimitive;

/// Variables 2, 0 and 1, the pivot; variable 3 is at zero.
const SUPPORT: [usize; 3] = [2, 0, 1];
const Y_ONE: i64 = 32;
const ONE: i64 = 2;
const SCALE: i64 = 1000;

fn matrix(list: [[i64; 4]; 4]) -> LongMatrix {
    list.iter()
        .map(|row| row.iter().map(|&v| v.into()).collect())
        .collect()
}

fn balls([m0, m1]: [LongMatrix; 2], [r0, r1]: [LongMatrix; 2]) -> [BallMatrix<Integer>; 2] {
    [BallMatrix { m: m0, r: r0 }, BallMatrix { m: m1, r: r1 }]
}

/// T' = [[2, 1], [1, 3]] on (2, 0), nearly.
fn ends() -> Ends {
    let m = [
        matrix([
            [3010, -420, 1020, 310],
            [770, 2345, -1234, 88],
            [990, 1377, 2005, -71],
            [151, -333, 707, 5],
        ]),
        matrix([
            [2990, -511, 985, 290],
            [815, 3456, -1301, 93],
            [1015, 1298, 1985, -69],
            [160, -349, 688, 6],
        ]),
    ];
    let r = [
        matrix([[3, 7, 2, 4], [5, 11, 6, 1], [2, 9, 8, 3], [13, 4, 5, 2]]),
        matrix([[4, 5, 3, 1], [7, 6, 9, 2], [3, 8, 5, 6], [11, 2, 7, 3]]),
    ];
    Ends {
        at: balls(m, r),
        slope: Some(matrix([
            [6, 9, 4, 1],
            [8, 7, 3, 2],
            [5, 2, 10, 3],
            [1, 1, 1, 1],
        ])),
        scale: SCALE.into(),
        infinite: false,
    }
}

fn inverse() -> LongMatrix {
    vec![
        vec![19.into(), Integer::from(-7)],
        vec![Integer::from(-6), 13.into()],
    ]
}

/// u and v.
const VECTORS: [&[i64]; 2] = [&[1, -3, ONE], &[-5, 3, ONE]];

fn witness(y: &LongMatrix) -> Bordered<'_> {
    Bordered::of_numbers(&SUPPORT, (y, Y_ONE), VECTORS, ONE)
}

fn rational_of(v: &Integer) -> Rational {
    Rational::from_integer(v.clone())
}

/// An entry among the variables of the support and its radius, as real numbers.
fn entry(e: &Ends, end: usize, i: usize, j: usize) -> (Rational, Rational) {
    let of = |m: &LongMatrix| rational_of(&m[SUPPORT[i]][SUPPORT[j]]) / whole(SCALE);
    (of(&e.at[end].m), of(&e.at[end].r))
}

fn inverse_entry(i: usize, k: usize) -> Rational {
    rational_of(&inverse()[i][k]) / whole(Y_ONE)
}

fn largest(list: impl Iterator<Item = Rational>) -> Rational {
    list.max().unwrap()
}

fn norm(e: &Ends, is_right: bool) -> Rational {
    let row = |end: usize, i: usize| -> Rational {
        let cell = |j: usize| {
            let term = |k: usize| {
                if is_right {
                    (inverse_entry(i, k), entry(e, end, k, j))
                } else {
                    (inverse_entry(k, i), entry(e, end, j, k))
                }
            };
            let product: Rational = (0..2).map(|k| term(k).0 * term(k).1.0).sum();
            let radius: Rational = (0..2).map(|k| term(k).0.abs() * term(k).1.1).sum();
            (product - whole(i64::from(i == j))).abs() + radius
        };
        cell(0) + cell(1)
    };
    largest(
        (0..2)
            .flat_map(|end| (0..2).map(move |i| (end, i)))
            .map(|(end, i)| row(end, i)),
    )
}

fn residual(
    s: &Bordered<'_>,
    e: &Ends,
    end: usize,
    is_right: bool,
    i: usize,
) -> (Rational, Rational) {
    let term = |j: usize| {
        if is_right {
            (rational_of(&s.v[j]) / whole(ONE), entry(e, end, i, j))
        } else {
            (rational_of(&s.u[j]) / whole(ONE), entry(e, end, j, i))
        }
    };
    (
        (0..3).map(|j| term(j).0 * term(j).1.0).sum(),
        (0..3).map(|j| term(j).0.abs() * term(j).1.1).sum(),
    )
}

fn error_at(s: &Bordered<'_>, e: &Ends, end: usize, is_right: bool, norm: &Rational) -> Rational {
    let row = |i: usize| -> Rational {
        let entry = |k: usize| {
            if is_right {
                inverse_entry(i, k)
            } else {
                inverse_entry(k, i)
            }
        };
        let sum: Rational = (0..2)
            .map(|k| entry(k) * residual(s, e, end, is_right, k).0)
            .sum();
        let radius: Rational = (0..2)
            .map(|k| entry(k).abs() * residual(s, e, end, is_right, k).1)
            .sum();
        sum.abs() + radius
    };
    largest((0..2).map(row)) / (whole(1) - norm)
}

#[test]
fn norms_and_errors_are_those_of_the_formulas() {
    let y = inverse();
    let s = witness(&y);
    let mut swapped = ends();
    swapped.at.swap(0, 1);
    for e in [ends(), swapped] {
        let blocks = blocks(&s, &e);

        let rho = norm(&e, true);
        assert!(rho < whole(1));
        assert_eq!(s.norm(&blocks).unwrap(), rho);
        let at = [0, 1].map(|end| error_at(&s, &e, end, true, &rho));
        assert_eq!(s.error(&blocks[..1], &rho), at[0]);
        assert_eq!(s.error(&blocks[1..], &rho), at[1]);
        assert_eq!(s.error(&blocks, &rho), largest(at.into_iter()));

        let eta = norm(&e, false);
        assert!(eta < whole(1));
        let at = [0, 1].map(|end| error_at(&s, &e, end, false, &eta));
        assert_eq!(s.left_error(&blocks).unwrap(), largest(at.into_iter()));

        for (end, block) in blocks.iter().enumerate() {
            let unit = whole(ONE * SCALE);
            for (is_right, got) in [(true, s.products(block)), (false, s.left_products(block))] {
                for (i, ball) in got[..2].iter().enumerate() {
                    let got = [&ball.center, &ball.radius].map(|v| rational_of(v) / &unit);
                    assert_eq!(
                        (got[0].clone(), got[1].clone()),
                        residual(&s, &e, end, is_right, i)
                    );
                }
            }
        }
    }
}

/// The pivot alone: T' is empty, the norm and the errors are nothing.
#[test]
fn one_variable_needs_no_inverse() {
    let none: LongMatrix = vec![];
    let s = Bordered::of_numbers(&[1], (&none, 1), [&[ONE], &[ONE]], ONE);
    let e = ends();
    let blocks = blocks(&s, &e);
    assert_eq!(s.norm(&blocks).unwrap(), whole(0));
    assert_eq!(s.left_error(&blocks).unwrap(), whole(0));
    assert_eq!(schur_sign(&s, &blocks[0], &whole(0)), 1);
}

#[test]
fn a_norm_of_one_is_not_regular() {
    let y = vec![vec![0.into(), 0.into()], vec![0.into(), 0.into()]];
    let s = witness(&y);
    let e = ends();
    let blocks = blocks(&s, &e);
    assert!(s.left_error(&blocks).is_err());
    let got = s.norm(&blocks);
    assert!(matches!(got, Err(CoverFault::NotRegular { got }) if got == whole(1)));
}

/// phi at an end and its radius, both times one^2 scale.
fn phi(s: &Bordered<'_>, e: &Ends, end: usize, norm: &Rational) -> (Integer, Integer) {
    let pairs = || (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
    let value: Integer = pairs()
        .map(|(i, j)| &s.u[i] * &e.at[end].m[SUPPORT[i]][SUPPORT[j]] * &s.v[j])
        .sum();
    let around: Integer = pairs()
        .map(|(i, j)| s.u[i].abs() * &e.at[end].r[SUPPORT[i]][SUPPORT[j]] * s.v[j].abs())
        .sum();
    let left: Rational = (0..2)
        .map(|i| residual(s, e, end, false, i))
        .map(|(value, radius)| value.abs() + radius)
        .sum();
    let second = left * error_at(s, e, end, true, norm) * whole(ONE * ONE * SCALE);
    (value, around + second.ceil().to_integer())
}

/// The pivot's own entry moves phi and nothing else: the sign turns where phi leaves its radius.
#[test]
fn the_schur_complement_has_a_sign_beyond_its_radius_only() {
    let y = inverse();
    let s = witness(&y);
    let (rho, step) = (norm(&ends(), true), Integer::from(ONE * ONE));
    let of = |end: usize, shift: &Integer| {
        let mut e = ends();
        e.at[end].m[1][1] += shift;
        let (value, radius) = phi(&s, &e, end, &rho);
        (
            schur_sign(&s, &blocks(&s, &e)[end], &rho),
            value - &radius,
            radius,
        )
    };
    for end in 0..2 {
        let (_, over, radius) = of(end, &Integer::zero());
        let to_edge = -over / &step;
        for (shift, sign) in [(-3, 0), (-1, 0), (2, 1)] {
            let (got, over, _) = of(end, &(&to_edge + shift));
            assert_eq!((got, over.is_positive()), (sign, sign == 1), "end {end}");
        }
        let to_edge = &to_edge - (&radius * 2 / &step);
        assert_eq!(
            [of(end, &(&to_edge + 2)).0, of(end, &(&to_edge - 3)).0],
            [0, -1],
            "end {end}"
        );
    }
}

#[test]
fn at_its_radius_the_schur_complement_has_no_sign() {
    // No inverse is needed for one variable: phi = one^2 m, its radius one^2 r.
    let none: LongMatrix = vec![];
    let s = Bordered::of_numbers(&[1], (&none, 1), [&[1], &[1]], 1);
    let mut e = ends();
    let mut sign = |m: i64, r: i64| {
        (e.at[0].m[1][1], e.at[0].r[1][1]) = (m.into(), r.into());
        schur_sign(&s, &blocks(&s, &e)[0], &whole(0))
    };
    assert_eq!(
        [
            sign(11, 10),
            sign(10, 10),
            sign(-10, 10),
            sign(-11, 10),
            sign(1, 0),
            sign(0, 0)
        ],
        [1, 0, 0, -1, 1, 0]
    );
}

/// slope and radius of the derivative of phi, times one^2 scale.
fn derivative(s: &Bordered<'_>, e: &Ends, left: i64, right: i64) -> (i64, i64) {
    let mut slope = 0;
    let mut radius = 0;
    let short = |v: &Integer| v.to_i64().unwrap();
    for i in 0..3 {
        for j in 0..3 {
            let d = short(&e.at[1].m[SUPPORT[i]][SUPPORT[j]])
                - short(&e.at[0].m[SUPPORT[i]][SUPPORT[j]]);
            let around = short(&e.slope.as_ref().unwrap()[SUPPORT[i]][SUPPORT[j]]);
            let u = short(&s.u[i]);
            let v = short(&s.v[j]);
            let a = if i == 2 { 0 } else { left };
            let b = if j == 2 { 0 } else { right };
            slope += u * d * v;
            // (|d| + around) (|u| + a) (|v| + b) less |d| |u| |v|.
            radius +=
                (d.abs() + around) * (u.abs() + a) * (v.abs() + b) - d.abs() * u.abs() * v.abs();
        }
    }
    (slope, radius)
}

#[test]
fn the_derivative_has_a_sign_beyond_its_radius_only() {
    let y = inverse();
    // Components of one unit, so that every unit of the radius tells.
    let mut s = witness(&y);
    (s.u, s.v, s.one) = (
        [3, -4, 1].map(Integer::from).to_vec(),
        [-5, 2, 1].map(Integer::from).to_vec(),
        1.into(),
    );
    for (one, left, right) in [
        (1, 0, 0),
        (1, 2, 0),
        (1, 0, 3),
        (1, 5, 7),
        (2, 10, 4),
        (3, 4, 5),
    ] {
        s.one = one.into(); // errors are in units of u and v
        let (e_u, e_v) = (rational(left, one), rational(right, one));
        let mut e = ends();
        let mut at = |pivot: i64, around: i64| {
            e.at[1].m[1][1] = &e.at[0].m[1][1] + pivot;
            e.slope.as_mut().unwrap()[1][1] = around.into();
            (
                derivative(&s, &e, left, right),
                is_monotone(&s, &e, &e_u, &e_v),
            )
        };
        let ((slope, radius), _) = at(0, 7);
        for sign in [1, -1] {
            let edge = sign * radius - slope;
            let ((s0, r0), accepted) = at(edge, 7);
            assert_eq!((s0.abs(), accepted), (r0, false));
            assert!(at(edge + sign, 7).1 && !at(edge - sign, 7).1);
            assert!(!at(edge + sign, 8).1);
        }
        // A little more of the error, and it is refused: errors are rounded up.
        at(radius - slope + 1, 7);
        let more = |e: &Rational| e + rational(1, 1000);
        assert!(is_monotone(&s, &e, &e_u, &e_v));
        assert!(!is_monotone(&s, &e, &more(&e_u), &e_v) && !is_monotone(&s, &e, &e_u, &more(&e_v)));
    }
}

/// Row 3 of T v: the pivot's entry moves it and not its radius.
#[test]
fn a_resting_row_has_a_sign_beyond_its_radius_only() {
    let y = inverse();
    let mut s = witness(&y);
    (s.v, s.one) = ([-5, 2, 1].map(Integer::from).to_vec(), 1.into());
    let index = [0, 1, 2, 3];
    let region = region();
    for (end, error) in [(0, 0), (1, 0), (0, 4), (1, 9)] {
        let mut e = ends();
        let entry = |e: &Ends, j: usize| e.at[end].m[3][SUPPORT[j]].to_i64().unwrap();
        let radius_of = |e: &Ends, j: usize| e.at[end].r[3][SUPPORT[j]].to_i64().unwrap();
        let radius = 5 * radius_of(&e, 0)
            + 2 * radius_of(&e, 1)
            + radius_of(&e, 2)
            + error
                * (entry(&e, 0).abs() + radius_of(&e, 0) + entry(&e, 1).abs() + radius_of(&e, 1));
        let others = -5 * entry(&e, 0) + 2 * entry(&e, 1);
        let mut sign = |value: i64| {
            e.at[end].m[3][1] = (value - others).into();
            // The same at the other end: y has a sign if it is that of both.
            e.at[1 - end] = e.at[end].clone();
            let candidate = NullVectorCandidate {
                witness: &s,
                ends: &e,
                error: whole(error),
                region: &region,
                index: &index,
                vanishing: &[],
            };
            candidate.y_sign(3)
        };
        assert_eq!(
            [radius + 1, radius, -radius, -radius - 1].map(&mut sign),
            [1, 0, 0, -1],
            "end {end}"
        );
    }
}

fn root(outcome: RootOutcome) -> Root {
    let zero = || Number(whole(0));
    Root {
        pivot: 11,
        interval: [zero(), zero()],
        inverse: vec![vec![1.into()]],
        inverse_exponent: 0,
        left: vec![0.into()],
        right: vec![0.into()],
        exponent: 1,
        outcome,
    }
}

const INDEX: [usize; 3] = [10, 11, 12];

fn region() -> Region {
    let mut region = Region::new(whole(0).into(), Some(whole(1).into()), None, 0);
    region.states = vec![
        VariableState::InSupport,
        VariableState::InSupport,
        VariableState::AtZero,
    ];
    region
}

/// T = [[1, a, .], [0, t, .], [b, c, .]] with t from one value to another: x = (-a, 1), y_3 = c - a
/// b.
fn simple(t: [i64; 2], a: i64, b: i64, c: [i64; 2]) -> Ends {
    let at_end = |k: usize| -> LongMatrix {
        [[1, a, 0], [0, t[k], 0], [b, c[k], 0]]
            .iter()
            .map(|r| r.map(Integer::from).to_vec())
            .collect()
    };
    let zero = || vec![vec![Integer::zero(); 3]; 3];
    Ends {
        at: balls([at_end(0), at_end(1)], [zero(), zero()]),
        slope: Some(zero()),
        scale: 1.into(),
        infinite: false,
    }
}

fn verdict(outcome: RootOutcome, wide: &Ends, narrow: &Ends, x: i64) -> Result<(), CoverFault> {
    let mut root = root(outcome);
    root.right = vec![(2 * x).into()];
    check(&region(), wide, || Ok(narrow.clone()), &INDEX, &[], &root)
}

#[test]
fn absent_means_the_same_sign_at_both_ends() {
    let absent = |t: [i64; 2]| {
        verdict(
            RootOutcome::Absent,
            &simple(t, 0, 0, [1, 1]),
            &simple([0, 0], 0, 0, [1, 1]),
            0,
        )
    };
    assert_eq!([absent([2, 5]), absent([-5, -2])], [Ok(()), Ok(())]);
    for t in [[-2, 5], [2, 0], [0, 2], [5, -2]] {
        assert_eq!(absent(t), Err(CoverFault::SignChange), "{t:?}");
    }
}

#[test]
fn a_root_lies_where_the_sign_changes() {
    let wide = simple([-9, 9], 0, 0, [1, 1]);
    let found = |t: [i64; 2]| verdict(RootOutcome::Solution, &wide, &simple(t, -1, 0, [1, 1]), 1);
    assert_eq!([found([-1, 1]), found([1, -1])], [Ok(()), Ok(())]);
    for t in [[1, 2], [-2, -1], [0, 1], [1, 0], [-1, 0]] {
        assert!(
            matches!(found(t), Err(CoverFault::NoSignChange { .. })),
            "{t:?}"
        );
    }
}

/// Which component is said to be negative, and of which sign it is.
#[test]
fn signs_of_x_and_y_are_those_stated() {
    let wide = simple([-9, 9], 0, 0, [1, 1]);
    let of = |outcome, a: i64, b: i64, c: [i64; 2]| {
        verdict(outcome, &wide, &simple([-1, 1], a, b, c), -a)
    };
    let fault = |component, index, expected| {
        Err(CoverFault::Sign {
            component,
            index,
            expected,
        })
    };
    assert_eq!(of(RootOutcome::Solution, -1, 0, [1, 1]), Ok(()));
    assert_eq!(
        of(RootOutcome::Solution, 1, 0, [1, 1]),
        fault("x", 10, "> 0")
    );
    assert_eq!(
        of(RootOutcome::Solution, 0, 0, [1, 1]),
        fault("x", 10, "> 0")
    );
    for c in [[-1, -1], [1, -1], [-1, 1], [0, 0], [1, 0]] {
        assert_eq!(
            of(RootOutcome::Solution, -1, 0, c),
            fault("y", 12, "> 0"),
            "{c:?}"
        );
    }
    // A negative x or y: the component named, moving or resting, is negative and no other will do.
    assert_eq!(of(RootOutcome::NegativeX(10), 1, 0, [1, 1]), Ok(()));
    for (index, a) in [(10, -1), (10, 0), (11, 1), (12, 1), (13, 1)] {
        assert_eq!(
            of(RootOutcome::NegativeX(index), a, 0, [-1, -1]),
            fault("x", index, "< 0"),
            "{index} {a}"
        );
    }
    assert_eq!(of(RootOutcome::NegativeY(12), -1, 0, [-1, -1]), Ok(()));
    for (index, c) in [
        (12, [1, 1]),
        (12, [-1, 1]),
        (12, [1, -1]),
        (12, [0, 0]),
        (13, [-1, -1]),
    ] {
        assert_eq!(
            of(RootOutcome::NegativeY(index), -1, 0, c),
            fault("y", index, "< 0"),
            "{index} {c:?}"
        );
    }
}

/// Is it a solution? The error is in units of v.
fn outcome(
    witness: &Bordered<'_>,
    ends: &Ends,
    error: Rational,
    vanishing: &[usize],
) -> Result<(), CoverFault> {
    let candidate = NullVectorCandidate {
        witness,
        ends,
        error,
        region: &region(),
        index: &INDEX,
        vanishing,
    };
    candidate.check_outcome(&RootOutcome::Solution)
}

/// The error counts for every component but the pivot's, which is 1 and exact.
#[test]
fn components_are_positive_beyond_the_error_only() {
    let y: LongMatrix = vec![vec![1.into()]];
    let ends = simple([-1, 1], 0, 0, [100, 100]);
    let solution = |x: i64, one: i64, error: Rational| {
        let s = Bordered::of_numbers(&[0, 1], (&y, 1), [&[x, one]; 2], one);
        outcome(&s, &ends, error * whole(one), &[])
    };
    let fault = Err(CoverFault::Sign {
        component: "x",
        index: 10,
        expected: "> 0",
    });
    // In units of 1/2 an error of 3/2 is 3, and one of 5/4 is 5/2: it is not rounded.
    for (error, least) in [(rational(3, 2), 4), (rational(5, 4), 3)] {
        assert_eq!(
            [
                solution(least, 2, error.clone()),
                solution(least - 1, 2, error)
            ],
            [Ok(()), fault.clone()]
        );
    }
}

/// y is zero on the rows of the support: a row of the block that is negative by rounding is no
/// negative y.
#[test]
fn a_moving_row_is_no_negative_y() {
    let wide = simple([-9, 9], 0, 0, [1, 1]);
    let mut narrow = simple([-1, 1], 0, 0, [1, 1]);
    narrow.at[0].m[0] = [1, -3, 0].map(Integer::from).to_vec();
    narrow.at[1].m[0] = [1, -3, 0].map(Integer::from).to_vec();
    let got = verdict(RootOutcome::NegativeY(10), &wide, &narrow, -1);
    assert_eq!(
        got,
        Err(CoverFault::Sign {
            component: "y",
            index: 10,
            expected: "< 0"
        })
    );
}

/// A solution needs no sign of a row that vanishes, and the sign of every other row at rest.
#[test]
fn a_row_that_vanishes_needs_no_sign() {
    let y: LongMatrix = vec![vec![1.into()]];
    let ends = simple([-1, 1], 0, 0, [0, 0]);
    let witness = Bordered::of_numbers(&[0, 1], (&y, 1), [&[1, 1]; 2], 1);
    let solution = |vanishing: &[usize]| outcome(&witness, &ends, rational(1, 2), vanishing);

    assert_eq!(solution(&[INDEX[2]]), Ok(()));
    for others in [&[][..], &[INDEX[0], INDEX[1]]] {
        let fault = CoverFault::Sign {
            component: "y",
            index: INDEX[2],
            expected: "> 0",
        };
        assert_eq!(solution(others), Err(fault));
    }
}
