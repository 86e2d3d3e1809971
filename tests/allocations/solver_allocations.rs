//! A solver that keeps its storage allocates nothing in its iterations: counted, not assumed.
#![cfg(feature = "testkit")]

use crate::families::{random_case, table1_cases};
use allocation_counter::measure;
use mceip_engine::reduction::{Embedding, Side};
use mceip_mcp::mcp::{LinearMcp, Mcp};
use mceip_mcp::solver::{Options, Solver, StepKind, Termination, solve};
use mceip_model::Admissible;
use nalgebra::DMatrix;

/// Runs twice; allocations of the second run. A run that fails looks at the zeros of its Jacobian
/// once, when it has ended: that is no iteration, and not counted here.
fn warm<P: Mcp>(solver: &mut Solver, problem: &P, start: &[f64], options: &Options) -> u64 {
    solver.run(problem, start, options).unwrap();
    let mut ended = None;
    let count = measure(|| ended = Some(solver.run(problem, start, options).unwrap())).count_total;
    let outcome = solver.outcome(ended.unwrap());
    let looked = matches!(
        outcome.termination,
        Termination::NoProgress
            | Termination::SingularBasis
            | Termination::StructurallySingular { .. }
    );
    let count = count.saturating_sub(if looked {
        7 + problem.dimension() as u64
    } else {
        0
    });
    assert_eq!(
        outcome,
        solve(problem, start, options).unwrap(),
        "whatever was solved before"
    );
    count
}

#[test]
fn a_warm_run_of_the_eigenproblems_allocates_nothing() {
    // Without curves: they follow where the first attempt fails, and do allocate.
    let options = Options {
        curve_step_limit: 0,
        ..Options::default()
    };
    let mut solver = Solver::new();
    let (mut runs, mut pivots, mut restarts, mut gradients) = (0, 0, 0, 0);
    let random = [
        ("lambda2", 5),
        ("lambda2", 10),
        ("lambda2", 20),
        ("mu", 5),
        ("mu", 10),
        ("mu", 20),
    ];
    let cases = random
        .into_iter()
        .flat_map(|(family, n)| (0..12).map(move |k| random_case(family, n, 1, k)));
    for case in cases.chain(table1_cases().into_iter().step_by(7)) {
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
    assert!(
        runs > 200 && pivots > 5000 && restarts > 20 && gradients > 0,
        "{runs} {pivots} {restarts} {gradients}"
    );
}

#[test]
fn restarts_rays_watchdogs_and_gradient_steps_allocate_nothing() {
    let options = Options {
        curve_step_limit: 0,
        ..Options::default()
    };
    let mut solver = Solver::new();
    // Infeasible: every fallback is tried in vain.
    let infeasible =
        LinearMcp::lcp(nalgebra::dmatrix![-1.0, 0.5; 0.5, -1.0], vec![-1.0, -1.0]).unwrap();
    // The matrix of ones: a singular start, repaired by artificials.
    let ones = LinearMcp::lcp(DMatrix::from_element(4, 4, 1.0), vec![-1.0; 4]).unwrap();
    let murty = DMatrix::from_fn(9, 9, |i, j| {
        if i == j {
            1.0
        } else {
            2.0 * f64::from(u8::from(j > i))
        }
    });
    let murty = LinearMcp::lcp(murty, vec![-1.0; 9]).unwrap();
    let mut kinds = Vec::new();
    for problem in [&infeasible, &ones, &murty] {
        for start in [0.0, 0.3, 7.0] {
            let start: Vec<f64> = (0..problem.dimension())
                .map(|i| start * (1.0 + 0.1 * i as f64))
                .collect();
            for options in [
                &options,
                &Options {
                    crash_iteration_limit: 0,
                    ..options.clone()
                },
            ] {
                assert_eq!(warm(&mut solver, problem, &start, options), 0, "{start:?}");
                kinds.extend(
                    solve(problem, &start, options)
                        .unwrap()
                        .log
                        .into_iter()
                        .map(|record| record.step),
                );
            }
        }
    }
    assert!(
        kinds.contains(&StepKind::Restart)
            && kinds.contains(&StepKind::Failed)
            && kinds.contains(&StepKind::Crash)
    );
}

/// The counter counts: a cold run allocates, and so does the log.
#[test]
fn a_cold_run_allocates() {
    let lcp = LinearMcp::lcp(nalgebra::dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
    let cold = measure(|| drop(solve(&lcp, &[0.0, 0.0], &Options::default()))).count_total;
    assert!(cold > 10, "{cold}");
}
