//! The deformed mesh of a mode with the state of each contact node, as in Figs. 2 and 3 of the
//! paper.
//!
//! Each point p of the mesh is drawn at p + c v(p). The factor c makes the mode visible and keeps
//! neighbours on the contact side apart; a mode has no size of its own.

use super::chart::{line, text};
use super::drawing::Picture;
use super::legend::legend;
use super::marker::Mark;
use super::markup::{Element, point_list, segment, short};
use mceip_exact::to_f64;
use mceip_paper::Triangulation;
use std::collections::BTreeSet;

/// What is drawn: a mesh, how it moves, and the marks of its contact nodes.
#[derive(Debug, Clone, Copy)]
pub struct Mode<'a> {
    /// The mesh.
    pub mesh: &'a Triangulation,
    /// v: two components (x to the right, y up) for each node; only its direction matters.
    pub displacement: &'a [f64],
    /// One mark for each contact node, left to right.
    pub marks: &'a [Mark],
}

/// Largest displacement drawn, as a part of the height of the block.
const AMPLITUDE: f64 = 0.12;

/// How much closer neighbours on the contact side may be drawn, as a part of their distance.
const APPROACH: f64 = 0.5;

/// Size of the block on paper, px, at most.
const FITS: (f64, f64) = (680.0, 460.0);

/// Left end of the block on paper, px.
const LEFT: f64 = 50.0;

/// Upper side of the block on paper, px.
const TOP: f64 = 40.0;

/// Contact nodes up to which each of them is numbered.
const NUMBERED: usize = 41;

/// Where the block lies on paper: length and height in mm, px for a mm.
struct Placement {
    length: f64,
    height: f64,
    unit: f64,
}

impl Placement {
    /// Of a block whose lower left corner is (0, 0).
    fn of(points: &[(f64, f64)]) -> Placement {
        let mut length: f64 = 0.0;
        let mut height: f64 = 0.0;
        for (x, y) in points {
            length = length.max(*x);
            height = height.max(*y);
        }

        let unit = (FITS.0 / length).min(FITS.1 / height);
        Placement {
            length,
            height,
            unit,
        }
    }

    /// From mm in the block to px on paper.
    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (LEFT + x * self.unit, self.bottom() - y * self.unit)
    }

    /// The contact side on paper.
    fn bottom(&self) -> f64 {
        TOP + self.height * self.unit
    }

    /// The outline of the block at rest.
    fn outline(&self) -> Element {
        let corners = [
            (0.0, 0.0),
            (self.length, 0.0),
            (self.length, self.height),
            (0.0, self.height),
        ];
        let places = corners.map(|corner| self.place(corner));

        Element::new("polygon")
            .with("class", "undeformed")
            .with("points", point_list(&places))
            .with("fill", "none")
            .with("stroke", "#777")
            .with("stroke-dasharray", "5 4")
    }

    /// The upper side, which is glued to the rigid plate.
    fn glued_side(&self) -> Element {
        let left = self.place((0.0, self.height));
        let right = self.place((self.length, self.height));
        line(left, right, "#000", 3.0).with("class", "glued")
    }
}

/// Draws a mode. Displacements that are missing or not finite count as zero.
pub fn mode_picture(title: &str, mode: &Mode<'_>) -> Picture {
    let mut points = Vec::new();
    for (x, y) in &mode.mesh.points {
        points.push((to_f64(x), to_f64(y)));
    }

    let placement = Placement::of(&points);
    let largest = AMPLITUDE * placement.height;
    let moved = mode.moved(&points, largest);

    let width = placement.length * placement.unit + 2.0 * LEFT;
    let margin = largest * placement.unit;
    let bottom = placement.bottom();
    let mut picture = Picture::new(title, width.max(560.0), bottom + margin + 62.0);

    picture.push_heading(LEFT, 24.0);
    picture.push(placement.outline());
    let right = LEFT + placement.length * placement.unit;
    picture.push(obstacle(LEFT - 20.0, right + 20.0, bottom));
    picture.push(mode.edges(&moved, &placement));
    picture.push(placement.glued_side());
    picture.push(mode.marks(&moved, &placement));

    if mode.mesh.contact.len() <= NUMBERED {
        for (k, &point) in mode.mesh.contact.iter().enumerate() {
            let (x, _) = placement.place(points[point]);
            let number = (k + 1).to_string();
            let label = text(x, bottom + margin + 14.0, "middle", number);
            picture.push(label.with("font-size", "10"));
        }
    }

    picture.push(legend(mode.marks, LEFT, bottom + margin + 44.0));
    picture
}

