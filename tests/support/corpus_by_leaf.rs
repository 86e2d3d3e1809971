//! Support leaves by hand: what each kind of reason is accepted for, and a forgery of each
//! obligation.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Alone, Certificate, Exact, Member, Node, Point, Polynomials, Support,
};
use mceip_exact::Integer;
use mceip_model::Problem;
use mceip_model::file::write_problem;
use serde_json::json;

fn poly(c: &[i64]) -> Vec<Integer> {
    c.iter().map(|&v| v.into()).collect()
}

fn vector(list: &[&[i64]]) -> Polynomials {
    Polynomials(list.iter().map(|c| poly(c)).collect())
}

fn none(w: &[&[i64]]) -> Exact {
    Exact::None(vector(w))
}

fn member(x: &[&[i64]], alone: Option<(usize, Vec<(usize, Polynomials)>)>) -> Exact {
    Exact::Some(Box::new(Member {
        x: vector(x),
        alone: alone.map(|(pivot, rows)| Alone { pivot, rows }),
    }))
}

fn point(c: &[i64], a: &str, b: &str, reason: usize) -> Point {
    Point {
        polynomial: poly(c),
        interval: [q(a), q(b)],
        reason,
    }
}

/// The point with an integer value.
fn at(t: i64, reason: usize) -> Point {
    point(&[-t, 1], &t.to_string(), &t.to_string(), reason)
}

fn node(points: Vec<Point>, cells: Vec<usize>, reasons: Vec<Exact>) -> Node {
    Node::Support(Box::new(Support {
        points,
        cells,
        reasons,
    }))
}

/// One reason over all of [0, 4].
fn whole_of(reason: Exact) -> Node {
    node(vec![at(0, 0), at(4, 0)], vec![0], vec![reason])
}

fn nothing_moves() -> Node {
    node(vec![], vec![], vec![])
}

/// Leaves of the four supports of two variables: {}, {1}, {0}, {0, 1}.
fn four(one: Node, zero: Node, both: Node) -> Vec<Node> {
    vec![
        Node::Branch(0),
        Node::Branch(1),
        nothing_moves(),
        one,
        Node::Branch(1),
        zero,
        both,
    ]
}

fn to_four(a: &[&[&str]], b: &[&[&str]]) -> Problem {
    window(pencil(a, b, &[]), "0", Some("4"))
}

/// An accepted certificate, the support leaf at `node` of which is forged.
struct Good {
    problem: Problem,
    certificate: Certificate,
    node: usize,
}

impl Good {
    fn new(problem: Problem, tree: Vec<Node>, node: usize) -> Self {
        Good {
            certificate: cover(&problem, tree),
            problem,
            node,
        }
    }

    fn no(
        &self,
        cases: &mut Cases,
        name: &str,
        fault: &str,
        note: &str,
        forge: impl FnOnce(&mut Support),
    ) {
        let mut c = self.certificate.clone();
        match &mut c.complete_set.as_mut().unwrap().pieces[0].tree[self.node] {
            Node::Support(leaf) => forge(leaf),
            other => unreachable!("{other:?}"),
        }
        cases.reject(
            &format!("one-support-{name}"),
            &format!("Cover.{fault}"),
            note,
            &self.problem,
            &c,
        );
    }
}

pub fn supports(cases: &mut Cases) {
    let good = cone(cases);
    points_and_cells(cases, &good);
    weights(cases, &good);
    ray(cases);
    range(cases);
    irrational(cases);
    inequalities(cases);
    free_variable(cases);
    shapes(cases, &good);
}

