//! Where the nodes of a body are, for pictures: no answer and no digest depends on it.
//!
//! A node has a place (x, y) and the degrees of freedom that move it along x and along y. Where one
//! is prescribed it is none of the system's, and the node does not move that way, but for what the
//! steps of a load prescribe.

use super::{LoadedBody, ModelError, System};
use mceip_exact::{Integer, Rational};
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// A node of a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyNode {
    /// The degrees of freedom along x and along y.
    pub dofs: [Option<usize>; 2],
    /// (x, y), in the unit of length of the model.
    pub place: [Rational; 2],
}

/// How a load step moves a node whose degrees of freedom are held.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrescribedDisplacement {
    /// The step, from 0.
    pub step: usize,
    /// The node, from 0.
    pub node: usize,
    /// Along x and y; 0 where the node has a degree of freedom of the system.
    pub by: [Rational; 2],
}

/// The nodes of a body and the edges between them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coordinates {
    nodes: Vec<BodyNode>,
    edges: Vec<[usize; 2]>,
    prescribed: Vec<PrescribedDisplacement>,
}

impl Coordinates {
    /// The nodes of a system. `edges` (indices of nodes) may be empty.
    ///
    /// # Errors
    /// [`ModelError::Coordinates`]: no node, a degree of freedom out of range or at two places, a
    /// coordinate beyond 2^512, an edge to no node.
    pub fn new(
        nodes: Vec<BodyNode>,
        edges: Vec<[usize; 2]>,
        system: &System,
    ) -> Result<Coordinates, ModelError> {
        if nodes.is_empty() {
            return Err(refused("at least one node", "none".into()));
        }

        let mut is_taken = vec![false; system.dofs()];
        for (index, node) in nodes.iter().enumerate() {
            require_node(index, node, &mut is_taken)?;
        }
        for &[from, to] in &edges {
            if from.max(to) >= nodes.len() || from == to {
                let got = format!("[{from}, {to}] with {} nodes", nodes.len());
                return Err(refused("edges between two nodes", got));
            }
        }

        Ok(Coordinates {
            nodes,
            edges,
            prescribed: Vec::new(),
        })
    }

    /// The nodes of a body under loads. Their degrees of freedom are those of the matrices as
    /// given, held ones included; what a step prescribes for these is kept.
    ///
    /// # Errors
    /// As [`Coordinates::new`].
    pub fn under_loads(
        mut nodes: Vec<BodyNode>,
        edges: Vec<[usize; 2]>,
        body: &LoadedBody,
    ) -> Result<Coordinates, ModelError> {
        let mut prescribed = Vec::new();
        for (step, load) in body.steps().iter().enumerate() {
            let of_dofs: BTreeMap<usize, &Rational> = load
                .displacements
                .iter()
                .map(|(dof, by)| (*dof, by))
                .collect();
            for (node, placed) in nodes.iter().enumerate() {
                let by = placed.dofs.map(|dof| {
                    let by = dof.and_then(|dof| of_dofs.get(&dof));
                    by.map_or_else(Rational::zero, |by| (*by).clone())
                });
                if by.iter().any(|component| !component.is_zero()) {
                    prescribed.push(PrescribedDisplacement { step, node, by });
                }
            }
        }

        let places = body.places();
        for (index, node) in nodes.iter_mut().enumerate() {
            for dof in &mut node.dofs {
                let Some(given) = *dof else { continue };
                *dof = *places
                    .get(given)
                    .ok_or_else(|| out_of_range(index, given, places.len()))?;
            }
        }

        let placed = Coordinates::new(nodes, edges, body.system())?;
        Ok(Coordinates {
            prescribed,
            ..placed
        })
    }

