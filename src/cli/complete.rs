//! `mceip complete`: all solutions in a window, with a proof that there are no others.

use super::common::{CliError, exit, load, print, require_threads, text};
use super::infinity::{AtInfinity, Files};
use super::job::Job;
use super::output::Output;
use crate::certificate::Certificate;
use crate::certify::Certifier;
use crate::check::{AcceptedCover, OpenRegion, SolutionFamily};
use crate::exact::enclosing_decimals;
use crate::model::Problem;
use crate::reduction::reduce;
use crate::report::{Claimed, Listed, Report, solutions_json};
use crate::run::Watch;
use crate::search::complete::{Completed, Options, Shard, complete, resume};
use std::path::PathBuf;

/// Arguments of `complete`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1).
    file: PathBuf,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end).
    #[arg(long, allow_hyphen_values = true)]
    window: Option<String>,
    /// Write the certificate to this file; after an interrupt it holds what is left open.
    #[arg(long, value_name = "OUT")]
    certificate: Option<PathBuf>,
    /// Go on with a certificate that leaves regions open (after an interrupt, or a shard).
    #[arg(long, value_name = "CERTIFICATE")]
    resume: Option<PathBuf>,
    /// Say as well what there is at infinity, the limit of the pencil for large values (window
    /// without upper end); with --certificate OUT proved in OUT.infinity.json, for the reversed
    /// problem OUT.infinity-problem.json.
    #[arg(long)]
    infinity: bool,
    /// Search part i of n of the pieces and leave the others open; `mceip merge` joins the parts.
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,
    /// Pieces the window is cut into; more of them for more shards.
    #[arg(long, default_value_t = Options::default().pieces)]
    pieces: usize,
    /// Threads (default: all cores). The certificate does not depend on it.
    #[arg(long)]
    threads: Option<usize>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, args.window.as_deref())?;
    let shard = args.shard.as_deref().map(parse_shard).transpose()?;
    require_threads(args.threads)?;
    if args.pieces == 0 || args.pieces > MAX_PIECES {
        return Err(CliError::Option {
            option: "pieces",
            expected: "1 to 100000",
            got: args.pieces.to_string(),
        });
    }
    if args.infinity && problem.window().max().is_some() {
        return Err(CliError::Option {
            option: "infinity",
            expected: "a window without upper end",
            got: "one that ends".into(),
        });
    }
    let earlier = args.resume.as_ref().map(|path| read(path)).transpose()?;
    let output = args
        .certificate
        .as_ref()
        .map(|path| Output::prepare("certificate", path, &[&args.file]))
        .transpose()?;
    let files = args
        .certificate
        .as_ref()
        .filter(|_| args.infinity)
        .map(|path| Files::prepare(path, &args.file))
        .transpose()?;
    let job = Job::begin("searching");
    let options = Options {
        pieces: args.pieces,
        threads: args.threads,
        shard,
        ..Options::default()
    };
    let completed = job.watched(|watch| match &earlier {
        None => complete(&problem, &options, watch),
        Some(certificate) => resume(&problem, certificate, &options, watch),
    })?;
    let beyond = if args.infinity {
        Some(AtInfinity::search(
            &problem,
            &options,
            &Watch::silent(job.cancel()),
        )?)
    } else {
        None
    };
    job.end();
    let out = if args.json {
        let mut report = report_json(&problem, &completed)?;
        if let Some(beyond) = &beyond {
            report["at_infinity"] = beyond.json();
        }
        format!("{report}\n")
    } else {
        solutions_text(&problem, &completed.cover)
            + &beyond.as_ref().map_or_else(String::new, AtInfinity::text)
    };
    print(&out)?;
    if let (Some(beyond), Some(files)) = (&beyond, files) {
        beyond.write(files)?;
    }
    if let Some(output) = output {
        output.write(&completed.certificate.to_json())?;
    }
    let is_complete =
        completed.is_complete() && beyond.as_ref().is_none_or(AtInfinity::is_complete);
    Ok(match (job.is_cancelled(), is_complete) {
        (_, true) => exit::DONE,
        (true, false) => exit::INTERRUPTED,
        (false, false) => exit::UNDECIDED,
    })
}

/// Reads a certificate; errors name the file.
pub(super) fn read(path: &std::path::Path) -> Result<Certificate, CliError> {
    Certificate::from_json(&text("the certificate", path)?).map_err(|source| CliError::File {
        path: path.display().to_string(),
        source,
    })
}

