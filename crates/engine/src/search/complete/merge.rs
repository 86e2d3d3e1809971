//! Joins the parts of a search that was shared out over several runs.

use super::error;
use super::error::CompleteError;
use super::splice::number;
use mceip_check::certificate::{Certificate, Claim, CompleteSet, Node, Piece, RootOutcome};
use mceip_check::{AcceptedCover, check};
use mceip_model::Problem;

/// One certificate from several of the same problem, window and pieces: of each piece the tree with
/// the fewest open leaves. The checker reads the result.
///
/// # Errors
/// [`CompleteError`]: parts of another problem or window, cut into other pieces, a piece that no
/// part has searched, a certificate that the checker rejects.
pub fn merge(
    problem: &Problem,
    parts: &[Certificate],
) -> Result<(Certificate, AcceptedCover), CompleteError> {
    let first = parts.first().ok_or(CompleteError::NoParts)?;
    for part in parts {
        error::same_problem(problem, part)?;
    }
    let sets: Vec<&CompleteSet> = parts
        .iter()
        .map(|p| p.complete_set.as_ref().ok_or(CompleteError::NoCompleteSet))
        .collect::<Result<_, _>>()?;
    if let Some(part) = sets.iter().position(|s| !same_pieces(sets[0], s)) {
        return Err(CompleteError::OtherPieces { part });
    }
    let mut claims: Vec<Claim> = Vec::new();
    let mut pieces = Vec::new();
    for k in 0..sets[0].pieces.len() {
        let open = |s: &&CompleteSet| {
            s.pieces[k]
                .tree
                .iter()
                .filter(|n| **n == Node::Open)
                .count()
        };
        // The first of those with the fewest open leaves; an untouched piece is one open leaf.
        let touched = (0..sets.len()).filter(|&p| sets[p].pieces[k].tree != [Node::Open]);
        let best = touched
            .min_by_key(|&p| open(&sets[p]))
            .ok_or(CompleteError::MissingPiece {
                piece: k,
                pieces: sets[0].pieces.len(),
            })?;
        pieces.push(renumbered(
            &sets[best].pieces[k],
            &parts[best].claims,
            &mut claims,
        ));
    }
    let complete_set = Some(CompleteSet {
        condensation: sets[0].condensation.clone(),
        pieces,
    });
    let certificate = Certificate {
        claims,
        complete_set,
        ..first.clone()
    };
    let cover = check(problem, &certificate)?
        .cover
        .ok_or(CompleteError::NoCompleteSet)?;
    Ok((certificate, cover))
}

fn same_pieces(a: &CompleteSet, b: &CompleteSet) -> bool {
    let same = |p: &Piece, q: &Piece| p.max == q.max && p.anchor == q.anchor;
    a.condensation == b.condensation
        && a.pieces.len() == b.pieces.len()
        && a.pieces.iter().zip(&b.pieces).all(|(p, q)| same(p, q))
}

/// A part's piece with its references to claims turned into those of the merged list.
fn renumbered(piece: &Piece, own: &[Claim], claims: &mut Vec<Claim>) -> Piece {
    let mut piece = piece.clone();
    for node in &mut piece.tree {
        if let Node::Root(root) = node
            && let RootOutcome::Claim(k) = root.outcome
            && let Some(claim) = own.get(k)
        {
            root.outcome = RootOutcome::Claim(number(claims, claim.clone()));
        }
    }
    piece
}
