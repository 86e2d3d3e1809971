//! Forged support leaves: every obligation of what one support holds, value by value, is refused
//! when broken.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, family_disagreements, proved, set, trees, truth};
use mceip_check::certificate::{
    Alone, Certificate, Exact, Member, Node, Point, Polynomials, Support,
};
use mceip_check::{CoverFault, Reason, Rejected, check};
use mceip_exact::{Integer, Sparse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

fn problem(a: &[&[i64]], b: &[&[i64]]) -> Problem {
    let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), vec![]).unwrap();
    Problem::new(
        Body::Pencil(pencil),
        Unknown::Lambda2,
        Window::new(whole(0), Some(whole(4))).unwrap(),
    )
    .unwrap()
}

/// diag(t - 1, t - 1): at 1 every x >= 0 solves.
fn scalar() -> Problem {
    problem(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]])
}

fn poly(c: &[i64]) -> Vec<Integer> {
    c.iter().map(|&v| v.into()).collect()
}

fn vector(list: &[&[i64]]) -> Polynomials {
    Polynomials(list.iter().map(|c| poly(c)).collect())
}

fn point(c: &[i64], a: i64, b: i64, reason: usize) -> Point {
    Point {
        polynomial: poly(c),
        interval: [Number(whole(a)), Number(whole(b))],
        reason,
    }
}

/// Support {0, 1} of the scalar pencil over [0, 4], by hand: the other supports stay open.
fn by_hand() -> (Problem, Certificate, Support) {
    let problem = scalar();
    let leaf = Support {
        points: vec![
            point(&[0, 1], 0, 0, 0),
            point(&[-1, 1], 1, 1, 1),
            point(&[-4, 1], 4, 4, 0),
        ],
        cells: vec![0, 0],
        reasons: vec![
            Exact::None(vector(&[&[1], &[]])),
            Exact::Some(Box::new(Member {
                x: vector(&[&[1], &[1]]),
                alone: None,
            })),
        ],
    };
    let mut certificate = proved(&problem);
    set(&mut certificate).pieces.truncate(1);
    set(&mut certificate).pieces[0].max = Some(Number(whole(4)));
    set(&mut certificate).pieces[0].tree = vec![
        Node::Branch(0),
        Node::Open,
        Node::Branch(1),
        Node::Open,
        Node::Support(Box::new(leaf.clone())),
    ];
    (problem, certificate, leaf)
}

fn with(certificate: &Certificate, leaf: Support) -> Certificate {
    let mut changed = certificate.clone();
    *set(&mut changed).pieces[0].tree.last_mut().unwrap() = Node::Support(Box::new(leaf));
    changed
}

