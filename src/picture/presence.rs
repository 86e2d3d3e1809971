//! Divergence and stability against mu: where they are proved, and where they were only sampled.
//!
//! Input: ranges of mu with a verdict each, the sampled values of mu, and the values that a reader
//! looks for. Boxes above the axis show the ranges: verdicts differ in shade and hatching, a full
//! outline is a proof, a dashed one joins samples or stands about what is undecided, and without a
//! box nothing was examined. A bar above them holds the critical mu of every body within the radii
//! of the data. Called by `mceip analyze` and `mceip path`.

use super::chart::{Axis, Chart, Rectangle, TEXT, dashed, line, text};
use super::drawing::Picture;
use super::markup::{Element, point_list};
use super::scale::{Extent, label};

/// What is known of divergence at some mu.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// There is none, and the equilibrium is stable.
    Stable,
    /// There is none.
    Absent,
    /// There is a diverging solution.
    Present,
    /// Neither was proved.
    Undecided,
    /// There is no equilibrium to ask: the loading path ends before.
    NoPath,
}

/// An interval of mu with one verdict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PresenceRange {
    /// The verdict.
    pub presence: Presence,
    /// Lower end.
    pub from: f64,
    /// Does the verdict hold at the lower end?
    pub is_from_included: bool,
    /// Upper end; `None` for infinity.
    pub to: Option<f64>,
    /// Does it hold everywhere between the ends? If not, only at the samples in it.
    pub is_proved: bool,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct PresenceChart {
    /// Ranges that do not overlap.
    pub ranges: Vec<PresenceRange>,
    /// Sampled values of mu with their verdicts.
    pub samples: Vec<(f64, Presence)>,
    /// mu that was asked for.
    pub friction: f64,
    /// The smallest mu with a certified solution, or the first that is critical.
    pub critical: Option<f64>,
    /// What these two are called.
    pub words: [&'static str; 2],
    /// Bounds of the critical mu of every body within the radii of the data.
    pub members: Option<[f64; 2]>,
}

const WIDTH: f64 = 760.0;

/// The band of ranges and its axis.
const AREA: Rectangle = Rectangle {
    left: 40.0,
    top: 122.0,
    right: WIDTH - 40.0,
    bottom: 162.0,
};

/// Dashes of the outline of a sampled range.
const SAMPLED_DASH: &str = "4 3";

/// Distance of the strokes of a hatched range, px.
const HATCH: f64 = 7.0;

/// Radius of the dots of samples, px.
const SAMPLE_RADIUS: f64 = 3.5;

/// Width of the signs of keys, px.
const SIGN: f64 = 22.0;

/// Mean width of a letter, as a part of the height of the text.
const LETTER: f64 = 0.6;

/// Height of the bar of members, px.
const MEMBERS: f64 = AREA.top - 20.0;

/// Left end of the key of samples where the key of members stands before it, px.
const BESIDE_MEMBERS: f64 = AREA.left + 590.0;

/// Half the width of the pointers above the band, px.
const POINTER: f64 = 5.0;

impl Presence {
    const ALL: [Presence; 5] = [
        Presence::Stable,
        Presence::Absent,
        Presence::Present,
        Presence::Undecided,
        Presence::NoPath,
    ];

    /// The words of the keys.
    fn word(self) -> &'static str {
        match self {
            Presence::Stable => "stable",
            Presence::Absent => "no divergence",
            Presence::Present => "divergence",
            Presence::Undecided => "undecided",
            Presence::NoPath => "no path",
        }
    }

    fn class(self) -> &'static str {
        match self {
            Presence::Stable => "stable",
            Presence::Absent => "absent",
            Presence::Present => "present",
            Presence::Undecided => "undecided",
            Presence::NoPath => "no-path",
        }
    }

    fn fill(self) -> &'static str {
        match self {
            Presence::Stable | Presence::Absent | Presence::Undecided => "#fff",
            Presence::Present => "#b0b0b0",
            Presence::NoPath => "#505050",
        }
    }
}

