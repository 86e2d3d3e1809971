//! Absence below a friction (`mceip-critical/1`): accepted files, and forgeries of each obligation.
//!
//! The systems have one or two slip particles and M, K with few entries, so that T(t, mu) can be
//! read off: with S = 1 for all particles T0_pq(t) = (K + tM)_(T_p, T_q) and T1_pq(t) =
//! (K + tM)_(N_p, T_q). Truths are computed by hand or stand in `spec/errata.md`, X9.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::{Cases, Misspelling, fold, problem_json, q};
use mceip_check::certificate::{
    CriticalAnchor, CriticalCertificate, CriticalCondensation, CriticalNode, CriticalPiece,
    CriticalTail, Factor, IntegerMatrix,
};
use mceip_exact::{Integer, Rational, Sparse, parse, rational, whole};
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};
use serde_json::{Value, json};

pub fn critical(cases: &mut Cases) {
    one_particle(cases);
    trees(cases);
    near_the_fold(cases);
    corners(cases);
    with_a_free_variable(cases);
    tails(cases);
    other_problems(cases);
    other_particles(cases);
    malformed(cases);
}

pub fn accept(
    cases: &mut Cases,
    name: &str,
    note: &str,
    problem: &Problem,
    good: &CriticalCertificate,
) {
    let file = json!({
        "verdict": "accepted",
        "problem": problem_json(problem),
        "certificate": json_of(good),
    });
    cases.push("accept", &format!("critical-{name}"), file, note);
}

pub fn reject(
    cases: &mut Cases,
    [name, reason, note]: [&str; 3],
    problem: &Problem,
    forged: &CriticalCertificate,
) {
    let file = json!({
        "verdict": "rejected",
        "reason": reason,
        "problem": problem_json(problem),
        "certificate": json_of(forged),
    });
    cases.push("reject", &format!("critical-{name}"), file, note);
}

fn json_of(certificate: &CriticalCertificate) -> Value {
    serde_json::from_str(&certificate.to_json()).unwrap()
}

/// A system with slip particles (T, N) with S = 1 and the entries (row, column, value) of symmetric
/// matrices, which are given once.
pub fn system(
    dofs: usize,
    particles: &[(usize, usize)],
    stiffness: &[(usize, usize, Rational)],
    mass: &[(usize, usize, Rational)],
) -> Problem {
    let symmetric = |entries: &[(usize, usize, Rational)]| {
        let mut both = Vec::new();
        for (i, j, value) in entries {
            both.push((*i, *j, value.clone()));
            if i != j {
                both.push((*j, *i, value.clone()));
            }
        }
        Sparse::from_entries(dofs, dofs, both)
    };
    let slip = |&(tangential, normal): &(usize, usize)| {
        Particle::plain(tangential, normal, ContactState::Slip { sign: 1 })
    };

    let particles = particles.iter().map(slip).collect();
    let mass = Some(symmetric(mass));
    let system = System::new(symmetric(stiffness), mass, Some(whole(3)), particles).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

pub fn identity(dofs: usize) -> Vec<(usize, usize, Rational)> {
    (0..dofs).map(|i| (i, i, whole(1))).collect()
}

/// T(t, mu) = 1 + t - mu: the critical friction is 1.
pub fn one() -> Problem {
    let stiffness = [(0, 0, whole(1)), (0, 1, whole(-1)), (1, 1, whole(3))];
    system(2, &[(0, 1)], &stiffness, &identity(2))
}

/// The system of X9: T(t, mu) = diag(1, 2) + tI + mu [[0, -3], [1, -4]], with the critical friction
/// 1 + sqrt(3)/2 = 1.8660..., a fold.
pub fn fold_system() -> Problem {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 3, whole(1)),
        (1, 1, whole(2)),
        (1, 2, whole(-3)),
        (1, 3, whole(-4)),
        (2, 2, whole(14)),
        (3, 3, whole(14)),
    ];
    system(4, &[(0, 2), (1, 3)], &stiffness, &identity(4))
}

pub fn piece(max: Option<&str>, tree: Vec<CriticalNode>) -> CriticalPiece {
    CriticalPiece {
        max: max.map(q),
        anchor: None,
        tree,
    }
}

