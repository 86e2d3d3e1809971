//! `mceip analyze --report`: the answers, their evidence and the modes on one page.

use crate::cli::common::CliError;
use crate::cli::pictures::{
    LEVELS_CAPTION, Named, keep_below, levels_of, presence_of, warnings_of,
};
use crate::picture::{
    BodyDrawing, BodyMode, Branches, ChartPoint, Content, Presence, PresenceChart, PresenceRange,
    ReportPage, Section, branch_picture, presence_picture,
};
use mceip_engine::analysis::{Analysis, Evidence, Members, Mode, ProofFile, Verdict};
use mceip_engine::run::Watch;
use mceip_exact::to_f64;
use mceip_model::{Coordinates, System};
use std::time::{SystemTime, UNIX_EPOCH};

/// What the page shows beside the answers.
pub(super) struct Drawn<'a> {
    /// The system that was analysed.
    pub(super) system: &'a System,
    /// Where its nodes are, if the problem file says so.
    pub(super) coordinates: Option<&'a Coordinates>,
    /// lambda against mu, where that was looked at.
    pub(super) branches: Option<Branches>,
    /// The files of the certificates.
    pub(super) files: &'a [ProofFile],
    /// When the page is made.
    pub(super) date: SystemTime,
}

impl Drawn<'_> {
    /// The body, with a mode or as it is at equilibrium; nothing without coordinates.
    fn body(&self, name: String, title: &str, mode: Option<&Mode>) -> Option<Named> {
        let drawing = BodyDrawing {
            coordinates: self.coordinates?,
            particles: self.system.particles(),
            mode: mode.map(|mode| BodyMode {
                v: &mode.v,
                slipping: &mode.slipping,
            }),
            load: None,
        };

        let caption = match mode {
            None => "The body and the states of its particles, as the problem file gives them.",
            Some(_) => {
                "The direction in which the body departs; displacements have one scale. The \
                 obstacle stands where the body is at rest."
            }
        };
        Some(Named::body(name, title, &drawing, caption))
    }

    /// The body at equilibrium.
    fn at_rest(&self) -> Option<Named> {
        self.body("body".into(), "The body", None)
    }

    /// The k-th mode, from 0.
    fn mode(&self, k: usize, mode: &Mode) -> Option<Named> {
        let number = k + 1;
        let how = if mode.growth_rate > 0.0 {
            let rate = with_digits(mode.growth_rate, 7);
            format!("grows with {rate} 1/s, without oscillation")
        } else {
            "lambda = 0, grows evenly in time".into()
        };
        let title = format!("Mode {number}: {how}");
        self.body(format!("mode-{number:02}"), &title, Some(mode))
    }

    fn branch_chart(&self) -> Option<Named> {
        let branches = self.branches.as_ref()?;
        let picture = branch_picture("Growth rate \u{3bb} against \u{3bc}", branches);
        let caption = format!(
            "{LEVELS_CAPTION} The squares are certified. Where a curve turns back, two motions \
             grow at the same \u{3bc}."
        );
        Some(Named::chart("lambda", picture, caption))
    }

    /// Every picture of the page.
    pub(super) fn pictures(&self, analysis: &Analysis) -> Vec<Named> {
        let mut all = Vec::from_iter(self.at_rest());
        all.push(presence_chart(analysis));
        all.extend(self.branch_chart());
        for (k, mode) in analysis.divergence.modes.iter().enumerate() {
            all.extend(self.mode(k, mode));
        }

        all
    }
}

/// The page.
pub(super) fn page(analysis: &Analysis, drawn: &Drawn<'_>) -> String {
    let name = analysis.name.as_deref().unwrap_or("mechanical system");
    let report = ReportPage {
        title: format!("Divergence of {name}"),
        sections: vec![
            system(analysis, drawn),
            answers(analysis, drawn),
            modes(analysis, drawn),
            proofs(analysis, drawn),
        ],
    };

    report.to_html()
}

