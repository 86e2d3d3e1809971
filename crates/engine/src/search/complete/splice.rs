//! Searches the open leaves of a cover and puts what is found in their place.
//!
//! The tree of each piece is copied in preorder; a chosen open leaf is replaced by the nodes that a
//! search of its region finds (`tree`). Pieces are independent of one another, so they are searched
//! in parallel, and the result does not depend on the number of threads.
//!
//! Input: a cover that the checker has accepted, and which of its leaves to search. Output: the
//! nodes of every piece, and the values of the null vectors met. Called by `rounds`.

use super::checkpoint::{Copier, Snapshots};
use super::given::Given;
use super::options::CompleteOptions;
use super::pieces::prepared::Prepared;
use super::region::{Item, SearchRegion};
use super::shares::Shares;
use super::solutions::Solutions;
use super::tree::TreeSearch;
use mceip_check::LeafPlace;
use mceip_check::certificate::{Claim, CompleteSet, Node, Piece, RootOutcome};
use mceip_exact::Rational;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// What the search of a piece brings.
pub(super) struct SearchedPiece {
    pub(super) items: Vec<Item>,
    /// Values of the null vectors met.
    pub(super) met: Vec<f64>,
}

impl SearchedPiece {
    /// Is a region left open?
    pub(super) fn is_open(&self) -> bool {
        let mut items = self.items.iter();
        items.any(|item| matches!(item, Item::Node(Node::Open)))
    }
}

/// Which open leaves are searched, and how.
pub(super) enum Chosen {
    /// All.
    All,
    /// These, as all are.
    Again(BTreeSet<LeafPlace>),
    /// These, support by support in exact arithmetic where that can be done: what doubles have
    /// judged too well.
    Exactly(BTreeSet<LeafPlace>),
}

impl Chosen {
    fn places(&self) -> Option<&BTreeSet<LeafPlace>> {
        match self {
            Chosen::All => None,
            Chosen::Again(places) | Chosen::Exactly(places) => Some(places),
        }
    }

    fn takes(&self, place: LeafPlace) -> bool {
        match self.places() {
            Some(places) => places.contains(&place),
            None => true,
        }
    }

    /// Is a leaf of this piece chosen?
    fn meets(&self, piece: usize) -> bool {
        self.places().is_none_or(|places| {
            let mut of_piece = places.range((piece, 0)..(piece + 1, 0));
            of_piece.next().is_some()
        })
    }
}

/// One pass over the pieces of a cover.
pub(super) struct Pass<'a> {
    pub(super) given: &'a Given<'a>,
    pub(super) prepared: &'a Prepared,
    pub(super) set: &'a CompleteSet,
    pub(super) options: &'a CompleteOptions,
    pub(super) chosen: &'a Chosen,
    pub(super) shares: &'a Shares<'a>,
    /// Where copies of the trees are handed over, if anybody keeps them.
    pub(super) snapshots: Option<&'a Snapshots>,
}

/// A region still to be copied or searched, and its part of the whole search.
struct WaitingRegion {
    region: SearchRegion,
    share: f64,
}

