//! Newton's method on the Fischer-Burmeister system alone, without paths and without curves.
//!
//! The paper says of it that it needs monotonicity, or a similar property, to be useful. Neither
//! MCP is monotone. How often it converges here all the same is counted; `solve` goes on with paths
//! and curves where it does not. The exact enumerator says which problems have a solution at all.
#![cfg(feature = "testkit")]

use crate::families::random_case;
use mceip_engine::reduction::{Embedding, Side};
use mceip_mcp::solver::{CrashMethod, Options, Outcome, StepKind, solve};
use mceip_model::{Admissible, Window};
use mceip_oracle::enumerate;

/// What came of the first starts of a family.
#[derive(Debug, Default)]
struct Count {
    /// Problems with a solution.
    solvable: usize,
    /// Of these, where Newton alone converges.
    newton: usize,
    /// Of these, where `solve` does.
    whole: usize,
}

/// The options that leave nothing but Newton's method.
fn newton_alone() -> Options {
    Options {
        crash_method: CrashMethod::FischerNewton,
        crash_iteration_limit: 500,
        major_iteration_limit: 1,
        restart_limit: 0,
        curve_step_limit: 0,
        ..Options::default()
    }
}

/// Did Newton's method get there? What ends without a path is due to it.
fn is_due_to_newton(outcome: &Outcome) -> bool {
    let mut steps = outcome.log.iter();
    let is_newton = steps.all(|record| record.step == StepKind::FischerNewton);
    is_newton && outcome.termination.reached_tolerance()
}

fn count_first_starts(family: &str, n: usize) -> Count {
    let mut count = Count::default();

    for k in 0..40 {
        let case = random_case(family, n, 1, k);
        let truth = enumerate(&case.pencil, &Window::all()).unwrap();
        if truth.solutions.is_empty() {
            continue;
        }

        let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
        let embedding = Embedding::new(&admissible, Side::Above(0.0));
        let start = &embedding.starts(1, 0)[0];
        let alone = solve(&embedding, start, &newton_alone()).unwrap();
        let whole = solve(&embedding, start, &Options::default()).unwrap();

        count.solvable += 1;
        count.newton += usize::from(is_due_to_newton(&alone));
        count.whole += usize::from(whole.termination.reached_tolerance());
    }
    count
}

#[test]
fn newton_on_the_fischer_function_converges_on_a_part_of_the_problems() {
    for (family, n) in [("lambda2", 5), ("mu", 5), ("mu", 10)] {
        let count = count_first_starts(family, n);
        let label = format!("{family} n={n}: {count:?}");
        println!("{label}");

        assert!(count.solvable >= 20, "{label}");
        assert_eq!(count.whole, count.solvable, "{label}");
        assert!(4 * count.newton >= count.solvable, "{label}");
        assert!(count.newton < count.solvable, "{label}");
    }
}
