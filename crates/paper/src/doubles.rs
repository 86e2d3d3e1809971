//! The same block in doubles, for meshes too large for exact matrices: written out anew, so that
//! the two assemblies check each other.
#![allow(clippy::float_arithmetic)]

use super::block_model::BlockModel;
use super::element::MassKind;
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

/// Stiffness of the six dofs and mass of the three vertices of one shape of triangle.
type ElementMatrices = ([[f64; 6]; 6], [[f64; 3]; 3]);

impl DoubleBlock {
    /// Meshes and assembles a block. Each entry is within 8 units in the last place of the largest
    /// entry of its row's diagonal from the exact one (`source::doubles` tests it).
    ///
    /// # Errors
    /// [`SourceError`] as [`super::Block::new`]; also for numbers too large for doubles.
    pub fn new(model: &BlockModel) -> Result<DoubleBlock, SourceError> {
        model.validate()?;
        let (nx, ny) = model.cells;
        let mesh = Mesh::new(nx, ny, model.mesh)?;
        let half = (to_f64(&model.cell.0) / 2.0, to_f64(&model.cell.1) / 2.0);
        let mut shapes: BTreeMap<Shape, ElementMatrices> = BTreeMap::new();
        let (mut k, mut m) = (Vec::new(), Vec::new());
        for triangle in &mesh.triangles {
            let shape = mesh.shape(triangle);
            let (ke, me) = shapes.entry(shape).or_insert_with(|| {
                let edges = shape.map(|(x, y)| (half.0 * x as f64, half.1 * y as f64));
                (stiffness(edges, model), mass(edges, model))
            });
            for i in 0..6 {
                for j in 0..6 {
                    let (Some(di), Some(dj)) = (mesh.dof(triangle, i), mesh.dof(triangle, j))
                    else {
                        continue;
                    };
                    k.push((di, dj, ke[i][j]));
                    if i % 2 == j % 2 && me[i / 2][j / 2] != 0.0 {
                        m.push((di, dj, me[i / 2][j / 2]));
                    }
                }
            }
        }
        let order = 2 * mesh.free_nodes();
        let (stiffness, mass) = (merge("K", order, k)?, merge("M", order, m)?);
        let kept = mesh
            .points
            .iter()
            .zip(&mesh.number)
            .filter(|(_, n)| n.is_some());
        let points = kept
            .flat_map(|(p, _)| [[half.0 * f64::from(p.0), half.1 * f64::from(p.1)]; 2])
            .collect();
        Ok(DoubleBlock {
            stiffness,
            mass,
            contact: mesh.contact,
            points,
        })
    }

    /// The contact nodes with these states, left to right, as in [`super::Block::system`]; nodes
    /// beyond the states given are free.
    pub fn particles(&self, states: &[ContactState]) -> Vec<Particle> {
        let state = |k: usize| states.get(k).copied().unwrap_or(ContactState::Free);
        let particle = |(k, &n): (usize, &usize)| Particle {
            normal_direction: -1,
            ..Particle::plain(2 * n, 2 * n + 1, state(k))
        };
        self.contact.iter().enumerate().map(particle).collect()
    }
}

/// t A B'DB of the triangle (0, 0), `edges`.
fn stiffness(edges: [(f64, f64); 2], model: &BlockModel) -> [[f64; 6]; 6] {
    let [(x1, y1), (x2, y2)] = edges;
    let twice_area = x1 * y2 - x2 * y1;
    let d = model.material.elasticity(model.plane).map(|v| to_f64(&v));
    let scale = to_f64(&model.material.thickness) / (2.0 * twice_area);
    let (b, c) = ([y1 - y2, y2, -y1], [x2 - x1, -x2, x1]); // 2A grad of the shape functions
    let strain = |i: usize| {
        if i.is_multiple_of(2) {
            [b[i / 2], 0.0, c[i / 2]]
        } else {
            [0.0, c[i / 2], b[i / 2]]
        }
    };
    let mut ke = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            let (e, g) = (strain(i), strain(j));
            let stress = [
                d[0] * g[0] + d[1] * g[1],
                d[1] * g[0] + d[0] * g[1],
                d[2] * g[2],
            ];
            ke[i][j] = scale * (e[0] * stress[0] + e[1] * stress[1] + e[2] * stress[2]);
        }
    }
    ke
}

