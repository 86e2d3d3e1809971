//! Thousands of random mutations of real certificates: the checker accepts only those whose
//! statement is still true. The truth is the exact enumerator's.
#![cfg(feature = "testkit")]

use crate::cover::{condensed, disagreements, fold, proved, set, trees, truth};
use mceip_check::certificate::{Certificate, Exact, Node, Polynomials, RootOutcome, Support};
use mceip_check::{Reason, Rejected, check};
use mceip_exact::{Integer, rational};
use mceip_model::{Unknown, Window};
use mceip_testkit::{known, mechanical_pencil};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// One change of a certificate's complete set; `pool` lends nodes.
fn mutate(certificate: &mut Certificate, pool: &[Node], rng: &mut ChaCha8Rng) {
    let variables = 6;
    let factor = rational(rng.random_range(1..=40), rng.random_range(1..=20));
    let s = set(certificate);
    let (p, q) = (
        rng.random_range(0..s.pieces.len()),
        rng.random_range(0..s.pieces.len()),
    );
    let (k, l) = (
        rng.random_range(0..s.pieces[p].tree.len().max(1)),
        rng.random_range(0..s.pieces[q].tree.len().max(1)),
    );
    match rng.random_range(0..14) {
        0 => s.pieces.swap(p, q),
        1 => drop(s.pieces.remove(p)),
        2 => {
            if let Some(max) = &mut s.pieces[p].max {
                max.0 *= factor;
            }
        }
        3 => {
            let tree = s.pieces[q].tree.clone();
            s.pieces[p].tree = tree;
        }
        4 if k < s.pieces[p].tree.len() => drop(s.pieces[p].tree.remove(k)),
        5 => s.pieces[p]
            .tree
            .insert(k, pool[rng.random_range(0..pool.len())].clone()),
        6 | 7 if k < s.pieces[p].tree.len() => {
            s.pieces[p].tree[k] = pool[rng.random_range(0..pool.len())].clone()
        }
        8 if k < s.pieces[p].tree.len() && l < s.pieces[q].tree.len() => {
            let node = s.pieces[q].tree[l].clone();
            s.pieces[p].tree[k] = node;
        }
        // A whole subtree by one leaf: what follows it is closed by what is left over.
        9 => {
            let end = (k + rng.random_range(1..=4)).min(s.pieces[p].tree.len());
            if k < end {
                s.pieces[p]
                    .tree
                    .splice(k..end, [pool[rng.random_range(0..pool.len())].clone()]);
            }
        }
        10 => {
            if let Some(c) = &mut s.condensation {
                let a = rng.random_range(0..c.anchors.len());
                let m = &mut c.anchors[a];
                let rows = if rng.random_range(0..2) == 0 {
                    &mut m.right[0].rows
                } else {
                    &mut m.left[0].rows
                };
                if let Some(v) = rows.iter_mut().flatten().next() {
                    *v += Integer::from(1) << rng.random_range(0..50);
                }
                if rng.random_range(0..4) == 0 {
                    c.sigma.0 *= factor;
                }
            }
        }
        _ => {
            if let Some(node) = s.pieces[p].tree.get_mut(k) {
                alter(node, variables, rng);
            }
        }
    }
}

/// A node of the same kind with other numbers.
fn alter(node: &mut Node, variables: usize, rng: &mut ChaCha8Rng) {
    let factor = rational(rng.random_range(1..=40), rng.random_range(1..=20));
    match node {
        Node::Split(at) => at.0 *= factor,
        Node::Branch(i) => *i = rng.random_range(0..=variables),
        Node::Farkas(w) => {
            let i = rng.random_range(0..w.len().max(1));
            if let Some(w) = w.get_mut(i) {
                *w = [-*w, 0, *w / 2, *w + 1, *w * 2][rng.random_range(0..5)];
            }
        }
        Node::PositiveDefinite => *node = Node::NegativeDefinite,
        Node::NegativeDefinite => *node = Node::PositiveDefinite,
        Node::Tail | Node::Open | Node::Ldl(_) => *node = Node::PositiveDefinite,
        Node::Support(leaf) => alter_support(leaf, rng),
        Node::Root(r) => match rng.random_range(0..6) {
            0 => r.outcome = RootOutcome::Absent,
            1 => r.outcome = RootOutcome::Solution,
            2 => {
                let i = rng.random_range(0..variables);
                r.outcome = [
                    RootOutcome::NegativeX(i),
                    RootOutcome::NegativeY(i),
                    RootOutcome::Claim(i),
                ][rng.random_range(0..3)]
                .clone();
            }
            3 => r.interval[rng.random_range(0..2)].0 *= factor,
            4 => r
                .right
                .iter_mut()
                .chain(&mut r.left)
                .for_each(|v| *v += Integer::from(1) << rng.random_range(0..60)),
            _ => r.pivot = rng.random_range(0..variables),
        },
    }
}

