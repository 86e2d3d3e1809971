//! The way from a solution x of the pencil back to the mechanical system, for an oblique particle.
//!
//! `lift` makes v and w of x, `check_lines` examines the lines of (9), `project` makes x of v, and
//! `condense` eliminates the free variables. The truth is worked by hand: the directions of the
//! particle are (3/5, 4/5) and (-4/5, 3/5), the friction coefficient is 1/5, so that every number
//! has a denominator and a forgotten scale shows.
#![cfg(feature = "solver")]

use crate::small::constants;
use mceip_engine::reduction::{Projected, condense, project};
use mceip_exact::{Algebraic, Integer, Poly, Rational, Sparse, rational, whole};
use mceip_model::reduction::{Lifted, Line, check_lines, lift, reduce};
use mceip_model::{
    Admissible, Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window,
};

fn matrix_of_order_3(rows: &[[Rational; 3]; 3]) -> Sparse {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            entries.push((i, j, value.clone()));
        }
    }
    Sparse::from_entries(3, 3, entries)
}

/// Dof 0 is free; the particle slips on (1, 2) with sign S.
fn system(sign: i8) -> System {
    let stiffness = matrix_of_order_3(&[
        [whole(7), rational(1, 2), whole(1)],
        [rational(1, 2), whole(9), rational(1, 3)],
        [whole(1), rational(1, 3), whole(11)],
    ]);
    let mass = matrix_of_order_3(&[
        [whole(2), whole(0), whole(0)],
        [whole(0), rational(1, 7), whole(0)],
        [whole(0), whole(0), rational(1, 7)],
    ]);
    let friction = rational(1, 5);

    let tangential = [rational(3, 5), rational(4, 5)];
    let normal = [rational(-4, 5), rational(3, 5)];
    let particle = Particle {
        frame: Some([tangential, normal]),
        ..Particle::plain(1, 2, ContactState::Slip { sign })
    };

    System::new(stiffness, Some(mass), Some(friction), vec![particle]).unwrap()
}

fn problem(sign: i8, unknown: Unknown) -> Problem {
    let body = Body::System(system(sign));
    Problem::new(body, unknown, Window::all()).unwrap()
}

/// The values at t of polynomials that share a scale.
fn values_at(polynomials: &[Poly], t: i64, scale: &Integer) -> Vec<Rational> {
    let scale = Rational::from_integer(scale.clone());
    polynomials
        .iter()
        .map(|p| p.eval(&whole(t)) / &scale)
        .collect()
}

/// x = (2, 1 + 4 t): v = (2, -S 3/5 (1 + 4 t), -S 4/5 (1 + 4 t)), w = (K + t M) v, or K v if mu is
/// the unknown; both at t = 3 after their scales are taken off.
#[test]
fn a_lifted_vector_is_v_and_w_over_its_scales() {
    for sign in [1, -1] {
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let variables = reduce(&problem(sign, unknown)).unwrap().variables;
            let x = [Poly::from_ints(&[2]), Poly::from_ints(&[1, 4])];

            let lifted = lift(&system(sign), unknown, &variables, &x);

            // 1 + 4 t = 13.
            let s = whole(sign.into());
            let v = [whole(2), rational(-39, 5) * &s, rational(-52, 5) * &s];
            assert_eq!(values_at(&lifted.v, 3, &lifted.v_scale), v);

            let factor_of_mass = match unknown {
                Unknown::Lambda2 => whole(3),
                Unknown::Mu | Unknown::Eigenvalue => whole(0),
            };
            let system = system(sign);
            let mass = system.mass().unwrap();
            let matrix = system.stiffness().add_scaled(&factor_of_mass, mass);
            assert_eq!(values_at(&lifted.w, 3, &lifted.w_scale), matrix.times(&v));

            assert_eq!(lifted.v_scale, 5.into());
            assert!(lifted.w_scale > lifted.v_scale);
        }
    }
}

/// The first line of (9) that v and w break, if any, for the particle that slips with this sign.
fn broken_line(sign: i8, v: [i64; 3], w: [i64; 3]) -> Option<Line> {
    let lifted = Lifted {
        v: constants(&v),
        v_scale: 1.into(),
        w: constants(&w),
        w_scale: 1.into(),
    };
    let mut value = Algebraic::rational(whole(1));

    let checked = check_lines(&system(sign), Unknown::Lambda2, &lifted, &mut value);
    checked.err().map(|error| error.line)
}

