//! Thousands of random mutations of real certificates: the checker accepts only those whose
//! statement is still true. The truth is the exact enumerator's.
//!
//! A mutation moves, drops, doubles or exchanges pieces and nodes, or changes numbers. The floors
//! at the end say that both verdicts and a dozen obligations were reached: a campaign whose mutants
//! are all rejected at the first node would prove nothing.
#![cfg(feature = "testkit")]

use crate::cover::{condensed, disagreements, fold, proved, set, trees, truth};
use mceip_check::certificate::{
    Certificate, CompleteSet, Condensation, Exact, Node, Piece, Polynomials, Root, RootOutcome,
    Support,
};
use mceip_check::{AcceptedCover, CoverFault, Reason, check};
use mceip_exact::{Integer, Rational, rational};
use mceip_model::{Problem, Unknown, Window};
use mceip_testkit::{known, mechanical_pencil};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;

/// Indices are drawn below this number, or up to it.
const VARIABLES: usize = 6;

fn draw_factor(rng: &mut ChaCha8Rng) -> Rational {
    rational(rng.random_range(1..=40), rng.random_range(1..=20))
}

fn draw_node(pool: &[Node], rng: &mut ChaCha8Rng) -> Node {
    pool[rng.random_range(0..pool.len())].clone()
}

/// Two pieces, perhaps the same, and a node of each; the node is 0 in an empty tree.
struct Drawn {
    piece: usize,
    node: usize,
    other_piece: usize,
    other_node: usize,
}

impl Drawn {
    fn from(pieces: &[Piece], rng: &mut ChaCha8Rng) -> Self {
        let piece = rng.random_range(0..pieces.len());
        let other_piece = rng.random_range(0..pieces.len());
        let node = rng.random_range(0..pieces[piece].tree.len().max(1));
        let other_node = rng.random_range(0..pieces[other_piece].tree.len().max(1));

        Drawn {
            piece,
            node,
            other_piece,
            other_node,
        }
    }
}

/// One change of a certificate's complete set; `pool` lends nodes.
fn mutate(set: &mut CompleteSet, pool: &[Node], rng: &mut ChaCha8Rng) {
    let factor = draw_factor(rng);
    let drawn = Drawn::from(&set.pieces, rng);
    let kind = rng.random_range(0..14);

    match kind {
        0 => set.pieces.swap(drawn.piece, drawn.other_piece),
        1 => {
            set.pieces.remove(drawn.piece);
        }
        2 => move_end(&mut set.pieces[drawn.piece], &factor),
        3 => {
            let tree = set.pieces[drawn.other_piece].tree.clone();
            set.pieces[drawn.piece].tree = tree;
        }
        8 if has_both_nodes(set, &drawn) => {
            let node = set.pieces[drawn.other_piece].tree[drawn.other_node].clone();
            set.pieces[drawn.piece].tree[drawn.node] = node;
        }
        10 => {
            if let Some(condensation) = &mut set.condensation {
                alter_condensation(condensation, &factor, rng);
            }
        }
        _ => mutate_tree(
            &mut set.pieces[drawn.piece].tree,
            drawn.node,
            kind,
            pool,
            rng,
        ),
    }
}

fn move_end(piece: &mut Piece, factor: &Rational) {
    if let Some(max) = &mut piece.max {
        max.0 *= factor;
    }
}

fn has_both_nodes(set: &CompleteSet, drawn: &Drawn) -> bool {
    drawn.node < set.pieces[drawn.piece].tree.len()
        && drawn.other_node < set.pieces[drawn.other_piece].tree.len()
}

/// A change at one node of a tree, of a kind between 4 and 13.
fn mutate_tree(tree: &mut Vec<Node>, at: usize, kind: i32, pool: &[Node], rng: &mut ChaCha8Rng) {
    let has_node = at < tree.len();
    match kind {
        4 if has_node => {
            tree.remove(at);
        }
        5 => tree.insert(at, draw_node(pool, rng)),
        6 | 7 if has_node => tree[at] = draw_node(pool, rng),
        // A whole subtree by one leaf: what follows it is closed by what is left over.
        9 => {
            let end = (at + rng.random_range(1..=4)).min(tree.len());
            if at < end {
                tree.splice(at..end, [draw_node(pool, rng)]);
            }
        }
        _ => {
            if has_node {
                alter(&mut tree[at], rng);
            }
        }
    }
}

