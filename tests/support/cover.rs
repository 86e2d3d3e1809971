//! A cover against the exact enumerator: the same set, or open exactly where something is missing;
//! and certificates to forge.
//!
//! The enumerator (`mceip_oracle`) goes through all supports one by one and shares no proof with
//! the cover: a solution that a leaf has lost, a solution listed twice and a family that is none
//! are differences between the two. What differs comes back as sentences, so that a test can assert
//! that there are none and print those that there are.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip_check::certificate::Certificate;
use mceip_check::{AcceptedClaim, AcceptedCover, OpenRegion, SolutionFamily, check};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Algebraic, Interval, Rational, Sparse, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{End, Enumeration, SupportRange, ValueInterval, examine_support, is_between};
use mceip_testkit::{enumerated, is_claimed, random_pencils};
use std::cmp::Ordering;

/// What a cover says that is not so; empty where it is right. Everything the enumerator lists is in
/// the cover's list or in an open region, and the cover lists nothing else.
pub fn disagreements(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = listed_in_vain(cover, truth);
    wrong.extend(solutions_not_listed_once(cover, truth));
    wrong.extend(cones_left_out(cover, truth));
    wrong.extend(ranges_left_out(cover, truth));
    wrong.extend(families_in_vain(cover, truth));

    if is_no_list(truth) && cover.open.is_empty() && cover.families.is_empty() {
        wrong.push("complete, but the answer is no list".into());
    }
    wrong
}

/// Listed solutions that are not one solution of the enumerator.
fn listed_in_vain(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for listed in &cover.solutions {
        let isolated = truth.solutions.iter().filter(|t| is_claimed(t, listed));
        let matches = isolated.count() + usize::from(is_last_of_range(truth, listed));

        if matches != 1 {
            wrong.push(format!(
                "listed: {:?} in {:?}, {matches} of the enumerator's match",
                listed.support, listed.value
            ));
        }
    }
    wrong
}

/// Solutions of the enumerator that are listed twice, or neither listed nor open.
fn solutions_not_listed_once(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for solution in &truth.solutions {
        let matches = cover.solutions.iter().filter(|s| is_claimed(solution, s));
        let listed = matches.count();
        let is_lost = listed == 0 && !is_open(cover, &solution.slip, &solution.value);

        if listed > 1 || is_lost {
            wrong.push(format!(
                "slip {:?} at {} is listed {listed} times and not open",
                solution.slip,
                solution.decimal(12)
            ));
        }
    }
    wrong
}

/// More than one solution at a value has to be a family or open.
fn cones_left_out(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for cone in truth.cones.iter().filter(|cone| cone.dimension > 1) {
        if !is_open_or_in_family(cover, &cone.slip, &cone.value) {
            wrong.push(format!(
                "the cone of slip {:?} is neither open nor a family",
                cone.slip
            ));
        }
    }
    wrong
}

/// A range of values has to be a family or open; an end of it may be listed.
fn ranges_left_out(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for range in &truth.ranges {
        for value in range.pieces.iter().flat_map(probes) {
            let is_told = is_open_or_in_family(cover, &range.support, &value)
                || is_end_listed(cover, truth, range, &value);
            if !is_told {
                wrong.push(format!(
                    "the range of support {:?} is neither open nor a family",
                    range.support
                ));
            }
        }
    }
    wrong
}

/// Families without a cone or a range. Which of a cone's faces have one, `family_disagreements`
/// asks.
fn families_in_vain(cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = Vec::new();
    for family in &cover.families {
        let is_face_of_cone = truth.cones.iter().any(|cone| {
            family.support.iter().all(|i| cone.slip.contains(i)) && is_at_point(family, &cone.value)
        });
        if !is_face_of_cone && !is_in_ranges(truth, family) {
            wrong.push(format!("the family {family:?} is not there"));
        }
    }
    wrong
}

/// Does the answer hold more than single solutions? Ranges that the window cuts to single values
/// are lists within it; `ranges_left_out` asks for each such value.
fn is_no_list(truth: &Enumeration) -> bool {
    let mut ranges = truth.ranges.iter();
    let has_long_range =
        ranges.any(|range| !range.pieces.iter().all(|piece| one_value(piece).is_some()));
    let has_wide_cone = truth.cones.iter().any(|cone| cone.dimension > 1);
    has_long_range || has_wide_cone || !truth.undescribed.is_empty()
}

