//! The system under analysis, the work allowed, and the problems posed on it.
//!
//! All problems have the contact states of the system and the window [0, infinity): MCEIP-lambda2
//! at a mu, MCEIP-mu, and MCEIP-mu with K + lambda^2 M in place of K. Reactions are left out, which
//! would tie the contact states to another mu. Called by the other files of this folder.

use super::absence::Limits;
use super::error::AnalysisError;
use super::evidence::ProofCertificate;
use crate::run::{Keeper, Kept, Progress, Watch};
use crate::search::complete::{self, Completed, complete, resume};
use mceip_check::certificate::Certificate;
use mceip_exact::{Rational, Sparse};
use mceip_model::{Body, Problem, System, Unknown, Window};

/// The most values of mu that may be asked for: more than any plot has use for.
pub const MAX_SAMPLES: usize = 10_000;

/// How much work an analysis may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AnalysisOptions {
    /// Values of mu at which divergence is decided, to find the ranges in which it exists; 0: none,
    /// at most [`MAX_SAMPLES`].
    pub samples: usize,
    /// Threads, all cores if not given. The answer does not depend on it.
    pub threads: Option<usize>,
    /// Work for the bound of the critical mu, and for each range of absence above it.
    pub limits: Limits,
}

impl Default for AnalysisOptions {
    fn default() -> Self {
        AnalysisOptions {
            samples: 16,
            threads: None,
            limits: Limits::default(),
        }
    }
}

/// The system and how to search it.
pub(super) struct AnalysisModel<'a> {
    pub(super) system: &'a System,
    pub(super) options: &'a AnalysisOptions,
    /// What an earlier run has proved of one of the problems.
    pub(super) earlier: Option<&'a Certificate>,
    pub(super) watch: Watch<'a>,
}

impl AnalysisModel<'_> {
    /// MCEIP-lambda2 at a mu, or MCEIP-mu, for the contact states of the system.
    pub(super) fn problem(&self, friction: Option<&Rational>) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().ok_or(AnalysisError::NoMass)?;
        let stiffness = self.system.stiffness().clone();
        match friction {
            Some(mu) => self.posed(stiffness, Some((mass.clone(), mu.clone()))),
            None => self.posed(stiffness, None),
        }
    }

    /// MCEIP-mu at a fixed lambda^2: that of K + lambda^2 M.
    pub(super) fn at_lambda2(&self, lambda2: &Rational) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().ok_or(AnalysisError::NoMass)?;
        let stiffness = self.system.stiffness().add_scaled(lambda2, mass);
        self.posed(stiffness, None)
    }

    /// MCEIP-mu with M in place of K: of infinite lambda^2.
    pub(super) fn of_mass(&self) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().ok_or(AnalysisError::NoMass)?;
        self.posed(mass.clone(), None)
    }

    /// MCEIP-lambda2 if mass and mu are given, else MCEIP-mu.
    fn posed(
        &self,
        stiffness: Sparse,
        mass_and_friction: Option<(Sparse, Rational)>,
    ) -> Result<Problem, AnalysisError> {
        let mut particles = self.system.particles().to_vec();
        for particle in &mut particles {
            particle.reaction = None;
        }

        let (unknown, mass, friction) = match mass_and_friction {
            Some((mass, friction)) => (Unknown::Lambda2, Some(mass), Some(friction)),
            None => (Unknown::Mu, None, None),
        };

        let system = System::new(stiffness, mass, friction, particles)?;
        Ok(Problem::new(Body::System(system), unknown, Window::all())?)
    }

    /// The complete set of a problem, as far as it is found before the work is cancelled. The
    /// listener hears the counts of the search under the name of the stage; the keeper gets what is
    /// proved meanwhile under the name of the proof, if it has one.
    pub(super) fn complete(
        &self,
        stage: &str,
        problem: &Problem,
        proof: Option<&str>,
    ) -> Result<Completed, AnalysisError> {
        let keep = |kept: &Kept<'_>| self.keep_as(proof.unwrap_or_default(), kept);
        let keeper = self.watch.keeper().filter(|_| proof.is_some());
        let keeper = keeper.map(|keeper| Keeper::new(keeper.every, &keep));
        let relay = |progress: &Progress<'_>| self.relay(stage, progress);
        self.watch.report(&Progress::stage(stage));

        let options = complete::CompleteOptions {
            threads: self.options.threads,
            ..complete::CompleteOptions::default()
        };

        let watch = self.watch.heard_by(&relay).kept_by(keeper);
        if let Some(earlier) = self.earlier
            && let Ok(found) = resume(problem, earlier, &options, &watch)
        {
            return Ok(found);
        }
        Ok(complete(problem, &options, &watch)?)
    }

    /// Hands a proof over to the keeper of the run, if there is one.
    pub(super) fn keep(&self, name: &str, problem: &Problem, certificate: &ProofCertificate) {
        self.keep_as(
            name,
            &Kept {
                name,
                problem,
                certificate,
            },
        );
    }

    fn keep_as(&self, name: &str, kept: &Kept<'_>) {
        if let Some(keeper) = self.watch.keeper() {
            keeper.hand_over(&Kept { name, ..*kept });
        }
    }

    /// Passes the progress of a part of a stage on, with the name of the stage before its own.
    pub(super) fn relay(&self, stage: &str, progress: &Progress<'_>) {
        let stage = format!("{stage}: {}", progress.stage);
        self.watch.report(&Progress {
            stage: &stage,
            ..*progress
        });
    }

    /// The same model without progress reports: for a search beside another one, whose progress is
    /// shown.
    pub(super) fn quiet(&self) -> AnalysisModel<'_> {
        AnalysisModel {
            watch: self.watch.quiet(),
            ..*self
        }
    }

    pub(super) fn stopped(&self) -> bool {
        self.watch.is_cancelled()
    }
}
