//! `mceip solve`: the PATH-style solver with many starts, every claim certified.

use super::common::{CliError, exit, interrupt_flag, load, print, progress_spinner};
use super::output::Output;
use crate::certify::certificate;
use crate::model::{Admissible, Pencil};
use crate::multistart::{Found, Search, multistart_large, support};
use crate::reduction::reduce;
use crate::report::{Listed, Report, solutions_json, solutions_text};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Arguments of `solve`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Also search above and below each value found (the zeta windows of section 4).
    #[arg(long)]
    all: bool,
    /// Number of starts on the whole window.
    #[arg(long, default_value_t = 22)]
    starts: usize,
    /// Seed of the random starts.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Print the linearisations and pivots of the first run.
    #[arg(long)]
    log: bool,
    /// Write the certificate of everything found to this file.
    #[arg(long, value_name = "OUT")]
    certificate: Option<PathBuf>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    if args.starts == 0 {
        return Err(CliError::Option { option: "starts", expected: "at least 1", got: "0".into() });
    }
    let problem = load(&args.file, args.window.as_deref())?;
    let output = args.certificate.as_ref().map(|path| Output::prepare("certificate", path, &[&args.file])).transpose()?;
    let reduced = reduce(&problem)?;
    let admissible = Admissible::new(&reduced.pencil, problem.unknown())?;
    let window_starts = if args.all { Search::default().window_starts } else { 0 };
    let search = Search { starts: args.starts, window_starts, seed: args.seed, ..Search::default() };
    let stop = interrupt_flag();
    let bar = progress_spinner("searching");
    let (found, _) = multistart_large(&admissible, problem.window(), &search, &|found| {
        bar.set_message(format!("{} runs, {} certified solutions", found.runs, found.certified.len()));
        bar.tick();
        if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    bar.finish_and_clear();
    for u in &found.uncertified {
        eprintln!("uncertified: {} = {}: {}", problem.unknown().word(), u.candidate.value, u.reason);
    }
    for support in singular_supports(&reduced.pencil, &found) {
        eprintln!(
            "singular pencil: support {support:?} has more values than its order: every value is an eigenvalue, those listed are examples"
        );
    }
    if args.log {
        eprint!("{}", first_log(&found));
    }
    let claims: Vec<_> = found.certified.iter().map(|c| c.claim.clone()).collect();
    let evidence = format!(
        "{} certified found in {}{} runs (seed {}, {} pivots, {} repeats, {} outside the window, endings {:?}); completeness unknown",
        claims.len(),
        if found.interrupted { "an interrupted search of " } else { "" },
        found.runs,
        args.seed,
        found.pivots,
        found.repeated,
        found.outside,
        found.terminations
    );
    let solutions = claims.iter().map(|c| Listed::of_claim(&problem, &reduced, c)).collect();
    let report = Report { problem: &problem, reduced: &reduced, solutions, complete: false, evidence, enumeration: None };
    print(&if args.json { format!("{}\n", solutions_json(&report)) } else { solutions_text(&report) })?;
    let any = !claims.is_empty();
    if let (Some(output), true) = (output, any) {
        output.write(&certificate(&problem, claims).to_json())?;
    }
    Ok(match (found.interrupted, any) {
        (true, _) => exit::INTERRUPTED,
        (false, true) => exit::DONE,
        (false, false) => exit::UNDECIDED,
    })
}

/// Supports with more certified values than a determinant of their order has roots: it vanishes
/// identically.
fn singular_supports(pencil: &Pencil, found: &Found) -> Vec<Vec<usize>> {
    let mut counts: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for c in &found.certified {
        *counts.entry(support(&c.claim).to_vec()).or_default() += 1;
    }
    counts.into_iter().filter(|(s, count)| *count > s.len() + pencil.free().len()).map(|(s, _)| s).collect()
}

/// Linearisations and pivots of the very first run.
fn first_log(found: &Found) -> String {
    let mut out = String::new();
    let Some(first) = &found.first else { return out };
    for (k, major) in first.log.iter().enumerate() {
        let _ = writeln!(out, "step {k}: merit {:e}, {:?}, proximal {:e}", major.merit, major.step, major.proximal);
        for path in &major.paths {
            let _ = writeln!(out, "  path, {:?} start, ended {:?} at t = {}", path.start, path.end, path.reach);
            for p in &path.pivots {
                let _ = writeln!(out, "    t = {:.12}: {:?} leaves, {:?} enters ({:?})", p.t, p.leaving, p.entering, p.kind);
            }
        }
    }
    let _ = writeln!(out, "ended: {:?}, {:?}, {:?}", first.termination, first.residuals, first.counters);
    out
}
