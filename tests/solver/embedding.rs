//! Propositions 1 and 2 of the paper: the eigenproblem as a mixed complementarity problem.
//!
//! The truth is the exact enumerator. Each solution it lists must solve the embedding, and nothing
//! beside it; what the solver finds in the embedding must be certified, or reported. Further the
//! Remark on definite K0, the window in zeta, the constant c, and that no embedding is monotone.
#![cfg(feature = "testkit")]

use mceip_engine::candidate::Candidate;
use mceip_engine::multistart::{Search, multistart};
use mceip_engine::reduction::{Embedding, Side};
use mceip_engine::run::Watch;
use mceip_exact::{to_f64, whole};
use mceip_mcp::mcp::Mcp;
use mceip_mcp::solver::{Options, Residuals, solve};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Pencil, Unknown, Window};
use mceip_oracle::{Solution, enumerate};
use mceip_testkit::{Instance, in_doubles, mechanical, random_pencils};

fn instances() -> Vec<Instance> {
    let mut instances = random_pencils(40, 11).unwrap();
    instances.extend(mechanical(20, 11).unwrap());
    instances
}

fn pencil_of(instance: &Instance) -> Pencil {
    reduce(&instance.problem).unwrap().pencil
}

/// The embedding of the whole half line.
fn embedding_of(instance: &Instance, pencil: &Pencil) -> Embedding {
    let admissible = Admissible::new(pencil, instance.problem.unknown()).unwrap();
    Embedding::new(&admissible, Side::Above(0.0))
}

fn solutions(pencil: &Pencil) -> Vec<Solution> {
    enumerate(pencil, &Window::all()).unwrap().solutions
}

/// The point of the embedding that stands for a solution.
fn point_of(embedding: &Embedding, pencil: &Pencil, solution: &Solution) -> Vec<f64> {
    let Candidate { value, x } = in_doubles(solution, &pencil.slip());
    embedding.point(value, &x)
}

