//! The engineer's answer: can an equilibrium diverge in the form (8), from which friction on, and
//! how does one know?

use super::error::Error;
use super::problem::Problem;
use super::run::{Watched, watched_question};
use mceip_engine::analysis::{Analysis, AnalysisOptions, analyse};
use mceip_engine::run::Kept;
use mceip_exact::Rational;
use mceip_model::file::SystemFile;
use mceip_model::{Body, System};
use std::time::Duration;

/// An analysis; see [`Problem::analyze`].
pub struct Analyze<'a> {
    /// None for a pencil.
    system: Option<&'a System>,
    /// The friction coefficient of the file.
    own_friction: Option<&'a Rational>,
    name: Option<String>,
    warnings: &'a [String],
    friction: Option<Rational>,
    options: AnalysisOptions,
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
        let problem = self.as_model();
        let system = match problem.body() {
            Body::System(system) => Some(system),
            Body::Pencil(_) | Body::Quadratic(_) => None,
        };

        Analyze {
            system,
            own_friction: system.and_then(System::friction),
            name: problem.name.clone(),
            warnings: &problem.warnings,
            friction: None,
            options: AnalysisOptions::default(),
            watched: Watched::default(),
        }
    }
}

/// The analysis of a file that need not be a problem: mu = 0, or nothing slips.
impl<'a> From<&'a SystemFile> for Analyze<'a> {
    fn from(file: &'a SystemFile) -> Analyze<'a> {
        Analyze {
            system: Some(&file.system),
            own_friction: file.friction.as_ref(),
            name: file.name.clone(),
            warnings: &file.warnings,
            friction: None,
            options: AnalysisOptions::default(),
            watched: Watched::default(),
        }
    }
}

watched_question!(Analyze, "what is not done is left open");

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

    /// Boxes of a piece of a cover of lambda^2 and mu, at most.
    pub fn boxes(mut self, boxes: usize) -> Self {
        self.options.limits.boxes = boxes;
        self
    }

    /// Threads, at most 1024; all cores if not said. The answer does not depend on it.
    pub fn threads(mut self, threads: usize) -> Self {
        self.options.threads = Some(threads);
        self
    }

    /// Hands over what is proved so far: each proof when it is made, and what a long search has
    /// proved about as often as said.
    pub fn keep(mut self, every: Duration, keep: impl Fn(&Kept<'_>) + Sync + 'a) -> Self {
        self.watched.keep(every, keep);
        self
    }

    /// Analyses.
    ///
    /// # Errors
    /// [`Error::NotASystem`] for a pencil, [`Error::NoFriction`], and [`Error::Analyze`].
    pub fn run(self) -> Result<Analysis, Error> {
        let system = self.system.ok_or(Error::NotASystem)?;
        let friction = self.friction.as_ref().or(self.own_friction);
        let friction = friction.ok_or(Error::NoFriction)?;

        let watch = self.watched.watch();
        let mut analysis = analyse(system, friction, &self.options, &watch)?;
        analysis.name = self.name;
        analysis.warnings = self.warnings.to_vec();

        Ok(analysis)
    }
}
