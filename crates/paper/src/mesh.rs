//! Uniform triangulations of a rectangle: cells cut by both diagonals or by one.
//!
//! All positions are integers, in half cells, so the mesh knows no lengths: `block`, `doubles` and
//! `triangulation` multiply by the size of a cell. The top is glued: its points get no number and
//! no degrees of freedom.

use super::error::SourceError;
use std::collections::BTreeMap;

/// Largest number of cells of a mesh: a typing error should not cost all memory.
pub const MAX_CELLS: usize = 4_000_000;

/// How each cell of the rectangle is cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshKind {
    /// Both diagonals: four triangles about the cell's centre (the paper's 800 elements).
    Crossed,
    /// Diagonals `/` and `\` by turns, like a chessboard, `/` in the lower left cell.
    UnionJack,
    /// The diagonal `/` in every cell.
    Slash,
    /// The diagonal `\` in every cell.
    Backslash,
}

impl MeshKind {
    /// Every kind.
    pub const ALL: [MeshKind; 4] = [
        MeshKind::Crossed,
        MeshKind::UnionJack,
        MeshKind::Slash,
        MeshKind::Backslash,
    ];

    /// The word used on the command line and in reports.
    pub fn word(self) -> &'static str {
        match self {
            MeshKind::Crossed => "crossed",
            MeshKind::UnionJack => "union-jack",
            MeshKind::Slash => "slash",
            MeshKind::Backslash => "backslash",
        }
    }
}

/// A point of the mesh, (x, y) in half cells from the lower left corner.
pub(super) type GridPoint = (u32, u32);

/// Node positions in half cells, triangles, and the numbering of the nodes below the glued top.
pub(super) struct Mesh {
    /// Position of each point in half cells.
    pub(super) points: Vec<GridPoint>,
    /// Vertices counter-clockwise.
    pub(super) triangles: Vec<[usize; 3]>,
    /// Number of each point, `None` on the glued side.
    pub(super) number: Vec<Option<usize>>,
    /// Numbers of the nodes of the contact side, left to right.
    pub(super) contact: Vec<usize>,
}

impl Mesh {
    /// Cuts `nx` times `ny` cells. Nodes are numbered along the shorter side first: the
    /// half-bandwidth stays near twice the nodes of one such line, which the exact condensation
    /// profits from.
    pub(super) fn new(nx: usize, ny: usize, kind: MeshKind) -> Result<Mesh, SourceError> {
        if nx == 0 || ny == 0 {
            return Err(SourceError::NoCells { nx, ny });
        }

        let cells = nx.checked_mul(ny);
        if cells.is_none_or(|cells| cells > MAX_CELLS) {
            return Err(SourceError::TooManyCells {
                nx,
                ny,
                limit: MAX_CELLS,
            });
        }

        // Both are at most MAX_CELLS.
        let grid = Grid {
            width: nx as u32,
            height: ny as u32,
            kind,
        };
        let points = grid.points();
        let place: BTreeMap<GridPoint, usize> = points
            .iter()
            .enumerate()
            .map(|(k, &point)| (point, k))
            .collect();

        let number = grid.number(&points);
        let mut contact = Vec::with_capacity(nx + 1);
        for i in 0..=grid.width {
            let point = place[&(2 * i, 0)];
            if let Some(node) = number[point] {
                contact.push(node);
            }
        }

        Ok(Mesh {
            triangles: grid.triangles(&place),
            points,
            number,
            contact,
        })
    }

    /// Number of nodes below the glued side.
    pub(super) fn free_nodes(&self) -> usize {
        self.number.iter().flatten().count()
    }

    /// Degree of freedom `i` (x, y of each vertex in turn) of a triangle, `None` if glued.
    pub(super) fn dof(&self, triangle: &[usize; 3], i: usize) -> Option<usize> {
        let vertex = triangle[i / 2];
        let node = self.number[vertex]?;
        Some(2 * node + i % 2)
    }

    /// The two edges from a triangle's first vertex, in half cells: triangles with the same edges
    /// are translates of each other and share their element matrices.
    pub(super) fn shape(&self, triangle: &[usize; 3]) -> Shape {
        let [origin, first, second] = triangle.map(|vertex| self.points[vertex]);
        [edge(origin, first), edge(origin, second)]
    }
}

/// Edges from the first vertex of a triangle, in half cells.
pub(super) type Shape = [(i64, i64); 2];

fn edge(from: GridPoint, to: GridPoint) -> (i64, i64) {
    (
        i64::from(to.0) - i64::from(from.0),
        i64::from(to.1) - i64::from(from.1),
    )
}

/// The cells of a rectangle.
struct Grid {
    /// Cells along the contact side.
    width: u32,
    /// Cells across it.
    height: u32,
    kind: MeshKind,
}

impl Grid {
    /// Corners of cells, and centres where both diagonals are drawn, line by line along the shorter
    /// side.
    fn points(&self) -> Vec<GridPoint> {
        let mut points = Vec::new();
        for i in 0..=self.width {
            for j in 0..=self.height {
                points.push((2 * i, 2 * j));
            }
        }

        if self.kind == MeshKind::Crossed {
            for i in 0..self.width {
                for j in 0..self.height {
                    points.push((2 * i + 1, 2 * j + 1));
                }
            }
        }

        let columns_first = self.width >= self.height;
        points.sort_unstable_by_key(|&(x, y)| if columns_first { (x, y) } else { (y, x) });
        points
    }

