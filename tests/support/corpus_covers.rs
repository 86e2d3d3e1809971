//! Complete sets and absence: what is accepted, and a forgery of each fault of
//! `crates/check/src/cover/fault.rs`.
//!
//! Most files are about the two values of `fold`, on a window that holds the first one: its witness
//! is exact, so that a change of one number breaks one obligation. The others need free variables,
//! a biactive solution or no solution at all.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Certificate, CompleteSet, Condensation, LdlFactor, Node, Root, RootOutcome,
};
use mceip_exact::{Integer, whole};
use mceip_model::{Problem, Unknown, Window};

/// V = 0 for F^-1 T_sf': the remainder l' F^-1 r is wider and still small enough. Rejected by
/// `spec/checker.py` until 2026-11-22 (spec/certificate-errata.md).
pub fn without_left_coefficients(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["5", "4"], &["4", "6"]];
    let b: &[&[&str]] = &[&["0", "0"], &["0", "1"]];
    let problem = window(pencil(a, b, &[0]), "1/7", Some("8"));

    let mut certificate = completed(&problem);
    for anchor in &mut condensation(set(&mut certificate)).anchors {
        anchor.left.clear();
    }

    cases.accept(
        "condensed-no-left-coefficients",
        "an anchor whose list of left coefficients is empty",
        &problem,
        &certificate,
    );
}

/// The condensation of a complete set that has one.
fn condensation(set: &mut CompleteSet) -> &mut Condensation {
    set.condensation.as_mut().unwrap()
}

pub fn covers(cases: &mut Cases) {
    whole_covers(cases);
    frames(cases);
    trees(cases);
    roots(cases);
    halves(cases);
    claimed(cases);
    condensed(cases);
    idle_condensation(cases);
}

/// `fold` on [15/8, 17/8], where lambda^2 = 2 is the only value.
fn one_value() -> Problem {
    fold("15/8", Some("17/8"))
}

/// The tree of the accepted cover of `one_value`.
fn one_value_tree() -> Vec<Node> {
    fold_tree(root_node(AROUND_TWO, RootOutcome::Solution))
}

fn whole_covers(cases: &mut Cases) {
    let problem = one_value();
    cases.accept(
        "cover",
        "one solution in [15/8, 17/8] and no other, by hand",
        &problem,
        &cover(&problem, one_value_tree()),
    );

    cases.undecided(
        "cover-open",
        "an open leaf: nothing is wrong, nothing is proved (exit 3)",
        &problem,
        &cover(&problem, vec![Node::Open]),
    );

    let all = fold("0", None);
    cases.accept(
        "cover-all",
        "the two solutions of [0, infinity), as `complete` writes it",
        &all,
        &completed(&all),
    );
}

/// The window and its pieces.
const FRAMES: [Forgery<Certificate>; 6] = [
    Forgery {
        name: "vacuous",
        reason: "Cover.PieceEnd",
        note: "no piece covers nothing",
        change: |cover| set(cover).pieces.clear(),
    },
    Forgery {
        name: "empty-tree",
        reason: "Cover.Truncated",
        note: "a piece without a leaf",
        change: |cover| set(cover).pieces[0].tree.clear(),
    },
    Forgery {
        name: "half",
        reason: "Cover.PieceEnd",
        note: "the piece ends inside the window",
        change: |cover| set(cover).pieces[0].max = Some(q("2")),
    },
    Forgery {
        name: "piece-twice",
        reason: "Cover.PieceEnd",
        note: "a piece that stands still",
        change: |cover| {
            let piece = set(cover).pieces[0].clone();
            set(cover).pieces.push(piece);
        },
    },
    Forgery {
        name: "window-enlarged",
        reason: "Cover.PieceEnd",
        note: "the certificate's window is wider than the cover",
        change: |cover| cover.window = Window::new(whole(0), Some(whole(10))).unwrap(),
    },
    Forgery {
        name: "root-early",
        reason: "Cover.RootTooEarly",
        note: "a root leaf with variables undecided",
        change: |cover| {
            set(cover).pieces[0].tree = vec![root_node(AROUND_TWO, RootOutcome::Solution)];
        },
    },
];

