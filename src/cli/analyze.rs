//! `mceip analyze`: the engineer's answer for a mechanical system at one mu.

mod page;

use super::common::{CliError, exit, load, positive, print, require_threads};
use super::job::Job;
use super::output::Output;
use crate::analysis::{Analysis, AnalysisError, Options, analyse};
use crate::model::Body;
use crate::model::file::write_problem;
use std::path::{Path, PathBuf};

/// Arguments of `analyze`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1) of a mechanical system; `mceip convert` makes one.
    file: PathBuf,
    /// Coefficient of friction instead of the file's (reactions in the file are then not used).
    #[arg(long, value_name = "MU", allow_hyphen_values = true)]
    friction: Option<String>,
    /// Values of mu at which divergence is decided to find its ranges; 0 for none (the default
    /// beyond 200 free degrees of freedom).
    #[arg(long, value_name = "N")]
    samples: Option<usize>,
    /// Boxes that may be used to bound the critical mu from below.
    #[arg(long, default_value_t = Options::default().limits.boxes)]
    boxes: usize,
    /// Write every certificate and its problem into this folder, for `mceip check`.
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Write the answers with their evidence and the modes as one HTML page that needs no network.
    #[arg(long, value_name = "OUT")]
    report: Option<PathBuf>,
    /// Threads (default: all cores). The answer does not depend on it.
    #[arg(long)]
    threads: Option<usize>,
    /// Print mceip-analysis/1.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let Body::System(system) = problem.body() else {
        return Err(AnalysisError::NotASystem.into());
    };
    let given = args
        .friction
        .as_deref()
        .map(|t| positive("friction", t))
        .transpose()?;
    let friction = given
        .or_else(|| system.friction().cloned())
        .ok_or(AnalysisError::NoFriction)?;
    require_threads(args.threads)?;
    let usual = if system.free_dofs().len() > SAMPLED_FREE {
        0
    } else {
        Options::default().samples
    };
    let samples = args.samples.unwrap_or(usual);
    if samples > MAX_SAMPLES {
        return Err(CliError::Option {
            option: "samples",
            expected: "0 to 10000",
            got: samples.to_string(),
        });
    }
    if let Some(folder) = &args.certificates {
        writable(folder)?;
    }
    let report = args
        .report
        .as_deref()
        .map(|path| Output::prepare("report", path, &[&args.file]))
        .transpose()?;
    let mut options = Options {
        samples,
        threads: args.threads,
        ..Options::default()
    };
    options.limits.boxes = args.boxes;
    let job = Job::begin("reading");
    let name = problem.name.clone();
    let analysis = job.watched(|watch| analyse(name, system, &friction, &options, watch))?;
    job.end();
    let paths = match &args.certificates {
        Some(folder) => write_proofs(folder, &analysis, &args.file)?,
        None => Vec::new(),
    };
    if let Some(output) = report {
        output.write(&page::page(&analysis, &paths))?;
    }
    print(&if args.json {
        format!("{}\n", analysis.to_json(&paths))
    } else {
        text(&analysis, &paths)
    })?;
    Ok(match (analysis.interrupted, analysis.is_decided()) {
        (true, _) => exit::INTERRUPTED,
        (false, true) => exit::DONE,
        (false, false) => exit::UNDECIDED,
    })
}

/// More samples than any plot has use for.
const MAX_SAMPLES: usize = 10_000;

/// Free degrees of freedom beyond which the ranges of mu are looked for on request only.
const SAMPLED_FREE: usize = 200;

/// The folder exists and takes files, known before the work starts.
fn writable(folder: &Path) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|e| CliError::write(folder.display(), &e))?;
    tempfile::tempfile_in(folder).map_err(|e| CliError::write(folder.display(), &e))?;
    Ok(())
}

/// Writes NAME.problem.json and NAME.certificate.json for each proof; the certificates' paths.
fn write_proofs(folder: &Path, analysis: &Analysis, input: &Path) -> Result<Vec<String>, CliError> {
    let mut outputs = Vec::new();
    for proof in &analysis.proofs {
        let files = [
            ("problem", write_problem(&proof.problem)),
            ("certificate", proof.certificate.to_json()),
        ];
        for (what, text) in files {
            let path = folder.join(format!("{}.{what}.json", proof.name));
            outputs.push((
                Output::prepare("certificates", &path, &[input])?,
                text,
                path,
                what,
            ));
        }
    }
    let mut paths = Vec::new();
    for (output, text, path, what) in outputs {
        output.write(&text)?;
        if what == "certificate" {
            paths.push(path.display().to_string());
        }
    }
    Ok(paths)
}

fn text(analysis: &Analysis, paths: &[String]) -> String {
    let [dofs, free, slip, stick] = analysis.sizes;
    let name = analysis
        .name
        .as_deref()
        .map_or_else(String::new, |n| format!("{n}: "));
    let mut out = format!(
        "{name}{dofs} degrees of freedom ({free} free), {slip} in impending slip, {stick} stick\n"
    );
    for s in analysis.sentences() {
        out += &format!(
            "{}\n    [{}]\n",
            s.text,
            analysis.evidence_text(&s.evidence, paths)
        );
    }
    if analysis.interrupted {
        out += "INTERRUPTED: what was not done is undecided\n";
    }
    out
}
