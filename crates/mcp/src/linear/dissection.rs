//! Nested dissection (George 1973): an order of elimination that keeps Cholesky factors sparse.
//!
//! The unknowns of a symmetric matrix are the nodes of a graph, its entries are the edges. A set of
//! nodes is cut into two: S separates the nodes below the cut from those above it, so that no edge
//! joins the two sides. Both sides are eliminated first, each dissected in the same way, and S
//! after them.
//!
//! The cut goes along a line: nodes are sorted by a coordinate, or, where positions are unknown, by
//! their distance in the graph from a node at one end. Nodes with the same neighbours (the degrees
//! of freedom of one mesh node) form a *group* and are never parted.
//!
//! Input: the columns of the entries of each row. Output: a tree of [`DissectionNode`]s, children
//! first. Called by `SymbolicAnalysis::new`.

use std::collections::{HashMap, VecDeque};

/// Sets of at most this many groups are not cut any further. Unit: groups.
const LEAF: usize = 24;

/// Cuts tried around the middle of a set, on either side: on a mesh cut by both diagonals every
/// second line is a separator of half the size.
const CUTS: usize = 2;

/// The group of an unknown that is not dissected.
const NO_GROUP: u32 = u32::MAX;

/// The distance of a group outside the set under work.
const OUTSIDE: u32 = u32::MAX;

/// The distance of a group of the set under work that the search has not reached.
const UNREACHED: u32 = u32::MAX - 1;

/// A node of the tree of dissection: its own unknowns, eliminated after those of its children.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DissectionNode {
    /// Own unknowns.
    pub(super) own: Vec<usize>,
    /// Indices of the children in the list, all smaller than the part's own.
    pub(super) children: Vec<usize>,
}

/// The groups of unknowns, and which of them touch each other.
struct GroupGraph {
    /// The unknowns of each group.
    members: Vec<Vec<usize>>,
    /// The groups that each group touches, ascending, without itself.
    neighbours: Vec<Vec<u32>>,
    /// The position of each group in the plane, where it is known.
    points: Vec<Option<[f64; 2]>>,
}

/// The parts in the order of elimination.
///
/// `columns[i]` lists the unknowns that unknown i touches, ascending; only those with `wanted[i]`
/// are dissected. `points[i]` is the position of unknown i in the plane, where positions are known.
pub(super) fn dissect(
    columns: &[&[usize]],
    wanted: &[bool],
    points: Option<&[[f64; 2]]>,
) -> Vec<DissectionNode> {
    let graph = GroupGraph::new(columns, wanted, points);
    let groups = graph.members.len();

    let mut dissection = Dissection {
        graph: &graph,
        side: vec![CutSide::Elsewhere; groups],
        distance: vec![OUTSIDE; groups],
        parts: vec![],
    };

    dissection.cut((0..groups as u32).collect());
    dissection.parts
}

impl GroupGraph {
    /// Groups the wanted unknowns by their lists of columns.
    fn new(columns: &[&[usize]], wanted: &[bool], points: Option<&[[f64; 2]]>) -> GroupGraph {
        let mut group_of = vec![NO_GROUP; columns.len()];
        let mut group_of_columns: HashMap<&[usize], u32> = HashMap::new();
        let mut members: Vec<Vec<usize>> = Vec::new();

        for unknown in 0..columns.len() {
            if !wanted[unknown] {
                continue;
            }

            let next = members.len() as u32;
            let group = *group_of_columns.entry(columns[unknown]).or_insert(next);
            if group == next {
                members.push(Vec::new());
            }

            members[group as usize].push(unknown);
            group_of[unknown] = group;
        }

        let mut neighbours = Vec::with_capacity(members.len());
        let mut positions = Vec::with_capacity(members.len());

        for group in &members {
            let first = group[0];
            neighbours.push(groups_touched(columns[first], group_of[first], &group_of));
            positions.push(points.map(|points| points[first]));
        }

        GroupGraph {
            members,
            neighbours,
            points: positions,
        }
    }
}

/// The groups of these unknowns other than `own`, ascending.
fn groups_touched(unknowns: &[usize], own: u32, group_of: &[u32]) -> Vec<u32> {
    let groups = unknowns.iter().map(|&unknown| group_of[unknown]);
    let mut others: Vec<u32> = groups
        .filter(|&group| group != NO_GROUP && group != own)
        .collect();

    others.sort_unstable();
    others.dedup();
    others
}

/// Where a group lies during one cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CutSide {
    /// Below the cut.
    Below,
    /// In the separator of the cut.
    Separator,
    /// Anywhere else. All groups are marked so between two uses of the marks.
    Elsewhere,
}

/// A group with the coordinate or distance by which its set is sorted.
#[derive(Debug, Clone, Copy)]
struct Keyed {
    key: f64,
    group: u32,
}

/// A cut of a sorted set.
struct Cut {
    /// Number of groups below it.
    at: usize,
    /// Groups above it that touch one below it.
    separator: Vec<u32>,
}

