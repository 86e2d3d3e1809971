//! Anchors of a condensation: centres along the unknown, and about each the Taylor polynomials of
//! W = F^-1 T_fs and V = F^-1 T_sf', rounded, with the condensed pencil they give. What the
//! polynomials leave out enters the enclosure squared (see `check::cover::condensed`).

use crate::search::complete::pieces::blocks::{Blocks, times};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::pieces::view::{Expansion, row_factor};
use mceip_check::certificate::{Anchor, IntegerMatrix};
use mceip_exact::{Rational, from_f64, to_f64, truncated};
use mceip_model::Pencil;
use mceip_model::file::Number;

/// How an anchor is expanded: degree of W and V, and the bits of their largest entries. What W's
/// rounding costs enters to first order (times V), what the degree leaves out enters squared.
#[derive(Clone, Copy)]
pub(crate) struct Precision {
    degree: usize,
    right_bits: i32,
    left_bits: i32,
}

/// F does not depend on the unknown: W is a constant.
pub(crate) const CONSTANT: Precision = Precision {
    degree: 0,
    right_bits: 56,
    left_bits: 24,
};

/// For regions far from solutions: the margins of their witnesses are wide.
pub(crate) const COARSE: Precision = Precision {
    degree: 2,
    right_bits: 36,
    left_bits: 24,
};

/// About a solution, used within [`NEAR`] of it.
pub(crate) const FINE: Precision = Precision {
    degree: 2,
    right_bits: 56,
    left_bits: 30,
};

/// Bits that each degree needs less.
const BITS_PER_DEGREE: i32 = 2;

/// Distance from a centre up to which it is used, relative to center + smallest eigenvalue of
/// (K_ff, M_ff).
const REACH: f64 = 0.3;

/// Anchors at most: beyond that the window is left open above.
const MAX_ANCHORS: usize = 64;

/// Centres and the value up to which each is used; one for a pencil whose F does not depend on t.
pub(crate) fn centers(base: f64, mut low: f64, top: f64) -> (Vec<Rational>, Vec<f64>) {
    if base == 0.0 {
        return (vec![Rational::from_integer(0.into())], vec![f64::INFINITY]);
    }
    let (mut centers, mut ends) = (Vec::new(), Vec::new());
    // center - low = REACH (center + base), high - center likewise.
    while centers.is_empty() || (low < top && centers.len() < MAX_ANCHORS) {
        let center = (low + REACH * base) / (1.0 - REACH);
        let high = center + REACH * (center + base);
        centers.push(from_f64(center).unwrap_or_default());
        ends.push(high);
        low = high;
    }
    (centers, ends)
}

/// The Taylor polynomials about a centre, rounded, and the condensed pencil they give.
pub(crate) fn expand(
    pencil: &Pencil,
    blocks: &Blocks,
    center: &Rational,
    bounds: [f64; 2],
    precision: Precision,
) -> Option<(Anchor, Expansion)> {
    let c = to_f64(center);
    let f = blocks.stiffness.combine(c, &blocks.mass, 0.0).cholesky()?;
    let degree = |side: &[Vec<Vec<f64>>; 2]| match (
        blocks.mass_is_zero,
        side[1].iter().flatten().all(|v| *v == 0.0),
    ) {
        (true, true) => 0,
        (true, false) => 1,
        (false, _) => precision.degree,
    };
    let side = |given: &[Vec<Vec<f64>>; 2], bits: i32| -> Vec<(IntegerMatrix, Vec<Vec<f64>>)> {
        let mut list: Vec<(IntegerMatrix, Vec<Vec<f64>>)> = Vec::new();
        for k in 0..=degree(given) {
            // F_c W_k = [k = 0] C_c + [k = 1] C_b - F_b W_(k-1)
            let mut columns: Vec<Vec<f64>> = (0..blocks.slip.len())
                .map(|j| {
                    let mut b: Vec<f64> = match k {
                        0 => given[0][j]
                            .iter()
                            .zip(&given[1][j])
                            .map(|(a, b)| a + c * b)
                            .collect(),
                        1 => given[1][j].clone(),
                        _ => vec![0.0; blocks.free.len()],
                    };
                    if let Some((_, before)) = list.last() {
                        b.iter_mut()
                            .zip(times(&blocks.ff[1], &before[j]))
                            .for_each(|(b, p)| *b -= p);
                    }
                    b
                })
                .collect();
            f.solve_all(&mut columns);
            list.push(round(columns, bits - BITS_PER_DEGREE * k as i32));
        }
        list
    };
    let (right, left) = (
        side(&blocks.fs, precision.right_bits),
        side(&blocks.sf, precision.left_bits),
    );
    let only = |list: &[(IntegerMatrix, Vec<Vec<f64>>)]| {
        list.iter().map(|(_, w)| w.clone()).collect::<Vec<_>>()
    };
    let expansion = expansion(pencil, blocks, c, bounds, &only(&right), &only(&left));
    let matrices =
        |list: Vec<(IntegerMatrix, Vec<Vec<f64>>)>| list.into_iter().map(|(m, _)| m).collect();
    Some((
        Anchor {
            center: Number(center.clone()),
            reversed: false,
            right: matrices(right),
            left: matrices(left),
        },
        expansion,
    ))
}

