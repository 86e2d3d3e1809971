//! What the prover must refute, and what it must never refute.

use super::*;
use crate::exact::{Rational, Sparse, from_f64, rational, whole};
use crate::model::{Pencil, Window};

fn refutes(pencil: &Pencil, mask: u64, t: (f64, f64)) -> bool {
    let floats = Floats::of(pencil, &Window::all());
    let s = floats.scale.mantissa * f64::from(floats.scale.exponent).exp2();
    let mut prover = Prover::default();
    prover.load(&floats, mask);
    prover.refutes(&floats, t.0 / (t.0 + s), t.1 / (t.1 + s))
}

/// The fold of `spec/errata.md`: at t = 2 x = (2, 1), at t = 3 x = (3, 2), on the full support.
#[test]
fn a_piece_with_a_solution_is_never_refuted() {
    let p = Pencil::new(Sparse::from_ints(&[&[1, -6], &[2, -6]]), Sparse::identity(2), vec![]).unwrap();
    for width in [0.0, 1e-12, 1e-3, 0.4] {
        assert!(!refutes(&p, 3, (2.0, 2.0 + width)) && !refutes(&p, 3, (3.0 - width, 3.0)));
    }
    // y_1 = 2 x_0 there; with -2 it is refuted.
    let p = |y: i64| Pencil::new(Sparse::from_ints(&[&[-2, -6], &[y, -6]]), Sparse::identity(2), vec![]).unwrap();
    assert!(!refutes(&p(2), 1, (1.9, 2.1)) && refutes(&p(-2), 1, (1.9, 2.1)));
    // x = (1, -1) at t = 2.
    let mixed = Pencil::new(Sparse::from_ints(&[&[-1, 1], &[1, -1]]), Sparse::identity(2), vec![]).unwrap();
    assert!(refutes(&mixed, 3, (1.9, 2.1)) && !refutes(&mixed, 3, (0.0, 0.1)));
}

/// [[-1, 0], [y, -3]] + tI: at t = 1 x = (1, 0) solves it exactly if y >= 0.
#[test]
fn the_sign_of_y_decides_down_to_rounding() {
    let p = |y: Rational| {
        let a = Sparse::from_entries(2, 2, [(0, 0, whole(-1)), (1, 0, y), (1, 1, whole(-3))]);
        Pencil::new(a, Sparse::identity(2), vec![]).unwrap()
    };
    let near = (1.0 - 1e-12, 1.0 + 1e-12);
    assert!(refutes(&p(rational(-1, 1000)), 1, near));
    assert!(!refutes(&p(rational(1, 1000)), 1, near));
    assert!(!refutes(&p(whole(0)), 1, near));
    // Too small for doubles: not refuted, so left to exact arithmetic.
    assert!(!refutes(&p(rational(-1, 1_000_000_000_000_000)), 1, (1.0 - 1e-3, 1.0 + 1e-3)));
}

/// Free variables with B_ff = I: at the root of -1 + t - (2 + t)/(4 + t) on the support {1}
/// x_f < 0, so a row with +x_f gives y_2 < 0 and one with -x_f a solution.
#[test]
fn free_variables_are_bounded_not_ignored() {
    let p = |sign: i64| {
        let a = Sparse::from_ints(&[&[4, 2, 0], &[1, -1, 0], &[sign, 0, 3]]);
        Pencil::new(a, Sparse::from_ints(&[&[1, 1, 0], &[0, 1, 0], &[0, 0, 1]]), vec![0]).unwrap()
    };
    let root = f64::sqrt(7.0) - 1.0; // t^2 + 2 t - 6 = 0
    let near = (root - 1e-13, root + 1e-13);
    assert!(refutes(&p(1), 1, near) && !refutes(&p(-1), 1, near));
    assert!(!refutes(&p(1), 1, (0.0, 50.0))); // N_ff varies too much: no bound, no proof
    assert!(!refutes(&p(1), 0, near)); // free variables alone have no sign
}