impl PresenceChart {
    /// From 0 to the largest mu that is drawn, and a little beyond.
    fn axis(&self) -> Axis<'static> {
        let mut values = vec![self.friction];
        values.extend(self.critical);
        values.extend(self.samples.iter().map(|(mu, _)| *mu));
        for range in &self.ranges {
            values.push(range.from);
            values.extend(range.to);
        }
        values.extend(self.members.into_iter().flatten());

        let Extent { high, .. } = Extent::of(values.into_iter());
        Axis::linear("coefficient of friction \u{3bc}", (0.0, high * 1.04), 8)
    }
}

/// Draws the ranges.
pub fn presence_picture(title: &str, presence: &PresenceChart) -> Picture {
    let x = presence.axis();
    let y = Axis::linear("", (0.0, 1.0), 0);
    let chart = Chart::new(AREA, &x, &y);

    let mut picture = Picture::new(title, WIDTH, AREA.bottom + 62.0);
    picture.push_heading(AREA.left, 24.0);
    picture.push(chart.x_axis(&x));

    for range in &presence.ranges {
        picture.push(band(&chart, range));
    }
    for (mu, verdict) in &presence.samples {
        picture.push(sample_mark(&chart, *mu, *verdict));
    }

    let own = pointer(&chart, presence.friction, "#fff");
    picture.push(own.with("class", "friction"));
    if let Some(mu) = presence.critical {
        picture.push(pointer(&chart, mu, "#000").with("class", "critical"));
    }
    if let Some(ends) = presence.members {
        picture.push(members_bar(ends.map(|mu| chart.x.place(mu)), MEMBERS));
    }

    push_keys(&mut picture, presence);
    picture
}

/// A range: a rectangle over the height of the band.
fn band(chart: &Chart, range: &PresenceRange) -> Element {
    let left = chart.x.place(range.from);
    let right = chart.x.place(range.to.unwrap_or(f64::INFINITY));
    let area = Rectangle {
        left,
        right,
        ..AREA
    };

    let standing = if range.is_proved { "proved" } else { "sampled" };
    let to = range.to.map_or_else(|| "infinity".into(), label);
    let begin = if range.is_from_included {
        "from"
    } else {
        "above"
    };
    let word = range.presence.word();
    let words = match range.presence {
        Presence::Undecided => word.to_owned(),
        _ => format!("{word}, {standing}"),
    };
    let tip = format!("mu {begin} {} to {to}: {words}", label(range.from));

    shaded(area, range.presence, range.is_proved)
        .with(
            "class",
            format!("range {} {standing}", range.presence.class()),
        )
        .with("data-from", range.from)
        .child(Element::new("title").text(tip))
}

/// A rectangle in the shade of a verdict, with the outline of a proof or of samples.
fn shaded(area: Rectangle, presence: Presence, is_proved: bool) -> Element {
    let outline = Element::new("rect")
        .at("x", area.left)
        .at("y", area.top)
        .at("width", area.right - area.left)
        .at("height", area.bottom - area.top)
        .with("fill", presence.fill())
        .with("stroke", "#000")
        .with("stroke-width", if is_proved { "1.6" } else { "1" });

    let mut group = Element::new("g").child(dashed(outline, outline_dash(is_proved)));
    if presence == Presence::Stable {
        let mut y = area.top + 0.5 * HATCH;
        while y < area.bottom {
            group.push(line((area.left, y), (area.right, y), "#777", 0.8));
            y += HATCH;
        }
    }
    if presence == Presence::Undecided {
        let mut x = area.left + HATCH;
        while x < area.right {
            group.push(line((x, area.top), (x, area.bottom), "#777", 0.8));
            x += HATCH;
        }
    }

    group
}

/// Dashes of an outline, empty for a full line.
fn outline_dash(is_proved: bool) -> &'static str {
    if is_proved { "" } else { SAMPLED_DASH }
}

/// A sample: a dot on the axis in the shade of its verdict.
fn sample_mark(chart: &Chart, mu: f64, verdict: Presence) -> Element {
    let tip = format!("mu = {}: {}", label(mu), verdict.word());
    sample_dot((chart.x.place(mu), AREA.bottom), verdict.fill())
        .with("class", "sample")
        .with("data-mu", mu)
        .child(Element::new("title").text(tip))
}

