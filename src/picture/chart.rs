//! A rectangle with two axes, and what is drawn on it.

use super::markup::{Element, short};
use super::scale::{Scale, Spread, label};

/// Text of this height, px.
pub(super) const TEXT: f64 = 13.0;

/// What an axis says.
pub(super) struct Axis<'a> {
    pub(super) label: &'a str,
    pub(super) spread: Spread,
    pub(super) values: (f64, f64),
    /// Number of ticks wanted; 0 for none.
    pub(super) ticks: usize,
}

/// A chart's rectangle on the paper with its axes.
pub(super) struct Chart {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Chart {
    /// `area`: left, top, right, bottom of the rectangle.
    pub(super) fn new(area: [f64; 4], x: &Axis<'_>, y: &Axis<'_>) -> Chart {
        let [left, top, right, bottom] = area;
        Chart {
            x: Scale::new(x.spread, x.values, (left, right)),
            y: Scale::new(y.spread, y.values, (bottom, top)),
        }
    }

    /// Frame, ticks, grid and labels.
    pub(super) fn frame(&self, x: &Axis<'_>, y: &Axis<'_>) -> Element {
        let ((left, right), (bottom, top)) = (self.x.places(), self.y.places());
        let mut group = Element::new("g").with("class", "frame");
        for tick in if x.ticks > 0 {
            self.x.ticks(x.ticks)
        } else {
            Vec::new()
        } {
            let at = self.x.place(tick);
            group.push(line((at, top), (at, bottom), "#d8d8d8", 0.7));
            group.push(line((at, bottom), (at, bottom + 5.0), "#000", 1.0));
            group.push(text(at, bottom + 6.0 + TEXT, "middle", label(tick)));
        }
        let mut taken = f64::INFINITY;
        for tick in if y.ticks > 0 {
            self.y.ticks(y.ticks)
        } else {
            Vec::new()
        } {
            let at = self.y.place(tick);
            if taken - at < 1.1 * TEXT {
                continue; // no room for its label above the last one
            }
            taken = at;
            group.push(line((left, at), (right, at), "#d8d8d8", 0.7));
            group.push(line((left - 5.0, at), (left, at), "#000", 1.0));
            group.push(text(left - 8.0, at + 0.35 * TEXT, "end", label(tick)));
        }
        let rect = Element::new("rect")
            .at("x", left)
            .at("y", top)
            .at("width", right - left)
            .at("height", bottom - top);
        group.push(rect.with("fill", "none").with("stroke", "#000"));
        if !x.label.is_empty() {
            let below = if x.ticks > 0 { 2.6 } else { 1.6 };
            group.push(text(
                (left + right) / 2.0,
                bottom + below * TEXT + 6.0,
                "middle",
                x.label,
            ));
        }
        if !y.label.is_empty() {
            let (at, middle) = (left - 56.0, (top + bottom) / 2.0);
            let turn = format!("rotate(-90 {} {})", short(at), short(middle));
            group.push(text(at, middle, "middle", y.label).with("transform", turn));
        }
        group
    }

    /// Where a point lies.
    pub(super) fn point(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x.place(x), self.y.place(y))
    }

    /// A line through points; `dash` as in SVG, empty for a full line.
    pub(super) fn curve(&self, points: &[(f64, f64)], width: f64, dash: &str) -> Element {
        let points: Vec<String> = points
            .iter()
            .map(|p| self.point(*p))
            .map(|(x, y)| format!("{},{}", short(x), short(y)))
            .collect();
        let curve = Element::new("polyline")
            .with("points", points.join(" "))
            .with("fill", "none")
            .with("stroke", "#000");
        let curve = curve.at("stroke-width", width);
        if dash.is_empty() {
            curve
        } else {
            curve.with("stroke-dasharray", dash)
        }
    }
}

/// A straight line.
pub(super) fn line(from: (f64, f64), to: (f64, f64), colour: &str, width: f64) -> Element {
    let ends = Element::new("line")
        .at("x1", from.0)
        .at("y1", from.1)
        .at("x2", to.0)
        .at("y2", to.1);
    ends.with("stroke", colour).at("stroke-width", width)
}

/// A text; `anchor` is start, middle or end.
pub(super) fn text(x: f64, y: f64, anchor: &'static str, content: impl Into<String>) -> Element {
    Element::new("text")
        .at("x", x)
        .at("y", y)
        .with("text-anchor", anchor)
        .text(content)
}

/// A point of the data: a dot whose attributes and tooltip give the numbers.
pub(super) fn dot(
    (x, y): (f64, f64),
    radius: f64,
    fill: &str,
    data: (f64, f64),
    tip: String,
) -> Element {
    let circle = Element::new("circle")
        .with("class", "point")
        .at("cx", x)
        .at("cy", y)
        .at("r", radius);
    let circle = circle
        .with("fill", fill)
        .with("stroke", "#000")
        .with("data-x", data.0)
        .with("data-y", data.1);
    circle.child(Element::new("title").text(tip))
}
