//! Each decision of the follower at its limit, on curves that are known.

use super::super::super::evaluation::Evaluated;
use super::super::super::probe::{bounded, free};
use super::super::system::Places;
use super::super::{Options, continuation_through};
use super::*;
use crate::mcp::FunctionMcp;
use nalgebra::{DMatrix, dmatrix, dvector};

const INF: f64 = f64::INFINITY;

type Linear = FunctionMcp<'static>;

/// M z + q.
fn linear(m: DMatrix<f64>, q: DVector<f64>, l: &[f64], u: &[f64]) -> Linear {
    let matrix = m.clone();
    let f = move |z: &[f64], f: &mut [f64]| {
        f.copy_from_slice((&m * DVector::from_column_slice(z) + &q).as_slice())
    };
    bounded(l, u, f, move |_, j| j.copy_from(&matrix))
}

fn position(z: &[f64], s: f64) -> CurvePoint {
    CurvePoint {
        z: DVector::from_column_slice(z),
        s,
    }
}

/// A follower at a position, under way from a start at s = 1, with nothing behind it.
fn follower_at<'p, 'a, P: Mcp + ?Sized>(
    problem: &'p mut Evaluated<'a, P>,
    r: DVector<f64>,
    places: &[ActiveBound],
    at: CurvePoint,
) -> Follower<'p, 'a, P> {
    let system = HomotopySystem {
        problem,
        r,
        places: Places(places.to_vec()),
    };
    let start = CurvePoint {
        z: DVector::zeros(at.z.len()),
        s: 1.0,
    };
    let start_places = system.places.clone();
    Follower {
        system,
        at,
        start,
        start_places,
        length: CURVE_FIRST,
        steps_left: 1,
        enough: 9,
        found: Vec::new(),
    }
}

/// The chord from s = 1.3 to 0.9 passes s = 1 at three quarters; a start within CURVE_CLOSED of the
/// step closes the curve.
#[test]
fn a_curve_is_back_where_it_passes_its_start() {
    let p = linear(
        DMatrix::identity(2, 2),
        DVector::zeros(2),
        &[-INF; 2],
        &[INF; 2],
    );
    let mut evaluated = Evaluated::new(&p);
    let mut follower = follower_at(
        &mut evaluated,
        dvector![1.0, 1.0],
        &[ActiveBound::None; 2],
        position(&[5.0, 0.0], 0.9),
    );
    let mut is_back = |off: [f64; 2], before: f64, now: f64| {
        follower.start = position(&[4.0 + off[0], off[1]], 1.0);
        follower.at.s = now;
        follower.is_back(&position(&[1.0, 0.0], before))
    };
    let near = 4.0 * CURVE_CLOSED;

    for off in [[0.9, 0.0], [-0.9, 0.0], [0.0, 0.9], [0.0, 0.0]] {
        assert!(is_back(off.map(|o| o * near), 1.3, 0.9), "{off:?}");
    }
    for off in [[1.1, 0.0], [-1.1, 0.0], [0.0, 1.1]] {
        assert!(!is_back(off.map(|o| o * near), 1.3, 0.9), "{off:?}");
    }

    assert!(!is_back([0.0; 2], 1.3, 1.1));
    assert!(!is_back([0.0; 2], 0.7, 0.9));

    follower.system.places = Places(vec![ActiveBound::None, ActiveBound::Lower]);
    follower.start = position(&[4.0, 0.0], 1.0);
    follower.at.s = 0.9;
    assert!(!follower.is_back(&position(&[1.0, 0.0], 1.3)));
}

