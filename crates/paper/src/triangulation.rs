//! The mesh of a block as anybody can read it: points, triangles, nodes, contact side.

use super::block_model::BlockModel;
use super::element::Point;
use super::error::SourceError;
use super::mesh::Mesh;
use mceip_exact::{Rational, whole};

/// Points and triangles of a block, the glued side included.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Triangulation {
    /// Position of each point, mm.
    pub points: Vec<Point>,
    /// Vertices of each triangle, counter-clockwise, by point.
    pub triangles: Vec<[usize; 3]>,
    /// The node that each point is, as in [`super::Block`] (node k owns dofs 2k and 2k + 1); `None`
    /// on the glued side.
    pub nodes: Vec<Option<usize>>,
    /// Points of the contact side AB, left to right.
    pub contact: Vec<usize>,
}

impl BlockModel {
    /// Meshes the block, as [`super::Block::new`] does.
    ///
    /// # Errors
    /// [`SourceError`] as [`super::Block::new`].
    ///
    /// ```
    /// let mesh = mceip_paper::BlockModel::of_the_paper().triangulation().unwrap();
    /// assert_eq!((mesh.points.len(), mesh.triangles.len(), mesh.contact.len()), (431, 800, 21));
    /// ```
    pub fn triangulation(&self) -> Result<Triangulation, SourceError> {
        self.validate()?;
        let mesh = Mesh::new(self.cells.0, self.cells.1, self.mesh)?;
        let half = (&self.cell.0 / whole(2), &self.cell.1 / whole(2));
        let scaled = |unit: &Rational, count: u32| unit * Rational::from_integer(count.into());
        let points = mesh
            .points
            .iter()
            .map(|&(x, y)| (scaled(&half.0, x), scaled(&half.1, y)))
            .collect();
        let point = |node: &usize| mesh.number.iter().position(|n| n.as_ref() == Some(node));
        let contact = mesh.contact.iter().filter_map(point).collect(); // every node is a point
        Ok(Triangulation {
            points,
            triangles: mesh.triangles,
            nodes: mesh.number,
            contact,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Block, MeshKind};

    #[test]
    fn its_nodes_are_those_of_the_block() {
        for mesh in MeshKind::ALL {
            let model = BlockModel {
                mesh,
                ..BlockModel::of_the_paper().with_cells(4, 3)
            };
            let (mesh, block) = (model.triangulation().unwrap(), Block::new(&model).unwrap());
            let mut seen = 0;
            for (point, node) in mesh
                .nodes
                .iter()
                .enumerate()
                .filter_map(|(p, n)| n.map(|n| (p, n)))
            {
                assert_eq!(mesh.points[point], block.nodes[node]);
                seen += 1;
            }
            assert_eq!(
                (seen, mesh.triangles.len()),
                (block.nodes.len(), block.triangles)
            );
            let contact: Vec<usize> = mesh.contact.iter().filter_map(|&p| mesh.nodes[p]).collect();
            assert_eq!(contact, block.contact);
            let glued = mesh
                .nodes
                .iter()
                .zip(&mesh.points)
                .filter(|(n, _)| n.is_none());
            assert!(
                glued.clone().count() == 5 && glued.clone().all(|(_, p)| p.1 == model.height())
            );
        }
        assert!(
            BlockModel::of_the_paper()
                .with_cells(0, 3)
                .triangulation()
                .is_err()
        );
    }
}
