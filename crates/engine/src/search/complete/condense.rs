//! The free variables eliminated: the certificate's condensation and the f64 view of it.
//!
//! W and V are Taylor polynomials of F^-1 T_fs and F^-1 T_sf' about a few centres; what they leave
//! out enters the enclosure squared (see `check::cover::condensed`).

use super::error::CompleteError;
use super::skyline::{Skyline, dot};
use super::view::{Expansion, View, row_factor, scale};
use super::{massless, reverse};
use crate::tolerance::TAIL_START;
use mceip_check::certificate::{Anchor, Condensation, Factor, IntegerMatrix, Tail};
use mceip_exact::{Integer, Rational, Sparse, from_f64, to_f64, truncated};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};

/// How an anchor is expanded: degree of W and V, and the bits of their largest entries. What W's
/// rounding costs enters to first order (times V), what the degree leaves out enters squared.
#[derive(Clone, Copy)]
pub(super) struct Precision {
    degree: usize,
    right_bits: i32,
    left_bits: i32,
}

/// F does not depend on the unknown: W is a constant.
const CONSTANT: Precision = Precision {
    degree: 0,
    right_bits: 56,
    left_bits: 24,
};
/// For regions far from solutions: the margins of their witnesses are wide.
pub(super) const COARSE: Precision = Precision {
    degree: 2,
    right_bits: 36,
    left_bits: 24,
};
/// About a solution, used within [`NEAR`] of it.
pub(super) const FINE: Precision = Precision {
    degree: 2,
    right_bits: 56,
    left_bits: 30,
};
/// Distance from a solution up to which its own anchor is used, relative to value + lowest
/// frequency.
pub(super) const NEAR: f64 = 0.03;
/// Bits that each degree needs less.
const BITS_PER_DEGREE: i32 = 2;
/// Distance from a centre up to which it is used, relative to center + smallest eigenvalue of
/// (K_ff, M_ff).
const REACH: f64 = 0.3;
/// Anchors at most: beyond that the window is left open above.
const MAX_ANCHORS: usize = 64;

/// The condensation, its view and the interval of each anchor (upper ends; the last one open).
pub(super) struct Condensed {
    pub(super) condensation: Condensation,
    pub(super) view: View,
    pub(super) ends: Vec<f64>,
    /// Smallest eigenvalue of (A_ff, B_ff); zero where F does not depend on the unknown.
    pub(super) base: f64,
    /// From where the reversed anchor, the last one, is used; up to infinity.
    pub(super) beyond: Option<Rational>,
}

/// The blocks of the pencil that the elimination needs, sparse columns in doubles.
pub(super) struct Blocks {
    free: Vec<usize>,
    slip: Vec<usize>,
    /// A_ff and B_ff.
    pub(super) stiffness: Skyline,
    mass: Skyline,
    mass_is_zero: bool,
    /// Rows of A_ff and B_ff.
    ff: [Vec<Vec<(usize, f64)>>; 2],
    /// First asymmetric row of A_ff and B_ff.
    asymmetry: [Option<usize>; 2],
    /// A_fs, B_fs; A_sf', B_sf': columns by complementarity variable.
    fs: [Vec<Vec<f64>>; 2],
    sf: [Vec<Vec<f64>>; 2],
}

impl Blocks {
    pub(super) fn of(pencil: &Pencil) -> Blocks {
        let (free, slip) = (pencil.free().to_vec(), pencil.slip());
        let ff = [pencil.a(), pencil.b()].map(|m| m.submatrix(&free, &free));
        let columns = |m: Sparse| {
            let mut out = vec![vec![0.0; m.rows()]; m.cols()];
            m.entries().for_each(|(i, j, v)| out[j][i] = to_f64(v));
            out
        };
        let fs = [pencil.a(), pencil.b()].map(|m| columns(m.submatrix(&free, &slip)));
        let sf = [pencil.a(), pencil.b()].map(|m| columns(m.submatrix(&slip, &free).transpose()));
        let (stiffness, mass) = (Skyline::symmetric(&ff[0]), Skyline::symmetric(&ff[1]));
        let mass_is_zero = ff[1].entries().next().is_none();
        let asymmetry = [0, 1].map(|k| ff[k].first_asymmetry().map(|(i, _)| i));
        let ff = ff.map(|m| {
            (0..m.rows())
                .map(|i| m.row(i).iter().map(|(j, v)| (*j, to_f64(v))).collect())
                .collect()
        });
        Blocks {
            free,
            slip,
            stiffness,
            mass,
            mass_is_zero,
            ff,
            asymmetry,
            fs,
            sf,
        }
    }

    /// The Cholesky factor of F at a value; `None` where F is not definite in doubles.
    pub(super) fn factor_at(&self, value: f64) -> Option<Skyline> {
        self.stiffness.combine(value, &self.mass, 0.0).cholesky()
    }
}

