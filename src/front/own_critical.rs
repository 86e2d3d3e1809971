//! The own critical friction of a body under loads.
//!
//! The critical friction of a state is *frozen*: the contact states of one equilibrium are held,
//! and mu varies. But at another mu the same loads may lead to other equilibria. Here, for each mu
//! of a grid, the loading path is followed at this mu, and the equilibria on it are asked whether
//! they can diverge in the form (8): one inside each stretch, up to the first that can, and the one
//! in which the path ends. Between neighbours with different answers more mu are examined until
//! they are as near as asked for.
//!
//! The *critical friction found* is the first change among the mu examined from proved absence at
//! all these places to proved divergence at one, or to a path that ends although every set
//! of contact states was tried. The path is the one that `mceip_path` follows, exact but without a
//! certificate; that it is the only one is not claimed, and between two mu nothing is.
//!
//! Whether a state diverges is decided by [`divergence_at`]: by a certificate that the checker has
//! accepted, or by the theorem for states in which nothing slips.

use super::error::Error;
use super::loads::{LoadPath, Loads, ProvedStates, certify_states};
use super::run::{Watched, unless_cancelled, watched_question};
use crate::say::{self, number_text};
use mceip_check::certificate::Certificate;
use mceip_engine::analysis::{
    Analysis, AnalysisError, AnalysisOptions, Divergence, Mode, Proof, Verdict, analyse,
    divergence_at,
};
use mceip_engine::run::{Progress, Watch};
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::{ContactState, LoadedBody, ModelError, System};
use mceip_path::{Equilibrium, LoadSteps, LoadingPath, LoadingPathEnd, Stretch};
use num_traits::{One, Signed};
use serde_json::Value;

/// The mu at which the own critical friction is looked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrictionGrid {
    least: Rational,
    greatest: Rational,
    /// Number of equal parts between them.
    parts: usize,
    /// How near two neighbours with different answers have to be, relative to the greater one.
    width: Rational,
}

/// A grid that makes no sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("own critical friction, {what}: expected {expected}, got {got}")]
pub struct FrictionGridError {
    /// "range", "grid" or "width".
    pub what: &'static str,
    /// What was expected.
    pub expected: &'static str,
    /// What was found.
    pub got: String,
}

/// More parts than any picture has use for.
const MOST_PARTS: usize = 10_000;

/// One over the least width: nearer neighbours are hardly told apart in print.
const MOST_WIDTHS: i64 = 1_000_000_000;

impl FrictionGrid {
    /// The range [least, greatest] in ten parts; neighbours with different answers are brought to
    /// within one per cent.
    ///
    /// # Errors
    /// [`FrictionGridError`] unless 0 < least < greatest.
    pub fn new(least: Rational, greatest: Rational) -> Result<FrictionGrid, FrictionGridError> {
        if !(least.is_positive() && least < greatest) {
            return Err(FrictionGridError {
                what: "range",
                expected: "0 < MIN < MAX",
                got: format!("{least}, {greatest}"),
            });
        }

        Ok(FrictionGrid {
            least,
            greatest,
            parts: 10,
            width: rational(1, 100),
        })
    }

    /// In this many parts.
    ///
    /// # Errors
    /// [`FrictionGridError`] unless there are 1 to 10,000.
    pub fn with_parts(self, parts: usize) -> Result<FrictionGrid, FrictionGridError> {
        if !(1..=MOST_PARTS).contains(&parts) {
            return Err(FrictionGridError {
                what: "grid",
                expected: "1 to 10000",
                got: parts.to_string(),
            });
        }

        Ok(FrictionGrid { parts, ..self })
    }

    /// Neighbours with different answers are brought as near as this, relative to the greater one.
    ///
    /// # Errors
    /// [`FrictionGridError`] below 1e-9.
    pub fn with_width(self, width: Rational) -> Result<FrictionGrid, FrictionGridError> {
        if width < rational(1, MOST_WIDTHS) {
            return Err(FrictionGridError {
                what: "width",
                expected: "at least 1/10^9",
                got: width.to_string(),
            });
        }

        Ok(FrictionGrid { width, ..self })
    }

