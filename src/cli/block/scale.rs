//! `mceip block --scale`: the block refined, condensed in doubles by one sparse Cholesky.

use super::scale_error::ScaleError;
use crate::cli::common::{CliError, exit, print};
use crate::cli::job::Job;
use crate::cli::output::Output;
use mceip_engine::multistart::{AllSlip, all_slip};
use mceip_engine::reduction::{CondensationResidual, SparseCondensation, SparseCondensed};
use mceip_engine::report::Table;
use mceip_engine::run::{Cancel, Watch};
use mceip_engine::search::complete::{Options, complete};
use mceip_exact::{Rational, Sparse, from_f64};
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
struct Row {
    cells: (usize, usize),
    dofs: usize,
    slip: usize,
    /// Assembly, order of elimination, factor and Schur complement, all-slip solutions.
    seconds: [f64; 4],
    /// Entries of the factor.
    entries: usize,
    residual: CondensationResidual,
    all_slip: Vec<AllSlip>,
    complete: String,
}

/// Condenses each mesh and prints the table.
pub(super) fn run(scales: &[String], json: bool, write: Option<&Path>) -> Result<u8, CliError> {
    let models = scales
        .iter()
        .map(|s| model(s))
        .collect::<Result<Vec<_>, _>>()?;
    let mut outputs = Vec::new();
    for m in &models {
        let path = write.map(|w| w.join(format!("block-{}x{}.json", m.cells.0, m.cells.1)));
        outputs.push(
            path.map(|p| Output::prepare("write", &p, &[]))
                .transpose()?,
        ); // writable, before the work
    }
    let job = Job::begin("block");
    let mut rows = Vec::new();
    for (model, output) in models.iter().zip(outputs) {
        let heard = |what: &str| {
            job.say(format!(
                "{} x {} cells: {what}",
                model.cells.0, model.cells.1
            ))
        };
        match row(model, output, job.cancel(), &heard)? {
            Some(row) => rows.push(row),
            None => break,
        }
    }
    job.end();
    print(&if json {
        format!(
            "{}\n",
            json!({ "scale": rows.iter().map(json_of).collect::<Vec<_>>() })
        )
    } else {
        text_of(&rows)
    })?;
    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else {
        exit::DONE
    })
}

/// `NXxNY` cells of the paper's block.
pub(super) fn model(text: &str) -> Result<BlockModel, CliError> {
    let bad = || CliError::Option {
        option: "scale",
        expected: "NXxNY, such as 320x160",
        got: text.chars().take(60).collect(),
    };
    let (nx, ny) = text.split_once('x').ok_or_else(bad)?;
    Ok(BlockModel::of_the_paper().with_cells(
        nx.parse().map_err(|_| bad())?,
        ny.parse().map_err(|_| bad())?,
    ))
}

/// 17 of every 20 cells, as in Fig. 3: the first nodes from the left slip with S = 1, the others
/// are free.
pub(super) fn states(nx: usize) -> Vec<ContactState> {
    vec![ContactState::Slip { sign: 1 }; (17 * nx / 20).max(1)]
}

/// Symmetric K or M of a block in doubles.
pub(super) fn symmetric(what: &'static str, m: &DoubleMatrix) -> Result<Symmetric, ScaleError> {
    Symmetric::new(m.order, m.entries.iter().copied())
        .map_err(|source| ScaleError::Matrix { what, source })
}

/// One mesh; `None` if interrupted before its condensation was done.
fn row(
    model: &BlockModel,
    output: Option<Output>,
    cancel: &Cancel,
    heard: &dyn Fn(&str),
) -> Result<Option<Row>, CliError> {
    let stopped = || cancel.is_requested();
    let clock = Instant::now();
    heard("assembling");
    let block = DoubleBlock::new(model).map_err(ScaleError::from)?;
    let stiffness = symmetric("K", &block.stiffness)?;
    let assembled = clock.elapsed().as_secs_f64();
    if stopped() {
        return Ok(None);
    }
    heard("ordering");
    let particles = block.particles(&states(model.cells.0));
    let condensation = SparseCondensation::new(stiffness, None, &particles, Some(&block.points))
        .map_err(ScaleError::from)?;
    let ordered = clock.elapsed().as_secs_f64();
    if stopped() {
        return Ok(None);
    }
    heard("factoring");
    let condensed = condensation.at(0.0).map_err(ScaleError::from)?;
    let factored = clock.elapsed().as_secs_f64();
    heard("all-slip solutions");
    let found = all_slip(&condensed.a, &condensed.b);
    let solved = clock.elapsed().as_secs_f64();
    let problem = problem(model, &condensed)?;
    if let Some(output) = output {
        output.write(&write_problem(&problem))?;
    }
    heard("residuals");
    let residual = condensed.residual(PROBES);
    heard("complete search of the condensed pencil");
    let complete = closed(&problem, condensation.slip_count(), cancel);
    Ok(Some(Row {
        cells: model.cells,
        dofs: condensation.dofs(),
        slip: condensation.slip_count(),
        seconds: [
            assembled,
            ordered - assembled,
            factored - ordered,
            solved - factored,
        ],
        entries: condensation.analysis().factor_entries(),
        residual,
        all_slip: found,
        complete,
    }))
}

