//! Regular leaves, a lowest friction and anchors without `left` in `mceip-critical/1`: accepted
//! files, and forgeries of each obligation.
//!
//! The systems are of the kind of `corpus_critical`, so that T(t, mu) can be read off. Truths are
//! computed by hand; those of the example of 5.18 stand there.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::{Cases, Forgery, Misspelling, Repeated, problem_json, q, replaced};
use super::corpus_critical::{
    accept, certificate, farkas, free_certificate, free_problem, identity, lower, no_factor, one,
    piece, reject, split, system,
};
use mceip_check::certificate::{
    CriticalAnchor, CriticalCertificate, CriticalNode, CriticalPiece, Regular,
};
use mceip_exact::{Integer, Rational, parse, rational, whole};
use mceip_model::Problem;
use serde_json::json;

use CriticalNode::{Branch, PositiveDefinite, Tail};

pub fn regular(cases: &mut Cases) {
    of_the_page(cases);
    one_variable(cases);
    corners(cases);
    reversed(cases);
    ranges(cases);
    tails(cases);
    without_left(cases);
    too_much_work(cases);

    let problem = problem_of_the_page();
    let text = certificate_of_the_page(&problem).to_json();
    cases.misspelt("critical-regular-", &problem, &text, &MISSPELLINGS);
}

fn reject_all(
    cases: &mut Cases,
    problem: &Problem,
    good: &CriticalCertificate,
    forgeries: &[Forgery<CriticalCertificate>],
) {
    for forgery in forgeries {
        let words = [forgery.name, forgery.reason, forgery.note];
        reject(cases, words, problem, &forgery.of(good));
    }
}

/// T(t, mu) = [[8 + t, -4 mu], [4 mu, 1 + t - 2 mu]].
fn problem_of_the_page() -> Problem {
    let stiffness = [
        (0, 0, whole(8)),
        (0, 3, whole(4)),
        (1, 1, whole(1)),
        (1, 2, whole(-4)),
        (1, 3, whole(-2)),
        (2, 2, whole(32)),
        (3, 3, whole(32)),
    ];
    system(4, &[(0, 2), (1, 3)], &stiffness, &identity(4))
}

fn integers(values: &[i64]) -> Vec<Integer> {
    values.iter().map(|&v| Integer::from(v)).collect()
}

fn leaf_of_the_page() -> Regular {
    Regular {
        pivot: 1,
        inverse: vec![integers(&[2])],
        inverse_exponent: 0,
        left: integers(&[-6]),
        right: integers(&[3]),
        exponent: 3,
    }
}

fn regular_node(leaf: Regular) -> CriticalNode {
    CriticalNode::Regular(Box::new(leaf))
}

/// T_kk of the only variable that moves.
fn single(pivot: usize) -> CriticalNode {
    regular_node(Regular {
        pivot,
        inverse: vec![],
        inverse_exponent: 0,
        left: vec![],
        right: vec![],
        exponent: 0,
    })
}

/// The example of 5.18.
fn certificate_of_the_page(problem: &Problem) -> CriticalCertificate {
    let tree = vec![
        Branch(0),
        farkas(&[1, 0]),
        Branch(1),
        farkas(&[-1, 0]),
        regular_node(leaf_of_the_page()),
    ];
    let pieces = vec![piece(Some("2"), tree), piece(None, vec![PositiveDefinite])];

    CriticalCertificate {
        from: rational(3, 4),
        ..certificate(problem, "1", pieces)
    }
}

/// The leaf of the example of 5.18, the last node of the first tree.
fn leaf(certificate: &mut CriticalCertificate) -> &mut Regular {
    match certificate.pieces[0].tree.last_mut() {
        Some(CriticalNode::Regular(leaf)) => leaf,
        _ => unreachable!("the tree ends with the leaf"),
    }
}

