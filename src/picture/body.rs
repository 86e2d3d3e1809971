//! A body at the places that its file gives: nodes and edges at rest, the obstacle and the state of
//! each particle, and a mode as the deformed mesh (Figs. 2 and 3 of the paper), with arrows where
//! the nodes are few.
//!
//! The obstacle of a particle is a line across its normal, with hatching on the side into which the
//! normal points: a wrong angle or normal direction is seen at once; a particle that is out of
//! contact has none. It stays where the body is at rest: a mode does not move the obstacle. Nodes
//! that are held are squares. A bar shows the unit of length, that of the coordinates. Names that
//! would cover each other are left out; long ones are cut so that no two are alike.
//!
//! A node moves by (v_i, v_j), i and j its degrees of freedom along x and y; it is drawn moved by
//! that times one factor for all nodes, which the picture states. A mode has no size of its own;
//! the factor makes it visible and keeps neighbours apart.

use super::chart::{line, text};
use super::drawing::Picture;
use super::legend::legend;
use super::marker::Mark;
use super::markup::{Element, point_list, segment};
use super::names::short_names;
use super::scale::label;
use mceip_exact::to_f64;
use mceip_model::{ContactState, Coordinates, Direction, Particle};

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct BodyDrawing<'a> {
    /// Where the nodes are.
    pub coordinates: &'a Coordinates,
    /// The particles of the system.
    pub particles: &'a [Particle],
    /// A mode; without one the states of the equilibrium are drawn.
    pub mode: Option<BodyMode<'a>>,
    /// What an equilibrium under load does to it; in files of VTK alone.
    pub load: Option<BodyUnderLoad<'a>>,
}

/// A body in an equilibrium under load.
#[derive(Debug, Clone, Copy)]
pub struct BodyUnderLoad<'a> {
    /// Over all degrees of freedom of the system.
    pub displacement: &'a [f64],
    /// (x, y) of each node, where its degrees of freedom are held; 0 elsewhere.
    pub prescribed: &'a [(f64, f64)],
    /// (r_T, r_N) of each particle.
    pub reactions: &'a [(f64, f64)],
}

/// A mode of a body.
#[derive(Debug, Clone, Copy)]
pub struct BodyMode<'a> {
    /// v over all degrees of freedom.
    pub v: &'a [f64],
    /// Indices of the particles that slip.
    pub slipping: &'a [usize],
}

/// Size of the body on paper, px, at most.
const FITS: (f64, f64) = (680.0, 400.0);

/// Room about the body, px: nothing that moves leaves the paper.
const MARGIN: f64 = 80.0;

/// The largest displacement, px, at most.
const LONGEST: f64 = 60.0;

/// The largest displacement of a mesh, as a part of the smaller side of the body.
const AMPLITUDE: f64 = 0.12;

/// How much closer the ends of an edge may be drawn, as a part of its length.
const APPROACH: f64 = 0.5;

/// Nodes up to which each is a dot, and its displacement an arrow.
const FEW: usize = 40;

/// Arrows that are shorter are left out, px.
const SHORTEST: f64 = 1.0;

/// Length of the head of an arrow, px, at most.
const HEAD: f64 = 7.0;

/// Radius of the markers of particles, px, at most and at least; between these a part of the
/// distance of neighbours.
const RADIUS: f64 = 7.0;
const SMALLEST: f64 = 2.0;
const OF_DISTANCE: f64 = 0.3;

/// Length of the line of an obstacle, px, and its distance from the middle of the marker.
const OBSTACLE: f64 = 26.0;
const GAP: f64 = RADIUS + 1.5;

/// Strokes of the hatching of an obstacle, and how far they reach into it, px.
const STROKES: usize = 4;
const DEPTH: f64 = 6.0;

/// Size of the letters of names, px, and the room that a letter takes of it.
const NAME_SIZE: f64 = 10.0;
const NAME_LETTER: f64 = 0.65;

/// Distance of a name from its particle, px.
const NAME_GAP: f64 = RADIUS + 8.0;

/// Length of the bar that shows the unit of length, px, at most.
const BAR: f64 = 120.0;

/// Letters of a name that are shown.
const LETTERS: usize = 10;

