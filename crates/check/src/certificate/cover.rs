//! The claim *complete set* as data: a cover of (supports) x (window), each part with its proof.
//!
//! The window is cut into *pieces*, intervals of the unknown t. Each piece has a binary tree. A
//! node of the tree stands for a *region*: an interval of t and a state for each complementarity
//! variable, undecided, at zero (x_i = 0; "rest" in the file format) or in the support (x_i > 0,
//! y_i = 0; "moving" in the file format). An inner node divides its region in two, by a cut of the
//! interval or by the two states of one variable, and a leaf proves what its region holds. Every
//! solution has a value of t and a support, so it lies in a region of some leaf.
//!
//! The checker (`crate::cover`) computes regions itself: the file holds cuts, branches and proofs
//! only. The normative text is `spec/certificates.md`; symbols are explained there and in the
//! modules of the checker, one for each kind of leaf.

use super::{Integer, IntegerRow, Number, Regular, integer_rows, integers, object};
use mceip_model::file::{HasWords, WordOrKind};
use num_traits::Signed as _;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::sync::Arc;

/// All solutions in the certificate's window: a cover, or what is left of one (open leaves).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CompleteSet {
    /// How the free variables were eliminated; absent where there are none.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub condensation: Option<Condensation>,
    /// Consecutive intervals from the lower to the upper end of the window.
    #[serde(deserialize_with = "pieces_over_values")]
    pub pieces: Vec<Piece>,
}

impl CompleteSet {
    /// Is each piece closed by one leaf that says that the symmetric part of the matrix, its rows
    /// scaled, is positive definite? Then, once accepted, the matrix is a P-matrix in the window.
    pub(crate) fn is_positive_definite(&self) -> bool {
        let is_closed = |piece: &Piece| match &piece.tree[..] {
            [Node::PositiveDefinite] => true,
            // A weight that is not positive is an absence as well, and no P-matrix.
            [Node::WeightedDefinite(weights)] => weights.iter().all(|&weight| weight > 0),
            // Negative factors are an absence as well, and no P-matrix.
            [Node::Ldl(ldl)] => ldl.is_positive(),
            _ => false,
        };
        !self.pieces.is_empty() && self.pieces.iter().all(is_closed)
    }
}

/// One interval of the unknown and the tree that covers it; in `mceip-critical/1` the tree covers
/// an interval of friction as well.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// Upper end, where the next piece begins; null for infinity, but not absent.
    #[serde(deserialize_with = "present")]
    pub max: Option<Number>,
    /// The anchor of the condensation that encloses the pencil here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor: Option<usize>,
    /// The tree in preorder.
    #[serde(deserialize_with = "nodes")]
    pub tree: Vec<Node>,
}

/// A number or null: a missing field is refused.
fn present<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Number>, D::Error> {
    Option::deserialize(d)
}

fn nodes<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<Node>, D::Error> {
    let nodes = Vec::<WordOrKind<Node>>::deserialize(d)?;
    Ok(nodes.into_iter().map(|node| node.0).collect())
}

/// What the branches of a tree say of a complementarity variable in a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariableState {
    /// Nothing: both x_i = 0 and x_i > 0 are in the region.
    Undecided,
    /// x_i = 0.
    AtZero,
    /// x_i > 0, y_i = 0.
    InSupport,
}

