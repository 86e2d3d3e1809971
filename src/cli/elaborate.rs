//! `mceip elaborate FILE CERTIFICATE --out OUT`: a lean certificate with its matrices made anew,
//! for checkers that read the full form; with `--lean` the other way.

use super::common::{CliError, exit, load, text};
use super::job::Job;
use super::output::Output;
use mceip_engine::lean::{LeanError, elaborate_file, shorten_file};
use std::path::PathBuf;

/// Arguments of `elaborate`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Lean certificate (mceip-lean/1); with --lean a full one.
    certificate: PathBuf,
    /// Write the certificate in its other form to this file.
    #[arg(long, value_name = "OUT")]
    out: PathBuf,
    /// Leave the matrices out that can be made anew, and write mceip-lean/1.
    #[arg(long)]
    lean: bool,
}

/// Writes the certificate in its other form. It is not checked.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let source = text("the certificate", &args.certificate)?;
    let inputs = [args.file.as_path(), args.certificate.as_path()];
    let output = Output::prepare("out", &args.out, &inputs)?;

    let job = Job::begin_with_nothing_to_keep("making W and V anew");
    let other = job.watched(|watch| {
        if args.lean {
            let lean = shorten_file(&problem, &source, watch)?;
            lean.ok_or(LeanError::NoAnchors)
        } else {
            elaborate_file(&problem, &source, watch)
        }
    });
    job.end();

    let other = other.map_err(|e| CliError::other_file(&args.certificate, e))?;
    output.write(&other)?;
    Ok(exit::DONE)
}
