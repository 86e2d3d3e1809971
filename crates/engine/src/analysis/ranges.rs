//! Where in mu does divergence exist?
//!
//! Below the proved bound of the critical mu there is none: one range, with the certificate of the
//! bound. From just above the solution of smallest mu to twice the largest mu of interest presence
//! is proved on intervals (`presence`), each with a certificate. What they leave out is decided
//! with certificates at values of mu (samples): those of evenly spread ones that lie outside, one
//! in each gap, and then by halving between neighbours of different verdicts. Neighbouring samples
//! of one verdict make a range. Between samples nothing is proved, except where `absent_ranges`
//! finds a cover.
//!
//! Input: what is known of the system, and its critical mu. Output: [`Ranges`]. Called by
//! [`analyse`](super::analyse).

use super::absence::{HalfLineFamily, PrecisePlace};
use super::absent_ranges;
use super::answer::Analysis;
use super::critical::{BranchStart, CertifiedSolution, Critical, CriticalFound, KnownOfSystem};
use super::divergence::{Verdict, verdict};
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::model::AnalysisModel;
use super::presence::{PresenceGround, Prover};
use super::starts;
use crate::run::Progress;
use crate::search::complete::Completed;
use crate::tolerance::ABOVE_CRITICAL;
use mceip_check::certificate::PresenceCertificate;
use mceip_check::{AcceptedPresence, Proved};
use mceip_exact::{Interval, Rational, from_f64, parse, rational, to_f64, upper_decimal, whole};
use mceip_model::Problem;
use num_traits::Zero;

/// Divergence at one mu, decided by a complete search over lambda^2 in [0, infinity), or present by
/// the certificate of an interval around it.
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
    /// Its lower end: 0, that of a proved interval, or the first sample.
    pub from: Rational,
    /// Its upper end: the bound below which all is absent (not included), that of a proved
    /// interval, or the last sample; `None` for infinity.
    pub to: Option<Rational>,
    /// What stands behind it: what proves it everywhere between its ends, or for samples a
    /// measurement, because nothing is proved between them.
    pub evidence: Evidence,
}

impl Analysis {
    /// Does what is said of a range hold at its lower end? Absence from 0 on is that for mu > 0
    /// where mu = 0, at which slip particles may slide either way, is not proved to have none.
    pub fn is_from_included(&self, range: &Range) -> bool {
        !range.is_absence_from_zero() || self.without_friction == Verdict::Absent
    }
}

impl Range {
    /// Does what is said of the range hold at its upper end? Absence from 0 on is that below the
    /// bound, which may be a critical mu itself.
    pub fn is_to_included(&self) -> bool {
        self.to.is_some() && !self.is_absence_from_zero()
    }

    fn is_absence_from_zero(&self) -> bool {
        self.verdict == Verdict::Absent && self.from.is_zero()
    }
}

/// Behind a range of samples.
const AT_SAMPLES: Evidence =
    Evidence::Measured("decided by a complete search at each of the sampled mu, not between them");

/// Halvings of the interval between neighbouring samples of different verdicts.
const HALVINGS: usize = 8;

/// Where divergence begins at mu = 0, the first sample is the last one divided by this.
const LEAST_PART_OF_TOP: i64 = 1 << 10;

/// Gaps between proved intervals that get a sample of their own, at most.
const SAMPLED_GAPS: usize = 4;

/// Order beyond which the system is not condensed a second time for presence.
const LARGEST_ORDER_CONDENSED_TWICE: usize = 1000;

/// Ranges of mu and what has been found on the way.
pub(super) struct Ranges {
    /// The critical mu, with a solution of smaller mu where one was proved on the way.
    pub(super) critical: Critical,
    pub(super) ranges: Vec<Range>,
    pub(super) samples: Vec<Sample>,
}

