//! A body under loads, and the contact states that the loads lead to.

use super::complete::SolutionSet;
use super::error::Error;
use super::problem::Problem;
use super::run::{Watched, unless_cancelled, watched_question};
use crate::say;
use mceip_check::Proved;
use mceip_check::certificate::{EquilibriumCertificate, SlipSign, StatedEquilibrium, StatedState};
use mceip_engine::equilibrium::{StatesNotCertified, certify_equilibrium};
use mceip_engine::run::{Cancel, Progress};
use mceip_exact::{Rational, from_f64, to_f64};
use mceip_model::file::{LoadsFile, Number, folder_of, read_loads, read_text, write_loads};
use mceip_model::{ContactState, Coordinates, LoadedBody, Particle, Unknown, Window};
use mceip_path::{Contact, Equilibrium, LoadSteps, LoadingPath, RateSolutions, Stretch};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// A body that may touch an obstacle, and the loads that are applied to it one after the other
/// (`mceip-loads/1`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loads(Arc<LoadsFile>);

impl Loads {
    /// Reads a file of a body under loads.
    ///
    /// # Errors
    /// [`Error::Model`] with the place in the file, what was expected and what was found.
    pub fn read(path: impl AsRef<Path>) -> Result<Loads, Error> {
        let path = path.as_ref();
        let text = read_text("the loads", path)?;
        Loads::from_text(&text, folder_of(path))
    }

    /// A body under loads from the text of a file. Matrix Market files that it names are looked for
    /// in the working directory.
    ///
    /// # Errors
    /// As [`Loads::read`].
    pub fn from_json(text: &str) -> Result<Loads, Error> {
        Loads::from_text(text, Path::new("."))
    }

    fn from_text(text: &str, folder: &Path) -> Result<Loads, Error> {
        Ok(Loads::from(read_loads(text, folder)?))
    }

    /// The text of a file of it, `mceip-loads/1`: the body without its held degrees of freedom,
    /// what they exert written as forces.
    pub fn to_json(&self) -> String {
        write_loads(&self.0)
    }

    /// The file.
    pub fn as_file(&self) -> &LoadsFile {
        &self.0
    }

    /// The body, its held degrees of freedom eliminated.
    pub fn body(&self) -> &LoadedBody {
        &self.0.body
    }

    /// What may touch the obstacle, all stuck.
    pub fn candidates(&self) -> &[Particle] {
        self.body().system().particles()
    }

    /// Names of the steps.
    pub fn step_names(&self) -> Vec<&str> {
        let steps = self.body().steps().iter();
        steps.map(|step| step.name.as_str()).collect()
    }

    /// The quasi-static path, event by event.
    ///
    /// ```
    /// use mceip::Loads;
    /// let loads = Loads::read("spec/examples/loads.json")?;
    /// let path = loads.path().run()?.expect("nobody has cancelled it");
    /// let last = path.as_path().stretches.len() - 1;
    /// assert!(path.certify(last).is_ok());
    /// assert!(path.problem(last)?.complete().run()?.is_complete());
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn path(&self) -> FollowPath<'_> {
        FollowPath {
            loads: self.clone(),
            friction: None,
            is_in_doubles: false,
            taken: BTreeMap::new(),
            watched: Watched::default(),
        }
    }
}

impl From<LoadsFile> for Loads {
    fn from(file: LoadsFile) -> Loads {
        Loads(Arc::new(file))
    }
}

/// The path of a body under loads, to be followed.
pub struct FollowPath<'a> {
    loads: Loads,
    friction: Option<Rational>,
    is_in_doubles: bool,
    taken: BTreeMap<usize, usize>,
    watched: Watched<'a>,
}

watched_question!(FollowPath, "the stretches that were followed are kept");

impl<'a> FollowPath<'a> {
    /// The friction coefficient; that of the file if not said.
    pub fn friction(mut self, friction: Rational) -> Self {
        self.friction = Some(friction);
        self
    }

    /// Condenses in doubles instead of exactly: fast for large bodies. The path is then, exactly,
    /// that of a body which differs from the given one by rounding.
    pub fn in_doubles(mut self, is_in_doubles: bool) -> Self {
        self.is_in_doubles = is_in_doubles;
        self
    }

    /// At the beginning of a stretch takes this one of [`LoadPath::continuations`] (both from 0),
    /// instead of the first that is met.
    pub fn take(mut self, stretch: usize, continuation: usize) -> Self {
        self.taken.insert(stretch, continuation);
        self
    }