pub fn certificate(
    problem: &Problem,
    below: &str,
    pieces: Vec<CriticalPiece>,
) -> CriticalCertificate {
    CriticalCertificate {
        problem_sha256: problem.sha256(),
        from: whole(0),
        below: parse(below).unwrap(),
        condensation: None,
        pieces,
    }
}

pub fn farkas(weights: &[i64]) -> CriticalNode {
    CriticalNode::Farkas(weights.to_vec())
}

fn friction(at: &str) -> CriticalNode {
    CriticalNode::Friction(q(at))
}

pub fn split(at: &str) -> CriticalNode {
    CriticalNode::Split(q(at))
}

use CriticalNode::{Branch, NegativeDefinite, PositiveDefinite, Tail};

/// `below` up to the critical friction, at it and above it.
fn one_particle(cases: &mut Cases) {
    let problem = one();
    let of = |below: &str| certificate(&problem, below, vec![piece(None, vec![PositiveDefinite])]);

    accept(
        cases,
        "one",
        "one leaf over everything",
        &problem,
        &of("3/4"),
    );
    let almost = "0.999999999999999999999999999999";
    let note = "1e-30 below the critical friction: exact arithmetic has no margin";
    accept(cases, "almost", note, &problem, &of(almost));

    let note = "at the critical friction there is a solution with lambda^2 = 0";
    reject(
        cases,
        ["below-at", "Cover.NotDefinite", note],
        &problem,
        &of("1"),
    );
    let note = "1e-30 above the critical friction";
    let above = "1.000000000000000000000000000001";
    reject(
        cases,
        ["below-above", "Cover.NotDefinite", note],
        &problem,
        &of(above),
    );

    let note = "a range of friction without a point";
    reject(cases, ["below-zero", "Below", note], &problem, &of("0"));
    reject(
        cases,
        ["below-negative", "Below", note],
        &problem,
        &of("-1/2"),
    );

    let moving = |below: &str| {
        let tree = vec![Branch(0), farkas(&[0]), farkas(&[-1])];
        certificate(&problem, below, vec![piece(None, tree)])
    };
    let note = "a moving variable may have a negative weight; at rest nothing is left";
    accept(cases, "moving", note, &problem, &moving("3/4"));
    let note = "w'T = 0 at the corner (0, 1), where the solution is";
    reject(
        cases,
        ["moving-at", "Cover.NotStrict", note],
        &problem,
        &moving("1"),
    );
    let note = "w'T > 0 at the corner (0, 5/4)";
    reject(
        cases,
        ["moving-above", "Cover.NotNegative", note],
        &problem,
        &moving("5/4"),
    );

    let note = "-T is not definite";
    let negative = certificate(&problem, "1/2", vec![piece(None, vec![NegativeDefinite])]);
    reject(
        cases,
        ["negative", "Cover.NotDefinite", note],
        &problem,
        &negative,
    );

    let mut foreign = of("3/4");
    foreign.problem_sha256 = fold_system().sha256();
    let note = "the digest of another system";
    reject(cases, ["digest", "Digest", note], &problem, &foreign);
}

