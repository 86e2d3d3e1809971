//! Elimination of the free variables without inverting F(t) = T_ff(t).
//!
//! For any W and V the Schur complement is, exactly,
//!   T_ss - T_sf F^-1 T_fs = (T_ss - T_sf W - V'r) - l' F^-1 r,   r = T_fs - F W,   l = T_sf' - F
//!   V.
//! With F(t) >= (sigma + t tau) I the last term is at most |l_i| |r_j| / (sigma + t tau) in
//! absolute value. W and V are polynomials in d = t - center, so the bracket is a polynomial
//! matrix. Of V'r only the coefficients of r beyond the degree of W are multiplied out: the others
//! are rounding, at most |V_i| |r_j|.

use super::fault::CoverFault;
use super::expanded::Expanded;
use super::ends::{Matrix, largest_bits, rational_bits, within_matrix_bits};
use super::product::{Linear, Part, times};
use super::psd::{Symmetric, semidefinite};
use crate::certificate::{Anchor, Condensation, IntegerMatrix, Tail};
use crate::pencil::{Row, Rows};
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::cell::OnceCell;
use std::collections::BTreeMap;

/// Largest degree of an expansion.
const MAX_DEGREE: usize = 8;
/// Largest binary exponent of an expansion.
const MAX_EXPONENT: u32 = 1 << 12;
/// Fraction bits of norms of columns: the numbers of an expansion may be small integers.
const NORM_BITS: u32 = 32;

/// Hypotheses, then one expansion per anchor.
pub(super) fn of(rows: &Rows, condensation: &Condensation) -> Result<Vec<Expanded>, CoverFault> {
    let blocks = Blocks::of(rows);
    let sigma = &condensation.sigma.0;
    if !sigma.is_positive() {
        return Err(CoverFault::Hypothesis {
            expected: "sigma > 0",
            row: 0,
        });
    }
    blocks.symmetric()?;
    let tau = &condensation.mass_sigma.0;
    if tau.is_negative() {
        return Err(CoverFault::Hypothesis {
            expected: "mass_sigma >= 0",
            row: 0,
        });
    }
    let block = |k: usize, shift: &Rational| -> (Symmetric, Integer) {
        // In units of 1 / (common denom(shift)).
        let entry = |a: &Integer, b: &Integer| (if k == 0 { a } else { b }) * shift.denom();
        let mut out: Symmetric = blocks
            .ff
            .iter()
            .map(|row| row.iter().map(|(j, a, b)| (*j, entry(a, b))).collect())
            .collect();
        for (i, row) in out.iter_mut().enumerate() {
            *row.entry(i).or_default() -= &blocks.common * shift.numer();
        }
        (out, &blocks.common * shift.denom())
    };
    let (shifted, scale) = block(0, sigma);
    semidefinite(
        &shifted,
        &scale,
        Some(&condensation.stiffness_factor),
        false,
        "A_ff - sigma I positive semidefinite",
    )?;
    let (shifted, scale) = block(1, tau);
    semidefinite(
        &shifted,
        &scale,
        condensation.mass_factor.as_ref(),
        false,
        "B_ff - mass_sigma I positive semidefinite",
    )?;
    // F(t) / t = B_ff + s A_ff >= (tau + s sigma) I for s = 1 / t.
    let reversed = OnceCell::new();
    let expand = |anchor: &Anchor| match anchor.reversed {
        false => blocks.expand(anchor, sigma, tau),
        true if tau.is_zero() => Err(CoverFault::Hypothesis {
            expected: "mass_sigma > 0 for a reversed anchor",
            row: 0,
        }),
        true => reversed
            .get_or_init(|| Blocks::of(&rows.reversed()))
            .expand(anchor, tau, sigma)
            .map(|e| Expanded {
                reversed: true,
                ..e
            }),
    };
    condensation.anchors.iter().map(expand).collect()
}

