//! `mceip conform`: somebody else's program against problems with complete exact answers.
//!
//! Each case of the pack, and each random case, is sent to the program on stdin; its report is
//! judged by `mceip_testkit`. Runs that were printed as JSON are compared by `--compare`. The rules
//! are in `spec/conform.md`.

use super::common::{CliError, aside, exit, print, require_count, require_threads, seconds, text};
use super::job::Job;
use super::output::{Output, make};
use crate::picture::{PROFILES, ProfileSeries, profile_picture};
use mceip_engine::report::counted;
use mceip_engine::run::Watch;
use mceip_model::file::{FRACTIONS, write_problem, write_problem_beside_matrices};
use mceip_testkit::conform::{
    Case, CasePack, ConformComparison, ConformPlan, ConformRun, Flag, FlagChoice, Group,
    INDEX_FORMAT, PACK_FORMAT, PACK_VERSION, PackName, ProcessLimits, RunHead, groups,
    measured_difficulty, pack_files, read_pack, run, summarise, tier2,
};
use std::path::{Path, PathBuf};

/// Arguments of `conform`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The program and its arguments, after `--`. For each case it gets a problem (mceip-problem/1)
    /// on stdin and prints a report (mceip-solutions/1) on stdout.
    #[arg(
        last = true,
        required_unless_present_any = ["write", "list", "print", "flags", "compare", "export_mtx"]
    )]
    command: Vec<String>,
    /// Write the pack to this folder instead of running anything.
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    write: Option<PathBuf>,
    /// With --write: 1 for the small cases with exact answers, 2 for those of order 10 to 200,
    /// which takes minutes.
    #[arg(
        long,
        default_value_t = 1,
        value_parser = clap::value_parser!(u8).range(1..=2)
    )]
    tier: u8,
    /// With --write: say of each case how hard it is, by these runs (what --json printed).
    #[arg(long, value_name = "RUN", num_args = 1..)]
    difficulty: Vec<PathBuf>,
    /// Compare runs over the same cases (what --json printed, two or more files): Markdown.
    #[arg(long, value_name = "RUN", num_args = 2.., conflicts_with_all = ["command", "write"])]
    compare: Vec<PathBuf>,
    /// With --compare: write the tables as LaTeX (booktabs) to this file.
    #[arg(long, value_name = "OUT")]
    latex: Option<PathBuf>,
    /// With --compare: draw a performance profile (Dolan and Moré 2002) to this file.
    #[arg(long, value_name = "OUT")]
    svg: Option<PathBuf>,
    /// Write each case to a folder of its own in this one: matrices as Matrix Market, the problem
    /// that names them, its answer.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["command", "write", "compare"])]
    export_mtx: Option<PathBuf>,
    /// Print a line for each case: its id, flags and comment.
    #[arg(long, conflicts_with_all = ["command", "write"])]
    list: bool,
    /// Print every flag with the class of bugs that its cases catch.
    #[arg(long, conflicts_with_all = ["command", "write", "list"])]
    flags: bool,
    /// Print the problem of a case, as the program gets it; with --json the whole case with its
    /// answer.
    #[arg(long, value_name = "ID", conflicts_with_all = ["command", "write", "list", "flags"])]
    print: Option<String>,
    /// Use the pack in this folder instead of the one in the program.
    #[arg(long, value_name = "DIR", conflicts_with = "write")]
    pack: Option<PathBuf>,
    /// Random cases besides those of the pack.
    #[arg(long, default_value_t = 0)]
    count: usize,
    /// Seed of the random cases, and of the order of --anonymous.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only this case (may be given more than once).
    #[arg(long, value_name = "ID", conflicts_with = "write")]
    case: Vec<String>,
    /// Only cases with this flag (may be given more than once; see --flags).
    #[arg(long, value_name = "FLAG")]
    only: Vec<String>,
    /// No case with this flag (may be given more than once).
    #[arg(long, value_name = "FLAG")]
    except: Vec<String>,
    /// Send the cases in a random order (--seed), under names that do not tell which they are.
    #[arg(long)]
    anonymous: bool,
    /// Send mechanical systems as their reduced pencils, for programs that know only those.
    #[arg(long)]
    as_pencil: bool,
    /// Start the program once (for each thread) and send it a problem a line; it answers each with
    /// its report in one line. For programs that take long to start.
    #[arg(long, conflicts_with_all = ["write", "list", "print", "flags"])]
    lines: bool,
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

/// More random cases than any program is told apart by.
const MAX_RANDOM: u64 = 1_000_000;