/// The condensed pencil, its doubles taken as exact data: another problem than the block's, close
/// to it.
fn problem(model: &BlockModel, condensed: &SparseCondensed<'_>) -> Result<Problem, ModelError> {
    let number =
        |m: &[Vec<f64>], i: usize, j: usize| -> Result<(usize, usize, Rational), ModelError> {
            let value = from_f64(m[i][j]).map_err(|source| ModelError::Number {
                place: format!("condensed pencil[{i}][{j}]"),
                source,
            })?;
            Ok((i, j, value))
        };
    let exact = |m: &[Vec<f64>]| {
        let n = m.len();
        let entries = (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| number(m, i, j));
        Ok::<Sparse, ModelError>(Sparse::from_entries(
            n,
            n,
            entries.collect::<Result<Vec<_>, _>>()?,
        ))
    };
    let pencil = Pencil::new(exact(&condensed.a)?, exact(&condensed.b)?, Vec::new())?;
    let name = format!(
        "block of {} x {} cells, {} slip, condensed in doubles",
        model.cells.0,
        model.cells.1,
        condensed.a.len()
    );
    Ok(Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?.named(name))
}

/// What the complete search says of the condensed pencil.
fn closed(problem: &Problem, slip: usize, cancel: &Cancel) -> String {
    if slip > COMPLETE_UP_TO {
        return format!("not tried (n_s > {COMPLETE_UP_TO})");
    }
    let clock = Instant::now();
    match complete(problem, &Options::default(), &Watch::silent(cancel)) {
        Err(e) => format!("failed: {e}"),
        Ok(found) => {
            let (n, seconds) = (found.cover.solutions.len(), clock.elapsed().as_secs_f64());
            let open = found.cover.open.len() + found.cover.families.len();
            if open == 0 {
                format!("{n}, proved ({seconds:.1} s)")
            } else {
                format!("{n}, {open} regions open ({seconds:.1} s)")
            }
        }
    }
}

fn text_of(rows: &[Row]) -> String {
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
    for r in rows {
        let mut cells = vec![
            format!("{}x{}", r.cells.0, r.cells.1),
            r.dofs.to_string(),
            r.slip.to_string(),
        ];
        cells.extend(r.seconds[..3].iter().map(|s| format!("{s:.3}")));
        cells.push(format!("{:.1}", mebibytes(r.entries)));
        cells.extend([r.residual.balance, r.residual.change].map(|v| format!("{v:.1e}")));
        let list = |f: &dyn Fn(&AllSlip) -> String| {
            if r.all_slip.is_empty() {
                "none found".into()
            } else {
                r.all_slip.iter().map(f).collect::<Vec<_>>().join(", ")
            }
        };
        cells.extend([
            list(&|s| format!("{:.12}", s.mu)),
            list(&|s| format!("{:.1e}", s.residual)),
            r.complete.clone(),
        ]);
        table.row(cells);
    }
    format!(
        "{table}K, A, B and mu in doubles, uncertified; balance: load left on f by lifted probes; \
         change: what a step of refinement changes of Z,\n\
         both relative. complete: MCEIP-mu of the condensed pencil whose doubles are taken as \
         exact data, not of the mesh.\n"
    )
}

fn mebibytes(entries: usize) -> f64 {
    entries as f64 * 8.0 / f64::from(1 << 20)
}

fn json_of(r: &Row) -> Value {
    json!({
        "cells": [r.cells.0, r.cells.1],
        "dofs": r.dofs,
        "slip": r.slip,
        "seconds": {
            "assembly": r.seconds[0],
            "ordering": r.seconds[1],
            "factor": r.seconds[2],
            "all_slip": r.seconds[3],
        },
        "factor_MiB": mebibytes(r.entries),
        "balance": r.residual.balance,
        "change": r.residual.change,
        "all_slip": r.all_slip
            .iter()
            .map(|s| json!({ "mu": s.mu, "residual": s.residual }))
            .collect::<Vec<_>>(),
        "complete_of_condensed_doubles": r.complete,
    })
}
