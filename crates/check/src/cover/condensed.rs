//! Elimination of the free variables without inverting F(t) = T_ff(t).
//!
//! For any W and V, with r = T_fs - F W and l = T_sf' - F'V, the Schur complement is exactly
//!
//! ```text
//!     T_ss - T_sf F^-1 T_fs = (T_ss - T_sf W - V'r) - l' F^-1 r.
//! ```
//!
//! sym(F(t)) >= (sigma + t tau) I for t >= 0, because sym(A_ff) >= sigma I and sym(B_ff) >= tau I
//! are hypotheses that the certificate proves (`psd`). So |F z| |z| >= z'F z >= (sigma + t tau)
//! |z|^2, and entry (i, j) of the last term is at most |l_i| |r_j| / (sigma + t tau), with Euclidean
//! norms of columns. F need not be symmetric. W and V approximate F^-1 T_fs and (F^-1)'T_sf', which
//! makes r and l small, but nothing depends on that.
//!
//! W and V are polynomials in d = t - center, so r and l are too, and the bracket is a polynomial
//! matrix Z(d), computed exactly. Of V'r only the coefficients of r beyond the degree of W are
//! multiplied out. The others are rounding: they are bounded by |V_i| |r_j|.
//!
//! *Reversed* anchors do the same with A and B, sigma and tau exchanged, in s = 1 / t:
//! F(t) / t = B_ff + s A_ff >= (tau + s sigma) I.
//!
//! *Members.* Where the data have radii, the same holds of every member with what `spread` adds.
//! The hypotheses are demanded of every member: the row sums of the radii come off the diagonal of
//! a matrix that is to be definite (Gershgorin).
//!
//! *Tail.* If sym(A + from B) of the whole pencil is positive definite and sym(B) semidefinite,
//! then sym(A + tB) is definite for all t >= from, and x'(A + tB)x = x'y = 0 leaves x = 0 only.
//!
//! Input: the integral rows of the pencil and the condensation. Output: [`Anchors`], whose
//! hypotheses and limits hold; an anchor is expanded when a piece names it, and the memory that
//! takes is counted. Called by the checker of covers.

use super::budget::WorkBudget;
use super::ends::{LongMatrix, largest_bits, rational_bits, within_matrix_bits};
use super::expanded::{Expanded, Norms, own_interval};
use super::family::row_bits;
use super::fault::CoverFault;
use super::product::{Linear, LinearPart, NonzeroRows, part_of, row_of, times, transposed};
use super::psd::{SymmetricRows, semidefinite};
use super::region::end;
use super::residual::{BeyondDegree, Residual, ResidualEquations};
use super::spread::{AnchorWitness, MemberSpread, Reach};
use crate::certificate::{Anchor, Condensation, CriticalAnchor, Factor, IntegerMatrix, IntegerRow};
use crate::pencil::{MemberRadii, Row, Rows};
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;
use std::ops::Deref;

/// Largest number of coefficients of an expansion.
const MAX_DEGREE: usize = 8;
/// Largest binary exponent of an expansion.
const MAX_EXPONENT: u32 = 1 << 12;
/// What a long integer takes beside its own bits, at most.
const BITS_OF_A_NUMBER: u64 = 512;
/// Fraction bits of norms of columns: the numbers of an expansion may be small integers.
const NORM_BITS: u32 = 32;

/// The pencil that is condensed.
#[derive(Clone, Copy)]
pub(super) struct PencilParts<'s, 'a> {
    /// T, or T0 and T1 with T = T0 + mu T1.
    pub(super) rows: &'s [&'a Rows],
    /// How far those of a member may be off, where the data have radii.
    pub(super) radii: Option<&'a MemberRadii>,
    /// The pieces, which say what each anchor serves. They matter where there are radii.
    pub(super) pieces: &'s [AnchoredPiece],
}

impl<'s, 'a> PencilParts<'s, 'a> {
    /// Of one problem, whose data are exact.
    pub(super) fn exact(rows: &'s [&'a Rows]) -> PencilParts<'s, 'a> {
        PencilParts {
            rows,
            radii: None,
            pieces: &[],
        }
    }
}

/// An interval of values and the anchor that it names.
#[derive(Clone)]
pub(super) struct AnchoredPiece {
    pub(super) anchor: Option<usize>,
    pub(super) lo: Rational,
    /// `None` for infinity.
    pub(super) hi: Option<Rational>,
}

