//! Pictures and the report of the loading path.

use super::states::{Mode, Set, State, values, verdict};
use super::words::{causes_text, end_text, motion};
use crate::cli::common::CliError;
use crate::picture::{
    BranchPoint, Branches, Content, Mode as Drawn, Picture, Report, Section, Threshold,
    ThresholdColumn, branch_picture, mode_picture, path_picture, threshold_picture,
};
use mceip_engine::run::{Progress, Watch};
use mceip_engine::search::levels::Levels;
use mceip_exact::{Rational, to_f64};
use mceip_paper::path::LoadingPath;
use mceip_paper::{Block, BlockModel, MassKind, SourceError, Triangulation};

/// Everything there is to show.
pub(super) struct Shown<'a> {
    pub(super) model: &'a BlockModel,
    pub(super) block: &'a Block,
    pub(super) path: &'a LoadingPath,
    pub(super) states: &'a [State],
    /// The state whose lambda^2 is drawn against mu.
    pub(super) branches: Option<(usize, Branches)>,
    /// Were the MCEIP-mu sets checked on K itself?
    pub(super) uncondensed: bool,
}

/// A picture with the name of its file and what to read off it.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) picture: Picture,
    caption: String,
}

/// Levels of lambda^2 in units of the lowest natural frequency squared: a factor 1.5 between
/// levels, around 1.
const LEVELS: std::ops::Range<i32> = -10..14;

/// The solutions of the last state with a solution, level by level; `None` without one.
pub(super) fn branches(
    block: &Block,
    path: &LoadingPath,
    states: &[State],
    watch: &Watch<'_>,
) -> Result<Option<(usize, Branches)>, CliError> {
    let Some(state) = states
        .iter()
        .rev()
        .find(|s| !s.thresholds.solutions.is_empty())
    else {
        return Ok(None);
    };
    let point = |mu: f64, lambda2: f64, support: &[usize]| BranchPoint {
        mu,
        lambda2,
        support: support.to_vec(),
    };
    let certified = |(mu, set): &(Rational, Set)| -> Vec<BranchPoint> {
        set.solutions
            .iter()
            .map(|m| point(to_f64(mu), m.value, &m.moving))
            .collect()
    };
    let certified = state.growing.iter().flat_map(certified).collect();
    let mut levels = vec![
        state
            .thresholds
            .solutions
            .iter()
            .map(|m| point(m.value, 0.0, &m.moving))
            .collect::<Vec<_>>(),
    ];
    let system = Levels::new(&block.system(&path.intervals[state.stretch].states, None)?)?;
    let unit = system.lowest_frequency2().unwrap_or(1.0);
    for (k, exponent) in LEVELS.enumerate() {
        if watch.is_cancelled() {
            break;
        }
        watch.report(&Progress::stage(&format!(
            "lambda^2 against mu: level {} of {}",
            k + 1,
            LEVELS.len()
        )));
        let lambda2 = unit * 1.5f64.powi(exponent);
        let (found, _) = system.at(lambda2)?.solutions(&watch.quiet())?;
        levels.push(
            found
                .iter()
                .map(|s| point(s.mu, lambda2, &s.support))
                .collect(),
        );
    }
    Ok(Some((state.stretch, Branches { levels, certified })))
}

