//! Where in mu does divergence exist?
//!
//! Divergence is decided with certificates at values of mu (samples): evenly spread ones first, and
//! then by halving between neighbours of different verdicts. Neighbouring samples of one verdict
//! make a range; between samples nothing is proved.
//!
//! Input: the system, the mu of the analysis, and the thresholds known so far. Output: ranges and
//! samples. Called by [`analyse`](super::analyse).

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

/// Samples from near 0 to twice the largest mu of interest, and their ranges.
pub(super) fn ranges(
    model: &Model<'_>,
    friction: &Rational,
    threshold: &StaticThreshold,
    critical: &Critical,
) -> Result<(Vec<Range>, Vec<Sample>), AnalysisError> {
    let mut largest = friction;
    let of_solution = critical.solution.iter().map(|s| s.mu.hi());
    for mu in threshold.values.iter().map(|v| v.hi()).chain(of_solution) {
        largest = largest.max(mu);
    }

    let sampler = Sampler { model, critical };
    let mut samples = sampler.even_samples(largest * whole(2))?;
    sampler.refine(&mut samples)?;
    Ok((grouped(&samples), samples))
}

/// Decides divergence at values of mu.
struct Sampler<'a> {
    model: &'a Model<'a>,
    critical: &'a Critical,
}

impl Sampler<'_> {
    /// As many samples as the options ask for, evenly spread over (0, top].
    fn even_samples(&self, top: Rational) -> Result<Vec<Sample>, AnalysisError> {
        let count = self.model.options.samples;
        let mut samples = Vec::new();
        for k in 1..=count {
            let part = Rational::new(k.into(), count.into());
            samples.extend(self.sample(rounded(&top * part))?);
        }

        Ok(samples)
    }

    /// Puts samples between neighbours of different verdicts, each in the middle of the interval in
    /// which the verdict changes.
    fn refine(&self, samples: &mut Vec<Sample>) -> Result<(), AnalysisError> {
        let mut i = 0;
        while i + 1 < samples.len() {
            for _ in 0..HALVINGS {
                let left = &samples[i];
                let right = &samples[i + 1];
                if left.verdict == right.verdict {
                    break;
                }

                let mu = (&left.mu + &right.mu) / whole(2);
                let Some(middle) = self.sample(mu)? else {
                    break;
                };
                let is_like_left = middle.verdict == left.verdict;
                samples.insert(i + 1, middle);
                if is_like_left {
                    i += 1;
                }
            }
            i += 1;
        }

        Ok(())
    }

    /// The verdict at one mu; `None` if the work was cancelled before.
    fn sample(&self, mu: Rational) -> Result<Option<Sample>, AnalysisError> {
        let absent_below = self.critical.absent_below.as_ref();
        if absent_below.is_none_or(|below| mu < *below) {
            return Ok(Some(Sample {
                mu,
                verdict: Verdict::Absent,
            }));
        }

        if self.model.stopped() {
            return Ok(None);
        }

        let problem = self.model.problem(Some(&mu))?;
        let verdict = verdict(&self.model.complete(&problem)?);
        Ok(Some(Sample { mu, verdict }))
    }
}

/// The same number to six decimals, if that is positive.
fn rounded(mu: Rational) -> Rational {
    let six_decimals = (to_f64(&mu) * 1e6).round() / 1e6;
    match from_f64(six_decimals) {
        Ok(short) if short > Rational::zero() => short,
        _ => mu,
    }
}

/// Runs of samples of one verdict.
fn grouped(samples: &[Sample]) -> Vec<Range> {
    let mut ranges: Vec<Range> = Vec::new();
    for sample in samples {
        match ranges.last_mut() {
            Some(range) if range.verdict == sample.verdict => range.to = sample.mu.clone(),
            _ => ranges.push(Range {
                verdict: sample.verdict,
                from: sample.mu.clone(),
                to: sample.mu.clone(),
            }),
        }
    }

    ranges
}