/// Checks the hypotheses and the limits of each anchor, for each part of the pencil.
///
/// The free rows of all parts are the same, and so are the hypotheses, W and r; rows are scaled
/// alike.
pub(super) fn of<'a, A: AnchorOfParts, T>(
    parts: PencilParts<'_, 'a>,
    condensation: &'a Condensation<A, T>,
) -> Result<Anchors<'a>, CoverFault> {
    let bounds = FreeBounds {
        sigma: &condensation.sigma.0,
        stiffness_factor: &condensation.stiffness_factor,
        tau: &condensation.mass_sigma.0,
        mass_factor: condensation.mass_factor.as_ref(),
    };

    let mut anchors: Vec<Vec<AnchorPolynomials<'a>>> = Vec::new();
    for anchor in &condensation.anchors {
        let of_parts = (0..parts.rows.len()).map(|part| anchor.of_part(part));
        anchors.push(of_parts.collect());
    }

    with_anchors(parts, bounds, anchors)
}

/// The same with the bounds of F and, anchor by anchor, the polynomials W and V of each part.
pub(super) fn with_anchors<'a>(
    parts: PencilParts<'_, 'a>,
    bounds: FreeBounds<'a>,
    anchors: Vec<Vec<AnchorPolynomials<'a>>>,
) -> Result<Anchors<'a>, CoverFault> {
    let blocks = PartBlocks::of(parts.rows, parts.radii.map(MemberRadii::of_parts));
    check_hypotheses(&blocks, bounds)?;

    let has_reversed = anchors.iter().any(|anchor| anchor[0].reversed);
    let reversed = if has_reversed && bounds.tau.is_positive() {
        let rows: Vec<Rows> = parts.rows.iter().map(|rows| rows.reversed()).collect();
        let radii = parts.radii.map(|r| r.of_parts().map(Rows::reversed));
        let rows: Vec<&Rows> = rows.iter().collect();
        PartBlocks::of(&rows, radii.as_ref().map(|radii| radii.each_ref()))
    } else {
        PartBlocks::default()
    };

    Anchors {
        bounds,
        blocks,
        reversed,
        pieces: parts.pieces.to_vec(),
        anchors,
        memory: WorkBudget::of_anchors(0),
    }
    .within_limits()
}

/// The blocks of the parts of a pencil, row i of all parts divided by the same power of two, and
/// those of the radii in the same scale.
#[derive(Default)]
struct PartBlocks {
    middle: Vec<IntegralBlocks>,
    /// Empty where the data are exact.
    radii: Vec<IntegralBlocks>,
}

impl PartBlocks {
    fn of(parts: &[&Rows], radii: Option<[&Rows; 2]>) -> PartBlocks {
        let bits = row_bits(parts);
        let blocks = |rows: &&Rows| IntegralBlocks::of(rows, &bits);
        PartBlocks {
            middle: parts.iter().map(blocks).collect(),
            radii: radii.iter().flatten().map(blocks).collect(),
        }
    }
}

/// The anchors of a file, whose hypotheses and limits hold, and what is left for their expansions.
pub(super) struct Anchors<'a> {
    bounds: FreeBounds<'a>,
    /// Those of the pencil, or of T0 and T1.
    blocks: PartBlocks,
    /// The blocks of B + sA, where reversed anchors are and may be.
    reversed: PartBlocks,
    /// What the anchors serve.
    pieces: Vec<AnchoredPiece>,
    /// W and V of each anchor, for each part.
    anchors: Vec<Vec<AnchorPolynomials<'a>>>,
    memory: WorkBudget,
}

impl<'a> Anchors<'a> {
    /// Demands that each anchor has its shape and is within its limits.
    fn within_limits(mut self) -> Result<Anchors<'a>, CoverFault> {
        let mut numbers: u64 = 0;
        for number in 0..self.len() {
            for elimination in self.eliminations(number)? {
                numbers = numbers.saturating_add(elimination.numbers());
            }
        }

