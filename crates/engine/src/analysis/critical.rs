//! The critical mu: infimum over all lambda^2 >= 0, folds included, between a proved bound and a
//! solution.

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

/// Bounds the infimum from both sides.
pub(super) fn critical(
    model: &Model<'_>,
    family: &MuFamily,
    necessary: &Necessary,
    friction: &Rational,
    divergence: &Divergence,
    threshold: &StaticThreshold,
    proofs: &mut Vec<Proof>,
) -> Result<Critical, AnalysisError> {
    let excluded = necessary.excluded_below();
    let Some(excluded) = excluded else {
        return Ok(Critical {
            absent_below: None,
            evidence: BY_CONDITION,
            solution: None,
            cover: None,
        });
    };
    let mut solution = threshold.values.first().map(|mu| CertifiedSolution {
        mu: mu.clone(),
        lambda2: Interval::point(Rational::zero()),
        evidence: threshold.evidence.clone(),
    });
    if let Some(mode) = divergence.modes.first()
        && solution.as_ref().is_none_or(|s| s.mu.hi() > friction)
    {
        let lambda2 = mode.lambda2.clone();
        solution = Some(CertifiedSolution {
            mu: Interval::point(friction.clone()),
            lambda2,
            evidence: divergence.evidence.clone(),
        });
    }
    let cover = if model.stopped() {
        None
    } else {
        absence(family, &excluded, model.options.limits, &model.watch)
    };
    let (absent_below, evidence) = match &cover {
        Some(c) if c.below.as_ref().is_none_or(|b| *b > excluded) => (c.below.clone(), BY_COVER),
        _ => (Some(excluded), BY_CONDITION),
    };
    let blocked = cover.as_ref().and_then(|c| c.blocked.as_ref());
    if let (Some((lo, hi)), Some(below)) = (blocked, &absent_below) {
        for lambda2 in places(lo, hi.as_ref()) {
            if let Some(found) = at(model, &lambda2, below, solution.as_ref(), proofs)? {
                solution = Some(found);
            }
        }
    }
    Ok(Critical {
        absent_below,
        evidence,
        solution,
        cover,
    })
}

/// Values of lambda^2 in the box that could not be emptied.
fn places(lo: &Rational, hi: Option<&Rational>) -> Vec<Rational> {
    let short = |v: Rational| from_f64(to_f64(&v)).unwrap_or(v);
    match hi {
        None => vec![lo.clone()],
        Some(hi) => vec![lo.clone(), short((lo + hi) / whole(2)), hi.clone()],
    }
}

/// How far above the bound a solution at a fixed lambda^2 is looked for when none is known.
const REACH: i64 = 2;

/// The smallest certified mu at a fixed lambda^2, if below what is known.
fn at(
    model: &Model<'_>,
    lambda2: &Rational,
    below: &Rational,
    known: Option<&CertifiedSolution>,
    proofs: &mut Vec<Proof>,
) -> Result<Option<CertifiedSolution>, AnalysisError> {
    let top = known.map_or_else(|| below * whole(REACH), |s| s.mu.hi().clone());
    if model.stopped() || lambda2.is_zero() || top <= *below {
        return Ok(None); // lambda = 0 is the static threshold
    }
    let problem = model
        .at_lambda2(lambda2)?
        .with_window(Window::new(below.clone(), Some(top))?);
    let found = model.complete(&problem)?;
    let Some(first) = found.cover.solutions.first() else {
        return Ok(None);
    };
    if known.is_some_and(|s| first.value.hi() >= s.mu.hi()) {
        return Ok(None);
    }
    let (mu, lambda2) = (first.value.clone(), Interval::point(lambda2.clone()));
    proofs.retain(|p| p.name != "critical");
    proofs.push(Proof {
        name: "critical".into(),
        problem,
        certificate: found.certificate,
    });
    Ok(Some(CertifiedSolution {
        mu,
        lambda2,
        evidence: Evidence::Certificate(proofs.len() - 1),
    }))
}
