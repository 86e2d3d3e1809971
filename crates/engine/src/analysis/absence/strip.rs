//! Over a short interval of s = t / (tau + t): the family condensed to the slip variables, as four
//! integer matrices and radii, so that boxes in (s, m) are judged at their four corners.
//!
//! The family of `family` is bilinear in (s, m), so on a box it is a convex combination of its
//! values at the corners. Its free rows (divided by 1-m) do not depend on m: F(s) x_f + C(s) x_s =
//! 0. For any constant W, and V affine in m, with R = C - F W and l = G_sf' - F V,
//!
//! ```text
//! G_ss - G_sf F^-1 C = [G_ss - G_sf W - V'R] - l'F^-1 R,
//! ```
//!
//! the bracket is bilinear and the rest at most |l_i||R_j| / sigma, sigma <= lambda_min(F). W and V
//! approximate F^-1 C and F^-1 G_sf' in the middle of the interval, so that R and l are small.
//!
//! Below, an index k = 0, 1 says which part of the family is meant (the one without friction, the
//! one of friction), and an index e = 0, 1 which end of the interval. Called by the cover in
//! `mod.rs`.

use super::family::{Blocks, IntegerMatrix, Scaled};
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
        let condensed = Condensed::new(family, index, level)?;
        // One power of two takes the largest entry to ENTRY_BITS.
        let dropped_bits = condensed.longest_entry().saturating_sub(ENTRY_BITS);

        let mut strip = Strip {
            z: Default::default(),
            radius: Default::default(),
            too_wide: false,
        };

        for k in 0..2 {
            for e in 0..2 {
                strip.z[k][e] = shortened(&condensed.bracket[k][e], dropped_bits)?;
            }
            match condensed.radius(k, dropped_bits) {
                Some(radius) => strip.radius[k] = radius,
                None => strip.too_wide = true,
            }
        }

        Some(strip)
    }
}

/// The entries without their last bits, row by row.
fn shortened(matrix: &Matrix, dropped_bits: u64) -> Option<Vec<i64>> {
    let entries = matrix.iter().flatten();
    entries.map(|v| (v >> dropped_bits).to_i64()).collect()
}

/// The bracket at both ends of an interval, and what bounds the rest between them. Units: those of
/// the family times 2^-(2 SHAPE_BITS) for the bracket, 2^-SHAPE_BITS for R and l.
struct Condensed {
    slip_count: usize,
    /// `bracket[k][e]`.
    bracket: [[Matrix; 2]; 2],
    /// The larger |R_j| of both ends, rounded up, for each column j.
    norm_r: Vec<Integer>,
    /// The larger |l_i| of both ends, rounded up, for each column i and both k.
    norm_l: [Vec<Integer>; 2],
    /// A lower bound of lambda_min(F) over the interval; `None` without free variables.
    sigma: Option<Integer>,
}

impl Condensed {
    fn new(family: &Scaled, index: u64, level: u32) -> Option<Condensed> {
        let shapes = Shapes::new(family, index, level)?;
        let n = family.slip_count();
        let mut bracket: [[Matrix; 2]; 2] = Default::default();
        let mut largest_r = vec![Integer::default(); n];
        let mut largest_l = [vec![Integer::default(); n], vec![Integer::default(); n]];

        for e in 0..2 {
            let blocks = family.at(index + e as u64, level);
            let r = residual(&blocks.free_free, &blocks.free_slip, &shapes.w);
            update_squares(&mut largest_r, &r);
            for k in 0..2 {
                let free_slip = transposed(&blocks.slip_free[k]);
                let l = residual(&blocks.free_free, &free_slip, &shapes.v[k]);
                update_squares(&mut largest_l[k], &l);
                bracket[k][e] = shapes.bracket(&blocks, &r, k);
            }
        }

        Some(Condensed {
            slip_count: n,
            bracket,
            norm_r: upper_roots(&largest_r),
            norm_l: largest_l.map(|squares| upper_roots(&squares)),
            sigma: (family.free_count() > 0).then(|| family.sigma(index, level)),
        })
    }

    /// Bits of the longest entry of the brackets.
    fn longest_entry(&self) -> u64 {
        let entries = self.bracket.iter().flatten().flatten().flatten();
        entries.map(Integer::bits).max().unwrap_or(0)
    }

