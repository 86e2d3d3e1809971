//! Forged covers of the last interval: what the checker accepts is true, and most of it it rejects.
//!
//! `complete` closes random pencils to infinity, also by reversed anchors where the mass is
//! indefinite. Changes of these anchors and of the last piece's leaves are either rejected or
//! compared with the exact enumerator, so that a checker that forgets an obligation of the last
//! interval accepts something that is not there.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, family_disagreements, set, truth};
use mceip_check::AcceptedCover;
use mceip_check::certificate::{
    Anchor, Certificate, CompleteSet, IntegerMatrix, Node, Root, RootOutcome,
};
use mceip_check::check;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{Options, complete};
use mceip_exact::{Integer, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Problem, Unknown, Window};
use mceip_oracle::Enumeration;
use mceip_testkit::generators::tails::{Mass, tails};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::Instant;

/// A change of a certificate that differs from it.
struct Forgery {
    name: String,
    /// Does it change a reversed anchor itself?
    is_of_reversed_anchor: bool,
    certificate: Certificate,
}

/// Forgeries of one certificate; a change that changes nothing is none.
struct Forge<'a> {
    good: &'a Certificate,
    forgeries: Vec<Forgery>,
}

impl Forge<'_> {
    fn anchor(&mut self, name: &str, anchor: usize, change: fn(&mut Anchor)) {
        let mut forged = self.good.clone();
        let condensation = set(&mut forged).condensation.as_mut().unwrap();
        change(&mut condensation.anchors[anchor]);
        self.push(name.into(), true, forged);
    }

    fn set(&mut self, name: &str, change: impl FnOnce(&mut CompleteSet)) {
        let mut forged = self.good.clone();
        change(set(&mut forged));
        self.push(name.into(), false, forged);
    }

    /// Another node in the tree of the last piece.
    fn last_tree(&mut self, name: String, at: usize, node: Node) {
        let mut forged = self.good.clone();
        let last_piece = set(&mut forged).pieces.last_mut().unwrap();
        last_piece.tree[at] = node;
        self.push(name, false, forged);
    }

    fn push(&mut self, name: String, is_of_reversed_anchor: bool, certificate: Certificate) {
        if certificate != *self.good {
            self.forgeries.push(Forgery {
                name,
                is_of_reversed_anchor,
                certificate,
            });
        }
    }
}

/// The forgeries that a certificate has room for, each with a name.
fn forgeries(good: &Certificate, order: usize) -> Vec<Forgery> {
    let mut forge = Forge {
        good,
        forgeries: Vec::new(),
    };

    for anchor in reversed_anchors(good) {
        forge_anchor(&mut forge, anchor);
    }

    forge_last_piece(&mut forge, order);
    let mut forgeries = forge.forgeries;

    // A window that reaches further down.
    let mut wider = good.clone();
    wider.window = Window::new(whole(0), None).unwrap();
    forgeries.push(Forgery {
        name: "window".into(),
        is_of_reversed_anchor: false,
        certificate: wider,
    });
    forgeries
}

fn reversed_anchors(certificate: &Certificate) -> Vec<usize> {
    let set = certificate.complete_set.as_ref().unwrap();
    let Some(condensation) = &set.condensation else {
        return Vec::new();
    };
    let numbered = condensation.anchors.iter().enumerate();
    let reversed = numbered.filter(|(_, anchor)| anchor.reversed);
    reversed.map(|(number, _)| number).collect()
}

fn forge_anchor(forge: &mut Forge<'_>, number: usize) {
    forge.anchor("flag", number, |anchor| anchor.reversed = false);
    forge.anchor("center", number, |anchor| {
        anchor.center = Number(&anchor.center.0 * whole(3) + rational(1, 7));
    });
    forge.anchor("right", number, |anchor| forge_row(&mut anchor.right[0]));
    forge.anchor("left", number, |anchor| forge_row(&mut anchor.left[0]));

    forge.set("mass", |set| {
        let condensation = set.condensation.as_mut().unwrap();
        condensation.mass_sigma.0 *= whole(1000);
    });
    forge.set("all reversed", |set| {
        for piece in &mut set.pieces {
            piece.anchor = Some(number);
        }
    });
    forge.set("none reversed", |set| {
        for piece in &mut set.pieces {
            if piece.anchor == Some(number) {
                piece.anchor = Some(0);
            }
        }
    });
}

/// The first row v becomes 1 - v.
fn forge_row(matrix: &mut IntegerMatrix) {
    let row = matrix.rows[0].iter();
    matrix.rows[0] = row.map(|entry| Integer::from(1) - &*entry).collect();
}

/// Leaves of the last piece get another outcome, or another leaf in their place.
fn forge_last_piece(forge: &mut Forge<'_>, order: usize) {
    let own = forge.good.complete_set.as_ref().unwrap();
    let all_leaves = own.pieces.iter().flat_map(|piece| &piece.tree);
    let lent: Vec<&Node> = all_leaves.filter(|node| is_leaf(node)).take(4).collect();
    let last_tree = &own.pieces.last().unwrap().tree;

    for (at, node) in last_tree.iter().enumerate() {
        if !is_leaf(node) {
            continue;
        }
        if let Node::Root(root) = node {
            forge_outcome(forge, at, root, order);
        }
        for &other in &lent {
            forge.last_tree(format!("leaf {at}"), at, other.clone());
        }
    }
}

