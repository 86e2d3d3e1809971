//! `mceip block --path`: the loading path, stretch by stretch.

mod pages;
mod states;
mod words;

use super::args::Args;
use crate::cli::common::{CliError, exit, print};
use crate::cli::job::Job;
use crate::cli::output::{Folder, Output};
use mceip_engine::report::Table;
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_exact::{Integer, Rational, parse, to_f64};
use mceip_model::ContactState;
use mceip_paper::path::{
    Bound, Comparison, Contact, Equilibrium, Event, Finder, Interval, Loading, LoadingPath,
    PathEnd, step_path,
};
use mceip_paper::{Block, BlockModel, MassKind, MeshKind, Plane};
use num_traits::{Signed, ToPrimitive};
use pages::Shown;
use serde_json::{Value, json};
use states::{State, Wanted};
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::time::Duration;
use words::{causes_text, end_text, motion};

/// Follows the path and prints it.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let (model, loading) = (model(args)?, loading(args)?);
    let step = args.step.as_deref().map(positive_step).transpose()?;
    let at = args
        .at_mu
        .iter()
        .map(|mu| positive("at-mu", mu))
        .collect::<Result<Vec<_>, _>>()?;
    let block = Block::new(&model)?;
    let report = args
        .report
        .as_ref()
        .map(|file| Output::prepare("report", file, &[]))
        .transpose()?;
    let folder = args
        .pictures
        .as_ref()
        .map(|f| Folder::prepare("pictures", f))
        .transpose()?;
    let job = Job::begin("condensing exactly to the contact nodes");
    let Some(contact) = condense(block.clone(), job.cancel())? else {
        job.end();
        return Ok(exit::INTERRUPTED);
    };
    let path = LoadingPath::follow(&contact, &loading, &|stretch, motion| {
        job.say(format!(
            "stretch {stretch}, motion {:.4} mm",
            to_f64(motion)
        ));
        job.flow()
    })?;
    let heard = |step: usize| {
        job.say(format!("stepping, step {step}"));
        job.flow()
    };
    let steps = step
        .as_ref()
        .map(|h| compare(&contact, &path, h, &heard))
        .transpose()?;
    let shows = report.is_some() || folder.is_some();
    let wanted = Wanted {
        uncondensed: args.uncondensed,
        conditions: args.conditions || shows,
        at: &at,
        modes: args.modes || shows,
    };
    let told = |progress: &Progress<'_>| job.say(progress);
    let watch = Watch::new(job.cancel(), &told);
    let states = if args.complete || shows {
        Some(states::of((&block, &contact, &path), &wanted, &watch)?)
    } else {
        None
    };
    if let (true, Some(states)) = (shows, &states) {
        let branches = pages::branches(&block, &path, states, &watch)?;
        let (model, block, path, uncondensed) = (&model, &block, &path, args.uncondensed);
        let shown = Shown {
            model,
            block,
            path,
            states,
            branches,
            uncondensed,
        };
        if !job.is_cancelled() {
            show(&shown, report, folder)?; // an interrupted run leaves no pictures
        }
    }
    job.end();
    print(&if args.json {
        let mut out = json_of(&model, &path, steps.as_ref());
        if let Some(states) = &states {
            out["complete_sets"] = states::json_of(states, &path);
        }
        if args.modes {
            out["nodes_mm"] = block
                .nodes
                .iter()
                .map(|(x, y)| json!([to_f64(x), to_f64(y)]))
                .collect();
        }
        format!("{out}\n")
    } else {
        text_of(&model, &path)
            + &steps.as_ref().map_or(String::new(), comparison_text)
            + &states
                .as_deref()
                .map_or(String::new(), |s| states::text_of(s, &path))
    })?;
    let open = states
        .as_ref()
        .is_some_and(|s| s.iter().any(State::is_open));
    let unproved = matches!(path.end, PathEnd::NoContinuation { proved: false, .. });
    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else if unproved || open {
        exit::UNDECIDED
    } else {
        exit::DONE
    })
}

/// Pixels of a PNG for each px of the SVG.
#[cfg(feature = "png")]
const ZOOM: f32 = 2.0;

/// Writes the report and the pictures, each file whole.
fn show(shown: &Shown<'_>, report: Option<Output>, folder: Option<Folder>) -> Result<(), CliError> {
    if let Some(file) = report {
        file.write(&shown.report()?.to_html())?;
    }
    for named in if folder.is_some() {
        shown.pictures()?
    } else {
        Vec::new()
    } {
        let Some(folder) = &folder else { break };
        folder.write(
            &format!("{}.svg", named.name),
            named.picture.to_svg().as_bytes(),
        )?;
        #[cfg(feature = "png")]
        folder.write(&format!("{}.png", named.name), &named.picture.to_png(ZOOM)?)?;
    }
    Ok(())
}