/// The proved range below the bound, and from it to twice the largest mu of interest what is proved
/// present, and samples of the rest.
pub(super) fn ranges(
    model: &AnalysisModel<'_>,
    known: &KnownOfSystem<'_>,
    found: CriticalFound,
    proofs: &mut Vec<Proof>,
) -> Result<Ranges, AnalysisError> {
    let mut critical = found.critical;
    let absent = below_bound(&critical);

    let Some(below) = &critical.absent_below else {
        return Ok(Ranges {
            critical,
            ranges: Vec::from_iter(absent),
            samples: Vec::new(),
        });
    };

    let top = rounded_up(largest_of_interest(known, &critical) * whole(2));
    let bottom = first_sample(&critical, below, &top);
    let mut sampler = Sampler {
        model,
        slip: known.families.own.stiffness.slip(),
        proved: Vec::new(),
        starts: Vec::new(),
        smallest: None,
    };

    let mut prover = prover(model, known, found.family, &found.places, &top)?;
    if let (Some(prover), Some(start)) = (&mut prover, &found.start) {
        let task = PresenceTask {
            model,
            known,
            smallest: start,
            bottom: to_f64(&bottom),
            top: &top,
        };

        task.prove(prover);
        if let Some(precise) = task.proved_precisely(prover, &found.places) {
            *prover = precise;
        }
        sampler.proved = prover.certified();
        keep_presence(model, known, &sampler.proved);
    }

    let mut samples = sampler.even_samples(&bottom, &top)?;
    sampler.sample_gaps(&mut samples)?;
    if let Some(prover) = &mut prover {
        let starts = std::mem::take(&mut sampler.starts);
        if prover.close(to_f64(&bottom), to_f64(&top), &starts) {
            sampler.proved = prover.certified();
            keep_presence(model, known, &sampler.proved);
        }
    }
    sampler.refine(&mut samples)?;

    let first = proofs.len();
    let proved = std::mem::take(&mut sampler.proved);
    let is_new = critical.solution.is_none();
    let sampled = sampler.smallest.filter(|_| is_new).and_then(solution_of);
    for (k, certificate) in proved.iter().enumerate() {
        let certificate = ProofCertificate::Presence(certificate.clone());
        proofs.push(Proof::new(
            presence_name(k),
            known.problem.clone(),
            certificate,
        ));
    }

    if let Some((solution, proof)) = sampled {
        critical.solution = Some(CertifiedSolution {
            evidence: Evidence::Certificate(proofs.len()),
            ..solution
        });
        proofs.push(proof);
    }
    if let Some(smaller) = smaller_solution(&critical, proved.first(), first) {
        critical.solution = Some(smaller);
    }

    let mut others = proved_and_sampled(&proved, first, &samples);
    absent_ranges::prove(model, known, &mut others, proofs);
    let mut ranges = Vec::from_iter(absent);
    ranges.extend(others);

    Ok(Ranges {
        critical,
        ranges,
        samples,
    })
}

/// Keeps the proofs of presence found so far.
fn keep_presence(
    model: &AnalysisModel<'_>,
    known: &KnownOfSystem<'_>,
    proved: &[Proved<PresenceCertificate>],
) {
    for (k, certificate) in proved.iter().enumerate() {
        let certificate = ProofCertificate::Presence(certificate.clone());
        model.keep(&presence_name(k), known.problem, &certificate);
    }
}

/// The name of the k-th proof of presence, from 0.
fn presence_name(k: usize) -> String {
    format!("presence-{}", k + 1)
}

/// The range from 0 to the bound of the critical mu; `None` where no bound is proved.
fn below_bound(critical: &Critical) -> Option<Range> {
    let to = critical.absent_below.clone();
    if to.as_ref().is_some_and(Rational::is_zero) {
        return None;
    }

    Some(Range {
        verdict: Verdict::Absent,
        from: Rational::zero(),
        to,
        evidence: critical.evidence.clone(),
    })
}

/// The largest of the mu that was asked for, the thresholds, and the critical mu; 1 where all of
/// them are 0.
fn largest_of_interest(known: &KnownOfSystem<'_>, critical: &Critical) -> Rational {
    let mut largest = known.friction;
    let of_solution = critical.solution.iter().map(|s| s.mu.hi());
    for mu in known
        .threshold
        .values
        .iter()
        .map(|v| v.hi())
        .chain(of_solution)
    {
        largest = largest.max(mu);
    }

    if largest.is_zero() {
        return whole(1);
    }
    largest.clone()
}

/// Where presence is to be proved: for mu in [bottom, top], from known solutions.
struct PresenceTask<'a, 'b> {
    model: &'b AnalysisModel<'a>,
    known: &'b KnownOfSystem<'a>,
    smallest: &'b BranchStart,
    bottom: f64,
    top: &'b Rational,
}

