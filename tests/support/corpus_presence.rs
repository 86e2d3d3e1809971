//! Presence on an interval of friction (`mceip-presence/1`): accepted files, and forgeries of each
//! obligation.
//!
//! The systems are those of `corpus_critical`, so that T(t, mu) can be read off. Truths are
//! computed by hand; those of the example of 5.19 stand there.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::{Cases, Forgery, Misspelling, Repeated, fold, problem_json, q, replaced};
use super::corpus_critical::{
    fold_system, free_condensation, free_problem, identity, one, system, with_zero_reaction,
};
use mceip_check::certificate::{PresenceCertificate, PresencePiece};
use mceip_exact::{Integer, parse, rational, whole};
use mceip_model::{Problem, Unknown, Window};
use serde_json::{Value, json};

pub fn presence(cases: &mut Cases) {
    one_particle(cases);
    above_the_fold(cases);
    between_corners(cases);
    at_rest(cases);
    with_a_free_variable(cases);
    a_negative_null_vector(cases);
    other_problems(cases);
    too_much_work(cases);
    cases.misspelt(
        "presence-",
        &free_problem(),
        &of_free(&free_problem()).to_json(),
        &MISSPELLINGS,
    );
}

fn accept(
    cases: &mut Cases,
    name: &str,
    note: &str,
    problem: &Problem,
    good: &PresenceCertificate,
) {
    let file = json!({
        "verdict": "accepted",
        "problem": problem_json(problem),
        "certificate": json_of(good),
    });
    cases.push("accept", &format!("presence-{name}"), file, note);
}

fn reject(
    cases: &mut Cases,
    [name, reason, note]: [&str; 3],
    problem: &Problem,
    forged: &PresenceCertificate,
) {
    let file = json!({
        "verdict": "rejected",
        "reason": reason,
        "problem": problem_json(problem),
        "certificate": json_of(forged),
    });
    cases.push("reject", &format!("presence-{name}"), file, note);
}

fn reject_all(
    cases: &mut Cases,
    problem: &Problem,
    good: &PresenceCertificate,
    forgeries: &[Forgery<PresenceCertificate>],
) {
    for forgery in forgeries {
        let Forgery {
            name, reason, note, ..
        } = forgery;
        reject(cases, [name, reason, note], problem, &forgery.of(good));
    }
}

fn json_of(certificate: &PresenceCertificate) -> Value {
    serde_json::from_str(&certificate.to_json()).unwrap()
}

fn integers(values: &[i64]) -> Vec<Integer> {
    values.iter().map(|&v| Integer::from(v)).collect()
}

/// A piece with one slip variable, which moves.
fn single(to: &str, interval: [&str; 2], slip: usize) -> PresencePiece {
    PresencePiece {
        to: q(to),
        interval: interval.map(q),
        anchor: None,
        support: vec![slip],
        pivot: slip,
        inverse: vec![],
        inverse_exponent: 0,
        left: vec![],
        right: vec![],
        exponent: 0,
    }
}

fn certificate(problem: &Problem, from: &str, pieces: Vec<PresencePiece>) -> PresenceCertificate {
    let to = pieces.last().map_or(whole(0), |piece| piece.to.0.clone());
    PresenceCertificate {
        problem_sha256: problem.sha256(),
        from: parse(from).unwrap(),
        to,
        condensation: None,
        pieces,
    }
}

