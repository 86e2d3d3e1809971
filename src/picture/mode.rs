//! The deformed mesh of a mode with the state of each contact node, as in Figs. 2 and 3 of the
//! paper.

use super::chart::{line, text};
use super::drawing::Picture;
use super::legend::legend;
use super::marker::Mark;
use super::markup::{Element, short};
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

/// Draws a mode. Displacements that are missing or not finite count as zero.
pub fn mode_picture(title: &str, mode: &Mode<'_>) -> Picture {
    let points: Vec<(f64, f64)> = mode
        .mesh
        .points
        .iter()
        .map(|(x, y)| (to_f64(x), to_f64(y)))
        .collect();
    let (length, height) = points
        .iter()
        .fold((0.0f64, 0.0f64), |m, p| (m.0.max(p.0), m.1.max(p.1)));
    let unit = (FITS.0 / length).min(FITS.1 / height);
    let (left, top) = (50.0, 40.0);
    let margin = AMPLITUDE * height * unit;
    let (width, bottom) = (length * unit + 2.0 * left, top + height * unit);
    let place = |(x, y): (f64, f64)| (left + x * unit, bottom - y * unit);
    let moved = moved(mode, &points, AMPLITUDE * height);

    let mut picture = Picture::new(title, width.max(560.0), bottom + margin + 62.0);
    picture.push(text(left, 24.0, "start", title).with("font-weight", "bold"));
    let corners = [(0.0, 0.0), (length, 0.0), (length, height), (0.0, height)].map(place);
    let corners = corners
        .map(|(x, y)| format!("{},{}", short(x), short(y)))
        .join(" ");
    let undeformed = Element::new("polygon")
        .with("class", "undeformed")
        .with("points", corners)
        .with("fill", "none");
    picture.push(
        undeformed
            .with("stroke", "#777")
            .with("stroke-dasharray", "5 4"),
    );
    picture.push(obstacle(left - 20.0, left + length * unit + 20.0, bottom));
    picture.push(triangles(mode, &moved, &place));
    let top_line = line(place((0.0, height)), place((length, height)), "#000", 3.0);
    picture.push(top_line.with("class", "glued"));
    let spacing = length * unit / mode.mesh.contact.len().max(2) as f64;
    let mut marks = Element::new("g").with("class", "marks");
    for (&point, mark) in mode.mesh.contact.iter().zip(mode.marks) {
        let (x, y) = place(moved[point]);
        marks.push(mark.draw(x, y, (0.26 * spacing).min(8.0)));
    }
    picture.push(marks);
    let numbered = mode.mesh.contact.len() <= 41;
    for (k, &point) in mode.mesh.contact.iter().enumerate().filter(|_| numbered) {
        let node = text(
            place(points[point]).0,
            bottom + margin + 14.0,
            "middle",
            (k + 1).to_string(),
        );
        picture.push(node.with("font-size", "10"));
    }
    picture.push(legend(mode.marks, left, bottom + margin + 44.0));
    picture
}

/// Where each point goes: no displacement is larger than `largest` (mm), and contact nodes do not
/// run into each other.
fn moved(mode: &Mode<'_>, points: &[(f64, f64)], largest: f64) -> Vec<(f64, f64)> {
    let component = |i: usize| {
        mode.displacement
            .get(i)
            .copied()
            .filter(|v| v.is_finite())
            .unwrap_or(0.0)
    };
    let vector = |point: usize| {
        mode.mesh.nodes[point].map_or((0.0, 0.0), |n| (component(2 * n), component(2 * n + 1)))
    };
    let size = (0..points.len())
        .map(vector)
        .map(|(x, y)| x.hypot(y))
        .fold(0.0, f64::max);
    let closest = |pair: &[usize]| {
        let (distance, approach) = (
            points[pair[1]].0 - points[pair[0]].0,
            vector(pair[0]).0 - vector(pair[1]).0,
        );
        if approach > 0.0 {
            APPROACH * distance / approach
        } else {
            f64::INFINITY
        }
    };
    let factor = if size > 0.0 {
        mode.mesh
            .contact
            .windows(2)
            .map(closest)
            .fold(largest / size, f64::min)
    } else {
        0.0
    };
    let displaced =
        |(k, p): (usize, &(f64, f64))| (p.0 + factor * vector(k).0, p.1 + factor * vector(k).1);
    points.iter().enumerate().map(displaced).collect()
}

/// Every edge of the deformed mesh once.
fn triangles(
    mode: &Mode<'_>,
    moved: &[(f64, f64)],
    place: &dyn Fn((f64, f64)) -> (f64, f64),
) -> Element {
    let edge = |t: &[usize; 3], k: usize| (t[k].min(t[(k + 1) % 3]), t[k].max(t[(k + 1) % 3]));
    let edges: BTreeSet<(usize, usize)> = mode
        .mesh
        .triangles
        .iter()
        .flat_map(|t| (0..3).map(move |k| edge(t, k)))
        .collect();
    let mut d = String::new();
    for (a, b) in edges {
        let (a, b) = (place(moved[a]), place(moved[b]));
        d += &format!(
            "M{} {}L{} {}",
            short(a.0),
            short(a.1),
            short(b.0),
            short(b.1)
        );
    }
    let path = Element::new("path")
        .with("class", "deformed")
        .with("d", d)
        .with("fill", "none");
    path.with("stroke", "#444").with("stroke-width", "0.6")
}

/// The obstacle's surface, hatched below.
fn obstacle(left: f64, right: f64, y: f64) -> Element {
    let mut group =
        Element::new("g")
            .with("class", "obstacle")
            .child(line((left, y), (right, y), "#000", 1.2));
    let mut d = String::new();
    let mut x = left;
    while x + 6.0 <= right {
        d += &format!("M{} {}l-5 7", short(x + 6.0), short(y));
        x += 12.0;
    }
    group.push(
        Element::new("path")
            .with("d", d)
            .with("stroke", "#888")
            .with("stroke-width", "0.8"),
    );
    group
}
