//! The growth rate lambda against mu for one state: where it can diverge, and how fast.
//!
//! Input: all solutions of MCEIP-lambda2 at some levels of lambda^2, each as a point (mu, lambda^2)
//! with its support, and certified solutions at chosen mu. The axis of lambda is logarithmic with a
//! zero. Called by `mceip path` and `mceip analyze`.

use super::chart::{Axis, Chart, Rectangle, TEXT, dashed, dot, line, text};
use super::drawing::Picture;
use super::markup;
use super::markup::Element;
use super::scale::{Extent, Spread};

/// A solution of MCEIP-lambda2 as a point of the (mu, lambda) plane.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartPoint {
    /// Coefficient of friction.
    pub mu: f64,
    /// lambda^2, 1/s^2.
    pub lambda2: f64,
    /// The complementarity variables with x > 0.
    pub support: Vec<usize>,
}

/// What is known of a state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Branches {
    /// Solutions at levels of lambda^2, level by level from lambda^2 = 0 upwards, every solution of
    /// a level.
    pub levels: Vec<Vec<ChartPoint>>,
    /// Certified solutions at chosen mu.
    pub certified: Vec<ChartPoint>,
    /// A mu below which it is proved that there is no solution for any lambda^2 >= 0.
    pub absent_below: Option<f64>,
}

const WIDTH: f64 = 760.0;
const AREA: Rectangle = Rectangle {
    left: 100.0,
    top: 84.0,
    right: WIDTH - 40.0,
    bottom: 440.0,
};

/// Dashes of the lines between points with different supports.
const CHANGE_DASH: &str = "2 3";

/// Dashes of the line to whose left nothing exists.
const ABSENT_DASH: &str = "8 4";

/// Radius of the mark of a static threshold, px.
const THRESHOLD_RADIUS: f64 = 6.0;

/// Radius of the mark of a solution above lambda^2 = 0, px.
const LEVEL_RADIUS: f64 = 2.5;

/// Baseline of the first row of keys, px.
const FIRST_KEY: f64 = 44.0;

/// Distance between the rows of keys, px.
const KEY_DISTANCE: f64 = TEXT + 3.0;

impl ChartPoint {
    fn place(&self) -> (f64, f64) {
        (self.mu, self.growth_rate())
    }

    /// lambda, 1/s.
    fn growth_rate(&self) -> f64 {
        self.lambda2.sqrt()
    }
}

impl Branches {
    fn points(&self) -> impl Iterator<Item = &ChartPoint> {
        self.levels.iter().flatten().chain(&self.certified)
    }

    /// Whether a solution of MCEIP-mu with lambda = 0 is drawn.
    fn has_threshold(&self) -> bool {
        let lowest = self.levels.first();
        lowest.is_some_and(|points| points.iter().any(|p| p.lambda2 == 0.0))
    }

    /// The mu axis: logarithmic where the largest value is more than eight times the smallest.
    fn mu_axis(&self) -> Axis<'static> {
        let all = self.points().map(|p| p.mu).chain(self.absent_below);
        let Extent { low, high } = Extent::of(all);
        let is_wide = high > 8.0 * low;

        let margin = 0.06 * (high - low);
        let values = if is_wide {
            (low / 1.15, high * 1.15)
        } else {
            (low - margin, high + margin)
        };

        Axis {
            label: "coefficient of friction \u{3bc}",
            spread: if is_wide { Spread::Log } else { Spread::Linear },
            values,
            ticks: 8,
        }
    }

    /// The axis of lambda: even below the smallest positive value, logarithmic above it.
    fn rate_axis(&self) -> Axis<'static> {
        let rates = || self.points().map(ChartPoint::growth_rate);
        let all = Extent::of(rates());
        let positive = Extent::of(rates().filter(|rate| *rate > 0.0));
        let unit = if positive.low.is_finite() {
            positive.low
        } else {
            1.0
        };

        Axis {
            label: "growth rate \u{3bb} (1/s); linear near 0, then log",
            spread: Spread::LogWithZero { unit },
            values: (0.0, all.high * 1.25),
            ticks: 7,
        }
    }
}

/// Draws the solutions.
///
/// Lines join points with the same support at neighbouring levels, the nearest in mu first. Where
/// each of two levels has one point that is left over, a dotted line joins these two: there the
/// support changes.
pub fn branch_picture(title: &str, branches: &Branches) -> Picture {
    let x = branches.mu_axis();
    let y = branches.rate_axis();
    let chart = Chart::new(AREA, &x, &y);

    let mut picture = Picture::new(title, WIDTH, AREA.bottom + 62.0);
    picture.push_heading(AREA.left, 24.0);
    picture.push(chart.frame(&x, &y));

    let mut supports_change = false;
    for pair in branches.levels.windows(2) {
        supports_change |= join(&mut picture, &chart, &pair[0], &pair[1]);
    }

    for (level, points) in branches.levels.iter().enumerate() {
        for point in points {
            picture.push(solution_dot(&chart, level, point));
        }
    }

    for point in &branches.certified {
        picture.push(certified_square(&chart, point));
    }

    if let Some(mu) = branches.absent_below {
        push_bound(&mut picture, &chart, mu);
    }

    push_keys(&mut picture, branches, supports_change);
    picture
}

/// The line to whose left it is proved that nothing exists.
fn push_bound(picture: &mut Picture, chart: &Chart, mu: f64) {
    let (x, _) = chart.point((mu, 0.0));
    let bound = line((x, AREA.top), (x, AREA.bottom), "#000", 1.2);
    picture.push(
        dashed(bound, ABSENT_DASH)
            .with("class", "absent")
            .with("data-x", mu),
    );

    let words = "proved: nothing to the left, for any \u{3bb}";
    picture.push(text(x + 8.0, AREA.bottom - 10.0, "start", words));
}