/// sym(A + from B) is positive definite and sym(B) semidefinite on all variables.
pub(super) fn tail(rows: &Rows, tail: &Tail) -> Result<(), CoverFault> {
    let common = rows.factor.iter().fold(Integer::one(), |l, f| l.lcm(f));
    let from = &tail.from.0;
    let symmetric = |entry: &dyn Fn(&Integer, &Integer) -> Integer| {
        let mut out: Symmetric = vec![BTreeMap::new(); rows.order()];
        for (i, row) in rows.rows.iter().enumerate() {
            for (j, a, b) in row {
                let value = entry(a, b) * (&common / &rows.factor[i]);
                *out[i].entry(*j).or_default() += &value;
                *out[*j].entry(i).or_default() += value;
            }
        }
        out
    };
    // Twice the symmetric parts; both factors are of the symmetric part itself.
    let twice: Integer = &common * 2;
    let pencil = symmetric(&|a, b| a * from.denom() + b * from.numer());
    semidefinite(
        &pencil,
        &(&twice * from.denom()),
        Some(&tail.factor),
        true,
        "sym(A + from B) positive definite",
    )?;
    let mass = symmetric(&|_, b| b.clone());
    semidefinite(
        &mass,
        &twice,
        tail.mass_factor.as_ref(),
        false,
        "sym(B) positive semidefinite",
    )
}

/// The blocks of the pencil; free rows multiplied by one common integer, slip rows each by its own
/// power of two over an integer.
struct Blocks {
    free: usize,
    slip: usize,
    /// Bit length of the longest entry of the integral rows.
    longest: u64,
    /// The free rows' common multiplier D.
    common: Integer,
    /// Rows of D T_ff and D T_fs, and of T_sf and T_ss: column, A, B.
    ff: Linear,
    fs: Linear,
    sf: Linear,
    ss: Linear,
    /// What each slip row was multiplied by.
    factor: Vec<Integer>,
    /// Bit length of the largest entry of A in each slip row: the row is divided by 2^that.
    bits: Vec<u64>,
}

impl Blocks {
    fn of(rows: &Rows) -> Blocks {
        let mut place = Vec::new(); // position among its kind
        let (mut free, mut slip) = (0, 0);
        for &is_free in &rows.is_free {
            let count = if is_free { &mut free } else { &mut slip };
            place.push(*count);
            *count += 1;
        }
        let is_free = |i: &usize| rows.is_free[*i];
        let common = (0..rows.order())
            .filter(is_free)
            .fold(Integer::one(), |l, i| l.lcm(&rows.factor[i]));
        let longest = largest_bits(rows.rows.iter().flatten().flat_map(|(_, a, b)| [a, b]));
        let mut blocks = Blocks {
            free,
            slip,
            longest,
            common,
            ff: vec![],
            fs: vec![],
            sf: vec![],
            ss: vec![],
            factor: vec![],
            bits: vec![],
        };
        for (i, row) in rows.rows.iter().enumerate() {
            let lift = if rows.is_free[i] {
                &blocks.common / &rows.factor[i]
            } else {
                Integer::one()
            };
            let (f, s): (Vec<_>, Vec<_>) = row
                .iter()
                .map(|(j, a, b)| (*j, a * &lift, b * &lift))
                .partition(|(j, ..)| rows.is_free[*j]);
            let renumber = |list: Row| {
                list.into_iter()
                    .map(|(j, a, b)| (place[j], a, b))
                    .collect::<Row>()
            };
            let (f, s) = (renumber(f), renumber(s));
            if rows.is_free[i] {
                blocks.ff.push(f);
                blocks.fs.push(s);
            } else {
                blocks.bits.push(
                    row.iter()
                        .map(|(_, a, _)| a.bits())
                        .max()
                        .unwrap_or(0)
                        .max(1),
                );
                blocks.factor.push(rows.factor[i].clone());
                blocks.sf.push(f);
                blocks.ss.push(s);
            }
        }
        blocks
    }

    fn symmetric(&self) -> Result<(), CoverFault> {
        let at = |i: usize, j: usize| {
            self.ff[i]
                .binary_search_by_key(&j, |e| e.0)
                .ok()
                .map(|k| (&self.ff[i][k].1, &self.ff[i][k].2))
        };
        let bad = |i: &usize| {
            self.ff[*i]
                .iter()
                .any(|(j, a, b)| at(*j, *i).map_or(!(a.is_zero() && b.is_zero()), |v| v != (a, b)))
        };
        match (0..self.free).find(bad) {
            Some(row) => Err(CoverFault::Hypothesis {
                expected: "T_ff symmetric",
                row,
            }),
            None => Ok(()),
        }
    }

