//! Contact states as markers that differ in shape and in shade: legible in black and white.

use super::markup::{Element, short};
use mceip_model::ContactState;

/// What a contact node does, as drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Mark {
    /// Sticks (d): a black square.
    Stick,
    /// Slips to the left, S = 1: a grey triangle pointing left.
    SlipLeft,
    /// Slips to the right, S = -1: a grey triangle pointing right.
    SlipRight,
    /// In impending slip, and gets stuck in the mode (x = 0): a white square with a cross.
    Caught,
    /// Open (f): a white circle.
    Free,
}

impl Mark {
    /// Every mark, in the order of legends.
    pub const ALL: [Mark; 5] = [
        Mark::Stick,
        Mark::SlipLeft,
        Mark::SlipRight,
        Mark::Caught,
        Mark::Free,
    ];

    /// The mark of a state at an equilibrium.
    pub fn of(state: ContactState) -> Mark {
        match state {
            ContactState::Stick => Mark::Stick,
            ContactState::Slip { sign } if sign > 0 => Mark::SlipLeft,
            ContactState::Slip { .. } => Mark::SlipRight,
            ContactState::Free => Mark::Free,
        }
    }

    /// The marks of a mode: slip nodes that are not in `moving` get stuck. `moving` counts the
    /// nodes in impending slip from 0 at the left.
    pub fn of_mode(states: &[ContactState], moving: &[usize]) -> Vec<Mark> {
        let mut slip = 0..;
        let mark = |state: &ContactState| match state {
            ContactState::Slip { .. } if slip.next().is_some_and(|k| !moving.contains(&k)) => {
                Mark::Caught
            }
            state => Mark::of(*state),
        };
        states.iter().map(mark).collect()
    }

    /// The words of legends.
    pub fn word(self) -> &'static str {
        match self {
            Mark::Stick => "stick",
            Mark::SlipLeft => "slip left",
            Mark::SlipRight => "slip right",
            Mark::Caught => "impending slip, gets stuck",
            Mark::Free => "free",
        }
    }

    /// The class of its elements in the SVG: `mark` and this.
    pub fn class(self) -> &'static str {
        match self {
            Mark::Stick => "stick",
            Mark::SlipLeft => "slip-left",
            Mark::SlipRight => "slip-right",
            Mark::Caught => "caught",
            Mark::Free => "free",
        }
    }

    /// The marker about (x, y) within radius r.
    pub(super) fn draw(self, x: f64, y: f64, r: f64) -> Element {
        let polygon = |points: &[(f64, f64)]| {
            let points: Vec<String> = points
                .iter()
                .map(|(dx, dy)| format!("{},{}", short(x + dx * r), short(y + dy * r)))
                .collect();
            Element::new("polygon").with("points", points.join(" "))
        };
        let square = |a: f64| polygon(&[(-a, -a), (a, -a), (a, a), (-a, a)]);
        let shape = match self {
            Mark::Stick => square(0.8).with("fill", "#000"),
            Mark::SlipLeft => {
                polygon(&[(-1.0, 0.0), (0.75, -0.9), (0.75, 0.9)]).with("fill", "#b0b0b0")
            }
            Mark::SlipRight => {
                polygon(&[(1.0, 0.0), (-0.75, -0.9), (-0.75, 0.9)]).with("fill", "#b0b0b0")
            }
            Mark::Free => Element::new("circle")
                .at("cx", x)
                .at("cy", y)
                .at("r", 0.85 * r)
                .with("fill", "#fff"),
            Mark::Caught => square(0.85).with("fill", "#fff"),
        };
        let (width, class) = (
            short((r / 5.0).clamp(0.4, 1.2)),
            format!("mark {}", self.class()),
        );
        let group = Element::new("g")
            .with("class", class)
            .with("stroke", "#000")
            .with("stroke-width", width)
            .child(shape);
        if self != Mark::Caught {
            return group;
        }
        let (a, mut d) = (0.85 * r, String::new());
        for (from, to) in [((-a, -a), (a, a)), ((-a, a), (a, -a))] {
            d += &format!(
                "M{} {}L{} {}",
                short(x + from.0),
                short(y + from.1),
                short(x + to.0),
                short(y + to.1)
            );
        }
        group.child(Element::new("path").with("d", d).with("fill", "none"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slip_nodes_that_do_not_move_are_caught() {
        let slip = ContactState::Slip { sign: 1 };
        let states = [
            ContactState::Stick,
            slip,
            slip,
            ContactState::Slip { sign: -1 },
            slip,
            ContactState::Free,
        ];
        let marks = Mark::of_mode(&states, &[0, 2]);
        assert_eq!(
            marks,
            [
                Mark::Stick,
                Mark::SlipLeft,
                Mark::Caught,
                Mark::SlipRight,
                Mark::Caught,
                Mark::Free
            ]
        );
    }

    #[test]
    fn every_mark_has_a_shape_of_its_own() {
        // Without class and shade: the shapes alone must differ.
        let shape = |m: Mark| {
            let text = m.draw(0.0, 0.0, 10.0).to_string();
            let tree = roxmltree::Document::parse(&text).unwrap();
            let parts: Vec<String> = tree
                .descendants()
                .filter(|n| n.is_element())
                .flat_map(|n| {
                    n.attributes()
                        .filter(|a| ["points", "d", "cx"].contains(&a.name()))
                        .map(|a| a.value().to_string())
                        .collect::<Vec<_>>()
                })
                .collect();
            parts.join(";")
        };
        let mut shapes: Vec<String> = Mark::ALL.map(shape).to_vec();
        shapes.sort();
        shapes.dedup();
        assert_eq!(shapes.len(), Mark::ALL.len());
    }
}
