//! Complete sets and absence: what is accepted, and a forgery of each fault of
//! `crates/check/src/cover/fault.rs`.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Certificate, CompleteSet, Node, Root, RootOutcome};
use mceip_exact::{Integer, whole};
use mceip_model::{Problem, Unknown, Window};

fn farkas(w: &[i64]) -> Node {
    Node::Farkas(w.to_vec())
}

fn set(c: &mut Certificate) -> &mut CompleteSet {
    c.complete_set.as_mut().unwrap()
}

const AROUND: (&str, &str) = ("31/16", "33/16");

/// V = 0 for F^-1 T_sf': the remainder l' F^-1 r is wider and still small enough. Rejected by
/// `spec/checker.py` until 2026-11-22 (spec/certificate-errata.md).
pub fn without_left_coefficients(cases: &mut Cases) {
    let p = window(
        pencil(
            &[&["5", "4"], &["4", "6"]],
            &[&["0", "0"], &["0", "1"]],
            &[0],
        ),
        "1/7",
        Some("8"),
    );
    let mut c = completed(&p);
    for anchor in &mut set(&mut c).condensation.as_mut().unwrap().anchors {
        anchor.left.clear();
    }
    let note = "an anchor whose list of left coefficients is empty";
    cases.accept("condensed-no-left-coefficients", note, &p, &c);
}

