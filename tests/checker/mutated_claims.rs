//! Random forgeries of solution claims: what the checker accepts is true, and the oracle says what
//! is true.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_check::check;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{certificate, flattened, lifted, propose};
use mceip_engine::reduction::{Reduced, lift, reduce};
use mceip_exact::{
    Algebraic, Integer, Interval, Poly, Sign, Sparse, common_denominator, rational, roots_in, whole,
};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate, is_solution};
use mceip_testkit::{degenerate, mechanical, mutate, random_pencils};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// A problem, its true certificates and the oracle's answer.
struct Subject {
    problem: Problem,
    reduced: Reduced,
    truth: Enumeration,
    certificates: Vec<Certificate>,
}

impl Subject {
    fn of(problem: Problem) -> Subject {
        let reduced = reduce(&problem).unwrap();
        let truth = enumerate(&reduced.pencil, problem.window()).unwrap();
        let slip = reduced.pencil.slip();
        let mut certificates = Vec::new();
        for s in &truth.solutions {
            let x = s
                .x_decimals(&slip, 17)
                .iter()
                .map(|t| t.parse().unwrap())
                .collect();
            let claim = propose(
                &reduced.pencil,
                problem.window(),
                &Candidate {
                    value: s.decimal(17).parse().unwrap(),
                    x,
                },
            )
            .unwrap();
            if let (Body::System(system), Claim::ExactSolution(c)) = (problem.body(), &claim) {
                certificates.push(certificate(
                    &problem,
                    vec![Claim::LiftedSolution(lifted(system, problem.unknown(), c))],
                ));
            }
            certificates.push(certificate(&problem, vec![claim]));
        }
        Subject {
            problem,
            reduced,
            truth,
            certificates,
        }
    }

    /// Is every claim of the certificate true, by the oracle alone?
    fn is_true(&self, c: &Certificate) -> bool {
        c.unknown == self.problem.unknown()
            && c.claims.iter().all(|claim| match claim {
                Claim::ExactSolution(c) => self.exact_is_true(c),
                Claim::LiftedSolution(c) => self.lifted_is_true(c),
                Claim::EnclosedSolution(c) => self.enclosed_is_true(c),
            })
    }

    fn exact_is_true(&self, c: &ExactSolution) -> bool {
        let Some(mut value) = value(&c.polynomial, &c.interval) else {
            return false;
        };
        let x = polynomials(&c.x);
        let slip = self.reduced.pencil.slip();
        let positive: Vec<usize> = slip
            .iter()
            .copied()
            .filter(|&i| value.sign_of(&x[i]) == Sign::Positive)
            .collect();
        is_solution(&self.reduced.pencil, &value, &x) && positive == c.support
    }

    /// v is the lift of a solution, and w = (t M + K) v.
    fn lifted_is_true(&self, c: &LiftedSolution) -> bool {
        let Body::System(system) = self.problem.body() else {
            return false;
        };
        let flat = flattened(system, c);
        let Some(mut value) = value(&c.polynomial, &c.interval) else {
            return false;
        };
        let again = lift(
            system,
            self.problem.unknown(),
            &self.reduced.variables,
            &polynomials(&flat.x),
        );
        // Up to the factors that clear denominators.
        let clear = common_denominator(flat.x.iter().flatten().map(|n| &n.0));
        let mut agrees = |ours: &[Poly], scale: &Integer, theirs: &[Vec<Number>]| {
            let own = common_denominator(theirs.iter().flatten().map(|n| &n.0));
            let integral = |p: &Vec<Number>| {
                Poly::new(
                    p.iter()
                        .map(|n| n.0.numer() * (&own / n.0.denom()))
                        .collect(),
                )
            };
            ours.iter().zip(theirs).all(|(a, b)| {
                value.sign_of(&(&a.scale(&own) - &integral(b).scale(&(scale * &clear))))
                    == Sign::Zero
            })
        };
        agrees(&again.v, &again.v_scale, &c.v)
            && agrees(&again.w, &again.w_scale, &c.w)
            && self.exact_is_true(&flat)
    }

    /// Exactly one solution of the oracle has this support and its value in the box.
    fn enclosed_is_true(&self, c: &EnclosedSolution) -> bool {
        let (t, r) = (&c.center.last().unwrap().0, &c.radius.last().unwrap().0);
        let within = |v: &Algebraic| {
            let mut v = v.clone();
            v.cmp_rational(&(t - r)) != Ordering::Less
                && v.cmp_rational(&(t + r)) != Ordering::Greater
        };
        self.truth
            .solutions
            .iter()
            .filter(|s| s.slip == c.support && within(&s.value))
            .count()
            == 1
    }
}

