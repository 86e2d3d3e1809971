//! The solver on structured random values, which proptest and quickcheck shrink when they fail.
//!
//! The values are pencils, sign patterns, contact states, frames and index sets. The truth is the
//! exact enumerator, and the closed form of Table 1 for two particles. Everything certified must be
//! in that answer (soundness), and over all cases the solver must find as much as its floor asks
//! for (coverage, `crates/testkit/src/floors.rs`). Two tests check that failures shrink.
#![cfg(feature = "testkit")]

use mceip_check::{AcceptedClaim, check};
use mceip_engine::certify::certificate;
use mceip_engine::multistart::{Certified, Search};
use mceip_engine::run::Watch;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{
    Admissible, Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window,
};
use mceip_oracle::{ClosedSolution, TwoParticles, table1};
use mceip_paper::two_particles;
use mceip_testkit::floors::{Coverage, Starts, shortfalls};
use mceip_testkit::{Instance, Treatment, coverage_of, from_interior};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use quickcheck::{Arbitrary, Gen, QuickCheck};
use std::cell::RefCell;
use std::sync::{Mutex, PoisonError};

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

/// GG' + I over the leading `n` rows and columns of G.
fn definite(factor: &[Vec<i8>], n: usize) -> Sparse {
    let mut entries = Vec::new();

    for i in 0..n {
        for j in 0..n {
            let mut sum = i64::from(i == j);
            for k in 0..n {
                sum += i64::from(factor[i][k]) * i64::from(factor[j][k]);
            }
            entries.push((i, j, whole(sum)));
        }
    }
    Sparse::from_entries(n, n, entries)
}

/// The matrix [[c, s], [-s, c]] of a rational angle: c = (p^2 - q^2) / h and s = 2 p q / h, where
/// h = p^2 + q^2.
struct Rotation {
    c: Rational,
    s: Rational,
}

impl Rotation {
    fn of(p: i64, q: i64) -> Rotation {
        let h = p * p + q * q;
        Rotation {
            c: rational(p * p - q * q, h),
            s: rational(2 * p * q, h),
        }
    }
}

/// What the enumerator and the solver say of a problem; an error names what is unsound.
fn judged(problem: Problem) -> Result<Option<Coverage>, String> {
    let instance = Instance {
        label: "property".into(),
        problem,
        closed_form: None,
        corners: Vec::new(),
    };
    let treatment = Treatment::of(&search());
    let report = coverage_of(&instance, &treatment).map_err(|error| error.to_string())?;

    if let Some(unsound) = report.disagreements.first() {
        return Err(unsound.to_string());
    }
    Ok(report.coverage().first().map(|named| named.1))
}

/// One particle as a structure.
#[derive(Debug, Clone)]
struct Contact {
    state: ContactState,
    upwards: bool,
    /// p and q of a rational frame, as [`Rotation`] has it.
    frame: Option<(i8, i8)>,
}

/// A mechanical system as a structure.
#[derive(Debug, Clone)]
struct Structure {
    contacts: Vec<Contact>,
    inner: usize,
    stiffness: Vec<Vec<i8>>,
    mass: Vec<Vec<i8>>,
    quarters_of_friction: i64,
    is_mu: bool,
}

impl Structure {
    /// The problem; one more particle, in impending slip, stands first, so that there is always
    /// one.
    fn problem(&self) -> Problem {
        let first = Contact {
            state: ContactState::Slip { sign: 1 },
            upwards: true,
            frame: None,
        };
        let mut particles = vec![first.particle(0)];
        for (k, contact) in self.contacts.iter().enumerate() {
            particles.push(contact.particle(k + 1));
        }
        let n = 2 * particles.len() + self.inner;

        let stiffness = definite(&self.stiffness, n);
        let mass = definite(&self.mass, n);
        let friction = rational(self.quarters_of_friction, 4);
        let system = System::new(stiffness, Some(mass), Some(friction), particles).unwrap();

        let unknown = if self.is_mu {
            Unknown::Mu
        } else {
            Unknown::Lambda2
        };
        Problem::new(Body::System(system), unknown, Window::all()).unwrap()
    }
}

impl Contact {
    fn particle(&self, index: usize) -> Particle {
        let mut particle = Particle::plain(2 * index, 2 * index + 1, self.state);
        particle.normal_direction = if self.upwards { 1 } else { -1 };
        particle.frame = self.frame.map(|(p, q)| {
            let Rotation { c, s } = Rotation::of(p.into(), q.into());
            [[c.clone(), s.clone()], [-s, c]]
        });
        particle
    }
}

/// A factor of small integers; zeros are what it shrinks to.
fn factors() -> impl Strategy<Value = Vec<Vec<i8>>> {
    let row = prop::collection::vec(-2i8..=2, MOST);
    prop::collection::vec(row, MOST)
}