/// Steps to a little beyond the last event, or to the end of the range.
fn compare(
    contact: &Contact,
    path: &LoadingPath,
    h: &Rational,
    progress: &dyn Fn(usize) -> ControlFlow<()>,
) -> Result<Comparison, CliError> {
    let last = path
        .intervals
        .last()
        .map(|i| i.stop.as_ref().unwrap_or(&i.start).motion().clone());
    let steps: Integer = (last.unwrap_or_default() / h).ceil().to_integer() + 1;
    let count = steps.to_usize().filter(|&n| n <= MAX_STEPS);
    let count = count.ok_or_else(|| {
        option(
            "step",
            "a step with at most 1000000 of them on the path",
            &h.to_string(),
        )
    })?;
    Ok(Comparison::of(
        path,
        &step_path(contact, &path.loading, h, count, progress)?,
    ))
}

/// More steps than anybody waits for.
const MAX_STEPS: usize = 1_000_000;

fn positive_step(text: &str) -> Result<Rational, CliError> {
    number("step", text).and_then(|h| {
        if h.is_positive() {
            Ok(h)
        } else {
            Err(option("step", "a length > 0", text))
        }
    })
}

fn positive(name: &'static str, text: &str) -> Result<Rational, CliError> {
    number(name, text).and_then(|v| {
        if v.is_positive() {
            Ok(v)
        } else {
            Err(option(name, "a number > 0", text))
        }
    })
}

fn comparison_text(c: &Comparison) -> String {
    let list = |v: &[usize]| {
        if v.is_empty() {
            "none".into()
        } else {
            format!("{v:?}")
        }
    };
    format!(
        "stepping: {} steps in doubles; no step ends in stretches {}; steps inside a stretch with \
         other states: {}; largest difference of a reaction {:.3e} N\n",
        c.steps,
        list(&c.skipped),
        list(&c.other_states),
        c.reaction
    )
}

/// The condensation in a thread of its own: it cannot be broken off, but it can be left behind.
fn condense(block: Block, cancel: &Cancel) -> Result<Option<Contact>, CliError> {
    let (send, receive) = std::sync::mpsc::channel();
    std::thread::spawn(move || send.send(Contact::of(&block)));
    loop {
        match receive.recv_timeout(Duration::from_millis(50)) {
            Ok(contact) => return Ok(Some(contact?)),
            Err(std::sync::mpsc::RecvTimeoutError::Timeout) if !cancel.is_requested() => {}
            Err(_) => return Ok(None), // interrupted (or the thread died, which has printed why)
        }
    }
}

fn model(args: &Args) -> Result<BlockModel, CliError> {
    let paper = BlockModel::of_the_paper();
    let word = |text: &str| text.to_ascii_lowercase();
    let mesh = MeshKind::ALL
        .into_iter()
        .find(|m| m.word() == word(&args.mesh));
    let mesh = mesh.ok_or_else(|| {
        option(
            "mesh",
            "crossed, union-jack, slash or backslash",
            &args.mesh,
        )
    })?;
    let plane = Plane::ALL
        .into_iter()
        .find(|p| p.word() == word(&args.plane));
    let plane = plane.ok_or_else(|| option("plane", "stress or strain", &args.plane))?;
    let bad_cells = || option("cells", "NXxNY, such as 20x10", &args.cells);
    let (nx, ny) = args.cells.split_once('x').ok_or_else(bad_cells)?;
    let (nx, ny) = (
        nx.parse().map_err(|_| bad_cells())?,
        ny.parse().map_err(|_| bad_cells())?,
    );
    let mass = if args.lumped {
        MassKind::Lumped
    } else {
        MassKind::Consistent
    };
    let height = number("height", &args.height)?;
    let length = paper.length();
    let cell = |all: &Rational, n: usize| all / Rational::from_integer(n.max(1).into());
    Ok(BlockModel {
        cells: (nx, ny),
        cell: (cell(&length, nx), cell(&height, ny)),
        mesh,
        plane,
        mass,
        ..paper
    })
}

fn loading(args: &Args) -> Result<Loading, CliError> {
    let until = args
        .until
        .as_deref()
        .map(|u| number("until", u))
        .transpose()?;
    Ok(Loading {
        friction: number("mu", &args.mu)?,
        force: number("force", &args.force)?,
        until,
    })
}

fn number(name: &'static str, text: &str) -> Result<Rational, CliError> {
    parse(text).map_err(|_| option(name, "a number", text))
}

