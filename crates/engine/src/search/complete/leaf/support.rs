//! Leaf `support`: what one support holds at every value of an interval, exactly.
//!
//! The interval is cut at *points*, algebraic numbers, and every point and every open cell between
//! two points has a reason of its own: a Farkas vector, or a solution (`reasons`). Beginning with
//! the whole interval, the reason of a rational value inside it is found, with the polynomials
//! whose roots end it; the parts beyond the nearest roots are treated likewise.
//!
//! Called by `tree` for regions that doubles do not decide, and for those that no matrices enclose.
//! Only small supports are tried. The checker's side is `check::cover::support`.

mod alone;
mod circuit;
mod reasons;

use mceip_check::certificate::{Exact, Polynomials, Support, SupportPoint};
use mceip_exact::{Algebraic, Integer, Poly, Rational, roots_in};
use mceip_model::Pencil;
use mceip_model::file::Number;
use num_traits::One;
use reasons::{Around, Supported};
use std::cmp::Ordering;

/// Active variables up to which a support is decided exactly.
const MAX_ACTIVE: usize = 10;

/// Cells of one leaf at most.
const MAX_CELLS: usize = 64;

/// Parts of an interval, in units of 1/1024, at which its reason is looked for: numbers that no
/// hand-made problem has as a critical value.
const PARTS: [i64; 3] = [487, 601, 333];

/// Isolating intervals are at least this much narrower than the value, in bits.
const WIDTH_BITS: u64 = 80;

/// And no more than this: coefficients of 1e60 would ask for tens of thousands of halvings, one by
/// one. What that leaves undecided the checker refuses, and it stays open. (Found by a campaign
/// that did not end, seed 12, 2026-11-21.)
const MAX_WIDTH_BITS: u64 = 1_024;

/// The leaf of a support (variables of the pencil) over [lo, hi], if it can be decided before the
/// search is told to stop.
pub(crate) fn leaf(
    pencil: &Pencil,
    support: &[usize],
    lo: &Rational,
    hi: Option<&Rational>,
    is_stopped: &dyn Fn() -> bool,
) -> Option<Support> {
    if support.is_empty() || support.len() + pencil.free().len() > MAX_ACTIVE {
        return None;
    }

    let mut sweep = Sweep {
        system: Supported::new(pencil, support)?,
        is_stopped,
        points: Vec::new(),
        cells: Vec::new(),
        reasons: Vec::new(),
    };

    let first = Algebraic::rational(lo.clone());
    sweep.point(first.clone())?;
    match hi {
        Some(hi) if hi == lo => {}
        Some(hi) => {
            let last = Algebraic::rational(hi.clone());
            sweep.between(first, Some(last.clone()))?;
            sweep.point(last)?;
        }
        None => sweep.between(first, None)?,
    }

    Some(sweep.finish())
}

/// The leaf of the empty support: there is nothing to exclude, because x is not zero.
pub(crate) fn empty_leaf() -> Support {
    Support {
        points: Vec::new(),
        cells: Vec::new(),
        reasons: Vec::new(),
    }
}

/// A point of the interval and the number of its reason.
struct SweepPoint {
    value: Algebraic,
    reason: usize,
}

/// The points, cells and reasons found so far, from left to right.
struct Sweep<'a> {
    system: Supported,
    is_stopped: &'a dyn Fn() -> bool,
    points: Vec<SweepPoint>,
    cells: Vec<usize>,
    reasons: Vec<Exact>,
}