fn frames(cases: &mut Cases) {
    let problem = one_value();
    let good = cover(&problem, one_value_tree());

    for forgery in FRAMES {
        let name = format!("cover-{}", forgery.name);
        let forged = forgery.of(&good);

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

/// The branches, the splits and the leaves that are no root leaves. The tree is that of
/// `fold_tree`: node 3 closes the support {1}, node 5 the support {0}, node 6 is the root leaf of
/// {0, 1}.
const TREES: [Forgery<Vec<Node>>; 12] = [
    Forgery {
        name: "truncated",
        reason: "Cover.Truncated",
        note: "the last leaf missing",
        change: |tree| {
            tree.pop();
        },
    },
    Forgery {
        name: "trailing",
        reason: "Cover.Trailing",
        note: "a leaf too many",
        change: |tree| tree.push(Node::Open),
    },
    Forgery {
        name: "cut-at-end",
        reason: "Cover.Cut",
        note: "a split at the interval's end",
        change: |tree| tree.insert(0, Node::Split(q("15/8"))),
    },
    Forgery {
        name: "branch-twice",
        reason: "Cover.Branch",
        note: "a variable decided twice",
        change: |tree| tree[1] = Node::Branch(0),
    },
    Forgery {
        name: "branch-nowhere",
        reason: "Cover.Branch",
        note: "a variable that is none",
        change: |tree| tree[0] = Node::Branch(2),
    },
    Forgery {
        name: "farkas-short",
        reason: "Cover.Length",
        note: "a weight missing",
        change: |tree| tree[3] = farkas(&[1]),
    },
    Forgery {
        name: "farkas-negative",
        reason: "Cover.NegativeWeight",
        note: "a negative weight off the moving set",
        change: |tree| tree[3] = farkas(&[-1, 1]),
    },
    Forgery {
        name: "farkas-sign",
        reason: "Cover.NotNegative",
        note: "w'T > 0",
        change: |tree| tree[3] = farkas(&[0, -1]),
    },
    Forgery {
        name: "farkas-zero",
        reason: "Cover.NotStrict",
        note: "w = 0 proves nothing",
        change: |tree| tree[3] = farkas(&[0, 0]),
    },
    Forgery {
        name: "definite-sign",
        reason: "Cover.NotDefinite",
        note: "negative called positive definite",
        change: |tree| tree[3] = Node::PositiveDefinite,
    },
    Forgery {
        name: "branch-hidden",
        reason: "Cover.NotNegative",
        note: "a region closed by another region's reason",
        change: |tree| tree[5] = farkas(&[1, 0]),
    },
    Forgery {
        name: "tail-without-condensation",
        reason: "Cover.Hypothesis",
        note: "no tail is proved",
        change: |tree| tree[6] = Node::Tail,
    },
];

fn trees(cases: &mut Cases) {
    let problem = one_value();
    let good = one_value_tree();

    for forgery in TREES {
        let name = format!("cover-{}", forgery.name);
        let forged = cover(&problem, forgery.of(&good));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

/// The root leaf: its witness, its interval, its outcome.
const ROOTS: [Forgery<Root>; 13] = [
    Forgery {
        name: "pivot",
        reason: "Cover.Pivot",
        note: "a pivot that is no moving variable",
        change: |root| root.pivot = 2,
    },
    Forgery {
        name: "inverse-zero",
        reason: "Cover.NotRegular",
        note: "Y = 0",
        change: |root| root.inverse = vec![vec![Integer::from(0)]],
    },
    Forgery {
        name: "inverse-short",
        reason: "Cover.Length",
        note: "Y without rows",
        change: |root| root.inverse.clear(),
    },
    Forgery {
        name: "root-coarse",
        reason: "Cover.NotMonotone",
        note: "exact vectors in halves: errors are rounded up to that unit",
        change: |root| {
            root.left = vec![Integer::from(-3)];
            root.right = vec![Integer::from(1)];
            root.exponent = 1;
        },
    },
    Forgery {
        name: "right-off",
        reason: "Cover.NotMonotone",
        note: "v far off",
        change: |root| root.right = vec![Integer::from(40 << 19)],
    },
    Forgery {
        name: "interval-beside",
        reason: "Cover.NoSignChange",
        note: "no value in the interval",
        change: |root| root.interval = [q("33/16"), q("17/8")],
    },
    Forgery {
        name: "interval-point",
        reason: "Cover.Interval",
        note: "an interval of one point",
        change: |root| root.interval[1] = root.interval[0].clone(),
    },
    Forgery {
        name: "interval-outside",
        reason: "Cover.Interval",
        note: "the interval leaves the window",
        change: |root| root.interval[1] = q("9/4"),
    },
    Forgery {
        name: "absent-but-there",
        reason: "Cover.SignChange",
        note: "a solution called absent",
        change: |root| root.outcome = RootOutcome::Absent,
    },
    Forgery {
        name: "negative-x-but-positive",
        reason: "Cover.Sign",
        note: "x_1 > 0 called negative",
        change: |root| root.outcome = RootOutcome::NegativeX(1),
    },
    Forgery {
        name: "negative-y-but-moving",
        reason: "Cover.Sign",
        note: "y_1 = 0 called negative",
        change: |root| root.outcome = RootOutcome::NegativeY(1),
    },
    Forgery {
        name: "claim-missing",
        reason: "Cover.NotTheClaim",
        note: "a claim that does not exist",
        change: |root| root.outcome = RootOutcome::Claim(0),
    },
    Forgery {
        name: "exponent",
        reason: "Cover.TooLarge",
        note: "a small file that asks for much",
        change: |root| root.exponent = 16_385,
    },
];

fn roots(cases: &mut Cases) {
    let problem = one_value();
    let good = fold_root(AROUND_TWO, RootOutcome::Solution);

    for forgery in ROOTS {
        let name = format!("cover-{}", forgery.name);
        let leaf = Node::Root(Box::new(forgery.of(&good)));
        let forged = cover(&problem, fold_tree(leaf));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

/// A solution that lies in two leaves, and a leaf that has two solutions.
fn halves(cases: &mut Cases) {
    let problem = one_value();

    // Neither interval lies where the other one's solution is unique.
    cases.reject(
        "cover-listed-twice",
        "Cover.Ambiguous",
        "one solution or two?",
        &problem,
        &in_both_halves(&problem, ["61/32", "65/32"], ["63/32", "67/32"]),
    );

    cases.accept(
        "cover-twice-the-same",
        "the same solution seen from both sides of a split",
        &problem,
        &in_both_halves(&problem, AROUND_TWO, AROUND_TWO),
    );

    // lambda^2 = 2 and 3 on one support.
    let two_values = fold("15/8", Some("25/8"));
    cases.reject(
        "cover-two-in-one-leaf",
        "Cover.NotMonotone",
        "a leaf that holds two solutions and lists one",
        &two_values,
        &cover(&two_values, one_value_tree()),
    );
}

/// The window is split at 2, and each half lists the solution in an interval of its own.
fn in_both_halves(problem: &Problem, below: [&str; 2], above: [&str; 2]) -> Certificate {
    let mut tree = vec![Node::Split(q("2"))];
    tree.extend(fold_tree(root_node(below, RootOutcome::Solution)));
    tree.extend(fold_tree(root_node(above, RootOutcome::Solution)));
    cover(problem, tree)
}

/// A biactive solution is listed through its claim.
fn claimed(cases: &mut Cases) {
    let problem = pencil(&[&["-1", "5"], &["0", "7"]], I2, &[]);
    let good = completed(&problem);
    assert!(!good.claims.is_empty(), "a claim leaf");
    cases.accept(
        "cover-claim",
        "a biactive solution: the leaf refers to the claim",
        &problem,
        &good,
    );

    let without_claims = Certificate {
        claims: vec![],
        ..good
    };

    cases.reject(
        "cover-claim-removed",
        "Cover.NotTheClaim",
        "the claim a leaf refers to is gone",
        &problem,
        &without_claims,
    );
}

/// A system with free variables, which the certificate eliminates.
fn with_free_variables() -> Problem {
    window(mechanical(Unknown::Mu), "0", Some("4"))
}

/// The hypotheses of the condensation, and the anchors of the pieces.
const CONDENSED: [Forgery<CompleteSet>; 6] = [
    Forgery {
        name: "no-condensation",
        reason: "Cover.Condensation",
        note: "free variables without a condensation",
        change: |set| set.condensation = None,
    },
    Forgery {
        name: "no-sigma",
        reason: "Cover.Hypothesis",
        note: "missing hypothesis: sigma = 0",
        change: |set| condensation(set).sigma = q("0"),
    },
    Forgery {
        name: "sigma-large",
        reason: "Cover.Hypothesis",
        note: "A_ff - sigma I is not semidefinite",
        change: |set| condensation(set).sigma = q("100"),
    },
    Forgery {
        name: "factor-large",
        reason: "Cover.Hypothesis",
        note: "a factor that is too large",
        change: |set| condensation(set).stiffness_factor.rows[0].edit(|row| row[0] *= 1000),
    },
    Forgery {
        name: "no-anchor",
        reason: "Cover.Anchor",
        note: "a piece without its anchor",
        change: |set| {
            for piece in &mut set.pieces {
                piece.anchor = None;
            }
        },
    },
    Forgery {
        name: "anchor-out-of-range",
        reason: "Cover.Anchor",
        note: "anchor 99",
        change: |set| set.pieces[0].anchor = Some(99),
    },
];

fn condensed(cases: &mut Cases) {
    let problem = with_free_variables();
    let good = completed(&problem);
    cases.accept(
        "cover-condensed",
        "free variables eliminated: condensation",
        &problem,
        &good,
    );

    for forgery in CONDENSED {
        let mut forged = good.clone();
        (forgery.change)(set(&mut forged));
        let name = format!("cover-{}", forgery.name);
        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

/// The condensation of one problem in the certificate of another, which has no free variables.
fn idle_condensation(cases: &mut Cases) {
    let condensed = completed(&with_free_variables()).complete_set.unwrap();
    let problem = one_value();

    let mut forged = cover(&problem, one_value_tree());
    set(&mut forged).condensation = condensed.condensation;
    cases.reject(
        "cover-idle-condensation",
        "Cover.Condensation",
        "a condensation with nothing to condense",
        &problem,
        &forged,
    );
}

/// A row of the table of absence: a reason why a region holds nothing, and a forgery of it.
struct Absence {
    name: &'static str,
    accepted: Covered,
    /// The obligation that the forgery breaks.
    reason: &'static str,
    rejected: Covered,
}

/// A problem, the tree of a cover of its window, and what the corpus says about it.
struct Covered {
    note: &'static str,
    problem: Problem,
    tree: Vec<Node>,
}

impl Absence {
    fn push(self, cases: &mut Cases) {
        let Covered {
            note,
            problem,
            tree,
        } = self.accepted;
        let name = format!("absence-{}", self.name);
        cases.accept(&name, note, &problem, &cover(&problem, tree));

        let Covered {
            note,
            problem,
            tree,
        } = self.rejected;
        let name = format!("absence-{}-forged", self.name);
        cases.reject(&name, self.reason, note, &problem, &cover(&problem, tree));
    }
}

/// The table of absence in `spec/certificates.md`, 5.15.
pub fn absence(cases: &mut Cases) {
    let rows = [
        ldl_half_line(),
        ldl_interval(),
        definite(),
        farkas_vector(),
        copositive(),
        p_matrix(),
        no_root(),
        no_solution_at_a_point(),
    ];

    for row in rows {
        row.push(cases);
    }

    near(cases);
}

fn on_unit_interval(a: &[&[&str]], b: &[&[&str]]) -> Problem {
    window(pencil(a, b, &[]), "0", Some("1"))
}

/// L = I and the given pivots.
fn diagonal_factor(pivots: &[&str]) -> LdlFactor {
    factor(&[&[], &["0"]], pivots)
}

fn ldl_half_line() -> Absence {
    let a: &[&[&str]] = &[&["2", "1"], &["-1", "2"]];
    let problem = pencil(a, &[&["1", "2"], &["2", "4"]], &[]);
    let rank_one = factor(&[&[], &["2"]], &["1", "0"]);

    let true_pivots = diagonal_factor(&["2", "2"]);
    let false_pivots = diagonal_factor(&["2", "2.000000000001"]);

    Absence {
        name: "ldl-half-line",
        accepted: Covered {
            note: "(19): K* definite, M* semidefinite of rank one, over [0, infinity)",
            problem: problem.clone(),
            tree: vec![ldl(true_pivots, rank_one.clone())],
        },
        reason: "Cover.Factor",
        rejected: Covered {
            note: "a pivot off by 1e-12",
            problem,
            tree: vec![ldl(false_pivots, rank_one)],
        },
    }
}

/// T = diag(2 - t, 2) is definite below 2.
fn ldl_interval() -> Absence {
    let a: &[&[&str]] = &[&["2", "0"], &["0", "2"]];
    let falling = pencil(a, &[&["-1", "0"], &["0", "0"]], &[]);
    let lower = diagonal_factor(&["2", "2"]);

    let upper_before = diagonal_factor(&["0.000000000001", "2"]);
    let upper_at = diagonal_factor(&["0", "2"]);

    Absence {
        name: "ldl-interval",
        accepted: Covered {
            note: "definite up to 1e-12 before the end of definiteness",
            problem: window(falling.clone(), "0", Some("1.999999999999")),
            tree: vec![ldl(lower.clone(), upper_before)],
        },
        reason: "Cover.NotDefinite",
        rejected: Covered {
            note: "the first value that is not: equality proves nothing",
            problem: window(falling, "0", Some("2")),
            tree: vec![ldl(lower, upper_at)],
        },
    }
}

fn definite() -> Absence {
    Absence {
        name: "definite",
        accepted: Covered {
            note: "positive definite on [0, 1]",
            problem: on_unit_interval(&[&["2", "-1"], &["-1", "2"]], I2),
            tree: vec![Node::PositiveDefinite],
        },
        reason: "Cover.NotDefinite",
        rejected: Covered {
            note: "an indefinite matrix",
            problem: on_unit_interval(&[&["1", "-2"], &["-2", "1"]], I2),
            tree: vec![Node::PositiveDefinite],
        },
    }
}

fn farkas_vector() -> Absence {
    let negative = on_unit_interval(&[&["-1", "-2"], &["-3", "-1"]], ZERO2);
    Absence {
        name: "farkas",
        accepted: Covered {
            note: "u'T < 0",
            problem: negative.clone(),
            tree: vec![farkas(&[1, 1])],
        },
        reason: "Cover.NegativeWeight",
        rejected: Covered {
            note: "a weight below zero",
            problem: negative,
            tree: vec![farkas(&[1, -1])],
        },
    }
}

fn copositive() -> Absence {
    let tree = vec![Node::Branch(0), Node::PositiveDefinite, farkas(&[-1, 0])];
    Absence {
        name: "copositive",
        accepted: Covered {
            note: "strictly copositive, not definite",
            problem: on_unit_interval(&[&["1", "5"], &["5", "1"]], I2),
            tree: tree.clone(),
        },
        reason: "Cover.NotNegative",
        rejected: Covered {
            note: "a negative entry",
            problem: on_unit_interval(&[&["1", "-5"], &["-5", "1"]], I2),
            tree,
        },
    }
}

fn p_matrix() -> Absence {
    let tree = vec![Node::Branch(1), Node::PositiveDefinite, farkas(&[0, -1])];
    Absence {
        name: "p-matrix",
        accepted: Covered {
            note: "a P-matrix, neither definite nor copositive",
            problem: on_unit_interval(&[&["1", "-4"], &["0", "1"]], ZERO2),
            tree: tree.clone(),
        },
        reason: "Cover.NotNegative",
        rejected: Covered {
            note: "det < 0: not P",
            problem: on_unit_interval(&[&["1", "-4"], &["-1", "1"]], ZERO2),
            tree,
        },
    }
}

/// T = t - 1 of one variable.
fn no_root() -> Absence {
    let line = pencil(&[&["-1"]], &[&["1"]], &[]);
    Absence {
        name: "root",
        accepted: Covered {
            note: "no root of the determinant in [2, 3]",
            problem: window(line.clone(), "2", Some("3")),
            tree: without_root(["2", "3"]),
        },
        reason: "Cover.SignChange",
        rejected: Covered {
            note: "a root in [1/2, 3/2]",
            problem: window(line, "1/2", Some("3/2")),
            tree: without_root(["1/2", "3/2"]),
        },
    }
}

/// The tree of one variable, whose root leaf says that no value lies in the interval.
fn without_root(interval: [&str; 2]) -> Vec<Node> {
    let root = Root {
        pivot: 0,
        interval: interval.map(q),
        inverse: vec![],
        inverse_exponent: 0,
        left: vec![],
        right: vec![],
        exponent: 0,
        outcome: RootOutcome::Absent,
    };
    vec![Node::Branch(0), farkas(&[0]), Node::Root(Box::new(root))]
}

fn no_solution_at_a_point() -> Absence {
    let tree = fold_tree(farkas(&[-22, 38]));
    Absence {
        name: "point",
        accepted: Covered {
            note: "lambda^2 = 5/2 is no solution",
            problem: fold("5/2", Some("5/2")),
            tree: tree.clone(),
        },
        reason: "Cover.NotNegative",
        rejected: Covered {
            note: "lambda^2 = 2 is one",
            problem: fold("2", Some("2")),
            tree,
        },
    }
}

/// Absence next to a value, as `complete` proves it.
fn near(cases: &mut Cases) {
    let around = fold("2.25", Some("2.75"));
    cases.accept(
        "absence-near",
        "as `certify --absence-radius` writes it: nothing within 1/4 of 5/2",
        &around,
        &completed(&around),
    );

    let almost_singular = pencil(&[&["1", "-0.999999999999"], &["-1", "1"]], I2, &[]);
    let from_zero = window(almost_singular, "0", Some("1/1000"));
    cases.accept(
        "absence-near-threshold",
        "1e-12 before the threshold: a residual of 1e-12, no solution",
        &from_zero,
        &completed(&from_zero),
    );
}
