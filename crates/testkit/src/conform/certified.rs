//! Answers of cases that are too large for the plain oracle: each solution certified, and where the
//! complete search has closed the window, proved to be all.
//!
//! ```text
//! proved:      complete search -> certificate -> check -> cover without open regions
//! best known:  list of the pack, or multistart -> certify -> check -> everything else open
//! ```
//!
//! Both become an [`AcceptedCover`], so that a solution has its place by
//! [`AcceptedCover::place_of`]: among those listed, or in an open region, where it is one that
//! nobody knew. A list that stands in a pack is not believed: each of its solutions is certified
//! again, and the search is made again.
//! Called by `case`; read by `judge`.

use super::case::{Draft, ListedPoint};
use crate::error::TestkitError;
use mceip_check::{AcceptedClaim, AcceptedCover, ClaimChecker, OpenRegion, Place};
use mceip_engine::certify::{Certifier, Preference};
use mceip_engine::foreign::ForeignReport;
use mceip_engine::multistart::{Search, multistart};
use mceip_engine::report::{Claimed, Listed, Report, solutions_json};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, Completed, complete};
use mceip_model::{Problem, Reduced, sha256};
use serde_json::{Value, json};
use std::collections::BTreeSet;

worded! {
    /// What is known of a list of solutions that the plain oracle has not made.
    Completeness:
    Proved "proved" "All there are: the checker has accepted a cover of the window.",
    BestKnown "best_known" "Each is certified; there may be others.",
}

/// An answer that rests on the checker.
#[derive(Debug, Clone)]
pub struct CertifiedAnswer {
    /// What is known of it.
    pub completeness: Completeness,
    /// The solutions, single ones only, and what is open: nothing, or the whole window.
    pub cover: AcceptedCover,
    /// The same as `mceip-solutions/1`.
    pub report: Value,
    /// SHA-256 of the certificate of the complete set that was checked; none for a best known list.
    pub certificate: Option<String>,
}

/// Starts of the search for a best known list, times the order of the pencil.
const WORK: usize = 2000;

impl CertifiedAnswer {
    /// The answer of a draft. A list that it brings along must be what is found: each of its
    /// solutions, and where it is proved to be all, no other.
    ///
    /// # Errors
    /// [`TestkitError::NotProved`] where the search leaves regions open or finds families,
    /// [`TestkitError::NothingKnown`] for a best known list of nothing, [`TestkitError::Answer`]
    /// for a list that is not right, [`TestkitError::Word`] for a problem with values of both
    /// signs, [`TestkitError`] for one that a search refuses.
    pub(super) fn of_draft(
        draft: &Draft,
        reduced: &Reduced,
        completeness: Completeness,
        watch: &Watch<'_>,
    ) -> Result<CertifiedAnswer, TestkitError> {
        if draft.problem.reflected().is_some() {
            return Err(TestkitError::Word {
                case: draft.id.clone(),
                what: "an exact answer, where values of both signs are asked for",
                got: completeness.word().into(),
            });
        }

        match (completeness, &draft.listed) {
            (Completeness::Proved, _) => proved(draft, reduced, watch),
            (Completeness::BestKnown, Some(report)) => {
                let accepted = certified_list(draft, reduced, report)?;
                best_known(draft, reduced, accepted, report.clone())
            }
            (Completeness::BestKnown, None) => searched(draft, reduced, watch),
        }
    }

    /// Its solutions. The list has been made here, or every number of it has been read.
    pub(super) fn points(&self) -> Vec<ListedPoint> {
        let mut points = Vec::new();
        for solution in self.report["solutions"].as_array().into_iter().flatten() {
            let support = solution["slip"].as_array().into_iter().flatten();
            let support = support.filter_map(|i| i.as_u64().map(|i| i as usize));
            let x = solution["x"].as_array().into_iter().flatten();
            points.push(ListedPoint {
                support: support.collect(),
                value: text_of(&solution["value"]),
                x: x.map(text_of).collect(),
            });
        }
        points
    }

    /// Makes the list one about the reduced pencil, which has the same values and x.
    pub(super) fn is_about_the_pencil(&mut self, pencil: &Problem) {
        self.report["problem_sha256"] = json!(pencil.sha256());
        if let Some(fields) = self.report.as_object_mut() {
            fields.remove("variables");
        }
        for solution in self.report["solutions"]
            .as_array_mut()
            .into_iter()
            .flatten()
        {
            if let Some(fields) = solution.as_object_mut() {
                fields.remove("v");
                fields.remove("w");
            }
        }
    }
}

