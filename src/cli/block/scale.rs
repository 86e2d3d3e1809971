//! `mceip block --scale`: the block refined, condensed in doubles by one sparse Cholesky.
//!
//! For each mesh: K in doubles, the condensation A + mu B to the slip nodes, the all-slip solutions
//! of MCEIP-mu, how exact the condensation is, and the complete search on the condensed pencil. The
//! latter proves something of the pencil whose entries are these doubles, not of the mesh.

use super::scale_error::ScaleError;
use crate::cli::common::{CliError, exit, print_answer};
use crate::cli::job::Job;
use crate::cli::output::{Output, make_writable};
use mceip_engine::multistart::{AllSlip, all_slip};
use mceip_engine::reduction::{CondensationResidual, SparseCondensation, SparseCondensed};
use mceip_engine::report::{Table, counted};
use mceip_engine::run::{Cancel, Watch};
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Sparse, from_f64};
use mceip_mcp::linear::Symmetric;
use mceip_model::file::write_problem;
use mceip_model::{Body, ContactState, ModelError, Pencil, Problem, Unknown, Window};
use mceip_paper::{BlockModel, DoubleBlock, DoubleMatrix};
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

/// Slip particles up to which the complete search is tried on the condensed pencil.
const COMPLETE_UP_TO: usize = 80;

/// Patterns of signs on which the condensation is measured, beside one that moves all alike.
const PROBES: usize = 3;

/// A line of the study.
struct StudyRow {
    cells: (usize, usize),
    dofs: usize,
    slip: usize,
    seconds: Seconds,
    /// Entries of the factor.
    entries: usize,
    residual: CondensationResidual,
    all_slip: Vec<AllSlip>,
    complete: String,
}

/// How long each step took.
struct Seconds {
    assembly: f64,
    /// Order of elimination.
    ordering: f64,
    /// Factor and Schur complement.
    factor: f64,
    all_slip: f64,
}

/// Condenses each mesh and prints the table.
pub(super) fn run(scales: &[String], is_json: bool, write: Option<&Path>) -> Result<u8, CliError> {
    let models = scales.iter().map(|text| model(text));
    let models = models.collect::<Result<Vec<_>, _>>()?;
    if let Some(folder) = write {
        make_writable(folder)?;
    }
    let mut outputs = Vec::new();
    for model in &models {
        let (nx, ny) = model.cells;
        let path = write.map(|folder| folder.join(format!("block-{nx}x{ny}.json")));
        outputs.push(Output::prepare_if("write", path.as_deref(), &[])?);
    }

    let job = Job::begin("block");
    let mut rows = Vec::new();
    for (model, output) in models.iter().zip(outputs) {
        match row(model, output, &job)? {
            Some(row) => rows.push(row),
            None => break,
        }
    }
    job.end();

    let json = || json!({ "scale": rows.iter().map(StudyRow::json).collect::<Vec<Value>>() });
    print_answer(is_json, json, || text_of(&rows))?;

    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else {
        exit::DONE
    })
}

/// `NXxNY` cells of the paper's block.
pub(super) fn model(text: &str) -> Result<BlockModel, CliError> {
    let expected = "NXxNY, such as 320x160";
    let cells = cells_of(text).ok_or_else(|| CliError::option("scale", expected, text))?;
    Ok(BlockModel::of_the_paper().with_cells(cells.0, cells.1))
}

/// The two numbers of `NXxNY`.
pub(super) fn cells_of(text: &str) -> Option<(usize, usize)> {
    let (nx, ny) = text.split_once('x')?;
    Some((nx.parse().ok()?, ny.parse().ok()?))
}

/// 17 of every 20 cells, as in Fig. 3: the first nodes from the left slip with S = 1, the others
/// are free.
pub(super) fn states(nx: usize) -> Vec<ContactState> {
    let slip = (17 * nx / 20).max(1);
    vec![ContactState::Slip { sign: 1 }; slip]
}

/// Symmetric K or M of a block in doubles.
pub(super) fn symmetric(what: &'static str, m: &DoubleMatrix) -> Result<Symmetric, ScaleError> {
    let matrix = Symmetric::new(m.order, m.entries.iter().copied());
    matrix.map_err(|source| ScaleError::Matrix { what, source })
}

/// One mesh; `None` if interrupted before its condensation was done.
fn row(
    model: &BlockModel,
    output: Option<Output>,
    job: &Job,
) -> Result<Option<StudyRow>, CliError> {
    let (nx, ny) = model.cells;
    let say = |what: &str| job.say(format!("{nx} x {ny} cells: {what}"));
    let clock = Instant::now();

    say("assembling");
    let block = DoubleBlock::new(model).map_err(ScaleError::from)?;
    let stiffness = symmetric("K", &block.stiffness)?;
    let assembled = clock.elapsed().as_secs_f64();
    if job.is_cancelled() {
        return Ok(None);
    }

    say("ordering");
    let particles = block.particles(&states(nx));
    let condensation = SparseCondensation::new(stiffness, None, &particles, Some(&block.points))
        .map_err(ScaleError::from)?;
    let ordered = clock.elapsed().as_secs_f64();
    if job.is_cancelled() {
        return Ok(None);
    }

    say("factoring");
    let condensed = condensation.at(0.0).map_err(ScaleError::from)?;
    let factored = clock.elapsed().as_secs_f64();

    say("all-slip solutions");
    let found = all_slip(&condensed.a, &condensed.b);
    let solved = clock.elapsed().as_secs_f64();

    let problem = condensed_problem(model, &condensed)?;
    if let Some(output) = output {
        output.write(&write_problem(&problem))?;
    }

    say("residuals");
    let residual = condensed.residual(PROBES);

    say("complete search of the condensed pencil");
    let complete = complete_text(&problem, condensation.slip_count(), job.cancel());

    Ok(Some(StudyRow {
        cells: model.cells,
        dofs: condensation.dofs(),
        slip: condensation.slip_count(),
        seconds: Seconds {
            assembly: assembled,
            ordering: ordered - assembled,
            factor: factored - ordered,
            all_slip: solved - factored,
        },
        entries: condensation.analysis().factor_entries(),
        residual,
        all_slip: found,
        complete,
    }))
}

