//! The block of section 5, assembled exactly: P1 triangles, glued top, obstacle below.
//!
//! What the paper leaves open (`spec/decisions.md`): the paper's cells are cut by both diagonals,
//! plane stress, side CD (the top) glued and eliminated, slip to the left (S = 1).

use super::block_model::BlockModel;
use super::element::{MassKind, Point, mass, stiffness};
use super::error::SourceError;
use super::mesh::{Mesh, Shape};
use mceip_exact::{Rational, Sparse, whole};
use mceip_model::{Body, ContactState, ModelError, Particle, Problem, System, Unknown, Window};
use std::collections::BTreeMap;

/// A rectangular block on a flat obstacle, glued at its top.
#[derive(Debug, Clone)]
pub struct Block {
    /// K over the dofs below the glued side, N/mm.
    pub stiffness: Sparse,
    /// M over the same dofs, t.
    pub mass: Sparse,
    /// Position of each node, mm; node k owns dofs 2k (x) and 2k + 1 (y).
    pub nodes: Vec<Point>,
    /// Nodes on the contact side AB, left to right.
    pub contact: Vec<usize>,
    /// Triangles, over all nodes of the mesh including the glued ones.
    pub triangles: usize,
}

impl Block {
    /// The 800-element block of the paper, [`BlockModel::of_the_paper`] with this mass.
    pub fn of_the_paper(kind: MassKind) -> Block {
        let model = BlockModel {
            mass: kind,
            ..BlockModel::of_the_paper()
        };
        Block::new(&model)
            .expect("200 cells of a material that exists: counts_of_the_paper builds them")
    }

    /// Meshes and assembles a block. Nodes are numbered along the shorter side first.
    ///
    /// # Errors
    /// [`SourceError`]: no cells or too many, a length or a material that no body has.
    ///
    /// ```
    /// use mceip_paper::{Block, BlockModel, MeshKind, Plane};
    /// let model = BlockModel {
    ///     mesh: MeshKind::UnionJack,
    ///     plane: Plane::Strain,
    ///     ..BlockModel::of_the_paper().with_cells(8, 3)
    /// };
    /// let block = Block::new(&model).unwrap();
    /// assert_eq!(
    ///     (block.triangles, block.contact.len(), block.stiffness.rows()),
    ///     (48, 9, 54)
    /// );
    /// ```
    pub fn new(model: &BlockModel) -> Result<Block, SourceError> {
        model.validate()?;
        let (nx, ny) = model.cells;
        Ok(assemble(model, &Mesh::new(nx, ny, model.mesh)?))
    }

    /// The mechanical system with these contact states, left to right along AB; the obstacle lies
    /// below, so the y dof points away from it.
    ///
    /// # Errors
    /// [`ModelError`] for a number of states other than that of contact nodes, or bad friction.
    pub fn system(
        &self,
        states: &[ContactState],
        friction: Option<Rational>,
    ) -> Result<System, ModelError> {
        if states.len() != self.contact.len() {
            let (expected_rows, rows) = (self.contact.len(), states.len());
            return Err(ModelError::Shape {
                equation: "E9",
                what: "contact states",
                expected_rows,
                expected_cols: 1,
                rows,
                cols: 1,
            });
        }
        let particle = |(&node, &state): (&usize, &ContactState)| Particle {
            normal_direction: -1,
            ..Particle::plain(2 * node, 2 * node + 1, state)
        };
        let particles = self.contact.iter().zip(states).map(particle).collect();
        System::new(
            self.stiffness.clone(),
            Some(self.mass.clone()),
            friction,
            particles,
        )
    }

    /// The MCEIP-mu problem at these contact states; with friction given, MCEIP-lambda2 at that mu.
    ///
    /// # Errors
    /// As [`Block::system`]; also for states without an impending slip.
    pub fn problem(
        &self,
        states: &[ContactState],
        friction: Option<Rational>,
    ) -> Result<Problem, ModelError> {
        let unknown = if friction.is_some() {
            Unknown::Lambda2
        } else {
            Unknown::Mu
        };
        Problem::new(
            Body::System(self.system(states, friction)?),
            unknown,
            Window::all(),
        )
    }

