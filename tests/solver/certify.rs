//! Candidates to claims: what is certified is accepted; what is not is refused for the right
//! reason.
#![cfg(feature = "solver")]

use mceip_check::certificate::Claim;
use mceip_check::check;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{AttemptFailure, certificate, propose};
use mceip_exact::{Sparse, parse};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use num_traits::Signed;

fn pencil(a: &[&[&str]], b: &[&[&str]]) -> Pencil {
    let sparse = |m: &[&[&str]]| {
        let entries: Vec<_> = m
            .iter()
            .enumerate()
            .flat_map(|(i, r)| {
                r.iter()
                    .enumerate()
                    .map(move |(j, v)| (i, j, parse(v).unwrap()))
            })
            .collect();
        Sparse::from_entries(m.len(), m.len(), entries)
    };
    Pencil::new(sparse(a), sparse(b), vec![]).unwrap()
}

const I2: &[&[&str]] = &[&["1", "0"], &["0", "1"]];

fn candidate(value: f64, x: &[f64]) -> Candidate {
    Candidate {
        value,
        x: x.to_vec(),
    }
}

/// What the first support tried failed with.
fn failure(p: &Pencil, c: &Candidate) -> AttemptFailure {
    propose(p, &Window::all(), c)
        .unwrap_err()
        .attempts
        .remove(0)
        .failure
}

#[test]
fn six_digits_give_an_exact_claim_that_is_accepted() {
    let p = pencil(&[&["1", "-6"], &["2", "-6"]], I2);
    let claim = propose(
        &p,
        &Window::all(),
        &candidate(2.000001, &[0.666667, 0.333333]),
    )
    .unwrap();
    assert!(
        matches!(&claim, Claim::ExactSolution(c) if c.support == [0, 1] && c.polynomial.len() == 2)
    );
    let problem = Problem::new(Body::Pencil(p), Unknown::Lambda2, Window::all()).unwrap();
    assert!(check(&problem, &certificate(&problem, vec![claim])).is_ok());
}

#[test]
fn near_misses_are_refused_for_the_right_reason() {
    let p = pencil(&[&["1", "-6"], &["2", "-6"]], I2);
    assert!(matches!(
        failure(&p, &candidate(2.5, &[0.6, 0.4])),
        AttemptFailure::NoRootNear { .. }
    ));
    assert!(matches!(
        failure(&p, &candidate(2.0, &[0.5, 0.5])),
        AttemptFailure::TooFar { .. }
    ));
    assert!(matches!(
        failure(&p, &candidate(f64::NAN, &[0.5, 0.5])),
        AttemptFailure::NotFinite
    ));
    assert!(matches!(
        failure(&p, &candidate(2.0, &[0.0, 0.0])),
        AttemptFailure::ZeroX
    ));
    assert!(matches!(
        failure(&p, &candidate(2.0, &[1.0])),
        AttemptFailure::WrongLength {
            expected: 2,
            got: 1
        }
    ));
    // x = (1, 0) at t = 1 with y_1 = -1e-20: no float sees it.
    let negative = pencil(&[&["-1", "0"], &["-1e-20", "7"]], I2);
    assert_eq!(
        failure(&negative, &candidate(1.0, &[1.0, 0.0])),
        AttemptFailure::YNegative { index: 1 }
    );
    // At t = 1 the kernel is (1, -1): not positive.
    let opposed = pencil(&[&["0", "1"], &["1", "0"]], I2);
    assert!(matches!(
        failure(&opposed, &candidate(1.0, &[0.5, 0.5])),
        AttemptFailure::XNotPositive { .. }
    ));
}

/// Where the determinant vanishes identically the candidate's own value is tried; where the kernel
/// is wide its own x is.
#[test]
fn singular_pencils_and_wide_kernels_are_certified_at_the_candidate() {
    let singular = pencil(&[&["1", "-1"], &["-1", "1"]], &[&["0", "0"], &["0", "0"]]);
    let wide = pencil(&[&["-1", "0"], &["0", "-1"]], I2);
    for (p, c) in [
        (singular, candidate(0.37, &[0.5, 0.5])),
        (wide, candidate(1.0, &[0.25, 0.75])),
    ] {
        let claim = propose(&p, &Window::all(), &c).unwrap();
        let problem = Problem::new(Body::Pencil(p), Unknown::Lambda2, Window::all()).unwrap();
        assert!(check(&problem, &certificate(&problem, vec![claim])).is_ok());
    }
}