    /// With what the steps of a load, so many, prescribe for nodes of which the held degrees of
    /// freedom are in no matrix.
    ///
    /// # Errors
    /// [`ModelError::Coordinates`]: a step or node that there is not, one twice in a step, or one
    /// that the system moves that way.
    pub fn with_prescribed(
        mut self,
        prescribed: Vec<PrescribedDisplacement>,
        steps: usize,
    ) -> Result<Coordinates, ModelError> {
        for moved in prescribed {
            let (step, index) = (moved.step, moved.node);
            let Some(node) = self.nodes.get(index) else {
                let got = format!("node {index} of {} in step {step}", self.nodes.len());
                return Err(refused("prescribed displacements of nodes from 0", got));
            };

            if step >= steps {
                let got = format!("node {index} in step {step} of {steps}");
                return Err(refused("prescribed displacements in steps from 0", got));
            }

            let by = node.dofs.iter().zip(&moved.by);
            let is_free = by
                .into_iter()
                .any(|(dof, by)| dof.is_some() && !by.is_zero());
            let is_known =
                |other: &PrescribedDisplacement| (other.step, other.node) == (step, index);
            if is_free || self.prescribed.iter().any(is_known) {
                let expected = "prescribed displacements of a node once a step, along held axes";
                return Err(refused(expected, format!("node {index} in step {step}")));
            }
            self.prescribed.push(moved);
        }

        Ok(self)
    }

    /// The nodes.
    pub fn nodes(&self) -> &[BodyNode] {
        &self.nodes
    }

    /// Pairs of nodes between which a line is drawn.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// What the steps of a load prescribe for nodes that are held.
    pub fn prescribed(&self) -> &[PrescribedDisplacement] {
        &self.prescribed
    }

    /// The same where there are no loads.
    pub fn without_loads(&self) -> Coordinates {
        Coordinates {
            prescribed: Vec::new(),
            ..self.clone()
        }
    }

    /// The prescribed displacement of each node with so much of each step applied.
    pub fn prescribed_at(&self, applied: &[Rational]) -> Vec<[Rational; 2]> {
        let mut all = vec![[Rational::zero(), Rational::zero()]; self.nodes.len()];
        for moved in &self.prescribed {
            for (sum, by) in all[moved.node].iter_mut().zip(&moved.by) {
                *sum += &applied[moved.step] * by;
            }
        }
        all
    }

    /// The node that a degree of freedom moves.
    pub fn node_of(&self, dof: usize) -> Option<usize> {
        let moves = |node: &BodyNode| node.dofs.contains(&Some(dof));
        self.nodes.iter().position(moves)
    }
}

/// The degrees of freedom of a node are those of the system and of no node before it, and its
/// coordinates at most 2^512, so that their differences are doubles.
fn require_node(index: usize, node: &BodyNode, is_taken: &mut [bool]) -> Result<(), ModelError> {
    for dof in node.dofs.into_iter().flatten() {
        match is_taken.get_mut(dof) {
            Some(taken) if !*taken => *taken = true,
            Some(_) => {
                let got = format!("{dof} a second time, for node {index}");
                return Err(refused("each degree of freedom once", got));
            }
            None => return Err(out_of_range(index, dof, is_taken.len())),
        }
    }

    let limit = Rational::from_integer(Integer::one() << 512);
    if node.place.iter().any(|coordinate| coordinate.abs() > limit) {
        let got = format!("a larger one for node {index}");
        return Err(refused("coordinates of at most 2^512", got));
    }

    Ok(())
}

fn out_of_range(node: usize, dof: usize, dofs: usize) -> ModelError {
    let expected = "degrees of freedom of the system, numbered from 0";
    refused(expected, format!("{dof} of {dofs} for node {node}"))
}

fn refused(expected: &'static str, got: String) -> ModelError {
    ModelError::Coordinates { expected, got }
}

#[cfg(test)]
mod tests {
    use super::super::file::{read_problem, write_problem};
    use super::super::{Body, ModelError, Problem};
    use std::path::Path;