    /// Follows the path; `None` if it was cancelled before the path begins.
    ///
    /// # Errors
    /// [`Error::NoFriction`], [`Error::Path`]. A path that cannot go on is no error: its end says
    /// why.
    pub fn run(self) -> Result<Option<LoadPath>, Error> {
        let body = self.loads.body();
        let friction = self.friction.as_ref().or(body.system().friction());
        let friction = friction.ok_or(Error::NoFriction)?.clone();

        let watch = self.watched.watch();
        let condense = if self.is_in_doubles {
            watch.report(&Progress::stage(
                "condensing in doubles to the contact candidates",
            ));
            Contact::condense_in_doubles
        } else {
            watch.report(&Progress::stage(
                "condensing exactly to the contact candidates",
            ));
            Contact::condense
        };
        let condensing = self.loads.clone();
        let condensed = left_behind_if(&|| watch.is_cancelled(), move || {
            let body = condensing.body();
            condense(body.system(), body.gaps(), body.loads())
        });
        let Some(contact) = condensed.transpose()? else {
            return Ok(None);
        };

        let mut steps = LoadSteps::new(friction, amounts(body));
        steps.taken = self.taken;
        let names = self.loads.step_names();
        let path = LoadingPath::follow(&contact, &steps, &|at| {
            let amount = to_f64(at.amount);
            let step = names[at.step];
            let stage = format!("stretch {}: {step}, {amount:.4} of it", at.stretch);
            watch.report(&Progress::stage(&stage));
            unless_cancelled(&watch)
        })?;

        let mut pencils = contact.pencils();
        let mut continuations = Vec::with_capacity(path.stretches.len());
        for stretch in 0..path.stretches.len() {
            let stage = format!("stretch {stretch}: whether the path is the only one");
            watch.report(&Progress::stage(&stage));
            continuations.push(if watch.is_cancelled() {
                RateSolutions::NotExamined
            } else {
                path.rate_solutions(&mut pencils, stretch)?
            });
        }

        Ok(Some(LoadPath {
            loads: self.loads.clone(),
            is_in_doubles: self.is_in_doubles,
            held_by_rounding: contact.held_by_rounding(&path),
            contact,
            path,
            continuations,
        }))
    }
}

/// How much of each load is applied: all, of an endless one as much as changes something.
fn amounts(body: &LoadedBody) -> Vec<Option<Rational>> {
    let one = Rational::from_integer(1.into());
    let steps = body.steps().iter();
    steps
        .map(|step| (!step.is_endless).then(|| one.clone()))
        .collect()
}

