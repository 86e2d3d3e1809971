//! Claims of solutions: what is accepted, and a forgery of each obligation.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Unknown, Window};

pub fn exact_claims(cases: &mut Cases) {
    let (p, good) = root_two();
    let own = |c: &ExactSolution| claims(&p, Claim::ExactSolution(c.clone()));
    cases.accept(
        "exact",
        "t = sqrt 2 - 1 on two of three variables",
        &p,
        &own(&good),
    );
    let scaled = ExactSolution {
        x: good
            .x
            .iter()
            .map(|g| g.iter().map(|n| Number(&n.0 * rational(7, 3))).collect())
            .collect(),
        ..good.clone()
    };
    cases.accept(
        "exact-scaled",
        "x times 7/3 is the same solution",
        &p,
        &own(&scaled),
    );
    let unreduced = ExactSolution {
        x: vec![
            numbers(&["1"]),
            numbers(&["0", "3", "1"]),
            numbers(&["-1", "2", "1"]),
        ],
        ..good.clone()
    };
    cases.accept(
        "exact-unreduced",
        "polynomials of higher degree that are equal mod p, one of them 0 mod p",
        &p,
        &own(&unreduced),
    );
    type Change = fn(&mut ExactSolution);
    let forged: [(&str, &str, &str, Change); 22] = [
        ("degree", "TooLarge", "513 coefficients", |c| {
            c.polynomial = vec![Integer::from(1); 513]
        }),
        ("degree-of-x", "TooLarge", "x of 513 coefficients", |c| {
            c.x[0] = vec![Number(whole(1)); 513]
        }),
        ("wrong-root", "NoSignChange", "p of another number", |c| {
            c.polynomial[0] = Integer::from(-2)
        }),
        (
            "other-root",
            "YNotZero",
            "a root in the interval that is no eigenvalue",
            |c| c.polynomial = vec![(-9).into(), 20.into()],
        ),
        (
            "interval-shifted",
            "NoSignChange",
            "the interval beside the root",
            |c| c.interval = [q("1/2"), q("3/5")],
        ),
        (
            "interval-end-1e-30",
            "NoSignChange",
            "lower end 1e-30 above the root",
            |c| c.interval[0] = q("0.414213562373095048801688724210"),
        ),
        (
            "not-isolated",
            "NotIsolated",
            "a turning point of p in the interval",
            |c| c.interval = [q("-2"), q("1")],
        ),
        ("interval-reversed", "ReversedInterval", "a > b", |c| {
            c.interval.swap(0, 1)
        }),
        ("point-no-root", "NotARoot", "a = b, p(a) != 0", |c| {
            c.interval[1] = c.interval[0].clone()
        }),
        (
            "negative-value",
            "OutsideWindow",
            "the other root of p, lambda^2 < 0",
            |c| c.interval = [q("-3"), q("-2")],
        ),
        ("constant-polynomial", "ConstantPolynomial", "p = 0", |c| {
            c.polynomial = vec![0.into()]
        }),
        ("sign-flipped", "XNotPositive", "x_0 negative", |c| {
            c.x[0][0].0 = whole(-1)
        }),
        ("zero-x", "XNotPositive", "x = 0", |c| c.x = vec![vec![]; 3]),
        (
            "kernel-off",
            "YNotZero",
            "kernel vector off by 1e-12 in one coefficient",
            |c| c.x[1][0].0 += tiny(),
        ),
        (
            "support-short",
            "XOffSupport",
            "a moving variable is not listed",
            |c| c.support = vec![0],
        ),
        (
            "support-long",
            "XNotPositive",
            "a resting variable is listed",
            |c| c.support.push(2),
        ),
        ("support-not-ascending", "IndexSet", "support [1, 0]", |c| {
            c.support = vec![1, 0]
        }),
        (
            "support-out-of-range",
            "IndexSet",
            "index 3 of 3 variables",
            |c| c.support = vec![0, 1, 3],
        ),
        (
            "biactive-invented",
            "Biactive",
            "y_2 > 0 called zero",
            |c| c.biactive = vec![2],
        ),
        (
            "biactive-on-support",
            "Biactive",
            "a moving variable called biactive",
            |c| c.biactive = vec![0],
        ),
        ("x-long", "Length", "one polynomial too many", |c| {
            c.x.push(vec![])
        }),
        (
            "resting-moves",
            "XOffSupport",
            "x_2 = 1 off the support",
            |c| c.x[2] = numbers(&["1"]),
        ),
    ];
    for (name, reason, note, change) in forged {
        let mut c = good.clone();
        change(&mut c);
        cases.reject(&format!("exact-{name}"), reason, note, &p, &own(&c));
    }
    frame(cases);
    signs(cases);
    free(cases);
}