/// Cuts, branches and pieces that leave something out.
fn trees(cases: &mut Cases) {
    let problem = one();
    let of = |tree: Vec<CriticalNode>| certificate(&problem, "3/4", vec![piece(None, tree)]);
    let all = PositiveDefinite;

    let tree = vec![
        friction("1/2"),
        split("1"),
        all.clone(),
        all.clone(),
        all.clone(),
    ];
    let note = "a cut of mu, and below it one of t";
    accept(cases, "cuts", note, &problem, &of(tree));

    let note = "a cut of mu at the end of its interval";
    for (name, at) in [
        ("cut-at-below", "3/4"),
        ("cut-at-zero", "0"),
        ("cut-above", "4/5"),
    ] {
        let tree = vec![friction(at), all.clone(), all.clone()];
        reject(
            cases,
            [name, "Cover.FrictionCut", note],
            &problem,
            &of(tree),
        );
    }

    let tree = vec![
        friction("1/2"),
        friction("5/8"),
        all.clone(),
        all.clone(),
        all.clone(),
    ];
    let note = "a cut of mu outside the box, inside that of the root";
    reject(
        cases,
        ["cut-outside", "Cover.FrictionCut", note],
        &problem,
        &of(tree),
    );

    let tree = vec![
        split("1"),
        split("2"),
        all.clone(),
        all.clone(),
        all.clone(),
    ];
    let note = "a cut of t outside the box";
    reject(
        cases,
        ["split-outside", "Cover.Cut", note],
        &problem,
        &of(tree),
    );

    let note = "a cut of mu at 0 as one of t";
    let tree = vec![split("0"), all.clone(), all.clone()];
    reject(
        cases,
        ["split-at-zero", "Cover.Cut", note],
        &problem,
        &of(tree),
    );

    let note = "the box of larger friction is not closed";
    let tree = vec![friction("1/2"), all.clone()];
    reject(
        cases,
        ["truncated", "Cover.Truncated", note],
        &problem,
        &of(tree),
    );

    let note = "a leaf too many";
    reject(
        cases,
        ["trailing", "Cover.Trailing", note],
        &problem,
        &of(vec![all.clone(), all.clone()]),
    );

    let tree = vec![Branch(0), farkas(&[-1]), farkas(&[-1])];
    let note = "the child at rest with the vector of the one that moves";
    reject(
        cases,
        ["state-at-rest", "Cover.NegativeWeight", note],
        &problem,
        &of(tree),
    );

    let tree = vec![Branch(0), farkas(&[0]), farkas(&[0])];
    let note = "the child that moves with the vector of the one at rest";
    reject(
        cases,
        ["state-moving", "Cover.NotStrict", note],
        &problem,
        &of(tree),
    );

    let tree = vec![farkas(&[-1])];
    let note = "a negative weight without a branch";
    reject(
        cases,
        ["negative-weight", "Cover.NegativeWeight", note],
        &problem,
        &of(tree),
    );

    let tree = vec![
        Branch(0),
        Branch(0),
        farkas(&[0]),
        farkas(&[0]),
        farkas(&[-1]),
    ];
    let note = "a branch on a variable at rest";
    reject(
        cases,
        ["branch-twice", "Cover.Branch", note],
        &problem,
        &of(tree),
    );

    let tree = vec![Branch(1), farkas(&[0]), farkas(&[-1])];
    let note = "a branch on no variable";
    reject(
        cases,
        ["branch-nowhere", "Cover.Branch", note],
        &problem,
        &of(tree),
    );

    let note = "two weights for one variable";
    reject(
        cases,
        ["weights", "Cover.Length", note],
        &problem,
        &of(vec![farkas(&[1, 1])]),
    );

    let note = "no condensation, so no tail";
    reject(
        cases,
        ["no-tail", "Cover.Hypothesis", note],
        &problem,
        &of(vec![Tail]),
    );

    let leaf = || vec![PositiveDefinite];
    let two = vec![piece(Some("1"), leaf()), piece(None, leaf())];
    accept(
        cases,
        "pieces",
        "two pieces",
        &problem,
        &certificate(&problem, "3/4", two),
    );
    let wrong_pieces = [
        ("no-piece", "no piece at all", vec![]),
        (
            "no-right-end",
            "the last piece ends",
            vec![piece(Some("1"), leaf())],
        ),
        (
            "pieces-fall",
            "the second piece ends below the first",
            vec![
                piece(Some("2"), leaf()),
                piece(Some("1"), leaf()),
                piece(None, leaf()),
            ],
        ),
        (
            "piece-empty",
            "a piece from 0 to 0",
            vec![piece(Some("0"), leaf()), piece(None, leaf())],
        ),
        (
            "piece-after-the-last",
            "a piece after the one to infinity",
            vec![piece(None, leaf()), piece(None, leaf())],
        ),
    ];
    for (name, note, pieces) in wrong_pieces {
        let forged = certificate(&problem, "3/4", pieces);
        reject(cases, [name, "Cover.PieceEnd", note], &problem, &forged);
    }
}

