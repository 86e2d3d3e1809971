//! What runs cost against their size, both on logarithmic axes.

use super::chart::{Axis, Chart, dot, line, text};
use super::drawing::Picture;
use super::scale::Spread;

/// Runs of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct CostSeries {
    /// What they are, for the legend.
    pub name: String,
    /// Order and seconds of each, ascending by order; both positive.
    pub points: Vec<(f64, f64)>,
}

const WIDTH: f64 = 760.0;
const AREA: [f64; 4] = [84.0, 48.0, WIDTH - 30.0, 420.0];
/// Dash of the line and fill of the dots, one after the other.
const STYLES: [(&str, &str); 4] = [
    ("", "#000"),
    ("7 4", "#fff"),
    ("2 3", "#000"),
    ("9 3 2 3", "#fff"),
];

/// Draws each series as a line through its points; no more than four can be told apart in black and
/// white.
pub fn cost_picture(title: &str, order: &str, series: &[CostSeries]) -> Picture {
    let all = || series.iter().flat_map(|s| &s.points);
    let span = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) = all()
            .map(of)
            .fold((f64::INFINITY, 0.0f64), |m, v| (m.0.min(v), m.1.max(v)));
        (low / 1.3, high * 1.3)
    };
    let x = Axis {
        label: order,
        spread: Spread::Log,
        values: span(|p| p.0),
        ticks: 9,
    };
    let y = Axis {
        label: "CPU seconds",
        spread: Spread::Log,
        values: span(|p| p.1),
        ticks: 9,
    };
    let chart = Chart::new(AREA, &x, &y);
    let mut picture = Picture::new(
        title,
        WIDTH,
        AREA[3] + 62.0 + 20.0 * series.len().div_ceil(2) as f64,
    );
    picture.push(text(AREA[0], 24.0, "start", title).with("font-weight", "bold"));
    picture.push(chart.frame(&x, &y));
    for (k, s) in series.iter().enumerate() {
        let (dash, fill) = STYLES[k % STYLES.len()];
        picture.push(chart.curve(&s.points, 1.4, dash).with("class", "series"));
        for p in &s.points {
            picture.push(dot(
                chart.point(*p),
                3.5,
                fill,
                *p,
                format!("{}: {} at {}", s.name, p.1, p.0),
            ));
        }
        let (left, below) = (
            AREA[0] + 330.0 * (k % 2) as f64,
            AREA[3] + 58.0 + 20.0 * (k / 2) as f64,
        );
        let mut key = line((left, below - 4.5), (left + 36.0, below - 4.5), "#000", 1.4);
        if !dash.is_empty() {
            key = key.with("stroke-dasharray", dash);
        }
        picture.push(key);
        picture.push(
            dot(
                (left + 18.0, below - 4.5),
                3.5,
                fill,
                (0.0, 0.0),
                s.name.clone(),
            )
            .unclassed(),
        );
        picture.push(text(left + 44.0, below, "start", s.name.as_str()));
    }
    picture
}
