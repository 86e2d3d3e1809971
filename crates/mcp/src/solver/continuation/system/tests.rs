//! The equations and their correction at every limit.

use super::super::super::probe::{bounded, free};
use super::*;
use crate::mcp::LinearMcp;
use nalgebra::dvector;

fn problem(n: usize, l: &[f64], u: &[f64]) -> LinearMcp {
    LinearMcp::new(
        DMatrix::identity(n, n),
        vec![0.0; n],
        l.to_vec(),
        u.to_vec(),
    )
    .unwrap()
}

/// Bounds [0, 4], 4 = 4 and [-inf, 4] for each of the columns below.
#[test]
fn places_follow_the_bounds() {
    let p = problem(
        5,
        &[0.0, 0.0, 0.0, 4.0, f64::NEG_INFINITY],
        &[4.0, 4.0, 4.0, 4.0, 4.0],
    );
    let at = Places::at_bounds(&p, &dvector![0.0, 4.0, 1.0, 4.0, 4.0]);

    assert_eq!(
        at.0,
        [
            ActiveBound::Lower,
            ActiveBound::Upper,
            ActiveBound::None,
            ActiveBound::Fixed,
            ActiveBound::Upper
        ]
    );
    assert_eq!(at.inside(), [2]);
}

/// Nearer to a bound than F to zero: on the bound.
#[test]
fn places_of_a_solution_are_those_of_strict_complementarity() {
    let p = problem(1, &[0.0], &[4.0]);
    let place = |z: f64, f: f64| {
        Places::at_solution(
            &p,
            &Point {
                z: dvector![z],
                f: dvector![f],
                merit: 0.0,
            },
        )
        .0[0]
    };

    assert_eq!(place(1e-9, 1.0), ActiveBound::Lower);
    assert_eq!(place(1.0, 1e-9), ActiveBound::None);
    assert_eq!(place(0.0, 0.0), ActiveBound::Lower);
    assert_eq!(place(1.0, 1.0), ActiveBound::Lower);
    assert_eq!(place(4.0, -1.0), ActiveBound::Upper);
    assert_eq!(place(3.0, -1e-9), ActiveBound::None);
    assert_eq!(place(3.0, -1.0), ActiveBound::Upper);
    assert_eq!(place(2.0, 0.0), ActiveBound::None);

    let fixed = problem(1, &[4.0], &[4.0]);
    assert_eq!(
        Places::at_solution(
            &fixed,
            &Point {
                z: dvector![4.0],
                f: dvector![3.0],
                merit: 0.0
            }
        )
        .0,
        [ActiveBound::Fixed]
    );
}

#[test]
fn lifted_multipliers_are_on_the_right_side() {
    let p = Places(vec![
        ActiveBound::None,
        ActiveBound::Lower,
        ActiveBound::Upper,
        ActiveBound::Fixed,
    ]);
    let lift = |i: usize, f: f64| p.lifted_multiplier(i, f, 0.25);

    assert_eq!(lift(0, 3.0), 0.0);
    assert_eq!(lift(1, 3.0), 3.25);
    assert_eq!(lift(1, -3.0), 0.25);
    assert_eq!(lift(2, -3.0), -3.25);
    assert_eq!(lift(2, 3.0), -0.25);
    assert_eq!(lift(3, -3.0), -3.0);
}

/// Values of the three quantities and their derivatives by (z_I, s).
#[test]
fn rows_are_the_derivatives_of_the_quantities() {
    let p = problem(2, &[0.0; 2], &[4.0; 2]);
    let mut evaluated = Evaluated::new(&p);
    let places = Places(vec![ActiveBound::None, ActiveBound::Lower]);
    let system = HomotopySystem {
        problem: &mut evaluated,
        r: dvector![5.0, 7.0],
        places,
    };
    let local = Local {
        f: dvector![2.0, 3.0],
        jacobian: DMatrix::from_row_slice(2, 2, &[11.0, 13.0, 17.0, 19.0]),
    };
    let at = CurvePoint {
        z: dvector![0.5, 0.0],
        s: 0.125,
    };
    let quantities = [Quantity::Z(0, 4.0), Quantity::Multiplier(1), Quantity::S];

    assert_eq!(
        quantities.map(|q| system.value(q, &at, &local)),
        [-3.5, 3.0 - 0.125 * 7.0, 0.125]
    );

    let rows = quantities.map(|q| system.row(q, &local, &[0]));
    assert_eq!(
        rows,
        [dvector![1.0, 0.0], dvector![17.0, -7.0], dvector![0.0, 1.0]]
    );
}