/// The condensed pencil, its doubles taken as exact data: another problem than the block's, close
/// to it.
fn condensed_problem(
    model: &BlockModel,
    condensed: &SparseCondensed<'_>,
) -> Result<Problem, ModelError> {
    let order = condensed.a.len();
    let a = exact(order, entries(&condensed.a))?;
    let b = exact(order, entries(&condensed.b))?;
    let pencil = Pencil::new(a, b, Vec::new())?;

    let (nx, ny) = model.cells;
    let name = format!("block of {nx} x {ny} cells, {order} slip, condensed in doubles");
    let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?;

    Ok(problem.named(name))
}

/// A square matrix of doubles as exact numbers.
pub(super) fn exact(
    order: usize,
    entries: impl Iterator<Item = (usize, usize, f64)>,
) -> Result<Sparse, ModelError> {
    let mut exact = Vec::new();
    for (i, j, value) in entries {
        let number = from_f64(value).map_err(|source| ModelError::Number {
            place: format!("matrix in doubles[{i}][{j}]"),
            source,
        })?;
        exact.push((i, j, number));
    }

    Ok(Sparse::from_entries(order, order, exact))
}

/// (row, column, value) of a matrix by rows.
fn entries(rows: &[Vec<f64>]) -> impl Iterator<Item = (usize, usize, f64)> {
    let rows = rows.iter().enumerate();
    rows.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, value)| (i, j, *value)))
}

/// What the complete search says of the condensed pencil.
fn complete_text(problem: &Problem, slip: usize, cancel: &Cancel) -> String {
    if slip > COMPLETE_UP_TO {
        return format!("not tried (n_s > {COMPLETE_UP_TO})");
    }

    let clock = Instant::now();
    let found = match complete(problem, &CompleteOptions::default(), &Watch::silent(cancel)) {
        Ok(found) => found,
        Err(e) => return format!("failed: {e}"),
    };
    let seconds = clock.elapsed().as_secs_f64();

    let count = found.cover.solutions.len();
    let open = found.cover.open.len() + found.cover.families.len();

    if open == 0 {
        format!("{count}, proved ({seconds:.1} s)")
    } else {
        let open = counted(open, "region");
        format!("{count}, {open} open ({seconds:.1} s)")
    }
}

fn text_of(rows: &[StudyRow]) -> String {
    let mut table = Table::new(&[
        "cells",
        "dofs",
        "n_s",
        "assembly s",
        "ordering s",
        "factor s",
        "factor MiB",
        "balance",
        "change",
        "all-slip mu",
        "residual",
        "complete",
    ]);
    for row in rows {
        table.row(row.cells());
    }

    format!(
        "{table}K, A, B and mu in doubles, uncertified; balance: load left on f by lifted probes; \
         change: what a step of refinement changes of Z,\n\
         both relative. complete: MCEIP-mu of the condensed pencil whose doubles are taken as \
         exact data, not of the mesh.\n"
    )
}

/// Memory for so many doubles.
fn mebibytes(entries: usize) -> f64 {
    entries as f64 * 8.0 / f64::from(1 << 20)
}

/// A list with commas.
fn listed(parts: Vec<String>) -> String {
    if parts.is_empty() {
        "none found".into()
    } else {
        parts.join(", ")
    }
}

impl StudyRow {
    /// A line of the table.
    fn cells(&self) -> Vec<String> {
        let (nx, ny) = self.cells;
        let mut all_slip_mu = Vec::new();
        let mut residuals = Vec::new();
        for solution in &self.all_slip {
            all_slip_mu.push(format!("{:.12}", solution.mu));
            residuals.push(format!("{:.1e}", solution.residual));
        }

        vec![
            format!("{nx}x{ny}"),
            self.dofs.to_string(),
            self.slip.to_string(),
            format!("{:.3}", self.seconds.assembly),
            format!("{:.3}", self.seconds.ordering),
            format!("{:.3}", self.seconds.factor),
            format!("{:.1}", mebibytes(self.entries)),
            format!("{:.1e}", self.residual.balance),
            format!("{:.1e}", self.residual.change),
            listed(all_slip_mu),
            listed(residuals),
            self.complete.clone(),
        ]
    }

    fn json(&self) -> Value {
        let mut all_slip = Vec::new();
        for solution in &self.all_slip {
            all_slip.push(json!({ "mu": solution.mu, "residual": solution.residual }));
        }

        json!({
            "cells": [self.cells.0, self.cells.1],
            "dofs": self.dofs,
            "slip": self.slip,
            "seconds": {
                "assembly": self.seconds.assembly,
                "ordering": self.seconds.ordering,
                "factor": self.seconds.factor,
                "all_slip": self.seconds.all_slip,
            },
            "factor_MiB": mebibytes(self.entries),
            "balance": self.residual.balance,
            "change": self.residual.change,
            "all_slip": all_slip,
            "complete_of_condensed_doubles": self.complete,
        })
    }
}
