//! Over a short interval of s = t / (tau + t): the family condensed to the slip variables, as four
//! integer matrices and radii, so that boxes in (s, m) are judged at their four corners.
//!
//! With t = tau s/(1-s) and mu = nu m/(1-m) the family (1-m)(1-s) times K + t M + mu (K1 + t M1) is
//! bilinear in (s, m), so on a box it is a convex combination of its values at the corners. The
//! free rows (divided by 1-m) do not depend on m: F(s) x_f + C(s) x_s = 0. For any constant W, and
//! V affine in m, with R = C - F W and l = G_sf' - F V,
//!
//! ```text
//! G_ss - G_sf F^-1 C = [G_ss - G_sf W - V'R] - l'F^-1 R,
//! ```
//!
//! the bracket is bilinear and the rest at most |l_i||R_j| / sigma, sigma <= lambda_min(F).

use super::family::{Fixed, Scaled};
use mceip_exact::{Integer, from_f64};
use mceip_mcp::linear::solve;
use num_traits::{Signed, ToPrimitive};

/// Bits of the entries of a strip's matrices: sums of products with weights and corners fit 127
/// bits.
const ENTRY_BITS: u64 = 60;
/// Bits after the point of W and V.
const SHAPE_BITS: u32 = 44;

/// The condensed family over [s0, s1]: value = (1-m) `z[0]` + m `z[1]` at each end, radius
/// likewise.
pub(super) struct Strip {
    /// `z[k][e]` row by row: k = 0 without friction, 1 the part of friction; e = 0, 1 the ends of
    /// s.
    pub(super) z: [[Vec<i64>; 2]; 2],
    /// Radii for k = 0, 1, over the whole strip, rounding included.
    pub(super) radius: [Vec<i64>; 2],
    /// A radius as large as the matrices: nothing can be said before the strip is cut.
    pub(super) too_wide: bool,
}

/// Integer matrix, rows by columns.
type Matrix = Vec<Vec<Integer>>;

impl Strip {
    /// The strip over [s0, s1], in units of 2^-`level` from `index`. `None` if doubles fail.
    pub(super) fn new(family: &Scaled, index: u64, level: u32) -> Option<Strip> {
        let shapes = Shapes::new(family, index, level)?;
        let n = family.slip;
        let mut z: [[Matrix; 2]; 2] = Default::default();
        // Squared column norms, largest over the ends.
        let mut worst_r = vec![Integer::default(); n];
        let mut worst_l = [vec![Integer::default(); n], vec![Integer::default(); n]];
        for e in 0..2 {
            let at = family.at(index + e as u64, level);
            // All in units of 2^-SHAPE_BITS: R = C - F W.
            let r = shapes.residual(&at.free, &at.coupling, &shapes.w);
            grow(&mut worst_r, &r, n);
            for k in 0..2 {
                let (ss, sf) = (&at.slip[k], &at.rows[k]);
                let l = shapes.residual(&at.free, &transposed(sf, n, family.free), &shapes.v[k]);
                grow(&mut worst_l[k], &l, n);
                z[k][e] = shapes.bracket(ss, sf, &r, k);
            }
        }
        let sigma = family.sigma(index, level);
        let norm = |square: &Integer| square.sqrt() + 1; // an upper bound of the norm
        let remainder = |k: usize, i: usize, j: usize| -> Integer {
            if family.free == 0 {
                return Integer::default();
            }
            // Units: l and R of 2^-SHAPE_BITS each; the bracket's are 2^-(2 SHAPE_BITS).
            norm(&worst_l[k][i]) * norm(&worst_r[j]) / &sigma + 1
        };
        // One power of two takes the largest entry to ENTRY_BITS.
        let bits = z
            .iter()
            .flatten()
            .flatten()
            .flatten()
            .map(Integer::bits)
            .max()
            .unwrap_or(0);
        let drop = bits.saturating_sub(ENTRY_BITS);
        let short = |v: &Integer| (v >> drop).to_i64();
        let mut strip = Strip {
            z: Default::default(),
            radius: [vec![0; n * n], vec![0; n * n]],
            too_wide: false,
        };
        for k in 0..2 {
            for e in 0..2 {
                strip.z[k][e] = z[k][e].iter().flatten().map(short).collect::<Option<_>>()?;
            }
            for i in 0..n {
                for j in 0..n {
                    let rounding = i64::from(drop > 0);
                    let r = remainder(k, i, j);
                    match (&r >> drop).to_i64().filter(|v| *v < 1 << ENTRY_BITS) {
                        Some(v) => {
                            strip.radius[k][i * n + j] = v + i64::from(r.is_positive()) + rounding
                        }
                        None => strip.too_wide = true,
                    }
                }
            }
        }
        Some(strip)
    }
}

