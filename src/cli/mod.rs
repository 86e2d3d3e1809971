//! The program: one file per subcommand, each a library call with an exit code.

mod analyze;
mod block;
mod campaign;
mod certify;
mod check;
mod colour;
mod common;
mod complete;
mod conform;
mod convert;
mod elaborate;
mod enumerate;
mod explain;
mod infinity;
mod job;
mod manual;
mod merge;
mod output;
mod path;
mod pictures;
mod question;
mod reduce;
mod simulate;
mod solve;
mod table1;
mod verify;
mod wrapped;

use clap::error::{ContextKind, ContextValue};
use clap::{Parser, Subcommand};
use common::{CliError, complain, look_at_stdout};
use mceip_check::with_short_numbers;
use std::io::ErrorKind;
use std::process::ExitCode;

/// Complementarity eigenproblems of frictional contact, verified exactly.
///
/// Can a static equilibrium with frictional contact diverge? The program finds t = lambda^2, mu or
/// an eigenvalue of either sign with (A + tB) x = y, y_f = 0, 0 <= x_s _|_ y_s >= 0, and proves
/// what it says.
///
/// Exit codes: 0 done or accepted, 1 rejected or disagreement, 2 bad input, 3 undecided,
/// 130 interrupted.
#[derive(Parser)]
#[command(name = "mceip", version, arg_required_else_help = true)]
struct Cli {
    /// Show no progress on the terminal.
    #[arg(long, global = true)]
    quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// The main job: every embedded problem solved, certified, checked, compared with both oracles.
    Verify(verify::Args),
    /// All solutions of a small problem by the exact enumerator (the oracle).
    Enumerate(enumerate::Args),
    /// Put the parts of a complete search together.
    Merge(merge::Args),
    /// Solutions by the PATH-style solver with many starts, each certified.
    Solve(solve::Args),
    /// All solutions in a window with a proof that there are no others.
    Complete(complete::Args),
    /// The engineer's answer for a mechanical system: divergence at this mu, thresholds, evidence.
    Analyze(analyze::Args),
    /// Turn a solution report (somebody's floats) into a certificate.
    Certify(certify::Args),
    /// Make a problem file from Matrix Market or CalculiX matrices and a table of contact states.
    Convert(convert::Args),
    /// Check a certificate against a problem, exactly.
    Check(check::Args),
    /// A lean certificate with its matrices made anew, or a full one without them.
    Elaborate(elaborate::Args),
    /// Run somebody else's program on problems with complete exact answers.
    Conform(conform::Args),
    /// The two particles of Fig. 1: closed form beside the enumerator.
    Table1(table1::Args),
    /// The polyurethane block of section 5: its two published states.
    Block(block::Args),
    /// From loads to contact states: the quasi-static path of any body, event by event.
    Path(path::Args),
    /// Random problems of many families through all engines, for seconds or for days.
    Campaign(campaign::Args),
    /// The motion in time, beside what certified modes predict.
    Simulate(simulate::Args),
    /// Reduce a mechanical system to its pencil by (10)-(16).
    Reduce(reduce::Args),
    /// What a term, an equation or a reason of rejection means.
    Explain(explain::Args),
    /// Completions for a shell, on standard output.
    Completions(manual::CompletionsArgs),
    /// Manual pages, one for each command.
    Man(manual::ManArgs),
}

impl Command {
    /// Does an interrupt end it at once? The others hear one from when they have something to keep.
    fn has_nothing_to_keep(&self) -> bool {
        match self {
            Command::Merge(_)
            | Command::Convert(_)
            | Command::Check(_)
            | Command::Elaborate(_)
            | Command::Table1(_)
            | Command::Reduce(_)
            | Command::Explain(_)
            | Command::Completions(_)
            | Command::Man(_) => true,
            Command::Verify(_)
            | Command::Enumerate(_)
            | Command::Solve(_)
            | Command::Complete(_)
            | Command::Analyze(_)
            | Command::Certify(_)
            | Command::Conform(_)
            | Command::Block(_)
            | Command::Path(_)
            | Command::Campaign(_)
            | Command::Simulate(_) => false,
        }
    }
}

