//! The loading path: resultants against the motion, and the state of every node on every stretch.
//!
//! Above stands a chart of T, N and mu N against the load, step by step. Below it stands a table of
//! the contact states with a column for each stretch and a row for each candidate. All columns have
//! one width; grey lines tie each to its part of the load. A triangle points where the candidate is
//! about to slip, as in pictures of the body, where the places of the nodes are known; elsewhere to
//! the right along its tangent, and to the left against it. Called by `mceip path`.

use super::body::BodyDrawing;
use super::chart::{Axis, Chart, Rectangle, TEXT, dashed, dot, line, text};
use super::drawing::Picture;
use super::legend::legend;
use super::marker::Mark;
use super::markup::Element;
use super::names::short_names;
use mceip_exact::to_f64;
use mceip_model::{ContactState, Coordinates, Particle};
use mceip_path::{Equilibrium, LoadingPath, Stretch};

const WIDTH: f64 = 860.0;

/// Left and right ends of the chart and of the table.
const LEFT: f64 = 84.0;
const RIGHT: f64 = WIDTH - 30.0;

/// The chart on the paper.
const AREA: Rectangle = Rectangle {
    left: LEFT,
    top: 52.0,
    right: RIGHT,
    bottom: 330.0,
};

/// Left end of the keys above the chart, and the width of each.
const KEYS_LEFT: f64 = LEFT + 20.0;
const KEY_WIDTH: f64 = 160.0;

/// Radius of the dots where stretches begin, px.
const BEGIN_RADIUS: f64 = 3.0;

/// What the axes say: units are those of the file.
const LOAD: &str = "load: the amounts of the steps, one after the other";
const RESULTANTS: &str = "resultants (unit of the forces)";

/// A path with the names that stand in its picture.
pub struct PathDrawing<'a> {
    /// The path.
    pub path: &'a LoadingPath,
    /// The name of each step.
    pub steps: &'a [&'a str],
    /// The candidates; one without a name has its number from 1.
    pub candidates: &'a [Particle],
    /// Where the nodes are, if that is known.
    pub coordinates: Option<&'a Coordinates>,
}

/// Draws a path: above T, N and mu N against the load with a dot at each event and the name of each
/// step; below a column for each stretch, tied to its part of the load, with the mark of each
/// candidate. The load is counted from the beginning of the first stretch, step after step.
pub fn path_picture(title: &str, drawing: &PathDrawing<'_>) -> Picture {
    let path = drawing.path;
    let loads = LoadsBefore::of(path);
    let ends = ends(path, &loads);
    let table = StateTable::of(path);

    let mut picture = Picture::new(title, WIDTH, table.bottom() + 78.0);
    picture.push_heading(LEFT, 24.0);

    let chart = push_resultants(&mut picture, path, &ends);
    drawing.push_steps(&mut picture, &chart, &ends);
    table.push_ties(&mut picture, &chart, &ends);
    picture.push(table.marks(drawing));
    table.push_labels(&mut picture, drawing.candidates);

    let states = path.stretches.iter().flat_map(|i| i.equilibrium_states());
    let mut marks: Vec<Mark> = states.map(|state| Mark::of(*state)).collect();
    if drawing.coordinates.is_some() {
        for mark in &mut marks {
            *mark = mark.turned();
        }
    }
    let word = |mark| match (mark, drawing.coordinates) {
        (Mark::SlipAlong, Some(_)) => "impending slip, the way it points",
        _ => mark.word(),
    };
    picture.push(legend(&marks, LEFT, table.bottom() + 62.0, word));

    picture
}

/// The load before each step, counted from the first step that has a stretch.
struct LoadsBefore {
    before: Vec<f64>,
}

impl LoadsBefore {
    fn of(path: &LoadingPath) -> LoadsBefore {
        let first = path.stretches.first().map_or(0, |stretch| stretch.step);
        let mut before = Vec::with_capacity(path.steps.amounts.len());
        let mut sum = 0.0;
        for (step, amount) in path.steps.amounts.iter().enumerate() {
            before.push(sum);
            if step >= first {
                sum += amount.as_ref().map_or(0.0, to_f64);
            }
        }

        LoadsBefore { before }
    }