/// W, V0, V1 in integers of 2^-SHAPE_BITS; free rows by slip columns.
struct Shapes {
    w: Matrix,
    v: [Matrix; 2],
}

impl Shapes {
    /// From the middle of the interval, in doubles: any values are right, good ones make R and l
    /// small.
    fn new(family: &Scaled, index: u64, level: u32) -> Option<Shapes> {
        if family.free == 0 {
            return Some(Shapes {
                w: Vec::new(),
                v: [Vec::new(), Vec::new()],
            });
        }
        let middle = family.at(2 * index + 1, level + 1);
        let real = |m: &Fixed| -> Vec<Vec<f64>> {
            let mut rows = vec![vec![0.0; m.cols]; m.rows.len()];
            m.rows.iter().enumerate().for_each(|(i, r)| {
                r.iter()
                    .for_each(|(j, v)| rows[i][*j] = v.to_f64().unwrap_or(f64::NAN))
            });
            rows
        };
        let f = real(&middle.free);
        let columns = |m: Vec<Vec<f64>>| -> Vec<Vec<f64>> {
            (0..family.slip)
                .map(|j| m.iter().map(|r| r[j]).collect())
                .collect()
        };
        let right: Vec<Vec<f64>> = columns(real(&middle.coupling))
            .into_iter()
            .chain(real(&middle.rows[0]))
            .chain(real(&middle.rows[1]))
            .collect();
        let x = solve(&f, &right)?;
        let fixed = |from: usize| -> Option<Matrix> {
            let unit = f64::from(SHAPE_BITS).exp2();
            (0..family.free)
                .map(|i| {
                    (0..family.slip)
                        .map(|j| Some(from_f64((x[from + j][i] * unit).round()).ok()?.to_integer()))
                        .collect()
                })
                .collect()
        };
        Some(Shapes {
            w: fixed(0)?,
            v: [fixed(family.slip)?, fixed(2 * family.slip)?],
        })
    }

    /// 2^SHAPE_BITS C - F W.
    fn residual(&self, f: &Fixed, c: &Fixed, w: &Matrix) -> Matrix {
        let Some(n) = w.first().map(Vec::len) else {
            return Vec::new();
        };
        let row = |i: usize| {
            let mut out = vec![Integer::default(); n];
            c.rows[i]
                .iter()
                .for_each(|(j, v)| out[*j] = v << SHAPE_BITS);
            for (k, v) in &f.rows[i] {
                (0..n).for_each(|j| out[j] -= v * &w[*k][j]);
            }
            out
        };
        (0..f.rows.len()).map(row).collect()
    }

    /// G_ss - G_sf W - V'R in units of 2^-(2 SHAPE_BITS).
    fn bracket(&self, ss: &Fixed, sf: &Fixed, r: &Matrix, k: usize) -> Matrix {
        let n = ss.rows.len();
        let row = |i: usize| {
            let mut out = vec![Integer::default(); n];
            ss.rows[i]
                .iter()
                .for_each(|(j, v)| out[*j] = v << (2 * SHAPE_BITS));
            for (f, v) in &sf.rows[i] {
                (0..n).for_each(|j| out[j] -= (v * &self.w[*f][j]) << SHAPE_BITS);
            }
            for (f, r) in r.iter().enumerate() {
                (0..n).for_each(|j| out[j] -= &self.v[k][f][i] * &r[j]);
            }
            out
        };
        (0..n).map(row).collect()
    }
}

fn transposed(m: &Fixed, slip: usize, free: usize) -> Fixed {
    let mut rows = vec![Vec::new(); free];
    m.rows
        .iter()
        .enumerate()
        .for_each(|(i, r)| r.iter().for_each(|(j, v)| rows[*j].push((i, v.clone()))));
    Fixed { rows, cols: slip }
}

/// Squared norms of the columns, where they exceed those so far.
fn grow(worst: &mut [Integer], m: &Matrix, columns: usize) {
    for j in 0..columns {
        let square: Integer = m.iter().map(|r| &r[j] * &r[j]).sum();
        if square > worst[j] {
            worst[j] = square;
        }
    }
}
