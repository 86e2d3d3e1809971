//! The polyurethane block of section 5: crossed P1 mesh, exact K and M, the two published states.
//!
//! What the paper leaves open (`spec/decisions.md`): each square cell is cut by both diagonals,
//! plane stress, side CD (the top) glued and eliminated, obstacle below, slip to the left (S = 1).

use super::element::{MassKind, Material, Point, mass, stiffness};
use crate::exact::{Rational, Sparse, whole};
use crate::model::{Body, ContactState, ModelError, Particle, Problem, System, Unknown, Window};
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
    /// The 800-element block of the paper: 20 x 10 cells of 4 mm.
    pub fn of_the_paper(kind: MassKind) -> Block {
        Block::new(20, 10, &whole(4), &Material::polyurethane(), kind)
    }

    /// `nx` x `ny` square cells of side `size` (mm), each cut by both diagonals into four triangles.
    ///
    /// Nodes are numbered column by column, bottom to top, the cell centres of a column after its
    /// grid nodes: the half-bandwidth stays near 2 (3 ny), which the exact condensation profits from.
    pub fn new(nx: usize, ny: usize, size: &Rational, material: &Material, kind: MassKind) -> Block {
        let mesh = Mesh::new(nx, ny, size);
        let (mut k, mut m) = (Vec::new(), Vec::new());
        for triangle in &mesh.triangles {
            let p = triangle.map(|v| mesh.points[v].clone());
            let ke = stiffness(&p, material);
            let dof = |i: usize| mesh.number[triangle[i / 2]].map(|n| 2 * n + i % 2);
            for (i, row) in ke.iter().enumerate() {
                for (j, value) in row.iter().enumerate() {
                    let (Some(di), Some(dj)) = (dof(i), dof(j)) else { continue };
                    k.push((di, dj, value.clone()));
                    if i % 2 == j % 2 {
                        m.push((di, dj, mass(&p, material, kind, i / 2, j / 2)));
                    }
                }
            }
        }
        let nodes = mesh.free_nodes();
        let dofs = 2 * nodes.len();
        let contact = (0..=nx).filter_map(|i| mesh.number[mesh.grid[&(i, 0)]]).collect();
        let (stiffness, mass) = (Sparse::from_entries(dofs, dofs, k), Sparse::from_entries(dofs, dofs, m));
        Block { stiffness, mass, nodes, contact, triangles: mesh.triangles.len() }
    }

    /// The mechanical system with these contact states, left to right along AB; the obstacle lies
    /// below, so the y dof points away from it.
    ///
    /// # Errors
    /// [`ModelError`] for a number of states other than that of contact nodes, or bad friction.
    pub fn system(&self, states: &[ContactState], friction: Option<Rational>) -> Result<System, ModelError> {
        if states.len() != self.contact.len() {
            let (expected_rows, rows) = (self.contact.len(), states.len());
            return Err(ModelError::Shape { equation: "E9", what: "contact states", expected_rows, expected_cols: 1, rows, cols: 1 });
        }
        let particle =
            |(&node, &state): (&usize, &ContactState)| Particle { normal_direction: -1, ..Particle::plain(2 * node, 2 * node + 1, state) };
        let particles = self.contact.iter().zip(states).map(particle).collect();
        System::new(self.stiffness.clone(), Some(self.mass.clone()), friction, particles)
    }
}

/// A state of the loading path whose MCEIP-mu value the paper prints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PublishedState {
    /// 2 nodes stuck, 15 in impending slip, 4 free (Fig. 2).
    FifteenSlip,
    /// 17 nodes in impending slip, 4 free (Fig. 3).
    SeventeenSlip,
}

impl PublishedState {
    /// Both, in the paper's order.
    pub const ALL: [PublishedState; 2] = [PublishedState::FifteenSlip, PublishedState::SeventeenSlip];

    /// The value of mu as printed in the paper.
    pub fn printed_mu(self) -> &'static str {
        match self {
            PublishedState::FifteenSlip => "60.81",
            PublishedState::SeventeenSlip => "1.71",
        }
    }

    /// A short name.
    pub fn name(self) -> &'static str {
        match self {
            PublishedState::FifteenSlip => "2 stick + 15 slip + 4 free",
            PublishedState::SeventeenSlip => "17 slip + 4 free",
        }
    }

    /// The states of the 21 contact nodes, left to right.
    pub fn states(self) -> Vec<ContactState> {
        let stick = if self == PublishedState::FifteenSlip { 2 } else { 0 };
        let state = |i: usize| match i {
            i if i < stick => ContactState::Stick,
            i if i < 17 => ContactState::Slip { sign: 1 },
            _ => ContactState::Free,
        };
        (0..21).map(state).collect()
    }

    /// The MCEIP-mu problem of this state on the paper's block.
    ///
    /// # Errors
    /// [`ModelError`]; none for the block as given.
    pub fn problem(self, block: &Block) -> Result<Problem, ModelError> {
        let system = block.system(&self.states(), None)?;
        Ok(Problem::new(Body::System(system), Unknown::Mu, Window::all())?.named(format!("block, {}", self.name())))
    }
}