/// Distances to the bounds, to multiplier zero and to s = 0 along the tangent: the least of those
/// ahead.
#[test]
fn the_next_event_is_the_nearest_ahead() {
    let m = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 2.0, 0.0, 1.0];
    let p = linear(
        m,
        dvector![0.0, 0.0, 5.0],
        &[0.0, -INF, 0.0],
        &[INF, 10.0, INF],
    );
    let mut evaluated = Evaluated::new(&p);
    let mut follower = follower_at(
        &mut evaluated,
        dvector![0.0, 0.0, 3.0],
        &[ActiveBound::None, ActiveBound::None, ActiveBound::Lower],
        position(&[2.0, 7.0, 0.0], 1.0),
    );

    // z_0 = 2 above 0, z_1 = 7 below 10, multiplier 2 z_0 + 5 - 3 s = 6, s = 1.
    let next = |follower: &mut Follower<'_, '_, Linear>, tangent: [f64; 3]| {
        let local = follower.system.local(&follower.at.z.clone()).unwrap();
        follower.predicted_event(&local, &DVector::from_column_slice(&tangent), &[0, 1])
    };

    assert_eq!(
        next(&mut follower, [-0.5, 0.25, -0.125]),
        Some((Quantity::Z(0, 0.0), 4.0))
    );
    assert_eq!(
        next(&mut follower, [-0.25, 0.5, -0.125]),
        Some((Quantity::Z(1, 10.0), 6.0))
    );
    assert_eq!(
        next(&mut follower, [-0.25, 0.25, -0.5]),
        Some((Quantity::S, 2.0))
    );
    assert_eq!(
        next(&mut follower, [0.0, 0.0, -0.5]),
        Some((Quantity::S, 2.0))
    );
    assert_eq!(
        next(&mut follower, [0.0, 0.0, 0.5]),
        Some((Quantity::Multiplier(2), 4.0))
    );
    assert_eq!(
        next(&mut follower, [-0.25, 0.0, 0.5]),
        Some((Quantity::Multiplier(2), 3.0))
    );
    assert_eq!(next(&mut follower, [0.5, -0.5, 0.25]), None);

    follower.at.s = 0.0; // already there
    assert_eq!(next(&mut follower, [0.5, -0.5, -0.25]), None);

    follower.at.s = -1.0;
    assert_eq!(
        next(&mut follower, [1.0, -0.5, 0.5]),
        Some((Quantity::S, 2.0))
    );

    follower.at.z[0] = -1e-9; // a little beyond: at once
    assert_eq!(
        next(&mut follower, [-0.5, 0.0, 0.0]),
        Some((Quantity::Z(0, 0.0), 0.0))
    );
}

/// A quantity has crossed beyond CURVE_FEASIBLE (1 + |s|), and where the chord between its values
/// does.
#[test]
fn a_crossing_is_more_than_the_feasibility() {
    let p = linear(
        DMatrix::identity(2, 2),
        DVector::zeros(2),
        &[0.0, -INF],
        &[INF, 4.0],
    );
    let mut evaluated = Evaluated::new(&p);
    let mut follower = follower_at(
        &mut evaluated,
        dvector![1.0, 1.0],
        &[ActiveBound::None; 2],
        position(&[3.0, 0.0], 1.0),
    );
    let crossing = |follower: &mut Follower<'_, '_, Linear>, z: [f64; 2], s: f64| {
        let to = position(&z, s);
        let here = follower.system.local(&follower.at.z.clone()).unwrap();
        let there = follower.system.local(&to.z).unwrap();
        follower.first_crossing(&here, &to, &there)
    };

    for s in [0.25, 1.0, 7.0, -1e-9] {
        let least = CURVE_FEASIBLE * (1.0 + f64::abs(s));
        assert_eq!(
            [0.9, 1.0].map(|share| crossing(&mut follower, [-share * least, 0.0], s)),
            [None; 2],
            "{s}"
        );
        assert_eq!(
            crossing(&mut follower, [-1.1 * least, 0.0], s).unwrap().0,
            Quantity::Z(0, 0.0),
            "{s}"
        );
    }

    assert_eq!(
        crossing(&mut follower, [-1.0, 0.0], 1.0),
        Some((Quantity::Z(0, 0.0), 0.75))
    );
    assert_eq!(
        crossing(&mut follower, [-1.0, 6.0], 1.0),
        Some((Quantity::Z(1, 4.0), 4.0 / 6.0))
    );
    assert_eq!(
        crossing(&mut follower, [2.0, 0.0], -1.0),
        Some((Quantity::S, 0.5))
    );

    // What was beyond before has crossed at once.
    follower.at.z[0] = -1e-9;
    assert_eq!(
        crossing(&mut follower, [-1.0, 0.0], 1.0),
        Some((Quantity::Z(0, 0.0), 0.0))
    );
}