/// Families against what the oracle finds on their very supports, each support by itself.
pub fn family_disagreements(problem: &Problem, cover: &AcceptedCover) -> Vec<String> {
    let pencil = reduce(problem).unwrap().pencil;
    let slip = pencil.slip();

    let mut wrong = Vec::new();
    for subset in 1u32..1 << slip.len() {
        let chosen = (0..slip.len()).filter(|k| subset >> k & 1 == 1);
        let support: Vec<usize> = chosen.map(|k| slip[k]).collect();

        let mut own = Enumeration::default();
        examine_support(&pencil, &support, problem.window(), &mut own);
        own.describe(&pencil, problem.window());

        wrong.extend(families_missing(cover, &own, &support));
        wrong.extend(families_invented(cover, &own, &support));
    }
    wrong
}

/// Values at which one support has more solutions than the cover lists.
fn families_missing(cover: &AcceptedCover, own: &Enumeration, support: &[usize]) -> Vec<String> {
    let cones = own.cones.iter().filter(|cone| cone.slip == support);
    let mut values: Vec<Algebraic> = cones.map(|cone| cone.value.clone()).collect();
    values.extend(values_in_ranges(own, support));

    let mut wrong = Vec::new();
    for value in values {
        let is_listed = own
            .ranges
            .iter()
            .any(|range| is_end_listed(cover, own, range, &value));
        if !is_open_or_in_family(cover, support, &value) && !is_listed {
            wrong.push(format!(
                "support {support:?}: more solutions than listed, no family"
            ));
        }
    }
    wrong
}

/// Families of one support that are no cone and no range of it.
fn families_invented(cover: &AcceptedCover, own: &Enumeration, support: &[usize]) -> Vec<String> {
    let mut wrong = Vec::new();
    for family in cover.families.iter().filter(|f| f.support == support) {
        let is_cone = own
            .cones
            .iter()
            .any(|cone| cone.slip == support && is_at_point(family, &cone.value));
        if !is_cone && !is_in_ranges(own, family) {
            wrong.push(format!("the family {family:?} is not there"));
        }
    }
    wrong
}

/// Is this the one value that the window leaves of a range? The oracle calls that a range (no
/// window decides what is isolated), the cover, which knows the window only, a single solution.
fn is_last_of_range(truth: &Enumeration, listed: &AcceptedClaim) -> bool {
    let mut pieces = pieces_of(truth, &listed.support);
    pieces.any(|piece| {
        let only = one_value(piece).filter(|_| listed.value.is_point());
        only.is_some_and(|value| within(value, &listed.value))
    })
}

/// The pieces of the ranges of one support.
fn pieces_of<'a>(
    truth: &'a Enumeration,
    support: &'a [usize],
) -> impl Iterator<Item = &'a ValueInterval> + 'a {
    let ranges = truth.ranges.iter();
    ranges
        .filter(move |range| range.support == support)
        .flat_map(|range| &range.pieces)
}

/// The value of a piece that has no other.
fn one_value(piece: &ValueInterval) -> Option<&Algebraic> {
    let (from, to) = (piece.from.as_ref()?, piece.to.as_ref()?);
    let is_one = to.value.clone().equals(&mut from.value.clone());
    is_one.then_some(&from.value)
}

/// Is this value of a range listed, because the window leaves no other?
fn is_end_listed(
    cover: &AcceptedCover,
    truth: &Enumeration,
    range: &SupportRange,
    value: &Algebraic,
) -> bool {
    cover.solutions.iter().any(|listed| {
        listed.support == range.support
            && within(value, &listed.value)
            && is_last_of_range(truth, listed)
    })
}

/// Values of the ranges of one support, as `probes` chooses them.
fn values_in_ranges(truth: &Enumeration, support: &[usize]) -> Vec<Algebraic> {
    pieces_of(truth, support).flat_map(probes).collect()
}

/// The ends of a piece that belong to it, and a number inside.
fn probes(piece: &ValueInterval) -> Vec<Algebraic> {
    let ends = piece.from.iter().chain(&piece.to);
    let included = ends.filter(|end| end.included);
    let mut values: Vec<Algebraic> = included.map(|end| end.value.clone()).collect();

    values.extend(inside(piece).map(Algebraic::rational));
    values
}

/// A rational number strictly between the ends of a piece, if it has more than one value.
fn inside(piece: &ValueInterval) -> Option<Rational> {
    let (mut from, mut to) = match (&piece.from, &piece.to) {
        (None, None) => return Some(whole(0)),
        (Some(from), None) => return Some(from.value.interval().hi() + whole(1)),
        (None, Some(to)) => return Some(to.value.interval().lo() - whole(1)),
        (Some(from), Some(to)) => (from.value.clone(), to.value.clone()),
    };
    if from.clone().cmp_exact(&mut to.clone()) != Ordering::Less {
        return None;
    }

    while from.interval().hi() >= to.interval().lo() {
        from.refine();
        to.refine();
    }

    Some((from.interval().hi() + to.interval().lo()) / whole(2))
}

