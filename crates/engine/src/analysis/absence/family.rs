//! K* and M* as an integer family in s and m, split into free and slip variables.
//!
//! With t = tau s/(1-s) and mu = nu m/(1-m),
//!
//!   (1-m) (1-s) (K0 + t M0 + mu (K1 + t M1)) = (1-m) G0(s) + m G1(s),
//!   G0(s) = (1-s) K0 + s tau M0,   G1(s) = (1-s) nu K1 + s nu tau M1.
//!
//! All four matrices are multiplied by one common factor that makes them integers, and tau and nu
//! are powers of two of the size of the matrices' quotients. Input: the pencils (K0, K1) and (M0,
//! M1). Output: the blocks of G0 and G1 at an s, and a lower bound of the smallest eigenvalue of
//! the free block. Called by the other files of this folder.

use crate::dense::rounded;
use mceip_exact::{
    Integer, Rational, Sparse, common_denominator, from_f64, positive_definite, to_f64,
};
use mceip_mcp::linear::definite_eigenvalues;
use mceip_model::Pencil;
use num_traits::{One, Signed};

/// Bits beyond the common denominator, so that bounds of eigenvalues can be integers.
const GUARD_BITS: u32 = 40;

/// A sparse integer matrix: (column, entry) by rows.
#[derive(Debug, Clone)]
pub(super) struct IntegerMatrix {
    pub(super) rows: Vec<Vec<(usize, Integer)>>,
    pub(super) cols: usize,
}

/// The blocks of G0 and G1 at one s. The free rows are those of G0 alone: K1 and M1 have none.
pub(super) struct Blocks {
    pub(super) free_free: IntegerMatrix,
    pub(super) free_slip: IntegerMatrix,
    /// Of G0 and of G1.
    pub(super) slip_slip: [IntegerMatrix; 2],
    /// Of G0 and of G1.
    pub(super) slip_free: [IntegerMatrix; 2],
}

/// The family, its units and sizes. All matrices share one factor, which is dropped.
pub(super) struct Scaled {
    /// K0, tau M0, nu K1, nu tau M1 as integers.
    parts: [Sparse; 4],
    free: Vec<usize>,
    slip: Vec<usize>,
    /// Lower bounds of lambda_min of K_ff and tau M_ff.
    sigma: [Integer; 2],
    /// t = tau s / (1 - s).
    pub(super) tau: Rational,
    /// mu = nu m / (1 - m).
    pub(super) nu: Rational,
}

impl Scaled {
    /// `None` if lambda_min of K_ff or M_ff cannot be bounded.
    pub(super) fn new(stiffness: &Pencil, mass: &Pencil) -> Option<Scaled> {
        let size_k0 = largest(stiffness.a());
        let size_k1 = largest(stiffness.b());
        let tau = nearest_power(size_k0 / largest(mass.a()));
        let size_tau_m1 = largest(mass.b()) * to_f64(&tau);
        let nu = nearest_power(size_k0 / size_k1.max(size_tau_m1));

        let parts = integral([
            times(stiffness.a(), &Rational::one()),
            times(mass.a(), &tau),
            times(stiffness.b(), &nu),
            times(mass.b(), &(&nu * &tau)),
        ]);

        let free = stiffness.free().to_vec();
        let sigma = if free.is_empty() {
            [Integer::one(), Integer::one()]
        } else {
            [
                smallest_eigenvalue(&parts[0].submatrix(&free, &free))?,
                smallest_eigenvalue(&parts[1].submatrix(&free, &free))?,
            ]
        };

        Some(Scaled {
            parts,
            free,
            slip: stiffness.slip(),
            sigma,
            tau,
            nu,
        })
    }

    pub(super) fn free_count(&self) -> usize {
        self.free.len()
    }

    pub(super) fn slip_count(&self) -> usize {
        self.slip.len()
    }

    /// The blocks at s = index / 2^level, times 2^level.
    pub(super) fn at(&self, index: u64, level: u32) -> Blocks {
        let one_minus_s = Rational::from_integer(((1u64 << level) - index).into());
        let s = Rational::from_integer(index.into());

        let [k0, m0, k1, m1] = &self.parts;
        let g0 = times(k0, &one_minus_s).add_scaled(&s, m0);
        let g1 = times(k1, &one_minus_s).add_scaled(&s, m1);

        Blocks {
            free_free: block(&g0, &self.free, &self.free),
            free_slip: block(&g0, &self.free, &self.slip),
            slip_slip: [&g0, &g1].map(|g| block(g, &self.slip, &self.slip)),
            slip_free: [&g0, &g1].map(|g| block(g, &self.slip, &self.free)),
        }
    }

    /// A lower bound of lambda_min of the free block over [index, index + 1] / 2^level, in the
    /// units of [`Scaled::at`]: lambda_min is a concave function of s.
    pub(super) fn sigma(&self, index: u64, level: u32) -> Integer {
        let at_lower = self.sigma_at(index, level);
        let at_upper = self.sigma_at(index + 1, level);
        at_lower.min(at_upper).max(Integer::one())
    }

    fn sigma_at(&self, index: u64, level: u32) -> Integer {
        let [of_stiffness, of_mass] = &self.sigma;
        let one_minus_s = (1u64 << level) - index;
        of_stiffness * one_minus_s + of_mass * index
    }
}

/// The largest modulus of an entry.
fn largest(matrix: &Sparse) -> f64 {
    let sizes = matrix.entries().map(|(_, _, v)| to_f64(v).abs());
    sizes.fold(0.0, f64::max)
}

/// The power of two nearest to a positive double, 1 for anything else.
fn nearest_power(v: f64) -> Rational {
    let power = v.log2().round().exp2();
    match from_f64(power) {
        Ok(power) if power.is_positive() => power,
        _ => Rational::one(),
    }
}

/// `factor * matrix`.
fn times(matrix: &Sparse, factor: &Rational) -> Sparse {
    Sparse::zeros(matrix.rows(), matrix.cols()).add_scaled(factor, matrix)
}

/// The matrices times their common denominator and 2^GUARD_BITS.
fn integral(parts: [Sparse; 4]) -> [Sparse; 4] {
    let entries = parts.iter().flat_map(|m| m.entries().map(|(_, _, v)| v));
    let scale = common_denominator(entries) << GUARD_BITS;
    let scale = Rational::from_integer(scale);
    parts.map(|m| times(&m, &scale))
}

fn block(matrix: &Sparse, rows: &[usize], columns: &[usize]) -> IntegerMatrix {
    let block = matrix.submatrix(rows, columns);
    let mut integers = vec![Vec::new(); block.rows()];
    for (i, j, v) in block.entries() {
        integers[i].push((j, v.to_integer()));
    }

    IntegerMatrix {
        rows: integers,
        cols: block.cols(),
    }
}

/// An integer sigma >= 1 with m - sigma I proved positive definite, some 0.9 of the smallest
/// eigenvalue. m is scaled so that one exists unless it is nearly singular.
fn smallest_eigenvalue(m: &Sparse) -> Option<Integer> {
    let identity = Sparse::identity(m.rows());
    let eigenvalues = definite_eigenvalues(&rounded(m), &rounded(&identity))?;
    let estimate = *eigenvalues.first()?;

    let sigma = from_f64((0.9 * estimate).floor()).ok()?;
    let shifted = m.add_scaled(&-&sigma, &identity);
    if sigma < Rational::one() || positive_definite(&shifted).is_err() {
        return None;
    }
    Some(sigma.to_integer())
}
