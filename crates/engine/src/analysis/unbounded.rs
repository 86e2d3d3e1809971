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
//! The curve may be constant (for M = K all solutions have the same mu), and where the solution is
//! not regular there may be none: so growth is called unbounded only if the signs of the solution
//! are strict, and one of its support with a large lambda^2 is proved at another mu beside it.
//!
//! Input: a system and the bounds of its critical mu. Output: [`UnboundedGrowth`], where the
//! infimum of mu is not attained but lies there, and the proofs named `mass` and `large`. Called by
//! [`analyse`](super::analyse).

use super::conditions::{DefiniteUntil, Necessary};
use super::critical::Critical;
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::model::AnalysisModel;
use super::threshold::StaticThreshold;
use crate::magnitude::{binary_order, two_to};
use crate::search::complete::Completed;
use mceip_check::SolutionFamily;
use mceip_exact::{Interval, Rational, Sparse, whole};
use mceip_model::{Problem, System, Window};
use num_traits::Signed;

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
    /// A solution of large lambda^2 beside it.
    pub beside: LargeGrowth,
}

/// A proved solution of large lambda^2.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LargeGrowth {
    /// lambda^2, which is given.
    pub lambda2: Rational,
    /// Encloses the mu of the solution.
    pub mu: Interval,
}

/// The large lambda^2 is 2^this times that at which K and lambda^2 M are of one size.
const LARGE_EXPONENT: i64 = 24;

/// Within this share of mu a solution of large lambda^2 lies beside it.
const BESIDE: i64 = 64;

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
    model: &AnalysisModel<'_>,
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

        let Some(support) = regular_support(&found, &problem, &mu) else {
            return Ok(None);
        };
        let Some((beside, large)) = beside(model, &support, &mu)? else {
            return Ok(None);
        };
        let certificate = ProofCertificate::Solutions(found.proved);
        proofs.push(Proof::new("mass", problem, certificate));
        proofs.push(large);

        let below = critical.absent_below.as_ref();
        let has_none_below = below.is_some_and(|below| below >= mu.lo());
        return Ok(Some(UnboundedGrowth {
            is_from_above: has_none_below && beside.mu.lo() > mu.hi(),
            mu,
            evidence: threshold.evidence,
            beside,
        }));
    }

    Ok(None)
}

/// The support of the only solution with this mu, if its signs are strict.
fn regular_support(found: &Completed, problem: &Problem, mu: &Interval) -> Option<Vec<usize>> {
    let is_here = |value: &Interval| value.lo() <= mu.hi() && value.hi() >= mu.lo();
    let solutions = &found.cover.solutions;
    let mut here = solutions.iter().filter(|solution| is_here(&solution.value));
    let solution = here.next()?;
    let reaches_here = |family: &SolutionFamily| {
        let ends_below = family.to.as_ref().is_some_and(|to| to.hi() < mu.lo());
        let begins_above = family.from.as_ref().is_some_and(|from| from.lo() > mu.hi());
        !begins_above && !ends_below
    };
    let has_family = found.cover.families.iter().any(reaches_here);
    let is_alone = here.next().is_none() && !has_family;

    let biactive = found.biactive(problem, solution)?;
    (is_alone && biactive.is_empty()).then(|| solution.support.clone())
}

/// A solution of large lambda^2 with this support, whose mu lies beside this one and is certainly
/// another, and its proof.
fn beside(
    model: &AnalysisModel<'_>,
    support: &[usize],
    mu: &Interval,
) -> Result<Option<(LargeGrowth, Proof)>, AnalysisError> {
    let lambda2 = large_lambda2(model.system);
    let problem = model.at_lambda2(&lambda2)?;
    let found = model.complete("mu of large lambda^2", &problem, None)?;

    let reach = mu.hi() / whole(BESIDE);
    let is_beside = |value: &Interval| {
        let is_above = value.lo() > mu.hi() && value.hi() - mu.hi() <= reach;
        let is_below = value.hi() < mu.lo() && mu.lo() - value.lo() <= reach;
        is_above || is_below
    };
    let mut solutions = found.cover.solutions.iter();
    let of_branch = solutions.find(|s| s.support == support && is_beside(&s.value));
    let Some(solution) = of_branch else {
        return Ok(None);
    };

    let large = LargeGrowth {
        lambda2,
        mu: solution.value.clone(),
    };
    let certificate = ProofCertificate::Solutions(found.proved);
    Ok(Some((large, Proof::new("large", problem, certificate))))
}

/// A power of two times 2^[`LARGE_EXPONENT`], at which lambda^2 M outweighs K.
fn large_lambda2(system: &System) -> Rational {
    let largest = |matrix: &Sparse| matrix.entries().map(|(_, _, v)| v.abs()).max();
    let of_stiffness = largest(system.stiffness());
    let of_mass = system.mass().and_then(largest);
    let (Some(stiffness), Some(mass)) = (of_stiffness, of_mass) else {
        return whole(1);
    };

    two_to(binary_order(&(stiffness / mass)) + LARGE_EXPONENT)
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
