//! The answer in one paragraph, for a reader who stops there.
//!
//! The mu asked for and its verdict; the mu below which nothing diverges and the mu at which
//! something does; what stands behind it. Input: an [`Analysis`]. Output: text, printed first by
//! `mceip analyze` and a part of `mceip-analysis/1`. The details follow in `sentences`.

use super::answer::Analysis;
use super::critical::CertifiedSolution;
use super::divergence::Verdict;
use super::evidence::Evidence;
use super::modes::Mode;
use super::sentences::{between, down, exactly, up};
use super::unbounded::UnboundedGrowth;
use mceip_exact::{Interval, Rational, nearest_decimal, to_f64};
use num_traits::Zero;

impl Analysis {
    /// The answer in one paragraph.
    pub fn summary(&self) -> String {
        let mut parts = vec![self.verdict_at_friction()];
        parts.extend(self.stable_range());
        parts.push(self.critical_bounds());
        parts.extend(self.presence());
        parts.push(self.standing().to_string());
        parts.extend(self.of_members());
        parts.join(" ")
    }

    /// The mu asked for, as it is.
    pub fn friction_text(&self) -> String {
        exactly(&self.friction)
    }

    /// How far apart the two bounds of the critical mu are, as a share of the upper one; `None`
    /// where one of them is missing.
    pub fn critical_gap(&self) -> Option<f64> {
        let below = self.critical.absent_below.as_ref()?;
        let above = self.critical.solution.as_ref()?.mu.hi();
        if self.has_no_bound() {
            return None;
        }

        Some(to_f64(&((above - below) / above)))
    }

    /// In an engineer's words, the paper's in parentheses.
    fn verdict_at_friction(&self) -> String {
        let mu = exactly(&self.friction);
        let verdict = match (self.divergence.verdict, self.stable_here()) {
            (Verdict::Present, _) => self.instability(),
            (Verdict::Absent, Some(stability)) => format!(
                "the equilibrium is stable: a motion that begins near it, in contact{}, stays near \
                 it, and none can diverge (divergence of the form (8) is ABSENT)",
                stability.proviso()
            ),
            (Verdict::Absent, None) => {
                "no motion in a fixed direction can grow without oscillation \
                                (divergence of the form (8) is ABSENT)"
                    .into()
            }
            (Verdict::Undecided, _) => {
                "it is not decided whether a motion in a fixed direction can \
                                   grow without oscillation (divergence of the form (8) is \
                                   UNDECIDED)"
                    .into()
            }
        };

        format!("With these contact states held, at mu = {mu} {verdict}.")
    }

    fn instability(&self) -> String {
        // Families and open regions may hold something faster.
        let is_all = self.divergence.families == 0 && self.divergence.open.is_empty();
        let fastest = self.divergence.modes.last();
        let rate = fastest.and_then(Mode::growth_text);
        let grows = match (&rate, fastest) {
            (Some(_), _) => "grow exponentially, without oscillation",
            (None, Some(_)) if is_all => "grow evenly in time, without oscillation",
            (None, _) => "grow without oscillation",
        };
        let rate = match rate {
            None => String::new(),
            Some(rate) if is_all => format!(", at up to about {rate} 1/s"),
            Some(rate) => format!(", one such motion at about {rate} 1/s"),
        };

        format!(
            "the equilibrium is unstable: a motion in a fixed direction can {grows} (divergence \
             of the form (8) is PRESENT){rate}"
        )
    }

    /// Up to which mu stability is proved.
    fn stable_range(&self) -> Option<String> {
        let stability = self.stability.as_ref()?;
        Some(format!(
            "It is stable for every mu above 0 up to {}{}.",
            down(&stability.to),
            stability.of_which_motions()
        ))
    }

    fn critical_bounds(&self) -> String {
        match self.without_friction_text() {
            None => self.bounds_text(),
            Some(text) if self.has_no_bound() => text,
            Some(text) => format!("{text} For mu > 0: {}", self.bounds_text()),
        }
    }

    fn bounds_text(&self) -> String {
        let Some(below) = &self.critical.absent_below else {
            return "No mu has such a motion.".into();
        };
        if let Some(unbounded) = &self.unbounded {
            return self.unbounded_text(below, unbounded);
        }

        match &self.critical.solution {
            Some(solution) => self.two_bounds(below, solution),
            None if below.is_zero() => {
                "No bound below which there is no such motion is proved, and none is known.".into()
            }
            None => format!(
                "There is no such motion below mu = {}, and none is known above.",
                down(below)
            ),
        }
    }