fn sample_dot((x, y): (f64, f64), fill: &'static str) -> Element {
    Element::new("circle")
        .at("cx", x)
        .at("cy", y)
        .at("r", SAMPLE_RADIUS)
        .with("fill", fill)
        .with("stroke", "#000")
}

/// A pointer from above to a value of mu.
fn pointer(chart: &Chart, mu: f64, fill: &'static str) -> Element {
    let tip = format!("mu = {}", label(mu));
    triangle(chart.x.place(mu), AREA.top - 2.0, fill)
        .with("data-mu", mu)
        .child(Element::new("title").text(tip))
}

/// A bar between two places, with a stroke at each end.
fn members_bar([left, right]: [f64; 2], y: f64) -> Element {
    let mut bar = Element::new("g").with("class", "members");
    bar.push(line((left, y), (right, y), "#000", 2.4));
    for x in [left, right] {
        bar.push(line((x, y - POINTER), (x, y + POINTER), "#000", 1.6));
    }

    bar
}

/// A triangle that points down to (x, y).
fn triangle(x: f64, y: f64, fill: &'static str) -> Element {
    let upper = y - 2.0 * POINTER;
    let corners = [(x, y), (x - POINTER, upper), (x + POINTER, upper)];
    Element::new("polygon")
        .with("points", point_list(&corners))
        .with("fill", fill)
        .with("stroke", "#000")
}

/// What each sign means: shades and outlines in one row, the values of mu in the next.
fn push_keys(picture: &mut Picture, presence: &PresenceChart) {
    let baseline = 48.0;
    let mut left = AREA.left;
    for verdict in Presence::ALL {
        let occurs = presence.ranges.iter().any(|r| r.presence == verdict);
        if occurs {
            let area = Rectangle {
                left,
                top: baseline - 11.0,
                right: left + SIGN,
                bottom: baseline,
            };
            picture.push(shaded(area, verdict, true));
            push_key_word(picture, verdict.word(), baseline, &mut left);
        }
    }

    for (is_proved, words) in [(true, "proved"), (false, "at samples only")] {
        let is_it =
            |r: &PresenceRange| r.is_proved == is_proved && r.presence != Presence::Undecided;
        let occurs = presence.ranges.iter().any(is_it);
        if occurs {
            let middle = baseline - 4.5;
            let sign = line((left, middle), (left + SIGN, middle), "#000", 1.6);
            picture.push(dashed(sign, outline_dash(is_proved)));
            push_key_word(picture, words, baseline, &mut left);
        }
    }

    let baseline = baseline + TEXT + 9.0;
    let [friction, critical] = presence.words;
    let own = format!("{friction}: {}", label(presence.friction));
    picture.push(triangle(AREA.left + POINTER, baseline, "#fff"));
    picture.push(text(AREA.left + 16.0, baseline, "start", own));

    if let Some(mu) = presence.critical {
        let words = format!("{critical}: {}", label(mu));
        picture.push(triangle(AREA.left + 290.0, baseline, "#000"));
        picture.push(text(AREA.left + 302.0, baseline, "start", words));
    }
    let baseline = baseline + TEXT + 3.0;
    if !presence.samples.is_empty() {
        let left = match presence.members {
            Some(_) => BESIDE_MEMBERS,
            None => AREA.left,
        };
        let sign = (left + SAMPLE_RADIUS, baseline - 4.5);
        picture.push(sample_dot(sign, "#fff"));
        picture.push(text(left + 16.0, baseline, "start", "\u{3bc} examined"));
    }
    if let Some([lo, hi]) = presence.members {
        let of = "critical \u{3bc} of every body within the radii of the data";
        let words = format!("{of}: {} to {}", label(lo), label(hi));
        let sign = [AREA.left, AREA.left + SIGN];
        picture.push(members_bar(sign, baseline - 4.5));
        picture.push(text(AREA.left + SIGN + 6.0, baseline, "start", words));
    }
}

/// The words behind a sign; `left` moves on to the next one.
fn push_key_word(picture: &mut Picture, words: &str, baseline: f64, left: &mut f64) {
    picture.push(text(*left + SIGN + 6.0, baseline, "start", words));
    let letters = words.chars().count() as f64;
    *left += SIGN + 6.0 + LETTER * TEXT * letters + 14.0;
}