/// K and M with one leaf that the tree cannot do without.
///
/// At rest for variable 1 and moving for variable 0, w = (-1, 1) has w'T = -T_00 + T_10 in the
/// column that moves, a bilinear function with the given values (of at most 1/4) at the corners of
/// [0, 1] x [0, 1]. Row 0 is divided by 2 and row 1 by 128.
fn corner_problem(values: &[[Rational; 2]; 2]) -> Problem {
    let [[at_zero, of_mu], [of_t, of_both]] = values;
    let constant = at_zero + whole(1);
    let t = of_t - at_zero + whole(1);
    let mu = of_mu - at_zero;
    let both = of_both - of_t - of_mu + at_zero;

    let matrix = |diagonal: i64, tangents: Rational, normal: Rational| {
        vec![
            (0, 0, whole(diagonal)),
            (0, 1, tangents),
            (0, 3, normal),
            (1, 1, whole(100)),
            (2, 2, whole(100)),
            (3, 3, whole(100)),
        ]
    };
    let stiffness = matrix(1, constant, mu);
    let mass = matrix(1, t, both);
    system(4, &[(0, 2), (1, 3)], &stiffness, &mass)
}

fn corner_certificate(problem: &Problem) -> CriticalCertificate {
    let tree = vec![
        Branch(1),
        Branch(0),
        farkas(&[0, 0]),
        farkas(&[-1, 64]),
        PositiveDefinite,
    ];
    let pieces = vec![piece(Some("1"), tree), piece(None, vec![PositiveDefinite])];
    certificate(problem, "1", pieces)
}

/// A Farkas vector that holds at all corners, and ones that fail at one of them.
fn corners(cases: &mut Cases) {
    let quarter = || rational(1, 4);
    let negative = || [[-quarter(), -quarter()], [-quarter(), -quarter()]];
    let all = corner_problem(&negative());
    let note = "a Farkas vector of a box in both directions";
    accept(cases, "corners", note, &all, &corner_certificate(&all));

    for (t, end) in ["lower", "upper"].into_iter().enumerate() {
        for (mu, friction) in ["zero", "below"].into_iter().enumerate() {
            let mut values = negative();
            values[t][mu] = quarter();
            let problem = corner_problem(&values);
            let forged = corner_certificate(&problem);
            let name = format!("corner-{end}-{friction}");
            let note = "w'T > 0 at one corner of the box alone";
            reject(cases, [&name, "Cover.NotNegative", note], &problem, &forged);

            values[t][mu] = whole(0);
            let problem = corner_problem(&values);
            let forged = corner_certificate(&problem);
            let name = format!("corner-{end}-{friction}-zero");
            let note = "w'T = 0 at one corner of the box alone";
            reject(cases, [&name, "Cover.NotStrict", note], &problem, &forged);

            values[t][mu] = rational(-1, 1 << 60);
            let problem = corner_problem(&values);
            let name = format!("corner-{end}-{friction}-hair");
            let note = "w'T = -2^-60 at one corner of the box";
            accept(cases, &name, note, &problem, &corner_certificate(&problem));
        }
    }
}

/// The fold of X9 at 1 + sqrt(3)/2, between 1.8660 and 1.8661.
fn near_the_fold(cases: &mut Cases) {
    let problem = fold_system();
    // Row 0 is divided by 4 and row 1 by 8: the symmetric part is [[2 + 2t, -5 mu / 2], [., 2 + t -
    // 4 mu]] / 8.
    let of = |below: &str| certificate(&problem, below, vec![piece(None, vec![PositiveDefinite])]);
    accept(
        cases,
        "fold-definite",
        "below the fold",
        &problem,
        &of("0.3"),
    );
    let note = "no solution below 1.86, but the symmetric part is not definite";
    reject(
        cases,
        ["fold-not-definite", "Cover.NotDefinite", note],
        &problem,
        &of("1/2"),
    );
}

pub fn matrix(entry: i64) -> IntegerMatrix {
    IntegerMatrix {
        exponent: 1,
        rows: vec![vec![Integer::from(entry)].into()],
    }
}

