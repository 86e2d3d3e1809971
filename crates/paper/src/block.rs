//! The block of section 5, assembled exactly: P1 triangles, glued top, obstacle below.
//!
//! K and M are sums of element matrices (`element`) over a mesh (`mesh`), without the dofs of the
//! glued side. A [`BlockModel`] goes in. With the contact state of each node a block becomes a
//! mechanical system and an eigenproblem. `mceip block`, the loading path, the benchmarks and most
//! large tests start here.
//!
//! What the paper leaves open (`spec/decisions.md`): the paper's cells are cut by both diagonals,
//! plane stress, side CD (the top) glued and eliminated, slip to the left (S = 1).

use super::block_model::BlockModel;
use super::element::{MassKind, PlanePoint, mass, stiffness};
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
    pub nodes: Vec<PlanePoint>,
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
            return Err(ModelError::Shape {
                equation: "E9",
                what: "contact states",
                expected_rows: self.contact.len(),
                expected_cols: 1,
                rows: states.len(),
                cols: 1,
            });
        }

        let mut particles = Vec::with_capacity(states.len());
        for (&node, &state) in self.contact.iter().zip(states) {
            particles.push(Particle {
                normal_direction: -1,
                ..Particle::plain(2 * node, 2 * node + 1, state)
            });
        }

        let stiffness = self.stiffness.clone();
        let mass = self.mass.clone();
        System::new(stiffness, Some(mass), friction, particles)
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
        let system = self.system(states, friction)?;
        Problem::new(Body::System(system), unknown, Window::all())
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
        let touching = stick
            .checked_add(slip)
            .filter(|&touching| touching <= nodes)
            .ok_or(SourceError::TooManyContacts { nodes, stick, slip })?;

        let mut states = vec![ContactState::Free; nodes];
        states[..stick].fill(ContactState::Stick);
        states[stick..touching].fill(ContactState::Slip { sign: 1 });
        Ok(states)
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
        let tenth = (self.contact.len() + 5) / 10;
        let stick = tenth.min(slip);
        self.sliding_states(stick, slip - stick)
    }
}

/// The matrices of one shape of triangle.
struct ElementMatrices {
    /// Of the six dofs.
    stiffness: Vec<Vec<Rational>>,
    /// Of the three vertices, the same in x and in y.
    mass: Vec<Vec<Rational>>,
}

impl ElementMatrices {
    fn new(vertices: &[PlanePoint; 3], model: &BlockModel) -> ElementMatrices {
        let mut couplings = vec![vec![whole(0); 3]; 3];
        for a in 0..3 {
            for b in 0..3 {
                couplings[a][b] = mass(vertices, &model.material, model.mass, a, b);
            }
        }

        ElementMatrices {
            stiffness: stiffness(vertices, &model.material, model.plane),
            mass: couplings,
        }
    }
}

/// The size of half a cell, in which the mesh counts.
struct HalfCell {
    width: Rational,
    height: Rational,
}

impl HalfCell {
    fn point(&self, x: i64, y: i64) -> PlanePoint {
        (&self.width * whole(x), &self.height * whole(y))
    }

    /// The triangle of this shape with its first vertex at the origin.
    fn triangle(&self, shape: Shape) -> [PlanePoint; 3] {
        let [first, second] = shape;
        [
            self.point(0, 0),
            self.point(first.0, first.1),
            self.point(second.0, second.1),
        ]
    }
}

