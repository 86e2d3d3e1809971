//! What subcommands share: exit codes, errors, reading problems, options that are numbers or
//! windows, printing.

use super::{colour, wrapped};
use mceip_engine::multistart::SearchError;
use mceip_engine::run::MAX_THREADS;
use mceip_exact::{Rational, parse};
use mceip_model::file::{read_from, read_problem, read_problem_file, read_text};
use mceip_model::{ModelError, Problem, Window};
use mceip_oracle::OracleError;
use mceip_testkit::TestkitError;
use num_traits::Signed as _;
use std::io::{ErrorKind, Write as _};
use std::path::Path;
use std::sync::OnceLock;

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
    /// A plain problem or its solution.
    #[error("{path}: {source}")]
    Plain {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: mceip_engine::lcp::FileError,
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
    /// A problem built from options.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The enumerator refuses.
    #[error("{0}")]
    Oracle(#[from] OracleError),
    /// The search refuses.
    #[error("{0}")]
    Search(#[from] SearchError),
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
    /// A table of contact states.
    #[error("{path}: {source}")]
    Contacts {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: mceip_paper::ContactsError,
    },
    /// A table of nodes.
    #[error("{path}: {source}")]
    Nodes {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: mceip_paper::NodesError,
    },
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
    /// A file of CalculiX.
    #[error("{path}: {source}")]
    Calculix {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: mceip_paper::calculix::CalculixError,
    },
    /// A certificate among several.
    #[error("{path}: {source}")]
    Part {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: mceip_engine::search::complete::CompleteError,
    },
    /// The checker refuses as a whole what it has accepted claim by claim.
    #[error("the certificate is refused: {0}")]
    Refused(#[from] mceip_check::Rejected),
    /// The test kit refuses a run.
    #[error(transparent)]
    Testkit(#[from] TestkitError),
    /// The test kit refuses a file: a campaign's state or a replay file.
    #[error("{path}: {source}")]
    TestkitFile {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: TestkitError,
    },
    /// A model of the block was refused.
    #[error("{0}")]
    Source(#[from] mceip_paper::SourceError),
    /// A loading path was not followed.
    #[error("{0}")]
    Path(#[from] mceip_paper::path::PathError),
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
    /// Somebody's report.
    #[error("{path}: {source}")]
    Foreign {
        /// Its path.
        path: String,
        /// What is wrong with it.
        source: mceip_engine::foreign::ForeignError,
    },
    /// A solution of a report does not fit the problem.
    #[error(transparent)]
    BadPoint(#[from] mceip_engine::foreign::BadPoint),
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

    /// A file of a plain problem, or of its solution, that is not what it should be.
    pub(super) fn plain(path: &Path, source: mceip_engine::lcp::FileError) -> CliError {
        CliError::Plain {
            path: path.display().to_string(),
            source,
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
    let read = if path == Path::new("-") {
        read_problem(&text("the problem", path)?, Path::new("."))
    } else {
        read_problem_file(path)
    };

    let problem = read.map_err(|source| CliError::file(path, source))?;

    match window {
        None => Ok(problem),
        Some(text) => Ok(problem.with_window(parse_window(text)?)),
    }
}

/// Reads a text file (`-`: stdin); errors name the file.
pub(super) fn text(what: &'static str, path: &Path) -> Result<String, CliError> {
    let read = if path == Path::new("-") {
        read_stdin(what)
    } else {
        read_text(what, path)
    };

    read.map_err(|source| CliError::file(path, source))
}

/// Stdin, read once and kept: a command may look at it twice, or name it for two of its inputs by
/// mistake.
fn read_stdin(what: &'static str) -> Result<String, ModelError> {
    static TEXT: OnceLock<Result<String, ModelError>> = OnceLock::new();
    let read = TEXT.get_or_init(|| read_from(what, "stdin", std::io::stdin().lock()));
    read.clone()
}

/// `a,b` with b empty or `inf` for infinity.
pub(super) fn parse_window(text: &str) -> Result<Window, CliError> {
    let expected = "a,b with 0 <= a <= b (b may be inf)";
    window_of(text).ok_or_else(|| CliError::option("window", expected, text))
}

fn window_of(text: &str) -> Option<Window> {
    let (min, max) = text.split_once(',')?;
    let max = match max.trim() {
        "" | "inf" => None,
        number => Some(parse(number).ok()?),
    };
    let min = parse(min.trim()).ok()?;

    Window::new(min, max).ok()
}

/// Refuses no threads at all and more than [`MAX_THREADS`]. Says on stderr where the threads wanted
/// are more than the machine gives, or cannot be started: then the default ones do the work.
pub(super) fn require_threads(wanted: Option<usize>) -> Result<(), CliError> {
    let Some(wanted) = wanted else {
        return Ok(());
    };
    if wanted == 0 || wanted > MAX_THREADS {
        let expected = "1 to 1024";
        return Err(CliError::option("threads", expected, &wanted.to_string()));
    }

    let given = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(wanted).build();
    match pool {
        Err(e) => eprintln!(
            "mceip: --threads {wanted}: cannot be started ({e}); the default number of threads is \
             used instead"
        ),
        Ok(_) if wanted > given => eprintln!(
            "mceip: --threads {wanted}: the machine runs {given} at once, which they share"
        ),
        Ok(_) => {}
    }

    Ok(())
}

/// A number given as an option.
pub(super) fn number(option: &'static str, given: &str) -> Result<Rational, CliError> {
    parse(given).map_err(|_| CliError::option(option, "a number", given))
}

/// A part i/n of a run, given as an option: (i - 1, n).
pub(super) fn part(option: &'static str, given: &str) -> Result<(usize, usize), CliError> {
    let expected = "i/n with 1 <= i <= n";
    part_of(given).ok_or_else(|| CliError::option(option, expected, given))
}

/// (i - 1, n) of i/n with 1 <= i <= n.
fn part_of(text: &str) -> Option<(usize, usize)> {
    let (number, count) = text.split_once('/')?;
    let number: usize = number.parse().ok()?;
    let count: usize = count.parse().ok()?;
    let is_part = number >= 1 && number <= count;
    is_part.then(|| (number - 1, count))
}

/// A positive number given as an option.
pub(super) fn positive(option: &'static str, given: &str) -> Result<Rational, CliError> {
    let expected = "a number > 0";
    positive_number(given).ok_or_else(|| CliError::option(option, expected, given))
}

/// The number that a text spells, if it is positive.
pub(super) fn positive_number(text: &str) -> Option<Rational> {
    parse(text).ok().filter(Rational::is_positive)
}

/// Prints to stdout; on a terminal with sentences wrapped and verdicts in colour. A reader that has
/// gone away (a closed pipe) is no error; a full disk is.
pub(super) fn print(text: &str) -> Result<(), CliError> {
    let mut text = wrapped::for_terminal(text);
    if colour::is_wanted() {
        text = colour::coloured(&text);
    }

    let mut out = std::io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());

    match written {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(CliError::write("stdout", &e)),
        _ => Ok(()),
    }
}