const FORGERIES: [Forgery<CriticalCertificate>; 19] = [
    Forgery {
        name: "regular-inverse",
        reason: "Cover.NotRegular",
        note: "Y = 5: |I - Y T'| is 3/2 at t = 0",
        change: |c| leaf(c).inverse = vec![integers(&[5])],
    },
    Forgery {
        name: "regular-inverse-negative",
        reason: "Cover.NotRegular",
        note: "-Y in place of Y",
        change: |c| leaf(c).inverse = vec![integers(&[-2])],
    },
    Forgery {
        name: "regular-inverse-edge",
        reason: "Cover.NotRegular",
        note: "Y = 0: |I - Y T'| = 1, which is not below 1",
        change: |c| leaf(c).inverse = vec![integers(&[0])],
    },
    Forgery {
        name: "regular-product",
        reason: "Cover.SignChange",
        note: "u = -1 and v = 1/2: u'Tv > 0 at all corners, but P epsilon = 1/12 is more than 1/16",
        change: |c| {
            leaf(c).left = integers(&[-8]);
            leaf(c).right = integers(&[4]);
        },
    },
    Forgery {
        name: "regular-left-far",
        reason: "Cover.SignChange",
        note: "u = 3/4 in place of -3/4",
        change: |c| leaf(c).left = integers(&[6]),
    },
    Forgery {
        name: "regular-right-far",
        reason: "Cover.SignChange",
        note: "v = -3/8 in place of 3/8",
        change: |c| leaf(c).right = integers(&[-3]),
    },
    Forgery {
        name: "regular-undecided",
        reason: "Cover.RootTooEarly",
        note: "variable 1 is open",
        change: |c| {
            c.pieces[0].tree.remove(2);
            c.pieces[0].tree.remove(2);
        },
    },
    Forgery {
        name: "regular-nothing-moves",
        reason: "Cover.RootTooEarly",
        note: "both variables at rest",
        change: |c| {
            let instead = [Branch(1), single(1), farkas(&[1, 0])];
            c.pieces[0].tree.splice(1..2, instead);
        },
    },
    Forgery {
        name: "regular-infinite",
        reason: "Cover.OutcomeOnHalfLine",
        note: "[0, infinity) without a reversed anchor",
        change: |c| {
            c.pieces[0].max = None;
            c.pieces.truncate(1);
        },
    },
    Forgery {
        name: "regular-pivot-at-rest",
        reason: "Cover.Pivot",
        note: "the pivot is at rest",
        change: |c| c.pieces[0].tree[3] = single(1),
    },
    Forgery {
        name: "regular-pivot-nowhere",
        reason: "Cover.Pivot",
        note: "the pivot is no variable",
        change: |c| leaf(c).pivot = 2,
    },
    Forgery {
        name: "regular-pivot-other",
        reason: "Cover.NotRegular",
        note: "with the other pivot T' = (1 + t - 2 mu)/8, which Y does not invert",
        change: |c| leaf(c).pivot = 0,
    },
    Forgery {
        name: "regular-left-length",
        reason: "Cover.Length",
        note: "u without an entry",
        change: |c| leaf(c).left.clear(),
    },
    Forgery {
        name: "regular-right-length",
        reason: "Cover.Length",
        note: "v with an entry for the pivot",
        change: |c| leaf(c).right = integers(&[3, 8]),
    },
    Forgery {
        name: "regular-inverse-length",
        reason: "Cover.Length",
        note: "Y without a row",
        change: |c| leaf(c).inverse.clear(),
    },
    Forgery {
        name: "regular-inverse-row",
        reason: "Cover.Length",
        note: "Y with a row of two entries",
        change: |c| leaf(c).inverse = vec![integers(&[2, 0])],
    },
    Forgery {
        name: "regular-exponent",
        reason: "Cover.TooLarge",
        note: "u and v in units of 2^-16385",
        change: |c| leaf(c).exponent = 16_385,
    },
    Forgery {
        name: "regular-inverse-exponent",
        reason: "Cover.TooLarge",
        note: "Y in units of 2^-16385",
        change: |c| leaf(c).inverse_exponent = 16_385,
    },
    Forgery {
        name: "regular-exponent-off",
        reason: "Cover.SignChange",
        note: "u and v a hundred times too small",
        change: |c| leaf(c).exponent = 10,
    },
];