    /// The ends, and short decimals near the equal parts between them.
    fn values(&self) -> Vec<Rational> {
        let part = (&self.greatest - &self.least) / whole(self.parts as i64);
        let mut values = vec![self.least.clone()];
        for k in 1..self.parts {
            let near = &self.least + &part * whole(k as i64);
            values.push(short_decimal(&near, &(&part / whole(4))));
        }

        values.push(self.greatest.clone());
        values
    }

    /// Two neighbours with different answers that are further apart than asked for.
    fn first_wide_change(&self, points: &[FrictionPoint]) -> Option<usize> {
        (1..points.len()).map(|k| k - 1).find(|&k| {
            let [lo, hi] = [&points[k], &points[k + 1]];
            let distance = hi.friction() - lo.friction();
            lo.answer() != hi.answer() && distance > &self.width * hi.friction()
        })
    }
}

/// Of the decimals with fewest decimals that are not further away than this the nearest.
fn short_decimal(near: &Rational, distance: &Rational) -> Rational {
    let ten = Integer::from(10);
    let mut scale = Integer::one();
    loop {
        let scaled = near * Rational::from_integer(scale.clone());
        let candidate = Rational::new(scaled.round().to_integer(), scale.clone());
        if (&candidate - near).abs() <= *distance {
            return candidate;
        }
        scale *= &ten;
    }
}

/// The answers at all mu that were examined, and the frozen critical friction beside them.
#[derive(Debug, Clone)]
pub struct OwnCritical {
    loads: Loads,
    is_in_doubles: bool,
    is_end_alone: bool,
    path_friction: Rational,
    /// What the loads lead to at each mu, ascending.
    pub points: Vec<FrictionPoint>,
    /// The analysis of one state, held: of that in which divergence is found at the critical mu; of
    /// that at the last mu without divergence, where the path ends at the critical one; and where
    /// no mu is critical, of the state with the smallest critical friction of those that decide.
    pub frozen: Option<Analysis>,
}

/// What the loads lead to at a mu.
#[derive(Debug, Clone)]
pub struct FrictionPoint {
    /// The path at this mu.
    pub path: LoadingPath,
    /// The equilibria on it that were asked whether they can diverge, each set of contact states
    /// once, up to the first that can.
    pub examined: Vec<ExaminedEquilibrium>,
    /// Are the contact states of that which decides proved? `None` where there is none.
    pub states: Option<ProvedStates>,
}

/// What is known of an equilibrium on a path.
#[derive(Debug, Clone)]
pub struct ExaminedEquilibrium {
    /// Where it is.
    pub place: PathPlace,
    /// The equilibrium.
    pub equilibrium: Equilibrium,
    /// Can it diverge in the form (8)? An error for contact states that are refused.
    pub divergence: Result<Divergence, AnalysisError>,
}

impl ExaminedEquilibrium {
    /// Whether it diverges; undecided where its states are refused.
    pub fn verdict(&self) -> Verdict {
        let divergence = self.divergence.as_ref();
        divergence.map_or(Verdict::Undecided, |divergence| divergence.verdict)
    }

    /// Every motion that is proved to grow, by ascending lambda^2.
    pub fn modes(&self) -> &[Mode] {
        let divergence = self.divergence.as_ref();
        divergence.map_or(&[], |divergence| &divergence.modes)
    }
}

/// A place on a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathPlace {
    /// Inside a stretch, from 0.
    Inside(usize),
    /// Where the loads are applied; of a load without end inside the last stretch.
    End,
}

impl PathPlace {
    /// The stretch.
    pub fn stretch(self, path: &LoadingPath) -> &Stretch {
        match self {
            PathPlace::Inside(stretch) => &path.stretches[stretch],
            PathPlace::End => &path.stretches[path.stretches.len() - 1],
        }
    }

