//! Solutions at infinity: those of the reversed problem at the value 0, searched and certified like
//! any others.
//!
//! With s = 1/t the problem (A + tB) x = y becomes (sA + B) x = y/t; at s = 0 it is the limit for
//! large t. `mceip complete --infinity` asks for it.

use super::common::CliError;
use super::output::Output;
use crate::{Cancel, Error, Problem, SolutionSet};
use mceip_engine::report::Claimed;
use mceip_model::Unknown;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The limit of a problem, to be searched.
pub(super) struct LimitProblem(Problem);

/// What there is at infinity.
pub(super) struct AtInfinity {
    problem: Problem,
    /// The reversed problem may be outside the hypotheses (free variables that B does not couple
    /// definitely): that is said.
    set: Result<SolutionSet, Error>,
}

/// The files of the certificate and of the problem that it is for: beside the main certificate.
pub(super) struct Files {
    certificate: Output,
    problem: Output,
}

impl Files {
    /// Prepares CERTIFICATE.infinity.json and CERTIFICATE.infinity-problem.json.
    pub(super) fn prepare(certificate: &Path, input: &Path) -> Result<Files, CliError> {
        let beside = with_ending(certificate, ".infinity.json");
        let problem = with_ending(certificate, ".infinity-problem.json");

        Ok(Files {
            certificate: Output::prepare("certificate", &beside, &[input])?,
            problem: Output::prepare("certificate", &problem, &[input])?,
        })
    }
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

impl LimitProblem {
    /// Of a problem whose window has no upper end.
    pub(super) fn of(problem: &Problem) -> Result<LimitProblem, CliError> {
        if problem.unknown() == Unknown::Eigenvalue {
            let expected = "the unknown lambda2 or mu, whose values have one limit at infinity";
            return Err(CliError::option("infinity", expected, "eigenvalue"));
        }
        let limit = problem.at_infinity()?;
        if problem.window().max().is_some() {
            let expected = "a window without upper end";
            return Err(CliError::option("infinity", expected, "one that ends"));
        }

        Ok(LimitProblem(limit))
    }

    /// All solutions there.
    pub(super) fn search(self, threads: Option<usize>, cancel: &Cancel) -> AtInfinity {
        let mut search = self.0.complete().pieces(1).cancel(cancel);
        if let Some(threads) = threads {
            search = search.threads(threads);
        }

        let set = search.run();
        AtInfinity {
            problem: self.0,
            set,
        }
    }
}

impl AtInfinity {
    /// Is everything at infinity known?
    pub(super) fn is_complete(&self) -> bool {
        self.set.as_ref().is_ok_and(SolutionSet::is_complete)
    }

    /// What there is at infinity, for people.
    pub(super) fn text(&self) -> String {
        match &self.set {
            Ok(set) => set.text_at_infinity(),
            Err(e) => format!("UNDECIDED at infinity: {e}\n"),
        }
    }

    /// What there is at infinity, for programs.
    pub(super) fn json(&self) -> Value {
        let completed = match &self.set {
            Ok(set) => set.as_completed(),
            Err(e) => {
                return json!({ "claim": "solutions", "solutions": [], "reason": e.to_string() });
            }
        };

        let mut solutions = Vec::new();
        for (proved, x) in completed.solutions() {
            let x: Vec<String> = x.iter().map(|x_i| format!("{x_i:.15e}")).collect();
            solutions.push(json!({ "slip": proved.support, "x": x }));
        }

        let cover = &completed.cover;
        let mut families = Vec::new();
        for family in &cover.families {
            families.push(json!({ "slip": family.support }));
        }

        let mut open = Vec::new();
        for region in &cover.open {
            open.push(json!({ "moving": region.moving, "undecided": region.undecided }));
        }

        json!({
            "claim": Claimed::of_cover(cover).word(),
            "reversed_problem_sha256": self.problem.sha256(),
            "solutions": solutions,
            "families": families,
            "open": open,
        })
    }

    /// Writes the problem and, if there is one, the certificate. Without a certificate the problem
    /// shows what was asked.
    pub(super) fn write(&self, files: Files) -> Result<(), CliError> {
        files.problem.write(&self.problem.to_json())?;
        match &self.set {
            Ok(set) => files.certificate.write(&set.proved().file()?),
            Err(_) => Ok(()),
        }
    }
}