const ONE_FORGERIES: [Forgery<PresenceCertificate>; 17] = [
    Forgery {
        name: "digest",
        reason: "Digest",
        note: "the digest of another system",
        change: |c| c.problem_sha256 = fold_system().sha256(),
    },
    Forgery {
        name: "from-negative",
        reason: "FrictionRange",
        note: "friction is not negative",
        change: |c| c.from = rational(-1, 2),
    },
    Forgery {
        name: "from-to",
        reason: "FrictionRange",
        note: "an interval of friction without length",
        change: |c| c.from = c.to.clone(),
    },
    Forgery {
        name: "from-above-to",
        reason: "FrictionRange",
        note: "an empty interval of friction",
        change: |c| c.from = whole(3),
    },
    Forgery {
        name: "no-piece",
        reason: "Cover.PieceEnd",
        note: "an interval of friction that nothing covers",
        change: |c| c.pieces.clear(),
    },
    Forgery {
        name: "piece-short",
        reason: "Cover.PieceEnd",
        note: "the last piece ends before the interval does",
        change: |c| c.to = rational(9, 4),
    },
    Forgery {
        name: "piece-beyond",
        reason: "Cover.PieceEnd",
        note: "the last piece ends beyond the interval",
        change: |c| c.to = rational(15, 8),
    },
    Forgery {
        name: "pieces-fall",
        reason: "Cover.PieceEnd",
        note: "the second piece ends where it begins",
        change: |c| c.pieces.insert(1, c.pieces[0].clone()),
    },
    Forgery {
        name: "piece-after-the-last",
        reason: "Cover.PieceEnd",
        note: "a piece before the last one ends at the end of the interval",
        change: |c| c.pieces[0].to = q("2"),
    },
    Forgery {
        name: "interval-negative",
        reason: "Cover.Interval",
        note: "lambda^2 is not negative",
        change: |c| c.pieces[0].interval[0] = q("-1/8"),
    },
    Forgery {
        name: "interval-point",
        reason: "Cover.Interval",
        note: "one value of lambda^2",
        change: |c| c.pieces[0].interval[0] = c.pieces[0].interval[1].clone(),
    },
    Forgery {
        name: "interval-reversed",
        reason: "Cover.Interval",
        note: "phi changes its sign all the same",
        change: |c| c.pieces[0].interval.reverse(),
    },
    Forgery {
        name: "support-empty",
        reason: "Cover.Pivot",
        note: "no variable moves",
        change: |c| c.pieces[0].support.clear(),
    },
    Forgery {
        name: "edge-lower",
        reason: "Cover.NoSignChange",
        note: "phi = 0 at the corner (1/4, 5/4)",
        change: |c| c.pieces[0].interval[0] = q("1/4"),
    },
    Forgery {
        name: "edge-upper",
        reason: "Cover.NoSignChange",
        note: "phi = 0 at the corner (1, 2)",
        change: |c| c.pieces[1].interval[1] = q("1"),
    },
    Forgery {
        name: "from-at",
        reason: "Cover.NoSignChange",
        note: "the critical friction: true, and phi = 0 at the corner (0, 1)",
        change: |c| c.from = whole(1),
    },
    Forgery {
        name: "from-below",
        reason: "Cover.NoSignChange",
        note: "below the critical friction there is nothing",
        change: |c| c.from = rational(7, 8),
    },
];

/// T(t, mu) = 1 + t - mu.
fn one_particle(cases: &mut Cases) {
    let problem = one();
    let pieces = vec![single("3/2", ["0", "1"], 0), single("2", ["1/8", "5/4"], 0)];
    let good = certificate(&problem, "5/4", pieces);
    accept(cases, "pieces", "two pieces", &problem, &good);
    reject_all(cases, &problem, &good, &ONE_FORGERIES);

    let one_piece = |from: &str| certificate(&problem, from, vec![single("2", ["0", "2"], 0)]);
    let almost = "1.000000000000000000000000000001";
    let note = "1e-30 above the critical friction: exact arithmetic has no margin";
    accept(cases, "almost", note, &problem, &one_piece(almost));
}

/// The example of 5.19.
fn of_fold(problem: &Problem) -> PresenceCertificate {
    let piece = PresencePiece {
        support: vec![0, 1],
        pivot: 1,
        inverse: vec![integers(&[1])],
        inverse_exponent: 1,
        left: integers(&[-3]),
        right: integers(&[24]),
        exponent: 4,
        ..single("5/2", ["5/2", "5"], 1)
    };
    certificate(problem, "2", vec![piece])
}