    fn expand(
        &self,
        anchor: &Anchor,
        sigma: &Rational,
        tau: &Rational,
    ) -> Result<Expanded, CoverFault> {
        let (w, e_w) = self.coefficients(&anchor.right)?;
        let (mut v, e_v) = self.coefficients(&anchor.left)?;
        let coefficients = w.len() + v.len() + 1;
        self.affordable(anchor, coefficients, e_w + e_v, &[&w, &v])?;
        // V belongs to the pencil as given, the slip rows here are multiples of its rows.
        for row in v.iter_mut().flatten() {
            row.iter_mut().zip(&self.factor).for_each(|(v, f)| *v *= f);
        }
        let (center, q) = (&anchor.center.0, anchor.center.0.denom());
        let one = Integer::one();
        let [ff, fs] = [&self.ff, &self.fs].map(|block| about(block, center, &one));
        let [sf, ss] = [&self.sf, &self.ss].map(|block| about(block, center, &self.common));
        // Residuals in units of 1 / (q 2^e), D times the true ones.
        let r = residual(&ff, &fs, &w, e_w, self.slip);
        let l = residual(&ff, &transpose(&sf, self.free), &v, e_v, self.slip);
        let z = self.bracket(&ss, &sf, &w, &v, &r, e_w, e_v);
        let rounding = &r[..w.len().min(r.len())];
        // Z in units of 1 / (D q 2^(e_w + e_v)), the remainder in |l||r| / (D q sigma) of them; the
        // common unit of rows that are divided by different powers of two is that of the largest.
        let largest = self.bits.iter().copied().max().unwrap_or(1);
        let unit = (&self.common * q) << (u64::from(e_w + e_v) + largest);
        let weight = (sigma * Rational::from_integer(&self.common * q)).recip();
        // Each remainder is a product of two norms.
        let norm_unit = &unit << (2 * NORM_BITS);
        let raised = |i: usize| Integer::one() << (largest - self.bits[i]);
        let z = z.into_iter().map(|m| {
            m.into_iter()
                .enumerate()
                .map(|(i, row)| row.into_iter().map(|v| v * raised(i)).collect())
                .collect()
        });
        Ok(Expanded {
            center: center.clone(),
            z: z.collect(),
            left: norms(&l, self.slip),
            right: norms(&r, self.slip),
            v: norms(&v, self.slip),
            rounding: norms(rounding, self.slip),
            rounding_weight: (0..self.slip)
                .map(|i| Rational::new(raised(i), norm_unit.clone()))
                .collect(),
            weight: (0..self.slip)
                .map(|i| &weight * Rational::new(raised(i), norm_unit.clone()))
                .collect(),
            unit,
            drift: self.drift(sigma),
            gain: tau / sigma,
            coefficients,
            reversed: false,
        })
    }

    /// Z has n_s^2 entries, each of so many coefficients; a coefficient is a sum of products of an
    /// entry of the pencil, one of W and one of V, in units of 2^-`exponent` / D, shifted by the
    /// center.
    fn affordable(
        &self,
        anchor: &Anchor,
        coefficients: usize,
        exponent: u32,
        expansions: &[&[Matrix]],
    ) -> Result<(), CoverFault> {
        let longest = |m: &[Matrix]| largest_bits(m.iter().flatten().flatten());
        let of_anchor: u64 = expansions.iter().map(|m| longest(m)).sum();
        let of_pencil = self.longest + self.common.bits();
        let bits = of_anchor + of_pencil + rational_bits(&anchor.center.0) + u64::from(exponent);
        within_matrix_bits(
            "bits of an anchor's expansion",
            self.slip,
            coefficients,
            bits,
        )
    }

    /// Coefficient matrices brought to one exponent.
    fn coefficients(&self, list: &[IntegerMatrix]) -> Result<(Vec<Matrix>, u32), CoverFault> {
        let length = |what, expected, got| {
            if expected == got {
                Ok(())
            } else {
                Err(CoverFault::Length {
                    what,
                    expected,
                    got,
                })
            }
        };
        let exponent = list.iter().map(|m| m.exponent).max().unwrap_or(0);
        for (what, limit, got) in [
            ("degree", MAX_DEGREE as u64, list.len() as u64),
            ("exponent", MAX_EXPONENT.into(), exponent.into()),
        ] {
            if got > limit {
                return Err(CoverFault::TooLarge { what, limit, got });
            }
        }
        for m in list {
            length("anchor", self.free, m.rows.len())?;
            m.rows
                .iter()
                .try_for_each(|row| length("anchor row", self.slip, row.len()))?;
        }
        let lifted = |m: &IntegerMatrix| {
            m.rows
                .iter()
                .map(|row| row.iter().map(|v| v << (exponent - m.exponent)).collect())
                .collect()
        };
        Ok((list.iter().map(lifted).collect(), exponent))
    }

