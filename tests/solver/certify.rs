//! From candidates in doubles to claims.
//!
//! The truth is the checker and pencils worked by hand: what is certified must be accepted, and
//! what is close to a solution without being one must be refused for the right reason. The pencils
//! have entries in decimals, some too small for a double to see.
#![cfg(feature = "solver")]

use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{AcceptedClaim, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{AttemptFailure, propose};
use mceip_exact::{Sparse, parse, whole};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use num_traits::Signed;
use std::f64::consts::PI;

const IDENTITY_2: &[&[&str]] = &[&["1", "0"], &["0", "1"]];

/// A square matrix whose entries are written as decimals.
fn matrix(rows: &[&[&str]]) -> Sparse {
    let order = rows.len();
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, text) in row.iter().enumerate() {
            entries.push((i, j, parse(text).unwrap()));
        }
    }
    Sparse::from_entries(order, order, entries)
}

/// A pencil without free variables.
fn pencil(a: &[&[&str]], b: &[&[&str]]) -> Pencil {
    pencil_with_free(a, b, &[])
}

fn pencil_with_free(a: &[&[&str]], b: &[&[&str]], free: &[usize]) -> Pencil {
    Pencil::new(matrix(a), matrix(b), free.to_vec()).unwrap()
}

fn candidate(value: f64, x: &[f64]) -> Candidate {
    Candidate {
        value,
        x: x.to_vec(),
    }
}

/// What is claimed for a candidate, and what the checker made of the claim.
struct Certified {
    claim: Claim,
    accepted: AcceptedClaim,
}

/// Certifies a candidate and has the claim checked; fails if it is not accepted.
fn certify(pencil: &Pencil, unknown: Unknown, candidate: &Candidate) -> Certified {
    let claim = propose(pencil, &Window::all(), candidate).unwrap();

    let body = Body::Pencil(pencil.clone());
    let problem = Problem::new(body, unknown, Window::all()).unwrap();
    let certificate = Certificate::of_claims(&problem, vec![claim.clone()]);
    let mut accepted = check(&problem, &certificate).unwrap();

    Certified {
        claim,
        accepted: accepted.claims.remove(0),
    }
}

/// What the first support tried failed with.
fn first_failure(pencil: &Pencil, candidate: &Candidate) -> AttemptFailure {
    let mut refusal = propose(pencil, &Window::all(), candidate).unwrap_err();
    refusal.attempts.remove(0).failure
}

#[test]
fn six_digits_give_an_exact_claim_that_is_accepted() {
    let pencil = pencil(&[&["1", "-6"], &["2", "-6"]], IDENTITY_2);
    let six_digits = candidate(2.000001, &[0.666667, 0.333333]);

    let certified = certify(&pencil, Unknown::Lambda2, &six_digits);

    let Claim::ExactSolution(claim) = certified.claim else {
        panic!("{:?}", certified.claim)
    };
    assert_eq!(claim.support, [0, 1]);
    assert_eq!(claim.polynomial.len(), 2);
}

#[test]
fn near_misses_are_refused_for_the_right_reason() {
    let two_roots = pencil(&[&["1", "-6"], &["2", "-6"]], IDENTITY_2);

    let between_the_roots = candidate(2.5, &[0.6, 0.4]);
    let failure = first_failure(&two_roots, &between_the_roots);
    assert!(matches!(failure, AttemptFailure::NoRootNear { .. }));

    let with_another_vector = candidate(2.0, &[0.5, 0.5]);
    let failure = first_failure(&two_roots, &with_another_vector);
    assert!(matches!(failure, AttemptFailure::TooFar { .. }));

    let without_a_value = candidate(f64::NAN, &[0.5, 0.5]);
    let failure = first_failure(&two_roots, &without_a_value);
    assert!(matches!(failure, AttemptFailure::NotFinite));

    let with_zero_vector = candidate(2.0, &[0.0, 0.0]);
    let failure = first_failure(&two_roots, &with_zero_vector);
    assert!(matches!(failure, AttemptFailure::ZeroX));

    let with_short_vector = candidate(2.0, &[1.0]);
    let failure = first_failure(&two_roots, &with_short_vector);
    let wrong_length = AttemptFailure::WrongLength {
        expected: 2,
        got: 1,
    };
    assert_eq!(failure, wrong_length);

    // x = (1, 0) at t = 1 with y_1 = -1e-20: no float sees it.
    let negative = pencil(&[&["-1", "0"], &["-1e-20", "7"]], IDENTITY_2);
    let failure = first_failure(&negative, &candidate(1.0, &[1.0, 0.0]));
    assert_eq!(failure, AttemptFailure::YNegative { index: 1 });

    // At t = 1 the kernel is (1, -1): not positive.
    let opposed = pencil(&[&["0", "1"], &["1", "0"]], IDENTITY_2);
    let failure = first_failure(&opposed, &candidate(1.0, &[0.5, 0.5]));
    assert!(matches!(failure, AttemptFailure::XNotPositive { .. }));
}

/// Where the determinant vanishes identically the candidate's own value is tried; where the kernel
/// is wide its own x is.
#[test]
fn singular_pencils_and_wide_kernels_are_certified_at_the_candidate() {
    let singular = pencil(&[&["1", "-1"], &["-1", "1"]], &[&["0", "0"], &["0", "0"]]);
    certify(&singular, Unknown::Lambda2, &candidate(0.37, &[0.5, 0.5]));

    let wide = pencil(&[&["-1", "0"], &["0", "-1"]], IDENTITY_2);
    certify(&wide, Unknown::Lambda2, &candidate(1.0, &[0.25, 0.75]));
}

