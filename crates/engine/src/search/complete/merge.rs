//! Joins the parts of a search that was shared out over several runs.
//!
//! Every part has a tree for every piece. Two trees of one region are joined from the root down: a
//! subtree in which nothing is open is taken, an open leaf gives way to whatever the other part has
//! there, and where both divide the region in the same way, their halves are joined. Where they
//! divide it differently, the subtree with fewer open leaves is taken. So no region is open that
//! some part has closed by the same divisions.

use super::Completed;
use super::error;
use super::error::CompleteError;
use super::pieces::prepared::Prepared;
use super::splice::number;
use mceip_check::Proved;
use mceip_check::certificate::{Certificate, Claim, CompleteSet, Node, Piece, RootOutcome};
use mceip_model::Problem;
use mceip_model::reduction::reduce;

/// One certificate from several of the same problem, window and pieces. The checker reads the
/// result.
///
/// # Errors
/// [`CompleteError`]: parts of another problem or window, cut into other pieces, a piece that no
/// part has searched, a certificate that the checker rejects.
pub fn merge(problem: &Problem, parts: &[Certificate]) -> Result<Completed, CompleteError> {
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
        let mut searched = (0..sets.len()).filter(|&p| sets[p].pieces[k].tree != [Node::Open]);
        let first = searched.next().ok_or(CompleteError::MissingPiece {
            piece: k,
            pieces: sets[0].pieces.len(),
        })?;

        let mut tree = Preorder::of(first, &sets[first].pieces[k].tree);
        for part in searched {
            tree = tree.joined(&Preorder::of(part, &sets[part].pieces[k].tree));
        }

        pieces.push(Piece {
            tree: tree.numbered(parts, &mut claims),
            ..sets[0].pieces[k].clone()
        });
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

    let proved = Proved::new(problem, certificate)?;
    let pencil = reduce(problem)?.pencil;
    let set = proved.certificate().complete_set.as_ref();
    let set = set.ok_or(CompleteError::NoCompleteSet)?;
    let prepared = Prepared::again(problem, &pencil, set)?;
    Completed::new(&pencil, &prepared, proved)
}

fn same_pieces(a: &CompleteSet, b: &CompleteSet) -> bool {
    if a.condensation != b.condensation || a.pieces.len() != b.pieces.len() {
        return false;
    }

    for (p, q) in a.pieces.iter().zip(&b.pieces) {
        if p.max != q.max || p.anchor != q.anchor {
            return false;
        }
    }

    true
}

/// A node of a tree, and the part that it comes from.
#[derive(Clone, Copy)]
struct PartNode<'a> {
    part: usize,
    node: &'a Node,
}

/// A tree in preorder, with what is known of each subtree.
///
/// Nothing here relies on the tree being well formed: an end that is not there is the end of the
/// list, and the checker refuses what comes of it.
struct Preorder<'a> {
    nodes: Vec<PartNode<'a>>,
    /// Where the subtree of each node ends.
    end: Vec<usize>,
    /// Open leaves of each subtree.
    open: Vec<usize>,
}

