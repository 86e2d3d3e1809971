//! Support leaves by hand: what each kind of reason is accepted for, and a forgery of each
//! obligation.
//!
//! A support leaf says what one support holds, value by value: points that part the interval, and a
//! reason for each point and for each cell between them. A reason is a vector of weights w with w'T
//! < 0, which excludes every solution, or a solution x as a polynomial in t, if need be with a
//! proof that it is the only ray. The pencils are so small that all of it is seen without a
//! computer; each forgery changes one accepted leaf in one place.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Alone, Certificate, Exact, Member, Node, Point, Polynomials, Support,
};
use mceip_exact::Integer;
use mceip_model::Problem;

/// The integer polynomial with these coefficients, the constant one first.
pub fn poly(coefficients: &[i64]) -> Vec<Integer> {
    coefficients.iter().map(|&c| c.into()).collect()
}

/// A vector of integer polynomials in t; an empty one is zero.
pub fn vector(components: &[&[i64]]) -> Polynomials {
    Polynomials(components.iter().map(|c| poly(c)).collect())
}

/// No solution, because w'T < 0.
pub fn none(weights: &[&[i64]]) -> Exact {
    Exact::None(vector(weights))
}

/// x is a solution, perhaps not the only one.
pub fn member(x: &[&[i64]]) -> Exact {
    let member = Member {
        x: vector(x),
        alone: None,
    };
    Exact::Some(Box::new(member))
}

/// Weights that bound a component of x by the one of the pivot.
type Row = (usize, Polynomials);

/// x is the only ray of solutions.
pub fn only_member(x: &[&[i64]], pivot: usize, rows: Vec<Row>) -> Exact {
    let member = Member {
        x: vector(x),
        alone: Some(Alone { pivot, rows }),
    };
    Exact::Some(Box::new(member))
}

/// The root of a polynomial in [a, b], and the number of its reason.
fn point(coefficients: &[i64], a: &str, b: &str, reason: usize) -> Point {
    Point {
        polynomial: poly(coefficients),
        interval: [q(a), q(b)],
        reason,
    }
}

/// The point with an integer value.
pub fn at(value: i64, reason: usize) -> Point {
    let spelt = value.to_string();
    point(&[-value, 1], &spelt, &spelt, reason)
}

fn node(points: Vec<Point>, cells: Vec<usize>, reasons: Vec<Exact>) -> Node {
    Node::Support(Box::new(Support {
        points,
        cells,
        reasons,
    }))
}

/// One reason over all of [0, 4].
fn throughout(reason: Exact) -> Node {
    let ends = vec![at(0, 0), at(4, 0)];
    node(ends, vec![0], vec![reason])
}

/// One reason over all of [0, infinity).
fn to_infinity(reason: Exact) -> Node {
    let lower_end = vec![at(0, 0)];
    node(lower_end, vec![0], vec![reason])
}

fn nothing_moves() -> Node {
    node(vec![], vec![], vec![])
}

/// The leaves of the supports {1}, {0} and {0, 1} of two variables.
struct Leaves {
    one: Node,
    zero: Node,
    both: Node,
}

/// Where `Leaves::tree` puts the leaf of {0}.
const ZERO_LEAF: usize = 5;
/// Where `Leaves::tree` puts the leaf of {0, 1}.
const BOTH_LEAF: usize = 6;

impl Leaves {
    fn tree(self) -> Vec<Node> {
        vec![
            Node::Branch(0),
            Node::Branch(1),
            nothing_moves(),
            self.one,
            Node::Branch(1),
            self.zero,
            self.both,
        ]
    }
}

/// A pencil without free variables, on [0, 4].
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

    fn leaf(&self) -> &Support {
        let set = self.certificate.complete_set.as_ref().unwrap();
        match &set.pieces[0].tree[self.node] {
            Node::Support(leaf) => leaf,
            other => unreachable!("{other:?}"),
        }
    }

    fn accept(&self, cases: &mut Cases, name: &str, note: &str) {
        let name = format!("one-support-{name}");
        cases.accept(&name, note, &self.problem, &self.certificate);
    }

    /// One rejected file for each forgery of the leaf.
    fn forge(&self, cases: &mut Cases, forgeries: &[Forgery<Support>]) {
        for forgery in forgeries {
            let leaf = forgery.of(self.leaf());
            let mut forged = self.certificate.clone();
            set(&mut forged).pieces[0].tree[self.node] = Node::Support(Box::new(leaf));

            let name = format!("one-support-{}", forgery.name);
            cases.reject(&name, forgery.reason, forgery.note, &self.problem, &forged);
        }
    }
}

