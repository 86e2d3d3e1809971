//! Complete sets of a system with a particle in contact with zero reaction: accepted ones by hand
//! and as `complete` writes them, and a forgery of each rule that its halves add
//! (`spec/certificates.md`, 5.6 and 5.11).
//!
//! The system is that of `corpus_zero`: variables x = 0, gap = 1, right = 2 and left = 3, lambda^2
//! = 2 is the only value, and with c = 10 + t
//!
//! ```text
//!     y_x     = (t - 2) x                                       rows divided by  4
//!     y_gap   = a x + c gap                                                     16
//!     y_right = (3 a - b) x + 3 c gap + c (right - left)                        32
//!     y_left  = (3 a + b) x + 3 c gap - c (right - left)                        32
//! ```
//!
//! The trees begin with x at rest, where y_gap = c gap and y_right + y_left = 6 c gap leave
//! nothing.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use super::corpus_zero::problem;
use mceip_check::certificate::{Node, Root, RootOutcome};
use mceip_exact::{Integer, whole};
use mceip_model::{Problem, Unknown};

const X: usize = 0;
const GAP: usize = 1;
const RIGHT: usize = 2;
const LEFT: usize = 3;

/// The system on [15/8, 17/8].
fn near_two(a: &str, b: &str) -> Problem {
    let problem = problem(Unknown::Lambda2, a, b, whole(1));
    window(problem, "15/8", Some("17/8"))
}

/// The leaf of the null vector with x = 1 and the other moving variables 1/4; `inverse` is in
/// quarters.
fn null_vector(inverse: &[&[i64]], outcome: RootOutcome) -> Node {
    let rows = inverse.iter();
    let inverse = rows.map(|row| row.iter().map(|&v| Integer::from(v)).collect());
    let others = inverse.len();
    Node::Root(Box::new(Root {
        pivot: X,
        interval: AROUND_TWO.map(q),
        inverse: inverse.collect(),
        inverse_exponent: 2,
        left: vec![Integer::from(0); others],
        right: vec![Integer::from(1); others],
        exponent: 2,
        outcome,
    }))
}

fn farkas(weights: [i64; 4]) -> Node {
    Node::Farkas(weights.to_vec())
}

/// x at rest: right alone has c > 0, gap moves with y_gap = c gap > 0, left with y_left > 0.
fn nothing_moves() -> Vec<Node> {
    vec![
        Node::Branch(LEFT),
        Node::Branch(GAP),
        Node::PositiveDefinite,
        farkas([0, -1, 0, 0]),
        farkas([0, 0, 0, -1]),
    ]
}

/// A branch on x, nothing at rest, and the tree where x moves.
fn tree(moving: Vec<Node>) -> Vec<Node> {
    let mut tree = vec![Node::Branch(X)];
    tree.extend(nothing_moves());
    tree.extend(moving);
    tree
}

/// a = 1, b = 6: with the gap moving y_gap > 0, with left moving y_left > 0; x alone has y_right =
/// -3; with right moving there is the solution.
fn slides() -> Vec<Node> {
    tree(vec![
        Node::Branch(LEFT),
        Node::Branch(GAP),
        Node::Branch(RIGHT),
        null_vector(&[], RootOutcome::NegativeY(RIGHT)),
        null_vector(&[&[11]], RootOutcome::Solution),
        farkas([0, -1, 0, 0]),
        farkas([0, 0, 0, -1]),
    ])
}

/// a = -3, b = 3: with the gap at rest y_gap < 0; x and the gap alone have y_right = -3, where
/// `without_half` stands; with right moving there is the solution, and with left moving y_left = 3
/// y_gap + 3 x + c left.
fn opens(without_half: RootOutcome) -> Vec<Node> {
    tree(vec![
        Node::Branch(LEFT),
        Node::Branch(GAP),
        farkas([0, 1, 0, 0]),
        Node::Branch(RIGHT),
        null_vector(&[&[5]], without_half),
        null_vector(&[&[5, 0], &[-16, 11]], RootOutcome::Solution),
        Node::Branch(GAP),
        farkas([0, 1, 0, 0]),
        farkas([0, 3, 0, -2]),
    ])
}

pub fn covers(cases: &mut Cases) {
    accepted(cases);
    forged(cases);
}

fn accepted(cases: &mut Cases) {
    let right = near_two("1", "6");
    cases.accept(
        "zero-cover-right",
        "the only solution in [15/8, 17/8]: the particle slides to the right; by hand",
        &right,
        &cover(&right, slides()),
    );

    let open = near_two("-3", "3");
    cases.accept(
        "zero-cover-open",
        "the particle opens and slides to the right; y_left vanishes with y_gap and y_right",
        &open,
        &cover(&open, opens(RootOutcome::NegativeY(RIGHT))),
    );

    for (name, unknown) in [("", Unknown::Lambda2), ("-mu", Unknown::Mu)] {
        let all = problem(unknown, "-3", "3", whole(1));
        cases.accept(
            &format!("zero-cover-all{name}"),
            "the complete set in [0, infinity), as `complete` writes it",
            &all,
            &completed(&all),
        );
    }

    cases.undecided(
        "zero-cover-nothing",
        "an open leaf: nothing is wrong, nothing is proved (exit 3)",
        &right,
        &cover(&right, vec![Node::Open]),
    );
}

fn forged(cases: &mut Cases) {
    let right = near_two("1", "6");
    let forgotten = tree(vec![
        Node::Branch(LEFT),
        Node::Branch(GAP),
        null_vector(&[], RootOutcome::NegativeY(RIGHT)),
        farkas([0, -1, 0, 0]),
        farkas([0, 0, 0, -1]),
    ]);
    cases.reject(
        "zero-cover-half-forgotten",
        "Cover.RootTooEarly",
        "left at rest does not put right at rest: the solution is left out",
        &right,
        &cover(&right, forgotten),
    );

    let mut both = slides();
    both.pop();
    both.extend([
        Node::Branch(RIGHT),
        farkas([0, 0, 0, -1]),
        farkas([0, 0, 0, -1]),
    ]);
    cases.reject(
        "zero-cover-both-halves",
        "Cover.Branch",
        "a branch on right where left moves: right is at rest there",
        &right,
        &cover(&right, both),
    );

    let mut undecided = slides();
    undecided.splice(
        1..6,
        [
            Node::Branch(GAP),
            Node::PositiveDefinite,
            farkas([0, -1, 0, 0]),
        ],
    );
    cases.reject(
        "zero-cover-halves-undecided",
        "Cover.NotDefinite",
        "both halves may move: x'Tx = 0 for right = left, whatever the value",
        &right,
        &cover(&right, undecided),
    );

    let open = near_two("-3", "3");
    cases.reject(
        "zero-cover-open-with-friction",
        "Cover.Sign",
        "the gap moves and no half does: neither of their rows vanishes, y_right is negative",
        &open,
        &cover(&open, opens(RootOutcome::Solution)),
    );
}