    /// The bound of |l_i||R_j| / sigma for one k without its last bits, rounded up, and one more
    /// for the rounding of the bracket; `None` if it is longer than ENTRY_BITS.
    fn radius(&self, k: usize, dropped_bits: u64) -> Option<Vec<i64>> {
        let rounding_of_bracket = i64::from(dropped_bits > 0);
        let mut radius = Vec::with_capacity(self.slip_count * self.slip_count);
        for norm_l in &self.norm_l[k] {
            for norm_r in &self.norm_r {
                let remainder = match &self.sigma {
                    Some(sigma) => norm_l * norm_r / sigma + 1,
                    None => Integer::default(),
                };
                let short = (&remainder >> dropped_bits).to_i64()?;
                if short >= 1 << ENTRY_BITS {
                    return None;
                }
                let rounding = i64::from(remainder.is_positive());
                radius.push(short + rounding + rounding_of_bracket);
            }
        }

        Some(radius)
    }
}

/// Upper bounds of the square roots.
fn upper_roots(squares: &[Integer]) -> Vec<Integer> {
    squares.iter().map(|square| square.sqrt() + 1).collect()
}

/// Squared norms of the columns, where they exceed those so far.
fn update_squares(largest: &mut [Integer], matrix: &Matrix) {
    for (j, so_far) in largest.iter_mut().enumerate() {
        let square: Integer = matrix.iter().map(|row| &row[j] * &row[j]).sum();
        if square > *so_far {
            *so_far = square;
        }
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
        if family.free_count() == 0 {
            return Some(Shapes {
                w: Vec::new(),
                v: [Vec::new(), Vec::new()],
            });
        }

        let middle = family.at(2 * index + 1, level + 1);

        let mut right = dense(&transposed(&middle.free_slip));
        right.extend(dense(&middle.slip_free[0]));
        right.extend(dense(&middle.slip_free[1]));
        let columns = solve(&dense(&middle.free_free), &right)?;

        let n = family.slip_count();
        Some(Shapes {
            w: rounded(&columns[..n])?,
            v: [rounded(&columns[n..2 * n])?, rounded(&columns[2 * n..])?],
        })
    }

    /// G_ss - G_sf W - V'R in units of 2^-(2 SHAPE_BITS), for one k.
    fn bracket(&self, blocks: &Blocks, r: &Matrix, k: usize) -> Matrix {
        let slip_slip = &blocks.slip_slip[k].rows;
        let slip_free = &blocks.slip_free[k].rows;
        let n = slip_slip.len();
        let mut bracket = vec![vec![Integer::default(); n]; n];

        for (i, row) in bracket.iter_mut().enumerate() {
            for (j, g) in &slip_slip[i] {
                row[*j] = g << (2 * SHAPE_BITS);
            }
            for (f, g) in &slip_free[i] {
                for (entry, w) in row.iter_mut().zip(&self.w[*f]) {
                    *entry -= (g * w) << SHAPE_BITS;
                }
            }
            for (v_row, r_row) in self.v[k].iter().zip(r) {
                for (entry, r) in row.iter_mut().zip(r_row) {
                    *entry -= &v_row[i] * r;
                }
            }
        }

        bracket
    }
}

/// The matrix of the given columns, in integers of 2^-SHAPE_BITS, by rows.
fn rounded(columns: &[Vec<f64>]) -> Option<Matrix> {
    let unit = f64::from(SHAPE_BITS).exp2();
    let row_count = columns.first().map_or(0, Vec::len);
    let mut rows = vec![Vec::with_capacity(columns.len()); row_count];
    for column in columns {
        for (row, v) in rows.iter_mut().zip(column) {
            let scaled = from_f64((v * unit).round()).ok()?;
            row.push(scaled.to_integer());
        }
    }

    Some(rows)
}

/// 2^SHAPE_BITS C - F W; without free variables a matrix without rows.
fn residual(f: &IntegerMatrix, c: &IntegerMatrix, w: &Matrix) -> Matrix {
    let mut residual = vec![vec![Integer::default(); c.cols]; f.rows.len()];
    for (i, row) in residual.iter_mut().enumerate() {
        for (j, v) in &c.rows[i] {
            row[*j] = v << SHAPE_BITS;
        }
        for (k, v) in &f.rows[i] {
            for (entry, w) in row.iter_mut().zip(&w[*k]) {
                *entry -= v * w;
            }
        }
    }

    residual
}

fn transposed(matrix: &IntegerMatrix) -> IntegerMatrix {
    let mut rows = vec![Vec::new(); matrix.cols];
    for (i, row) in matrix.rows.iter().enumerate() {
        for (j, v) in row {
            rows[*j].push((i, v.clone()));
        }
    }

    IntegerMatrix {
        rows,
        cols: matrix.rows.len(),
    }
}

/// The matrix in doubles by rows, NaN beyond their range.
fn dense(matrix: &IntegerMatrix) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.cols]; matrix.rows.len()];
    for (i, row) in matrix.rows.iter().enumerate() {
        for (j, v) in row {
            rows[i][*j] = v.to_f64().unwrap_or(f64::NAN);
        }
    }

    rows
}