const FOLD_FORGERIES: [Forgery<PresenceCertificate>; 19] = [
    Forgery {
        name: "support-falls",
        reason: "Cover.SupportList",
        note: "a support that does not ascend",
        change: |c| c.pieces[0].support.reverse(),
    },
    Forgery {
        name: "support-twice",
        reason: "Cover.SupportList",
        note: "a variable listed twice",
        change: |c| c.pieces[0].support = vec![0, 0, 1],
    },
    Forgery {
        name: "support-nowhere",
        reason: "Cover.SupportList",
        note: "a variable that does not exist",
        change: |c| c.pieces[0].support = vec![0, 2],
    },
    Forgery {
        name: "pivot-at-rest",
        reason: "Cover.Pivot",
        note: "the pivot does not move",
        change: |c| c.pieces[0].support = vec![0],
    },
    Forgery {
        name: "left-length",
        reason: "Cover.Length",
        note: "the pivot has no entry in left",
        change: |c| c.pieces[0].left = integers(&[-3, 16]),
    },
    Forgery {
        name: "right-length",
        reason: "Cover.Length",
        note: "right has no entry",
        change: |c| c.pieces[0].right.clear(),
    },
    Forgery {
        name: "inverse-length",
        reason: "Cover.Length",
        note: "inverse has no row",
        change: |c| c.pieces[0].inverse.clear(),
    },
    Forgery {
        name: "inverse-row",
        reason: "Cover.Length",
        note: "a row of inverse is too long",
        change: |c| c.pieces[0].inverse[0] = integers(&[1, 0]),
    },
    Forgery {
        name: "exponent",
        reason: "Cover.TooLarge",
        note: "an exponent beyond 16384",
        change: |c| c.pieces[0].inverse_exponent = 16_385,
    },
    Forgery {
        name: "inverse-zero",
        reason: "Cover.NotContracting",
        note: "Y = 0 shows nothing of T'",
        change: |c| c.pieces[0].inverse = vec![integers(&[0])],
    },
    Forgery {
        name: "inverse-at-one-corner",
        reason: "Cover.NotContracting",
        note: "|1 - Y T'| = 17/16 at t = 5 alone",
        change: |c| {
            c.pieces[0].inverse = vec![integers(&[11])];
            c.pieces[0].inverse_exponent = 3;
        },
    },
    Forgery {
        name: "right-zero",
        reason: "Cover.NotContracting",
        note: "a component of right that is not positive",
        change: |c| c.pieces[0].right = integers(&[0]),
    },
    Forgery {
        name: "right-negative",
        reason: "Cover.NotContracting",
        note: "a component of right that is negative",
        change: |c| c.pieces[0].right = integers(&[-24]),
    },
    Forgery {
        name: "right-far",
        reason: "Cover.Sign",
        note: "theta > 1: x > 0 is not shown",
        change: |c| c.pieces[0].right = integers(&[8]),
    },
    Forgery {
        name: "left-far",
        reason: "Cover.NoSignChange",
        note: "u = 0 is too far off for the sign of phi",
        change: |c| c.pieces[0].left = integers(&[0]),
    },
    Forgery {
        name: "left-reversed",
        reason: "Cover.NoSignChange",
        note: "u with the other sign",
        change: |c| c.pieces[0].left = integers(&[3]),
    },
    Forgery {
        name: "both-below",
        reason: "Cover.NoSignChange",
        note: "phi is negative at both edges",
        change: |c| c.pieces[0].interval[1] = q("11/4"),
    },
    Forgery {
        name: "from-below-the-fold",
        reason: "Cover.NoSignChange",
        note: "below the fold there is nothing",
        change: |c| c.from = rational(7, 4),
    },
    Forgery {
        name: "both-branches",
        reason: "Cover.NoSignChange",
        note: "at mu = 2 there is a solution on both branches between 1 and 5",
        change: |c| {
            c.pieces[0].interval[0] = q("3/2");
            c.pieces[0].to = q("17/8");
            c.to = rational(17, 8);
        },
    },
];

fn above_the_fold(cases: &mut Cases) {
    let problem = fold_system();
    let good = of_fold(&problem);
    accept(cases, "fold", "the example of 5.19", &problem, &good);
    reject_all(cases, &problem, &good, &FOLD_FORGERIES);
}

