//! The solver and the certificates on both sides of a threshold, and beside a fold.
//!
//! Just below a threshold a solver's residual is tiny and no solution exists: everything it "finds"
//! must be refused with a proof of absence. Just above, everything must be certified. The truth is
//! Table 1 in exact numbers, for all sign patterns that have thresholds, with relative gaps from
//! 1e-3 to 1e-15; peers' solvers report success on both sides. Of the search itself no uncertified
//! point may stand among its solutions.
#![cfg(feature = "testkit")]

use mceip_check::certificate::Certificate;
use mceip_check::{AcceptedClaim, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::propose;
use mceip_engine::multistart::{MultistartFound, Search, multistart};
use mceip_engine::run::Watch;
use mceip_engine::search::near::{Near, near};
use mceip_exact::{Rational, Sparse, from_f64, parse, to_f64, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{Solution, TwoParticles, enumerate, table1};
use mceip_paper::{pythagorean_angles, two_particles};
use mceip_testkit::in_doubles;

const GAPS: [&str; 13] = [
    "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-12", "1e-13",
    "1e-14", "1e-15",
];

/// The angles with a threshold.
const ANGLES: usize = 6;

/// The solutions just above the thresholds of one angle: one for each pattern of equal signs, two
/// for (1, -1).
const SOLUTIONS_OF_AN_ANGLE: usize = 1 + 1 + 2;

fn gaps() -> impl Iterator<Item = Rational> {
    GAPS.iter().map(|text| parse(text).unwrap())
}

/// A threshold of Table 1 to 40 digits from below: the data with mu, and the x that appears there.
struct Threshold {
    data: TwoParticles,
    x: Vec<f64>,
}

impl Threshold {
    /// mu = sqrt(c^2 + 2) / s, where x_2 / x_1 = c^2 + 1 - S c sqrt(c^2 + 2).
    fn of_equal_signs(c: &Rational, s: &Rational, sign: i8) -> Threshold {
        let c_squared = c * c;
        let root = root_to_40_digits(&(&c_squared + whole(2)));
        let ratio = &c_squared + whole(1) - c * &root * whole(sign.into());
        Threshold {
            data: two_particles_with(c, s, root / s, (sign, sign)),
            x: vec![1.0, to_f64(&ratio)],
        }
    }

    /// mu = (c^2 + 1) / (c s) for (1, -1), where one particle slips.
    fn of_opposite_signs(c: &Rational, s: &Rational) -> Threshold {
        let mu = (c * c + whole(1)) / (c * s);
        Threshold {
            data: two_particles_with(c, s, mu, (1, -1)),
            x: vec![1.0, 0.0],
        }
    }

    /// The data with mu multiplied by a factor.
    fn data_beside(&self, factor: &Rational) -> TwoParticles {
        TwoParticles {
            mu: &self.data.mu * factor,
            ..self.data.clone()
        }
    }
}

fn two_particles_with(c: &Rational, s: &Rational, mu: Rational, signs: (i8, i8)) -> TwoParticles {
    TwoParticles {
        c: c.clone(),
        s: s.clone(),
        k: whole(7),
        m: whole(2),
        mu,
        signs,
    }
}

/// The thresholds of all angles with c s > 0.
fn thresholds() -> Vec<Threshold> {
    let mut list = Vec::new();
    for (c, s) in pythagorean_angles() {
        if &c * &s > whole(0) {
            list.push(Threshold::of_equal_signs(&c, &s, 1));
            list.push(Threshold::of_equal_signs(&c, &s, -1));
            list.push(Threshold::of_opposite_signs(&c, &s));
        }
    }
    list
}

/// The square root to 40 digits, rounded down.
fn root_to_40_digits(value: &Rational) -> Rational {
    let scale = parse("1e40").unwrap();
    let scaled = value * &scale * &scale;
    Rational::from_integer(scaled.to_integer().sqrt()) / scale
}

fn problem_of(data: &TwoParticles) -> Problem {
    let body = Body::System(two_particles(data).unwrap());
    Problem::new(body, Unknown::Lambda2, Window::all()).unwrap()
}

/// No claim is made for this candidate, and a cover of an interval above it proves that there is
/// nothing.
fn assert_absence_is_proved(problem: &Problem, candidate: &Candidate, label: &str) {
    let pencil = reduce(problem).unwrap().pencil;
    assert!(propose(&pencil, problem.window(), candidate).is_err());

    let absence = match near(problem, candidate, None, &Watch::nobody()).unwrap() {
        Near::Absent(absence) => absence,
        other => panic!("{label}: {other:?}"),
    };
    let cover = check(problem, absence.proved.certificate())
        .unwrap()
        .cover
        .unwrap();
    assert!(cover.solutions.is_empty());
    assert!(cover.open.is_empty());

    let window = &absence.proved.certificate().window;
    let value = from_f64(candidate.value).unwrap();
    let beyond = &value + parse("1e-10").unwrap();
    assert!(*window.min() <= value);
    assert!(*window.max().unwrap() >= beyond);
}

#[test]
fn below_the_threshold_absence_is_proved() {
    let mut absent = 0;

    for threshold in thresholds() {
        for gap in gaps() {
            let data = threshold.data_beside(&(whole(1) - &gap));
            assert!(table1(&data).is_empty());
            let problem = problem_of(&data);

            // What a peer reports: lambda^2 at its bound, at the size of its residual, and at the
            // gap.
            for value in [0.0, 1e-13, to_f64(&gap)] {
                let reported = Candidate {
                    value,
                    x: threshold.x.clone(),
                };
                let label = format!("{data:?} at {value}");
                assert_absence_is_proved(&problem, &reported, &label);
                absent += 1;
            }
        }
    }
    assert_eq!(absent, ANGLES * 3 * GAPS.len() * 3);
}

#[test]
fn above_the_threshold_everything_is_certified() {
    let mut accepted = 0;

    for threshold in thresholds() {
        for gap in gaps() {
            let data = threshold.data_beside(&(whole(1) + gap));
            let problem = problem_of(&data);
            let pencil = reduce(&problem).unwrap().pencil;
            let truth = enumerate(&pencil, problem.window()).unwrap().solutions;
            assert_eq!(truth.len(), table1(&data).len());

            for solution in truth {
                let candidate = in_doubles(&solution, &pencil.slip());
                let claim = propose(&pencil, problem.window(), &candidate).unwrap();
                let certificate = Certificate::of_claims(&problem, vec![claim]);
                let claims = check(&problem, &certificate).unwrap().claims;
                assert_eq!(claims[0].support, solution.slip);
                accepted += 1;
            }
        }
    }
    assert_eq!(accepted, ANGLES * SOLUTIONS_OF_AN_ANGLE * GAPS.len());
}

/// Is an accepted claim one of these solutions? The same support, and intervals that meet.
fn is_listed(claim: &AcceptedClaim, truth: &[Solution]) -> bool {
    let mut same_support = truth.iter().filter(|s| s.slip == claim.support);
    same_support.any(|solution| {
        let interval = solution.value.interval();
        interval.hi() >= claim.value.lo() && interval.lo() <= claim.value.hi()
    })
}

/// What the search found, and how many solutions there are.
struct Searched {
    found: MultistartFound,
    truth: usize,
}

/// What the search says of a problem: every claim is checked against the problem and the exact
/// enumeration.
fn searched(problem: &Problem) -> Searched {
    let reduced = reduce(problem).unwrap();
    let search = Search {
        starts: 6,
        window_starts: 1,
        ..Search::default()
    };

    let found = multistart(problem, &reduced, &search, &Watch::nobody()).unwrap();
    let truth = enumerate(&reduced.pencil, problem.window())
        .unwrap()
        .solutions;

    let claimed = found.certified.len();
    assert!(
        claimed <= truth.len(),
        "{claimed} claims of {}",
        truth.len()
    );
    if claimed > 0 {
        let claims = found.certified.iter().map(|c| c.claim.clone()).collect();
        let certificate = Certificate::of_claims(problem, claims);
        let accepted = check(problem, &certificate).unwrap().claims;
        assert!(accepted.iter().all(|claim| is_listed(claim, &truth)));
    }

    Searched {
        found,
        truth: truth.len(),
    }
}

/// What searches on both sides of thresholds came to.
#[derive(Default)]
struct Sides {
    /// Problems below with an uncertified point within the tolerance.
    trapped: usize,
    /// Certified solutions above.
    certified: usize,
    /// Solutions above.
    exist: usize,
}

impl Sides {
    /// Below there is nothing, and nothing is claimed.
    fn add_below(&mut self, problem: &Problem, label: &str) {
        let below = searched(problem);
        assert_eq!(below.truth, 0, "{label}");
        assert!(below.found.certified.is_empty(), "{label}");
        self.trapped += usize::from(!below.found.uncertified.is_empty());
    }

    fn add_above(&mut self, problem: &Problem) -> usize {
        let above = searched(problem);
        self.certified += above.found.certified.len();
        self.exist += above.truth;
        above.truth
    }
}

/// Peers' trap on our own solver: within the tolerance below the threshold, where nothing exists.
#[test]
fn the_search_claims_nothing_below_and_only_what_exists_above() {
    let mut sides = Sides::default();

    for threshold in thresholds() {
        for gap in gaps() {
            let below = threshold.data_beside(&(whole(1) - &gap));
            sides.add_below(&problem_of(&below), &format!("{below:?}"));

            let above = threshold.data_beside(&(whole(1) + &gap));
            sides.add_above(&problem_of(&above));
        }
    }

    let Sides {
        trapped,
        certified,
        exist,
    } = sides;
    println!(
        "uncertified points below in {trapped} of 234 problems, certified above {certified} of \
         {exist}"
    );
    // The tolerance is 1e-10: within it the residual is met without a solution, and the trap
    // springs. (71 problems in the run of 2026-11-21; a solver that is never trapped would leave
    // this test empty.)
    assert!(trapped >= 40, "{trapped}");
    assert_eq!(exist, ANGLES * SOLUTIONS_OF_AN_ANGLE * GAPS.len());
    assert_eq!(certified, exist);
}

/// K0 + mu K1 with K0 = diag(1, 2), K1 = [[0, -3], [1, -4]] and M = I.
fn fold_problem(mu: &Rational) -> Problem {
    let entries = [
        (0, 0, whole(1)),
        (0, 1, mu * whole(-3)),
        (1, 0, mu.clone()),
        (1, 1, whole(2) - mu * whole(4)),
    ];
    let a = Sparse::from_entries(2, 2, entries);
    let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

/// A pair of solutions is born at lambda^2 > 0 (fold of `facts.md`) at mu = 1 + sqrt(3) / 2. Below
/// it the residual is small at the double root's place, and there is no solution.
#[test]
fn beside_a_fold_nothing_false_is_claimed() {
    let fold = whole(1) + root_to_40_digits(&whole(3)) / whole(2);
    let mut sides = Sides::default();

    for gap in gaps() {
        let below = &fold * (whole(1) - &gap);
        sides.add_below(&fold_problem(&below), &format!("gap {gap}"));

        let above = &fold * (whole(1) + &gap);
        let truth = sides.add_above(&fold_problem(&above));
        assert_eq!(truth, 2, "gap {gap}");
    }

    let Sides {
        trapped,
        certified,
        exist,
    } = sides;
    println!(
        "fold: uncertified points below in {trapped} of 13 problems, certified above {certified} \
         of {exist}"
    );
    assert!(trapped >= 3, "{trapped}");
    // Both of a pair as long as doubles tell them apart (their distance is the root of the gap).
    assert!(certified >= 2 * 8, "{certified} of {exist}");
}