/// z / (1 + a z) for z > 0 and z below: from a z = x the first Newton step leaves -x z, with x (1 +
/// x) times the residual. At most twice is let pass, and the next step ends at the root.
#[test]
fn a_correction_may_double_the_residual_and_no_more() {
    for (x, passes) in [(0.9, true), (1.0, true), (1.05, false)] {
        let a = 8.0 * x; // from z = 1/8
        let f = move |z: &[f64], f: &mut [f64]| {
            f[0] = if z[0] > 0.0 {
                z[0] / (1.0 + a * z[0])
            } else {
                z[0]
            }
        };
        let jacobian = move |z: &[f64], j: &mut DMatrix<f64>| {
            j[(0, 0)] = if z[0] > 0.0 {
                1.0 / ((1.0 + a * z[0]) * (1.0 + a * z[0]))
            } else {
                1.0
            }
        };
        let p = free(1, f, jacobian);
        let mut evaluated = Evaluated::new(&p);
        let mut system = HomotopySystem {
            problem: &mut evaluated,
            r: dvector![0.0],
            places: Places(vec![ActiveBound::None]),
        };
        let at = CurvePoint {
            z: dvector![0.125],
            s: 0.0,
        };
        let found = system.correct(&at, &Border::Plane(&dvector![0.0, 1.0]));

        assert_eq!(
            found.map(|there| (there.at.z[0].abs() < 1e-9, there.steps)),
            passes.then_some((true, 2)),
            "{x}"
        );
    }
}

/// On the curve within CURVE_RESIDUAL (1 + |s| |r|): no step; beyond, one.
#[test]
fn a_residual_is_relative_to_the_right_hand_side() {
    let p = problem(1, &[f64::NEG_INFINITY], &[f64::INFINITY]);
    for (s, r) in [(0.0, 3.0), (2.0, 3.0), (-2.0, -0.25)] {
        let steps = |share: f64| {
            let mut evaluated = Evaluated::new(&p);
            let mut system = HomotopySystem {
                problem: &mut evaluated,
                r: dvector![r],
                places: Places(vec![ActiveBound::None]),
            };
            let size = 1.0 + f64::abs(s * r);
            let at = CurvePoint {
                z: dvector![s * r + share * CURVE_RESIDUAL * size],
                s,
            };
            system
                .correct(&at, &Border::Plane(&dvector![0.0, 1.0]))
                .unwrap()
                .steps
        };

        assert_eq!(steps(0.9), 0, "{s} {r}");
        assert_eq!(steps(1.1), 1, "{s} {r}");
    }
}

/// z^3 falls to 8/27 with each Newton step: from 1.4e-6 six steps are enough, from 1.6e-6 they are
/// not.
#[test]
fn a_correction_has_a_number_of_steps() {
    let p = free(
        1,
        |z, f| f[0] = z[0].powi(3),
        |z, j| j[(0, 0)] = 3.0 * z[0] * z[0],
    );
    let steps = |residual: f64| {
        let mut evaluated = Evaluated::new(&p);
        let mut system = HomotopySystem {
            problem: &mut evaluated,
            r: dvector![0.0],
            places: Places(vec![ActiveBound::None]),
        };
        let at = CurvePoint {
            z: dvector![residual.cbrt()],
            s: 0.0,
        };
        system
            .correct(&at, &Border::Plane(&dvector![0.0, 1.0]))
            .map(|there| there.steps)
    };
    let enough = CURVE_RESIDUAL * (27.0f64 / 8.0).powi(CURVE_STEPS as i32);

    assert_eq!(steps(0.95 * enough), Some(CURVE_STEPS));
    assert_eq!(steps(1.05 * enough), None);
}

/// Outside the bounds F is continued by its tangent there; what is not finite is no value.
#[test]
fn outside_the_bounds_the_function_is_linear() {
    let p = bounded(
        &[0.0, 0.0],
        &[3.0, 4.0],
        |z, f| (f[0], f[1]) = (z[0] * z[0], z[0] * z[1]),
        |z, j| {
            j.copy_from_slice(&[2.0 * z[0], z[1], 0.0, z[0]]);
        },
    );
    let mut evaluated = Evaluated::new(&p);
    let mut system = HomotopySystem {
        problem: &mut evaluated,
        r: dvector![0.0, 0.0],
        places: Places(vec![ActiveBound::None; 2]),
    };

    assert_eq!(
        system.local(&dvector![2.0, 1.0]).unwrap().f,
        dvector![4.0, 2.0]
    );

    // At (3, 4) F = (9, 12) and F' = [6, 0; 4, 3].
    let local = system.local(&dvector![3.5, 6.0]).unwrap();
    assert_eq!(local.f, dvector![12.0, 20.0]);
    assert_eq!(
        local.jacobian,
        DMatrix::from_row_slice(2, 2, &[6.0, 0.0, 4.0, 3.0])
    );
    assert_eq!(system.problem.counters.jacobians, 2);

    for (value, slope) in [(f64::NAN, 1.0), (1.0, f64::INFINITY)] {
        let p = free(1, move |_, f| f[0] = value, move |_, j| j[(0, 0)] = slope);
        let mut evaluated = Evaluated::new(&p);
        let mut system = HomotopySystem {
            problem: &mut evaluated,
            r: dvector![0.0],
            places: Places(vec![ActiveBound::None]),
        };

        assert!(system.local(&dvector![0.0]).is_none());
    }
}

