//! Random forgeries of solution claims: what the checker accepts is true, and the oracle says what
//! is true.
//!
//! The oracle enumerates the solutions exactly and judges a claim by itself: it evaluates the
//! claimed polynomials at the claimed number and lifts x back to the degrees of freedom. It shares
//! no obligation with the checker.
#![cfg(feature = "testkit")]

use crate::corpus_reader::entry;
use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_check::check;
use mceip_engine::certify::{flattened, lifted, propose};
use mceip_exact::{
    Algebraic, Integer, Interval, Poly, Sign, cleared, common_denominator, roots_in,
};
use mceip_model::file::{Number, read_problem};
use mceip_model::reduction::{lift, reduce};
use mceip_model::{Body, Problem, Reduced};
use mceip_oracle::{Enumeration, enumerate, is_between, is_solution};
use mceip_testkit::{degenerate, in_doubles, mechanical, random_pencils};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use std::path::Path;

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

        for solution in &truth.solutions {
            let candidate = in_doubles(solution, &slip);
            let claim = propose(&reduced.pencil, problem.window(), &candidate).unwrap();

            if let (Body::System(system), Claim::ExactSolution(exact)) = (problem.body(), &claim) {
                let motion = lifted(system, problem.unknown(), exact);
                let claims = vec![Claim::LiftedSolution(motion)];
                certificates.push(Certificate::of_claims(&problem, claims));
            }
            certificates.push(Certificate::of_claims(&problem, vec![claim]));
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

    /// The polynomials solve at the number, and the support is where x is positive.
    fn exact_is_true(&self, claim: &ExactSolution) -> bool {
        let Some(mut value) = value(&claim.polynomial, &claim.interval) else {
            return false;
        };
        let x = polynomials(&claim.x);

        let mut positive = self.reduced.pencil.slip();
        positive.retain(|&i| value.sign_of(&x[i]) == Sign::Positive);
        is_solution(&self.reduced.pencil, &value, &x) && positive == claim.support
    }

    /// v is the lift of a solution, and w = (t M + K) v.
    fn lifted_is_true(&self, claim: &LiftedSolution) -> bool {
        let Body::System(system) = self.problem.body() else {
            return false;
        };
        let Some(mut value) = value(&claim.polynomial, &claim.interval) else {
            return false;
        };

        let flat = flattened(system, claim);
        let x = polynomials(&flat.x);
        let again = lift(system, self.problem.unknown(), &self.reduced.variables, &x);

        // Up to the factors that clear denominators.
        let cleared = clearing_factor(&flat.x);
        let v_scale = &again.v_scale * &cleared;
        let w_scale = &again.w_scale * &cleared;
        agree(&mut value, &again.v, &v_scale, &claim.v)
            && agree(&mut value, &again.w, &w_scale, &claim.w)
            && self.exact_is_true(&flat)
    }

    /// Exactly one solution of the oracle has this support and its value in the box.
    fn enclosed_is_true(&self, claim: &EnclosedSolution) -> bool {
        let center = &claim.center.last().unwrap().0;
        let radius = &claim.radius.last().unwrap().0;
        let lo = center - radius;
        let hi = center + radius;

        let solutions = self.truth.solutions.iter();
        let in_box = solutions.filter(|solution| {
            solution.slip == claim.support && is_between(&solution.value, &lo, &hi)
        });
        in_box.count() == 1
    }
}

/// Is `ours` at the value the same as `theirs` times the scale?
fn agree(value: &mut Algebraic, ours: &[Poly], scale: &Integer, theirs: &[Vec<Number>]) -> bool {
    let cleared = clearing_factor(theirs);
    let theirs = polynomials(theirs);

    let mut pairs = ours.iter().zip(&theirs);
    pairs.all(|(ours, theirs)| {
        let difference = &ours.scale(&cleared) - &theirs.scale(scale);
        value.sign_of(&difference) == Sign::Zero
    })
}

