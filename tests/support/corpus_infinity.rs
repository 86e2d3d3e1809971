//! Covers that reach to infinity: roots over a chord, null vectors of the limit, reversed anchors;
//! and their forgeries.
//!
//! For t in [a, infinity), A + t B is a positive multiple of a matrix on the chord from A + a B to
//! B, and a root leaf over the half line is judged on that chord. The pencils have one or two
//! variables, so that values and null vectors are known by hand; the covers of `reversed` are
//! written by `complete`.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{Certificate, Claim, Condensation, Node, Root, RootOutcome};
use mceip_check::check;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::certify;
use mceip_exact::Integer;
use mceip_model::Problem;
use mceip_model::file::read_problem;
use mceip_model::reduction::reduce;
use std::path::Path;

pub fn infinity(cases: &mut Cases) {
    chord(cases);
    chord_from_zero(cases);
    limit(cases);
    limit_of_a_finite_region(cases);
    reversed(cases);
    scales(cases);
    two_particles(cases);
}

/// The supports {}, {1} and {0} by Farkas vectors where both diagonals of T are positive to
/// infinity, {0, 1} by `leaf`.
fn two_variables(leaf: Root) -> Vec<Node> {
    vec![
        Node::Branch(0),
        Node::Branch(1),
        farkas(&[0, 0]),
        farkas(&[0, -1]),
        Node::Branch(1),
        farkas(&[-1, 0]),
        Node::Root(Box::new(leaf)),
    ]
}

/// The witness of a root leaf with two moving variables, of which 1 is the pivot.
struct Witness {
    at: &'static str,
    /// In units of 2^-10.
    inverse: i64,
    /// In units of 2^-20.
    left: i64,
    /// In units of 2^-20.
    right: i64,
}

impl Witness {
    fn root(&self, outcome: RootOutcome) -> Root {
        Root {
            pivot: 1,
            interval: [q(self.at), q(self.at)],
            inverse: vec![vec![Integer::from(self.inverse)]],
            inverse_exponent: 10,
            left: vec![Integer::from(self.left)],
            right: vec![Integer::from(self.right)],
            exponent: 20,
            outcome,
        }
    }
}

/// The outcome "x is the null vector at infinity".
fn null_vector(x: &[i64]) -> RootOutcome {
    let components = x.iter().map(|&component| Integer::from(component));
    RootOutcome::Infinity(components.collect())
}

/// [[1, -6], [2, -6]] + t I has no value on {0, 1} above 3. From 64 on: Y = 1/8, v = 1/16, u =
/// -1/64 (rows over 8).
const FOLD_WITNESS: Witness = Witness {
    at: "64",
    inverse: 1 << 7,
    left: -(1 << 14),
    right: 1 << 16,
};

/// Changes of the root leaf that says "absent" of [64, infinity).
const CHORDS: [Forgery<Root>; 5] = [
    Forgery {
        name: "null-vector-none",
        reason: "Cover.NotAtInfinity",
        note: "B = I has no null vector",
        change: |root| root.outcome = null_vector(&[1, 1]),
    },
    Forgery {
        name: "null-vector-zero",
        reason: "Cover.NotAtInfinity",
        note: "the zero vector is none",
        change: |root| root.outcome = null_vector(&[0, 0]),
    },
    Forgery {
        name: "null-vector-short",
        reason: "Cover.Length",
        note: "an entry missing",
        change: |root| root.outcome = null_vector(&[1]),
    },
    Forgery {
        name: "inverse",
        reason: "Cover.NotRegular",
        note: "Y = 0",
        change: |root| root.inverse = vec![vec![Integer::from(0)]],
    },
    Forgery {
        name: "solution",
        reason: "Cover.OutcomeOnHalfLine",
        note: "a solution where there is none",
        change: |root| {
            root.interval = [q("64"), q("65")];
            root.outcome = RootOutcome::Solution;
        },
    },
];