/// rho t A / 12 (1 + delta_ab), or rho t A / 3 on the diagonal.
fn mass(edges: [(f64, f64); 2], model: &BlockModel) -> [[f64; 3]; 3] {
    let [(x1, y1), (x2, y2)] = edges;
    let total =
        to_f64(&(&model.material.density * &model.material.thickness)) * (x1 * y2 - x2 * y1) / 2.0;
    let (diagonal, other) = match model.mass {
        MassKind::Consistent => (total / 6.0, total / 12.0),
        MassKind::Lumped => (total / 3.0, 0.0),
    };
    std::array::from_fn(|a| std::array::from_fn(|b| if a == b { diagonal } else { other }))
}

/// Sums entries of one place, in the order of the elements.
fn merge(
    what: &'static str,
    order: usize,
    list: Vec<(usize, usize, f64)>,
) -> Result<DoubleMatrix, SourceError> {
    // Counted into rows first: rows are short, the list is not.
    let mut next = vec![0; order + 1];
    list.iter().for_each(|e| next[e.0 + 1] += 1);
    (0..order).for_each(|i| next[i + 1] += next[i]);
    let start = next.clone();
    let mut rows = vec![(0, 0.0); list.len()];
    for (i, j, v) in list {
        rows[next[i]] = (j, v);
        next[i] += 1;
    }
    let mut entries: Vec<(usize, usize, f64)> = Vec::with_capacity(rows.len() / 2);
    for i in 0..order {
        let row = &mut rows[start[i]..start[i + 1]];
        row.sort_by_key(|e| e.0); // stable
        for &(j, v) in &*row {
            match entries.last_mut() {
                Some(last) if (last.0, last.1) == (i, j) => last.2 += v,
                _ => entries.push((i, j, v)),
            }
        }
    }
    match entries.iter().find(|e| !e.2.is_finite()) {
        Some(e) => Err(SourceError::NotFinite {
            what,
            got: e.2.to_string(),
        }),
        None => Ok(DoubleMatrix { order, entries }),
    }
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
        let diagonal: Vec<f64> = (0..doubles.order)
            .map(|i| to_f64(&exact.get(i, i)))
            .collect();
        let place = |e: &(usize, usize, f64)| (e.0, e.1);
        for (i, j, _) in exact.entries() {
            assert!(
                doubles.entries.binary_search_by_key(&(i, j), place).is_ok(),
                "({i}, {j}) is missing"
            );
        }
        let error = |e: &(usize, usize, f64)| {
            (to_f64(&exact.get(e.0, e.1)) - e.2).abs()
                / (f64::EPSILON * diagonal[e.0].max(diagonal[e.1]))
        };
        doubles.entries.iter().map(error).fold(0.0, f64::max)
    }

    #[test]
    fn doubles_agree_with_the_exact_block_to_eight_units_in_the_last_place() {
        for (mesh, plane) in MeshKind::ALL
            .into_iter()
            .flat_map(|m| Plane::ALL.map(|p| (m, p)))
        {
            for mass in [MassKind::Consistent, MassKind::Lumped] {
                let cell = (rational(10, 7), rational(4, 3));
                let model = BlockModel {
                    mesh,
                    plane,
                    mass,
                    cell,
                    cells: (5, 3),
                    ..BlockModel::of_the_paper()
                };
                let (exact, doubles) = (
                    Block::new(&model).unwrap(),
                    DoubleBlock::new(&model).unwrap(),
                );
                assert_eq!(exact.contact, doubles.contact);
                let near = |(k, p): (usize, &[f64; 2])| {
                    let (x, y) = &exact.nodes[k / 2];
                    (p[0] - to_f64(x)).abs() + (p[1] - to_f64(y)).abs() < 1e-13
                };
                assert!(
                    doubles.points.len() == doubles.stiffness.order
                        && doubles.points.iter().enumerate().all(near)
                );
                let errors = [
                    largest_difference(&exact.stiffness, &doubles.stiffness),
                    largest_difference(&exact.mass, &doubles.mass),
                ];
                assert!(
                    errors.iter().all(|&e| e <= 8.0),
                    "{mesh:?} {plane:?} {mass:?}: {errors:?}"
                );
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
        let exact = Block::new(&other).unwrap();
        assert!(
            largest_difference(
                &exact.stiffness,
                &DoubleBlock::new(&model).unwrap().stiffness
            ) > 1e9
        );
        let heavy = BlockModel {
            material: Material {
                young: parse("1e400").unwrap(),
                ..Material::polyurethane()
            },
            ..model
        };
        assert!(matches!(
            DoubleBlock::new(&heavy),
            Err(SourceError::NotFinite { what: "K", .. })
        ));
    }
}
