//! A solver that keeps its storage allocates nothing in its iterations.
//!
//! The truth is an allocator that counts. A vector made in an iteration, a restart, a ray, a
//! watchdog step or a gradient step raises the count of a warm run above 0; that the allocator does
//! count is shown by a cold run.
#![cfg(feature = "testkit")]

use crate::families::{Case, random_case, table1_cases};
use allocation_counter::measure;
use mceip_engine::reduction::{Embedding, Side};
use mceip_mcp::mcp::{LinearMcp, Mcp};
use mceip_mcp::solver::{Options, Solver, StepKind, Termination, solve};
use mceip_model::Admissible;
use nalgebra::DMatrix;
use std::cmp::Ordering;

/// Runs twice and counts the allocations of the second run, whose outcome must be that of a new
/// solver. A run that fails looks at the zeros of its Jacobian once, when it has ended: that is no
/// iteration, and not counted here.
fn warm<P: Mcp>(solver: &mut Solver, problem: &P, start: &[f64], options: &Options) -> u64 {
    solver.run(problem, start, options).unwrap();

    let mut ended = None;
    let counted = measure(|| ended = Some(solver.run(problem, start, options).unwrap()));
    let outcome = solver.outcome(ended.unwrap());

    let fresh = solve(problem, start, options).unwrap();
    assert_eq!(outcome, fresh, "whatever was solved before");

    let looks_at_zeros = matches!(
        outcome.termination,
        Termination::NoProgress
            | Termination::SingularBasis
            | Termination::StructurallySingular { .. }
    );
    let allowance = if looks_at_zeros {
        7 + problem.dimension() as u64
    } else {
        0
    };

    counted.count_total.saturating_sub(allowance)
}

/// Options without curves: they follow where the first attempt fails, and do allocate.
fn without_curves() -> Options {
    Options {
        curve_step_limit: 0,
        ..Options::default()
    }
}

#[test]
fn a_warm_run_of_the_eigenproblems_allocates_nothing() {
    let options = without_curves();
    let mut solver = Solver::new();
    let mut runs = 0;
    let mut pivots = 0;
    let mut restarts = 0;
    let mut gradients = 0;

    for case in cases() {
        let Ok(admissible) = Admissible::new(&case.pencil, case.unknown) else {
            continue;
        };
        let embedding = Embedding::new(&admissible, Side::Above(0.0));

        for start in &embedding.starts(3, 0) {
            let allocations = warm(&mut solver, &embedding, start, &options);
            assert_eq!(allocations, 0, "{}", case.label);

            let counters = solve(&embedding, start, &options).unwrap().counters;
            runs += 1;
            pivots += counters.pivots;
            restarts += counters.restarts;
            gradients += counters.gradient_steps;
        }
    }

    println!("{runs} runs, {pivots} pivots, {restarts} restarts, {gradients} gradient steps");
    assert!(runs > 200, "{runs}");
    assert!(pivots > 5000, "{pivots}");
    assert!(restarts > 20, "{restarts}");
    assert!(gradients > 0, "{gradients}");
}

/// Random eigenproblems of three sizes with either unknown, and every seventh point of Table 1.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for family in ["lambda2", "mu"] {
        for order in [5, 10, 20] {
            for k in 0..12 {
                cases.push(random_case(family, order, 1, k));
            }
        }
    }

    cases.extend(table1_cases().into_iter().step_by(7));
    cases
}

#[test]
fn restarts_rays_watchdogs_and_gradient_steps_allocate_nothing() {
    let with_crash = without_curves();
    let without_crash = Options {
        crash_iteration_limit: 0,
        ..without_curves()
    };

    // Infeasible: every fallback is tried and fails.
    let infeasible =
        LinearMcp::lcp(nalgebra::dmatrix![-1.0, 0.5; 0.5, -1.0], vec![-1.0, -1.0]).unwrap();

    // The matrix of ones: a singular start, repaired by artificials.
    let ones = LinearMcp::lcp(DMatrix::from_element(4, 4, 1.0), vec![-1.0; 4]).unwrap();
    let murty = LinearMcp::lcp(murty_matrix(9), vec![-1.0; 9]).unwrap();

    let mut solver = Solver::new();
    let mut kinds = Vec::new();

    for problem in [&infeasible, &ones, &murty] {
        for scale in [0.0, 0.3, 7.0] {
            let start: Vec<f64> = (0..problem.dimension())
                .map(|i| scale * (1.0 + 0.1 * i as f64))
                .collect();

            for options in [&with_crash, &without_crash] {
                let allocations = warm(&mut solver, problem, &start, options);
                assert_eq!(allocations, 0, "{start:?}");

                let log = solve(problem, &start, options).unwrap().log;
                kinds.extend(log.into_iter().map(|record| record.step));
            }
        }
    }

    for kind in [StepKind::Restart, StepKind::Failed, StepKind::Crash] {
        assert!(kinds.contains(&kind), "{kind:?}");
    }
}

/// 1 on the diagonal, 2 above, 0 below: Lemke's method takes exponentially many pivots on it.
fn murty_matrix(order: usize) -> DMatrix<f64> {
    DMatrix::from_fn(order, order, |i, j| match i.cmp(&j) {
        Ordering::Less => 2.0,
        Ordering::Equal => 1.0,
        Ordering::Greater => 0.0,
    })
}

/// The counter counts: a cold run allocates, and so does the log.
#[test]
fn a_cold_run_allocates() {
    let lcp = LinearMcp::lcp(nalgebra::dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();

    let cold = measure(|| drop(solve(&lcp, &[0.0, 0.0], &Options::default())));

    assert!(cold.count_total > 10, "{}", cold.count_total);
}