pub fn supports(cases: &mut Cases) {
    let cone = cone();
    cone.accept(
        cases,
        "cone",
        "a cone at a value between two empty cells is a family; its edges are solutions",
    );
    cone.forge(cases, &POINTS_AND_CELLS);
    cone.forge(cases, &WEIGHTS);
    cone.forge(cases, &MEMBERS);
    undecided(cases, &cone);

    ray(cases);
    range(cases);
    window_end(cases);
    irrational(cases);
    inequalities(cases);
    free_variable(cases);

    let text = cone.certificate.to_json();
    cases.misspelt("support-leaf-", &cone.problem, &text, &NO_LEAVES);
}

/// diag(t - 1, t - 1): at 1 every x >= 0 solves.
fn cone() -> Good {
    let leaves = Leaves {
        one: only_at_one(&[&[], &[1]], only_member(&[&[], &[1]], 1, vec![])),
        zero: only_at_one(&[&[1], &[]], only_member(&[&[1], &[]], 0, vec![])),
        both: only_at_one(&[&[1], &[]], member(&[&[1], &[1]])),
    };
    let problem = to_four(&[&["-1", "0"], &["0", "-1"]], I2);
    Good::new(problem, leaves.tree(), BOTH_LEAF)
}

/// Solutions at 1 by reason 1; by the weights, reason 0, none in the cells on both sides.
fn only_at_one(weights: &[&[i64]], solutions: Exact) -> Node {
    node(
        vec![at(0, 0), at(1, 1), at(4, 0)],
        vec![0, 0],
        vec![none(weights), solutions],
    )
}

/// The leaf of {0, 1} where no variable is decided.
fn undecided(cases: &mut Cases, cone: &Good) {
    let leaf = Node::Support(Box::new(cone.leaf().clone()));
    cases.reject(
        "one-support-undecided",
        "Cover.SupportTooEarly",
        "one support stands for all",
        &cone.problem,
        &cover(&cone.problem, vec![leaf]),
    );
}

