//! The answer in words: one short sentence for each question, with what stands behind it.
//!
//! Input: an [`Analysis`]. Output: its sentences, for people (`mceip analyze`) and as a part of
//! `mceip-analysis/1`. The words PRESENT, ABSENT and UNDECIDED are printed as the verdicts of
//! accepted certificates only, and of the theorems of `by_theorem`.

use super::answer::Analysis;
use super::by_theorem::NOT_DEFINITE;
use super::conditions::DefiniteUntil;
use super::critical::Obstacle;
use super::divergence::Verdict;
use super::evidence::Evidence;
use super::flutter::Flutter;
use super::members::FirstOrder;
use super::modes::{Mode, ZeroMode};
use super::ranges::Range;
use super::stability::Stability;
use super::threshold::StaticThreshold;
use crate::report::{counted, short, six_digits};
use mceip_check::{OpenRegion, SolutionFamily};
use mceip_exact::{
    Interval, Rational, enclosing_decimals, from_f64, nearest_decimal, upper_decimal,
};
use num_traits::{Signed, Zero};

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

/// The beginning and the end of what is said of everything else.
const OUTSIDE: [&str; 2] = [
    "Outside (8), and so not answered: flutter of steady sliding",
    ", stick-slip growth, finite motions, other contact states; absence of divergence of the form \
     (8) is not stability.",
];

/// Ends of an enclosure in short decimals, rounded outwards.
pub(super) fn between(v: &Interval) -> String {
    let (lo, hi) = enclosing_decimals(v, 9);
    if lo == hi {
        format!("= {lo}")
    } else {
        format!("in [{lo}, {hi}]")
    }
}

/// A rational as a decimal that is not above it: for bounds below which nothing exists.
pub(super) fn down(v: &Rational) -> String {
    enclosing_decimals(&Interval::point(v.clone()), 9).0
}

/// A rational as a decimal that is not below it.
pub(super) fn up(v: &Rational) -> String {
    upper_decimal(v, 9)
}

/// The number itself: a decimal where twelve digits spell it, or else a fraction beside the rounded
/// decimal where it is short; about 17 digits of any other.
pub(super) fn exactly(v: &Rational) -> String {
    let (lo, hi) = enclosing_decimals(&Interval::point(v.clone()), 12);
    if lo == hi {
        return lo;
    }

    let fraction = v.to_string();
    if fraction.len() <= LONGEST_FRACTION {
        format!("{fraction} ({})", short(v))
    } else {
        format!("about {}", nearest_decimal(v, 17))
    }
}

/// Characters of a fraction that a sentence shows.
const LONGEST_FRACTION: usize = 24;

/// Regions or values named in a sentence; the others are counted.
const NAMED: usize = 3;

/// Costs of radii that a sentence names.
const NAMED_COSTS: usize = 3;

/// "a, b, c and 4 more".
fn named(all: &[String]) -> String {
    let first = all[..all.len().min(NAMED)].join(", ");
    match all.len().saturating_sub(NAMED) {
        0 => first,
        more => format!("{first} and {more} more"),
    }
}

/// "mu in [..], mu in [..]", where `name` is mu.
fn open_text(name: &str, open: &[OpenRegion]) -> String {
    let region = |region: &OpenRegion| {
        // Values of lambda^2 and mu are not negative.
        let min = region.min.as_ref().map_or_else(|| "0".into(), down);
        let max = match &region.max {
            Some(max) => up(max),
            None => "infinity".into(),
        };
        format!("{name} in [{min}, {max}]")
    };

    named(&open.iter().map(region).collect::<Vec<_>>())
}

/// For which mu a matrix is `definite`; `relation` is ">=" where it is not so at the end itself,
/// else ">".
fn definite_text(matrix: &str, definite: &str, until: &DefiniteUntil, relation: &str) -> String {
    match until {
        DefiniteUntil::NotAtZero(_) => format!("{matrix} is not {definite} at mu = 0"),
        DefiniteUntil::Always => format!("{matrix} is {definite} for every mu"),
        DefiniteUntil::End { end, .. } => {
            let end = up(end.hi());
            format!("{matrix} is not {definite} for mu {relation} {end}")
        }
    }
}

/// The values of mu of a family over an interval.
fn values_text(family: &SolutionFamily) -> String {
    let from = family
        .from
        .as_ref()
        .map_or_else(|| "0".into(), |from| up(from.hi()));
    match &family.to {
        None => format!("every mu > {from}"),
        Some(to) => format!("every mu between {from} and {}", down(to.lo())),
    }
}

