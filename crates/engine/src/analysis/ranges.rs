//! Where in mu does divergence exist? Decided with certificates at values of mu; between them
//! measured.

use super::critical::Critical;
use super::divergence::{Verdict, verdict};
use super::error::AnalysisError;
use super::model::Model;
use super::threshold::StaticThreshold;
use mceip_exact::{Rational, from_f64, to_f64, whole};
use num_traits::Zero;

/// Divergence at one mu, decided by a complete search over lambda^2 in [0, infinity), or below the
/// proved bound of the critical mu.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sample {
    /// mu.
    pub mu: Rational,
    /// Proved present or absent, or undecided.
    pub verdict: Verdict,
}

/// Neighbouring samples of one verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Range {
    /// The verdict.
    pub verdict: Verdict,
    /// First sample of the range.
    pub from: Rational,
    /// Last sample of the range.
    pub to: Rational,
}

/// Halvings of the interval between neighbouring samples of different verdicts.
const HALVINGS: usize = 8;

/// Samples from near 0 to twice the largest mu of interest.
pub(super) fn ranges(
    model: &Model<'_>,
    friction: &Rational,
    threshold: &StaticThreshold,
    critical: &Critical,
) -> Result<(Vec<Range>, Vec<Sample>), AnalysisError> {
    let count = model.options.samples;
    let known = threshold
        .values
        .iter()
        .map(|v| v.hi().clone())
        .chain(critical.solution.iter().map(|s| s.mu.hi().clone()));
    let top = known
        .chain([friction.clone()])
        .max()
        .unwrap_or_else(Rational::zero)
        * whole(2);
    let short = |v: Rational| {
        from_f64((to_f64(&v) * 1e6).round() / 1e6)
            .ok()
            .filter(|s| *s > Rational::zero())
            .unwrap_or(v)
    };
    let mut samples = Vec::new();
    for k in 1..=count {
        let mu = short(&top * Rational::new(k.into(), count.into()));
        samples.extend(sample(model, critical, mu)?);
    }
    let mut i = 0;
    while i + 1 < samples.len() {
        for _ in 0..HALVINGS {
            let (a, b) = (&samples[i], &samples[i + 1]);
            if a.verdict == b.verdict {
                break;
            }
            let Some(middle) = sample(model, critical, (&a.mu + &b.mu) / whole(2))? else {
                break;
            };
            let below = middle.verdict == a.verdict;
            samples.insert(i + 1, middle);
            i += usize::from(below);
        }
        i += 1;
    }
    Ok((grouped(&samples), samples))
}

fn sample(
    model: &Model<'_>,
    critical: &Critical,
    mu: Rational,
) -> Result<Option<Sample>, AnalysisError> {
    if critical
        .absent_below
        .as_ref()
        .is_none_or(|below| mu < *below)
    {
        return Ok(Some(Sample {
            mu,
            verdict: Verdict::Absent,
        }));
    }
    if model.stopped() {
        return Ok(None);
    }
    let verdict = verdict(&model.complete(&model.problem(Some(&mu))?)?);
    Ok(Some(Sample { mu, verdict }))
}

fn grouped(samples: &[Sample]) -> Vec<Range> {
    let mut ranges: Vec<Range> = Vec::new();
    for s in samples {
        match ranges.last_mut() {
            Some(r) if r.verdict == s.verdict => r.to = s.mu.clone(),
            _ => ranges.push(Range {
                verdict: s.verdict,
                from: s.mu.clone(),
                to: s.mu.clone(),
            }),
        }
    }
    ranges
}