/// The points 0, 1 and 4 of the cone, the cells between them, and the numbers of their reasons.
const POINTS_AND_CELLS: [Forgery<Support>; 22] = [
    Forgery {
        name: "nothing-said",
        reason: "Cover.SupportTooEarly",
        note: "a leaf without a point where something moves",
        change: |leaf| {
            leaf.points.clear();
            leaf.cells.clear();
            leaf.reasons.clear();
        },
    },
    Forgery {
        name: "point-not-a-root",
        reason: "Cover.Point",
        note: "p is not zero at a point said to be exact",
        change: |leaf| leaf.points[1] = point(&[-1, 1], "2", "2", 1),
    },
    Forgery {
        name: "point-two-roots",
        reason: "Cover.Point",
        note: "p has both 1 and 2 in the interval",
        change: |leaf| leaf.points[1] = point(&[2, -3, 1], "1/2", "3", 1),
    },
    Forgery {
        name: "point-no-sign-change",
        reason: "Cover.Point",
        note: "p has no root in the interval",
        change: |leaf| leaf.points[1] = point(&[-1, 1], "2", "3", 1),
    },
    Forgery {
        name: "point-constant",
        reason: "Cover.Point",
        note: "a polynomial without a root",
        change: |leaf| leaf.points[1] = point(&[1], "1", "1", 1),
    },
    Forgery {
        name: "point-zero",
        reason: "Cover.Point",
        note: "the zero polynomial vanishes everywhere",
        change: |leaf| leaf.points[1] = point(&[0, 0], "1", "1", 1),
    },
    Forgery {
        name: "point-reversed",
        reason: "Cover.Point",
        note: "an interval with b < a",
        change: |leaf| leaf.points[1] = point(&[-1, 1], "2", "1/2", 1),
    },
    Forgery {
        name: "points-out-of-order",
        reason: "Cover.Point",
        note: "points that fall",
        change: |leaf| leaf.points.swap(0, 1),
    },
    Forgery {
        name: "points-touch",
        reason: "Cover.Point",
        note: "two intervals that share an end: which comes first?",
        change: |leaf| leaf.points[1] = point(&[-1, 1], "0", "2", 1),
    },
    Forgery {
        name: "first-end",
        reason: "Cover.Point",
        note: "the leaf begins above the region's lower end",
        change: |leaf| {
            leaf.points.remove(0);
            leaf.cells.pop();
        },
    },
    Forgery {
        name: "last-end",
        reason: "Cover.Point",
        note: "the leaf ends below the region's upper end",
        change: |leaf| {
            leaf.points.pop();
            leaf.cells.pop();
        },
    },
    Forgery {
        name: "end-not-exact",
        reason: "Cover.Point",
        note: "the last point only encloses the upper end",
        change: |leaf| leaf.points[2] = point(&[-4, 1], "3", "5", 0),
    },
    Forgery {
        name: "cell-missing",
        reason: "Cover.Length",
        note: "a cell without a reason",
        change: |leaf| leaf.cells.truncate(1),
    },
    Forgery {
        name: "cell-too-many",
        reason: "Cover.Length",
        note: "a cell above the last point of a finite interval",
        change: |leaf| leaf.cells.push(0),
    },
    Forgery {
        name: "reason-missing-point",
        reason: "Cover.NoReason",
        note: "a point's reason does not exist",
        change: |leaf| leaf.points[1].reason = 2,
    },
    Forgery {
        name: "reason-missing-cell",
        reason: "Cover.NoReason",
        note: "a cell's reason does not exist",
        change: |leaf| leaf.cells[1] = 2,
    },
    Forgery {
        name: "point-hidden",
        reason: "Cover.Place",
        note: "the vector of the cells is no vector at their common end",
        change: |leaf| leaf.points[1].reason = 0,
    },
    Forgery {
        name: "point-left-out",
        reason: "Cover.Place",
        note: "signs at the ends of a cell or in its middle, not in between",
        change: |leaf| {
            leaf.points.remove(1);
            leaf.cells.pop();
        },
    },
    Forgery {
        name: "point-beside",
        reason: "Cover.Place",
        note: "the root lies in a cell",
        change: |leaf| leaf.points[1] = at(2, 0),
    },
    Forgery {
        name: "cell-solution",
        reason: "Cover.Place",
        note: "a solution at the cell's end is none in the cell",
        change: |leaf| leaf.cells[1] = 1,
    },
    Forgery {
        name: "degree",
        reason: "Cover.TooLarge",
        note: "257 coefficients",
        change: |leaf| leaf.points[1].polynomial.resize(257, Integer::from(0)),
    },
    Forgery {
        name: "size",
        reason: "Cover.TooLarge",
        note: "3,000 coefficients beside one of 3,000 bits",
        change: |leaf| {
            let long = Integer::from(1) << 3000usize;
            leaf.points[1].polynomial = vec![-long.clone(), long];
            leaf.reasons.extend(vec![none(&[&[1; 256], &[1; 256]]); 6]);
        },
    },
];

/// Reason 0 of the cone's leaf: the weights of its cells.
const WEIGHTS: [Forgery<Support>; 4] = [
    Forgery {
        name: "weights-zero",
        reason: "Cover.Place",
        note: "w = 0 proves nothing",
        change: |leaf| leaf.reasons[0] = none(&[&[], &[]]),
    },
    Forgery {
        name: "weights-both-signs",
        reason: "Cover.Place",
        note: "w'T < 0 on one moving column and > 0 on the other",
        change: |leaf| leaf.reasons[0] = none(&[&[1], &[-1]]),
    },
    Forgery {
        name: "weights-turn",
        reason: "Cover.Place",
        note: "w'T changes its sign within a cell",
        change: |leaf| leaf.reasons[0] = none(&[&[-2, 1], &[]]),
    },
    Forgery {
        name: "weights-short",
        reason: "Cover.Length",
        note: "a weight missing",
        change: |leaf| leaf.reasons[0] = none(&[&[1]]),
    },
];