/// The smallest mu with lambda = 0, or what is proved and what is open where that is not known.
fn threshold_text(threshold: &StaticThreshold) -> String {
    let over_intervals = threshold.intervals.iter().map(values_text);
    let mut proved: Vec<String> = over_intervals.collect();

    if let Some(smallest) = threshold.smallest() {
        let also = match proved.as_slice() {
            [] => String::new(),
            all => format!("; {} has such a solution as well", all.join(" and ")),
        };
        let smallest = between(smallest);
        return format!("the smallest mu with lambda = 0: mu {smallest}{also}");
    }

    let single = threshold.values.iter();
    proved.extend(single.map(|mu| format!("mu {}", between(mu))));
    let proved = named(&proved);
    let open = open_text("mu", &threshold.open);

    match (proved.as_str(), open.as_str()) {
        ("", "") => "none; no mu > 0 has a solution with lambda = 0".into(),
        (proved, "") => format!("lambda = 0 has a solution for {proved}"),
        ("", open) => format!("UNDECIDED for {open}"),
        (proved, open) => format!("UNDECIDED for {open}; lambda = 0 has a solution for {proved}"),
    }
}

/// What stood in the way of a bound, in words.
fn obstacle_text(reason: Obstacle) -> &'static str {
    match reason {
        Obstacle::Solution => "a box seems to hold a solution that could not be certified",
        Obstacle::Remainder => "the remainder of the condensation leaves a box open",
        Obstacle::Boxes => "the boxes allowed in a piece were used up",
        Obstacle::Refused => "the checker refused what doubles proposed",
        Obstacle::Interrupted => "the run was interrupted",
    }
}

/// The ranges of a verdict that a certificate proves, and their ends.
fn proved(ranges: &[Range], verdict: Verdict) -> impl Iterator<Item = (&Range, [&Rational; 2])> {
    let of_verdict = ranges.iter().filter(move |range| range.verdict == verdict);
    of_verdict.filter_map(|range| match (&range.evidence, &range.to) {
        (Evidence::Certificate(_), Some(to)) => Some((range, [&range.from, to])),
        _ => None,
    })
}

/// What a proved range says of every mu in it.
fn proved_sentence(topic: &'static str, range: &Range, [from, to]: [&Rational; 2]) -> Sentence {
    let word = range.verdict.word();
    let ends = format!("from {} to {}", up(from), down(to));
    Sentence {
        topic,
        text: format!("Divergence is {word} for every mu {ends}, with this contact state."),
        evidence: range.evidence.clone(),
    }
}

fn range_text(range: &Range) -> String {
    let word = range.verdict.word();
    let from = short(&range.from);
    match &range.to {
        Some(to) => format!("{word} from {from} to {}", short(to)),
        None => format!("{word} from {from} on"),
    }
}

/// Behind a gap between proved intervals.
const GAP: &str = "neither a curve that was followed nor a cover that was found reaches there";

/// Pairs of complex lambda^2 named in a sentence; the others are counted.
const NAMED_PAIRS: usize = 3;

/// Digits that tell the two ends of the onset of flutter apart: they differ by 2^-15 of themselves.
const ONSET_DIGITS: usize = 6;

fn flutter_text(flutter: &Flutter) -> String {
    let pairs = flutter.pairs();
    let count = pairs.len();
    let mut named = Vec::new();
    for pair in pairs.iter().take(NAMED_PAIRS) {
        let [hertz, frequency, growth] =
            [pair.hertz(), pair.frequency, pair.growth_rate].map(six_digits);
        named.push(format!(
            "at {hertz} Hz ({frequency} rad/s) with growth rate {growth} 1/s"
        ));
    }

    let more = if count > NAMED_PAIRS {
        format!(" and {} at higher frequencies", count - NAMED_PAIRS)
    } else {
        String::new()
    };

    let onset = flutter.onset.as_ref().map_or_else(String::new, |onset| {
        format!(
            " Of the values of mu that were tried, {} is the smallest with such a pair, and {} the \
             next one below it, without.",
            nearest_decimal(&onset.some_at, ONSET_DIGITS),
            nearest_decimal(&onset.none_at, ONSET_DIGITS)
        )
    });

    format!(
        "Flutter of steady sliding: if the body were sliding steadily in these contact states, \
         every slip particle against its reaction, it would oscillate with growing amplitude \
         {}{more}: the all-slip pencil at this mu has {} lambda^2. At rest \
         this says nothing about the equilibrium: a particle there slips one way only.{onset} \
         Damping, which is left out here, may silence slow growth, and pairs at the highest \
         frequencies may be noise of the mesh: compare two meshes.",
        named.join(", "),
        counted(count, "complex pair")
    )
}