fn frame(cases: &mut Cases) {
    let (p, good) = root_two();
    let own = claims(&p, Claim::ExactSolution(good));
    let other = fold("0", None);
    cases.reject(
        "other-problem",
        "Digest",
        "another problem's certificate",
        &other,
        &own,
    );
    cases.reject(
        "other-unknown",
        "Unknown",
        "made for MCEIP-mu",
        &p,
        &Certificate {
            unknown: Unknown::Mu,
            ..own.clone()
        },
    );
    cases.reject(
        "nothing-claimed",
        "NoClaims",
        "no claim, no cover",
        &p,
        &Certificate {
            claims: vec![],
            ..own.clone()
        },
    );
    let window = Window::new(whole(0), Some(rational(9, 20))).unwrap();
    cases.reject(
        "outside-own-window",
        "OutsideWindow",
        "the interval leaves the certificate's window",
        &p,
        &Certificate { window, ..own },
    );
}

fn signs(cases: &mut Cases) {
    let with = |y: &str| pencil(&[&["-1", "0"], &[y, "5"]], I2, &[]);
    let c = exact(&[0], &[-1, 1], ("1", "1"), &[&["1"], &[]]);
    let of =
        |p: &mceip_model::Problem, c: &ExactSolution| claims(p, Claim::ExactSolution(c.clone()));
    let (positive, zero, negative) = (with("1e-30"), with("0"), with("-1e-30"));
    cases.accept(
        "exact-y-1e-30",
        "y_1 = 1e-30 > 0",
        &positive,
        &of(&positive, &c),
    );
    cases.reject(
        "exact-y-negative-1e-30",
        "YNotPositive",
        "y_1 = -1e-30: no double sees it",
        &negative,
        &of(&negative, &c),
    );
    cases.reject(
        "exact-biactive-missing",
        "Biactive",
        "y_1 = 0 not listed",
        &zero,
        &of(&zero, &c),
    );
    let biactive = ExactSolution {
        biactive: vec![1],
        ..c.clone()
    };
    cases.accept(
        "exact-biactive",
        "x_1 = y_1 = 0",
        &zero,
        &of(&zero, &biactive),
    );
    cases.reject(
        "exact-biactive-1e-30",
        "Biactive",
        "y_1 = 1e-30 called zero",
        &positive,
        &of(&positive, &biactive),
    );
    let at_end = exact(&[0], &[-1, 1], ("1", "2"), &[&["1"], &[]]);
    cases.reject(
        "exact-root-at-end",
        "NoSignChange",
        "the root is an end of the interval",
        &positive,
        &of(&positive, &at_end),
    );
    // y_2 = (t - 9/20) x_0 is negative at the root but changes sign in [2/5, 1/2].
    let open = |shift: &str| {
        pencil(
            &[&["1", "-1", "0"], &["-2", "1", "0"], &[shift, "0", "9"]],
            &[&["1", "0", "0"], &["0", "1", "0"], &["1", "0", "1"]],
            &[],
        )
    };
    let (bad, good, (_, wide)) = (open("-9/20"), open("-2/5"), root_two());
    let narrow = ExactSolution {
        interval: [q("41/100"), q("42/100")],
        ..wide.clone()
    };
    cases.reject(
        "exact-sign-open",
        "YNotPositive",
        "the interval leaves the sign of y_2 open",
        &bad,
        &of(&bad, &wide),
    );
    cases.reject(
        "exact-sign-closed-negative",
        "YNotPositive",
        "the same, on an interval that shows y_2 < 0",
        &bad,
        &of(&bad, &narrow),
    );
    cases.accept(
        "exact-sign-narrow",
        "an interval narrow enough for the sign of y_2",
        &good,
        &of(&good, &narrow),
    );
    let zero = pencil(&[&["1", "-1"], &["-1", "1"]], I2, &[]);
    let at_zero = exact(&[0, 1], &[0, 1], ("0", "0"), &[&["1"], &["1"]]);
    cases.accept(
        "threshold-lambda2-zero",
        "lambda^2 = 0: a threshold; gamma of Proposition 2 is free and not stated",
        &zero,
        &of(&zero, &at_zero),
    );
    let above = pencil(&[&["1.000000000001", "-1"], &["-1", "1"]], I2, &[]);
    cases.reject(
        "threshold-missed",
        "YNotZero",
        "the threshold missed by 1e-12",
        &above,
        &of(&above, &at_zero),
    );
}

