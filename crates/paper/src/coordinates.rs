//! Where the nodes of a block are, the glued side included: what pictures of it are drawn from.

use super::block_model::BlockModel;
use super::error::SourceError;
use super::mesh::Mesh;
use mceip_exact::{Rational, whole};
use mceip_model::{BodyNode, Coordinates, System};
use std::collections::BTreeSet;

impl BlockModel {
    /// Nodes and edges of the mesh of a block's system, mm; those of the glued side do not move.
    ///
    /// # Errors
    /// [`SourceError`]: as [`super::Block::new`], or a system of another block.
    pub(super) fn coordinates(&self, system: &System) -> Result<Coordinates, SourceError> {
        self.validate()?;
        let mesh = Mesh::new(self.cells.0, self.cells.1, self.mesh)?;

        // The mesh counts in half cells.
        let half_width = &self.cell.0 / whole(2);
        let half_height = &self.cell.1 / whole(2);
        let mut nodes = Vec::with_capacity(mesh.points.len());
        for (&(x, y), number) in mesh.points.iter().zip(&mesh.number) {
            let x = &half_width * Rational::from_integer(x.into());
            let y = &half_height * Rational::from_integer(y.into());
            nodes.push(BodyNode {
                dofs: [number.map(|node| 2 * node), number.map(|node| 2 * node + 1)],
                place: [x, y],
            });
        }

        let mut edges: BTreeSet<[usize; 2]> = BTreeSet::new();
        for &[a, b, c] in &mesh.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                edges.insert([p.min(q), p.max(q)]);
            }
        }

        let edges = edges.into_iter().collect();
        Ok(Coordinates::new(nodes, edges, system)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Block, MeshKind};
    use mceip_model::ContactState;

    #[test]
    fn its_nodes_are_those_of_the_block() {
        for mesh in MeshKind::ALL {
            let model = BlockModel {
                mesh,
                ..BlockModel::of_the_paper().with_cells(4, 3)
            };
            let block = Block::new(&model).unwrap();
            let states = vec![ContactState::Stick; block.contact.len()];
            let system = block.system(&states, None).unwrap();
            let coordinates = model.coordinates(&system).unwrap();

            let mut glued = 0;
            for node in coordinates.nodes() {
                let [x, y] = node.place.clone();
                match node.dofs[0] {
                    Some(dof) => assert_eq!((x, y), block.nodes[dof / 2]),
                    None => {
                        assert_eq!(y, model.height());
                        glued += 1;
                    }
                }
            }
            assert_eq!(coordinates.nodes().len(), block.nodes.len() + glued);
            assert_eq!(glued, 5);

            // Euler: points + triangles - 1 edges.
            let edges = coordinates.nodes().len() + block.triangles - 1;
            assert_eq!(coordinates.edges().len(), edges);
        }
    }
}
