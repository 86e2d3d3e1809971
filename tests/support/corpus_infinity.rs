//! Covers that reach to infinity: roots over a chord, null vectors of the limit, reversed anchors;
//! and their forgeries.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Certificate, Condensation, Node, Root, RootOutcome};
use mceip_check::check;
use mceip_exact::Integer;
use mceip_model::Problem;

/// The supports {}, {1} and {0} by Farkas vectors where both diagonals of T are positive to
/// infinity, {0, 1} by `leaf`.
fn tree(leaf: Root) -> Vec<Node> {
    let farkas = |w: [i64; 2]| Node::Farkas(w.to_vec());
    vec![
        Node::Branch(0),
        Node::Branch(1),
        farkas([0, 0]),
        farkas([0, -1]),
        Node::Branch(1),
        farkas([-1, 0]),
        Node::Root(Box::new(leaf)),
    ]
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
    scales(cases);
}

/// A witness for a support of one variable: no inverse, no vectors.
fn alone(pivot: usize, [a, b]: [&str; 2], outcome: RootOutcome) -> Root {
    Root {
        pivot,
        interval: [q(a), q(b)],
        inverse: Vec::new(),
        inverse_exponent: 0,
        left: Vec::new(),
        right: Vec::new(),
        exponent: 0,
        outcome,
    }
}

/// Half lines from a value with a denominator. Between 792fd1c and the mending the checker forgot
/// that denominator at the infinite end, and looked for the sign change of a narrow interval at a
/// wrong place (spec/certificate-errata.md).
fn scales(cases: &mut Cases) {
    let six = pencil(&[&["-6"]], &[&["1"]], &[]);
    let tree = |leaf: Root| {
        vec![
            Node::Branch(0),
            Node::Farkas(vec![0]),
            Node::Root(Box::new(leaf)),
        ]
    };

    let from_thousandth = window(six.clone(), "1/1000", None);
    for (name, interval, note) in [
        (
            "scale-forged",
            ["5000", "7000"],
            "the only solution is 6; this leaf used to be accepted",
        ),
        (
            "scale-true",
            ["5", "7"],
            "true, but an outcome that is not read over a half line",
        ),
    ] {
        let c = cover(
            &from_thousandth,
            tree(alone(0, interval, RootOutcome::Solution)),
        );
        cases.reject(
            &format!("infinity-{name}"),
            "Cover.OutcomeOnHalfLine",
            note,
            &from_thousandth,
            &c,
        );
    }
    let negative = cover(
        &from_thousandth,
        tree(alone(0, ["5", "7"], RootOutcome::NegativeY(0))),
    );
    let note = "negative_y is not read over a half line";
    cases.reject(
        "infinity-scale-negative-y",
        "Cover.OutcomeOnHalfLine",
        note,
        &from_thousandth,
        &negative,
    );

    let above = window(six.clone(), "13/2", None);
    let absent = cover(
        &above,
        tree(alone(0, ["13/2", "13/2"], RootOutcome::Absent)),
    );
    cases.accept(
        "infinity-scale-absent",
        "no value from 13/2 on: t - 6 is positive",
        &above,
        &absent,
    );
    let below = window(six, "11/2", None);
    let absent = cover(
        &below,
        tree(alone(0, ["11/2", "11/2"], RootOutcome::Absent)),
    );
    let note = "t - 6 changes its sign above 11/2";
    cases.reject(
        "infinity-scale-absent-below",
        "Cover.SignChange",
        note,
        &below,
        &absent,
    );

    two_particles(cases);
}

