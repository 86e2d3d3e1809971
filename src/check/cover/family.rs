//! The pencil on the complementarity variables as a family of matrices over an interval: its two
//! ends, and how far the matrices between may be from them.
//!
//! Numbers are integers in units of 2^-128 after each row has been divided by a power of two that
//! makes its largest entry of A less than one; what is cut off is counted as a radius.

use super::CoverFault;
use super::expanded::Expanded;
use super::short::Short;
use crate::check::pencil::Rows;
use crate::exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// A dense square integer matrix, by rows.
pub(super) type Matrix = Vec<Vec<Integer>>;

/// Fraction bits kept of each entry of a row scaled to below one.
const FRACTION_BITS: u64 = 128;

/// T(t) for t between two values: convex combinations of (m[0] +- r[0]) and (m[1] +- r[1]), all in
/// units of 1 / `scale`. At an infinite end m[1] is the direction B.
pub(super) struct Ends {
    pub(super) m: [Matrix; 2],
    pub(super) r: [Matrix; 2],
    /// (t1 - t0) T'(t) lies within this of m[1] - m[0].
    pub(super) slope: Matrix,
    pub(super) scale: Integer,
    pub(super) infinite: bool,
}

/// The pencil over the window.
pub(super) enum Family {
    /// A + tB.
    Linear(Linear),
    /// The condensed pencil about several anchors, and what [`Expanded::short`] gives for each.
    Condensed(Vec<(Expanded, Option<[Short; 2]>)>),
}

/// A + tB with a radius per row for what was cut off.
pub(super) struct Linear {
    a: Matrix,
    b: Matrix,
    radius: Vec<Integer>,
    /// A and B in short numbers.
    short: Option<[Short; 2]>,
}

impl Family {
    /// The ends over [lo, hi] (`None`: infinity).
    pub(super) fn ends(&self, anchor: Option<usize>, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        match self {
            Family::Linear(linear) => Ok(linear.ends(lo, hi)),
            Family::Condensed(list) => {
                let (expanded, _) = anchor.and_then(|k| list.get(k)).ok_or(CoverFault::Anchor { anchors: list.len(), got: anchor })?;
                expanded.ends(lo, hi)
            }
        }
    }

    /// The same in short numbers, where the family is linear: T_0 + tT_1 is (q T_0 + p T_1) / q at t = p / q >= 0,
    /// and T_1 at infinity.
    pub(super) fn short(&self, anchor: Option<usize>, lo: &Rational, hi: Option<&Rational>) -> Option<[Short; 2]> {
        let parts = match self {
            Family::Linear(linear) => &linear.short,
            Family::Condensed(list) => anchor.and_then(|k| list.get(k)).map_or(&None, |(_, short)| short),
        };
        let [a, b] = parts.as_ref()?;
        let at = |t: &Rational| a.combine(t.denom(), b, t.numer());
        let upper = match hi {
            Some(hi) => at(hi),
            None => a.combine(&Integer::zero(), b, &Integer::one()),
        };
        Some([at(lo)?, upper?])
    }
}

impl Ends {
    /// Both ends in short numbers.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        let all: Vec<usize> = (0..self.slope.len()).collect();
        let of = |end: usize| Short::of(&self.m[end], &self.r[end], &all);
        Some([of(0)?, of(1)?])
    }
}

impl Linear {
    /// The pencil of a problem without free variables.
    pub(super) fn of(rows: &Rows) -> Linear {
        let n = rows.order();
        let mut linear = Linear { a: Vec::new(), b: Vec::new(), radius: Vec::new(), short: None };
        for row in &rows.rows {
            let bits = largest_bits(row.iter().map(|(_, a, _)| a)).max(1);
            let (mut a, mut b) = (vec![Integer::zero(); n], vec![Integer::zero(); n]);
            for (j, a_j, b_j) in row {
                a[*j] = shift(a_j, FRACTION_BITS as i64 - bits as i64);
                b[*j] = shift(b_j, FRACTION_BITS as i64 - bits as i64);
            }
            linear.a.push(a);
            linear.b.push(b);
            linear.radius.push(Integer::from(u8::from(bits > FRACTION_BITS)));
        }
        let (all, radius): (Vec<usize>, Matrix) = ((0..n).collect(), linear.radius.iter().map(|r| vec![r.clone(); n]).collect());
        let [a, b] = [&linear.a, &linear.b].map(|m| Short::of(m, &radius, &all));
        linear.short = a.zip(b).map(|(a, b)| [a, b]);
        linear
    }

    fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Ends {
        let n = self.a.len();
        let common = lo.denom().lcm(hi.unwrap_or(lo).denom());
        let at = |t: &Rational| {
            let (p, q) = (t.numer() * (&common / t.denom()), &common);
            let m: Matrix = (0..n).map(|i| (0..n).map(|j| q * &self.a[i][j] + &p * &self.b[i][j]).collect()).collect();
            let r = (0..n).map(|i| vec![(q + p.abs()) * &self.radius[i]; n]).collect();
            (m, r)
        };
        let by_row = |factor: &Integer| (0..n).map(|i| vec![factor * &self.radius[i]; n]).collect::<Matrix>();
        let (m0, r0) = at(lo);
        let (m1, r1, slope) = match hi {
            Some(hi) => {
                let (m1, r1) = at(hi);
                let width = ((hi - lo) * Rational::from_integer(common.clone())).to_integer(); // common clears both
                (m1, r1, by_row(&width))
            }
            None => (self.b.clone(), by_row(&Integer::one()), by_row(&Integer::zero())),
        };
        Ends { m: [m0, m1], r: [r0, r1], slope, scale: common << FRACTION_BITS, infinite: hi.is_none() }
    }
}

/// v 2^bits, rounded down.
pub(super) fn shift(v: &Integer, bits: i64) -> Integer {
    if bits >= 0 { v << bits.unsigned_abs() } else { v >> bits.unsigned_abs() }
}

/// Bit length of the largest number.
pub(super) fn largest_bits<'a>(values: impl Iterator<Item = &'a Integer>) -> u64 {
    values.map(Integer::bits).max().unwrap_or(0)
}
