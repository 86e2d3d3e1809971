//! The mesh of a block as anybody can read it: points, triangles, nodes, contact side. Pictures of
//! modes and of the loading path are drawn from it.

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

        // The mesh counts in half cells.
        let half_width = &self.cell.0 / whole(2);
        let half_height = &self.cell.1 / whole(2);
        let mut points = Vec::with_capacity(mesh.points.len());
        for &(x, y) in &mesh.points {
            let x = &half_width * Rational::from_integer(x.into());
            let y = &half_height * Rational::from_integer(y.into());
            points.push((x, y));
        }

        let mut contact = Vec::with_capacity(mesh.contact.len());
        for &node in &mesh.contact {
            let point = mesh.number.iter().position(|number| *number == Some(node));
            if let Some(point) = point {
                contact.push(point);
            }
        }

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
            assert_same_nodes(&model);
        }

        let no_cells = BlockModel::of_the_paper().with_cells(0, 3);
        assert!(no_cells.triangulation().is_err());
    }

    fn assert_same_nodes(model: &BlockModel) {
        let mesh = model.triangulation().unwrap();
        let block = Block::new(model).unwrap();

        let mut nodes = 0;
        let mut glued = 0;
        for (point, node) in mesh.points.iter().zip(&mesh.nodes) {
            match node {
                Some(node) => {
                    assert_eq!(*point, block.nodes[*node]);
                    nodes += 1;
                }
                None => {
                    assert_eq!(point.1, model.height());
                    glued += 1;
                }
            }
        }
        assert_eq!(nodes, block.nodes.len());
        assert_eq!(glued, 5);
        assert_eq!(mesh.triangles.len(), block.triangles);

        let contact: Vec<usize> = mesh.contact.iter().filter_map(|&p| mesh.nodes[p]).collect();
        assert_eq!(contact, block.contact);
    }
}
