//! The solver against both oracles on structured values, which proptest and quickcheck shrink:
//! pencils, sign patterns, contact states, frames, index sets. Everything certified is in the
//! oracle's answer (soundness), and over all cases the solver finds as much as its floor asks for
//! (coverage, `crates/testkit/src/floors.rs`).
#![cfg(feature = "testkit")]

use mceip_check::check;
use mceip_engine::certify::certificate;
use mceip_engine::multistart::Search;
use mceip_engine::reduction::reduce;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{
    Admissible, Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window,
};
use mceip_oracle::{TwoParticles, table1};
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
            let product: i64 = (0..n)
                .map(|k| i64::from(factor[i][k]) * i64::from(factor[j][k]))
                .sum();
            entries.push((i, j, whole(product + i64::from(i == j))));
        }
    }
    Sparse::from_entries(n, n, entries)
}

/// What the enumerator and the solver say of a problem; an error names what is unsound.
fn judged(problem: Problem) -> Result<Option<Coverage>, String> {
    let instance = Instance {
        label: "property".into(),
        problem,
        closed_form: None,
        corners: Vec::new(),
    };
    let report = coverage_of(&instance, &Treatment::of(&search())).map_err(|e| e.to_string())?;
    match report.disagreements.first() {
        Some(unsound) => Err(unsound.to_string()),
        None => Ok(report.coverage().first().map(|c| c.1)),
    }
}

/// One particle as a structure.
#[derive(Debug, Clone)]
struct Contact {
    state: ContactState,
    upwards: bool,
    /// p and q of the rational frame ((p^2 - q^2) / (p^2 + q^2), 2pq / (p^2 + q^2)).
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
        let all = [first].into_iter().chain(self.contacts.iter().cloned());
        let particles: Vec<Particle> = all.enumerate().map(|(k, c)| c.particle(k)).collect();
        let n = 2 * particles.len() + self.inner;

        let (stiffness, mass) = (definite(&self.stiffness, n), definite(&self.mass, n));
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
            let (p, q) = (i64::from(p), i64::from(q));
            let h = p * p + q * q;
            let (c, s) = (rational(p * p - q * q, h), rational(2 * p * q, h));
            [[c.clone(), s.clone()], [-s, c]]
        });
        particle
    }
}

/// A factor of small integers; zeros are what it shrinks to.
fn factors() -> impl Strategy<Value = Vec<Vec<i8>>> {
    prop::collection::vec(prop::collection::vec(-2i8..=2, MOST), MOST)
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

/// Runs a property over `cases` structures; the seed is the same on every machine unless one is
/// given.
fn systems_judged(cases: u32, seed: u8) -> Result<Coverage, TestError<Structure>> {
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(
        config,
        TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]),
    );
    let sum = RefCell::new(Coverage::default());
    runner.run(&structures(), |structure| {
        let coverage = judged(structure.problem()).map_err(TestCaseError::fail)?;
        coverage.iter().for_each(|c| sum.borrow_mut().add(c));
        Ok(())
    })?;
    Ok(sum.into_inner())
}

#[test]
fn systems_of_any_structure_agree_with_the_enumerator() {
    let coverage = systems_judged(CASES, 1).unwrap_or_else(|e| panic!("{e}"));
    println!("{coverage:?}");
    assert!(coverage.solvable >= 30, "{coverage:?}");
    assert_eq!(
        shortfalls("property: systems", Starts::Search, &coverage),
        []
    );
}

/// Structures shrink: from any system with a solution to few entries, no inner degree of freedom
/// and no frame.
#[test]
fn a_failing_system_shrinks_to_few_entries() {
    let config = Config {
        cases: 200,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner =
        TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[3; 32]));
    let outcome = runner.run(&structures(), |structure| {
        match judged(structure.problem()) {
            Ok(None) => Ok(()),
            other => Err(TestCaseError::fail(format!("{other:?}"))),
        }
    });

    let Err(TestError::Fail(_, small)) = outcome else {
        panic!("no system has a solution")
    };
    let entries = small
        .stiffness
        .iter()
        .chain(&small.mass)
        .flatten()
        .filter(|v| **v != 0)
        .count();
    assert!(
        small.contacts.iter().all(|c| c.frame.is_none()) && small.inner == 0 && entries <= 4,
        "{small:?}"
    );
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
        let mut entries = Vec::new();
        for i in self.free..n {
            for j in 0..n {
                entries.push((i, j, whole(i64::from(self.friction[i][j]))));
            }
        }
        let k0 = definite(&self.definite, n);
        let k1 = Sparse::from_entries(n, n, entries);

        let (a, b, unknown) = if self.is_mu {
            (k0, k1, Unknown::Mu)
        } else {
            (
                k0.add_scaled(&whole(2), &k1),
                definite(&self.mass, n),
                Unknown::Lambda2,
            )
        };
        let pencil = Pencil::new(a, b, (0..self.free).collect()).unwrap();
        Problem::new(Body::Pencil(pencil), unknown, Window::all()).unwrap()
    }

    /// The same with one row and column less, of a free or of a slip variable.
    fn smaller(&self) -> Vec<Rows> {
        let mut out = Vec::new();
        if self.free > 0 {
            out.push(Rows {
                free: self.free - 1,
                ..self.clone()
            });
        }
        if self.slip > 1 {
            out.push(Rows {
                slip: self.slip - 1,
                ..self.clone()
            });
        }
        out
    }
}