/// The number that polynomial and interval name; `None` if it is not one number.
fn value(p: &[Integer], interval: &[Number; 2]) -> Option<Algebraic> {
    let p = Poly::new(p.to_vec());
    let interval = Interval::new(interval[0].0.clone(), interval[1].0.clone())?;
    let roots = roots_in(&p, interval.lo(), Some(interval.hi()));
    (roots.len() == 1).then(|| roots.into_iter().next().unwrap())
}

/// Integer polynomials, all times one positive number.
fn polynomials(list: &[Vec<Number>]) -> Vec<Poly> {
    let clear = common_denominator(list.iter().flatten().map(|n| &n.0));
    list.iter()
        .map(|p| {
            Poly::new(
                p.iter()
                    .map(|n| n.0.numer() * (&clear / n.0.denom()))
                    .collect(),
            )
        })
        .collect()
}

/// t = 3 with x = (1/2, 1/2), in a box.
fn boxed() -> Subject {
    let pencil = Pencil::new(
        Sparse::from_ints(&[&[-1, -2], &[-2, -1]]),
        Sparse::identity(2),
        vec![],
    )
    .unwrap();
    let mut subject =
        Subject::of(Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap());
    let preconditioner = [[2, -2, 8], [-2, 2, 8], [16, 16, 0]]
        .map(|r| r.map(Integer::from).to_vec())
        .to_vec();
    let half = || Number(rational(1, 2));
    let radius = vec![Number(rational(1, 1 << 20)); 3];
    let claim = EnclosedSolution {
        support: vec![0, 1],
        center: vec![half(), half(), Number(whole(3))],
        radius,
        preconditioner,
        exponent: 4,
    };
    let c = certificate(&subject.problem, vec![Claim::EnclosedSolution(claim)]);
    subject.certificates = vec![c];
    subject
}

fn subjects() -> Vec<Subject> {
    let mut problems: Vec<Problem> = degenerate()
        .unwrap()
        .into_iter()
        .map(|i| i.problem)
        .collect();
    problems.extend(
        random_pencils(25, 11)
            .unwrap()
            .into_iter()
            .map(|i| i.problem),
    );
    problems.extend(mechanical(25, 12).unwrap().into_iter().map(|i| i.problem));
    let mut list: Vec<Subject> = problems
        .into_iter()
        .map(Subject::of)
        .filter(|s| !s.certificates.is_empty())
        .collect();
    list.push(boxed());
    list
}

fn forgeries(count: usize, seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let subjects = subjects();
    for s in &subjects {
        s.certificates.iter().for_each(|c| {
            assert!(
                check(&s.problem, c).is_ok() && s.is_true(c),
                "{}",
                c.to_json()
            )
        });
    }
    let (mut accepted, mut rejected, mut reasons) = (0, 0, BTreeSet::new());
    while accepted + rejected < count {
        let s = &subjects[rng.random_range(0..subjects.len())];
        let original = &s.certificates[rng.random_range(0..s.certificates.len())];
        let mut forged = original.clone();
        for _ in 0..rng.random_range(1..=3) {
            mutate(&mut forged, &mut rng);
        }
        if forged == *original {
            continue;
        }
        match check(&s.problem, &forged) {
            Ok(_) => {
                accepted += 1;
                assert!(
                    s.is_true(&forged),
                    "accepted and false:\n{}\n{}",
                    s.problem.canonical_text(),
                    forged.to_json()
                );
            }
            Err(e) => {
                rejected += 1;
                reasons.insert(e.reason.name());
            }
        }
    }
    println!(
        "{accepted} forgeries accepted and true, {rejected} rejected for {} reasons: {reasons:?}",
        reasons.len()
    );
    assert!(
        accepted > count / 20 && rejected > count / 4 && reasons.len() >= 12,
        "{accepted} {rejected} {reasons:?}"
    );
}

#[test]
fn what_is_accepted_of_three_thousand_forgeries_is_true() {
    forgeries(3_000, 1);
}

#[test]
#[ignore = "minutes"]
fn what_is_accepted_of_a_hundred_thousand_forgeries_is_true() {
    forgeries(100_000, 1000);
}
