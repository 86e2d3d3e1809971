//! A case: a problem, its complete exact answer, and what it is about.

use super::error::ConformError;
use super::flag::{Flag, derive};
use mceip_engine::reduction::{Reduced, reduce};
use mceip_engine::report::{Claimed, Listed, Report, solutions_json};
use mceip_model::Problem;
use mceip_oracle::{Enumeration, enumerate};
use serde_json::Value;
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
    /// [`ConformError::Oracle`] for a problem beyond the plain oracle, [`ConformError::Problem`]
    /// for a system that lacks what its unknown needs.
    pub fn answer(draft: &Draft, as_pencil: bool) -> Result<Case, ConformError> {
        let at = |source| ConformError::Problem {
            place: draft.id.clone(),
            source,
        };
        let reduced = reduce(&draft.problem).map_err(at)?;

        let answer = enumerate(&reduced.pencil, draft.problem.window()).map_err(|source| {
            ConformError::Oracle {
                case: draft.id.clone(),
                source,
            }
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
            let body = mceip_model::Body::Pencil(case.reduced.pencil.clone());
            let pencil = Problem::new(body, case.problem.unknown(), case.problem.window().clone())
                .map_err(at)?;
            case.problem = pencil.named(draft.id.clone());
            case.reduced = reduce(&case.problem).map_err(at)?;
        }

        Ok(case)
    }

    /// The complete answer as `mceip-solutions/1`.
    pub fn answer_json(&self) -> Value {
        let solutions = self
            .answer
            .solutions
            .iter()
            .map(|s| Listed::of_solution(&self.problem, &self.reduced, s))
            .collect();

        solutions_json(&Report {
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
        })
    }

    /// Is there anything to be found?
    pub fn has_solutions(&self) -> bool {
        !(self.answer.solutions.is_empty()
            && self.answer.cones.is_empty()
            && self.answer.ranges.is_empty())
    }
}