fn parse_shard(given: &str) -> Result<Shard, CliError> {
    let bad = || CliError::Option {
        option: "shard",
        expected: "i/n with 1 <= i <= n",
        got: given.chars().take(60).collect(),
    };
    let (i, n) = given.split_once('/').ok_or_else(bad)?;
    let (i, n) = (
        i.parse::<usize>().map_err(|_| bad())?,
        n.parse::<usize>().map_err(|_| bad())?,
    );
    if i >= 1 && i <= n {
        Ok(Shard {
            index: i - 1,
            count: n,
        })
    } else {
        Err(bad())
    }
}

/// What a cover has proved, for people.
pub(super) fn solutions_text(problem: &Problem, cover: &AcceptedCover) -> String {
    let word = problem.unknown().word();
    let mut out = String::new();
    for s in &cover.solutions {
        let (lo, hi) = enclosing_decimals(&s.value, 15);
        out += &format!("solution: {word} in [{lo}, {hi}], slip {:?}\n", s.support);
    }
    for family in cover.families.iter().take(OPEN_SHOWN) {
        out += &format!("family: {}\n", family_text(word, family));
    }
    if cover.families.len() > OPEN_SHOWN {
        out += &format!(
            "family: {} more (see the certificate)\n",
            cover.families.len() - OPEN_SHOWN
        );
    }
    let window = problem.window();
    let max = window
        .max()
        .map_or_else(|| "infinity)".into(), |m| format!("{m}]"));
    let n = cover.solutions.len();
    let mut count = if n == 1 {
        "1 solution".into()
    } else {
        format!("{n} solutions")
    };
    if !cover.families.is_empty() {
        count += &format!(" and {} families of them", cover.families.len());
    }
    let within = format!("in [{}, {max}", window.min());
    if cover.open.is_empty() {
        let what = if n == 0 && cover.families.is_empty() {
            format!("COMPLETE: no solution {within}")
        } else {
            format!("COMPLETE: {count} {within}, and no other")
        };
        return out + &format!("{what}; {} leaves, accepted by the checker\n", cover.leaves);
    }
    for region in cover.open.iter().take(OPEN_SHOWN) {
        out += &format!("open: {}\n", open_text(word, region));
    }
    if cover.open.len() > OPEN_SHOWN {
        out += &format!(
            "open: {} more regions (see the certificate)\n",
            cover.open.len() - OPEN_SHOWN
        );
    }
    out + &format!(
        "UNDECIDED: {count} proved {within}, {} regions open\n",
        cover.open.len()
    )
}

/// More pieces than any machine has use for.
const MAX_PIECES: usize = 100_000;

/// Open regions printed in full.
const OPEN_SHOWN: usize = 20;

fn open_text(word: &str, region: &OpenRegion) -> String {
    let max = region
        .max
        .as_ref()
        .map_or_else(|| "infinity".into(), ToString::to_string);
    format!(
        "{word} in [{}, {max}], moving {:?}, undecided {:?}",
        region.min, region.moving, region.undecided
    )
}

fn family_text(word: &str, f: &SolutionFamily) -> String {
    let (lo, hi) = enclosing_decimals(&f.from, 15);
    let values = match &f.to {
        _ if f.is_point => format!("{word} in [{lo}, {hi}] (one value)"),
        None => format!("every {word} above a value in [{lo}, {hi}]"),
        Some(to) => {
            let (a, b) = enclosing_decimals(to, 15);
            format!("every {word} between values in [{lo}, {hi}] and [{a}, {b}]")
        }
    };
    let how_many = if f.is_alone {
        "one solution at each"
    } else {
        "a cone of solutions"
    };
    format!("{values}, slip {:?}, {how_many}", f.support)
}

/// The complete set as `mceip-solutions/1`.
pub(super) fn report_json(
    problem: &Problem,
    completed: &Completed,
) -> Result<serde_json::Value, CliError> {
    let reduced = reduce(problem)?;
    let certifier = Certifier::new(problem, &reduced.pencil);
    let mut solutions = Vec::new();
    for (proved, x) in completed.solutions() {
        solutions.push(Listed::of_cover(problem, &reduced, &certifier, proved, x));
    }

    let cover = &completed.cover;
    let evidence = format!(
        "certificate of a complete set, {} leaves, {} open, accepted by the checker",
        cover.leaves,
        cover.open.len()
    );
    let claim = Claimed::of_cover(cover);
    Ok(solutions_json(&Report {
        problem,
        reduced: &reduced,
        solutions,
        claim,
        evidence,
        enumeration: None,
        cover: Some(cover),
    }))
}
