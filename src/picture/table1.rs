//! Table 1 as a chart: over the angle and the friction, how many solutions each sign pattern has.
//!
//! A panel for each sign pattern (S_1, S_2). Its boundaries are the thresholds mu(phi) at which a
//! solution appears, with lambda^2 = 0; its regions are shaded by the number of solutions.
//! Thresholds and counts come from the closed forms of [`mceip_oracle`], evaluated exactly at
//! rational angles. k and m play no part in them. Called by `mceip table1 --chart`.

use super::chart::{Axis, Chart, Rectangle, line, text};
use super::drawing::Picture;
use super::markup::{Element, point_list};
use super::scale::Spread;
use mceip_exact::{Quadratic, Rational, from_f64, rational, to_f64, whole};
use mceip_oracle::{TwoParticles, table1, thresholds};
use num_traits::One;

/// Friction shown.
const FRICTION: (f64, f64) = (1.0, 30.0);

/// Angles at which boundaries are computed: tan(phi / 2) = k / ANGLES, cosine and sine rational.
const ANGLES: i64 = 96;

/// Width and height of a panel, px.
const PANEL: (f64, f64) = (330.0, 250.0);

const SIGNS: [(i8, i8); 4] = [(1, 1), (-1, -1), (1, -1), (-1, 1)];

/// Shades of regions with 0, 1, 2 and 3 solutions.
const SHADES: [&str; 4] = ["#fff", "#e4e4e4", "#cfcfcf", "#a8a8a8"];

const TITLE: &str = "Two particles of Fig. 1: number of solutions of MCEIP-\u{3bb}\u{b2}";

const NOTES: [&str; 4] = [
    "Number of solutions in each region. 1: slip-slip. 2: slip-stick and stick-slip, with the same \
     \u{3bb}\u{b2}.",
    "3: these two, and slip-slip with x\u{2081} = x\u{2082}.",
    "A boundary belongs to the region above it: there \u{3bb}\u{b2} = 0. At \u{3c6} = 90\u{b0} \
     (thick line) K is only semidefinite,",
    "and \u{3bb}\u{b2} = 0 solves the problem for every \u{3bc} if S\u{2081} = S\u{2082}.",
];

/// The chart, all four sign patterns; boundaries and counts come from the closed forms of
/// [`mceip_oracle`], evaluated exactly (k and m play no part in them).
pub fn table1_picture() -> Picture {
    let mut picture = Picture::new(TITLE, 870.0, 790.0);
    picture.push_heading(80.0, 26.0);

    for (k, signs) in SIGNS.into_iter().enumerate() {
        let column = (k % 2) as f64;
        let row = (k / 2) as f64;
        let left = 84.0 + 420.0 * column;
        let top = 70.0 + 330.0 * row;
        let area = Rectangle {
            left,
            top,
            right: left + PANEL.0,
            bottom: top + PANEL.1,
        };
        picture.push(panel(signs, area));
    }

    for (k, note) in NOTES.iter().enumerate() {
        let y = 716.0 + 18.0 * k as f64;
        picture.push(text(30.0, y, "start", *note).with("font-size", "12"));
    }

    picture
}

/// The chart of one sign pattern.
fn panel(signs: (i8, i8), area: Rectangle) -> Element {
    let x = Axis::linear("\u{3c6} (degrees)", (0.0, 90.0), 9);
    let y = Axis {
        label: "\u{3bc}",
        spread: Spread::Log,
        values: FRICTION,
        ticks: 9,
    };
    let chart = Chart::new(area, &x, &y);
    let boundaries = boundaries(signs);

    let mut group = Element::new("g")
        .with("class", "panel")
        .with("data-signs", format!("{:+} {:+}", signs.0, signs.1));
    for boundary in &boundaries {
        group.push(boundary.region_above(&chart));
    }

    group.push(chart.frame(&x, &y));
    for boundary in &boundaries {
        let curve = chart.curve(&boundary.shown(), 2.0, "");
        group.push(curve.with("class", "boundary"));
    }

    // At phi = 90 degrees K is only semidefinite.
    if signs.0 == signs.1 {
        let top = (area.right, area.top);
        let bottom = (area.right, area.bottom);
        let thick = line(top, bottom, "#000", 5.0);
        group.push(thick.with("class", "semidefinite"));
    }

    push_counts(&mut group, &chart, signs);
    let title = format!(
        "S\u{2081} = {}, S\u{2082} = {}",
        signed_one(signs.0),
        signed_one(signs.1)
    );
    let middle = (area.left + area.right) / 2.0;
    group.push(text(middle, area.top - 10.0, "middle", title));

    group
}

fn signed_one(sign: i8) -> &'static str {
    if sign > 0 { "+1" } else { "\u{2212}1" }
}

/// A boundary between regions.
struct Boundary {
    /// phi in degrees, and mu, by ascending phi.
    points: Vec<(f64, f64)>,
    /// Number of solutions just above it.
    above: usize,
}

/// The distinct thresholds along the angle, lowest first, with the count just above each in the
/// middle.
fn boundaries(signs: (i8, i8)) -> Vec<Boundary> {
    let mut boundaries: Vec<Boundary> = Vec::new();
    for k in 1..ANGLES {
        let data = at(signs, &rational(k, ANGLES), whole(1));
        let phi = degrees(&data);
        let values = sorted(threshold_values(&data));

        for (i, mu) in values.iter().enumerate() {
            if boundaries.len() == i {
                let next = values.get(i + 1).copied().unwrap_or(2.0 * mu);
                let above = count(&data, 0.5 * (mu + next));
                let points = Vec::new();
                boundaries.push(Boundary { points, above });
            }

            boundaries[i].points.push((phi, *mu));
        }
    }

    boundaries
}