/// Entries from -`top` to `top`.
fn matrix(g: &mut Gen, top: i8) -> Vec<Vec<i8>> {
    let entries: Vec<i8> = (-top..=top).collect();
    (0..MOST)
        .map(|_| (0..MOST).map(|_| *g.choose(&entries).unwrap()).collect())
        .collect()
}

/// The matrices with one nonzero entry set to zero.
fn zeroed(m: &[Vec<i8>]) -> Vec<Vec<Vec<i8>>> {
    let mut out = Vec::new();
    for i in 0..m.len() {
        for j in 0..m[i].len() {
            if m[i][j] != 0 {
                let mut copy = m.to_vec();
                copy[i][j] = 0;
                out.push(copy);
            }
        }
    }
    out
}

impl Arbitrary for Rows {
    fn arbitrary(g: &mut Gen) -> Rows {
        let free = *g.choose(&[0, 0, 1, 2]).unwrap();
        let slip = *g.choose(&[1, 2, 3, 4]).unwrap();
        Rows {
            free,
            slip,
            definite: matrix(g, 2),
            mass: matrix(g, 2),
            friction: matrix(g, 6),
            is_mu: bool::arbitrary(g),
        }
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Rows>> {
        let mut out = self.smaller();
        out.extend(zeroed(&self.friction).into_iter().map(|friction| Rows {
            friction,
            ..self.clone()
        }));
        out.extend(zeroed(&self.definite).into_iter().map(|definite| Rows {
            definite,
            ..self.clone()
        }));
        out.extend(zeroed(&self.mass).into_iter().map(|mass| Rows {
            mass,
            ..self.clone()
        }));
        Box::new(out.into_iter())
    }
}

/// Counts of a quickcheck property, whose function takes nothing but the value.
static PENCILS: Mutex<Coverage> = Mutex::new(Coverage {
    solvable: 0,
    first: 0,
    all: 0,
});
/// The same for Table 1 by interior starts.
static TABLE: Mutex<Coverage> = Mutex::new(Coverage {
    solvable: 0,
    first: 0,
    all: 0,
});

fn added(to: &Mutex<Coverage>, coverage: &Coverage) {
    to.lock()
        .unwrap_or_else(PoisonError::into_inner)
        .add(coverage);
}

fn taken(from: &Mutex<Coverage>) -> Coverage {
    *from.lock().unwrap_or_else(PoisonError::into_inner)
}

fn pencil_is_sound(rows: Rows) -> Result<bool, String> {
    let coverage = judged(rows.problem())?;
    coverage.iter().for_each(|c| added(&PENCILS, c));
    Ok(true)
}

fn pencils_judged(cases: u64, seed: u64) {
    QuickCheck::new()
        .rng(Gen::from_size_and_seed(MOST, seed))
        .tests(cases)
        .quickcheck(pencil_is_sound as fn(Rows) -> Result<bool, String>);
}

#[test]
fn pencils_of_any_structure_agree_with_the_enumerator() {
    pencils_judged(CASES.into(), 1);
    let coverage = taken(&PENCILS);
    println!("{coverage:?}");
    assert!(coverage.solvable >= 30, "{coverage:?}");
    assert_eq!(
        shortfalls("property: pencils", Starts::Search, &coverage),
        []
    );
}

/// From a pencil with a solution, shrinking leads to one slip variable and at most one entry of K1.
#[test]
fn a_failing_pencil_shrinks_to_one_variable() {
    let has_solution = |rows: &Rows| judged(rows.problem()).unwrap().is_some();
    let mut g = Gen::from_size_and_seed(MOST, 9);
    let mut small = (0..200)
        .map(|_| Rows::arbitrary(&mut g))
        .find(|r| r.slip >= 3 && has_solution(r))
        .unwrap();
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
        let (p, q) = (i64::from(self.p), i64::from(self.q));
        let h = p * p + q * q;
        let quarter = |k: usize| rational(i64::from(self.quarters[k]), 4);
        let sign = |positive: bool| if positive { 1 } else { -1 };
        TwoParticles {
            c: rational(p * p - q * q, h),
            s: rational(2 * p * q, h),
            k: quarter(0),
            m: quarter(1),
            mu: quarter(2),
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
        let mut out = Vec::new();
        if (self.p, self.q) != (2, 1) {
            out.push(Two {
                p: 2,
                q: 1,
                ..self.clone()
            });
        }
        for k in 0..3 {
            for smaller in self.quarters[k].shrink().filter(|v| *v > 0) {
                let mut quarters = self.quarters;
                quarters[k] = smaller;
                out.push(Two {
                    quarters,
                    ..self.clone()
                });
            }
        }
        Box::new(out.into_iter())
    }
}

/// What is certified from interior starts is in the closed form: same support, and its number in
/// the accepted interval.
fn table_is_sound(two: Two) -> Result<bool, String> {
    let data = two.data();
    let problem = Problem::new(
        Body::System(two_particles(&data).unwrap()),
        Unknown::Lambda2,
        Window::all(),
    )
    .unwrap();
    let pencil = reduce(&problem).unwrap().pencil;
    let Ok(admissible) = Admissible::new(&pencil, Unknown::Lambda2) else {
        return Ok(true);
    };

    let search = Search {
        starts: 22,
        ..Search::default()
    };
    let found = from_interior(&problem, &admissible, &search).map_err(|e| e.to_string())?;
    let truth = table1(&data);
    let first = found.certified.iter().any(|c| c.run == 0);
    if found.certified.len() > truth.len() {
        return Err(format!(
            "{} certified, Table 1 has {}",
            found.certified.len(),
            truth.len()
        ));
    }

    let mut hit = 0;
    if !found.certified.is_empty() {
        let claims = found.certified.into_iter().map(|c| c.claim).collect();
        let accepted = check(&problem, &certificate(&problem, claims))
            .map_err(|e| e.to_string())?
            .claims;
        for claim in &accepted {
            let in_table = truth.iter().any(|t| {
                t.slip == claim.support && t.value.within(claim.value.lo(), claim.value.hi())
            });
            if !in_table {
                return Err(format!("{claim:?} is not in Table 1"));
            }
            hit += 1;
        }
    }

    if !truth.is_empty() {
        let mut one = Coverage::default();
        one.count(first, hit == truth.len());
        added(&TABLE, &one);
    }
    Ok(true)
}

fn table_judged(cases: u64, seed: u64) {
    QuickCheck::new()
        .rng(Gen::from_size_and_seed(100, seed))
        .tests(cases)
        .quickcheck(table_is_sound as fn(Two) -> Result<bool, String>);
}

#[test]
fn two_particles_of_any_data_agree_with_the_closed_form() {
    table_judged(CASES.into(), 1);
    let coverage = taken(&TABLE);
    println!("{coverage:?}");
    assert!(coverage.solvable >= 30, "{coverage:?}");
    assert_eq!(
        shortfalls("property: two particles", Starts::Interior, &coverage),
        []
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
        pencils_judged(1000, u64::from(seed));
        table_judged(1000, u64::from(seed));
    }
    for (family, c) in [
        ("systems", systems),
        ("pencils", taken(&PENCILS)),
        ("two particles", taken(&TABLE)),
    ] {
        let percent = |count: u64| 100.0 * count as f64 / c.solvable as f64;
        println!(
            "    property: {family}: first {:.2}, all {:.2} of {}",
            percent(c.first),
            percent(c.all),
            c.solvable
        );
    }
}

/// The factors' use of rationals is what the names say.
#[test]
fn a_factor_gives_a_definite_matrix() {
    let m = definite(&[vec![1, 2], vec![0, 1]], 2);
    let expected: [[Rational; 2]; 2] = [[whole(6), whole(2)], [whole(2), whole(2)]];
    for i in 0..2 {
        for j in 0..2 {
            assert_eq!(m.get(i, j), expected[i][j]);
        }
    }
}
