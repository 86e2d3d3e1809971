//! A rectangle with two axes, and what is drawn on it: curves, lines, dots and texts.
//!
//! A [`Chart`] takes a point of the data to its place on the paper by two scales. The y axis of the
//! data points up, that of SVG down. Every chart of [`super`] is drawn with it.

use super::markup::{Element, point_list, short};
use super::scale::{Scale, Spread, label};

/// Height of texts, px.
pub(super) const TEXT: f64 = 13.0;

/// Colour of the lines of the grid.
const GRID: &str = "#d8d8d8";

/// What an axis says.
pub(super) struct Axis<'a> {
    /// Empty for none.
    pub(super) label: &'a str,
    pub(super) spread: Spread,
    /// The numbers at the two ends, the smaller one first.
    pub(super) values: (f64, f64),
    /// Number of ticks wanted; 0 for none.
    pub(super) ticks: usize,
}

impl<'a> Axis<'a> {
    pub(super) fn linear(label: &'a str, values: (f64, f64), ticks: usize) -> Axis<'a> {
        Axis {
            label,
            spread: Spread::Linear,
            values,
            ticks,
        }
    }
}

/// A rectangle on the paper, px; the top has the smaller y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

/// A chart's rectangle on the paper with its axes.
pub(super) struct Chart {
    pub(super) x: Scale,
    pub(super) y: Scale,
    area: Rectangle,
}

impl Chart {
    /// The chart in this rectangle; nothing is drawn yet.
    pub(super) fn new(area: Rectangle, x: &Axis<'_>, y: &Axis<'_>) -> Chart {
        Chart {
            x: Scale::new(x.spread, x.values, (area.left, area.right)),
            y: Scale::new(y.spread, y.values, (area.bottom, area.top)),
            area,
        }
    }

    /// Frame, ticks, grid and labels.
    pub(super) fn frame(&self, x: &Axis<'_>, y: &Axis<'_>) -> Element {
        let mut group = Element::new("g").with("class", "frame");
        self.push_x_ticks(&mut group, x.ticks);
        self.push_y_ticks(&mut group, y.ticks);
        group.push(self.border());

        if !x.label.is_empty() {
            group.push(self.x_label(x));
        }

        if !y.label.is_empty() {
            group.push(self.y_label(y));
        }

        group
    }

    /// The x axis alone: ticks, grid, a line and the label.
    pub(super) fn x_axis(&self, x: &Axis<'_>) -> Element {
        let Rectangle {
            left,
            right,
            bottom,
            ..
        } = self.area;

        let mut group = Element::new("g").with("class", "frame");
        self.push_x_ticks(&mut group, x.ticks);
        group.push(line((left, bottom), (right, bottom), "#000", 1.0));
        group.push(self.x_label(x));
        group
    }

    /// For each tick a line of the grid, a short line below the frame, and the number.
    fn push_x_ticks(&self, group: &mut Element, wanted: usize) {
        if wanted == 0 {
            return;
        }

        let Rectangle { top, bottom, .. } = self.area;
        for tick in self.x.ticks(wanted) {
            let at = self.x.place(tick);
            group.push(line((at, top), (at, bottom), GRID, 0.7));
            group.push(line((at, bottom), (at, bottom + 5.0), "#000", 1.0));
            group.push(text(at, bottom + 6.0 + TEXT, "middle", label(tick)));
        }
    }

    /// The same at the left; a tick whose label would touch the one below it is left out.
    fn push_y_ticks(&self, group: &mut Element, wanted: usize) {
        if wanted == 0 {
            return;
        }

        let Rectangle { left, right, .. } = self.area;
        let mut last_label = f64::INFINITY;

        for tick in self.y.ticks(wanted) {
            let at = self.y.place(tick);
            if last_label - at < 1.1 * TEXT {
                continue;
            }

            last_label = at;
            group.push(line((left, at), (right, at), GRID, 0.7));
            group.push(line((left - 5.0, at), (left, at), "#000", 1.0));
            group.push(text(left - 8.0, at + 0.35 * TEXT, "end", label(tick)));
        }
    }

    fn border(&self) -> Element {
        let area = self.area;
        Element::new("rect")
            .at("x", area.left)
            .at("y", area.top)
            .at("width", area.right - area.left)
            .at("height", area.bottom - area.top)
            .with("fill", "none")
            .with("stroke", "#000")
    }

    fn x_label(&self, axis: &Axis<'_>) -> Element {
        let middle = (self.area.left + self.area.right) / 2.0;
        let lines_below = if axis.ticks > 0 { 2.6 } else { 1.6 };
        let y = self.area.bottom + lines_below * TEXT + 6.0;
        text(middle, y, "middle", axis.label)
    }

    /// The label of the y axis, which runs upwards.
    fn y_label(&self, axis: &Axis<'_>) -> Element {
        let x = self.area.left - 56.0;
        let middle = (self.area.top + self.area.bottom) / 2.0;
        let turn = format!("rotate(-90 {} {})", short(x), short(middle));
        text(x, middle, "middle", axis.label).with("transform", turn)
    }

    /// The place of a point of the data.
    pub(super) fn point(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x.place(x), self.y.place(y))
    }

    /// A line through points of the data; `dash` as in SVG, empty for a full line.
    pub(super) fn curve(&self, points: &[(f64, f64)], width: f64, dash: &str) -> Element {
        let places: Vec<(f64, f64)> = points.iter().map(|p| self.point(*p)).collect();
        let curve = Element::new("polyline")
            .with("points", point_list(&places))
            .with("fill", "none")
            .with("stroke", "#000")
            .at("stroke-width", width);

        dashed(curve, dash)
    }
}

/// A line with dashes as in SVG; empty for a full line.
pub(super) fn dashed(line: Element, dash: &str) -> Element {
    if dash.is_empty() {
        line
    } else {
        line.with("stroke-dasharray", dash)
    }
}

/// A straight line between two places.
pub(super) fn line(from: (f64, f64), to: (f64, f64), colour: &str, width: f64) -> Element {
    Element::new("line")
        .at("x1", from.0)
        .at("y1", from.1)
        .at("x2", to.0)
        .at("y2", to.1)
        .with("stroke", colour)
        .at("stroke-width", width)
}

/// A text; `anchor` is start, middle or end.
pub(super) fn text(x: f64, y: f64, anchor: &'static str, content: impl Into<String>) -> Element {
    Element::new("text")
        .at("x", x)
        .at("y", y)
        .with("text-anchor", anchor)
        .text(content)
}

/// A point of the data at (x, y) on the paper: a dot whose attributes and tooltip give the numbers.
pub(super) fn dot(
    (x, y): (f64, f64),
    radius: f64,
    fill: &str,
    data: (f64, f64),
    tip: String,
) -> Element {
    Element::new("circle")
        .with("class", "point")
        .at("cx", x)
        .at("cy", y)
        .at("r", radius)
        .with("fill", fill)
        .with("stroke", "#000")
        .with("data-x", data.0)
        .with("data-y", data.1)
        .child(Element::new("title").text(tip))
}
