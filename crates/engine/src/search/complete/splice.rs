//! Searches the open leaves of a cover and puts what is found in their place.

use crate::candidate::Candidate;
use crate::certify::Certifier;
use crate::search::complete::leaf::infinity;
use crate::search::complete::leaf::support;
use crate::search::complete::options::Options;
use crate::search::complete::pieces::prepared::Prepared;
use crate::search::complete::region::{Item, Region, State};
use crate::search::complete::shares::Shares;
use crate::search::complete::tree::Search;
use mceip_check::certificate::{Claim, CompleteSet, Node, Piece, RootOutcome};
use mceip_exact::Rational;
use mceip_model::{Pencil, Problem};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// What the search of a piece brings.
pub(super) struct Found {
    pub(super) items: Vec<Item>,
    /// Values of the null vectors met.
    pub(super) met: Vec<f64>,
}

/// Which open leaves are searched, by their places (piece, node), and how.
pub(super) enum Chosen {
    /// All.
    All,
    /// These, as all are.
    Again(BTreeSet<(usize, usize)>),
    /// These, support by support in exact arithmetic where that can be done: what doubles have
    /// judged too well.
    Exactly(BTreeSet<(usize, usize)>),
}

impl Chosen {
    fn places(&self) -> Option<&BTreeSet<(usize, usize)>> {
        match self {
            Chosen::All => None,
            Chosen::Again(places) | Chosen::Exactly(places) => Some(places),
        }
    }

    fn takes(&self, place: (usize, usize)) -> bool {
        self.places().is_none_or(|places| places.contains(&place))
    }
}

/// The trees of all pieces, their chosen open leaves searched; pieces are independent of each
/// other, so threads change nothing.
pub(super) fn all(
    problem: &Problem,
    pencil: &Pencil,
    prepared: &Prepared,
    set: &CompleteSet,
    options: &Options,
    chosen: &Chosen,
    shares: &Shares<'_>,
) -> Vec<Found> {
    let window = problem.window();
    let certifier = Certifier::new(problem, pencil);
    let certify_at = |value: f64, x: &[f64]| {
        let exact_only = pencil.free().is_empty();
        exact_only
            .then(|| {
                certifier
                    .certify(&Candidate {
                        value,
                        x: x.to_vec(),
                    })
                    .ok()
            })
            .flatten()
    };
    let is_stopped = || shares.is_cancelled();
    let decide = |moving: &[usize], lo: &Rational, hi: Option<&Rational>| {
        support::leaf(pencil, moving, lo, hi, &is_stopped)
    };
    let starts: Vec<Rational> = std::iter::once(window.min().clone())
        .chain(set.pieces.iter().map(|p| {
            p.max
                .as_ref()
                .map_or_else(|| window.min().clone(), |n| n.0.clone())
        }))
        .collect();
    let one = |(k, piece): (usize, &Piece)| {
        let mine = options.shard.is_none_or(|s| k % s.count == s.index);
        if !mine
            || chosen
                .places()
                .is_some_and(|leaves| leaves.range((k, 0)..(k + 1, 0)).next().is_none())
        {
            return Found {
                items: piece.tree.iter().cloned().map(Item::Node).collect(),
                met: Vec::new(),
            };
        }
        let expansion = prepared.view.expansion(piece.anchor);
        let limit = |moving: &[usize]| infinity::limit(pencil, moving, expansion.reversed);
        let mut search = Search {
            view: &prepared.view,
            expansion,
            limit: &limit,
            definite_from: &|lo, resting| infinity::definite_from(pencil, lo, resting),
            certify: &certify_at,
            decide: &decide,
            shares,
            budget: options.nodes_per_piece,
            items: Vec::new(),
            met: Vec::new(),
            window: (window.min().clone(), window.max().cloned()),
        };
        let share = 1.0 / set.pieces.len() as f64;
        spliced(&mut search, &starts[k], piece, share, k, chosen);
        Found {
            items: search.items,
            met: search.met,
        }
    };
    set.pieces.par_iter().enumerate().map(one).collect()
}

/// Copies the tree of piece `k` in preorder; a chosen open leaf is replaced by what a search of its
/// region finds.
fn spliced(
    search: &mut Search<'_>,
    lo: &Rational,
    piece: &Piece,
    share: f64,
    k: usize,
    chosen: &Chosen,
) {
    let hi = piece.max.as_ref().map(|n| n.0.clone());
    // A piece beyond the anchors has no matrices to search with.
    let searchable = piece.anchor.is_some() || search.expansion.is_everywhere();
    let mut stack = vec![(Region::whole(lo.clone(), hi, search.view.order()), share)];
    for (place, node) in piece.tree.iter().enumerate() {
        let Some((region, share)) = stack.pop() else {
            return;
        }; // the checker has accepted the tree
        match node {
            Node::Split(at) => {
                search.items.push(Item::Node(node.clone()));
                stack.push((
                    Region {
                        lo: at.0.clone(),
                        ..region.clone()
                    },
                    share / 2.0,
                ));
                stack.push((
                    Region {
                        hi: Some(at.0.clone()),
                        ..region
                    },
                    share / 2.0,
                ));
            }
            Node::Branch(index) => {
                search.items.push(Item::Node(node.clone()));
                let position = search
                    .view
                    .index
                    .iter()
                    .position(|i| i == index)
                    .unwrap_or(0);
                for state in [State::Moving, State::Rest] {
                    let mut child = region.clone();
                    child.states[position] = state;
                    stack.push((child, share / 2.0));
                }
            }
            Node::Open if !chosen.takes((k, place)) => search.items.push(Item::Node(Node::Open)),
            Node::Open if searchable && !matches!(chosen, Chosen::Exactly(_)) => {
                search.region(&region, share)
            }
            Node::Open => search.by_support(&region, share),
            _ => {
                search.items.push(Item::Node(node.clone()));
                search.shares.closed(share, false);
            }
        }
    }
}

/// The piece with its claims numbered in the certificate's list, which grows by those that are new.
pub(super) fn numbered(piece: &Piece, items: Vec<Item>, claims: &mut Vec<Claim>) -> Piece {
    let node = |item| match item {
        Item::Node(node) => node,
        Item::Claimed(mut root, claim) => {
            root.outcome = RootOutcome::Claim(number(claims, *claim));
            Node::Root(root)
        }
    };
    Piece {
        tree: items.into_iter().map(node).collect(),
        ..piece.clone()
    }
}

/// The claim's number, appended if it is new.
pub(super) fn number(claims: &mut Vec<Claim>, claim: Claim) -> usize {
    claims.iter().position(|c| *c == claim).unwrap_or_else(|| {
        claims.push(claim);
        claims.len() - 1
    })
}
