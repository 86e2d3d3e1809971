//! Uniform triangulations of a rectangle: cells cut by both diagonals or by one.

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

/// Node positions in half cells, triangles, and the numbering of the nodes below the glued top.
pub(super) struct Mesh {
    /// Position of each point in half cells.
    pub(super) points: Vec<(u32, u32)>,
    /// Vertices counter-clockwise.
    pub(super) triangles: Vec<[usize; 3]>,
    /// Number of each point, `None` on the glued side.
    pub(super) number: Vec<Option<usize>>,
    /// Numbers of the nodes of the contact side, left to right.
    pub(super) contact: Vec<usize>,
}

impl Mesh {
    /// Nodes are numbered along the shorter side first: the half-bandwidth stays near twice the
    /// nodes of one such line, which the exact condensation profits from.
    pub(super) fn new(nx: usize, ny: usize, kind: MeshKind) -> Result<Mesh, SourceError> {
        if nx == 0 || ny == 0 {
            return Err(SourceError::NoCells { nx, ny });
        }
        if nx.checked_mul(ny).is_none_or(|cells| cells > MAX_CELLS) {
            return Err(SourceError::TooManyCells {
                nx,
                ny,
                limit: MAX_CELLS,
            });
        }
        let (width, height) = (nx as u32, ny as u32); // at most MAX_CELLS
        let columns_first = nx >= ny;
        let mut points: Vec<(u32, u32)> = (0..=width)
            .flat_map(|i| (0..=height).map(move |j| (2 * i, 2 * j)))
            .collect();
        if kind == MeshKind::Crossed {
            points
                .extend((0..width).flat_map(|i| (0..height).map(move |j| (2 * i + 1, 2 * j + 1))));
        }
        points.sort_unstable_by_key(|&(x, y)| if columns_first { (x, y) } else { (y, x) });
        let place: BTreeMap<(u32, u32), usize> =
            points.iter().enumerate().map(|(k, &p)| (p, k)).collect();
        let mut triangles = Vec::new();
        for i in 0..width {
            for j in 0..height {
                let at = |x: u32, y: u32| place[&(2 * i + x, 2 * j + y)];
                let corner = [at(0, 0), at(2, 0), at(2, 2), at(0, 2)];
                let center = (kind == MeshKind::Crossed).then(|| at(1, 1));
                triangles.extend(cut(corner, center, kind, (i + j) % 2 == 0));
            }
        }
        let mut next = 0;
        let mut count = |free: bool| {
            next += usize::from(free);
            free.then(|| next - 1)
        };
        let number: Vec<Option<usize>> = points.iter().map(|p| count(p.1 != 2 * height)).collect();
        let contact = (0..=width)
            .filter_map(|i| number[place[&(2 * i, 0)]])
            .collect();
        Ok(Mesh {
            points,
            triangles,
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
        self.number[triangle[i / 2]].map(|n| 2 * n + i % 2)
    }

    /// The two edges from a triangle's first vertex, in half cells: triangles with the same edges
    /// are translates of each other and share their element matrices.
    pub(super) fn shape(&self, triangle: &[usize; 3]) -> Shape {
        let p = triangle.map(|v| (i64::from(self.points[v].0), i64::from(self.points[v].1)));
        [
            (p[1].0 - p[0].0, p[1].1 - p[0].1),
            (p[2].0 - p[0].0, p[2].1 - p[0].1),
        ]
    }
}

/// Edges from the first vertex of a triangle, in half cells.
pub(super) type Shape = [(i64, i64); 2];

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

    /// The triangles cover the rectangle once: areas (in quarter cells, doubled) add up, each is
    /// counter-clockwise, and every inner edge belongs to two triangles.
    #[test]
    fn triangles_cover_the_rectangle() {
        for kind in MeshKind::ALL {
            let mesh = Mesh::new(3, 2, kind).unwrap();
            let per_cell = if kind == MeshKind::Crossed { 4 } else { 2 };
            assert_eq!(mesh.triangles.len(), 6 * per_cell);
            let area = |t: &[usize; 3]| {
                let [p, q] = mesh.shape(t);
                p.0 * q.1 - p.1 * q.0
            };
            assert!(mesh.triangles.iter().all(|t| area(t) > 0));
            assert_eq!(mesh.triangles.iter().map(area).sum::<i64>(), 2 * 6 * 4);
            let mut edges: BTreeMap<(usize, usize), usize> = BTreeMap::new();
            for t in &mesh.triangles {
                for k in 0..3 {
                    let (a, b) = (t[k], t[(k + 1) % 3]);
                    *edges.entry((a.min(b), a.max(b))).or_default() += 1;
                }
            }
            assert!(edges.values().all(|&n| n <= 2));
            assert_eq!(
                edges.values().filter(|&&n| n == 1).count(),
                2 * (3 + 2),
                "edges of the boundary"
            );
        }
    }

    #[test]
    fn diagonals_point_as_named() {
        let has = |kind, cell: (u32, u32), slash: bool| {
            let mesh = Mesh::new(2, 2, kind).unwrap();
            let ends = if slash {
                [(0, 0), (2, 2)]
            } else {
                [(2, 0), (0, 2)]
            };
            let ends = ends.map(|(x, y)| (2 * cell.0 + x, 2 * cell.1 + y));
            mesh.triangles
                .iter()
                .filter(|t| ends.iter().all(|e| t.iter().any(|&v| mesh.points[v] == *e)))
                .count()
                == 2
        };
        assert!(has(MeshKind::Slash, (1, 0), true) && !has(MeshKind::Slash, (1, 0), false));
        assert!(has(MeshKind::Backslash, (1, 0), false) && !has(MeshKind::Backslash, (1, 0), true));
        assert!(
            has(MeshKind::UnionJack, (0, 0), true)
                && has(MeshKind::UnionJack, (1, 0), false)
                && has(MeshKind::UnionJack, (1, 1), true)
        );
    }

    #[test]
    fn the_shorter_side_is_numbered_first() {
        let band = |nx, ny| {
            let mesh = Mesh::new(nx, ny, MeshKind::Crossed).unwrap();
            let ends = |t: &[usize; 3]| t.iter().filter_map(|&v| mesh.number[v]).minmax();
            mesh.triangles.iter().map(ends).max().unwrap()
        };
        trait Spread {
            fn minmax(self) -> usize;
        }
        impl<I: Iterator<Item = usize>> Spread for I {
            fn minmax(self) -> usize {
                let all: Vec<usize> = self.collect();
                all.iter().max().unwrap_or(&0) - all.iter().min().unwrap_or(&0)
            }
        }
        assert!(
            band(12, 2) <= 6 && band(2, 12) <= 6,
            "{} {}",
            band(12, 2),
            band(2, 12)
        );
        assert!(matches!(
            Mesh::new(0, 3, MeshKind::Slash),
            Err(SourceError::NoCells { nx: 0, ny: 3 })
        ));
        assert!(matches!(
            Mesh::new(usize::MAX, 2, MeshKind::Slash),
            Err(SourceError::TooManyCells { .. })
        ));
        assert!(matches!(
            Mesh::new(MAX_CELLS, 2, MeshKind::Slash),
            Err(SourceError::TooManyCells { .. })
        ));
    }
}
