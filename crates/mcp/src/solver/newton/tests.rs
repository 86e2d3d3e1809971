//! The decisions of the outer loop one by one: shares, trials, where a path leads, which fallback
//! comes next.

use super::super::probe::free;
use super::super::restart::Acceptance;
use super::super::tolerance::RESTART_PROXIMAL;
use super::*;
use crate::mcp::LinearMcp;
use nalgebra::{DVector, dmatrix, dvector};

const INF: f64 = f64::INFINITY;

fn run<'a, P: Mcp + ?Sized>(problem: &'a P, options: &'a Options) -> NewtonRun<'a, P> {
    NewtonRun::new(problem, options, Workspace::default())
}

/// F = -1 - z on z >= 0: no solution.
fn infeasible() -> LinearMcp {
    LinearMcp::lcp(dmatrix![-1.0], vec![-1.0]).unwrap()
}

fn feasible() -> LinearMcp {
    LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap()
}

/// The path of M z + q over `current`.
fn path(m: DMatrix<f64>, q: &[f64], l: &[f64], u: &[f64], start: Start, current: &[f64]) -> Path {
    let sub = Subproblem {
        m: &m,
        q,
        lower: l,
        upper: u,
    };
    let limits = PathLimits {
        pivots: 50,
        cycle_entries: 5,
        rule: Options::default().ratio_test,
    };
    let mut path = Path::default();
    path::PathStorage::default().follow(&sub, start, current, limits, &mut path);
    path
}

/// One attempt and the restarts share the limits, twice as many where each is followed by curves;
/// rounded up.
#[test]
fn limits_are_shared_evenly() {
    fn share(restart_limit: usize, curve_step_limit: usize) -> (usize, usize) {
        let options = Options {
            restart_limit,
            curve_step_limit,
            major_iteration_limit: 500,
            cumulative_iteration_limit: 10_000,
            ..Options::default()
        };
        let share = run(&feasible(), &options).share();
        (share.majors, share.pivots)
    }

    assert_eq!(share(3, 1), (63, 1250));
    assert_eq!(share(3, 0), (125, 2500));
    assert_eq!(share(0, 1), (250, 5000));
    assert_eq!(share(0, 0), (500, 10_000));
    assert_eq!(share(2, 200), (84, 1667));
}

#[test]
fn curves_from_afar_are_tried_where_there_are_restarts_and_curves() {
    fn trials(restart_limit: usize, curve_step_limit: usize) -> usize {
        let options = Options {
            restart_limit,
            curve_step_limit,
            ..Options::default()
        };
        run(&feasible(), &options).trials()
    }

    assert_eq!(trials(1, 1), CURVE_TRIALS);
    assert_eq!(trials(0, 1), 0);
    assert_eq!(trials(1, 0), 0);
    assert_eq!(trials(0, 0), 0);
}

/// Curves follow an attempt that has failed from a point that was moved, and no other.
#[test]
fn curves_are_followed_after_restarts_that_moved_and_failed() {
    /// Does the restart reach the tolerance, and does it follow curves?
    fn restarted(problem: &LinearMcp, attempt: Attempt, curve_step_limit: usize) -> (bool, bool) {
        let options = Options {
            curve_step_limit,
            ..Options::default()
        };
        let mut run = run(problem, &options);
        let start = run.problem.point_with(|_| 1.0);
        let mut best = run.problem.copy(&start);

        let reason = run.restart(&start, attempt, 2, &mut best);
        assert_eq!(run.problem.counters.restarts, 1);
        assert_eq!(run.space.log.records()[0].step, StepKind::Restart);
        (
            reason.reached_tolerance(),
            run.problem.counters.curve_steps > 0,
        )
    }

    let still = Attempt::number(1);
    let moved = Attempt::number(2);

    assert_eq!(restarted(&infeasible(), moved, 50), (false, true));
    assert_eq!(restarted(&infeasible(), moved, 0), (false, false));
    assert_eq!(restarted(&infeasible(), still, 50), (false, false));
    assert_eq!(restarted(&feasible(), moved, 50), (true, false));
    assert_eq!(restarted(&feasible(), still, 50), (true, false));
}