    fn equilibrium(self, path: &LoadingPath) -> &Equilibrium {
        let stretch = self.stretch(path);
        match self {
            PathPlace::Inside(_) => &stretch.inside,
            PathPlace::End => stretch.last(),
        }
    }

    /// The places that are asked about, in order: one inside each stretch, unless the end is asked
    /// alone, and the end, which a path that ends before the loads are applied has not.
    ///
    /// Stretches in which nothing slips are among them: that they do not diverge rests on a
    /// definite K_ff, (P1), which is looked at when they are asked.
    fn all(path: &LoadingPath, is_end_alone: bool) -> Vec<PathPlace> {
        let stretches = 0..path.stretches.len();
        let mut places: Vec<PathPlace> = if is_end_alone {
            Vec::new()
        } else {
            stretches.map(PathPlace::Inside).collect()
        };

        let last = path.stretches.last();
        if let Some(last) = last.filter(|_| path.is_whole()) {
            let is_inside_the_same = last.equilibrium_states() == last.last().contact_states();
            if is_inside_the_same {
                places.pop_if(|place| *place == PathPlace::Inside(path.stretches.len() - 1));
            }
            places.push(PathPlace::End);
        }

        places
    }
}

/// What is found at a mu, as far as neighbours are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrictionAnswer {
    /// An equilibrium on the path can diverge, none can, or that is not known.
    Equilibrium(Verdict),
    /// The path ends before the loads are applied, and no equilibrium on it is known to diverge.
    NoPath {
        /// Was every set of contact states tried?
        is_certain: bool,
    },
}

impl FrictionAnswer {
    /// No divergence, proved.
    const ABSENT: FrictionAnswer = FrictionAnswer::Equilibrium(Verdict::Absent);

    /// Divergence, proved, or a path that ends, every set of contact states tried.
    pub fn is_critical(self) -> bool {
        let no_path = FrictionAnswer::NoPath { is_certain: true };
        self == no_path || self == FrictionAnswer::Equilibrium(Verdict::Present)
    }

    /// Neither critical nor proved not to be.
    pub fn is_undecided(self) -> bool {
        self != Self::ABSENT && !self.is_critical()
    }
}

impl FrictionPoint {
    /// The mu.
    pub fn friction(&self) -> &Rational {
        &self.path.steps.friction
    }

    /// The equilibrium that decides: the first that can diverge, with which the search along the
    /// path ends; else the first that is undecided; else the last on the path.
    pub fn deciding(&self) -> Option<&ExaminedEquilibrium> {
        self.examined.get(deciding(&self.examined)?)
    }

    /// Is it one that diverges?
    pub fn deciding_diverges(&self) -> bool {
        let deciding = self.deciding();
        deciding.is_some_and(|e| e.verdict() == Verdict::Present)
    }

    /// What is found at it.
    pub fn answer(&self) -> FrictionAnswer {
        if self.deciding_diverges() {
            return FrictionAnswer::Equilibrium(Verdict::Present);
        }

        match &self.path.end {
            LoadingPathEnd::NoContinuation { why, .. } => FrictionAnswer::NoPath {
                is_certain: why.is_proved(),
            },
            _ => FrictionAnswer::Equilibrium(self.worst()),
        }
    }

    /// Undecided if one of the equilibria is.
    fn worst(&self) -> Verdict {
        let mut verdicts = self.examined.iter().map(ExaminedEquilibrium::verdict);
        let is_proved = !self.examined.is_empty() && verdicts.all(|v| v == Verdict::Absent);
        if is_proved {
            Verdict::Absent
        } else {
            Verdict::Undecided
        }
    }
}

