//! The static thresholds along the loading path: MCEIP-mu of each state, on a logarithmic axis.

use super::chart::{Axis, Chart, TEXT, line, text};
use super::drawing::Picture;
use super::markup::{Element, short};
use super::scale::{Scale, Spread};

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
const SIDES: (f64, f64) = (84.0, WIDTH - 30.0);
const HEIGHTS: (f64, f64) = (84.0, 400.0);

/// Draws the thresholds, a column for each stretch with slip. `mu` is the friction of the path.
pub fn threshold_picture(title: &str, columns: &[ThresholdColumn], mu: f64) -> Picture {
    let values = || {
        columns
            .iter()
            .flat_map(|c| c.solutions.iter().map(|s| s.mu).chain(c.necessary))
            .chain([mu])
            .filter(|v| *v > 0.0)
    };
    let (low, high) = values().fold((f64::INFINITY, 0.0f64), |m, v| (m.0.min(v), m.1.max(v)));
    let x = Axis {
        label: "",
        spread: Spread::Linear,
        values: (0.0, columns.len().max(1) as f64),
        ticks: 0,
    };
    let y = Axis {
        label: "coefficient of friction \u{3bc}",
        spread: Spread::Log,
        values: (low / 1.6, high * 4.0),
        ticks: 8,
    };
    let chart = Chart::new([SIDES.0, HEIGHTS.0, SIDES.1, HEIGHTS.1], &x, &y);
    let mut picture = Picture::new(title, WIDTH, HEIGHTS.1 + 64.0);
    picture.push(text(SIDES.0, 24.0, "start", title).with("font-weight", "bold"));
    picture.push(chart.frame(&x, &y));
    if chart.y.shows(mu) {
        picture.push(
            chart
                .curve(&[(0.0, mu), (columns.len().max(1) as f64, mu)], 1.2, "8 4")
                .with("class", "friction"),
        );
    }
    let width = chart.x.place(1.0) - chart.x.place(0.0);
    let r = (0.3 * width).clamp(1.5, 6.0);
    for (k, column) in columns.iter().enumerate() {
        draw_column(&mut picture, &chart, k, column, r);
    }
    labels(&mut picture, columns, &chart.x, width);
    keys(&mut picture, mu);
    picture
}

fn draw_column(picture: &mut Picture, chart: &Chart, k: usize, column: &ThresholdColumn, r: f64) {
    let x = k as f64 + 0.5;
    for s in &column.solutions {
        let (at, tip) = (
            chart.point((x, s.mu)),
            format!(
                "stretch {}: mu = {:.9}, {} of {} slip",
                column.stretch, s.mu, s.moving, column.slip
            ),
        );
        let mark = threshold_mark(at, r, s.moving == column.slip);
        picture.push(
            mark.with("data-stretch", column.stretch)
                .with("data-mu", s.mu)
                .child(Element::new("title").text(tip)),
        );
        if column.solutions.len() == 1 && r >= 4.0 {
            picture.push(
                text(at.0, at.1 - r - 5.0, "middle", s.moving.to_string()).with("font-size", "11"),
            );
        }
    }
    if let Some(mu) = column.necessary {
        let (x, y) = chart.point((x, mu));
        let bar = line((x - 1.3 * r, y), (x + 1.3 * r, y), "#000", 2.0).with("class", "necessary");
        picture.push(bar.with("data-stretch", column.stretch).with("data-mu", mu));
    }
}

/// A full disc if every node slips, an open diamond if some get stuck.
fn threshold_mark((x, y): (f64, f64), r: f64, all_slip: bool) -> Element {
    if all_slip {
        return Element::new("circle")
            .with("class", "threshold all-slip")
            .at("cx", x)
            .at("cy", y)
            .at("r", r);
    }
    let corners = [(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, 1.0)]
        .map(|(a, b)| format!("{},{}", short(x + a * r), short(y + b * r)));
    let diamond = Element::new("polygon")
        .with("class", "threshold some-stick")
        .with("points", corners.join(" "));
    diamond
        .with("fill", "#fff")
        .with("stroke", "#000")
        .with("stroke-width", "1.3")
}

fn labels(picture: &mut Picture, columns: &[ThresholdColumn], x: &Scale, width: f64) {
    let every = (22.0 / width).ceil().max(1.0) as usize;
    let small = |at: f64, y: f64, what: String| text(at, y, "middle", what).with("font-size", "11");
    for (k, column) in columns
        .iter()
        .enumerate()
        .filter(|(k, _)| k.is_multiple_of(every))
    {
        let at = x.place(k as f64 + 0.5);
        picture.push(small(at, HEIGHTS.1 + 16.0, column.stretch.to_string()));
        picture.push(small(at, HEIGHTS.1 + 32.0, column.slip.to_string()));
    }
    for (y, what) in [(16.0, "stretch"), (32.0, "slip nodes")] {
        picture.push(text(SIDES.0 - 8.0, HEIGHTS.1 + y, "end", what).with("font-size", "11"));
    }
}

fn keys(picture: &mut Picture, mu: f64) {
    let (x, y) = (SIDES.0 + 8.0, 48.0);
    let key = |at: f64, word: &str| text(at, y, "start", word);
    picture.push(threshold_mark((x, y - 4.5), 6.0, true).unclassed());
    picture.push(key(x + 12.0, "MCEIP-\u{3bc}, all slip nodes slip"));
    picture.push(threshold_mark((x + 310.0, y - 4.5), 6.0, false).unclassed());
    picture.push(key(
        x + 324.0,
        "some get stuck (number that slips above it)",
    ));
    let second = y + TEXT + 7.0;
    picture.push(line(
        (x - 8.0, second - 4.5),
        (x + 8.0, second - 4.5),
        "#000",
        2.0,
    ));
    picture.push(text(
        x + 12.0,
        second,
        "start",
        "necessary condition holds from here",
    ));
    picture.push(
        line(
            (x + 298.0, second - 4.5),
            (x + 320.0, second - 4.5),
            "#000",
            1.2,
        )
        .with("stroke-dasharray", "8 4"),
    );
    picture.push(text(
        x + 324.0,
        second,
        "start",
        format!("\u{3bc} = {} of the path", super::scale::label(mu)),
    ));
}
