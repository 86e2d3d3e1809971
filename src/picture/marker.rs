//! Contact states as markers that differ in shape and in shade: legible in black and white.

use super::markup::{Element, point_list, segment, short};
use mceip_model::ContactState;

/// What a contact node does, as drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Mark {
    /// Sticks (d): a black square.
    Stick,
    /// Slips against its tangent, S = 1: a grey triangle pointing left.
    SlipAgainst,
    /// Slips along its tangent, S = -1: a grey triangle pointing right.
    SlipAlong,
    /// In impending slip, and gets stuck in the mode (x = 0): a white square with a cross.
    Caught,
    /// Open (f): a white circle.
    Free,
    /// In contact with zero reaction (z): a white diamond.
    Zero,
}

impl Mark {
    /// Every mark, in the order of legends.
    pub const ALL: [Mark; 6] = [
        Mark::Stick,
        Mark::SlipAgainst,
        Mark::SlipAlong,
        Mark::Caught,
        Mark::Free,
        Mark::Zero,
    ];

    /// The mark of a state at an equilibrium.
    pub fn of(state: ContactState) -> Mark {
        match state {
            ContactState::Stick => Mark::Stick,
            ContactState::Slip { sign } if sign > 0 => Mark::SlipAgainst,
            ContactState::Slip { .. } => Mark::SlipAlong,
            ContactState::Free => Mark::Free,
            ContactState::Zero => Mark::Zero,
        }
    }

    /// The triangle that is turned into the direction of slip, for either sign.
    pub(super) fn turned(self) -> Mark {
        match self {
            Mark::SlipAgainst => Mark::SlipAlong,
            other => other,
        }
    }

    /// The words of legends, short: all of them stand in one row. A node slips along its tangent or
    /// against it.
    pub fn word(self) -> &'static str {
        match self {
            Mark::Stick => "stick",
            Mark::SlipAgainst => "against tangent",
            Mark::SlipAlong => "along tangent",
            Mark::Caught => "gets stuck",
            Mark::Free => "free",
            Mark::Zero => "zero reaction",
        }
    }

    /// The class of its elements in the SVG: `mark` and this.
    pub fn class(self) -> &'static str {
        match self {
            Mark::Stick => "stick",
            Mark::SlipAgainst => "slip-against",
            Mark::SlipAlong => "slip-along",
            Mark::Caught => "caught",
            Mark::Free => "free",
            Mark::Zero => "zero",
        }
    }

    /// The marker about (x, y) within radius r, px.
    pub(super) fn draw(self, x: f64, y: f64, r: f64) -> Element {
        let class = format!("mark {}", self.class());
        let width = short((r / 5.0).clamp(0.4, 1.2));
        let group = Element::new("g")
            .with("class", class)
            .with("stroke", "#000")
            .with("stroke-width", width)
            .child(self.shape(x, y, r));

        if self == Mark::Caught {
            group.child(cross(x, y, 0.85 * r))
        } else {
            group
        }
    }

    fn shape(self, x: f64, y: f64, r: f64) -> Element {
        match self {
            Mark::Stick => polygon(x, y, r, &square(0.8)).with("fill", "#000"),
            Mark::SlipAgainst => polygon(x, y, r, &POINTS_LEFT).with("fill", "#b0b0b0"),
            Mark::SlipAlong => polygon(x, y, r, &POINTS_RIGHT).with("fill", "#b0b0b0"),
            Mark::Caught => polygon(x, y, r, &square(0.85)).with("fill", "#fff"),
            Mark::Free => Element::new("circle")
                .at("cx", x)
                .at("cy", y)
                .at("r", 0.85 * r)
                .with("fill", "#fff"),
            Mark::Zero => polygon(x, y, r, &DIAMOND).with("fill", "#fff"),
        }
    }
}

/// Corners of a triangle that points to the left, in units of the radius.
const POINTS_LEFT: [(f64, f64); 3] = [(-1.0, 0.0), (0.75, -0.9), (0.75, 0.9)];

/// Corners of a triangle that points to the right, in units of the radius.
const POINTS_RIGHT: [(f64, f64); 3] = [(1.0, 0.0), (-0.75, -0.9), (-0.75, 0.9)];

/// Corners of a square that stands on one of them.
const DIAMOND: [(f64, f64); 4] = [(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, 1.0)];

/// Corners of a square of half side `a`.
fn square(a: f64) -> [(f64, f64); 4] {
    [(-a, -a), (a, -a), (a, a), (-a, a)]
}

/// A polygon about (x, y); corners in units of the radius r.
fn polygon(x: f64, y: f64, r: f64, corners: &[(f64, f64)]) -> Element {
    let mut places = Vec::new();
    for (dx, dy) in corners {
        places.push((x + dx * r, y + dy * r));
    }

    Element::new("polygon").with("points", point_list(&places))
}

/// The two diagonals of a square of half side `a` about (x, y).
fn cross(x: f64, y: f64, a: f64) -> Element {
    let down = segment((x - a, y - a), (x + a, y + a));
    let up = segment((x - a, y + a), (x + a, y - a));

    Element::new("path")
        .with("d", down + &up)
        .with("fill", "none")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coordinates in the SVG of a mark, without class and shade.
    fn shape_of(mark: Mark) -> String {
        let text = mark.draw(0.0, 0.0, 10.0).to_string();
        let tree = roxmltree::Document::parse(&text).unwrap();

        let mut parts = Vec::new();
        for element in tree.descendants().filter(|n| n.is_element()) {
            for attribute in element.attributes() {
                if ["points", "d", "cx"].contains(&attribute.name()) {
                    parts.push(attribute.value().to_string());
                }
            }
        }

        parts.join(";")
    }

    #[test]
    fn every_mark_has_a_shape_of_its_own() {
        let mut shapes: Vec<String> = Mark::ALL.map(shape_of).to_vec();

        shapes.sort();
        shapes.dedup();

        assert_eq!(shapes.len(), Mark::ALL.len());
    }
}