pub fn lower(rows: &[&[i64]], exponent: u32) -> Factor {
    Factor {
        first: vec![0; rows.len()],
        rows: rows
            .iter()
            .map(|row| row.iter().map(|&v| Integer::from(v)).collect())
            .collect(),
        exponent,
    }
}

pub fn no_factor(order: usize) -> Factor {
    Factor {
        first: (0..order).collect(),
        rows: vec![vec![Integer::from(0)].into(); order],
        exponent: 0,
    }
}

/// Degree of freedom 0 is free; T(t, mu) = 3 + t - 4 (1 + mu) / (4 + t), so that 2 is critical.
pub fn free_problem() -> Problem {
    let stiffness = [
        (0, 0, whole(4)),
        (0, 1, whole(2)),
        (0, 2, whole(2)),
        (1, 1, whole(3)),
        (2, 2, whole(4)),
    ];
    system(3, &[(1, 2)], &stiffness, &identity(3))
}

fn anchor(center: &str) -> CriticalAnchor {
    CriticalAnchor {
        center: q(center),
        reversed: false,
        right: vec![matrix(-1)],
        left: Some(vec![matrix(-1)]),
        left_friction: vec![matrix(-1)],
    }
}

/// The condensation of 5.19.
pub fn free_condensation() -> CriticalCondensation {
    CriticalCondensation {
        sigma: q("4"),
        stiffness_factor: no_factor(1),
        mass_sigma: q("1"),
        mass_factor: None,
        anchors: vec![anchor("0")],
        tail: None,
    }
}

/// The example of 5.18.
pub fn free_certificate(problem: &Problem) -> CriticalCertificate {
    let condensation = CriticalCondensation {
        tail: Some(CriticalTail {
            from: q("1"),
            factor: no_factor(2),
            factor_below: no_factor(2),
            mass_factor: None,
            mass_factor_below: None,
        }),
        ..free_condensation()
    };
    let first = CriticalPiece {
        anchor: Some(0),
        ..piece(Some("1"), vec![PositiveDefinite])
    };

    CriticalCertificate {
        condensation: Some(condensation),
        ..certificate(problem, "1", vec![first, piece(None, vec![Tail])])
    }
}

fn condensation(certificate: &mut CriticalCertificate) -> &mut CriticalCondensation {
    certificate.condensation.as_mut().unwrap()
}

/// A change of an accepted file.
struct Change {
    name: &'static str,
    reason: &'static str,
    note: &'static str,
    change: fn(&mut CriticalCertificate),
}