/// A solution of a level: a large black dot for a threshold, a small white one above lambda^2 = 0.
fn solution_dot(chart: &Chart, level: usize, point: &ChartPoint) -> Element {
    let is_threshold = level == 0 && point.lambda2 == 0.0;
    let radius = if is_threshold {
        THRESHOLD_RADIUS
    } else {
        LEVEL_RADIUS
    };
    let fill = if is_threshold { "#000" } else { "#fff" };

    let tip = format!(
        "mu = {:.9}, lambda = {:.6e} 1/s, {} slip",
        point.mu,
        point.growth_rate(),
        point.support.len()
    );

    dot(chart.point(point.place()), radius, fill, point.place(), tip)
}

/// The lines between two neighbouring levels; whether one joins different supports.
fn join(picture: &mut Picture, chart: &Chart, below: &[ChartPoint], above: &[ChartPoint]) -> bool {
    let mut left_above: Vec<&ChartPoint> = above.iter().collect();
    let mut left_below: Vec<&ChartPoint> = below.iter().collect();
    while let Some([lower, upper]) = nearest_alike(&left_below, &left_above) {
        let lower = left_below.remove(lower);
        let upper = left_above.remove(upper);
        let line = chart.curve(&[lower.place(), upper.place()], 1.6, "");
        picture.push(line.with("class", "branch"));
    }

    let ([a], [b]) = (left_below.as_slice(), left_above.as_slice()) else {
        return false;
    };

    let line = chart.curve(&[a.place(), b.place()], 1.2, CHANGE_DASH);
    picture.push(line.with("class", "change"));
    true
}

/// Of the pairs of points with the same support the one with the least distance in mu.
fn nearest_alike(below: &[&ChartPoint], above: &[&ChartPoint]) -> Option<[usize; 2]> {
    let mut nearest = None;
    let mut least = f64::INFINITY;
    for (lower, one) in below.iter().enumerate() {
        for (upper, other) in above.iter().enumerate() {
            let distance = (one.mu - other.mu).abs();
            if one.support == other.support && distance < least {
                least = distance;
                nearest = Some([lower, upper]);
            }
        }
    }

    nearest
}

fn certified_square(chart: &Chart, point: &ChartPoint) -> Element {
    let (x, y) = chart.point(point.place());
    let tip = format!(
        "certified: mu = {}, lambda^2 = {:.9e}, lambda = {:.6} 1/s",
        point.mu,
        point.lambda2,
        point.growth_rate()
    );

    square((x, y))
        .with("class", "certified")
        .with("data-x", point.mu)
        .with("data-y", point.growth_rate())
        .child(Element::new("title").text(tip))
}

/// An open square about a point.
fn square((x, y): (f64, f64)) -> Element {
    Element::new("rect")
        .at("x", x - 5.0)
        .at("y", y - 5.0)
        .at("width", 10.0)
        .at("height", 10.0)
        .with("fill", "none")
        .with("stroke", "#000")
        .with("stroke-width", "2")
}

/// A sign with its meaning.
struct Key {
    /// The sign, drawn about a point.
    sign: fn((f64, f64)) -> Element,
    meaning: String,
}

/// What each sign means, in two columns above the chart; only the signs that are drawn.
fn push_keys(picture: &mut Picture, branches: &Branches, supports_change: bool) {
    let has_levels = !branches.levels.is_empty();
    let mut points = Vec::new();
    if has_levels {
        let levels = markup::short(branches.levels.len() as f64);
        points.push(Key {
            sign: level_sign,
            meaning: format!("at {levels} levels of \u{3bb}"),
        });
    }
    if branches.has_threshold() {
        points.push(Key {
            sign: threshold_sign,
            meaning: "MCEIP-\u{3bc}, \u{3bb} = 0".into(),
        });
    }
    if !branches.certified.is_empty() {
        points.push(Key {
            sign: square,
            meaning: "certified at this \u{3bc}".into(),
        });
    }

    let mut lines = Vec::new();
    if has_levels {
        lines.push(Key {
            sign: branch_sign,
            meaning: "solutions with the same support".into(),
        });
    }
    if supports_change {
        lines.push(Key {
            sign: change_sign,
            meaning: "the support changes".into(),
        });
    }

    let left = AREA.left + 8.0;
    push_column(picture, &points, left, 14.0);
    push_column(picture, &lines, left + 190.0, 20.0);
}

/// Keys below each other from `x` on, each with its words at the distance `indent` (px).
fn push_column(picture: &mut Picture, keys: &[Key], x: f64, indent: f64) {
    for (row, key) in keys.iter().enumerate() {
        let baseline = FIRST_KEY + row as f64 * KEY_DISTANCE;
        let middle = baseline - 4.5;
        picture.push((key.sign)((x, middle)));
        picture.push(text(x + indent, baseline, "start", key.meaning.clone()));
    }
}

fn level_sign((x, y): (f64, f64)) -> Element {
    disc((x, y), LEVEL_RADIUS, "#fff").with("stroke", "#000")
}

fn threshold_sign((x, y): (f64, f64)) -> Element {
    disc((x, y), THRESHOLD_RADIUS, "#000")
}

fn disc((x, y): (f64, f64), radius: f64, fill: &str) -> Element {
    Element::new("circle")
        .at("cx", x)
        .at("cy", y)
        .at("r", radius)
        .with("fill", fill)
}

fn branch_sign(middle: (f64, f64)) -> Element {
    short_line(middle, 1.6)
}

fn change_sign(middle: (f64, f64)) -> Element {
    dashed(short_line(middle, 1.2), CHANGE_DASH)
}

fn short_line((x, y): (f64, f64), width: f64) -> Element {
    line((x - 12.0, y), (x + 12.0, y), "#000", width)
}