/// A point moved, dropped or with another reason; a coefficient of a reason; a proof of being alone
/// left out.
fn alter_support(leaf: &mut Support, rng: &mut ChaCha8Rng) {
    let (k, r) = (
        rng.random_range(0..leaf.points.len().max(1)),
        rng.random_range(0..leaf.reasons.len().max(1)),
    );
    match rng.random_range(0..6) {
        0 if !leaf.cells.is_empty() && k < leaf.points.len() => {
            drop((leaf.points.remove(k), leaf.cells.pop()))
        }
        1 if k < leaf.points.len() => leaf.points[k].reason = r,
        2 if !leaf.cells.is_empty() => {
            let c = rng.random_range(0..leaf.cells.len());
            leaf.cells[c] = r;
        }
        3 if k < leaf.points.len() => {
            leaf.points[k].interval[rng.random_range(0..2)].0 *=
                rational(rng.random_range(1..=9), 8)
        }
        _ => match leaf.reasons.get_mut(r) {
            Some(Exact::None(w)) => bump(w, rng),
            Some(Exact::Some(m)) if rng.random_range(0..3) == 0 => m.alone = None,
            Some(Exact::Some(m)) => bump(&mut m.x, rng),
            None => {}
        },
    }
}

fn bump(v: &mut Polynomials, rng: &mut ChaCha8Rng) {
    let i = rng.random_range(0..v.0.len().max(1));
    if let Some(p) = v.0.get_mut(i) {
        p.resize(p.len().max(1), Integer::from(0));
        p[0] += Integer::from(rng.random_range(-2..=2));
    }
}

/// `count` mutants of each of several certificates. What is accepted is compared with the
/// enumerator.
fn mutants(count: usize, seed: u64) {
    let mut problems = vec![
        fold(Window::all()),
        fold(Window::new(rational(3, 2), Some(rational(7, 2))).unwrap()),
    ];
    problems.extend(
        [known::complete_graph(3), known::path(3), known::star(2)].map(|k| k.unwrap().problem),
    );
    problems.extend((1..=3).map(|s| mechanical_pencil(4, Unknown::Mu, s).unwrap()));
    problems.extend([known::star(3), known::jordan(3, 2, true)].map(|k| k.unwrap().problem));
    problems.push(condensed().0);
    let (mut accepted, mut rejected) = (0, 0);
    let mut reasons = std::collections::BTreeSet::new();
    for (number, problem) in problems.iter().enumerate() {
        let certificate = proved(problem);
        let truth = truth(problem);
        let mut pool: Vec<Node> = trees(&certificate).map(|(_, n)| n.clone()).collect();
        pool.extend([Node::PositiveDefinite, Node::NegativeDefinite]);
        let mut rng = ChaCha8Rng::seed_from_u64(seed + number as u64);
        for _ in 0..count {
            let mut mutant = certificate.clone();
            for _ in 0..rng.random_range(1..=3) {
                if !set(&mut mutant).pieces.is_empty() {
                    mutate(&mut mutant, &pool, &mut rng);
                }
            }
            if mutant == certificate {
                continue;
            }
            match check(problem, &mutant) {
                Ok(verdict) => {
                    accepted += 1;
                    let wrong = disagreements(&verdict.cover.unwrap(), &truth);
                    assert!(
                        wrong.is_empty(),
                        "problem {number}: accepted and false: {wrong:?}\n{}\n{}",
                        problem.canonical_text(),
                        mutant.to_json()
                    );
                }
                Err(Rejected {
                    reason: Reason::Cover { fault, .. },
                    ..
                }) => {
                    rejected += 1;
                    reasons.insert(
                        format!("{fault:?}")
                            .split([' ', '{'])
                            .next()
                            .unwrap_or_default()
                            .to_string(),
                    );
                }
                Err(e) => panic!("{e}"),
            }
        }
    }
    println!(
        "{accepted} mutants accepted and true, {rejected} rejected for {} reasons: {reasons:?}",
        reasons.len()
    );
    // The campaign reaches both verdicts and most obligations of the checker.
    assert!(
        accepted > count / 10 && rejected > count && reasons.len() >= 12,
        "{accepted} {rejected} {reasons:?}"
    );
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