/// A node of the tree, in preorder. Leaves prove that nothing lies in them, or exactly what.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Node {
    /// Cuts the interval of values: the lower part follows, then the upper part.
    Split(Number),
    /// Cuts the interval of friction: the lower part follows, then the upper part.
    Friction(Number),
    /// Decides a complementarity variable: x_i = 0 follows, then x_i > 0.
    Branch(usize),
    /// Weights w, one per complementarity variable: w >= 0 off the support and w'T < 0 on all
    /// variables that may be positive, so 0 <= w'y = w'Tx < 0 (Farkas, Gordan).
    Farkas(Vec<i64>),
    /// sym(T) is positive definite on the variables that may be positive: x'Tx = x'y = 0 leaves
    /// x = 0 only.
    PositiveDefinite,
    /// sym(T) is negative definite on the variables that may be positive.
    NegativeDefinite,
    /// Weights d of any sign, one per complementarity variable: sym(DT), D = diag(d), is positive
    /// definite on the variables that may be positive: x'DTx = sum_i d_i x_i y_i = 0 leaves x = 0
    /// only.
    WeightedDefinite(Vec<i64>),
    /// sym(A + tB) of the pencil as given is definite on the free variables and on those that may
    /// be positive, by exact factors.
    #[serde(deserialize_with = "object::one")]
    Ldl(Box<Ldl>),
    /// The condensation's tail begins at or below this region.
    Tail,
    /// Every variable is decided, and the pencil has at most one null vector on the support.
    #[serde(deserialize_with = "object::one")]
    Root(Box<Root>),
    /// Every variable is decided: what there is at every value of the interval, exactly.
    #[serde(deserialize_with = "object::one")]
    Support(Box<Support>),
    /// Every variable is decided, and the pencil is regular on the support everywhere in the
    /// region.
    #[serde(deserialize_with = "object::one")]
    Regular(Box<Regular>),
    /// Not decided.
    Open,
}

impl Node {
    /// The word of the kind in a file.
    pub fn kind(&self) -> &'static str {
        match self {
            Node::Split(_) => "split",
            Node::Friction(_) => "friction",
            Node::Branch(_) => "branch",
            Node::Farkas(_) => "farkas",
            Node::PositiveDefinite => "positive_definite",
            Node::NegativeDefinite => "negative_definite",
            Node::WeightedDefinite(_) => "weighted_definite",
            Node::Ldl(_) => "ldl",
            Node::Tail => "tail",
            Node::Root(_) => "root",
            Node::Support(_) => "support",
            Node::Regular(_) => "regular",
            Node::Open => "open",
        }
    }

    /// Does the node close its region? The others divide it in two.
    pub fn is_leaf(&self) -> bool {
        match self {
            Node::Split(_) | Node::Friction(_) | Node::Branch(_) => false,
            Node::Farkas(_)
            | Node::PositiveDefinite
            | Node::NegativeDefinite
            | Node::WeightedDefinite(_)
            | Node::Ldl(_)
            | Node::Tail
            | Node::Root(_)
            | Node::Support(_)
            | Node::Regular(_)
            | Node::Open => true,
        }
    }

    /// Does a tree have such nodes: one over an interval of friction as well, or one over values
    /// alone?
    ///
    /// Soundness hangs on this: `ldl`, `root` and `support` prove something of one friction only,
    /// and an open region is no absence.
    pub(crate) fn fits(&self, has_friction: bool) -> bool {
        match self {
            Node::Friction(_) | Node::Regular(_) => has_friction,
            Node::Ldl(_) | Node::Root(_) | Node::Support(_) | Node::Open => !has_friction,
            Node::Split(_)
            | Node::Branch(_)
            | Node::Farkas(_)
            | Node::PositiveDefinite
            | Node::NegativeDefinite
            | Node::WeightedDefinite(_)
            | Node::Tail => true,
        }
    }
}

impl HasWords for Node {
    fn is_word(&self) -> bool {
        matches!(
            self,
            Node::PositiveDefinite | Node::NegativeDefinite | Node::Tail | Node::Open
        )
    }
}

/// Pieces whose trees cover values alone.
fn pieces_over_values<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<Piece>, D::Error> {
    pieces_with_nodes(d, false)
}

/// Pieces whose trees cover an interval of friction as well.
pub(super) fn pieces_over_friction<'de, D: Deserializer<'de>>(
    d: D,
) -> Result<Vec<Piece>, D::Error> {
    pieces_with_nodes(d, true)
}

fn pieces_with_nodes<'de, D: Deserializer<'de>>(
    d: D,
    has_friction: bool,
) -> Result<Vec<Piece>, D::Error> {
    let pieces: Vec<Piece> = object::list(d)?;
    let mut nodes = pieces.iter().flat_map(|piece| &piece.tree);
    match nodes.find(|node| !node.fits(has_friction)) {
        None => Ok(pieces),
        Some(node) => {
            let message = format!("expected a node of this format, got {}", node.kind());
            Err(D::Error::custom(message))
        }
    }
}

