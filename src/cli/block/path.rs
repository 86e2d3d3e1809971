//! `mceip block --path`: the loading path, stretch by stretch.
//!
//! The block is pressed until its normal force is N and then moved to the left. The path is
//! piecewise linear in the motion; each event, where a contact node changes its state, is located
//! exactly by `mceip_path`. On request: what is proved of the state of each stretch
//! ([`states`]), pictures and a report ([`pages`]), and a comparison with ordinary stepping.

mod pages;

use super::args::Args;
use super::scale::cells_of;
use crate::cli::common::{CliError, exit, number, positive, print};
use crate::cli::job::Job;
use crate::cli::output::{Folder, Output};
use crate::cli::path::states::{self, Followed, ProvedState, Wanted};
use crate::cli::path::{INTERRUPTED, exit_code, stretches};
use crate::front::left_behind_if;
use crate::say;
use crate::say::path::{end_text, states_json};
use mceip_engine::run::{Progress, Watch};
use mceip_exact::{Integer, Rational, to_f64};
use mceip_model::ContactState;
use mceip_paper::path::{BlockPath, Comparison, Loading, step_path};
use mceip_paper::{Block, BlockModel, MeshKind, Plane};
use mceip_path::Contact;
use num_traits::ToPrimitive;
use pages::Shown;
use serde_json::{Value, json};

/// More steps than anybody waits for.
const MAX_STEPS: usize = 1_000_000;

/// The names of the two steps.
const STEPS: &[&str] = &["pressing", "motion"];

/// Follows the path and prints it.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let model = model(args)?;
    let loading = loading(args)?;
    let step = args.step.as_deref();
    let step = step.map(|length| positive("step", length)).transpose()?;
    let at_mu = args.at_mu.iter().map(|mu| positive("at-mu", mu));
    let at_mu = at_mu.collect::<Result<Vec<_>, _>>()?;
    let block = Block::new(&model)?;

    let report = Output::prepare_if("report", args.report.as_deref(), &[])?;
    let folder = Folder::prepare_if("pictures", args.pictures.as_deref(), &[])?;

    let job = Job::begin("condensing exactly to the contact nodes");
    let condensing = block.clone();
    let condensed = left_behind_if(&|| job.is_cancelled(), move || condensing.contact_side());
    let Some(contact) = condensed else {
        job.end();
        return Ok(exit::INTERRUPTED);
    };
    let contact = contact?;
    let path = follow(&contact, &loading, &job)?;
    let steps = match &step {
        Some(step) => Some(compare(&contact, &path, step, &job)?),
        None => None,
    };

    let is_shown = report.is_some() || folder.is_some();
    let wanted = Wanted {
        uncondensed: args.uncondensed,
        conditions: args.conditions || is_shown,
        at_mu: &at_mu,
        modes: args.modes || is_shown,
    };
    let say = |progress: &Progress<'_>| job.say(progress);
    let watch = Watch::new(job.cancel(), &say);
    let stuck = vec![ContactState::Stick; block.contact.len()];
    let body = block.system(&stuck, None)?;
    let followed = Followed {
        body: &body,
        contact: &contact,
        path: &path.motion,
    };
    let states = if args.complete || is_shown {
        Some(states::of(&followed, &wanted, &watch)?)
    } else {
        None
    };

    if let Some(states) = &states
        && is_shown
    {
        let branches = pages::branches(&block, &path.motion, states, &watch)?;
        let shown = Shown {
            model: &model,
            block: &block,
            path: &path,
            states,
            branches,
            uncondensed: args.uncondensed,
        };

        // An interrupted run leaves no pictures.
        if !job.is_cancelled() {
            write_pages(&shown, report, folder)?;
        }
    }
    job.end();

    let outcome = Outcome {
        model,
        block,
        path,
        steps,
        states,
        is_interrupted: job.is_cancelled(),
    };
    let text = if args.json {
        format!("{}\n", outcome.json(args.modes))
    } else {
        outcome.text()
    };
    print(&text)?;
    Ok(exit_code(
        &outcome.path.motion,
        outcome.states.as_deref(),
        outcome.is_interrupted,
    ))
}

