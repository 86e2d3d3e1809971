//! The same block in doubles, for meshes too large for exact matrices: written out anew, so that
//! the two assemblies check each other.
//!
//! Element matrices of linear triangles, t A B'DB and the mass, are added up over the mesh. A
//! [`BlockModel`] goes in; K, M and the contact nodes come out. `mceip block --scale` and the tests
//! of the condensation in doubles use it.
#![allow(clippy::float_arithmetic)]

use super::block_model::BlockModel;
use super::element::{Elasticity, MassKind};
use super::error::SourceError;
use super::mesh::{Mesh, Shape};
use mceip_exact::to_f64;
use mceip_model::{ContactState, Particle};
use std::collections::BTreeMap;

/// A sparse square matrix of doubles: entries sorted by row, then column, each place once.
#[derive(Debug, Clone, PartialEq)]
pub struct DoubleMatrix {
    /// Rows and columns.
    pub order: usize,
    /// (row, column, value).
    pub entries: Vec<(usize, usize, f64)>,
}

impl DoubleMatrix {
    /// The product with a vector of length `order`.
    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.order];
        for &(row, column, value) in &self.entries {
            product[row] += value * x[column];
        }

        product
    }
}

/// A block assembled in doubles; numbering as in [`super::Block`].
#[derive(Debug, Clone, PartialEq)]
pub struct DoubleBlock {
    /// K over the dofs below the glued side, N/mm.
    pub stiffness: DoubleMatrix,
    /// M over the same dofs, t.
    pub mass: DoubleMatrix,
    /// Nodes on the contact side AB, left to right; node k owns dofs 2k (x) and 2k + 1 (y).
    pub contact: Vec<usize>,
    /// Position of the node of each dof, mm.
    pub points: Vec<[f64; 2]>,
}

impl DoubleBlock {
    /// Meshes and assembles a block. Entry (i, j) is within 8 units in the last place of the larger
    /// of the diagonal entries i and j from the exact one (the tests of this file hold it against
    /// [`super::Block`]).
    ///
    /// # Errors
    /// [`SourceError`] as [`super::Block::new`]; also for numbers too large for doubles.
    pub fn new(model: &BlockModel) -> Result<DoubleBlock, SourceError> {
        model.validate()?;
        let (nx, ny) = model.cells;
        let mesh = Mesh::new(nx, ny, model.mesh)?;
        let half_width = to_f64(&model.cell.0) / 2.0;
        let half_height = to_f64(&model.cell.1) / 2.0;

        let mut shapes: BTreeMap<Shape, DoubleElement> = BTreeMap::new();
        let mut stiffness = Vec::new();
        let mut mass = Vec::new();
        for triangle in &mesh.triangles {
            let shape = mesh.shape(triangle);
            let element = shapes.entry(shape).or_insert_with(|| {
                let edges = Edges::of(shape, half_width, half_height);
                DoubleElement::new(&edges, model)
            });

            for i in 0..6 {
                for j in 0..6 {
                    let Some(row) = mesh.dof(triangle, i) else {
                        continue;
                    };
                    let Some(column) = mesh.dof(triangle, j) else {
                        continue;
                    };
                    stiffness.push((row, column, element.stiffness[i][j]));
                    let coupling = element.mass_coupling(i, j);
                    if coupling != 0.0 {
                        mass.push((row, column, coupling));
                    }
                }
            }
        }

        let mut points = Vec::with_capacity(2 * mesh.free_nodes());
        for (&(x, y), number) in mesh.points.iter().zip(&mesh.number) {
            if number.is_some() {
                let point = [half_width * f64::from(x), half_height * f64::from(y)];
                points.extend([point; 2]);
            }
        }

        let order = 2 * mesh.free_nodes();
        Ok(DoubleBlock {
            stiffness: merge("K", order, stiffness)?,
            mass: merge("M", order, mass)?,
            contact: mesh.contact,
            points,
        })
    }

    /// The contact nodes with these states, left to right, as in [`super::Block::system`]; nodes
    /// beyond the states given are free.
    pub fn particles(&self, states: &[ContactState]) -> Vec<Particle> {
        let mut particles = Vec::with_capacity(self.contact.len());
        for (k, &node) in self.contact.iter().enumerate() {
            let state = states.get(k).copied().unwrap_or(ContactState::Free);
            particles.push(Particle {
                normal_direction: -1,
                ..Particle::plain(2 * node, 2 * node + 1, state)
            });
        }

        particles
    }
}

