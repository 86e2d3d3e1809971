//! The verified checker of `proofs/`, as a process beside our own checker.
//!
//! `mceip-verified PROBLEM CERTIFICATE` is extracted from Coq (`proofs/README.md`). It is no part
//! of this program: it is built with OCaml, found as a file and run once for each certificate. Its
//! verdicts, by exit code and first word of its output:
//!
//! | exit | output | verdict |
//! |---|---|---|
//! | 0 | `ACCEPTED, VERIFIED: statement` | a theorem stands behind the statement |
//! | 3 | `UNDECIDED, VERIFIED: statement` | the same; the statement names open regions |
//! | 1 | `REJECTED: reason` | refused |
//! | 2 | `MALFORMED: reason` | refused |
//! | 4 | `NOT VERIFIED: kind` | no theorem for this evidence; nothing is said |
//!
//! Everything else (another code, another word, no end in time) is no verdict, which counts as
//! refused. Called by `compare` and `verify`, and by the tests of the three checkers.

mod counts;
mod kinds;
mod verdict;

pub use counts::{KindCounts, VerifiedCounts};
pub use kinds::kinds_of;
pub use verdict::VerifiedVerdict;

use crate::conform::{ProcessEnding, ProcessLimits, run_once};
use crate::error::TestkitError;
use mceip_check::certificate::Certificate;
use mceip_engine::run::Watch;
use mceip_model::Problem;
use mceip_model::file::write_problem;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The environment variable that names the program.
pub const PROGRAM_VARIABLE: &str = "MCEIP_VERIFIED";

/// Where `make -C proofs program` puts the program, from the root of the repository.
const PROGRAM_PLACE: &str = "proofs/mceip-verified";

/// What the program prints on stderr without arguments: by this it is known.
const USAGE: &str = "usage: mceip-verified PROBLEM CERTIFICATE";

/// The certificates of the block take seconds; this is for a machine with much else to do.
const TIME_FOR_ONE: Duration = Duration::from_secs(120);

/// The program `mceip-verified`, found and known to start.
#[derive(Debug, Clone)]
pub struct VerifiedChecker {
    program: PathBuf,
}

impl VerifiedChecker {
    /// The program at `given`; without that, at the path in [`PROGRAM_VARIABLE`]; without that,
    /// `proofs/mceip-verified` in the current folder or the nearest one above it.
    ///
    /// # Errors
    /// [`TestkitError::NoVerifiedChecker`] with the command that builds it, if there is no such
    /// program or what is there is another one.
    pub fn find(given: Option<&Path>) -> Result<VerifiedChecker, TestkitError> {
        let named = given.map(Path::to_path_buf).or_else(named_by_environment);
        let place = named.or_else(beside_the_repository);
        let program = place.unwrap_or_else(|| PathBuf::from(PROGRAM_PLACE));

        let checker = VerifiedChecker { program };
        if checker.is_there() {
            Ok(checker)
        } else {
            Err(TestkitError::NoVerifiedChecker {
                path: checker.program.display().to_string(),
            })
        }
    }

    /// The program's path.
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// Does it start, and complain about missing arguments in its own words?
    fn is_there(&self) -> bool {
        let command = [self.program.display().to_string()];
        let ending = run_once(&command, "", &limits(), &Watch::nobody());
        match ending {
            Ok(ProcessEnding::Ended { complaint, .. }) => complaint.starts_with(USAGE),
            _ => false,
        }
    }

    /// The verdict on a certificate of a problem, by way of two files in a scratch folder.
    ///
    /// Files that cannot be written and a program that does not start are no verdict.
    pub fn judge(&self, problem: &Problem, certificate: &Certificate) -> VerifiedVerdict {
        let problem = write_problem(problem);
        let certificate = certificate.to_json();
        self.judge_texts(&problem, &certificate)
    }

    /// [`judge`](Self::judge) for two texts, whatever they say.
    pub fn judge_texts(&self, problem: &str, certificate: &str) -> VerifiedVerdict {
        let ending = self.run(problem, certificate);
        match ending {
            Ok(ending) => verdict_of(ending),
            Err(e) => VerifiedVerdict::None(e.to_string()),
        }
    }

    fn run(&self, problem: &str, certificate: &str) -> Result<ProcessEnding, TestkitError> {
        let folder = tempfile::tempdir().map_err(|e| TestkitError::scratch(&e))?;
        let problem_path = folder.path().join("problem.json");
        let certificate_path = folder.path().join("certificate.json");
        write(&problem_path, problem)?;
        write(&certificate_path, certificate)?;

        let paths = [&self.program, &problem_path, &certificate_path];
        let command = paths.map(|path| path.display().to_string());
        run_once(&command, "", &limits(), &Watch::nobody())
    }
}

fn verdict_of(ending: ProcessEnding) -> VerifiedVerdict {
    match ending {
        ProcessEnding::Ended {
            code,
            stdout,
            complaint,
        } => {
            let output = String::from_utf8_lossy(&stdout);
            VerifiedVerdict::read(code, &output).unwrap_or_else(|| no_verdict(code, &complaint))
        }
        ProcessEnding::TimedOut => {
            let seconds = TIME_FOR_ONE.as_secs();
            VerifiedVerdict::None(format!("still running after {seconds} s"))
        }
        ProcessEnding::TooLong => VerifiedVerdict::None("output without end".into()),
        ProcessEnding::Interrupted => VerifiedVerdict::None("interrupted".into()),
    }
}

fn limits() -> ProcessLimits {
    ProcessLimits {
        time: TIME_FOR_ONE,
        ..ProcessLimits::default()
    }
}

fn named_by_environment() -> Option<PathBuf> {
    let value = std::env::var_os(PROGRAM_VARIABLE)?;
    (!value.is_empty()).then(|| PathBuf::from(value))
}

/// The program in the current folder's repository.
fn beside_the_repository() -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    let mut places = here.ancestors().map(|folder| folder.join(PROGRAM_PLACE));
    places.find(|place| place.is_file())
}

fn write(path: &Path, text: &str) -> Result<(), TestkitError> {
    std::fs::write(path, text).map_err(|e| TestkitError::scratch(&e))
}

fn no_verdict(code: Option<i32>, complaint: &str) -> VerifiedVerdict {
    let ending = match code {
        Some(code) => format!("exit code {code}"),
        None => "ended by a signal".to_string(),
    };
    VerifiedVerdict::None(format!("{ending}, no verdict; {complaint}"))
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_program_is_not_taken_for_the_verified_checker() {
        for path in ["/nowhere/mceip-verified", "/bin/true", "/"] {
            let refused = VerifiedChecker::find(Some(Path::new(path)));
            let message = refused.unwrap_err().to_string();
            assert!(message.contains(path), "{message}");
            assert!(message.contains("make -C proofs program"), "{message}");
        }
    }
}