impl<'a> PresenceTask<'a, '_> {
    /// Follows the curve of the solution of smallest mu, and in what it leaves out those of others.
    fn prove(&self, prover: &mut Prover<'a>) {
        let stage = Progress::stage("ranges of mu: proving presence");
        self.model.watch.report(&stage);

        let top = to_f64(self.top);
        if self.smallest.mu > 0.0 {
            prover.climb_from(self.smallest, top);
        }
        prover.close(self.bottom, top, &self.known.starts);
    }

    /// A second prover, condensed also about the values of lambda^2 at which `prover` failed.
    ///
    /// `None` where it proves no more to doubles, cannot be condensed, or takes long.
    fn proved_precisely(&self, prover: &Prover<'a>, places: &[PrecisePlace]) -> Option<Prover<'a>> {
        let families = self.known.families;
        let stiffness = &families.own.stiffness;
        let is_cheap = stiffness.order() <= LARGEST_ORDER_CONDENSED_TWICE;
        let is_condensed = !stiffness.free().is_empty();
        let imprecise = prover.imprecise_places();
        if !is_cheap || !is_condensed || imprecise.is_empty() || self.model.stopped() {
            return None;
        }

        let all_places = [places, &imprecise].concat();
        let family = HalfLineFamily::new(families, self.top, &all_places).ok()?;

        let mut precise = Prover::new(prover.ground(), family);
        self.prove(&mut precise);

        let top = to_f64(self.top);
        let is_better = precise.uncovered(self.bottom, top) < prover.uncovered(self.bottom, top);
        is_better.then_some(precise)
    }
}

/// What proves presence; `None` for particles with zero reaction, of which the certificates do not
/// speak, and where the work was cancelled.
fn prover<'a>(
    model: &AnalysisModel<'a>,
    known: &KnownOfSystem<'a>,
    family: Option<HalfLineFamily>,
    places: &[PrecisePlace],
    top: &Rational,
) -> Result<Option<Prover<'a>>, AnalysisError> {
    if model.stopped() || !known.families.zero.is_empty() || known.families.own.mass.is_none() {
        return Ok(None);
    }

    let ground = PresenceGround {
        problem: known.problem,
        watch: model.watch,
    };
    let family = match family {
        Some(family) => family,
        None => HalfLineFamily::new(known.families, top, places)?,
    };
    Ok(Some(Prover::new(ground, family)))
}

/// The solution at the lower end of the first proved interval, if its mu is smaller than that of
/// the certified one.
fn smaller_solution(
    critical: &Critical,
    first: Option<&Proved<PresenceCertificate>>,
    proof: usize,
) -> Option<CertifiedSolution> {
    let proved = first?;
    let from = &proved.accepted().from;
    let known = critical.solution.as_ref();
    if known.is_some_and(|known| known.mu.hi() <= from) {
        return None;
    }

    let [t0, t1] = &proved.certificate().pieces.first()?.interval;
    Some(CertifiedSolution {
        mu: Interval::point(from.clone()),
        lambda2: Interval::new(t0.0.clone(), t1.0.clone())?,
        evidence: Evidence::Certificate(proof),
    })
}

/// The first sample: just above the solution of smallest mu, or the bound where none is known; a
/// small share of the last sample where that is 0.
fn first_sample(critical: &Critical, below: &Rational, top: &Rational) -> Rational {
    let first = match &critical.solution {
        Some(solution) => {
            let above = from_f64(to_f64(solution.mu.hi()) * (1.0 + ABOVE_CRITICAL));
            above.unwrap_or_else(|_| solution.mu.hi().clone())
        }
        None => below.clone(),
    };

    if first.is_zero() {
        return top / whole(LEAST_PART_OF_TOP);
    }
    first
}

/// The solution of smallest lambda^2 that was met at a sample, with its proof.
fn solution_of(met: SampleWithSolutions) -> Option<(CertifiedSolution, Proof)> {
    let lambda2 = met.found.cover.solutions.first()?.value.clone();
    let solution = CertifiedSolution {
        mu: Interval::point(met.mu),
        lambda2,
        evidence: AT_SAMPLES,
    };
    let certificate = ProofCertificate::Solutions(met.found.proved);
    Some((solution, Proof::new("critical", met.problem, certificate)))
}

/// A sample with solutions.
struct SampleWithSolutions {
    mu: Rational,
    problem: Problem,
    found: Completed,
}