/// Reason 1 of the cone's leaf: what solves at 1.
const MEMBERS: [Forgery<Support>; 5] = [
    Forgery {
        name: "x-zero",
        reason: "Cover.Place",
        note: "x_1 = 0 on a support that holds 1",
        change: |leaf| leaf.reasons[1] = member(&[&[1], &[]]),
    },
    Forgery {
        name: "x-negative",
        reason: "Cover.Place",
        note: "x_1 < 0",
        change: |leaf| leaf.reasons[1] = member(&[&[1], &[-1]]),
    },
    Forgery {
        name: "x-short",
        reason: "Cover.Length",
        note: "a component missing",
        change: |leaf| leaf.reasons[1] = member(&[&[1]]),
    },
    Forgery {
        name: "alone-but-cone",
        reason: "Cover.Place",
        note: "a cone said to be one ray",
        change: |leaf| leaf.reasons[1] = only_member(&[&[1], &[1]], 0, vec![]),
    },
    Forgery {
        name: "alone-empty-row",
        reason: "Cover.Place",
        note: "a row that says nothing",
        change: |leaf| {
            leaf.reasons[1] = only_member(&[&[1], &[1]], 0, vec![(1, vector(&[&[1], &[]]))])
        },
    },
];

/// y_0 = 0, y_1 = x_1 - x_0: support {0, 1} is the ray (1, 1) at every value, support {0} has y_1 <
/// 0.
fn ray(cases: &mut Cases) {
    let problem = to_four(&[&["0", "0"], &["-1", "1"]], ZERO2);
    let second_row = vec![(1, vector(&[&[], &[1]]))];
    let leaves = Leaves {
        one: throughout(none(&[&[], &[1]])),
        zero: throughout(none(&[&[], &[1]])),
        both: throughout(only_member(&[&[1], &[1]], 0, second_row)),
    };
    let tree = leaves.tree();

    let ray = Good::new(problem.clone(), tree.clone(), BOTH_LEAF);
    ray.accept(
        cases,
        "ray",
        "one ray at every value of an interval: a family; weights on a resting row",
    );
    ray.forge(cases, &RAYS);

    let excluded = Good::new(problem, tree, ZERO_LEAF);
    excluded.forge(cases, &EXCLUDED);
}

/// The proof that (1, 1) is the only ray.
const RAYS: [Forgery<Support>; 4] = [
    Forgery {
        name: "alone-pivot",
        reason: "Cover.Pivot",
        note: "a pivot that is no variable",
        change: |leaf| leaf.reasons[0] = only_member(&[&[1], &[1]], 2, vec![]),
    },
    Forgery {
        name: "alone-own-pivot",
        reason: "Cover.Place",
        note: "a row for the pivot itself",
        change: |leaf| {
            leaf.reasons[0] = only_member(&[&[1], &[1]], 0, vec![(0, vector(&[&[], &[1]]))])
        },
    },
    Forgery {
        name: "alone-no-row",
        reason: "Cover.Place",
        note: "x_1 is not determined",
        change: |leaf| leaf.reasons[0] = only_member(&[&[1], &[1]], 0, vec![]),
    },
    Forgery {
        name: "alone-short",
        reason: "Cover.Length",
        note: "a weight missing",
        change: |leaf| leaf.reasons[0] = only_member(&[&[1], &[1]], 0, vec![(1, vector(&[&[]]))]),
    },
];

/// Solutions said to be on {0}, which is excluded.
const EXCLUDED: [Forgery<Support>; 2] = [
    Forgery {
        name: "y-negative",
        reason: "Cover.Place",
        note: "y_1 < 0 on a resting row",
        change: |leaf| leaf.reasons[0] = member(&[&[1], &[]]),
    },
    Forgery {
        name: "x-off-support",
        reason: "Cover.Place",
        note: "x_1 > 0 off the support",
        change: |leaf| leaf.reasons[0] = member(&[&[1], &[1]]),
    },
];