/// diag(t - 1, t - 1): at 1 every x >= 0 solves.
fn cone(cases: &mut Cases) -> Good {
    let p = to_four(&[&["-1", "0"], &["0", "-1"]], I2);
    let leaf = |w: &[&[i64]], x: &[&[i64]], alone| {
        node(
            vec![at(0, 0), at(1, 1), at(4, 0)],
            vec![0, 0],
            vec![none(w), member(x, alone)],
        )
    };
    let one = leaf(&[&[], &[1]], &[&[], &[1]], Some((1, vec![])));
    let zero = leaf(&[&[1], &[]], &[&[1], &[]], Some((0, vec![])));
    let both = leaf(&[&[1], &[]], &[&[1], &[1]], None);
    let good = Good::new(p, four(one, zero, both), 6);
    cases.accept(
        "one-support-cone",
        "a cone at a value between two empty cells is a family; its edges are solutions",
        &good.problem,
        &good.certificate,
    );
    let early = cover(
        &good.problem,
        vec![good.certificate.complete_set.as_ref().unwrap().pieces[0].tree[6].clone()],
    );
    cases.reject(
        "one-support-undecided",
        "Cover.SupportTooEarly",
        "one support stands for all",
        &good.problem,
        &early,
    );
    good.no(
        cases,
        "nothing-said",
        "SupportTooEarly",
        "a leaf without a point where something moves",
        |l| {
            *l = Support {
                points: vec![],
                cells: vec![],
                reasons: vec![],
            };
        },
    );
    good
}

fn points_and_cells(cases: &mut Cases, good: &Good) {
    let mut no = |name: &str, fault: &str, note: &str, forge: &dyn Fn(&mut Support)| {
        good.no(cases, name, fault, note, forge)
    };
    no(
        "point-not-a-root",
        "Point",
        "p is not zero at a point said to be exact",
        &|l| l.points[1] = point(&[-1, 1], "2", "2", 1),
    );
    no(
        "point-two-roots",
        "Point",
        "p has both 1 and 2 in the interval",
        &|l| l.points[1] = point(&[2, -3, 1], "1/2", "3", 1),
    );
    no(
        "point-no-sign-change",
        "Point",
        "p has no root in the interval",
        &|l| l.points[1] = point(&[-1, 1], "2", "3", 1),
    );
    no(
        "point-constant",
        "Point",
        "a polynomial without a root",
        &|l| l.points[1] = point(&[1], "1", "1", 1),
    );
    no(
        "point-zero",
        "Point",
        "the zero polynomial vanishes everywhere",
        &|l| l.points[1] = point(&[0, 0], "1", "1", 1),
    );
    no("point-reversed", "Point", "an interval with b < a", &|l| {
        l.points[1] = point(&[-1, 1], "2", "1/2", 1)
    });
    no("points-out-of-order", "Point", "points that fall", &|l| {
        l.points.swap(0, 1)
    });
    no(
        "points-touch",
        "Point",
        "two intervals that share an end: which comes first?",
        &|l| l.points[1] = point(&[-1, 1], "0", "2", 1),
    );
    no(
        "first-end",
        "Point",
        "the leaf begins above the region's lower end",
        &|l| drop((l.points.remove(0), l.cells.pop())),
    );
    no(
        "last-end",
        "Point",
        "the leaf ends below the region's upper end",
        &|l| drop((l.points.pop(), l.cells.pop())),
    );
    no(
        "end-not-exact",
        "Point",
        "the last point only encloses the upper end",
        &|l| l.points[2] = point(&[-4, 1], "3", "5", 0),
    );
    no("cell-missing", "Length", "a cell without a reason", &|l| {
        l.cells.truncate(1)
    });
    no(
        "cell-too-many",
        "Length",
        "a cell above the last point of a finite interval",
        &|l| l.cells.push(0),
    );
    no(
        "reason-missing-point",
        "NoReason",
        "a point's reason does not exist",
        &|l| l.points[1].reason = 2,
    );
    no(
        "reason-missing-cell",
        "NoReason",
        "a cell's reason does not exist",
        &|l| l.cells[1] = 2,
    );
    no(
        "point-hidden",
        "Place",
        "the vector of the cells is no vector at their common end",
        &|l| l.points[1].reason = 0,
    );
    no(
        "point-left-out",
        "Place",
        "signs at the ends of a cell or in its middle, not in between",
        &|l| drop((l.points.remove(1), l.cells.pop())),
    );
    no("point-beside", "Place", "the root lies in a cell", &|l| {
        l.points[1] = at(2, 0)
    });
    no(
        "cell-solution",
        "Place",
        "a solution at the cell's end is none in the cell",
        &|l| l.cells[1] = 1,
    );
    no("degree", "TooLarge", "257 coefficients", &|l| {
        l.points[1].polynomial.resize(257, Integer::from(0))
    });
    no(
        "size",
        "TooLarge",
        "3,000 coefficients beside one of 3,000 bits",
        &|l| {
            l.points[1].polynomial = vec![
                Integer::from(-1) << 3000usize,
                Integer::from(1) << 3000usize,
            ];
            l.reasons.extend(vec![none(&[&[1; 256], &[1; 256]]); 6]);
        },
    );
}