/// Decides divergence at values of mu.
struct Sampler<'a> {
    model: &'a AnalysisModel<'a>,
    /// The slip variables of the pencil.
    slip: Vec<usize>,
    /// Where presence is proved, ascending.
    proved: Vec<Proved<PresenceCertificate>>,
    /// The solutions met, in doubles.
    starts: Vec<BranchStart>,
    /// The sample of smallest mu with a solution.
    smallest: Option<SampleWithSolutions>,
}

impl Sampler<'_> {
    /// As many samples as the options ask for, evenly spread over [bottom, top]; none where that is
    /// empty.
    fn even_samples(
        &mut self,
        bottom: &Rational,
        top: &Rational,
    ) -> Result<Vec<Sample>, AnalysisError> {
        let count = self.model.options.samples;
        let steps = count.saturating_sub(1).max(1);
        let mut samples = Vec::new();
        if bottom > top {
            return Ok(samples);
        }

        for k in 0..count {
            let part = Rational::new(k.into(), steps.into());
            let mu = bottom + (top - bottom) * part;
            let stage = format!("ranges of mu: sample {} of {count}", k + 1);
            samples.extend(self.sample(&stage, rounded_up(mu))?);
        }

        Ok(samples)
    }

    /// Puts samples into the gaps between proved intervals that have none.
    fn sample_gaps(&mut self, samples: &mut Vec<Sample>) -> Result<(), AnalysisError> {
        let mut middles = Vec::new();
        if self.model.options.samples == 0 {
            return Ok(());
        }

        for pair in self.proved.windows(2) {
            let from = &pair[0].accepted().to;
            let to = &pair[1].accepted().from;
            let is_inside = |sample: &Sample| *from < sample.mu && sample.mu < *to;
            if !samples.iter().any(is_inside) {
                middles.push((from + to) / whole(2));
            }
        }

        middles.truncate(SAMPLED_GAPS);
        for mu in middles {
            samples.extend(self.sample("ranges of mu: between proved intervals", mu)?);
        }

        samples.sort_by(|p, q| p.mu.cmp(&q.mu));
        Ok(())
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
        if self.proved.iter().any(|proved| holds(proved, &mu)) {
            let verdict = Verdict::Present;
            return Ok(Some(Sample { mu, verdict }));
        }

        if self.model.stopped() {
            return Ok(None);
        }

        let problem = self.model.problem(Some(&mu))?;
        let found = self.model.complete(stage, &problem, None)?;
        let verdict = verdict(&found);
        let met = starts(&found, &self.slip, |value| [value, to_f64(&mu)]);
        self.starts.extend(met);
        let is_smallest = self.smallest.as_ref().is_none_or(|met| mu < met.mu);
        if verdict == Verdict::Present && is_smallest {
            self.smallest = Some(SampleWithSolutions {
                mu: mu.clone(),
                problem,
                found,
            });
        }

        Ok(Some(Sample { mu, verdict }))
    }
}

/// A short number at or just above this one: of six decimals, below 0.01 of six digits.
fn rounded_up(mu: Rational) -> Rational {
    if mu < rational(1, 100) {
        return parse(&upper_decimal(&mu, 6)).unwrap_or(mu);
    }

    let six_decimals = (to_f64(&mu) * 1e6).ceil() / 1e6;
    match from_f64(six_decimals) {
        Ok(short) if short >= mu => short,
        _ => mu,
    }
}

/// Is this mu in a proved interval?
fn holds(proved: &Proved<PresenceCertificate>, mu: &Rational) -> bool {
    let AcceptedPresence { from, to, .. } = proved.accepted();
    from <= mu && mu <= to
}

/// The proved intervals, and runs of samples of one verdict outside them, by ascending mu. `first`
/// is the index of the first interval's proof.
fn proved_and_sampled(
    proved: &[Proved<PresenceCertificate>],
    first: usize,
    samples: &[Sample],
) -> Vec<Range> {
    let mut ranges = Vec::new();
    let mut rest = samples;
    for (k, proved) in proved.iter().enumerate() {
        let AcceptedPresence { from, to, .. } = proved.accepted();
        let below = rest.partition_point(|sample| sample.mu < *from);
        ranges.extend(grouped(&rest[..below]));
        ranges.push(Range {
            verdict: Verdict::Present,
            from: from.clone(),
            to: Some(to.clone()),
            evidence: Evidence::Certificate(first + k),
        });
        rest = &rest[rest.partition_point(|sample| sample.mu <= *to)..];
    }

    ranges.extend(grouped(rest));
    ranges
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