fn contacts() -> impl Strategy<Value = Contact> {
    let state = prop_oneof![
        3 => Just(ContactState::Slip { sign: 1 }),
        3 => Just(ContactState::Slip { sign: -1 }),
        1 => Just(ContactState::Stick),
        1 => Just(ContactState::Free),
    ];
    let frame = prop::option::weighted(0.3, (1i8..=5, -4i8..=4));
    (state, any::<bool>(), frame).prop_map(|(state, upwards, frame)| Contact {
        state,
        upwards,
        frame,
    })
}

/// Systems of one to two particles more than the first, with up to one inner degree of freedom:
/// order at most 6.
fn structures() -> impl Strategy<Value = Structure> {
    let shape = (prop::collection::vec(contacts(), 0..=1), 0usize..=2);
    (shape, factors(), factors(), 1i64..=80, any::<bool>()).prop_map(
        |((contacts, inner), stiffness, mass, friction, is_mu)| Structure {
            contacts,
            inner,
            stiffness,
            mass,
            quarters_of_friction: friction,
            is_mu,
        },
    )
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

/// Runs the property over `cases` structures and sums what was found.
fn systems_judged(cases: u32, seed: u8) -> Result<Coverage, TestError<Structure>> {
    let sum = RefCell::new(Coverage::default());

    runner(cases, seed).run(&structures(), |structure| {
        let coverage = judged(structure.problem()).map_err(TestCaseError::fail)?;
        if let Some(coverage) = coverage {
            sum.borrow_mut().add(&coverage);
        }
        Ok(())
    })?;
    Ok(sum.into_inner())
}

/// Fails unless enough problems have solutions and the solver finds as much as the floor asks for.
fn assert_reaches_floor(family: &str, starts: Starts, coverage: &Coverage) {
    println!("{coverage:?}");
    assert!(coverage.solvable >= 30, "{coverage:?}");
    assert_eq!(shortfalls(family, starts, coverage), []);
}

#[test]
fn systems_of_any_structure_agree_with_the_enumerator() {
    let coverage = systems_judged(CASES, 1).unwrap_or_else(|error| panic!("{error}"));
    assert_reaches_floor("property: systems", Starts::Search, &coverage);
}

fn count_of_nonzero_entries(matrix: &[Vec<i8>]) -> usize {
    let mut count = 0;
    for entry in matrix.iter().flatten() {
        count += usize::from(*entry != 0);
    }
    count
}

/// Structures shrink: from any system with a solution to few entries, no inner degree of freedom
/// and no frame.
#[test]
fn a_failing_system_shrinks_to_few_entries() {
    // To have a solution is what fails here.
    let outcome = runner(200, 3).run(&structures(), |structure| {
        match judged(structure.problem()) {
            Ok(None) => Ok(()),
            other => Err(TestCaseError::fail(format!("{other:?}"))),
        }
    });
    let Err(TestError::Fail(_, small)) = outcome else {
        panic!("no system has a solution")
    };

    let in_stiffness = count_of_nonzero_entries(&small.stiffness);
    let in_mass = count_of_nonzero_entries(&small.mass);
    let has_no_frame = small.contacts.iter().all(|c| c.frame.is_none());
    assert!(has_no_frame, "{small:?}");
    assert_eq!(small.inner, 0, "{small:?}");
    assert!(in_stiffness + in_mass <= 4, "{small:?}");
}

/// A pencil A + tB with free variables first, as a structure: A = GG' + I and rows of K1 for slip
/// variables, or B = HH' + I.
#[derive(Debug, Clone)]
struct Rows {
    free: usize,
    slip: usize,
    definite: Vec<Vec<i8>>,
    mass: Vec<Vec<i8>>,
    friction: Vec<Vec<i8>>,
    is_mu: bool,
}

impl Rows {
    /// MCEIP-mu: A = K0, B = K1. MCEIP-lambda2: A = K0 + 2 K1, B = M. The rows of the free
    /// variables of K1 vanish.
    fn problem(&self) -> Problem {
        let n = self.free + self.slip;
        let free = (0..self.free).collect();
        let k0 = definite(&self.definite, n);
        let k1 = self.friction_matrix();

        if self.is_mu {
            let pencil = Pencil::new(k0, k1, free).unwrap();
            return Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all()).unwrap();
        }
        let a = k0.add_scaled(&whole(2), &k1);
        let mass = definite(&self.mass, n);
        let pencil = Pencil::new(a, mass, free).unwrap();
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
    }

    /// K1, of which the rows of the free variables vanish.
    fn friction_matrix(&self) -> Sparse {
        let n = self.free + self.slip;
        let mut entries = Vec::new();
        for i in self.free..n {
            for j in 0..n {
                let value = i64::from(self.friction[i][j]);
                entries.push((i, j, whole(value)));
            }
        }
        Sparse::from_entries(n, n, entries)
    }

    /// The same with one row and column less, of a free or of a slip variable.
    fn smaller(&self) -> Vec<Rows> {
        let mut smaller = Vec::new();
        if self.free > 0 {
            smaller.push(Rows {
                free: self.free - 1,
                ..self.clone()
            });
        }
        if self.slip > 1 {
            smaller.push(Rows {
                slip: self.slip - 1,
                ..self.clone()
            });
        }
        smaller
    }
}