/// z = 100 - 100 s. A step without an event doubles the next one; one that ends at an event does
/// not.
#[test]
fn easy_steps_grow_and_events_do_not() {
    let p = linear(dmatrix![1.0], dvector![-100.0], &[-INF], &[80.0]);
    let mut evaluated = Evaluated::new(&p);
    let mut follower = follower_at(
        &mut evaluated,
        dvector![-100.0],
        &[ActiveBound::None],
        position(&[0.0], 1.0),
    );
    let tangent = dvector![100.0, -1.0].normalize();
    let step = |follower: &mut Follower<'_, '_, Linear>| {
        let local = follower.system.local(&follower.at.z.clone()).unwrap();
        follower.step(&local, &tangent).map(|(landing, _)| landing)
    };
    let landing = step(&mut follower).unwrap();

    assert_eq!(landing.event, None);
    assert_eq!(landing.there.steps, 0);
    assert_eq!(follower.length, CURVE_GROWTH * CURVE_FIRST);

    let way = ((&landing.there.at.z - &follower.at.z).norm_squared()
        + (landing.there.at.s - follower.at.s).powi(2))
    .sqrt();

    approx::assert_relative_eq!(way, CURVE_FIRST, max_relative = 1e-12);

    follower.length = 90.0;
    let landing = step(&mut follower).unwrap();
    assert_eq!(landing.event, Some(Quantity::Z(0, 80.0)));
    assert_eq!(landing.there.at.z[0], 80.0);
    assert_eq!(follower.length, 90.0);
    assert_eq!(follower.system.places.0, [ActiveBound::Upper]);

    // Nothing shorter than the shortest step is tried.
    follower.system.places = Places(vec![ActiveBound::None]);
    follower.length = 1.5 * CURVE_SHORTEST;

    assert!(step(&mut follower).is_some());

    follower.length = CURVE_SHORTEST;
    assert!(step(&mut follower).is_none());
}

/// Where no step lands the length is halved until it is too short.
#[test]
fn a_curve_that_leads_nowhere_is_left_at_the_shortest_step() {
    let p = free(
        1,
        |z, f| f[0] = if z[0] == 0.0 { 0.0 } else { f64::NAN },
        |_, j| j[(0, 0)] = 1.0,
    );
    let mut evaluated = Evaluated::new(&p);
    let mut follower = follower_at(
        &mut evaluated,
        dvector![1.0],
        &[ActiveBound::None],
        position(&[0.0], 0.0),
    );
    let local = follower.system.local(&dvector![0.0]).unwrap();

    assert!(
        follower
            .step(&local, &dvector![1.0, 1.0].normalize())
            .is_none()
    );
    assert!(follower.length <= CURVE_SHORTEST);
    assert!(follower.length > 0.5 * CURVE_SHORTEST * (1.0 - 1e-9));
}