pub fn covers(cases: &mut Cases) {
    let p = fold("15/8", Some("17/8"));
    let tree = fold_tree(root_node(AROUND, RootOutcome::Solution));
    let good = cover(&p, tree.clone());
    cases.accept(
        "cover",
        "one solution in [15/8, 17/8] and no other, by hand",
        &p,
        &good,
    );
    let all = fold("0", None);
    cases.accept(
        "cover-all",
        "the two solutions of [0, infinity), as `complete` writes it",
        &all,
        &completed(&all),
    );
    let open = cover(&p, vec![Node::Open]);
    let file = serde_json::json!({ "verdict": "undecided", "problem": serde_json::from_str::<serde_json::Value>(&mceip_model::file::write_problem(&p)).unwrap(),
        "certificate": serde_json::from_str::<serde_json::Value>(&open.to_json()).unwrap() });
    cases.push(
        "accept",
        "cover-open",
        file,
        "an open leaf: nothing is wrong, nothing is proved (exit 3)",
    );

    let mut no = |name: &str, reason: &str, note: &str, c: &Certificate| {
        cases.reject(&format!("cover-{name}"), reason, note, &p, c)
    };
    let with_leaf = |leaf: Node| cover(&p, fold_tree(leaf));
    let with = |change: &dyn Fn(&mut Vec<Node>)| {
        let mut t = tree.clone();
        change(&mut t);
        cover(&p, t)
    };
    let root = |change: &dyn Fn(&mut Root)| {
        let mut r = fold_root(AROUND, RootOutcome::Solution);
        change(&mut r);
        with_leaf(Node::Root(Box::new(r)))
    };
    let mut none = good.clone();
    set(&mut none).pieces.clear();
    no(
        "vacuous",
        "Cover.PieceEnd",
        "no piece covers nothing",
        &none,
    );
    no(
        "empty-tree",
        "Cover.Truncated",
        "a piece without a leaf",
        &cover(&p, vec![]),
    );
    let mut short = good.clone();
    set(&mut short).pieces[0].max = Some(q("2"));
    no(
        "half",
        "Cover.PieceEnd",
        "the piece ends inside the window",
        &short,
    );
    let mut twice = good.clone();
    let piece = set(&mut twice).pieces[0].clone();
    set(&mut twice).pieces.push(piece);
    no(
        "piece-twice",
        "Cover.PieceEnd",
        "a piece that stands still",
        &twice,
    );
    let wider = Certificate {
        window: Window::new(whole(0), Some(whole(10))).unwrap(),
        ..good.clone()
    };
    no(
        "window-enlarged",
        "Cover.PieceEnd",
        "the certificate's window is wider than the cover",
        &wider,
    );
    no(
        "truncated",
        "Cover.Truncated",
        "the last leaf missing",
        &with(&|t| drop(t.pop())),
    );
    no(
        "trailing",
        "Cover.Trailing",
        "a leaf too many",
        &with(&|t| t.push(Node::Open)),
    );
    no(
        "cut-at-end",
        "Cover.Cut",
        "a split at the interval's end",
        &with(&|t| t.insert(0, Node::Split(q("15/8")))),
    );
    no(
        "branch-twice",
        "Cover.Branch",
        "a variable decided twice",
        &with(&|t| t[1] = Node::Branch(0)),
    );
    no(
        "branch-nowhere",
        "Cover.Branch",
        "a variable that is none",
        &with(&|t| t[0] = Node::Branch(2)),
    );
    no(
        "farkas-short",
        "Cover.Length",
        "a weight missing",
        &with(&|t| t[3] = farkas(&[1])),
    );
    no(
        "farkas-negative",
        "Cover.NegativeWeight",
        "a negative weight off the moving set",
        &with(&|t| t[3] = farkas(&[-1, 1])),
    );
    no(
        "farkas-sign",
        "Cover.NotNegative",
        "w'T > 0",
        &with(&|t| t[3] = farkas(&[0, -1])),
    );
    no(
        "farkas-zero",
        "Cover.NotStrict",
        "w = 0 proves nothing",
        &with(&|t| t[3] = farkas(&[0, 0])),
    );
    no(
        "definite-sign",
        "Cover.NotDefinite",
        "negative called positive definite",
        &with(&|t| t[3] = Node::PositiveDefinite),
    );
    no(
        "branch-hidden",
        "Cover.NotNegative",
        "a region closed by another region's reason",
        &with(&|t| t[5] = farkas(&[1, 0])),
    );
    no(
        "tail-without-condensation",
        "Cover.Hypothesis",
        "no tail is proved",
        &with(&|t| t[6] = Node::Tail),
    );
    no(
        "root-early",
        "Cover.RootTooEarly",
        "a root leaf with variables undecided",
        &cover(&p, vec![root_node(AROUND, RootOutcome::Solution)]),
    );
    no(
        "pivot",
        "Cover.Pivot",
        "a pivot that is no moving variable",
        &root(&|r| r.pivot = 2),
    );
    no(
        "inverse-zero",
        "Cover.NotRegular",
        "Y = 0",
        &root(&|r| r.inverse = vec![vec![Integer::from(0)]]),
    );
    no(
        "inverse-short",
        "Cover.Length",
        "Y without rows",
        &root(&|r| r.inverse.clear()),
    );
    let coarse = |r: &mut Root| {
        (r.left, r.right, r.exponent) = (vec![Integer::from(-3)], vec![Integer::from(1)], 1)
    };
    no(
        "root-coarse",
        "Cover.NotMonotone",
        "exact vectors in halves: errors are rounded up to that unit",
        &root(&coarse),
    );
    no(
        "right-off",
        "Cover.NotMonotone",
        "v far off",
        &root(&|r| r.right = vec![Integer::from(40 << 19)]),
    );
    no(
        "interval-beside",
        "Cover.NoSignChange",
        "no value in the interval",
        &root(&|r| r.interval = [q("33/16"), q("17/8")]),
    );
    no(
        "interval-point",
        "Cover.Interval",
        "an interval of one point",
        &root(&|r| r.interval[1] = r.interval[0].clone()),
    );
    no(
        "interval-outside",
        "Cover.Interval",
        "the interval leaves the window",
        &root(&|r| r.interval[1] = q("9/4")),
    );
    no(
        "absent-but-there",
        "Cover.SignChange",
        "a solution called absent",
        &root(&|r| r.outcome = RootOutcome::Absent),
    );
    no(
        "negative-x-but-positive",
        "Cover.Sign",
        "x_1 > 0 called negative",
        &root(&|r| r.outcome = RootOutcome::NegativeX(1)),
    );
    no(
        "negative-y-but-moving",
        "Cover.Sign",
        "y_1 = 0 called negative",
        &root(&|r| r.outcome = RootOutcome::NegativeY(1)),
    );
    no(
        "claim-missing",
        "Cover.NotTheClaim",
        "a claim that does not exist",
        &root(&|r| r.outcome = RootOutcome::Claim(0)),
    );
    no(
        "exponent",
        "Cover.TooLarge",
        "a small file that asks for much",
        &root(&|r| r.exponent = 16_385),
    );
    // Two halves that each list the solution, in intervals of which neither lies where the other is
    // unique.
    let halves = |a: (&str, &str), b: (&str, &str)| {
        let half = |i| fold_tree(root_node(i, RootOutcome::Solution));
        cover(&p, [vec![Node::Split(q("2"))], half(a), half(b)].concat())
    };
    no(
        "listed-twice",
        "Cover.Ambiguous",
        "one solution or two?",
        &halves(("61/32", "65/32"), ("63/32", "67/32")),
    );
    cases.accept(
        "cover-twice-the-same",
        "the same solution seen from both sides of a split",
        &p,
        &halves(AROUND, AROUND),
    );
    // lambda^2 = 2 and 3 on one support.
    let both = fold("15/8", Some("25/8"));
    let c = cover(&both, fold_tree(root_node(AROUND, RootOutcome::Solution)));
    cases.reject(
        "cover-two-in-one-leaf",
        "Cover.NotMonotone",
        "a leaf that holds two solutions and lists one",
        &both,
        &c,
    );
    claimed(cases);
    condensed(cases);
}