fn weights(cases: &mut Cases, good: &Good) {
    let mut no = |name: &str, fault: &str, note: &str, w: &[&[i64]]| {
        good.no(cases, name, fault, note, |l| l.reasons[0] = none(w))
    };
    no("weights-zero", "Place", "w = 0 proves nothing", &[&[], &[]]);
    no(
        "weights-both-signs",
        "Place",
        "w'T < 0 on one moving column and > 0 on the other",
        &[&[1], &[-1]],
    );
    no(
        "weights-turn",
        "Place",
        "w'T changes its sign within a cell",
        &[&[-2, 1], &[]],
    );
    no("weights-short", "Length", "a weight missing", &[&[1]]);
    let mut no = |name: &str, fault: &str, note: &str, reason: Exact| {
        good.no(cases, name, fault, note, |l| l.reasons[1] = reason)
    };
    no(
        "x-zero",
        "Place",
        "x_1 = 0 on a support that holds 1",
        member(&[&[1], &[]], None),
    );
    no(
        "x-negative",
        "Place",
        "x_1 < 0",
        member(&[&[1], &[-1]], None),
    );
    no(
        "x-short",
        "Length",
        "a component missing",
        member(&[&[1]], None),
    );
    no(
        "alone-but-cone",
        "Place",
        "a cone said to be one ray",
        member(&[&[1], &[1]], Some((0, vec![]))),
    );
    no(
        "alone-empty-row",
        "Place",
        "a row that says nothing",
        member(&[&[1], &[1]], Some((0, vec![(1, vector(&[&[1], &[]]))]))),
    );
}

/// y_0 = 0, y_1 = x_1 - x_0: support {0, 1} is the ray (1, 1) at every value, support {0} has y_1 <
/// 0.
fn ray(cases: &mut Cases) {
    let p = to_four(&[&["0", "0"], &["-1", "1"]], ZERO2);
    let one = || whole_of(none(&[&[], &[1]]));
    let both = whole_of(member(
        &[&[1], &[1]],
        Some((0, vec![(1, vector(&[&[], &[1]]))])),
    ));
    let tree = four(one(), one(), both);
    let good = Good::new(p.clone(), tree.clone(), 6);
    cases.accept(
        "one-support-ray",
        "one ray at every value of an interval: a family; weights on a resting row",
        &p,
        &good.certificate,
    );
    let mut no =
        |name: &str, fault: &str, note: &str, pivot: usize, rows: Vec<(usize, Polynomials)>| {
            good.no(cases, name, fault, note, |l| {
                l.reasons[0] = member(&[&[1], &[1]], Some((pivot, rows)))
            });
        };
    no(
        "alone-pivot",
        "Pivot",
        "a pivot that is no variable",
        2,
        vec![],
    );
    no(
        "alone-own-pivot",
        "Place",
        "a row for the pivot itself",
        0,
        vec![(0, vector(&[&[], &[1]]))],
    );
    no("alone-no-row", "Place", "x_1 is not determined", 0, vec![]);
    no(
        "alone-short",
        "Length",
        "a weight missing",
        0,
        vec![(1, vector(&[&[]]))],
    );
    let good = Good::new(p, tree, 5);
    let mut no = |name: &str, note: &str, reason: Exact| {
        good.no(cases, name, "Place", note, |l| l.reasons[0] = reason)
    };
    no(
        "y-negative",
        "y_1 < 0 on a resting row",
        member(&[&[1], &[]], None),
    );
    no(
        "x-off-support",
        "x_1 > 0 off the support",
        member(&[&[1], &[1]], None),
    );
}

