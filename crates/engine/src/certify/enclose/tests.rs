//! The box that is proposed: where its centre lies, how wide it is, and what is told instead of it.

use super::*;
use mceip_exact::{Rational, Sparse, parse, rational, whole};
use num_traits::One;

/// [[-1, -2], [-2, -1]] + t I: x = (1/2, 1/2), t = 3; a third variable rests with y = `rest` times
/// x. All rows times a factor.
fn pencil(rest: [i64; 2], factor: &Rational) -> Pencil {
    let a = [[-1, -2, 0], [-2, -1, 0], [rest[0], rest[1], 9]];
    let times = |v: i64| whole(v) * factor;
    let a = Sparse::from_entries(
        3,
        3,
        (0..3)
            .flat_map(|i| (0..3).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, times(a[i][j])))
            .collect::<Vec<_>>(),
    );
    Pencil::new(
        a,
        Sparse::from_entries(3, 3, (0..3).map(|i| (i, i, factor.clone()))),
        vec![],
    )
    .unwrap()
}

fn of(
    p: &Pencil,
    window: &Window,
    support: &[usize],
    value: f64,
    x: [f64; 3],
) -> Result<EnclosedSolution, AttemptFailure> {
    make(
        p,
        &IntegralRows::of(p),
        window,
        support,
        &Candidate {
            value,
            x: x.to_vec(),
        },
    )
}

const X: [f64; 3] = [0.5 + 1e-7, 0.5 - 2e-7, 0.0];

/// From a candidate some digits off the centre comes within the grid of the truth, for rows of any
/// size.
#[test]
fn the_centre_is_polished() {
    let long = format!("1234567{}", "0".repeat(900));
    for factor in [
        whole(1),
        rational(1, 7),
        parse("1e-400").unwrap(),
        parse("1e400").unwrap(),
        parse(&long).unwrap(),
    ] {
        // The factor of the first row alone: denominators are cleared row by row.
        let mut p = pencil([1, 1], &whole(1));
        if !factor.is_integer() || factor > whole(1) {
            let scaled = |m: &Sparse| {
                m.entries()
                    .map(|(i, j, v)| (i, j, if i == 0 { v * &factor } else { v.clone() }))
                    .collect::<Vec<_>>()
            };
            p = Pencil::new(
                Sparse::from_entries(3, 3, scaled(p.a())),
                Sparse::from_entries(3, 3, scaled(p.b())),
                vec![],
            )
            .unwrap();
        }
        let c = of(&p, &Window::all(), &[0, 1], 3.0 + 1e-7, X).unwrap();
        let off = |k: usize, v: Rational| (&c.center[k].0 - v).abs();
        let limit = rational(1, 1 << 60);
        assert!(
            off(0, rational(1, 2)) < limit
                && off(1, rational(1, 2)) < limit
                && off(2, whole(3)) < limit,
            "{factor}"
        );
    }
}

/// Far from every solution steps grow; after the first that does no more is taken, and the numbers
/// stay short.
#[test]
fn steps_that_grow_are_given_up() {
    let p = pencil([1, 1], &whole(1));
    let rows = IntegralRows::of(&p);
    let newton = Newton::new(&p, &rows, &[0, 1]);
    let far = Candidate {
        value: -0.99,
        x: vec![0.3, 0.7, 0.0],
    };
    let mut point = newton.start(&far, FIRST_GRID_BITS).unwrap();
    let inverse = newton.inverse(&point).unwrap();

    newton.polish(&mut point, &inverse);

    let bits = (0..=2).map(|k| point.component(k).bits()).max().unwrap();
    assert!(bits < u64::from(FIRST_GRID_BITS) + 40, "{bits} bits");
}

/// What lies beside the window is no root there; of a value at its end a box says nothing.
#[test]
fn a_value_beside_the_window_is_none() {
    let p = pencil([1, 1], &whole(1));
    let at = |min: i64, max: Option<i64>| {
        of(
            &p,
            &Window::new(whole(min), max.map(whole)).unwrap(),
            &[0, 1],
            3.0,
            [0.5, 0.5, 0.0],
        )
        .map(|_| ())
    };
    assert_eq!(
        [at(0, None), at(2, None), at(0, Some(4)), at(2, Some(4))],
        [Ok(()), Ok(()), Ok(()), Ok(())]
    );
    for (min, max) in [(3, None), (0, Some(3)), (3, Some(3))] {
        assert!(
            matches!(
                at(min, max),
                Err(AttemptFailure::Undecided {
                    bits: LAST_GRID_BITS,
                    ..
                })
            ),
            "{min} {max:?}"
        );
    }
    for (min, max) in [(4, None), (4, Some(5)), (0, Some(2))] {
        assert!(
            matches!(at(min, max), Err(AttemptFailure::NoRootNear { .. })),
            "{min} {max:?}"
        );
    }
}

