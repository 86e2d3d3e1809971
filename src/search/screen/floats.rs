//! The pencil in doubles, scaled and condensed, with what its rounding is bounded by.

use super::bernstein::Scale;
use crate::exact::{Rational, Sparse, from_f64, schur_complement, to_f64};
use crate::model::{Pencil, Window};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// N(tau) = (1 - tau) A + tau s B, a positive multiple of A + tB at t = s tau / (1 - tau), by rows
/// scaled to entries of at most about 2. Variables in the order free, slip.
#[derive(Debug)]
pub(super) struct Floats {
    /// A, each entry within 2^-53 relative (2^-1074 absolute) of the exact one.
    pub(super) a: Vec<Vec<f64>>,
    /// s B, likewise.
    pub(super) b: Vec<Vec<f64>>,
    /// Number of free variables left: 0 where they were condensed.
    pub(super) free: usize,
    /// max |a_ij| + |b_ij|.
    pub(super) largest: f64,
    /// s.
    pub(super) scale: Scale,
    /// An interval of tau that contains the window.
    pub(super) window: (f64, f64),
    /// Were free variables eliminated exactly?
    pub(super) condensed: bool,
}

/// Mantissa of s: no simple fraction, so that roots at simple values (which small integer pencils
/// love) do not sit where pieces are halved.
const MANTISSA: f64 = 1.371_903_867;
/// Exponents of s are kept where s and its products with scaled entries are normal doubles.
const MAX_EXPONENT: i64 = 400;

impl Floats {
    pub(super) fn of(pencil: &Pencil, window: &Window) -> Floats {
        let (mut a, mut b, free, condensed) = match condense(pencil) {
            Some((a, b)) => (rows(&a), rows(&b), 0, !pencil.free().is_empty()),
            None => {
                let order: Vec<usize> = pencil.free().iter().copied().chain(pencil.slip()).collect();
                (rows(&pencil.a().submatrix(&order, &order)), rows(&pencil.b().submatrix(&order, &order)), pencil.free().len(), false)
            }
        };
        for (ra, rb) in a.iter_mut().zip(&mut b) {
            let unit = magnitude(ra.iter()).max(magnitude(rb.iter()));
            if let Some(e) = unit {
                ra.iter_mut().for_each(|v| *v = shifted(v, -e));
                rb.iter_mut().for_each(|v| *v = shifted(v, -e));
            }
        }
        let (size_a, size_b) = (magnitude(a.iter().flatten()), magnitude(b.iter().flatten()));
        let exponent = match (size_a, size_b) {
            (Some(x), Some(y)) => (x - y).clamp(-MAX_EXPONENT, MAX_EXPONENT),
            _ => 0,
        };
        // MANTISSA is finite; 2^exponent is rational.
        let s = shifted(&from_f64(MANTISSA).unwrap_or_else(|_| Rational::one()), exponent);
        let floats = |m: &[Vec<Rational>], factor: &Rational| -> Vec<Vec<f64>> {
            m.iter().map(|row| row.iter().map(|v| to_f64(&(v * factor))).collect()).collect()
        };
        let (fa, fb) = (floats(&a, &Rational::one()), floats(&b, &s));
        let largest = fa.iter().flatten().zip(fb.iter().flatten()).fold(0.0, |m: f64, (x, y)| m.max(x.abs() + y.abs()));
        let tau = |t: &Rational| to_f64(&(t / (t + &s)));
        let window = (tau(window.min()).next_down(), window.max().map_or(1.0, tau).next_up());
        let scale = Scale { mantissa: MANTISSA, exponent: exponent as i32 };
        Floats { a: fa, b: fb, free, largest, scale, window, condensed }
    }
}

/// (16): where B has no free rows and the free block of A is regular, x_f = -A_ff^-1 A_fs x_s
/// whatever t, so the Schur complements of A_ff in A and in B pose the same problem on the slip
/// variables: same t, x_s and y_s, and x_s is not zero. `None` where that does not apply.
fn condense(pencil: &Pencil) -> Option<(Sparse, Sparse)> {
    let (f, s) = (pencil.free(), pencil.slip());
    if f.is_empty() {
        return Some((pencil.a().clone(), pencil.b().clone()));
    }
    if s.is_empty() || f.iter().any(|&i| pencil.b().row(i).iter().any(|e| !e.1.is_zero())) {
        return None;
    }
    let complement = |m: &Sparse| {
        let (a_ff, a_fs) = (pencil.a().submatrix(f, f), pencil.a().submatrix(f, &s));
        schur_complement(&a_ff, &a_fs, &m.submatrix(&s, f), &m.submatrix(&s, &s)).ok()
    };
    Some((complement(pencil.a())?, complement(pencil.b())?))
}

fn rows(m: &Sparse) -> Vec<Vec<Rational>> {
    let dense = m.to_dense();
    (0..m.rows()).map(|i| dense.row(i).to_vec()).collect()
}

/// About log2 of the largest absolute value; `None` if all are zero.
fn magnitude<'r>(values: impl Iterator<Item = &'r Rational>) -> Option<i64> {
    values.filter(|v| !v.is_zero()).map(|v| v.numer().abs().bits() as i64 - v.denom().bits() as i64).max()
}

/// v 2^k exactly.
fn shifted(v: &Rational, k: i64) -> Rational {
    let power = Rational::from_integer(BigInt::one() << k.unsigned_abs());
    if k < 0 { v / power } else { v * power }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{rational, whole};

    #[test]
    fn condensing_is_exact_and_refused_where_it_would_not_be() {
        let a = Sparse::from_ints(&[&[4, 1], &[1, 5]]);
        let mu = Pencil::new(a.clone(), Sparse::from_ints(&[&[0, 0], &[-3, -2]]), vec![0]).unwrap();
        let (ca, cb) = condense(&mu).unwrap();
        assert_eq!((ca.get(0, 0), cb.get(0, 0)), (rational(19, 4), rational(-5, 4)));
        assert!(Floats::of(&mu, &Window::all()).condensed);
        let lambda2 = Pencil::new(a.clone(), Sparse::identity(2), vec![0]).unwrap();
        assert!(condense(&lambda2).is_none());
        let singular = Pencil::new(Sparse::from_ints(&[&[0, 1], &[1, 5]]), Sparse::from_ints(&[&[0, 0], &[1, 0]]), vec![0]).unwrap();
        assert!(condense(&singular).is_none());
        assert_eq!(Floats::of(&singular, &Window::all()).free, 1);
    }

    #[test]
    fn scaling_survives_absurd_sizes_and_the_window_is_enclosed() {
        let huge = Rational::from_integer(BigInt::one() << 5000u32);
        let a = Sparse::from_entries(2, 2, [(0, 0, huge.clone()), (1, 1, huge.recip())]);
        let b = Sparse::from_entries(2, 2, [(0, 1, whole(1)), (1, 0, whole(-7))]);
        let window = Window::new(rational(1, 3), Some(rational(2, 3))).unwrap();
        let f = Floats::of(&Pencil::new(a, b, vec![]).unwrap(), &window);
        assert!(f.a.iter().chain(&f.b).flatten().all(|v| v.is_finite()) && f.largest <= 8.0);
        let s = f.scale.mantissa * f64::from(f.scale.exponent).exp2();
        assert!(f.window.0 < 1.0 / 3.0 / (1.0 / 3.0 + s) && f.window.1 > 2.0 / 3.0 / (2.0 / 3.0 + s));
    }
}