fn chord(cases: &mut Cases) {
    let problem = fold("64", None);
    let good = FOLD_WITNESS.root(RootOutcome::Absent);
    cases.accept(
        "infinity-absent",
        "no value of a support up to infinity: a root leaf over the chord",
        &problem,
        &cover(&problem, two_variables(good.clone())),
    );

    for forgery in CHORDS {
        let name = format!("infinity-{}", forgery.name);
        let forged = cover(&problem, two_variables(forgery.of(&good)));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

/// From zero the Farkas vectors fail first, because t - 6 and t + 1 begin with the wrong sign or
/// none: the first of them is left open.
fn chord_from_zero(cases: &mut Cases) {
    let problem = fold("0", None);
    let witness = Witness {
        at: "0",
        ..FOLD_WITNESS
    };

    let mut tree = two_variables(witness.root(RootOutcome::Absent));
    tree[3] = Node::Open;
    cases.reject(
        "infinity-from-zero",
        "Cover.RootTooEarly",
        "a chord from t = 0 to infinity",
        &problem,
        &cover(&problem, tree),
    );
}

/// 9/10 in units of 2^-20.
const NINE_TENTHS: i64 = 943_718;

/// The witness of I + t [[1, -1], [-1, 1]] from 4 on.
const LIMIT_WITNESS: Witness = Witness {
    at: "4",
    inverse: 448,
    left: NINE_TENTHS,
    right: NINE_TENTHS,
};

/// Changes of the leaf that says "(1, 1) at infinity".
const LIMITS: [Forgery<Root>; 2] = [
    Forgery {
        name: "limit-absent",
        reason: "Cover.SignChange",
        note: "the Schur complement vanishes at infinity",
        change: |root| root.outcome = RootOutcome::Absent,
    },
    Forgery {
        name: "limit-other-vector",
        reason: "Cover.NotAtInfinity",
        note: "B x is not zero",
        change: |root| root.outcome = null_vector(&[1, 2]),
    },
];

/// I + t [[1, -1], [-1, 1]] from 4 on: x = (1, 1) is a null vector at infinity and nowhere before.
fn limit(cases: &mut Cases) {
    let all = pencil(I2, &[&["1", "-1"], &["-1", "1"]], &[]);
    let problem = window(all, "4", None);
    let good = LIMIT_WITNESS.root(null_vector(&[1, 1]));
    cases.accept(
        "infinity-limit",
        "a solution at infinity is none in [4, infinity): the only null vector of the chord is its \
         limit",
        &problem,
        &cover(&problem, two_variables(good.clone())),
    );

    for forgery in LIMITS {
        let name = format!("infinity-{}", forgery.name);
        let forged = cover(&problem, two_variables(forgery.of(&good)));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

fn limit_of_a_finite_region(cases: &mut Cases) {
    let problem = fold("64", Some("80"));
    let leaf = FOLD_WITNESS.root(null_vector(&[1, 1]));
    cases.reject(
        "infinity-not-there",
        "Cover.NotAtInfinity",
        "a region that ends at 80",
        &problem,
        &cover(&problem, two_variables(leaf)),
    );
}

fn condensation(certificate: &mut Certificate) -> &mut Condensation {
    set(certificate).condensation.as_mut().unwrap()
}

/// One free variable and an indefinite mass of the other two: from the frequency of the free one on
/// by a reversed anchor.
fn reversed(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["4", "1", "-1"], &["1", "3", "0"], &["-1", "1", "2"]];
    let b: &[&[&str]] = &[&["1", "0", "1"], &["0", "1", "3"], &["1", "3", "1"]];
    let problem = pencil(a, b, &[0]);
    let good = completed(&problem);
    let anchor = reversed_anchor(&good);

    cases.accept(
        "infinity-reversed",
        "an indefinite mass: closed to infinity by an expansion of B + sA",
        &problem,
        &good,
    );

    let mut without_mass = good.clone();
    condensation(&mut without_mass).mass_sigma = q("0");
    reject_reversed(
        cases,
        "without-mass",
        "a reversed anchor needs mass_sigma > 0",
        &problem,
        &without_mass,
    );

    let mut at_zero = good.clone();
    let first_piece = &mut set(&mut at_zero).pieces[0];
    first_piece.anchor = Some(anchor);
    first_piece.tree = vec![Node::PositiveDefinite];
    reject_reversed(cases, "at-zero", "s = 1 / t at t = 0", &problem, &at_zero);

    let mut forth = good.clone();
    condensation(&mut forth).anchors[anchor].reversed = false;
    reject_reversed(
        cases,
        "forth",
        "the expansion of B + sA taken for one of A + tB",
        &problem,
        &forth,
    );

    let mut other_center = good;
    condensation(&mut other_center).anchors[anchor].center = q("1000");
    reject_reversed(
        cases,
        "center",
        "an expansion about another value",
        &problem,
        &other_center,
    );
}

/// The reversed anchor, which is that of the last piece.
fn reversed_anchor(certificate: &Certificate) -> usize {
    let set = certificate.complete_set.as_ref().unwrap();
    let anchors = &set.condensation.as_ref().unwrap().anchors;
    let anchor = anchors.iter().position(|anchor| anchor.reversed).unwrap();

    let last_piece = set.pieces.last().unwrap();
    assert_eq!(
        last_piece.anchor,
        Some(anchor),
        "the last piece is reversed"
    );
    anchor
}

/// The reason is the one that our checker gives: which leaf fails first depends on what `complete`
/// has written.
fn reject_reversed(
    cases: &mut Cases,
    name: &str,
    note: &str,
    problem: &Problem,
    forged: &Certificate,
) {
    let reason = check(problem, forged).unwrap_err().reason.name();
    let name = format!("infinity-reversed-{name}");
    cases.reject(&name, &reason, note, problem, forged);
}

/// A witness for a support of one variable: no inverse, no vectors.
fn alone(interval: [&str; 2], outcome: RootOutcome) -> Root {
    Root {
        pivot: 0,
        interval: interval.map(q),
        inverse: Vec::new(),
        inverse_exponent: 0,
        left: Vec::new(),
        right: Vec::new(),
        exponent: 0,
        outcome,
    }
}

/// t - 6 on [min, infinity).
fn six_from(min: &str) -> Problem {
    window(pencil(&[&["-6"]], &[&["1"]], &[]), min, None)
}

/// A cover of one variable, which either rests or is decided by a root leaf.
fn one_variable(problem: &Problem, interval: [&str; 2], outcome: RootOutcome) -> Certificate {
    let leaf = Node::Root(Box::new(alone(interval, outcome)));
    cover(problem, vec![Node::Branch(0), farkas(&[0]), leaf])
}

/// Half lines from a value with a denominator. Between 792fd1c and the mending the checker forgot
/// that denominator at the infinite end, and looked for the sign change of a narrow interval at a
/// wrong place (spec/certificate-errata.md).
fn scales(cases: &mut Cases) {
    let from_thousandth = six_from("1/1000");
    cases.reject(
        "infinity-scale-forged",
        "Cover.OutcomeOnHalfLine",
        "the only solution is 6; this leaf used to be accepted",
        &from_thousandth,
        &one_variable(&from_thousandth, ["5000", "7000"], RootOutcome::Solution),
    );

    cases.reject(
        "infinity-scale-true",
        "Cover.OutcomeOnHalfLine",
        "true, but an outcome that is not read over a half line",
        &from_thousandth,
        &one_variable(&from_thousandth, ["5", "7"], RootOutcome::Solution),
    );

    cases.reject(
        "infinity-scale-negative-y",
        "Cover.OutcomeOnHalfLine",
        "negative_y is not read over a half line",
        &from_thousandth,
        &one_variable(&from_thousandth, ["5", "7"], RootOutcome::NegativeY(0)),
    );

    let above = six_from("13/2");
    cases.accept(
        "infinity-scale-absent",
        "no value from 13/2 on: t - 6 is positive",
        &above,
        &one_variable(&above, ["13/2", "13/2"], RootOutcome::Absent),
    );

    let below = six_from("11/2");
    cases.reject(
        "infinity-scale-absent-below",
        "Cover.SignChange",
        "t - 6 changes its sign above 11/2",
        &below,
        &one_variable(&below, ["11/2", "11/2"], RootOutcome::Absent),
    );
}

/// A cover that says something of the support {0} and leaves the others open.
fn first_particle(problem: &Problem, interval: [&str; 2], outcome: RootOutcome) -> Certificate {
    let tree = vec![
        Node::Branch(0),
        Node::Open,
        Node::Branch(1),
        Node::Root(Box::new(alone(interval, outcome))),
        Node::Open,
    ];
    cover(problem, tree)
}

/// Fig. 1 with mu = 8, S = (+1, -1): slip-stick at 62/25. The half line from 1/1000 holds it for
/// the support {0}.
fn two_particles(cases: &mut Cases) {
    let text = include_str!("../../spec/examples/two-particles.json");
    let given = read_problem(text, Path::new(".")).unwrap();
    let problem = window(given, "1/1000", None);

    cases.reject(
        "infinity-scale-two-particles",
        "Cover.OutcomeOnHalfLine",
        "slip-stick is at 62/25; this leaf used to be accepted",
        &problem,
        &first_particle(&problem, ["2000", "3000"], RootOutcome::Solution),
    );

    let claim = slip_stick(&problem);
    let mut around = first_particle(&problem, ["2", "3"], RootOutcome::Claim(0));
    around.claims.push(claim.clone());
    cases.undecided(
        "infinity-scale-claim",
        "slip-stick by a claim, over a half line from 1/1000; the other supports open",
        &problem,
        &around,
    );

    let mut elsewhere = first_particle(&problem, ["2000", "3000"], RootOutcome::Claim(0));
    elsewhere.claims.push(claim);
    cases.reject(
        "infinity-scale-claim-elsewhere",
        "Cover.NotTheClaim",
        "the claim's value is not in the interval",
        &problem,
        &elsewhere,
    );
}

/// The claim of the solution at 62/25.
fn slip_stick(problem: &Problem) -> Claim {
    let pencil = reduce(problem).unwrap().pencil;
    let candidate = Candidate {
        value: 2.48,
        x: vec![1.0, 0.0],
    };
    certify(problem, &pencil, &candidate).unwrap()
}