/// A biactive solution is listed through its claim.
fn claimed(cases: &mut Cases) {
    let p = pencil(&[&["-1", "5"], &["0", "7"]], I2, &[]);
    let good = completed(&p);
    assert!(!good.claims.is_empty(), "a claim leaf");
    cases.accept(
        "cover-claim",
        "a biactive solution: the leaf refers to the claim",
        &p,
        &good,
    );
    let gone = Certificate {
        claims: vec![],
        ..good
    };
    cases.reject(
        "cover-claim-removed",
        "Cover.NotTheClaim",
        "the claim a leaf refers to is gone",
        &p,
        &gone,
    );
}

fn condensed(cases: &mut Cases) {
    let p = window(mechanical(Unknown::Mu), "0", Some("4"));
    let good = completed(&p);
    cases.accept(
        "cover-condensed",
        "free variables eliminated: condensation",
        &p,
        &good,
    );
    let mut no = |name: &str, reason: &str, note: &str, change: &dyn Fn(&mut CompleteSet)| {
        let mut c = good.clone();
        change(set(&mut c));
        cases.reject(&format!("cover-{name}"), reason, note, &p, &c);
    };
    no(
        "no-condensation",
        "Cover.Condensation",
        "free variables without a condensation",
        &|s| s.condensation = None,
    );
    no(
        "no-sigma",
        "Cover.Hypothesis",
        "missing hypothesis: sigma = 0",
        &|s| s.condensation.as_mut().unwrap().sigma = q("0"),
    );
    no(
        "sigma-large",
        "Cover.Hypothesis",
        "A_ff - sigma I is not semidefinite",
        &|s| s.condensation.as_mut().unwrap().sigma = q("100"),
    );
    no(
        "factor-large",
        "Cover.Hypothesis",
        "a factor that is too large",
        &|s| {
            s.condensation.as_mut().unwrap().stiffness_factor.rows[0][0] *= 1000;
        },
    );
    no(
        "no-anchor",
        "Cover.Anchor",
        "a piece without its anchor",
        &|s| s.pieces.iter_mut().for_each(|p| p.anchor = None),
    );
    no("anchor-out-of-range", "Cover.Anchor", "anchor 99", &|s| {
        s.pieces[0].anchor = Some(99)
    });
    let condensation = good.complete_set.as_ref().unwrap().condensation.clone();
    let plain = fold("15/8", Some("17/8"));
    let mut c = cover(&plain, fold_tree(root_node(AROUND, RootOutcome::Solution)));
    set(&mut c).condensation = condensation;
    cases.reject(
        "cover-idle-condensation",
        "Cover.Condensation",
        "a condensation with nothing to condense",
        &plain,
        &c,
    );
}