impl Sweep<'_> {
    /// The number of a reason, which is listed if it is new.
    fn number(&mut self, reason: Exact) -> usize {
        if let Some(number) = self.reasons.iter().position(|r| *r == reason) {
            return number;
        }

        self.reasons.push(reason);
        self.reasons.len() - 1
    }

    fn point(&mut self, mut value: Algebraic) -> Option<()> {
        if (self.is_stopped)() {
            return None;
        }

        value.try_rational();
        let reason = self.system.at(&mut value)?;
        let reason = self.number(reason);
        self.points.push(SweepPoint { value, reason });
        Some(())
    }

    /// Everything strictly between two values, in order.
    fn between(&mut self, mut left: Algebraic, mut right: Option<Algebraic>) -> Option<()> {
        if self.cells.len() >= MAX_CELLS || (self.is_stopped)() {
            return None;
        }

        let General { t, around } = self.general_value(&mut left, &mut right)?;

        let upper_end = right.as_ref().map(|right| right.interval().hi().clone());
        let critical = squarefree_product(&around.critical);
        let mut roots = roots_in(&critical, left.interval().lo(), upper_end.as_ref());
        roots.retain(|root| is_strictly_between(root, &left, right.as_ref()));
        let (below, above): (Vec<Algebraic>, Vec<Algebraic>) = roots
            .into_iter()
            .partition(|root| root.clone().cmp_rational(&t) == Ordering::Less);

        if let Some(end) = below.last() {
            self.between(left, Some(end.clone()))?;
            self.point(end.clone())?;
        }

        let reason = self.number(around.reason);
        self.cells.push(reason);
        if let Some(end) = above.first() {
            self.point(end.clone())?;
            self.between(end.clone(), right)?;
        }

        Some(())
    }

    /// A value strictly between two others at which no critical polynomial vanishes, and what there
    /// is around it.
    fn general_value(
        &self,
        left: &mut Algebraic,
        right: &mut Option<Algebraic>,
    ) -> Option<General> {
        PARTS.iter().find_map(|part| {
            let part = Rational::new((*part).into(), 1024.into());
            let t = inside(left, right.as_mut(), &part);
            let around = self.system.around(&t)?;
            let is_general = around.critical.iter().all(|p| p.sign_at(&t) != 0);
            is_general.then_some(General { t, around })
        })
    }

    /// The leaf, its points isolated well enough for the checker.
    fn finish(mut self) -> Support {
        for SweepPoint { value, reason } in &mut self.points {
            narrow(value, &self.reasons[*reason]);
        }

        for k in 1..self.points.len() {
            let (before, after) = self.points.split_at_mut(k);
            separate(&mut before[k - 1].value, &mut after[0].value);
        }

        let mut points = Vec::with_capacity(self.points.len());
        for SweepPoint { value, reason } in self.points {
            let lo = value.interval().lo().clone();
            let hi = value.interval().hi().clone();
            points.push(SupportPoint {
                polynomial: value.poly().coeffs().to_vec(),
                interval: [Number(lo), Number(hi)],
                reason,
            });
        }

        Support {
            points,
            cells: self.cells,
            reasons: self.reasons,
        }
    }
}

/// A value at which no critical polynomial vanishes, and what there is around it.
struct General {
    t: Rational,
    around: Around,
}

fn is_strictly_between(value: &Algebraic, left: &Algebraic, right: Option<&Algebraic>) -> bool {
    let mut value = value.clone();
    if value.cmp_exact(&mut left.clone()) != Ordering::Greater {
        return false;
    }

    right.is_none_or(|right| value.cmp_exact(&mut right.clone()) == Ordering::Less)
}

/// A polynomial without multiple roots that has the roots of all of these.
fn squarefree_product(polynomials: &[Poly]) -> Poly {
    let mut product = Poly::from_ints(&[1]);
    for p in polynomials {
        let p = p.squarefree();
        let shared = product.gcd(&p);
        // Exact: the gcd divides.
        product = &product * &p.exact_div(&shared).unwrap_or(p);
    }

    product
}

/// Narrows the interval of a point until the checker can read signs of its reason there, and the
/// sign of the derivative of its polynomial.
fn narrow(value: &mut Algebraic, reason: &Exact) {
    // Signs at the point are read off remainders whose long coefficients nearly cancel.
    let bits = (2 * longest_coefficient(reason)).clamp(WIDTH_BITS, MAX_WIDTH_BITS);
    let unit = Rational::from_integer(Integer::from(1) << bits);
    let width = (value.interval().mid() + Rational::one()) / unit;
    value.refine_to(&width);

    while !value.interval().is_point() && derivative_sign(value) == 0 {
        value.refine();
    }
}

/// The sign of the derivative on the interval of a point, 0 if not certain.
fn derivative_sign(value: &Algebraic) -> i8 {
    let derivative = value.poly().derivative();
    value.interval().horner(&derivative).certain_sign()
}

/// Narrows the intervals of two different numbers until they have no point in common.
fn separate(left: &mut Algebraic, right: &mut Algebraic) {
    while left.interval().hi() >= right.interval().lo() {
        left.refine();
        right.refine();
    }
}

/// Bits of the longest coefficient of a reason.
fn longest_coefficient(reason: &Exact) -> u64 {
    let mut vectors: Vec<&Polynomials> = Vec::new();
    match reason {
        Exact::None(weights) => vectors.push(weights),
        Exact::Some(member) => {
            vectors.push(&member.x);
            if let Some(alone) = &member.alone {
                vectors.extend(alone.rows.iter().map(|(_, weights)| weights));
            }
        }
    }

    vectors
        .into_iter()
        .flat_map(|v| v.0.iter().flatten())
        .map(Integer::bits)
        .max()
        .unwrap_or(0)
}

/// A rational strictly between two values, `share` of the way (above the last one: that far above
/// it).
fn inside(left: &mut Algebraic, right: Option<&mut Algebraic>, share: &Rational) -> Rational {
    let Some(right) = right else {
        return left.interval().hi() + Rational::one() + share;
    };

    separate(left, right);
    let begin = left.interval().hi().clone();
    let end = right.interval().lo().clone();
    &begin + (end - &begin) * share
}