fn of_the_page(cases: &mut Cases) {
    let problem = problem_of_the_page();
    let good = certificate_of_the_page(&problem);
    accept(
        cases,
        "regular",
        "the example of 5.18, with a lowest friction",
        &problem,
        &good,
    );
    reject_all(cases, &problem, &good, &FORGERIES);

    // Numbers of more than 54 bits, which machine integers do not hold.
    let mut long = good.clone();
    let unit = Integer::from(1) << 200;
    leaf(&mut long).inverse[0][0] *= &unit;
    leaf(&mut long).inverse_exponent = 200;
    leaf(&mut long).left[0] *= &unit;
    leaf(&mut long).right[0] *= &unit;
    leaf(&mut long).exponent = 203;
    let note = "the same witness in units of 2^-200";
    accept(cases, "regular-long", note, &problem, &long);

    let mut forged = long;
    leaf(&mut forged).left[0] = Integer::from(-8) * &unit;
    leaf(&mut forged).right[0] = Integer::from(4) * &unit;
    let note = "P epsilon is more than u'Tv at one corner, in units of 2^-200";
    reject(
        cases,
        ["regular-long-product", "Cover.SignChange", note],
        &problem,
        &forged,
    );
}

/// T(t, mu) = 1 + t - mu over [0, 1], up to the critical friction and beyond.
fn one_variable(cases: &mut Cases) {
    let problem = one();
    let of = |below: &str| {
        let tree = vec![Branch(0), farkas(&[0]), single(0)];
        let pieces = vec![piece(Some("1"), tree), piece(None, vec![PositiveDefinite])];
        certificate(&problem, below, pieces)
    };

    let almost = "0.999999999999999999999999999999";
    let note = "1e-30 below the critical friction: exact arithmetic has no margin";
    accept(cases, "regular-almost", note, &problem, &of(almost));

    let note = "T = 0 at the corner (0, 1), where the solution is";
    reject(
        cases,
        ["regular-at", "Cover.SignChange", note],
        &problem,
        &of("1"),
    );
    let above = "1.000000000000000000000000000001";
    let note = "T < 0 at the corner (0, 1 + 1e-30)";
    reject(
        cases,
        ["regular-above", "Cover.SignChange", note],
        &problem,
        &of(above),
    );
}

/// T(t, mu) of one variable with these values at the corners of [0, 1] x [0, 1]: first those at t =
/// 0. The value at (1, 0) has to be larger than that at (0, 0).
fn corner_problem(values: &[[Rational; 2]; 2]) -> Problem {
    let [[at_zero, of_mu], [of_t, of_both]] = values;
    let stiffness = [
        (0, 0, at_zero.clone()),
        (0, 1, of_mu - at_zero),
        (1, 1, whole(100)),
    ];
    let mass = [
        (0, 0, of_t - at_zero),
        (0, 1, of_both - of_t - of_mu + at_zero),
        (1, 1, whole(100)),
    ];
    system(2, &[(0, 1)], &stiffness, &mass)
}

/// A sign that is missing at one corner alone.
fn corners(cases: &mut Cases) {
    let certificate_of = |problem: &Problem| {
        let tree = vec![Branch(0), farkas(&[0]), single(0)];
        let pieces = vec![piece(Some("1"), tree), piece(None, vec![PositiveDefinite])];
        certificate(problem, "1", pieces)
    };

    let positive = [[1, 1], [2, 2]].map(|row| row.map(whole));
    let problem = corner_problem(&positive);
    let note = "T > 0 at all corners";
    accept(
        cases,
        "regular-corners",
        note,
        &problem,
        &certificate_of(&problem),
    );

    // T at (1, 0) is larger than at (0, 0), so it is there that a negative T has its other sign.
    let negative = [[-1, -1], [-1, -1]].map(|row| row.map(whole));
    for (name, [t, mu], others) in [
        ("lower-zero", [0, 0], &positive),
        ("lower-below", [0, 1], &positive),
        ("upper-zero", [1, 0], &negative),
        ("upper-below", [1, 1], &positive),
    ] {
        let mut values = others.clone();
        values[t][mu] = -others[0][1].clone();
        let problem = corner_problem(&values);
        let note = "T has the other sign at one corner of the box alone";
        let words = [&format!("regular-corner-{name}"), "Cover.SignChange", note];
        reject(cases, words, &problem, &certificate_of(&problem));

        values[t][mu] = whole(0);
        let problem = corner_problem(&values);
        let note = "T = 0 at one corner of the box alone";
        let words = [
            &format!("regular-corner-{name}-zero"),
            "Cover.SignChange",
            note,
        ];
        reject(cases, words, &problem, &certificate_of(&problem));
    }

    for (name, mu) in [("zero", 0), ("below", 1)] {
        let mut values = positive.clone();
        values[0][mu] = rational(1, 1 << 60);
        let problem = corner_problem(&values);
        let note = "T = 2^-60 at one corner of the box";
        let name = format!("regular-corner-{name}-hair");
        accept(cases, &name, note, &problem, &certificate_of(&problem));
    }
}