/// By number: projected Newton, none, and the Fischer-Burmeister system with projected Newton after
/// it.
#[test]
fn the_crash_is_the_one_asked_for() {
    /// Are there steps on the Fischer-Burmeister system, and steps of projected Newton?
    fn steps(crash_method: CrashMethod, crash_iteration_limit: usize) -> [bool; 2] {
        let problem = feasible();
        let options = Options {
            crash_method,
            crash_iteration_limit,
            ..Options::default()
        };
        let mut run = run(&problem, &options);
        let start = run.problem.point_with(|i| if i == 0 { 3.0 } else { 0.5 });
        run.crash(start).unwrap();

        let records = run.space.log.records();
        let kinds = [StepKind::FischerNewton, StepKind::Crash];
        kinds.map(|kind| records.iter().any(|record| record.step == kind))
    }

    assert_eq!(steps(CrashMethod::ProjectedNewton, 50), [false, true]);
    assert_eq!(steps(CrashMethod::ProjectedNewton, 0), [false, false]);
    assert_eq!(steps(CrashMethod::None, 50), [false, false]);
    assert_eq!(steps(CrashMethod::None, 0), [false, false]);
    assert_eq!(steps(CrashMethod::FischerNewton, 50), [true, false]);
    assert_eq!(steps(CrashMethod::FischerNewton, 0), [false, false]);

    // Projected Newton goes on where the other one has not solved the problem.
    assert_eq!(steps(CrashMethod::FischerNewton, 1), [true, true]);
}

#[test]
fn inside_is_strictly_between_the_bounds() {
    let p = LinearMcp::new(
        DMatrix::identity(5, 5),
        vec![0.0; 5],
        vec![0.0, 0.0, 0.0, -INF, 1.0],
        vec![2.0, 2.0, 2.0, INF, 1.0],
    )
    .unwrap();
    let point = Point {
        z: dvector![0.0, 1.0, 2.0, -7.0, 1.0],
        f: DVector::zeros(5),
        merit: 0.0,
    };

    assert_eq!(strictly_inside(&p, &point), [1, 3]);
}

/// The trials of curves are numbered on from the restarts, so that no two starts lie in one
/// direction.
#[test]
fn trials_are_numbered_on_from_the_restarts() {
    let met = std::cell::RefCell::new(Vec::new());
    let p = free(
        1,
        |z, f| {
            met.borrow_mut().push(z[0]);
            f[0] = 1.0 + z[0] * z[0];
        },
        |z, j| j[(0, 0)] = 2.0 * z[0],
    );
    let options = Options {
        restart_limit: 2,
        ..Options::default()
    };
    run(&p, &options).run(&[0.5]);

    for trial in 0..CURVE_TRIALS {
        let start = Attempt::far(trial).shifted(0.5, 0, trial + 3);
        assert!(met.borrow().contains(&start), "{trial}");
    }
}

/// The first attempt too; a limit of zero means none at all.
#[test]
fn curves_are_followed_after_the_first_attempt_fails() {
    /// Does the run reach the tolerance, does it follow curves, and how often does it restart?
    fn ended(
        problem: &LinearMcp,
        start: &[f64],
        restart_limit: usize,
        curve_step_limit: usize,
    ) -> (bool, bool, usize) {
        let options = Options {
            restart_limit,
            curve_step_limit,
            ..Options::default()
        };
        let finished = run(problem, &options).run(start);
        (
            finished.termination.reached_tolerance(),
            finished.counters.curve_steps > 0,
            finished.counters.restarts,
        )
    }

    assert_eq!(ended(&infeasible(), &[1.0], 0, 50), (false, true, 0));
    assert_eq!(ended(&infeasible(), &[1.0], 0, 0), (false, false, 0));
    assert_eq!(ended(&infeasible(), &[1.0], 2, 50), (false, true, 2));
    assert_eq!(ended(&feasible(), &[1.0; 2], 2, 50), (true, false, 0));
}