/// z = 10 - 10 s: from s = 0.5 the solution is |dz| + |ds| = 5.5 away, which must be within four
/// lengths.
#[test]
fn an_event_that_is_far_is_refused() {
    let p = linear(dmatrix![1.0], dvector![-10.0], &[-INF], &[INF]);
    let mut evaluated = Evaluated::new(&p);
    let mut follower = follower_at(
        &mut evaluated,
        dvector![-10.0],
        &[ActiveBound::None],
        position(&[5.0], 0.5),
    );
    let mut lands = |length: f64| {
        follower.length = length;
        let local = follower.system.local(&follower.at.z.clone()).unwrap();
        follower
            .land_on(Quantity::S, &position(&[5.0], 0.5), &local)
            .map(|landing| (landing.there.at.z[0], landing.there.at.s, landing.event))
    };

    assert_eq!(lands(5.5 / 3.9), Some((10.0, 0.0, Some(Quantity::S))));
    assert_eq!(lands(5.5 / 4.1), None);
    assert!(lands(5.5 / 4.0).is_some()); // exactly four lengths
}

/// z = (3 - s, s), upper bound 4 of z_1, from s = 1: at that bound z_0 has crossed 0, if 0 is its
/// bound.
#[test]
fn an_event_beyond_another_one_is_refused() {
    let lands = |lower: f64| {
        let p = linear(
            DMatrix::identity(2, 2),
            dvector![-3.0, 0.0],
            &[lower, -INF],
            &[INF, 4.0],
        );
        let mut evaluated = Evaluated::new(&p);
        let mut follower = follower_at(
            &mut evaluated,
            dvector![-1.0, 1.0],
            &[ActiveBound::None; 2],
            position(&[2.0, 1.0], 1.0),
        );
        follower.length = 2.0;
        let local = follower.system.local(&follower.at.z.clone()).unwrap();
        follower
            .land_on(Quantity::Z(1, 4.0), &position(&[-1.0, 4.0], 4.0), &local)
            .map(|landing| landing.there.at.z)
    };

    assert_eq!(lands(0.0), None);
    assert_eq!(lands(-2.0), Some(dvector![-1.0, 4.0]));
    assert_eq!(lands(-INF), Some(dvector![-1.0, 4.0]));
}

/// An event that the tangent shows within the step is landed on at once.
#[test]
fn a_predicted_event_costs_one_correction() {
    let p = linear(dmatrix![1.0], dvector![0.0], &[-INF], &[3.0]);
    for (length, corrections, event) in [(4.0, 1, Some(Quantity::Z(0, 3.0))), (0.5, 1, None)] {
        let mut evaluated = Evaluated::new(&p);
        let mut follower = follower_at(
            &mut evaluated,
            dvector![1.0],
            &[ActiveBound::None],
            position(&[1.0], 1.0),
        );
        follower.length = length;
        let local = follower.system.local(&follower.at.z.clone()).unwrap();
        let tangent = dvector![1.0, 1.0].normalize();
        let before = follower.system.problem.counters.jacobians;
        let landing = follower.land(&local, &tangent, &[0]).unwrap();

        assert_eq!(landing.event, event, "{length}");
        assert_eq!(landing.there.steps, 0, "{length}");
        assert_eq!(
            follower.system.problem.counters.jacobians - before,
            corrections
        );
    }
}

/// The tangent that a correction brings points along the curve or against it; the curve goes on in
/// its own direction, and not at the limit of the angle itself.
#[test]
fn a_tangent_from_the_correction_is_turned_forward() {
    let p = linear(dmatrix![1.0], dvector![0.0], &[-INF], &[INF]);
    let tangent = dvector![1.0, 0.0];
    let turned = |given: DVector<f64>| {
        let mut evaluated = Evaluated::new(&p);
        let mut follower = follower_at(
            &mut evaluated,
            dvector![1.0],
            &[ActiveBound::None],
            position(&[0.0], 0.0),
        );
        let local = Local {
            f: dvector![0.0],
            jacobian: dmatrix![1.0],
        };
        let there = Corrected {
            at: position(&[0.0], 0.0),
            local,
            steps: 1,
            tangent: Some(given),
        };
        follower.turn(
            &Landing {
                there,
                event: Some(Quantity::S),
            },
            &tangent,
        )
    };

    assert_eq!(turned(dvector![0.8, 0.6]), Some(dvector![0.8, 0.6]));
    assert_eq!(turned(dvector![-0.8, 0.6]), Some(dvector![0.8, -0.6]));

    let across = (1.0 - CURVE_ANGLE * CURVE_ANGLE).sqrt();
    assert_eq!(
        [dvector![CURVE_ANGLE, across], dvector![0.0, 1.0]].map(turned),
        [None, None]
    );
}