/// y_0 = 0, y_1 = x_0 + x_1: support {0} solves at every value, to infinity.
fn range(cases: &mut Cases) {
    let problem = pencil(&[&["0", "0"], &["1", "1"]], ZERO2, &[]);
    let leaves = Leaves {
        one: to_infinity(none(&[&[], &[1]])),
        zero: to_infinity(only_member(&[&[1], &[]], 0, vec![])),
        both: to_infinity(none(&[&[], &[1]])),
    };

    let range = Good::new(problem, leaves.tree(), ZERO_LEAF);
    range.accept(
        cases,
        "range",
        "a solution at every value up to infinity: a family",
    );
    range.forge(cases, &RANGES);
}

/// The leaf of {0}, up to infinity.
const RANGES: [Forgery<Support>; 4] = [
    Forgery {
        name: "weight-negative",
        reason: "Cover.Place",
        note: "a negative weight on a resting row",
        change: |leaf| leaf.reasons[0] = none(&[&[], &[-1]]),
    },
    Forgery {
        name: "weights-positive",
        reason: "Cover.Place",
        note: "w'T > 0 with a weight on a resting row excludes nothing",
        change: |leaf| leaf.reasons[0] = none(&[&[], &[1]]),
    },
    Forgery {
        name: "no-last-cell",
        reason: "Cover.Length",
        note: "nothing said between the last point and infinity",
        change: |leaf| leaf.cells.clear(),
    },
    Forgery {
        name: "y-turns-negative",
        reason: "Cover.Place",
        note: "x_0 = 1 - t is positive at 0 and not up to infinity",
        change: |leaf| {
            leaf.reasons[0] = only_member(&[&[1, -1], &[]], 0, vec![]);
        },
    },
];

/// The same support where y_0 = t x_0 is zero at 0 only.
fn window_end(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["0", "0"], &["1", "1"]];
    let problem = pencil(a, &[&["1", "0"], &["0", "0"]], &[]);

    let at_zero = only_member(&[&[1], &[]], 0, vec![]);
    let above_zero = none(&[&[-1], &[]]);
    let leaves = Leaves {
        one: to_infinity(none(&[&[], &[1]])),
        zero: node(vec![at(0, 0)], vec![1], vec![at_zero, above_zero]),
        both: to_infinity(none(&[&[], &[1]])),
    };

    let window_end = Good::new(problem, leaves.tree(), ZERO_LEAF);
    window_end.accept(
        cases,
        "window-end",
        "a solution at the end of the window and nothing above it",
    );

    let y_active = Forgery {
        name: "y-active",
        reason: "Cover.Place",
        note: "y_0 > 0 on the support, above 0",
        change: |leaf: &mut Support| leaf.cells[0] = 0,
    };
    window_end.forge(cases, &[y_active]);
}

/// [[t, -2], [-1, t]]: x = (2, t) at t = sqrt 2.
fn irrational(cases: &mut Cases) {
    let problem = to_four(&[&["0", "-2"], &["-1", "0"]], I2);
    let root_two = point(&[-2, 0, 1], "1", "2", 1);
    let reasons = vec![
        none(&[&[1], &[0, 1]]),
        only_member(&[&[2], &[0, 1]], 0, determined_by_row_0()),
    ];
    let leaves = Leaves {
        one: throughout(none(&[&[1], &[]])),
        zero: throughout(none(&[&[], &[1]])),
        both: node(vec![at(0, 0), root_two, at(4, 0)], vec![0, 0], reasons),
    };

    let irrational = Good::new(problem, leaves.tree(), BOTH_LEAF);
    irrational.accept(
        cases,
        "irrational",
        "signs at sqrt 2 by remainders; cells that end within its interval",
    );
    irrational.forge(cases, &IRRATIONAL);
}

/// Row 0 of T x = 0 gives x_1.
fn determined_by_row_0() -> Vec<Row> {
    vec![(1, vector(&[&[1], &[]]))]
}

