//! The mu at which growth has no bound: lambda^2 tends to infinity as mu comes close to it.
//!
//! Divided by lambda^2, MCEIP-lambda2 reads 0 <= x _|_ (M* + s K*) x >= 0 with s = 1/lambda^2. If
//! solutions have mu -> mu* and lambda^2 -> infinity, a limit of their x, scaled to e'x_s = 1,
//! solves
//!
//! ```text
//!     0 <= x_s _|_ y_s >= 0,   y_f = 0,   y = (M0 + mu* M1) x:
//! ```
//!
//! MCEIP-mu with M in place of K. Conversely a regular solution of it (x and y strict, the root
//! simple) goes on to s > 0 as a curve mu(s), so that there are solutions of any lambda^2 near its
//! mu. There the mass matrix M* loses its property, as in the paradox of Painleve. With M1 = 0, as
//! for lumped masses, M* = M0 is definite and there is no such mu.
//!
//! Input: a system and the bounds of its critical mu. Output: [`UnboundedGrowth`], where the
//! infimum of mu is not attained but lies there, and the proof named `mass`. Called by
//! [`analyse`](super::analyse).

use super::conditions::{DefiniteUntil, Necessary};
use super::critical::Critical;
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::model::Model;
use super::threshold::StaticThreshold;
use mceip_exact::Interval;
use mceip_model::Window;

/// The smallest mu near which lambda^2 has no bound, where no solution is known below it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnboundedGrowth {
    /// Encloses mu.
    pub mu: Interval,
    /// Is it proved that no smaller mu has a solution, so that growth is unbounded as mu falls to
    /// it?
    pub is_from_above: bool,
    /// The certificate that M* has a solution there, and for no smaller mu.
    pub evidence: Evidence,
}

impl UnboundedGrowth {
    /// What mu does: "falls to", or where a smaller mu may have a solution "comes close to".
    pub(super) fn verb(&self) -> &'static str {
        if self.is_from_above {
            "falls to"
        } else {
            "comes close to"
        }
    }
}

/// Looks for it where the condition on M* leaves a solution of smallest mu at infinity possible.
pub(super) fn unbounded(
    model: &Model<'_>,
    necessary: &Necessary,
    critical: &Critical,
    proofs: &mut Vec<Proof>,
) -> Result<Option<UnboundedGrowth>, AnalysisError> {
    let known = critical.solution.as_ref().map(|solution| solution.mu.hi());
    let Some(DefiniteUntil::End { end, .. }) = &necessary.mass else {
        return Ok(None);
    };

    // M* has no solution where it is positive definite.
    if known.is_some_and(|known| known < end.lo()) {
        return Ok(None);
    }

    for window in windows(end)? {
        if model.stopped() {
            return Ok(None);
        }

        let problem = model.of_mass()?.with_window(window);
        let stage = "mu of unbounded growth: M in place of K";
        let found = model.complete(stage, &problem, None)?;
        let threshold = StaticThreshold::of(&found, proofs.len());
        let Some(mu) = threshold.smallest().cloned() else {
            continue;
        };
        if known.is_some_and(|known| known < mu.lo()) {
            return Ok(None);
        }

        proofs.push(Proof {
            name: "mass".into(),
            problem,
            certificate: ProofCertificate::Solutions(found.proved),
        });

        let below = critical.absent_below.as_ref();
        return Ok(Some(UnboundedGrowth {
            is_from_above: below.is_some_and(|below| below >= mu.lo()),
            mu,
            evidence: threshold.evidence,
        }));
    }

    Ok(None)
}

/// Where the mu is looked for: at the end of definiteness of M* first, if that is known exactly.
fn windows(end: &Interval) -> Result<Vec<Window>, AnalysisError> {
    let mut windows = Vec::new();
    if end.is_point() {
        windows.push(Window::new(end.lo().clone(), Some(end.hi().clone()))?);
    }
    windows.push(Window::all());
    Ok(windows)
}