fn is_open_or_in_family(cover: &AcceptedCover, support: &[usize], value: &Algebraic) -> bool {
    is_open(cover, support, value) || is_in_family(cover, support, value)
}

fn is_in_family(cover: &AcceptedCover, support: &[usize], value: &Algebraic) -> bool {
    let mut families = cover.families.iter().filter(|f| f.support == support);
    families.any(|family| has_value(family, value))
}

/// Is this a value of the family: the enclosed one, or one between the outer ends of the two
/// enclosures?
fn has_value(family: &SolutionFamily, value: &Algebraic) -> bool {
    if family.is_point {
        return is_at_point(family, value);
    }

    let mut value = value.clone();
    let is_above = match &family.from {
        None => true,
        Some(end) => value.cmp_rational(end.lo()) == Ordering::Greater,
    };
    let is_below = match &family.to {
        None => true,
        Some(end) => value.cmp_rational(end.hi()) == Ordering::Less,
    };
    is_above && is_below
}

/// Is a number of the family (at a point: possibly this one) in a range of its support?
fn is_in_ranges(truth: &Enumeration, family: &SolutionFamily) -> bool {
    let number = match (&family.from, &family.to) {
        (Some(value), _) if family.is_point => value.mid(),
        (None, None) => whole(0),
        (Some(from), None) => from.hi() + whole(1),
        (None, Some(to)) => to.lo() - whole(1),
        (Some(from), Some(to)) => (from.hi() + to.lo()) / whole(2),
    };
    let number = Algebraic::rational(number);

    pieces_of(truth, &family.support).any(|piece| {
        piece.contains(&number)
            || piece
                .from
                .iter()
                .chain(&piece.to)
                .any(|end| is_point_at(family, end))
    })
}

/// Is the family a point that encloses this end of a range?
fn is_point_at(family: &SolutionFamily, end: &End) -> bool {
    end.included && is_at_point(family, &end.value)
}

/// Is the family a point that encloses this value?
fn is_at_point(family: &SolutionFamily, value: &Algebraic) -> bool {
    let place = family.from.as_ref().filter(|_| family.is_point);
    place.is_some_and(|place| within(value, place))
}

/// Does the interval hold the value? Its ends belong to it.
pub fn within(value: &Algebraic, interval: &Interval) -> bool {
    is_between(value, interval.lo(), interval.hi())
}

/// Is the solution in an open region: value in its interval, support between its moving set and
/// that with the undecided added?
fn is_open(cover: &AcceptedCover, support: &[usize], value: &Algebraic) -> bool {
    let mut regions = cover.open.iter();
    regions.any(|region| has_support(region, support) && is_on(region, value))
}

fn has_support(region: &OpenRegion, support: &[usize]) -> bool {
    let all_moving = region.moving.iter().all(|i| support.contains(i));
    let mut others = support.iter().filter(|i| !region.moving.contains(i));
    all_moving && others.all(|i| region.undecided.contains(i))
}

fn is_on(region: &OpenRegion, value: &Algebraic) -> bool {
    let mut value = value.clone();
    let is_below = match &region.min {
        None => false,
        Some(min) => value.cmp_rational(min) == Ordering::Less,
    };
    let is_above = match &region.max {
        None => false,
        Some(max) => value.cmp_rational(max) == Ordering::Greater,
    };
    !is_below && !is_above
}

/// The certificate of the complete set, which the checker accepts.
pub fn proved(problem: &Problem) -> Certificate {
    let options = CompleteOptions {
        pieces: 6,
        ..CompleteOptions::default()
    };
    let certificate = complete(problem, &options, &Watch::nobody())
        .unwrap()
        .proved
        .into_certificate();

    assert!(check(problem, &certificate).is_ok());
    certificate
}

/// MCEIP-mu with free variables: a condensation in the certificate.
pub fn condensed() -> (Problem, Certificate) {
    let instances = random_pencils(60, 3).unwrap();
    let mut problems = instances.into_iter().map(|instance| instance.problem);
    let problem = problems.find(is_fit_to_condense).unwrap();

    let certificate = proved(&problem);
    (problem, certificate)
}

fn is_fit_to_condense(problem: &Problem) -> bool {
    let pencil = reduce(problem).unwrap().pencil;
    problem.unknown() == Unknown::Mu
        && pencil.free().len() >= 2
        && pencil.slip().len() >= 3
        && !enumerated(problem).solutions.is_empty()
}

/// lambda^2 = 2 and 3 on one support.
pub fn fold(window: Window) -> Problem {
    let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
    let b = Sparse::identity(2);
    let pencil = Pencil::new(a, b, vec![]).unwrap();

    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}
