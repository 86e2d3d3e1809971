//! `mceip block`: the two published states of the polyurethane block, or its whole loading path
//! with pictures and a report.

mod lambda2;
mod path;
pub(super) mod scale;

use super::common::{CliError, exit, print};
use super::job::Job;
use super::output::Output;
use crate::model::file::write_problem;
use crate::report::Table;
use crate::run::{Progress, Watch};
use crate::source::{Block, MassKind, PublishedState};
use crate::testkit::{BlockReport, block_state};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Arguments of `block`.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("loading").args(["path", "report", "pictures"]).multiple(true))]
pub(super) struct Args {
    /// Only this state: 15 or 17 (nodes in impending slip).
    #[arg(long, conflicts_with = "loading")]
    state: Option<u8>,
    /// Lumped instead of consistent mass (plays no part in MCEIP-mu).
    #[arg(long)]
    lumped: bool,
    /// Write problem files and certificates into this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with = "loading")]
    write: Option<PathBuf>,
    /// The quasi-static loading path instead: press, then move to the left, event by event.
    #[arg(long)]
    path: bool,
    /// Coefficient of friction of the path.
    #[arg(
        long,
        default_value = "1.1",
        requires = "loading",
        allow_hyphen_values = true
    )]
    mu: String,
    /// Normal force at the end of the pressing, N.
    #[arg(
        long,
        default_value = "55",
        requires = "loading",
        allow_hyphen_values = true
    )]
    force: String,
    /// Motion at which to stop, mm (default: the last event).
    #[arg(long, requires = "loading", allow_hyphen_values = true)]
    until: Option<String>,
    /// For each stretch with slip the complete set of MCEIP-mu, proved.
    #[arg(long, requires = "loading")]
    complete: bool,
    /// With --complete: check these sets on K itself instead of the exactly condensed pencil
    /// (slower).
    #[arg(long, requires = "loading")]
    uncondensed: bool,
    /// With --complete: from which mu the necessary condition (19) or (20) holds.
    #[arg(long, requires = "loading")]
    conditions: bool,
    /// With --complete: at these mu (one or more, by commas) the complete set of MCEIP-lambda2,
    /// with growth rates.
    #[arg(
        long,
        requires = "loading",
        value_name = "MU",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    at_mu: Vec<String>,
    /// With --complete --json: the mode of each solution over all degrees of freedom.
    #[arg(long, requires = "loading")]
    modes: bool,
    /// The path, every state's answers and pictures as one HTML file (implies --path --complete
    /// --conditions).
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    /// The pictures as SVG files in this folder, as PNG too in a build with the feature png
    /// (implies --path --complete --conditions).
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
    /// Compare the path with ordinary incremental stepping, this many mm a step.
    #[arg(
        long,
        requires = "loading",
        value_name = "MM",
        allow_hyphen_values = true
    )]
    step: Option<String>,
    /// Triangulation of the path's block: crossed, union-jack, slash, backslash.
    #[arg(long, default_value = "crossed", requires = "loading")]
    mesh: String,
    /// Cells along and across the contact side of the path's block (80 mm long).
    #[arg(long, default_value = "20x10", requires = "loading")]
    cells: String,
    /// Height of the path's block, mm.
    #[arg(
        long,
        default_value = "40",
        requires = "loading",
        allow_hyphen_values = true
    )]
    height: String,
    /// Plane stress or strain: stress, strain.
    #[arg(long, default_value = "stress", requires = "loading")]
    plane: String,
    /// A refinement study instead: the paper's block with NXxNY cells, 17 of every 20 contact nodes
    /// in impending slip, condensed in doubles by one sparse Cholesky; several with commas.
    #[arg(long, value_name = "NXxNY", value_delimiter = ',', conflicts_with_all = ["path", "state"])]
    scale: Vec<String>,
    /// MCEIP-lambda2 at this friction (several with commas), by sparse condensation and many
    /// starts: of the published states, or of the meshes of --scale; each solution certified where
    /// the mesh is small enough.
    #[arg(long, value_name = "MU", value_delimiter = ',', conflicts_with_all = ["path", "write"])]
    lambda2: Vec<String>,
    /// Starts of --lambda2.
    #[arg(long, default_value_t = 22, requires = "lambda2")]
    starts: usize,
    /// Seed of the starts of --lambda2.
    #[arg(long, default_value_t = 1, requires = "lambda2")]
    seed: u64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if args.path || args.report.is_some() || args.pictures.is_some() {
        return path::run(args);
    }
    if !args.lambda2.is_empty() {
        return lambda2::run(args);
    }
    if !args.scale.is_empty() {
        return scale::run(&args.scale, args.json, args.write.as_deref());
    }
    let states = published(args.state)?;
    let block = Block::of_the_paper(if args.lumped {
        MassKind::Lumped
    } else {
        MassKind::Consistent
    });
    let job = Job::begin("block");
    let mut reports = Vec::new();
    for state in states {
        if let Some(folder) = &args.write {
            Output::prepare("write", &folder.join("block.json"), &[])?; // writable, before the work
        }
        let told = |progress: &Progress<'_>| job.say(format!("{}: {progress}", state.name()));
        let watch = Watch::new(job.cancel(), &told);
        match block_state(&block, state, &watch)? {
            Some(report) => reports.push(report),
            None => break,
        }
    }
    job.end();
    for report in &reports {
        if let Some(folder) = &args.write {
            write_files(&block, report, folder)?;
        }
        report
            .uncertified
            .iter()
            .for_each(|u| eprintln!("uncertified: {}: {u}", report.state.name()));
        report
            .rejected
            .iter()
            .for_each(|r| eprintln!("DISAGREEMENT: {}: {r}", report.state.name()));
    }
    if args.json {
        print(&format!(
            "{}\n",
            json!({ "states": reports.iter().map(json_of).collect::<Vec<_>>() })
        ))?;
    } else {
        print(&text_of(&reports))?;
    }
    let wrong = reports
        .iter()
        .any(|r| !r.rejected.is_empty() || r.missing > 0);
    let none = reports.iter().any(|r| r.accepted.is_empty());
    let interrupted = job.is_cancelled();
    Ok(if interrupted {
        exit::INTERRUPTED
    } else if wrong {
        exit::REJECTED
    } else if none {
        exit::UNDECIDED
    } else {
        exit::DONE
    })
}