/// Each component of F at the tolerance is within it, however many there are.
#[test]
fn the_tolerance_is_that_of_each_component() {
    let options = Options {
        convergence_tolerance: 0.25,
        ..Options::default()
    };

    for n in [1, 2, 9] {
        let p = free(
            n,
            |z, f| f.copy_from_slice(z),
            |_, j| j.fill_with_identity(),
        );
        let mut run = run(&p, &options);
        let mut all_within = |each: f64| {
            let point = run.problem.point_with(|_| each);
            is_within_tolerance(&p, &point, 0.25)
        };

        assert!(all_within(0.25), "{n}");
        assert!(all_within(-0.25), "{n}");
        assert!(!all_within(0.2501), "{n}");

        let one = run
            .problem
            .point_with(|i| if i == 0 { 0.2501 } else { 0.0 });

        assert!(!is_within_tolerance(&p, &one, 0.25), "{n}");
    }
}

/// The attempt's share of the largest entry, times the root of the merit up to 1, and only where
/// the attempt asks for it.
#[test]
fn the_proximal_term_of_a_restart_vanishes_with_the_merit() {
    let p = free(
        2,
        |z, f| f.copy_from_slice(z),
        |_, j| j.copy_from(&dmatrix![1.0, -8.0; 0.0, 1.0]),
    );
    let options = Options::default();
    let term = |attempt: Attempt, z: f64| {
        let mut run = run(&p, &options);
        let point = run.problem.point_with(|i| if i == 0 { z } else { 0.0 });
        let mut search = NonMonotoneRule::default();
        search.begin(&point, &point, &options, attempt);
        run.major(&point, attempt, &mut search).ok();

        assert_eq!(run.problem.counters.majors, 1);

        run.space.log.records().last().unwrap().proximal
    };
    let proximal = Attempt {
        proximal: RESTART_PROXIMAL,
        ..Attempt::number(1)
    };

    // F = z, so that the merit is z^2 / 2.
    for (z, share) in [
        (10.0, 1.0),
        (2f64.sqrt() * 1.0001, 1.0),
        (0.5f64.sqrt(), 0.5),
        (1e-6, 1e-6 * 0.5f64.sqrt()),
    ] {
        approx::assert_relative_eq!(
            term(proximal, z),
            RESTART_PROXIMAL * 8.0 * share,
            max_relative = 1e-12
        );
    }

    assert_eq!(term(Attempt::number(1), 10.0), 0.0);
}

/// Of a complete path the Newton point, or the fraction asked for; of a ray start its last point.
#[test]
fn a_complete_path_leads_to_the_newton_point() {
    let m = dmatrix![2.0];
    let q = [-6.0];
    let p = LinearMcp::lcp(m.clone(), q.to_vec()).unwrap();
    let options = Options::default();
    let mut run = run(&p, &options);
    let mut target = |path: &Path, fraction: f64| {
        run.target(path, fraction)
            .map(|(point, t)| (point.z[0], t))
            .unwrap()
    };
    let regular = path(m.clone(), &q, &[0.0], &[INF], Start::Regular, &[1.0]);

    assert_eq!(target(&regular, 1.0), (3.0, 1.0));
    assert_eq!(target(&regular, 0.5), (2.0, 0.5));

    let ray = path(m, &q, &[0.0], &[INF], Start::Ray, &[1.0]);
    assert_eq!([target(&ray, 1.0), target(&ray, 0.5)], [(3.0, 1.0); 2]);
}

/// Of a path that ends on a ray the farthest point, or the last one where that is better; never the
/// last one where only a fraction is asked for.
#[test]
fn a_partial_path_leads_to_the_better_of_two_points() {
    // z_2 = 3 - 2.5 t until z_1 leaves its bound at t = 0.8; from there both grow without end while
    // t falls.
    let partial = path(
        dmatrix![-1.0, 1.0; 0.0, 1.0],
        &[-1.0, -0.5],
        &[0.0; 2],
        &[INF; 2],
        Start::Regular,
        &[0.0, 3.0],
    );

    assert_eq!(partial.end, PathEnd::Ray);
    assert_eq!(partial.start, Start::Regular);

    let at = |t: f64| partial.at(t).map(|z| vec![z(0), z(1)]).unwrap();
    let reach = partial.reach();
    let last = partial.last().unwrap().to_vec();
    let last_t = *partial.knots.t(partial.knots.len() - 1);

    assert!(last[0] > 0.01);
    assert!(last_t < reach);
    assert!((reach - 0.8).abs() < 1e-12);

    let options = Options::default();
    for (root, better) in [
        (at(reach), (at(reach), reach)),
        (last.clone(), (last, last_t)),
    ] {
        let p = free(
            2,
            move |z, f| {
                for i in 0..2 {
                    f[i] = z[i] - root[i];
                }
            },
            |_, j| j.fill_with_identity(),
        );
        let mut run = run(&p, &options);
        let mut target = |fraction: f64| {
            run.target(&partial, fraction)
                .map(|(point, t)| (point.z.as_slice().to_vec(), t))
                .unwrap()
        };

        assert_eq!(target(1.0), better);
        assert_eq!(target(0.5), (at(0.5 * reach), 0.5 * reach));
    }
}