/// The triangle (0, 0), (x1, y1), (x2, y2), mm.
struct Edges {
    x1: f64,
    y1: f64,
    x2: f64,
    y2: f64,
}

impl Edges {
    fn of(shape: Shape, half_width: f64, half_height: f64) -> Edges {
        let [first, second] = shape;
        Edges {
            x1: half_width * first.0 as f64,
            y1: half_height * first.1 as f64,
            x2: half_width * second.0 as f64,
            y2: half_height * second.1 as f64,
        }
    }

    fn twice_area(&self) -> f64 {
        self.x1 * self.y2 - self.x2 * self.y1
    }

    /// 2A times the strains (eps_x, eps_y, gamma_xy) for a unit displacement of each of the six
    /// dofs.
    fn unit_strains(&self) -> [[f64; 3]; 6] {
        // 2A grad of the shape functions.
        let by_x = [self.y1 - self.y2, self.y2, -self.y1];
        let by_y = [self.x2 - self.x1, -self.x2, self.x1];

        let mut strains = [[0.0; 3]; 6];
        for vertex in 0..3 {
            strains[2 * vertex] = [by_x[vertex], 0.0, by_y[vertex]];
            strains[2 * vertex + 1] = [0.0, by_y[vertex], by_x[vertex]];
        }

        strains
    }
}

/// The matrices of one shape of triangle.
struct DoubleElement {
    /// Of the six dofs, N/mm.
    stiffness: [[f64; 6]; 6],
    /// Of the three vertices, t.
    mass: [[f64; 3]; 3],
}

impl DoubleElement {
    fn new(edges: &Edges, model: &BlockModel) -> DoubleElement {
        DoubleElement {
            stiffness: stiffness(edges, model),
            mass: mass(edges, model),
        }
    }

    /// Entry of the mass matrix over the six dofs: x and y do not couple.
    fn mass_coupling(&self, i: usize, j: usize) -> f64 {
        if i % 2 == j % 2 {
            self.mass[i / 2][j / 2]
        } else {
            0.0
        }
    }
}

/// t A B'DB.
fn stiffness(edges: &Edges, model: &BlockModel) -> [[f64; 6]; 6] {
    let elasticity = model.material.elasticity(model.plane);
    let scale = to_f64(&model.material.thickness) / (2.0 * edges.twice_area());
    let strains = edges.unit_strains();

    let mut matrix = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            let strain = strains[i];
            let stress = stress(strains[j], &elasticity);
            let work = strain[0] * stress[0] + strain[1] * stress[1] + strain[2] * stress[2];
            matrix[i][j] = scale * work;
        }
    }

    matrix
}

/// D times a strain.
fn stress(strain: [f64; 3], elasticity: &Elasticity) -> [f64; 3] {
    let d11 = to_f64(&elasticity.d11);
    let d12 = to_f64(&elasticity.d12);
    let d33 = to_f64(&elasticity.d33);
    [
        d11 * strain[0] + d12 * strain[1],
        d12 * strain[0] + d11 * strain[1],
        d33 * strain[2],
    ]
}

/// rho t A / 12 (1 + delta_ab), or rho t A / 3 on the diagonal.
fn mass(edges: &Edges, model: &BlockModel) -> [[f64; 3]; 3] {
    let density_times_thickness = &model.material.density * &model.material.thickness;
    let total = to_f64(&density_times_thickness) * edges.twice_area() / 2.0;

    let diagonal = match model.mass {
        MassKind::Consistent => total / 6.0,
        MassKind::Lumped => total / 3.0,
    };
    let coupling = match model.mass {
        MassKind::Consistent => total / 12.0,
        MassKind::Lumped => 0.0,
    };

    let mut matrix = [[coupling; 3]; 3];
    for vertex in 0..3 {
        matrix[vertex][vertex] = diagonal;
    }

    matrix
}

