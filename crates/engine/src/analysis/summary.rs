//! The answer in one paragraph, for a reader who stops there.
//!
//! The mu asked for and its verdict; the mu below which nothing diverges and the mu at which
//! something does; what stands behind it. Input: an [`Analysis`]. Output: text, printed first by
//! `mceip analyze` and a part of `mceip-analysis/1`. The details follow in `sentences`.

use super::answer::Analysis;
use super::critical::CertifiedSolution;
use super::divergence::Verdict;
use super::evidence::Evidence;
use super::ranges::Range;
use super::sentences::{down, short, up};
use mceip_exact::{Rational, to_f64};

impl Analysis {
    /// The answer in one paragraph.
    pub fn summary(&self) -> String {
        let mut parts = vec![self.verdict_at_friction(), self.critical_bounds()];
        parts.extend(self.presence());
        parts.push(self.standing().to_string());
        parts.join(" ")
    }

    /// How far apart the two bounds of the critical mu are, as a share of the upper one; `None`
    /// where one of them is missing.
    pub fn critical_gap(&self) -> Option<f64> {
        let below = self.critical.absent_below.as_ref()?;
        let above = self.critical.solution.as_ref()?.mu.hi();
        Some(to_f64(&((above - below) / above)))
    }

    fn verdict_at_friction(&self) -> String {
        let mu = short(&self.friction);
        let verdict = match self.divergence.verdict {
            Verdict::Present => "PRESENT",
            Verdict::Absent => "ABSENT",
            Verdict::Undecided => "UNDECIDED",
        };

        let rates = self.divergence.modes.iter().map(|mode| mode.growth_rate);
        let growth = match rates.fold(0.0, f64::max) {
            0.0 => String::new(),
            fastest => format!(", growing at up to {fastest:.6} 1/s"),
        };

        format!("At mu = {mu} divergence of the form (8) is {verdict}{growth}.")
    }

    fn critical_bounds(&self) -> String {
        match (&self.critical.absent_below, &self.critical.solution) {
            (None, _) => "No mu has any.".into(),
            (Some(below), Some(solution)) => self.two_bounds(below, solution),
            (Some(below), None) => {
                format!(
                    "There is none below mu = {}, and none is known.",
                    down(below)
                )
            }
        }
    }

    fn two_bounds(&self, below: &Rational, solution: &CertifiedSolution) -> String {
        let is_static = to_f64(solution.lambda2.hi()) == 0.0;
        let place = if is_static {
            "at lambda = 0, the static threshold".to_string()
        } else {
            format!(
                "at lambda^2 = {:.6e} 1/s^2",
                to_f64(&solution.lambda2.mid())
            )
        };

        let gap = self.critical_gap().unwrap_or_default();
        format!(
            "There is none below mu = {}, and at mu = {} there is, {place}: the critical mu is \
             known to a relative {gap:.1e}.",
            down(below),
            up(solution.mu.hi())
        )
    }

    /// Where presence and, above the critical mu, absence are proved, and whether samples say more.
    fn presence(&self) -> Option<String> {
        let present = self.proved_presence().map(|(_, ends)| ends);
        let absent = self.proved_absence().map(|(_, ends)| ends);

        let mut clauses = Vec::new();
        clauses.extend(clause("present", present));
        clauses.extend(clause("absent", absent));
        if clauses.is_empty() {
            return None;
        }

        let is_sampled = |range: &Range| matches!(range.evidence, Evidence::Measured(_));
        let elsewhere = if self.ranges.iter().any(is_sampled) {
            "; elsewhere above the critical mu only samples are decided"
        } else {
            ""
        };
        Some(format!(
            "Divergence is {}{elsewhere}.",
            clauses.join(", and ")
        ))
    }

    fn standing(&self) -> &'static str {
        let is_open = self.interrupted || self.divergence.verdict == Verdict::Undecided;
        match (&self.critical.evidence, is_open) {
            (_, true) => {
                "What is said to be present or absent is proved by certificates that the checker \
                 has accepted, or by an exact condition; the rest is open."
            }
            (Evidence::Certificate(_), false) => {
                "All of it is proved by certificates that the checker has accepted."
            }
            (_, false) if self.zero > 0 => {
                "The bound from below rests on condition (19z), decided exactly, the rest on \
                 certificates that the checker has accepted."
            }
            (_, false) => {
                "The bound from below rests on condition (19), decided exactly, the rest on \
                 certificates that the checker has accepted."
            }
        }
    }
}

/// What is said of these intervals; `None` without any.
fn clause<'a>(word: &str, intervals: impl Iterator<Item = [&'a Rational; 2]>) -> Option<String> {
    let text_of = |[from, to]: [&Rational; 2]| format!("from {} to {}", up(from), down(to));
    let intervals: Vec<String> = intervals.map(text_of).collect();
    if intervals.is_empty() {
        return None;
    }

    Some(format!("{word} for every mu {}", intervals.join(" and ")))
}