/// A dissection under way.
struct Dissection<'g> {
    graph: &'g GroupGraph,
    side: Vec<CutSide>,
    distance: Vec<u32>,
    parts: Vec<DissectionNode>,
}

impl Dissection<'_> {
    /// Dissects a set of groups; returns the index of its part, `None` for an empty set.
    fn cut(&mut self, set: Vec<u32>) -> Option<usize> {
        if set.len() <= LEAF {
            return self.close(&set, Vec::new());
        }

        let sorted = self.sorted(&set);
        drop(set);
        let Some(Cut { at, separator }) = self.smallest_cut(&sorted) else {
            return self.close(&groups(&sorted), Vec::new());
        };

        let below = groups(&sorted[..at]);
        let above = self.without(&sorted[at..], &separator);
        drop(sorted);

        let sides = [below, above];
        let children = sides.into_iter().filter_map(|side| self.cut(side));
        let children: Vec<usize> = children.collect();

        self.close(&separator, children)
    }

    /// Appends the part with these groups of its own; returns its index, `None` if it is empty.
    fn close(&mut self, groups: &[u32], children: Vec<usize>) -> Option<usize> {
        if groups.is_empty() && children.is_empty() {
            return None;
        }

        let mut own = Vec::new();
        for &group in groups {
            own.extend_from_slice(&self.graph.members[group as usize]);
        }

        self.parts.push(DissectionNode { own, children });
        Some(self.parts.len() - 1)
    }

    /// The set sorted by its keys, and among equal keys by the indices of the groups.
    fn sorted(&mut self, set: &[u32]) -> Vec<Keyed> {
        let keys = self.keys(set);
        let pairs = keys.into_iter().zip(set);
        let mut sorted: Vec<Keyed> = pairs.map(|(key, &group)| Keyed { key, group }).collect();

        sorted.sort_unstable_by(|a, b| a.key.total_cmp(&b.key).then(a.group.cmp(&b.group)));
        sorted
    }

    /// The cut near the middle with the smallest separator, `None` if all keys are equal.
    fn smallest_cut(&mut self, sorted: &[Keyed]) -> Option<Cut> {
        let cuts = cuts(sorted).into_iter().map(|at| Cut {
            at,
            separator: self.separator(sorted, at),
        });

        cuts.min_by_key(|cut| cut.separator.len())
    }

    /// The groups from place `at` on that touch one before it.
    fn separator(&mut self, sorted: &[Keyed], at: usize) -> Vec<u32> {
        let (below, above) = sorted.split_at(at);

        for entry in below {
            self.side[entry.group as usize] = CutSide::Below;
        }

        let touching = above.iter().filter(|entry| self.touches_below(entry.group));
        let separator = touching.map(|entry| entry.group).collect();

        for entry in below {
            self.side[entry.group as usize] = CutSide::Elsewhere;
        }
        separator
    }

    /// Does a neighbour of the group lie below the cut?
    fn touches_below(&self, group: u32) -> bool {
        for &neighbour in &self.graph.neighbours[group as usize] {
            if self.side[neighbour as usize] == CutSide::Below {
                return true;
            }
        }

        false
    }

    /// The groups of a list that are not in the separator.
    fn without(&mut self, list: &[Keyed], separator: &[u32]) -> Vec<u32> {
        for &group in separator {
            self.side[group as usize] = CutSide::Separator;
        }

        let all = list.iter().map(|entry| entry.group);
        let rest = all.filter(|&group| self.side[group as usize] != CutSide::Separator);
        let rest = rest.collect();

        for &group in separator {
            self.side[group as usize] = CutSide::Elsewhere;
        }
        rest
    }

    /// The keys of a set: coordinates along its longer side where all positions are known, else
    /// distances from one of its ends.
    fn keys(&mut self, set: &[u32]) -> Vec<f64> {
        let points = set.iter().map(|&group| self.graph.points[group as usize]);
        let points: Option<Vec<[f64; 2]>> = points.collect();

        match points {
            Some(points) => coordinates_along_the_longer_side(&points),
            None => self.distances_from_an_end(set),
        }
    }

    /// The distances in the graph from a group that is farthest from the first one of the set.
    fn distances_from_an_end(&mut self, set: &[u32]) -> Vec<f64> {
        let end = self.farthest(set, set[0]);
        self.farthest(set, end);

        let mut keys = Vec::with_capacity(set.len());
        for &group in set {
            let distance = &mut self.distance[group as usize];
            keys.push(f64::from(*distance));
            *distance = OUTSIDE;
        }
        keys
    }

    /// Sets the distances within the set from `start` by breadth-first search, [`UNREACHED`] where
    /// it does not arrive; returns a group farthest away.
    fn farthest(&mut self, set: &[u32], start: u32) -> u32 {
        for &group in set {
            self.distance[group as usize] = UNREACHED;
        }

        self.distance[start as usize] = 0;

        let mut queue = VecDeque::from([start]);
        let mut last = start;

        while let Some(group) = queue.pop_front() {
            last = group;
            let next = self.distance[group as usize] + 1;

            for &neighbour in &self.graph.neighbours[group as usize] {
                let distance = &mut self.distance[neighbour as usize];
                if *distance == UNREACHED {
                    *distance = next;
                    queue.push_back(neighbour);
                }
            }
        }
        last
    }
}

