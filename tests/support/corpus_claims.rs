//! Claims of solutions: what is accepted, and a forgery of each obligation.
//!
//! Exact claims name the value by a polynomial and an interval, x by polynomials in the value;
//! enclosed claims are boxes that hold one solution; lifted claims are the motion of a system's
//! degrees of freedom. The solutions are computed by hand or, for the system, by the enumerator
//! (`mceip_oracle`). A deviation of 1e-12 or 1e-30 is rejected, which no checker in doubles sees.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::propose;
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Problem, Unknown, Window};

pub fn exact_claims(cases: &mut Cases) {
    spellings_of_one_solution(cases);

    let (problem, good) = root_two();
    for forgery in VALUES.iter().chain(&VECTORS) {
        let name = format!("exact-{}", forgery.name);
        let forged = exact_certificate(&problem, &forgery.of(&good));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }

    frame(cases);
    signs(cases);
    signs_by_intervals(cases);
    threshold(cases);
    free_variable(cases);
}

fn spellings_of_one_solution(cases: &mut Cases) {
    let (problem, good) = root_two();
    cases.accept(
        "exact",
        "t = sqrt 2 - 1 on two of three variables",
        &problem,
        &exact_certificate(&problem, &good),
    );

    let mut scaled = good.clone();
    for coefficient in scaled.x.iter_mut().flatten() {
        coefficient.0 *= rational(7, 3);
    }
    cases.accept(
        "exact-scaled",
        "x times 7/3 is the same solution",
        &problem,
        &exact_certificate(&problem, &scaled),
    );

    let unreduced = ExactSolution {
        x: vec![
            numbers(&["1"]),
            numbers(&["0", "3", "1"]),
            numbers(&["-1", "2", "1"]),
        ],
        ..good
    };

    cases.accept(
        "exact-unreduced",
        "polynomials of higher degree that are equal mod p, one of them 0 mod p",
        &problem,
        &exact_certificate(&problem, &unreduced),
    );
}

/// The value of `root_two`: p = t^2 + 2 t - 1 in [2/5, 1/2].
const VALUES: [Forgery<ExactSolution>; 10] = [
    Forgery {
        name: "degree",
        reason: "TooLarge",
        note: "513 coefficients",
        change: |claim| claim.polynomial = vec![Integer::from(1); 513],
    },
    Forgery {
        name: "wrong-root",
        reason: "NoSignChange",
        note: "p of another number",
        change: |claim| claim.polynomial[0] = Integer::from(-2),
    },
    Forgery {
        name: "other-root",
        reason: "YNotZero",
        note: "a root in the interval that is no eigenvalue",
        change: |claim| claim.polynomial = vec![(-9).into(), 20.into()],
    },
    Forgery {
        name: "interval-shifted",
        reason: "NoSignChange",
        note: "the interval beside the root",
        change: |claim| claim.interval = [q("1/2"), q("3/5")],
    },
    Forgery {
        name: "interval-end-1e-30",
        reason: "NoSignChange",
        note: "lower end 1e-30 above the root",
        change: |claim| claim.interval[0] = q("0.414213562373095048801688724210"),
    },
    Forgery {
        name: "not-isolated",
        reason: "NotIsolated",
        note: "a turning point of p in the interval",
        change: |claim| claim.interval = [q("-2"), q("1")],
    },
    Forgery {
        name: "interval-reversed",
        reason: "ReversedInterval",
        note: "a > b",
        change: |claim| claim.interval.swap(0, 1),
    },
    Forgery {
        name: "point-no-root",
        reason: "NotARoot",
        note: "a = b, p(a) != 0",
        change: |claim| claim.interval[1] = claim.interval[0].clone(),
    },
    Forgery {
        name: "negative-value",
        reason: "OutsideWindow",
        note: "the other root of p, lambda^2 < 0",
        change: |claim| claim.interval = [q("-3"), q("-2")],
    },
    Forgery {
        name: "constant-polynomial",
        reason: "ConstantPolynomial",
        note: "p = 0",
        change: |claim| claim.polynomial = vec![0.into()],
    },
];