/// Fig. 1 with mu = 8, S = (+1, -1): slip-stick at 62/25. The half line from 1/1000 holds it for
/// the support {0}.
fn two_particles(cases: &mut Cases) {
    let text = include_str!("../../spec/examples/two-particles.json");
    let given = mceip_model::file::read_problem(text, std::path::Path::new(".")).unwrap();
    let problem = window(given, "1/1000", None);
    let tree = |leaf: Root| {
        vec![
            Node::Branch(0),
            Node::Open,
            Node::Branch(1),
            Node::Root(Box::new(leaf)),
            Node::Open,
        ]
    };

    let forged = cover(
        &problem,
        tree(alone(0, ["2000", "3000"], RootOutcome::Solution)),
    );
    let note = "slip-stick is at 62/25; this leaf used to be accepted";
    cases.reject(
        "infinity-scale-two-particles",
        "Cover.OutcomeOnHalfLine",
        note,
        &problem,
        &forged,
    );

    let pencil = mceip_model::reduction::reduce(&problem).unwrap().pencil;
    let candidate = mceip_engine::candidate::Candidate {
        value: 2.48,
        x: vec![1.0, 0.0],
    };
    let claim = mceip_engine::certify::certify(&problem, &pencil, &candidate).unwrap();
    let with_claim = |interval: [&str; 2]| {
        let mut c = cover(&problem, tree(alone(0, interval, RootOutcome::Claim(0))));
        c.claims.push(claim.clone());
        c
    };

    let note = "slip-stick by a claim, over a half line from 1/1000; the other supports open";
    cases.undecided(
        "infinity-scale-claim",
        note,
        &problem,
        &with_claim(["2", "3"]),
    );
    let note = "the claim's value is not in the interval";
    cases.reject(
        "infinity-scale-claim-elsewhere",
        "Cover.NotTheClaim",
        note,
        &problem,
        &with_claim(["2000", "3000"]),
    );
}

/// [[1, -6], [2, -6]] + t I has no value on {0, 1} above 3. From 64 on: Y = 1/8, v = 1/16, u =
/// -1/64 (rows over 8).
fn chord(cases: &mut Cases) {
    let p = fold("64", None);
    let absent = |change: &dyn Fn(&mut Root)| {
        let mut root = witness("64", 128, -(1 << 14), 1 << 16, RootOutcome::Absent);
        change(&mut root);
        cover(&p, tree(root))
    };
    cases.accept(
        "infinity-absent",
        "no value of a support up to infinity: a root leaf over the chord",
        &p,
        &absent(&|_| {}),
    );
    let mut no = |name: &str, reason: &str, note: &str, c: &Certificate| {
        cases.reject(&format!("infinity-{name}"), reason, note, &p, c)
    };
    let with = |outcome: RootOutcome| absent(&|r| r.outcome = outcome.clone());
    no(
        "null-vector-none",
        "Cover.NotAtInfinity",
        "B = I has no null vector",
        &with(integers(&[1, 1])),
    );
    no(
        "null-vector-zero",
        "Cover.NotAtInfinity",
        "the zero vector is none",
        &with(integers(&[0, 0])),
    );
    no(
        "null-vector-short",
        "Cover.Length",
        "an entry missing",
        &with(integers(&[1])),
    );
    no(
        "inverse",
        "Cover.NotRegular",
        "Y = 0",
        &absent(&|r| r.inverse = vec![vec![Integer::from(0)]]),
    );
    no(
        "solution",
        "Cover.OutcomeOnHalfLine",
        "a solution where there is none",
        &absent(&|r| {
            (r.interval, r.outcome) = ([q("64"), q("65")], RootOutcome::Solution);
        }),
    );
    let from_zero = fold("0", None);
    let c = cover(
        &from_zero,
        tree(witness("0", 128, -(1 << 14), 1 << 16, RootOutcome::Absent)),
    );
    // Farkas vectors fail first: t - 6 and t + 1 begin with the wrong sign or none.
    let mut only = c.clone();
    only.complete_set.as_mut().unwrap().pieces[0].tree[3] = Node::Open;
    cases.reject(
        "infinity-from-zero",
        "Cover.RootTooEarly",
        "a chord from t = 0 to infinity",
        &from_zero,
        &only,
    );
}