    /// D T_ss - D T_sf W - V'r, coefficient by coefficient.
    #[allow(clippy::too_many_arguments)]
    fn bracket(
        &self,
        ss: &Linear,
        sf: &Linear,
        w: &[Matrix],
        v: &[Matrix],
        r: &[Matrix],
        e_w: u32,
        e_v: u32,
    ) -> Vec<Matrix> {
        let degree = 1 + w.len().max((v.len() + r.len()).saturating_sub(2)).max(1);
        let mut z = vec![vec![vec![Integer::zero(); self.slip]; self.slip]; degree];
        for i in 0..self.slip {
            for (j, c, l) in &ss[i] {
                z[0][i][*j] += c << (e_w + e_v);
                z[1][i][*j] += l << (e_w + e_v);
            }
        }
        for (k, w_k) in w.iter().enumerate() {
            for (m, part) in [(k, Part::Constant), (k + 1, Part::Linear)] {
                let product = times(sf, part, w_k, self.slip)
                    .into_iter()
                    .flatten()
                    .flatten();
                z[m].iter_mut()
                    .flatten()
                    .zip(product)
                    .for_each(|(z, p)| *z -= p << e_v);
            }
        }
        for (k, v_k) in v.iter().enumerate() {
            for (m, r_m) in r
                .iter()
                .enumerate()
                .skip(w.len())
                .filter(|(_, r_m)| !r_m.iter().flatten().all(Zero::is_zero))
            {
                for f in 0..self.free {
                    for i in (0..self.slip).filter(|&i| !v_k[f][i].is_zero()) {
                        for j in (0..self.slip).filter(|&j| !r_m[f][j].is_zero()) {
                            z[k + m][i][j] -= &v_k[f][i] * &r_m[f][j];
                        }
                    }
                }
            }
        }
        z
    }

    /// |dF/dt| / sigma in the maximum row sum.
    fn drift(&self, sigma: &Rational) -> Rational {
        let largest = self
            .ff
            .iter()
            .map(|row| row.iter().map(|(_, _, b)| b.abs()).sum::<Integer>())
            .max()
            .unwrap_or_default();
        Rational::new(largest, self.common.clone()) / sigma
    }
}

/// `factor` q T as a matrix linear in d = t - p/q: q A + p B and q B.
fn about(block: &Linear, center: &Rational, factor: &Integer) -> Linear {
    let (p, q) = (center.numer(), center.denom());
    let entry =
        |(j, a, b): &(usize, Integer, Integer)| (*j, (q * a + p * b) * factor, q * b * factor);
    block
        .iter()
        .map(|row| row.iter().map(entry).collect())
        .collect()
}

fn transpose(m: &Linear, cols: usize) -> Linear {
    let mut out = vec![Vec::new(); cols];
    for (i, row) in m.iter().enumerate() {
        for (j, c, l) in row {
            out[*j].push((i, c.clone(), l.clone()));
        }
    }
    out
}

/// Coefficients of C(d) - F(d) W(d), with W in units of 2^-e.
fn residual(f: &Linear, c: &Linear, w: &[Matrix], e: u32, cols: usize) -> Vec<Matrix> {
    let mut out =
        vec![vec![vec![Integer::zero(); cols]; f.len()]; w.len() + 1 + usize::from(w.is_empty())];
    for (i, row) in c.iter().enumerate() {
        for (j, constant, linear) in row {
            out[0][i][*j] += constant << e;
            out[1][i][*j] += linear << e;
        }
    }
    for (k, w_k) in w.iter().enumerate() {
        for (m, part) in [(k, Part::Constant), (k + 1, Part::Linear)] {
            let product = times(f, part, w_k, cols).into_iter().flatten().flatten();
            out[m]
                .iter_mut()
                .flatten()
                .zip(product)
                .for_each(|(o, p)| *o -= p);
        }
    }
    out
}

/// Upper bounds of the Euclidean norm of each column, coefficient by coefficient, in units of
/// 2^-[`NORM_BITS`].
fn norms(list: &[Matrix], cols: usize) -> Vec<Vec<Integer>> {
    let norm = |m: &Matrix, j: usize| {
        let square: Integer = m.iter().map(|row| &row[j] * &row[j]).sum();
        if square.is_zero() {
            square
        } else {
            (square << (2 * NORM_BITS)).sqrt() + 1
        }
    };
    list.iter()
        .map(|m| (0..cols).map(|j| norm(m, j)).collect())
        .collect()
}

#[cfg(test)]
mod tests;
