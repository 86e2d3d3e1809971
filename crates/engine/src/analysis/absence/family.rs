//! K*, M* as an integer family in s and m, split into free and slip variables.

use mceip_exact::{
    Integer, Rational, Sparse, common_denominator, from_f64, positive_definite, to_f64,
};
use mceip_mcp::linear::definite_eigenvalues;
use mceip_model::Pencil;
use num_traits::{One, Signed};

/// Bits beyond the common denominator, so that bounds of eigenvalues can be integers.
const GUARD_BITS: u32 = 40;

/// A sparse integer matrix.
#[derive(Debug, Clone)]
pub(super) struct Fixed {
    pub(super) rows: Vec<Vec<(usize, Integer)>>,
    pub(super) cols: usize,
}

/// The blocks at one s: `free` F, `coupling` C, `slip` and `rows` (G_ss, G_sf) for k = 0, 1.
pub(super) struct Blocks {
    pub(super) free: Fixed,
    pub(super) coupling: Fixed,
    pub(super) slip: [Fixed; 2],
    pub(super) rows: [Fixed; 2],
}

/// The family, its units and sizes. All matrices share one denominator, which is dropped.
pub(super) struct Scaled {
    /// K0, tau M0, nu K1, nu tau M1 as integers.
    parts: [Sparse; 4],
    f: Vec<usize>,
    s: Vec<usize>,
    /// Lower bounds of lambda_min of K_ff and tau M_ff.
    sigma: [Integer; 2],
    /// t = tau s / (1 - s).
    pub(super) tau: Rational,
    /// mu = nu m / (1 - m).
    pub(super) nu: Rational,
    pub(super) free: usize,
    pub(super) slip: usize,
}

fn largest(m: &Sparse) -> f64 {
    m.entries()
        .map(|(_, _, v)| to_f64(v).abs())
        .fold(0.0, f64::max)
}

/// The power of two nearest to a positive double, 1 for anything else.
fn power(v: f64) -> Rational {
    let p = v.log2().round().exp2();
    from_f64(p)
        .ok()
        .filter(Rational::is_positive)
        .unwrap_or_else(Rational::one)
}

impl Scaled {
    /// `None` if lambda_min of K_ff or M_ff cannot be bounded.
    pub(super) fn new(stiffness: &Pencil, mass: &Pencil) -> Option<Scaled> {
        let tau = power(largest(stiffness.a()) / largest(mass.a()));
        let nu = power(
            largest(stiffness.a()) / largest(stiffness.b()).max(largest(mass.b()) * to_f64(&tau)),
        );
        let (f, s) = (stiffness.free().to_vec(), stiffness.slip());
        let zero = Sparse::zeros(stiffness.order(), stiffness.order());
        let parts = [
            (stiffness.a(), Rational::one()),
            (mass.a(), tau.clone()),
            (stiffness.b(), nu.clone()),
            (mass.b(), &nu * &tau),
        ];
        let parts = parts.map(|(m, factor)| zero.add_scaled(&factor, m));
        let scale = Rational::from_integer(common_denominator(
            parts.iter().flat_map(|m| m.entries().map(|(_, _, v)| v)),
        ));
        let scale = scale * Rational::from_integer(Integer::one() << GUARD_BITS);
        let parts = parts.map(|m| zero.add_scaled(&scale, &m));
        let (free, slip) = (f.len(), s.len());
        let sigma = if free == 0 {
            [Integer::one(), Integer::one()]
        } else {
            [
                smallest_eigenvalue(&parts[0].submatrix(&f, &f))?,
                smallest_eigenvalue(&parts[1].submatrix(&f, &f))?,
            ]
        };
        Some(Scaled {
            parts,
            f,
            s,
            sigma,
            tau,
            nu,
            free,
            slip,
        })
    }

    /// The blocks at s = index / 2^level, times 2^level.
    pub(super) fn at(&self, index: u64, level: u32) -> Blocks {
        let (on, off) = (
            Rational::from_integer(index.into()),
            Rational::from_integer(((1u64 << level) - index).into()),
        );
        let sum = |a: &Sparse, b: &Sparse, rows: &[usize], cols: &[usize]| {
            let zero = Sparse::zeros(rows.len(), cols.len());
            fixed(
                &zero
                    .add_scaled(&off, &a.submatrix(rows, cols))
                    .add_scaled(&on, &b.submatrix(rows, cols)),
            )
        };
        let [k0, m0, k1, m1] = &self.parts;
        let (f, s) = (&self.f[..], &self.s[..]);
        Blocks {
            free: sum(k0, m0, f, f),
            coupling: sum(k0, m0, f, s),
            slip: [sum(k0, m0, s, s), sum(k1, m1, s, s)],
            rows: [sum(k0, m0, s, f), sum(k1, m1, s, f)],
        }
    }

    /// A lower bound of lambda_min of the free block over [index, index + 1] / 2^level, in the
    /// units of [`Scaled::at`].
    pub(super) fn sigma(&self, index: u64, level: u32) -> Integer {
        let at = |i: u64| &self.sigma[0] * ((1u64 << level) - i) + &self.sigma[1] * i;
        at(index).min(at(index + 1)).max(Integer::one())
    }
}

fn fixed(m: &Sparse) -> Fixed {
    let rows = (0..m.rows())
        .map(|i| m.row(i).iter().map(|(j, v)| (*j, v.to_integer())).collect())
        .collect();
    Fixed {
        rows,
        cols: m.cols(),
    }
}

/// An integer sigma >= 1 with m - sigma I proved positive definite. m is scaled so that one exists
/// unless it is nearly singular.
fn smallest_eigenvalue(m: &Sparse) -> Option<Integer> {
    let n = m.rows();
    let dense: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| to_f64(&m.get(i, j))).collect())
        .collect();
    let unit: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    let estimate = *definite_eigenvalues(&dense, &unit)?.first()?;
    let sigma = from_f64((0.9 * estimate).floor()).ok()?;
    let shifted = m.add_scaled(&-&sigma, &Sparse::identity(n));
    (sigma >= Rational::one() && positive_definite(&shifted).is_ok()).then(|| sigma.to_integer())
}
