//! Motions in time: what was integrated, and beside it what a certified mode predicts.
//!
//! `mceip simulate --picture` draws it: alpha(t) of a run along a mode as dots on the curve of (8),
//! or the norms of runs from random impulses.

use super::chart::{Axis, Chart, Rectangle, dashed, dot, line, text};
use super::drawing::Picture;
use super::scale::{Extent, Spread};

/// One quantity against time.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionSeries {
    /// What it is, for the legend.
    pub name: String,
    /// Time and value of each sample, values positive.
    pub points: Vec<(f64, f64)>,
    /// Drawn as dots, what was integrated beside a prediction; else as a curve.
    pub is_dotted: bool,
}

const WIDTH: f64 = 760.0;
const AREA: Rectangle = Rectangle {
    left: 84.0,
    top: 48.0,
    right: WIDTH - 30.0,
    bottom: 380.0,
};

/// Dashes of the curves, one after the other.
const DASHES: [&str; 5] = ["", "8 4", "2 3", "10 3 2 3", "5 2"];

/// Dots drawn of a series, about.
const DOTS: usize = 25;

/// Draws the series over time; `quantity` labels the other axis.
pub fn motion_picture(
    title: &str,
    quantity: &str,
    spread: Spread,
    series: &[MotionSeries],
) -> Picture {
    let points: Vec<&(f64, f64)> = series.iter().flat_map(|s| &s.points).collect();
    let times = Extent::of(points.iter().map(|p| p.0));
    let values = Extent::of(points.iter().map(|p| p.1));
    let is_log = spread == Spread::Log;

    let x = Axis::linear(
        "time (unit: root of mass / stiffness)",
        (0.0, times.high),
        8,
    );
    let y = Axis {
        label: quantity,
        spread,
        values: (if is_log { values.low } else { 0.0 }, 1.05 * values.high),
        ticks: 7,
    };
    let chart = Chart::new(AREA, &x, &y);

    let height = AREA.bottom + 56.0 + 20.0 * series.len() as f64;
    let mut picture = Picture::new(title, WIDTH, height);
    picture.push_heading(AREA.left, 24.0);
    picture.push(chart.frame(&x, &y));
    for (k, one) in series.iter().enumerate() {
        let dash = DASHES[k % DASHES.len()];
        if one.is_dotted {
            push_dots(&mut picture, &chart, one);
        } else {
            let curve = chart.curve(&one.points, 1.4, dash);
            picture.push(curve.with("class", "series"));
        }

        push_key(&mut picture, k, one, dash);
    }

    picture
}

fn push_dots(picture: &mut Picture, chart: &Chart, series: &MotionSeries) {
    let every = series.points.len().div_ceil(DOTS).max(1);
    for point in series.points.iter().step_by(every) {
        let (time, value) = point;
        let tip = format!("{}: {value} at {time}", series.name);
        picture.push(dot(chart.point(*point), 3.5, "#fff", *point, tip));
    }
}

/// The key of the series k, in a row of its own below the chart.
fn push_key(picture: &mut Picture, k: usize, series: &MotionSeries, dash: &str) {
    let x = AREA.left;
    let y = AREA.bottom + 58.0 + 20.0 * k as f64;
    let middle = y - 4.5;

    if series.is_dotted {
        let sample = dot(
            (x + 18.0, middle),
            3.5,
            "#fff",
            (0.0, 0.0),
            series.name.clone(),
        );
        picture.push(sample.unclassed());
    } else {
        let sample = line((x, middle), (x + 36.0, middle), "#000", 1.4);
        picture.push(dashed(sample, dash));
    }

    picture.push(text(x + 44.0, y, "start", series.name.as_str()));
}
