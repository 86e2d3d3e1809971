//! The solver on systems with particles in contact with zero reaction (z): what it finds against
//! `enumerate_modes`, which lists all solutions by exact arithmetic.
//!
//! Random systems with one to three s particles, one or two z particles and others beside them.
//! Each certified solution must be in the list, and coverage is held against a floor, which is not
//! below that of the family `states`, the same systems without z.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim, EnclosedSolution};
use mceip_check::check;
use mceip_engine::certify::Preference;
use mceip_engine::multistart::{
    CertifiedCandidate, MultistartFound, Search, exact_value, multistart, support,
};
use mceip_engine::reduction::{Embedding, Side};
use mceip_engine::run::Watch;
use mceip_mcp::mcp::Mcp;
use mceip_model::reduction::{reduce, reduce_system};
use mceip_model::{Admissible, Body, ContactState, Problem, Reduced, Window};
use mceip_oracle::{Solution, enumerate_modes, is_between};
use mceip_testkit::floors::{Coverage, Starts, floor, shortfalls};
use mceip_testkit::generators::states::ZeroModes;
use mceip_testkit::generators::{rng, states, unknown};
use mceip_testkit::{in_doubles, system_of};
use nalgebra::DMatrix;
use rand::RngExt;

/// Number of this family of random systems, and of those with many free degrees of freedom.
const FAMILY: u64 = 92;
const LARGE_FAMILY: u64 = 93;

/// Name of its row in the floors.
const FLOOR: &str = "zero reaction";

/// Particles in state `free` of a large system: 16 free degrees of freedom and one variable more
/// make a claim a box.
const MANY_FREE: usize = 8;
const LARGE_SYSTEMS: u64 = 4;

/// Systems of the plain run and of the opt-in run.
const FEW: u64 = 60;
const MANY: u64 = 2_000;

/// What a run has met.
#[derive(Debug, Default)]
struct Met {
    coverage: Coverage,
    without_solution: usize,
    degenerate: usize,
    uncertified: usize,
    modes: ZeroModes,
}

fn random_problem(index: u64) -> Problem {
    let system = states::system_with_zero(FAMILY, index, 3, 2).unwrap();
    Problem::new(Body::System(system), unknown(index), Window::all()).unwrap()
}

fn search(problem: &Problem) -> MultistartFound {
    let reduced = reduce(problem).unwrap();
    // The list has exact values.
    let search = Search {
        preference: Preference::Exact,
        ..Search::default()
    };
    multistart(problem, &reduced, &search, &Watch::nobody()).unwrap()
}

/// Is a certified solution that of the list?
fn is_listed_as(certified: &CertifiedCandidate, solution: &Solution) -> bool {
    let mut value = exact_value(&certified.claim).unwrap();
    let has_same_value = value.equals(&mut solution.value.clone());
    has_same_value && support(&certified.claim) == solution.slip
}

/// Solves a problem and compares with the list of all solutions.
fn compare(index: u64, met: &mut Met) {
    let problem = random_problem(index);
    let split = reduce_system(system_of(&problem), problem.unknown()).unwrap();
    let all = enumerate_modes(&split, &Window::all());
    if !all.degenerate.is_empty() {
        met.degenerate += 1;
        return;
    }

    let found = search(&problem);
    met.uncertified += found.uncertified.len();
    for certified in &found.certified {
        let is_known = |solution: &&Solution| is_listed_as(certified, solution);
        let same = all.solutions.iter().filter(is_known).count();
        assert_eq!(same, 1, "system {index}: {certified:?}");
        met.modes.count(&split, support(&certified.claim));
        assert_the_opposite_is_refused(&problem, &certified.claim);
    }

    if all.solutions.is_empty() {
        assert!(found.certified.is_empty(), "system {index}");
        met.without_solution += 1;
        return;
    }

    let by_the_first = found.certified.iter().any(|certified| certified.run == 0);
    let is_complete = found.certified.len() == all.solutions.len();
    if !is_complete {
        let missed = all.solutions.len() - found.certified.len();
        println!("system {index}: {missed} missed of {}", all.solutions.len());
    }
    met.coverage.count(by_the_first, is_complete);
}

