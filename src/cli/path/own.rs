//! The own critical friction of a body under loads.
//!
//! The critical friction of a state is *frozen*: the contact states of one equilibrium are held,
//! and mu varies. But at another mu the same loads may lead to another equilibrium. Here, for each
//! mu of a grid, the loading path is followed at this mu, and the equilibrium it ends in is asked
//! whether it can diverge in the form (8). Between neighbours with different answers more mu are
//! examined until they are as near as asked for.
//!
//! The *critical friction found* is the first change among the mu examined from proved absence to
//! proved divergence, or to a path that ends although every set of contact states was tried. The
//! path is the one that `mceip_path` follows, exact but without a certificate; that it is the only
//! one is not claimed, and between two mu nothing is.
//!
//! Whether an end state diverges is decided by [`divergence_at`]: by a certificate that the checker
//! has accepted, or by the theorem for states in which nothing slips.

use super::stretches::amount;
use crate::ProvedStates;
use crate::cli::common::{CliError, positive};
use crate::cli::output::Folder;
use crate::front::certify_states;
use crate::say::path::{end_text, states_json};
use mceip_engine::analysis::{
    Analysis, Divergence, Options, Proof, Verdict, analyse, divergence_at,
};
use mceip_engine::report::{Table, six_digits};
use mceip_engine::run::{Kept, Progress, Watch};
use mceip_exact::{
    Integer, Interval, Rational, enclosing_decimals, nearest_decimal, parse, rational, whole,
};
use mceip_model::{LoadedBody, ModelError, System};
use mceip_path::{Contact, Equilibrium, LoadSteps, LoadingPath, PathEnd};
use num_traits::One;
use serde_json::{Value, json};
use std::ops::ControlFlow;

/// The mu that are asked for.
pub(super) struct Asked {
    least: Rational,
    greatest: Rational,
    /// Number of equal parts between them.
    parts: usize,
    /// How near two neighbours with different answers have to be, relative to the greater one.
    width: Rational,
}

impl Asked {
    /// From the options of the command line.
    pub(super) fn of(ends: &[String], parts: usize, width: &str) -> Result<Asked, CliError> {
        let got = ends.join(",");
        let refused = |expected| CliError::option("own-critical", expected, &got);
        let [least, greatest] = ends else {
            return Err(refused("two coefficients of friction, MIN,MAX"));
        };
        let least = positive("own-critical", least)?;
        let greatest = positive("own-critical", greatest)?;
        if least >= greatest {
            return Err(refused("MIN below MAX"));
        }

        let relative = positive("width", width)?;
        if relative < rational(1, MOST_PARTS) {
            return Err(CliError::option("width", "at least 1/10^9", width));
        }

        Ok(Asked {
            least,
            greatest,
            parts,
            width: relative,
        })
    }

    /// The ends, and short decimals near the equal parts between them.
    fn grid(&self) -> Vec<Rational> {
        let part = (&self.greatest - &self.least) / whole(self.parts as i64);
        let mut grid = vec![self.least.clone()];
        for k in 1..self.parts {
            let near = &self.least + &part * whole(k as i64);
            let quarter = &part / whole(4);
            grid.push(short_decimal(&(&near - &quarter), &(near + quarter)));
        }

        grid.push(self.greatest.clone());
        grid
    }
}

/// One over the least width: nearer neighbours are hardly told apart in print.
const MOST_PARTS: i64 = 1_000_000_000;

/// The body, condensed to its contact candidates, and its loads.
pub(super) struct Loaded<'a> {
    pub(super) body: &'a LoadedBody,
    pub(super) contact: &'a Contact,
    /// The amounts of the loads; their mu plays no part.
    pub(super) steps: &'a LoadSteps,
    /// Names of the steps.
    pub(super) names: &'a [&'a str],
}

/// What the loads lead to at a mu.
struct Point {
    mu: Rational,
    reached: Reached,
}

enum Reached {
    /// The loads are applied: the equilibrium they lead to.
    Equilibrium(Box<Examined>),
    /// The path ends before.
    NoPath(EarlyEnd),
}