/// The groups of a sorted list, in its order.
fn groups(list: &[Keyed]) -> Vec<u32> {
    list.iter().map(|entry| entry.group).collect()
}

/// One coordinate of each point: that in which the points extend farther, x where both are equal.
fn coordinates_along_the_longer_side(points: &[[f64; 2]]) -> Vec<f64> {
    let is_upright = extent(points, 1) > extent(points, 0);
    let axis = usize::from(is_upright);
    points.iter().map(|point| point[axis]).collect()
}

/// The largest less the smallest coordinate of the points along an axis.
fn extent(points: &[[f64; 2]], axis: usize) -> f64 {
    let mut low = f64::INFINITY;
    let mut high = f64::NEG_INFINITY;

    for point in points {
        low = point[axis].min(low);
        high = point[axis].max(high);
    }

    high - low
}

/// Up to [`CUTS`] places on either side of the middle of a sorted list at which the key changes.
fn cuts(sorted: &[Keyed]) -> Vec<usize> {
    let key_changes = |place: &usize| sorted[*place].key > sorted[*place - 1].key;
    let middle = (sorted.len() / 2).max(1);

    let upwards = (middle..sorted.len()).filter(key_changes).take(CUTS);
    let downwards = (1..middle).rev().filter(key_changes).take(CUTS);
    upwards.chain(downwards).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of n x n points, each touching its eight neighbours.
    fn grid(n: usize) -> Vec<Vec<usize>> {
        let mut touch = Vec::new();
        for a in 0..n * n {
            let near =
                (0..n * n).filter(|b| (a / n).abs_diff(b / n) <= 1 && (a % n).abs_diff(b % n) <= 1);
            touch.push(near.collect());
        }

        touch
    }

    fn slices(touch: &[Vec<usize>]) -> Vec<&[usize]> {
        touch.iter().map(Vec::as_slice).collect()
    }

    /// Every unknown once, children before parents, and what a subtree touches outside is in parts
    /// above it.
    fn assert_dissection(touch: &[Vec<usize>], parts: &[DissectionNode]) {
        let mut part_of = vec![usize::MAX; touch.len()];
        let mut parent = vec![usize::MAX; parts.len()];

        for (p, part) in parts.iter().enumerate() {
            for &child in &part.children {
                parent[child] = p;
            }
            assert!(part.children.iter().all(|&c| c < p));
            for &i in &part.own {
                assert_eq!(std::mem::replace(&mut part_of[i], p), usize::MAX);
            }
        }

        for (a, list) in touch.iter().enumerate() {
            for &b in list {
                let low = part_of[a].min(part_of[b]);
                let high = part_of[a].max(part_of[b]);
                assert!(is_above(&parent, high, low), "{a}");
            }
        }
    }

    /// Is `high` the part `low` or one of its ancestors?
    fn is_above(parent: &[usize], high: usize, mut low: usize) -> bool {
        while low < high {
            low = parent[low];
        }

        low == high
    }

    #[test]
    fn a_grid_is_cut_along_lines() {
        let n = 20;
        let touch = grid(n);
        let all = vec![true; n * n];
        let points: Vec<[f64; 2]> = (0..n * n)
            .map(|a| [(a / n) as f64, 1.5 * (a % n) as f64])
            .collect();

        let with = dissect(&slices(&touch), &all, Some(&points));
        assert_dissection(&touch, &with);

        let last = with.last().unwrap();
        assert_eq!(last.own.len(), n);

        let column = last.own[0] % n;
        assert!(
            last.own.iter().all(|a| a % n == column),
            "a line across the longer side"
        );

        let without = dissect(&slices(&touch), &all, None);
        assert_dissection(&touch, &without);
        assert!(without.last().unwrap().own.len() <= 2 * n);
    }

    #[test]
    fn two_bodies_one_clique_and_nothing() {
        let chains: Vec<Vec<usize>> = (0..100usize)
            .map(|a| {
                (0..100)
                    .filter(|b| a / 50 == b / 50 && a.abs_diff(*b) <= 1)
                    .collect()
            })
            .collect();
        let parts = dissect(&slices(&chains), &[true; 100], None);

        assert_dissection(&chains, &parts);

        let clique = vec![(0..90).collect::<Vec<usize>>(); 90];
        let mut all_but_one = [true; 90];
        all_but_one[7] = false;
        let parts = dissect(&slices(&clique), &all_but_one, None);

        assert_eq!(parts.iter().map(|p| p.own.len()).sum::<usize>(), 89);

        let parts = dissect(&slices(&clique[..3]), &[false; 3], None);
        assert!(parts.is_empty());
    }
}