/// What the answers say of the critical friction.
#[derive(Debug, Clone, Copy)]
pub enum Bracket<'a> {
    /// The first mu that is proved to be critical, and before it the last one that is proved not to
    /// be: what lies between them is undecided.
    Between(&'a FrictionPoint, &'a FrictionPoint),
    /// The first mu that is critical; none before it is proved not to be.
    AtMost(&'a FrictionPoint),
    /// No mu examined is known to be critical, and an answer is missing.
    Undecided,
    /// No mu examined is critical.
    None,
}

impl OwnCritical {
    /// What the answers say of the critical friction.
    pub fn bracket(&self) -> Bracket<'_> {
        let is_critical = |point: &FrictionPoint| point.answer().is_critical();
        let Some(critical) = self.points.iter().position(is_critical) else {
            let mut answers = self.points.iter().map(FrictionPoint::answer);
            return if answers.any(FrictionAnswer::is_undecided) {
                Bracket::Undecided
            } else {
                Bracket::None
            };
        };

        let mut below = self.points[..critical].iter().rev();
        let absent = below.find(|point| point.answer() == FrictionAnswer::ABSENT);
        match absent {
            Some(absent) => Bracket::Between(absent, &self.points[critical]),
            None => Bracket::AtMost(&self.points[critical]),
        }
    }

    /// The points whose deciding states are analysed with their contact states held, each set of
    /// states once: that of the bracket, or where there is none all of them.
    fn to_be_held(&self) -> Vec<&FrictionPoint> {
        match self.bracket() {
            Bracket::Between(_, critical) | Bracket::AtMost(critical)
                if critical.deciding_diverges() =>
            {
                vec![critical]
            }
            Bracket::Between(absent, _) => vec![absent],
            Bracket::AtMost(_) => Vec::new(),
            Bracket::Undecided | Bracket::None => self.with_different_states(),
        }
    }

    /// The points with a deciding equilibrium, one for each set of contact states: that of the
    /// largest mu.
    fn with_different_states(&self) -> Vec<&FrictionPoint> {
        let mut seen: Vec<&[ContactState]> = Vec::new();
        let mut points = Vec::new();
        for point in self.points.iter().rev() {
            let is_shown = matches!(point.answer(), FrictionAnswer::Equilibrium(_));
            let Some(examined) = point.deciding().filter(|_| is_shown) else {
                continue;
            };
            let states = examined.equilibrium.contact_states();
            if !seen.contains(&states) {
                seen.push(states);
                points.push(point);
            }
        }

        points
    }

    /// Is nothing found because an answer is missing?
    pub fn is_undecided(&self) -> bool {
        matches!(self.bracket(), Bracket::Undecided)
    }

    /// The body and its loads.
    pub fn loads(&self) -> &Loads {
        &self.loads
    }

    /// The friction of the path from which the question was asked.
    pub fn path_friction(&self) -> &Rational {
        &self.path_friction
    }

    /// Was the body condensed in doubles?
    pub fn is_in_doubles(&self) -> bool {
        self.is_in_doubles
    }

    /// Was the equilibrium in which the path ends asked alone?
    pub fn is_end_alone(&self) -> bool {
        self.is_end_alone
    }

    /// In words, with a table: what `mceip path --own-critical` prints first.
    pub fn text(&self) -> String {
        say::own_critical::text_of(self)
    }

    /// For programs: `own_critical` of `mceip path --json`.
    pub fn to_json(&self) -> Value {
        say::own_critical::json_of(self)
    }
}

/// Without a mass there is no divergence in time to ask for.
pub(crate) fn require_mass(body: &LoadedBody) -> Result<(), Error> {
    match body.system().mass() {
        Some(_) => Ok(()),
        None => Err(AnalysisError::NoMass.into()),
    }
}

/// The certificate about divergence that an earlier run has made at a mu and a place.
type Earlier<'a> = dyn Fn(&Rational, PathPlace) -> Option<Certificate> + 'a;