/// Points, triangles and the numbering of nodes that are not glued.
struct Mesh {
    points: Vec<Point>,
    grid: BTreeMap<(usize, usize), usize>,
    triangles: Vec<[usize; 3]>,
    /// New number of each point, `None` on the glued side.
    number: Vec<Option<usize>>,
}

impl Mesh {
    fn new(nx: usize, ny: usize, size: &Rational) -> Mesh {
        let half = size / whole(2);
        let at = |i: usize, j: usize| (&half * whole(i as i64), &half * whole(j as i64)); // in half cells
        let (mut points, mut grid, mut centers) = (Vec::new(), BTreeMap::new(), BTreeMap::new());
        for i in 0..=nx {
            for j in 0..=ny {
                grid.insert((i, j), points.len());
                points.push(at(2 * i, 2 * j));
            }
            for j in (0..ny).filter(|_| i < nx) {
                centers.insert((i, j), points.len());
                points.push(at(2 * i + 1, 2 * j + 1));
            }
        }
        let mut triangles = Vec::new();
        for (&(i, j), &center) in &centers {
            let corner = [grid[&(i, j)], grid[&(i + 1, j)], grid[&(i + 1, j + 1)], grid[&(i, j + 1)]];
            triangles.extend((0..4).map(|s| [corner[s], corner[(s + 1) % 4], center])); // counter-clockwise
        }
        let top = at(0, 2 * ny).1;
        let mut next = 0;
        let number = points
            .iter()
            .map(|p| {
                let free = p.1 != top;
                next += usize::from(free);
                free.then(|| next - 1)
            })
            .collect();
        Mesh { points, grid, triangles, number }
    }

    fn free_nodes(&self) -> Vec<Point> {
        self.points.iter().zip(&self.number).filter(|(_, n)| n.is_some()).map(|(p, _)| p.clone()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational;

    #[test]
    fn counts_of_the_paper() {
        let block = Block::of_the_paper(MassKind::Consistent);
        assert_eq!((block.triangles, block.nodes.len(), block.contact.len(), block.stiffness.rows()), (800, 410, 21, 820));
        assert_eq!(block.stiffness.first_asymmetry(), None);
        assert!(block.contact.windows(2).all(|w| block.nodes[w[0]].0 < block.nodes[w[1]].0));
        let band = block.stiffness.entries().map(|(i, j, _)| i.abs_diff(j)).max().unwrap();
        assert!(band <= 66, "half-bandwidth {band}");
    }

    #[test]
    fn patch_test_uniform_strain_needs_no_interior_force() {
        let block = Block::new(3, 4, &whole(2), &Material::polyurethane(), MassKind::Lumped);
        let u: Vec<Rational> = block.nodes.iter().flat_map(|(x, y)| [x * rational(1, 7) + y, y * rational(-2, 5)]).collect();
        let force = block.stiffness.times(&u);
        let interior = |(x, y): &Point| *x > whole(0) && *x < whole(6) && *y > whole(0) && *y < whole(6);
        let inside: Vec<usize> = (0..block.nodes.len()).filter(|&k| interior(&block.nodes[k])).collect();
        assert!(inside.len() > 8);
        assert!(inside.iter().all(|&k| force[2 * k] == whole(0) && force[2 * k + 1] == whole(0)));
        assert_ne!(force[2 * block.contact[0]], whole(0));
    }

    #[test]
    fn lumping_keeps_row_sums() {
        let rows = |kind| {
            let block = Block::new(2, 2, &whole(1), &Material::polyurethane(), kind);
            let ones = vec![whole(1); block.mass.rows()];
            (block.mass.times(&ones).into_iter().sum::<Rational>(), block.mass)
        };
        let ((_, consistent), (lumped_sum, lumped)) = (rows(MassKind::Consistent), rows(MassKind::Lumped));
        assert!(lumped.entries().all(|(i, j, _)| i == j));
        assert_ne!(consistent, lumped);
        // Both directions of all nodes but the glued ones' share.
        assert!(lumped_sum > whole(0));
    }

    #[test]
    fn states_are_the_published_ones() {
        let count = |s: PublishedState, f: fn(&ContactState) -> bool| s.states().iter().filter(|c| f(c)).count();
        let slip = |c: &ContactState| matches!(c, ContactState::Slip { sign: 1 });
        assert_eq!((count(PublishedState::FifteenSlip, slip), count(PublishedState::SeventeenSlip, slip)), (15, 17));
        assert_eq!(count(PublishedState::FifteenSlip, |c| *c == ContactState::Stick), 2);
        assert!(Block::new(2, 1, &whole(1), &Material::polyurethane(), MassKind::Lumped).system(&[], None).is_err());
    }
}
