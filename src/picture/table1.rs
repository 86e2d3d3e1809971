//! Table 1 as a chart: over the angle and the friction, how many solutions each sign pattern has.

use super::chart::{Axis, Chart, line, text};
use super::drawing::Picture;
use super::markup::{Element, short};
use super::scale::Spread;
use mceip_exact::{Quadratic, Rational, from_f64, rational, to_f64, whole};
use mceip_oracle::{TwoParticles, table1, thresholds};
use num_traits::One;

/// Friction shown.
const FRICTION: (f64, f64) = (1.0, 30.0);
/// Angles at which boundaries are computed: tan(phi / 2) = k / ANGLES, cosine and sine rational.
const ANGLES: i64 = 96;
const PANEL: (f64, f64) = (330.0, 250.0);
const SIGNS: [(i8, i8); 4] = [(1, 1), (-1, -1), (1, -1), (-1, 1)];

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
    let mut picture = Picture::new(
        "Two particles of Fig. 1: number of solutions of MCEIP-\u{3bb}\u{b2}",
        870.0,
        790.0,
    );
    picture.push(text(80.0, 26.0, "start", picture.title.clone()).with("font-weight", "bold"));
    for (k, signs) in SIGNS.into_iter().enumerate() {
        let (left, top) = (84.0 + 420.0 * (k % 2) as f64, 70.0 + 330.0 * (k / 2) as f64);
        picture.push(panel(signs, [left, top, left + PANEL.0, top + PANEL.1]));
    }
    for (k, line) in NOTES.iter().enumerate() {
        picture.push(text(30.0, 716.0 + 18.0 * k as f64, "start", *line).with("font-size", "12"));
    }
    picture
}

/// A boundary between regions: (phi in degrees, mu), and the number of solutions above it.
struct Boundary {
    points: Vec<(f64, f64)>,
    above: usize,
}

fn panel(signs: (i8, i8), area: [f64; 4]) -> Element {
    let x = Axis {
        label: "\u{3c6} (degrees)",
        spread: Spread::Linear,
        values: (0.0, 90.0),
        ticks: 9,
    };
    let y = Axis {
        label: "\u{3bc}",
        spread: Spread::Log,
        values: FRICTION,
        ticks: 9,
    };
    let chart = Chart::new(area, &x, &y);
    let sign = |s: i8| if s > 0 { "+1" } else { "\u{2212}1" };
    let title = format!(
        "S\u{2081} = {}, S\u{2082} = {}",
        sign(signs.0),
        sign(signs.1)
    );
    let mut group = Element::new("g")
        .with("class", "panel")
        .with("data-signs", format!("{:+} {:+}", signs.0, signs.1));
    let boundaries = boundaries(signs);
    for b in &boundaries {
        group.push(region(&chart, b));
    }
    group.push(chart.frame(&x, &y));
    for b in &boundaries {
        group.push(
            chart
                .curve(&shown(&b.points), 2.0, "")
                .with("class", "boundary"),
        );
    }
    if signs.0 == signs.1 {
        group.push(
            line((area[2], area[1]), (area[2], area[3]), "#000", 5.0).with("class", "semidefinite"),
        );
    }
    counts(&mut group, &chart, signs);
    group.push(text(
        (area[0] + area[2]) / 2.0,
        area[1] - 10.0,
        "middle",
        title,
    ));
    group
}

/// The distinct thresholds along the angle, lowest first, with the count just above each in the
/// middle.
fn boundaries(signs: (i8, i8)) -> Vec<Boundary> {
    let mut curves: Vec<Boundary> = Vec::new();
    for k in 1..ANGLES {
        let data = at(signs, &rational(k, ANGLES), whole(1));
        let mut values: Vec<f64> = thresholds(&data)
            .unwrap_or_default()
            .iter()
            .map(|s| value(&s.value))
            .collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let phi = degrees(&data);
        for (i, mu) in values.iter().enumerate() {
            if curves.len() == i {
                let next = values.get(i + 1).copied().unwrap_or(2.0 * mu);
                curves.push(Boundary {
                    points: Vec::new(),
                    above: count(&data, 0.5 * (mu + next)),
                });
            }
            curves[i].points.push((phi, *mu));
        }
    }
    curves
}

/// The part of a boundary inside the panel, with the points at which it leaves through the top.
fn shown(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let top = FRICTION.1;
    let mut out = Vec::new();
    for (k, &(phi, mu)) in points.iter().enumerate() {
        if let Some(&(before, other)) = k.checked_sub(1).and_then(|k| points.get(k))
            && (mu > top) != (other > top)
        {
            let part = (top / other).ln() / (mu / other).ln(); // the axis is logarithmic
            out.push((before + part * (phi - before), top));
        }
        if mu <= top {
            out.push((phi, mu));
        }
    }
    out
}

