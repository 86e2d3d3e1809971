//! The checker: one acceptance and, for each obligation, a certificate that breaks just that one.

use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_check::{Reason, check};
use mceip_exact::{Integer, Rational, Sparse, parse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window};

fn sparse(rows: &[&[&str]]) -> Sparse {
    let entries = rows.iter().enumerate().flat_map(|(i, r)| {
        r.iter()
            .enumerate()
            .map(move |(j, v)| (i, j, parse(v).unwrap()))
    });
    Sparse::from_entries(rows.len(), rows.len(), entries.collect::<Vec<_>>())
}

fn problem(a: &[&[&str]], b: &[&[&str]], free: &[usize]) -> Problem {
    let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

fn numbers(list: &[&str]) -> Vec<Number> {
    list.iter().map(|v| Number(parse(v).unwrap())).collect()
}

fn claim(support: &[usize], p: &[i64], interval: (&str, &str), x: &[&[&str]]) -> ExactSolution {
    ExactSolution {
        support: support.to_vec(),
        biactive: vec![],
        polynomial: p.iter().map(|&c| c.into()).collect(),
        interval: [
            Number(parse(interval.0).unwrap()),
            Number(parse(interval.1).unwrap()),
        ],
        x: x.iter().map(|p| numbers(p)).collect(),
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

fn verdict(problem: &Problem, c: &ExactSolution) -> Result<(), Reason> {
    check(
        problem,
        &certificate(problem, Claim::ExactSolution(c.clone())),
    )
    .map(|_| ())
    .map_err(|r| {
        assert_eq!(r.claim, Some(0));
        r.reason
    })
}

/// t = sqrt 2 - 1 on the full support: (t+1)^2 = 2, x = (1, 2/(t+1)) = (1, t+1); index 2 sticks.
fn root_two() -> (Problem, ExactSolution) {
    let p = problem(
        &[&["1", "-1", "0"], &["-2", "1", "0"], &["1", "0", "9"]],
        &[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]],
        &[],
    );
    let c = claim(
        &[0, 1],
        &[-1, 2, 1],
        ("2/5", "1/2"),
        &[&["1"], &["1", "1"], &[]],
    );
    (p, c)
}

#[test]
fn the_true_certificate_is_accepted() {
    let (p, c) = root_two();
    assert_eq!(verdict(&p, &c), Ok(()));
    let scaled = ExactSolution {
        x: c.x
            .iter()
            .map(|g| g.iter().map(|n| Number(&n.0 * rational(7, 3))).collect())
            .collect(),
        ..c
    };
    assert_eq!(verdict(&p, &scaled), Ok(()));
}

type Change = fn(&mut ExactSolution);
type Test = fn(&Reason) -> bool;

#[test]
fn each_obligation_has_a_forgery() {
    let (p, good) = root_two();
    let cases: [(&str, Change, Test); 24] = [
        (
            "degree beyond all use",
            |c| c.polynomial = vec![Integer::from(1); 513],
            |r| {
                matches!(
                    r,
                    Reason::TooLarge {
                        what: "coefficients of the polynomial",
                        ..
                    }
                )
            },
        ),
        (
            "x of a degree beyond all use",
            |c| c.x[0] = vec![Number(whole(1)); 513],
            |r| {
                matches!(
                    r,
                    Reason::TooLarge {
                        what: "coefficients of x",
                        ..
                    }
                )
            },
        ),
        (
            "numbers of absurd length",
            |c| {
                c.interval[0].0 = rational(2, 5)
                    + rational(1, 3) / Rational::from_integer(Integer::from(7) << 1_000_000)
            },
            |r| {
                matches!(
                    r,
                    Reason::TooLarge {
                        what: "size (coefficients times bits)",
                        ..
                    }
                )
            },
        ),
        (
            "wrong root",
            |c| c.polynomial[0] = Integer::from(-2),
            |r| matches!(r, Reason::NoSignChange { .. }),
        ),
        (
            "a polynomial with another root there",
            |c| c.polynomial = vec![(-9).into(), 20.into()],
            |r| {
                matches!(
                    r,
                    Reason::YNotZero {
                        equation: "E25",
                        index: 1
                    }
                )
            },
        ),
        (
            "shifted interval",
            |c| c.interval = [Number(rational(1, 2)), Number(rational(3, 5))],
            |r| matches!(r, Reason::NoSignChange { .. }),
        ),
        (
            "end on the root's wrong side by 1e-30",
            |c| c.interval[0].0 = parse("0.414213562373095048801688724210").unwrap(),
            |r| matches!(r, Reason::NoSignChange { .. }),
        ),
        (
            "interval with a turning point",
            |c| c.interval = [Number(whole(-2)), Number(whole(1))],
            |r| matches!(r, Reason::NotIsolated { .. }),
        ),
        (
            "interval reversed",
            |c| c.interval.swap(0, 1),
            |r| matches!(r, Reason::ReversedInterval { .. }),
        ),
        (
            "point that is no root",
            |c| c.interval[1] = c.interval[0].clone(),
            |r| matches!(r, Reason::NotARoot { .. }),
        ),
        (
            "negative value",
            |c| c.interval = [Number(whole(-3)), Number(whole(-2))],
            |r| matches!(r, Reason::OutsideWindow { .. }),
        ),
        (
            "constant polynomial",
            |c| c.polynomial = vec![0.into()],
            |r| matches!(r, Reason::ConstantPolynomial { .. }),
        ),
        (
            "sign flipped",
            |c| c.x[0][0].0 = whole(-1),
            |r| matches!(r, Reason::XNotPositive { index: 0, .. }),
        ),
        (
            "x = 0",
            |c| c.x = vec![vec![]; 3],
            |r| matches!(r, Reason::XNotPositive { index: 0, .. }),
        ),
        (
            "kernel vector off by one coefficient",
            |c| c.x[1][0].0 += rational(1, 1_000_000_000),
            |r| matches!(r, Reason::YNotZero { .. }),
        ),
        (
            "support one short",
            |c| c.support = vec![0],
            |r| matches!(r, Reason::XOffSupport { index: 1 }),
        ),
        (
            "support one long",
            |c| c.support.push(2),
            |r| matches!(r, Reason::XNotPositive { index: 2, .. }),
        ),
        (
            "support not ascending",
            |c| c.support = vec![1, 0],
            |r| {
                matches!(
                    r,
                    Reason::IndexSet {
                        set: "support",
                        position: 1,
                        got: 0
                    }
                )
            },
        ),
        (
            "support out of range",
            |c| c.support = vec![0, 1, 3],
            |r| {
                matches!(
                    r,
                    Reason::IndexSet {
                        set: "support",
                        position: 2,
                        got: 3
                    }
                )
            },
        ),
        (
            "biactive invented",
            |c| c.biactive = vec![2],
            |r| {
                matches!(
                    r,
                    Reason::Biactive {
                        index: 2,
                        expected: false
                    }
                )
            },
        ),
        (
            "biactive on the support",
            |c| c.biactive = vec![0],
            |r| {
                matches!(
                    r,
                    Reason::Biactive {
                        index: 0,
                        expected: false
                    }
                )
            },
        ),
        (
            "biactive out of range",
            |c| c.biactive = vec![7],
            |r| {
                matches!(
                    r,
                    Reason::IndexSet {
                        set: "biactive",
                        ..
                    }
                )
            },
        ),
        (
            "x one variable long",
            |c| c.x.push(vec![]),
            |r| {
                matches!(
                    r,
                    Reason::Length {
                        what: "x",
                        expected: 3,
                        got: 4
                    }
                )
            },
        ),
        (
            "sticking variable moves",
            |c| c.x[2] = vec![Number(whole(1))],
            |r| matches!(r, Reason::XOffSupport { index: 2 }),
        ),
    ];
    for (name, change, expected) in cases {
        let mut forged = good.clone();
        change(&mut forged);
        match verdict(&p, &forged) {
            Ok(()) => panic!("{name}: accepted"),
            Err(reason) => assert!(expected(&reason), "{name}: {reason}"),
        }
    }
}

#[test]
fn y_negative_by_1e_30_is_rejected_and_positive_accepted() {
    let with = |y: &str| problem(&[&["-1", "0"], &[y, "5"]], &[&["1", "0"], &["0", "1"]], &[]);
    let c = claim(&[0], &[-1, 1], ("1", "1"), &[&["1"], &[]]);
    let negative = with("-1e-30");
    assert!(
        matches!(verdict(&negative, &c), Err(Reason::YNotPositive { index: 1, hi, .. }) if hi < whole(0))
    );
    assert_eq!(verdict(&with("1e-30"), &c), Ok(()));
    // The root must not be an end of the interval: that is what points are for.
    for (interval, signs) in [(("1", "2"), (0, 1)), (("0", "1"), (-1, 0))] {
        let at_end = claim(&[0], &[-1, 1], interval, &[&["1"], &[]]);
        let Err(Reason::NoSignChange { at_a, at_b }) = verdict(&with("1"), &at_end) else {
            panic!("accepted")
        };
        assert_eq!((at_a, at_b), signs);
    }
    let zero = with("0");
    assert!(matches!(
        verdict(&zero, &c),
        Err(Reason::Biactive {
            index: 1,
            expected: true
        })
    ));
    assert_eq!(
        verdict(
            &zero,
            &ExactSolution {
                biactive: vec![1],
                ..c
            }
        ),
        Ok(())
    );
}

/// y_2 = (t - 9/20) x_0 changes sign inside [2/5, 1/2] and is negative at t = sqrt 2 - 1: an
/// interval that leaves a sign open proves nothing. With 2/5 for 9/20 it is positive, provable on a
/// shorter one.
#[test]
fn a_sign_that_the_interval_leaves_open_is_rejected() {
    let with = |shift: &str| {
        let a: [[&str; 3]; 3] = [["1", "-1", "0"], ["-2", "1", "0"], [shift, "0", "9"]];
        problem(
            &[&a[0], &a[1], &a[2]],
            &[&["1", "0", "0"], &["0", "1", "0"], &["1", "0", "1"]],
            &[],
        )
    };
    let (_, wide) = root_two();
    let open = |p: &Problem, c: &ExactSolution| matches!(verdict(p, c), Err(Reason::YNotPositive { index: 2, lo, hi }) if lo < whole(0) && hi > whole(0));
    assert!(open(&with("-9/20"), &wide));
    let narrow = ExactSolution {
        interval: [Number(rational(41, 100)), Number(rational(42, 100))],
        ..wide.clone()
    };
    assert!(
        matches!(verdict(&with("-9/20"), &narrow), Err(Reason::YNotPositive { hi, .. }) if hi < whole(0))
    );
    assert_eq!(verdict(&with("-2/5"), &narrow), Ok(()));
    // The same for x: x_0 = 9/20 - t and x_1 = (t + 1) x_0 on the wide interval.
    let x = vec![
        numbers(&["9/20", "-1"]),
        numbers(&["-11/20", "29/20"]),
        vec![],
    ];
    let positive = ExactSolution {
        x: x.clone(),
        ..narrow
    };
    let (p, _) = root_two();
    assert_eq!(verdict(&p, &positive), Ok(()));
    assert!(matches!(
        verdict(&p, &ExactSolution { x, ..wide }),
        Err(Reason::XNotPositive { index: 0, .. })
    ));
}

#[test]
fn free_variables_must_balance_and_something_must_move() {
    // Free variable 0: (t - 1) x_0 = 0.
    let p = problem(
        &[&["-1", "0"], &["3", "2"]],
        &[&["1", "0"], &["0", "1"]],
        &[0],
    );
    let c = claim(&[], &[-1, 1], ("1", "1"), &[&["1"], &[]]);
    assert_eq!(verdict(&p, &c), Ok(()));
    let still = ExactSolution {
        x: vec![vec![], vec![]],
        ..c.clone()
    };
    assert_eq!(verdict(&p, &still), Err(Reason::XZero));
    let unbalanced = ExactSolution {
        polynomial: vec![(-2).into(), 1.into()],
        interval: [Number(whole(2)), Number(whole(2))],
        ..c.clone()
    };
    assert!(matches!(
        verdict(&p, &unbalanced),
        Err(Reason::YNotZero {
            equation: "E13",
            index: 0
        })
    ));
    let free_in_support = ExactSolution {
        support: vec![0],
        ..c
    };
    assert!(matches!(
        verdict(&p, &free_in_support),
        Err(Reason::IndexSet { got: 0, .. })
    ));
}

#[test]
fn the_frame_of_a_certificate_is_checked_first() {
    let (p, c) = root_two();
    let good = certificate(&p, Claim::ExactSolution(c));
    let reason = |c: &Certificate| check(&p, c).unwrap_err().reason;
    assert!(matches!(
        reason(&Certificate {
            problem_sha256: "0".repeat(64),
            ..good.clone()
        }),
        Reason::Digest { .. }
    ));
    assert!(matches!(
        reason(&Certificate {
            unknown: Unknown::Mu,
            ..good.clone()
        }),
        Reason::Unknown {
            expected: "lambda2",
            got: "mu"
        }
    ));
    assert!(matches!(
        reason(&Certificate {
            claims: vec![],
            ..good.clone()
        }),
        Reason::NoClaims
    ));
    let window = Window::new(whole(0), Some(rational(9, 20))).unwrap();
    assert!(matches!(
        reason(&Certificate { window, ..good }),
        Reason::OutsideWindow { .. }
    ));
}

/// x = (1/2, 1/2), t = 3 of [[-1, -2], [-2, -1]] + t I, with an exact inverse as preconditioner.
fn boxed() -> (Problem, EnclosedSolution) {
    let p = problem(
        &[&["-1", "-2"], &["-2", "-1"]],
        &[&["1", "0"], &["0", "1"]],
        &[],
    );
    // F' = [[2, -2, 1/2], [-2, 2, 1/2], [1, 1, 0]]; its inverse has entries 1/8, 1/2, 1.
    let y = [[2, -2, 8], [-2, 2, 8], [16, 16, 0]]; // in sixteenths
    let preconditioner = y.map(|r| r.map(Integer::from).to_vec()).to_vec();
    let radius = vec![Number(rational(1, 1 << 20)); 3];
    let c = EnclosedSolution {
        support: vec![0, 1],
        center: numbers(&["0.5", "0.5", "3"]),
        radius,
        preconditioner,
        exponent: 4,
    };
    (p, c)
}

#[test]
fn enclosed_solutions_and_their_forgeries() {
    let (p, good) = boxed();
    let verdict = |c: &EnclosedSolution| {
        check(&p, &certificate(&p, Claim::EnclosedSolution(c.clone()))).map_err(|r| r.reason)
    };
    let value = verdict(&good).unwrap().claims[0].value.clone();
    assert!(value.contains(&whole(3)) && value.width() < rational(1, 100_000));
    type Change = fn(&mut EnclosedSolution);
    let cases: [(&str, Change, Test); 10] = [
        (
            "no contraction",
            |c| c.preconditioner[2] = vec![0.into(); 3],
            |r| matches!(r, Reason::NotContracting { index: 2, .. }),
        ),
        (
            "centre off by more than the box",
            |c| c.center[2].0 += rational(1, 1 << 18),
            |r| matches!(r, Reason::NotContracting { .. }),
        ),
        (
            "box too large",
            |c| c.radius = vec![Number(whole(4)); 3],
            |r| matches!(r, Reason::NotContracting { .. }),
        ),
        (
            "box without width",
            |c| c.radius[1].0 = whole(0),
            |r| matches!(r, Reason::Radius { index: 1, .. }),
        ),
        (
            "short centre",
            |c| c.center.truncate(2),
            |r| matches!(r, Reason::Length { what: "center", .. }),
        ),
        (
            "short radius",
            |c| c.radius.truncate(1),
            |r| matches!(r, Reason::Length { what: "radius", .. }),
        ),
        (
            "short preconditioner",
            |c| c.preconditioner.truncate(2),
            |r| {
                matches!(
                    r,
                    Reason::Length {
                        what: "preconditioner",
                        ..
                    }
                )
            },
        ),
        (
            "ragged preconditioner",
            |c| c.preconditioner[0].truncate(2),
            |r| {
                matches!(
                    r,
                    Reason::Length {
                        what: "preconditioner row",
                        ..
                    }
                )
            },
        ),
        (
            "gigabytes of exponent",
            |c| c.exponent = u32::MAX,
            |r| {
                matches!(
                    r,
                    Reason::TooLarge {
                        what: "exponent",
                        ..
                    }
                )
            },
        ),
        (
            "empty support",
            |c| c.support.clear(),
            |r| matches!(r, Reason::XZero),
        ),
    ];
    for (name, change, expected) in cases {
        let mut forged = good.clone();
        change(&mut forged);
        let reason = verdict(&forged).expect_err(name);
        assert!(expected(&reason), "{name}: {reason}");
    }
    let narrow = Window::new(whole(0), Some(whole(3))).unwrap();
    let cut = Certificate {
        window: narrow,
        ..certificate(&p, Claim::EnclosedSolution(good))
    };
    assert!(matches!(
        check(&p, &cut).unwrap_err().reason,
        Reason::OutsideWindow { .. }
    ));
}

/// The bound that is told: with Y = 0 it is |I| r = r, whatever the radii.
#[test]
fn the_bound_of_a_box_is_told_in_its_own_units() {
    let (p, mut c) = boxed();
    c.radius = numbers(&["3/64", "5/64", "7/64"]);
    c.preconditioner[1] = vec![0.into(); 3];
    let got = check(&p, &certificate(&p, Claim::EnclosedSolution(c.clone())))
        .unwrap_err()
        .reason;
    assert_eq!(
        got,
        Reason::NotContracting {
            index: 1,
            got: rational(5, 64),
            radius: rational(5, 64)
        }
    );
    // A preconditioner twice too large: |I - 2I| r is r again, and |Y| d comes on top: d = 2 r_t
    // (r_0, r_1).
    let (p, mut c) = boxed();
    c.radius = numbers(&["3/64", "5/64", "7/64"]);
    c.preconditioner[0].iter_mut().for_each(|y| *y *= 2);
    let got = check(&p, &certificate(&p, Claim::EnclosedSolution(c)))
        .unwrap_err()
        .reason;
    let d = [3, 5].map(|r| rational(2 * 7 * r, 64 * 64));
    let bound = rational(3, 64) + (&d[0] + &d[1]) * rational(4, 16);
    assert_eq!(
        got,
        Reason::NotContracting {
            index: 0,
            got: bound,
            radius: rational(3, 64)
        }
    );
}

/// The largest exponent of a preconditioner is allowed.
#[test]
fn a_preconditioner_may_be_long() {
    let (p, good) = boxed();
    let with = |exponent: u32| {
        let mut c = EnclosedSolution {
            exponent,
            ..good.clone()
        };
        c.preconditioner
            .iter_mut()
            .flatten()
            .for_each(|y| *y <<= exponent - 4);
        check(&p, &certificate(&p, Claim::EnclosedSolution(c)))
            .map(|_| ())
            .map_err(|r| r.reason)
    };
    assert_eq!(with(65_536), Ok(()));
    assert_eq!(
        with(65_537),
        Err(Reason::TooLarge {
            what: "exponent",
            limit: 65_536,
            got: 65_537
        })
    );
}

/// One slip particle, K = [[2, -1], [-1, 5]]: v_T (2 - mu) = 0. Without a free degree of freedom
/// nothing else moves.
#[test]
fn a_lifted_claim_needs_something_that_moves() {
    let particle =
        |tangential| Particle::plain(tangential, tangential + 1, ContactState::Slip { sign: 1 });
    let system = |rows: &[&[&str]], tangential: usize| {
        let s = System::new(sparse(rows), None, None, vec![particle(tangential)]).unwrap();
        Problem::new(Body::System(s), Unknown::Mu, Window::all()).unwrap()
    };
    let two = || [Number(whole(2)), Number(whole(2))];
    let lifted = |support: &[usize], biactive: &[usize], v: &[&str], w: &[&str]| LiftedSolution {
        support: support.to_vec(),
        biactive: biactive.to_vec(),
        polynomial: vec![(-2).into(), 1.into()],
        interval: two(),
        v: v.iter().map(|c| numbers(&[c])).collect(),
        w: w.iter().map(|c| numbers(&[c])).collect(),
    };
    let verdict = |p: &Problem, c: LiftedSolution| {
        check(p, &certificate(p, Claim::LiftedSolution(c)))
            .map(|_| ())
            .map_err(|r| r.reason)
    };
    let p = system(&[&["2", "-1"], &["-1", "5"]], 0);
    assert_eq!(
        verdict(&p, lifted(&[0], &[], &["-1", "0"], &["-2", "1"])),
        Ok(())
    );
    assert_eq!(
        verdict(&p, lifted(&[], &[0], &["0", "0"], &["0", "0"])),
        Err(Reason::XZero)
    );
    // Dof 0 is free and stays: the slip variable is number 1.
    let p = system(&[&["3", "0", "0"], &["0", "2", "-1"], &["0", "-1", "5"]], 1);
    assert_eq!(
        verdict(&p, lifted(&[1], &[], &["0", "-1", "0"], &["0", "-2", "1"])),
        Ok(())
    );
    assert_eq!(
        verdict(&p, lifted(&[], &[1], &["0", "0", "0"], &["0", "0", "0"])),
        Err(Reason::XZero)
    );
}

#[test]
fn enclosed_signs_must_be_strict_over_the_box() {
    // Third variable sticks with y_2 = x_0 - x_1 = 0 at the solution: no strict sign, no proof.
    let stuck = problem(
        &[&["-1", "-2", "0"], &["-2", "-1", "0"], &["1", "-1", "9"]],
        &[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]],
        &[],
    );
    let (_, c) = boxed();
    let got = check(
        &stuck,
        &certificate(&stuck, Claim::EnclosedSolution(c.clone())),
    )
    .unwrap_err()
    .reason;
    assert!(matches!(got, Reason::YNotPositive { index: 2, .. }));
    // A solution of the linear system with a negative component: t = -1, x = (1, -1) up to scale is
    // outside the window; t = 3 with x = (3/2, -1/2) does not solve it.
    let (p, mut c) = boxed();
    c.center[0].0 = rational(3, 2);
    c.center[1].0 = rational(-1, 2);
    assert!(check(&p, &certificate(&p, Claim::EnclosedSolution(c))).is_err());
}

#[test]
fn exact_box_is_rejected_when_radius_equals_its_bound() {
    // |I - YF'| r = 0 and F(c) = 0: the bound is |Y| d alone, quadratic in r; find r where it just
    // fails.
    let (p, c) = boxed();
    let accepted = |r: Rational| {
        let c = EnclosedSolution {
            radius: vec![Number(r); 3],
            ..c.clone()
        };
        check(&p, &certificate(&p, Claim::EnclosedSolution(c))).is_ok()
    };
    // d = (2 r^2, 2 r^2, 0); row 2 of |Y| gives 4 r^2 < r: r < 1/4 exactly.
    assert!(!accepted(rational(1, 4)));
    assert!(accepted(rational(1, 4) - rational(1, 1_000_000)));
}