    fn at(&self, step: usize, at: &Equilibrium) -> f64 {
        self.before[step] + to_f64(at.amount())
    }
}

/// Loads at which stretches begin, then where the last one ends; one without an end is drawn a
/// tenth of the path long.
fn ends(path: &LoadingPath, loads: &LoadsBefore) -> Vec<f64> {
    let mut ends = Vec::new();
    for stretch in &path.stretches {
        ends.push(loads.at(stretch.step, &stretch.start));
    }

    let last_start = ends.last().copied().unwrap_or(0.0);
    let end = match path.stretches.last() {
        Some(Stretch {
            step,
            stop: Some(stop),
            ..
        }) => loads.at(*step, stop),
        _ => last_start * 1.1,
    };
    ends.push(end);

    ends
}

/// Resultants of the reactions at a load.
struct Resultants {
    load: f64,
    /// Sum of r_T.
    tangential: f64,
    /// Minus the sum of r_N: the force that presses.
    normal: f64,
}

impl Resultants {
    fn of(at: &Equilibrium, load: f64) -> Resultants {
        let (tangential, normal) = at.resultants();
        Resultants {
            load,
            tangential: to_f64(&tangential),
            normal: -to_f64(&normal),
        }
    }
}

/// The resultants where stretches begin, then those where the last one ends.
fn resultants(path: &LoadingPath, ends: &[f64]) -> Vec<Resultants> {
    let mut all = Vec::new();
    for (stretch, load) in path.stretches.iter().zip(ends) {
        all.push(Resultants::of(&stretch.start, *load));
    }

    if let (Some(last), Some(end)) = (path.stretches.last(), ends.last()) {
        all.push(match &last.stop {
            Some(stop) => Resultants::of(stop, *end),
            None => beyond(last, all.last(), *end),
        });
    }

    all
}

/// The resultants of a stretch that never ends, at a load beyond its start: they grow as they do
/// inside.
fn beyond(last: &Stretch, start: Option<&Resultants>, load: f64) -> Resultants {
    let inside = Resultants::of(&last.inside, load);
    let Some(start) = start else { return inside };

    let length = to_f64(&(last.inside.amount() - last.start.amount()));
    let share = (load - start.load) / length;
    Resultants {
        load,
        tangential: start.tangential + share * (inside.tangential - start.tangential),
        normal: start.normal + share * (inside.normal - start.normal),
    }
}

/// One of the curves of the chart.
struct ChartCurve {
    class: &'static str,
    word: &'static str,
    dash: &'static str,
    /// Load and force.
    points: Vec<(f64, f64)>,
}

impl ChartCurve {
    fn all(resultants: &[Resultants], mu: f64) -> [ChartCurve; 3] {
        let mut tangential = Vec::new();
        let mut normal = Vec::new();
        let mut limit = Vec::new();
        for r in resultants {
            tangential.push((r.load, r.tangential));
            normal.push((r.load, r.normal));
            limit.push((r.load, mu * r.normal));
        }

        [
            ChartCurve {
                class: "T",
                word: "T, tangential",
                dash: "",
                points: tangential,
            },
            ChartCurve {
                class: "N",
                word: "N, normal",
                dash: "7 4",
                points: normal,
            },
            ChartCurve {
                class: "mu-N",
                word: "\u{3bc} N",
                dash: "2 3",
                points: limit,
            },
        ]
    }
}