/// F = J z with r = 1: the tangent (1, J) / sqrt(1 + J^2) against (1, 0).
#[test]
fn a_tangent_turns_by_no_more_than_the_angle() {
    let p = linear(dmatrix![1.0], dvector![0.0], &[-INF], &[INF]);
    for (cosine, turns) in [(CURVE_ANGLE + 0.01, true), (CURVE_ANGLE - 0.01, false)] {
        let mut evaluated = Evaluated::new(&p);
        let mut follower = follower_at(
            &mut evaluated,
            dvector![1.0],
            &[ActiveBound::None],
            position(&[0.0], 0.0),
        );
        let slope = (1.0 / f64::powi(cosine, 2) - 1.0).sqrt();
        let tangent = dvector![1.0, 0.0];

        for event in [None, Some(Quantity::S)] {
            let local = Local {
                f: dvector![0.0],
                jacobian: dmatrix![slope],
            };
            let landing = Landing {
                there: Corrected {
                    at: position(&[0.0], 0.0),
                    local,
                    steps: 0,
                    tangent: None,
                },
                event,
            };
            let next = follower.turn(&landing, &tangent);

            assert_eq!(next.is_some(), turns, "{cosine}");

            if let Some(next) = next {
                approx::assert_relative_eq!(next.dot(&tangent), cosine, max_relative = 1e-12);
            }
        }
    }
}

/// At an event the pair changes places, and what was fixed moves into its own side.
#[test]
fn a_pair_changes_places_at_its_event() {
    let p = linear(
        dmatrix![2.0, 1.0; 1.0, 3.0],
        dvector![0.0, 0.0],
        &[0.0; 2],
        &[4.0; 2],
    );
    let turned = |places: [ActiveBound; 2], event: Quantity, tangent: DVector<f64>| {
        let mut evaluated = Evaluated::new(&p);
        let mut follower = follower_at(
            &mut evaluated,
            dvector![1.0, 3.0],
            &places,
            position(&[2.0, 0.0], 1.0),
        );
        let local = follower.system.local(&dvector![2.0, 0.0]).unwrap();
        let landing = Landing {
            there: Corrected {
                at: follower.at.clone(),
                local,
                steps: 0,
                tangent: None,
            },
            event: Some(event),
        };
        let next = follower.turn(&landing, &tangent).unwrap();
        let now = follower.system.places.inside();
        let quantity = |q: Quantity| {
            follower
                .system
                .row(q, &landing.there.local, &now)
                .dot(&next)
        };
        let rate = if now.contains(&1) {
            quantity(Quantity::Z(1, 0.0))
        } else {
            quantity(Quantity::Multiplier(1))
        };
        (
            follower.system.places.0[1],
            rate > 0.0,
            (next.norm() - 1.0).abs() < 1e-12,
        )
    };
    let inside = [ActiveBound::None; 2];

    assert_eq!(
        turned(inside, Quantity::Z(1, 4.0), dvector![0.0, 0.5, 0.5]),
        (ActiveBound::Upper, false, true)
    );
    assert_eq!(
        turned(inside, Quantity::Z(1, 0.0), dvector![0.0, -0.5, 0.5]),
        (ActiveBound::Lower, true, true)
    );

    // A curve that bends comes back to the bound its tangent leads away from: it is that bound all
    // the same.
    assert_eq!(
        turned(inside, Quantity::Z(1, 0.0), dvector![0.0, 0.5, 0.5]).0,
        ActiveBound::Lower
    );
    assert_eq!(
        turned(inside, Quantity::Z(1, 4.0), dvector![0.0, -0.5, 0.5]).0,
        ActiveBound::Upper
    );
    assert_eq!(
        turned(
            [ActiveBound::None, ActiveBound::Lower],
            Quantity::Multiplier(1),
            dvector![0.5, 0.5]
        ),
        (ActiveBound::None, true, true)
    );
    assert_eq!(
        turned(
            [ActiveBound::None, ActiveBound::Upper],
            Quantity::Multiplier(1),
            dvector![0.5, 0.5]
        ),
        (ActiveBound::None, false, true)
    );
}