    /// The triangles of all cells; `place` finds a point in the list.
    fn triangles(&self, place: &BTreeMap<GridPoint, usize>) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        for i in 0..self.width {
            for j in 0..self.height {
                let left = 2 * i;
                let bottom = 2 * j;
                let corner = [
                    place[&(left, bottom)],
                    place[&(left + 2, bottom)],
                    place[&(left + 2, bottom + 2)],
                    place[&(left, bottom + 2)],
                ];
                let center = place.get(&(left + 1, bottom + 1)).copied();
                let even = (i + j).is_multiple_of(2);
                triangles.extend(cut(corner, center, self.kind, even));
            }
        }

        triangles
    }

    /// Numbers the points below the top, in order.
    fn number(&self, points: &[GridPoint]) -> Vec<Option<usize>> {
        let mut next = 0;
        let mut number = Vec::with_capacity(points.len());
        for point in points {
            let glued = point.1 == 2 * self.height;
            if glued {
                number.push(None);
            } else {
                number.push(Some(next));
                next += 1;
            }
        }

        number
    }
}

/// The triangles of one cell; `corner` counter-clockwise from the lower left.
fn cut(corner: [usize; 4], center: Option<usize>, kind: MeshKind, even: bool) -> Vec<[usize; 3]> {
    let [a, b, c, d] = corner;
    match (kind, center) {
        (MeshKind::Crossed, Some(m)) => vec![[a, b, m], [b, c, m], [c, d, m], [d, a, m]],
        (MeshKind::Slash, _) => vec![[a, b, c], [a, c, d]],
        (MeshKind::UnionJack, _) if even => vec![[a, b, c], [a, c, d]],
        _ => vec![[a, b, d], [b, c, d]],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area in quarter cells; positive for counter-clockwise vertices.
    fn twice_area(mesh: &Mesh, triangle: &[usize; 3]) -> i64 {
        let [first, second] = mesh.shape(triangle);
        first.0 * second.1 - first.1 * second.0
    }

    /// The triangles cover the rectangle once: areas (in quarter cells, doubled) add up, each is
    /// counter-clockwise, and every inner edge belongs to two triangles.
    #[test]
    fn triangles_cover_the_rectangle() {
        for kind in MeshKind::ALL {
            let mesh = Mesh::new(3, 2, kind).unwrap();
            let per_cell = if kind == MeshKind::Crossed { 4 } else { 2 };
            assert_eq!(mesh.triangles.len(), 6 * per_cell);

            let mut total = 0;
            for triangle in &mesh.triangles {
                let area = twice_area(&mesh, triangle);
                assert!(area > 0);
                total += area;
            }
            assert_eq!(total, 2 * 6 * 4);

            let mut edges: BTreeMap<(usize, usize), usize> = BTreeMap::new();
            for triangle in &mesh.triangles {
                for k in 0..3 {
                    let from = triangle[k];
                    let to = triangle[(k + 1) % 3];
                    let edge = (from.min(to), from.max(to));
                    *edges.entry(edge).or_default() += 1;
                }
            }
            assert!(edges.values().all(|&uses| uses <= 2));
            let boundary = edges.values().filter(|&&uses| uses == 1).count();
            assert_eq!(boundary, 2 * (3 + 2), "edges of the boundary");
        }
    }

    const SLASH: [GridPoint; 2] = [(0, 0), (2, 2)];
    const BACKSLASH: [GridPoint; 2] = [(2, 0), (0, 2)];

    /// Is this diagonal of the cell an edge of two triangles, on a mesh of 2 x 2 cells?
    fn has_diagonal(kind: MeshKind, cell: GridPoint, diagonal: [GridPoint; 2]) -> bool {
        let mesh = Mesh::new(2, 2, kind).unwrap();
        let ends = diagonal.map(|(x, y)| (2 * cell.0 + x, 2 * cell.1 + y));

        let mut beside = 0;
        for triangle in &mesh.triangles {
            let vertices = triangle.map(|vertex| mesh.points[vertex]);
            if ends.iter().all(|end| vertices.contains(end)) {
                beside += 1;
            }
        }
        beside == 2
    }

    #[test]
    fn diagonals_point_as_named() {
        assert!(has_diagonal(MeshKind::Slash, (1, 0), SLASH));
        assert!(!has_diagonal(MeshKind::Slash, (1, 0), BACKSLASH));

        assert!(has_diagonal(MeshKind::Backslash, (1, 0), BACKSLASH));
        assert!(!has_diagonal(MeshKind::Backslash, (1, 0), SLASH));

        assert!(has_diagonal(MeshKind::UnionJack, (0, 0), SLASH));
        assert!(has_diagonal(MeshKind::UnionJack, (1, 0), BACKSLASH));
        assert!(has_diagonal(MeshKind::UnionJack, (1, 1), SLASH));
    }

    /// The largest difference of two node numbers in one triangle.
    fn largest_spread(nx: usize, ny: usize) -> usize {
        let mesh = Mesh::new(nx, ny, MeshKind::Crossed).unwrap();
        let mut largest = 0;
        for triangle in &mesh.triangles {
            let numbers: Vec<usize> = triangle.iter().filter_map(|&v| mesh.number[v]).collect();
            let last = numbers.iter().max().unwrap_or(&0);
            let first = numbers.iter().min().unwrap_or(&0);
            largest = largest.max(last - first);
        }
        largest
    }

    #[test]
    fn the_shorter_side_is_numbered_first() {
        let lying = largest_spread(12, 2);
        let standing = largest_spread(2, 12);
        assert!(lying <= 6 && standing <= 6, "{lying} {standing}");

        assert!(matches!(
            Mesh::new(0, 3, MeshKind::Slash),
            Err(SourceError::NoCells { nx: 0, ny: 3 })
        ));
        for nx in [usize::MAX, MAX_CELLS] {
            assert!(matches!(
                Mesh::new(nx, 2, MeshKind::Slash),
                Err(SourceError::TooManyCells { .. })
            ));
        }
    }
}