/// The vector of `root_two`: x = (1, t + 1, 0), support {0, 1}, nothing biactive.
const VECTORS: [Forgery<ExactSolution>; 12] = [
    Forgery {
        name: "degree-of-x",
        reason: "TooLarge",
        note: "x of 513 coefficients",
        change: |claim| claim.x[0] = vec![Number(whole(1)); 513],
    },
    Forgery {
        name: "sign-flipped",
        reason: "XNotPositive",
        note: "x_0 negative",
        change: |claim| claim.x[0][0].0 = whole(-1),
    },
    Forgery {
        name: "zero-x",
        reason: "XNotPositive",
        note: "x = 0",
        change: |claim| claim.x = vec![vec![]; 3],
    },
    Forgery {
        name: "kernel-off",
        reason: "YNotZero",
        note: "kernel vector off by 1e-12 in one coefficient",
        change: |claim| claim.x[1][0].0 += tiny(),
    },
    Forgery {
        name: "support-short",
        reason: "XOffSupport",
        note: "a moving variable is not listed",
        change: |claim| claim.support = vec![0],
    },
    Forgery {
        name: "support-long",
        reason: "XNotPositive",
        note: "a resting variable is listed",
        change: |claim| claim.support.push(2),
    },
    Forgery {
        name: "support-not-ascending",
        reason: "IndexSet",
        note: "support [1, 0]",
        change: |claim| claim.support = vec![1, 0],
    },
    Forgery {
        name: "support-out-of-range",
        reason: "IndexSet",
        note: "index 3 of 3 variables",
        change: |claim| claim.support = vec![0, 1, 3],
    },
    Forgery {
        name: "biactive-invented",
        reason: "Biactive",
        note: "y_2 > 0 called zero",
        change: |claim| claim.biactive = vec![2],
    },
    Forgery {
        name: "biactive-on-support",
        reason: "Biactive",
        note: "a moving variable called biactive",
        change: |claim| claim.biactive = vec![0],
    },
    Forgery {
        name: "x-long",
        reason: "Length",
        note: "one polynomial too many",
        change: |claim| claim.x.push(vec![]),
    },
    Forgery {
        name: "resting-moves",
        reason: "XOffSupport",
        note: "x_2 = 1 off the support",
        change: |claim| claim.x[2] = numbers(&["1"]),
    },
];

/// What a certificate says beside its claims.
fn frame(cases: &mut Cases) {
    let (problem, good) = root_two();
    let own = exact_certificate(&problem, &good);

    cases.reject(
        "other-problem",
        "Digest",
        "another problem's certificate",
        &fold("0", None),
        &own,
    );

    let other_unknown = Certificate {
        unknown: Unknown::Mu,
        ..own.clone()
    };

    cases.reject(
        "other-unknown",
        "Unknown",
        "made for MCEIP-mu",
        &problem,
        &other_unknown,
    );

    let nothing_claimed = Certificate {
        claims: vec![],
        ..own.clone()
    };

    cases.reject(
        "nothing-claimed",
        "NoClaims",
        "no claim, no cover",
        &problem,
        &nothing_claimed,
    );

    let short_window = Certificate {
        window: Window::new(whole(0), Some(rational(9, 20))).unwrap(),
        ..own
    };

    cases.reject(
        "outside-own-window",
        "OutsideWindow",
        "the interval leaves the certificate's window",
        &problem,
        &short_window,
    );
}

/// x = (1, 0) at t = 1, where y_1 is the given number.
fn with_reaction(y: &str) -> Problem {
    pencil(&[&["-1", "0"], &[y, "5"]], I2, &[])
}

fn signs(cases: &mut Cases) {
    let not_biactive = exact(&[0], &[-1, 1], ["1", "1"], &[&["1"], &[]]);
    let biactive = ExactSolution {
        biactive: vec![1],
        ..not_biactive.clone()
    };
    let positive = with_reaction("1e-30");
    let zero = with_reaction("0");
    let negative = with_reaction("-1e-30");

    cases.accept(
        "exact-y-1e-30",
        "y_1 = 1e-30 > 0",
        &positive,
        &exact_certificate(&positive, &not_biactive),
    );

    cases.reject(
        "exact-y-negative-1e-30",
        "YNotPositive",
        "y_1 = -1e-30: no double sees it",
        &negative,
        &exact_certificate(&negative, &not_biactive),
    );

    cases.reject(
        "exact-biactive-missing",
        "Biactive",
        "y_1 = 0 not listed",
        &zero,
        &exact_certificate(&zero, &not_biactive),
    );

    cases.accept(
        "exact-biactive",
        "x_1 = y_1 = 0",
        &zero,
        &exact_certificate(&zero, &biactive),
    );

    cases.reject(
        "exact-biactive-1e-30",
        "Biactive",
        "y_1 = 1e-30 called zero",
        &positive,
        &exact_certificate(&positive, &biactive),
    );

    let root_at_end = exact(&[0], &[-1, 1], ["1", "2"], &[&["1"], &[]]);
    cases.reject(
        "exact-root-at-end",
        "NoSignChange",
        "the root is an end of the interval",
        &positive,
        &exact_certificate(&positive, &root_at_end),
    );
}