/// The body on paper: y up becomes y down.
struct Placement {
    /// Smallest x and largest y of the nodes.
    corner: (f64, f64),
    /// px for a unit of length.
    unit: f64,
    /// Width and height on paper, px.
    size: (f64, f64),
    /// x of the corner on paper, px.
    left: f64,
}

impl Placement {
    fn of(places: &[(f64, f64)]) -> Placement {
        let mut low = (f64::INFINITY, f64::INFINITY);
        let mut high = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for (x, y) in places {
            low = (low.0.min(*x), low.1.min(*y));
            high = (high.0.max(*x), high.1.max(*y));
        }

        let width = high.0 - low.0;
        let height = high.1 - low.1;
        let fitting = (FITS.0 / width).min(FITS.1 / height);
        // A single place has no size; neither have sizes at the end of the doubles.
        let unit = if fitting.is_normal() { fitting } else { 1.0 };
        let size = (width * unit, height * unit);

        Placement {
            corner: (low.0, high.1),
            unit,
            size,
            left: MARGIN + (FITS.0 - size.0) / 2.0,
        }
    }

    /// From a place of the body to px on paper.
    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let right = (x - self.corner.0) * self.unit;
        let down = (self.corner.1 - y) * self.unit;
        (self.left + right, MARGIN + down)
    }

    /// A bar of a round length, at the right, with its words at the height y. A file does not say
    /// in which unit its coordinates are.
    fn bar(&self, y: f64) -> Element {
        let length = round_below(BAR / self.unit);
        let right = FITS.0 + 1.5 * MARGIN;
        let left = right - length * self.unit;
        let words = format!("{} in the unit of the coordinates", label(length));
        let ends = [left, right].map(|x| line((x, y - 3.0), (x, y + 3.0), "#000", 1.2));
        Element::new("g")
            .with("class", "bar")
            .child(line((left, y), (right, y), "#000", 1.2))
            .children(ends)
            .child(text(left - 8.0, y + 4.5, "end", words))
    }

    /// Lower end of the body on paper, px.
    fn bottom(&self) -> f64 {
        MARGIN + self.size.1
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above a length.
fn round_below(length: f64) -> f64 {
    let power = 10f64.powf(length.log10().floor());
    let mut round = power;
    for digit in [2.0, 5.0] {
        if digit * power <= length {
            round = digit * power;
        }
    }

    round
}

/// Draws a body.
pub fn body_picture(title: &str, body: &BodyDrawing<'_>) -> Picture {
    let mut places = Vec::new();
    for node in body.coordinates.nodes() {
        let [x, y] = &node.place;
        places.push((to_f64(x), to_f64(y)));
    }

    let placement = Placement::of(&places);
    let mut on_paper = Vec::new();
    for place in places {
        on_paper.push(placement.place(place));
    }

    let below = placement.bottom() + MARGIN;
    let mut picture = Picture::new(title, FITS.0 + 2.0 * MARGIN, below + 66.0);
    picture.push_heading(MARGIN / 2.0, 28.0);
    let radius = body.radius(&on_paper);
    let Some(mode) = &body.mode else {
        picture.push(body.edges(&on_paper).with("class", "edges"));
        picture.push(body.nodes(&on_paper));
        picture.push(body.obstacles(&on_paper));
        picture.push(body.marks(&on_paper, radius));
        picture.push(body.names(&on_paper));
        picture.push(body.legend(MARGIN / 2.0, below + 8.0));
        picture.push(placement.bar(below + 50.0));
        return picture;
    };

    let largest = body.largest(mode);
    let factor = body.factor(mode, largest, &placement, &on_paper);
    let moved = body.moved(mode, factor, &on_paper);
    picture.push(at_rest(body.edges(&on_paper)));
    picture.push(body.nodes(&on_paper));
    picture.push(body.obstacles(&on_paper));
    picture.push(body.edges(&moved).with("class", "deformed"));
    if moved.len() <= FEW {
        picture.push(arrows(&on_paper, &moved));
    }
    picture.push(body.marks(&moved, radius));
    picture.push(body.names(&moved));
    picture.push(body.legend(MARGIN / 2.0, below + 8.0));
    picture.push(placement.bar(below + 50.0));

    let note = if largest > 0.0 {
        format!(
            "Drawn: the mode times {}, in the units of the coordinates; the largest |v| is {}.",
            label(factor / placement.unit),
            label(largest)
        )
    } else {
        "No node moves in this mode.".into()
    };
    picture.push(text(MARGIN / 2.0, below + 30.0, "start", note).with("class", "scale"));
    picture
}

impl BodyMode<'_> {
    /// v of a degree of freedom.
    fn component(&self, dof: Option<usize>) -> f64 {
        component(self.v, dof)
    }
}

