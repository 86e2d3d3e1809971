//! Support leaves: degenerate supports value by value, and a forgery of each fault they have of
//! their own.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Alone, Certificate, Exact, Member, Node, Point, Polynomials, Support,
};
use mceip_exact::{Sparse, whole};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};

fn problem(a: &[&[i64]]) -> Problem {
    let pencil = Pencil::new(Sparse::from_ints(a), Sparse::identity(2), vec![]).unwrap();
    Problem::new(
        Body::Pencil(pencil),
        Unknown::Lambda2,
        Window::new(whole(0), Some(whole(4))).unwrap(),
    )
    .unwrap()
}

fn vector(list: &[&[i64]]) -> Polynomials {
    Polynomials(
        list.iter()
            .map(|c| c.iter().map(|&v| v.into()).collect())
            .collect(),
    )
}

fn point(at: i64, reason: usize) -> Point {
    let number = || q(&at.to_string());
    Point {
        polynomial: vec![(-at).into(), 1.into()],
        interval: [number(), number()],
        reason,
    }
}

/// Support {0, 1} of diag(t - 1, t - 1) over [0, 4]: at 1 every x > 0, nothing elsewhere.
fn cone() -> Support {
    let x = Member {
        x: vector(&[&[1], &[1]]),
        alone: None,
    };
    let reasons = vec![Exact::None(vector(&[&[1], &[]])), Exact::Some(Box::new(x))];
    Support {
        points: vec![point(0, 0), point(1, 1), point(4, 0)],
        cells: vec![0, 0],
        reasons,
    }
}

pub fn supports(cases: &mut Cases) {
    let p = problem(&[&[-1, 0], &[0, -1]]);
    cases.accept(
        "support-cone",
        "a wide kernel at 1, as `complete` writes it: a family beside the list",
        &p,
        &completed(&p),
    );
    let double = problem(&[&[-1, 1], &[0, -1]]);
    cases.accept(
        "support-double-root",
        "a double root, as `complete` writes it",
        &double,
        &completed(&double),
    );

    let around = |leaf: Support| {
        vec![
            Node::Branch(0),
            Node::Open,
            Node::Branch(1),
            Node::Open,
            Node::Support(Box::new(leaf)),
        ]
    };
    let with = |change: &dyn Fn(&mut Support)| -> Certificate {
        let mut leaf = cone();
        change(&mut leaf);
        cover(&p, around(leaf))
    };
    let mut no = |name: &str, reason: &str, note: &str, c: &Certificate| {
        cases.reject(&format!("support-{name}"), reason, note, &p, c)
    };
    let early = cover(&p, vec![Node::Support(Box::new(cone()))]);
    no(
        "early",
        "Cover.SupportTooEarly",
        "a support leaf before the indices are decided",
        &early,
    );
    no(
        "points-swapped",
        "Cover.Point",
        "points out of order",
        &with(&|l| l.points.swap(0, 1)),
    );
    no(
        "end-missing",
        "Cover.Point",
        "the upper end is no point",
        &with(&|l| drop((l.points.pop(), l.cells.pop()))),
    );
    let no_root = |l: &mut Support| l.points[1].polynomial = vec![(-2).into(), 1.into()];
    no(
        "no-root",
        "Cover.Point",
        "the polynomial does not vanish at its point",
        &with(&no_root),
    );
    no(
        "cell-missing",
        "Cover.Length",
        "a cell without a reason",
        &with(&|l| _ = l.cells.pop()),
    );
    no(
        "reason-missing",
        "Cover.NoReason",
        "a reason that is not there",
        &with(&|l| l.points[1].reason = 2),
    );
    no(
        "point-hidden",
        "Cover.Place",
        "the point with the cone said to hold nothing",
        &with(&|l| l.points[1].reason = 0),
    );
    let hidden = |l: &mut Support| drop((l.points.remove(1), l.cells.pop()));
    no(
        "root-in-cell",
        "Cover.Place",
        "a cell that hides the root",
        &with(&hidden),
    );
    let member = |x: &[&[i64]], alone: Option<Alone>| {
        Exact::Some(Box::new(Member {
            x: vector(x),
            alone,
        }))
    };
    no(
        "x-zero",
        "Cover.Place",
        "x_1 = 0 on the support",
        &with(&|l| l.reasons[1] = member(&[&[1], &[]], None)),
    );
    no(
        "x-negative",
        "Cover.Place",
        "x_1 < 0",
        &with(&|l| l.reasons[1] = member(&[&[1], &[-1]], None)),
    );
    let alone = |pivot| {
        Some(Alone {
            pivot,
            rows: vec![],
        })
    };
    no(
        "cone-called-ray",
        "Cover.Place",
        "a cone said to be one ray",
        &with(&|l| l.reasons[1] = member(&[&[1], &[1]], alone(0))),
    );
    no(
        "pivot",
        "Cover.Pivot",
        "a pivot that does not move",
        &with(&|l| l.reasons[1] = member(&[&[1], &[1]], alone(2))),
    );
}
