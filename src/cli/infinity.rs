//! Solutions at infinity: those of the reversed problem at the value 0, searched and certified like
//! any others.

use super::common::CliError;
use super::output::Output;
use mceip_engine::reduction::reversed;
use mceip_engine::report::Claimed;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteError, Completed, Options, complete};
use mceip_exact::Rational;
use mceip_model::file::write_problem;
use mceip_model::{Problem, Window};
use num_traits::Zero;
use serde_json::json;
use std::path::{Path, PathBuf};

/// What there is at infinity.
pub(super) struct AtInfinity {
    problem: Problem,
    /// The reversed problem may be outside the hypotheses (free variables that B does not couple
    /// definitely): that is said.
    completed: Result<Completed, CompleteError>,
}

/// The files of the certificate and of the problem that it is for: beside the main certificate.
pub(super) struct Files([Output; 2]);

impl Files {
    pub(super) fn prepare(certificate: &Path, input: &Path) -> Result<Files, CliError> {
        let beside = |end: &str| {
            let mut name = certificate.as_os_str().to_owned();
            name.push(end);
            PathBuf::from(name)
        };
        let output = |end: &str| Output::prepare("certificate", &beside(end), &[input]);
        Ok(Files([
            output(".infinity.json")?,
            output(".infinity-problem.json")?,
        ]))
    }
}

impl AtInfinity {
    pub(super) fn search(
        problem: &Problem,
        options: &Options,
        watch: &Watch<'_>,
    ) -> Result<AtInfinity, CliError> {
        let zero = Window::new(Rational::zero(), Some(Rational::zero()))?;
        let mut at_zero = reversed(problem)?.with_window(zero);
        at_zero.comment = Some(format!(
            "the limit at infinity of problem {}, at the value 0",
            problem.sha256()
        ));
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

    pub(super) fn is_complete(&self) -> bool {
        self.completed.as_ref().is_ok_and(Completed::is_complete)
    }

    pub(super) fn text(&self) -> String {
        let completed = match &self.completed {
            Ok(completed) => completed,
            Err(e) => return format!("UNDECIDED at infinity: {e}\n"),
        };
        let cover = &completed.cover;
        let mut out: String = cover
            .solutions
            .iter()
            .map(|s| format!("at infinity: slip {:?}\n", s.support))
            .collect();
        out.extend(
            cover
                .families
                .iter()
                .map(|f| format!("at infinity: a cone of solutions, slip {:?}\n", f.support)),
        );
        out.extend(cover.open.iter().map(|o| {
            format!(
                "at infinity: open, moving {:?}, undecided {:?}\n",
                o.moving, o.undecided
            )
        }));
        let n = cover.solutions.len() + cover.families.len();
        let what = match (cover.open.is_empty(), n) {
            (true, 0) => "COMPLETE: nothing at infinity".to_string(),
            (true, _) => format!(
                "COMPLETE: {n} at infinity (limits of x, no value of the window), and no other"
            ),
            (false, _) => format!(
                "UNDECIDED at infinity: {n} proved, {} regions open",
                cover.open.len()
            ),
        };
        out + &format!(
            "{what}; {} leaves, accepted by the checker for the reversed problem\n",
            cover.leaves
        )
    }

    pub(super) fn json(&self) -> serde_json::Value {
        let completed = match &self.completed {
            Ok(completed) => completed,
            Err(e) => {
                return json!({ "claim": "solutions", "solutions": [], "reason": e.to_string() });
            }
        };
        let cover = &completed.cover;
        let x = |x: &[f64]| x.iter().map(|v| format!("{v:.15e}")).collect::<Vec<_>>();
        let solutions: Vec<_> = completed
            .solutions()
            .map(|(s, v)| json!({ "slip": s.support, "x": x(v) }))
            .collect();
        json!({
            "claim": Claimed::of_cover(cover).word(),
            "reversed_problem_sha256": self.problem.sha256(),
            "solutions": solutions,
            "families": cover.families
                .iter()
                .map(|f| json!({ "slip": f.support }))
                .collect::<Vec<_>>(),
            "open": cover.open
                .iter()
                .map(|o| json!({ "moving": o.moving, "undecided": o.undecided }))
                .collect::<Vec<_>>(),
        })
    }

    pub(super) fn write(&self, files: Files) -> Result<(), CliError> {
        let Files([certificate, problem]) = files;
        // Without a certificate it shows what was asked.
        problem.write(&write_problem(&self.problem))?;
        self.completed.as_ref().map_or(Ok(()), |completed| {
            certificate.write(&completed.certificate.to_json())
        })
    }
}