/// With T' = 1 + 2^-20 t, a = -3 - mu, b = mu - 3 and c = 19/2 + t - 4 mu, T = [[T', a], [b, c]].
/// With v = 4, which is null at mu = 1, and u = 0, which is null at mu = 3, u'Tv = t - 5/2, and phi
/// is about u'Tv - (mu - 1)(3 - mu): at mu = 2 it is 1 less than at both ends of [1, 3].
fn between_corners(cases: &mut Cases) {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 1, whole(-3)),
        (1, 1, rational(19, 2)),
        (1, 2, whole(-1)),
        (0, 3, whole(1)),
        (1, 3, whole(-4)),
        (2, 2, whole(200)),
        (3, 3, whole(200)),
    ];
    let mass = [
        (0, 0, rational(1, 1 << 20)),
        (1, 1, whole(1)),
        (2, 2, whole(1)),
        (3, 3, whole(1)),
    ];
    let problem = system(4, &[(0, 2), (1, 3)], &stiffness, &mass);

    // Row 0 is divided by 4, so Y = 4.
    let of = |upper: &str| {
        let piece = PresencePiece {
            support: vec![0, 1],
            pivot: 1,
            inverse: vec![integers(&[4])],
            left: integers(&[0]),
            right: integers(&[4]),
            ..single("3", ["0", upper], 1)
        };
        certificate(&problem, "1", vec![piece])
    };

    let note = "the mixed product of an edge is 4, the sum at its ends 7";
    accept(cases, "mixed", note, &problem, &of("6"));
    let note = "u'Tv = 1/2 at both ends of the edge t = 3, and phi = -1/2 between them, at mu = 2";
    let reason = "Cover.NoSignChange";
    reject(cases, ["mixed-small", reason, note], &problem, &of("3"));
}

/// The fold beside a third particle at rest, with y = 14 x_0 + b x_1. Over the box of the example
/// x_0 >= (1 - theta) v = 9/14, so b >= -9 is shown to suffice.
fn beside_the_fold(b: &str) -> Problem {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 4, whole(1)),
        (1, 1, whole(2)),
        (1, 3, whole(-3)),
        (1, 4, whole(-4)),
        (0, 2, whole(14)),
        (1, 2, parse(b).unwrap()),
        (2, 2, whole(12)),
        (3, 3, whole(14)),
        (4, 4, whole(14)),
        (5, 5, whole(14)),
    ];
    system(6, &[(0, 3), (1, 4), (2, 5)], &stiffness, &identity(6))
}

fn at_rest(cases: &mut Cases) {
    // Rows 0 and 1 are divided by 16 and not by 4 and 8, as they hold 14 and b.
    let of = |problem: &Problem| {
        let mut certificate = of_fold(problem);
        let piece = &mut certificate.pieces[0];
        piece.inverse = vec![integers(&[2])];
        piece.inverse_exponent = 0;
        piece.left = integers(&[-6]);
        certificate
    };

    let problem = beside_the_fold("-9");
    let note = "y of the variable at rest is shown to be >= 0, with no margin";
    accept(cases, "rest", note, &problem, &of(&problem));

    let problem = beside_the_fold("-9.00000000000000000001");
    let note = "y > 0 where x = v, and not for every x within theta of it";
    let reason = "Cover.Sign";
    reject(cases, ["rest-hair", reason, note], &problem, &of(&problem));

    let problem = beside_the_fold("-13");
    let note = "y < 0 at the corner (5, 2), if x is small there";
    reject(
        cases,
        ["rest-corner", reason, note],
        &problem,
        &of(&problem),
    );
}

/// The example of 5.19 with a free variable: T(t, mu) = 3 + t - 4 (1 + mu) / (4 + t).
fn of_free(problem: &Problem) -> PresenceCertificate {
    let piece = PresencePiece {
        anchor: Some(0),
        ..single("7/2", ["0", "1"], 1)
    };
    PresenceCertificate {
        condensation: Some(free_condensation()),
        ..certificate(problem, "3", vec![piece])
    }
}

