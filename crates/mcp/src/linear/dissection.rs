//! Nested dissection (George 1973): which unknowns separate the others, again and again.
//!
//! A part is cut at a value of a coordinate, or without coordinates at a distance in the graph from
//! one of its ends. What touches the other side is the separator, eliminated after both sides.

use std::collections::HashMap;

/// Unknowns that are not cut any further, at most (in groups of [`Graph`]).
const LEAF: usize = 24;

/// Cuts tried around the middle of a part, on either side: on a mesh cut by both diagonals every
/// second line is a separator of half the size.
const CUTS: usize = 2;

/// A node of the tree of dissection: its own unknowns, eliminated after those of its children.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    /// Own unknowns.
    pub(super) own: Vec<usize>,
    /// Indices of the children in the list, all smaller than the part's own.
    pub(super) children: Vec<usize>,
}

/// Groups of unknowns that have the same neighbours (the dofs of a mesh node), and who touches
/// whom.
struct Graph {
    members: Vec<Vec<usize>>,
    neighbours: Vec<Vec<u32>>,
    points: Vec<Option<[f64; 2]>>,
}

/// The parts in the order of elimination. `columns` lists what each unknown touches, ascending;
/// only those with `wanted` are dissected. `points` are positions in the plane, where known.
pub(super) fn dissect<'a>(
    order: usize,
    columns: &dyn Fn(usize) -> &'a [usize],
    wanted: &dyn Fn(usize) -> bool,
    points: Option<&[[f64; 2]]>,
) -> Vec<Part> {
    let graph = Graph::of(order, columns, wanted, points);
    let mut work = Work {
        graph: &graph,
        side: vec![0; graph.members.len()],
        distance: vec![u32::MAX; graph.members.len()],
        parts: vec![],
    };
    work.cut((0..graph.members.len() as u32).collect());
    work.parts
}

impl Graph {
    fn of<'a>(
        order: usize,
        columns: &dyn Fn(usize) -> &'a [usize],
        wanted: &dyn Fn(usize) -> bool,
        points: Option<&[[f64; 2]]>,
    ) -> Graph {
        let mut group = vec![u32::MAX; order];
        let mut first: HashMap<&[usize], u32> = HashMap::new();
        let mut members: Vec<Vec<usize>> = Vec::new();
        for i in (0..order).filter(|&i| wanted(i)) {
            let g = *first.entry(columns(i)).or_insert(members.len() as u32);
            if g as usize == members.len() {
                members.push(Vec::new());
            }
            members[g as usize].push(i);
            group[i] = g;
        }
        let touched = |m: &Vec<usize>| {
            let mut list: Vec<u32> = columns(m[0])
                .iter()
                .map(|&j| group[j])
                .filter(|&g| g != u32::MAX && g != group[m[0]])
                .collect();
            list.sort_unstable();
            list.dedup();
            list
        };
        let neighbours = members.iter().map(touched).collect();
        let points = members.iter().map(|m| points.map(|p| p[m[0]])).collect();
        Graph {
            members,
            neighbours,
            points,
        }
    }
}

struct Work<'g> {
    graph: &'g Graph,
    /// Mark of the part under work: 1 below the cut, 2 above, 0 elsewhere.
    side: Vec<u8>,
    distance: Vec<u32>,
    parts: Vec<Part>,
}

impl Work<'_> {
    /// Dissects a list of groups; the index of its part, `None` for an empty list.
    fn cut(&mut self, mut list: Vec<u32>) -> Option<usize> {
        if list.len() <= LEAF {
            return self.close(&list, Vec::new());
        }
        let keys = self.keys(&list);
        let mut ordered: Vec<(f64, u32)> = keys.into_iter().zip(list.drain(..)).collect();
        ordered.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let best = cuts(&ordered)
            .into_iter()
            .map(|at| (self.separator(&ordered, at), at))
            .min_by_key(|(s, _)| s.len());
        let groups = |part: &[(f64, u32)]| part.iter().map(|e| e.1).collect::<Vec<u32>>();
        let Some((separator, at)) = best else {
            return self.close(&groups(&ordered), Vec::new());
        };
        separator.iter().for_each(|&g| self.side[g as usize] = 1);
        let (low, high) = ordered.split_at(at);
        let above: Vec<u32> = high
            .iter()
            .map(|e| e.1)
            .filter(|&g| self.side[g as usize] == 0)
            .collect();
        separator.iter().for_each(|&g| self.side[g as usize] = 0);
        let below = groups(low);
        drop(ordered);
        let children: Vec<usize> = [below, above]
            .into_iter()
            .filter_map(|part| self.cut(part))
            .collect();
        self.close(&separator, children)
    }

    fn close(&mut self, groups: &[u32], children: Vec<usize>) -> Option<usize> {
        if groups.is_empty() && children.is_empty() {
            return None;
        }
        let own = groups
            .iter()
            .flat_map(|&g| self.graph.members[g as usize].iter().copied())
            .collect();
        self.parts.push(Part { own, children });
        Some(self.parts.len() - 1)
    }

    /// Those from `at` on that touch one before.
    fn separator(&mut self, ordered: &[(f64, u32)], at: usize) -> Vec<u32> {
        let (low, high) = ordered.split_at(at);
        low.iter().for_each(|e| self.side[e.1 as usize] = 1);
        let touches = |g: u32| {
            self.graph.neighbours[g as usize]
                .iter()
                .any(|&h| self.side[h as usize] == 1)
        };
        let separator = high.iter().map(|e| e.1).filter(|&g| touches(g)).collect();
        low.iter().for_each(|e| self.side[e.1 as usize] = 0);
        separator
    }

    /// The coordinate along the longer side of the part, or the distance from one of its ends.
    fn keys(&mut self, list: &[u32]) -> Vec<f64> {
        let points: Option<Vec<[f64; 2]>> = list
            .iter()
            .map(|&g| self.graph.points[g as usize])
            .collect();
        let Some(points) = points else {
            let end = self.farthest(list, list[0]);
            self.farthest(list, end);
            return list
                .iter()
                .map(|&g| f64::from(std::mem::replace(&mut self.distance[g as usize], u32::MAX)))
                .collect();
        };
        let extent = |axis: usize| {
            let (low, high) = points
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
                    (p[axis].min(l), p[axis].max(h))
                });
            high - low
        };
        let axis = usize::from(extent(1) > extent(0));
        points.iter().map(|p| p[axis]).collect()
    }

    /// Distances within the part from `start` (`u32::MAX - 1` where it does not reach), and a group
    /// farthest away.
    fn farthest(&mut self, list: &[u32], start: u32) -> u32 {
        list.iter()
            .for_each(|&g| self.distance[g as usize] = u32::MAX - 1);
        self.distance[start as usize] = 0;
        let mut queue = std::collections::VecDeque::from([start]);
        let mut last = start;
        while let Some(g) = queue.pop_front() {
            last = g;
            let next = self.distance[g as usize] + 1;
            for &h in &self.graph.neighbours[g as usize] {
                if self.distance[h as usize] == u32::MAX - 1 {
                    self.distance[h as usize] = next;
                    queue.push_back(h);
                }
            }
        }
        last
    }
}

