//! `mceip conform`: somebody else's program against problems with complete exact answers.

use super::common::{CliError, exit, print};
use super::job::Job;
use super::output::Output;
use crate::conform::{Flag, Limits, Plan, groups, pack_files, read_pack, run, summarise};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Arguments of `conform`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The program and its arguments, after `--`. For each case it gets a problem (mceip-problem/1)
    /// on stdin and prints a report (mceip-solutions/1) on stdout.
    #[arg(last = true, required_unless_present = "write")]
    command: Vec<String>,
    /// Write the pack to this folder instead of running anything.
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    write: Option<PathBuf>,
    /// Use the pack in this folder instead of the one in the program.
    #[arg(long, value_name = "DIR", conflicts_with = "write")]
    pack: Option<PathBuf>,
    /// Random cases besides those of the pack.
    #[arg(long, default_value_t = 0)]
    count: usize,
    /// Seed of the random cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only cases with this flag (may be given more than once; see spec/conform.md).
    #[arg(long, value_name = "FLAG")]
    only: Vec<String>,
    /// Send mechanical systems as their reduced pencils, for programs that know only those.
    #[arg(long)]
    as_pencil: bool,
    /// Seconds for each case.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 10.0,
        allow_hyphen_values = true
    )]
    time_limit: f64,
    /// Threads (default: all cores). The output does not depend on it.
    #[arg(long)]
    threads: Option<usize>,
    /// Write a report in Markdown to this file.
    #[arg(long, value_name = "OUT")]
    markdown: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// More than any machine has use for.
const MAX_THREADS: usize = 1024;

pub(super) fn run_command(args: &Args) -> Result<u8, CliError> {
    let groups = match &args.pack {
        None => groups()?,
        Some(folder) => read_pack(folder)?,
    };
    if let Some(folder) = &args.write {
        return write(folder, &pack_files(&groups)?);
    }
    let plan = plan(args, groups)?;
    let markdown = args
        .markdown
        .as_ref()
        .map(|path| Output::prepare("markdown", path, &[]))
        .transpose()?;
    let job = Job::begin("cases");
    let outcomes = job.watched(|watch| run(&plan, &args.command, watch))?;
    job.end();
    let summary = summarise(&outcomes);
    print(&if args.json {
        format!("{:#}\n", summary.json(&args.command))
    } else {
        summary.text()
    })?;
    if let Some(output) = markdown {
        output.write(&summary.markdown(&args.command))?;
    }
    Ok(match (job.is_cancelled(), summary.all_correct()) {
        (true, _) => exit::INTERRUPTED,
        (false, true) => exit::DONE,
        (false, false) => exit::REJECTED,
    })
}

fn plan(args: &Args, groups: Vec<crate::conform::Group>) -> Result<Plan, CliError> {
    let limit = Duration::try_from_secs_f64(args.time_limit)
        .ok()
        .filter(|d| !d.is_zero());
    let Some(time) = limit else {
        return Err(CliError::Option {
            option: "time-limit",
            expected: "seconds > 0",
            got: args.time_limit.to_string(),
        });
    };
    if args.threads.is_some_and(|t| t == 0 || t > MAX_THREADS) {
        let got = args.threads.unwrap_or(0).to_string();
        return Err(CliError::Option {
            option: "threads",
            expected: "1 to 1024",
            got,
        });
    }
    let flag = |word: &String| {
        let got = || word.chars().take(60).collect();
        Flag::of_word(word).ok_or_else(|| CliError::Option {
            option: "only",
            expected: "a flag of spec/conform.md",
            got: got(),
        })
    };
    Ok(Plan {
        groups,
        random: args.count,
        seed: args.seed,
        as_pencil: args.as_pencil,
        only: args.only.iter().map(flag).collect::<Result<_, _>>()?,
        limits: Limits {
            time,
            ..Limits::default()
        },
        threads: args.threads,
    })
}

/// Each file appears whole; the index last, so that a pack that was cut short is not taken for one.
fn write(folder: &Path, files: &[(String, String)]) -> Result<u8, CliError> {
    std::fs::create_dir_all(folder).map_err(|e| CliError::write(folder.display(), &e))?;
    let mut bytes = 0;
    for (name, text) in files {
        Output::prepare("write", &folder.join(name), &[])?.write(text)?;
        bytes += text.len();
    }
    print(&format!(
        "{} files, {bytes} bytes, in {}\n",
        files.len(),
        folder.display()
    ))?;
    Ok(exit::DONE)
}
