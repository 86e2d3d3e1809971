//! The static thresholds along the loading path: MCEIP-mu of each state, on a logarithmic axis.
//!
//! Input: for each stretch of the path with slip, all solutions of MCEIP-mu of its state and the mu
//! from which on the necessary condition (19) or (20) holds. Called by `mceip path --report`.

use super::chart::{Axis, Chart, Rectangle, TEXT, dashed, line, text};
use super::drawing::Picture;
use super::markup::{Element, point_list};
use super::scale::{Extent, Scale, Spread, label};

/// What is drawn of one stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct ThresholdColumn {
    /// Number of the stretch on the path.
    pub stretch: usize,
    /// Nodes in impending slip.
    pub slip: usize,
    /// MCEIP-mu solutions.
    pub solutions: Vec<Threshold>,
    /// mu from which the necessary condition (19) or (20) holds, if it does.
    pub necessary: Option<f64>,
}

/// A solution of MCEIP-mu.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threshold {
    /// mu.
    pub mu: f64,
    /// Nodes that slip in its mode.
    pub moving: usize,
}

const WIDTH: f64 = 860.0;
const AREA: Rectangle = Rectangle {
    left: 84.0,
    top: 84.0,
    right: WIDTH - 30.0,
    bottom: 400.0,
};

/// Dashes of the line at the friction of the path.
const FRICTION_DASH: &str = "8 4";

/// Draws the thresholds, a column for each stretch with slip. `mu` is the friction of the path.
pub fn threshold_picture(title: &str, columns: &[ThresholdColumn], mu: f64) -> Picture {
    let count = columns.len().max(1) as f64;
    let x = Axis::linear("", (0.0, count), 0);
    let y = mu_axis(columns, mu);
    let chart = Chart::new(AREA, &x, &y);

    let mut picture = Picture::new(title, WIDTH, AREA.bottom + 64.0);
    picture.push_heading(AREA.left, 24.0);
    picture.push(chart.frame(&x, &y));
    if chart.y.shows(mu) {
        let friction = chart.curve(&[(0.0, mu), (count, mu)], 1.2, FRICTION_DASH);
        picture.push(friction.with("class", "friction"));
    }

    let width = chart.x.place(1.0) - chart.x.place(0.0);
    let radius = (0.3 * width).clamp(1.5, 6.0);
    for (k, column) in columns.iter().enumerate() {
        let middle = k as f64 + 0.5;
        column.draw(&mut picture, &chart, middle, radius);
    }

    push_labels(&mut picture, columns, &chart.x, width);
    push_keys(&mut picture, mu);
    picture
}

/// An axis that holds every threshold, every necessary condition and the friction of the path.
fn mu_axis(columns: &[ThresholdColumn], mu: f64) -> Axis<'static> {
    let mut values = Vec::new();
    for column in columns {
        values.extend(column.solutions.iter().map(|s| s.mu));
        values.extend(column.necessary);
    }

    values.push(mu);

    let positive = values.into_iter().filter(|v| *v > 0.0);
    let Extent { low, high } = Extent::of(positive);

    Axis {
        label: "coefficient of friction \u{3bc}",
        spread: Spread::Log,
        values: (low / 1.6, high * 4.0),
        ticks: 8,
    }
}

impl ThresholdColumn {
    /// Draws the column about `middle` on the x axis, with marks of this radius (px).
    fn draw(&self, picture: &mut Picture, chart: &Chart, middle: f64, radius: f64) {
        for solution in &self.solutions {
            let (x, y) = chart.point((middle, solution.mu));
            let tip = format!(
                "stretch {}: mu = {:.9}, {} of {} slip",
                self.stretch, solution.mu, solution.moving, self.slip
            );
            let is_all_slip = solution.moving == self.slip;
            let mark = threshold_mark(x, y, radius, is_all_slip)
                .with("data-stretch", self.stretch)
                .with("data-mu", solution.mu)
                .child(Element::new("title").text(tip));
            picture.push(mark);

            let has_room = self.solutions.len() == 1 && radius >= 4.0;
            if has_room {
                let number = text(x, y - radius - 5.0, "middle", solution.moving.to_string());
                picture.push(number.with("font-size", "11"));
            }
        }

        if let Some(mu) = self.necessary {
            let (x, y) = chart.point((middle, mu));
            let left = x - 1.3 * radius;
            let right = x + 1.3 * radius;
            let bar = line((left, y), (right, y), "#000", 2.0)
                .with("class", "necessary")
                .with("data-stretch", self.stretch)
                .with("data-mu", mu);
            picture.push(bar);
        }
    }
}

/// A full disc if every node slips, an open diamond if some get stuck.
fn threshold_mark(x: f64, y: f64, r: f64, is_all_slip: bool) -> Element {
    if is_all_slip {
        return Element::new("circle")
            .with("class", "threshold all-slip")
            .at("cx", x)
            .at("cy", y)
            .at("r", r);
    }

    let corners = [(x - r, y), (x, y - r), (x + r, y), (x, y + r)];
    Element::new("polygon")
        .with("class", "threshold some-stick")
        .with("points", point_list(&corners))
        .with("fill", "#fff")
        .with("stroke", "#000")
        .with("stroke-width", "1.3")
}

/// Numbers of stretches and of slip nodes in two rows below, as many as there is room for.
fn push_labels(picture: &mut Picture, columns: &[ThresholdColumn], x: &Scale, width: f64) {
    let stretch_row = AREA.bottom + 16.0;
    let slip_row = AREA.bottom + 32.0;

    let every = (22.0 / width).ceil().max(1.0) as usize;
    for (k, column) in columns.iter().enumerate().step_by(every) {
        let middle = x.place(k as f64 + 0.5);
        let stretch = text(middle, stretch_row, "middle", column.stretch.to_string());
        let slip = text(middle, slip_row, "middle", column.slip.to_string());
        picture.push(stretch.with("font-size", "11"));
        picture.push(slip.with("font-size", "11"));
    }

    let left = AREA.left - 8.0;
    let stretch = text(left, stretch_row, "end", "stretch");
    let slip = text(left, slip_row, "end", "slip nodes");
    picture.push(stretch.with("font-size", "11"));
    picture.push(slip.with("font-size", "11"));
}

/// What each sign means, in two lines above the chart.
fn push_keys(picture: &mut Picture, mu: f64) {
    let x = AREA.left + 8.0;
    let first = 48.0;
    let second = first + TEXT + 7.0;

    let all_slip = "MCEIP-\u{3bc}, all slip nodes slip";
    picture.push(threshold_mark(x, first - 4.5, 6.0, true).unclassed());
    picture.push(text(x + 12.0, first, "start", all_slip));

    let some_stick = "some get stuck (number that slips above it)";
    picture.push(threshold_mark(x + 310.0, first - 4.5, 6.0, false).unclassed());
    picture.push(text(x + 324.0, first, "start", some_stick));

    let middle = second - 4.5;
    let necessary = "necessary condition holds from here";
    picture.push(line((x - 8.0, middle), (x + 8.0, middle), "#000", 2.0));
    picture.push(text(x + 12.0, second, "start", necessary));

    let friction = line((x + 298.0, middle), (x + 320.0, middle), "#000", 1.2);
    picture.push(dashed(friction, FRICTION_DASH));
    let words = format!("\u{3bc} = {} of the path", label(mu));
    picture.push(text(x + 324.0, second, "start", words));
}