        self.memory = WorkBudget::of_anchors(numbers);
        Ok(self)
    }

    pub(super) fn len(&self) -> usize {
        self.anchors.len()
    }

    /// The condensed pencil about the anchor with this number, for each part.
    pub(super) fn expand(&self, number: usize) -> Result<Vec<Expanded>, CoverFault> {
        let eliminations = self.eliminations(number)?;
        for elimination in &eliminations {
            self.memory.spend(elimination.memory_bits())?;
        }

        // W and r are the same for all parts.
        let mut right = None;
        let mut expansions = Vec::with_capacity(eliminations.len());
        for elimination in &eliminations {
            let residual = || elimination.right_equations().residual(BeyondDegree::Kept);
            let right = right.get_or_insert_with(residual);
            let mut expanded = elimination.expand(right, self.bounds);
            if let Some(radii) = elimination.radii {
                expanded.spread(elimination.spread(radii, &self.reach(number)?));
            }
            expansions.push(expanded);
        }

        Ok(expansions)
    }

    /// The elimination about the anchor with this number, for each part.
    fn eliminations(&self, number: usize) -> Result<Vec<AnchorElimination<'_>>, CoverFault> {
        let anchor = self.anchors.get(number).ok_or(CoverFault::Anchor {
            anchors: self.anchors.len(),
            got: Some(number),
        })?;

        let PartBlocks { middle, radii } = if anchor[0].reversed {
            &self.reversed
        } else {
            &self.blocks
        };
        if middle.is_empty() {
            return Err(CoverFault::hypothesis(
                "mass_sigma > 0 for a reversed anchor",
                0,
            ));
        }

        let parts = middle.iter().zip(anchor).enumerate();
        parts
            .map(|(part, (blocks, w_and_v))| blocks.elimination(*w_and_v, radii.get(part)))
            .collect()
    }

    /// What the anchor with this number serves: the pieces that name it, in its own variable. Trees
    /// cut these intervals, so nothing in them may be left out; an infinite one is refused.
    fn reach(&self, number: usize) -> Result<Reach, CoverFault> {
        let anchor = self.anchors[number][0];
        let mut reach = Reach {
            distance: Rational::zero(),
            top: Rational::zero(),
        };

        for piece in self.pieces.iter().filter(|p| p.anchor == Some(number)) {
            let own = own_interval(anchor.reversed, &piece.lo, piece.hi.as_ref());
            let Some((lowest, Some(highest))) = own else {
                return Err(CoverFault::Unbounded {
                    lo: piece.lo.clone(),
                    hi: end(piece.hi.as_ref()),
                });
            };

            for value in [lowest, highest] {
                reach.distance = reach.distance.max((&value - anchor.center).abs());
                reach.top = reach.top.max(value);
            }
        }

        reach.rounded_up()
    }
}

/// F(t) >= (sigma + t tau) I, by Cholesky factors.
#[derive(Clone, Copy)]
pub(super) struct FreeBounds<'a> {
    pub(super) sigma: &'a Rational,
    pub(super) stiffness_factor: &'a Factor,
    pub(super) tau: &'a Rational,
    pub(super) mass_factor: Option<&'a Factor>,
}

/// The polynomials W and V of an anchor.
#[derive(Clone, Copy)]
pub(super) struct AnchorPolynomials<'a> {
    pub(super) center: &'a Rational,
    pub(super) reversed: bool,
    pub(super) right: &'a [IntegerMatrix],
    /// `None`: V is W.
    pub(super) left: Option<&'a [IntegerMatrix]>,
}

/// An anchor as a file spells it.
pub(super) trait AnchorOfParts {
    /// The polynomials W and V for a part of the pencil.
    fn of_part(&self, part: usize) -> AnchorPolynomials<'_>;
}

impl AnchorOfParts for Anchor {
    fn of_part(&self, _: usize) -> AnchorPolynomials<'_> {
        AnchorPolynomials {
            center: &self.center.0,
            reversed: self.reversed,
            right: &self.right,
            left: Some(&self.left),
        }
    }
}

impl AnchorOfParts for CriticalAnchor {
    fn of_part(&self, part: usize) -> AnchorPolynomials<'_> {
        let left = match part {
            0 => self.left.as_deref(),
            _ => Some(self.left_friction.as_slice()),
        };
        AnchorPolynomials {
            center: &self.center.0,
            reversed: self.reversed,
            right: &self.right,
            left,
        }
    }
}

/// sym(A_ff) - sigma I and sym(B_ff) - tau I are positive semidefinite, sigma > 0, tau >= 0, for
/// every member.
fn check_hypotheses(parts: &PartBlocks, bounds: FreeBounds<'_>) -> Result<(), CoverFault> {
    let blocks = &parts.middle[0];
    let radius = parts.radii.first();
    let sigma = bounds.sigma;
    let tau = bounds.tau;
    if !sigma.is_positive() {
        return Err(CoverFault::hypothesis("sigma > 0", 0));
    }

    if tau.is_negative() {
        return Err(CoverFault::hypothesis("mass_sigma >= 0", 0));
    }

    let stiffness = blocks.shifted_free_block(LinearPart::Constant, sigma, radius);
    semidefinite(
        &stiffness,
        &(&blocks.common * sigma.denom() * 2),
        Some(bounds.stiffness_factor),
        false,
        "A_ff - sigma I positive semidefinite",
    )?;
    let mass = blocks.shifted_free_block(LinearPart::Linear, tau, radius);
    semidefinite(
        &mass,
        &(&blocks.common * tau.denom() * 2),
        bounds.mass_factor,
        false,
        "B_ff - mass_sigma I positive semidefinite",
    )
}