/// `root_two` with y_2 = (t + shift) x_0.
fn with_shift(shift: &str) -> Problem {
    let a: &[&[&str]] = &[&["1", "-1", "0"], &["-2", "1", "0"], &[shift, "0", "9"]];
    let b: &[&[&str]] = &[&["1", "0", "0"], &["0", "1", "0"], &["1", "0", "1"]];
    pencil(a, b, &[])
}

/// y_2 = (t - 9/20) x_0 is negative at the root but changes sign in [2/5, 1/2]; y_2 = (t - 2/5) x_0
/// is positive at the root.
fn signs_by_intervals(cases: &mut Cases) {
    let negative = with_shift("-9/20");
    let positive = with_shift("-2/5");
    let (_, wide) = root_two();
    let narrow = ExactSolution {
        interval: ["41/100", "42/100"].map(q),
        ..wide.clone()
    };

    cases.reject(
        "exact-sign-open",
        "YNotPositive",
        "the interval leaves the sign of y_2 open",
        &negative,
        &exact_certificate(&negative, &wide),
    );

    cases.reject(
        "exact-sign-closed-negative",
        "YNotPositive",
        "the same, on an interval that shows y_2 < 0",
        &negative,
        &exact_certificate(&negative, &narrow),
    );

    cases.accept(
        "exact-sign-narrow",
        "an interval narrow enough for the sign of y_2",
        &positive,
        &exact_certificate(&positive, &narrow),
    );
}

fn threshold(cases: &mut Cases) {
    let at_zero = exact(&[0, 1], &[0, 1], ["0", "0"], &[&["1"], &["1"]]);

    let threshold = pencil(&[&["1", "-1"], &["-1", "1"]], I2, &[]);
    cases.accept(
        "threshold-lambda2-zero",
        "lambda^2 = 0: a threshold; gamma of Proposition 2 is free and not stated",
        &threshold,
        &exact_certificate(&threshold, &at_zero),
    );

    let missed = pencil(&[&["1.000000000001", "-1"], &["-1", "1"]], I2, &[]);
    cases.reject(
        "threshold-missed",
        "YNotZero",
        "the threshold missed by 1e-12",
        &missed,
        &exact_certificate(&missed, &at_zero),
    );
}

/// The free variable 0 alone, x = (1, 0) at t = 1.
const FREE: [Forgery<ExactSolution>; 3] = [
    Forgery {
        name: "exact-x-zero",
        reason: "XZero",
        note: "nothing moves",
        change: |claim| claim.x = vec![vec![], vec![]],
    },
    Forgery {
        name: "exact-free-row",
        reason: "YNotZero",
        note: "E13: a free row out of balance",
        change: |claim| {
            claim.polynomial = vec![(-2).into(), 1.into()];
            claim.interval = [q("2"), q("2")];
        },
    },
    Forgery {
        name: "exact-free-in-support",
        reason: "IndexSet",
        note: "a free variable in the support",
        change: |claim| claim.support = vec![0],
    },
];

fn free_variable(cases: &mut Cases) {
    let problem = pencil(&[&["-1", "0"], &["3", "2"]], I2, &[0]);
    let good = exact(&[], &[-1, 1], ["1", "1"], &[&["1"], &[]]);
    cases.accept(
        "exact-free-only",
        "a free variable moves alone",
        &problem,
        &exact_certificate(&problem, &good),
    );

    for forgery in FREE {
        let forged = exact_certificate(&problem, &forgery.of(&good));

        cases.reject(
            forgery.name,
            forgery.reason,
            forgery.note,
            &problem,
            &forged,
        );
    }
}

