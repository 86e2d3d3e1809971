//! The solver on structured random values, which proptest shrinks when they fail.
//!
//! The values are pencils, sign patterns, contact states, frames and index sets. The truth is the
//! exact enumerator, and the closed form of Table 1 for two particles. Everything certified must be
//! in that answer (soundness), and over all cases the solver must find as much as its floor asks
//! for (coverage, `crates/testkit/src/floors.rs`). Two tests check that failures shrink.
#![cfg(feature = "testkit")]

use mceip_check::certificate::Certificate;
use mceip_check::{AcceptedClaim, check};
use mceip_engine::multistart::{CertifiedCandidate, Search};
use mceip_engine::run::Watch;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{
    Admissible, Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window,
};
use mceip_oracle::{ClosedSolution, TwoParticles, table1};
use mceip_paper::two_particles;
use mceip_testkit::floors::{Coverage, Starts, shortfalls};
use mceip_testkit::generators::{gram_of, sparse};
use mceip_testkit::{Instance, Treatment, coverage_of, from_interior};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use std::cell::RefCell;

/// Order of the largest factor; a structure of order n takes its leading n rows and columns.
const MOST: usize = 6;

/// Cases of each property.
const CASES: u32 = 150;

fn search() -> Search {
    Search {
        starts: 6,
        window_starts: 1,
        ..Search::default()
    }
}

/// A matrix of small integers; zeros are what it shrinks to.
fn matrices(largest: i64) -> impl Strategy<Value = Vec<Vec<i64>>> {
    let row = prop::collection::vec(-largest..=largest, MOST);
    prop::collection::vec(row, MOST)
}

/// The leading `n` rows and columns.
fn leading(matrix: &[Vec<i64>], n: usize) -> Vec<Vec<i64>> {
    matrix[..n].iter().map(|row| row[..n].to_vec()).collect()
}

/// GG' + I over the leading `n` rows and columns of G.
fn definite(factor: &[Vec<i64>], n: usize) -> Sparse {
    sparse(&gram_of(&leading(factor, n), 1))
}

fn unknown(is_mu: bool) -> Unknown {
    if is_mu { Unknown::Mu } else { Unknown::Lambda2 }
}

fn everywhere(body: Body, unknown: Unknown) -> Problem {
    Problem::new(body, unknown, Window::all()).unwrap()
}

/// The numbers c and s of a rational angle: c = (p^2 - q^2) / h and s = 2 p q / h, where h = p^2 +
/// q^2.
fn on_the_circle(p: i64, q: i64) -> (Rational, Rational) {
    let h = p * p + q * q;
    (rational(p * p - q * q, h), rational(2 * p * q, h))
}

/// What the enumerator and the solver say of a problem; an error names what is unsound.
fn judged(problem: Problem) -> Result<Coverage, String> {
    let instance = Instance::new("property".into(), problem, Vec::new());
    let treatment = Treatment::of(&search());
    let report = coverage_of(&instance, &treatment).map_err(|error| error.to_string())?;

    if let Some(unsound) = report.disagreements.first() {
        return Err(unsound.to_string());
    }
    Ok(report
        .coverage()
        .first()
        .map_or(Coverage::default(), |named| named.1))
}

/// A runner that draws the same values on every machine.
fn runner(cases: u32, seed: u8) -> TestRunner {
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
    TestRunner::new_with_rng(config, rng)
}

/// Judges so many values and sums what was found.
fn sum_over<S: Strategy>(
    values: &S,
    (cases, seed): (u32, u8),
    judge: fn(S::Value) -> Result<Coverage, String>,
) -> Coverage {
    let sum = RefCell::new(Coverage::default());
    let outcome = runner(cases, seed).run(values, |value| {
        let coverage = judge(value).map_err(TestCaseError::fail)?;
        sum.borrow_mut().add(&coverage);
        Ok(())
    });

    outcome.unwrap_or_else(|error| panic!("{error}"));
    sum.into_inner()
}

/// Fails unless enough problems have solutions and the solver finds as much as the floor asks for.
fn assert_reaches_floor(family: &str, starts: Starts, coverage: &Coverage) {
    println!("{coverage:?}");
    assert!(coverage.solvable >= 30, "{coverage:?}");
    assert_eq!(shortfalls(family, starts, coverage), []);
}

/// What a value shrinks to where having a solution counts as a failure.
fn smallest_with_a_solution<S: Strategy>(
    values: &S,
    seed: u8,
    judge: fn(S::Value) -> Result<Coverage, String>,
) -> S::Value {
    let outcome = runner(200, seed).run(values, |value| match judge(value) {
        Ok(Coverage { solvable: 0, .. }) => Ok(()),
        other => Err(TestCaseError::fail(format!("{other:?}"))),
    });

    match outcome {
        Err(TestError::Fail(_, small)) => small,
        _ => panic!("nothing has a solution"),
    }
}

/// A mechanical system as a structure.
#[derive(Debug, Clone)]
struct Structure {
    /// Their degrees of freedom are those of their places in the list.
    particles: Vec<Particle>,
    inner: usize,
    stiffness: Vec<Vec<i64>>,
    mass: Vec<Vec<i64>>,
    quarters_of_friction: i64,
    is_mu: bool,
}