/// I + t [[1, -1], [-1, 1]] from 4 on: x = (1, 1) is a null vector at infinity and nowhere before.
fn limit(cases: &mut Cases) {
    let all = pencil(
        &[&["1", "0"], &["0", "1"]],
        &[&["1", "-1"], &["-1", "1"]],
        &[],
    );
    let p = window(all, "4", None);
    let nine_tenths = 943_718; // of 2^20
    let leaf = |outcome: RootOutcome| witness("4", 448, nine_tenths, nine_tenths, outcome);
    let good = cover(&p, tree(leaf(integers(&[1, 1]))));
    cases.accept(
        "infinity-limit",
        "a solution at infinity is none in [4, infinity): the only null vector of the chord is its \
         limit",
        &p,
        &good,
    );
    let mut no = |name: &str, reason: &str, note: &str, outcome: RootOutcome| {
        cases.reject(
            &format!("infinity-{name}"),
            reason,
            note,
            &p,
            &cover(&p, tree(leaf(outcome))),
        );
    };
    no(
        "limit-absent",
        "Cover.SignChange",
        "the Schur complement vanishes at infinity",
        RootOutcome::Absent,
    );
    no(
        "limit-other-vector",
        "Cover.NotAtInfinity",
        "B x is not zero",
        integers(&[1, 2]),
    );
    let finite = fold("64", Some("80"));
    let c = cover(
        &finite,
        tree(witness("64", 128, -(1 << 14), 1 << 16, integers(&[1, 1]))),
    );
    cases.reject(
        "infinity-not-there",
        "Cover.NotAtInfinity",
        "a region that ends at 80",
        &finite,
        &c,
    );
}

/// One free variable and an indefinite mass of the other two: from the frequency of the free one on
/// by a reversed anchor.
fn reversed(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["4", "1", "-1"], &["1", "3", "0"], &["-1", "1", "2"]];
    let p: Problem = pencil(
        a,
        &[&["1", "0", "1"], &["0", "1", "3"], &["1", "3", "1"]],
        &[0],
    );
    let good = completed(&p);
    let set = good.complete_set.as_ref().unwrap();
    let anchor = set
        .condensation
        .as_ref()
        .unwrap()
        .anchors
        .iter()
        .position(|a| a.reversed)
        .unwrap();
    assert!(
        set.pieces
            .last()
            .is_some_and(|piece| piece.anchor == Some(anchor)),
        "the last piece is reversed"
    );
    cases.accept(
        "infinity-reversed",
        "an indefinite mass: closed to infinity by an expansion of B + sA",
        &p,
        &good,
    );
    let mut no = |name: &str, note: &str, change: &dyn Fn(&mut Certificate)| {
        let mut c = good.clone();
        change(&mut c);
        let reason = check(&p, &c).unwrap_err().reason.name();
        cases.reject(&format!("infinity-{name}"), &reason, note, &p, &c);
    };
    fn condensation(c: &mut Certificate) -> &mut Condensation {
        c.complete_set
            .as_mut()
            .unwrap()
            .condensation
            .as_mut()
            .unwrap()
    }
    no(
        "reversed-without-mass",
        "a reversed anchor needs mass_sigma > 0",
        &|c| condensation(c).mass_sigma = q("0"),
    );
    no("reversed-at-zero", "s = 1 / t at t = 0", &|c| {
        let piece = &mut c.complete_set.as_mut().unwrap().pieces[0];
        (piece.anchor, piece.tree) = (Some(anchor), vec![Node::PositiveDefinite]);
    });
    no(
        "reversed-forth",
        "the expansion of B + sA taken for one of A + tB",
        &|c| condensation(c).anchors[anchor].reversed = false,
    );
    no(
        "reversed-center",
        "an expansion about another value",
        &|c| condensation(c).anchors[anchor].center = q("1000"),
    );
}