    fn two_bounds(&self, below: &Rational, solution: &CertifiedSolution) -> String {
        let place = if solution.lambda2.hi().is_zero() {
            "at lambda = 0, the static threshold".to_string()
        } else {
            let lambda2 = nearest_decimal(&solution.lambda2.mid(), 7);
            format!("at lambda^2 = {lambda2} 1/s^2")
        };

        if below.is_zero() {
            return format!(
                "There is such a motion {}, {place}; no bound below which there is none is proved.",
                at_some(&solution.mu)
            );
        }

        format!(
            "There is no such motion below mu = {}, and there is one {}, {place}{}.",
            down(below),
            at_some(&solution.mu),
            self.gap_text()
        )
    }

    fn unbounded_text(&self, below: &Rational, unbounded: &UnboundedGrowth) -> String {
        let ends = between(&unbounded.mu);
        let place = match ends.strip_prefix("= ") {
            Some(value) => value.to_string(),
            None => format!("a value {ends}"),
        };

        let absent = if below.is_zero() {
            "No bound below which there is no such motion is proved; growth".into()
        } else {
            format!(
                "There is no such motion below mu = {}, and growth",
                down(below)
            )
        };
        format!(
            "{absent} is unbounded as mu {} {place}, where the mass matrix M* loses its property \
             (Painleve), its solution there taken to be regular{}.",
            unbounded.verb(),
            self.gap_text()
        )
    }

    fn gap_text(&self) -> String {
        match self.critical_gap() {
            Some(0.0) => ": both are the critical mu itself, rounded".into(),
            Some(gap) => format!(
                ": the critical mu is known to a relative {}",
                two_digits_up(gap)
            ),
            None => String::new(),
        }
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

        let elsewhere = if self.has_samples() {
            "; elsewhere above the critical mu only samples are decided"
        } else {
            ""
        };
        Some(format!(
            "Divergence is {}{elsewhere}.",
            clauses.join(", and ")
        ))
    }

    /// What is proved of every body within the radii of the data.
    fn of_members(&self) -> Option<String> {
        let members = self.members.as_ref()?;
        let absent = members.absent_below.as_ref();
        let absent = absent.map(|(below, _)| {
            format!(
                "none has such a motion at any mu above 0 up to {}",
                down(below)
            )
        });
        let present = members.present.as_ref();
        let present = present.map(|([from, to], _)| {
            format!("each has one at every mu from {} to {}", up(from), down(to))
        });

        let clauses: Vec<String> = absent.into_iter().chain(present).collect();
        Some(if clauses.is_empty() {
            "All this is of the data as given; of every body within their radii nothing is proved."
                .into()
        } else {
            format!(
                "All this is of the data as given; of every body within their radii certificates \
                 prove that {}.",
                clauses.join(", and that ")
            )
        })
    }

    /// Is anything said of single mu, and not of the mu between them?
    fn has_samples(&self) -> bool {
        self.ranges.iter().any(|range| range.evidence.is_measured())
    }

    fn standing(&self) -> &'static str {
        let is_undecided = self.divergence.verdict == Verdict::Undecided;
        let is_open = self.interrupted || is_undecided || self.has_no_bound();
        if self.proofs.is_empty() {
            return "It rests on a theorem, whose hypotheses were decided exactly.";
        }
        if self.without_friction == Verdict::Present {
            return "What is said of mu = 0 rests on a theorem, whose hypothesis was decided \
                    exactly, the rest on certificates that the checker has accepted; what neither \
                    proves is open.";
        }

        match (&self.critical.evidence, is_open) {
            (_, true) => {
                "What is said to be present or absent is proved by certificates that the checker \
                 has accepted, or by an exact condition; the rest is open."
            }
            (Evidence::Certificate(_), false) if self.has_samples() => {
                "All but what the samples suggest between them is proved by certificates that the \
                 checker has accepted."
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

/// Where a mu of this enclosure lies. The end that is printed is none itself, unless it is the mu.
fn at_some(mu: &Interval) -> String {
    let text = between(mu);
    match text.strip_prefix("= ") {
        Some(value) => format!("at mu = {value}"),
        None => format!("at some mu up to {}", up(mu.hi())),
    }
}

/// A positive number in two digits, rounded upwards.
fn two_digits_up(v: f64) -> String {
    let unit = 10f64.powf(v.log10().floor() - 1.0);
    format!("{:.1e}", (v / unit).ceil() * unit)
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