/// "; particle 3 with zero reaction opens" for each such particle.
fn zero_text(mode: &Mode, particles: &[String]) -> String {
    let mut text = String::new();
    for (particle, what) in &mode.zero {
        let does = match what {
            ZeroMode::Open => "opens",
            ZeroMode::Stick => "does not move",
            ZeroMode::Right => "slides along its tangent",
            ZeroMode::Left => "slides against its tangent",
        };
        let name = &particles[*particle];
        text += &format!("; particle {name} with zero reaction {does}");
    }

    text
}

impl Analysis {
    /// The sentences, most important first. Growth rates in 1/s and lambda^2 in 1/s^2 if K and M
    /// are in consistent units (N/m and kg; N/mm and t).
    pub fn sentences(&self) -> Vec<Sentence> {
        let mut all = vec![self.say_divergence()];
        all.extend(self.say_modes());
        all.extend(self.say_stability());
        all.push(self.say_threshold());
        all.extend(self.say_without_friction());
        all.extend(self.say_critical());
        all.extend(self.say_unproved());
        all.extend(self.say_solution());
        all.extend(self.say_unbounded());
        all.extend(self.say_presence());
        all.extend(self.say_absence());
        all.extend(self.say_gaps());
        all.extend(self.say_ranges());
        all.extend(self.say_members());
        all.push(self.say_necessary());
        all.extend(self.say_condensed());
        all.push(self.say_sufficient());
        all.push(self.say_flutter());
        all.push(Sentence {
            topic: "outside",
            text: self.outside_text(),
            evidence: Evidence::Exact("definition (8)"),
        });
        all
    }

    fn outside_text(&self) -> String {
        let flutter = self.flutter.as_ref();
        let is_seen = flutter.is_some_and(|flutter| !flutter.eigenvalues.is_empty());
        let seen = if is_seen {
            " (but for the eigenvalues above, in doubles)"
        } else {
            ""
        };
        OUTSIDE.join(seen)
    }

    fn say_divergence(&self) -> Sentence {
        let what = match self.divergence.verdict {
            Verdict::Present => self.present_text(),
            Verdict::Absent => {
                "divergence instability of the form (8) is ABSENT for every lambda^2 >= 0.".into()
            }
            Verdict::Undecided => format!(
                "divergence instability of the form (8) is UNDECIDED: open for {}.",
                open_text("lambda^2", &self.divergence.open)
            ),
        };

        let mu = exactly(&self.friction);
        let [_, _, slip, _] = self.sizes;
        let state = if slip == 0 || self.friction.is_zero() {
            format!("With these contact states held, at mu = {mu}")
        } else {
            format!("For this contact state, taken as impending slip at mu = {mu}")
        };

        Sentence {
            topic: "divergence",
            text: format!("{state}, {what}"),
            evidence: self.divergence.evidence.clone(),
        }
    }

    fn present_text(&self) -> String {
        let divergence = &self.divergence;
        if self.friction.is_zero() {
            return "divergence instability of the form (8) is PRESENT: the stiffness on the \
                    motions that the contacts leave is not positive definite."
                .into();
        }

        let count = counted(divergence.modes.len(), "solution");
        let families = match divergence.families {
            0 => String::new(),
            families => format!(
                " and {} of solutions (cones or ranges)",
                counted(families, "family")
            ),
        };

        let others = if divergence.open.is_empty() {
            " and no other".into()
        } else {
            let open = open_text("lambda^2", &divergence.open);
            format!(", others undecided for {open}")
        };

        format!("divergence instability of the form (8) is PRESENT: {count}{families}{others}.")
    }

    fn say_modes(&self) -> Vec<Sentence> {
        let modes = self.divergence.modes.iter().enumerate();
        modes
            .map(|(index, mode)| self.say_mode(index + 1, mode))
            .collect()
    }