/// Demands that sym(A + from B) is positive definite and sym(B) semidefinite on all variables, for
/// every pencil within `radius` of the rows.
pub(super) fn tail(
    rows: &Rows,
    radius: Option<&Rows>,
    from: &Rational,
    factor: &Factor,
    mass_factor: Option<&Factor>,
) -> Result<(), CoverFault> {
    let mut common = Integer::one();
    for factor in &rows.factor {
        common = common.lcm(factor);
    }

    // Twice the symmetric parts; both factors are of the symmetric part itself.
    let twice: Integer = &common * 2;
    let least = |q: &Integer, p: &Integer| {
        let mut least = twice_symmetric(rows, &common, q, p);
        if let Some(radius) = radius {
            for (i, row) in twice_symmetric(radius, &common, q, p).iter().enumerate() {
                *least[i].entry(i).or_default() -= row.values().sum::<Integer>();
            }
        }
        least
    };
    let pencil = least(from.denom(), from.numer());
    semidefinite(
        &pencil,
        &(&twice * from.denom()),
        Some(factor),
        true,
        "sym(A + from B) positive definite",
    )?;
    let mass = least(&Integer::zero(), &Integer::one());
    semidefinite(
        &mass,
        &twice,
        mass_factor,
        false,
        "sym(B) positive semidefinite",
    )
}

/// 2 sym(q A + p B) times `common`.
fn twice_symmetric(rows: &Rows, common: &Integer, q: &Integer, p: &Integer) -> SymmetricRows {
    let mut sum: SymmetricRows = vec![BTreeMap::new(); rows.order()];
    for (i, row) in rows.rows.iter().enumerate() {
        let lift = common / &rows.factor[i];
        for (j, a, b) in row {
            let value = (a * q + b * p) * &lift;
            *sum[i].entry(*j).or_default() += &value;
            *sum[*j].entry(i).or_default() += value;
        }
    }

    sum
}

/// The blocks of the pencil; free rows multiplied by one common integer, slip rows each by its own
/// integer.
pub(super) struct IntegralBlocks {
    pub(super) free: usize,
    pub(super) slip: usize,
    /// Bit length of the longest entry of the integral rows.
    longest: u64,
    /// The free rows' common multiplier D.
    pub(super) common: Integer,
    /// D T_ff and D T_fs, T_sf and T_ss.
    pub(super) of_t: LinearBlocks,
    /// What each slip row was multiplied by.
    factor: Vec<Integer>,
    /// Each slip row is divided by two to this power.
    pub(super) bits: Vec<u64>,
}

/// LinearBlocks of matrices linear in t or d.
#[derive(Default)]
pub(super) struct LinearBlocks {
    pub(super) ff: Linear,
    pub(super) fs: Linear,
    pub(super) sf: Linear,
    pub(super) ss: Linear,
}

/// W or V: a polynomial in d with matrices for coefficients, in units of 2^-`exponent`.
pub(super) struct MatrixPolynomial<'a> {
    pub(super) coefficients: Vec<Coefficient<'a>>,
    pub(super) exponent: u32,
    /// Bits of the longest entry in these units, as the certificate spells it: without the factors
    /// of rows.
    entry_bits: u64,
}

/// A matrix as the certificate spells it; its column j counts `column_factors[j]` times.
pub(super) struct Coefficient<'a> {
    pub(super) matrix: &'a [IntegerRow],
    pub(super) column_factors: Vec<Integer>,
}

/// The elimination about one anchor: W and V, and the blocks about its center.
struct AnchorElimination<'a> {
    blocks: &'a IntegralBlocks,
    /// The blocks of the radii, where the data have them.
    radii: Option<&'a IntegralBlocks>,
    anchor: AnchorPolynomials<'a>,
    /// The blocks as matrices linear in d = t - p/q, all of them times D q.
    about: LinearBlocks,
    /// F' about the center; `None` where F is symmetric.
    transposed_free: Option<Linear>,
    w: MatrixPolynomial<'a>,
    v: MatrixPolynomial<'a>,
    /// Bits of a coefficient of an entry of Z, at most.
    entry_bits: u64,
}

