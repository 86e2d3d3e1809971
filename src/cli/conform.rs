//! `mceip conform`: somebody else's program against problems with complete exact answers.
//!
//! Each case of the pack, and each random case, is sent to the program on stdin; its report is
//! judged by `mceip_testkit`. The rules are in `spec/conform.md`.

use super::common::{CliError, exit, print};
use super::job::Job;
use super::output::{Output, make};
use mceip_testkit::conform::{
    Flag, Group, Limits, Plan, groups, pack_files, read_pack, run, summarise,
};
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

/// Runs the program on every case and prints the summary, or writes the pack.
pub(super) fn run_command(args: &Args) -> Result<u8, CliError> {
    let groups = match &args.pack {
        None => groups()?,
        Some(folder) => read_pack(folder)?,
    };
    if let Some(folder) = &args.write {
        return write(folder, &pack_files(&groups)?);
    }

    let plan = plan(args, groups)?;
    let markdown = Output::prepare_if("markdown", args.markdown.as_deref(), &[])?;

    let job = Job::begin("cases");
    let outcomes = job.watched(|watch| run(&plan, &args.command, watch))?;
    job.end();

    let summary = summarise(&outcomes);
    let text = if args.json {
        format!("{:#}\n", summary.json(&args.command))
    } else {
        summary.text()
    };
    print(&text)?;
    if let Some(output) = markdown {
        output.write(&summary.markdown(&args.command))?;
    }

    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else if summary.all_correct() {
        exit::DONE
    } else {
        exit::REJECTED
    })
}

/// What is to be run, as the options say.
fn plan(args: &Args, groups: Vec<Group>) -> Result<Plan, CliError> {
    let time = time_limit(args.time_limit)?;
    refuse_threads(args.threads)?;
    let only = args.only.iter().map(|word| flag(word));

    Ok(Plan {
        groups,
        random: args.count,
        seed: args.seed,
        as_pencil: args.as_pencil,
        only: only.collect::<Result<_, _>>()?,
        limits: Limits {
            time,
            ..Limits::default()
        },
        threads: args.threads,
    })
}

fn time_limit(seconds: f64) -> Result<Duration, CliError> {
    let time = Duration::try_from_secs_f64(seconds).ok();
    let positive = time.filter(|time| !time.is_zero());

    positive.ok_or_else(|| CliError::Option {
        option: "time-limit",
        expected: "seconds > 0",
        got: seconds.to_string(),
    })
}

fn refuse_threads(threads: Option<usize>) -> Result<(), CliError> {
    match threads {
        Some(count) if count == 0 || count > MAX_THREADS => Err(CliError::Option {
            option: "threads",
            expected: "1 to 1024",
            got: count.to_string(),
        }),
        _ => Ok(()),
    }
}

fn flag(word: &str) -> Result<Flag, CliError> {
    let expected = "a flag of spec/conform.md";
    Flag::of_word(word).ok_or_else(|| CliError::option("only", expected, word))
}

/// Each file appears whole; the index last, so that a pack that was cut short is not taken for one.
fn write(folder: &Path, files: &[(String, String)]) -> Result<u8, CliError> {
    make(folder)?;
    let mut bytes = 0;
    for (name, text) in files {
        let output = Output::prepare("write", &folder.join(name), &[])?;
        output.write(text)?;
        bytes += text.len();
    }

    let count = files.len();
    let place = folder.display();
    print(&format!("{count} files, {bytes} bytes, in {place}\n"))?;

    Ok(exit::DONE)
}
