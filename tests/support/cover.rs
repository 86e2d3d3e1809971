//! A cover against the exact enumerator: the same set, or open exactly where something is missing;
//! and certificates to forge.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip::certificate::{Certificate, CompleteSet, Node};
use mceip::check::{AcceptedClaim, AcceptedCover, SolutionFamily, check};
use mceip::exact::{Algebraic, Interval, Sparse, whole};
use mceip::model::{Body, Pencil, Problem, Unknown, Window};
use mceip::oracle::{End, Enumeration, Piece, Solution, SupportRange, enumerate, examine_support};
use mceip::reduction::reduce;
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use mceip::testkit::{mechanical_pencil, random_pencils};
use std::cmp::Ordering;

pub fn truth(problem: &Problem) -> Enumeration {
    enumerate(&reduce(problem).unwrap().pencil, problem.window()).unwrap()
}

/// What a cover says that is not so; empty where it is right. Everything the enumerator lists is in
/// the cover's list or in an open region, and the cover lists nothing else.
pub fn disagreements(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for s in &cover.solutions {
        let matches = truth.solutions.iter().filter(|t| is_same(t, s)).count()
            + usize::from(is_last_of_range(truth, s));
        if matches != 1 {
            wrong.push(format!(
                "listed: {:?} in {:?}, {matches} of the enumerator's match",
                s.support, s.value
            ));
        }
    }
    for t in &truth.solutions {
        let listed = cover.solutions.iter().filter(|s| is_same(t, s)).count();
        if listed > 1 || (listed == 0 && !is_open(cover, &t.slip, &t.value)) {
            wrong.push(format!(
                "slip {:?} at {} is listed {listed} times and not open",
                t.slip,
                t.decimal(12)
            ));
        }
    }
    // More than one solution at a value or a range of values: in a family or open.
    for c in truth.cones.iter().filter(|c| c.dimension > 1) {
        if !is_open(cover, &c.slip, &c.value) && !is_in_family(cover, &c.slip, &c.value) {
            wrong.push(format!(
                "the cone of slip {:?} is neither open nor a family",
                c.slip
            ));
        }
    }
    for r in &truth.ranges {
        for value in r.pieces.iter().flat_map(probes) {
            if !is_open(cover, &r.support, &value)
                && !is_in_family(cover, &r.support, &value)
                && !is_end_listed(cover, truth, r, &value)
            {
                wrong.push(format!(
                    "the range of support {:?} is neither open nor a family",
                    r.support
                ));
            }
        }
    }
    // No family without a cone or a range; which of a cone's faces have one, `family_disagreements`
    // asks.
    for f in &cover.families {
        let cone = truth.cones.iter().any(|c| {
            f.is_point && f.support.iter().all(|i| c.slip.contains(i)) && within(&c.value, &f.from)
        });
        if !cone && !is_in_ranges(truth, f) {
            wrong.push(format!("the family {f:?} is not there"));
        }
    }
    // Ranges that the window cuts to single values are lists within it; each value was asked for
    // above.
    let long = truth
        .ranges
        .iter()
        .flat_map(|r| &r.pieces)
        .any(|p| !is_one(p));
    let no_list =
        long || !truth.undescribed.is_empty() || truth.cones.iter().any(|c| c.dimension > 1);
    if cover.open.is_empty() && cover.families.is_empty() && no_list {
        wrong.push("complete, but the answer is no list".into());
    }
    wrong
}

/// Families against what the oracle finds on their very supports, each support by itself.
pub fn family_disagreements(problem: &Problem, cover: &AcceptedCover) -> Vec<String> {
    let pencil = reduce(problem).unwrap().pencil;
    let slip = pencil.slip();
    let mut wrong = Vec::new();
    for subset in 1u32..1 << slip.len() {
        let support: Vec<usize> = slip
            .iter()
            .enumerate()
            .filter(|(k, _)| subset >> k & 1 == 1)
            .map(|(_, &i)| i)
            .collect();
        let mut own = Enumeration::default();
        examine_support(&pencil, &support, problem.window(), &mut own);
        own.describe(&pencil, problem.window());
        for value in own
            .cones
            .iter()
            .filter(|c| c.slip == support)
            .map(|c| c.value.clone())
            .chain(ranges(&own, &support))
        {
            let listed = own
                .ranges
                .iter()
                .any(|r| is_end_listed(cover, &own, r, &value));
            if !is_open(cover, &support, &value)
                && !is_in_family(cover, &support, &value)
                && !listed
            {
                wrong.push(format!(
                    "support {support:?}: more solutions than listed, no family"
                ));
            }
        }
        for f in cover.families.iter().filter(|f| f.support == support) {
            let cone = own
                .cones
                .iter()
                .any(|c| f.is_point && c.slip == support && within(&c.value, &f.from));
            if !cone && !is_in_ranges(&own, f) {
                wrong.push(format!("the family {f:?} is not there"));
            }
        }
    }
    wrong
}

/// Is this the one value that the window leaves of a range? The oracle calls that a range (no
/// window decides what is isolated), the cover, which knows the window only, a single solution.
fn is_last_of_range(truth: &Enumeration, s: &AcceptedClaim) -> bool {
    let at = |p: &Piece| s.value.is_point() && within(&p.from.value, &s.value);
    truth
        .ranges
        .iter()
        .filter(|r| r.support == s.support)
        .any(|r| r.pieces.iter().any(|p| is_one(p) && at(p)))
}

