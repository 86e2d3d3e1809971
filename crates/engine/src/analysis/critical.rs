//! The critical mu: the infimum of mu over all lambda^2 >= 0 at which a solution exists, folds
//! included, between a proved bound and a solution.
//!
//! Below: condition (19) excludes solutions up to its end, and a cover of (lambda^2, mu) by boxes
//! without solutions ([`absence`]) carries the bound further. Above: the static threshold and the
//! solutions at the mu of the analysis are known; where the cover met a box that it could not
//! empty, MCEIP-mu is solved completely at some lambda^2 of that box.
//!
//! Input: what [`analyse`](super::analyse) has found so far ([`Known`]). Output: [`Critical`], and
//! a proof named `critical` if a smaller solution was found.

use super::absence::{Absence, absence};
use super::conditions::Necessary;
use super::divergence::Divergence;
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof};
use super::model::Model;
use super::threshold::StaticThreshold;
use crate::reduction::MuFamily;
use mceip_exact::{Interval, Rational, from_f64, to_f64, whole};
use mceip_model::Window;
use num_traits::Zero;

/// A solution that is proved to exist: with these values of lambda^2 and mu.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CertifiedSolution {
    /// Encloses mu.
    pub mu: Interval,
    /// Encloses lambda^2.
    pub lambda2: Interval,
    /// Its certificate.
    pub evidence: Evidence,
}

/// What is proved about the smallest mu with divergence.
#[derive(Debug, Clone)]
pub struct Critical {
    /// For no lambda^2 >= 0 is there a solution with mu below this (not included); `None`: for no
    /// mu at all.
    pub absent_below: Option<Rational>,
    /// Why.
    pub evidence: Evidence,
    /// The solution of smallest mu that was found.
    pub solution: Option<CertifiedSolution>,
    /// The cover behind the bound, where one was tried.
    pub cover: Option<Absence>,
}

const BY_CONDITION: Evidence = Evidence::Exact(
    "condition (19): K* positive definite and M* positive semidefinite below it, by exact LDL' and \
     linearity in mu",
);
const BY_COVER: Evidence = Evidence::Exact(
    "cover of lambda^2 >= 0 and smaller mu by boxes with Farkas vectors, verified in integers",
);

/// What is known about a system before its critical mu is sought.
pub(super) struct Known<'a> {
    pub(super) family: &'a MuFamily,
    pub(super) necessary: &'a Necessary,
    /// The mu of the analysis.
    pub(super) friction: &'a Rational,
    /// Divergence at that mu.
    pub(super) divergence: &'a Divergence,
    pub(super) threshold: &'a StaticThreshold,
}

impl Known<'_> {
    /// The known solution of smallest mu: at the static threshold (lambda = 0), or at the mu of the
    /// analysis.
    fn smallest_solution(&self) -> Option<CertifiedSolution> {
        let at_threshold = self.threshold.values.first().map(|mu| CertifiedSolution {
            mu: mu.clone(),
            lambda2: Interval::point(Rational::zero()),
            evidence: self.threshold.evidence.clone(),
        });
        let Some(mode) = self.divergence.modes.first() else {
            return at_threshold;
        };

        match at_threshold {
            Some(solution) if solution.mu.hi() <= self.friction => Some(solution),
            _ => Some(CertifiedSolution {
                mu: Interval::point(self.friction.clone()),
                lambda2: mode.lambda2.clone(),
                evidence: self.divergence.evidence.clone(),
            }),
        }
    }
}

/// Bounds the infimum from both sides.
pub(super) fn critical(
    model: &Model<'_>,
    known: &Known<'_>,
    proofs: &mut Vec<Proof>,
) -> Result<Critical, AnalysisError> {
    let Some(excluded) = known.necessary.excluded_below() else {
        return Ok(Critical {
            absent_below: None,
            evidence: BY_CONDITION,
            solution: None,
            cover: None,
        });
    };

    let cover = if model.stopped() {
        None
    } else {
        absence(known.family, &excluded, model.options.limits, &model.watch)
    };

    let (absent_below, evidence) = match &cover {
        Some(cover) if cover.below.as_ref().is_none_or(|b| *b > excluded) => {
            (cover.below.clone(), BY_COVER)
        }
        _ => (Some(excluded), BY_CONDITION),
    };

    let mut solution = known.smallest_solution();
    let blocked = cover.as_ref().and_then(|c| c.blocked.as_ref());
    if let Some((lo, hi)) = blocked
        && let Some(below) = &absent_below
    {
        for lambda2 in sampled_values(lo, hi.as_ref()) {
            let smaller = smaller_solution(model, &lambda2, below, solution.as_ref(), proofs)?;
            solution = smaller.or(solution);
        }
    }

    Ok(Critical {
        absent_below,
        evidence,
        solution,
        cover,
    })
}

/// Values of lambda^2 in the box that could not be emptied: its ends and its middle.
fn sampled_values(lo: &Rational, hi: Option<&Rational>) -> Vec<Rational> {
    let Some(hi) = hi else {
        return vec![lo.clone()];
    };

    let middle = (lo + hi) / whole(2);
    let short_middle = from_f64(to_f64(&middle)).unwrap_or(middle);
    vec![lo.clone(), short_middle, hi.clone()]
}

/// How far above the bound a solution at a fixed lambda^2 is looked for when none is known.
const REACH: i64 = 2;

/// The solution of smallest mu at a fixed lambda^2, if that is below the mu of the known one.
///
/// Its proof takes the place of the one named `critical` so far. lambda = 0 is left out: there the
/// static threshold is the smallest.
fn smaller_solution(
    model: &Model<'_>,
    lambda2: &Rational,
    below: &Rational,
    known: Option<&CertifiedSolution>,
    proofs: &mut Vec<Proof>,
) -> Result<Option<CertifiedSolution>, AnalysisError> {
    let top = match known {
        Some(solution) => solution.mu.hi().clone(),
        None => below * whole(REACH),
    };

    if model.stopped() || lambda2.is_zero() || top <= *below {
        return Ok(None);
    }

    let window = Window::new(below.clone(), Some(top))?;
    let problem = model.at_lambda2(lambda2)?.with_window(window);
    let found = model.complete(&problem)?;
    let Some(smallest) = found.cover.solutions.first() else {
        return Ok(None);
    };

    let mu = smallest.value.clone();
    if known.is_some_and(|solution| mu.hi() >= solution.mu.hi()) {
        return Ok(None);
    }

    proofs.retain(|p| p.name != "critical");
    proofs.push(Proof {
        name: "critical".into(),
        problem,
        certificate: found.certificate,
    });

    Ok(Some(CertifiedSolution {
        mu,
        lambda2: Interval::point(lambda2.clone()),
        evidence: Evidence::Certificate(proofs.len() - 1),
    }))
}