/// Runs the program on every case and prints the summary; or writes the pack, or prints from it.
pub(super) fn run_command(args: &Args) -> Result<u8, CliError> {
    refuse_strays(args)?;
    if args.flags {
        return print_flags();
    }
    if !args.compare.is_empty() {
        return compare(args);
    }

    let mut pack = match &args.pack {
        Some(folder) => read_pack(folder)?,
        None => CasePack {
            name: PackName::of_tier(args.tier),
            groups: if args.tier == 1 { groups()? } else { tier2()? },
        },
    };
    if let Some(folder) = &args.write {
        say_difficulties(args, &mut pack)?;
        let job = Job::begin_with_nothing_to_keep("cases");
        let answered = job.watched(|watch| pack_files(&pack, watch));
        job.end();
        let mut files = companions();
        files.extend(answered?);
        return write(folder, &files);
    }

    let CasePack { name, mut groups } = pack;
    select(&mut groups, "case", &args.case)?;
    if args.list {
        return print_list(args, &groups);
    }
    if let Some(id) = &args.print {
        select(&mut groups, "print", std::slice::from_ref(id))?;
        return print_cases(args, &groups);
    }
    if let Some(folder) = &args.export_mtx {
        return export(args, folder, &groups);
    }

    let plan = plan(args, groups)?;
    let markdown = Output::prepare_if("markdown", args.markdown.as_deref(), &[])?;

    let job = Job::begin("cases");
    let outcomes = job.watched(|watch| run(&plan, &args.command, watch))?;
    job.end();
    if outcomes.is_empty() && !job.is_cancelled() {
        let (option, words) = match &args.only[..] {
            [] => ("except", &args.except),
            _ => ("only", &args.only),
        };
        let expected = "flags that leave a case to run (with --case, --count, --only, --except)";
        return Err(CliError::option(option, expected, &words.join(" ")));
    }

    let summary = summarise(&outcomes);
    let head = RunHead {
        command: &args.command,
        version: env!("CARGO_PKG_VERSION"),
        pack: &name,
        settings: &settings(args),
    };
    let text = if args.json {
        format!("{:#}\n", summary.json(&head))
    } else {
        summary.text()
    };
    if let Some(output) = markdown {
        output.write(&summary.markdown(&head))?;
    }
    print(&text)?;

    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else if summary.all_correct() {
        exit::DONE
    } else {
        exit::REJECTED
    })
}

/// What a reader of a report has to know of the run: version, cases, options.
fn settings(args: &Args) -> String {
    let mut words = vec![concat!("mceip ", env!("CARGO_PKG_VERSION")).to_owned()];
    match &args.pack {
        None => words.push("the pack of the program".into()),
        Some(folder) => words.push(format!("the pack in {}", folder.display())),
    }

    for (option, given) in [
        ("--case", &args.case),
        ("--only", &args.only),
        ("--except", &args.except),
    ] {
        for word in given {
            words.push(format!("{option} {word}"));
        }
    }
    if args.count > 0 {
        words.push(format!("--count {} --seed {}", args.count, args.seed));
    }
    if args.anonymous {
        words.push(format!("--anonymous --seed {}", args.seed));
    }
    if args.as_pencil {
        words.push("--as-pencil".into());
    }
    if args.lines {
        words.push("--lines".into());
    }

    words.push(format!("--time-limit {}", args.time_limit));
    words.join("; ")
}

/// What is to be run, as the options say.
fn plan(args: &Args, groups: Vec<Group>) -> Result<ConformPlan, CliError> {
    let time = seconds("time-limit", args.time_limit)?;
    require_count("count", args.count as u64, 0..=MAX_RANDOM)?;
    require_threads(args.threads)?;

    Ok(ConformPlan {
        groups,
        random: args.count,
        seed: args.seed,
        anonymous: args.anonymous,
        as_pencil: args.as_pencil,
        by_lines: args.lines,
        choice: choice(args)?,
        limits: ProcessLimits {
            time,
            ..ProcessLimits::default()
        },
        threads: args.threads,
    })
}

/// The cases that --only and --except leave.
fn choice(args: &Args) -> Result<FlagChoice, CliError> {
    Ok(FlagChoice {
        only: flags("only", &args.only)?,
        except: flags("except", &args.except)?,
    })
}

fn flags(option: &'static str, words: &[String]) -> Result<Vec<Flag>, CliError> {
    let expected = "a flag that --flags lists";
    let flag =
        |word: &String| Flag::of_word(word).ok_or_else(|| CliError::option(option, expected, word));
    words.iter().map(flag).collect()
}

