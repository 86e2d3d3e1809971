//! `mceip block`: the two published states of the polyurethane block, or the block with its loading
//! as a file.
//!
//! Without other options each published state is searched for its solution of MCEIP-mu, which is
//! certified on K itself and compared with the paper's number; then for all solutions. `--loads`
//! writes the block and its loads for `mceip path` ([`loads`]), `--scale` refines the mesh
//! ([`scale`]), `--lambda2` looks for growth rates ([`lambda2`]).

mod args;
mod doubles;
mod lambda2;
mod loads;
mod scale;
pub(super) mod scale_error;

pub(super) use args::Args;

use super::common::{CliError, aside, exit, print_answer};
use super::job::Job;
use super::output::Folder;
use args::published;
use mceip_check::Proved;
use mceip_engine::report::{Table, counted};
use mceip_engine::run::{Progress, Watch};
use mceip_model::file::write_problem;
use mceip_paper::{Block, PublishedState};
use mceip_testkit::{BlockReport, block_state};
use serde_json::{Value, json};

/// Runs the command; the options decide which of its four jobs.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if let Some(file) = &args.loads {
        return loads::run(args, file);
    }

    if !args.lambda2.is_empty() {
        return lambda2::run(args);
    }

    if !args.scale.is_empty() {
        return scale::run(&args.scale, args.json, args.write.as_deref());
    }

    published_states(args)
}

/// Treats the published states and prints what came out.
fn published_states(args: &Args) -> Result<u8, CliError> {
    let states = published(args.state)?;
    let folder = Folder::prepare_if("write", args.write.as_deref(), &[])?;
    let block = Block::of_the_paper(args.mass());

    let job = Job::begin("block");
    let reports = treat(&block, &states, &job)?;
    job.end();

    for report in &reports {
        if let Some(folder) = &folder {
            write_files(&block, report, folder)?;
        }

        say_what_failed(report);
    }

    let json = || json!({ "states": reports.iter().map(json_of).collect::<Vec<Value>>() });
    print_answer(args.json, json, || text_of(&reports))?;

    Ok(exit_code(&reports, job.is_cancelled()))
}

/// Treats one state after the other, until interrupted.
fn treat(
    block: &Block,
    states: &[PublishedState],
    job: &Job,
) -> Result<Vec<BlockReport>, CliError> {
    let mut reports = Vec::new();
    for &state in states {
        let show = |progress: &Progress<'_>| job.say(format!("{}: {progress}", state.name()));
        let watch = Watch::new(job.cancel(), &show);
        match block_state(block, state, &watch)? {
            Some(report) => reports.push(report),
            None => break,
        }
    }

    Ok(reports)
}

/// What goes to stderr.
fn say_what_failed(report: &BlockReport) {
    let name = report.state.name();
    for point in &report.uncertified {
        aside(&format!("uncertified: {name}: {point}"));
    }

    for reason in &report.rejected {
        aside(&format!("DISAGREEMENT: {name}: {reason}"));
    }
}

fn exit_code(reports: &[BlockReport], is_interrupted: bool) -> u8 {
    let is_wrong = reports
        .iter()
        .any(|r| !r.rejected.is_empty() || r.missing > 0);
    let misses_solution = reports.iter().any(|r| r.accepted.is_empty());

    if is_interrupted {
        exit::INTERRUPTED
    } else if is_wrong {
        exit::REJECTED
    } else if misses_solution {
        exit::UNDECIDED
    } else {
        exit::DONE
    }
}

/// Writes the problem of a state, and its certificate if there is one.
fn write_files(block: &Block, report: &BlockReport, folder: &Folder) -> Result<(), CliError> {
    let name = match report.state {
        PublishedState::FifteenSlip => "block-15-slip",
        PublishedState::SeventeenSlip => "block-17-slip",
    };

    let problem = write_problem(&report.state.problem(block)?);
    folder.write(&format!("{name}.json"), problem.as_bytes())?;
    if let Some(proved) = &report.certificate {
        let name = format!("{name}.certificate.json");
        folder.write(&name, proved.file()?.as_bytes())?;
    }

    Ok(())
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
    for report in reports {
        let name = report.state.name();
        let printed = report.state.printed_mu();
        if report.accepted.is_empty() {
            table.row(vec![name.into(), "not found".into(), printed.into()]);
        }

        for solution in &report.accepted {
            let stuck: Vec<String> = solution.stuck.iter().map(usize::to_string).collect();
            let stuck = match stuck.as_slice() {
                [] => "none".into(),
                nodes => format!("node {} from the left", nodes.join(", ")),
            };

            table.row(vec![
                name.into(),
                solution.value.clone(),
                printed.into(),
                difference(&solution.value, printed),
                solution.slipping.to_string(),
                stuck,
                "accepted".into(),
                all_solutions(report),
            ]);
        }
    }

    table.to_string()
}

/// What the complete search has proved of a state.
fn all_solutions(report: &BlockReport) -> String {
    let count = report.cover.solutions.len();
    if report.is_complete() {
        let leaves = counted(report.cover.leaves, "leaf");
        format!("{count}, proved ({leaves})")
    } else {
        format!("{count} proved, some regions open")
    }
}

/// Ours minus the paper's, and whether the paper's digits come out on rounding.
fn difference(ours: &str, paper: &str) -> String {
    let (Ok(our_value), Ok(paper_value)) = (ours.parse::<f64>(), paper.parse::<f64>()) else {
        return "?".into();
    };

    let digits = match paper.find('.') {
        Some(point) => paper.len() - (point + 1),
        None => 0,
    };
    let rounded = format!("{our_value:.digits$}");
    let verdict = if rounded == paper {
        "same digits".into()
    } else {
        format!("rounds to {rounded}")
    };

    format!("{:+.4} ({verdict})", our_value - paper_value)
}

fn json_of(report: &BlockReport) -> Value {
    let mut accepted = Vec::new();
    for solution in &report.accepted {
        accepted.push(json!({
            "mu": solution.value,
            "slipping": solution.slipping,
            "stuck": solution.stuck,
            "difference": difference(&solution.value, report.state.printed_mu()),
        }));
    }

    let certificate = report.certificate.as_ref().map(Proved::certificate);
    json!({
        "state": report.state.name(),
        "paper_mu": report.state.printed_mu(),
        "accepted": accepted,
        "uncertified": report.uncertified,
        "dofs": report.orders.0,
        "pencil_order": report.orders.1,
        "condensed_order": report.orders.2,
        "denominator_bits": report.bits,
        "complete": report.is_complete(),
        "solutions_in_all": report.cover.solutions.len(),
        "runs": report.runs,
        "pivots": report.pivots,
        "forgeries": report.forgeries,
        "rejected_forgeries": report.rejected_forgeries,
        "problem_sha256": certificate.map(|c| c.problem_sha256.clone()),
    })
}
