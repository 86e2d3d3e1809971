//! Pictures and the report of a loading path.
//!
//! Input: the path, what was proved of its states, and how lambda^2 depends on mu for one of them.
//! Output: the pictures with captions for `--pictures`, and a page that holds all of them with
//! tables for `--report`. Numbers in captions and tables are exact or certified; charts draw them
//! in doubles. Modes are drawn where the file says where its nodes are.

use super::bodies::{self, numbered};
use super::own;
use super::states::{
    ExaminedStates, Growing, Holds, IN_A_REPORT, ProvedMode, ProvedSet, ProvedState, is_slip,
    refused_text,
};
use crate::cli::common::CliError;
use crate::cli::pictures::{LEVELS_CAPTION, Named, keep_below, levels_of, warnings_of};
use crate::picture::{
    BodyDrawing, BodyMode, Branches, ChartPoint, Content, PathDrawing, ReportPage, Section,
    Threshold, ThresholdColumn, branch_picture, path_picture, threshold_picture,
};
use crate::say::path::{
    LETTERS, amount_text, causes_text, continuations_text, doubts_text, of_which_body,
};
use crate::say::path_analysis::{HEADER, rows_of, verdict_text};
use crate::say::stretches::stretch_cells;
use crate::{LoadPath, OwnCritical, PathAnalysis};
use mceip_engine::report::counted;
use mceip_engine::run::Watch;
use mceip_exact::{Interval, enclosing_decimals, to_f64, upper_decimal};
use mceip_model::{Coordinates, ModelError, System};
use mceip_path::LoadingPath;
use num_traits::Zero;

/// Everything there is to show.
pub(super) struct Shown<'a> {
    pub(super) followed: &'a LoadPath,
    /// Names of the steps.
    pub(super) names: &'a [&'a str],
    /// Whether the states of the path diverge, if that was asked for.
    pub(super) analysed: Option<&'a PathAnalysis>,
    /// What is proved of the states of the path, if that was asked for.
    pub(super) examined: Option<&'a ExaminedStates>,
    /// The own critical friction, if that was asked for.
    pub(super) own: Option<&'a OwnCritical>,
    pub(super) branches: Option<StateBranches>,
    /// On which matrices the MCEIP-mu sets were checked.
    pub(super) checked_on: CheckedOn,
}

/// The matrices on which a set was checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum CheckedOn {
    /// K and M.
    Given,
    /// The exactly condensed pencil of each state.
    Condensed,
}

/// lambda against mu for the state of one stretch.
pub(super) struct StateBranches {
    stretch: usize,
    branches: Branches,
}

/// The solutions of the last state with a solution, level by level; `None` without one, or without
/// a mass.
pub(super) fn branches(
    body: &System,
    path: &LoadingPath,
    states: &[ProvedState],
    watch: &Watch<'_>,
) -> Result<Option<StateBranches>, CliError> {
    if body.mass().is_none() {
        return Ok(None);
    }
    let mut backwards = states.iter().rev();
    let Some(state) = backwards.find(|s| !s.thresholds.solutions.is_empty()) else {
        return Ok(None);
    };

    let mut certified = Vec::new();
    for growing in &state.growing {
        for solution in &growing.set.solutions {
            certified.push(ChartPoint {
                mu: to_f64(&growing.mu),
                lambda2: solution.value,
                support: solution.moving.clone(),
            });
        }
    }

    let contact_states = path.stretches[state.stretch].equilibrium_states();
    let mut levels = levels_of(&body.with_states(contact_states, None)?, watch)?;
    let thresholds = state.thresholds.solutions.iter();
    let threshold = thresholds.map(|solution| solution.value);
    let threshold = threshold.min_by(f64::total_cmp);
    let asked = certified.iter().map(|point| point.mu);
    let known = asked.chain(threshold).chain([to_f64(&path.steps.friction)]);
    keep_below(&mut levels, 2.0 * known.fold(0.0, f64::max));

    Ok(Some(StateBranches {
        stretch: state.stretch,
        branches: Branches {
            levels,
            certified,
            absent_below: None,
        },
    }))
}