/// Found by the fuzz target `checker_against_forgeries` (2026-11-21): with slip of 1 alone the
/// kernel at lambda^2 = 0 is a plane, and y_2 = -y_3 >= 0 leaves the line x_0 = 4/3 x_1 of it. No
/// double is 4/3: the kernel within y_2 = 0 is taken.
#[test]
fn a_wide_kernel_that_meets_the_inequalities_in_a_face_is_certified() {
    let pencil = pencil_with_free(
        &[
            &["0"; 4],
            &["0"; 4],
            &["3", "-4", "1", "-1"],
            &["-3", "4", "1", "-2"],
        ],
        &[
            &["-4", "1", "-2", "4"],
            &["4", "-4", "-4", "-4"],
            &["-4"; 4],
            &["-4"; 4],
        ],
        &[0],
    );

    for four_thirds in [1.3333333333333333, 1.333333] {
        let candidate = candidate(0.0, &[four_thirds, 1.0, 0.0, 0.0]);
        let certified = certify(&pencil, Unknown::Lambda2, &candidate);
        let Claim::ExactSolution(claim) = certified.claim else {
            panic!("{:?}", certified.claim)
        };
        assert_eq!(claim.support, [1]);
        assert_eq!(claim.biactive, [2, 3]);
    }

    let off_the_line = candidate(0.0, &[1.25, 1.0, 0.0, 0.0]);
    let failure = first_failure(&pencil, &off_the_line);
    assert!(matches!(failure, AttemptFailure::YNegative { .. }));
}

/// Found by a campaign (seed 21, `free-anywhere` 403, 2026-11-21): at mu = 1 the kernel is a plane,
/// and of the polynomials of its basis one vanishes at 1 without being zero. It was taken for the
/// free coordinate, and x came out as zero.
#[test]
fn a_polynomial_that_vanishes_at_the_value_is_no_free_coordinate() {
    let pencil = pencil_with_free(
        &[&["0", "1", "0"], &["0", "-1", "1"], &["0"; 3]],
        &[&["-1", "-1", "0"], &["0", "1", "-1"], &["1", "0", "0"]],
        &[0, 2],
    );

    for x in [[0.0, 1.0, 0.0], [0.0, 0.25, -1.0]] {
        certify(&pencil, Unknown::Mu, &candidate(1.0, &x));
    }

    let off_the_plane = candidate(1.0, &[0.5, 1.0, 0.0]);
    let failure = first_failure(&pencil, &off_the_plane);
    assert!(matches!(failure, AttemptFailure::TooFar { .. }));
}

/// A support singular at every t with y_2 = -y_3 = (3t - 1) x_0: only t = 1/3 is a solution, and no
/// double is 1/3.
#[test]
fn the_only_value_of_a_singular_support_is_found() {
    let pencil = pencil(
        &[
            &["1", "-1", "0", "0"],
            &["-1", "1", "0", "0"],
            &["-1", "0", "1", "0"],
            &["1", "0", "0", "1"],
        ],
        &[
            &["0"; 4],
            &["0"; 4],
            &["3", "0", "0", "0"],
            &["-3", "0", "0", "0"],
        ],
    );

    let close = candidate(0.333333, &[0.5, 0.5, 0.0, 0.0]);
    let value = certify(&pencil, Unknown::Mu, &close).accepted.value;
    assert!(value.is_point());
    assert!(value.contains(&parse("1/3").unwrap()));

    let too_far = candidate(0.3343, &[0.5, 0.5, 0.0, 0.0]);
    let failure = first_failure(&pencil, &too_far);
    assert!(matches!(failure, AttemptFailure::YNegative { .. }));
}

/// The pencil -T + t I, where T is the adjacency matrix of a path.
fn path_graph(order: usize) -> Pencil {
    let mut adjacency = Vec::new();
    for i in 1..order {
        adjacency.push((i, i - 1, whole(-1)));
        adjacency.push((i - 1, i, whole(-1)));
    }
    let a = Sparse::from_entries(order, order, adjacency);
    Pencil::new(a, Sparse::identity(order), vec![]).unwrap()
}

/// Above the order for exact claims a box is made: -tridiag + t I of order 20, all slip.
#[test]
fn large_supports_are_enclosed_and_accepted() {
    let order = 20;
    let pencil = path_graph(order);

    // Perron vector of the path graph: t = 2 cos(pi / (n + 1)), x_i = sin(i pi / (n + 1)).
    let angle = PI / (order + 1) as f64;
    let perron_value = 2.0 * angle.cos();
    let perron_vector: Vec<f64> = (1..=order).map(|i| (i as f64 * angle).sin()).collect();

    let perron = candidate(perron_value, &perron_vector);
    let certified = certify(&pencil, Unknown::Lambda2, &perron);
    assert!(matches!(certified.claim, Claim::EnclosedSolution(_)));

    let value = certified.accepted.value;
    let error = (value.mid() - parse("1.977661652450257").unwrap()).abs();
    assert!(error < parse("1e-15").unwrap(), "{error}");
    assert!(value.width() < parse("1e-17").unwrap(), "{error}");

    let with_another_value = candidate(1.5, &perron_vector);
    assert!(propose(&pencil, &Window::all(), &with_another_value).is_err());
}