/// Adds up the elements. Translates of a triangle share their matrices: a few shapes in all.
fn assemble(model: &BlockModel, mesh: &Mesh) -> Block {
    let half_cell = HalfCell {
        width: &model.cell.0 / whole(2),
        height: &model.cell.1 / whole(2),
    };

    let mut shapes: BTreeMap<Shape, ElementMatrices> = BTreeMap::new();
    let mut stiffness = Vec::new();
    let mut mass = Vec::new();
    for triangle in &mesh.triangles {
        let shape = mesh.shape(triangle);
        let element = shapes
            .entry(shape)
            .or_insert_with(|| ElementMatrices::new(&half_cell.triangle(shape), model));

        for i in 0..6 {
            for j in 0..6 {
                let Some(row) = mesh.dof(triangle, i) else {
                    continue;
                };
                let Some(column) = mesh.dof(triangle, j) else {
                    continue;
                };
                stiffness.push((row, column, element.stiffness[i][j].clone()));
                let same_direction = i % 2 == j % 2;
                if same_direction {
                    mass.push((row, column, element.mass[i / 2][j / 2].clone()));
                }
            }
        }
    }

    let mut nodes = Vec::with_capacity(mesh.free_nodes());
    for (&(x, y), number) in mesh.points.iter().zip(&mesh.number) {
        if number.is_some() {
            nodes.push(half_cell.point(x.into(), y.into()));
        }
    }

    let dofs = 2 * nodes.len();
    Block {
        stiffness: Sparse::from_entries(dofs, dofs, stiffness),
        mass: Sparse::from_entries(dofs, dofs, mass),
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

    /// Cells of 2 mm.
    fn small(nx: usize, ny: usize, mass: MassKind) -> BlockModel {
        BlockModel {
            cells: (nx, ny),
            cell: (whole(2), whole(2)),
            mass,
            ..BlockModel::of_the_paper()
        }
    }

    #[test]
    fn counts_of_the_paper() {
        let block = Block::of_the_paper(MassKind::Consistent);

        assert_eq!(block.triangles, 800);
        assert_eq!(block.nodes.len(), 410);
        assert_eq!(block.contact.len(), 21);
        assert_eq!(block.stiffness.rows(), 820);
        assert_eq!(block.stiffness.first_asymmetry(), None);

        for neighbours in block.contact.windows(2) {
            let left = &block.nodes[neighbours[0]];
            let right = &block.nodes[neighbours[1]];
            assert!(left.0 < right.0);
        }

        let entries = block.stiffness.entries();
        let band = entries.map(|(i, j, _)| i.abs_diff(j)).max().unwrap();
        assert!(band <= 66, "half-bandwidth {band}");

        let same = Block::new(&BlockModel::of_the_paper()).unwrap();
        assert_eq!(same.stiffness, block.stiffness);
    }

    /// A uniform strain needs no force inside, on every mesh, in both planes, on oblong cells.
    #[test]
    fn patch_test_uniform_strain_needs_no_interior_force() {
        for mesh in MeshKind::ALL {
            for plane in Plane::ALL {
                patch_test(mesh, plane);
            }
        }
    }

    fn patch_test(mesh: MeshKind, plane: Plane) {
        let model = BlockModel {
            cell: (whole(2), rational(5, 3)),
            mesh,
            plane,
            ..small(4, 4, MassKind::Lumped)
        };
        let block = Block::new(&model).unwrap();
        let mut u = Vec::new();
        for (x, y) in &block.nodes {
            u.extend([x * rational(1, 7) + y, y * rational(-2, 5)]);
        }

        let force = block.stiffness.times(&u);

        let mut inside = 0;
        for (node, point) in block.nodes.iter().enumerate() {
            if is_interior(point) {
                inside += 1;
                assert_eq!(force[2 * node], whole(0), "{mesh:?} {plane:?}");
                assert_eq!(force[2 * node + 1], whole(0), "{mesh:?} {plane:?}");
            }
        }
        assert!(inside >= 6);
        assert_ne!(force[2 * block.contact[0]], whole(0));
    }

    /// Off the sides of the block of [`patch_test`], and off the row of nodes below the glued side,
    /// which misses the forces of the glued nodes.
    fn is_interior((x, y): &PlanePoint) -> bool {
        let top = rational(5, 1);
        *x > whole(0) && *x < whole(8) && *y > whole(0) && *y < top
    }

    fn row_sum(matrix: &Sparse, row: usize) -> Rational {
        matrix.row(row).iter().map(|entry| entry.1.clone()).sum()
    }

    #[test]
    fn lumping_keeps_the_mass_and_makes_it_diagonal() {
        let consistent = Block::new(&small(2, 2, MassKind::Consistent)).unwrap();
        let lumped = Block::new(&small(2, 2, MassKind::Lumped)).unwrap();

        assert!(lumped.mass.entries().all(|(i, j, _)| i == j));
        assert_ne!(consistent.mass, lumped.mass);

        // A node off the glued side keeps its row sum; the corner A lies in two of a cell's
        // quarters.
        let material = Material::polyurethane();
        let corner = &material.density * &material.thickness * rational(2, 3);
        assert_eq!(row_sum(&lumped.mass, 0), corner);
        assert_eq!(row_sum(&consistent.mass, 0), corner);
    }

    #[test]
    fn states_are_counted() {
        let block = Block::new(&small(6, 1, MassKind::Lumped)).unwrap();
        assert!(block.system(&[], None).is_err());

        let states = block.sliding_states(1, 4).unwrap();
        let words: Vec<&str> = states.iter().map(|state| state.word()).collect();
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

        let tenth_stuck = block.sliding_states_with_tenth_stuck(5).unwrap();
        let slips = tenth_stuck.iter().filter(|state| state.word() == "slip");
        assert_eq!(slips.count(), 4);

        let all_stuck = block.sliding_states(7, 0).unwrap();
        assert!(block.problem(&all_stuck, None).is_err(), "nothing slips");
        let problem = block.problem(&states, Some(whole(2))).unwrap();
        assert_eq!(problem.unknown(), Unknown::Lambda2);
    }
}