/// Where a path ends before its loads are applied.
struct EarlyEnd {
    /// The step and the amount of its load.
    place: String,
    /// Why.
    reason: String,
    /// Was every set of contact states tried?
    is_certain: bool,
}

/// The equilibrium at the end of the path.
struct Examined {
    equilibrium: Equilibrium,
    /// Are its contact states proved?
    states: ProvedStates,
    divergence: Divergence,
    proof: Option<Proof>,
}

/// The answers at all mu that were examined, ascending, and the frozen critical friction beside
/// them.
pub(super) struct OwnCritical {
    points: Vec<Point>,
    /// The analysis of the state at the lower end of the bracket.
    frozen: Option<Analysis>,
}

/// What is found at a mu, as far as neighbours are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AtMu {
    Equilibrium(Verdict),
    NoPath { is_certain: bool },
}

impl OwnCritical {
    /// Examines the grid, then mu between; what is examined when the work is cancelled stays.
    /// `proofs` gets each proof as soon as it is found.
    pub(super) fn find(
        loaded: &Loaded<'_>,
        asked: &Asked,
        proofs: Option<&Folder>,
        watch: &Watch<'_>,
    ) -> Result<OwnCritical, CliError> {
        let mut points: Vec<Point> = Vec::new();
        let examine = |mu: Rational, count: usize| -> Result<Option<Point>, CliError> {
            let stage = format!("path at mu = {}, and divergence at its end", spelt(&mu));
            let mut progress = Progress::stage(&stage);
            progress.done = count as u64;
            watch.report(&progress);
            let point = loaded.examine(mu, watch)?;
            if let (Some(folder), Some(point)) = (proofs, &point) {
                point.write(folder)?;
            }
            Ok(point)
        };

        for mu in asked.grid() {
            match examine(mu, points.len())? {
                Some(point) => points.push(point),
                None => break,
            }
        }

        while let Some(k) = first_wide_change(&points, &asked.width) {
            let [lo, hi] = [&points[k].mu, &points[k + 1].mu];
            let quarter = (hi - lo) / whole(4);
            let mu = short_decimal(&(lo + &quarter), &(hi - &quarter));
            match examine(mu, points.len())? {
                Some(point) => points.insert(k + 1, point),
                None => break,
            }
        }

        let mut own = OwnCritical {
            points,
            frozen: None,
        };
        if let Bracket::Between(absent, _) = own.bracket()
            && let Reached::Equilibrium(examined) = &absent.reached
            && !watch.is_cancelled()
        {
            let frozen = loaded.frozen(&examined.equilibrium, &absent.mu, watch)?;
            if let Some(folder) = proofs {
                for proof in &frozen.proofs {
                    write_proof(folder, &format!("frozen-{}", proof.name), proof)?;
                }
            }
            own.frozen = Some(frozen);
        }

        Ok(own)
    }

    /// What the answers say of the critical friction.
    fn bracket(&self) -> Bracket<'_> {
        let is_critical = |point: &Point| point.at_mu().is_critical();
        let Some(critical) = self.points.iter().position(is_critical) else {
            let mut answers = self.points.iter().map(Point::at_mu);
            return if answers.any(AtMu::is_undecided) {
                Bracket::Undecided
            } else {
                Bracket::None
            };
        };

        let mut below = self.points[..critical].iter().rev();
        let absent = below.find(|point| point.at_mu() == ABSENT);
        match absent {
            Some(absent) => Bracket::Between(absent, &self.points[critical]),
            None => Bracket::AtMost(&self.points[critical]),
        }
    }

    /// Is nothing found because an answer is missing?
    pub(super) fn is_undecided(&self) -> bool {
        matches!(self.bracket(), Bracket::Undecided)
    }
}

