//! Answers that need no search: systems in which nothing slips, and mu = 0.
//!
//! **Nothing slips.** The power identity (`spec/zero-reaction.md`, Z.2) says of a solution of (9)
//! with P = K + lambda^2 M that
//!
//! ```text
//!     v'P v = mu sum_s x w_N - mu sum_z |w_N| |v_T|.
//! ```
//!
//! Without slip particles the right side is at most 0, and v lives on f and z, where P is positive
//! definite: v = 0. So there is no solution, for any mu >= 0 and lambda^2 >= 0.
//!
//! **mu = 0.** The right side is 0. Slip particles have r_T = 0, so they may slide either way, with
//! w_T = 0: v lives on f, z and the tangents of the slip particles. Where P is positive definite
//! there, v = 0; it is for every lambda^2 >= 0 if it is for lambda = 0, where it is K* at mu = 0.
//! Where it is not, and nothing is in contact with zero reaction, P is singular at some
//! lambda^2 >= 0, because it is definite for large ones, and its null vector is a solution.
//!
//! Input: a system, and whether K* is definite at mu = 0 (`conditions`). Called by
//! [`analyse`](super::analyse).

use super::answer::Analysis;
use super::conditions::{DefiniteUntil, Necessary};
use super::critical::Critical;
use super::divergence::{Divergence, Verdict};
use super::evidence::Evidence;
use super::ranges::Range;
use super::threshold::StaticThreshold;
use mceip_check::OpenRegion;
use mceip_exact::Rational;
use mceip_model::System;
use num_traits::Zero;

/// Behind everything that is said of a system in which nothing slips.
const NOTHING_SLIPS: Evidence = Evidence::Exact(
    "theorem Z.2: without a particle in impending slip (9) has no solution; K and M proved \
     definite by exact LDL'",
);

/// Behind divergence at mu = 0.
pub(super) const NOT_DEFINITE: Evidence = Evidence::Exact(
    "theorem: K* is symmetric at mu = 0 and not positive definite, by exact LDL', so K* + lambda^2 \
     M* is singular for some lambda^2 >= 0",
);

/// Behind its absence.
const DEFINITE: Evidence = Evidence::Exact(
    "theorem: K* is symmetric at mu = 0 and positive definite, by exact LDL', and so is K* + \
     lambda^2 M*",
);

const NOT_DEFINITE_WITH_ZERO: Evidence = Evidence::Exact(
    "K* is not positive definite at mu = 0, by exact LDL'; with zero reaction that decides nothing",
);

/// Divergence at mu = 0, from the condition on K*, with this many particles of zero reaction.
pub(super) fn without_friction(necessary: &Necessary, zero_count: usize) -> Divergence {
    let is_definite = !matches!(necessary.stiffness, DefiniteUntil::NotAtZero(_));
    let (verdict, evidence) = match (is_definite, zero_count) {
        (true, _) => (Verdict::Absent, DEFINITE),
        (false, 0) => (Verdict::Present, NOT_DEFINITE),
        (false, _) => (Verdict::Undecided, NOT_DEFINITE_WITH_ZERO),
    };

    let mut open = Vec::new();
    if verdict == Verdict::Undecided {
        open.push(OpenRegion {
            min: Some(Rational::zero()),
            max: None,
            moving: Vec::new(),
            undecided: Vec::new(),
        });
    }

    Divergence {
        verdict,
        modes: Vec::new(),
        families: 0,
        open,
        evidence,
    }
}

/// The analysis of a system in which nothing slips.
pub(super) fn nothing_slips(system: &System, friction: &Rational) -> Analysis {
    let everywhere = Range {
        verdict: Verdict::Absent,
        from: Rational::zero(),
        to: None,
        evidence: NOTHING_SLIPS,
    };

    Analysis {
        members: None,
        warnings: Vec::new(),
        name: None,
        problem_sha256: None,
        friction: friction.clone(),
        sizes: super::sizes(system),
        particles: super::names(system),
        zero: system.zero_particles().len(),
        divergence: Divergence {
            verdict: Verdict::Absent,
            modes: Vec::new(),
            families: 0,
            open: Vec::new(),
            evidence: NOTHING_SLIPS,
        },
        without_friction: Verdict::Absent,
        threshold: StaticThreshold {
            values: Vec::new(),
            intervals: Vec::new(),
            open: Vec::new(),
            evidence: NOTHING_SLIPS,
        },
        critical: Critical {
            absent_below: None,
            evidence: NOTHING_SLIPS,
            solution: None,
            boxes: None,
            unproved: None,
        },
        unbounded: None,
        stability: None,
        ranges: vec![everywhere],
        samples: Vec::new(),
        necessary: Necessary {
            stiffness: DefiniteUntil::Always,
            mass: Some(DefiniteUntil::Always),
            mass_is_constant: true,
        },
        condensed: None,
        sufficient: system.zero_particles().is_empty().then_some(false),
        flutter: None,
        proofs: Vec::new(),
        interrupted: false,
    }
}