/// A system of the large family: one or two s particles, one or two z particles, free ones.
fn large_problem(index: u64) -> Problem {
    let mut rng = rng(LARGE_FAMILY, index);
    let sign = if index % 4 < 2 { 1 } else { -1 };
    let mut states = vec![ContactState::Slip { sign }];
    if rng.random_range(0..2) == 0 {
        states.push(ContactState::Slip { sign: -sign });
    }
    states.extend(vec![ContactState::Zero; rng.random_range(1..=2)]);
    states.extend(vec![ContactState::Free; MANY_FREE]);

    let system = states::system(&mut rng, &states, &mut Vec::new()).unwrap();
    Problem::new(Body::System(system), unknown(index), Window::all()).unwrap()
}

/// Is the solution of the list in the box?
fn is_in(claim: &EnclosedSolution, solution: &Solution) -> bool {
    let center = &claim.center.last().unwrap().0;
    let radius = &claim.radius.last().unwrap().0;
    let is_in = is_between(&solution.value, &(center - radius), &(center + radius));
    solution.slip == claim.support && is_in
}

/// With more than 16 active variables claims are boxes. Each is that of one solution of the list,
/// the checker accepts it, and refuses it where a half of v_T is exchanged for the other one.
#[test]
fn large_systems_are_certified_by_boxes() {
    let mut met = Met::default();
    for index in 0..LARGE_SYSTEMS {
        let problem = large_problem(index);
        let split = reduce_system(system_of(&problem), problem.unknown()).unwrap();
        let all = enumerate_modes(&split, &Window::all());
        assert!(all.degenerate.is_empty(), "system {index}");

        let found = search(&problem);
        assert!(found.uncertified.is_empty(), "system {index}");
        for certified in &found.certified {
            let Claim::EnclosedSolution(claim) = &certified.claim else {
                panic!("system {index}: not a box")
            };
            let same = all.solutions.iter().filter(|one| is_in(claim, one)).count();
            assert_eq!(same, 1, "system {index}");
            met.modes.count(&split, &claim.support);
            assert_the_other_half_is_refused(&problem, &split, claim);
        }

        if !all.solutions.is_empty() {
            let by_the_first = found.certified.iter().any(|certified| certified.run == 0);
            let is_complete = found.certified.len() == all.solutions.len();
            met.coverage.count(by_the_first, is_complete);
        }
    }

    println!("{met:?}");
    let short = shortfalls(FLOOR, Starts::Search, &met.coverage);
    assert!(short.is_empty(), "{short:?}, {met:?}");
    assert!(met.modes.rarest() >= 1, "{met:?}");
}

/// The checker accepts the box, and not the same box about the other half of v_T.
fn assert_the_other_half_is_refused(problem: &Problem, split: &Reduced, claim: &EnclosedSolution) {
    let good = Claim::EnclosedSolution(claim.clone());
    let accepted = check(problem, &Certificate::of_claims(problem, vec![good]));
    assert!(accepted.is_ok(), "{accepted:?}");

    for variables in &split.zero {
        let mut forged = claim.clone();
        for index in &mut forged.support {
            if *index == variables.right {
                *index = variables.left;
            } else if *index == variables.left {
                *index = variables.right;
            }
        }
        if forged != *claim {
            let forged = Claim::EnclosedSolution(forged);
            assert!(check(problem, &Certificate::of_claims(problem, vec![forged])).is_err());
        }
    }
}

/// The floor is not below that of the same systems without z.
#[test]
fn the_floor_is_that_of_systems_without_zero_reaction_or_higher() {
    let without = floor("states", Starts::Search).unwrap();
    let with = floor(FLOOR, Starts::Search).unwrap();

    assert!(with.first >= without.first, "{with:?}");
    assert!(with.all >= without.all, "{with:?}");
}

/// The checker accepts the claim, and refuses -x.
fn assert_the_opposite_is_refused(problem: &Problem, claim: &Claim) {
    let accepted = check(
        problem,
        &Certificate::of_claims(problem, vec![claim.clone()]),
    );
    assert!(accepted.is_ok(), "{accepted:?}");

    let Claim::ExactSolution(mut opposite) = claim.clone() else {
        panic!("claims about so few variables are exact")
    };
    for coefficient in opposite.x.iter_mut().flatten() {
        coefficient.0 = -coefficient.0.clone();
    }
    let forged = Certificate::of_claims(problem, vec![Claim::ExactSolution(opposite)]);
    assert!(check(problem, &forged).is_err());
}

