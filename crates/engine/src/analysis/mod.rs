//! The engineer's answer for one mechanical system at one mu: divergence of the form (8), growth,
//! thresholds, conditions (17)-(20), and the evidence behind each sentence.
//!
//! [`analyse`] makes plain data ([`Analysis`]); [`Analysis::sentences`] says it in words,
//! [`Analysis::to_json`] as `mceip-analysis/1`. A sentence rests on a certificate that
//! [`mceip_check`] has accepted, on an exact condition, or on a measurement in doubles, and says
//! which.

pub mod absence;
mod answer;
pub mod conditions;
mod critical;
mod divergence;
mod error;
mod evidence;
mod flutter;
mod json;
mod model;
mod modes;
mod ranges;
mod sentences;
mod threshold;

pub use answer::Analysis;
pub use critical::{CertifiedSolution, Critical};
pub use divergence::{Divergence, Verdict};
pub use error::AnalysisError;
pub use evidence::{Evidence, Proof};
pub use flutter::Flutter;
pub use json::ANALYSIS_FORMAT;
pub use model::Options;
pub use modes::Mode;
pub use ranges::{Range, Sample};
pub use sentences::Sentence;
pub use threshold::StaticThreshold;

use crate::reduction::{MuFamily, mu_family};
use crate::run::{Progress, Watch};
use crate::search::complete::Completed;
use conditions::{Necessary, is_all_slip};
use divergence::divergence;
use mceip_check::certificate::Claim;
use mceip_exact::Rational;
use mceip_model::{Particle, System};
use model::Model;

/// Analyses a mechanical system at a mu. Contact states are those of the system, taken as impending
/// slip at mu: reactions in it are not used. An analysis that is cancelled leaves open what is not
/// done.
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
        watch: watch.quiet(),
    };
    let here = model.problem(Some(friction))?;
    let family = mu_family(system)?;
    let mut proofs = Vec::new();
    watch.report(&Progress::stage("conditions (19), (20)"));
    let necessary = Necessary::of(&family)?;
    watch.report(&Progress::stage("divergence at mu: all lambda^2 >= 0"));
    let found = model.complete(&here)?;
    let divergence = divergence(system, &family, &found);
    let sufficient = sufficient(&family, &found, divergence.verdict);
    proofs.push(Proof {
        name: "lambda2".into(),
        problem: here.clone(),
        certificate: found.certificate,
    });
    watch.report(&Progress::stage("static threshold: all mu >= 0"));
    let at_zero = model.problem(None)?;
    let found = model.complete(&at_zero)?;
    let threshold = StaticThreshold::of(&found);
    proofs.push(Proof {
        name: "mu".into(),
        problem: at_zero,
        certificate: found.certificate,
    });
    watch.report(&Progress::stage(
        "critical mu: all lambda^2 >= 0 and all smaller mu",
    ));
    let critical = critical::critical(
        &model,
        &family,
        &necessary,
        friction,
        &divergence,
        &threshold,
        &mut proofs,
    )?;
    watch.report(&Progress::stage("ranges of mu"));
    let (ranges, samples) = ranges::ranges(&model, friction, &threshold, &critical)?;
    let count = |f: fn(&Particle) -> bool| system.particles().iter().filter(|p| f(p)).count();
    let stick = count(|p| p.state == mceip_model::ContactState::Stick);
    Ok(Analysis {
        name,
        problem_sha256: here.sha256(),
        friction: friction.clone(),
        sizes: [
            system.dofs(),
            system.free_dofs().len(),
            system.slip_particles().len(),
            stick,
        ],
        flutter: flutter::flutter(&family, friction),
        divergence,
        threshold,
        critical,
        ranges,
        samples,
        necessary,
        sufficient,
        proofs,
        interrupted: watch.is_cancelled(),
    })
}

/// (17)-(18): is one of the solutions an all-slip one?
fn sufficient(family: &MuFamily, found: &Completed, verdict: Verdict) -> Option<bool> {
    let claimed = |support: &[usize]| -> Vec<usize> {
        let same = found.certificate.claims.iter().filter_map(|c| match c {
            Claim::ExactSolution(c) if c.support == support => Some(c.biactive.clone()),
            _ => None,
        });
        same.flatten().collect()
    };
    let all = found
        .cover
        .solutions
        .iter()
        .any(|s| is_all_slip(&family.stiffness, &s.support, &claimed(&s.support)));
    if all {
        Some(true)
    } else if verdict == Verdict::Undecided || !found.cover.is_plain_list() {
        None
    } else {
        Some(false)
    }
}
