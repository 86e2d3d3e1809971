//! The published states of the block: condensed exactly, searched, certified on the full K.
//!
//! Each state of section 5 goes through reduction (10)-(16), the exact condensation, the solver,
//! the complete search and the checker. Input: the block and a state. Output: what was certified
//! and accepted, and everything that contradicts the complete set. Called by `verify` and by
//! `mceip block`.

use super::floors::Coverage;
use super::forge::forgeries;
use super::interior::path_coverage;
use super::verified::{VerifiedChecker, VerifiedCounts};
use crate::error::TestkitError;
use mceip_check::certificate::Certificate;
use mceip_check::{AcceptedClaim, AcceptedCover, Proved, Rejected, check};
use mceip_engine::multistart::{Search, SearchError, multistart};
use mceip_engine::reduction::condense;
use mceip_engine::run::{Progress, Watch};
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::to_f64;
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Pencil, Unknown};
use mceip_paper::{Block, PublishedState};

/// A certified and accepted solution of a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedState {
    /// mu, 12 digits of the certified enclosure's midpoint.
    pub value: String,
    /// Number of contact nodes that slip in the mode.
    pub slipping: usize,
    /// Contact nodes, counted from the left from 1, that were in impending slip and get stuck.
    pub stuck: Vec<usize>,
}

/// What came of a state.
#[derive(Debug, Clone)]
pub struct BlockReport {
    /// Which state.
    pub state: PublishedState,
    /// Solutions accepted by the checker on the full K.
    pub accepted: Vec<AcceptedState>,
    /// Candidates that stayed uncertified.
    pub uncertified: Vec<String>,
    /// Certified claims that the checker rejected: a bug.
    pub rejected: Vec<Rejected>,
    /// Forgeries tried.
    pub forgeries: usize,
    /// Forgeries rejected for the stated reason.
    pub rejected_forgeries: usize,
    /// Degrees of freedom, order of the pencil, order of the condensed pencil.
    pub orders: (usize, usize, usize),
    /// Bits of the largest denominator of the condensed pencil.
    pub bits: u64,
    /// Runs and pivots of the solver.
    pub runs: usize,
    /// Pivots of the solver.
    pub pivots: usize,
    /// The certificate, if anything was certified.
    pub certificate: Option<Proved<Certificate>>,
    /// What the complete search proved on the given K over [0, infinity).
    pub cover: AcceptedCover,
    /// The certificate of the complete set.
    pub complete_certificate: Proved<Certificate>,
    /// Verdicts of the verified checker on both certificates; all zero without one.
    pub verified: VerifiedCounts,
    /// Why the verified checker refuses a certificate: a bug.
    pub refused: Vec<String>,
    /// Accepted solutions that the complete set does not contain: a bug.
    pub missing: usize,
    /// Solutions of the complete set that the search did not find: the states have one each, and it
    /// has to be found.
    pub unfound: usize,
    /// PATH's own sequence from interior starts; each start counts as an instance.
    pub path: Coverage,
}

/// Interior starts of PATH's own sequence on each state.
pub const BLOCK_STARTS: usize = 100;

impl BlockReport {
    /// Gives both certificates to the verified checker.
    ///
    /// # Errors
    /// [`TestkitError`] if the block has no such state; none for the block of the report.
    pub fn submit_verified(
        &mut self,
        checker: &VerifiedChecker,
        block: &Block,
    ) -> Result<(), TestkitError> {
        let problem = self.state.problem(block)?;

        let mut certificates = vec![&self.complete_certificate];
        certificates.extend(&self.certificate);
        for proved in certificates {
            let refusal = self
                .verified
                .submit(checker, &problem, proved.certificate());
            self.refused.extend(refusal);
        }
        Ok(())
    }

    /// Is the set of solutions proved to be complete?
    pub fn is_complete(&self) -> bool {
        self.cover.is_plain_list()
    }
}

