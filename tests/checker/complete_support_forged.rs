//! Forged support leaves: every obligation of what one support holds, value by value, is refused
//! when broken.
//!
//! The leaf is made by hand for a pencil whose solutions are seen at once; a forgery changes it in
//! one place, and the fault has to name that place. What `complete` writes for a range of values
//! and for an irrational double root is compared with the exact enumerator.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, family_disagreements, node_at, proved, set, trees, truth};
use mceip_check::certificate::{
    Alone, Certificate, Exact, Member, Node, Point, Polynomials, Support,
};
use mceip_check::{CoverFault, Reason, Rejected, check};
use mceip_exact::{Integer, Sparse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

/// The eigenproblem of A + t B without free variables, on [0, 4].
fn problem(a: &[&[i64]], b: &[&[i64]]) -> Problem {
    let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), vec![]).unwrap();
    let window = Window::new(whole(0), Some(whole(4))).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}

/// diag(t - 1, t - 1): at 1 every x >= 0 solves.
fn scalar() -> Problem {
    problem(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]])
}

/// The integer polynomial with these coefficients, the constant one first.
fn poly(coefficients: &[i64]) -> Vec<Integer> {
    coefficients.iter().map(|&c| c.into()).collect()
}

fn vector(components: &[&[i64]]) -> Polynomials {
    Polynomials(components.iter().map(|c| poly(c)).collect())
}

/// The root of a polynomial in [a, b], and the number of its reason.
fn point(coefficients: &[i64], a: i64, b: i64, reason: usize) -> Point {
    Point {
        polynomial: poly(coefficients),
        interval: [a, b].map(|end| Number(whole(end))),
        reason,
    }
}

/// No solution, because w'T < 0.
fn none(weights: &[&[i64]]) -> Exact {
    Exact::None(vector(weights))
}

/// x solves, perhaps among others.
fn member(x: &[&[i64]]) -> Exact {
    let member = Member {
        x: vector(x),
        alone: None,
    };
    Exact::Some(Box::new(member))
}

/// (1, 1) is the only ray of solutions.
fn only_one_one(pivot: usize, rows: Vec<(usize, Polynomials)>) -> Exact {
    let member = Member {
        x: vector(&[&[1], &[1]]),
        alone: Some(Alone { pivot, rows }),
    };
    Exact::Some(Box::new(member))
}

/// Support {0, 1} of the scalar pencil over [0, 4].
fn leaf() -> Support {
    Support {
        points: vec![
            point(&[0, 1], 0, 0, 0),
            point(&[-1, 1], 1, 1, 1),
            point(&[-4, 1], 4, 4, 0),
        ],
        cells: vec![0, 0],
        reasons: vec![none(&[&[1], &[]]), member(&[&[1], &[1]])],
    }
}

/// A certificate of the scalar pencil whose only piece has this tree.
fn certificate(tree: Vec<Node>) -> Certificate {
    let mut certificate = proved(&scalar());
    let pieces = &mut set(&mut certificate).pieces;
    pieces.truncate(1);
    pieces[0].max = Some(Number(whole(4)));
    pieces[0].tree = tree;
    certificate
}

/// The leaf of {0, 1}, by hand: the other supports stay open.
fn with_leaf(leaf: Support) -> Certificate {
    certificate(vec![
        Node::Branch(0),
        Node::Open,
        Node::Branch(1),
        Node::Open,
        Node::Support(Box::new(leaf)),
    ])
}

/// A change of the leaf, and the fault for which it has to be refused.
struct Forgery {
    what: &'static str,
    change: fn(&mut Support),
    expected: fn(&CoverFault) -> bool,
}

fn is_point(fault: &CoverFault) -> bool {
    matches!(fault, CoverFault::Point { .. })
}

/// The third of two reasons.
fn is_no_reason(fault: &CoverFault) -> bool {
    let expected = CoverFault::NoReason {
        reason: 2,
        reasons: 2,
    };
    *fault == expected
}

fn is_place_0(fault: &CoverFault) -> bool {
    matches!(fault, CoverFault::Place { place: 0, .. })
}

fn is_place_1(fault: &CoverFault) -> bool {
    matches!(fault, CoverFault::Place { place: 1, .. })
}

fn is_place_2(fault: &CoverFault) -> bool {
    matches!(fault, CoverFault::Place { place: 2, .. })
}

fn is_place_3(fault: &CoverFault) -> bool {
    matches!(fault, CoverFault::Place { place: 3, .. })
}