const FREE_FORGERIES: [Change; 16] = [
    Change {
        name: "free-no-condensation",
        reason: "Cover.Condensation",
        note: "free variables and no condensation",
        change: |c| c.condensation = None,
    },
    Change {
        name: "free-sigma",
        reason: "Cover.Hypothesis",
        note: "sigma above the least eigenvalue of K_ff",
        change: |c| condensation(c).sigma = q("4.000000000000000000000000000001"),
    },
    Change {
        name: "free-sigma-zero",
        reason: "Cover.Hypothesis",
        note: "sigma = 0 bounds nothing",
        change: |c| condensation(c).sigma = q("0"),
    },
    Change {
        name: "free-mass-sigma",
        reason: "Cover.Hypothesis",
        note: "mass_sigma above the least eigenvalue of M_ff",
        change: |c| condensation(c).mass_sigma = q("1.000000000000000000000000000001"),
    },
    Change {
        name: "free-no-anchor",
        reason: "Cover.Anchor",
        note: "a piece with matrices and without an anchor",
        change: |c| c.pieces[0].anchor = None,
    },
    Change {
        name: "free-anchor-1",
        reason: "Cover.Anchor",
        note: "an anchor that does not exist",
        change: |c| c.pieces[0].anchor = Some(1),
    },
    Change {
        name: "free-right",
        reason: "Cover.NotDefinite",
        note: "W = -5/2: the remainders are too large",
        change: |c| condensation(c).anchors[0].right = vec![matrix(-5)],
    },
    Change {
        name: "free-left",
        reason: "Cover.NotDefinite",
        note: "V0 = 500: a remainder that is too large at mu = 0 already",
        change: |c| condensation(c).anchors[0].left = Some(vec![matrix(1000)]),
    },
    Change {
        name: "free-left-friction",
        reason: "Cover.NotDefinite",
        note: "left_friction is wrong, a remainder that only corners with mu > 0 see",
        change: |c| condensation(c).anchors[0].left_friction = vec![matrix(40)],
    },
    Change {
        name: "free-left-friction-shape",
        reason: "Cover.Length",
        note: "left_friction without rows",
        change: |c| condensation(c).anchors[0].left_friction[0].rows = vec![],
    },
    Change {
        name: "free-left-friction-row",
        reason: "Cover.Length",
        note: "left_friction with a row of two entries",
        change: |c| {
            condensation(c).anchors[0].left_friction[0].rows[0].edit(|row| row.push(0.into()))
        },
    },
    Change {
        name: "free-left-friction-degree",
        reason: "Cover.TooLarge",
        note: "left_friction with nine coefficients",
        change: |c| condensation(c).anchors[0].left_friction = vec![matrix(-1); 9],
    },
    Change {
        name: "free-infinite",
        reason: "Cover.Hypothesis",
        note: "an expansion in t - center that is not linear, to infinity",
        change: |c| {
            c.pieces[0].max = None;
            c.pieces.truncate(1);
        },
    },
    Change {
        name: "free-tail-early",
        reason: "Cover.Hypothesis",
        note: "a tail leaf below the tail",
        change: |c| c.pieces[0].tree = vec![Tail],
    },
    Change {
        name: "free-no-tail",
        reason: "Cover.Hypothesis",
        note: "a tail leaf without a tail",
        change: |c| condensation(c).tail = None,
    },
    Change {
        name: "free-below-two",
        reason: "Cover.NotDefinite",
        note: "at mu = 2 there is a solution with lambda^2 = 0; the tail is there from 2 on",
        change: |c| {
            c.below = whole(2);
            let tail = condensation(c).tail.as_mut().unwrap();
            tail.from = q("2");
            c.pieces[0].max = Some(q("2"));
        },
    },
];

/// A remainder, a tail, and what the hypotheses rest on.
fn with_a_free_variable(cases: &mut Cases) {
    let problem = free_problem();
    let good = free_certificate(&problem);
    accept(cases, "free", "an anchor and a tail", &problem, &good);

    for forgery in &FREE_FORGERIES {
        let mut forged = good.clone();
        (forgery.change)(&mut forged);
        let words = [forgery.name, forgery.reason, forgery.note];
        reject(cases, words, &problem, &forged);
    }

    let mut reversed = good;
    condensation(&mut reversed).anchors.push(CriticalAnchor {
        center: q("0"),
        reversed: true,
        right: vec![],
        left: Some(vec![]),
        left_friction: vec![],
    });
    reversed.pieces[1] = CriticalPiece {
        anchor: Some(1),
        ..piece(None, vec![PositiveDefinite])
    };
    let note = "[4, infinity) by a reversed anchor without coefficients";
    let mut far = reversed.clone();
    far.pieces[0].max = Some(q("4"));
    far.pieces[0].tree = vec![split("1"), PositiveDefinite, Tail];
    accept(cases, "free-reversed", note, &problem, &far);

    let mut near = reversed.clone();
    near.pieces[0].max = Some(q("1/2"));
    let note = "W = V = 0 at 1/2: remainders as large as the matrix";
    reject(
        cases,
        ["free-reversed-near", "Cover.NotDefinite", note],
        &problem,
        &near,
    );

    let mut zero = reversed;
    zero.pieces.remove(0);
    let note = "a reversed anchor from 0 on";
    reject(
        cases,
        ["free-reversed-zero", "Cover.Hypothesis", note],
        &problem,
        &zero,
    );
}