fn free(cases: &mut Cases) {
    let p = pencil(&[&["-1", "0"], &["3", "2"]], I2, &[0]);
    let c = exact(&[], &[-1, 1], ("1", "1"), &[&["1"], &[]]);
    let own = |c: ExactSolution| claims(&p, Claim::ExactSolution(c));
    cases.accept(
        "exact-free-only",
        "a free variable moves alone",
        &p,
        &own(c.clone()),
    );
    cases.reject(
        "exact-x-zero",
        "XZero",
        "nothing moves",
        &p,
        &own(ExactSolution {
            x: vec![vec![], vec![]],
            ..c.clone()
        }),
    );
    let at_two = ExactSolution {
        polynomial: vec![(-2).into(), 1.into()],
        interval: [q("2"), q("2")],
        ..c.clone()
    };
    cases.reject(
        "exact-free-row",
        "YNotZero",
        "E13: a free row out of balance",
        &p,
        &own(at_two),
    );
    cases.reject(
        "exact-free-in-support",
        "IndexSet",
        "a free variable in the support",
        &p,
        &own(ExactSolution {
            support: vec![0],
            ..c
        }),
    );
}

pub fn enclosed_claims(cases: &mut Cases) {
    let (p, good) = boxed();
    let own = |c: &EnclosedSolution| claims(&p, Claim::EnclosedSolution(c.clone()));
    cases.accept("enclosed", "a box around t = 3", &p, &own(&good));
    let wide = |r: Rational| EnclosedSolution {
        radius: vec![Number(r); 3],
        ..good.clone()
    };
    cases.accept(
        "enclosed-wide",
        "radius just below the bound 1/4",
        &p,
        &own(&wide(rational(1, 4) - rational(1, 1_000_000))),
    );
    cases.reject(
        "enclosed-bound",
        "NotContracting",
        "radius at its bound: equality proves nothing",
        &p,
        &own(&wide(rational(1, 4))),
    );
    type Change = fn(&mut EnclosedSolution);
    let forged: [(&str, &str, &str, Change); 10] = [
        ("zero-preconditioner", "NotContracting", "a zero row", |c| {
            c.preconditioner[2] = vec![0.into(); 3]
        }),
        (
            "centre-off",
            "NotContracting",
            "centre off by more than the box",
            |c| c.center[2].0 += rational(1, 1 << 18),
        ),
        ("box-too-large", "NotContracting", "radius 4", |c| {
            c.radius = vec![Number(whole(4)); 3]
        }),
        ("no-width", "Radius", "a radius of zero", |c| {
            c.radius[1].0 = whole(0)
        }),
        ("short-centre", "Length", "an unknown missing", |c| {
            c.center.truncate(2)
        }),
        ("short-radius", "Length", "a radius missing", |c| {
            c.radius.truncate(1)
        }),
        ("short-preconditioner", "Length", "a row missing", |c| {
            c.preconditioner.truncate(2)
        }),
        ("ragged-preconditioner", "Length", "an entry missing", |c| {
            c.preconditioner[0].truncate(2)
        }),
        (
            "exponent",
            "TooLarge",
            "a small file that asks for gigabytes",
            |c| c.exponent = u32::MAX,
        ),
        ("empty-support", "XZero", "nothing moves", |c| {
            c.support.clear()
        }),
    ];
    for (name, reason, note, change) in forged {
        let mut c = good.clone();
        change(&mut c);
        cases.reject(&format!("enclosed-{name}"), reason, note, &p, &own(&c));
    }
    let a: &[&[&str]] = &[&["-1", "-2", "0"], &["-2", "-1", "0"], &["1", "-1", "9"]];
    let stuck = pencil(
        a,
        &[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]],
        &[],
    );
    let note = "y_2 = 0 at the solution: no strict sign over a box";
    cases.reject(
        "enclosed-biactive",
        "YNotPositive",
        note,
        &stuck,
        &claims(&stuck, Claim::EnclosedSolution(good)),
    );
}

