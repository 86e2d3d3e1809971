//! The engineer's answer for one mechanical system at one mu.
//!
//! Is there divergence of the form (8) at mu, and how fast does it grow? From which mu on is there
//! any: at lambda = 0 (the static threshold), and over all lambda^2 >= 0 (the critical mu)? Do the
//! conditions (17)-(20) hold? What stands behind each sentence?
//!
//! Input: a [`System`] with mass and at least one slip particle, and mu. [`analyse`] makes plain
//! data ([`Analysis`]); [`Analysis::sentences`] says it in words, [`Analysis::to_json`] as
//! `mceip-analysis/1`. A sentence rests on a certificate that [`mceip_check`] has accepted, on an
//! exact condition, or on a measurement in doubles, and says which. Called by `mceip analyze` and
//! by the front door.

pub mod absence;
mod absent_ranges;
mod answer;
pub mod conditions;
mod critical;
mod divergence;
mod eliminated;
mod error;
mod evidence;
mod families;
mod flutter;
mod follow;
mod json;
mod model;
mod modes;
mod null_vectors;
mod presence;
mod ranges;
mod sentences;
mod summary;
mod threshold;

pub use answer::Analysis;
pub use critical::{CertifiedSolution, Critical, Obstacle, Unproved};
pub use divergence::{Divergence, Verdict};
pub use error::AnalysisError;
pub use evidence::{Evidence, Proof, ProofCertificate};
pub use flutter::{Flutter, Onset};
pub use json::ANALYSIS_FORMAT;
pub use model::Options;
pub use modes::{Mode, ZeroMode};
pub use ranges::{Range, Sample};
pub use sentences::Sentence;
pub use threshold::StaticThreshold;

use crate::run::{Progress, Watch};
use crate::search::complete::Completed;
use conditions::{Necessary, is_all_slip};
use critical::{Known, Start};
use divergence::divergence;
use families::Families;
use mceip_check::certificate::Claim;
use mceip_exact::{Rational, to_f64};
use mceip_model::{ContactState, Problem, System};
use model::Model;

/// Analyses a mechanical system at a mu.
///
/// Contact states are those of the system, taken as impending slip at mu: reactions in it are not
/// used. An analysis that is cancelled leaves open what is not done.
///
/// # Errors
/// [`AnalysisError`]: no mass, no slip particle, numbers beyond doubles, a definiteness not
/// decided.
pub fn analyse(
    name: Option<String>,
    system: &System,
    friction: &Rational,
    options: &Options,
    watch: &Watch<'_>,
) -> Result<Analysis, AnalysisError> {
    error::require_doubles(system)?;
    let model = Model {
        system,
        options,
        watch: *watch,
    };

    let at_friction = model.problem(Some(friction))?;
    let families = Families::of(system)?;
    let family = &families.own;

    watch.report(&Progress::stage("conditions (19), (20)"));
    let necessary = Necessary::of(families.of_condition())?;

    let stage = "divergence at mu, all lambda^2 >= 0";
    let found = model.complete(stage, &at_friction, Some("lambda2"))?;
    let divergence = divergence(system, family, &found);
    let sufficient = sufficient(&families, &found, divergence.verdict);
    let problem_sha256 = at_friction.sha256();
    let slip = family.stiffness.slip();
    let mu = to_f64(friction);
    let mut starts = starts(&found, &slip, |value| [value, mu]);
    let of_lambda2 = proof(&model, "lambda2", at_friction.clone(), found);

    let at_zero = model.problem(None)?;
    let found = model.complete("static threshold, all mu >= 0", &at_zero, Some("mu"))?;
    let threshold = StaticThreshold::of(&found);
    starts.extend(self::starts(&found, &slip, |value| [0.0, value]));
    let of_mu = proof(&model, "mu", at_zero, found);

    watch.report(&Progress::stage(
        "critical mu: all lambda^2 >= 0 and all smaller mu",
    ));
    let mut proofs = vec![of_lambda2, of_mu];
    let known = Known {
        families: &families,
        necessary: &necessary,
        friction,
        problem: &at_friction,
        divergence: &divergence,
        threshold: &threshold,
        starts,
    };

    let found = critical::critical(&model, &known, &mut proofs)?;
    let of_ranges = ranges::ranges(&model, &known, found, &mut proofs)?;

    let flutter = if watch.is_cancelled() {
        None
    } else {
        watch.report(&Progress::stage(
            "flutter: eigenvalues with all particles slipping",
        ));
        flutter::flutter(&families, friction)
    };

    Ok(Analysis {
        name,
        warnings: Vec::new(),
        problem_sha256,
        friction: friction.clone(),
        sizes: sizes(system),
        zero: families.zero.len(),
        flutter,
        divergence,
        threshold,
        critical: of_ranges.critical,
        ranges: of_ranges.ranges,
        samples: of_ranges.samples,
        necessary,
        sufficient,
        proofs,
        interrupted: watch.is_cancelled(),
    })
}

/// A problem with the certificate that a complete search made for it, handed over to the keeper of
/// the run.
fn proof(model: &Model<'_>, name: &str, problem: Problem, found: Completed) -> Proof {
    let certificate = ProofCertificate::Solutions(found.certificate);
    model.keep(name, &problem, &certificate);
    Proof {
        name: name.into(),
        problem,
        certificate,
    }
}

/// The solutions of a complete search in doubles; `place` gives lambda^2 and mu of a value.
fn starts(found: &Completed, slip: &[usize], place: impl Fn(f64) -> [f64; 2]) -> Vec<Start> {
    let mut starts = Vec::new();
    for (solution, x) in found.solutions() {
        let [lambda2, mu] = place(to_f64(&solution.value.mid()));
        let x: Vec<f64> = slip.iter().map(|&i| x[i]).collect();
        if x.iter().all(|v| v.is_finite()) {
            starts.push(Start { lambda2, mu, x });
        }
    }

    starts
}

/// Numbers of degrees of freedom, free degrees of freedom, slip particles, stick particles.
fn sizes(system: &System) -> [usize; 4] {
    let particles = system.particles().iter();
    let sticking = particles.filter(|p| p.state == ContactState::Stick);
    [
        system.dofs(),
        system.free_dofs().len(),
        system.slip_particles().len(),
        sticking.count(),
    ]
}

/// (17)-(18): is one of the solutions an all-slip one? `None` where none of those found is, and
/// others may exist, and for particles with zero reaction, for which these conditions say nothing.
fn sufficient(families: &Families, found: &Completed, verdict: Verdict) -> Option<bool> {
    if !families.zero.is_empty() {
        return None;
    }

    let has_all_slip = found.cover.solutions.iter().any(|solution| {
        let biactive = claimed_biactive(found, &solution.support);
        is_all_slip(&families.own.stiffness, &solution.support, &biactive)
    });

    if has_all_slip {
        Some(true)
    } else if verdict == Verdict::Undecided || !found.cover.is_plain_list() {
        None
    } else {
        Some(false)
    }
}

/// The biactive indices of the claims with a support.
fn claimed_biactive(found: &Completed, support: &[usize]) -> Vec<usize> {
    let mut biactive = Vec::new();
    for claim in &found.certificate.claims {
        if let Claim::ExactSolution(claim) = claim
            && claim.support == support
        {
            biactive.extend(&claim.biactive);
        }
    }

    biactive
}
