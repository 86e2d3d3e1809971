//! The box that is proposed: where its centre lies, how wide it is, and what is told instead of it.

use super::*;
use mceip_check::ClaimChecker;
use mceip_check::certificate::Claim;
use mceip_exact::{Rational, Sparse, parse, rational, whole};
use mceip_model::{Body, Problem, Unknown};
use num_traits::One;

/// A candidate near x = (1/2, 1/2, 0).
const X: [f64; 3] = [0.5 + 1e-7, 0.5 - 2e-7, 0.0];

/// [[-1, -2], [-2, -1]] + t I: x = (1/2, 1/2), t = 3; a third variable rests with y = `rest` times
/// x.
fn pencil(rest: [i64; 2]) -> Pencil {
    let a = Sparse::from_ints(&[&[-1, -2, 0], &[-2, -1, 0], &[rest[0], rest[1], 9]]);
    Pencil::new(a, Sparse::identity(3), vec![]).unwrap()
}

/// The pencil with its first row times a factor.
fn with_first_row_times(factor: &Rational, pencil: &Pencil) -> Pencil {
    let a = first_row_times(factor, pencil.a());
    let b = first_row_times(factor, pencil.b());
    Pencil::new(a, b, vec![]).unwrap()
}

fn first_row_times(factor: &Rational, matrix: &Sparse) -> Sparse {
    let mut entries = Vec::new();
    for (i, j, v) in matrix.entries() {
        let v = if i == 0 { v * factor } else { v.clone() };
        entries.push((i, j, v));
    }

    Sparse::from_entries(3, 3, entries)
}

/// The claim about a candidate.
fn made(
    pencil: &Pencil,
    window: &Window,
    support: &[usize],
    value: f64,
    x: &[f64],
) -> Result<EnclosedSolution, AttemptFailure> {
    let rows = IntegralRows::of(pencil);
    let candidate = Candidate {
        value,
        x: x.to_vec(),
    };
    make(pencil, &rows, window, support, &candidate)
}

/// What failed, if anything did.
fn outcome(claim: Result<EnclosedSolution, AttemptFailure>) -> Result<(), AttemptFailure> {
    claim.map(|_| ())
}

/// From a candidate some digits off the centre comes within the grid of the truth, for rows of any
/// size.
#[test]
fn the_centre_is_polished() {
    let long = format!("1234567{}", "0".repeat(900));
    let factors = [
        whole(1),
        rational(1, 7),
        parse("1e-400").unwrap(),
        parse("1e400").unwrap(),
        parse(&long).unwrap(),
    ];
    let solution = [rational(1, 2), rational(1, 2), whole(3)];
    let limit = rational(1, 1 << 60);

    for factor in factors {
        // The factor of the first row alone: denominators are cleared row by row.
        let p = with_first_row_times(&factor, &pencil([1, 1]));

        let claim = made(&p, &Window::all(), &[0, 1], 3.0 + 1e-7, &X).unwrap();

        for (center, expected) in claim.center.iter().zip(&solution) {
            assert!((&center.0 - expected).abs() < limit, "{factor}");
        }
    }
}