pub fn lifted_claims(cases: &mut Cases) {
    for (unknown, name) in [(Unknown::Lambda2, "lifted"), (Unknown::Mu, "lifted-mu")] {
        let p = mechanical(unknown);
        let listed = mceip_model::reduction::reduce(&p).unwrap().pencil;
        let found = mceip_oracle::enumerate(&listed, p.window())
            .unwrap()
            .solutions;
        let s = found.first().unwrap();
        let candidate = mceip_engine::candidate::Candidate {
            value: s.decimal(17).parse().unwrap(),
            x: s.x_decimals(&listed.slip(), 17)
                .iter()
                .map(|t| t.parse().unwrap())
                .collect(),
        };
        let Claim::ExactSolution(exact) =
            mceip_engine::certify::propose(&listed, p.window(), &candidate).unwrap()
        else {
            unreachable!()
        };
        let good = lift(&p, &exact);
        let own = |c: &LiftedSolution| claims(&p, Claim::LiftedSolution(c.clone()));
        cases.accept(
            name,
            "v and w of (9), the second particle at rest",
            &p,
            &own(&good),
        );
        cases.accept(
            &format!("{name}-as-pencil"),
            "the same solution about the pencil",
            &p,
            &claims(&p, Claim::ExactSolution(exact)),
        );
        if unknown == Unknown::Mu {
            continue;
        }
        let add = |p: &mut Vec<Number>, k: usize, by: &Rational| {
            p.resize_with(p.len().max(k + 1), || Number(whole(0)));
            p[k].0 += by;
        };
        // v at one dof together with w = (t M + K) v, so that only a later line breaks.
        let moved = |dof: usize| {
            let mut c = good.clone();
            add(&mut c.v[dof], 0, &tiny());
            let s = system(&p);
            s.stiffness()
                .entries()
                .filter(|e| e.1 == dof)
                .for_each(|(i, _, k)| add(&mut c.w[i], 0, &(k * tiny())));
            s.mass()
                .unwrap()
                .entries()
                .filter(|e| e.1 == dof)
                .for_each(|(i, _, m)| add(&mut c.w[i], 1, &(m * tiny())));
            c
        };
        let with = |change: &dyn Fn(&mut LiftedSolution)| {
            let mut c = good.clone();
            change(&mut c);
            c
        };
        let backwards = |c: &mut LiftedSolution| {
            c.v.iter_mut()
                .chain(&mut c.w)
                .flatten()
                .for_each(|n| n.0 = -n.0.clone())
        };
        let forged = [
            (
                "motion",
                "Line",
                "w off by 1e-12: (t M + K) v = w",
                with(&|c| add(&mut c.w[6], 0, &tiny())),
            ),
            ("free-reaction", "Line", "w_f = 1e-12", moved(0)),
            (
                "stick-tangential",
                "Line",
                "a sticking particle slides",
                moved(3),
            ),
            (
                "stick-normal",
                "Line",
                "a sticking particle lifts off",
                moved(4),
            ),
            (
                "normal-rate",
                "Line",
                "a slipping particle lifts off",
                moved(6),
            ),
            ("slip-backwards", "Line", "S v_T > 0", with(&backwards)),
            (
                "rest-called-slip",
                "Line",
                "support lists a particle at rest",
                with(&|c| c.support = vec![1, 2]),
            ),
            (
                "slip-called-rest",
                "Line",
                "support hides a slipping particle",
                with(&|c| c.support.clear()),
            ),
            (
                "rest-called-biactive",
                "Line",
                "strictly inside the cone, called on it",
                with(&|c| c.biactive = vec![2]),
            ),
            (
                "v-zero",
                "Line",
                "v = w = 0",
                with(&|c| c.v.iter_mut().chain(&mut c.w).for_each(Vec::clear)),
            ),
            (
                "v-short",
                "Length",
                "a dof missing",
                with(&|c| c.v.truncate(6)),
            ),
            (
                "w-long",
                "Length",
                "a dof too many",
                with(&|c| c.w.push(Vec::new())),
            ),
        ];
        for (name, reason, note, c) in forged {
            cases.reject(&format!("lifted-{name}"), reason, note, &p, &own(&c));
        }
        let pencil = root_two().0;
        let note = "physical vectors for a problem without dofs";
        cases.reject(
            "lifted-for-a-pencil",
            "NotASystem",
            note,
            &pencil,
            &claims(&pencil, Claim::LiftedSolution(good)),
        );
    }
}