/// Leaves the cases with these ids, in the order of the pack; without ids all.
///
/// # Errors
/// An id that no case has; `option` is where it was given.
fn select(groups: &mut [Group], option: &'static str, ids: &[String]) -> Result<(), CliError> {
    if ids.is_empty() {
        return Ok(());
    }

    for id in ids {
        let mut drafts = groups.iter().flat_map(|group| &group.drafts);
        if !drafts.any(|draft| draft.id == *id) {
            let expected = "the id of a case, as --list prints it";
            return Err(CliError::option(option, expected, id));
        }
    }

    for group in groups {
        group.drafts.retain(|draft| ids.contains(&draft.id));
    }
    Ok(())
}

fn print_flags() -> Result<u8, CliError> {
    for flag in Flag::ALL {
        print(&format!("{:<16} {}\n", flag.word(), flag.note()))?;
    }

    Ok(exit::DONE)
}

/// A line for each case that `--only` and `--except` leave.
fn print_list(args: &Args, groups: &[Group]) -> Result<u8, CliError> {
    let choice = choice(args)?;
    for group in groups {
        for draft in &group.drafts {
            let case = Case::answer(draft, args.as_pencil, &Watch::nobody())?;
            if choice.takes(&case.flags) {
                let words: Vec<&str> = case.flags.iter().map(|flag| flag.word()).collect();
                let words = words.join(" ");
                print(&format!("{}  [{words}]  {}\n", case.id, case.comment))?;
            }
        }
    }

    Ok(exit::DONE)
}

fn print_cases(args: &Args, groups: &[Group]) -> Result<u8, CliError> {
    for draft in groups.iter().flat_map(|group| &group.drafts) {
        let case = Case::answer(draft, args.as_pencil, &Watch::nobody())?;
        let text = if args.json {
            format!("{:#}\n", case.json())
        } else {
            format!("{}\n", write_problem(case.problem()))
        };
        print(&text)?;
    }

    Ok(exit::DONE)
}

/// Refuses options that say nothing here. (What `requires` of clap lets pass: it is content where
/// the option that is missing conflicts with one that is given.)
fn refuse_strays(args: &Args) -> Result<(), CliError> {
    if args.write.is_none() {
        if args.tier != 1 {
            let expected = "it with --write only (--pack spec/conformance-pack-2 runs tier 2)";
            return Err(CliError::option("tier", expected, &args.tier.to_string()));
        }
        if let Some(run) = args.difficulty.first() {
            let got = run.to_string_lossy();
            return Err(CliError::option("difficulty", "it with --write only", &got));
        }
    }

    if args.compare.is_empty() {
        for (option, path) in [("latex", &args.latex), ("svg", &args.svg)] {
            if let Some(path) = path {
                let got = path.to_string_lossy();
                return Err(CliError::option(option, "it with --compare only", &got));
            }
        }
    }

    Ok(())
}

/// The runs in these files, each by the name of its file.
fn read_runs(paths: &[PathBuf]) -> Result<Vec<ConformRun>, CliError> {
    let mut runs = Vec::new();
    for path in paths {
        let name = path.file_stem().map(|stem| stem.to_string_lossy());
        let source = text("a run", path)?;
        runs.push(ConformRun::read(&name.unwrap_or_default(), &source)?);
    }
    Ok(runs)
}

/// Says of each case that all runs have how hard it is.
fn say_difficulties(args: &Args, pack: &mut CasePack) -> Result<(), CliError> {
    let runs = read_runs(&args.difficulty)?;
    for draft in pack.groups.iter_mut().flat_map(|group| &mut group.drafts) {
        draft.difficulty = measured_difficulty(&runs, &draft.id);
    }
    Ok(())
}

/// Prints the runs side by side, and writes what else is asked for.
fn compare(args: &Args) -> Result<u8, CliError> {
    let inputs: Vec<&Path> = args.compare.iter().map(PathBuf::as_path).collect();
    let markdown = Output::prepare_if("markdown", args.markdown.as_deref(), &inputs)?;
    let latex = Output::prepare_if("latex", args.latex.as_deref(), &inputs)?;
    let svg = Output::prepare_if("svg", args.svg.as_deref(), &inputs)?;
    if svg.is_some() && inputs.len() > PROFILES {
        let expected = "at most four runs in one picture";
        return Err(CliError::option("svg", expected, &inputs.len().to_string()));
    }

    let comparison = ConformComparison::new(read_runs(&args.compare)?)?;
    let table = comparison.markdown();
    if let Some(output) = markdown {
        output.write(&table)?;
    }
    if let Some(output) = latex {
        output.write(&comparison.latex())?;
    }
    if let Some(output) = svg {
        let profiles = comparison
            .profile()
            .into_iter()
            .map(|profile| ProfileSeries {
                name: profile.name,
                steps: profile.steps,
            });
        let profiles: Vec<ProfileSeries> = profiles.collect();
        output.write(&profile_picture("Performance profile", &profiles).to_svg())?;
    }

    print(&table)?;
    Ok(exit::DONE)
}

