//! Directions of contacts, held against the places of the nodes.
//!
//! A particle in contact has a tangent t and a normal n into the obstacle, its node a place p.
//!
//! * t is turned: the smallest of its angles with the lines from p to the nearest two contact nodes
//!   beside it, and with the line between these two, is large;
//! * n points into the body: the mean of n'(q - p) / |q - p| over the nodes q beside p is positive;
//! * the two degrees of freedom of the particle move two nodes.
//!
//! Beside p are the nodes that an edge of the table joins with it, and those that share an element
//! with it, that is an entry of K. Where K couples p with every node, as a condensed matrix does,
//! its entries say nothing. A contact node with no other one beside it touches at a point: its
//! tangent is not examined. Neither are particles out of contact, whose directions have no effect.
//!
//! All in doubles; `plausibility` says it in words.
#![allow(clippy::float_arithmetic)]

use crate::tolerance::{INTO_THE_BODY, TURNED_TANGENT};
use mceip_exact::to_f64;
use mceip_model::{ContactState, Coordinates, Direction, System};
use std::collections::BTreeSet;

/// Particles whose directions do not fit the places of the nodes, by their indices.
#[derive(Debug, Default)]
pub(crate) struct WrongDirections {
    /// Those with a turned tangent, and by how many degrees.
    pub(crate) turned: Vec<(usize, f64)>,
    /// Those whose normal points into the body.
    pub(crate) into_body: Vec<usize>,
    /// Those whose degrees of freedom move two nodes.
    pub(crate) of_two_nodes: Vec<usize>,
}

impl WrongDirections {
    /// Looks at every particle in contact whose node is known.
    pub(crate) fn of(system: &System, coordinates: &Coordinates) -> WrongDirections {
        let body = MeshedBody::new(system, coordinates);
        let mut wrong = WrongDirections::default();

        for (index, particle) in system.particles().iter().enumerate() {
            if particle.state == ContactState::Free {
                continue;
            }
            let moved = [particle.tangential, particle.normal].map(|dof| body.moved[dof]);
            let [Some(by_tangential), Some(by_normal)] = moved else {
                continue;
            };
            let node = by_tangential.node;
            if node != by_normal.node {
                wrong.of_two_nodes.push(index);
                continue;
            }

            let tangent = body.vector(&particle.tangent());
            if let Some(degrees) = body.turned_from_neighbours(node, tangent)
                && degrees > TURNED_TANGENT
            {
                wrong.turned.push((index, degrees));
            }

            let normal = body.vector(&particle.into_obstacle());
            if body.mean_cosine(node, normal) > INTO_THE_BODY {
                wrong.into_body.push(index);
            }
        }

        wrong
    }
}

/// (x, y).
type Vector = [f64; 2];

/// What a degree of freedom moves.
#[derive(Clone, Copy)]
struct Moved {
    node: usize,
    /// 0: along x; 1: along y.
    axis: usize,
}

/// A body with its nodes.
struct MeshedBody<'a> {
    system: &'a System,
    coordinates: &'a Coordinates,
    /// Of each node.
    places: Vec<Vector>,
    /// Of each degree of freedom; none if no node has it.
    moved: Vec<Option<Moved>>,
    /// Is it the node of a particle? Of each node.
    has_particle: Vec<bool>,
}

impl<'a> MeshedBody<'a> {
    fn new(system: &'a System, coordinates: &'a Coordinates) -> MeshedBody<'a> {
        let mut places = Vec::new();
        let mut moved = vec![None; system.dofs()];
        for (node, given) in coordinates.nodes().iter().enumerate() {
            places.push(given.place.each_ref().map(to_f64));
            for (axis, dof) in given.dofs.into_iter().enumerate() {
                if let Some(dof) = dof {
                    moved[dof] = Some(Moved { node, axis });
                }
            }
        }

        let mut has_particle = vec![false; places.len()];
        for particle in system.particles() {
            if let Some(Moved { node, .. }) = moved[particle.tangential] {
                has_particle[node] = true;
            }
        }