#[test]
fn a_cone_is_a_family_and_every_forgery_of_it_is_refused() {
    let (problem, certificate, leaf) = by_hand();
    let cover = check(&problem, &certificate).unwrap().cover.unwrap();
    assert_eq!(
        (
            cover.families.len(),
            cover.solutions.len(),
            cover.open.len()
        ),
        (1, 0, 2)
    );
    let f = &cover.families[0];
    assert!(f.support == [0, 1] && f.is_point && !f.is_alone && f.from.contains(&whole(1)));
    assert_eq!(
        disagreements(&cover, &truth(&problem)),
        Vec::<String>::new()
    );

    let no = |forge: &dyn Fn(&mut Support), expected: &dyn Fn(&CoverFault) -> bool| {
        let mut forged = leaf.clone();
        forge(&mut forged);
        match check(&problem, &with(&certificate, forged)) {
            Err(Rejected {
                reason: Reason::Cover { fault, .. },
                ..
            }) if expected(&fault) => {}
            verdict => panic!("{verdict:?}"),
        }
    };
    let place = |n: usize| move |f: &CoverFault| matches!(f, CoverFault::Place { place, .. } if *place == n);
    let points = |f: &CoverFault| matches!(f, CoverFault::Point { .. });
    // The point hidden: the vector is none there. A cell or an end left out, points out of order,
    // not isolated, no root.
    no(&|l| l.points[1].reason = 0, &place(2));
    no(&|l| drop((l.points.remove(1), l.cells.pop())), &place(1));
    no(&|l| _ = l.cells.pop(), &|f| {
        matches!(f, CoverFault::Length { what: "cells", .. })
    });
    no(&|l| drop((l.points.pop(), l.cells.pop())), &points);
    no(&|l| drop((l.points.remove(0), l.cells.pop())), &points);
    no(&|l| l.points.swap(0, 1), &points);
    no(&|l| l.points[1] = point(&[-1, 1], 2, 2, 1), &points);
    no(&|l| l.points[1] = point(&[2, -3, 1], 0, 3, 1), &points);
    no(&|l| l.points[1] = point(&[1], 1, 1, 1), &points);
    // At 2 there is no solution: points are judged before cells.
    no(&|l| l.points[1] = point(&[-2, 1], 2, 2, 1), &place(2));
    no(&|l| l.points[1].reason = 2, &|f| {
        matches!(
            f,
            CoverFault::NoReason {
                reason: 2,
                reasons: 2
            }
        )
    });
    no(&|l| l.cells[1] = 1, &place(3));
    // A vector that is zero, changes its sign, is of the wrong length.
    no(
        &|l| l.reasons[0] = Exact::None(vector(&[&[], &[]])),
        &place(0),
    );
    no(
        &|l| l.reasons[0] = Exact::None(vector(&[&[1], &[-1]])),
        &place(0),
    );
    no(
        &|l| l.reasons[0] = Exact::None(vector(&[&[-2, 1], &[]])),
        &place(3),
    );
    no(&|l| l.reasons[0] = Exact::None(vector(&[&[1]])), &|f| {
        matches!(f, CoverFault::Length { what: "none", .. })
    });
    // x not positive, or not a solution; a cone said to be one ray.
    let member = |x: &[&[i64]], alone: Option<Alone>| {
        Exact::Some(Box::new(Member {
            x: vector(x),
            alone,
        }))
    };
    no(&|l| l.reasons[1] = member(&[&[1], &[]], None), &place(2));
    no(&|l| l.reasons[1] = member(&[&[1], &[-1]], None), &place(2));
    for rows in [
        vec![],
        vec![(1, vector(&[&[1], &[1]]))],
        vec![(0, vector(&[&[1], &[]]))],
        vec![(2, vector(&[&[1], &[]]))],
    ] {
        no(
            &|l| {
                l.reasons[1] = member(
                    &[&[1], &[1]],
                    Some(Alone {
                        pivot: 0,
                        rows: rows.clone(),
                    }),
                )
            },
            &place(2),
        );
    }
    let outside = Alone {
        pivot: 2,
        rows: vec![],
    };
    no(
        &|l| l.reasons[1] = member(&[&[1], &[1]], Some(outside.clone())),
        &|f| matches!(f, CoverFault::Pivot { index: 2 }),
    );
    // Before the indices are decided, and numbers that are too large.
    let early = |f: &CoverFault| matches!(f, CoverFault::SupportTooEarly);
    no(
        &|l| {
            *l = Support {
                points: vec![],
                cells: vec![],
                reasons: vec![],
            }
        },
        &early,
    );
    let mut undecided = certificate.clone();
    set(&mut undecided).pieces[0].tree = vec![Node::Support(Box::new(leaf.clone()))];
    assert!(
        matches!(check(&problem, &undecided), Err(Rejected { reason: Reason::Cover { fault, .. }, .. }) if early(&fault))
    );
    no(
        &|l| l.points[1].polynomial = vec![Integer::from(0); 1000],
        &|f| matches!(f, CoverFault::TooLarge { .. }),
    );
}

#[test]
fn a_weight_that_must_not_be_negative_is_refused() {
    // y_1 = x_0 >= 0 and y_0 = 0 x_0: support {0} solves everywhere; w = (0, -1) would "refute" it.
    let problem = problem(&[&[0, 0], &[1, 1]], &[&[0, 0], &[0, 0]]);
    let certificate = proved(&problem);
    let cover = check(&problem, &certificate).unwrap().cover.unwrap();
    assert!(
        cover.open.is_empty()
            && cover
                .families
                .iter()
                .all(|f| f.is_alone && f.support == [0]),
        "{cover:?}"
    );
    assert_eq!(family_disagreements(&problem, &cover), Vec::<String>::new());
    let mut met = 0;
    for ((p, k), node) in trees(&certificate) {
        let Node::Support(leaf) = node else { continue };
        let mut forged = certificate.clone();
        let none = Support {
            reasons: vec![Exact::None(vector(&[&[], &[-1]])); leaf.reasons.len()],
            ..(**leaf).clone()
        };
        set(&mut forged).pieces[p].tree[k] = Node::Support(Box::new(none));
        let Err(Rejected {
            reason:
                Reason::Cover {
                    fault: CoverFault::Place { place: 0, .. },
                    ..
                },
            ..
        }) = check(&problem, &forged)
        else {
            panic!("a false weight is accepted");
        };
        met += 1;
    }
    assert!(met > 0);
}

/// (t^2 - 2)^2 on one variable: an irrational double root, single and alone; its neighbourhood
/// cannot be passed over.
#[test]
fn an_irrational_double_root_is_isolated() {
    let m: [&[i64]; 4] = [
        &[0, -2, 1, 0],
        &[-1, 0, 0, 1],
        &[0, 0, 0, -2],
        &[0, 0, -1, 0],
    ];
    let b: [&[i64]; 4] = [&[1, 0, 0, 0], &[0, 1, 0, 0], &[0, 0, 1, 0], &[0, 0, 0, 1]];
    let problem = problem(&m, &b);
    let cover = check(&problem, &proved(&problem)).unwrap().cover.unwrap();
    assert!(cover.open.is_empty());
    let wrong = [
        disagreements(&cover, &truth(&problem)),
        family_disagreements(&problem, &cover),
    ]
    .concat();
    assert_eq!(wrong, Vec::<String>::new());
    assert!(
        cover
            .solutions
            .iter()
            .any(|s| s.value.contains(&rational(3, 2)) || s.value.lo() > &rational(7, 5)),
        "{cover:?}"
    );
}
