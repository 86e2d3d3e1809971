//! The engines, each compared with the plain enumerator's answer. Callers may bring their own.
//!
//! Input: a case. Output: counts, corners, and a finding for each disagreement with the
//! enumerator's answer or with what is known of the case by construction. A panic of an engine is a
//! finding too. Called by the campaign's run, by `shrink`, and by `mceip campaign --replay`.

use super::family::CampaignCase;
use crate::compare::{InstanceReport, Treatment, compare_with, engines, observed};
use crate::disagreement::Disagreement;
use crate::families::Corner;
use mceip_engine::multistart::Search;
use mceip_exact::{Algebraic, Rational};
use mceip_model::{Pencil, Reduced, Window};
use mceip_oracle::{Enumeration, constants};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What every engine is held against.
pub struct Truth {
    /// The pencil, with the way back.
    pub reduced: Reduced,
    /// The plain enumerator's answer.
    pub enumeration: Enumeration,
}

/// Something that says what the solutions are, or what may be said of them.
pub trait Engine: Sync {
    /// Its name in reports.
    fn name(&self) -> &str;

    /// Compares it with the enumerator's answer: disagreements and counts are added to the report.
    fn compare(&self, case: &CampaignCase, truth: &Truth, report: &mut InstanceReport);
}

/// Another enumerator: the same answer, or a disagreement.
pub struct Enumerator<F> {
    /// Its name.
    pub name: &'static str,
    /// The answer, or why there is none. `Ok(None)`: the problem is outside its limits.
    pub answer: F,
}

impl<F: Fn(&Pencil, &Window) -> Result<Option<Enumeration>, String> + Sync> Engine
    for Enumerator<F>
{
    fn name(&self) -> &str {
        self.name
    }

    fn compare(&self, case: &CampaignCase, truth: &Truth, report: &mut InstanceReport) {
        match (self.answer)(&truth.reduced.pencil, case.instance.problem.window()) {
            Ok(Some(answer)) if answer == truth.enumeration => {}
            Ok(Some(answer)) => report.disagreements.push(Disagreement::Enumerators {
                got: answer.solutions.len(),
                enumerated: truth.enumeration.solutions.len(),
            }),
            Ok(None) => {}
            Err(reason) => {
                let refused = Disagreement::refused(self.name, &reason);
                report.disagreements.push(refused);
            }
        }
    }
}

/// Closed form, lift, certificates and their forgeries, complete search, solver: all of
/// [`crate::compare`].
pub struct Pipeline {
    /// How the solver searches, which solver it is, and nodes per piece of the complete search.
    pub treatment: Treatment,
}

impl Engine for Pipeline {
    fn name(&self) -> &str {
        "pipeline"
    }

    fn compare(&self, case: &CampaignCase, truth: &Truth, report: &mut InstanceReport) {
        compare_with(
            &case.instance,
            &truth.reduced,
            &truth.enumeration,
            &self.treatment,
            report,
        );
    }
}

/// Answers known by construction: the whole, their number, or one solution.
pub struct KnownAnswer;

impl Engine for KnownAnswer {
    fn name(&self) -> &str {
        "known answer"
    }

    fn compare(&self, case: &CampaignCase, truth: &Truth, report: &mut InstanceReport) {
        let found = &truth.enumeration;
        for expected in contradicted(case, truth) {
            report.disagreements.push(Disagreement::Known {
                expected,
                enumerated: found.solutions.len(),
            });
        }
    }
}

/// What is known by construction and not true of the enumerator's answer, in words.
fn contradicted(case: &CampaignCase, truth: &Truth) -> Vec<String> {
    let found = &truth.enumeration;
    let mut out = Vec::new();

    if let Some(answer) = &case.expected.answer
        && answer != found
    {
        let solutions = answer.solutions.len();
        let cones = answer.cones.len();
        out.push(format!("{solutions} solutions, {cones} cones"));
    }

    if let Some(count) = case.expected.count
        && (count != found.solutions.len() || !found.is_plain_list())
    {
        out.push(format!("{count} solutions"));
    }

    if let Some((value, x)) = &case.expected.planted
        && !holds(truth, value, x)
    {
        out.push(format!("value {value} with x = {x:?}"));
    }

    out
}