    fn say_mode(&self, number: usize, mode: &Mode) -> Sentence {
        let growth = match mode.growth_text() {
            Some(rate) => format!("growth rate lambda = {rate} 1/s"),
            None => "growth rate 0 (a threshold: departure linear in time)".into(),
        };

        let slipping = self.named(&mode.slipping);
        let resting = self.named(&mode.sticking);
        let zero = zero_text(mode, &self.particles);
        let where_v_is = if number == 1 {
            "; v is in the JSON, over all degrees of freedom, with slip rates that sum to 1"
        } else {
            ""
        };

        let text = format!(
            "Mode {number}: {growth}, lambda^2 {} 1/s^2; slipping: {slipping}; at rest: \
             {resting}{zero}{where_v_is}.",
            between(&mode.lambda2)
        );

        Sentence {
            topic: "mode",
            text,
            evidence: self.divergence.evidence.clone(),
        }
    }

    /// Up to which mu a small disturbance stays small.
    fn say_stability(&self) -> Option<Sentence> {
        let stability = self.stability.as_ref()?;
        let at_this_mu = if self.stable_here().is_some() {
            "so at this one too"
        } else if self.divergence.verdict == Verdict::Present {
            "at this one it is unstable"
        } else {
            "at this one stability is not proved"
        };

        Some(Sentence {
            topic: "stability",
            text: format!(
                "Stability: the equilibrium is STABLE for every mu with 0 < mu <= {}, with this \
                 contact state: a motion that begins near it, in contact{}, stays near it; \
                 {at_this_mu}.",
                down(&stability.to),
                stability.proviso()
            ),
            evidence: stability.evidence.clone(),
        })
    }

    /// What is proved of every body within the radii of the data.
    fn say_members(&self) -> Vec<Sentence> {
        let Some(members) = &self.members else {
            return Vec::new();
        };

        let topic = "members";
        let whose = "Every body within the radii of the data";
        let mut said = Vec::new();
        if let Some((below, evidence)) = &members.absent_below {
            said.push(Sentence {
                topic,
                text: format!(
                    "{whose}: with this contact state none has divergence of the form (8) at any \
                     mu with 0 < mu <= {}.",
                    down(below)
                ),
                evidence: evidence.clone(),
            });
        }
        if let Some(([from, to], evidence)) = &members.present {
            said.push(Sentence {
                topic,
                text: format!(
                    "{whose}: with this contact state each has divergence of the form (8) at every \
                     mu from {} to {}.",
                    up(from),
                    down(to)
                ),
                evidence: evidence.clone(),
            });
        }

        if let Some(obstacle) = &members.obstacle {
            said.push(Sentence {
                topic,
                text: format!("{whose}: the search ended early ({obstacle})."),
                evidence: Evidence::Measured("the radii may be larger than any proof bears"),
            });
        }

        said.push(match &members.first_order {
            Some(first_order) => Sentence {
                topic,
                text: format!("{whose}: {}.", self.first_order_text(first_order)),
                evidence: Evidence::Measured("first order in the radii, in doubles"),
            },
            None => Sentence {
                topic,
                text: format!("{whose}: no solution is known from which the critical mu may vary."),
                evidence: Evidence::Measured("the search for solutions"),
            },
        });
        said
    }

    /// Where the critical mu of members may lie, and what costs most.
    fn first_order_text(&self, first_order: &FirstOrder) -> String {
        let costs = first_order.costs.iter().take(NAMED_COSTS);
        let costs = costs.map(|cost| {
            let share = 100.0 * cost.width / first_order.width;
            format!("{} ({share:.1} %)", cost.of.text(&self.particles))
        });
        let costs: Vec<String> = costs.collect();
        let most = if costs.is_empty() {
            String::new()
        } else {
            format!("; most is due to {}", costs.join(", "))
        };

        format!(
            "to first order the critical mu is within {:.2e} of {:.7}{most}",
            first_order.width, first_order.middle
        )
    }

    /// What proves the equilibrium stable at the mu that was asked for.
    pub(super) fn stable_here(&self) -> Option<&Stability> {
        let stability = self.stability.as_ref()?;
        (self.friction.is_positive() && self.friction <= stability.to).then_some(stability)
    }

    fn say_threshold(&self) -> Sentence {
        let threshold = &self.threshold;
        Sentence {
            topic: "static_threshold",
            text: format!("Static threshold: {}.", threshold_text(threshold)),
            evidence: threshold.evidence.clone(),
        }
    }