/// "Only if": every solution of the eigenproblem, normalised, solves the MCP with gamma = 0.
#[test]
fn solutions_of_the_eigenproblem_solve_the_mcp() {
    let mut count = 0;

    for instance in instances() {
        let label = &instance.label;
        let pencil = pencil_of(&instance);
        let embedding = embedding_of(&instance, &pencil);

        for solution in solutions(&pencil) {
            let point = point_of(&embedding, &pencil, &solution);
            let residuals = Residuals::at(&embedding, &point);
            // Basis: 17-digit data of order one in units of the scaled pencil.
            assert!(residuals.minimum_map < 1e-9, "{label}: {residuals:?}");
            assert!(residuals.normal_map < 1e-9, "{label}: {residuals:?}");

            let mut beside = point;
            beside[0] += 0.1;
            let residuals = Residuals::at(&embedding, &beside);
            assert!(residuals.minimum_map > 1e-6, "{label}");
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

/// "If": what solves the MCP is certified as a solution of the eigenproblem, or reported.
#[test]
fn solutions_of_the_mcp_are_certified_or_reported() {
    for instance in instances() {
        let problem = &instance.problem;
        let reduced = reduce(problem).unwrap();

        let found = multistart(problem, &reduced, &Search::default(), &Watch::nobody()).unwrap();

        let mut reached = 0;
        for (termination, count) in &found.terminations {
            if termination.reached_tolerance() {
                reached += count;
            }
        }
        let certified = found.certified.len();
        let reported = found.uncertified.len() + found.repeated + found.outside;
        assert_eq!(reached, certified + reported, "{}", instance.label);
    }
}

/// The Remark: K0 definite makes every MCEIP-mu value positive.
#[test]
fn mu_is_positive_when_k0_is_definite() {
    let zero = Window::new(whole(0), Some(whole(0))).unwrap();

    for instance in instances() {
        if instance.problem.unknown() != Unknown::Mu {
            continue;
        }
        let label = &instance.label;
        let at_zero = enumerate(&pencil_of(&instance), &zero).unwrap();
        assert!(at_zero.solutions.is_empty(), "{label}");
        assert!(at_zero.wide.is_empty(), "{label}");
    }
}

/// The values that six starts find in an embedding.
fn found_values(embedding: &Embedding) -> Vec<f64> {
    let mut values = Vec::new();
    for start in embedding.starts(6, 3) {
        let outcome = solve(embedding, &start, &Options::default()).unwrap();
        if outcome.termination.reached_tolerance() {
            values.push(embedding.candidate(&outcome.point).value);
        }
    }
    values
}

/// zeta = t - t0 finds only values above t0, zeta = t0 - t only values below.
#[test]
fn windows_keep_to_their_side() {
    let mut found_above = 0;
    let mut found_below = 0;

    for instance in instances() {
        let pencil = pencil_of(&instance);
        let admissible = Admissible::new(&pencil, instance.problem.unknown()).unwrap();
        let solutions = solutions(&pencil);
        let Some(first) = solutions.first() else {
            continue;
        };
        let value = to_f64(&first.value.interval().mid());
        let slack = 1e-9 * (1.0 + value);

        let lower = value * 0.5;
        let above = Embedding::new(&admissible, Side::Above(lower));
        for found in found_values(&above) {
            assert!(found >= lower - slack);
            found_above += 1;
        }

        let upper = value * 1.5;
        let below = Embedding::new(&admissible, Side::Below(upper));
        for found in found_values(&below) {
            assert!(found <= upper + slack);
            found_below += 1;
        }
    }

    assert!(found_above > 10, "{found_above} {found_below}");
    assert!(found_below > 10, "{found_above} {found_below}");
}

/// The same value, and five times the vector.
fn assert_is_five_times(large: &Candidate, small: &Candidate, label: &str) {
    let error = (large.value - small.value).abs();
    assert!(error <= 1e-7 * (1.0 + small.value));

    for (component, small_component) in large.x.iter().zip(&small.x) {
        let error = (component - 5.0 * small_component).abs();
        assert!(error < 1e-6, "{label}");
    }
}

/// c only sets the scale of x; gamma vanishes wherever t > 0.
#[test]
fn the_constant_c_scales_x_and_nothing_else() {
    let mut count = 0;

    for instance in instances() {
        let label = &instance.label;
        let pencil = pencil_of(&instance);
        let with_one = embedding_of(&instance, &pencil);
        assert!(with_one.clone().with_c(0.0).is_none());
        assert!(with_one.clone().with_c(f64::NAN).is_none());
        let with_five = with_one.clone().with_c(5.0).unwrap();

        for solution in solutions(&pencil) {
            let point = point_of(&with_five, &pencil, &solution);
            assert!(Residuals::at(&with_five, &point).minimum_map < 1e-8);
            assert!(with_five.gamma(&point).abs() < 1e-12);
            assert!((with_one.gamma(&point) - 4.0).abs() < 1e-12);

            // The point of the other constant is no solution: e'x_s = c is asked for. // E28, E33
            let point_of_one = point_of(&with_one, &pencil, &solution);
            let residuals = Residuals::at(&with_five, &point_of_one);
            assert!(residuals.minimum_map > 1e-3, "{label}");

            let outcome = solve(&with_five, &point, &Options::default()).unwrap();
            assert!(outcome.termination.reached_tolerance());
            let found = with_five.candidate(&outcome.point);
            let plain = with_one.candidate(&point_of_one);
            assert_is_five_times(&found, &plain, label);
            count += 1;
        }
    }
    assert!(count > 20);
}

/// A point of the embedding, and its function there.
struct Evaluated {
    z: Vec<f64>,
    f: Vec<f64>,
}

/// Everything zero but one slip variable and zeta, which is the last variable.
fn evaluated_at(embedding: &Embedding, slip_index: usize, slip: f64, zeta: f64) -> Evaluated {
    let dimension = embedding.dimension();
    let mut z = vec![0.0; dimension];
    z[slip_index] = slip;
    z[dimension - 1] = zeta;

    let mut f = vec![0.0; dimension];
    embedding.function(&z, &mut f);
    Evaluated { z, f }
}

/// (F(p) - F(q))'(p - q), which is never negative if F is monotone.
fn monotonicity_product(p: &Evaluated, q: &Evaluated) -> f64 {
    let mut sum = 0.0;
    for i in 0..p.z.len() {
        sum += (p.f[i] - q.f[i]) * (p.z[i] - q.z[i]);
    }
    sum
}

/// Section 4: neither problem is monotone.
///
/// F(x, t) is ((A + tB) x, e'x_s - c). The points p = (0, t + L) and q = (s e_i, t) have
/// (F(p) - F(q))'(p - q) = s^2 (A + tB)_ii - s L, which is negative for small s.
#[test]
fn neither_mcp_is_monotone() {
    for instance in instances() {
        let pencil = pencil_of(&instance);
        let embedding = embedding_of(&instance, &pencil);
        let slip_index = pencil.slip()[0];

        let higher = evaluated_at(&embedding, slip_index, 0.0, 1.0);
        let mut is_negative_somewhere = false;
        for halvings in 1..60 {
            let slip = 0.5f64.powi(halvings);
            let slipping = evaluated_at(&embedding, slip_index, slip, 0.0);
            is_negative_somewhere |= monotonicity_product(&higher, &slipping) < 0.0;
        }
        assert!(is_negative_somewhere, "{}", instance.label);
    }
}