/// [4, infinity) by a reversed anchor without coefficients.
fn reversed(cases: &mut Cases) {
    let problem = free_problem();
    let mut good = free_certificate(&problem);
    let parts = good.condensation.as_mut().unwrap();
    parts.anchors.push(CriticalAnchor {
        center: q("0"),
        reversed: true,
        right: vec![],
        left: None,
        left_friction: vec![],
    });

    let tree = vec![Branch(1), Tail, single(1)];
    let far = CriticalPiece {
        anchor: Some(1),
        ..piece(None, tree)
    };
    let middle = piece(Some("4"), vec![Tail]);
    good.pieces = vec![good.pieces[0].clone(), middle, far];
    let note = "a regular leaf up to infinity by a reversed anchor";
    accept(cases, "regular-reversed", note, &problem, &good);

    let mut direct = good.clone();
    direct.pieces[2].anchor = Some(0);
    let note = "the same by an anchor that is not reversed";
    reject(
        cases,
        ["regular-direct", "Cover.OutcomeOnHalfLine", note],
        &problem,
        &direct,
    );

    let mut near = good;
    near.pieces[0].max = Some(q("1/2"));
    near.pieces.remove(1);
    near.pieces[1].tree[1] = farkas(&[0]);
    let note = "W = V = 0 at 1/2: remainders as large as the matrix";
    reject(
        cases,
        ["regular-reversed-near", "Cover.SignChange", note],
        &problem,
        &near,
    );
}

const RANGE_FORGERIES: [Forgery<CriticalCertificate>; 5] = [
    Forgery {
        name: "from-absent",
        reason: "Cover.NotStrict",
        note: "without from, w'T = 0 at mu = 0",
        change: |c| c.from = whole(0),
    },
    Forgery {
        name: "from-negative",
        reason: "FrictionRange",
        note: "friction is not negative",
        change: |c| c.from = rational(-1, 4),
    },
    Forgery {
        name: "from-below",
        reason: "FrictionRange",
        note: "a range of friction without length",
        change: |c| c.from = c.below.clone(),
    },
    Forgery {
        name: "from-above-below",
        reason: "FrictionRange",
        note: "an empty range of friction",
        change: |c| c.from = whole(2),
    },
    Forgery {
        name: "from-cut",
        reason: "Cover.FrictionCut",
        note: "a cut of mu at from",
        change: |c| c.pieces[1].tree = vec![CriticalNode::Friction(q("3/4")), Tail, Tail],
    },
];

fn ranges(cases: &mut Cases) {
    let problem = problem_of_the_page();
    let good = certificate_of_the_page(&problem);
    reject_all(cases, &problem, &good, &RANGE_FORGERIES);

    // 1 + t - mu changes its sign over the whole range, but not above it.
    let problem = one();
    let above = |from: &str| {
        let tree = vec![Branch(0), farkas(&[0]), single(0)];
        let pieces = vec![
            piece(Some("1/2"), tree),
            piece(None, vec![split("3"), PositiveDefinite, PositiveDefinite]),
        ];
        CriticalCertificate {
            from: parse(from).unwrap(),
            ..certificate(&problem, "2", pieces)
        }
    };
    let note = "T < 0 in the box, but there are solutions with larger t";
    reject(
        cases,
        ["from-solutions", "Cover.NotDefinite", note],
        &problem,
        &above("7/4"),
    );
}