/// Draws the chart of the resultants.
fn push_resultants(picture: &mut Picture, path: &LoadingPath, ends: &[f64]) -> Chart {
    let mu = to_f64(&path.steps.friction);
    let resultants = resultants(path, ends);
    let mut lowest: f64 = 0.0;
    let mut highest: f64 = 0.0;
    for r in &resultants {
        for drawn in [r.tangential, r.normal, mu * r.normal] {
            lowest = lowest.min(drawn);
            highest = highest.max(drawn);
        }
    }
    // The names of the steps stand above the curves.
    let margin = 0.08 * (highest - lowest);

    let x = Axis::linear(LOAD, (0.0, ends.last().copied().unwrap_or(1.0)), 9);
    let y = Axis::linear(RESULTANTS, (lowest, highest + margin), 7);
    let chart = Chart::new(AREA, &x, &y);
    picture.push(chart.frame(&x, &y));

    for (k, curve) in ChartCurve::all(&resultants, mu).iter().enumerate() {
        let drawn = chart.curve(&curve.points, 1.8, curve.dash);
        picture.push(drawn.with("class", format!("curve {}", curve.class)));
        push_key(picture, k, curve);
    }

    let key = (KEYS_LEFT + 3.0 * KEY_WIDTH, AREA.top - 10.0);
    picture.push(
        Element::new("circle")
            .at("cx", key.0)
            .at("cy", key.1)
            .at("r", BEGIN_RADIUS)
            .with("fill", "#fff")
            .with("stroke", "#000"),
    );
    picture.push(text(key.0 + 10.0, key.1 + 4.5, "start", "a stretch begins"));

    let beginnings = resultants.iter().take(path.stretches.len());
    for (k, begin) in beginnings.enumerate() {
        let load = begin.load;
        let t = begin.tangential;
        let tip = format!("stretch {k} begins at {load:.6}, T = {t:.6}");
        let data = (load, t);
        picture.push(dot(chart.point(data), BEGIN_RADIUS, "#fff", data, tip));
    }

    chart
}

impl PathDrawing<'_> {
    /// The direction in which a candidate is about to slip, in degrees clockwise from x; `None` of
    /// other states, and where the places of the nodes are not known.
    fn slip_angle(&self, candidate: usize, state: ContactState) -> Option<f64> {
        let ContactState::Slip { .. } = state else {
            return None;
        };
        let coordinates = self.coordinates?;
        let particle = Particle {
            state,
            ..self.candidates[candidate].clone()
        };
        let body = BodyDrawing {
            coordinates,
            particles: &[],
            mode: None,
            load: None,
        };
        let node = coordinates.node_of(particle.tangential)?;
        Some(body.slip_angle(&particle, node))
    }

    /// A line where each step begins, and its name at the top of its part of the chart, as much of
    /// it as there is room for.
    fn push_steps(&self, picture: &mut Picture, chart: &Chart, ends: &[f64]) {
        let mut first = 0;
        for stretches in self.path.stretches.chunk_by(|a, b| a.step == b.step) {
            let begin = chart.x.place(ends[first]);
            let end = chart.x.place(ends[first + stretches.len()]);
            if first > 0 {
                let between = line((begin, AREA.top), (begin, AREA.bottom), "#666", 0.8);
                picture.push(dashed(between, "3 3"));
            }

            let name = self.steps[stretches[0].step];
            if let Some(name) = shortened(name, end - begin - 8.0) {
                let label = text(begin + 5.0, AREA.top + 14.0, "start", name);
                picture.push(label.with("class", "step").with("font-size", "11"));
            }
            first += stretches.len();
        }
    }
}

/// Width of a letter at font size 11, rather too much.
const LETTER: f64 = 6.5;

/// As much of a name as there is room for; `None` where it is not even three letters.
fn shortened(name: &str, room: f64) -> Option<String> {
    let letters = (room / LETTER).max(0.0) as usize;
    if name.chars().count() <= letters {
        return Some(name.into());
    }
    if letters < 4 {
        return None;
    }

    let kept: String = name.chars().take(letters - 1).collect();
    Some(format!("{kept}\u{2026}"))
}

/// The key of the curve k, in a row above the chart.
fn push_key(picture: &mut Picture, k: usize, curve: &ChartCurve) {
    let x = KEYS_LEFT + KEY_WIDTH * k as f64;
    let y = AREA.top - 10.0;
    let key = line((x, y), (x + 34.0, y), "#000", 1.8);
    picture.push(dashed(key, curve.dash));
    picture.push(text(x + 40.0, y + 4.5, "start", curve.word));
}

/// The table of the states: a column for each stretch, a row for each node.
struct StateTable {
    columns: usize,
    column_width: f64,
    rows: usize,
    row_height: f64,
}

impl StateTable {
    const TOP: f64 = AREA.bottom + 100.0;
    /// Right of the heading of the rows.
    const HEADING: f64 = 30.0;

    fn of(path: &LoadingPath) -> StateTable {
        let rows = path
            .stretches
            .first()
            .map_or(0, |i| i.equilibrium_states().len());
        let columns = path.stretches.len().max(1);

        StateTable {
            columns,
            column_width: (RIGHT - LEFT) / columns as f64,
            rows,
            row_height: (330.0 / rows.max(1) as f64).clamp(4.0, 17.0),
        }
    }