/// Another entry of an anchor, and every fourth time another sigma.
fn alter_condensation(condensation: &mut Condensation, factor: &Rational, rng: &mut ChaCha8Rng) {
    let number = rng.random_range(0..condensation.anchors.len());
    let anchor = &mut condensation.anchors[number];
    let rows = if rng.random_range(0..2) == 0 {
        &mut anchor.right[0].rows
    } else {
        &mut anchor.left[0].rows
    };
    if let Some(row) = rows.iter_mut().find(|row| !row.is_empty()) {
        let change = Integer::from(1) << rng.random_range(0..50);
        row.edit(|list| list[0] += change);
    }

    if rng.random_range(0..4) == 0 {
        condensation.sigma.0 *= factor;
    }
}

/// A node of the same kind with other numbers.
fn alter(node: &mut Node, rng: &mut ChaCha8Rng) {
    let factor = draw_factor(rng);
    match node {
        Node::Split(at) => at.0 *= factor,
        Node::Branch(variable) => *variable = rng.random_range(0..=VARIABLES),
        Node::Farkas(weights) => alter_weights(weights, rng),
        Node::PositiveDefinite => *node = Node::NegativeDefinite,
        Node::NegativeDefinite => *node = Node::PositiveDefinite,
        Node::Tail | Node::Open | Node::Ldl(_) | Node::Friction(_) | Node::Regular(_) => {
            *node = Node::PositiveDefinite;
        }
        Node::Support(leaf) => alter_support(leaf, rng),
        Node::Root(root) => alter_root(root, &factor, rng),
    }
}

fn alter_weights(weights: &mut [i64], rng: &mut ChaCha8Rng) {
    let at = rng.random_range(0..weights.len().max(1));
    if let Some(weight) = weights.get_mut(at) {
        let old = *weight;
        *weight = [-old, 0, old / 2, old + 1, old * 2][rng.random_range(0..5)];
    }
}

fn alter_root(root: &mut Root, factor: &Rational, rng: &mut ChaCha8Rng) {
    match rng.random_range(0..6) {
        0 => root.outcome = RootOutcome::Absent,
        1 => root.outcome = RootOutcome::Solution,
        2 => {
            let index = rng.random_range(0..VARIABLES);
            let choice: usize = rng.random_range(0..3);
            root.outcome = match choice {
                0 => RootOutcome::NegativeX(index),
                1 => RootOutcome::NegativeY(index),
                _ => RootOutcome::Claim(index),
            };
        }
        3 => root.interval[rng.random_range(0..2)].0 *= factor,
        4 => {
            for component in root.right.iter_mut().chain(&mut root.left) {
                *component += Integer::from(1) << rng.random_range(0..60);
            }
        }
        _ => root.pivot = rng.random_range(0..VARIABLES),
    }
}

/// A point moved, dropped or with another reason; a coefficient of a reason; a proof of being alone
/// left out.
fn alter_support(leaf: &mut Support, rng: &mut ChaCha8Rng) {
    let point = rng.random_range(0..leaf.points.len().max(1));
    let reason = rng.random_range(0..leaf.reasons.len().max(1));
    let has_point = point < leaf.points.len();
    let has_cell = !leaf.cells.is_empty();

    match rng.random_range(0..6) {
        0 if has_cell && has_point => {
            leaf.points.remove(point);
            leaf.cells.pop();
        }
        1 if has_point => leaf.points[point].reason = reason,
        2 if has_cell => {
            let cell = rng.random_range(0..leaf.cells.len());
            leaf.cells[cell] = reason;
        }
        3 if has_point => {
            let end = rng.random_range(0..2);
            leaf.points[point].interval[end].0 *= rational(rng.random_range(1..=9), 8);
        }
        _ => {
            if let Some(reason) = leaf.reasons.get_mut(reason) {
                alter_reason(reason, rng);
            }
        }
    }
}

fn alter_reason(reason: &mut Exact, rng: &mut ChaCha8Rng) {
    match reason {
        Exact::None(weights) => alter_coefficient(weights, rng),
        Exact::Some(member) if rng.random_range(0..3) == 0 => member.alone = None,
        Exact::Some(member) => alter_coefficient(&mut member.x, rng),
    }
}

