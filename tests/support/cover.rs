//! A cover against the exact enumerator: the same set, or open exactly where something is missing; and
//! certificates to forge.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip::certificate::{Certificate, CompleteSet, Node};
use mceip::check::{AcceptedClaim, AcceptedCover, check};
use mceip::exact::{Algebraic, Interval, Sparse};
use mceip::model::{Body, Pencil, Problem, Unknown, Window};
use mceip::oracle::{Enumeration, Solution};
use mceip::reduction::reduce;
use mceip::search::complete::{Options, complete};
use mceip::search::screen;
use mceip::testkit::{mechanical_pencil, random_pencils};
use std::cmp::Ordering;
use std::sync::atomic::AtomicBool;

pub fn truth(problem: &Problem) -> Enumeration {
    screen::enumerate(&reduce(problem).unwrap().pencil, problem.window()).unwrap().0
}

/// What a cover says that is not so; empty where it is right. Everything the enumerator lists is in
/// the cover's list or in an open region, and the cover lists nothing else.
pub fn disagreements(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for s in &cover.solutions {
        let matches = truth.solutions.iter().filter(|t| is_same(t, s)).count();
        if matches != 1 {
            wrong.push(format!("listed: {:?} in {:?}, {matches} of the enumerator's match", s.support, s.value));
        }
    }
    for t in &truth.solutions {
        let listed = cover.solutions.iter().filter(|s| is_same(t, s)).count();
        if listed > 1 || (listed == 0 && !is_open(cover, &t.slip, &t.value)) {
            wrong.push(format!("slip {:?} at {} is listed {listed} times and not open", t.slip, t.decimal(12)));
        }
    }
    // More than one solution at a value or a range of values: never closed by a list.
    for c in truth.cones.iter().filter(|c| c.dimension > 1) {
        if !is_open(cover, &c.slip, &c.value) {
            wrong.push(format!("the cone of slip {:?} is not open", c.slip));
        }
    }
    for r in &truth.ranges {
        for p in r.pieces.iter().filter(|p| p.from.included) {
            if !is_open(cover, &r.support, &p.from.value) {
                wrong.push(format!("the range of support {:?} is not open", r.support));
            }
        }
    }
    if cover.open.is_empty() && !truth.is_plain_list() {
        wrong.push("complete, but the answer is no list".into());
    }
    wrong
}

fn is_same(t: &Solution, s: &AcceptedClaim) -> bool {
    t.slip == s.support && within(&t.value, &s.value)
}

fn within(value: &Algebraic, interval: &Interval) -> bool {
    let mut value = value.clone();
    value.cmp_rational(interval.lo()) != Ordering::Less && value.cmp_rational(interval.hi()) != Ordering::Greater
}

/// Is the solution in an open region: value in its interval, support between its moving set and that with the
/// undecided added?
fn is_open(cover: &AcceptedCover, support: &[usize], value: &Algebraic) -> bool {
    cover.open.iter().any(|r| {
        let mut value = value.clone();
        r.moving.iter().all(|i| support.contains(i))
            && support.iter().all(|i| r.moving.contains(i) || r.undecided.contains(i))
            && value.cmp_rational(&r.min) != Ordering::Less
            && r.max.as_ref().is_none_or(|max| value.cmp_rational(max) != Ordering::Greater)
    })
}

pub fn proved(problem: &Problem) -> Certificate {
    let options = Options { pieces: 6, ..Options::default() };
    let certificate = complete(problem, &options, &AtomicBool::new(false), &|_| {}).unwrap().certificate;
    assert!(check(problem, &certificate).is_ok());
    certificate
}

/// MCEIP-mu without free variables, several solutions.
pub fn plain() -> (Problem, Certificate) {
    let problem = mechanical_pencil(6, Unknown::Mu, 4).unwrap();
    let certificate = proved(&problem);
    (problem, certificate)
}

/// MCEIP-mu with free variables: a condensation in the certificate.
pub fn condensed() -> (Problem, Certificate) {
    let is_fit = |p: &Problem| {
        let pencil = reduce(p).unwrap().pencil;
        p.unknown() == Unknown::Mu && pencil.free().len() >= 2 && pencil.slip().len() >= 3 && !truth(p).solutions.is_empty()
    };
    let problem = random_pencils(60, 3).unwrap().into_iter().map(|i| i.problem).find(is_fit).unwrap();
    let certificate = proved(&problem);
    (problem, certificate)
}

/// lambda^2 = 2 and 3 on one support.
pub fn fold(window: Window) -> Problem {
    let pencil = Pencil::new(Sparse::from_ints(&[&[1, -6], &[2, -6]]), Sparse::identity(2), vec![]).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}

pub fn set(certificate: &mut Certificate) -> &mut CompleteSet {
    certificate.complete_set.as_mut().unwrap()
}

pub fn trees(certificate: &Certificate) -> impl Iterator<Item = ((usize, usize), &Node)> {
    let pieces = &certificate.complete_set.as_ref().unwrap().pieces;
    pieces.iter().enumerate().flat_map(|(p, piece)| piece.tree.iter().enumerate().map(move |(k, node)| ((p, k), node)))
}
