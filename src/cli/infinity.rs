//! Solutions at infinity: those of the reversed problem at the value 0, searched and certified like
//! any others.
//!
//! With s = 1/t the problem (A + tB) x = y becomes (sA + B) x = y/t; at s = 0 it is the limit for
//! large t. `mceip complete --infinity` asks for it.

use super::common::CliError;
use super::output::Output;
use mceip_check::AcceptedCover;
use mceip_engine::reduction::reversed;
use mceip_engine::report::Claimed;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteError, Completed, Options, complete};
use mceip_exact::Rational;
use mceip_model::file::write_problem;
use mceip_model::{Problem, Window};
use num_traits::Zero;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What there is at infinity.
pub(super) struct AtInfinity {
    problem: Problem,
    /// The reversed problem may be outside the hypotheses (free variables that B does not couple
    /// definitely): that is said.
    completed: Result<Completed, CompleteError>,
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

impl AtInfinity {
    /// Searches the reversed problem at the value 0.
    pub(super) fn search(
        problem: &Problem,
        options: &Options,
        watch: &Watch<'_>,
    ) -> Result<AtInfinity, CliError> {
        let zero = Window::new(Rational::zero(), Some(Rational::zero()))?;
        let mut at_zero = reversed(problem)?.with_window(zero);
        let digest = problem.sha256();
        let comment = format!("the limit at infinity of problem {digest}, at the value 0");
        at_zero.comment = Some(comment);

        let options = Options {
            pieces: 1,
            shard: None,
            ..*options
        };
        let completed = complete(&at_zero, &options, watch);

        Ok(AtInfinity {
            problem: at_zero,
            completed,
        })
    }

    /// Is everything at infinity known?
    pub(super) fn is_complete(&self) -> bool {
        self.completed.as_ref().is_ok_and(Completed::is_complete)
    }

    /// What there is at infinity, for people.
    pub(super) fn text(&self) -> String {
        let cover = match &self.completed {
            Ok(completed) => &completed.cover,
            Err(e) => return format!("UNDECIDED at infinity: {e}\n"),
        };

        let mut out = String::new();
        for solution in &cover.solutions {
            out += &format!("at infinity: slip {:?}\n", solution.support);
        }

        for family in &cover.families {
            let support = &family.support;
            out += &format!("at infinity: a cone of solutions, slip {support:?}\n");
        }

        for region in &cover.open {
            out += &format!(
                "at infinity: open, moving {:?}, undecided {:?}\n",
                region.moving, region.undecided
            );
        }

        let verdict = verdict_text(cover);
        let leaves = cover.leaves;
        out += &format!(
            "{verdict}; {leaves} leaves, accepted by the checker for the reversed problem\n"
        );

        out
    }

    /// What there is at infinity, for programs.
    pub(super) fn json(&self) -> Value {
        let completed = match &self.completed {
            Ok(completed) => completed,
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
        files.problem.write(&write_problem(&self.problem))?;
        match &self.completed {
            Ok(completed) => files.certificate.write(&completed.proved.file()?),
            Err(_) => Ok(()),
        }
    }
}

/// Is everything at infinity known, and how much is it?
fn verdict_text(cover: &AcceptedCover) -> String {
    let count = cover.solutions.len() + cover.families.len();
    let open = cover.open.len();

    if open > 0 {
        format!("UNDECIDED at infinity: {count} proved, {open} regions open")
    } else if count == 0 {
        "COMPLETE: nothing at infinity".into()
    } else {
        format!("COMPLETE: {count} at infinity (limits of x, no value of the window), and no other")
    }
}