    fn height(&self) -> f64 {
        self.row_height * self.rows as f64
    }

    fn bottom(&self) -> f64 {
        StateTable::TOP + self.height()
    }

    /// Left end of a column.
    fn left_of(&self, column: usize) -> f64 {
        LEFT + self.column_width * column as f64
    }

    /// Lines between the columns, each tied to its load on the chart.
    fn push_ties(&self, picture: &mut Picture, chart: &Chart, ends: &[f64]) {
        for (k, load) in ends.iter().enumerate().take(self.columns + 1) {
            let below_chart = (chart.x.place(*load), AREA.bottom + 50.0);
            let top = (self.left_of(k), StateTable::TOP);
            let bottom = (self.left_of(k), self.bottom());
            picture.push(line(below_chart, top, "#999", 0.5));
            picture.push(line(top, bottom, "#ccc", 0.5));
        }
    }

    fn marks(&self, drawing: &PathDrawing<'_>) -> Element {
        let radius = 0.42 * self.row_height.min(self.column_width);
        let mut marks = Element::new("g").with("class", "marks");

        for (column, stretch) in drawing.path.stretches.iter().enumerate() {
            let x = self.left_of(column) + self.column_width / 2.0;
            for (node, state) in stretch.equilibrium_states().iter().enumerate() {
                let y = StateTable::TOP + self.row_height * (node as f64 + 0.5);
                let mark = Mark::of(*state);
                marks.push(match drawing.slip_angle(node, *state) {
                    Some(degrees) => mark.turned().draw(x, y, radius).turned(degrees, (x, y)),
                    None => mark.draw(x, y, radius),
                });
            }
        }

        marks
    }

    /// Names or numbers of candidates at the left and numbers of stretches below, as many as there
    /// is room for.
    fn push_labels(&self, picture: &mut Picture, candidates: &[Particle]) {
        let mut names = Vec::with_capacity(self.rows);
        for (node, candidate) in candidates.iter().enumerate() {
            names.push(candidate.name_or(node + 1));
        }
        let letters = (LEFT - 8.0 - StateTable::HEADING) / LETTER;
        let names = short_names(&names, letters as usize);
        for node in (0..self.rows).step_by(every(13.0, self.row_height)) {
            let y = StateTable::TOP + self.row_height * (node as f64 + 0.5) + 4.0;
            let label = text(LEFT - 8.0, y, "end", &names[node]);
            picture.push(label.with("class", "candidate").with("font-size", "11"));
        }

        for column in (0..self.columns).step_by(every(20.0, self.column_width)) {
            let x = LEFT + self.column_width * (column as f64 + 0.5);
            let number = text(x, self.bottom() + 14.0, "middle", column.to_string());
            picture.push(number.with("font-size", "11"));
        }

        let x = StateTable::HEADING - 4.0;
        let y = StateTable::TOP + self.height() / 2.0;
        let turn = format!("rotate(-90 {x} {y})");
        let nodes = text(x, y, "middle", "node");
        picture.push(nodes.with("transform", turn));

        let middle = (LEFT + RIGHT) / 2.0;
        let y = self.bottom() + 18.0 + TEXT;
        picture.push(text(middle, y, "middle", "stretch of the path"));
    }
}

/// Of labels that need `room` at places `distance` apart, every how many there is room for.
fn every(room: f64, distance: f64) -> usize {
    (room / distance).ceil().max(1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::{LETTER, shortened};

    #[test]
    fn a_name_is_shortened_to_its_room_or_left_out() {
        let in_letters = |name, letters: f64| shortened(name, letters * LETTER);
        assert_eq!(in_letters("push", 4.0).as_deref(), Some("push"));
        assert_eq!(
            in_letters("press down", 6.9).as_deref(),
            Some("press\u{2026}")
        );
        assert_eq!(
            in_letters("dr\u{fc}ckt", 4.0).as_deref(),
            Some("dr\u{fc}\u{2026}")
        );
        assert_eq!(in_letters("press", 3.0), None);
        assert_eq!(in_letters("press", -2.0), None);
    }
}