/// The part of the panel above a boundary, shaded by the number of solutions.
fn region(chart: &Chart, b: &Boundary) -> Element {
    let shade = ["#fff", "#e4e4e4", "#cfcfcf", "#a8a8a8"][b.above.min(3)];
    let edge = shown(&b.points);
    let above = |p: Option<&(f64, f64)>| p.map(|p| (p.0, FRICTION.1));
    let corners = above(edge.first())
        .into_iter()
        .chain(edge.iter().copied())
        .chain(above(edge.last()));
    let corners: Vec<String> = corners
        .map(|p| chart.point(p))
        .map(|(x, y)| format!("{},{}", short(x), short(y)))
        .collect();
    Element::new("polygon")
        .with("class", "region")
        .with("data-count", b.above)
        .with("points", corners.join(" "))
        .with("fill", shade)
}

/// The numbers in the regions, at angles where these are wide; each counted there by the closed
/// form.
fn counts(group: &mut Element, chart: &Chart, signs: (i8, i8)) {
    let t = rational(1, 2); // phi = 53.1 degrees
    let data = at(signs, &t, whole(1));
    let mut levels: Vec<f64> = thresholds(&data)
        .unwrap_or_default()
        .iter()
        .map(|s| value(&s.value))
        .collect();
    levels.extend([FRICTION.0, FRICTION.1]);
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    for pair in levels.windows(2) {
        let mu = (pair[0] * pair[1]).sqrt();
        let n = count(&data, mu);
        let (x, y) = chart.point((degrees(&data), mu));
        let label = text(x, y + 5.0, "middle", n.to_string())
            .with("class", "count")
            .with("font-size", "16")
            .with("data-count", n)
            .with("data-mu", mu);
        group.push(
            label
                .with("stroke", "#fff")
                .with("stroke-width", "3")
                .with("paint-order", "stroke"),
        );
    }
}

/// The data at tan(phi / 2) = t.
fn at(signs: (i8, i8), t: &Rational, mu: Rational) -> TwoParticles {
    let square = t * t;
    let below = Rational::one() + &square;
    let (c, s) = ((Rational::one() - square) / &below, whole(2) * t / below);
    TwoParticles {
        c,
        s,
        k: whole(1),
        m: whole(1),
        mu,
        signs,
    }
}

fn count(data: &TwoParticles, mu: f64) -> usize {
    from_f64(mu).map_or(0, |mu| table1(&TwoParticles { mu, ..data.clone() }).len())
}

fn degrees(data: &TwoParticles) -> f64 {
    to_f64(&data.s).atan2(to_f64(&data.c)).to_degrees()
}

/// A number of Q(sqrt d) in doubles, by halving an interval that holds it.
fn value(number: &Quadratic) -> f64 {
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = from_f64(middle).is_ok_and(|m| number.within(&whole(0), &m));
        (low, high) = if below { (low, middle) } else { (middle, high) };
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside each boundary the closed form has another count below than above.
    #[test]
    fn counts_change_at_the_boundaries() {
        for (signs, expected) in [
            ((1, 1), vec![1]),
            ((-1, -1), vec![1]),
            ((1, -1), vec![2, 3]),
            ((-1, 1), vec![]),
        ] {
            let found = boundaries(signs);
            assert_eq!(
                found.iter().map(|b| b.above).collect::<Vec<_>>(),
                expected,
                "{signs:?}"
            );
            for b in &found {
                assert_eq!(b.points.len(), (ANGLES - 1) as usize);
                for (k, (phi, mu)) in b.points.iter().enumerate() {
                    let data = at(signs, &rational(k as i64 + 1, ANGLES), whole(1));
                    assert!((degrees(&data) - phi).abs() < 1e-9);
                    assert_eq!(count(&data, mu * 1.0001), b.above);
                    assert!(count(&data, mu * 0.9999) < b.above);
                }
            }
        }
    }

    /// sqrt(c^2 + 2) / s at phi with c = 3/5: sqrt(59) / 4.
    #[test]
    fn irrational_thresholds_in_doubles() {
        let data = at((1, 1), &rational(1, 2), whole(1));
        assert_eq!((&data.c, &data.s), (&rational(3, 5), &rational(4, 5)));
        let found: Vec<f64> = thresholds(&data)
            .unwrap()
            .iter()
            .map(|s| value(&s.value))
            .collect();
        assert!((found[0] - 59f64.sqrt() / 4.0).abs() < 1e-12, "{found:?}");
    }
}