/// Sums entries of one place, in the order of the elements; `what` is named in the error.
fn merge(
    what: &'static str,
    order: usize,
    list: Vec<(usize, usize, f64)>,
) -> Result<DoubleMatrix, SourceError> {
    // Counted into rows first: rows are short, the list is not.
    let start = row_starts(order, &list);
    let mut next = start.clone();
    let mut by_row = vec![(0, 0.0); list.len()];
    for (row, column, value) in list {
        by_row[next[row]] = (column, value);
        next[row] += 1;
    }

    let mut entries: Vec<(usize, usize, f64)> = Vec::with_capacity(by_row.len() / 2);
    for row in 0..order {
        let list = &mut by_row[start[row]..start[row + 1]];
        list.sort_by_key(|entry| entry.0); // stable: elements stay in order
        for &(column, value) in &*list {
            match entries.last_mut() {
                Some(last) if (last.0, last.1) == (row, column) => last.2 += value,
                _ => entries.push((row, column, value)),
            }
        }
    }

    match entries.iter().find(|entry| !entry.2.is_finite()) {
        Some(entry) => Err(SourceError::NotFinite {
            what,
            got: entry.2.to_string(),
        }),
        None => Ok(DoubleMatrix { order, entries }),
    }
}

/// Where each row begins in a list sorted by rows, and at the end the length of the list.
fn row_starts(order: usize, list: &[(usize, usize, f64)]) -> Vec<usize> {
    let mut starts = vec![0; order + 1];
    for entry in list {
        starts[entry.0 + 1] += 1;
    }

    for row in 0..order {
        starts[row + 1] += starts[row];
    }

    starts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Block, Material, MeshKind, Plane};
    use mceip_exact::{Sparse, parse, rational};

    /// Every exact entry, converted, against the double one, in units in the last place of the
    /// larger of the two diagonals; places the exact matrix leaves out hold rounding only.
    fn largest_difference(exact: &Sparse, doubles: &DoubleMatrix) -> f64 {
        assert_eq!(exact.rows(), doubles.order);
        for (i, j, _) in exact.entries() {
            let place = doubles
                .entries
                .binary_search_by_key(&(i, j), |e| (e.0, e.1));
            assert!(place.is_ok(), "({i}, {j}) is missing");
        }

        let mut diagonal = Vec::with_capacity(doubles.order);
        for i in 0..doubles.order {
            diagonal.push(to_f64(&exact.get(i, i)));
        }
        let mut largest: f64 = 0.0;
        for &(i, j, value) in &doubles.entries {
            let difference = (to_f64(&exact.get(i, j)) - value).abs();
            let unit = f64::EPSILON * diagonal[i].max(diagonal[j]);
            largest = largest.max(difference / unit);
        }
        largest
    }

    fn assert_agreement(model: &BlockModel) {
        let exact = Block::new(model).unwrap();
        let doubles = DoubleBlock::new(model).unwrap();

        assert_eq!(exact.contact, doubles.contact);
        assert_eq!(doubles.points.len(), doubles.stiffness.order);
        for (dof, point) in doubles.points.iter().enumerate() {
            let (x, y) = &exact.nodes[dof / 2];
            let distance = (point[0] - to_f64(x)).abs() + (point[1] - to_f64(y)).abs();
            assert!(distance < 1e-13);
        }

        let stiffness = largest_difference(&exact.stiffness, &doubles.stiffness);
        let mass = largest_difference(&exact.mass, &doubles.mass);
        assert!(
            stiffness <= 8.0 && mass <= 8.0,
            "{model:?}: {stiffness} {mass}"
        );
    }

    #[test]
    fn doubles_agree_with_the_exact_block_to_eight_units_in_the_last_place() {
        for mesh in MeshKind::ALL {
            for plane in Plane::ALL {
                for mass in [MassKind::Consistent, MassKind::Lumped] {
                    assert_agreement(&BlockModel {
                        mesh,
                        plane,
                        mass,
                        cell: (rational(10, 7), rational(4, 3)),
                        cells: (5, 3),
                        ..BlockModel::of_the_paper()
                    });
                }
            }
        }
    }

    #[test]
    fn another_block_differs_and_overflow_is_named() {
        let model = BlockModel::of_the_paper().with_cells(4, 2);
        let other = BlockModel {
            plane: Plane::Strain,
            ..model.clone()
        };
        let exact_other = Block::new(&other).unwrap();
        let doubles = DoubleBlock::new(&model).unwrap();
        assert!(largest_difference(&exact_other.stiffness, &doubles.stiffness) > 1e9);

        let overflowing = BlockModel {
            material: Material {
                young: parse("1e400").unwrap(),
                ..Material::polyurethane()
            },
            ..model
        };
        assert!(matches!(
            DoubleBlock::new(&overflowing),
            Err(SourceError::NotFinite { what: "K", .. })
        ));
    }
}
