//! Everything that is said about a system at one mu: the data that [`analyse`](super::analyse)
//! makes, and that `sentences` and `json` present.

use super::conditions::Necessary;
use super::critical::Critical;
use super::divergence::Divergence;
use super::evidence::Proof;
use super::flutter::Flutter;
use super::ranges::{Range, Sample};
use super::threshold::StaticThreshold;
use mceip_exact::Rational;

/// Everything that is said about a system at one mu.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// Name of the problem.
    pub name: Option<String>,
    /// What looked wrong when the problem was made; [`analyse`](super::analyse) leaves it empty, who
    /// has the problem sets it.
    pub warnings: Vec<String>,
    /// Digest of the MCEIP-lambda2 problem that was analysed.
    pub problem_sha256: String,
    /// mu.
    pub friction: Rational,
    /// Numbers of degrees of freedom, free degrees of freedom, slip particles, stick particles.
    pub sizes: [usize; 4],
    /// Number of particles with zero reaction.
    pub zero: usize,
    /// Divergence at mu.
    pub divergence: Divergence,
    /// The smallest mu with lambda = 0.
    pub threshold: StaticThreshold,
    /// The infimum of mu over all lambda^2 >= 0.
    pub critical: Critical,
    /// Where in mu divergence exists.
    pub ranges: Vec<Range>,
    /// The decided values of mu behind the ranges.
    pub samples: Vec<Sample>,
    /// (19), (20).
    pub necessary: Necessary,
    /// (17)-(18) at mu; `None` if undecided.
    pub sufficient: Option<bool>,
    /// Complex eigenvalues of the all-slip pencil at mu, unless the work was interrupted.
    pub flutter: Option<Flutter>,
    /// The certificates.
    pub proofs: Vec<Proof>,
    /// Was the work interrupted?
    pub interrupted: bool,
}