const FREE_FORGERIES: [Forgery<PresenceCertificate>; 10] = [
    Forgery {
        name: "free-no-condensation",
        reason: "Cover.Condensation",
        note: "free variables and no condensation",
        change: |c| c.condensation = None,
    },
    Forgery {
        name: "free-anchor-1",
        reason: "Cover.Anchor",
        note: "an anchor that does not exist",
        change: |c| c.pieces[0].anchor = Some(1),
    },
    Forgery {
        name: "free-no-anchor",
        reason: "Cover.Anchor",
        note: "no anchor where the pencil is condensed",
        change: |c| c.pieces[0].anchor = None,
    },
    Forgery {
        name: "free-support",
        reason: "Cover.SupportList",
        note: "a free variable in the support",
        change: |c| c.pieces[0].support = vec![0, 1],
    },
    Forgery {
        name: "free-sigma",
        reason: "Cover.Hypothesis",
        note: "sigma is larger than K_ff",
        change: |c| c.condensation.as_mut().unwrap().sigma = q("5"),
    },
    Forgery {
        name: "free-left",
        reason: "Cover.NoSignChange",
        note: "V of T0 that approximates nothing leaves a large remainder",
        change: |c| {
            let anchor = &mut c.condensation.as_mut().unwrap().anchors[0];
            anchor.left.as_mut().unwrap()[0].rows[0] = integers(&[40]).into();
        },
    },
    Forgery {
        name: "free-left-friction",
        reason: "Cover.NoSignChange",
        note: "V of T1 that approximates nothing leaves a large remainder",
        change: |c| {
            let anchor = &mut c.condensation.as_mut().unwrap().anchors[0];
            anchor.left_friction[0].rows[0] = integers(&[40]).into();
        },
    },
    Forgery {
        name: "free-at",
        reason: "Cover.NoSignChange",
        note: "phi = 0 at (1, 4)",
        change: |c| {
            c.to = whole(4);
            c.pieces[0].to = q("4");
        },
    },
    Forgery {
        name: "free-above",
        reason: "Cover.NoSignChange",
        note: "phi < 0 at (1, 5)",
        change: |c| {
            c.to = whole(5);
            c.pieces[0].to = q("5");
        },
    },
    Forgery {
        name: "free-below",
        reason: "Cover.NoSignChange",
        note: "below the critical friction, which is 2, there is nothing",
        change: |c| c.from = rational(3, 2),
    },
];

fn with_a_free_variable(cases: &mut Cases) {
    let problem = free_problem();
    let good = of_free(&problem);
    accept(cases, "free", "the example of 5.19", &problem, &good);

    let mut absent = good.clone();
    absent.condensation.as_mut().unwrap().anchors[0].left = None;
    let note = "left absent: it is right";
    accept(cases, "free-left-absent", note, &problem, &absent);

    let mut small = good.clone();
    let anchor = &mut small.condensation.as_mut().unwrap().anchors[0];
    anchor.left.as_mut().unwrap()[0].exponent = 54;
    let note = "V = -2^-54: accepted if norms that are whole numbers of units are not rounded up";
    accept(cases, "free-left-small", note, &problem, &small);

    let mut empty = good.clone();
    let anchor = &mut empty.condensation.as_mut().unwrap().anchors[0];
    anchor.right.clear();
    empty.pieces[0].interval = ["0", "6"].map(q);
    let note = "W = 0 beside V = F^-1 T_sf': no remainder at t = 0";
    accept(cases, "free-right-empty", note, &problem, &empty);

    let anchor = &mut empty.condensation.as_mut().unwrap().anchors[0];
    anchor.left = None;
    let note = "left absent beside W = 0, so that V = 0 as well: a remainder as large as T";
    let words = ["free-left-absent-far", "Cover.NoSignChange", note];
    reject(cases, words, &problem, &empty);
    reject_all(cases, &problem, &good, &FREE_FORGERIES);

    // At t = 0 the remainder is 0: phi = 2 - mu is negative just above 2.
    let mut from_two = good;
    from_two.from = parse("2.000000000000000000000000000001").unwrap();
    let note = "an edge is enclosed at its own t, where the remainder is 0";
    accept(cases, "free-edge", note, &problem, &from_two);
}

/// T = [[1 + t, 3], [3, 1 + t]] whatever mu is. With x > 0 all of T x is positive, so there is no
/// solution. With v = -1 and Y = 5 the inequality |I - Y T'| v < v holds, and so do all obligations
/// after it: only v > 0 is missing.
fn a_negative_null_vector(cases: &mut Cases) {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 1, whole(3)),
        (1, 1, whole(1)),
        (2, 2, whole(14)),
        (3, 3, whole(14)),
    ];
    let problem = system(4, &[(0, 2), (1, 3)], &stiffness, &identity(4));

    let piece = PresencePiece {
        support: vec![0, 1],
        pivot: 1,
        inverse: vec![integers(&[5])],
        left: integers(&[-1]),
        right: integers(&[-1]),
        ..single("5/2", ["3/2", "5/2"], 1)
    };
    let forged = certificate(&problem, "2", vec![piece]);
    let note = "v < 0: the inequality of a contraction says nothing, and the statement is false";
    reject(
        cases,
        ["negative-null-vector", "Cover.NotContracting", note],
        &problem,
        &forged,
    );
}

