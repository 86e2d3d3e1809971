//! The engineer's answer: can an equilibrium diverge in the form (8), from which friction on, and
//! how does one know?

use super::error::Error;
use super::problem::Problem;
use super::run::Watched;
use mceip_engine::analysis::{Analysis, Options, analyse};
use mceip_engine::run::{Cancel, Progress};
use mceip_exact::Rational;
use mceip_model::Body;

/// An analysis; see [`Problem::analyze`].
pub struct Analyze<'a> {
    problem: &'a Problem,
    friction: Option<Rational>,
    options: Options,
    watched: Watched<'a>,
}

impl Problem {
    /// Can this equilibrium diverge in the form (8), from which friction on, and how do you know?
    ///
    /// ```
    /// use mceip::Problem;
    /// let problem = Problem::read("spec/examples/two-particles.json")?;
    /// let answer = problem.analyze().friction("1.1".parse()?).samples(0).run()?;
    /// for sentence in answer.sentences() {
    ///     println!("{}", sentence.text);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn analyze(&self) -> Analyze<'_> {
        Analyze {
            problem: self,
            friction: None,
            options: Options::default(),
            watched: Watched::default(),
        }
    }
}

impl<'a> Analyze<'a> {
    /// The friction coefficient; the system's own if not said. At 0 a theorem answers.
    pub fn friction(mut self, friction: Rational) -> Self {
        self.friction = Some(friction);
        self
    }

    /// Values of mu at which divergence is decided, to find the ranges in which it exists; 16 if
    /// not said, 0 for none.
    pub fn samples(mut self, samples: usize) -> Self {
        self.options.samples = samples;
        self
    }

    /// Threads, at most 1024; all cores if not said. The answer does not depend on it.
    pub fn threads(mut self, threads: usize) -> Self {
        self.options.threads = Some(threads);
        self
    }

    /// The switch that ends the analysis early; what is not done is left open.
    pub fn cancel(mut self, cancel: &Cancel) -> Self {
        self.watched.cancel(cancel);
        self
    }

    /// Hears what is being done.
    pub fn on_progress(mut self, hear: impl Fn(&Progress<'_>) + Sync + 'a) -> Self {
        self.watched.on_progress(hear);
        self
    }

    /// Analyses.
    ///
    /// # Errors
    /// [`Error::NotASystem`] for a pencil, [`Error::NoFriction`], and [`Error::Analyze`].
    pub fn run(self) -> Result<Analysis, Error> {
        let problem = self.problem.as_model();
        let Body::System(system) = problem.body() else {
            return Err(Error::NotASystem);
        };
        let given = self.friction.as_ref();
        let friction = given.or(system.friction()).ok_or(Error::NoFriction)?;

        let name = problem.name.clone();
        let watch = self.watched.watch();
        let mut analysis = analyse(name, system, friction, &self.options, &watch)?;
        analysis.warnings.clone_from(&problem.warnings);

        Ok(analysis)
    }
}
