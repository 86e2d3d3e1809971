//! Divergence of the form (8) at one mu, as decided by a complete search over lambda^2 in
//! [0, infinity).

use super::evidence::Evidence;
use super::modes::Mode;
use crate::reduction::MuFamily;
use crate::search::complete::Completed;
use mceip_check::OpenRegion;
use mceip_model::System;

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

pub(super) fn verdict(found: &Completed) -> Verdict {
    match (
        found.cover.solutions.is_empty() && found.cover.families.is_empty(),
        found.is_complete(),
    ) {
        (false, _) => Verdict::Present,
        (true, true) => Verdict::Absent,
        (true, false) => Verdict::Undecided,
    }
}

pub(super) fn divergence(system: &System, family: &MuFamily, found: &Completed) -> Divergence {
    let modes = found
        .solutions()
        .map(|(s, x)| Mode::of(system, family, s, x))
        .collect();
    let families = found.cover.families.len();
    Divergence {
        verdict: verdict(found),
        modes,
        families,
        open: found.cover.open.clone(),
        evidence: Evidence::Certificate(0),
    }
}