/// Proof that T(t) restricted to the support has one null vector at most (up to scale, over the
/// interval of the leaf and `interval` together), and what that vector is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Root {
    /// The variable of the support whose component is set to 1.
    pub pivot: usize,
    /// Interval in which the value lies.
    pub interval: [Number; 2],
    /// Approximate inverse of T on the support without the pivot, in units of
    /// 2^-`inverse_exponent`.
    #[serde(with = "integer_rows")]
    pub inverse: Vec<Vec<Integer>>,
    /// Binary exponent of `inverse`.
    pub inverse_exponent: u32,
    /// Approximate left null vector on the support without the pivot, in units of 2^-`exponent`.
    #[serde(with = "integers")]
    pub left: Vec<Integer>,
    /// Approximate right null vector, likewise.
    #[serde(with = "integers")]
    pub right: Vec<Integer>,
    /// Binary exponent of `left` and `right`.
    pub exponent: u32,
    /// What follows from it.
    #[serde(deserialize_with = "outcome")]
    pub outcome: RootOutcome,
}

fn outcome<'de, D: Deserializer<'de>>(d: D) -> Result<RootOutcome, D::Error> {
    Ok(WordOrKind::deserialize(d)?.0)
}

/// What the only null vector of a leaf is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RootOutcome {
    /// A solution: it exists, x > 0 and y > 0 strictly.
    Solution,
    /// The Schur complement has the same sign at both ends: there is no null vector.
    Absent,
    /// Component of x that is not positive: no solution.
    NegativeX(usize),
    /// Component of y that is negative: no solution.
    NegativeY(usize),
    /// The solution of the claim with this number in the certificate, so nothing else is here.
    Claim(usize),
    /// In a region that reaches to infinity: this vector, an entry per variable of the pencil, is a
    /// null vector of the pencil's limit there, so nothing is here.
    Infinity(#[serde(with = "integers")] Vec<Integer>),
}

impl HasWords for RootOutcome {
    fn is_word(&self) -> bool {
        matches!(self, RootOutcome::Solution | RootOutcome::Absent)
    }
}

/// All solutions of one support over a closed interval: it is cut at `points`, and each point and
/// each open cell between two points (or from the last one to infinity) has its reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Ascending; the first is the lower end of the interval, the last the upper end unless that is
    /// infinite.
    #[serde(deserialize_with = "object::list")]
    pub points: Vec<SupportPoint>,
    /// The reason of each cell, a number in `reasons`.
    pub cells: Vec<usize>,
    /// Reasons; one may serve several points and cells.
    pub reasons: Vec<Exact>,
}

/// A real algebraic number and what there is at it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SupportPoint {
    /// Integer polynomial that vanishes there, constant term first.
    #[serde(with = "integers")]
    pub polynomial: Vec<Integer>,
    /// Isolates the root, as in [`super::ExactSolution::interval`].
    pub interval: [Number; 2],
    /// A number in [`Support::reasons`].
    pub reason: usize,
}

/// What there is at a value (or at every value of a cell), and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Exact {
    /// No solution: weights w(t), one polynomial per variable of the pencil, with w'y >= 0 and
    /// w'Tx < 0 for every x with this support (Farkas).
    None(Polynomials),
    /// Solutions with exactly this support.
    #[serde(deserialize_with = "object::one")]
    Some(Box<Member>),
}

/// A solution, and possibly that it is the only one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Member {
    /// x(t), one polynomial per variable of the pencil.
    pub x: Polynomials,
    /// Proof that at each value it is the only one up to its factor; without it, one of a cone.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alone: Option<Alone>,
}

/// Proof that x_k determines every other active x_j.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Alone {
    /// A variable k of the support.
    pub pivot: usize,
    /// An active j and weights l(t), one polynomial per variable of the pencil, with l'T = c e_j +
    /// d e_k on the active columns, c not zero. For each j one with l = 0 off the active rows, or
    /// two with c > 0 and c < 0, and l >= 0 on rows off the support where y = 0 and l = 0 on the
    /// others.
    pub rows: Vec<(usize, Polynomials)>,
}