fn is_one(p: &Piece) -> bool {
    p.to.as_ref()
        .is_some_and(|to| to.value.clone().equals(&mut p.from.value.clone()))
}

fn is_end_listed(
    cover: &AcceptedCover,
    truth: &Enumeration,
    r: &SupportRange,
    value: &Algebraic,
) -> bool {
    cover
        .solutions
        .iter()
        .any(|s| s.support == r.support && within(value, &s.value) && is_last_of_range(truth, s))
}

fn ranges<'a>(
    truth: &'a Enumeration,
    support: &'a [usize],
) -> impl Iterator<Item = Algebraic> + 'a {
    truth
        .ranges
        .iter()
        .filter(move |r| r.support == support)
        .flat_map(|r| r.pieces.iter().flat_map(probes))
}

/// The ends of a piece that belong to it, and a number inside.
fn probes(piece: &Piece) -> Vec<Algebraic> {
    let mut out: Vec<Algebraic> = std::iter::once(&piece.from)
        .chain(&piece.to)
        .filter(|e| e.included)
        .map(|e| e.value.clone())
        .collect();
    let mut from = piece.from.value.clone();
    let inside = match piece.to.as_ref().map(|t| t.value.clone()) {
        None => from.interval().hi() + whole(1),
        Some(mut to) if from.clone().cmp_exact(&mut to.clone()) == Ordering::Less => {
            while from.interval().hi() >= to.interval().lo() {
                from.refine();
                to.refine();
            }
            (from.interval().hi() + to.interval().lo()) / whole(2)
        }
        Some(_) => return out,
    };
    out.push(Algebraic::rational(inside));
    out
}

fn is_in_family(cover: &AcceptedCover, support: &[usize], value: &Algebraic) -> bool {
    cover
        .families
        .iter()
        .filter(|f| f.support == support)
        .any(|f| {
            let mut value = value.clone();
            let above =
                |end: &Interval, v: &mut Algebraic| v.cmp_rational(end.lo()) == Ordering::Greater;
            let below = |v: &mut Algebraic| {
                f.to.as_ref()
                    .is_none_or(|end| v.cmp_rational(end.hi()) == Ordering::Less)
            };
            if f.is_point {
                within(&value, &f.from)
            } else {
                above(&f.from, &mut value) && below(&mut value)
            }
        })
}

/// Is a number of the family (at a point: possibly this one) in a range of its support?
fn is_in_ranges(truth: &Enumeration, f: &SolutionFamily) -> bool {
    let inside = match &f.to {
        _ if f.is_point => f.from.mid(),
        None => f.from.hi() + whole(1),
        Some(to) => (f.from.hi() + to.lo()) / whole(2),
    };
    let inside = Algebraic::rational(inside);
    let is_end = |e: &End| f.is_point && e.included && within(&e.value, &f.from);
    let has =
        |p: &Piece| p.contains(&inside) || is_end(&p.from) || p.to.as_ref().is_some_and(is_end);
    truth
        .ranges
        .iter()
        .filter(|r| r.support == f.support)
        .any(|r| r.pieces.iter().any(has))
}

fn is_same(t: &Solution, s: &AcceptedClaim) -> bool {
    t.slip == s.support && within(&t.value, &s.value)
}

fn within(value: &Algebraic, interval: &Interval) -> bool {
    let mut value = value.clone();
    value.cmp_rational(interval.lo()) != Ordering::Less
        && value.cmp_rational(interval.hi()) != Ordering::Greater
}

/// Is the solution in an open region: value in its interval, support between its moving set and
/// that with the undecided added?
fn is_open(cover: &AcceptedCover, support: &[usize], value: &Algebraic) -> bool {
    cover.open.iter().any(|r| {
        let mut value = value.clone();
        r.moving.iter().all(|i| support.contains(i))
            && support
                .iter()
                .all(|i| r.moving.contains(i) || r.undecided.contains(i))
            && value.cmp_rational(&r.min) != Ordering::Less
            && r.max
                .as_ref()
                .is_none_or(|max| value.cmp_rational(max) != Ordering::Greater)
    })
}

pub fn proved(problem: &Problem) -> Certificate {
    let options = Options {
        pieces: 6,
        ..Options::default()
    };
    let certificate = complete(problem, &options, &Watch::nobody())
        .unwrap()
        .certificate;
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
        p.unknown() == Unknown::Mu
            && pencil.free().len() >= 2
            && pencil.slip().len() >= 3
            && !truth(p).solutions.is_empty()
    };
    let problem = random_pencils(60, 3)
        .unwrap()
        .into_iter()
        .map(|i| i.problem)
        .find(is_fit)
        .unwrap();
    let certificate = proved(&problem);
    (problem, certificate)
}

/// lambda^2 = 2 and 3 on one support.
pub fn fold(window: Window) -> Problem {
    let pencil = Pencil::new(
        Sparse::from_ints(&[&[1, -6], &[2, -6]]),
        Sparse::identity(2),
        vec![],
    )
    .unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}

pub fn set(certificate: &mut Certificate) -> &mut CompleteSet {
    certificate.complete_set.as_mut().unwrap()
}

pub fn trees(certificate: &Certificate) -> impl Iterator<Item = ((usize, usize), &Node)> {
    let pieces = &certificate.complete_set.as_ref().unwrap().pieces;
    pieces.iter().enumerate().flat_map(|(p, piece)| {
        piece
            .tree
            .iter()
            .enumerate()
            .map(move |(k, node)| ((p, k), node))
    })
}