/// Treats one published state. `None` if it was cancelled.
///
/// # Errors
/// [`TestkitError`]; none for the paper's block.
pub fn block_state(
    block: &Block,
    state: PublishedState,
    watch: &Watch<'_>,
) -> Result<Option<BlockReport>, TestkitError> {
    watch.report(&Progress::stage("reducing"));
    let problem = state.problem(block)?;
    let reduced = reduce(&problem)?;
    let pencil = &reduced.pencil;
    let condensed = condense(&Admissible::new(pencil, Unknown::Mu)?)?;

    if watch.is_cancelled() {
        return Ok(None);
    }

    watch.report(&Progress::stage("condensing exactly and searching"));
    let search = Search {
        window_starts: 2,
        ..Search::default()
    };
    let found = multistart(&problem, &reduced, &search, &watch.quiet())?;

    if watch.is_cancelled() {
        return Ok(None);
    }

    watch.report(&Progress::stage(
        "proving that there are no other solutions",
    ));
    let completed = complete(&problem, &CompleteOptions::default(), &watch.quiet())?;
    watch.report(&Progress::stage("checking"));

    let mut uncertified = Vec::new();
    for u in &found.uncertified {
        uncertified.push(format!("mu = {}: {}", u.candidate.value, u.reason));
    }

    let mut report = BlockReport {
        state,
        accepted: Vec::new(),
        uncertified,
        rejected: Vec::new(),
        forgeries: 0,
        rejected_forgeries: 0,
        orders: (block.stiffness.rows(), pencil.order(), pencil.slip().len()),
        bits: denominator_bits(&condensed),
        runs: found.runs,
        pivots: found.pivots,
        certificate: None,
        unfound: completed.cover.solutions.len(),
        path: Coverage::default(),
        cover: completed.cover,
        complete_certificate: completed.proved,
        verified: VerifiedCounts::default(),
        refused: Vec::new(),
        missing: 0,
    };

    let small = Admissible::new(&condensed, Unknown::Mu)?;
    let proved = &report.cover.solutions;
    let values: Vec<f64> = proved.iter().map(|s| to_f64(&s.value.mid())).collect();
    report.path =
        path_coverage(&small, &values, BLOCK_STARTS, search.seed).map_err(SearchError::from)?;

    if found.certified.is_empty() {
        return Ok(Some(report));
    }

    let claims = found.certified.into_iter().map(|c| c.claim).collect();
    let proved = match Proved::new(&problem, Certificate::of_claims(&problem, claims)) {
        Ok(proved) => proved,
        Err(rejected) => {
            report.rejected.push(rejected);
            return Ok(Some(report));
        }
    };
    compare(&pencil.slip(), &proved.accepted().claims, &mut report);

    for forgery in forgeries(proved.certificate()) {
        if watch.is_cancelled() {
            return Ok(None);
        }

        let verdict = check(&problem, &forgery.certificate);
        let is_rejected = verdict.is_err_and(|e| (forgery.expected)(&e.reason));
        report.forgeries += 1;
        report.rejected_forgeries += usize::from(is_rejected);
    }

    report.certificate = Some(proved);
    Ok(Some(report))
}

/// Bits of the largest denominator of A and B.
fn denominator_bits(pencil: &Pencil) -> u64 {
    let entries = pencil.a().entries().chain(pencil.b().entries());
    let bits = entries.map(|(_, _, v)| v.denom().bits());
    bits.max().unwrap_or(0)
}

/// Compares what the checker has accepted with the complete set.
fn compare(slip: &[usize], claims: &[AcceptedClaim], report: &mut BlockReport) {
    let proved = &report.cover.solutions;
    if report.is_complete() {
        let is_missing = |c: &&AcceptedClaim| !proved.iter().any(|s| may_be_same(s, c));
        report.missing = claims.iter().filter(is_missing).count();
    }

    let is_found = |s: &&AcceptedClaim| claims.iter().any(|c| may_be_same(s, c));
    report.unfound -= proved.iter().filter(is_found).count();

    report.accepted = claims
        .iter()
        .map(|claim| accepted_state(slip, report.state, claim))
        .collect();
}

/// Same support and values whose enclosures meet.
fn may_be_same(a: &AcceptedClaim, b: &AcceptedClaim) -> bool {
    let a_begins_in_time = a.value.lo() <= b.value.hi();
    let b_begins_in_time = b.value.lo() <= a.value.hi();
    let values_meet = a_begins_in_time && b_begins_in_time;
    a.support == b.support && values_meet
}

/// An accepted claim in the words of the paper.
fn accepted_state(slip: &[usize], state: PublishedState, claim: &AcceptedClaim) -> AcceptedState {
    // Slip variables stand for the slip nodes from left to right; the stick nodes come before them,
    // the four free nodes after them.
    let stick_nodes = state.states().len() - 4 - slip.len();
    let mut stuck = Vec::new();
    for (k, i) in slip.iter().enumerate() {
        if !claim.support.contains(i) {
            stuck.push(stick_nodes + k + 1);
        }
    }

    AcceptedState {
        value: format!("{:.12}", to_f64(&claim.value.mid())),
        slipping: claim.support.len(),
        stuck,
    }
}
