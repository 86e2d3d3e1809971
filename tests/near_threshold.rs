//! Just below a threshold a solver's residual is tiny and no solution exists: everything it "finds" is
//! refused with a proof of absence. Just above, everything is certified. (Table 1, all sign patterns that
//! have thresholds, relative gaps from 1e-6 to 1e-12; peers' solvers report success on both sides.)
#![cfg(feature = "search")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::candidate::Candidate;
use mceip::certify::{certificate, certify};
use mceip::check::check;
use mceip::exact::{Rational, parse, to_f64, whole};
use mceip::model::{Body, Problem, Unknown, Window};
use mceip::oracle::{TwoParticles, enumerate, table1};
use mceip::reduction::reduce;
use mceip::search::near::{Near, near};
use mceip::source::{pythagorean_angles, two_particles};
use std::sync::atomic::AtomicBool;

const GAPS: [&str; 7] = ["1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-12"];

/// A threshold of Table 1 to 40 digits from below: mu, and the x that appears there.
struct Threshold {
    data: TwoParticles,
    x: Vec<f64>,
}

/// mu = sqrt(c^2 + 2) / s for equal signs; (c^2 + 1) / (c s) for (1, -1), where one particle slips.
fn thresholds() -> Vec<Threshold> {
    let mut out = Vec::new();
    for (c, s) in pythagorean_angles().into_iter().filter(|(c, s)| c * s > whole(0)) {
        for signs in [(1, 1), (-1, -1), (1, -1)] {
            let (mu, x) = if signs.0 == signs.1 {
                let root = root(&(&c * &c + whole(2)));
                // x_2 / x_1 = c^2 + 1 - S c sqrt(c^2 + 2)
                let ratio = to_f64(&(&c * &c + whole(1) - &c * &root * whole(signs.0.into())));
                (root / &s, vec![1.0, ratio])
            } else {
                ((&c * &c + whole(1)) / (&c * &s), vec![1.0, 0.0])
            };
            out.push(Threshold { data: TwoParticles { c: c.clone(), s: s.clone(), k: whole(7), m: whole(2), mu, signs }, x });
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
    let data = TwoParticles { mu: &t.data.mu * factor, ..t.data.clone() };
    let body = Body::System(two_particles(&data).unwrap());
    (Problem::new(body, Unknown::Lambda2, Window::all()).unwrap(), data)
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
            // What a peer reports: lambda^2 at its bound, at the size of its residual, and at the gap.
            for value in [0.0, 1e-13, to_f64(&gap)] {
                let claimed = Candidate { value, x: t.x.clone() };
                assert!(certify(&pencil, problem.window(), &claimed).is_err());
                match near(&problem, &claimed, None, &AtomicBool::new(false)).unwrap() {
                    Near::Absent(c) => {
                        let cover = check(&problem, &c.certificate).unwrap().cover.unwrap();
                        assert!(cover.solutions.is_empty() && cover.open.is_empty());
                        assert!(*c.certificate.window.min() == whole(0) && *c.certificate.window.max().unwrap() >= parse("1e-10").unwrap());
                        absent += 1;
                    }
                    other => panic!("{data:?} at {value}: {other:?}"),
                }
            }
        }
    }
    assert_eq!(absent, 6 * 3 * 7 * 3);
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
                let x = s.x_decimals(&pencil.slip(), 17).iter().map(|t| t.parse().unwrap()).collect();
                let claimed = Candidate { value: s.decimal(17).parse().unwrap(), x };
                let claim = certify(&pencil, problem.window(), &claimed).unwrap();
                let accepted_claims = check(&problem, &certificate(&problem, vec![claim])).unwrap().claims;
                assert_eq!(accepted_claims[0].support, s.slip);
                accepted += 1;
            }
        }
    }
    // One solution with equal signs, two with (1, -1).
    assert_eq!(accepted, 6 * (1 + 1 + 2) * 7);
}
