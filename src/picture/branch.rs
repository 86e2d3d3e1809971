//! lambda^2 against mu for one state: where it can diverge, and how fast.

use super::chart::{Axis, Chart, TEXT, dot, line, text};
use super::drawing::Picture;
use super::markup;
use super::markup::Element;
use super::scale::Spread;

/// A solution of MCEIP-lambda2 as a point of the (mu, lambda^2) plane.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPoint {
    /// Coefficient of friction.
    pub mu: f64,
    /// lambda^2, 1/s^2.
    pub lambda2: f64,
    /// Slip variables with x > 0.
    pub support: Vec<usize>,
}

/// What is known of a state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Branches {
    /// Solutions at levels of lambda^2, level by level from lambda^2 = 0 upwards, every solution of
    /// a level.
    pub levels: Vec<Vec<BranchPoint>>,
    /// Certified solutions at chosen mu.
    pub certified: Vec<BranchPoint>,
}

const WIDTH: f64 = 760.0;
const AREA: [f64; 4] = [100.0, 84.0, WIDTH - 40.0, 440.0];

/// Draws the solutions: lines join points with the same moving nodes at neighbouring levels, and
/// points at which the moving nodes change are joined by a dotted line if each level has one that
/// is left over.
pub fn branch_picture(title: &str, branches: &Branches) -> Picture {
    let all = || branches.levels.iter().flatten().chain(&branches.certified);
    let (low, high) = all().fold((f64::INFINITY, 0.0f64), |m, p| {
        (m.0.min(p.mu), m.1.max(p.mu))
    });
    let top = all().map(|p| p.lambda2).fold(0.0, f64::max);
    let unit = all()
        .map(|p| p.lambda2)
        .filter(|v| *v > 0.0)
        .fold(f64::INFINITY, f64::min);
    let unit = if unit.is_finite() { unit } else { 1.0 };
    let wide = high > 8.0 * low;
    let span = if wide {
        (low / 1.15, high * 1.15)
    } else {
        (low - 0.06 * (high - low), high + 0.06 * (high - low))
    };
    let spread = if wide { Spread::Log } else { Spread::Linear };
    let x = Axis {
        label: "coefficient of friction \u{3bc}",
        spread,
        values: span,
        ticks: 8,
    };
    let y = Axis {
        label: "\u{3bb}\u{b2} (1/s\u{b2})",
        spread: Spread::LogWithZero { unit },
        values: (0.0, top * 1.5),
        ticks: 7,
    };
    let chart = Chart::new(AREA, &x, &y);
    let mut picture = Picture::new(title, WIDTH, AREA[3] + 62.0);
    picture.push(text(AREA[0], 24.0, "start", title).with("font-weight", "bold"));
    picture.push(chart.frame(&x, &y));
    for pair in branches.levels.windows(2) {
        join(&mut picture, &chart, &pair[0], &pair[1]);
    }
    for (level, points) in branches.levels.iter().enumerate() {
        for p in points {
            let tip = format!(
                "mu = {:.9}, lambda^2 = {:.6e}, {} slip",
                p.mu,
                p.lambda2,
                p.support.len()
            );
            let (radius, fill) = if level == 0 && p.lambda2 == 0.0 {
                (6.0, "#000")
            } else {
                (2.5, "#fff")
            };
            picture.push(dot(
                chart.point((p.mu, p.lambda2)),
                radius,
                fill,
                (p.mu, p.lambda2),
                tip,
            ));
        }
    }
    for p in &branches.certified {
        picture.push(square(chart.point((p.mu, p.lambda2)), p));
    }
    keys(&mut picture, branches);
    picture
}

fn join(picture: &mut Picture, chart: &Chart, below: &[BranchPoint], above: &[BranchPoint]) {
    let ends = |a: &BranchPoint, b: &BranchPoint| [(a.mu, a.lambda2), (b.mu, b.lambda2)];
    let mut left: Vec<&BranchPoint> = above.iter().collect();
    let mut alone = Vec::new();
    for a in below {
        match left.iter().position(|b| b.support == a.support) {
            Some(k) => picture.push(
                chart
                    .curve(&ends(a, left.remove(k)), 1.6, "")
                    .with("class", "branch"),
            ),
            None => alone.push(a),
        }
    }
    if let ([a], [b]) = (alone.as_slice(), left.as_slice()) {
        picture.push(chart.curve(&ends(a, b), 1.2, "2 3").with("class", "change"));
    }
}

fn square((x, y): (f64, f64), p: &BranchPoint) -> Element {
    let rect = Element::new("rect")
        .with("class", "certified")
        .at("x", x - 5.0)
        .at("y", y - 5.0)
        .at("width", 10.0)
        .at("height", 10.0);
    let tip = format!(
        "certified: mu = {}, lambda^2 = {:.9e}, lambda = {:.6} 1/s",
        p.mu,
        p.lambda2,
        p.lambda2.sqrt()
    );
    let rect = rect
        .with("fill", "none")
        .with("stroke", "#000")
        .with("stroke-width", "2")
        .with("data-x", p.mu)
        .with("data-y", p.lambda2);
    rect.child(Element::new("title").text(tip))
}

fn keys(picture: &mut Picture, branches: &Branches) {
    let (x, y) = (AREA[0] + 8.0, 48.0);
    picture.push(
        Element::new("circle")
            .at("cx", x)
            .at("cy", y - 4.5)
            .at("r", 6.0),
    );
    picture.push(text(x + 14.0, y, "start", "MCEIP-\u{3bc}, \u{3bb} = 0"));
    picture.push(line(
        (x + 140.0, y - 4.5),
        (x + 164.0, y - 4.5),
        "#000",
        1.6,
    ));
    picture.push(text(
        x + 170.0,
        y,
        "start",
        "solutions with the same slip nodes",
    ));
    let second = y + TEXT + 8.0;
    if !branches.certified.is_empty() {
        let rect = Element::new("rect")
            .at("x", x - 5.0)
            .at("y", second - 10.0)
            .at("width", 10.0)
            .at("height", 10.0);
        picture.push(
            rect.with("fill", "none")
                .with("stroke", "#000")
                .with("stroke-width", "2"),
        );
        picture.push(text(x + 14.0, second, "start", "certified at this \u{3bc}"));
    }
    picture.push(
        line(
            (x + 140.0, second - 4.5),
            (x + 164.0, second - 4.5),
            "#000",
            1.2,
        )
        .with("stroke-dasharray", "2 3"),
    );
    let levels = markup::short(branches.levels.len() as f64);
    picture.push(text(
        x + 170.0,
        second,
        "start",
        format!("the slip nodes change ({levels} levels of \u{3bb}\u{b2} computed)"),
    ));
}