/// A particle of any state and direction, with an oblique frame now and then.
fn particles() -> impl Strategy<Value = Particle> {
    let state = prop_oneof![
        3 => Just(ContactState::Slip { sign: 1 }),
        3 => Just(ContactState::Slip { sign: -1 }),
        1 => Just(ContactState::Stick),
        1 => Just(ContactState::Free),
    ];
    let direction = prop::sample::select(&[-1, 1]);
    let angle = prop::option::weighted(0.3, (1i64..=5, -4i64..=4));

    (state, direction, angle).prop_map(|(state, normal_direction, angle)| Particle {
        normal_direction,
        frame: angle.map(|(p, q)| {
            let (c, s) = on_the_circle(p, q);
            [[c.clone(), s.clone()], [-s, c]]
        }),
        ..Particle::plain(0, 1, state)
    })
}

/// Systems of up to one particle more than the first, with up to two inner degrees of freedom:
/// order at most 6.
fn structures() -> impl Strategy<Value = Structure> {
    let shape = (prop::collection::vec(particles(), 0..=1), 0usize..=2);
    (shape, matrices(2), matrices(2), 1i64..=80, any::<bool>()).prop_map(
        |((particles, inner), stiffness, mass, quarters_of_friction, is_mu)| Structure {
            particles,
            inner,
            stiffness,
            mass,
            quarters_of_friction,
            is_mu,
        },
    )
}

/// The problem of a structure; one more particle, in impending slip, stands first, so that there is
/// always one.
fn judge_structure(structure: Structure) -> Result<Coverage, String> {
    let first = Particle::plain(0, 1, ContactState::Slip { sign: 1 });
    let mut particles = vec![first];
    particles.extend(structure.particles);
    for (k, particle) in particles.iter_mut().enumerate() {
        particle.tangential = 2 * k;
        particle.normal = 2 * k + 1;
    }

    let n = 2 * particles.len() + structure.inner;
    let stiffness = definite(&structure.stiffness, n);
    let mass = definite(&structure.mass, n);
    let friction = rational(structure.quarters_of_friction, 4);
    let system = System::new(stiffness, Some(mass), Some(friction), particles).unwrap();
    judged(everywhere(Body::System(system), unknown(structure.is_mu)))
}

#[test]
fn systems_of_any_structure_agree_with_the_enumerator() {
    let coverage = sum_over(&structures(), (CASES, 1), judge_structure);
    assert_reaches_floor("property: systems", Starts::Search, &coverage);
}

fn count_of_nonzero_entries(matrix: &[Vec<i64>]) -> usize {
    matrix.iter().flatten().filter(|entry| **entry != 0).count()
}

/// Structures shrink: from any system with a solution to few entries, no inner degree of freedom
/// and no frame.
#[test]
fn a_failing_system_shrinks_to_few_entries() {
    let small = smallest_with_a_solution(&structures(), 3, judge_structure);

    let in_stiffness = count_of_nonzero_entries(&small.stiffness);
    let in_mass = count_of_nonzero_entries(&small.mass);
    assert!(
        small.particles.iter().all(|p| p.frame.is_none()),
        "{small:?}"
    );
    assert_eq!(small.inner, 0, "{small:?}");
    assert!(in_stiffness + in_mass <= 4, "{small:?}");
}

/// A pencil A + tB with free variables first, as a structure: A = GG' + I and rows of K1 for slip
/// variables, or B = HH' + I.
#[derive(Debug, Clone)]
struct Rows {
    free: usize,
    slip: usize,
    definite: Vec<Vec<i64>>,
    mass: Vec<Vec<i64>>,
    friction: Vec<Vec<i64>>,
    is_mu: bool,
}

fn pencils() -> impl Strategy<Value = Rows> {
    let free = prop_oneof![2 => Just(0usize), 1 => Just(1), 1 => Just(2)];
    let shape = (free, 1usize..=4, any::<bool>());
    (shape, matrices(2), matrices(2), matrices(6)).prop_map(
        |((free, slip, is_mu), definite, mass, friction)| Rows {
            free,
            slip,
            definite,
            mass,
            friction,
            is_mu,
        },
    )
}

/// MCEIP-mu: A = K0, B = K1. MCEIP-lambda2: A = K0 + 2 K1, B = M. The rows of the free variables of
/// K1 vanish.
fn judge_pencil(rows: Rows) -> Result<Coverage, String> {
    let n = rows.free + rows.slip;
    let k0 = definite(&rows.definite, n);
    let mut friction = leading(&rows.friction, n);
    for free_row in &mut friction[..rows.free] {
        free_row.fill(0);
    }
    let k1 = sparse(&friction);

    let (a, b) = if rows.is_mu {
        (k0, k1)
    } else {
        (k0.add_scaled(&whole(2), &k1), definite(&rows.mass, n))
    };
    let pencil = Pencil::new(a, b, (0..rows.free).collect()).unwrap();
    judged(everywhere(Body::Pencil(pencil), unknown(rows.is_mu)))
}