/// The table of absence in `spec/certificates.md`, 5.15.
pub fn absence(cases: &mut Cases) {
    let unit = |a: &[&[&str]], b: &[&[&str]]| window(pencil(a, b, &[]), "0", Some("1"));
    let mut pair = |name: &str,
                    note: &str,
                    good: (&Problem, Vec<Node>),
                    reason: &str,
                    why: &str,
                    bad: (&Problem, Vec<Node>)| {
        cases.accept(
            &format!("absence-{name}"),
            note,
            good.0,
            &cover(good.0, good.1),
        );
        cases.reject(
            &format!("absence-{name}-forged"),
            reason,
            why,
            bad.0,
            &cover(bad.0, bad.1),
        );
    };
    let a: &[&[&str]] = &[&["2", "1"], &["-1", "2"]];
    let half_line = pencil(a, &[&["1", "2"], &["2", "4"]], &[]);
    let identity = |d: &[&str]| factor(&[&[], &["0"]], d);
    let rank_one = factor(&[&[], &["2"]], &["1", "0"]);
    let whole_line = vec![ldl(identity(&["2", "2"]), rank_one.clone())];
    let off = vec![ldl(identity(&["2", "2.000000000001"]), rank_one)];
    pair(
        "ldl-half-line",
        "(19): K* definite, M* semidefinite of rank one, over [0, infinity)",
        (&half_line, whole_line),
        "Cover.Factor",
        "a pivot off by 1e-12",
        (&half_line, off),
    );
    let falling = |hi: &str| {
        window(
            pencil(
                &[&["2", "0"], &["0", "2"]],
                &[&["-1", "0"], &["0", "0"]],
                &[],
            ),
            "0",
            Some(hi),
        )
    };
    let (one, two) = (falling("1.999999999999"), falling("2"));
    let at = |d: &str| vec![ldl(identity(&["2", "2"]), identity(&[d, "2"]))];
    pair(
        "ldl-interval",
        "definite up to 1e-12 before the end of definiteness",
        (&one, at("0.000000000001")),
        "Cover.NotDefinite",
        "the first value that is not: equality proves nothing",
        (&two, at("0")),
    );
    let indefinite = unit(&[&["1", "-2"], &["-2", "1"]], I2);
    let definite = unit(&[&["2", "-1"], &["-1", "2"]], I2);
    pair(
        "definite",
        "positive definite on [0, 1]",
        (&definite, vec![Node::PositiveDefinite]),
        "Cover.NotDefinite",
        "an indefinite matrix",
        (&indefinite, vec![Node::PositiveDefinite]),
    );
    let negative = unit(&[&["-1", "-2"], &["-3", "-1"]], ZERO2);
    pair(
        "farkas",
        "u'T < 0",
        (&negative, vec![farkas(&[1, 1])]),
        "Cover.NegativeWeight",
        "a weight below zero",
        (&negative, vec![farkas(&[1, -1])]),
    );
    let copositive = |v: &str| unit(&[&["1", v], &[v, "1"]], I2);
    let (good, bad) = (copositive("5"), copositive("-5"));
    let tree = vec![Node::Branch(0), Node::PositiveDefinite, farkas(&[-1, 0])];
    pair(
        "copositive",
        "strictly copositive, not definite",
        (&good, tree.clone()),
        "Cover.NotNegative",
        "a negative entry",
        (&bad, tree),
    );
    let p_matrix = |v: &str| unit(&[&["1", "-4"], &[v, "1"]], ZERO2);
    let (good, bad) = (p_matrix("0"), p_matrix("-1"));
    let tree = vec![Node::Branch(1), Node::PositiveDefinite, farkas(&[0, -1])];
    pair(
        "p-matrix",
        "a P-matrix, neither definite nor copositive",
        (&good, tree.clone()),
        "Cover.NotNegative",
        "det < 0: not P",
        (&bad, tree),
    );
    let line = |lo: &str, hi: &str| window(pencil(&[&["-1"]], &[&["1"]], &[]), lo, Some(hi));
    let (good, bad) = (line("2", "3"), line("1/2", "3/2"));
    let absent = |lo: &str, hi: &str| {
        let none = Vec::new;
        let interval = [q(lo), q(hi)];
        let root = Root {
            pivot: 0,
            interval,
            inverse: vec![],
            inverse_exponent: 0,
            left: none(),
            right: none(),
            exponent: 0,
            outcome: RootOutcome::Absent,
        };
        vec![Node::Branch(0), farkas(&[0]), Node::Root(Box::new(root))]
    };
    pair(
        "root",
        "no root of the determinant in [2, 3]",
        (&good, absent("2", "3")),
        "Cover.SignChange",
        "a root in [1/2, 3/2]",
        (&bad, absent("1/2", "3/2")),
    );
    let point = fold("5/2", Some("5/2"));
    let at_two = fold("2", Some("2"));
    let tree = || fold_tree(farkas(&[-22, 38]));
    pair(
        "point",
        "lambda^2 = 5/2 is no solution",
        (&point, tree()),
        "Cover.NotNegative",
        "lambda^2 = 2 is one",
        (&at_two, tree()),
    );
    let near = fold("2.25", Some("2.75"));
    cases.accept(
        "absence-near",
        "as `certify --absence-radius` writes it: nothing within 1/4 of 5/2",
        &near,
        &completed(&near),
    );
    let zero = window(
        pencil(&[&["1", "-0.999999999999"], &["-1", "1"]], I2, &[]),
        "0",
        Some("1/1000"),
    );
    cases.accept(
        "absence-near-threshold",
        "1e-12 before the threshold: a residual of 1e-12, no solution",
        &zero,
        &completed(&zero),
    );
}