impl<'a> Preorder<'a> {
    fn of(part: usize, tree: &'a [Node]) -> Preorder<'a> {
        let mut nodes = Vec::with_capacity(tree.len());
        for node in tree {
            nodes.push(PartNode { part, node });
        }

        Preorder::new(nodes)
    }

    fn new(nodes: Vec<PartNode<'a>>) -> Preorder<'a> {
        let count = nodes.len();
        let mut end = vec![count; count];
        let mut open = vec![0; count];

        // Children stand behind their parent, so that they are known before it.
        for k in (0..count).rev() {
            if !nodes[k].node.is_leaf() {
                let first_child = k + 1;
                let second_child = end.get(first_child).copied().unwrap_or(count);
                end[k] = end.get(second_child).copied().unwrap_or(count);

                let open_in_first = open.get(first_child).copied().unwrap_or(0);
                let open_in_second = open.get(second_child).copied().unwrap_or(0);
                open[k] = open_in_first + open_in_second;
            } else {
                end[k] = k + 1;
                open[k] = usize::from(*nodes[k].node == Node::Open);
            }
        }

        Preorder { nodes, end, open }
    }

    /// The tree in which every region is taken from the part that has closed it, or joined.
    fn joined(&self, other: &Preorder<'a>) -> Preorder<'a> {
        let mut nodes = Vec::new();
        // Pairs of subtrees of one region that are still to be joined, the next one last.
        let mut waiting = vec![(0, 0)];
        while let Some((mine, theirs)) = waiting.pop() {
            let Some(my_node) = self.nodes.get(mine) else {
                continue;
            };
            let Some(their_node) = other.nodes.get(theirs) else {
                continue;
            };

            let both_open = self.open[mine] > 0 && other.open[theirs] > 0;
            let divide_alike = !my_node.node.is_leaf() && my_node.node == their_node.node;
            if both_open && divide_alike {
                nodes.push(*my_node);
                let my_second_half = self.end_of(mine + 1);
                let their_second_half = other.end_of(theirs + 1);
                waiting.push((my_second_half, their_second_half));
                waiting.push((mine + 1, theirs + 1));
            } else if self.is_no_worse(mine, other, theirs) {
                nodes.extend_from_slice(&self.nodes[mine..self.end[mine]]);
            } else {
                nodes.extend_from_slice(&other.nodes[theirs..other.end[theirs]]);
            }
        }

        Preorder::new(nodes)
    }

    fn end_of(&self, k: usize) -> usize {
        match self.end.get(k) {
            Some(end) => *end,
            None => self.nodes.len(),
        }
    }

    /// Has this subtree no more left to prove than the other one of the same region? An open leaf
    /// that is the whole subtree has everything left.
    fn is_no_worse(&self, mine: usize, other: &Preorder<'a>, theirs: usize) -> bool {
        let mine_untouched = *self.nodes[mine].node == Node::Open;
        let theirs_untouched = *other.nodes[theirs].node == Node::Open;
        if mine_untouched != theirs_untouched {
            return theirs_untouched;
        }

        self.open[mine] <= other.open[theirs]
    }

    /// The nodes with their references to claims turned into those of the merged list.
    fn numbered(&self, parts: &[Certificate], claims: &mut Vec<Claim>) -> Vec<Node> {
        let mut tree = Vec::new();
        for PartNode { part, node } in &self.nodes {
            let mut node = (*node).clone();
            if let Node::Root(root) = &mut node
                && let RootOutcome::Claim(own) = root.outcome
                && let Some(claim) = parts[*part].claims.get(own)
            {
                root.outcome = RootOutcome::Claim(number(claims, claim.clone()));
            }

            tree.push(node);
        }

        tree
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(first: &[Node], second: &[Node]) -> Vec<Node> {
        let tree = Preorder::of(0, first).joined(&Preorder::of(1, second));
        tree.nodes.iter().map(|n| n.node.clone()).collect()
    }

    fn branch(index: usize) -> Node {
        Node::Branch(index)
    }

    const CLOSED: Node = Node::PositiveDefinite;
    const CLOSED_OTHERWISE: Node = Node::NegativeDefinite;

    /// One part has closed the first half of a region, the other the second half: with the tree of
    /// fewer open leaves alone, one of the two would be lost.
    #[test]
    fn halves_closed_by_different_parts_are_both_kept() {
        let first = [branch(0), CLOSED, Node::Open];
        let second = [branch(0), Node::Open, branch(1), CLOSED, CLOSED_OTHERWISE];

        let tree = joined(&first, &second);

        assert_eq!(
            tree,
            [branch(0), CLOSED, branch(1), CLOSED, CLOSED_OTHERWISE]
        );
        assert_eq!(joined(&second, &first), tree);
    }

    #[test]
    fn a_closed_region_is_taken_whole_and_an_untouched_one_gives_way() {
        let closed = [branch(0), CLOSED, CLOSED];
        let untouched = [Node::Open];
        let begun = [branch(1), Node::Open, Node::Open];

        assert_eq!(joined(&begun, &closed), closed);
        assert_eq!(joined(&untouched, &begun), begun);
        assert_eq!(joined(&begun, &untouched), begun);
    }

    #[test]
    fn regions_divided_differently_are_taken_with_fewer_open_leaves() {
        let one_open = [branch(0), CLOSED, Node::Open];
        let two_open = [branch(1), branch(2), CLOSED, Node::Open, Node::Open];

        assert_eq!(joined(&one_open, &two_open), one_open);
        assert_eq!(joined(&two_open, &one_open), one_open);
    }

    /// A list that breaks off is no tree; the checker says so of what is made of it.
    #[test]
    fn a_tree_that_breaks_off_does_no_harm() {
        let broken = [branch(0), branch(1), Node::Open];

        let tree = joined(&broken, &[branch(0), Node::Open, CLOSED]);

        assert!(!tree.is_empty());
    }
}
