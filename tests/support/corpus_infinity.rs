//! Covers that reach to infinity: roots over a chord, null vectors of the limit, reversed anchors; and their forgeries.
#![allow(missing_docs, unreachable_pub)]

use super::corpus::*;
use mceip::certificate::{Certificate, Condensation, Node, Root, RootOutcome};
use mceip::check::check;
use mceip::exact::Integer;
use mceip::model::Problem;

/// The supports {}, {1} and {0} by Farkas vectors where both diagonals of T are positive to infinity, {0, 1} by `leaf`.
fn tree(leaf: Root) -> Vec<Node> {
    let farkas = |w: [i64; 2]| Node::Farkas(w.to_vec());
    vec![Node::Branch(0), Node::Branch(1), farkas([0, 0]), farkas([0, -1]), Node::Branch(1), farkas([-1, 0]), Node::Root(Box::new(leaf))]
}

/// A witness with pivot 1 in units of 2^-20, Y in units of 2^-10.
fn witness(at: &str, y: i64, left: i64, right: i64, outcome: RootOutcome) -> Root {
    Root {
        pivot: 1,
        interval: [q(at), q(at)],
        inverse: vec![vec![Integer::from(y)]],
        inverse_exponent: 10,
        left: vec![Integer::from(left)],
        right: vec![Integer::from(right)],
        exponent: 20,
        outcome,
    }
}

fn integers(list: &[i64]) -> RootOutcome {
    RootOutcome::Infinity(list.iter().map(|&v| Integer::from(v)).collect())
}

pub fn infinity(cases: &mut Cases) {
    chord(cases);
    limit(cases);
    reversed(cases);
}

/// [[1, -6], [2, -6]] + t I has no value on {0, 1} above 3. From 64 on: Y = 1/8, v = 1/16, u = -1/64 (rows over 8).
fn chord(cases: &mut Cases) {
    let p = fold("64", None);
    let absent = |change: &dyn Fn(&mut Root)| {
        let mut root = witness("64", 128, -(1 << 14), 1 << 16, RootOutcome::Absent);
        change(&mut root);
        cover(&p, tree(root))
    };
    cases.accept("infinity-absent", "no value of a support up to infinity: a root leaf over the chord", &p, &absent(&|_| {}));
    let mut no = |name: &str, reason: &str, note: &str, c: &Certificate| cases.reject(&format!("infinity-{name}"), reason, note, &p, c);
    let with = |outcome: RootOutcome| absent(&|r| r.outcome = outcome.clone());
    no("null-vector-none", "Cover.NotAtInfinity", "B = I has no null vector", &with(integers(&[1, 1])));
    no("null-vector-zero", "Cover.NotAtInfinity", "the zero vector is none", &with(integers(&[0, 0])));
    no("null-vector-short", "Cover.Length", "an entry missing", &with(integers(&[1])));
    no("inverse", "Cover.NotRegular", "Y = 0", &absent(&|r| r.inverse = vec![vec![Integer::from(0)]]));
    no(
        "solution",
        "Cover.NoSignChange",
        "a solution where there is none",
        &absent(&|r| {
            (r.interval, r.outcome) = ([q("64"), q("65")], RootOutcome::Solution);
        }),
    );
    let from_zero = fold("0", None);
    let c = cover(&from_zero, tree(witness("0", 128, -(1 << 14), 1 << 16, RootOutcome::Absent)));
    // Farkas vectors fail first: t - 6 and t + 1 begin with the wrong sign or none.
    let mut only = c.clone();
    only.complete_set.as_mut().unwrap().pieces[0].tree[3] = Node::Open;
    cases.reject("infinity-from-zero", "Cover.RootTooEarly", "a chord from t = 0 to infinity", &from_zero, &only);
}

/// I + t [[1, -1], [-1, 1]] from 4 on: x = (1, 1) is a null vector at infinity and nowhere before.
fn limit(cases: &mut Cases) {
    let all = pencil(&[&["1", "0"], &["0", "1"]], &[&["1", "-1"], &["-1", "1"]], &[]);
    let p = window(all, "4", None);
    let nine_tenths = 943_718; // of 2^20
    let leaf = |outcome: RootOutcome| witness("4", 448, nine_tenths, nine_tenths, outcome);
    let good = cover(&p, tree(leaf(integers(&[1, 1]))));
    cases.accept(
        "infinity-limit",
        "a solution at infinity is none in [4, infinity): the only null vector of the chord is its limit",
        &p,
        &good,
    );
    let mut no = |name: &str, reason: &str, note: &str, outcome: RootOutcome| {
        cases.reject(&format!("infinity-{name}"), reason, note, &p, &cover(&p, tree(leaf(outcome))));
    };
    no("limit-absent", "Cover.SignChange", "the Schur complement vanishes at infinity", RootOutcome::Absent);
    no("limit-other-vector", "Cover.NotAtInfinity", "B x is not zero", integers(&[1, 2]));
    let finite = fold("64", Some("80"));
    let c = cover(&finite, tree(witness("64", 128, -(1 << 14), 1 << 16, integers(&[1, 1]))));
    cases.reject("infinity-not-there", "Cover.NotAtInfinity", "a region that ends at 80", &finite, &c);
}

/// One free variable and an indefinite mass of the other two: from the frequency of the free one on by a reversed anchor.
fn reversed(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["4", "1", "-1"], &["1", "3", "0"], &["-1", "1", "2"]];
    let p: Problem = pencil(a, &[&["1", "0", "1"], &["0", "1", "3"], &["1", "3", "1"]], &[0]);
    let good = completed(&p);
    let set = good.complete_set.as_ref().unwrap();
    let anchor = set.condensation.as_ref().unwrap().anchors.iter().position(|a| a.reversed).unwrap();
    assert!(set.pieces.last().is_some_and(|piece| piece.anchor == Some(anchor)), "the last piece is reversed");
    cases.accept("infinity-reversed", "an indefinite mass: closed to infinity by an expansion of B + sA", &p, &good);
    let mut no = |name: &str, note: &str, change: &dyn Fn(&mut Certificate)| {
        let mut c = good.clone();
        change(&mut c);
        let reason = check(&p, &c).unwrap_err().reason.name();
        cases.reject(&format!("infinity-{name}"), &reason, note, &p, &c);
    };
    fn condensation(c: &mut Certificate) -> &mut Condensation {
        c.complete_set.as_mut().unwrap().condensation.as_mut().unwrap()
    }
    no("reversed-without-mass", "a reversed anchor needs mass_sigma > 0", &|c| condensation(c).mass_sigma = q("0"));
    no("reversed-at-zero", "s = 1 / t at t = 0", &|c| {
        let piece = &mut c.complete_set.as_mut().unwrap().pieces[0];
        (piece.anchor, piece.tree) = (Some(anchor), vec![Node::PositiveDefinite]);
    });
    no("reversed-forth", "the expansion of B + sA taken for one of A + tB", &|c| condensation(c).anchors[anchor].reversed = false);
    no("reversed-center", "an expansion about another value", &|c| condensation(c).anchors[anchor].center = q("1000"));
}