/// The picture of a path.
pub(super) fn path_chart(followed: &LoadPath, steps: &[&str]) -> Named {
    let drawing = PathDrawing {
        path: followed.as_path(),
        steps,
        candidates: followed.loads().candidates(),
        coordinates: followed.loads().as_file().coordinates.as_ref(),
    };
    let title = "Loading path: resultants, and the state of each contact candidate";
    Named::chart("path", path_picture(title, &drawing), PATH_CAPTION)
}

/// What is drawn beside the path itself: of the own critical friction, if that was asked for, its
/// strip and its growth rates along mu and the body that decides; else the body at rest and at the
/// end of each step.
pub(super) fn beside_the_path(followed: &LoadPath, own: Option<&OwnCritical>) -> Vec<Named> {
    match own {
        Some(own) => own::pictures(own),
        None => bodies::of_path(followed.loads(), followed.as_path()),
    }
}

/// Whether the states on the path diverge.
fn analysis_section(analysed: &PathAnalysis) -> Section {
    Section {
        title: "Divergence of the states on the path".into(),
        content: vec![
            Content::Paragraph(verdict_text(analysed)),
            Content::Table {
                caption: "The states inside the stretches, held.".into(),
                header: HEADER.map(String::from).to_vec(),
                rows: rows_of(analysed),
            },
        ],
    }
}