/// The whole pencil is definite from 0 on at mu = 0, by the zero factor; at mu = 1 it takes one.
fn tails(cases: &mut Cases) {
    let problem = free_problem();
    let mut good = free_certificate(&problem);
    let parts = condensation(&mut good);
    parts.anchors.clear();
    let tail = parts.tail.as_mut().unwrap();
    tail.from = q("0");
    tail.factor_below = lower(&[&[7], &[-6, 2]], 2);
    good.pieces = vec![piece(None, vec![Tail])];
    accept(
        cases,
        "tail",
        "one leaf, by factors at both frictions",
        &problem,
        &good,
    );

    let mut forged = good.clone();
    let tail = condensation(&mut forged).tail.as_mut().unwrap();
    tail.factor_below = tail.factor.clone();
    let note = "the factor for mu = 0 at mu = below";
    reject(
        cases,
        ["tail-factor", "Cover.Hypothesis", note],
        &problem,
        &forged,
    );

    let mut forged = good.clone();
    let tail = condensation(&mut forged).tail.as_mut().unwrap();
    tail.factor = lower(&[&[9], &[0, 0]], 2);
    let note = "a factor at mu = 0 that is too large";
    reject(
        cases,
        ["tail-factor-zero", "Cover.Hypothesis", note],
        &problem,
        &forged,
    );

    let mut forged = good.clone();
    forged.below = rational(3, 2);
    let note = "the factor for mu = 1 at mu = 3/2";
    reject(
        cases,
        ["tail-below", "Cover.Hypothesis", note],
        &problem,
        &forged,
    );

    // M_NT couples: sym(B) at mu = 1 is not a diagonal, and at mu = 0 it is.
    let mut mass = identity(3);
    mass.push((0, 2, rational(1, 2)));
    let stiffness = [
        (0, 0, whole(4)),
        (0, 1, whole(2)),
        (0, 2, whole(2)),
        (1, 1, whole(3)),
        (2, 2, whole(4)),
    ];
    let coupled = system(3, &[(1, 2)], &stiffness, &mass);
    let mut with_factor = good;
    with_factor.problem_sha256 = coupled.sha256();
    let tail = condensation(&mut with_factor).tail.as_mut().unwrap();
    tail.mass_factor_below = Some(no_factor(2));
    let note = "sym(B) at mu = below by dominance";
    accept(cases, "tail-mass", note, &coupled, &with_factor);

    let mut forged = with_factor.clone();
    let tail = condensation(&mut forged).tail.as_mut().unwrap();
    tail.mass_factor = tail.mass_factor_below.take();
    let note = "the factor of sym(B) stands at mu = 0 and is missing at mu = below";
    reject(
        cases,
        ["tail-mass-factor", "Cover.Hypothesis", note],
        &coupled,
        &forged,
    );
}

/// Problems of which the file says nothing.
fn other_problems(cases: &mut Cases) {
    let pencil = fold("0", None);
    let of =
        |problem: &Problem| certificate(problem, "1/4", vec![piece(None, vec![PositiveDefinite])]);
    let note = "a pencil has no friction";
    reject(cases, ["pencil", "NotASystem", note], &pencil, &of(&pencil));

    let static_fold = fold_system();
    let mu = Problem::new(static_fold.body().clone(), Unknown::Mu, Window::all()).unwrap();
    let note = "the problem asks for mu at lambda^2 = 0";
    reject(cases, ["unknown", "Unknown", note], &mu, &of(&mu));

    let problem = one();
    let mut needless = of(&problem);
    needless.condensation = free_certificate(&problem).condensation;
    let note = "a condensation without free variables";
    reject(
        cases,
        ["condensation", "Cover.Condensation", note],
        &problem,
        &needless,
    );
}

