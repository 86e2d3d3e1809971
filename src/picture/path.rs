//! The loading path: resultants against the motion, and the state of every node on every stretch.

use super::chart::{Axis, Chart, TEXT, dot, line, text};
use super::drawing::Picture;
use super::legend::legend;
use super::marker::Mark;
use super::markup::Element;
use super::scale::Spread;
use mceip_exact::to_f64;
use mceip_paper::path::LoadingPath;

const WIDTH: f64 = 860.0;
/// Left and right ends of both charts.
const SIDES: (f64, f64) = (84.0, WIDTH - 30.0);

/// Draws a path: above T, N and mu N against the motion with a dot at each event; below a column
/// for each stretch, tied to its part of the motion, with the mark of each node.
pub fn path_picture(title: &str, path: &LoadingPath) -> Picture {
    let ends: Vec<f64> = ends(path);
    let last = ends.last().copied().unwrap_or(1.0);
    let nodes = path.intervals.first().map_or(0, |i| i.states.len());
    let columns = path.intervals.len().max(1);
    let row = (330.0 / nodes.max(1) as f64).clamp(4.0, 17.0);
    let (top, middle) = (52.0, 330.0);
    let (table_top, height) = (middle + 100.0, row * nodes as f64);

    let mut picture = Picture::new(title, WIDTH, table_top + height + 78.0);
    picture.push(text(SIDES.0, 24.0, "start", title).with("font-weight", "bold"));
    let chart = resultants(&mut picture, path, &ends, last, (top, middle));
    let width = (SIDES.1 - SIDES.0) / columns as f64;
    let column = |k: usize| SIDES.0 + width * k as f64;
    for (k, at) in ends.iter().enumerate().take(columns + 1) {
        let (x, y) = (chart.x.place(*at), middle + 50.0);
        picture.push(line((x, y), (column(k), table_top), "#999", 0.5));
        picture.push(line(
            (column(k), table_top),
            (column(k), table_top + height),
            "#ccc",
            0.5,
        ));
    }
    let mut marks = Element::new("g").with("class", "marks");
    for (k, interval) in path.intervals.iter().enumerate() {
        for (node, state) in interval.states.iter().enumerate() {
            let (x, y) = (
                column(k) + width / 2.0,
                table_top + row * (node as f64 + 0.5),
            );
            marks.push(Mark::of(*state).draw(x, y, 0.42 * row.min(width)));
        }
    }
    picture.push(marks);
    labels(
        &mut picture,
        (nodes, row),
        (columns, width),
        table_top,
        height,
    );
    let all: Vec<Mark> = path
        .intervals
        .iter()
        .flat_map(|i| i.states.iter().map(|s| Mark::of(*s)))
        .collect();
    picture.push(legend(&all, SIDES.0, table_top + height + 62.0));
    picture
}

/// Motions at which stretches begin, then where the last one ends; one without an end is drawn a
/// tenth of the path long.
fn ends(path: &LoadingPath) -> Vec<f64> {
    let mut ends: Vec<f64> = path
        .intervals
        .iter()
        .map(|i| to_f64(i.start.motion()))
        .collect();
    let stop = path
        .intervals
        .last()
        .and_then(|i| i.stop.as_ref())
        .map(|s| to_f64(s.motion()));
    let begin = ends.last().copied().unwrap_or(0.0);
    ends.push(stop.unwrap_or(begin * 1.1));
    ends
}

fn resultants(
    picture: &mut Picture,
    path: &LoadingPath,
    ends: &[f64],
    last: f64,
    (top, bottom): (f64, f64),
) -> Chart {
    let mu = to_f64(&path.loading.friction);
    let mut points: Vec<(f64, f64, f64)> = Vec::new();
    for interval in &path.intervals {
        let (t, n) = interval.start.resultants();
        points.push((to_f64(interval.start.motion()), to_f64(&t), -to_f64(&n)));
    }
    let finish = path
        .intervals
        .last()
        .map(|i| i.stop.as_ref().unwrap_or(&i.start).resultants());
    if let (Some((t, n)), Some(end)) = (finish, ends.last()) {
        points.push((*end, to_f64(&t), -to_f64(&n)));
    }
    let highest = points
        .iter()
        .flat_map(|p| [p.1.abs(), p.2, mu * p.2])
        .fold(0.0, f64::max);
    let x = Axis {
        label: "motion of CD to the left (mm)",
        spread: Spread::Linear,
        values: (0.0, last),
        ticks: 9,
    };
    let y = Axis {
        label: "resultants (N)",
        spread: Spread::Linear,
        values: (0.0, 1.08 * highest),
        ticks: 7,
    };
    let chart = Chart::new([SIDES.0, top, SIDES.1, bottom], &x, &y);
    picture.push(chart.frame(&x, &y));
    let curve = |f: &dyn Fn(&(f64, f64, f64)) -> f64| -> Vec<(f64, f64)> {
        points.iter().map(|p| (p.0, f(p))).collect()
    };
    let curves = [
        ("T", "T, tangential", "", curve(&|p| p.1)),
        ("N", "N, normal", "7 4", curve(&|p| p.2)),
        ("mu-N", "\u{3bc} N", "2 3", curve(&|p| mu * p.2)),
    ];
    for (k, (class, word, dash, points)) in curves.iter().enumerate() {
        picture.push(
            chart
                .curve(points, 1.8, dash)
                .with("class", format!("curve {class}")),
        );
        let (x, y) = (SIDES.0 + 20.0 + 160.0 * k as f64, top - 10.0);
        let key = line((x, y), (x + 34.0, y), "#000", 1.8);
        picture.push(if dash.is_empty() {
            key
        } else {
            key.with("stroke-dasharray", *dash)
        });
        picture.push(text(x + 40.0, y + 4.5, "start", *word));
    }
    for (k, (at, t, _)) in points.iter().enumerate().take(path.intervals.len()) {
        let tip = format!("stretch {k} begins at {at:.6} mm, T = {t:.6} N");
        picture.push(dot(chart.point((*at, *t)), 3.0, "#fff", (*at, *t), tip));
    }
    chart
}

fn labels(
    picture: &mut Picture,
    (nodes, row): (usize, f64),
    (columns, width): (usize, f64),
    top: f64,
    height: f64,
) {
    let every = |size: f64, room: f64| (room / size).ceil().max(1.0) as usize;
    for node in (0..nodes).filter(|n| n.is_multiple_of(every(row, 13.0))) {
        let y = top + row * (node as f64 + 0.5) + 4.0;
        picture.push(text(SIDES.0 - 8.0, y, "end", (node + 1).to_string()).with("font-size", "11"));
    }
    for k in (0..columns).filter(|k| k.is_multiple_of(every(width, 20.0))) {
        let x = SIDES.0 + width * (k as f64 + 0.5);
        picture.push(text(x, top + height + 14.0, "middle", k.to_string()).with("font-size", "11"));
    }
    let (x, y) = (SIDES.0 - 44.0, top + height / 2.0);
    let turned = text(x, y, "middle", "node, from the left")
        .with("transform", format!("rotate(-90 {x} {y})"));
    picture.push(turned);
    picture.push(text(
        (SIDES.0 + SIDES.1) / 2.0,
        top + height + 18.0 + TEXT,
        "middle",
        "stretch of the path",
    ));
}