/// What the answers say of the critical friction.
enum Bracket<'a> {
    /// The first mu that is proved to be critical, and before it the last one that is proved not to
    /// be: what lies between them is undecided.
    Between(&'a Point, &'a Point),
    /// The first mu that is critical; none before it is proved not to be.
    AtMost(&'a Point),
    /// No mu examined is known to be critical, and an answer is missing.
    Undecided,
    /// No mu examined is critical.
    None,
}

impl Bracket<'_> {
    /// The word of files.
    fn word(&self) -> &'static str {
        match self {
            Bracket::Between(..) => "between",
            Bracket::AtMost(_) => "at_most",
            Bracket::Undecided => "undecided",
            Bracket::None => "none",
        }
    }
}

/// No divergence, proved.
const ABSENT: AtMu = AtMu::Equilibrium(Verdict::Absent);

impl AtMu {
    /// Divergence, proved, or a path that ends, every set of contact states tried.
    fn is_critical(self) -> bool {
        let no_path = AtMu::NoPath { is_certain: true };
        self == no_path || self == AtMu::Equilibrium(Verdict::Present)
    }

    fn is_undecided(self) -> bool {
        self != ABSENT && !self.is_critical()
    }
}

/// Two neighbours with different answers that are further apart than asked for.
fn first_wide_change(points: &[Point], width: &Rational) -> Option<usize> {
    (1..points.len()).map(|k| k - 1).find(|&k| {
        let [lo, hi] = [&points[k], &points[k + 1]];
        lo.at_mu() != hi.at_mu() && &hi.mu - &lo.mu > width * &hi.mu
    })
}

impl Loaded<'_> {
    /// Follows the path at this mu and decides whether its end diverges; `None` if cancelled.
    fn examine(&self, mu: Rational, watch: &Watch<'_>) -> Result<Option<Point>, CliError> {
        let steps = LoadSteps::new(mu.clone(), self.steps.amounts.clone());
        let path = LoadingPath::follow(self.contact, &steps, &|_| {
            if watch.is_cancelled() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })?;

        let reached = match &path.end {
            PathEnd::Interrupted => return Ok(None),
            PathEnd::NoContinuation { why, .. } => Reached::NoPath(EarlyEnd {
                place: self.last_place(&path),
                reason: end_text(&path),
                is_certain: why.is_proved(),
            }),
            PathEnd::AllApplied | PathEnd::NoFurtherEvent => {
                let Some(stretch) = path.stretches.last() else {
                    return Ok(None);
                };
                let equilibrium = stretch.last();
                let system = self.state(equilibrium, &mu)?;
                let options = Options::default();
                let (divergence, proof) = divergence_at(&system, &mu, &options, &watch.quiet())?;
                if watch.is_cancelled() {
                    return Ok(None);
                }
                Reached::Equilibrium(Box::new(Examined {
                    equilibrium: equilibrium.clone(),
                    states: certify_states(self.body, &path, stretch, equilibrium),
                    divergence,
                    proof,
                }))
            }
        };

        Ok(Some(Point { mu, reached }))
    }

    /// The body in the contact states of an equilibrium.
    fn state(&self, equilibrium: &Equilibrium, mu: &Rational) -> Result<System, ModelError> {
        let states = equilibrium.contact_states();
        let body = self.body.system();
        body.with_states(states, Some(mu.clone()))
    }

    /// How much of which load is applied at the end of a path.
    fn last_place(&self, path: &LoadingPath) -> String {
        let last = path.stretches.last();
        let Some((stretch, stop)) = last.and_then(|s| Some((s, s.stop.as_ref()?))) else {
            return "at the beginning".into();
        };

        format!("{}, {} of it", self.names[stretch.step], amount(stop))
    }

    /// The analysis of a state at this mu, its contact states held.
    fn frozen(
        &self,
        equilibrium: &Equilibrium,
        mu: &Rational,
        watch: &Watch<'_>,
    ) -> Result<Analysis, CliError> {
        watch.report(&Progress::stage("critical mu of the held contact states"));
        let system = self.state(equilibrium, mu)?;
        let options = Options {
            samples: 0,
            ..Options::default()
        };

        Ok(analyse(None, &system, mu, &options, &watch.quiet())?)
    }
}