/// The sizes of the system, and its picture.
fn system(analysis: &Analysis, drawn: &Drawn<'_>) -> Section {
    let [dofs, free, slip, stick] = analysis.sizes;
    let mut rows = vec![
        row(["degrees of freedom", &dofs.to_string()]),
        row(["of them free", &free.to_string()]),
        row(["particles in impending slip", &slip.to_string()]),
        row(["particles that stick", &stick.to_string()]),
        row([
            "coefficient of friction asked for",
            &analysis.friction_text(),
        ]),
    ];
    if analysis.zero > 0 {
        let count = analysis.zero.to_string();
        rows.insert(4, row(["particles with zero reaction", &count]));
    }

    let table = Content::Table {
        caption: "The system, in the units of its file".into(),
        header: Vec::new(),
        rows,
    };

    let mut content = vec![table];
    content.extend(warnings_of(&analysis.warnings));
    content.extend(drawn.at_rest().map(Named::into_figure));

    Section {
        title: "System".into(),
        content,
    }
}

/// Every sentence with what stands behind it; what is only measured is said to be so.
fn answers(analysis: &Analysis, drawn: &Drawn<'_>) -> Section {
    let mut content = vec![Content::Paragraph(analysis.summary())];
    if analysis.interrupted {
        let warning = "Interrupted: what was not done is undecided.";
        content.push(Content::Warning(warning.into()));
    }

    let mut rows = Vec::new();
    for sentence in analysis.sentences() {
        let standing = match &sentence.evidence {
            Evidence::Certificate(_) => "proved",
            Evidence::Exact(_) => "exact",
            Evidence::Measured(_) => "measured",
        };

        let evidence = analysis.evidence_text(&sentence.evidence, drawn.files);
        rows.push(row([standing, &sentence.text, &evidence]));
    }

    content.push(Content::Table {
        caption: "Answers; \"stable\" is never one of them".into(),
        header: row(["standing", "answer", "evidence"]),
        rows,
    });
    content.push(presence_chart(analysis).into_figure());
    content.extend(drawn.branch_chart().map(Named::into_figure));

    Section {
        title: "Answers".into(),
        content,
    }
}

fn presence_chart(analysis: &Analysis) -> Named {
    let title = "Divergence against the coefficient of friction";
    let picture = presence_picture(title, &presence(analysis));
    let caption = "Where in \u{3bc} divergence of the form (8) exists, and where the equilibrium \
                   is proved to be stable, with these contact states. Dots are single values, each \
                   decided by a complete search; in a dashed box nothing is proved between them. \
                   Where there is no box, nothing was examined.";
    Named::chart("presence", picture, caption)
}

/// Particles in impending slip up to which lambda is drawn against mu: each level is a complete
/// search.
const MOST_SLIP: usize = 25;

/// lambda against mu; `None` for systems that are too large, or have particles with zero reaction.
pub(super) fn branches(
    analysis: &Analysis,
    system: &System,
    watch: &Watch<'_>,
) -> Result<Option<Branches>, CliError> {
    let [_, _, slip, _] = analysis.sizes;
    if analysis.zero > 0 || slip == 0 || slip > MOST_SLIP || system.mass().is_none() {
        return Ok(None);
    }

    let modes = analysis.divergence.modes.iter();
    let certified = modes.map(|mode| ChartPoint {
        mu: to_f64(&analysis.friction),
        lambda2: to_f64(&mode.lambda2.mid()),
        support: mode.slipping.clone(),
    });
    let critical = analysis.critical.solution.as_ref();
    let known = critical.map_or(0.0, |solution| to_f64(solution.mu.hi()));
    let top = 2.0 * known.max(to_f64(&analysis.friction));
    let mut levels = levels_of(system, watch)?;
    keep_below(&mut levels, top);

    let branches = Branches {
        levels,
        certified: certified.collect(),
        absent_below: analysis.critical.absent_below.as_ref().map(to_f64),
    };

    let has_points = branches.levels.iter().any(|level| !level.is_empty());
    Ok((has_points && !watch.is_cancelled()).then_some(branches))
}

