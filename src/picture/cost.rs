//! What runs cost against their size, both on logarithmic axes.
//!
//! The benchmarks of the program draw their tables with it.

use super::chart::{Axis, Chart, Rectangle, dashed, dot, line, text};
use super::drawing::Picture;
use super::scale::{Extent, Spread};

/// Runs of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct CostSeries {
    /// What they are, for the legend.
    pub name: String,
    /// Order and seconds of each, ascending by order; both positive.
    pub points: Vec<(f64, f64)>,
}

pub(super) const WIDTH: f64 = 760.0;
pub(super) const AREA: Rectangle = Rectangle {
    left: 84.0,
    top: 48.0,
    right: WIDTH - 30.0,
    bottom: 420.0,
};

/// How a series is drawn: the dash of its line and the fill of its dots.
pub(super) struct Style {
    pub(super) dash: &'static str,
    pub(super) fill: &'static str,
}

/// The styles of the series in turn.
pub(super) const STYLES: [Style; 4] = [
    Style {
        dash: "",
        fill: "#000",
    },
    Style {
        dash: "7 4",
        fill: "#fff",
    },
    Style {
        dash: "2 3",
        fill: "#000",
    },
    Style {
        dash: "9 3 2 3",
        fill: "#fff",
    },
];

/// Draws each series as a line through its points; no more than four can be told apart in black and
/// white.
pub fn cost_picture(title: &str, order: &str, series: &[CostSeries]) -> Picture {
    let points: Vec<&(f64, f64)> = series.iter().flat_map(|s| &s.points).collect();
    let x = logarithmic(order, points.iter().map(|p| p.0));
    let y = logarithmic("CPU seconds", points.iter().map(|p| p.1));
    let chart = Chart::new(AREA, &x, &y);

    let mut picture = Picture::new(title, WIDTH, height_with_keys(series.len()));
    picture.push_heading(AREA.left, 24.0);
    picture.push(chart.frame(&x, &y));

    for (k, one) in series.iter().enumerate() {
        let style = &STYLES[k % STYLES.len()];
        let curve = chart.curve(&one.points, 1.4, style.dash);
        picture.push(curve.with("class", "series"));

        for point in &one.points {
            let (order, seconds) = point;
            let tip = format!("{}: {seconds} at {order}", one.name);
            picture.push(dot(chart.point(*point), 3.5, style.fill, *point, tip));
        }

        push_key(&mut picture, k, &one.name, style);
    }

    picture
}

/// Height of a picture of [`AREA`] with the keys of so many series below it.
pub(super) fn height_with_keys(series: usize) -> f64 {
    AREA.bottom + 62.0 + 20.0 * series.div_ceil(2) as f64
}

/// A logarithmic axis with some room at both ends.
fn logarithmic(label: &str, values: impl Iterator<Item = f64>) -> Axis<'_> {
    let Extent { low, high } = Extent::of(values);
    Axis {
        label,
        spread: Spread::Log,
        values: (low / 1.3, high * 1.3),
        ticks: 9,
    }
}

/// The key of the series k, two in a row below the chart.
pub(super) fn push_key(picture: &mut Picture, k: usize, name: &str, style: &Style) {
    let column = (k % 2) as f64;
    let row = (k / 2) as f64;
    let x = AREA.left + 330.0 * column;
    let y = AREA.bottom + 58.0 + 20.0 * row;

    let key = line((x, y - 4.5), (x + 36.0, y - 4.5), "#000", 1.4);
    picture.push(dashed(key, style.dash));

    let middle = (x + 18.0, y - 4.5);
    picture.push(dot(middle, 3.5, style.fill, (0.0, 0.0), name.into()).unclassed());
    picture.push(text(x + 44.0, y, "start", name));
}