/// Writes each case that `--only` and `--except` leave to a folder of its own, by its id.
fn export(args: &Args, folder: &Path, groups: &[Group]) -> Result<u8, CliError> {
    let choice = choice(args)?;
    make(folder)?;
    let mut count = 0;
    let mut fractions = 0;
    let job = Job::begin_with_nothing_to_keep("cases");
    for draft in groups.iter().flat_map(|group| &group.drafts) {
        job.say(&draft.id);
        let case = Case::answer(draft, args.as_pencil, &Watch::nobody())?;
        if !choice.takes(&case.flags) {
            continue;
        }

        let mut files = write_problem_beside_matrices(case.problem());
        files.push(("answer.json", format!("{:#}\n", case.answer_json())));
        let place = folder.join(file_name(&case.id)?);
        make(&place)?;
        for (name, text) in &files {
            fractions += usize::from(text.contains(FRACTIONS));
            Output::prepare("export-mtx", &place.join(name), &[])?.write(text)?;
        }
        count += 1;
    }
    job.end();

    let cases = counted(count, "case");
    print(&format!("{cases} in {}\n", folder.display()))?;
    if fractions > 0 {
        aside(&format!(
            "mceip: {fractions} of the matrices have fractions p/q: `mceip` reads them, \
             scipy.io.mmread and others take p for the number without a word"
        ));
    }
    Ok(exit::DONE)
}

/// The id, if it may be the name of a folder.
fn file_name(id: &str) -> Result<&str, CliError> {
    let has_plain_letters = id
        .chars()
        .all(|c| c.is_ascii_alphanumeric() || "-_".contains(c));
    if has_plain_letters && !id.is_empty() {
        Ok(id)
    } else {
        let expected = "ids of letters, digits, - and _";
        Err(CliError::option("export-mtx", expected, id))
    }
}

/// What makes the folder stand alone: a page for its reader, licences, schemas, version.
fn companions() -> Vec<(String, String)> {
    let version = env!("CARGO_PKG_VERSION");
    let version =
        format!("{PACK_VERSION} ({PACK_FORMAT}, {INDEX_FORMAT}; written by mceip {version})\n");

    let mut files = vec![("VERSION".to_owned(), version)];
    for (name, text) in COMPANIONS {
        files.push((name.to_owned(), text.to_owned()));
    }
    files
}

/// Files of the repository that go into the folder of a pack: name there, content.
const COMPANIONS: [(&str, &str); 8] = [
    (
        "README.md",
        include_str!("../../spec/conformance-pack/README.md"),
    ),
    (
        "CITATION.cff",
        include_str!("../../spec/conformance-pack/CITATION.cff"),
    ),
    ("LICENSE-MIT", include_str!("../../LICENSE-MIT")),
    ("LICENSE-APACHE", include_str!("../../LICENSE-APACHE")),
    (
        "schemas/mceip-problem-1.json",
        include_str!("../../spec/schemas/mceip-problem-1.json"),
    ),
    (
        "schemas/mceip-solutions-1.json",
        include_str!("../../spec/schemas/mceip-solutions-1.json"),
    ),
    (
        "schemas/mceip-pack-1.json",
        include_str!("../../spec/schemas/mceip-pack-1.json"),
    ),
    (
        "schemas/mceip-pack-index-1.json",
        include_str!("../../spec/schemas/mceip-pack-index-1.json"),
    ),
];

/// Each file appears whole; the index last, so that a pack that was cut short is not taken for one.
fn write(folder: &Path, files: &[(String, String)]) -> Result<u8, CliError> {
    make(folder)?;
    make(&folder.join("schemas"))?;
    let mut bytes = 0;
    for (name, text) in files {
        let output = Output::prepare("write", &folder.join(name), &[])?;
        output.write(text)?;
        bytes += text.len();
    }

    let count = counted(files.len(), "file");
    let place = folder.display();
    print(&format!("{count}, {bytes} bytes, in {place}\n"))?;

    Ok(exit::DONE)
}