/// How far the polished centre may be: X_RADIUS, or VALUE_RADIUS (1 + value) if that is more.
#[test]
fn a_candidate_too_far_away_is_not_the_solution() {
    // [[1 - s, ...]]: the value is 10^6, so that 100 is near and 200 is not.
    let a = Sparse::from_ints(&[&[-1_000_000]]);
    let p = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
    let at = |value: f64| {
        make(
            &p,
            &IntegralRows::of(&p),
            &Window::all(),
            &[0],
            &Candidate {
                value,
                x: vec![1.0],
            },
        )
        .map(|_| ())
    };
    assert_eq!(
        [at(1_000_000.0), at(1_000_090.0), at(999_910.0)],
        [Ok(()), Ok(()), Ok(())]
    );
    assert!(
        [1_000_150.0, 999_850.0]
            .iter()
            .all(|v| matches!(at(*v), Err(AttemptFailure::TooFar { .. })))
    );
    // At 10 it is 0.0011.
    let p = Pencil::new(Sparse::from_ints(&[&[-10]]), Sparse::identity(1), vec![]).unwrap();
    let at = |value: f64| {
        make(
            &p,
            &IntegralRows::of(&p),
            &Window::all(),
            &[0],
            &Candidate {
                value,
                x: vec![1.0],
            },
        )
        .map(|_| ())
    };
    assert!(at(10.00105).is_ok() && at(10.00115).is_err());
    // At zero the value is no scale, and no box around it lies in the window.
    let p = Pencil::new(Sparse::from_entries(1, 1, []), Sparse::identity(1), vec![]).unwrap();
    let at_zero = make(
        &p,
        &IntegralRows::of(&p),
        &Window::all(),
        &[0],
        &Candidate {
            value: 0.0,
            x: vec![1.0],
        },
    );
    assert!(matches!(at_zero, Err(AttemptFailure::Undecided { .. })));
    // At a value near zero the bound is X_RADIUS itself, not the ten times smaller one of values.
    let p = Pencil::new(
        Sparse::from_entries(1, 1, [(0, 0, rational(-1, 1000))]),
        Sparse::identity(1),
        vec![],
    )
    .unwrap();
    let at = |value: f64| {
        make(
            &p,
            &IntegralRows::of(&p),
            &Window::all(),
            &[0],
            &Candidate {
                value,
                x: vec![1.0],
            },
        )
        .map(|_| ())
    };
    assert_eq!(at(0.0015), Ok(()));
    assert!(matches!(at(0.0035), Err(AttemptFailure::TooFar { .. })));
}

/// A wrong support is named with the component that gives it away.
#[test]
fn wrong_signs_are_named() {
    let all = Window::all();
    assert_eq!(
        of(
            &pencil([-1, -1], &whole(1)),
            &all,
            &[0, 1],
            3.0,
            [0.5, 0.5, 0.0]
        )
        .map(|_| ()),
        Err(AttemptFailure::YNegative { index: 2 })
    );
    assert_eq!(
        of(
            &pencil([1, -1], &whole(1)),
            &all,
            &[0, 1],
            3.0,
            [0.5, 0.5, 0.0]
        )
        .map(|_| ()),
        Err(AttemptFailure::Undecided {
            what: "y[2]".into(),
            bits: LAST_GRID_BITS
        })
    );
    assert!(
        of(
            &pencil([1, 1], &whole(1)),
            &all,
            &[0, 1],
            3.0,
            [0.5, 0.5, 0.0]
        )
        .is_ok()
    );
    // Swapped signs: [[-1, 2], [2, -1]] has x = (1, -1) at t = 3, and e'x = 0 there; a free part
    // gives e'x its sum.
    let a = Sparse::from_ints(&[&[-1, 4], &[1, -1]]);
    // (1 - t)^2 = 4: t = 3, x = (2, -1).
    let p = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
    let got = make(
        &p,
        &IntegralRows::of(&p),
        &all,
        &[0, 1],
        &Candidate {
            value: 3.0,
            x: vec![2.0, -1.0],
        },
    )
    .map(|_| ());
    assert_eq!(got, Err(AttemptFailure::XNotPositive { index: 1 }));
}

