//! A case: a problem, its complete exact answer, and what it is about.
//!
//! A [`Draft`] is a problem without an answer, as `groups` and `tier2` make it or `pack` reads it.
//! [`Case::answer`] answers it by the plain oracle, or, where that is beyond it, as `certified`
//! says. Cases are written to the pack and sent to foreign programs, whose reports `judge` compares
//! with the answer.

use super::certified::{CertifiedAnswer, Completeness};
use super::flag::{Flag, of_certified, of_enumeration};
use crate::error::TestkitError;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json};
use mceip_engine::run::Watch;
use mceip_engine::signs::BothSigns;
use mceip_model::file::write_problem;
use mceip_model::{Body, ModelError, Problem, Reduced};
use mceip_oracle::{Enumeration, IntegerPencil, Solution, enumerate};
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
    /// What is known of its answer where the plain oracle does not find it.
    pub completeness: Option<Completeness>,
    /// The answer that a pack gives, for such a case.
    pub listed: Option<Value>,
    /// How hard it has been found to be.
    pub difficulty: Option<Difficulty>,
}

worded! {
    /// How well the rivals of spec/rivals.md did on a case.
    Difficulty:
    Easy "easy" "Every rival is correct.",
    Medium "medium" "Some rival is correct or finds half of the solutions, and some is not \
        correct.",
    Hard "hard" "No rival is correct, and none finds half of the solutions.",
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

/// The answer of a case.
#[derive(Debug, Clone)]
pub enum CaseAnswer {
    /// Complete and exact, by the plain oracle.
    Enumerated(Enumeration),
    /// What the checker has accepted.
    Certified(CertifiedAnswer),
}

/// A solution of an answer in decimals.
#[derive(Debug, Clone)]
pub(super) struct ListedPoint {
    /// Indices with x_i > 0.
    pub(super) support: Vec<usize>,
    pub(super) value: String,
    pub(super) x: Vec<String>,
}

/// A problem with its answer.
#[derive(Debug, Clone)]
pub struct Case {
    /// Unique within the pack.
    pub id: String,
    /// One line for people.
    pub comment: String,
    /// What it is about.
    pub flags: BTreeSet<Flag>,
    /// The problem with its reduction, and its reflection where values below 0 are asked for.
    pub signs: BothSigns,
    /// Its answer.
    pub answer: CaseAnswer,
    /// How hard it has been found to be.
    pub difficulty: Option<Difficulty>,
}

impl Case {
    /// Answers a draft. With `as_pencil` a system is replaced by its reduced pencil first (another
    /// problem with another digest, and the same values and x). A search that `watch` cancels is
    /// refused as one that leaves regions open.
    ///
    /// # Errors
    /// [`TestkitError::Oracle`] for a problem beyond the plain oracle, [`TestkitError::Problem`]
    /// for a system that lacks what its unknown needs, and what [`CertifiedAnswer`] is refused for.
    pub fn answer(draft: &Draft, as_pencil: bool, watch: &Watch<'_>) -> Result<Case, TestkitError> {
        let signs = signs_of(&draft.problem).map_err(|e| TestkitError::problem(&draft.id, e))?;
        let reduced = &signs.own().reduced;

        let answer = match draft.completeness {
            None => {
                let pencil = IntegerPencil::of(&draft.problem, reduced);
                let found = enumerate(pencil, draft.problem.real_window());
                CaseAnswer::Enumerated(found.map_err(|source| TestkitError::Oracle {
                    case: draft.id.clone(),
                    source,
                })?)
            }
            Some(completeness) => {
                let found = CertifiedAnswer::of_draft(draft, reduced, completeness, watch)?;
                CaseAnswer::Certified(found)
            }
        };

        let mut flags = match &answer {
            CaseAnswer::Enumerated(found) => of_enumeration(&draft.problem, reduced, found),
            CaseAnswer::Certified(found) => of_certified(&draft.problem, reduced, found),
        };
        flags.extend(&draft.flags);

        let mut case = Case {
            id: draft.id.clone(),
            comment: draft.comment.clone(),
            flags,
            signs,
            answer,
            difficulty: draft.difficulty,
        };
        if as_pencil && matches!(case.problem().body(), Body::System(_)) {
            case.replace_by_its_pencil()
                .map_err(|e| TestkitError::problem(&draft.id, e))?;
        }

        Ok(case)
    }

    /// The problem.
    pub fn problem(&self) -> &Problem {
        &self.signs.own().problem
    }

    /// Its reduction.
    pub fn reduced(&self) -> &Reduced {
        &self.signs.own().reduced
    }

    /// Puts the reduced pencil in place of the problem. Flags and answer stay.
    fn replace_by_its_pencil(&mut self) -> Result<(), ModelError> {
        let body = Body::Pencil(self.reduced().pencil.clone());
        let window = self.problem().window().clone();
        let pencil = Problem::new(body, self.problem().unknown(), window)?;

        self.signs = signs_of(&pencil.named(self.id.clone()))?;
        if let CaseAnswer::Certified(answer) = &mut self.answer {
            answer.is_about_the_pencil(&self.signs.own().problem);
        }
        Ok(())
    }

    /// The same under another name, without comment and warnings: nothing in it tells which case it
    /// is. Digest and answer stay.
    pub(super) fn problem_named(&self, name: String) -> Problem {
        let mut problem = self.problem().clone().named(name);
        problem.comment = None;
        problem.warnings.clear();
        problem
    }

    /// What is known of the answer where the plain oracle has not made it.
    pub fn completeness(&self) -> Option<Completeness> {
        match &self.answer {
            CaseAnswer::Enumerated(_) => None,
            CaseAnswer::Certified(answer) => Some(answer.completeness),
        }
    }

    /// How many parts its answer has: solutions, cones, continua.
    pub fn parts(&self) -> usize {
        match &self.answer {
            CaseAnswer::Enumerated(answer) => {
                answer.solutions.len() + answer.cones.len() + answer.ranges.len()
            }
            CaseAnswer::Certified(answer) => answer.cover.solutions.len(),
        }
    }

    /// The solutions of its answer, without cones and continua.
    pub(super) fn points(&self) -> Vec<ListedPoint> {
        match &self.answer {
            CaseAnswer::Enumerated(answer) => {
                let slip = self.reduced().pencil.slip();
                let of = |s: &Solution| ListedPoint::of_solution(s, &slip);
                answer.solutions.iter().map(of).collect()
            }
            CaseAnswer::Certified(answer) => answer.points(),
        }
    }

    /// The answer as `mceip-solutions/1`; an enumerated one without the list of families.
    pub fn answer_json(&self) -> Value {
        match &self.answer {
            CaseAnswer::Enumerated(answer) => self.enumerated_json(answer),
            CaseAnswer::Certified(answer) => answer.report.clone(),
        }
    }

    fn enumerated_json(&self, found: &Enumeration) -> Value {
        let mut solutions = Vec::new();
        for solution in &found.solutions {
            let listed = Listed::of_solution(self.problem(), self.reduced(), solution);
            solutions.push(listed);
        }

        let mut answer = solutions_json(&Report {
            problem: self.problem(),
            reduced: self.reduced(),
            solutions,
            claim: Claimed::complete_if(found.is_complete_list()),
            evidence: format!(
                "plain enumeration of {} supports, exact",
                found.supports_total
            ),
            enumeration: Some(found),
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
        let problem = write_problem(self.problem());
        let problem: Value = serde_json::from_str(&problem).unwrap_or_default();

        let mut case = json!({
            "id": self.id,
            "comment": self.comment,
            "flags": self.flags,
            "problem": problem,
            "answer": self.answer_json(),
        });
        if let CaseAnswer::Certified(answer) = &self.answer {
            case["completeness"] = json!(answer.completeness);
            if let Some(digest) = &answer.certificate {
                case["certificate_sha256"] = json!(digest);
            }
        }
        if let Some(difficulty) = self.difficulty {
            case["difficulty"] = json!(difficulty);
        }
        case
    }

    /// Is there anything to be found?
    pub fn has_solutions(&self) -> bool {
        self.parts() > 0
    }
}

/// A problem and its reflection, each with its reduction. Particles in contact with zero reaction
/// are refused.
fn signs_of(problem: &Problem) -> Result<BothSigns, ModelError> {
    let signs = BothSigns::of(problem)?;
    signs.own().reduced.require_no_zero()?;
    Ok(signs)
}

impl ListedPoint {
    /// A solution of the enumerator; `slip` are the complementarity variables.
    pub(super) fn of_solution(solution: &Solution, slip: &[usize]) -> ListedPoint {
        ListedPoint {
            support: solution.slip.clone(),
            value: solution.decimal(DIGITS),
            x: solution.x_decimals(slip, DIGITS),
        }
    }

    /// `value` and `x` as a foreign program gives them.
    pub(super) fn entry(&self) -> Value {
        json!({ "value": self.value, "x": self.x })
    }
}

/// Significant digits of a [`ListedPoint`].
const DIGITS: usize = 17;