impl Pass<'_> {
    /// The trees of all pieces, their chosen open leaves searched.
    pub(super) fn run(&self) -> Vec<SearchedPiece> {
        let indices = 0..self.set.pieces.len();
        indices.into_par_iter().map(|k| self.piece(k)).collect()
    }

    fn piece(&self, k: usize) -> SearchedPiece {
        let piece = &self.set.pieces[k];
        let is_of_shard = self
            .options
            .shard
            .is_none_or(|shard| k % shard.count == shard.index);
        if !is_of_shard || !self.chosen.meets(k) {
            return SearchedPiece {
                items: piece.tree.iter().cloned().map(Item::Node).collect(),
                met: Vec::new(),
            };
        }

        let expansion = self.prepared.view.expansion(piece.anchor);
        let mut search = TreeSearch {
            view: &self.prepared.view,
            expansions: std::slice::from_ref(expansion),
            shares: self.shares,
            budget: self.options.nodes_per_piece,
            items: Vec::new(),
            aim: Solutions {
                given: self.given,
                met: Vec::new(),
                copier: self.snapshots.map(|snapshots| Copier::new(snapshots, k)),
            },
        };

        self.splice(&mut search, k);
        if let Some(copier) = search.aim.copier {
            copier.finish(&search.items, piece.tree.len());
        }

        SearchedPiece {
            items: search.items,
            met: search.aim.met,
        }
    }

    /// The lower end of a piece: the upper end of the one before.
    fn begin(&self, k: usize) -> Rational {
        let before = k
            .checked_sub(1)
            .and_then(|p| self.set.pieces[p].max.clone());
        match before {
            Some(number) => number.0,
            None => self.given.window().min().clone(),
        }
    }

    /// Copies the tree of a piece in preorder; a chosen open leaf is replaced by what the search of
    /// its region finds.
    fn splice(&self, search: &mut TreeSearch<'_, Solutions<'_>>, k: usize) {
        let piece = &self.set.pieces[k];
        let hi = piece.max.as_ref().map(|number| number.0.clone());
        let mut waiting = vec![WaitingRegion {
            region: SearchRegion::whole(self.begin(k), hi, search.view.order()),
            share: 1.0 / self.set.pieces.len() as f64,
        }];

        for (place, node) in piece.tree.iter().enumerate() {
            // The checker has accepted the tree, so it does not end early.
            let Some(here) = waiting.pop() else {
                return;
            };

            if let Some(parts) = here.region.parts(node, search.view) {
                search.items.push(Item::Node(node.clone()));
                let share = here.share / 2.0;
                waiting.extend(parts.map(|region| WaitingRegion { region, share }));
            } else if *node == Node::Open && self.chosen.takes((k, place)) {
                if let Some(copier) = &mut search.aim.copier {
                    copier.begin(place, &search.items);
                }
                self.search_leaf(search, &here, piece);
            } else {
                self.copy_leaf(search, &here, node);
            }
        }
    }

    /// Searches the region of an open leaf.
    fn search_leaf(
        &self,
        search: &mut TreeSearch<'_, Solutions<'_>>,
        leaf: &WaitingRegion,
        piece: &Piece,
    ) {
        // A piece beyond the anchors has no matrices to search with.
        let is_enclosed = piece.anchor.is_some() || search.expansion().is_everywhere();
        let is_exact = matches!(self.chosen, Chosen::Exactly(_));
        if is_enclosed && !is_exact {
            search.region(&leaf.region, leaf.share);
        } else {
            search.by_support(&leaf.region, leaf.share);
        }
    }

    fn copy_leaf(
        &self,
        search: &mut TreeSearch<'_, Solutions<'_>>,
        leaf: &WaitingRegion,
        node: &Node,
    ) {
        search.items.push(Item::Node(node.clone()));
        if *node != Node::Open {
            self.shares.closed(leaf.share, false);
        }
    }
}

/// The piece with these nodes, its claims numbered in the certificate's list, which grows by those
/// that are new.
pub(crate) fn numbered(piece: &Piece, items: Vec<Item>, claims: &mut Vec<Claim>) -> Piece {
    let mut tree = Vec::with_capacity(items.len());
    for item in items {
        tree.push(match item {
            Item::Node(node) => node,
            Item::Claimed(mut root, claim) => {
                root.outcome = RootOutcome::Claim(number(claims, *claim));
                Node::Root(root)
            }
        });
    }

    Piece {
        tree,
        ..piece.clone()
    }
}

/// The claim's number, appended if it is new.
pub(super) fn number(claims: &mut Vec<Claim>, claim: Claim) -> usize {
    if let Some(number) = claims.iter().position(|c| *c == claim) {
        return number;
    }

    claims.push(claim);
    claims.len() - 1
}
