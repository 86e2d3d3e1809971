//! Divergence of the form (8) at one mu, as decided by a complete search over lambda^2 in
//! [0, infinity).
//!
//! Input: what the search found. Output: [`Divergence`] with a [`Mode`] for each solution. Called
//! by [`analyse`](super::analyse), and `verdict` for the samples of `ranges`.

use super::evidence::Evidence;
use super::modes::Mode;
use crate::search::complete::Completed;
use mceip_check::OpenRegion;
use mceip_model::{MuFamily, System};

/// Does divergence of the form (8) exist? Never "stable": flutter and stick-slip growth lie outside
/// (8).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// A solution of MCEIP-lambda2 is proved.
    Present,
    /// It is proved that there is none.
    Absent,
    /// Neither: what is left open is listed.
    Undecided,
}

impl Verdict {
    /// The word used in files.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Present => "present",
            Verdict::Absent => "absent",
            Verdict::Undecided => "undecided",
        }
    }
}

/// Divergence at the given mu.
#[derive(Debug, Clone)]
pub struct Divergence {
    /// The verdict.
    pub verdict: Verdict,
    /// Every proved solution, with growth rate and mode, by ascending lambda^2.
    pub modes: Vec<Mode>,
    /// Families beside them: cones, and supports with a range of lambda^2. The certificate
    /// describes them.
    pub families: usize,
    /// Parts of [0, infinity) x supports in which nothing is proved.
    pub open: Vec<OpenRegion>,
    /// The certificate.
    pub evidence: Evidence,
}

/// The verdict of a complete search.
pub(super) fn verdict(found: &Completed) -> Verdict {
    let has_none = found.cover.solutions.is_empty() && found.cover.families.is_empty();
    if !has_none {
        Verdict::Present
    } else if found.is_complete() {
        Verdict::Absent
    } else {
        Verdict::Undecided
    }
}

/// The verdict of a complete search with a mode for every solution.
pub(super) fn divergence(system: &System, family: &MuFamily, found: &Completed) -> Divergence {
    let solutions = found.solutions();
    let modes = solutions.map(|(solution, x)| Mode::of(system, family, solution, x));
    Divergence {
        verdict: verdict(found),
        modes: modes.collect(),
        families: found.cover.families.len(),
        open: found.cover.open.clone(),
        evidence: Evidence::Certificate(0),
    }
}