    /// States of a block that slides to the left: the first `stick` nodes stuck, the next `slip`
    /// in impending slip with S = 1, the others free.
    ///
    /// # Errors
    /// [`SourceError::TooManyContacts`].
    pub fn sliding_states(
        &self,
        stick: usize,
        slip: usize,
    ) -> Result<Vec<ContactState>, SourceError> {
        let nodes = self.contact.len();
        let touching = stick.checked_add(slip).filter(|&n| n <= nodes);
        let touching = touching.ok_or(SourceError::TooManyContacts { nodes, stick, slip })?;
        let state = |i: usize| match i {
            i if i < stick => ContactState::Stick,
            i if i < touching => ContactState::Slip { sign: 1 },
            _ => ContactState::Free,
        };
        Ok((0..nodes).map(state).collect())
    }

    /// The states of [`Block::sliding_states`] for `slip` nodes on the cone of which a tenth of the
    /// contact nodes, rounded, then sticks: n_s = 21, 35, 53, 70 for `slip` = 24, 40, 60, 80.
    ///
    /// # Errors
    /// [`SourceError::TooManyContacts`].
    pub fn sliding_states_with_tenth_stuck(
        &self,
        slip: usize,
    ) -> Result<Vec<ContactState>, SourceError> {
        let stick = ((self.contact.len() + 5) / 10).min(slip);
        self.sliding_states(stick, slip - stick)
    }
}

/// Element stiffness and mass of one shape of triangle: 6 x 6, and 3 x 3 for each direction.
type ElementMatrices = (Vec<Vec<Rational>>, Vec<Vec<Rational>>);

