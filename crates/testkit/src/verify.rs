//! The run of `mceip verify`: every family through every engine, one row each.
//!
//! Input: how many random instances, a seed, and the verified checker if its verdicts are wanted.
//! Output: a row of counts for each family and a
//! report for each published state of the block; a run without disagreements passes. Called by
//! `mceip verify`.

use super::block::{BlockReport, block_state};
use super::compare::{InstanceReport, Treatment, compare_by};
use super::disagreement::Disagreement;
use super::error::TestkitError;
use super::families::{
    Instance, degenerate, eigenvalue_problems, mechanical, random_pencils, table1_grid,
};
use super::floors::{Covered, Shortfall, Starts};
use super::tally::Tally;
use super::verified::{VerifiedChecker, VerifiedCounts};
use mceip_engine::multistart::Search;
use mceip_engine::run::{Progress, Watch};
use mceip_paper::{Block, MassKind, PublishedState};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A family's row.
#[derive(Debug, Clone, Default)]
pub struct FamilyReport {
    /// Name of the family.
    pub name: &'static str,
    /// Instances in the family; those treated are counted (fewer after an interrupt).
    pub instances: usize,
    /// What came of those treated. Found on Table 1 is what is found from interior starts.
    pub tally: Tally,
    /// Candidates uncertified, with instance and reason.
    pub uncertified: Vec<String>,
    /// Forgeries rejected for the stated reason.
    pub rejected: usize,
    /// Verdicts of the verified checker; all zero without one.
    pub verified: VerifiedCounts,
}

impl FamilyReport {
    /// Adds what came of one instance.
    fn add(&mut self, report: &InstanceReport) {
        self.tally.count(report);
        self.verified.add(&report.verified);

        let is_of_a_forgery = |d: &&Disagreement| matches!(d, Disagreement::Forgery { .. });
        let wrong_forgeries = report.disagreements.iter().filter(is_of_a_forgery).count();
        self.rejected += report.forgeries - wrong_forgeries;

        let label = &report.label;
        for reason in &report.uncertified {
            self.uncertified.push(format!("{label}: {reason}"));
        }
        for disagreement in &report.disagreements {
            let said = format!("{label}: {disagreement}");
            self.tally.disagreements.push(said);
        }
    }
}

/// The whole run.
#[derive(Debug, Clone)]
pub struct Verification {
    /// Seed of the random families.
    pub seed: u64,
    /// One row per family.
    pub families: Vec<FamilyReport>,
    /// The block's published states.
    pub block: Vec<BlockReport>,
    /// Was the run interrupted?
    pub interrupted: bool,
}

impl Verification {
    /// Number of disagreements in all, shortfalls among them.
    pub fn disagreements(&self) -> usize {
        let mut count = self.shortfalls().len();
        for family in &self.families {
            count += family.tally.disagreements.len();
        }
        for block in &self.block {
            count += block.rejected.len() + block.refused.len();
            count += block.forgeries - block.rejected_forgeries;
            count += block.missing + block.unfound;
        }
        count
    }

    /// Verdicts of the verified checker on all certificates of the run.
    pub fn verified(&self) -> VerifiedCounts {
        let mut counts = VerifiedCounts::default();
        for family in &self.families {
            counts.add(&family.verified);
        }
        for block in &self.block {
            counts.add(&block.verified);
        }
        counts
    }

    /// Coverage of the families, and of PATH's own sequence on the block's states.
    pub fn covered(&self) -> Vec<Covered> {
        let mut out = Vec::new();
        for family in &self.families {
            out.extend(family.tally.covered(family.name));
        }

        for block in &self.block {
            out.push(Covered {
                family: block.state.name().into(),
                starts: Starts::Path,
                coverage: block.path,
            });
        }

        out
    }

    /// Every rate that is below its floor by more than chance explains.
    pub fn shortfalls(&self) -> Vec<Shortfall> {
        self.covered()
            .iter()
            .flat_map(Covered::shortfalls)
            .collect()
    }
}

/// Runs everything embedded: Table 1, `random` random pencils, systems, degenerate cases, the
/// block. Each certificate that is accepted is also given to the verified checker, if there is one.
///
/// A run that is cancelled ends after the instances at work. Progress counts the instances of each
/// family. The result does not depend on the number of threads.
///
/// # Errors
/// [`TestkitError`] if an embedded problem is refused: a bug.
pub fn verify(
    random: usize,
    seed: u64,
    verified: Option<&VerifiedChecker>,
    watch: &Watch<'_>,
) -> Result<Verification, TestkitError> {
    let search = Search {
        seed,
        ..Search::default()
    };
    let treatment = Treatment {
        verified: verified.cloned(),
        ..Treatment::of(&search)
    };

    let families = [
        ("Table 1 (two particles)", table1_grid()?),
        ("random pencils", random_pencils(random, seed)?),
        ("mechanical systems", mechanical(random / 4, seed)?),
        (
            "eigenvalue problems",
            eigenvalue_problems(random / 4, seed)?,
        ),
        ("degenerate cases", degenerate()?),
    ];

    let mut rows = Vec::new();
    for (name, instances) in families {
        rows.push(verify_family(name, &instances, &treatment, watch));
    }

    let mut block = Vec::new();
    let model = Block::of_the_paper(MassKind::Consistent);

    for (k, state) in PublishedState::ALL.into_iter().enumerate() {
        if watch.is_cancelled() {
            break;
        }

        watch.report(&Progress::of("block of section 5", k, 2));
        let mut report = block_state(&model, state, &watch.quiet())?;
        if let (Some(report), Some(checker)) = (&mut report, verified) {
            report.submit_verified(checker, &model)?;
        }
        block.extend(report);
    }

    Ok(Verification {
        seed,
        families: rows,
        block,
        interrupted: watch.is_cancelled(),
    })
}

/// Runs one family, instances in parallel; the row does not depend on the number of threads.
pub fn verify_family(
    name: &'static str,
    instances: &[Instance],
    treatment: &Treatment,
    watch: &Watch<'_>,
) -> FamilyReport {
    let done = AtomicUsize::new(0);
    let reports: Vec<InstanceReport> = instances
        .par_iter()
        .filter_map(|instance| {
            if watch.is_cancelled() {
                return None;
            }

            let report = compare_by(instance, treatment);
            let finished = done.fetch_add(1, Ordering::Relaxed) + 1;
            watch.report(&Progress::of(name, finished, instances.len()));

            Some(report)
        })
        .collect(); // in the order of the instances

    let mut row = FamilyReport {
        name,
        instances: instances.len(),
        ..FamilyReport::default()
    };
    for report in &reports {
        row.add(report);
    }
    row
}