#[test]
fn pencils_of_any_structure_agree_with_the_enumerator() {
    let coverage = sum_over(&pencils(), (CASES, 1), judge_pencil);
    assert_reaches_floor("property: pencils", Starts::Search, &coverage);
}

/// From a pencil with a solution, shrinking leads to one slip variable and at most one entry of K1.
#[test]
fn a_failing_pencil_shrinks_to_one_variable() {
    let small = smallest_with_a_solution(&pencils(), 3, judge_pencil);

    assert!(small.slip + small.free < 3, "{small:?}");
    assert!(count_of_nonzero_entries(&small.friction) <= 1, "{small:?}");
}

/// Two particles of any angle, stiffness, mass, friction and signs.
fn two_particle_data() -> impl Strategy<Value = TwoParticles> {
    let quarters = prop::array::uniform3(1i64..=120);
    let sign = || prop::sample::select(&[-1, 1]);
    (1i64..=12, 0i64..=12, quarters, (sign(), sign())).prop_map(|(p, q, quarters, signs)| {
        let (c, s) = on_the_circle(p, q % (p + 1));
        let [k, m, mu] = quarters.map(|count| rational(count, 4));
        TwoParticles {
            c,
            s,
            k,
            m,
            mu,
            signs,
        }
    })
}

fn is_in_table(claim: &AcceptedClaim, truth: &[ClosedSolution]) -> bool {
    let lo = claim.value.lo();
    let hi = claim.value.hi();

    let mut same_support = truth.iter().filter(|t| t.slip == claim.support);
    same_support.any(|solution| solution.value.within(lo, hi))
}

/// What the checker accepts of what is certified.
fn accepted_claims(
    problem: &Problem,
    certified: Vec<CertifiedCandidate>,
) -> Result<Vec<AcceptedClaim>, String> {
    if certified.is_empty() {
        return Ok(Vec::new());
    }
    let claims = certified.into_iter().map(|c| c.claim).collect();
    let certificate = Certificate::of_claims(problem, claims);

    match check(problem, &certificate) {
        Ok(accepted) => Ok(accepted.claims),
        Err(rejection) => Err(rejection.to_string()),
    }
}

/// What is certified from interior starts is in the closed form: same support, and its number in
/// the accepted interval.
fn judge_table(data: TwoParticles) -> Result<Coverage, String> {
    let body = Body::System(two_particles(&data).unwrap());
    let problem = everywhere(body, Unknown::Lambda2);
    let reduced = reduce(&problem).unwrap();
    if Admissible::new(&reduced.pencil, Unknown::Lambda2).is_err() {
        return Ok(Coverage::default());
    }
    let truth = table1(&data);

    let search = Search {
        starts: 22,
        ..Search::default()
    };
    let found = from_interior(&problem, &reduced, &search, &Watch::nobody());
    let found = found.map_err(|e| e.to_string())?;
    let certified = found.certified.len();
    if certified > truth.len() {
        let known = truth.len();
        return Err(format!("{certified} certified, Table 1 has {known}"));
    }
    let first_is_certified = found.certified.iter().any(|c| c.run == 0);

    let accepted = accepted_claims(&problem, found.certified)?;
    if let Some(claim) = accepted.iter().find(|claim| !is_in_table(claim, &truth)) {
        return Err(format!("{claim:?} is not in Table 1"));
    }

    let mut coverage = Coverage::default();
    if !truth.is_empty() {
        coverage.count(first_is_certified, accepted.len() == truth.len());
    }
    Ok(coverage)
}

#[test]
fn two_particles_of_any_data_agree_with_the_closed_form() {
    let coverage = sum_over(&two_particle_data(), (CASES, 1), judge_table);
    assert_reaches_floor("property: two particles", Starts::Interior, &coverage);
}

/// `cargo test --release --test solver -- --ignored --nocapture solver_properties::`: how many of
/// the solvable problems the first start and the whole search solve, for the table of floors.
#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_properties() {
    let mut sums = [("systems", Coverage::default()); 3];
    sums[1].0 = "pencils";
    sums[2].0 = "two particles";
    for run in [(1000, 91), (1000, 92)] {
        sums[0]
            .1
            .add(&sum_over(&structures(), run, judge_structure));
        sums[1].1.add(&sum_over(&pencils(), run, judge_pencil));
        sums[2]
            .1
            .add(&sum_over(&two_particle_data(), run, judge_table));
    }

    for (family, sum) in sums {
        let percent = |count: u64| 100.0 * count as f64 / sum.solvable as f64;
        let [first, all] = [sum.first, sum.all].map(percent);
        println!(
            "    property: {family}: first {first:.2}, all {all:.2} of {}",
            sum.solvable
        );
    }
}

/// G = [[1, 2], [0, 1]]: GG' + I = [[6, 2], [2, 2]].
#[test]
fn a_factor_gives_a_definite_matrix() {
    let expected = Sparse::from_ints(&[&[6, 2], &[2, 2]]);
    assert_eq!(definite(&[vec![1, 2], vec![0, 1]], 2), expected);
}