    /// That there is divergence at mu = 0 already.
    fn say_without_friction(&self) -> Option<Sentence> {
        Some(Sentence {
            topic: "without_friction",
            text: self.without_friction_text()?,
            evidence: NOT_DEFINITE,
        })
    }

    /// The same for the summary; `None` where mu = 0 has no divergence.
    pub(super) fn without_friction_text(&self) -> Option<String> {
        if self.without_friction != Verdict::Present {
            return None;
        }

        let start = if self.is_critical_at_zero() {
            "Critical mu: 0; there"
        } else {
            "There"
        };
        Some(format!(
            "{start} is divergence without friction already: at mu = 0 the stiffness on \
             the motions that the contacts leave is not positive definite."
        ))
    }

    /// Is there divergence at mu = 0, and no mu > 0 known below which there is none?
    pub(super) fn is_critical_at_zero(&self) -> bool {
        self.without_friction == Verdict::Present && self.has_no_bound()
    }

    /// Is no mu > 0 known below which nothing diverges?
    pub(super) fn has_no_bound(&self) -> bool {
        let bound = self.critical.absent_below.as_ref();
        bound.is_some_and(Rational::is_zero)
    }

    fn say_critical(&self) -> Option<Sentence> {
        let text = match &self.critical.absent_below {
            None => {
                "Critical mu: no mu has divergence of the form (8), for any lambda^2 >= 0.".into()
            }
            Some(_) if self.has_no_bound() => return None,
            Some(bound) => format!(
                "Critical mu: for {}mu < {} there is no solution for any lambda^2 >= 0.",
                self.lower_end_text(),
                down(bound)
            ),
        };

        Some(Sentence {
            topic: "critical_absence",
            text,
            evidence: self.critical.evidence.clone(),
        })
    }