/// y_0 = 0, y_1 = x_0 + x_1: support {0} solves at every value, to infinity.
fn range(cases: &mut Cases) {
    let p = pencil(&[&["0", "0"], &["1", "1"]], ZERO2, &[]);
    let to_infinity = |reason: Exact| node(vec![at(0, 0)], vec![0], vec![reason]);
    let pushed = || to_infinity(none(&[&[], &[1]]));
    let zero = to_infinity(member(&[&[1], &[]], Some((0, vec![]))));
    let good = Good::new(p, four(pushed(), zero, pushed()), 5);
    cases.accept(
        "one-support-range",
        "a solution at every value up to infinity: a family",
        &good.problem,
        &good.certificate,
    );
    let mut no = |name: &str, fault: &str, note: &str, forge: &dyn Fn(&mut Support)| {
        good.no(cases, name, fault, note, forge)
    };
    no(
        "weight-negative",
        "Place",
        "a negative weight on a resting row",
        &|l| l.reasons[0] = none(&[&[], &[-1]]),
    );
    no(
        "weights-positive",
        "Place",
        "w'T > 0 with a weight on a resting row excludes nothing",
        &|l| l.reasons[0] = none(&[&[], &[1]]),
    );
    no(
        "no-last-cell",
        "Length",
        "nothing said between the last point and infinity",
        &|l| l.cells.clear(),
    );
    no(
        "y-turns-negative",
        "Place",
        "x_0 = 1 - t is positive at 0 and not up to infinity",
        &|l| {
            l.reasons[0] = member(&[&[1, -1], &[]], Some((0, vec![])));
        },
    );
    // The same support where y_0 = t x_0 is zero at 0 only.
    let p = pencil(
        &[&["0", "0"], &["1", "1"]],
        &[&["1", "0"], &["0", "0"]],
        &[],
    );
    let zero = node(
        vec![at(0, 0)],
        vec![1],
        vec![member(&[&[1], &[]], Some((0, vec![]))), none(&[&[-1], &[]])],
    );
    let good = Good::new(p, four(pushed(), zero, pushed()), 5);
    cases.accept(
        "one-support-window-end",
        "a solution at the end of the window and nothing above it",
        &good.problem,
        &good.certificate,
    );
    good.no(
        cases,
        "y-active",
        "Place",
        "y_0 > 0 on the support, above 0",
        |l| l.cells[0] = 0,
    );
}