/// The box of `boxed`: centre (1/2, 1/2, 3), radius 2^-20, an exact preconditioner.
const BOXES: [Forgery<EnclosedSolution>; 10] = [
    Forgery {
        name: "zero-preconditioner",
        reason: "NotContracting",
        note: "a zero row",
        change: |claim| claim.preconditioner[2] = vec![0.into(); 3],
    },
    Forgery {
        name: "centre-off",
        reason: "NotContracting",
        note: "centre off by more than the box",
        change: |claim| claim.center[2].0 += rational(1, 1 << 18),
    },
    Forgery {
        name: "box-too-large",
        reason: "NotContracting",
        note: "radius 4",
        change: |claim| claim.radius = vec![Number(whole(4)); 3],
    },
    Forgery {
        name: "no-width",
        reason: "Radius",
        note: "a radius of zero",
        change: |claim| claim.radius[1].0 = whole(0),
    },
    Forgery {
        name: "short-centre",
        reason: "Length",
        note: "an unknown missing",
        change: |claim| claim.center.truncate(2),
    },
    Forgery {
        name: "short-radius",
        reason: "Length",
        note: "a radius missing",
        change: |claim| claim.radius.truncate(1),
    },
    Forgery {
        name: "short-preconditioner",
        reason: "Length",
        note: "a row missing",
        change: |claim| claim.preconditioner.truncate(2),
    },
    Forgery {
        name: "ragged-preconditioner",
        reason: "Length",
        note: "an entry missing",
        change: |claim| claim.preconditioner[0].truncate(2),
    },
    Forgery {
        name: "exponent",
        reason: "TooLarge",
        note: "a small file that asks for gigabytes",
        change: |claim| claim.exponent = u32::MAX,
    },
    Forgery {
        name: "empty-support",
        reason: "XZero",
        note: "nothing moves",
        change: |claim| claim.support.clear(),
    },
];

fn enclosed_certificate(problem: &Problem, claim: &EnclosedSolution) -> Certificate {
    claims(problem, Claim::EnclosedSolution(claim.clone()))
}

pub fn enclosed_claims(cases: &mut Cases) {
    let (problem, good) = boxed();
    cases.accept(
        "enclosed",
        "a box around t = 3",
        &problem,
        &enclosed_certificate(&problem, &good),
    );

    for forgery in BOXES {
        let name = format!("enclosed-{}", forgery.name);
        let forged = enclosed_certificate(&problem, &forgery.of(&good));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }

    radius_at_its_bound(cases);
    biactive_in_a_box(cases);
}

/// The box of `boxed` contracts for radii below 1/4.
fn radius_at_its_bound(cases: &mut Cases) {
    let (problem, _) = boxed();

    let below = with_radius(rational(1, 4) - rational(1, 1_000_000));
    cases.accept(
        "enclosed-wide",
        "radius just below the bound 1/4",
        &problem,
        &enclosed_certificate(&problem, &below),
    );

    let at_the_bound = with_radius(rational(1, 4));
    cases.reject(
        "enclosed-bound",
        "NotContracting",
        "radius at its bound: equality proves nothing",
        &problem,
        &enclosed_certificate(&problem, &at_the_bound),
    );
}

fn with_radius(radius: Rational) -> EnclosedSolution {
    let (_, good) = boxed();
    EnclosedSolution {
        radius: vec![Number(radius); 3],
        ..good
    }
}

fn biactive_in_a_box(cases: &mut Cases) {
    let a: &[&[&str]] = &[&["-1", "-2", "0"], &["-2", "-1", "0"], &["1", "-1", "9"]];
    let problem = pencil(a, I3, &[]);
    let (_, claim) = boxed();

    cases.reject(
        "enclosed-biactive",
        "YNotPositive",
        "y_2 = 0 at the solution: no strict sign over a box",
        &problem,
        &enclosed_certificate(&problem, &claim),
    );
}

fn lifted_certificate(problem: &Problem, claim: &LiftedSolution) -> Certificate {
    claims(problem, Claim::LiftedSolution(claim.clone()))
}

pub fn lifted_claims(cases: &mut Cases) {
    accepted_lifts(cases, "lifted", Unknown::Lambda2);
    accepted_lifts(cases, "lifted-mu", Unknown::Mu);

    let problem = mechanical(Unknown::Lambda2);
    let good = lift(&problem, &first_solution(&problem));
    for forgery in LIFTS {
        let name = format!("lifted-{}", forgery.name);
        let forged = lifted_certificate(&problem, &forgery.of(&good));

        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }

    let (without_dofs, _) = root_two();
    cases.reject(
        "lifted-for-a-pencil",
        "NotASystem",
        "physical vectors for a problem without dofs",
        &without_dofs,
        &lifted_certificate(&without_dofs, &good),
    );
}