/// Runs the program on the process's arguments.
pub fn main() -> ExitCode {
    look_at_stdout();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) => return refuse(&e),
    };
    if cli.quiet {
        job::be_quiet();
    }
    if cli.command.has_nothing_to_keep() {
        job::hear_interrupts();
    }

    let result = match cli.command {
        Command::Verify(a) => verify::run(&a),
        Command::Enumerate(a) => enumerate::run(&a),
        Command::Merge(a) => merge::run(&a),
        Command::Solve(a) => solve::run(&a),
        Command::Complete(a) => complete::run(&a),
        Command::Analyze(a) => analyze::run(&a),
        Command::Certify(a) => certify::run(&a),
        Command::Convert(a) => convert::run(&a),
        Command::Elaborate(a) => elaborate::run(&a),
        Command::Check(a) => check::run(&a),
        Command::Conform(a) => conform::run_command(&a),
        Command::Table1(a) => table1::run(&a),
        Command::Block(a) => block::run(&a),
        Command::Path(a) => path::run(&a),
        Command::Campaign(a) => campaign::run(&a),
        Command::Simulate(a) => simulate::run(&a),
        Command::Reduce(a) => reduce::run(&a),
        Command::Explain(a) => explain::run(&a),
        Command::Completions(a) => manual::completions(&a),
        Command::Man(a) => manual::man(&a),
    };

    match result {
        Ok(code) => ExitCode::from(code),
        Err(e) => {
            complain(&with_short_numbers(&e.to_string()));
            ExitCode::from(CliError::EXIT)
        }
    }
}

/// How alike a misspelt word and the one that is meant are at least: one less the share of letters
/// that differ. What clap suggests may be less: for `frobnicate` it has `elaborate`.
const ALIKE: f64 = 0.5;

/// Letters from which on the beginning of a word stands for the word.
const SHORTEST_BEGINNING: usize = 3;

/// The command, value or option that a misspelt or shortened one is nearest to, as a clause;
/// nothing if none is near.
fn meant(e: &clap::Error) -> String {
    // The error about a value names its option too.
    let pairs = [
        (
            ContextKind::InvalidSubcommand,
            ContextKind::SuggestedSubcommand,
        ),
        (ContextKind::InvalidValue, ContextKind::SuggestedValue),
        (ContextKind::InvalidArg, ContextKind::SuggestedArg),
    ];
    let words = |kind: ContextKind| match e.get(kind) {
        Some(ContextValue::String(one)) => std::slice::from_ref(one),
        Some(ContextValue::Strings(several)) => several,
        _ => &[],
    };
    let found = pairs
        .into_iter()
        .find_map(|(given, suggested)| Some((words(given).first()?, words(suggested))));
    let Some((given, suggested)) = found else {
        return String::new();
    };

    let likeness = |word: &String| strsim::normalized_damerau_levenshtein(given, word);
    let is_near = |word: &&String| likeness(word) >= ALIKE || is_beginning(given, word);
    let near = suggested.iter().filter(is_near);
    match near.max_by(|a, b| likeness(a).total_cmp(&likeness(b))) {
        Some(word) => format!("; is {word} meant?"),
        None => String::new(),
    }
}

/// Is what was given the beginning of the word, without the dashes of an option?
fn is_beginning(given: &str, word: &str) -> bool {
    let [given, word] = [given, word].map(|text| text.trim_start_matches('-'));
    given.chars().count() >= SHORTEST_BEGINNING && word.starts_with(given)
}

/// The command whose usage was not kept: the words before its options and arguments.
fn command_of(e: &clap::Error) -> String {
    let usage = match e.get(ContextKind::Usage) {
        Some(ContextValue::StyledStr(usage)) => usage.to_string(),
        _ => String::new(),
    };
    let usage = usage.strip_prefix("Usage: ").unwrap_or(&usage);
    let is_name = |word: &&str| {
        word.chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit())
    };
    let subcommand = usage.split_whitespace().skip(1).take_while(is_name);
    let words: Vec<&str> = ["mceip"].into_iter().chain(subcommand).collect();
    words.join(" ")
}

/// Help and version go to stdout; a usage error is one line on stderr, like all bad input.
fn refuse(e: &clap::Error) -> ExitCode {
    if !e.use_stderr() {
        return match e.print() {
            Err(e) if e.kind() != ErrorKind::BrokenPipe => {
                complain(&CliError::write("stdout", &e).to_string());
                ExitCode::from(CliError::EXIT)
            }
            _ => ExitCode::SUCCESS, // also if the reader has gone away
        };
    }

    // clap's message is its first paragraph; usage and tips follow.
    let text = e.to_string();
    let paragraph = text.lines().take_while(|line| !line.is_empty());
    let lines: Vec<&str> = paragraph.map(str::trim).collect();
    let message = lines.join(" ");

    let message = message.strip_prefix("error: ").unwrap_or(&message);
    let meant = meant(e);
    let command = command_of(e);
    complain(&format!("{message}{meant} (see {command} --help)"));
    ExitCode::from(CliError::EXIT)
}