/// What a vector has at a degree of freedom; 0 where there is none, or no finite number.
pub(super) fn component(vector: &[f64], dof: Option<usize>) -> f64 {
    let given = dof.and_then(|dof| vector.get(dof)).copied();
    given.filter(|v| v.is_finite()).unwrap_or(0.0)
}

impl BodyDrawing<'_> {
    /// v of a node along x and y; 0 where the node has no such degree of freedom.
    pub(super) fn displacement(&self, node: usize, mode: &BodyMode<'_>) -> (f64, f64) {
        let [along_x, along_y] = self.coordinates.nodes()[node].dofs;
        (mode.component(along_x), mode.component(along_y))
    }

    /// The largest |v| of a node.
    fn largest(&self, mode: &BodyMode<'_>) -> f64 {
        let mut largest: f64 = 0.0;
        for node in 0..self.coordinates.nodes().len() {
            let (x, y) = self.displacement(node, mode);
            largest = largest.max(x.hypot(y));
        }

        largest
    }

    /// px for a unit of v: the largest displacement is visible, and the ends of an edge do not run
    /// into each other.
    fn factor(
        &self,
        mode: &BodyMode<'_>,
        largest: f64,
        placement: &Placement,
        on_paper: &[(f64, f64)],
    ) -> f64 {
        if largest <= 0.0 {
            return 0.0;
        }
        if self.coordinates.edges().is_empty() {
            return LONGEST / largest;
        }

        let smaller_side = placement.size.0.min(placement.size.1);
        let visible = if smaller_side > 0.0 {
            LONGEST.min(AMPLITUDE * smaller_side)
        } else {
            LONGEST
        };
        let mut factor = visible / largest;
        for &[from, to] in self.coordinates.edges() {
            let (along_x, along_y) = difference(on_paper[to], on_paper[from]);
            let (v_x, v_y) = difference(self.displacement(to, mode), self.displacement(from, mode));
            let length = along_x.hypot(along_y);
            // On paper y points down.
            let approach = (v_y * along_y - v_x * along_x) / length;
            if approach > 0.0 {
                factor = factor.min(APPROACH * length / approach);
            }
        }

        factor
    }

    /// Where each node goes, on paper.
    fn moved(&self, mode: &BodyMode<'_>, factor: f64, on_paper: &[(f64, f64)]) -> Vec<(f64, f64)> {
        let mut moved = Vec::with_capacity(on_paper.len());
        for (node, (x, y)) in on_paper.iter().enumerate() {
            let (right, up) = self.displacement(node, mode);
            moved.push((x + factor * right, y - factor * up));
        }

        moved
    }

    /// Radius of the markers: neighbours do not cover each other.
    fn radius(&self, on_paper: &[(f64, f64)]) -> f64 {
        let mut places = Vec::new();
        for particle in self.particles {
            places.extend(self.coordinates.node_of(particle.tangential));
        }

        let mut nearest = f64::INFINITY;
        for (k, &one) in places.iter().enumerate() {
            for &other in &places[..k] {
                let (x, y) = difference(on_paper[one], on_paper[other]);
                let distance = x.hypot(y);
                if distance > 0.0 {
                    nearest = nearest.min(distance);
                }
            }
        }

        (OF_DISTANCE * nearest).clamp(SMALLEST, RADIUS)
    }

    fn edges(&self, on_paper: &[(f64, f64)]) -> Element {
        let mut d = String::new();
        for &[from, to] in self.coordinates.edges() {
            d += &segment(on_paper[from], on_paper[to]);
        }

        Element::new("path")
            .with("d", d)
            .with("fill", "none")
            .with("stroke", "#444")
            .with("stroke-width", "0.7")
    }

    /// The nodes: dots, those that are held squares; of a fine mesh these only.
    fn nodes(&self, on_paper: &[(f64, f64)]) -> Element {
        let is_fine = on_paper.len() > FEW && !self.coordinates.edges().is_empty();
        let mut group = Element::new("g").with("class", "nodes");
        for (node, &(x, y)) in self.coordinates.nodes().iter().zip(on_paper) {
            let is_held = node.dofs == [None, None];
            if is_fine && !is_held {
                continue;
            }

            let drawn = if is_held {
                let square = [(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (-3.0, 3.0)];
                let corners = square.map(|(right, down)| (x + right, y + down));
                Element::new("polygon").with("points", point_list(&corners))
            } else {
                Element::new("circle").at("cx", x).at("cy", y).at("r", 1.5)
            };
            let class = if is_held { "node held" } else { "node" };
            group.push(drawn.with("class", class).with("fill", "#666"));
        }

        group
    }

    /// The obstacle of each particle, where its normal can be drawn.
    fn obstacles(&self, on_paper: &[(f64, f64)]) -> Element {
        let mut group = Element::new("g").with("class", "obstacles");
        let in_contact = self.particles.iter();
        for particle in in_contact.filter(|p| p.state != ContactState::Free) {
            let Some(node) = self.coordinates.node_of(particle.normal) else {
                continue;
            };

            if let Some(normal) = self.normal_on_paper(particle, node) {
                group.push(obstacle(on_paper[node], normal));
            }
        }

        group
    }

    /// The unit vector into the obstacle of a particle at a node, on paper, where y points down;
    /// `None` where it cannot be drawn.
    fn normal_on_paper(&self, particle: &Particle, node: usize) -> Option<(f64, f64)> {
        let (x, y) = self.along_axes(&particle.into_obstacle(), node);
        let length = x.hypot(y);
        (length > 0.0).then(|| (x / length, -y / length))
    }

    /// The components along x and y of a direction at a node.
    pub(super) fn along_axes(&self, direction: &Direction, node: usize) -> (f64, f64) {
        let [along_x, along_y] = self.coordinates.nodes()[node].dofs;
        let mut x = 0.0;
        let mut y = 0.0;
        for (dof, coefficient) in direction {
            let part = to_f64(coefficient);
            if Some(*dof) == along_x {
                x += part;
            } else if Some(*dof) == along_y {
                y += part;
            }
        }

        (x, y)
    }

    /// What a particle does.
    fn mark(&self, particle: usize) -> Mark {
        match (&self.particles[particle].state, &self.mode) {
            (ContactState::Slip { .. }, Some(mode)) if !mode.slipping.contains(&particle) => {
                Mark::Caught
            }
            // Turned into the direction in which it is about to slip.
            (ContactState::Slip { .. }, _) => Mark::SlipAlong,
            (state, _) => Mark::of(*state),
        }
    }

    /// The names of the particles, each on the other side of the obstacle's surface, but for those
    /// that would cover another one.
    fn names(&self, on_paper: &[(f64, f64)]) -> Element {
        let mut names = Element::new("g").with("class", "names");
        let mut taken: Vec<[f64; 3]> = Vec::new(); // left, right, y
        for (particle, name) in self.particles.iter().zip(self.short_names()) {
            let Some(node) = self.coordinates.node_of(particle.tangential) else {
                continue;
            };

            let half = 0.5 * NAME_LETTER * NAME_SIZE * name.chars().count() as f64;
            let below = (0.0, 1.0);
            let (normal_x, normal_y) = self.normal_on_paper(particle, node).unwrap_or(below);
            let x = on_paper[node].0 + normal_x * (NAME_GAP + half);
            let y = on_paper[node].1 + normal_y * (NAME_GAP + 0.8 * NAME_SIZE) + 0.4 * NAME_SIZE;
            let [left, right] = [x - half, x + half];
            let covers = |[from, to, at]: &[f64; 3]| {
                (at - y).abs() < NAME_SIZE
                    && left < to + NAME_SIZE / 2.0
                    && from - NAME_SIZE / 2.0 < right
            };
            if taken.iter().any(covers) {
                continue;
            }

            taken.push([left, right, y]);
            let word = text(x, y, "middle", name).at("font-size", NAME_SIZE);
            names.push(word.with("class", "name"));
        }

        names
    }

    /// The markers of the particles, those of the slip particles turned.
    fn marks(&self, on_paper: &[(f64, f64)], radius: f64) -> Element {
        let mut marks = Element::new("g").with("class", "marks");
        for (index, particle) in self.particles.iter().enumerate() {
            let Some(node) = self.coordinates.node_of(particle.tangential) else {
                continue;
            };
            let (x, y) = on_paper[node];
            let mut mark = self.mark(index).draw(x, y, radius);
            if self.mark(index) == Mark::SlipAlong {
                mark = mark.turned(self.slip_angle(particle, node), (x, y));
            }
            marks.push(mark);
        }

        marks
    }

    /// The angle on paper, in degrees clockwise from x, of -S times the tangent: the direction of
    /// impending slip.
    pub(super) fn slip_angle(&self, particle: &Particle, node: usize) -> f64 {
        let sign = match particle.state {
            ContactState::Slip { sign } => f64::from(sign),
            _ => 0.0,
        };

        let (x, y) = self.along_axes(&particle.tangent(), node);
        let (slip_x, slip_y) = (-sign * x, -sign * y);
        (-slip_y).atan2(slip_x).to_degrees()
    }

    /// The names of the particles, or their numbers, each in few letters and no two alike.
    fn short_names(&self) -> Vec<String> {
        let particles = self.particles.iter().enumerate();
        let names: Vec<String> = particles.map(|(k, p)| p.name_or(k)).collect();
        short_names(&names, LETTERS)
    }

    /// The markers that occur with their words, from (x, y) on.
    fn legend(&self, x: f64, y: f64) -> Element {
        let mut used = Vec::new();
        for particle in 0..self.particles.len() {
            used.push(self.mark(particle));
        }

        legend(&used, x, y, |mark| match (mark, &self.mode) {
            (Mark::SlipAlong, None) => "impending slip, the way it points",
            (Mark::SlipAlong, Some(_)) => "slips, the way it points",
            _ => mark.word(),
        })
    }
}