impl Point {
    /// Writes the certificate of the contact states as `mu-VALUE.equilibrium.json`, and the proof
    /// about divergence, where there is one, as `mu-VALUE.problem.json` and
    /// `mu-VALUE.certificate.json`.
    /// Files of an earlier run that nothing takes the place of go.
    fn write(&self, folder: &Folder) -> Result<(), CliError> {
        let name = format!("mu-{}", spelt(&self.mu).replace('/', "over"));
        let (states, proof) = match &self.reached {
            Reached::Equilibrium(examined) => {
                (examined.states.as_ref().ok(), examined.proof.as_ref())
            }
            Reached::NoPath(_) => (None, None),
        };

        let equilibrium = format!("{name}.equilibrium.json");
        match states {
            Some(states) => {
                folder.keep(&equilibrium, &states.file()?);
            }
            None => folder.drop_earlier(&equilibrium),
        }
        match proof {
            Some(proof) => write_proof(folder, &name, proof)?,
            None => folder.remove_proof(&name), // no path, or a theorem: nothing slips
        }

        Ok(())
    }

    /// Why this mu is critical, as what follows "at mu = ...".
    fn critical_text(&self) -> String {
        match &self.reached {
            Reached::Equilibrium(_) => {
                "the equilibrium in which the path ends can diverge, proved".into()
            }
            Reached::NoPath(end) => format!(
                "the path ends before ({}): no contact states go on from there, every set was \
                 tried, and what follows is dynamic",
                end.place
            ),
        }
    }

    fn at_mu(&self) -> AtMu {
        match &self.reached {
            Reached::Equilibrium(examined) => AtMu::Equilibrium(examined.divergence.verdict),
            Reached::NoPath(end) => AtMu::NoPath {
                is_certain: end.is_certain,
            },
        }
    }
}

impl OwnCritical {
    /// For people: the bracket first, then the frozen one, then what was examined.
    pub(super) fn text(&self, in_doubles: bool) -> String {
        let mut out = format!("{}\n", self.headline());
        if let Some(frozen) = &self.frozen {
            out += &format!("{}\n", frozen_text(frozen));
        }

        let header = [
            "mu",
            "contact states",
            "of an equilibrium",
            "divergence in them",
            "largest growth rate proved",
        ];
        let mut table = Table::new(&header);
        for point in &self.points {
            table.row(point.cells());
        }

        let rounded = if in_doubles {
            " The path is that of the body condensed in doubles, which differs from the given one \
             by rounding; what is proved is proved of the given body."
        } else {
            ""
        };

        format!(
            "{out}\n{table}\n\
             Examined is the equilibrium at the end of the loads (in the last stretch, where one \
             grows for ever) on the path that is followed at each mu. The path is exact, but has \
             no certificate, and may be one of several. \"Proved\" rests on a certificate or a \
             theorem: that under these loads there is an equilibrium in these contact states, and \
             whether it can diverge. States before the end, and other mu, are not \
             examined.{rounded}\n"
        )
    }

    fn headline(&self) -> String {
        if self.points.is_empty() {
            return "No own critical friction was found: nothing was examined.".into();
        }

        match self.bracket() {
            Bracket::Between(absent, critical) => {
                let [lo, hi] = [spelt(&absent.mu), spelt(&critical.mu)];
                format!(
                    "OWN CRITICAL FRICTION: between {lo} and {hi}, the first change among the mu \
                     examined. At mu = {lo} the equilibrium in which the path of these loads ends \
                     cannot diverge in the form (8), proved; at mu = {hi} {}.{}{}",
                    critical.critical_text(),
                    uncertified_text(&[absent, critical]),
                    self.undecided_text(critical)
                )
            }
            Bracket::AtMost(first) => format!(
                "OWN CRITICAL FRICTION: not above {}: at this mu {}.{}{}",
                spelt(&first.mu),
                first.critical_text(),
                uncertified_text(&[first]),
                self.undecided_text(first)
            ),
            Bracket::Undecided => format!(
                "No own critical friction was found at the {} mu examined; some are undecided.",
                self.points.len()
            ),
            Bracket::None => format!(
                "No own critical friction was found at the {} mu examined: at each of them the \
                 equilibrium in which the path of these loads ends cannot diverge in the form (8), \
                 proved.{}",
                self.points.len(),
                uncertified_text(&self.points.iter().collect::<Vec<_>>())
            ),
        }
    }

