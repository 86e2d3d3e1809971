//! No solution for any lambda^2 >= 0 and any mu up to a bound: a cover of
//! [0, infinity) x [0, bound] x (supports) that the checker reads as `mceip-critical/1`.
//!
//! | file | what |
//! |---|---|
//! | `family` | T(t, mu) = T0(t) + mu T1(t), condensed about common anchors |
//! | `boxes` | branch and prune over boxes of (t, mu) and states |
//!
//! Doubles propose the cover, and nothing is returned as proved before the checker has accepted it.
//! Input: a system and the bound. Output: [`Outcome`]. Called by `critical`, which chooses bounds.

mod boxes;
mod family;

use crate::reduction::MuFamily;
use crate::run::Watch;
use crate::search::complete::CompleteError;
use crate::search::complete::rounds::in_threads;
use crate::search::complete::shares::Shares;
use boxes::Search;
pub(super) use boxes::{Blocked, Cause};
use family::{Family, PieceOfHalfLine};
pub(super) use family::unit_of_lambda2;
use mceip_check::audit_critical;
use mceip_check::certificate::{CriticalCertificate, CriticalNode, CriticalPiece};
use mceip_exact::Rational;
use mceip_model::file::Number;
use mceip_model::{Pencil, Problem};
use rayon::prelude::*;

/// How much work the cover may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Boxes examined in one piece of [0, infinity) before the search ends with what it has.
    pub boxes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { boxes: 200_000 }
    }
}

/// Factor on the remainders where the checker has refused what doubles held for proved, and how
/// often it is applied.
const CAUTION: f64 = 8.0;
const CAUTIOUS_ROUNDS: usize = 2;

/// What a search ends with.
pub(super) enum Outcome {
    /// The checker has accepted it.
    Absent(Box<CriticalCertificate>),
    /// The first box that could not be emptied.
    Blocked(Box<Blocked>),
    /// The checker refuses what doubles propose.
    Refused,
}

/// A system whose covers are sought.
pub(super) struct Quadrant<'a> {
    pub(super) family: &'a MuFamily,
    /// M* as a function of mu.
    pub(super) mass: &'a Pencil,
    /// MCEIP-lambda2 of the system: what a certificate belongs to.
    pub(super) problem: &'a Problem,
    pub(super) limits: Limits,
    pub(super) threads: Option<usize>,
    pub(super) watch: Watch<'a>,
}

impl Quadrant<'_> {
    /// Covers [0, infinity) x [0, below]. `values` (ascending) are values of lambda^2 about which the
    /// condensation is to be precise.
    ///
    /// # Errors
    /// [`CompleteError`]: free variables that cannot be eliminated, too many slip variables.
    pub(super) fn cover(
        &self,
        below: &Rational,
        values: &[f64],
    ) -> Result<Outcome, CompleteError> {
        let mut family = Family::new(self.family, self.mass, below, values)?;
        for _ in 0..=CAUTIOUS_ROUNDS {
            let certificate = match self.proposed(&family, below) {
                Ok(certificate) => certificate,
                Err(blocked) => return Ok(Outcome::Blocked(blocked)),
            };

            if let Ok(refused) = audit_critical(self.problem, &certificate)
                && refused.is_empty()
            {
                return Ok(Outcome::Absent(Box::new(certificate)));
            }

            family.enlarge_remainders(CAUTION);
        }

        Ok(Outcome::Refused)
    }

    /// The cover that doubles propose.
    fn proposed(
        &self,
        family: &Family,
        below: &Rational,
    ) -> Result<CriticalCertificate, Box<Blocked>> {
        let shares = Shares::new(self.watch);
        let share = 1.0 / family.pieces.len() as f64;
        let tree_of = |piece| self.tree(family, piece, below, &shares, share);
        let trees: Vec<Result<Vec<CriticalNode>, Box<Blocked>>> =
            in_threads(self.threads, || family.pieces.par_iter().map(tree_of).collect());

        let mut pieces = Vec::with_capacity(trees.len());
        for (piece, tree) in family.pieces.iter().zip(trees) {
            pieces.push(CriticalPiece {
                max: piece.hi.clone().map(Number),
                anchor: piece.anchor,
                tree: tree?,
            });
        }

        Ok(CriticalCertificate {
            problem_sha256: self.problem.sha256(),
            below: below.clone(),
            condensation: family.condensation(below),
            pieces,
        })
    }

    /// The tree of one piece.
    fn tree(
        &self,
        family: &Family,
        piece: &PieceOfHalfLine,
        below: &Rational,
        shares: &Shares<'_>,
        share: f64,
    ) -> Result<Vec<CriticalNode>, Box<Blocked>> {
        if piece.hi.is_none() && family.has_tail() {
            return Ok(vec![CriticalNode::Tail]);
        }

        let mut search = Search {
            view: family.view(),
            expansions: family.expansions(piece.anchor),
            shares,
            budget: self.limits.boxes,
            nodes: Vec::new(),
        };

        search.piece(&piece.lo, piece.hi.as_ref(), below, share)?;
        Ok(search.nodes)
    }
}

/// How many leaves a certificate has.
pub(super) fn leaves(certificate: &CriticalCertificate) -> usize {
    let nodes = certificate.pieces.iter().flat_map(|piece| &piece.tree);
    let is_leaf = |node: &&CriticalNode| {
        !matches!(
            node,
            CriticalNode::Split(_) | CriticalNode::Friction(_) | CriticalNode::Branch(_)
        )
    };
    nodes.filter(is_leaf).count()
}