/// A vector of integer polynomials, each with its constant term first.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Polynomials(#[serde(with = "integer_rows")] pub Vec<Vec<Integer>>);

/// Exact factors of sym(A + tB) on the free variables and those that may be positive, at both ends;
/// at an infinite end of sym(B).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ldl {
    /// At the lower end.
    #[serde(deserialize_with = "object::one")]
    pub lower: LdlFactor,
    /// At the upper end.
    #[serde(deserialize_with = "object::one")]
    pub upper: LdlFactor,
}

impl Ldl {
    /// Are these factors of a positive definite matrix? The signs of an accepted leaf are the same
    /// at both ends.
    fn is_positive(&self) -> bool {
        let first = self.lower.diagonal.first();
        first.is_some_and(|d| d.0.is_positive())
    }
}

/// L D L' with a unit lower triangular L.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LdlFactor {
    /// Row i holds the i entries of L left of the diagonal.
    pub rows: Vec<Vec<Number>>,
    /// D.
    pub diagonal: Vec<Number>,
}

/// Elimination of the free variables f by F(t) = T_ff(t), enclosed without inverting F.
///
/// A certificate for every friction of an interval has other anchors and another tail
/// ([`super::CriticalCondensation`]): F and T_fs do not depend on the friction.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(deserialize = "A: Deserialize<'de>, T: Deserialize<'de>")
)]
pub struct Condensation<A = Anchor, T = Tail> {
    /// sigma > 0 with A_ff - sigma I positive semidefinite.
    pub sigma: Number,
    /// Approximate Cholesky factor of A_ff - sigma I.
    #[serde(deserialize_with = "object::one")]
    pub stiffness_factor: Factor,
    /// tau >= 0 with B_ff - tau I positive semidefinite.
    pub mass_sigma: Number,
    /// Approximate Cholesky factor of B_ff - tau I, where that is neither zero nor a non-negative
    /// diagonal.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_factor: Option<Factor>,
    /// Centres at which the condensed pencil is expanded.
    #[serde(deserialize_with = "object::list")]
    pub anchors: Vec<A>,
    /// Proof that nothing lies above some value, for [`Node::Tail`].
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tail: Option<T>,
}

/// Above `from` the symmetric part of the whole pencil, free variables included, is definite.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tail {
    /// Where it begins.
    pub from: Number,
    /// Approximate Cholesky factor of sym(A + from B).
    #[serde(deserialize_with = "object::one")]
    pub factor: Factor,
    /// Approximate Cholesky factor of sym(B), where that is neither zero nor a non-negative
    /// diagonal.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_factor: Option<Factor>,
}

/// A lower triangular matrix, row by row from its first stored column to the diagonal, in units of
/// 2^-`exponent`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Factor {
    /// First stored column of each row.
    pub first: Vec<usize>,
    /// Stored entries of each row.
    pub rows: Vec<IntegerRow>,
    /// Binary exponent.
    pub exponent: u32,
}

/// Approximations in powers of (t - center): `right[k]` of F^-1 T_fs, `left[k]` of F^-1 T_sf'; each
/// a matrix with a row per free and a column per complementarity variable, in units of
/// 2^-`exponent`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Anchor {
    /// The value expanded about; of a reversed anchor its reciprocal.
    pub center: Number,
    /// Does it expand B + sA in powers of s - center, s = 1 / t? Such an anchor reaches to
    /// infinity.
    #[serde(default, skip_serializing_if = "is_false")]
    pub reversed: bool,
    /// Coefficients of the right solutions.
    #[serde(deserialize_with = "object::list")]
    pub right: Vec<IntegerMatrix>,
    /// Coefficients of the left solutions.
    #[serde(deserialize_with = "object::list")]
    pub left: Vec<IntegerMatrix>,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde wants a reference")]
pub(super) fn is_false(v: &bool) -> bool {
    !v
}

/// A dense integer matrix by rows, in units of 2^-`exponent`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IntegerMatrix {
    /// Binary exponent.
    pub exponent: u32,
    /// Rows; copies of a certificate share them.
    pub rows: Arc<Vec<IntegerRow>>,
}