impl Shown<'_> {
    fn path(&self) -> &LoadingPath {
        self.followed.as_path()
    }

    fn body(&self) -> &System {
        self.followed.loads().body().system()
    }

    /// The pictures of the states: the thresholds, lambda against mu, a mode for each certified
    /// solution.
    pub(super) fn state_pictures(&self) -> Result<Vec<Named>, ModelError> {
        let mut all = Vec::new();
        if let Some(ExaminedStates { proved: states, .. }) = self.examined {
            all.push(self.threshold_chart(states));
            all.extend(self.branch_chart());
            for state in states {
                all.extend(self.modes(state)?);
            }
        }

        Ok(all)
    }

    fn threshold_chart(&self, states: &[ProvedState]) -> Named {
        let columns: Vec<ThresholdColumn> = states.iter().map(threshold_column).collect();
        let mu = to_f64(&self.path().steps.friction);
        let title = "MCEIP-\u{3bc} along the loading path";
        let picture = threshold_picture(title, &columns, mu);
        Named::chart("thresholds", picture, THRESHOLDS_CAPTION)
    }

    fn branch_chart(&self) -> Option<Named> {
        let StateBranches { stretch, branches } = self.branches.as_ref()?;
        let title =
            format!("Growth rate \u{3bb} against \u{3bc} for the state of stretch {stretch}");
        let name = format!("lambda-stretch-{stretch:02}");
        let picture = branch_picture(&title, branches);
        let caption = format!("{LEVELS_CAPTION} The threshold and the squares are certified.");
        Some(Named::chart(name, picture, caption))
    }

    /// A picture for each solution of a state; none where the places of the nodes are not known.
    fn modes(&self, state: &ProvedState) -> Result<Vec<Named>, ModelError> {
        let mut all = Vec::new();
        let Some(coordinates) = &self.followed.loads().as_file().coordinates else {
            return Ok(all);
        };

        let stretch = state.stretch;
        let states = self.path().stretches[stretch].equilibrium_states();
        let drawn = DrawnState {
            state,
            system: self.body().with_states(states, None)?,
            coordinates,
        };
        for (k, mode) in state.thresholds.solutions.iter().enumerate() {
            let mu = mode.value;
            let title = format!("Stretch {stretch}: mode at \u{3bc} = {mu:.6}, \u{3bb} = 0");
            let name = format!("mode-stretch-{stretch:02}-threshold-{}", k + 1);
            all.extend(drawn.mode(mode, &title, name));
        }

        for Growing { mu, set } in &state.growing {
            let mu = to_f64(mu);
            for (k, mode) in set.solutions.iter().enumerate() {
                let rate = mode.growth_rate();
                let title =
                    format!("Stretch {stretch}: mode at \u{3bc} = {mu}, growth rate {rate:.4} 1/s");
                let name = format!("mode-stretch-{stretch:02}-at-{mu}-{}", k + 1);
                all.extend(drawn.mode(mode, &title, name));
            }
        }

        Ok(all)
    }

    /// The report.
    pub(super) fn report(&self) -> Result<ReportPage, ModelError> {
        let mut path = Section {
            title: "Loading path".into(),
            content: vec![
                path_chart(self.followed, self.names).into_figure(),
                self.path_table(),
                Content::Paragraph(continuations_text(self.followed.continuations())),
                Content::Paragraph(of_which_body(self.followed.is_in_doubles()).into()),
            ],
        };
        if self.own.is_none() {
            let bodies = bodies::of_path(self.followed.loads(), self.path());
            path.content
                .extend(bodies.into_iter().map(Named::into_figure));
        }
        let doubts = doubts_text(self.followed);
        if !doubts.is_empty() {
            path.content.insert(0, Content::Warning(doubts));
        }

        let mut sections = vec![self.model_section()];
        sections.extend(self.own.map(own::section));
        sections.push(path);
        sections.extend(self.analysed.map(analysis_section));
        if let Some(ExaminedStates {
            proved: states,
            refused,
        }) = self.examined
        {
            let mut thresholds = vec![
                Content::Paragraph(self.meaning()),
                self.threshold_chart(states).into_figure(),
            ];
            thresholds.extend(
                refused
                    .iter()
                    .map(|one| Content::Warning(refused_text(one))),
            );
            thresholds.extend(self.branch_chart().map(Named::into_figure));
            sections.push(Section {
                title: "Divergence instability along the path".into(),
                content: thresholds,
            });

            for state in states {
                let modes = self.modes(state)?;
                let figures = modes.into_iter().map(Named::into_figure);
                sections.push(self.state_section(state, figures.collect()));
            }
        }

        let name = self.followed.loads().as_file().name.as_deref();
        let name = name.unwrap_or("A body under loads");
        let mu = to_f64(&self.path().steps.friction);
        let title = format!("{name}: elastic body in frictional contact, \u{3bc} = {mu}");

        Ok(ReportPage { title, sections })
    }

    /// What a solution means, and what was checked.
    fn meaning(&self) -> String {
        match self.checked_on {
            CheckedOn::Given => format!("{MEANING} {UNCONDENSED_PROOF}"),
            CheckedOn::Condensed => format!("{MEANING} {CONDENSED_PROOF}"),
        }
    }

    /// The data of the body as a table.
    fn model_section(&self) -> Section {
        let file = self.followed.loads().as_file();
        let body = self.body();
        let open = file.body.gaps().iter().filter(|gap| !gap.is_zero()).count();
        let candidates = body.particles().len();
        let mass = if body.mass().is_some() {
            "given"
        } else {
            "none: no growth rates"
        };

        let rows = vec![
            row(
                "Degrees of freedom that are not held",
                body.dofs().to_string(),
            ),
            row(
                "Contact candidates",
                format!("{candidates}, {open} with a gap"),
            ),
            row("Mass", mass.into()),
            row(
                "Coefficient of friction of the path",
                to_f64(&self.path().steps.friction).to_string(),
            ),
            row("Steps of the load", self.names.join(", ")),
        ];
        let table = Content::Table {
            caption: "Units are those of the file.".into(),
            header: vec!["quantity".into(), "value".into()],
            rows,
        };

        let comment = file.comment.iter().cloned().map(Content::Paragraph);
        Section {
            title: "Model".into(),
            content: comment
                .chain([table])
                .chain(warnings_of(&file.warnings))
                .collect(),
        }
    }

    /// A line for each stretch.
    fn path_table(&self) -> Content {
        let header = [
            "#",
            "step",
            "from",
            "to",
            "candidates",
            "stick",
            "slip-",
            "slip+",
            "free",
            "T at start",
            "begins with",
        ];
        let candidates = self.followed.loads().candidates();
        let mut rows = Vec::new();
        for (k, stretch) in self.path().stretches.iter().enumerate() {
            let mut row = stretch_cells(k, stretch);
            row.insert(1, self.names[stretch.step].into());
            row.push(causes_text(&stretch.begin.causes, candidates));
            rows.push(row);
        }

        let end = self.followed.end_text();
        let caption = format!(
            "Stretches of the path; from and to are parts of the load of the step. {LETTERS}. How \
             it ends: {end}."
        );

        Content::Table {
            caption,
            header: header.map(String::from).to_vec(),
            rows,
        }
    }

    /// What was proved of a state, with the pictures of its modes.
    fn state_section(&self, state: &ProvedState, figures: Vec<Content>) -> Section {
        let mut content = Vec::new();
        if state.is_open() {
            content.push(Content::Warning(OPEN_WARNING.into()));
        }

        let caption = "For this contact state, taken as impending slip at the \u{3bc} in question.";
        content.push(Content::Table {
            caption: caption.into(),
            header: vec!["what".into(), "answer".into()],
            rows: self.state_rows(state),
        });
        content.extend(figures);

        Section {
            title: format!(
                "State of stretch {}: {} in impending slip",
                state.stretch,
                counted(state.slip, "node")
            ),
            content,
        }
    }

    fn state_rows(&self, state: &ProvedState) -> Vec<Vec<String>> {
        let stretch = &self.path().stretches[state.stretch];
        let from = amount_text(&stretch.start);
        let to = match &stretch.stop {
            Some(stop) => amount_text(stop),
            None => "the end".into(),
        };
        let picture = stretch.picture();
        let [stick, left, right, free] = stretch.counts();

        let set = &state.thresholds;
        let values = set.values("\u{3bc}", 12, IN_A_REPORT);
        let verdict = set.verdict();
        let leaves = counted(set.leaves, "leaf");
        let mut rows = vec![
            row(
                "Load",
                format!("{}: from {from} to {to}", self.names[stretch.step]),
            ),
            row(
                "States",
                format!("{picture} ({stick} stick, {left} slip-, {right} slip+, {free} free)"),
            ),
            row(
                "MCEIP-\u{3bc} in [0, \u{221e})",
                format!("{values} ({verdict}, {leaves})"),
            ),
            row(
                "Sufficient condition (17)-(18) at \u{3bb} = 0",
                all_slip_text(state, set).into(),
            ),
        ];

        if let Some(holds) = state.necessary_holds() {
            let what = format!("Necessary condition {}", state.necessary_equation());
            let answer = match holds {
                Holds::Always => "holds from \u{3bc} = 0 on: it excludes nothing".into(),
                Holds::From { not_below, mu } => {
                    let (below, _) = enclosing_decimals(&Interval::point(not_below), 9);
                    let from = upper_decimal(&mu, 9);
                    format!(
                        "holds from \u{3bc} = {from} on; below \u{3bc} = {below} divergence is \
                         excluded"
                    )
                }
                Holds::Never => "never holds: divergence is excluded for every \u{3bc}".into(),
            };

            rows.push(row(&what, answer));
        }

        for growing in &state.growing {
            let mu = to_f64(&growing.mu);
            let what = format!("MCEIP-\u{3bb}\u{b2} at \u{3bc} = {mu}");
            rows.push(row(&what, growing_text(state, growing)));
        }

        rows
    }
}