impl Mode<'_> {
    /// Where each point goes: no displacement is larger than `largest` (mm), and contact nodes do
    /// not run into each other.
    fn moved(&self, points: &[(f64, f64)], largest: f64) -> Vec<(f64, f64)> {
        let factor = self.factor(points, largest);
        let mut moved = Vec::new();
        for (point, (x, y)) in points.iter().enumerate() {
            let (v_x, v_y) = self.displacement_of(point);
            moved.push((x + factor * v_x, y + factor * v_y));
        }

        moved
    }

    /// The factor c by which v is multiplied, 0 for a mode without displacement.
    fn factor(&self, points: &[(f64, f64)], largest: f64) -> f64 {
        let mut size: f64 = 0.0;
        for point in 0..points.len() {
            let (v_x, v_y) = self.displacement_of(point);
            size = size.max(v_x.hypot(v_y));
        }

        if size <= 0.0 {
            return 0.0;
        }

        let mut factor = largest / size;
        for pair in self.mesh.contact.windows(2) {
            let distance = points[pair[1]].0 - points[pair[0]].0;
            let approach = self.displacement_of(pair[0]).0 - self.displacement_of(pair[1]).0;
            if approach > 0.0 {
                factor = factor.min(APPROACH * distance / approach);
            }
        }

        factor
    }

    /// v at a point of the mesh; 0 on the glued side.
    fn displacement_of(&self, point: usize) -> (f64, f64) {
        match self.mesh.nodes[point] {
            Some(node) => (self.component(2 * node), self.component(2 * node + 1)),
            None => (0.0, 0.0),
        }
    }

    fn component(&self, dof: usize) -> f64 {
        let given = self.displacement.get(dof).copied();
        given.filter(|v| v.is_finite()).unwrap_or(0.0)
    }

    /// Every edge of the deformed mesh once.
    fn edges(&self, moved: &[(f64, f64)], placement: &Placement) -> Element {
        let mut edges: BTreeSet<(usize, usize)> = BTreeSet::new();
        for [a, b, c] in &self.mesh.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                edges.insert((*p.min(q), *p.max(q)));
            }
        }

        let mut d = String::new();
        for (a, b) in edges {
            d += &segment(placement.place(moved[a]), placement.place(moved[b]));
        }

        Element::new("path")
            .with("class", "deformed")
            .with("d", d)
            .with("fill", "none")
            .with("stroke", "#444")
            .with("stroke-width", "0.6")
    }

    /// The marks of the contact nodes, where these go.
    fn marks(&self, moved: &[(f64, f64)], placement: &Placement) -> Element {
        let nodes = self.mesh.contact.len().max(2) as f64;
        let spacing = placement.length * placement.unit / nodes;
        let radius = (0.26 * spacing).min(8.0);

        let mut marks = Element::new("g").with("class", "marks");
        for (&point, mark) in self.mesh.contact.iter().zip(self.marks) {
            let (x, y) = placement.place(moved[point]);
            marks.push(mark.draw(x, y, radius));
        }

        marks
    }
}

/// The obstacle's surface, hatched below.
fn obstacle(left: f64, right: f64, y: f64) -> Element {
    let mut hatches = String::new();
    let mut x = left;
    while x + 6.0 <= right {
        hatches += &format!("M{} {}l-5 7", short(x + 6.0), short(y));
        x += 12.0;
    }

    let hatching = Element::new("path")
        .with("d", hatches)
        .with("stroke", "#888")
        .with("stroke-width", "0.8");

    Element::new("g")
        .with("class", "obstacle")
        .child(line((left, y), (right, y), "#000", 1.2))
        .child(hatching)
}