/// The points 0, 1 and 4, the cells between them, and the numbers of their reasons. The places of a
/// leaf are counted from 0: point, cell, point, cell, point.
const POINTS_AND_CELLS: [Forgery; 12] = [
    Forgery {
        what: "the point hidden: the vector is none there",
        change: |leaf| leaf.points[1].reason = 0,
        expected: is_place_2,
    },
    Forgery {
        what: "the point left out",
        change: |leaf| {
            leaf.points.remove(1);
            leaf.cells.pop();
        },
        expected: is_place_1,
    },
    Forgery {
        what: "a cell left out",
        change: |leaf| {
            leaf.cells.pop();
        },
        expected: |fault| matches!(fault, CoverFault::Length { what: "cells", .. }),
    },
    Forgery {
        what: "the upper end left out",
        change: |leaf| {
            leaf.points.pop();
            leaf.cells.pop();
        },
        expected: is_point,
    },
    Forgery {
        what: "the lower end left out",
        change: |leaf| {
            leaf.points.remove(0);
            leaf.cells.pop();
        },
        expected: is_point,
    },
    Forgery {
        what: "points out of order",
        change: |leaf| leaf.points.swap(0, 1),
        expected: is_point,
    },
    Forgery {
        what: "no root at the point",
        change: |leaf| leaf.points[1] = point(&[-1, 1], 2, 2, 1),
        expected: is_point,
    },
    Forgery {
        what: "two roots in the interval",
        change: |leaf| leaf.points[1] = point(&[2, -3, 1], 0, 3, 1),
        expected: is_point,
    },
    Forgery {
        what: "a polynomial without a root",
        change: |leaf| leaf.points[1] = point(&[1], 1, 1, 1),
        expected: is_point,
    },
    Forgery {
        what: "no solution at 2: points are judged before cells",
        change: |leaf| leaf.points[1] = point(&[-2, 1], 2, 2, 1),
        expected: is_place_2,
    },
    Forgery {
        what: "a reason that does not exist",
        change: |leaf| leaf.points[1].reason = 2,
        expected: is_no_reason,
    },
    Forgery {
        what: "a solution throughout a cell",
        change: |leaf| leaf.cells[1] = 1,
        expected: is_place_3,
    },
];

/// Reason 0: the weights of the cells.
const WEIGHTS: [Forgery; 4] = [
    Forgery {
        what: "zero weights",
        change: |leaf| leaf.reasons[0] = none(&[&[], &[]]),
        expected: is_place_0,
    },
    Forgery {
        what: "both signs",
        change: |leaf| leaf.reasons[0] = none(&[&[1], &[-1]]),
        expected: is_place_0,
    },
    Forgery {
        what: "a sign that changes within a cell",
        change: |leaf| leaf.reasons[0] = none(&[&[-2, 1], &[]]),
        expected: is_place_3,
    },
    Forgery {
        what: "a weight missing",
        change: |leaf| leaf.reasons[0] = none(&[&[1]]),
        expected: |fault| matches!(fault, CoverFault::Length { what: "none", .. }),
    },
];

/// Reason 1: x is not positive, or a cone is said to be one ray.
const MEMBERS: [Forgery; 7] = [
    Forgery {
        what: "x_1 = 0",
        change: |leaf| leaf.reasons[1] = member(&[&[1], &[]]),
        expected: is_place_2,
    },
    Forgery {
        what: "x_1 < 0",
        change: |leaf| leaf.reasons[1] = member(&[&[1], &[-1]]),
        expected: is_place_2,
    },
    Forgery {
        what: "one ray, without a row",
        change: |leaf| leaf.reasons[1] = only_one_one(0, vec![]),
        expected: is_place_2,
    },
    Forgery {
        what: "one ray, by a row that says nothing at 1",
        change: |leaf| leaf.reasons[1] = only_one_one(0, vec![(1, vector(&[&[1], &[1]]))]),
        expected: is_place_2,
    },
    Forgery {
        what: "one ray, by a row for the pivot",
        change: |leaf| leaf.reasons[1] = only_one_one(0, vec![(0, vector(&[&[1], &[]]))]),
        expected: is_place_2,
    },
    Forgery {
        what: "one ray, by a row for no variable",
        change: |leaf| leaf.reasons[1] = only_one_one(0, vec![(2, vector(&[&[1], &[]]))]),
        expected: is_place_2,
    },
    Forgery {
        what: "a pivot that is no variable",
        change: |leaf| leaf.reasons[1] = only_one_one(2, vec![]),
        expected: |fault| matches!(fault, CoverFault::Pivot { index: 2 }),
    },
];

