//! The answer in words: one short sentence for each question, with what stands behind it.

use super::answer::Analysis;
use super::conditions::{DefiniteUntil, approximately};
use super::divergence::Verdict;
use super::evidence::Evidence;
use super::modes::Mode;
use super::ranges::Range;
use mceip_check::OpenRegion;
use mceip_exact::{Interval, Rational, enclosing_decimals, to_f64};

/// One sentence of the answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sentence {
    /// What it is about: `divergence`, `static_threshold`, ...
    pub topic: &'static str,
    /// The sentence.
    pub text: String,
    /// What stands behind it.
    pub evidence: Evidence,
}

const OUTSIDE: &str = "Outside (8), and so not answered: flutter, stick-slip growth, finite \
                       motions, other contact states; \
                       absence of divergence of the form (8) is not stability.";

/// Ends of an enclosure in short decimals, rounded outwards.
fn between(v: &Interval) -> String {
    let (lo, hi) = enclosing_decimals(v, 9);
    if lo == hi {
        format!("= {lo}")
    } else {
        format!("in [{lo}, {hi}]")
    }
}

/// A rational as a decimal that is not above it: for bounds below which nothing exists.
fn down(v: &Rational) -> String {
    enclosing_decimals(&Interval::point(v.clone()), 9).0
}