/// One step from z or s on a curve that runs on: beyond CURVE_FAR (1 + |start|), and for s beyond
/// CURVE_FAR, it is a ray.
#[test]
fn a_curve_is_a_ray_when_far() {
    let walked = |start: f64, z: f64, slope: f64, upper: f64| {
        // F = z with r = slope: z = slope s.
        let p = linear(dmatrix![1.0], dvector![0.0], &[-INF], &[upper]);
        let mut evaluated = Evaluated::new(&p);
        let mut follower = follower_at(
            &mut evaluated,
            dvector![slope],
            &[ActiveBound::None],
            position(&[z], z / slope),
        );
        follower.start.z[0] = start;
        follower.walk(Sense::Up)
    };

    for start in [0.0, 3.0, -3.0] {
        let limit = CURVE_FAR * (1.0 + f64::abs(start));
        assert_eq!(
            [0.999, 1.001].map(|share| walked(start, share * limit, 1e3, INF)),
            [Some(CurveEnd::StepLimit), Some(CurveEnd::Ray)]
        );

        // At the limit itself, where an event has put it, not yet.
        assert_eq!(
            walked(start, limit - 0.01, 1e3, limit),
            Some(CurveEnd::StepLimit)
        );
    }

    assert_eq!(
        [0.999, 1.001].map(|share| walked(0.0, share * CURVE_FAR / 1e3, 1e-3, INF)),
        [Some(CurveEnd::StepLimit), Some(CurveEnd::Ray)]
    );
}

/// The circle |z| = R with s = z_1: from a start at distance `off` outside of (R, 0). The start
/// itself closes the curve if it is met within CURVE_SAME (1 + |z|); else the first solution that
/// comes again does.
#[test]
fn a_circle_closes_at_a_solution_it_has_met() {
    for radius in [0.5, 3.0] {
        let f = move |z: &[f64], f: &mut [f64]| {
            (f[0], f[1]) = (z[0] * z[0] + z[1] * z[1] - radius * radius, z[1])
        };
        let p = free(2, f, |z, j| {
            j.copy_from(&dmatrix![2.0 * z[0], 2.0 * z[1]; 0.0, 1.0])
        });
        let met = |share: f64, enough: usize, limit: usize| {
            let off = share * CURVE_SAME * (1.0 + radius);
            let options = Options {
                curve_step_limit: limit,
                ..Options::default()
            };
            continuation_through(
                &p,
                &[radius + off, 0.0],
                &[0.0, 1.0],
                Sense::Up,
                enough,
                &options,
            )
            .unwrap()
        };

        for (share, passages) in [(0.0, 2), (0.9, 2), (1.1, 3)] {
            let curve = met(share, 9, 500);
            assert_eq!(curve.solutions.len(), passages, "{share}: {curve:?}");
            assert_eq!(curve.end, CurveEnd::Closed, "{share}: {curve:?}");
            assert!(
                curve.solutions.iter().enumerate().all(
                    |(k, z)| (z[0].abs() - radius).abs() < 1e-6 && (z[0] > 0.0) == (k % 2 == 1)
                )
            );
        }

        assert_eq!(met(0.0, 1, 500).end, CurveEnd::Enough);

        let short = met(0.0, 9, 3);
        assert_eq!(short.end, CurveEnd::StepLimit);
        assert_eq!(short.counters.curve_steps, 3);
    }
}