impl Shown<'_> {
    /// Every picture: the path, the thresholds, lambda^2 against mu, a mode for each certified
    /// solution.
    pub(super) fn pictures(&self) -> Result<Vec<Named>, SourceError> {
        let mesh = self.model.triangulation()?;
        let mut all = self.charts();
        for state in self.states {
            all.extend(self.modes(&mesh, state));
        }
        Ok(all)
    }

    fn charts(&self) -> Vec<Named> {
        let mu = to_f64(&self.path.loading.friction);
        let caption = "Each event is an exact rational number; (1), (2), (5), (7) hold exactly at \
                       both ends of each stretch."
            .into();
        let picture = path_picture(
            "Loading path: resultants, and the state of each contact node",
            self.path,
        );
        let mut all = vec![Named {
            name: "path".into(),
            picture,
            caption,
        }];
        let column = |s: &State| ThresholdColumn {
            stretch: s.stretch,
            slip: s.slip,
            solutions: s
                .thresholds
                .solutions
                .iter()
                .map(|m| Threshold {
                    mu: m.value,
                    moving: m.moving.len(),
                })
                .collect(),
            necessary: s.necessary_from(),
        };
        let columns: Vec<ThresholdColumn> = self.states.iter().map(column).collect();
        let caption = "The complete set of MCEIP-\u{3bc} for each state with slip, each set \
                       certified. A state in whose column no solution \
                       stands has none. \u{3bb} = 0 is the static threshold; divergence may begin \
                       at a lower \u{3bc} with \u{3bb}\u{b2} > 0.";
        let picture = threshold_picture("MCEIP-\u{3bc} along the loading path", &columns, mu);
        all.push(Named {
            name: "thresholds".into(),
            picture,
            caption: caption.into(),
        });
        if let Some((stretch, branches)) = &self.branches {
            let title = format!("\u{3bb}\u{b2} against \u{3bc} for the state of stretch {stretch}");
            let caption = "Points: every solution at that \u{3bb}\u{b2}, from the pencil condensed \
                           in doubles (measured, not certified). \
                           The threshold and the squares are certified.";
            let picture = branch_picture(&title, branches);
            all.push(Named {
                name: format!("lambda2-stretch-{stretch:02}"),
                picture,
                caption: caption.into(),
            });
        }
        all
    }

    fn modes(&self, mesh: &Triangulation, state: &State) -> Vec<Named> {
        let mut all = Vec::new();
        let mut draw = |m: &Mode, name: String, title: String, caption: String| {
            let Some(displacement) = &m.displacement else {
                return;
            };
            let drawn = Drawn {
                mesh,
                displacement,
                marks: &state.marks(self.path, m),
            };
            all.push(Named {
                name,
                picture: mode_picture(&title, &drawn),
                caption,
            });
        };
        let stretch = state.stretch;
        let slipping = |m: &Mode| {
            format!(
                "{} of {} slip nodes slip, the others get stuck.",
                m.moving.len(),
                state.slip
            )
        };
        for (k, m) in state.thresholds.solutions.iter().enumerate() {
            let title = format!(
                "Stretch {stretch}: mode at \u{3bc} = {:.6}, \u{3bb} = 0",
                m.value
            );
            draw(
                m,
                format!("mode-stretch-{stretch:02}-mu-{}", k + 1),
                title,
                slipping(m),
            );
        }
        for (mu, set) in &state.growing {
            for (k, m) in set.solutions.iter().enumerate() {
                let mu = to_f64(mu);
                let title = format!(
                    "Stretch {stretch}: mode at \u{3bc} = {mu}, growth rate {:.4} 1/s",
                    m.value.max(0.0).sqrt()
                );
                draw(
                    m,
                    format!("mode-stretch-{stretch:02}-at-{mu}-{}", k + 1),
                    title,
                    slipping(m),
                );
            }
        }
        all
    }

    /// The report.
    pub(super) fn report(&self) -> Result<Report, SourceError> {
        let mesh = self.model.triangulation()?;
        let figure = |n: Named| Content::Figure {
            picture: n.picture,
            caption: n.caption,
        };
        let mut charts = self.charts().into_iter().map(figure);
        let path = charts.next();
        let mut sections = vec![self.model_section(&mesh)];
        sections.push(Section {
            title: "Loading path".into(),
            content: path.into_iter().chain([self.path_table()]).collect(),
        });
        let mut thresholds: Vec<Content> = vec![Content::Paragraph(self.meaning())];
        thresholds.extend(charts);
        sections.push(Section {
            title: "Divergence instability along the path".into(),
            content: thresholds,
        });
        for state in self.states {
            sections.push(self.state_section(
                state,
                self.modes(&mesh, state).into_iter().map(figure).collect(),
            ));
        }
        let (nx, ny) = self.model.cells;
        let title = format!(
            "Elastic block in frictional contact: {nx} x {ny} cells, \u{3bc} = {}",
            to_f64(&self.path.loading.friction)
        );
        Ok(Report { title, sections })
    }

    fn meaning(&self) -> String {
        let proof = if self.uncondensed {
            "of K and M themselves."
        } else {
            PROOF
        };
        format!("{MEANING} {proof}")
    }

    fn model_section(&self, mesh: &Triangulation) -> Section {
        let m = self.model;
        let mass = if m.mass == MassKind::Lumped {
            "lumped"
        } else {
            "consistent"
        };
        let number = |r: &Rational| format!("{}", to_f64(r));
        let rows = [
            (
                "Length L, height H, thickness (mm)",
                format!(
                    "{}, {}, {}",
                    m.length(),
                    m.height(),
                    number(&m.material.thickness)
                ),
            ),
            (
                "Modulus of elasticity E (N/mm\u{b2})",
                number(&m.material.young),
            ),
            ("Poisson's ratio", number(&m.material.poisson)),
            ("Density (t/mm\u{b3})", number(&m.material.density)),
            ("Plane", format!("plane {}", m.plane.word())),
            (
                "Mesh",
                format!(
                    "{} x {} cells, {}, {} P1 triangles",
                    m.cells.0,
                    m.cells.1,
                    m.mesh.word(),
                    mesh.triangles.len()
                ),
            ),
            (
                "Contact nodes, degrees of freedom",
                format!("{}, {}", mesh.contact.len(), self.block.stiffness.rows()),
            ),
            ("Mass", mass.into()),
            (
                "Coefficient of friction of the path",
                number(&self.path.loading.friction),
            ),
            (
                "Pressing force N (N), its depth (mm)",
                format!(
                    "{}, {:.9}",
                    number(&self.path.loading.force),
                    to_f64(&self.path.depth)
                ),
            ),
        ];
        let rows = rows
            .into_iter()
            .map(|(what, value)| vec![what.into(), value])
            .collect();
        let table = Content::Table {
            caption: "Units: mm, N, t, s.".into(),
            header: vec!["quantity".into(), "value".into()],
            rows,
        };
        Section {
            title: "Model".into(),
            content: vec![table],
        }
    }

    fn path_table(&self) -> Content {
        let header = [
            "#",
            "from (mm)",
            "to (mm)",
            "nodes",
            "stick",
            "left",
            "right",
            "free",
            "T at start (N)",
            "begins with",
        ];
        let row = |(k, i): (usize, &mceip_paper::path::Interval)| {
            let to = i.stop.as_ref().map_or("-".into(), motion);
            let mut row = vec![k.to_string(), motion(&i.start), to, i.picture()];
            row.extend(i.counts().map(|c| c.to_string()));
            row.extend([
                format!("{:.6}", to_f64(&i.start.resultants().0)),
                causes_text(&i.begin.causes),
            ]);
            row
        };
        let rows = self.path.intervals.iter().enumerate().map(row).collect();
        let caption = format!(
            "Stretches of the path. Nodes from left to right: . stick, < slips to the left (S = \
             1), > slips to the right (S = -1), o free. How it ends: {}.",
            end_text(self.path)
        );
        Content::Table {
            caption,
            header: header.map(String::from).to_vec(),
            rows,
        }
    }

    fn state_section(&self, s: &State, figures: Vec<Content>) -> Section {
        let interval = &self.path.intervals[s.stretch];
        let [stick, left, right, free] = interval.counts();
        let to = interval
            .stop
            .as_ref()
            .map_or("the end".into(), |e| format!("{} mm", motion(e)));
        let mut rows = vec![
            vec![
                "Motion".into(),
                format!("from {} mm to {to}", motion(&interval.start)),
            ],
            vec![
                "States".into(),
                format!(
                    "{} ({stick} stick, {left} slip left, {right} slip right, {free} free)",
                    interval.picture()
                ),
            ],
            vec![
                "MCEIP-\u{3bc} in [0, \u{221e})".into(),
                format!(
                    "{} ({}, {} leaves)",
                    values(&s.thresholds, "\u{3bc}", 12),
                    verdict(&s.thresholds),
                    s.thresholds.leaves
                ),
            ],
        ];
        let all_slip = |set: &Set| {
            if set.solutions.iter().any(|m| s.is_all_slip(m)) {
                "an all-slip mode exists"
            } else {
                "no all-slip mode"
            }
        };
        rows.push(vec![
            "Sufficient condition (17)-(18) at \u{3bb} = 0".into(),
            all_slip(&s.thresholds).into(),
        ]);
        if s.necessary.is_some() {
            let from = s.necessary_from().map_or(
                "never holds: divergence is excluded for every \u{3bc}".into(),
                |mu| format!("holds from \u{3bc} = {mu:.9} on; below it divergence is excluded"),
            );
            rows.push(vec![
                format!("Necessary condition {}", s.necessary_equation()),
                from,
            ]);
        }
        for (mu, set) in &s.growing {
            let rate = |m: &Mode| {
                format!(
                    "\u{3bb}\u{b2} in {} 1/s\u{b2}, growth rate {:.6} 1/s, {} slipping",
                    m.enclosure(12),
                    m.value.max(0.0).sqrt(),
                    m.moving.len()
                )
            };
            let list: Vec<String> = set.solutions.iter().map(rate).collect();
            let list = if list.is_empty() {
                "no divergence instability of the form (8)".into()
            } else {
                list.join("; ")
            };
            let what = format!("MCEIP-\u{3bb}\u{b2} at \u{3bc} = {}", to_f64(mu));
            rows.push(vec![
                what,
                format!("{list} ({}; {})", verdict(set), all_slip(set)),
            ]);
        }
        let header = vec!["what".into(), "answer".into()];
        let caption =
            "For this contact state, taken as impending slip at the \u{3bc} in question.".into();
        let mut content = vec![Content::Table {
            caption,
            header,
            rows,
        }];
        if s.is_open() {
            content.insert(
                0,
                Content::Warning(
                    "Not everything is decided: regions are left open, \
                and may hold more solutions."
                        .into(),
                ),
            );
        }
        content.extend(figures);
        Section {
            title: format!("State of stretch {}: {} slip nodes", s.stretch, s.slip),
            content,
        }
    }
}

const MEANING: &str = "A solution of MCEIP-\u{3bc} is a coefficient of friction at which the \
                       equilibrium can leave in the form (8) with \u{3bb} = 0; \
a solution of MCEIP-\u{3bb}\u{b2} at a given \u{3bc} is a divergence with the growth rate \u{3bb}. \
                       Where there is none, divergence of the form (8) is \
excluded and nothing else: flutter and growth of stick-slip lie outside it. \"Complete, proved\" \
                       means that a certificate was written \
for the whole half line and accepted by the exact checker, for the problem";

const PROOF: &str = "of K and M themselves (MCEIP-\u{3bb}\u{b2}), of the state's exactly condensed \
                     pencil (MCEIP-\u{3bc}).";
