//! Everything that is said about a system at one mu: the data that [`analyse`](super::analyse)
//! makes, and that `sentences` and `json` present.

use super::conditions::{DefiniteUntil, Necessary};
use super::critical::Critical;
use super::divergence::{Divergence, Verdict};
use super::evidence::Proof;
use super::flutter::Flutter;
use super::members::Members;
use super::ranges::{Range, Sample};
use super::stability::Stability;
use super::threshold::StaticThreshold;
use super::unbounded::UnboundedGrowth;
use mceip_exact::Rational;

/// Everything that is said about a system at one mu.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// Name of the problem; [`analyse`](super::analyse) gives none, who has the problem sets it.
    pub name: Option<String>,
    /// What looked wrong when the problem was made, set like the name.
    pub warnings: Vec<String>,
    /// Digest of the MCEIP-lambda2 problem that was analysed; `None` for mu = 0 and where nothing
    /// slips, which are no such problems.
    pub problem_sha256: Option<String>,
    /// mu.
    pub friction: Rational,
    /// Numbers of degrees of freedom, free degrees of freedom, slip particles, stick particles.
    pub sizes: [usize; 4],
    /// The particles by their names, or by their numbers.
    pub particles: Vec<String>,
    /// Number of particles with zero reaction.
    pub zero: usize,
    /// Divergence at mu.
    pub divergence: Divergence,
    /// Divergence at mu = 0, by the condition on K* alone.
    pub without_friction: Verdict,
    /// The smallest mu with lambda = 0.
    pub threshold: StaticThreshold,
    /// The infimum of mu over all lambda^2 >= 0.
    pub critical: Critical,
    /// The mu of unbounded growth, where the infimum lies there.
    pub unbounded: Option<UnboundedGrowth>,
    /// Up to which mu the equilibrium is proved to be stable; `None` where that is proved of no mu.
    pub stability: Option<Stability>,
    /// What is proved of every member of a system whose data have radii.
    pub members: Option<Members>,
    /// Where in mu divergence exists.
    pub ranges: Vec<Range>,
    /// The decided values of mu behind the ranges.
    pub samples: Vec<Sample>,
    /// (19), (20).
    pub necessary: Necessary,
    /// Where the condensed matrix sym T of lambda = 0 is positive definite; `None` without free
    /// variables, with particles of zero reaction, and where no end was found.
    pub condensed: Option<DefiniteUntil>,
    /// (17)-(18) at mu; `None` if undecided.
    pub sufficient: Option<bool>,
    /// Complex eigenvalues of the all-slip pencil at mu, unless the work was interrupted.
    pub flutter: Option<Flutter>,
    /// The certificates.
    pub proofs: Vec<Proof>,
    /// Was the work interrupted?
    pub interrupted: bool,
}

impl Analysis {
    /// These particles: "heel, toe", or "none".
    pub fn named(&self, particles: &[usize]) -> String {
        if particles.is_empty() {
            return "none".into();
        }

        let names = particles.iter().map(|&k| self.particles[k].as_str());
        names.collect::<Vec<_>>().join(", ")
    }
}
