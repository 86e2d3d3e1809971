//! `mceip enumerate`: the oracle.

use super::common::{CliError, exit, interrupt_flag, load, print, progress_bar};
use crate::oracle::enumerate_with;
use crate::reduction::reduce;
use crate::report::{Listed, Report, solutions_json, solutions_text};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Arguments of `enumerate`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, args.window.as_deref())?;
    let reduced = reduce(&problem)?;
    let stop = interrupt_flag();
    let bar = progress_bar(0, "supports");
    let found = enumerate_with(&reduced.pencil, problem.window(), |done, total| {
        bar.set_length(total);
        bar.set_position(done);
        if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    bar.finish_and_clear();
    let evidence = match (found.is_finished(), found.is_complete_list()) {
        (true, true) => format!("complete, by exact enumeration of {} supports", found.supports_total),
        (true, false) => {
            format!("all {} supports examined exactly; wide kernels and singular pencils are named, not described", found.supports_total)
        }
        (false, _) => format!("interrupted after {} of {} supports", found.supports_done, found.supports_total),
    };
    let solutions = found.solutions.iter().map(|s| Listed::of_solution(&problem, &reduced, s)).collect();
    let complete = found.is_complete_list();
    let report = Report { problem: &problem, reduced: &reduced, solutions, complete, evidence, enumeration: Some(&found) };
    print(&if args.json { format!("{}\n", solutions_json(&report)) } else { solutions_text(&report) })?;
    Ok(match (found.is_finished(), complete) {
        (false, _) => exit::INTERRUPTED,
        (true, true) => exit::DONE,
        (true, false) => exit::UNDECIDED, // what is left open has been named
    })
}