/// Z_k, and the norms of the residuals, as the checker will compute them.
pub(crate) fn expansion(
    pencil: &Pencil,
    blocks: &Blocks,
    c: f64,
    bounds: [f64; 2],
    right: &[Vec<Vec<f64>>],
    left: &[Vec<Vec<f64>>],
) -> Expansion {
    let n = blocks.slip.len();
    let residual = |given: &[Vec<Vec<f64>>; 2], list: &[Vec<Vec<f64>>]| -> Vec<Vec<Vec<f64>>> {
        let mut out = vec![vec![vec![0.0; blocks.free.len()]; n]; (list.len() + 1).max(2)];
        for j in 0..n {
            out[0][j] = given[0][j]
                .iter()
                .zip(&given[1][j])
                .map(|(a, b)| a + c * b)
                .collect();
            out[1][j].clone_from(&given[1][j]);
            for (k, w) in list.iter().enumerate() {
                let mass = times(&blocks.ff[1], &w[j]);
                let stiff = times(&blocks.ff[0], &w[j]);
                out[k][j]
                    .iter_mut()
                    .zip(stiff.iter().zip(&mass))
                    .for_each(|(r, (s, m))| *r -= s + c * m);
                out[k + 1][j]
                    .iter_mut()
                    .zip(&mass)
                    .for_each(|(r, m)| *r -= m);
            }
        }
        out
    };
    let (r, l) = (residual(&blocks.fs, right), residual(&blocks.sf, left));
    let row = |i: usize| to_f64(&row_factor(pencil, blocks.slip[i]));
    let mut z = vec![
        vec![vec![0.0; n]; n];
        1 + right
            .len()
            .max((left.len() + r.len()).saturating_sub(2))
            .max(1)
    ];
    for i in 0..n {
        for j in 0..n {
            let (p, q) = (blocks.slip[i], blocks.slip[j]);
            let (a, b) = (to_f64(&pencil.a().get(p, q)), to_f64(&pencil.b().get(p, q)));
            z[0][i][j] += a + c * b;
            z[1][i][j] += b;
            for (k, w) in right.iter().enumerate() {
                z[k][i][j] -= dot(&blocks.sf[0][i], &w[j]) + c * dot(&blocks.sf[1][i], &w[j]);
                z[k + 1][i][j] -= dot(&blocks.sf[1][i], &w[j]);
            }
            for (k, v) in left.iter().enumerate() {
                for (m, r_m) in r.iter().enumerate().skip(right.len()) {
                    z[k + m][i][j] -= dot(&v[i], &r_m[j]);
                }
            }
        }
    }
    z.iter_mut().for_each(|m| {
        m.iter_mut()
            .enumerate()
            .for_each(|(i, values)| values.iter_mut().for_each(|v| *v *= row(i)))
    });
    // What is zero but for rounding is zero in exact arithmetic: T is linear where F and the free
    // rows are constant.
    if blocks.mass_is_zero && blocks.fs[1].iter().flatten().all(|v| *v == 0.0) {
        z.truncate(2);
    }
    let norms = |list: &[Vec<Vec<f64>>], scaled: bool| -> Vec<Vec<f64>> {
        list.iter()
            .map(|m| {
                m.iter()
                    .enumerate()
                    .map(|(j, col)| dot(col, col).sqrt() * if scaled { row(j) } else { 1.0 })
                    .collect()
            })
            .collect()
    };
    Expansion {
        center: c,
        z,
        left: norms(&l, true),
        right: norms(&r, false),
        weight: vec![1.0 / bounds[0]; n],
        gain: bounds[1] / bounds[0],
        v: norms(left, true),
        rounding: norms(&r[..right.len()], false),
        caution: 1.0,
        free: right.to_vec(),
        reversed: false,
    }
}

/// Columns rounded to integers over a power of two: the matrix by rows, and the rounded columns.
fn round(columns: Vec<Vec<f64>>, bits: i32) -> (IntegerMatrix, Vec<Vec<f64>>) {
    let largest = columns
        .iter()
        .flatten()
        .fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
    let exponent = (bits - largest.log2().ceil() as i32).clamp(0, 900);
    let unit = f64::from(exponent).exp2();
    let rounded: Vec<Vec<f64>> = columns
        .iter()
        .map(|c| c.iter().map(|v| (v * unit).round() / unit).collect())
        .collect();
    let free = columns.first().map_or(0, Vec::len);
    let integer = |v: f64| truncated((v * unit).round()).unwrap_or_default();
    let rows = (0..free)
        .map(|i| rounded.iter().map(|c| integer(c[i])).collect())
        .collect();
    (
        IntegerMatrix {
            exponent: exponent.unsigned_abs(),
            rows,
        },
        rounded,
    )
}

/// Distance from a solution up to which its own anchor is used, relative to value + lowest
/// frequency.
pub(crate) const NEAR: f64 = 0.03;