/// Work in a thread of its own: it cannot be broken off, but it can be left behind. `None` if it
/// was.
pub(crate) fn left_behind_if<T: Send + 'static>(
    is_cancelled: &dyn Fn() -> bool,
    work: impl FnOnce() -> T + Send + 'static,
) -> Option<T> {
    let worker = std::thread::spawn(work);
    while !worker.is_finished() {
        if is_cancelled() {
            return None;
        }
        std::thread::sleep(Duration::from_millis(2));
    }

    match worker.join() {
        Ok(done) => Some(done),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// A path that was followed, and its body condensed to the contact candidates.
#[derive(Debug, Clone)]
pub struct LoadPath {
    loads: Loads,
    is_in_doubles: bool,
    contact: Contact,
    path: LoadingPath,
    continuations: Vec<RateSolutions>,
    held_by_rounding: Vec<usize>,
}

impl LoadPath {
    /// The path: its stretches, and why it ends.
    pub fn as_path(&self) -> &LoadingPath {
        &self.path
    }

    /// The body condensed to its candidates.
    pub fn contact(&self) -> &Contact {
        &self.contact
    }

    /// Was the body condensed in doubles? Then the path is that of a body which differs from the
    /// given one by rounding.
    pub fn is_in_doubles(&self) -> bool {
        self.is_in_doubles
    }

    /// The body and its loads.
    pub fn loads(&self) -> &Loads {
        &self.loads
    }

    /// The problem in the contact states inside a stretch (from 0), at the friction of the path:
    /// MCEIP-lambda2, of a body without mass MCEIP-mu.
    ///
    /// # Errors
    /// [`Error::Model`] where nothing slips.
    ///
    /// # Panics
    /// For a stretch that there is not.
    pub fn problem(&self, stretch: usize) -> Result<Problem, Error> {
        let body = self.loads.body();
        let unknown = match body.system().mass() {
            Some(_) => Unknown::Lambda2,
            None => Unknown::Mu,
        };
        Ok(self.problem_in(stretch, unknown)?.into())
    }

    /// The problem in the contact states inside a stretch; names, coordinates and warnings are
    /// those of the file.
    pub(crate) fn problem_in(
        &self,
        stretch: usize,
        unknown: Unknown,
    ) -> Result<mceip_model::Problem, mceip_model::ModelError> {
        let file = self.loads.as_file();
        let at = &self.path.stretches[stretch];
        let friction = &self.path.steps.friction;
        let mut problem = file
            .body
            .problem(at.equilibrium_states(), friction, unknown)?;

        let name = file.name.as_deref().unwrap_or("loading path");
        let step = &file.body.steps()[at.step].name;
        problem.name = Some(format!("{name}, stretch {stretch} ({step})"));
        problem.coordinates = file.coordinates.as_ref().map(Coordinates::without_loads);
        problem.warnings.clone_from(&file.warnings);
        Ok(problem)
    }

    /// How the path can go on at the beginning of each stretch: in one way whatever load grows, or
    /// in these ways under the load that grows.
    pub fn continuations(&self) -> &[RateSolutions] {
        &self.continuations
    }

    /// Certifies that the body has an equilibrium in the contact states inside a stretch (from 0):
    /// that of one amount of the load, in the middle half of the stretch.
    ///
    /// # Errors
    /// [`StatesNotCertified`]: why no certificate was accepted.
    ///
    /// # Panics
    /// For a stretch that there is not.
    pub fn certify(&self, stretch: usize) -> ProvedStates {
        let stretch = &self.path.stretches[stretch];
        certify_states(self.loads.body(), &self.path, stretch, &stretch.inside)
    }

    /// Certifies that in the contact states inside a stretch (from 0) the rates are the only ones,
    /// whatever load grows: that T(mu) is positive definite at the friction of the path. `None`
    /// where nothing slips, a candidate is without reaction, T(mu) is not positive definite, the
    /// search does not close the window by one such leaf, or it is cancelled.
    ///
    /// # Errors
    /// [`Error::Complete`], [`Error::Path`].
    ///
    /// # Panics
    /// For a stretch that there is not.
    pub fn certify_unique(
        &self,
        stretch: usize,
        cancel: &Cancel,
    ) -> Result<Option<SolutionSet>, Error> {
        let states = self.path.stretches[stretch].equilibrium_states();
        let slips = |state: &ContactState| matches!(state, ContactState::Slip { .. });
        let has_zero = states.contains(&ContactState::Zero);
        if has_zero || !states.iter().any(slips) {
            return Ok(None);
        }

        let mu = &self.path.steps.friction;
        if !self.contact.pencils().is_definite_at(mu, states)? {
            return Ok(None);
        }

        let here = Window::new(mu.clone(), Some(mu.clone()))?;
        let problem = self.problem_in(stretch, Unknown::Mu)?;
        let problem = Problem::from(problem.with_window(here));
        let found = problem.complete().cancel(cancel).run()?;
        let is_unique = found.proved().accepted().has_unique_rates;
        Ok(is_unique.then_some(found))
    }

    /// In words: a table of its stretches, why it ends, whether it is the only one. What
    /// `mceip path` prints.
    pub fn text(&self) -> String {
        say::path::text_of(self)
    }

    /// What each candidate does at the beginning and at the end of each stretch, as CSV with a
    /// heading: state, displacement and reaction in its own directions, in the units of the file.
    pub fn reactions_csv(&self) -> String {
        say::path::reactions_csv(self)
    }

    /// The stretches in whose states nothing but the last digits of K holds the body: its path is
    /// exact, and worth nothing there. In doubles.
    pub fn held_by_rounding(&self) -> &[usize] {
        &self.held_by_rounding
    }

    /// Why it ends, in words.
    pub fn end_text(&self) -> String {
        say::path::end_text(&self.path, self.loads.candidates())
    }

    /// The stretches for programs: those of `mceip path --json`.
    pub fn to_json(&self) -> Vec<Value> {
        say::path::json_of(&self.path, &self.loads.step_names(), &self.continuations)
    }
}

/// Contact states that are proved to be those of an equilibrium, or why they are not.
pub type ProvedStates = Result<Proved<EquilibriumCertificate>, StatesNotCertified>;

/// Certifies the contact states of an equilibrium of a stretch.
pub(super) fn certify_states(
    body: &LoadedBody,
    path: &LoadingPath,
    stretch: &Stretch,
    equilibrium: &Equilibrium,
) -> ProvedStates {
    certify_equilibrium(body, stated(path, stretch, equilibrium))
}

fn stated(path: &LoadingPath, stretch: &Stretch, equilibrium: &Equilibrium) -> StatedEquilibrium {
    let states = equilibrium.contact_states();
    // Without reaction a candidate is on the edge of opening: nothing may be rounded.
    let is_degenerate = states.contains(&ContactState::Zero);

    let mut candidates = Vec::with_capacity(states.len());
    for (node, state) in states.iter().enumerate() {
        candidates.push(match *state {
            ContactState::Free => StatedState::Free {},
            ContactState::Zero => StatedState::Zero {},
            ContactState::Slip { sign } => StatedState::Slip {
                sign: SlipSign::of(sign),
            },
            ContactState::Stick => {
                let (tangential, _) = equilibrium.displacement(node);
                let tangential = if is_degenerate {
                    tangential
                } else {
                    short(tangential)
                };
                StatedState::Stick {
                    tangential: Number(tangential),
                }
            }
        });
    }

    StatedEquilibrium {
        friction: path.steps.friction.clone(),
        amounts: path.applied_at(stretch, equilibrium),
        candidates,
    }
}

/// Bits of a fraction up to which it is stated as it is.
const SHORT: u64 = 128;

/// The number itself where it is short, else the nearest double: a candidate inside its friction
/// cone sticks there as well.
fn short(value: Rational) -> Rational {
    if value.numer().bits() + value.denom().bits() <= SHORT {
        return value;
    }

    from_f64(to_f64(&value)).unwrap_or(value)
}
