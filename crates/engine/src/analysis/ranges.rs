//! Where in mu does divergence exist?
//!
//! Below the proved bound of the critical mu there is none: one range, with the certificate of the
//! bound. Above it divergence is decided with certificates at values of mu (samples): evenly spread
//! ones first, and then by halving between neighbours of different verdicts. Neighbouring samples
//! of one verdict make a range; between samples nothing is proved.
//!
//! Input: the system, the mu of the analysis, and the thresholds known so far. Output: [`Sampled`].
//! Called by [`analyse`](super::analyse).

use super::critical::{CertifiedSolution, Critical};
use super::divergence::{Verdict, verdict};
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::model::Model;
use super::threshold::StaticThreshold;
use crate::search::complete::Completed;
use crate::tolerance::ABOVE_CRITICAL;
use mceip_exact::{Interval, Rational, from_f64, to_f64, whole};
use mceip_model::Problem;
use num_traits::Zero;

/// Divergence at one mu, decided by a complete search over lambda^2 in [0, infinity).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sample {
    /// mu.
    pub mu: Rational,
    /// Proved present or absent, or undecided.
    pub verdict: Verdict,
}

/// An interval of mu with one verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Range {
    /// The verdict.
    pub verdict: Verdict,
    /// Its lower end: 0, or the first sample.
    pub from: Rational,
    /// Its upper end: the bound below which all is absent (not included), or the last sample;
    /// `None` for infinity.
    pub to: Option<Rational>,
    /// What stands behind it: for the range below the bound what proves it everywhere between its
    /// ends; for samples a measurement, because nothing is proved between them.
    pub evidence: Evidence,
}

/// Behind a range of samples.
const AT_SAMPLES: Evidence =
    Evidence::Measured("decided by a complete search at each of the sampled mu, not between them");

/// Halvings of the interval between neighbouring samples of different verdicts.
const HALVINGS: usize = 8;

/// Ranges of mu and what has been found on the way.
pub(super) struct Sampled {
    pub(super) ranges: Vec<Range>,
    pub(super) samples: Vec<Sample>,
    /// A solution at the smallest of the samples, where none was known.
    pub(super) solution: Option<(CertifiedSolution, Proof)>,
}

/// The proved range below the bound, and samples from it to twice the largest mu of interest.
pub(super) fn sampled(
    model: &Model<'_>,
    friction: &Rational,
    threshold: &StaticThreshold,
    critical: &Critical,
) -> Result<Sampled, AnalysisError> {
    let mut ranges = vec![Range {
        verdict: Verdict::Absent,
        from: Rational::zero(),
        to: critical.absent_below.clone(),
        evidence: critical.evidence.clone(),
    }];

    let Some(below) = &critical.absent_below else {
        return Ok(Sampled {
            ranges,
            samples: Vec::new(),
            solution: None,
        });
    };

    let mut largest = friction;
    let of_solution = critical.solution.iter().map(|s| s.mu.hi());
    for mu in threshold.values.iter().map(|v| v.hi()).chain(of_solution) {
        largest = largest.max(mu);
    }

    let mut sampler = Sampler {
        model,
        smallest: None,
    };
    let bottom = first_sample(critical, below);
    let mut samples = sampler.even_samples(bottom, largest * whole(2))?;
    sampler.refine(&mut samples)?;

    let is_new = critical.solution.is_none();
    let solution = sampler.smallest.filter(|_| is_new).and_then(solution_of);
    ranges.extend(grouped(&samples));
    Ok(Sampled {
        ranges,
        samples,
        solution,
    })
}

/// The first sample: just above the solution of smallest mu, or the bound where none is known.
fn first_sample(critical: &Critical, below: &Rational) -> Rational {
    match &critical.solution {
        Some(solution) => {
            let above = from_f64(to_f64(solution.mu.hi()) * (1.0 + ABOVE_CRITICAL));
            above.unwrap_or_else(|_| solution.mu.hi().clone())
        }
        None => below.clone(),
    }
}

/// The solution of smallest lambda^2 that was met at a sample, with its proof.
fn solution_of(met: Met) -> Option<(CertifiedSolution, Proof)> {
    let lambda2 = met.found.cover.solutions.first()?.value.clone();
    let solution = CertifiedSolution {
        mu: Interval::point(met.mu),
        lambda2,
        evidence: AT_SAMPLES,
    };
    let proof = Proof {
        name: "critical".into(),
        problem: met.problem,
        certificate: ProofCertificate::Solutions(met.found.certificate),
    };
    Some((solution, proof))
}

/// A sample with solutions.
struct Met {
    mu: Rational,
    problem: Problem,
    found: Completed,
}

/// Decides divergence at values of mu.
struct Sampler<'a> {
    model: &'a Model<'a>,
    /// The sample of smallest mu with a solution.
    smallest: Option<Met>,
}

impl Sampler<'_> {
    /// As many samples as the options ask for, evenly spread over [bottom, top]; none where that is
    /// empty.
    fn even_samples(
        &mut self,
        bottom: Rational,
        top: Rational,
    ) -> Result<Vec<Sample>, AnalysisError> {
        let count = self.model.options.samples;
        let steps = count.saturating_sub(1).max(1);
        let mut samples = Vec::new();
        if bottom > top {
            return Ok(samples);
        }

        for k in 0..count {
            let part = Rational::new(k.into(), steps.into());
            let mu = &bottom + (&top - &bottom) * part;
            let stage = format!("ranges of mu: sample {} of {count}", k + 1);
            samples.extend(self.sample(&stage, rounded_up(mu))?);
        }

        Ok(samples)
    }

    /// Puts samples between neighbours of different verdicts, each in the middle of the interval in
    /// which the verdict changes.
    fn refine(&mut self, samples: &mut Vec<Sample>) -> Result<(), AnalysisError> {
        let mut i = 0;
        while i + 1 < samples.len() {
            for _ in 0..HALVINGS {
                let left = &samples[i];
                let right = &samples[i + 1];
                if left.verdict == right.verdict {
                    break;
                }

                let mu = (&left.mu + &right.mu) / whole(2);
                let Some(middle) = self.sample("ranges of mu: where the verdict changes", mu)?
                else {
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
    fn sample(&mut self, stage: &str, mu: Rational) -> Result<Option<Sample>, AnalysisError> {
        if self.model.stopped() {
            return Ok(None);
        }

        let problem = self.model.problem(Some(&mu))?;
        let found = self.model.complete(stage, &problem)?;
        let verdict = verdict(&found);
        let is_smallest = self.smallest.as_ref().is_none_or(|met| mu < met.mu);
        if verdict == Verdict::Present && is_smallest {
            self.smallest = Some(Met {
                mu: mu.clone(),
                problem,
                found,
            });
        }

        Ok(Some(Sample { mu, verdict }))
    }
}

/// A number of six decimals at or just above this one.
fn rounded_up(mu: Rational) -> Rational {
    let six_decimals = (to_f64(&mu) * 1e6).ceil() / 1e6;
    match from_f64(six_decimals) {
        Ok(short) if short >= mu => short,
        _ => mu,
    }
}

/// Runs of samples of one verdict.
fn grouped(samples: &[Sample]) -> Vec<Range> {
    let mut ranges: Vec<Range> = Vec::new();
    for sample in samples {
        let to = Some(sample.mu.clone());
        match ranges.last_mut() {
            Some(range) if range.verdict == sample.verdict => range.to = to,
            _ => ranges.push(Range {
                verdict: sample.verdict,
                from: sample.mu.clone(),
                to,
                evidence: AT_SAMPLES,
            }),
        }
    }

    ranges
}