/// The system of `one` where the friction of the particle is twice mu: the critical mu is 1/2.
fn twice_the_friction() -> Problem {
    let problem = one();
    let Body::System(of_one) = problem.body() else {
        unreachable!("a system was built")
    };
    let particle = Particle {
        friction_factor: whole(2),
        ..of_one.particles()[0].clone()
    };

    let stiffness = of_one.stiffness().clone();
    let mass = of_one.mass().cloned();
    let friction = of_one.friction().cloned();
    let system = System::new(stiffness, mass, friction, vec![particle]).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

/// The system of `one` beside a particle with zero reaction that it does not touch.
pub fn with_zero_reaction() -> Problem {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 1, whole(-1)),
        (1, 1, whole(3)),
        (2, 2, whole(1)),
        (3, 3, whole(1)),
    ];
    let problem = system(4, &[(0, 1)], &stiffness, &identity(4));
    let Body::System(of_one) = problem.body() else {
        unreachable!("a system was built")
    };
    let mut particles = of_one.particles().to_vec();
    particles.push(Particle::plain(2, 3, ContactState::Zero));

    let stiffness = of_one.stiffness().clone();
    let mass = of_one.mass().cloned();
    let friction = of_one.friction().cloned();
    let system = System::new(stiffness, mass, friction, particles).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

/// A particle with a friction of its own.
fn other_particles(cases: &mut Cases) {
    let problem = twice_the_friction();
    let of = |below: &str| certificate(&problem, below, vec![piece(None, vec![PositiveDefinite])]);
    let note = "the friction of the particle is twice mu";
    accept(cases, "factor", note, &problem, &of("0.499999"));
    let note = "true if the factor of the particle is forgotten";
    reject(
        cases,
        ["factor-forgotten", "Cover.NotDefinite", note],
        &problem,
        &of("3/4"),
    );
}

const MISSPELLINGS: [Misspelling; 14] = [
    Misspelling {
        name: "version",
        note: "another version",
        from: "mceip-critical/1",
        to: "mceip-critical/2",
    },
    Misspelling {
        name: "no-below",
        note: "below missing",
        from: "\"below\":\"1\",",
        to: "",
    },
    Misspelling {
        name: "below-null",
        note: "below is null, which is no infinity",
        from: "\"below\":\"1\"",
        to: "\"below\":null",
    },
    Misspelling {
        name: "no-left-friction",
        note: "left_friction missing",
        from: ",\"left_friction\":[{\"exponent\":1,\"rows\":[[\"-1\"]]}]",
        to: "",
    },
    Misspelling {
        name: "no-factor-below",
        note: "factor_below missing",
        from: "\"factor_below\"",
        to: "\"mass_factor\"",
    },
    Misspelling {
        name: "no-max",
        note: "a piece without max",
        from: "\"max\":null,",
        to: "",
    },
    Misspelling {
        name: "open",
        note: "a leaf of complete sets that proves nothing",
        from: "\"positive_definite\"",
        to: "\"open\"",
    },
    Misspelling {
        name: "ldl",
        note: "a leaf of complete sets alone",
        from: "\"positive_definite\"",
        to: "{\"support\":{\"points\":[],\"cells\":[],\"reasons\":[]}}",
    },
    Misspelling {
        name: "friction-fraction",
        note: "a cut at 1/0",
        from: "\"positive_definite\"",
        to: "{\"friction\":\"1/0\"},\"positive_definite\",\"positive_definite\"",
    },
    Misspelling {
        name: "two-kinds",
        note: "a node with two keys",
        from: "\"positive_definite\"",
        to: "{\"friction\":\"1/2\",\"split\":\"1/2\"}",
    },
    Misspelling {
        name: "window",
        note: "a field of certificates",
        from: "\"below\":\"1\"",
        to: "\"below\":\"1\",\"window\":{\"min\":\"0\"}",
    },
    Misspelling {
        name: "duplicate-below",
        note: "two values of below",
        from: "\"below\":\"1\"",
        to: "\"below\":\"1\",\"below\":\"2\"",
    },
    Misspelling {
        name: "weight-fraction",
        note: "a weight that is no integer",
        from: "\"positive_definite\"",
        to: "{\"farkas\":[0.5]}",
    },
    Misspelling {
        name: "condensation-null-factor",
        note: "factor_below is null",
        from: "\"factor_below\":{\"first\":[0,1],\"rows\":[[\"0\"],[\"0\"]],\"exponent\":0}",
        to: "\"factor_below\":null",
    },
];

fn malformed(cases: &mut Cases) {
    let problem = free_problem();
    let text = free_certificate(&problem).to_json();
    cases.misspelt("critical-", &problem, &text, &MISSPELLINGS);
}