/// Far from every solution steps grow; after the first that does no more is taken, and the numbers
/// stay short.
#[test]
fn steps_that_grow_are_given_up() {
    let p = pencil([1, 1]);
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

/// What becomes of the solution at t = 3 in a window.
fn in_window(min: i64, max: Option<i64>) -> Result<(), AttemptFailure> {
    let window = Window::new(whole(min), max.map(whole)).unwrap();
    outcome(made(
        &pencil([1, 1]),
        &window,
        &[0, 1],
        3.0,
        &[0.5, 0.5, 0.0],
    ))
}

/// What lies beside the window is no root there; of a value at its end a box says nothing.
#[test]
fn a_value_beside_the_window_is_none() {
    for (min, max) in [(0, None), (2, None), (0, Some(4)), (2, Some(4))] {
        assert_eq!(in_window(min, max), Ok(()));
    }

    for (min, max) in [(3, None), (0, Some(3)), (3, Some(3))] {
        let at_end = in_window(min, max);
        let Err(AttemptFailure::Undecided { bits, .. }) = at_end else {
            panic!("{min} {max:?}")
        };
        assert_eq!(bits, LAST_GRID_BITS);
    }

    for (min, max) in [(4, None), (4, Some(5)), (0, Some(2))] {
        let beside = in_window(min, max);
        assert!(
            matches!(beside, Err(AttemptFailure::NoRootNear { .. })),
            "{min} {max:?}"
        );
    }
}

/// What becomes of a candidate for the one variable whose solution has the value `solution`.
fn with_one_variable(solution: &Rational, candidate: f64) -> Result<(), AttemptFailure> {
    let a = Sparse::from_entries(1, 1, [(0, 0, -solution.clone())]);
    let pencil = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
    outcome(made(&pencil, &Window::all(), &[0], candidate, &[1.0]))
}

fn is_too_far(outcome: &Result<(), AttemptFailure>) -> bool {
    matches!(outcome, Err(AttemptFailure::TooFar { .. }))
}

/// How far the polished centre may be: X_RADIUS, or VALUE_RADIUS (1 + value) if that is more.
#[test]
fn a_candidate_too_far_away_is_not_the_solution() {
    // The value is 10^6, so that 90 is near and 150 is not.
    let million = whole(1_000_000);
    for near in [1_000_000.0, 1_000_090.0, 999_910.0] {
        assert_eq!(with_one_variable(&million, near), Ok(()));
    }

    for far in [1_000_150.0, 999_850.0] {
        assert!(is_too_far(&with_one_variable(&million, far)));
    }

    // At 10 the bound is 0.0011.
    assert!(with_one_variable(&whole(10), 10.00105).is_ok());
    assert!(with_one_variable(&whole(10), 10.00115).is_err());

    // At zero the value is no scale, and no box around it lies in the window.
    let at_zero = with_one_variable(&whole(0), 0.0);
    assert!(matches!(at_zero, Err(AttemptFailure::Undecided { .. })));

    // At a value near zero the bound is X_RADIUS itself, not the ten times smaller one of values.
    let small = rational(1, 1000);
    assert_eq!(with_one_variable(&small, 0.0015), Ok(()));
    assert!(is_too_far(&with_one_variable(&small, 0.0035)));
}

/// What becomes of the solution at t = 3 where the third variable has y = `rest` times x.
fn with_rest(rest: [i64; 2]) -> Result<(), AttemptFailure> {
    let x = [0.5, 0.5, 0.0];
    outcome(made(&pencil(rest), &Window::all(), &[0, 1], 3.0, &x))
}

/// A wrong support is named with the component that gives it away.
#[test]
fn wrong_signs_are_named() {
    assert_eq!(
        with_rest([-1, -1]),
        Err(AttemptFailure::YNegative { index: 2 })
    );
    assert_eq!(
        with_rest([1, -1]),
        Err(AttemptFailure::Undecided {
            what: "y[2]".into(),
            bits: LAST_GRID_BITS
        })
    );
    assert!(with_rest([1, 1]).is_ok());

    // (1 - t)^2 = 4: t = 3, x = (2, -1).
    let a = Sparse::from_ints(&[&[-1, 4], &[1, -1]]);
    let p = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
    let claim = made(&p, &Window::all(), &[0, 1], 3.0, &[2.0, -1.0]);
    assert_eq!(
        outcome(claim),
        Err(AttemptFailure::XNotPositive { index: 1 })
    );
}

/// What becomes of the solution at t = 3 with a row times 2^bits.
fn with_row_of_bits(bits: u32) -> Result<(), AttemptFailure> {
    let factor = Rational::from_integer(Integer::one() << bits);
    let p = with_first_row_times(&factor, &pencil([1, 1]));
    outcome(made(&p, &Window::all(), &[0, 1], 3.0, &X))
}

/// Rows of 66,000 bits would need a preconditioner of as many.
#[test]
fn a_preconditioner_has_no_more_than_so_many_bits() {
    assert_eq!(with_row_of_bits(60_000), Ok(()));

    let too_large = with_row_of_bits(66_000);
    assert!(matches!(
        too_large,
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
    made(&coupled(small), &Window::all(), support, 1.0, &[1.0, 0.0])
}

/// Does the checker accept the claim?
fn is_accepted(small: &str, claim: EnclosedSolution) -> bool {
    let body = Body::Pencil(coupled(small));
    let problem = Problem::new(body, Unknown::Mu, Window::all()).unwrap();
    let checker = ClaimChecker::new(&problem);
    let verdict = checker.verdict(&Window::all(), &Claim::EnclosedSolution(claim));
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
        assert!(moving.center[1].0.is_positive(), "{small}");
        assert!(is_accepted(&turned, moving), "{small}");
        assert_eq!(
            coupled_claim(&turned, &[0]),
            Err(AttemptFailure::YNegative { index: 1 }),
            "{small}"
        );
    }
}

/// The failure of a sign that stays undecided to the last grid.
fn undecided(what: &str) -> Result<EnclosedSolution, AttemptFailure> {
    Err(AttemptFailure::Undecided {
        what: what.into(),
        bits: LAST_GRID_BITS,
    })
}

/// What is zero, or below the last grid, has no sign.
#[test]
fn a_component_of_nothing_is_undecided() {
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
        assert!(radius.0 >= unit, "{}", radius.0);
        assert!(radius.0 <= &unit * whole(16), "{}", radius.0);
    }
}