/// The tail is proved at the ends of the range of friction.
fn tails(cases: &mut Cases) {
    let problem = free_problem();
    let mut good = free_certificate(&problem);
    good.from = rational(3, 4);
    good.pieces = vec![piece(None, vec![Tail])];
    let parts = good.condensation.as_mut().unwrap();
    parts.anchors.clear();
    let tail = parts.tail.as_mut().unwrap();
    tail.from = q("0");
    tail.factor = lower(&[&[7], &[-6, 2]], 2);
    tail.factor_below = tail.factor.clone();
    let note = "one leaf, by factors at both ends of [3/4, 1]";
    accept(cases, "from-tail", note, &problem, &good);

    let mut forged = good.clone();
    forged.from = whole(0);
    let note = "the factor for mu = 3/4 at mu = 0";
    reject(
        cases,
        ["from-tail-absent", "Cover.Hypothesis", note],
        &problem,
        &forged,
    );

    let mut at_zero = good.clone();
    at_zero.from = whole(0);
    let tail = at_zero.condensation.as_mut().unwrap().tail.as_mut();
    tail.unwrap().factor = lower(&[&[7], &[-4, 5]], 2);
    let note = "a factor that holds at mu = 0";
    accept(cases, "from-tail-zero", note, &problem, &at_zero);

    let mut forged = at_zero;
    forged.from = rational(3, 4);
    let note = "the factor holds at mu = 0 alone, and the range begins at 3/4";
    reject(
        cases,
        ["from-tail-only-at-zero", "Cover.Hypothesis", note],
        &problem,
        &forged,
    );

    let mut forged = good;
    let tail = forged.condensation.as_mut().unwrap().tail.as_mut();
    tail.unwrap().factor = no_factor(2);
    let note = "sym(A) is diagonally dominant below mu = 1, also at 3/4";
    accept(cases, "from-tail-dominant", note, &problem, &forged);
}

/// Anchors whose V is W.
fn without_left(cases: &mut Cases) {
    let problem = free_problem();
    let mut good = free_certificate(&problem);
    good.condensation.as_mut().unwrap().anchors[0].left = None;
    let note = "left absent: it is right";
    accept(cases, "free-left-absent", note, &problem, &good);

    let mut forged = good.clone();
    let anchor = &mut forged.condensation.as_mut().unwrap().anchors[0];
    anchor.right[0].rows[0] = integers(&[-5]).into();
    let note = "left absent beside W = -5/2: the remainders are too large";
    reject(
        cases,
        ["free-left-absent-far", "Cover.NotDefinite", note],
        &problem,
        &forged,
    );

    let with_null = replaced(
        &good.to_json(),
        "\"left_friction\"",
        "\"left\":null,\"left_friction\"",
    );
    let file = json!({
        "verdict": "accepted",
        "problem": problem_json(&problem),
        "certificate_text": with_null,
    });
    cases.push(
        "accept",
        "critical-free-left-null",
        file,
        "left is null, as if it were absent",
    );
}

/// A product of long numbers.
fn too_much_work(cases: &mut Cases) {
    let problem = problem_of_the_page();
    let mut forged = certificate_of_the_page(&problem);
    leaf(&mut forged).exponent = 16_384;
    let text = replaced(&forged.to_json(), "\"max\":\"2\"", "\"max\":\"2.@1\"");
    let repeated = Repeated {
        text,
        unit: "0",
        count: 99_990,
    };

    let note = "a leaf with numbers of 16,384 bits between t = 0 and one of 100,000 digits";
    cases.too_large(
        ["critical-hostile-regular", "Cover.TooLarge", note],
        &problem,
        &repeated,
    );
}

const MISSPELLINGS: [Misspelling; 8] = [
    Misspelling {
        name: "word",
        note: "the leaf as a word",
        from: "\"positive_definite\"",
        to: "\"regular\"",
    },
    Misspelling {
        name: "outcome",
        note: "a field of root leaves",
        from: "\"pivot\":1",
        to: "\"pivot\":1,\"outcome\":\"absent\"",
    },
    Misspelling {
        name: "no-pivot",
        note: "pivot missing",
        from: "\"pivot\":1,",
        to: "",
    },
    Misspelling {
        name: "pivot-negative",
        note: "a negative pivot",
        from: "\"pivot\":1",
        to: "\"pivot\":-1",
    },
    Misspelling {
        name: "fraction",
        note: "an entry of Y that is no integer",
        from: "\"inverse\":[[\"2\"]]",
        to: "\"inverse\":[[\"1/2\"]]",
    },
    Misspelling {
        name: "flat",
        note: "Y as a list of numbers",
        from: "\"inverse\":[[\"2\"]]",
        to: "\"inverse\":[\"2\"]",
    },
    Misspelling {
        name: "exponent-negative",
        note: "a negative exponent",
        from: "\"exponent\":3",
        to: "\"exponent\":-3",
    },
    Misspelling {
        name: "from",
        note: "from is 1/0",
        from: "\"from\":\"3/4\"",
        to: "\"from\":\"1/0\"",
    },
];