    fn read(coordinates: &str) -> Result<Problem, ModelError> {
        let text = format!(
            r#"{{"format": "mceip-problem/1", "unknown": "lambda2", "coordinates": {coordinates},
                "system": {{"stiffness": [[2, 0], [0, 2]], "mass": [[1, 0], [0, 1]],
                            "friction": 1, "particles": [{{"tangential": 0, "normal": 1,
                                                          "state": "slip", "sign": 1}}]}}}}"#
        );
        read_problem(&text, Path::new("."))
    }

    #[test]
    fn coordinates_are_read_written_and_no_part_of_the_digest() {
        let given = r#"{"nodes": [[0, 1, "0.1", 0], [null, null, "1/3", 2e1]], "edges": [[0, 1]],
                        "particles": ["left foot"]}"#;
        let with = read(given).unwrap();
        let without = read("null").unwrap();

        let coordinates = with.coordinates.as_ref().unwrap();
        assert_eq!(coordinates.nodes().len(), 2);
        assert_eq!(coordinates.edges(), [[0, 1]]);
        assert_eq!(coordinates.node_of(1), Some(0));
        assert_eq!(coordinates.node_of(2), None);

        let again = read_problem(&write_problem(&with), Path::new(".")).unwrap();
        assert_eq!(again, with);
        assert_eq!(with.sha256(), without.sha256());
        assert!(!write_problem(&without).contains("coordinates"));
    }

    /// Older files have the names beside the coordinates; a file that is written has them in the
    /// particles, and no file has them in both places.
    #[test]
    fn names_beside_coordinates_are_those_of_the_particles() {
        let named = read(r#"{"nodes": [[0, 1, 0, 0]], "particles": ["left foot"]}"#).unwrap();
        let unnamed = read(r#"{"nodes": [[0, 1, 0, 0]], "particles": [""]}"#).unwrap();

        let name_of = |problem: &Problem| match problem.body() {
            Body::System(system) => system.particles()[0].name.clone(),
            Body::Pencil(_) | Body::Quadratic(_) => None,
        };
        assert_eq!(name_of(&named).as_deref(), Some("left foot"));
        assert_eq!(name_of(&unnamed), None);
        assert_eq!(named.sha256(), unnamed.sha256());

        let written = write_problem(&named);
        assert!(written.contains(r#""name":"left foot""#), "{written}");
        let twice = written.replace(r#""nodes":"#, r#""particles":["foot"],"nodes":"#);
        let refused = read_problem(&twice, Path::new("."));
        assert!(matches!(refused, Err(ModelError::Coordinates { .. })));
    }

    #[test]
    fn coordinates_that_do_not_fit_are_refused() {
        for wrong in [
            r#"{"nodes": []}"#,
            r#"{"nodes": [[0, 2, 0, 0]]}"#,
            r#"{"nodes": [[0, 0, 0, 0]]}"#,
            r#"{"nodes": [[0, null, 0, 0], [null, 0, 1, 1]]}"#,
            r#"{"nodes": [[0, 1, 0, 1e400]]}"#,
            r#"{"nodes": [[0, 1, 0, 0]], "edges": [[0, 1]]}"#,
            r#"{"nodes": [[0, 1, 0, 0]], "edges": [[0, 0]]}"#,
            r#"{"nodes": [[0, 1, 0, 0]], "particles": ["a", "b"]}"#,
            r#"{"nodes": [[null, null, 0, 0]], "prescribed": [[0, 0, 1, 0]]}"#,
        ] {
            let refused = read(wrong);
            let is_named = matches!(refused, Err(ModelError::Coordinates { .. }));
            assert!(is_named, "{wrong}: {refused:?}");
        }

        for malformed in [
            "[]",
            "{}",
            r#"{"nodes": [[0, 1, 0]]}"#,
            r#"{"nodes": [[0, 1, 0, 0, 0]]}"#,
            r#"{"nodes": [[-1, 1, 0, 0]]}"#,
            r#"{"nodes": [[0, 1, "here", 0]]}"#,
            r#"{"nodes": [[0, 1, 0, 0]], "faces": []}"#,
        ] {
            let refused = read(malformed);
            let is_malformed = matches!(refused, Err(ModelError::Json { .. }));
            assert!(is_malformed, "{malformed}: {refused:?}");
        }
    }

    #[test]
    fn a_pencil_has_no_coordinates() {
        let text = r#"{"format": "mceip-problem/1", "unknown": "mu",
                       "coordinates": {"nodes": [[0, null, 0, 0]]},
                       "pencil": {"a": [[1]], "b": [[1]]}}"#;
        let refused = read_problem(text, Path::new("."));
        assert!(matches!(refused, Err(ModelError::Coordinates { .. })));
    }
}