/// The number that polynomial and interval name; `None` if it is not one number.
fn value(polynomial: &[Integer], interval: &[Number; 2]) -> Option<Algebraic> {
    let polynomial = Poly::new(polynomial.to_vec());
    let [lo, hi] = interval.clone().map(|end| end.0);
    let interval = Interval::new(lo, hi)?;

    let mut roots = roots_in(&polynomial, interval.lo(), Some(interval.hi()));
    if roots.len() == 1 { roots.pop() } else { None }
}

/// The common denominator of all coefficients.
fn clearing_factor(list: &[Vec<Number>]) -> Integer {
    common_denominator(list.iter().flatten().map(|number| &number.0))
}

/// Integer polynomials: all times the common denominator of their coefficients.
fn polynomials(list: &[Vec<Number>]) -> Vec<Poly> {
    let clear = clearing_factor(list);
    let mut polynomials = Vec::new();
    for polynomial in list {
        let numbers = polynomial.iter().map(|number| &number.0);
        let coefficients = numbers.map(|number| cleared(number, &clear));
        polynomials.push(Poly::new(coefficients.collect()));
    }
    polynomials
}

/// t = 3 with x = (1/2, 1/2), in a box.
fn boxed() -> Subject {
    let entry = entry("accept/enclosed");
    let problem = read_problem(&entry.problem, Path::new("/")).unwrap();
    let enclosed = Certificate::from_json(&entry.certificate).unwrap();
    Subject {
        certificates: vec![enclosed],
        ..Subject::of(problem)
    }
}

/// Degenerate pencils, random pencils and random systems that have a solution, and `boxed`.
fn subjects() -> Vec<Subject> {
    let mut instances = degenerate().unwrap();
    instances.extend(random_pencils(25, 11).unwrap());
    instances.extend(mechanical(25, 12).unwrap());

    let all = instances.into_iter().map(|i| Subject::of(i.problem));
    let mut subjects: Vec<Subject> = all.collect();
    subjects.retain(|subject| !subject.certificates.is_empty());
    subjects.push(boxed());
    subjects
}

/// What the checker said of the forgeries.
#[derive(Debug, Default)]
struct Judged {
    accepted: usize,
    rejected: usize,
    reasons: BTreeSet<String>,
}

fn forgeries(count: usize, seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let subjects = subjects();
    for subject in &subjects {
        assert_honest(subject);
    }

    let mut judged = Judged::default();
    while judged.accepted + judged.rejected < count {
        let subject = &subjects[rng.random_range(0..subjects.len())];
        let original = &subject.certificates[rng.random_range(0..subject.certificates.len())];

        let mut text = serde_json::from_str(&original.to_json()).unwrap();
        crate::structural::mutate(&mut text, &[], &mut rng);
        let Ok(forged) = Certificate::from_json(&text.to_string()) else {
            continue;
        };
        if forged != *original {
            judge(subject, &forged, &mut judged);
        }
    }

    println!(
        "{} forgeries accepted and true, {} rejected for {} reasons: {:?}",
        judged.accepted,
        judged.rejected,
        judged.reasons.len(),
        judged.reasons
    );
    assert!(judged.accepted > count / 20, "{judged:?}");
    assert!(judged.rejected > count / 4, "{judged:?}");
    assert!(judged.reasons.len() >= 12, "{judged:?}");
}

/// The unchanged certificates are accepted and true.
fn assert_honest(subject: &Subject) {
    for certificate in &subject.certificates {
        let verdict = check(&subject.problem, certificate);
        assert!(verdict.is_ok(), "{}", certificate.to_json());
        assert!(subject.is_true(certificate), "{}", certificate.to_json());
    }
}

fn judge(subject: &Subject, forged: &Certificate, judged: &mut Judged) {
    match check(&subject.problem, forged) {
        Ok(_) => {
            judged.accepted += 1;
            assert!(
                subject.is_true(forged),
                "accepted and false:\n{}\n{}",
                subject.problem.canonical_text(),
                forged.to_json()
            );
        }
        Err(rejected) => {
            judged.rejected += 1;
            judged.reasons.insert(rejected.reason.name());
        }
    }
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