/// Hears the certificate about divergence at a mu and a place; `None` where a theorem answers, or
/// nothing does.
type OnDivergence<'a> = dyn Fn(&Rational, PathPlace, Option<&Proof>) + 'a;

/// A search for the own critical friction; see [`LoadPath::own_critical`].
pub struct FindOwnCritical<'a> {
    load_path: &'a LoadPath,
    grid: FrictionGrid,
    is_end_alone: bool,
    earlier: Box<Earlier<'a>>,
    on_proof: Box<OnDivergence<'a>>,
    on_point: Box<dyn Fn(&FrictionPoint) + 'a>,
    watched: Watched<'a>,
}

impl LoadPath {
    /// From which friction on does the path of these loads meet an equilibrium that can diverge in
    /// the form (8)?
    ///
    /// ```
    /// use mceip::{Bracket, FrictionGrid, Loads};
    /// let loads = Loads::read("spec/examples/own-critical.json")?;
    /// let path = loads.path().run()?.expect("nobody has cancelled it");
    /// let grid = FrictionGrid::new("1.1".parse()?, "1.2".parse()?)?;
    /// let own = path.own_critical(grid).run()?;
    /// assert!(matches!(own.bracket(), Bracket::Between(..)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn own_critical(&self, grid: FrictionGrid) -> FindOwnCritical<'_> {
        FindOwnCritical {
            load_path: self,
            grid,
            is_end_alone: false,
            earlier: Box::new(|_, _| None),
            on_proof: Box::new(|_, _, _| {}),
            on_point: Box::new(|_| {}),
            watched: Watched::default(),
        }
    }
}

watched_question!(FindOwnCritical, "what was examined is kept");

impl<'a> FindOwnCritical<'a> {
    /// Asks the equilibrium in which the path ends alone, for large bodies: what the path meets
    /// before is not examined.
    pub fn end_alone(mut self, is_end_alone: bool) -> Self {
        self.is_end_alone = is_end_alone;
        self
    }

    /// Gives the certificate about divergence that an earlier run has made at a mu and a place: if
    /// it is one of the problem met there, only what it leaves open is searched.
    pub fn resume(
        mut self,
        earlier: impl Fn(&Rational, PathPlace) -> Option<Certificate> + 'a,
    ) -> Self {
        self.earlier = Box::new(earlier);
        self
    }

    /// Hears each certificate about divergence as soon as it is accepted: no list holds them, for
    /// those of a large body fill the memory.
    pub fn on_proof(mut self, hear: impl Fn(&Rational, PathPlace, Option<&Proof>) + 'a) -> Self {
        self.on_proof = Box::new(hear);
        self
    }

    /// Hears what is found at each mu, as soon as it is found.
    pub fn on_point(mut self, hear: impl Fn(&FrictionPoint) + 'a) -> Self {
        self.on_point = Box::new(hear);
        self
    }

    /// Examines the grid, then mu between; what is examined when the work is cancelled stays.
    ///
    /// # Errors
    /// [`Error::Analyze`] for a body without mass, [`Error::Path`], [`Error::Model`].
    pub fn run(self) -> Result<OwnCritical, Error> {
        require_mass(self.load_path.loads().body())?;
        let watch = self.watched.watch();
        let mut points: Vec<FrictionPoint> = Vec::new();
        for mu in self.grid.values() {
            match self.examine(mu, points.len(), &watch)? {
                Some(point) => points.push(point),
                None => break,
            }
        }

        while let Some(k) = self.grid.first_wide_change(&points) {
            let [lo, hi] = [points[k].friction(), points[k + 1].friction()];
            let middle = (lo + hi) / whole(2);
            let mu = short_decimal(&middle, &((hi - lo) / whole(4)));
            match self.examine(mu, points.len(), &watch)? {
                Some(point) => points.insert(k + 1, point),
                None => break,
            }
        }

        let mut own = OwnCritical {
            loads: self.load_path.loads().clone(),
            is_in_doubles: self.load_path.is_in_doubles(),
            is_end_alone: self.is_end_alone,
            path_friction: self.load_path.as_path().steps.friction.clone(),
            points,
            frozen: None,
        };
        own.frozen = self.smallest_frozen(&own, &watch)?;

        Ok(own)
    }