/// A state whose modes are drawn.
struct DrawnState<'a> {
    state: &'a ProvedState,
    /// The body in it.
    system: System,
    coordinates: &'a Coordinates,
}

impl DrawnState<'_> {
    /// The picture of a mode; `None` if its displacement is not known.
    fn mode(&self, mode: &ProvedMode, title: &str, name: String) -> Option<Named> {
        let particles = numbered(self.system.particles());
        let slip = particles
            .iter()
            .enumerate()
            .filter(|(_, p)| is_slip(&p.state));
        let slip: Vec<usize> = slip.map(|(index, _)| index).collect();
        let slipping: Vec<usize> = mode.moving.iter().map(|&k| slip[k]).collect();
        let drawn = BodyDrawing {
            coordinates: self.coordinates,
            particles: &particles,
            mode: Some(BodyMode {
                v: mode.displacement.as_ref()?,
                slipping: &slipping,
            }),
            load: None,
        };
        let moving = slipping.len();
        let slip = self.state.slip;
        let caption = if moving == slip {
            "All candidates in impending slip move.".into()
        } else {
            format!("{moving} of {slip} candidates in impending slip move, the others stick.")
        };

        Some(Named::body(name, title, &drawn, caption))
    }
}

/// What is drawn of a state.
fn threshold_column(state: &ProvedState) -> ThresholdColumn {
    let mut solutions = Vec::new();
    for mode in &state.thresholds.solutions {
        solutions.push(Threshold {
            mu: mode.value,
            moving: mode.moving.len(),
        });
    }

    ThresholdColumn {
        stretch: state.stretch,
        slip: state.slip,
        solutions,
        necessary: state.necessary_from(),
    }
}

