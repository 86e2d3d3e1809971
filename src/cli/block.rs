//! `mceip block`: the two published states of the polyurethane block, or its whole loading path
//! with pictures and a report.

mod args;
mod lambda2;
mod path;
mod scale;
pub(super) mod scale_error;

pub(super) use args::Args;

use super::common::{CliError, exit, print};
use super::job::Job;
use super::output::Output;
use args::published;
use mceip_engine::report::Table;
use mceip_engine::run::{Progress, Watch};
use mceip_model::file::write_problem;
use mceip_paper::{Block, MassKind, PublishedState};
use mceip_testkit::{BlockReport, block_state};
use serde_json::{Value, json};

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
        .map(|a| {
            json!({
                "mu": a.value,
                "slipping": a.slipping,
                "stuck": a.stuck,
                "difference": difference(&a.value, r.state.printed_mu()),
            })
        })
        .collect();
    json!({
        "state": r.state.name(),
        "paper_mu": r.state.printed_mu(),
        "accepted": accepted,
        "uncertified": r.uncertified,
        "dofs": r.orders.0,
        "pencil_order": r.orders.1,
        "condensed_order": r.orders.2,
        "denominator_bits": r.bits,
        "complete": r.is_complete(),
        "solutions_in_all": r.cover.solutions.len(),
        "runs": r.runs,
        "pivots": r.pivots,
        "forgeries": r.forgeries,
        "rejected_forgeries": r.rejected_forgeries,
        "problem_sha256": r.certificate.as_ref().map(|c| c.problem_sha256.clone()),
    })
}