fn alter_coefficient(vector: &mut Polynomials, rng: &mut ChaCha8Rng) {
    let at = rng.random_range(0..vector.0.len().max(1));
    if let Some(polynomial) = vector.0.get_mut(at) {
        polynomial.resize(polynomial.len().max(1), Integer::from(0));
        polynomial[0] += Integer::from(rng.random_range(-2..=2));
    }
}

/// Problems with several solutions, degenerate ones, and one with free variables.
fn problems() -> Vec<Problem> {
    let around_both = Window::new(rational(3, 2), Some(rational(7, 2))).unwrap();
    let mut problems = vec![fold(Window::all()), fold(around_both)];

    let graphs = [known::complete_graph(3), known::path(3), known::star(2)];
    problems.extend(graphs.map(|answer| answer.unwrap().problem));

    problems.extend((1..=3).map(|seed| mechanical_pencil(4, Unknown::Mu, seed).unwrap()));

    let degenerate = [known::star(3), known::jordan(3, 2, true)];
    problems.extend(degenerate.map(|answer| answer.unwrap().problem));

    problems.push(condensed().0);
    problems
}

/// What the checker said of the mutants.
#[derive(Debug, Default)]
struct Judged {
    accepted: usize,
    rejected: usize,
    faults: BTreeSet<String>,
}

/// `count` mutants of each of several certificates. What is accepted is compared with the
/// enumerator.
fn mutants(count: usize, seed: u64) {
    let mut judged = Judged::default();
    for (number, problem) in problems().iter().enumerate() {
        let mut rng = ChaCha8Rng::seed_from_u64(seed + number as u64);
        judge_mutants(problem, count, &mut rng, &mut judged);
    }

    println!(
        "{} mutants accepted and true, {} rejected for {} reasons: {:?}",
        judged.accepted,
        judged.rejected,
        judged.faults.len(),
        judged.faults
    );
    // The campaign reaches both verdicts and most obligations of the checker.
    assert!(judged.accepted > count / 10, "{judged:?}");
    assert!(judged.rejected > count, "{judged:?}");
    assert!(judged.faults.len() >= 12, "{judged:?}");
}

fn judge_mutants(problem: &Problem, count: usize, rng: &mut ChaCha8Rng, judged: &mut Judged) {
    let certificate = proved(problem);
    let truth = truth(problem);
    let nodes = trees(&certificate);
    let mut pool: Vec<Node> = nodes.iter().map(|(_, node)| (*node).clone()).collect();
    pool.extend([Node::PositiveDefinite, Node::NegativeDefinite]);

    for _ in 0..count {
        let mutant = draw_mutant(&certificate, &pool, rng);
        if mutant == certificate {
            continue;
        }
        match verdict(problem, &mutant) {
            Ok(cover) => {
                judged.accepted += 1;
                let wrong = disagreements(&cover, &truth);
                assert!(
                    wrong.is_empty(),
                    "accepted and false: {wrong:?}\n{}\n{}",
                    problem.canonical_text(),
                    mutant.to_json()
                );
            }
            Err(fault) => {
                judged.rejected += 1;
                judged.faults.insert(variant(&fault));
            }
        }
    }
}

/// One to three mutations.
fn draw_mutant(certificate: &Certificate, pool: &[Node], rng: &mut ChaCha8Rng) -> Certificate {
    let mut mutant = certificate.clone();
    for _ in 0..rng.random_range(1..=3) {
        let set = set(&mut mutant);
        if !set.pieces.is_empty() {
            mutate(set, pool, rng);
        }
    }
    mutant
}

fn verdict(problem: &Problem, mutant: &Certificate) -> Result<AcceptedCover, CoverFault> {
    match check(problem, mutant) {
        Ok(accepted) => Ok(accepted.cover.unwrap()),
        Err(rejected) => match rejected.reason {
            Reason::Cover { fault, .. } => Err(fault),
            other => panic!("{other}"),
        },
    }
}

/// The name of the fault without its numbers.
fn variant(fault: &CoverFault) -> String {
    let text = format!("{fault:?}");
    let name = text.split([' ', '{']).next();
    name.unwrap_or_default().to_string()
}

#[test]
fn what_is_accepted_of_three_thousand_mutants_is_true() {
    mutants(350, 1);
}

#[test]
#[ignore = "minutes"]
fn what_is_accepted_of_a_hundred_thousand_mutants_is_true() {
    mutants(12_000, 1000);
}