fn accepted_lifts(cases: &mut Cases, name: &str, unknown: Unknown) {
    let problem = mechanical(unknown);
    let exact = first_solution(&problem);

    cases.accept(
        name,
        "v and w of (9), the second particle at rest",
        &problem,
        &lifted_certificate(&problem, &lift(&problem, &exact)),
    );

    cases.accept(
        &format!("{name}-as-pencil"),
        "the same solution about the pencil",
        &problem,
        &exact_certificate(&problem, &exact),
    );
}

/// An exact claim for the first solution that the enumerator lists.
fn first_solution(problem: &Problem) -> ExactSolution {
    let pencil = mceip_model::reduction::reduce(problem).unwrap().pencil;
    let listed = mceip_oracle::enumerate(&pencil, problem.window()).unwrap();
    let solution = listed.solutions.first().unwrap();

    let decimals = solution.x_decimals(&pencil.slip(), 17);
    let candidate = Candidate {
        value: solution.decimal(17).parse().unwrap(),
        x: decimals.iter().map(|text| text.parse().unwrap()).collect(),
    };

    match propose(&pencil, problem.window(), &candidate).unwrap() {
        Claim::ExactSolution(claim) => claim,
        other => unreachable!("{other:?}"),
    }
}

/// Adds to the coefficient of t^power.
fn add(polynomial: &mut Vec<Number>, power: usize, by: &Rational) {
    let length = polynomial.len().max(power + 1);
    polynomial.resize_with(length, || Number(whole(0)));
    polynomial[power].0 += by;
}

/// Changes v at one degree of freedom together with w = (t M + K) v, so that only a later line
/// breaks.
fn move_dof(claim: &mut LiftedSolution, dof: usize) {
    let problem = mechanical(Unknown::Lambda2);
    let system = system(&problem);
    add(&mut claim.v[dof], 0, &tiny());

    for (row, column, stiffness) in system.stiffness().entries() {
        if column == dof {
            add(&mut claim.w[row], 0, &(stiffness * tiny()));
        }
    }

    for (row, column, mass) in system.mass().unwrap().entries() {
        if column == dof {
            add(&mut claim.w[row], 1, &(mass * tiny()));
        }
    }
}

/// The motion -v with -w.
fn turn_around(claim: &mut LiftedSolution) {
    for coefficient in claim.v.iter_mut().chain(&mut claim.w).flatten() {
        coefficient.0 = -coefficient.0.clone();
    }
}

/// The motion of the system: free dof 0, slip particle (1, 2), stick particle (3, 4), slip particle
/// (5, 6) at rest.
const LIFTS: [Forgery<LiftedSolution>; 12] = [
    Forgery {
        name: "motion",
        reason: "Line",
        note: "w off by 1e-12: (t M + K) v = w",
        change: |claim| add(&mut claim.w[6], 0, &tiny()),
    },
    Forgery {
        name: "free-reaction",
        reason: "Line",
        note: "w_f = 1e-12",
        change: |claim| move_dof(claim, 0),
    },
    Forgery {
        name: "stick-tangential",
        reason: "Line",
        note: "a sticking particle slides",
        change: |claim| move_dof(claim, 3),
    },
    Forgery {
        name: "stick-normal",
        reason: "Line",
        note: "a sticking particle lifts off",
        change: |claim| move_dof(claim, 4),
    },
    Forgery {
        name: "normal-rate",
        reason: "Line",
        note: "a slipping particle lifts off",
        change: |claim| move_dof(claim, 6),
    },
    Forgery {
        name: "slip-backwards",
        reason: "Line",
        note: "S v_T > 0",
        change: turn_around,
    },
    Forgery {
        name: "rest-called-slip",
        reason: "Line",
        note: "support lists a particle at rest",
        change: |claim| claim.support = vec![1, 2],
    },
    Forgery {
        name: "slip-called-rest",
        reason: "Line",
        note: "support hides a slipping particle",
        change: |claim| claim.support.clear(),
    },
    Forgery {
        name: "rest-called-biactive",
        reason: "Line",
        note: "strictly inside the cone, called on it",
        change: |claim| claim.biactive = vec![2],
    },
    Forgery {
        name: "v-zero",
        reason: "Line",
        note: "v = w = 0",
        change: |claim| {
            for polynomial in claim.v.iter_mut().chain(&mut claim.w) {
                polynomial.clear();
            }
        },
    },
    Forgery {
        name: "v-short",
        reason: "Length",
        note: "a dof missing",
        change: |claim| claim.v.truncate(6),
    },
    Forgery {
        name: "w-long",
        reason: "Length",
        note: "a dof too many",
        change: |claim| claim.w.push(Vec::new()),
    },
];