/// Found by the fuzz target `checker_against_forgeries` (2026-11-21): with slip of 1 alone the
/// kernel at lambda^2 = 0 is a plane, and y_2 = -y_3 >= 0 leaves the line x_0 = 4/3 x_1 of it. No
/// double is 4/3: the kernel within y_2 = 0 is taken.
#[test]
fn a_wide_kernel_that_meets_the_inequalities_in_a_face_is_certified() {
    let a: &[&[&str]] = &[
        &["0"; 4],
        &["0"; 4],
        &["3", "-4", "1", "-1"],
        &["-3", "4", "1", "-2"],
    ];
    let b: &[&[&str]] = &[
        &["-4", "1", "-2", "4"],
        &["4", "-4", "-4", "-4"],
        &["-4"; 4],
        &["-4"; 4],
    ];
    let p = pencil(a, b);
    let p = Pencil::new(p.a().clone(), p.b().clone(), vec![0]).unwrap();
    for digits in [1.3333333333333333, 1.333333] {
        let claim = propose(
            &p,
            &Window::all(),
            &candidate(0.0, &[digits, 1.0, 0.0, 0.0]),
        )
        .unwrap();
        assert!(
            matches!(&claim, Claim::ExactSolution(c) if c.support == [1] && c.biactive == [2, 3])
        );
        let problem =
            Problem::new(Body::Pencil(p.clone()), Unknown::Lambda2, Window::all()).unwrap();
        assert!(check(&problem, &certificate(&problem, vec![claim])).is_ok());
    }
    assert!(matches!(
        failure(&p, &candidate(0.0, &[1.25, 1.0, 0.0, 0.0])),
        AttemptFailure::YNegative { .. }
    ));
}

/// Found by a campaign (seed 21, `free-anywhere` 403, 2026-11-21): at mu = 1 the kernel is a plane,
/// and of the polynomials of its basis one vanishes at 1 without being zero. It was taken for the
/// free coordinate, and x came out as zero.
#[test]
fn a_polynomial_that_vanishes_at_the_value_is_no_free_coordinate() {
    let p = pencil(
        &[&["0", "1", "0"], &["0", "-1", "1"], &["0"; 3]],
        &[&["-1", "-1", "0"], &["0", "1", "-1"], &["1", "0", "0"]],
    );
    let p = Pencil::new(p.a().clone(), p.b().clone(), vec![0, 2]).unwrap();
    for x in [[0.0, 1.0, 0.0], [0.0, 0.25, -1.0]] {
        let claim = propose(&p, &Window::all(), &candidate(1.0, &x)).unwrap();
        let problem = Problem::new(Body::Pencil(p.clone()), Unknown::Mu, Window::all()).unwrap();
        assert!(check(&problem, &certificate(&problem, vec![claim])).is_ok());
    }
    assert!(matches!(
        failure(&p, &candidate(1.0, &[0.5, 1.0, 0.0])),
        AttemptFailure::TooFar { .. }
    ));
}

/// A support singular at every t with y_2 = -y_3 = (3t - 1) x_0: only t = 1/3 is a solution, and no
/// double is 1/3.
#[test]
fn the_only_value_of_a_singular_support_is_found() {
    let a: &[&[&str]] = &[
        &["1", "-1", "0", "0"],
        &["-1", "1", "0", "0"],
        &["-1", "0", "1", "0"],
        &["1", "0", "0", "1"],
    ];
    let b: &[&[&str]] = &[
        &["0"; 4],
        &["0"; 4],
        &["3", "0", "0", "0"],
        &["-3", "0", "0", "0"],
    ];
    let p = pencil(a, b);
    let claim = propose(
        &p,
        &Window::all(),
        &candidate(0.333333, &[0.5, 0.5, 0.0, 0.0]),
    )
    .unwrap();
    let problem = Problem::new(Body::Pencil(p.clone()), Unknown::Mu, Window::all()).unwrap();
    let accepted = check(&problem, &certificate(&problem, vec![claim])).unwrap();
    assert!(
        accepted.claims[0].value.contains(&parse("1/3").unwrap())
            && accepted.claims[0].value.is_point()
    );
    assert!(matches!(
        failure(&p, &candidate(0.3343, &[0.5, 0.5, 0.0, 0.0])),
        AttemptFailure::YNegative { .. }
    ));
}

/// Above the order for exact claims a box is made: -tridiag + t I of order 20, all slip.
#[test]
fn large_supports_are_enclosed_and_accepted() {
    let n = 20;
    let off = (1..n)
        .flat_map(|i| [(i, i - 1), (i - 1, i)])
        .map(|(i, j)| (i, j, parse("-1").unwrap()));
    let a = Sparse::from_entries(n, n, off);
    let p = Pencil::new(a, Sparse::identity(n), vec![]).unwrap();
    // Perron vector of the path graph: t = 2 cos(pi / (n + 1)), x_i = sin(i pi / (n + 1)).
    let angle = std::f64::consts::PI / (n + 1) as f64;
    let x: Vec<f64> = (1..=n).map(|i| (i as f64 * angle).sin()).collect();
    let claim = propose(&p, &Window::all(), &candidate(2.0 * angle.cos(), &x)).unwrap();
    assert!(matches!(&claim, Claim::EnclosedSolution(_)));
    let problem = Problem::new(Body::Pencil(p.clone()), Unknown::Lambda2, Window::all()).unwrap();
    let accepted = check(&problem, &certificate(&problem, vec![claim])).unwrap();
    let value = &accepted.claims[0].value;
    let off = (value.mid() - parse("1.977661652450257").unwrap()).abs();
    assert!(
        off < parse("1e-15").unwrap() && value.width() < parse("1e-17").unwrap(),
        "{off}"
    );
    assert!(propose(&p, &Window::all(), &candidate(1.5, &x)).is_err());
}