/// The published state named by --state, or both.
fn published(state: Option<u8>) -> Result<Vec<PublishedState>, CliError> {
    match state {
        None => Ok(PublishedState::ALL.to_vec()),
        Some(15) => Ok(vec![PublishedState::FifteenSlip]),
        Some(17) => Ok(vec![PublishedState::SeventeenSlip]),
        Some(other) => Err(CliError::Option {
            option: "state",
            expected: "15 or 17",
            got: other.to_string(),
        }),
    }
}

fn write_files(
    block: &Block,
    report: &BlockReport,
    folder: &std::path::Path,
) -> Result<(), CliError> {
    let name = if report.state == PublishedState::FifteenSlip {
        "block-15-slip"
    } else {
        "block-17-slip"
    };
    let output =
        |suffix: &str| Output::prepare("write", &folder.join(format!("{name}.{suffix}")), &[]);
    output("json")?.write(&write_problem(&report.state.problem(block)?))?;
    match &report.certificate {
        Some(c) => output("certificate.json")?.write(&c.to_json()),
        None => Ok(()),
    }
}

/// The states as a table; `verify` prints the same.
pub(super) fn text_of(reports: &[BlockReport]) -> String {
    let mut table = Table::new(&[
        "block state",
        "mu (certified on K)",
        "paper",
        "difference",
        "slipping",
        "stuck",
        "certificate",
        "all solutions",
    ]);
    for r in reports {
        if r.accepted.is_empty() {
            table.row(vec![
                r.state.name().into(),
                "not found".into(),
                r.state.printed_mu().into(),
            ]);
        }
        for a in &r.accepted {
            let stuck = if a.stuck.is_empty() {
                "none".into()
            } else {
                format!("node {:?} from the left", a.stuck)
            };
            let difference = difference(&a.value, r.state.printed_mu());
            let (n, leaves) = (r.cover.solutions.len(), r.cover.leaves);
            let all = if r.is_complete() {
                format!("{n}, proved ({leaves} leaves)")
            } else {
                format!("{n} proved, some regions open")
            };
            let row = [
                r.state.name(),
                &a.value,
                r.state.printed_mu(),
                &difference,
                &a.slipping.to_string(),
                &stuck,
                "accepted",
                &all,
            ];
            table.row(row.map(ToString::to_string).to_vec());
        }
    }
    table.to_string()
}

/// Ours minus the paper's, and whether the paper's digits come out on rounding.
fn difference(ours: &str, paper: &str) -> String {
    let (Ok(a), Ok(b)) = (ours.parse::<f64>(), paper.parse::<f64>()) else {
        return "?".into();
    };
    let digits = paper.len() - paper.find('.').map_or(paper.len(), |p| p + 1);
    let rounded = format!("{a:.digits$}");
    let verdict = if rounded == paper {
        "same digits".into()
    } else {
        format!("rounds to {rounded}")
    };
    format!("{:+.4} ({verdict})", a - b)
}

fn json_of(r: &BlockReport) -> Value {
    let accepted: Vec<Value> = r
        .accepted
        .iter()
        .map(|a| json!({ "mu": a.value, "slipping": a.slipping, "stuck": a.stuck, "difference": difference(&a.value, r.state.printed_mu()) }))
        .collect();
    json!({
        "state": r.state.name(), "paper_mu": r.state.printed_mu(), "accepted": accepted, "uncertified": r.uncertified,
        "dofs": r.orders.0, "pencil_order": r.orders.1, "condensed_order": r.orders.2, "denominator_bits": r.bits,
        "complete": r.is_complete(), "solutions_in_all": r.cover.solutions.len(), "runs": r.runs, "pivots": r.pivots, "forgeries": r.forgeries, "rejected_forgeries": r.rejected_forgeries,
        "problem_sha256": r.certificate.as_ref().map(|c| c.problem_sha256.clone()),
    })
}