/// The edges of a body that is drawn deformed too.
fn at_rest(edges: Element) -> Element {
    edges
        .with("class", "edges")
        .with("stroke-dasharray", "3 3")
        .with("opacity", "0.6")
}

/// The displacements of the nodes.
fn arrows(from: &[(f64, f64)], to: &[(f64, f64)]) -> Element {
    let mut arrows = Element::new("g").with("class", "arrows");
    for (&from, &to) in from.iter().zip(to) {
        let (right, down) = difference(to, from);
        if right.hypot(down) >= SHORTEST {
            arrows.push(arrow(from, (right, down)));
        }
    }

    arrows
}

fn difference(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 - b.0, a.1 - b.1)
}

/// A line across the normal in front of a place, and strokes on the side to which it points.
fn obstacle(place: (f64, f64), normal: (f64, f64)) -> Element {
    let along = (-normal.1, normal.0);
    let at = |t: f64, n: f64| {
        let x = place.0 + t * along.0 + n * normal.0;
        let y = place.1 + t * along.1 + n * normal.1;
        (x, y)
    };

    let half = OBSTACLE / 2.0;
    let surface = line(at(-half, GAP), at(half, GAP), "#000", 1.2);
    let mut group = Element::new("g").with("class", "obstacle").child(surface);
    for k in 0..STROKES {
        let t = -half + OBSTACLE * (k as f64 + 0.8) / STROKES as f64;
        let stroke = line(at(t, GAP), at(t - DEPTH, GAP + DEPTH), "#000", 0.7);
        group.push(stroke);
    }

    group
}

/// An arrow from a place by (right, down), px.
fn arrow(from: (f64, f64), (right, down): (f64, f64)) -> Element {
    let length = right.hypot(down);
    let unit = (right / length, down / length);
    let head = HEAD.min(0.5 * length);
    let tip = (from.0 + right, from.1 + down);
    let base = (tip.0 - head * unit.0, tip.1 - head * unit.1);

    // The corners of the head lie across the arrow.
    let across = (-0.45 * head * unit.1, 0.45 * head * unit.0);
    let corners = [
        tip,
        (base.0 + across.0, base.1 + across.1),
        (base.0 - across.0, base.1 - across.1),
    ];

    Element::new("g")
        .with("class", "arrow")
        .child(line(from, base, "#000", 1.3))
        .child(Element::new("polygon").with("points", point_list(&corners)))
}