fn option(option: &'static str, expected: &'static str, got: &str) -> CliError {
    CliError::Option {
        option,
        expected,
        got: got.chars().take(60).collect(),
    }
}

fn text_of(model: &BlockModel, path: &LoadingPath) -> String {
    let (nx, ny) = model.cells;
    let mut out = String::new();
    let mut line = |text: String| {
        let _ = writeln!(out, "{text}"); // writing to a String does not fail
    };
    let (mesh, plane) = (model.mesh.word(), model.plane.word());
    let [mu, force, depth] = [&path.loading.friction, &path.loading.force, &path.depth].map(to_f64);
    line(format!(
        "{nx} x {ny} cells, {mesh}, plane {plane}; mu = {mu}; pressed {depth:.6} mm to {force} N, \
         then moved to the left"
    ));
    line(
        "nodes from left to right: . stick, < slips to the left (S = 1), > slips to the right (S \
          = -1), o free"
            .into(),
    );
    let mut table = Table::new(&[
        "#",
        "from mm",
        "to mm",
        "nodes",
        "stick",
        "left",
        "right",
        "free",
        "T at start N",
        "event it begins with",
    ]);
    for (k, interval) in path.intervals.iter().enumerate() {
        let [stick, left, right, free] = interval.counts();
        let to = interval.stop.as_ref().map_or("-".into(), motion);
        let mut row = vec![
            k.to_string(),
            motion(&interval.start),
            to,
            interval.picture(),
        ];
        row.extend([stick, left, right, free].map(|c| c.to_string()));
        row.extend([
            format!("{:.6}", to_f64(&interval.start.resultants().0)),
            event_text(&interval.begin),
        ]);
        table.row(row);
    }
    line(table.to_string());
    line(format!(
        "every event is an exact rational number; (1), (2), (5), (7) verified exactly at both \
         ends; {}",
        end_text(path)
    ));
    out
}

fn event_text(event: &Event) -> String {
    let causes = causes_text(&event.causes);
    match event.finder {
        Finder::ActiveSet => causes,
        Finder::OneByOne => format!("{causes} (states found one by one)"),
        Finder::Pivoting => format!("{causes} (states found by pivoting)"),
        Finder::Enumeration => format!("{causes} (states found by trying all)"),
    }
}

fn json_of(model: &BlockModel, path: &LoadingPath, steps: Option<&Comparison>) -> Value {
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
        "intervals": path.intervals.iter().map(interval_json).collect::<Vec<_>>(),
        "end": end_text(path),
        "slides": path.slides(),
        "stepping": steps.map(|c| json!({
            "steps": c.steps,
            "skipped": c.skipped,
            "other_states": c.other_states,
            "reaction_difference_N": c.reaction,
        })),
    })
}

fn interval_json(interval: &Interval) -> Value {
    let [stick, left, right, free] = interval.counts();
    json!({
        "from_mm": to_f64(interval.start.motion()),
        "to_mm": interval.stop.as_ref().map(|s| to_f64(s.motion())),
        "states": states_json(&interval.states),
        "stick": stick,
        "slip_left": left,
        "slip_right": right,
        "free": free,
        "start": equilibrium_json(&interval.start),
        "stop": interval.stop.as_ref().map(equilibrium_json),
        "event": {
            "causes": interval.begin.causes.iter().map(cause_json).collect::<Vec<_>>(),
            "changes": interval.begin.changes
                .iter()
                .map(|c| json!({
                    "node": c.node + 1,
                    "from": state_word(c.from),
                    "to": state_word(c.to),
                }))
                .collect::<Vec<_>>(),
            "tried": interval.begin.tried,
        },
    })
}

fn cause_json(bound: &Bound) -> Value {
    json!({ "node": bound.node() + 1, "what": bound.word() })
}

fn equilibrium_json(at: &Equilibrium) -> Value {
    let (t, n) = at.resultants();
    let reactions: Vec<Value> = at
        .reactions_f64()
        .into_iter()
        .map(|(t, n)| json!([t, n]))
        .collect();
    // bits of the exact motion: its fraction fills pages
    let bits = at.motion().numer().bits() + at.motion().denom().bits();
    json!({
        "motion_bits": bits,
        "resultant_T_N": to_f64(&t),
        "resultant_N_N": to_f64(&n),
        "reactions_T_N": reactions,
    })
}

fn states_json(states: &[ContactState]) -> Vec<&'static str> {
    states.iter().map(|s| state_word(*s)).collect()
}

fn state_word(state: ContactState) -> &'static str {
    match state {
        ContactState::Free => "free",
        ContactState::Stick => "stick",
        ContactState::Slip { sign } => {
            if sign > 0 {
                "slip left"
            } else {
                "slip right"
            }
        }
    }
}
