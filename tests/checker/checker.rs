//! The checker: one acceptance and, for each obligation, a certificate that breaks just that one.
//!
//! The accepted claims are solved by hand, so that the truth does not come from the program. A
//! forgery changes one of them in one place and has to be rejected for the reason that belongs to
//! that place: a checker without the obligation accepts it, one that mixes obligations up names
//! another reason.

use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_check::{Reason, check};
use mceip_exact::{Integer, Rational, Sparse, parse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window};

const I2: &[&[&str]] = &[&["1", "0"], &["0", "1"]];
const I3: &[&[&str]] = &[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]];

/// The square matrix with these rows.
fn sparse(rows: &[&[&str]]) -> Sparse {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            entries.push((i, j, parse(entry).unwrap()));
        }
    }

    Sparse::from_entries(rows.len(), rows.len(), entries)
}

/// The eigenproblem of A + t B for t = lambda^2 in [0, infinity).
fn problem(a: &[&[&str]], b: &[&[&str]], free: &[usize]) -> Problem {
    let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

fn number(text: &str) -> Number {
    Number(parse(text).unwrap())
}

fn numbers(list: &[&str]) -> Vec<Number> {
    list.iter().map(|text| number(text)).collect()
}

/// A claim without biactive variables: t is the root of `polynomial` in `interval`, and x is given
/// by a polynomial in t for each variable.
fn claim(
    support: &[usize],
    polynomial: &[i64],
    interval: [&str; 2],
    x: &[&[&str]],
) -> ExactSolution {
    ExactSolution {
        support: support.to_vec(),
        biactive: vec![],
        polynomial: polynomial.iter().map(|&c| c.into()).collect(),
        interval: interval.map(number),
        x: x.iter().map(|component| numbers(component)).collect(),
    }
}

fn certificate(problem: &Problem, claim: Claim) -> Certificate {
    Certificate {
        problem_sha256: problem.sha256(),
        unknown: problem.unknown(),
        window: Window::all(),
        claims: vec![claim],
        complete_set: None,
    }
}

/// What the checker says of an exact claim. A rejection names the claim, which is the only one.
fn verdict(problem: &Problem, claim: &ExactSolution) -> Result<(), Reason> {
    let certificate = certificate(problem, Claim::ExactSolution(claim.clone()));
    match check(problem, &certificate) {
        Ok(_) => Ok(()),
        Err(rejected) => {
            assert_eq!(rejected.claim, Some(0));
            Err(rejected.reason)
        }
    }
}

fn enclosed_verdict(problem: &Problem, claim: &EnclosedSolution) -> Result<(), Reason> {
    let certificate = certificate(problem, Claim::EnclosedSolution(claim.clone()));
    check(problem, &certificate)
        .map(|_| ())
        .map_err(|rejected| rejected.reason)
}

fn lifted_verdict(problem: &Problem, claim: LiftedSolution) -> Result<(), Reason> {
    let certificate = certificate(problem, Claim::LiftedSolution(claim));
    check(problem, &certificate)
        .map(|_| ())
        .map_err(|rejected| rejected.reason)
}

/// A change of an accepted claim, and the reason for which it has to be rejected.
struct Forgery<Claimed> {
    what: &'static str,
    change: fn(&mut Claimed),
    expected: fn(&Reason) -> bool,
}

impl<Claimed: Clone> Forgery<Claimed> {
    fn of(&self, good: &Claimed) -> Claimed {
        let mut forged = good.clone();
        (self.change)(&mut forged);
        forged
    }

    fn assert_rejected(&self, verdict: Result<(), Reason>) {
        let what = self.what;
        match verdict {
            Ok(()) => panic!("{what}: accepted"),
            Err(reason) => assert!((self.expected)(&reason), "{what}: {reason}"),
        }
    }
}

/// t = sqrt 2 - 1 on the full support: (t+1)^2 = 2, x = (1, 2/(t+1)) = (1, t+1); index 2 sticks.
fn root_two() -> (Problem, ExactSolution) {
    let a: &[&[&str]] = &[&["1", "-1", "0"], &["-2", "1", "0"], &["1", "0", "9"]];
    let problem = problem(a, I3, &[]);

    let x: &[&[&str]] = &[&["1"], &["1", "1"], &[]];
    let claim = claim(&[0, 1], &[-1, 2, 1], ["2/5", "1/2"], x);
    (problem, claim)
}

#[test]
fn the_true_certificate_is_accepted() {
    let (problem, claim) = root_two();
    assert_eq!(verdict(&problem, &claim), Ok(()));

    let mut scaled = claim;
    for coefficient in scaled.x.iter_mut().flatten() {
        coefficient.0 *= rational(7, 3);
    }

    assert_eq!(verdict(&problem, &scaled), Ok(()));
}

#[test]
fn each_obligation_has_a_forgery() {
    let (problem, good) = root_two();
    let forgeries = LIMITS.iter().chain(&VALUES).chain(&VECTORS);

    let mut count = 0;
    for forgery in forgeries {
        let result = verdict(&problem, &forgery.of(&good));
        forgery.assert_rejected(result);
        count += 1;
    }

    assert_eq!(count, 24);
}

/// Numbers beyond what will be computed with.
const LIMITS: [Forgery<ExactSolution>; 3] = [
    Forgery {
        what: "degree beyond all use",
        change: |claim| claim.polynomial = vec![Integer::from(1); 513],
        expected: |reason| {
            matches!(
                reason,
                Reason::TooLarge {
                    what: "coefficients of the polynomial",
                    ..
                }
            )
        },
    },
    Forgery {
        what: "x of a degree beyond all use",
        change: |claim| claim.x[0] = vec![Number(whole(1)); 513],
        expected: |reason| {
            matches!(
                reason,
                Reason::TooLarge {
                    what: "coefficients of x",
                    ..
                }
            )
        },
    },
    Forgery {
        what: "numbers of absurd length",
        change: |claim| {
            let denominator = Rational::from_integer(Integer::from(7) << 1_000_000);
            claim.interval[0].0 = rational(2, 5) + rational(1, 3) / denominator;
        },
        expected: |reason| {
            matches!(
                reason,
                Reason::TooLarge {
                    what: "size (coefficients times bits)",
                    ..
                }
            )
        },
    },
];

/// The value: the root of t^2 + 2 t - 1 in [2/5, 1/2].
const VALUES: [Forgery<ExactSolution>; 9] = [
    Forgery {
        what: "wrong root",
        change: |claim| claim.polynomial[0] = Integer::from(-2),
        expected: |reason| matches!(reason, Reason::NoSignChange { .. }),
    },
    Forgery {
        what: "a polynomial with another root there",
        change: |claim| claim.polynomial = vec![(-9).into(), 20.into()],
        expected: |reason| {
            matches!(
                reason,
                Reason::YNotZero {
                    equation: "E25",
                    index: 1
                }
            )
        },
    },
    Forgery {
        what: "shifted interval",
        change: |claim| claim.interval = [Number(rational(1, 2)), Number(rational(3, 5))],
        expected: |reason| matches!(reason, Reason::NoSignChange { .. }),
    },
    Forgery {
        what: "end on the root's wrong side by 1e-30",
        change: |claim| claim.interval[0].0 = parse("0.414213562373095048801688724210").unwrap(),
        expected: |reason| matches!(reason, Reason::NoSignChange { .. }),
    },
    Forgery {
        what: "interval with a turning point",
        change: |claim| claim.interval = [Number(whole(-2)), Number(whole(1))],
        expected: |reason| matches!(reason, Reason::NotIsolated { .. }),
    },
    Forgery {
        what: "interval reversed",
        change: |claim| claim.interval.swap(0, 1),
        expected: |reason| matches!(reason, Reason::ReversedInterval { .. }),
    },
    Forgery {
        what: "point that is no root",
        change: |claim| claim.interval[1] = claim.interval[0].clone(),
        expected: |reason| matches!(reason, Reason::NotARoot { .. }),
    },
    Forgery {
        what: "negative value",
        change: |claim| claim.interval = [Number(whole(-3)), Number(whole(-2))],
        expected: |reason| matches!(reason, Reason::OutsideWindow { .. }),
    },
    Forgery {
        what: "constant polynomial",
        change: |claim| claim.polynomial = vec![0.into()],
        expected: |reason| matches!(reason, Reason::ConstantPolynomial { .. }),
    },
];

/// The vector (1, t + 1, 0), the support {0, 1}, nothing biactive.
const VECTORS: [Forgery<ExactSolution>; 12] = [
    Forgery {
        what: "sign flipped",
        change: |claim| claim.x[0][0].0 = whole(-1),
        expected: |reason| matches!(reason, Reason::XNotPositive { index: 0, .. }),
    },
    Forgery {
        what: "x = 0",
        change: |claim| claim.x = vec![vec![]; 3],
        expected: |reason| matches!(reason, Reason::XNotPositive { index: 0, .. }),
    },
    Forgery {
        what: "kernel vector off by one coefficient",
        change: |claim| claim.x[1][0].0 += rational(1, 1_000_000_000),
        expected: |reason| matches!(reason, Reason::YNotZero { .. }),
    },
    Forgery {
        what: "support one short",
        change: |claim| claim.support = vec![0],
        expected: |reason| matches!(reason, Reason::XOffSupport { index: 1 }),
    },
    Forgery {
        what: "support one long",
        change: |claim| claim.support.push(2),
        expected: |reason| matches!(reason, Reason::XNotPositive { index: 2, .. }),
    },
    Forgery {
        what: "support not ascending",
        change: |claim| claim.support = vec![1, 0],
        expected: |reason| {
            matches!(
                reason,
                Reason::IndexSet {
                    set: "support",
                    position: 1,
                    got: 0
                }
            )
        },
    },
    Forgery {
        what: "support out of range",
        change: |claim| claim.support = vec![0, 1, 3],
        expected: |reason| {
            matches!(
                reason,
                Reason::IndexSet {
                    set: "support",
                    position: 2,
                    got: 3
                }
            )
        },
    },
    Forgery {
        what: "biactive invented",
        change: |claim| claim.biactive = vec![2],
        expected: |reason| {
            matches!(
                reason,
                Reason::Biactive {
                    index: 2,
                    expected: false
                }
            )
        },
    },
    Forgery {
        what: "biactive on the support",
        change: |claim| claim.biactive = vec![0],
        expected: |reason| {
            matches!(
                reason,
                Reason::Biactive {
                    index: 0,
                    expected: false
                }
            )
        },
    },
    Forgery {
        what: "biactive out of range",
        change: |claim| claim.biactive = vec![7],
        expected: |reason| {
            matches!(
                reason,
                Reason::IndexSet {
                    set: "biactive",
                    ..
                }
            )
        },
    },
    Forgery {
        what: "x one variable long",
        change: |claim| claim.x.push(vec![]),
        expected: |reason| {
            matches!(
                reason,
                Reason::Length {
                    what: "x",
                    expected: 3,
                    got: 4
                }
            )
        },
    },
    Forgery {
        what: "sticking variable moves",
        change: |claim| claim.x[2] = vec![Number(whole(1))],
        expected: |reason| matches!(reason, Reason::XOffSupport { index: 2 }),
    },
];

/// x = (1, 0) at t = 1, where y_1 is the given number.
fn with_reaction(y: &str) -> Problem {
    problem(&[&["-1", "0"], &[y, "5"]], I2, &[])
}

#[test]
fn y_negative_by_1e_30_is_rejected_and_positive_accepted() {
    let claim = claim(&[0], &[-1, 1], ["1", "1"], &[&["1"], &[]]);

    let negative = verdict(&with_reaction("-1e-30"), &claim);
    let Err(Reason::YNotPositive { index: 1, hi, .. }) = negative else {
        panic!("{negative:?}")
    };
    assert!(hi < whole(0), "{hi}");
    assert_eq!(verdict(&with_reaction("1e-30"), &claim), Ok(()));

    // y_1 = 0 has to be listed.
    let zero = with_reaction("0");
    let missing = Reason::Biactive {
        index: 1,
        expected: true,
    };
    assert_eq!(verdict(&zero, &claim), Err(missing));

    let biactive = ExactSolution {
        biactive: vec![1],
        ..claim
    };
    assert_eq!(verdict(&zero, &biactive), Ok(()));

    // The root must not be an end of the interval: that is what points are for.
    assert_eq!(signs_at_ends(["1", "2"]), [0, 1]);
    assert_eq!(signs_at_ends(["0", "1"]), [-1, 0]);
}

/// The signs of t - 1 that the checker tells when it rejects an interval.
fn signs_at_ends(interval: [&str; 2]) -> [i8; 2] {
    let claim = claim(&[0], &[-1, 1], interval, &[&["1"], &[]]);
    match verdict(&with_reaction("1"), &claim) {
        Err(Reason::NoSignChange { at_a, at_b }) => [at_a, at_b],
        other => panic!("{other:?}"),
    }
}

/// `root_two` with y_2 = (t + shift) x_0.
fn with_shift(shift: &str) -> Problem {
    let a: &[&[&str]] = &[&["1", "-1", "0"], &["-2", "1", "0"], &[shift, "0", "9"]];
    let b: &[&[&str]] = &[&["1", "0", "0"], &["0", "1", "0"], &["1", "0", "1"]];
    problem(a, b, &[])
}

/// y_2 = (t - 9/20) x_0 changes sign inside [2/5, 1/2] and is negative at t = sqrt 2 - 1: an
/// interval that leaves a sign open proves nothing. With 2/5 for 9/20 it is positive, provable on a
/// shorter one.
#[test]
fn a_sign_that_the_interval_leaves_open_is_rejected() {
    let (root_two, wide) = root_two();
    let narrow = ExactSolution {
        interval: ["41/100", "42/100"].map(number),
        ..wide.clone()
    };

    let open = verdict(&with_shift("-9/20"), &wide);
    let Err(Reason::YNotPositive { index: 2, lo, hi }) = open else {
        panic!("{open:?}")
    };
    assert!(lo < whole(0) && hi > whole(0), "[{lo}, {hi}]");

    let negative = verdict(&with_shift("-9/20"), &narrow);
    let Err(Reason::YNotPositive { hi, .. }) = negative else {
        panic!("{negative:?}")
    };
    assert!(hi < whole(0), "{hi}");

    assert_eq!(verdict(&with_shift("-2/5"), &narrow), Ok(()));

    // The same for x: x_0 = 9/20 - t and x_1 = (t + 1) x_0 on the wide interval.
    let x = vec![
        numbers(&["9/20", "-1"]),
        numbers(&["-11/20", "29/20"]),
        vec![],
    ];
    let on_narrow = ExactSolution {
        x: x.clone(),
        ..narrow
    };
    assert_eq!(verdict(&root_two, &on_narrow), Ok(()));

    let on_wide = ExactSolution { x, ..wide };
    let open = verdict(&root_two, &on_wide);
    assert!(
        matches!(open, Err(Reason::XNotPositive { index: 0, .. })),
        "{open:?}"
    );
}

/// Free variable 0: (t - 1) x_0 = 0.
#[test]
fn free_variables_must_balance_and_something_must_move() {
    let problem = problem(&[&["-1", "0"], &["3", "2"]], I2, &[0]);
    let good = claim(&[], &[-1, 1], ["1", "1"], &[&["1"], &[]]);
    assert_eq!(verdict(&problem, &good), Ok(()));

    let still = ExactSolution {
        x: vec![vec![], vec![]],
        ..good.clone()
    };
    assert_eq!(verdict(&problem, &still), Err(Reason::XZero));

    let unbalanced = ExactSolution {
        polynomial: vec![(-2).into(), 1.into()],
        interval: ["2", "2"].map(number),
        ..good.clone()
    };
    let row_zero = Reason::YNotZero {
        equation: "E13",
        index: 0,
    };
    assert_eq!(verdict(&problem, &unbalanced), Err(row_zero));

    let free_in_support = ExactSolution {
        support: vec![0],
        ..good
    };
    let refused = verdict(&problem, &free_in_support);
    assert!(
        matches!(refused, Err(Reason::IndexSet { got: 0, .. })),
        "{refused:?}"
    );
}

#[test]
fn the_frame_of_a_certificate_is_checked_first() {
    let (problem, claim) = root_two();
    let good = certificate(&problem, Claim::ExactSolution(claim));

    let other_digest = Certificate {
        problem_sha256: "0".repeat(64),
        ..good.clone()
    };
    let reason = check(&problem, &other_digest).unwrap_err().reason;
    assert!(matches!(reason, Reason::Digest { .. }), "{reason}");

    let other_unknown = Certificate {
        unknown: Unknown::Mu,
        ..good.clone()
    };
    let reason = check(&problem, &other_unknown).unwrap_err().reason;
    let made_for_mu = Reason::Unknown {
        expected: "lambda2",
        got: "mu",
    };
    assert_eq!(reason, made_for_mu);

    let nothing_claimed = Certificate {
        claims: vec![],
        ..good.clone()
    };
    let reason = check(&problem, &nothing_claimed).unwrap_err().reason;
    assert_eq!(reason, Reason::NoClaims);

    let short_window = Certificate {
        window: Window::new(whole(0), Some(rational(9, 20))).unwrap(),
        ..good
    };
    let reason = check(&problem, &short_window).unwrap_err().reason;
    assert!(matches!(reason, Reason::OutsideWindow { .. }), "{reason}");
}

/// x = (1/2, 1/2), t = 3 of [[-1, -2], [-2, -1]] + t I, with an exact inverse as preconditioner.
///
/// F' = [[2, -2, 1/2], [-2, 2, 1/2], [1, 1, 0]]; its inverse has entries 1/8, 1/2, 1.
fn boxed() -> (Problem, EnclosedSolution) {
    let problem = problem(&[&["-1", "-2"], &["-2", "-1"]], I2, &[]);

    let inverse_in_sixteenths = [[2, -2, 8], [-2, 2, 8], [16, 16, 0]];
    let claim = EnclosedSolution {
        support: vec![0, 1],
        center: numbers(&["0.5", "0.5", "3"]),
        radius: vec![Number(rational(1, 1 << 20)); 3],
        preconditioner: inverse_in_sixteenths
            .map(|row| row.map(Integer::from).to_vec())
            .to_vec(),
        exponent: 4,
    };
    (problem, claim)
}

/// The box of `boxed`.
const BOXES: [Forgery<EnclosedSolution>; 10] = [
    Forgery {
        what: "no contraction",
        change: |claim| claim.preconditioner[2] = vec![0.into(); 3],
        expected: |reason| matches!(reason, Reason::NotContracting { index: 2, .. }),
    },
    Forgery {
        what: "centre off by more than the box",
        change: |claim| claim.center[2].0 += rational(1, 1 << 18),
        expected: |reason| matches!(reason, Reason::NotContracting { .. }),
    },
    Forgery {
        what: "box too large",
        change: |claim| claim.radius = vec![Number(whole(4)); 3],
        expected: |reason| matches!(reason, Reason::NotContracting { .. }),
    },
    Forgery {
        what: "box without width",
        change: |claim| claim.radius[1].0 = whole(0),
        expected: |reason| matches!(reason, Reason::Radius { index: 1, .. }),
    },
    Forgery {
        what: "short centre",
        change: |claim| claim.center.truncate(2),
        expected: |reason| matches!(reason, Reason::Length { what: "center", .. }),
    },
    Forgery {
        what: "short radius",
        change: |claim| claim.radius.truncate(1),
        expected: |reason| matches!(reason, Reason::Length { what: "radius", .. }),
    },
    Forgery {
        what: "short preconditioner",
        change: |claim| claim.preconditioner.truncate(2),
        expected: |reason| {
            matches!(
                reason,
                Reason::Length {
                    what: "preconditioner",
                    ..
                }
            )
        },
    },
    Forgery {
        what: "ragged preconditioner",
        change: |claim| claim.preconditioner[0].truncate(2),
        expected: |reason| {
            matches!(
                reason,
                Reason::Length {
                    what: "preconditioner row",
                    ..
                }
            )
        },
    },
    Forgery {
        what: "gigabytes of exponent",
        change: |claim| claim.exponent = u32::MAX,
        expected: |reason| {
            matches!(
                reason,
                Reason::TooLarge {
                    what: "exponent",
                    ..
                }
            )
        },
    },
    Forgery {
        what: "empty support",
        change: |claim| claim.support.clear(),
        expected: |reason| matches!(reason, Reason::XZero),
    },
];

#[test]
fn enclosed_solutions_and_their_forgeries() {
    let (problem, good) = boxed();
    let own = certificate(&problem, Claim::EnclosedSolution(good.clone()));

    let accepted = check(&problem, &own).unwrap();
    let value = &accepted.claims[0].value;
    assert!(value.contains(&whole(3)), "{value:?}");
    assert!(value.width() < rational(1, 100_000), "{value:?}");

    for forgery in BOXES {
        let result = enclosed_verdict(&problem, &forgery.of(&good));
        forgery.assert_rejected(result);
    }

    let cut = Certificate {
        window: Window::new(whole(0), Some(whole(3))).unwrap(),
        ..own
    };
    let reason = check(&problem, &cut).unwrap_err().reason;
    assert!(matches!(reason, Reason::OutsideWindow { .. }), "{reason}");
}

/// The bound that is told: with Y = 0 it is |I| r = r, whatever the radii.
#[test]
fn the_bound_of_a_box_is_told_in_its_own_units() {
    let (problem, mut uneven) = boxed();
    uneven.radius = numbers(&["3/64", "5/64", "7/64"]);

    let mut without_row = uneven.clone();
    without_row.preconditioner[1] = vec![0.into(); 3];
    let expected = Reason::NotContracting {
        index: 1,
        got: rational(5, 64),
        radius: rational(5, 64),
    };
    assert_eq!(enclosed_verdict(&problem, &without_row), Err(expected));

    // A preconditioner twice too large: |I - 2I| r is r again, and |Y| d comes on top: d = 2 r_t
    // (r_0, r_1).
    let mut doubled = uneven;

    for entry in &mut doubled.preconditioner[0] {
        *entry *= 2;
    }

    let d_0 = rational(2 * 7 * 3, 64 * 64);
    let d_1 = rational(2 * 7 * 5, 64 * 64);
    let expected = Reason::NotContracting {
        index: 0,
        got: rational(3, 64) + (d_0 + d_1) * rational(4, 16),
        radius: rational(3, 64),
    };
    assert_eq!(enclosed_verdict(&problem, &doubled), Err(expected));
}

/// The largest exponent of a preconditioner is allowed.
#[test]
fn a_preconditioner_may_be_long() {
    let (problem, _) = boxed();
    let longest = with_exponent(65_536);
    assert_eq!(enclosed_verdict(&problem, &longest), Ok(()));

    let too_long = with_exponent(65_537);
    let expected = Reason::TooLarge {
        what: "exponent",
        limit: 65_536,
        got: 65_537,
    };
    assert_eq!(enclosed_verdict(&problem, &too_long), Err(expected));
}

/// The same preconditioner in units of 2^-exponent instead of sixteenths.
fn with_exponent(exponent: u32) -> EnclosedSolution {
    let (_, mut claim) = boxed();
    for entry in claim.preconditioner.iter_mut().flatten() {
        *entry <<= exponent - claim.exponent;
    }
    claim.exponent = exponent;
    claim
}

/// A particle in impending slip whose tangential dof has this number, and its normal dof the next.
fn one_particle(stiffness: &[&[&str]], tangential: usize) -> Problem {
    let slip = ContactState::Slip { sign: 1 };
    let particle = Particle::plain(tangential, tangential + 1, slip);
    let system = System::new(sparse(stiffness), None, None, vec![particle]).unwrap();
    Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap()
}

/// A motion v with forces w at mu = 2.
fn motion(support: &[usize], biactive: &[usize], v: &[&str], w: &[&str]) -> LiftedSolution {
    LiftedSolution {
        support: support.to_vec(),
        biactive: biactive.to_vec(),
        polynomial: vec![(-2).into(), 1.into()],
        interval: ["2", "2"].map(number),
        v: v.iter().map(|component| numbers(&[component])).collect(),
        w: w.iter().map(|component| numbers(&[component])).collect(),
    }
}

/// One slip particle, K = [[2, -1], [-1, 5]]: v_T (2 - mu) = 0. Without a free degree of freedom
/// nothing else moves.
#[test]
fn a_lifted_claim_needs_something_that_moves() {
    let alone = one_particle(&[&["2", "-1"], &["-1", "5"]], 0);
    let slips = motion(&[0], &[], &["-1", "0"], &["-2", "1"]);
    let rests = motion(&[], &[0], &["0", "0"], &["0", "0"]);
    assert_eq!(lifted_verdict(&alone, slips), Ok(()));
    assert_eq!(lifted_verdict(&alone, rests), Err(Reason::XZero));

    // Dof 0 is free and stays: the slip variable is number 1.
    let stiffness: &[&[&str]] = &[&["3", "0", "0"], &["0", "2", "-1"], &["0", "-1", "5"]];
    let with_free = one_particle(stiffness, 1);
    let slips = motion(&[1], &[], &["0", "-1", "0"], &["0", "-2", "1"]);
    let rests = motion(&[], &[1], &["0", "0", "0"], &["0", "0", "0"]);
    assert_eq!(lifted_verdict(&with_free, slips), Ok(()));
    assert_eq!(lifted_verdict(&with_free, rests), Err(Reason::XZero));
}

#[test]
fn enclosed_signs_must_be_strict_over_the_box() {
    // Third variable sticks with y_2 = x_0 - x_1 = 0 at the solution: no strict sign, no proof.
    let a: &[&[&str]] = &[&["-1", "-2", "0"], &["-2", "-1", "0"], &["1", "-1", "9"]];
    let stuck = problem(a, I3, &[]);
    let (problem, claim) = boxed();
    let verdict = enclosed_verdict(&stuck, &claim);
    assert!(
        matches!(verdict, Err(Reason::YNotPositive { index: 2, .. })),
        "{verdict:?}"
    );

    // A solution of the linear system with a negative component: t = -1, x = (1, -1) up to scale is
    // outside the window; t = 3 with x = (3/2, -1/2) does not solve it.
    let mut negative = claim;
    negative.center[0].0 = rational(3, 2);
    negative.center[1].0 = rational(-1, 2);
    assert!(enclosed_verdict(&problem, &negative).is_err());
}

/// |I - YF'| r = 0 and F(c) = 0: the bound is |Y| d alone, quadratic in r. d = (2 r^2, 2 r^2, 0);
/// row 2 of |Y| gives 4 r^2 < r: r < 1/4 exactly.
#[test]
fn exact_box_is_rejected_when_radius_equals_its_bound() {
    let at_the_bound = rational(1, 4);
    let below = &at_the_bound - rational(1, 1_000_000);

    assert!(!is_accepted_with_radius(at_the_bound));
    assert!(is_accepted_with_radius(below));
}

fn is_accepted_with_radius(radius: Rational) -> bool {
    let (problem, good) = boxed();
    let claim = EnclosedSolution {
        radius: vec![Number(radius); 3],
        ..good
    };
    enclosed_verdict(&problem, &claim).is_ok()
}