impl IntegralBlocks {
    /// Each slip row i is to be divided by 2^`bits[i]`.
    fn of(rows: &Rows, bits: &[u64]) -> IntegralBlocks {
        let mut blocks = IntegralBlocks {
            free: 0,
            slip: 0,
            longest: largest_bits(rows.rows.iter().flatten().flat_map(|(_, a, b)| [a, b])),
            common: Integer::one(),
            of_t: LinearBlocks::default(),
            factor: vec![],
            bits: vec![],
        };

        let mut place = Vec::with_capacity(rows.order()); // position among its kind
        for (i, &is_free) in rows.is_free.iter().enumerate() {
            if is_free {
                place.push(blocks.free);
                blocks.free += 1;
                blocks.common = blocks.common.lcm(&rows.factor[i]);
            } else {
                place.push(blocks.slip);
                blocks.slip += 1;
            }
        }

        for (i, row) in rows.rows.iter().enumerate() {
            let is_free = rows.is_free[i];
            let lift = if is_free {
                &blocks.common / &rows.factor[i]
            } else {
                Integer::one()
            };

            let mut free_columns = Row::new();
            let mut slip_columns = Row::new();
            for (j, a, b) in row {
                let entry = (place[*j], a * &lift, b * &lift);
                if rows.is_free[*j] {
                    free_columns.push(entry);
                } else {
                    slip_columns.push(entry);
                }
            }

            if is_free {
                blocks.of_t.ff.push(free_columns);
                blocks.of_t.fs.push(slip_columns);
            } else {
                blocks.bits.push(bits[i]);
                blocks.factor.push(rows.factor[i].clone());
                blocks.of_t.sf.push(free_columns);
                blocks.of_t.ss.push(slip_columns);
            }
        }

        blocks
    }

    /// Is T_ff symmetric, A_ff and B_ff each?
    fn is_symmetric(&self) -> bool {
        for (i, row) in self.of_t.ff.iter().enumerate() {
            for (j, a, b) in row {
                let has_mirror = match self.free_entry(*j, i) {
                    Some((_, mirror_a, mirror_b)) => (a, b) == (mirror_a, mirror_b),
                    None => a.is_zero() && b.is_zero(),
                };
                if !has_mirror {
                    return false;
                }
            }
        }

        true
    }

    /// The stored entry (i, j) of D T_ff.
    fn free_entry(&self, i: usize, j: usize) -> Option<&(usize, Integer, Integer)> {
        let row = &self.of_t.ff[i];
        let position = row.binary_search_by_key(&j, |entry| entry.0).ok()?;
        Some(&row[position])
    }

    /// Twice sym(A_ff) - shift I or sym(B_ff) - shift I, of the constant part of T_ff or the linear
    /// one, in units of 1 / (D times the denominator of the shift); the row sums of the radii come
    /// off its diagonal.
    fn shifted_free_block(
        &self,
        part: LinearPart,
        shift: &Rational,
        radius: Option<&IntegralBlocks>,
    ) -> SymmetricRows {
        let diagonal_shift = &self.common * shift.numer();

        let mut block: SymmetricRows = vec![BTreeMap::new(); self.free];
        for (i, row) in self.of_t.ff.iter().enumerate() {
            for (j, entry) in row_of(row, part) {
                let entry = entry * shift.denom();
                *block[i].entry(j).or_default() += &entry;
                *block[j].entry(i).or_default() += entry;
            }

            let mut taken = diagonal_shift.clone();
            if let Some(radius) = radius {
                let of_row = row_of(&radius.of_t.ff[i], part).into_iter();
                let sum: Integer = of_row.map(|(_, radius)| radius).sum();
                taken += sum * shift.denom();
            }
            *block[i].entry(i).or_default() -= taken * 2;
        }

        block
    }