/// [[t, -2], [-1, t]]: x = (2, t) at t = sqrt 2.
fn irrational(cases: &mut Cases) {
    let p = to_four(&[&["0", "-2"], &["-1", "0"]], I2);
    let root = |reason| point(&[-2, 0, 1], "1", "2", reason);
    let row = || vec![(1, vector(&[&[1], &[]]))];
    let both = node(
        vec![at(0, 0), root(1), at(4, 0)],
        vec![0, 0],
        vec![
            none(&[&[1], &[0, 1]]),
            member(&[&[2], &[0, 1]], Some((0, row()))),
        ],
    );
    let tree = four(
        whole_of(none(&[&[1], &[]])),
        whole_of(none(&[&[], &[1]])),
        both,
    );
    let good = Good::new(p, tree, 6);
    cases.accept(
        "one-support-irrational",
        "signs at sqrt 2 by remainders; cells that end within its interval",
        &good.problem,
        &good.certificate,
    );
    let mut no = |name: &str, note: &str, forge: &dyn Fn(&mut Support)| {
        good.no(cases, name, "Place", note, forge)
    };
    no(
        "rational-near-root",
        "a rational x: y is small at sqrt 2 and not zero",
        &|l| {
            l.reasons[1] = member(
                &[&[1_414_213_562_373], &[1_000_000_000_000]],
                Some((0, row())),
            );
        },
    );
    no(
        "turn-beside-root",
        "w'T turns at 3/2: in the cell, but within the interval of sqrt 2, not between the \
         intervals",
        &|l| {
            l.reasons[0] = none(&[&[-3, 2], &[0, -3, 2]]);
        },
    );
    no(
        "root-hidden",
        "the cells' vector vanishes at sqrt 2",
        &|l| l.points[1].reason = 0,
    );
    no("conjugate", "x_1 = -t is the other root's", &|l| {
        l.reasons[1] = member(&[&[2], &[0, -1]], Some((0, row())))
    });
    no("other-root", "sqrt 3 in place of sqrt 2", &|l| {
        l.points[1] = point(&[-3, 0, 1], "1", "2", 1)
    });
}

/// y_0 = y_1 = 0, y_2 = x_0 - x_1, y_3 = x_1 - x_0 and y_4 = x_0 where only 0 and 1 move: the ray
/// (1, 1) by two inequalities.
fn inequalities(cases: &mut Cases) {
    let zero: &[&str] = &["0"; 5];
    let a: &[&[&str]] = &[
        zero,
        zero,
        &["1", "-1", "0", "0", "0"],
        &["-1", "1", "0", "0", "0"],
        &["1", "0", "0", "0", "0"],
    ];
    let p = to_four(a, &[zero; 5]);
    let unit = |i: usize, v: i64| {
        let mut l = vec![vec![]; 5];
        l[i] = poly(&[v]);
        Polynomials(l)
    };
    let two = || vec![(1, unit(2, 1)), (1, unit(3, 1))];
    let leaf = whole_of(member(&[&[1], &[1], &[], &[], &[]], Some((0, two()))));
    // The region where the variable rests comes first; what moves of 4, 3 and 2 stays open.
    let branches = [4, 3, 2, 1].map(Node::Branch);
    let tree = [
        branches.to_vec(),
        vec![
            Node::Open,
            Node::Branch(0),
            Node::Open,
            leaf,
            Node::Open,
            Node::Open,
            Node::Open,
        ],
    ]
    .concat();
    let good = Good::new(p, tree, 7);
    let file = json!({ "verdict": "undecided", "problem": serde_json::from_str::<serde_json::Value>(&write_problem(&good.problem)).unwrap(),
        "certificate": serde_json::from_str::<serde_json::Value>(&good.certificate.to_json()).unwrap() });
    cases.push(
        "accept",
        "one-support-alone-by-inequalities",
        file,
        "x_1 / x_0 bounded from both sides by resting rows with y = 0; other supports open",
    );
    let mut no = |name: &str, note: &str, rows: Vec<(usize, Polynomials)>| {
        good.no(cases, name, "Place", note, |l| {
            l.reasons[0] = member(&[&[1], &[1], &[], &[], &[]], Some((0, rows)))
        });
    };
    no(
        "alone-one-side",
        "x_1 bounded from one side only",
        vec![(1, unit(2, 1))],
    );
    no(
        "alone-same-side",
        "two bounds from the same side",
        vec![(1, unit(2, 1)), (1, unit(2, 3))],
    );
    no(
        "alone-negative-weight",
        "the other side from a negative weight",
        vec![(1, unit(2, 1)), (1, unit(2, -1))],
    );
    let mut loose = two();
    loose[0].1.0[4] = poly(&[1]);
    no("alone-loose-row", "a weight where y > 0: no bound", loose);
    no(
        "alone-resting",
        "a row for a variable that rests",
        vec![(2, unit(2, 1))],
    );
}