fn is_leaf(node: &Node) -> bool {
    !matches!(node, Node::Split(_) | Node::Branch(_))
}

fn forge_outcome(forge: &mut Forge<'_>, at: usize, root: &Root, order: usize) {
    let absent = with_outcome(root, RootOutcome::Absent);
    forge.last_tree(format!("absent {at}"), at, absent);

    let solution = with_outcome(root, RootOutcome::Solution);
    forge.last_tree(format!("solution {at}"), at, solution);

    for vector in [[1, 1, 1, 1, 1, 1], [0; 6], [2, -1, 3, 0, 1, 0]] {
        let x = vector[..order].iter().map(|&v| Integer::from(v)).collect();
        let at_infinity = with_outcome(root, RootOutcome::Infinity(x));
        forge.last_tree(format!("infinity {at}"), at, at_infinity);
    }
}

fn with_outcome(root: &Root, outcome: RootOutcome) -> Node {
    let mut changed = root.clone();
    changed.outcome = outcome;
    Node::Root(Box::new(changed))
}

#[test]
fn what_is_accepted_of_forged_tails_is_true() {
    let judged = judged(&[0, 1, 2, 3, 4, 6, 7]);
    assert!(judged.rejected > 50, "{judged:?}");
    assert!(judged.rejected > judged.accepted, "{judged:?}");
    assert!(judged.of_reversed_anchors >= 10, "{judged:?}");
}

/// `cargo test --release --test checker -- --ignored --nocapture complete_infinity_forged::`
#[test]
#[ignore = "a minute in the dev profile"]
fn what_is_accepted_of_many_forged_tails_is_true() {
    let all_cases: Vec<usize> = (0..12).collect();
    let judged = judged(&all_cases);
    assert!(judged.rejected > 1000, "{judged:?}");
    assert!(judged.rejected > judged.accepted, "{judged:?}");
    assert!(judged.of_reversed_anchors >= 10, "{judged:?}");
}

/// How many forgeries were judged, and how.
#[derive(Debug, Default)]
struct Judged {
    rejected: usize,
    accepted: usize,
    of_reversed_anchors: usize,
}

fn judged(cases: &[usize]) -> Judged {
    let mut judged = Judged::default();
    for &number in cases {
        let started = Instant::now();
        let case = Case::draw(number);
        for forgery in forgeries(&case.good, case.order) {
            if case.is_accepted(&forgery) {
                judged.accepted += 1;
            } else {
                judged.rejected += 1;
            }
            judged.of_reversed_anchors += usize::from(forgery.is_of_reversed_anchor);
        }
        println!("{}: {:?}", case.name, started.elapsed());
    }

    println!(
        "{} rejected, {} accepted, all true; {} forged reversed anchors",
        judged.rejected, judged.accepted, judged.of_reversed_anchors
    );
    judged
}

/// A problem on a half line with the answers of the enumerator, there and on [0, infinity).
struct Case {
    name: String,
    order: usize,
    problem: Problem,
    whole_line: Problem,
    good: Certificate,
    truth: Enumeration,
    truth_of_whole_line: Enumeration,
}

impl Case {
    fn draw(number: usize) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(91_000 + number as u64);
        let mass = [Mass::Coupled, Mass::Indefinite, Mass::Partial][number % 3];
        let pencil = tails(&mut rng, 2 + number % 3, number / 3 % 3, mass).unwrap();
        let order = pencil.order();
        let name = format!("{number} {mass:?} order {order}");

        let window = Window::new(rational(rng.random_range(1..40), 8), None).unwrap();
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap();
        let whole_line = problem.clone().with_window(Window::all());

        let options = Options {
            pieces: 4,
            ..Options::default()
        };
        let found = complete(&problem, &options, &Watch::nobody()).unwrap();

        Case {
            name,
            order,
            good: found.proved.into_certificate(),
            truth: truth(&problem),
            truth_of_whole_line: truth(&whole_line),
            problem,
            whole_line,
        }
    }

    /// What is accepted is compared with the enumerator, on the window of the forgery.
    fn is_accepted(&self, forgery: &Forgery) -> bool {
        let has_own_window = forgery.certificate.window == *self.problem.window();
        let problem = if has_own_window {
            &self.problem
        } else {
            &self.whole_line
        };
        let truth = if has_own_window {
            &self.truth
        } else {
            &self.truth_of_whole_line
        };

        let Ok(verdict) = check(problem, &forgery.certificate) else {
            return false;
        };
        let wrong = falsehoods(problem, &verdict.cover.unwrap(), truth);
        assert!(
            wrong.is_empty(),
            "{}: {}: {wrong:?}",
            self.name,
            forgery.name
        );
        true
    }
}

fn falsehoods(problem: &Problem, cover: &AcceptedCover, truth: &Enumeration) -> Vec<String> {
    let mut wrong = disagreements(cover, truth);
    if !truth.is_plain_list() {
        wrong.extend(family_disagreements(problem, cover));
    }
    wrong
}