        MeshedBody {
            system,
            coordinates,
            places,
            moved,
            has_particle,
        }
    }

    /// A direction over degrees of freedom along x and y.
    fn vector(&self, direction: &Direction) -> Vector {
        let mut vector = [0.0; 2];
        for (dof, coefficient) in direction {
            if let Some(moved) = self.moved[*dof] {
                vector[moved.axis] += to_f64(coefficient);
            }
        }

        vector
    }

    /// The nodes that an edge joins with a node.
    fn by_edge(&self, node: usize) -> BTreeSet<usize> {
        let mut others = BTreeSet::new();
        for &[from, to] in self.coordinates.edges() {
            if from == node {
                others.insert(to);
            } else if to == node {
                others.insert(from);
            }
        }

        others
    }

    /// The nodes that entries of K couple with a node; none if these are all nodes.
    fn by_element(&self, node: usize) -> BTreeSet<usize> {
        let mut others = BTreeSet::new();
        let dofs = self.coordinates.nodes()[node].dofs;
        for dof in dofs.into_iter().flatten() {
            for (column, _) in self.system.stiffness().row(dof) {
                if let Some(moved) = self.moved[*column]
                    && moved.node != node
                {
                    others.insert(moved.node);
                }
            }
        }

        let nodes = self.coordinates.nodes().iter();
        let movable = nodes.filter(|node| node.dofs != [None, None]).count();
        if others.len() + 1 >= movable {
            others.clear();
        }
        others
    }

    /// From a node to others, without those at its own place; the nearest first.
    fn offsets(&self, node: usize, others: impl IntoIterator<Item = usize>) -> Vec<Vector> {
        let from = self.places[node];
        let mut offsets = Vec::new();
        for other in others {
            let offset = difference(self.places[other], from);
            if length(offset) > 0.0 {
                offsets.push(offset);
            }
        }

        offsets.sort_by(|a, b| length(*a).total_cmp(&length(*b)));
        offsets
    }

    /// The angle in degrees between a tangent and the line through the contact nodes beside its
    /// node; none if there are no such nodes.
    fn turned_from_neighbours(&self, node: usize, tangent: Vector) -> Option<f64> {
        let mut neighbours = self.by_edge(node);
        neighbours.retain(|other| self.has_particle[*other]);
        if neighbours.is_empty() {
            neighbours = self.by_element(node);
            neighbours.retain(|other| self.has_particle[*other]);
        }

        let mut lines = self.offsets(node, neighbours);
        lines.truncate(2);
        if let [first, second] = lines[..] {
            lines.push(difference(first, second));
        }

        let degrees = lines.into_iter().map(|line| angle_of_lines(tangent, line));
        degrees.min_by(f64::total_cmp)
    }

    /// The mean of the cosines between a normal and the directions to the nodes beside its node;
    /// 0 without such nodes.
    fn mean_cosine(&self, node: usize, normal: Vector) -> f64 {
        let mut others = self.by_edge(node);
        others.append(&mut self.by_element(node));
        let offsets = self.offsets(node, others);
        if offsets.is_empty() {
            return 0.0;
        }

        let count = offsets.len() as f64;
        let cosines = offsets
            .iter()
            .map(|&offset| dot(normal, offset) / length(offset));
        cosines.sum::<f64>() / count
    }
}

fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