/// Problems that the format does not speak of.
fn other_problems(cases: &mut Cases) {
    let of = |problem: &Problem| certificate(problem, "5/4", vec![single("2", ["0", "2"], 0)]);

    let pencil = fold("0", None);
    let note = "a pencil has no friction";
    reject(cases, ["pencil", "NotASystem", note], &pencil, &of(&pencil));

    let mu = Problem::new(one().body().clone(), Unknown::Mu, Window::all()).unwrap();
    let note = "the problem asks for mu at lambda^2 = 0";
    reject(cases, ["unknown", "Unknown", note], &mu, &of(&mu));

    let zero = with_zero_reaction();
    let note = "a particle with zero reaction has four modes, which the format does not know";
    reject(
        cases,
        ["zero-reaction", "ZeroReaction", note],
        &zero,
        &of(&zero),
    );

    let problem = one();
    let mut needless = of(&problem);
    needless.condensation = Some(free_condensation());
    let note = "a condensation without free variables";
    let reason = "Cover.Condensation";
    reject(cases, ["condensation", reason, note], &problem, &needless);
}

/// Products of long numbers.
fn too_much_work(cases: &mut Cases) {
    let problem = system(
        10,
        &[(0, 5), (1, 6), (2, 7), (3, 8), (4, 9)],
        &[],
        &identity(10),
    );
    let zeros = integers(&[0; 4]);
    let piece = PresencePiece {
        support: (0..5).collect(),
        pivot: 4,
        inverse: vec![zeros.clone(); 4],
        left: zeros.clone(),
        right: zeros,
        exponent: 16_384,
        ..single("2", ["1", "2"], 4)
    };

    let certificate = certificate(&problem, "1", vec![piece]);
    let interval = "\"interval\":[\"1\",\"2.@1\"]";
    let text = replaced(
        &certificate.to_json(),
        "\"interval\":[\"1\",\"2\"]",
        interval,
    );
    let repeated = Repeated {
        text,
        unit: "0",
        count: 99_990,
    };

    let note = "a witness with numbers of 16,384 bits below a value of t of 100,000 digits";
    cases.too_large(
        ["presence-hostile", "Cover.TooLarge", note],
        &problem,
        &repeated,
    );
}

const MISSPELLINGS: [Misspelling; 12] = [
    Misspelling {
        name: "version",
        note: "another version",
        from: "mceip-presence/1",
        to: "mceip-presence/2",
    },
    Misspelling {
        name: "no-from",
        note: "from missing",
        from: "\"from\":\"3\",",
        to: "",
    },
    Misspelling {
        name: "to-null",
        note: "to is null, which is no infinity",
        from: "\"to\":\"7/2\"",
        to: "\"to\":null",
    },
    Misspelling {
        name: "duplicate-from",
        note: "two values of from",
        from: "\"from\":\"3\"",
        to: "\"from\":\"3\",\"from\":\"2\"",
    },
    Misspelling {
        name: "tail",
        note: "a tail, which has no use here",
        from: "\"anchors\":",
        to: "\"tail\":null,\"anchors\":",
    },
    Misspelling {
        name: "no-interval",
        note: "a piece without interval",
        from: "\"interval\":[\"0\",\"1\"],",
        to: "",
    },
    Misspelling {
        name: "interval-of-three",
        note: "an interval of three numbers",
        from: "\"interval\":[\"0\",\"1\"]",
        to: "\"interval\":[\"0\",\"1\",\"2\"]",
    },
    Misspelling {
        name: "interval-infinite",
        note: "an interval to infinity",
        from: "\"interval\":[\"0\",\"1\"]",
        to: "\"interval\":[\"0\",null]",
    },
    Misspelling {
        name: "inverse-fraction",
        note: "an entry of inverse that is no integer",
        from: "\"inverse\":[]",
        to: "\"inverse\":[[\"1/2\"]]",
    },
    Misspelling {
        name: "pivot-negative",
        note: "a negative index",
        from: "\"pivot\":1",
        to: "\"pivot\":-1",
    },
    Misspelling {
        name: "exponent-negative",
        note: "a negative exponent",
        from: "\"inverse_exponent\":0",
        to: "\"inverse_exponent\":-1",
    },
    Misspelling {
        name: "outcome",
        note: "a field of root leaves",
        from: "\"pivot\":1",
        to: "\"pivot\":1,\"outcome\":\"solution\"",
    },
];