/// F = z on the line, from z = 8 with reference merit 32: a path to -80 is searched back from its
/// end.
#[test]
fn a_path_is_searched_back_to_a_point_that_passes() {
    let p = free(1, |z, f| f[0] = z[0], |_, j| j[(0, 0)] = 1.0);
    let options = Options::default();
    let attempt = Attempt {
        acceptance: Acceptance::Monotone,
        ..Attempt::number(1)
    };

    // A linear model that overshoots: 88 / 8 = 11 times too far.
    let overshoot = path(
        dmatrix![1.0 / 11.0],
        &[8.0 - 8.0 / 11.0],
        &[-INF],
        &[INF],
        Start::Regular,
        &[8.0],
    );

    assert!((overshoot.last().unwrap()[0] + 80.0).abs() < 1e-9);

    let mut run = run(&p, &options);
    let point = run.problem.point_with(|_| 8.0);
    let mut search = NonMonotoneRule::default();
    search.begin(&point, &point, &options, attempt);
    let (next, kind) = run
        .back_along_paths(std::slice::from_ref(&overshoot), &mut search)
        .unwrap();

    // t = 1, 1/2, 1/4 and 1/8 lead to -80, -36, -14 and -3.
    assert_eq!(kind, StepKind::Search { t: 0.125 });
    approx::assert_relative_eq!(next.z[0], -3.0, max_relative = 1e-9);

    // Its merit is what the next one must pass.
    assert!(search.passes(&run.problem.point_with(|_| 2.99), 1.0));
    assert!(!search.passes(&run.problem.point_with(|_| 3.01), 1.0));

    // A ray start does not begin at the iterate.
    let ray = Path {
        start: Start::Ray,
        ..overshoot.clone()
    };
    search.begin(&point, &point, &options, attempt);

    assert!(run.back_along_paths(&[ray], &mut search).is_none());

    // After steps taken unchecked, back along the path of the checkpoint.
    search.begin(
        &point,
        &point,
        &options,
        Attempt {
            acceptance: Acceptance::NonMonotone,
            ..attempt
        },
    );
    search.take_unchecked(&overshoot, &point);
    let (next, kind) = run.back_along_paths(&[], &mut search).unwrap();

    assert_eq!(kind, StepKind::Watchdog { t: 0.25 });
    assert_eq!(run.problem.counters.watchdogs, 1); // 20 times the merit: |z| < 35.7
    approx::assert_relative_eq!(next.z[0], -14.0, max_relative = 1e-9);
}

/// A path to the end if it passes, unchecked inside the radius if not, else nothing.
#[test]
fn an_end_is_checked_or_taken_unchecked() {
    let p = free(1, |z, f| f[0] = z[0], |_, j| j[(0, 0)] = 1.0);
    let step = |slope: f64, acceptance: Acceptance| {
        let options = Options {
            nms_initial_reference_factor: 1.0,
            ..Options::default()
        };
        let way = path(
            dmatrix![slope],
            &[8.0 - 8.0 * slope],
            &[-INF],
            &[INF],
            Start::Regular,
            &[8.0],
        );
        let mut run = run(&p, &options);
        let point = run.problem.point_with(|_| 8.0);
        let mut search = NonMonotoneRule::default();
        search.begin(
            &point,
            &point,
            &options,
            Attempt {
                acceptance,
                ..Attempt::number(1)
            },
        );
        run.path_end(&point, &[way], &mut search)
            .map(|(next, kind)| (next.z[0].round(), kind))
    };

    assert_eq!(
        step(1.0, Acceptance::Monotone),
        Some((0.0, StepKind::Path { t: 1.0 }))
    );
    assert_eq!(step(0.25, Acceptance::Monotone), None); // to -24
    assert_eq!(
        step(0.25, Acceptance::NonMonotone),
        Some((-24.0, StepKind::Unchecked { t: 1.0 }))
    );
    assert_eq!(step(1.0 / 64.0, Acceptance::NonMonotone), None); // to -504, beyond 10 (1 + 8)
}