fn all_slip_text(state: &ProvedState, set: &ProvedSet) -> &'static str {
    match state.has_all_slip(set) {
        Some(true) => "an all-slip mode exists",
        Some(false) => "no all-slip mode",
        None => "no all-slip mode found",
    }
}

/// The solutions of MCEIP-lambda2 at one mu, and what is proved of them.
fn growing_text(state: &ProvedState, growing: &Growing) -> String {
    let mut rates = Vec::new();
    for mode in &growing.set.solutions {
        let enclosure = mode.enclosure(12);
        let rate = mode.growth_rate();
        let slipping = mode.moving.len();
        rates.push(format!(
            "\u{3bb}\u{b2} in {enclosure} 1/s\u{b2}, growth rate {rate:.6} 1/s, {slipping} slipping"
        ));
    }

    if !growing.set.families.is_empty() {
        rates.push(growing.set.families_text("\u{3bb}\u{b2}", IN_A_REPORT));
    }

    let list = match (rates.is_empty(), growing.set.open) {
        (true, 0) => "no divergence instability of the form (8)".into(),
        (true, _) => "none found".into(),
        (false, _) => rates.join("; "),
    };

    let verdict = growing.set.verdict();
    let all_slip = all_slip_text(state, &growing.set);
    format!("{list} ({verdict}; {all_slip})")
}

/// A row of two cells.
fn row(what: &str, answer: String) -> Vec<String> {
    vec![what.into(), answer]
}

/// What to read off the picture of the path.
const PATH_CAPTION: &str = "Each event is an exact rational number; (1), (2), (5), (7) hold \
     exactly at both ends of each stretch.";

/// What to read off the picture of the thresholds.
const THRESHOLDS_CAPTION: &str = "The complete set of MCEIP-\u{3bc} for each state with slip, \
     each set certified. A state in whose column no solution stands has none, unless its table \
     gives a range of \u{3bc} or a cone, or says that regions are open. \u{3bb} = 0 is the static \
     threshold; divergence may begin at a lower \u{3bc} with \u{3bb}\u{b2} > 0. A necessary \
     condition that holds from \u{3bc} = 0 on is not drawn.";

/// Stands above a state of which something is open.
const OPEN_WARNING: &str = "Not everything is decided: regions are left open, and may hold more \
     solutions.";

/// What a solution means, up to what the checker was given.
const MEANING: &str = "A solution of MCEIP-\u{3bc} is a coefficient of friction at which the \
     equilibrium can leave in the form (8) with \u{3bb} = 0; a solution of MCEIP-\u{3bb}\u{b2} at \
     a given \u{3bc} is a divergence with the growth rate \u{3bb}. Where there is none, \
     divergence of the form (8) is excluded and nothing else: flutter and growth of stick-slip \
     lie outside it. \"Complete, proved\" means that a certificate was written for the whole half \
     line and accepted by the exact checker, for the problem";

/// The end of [`MEANING`] where the sets were checked on K and M.
const UNCONDENSED_PROOF: &str = "of K and M themselves.";

/// The end of [`MEANING`] where the MCEIP-mu sets were checked on the condensed pencil.
const CONDENSED_PROOF: &str = "of K and M themselves (MCEIP-\u{3bb}\u{b2}), of the state's \
     exactly condensed pencil (MCEIP-\u{3bc}).";
