//! One support through the filters, cheapest first.

use super::bernstein::{DEPTH, Piece};
use super::coefficients::{Coefficient, Coefficients};
use super::farkas::Prover;
use super::floats::Floats;
use super::integral::Integral;
use super::signs::Signs;
use super::statistics::Statistics;

/// What settles a support.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Proved: the determinant has no root in the window.
    NoRoot,
    /// Proved: a row has entries of one sign.
    RowSigns,
    /// Proved: a Farkas vector for each piece that may hold a root.
    Farkas,
    /// Not settled here: a solution, a tie, or too close to tell.
    Open,
    /// The determinant is identically zero.
    Singular,
}

impl Verdict {
    /// Is it proved that the support holds nothing?
    pub(super) fn is_empty(self) -> bool {
        matches!(self, Verdict::NoRoot | Verdict::RowSigns | Verdict::Farkas)
    }

    pub(super) fn count(self, statistics: &mut Statistics) {
        *match self {
            Verdict::NoRoot => &mut statistics.no_root,
            Verdict::RowSigns => &mut statistics.row_signs,
            Verdict::Farkas => &mut statistics.farkas,
            Verdict::Open => &mut statistics.open,
            Verdict::Singular => &mut statistics.singular,
        } += 1;
    }
}

/// What all supports share.
#[derive(Debug)]
pub(super) struct Filters {
    pub(super) integral: Integral,
    pub(super) floats: Floats,
    pub(super) signs: Signs,
    pub(super) coefficients: Coefficients,
}

/// Depths at which a proof is tried: most supports fall at the first.
const TRIED: [u32; 4] = [7, 14, 28, DEPTH];

/// Pieces of one support at most: beyond it the exact code is quicker. Where the determinant is of very different
/// sizes on the line its small values drown in the error of the large ones, over 2^DEPTH times the width of that part.
const MAX_PIECES: usize = 1 << 12;

/// Storage reused from support to support.
#[derive(Debug, Default)]
pub(super) struct Desk {
    coefficients: Vec<Coefficient>,
    prover: Prover,
    stack: Vec<Piece>,
}

impl Filters {
    /// Judges a support by the values of its determinant, `values(prime)` at the points.
    pub(super) fn judge<'v>(&self, mask: u64, values: impl Fn(usize) -> &'v [u64], desk: &mut Desk) -> Verdict {
        let primes = Coefficients::primes_for(self.integral.coefficient_bits(mask));
        self.coefficients.interpolate(self.integral.degree(mask), primes, values, &mut desk.coefficients);
        let Some((piece, at_zero)) = Piece::whole(&desk.coefficients, primes, self.floats.scale) else {
            return Verdict::Singular;
        };
        if mask != 0 && self.signs.refute(mask) {
            return Verdict::RowSigns;
        }
        let mut loaded = false;
        let mut refuted = |low: f64, high: f64, prover: &mut Prover| {
            if !loaded {
                prover.load(&self.floats, mask);
                loaded = true;
            }
            prover.refutes(&self.floats, low, high)
        };
        let mut verdict = Verdict::NoRoot;
        if at_zero > 0 && self.floats.window.0 <= 0.0 {
            if !refuted(0.0, 0.0, &mut desk.prover) {
                return Verdict::Open;
            }
            verdict = Verdict::Farkas;
        }
        desk.stack.clear();
        desk.stack.push(piece);
        let mut pieces = 0;
        while let Some(piece) = desk.stack.pop() {
            pieces += 1;
            let (low, high) = (piece.low, piece.high());
            if high < self.floats.window.0 || low > self.floats.window.1 || piece.has_no_root() {
                continue;
            }
            if TRIED.contains(&piece.depth) && refuted(low, high, &mut desk.prover) {
                verdict = Verdict::Farkas;
            } else if piece.depth == DEPTH || pieces > MAX_PIECES {
                return Verdict::Open;
            } else {
                let (left, right) = piece.halves();
                desk.stack.extend([right, left]);
            }
        }
        verdict
    }
}
