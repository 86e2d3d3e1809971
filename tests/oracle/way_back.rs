//! Lifting, the lines of (9) and the projection for an oblique particle: directions (3/5, 4/5),
//! friction 1/5, so that every number has a denominator. By hand.
#![cfg(feature = "solver")]

use mceip_engine::reduction::{
    Lifted, Line, Projected, check_lines, condense, lift, project, reduce,
};
use mceip_exact::{Algebraic, Poly, Rational, Sparse, rational, whole};
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};

/// Dof 0 is free; the particle slips on (1, 2) with sign S.
fn system(sign: i8) -> System {
    let (r, w) = (rational, whole);
    let k = [
        [w(7), r(1, 2), w(1)],
        [r(1, 2), w(9), r(1, 3)],
        [w(1), r(1, 3), w(11)],
    ];
    let m = [
        [w(2), w(0), w(0)],
        [w(0), r(1, 7), w(0)],
        [w(0), w(0), r(1, 7)],
    ];
    let sparse = |m: &[[Rational; 3]; 3]| {
        Sparse::from_entries(
            3,
            3,
            (0..3)
                .flat_map(|i| (0..3).map(move |j| (i, j)))
                .map(|(i, j)| (i, j, m[i][j].clone()))
                .collect::<Vec<_>>(),
        )
    };
    let frame = Some([[r(3, 5), r(4, 5)], [r(-4, 5), r(3, 5)]]);
    let particle = Particle {
        frame,
        ..Particle::plain(1, 2, ContactState::Slip { sign })
    };
    System::new(sparse(&k), Some(sparse(&m)), Some(r(1, 5)), vec![particle]).unwrap()
}

fn problem(sign: i8, unknown: Unknown) -> Problem {
    Problem::new(Body::System(system(sign)), unknown, Window::all()).unwrap()
}

fn at(p: &Poly, t: i64, scale: &mceip_exact::Integer) -> Rational {
    p.eval(&whole(t)) / Rational::from_integer(scale.clone())
}

/// x = (2, 5 t): v = (2, -S 3 t, -S 4 t), w = (K + t M) v, both at t = 3 after their scales are
/// taken off.
#[test]
fn a_lifted_vector_is_v_and_w_over_its_scales() {
    for sign in [1, -1] {
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let p = problem(sign, unknown);
            let variables = reduce(&p).unwrap().variables;
            let x = [Poly::from_ints(&[2]), Poly::from_ints(&[1, 4])];
            let l = lift(&system(sign), unknown, &variables, &x);
            let s = whole(sign.into());
            let v = [whole(2), rational(-39, 5) * &s, rational(-52, 5) * &s]; // 1 + 4 t = 13
            let got: Vec<Rational> = l.v.iter().map(|p| at(p, 3, &l.v_scale)).collect();
            assert_eq!(got, v);
            let mass = if unknown == Unknown::Lambda2 {
                whole(3)
            } else {
                whole(0)
            };
            let matrix = system(sign)
                .stiffness()
                .add_scaled(&mass, system(sign).mass().unwrap());
            let got: Vec<Rational> = l.w.iter().map(|p| at(p, 3, &l.w_scale)).collect();
            assert_eq!(got, matrix.times(&v));
            assert!(l.v_scale == 5.into() && l.w_scale > l.v_scale);
        }
    }
}

fn lines(sign: i8, v: [i64; 3], w: [i64; 3]) -> Option<Line> {
    let constant = |v: [i64; 3]| v.map(|c| Poly::from_ints(&[c])).to_vec();
    let lifted = Lifted {
        v: constant(v),
        v_scale: 1.into(),
        w: constant(w),
        w_scale: 1.into(),
    };
    check_lines(
        &system(sign),
        Unknown::Lambda2,
        &lifted,
        &mut Algebraic::rational(whole(1)),
    )
    .err()
    .map(|e| e.line)
}

/// v_T = -5, v_N = 0; w_T = -5, w_N = 25: S w_T + w_N / 5 = 0 for S = 1.
#[test]
fn the_lines_hold_to_the_last_unit() {
    assert_eq!(lines(1, [7, -3, -4], [0, -23, 11]), None);
    assert_eq!(lines(1, [0, -3, -4], [0, -23, 11]), None);
    assert_eq!(lines(1, [7, 0, 0], [0, -24, 11]), None); // at rest within the cone
    assert_eq!(
        lines(1, [0, -3, -4], [0, -23, 12]),
        Some(Line::FrictionCone)
    );
    assert_eq!(
        lines(1, [0, -3, -4], [0, -23, 10]),
        Some(Line::Complementarity)
    );
    assert_eq!(lines(1, [0, 3, 4], [0, -23, 11]), Some(Line::SlipDirection));
    assert_eq!(lines(1, [0, -3, -5], [0, -23, 11]), Some(Line::NormalRate));
    assert_eq!(lines(1, [0, -4, -4], [0, -23, 11]), Some(Line::NormalRate));
    assert_eq!(
        lines(1, [0, -3, -4], [1, -23, 11]),
        Some(Line::FreeReaction)
    );
    assert_eq!(lines(1, [0, 0, 0], [0, 0, 0]), Some(Line::NonTrivial));
    // S = -1: v_T = 5 and w_T = 5, w_N = 25: t + 5 n = (3/5 - 4, 4/5 + 3) times 5.
    assert_eq!(lines(-1, [0, 3, 4], [0, -17, 19]), None);
    assert_eq!(
        lines(-1, [0, 3, 4], [0, -17, 20]),
        Some(Line::Complementarity)
    );
    assert_eq!(lines(-1, [0, 3, 4], [0, -18, 19]), Some(Line::FrictionCone));
    assert_eq!(
        lines(-1, [0, -3, -4], [0, -17, 19]),
        Some(Line::SlipDirection)
    );
}

/// x = (v_0, -S v_T); what is left of v is its normal part, and the largest component of that is
/// named.
#[test]
fn a_projection_takes_the_tangential_part_off() {
    for sign in [1, -1] {
        let variables = reduce(&problem(sign, Unknown::Mu)).unwrap().variables;
        let of = |v: [i64; 3]| project(&variables, &v.map(whole));
        let s = i64::from(sign);
        assert_eq!(
            of([2, 3, 4]),
            Projected {
                x: vec![whole(2), whole(-5 * s)],
                off: None
            }
        );
        // (3, 4) + (-4, 3): the normal part is 5 along (-4/5, 3/5), 4 of a largest component 7.
        assert_eq!(
            of([2, -1, 7]),
            Projected {
                x: vec![whole(2), whole(-5 * s)],
                off: Some((1, rational(4, 7)))
            }
        );
        assert_eq!(of([-9, -1, 7]).off, Some((1, rational(4, 9))));
        assert_eq!(
            of([0, 0, 0]),
            Projected {
                x: vec![whole(0), whole(0)],
                off: None
            }
        );
    }
}

/// One free and one slip variable: A' = a_ss - a_sf a_fs / a_ff.
#[test]
fn one_slip_variable_is_condensed() {
    let a = Sparse::from_ints(&[&[4, 2], &[2, 5]]);
    let b = Sparse::from_ints(&[&[0, 0], &[6, 7]]);
    let pencil = mceip_model::Pencil::new(a, b, vec![0]).unwrap();
    let small = condense(&mceip_model::Admissible::new(&pencil, Unknown::Mu).unwrap()).unwrap();
    assert_eq!(
        (small.a().get(0, 0), small.b().get(0, 0)),
        (whole(4), whole(4))
    );
}