fn short(v: &Rational) -> String {
    let text = format!("{:.6}", to_f64(v));
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

fn open_text(word: &str, open: &[OpenRegion]) -> String {
    let region = |o: &OpenRegion| {
        let max = o.max.as_ref().map_or_else(|| "infinity".into(), short);
        format!("{word} in [{}, {max}]", short(&o.min))
    };
    let first: Vec<String> = open.iter().take(3).map(region).collect();
    let more = if open.len() > 3 {
        format!(" and {} more regions", open.len() - 3)
    } else {
        String::new()
    };
    format!("{}{more}", first.join(", "))
}

impl Analysis {
    /// The sentences, most important first. Growth rates in 1/s and lambda^2 in 1/s^2 if K and M
    /// are in consistent units (N/m and kg; N/mm and t).
    pub fn sentences(&self) -> Vec<Sentence> {
        let mut all = vec![self.say_divergence()];
        all.extend(self.say_modes());
        all.extend([self.say_threshold(), self.say_critical()]);
        all.extend(self.say_solution());
        all.extend(self.say_ranges());
        all.extend([
            self.say_necessary(),
            self.say_sufficient(),
            self.say_flutter(),
        ]);
        all.push(Sentence {
            topic: "outside",
            text: OUTSIDE.into(),
            evidence: Evidence::Exact("definition (8)"),
        });
        all
    }

    fn state(&self) -> String {
        format!(
            "For this contact state, taken as impending slip at mu = {},",
            short(&self.friction)
        )
    }

    fn say_divergence(&self) -> Sentence {
        let d = &self.divergence;
        let n = d.modes.len();
        let what = match d.verdict {
            Verdict::Present => format!(
                "divergence instability of the form (8) is PRESENT: {n} solution{}{}{}.",
                if n == 1 { "" } else { "s" },
                if d.families == 0 {
                    String::new()
                } else {
                    format!(
                        " and {} families of solutions (cones or ranges)",
                        d.families
                    )
                },
                if d.open.is_empty() {
                    " and no other".into()
                } else {
                    format!(", others undecided for {}", open_text("lambda^2", &d.open))
                }
            ),
            Verdict::Absent => {
                "divergence instability of the form (8) is ABSENT for every lambda^2 >= 0.".into()
            }
            Verdict::Undecided => {
                format!(
                    "divergence instability of the form (8) is UNDECIDED: open for {}.",
                    open_text("lambda^2", &d.open)
                )
            }
        };
        Sentence {
            topic: "divergence",
            text: format!("{} {what}", self.state()),
            evidence: d.evidence.clone(),
        }
    }

    fn say_modes(&self) -> Vec<Sentence> {
        let say = |(k, m): (usize, &Mode)| {
            let growth = if m.growth_rate > 0.0 {
                format!("growth rate lambda = {:.6} 1/s", m.growth_rate)
            } else {
                "growth rate 0 (a threshold: departure linear in time)".into()
            };
            let text = format!(
                "Mode {}: {growth}, lambda^2 {} 1/s^2; particles {:?} slip, {:?} do not move; v \
                 over all degrees of freedom in the JSON, slip rates summing to 1.",
                k + 1,
                between(&m.lambda2),
                m.slipping,
                m.sticking
            );
            Sentence {
                topic: "mode",
                text,
                evidence: self.divergence.evidence.clone(),
            }
        };
        self.divergence.modes.iter().enumerate().map(say).collect()
    }

    fn say_threshold(&self) -> Sentence {
        let t = &self.threshold;
        let text = match (t.smallest(), t.open.is_empty()) {
            (Some(mu), _) => format!(
                "Static threshold: the smallest mu with lambda = 0: mu {}.",
                between(mu)
            ),
            (None, true) => {
                "Static threshold: none; no mu >= 0 has a solution with lambda = 0.".into()
            }
            (None, false) => format!(
                "Static threshold: UNDECIDED for {}.",
                open_text("mu", &t.open)
            ),
        };
        Sentence {
            topic: "static_threshold",
            text,
            evidence: t.evidence.clone(),
        }
    }

    fn say_critical(&self) -> Sentence {
        let text = match &self.critical.absent_below {
            None => {
                "Critical mu: no mu has divergence of the form (8), for any lambda^2 >= 0.".into()
            }
            Some(b) => format!(
                "Critical mu: for 0 <= mu < {} there is no solution for any lambda^2 >= 0.",
                down(b)
            ),
        };
        Sentence {
            topic: "critical_absence",
            text,
            evidence: self.critical.evidence.clone(),
        }
    }

    fn say_solution(&self) -> Option<Sentence> {
        let s = self.critical.solution.as_ref()?;
        let text = format!(
            "Critical mu: a solution is proved at mu {} with lambda^2 {} 1/s^2, so the critical mu \
             is at most that.",
            between(&s.mu),
            between(&s.lambda2)
        );
        Some(Sentence {
            topic: "critical_solution",
            text,
            evidence: s.evidence.clone(),
        })
    }

    fn say_ranges(&self) -> Option<Sentence> {
        let say = |r: &Range| {
            format!(
                "{} from {} to {}",
                r.verdict.word(),
                short(&r.from),
                short(&r.to)
            )
        };
        let parts: Vec<String> = self.ranges.iter().map(say).collect();
        (!parts.is_empty()).then(|| Sentence {
            topic: "ranges",
            text: format!(
                "Divergence against mu, with this contact state: {}.",
                parts.join(", ")
            ),
            evidence: Evidence::Measured(
                "decided by a complete search at each of the sampled mu, not between them",
            ),
        })
    }

    fn say_necessary(&self) -> Sentence {
        let n = &self.necessary;
        let until = |u: &DefiniteUntil, rel: &str| match u {
            DefiniteUntil::Never => "for every mu".to_string(),
            DefiniteUntil::Always => "for no mu".into(),
            DefiniteUntil::End { end, .. } => format!("for mu {rel} {:.9}", approximately(end)),
        };
        let here = match n.holds_at(&self.friction) {
            Some(true) => "it holds at this mu",
            Some(false) => "it does not hold at this mu, which alone excludes divergence",
            None => "this mu is too close to the end to say",
        };
        let text = match &n.mass {
            Some(m) if !n.mass_is_constant => format!(
                "Necessary condition (19): K* is not positive definite {}, M* is not positive \
                 semidefinite {}; {here}.",
                until(&n.stiffness, ">="),
                until(m, ">")
            ),
            _ => format!(
                "Necessary condition (20): K* is not positive definite {}; {here}.",
                until(&n.stiffness, ">=")
            ),
        };
        Sentence {
            topic: "necessary",
            text,
            evidence: Evidence::Exact(
                "exact LDL' on both sides of the end of definiteness, or its polynomial",
            ),
        }
    }

    fn say_sufficient(&self) -> Sentence {
        let text = match self.sufficient {
            Some(true) => {
                "Sufficient condition (17)-(18): holds at this mu; every slip particle moves or \
                 may move."
            }
            Some(false) => {
                "Sufficient condition (17)-(18): does not hold at this mu; no all-slip solution."
            }
            None => "Sufficient condition (17)-(18): UNDECIDED at this mu.",
        };
        Sentence {
            topic: "sufficient",
            text: text.into(),
            evidence: self.divergence.evidence.clone(),
        }
    }

    fn say_flutter(&self) -> Sentence {
        let text = match &self.flutter {
            None => "Flutter: not examined (no all-slip eigenvalues in doubles).".into(),
            Some(f) if f.eigenvalues.is_empty() => {
                "Flutter: the all-slip pencil at this mu has no complex lambda^2.".into()
            }
            Some(f) => format!(
                "WARNING of flutter: the all-slip pencil at this mu has {} complex pair{} \
                 lambda^2; the fastest grows at {:.6} 1/s, {:.6} rad/s.",
                f.eigenvalues.len(),
                if f.eigenvalues.len() == 1 { "" } else { "s" },
                f.growth_rate,
                f.frequency
            ),
        };
        Sentence {
            topic: "flutter",
            text,
            evidence: Evidence::Measured("eigenvalues in doubles"),
        }
    }
}