/// v_T = -5, v_N = 0; w_T = -5, w_N = 25: S w_T + w_N / 5 = 0 for S = 1.
#[test]
fn the_lines_hold_to_the_last_unit() {
    assert_eq!(broken_line(1, [7, -3, -4], [0, -23, 11]), None);
    assert_eq!(broken_line(1, [0, -3, -4], [0, -23, 11]), None);

    // At rest within the cone.
    assert_eq!(broken_line(1, [7, 0, 0], [0, -24, 11]), None);

    let forged = broken_line(1, [0, -3, -4], [0, -23, 12]);
    assert_eq!(forged, Some(Line::FrictionCone));
    let forged = broken_line(1, [0, -3, -4], [0, -23, 10]);
    assert_eq!(forged, Some(Line::Complementarity));
    let forged = broken_line(1, [0, 3, 4], [0, -23, 11]);
    assert_eq!(forged, Some(Line::SlipDirection));
    let forged = broken_line(1, [0, -3, -5], [0, -23, 11]);
    assert_eq!(forged, Some(Line::NormalRate));
    let forged = broken_line(1, [0, -4, -4], [0, -23, 11]);
    assert_eq!(forged, Some(Line::NormalRate));
    let forged = broken_line(1, [0, -3, -4], [1, -23, 11]);
    assert_eq!(forged, Some(Line::FreeReaction));
    let forged = broken_line(1, [0, 0, 0], [0, 0, 0]);
    assert_eq!(forged, Some(Line::NonTrivial));

    // S = -1: v_T = 5 and w_T = 5, w_N = 25: t + 5 n = (3/5 - 4, 4/5 + 3) times 5.
    assert_eq!(broken_line(-1, [0, 3, 4], [0, -17, 19]), None);

    let forged = broken_line(-1, [0, 3, 4], [0, -17, 20]);
    assert_eq!(forged, Some(Line::Complementarity));
    let forged = broken_line(-1, [0, 3, 4], [0, -18, 19]);
    assert_eq!(forged, Some(Line::FrictionCone));
    let forged = broken_line(-1, [0, -3, -4], [0, -17, 19]);
    assert_eq!(forged, Some(Line::SlipDirection));
}

/// x = (v_0, -S v_T); what is left of v is its normal part, and the largest component of that is
/// named.
#[test]
fn a_projection_takes_the_tangential_part_off() {
    for sign in [1, -1] {
        let variables = reduce(&problem(sign, Unknown::Mu)).unwrap().variables;
        let s = i64::from(sign);
        let x = vec![whole(2), whole(-5 * s)];

        let tangential = project(&variables, &[2, 3, 4].map(whole));
        let expected = Projected {
            x: x.clone(),
            off: None,
        };
        assert_eq!(tangential, expected);

        // (3, 4) + (-4, 3): the normal part is 5 along (-4/5, 3/5), 4 of a largest component 7.
        let with_normal_part = project(&variables, &[2, -1, 7].map(whole));
        let expected = Projected {
            x,
            off: Some((1, rational(4, 7))),
        };
        assert_eq!(with_normal_part, expected);

        let with_large_free_part = project(&variables, &[-9, -1, 7].map(whole));
        assert_eq!(with_large_free_part.off, Some((1, rational(4, 9))));

        let zero = project(&variables, &[0, 0, 0].map(whole));
        let expected = Projected {
            x: vec![whole(0), whole(0)],
            off: None,
        };
        assert_eq!(zero, expected);
    }
}

/// One free and one slip variable: A' = a_ss - a_sf a_fs / a_ff = 5 - 2 * 2 / 4 = 4, and
/// B' = 7 - 6 * 2 / 4 = 4.
#[test]
fn one_slip_variable_is_condensed() {
    let a = Sparse::from_ints(&[&[4, 2], &[2, 5]]);
    let b = Sparse::from_ints(&[&[0, 0], &[6, 7]]);
    let free = vec![0];
    let pencil = Pencil::new(a, b, free).unwrap();

    let admissible = Admissible::new(&pencil, Unknown::Mu).unwrap();
    let condensed = condense(&admissible).unwrap();

    assert_eq!(condensed.a().get(0, 0), whole(4));
    assert_eq!(condensed.b().get(0, 0), whole(4));
}