/// [[1, 1], [1, t]] with 0 free: x = (-1, 1) at t = 1.
fn free_variable(cases: &mut Cases) {
    let p = window(
        pencil(
            &[&["1", "1"], &["1", "0"]],
            &[&["0", "0"], &["0", "1"]],
            &[0],
        ),
        "0",
        Some("4"),
    );
    let row = || vec![(0, vector(&[&[1], &[]]))];
    let leaf = node(
        vec![at(0, 0), at(1, 1), at(4, 0)],
        vec![0, 0],
        vec![
            none(&[&[-1], &[1]]),
            member(&[&[-1], &[1]], Some((1, row()))),
        ],
    );
    let mut good = Good::new(p, vec![Node::Branch(1), nothing_moves(), leaf], 2);
    let condensation = completed(&good.problem).complete_set.unwrap().condensation;
    good.certificate.complete_set.as_mut().unwrap().condensation = condensation;
    cases.accept(
        "one-support-free",
        "a free variable: the leaf speaks of the whole pencil, its sign of x is any",
        &good.problem,
        &good.certificate,
    );
    let mut no = |name: &str, note: &str, forge: &dyn Fn(&mut Support)| {
        good.no(cases, name, "Place", note, forge)
    };
    no(
        "free-column",
        "w'T < 0 on a free column proves nothing",
        &|l| l.reasons[0] = none(&[&[-1], &[]]),
    );
    no("free-row", "y of a free row is not zero", &|l| {
        l.reasons[1] = member(&[&[], &[1]], Some((1, row())))
    });
    no(
        "free-not-determined",
        "the free component is not determined",
        &|l| l.reasons[1] = member(&[&[-1], &[1]], Some((1, vec![]))),
    );
}

/// Leaves that are none.
fn shapes(cases: &mut Cases, good: &Good) {
    let problem: serde_json::Value = serde_json::from_str(&write_problem(&good.problem)).unwrap();
    let text = good.certificate.to_json();
    let mut add = |name: &str, note: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from} not in {text}");
        let file = json!({ "verdict": "malformed", "problem": problem, "certificate_text": text.replacen(from, to, 1) });
        cases.push("malformed", &format!("support-leaf-{name}"), file, note);
    };
    add(
        "reason-string",
        "an index as a string",
        "\"reason\":0",
        "\"reason\":\"0\"",
    );
    add(
        "reason-negative",
        "reason -1",
        "\"reason\":0",
        "\"reason\":-1",
    );
    add(
        "cell-string",
        "a cell's reason as a string",
        "\"cells\":[0,0]",
        "\"cells\":[\"0\",0]",
    );
    add(
        "pivot-string",
        "the pivot as a string",
        "\"pivot\":1",
        "\"pivot\":\"1\"",
    );
    add(
        "no-cells",
        "a leaf without a list of cells",
        "\"cells\":[0,0],",
        "",
    );
    add(
        "unknown-reason",
        "a reason of a later version",
        "{\"none\":",
        "{\"believe\":",
    );
    add(
        "list",
        "a list of the fields for an object",
        "{\"support\":{\"points\":[],\"cells\":[],\"reasons\":[]}}",
        "{\"support\":[[],[],[]]}",
    );
    add(
        "point-list",
        "the same in a point",
        "{\"polynomial\":[\"0\",\"1\"],\"interval\":[\"0\",\"0\"],\"reason\":0}",
        "[[\"0\",\"1\"],[\"0\",\"0\"],0]",
    );
    add(
        "unknown-field",
        "a field that might mean something",
        "\"cells\":[0,0],",
        "\"cells\":[0,0],\"trust\":true,",
    );
    add(
        "coefficient-fraction",
        "a coefficient that is no integer",
        "{\"none\":[[]",
        "{\"none\":[[\"1/2\"]",
    );
}
