//! A case: a problem, its complete exact answer, and what it is about.
//!
//! A [`Draft`] is a problem without an answer, as `groups` makes it or `pack` reads it.
//! [`Case::answer`] answers it by the plain oracle. Cases are written to the pack and sent to
//! foreign programs, whose reports `judge` compares with the answer.

use super::flag::{Flag, derive};
use crate::error::TestkitError;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json};
use mceip_model::file::write_problem;
use mceip_model::reduction::reduce;
use mceip_model::{Body, ModelError, Problem, Reduced};
use mceip_oracle::{Enumeration, enumerate};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// A problem that has not been answered yet.
#[derive(Debug, Clone)]
pub struct Draft {
    /// Unique within the pack.
    pub id: String,
    /// One line for people.
    pub comment: String,
    /// What only the maker knows about it.
    pub flags: Vec<Flag>,
    /// The problem.
    pub problem: Problem,
}

/// Drafts that belong together: a file of the pack.
#[derive(Debug, Clone)]
pub struct Group {
    /// Name and file stem.
    pub name: String,
    /// One line for people.
    pub comment: String,
    /// Its problems.
    pub drafts: Vec<Draft>,
}

/// A problem with its complete answer.
#[derive(Debug, Clone)]
pub struct Case {
    /// Unique within the pack.
    pub id: String,
    /// One line for people.
    pub comment: String,
    /// What it is about.
    pub flags: BTreeSet<Flag>,
    /// The problem.
    pub problem: Problem,
    /// Its reduction.
    pub reduced: Reduced,
    /// The complete answer of the plain oracle.
    pub answer: Enumeration,
}

impl Case {
    /// Answers a draft by the plain oracle. With `as_pencil` a system is replaced by its reduced
    /// pencil first (another problem with another digest, and the same values and x).
    ///
    /// # Errors
    /// [`TestkitError::Oracle`] for a problem beyond the plain oracle, [`TestkitError::Problem`]
    /// for a system that lacks what its unknown needs.
    pub fn answer(draft: &Draft, as_pencil: bool) -> Result<Case, TestkitError> {
        let reduced = reduce(&draft.problem).and_then(Reduced::without_zero);
        let reduced = reduced.map_err(|e| TestkitError::problem(&draft.id, e))?;
        let answer = enumerate(&reduced.pencil, draft.problem.window());
        let answer = answer.map_err(|source| TestkitError::Oracle {
            case: draft.id.clone(),
            source,
        })?;

        let mut flags = derive(&draft.problem, &reduced, &answer);
        flags.extend(&draft.flags);

        let mut case = Case {
            id: draft.id.clone(),
            comment: draft.comment.clone(),
            flags,
            problem: draft.problem.clone(),
            reduced,
            answer,
        };
        if as_pencil {
            case.replace_by_its_pencil()
                .map_err(|e| TestkitError::problem(&draft.id, e))?;
        }

        Ok(case)
    }

    /// Puts the reduced pencil in place of the problem. Flags and answer stay.
    fn replace_by_its_pencil(&mut self) -> Result<(), ModelError> {
        let body = Body::Pencil(self.reduced.pencil.clone());
        let window = self.problem.window().clone();
        let pencil = Problem::new(body, self.problem.unknown(), window)?;

        self.problem = pencil.named(self.id.clone());
        self.reduced = reduce(&self.problem)?.without_zero()?;
        Ok(())
    }

    /// The complete answer as `mceip-solutions/1`, without the list of families.
    pub fn answer_json(&self) -> Value {
        let mut solutions = Vec::new();
        for solution in &self.answer.solutions {
            let listed = Listed::of_solution(&self.problem, &self.reduced, solution);
            solutions.push(listed);
        }

        let mut answer = solutions_json(&Report {
            problem: &self.problem,
            reduced: &self.reduced,
            solutions,
            claim: Claimed::complete_if(self.answer.is_complete_list()),
            evidence: format!(
                "plain enumeration of {} supports, exact",
                self.answer.supports_total
            ),
            enumeration: Some(&self.answer),
            cover: None,
        });

        // The pack describes its cones in `solutions` and its ranges in `continua` alone.
        if let Some(fields) = answer.as_object_mut() {
            fields.remove("families");
        }
        answer
    }

    /// The case as the pack has it, without wrong answers.
    pub fn json(&self) -> Value {
        // Our own writer's JSON is read without error.
        let problem = write_problem(&self.problem);
        let problem: Value = serde_json::from_str(&problem).unwrap_or_default();

        json!({
            "id": self.id,
            "comment": self.comment,
            "flags": self.flag_words(),
            "problem": problem,
            "answer": self.answer_json(),
        })
    }

    /// Its flags as they stand in files.
    pub fn flag_words(&self) -> Vec<&'static str> {
        self.flags.iter().map(|flag| flag.word()).collect()
    }

    /// Has it one of these flags? With none given, every case has.
    pub fn has_any(&self, flags: &[Flag]) -> bool {
        flags.is_empty() || flags.iter().any(|flag| self.flags.contains(flag))
    }

    /// Is there anything to be found?
    pub fn has_solutions(&self) -> bool {
        let answer = &self.answer;
        !answer.solutions.is_empty() || !answer.cones.is_empty() || !answer.ranges.is_empty()
    }
}
