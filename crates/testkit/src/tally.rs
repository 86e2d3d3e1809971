//! Counts of one family of instances, for `mceip verify` and `mceip campaign`.
//!
//! Input: what came of each instance. The counts are held against the floors of `floors`; in the
//! campaign's state files they stand as they are.

use crate::campaign::{CaseFindings, Id};
use crate::compare::InstanceReport;
use crate::families::Corner;
use crate::floors::{Coverage, Covered, Starts};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// Counts of one family.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tally {
    /// Instances judged.
    pub instances: u64,
    /// Solutions the enumerator lists.
    pub solutions: u64,
    /// Of those in admissible instances (where the solver runs), all of them.
    pub findable: u64,
    /// Of these, found by the solver and certified.
    pub found: u64,
    /// Coverage by kind of start; absent in state files written before there were floors.
    #[serde(default)]
    pub coverage: BTreeMap<String, Coverage>,
    /// Certificates accepted by the checker.
    pub accepted: u64,
    /// Forgeries tried; each one accepted is a disagreement.
    pub forgeries: u64,
    /// Instances closed by the complete search, with the enumerator's answer.
    pub closed: u64,
    /// Candidates that stayed uncertified: the solver's, and the enumerator's on singular supports.
    pub uncertified: u64,
    /// Instances with a wide kernel or a singular pencil.
    pub degenerate: u64,
    /// Pivots of the solver.
    pub pivots: u64,
    /// Instances per corner reached.
    pub corners: BTreeMap<String, u64>,
    /// Disagreements: instance, engine, and what was said.
    pub disagreements: Vec<String>,
}

impl Tally {
    /// Adds what came of one instance of a campaign.
    pub(crate) fn add(&mut self, id: &Id, judged: &CaseFindings) {
        self.count(&judged.report);
        for finding in &judged.findings {
            let said = format!("{id}: {}: {}", finding.engine, finding.disagreement);
            self.disagreements.push(said);
        }
    }

    /// Counts an instance; what disagrees is left to the caller.
    pub(crate) fn count(&mut self, report: &InstanceReport) {
        self.instances += 1;
        self.solutions += report.oracle as u64;
        if report.solved {
            self.findable += report.oracle as u64;
        }
        self.found += report.found as u64;
        self.accepted += report.accepted as u64;
        self.forgeries += report.forgeries as u64;
        self.closed += u64::from(report.completed);
        self.uncertified += report.uncertified.len() as u64;
        self.degenerate += u64::from(report.degenerate);
        self.pivots += report.pivots as u64;

        for (starts, coverage) in report.coverage() {
            let word = starts.word().to_string();
            self.coverage.entry(word).or_default().add(&coverage);
        }

        // An instance counts once for each corner.
        let corners: BTreeSet<Corner> = report.corners.iter().copied().collect();
        for corner in corners {
            *self.corners.entry(corner_name(corner)).or_default() += 1;
        }
    }

    /// The corners that were reached, each with its number of instances.
    pub fn corners(&self) -> impl Iterator<Item = (Corner, u64)> {
        let corners = Corner::ALL.iter();
        corners.filter_map(|&corner| Some((corner, *self.corners.get(&corner_name(corner))?)))
    }

    /// Coverage of the family of this name, for each kind of start that was met.
    pub(crate) fn covered(&self, family: &str) -> Vec<Covered> {
        let mut out = Vec::new();
        for starts in Starts::ALL {
            if let Some(coverage) = self.coverage.get(starts.word()) {
                out.push(Covered {
                    family: family.into(),
                    starts,
                    coverage: *coverage,
                });
            }
        }

        out
    }
}

/// The name of a corner in state files.
fn corner_name(corner: Corner) -> String {
    format!("{corner:?}")
}