    fn body(&self) -> &System {
        self.load_path.loads().body().system()
    }

    /// Follows the path at this mu and decides whether an equilibrium on it diverges; `None` if
    /// cancelled.
    fn examine(
        &self,
        mu: Rational,
        count: usize,
        watch: &Watch<'_>,
    ) -> Result<Option<FrictionPoint>, Error> {
        let stage = format!("path at mu = {}", number_text(&mu));
        let say = |stage: &str| {
            let mut progress = Progress::stage(stage);
            progress.done = count as u64;
            watch.report(&progress);
        };
        say(&stage);

        let amounts = self.load_path.as_path().steps.amounts.clone();
        let steps = LoadSteps::new(mu.clone(), amounts);
        let contact = self.load_path.contact();
        let path = LoadingPath::follow(contact, &steps, &|_| unless_cancelled(watch))?;
        if path.end == LoadingPathEnd::Interrupted {
            return Ok(None);
        }

        let mut examined: Vec<ExaminedEquilibrium> = Vec::new();
        let mut proofs: Vec<Option<Proof>> = Vec::new();
        for place in PathPlace::all(&path, self.is_end_alone) {
            let equilibrium = place.equilibrium(&path);
            let states = equilibrium.contact_states();
            let mut same = examined.iter();
            let same = same.position(|e| e.equilibrium.contact_states() == states);
            let (divergence, proof) = match same {
                Some(_) if place != PathPlace::End => continue,
                Some(same) => (examined[same].divergence.clone(), proofs[same].clone()),
                None => {
                    say(&format!("{stage}, divergence {}", place_word(place)));
                    self.divergence(equilibrium, &mu, place, watch)
                }
            };
            if watch.is_cancelled() {
                return Ok(None);
            }

            (self.on_proof)(&mu, place, proof.as_ref());
            proofs.push(proof);
            examined.push(ExaminedEquilibrium {
                place,
                equilibrium: equilibrium.clone(),
                divergence,
            });
            let last = examined.last();
            if last.is_some_and(|last| last.verdict() == Verdict::Present) {
                break;
            }
        }

        let body = self.load_path.loads().body();
        let states = deciding(&examined).map(|decides| {
            let ExaminedEquilibrium {
                place, equilibrium, ..
            } = &examined[decides];
            certify_states(body, &path, place.stretch(&path), equilibrium)
        });
        let point = FrictionPoint {
            path,
            examined,
            states,
        };
        (self.on_point)(&point);
        Ok(Some(point))
    }

    /// Can the body diverge in the contact states of an equilibrium? With the certificate. States
    /// that are refused take no others along.
    fn divergence(
        &self,
        equilibrium: &Equilibrium,
        mu: &Rational,
        place: PathPlace,
        watch: &Watch<'_>,
    ) -> (Result<Divergence, AnalysisError>, Option<Proof>) {
        let options = AnalysisOptions::default();
        let earlier = (self.earlier)(mu, place);
        let system = self.state(equilibrium, mu).map_err(AnalysisError::from);
        let decided = system.and_then(|system| {
            divergence_at(&system, mu, earlier.as_ref(), &options, &watch.quiet())
        });
        match decided {
            Ok((divergence, proof)) => (Ok(divergence), proof),
            Err(why) => (Err(why), None),
        }
    }

    /// The body in the contact states of an equilibrium.
    fn state(&self, equilibrium: &Equilibrium, mu: &Rational) -> Result<System, ModelError> {
        let states = equilibrium.contact_states();
        self.body().with_states(states, Some(mu.clone()))
    }

