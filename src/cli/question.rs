//! Files that are no problem of the format, because a theorem answers them: systems in which
//! nothing slips, and mu = 0.
//!
//! The format refuses both (`spec/formats.md`), and so does everything that binds a certificate to
//! a problem. Commands that answer a question say instead that there is no solution; the proof is
//! section Z.2 of `spec/zero-reaction.md`. For mu = 0 it needs K* positive definite there.

use super::common::{CliError, aside, exit, load, print_answer, text};
use mceip_engine::analysis::conditions::excluded_at;
use mceip_engine::candidate::SOLUTIONS_FORMAT;
use mceip_engine::report::Claimed;
use mceip_exact::Rational;
use mceip_model::file::{SystemFile, folder_of, read_system};
use mceip_model::reduction::mu_family;
use mceip_model::{ModelError, Problem, Unknown};
use num_traits::Zero as _;
use serde_json::json;
use std::path::Path;

/// What a command is asked to solve.
pub(super) enum Question {
    /// A problem of the format.
    Problem(Box<Problem>),
    /// A file without solutions.
    NoSolution(NoSolution),
}

/// Why a file has no solution.
pub(super) struct NoSolution {
    unknown: Unknown,
    /// In words.
    why: &'static str,
}

impl NoSolution {
    /// Prints the complete set, which is empty; says where a certificate was wanted that there is
    /// none.
    pub(super) fn print(&self, is_json: bool, wanted: Option<&Path>) -> Result<u8, CliError> {
        let why = self.why;
        if let Some(path) = wanted {
            let path = path.display();
            aside(&format!(
                "mceip: {path} is not written: a theorem answers, not a certificate"
            ));
        }

        let complete = Claimed::Complete.word();
        let evidence = format!("theorem: {why}");
        let sentence = format!("COMPLETE: no solution, by theorem: {why}\n");
        print_without_solutions(self.unknown, is_json, [complete, &evidence, &sentence])?;
        Ok(exit::DONE)
    }
}

/// Prints a report that lists no solution: its claim and evidence for programs, its sentence for
/// people.
pub(super) fn print_without_solutions(
    unknown: Unknown,
    is_json: bool,
    [claim, evidence, sentence]: [&str; 3],
) -> Result<(), CliError> {
    let report = json!({
        "format": SOLUTIONS_FORMAT,
        "unknown": unknown.word(),
        "claim": claim,
        "evidence": evidence,
        "solutions": [],
    });
    print_answer(is_json, || report, || sentence.to_string())
}

const NOTHING_SLIPS: &str = "no particle is in impending slip (spec/zero-reaction.md, Z.2)";

const WITHOUT_FRICTION: &str =
    "mu = 0, where K* is symmetric, and positive definite (spec/zero-reaction.md, Z.2)";

/// Reads the system of a problem file (`-`: stdin), which may have mu = 0, or no slip particle;
/// `None` for a pencil. Errors name the file.
pub(super) fn load_system(path: &Path) -> Result<Option<SystemFile>, CliError> {
    let source = text("the problem", path)?;
    read_system(&source, folder_of(path)).map_err(|source| CliError::file(path, source))
}

/// Reads a problem file as [`load`] does, or why it has no solution.
pub(super) fn load_question(path: &Path, window: Option<&str>) -> Result<Question, CliError> {
    let refusal = match load(path, window) {
        Ok(problem) => return Ok(Question::Problem(Box::new(problem))),
        Err(refusal) => refusal,
    };

    let CliError::File { source, .. } = &refusal else {
        return Err(refusal);
    };
    let is_frictionless = match source {
        ModelError::NothingSlips => false,
        ModelError::FrictionNotPositive { .. } => true,
        _ => return Err(refusal),
    };

    let Some(file) = load_system(path)? else {
        return Err(refusal);
    };
    if is_frictionless && !is_absent_without_friction(&file)? {
        return Err(refusal);
    }

    let why = if is_frictionless {
        WITHOUT_FRICTION
    } else {
        NOTHING_SLIPS
    };
    Ok(Question::NoSolution(NoSolution {
        unknown: file.unknown,
        why,
    }))
}

/// Is mu = 0 a coefficient without solutions? Of MCEIP-mu it is none that is asked for, and the
/// theorem is one of flat obstacles.
fn is_absent_without_friction(file: &SystemFile) -> Result<bool, CliError> {
    if file.unknown == Unknown::Mu || file.system.curved_particle().is_some() {
        return Ok(false);
    }

    let family = mu_family(&file.system.with_zero_free())?;
    Ok(excluded_at(&family, &Rational::zero())?)
}