    /// "0 <= ", or "0 < " where mu = 0, at which slip particles may slide either way, has a
    /// solution.
    fn lower_end_text(&self) -> &'static str {
        match self.without_friction {
            Verdict::Absent => "0 <= ",
            Verdict::Present | Verdict::Undecided => "0 < ",
        }
    }

    /// Why no finer bound was proved, where one was tried.
    fn say_unproved(&self) -> Option<Sentence> {
        let tried = self.critical.unproved.as_ref()?;
        if self.is_critical_at_zero() {
            return None;
        }

        let place = match tried.place {
            Some([lambda2, mu]) => {
                let mu = short(&from_f64(mu).unwrap_or_default());
                let where_in_lambda2 = if lambda2.is_finite() {
                    format!("at lambda^2 = {}", six_digits(lambda2))
                } else {
                    "as lambda^2 tends to infinity".to_string()
                };
                format!(", first {where_in_lambda2}, mu = {mu}")
            }
            None => String::new(),
        };

        Some(Sentence {
            topic: "critical_unproved",
            text: format!(
                "Critical mu: absence below {} was tried and is not proved: {}{place}.",
                down(&tried.below),
                obstacle_text(tried.reason)
            ),
            evidence: Evidence::Measured("the search in doubles stopped there"),
        })
    }

    /// The solution of smallest mu; not where growth is unbounded beside it, so that its lambda^2
    /// says nothing, and not where a theorem says that the critical mu is 0.
    fn say_solution(&self) -> Option<Sentence> {
        let solution = self.critical.solution.as_ref()?;
        if self.unbounded.is_some() || self.is_critical_at_zero() {
            return None;
        }

        let mu = between(&solution.mu);
        let lambda2 = between(&solution.lambda2);

        Some(Sentence {
            topic: "critical_solution",
            text: format!(
                "Critical mu: a solution is proved at mu {mu} with lambda^2 {lambda2} 1/s^2, so \
                 the critical mu is at most that."
            ),
            evidence: solution.evidence.clone(),
        })
    }

    fn say_unbounded(&self) -> Option<Sentence> {
        let unbounded = self.unbounded.as_ref()?;
        let mu = between(&unbounded.mu);

        Some(Sentence {
            topic: "unbounded_growth",
            text: format!(
                "Critical mu: growth is unbounded as mu {} this value: mu {mu}, where the mass \
                 matrix M* loses its property (0 <= x _|_ M* x >= 0 has a solution, as in the \
                 paradox of Painleve). Beside it there is a solution with lambda^2 = {} 1/s^2, \
                 mu {}. Certificates prove both; that growth is unbounded takes the first to be \
                 regular (strict signs, a simple root).",
                unbounded.verb(),
                nearest_decimal(&unbounded.beside.lambda2, 7),
                between(&unbounded.beside.mu)
            ),
            evidence: unbounded.evidence.clone(),
        })
    }

    /// One sentence for each interval on which presence is proved.
    fn say_presence(&self) -> Vec<Sentence> {
        let said = |(range, ends)| proved_sentence("presence", range, ends);
        self.proved_presence().map(said).collect()
    }

    /// One sentence for each interval above the critical mu on which absence is proved.
    fn say_absence(&self) -> Vec<Sentence> {
        let said = |(range, ends)| proved_sentence("absence", range, ends);
        self.proved_absence().map(said).collect()
    }

    /// Where neither presence nor absence is proved between two of these intervals.
    fn say_gaps(&self) -> Option<Sentence> {
        let mut proved: Vec<[&Rational; 2]> =
            self.proved_presence().map(|(_, ends)| ends).collect();
        proved.extend(self.proved_absence().map(|(_, ends)| ends));
        proved.sort_unstable();

        let mut gaps = Vec::new();
        for pair in proved.windows(2) {
            gaps.push(format!("{} < mu < {}", down(pair[0][1]), up(pair[1][0])));
        }

        if gaps.is_empty() {
            return None;
        }

        Some(Sentence {
            topic: "presence_gaps",
            text: format!(
                "Between these intervals neither presence nor absence is proved for every mu: {}.",
                gaps.join(", ")
            ),
            evidence: Evidence::Measured(GAP),
        })
    }

    /// The ranges that are known at samples only.
    fn say_ranges(&self) -> Option<Sentence> {
        let is_sampled = |range: &&Range| range.evidence.is_measured();
        let sampled: Vec<&Range> = self.ranges.iter().filter(is_sampled).collect();
        let evidence = sampled.first()?.evidence.clone();

        let is_in = |mu: &Rational, range: &Range| {
            range.from <= *mu && range.to.as_ref().is_some_and(|to| mu <= to)
        };
        let is_counted = |mu: &Rational| sampled.iter().any(|range| is_in(mu, range));
        let count = self.samples.iter().filter(|s| is_counted(&s.mu)).count();
        let below = self.critical.absent_below.as_ref()?;
        let has_proved = self.proved_presence().chain(self.proved_absence()).count() > 0;
        let elsewhere = if has_proved { " elsewhere" } else { "" };

        let parts: Vec<String> = sampled.into_iter().map(range_text).collect();
        let text = format!(
            "Divergence{elsewhere} above mu = {}, with this contact state, at {count} sampled mu: \
             {}.",
            down(below),
            parts.join(", ")
        );
        Some(Sentence {
            topic: "ranges",
            text,
            evidence,
        })
    }

    /// The intervals with a proof of presence, and their ends.
    pub(super) fn proved_presence(&self) -> impl Iterator<Item = (&Range, [&Rational; 2])> {
        proved(&self.ranges, Verdict::Present)
    }

    /// The same for absence, without the range from 0 to the bound of the critical mu.
    pub(super) fn proved_absence(&self) -> impl Iterator<Item = (&Range, [&Rational; 2])> {
        let all = proved(&self.ranges, Verdict::Absent);
        all.filter(|(range, _)| range.from.is_positive())
    }

    fn say_necessary(&self) -> Sentence {
        let necessary = &self.necessary;
        let here = match necessary.holds_at(&self.friction) {
            Some(true) => "it holds at this mu",
            Some(false) => "it does not hold at this mu, which alone excludes divergence",
            None => "it is not decided at this mu",
        };

        let stiffness = definite_text("K*", "positive definite", &necessary.stiffness, ">=");
        let z = if self.zero > 0 { "z" } else { "" }; // Z.4: particles with zero reaction are free
        let text = match &necessary.mass {
            Some(mass) if !necessary.mass_is_constant => {
                let mass = definite_text("M*", "positive semidefinite", mass, ">");
                format!("Necessary condition (19{z}): {stiffness}, {mass}; {here}.")
            }
            _ => format!("Necessary condition (20{z}): {stiffness}; {here}."),
        };

        Sentence {
            topic: "necessary",
            text,
            evidence: Evidence::Exact(
                "proved before its end and refuted by a vector after it, or the end as a root; \
                 without one, by LDL' at this mu",
            ),
        }
    }

    /// What the condensed form excludes: solutions with lambda = 0 alone.
    fn say_condensed(&self) -> Option<Sentence> {
        let text = match self.condensed.as_ref()? {
            DefiniteUntil::NotAtZero(_) => return None,
            DefiniteUntil::Always => {
                "is positive definite for every mu: there is no static threshold.".into()
            }
            DefiniteUntil::End { end, .. } => format!(
                "is positive definite for mu < {}: there is no static threshold below.",
                down(end.lo())
            ),
        };

        Some(Sentence {
            topic: "condensed",
            text: format!(
                "Condition (19) condensed at lambda = 0: K* without the free variables {text} Of \
                 lambda^2 > 0 it says nothing."
            ),
            evidence: Evidence::Exact("the symmetric part of T, by exact LDL'"),
        })
    }

    fn say_sufficient(&self) -> Sentence {
        let text = match self.sufficient {
            None if self.zero > 0 => {
                "Sufficient condition (17)-(18): not defined where particles have zero reaction."
            }
            Some(true) => {
                "Sufficient condition (17)-(18): holds at this mu; every slip particle moves or \
                 may move."
            }
            Some(false) => {
                "Sufficient condition (17)-(18): does not hold at this mu; no all-slip solution."
            }
            None => "Sufficient condition (17)-(18): UNDECIDED at this mu.",
        };

        let evidence = match &self.divergence.evidence {
            Evidence::Certificate(_) if self.sufficient.is_none() && self.zero > 0 => {
                Evidence::Exact("conditions (17)-(18)")
            }
            evidence => evidence.clone(),
        };

        Sentence {
            topic: "sufficient",
            text: text.into(),
            evidence,
        }
    }

    fn say_flutter(&self) -> Sentence {
        let text = match &self.flutter {
            None if self.zero > 0 => {
                "Flutter: not examined; particles with zero reaction make the pencil with all \
                 particles slipping depend on the sign of v."
                    .into()
            }
            None => "Flutter: not examined (no all-slip eigenvalues in doubles).".into(),
            Some(flutter) if flutter.eigenvalues.is_empty() => {
                "Flutter of steady sliding: the all-slip pencil at this mu has no complex \
                 lambda^2."
                    .into()
            }
            Some(flutter) => flutter_text(flutter),
        };

        Sentence {
            topic: "flutter",
            text,
            evidence: Evidence::Measured("eigenvalues in doubles"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn at(mu: i64) -> Interval {
        Interval::point(whole(mu))
    }

    /// Values 3 and 7, every mu between `from` and 5, and an open region from `open` on.
    fn threshold(from: Option<i64>, open: Option<i64>) -> StaticThreshold {
        let family = |from| SolutionFamily {
            support: vec![0],
            from: Some(at(from)),
            to: Some(at(5)),
            is_point: false,
            is_alone: true,
        };
        let region = |min| OpenRegion {
            min: Some(whole(min)),
            max: None,
            moving: vec![],
            undecided: vec![0],
        };

        StaticThreshold {
            values: vec![at(3), at(7)],
            intervals: from.map(family).into_iter().collect(),
            open: open.map(region).into_iter().collect(),
            evidence: NOT_DEFINITE,
        }
    }

    /// Where the smallest value is not known, what is proved is said beside what is open.
    #[test]
    fn a_threshold_keeps_what_is_proved() {
        let expected = [
            (None, None, "the smallest mu with lambda = 0: mu = 3"),
            (
                Some(4),
                Some(6),
                "the smallest mu with lambda = 0: mu = 3; every mu between 4 and 5 has such a \
                 solution as well",
            ),
            (
                Some(2),
                None,
                "lambda = 0 has a solution for every mu between 2 and 5, mu = 3, mu = 7",
            ),
            (
                Some(2),
                Some(1),
                "UNDECIDED for mu in [1, infinity]; lambda = 0 has a solution for every mu between \
                 2 and 5, mu = 3, mu = 7",
            ),
        ];

        for (from, open, text) in expected {
            assert_eq!(threshold_text(&threshold(from, open)), text);
        }
    }

    #[test]
    fn three_are_named_and_the_others_counted() {
        let all: Vec<String> = ["a", "b", "c", "d", "e"].map(String::from).into();

        assert_eq!(named(&all[..3]), "a, b, c");
        assert_eq!(named(&all), "a, b, c and 2 more");
        assert_eq!(named(&[]), "");
    }
}