    /// Reads W and V, and demands that Z is small enough to be formed.
    fn elimination<'a>(
        &'a self,
        anchor: AnchorPolynomials<'a>,
        radii: Option<&'a IntegralBlocks>,
    ) -> Result<AnchorElimination<'a>, CoverFault> {
        let w = self.polynomial(anchor.right, &ones(self.slip))?;
        // V belongs to the pencil as given, the slip rows here are multiples of its rows.
        let left = anchor.left.unwrap_or(anchor.right);
        let v = self.polynomial(left, &self.factor)?;
        let entry_bits = self.affordable(anchor.center, &w, &v)?;
        let about = self.about(anchor.center);

        Ok(AnchorElimination {
            blocks: self,
            radii,
            transposed_free: (!self.is_symmetric()).then(|| transpose(&about.ff, self.free)),
            about,
            anchor,
            w,
            v,
            entry_bits,
        })
    }

    /// Demands that Z is small enough to be formed, and returns the bits of a coefficient of an
    /// entry.
    ///
    /// It has n_s^2 entries; a coefficient is a sum of products of an entry of the pencil, one of W
    /// and one of V, in units of 2^-(e_w + e_v) / D, shifted by the center.
    fn affordable(
        &self,
        center: &Rational,
        w: &MatrixPolynomial<'_>,
        v: &MatrixPolynomial<'_>,
    ) -> Result<u64, CoverFault> {
        let mut bits = self.longest + self.common.bits() + rational_bits(center);
        bits += u64::from(w.exponent + v.exponent) + w.entry_bits + v.entry_bits;

        let what = "bits of an anchor's expansion";
        within_matrix_bits(what, self.slip, coefficients(w, v), bits)?;
        Ok(bits)
    }

    /// Coefficient matrices brought to one exponent, column j multiplied by `column_factors[j]`.
    fn polynomial<'a>(
        &self,
        list: &'a [IntegerMatrix],
        column_factors: &[Integer],
    ) -> Result<MatrixPolynomial<'a>, CoverFault> {
        let exponent = list.iter().map(|m| m.exponent).max().unwrap_or(0);
        CoverFault::at_most("degree", MAX_DEGREE as u64, list.len() as u64)?;
        CoverFault::at_most("exponent", MAX_EXPONENT.into(), exponent.into())?;

        let mut coefficients = Vec::with_capacity(list.len());
        let mut entry_bits = 0;
        for m in list {
            CoverFault::length("anchor", self.free, m.rows.len())?;
            for row in m.rows.iter() {
                CoverFault::length("anchor row", self.slip, row.len())?;
            }

            let lift = exponent - m.exponent;
            let own_bits = m.rows.iter().map(IntegerRow::bits).max().unwrap_or(0);
            if own_bits > 0 {
                entry_bits = entry_bits.max(own_bits + u64::from(lift));
            }

            coefficients.push(Coefficient {
                matrix: &m.rows,
                column_factors: column_factors.iter().map(|f| f << lift).collect(),
            });
        }

        Ok(MatrixPolynomial {
            coefficients,
            exponent,
            entry_bits,
        })
    }

    /// The blocks as matrices linear in d = t - center.
    fn about(&self, center: &Rational) -> LinearBlocks {
        // The free rows are multiples of D already.
        let one = Integer::one();
        let LinearBlocks { ff, fs, sf, ss } = &self.of_t;
        LinearBlocks {
            ff: about(ff, center, &one),
            fs: about(fs, center, &one),
            sf: about(sf, center, &self.common),
            ss: about(ss, center, &self.common),
        }
    }

    /// A bound of |dF/dt| / sigma in the Euclidean norm: the largest sum of a row or a column.
    ///
    /// The square of the norm is at most the largest sum of a row times that of a column. Where F
    /// is not symmetric the rows alone do not bound it.
    fn drift(&self, sigma: &Rational) -> Rational {
        let mut of_rows = vec![Integer::zero(); self.free];
        let mut of_columns = of_rows.clone();
        for (i, row) in self.of_t.ff.iter().enumerate() {
            for (j, _, b) in row {
                of_rows[i] += b.abs();
                of_columns[*j] += b.abs();
            }
        }

        let largest = of_rows.into_iter().chain(of_columns).max();
        Rational::new(largest.unwrap_or_default(), self.common.clone()) / sigma
    }
}

