//! What subcommands share: exit codes, errors, reading problems, options that are numbers or
//! windows, printing.

use super::{colour, wrapped};
use mceip_engine::multistart::SearchError;
use mceip_engine::run::MAX_THREADS;
use mceip_exact::{Rational, parse};
use mceip_model::file::{folder_of, read_from, read_problem, read_text};
use mceip_model::{ModelError, Problem, RealWindow, Unknown, Window};
use mceip_oracle::OracleError;
use mceip_testkit::TestkitError;
use num_traits::Signed as _;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{ErrorKind, IsTerminal as _, Write as _};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Exit codes (README, and `mceip --help`).
pub(super) mod exit {
    /// Done, or accepted.
    pub(crate) const DONE: u8 = 0;
    /// Rejected, or a disagreement.
    pub(crate) const REJECTED: u8 = 1;
    /// Undecided.
    pub(crate) const UNDECIDED: u8 = 3;
    /// Interrupted; what was found has been printed.
    pub(crate) const INTERRUPTED: u8 = 130;
}

/// Bad input or an output that cannot be written: one line, exit 2.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub(super) enum CliError {
    /// A file.
    #[error("{path}: {source}")]
    File {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: ModelError,
    },
    /// A file of another kind than those of the model.
    #[error("{path}: {source}")]
    OtherFile {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A matrix that is symmetric up to rounding only.
    #[error(
        "E3: expected {what} symmetric, got differences by rounding (at most 10^-12 of the largest \
         entry); --symmetrize takes the mean of {what} and its transpose"
    )]
    RoundedSymmetry {
        /// K or M.
        what: &'static str,
    },
    /// A model with warnings, where none is wanted.
    #[error(
        "--strict: expected a model without warnings, got {}: {}",
        .warnings.len(),
        .warnings.join("; ")
    )]
    Strict {
        /// What looks wrong.
        warnings: Vec<String>,
    },
    /// A problem built from options.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The enumerator refuses.
    #[error("{0}")]
    Oracle(#[from] OracleError),
    /// The search refuses.
    #[error("{0}")]
    Search(#[from] SearchError),
    /// A question of the library is refused.
    #[error(transparent)]
    Question(#[from] crate::Error),
    /// The complete search refuses.
    #[error(transparent)]
    Complete(#[from] mceip_engine::search::complete::CompleteError),
    /// A system is not analysed.
    #[error(transparent)]
    Analysis(#[from] mceip_engine::analysis::AnalysisError),
    /// A motion is not integrated.
    #[error(transparent)]
    Motion(#[from] mceip_motion::MotionError),
    /// A pencil has no motion.
    #[error("simulate: expected a mechanical system (stiffness, mass, friction), got a pencil")]
    SimulatedPencil,
    /// Displacements that are none, or of another body.
    #[error("{path}: expected {expected} numbers, one for each degree of freedom, got {got}")]
    Displacements {
        /// The file.
        path: String,
        /// Degrees of freedom.
        expected: usize,
        /// How many numbers, or what is none.
        got: String,
    },
    /// The checker refuses as a whole what it has accepted claim by claim.
    #[error("the certificate is refused: {0}")]
    Refused(#[from] mceip_check::Rejected),
    /// A certificate has no lean form.
    #[error(transparent)]
    Lean(#[from] mceip_engine::lean::LeanError),
    /// The test kit refuses a run.
    #[error(transparent)]
    Testkit(#[from] TestkitError),
    /// A model of the block was refused.
    #[error("{0}")]
    Source(#[from] mceip_paper::SourceError),
    /// A loading path was not followed.
    #[error(transparent)]
    Path(#[from] mceip_path::PathError),
    /// A picture was not drawn.
    #[cfg(feature = "png")]
    #[error(transparent)]
    Png(#[from] crate::picture::PngError),
    /// A family that does not exist, or one named twice.
    #[error("--family: {0}")]
    Family(TestkitError),
    /// The condensation was refused.
    #[error("{0}")]
    Condensation(#[from] mceip_engine::reduction::CondensationError),
    /// A block that is not condensed in doubles.
    #[error("{0}")]
    Scale(#[from] super::block::scale_error::ScaleError),
    /// An option has a value it cannot have.
    #[error("--{option}: expected {expected}, got {got:?}")]
    Option {
        /// The option.
        option: &'static str,
        /// What it takes.
        expected: &'static str,
        /// What was given.
        got: String,
    },
    /// An option that counts something has a value beyond its limits.
    #[error("--{option}: expected {least} to {most}, got \"{got}\"")]
    Count {
        /// The option.
        option: &'static str,
        /// The smallest value it takes.
        least: u64,
        /// The largest.
        most: u64,
        /// What was given.
        got: u64,
    },
    /// An output cannot be written.
    #[error("cannot write {path}: {reason}")]
    Write {
        /// Its path.
        path: String,
        /// The system's reason.
        reason: ErrorKind,
    },
    /// An output would replace an input.
    #[error("--{option}: expected another file than the input {path}")]
    OutputIsInput {
        /// The option.
        option: &'static str,
        /// The file.
        path: String,
    },
    /// Two outputs in one place.
    #[error("--{option}: expected another file than that of --{other}, {path}")]
    OutputTwice {
        /// The option.
        option: &'static str,
        /// The option that was given the file first.
        other: &'static str,
        /// The file.
        path: String,
    },
    /// A word that no page of the book explains.
    #[error("no page explains {term:?}; {near}")]
    Term {
        /// The word.
        term: String,
        /// What may have been meant.
        near: String,
    },
}

impl CliError {
    /// Exit code for bad input.
    pub(super) const EXIT: u8 = 2;

    /// An option with a value it cannot have; of a long value the first [`SHOWN`] characters.
    pub(super) fn option(option: &'static str, expected: &'static str, got: &str) -> CliError {
        CliError::Option {
            option,
            expected,
            got: got.chars().take(SHOWN).collect(),
        }
    }

    /// A file that is not what it should be.
    pub(super) fn file(path: &Path, source: ModelError) -> CliError {
        CliError::File {
            path: path.display().to_string(),
            source,
        }
    }

    /// Displacements that do not fit the body.
    pub(super) fn displacements(path: &Path, expected: usize, got: String) -> CliError {
        CliError::Displacements {
            path: path.display().to_string(),
            expected,
            got,
        }
    }

    /// A file of another kind that is not what it should be.
    pub(super) fn other_file<E>(path: &Path, source: E) -> CliError
    where
        E: std::error::Error + Send + Sync + 'static,
    {
        CliError::OtherFile {
            path: path.display().to_string(),
            source: Box::new(source),
        }
    }

    /// An output that cannot be written.
    pub(super) fn write(path: impl std::fmt::Display, e: &std::io::Error) -> CliError {
        CliError::Write {
            path: path.to_string(),
            reason: e.kind(),
        }
    }
}

/// Characters of a bad value that a message repeats.
const SHOWN: usize = 60;

/// Reads a problem file (`-`: stdin), with another window if one is given; errors name the file.
pub(super) fn load(path: &Path, window: Option<&str>) -> Result<Problem, CliError> {
    let read = read_problem(&text("the problem", path)?, folder_of(path));
    let problem = read.map_err(|source| CliError::file(path, source))?;

    match window {
        None => Ok(problem),
        Some(text) => {
            let window = parse_window(text, problem.unknown())?;
            Ok(problem.with_real_window(&window))
        }
    }
}

/// Reads a text file (`-`: stdin); errors name the file.
pub(super) fn text(what: &'static str, path: &Path) -> Result<String, CliError> {
    let is_stdin = path == Path::new("-");
    let read = if path.is_file() && !is_stdin {
        read_text(what, path)
    } else {
        read_once(what, path)
    };

    read.map_err(|source| CliError::file(path, source))
}

/// Stdin or a pipe, read once and kept: a command may look at it twice, or name it for two of its
/// inputs by mistake.
fn read_once(what: &'static str, path: &Path) -> Result<String, ModelError> {
    static TEXTS: Mutex<BTreeMap<PathBuf, Result<String, ModelError>>> =
        Mutex::new(BTreeMap::new());
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let read = texts.entry(path.to_owned()).or_insert_with(|| {
        if path == Path::new("-") {
            read_from(what, "stdin", std::io::stdin().lock())
        } else {
            read_text(what, path)
        }
    });
    read.clone()
}

/// `a,b` with b empty or `inf` for infinity; for eigenvalues a may be empty or `-inf`.
pub(super) fn parse_window(text: &str, unknown: Unknown) -> Result<RealWindow, CliError> {
    let begins_below_zero = text.trim_start().starts_with('-');
    let expected = match unknown {
        Unknown::Lambda2 if begins_below_zero => {
            "a,b with 0 <= a <= b (b may be inf; a mode with lambda^2 < 0 does not grow)"
        }
        Unknown::Mu if begins_below_zero => {
            "a,b with 0 <= a <= b (b may be inf; mu is not negative)"
        }
        Unknown::Lambda2 | Unknown::Mu => "a,b with 0 <= a <= b (b may be inf)",
        Unknown::Eigenvalue => {
            "a,b with a <= b and 0 <= b (a may be -inf, b inf; a,0 has the values below 0 from a \
             on)"
        }
    };
    window_of(text, unknown).ok_or_else(|| CliError::option("window", expected, text))
}

fn window_of(text: &str, unknown: Unknown) -> Option<RealWindow> {
    let (min, max) = text.split_once(',')?;
    let max = match max.trim() {
        "" | "inf" => None,
        number => Some(parse(number).ok()?),
    };
    let min = match min.trim() {
        "" | "-inf" => None,
        number => Some(parse(number).ok()?),
    };

    match unknown {
        Unknown::Lambda2 | Unknown::Mu => {
            let window = Window::new(min?, max).ok()?;
            Some(RealWindow::from(&window))
        }
        Unknown::Eigenvalue => RealWindow::new(min, max).ok(),
    }
}

/// Refuses a count that is not within `limits`.
pub(super) fn require_count(
    option: &'static str,
    got: u64,
    limits: RangeInclusive<u64>,
) -> Result<(), CliError> {
    if limits.contains(&got) {
        return Ok(());
    }

    Err(CliError::Count {
        option,
        least: *limits.start(),
        most: *limits.end(),
        got,
    })
}

/// Refuses no threads at all and more than [`MAX_THREADS`]. Says on stderr where the threads wanted
/// are more than the machine gives, or cannot be started: then the default ones do the work.
pub(super) fn require_threads(wanted: Option<usize>) -> Result<(), CliError> {
    let Some(wanted) = wanted else {
        return Ok(());
    };
    require_count("threads", wanted as u64, 1..=MAX_THREADS as u64)?;

    let given = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(wanted).build();
    match pool {
        Err(e) => aside(&format!(
            "mceip: --threads {wanted}: cannot be started ({e}); the default number of threads is \
             used instead"
        )),
        Ok(_) if wanted > given => aside(&format!(
            "mceip: --threads {wanted}: the machine runs {given} at once, which they share"
        )),
        Ok(_) => {}
    }

    Ok(())
}

/// A number given as an option.
pub(super) fn number(option: &'static str, given: &str) -> Result<Rational, CliError> {
    parse(given).map_err(|_| CliError::option(option, "a number", given))
}

/// Parts that a run may have. More than any number of machines has use for.
const MAX_PARTS: usize = 100_000;

/// A time > 0 given as an option, in seconds.
pub(super) fn seconds(option: &'static str, given: f64) -> Result<Duration, CliError> {
    let time = Duration::try_from_secs_f64(given).ok();
    let positive = time.filter(|time| !time.is_zero());
    positive.ok_or_else(|| CliError::option(option, "seconds > 0", &given.to_string()))
}

/// A part i/n of a run, given as an option: (i - 1, n).
pub(super) fn part(option: &'static str, given: &str) -> Result<(usize, usize), CliError> {
    let expected = "i/n with 1 <= i <= n <= 100000";
    part_of(given).ok_or_else(|| CliError::option(option, expected, given))
}

/// (i - 1, n) of i/n with 1 <= i <= n.
fn part_of(text: &str) -> Option<(usize, usize)> {
    let (number, count) = text.split_once('/')?;
    let number: usize = number.parse().ok()?;
    let count: usize = count.parse().ok()?;
    let is_part = number >= 1 && number <= count && count <= MAX_PARTS;
    is_part.then(|| (number - 1, count))
}

/// A positive number given as an option.
pub(super) fn positive(option: &'static str, given: &str) -> Result<Rational, CliError> {
    let expected = "a number > 0";
    positive_number(given).ok_or_else(|| CliError::option(option, expected, given))
}

/// A coefficient of friction in the text of an option, > 0.
pub(super) fn friction_of(option: &'static str, given: &str) -> Result<Rational, CliError> {
    let expected = if given.contains(',') {
        "a coefficient of friction with a decimal point, as 0.5"
    } else {
        "a coefficient of friction > 0 (without friction: a very small one, as 0.000001; held \
         contact states, `mceip analyze --friction 0`)"
    };
    positive_number(given).ok_or_else(|| CliError::option(option, expected, given))
}

/// The number that a text spells, if it is positive.
pub(super) fn positive_number(text: &str) -> Option<Rational> {
    parse(text).ok().filter(Rational::is_positive)
}

/// Was standard output a terminal when the program began?
static STDOUT_WAS_TERMINAL: OnceLock<bool> = OnceLock::new();

/// Looks at standard output before any work: of a terminal that was closed meanwhile the system
/// does not say that it was one.
pub(super) fn look_at_stdout() {
    let _ = STDOUT_WAS_TERMINAL.set(std::io::stdout().is_terminal());
}

/// Prints to stdout, control characters escaped; on a terminal with sentences wrapped and verdicts
/// in colour. A reader that has gone away (a closed pipe or terminal) is no error; a full disk is.
pub(super) fn print(text: &str) -> Result<(), CliError> {
    let mut text = wrapped::for_terminal(&escaped(text));
    if colour::is_wanted() {
        text = colour::coloured(&text);
    }

    let mut out = std::io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());

    let was_terminal = STDOUT_WAS_TERMINAL.get() == Some(&true);
    match written {
        Err(e) if e.kind() != ErrorKind::BrokenPipe && !was_terminal => {
            Err(CliError::write("stdout", &e))
        }
        _ => Ok(()),
    }
}

/// Prints an answer: as a line of JSON, or as a text.
pub(super) fn print_answer(
    is_json: bool,
    json: impl FnOnce() -> Value,
    text: impl FnOnce() -> String,
) -> Result<(), CliError> {
    print(&if is_json {
        format!("{}\n", json())
    } else {
        text()
    })
}

/// A path as a shell reads it back, in a command that is to be copied.
pub(super) fn shell_word(path: &Path) -> String {
    let word = path.display().to_string();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:@%,".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word;
    }

    format!("'{}'", word.replace('\'', r"'\''"))
}

/// Prints a line on stderr, control characters escaped. No answer goes there, so that a stderr that
/// takes nothing (a closed pipe or terminal, a full disk) is no error.
pub(super) fn aside(line: &str) {
    let line = format!("{}\n", escaped(line));
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}

/// Characters of an error that are printed.
const LONGEST_ERROR: usize = 300;

/// Prints an error on stderr; see [`error_line`].
pub(super) fn complain(error: &str) {
    aside(&error_line(error));
}

/// An error as one line, of a long one the beginning and the end.
pub(super) fn error_line(error: &str) -> String {
    let line = format!("mceip: {error}").replace('\n', " ");
    let length = line.chars().count();
    if length <= LONGEST_ERROR {
        return line;
    }

    let end_length = LONGEST_ERROR / 3;
    let gap = " ... ";
    let begin_length = LONGEST_ERROR - end_length - gap.len();
    let begin: String = line.chars().take(begin_length).collect();
    let end: String = line.chars().skip(length - end_length).collect();
    format!("{begin}{gap}{end}")
}

/// The text without characters that act on a terminal: control characters but for ends of line and
/// tabs, and those that turn the direction of what follows. They are spelt as JSON does, so that a
/// JSON text means the same.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        let is_layout = matches!(character, '\n' | '\t');
        let turns_direction = matches!(
            character,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
        );

        if turns_direction || character.is_control() && !is_layout {
            out += &format!("\\u{:04x}", u32::from(character));
        } else {
            out.push(character);
        }
    }

    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_on_a_terminal_is_spelt_out() {
        let name = "a\u{1b}[31m\u{7}\u{7f}\u{9b}\r\u{202e}b";
        let expected = "a\\u001b[31m\\u0007\\u007f\\u009b\\u000d\\u202eb";
        assert_eq!(escaped(name), expected);

        let plain = "µ = 2,\tλ² = 3\n\\u001b";
        assert_eq!(escaped(plain), plain);
    }

    #[test]
    fn a_shell_reads_a_path_back() {
        for (path, word) in [
            ("models/a-1.json", "models/a-1.json"),
            ("a b$(x)", "'a b$(x)'"),
            ("it's", r"'it'\''s'"),
            ("", "''"),
        ] {
            assert_eq!(shell_word(Path::new(path)), word);
        }
    }

    #[test]
    fn a_json_text_means_the_same_when_it_is_escaped() {
        let value = serde_json::json!({ "name": "a\u{1b}\u{7f}\u{202e}\\" });
        let printed = escaped(&format!("{value:#}"));
        assert!(printed.is_ascii());
        let read: serde_json::Value = serde_json::from_str(&printed).unwrap();
        assert_eq!(read, value);
    }
}