/// The ranges of mu, the mu asked for and the samples, and the smallest mu with a certified
/// solution, in doubles.
fn presence(analysis: &Analysis) -> PresenceChart {
    let stable = analysis
        .stability
        .as_ref()
        .map(|stability| to_f64(&stability.to));
    let mut ranges = Vec::new();
    ranges.extend(stable.map(|to| PresenceRange {
        presence: Presence::Stable,
        from: 0.0,
        is_from_included: false,
        to: Some(to),
        is_proved: true,
    }));
    for range in &analysis.ranges {
        let from = to_f64(&range.from).max(stable.unwrap_or(0.0));
        ranges.push(PresenceRange {
            presence: presence_of(range.verdict),
            from,
            is_from_included: from > 0.0 || analysis.is_from_included(range),
            to: range.to.as_ref().map(to_f64),
            is_proved: !range.evidence.is_measured(),
        });
    }
    ranges.retain(|range| {
        range
            .to
            .is_none_or(|to| to > range.from || stable.is_none())
    });
    let ranges = with_gaps(ranges);

    let own = presence_of(analysis.divergence.verdict);
    let mut samples = vec![(to_f64(&analysis.friction), own)];
    for sample in &analysis.samples {
        samples.push((to_f64(&sample.mu), presence_of(sample.verdict)));
    }

    let solution = analysis.critical.solution.as_ref();
    PresenceChart {
        ranges,
        samples,
        friction: to_f64(&analysis.friction),
        critical: solution.map(|solution| to_f64(solution.mu.hi())),
        words: [
            "\u{3bc} asked for",
            "smallest \u{3bc} with a certified solution",
        ],
        members: analysis.members.as_ref().and_then(critical_of_members),
    }
}

/// A gap between ranges that is seen, as a share of where it ends.
const SEEN: f64 = 0.005;

/// The ranges, ascending, and between them what is not decided, where that is seen.
fn with_gaps(mut ranges: Vec<PresenceRange>) -> Vec<PresenceRange> {
    ranges.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut all: Vec<PresenceRange> = Vec::with_capacity(2 * ranges.len());
    for range in ranges {
        let end = all.last().and_then(|last| last.to);
        if let Some(end) = end.filter(|end| range.from - end > SEEN * range.from) {
            all.push(PresenceRange {
                presence: Presence::Undecided,
                from: end,
                is_from_included: false,
                to: Some(range.from),
                is_proved: false,
            });
        }
        all.push(range);
    }

    all
}

/// The proved bounds of the critical mu of every member, where there are two.
fn critical_of_members(members: &Members) -> Option<[f64; 2]> {
    let (below, _) = members.absent_below.as_ref()?;
    let ([from, _], _) = members.present.as_ref()?;
    Some([to_f64(below), to_f64(from)])
}

/// The diverging modes: a table of all of them, then the components of each.
fn modes(analysis: &Analysis, drawn: &Drawn<'_>) -> Section {
    let modes = &analysis.divergence.modes;
    let mut content = Vec::new();
    if modes.is_empty() {
        let none = match analysis.divergence.verdict {
            Verdict::Present => "No single mode: what is present is said above.",
            Verdict::Absent | Verdict::Undecided => "None was found at this friction.",
        };
        content.push(Content::Paragraph(none.into()));
    } else {
        content.push(summary(analysis));
    }

    for (k, mode) in modes.iter().enumerate() {
        content.extend(drawn.mode(k, mode).map(Named::into_figure));
        content.push(shape(k + 1, mode));
    }

    Section {
        title: "Modes".into(),
        content,
    }
}

fn summary(analysis: &Analysis) -> Content {
    let modes = &analysis.divergence.modes;
    let header = [
        "mode",
        "lambda^2 (1/s^2)",
        "lambda (1/s)",
        "slipping particles",
        "particles at rest",
        "particles with zero reaction",
    ];
    let has_zero = modes.iter().any(|mode| !mode.zero.is_empty());
    let columns = if has_zero { 6 } else { 5 };
    let mut rows = Vec::new();
    for (k, mode) in modes.iter().enumerate() {
        let lambda2 = to_f64(&mode.lambda2.mid());
        let mut cells = vec![
            (k + 1).to_string(),
            with_digits(lambda2, 11),
            with_digits(mode.growth_rate, 7),
            analysis.named(&mode.slipping),
            analysis.named(&mode.sticking),
        ];
        if has_zero {
            cells.push(zero_modes(mode, &analysis.particles));
        }
        rows.push(cells);
    }

    Content::Table {
        caption: "Diverging modes".into(),
        header: header[..columns].iter().map(ToString::to_string).collect(),
        rows,
    }
}