impl AnchorElimination<'_> {
    /// How many integers W and V have.
    fn numbers(&self) -> u64 {
        let matrices = self.w.coefficients.len() + self.v.coefficients.len();
        let entries = self.blocks.free.saturating_mul(self.blocks.slip) as u64;
        entries.saturating_mul(matrices as u64)
    }

    /// What the expansion is counted as: Z has n_s^2 entries, each of as many coefficients as W and
    /// V have together, of two at least.
    fn memory_bits(&self) -> u64 {
        let matrices = self.w.coefficients.len() + self.v.coefficients.len();
        let coefficients = matrices.max(2) as u64;
        let entries = (self.blocks.slip as u64).saturating_pow(2);

        entries
            .saturating_mul(coefficients)
            .saturating_mul(BITS_OF_A_NUMBER + self.entry_bits)
    }

    /// What the members add for the values that the anchor serves.
    fn spread(&self, radii: &IntegralBlocks, reach: &Reach) -> MemberSpread {
        let about = AnchorWitness {
            center: self.anchor.center,
            w: &self.w,
            v: &self.v,
        };
        MemberSpread::of(radii, &about, reach)
    }

    /// F W = T_fs.
    fn right_equations(&self) -> ResidualEquations<'_> {
        let c = self.about.fs.clone();
        let one = ones(self.blocks.slip);
        ResidualEquations::new(&self.about.ff, c, self.anchor.right, &one)
    }

    /// Norms of the columns of l = T_sf' - F'V, coefficient by coefficient, in units of
    /// 1 / (D q 2^e_v), column i multiplied by the factor of slip row i.
    ///
    /// Where F is symmetric, V is W and T_sf' is T_fs, l is r.
    fn left_residual_norms(&self, right: &Residual) -> Norms {
        let left = self.anchor.left.unwrap_or(self.anchor.right);
        let c = transpose(&self.about.sf, self.blocks.free);
        // Not F: V'F stands in the identity for T_ss - T_sf F^-1 T_fs.
        let free = self.transposed_free.as_ref().unwrap_or(&self.about.ff);
        let equations = ResidualEquations::new(free, c, left, &self.blocks.factor);
        if self.anchor.left.is_none() && equations.is_that_of(&self.right_equations()) {
            return right.norms(&equations.column_factors);
        }

        let residual = equations.residual(BeyondDegree::Dropped);
        residual.norms(&equations.column_factors)
    }

    /// The condensed pencil about the anchor; `right` is that of this anchor or of the other
    /// part's, whose free rows and W are the same.
    fn expand(&self, right: &Residual, bounds: FreeBounds<'_>) -> Expanded {
        let (sigma, tau) = if self.anchor.reversed {
            (bounds.tau, bounds.sigma)
        } else {
            (bounds.sigma, bounds.tau)
        };
        let IntegralBlocks { common, bits, .. } = self.blocks;
        let exponent = self.w.exponent + self.v.exponent;

        // Z is in units of 1 / (D q 2^(e_w + e_v)), the remainder in |l||r| / (D q sigma) of them.
        // Rows are divided by different powers of two: their common unit is that of the largest.
        let q = self.anchor.center.denom();
        let largest = bits.iter().copied().max().unwrap_or(1);
        let unit = (common * q) << (u64::from(exponent) + largest);
        let raised: Vec<Integer> = bits
            .iter()
            .map(|bits| Integer::one() << (largest - bits))
            .collect();

        // Each remainder is a product of two norms.
        let norm_unit = &unit << (2 * NORM_BITS);
        let rounding_weight: Vec<Rational> = raised
            .iter()
            .map(|raised| Rational::new(raised.clone(), norm_unit.clone()))
            .collect();
        let by_sigma = (sigma * Rational::from_integer(common * q)).recip();
        let weight = rounding_weight.iter().map(|w| &by_sigma * w).collect();

        let z = self.bracket(right);
        let right_norms = right.norms(&ones(self.blocks.slip));
        let rounding = self.w.coefficients.len().min(right_norms.len());
        Expanded {
            center: self.anchor.center.clone(),
            z: raise_rows(z, &raised),
            left: self.left_residual_norms(right),
            rounding: right_norms[..rounding].to_vec(),
            right: right_norms,
            v: self.v.coefficients.iter().map(Coefficient::norms).collect(),
            rounding_weight,
            weight,
            unit,
            drift: self.blocks.drift(sigma),
            gain: tau / sigma,
            bound_bits: rational_bits(sigma) + rational_bits(tau),
            coefficients: coefficients(&self.w, &self.v),
            reversed: self.anchor.reversed,
            spread: None,
        }
    }

    /// Z times D q: T_ss - T_sf W - V'r, coefficient by coefficient, where of r the coefficients
    /// beyond the degree of W are meant.
    fn bracket(&self, r: &Residual) -> Vec<LongMatrix> {
        let AnchorElimination { about, w, v, .. } = self;
        let slip = self.blocks.slip;
        let w_len = w.coefficients.len();
        let v_len = v.coefficients.len();
        // The highest powers of d: 1 in T_ss, that of W and one more, those of V and r together.
        let r_len = r.squares.len();
        let degree = w_len.max((v_len + r_len).saturating_sub(2)).max(1);
        let mut z = vec![zero(slip, slip); degree + 1];

        for (i, row) in about.ss.iter().enumerate() {
            for (j, constant, linear) in row {
                z[0][i][*j] += constant << (w.exponent + v.exponent);
                z[1][i][*j] += linear << (w.exponent + v.exponent);
            }
        }

        // T_sf W.
        for (k, w_k) in w.coefficients.iter().enumerate() {
            for (power, part) in [(k, LinearPart::Constant), (k + 1, LinearPart::Linear)] {
                let product = w_k.times_from_left(&part_of(&about.sf, part));
                let entries = z[power].iter_mut().flatten();
                for (z_ij, entry) in entries.zip(product.into_iter().flatten()) {
                    *z_ij -= entry << v.exponent;
                }
            }
        }

        // V'r, the transpose of r'V.
        for (m, r_m) in (w_len..).zip(&r.beyond) {
            let r_transposed = transposed(r_m, slip);
            for (k, v_k) in v.coefficients.iter().enumerate() {
                let product = v_k.times_from_left(&r_transposed);
                for (j, row) in product.iter().enumerate() {
                    for (z_i, entry) in z[k + m].iter_mut().zip(row) {
                        z_i[j] -= entry;
                    }
                }
            }
        }

        z
    }
}

