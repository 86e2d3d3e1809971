//! Just below a threshold a solver's residual is tiny and no solution exists: everything it "finds"
//! is refused with a proof of absence. Just above, everything is certified. (Table 1, all sign
//! patterns that have thresholds, relative gaps from 1e-3 to 1e-15; peers' solvers report success
//! on both sides.) The search itself: on neither side, nor beside a fold, is an uncertified point
//! among its solutions.
#![cfg(feature = "solver")]

use mceip_check::check;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{certificate, propose};
use mceip_engine::multistart::{Found, Search, multistart};
use mceip_engine::run::Watch;
use mceip_engine::search::near::{Near, near};
use mceip_exact::{Rational, Sparse, from_f64, parse, to_f64, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{TwoParticles, enumerate, table1};
use mceip_paper::{pythagorean_angles, two_particles};

const GAPS: [&str; 13] = [
    "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-12", "1e-13",
    "1e-14", "1e-15",
];

/// A threshold of Table 1 to 40 digits from below: mu, and the x that appears there.
struct Threshold {
    data: TwoParticles,
    x: Vec<f64>,
}

/// mu = sqrt(c^2 + 2) / s for equal signs; (c^2 + 1) / (c s) for (1, -1), where one particle slips.
fn thresholds() -> Vec<Threshold> {
    let mut out = Vec::new();
    for (c, s) in pythagorean_angles()
        .into_iter()
        .filter(|(c, s)| c * s > whole(0))
    {
        for signs in [(1, 1), (-1, -1), (1, -1)] {
            let (mu, x) = if signs.0 == signs.1 {
                let root = root(&(&c * &c + whole(2)));
                // x_2 / x_1 = c^2 + 1 - S c sqrt(c^2 + 2)
                let ratio = to_f64(&(&c * &c + whole(1) - &c * &root * whole(signs.0.into())));
                (root / &s, vec![1.0, ratio])
            } else {
                ((&c * &c + whole(1)) / (&c * &s), vec![1.0, 0.0])
            };
            out.push(Threshold {
                data: TwoParticles {
                    c: c.clone(),
                    s: s.clone(),
                    k: whole(7),
                    m: whole(2),
                    mu,
                    signs,
                },
                x,
            });
        }
    }
    out
}

/// The square root to 40 digits, rounded down.
fn root(v: &Rational) -> Rational {
    let scale = parse("1e80").unwrap();
    Rational::from_integer((v * &scale).to_integer().sqrt()) / parse("1e40").unwrap()
}

fn problem(t: &Threshold, factor: &Rational) -> (Problem, TwoParticles) {
    let data = TwoParticles {
        mu: &t.data.mu * factor,
        ..t.data.clone()
    };
    let body = Body::System(two_particles(&data).unwrap());
    (
        Problem::new(body, Unknown::Lambda2, Window::all()).unwrap(),
        data,
    )
}

#[test]
fn below_the_threshold_absence_is_proved() {
    let mut absent = 0;
    for t in thresholds() {
        for gap in GAPS {
            let gap = parse(gap).unwrap();
            let (problem, data) = problem(&t, &(whole(1) - &gap));
            assert!(table1(&data).is_empty());
            let pencil = reduce(&problem).unwrap().pencil;
            // What a peer reports: lambda^2 at its bound, at the size of its residual, and at the
            // gap.
            for value in [0.0, 1e-13, to_f64(&gap)] {
                let claimed = Candidate {
                    value,
                    x: t.x.clone(),
                };
                assert!(propose(&pencil, problem.window(), &claimed).is_err());
                match near(&problem, &claimed, None, &Watch::nobody()).unwrap() {
                    Near::Absent(c) => {
                        let cover = check(&problem, &c.certificate).unwrap().cover.unwrap();
                        assert!(cover.solutions.is_empty() && cover.open.is_empty());
                        let (window, at) = (&c.certificate.window, from_f64(value).unwrap());
                        assert!(
                            *window.min() <= at
                                && *window.max().unwrap() >= at + parse("1e-10").unwrap()
                        );
                        absent += 1;
                    }
                    other => panic!("{data:?} at {value}: {other:?}"),
                }
            }
        }
    }
    assert_eq!(absent, 6 * 3 * GAPS.len() * 3);
}

#[test]
fn above_the_threshold_everything_is_certified() {
    let mut accepted = 0;
    for t in thresholds() {
        for gap in GAPS {
            let (problem, data) = problem(&t, &(whole(1) + parse(gap).unwrap()));
            let pencil = reduce(&problem).unwrap().pencil;
            let truth = enumerate(&pencil, problem.window()).unwrap().solutions;
            assert_eq!(truth.len(), table1(&data).len());
            for s in truth {
                let x = s
                    .x_decimals(&pencil.slip(), 17)
                    .iter()
                    .map(|t| t.parse().unwrap())
                    .collect();
                let claimed = Candidate {
                    value: s.decimal(17).parse().unwrap(),
                    x,
                };
                let claim = propose(&pencil, problem.window(), &claimed).unwrap();
                let accepted_claims = check(&problem, &certificate(&problem, vec![claim]))
                    .unwrap()
                    .claims;
                assert_eq!(accepted_claims[0].support, s.slip);
                accepted += 1;
            }
        }
    }
    // One solution with equal signs, two with (1, -1).
    assert_eq!(accepted, 6 * (1 + 1 + 2) * GAPS.len());
}

/// What the search says of a problem: every claim is checked against the problem and the exact
/// enumeration.
fn searched(problem: &Problem) -> (Found, usize) {
    let pencil = reduce(problem).unwrap().pencil;
    let admissible = Admissible::new(&pencil, problem.unknown()).unwrap();
    let search = Search {
        starts: 6,
        window_starts: 1,
        ..Search::default()
    };
    let found = multistart(problem, &admissible, &search).unwrap();
    let truth = enumerate(&pencil, problem.window()).unwrap().solutions;
    assert!(
        found.certified.len() <= truth.len(),
        "{} claims of {}",
        found.certified.len(),
        truth.len()
    );
    if !found.certified.is_empty() {
        let claims = found.certified.iter().map(|c| c.claim.clone()).collect();
        let accepted = check(problem, &certificate(problem, claims))
            .unwrap()
            .claims;
        let is_true = |c: &mceip_check::AcceptedClaim| {
            truth.iter().any(|s| {
                s.slip == c.support
                    && s.value.interval().hi() >= c.value.lo()
                    && s.value.interval().lo() <= c.value.hi()
            })
        };
        assert!(accepted.iter().all(is_true));
    }
    (found, truth.len())
}

/// Peers' trap on our own solver: within the tolerance below the threshold, where nothing exists.
#[test]
fn the_search_claims_nothing_below_and_only_what_exists_above() {
    let (mut trapped, mut certified, mut exist) = (0, 0, 0);
    for t in thresholds() {
        for gap in GAPS {
            let gap = parse(gap).unwrap();
            let (below, truth) = searched(&problem(&t, &(whole(1) - &gap)).0);
            assert_eq!((below.certified.len(), truth), (0, 0));
            trapped += usize::from(!below.uncertified.is_empty());
            let (above, truth) = searched(&problem(&t, &(whole(1) + &gap)).0);
            certified += above.certified.len();
            exist += truth;
        }
    }
    println!(
        "uncertified points below in {trapped} of 234 problems, certified above {certified} of \
         {exist}"
    );
    // The tolerance is 1e-10: within it the residual is met without a solution, and the trap
    // springs. (71 problems in the run of 2026-11-21; a solver that is never trapped would leave
    // this test empty.)
    assert!(trapped >= 40, "{trapped}");
    assert_eq!(exist, 6 * (1 + 1 + 2) * GAPS.len());
    assert_eq!(certified, exist);
}

/// A pair of solutions is born at lambda^2 > 0 (fold of `facts.md`: K0 = diag(1, 2), K1 = [[0, -3],
/// [1, -4]], M = I) at mu = 1 + sqrt(3) / 2. Below it the residual is small at the double root's
/// place, and there is no solution.
#[test]
fn beside_a_fold_nothing_false_is_claimed() {
    let fold = whole(1) + root(&whole(3)) / whole(2);
    let (mut trapped, mut certified, mut exist) = (0, 0, 0);
    for gap in GAPS {
        let gap = parse(gap).unwrap();
        for (side, count) in [(-1, 0), (1, 2)] {
            let mu = &fold * (whole(1) + &gap * whole(side));
            let entries = [
                whole(1),
                &mu * whole(-3),
                mu.clone(),
                whole(2) - &mu * whole(4),
            ];
            let a = Sparse::from_entries(
                2,
                2,
                entries
                    .into_iter()
                    .enumerate()
                    .map(|(k, v)| (k / 2, k % 2, v)),
            );
            let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
            let problem =
                Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
            let (found, truth) = searched(&problem);
            assert_eq!(truth, count, "gap {gap}, side {side}");
            if side < 0 {
                assert!(found.certified.is_empty());
                trapped += usize::from(!found.uncertified.is_empty());
            } else {
                certified += found.certified.len();
                exist += truth;
            }
        }
    }
    println!(
        "fold: uncertified points below in {trapped} of 13 problems, certified above {certified} \
         of {exist}"
    );
    assert!(trapped >= 3, "{trapped}");
    // Both of a pair as long as doubles tell them apart (their distance is the root of the gap).
    assert!(certified >= 2 * 8, "{certified} of {exist}");
}