/// Of two paths the complete one leads on, whichever comes first.
#[test]
fn a_complete_path_is_preferred() {
    let p = free(1, |z, f| f[0] = z[0], |_, j| j[(0, 0)] = 1.0);
    let options = Options::default();
    let complete = || path(dmatrix![1.0], &[-2.0], &[0.0], &[INF], Start::Ray, &[0.0]);
    let partial = || Path {
        end: PathEnd::Ray,
        ..path(
            dmatrix![1.0],
            &[-5.0],
            &[0.0],
            &[INF],
            Start::Regular,
            &[8.0],
        )
    };

    for paths in [[partial(), complete()], [complete(), partial()]] {
        let mut run = run(&p, &options);
        let point = run.problem.point_with(|_| 8.0);
        let mut search = NonMonotoneRule::default();
        search.begin(&point, &point, &options, Attempt::number(1));
        let (next, _) = run.path_end(&point, &paths, &mut search).unwrap();

        assert_eq!(next.z[0], 2.0);
    }
}

/// The gradient step counts, ends with the limit, and leaves from the best point.
#[test]
fn gradient_steps_leave_from_the_best_point() {
    let p = free(1, |z, f| f[0] = z[0], |_, j| j[(0, 0)] = 1.0);
    let options = Options {
        gradient_step_limit: 1,
        ..Options::default()
    };
    let mut run = run(&p, &options);
    let start = run.problem.point_with(|_| 8.0);
    let better = run.problem.point_with(|_| 2.0);
    let mut search = NonMonotoneRule::default();
    search.begin(&start, &start, &options, Attempt::number(0));
    search.take_checked(&better);
    let (next, kind) = run.gradient(&mut search).unwrap().unwrap();

    assert_eq!(next.z[0], 0.0);
    assert_eq!(kind, StepKind::Gradient);
    assert_eq!(run.problem.counters.gradient_steps, 1);
    assert!(run.gradient(&mut search).unwrap().is_none());
}

/// Limits of the run come before the share of the attempt.
#[test]
fn attempts_end_at_the_limits() {
    let reason = |majors: usize, pivots: usize, done: Counters| {
        let p = infeasible();
        let options = Options {
            major_iteration_limit: majors,
            cumulative_iteration_limit: pivots,
            ..Options::default()
        };
        let mut run = run(&p, &options);
        run.problem.counters = done;
        let mut point = run.problem.point(&dvector![1.0]);
        let mut best = run.problem.copy(&point);
        let mut search = NonMonotoneRule::default();
        search.begin(&point, &point, &options, Attempt::number(1));
        run.majors(&mut point, Attempt::number(1), &mut search, &mut best)
    };
    let done = |majors: usize, pivots: usize| Counters {
        majors,
        pivots,
        ..Counters::default()
    };

    assert_eq!(reason(10, 100, done(10, 0)), Termination::MajorLimit);
    assert_eq!(reason(10, 100, done(0, 100)), Termination::CumulativeLimit);
}

/// The start is moved as the attempt asks; where F is not finite there it stays.
#[test]
fn a_start_is_moved_to_where_the_function_is_finite() {
    let options = Options::default();
    for (pole, moves) in [(false, true), (true, false)] {
        let p = free(
            1,
            move |z, f| f[0] = if pole && z[0] != 1.0 { f64::NAN } else { z[0] },
            |_, j| j[(0, 0)] = 1.0,
        );
        let mut run = run(&p, &options);
        let start = run.problem.point(&DVector::from_element(1, 1.0));
        let moved = run.moved(&start, Attempt::number(3), 3);
        let expected = if moves {
            Attempt::number(3).shifted(1.0, 0, 3)
        } else {
            1.0
        };

        assert_eq!(moved.z[0], expected);
        assert_eq!(expected != 1.0, moves);
    }
}