/// A number of a report as it is spelled.
fn text_of(number: &Value) -> String {
    match number {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// All solutions, by the complete search.
fn proved(
    draft: &Draft,
    reduced: &Reduced,
    watch: &Watch<'_>,
) -> Result<CertifiedAnswer, TestkitError> {
    let problem = &draft.problem;
    let completed = complete(problem, &CompleteOptions::default(), &watch.quiet())?;
    let cover = &completed.cover;
    if !cover.is_plain_list() {
        return Err(TestkitError::NotProved {
            case: draft.id.clone(),
            open: cover.open.len(),
            families: cover.families.len(),
        });
    }

    let report = match &draft.listed {
        Some(report) => {
            let accepted = certified_list(draft, reduced, report)?;
            if !is_all_of(cover, &accepted) {
                return Err(wrong_answer(draft));
            }
            report.clone()
        }
        None => report_on(draft, reduced, &completed),
    };

    let file = completed.proved.file();
    let file = file.map_err(|e| TestkitError::problem(&draft.id, e))?;
    Ok(CertifiedAnswer {
        completeness: Completeness::Proved,
        report,
        certificate: Some(sha256(&file)),
        cover: completed.cover,
    })
}

/// The complete set as `mceip-solutions/1`.
fn report_on(draft: &Draft, reduced: &Reduced, completed: &Completed) -> Value {
    let listed = Listed::of_cover(&draft.problem, reduced, completed);
    let evidence = format!(
        "certificate of a complete set, {} leaves, accepted by the checker",
        completed.cover.leaves
    );

    solutions_json(&Report {
        problem: &draft.problem,
        reduced,
        solutions: listed.map(|(_, listed)| listed).collect(),
        claim: Claimed::of_cover(&completed.cover),
        evidence,
        enumeration: None,
        cover: Some(&completed.cover),
    })
}

/// What many starts find.
fn searched(
    draft: &Draft,
    reduced: &Reduced,
    watch: &Watch<'_>,
) -> Result<CertifiedAnswer, TestkitError> {
    let problem = &draft.problem;
    let starts = (WORK / reduced.pencil.order()).max(10);
    let search = Search {
        starts,
        curves: false,
        ..Search::default()
    };
    let found = multistart(problem, reduced, &search, &watch.quiet())?;

    let checker = ClaimChecker::new(problem);
    let mut accepted = Vec::new();
    let mut listed = Vec::new();
    for one in &found.certified {
        let verdict = checker.verdict(problem.window(), &one.claim);
        accepted.push(verdict.map_err(|_| wrong_answer(draft))?);
        listed.push(Listed::of_claim(problem, reduced, &one.claim));
    }

    let evidence = format!(
        "{} found from {starts} starts and beside each other, each accepted by the checker; there \
         may be others",
        accepted.len()
    );
    let report = solutions_json(&Report {
        problem,
        reduced,
        solutions: listed,
        claim: Claimed::Solutions,
        evidence,
        enumeration: None,
        cover: None,
    });
    best_known(draft, reduced, accepted, report)
}

/// The answer that knows these solutions: the open region is everything. A list of nothing is no
/// answer: a program that finds nothing would be correct.
fn best_known(
    draft: &Draft,
    reduced: &Reduced,
    accepted: Vec<AcceptedClaim>,
    report: Value,
) -> Result<CertifiedAnswer, TestkitError> {
    if accepted.is_empty() {
        return Err(TestkitError::NothingKnown {
            case: draft.id.clone(),
        });
    }

    let window = draft.problem.window();
    let everything = OpenRegion {
        min: Some(window.min().clone()),
        max: window.max().cloned(),
        moving: Vec::new(),
        undecided: reduced.pencil.slip(),
    };

    Ok(CertifiedAnswer {
        completeness: Completeness::BestKnown,
        cover: AcceptedCover {
            solutions: accepted,
            families: Vec::new(),
            open: vec![everything],
            leaves: 0,
        },
        report,
        certificate: None,
    })
}

/// What the checker accepts of a list: every one of its solutions, no two the same, each with the
/// support that the list says.
///
/// # Errors
/// [`TestkitError::Answer`] elsewhere.
fn certified_list(
    draft: &Draft,
    reduced: &Reduced,
    report: &Value,
) -> Result<Vec<AcceptedClaim>, TestkitError> {
    let read = ForeignReport::read(&report.to_string(), &draft.problem, reduced);
    let read = read.map_err(|_| wrong_answer(draft))?;
    let certifier = Certifier::new(&draft.problem, &reduced.pencil);
    let certifier = certifier.with_preference(Preference::Cheapest);

    let mut accepted: Vec<AcceptedClaim> = Vec::new();
    for (k, solution) in read.solutions.iter().enumerate() {
        let reported = solution.as_ref().map_err(|_| wrong_answer(draft))?;
        let certified = certifier.certify_with_verdict(&reported.candidate);
        let (_, verdict) = certified.map_err(|_| wrong_answer(draft))?;

        let has_its_support = report["solutions"][k]["slip"] == json!(verdict.support);
        let is_repeated = accepted.iter().any(|other| may_be_one(other, &verdict));
        if !has_its_support || is_repeated {
            return Err(wrong_answer(draft));
        }
        accepted.push(verdict);
    }

    if read.continua.is_empty() {
        Ok(accepted)
    } else {
        Err(wrong_answer(draft))
    }
}

/// The same support and values that meet?
fn may_be_one(one: &AcceptedClaim, other: &AcceptedClaim) -> bool {
    let are_apart = one.value.hi() < other.value.lo() || other.value.hi() < one.value.lo();
    one.support == other.support && !are_apart
}

/// Is each solution of the cover in the list, and nothing else?
fn is_all_of(cover: &AcceptedCover, list: &[AcceptedClaim]) -> bool {
    let mut places = BTreeSet::new();
    for claim in list {
        match cover.place_of(claim) {
            Some(Place::Solution(k)) => places.insert(k),
            _ => return false,
        };
    }
    places.len() == list.len() && places.len() == cover.solutions.len()
}

fn wrong_answer(draft: &Draft) -> TestkitError {
    TestkitError::Answer {
        case: draft.id.clone(),
    }
}