/// The bordered equations: J_I v = r_I v_s, the border grows with the sign asked for, and v is a
/// unit vector.
#[test]
fn tangents_satisfy_the_bordered_equations() {
    let p = problem(3, &[0.0; 3], &[4.0; 3]);
    let mut evaluated = Evaluated::new(&p);
    let places = Places(vec![
        ActiveBound::None,
        ActiveBound::Lower,
        ActiveBound::None,
    ]);
    let mut system = HomotopySystem {
        problem: &mut evaluated,
        r: dvector![5.0, 7.0, -2.0],
        places,
    };
    let jacobian = DMatrix::from_row_slice(3, 3, &[2.0, 9.0, 1.0, 8.0, 7.0, 6.0, -1.0, 3.0, 4.0]);
    let local = Local {
        f: DVector::zeros(3),
        jacobian,
    };

    for sign in [1.0, -1.0] {
        let border = dvector![0.5, 0.0, 1.0];
        let v = system.tangent(&local, &border, sign).unwrap();
        assert!((2.0 * v[0] + v[1] - 5.0 * v[2]).abs() < 1e-12);
        assert!((-v[0] + 4.0 * v[1] + 2.0 * v[2]).abs() < 1e-12);
        assert!((v.norm() - 1.0).abs() < 1e-12);
        assert!(border.dot(&v) * sign > 0.0);
    }

    assert_eq!(system.problem.counters.factorisations, 2);
    assert!(
        system
            .tangent(&local, &dvector![0.0, 0.0, 0.0], 1.0)
            .is_none()
    );

    let mut at = CurvePoint {
        z: dvector![1.0, 2.0, 3.0],
        s: 4.0,
    };
    system.shift(&mut at, &[0, 2], &dvector![1.0, -1.0, 0.5], 2.0);

    assert_eq!(at.z, dvector![3.0, 2.0, 1.0]);
    assert_eq!(at.s, 5.0);
}

/// Numbers whose square or reciprocal leaves the range give no direction.
#[test]
fn a_direction_has_a_length() {
    let direction =
        |entry: f64| unit(&DMatrix::from_element(1, 1, entry).lu(), 0, -1.0).map(|v| v[0]);
    assert_eq!(
        [4.0, 0.0, 1e300, 1e-310].map(direction),
        [Some(-1.0), None, None, None]
    );
}

/// F = z^2 - s from z near 1 at s = 1: while a step gains a factor of 1 / CURVE_KEPT its factors
/// serve on, and at last give the tangent (1, 2) but for the difference of F'; else each step has
/// its own. Without a step there is no tangent.
#[test]
fn factors_are_kept_while_they_gain() {
    let p = free(1, |z, f| f[0] = z[0] * z[0], |z, j| j[(0, 0)] = 2.0 * z[0]);
    let corrected = |z: f64| {
        let mut evaluated = Evaluated::new(&p);
        let mut system = HomotopySystem {
            problem: &mut evaluated,
            r: dvector![1.0],
            places: Places(vec![ActiveBound::None]),
        };
        let there = system
            .correct(
                &CurvePoint {
                    z: dvector![z],
                    s: 1.0,
                },
                &Border::Plane(&dvector![0.0, 1.0]),
            )
            .unwrap();
        assert!((there.at.z[0] - 1.0).abs() < 1e-8);
        assert_eq!(there.at.s, 1.0);
        (
            there.steps,
            system.problem.counters.factorisations,
            there.tangent,
        )
    };

    // The error e of z goes to e^2 / 2 with new factors, to e times the first error with kept ones.
    for (from, steps, factorisations) in [(1.0 + 1e-3, 2, 1), (1.1, 4, 2)] {
        let (s, f, tangent) = corrected(from);
        assert_eq!(s, steps, "{from}");
        assert_eq!(f, factorisations, "{from}");

        let tangent = tangent.unwrap();
        let along = dvector![1.0, 2.0].normalize();
        assert!((tangent.dot(&along).abs() - 1.0).abs() < 1e-5, "{tangent}");
        assert!((tangent.norm() - 1.0).abs() < 1e-12, "{tangent}");
    }

    assert_eq!(corrected(1.0), (0, 0, None));
}