    /// The mu before a critical one that are undecided.
    fn undecided_text(&self, critical: &Point) -> String {
        let before = self.points.iter().filter(|point| point.mu < critical.mu);
        let undecided = before.filter(|point| point.at_mu().is_undecided());
        let undecided: Vec<String> = undecided.map(|point| spelt(&point.mu)).collect();
        if undecided.is_empty() {
            return String::new();
        }

        format!(" Undecided below it: {}.", undecided.join(", "))
    }

    /// For programs.
    pub(super) fn json(&self) -> Value {
        let bracket = self.bracket();
        let ends = match bracket {
            Bracket::Between(absent, critical) => {
                json!({ "absent": spelt(&absent.mu), "critical": spelt(&critical.mu) })
            }
            Bracket::AtMost(first) => json!({ "absent": null, "critical": spelt(&first.mu) }),
            Bracket::Undecided | Bracket::None => Value::Null,
        };
        let points: Vec<Value> = self.points.iter().map(Point::json).collect();
        let frozen = self.frozen.as_ref().map(|analysis| {
            let solution = analysis.critical.solution.as_ref();
            json!({
                "states_of": spelt(&analysis.friction),
                "absent_below": analysis.critical.absent_below.as_ref().map(rounded_down),
                "present_at": solution.map(|s| {
                    let (lo, hi) = enclosing_decimals(&s.mu, DIGITS);
                    [lo, hi]
                }),
            })
        });

        json!({
            "found": bracket.word(),
            "bracket": ends,
            "frozen": frozen,
            "points": points,
        })
    }
}

/// That what is said of these points rests on contact states without a certificate, where it does.
fn uncertified_text(points: &[&Point]) -> &'static str {
    let is_uncertified = |point: &&Point| match &point.reached {
        Reached::Equilibrium(examined) => examined.states.is_err(),
        Reached::NoPath(_) => false,
    };

    if points.iter().any(is_uncertified) {
        " What is proved is divergence or its absence in the contact states of the path; that an \
         equilibrium has them is not certified at each of these mu."
    } else {
        ""
    }
}

fn write_proof(folder: &Folder, name: &str, proof: &Proof) -> Result<(), CliError> {
    folder.keep_proof(&Kept {
        name,
        problem: &proof.problem,
        certificate: &proof.certificate.file()?,
    });
    Ok(())
}

/// The frozen critical friction, and why it is another number.
fn frozen_text(frozen: &Analysis) -> String {
    let mu = spelt(&frozen.friction);
    let critical = &frozen.critical;
    let bracket = match (&critical.absent_below, &critical.solution) {
        (None, _) => "at no mu".into(),
        (Some(below), None) => format!("not below {}", rounded_down(below)),
        (Some(below), Some(solution)) => {
            let above = enclosing_decimals(&solution.mu, DIGITS).1;
            format!("between {} and {above}", rounded_down(below))
        }
    };

    format!(
        "FROZEN CRITICAL FRICTION: {bracket}, with the contact states held that these loads lead \
         to at mu = {mu}. That is a statement about these states at every mu; but with another \
         friction the same loads may lead to other states, of which the own one tells."
    )
}

/// Digits of printed values.
const DIGITS: usize = 6;

/// A lower bound in decimals.
fn rounded_down(mu: &Rational) -> String {
    enclosing_decimals(&Interval::point(mu.clone()), DIGITS).0
}

