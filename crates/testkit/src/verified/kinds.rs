//! The kinds of evidence that a certificate holds, by the names of chapter 5.
//!
//! The verified checker has its theorems kind by kind; counts and floors by kind say how far it
//! reaches.

use mceip_check::certificate::{Anchor, Certificate, Claim, Condensation, Node, RootOutcome};
use num_traits::Zero as _;
use std::collections::BTreeSet;

/// The kinds in a certificate, each once.
pub fn kinds_of(certificate: &Certificate) -> BTreeSet<&'static str> {
    let mut kinds: BTreeSet<&'static str> = certificate.claims.iter().map(of_claim).collect();

    let Some(set) = &certificate.complete_set else {
        return kinds;
    };
    if let Some(condensation) = &set.condensation {
        kinds.extend(of_condensation(condensation));
    }
    for piece in &set.pieces {
        kinds.extend(piece.tree.iter().map(of_node));
    }
    kinds
}

fn of_claim(claim: &Claim) -> &'static str {
    match claim {
        Claim::ExactSolution(_) => "exact_solution",
        Claim::LiftedSolution(_) => "lifted_solution",
        Claim::EnclosedSolution(_) => "enclosed_solution",
    }
}

fn of_node(node: &Node) -> &'static str {
    match node {
        Node::Root(root) => of_outcome(&root.outcome),
        other => other.kind(),
    }
}

fn of_outcome(outcome: &RootOutcome) -> &'static str {
    match outcome {
        RootOutcome::Solution => "root: solution",
        RootOutcome::Absent => "root: absent",
        RootOutcome::NegativeX(_) => "root: negative_x",
        RootOutcome::NegativeY(_) => "root: negative_y",
        RootOutcome::Claim(_) => "root: claim",
        RootOutcome::Infinity(_) => "root: infinity",
    }
}

/// A kind for each anchor; without anchors the condensation serves its tail only.
fn of_condensation(condensation: &Condensation) -> BTreeSet<&'static str> {
    condensation.anchors.iter().map(of_anchor).collect()
}

/// One coefficient on the right and two on the left, about 0: the free rows do not depend on t.
fn of_anchor(anchor: &Anchor) -> &'static str {
    let is_constant =
        anchor.center.0.is_zero() && anchor.right.len() <= 1 && anchor.left.len() <= 2;

    if anchor.reversed {
        "anchor: reversed"
    } else if is_constant {
        "anchor: constant rows"
    } else {
        "anchor: powers of t"
    }
}