/// Rows of 66,000 bits would need a preconditioner of as many.
#[test]
fn a_preconditioner_has_no_more_than_so_many_bits() {
    let a_row_times = |bits: u32| {
        let factor = Rational::from_integer(Integer::one() << bits);
        let times = |m: &Sparse| {
            m.entries()
                .map(|(i, j, v)| (i, j, if i == 0 { v * &factor } else { v.clone() }))
                .collect::<Vec<_>>()
        };
        let p = pencil([1, 1], &whole(1));
        let p = Pencil::new(
            Sparse::from_entries(3, 3, times(p.a())),
            Sparse::from_entries(3, 3, times(p.b())),
            vec![],
        )
        .unwrap();
        of(&p, &Window::all(), &[0, 1], 3.0, X).map(|_| ())
    };
    assert_eq!(a_row_times(60_000), Ok(()));
    assert!(matches!(
        a_row_times(66_000),
        Err(AttemptFailure::TooLarge {
            limit: 65_536,
            got: 66_000..
        })
    ));
}

/// A diagonal pencil with one coupling: row 0 vanishes at t = 1, row 1 gives x_1 = small / 2 or, at
/// rest, y_1 = small x_0.
fn coupled(small: &str) -> Pencil {
    let small = parse(small).unwrap();
    let a = Sparse::from_entries(2, 2, [(0, 0, whole(-1)), (1, 0, small), (1, 1, whole(1))]);
    Pencil::new(a, Sparse::identity(2), vec![]).unwrap()
}

fn coupled_claim(small: &str, support: &[usize]) -> Result<EnclosedSolution, AttemptFailure> {
    let p = coupled(small);
    make(
        &p,
        &IntegralRows::of(&p),
        &Window::all(),
        support,
        &Candidate {
            value: 1.0,
            x: vec![1.0, 0.0],
        },
    )
}

/// Does the checker accept the claim?
fn is_accepted(small: &str, claim: EnclosedSolution) -> bool {
    use mceip_model::{Body, Problem, Unknown};
    let problem = Problem::new(Body::Pencil(coupled(small)), Unknown::Mu, Window::all()).unwrap();
    let verdict = mceip_check::ClaimChecker::new(&problem).verdict(
        &Window::all(),
        &mceip_check::certificate::Claim::EnclosedSolution(claim),
    );
    verdict.is_ok()
}

/// A local mode: reactions and components that are tiny beside the largest have their signs, and
/// the checker agrees.
#[test]
fn tiny_components_have_their_signs() {
    for small in ["1e-3", "1e-20", "5e-34", "1e-100", "1e-150"] {
        let at_rest = coupled_claim(small, &[0]).unwrap();
        assert!(is_accepted(small, at_rest), "{small}");
        assert_eq!(
            coupled_claim(small, &[0, 1]),
            Err(AttemptFailure::XNotPositive { index: 1 }),
            "{small}"
        );

        let turned = format!("-{small}");
        let moving = coupled_claim(&turned, &[0, 1]).unwrap();
        assert!(
            moving.center[1].0.is_positive() && is_accepted(&turned, moving),
            "{small}"
        );
        assert_eq!(
            coupled_claim(&turned, &[0]),
            Err(AttemptFailure::YNegative { index: 1 }),
            "{small}"
        );
    }
}

/// What is zero, or below the last grid, has no sign.
#[test]
fn a_component_of_nothing_is_undecided() {
    let undecided = |what: &str| {
        Err(AttemptFailure::Undecided {
            what: what.into(),
            bits: LAST_GRID_BITS,
        })
    };
    assert_eq!(coupled_claim("0", &[0]), undecided("y[1]"));
    assert_eq!(coupled_claim("0", &[0, 1]), undecided("x[1]"));
    assert_eq!(coupled_claim("1e-200", &[0, 1]), undecided("x[1]"));
    assert_eq!(coupled_claim("-1e-200", &[0, 1]), undecided("x[1]"));
}

/// A claim whose signs are decided at once has the grid of the first try, and radii of a few units
/// of it.
#[test]
fn an_ordinary_box_is_as_wide_as_its_grid() {
    let claim = coupled_claim("1", &[0]).unwrap();
    let unit = Rational::new(Integer::one(), Integer::one() << (FIRST_GRID_BITS - 1));
    for radius in &claim.radius {
        assert!(
            radius.0 >= unit && radius.0 <= &unit * whole(16),
            "{}",
            radius.0
        );
    }
}