/// Condenses a pencil with free variables.
///
/// # Errors
/// [`CompleteError::NotDefinite`] where A_ff is not symmetric positive definite (in doubles) or
/// B_ff is indefinite.
pub(super) fn condense(pencil: &Pencil, window: &Window) -> Result<Condensed, CompleteError> {
    let blocks = Blocks::of(pencil);
    for (what, asymmetric) in ["A_ff", "B_ff"].into_iter().zip(blocks.asymmetry) {
        if let Some(i) = asymmetric {
            return Err(CompleteError::NotDefinite {
                what,
                index: blocks.free[i],
            });
        }
    }
    let not_definite = |what| CompleteError::NotDefinite {
        what,
        index: blocks.free[0],
    };
    let plain = blocks
        .stiffness
        .cholesky()
        .ok_or_else(|| not_definite("A_ff"))?;
    let bound = blocks
        .stiffness
        .below_spectrum()
        .ok_or_else(|| not_definite("A_ff"))?;
    let sigma = short_below(0.8 * bound).ok_or_else(|| not_definite("A_ff"))?;
    let slack = 0.2 * bound;
    let factor = blocks
        .stiffness
        .shifted(-to_f64(&sigma) - slack)
        .cholesky()
        .ok_or_else(|| not_definite("A_ff"))?;
    let (mass_sigma, mass_factor) = mass_bound(
        &blocks.mass,
        &pencil.b().submatrix(&blocks.free, &blocks.free),
    )
    .map_err(|()| not_definite("B_ff"))?;
    let tail = if window.max().is_none() && !blocks.mass_is_zero {
        tail(pencil)
    } else {
        None
    };
    let from = |t: &Tail| to_f64(&t.from.0);
    let beyond = if window.max().is_none() && !blocks.mass_is_zero {
        reverse::beyond(pencil, [&sigma, &mass_sigma])
    } else {
        None
    };
    // A tail that begins further out (or does not) is left to the reversed pencil.
    let beyond = beyond.filter(|b| tail.as_ref().is_none_or(|t| from(t) > to_f64(&b.from)));
    let tail = if beyond.is_some() { None } else { tail };
    let top = beyond
        .as_ref()
        .map(|b| to_f64(&b.from))
        .or(tail.as_ref().map(from))
        .or(window.max().map(to_f64))
        .unwrap_or(f64::INFINITY);
    let base = if blocks.mass_is_zero {
        0.0
    } else {
        lowest_frequency(&blocks, &plain)
    };
    let (centers, ends) = centers(base, to_f64(window.min()), top);
    let mut anchors = Vec::new();
    let mut expansions = Vec::new();
    let precision = if blocks.mass_is_zero {
        CONSTANT
    } else {
        COARSE
    };
    for center in centers {
        let bounds = [to_f64(&sigma), to_f64(&mass_sigma)];
        let (anchor, expansion) = expand(pencil, &blocks, &center, bounds, precision)
            .ok_or_else(|| not_definite("A_ff + t B_ff"))?;
        anchors.push(anchor);
        expansions.push(expansion);
    }
    let beyond = beyond.map(|b| {
        anchors.push(b.anchor);
        expansions.push(b.expansion);
        b.from
    });
    let stiffness_factor = factor.rounded(slack);
    let condensation = Condensation {
        sigma: Number(sigma),
        stiffness_factor,
        mass_sigma: Number(mass_sigma),
        mass_factor,
        anchors,
        tail,
    };
    let view = View {
        index: blocks.slip.clone(),
        scale: scale(&expansions[0].z),
        expansions,
    };
    Ok(Condensed {
        condensation,
        view,
        ends,
        base,
        beyond,
    })
}

/// tau and the factor of B_ff - tau I; no factor where the block is diagonal.
fn mass_bound(mass: &Skyline, given: &Sparse) -> Result<(Rational, Option<Factor>), ()> {
    if mass.is_diagonal() {
        let least = mass.smallest_diagonal();
        return Ok((short_below(least).unwrap_or_default(), None));
    }
    // Without mass in some rows the bound is zero.
    let Some(bound) = mass.below_spectrum() else {
        return massless::factor(given)
            .map(|f| (Rational::default(), Some(f)))
            .ok_or(());
    };
    let tau = short_below(0.8 * bound).ok_or(())?;
    let slack = 0.2 * bound;
    Ok((
        tau.clone(),
        Some(
            mass.shifted(-to_f64(&tau) - slack)
                .cholesky()
                .ok_or(())?
                .rounded(slack),
        ),
    ))
}