/// The leaf with sqrt 2 as its second point.
const IRRATIONAL: [Forgery<Support>; 5] = [
    Forgery {
        name: "rational-near-root",
        reason: "Cover.Place",
        note: "a rational x: y is small at sqrt 2 and not zero",
        change: |leaf| {
            leaf.reasons[1] = only_member(
                &[&[1_414_213_562_373], &[1_000_000_000_000]],
                0,
                determined_by_row_0(),
            )
        },
    },
    Forgery {
        name: "turn-beside-root",
        reason: "Cover.Place",
        note: "w'T turns at 3/2: in the cell, but within the interval of sqrt 2, not between the \
         intervals",
        change: |leaf| leaf.reasons[0] = none(&[&[-3, 2], &[0, -3, 2]]),
    },
    Forgery {
        name: "root-hidden",
        reason: "Cover.Place",
        note: "the cells' vector vanishes at sqrt 2",
        change: |leaf| leaf.points[1].reason = 0,
    },
    Forgery {
        name: "conjugate",
        reason: "Cover.Place",
        note: "x_1 = -t is the other root's",
        change: |leaf| leaf.reasons[1] = only_member(&[&[2], &[0, -1]], 0, determined_by_row_0()),
    },
    Forgery {
        name: "other-root",
        reason: "Cover.Place",
        note: "sqrt 3 in place of sqrt 2",
        change: |leaf| leaf.points[1] = point(&[-3, 0, 1], "1", "2", 1),
    },
];

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
    let problem = to_four(a, &[zero; 5]);

    // The region where the variable rests comes first; what moves of 4, 3 and 2 stays open.
    let tree = vec![
        Node::Branch(4),
        Node::Branch(3),
        Node::Branch(2),
        Node::Branch(1),
        Node::Open,
        Node::Branch(0),
        Node::Open,
        throughout(only_one_one(both_bounds())),
        Node::Open,
        Node::Open,
        Node::Open,
    ];
    let bounded = Good::new(problem, tree, 7);
    cases.undecided(
        "one-support-alone-by-inequalities",
        "x_1 / x_0 bounded from both sides by resting rows with y = 0; other supports open",
        &bounded.problem,
        &bounded.certificate,
    );
    bounded.forge(cases, &BOUNDS);
}

/// (1, 1) is the only ray of the support {0, 1} of five variables.
fn only_one_one(rows: Vec<Row>) -> Exact {
    only_member(&[&[1], &[1], &[], &[], &[]], 0, rows)
}

/// One weight on one of five rows.
fn weight(row: usize, value: i64) -> Polynomials {
    let mut weights = vec![vec![]; 5];
    weights[row] = poly(&[value]);
    Polynomials(weights)
}

/// x_1 is at most x_0 by row 2, and at least x_0 by row 3.
fn both_bounds() -> Vec<Row> {
    vec![(1, weight(2, 1)), (1, weight(3, 1))]
}

/// The first bound with a weight on row 4, where y > 0.
fn loose_bound() -> Vec<Row> {
    let mut rows = both_bounds();
    let (_, weights) = &mut rows[0];
    weights.0[4] = poly(&[1]);
    rows
}

/// The bounds of x_1 / x_0.
const BOUNDS: [Forgery<Support>; 5] = [
    Forgery {
        name: "alone-one-side",
        reason: "Cover.Place",
        note: "x_1 bounded from one side only",
        change: |leaf| leaf.reasons[0] = only_one_one(vec![(1, weight(2, 1))]),
    },
    Forgery {
        name: "alone-same-side",
        reason: "Cover.Place",
        note: "two bounds from the same side",
        change: |leaf| leaf.reasons[0] = only_one_one(vec![(1, weight(2, 1)), (1, weight(2, 3))]),
    },
    Forgery {
        name: "alone-negative-weight",
        reason: "Cover.Place",
        note: "the other side from a negative weight",
        change: |leaf| leaf.reasons[0] = only_one_one(vec![(1, weight(2, 1)), (1, weight(2, -1))]),
    },
    Forgery {
        name: "alone-loose-row",
        reason: "Cover.Place",
        note: "a weight where y > 0: no bound",
        change: |leaf| leaf.reasons[0] = only_one_one(loose_bound()),
    },
    Forgery {
        name: "alone-resting",
        reason: "Cover.Place",
        note: "a row for a variable that rests",
        change: |leaf| leaf.reasons[0] = only_one_one(vec![(2, weight(2, 1))]),
    },
];