/// What came out.
struct Outcome {
    model: BlockModel,
    block: Block,
    path: BlockPath,
    /// The comparison with stepping, if asked for.
    steps: Option<Comparison>,
    /// What is proved of the states, if asked for.
    states: Option<Vec<ProvedState>>,
    is_interrupted: bool,
}

impl Outcome {
    /// The path, the comparison and the states, for people.
    fn text(&self) -> String {
        let mut out = text_of(&self.model, &self.path);
        if let Some(steps) = &self.steps {
            out += &comparison_text(steps);
        }
        if let Some(states) = &self.states {
            out += &states::text_of(states, &self.path.motion);
        }
        if self.is_interrupted {
            out += INTERRUPTED;
        }
        out
    }

    /// The same for programs, on request with the positions of the nodes.
    fn json(&self, with_nodes: bool) -> Value {
        let mut out = json_of(&self.model, &self.path, self.steps.as_ref());
        out["interrupted"] = json!(self.is_interrupted);
        if let Some(states) = &self.states {
            out["complete_sets"] = states::json_of(states, &self.path.motion);
        }
        if with_nodes {
            out["nodes_mm"] = nodes_json(&self.block);
        }
        out
    }
}

/// Pixels of a PNG for each px of the SVG.
#[cfg(feature = "png")]
const ZOOM: f32 = 2.0;

/// Writes the report and the pictures, each file whole.
fn write_pages(
    shown: &Shown<'_>,
    report: Option<Output>,
    folder: Option<Folder>,
) -> Result<(), CliError> {
    if let Some(file) = report {
        file.write(&shown.report()?.to_html())?;
    }

    let Some(folder) = folder else {
        return Ok(());
    };
    for named in shown.pictures()? {
        let svg = named.picture.to_svg();
        folder.write(&format!("{}.svg", named.name), svg.as_bytes())?;
        #[cfg(feature = "png")]
        folder.write(&format!("{}.png", named.name), &named.picture.to_png(ZOOM)?)?;
    }

    Ok(())
}

fn follow(contact: &Contact, loading: &Loading, job: &Job) -> Result<BlockPath, CliError> {
    let path = BlockPath::follow(contact, loading, &|stretch, motion| {
        let motion = to_f64(motion);
        job.say(format!("stretch {stretch}, motion {motion:.4} mm"));
        job.flow()
    });

    Ok(path?)
}

/// Steps to a little beyond the last event, or to the end of the range.
fn compare(
    contact: &Contact,
    path: &BlockPath,
    step: &Rational,
    job: &Job,
) -> Result<Comparison, CliError> {
    let length = match path.motion.stretches.last() {
        Some(last) => last.stop.as_ref().unwrap_or(&last.start).amount().clone(),
        None => Rational::default(),
    };
    let count: Integer = (length / step).ceil().to_integer() + 1;
    let count = count.to_usize().filter(|&n| n <= MAX_STEPS);
    let expected = "a step with at most 1000000 of them on the path";
    let count = count.ok_or_else(|| CliError::option("step", expected, &step.to_string()))?;

    let steps = step_path(contact, &path.loading, step, count, &|done| {
        job.say(format!("stepping, step {done}"));
        job.flow()
    })?;

    Ok(Comparison::of(&path.motion, &steps))
}