/// Centres and the value up to which each is used; one for a pencil whose F does not depend on t.
pub(super) fn centers(base: f64, mut low: f64, top: f64) -> (Vec<Rational>, Vec<f64>) {
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

/// Doublings from a millionth of |A| / |B| until the symmetric part is to be definite.
const TAIL_DOUBLINGS: i32 = 60;

/// Smallest eigenvalue of (A_ff, B_ff), estimated by inverse iteration on the pencil.
pub(super) fn lowest_frequency(blocks: &Blocks, stiffness: &Skyline) -> f64 {
    let n = blocks.free.len();
    let mut v = vec![1.0; n];
    let mut estimate = 1.0;
    for _ in 0..20 {
        let mut w = times(&blocks.ff[1], &v);
        let energy = dot(&v, &w);
        stiffness.solve(&mut w);
        let back = times(&blocks.ff[1], &w);
        let next = dot(&v, &back);
        if !(energy > 0.0 && next > 0.0) {
            return 1.0;
        }
        estimate = energy / next;
        let norm = dot(&w, &back).sqrt();
        v = w.into_iter().map(|x| x / norm).collect();
    }
    estimate
}

/// Where the symmetric part of the whole pencil becomes definite, with its proof.
fn tail(pencil: &Pencil) -> Option<Tail> {
    let (a, b) = (
        Skyline::symmetric(pencil.a()),
        Skyline::symmetric(pencil.b()),
    );
    let mass_factor = match b.is_diagonal() {
        true => None,
        false => Some(massless::factor(pencil.b())?),
    };
    let start = a.largest() / b.largest() * TAIL_START;
    // Where sym(B) is positive definite, doubling comes to an end.
    let from = (0..TAIL_DOUBLINGS)
        .map(|k| start * f64::from(k).exp2())
        .find(|t| a.combine(*t, &b, 0.0).cholesky().is_some())?;
    let from = short_below(1.25 * from)?;
    let s = a.combine(to_f64(&from), &b, 0.0);
    let slack = s.below_spectrum()?;
    let factor = s.shifted(-slack).cholesky()?.rounded(slack);
    Some(Tail {
        from: Number(from),
        factor,
        mass_factor,
    })
}

/// Anchors about further values, appended to a condensation and its view.
pub(super) fn refine(
    pencil: &Pencil,
    condensation: &mut Condensation,
    view: &mut View,
    values: &[f64],
) {
    let blocks = Blocks::of(pencil);
    let bounds = [
        to_f64(&condensation.sigma.0),
        to_f64(&condensation.mass_sigma.0),
    ];
    for value in values {
        let expanded = from_f64(*value)
            .ok()
            .and_then(|c| expand(pencil, &blocks, &c, bounds, FINE));
        if let Some((anchor, expansion)) = expanded {
            condensation.anchors.push(anchor);
            view.expansions.push(expansion);
        }
    }
}

/// The view that a certificate's condensation gives.
pub(super) fn view_of(pencil: &Pencil, condensation: &Condensation) -> View {
    let blocks = Blocks::of(pencil);
    let bounds = [
        to_f64(&condensation.sigma.0),
        to_f64(&condensation.mass_sigma.0),
    ];
    let side = |list: &[IntegerMatrix]| {
        list.iter()
            .map(|m| columns_of(m, blocks.slip.len()))
            .collect::<Vec<_>>()
    };
    let one = |a: &Anchor| match reverse::swapped(pencil).filter(|_| a.reversed) {
        None => expansion(
            pencil,
            &blocks,
            to_f64(&a.center.0),
            bounds,
            &side(&a.right),
            &side(&a.left),
        ),
        Some(swapped) => {
            let [sigma, tau] = bounds;
            let (c, blocks) = (to_f64(&a.center.0), Blocks::of(&swapped));
            Expansion {
                reversed: true,
                ..expansion(
                    &swapped,
                    &blocks,
                    c,
                    [tau, sigma],
                    &side(&a.right),
                    &side(&a.left),
                )
            }
        }
    };
    let expansions: Vec<Expansion> = condensation.anchors.iter().map(one).collect();
    View {
        index: blocks.slip.clone(),
        scale: expansions.first().map_or(1.0, |e| scale(&e.z)),
        expansions,
    }
}

/// The columns of a rounded matrix, in doubles.
fn columns_of(m: &IntegerMatrix, cols: usize) -> Vec<Vec<f64>> {
    let entry = |v: &Integer| to_f64(&Rational::new(v.clone(), Integer::from(1) << m.exponent));
    (0..cols)
        .map(|j| m.rows.iter().map(|row| entry(&row[j])).collect())
        .collect()
}

/// The Taylor polynomials about a centre, rounded, and the condensed pencil they give.
pub(super) fn expand(
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

/// Z_k, and the norms of the residuals, as the checker will compute them.
fn expansion(
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

fn times(m: &[Vec<(usize, f64)>], x: &[f64]) -> Vec<f64> {
    m.iter()
        .map(|row| row.iter().map(|(j, v)| v * x[*j]).sum())
        .collect()
}

/// A short number at most v, within a sixteenth of it.
fn short_below(v: f64) -> Option<Rational> {
    if !(v > 0.0 && v.is_finite()) {
        return None;
    }
    let unit = (v.log2().floor() - 4.0).exp2();
    from_f64((v / unit).floor() * unit).ok()
}