/// Adds up the elements. Translates of a triangle share their matrices: a few shapes in all.
fn assemble(model: &BlockModel, mesh: &Mesh) -> Block {
    let half = (&model.cell.0 / whole(2), &model.cell.1 / whole(2));
    let place = |x: i64, y: i64| (&half.0 * whole(x), &half.1 * whole(y));
    let mut shapes: BTreeMap<Shape, ElementMatrices> = BTreeMap::new();
    let (mut k, mut m) = (Vec::new(), Vec::new());
    for triangle in &mesh.triangles {
        let shape = mesh.shape(triangle);
        let (ke, me) = shapes.entry(shape).or_insert_with(|| {
            let p = [
                place(0, 0),
                place(shape[0].0, shape[0].1),
                place(shape[1].0, shape[1].1),
            ];
            let me = (0..3)
                .map(|a| {
                    (0..3)
                        .map(|b| mass(&p, &model.material, model.mass, a, b))
                        .collect()
                })
                .collect();
            (stiffness(&p, &model.material, model.plane), me)
        });
        for (i, row) in ke.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                let (Some(di), Some(dj)) = (mesh.dof(triangle, i), mesh.dof(triangle, j)) else {
                    continue;
                };
                k.push((di, dj, value.clone()));
                if i % 2 == j % 2 {
                    m.push((di, dj, me[i / 2][j / 2].clone()));
                }
            }
        }
    }
    let kept = mesh
        .points
        .iter()
        .zip(&mesh.number)
        .filter(|(_, n)| n.is_some());
    let nodes: Vec<Point> = kept.map(|(p, _)| place(p.0.into(), p.1.into())).collect();
    let dofs = 2 * nodes.len();
    Block {
        stiffness: Sparse::from_entries(dofs, dofs, k),
        mass: Sparse::from_entries(dofs, dofs, m),
        nodes,
        contact: mesh.contact.clone(),
        triangles: mesh.triangles.len(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Material, MeshKind, Plane};
    use mceip_exact::rational;

    fn small(nx: usize, ny: usize, mass: MassKind) -> BlockModel {
        let cell = (whole(2), whole(2));
        BlockModel {
            cells: (nx, ny),
            cell,
            mass,
            ..BlockModel::of_the_paper()
        }
    }

    #[test]
    fn counts_of_the_paper() {
        let block = Block::of_the_paper(MassKind::Consistent);
        assert_eq!(
            (
                block.triangles,
                block.nodes.len(),
                block.contact.len(),
                block.stiffness.rows()
            ),
            (800, 410, 21, 820)
        );
        assert_eq!(block.stiffness.first_asymmetry(), None);
        assert!(
            block
                .contact
                .windows(2)
                .all(|w| block.nodes[w[0]].0 < block.nodes[w[1]].0)
        );
        let band = block
            .stiffness
            .entries()
            .map(|(i, j, _)| i.abs_diff(j))
            .max()
            .unwrap();
        assert!(band <= 66, "half-bandwidth {band}");
        assert_eq!(
            Block::new(&BlockModel::of_the_paper()).unwrap().stiffness,
            block.stiffness
        );
    }

    /// A uniform strain needs no force inside, on every mesh, in both planes, on oblong cells.
    #[test]
    fn patch_test_uniform_strain_needs_no_interior_force() {
        for (mesh, plane) in MeshKind::ALL
            .into_iter()
            .flat_map(|m| Plane::ALL.map(|p| (m, p)))
        {
            let cell = (whole(2), rational(5, 3));
            let block = Block::new(&BlockModel {
                cell,
                mesh,
                plane,
                ..small(4, 4, MassKind::Lumped)
            })
            .unwrap();
            let u: Vec<Rational> = block
                .nodes
                .iter()
                .flat_map(|(x, y)| [x * rational(1, 7) + y, y * rational(-2, 5)])
                .collect();
            let force = block.stiffness.times(&u);
            let top = rational(5, 1); // the row below the glued nodes misses their forces
            let interior =
                |(x, y): &Point| *x > whole(0) && *x < whole(8) && *y > whole(0) && *y < top;
            let inside: Vec<usize> = (0..block.nodes.len())
                .filter(|&k| interior(&block.nodes[k]))
                .collect();
            assert!(inside.len() >= 6);
            assert!(
                inside
                    .iter()
                    .all(|&k| force[2 * k] == whole(0) && force[2 * k + 1] == whole(0)),
                "{mesh:?} {plane:?}"
            );
            assert_ne!(force[2 * block.contact[0]], whole(0));
        }
    }

    #[test]
    fn lumping_keeps_the_mass_and_makes_it_diagonal() {
        let of = |kind| Block::new(&small(2, 2, kind)).unwrap().mass;
        let (consistent, lumped) = (of(MassKind::Consistent), of(MassKind::Lumped));
        assert!(lumped.entries().all(|(i, j, _)| i == j));
        assert_ne!(consistent, lumped);
        // A node off the glued side keeps its row sum; the corner A lies in two of a cell's
        // quarters.
        let row = |m: &Sparse, i: usize| m.row(i).iter().map(|e| e.1.clone()).sum::<Rational>();
        let material = Material::polyurethane();
        assert_eq!(
            row(&lumped, 0),
            &material.density * &material.thickness * rational(2, 3)
        );
        assert_eq!(row(&consistent, 0), row(&lumped, 0));
    }

    #[test]
    fn states_are_counted() {
        let block = Block::new(&small(6, 1, MassKind::Lumped)).unwrap();
        assert!(block.system(&[], None).is_err());
        let states = block.sliding_states(1, 4).unwrap();
        let words: Vec<&str> = states.iter().map(|s| s.word()).collect();
        assert_eq!(
            words,
            ["stick", "slip", "slip", "slip", "slip", "free", "free"]
        );
        assert_eq!(
            block.sliding_states(4, 4),
            Err(SourceError::TooManyContacts {
                nodes: 7,
                stick: 4,
                slip: 4
            })
        );
        assert!(block.sliding_states(usize::MAX, 1).is_err());
        let slips = |s: Vec<ContactState>| {
            s.iter()
                .filter(|c| matches!(c, ContactState::Slip { .. }))
                .count()
        };
        assert_eq!(slips(block.sliding_states_with_tenth_stuck(5).unwrap()), 4);
        assert!(
            block
                .problem(&block.sliding_states(7, 0).unwrap(), None)
                .is_err(),
            "nothing slips"
        );
        assert_eq!(
            block.problem(&states, Some(whole(2))).unwrap().unknown(),
            Unknown::Lambda2
        );
    }
}