/// Entries from -`largest` to `largest`.
fn random_matrix(g: &mut Gen, largest: i8) -> Vec<Vec<i8>> {
    let values: Vec<i8> = (-largest..=largest).collect();
    let mut matrix = vec![vec![0; MOST]; MOST];
    for row in &mut matrix {
        for entry in row {
            *entry = *g.choose(&values).unwrap();
        }
    }
    matrix
}

/// The matrices with one nonzero entry set to zero.
fn with_an_entry_less(matrix: &[Vec<i8>]) -> Vec<Vec<Vec<i8>>> {
    let mut smaller = Vec::new();
    for i in 0..matrix.len() {
        for j in 0..matrix[i].len() {
            if matrix[i][j] != 0 {
                let mut copy = matrix.to_vec();
                copy[i][j] = 0;
                smaller.push(copy);
            }
        }
    }
    smaller
}

impl Arbitrary for Rows {
    fn arbitrary(g: &mut Gen) -> Rows {
        let free = *g.choose(&[0, 0, 1, 2]).unwrap();
        let slip = *g.choose(&[1, 2, 3, 4]).unwrap();
        Rows {
            free,
            slip,
            definite: random_matrix(g, 2),
            mass: random_matrix(g, 2),
            friction: random_matrix(g, 6),
            is_mu: bool::arbitrary(g),
        }
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Rows>> {
        let mut smaller = self.smaller();
        for friction in with_an_entry_less(&self.friction) {
            smaller.push(Rows {
                friction,
                ..self.clone()
            });
        }
        for definite in with_an_entry_less(&self.definite) {
            smaller.push(Rows {
                definite,
                ..self.clone()
            });
        }
        for mass in with_an_entry_less(&self.mass) {
            smaller.push(Rows {
                mass,
                ..self.clone()
            });
        }
        Box::new(smaller.into_iter())
    }
}

const NOTHING: Coverage = Coverage {
    solvable: 0,
    first: 0,
    all: 0,
};

/// Counts of a quickcheck property, whose function takes nothing but the value.
static PENCILS: Mutex<Coverage> = Mutex::new(NOTHING);

/// The same for Table 1 by interior starts.
static TABLE: Mutex<Coverage> = Mutex::new(NOTHING);

fn add_coverage(sum: &Mutex<Coverage>, coverage: &Coverage) {
    let mut sum = sum.lock().unwrap_or_else(PoisonError::into_inner);
    sum.add(coverage);
}

fn coverage_in(sum: &Mutex<Coverage>) -> Coverage {
    *sum.lock().unwrap_or_else(PoisonError::into_inner)
}

fn pencil_is_sound(rows: Rows) -> Result<bool, String> {
    if let Some(coverage) = judged(rows.problem())? {
        add_coverage(&PENCILS, &coverage);
    }
    Ok(true)
}

fn judge_pencils(cases: u64, seed: u64) {
    QuickCheck::new()
        .rng(Gen::from_size_and_seed(MOST, seed))
        .tests(cases)
        .quickcheck(pencil_is_sound as fn(Rows) -> Result<bool, String>);
}

#[test]
fn pencils_of_any_structure_agree_with_the_enumerator() {
    judge_pencils(CASES.into(), 1);
    let coverage = coverage_in(&PENCILS);
    assert_reaches_floor("property: pencils", Starts::Search, &coverage);
}

/// From a pencil with a solution, shrinking leads to one slip variable and at most one entry of K1.
#[test]
fn a_failing_pencil_shrinks_to_one_variable() {
    let has_solution = |rows: &Rows| judged(rows.problem()).unwrap().is_some();
    let mut g = Gen::from_size_and_seed(MOST, 9);
    let mut drawn = (0..200).map(|_| Rows::arbitrary(&mut g));
    let large = drawn.find(|rows| rows.slip >= 3 && has_solution(rows));

    let mut small = large.unwrap();
    while let Some(next) = small.smaller().into_iter().find(has_solution) {
        small = next;
    }

    assert!(small.slip + small.free < 3, "{small:?}");
    assert!(small.shrink().count() > 0);
}

/// Two particles as a structure: p and q of the angle, numerators over 4 of k, m and mu, signs.
#[derive(Debug, Clone)]
struct Two {
    p: u8,
    q: u8,
    quarters: [u16; 3],
    signs: (bool, bool),
}

impl Two {
    fn data(&self) -> TwoParticles {
        let Rotation { c, s } = Rotation::of(self.p.into(), self.q.into());
        let [k, m, mu] = self.quarters.map(|count| rational(count.into(), 4));
        let sign = |positive: bool| if positive { 1 } else { -1 };
        TwoParticles {
            c,
            s,
            k,
            m,
            mu,
            signs: (sign(self.signs.0), sign(self.signs.1)),
        }
    }
}

impl Arbitrary for Two {
    fn arbitrary(g: &mut Gen) -> Two {
        let angle: Vec<u8> = (1..=12).collect();
        let p = *g.choose(&angle).unwrap();
        let q = u8::arbitrary(g) % (p + 1);
        let quarters = [0; 3].map(|_| u16::arbitrary(g) % 120 + 1);
        Two {
            p,
            q,
            quarters,
            signs: Arbitrary::arbitrary(g),
        }
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Two>> {
        let mut simpler = Vec::new();
        if (self.p, self.q) != (2, 1) {
            simpler.push(Two {
                p: 2,
                q: 1,
                ..self.clone()
            });
        }
        for k in 0..3 {
            for count in self.quarters[k].shrink().filter(|count| *count > 0) {
                let mut quarters = self.quarters;
                quarters[k] = count;
                simpler.push(Two {
                    quarters,
                    ..self.clone()
                });
            }
        }
        Box::new(simpler.into_iter())
    }
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
    certified: Vec<Certified>,
) -> Result<Vec<AcceptedClaim>, String> {
    if certified.is_empty() {
        return Ok(Vec::new());
    }
    let claims = certified.into_iter().map(|c| c.claim).collect();
    let certificate = certificate(problem, claims);

    match check(problem, &certificate) {
        Ok(accepted) => Ok(accepted.claims),
        Err(rejection) => Err(rejection.to_string()),
    }
}

/// What is certified from interior starts is in the closed form: same support, and its number in
/// the accepted interval.
fn table_is_sound(two: Two) -> Result<bool, String> {
    let data = two.data();
    let body = Body::System(two_particles(&data).unwrap());
    let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();
    let reduced = reduce(&problem).unwrap();
    if Admissible::new(&reduced.pencil, Unknown::Lambda2).is_err() {
        return Ok(true);
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
    for claim in &accepted {
        if !is_in_table(claim, &truth) {
            return Err(format!("{claim:?} is not in Table 1"));
        }
    }

    if !truth.is_empty() {
        let mut coverage = Coverage::default();
        coverage.count(first_is_certified, accepted.len() == truth.len());
        add_coverage(&TABLE, &coverage);
    }
    Ok(true)
}

fn judge_table(cases: u64, seed: u64) {
    QuickCheck::new()
        .rng(Gen::from_size_and_seed(100, seed))
        .tests(cases)
        .quickcheck(table_is_sound as fn(Two) -> Result<bool, String>);
}

#[test]
fn two_particles_of_any_data_agree_with_the_closed_form() {
    judge_table(CASES.into(), 1);
    let coverage = coverage_in(&TABLE);
    assert_reaches_floor("property: two particles", Starts::Interior, &coverage);
}

/// Prints how many of the solvable problems the first start and the whole search solve.
fn print_rates(family: &str, coverage: &Coverage) {
    let solvable = coverage.solvable;
    let percent = |count: u64| 100.0 * count as f64 / solvable as f64;
    println!(
        "    property: {family}: first {:.2}, all {:.2} of {solvable}",
        percent(coverage.first),
        percent(coverage.all),
    );
}

/// `cargo test --release --test solver -- --ignored --nocapture solver_properties::`: the rates of
/// the table of floors.
#[test]
#[ignore = "a measurement: run on request, in release"]
fn measure_the_properties() {
    let mut systems = Coverage::default();
    for seed in [91, 92] {
        systems.add(&systems_judged(1000, seed).unwrap());
        judge_pencils(1000, u64::from(seed));
        judge_table(1000, u64::from(seed));
    }

    print_rates("systems", &systems);
    print_rates("pencils", &coverage_in(&PENCILS));
    print_rates("two particles", &coverage_in(&TABLE));
}

/// G = [[1, 2], [0, 1]]: GG' + I = [[6, 2], [2, 2]].
#[test]
fn a_factor_gives_a_definite_matrix() {
    let matrix = definite(&[vec![1, 2], vec![0, 1]], 2);

    assert_eq!(matrix.get(0, 0), whole(6));
    assert_eq!(matrix.get(0, 1), whole(2));
    assert_eq!(matrix.get(1, 0), whole(2));
    assert_eq!(matrix.get(1, 1), whole(2));
}