fn length(a: Vector) -> f64 {
    a[0].hypot(a[1])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// In degrees, from 0 to 90.
fn angle_of_lines(a: Vector, b: Vector) -> f64 {
    let cross = a[0] * b[1] - a[1] * b[0];
    cross.abs().atan2(dot(a, b).abs()).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Rational, Sparse, from_f64, whole};
    use mceip_model::{BodyNode, Particle};

    /// Nodes of an arc about the origin, eight elements to the quarter circle, and of another one
    /// of radius `depth` below or above it; K couples each node with the next ones. All nodes of
    /// the arc with radius 1 slip, with the normal along `outwards` times the radius.
    fn arc(depth: f64, outwards: f64, turned: f64) -> WrongDirections {
        const COUNT: usize = 9;
        let mut nodes = Vec::new();
        let mut particles = Vec::new();
        for (layer, radius) in [1.0, depth].into_iter().enumerate() {
            for k in 0..COUNT {
                let index = layer * COUNT + k;
                let angle = (k as f64 * 11.25).to_radians();
                let place = [angle.cos() * radius, angle.sin() * radius];
                nodes.push(BodyNode {
                    dofs: [Some(2 * index), Some(2 * index + 1)],
                    place: place.map(|x| from_f64(x).unwrap()),
                });
                if layer == 0 {
                    let turn = angle + turned.to_radians();
                    particles.push(particle(2 * index, turn, outwards));
                }
            }
        }

        let mut entries: Vec<(usize, usize, Rational)> = Vec::new();
        for node in 0..2 * COUNT {
            for other in 0..2 * COUNT {
                let apart = (node % COUNT).abs_diff(other % COUNT);
                if node == other {
                    entries.push((2 * node, 2 * node, whole(100)));
                    entries.push((2 * node + 1, 2 * node + 1, whole(100)));
                } else if apart <= 1 {
                    entries.push((2 * node, 2 * other, whole(-1)));
                }
            }
        }

        let stiffness = Sparse::from_entries(4 * COUNT, 4 * COUNT, entries);
        let system = System::new(stiffness, None, None, particles).unwrap();
        let coordinates = Coordinates::new(nodes, vec![], &system).unwrap();
        WrongDirections::of(&system, &coordinates)
    }

    /// A slip particle whose normal into the obstacle has this angle with x, or the opposite one.
    fn particle(dof: usize, angle: f64, outwards: f64) -> Particle {
        let slip = ContactState::Slip { sign: 1 };
        let normal = [angle.cos() * outwards, angle.sin() * outwards];
        Particle {
            frame: crate::rotation::rotation_along(normal[1], -normal[0]),
            ..Particle::plain(dof, dof + 1, slip)
        }
    }

    /// A shaft in a bush and a bush about a shaft: the contact bends either way.
    #[test]
    fn right_directions_on_an_arc_are_not_named() {
        for (depth, outwards) in [(0.8, 1.0), (1.2, -1.0)] {
            let wrong = arc(depth, outwards, 0.0);
            assert!(wrong.turned.is_empty(), "{wrong:?}");
            assert!(wrong.into_body.is_empty(), "{wrong:?}");
            assert!(wrong.of_two_nodes.is_empty(), "{wrong:?}");
        }
    }

    #[test]
    fn wrong_directions_on_an_arc_are_named() {
        for (depth, outwards) in [(0.8, 1.0), (1.2, -1.0)] {
            let turned = arc(depth, outwards, 25.0);
            assert_eq!(turned.turned.len(), 9, "{turned:?}");
            // The nearer of the two chords is turned by half an element, 5.625 degrees.
            assert!((turned.turned[4].1 - 19.375).abs() < 1e-6, "{turned:?}");
            assert!(turned.into_body.is_empty(), "{turned:?}");

            let reversed = arc(depth, -outwards, 0.0);
            assert!(reversed.turned.is_empty(), "{reversed:?}");
            assert_eq!(reversed.into_body, [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        }
    }

    /// A condensed K couples all nodes, and says of none what is beside it.
    #[test]
    fn without_edges_a_full_matrix_names_nothing() {
        let rows: Vec<(usize, usize, Rational)> = (0..4)
            .flat_map(|i| (0..4).map(move |j| (i, j, whole(if i == j { 4 } else { 1 }))))
            .collect();
        let stiffness = Sparse::from_entries(4, 4, rows);
        let slip = ContactState::Slip { sign: 1 };
        let particles = vec![Particle::plain(0, 1, slip), Particle::plain(3, 2, slip)];
        let system = System::new(stiffness, None, None, particles).unwrap();
        let node = |dof: usize, x: i64| BodyNode {
            dofs: [Some(dof), Some(dof + 1)],
            place: [whole(x), whole(0)],
        };
        let nodes = vec![node(0, 0), node(2, 1)];

        let full = Coordinates::new(nodes.clone(), vec![], &system).unwrap();
        assert!(WrongDirections::of(&system, &full).turned.is_empty());

        let joined = Coordinates::new(nodes.clone(), vec![[0, 1]], &system).unwrap();
        assert_eq!(WrongDirections::of(&system, &joined).turned, [(1, 90.0)]);

        let crossed = [[0, 3], [2, 1]].map(|[x, y]| BodyNode {
            dofs: [Some(x), Some(y)],
            place: [whole(x as i64), whole(0)],
        });
        let crossed = Coordinates::new(crossed.to_vec(), vec![], &system).unwrap();
        assert_eq!(WrongDirections::of(&system, &crossed).of_two_nodes, [0, 1]);
    }
}