/// The leaf as a whole.
const FRAMES: [Forgery; 2] = [
    Forgery {
        what: "a leaf that says nothing",
        change: |leaf| {
            leaf.points.clear();
            leaf.cells.clear();
            leaf.reasons.clear();
        },
        expected: |fault| matches!(fault, CoverFault::SupportTooEarly),
    },
    Forgery {
        what: "1,000 coefficients",
        change: |leaf| leaf.points[1].polynomial = vec![Integer::from(0); 1000],
        expected: |fault| matches!(fault, CoverFault::TooLarge { .. }),
    },
];

#[track_caller]
fn fault_of(problem: &Problem, forged: &Certificate) -> CoverFault {
    match check(problem, forged) {
        Err(Rejected {
            reason: Reason::Cover { fault, .. },
            ..
        }) => fault,
        verdict => panic!("{verdict:?}"),
    }
}

#[test]
fn a_cone_is_a_family_and_every_forgery_of_it_is_refused() {
    let problem = scalar();
    let cover = check(&problem, &with_leaf(leaf())).unwrap().cover.unwrap();
    assert_eq!(cover.families.len(), 1);
    assert_eq!(cover.solutions, []);
    assert_eq!(cover.open.len(), 2);

    let family = &cover.families[0];
    assert_eq!(family.support, [0, 1]);
    assert!(family.is_point && !family.is_alone, "{family:?}");
    assert!(family.from.contains(&whole(1)), "{family:?}");
    let wrong = disagreements(&cover, &truth(&problem));
    assert_eq!(wrong, Vec::<String>::new());

    let in_place = POINTS_AND_CELLS.iter().chain(&WEIGHTS);
    for forgery in in_place.chain(&MEMBERS).chain(&FRAMES) {
        let mut forged = leaf();
        (forgery.change)(&mut forged);
        let fault = fault_of(&problem, &with_leaf(forged));
        assert!((forgery.expected)(&fault), "{}: {fault:?}", forgery.what);
    }

    // Before the indices are decided.
    let undecided = certificate(vec![Node::Support(Box::new(leaf()))]);
    let fault = fault_of(&problem, &undecided);
    assert!(matches!(fault, CoverFault::SupportTooEarly), "{fault:?}");
}

/// y_1 = x_0 >= 0 and y_0 = 0 x_0: support {0} solves everywhere; w = (0, -1) would "refute" it.
#[test]
fn a_weight_that_must_not_be_negative_is_refused() {
    let problem = problem(&[&[0, 0], &[1, 1]], &[&[0, 0], &[0, 0]]);
    let certificate = proved(&problem);

    let cover = check(&problem, &certificate).unwrap().cover.unwrap();
    let mut families = cover.families.iter();
    assert!(cover.open.is_empty(), "{cover:?}");
    assert!(
        families.all(|family| family.is_alone && family.support == [0]),
        "{cover:?}"
    );
    assert_eq!(family_disagreements(&problem, &cover), Vec::<String>::new());

    let mut forgeries = 0;
    for (place, node) in trees(&certificate) {
        let Node::Support(leaf) = node else { continue };
        let negative_weight = Support {
            reasons: vec![none(&[&[], &[-1]]); leaf.reasons.len()],
            ..(**leaf).clone()
        };

        let mut forged = certificate.clone();
        *node_at(&mut forged, place) = Node::Support(Box::new(negative_weight));
        let fault = fault_of(&problem, &forged);
        assert!(is_place_0(&fault), "{fault:?}");
        forgeries += 1;
    }

    assert!(forgeries > 0);
}

/// (t^2 - 2)^2 on one variable: an irrational double root, single and alone; its neighbourhood
/// cannot be passed over.
#[test]
fn an_irrational_double_root_is_isolated() {
    let a: [&[i64]; 4] = [
        &[0, -2, 1, 0],
        &[-1, 0, 0, 1],
        &[0, 0, 0, -2],
        &[0, 0, -1, 0],
    ];
    let b: [&[i64]; 4] = [&[1, 0, 0, 0], &[0, 1, 0, 0], &[0, 0, 1, 0], &[0, 0, 0, 1]];
    let problem = problem(&a, &b);

    let cover = check(&problem, &proved(&problem)).unwrap().cover.unwrap();
    assert!(cover.open.is_empty());
    let mut wrong = disagreements(&cover, &truth(&problem));
    wrong.extend(family_disagreements(&problem, &cover));
    assert_eq!(wrong, Vec::<String>::new());

    let mut values = cover.solutions.iter().map(|solution| &solution.value);
    let is_near_root_two =
        values.any(|value| value.contains(&rational(3, 2)) || value.lo() > &rational(7, 5));
    assert!(is_near_root_two, "{cover:?}");
}