impl Point {
    fn cells(&self) -> Vec<String> {
        let mu = spelt(&self.mu);
        match &self.reached {
            Reached::NoPath(end) => {
                let word = if end.is_certain {
                    "no path"
                } else {
                    "undecided: the path stops"
                };
                vec![
                    mu,
                    "-".into(),
                    "-".into(),
                    format!("{word} ({})", end.place),
                    "-".into(),
                ]
            }
            Reached::Equilibrium(examined) => {
                let divergence = &examined.divergence;
                let verdict = match divergence.verdict {
                    Verdict::Undecided => "undecided".into(),
                    decided => format!("{}, proved", decided.word()),
                };
                let rate = divergence.modes.last();
                let rate = rate.map_or_else(|| "-".into(), |mode| six_digits(mode.growth_rate));
                let states = match &examined.states {
                    Ok(_) => "proved".into(),
                    Err(_) => "not certified".into(),
                };
                vec![mu, examined.equilibrium.picture(), states, verdict, rate]
            }
        }
    }

    fn json(&self) -> Value {
        match &self.reached {
            Reached::NoPath(end) => json!({
                "mu": spelt(&self.mu),
                "no_path": { "at": end.place, "why": end.reason, "all_tried": end.is_certain },
            }),
            Reached::Equilibrium(examined) => {
                let modes = examined.divergence.modes.iter();
                let lambda2 = modes.map(|mode| {
                    let (lo, hi) = enclosing_decimals(&mode.lambda2, 2 * DIGITS);
                    [lo, hi]
                });
                json!({
                    "mu": spelt(&self.mu),
                    "states": states_json(examined.equilibrium.contact_states()),
                    "states_certified": examined.states.is_ok(),
                    "divergence": examined.divergence.verdict.word(),
                    "families": examined.divergence.families,
                    "lambda2": lambda2.collect::<Vec<_>>(),
                })
            }
        }
    }
}

/// A mu as a decimal where it is a short one, else as a fraction.
fn spelt(mu: &Rational) -> String {
    let decimal = nearest_decimal(mu, 15);
    if parse(&decimal).is_ok_and(|value| value == *mu) {
        decimal
    } else {
        mu.to_string()
    }
}

/// The least decimal of fewest decimals between two numbers, the ends included.
fn short_decimal(lo: &Rational, hi: &Rational) -> Rational {
    let ten = Integer::from(10);
    let mut scale = Integer::one();
    loop {
        let scaled = lo * Rational::from_integer(scale.clone());
        let candidate = Rational::new(scaled.ceil().to_integer(), scale.clone());
        if candidate <= *hi {
            return candidate;
        }
        scale *= &ten;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_decimal_between() {
        let shortest = |lo, hi| short_decimal(&lo, &hi);
        assert_eq!(shortest(rational(1, 3), rational(2, 3)), rational(2, 5));
        assert_eq!(shortest(rational(1, 3), rational(4, 3)), rational(1, 1));
        assert_eq!(
            shortest(rational(711, 1000), rational(714, 1000)),
            rational(711, 1000)
        );
        assert_eq!(spelt(&rational(711, 1000)), "0.711");
        assert_eq!(spelt(&rational(1, 3)), "1/3");
    }

    #[test]
    fn a_grid_has_its_ends_and_short_numbers_between() {
        let asked = Asked::of(&["0.1".into(), "1/3".into()], 3, "0.01").unwrap();
        let grid: Vec<String> = asked.grid().iter().map(spelt).collect();
        assert_eq!(grid, ["0.1", "0.16", "0.24", "1/3"]);
    }

    #[test]
    fn ranges_that_make_no_sense_are_refused() {
        for (ends, width) in [
            (vec!["1"], "0.01"),
            (vec!["1", "1"], "0.01"),
            (vec!["0", "1"], "0.01"),
            (vec!["1", "2", "3"], "0.01"),
            (vec!["1", "2"], "1e-12"),
            (vec!["1", "2"], "0"),
        ] {
            let ends: Vec<String> = ends.into_iter().map(String::from).collect();
            assert!(Asked::of(&ends, 10, width).is_err(), "{ends:?} {width}");
        }
    }
}