/// [[1, 1], [1, t]] with 0 free: x = (-1, 1) at t = 1.
fn free_variable(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["1", "1"], &["1", "0"]];
    let b: &[&[&str]] = &[&["0", "0"], &["0", "1"]];
    let problem = window(pencil(a, b, &[0]), "0", Some("4"));

    let solution = only_member(&[&[-1], &[1]], 1, free_component_by_row_0());
    let leaf = only_at_one(&[&[-1], &[1]], solution);
    let mut good = Good::new(problem, vec![Node::Branch(1), nothing_moves(), leaf], 2);
    let condensation = completed(&good.problem).complete_set.unwrap().condensation;
    set(&mut good.certificate).condensation = condensation;

    good.accept(
        cases,
        "free",
        "a free variable: the leaf speaks of the whole pencil, its sign of x is any",
    );
    good.forge(cases, &FREE);
}

/// Row 0 of T x = 0 gives x_0.
fn free_component_by_row_0() -> Vec<Row> {
    vec![(0, vector(&[&[1], &[]]))]
}

/// The leaf of {1} with 0 free.
const FREE: [Forgery<Support>; 3] = [
    Forgery {
        name: "free-column",
        reason: "Cover.Place",
        note: "w'T < 0 on a free column proves nothing",
        change: |leaf| leaf.reasons[0] = none(&[&[-1], &[]]),
    },
    Forgery {
        name: "free-row",
        reason: "Cover.Place",
        note: "y of a free row is not zero",
        change: |leaf| leaf.reasons[1] = only_member(&[&[], &[1]], 1, free_component_by_row_0()),
    },
    Forgery {
        name: "free-not-determined",
        reason: "Cover.Place",
        note: "the free component is not determined",
        change: |leaf| leaf.reasons[1] = only_member(&[&[-1], &[1]], 1, vec![]),
    },
];

/// Changes of the text of the cone after which a leaf is none.
const NO_LEAVES: [Misspelling; 10] = [
    Misspelling {
        name: "reason-string",
        note: "an index as a string",
        from: "\"reason\":0",
        to: "\"reason\":\"0\"",
    },
    Misspelling {
        name: "reason-negative",
        note: "reason -1",
        from: "\"reason\":0",
        to: "\"reason\":-1",
    },
    Misspelling {
        name: "cell-string",
        note: "a cell's reason as a string",
        from: "\"cells\":[0,0]",
        to: "\"cells\":[\"0\",0]",
    },
    Misspelling {
        name: "pivot-string",
        note: "the pivot as a string",
        from: "\"pivot\":1",
        to: "\"pivot\":\"1\"",
    },
    Misspelling {
        name: "no-cells",
        note: "a leaf without a list of cells",
        from: "\"cells\":[0,0],",
        to: "",
    },
    Misspelling {
        name: "unknown-reason",
        note: "a reason of a later version",
        from: "{\"none\":",
        to: "{\"believe\":",
    },
    Misspelling {
        name: "list",
        note: "a list of the fields for an object",
        from: "{\"support\":{\"points\":[],\"cells\":[],\"reasons\":[]}}",
        to: "{\"support\":[[],[],[]]}",
    },
    Misspelling {
        name: "point-list",
        note: "the same in a point",
        from: "{\"polynomial\":[\"0\",\"1\"],\"interval\":[\"0\",\"0\"],\"reason\":0}",
        to: "[[\"0\",\"1\"],[\"0\",\"0\"],0]",
    },
    Misspelling {
        name: "unknown-field",
        note: "a field that might mean something",
        from: "\"cells\":[0,0],",
        to: "\"cells\":[0,0],\"trust\":true,",
    },
    Misspelling {
        name: "coefficient-fraction",
        note: "a coefficient that is no integer",
        from: "{\"none\":[[]",
        to: "{\"none\":[[\"1/2\"]",
    },
];