/// Does the enumerator's answer hold the solution with this value and x?
fn holds(truth: &Truth, value: &Rational, x: &[Rational]) -> bool {
    let value = Algebraic::rational(value.clone());
    let pencil = &truth.reduced.pencil;
    truth.enumeration.contains(pencil, &value, &constants(x))
}

/// All engines of the project, capped so that an instance takes seconds at most.
pub fn standard(seed: u64) -> Vec<Box<dyn Engine>> {
    let pipeline = Pipeline {
        treatment: treatment(seed),
    };
    vec![Box::new(KnownAnswer), Box::new(pipeline)]
}

/// How the campaign treats an instance: a search that takes seconds at most. The campaign's floors
/// hold for it.
pub fn treatment(seed: u64) -> Treatment {
    let search = Search {
        starts: 10,
        window_starts: 1,
        window_limit: 6,
        departures: Some(2),
        seed,
        ..Search::default()
    };

    Treatment {
        nodes: NODES,
        ..Treatment::of(&search)
    }
}

/// Nodes per piece of the complete search: instances are small, what needs more is degenerate.
const NODES: usize = 2_000;

/// A disagreement and the engine that is in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The engine.
    pub engine: String,
    /// What it says.
    pub disagreement: Disagreement,
}

impl Finding {
    fn new(engine: &str, disagreement: Disagreement) -> Finding {
        Finding {
            engine: engine.into(),
            disagreement,
        }
    }

    /// Engine and kind: what a shrunk instance must keep.
    pub fn kind(&self) -> (&str, &'static str) {
        (&self.engine, self.disagreement.kind())
    }
}

/// What came of a case.
#[derive(Debug, Clone, Default)]
pub struct CaseFindings {
    /// Counts and corners.
    pub report: InstanceReport,
    /// Disagreements, with the engine.
    pub findings: Vec<Finding>,
}

/// Holds every engine against the plain enumerator. A panic of an engine is a disagreement like any
/// other.
pub fn judge(case: &CampaignCase, all: &[Box<dyn Engine>]) -> CaseFindings {
    let mut report = InstanceReport {
        label: case.instance.label.clone(),
        corners: case.instance.corners.clone(),
        ..InstanceReport::default()
    };

    let mut findings = Vec::new();
    match guarded(|| engines(&case.instance.problem)) {
        Err(panic) => findings.push(Finding::new("enumerator", panic)),
        Ok(Err(disagreement)) => findings.push(Finding::new("enumerator", disagreement)),
        Ok(Ok((reduced, enumeration))) => {
            let truth = Truth {
                reduced,
                enumeration,
            };
            report.corners.extend(shape(&truth));

            for engine in all {
                let outcome = guarded(|| engine.compare(case, &truth, &mut report));
                for disagreement in report.disagreements.drain(..) {
                    findings.push(Finding::new(engine.name(), disagreement));
                }

                if let Err(panic) = outcome {
                    findings.push(Finding::new(engine.name(), panic));
                }
            }
        }
    }

    report.corners.sort();
    report.corners.dedup();
    CaseFindings { report, findings }
}

/// Corners of the answer and of the shape.
fn shape(truth: &Truth) -> Vec<Corner> {
    let found = &truth.enumeration;
    let pencil = &truth.reduced.pencil;
    let mut corners = observed(found);

    if found.is_plain_list() && found.solutions.is_empty() {
        corners.push(Corner::Empty);
    }
    if pencil.order() == 1 {
        corners.push(Corner::OneByOne);
    }
    if !pencil.free().is_empty() {
        corners.push(Corner::FreeVariables);
    }

    corners
}

/// Runs `work` and turns a panic into a disagreement.
fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, Disagreement> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string));

        Disagreement::Panicked {
            message: text.unwrap_or_else(|| "no message".into()),
        }
    })
}