/// Digits from -9 to 9 (Knuth's MMIX generator).
fn digits() -> impl FnMut() -> i64 {
    let mut state = 1u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as i64 % 19 - 9
    }
}

/// Solutions on the support {1} of pencils with one free variable, in wide pieces around them:
/// often only what the free variable may contribute holds a false proof back.
#[test]
fn the_residual_on_free_variables_counts() {
    let mut digit = digits();
    let mut solutions = 0;
    for _ in 0..3000 {
        let [a, b]: [[[i64; 3]; 3]; 2] = [0, 1].map(|_| [0, 1, 2].map(|_| [0, 1, 2].map(|_| digit())));
        let at = |t: f64, i: usize, j: usize| a[i][j] as f64 + t * b[i][j] as f64;
        let det = |t: f64| at(t, 0, 0) * at(t, 1, 1) - at(t, 0, 1) * at(t, 1, 0);
        let Some(left) = (0..60).map(|k| f64::from(k) / 20.0).find(|&t| det(t) * det(t + 0.05) < 0.0) else { continue };
        let (mut low, mut high) = (left, left + 0.05);
        for _ in 0..60 {
            let mid = 0.5 * (low + high);
            if det(mid) * det(left) > 0.0 { low = mid } else { high = mid }
        }
        let x_f = -at(low, 0, 1) / at(low, 0, 0);
        if (at(low, 2, 0) * x_f + at(low, 2, 1)).is_nan() || at(low, 2, 0) * x_f + at(low, 2, 1) < 0.01 {
            continue;
        }
        solutions += 1;
        let rows = |m: &[[i64; 3]; 3]| Sparse::from_ints(&[&m[0], &m[1], &m[2]]);
        let p = Pencil::new(rows(&a), rows(&b), vec![0]).unwrap();
        for k in 1..40 {
            let (near, far) = (0.001, f64::from(k) * 0.02);
            assert!(!refutes(&p, 1, (low - near, low + far)) && !refutes(&p, 1, (low - far.min(low), low + near)), "{a:?} {b:?}");
        }
    }
    assert!(solutions > 100, "{solutions}");
}

/// y_4 = 0 exactly, two columns parallel up to 2^-24: rounding moves y_4 by far more than a unit
/// in the last place, and only the error bound says that its sign is not known.
#[test]
fn rounding_errors_are_never_taken_for_signs() {
    let t = from_f64(1.371_903_867).unwrap(); // s, where its exponent is 0: tau = 1/2, a double
    let mut next = digits();
    let mut digit = || whole(next());
    let mut tried = 0;
    for _ in 0..1500 {
        let [mut a, mut b]: [Vec<Vec<Rational>>; 2] = [0, 1].map(|_| (0..5).map(|_| (0..5).map(|_| digit()).collect()).collect());
        for m in [&mut a, &mut b] {
            (0..3).for_each(|i| m[i][2] = &m[i][1] + &m[i][2] * rational(1, 1 << 24));
        }
        for i in 0..5 {
            // x = (1, 1, 1): column 0 balances the others, y_3 = 5, y_4 = 0.
            let rest: Rational = (0..3).map(|j| &a[i][j] + &t * &b[i][j]).sum();
            a[i][0] += whole([0, 0, 0, 5, 0][i]) - rest;
        }
        let sparse = |m: &[Vec<Rational>]| Sparse::from_entries(5, 5, (0..25).map(|k| (k / 5, k % 5, m[k / 5][k % 5].clone())));
        let floats = Floats::of(&Pencil::new(sparse(&a), sparse(&b), vec![]).unwrap(), &Window::all());
        if floats.scale.exponent == 0 {
            tried += 1;
            let mut prover = Prover::default();
            prover.load(&floats, 7);
            assert!(!prover.refutes(&floats, 0.5, 0.5), "{a:?} {b:?}");
        }
    }
    assert!(tried > 100, "{tried}");
}
