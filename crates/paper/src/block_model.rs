//! What a block is made of: cells, triangulation, plane, material, mass. All lengths in mm.
//!
//! Input of `Block::new`, `DoubleBlock::new` and `triangulation`. The paper's block and its
//! relatives have names here.

use super::element::{MassKind, Material};
use super::error::SourceError;
use super::mesh::MeshKind;
use super::plane::Plane;
use mceip_exact::{Rational, whole};
use num_traits::Signed;

/// A rectangular block on a flat obstacle, before it is assembled.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BlockModel {
    /// Cells along the contact side AB and across it.
    pub cells: (usize, usize),
    /// Width and height of a cell, mm.
    pub cell: (Rational, Rational),
    /// How each cell is cut into triangles.
    pub mesh: MeshKind,
    /// Plane stress or plane strain.
    pub plane: Plane,
    /// Material and thickness.
    pub material: Material,
    /// How mass is distributed to the nodes.
    pub mass: MassKind,
}

impl BlockModel {
    /// The 800-element block of the paper: 20 x 10 crossed cells of 4 mm, plane stress
    /// (`spec/decisions.md` says why), polyurethane, consistent mass.
    pub fn of_the_paper() -> BlockModel {
        BlockModel {
            cells: (20, 10),
            cell: (whole(4), whole(4)),
            mesh: MeshKind::Crossed,
            plane: Plane::Stress,
            material: Material::polyurethane(),
            mass: MassKind::Consistent,
        }
    }

    /// The same block with `nx` x `ny` cells of another size: length and height are kept.
    /// Zero cells are refused when the block is built.
    ///
    /// ```
    /// use mceip_exact::{rational, whole};
    /// let fine = mceip_paper::BlockModel::of_the_paper().with_cells(32, 16);
    /// assert_eq!(fine.cell, (rational(5, 2), rational(5, 2)));
    /// ```
    pub fn with_cells(self, nx: usize, ny: usize) -> BlockModel {
        let width = part(self.length(), nx);
        let height = part(self.height(), ny);
        BlockModel {
            cells: (nx, ny),
            cell: (width, height),
            ..self
        }
    }

    /// The paper's block refined until `slip` nodes, 17 of every 20 cells along AB as in Fig. 3,
    /// are in impending slip: an even number of columns next to 20/17 `slip`, square crossed cells.
    /// With [`super::Block::sliding_states`] it gives the refined problems of the complete search
    /// (`slip` = 17 is the paper's own mesh; 24, 40, 60, 80, 150, 272 have 28, 48, 70, 94, 176, 320
    /// columns).
    pub fn refined(slip: usize) -> BlockModel {
        // The integer nearest to 10/17 slip.
        let half = slip.saturating_mul(20).saturating_add(17) / 34;
        let rows = half.max(1);
        BlockModel::of_the_paper().with_cells(rows.saturating_mul(2), rows)
    }

    /// 20 x 20 cells cut by `\` in plane strain, again 800 elements and 21 contact nodes: its
    /// MCEIP-mu with 17 slip nodes has 1719 solutions, a hard case for a complete search.
    pub fn backslash_strain() -> BlockModel {
        BlockModel {
            mesh: MeshKind::Backslash,
            plane: Plane::Strain,
            ..BlockModel::of_the_paper().with_cells(20, 20)
        }
    }

    /// Length L of the contact side, mm.
    pub fn length(&self) -> Rational {
        &self.cell.0 * Rational::from_integer(self.cells.0.into())
    }

    /// Height H, mm.
    pub fn height(&self) -> Rational {
        &self.cell.1 * Rational::from_integer(self.cells.1.into())
    }

    /// Refuses cells and materials that make no block. (The number of cells: when it is meshed.)
    pub(super) fn validate(&self) -> Result<(), SourceError> {
        let positive = [
            ("the width of a cell (mm)", &self.cell.0),
            ("the height of a cell (mm)", &self.cell.1),
        ];
        for (what, value) in positive {
            if !value.is_positive() {
                return Err(SourceError::NotPositive {
                    what,
                    got: value.clone(),
                });
            }
        }

        self.material.validate(self.plane)
    }
}

/// One of `count` equal parts of a length; the whole if there are none.
fn part(length: Rational, count: usize) -> Rational {
    length / Rational::from_integer(count.max(1).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    #[test]
    fn refined_meshes_keep_the_rectangle_and_the_share_of_slip() {
        let columns_by_slip = [
            (17, 20),
            (24, 28),
            (40, 48),
            (60, 70),
            (80, 94),
            (150, 176),
            (272, 320),
        ];
        for (slip, columns) in columns_by_slip {
            let model = BlockModel::refined(slip);
            assert_eq!(model.cells, (columns, columns / 2));
            assert_eq!(model.cell.0, model.cell.1);
            assert_eq!(model.length(), whole(80));
            assert_eq!(model.height(), whole(40));
        }

        assert_eq!(BlockModel::refined(17), BlockModel::of_the_paper());
        assert_eq!(BlockModel::refined(0).cells, (2, 1));
    }

    #[test]
    fn cells_without_extent_are_refused() {
        let flat = BlockModel {
            cell: (whole(1), whole(0)),
            ..BlockModel::of_the_paper()
        };
        assert!(matches!(
            flat.validate(),
            Err(SourceError::NotPositive {
                what: "the height of a cell (mm)",
                ..
            })
        ));

        let oblong = BlockModel::of_the_paper().with_cells(3, 7);
        assert_eq!(oblong.cell, (rational(80, 3), rational(40, 7)));
        assert_eq!(oblong.validate(), Ok(()));
    }
}