fn run(systems: std::ops::Range<u64>) -> Met {
    let mut met = Met::default();
    for index in systems {
        compare(index, &mut met);
    }

    println!("{met:?}");
    let short = shortfalls(FLOOR, Starts::Search, &met.coverage);
    assert!(short.is_empty(), "{short:?}, {met:?}");
    met
}

#[test]
fn solutions_with_zero_reaction_are_found_and_certified() {
    let met = run(0..FEW);

    assert!(met.coverage.solvable >= 15, "{met:?}");
    assert!(met.without_solution >= 10, "{met:?}");
    assert!(met.modes.rarest() >= 3, "{met:?}");
}

#[test]
#[ignore = "minutes in release"]
fn solutions_with_zero_reaction_of_two_thousand_systems_are_found() {
    let met = run(FEW..FEW + MANY);

    assert!(met.coverage.solvable >= 500, "{met:?}");
    assert!(met.modes.rarest() >= 100, "{met:?}");
}

/// Each solution of the list is a zero of the MCP's normal map: rows of free unknowns vanish, the
/// others have the signs that their bounds ask for.
#[test]
fn every_solution_solves_the_mcp() {
    let mut solutions = 0;
    for index in 0..FEW {
        let problem = random_problem(index);
        let split = reduce_system(system_of(&problem), problem.unknown()).unwrap();
        let admissible = Admissible::new(&split.pencil, problem.unknown()).unwrap();
        let embedding = Embedding::with_zero(&admissible, &split.zero, Side::Above(0.0));

        for solution in &enumerate_modes(&split, &Window::all()).solutions {
            let candidate = in_doubles(solution, &split.normalised());
            let x = candidate.x;

            let z = embedding.point(candidate.value, &x);

            assert!(residual(&embedding, &z) < 1e-6, "system {index}: {z:?}");
            let back = embedding.candidate(&z);
            let scale: f64 = split.normalised().iter().map(|&i| back.x[i]).sum();
            for (there, given) in back.x.iter().zip(&x) {
                let there = there / scale;
                approx::assert_relative_eq!(there, *given, epsilon = 1e-9, max_relative = 1e-9);
            }
            solutions += 1;
        }
    }

    assert!(solutions >= 20, "{solutions}");
}

/// The largest violation of a line of the MCP.
fn residual(embedding: &Embedding, z: &[f64]) -> f64 {
    let mut f = vec![0.0; z.len()];
    embedding.function(z, &mut f);

    let mut largest: f64 = 0.0;
    for (i, &f_i) in f.iter().enumerate() {
        let nearest = (z[i] - f_i).clamp(embedding.lower()[i], embedding.upper()[i]);
        largest = largest.max((z[i] - nearest).abs());
    }
    largest
}

/// The Jacobian against difference quotients: F is a polynomial of degree three.
#[test]
fn the_jacobian_is_the_derivative() {
    for index in 0..20 {
        let problem = random_problem(index);
        let split = reduce_system(system_of(&problem), problem.unknown()).unwrap();
        let admissible = Admissible::new(&split.pencil, problem.unknown()).unwrap();
        let embedding = Embedding::with_zero(&admissible, &split.zero, Side::Above(0.0));
        let n = embedding.dimension();

        for z in embedding.starts(8, index) {
            let mut jacobian = DMatrix::from_element(n, n, f64::NAN);
            embedding.jacobian(&z, &mut jacobian);
            for k in 0..n {
                let quotient = difference_quotient(&embedding, &z, k);
                for i in 0..n {
                    let size = 1e-4 * (1.0 + quotient[i].abs());
                    approx::assert_abs_diff_eq!(jacobian[(i, k)], quotient[i], epsilon = size);
                }
            }
        }
    }
}

/// The central difference quotient in unknown k.
fn difference_quotient(embedding: &Embedding, z: &[f64], k: usize) -> Vec<f64> {
    let step = 1e-5 * (1.0 + z[k].abs());
    let at = |shift: f64| {
        let mut moved = z.to_vec();
        moved[k] += shift;
        let mut f = vec![0.0; z.len()];
        embedding.function(&moved, &mut f);
        f
    };

    let pairs = at(step).into_iter().zip(at(-step));
    pairs
        .map(|(above, below)| (above - below) / (2.0 * step))
        .collect()
}
