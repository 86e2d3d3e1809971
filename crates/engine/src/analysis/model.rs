//! The system under analysis, the work allowed, and the problems posed on it.

use super::absence::Limits;
use super::error::AnalysisError;
use crate::run::Watch;
use crate::search::complete::{self, Completed, complete};
use mceip_exact::{Rational, Sparse};
use mceip_model::{Body, Particle, Problem, System, Unknown, Window};

/// How much work an analysis may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Values of mu at which divergence is decided, to find the ranges in which it exists; 0: none.
    pub samples: usize,
    /// Threads, all cores if not given. The answer does not depend on it.
    pub threads: Option<usize>,
    /// Work for the bound of the critical mu.
    pub limits: Limits,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            samples: 16,
            threads: None,
            limits: Limits::default(),
        }
    }
}

/// The system and how to search it.
pub(super) struct Model<'a> {
    pub(super) system: &'a System,
    pub(super) options: &'a Options,
    pub(super) watch: Watch<'a>,
}

impl Model<'_> {
    /// MCEIP-lambda2 at a mu, or MCEIP-mu, for the contact states of the system.
    pub(super) fn problem(&self, friction: Option<&Rational>) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().cloned();
        self.with(self.system.stiffness().clone(), mass, friction)
    }

    /// MCEIP-mu at a fixed lambda^2: that of K + lambda^2 M.
    pub(super) fn at_lambda2(&self, lambda2: &Rational) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().ok_or(AnalysisError::NoMass)?;
        self.with(
            self.system.stiffness().add_scaled(lambda2, mass),
            None,
            None,
        )
    }

    pub(super) fn with(
        &self,
        stiffness: Sparse,
        mass: Option<Sparse>,
        friction: Option<&Rational>,
    ) -> Result<Problem, AnalysisError> {
        if mass.is_none() && self.system.mass().is_none() {
            return Err(AnalysisError::NoMass);
        }
        let particles = self
            .system
            .particles()
            .iter()
            .map(|p| Particle {
                reaction: None,
                ..p.clone()
            })
            .collect();
        let unknown = if friction.is_some() {
            Unknown::Lambda2
        } else {
            Unknown::Mu
        };
        let mass = mass.filter(|_| friction.is_some());
        let system = System::new(stiffness, mass, friction.cloned(), particles)?;
        Ok(Problem::new(Body::System(system), unknown, Window::all())?)
    }

    pub(super) fn complete(&self, problem: &Problem) -> Result<Completed, AnalysisError> {
        let options = complete::Options {
            threads: self.options.threads,
            ..complete::Options::default()
        };
        Ok(complete(problem, &options, &self.watch)?)
    }

    pub(super) fn stopped(&self) -> bool {
        self.watch.is_cancelled()
    }
}
