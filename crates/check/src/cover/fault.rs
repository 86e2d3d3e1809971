//! What is wrong with a cover, as typed values: obligation, index, expected, got.
//!
//! Each variant is an obligation of `spec/certificates.md`. [`crate::Reason::Cover`] adds the piece
//! and the node of its tree at which it fails.

use mceip_exact::Rational;

/// The obligation of a complete set that fails.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CoverFault {
    /// Pieces do not follow one another from the window's lower to its upper end.
    #[error("pieces: expected them to rise to {expected}, got {got}")]
    PieceEnd {
        /// Where the piece should end or above what.
        expected: String,
        /// Where it ends.
        got: String,
    },
    /// A tree ends before its last region is closed.
    #[error("tree: expected {regions} more region(s) to be closed, got the end")]
    Truncated {
        /// Regions without a node.
        regions: usize,
    },
    /// Nodes beyond the end of a tree.
    #[error("tree: expected the end, got a further node")]
    Trailing,
    /// A kind of node that trees of this format have not.
    #[error("tree: expected a kind of node of this format, got {kind}")]
    Kind {
        /// Its word in a file.
        kind: &'static str,
    },
    /// A cut outside its interval.
    #[error("split: expected a value inside ({lo}, {hi}), got {got}")]
    Cut {
        /// Lower end of the interval.
        lo: Rational,
        /// Upper end of the interval.
        hi: String,
        /// The cut.
        got: Rational,
    },
    /// A cut outside the interval of friction.
    #[error("friction: expected a value inside ({lower}, {higher}), got {got}")]
    FrictionCut {
        /// Lower end of the interval.
        lower: Rational,
        /// Upper end of the interval.
        higher: Rational,
        /// The cut.
        got: Rational,
    },
    /// A branch on no open complementarity variable.
    #[error("branch: expected an open complementarity variable, got {index}")]
    Branch {
        /// The index.
        index: usize,
    },
    /// A piece that reaches to infinity, where the data have radii.
    #[error(
        "piece [{lo}, {hi}]: expected an interval that is bounded in the variable of its anchor, \
         because the data have radii (a reversed anchor above 0 reaches to infinity)"
    )]
    Unbounded {
        /// Its lower end.
        lo: Rational,
        /// Its upper end.
        hi: String,
    },
    /// Wrong number of weights or vector entries.
    #[error("{what}: expected {expected} entries, got {got}")]
    Length {
        /// Which list.
        what: &'static str,
        /// Entries wanted.
        expected: usize,
        /// Entries found.
        got: usize,
    },
    /// A negative weight of a variable for which y_i = 0 is not known.
    #[error("farkas: expected weight {index} >= 0 off the moving set, got {got}")]
    NegativeWeight {
        /// The variable.
        index: usize,
        /// Its weight.
        got: i64,
    },
    /// A column of w'T that is not negative.
    #[error("farkas: expected (w'T)[{index}] < 0 at the {end} end, got the bound {got}")]
    NotNegative {
        /// The variable.
        index: usize,
        /// `lower` or `upper`.
        end: &'static str,
        /// Upper bound of the entry, in the units of the scaled row.
        got: Rational,
    },
    /// w'T may vanish on a variable where it has to be negative.
    #[error("farkas: expected a strict sign on one moving variable or on all that may move")]
    NotStrict,
    /// The symmetric part is not proved definite.
    #[error("{leaf}: expected pivot {index} of the symmetric part {expected} at the {end} end")]
    NotDefinite {
        /// `positive_definite`, `negative_definite`, `weighted_definite` or `ldl`, as in the file.
        leaf: &'static str,
        /// The variable.
        index: usize,
        /// `> 0` or `< 0`; `>= 0` or `<= 0` at infinity.
        expected: &'static str,
        /// `lower` or `upper`.
        end: &'static str,
    },
    /// A root leaf of an undecided variable, of an empty support, or from zero to infinity.
    #[error(
        "root: expected every index decided, something moving, \
         and a lower end above 0 where the interval is infinite"
    )]
    RootTooEarly,
    /// The pivot is not in the support.
    #[error("root: expected a moving pivot, got {index}")]
    Pivot {
        /// The index.
        index: usize,
    },
    /// |I - Y T| is not below one.
    #[error("root: expected |I - Y T| < 1 over the interval, got {got}")]
    NotRegular {
        /// The norm.
        got: Rational,
    },
    /// A support that is no ascending list of slip variables.
    #[error("presence: expected ascending slip variables as the support, got {support:?}")]
    SupportList {
        /// The support.
        support: Vec<usize>,
    },
    /// (|I - Y T'| v)_i is not below v_i.
    #[error(
        "presence: expected (|I - Y T'| v)[{index}] below v[{index}] in the box, got {got} of it"
    )]
    NotContracting {
        /// The variable.
        index: usize,
        /// The quotient, or 1 where v_i is not positive.
        got: Rational,
    },
    /// The Schur complement is not monotone: there could be two roots.
    #[error(
        "root: expected the Schur complement to be monotone over the interval, \
         got a slope that may vanish"
    )]
    NotMonotone,
    /// The Schur complement does not change sign.
    #[error("root: expected the Schur complement to change sign between {lo} and {hi}")]
    NoSignChange {
        /// Lower end.
        lo: Rational,
        /// Upper end.
        hi: Rational,
    },
    /// The Schur complement is not certain to keep its sign.
    #[error(
        "root: expected the Schur complement to keep one sign over the leaf, \
         got a change or none"
    )]
    SignChange,
    /// A sign of x or y is not the one stated.
    #[error("root: expected {component}[{index}] {expected}, got another sign or none")]
    Sign {
        /// `x` or `y`.
        component: &'static str,
        /// The variable.
        index: usize,
        /// `> 0` or `< 0`.
        expected: &'static str,
    },
    /// An exact factor is not one of the matrix.
    #[error(
        "ldl: expected L D L' to be sym(A + tB) at the {end} end, \
         got another entry at ({row}, {column})"
    )]
    Factor {
        /// Row, by the problem's index.
        row: usize,
        /// Column.
        column: usize,
        /// `lower` or `upper`.
        end: &'static str,
    },
    /// The root's interval is reversed or leaves the window.
    #[error("root: expected an interval within the window, got [{a}, {b}]")]
    Interval {
        /// Lower end.
        a: Rational,
        /// Upper end.
        b: Rational,
    },
    /// An outcome that the checker does not read over a half line.
    #[error(
        "root: expected absent, claim or infinity over an interval to infinity \
         without a reversed anchor, got {outcome}"
    )]
    OutcomeOnHalfLine {
        /// The outcome's word in the file.
        outcome: &'static str,
    },
    /// The vector given for infinity is not a null vector of the pencil's limit there.
    #[error("root: expected {expected} for the null vector at infinity, broken at index {index}")]
    NotAtInfinity {
        /// The obligation.
        expected: &'static str,
        /// The variable.
        index: usize,
    },
    /// The claim referred to is not a solution whose null vector belongs to the leaf.
    #[error(
        "root: expected claim {claim} to be a solution in the interval \
         whose active rows are the leaf's"
    )]
    NotTheClaim {
        /// The claim.
        claim: usize,
    },
    /// A support leaf of an undecided variable, or without points where the support is not empty,
    /// or with points where it is.
    #[error("support: expected every index decided, and points exactly if something moves")]
    SupportTooEarly,
    /// A point that is no isolated root, or out of order; the number of points: an end of the
    /// interval is not a point.
    #[error(
        "support: expected point {point} to be an isolated root above the one before, \
         the first and the last the ends of the interval"
    )]
    Point {
        /// Position among the points.
        point: usize,
    },
    /// A place names a reason that does not exist.
    #[error("support: expected a reason below {reasons}, got {reason}")]
    NoReason {
        /// What is named.
        reason: usize,
        /// How many there are.
        reasons: usize,
    },
    /// A reason does not hold at its place.
    #[error(
        "support: expected {expected} in place {place} (points are even), broken at index {index}"
    )]
    Place {
        /// Twice the point's position, or one more for the cell above it.
        place: usize,
        /// The obligation.
        expected: &'static str,
        /// The variable.
        index: usize,
    },
    /// Two leaves hold solutions of one support that could be one or two.
    #[error(
        "roots: expected solutions of support {support:?} to be apart or the same, \
         got overlapping intervals"
    )]
    Ambiguous {
        /// The support.
        support: Vec<usize>,
    },
    /// A number is larger than the checker multiplies out.
    #[error("{what}: expected at most {limit}, got {got}")]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// The bound.
        limit: u64,
        /// What was found.
        got: u64,
    },
    /// The signs of the support leaves take more work than the file's budget.
    #[error(
        "support: expected signs within the budget of the file \
         (spec/certificates.md, Limits), got more work"
    )]
    OutOfBudget,
    /// Free variables need a condensation, and none is wanted without them.
    #[error(
        "condensation: expected {}",
        if *expected {
            "one, the problem has free variables"
        } else {
            "none, the problem has no free variables"
        }
    )]
    Condensation {
        /// Is one needed?
        expected: bool,
    },
    /// The condensation's hypotheses fail.
    #[error("condensation: expected {expected}, got row {row} that breaks it")]
    Hypothesis {
        /// What must hold.
        expected: &'static str,
        /// The row.
        row: usize,
    },
    /// A piece names no anchor, or one that does not exist.
    #[error("anchor: expected one of {anchors}, got {got:?}")]
    Anchor {
        /// Number of anchors.
        anchors: usize,
        /// What the piece names.
        got: Option<usize>,
    },
}

impl CoverFault {
    /// [`CoverFault::Hypothesis`] that this row breaks.
    pub(super) fn hypothesis(expected: &'static str, row: usize) -> CoverFault {
        CoverFault::Hypothesis { expected, row }
    }

    /// [`CoverFault::TooLarge`] if `got` exceeds `limit`.
    pub(super) fn at_most(what: &'static str, limit: u64, got: u64) -> Result<(), CoverFault> {
        if got > limit {
            return Err(CoverFault::TooLarge { what, limit, got });
        }

        Ok(())
    }

    /// [`CoverFault::Length`] if a list has not the entries it should have.
    pub(super) fn length(
        what: &'static str,
        expected: usize,
        got: usize,
    ) -> Result<(), CoverFault> {
        if got != expected {
            return Err(CoverFault::Length {
                what,
                expected,
                got,
            });
        }

        Ok(())
    }
}