    /// Of the states to be held, the analysis of that with the smallest critical friction; `None`
    /// without such states, and where the work is cancelled before all are compared.
    fn smallest_frozen(
        &self,
        own: &OwnCritical,
        watch: &Watch<'_>,
    ) -> Result<Option<Analysis>, Error> {
        let mut smallest: Option<Analysis> = None;
        for point in own.to_be_held() {
            let Some(examined) = point.deciding().filter(|e| e.divergence.is_ok()) else {
                continue;
            };
            if watch.is_cancelled() {
                return Ok(None);
            }

            let frozen = self.frozen(&examined.equilibrium, point.friction(), watch)?;
            if smallest.as_ref().is_none_or(|s| is_below(&frozen, s)) {
                smallest = Some(frozen);
            }
        }

        Ok(smallest)
    }

    /// The analysis of a state at this mu, its contact states held.
    fn frozen(
        &self,
        equilibrium: &Equilibrium,
        mu: &Rational,
        watch: &Watch<'_>,
    ) -> Result<Analysis, Error> {
        watch.report(&Progress::stage("critical mu of the held contact states"));
        let system = self.state(equilibrium, mu)?;
        let options = AnalysisOptions {
            samples: 0,
            ..AnalysisOptions::default()
        };

        Ok(analyse(&system, mu, &options, &watch.quiet())?)
    }
}

/// Is the critical friction of one state below that of another? By the mu below which divergence is
/// proved absent; a state without any is below none.
fn is_below(one: &Analysis, other: &Analysis) -> bool {
    match (&one.critical.absent_below, &other.critical.absent_below) {
        (Some(one), Some(other)) => one < other,
        (one, other) => one.is_some() && other.is_none(),
    }
}

/// Which of the equilibria decides; see [`FrictionPoint::deciding`].
fn deciding(examined: &[ExaminedEquilibrium]) -> Option<usize> {
    let first = |verdict| {
        let mut verdicts = examined.iter().map(ExaminedEquilibrium::verdict);
        verdicts.position(|found| found == verdict)
    };
    let last = examined.len().checked_sub(1);
    first(Verdict::Present)
        .or(first(Verdict::Undecided))
        .or(last)
}

fn place_word(place: PathPlace) -> String {
    match place {
        PathPlace::Inside(stretch) => format!("in stretch {stretch}"),
        PathPlace::End => "at its end".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_decimal_near() {
        let shortest = |near, distance| short_decimal(&near, &distance);
        assert_eq!(shortest(rational(3, 2), rational(1, 4)), rational(3, 2));
        assert_eq!(shortest(rational(3, 2), rational(1, 2)), whole(2));
        assert_eq!(shortest(rational(1, 3), rational(1, 10)), rational(3, 10));
        assert_eq!(
            shortest(rational(7125, 10_000), rational(1, 1000)),
            rational(713, 1000)
        );
    }

    #[test]
    fn a_grid_has_its_ends_and_short_numbers_between() {
        let grid = FrictionGrid::new(rational(1, 10), rational(1, 3)).unwrap();
        let grid = grid.with_parts(3).unwrap();
        let values: Vec<String> = grid.values().iter().map(number_text).collect();
        assert_eq!(values, ["0.1", "0.18", "0.26", "1/3"]);
    }

    #[test]
    fn grids_that_make_no_sense_are_refused() {
        for (least, greatest) in [(1, 1), (2, 1), (0, 1), (-1, 1)] {
            assert!(FrictionGrid::new(whole(least), whole(greatest)).is_err());
        }

        let grid = FrictionGrid::new(whole(1), whole(2)).unwrap();
        assert!(grid.clone().with_parts(0).is_err());
        assert!(grid.clone().with_parts(MOST_PARTS + 1).is_err());
        assert!(grid.clone().with_width(whole(0)).is_err());
        assert!(grid.with_width(rational(1, MOST_WIDTHS + 1)).is_err());
    }
}
