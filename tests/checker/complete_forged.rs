//! Forged covers that `complete` has written: what an audit opens, and claims of other solutions.
//!
//! A forgery of each obligation is a file of `spec/corpus`; random mutations are in
//! `complete_mutants.rs`. Where a forgery may be true by luck, an acceptance is compared with the
//! exact enumerator.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, proved};
use mceip_check::certificate::{Certificate, Node, Piece, RootOutcome};
use mceip_check::{CoverFault, Reason, audit, check};
use mceip_model::reduction::reduce;
use mceip_model::{Problem, Unknown};
use mceip_testkit::{degenerate, enumerated, known, mechanical_pencil};

fn pieces(certificate: &mut Certificate) -> &mut Vec<Piece> {
    &mut certificate.complete_set.as_mut().unwrap().pieces
}

/// A node by its piece and its place in the tree.
fn node_at(certificate: &mut Certificate, (piece, node): (usize, usize)) -> &mut Node {
    &mut pieces(certificate)[piece].tree[node]
}

/// All nodes of all pieces, with their places.
fn nodes(certificate: &Certificate) -> Vec<((usize, usize), &Node)> {
    let pieces = &certificate.complete_set.as_ref().unwrap().pieces;
    let trees = pieces.iter().enumerate();
    trees
        .flat_map(|(piece, part)| {
            let nodes = part.tree.iter().enumerate();
            nodes.map(move |(node, content)| ((piece, node), content))
        })
        .collect()
}

/// What an audit opens is what `check` refuses one by one, and it opens nothing else.
#[test]
fn an_audit_opens_exactly_the_leaves_that_fail() {
    let problem = mechanical_pencil(6, Unknown::Mu, 4).unwrap();
    let certificate = proved(&problem);
    let nothing_refused = check(&problem, &certificate).map(|accepted| (accepted, Vec::new()));
    assert_eq!(audit(&problem, &certificate), nothing_refused);

    // Every third Farkas leaf without weights.
    let leaves = nodes(&certificate).into_iter();
    let farkas = leaves.filter(|(_, node)| matches!(node, Node::Farkas(_)));
    let forged_places: Vec<(usize, usize)> = farkas.map(|(place, _)| place).step_by(3).collect();
    assert!(forged_places.len() > 1);

    let mut forged = certificate.clone();
    for &place in &forged_places {
        *node_at(&mut forged, place) = Node::Farkas(vec![0; 6]);
    }

    let (accepted, refused) = audit(&problem, &forged).unwrap();
    assert_eq!(refused, forged_places);

    // The same leaves called open.
    for &place in &forged_places {
        *node_at(&mut forged, place) = Node::Open;
    }

    assert_eq!(accepted, check(&problem, &forged).unwrap());
    assert_eq!(accepted.cover.unwrap().open.len(), forged_places.len());

    // A hole in the tree is not mended.
    pieces(&mut forged)[0].tree.pop();
    assert!(audit(&problem, &forged).is_err());
}

#[test]
fn the_claim_of_another_solution_is_rejected() {
    let mut refused = 0;
    for problem in problems_with_claims() {
        let certificate = proved(&problem);
        for (place, node) in nodes(&certificate) {
            let Node::Root(root) = node else { continue };
            let RootOutcome::Claim(own) = root.outcome else {
                continue;
            };

            for other in other_claims(&certificate, own) {
                let mut forged_root = root.clone();
                forged_root.outcome = RootOutcome::Claim(other);
                let mut forged = certificate.clone();
                *node_at(&mut forged, place) = Node::Root(forged_root);
                refused += usize::from(is_refused_for_claim(&problem, &forged, other));
            }
        }
    }

    assert!(refused > 2, "{refused}");
}

/// Degenerate pencils and known ones, without free variables.
fn problems_with_claims() -> Vec<Problem> {
    let instances = degenerate().unwrap();
    let mut problems: Vec<Problem> = instances.into_iter().map(|i| i.problem).collect();
    for n in 2..=4 {
        let known = [known::path(n), known::star(n), known::jordan(n, 2, true)];
        let solved = known.into_iter().filter_map(Result::ok);
        problems.extend(solved.map(|answer| answer.problem));
    }

    problems.retain(|problem| reduce(problem).unwrap().pencil.free().is_empty());
    problems
}

/// The claims of a certificate that say something else than this one, and the first number that is
/// no claim.
fn other_claims(certificate: &Certificate, own: usize) -> Vec<usize> {
    let claims = &certificate.claims;
    let mut others: Vec<usize> = (0..claims.len())
        .filter(|&claim| claims[claim] != claims[own])
        .collect();
    others.push(claims.len());
    others
}

/// A solution with another support may have a null vector of this leaf too: then the forgery is
/// accepted, and nothing is lost.
fn is_refused_for_claim(problem: &Problem, forged: &Certificate, claim: usize) -> bool {
    match check(problem, forged) {
        Ok(accepted) => {
            let wrong = disagreements(&accepted.cover.unwrap(), &enumerated(problem));
            assert_eq!(wrong, [""; 0], "{}", problem.canonical_text());
            false
        }
        Err(rejected) => {
            let Reason::Cover { fault, .. } = rejected.reason else {
                panic!("{}", rejected.reason)
            };
            assert_eq!(fault, CoverFault::NotTheClaim { claim });
            true
        }
    }
}