/// How many coefficients W and V have, and one more.
fn coefficients(w: &MatrixPolynomial<'_>, v: &MatrixPolynomial<'_>) -> usize {
    w.coefficients.len() + v.coefficients.len() + 1
}

/// `factor` q T as a matrix linear in d = t - p/q: q A + p B and q B.
fn about(block: &Linear, center: &Rational, factor: &Integer) -> Linear {
    let p = center.numer();
    let q = center.denom();

    let mut shifted = Linear::with_capacity(block.len());
    for row in block {
        let mut entries = Row::with_capacity(row.len());
        for (j, a, b) in row {
            entries.push((*j, (q * a + p * b) * factor, q * b * factor));
        }

        shifted.push(entries);
    }

    shifted
}

pub(super) fn transpose(m: &Linear, cols: usize) -> Linear {
    let mut transposed = vec![Row::new(); cols];
    for (i, row) in m.iter().enumerate() {
        for (j, constant, linear) in row {
            transposed[*j].push((i, constant.clone(), linear.clone()));
        }
    }

    transposed
}

impl Coefficient<'_> {
    /// The product of `left` and this matrix.
    fn times_from_left(&self, left: &NonzeroRows<'_>) -> LongMatrix {
        let mut product = times(left, self.matrix, self.column_factors.len());
        for row in &mut product {
            for (entry, factor) in row.iter_mut().zip(&self.column_factors) {
                *entry *= factor;
            }
        }

        product
    }

    /// Upper bounds of the Euclidean norms of the columns, in units of 2^-[`NORM_BITS`].
    fn norms(&self) -> Vec<Integer> {
        let mut squares = vec![Integer::zero(); self.column_factors.len()];
        for row in self.matrix {
            add_squares(&mut squares, row.iter());
        }

        norms(&squares, &self.column_factors)
    }
}

/// Multiplies each row of every coefficient by its factor.
fn raise_rows(mut z: Vec<LongMatrix>, factors: &[Integer]) -> Vec<LongMatrix> {
    for matrix in &mut z {
        for (row, factor) in matrix.iter_mut().zip(factors) {
            for entry in row {
                *entry *= factor;
            }
        }
    }

    z
}

fn zero(rows: usize, cols: usize) -> LongMatrix {
    vec![vec![Integer::zero(); cols]; rows]
}

pub(super) fn ones(count: usize) -> Vec<Integer> {
    vec![Integer::one(); count]
}

/// Adds the squares of a row's entries to the sums of their columns.
pub(super) fn add_squares<T: Deref<Target = Integer>>(
    sums: &mut [Integer],
    row: impl Iterator<Item = T>,
) {
    for (sum, entry) in sums.iter_mut().zip(row) {
        *sum += &*entry * &*entry;
    }
}

/// Upper bounds of the Euclidean norms of columns with these sums of squares, in units of
/// 2^-[`NORM_BITS`]: the norm itself where it is a whole number of units. Column j counts
/// `column_factors[j]` times.
pub(super) fn norms(squares: &[Integer], column_factors: &[Integer]) -> Vec<Integer> {
    let mut norms = Vec::with_capacity(squares.len());
    for (square, factor) in squares.iter().zip(column_factors) {
        let square = (square * factor * factor) << (2 * NORM_BITS);
        let root = square.sqrt();
        let is_exact = &root * &root == square;
        norms.push(root + u8::from(!is_exact));
    }

    norms
}

#[cfg(test)]
mod tests;