/// Places near the middle of a sorted list at which the key changes.
fn cuts(ordered: &[(f64, u32)]) -> Vec<usize> {
    let changes = |k: &usize| ordered[*k].0 > ordered[*k - 1].0;
    let middle = ordered.len() / 2;
    let mut found: Vec<usize> = (middle.max(1)..ordered.len())
        .filter(changes)
        .take(CUTS)
        .collect();
    found.extend((1..middle.max(1)).rev().filter(changes).take(CUTS));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of n x n points, each touching its eight neighbours.
    fn grid(n: usize) -> Vec<Vec<usize>> {
        let near =
            |a: usize, b: usize| (a / n).abs_diff(b / n) <= 1 && (a % n).abs_diff(b % n) <= 1;
        (0..n * n)
            .map(|a| (0..n * n).filter(|&b| near(a, b)).collect())
            .collect()
    }

    /// Every unknown once, children before parents, and what a subtree touches outside is in parts
    /// above it.
    fn assert_dissection(touch: &[Vec<usize>], parts: &[Part]) {
        let mut part_of = vec![usize::MAX; touch.len()];
        let mut parent = vec![usize::MAX; parts.len()];
        for (p, part) in parts.iter().enumerate() {
            part.children.iter().for_each(|&c| parent[c] = p);
            assert!(part.children.iter().all(|&c| c < p));
            for &i in &part.own {
                assert_eq!(std::mem::replace(&mut part_of[i], p), usize::MAX);
            }
        }
        let above = |mut low: usize, high: usize| {
            while low < high {
                low = parent[low];
            }
            low == high
        };
        for (a, list) in touch.iter().enumerate() {
            assert!(
                list.iter()
                    .all(|&b| above(part_of[a].min(part_of[b]), part_of[a].max(part_of[b]))),
                "{a}"
            );
        }
    }

    #[test]
    fn a_grid_is_cut_along_lines() {
        let n = 20;
        let touch = grid(n);
        let points: Vec<[f64; 2]> = (0..n * n)
            .map(|a| [(a / n) as f64, 1.5 * (a % n) as f64])
            .collect();
        let with = dissect(n * n, &|i| touch[i].as_slice(), &|_| true, Some(&points));
        assert_dissection(&touch, &with);
        let last = with.last().unwrap();
        assert_eq!(last.own.len(), n);
        assert!(
            last.own.iter().all(|a| a % n == last.own[0] % n),
            "a line across the longer side"
        );
        let without = dissect(n * n, &|i| touch[i].as_slice(), &|_| true, None);
        assert_dissection(&touch, &without);
        assert!(without.last().unwrap().own.len() <= 2 * n);
    }

    #[test]
    fn two_bodies_one_clique_and_nothing() {
        let touch: Vec<Vec<usize>> = (0..100usize)
            .map(|a| {
                (0..100)
                    .filter(|b| a / 50 == b / 50 && a.abs_diff(*b) <= 1)
                    .collect()
            })
            .collect();
        assert_dissection(
            &touch,
            &dissect(100, &|i| touch[i].as_slice(), &|_| true, None),
        );
        let all: Vec<usize> = (0..90).collect();
        let clique = dissect(90, &|_| all.as_slice(), &|i| i != 7, None);
        assert_eq!(clique.iter().map(|p| p.own.len()).sum::<usize>(), 89);
        assert!(dissect(3, &|_| all.as_slice(), &|_| false, None).is_empty());
    }
}