/// The number and the mode of each particle with zero reaction, such as "3 open, 4 right".
fn zero_modes(mode: &Mode, particles: &[String]) -> String {
    let mut words = Vec::new();
    for (particle, what) in &mode.zero {
        words.push(format!("{} {}", particles[*particle], what.word()));
    }

    words.join(", ")
}

/// The components of a mode that are not zero.
fn shape(number: usize, mode: &Mode) -> Content {
    let mut rows = Vec::new();
    for (dof, v) in mode.v.iter().enumerate() {
        if *v != 0.0 {
            rows.push(vec![dof.to_string(), format!("{v:.9}")]);
        }
    }

    Content::Table {
        caption: format!(
            "Mode {number}: v over the degrees of freedom that move; the slip rates sum to one"
        ),
        header: row(["dof", "v"]),
        rows,
    }
}

/// A number with this many digits, without a power of ten where it can do without.
fn with_digits(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".into();
    }

    let exponent = value.abs().log10().floor() as i32;
    if (-4..digits).contains(&exponent) {
        let decimals = (digits - 1 - exponent) as usize;
        format!("{value:.decimals$}")
    } else {
        let decimals = (digits - 1) as usize;
        format!("{value:.decimals$e}")
    }
}

/// What was analysed and what proves it, by their digests, and when.
fn proofs(analysis: &Analysis, drawn: &Drawn<'_>) -> Section {
    let mut rows = Vec::new();
    if let Some(digest) = &analysis.problem_sha256 {
        rows.push(row(["problem", digest]));
    }
    for (proof, file) in analysis.proofs.iter().zip(drawn.files) {
        let digest = file.sha256.clone();
        rows.push(vec![format!("certificate {}", proof.name), digest]);
    }

    let since_epoch = drawn.date.duration_since(UNIX_EPOCH);
    let days = since_epoch.map_or(0, |time| time.as_secs() / SECONDS_OF_A_DAY);
    let table = Content::Table {
        caption: "SHA-256, as `mceip check` compares them".into(),
        header: Vec::new(),
        rows,
    };
    let date = format!("Made on {} (UTC) by {PROGRAM}.", date_of(days));

    Section {
        title: "Digests".into(),
        content: vec![Content::Paragraph(date), table],
    }
}

const SECONDS_OF_A_DAY: u64 = 86_400;

/// What made the page.
const PROGRAM: &str = concat!("mceip ", env!("CARGO_PKG_VERSION"));

/// The date a number of days after 1970-01-01, as YYYY-MM-DD.
fn date_of(days: u64) -> String {
    let mut year = 1970;
    let mut left = days;
    while left >= days_of_year(year) {
        left -= days_of_year(year);
        year += 1;
    }

    let february = days_of_year(year) - 337;
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if left < length {
            break;
        }
        left -= length;
        month += 1;
    }

    format!("{year:04}-{month:02}-{:02}", left + 1)
}

fn days_of_year(year: u64) -> u64 {
    let is_leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    if is_leap { 366 } else { 365 }
}

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(String::from).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits() {
        let shown = [0.5, 0.0, 1234.5678, -2e-9, 1e8].map(|value| with_digits(value, 7));
        assert_eq!(
            shown,
            ["0.5000000", "0", "1234.568", "-2.000000e-9", "1.000000e8"]
        );
    }

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (days, date) in [
            (0, "1970-01-01"),
            (58, "1970-02-28"),
            (59, "1970-03-01"),
            (789, "1972-02-29"),
            (11_016, "2000-02-29"),
            (20_780, "2026-11-23"),
            (20_818, "2026-12-31"),
            (20_819, "2027-01-01"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(date_of(days), date);
        }
    }
}