/// The block that the options describe.
fn model(args: &Args) -> Result<BlockModel, CliError> {
    let paper = BlockModel::of_the_paper();

    let mesh = args.mesh.to_ascii_lowercase();
    let mesh = MeshKind::ALL.into_iter().find(|m| m.word() == mesh);
    let expected = "crossed, union-jack, slash or backslash";
    let mesh = mesh.ok_or_else(|| CliError::option("mesh", expected, &args.mesh))?;

    let plane = args.plane.to_ascii_lowercase();
    let plane = Plane::ALL.into_iter().find(|p| p.word() == plane);
    let expected = "stress or strain";
    let plane = plane.ok_or_else(|| CliError::option("plane", expected, &args.plane))?;

    let cells = cells_of(&args.cells);
    let expected = "NXxNY, such as 20x10";
    let cells = cells.ok_or_else(|| CliError::option("cells", expected, &args.cells))?;

    let height = number("height", &args.height)?;
    let cell_length = part(&paper.length(), cells.0);
    let cell_height = part(&height, cells.1);

    Ok(BlockModel {
        cells,
        cell: (cell_length, cell_height),
        mesh,
        plane,
        mass: args.mass(),
        ..paper
    })
}

/// One of n equal parts; for n = 0, which the model refuses, the whole.
fn part(whole: &Rational, n: usize) -> Rational {
    whole / Rational::from_integer(n.max(1).into())
}

fn loading(args: &Args) -> Result<Loading, CliError> {
    let until = args.until.as_deref();
    let until = until.map(|text| number("until", text)).transpose()?;

    Ok(Loading {
        friction: number("mu", &args.mu)?,
        force: number("force", &args.force)?,
        until,
    })
}

fn text_of(model: &BlockModel, path: &BlockPath) -> String {
    let (nx, ny) = model.cells;
    let mesh = model.mesh.word();
    let plane = model.plane.word();
    let mu = to_f64(&path.loading.friction);
    let force = to_f64(&path.loading.force);
    let depth = to_f64(&path.depth);
    let table = stretches::table_of(&path.motion, STEPS);
    let end = end_text(&path.motion);
    let letters = stretches::LETTERS;

    format!(
        "{nx} x {ny} cells, {mesh}, plane {plane}; mu = {mu}; pressed {depth:.6} mm to {force} N, \
         then moved to the left; the tangent points to the right\n\
         {letters}\n\
         {table}\n\
         every event is an exact rational number; (1), (2), (5), (7) verified exactly at both \
         ends; {end}\n"
    )
}

fn comparison_text(comparison: &Comparison) -> String {
    format!(
        "stepping: {} steps in doubles; no step ends in stretches {}; steps inside a stretch with \
         other states: {}; largest difference of a reaction {:.3e} N\n",
        comparison.steps,
        listed(&comparison.skipped),
        listed(&comparison.other_states),
        comparison.reaction
    )
}

fn listed(numbers: &[usize]) -> String {
    if numbers.is_empty() {
        "none".into()
    } else {
        format!("{numbers:?}")
    }
}

fn json_of(model: &BlockModel, path: &BlockPath, steps: Option<&Comparison>) -> Value {
    let intervals = say::path::json_of(&path.motion, STEPS);
    json!({
        "cells": [model.cells.0, model.cells.1],
        "mesh": model.mesh.word(),
        "plane": model.plane.word(),
        "length_mm": model.length().to_string(),
        "height_mm": model.height().to_string(),
        "mu": path.loading.friction.to_string(),
        "force_N": path.loading.force.to_string(),
        "depth_mm": to_f64(&path.depth),
        "pressing": states_json(&path.pressing),
        "intervals": intervals,
        "end": end_text(&path.motion),
        "slides": path.motion.slides(),
        "stepping": steps.map(comparison_json),
    })
}

fn comparison_json(comparison: &Comparison) -> Value {
    json!({
        "steps": comparison.steps,
        "skipped": comparison.skipped,
        "other_states": comparison.other_states,
        "reaction_difference_N": comparison.reaction,
    })
}

/// Positions of the nodes, mm.
fn nodes_json(block: &Block) -> Value {
    let nodes = block.nodes.iter();
    nodes.map(|(x, y)| json!([to_f64(x), to_f64(y)])).collect()
}