/// The thresholds of the closed form, in doubles.
fn threshold_values(data: &TwoParticles) -> Vec<f64> {
    let exact = thresholds(data).unwrap_or_default();
    exact.iter().map(|t| to_double(&t.value)).collect()
}

/// In ascending order, each once.
fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

impl Boundary {
    /// The part inside the panel, with the points at which it leaves through the top.
    fn shown(&self) -> Vec<(f64, f64)> {
        let top = FRICTION.1;
        let mut shown = Vec::new();
        let mut before: Option<(f64, f64)> = None;

        for &(phi, mu) in &self.points {
            if let Some((phi_before, mu_before)) = before
                && (mu > top) != (mu_before > top)
            {
                // The axis of mu is logarithmic.
                let part = (top / mu_before).ln() / (mu / mu_before).ln();
                shown.push((phi_before + part * (phi - phi_before), top));
            }

            if mu <= top {
                shown.push((phi, mu));
            }

            before = Some((phi, mu));
        }

        shown
    }

    /// The part of the panel above it, shaded by the number of solutions.
    fn region_above(&self, chart: &Chart) -> Element {
        let edge = self.shown();
        let mut corners = Vec::new();
        if let Some((phi, _)) = edge.first() {
            corners.push((*phi, FRICTION.1));
        }

        corners.extend(&edge);
        if let Some((phi, _)) = edge.last() {
            corners.push((*phi, FRICTION.1));
        }

        let places: Vec<(f64, f64)> = corners.iter().map(|p| chart.point(*p)).collect();
        Element::new("polygon")
            .with("class", "region")
            .with("data-count", self.above)
            .with("points", point_list(&places))
            .with("fill", SHADES[self.above.min(3)])
    }
}

/// The numbers in the regions, at an angle where these are wide; each counted there by the closed
/// form.
fn push_counts(group: &mut Element, chart: &Chart, signs: (i8, i8)) {
    let half_tangent = rational(1, 2); // phi = 53.1 degrees
    let data = at(signs, &half_tangent, whole(1));
    let mut levels = threshold_values(&data);
    levels.extend([FRICTION.0, FRICTION.1]);

    for pair in sorted(levels).windows(2) {
        let mu = (pair[0] * pair[1]).sqrt();
        let n = count(&data, mu);
        let (x, y) = chart.point((degrees(&data), mu));
        let label = text(x, y + 5.0, "middle", n.to_string())
            .with("class", "count")
            .with("font-size", "16")
            .with("data-count", n)
            .with("data-mu", mu)
            .with("stroke", "#fff")
            .with("stroke-width", "3")
            .with("paint-order", "stroke");
        group.push(label);
    }
}

/// The data at tan(phi / 2) = t: cos phi = (1 - t^2) / (1 + t^2), sin phi = 2 t / (1 + t^2).
fn at(signs: (i8, i8), t: &Rational, mu: Rational) -> TwoParticles {
    let square = t * t;
    let denominator = Rational::one() + &square;

    TwoParticles {
        c: (Rational::one() - square) / &denominator,
        s: whole(2) * t / denominator,
        k: whole(1),
        m: whole(1),
        mu,
        signs,
    }
}

/// The number of solutions at this friction; 0 for a number that is not finite.
fn count(data: &TwoParticles, mu: f64) -> usize {
    let Ok(mu) = from_f64(mu) else {
        return 0;
    };
    let data = TwoParticles { mu, ..data.clone() };
    table1(&data).len()
}

/// phi.
fn degrees(data: &TwoParticles) -> f64 {
    to_f64(&data.s).atan2(to_f64(&data.c)).to_degrees()
}

/// A number of Q(sqrt d) in doubles, by halving an interval that holds it.
fn to_double(number: &Quadratic) -> f64 {
    let mut low = 0.0;
    let mut high = 1e6;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let is_below = from_f64(middle).is_ok_and(|m| number.within(&whole(0), &m));
        if is_below {
            high = middle;
        } else {
            low = middle;
        }
    }

    high
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside each boundary the closed form has another count below than above.
    #[test]
    fn counts_change_at_the_boundaries() {
        let expected: [((i8, i8), &[usize]); 4] = [
            ((1, 1), &[1]),
            ((-1, -1), &[1]),
            ((1, -1), &[2, 3]),
            ((-1, 1), &[]),
        ];

        for (signs, counts_above) in expected {
            let found = boundaries(signs);

            let above: Vec<usize> = found.iter().map(|b| b.above).collect();
            assert_eq!(above, counts_above, "{signs:?}");
            for boundary in &found {
                assert_eq!(boundary.points.len(), (ANGLES - 1) as usize);
                assert_counts_beside(boundary, signs);
            }
        }
    }

    fn assert_counts_beside(boundary: &Boundary, signs: (i8, i8)) {
        for (k, (phi, mu)) in boundary.points.iter().enumerate() {
            let half_tangent = rational(k as i64 + 1, ANGLES);
            let data = at(signs, &half_tangent, whole(1));

            assert!((degrees(&data) - phi).abs() < 1e-9);
            assert_eq!(count(&data, mu * 1.0001), boundary.above);
            assert!(count(&data, mu * 0.9999) < boundary.above);
        }
    }

    /// sqrt(c^2 + 2) / s at phi with c = 3/5: sqrt(59) / 4.
    #[test]
    fn irrational_thresholds_in_doubles() {
        let data = at((1, 1), &rational(1, 2), whole(1));
        assert_eq!(data.c, rational(3, 5));
        assert_eq!(data.s, rational(4, 5));

        let found = threshold_values(&data);

        assert!((found[0] - 59f64.sqrt() / 4.0).abs() < 1e-12, "{found:?}");
    }
}
