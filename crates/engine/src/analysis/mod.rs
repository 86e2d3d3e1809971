//! The engineer's answer for one mechanical system at one mu.
//!
//! Is there divergence of the form (8) at mu, and how fast does it grow? From which mu on is there
//! any: at lambda = 0 (the static threshold), and over all lambda^2 >= 0 (the critical mu)? Do the
//! conditions (17)-(20) hold? What stands behind each sentence?
//!
//! Input: a [`System`] with mass, and mu >= 0. Without slip particles, and for mu = 0, a theorem
//! answers (`by_theorem`). [`analyse`] makes plain data ([`Analysis`]); [`Analysis::sentences`]
//! says it in words, [`Analysis::to_json`] as `mceip-analysis/1`. A sentence rests on a certificate
//! that [`mceip_check`] has accepted, on an exact condition, or on a measurement in doubles, and
//! says which. Called by `mceip analyze` and by the front door.

pub mod absence;
mod absent_ranges;
mod answer;
mod by_theorem;
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
mod members;
mod model;
mod modes;
mod presence;
mod ranges;
mod sentences;
mod stability;
mod summary;
mod threshold;
mod unbounded;

pub use answer::Analysis;
pub use critical::{CertifiedSolution, Critical, Obstacle, Unproved};
pub use divergence::{Divergence, Verdict};
pub use error::AnalysisError;
pub use evidence::{Evidence, Proof, ProofCertificate, ProofFile};
pub use flutter::{Flutter, Onset, Oscillation};
pub use json::ANALYSIS_FORMAT;
pub use members::{FirstOrder, MemberCost, Members, UncertainNumber};
pub use model::{AnalysisOptions, MAX_SAMPLES};
pub use modes::{Mode, ZeroMode};
pub use ranges::{Range, Sample};
pub use sentences::Sentence;
pub use stability::Stability;
pub use threshold::StaticThreshold;
pub use unbounded::UnboundedGrowth;

use crate::run::{Progress, Watch, in_threads};
use crate::search::complete::Completed;
use conditions::{Necessary, is_all_slip};
use critical::{BranchStart, CriticalFound, KnownOfSystem};
use divergence::divergence;
use families::Families;
pub(crate) use families::friction_parts;
use mceip_check::certificate::{Certificate, StabilityCertificate};
use mceip_check::{AcceptedStability, Proved};
use mceip_exact::{Rational, to_f64, whole};
use mceip_model::{ContactState, Problem, System};
use model::AnalysisModel;
use num_traits::{Signed, Zero};

/// Analyses a mechanical system at a mu.
///
/// Contact states are those of the system, taken as impending slip at mu: reactions in it are not
/// used. An analysis that is cancelled leaves open what is not done.
///
/// # Errors
/// [`AnalysisError`]: no mass, mu < 0, numbers beyond doubles, a definiteness not decided.
pub fn analyse(
    system: &System,
    friction: &Rational,
    options: &AnalysisOptions,
    watch: &Watch<'_>,
) -> Result<Analysis, AnalysisError> {
    error::require_question(system, friction)?;
    if options.samples > MAX_SAMPLES {
        return Err(AnalysisError::TooManySamples(options.samples));
    }
    if system.slip_particles().is_empty() {
        return Ok(by_theorem::nothing_slips(system, friction));
    }

    let given = (!system.is_exact()).then(|| system.as_given());
    let in_pool = AnalysisOptions {
        threads: None,
        ..*options
    };
    let model = AnalysisModel {
        system: given.as_ref().unwrap_or(system),
        options: &in_pool,
        earlier: None,
        watch: *watch,
    };
    in_threads(options.threads, || {
        analyse_in_pool(&model, system, friction)
    })
}

/// [`analyse`] for a question that is admitted, in the current pool. Searches that do not use each
/// other's results run side by side; the proofs are in a fixed order. The system of the model is
/// the body as given, without radii; `with_radii` is the same body with them, if it has any.
fn analyse_in_pool(
    model: &AnalysisModel<'_>,
    with_radii: &System,
    friction: &Rational,
) -> Result<Analysis, AnalysisError> {
    let system = model.system;
    let watch = &model.watch;
    let mut proofs = Vec::new();
    let ground = CriticalGround::of(model, friction, &mut proofs)?;
    let known = ground.known(friction);

    let over_friction = || -> Result<_, AnalysisError> {
        let found = critical::critical(model, &known, &mut proofs)?;
        let members = (!with_radii.is_exact())
            .then(|| self::members(model, with_radii, friction, &found, &mut proofs));
        let of_ranges = ranges::ranges(model, &known, found, &mut proofs)?;
        let critical = &of_ranges.critical;
        let unbounded = unbounded::unbounded(model, &ground.necessary, critical, &mut proofs)?;
        watch.report(&Progress::stage("stability at rest, flutter"));
        Ok((of_ranges, members, unbounded))
    };
    let stability_and_flutter = || {
        let stable = stability(&model.quiet(), &known);
        let flutter = flutter::flutter(&ground.families, friction, watch);
        (stable, flutter)
    };
    // An error of one is told when the other has ended.
    let (over_friction, (stable, flutter)) = rayon::join(over_friction, stability_and_flutter);
    let (of_ranges, members, unbounded) = over_friction?;
    let stability = stable.map(|(accepted, proof)| {
        proofs.push(proof);
        Stability {
            to: accepted.to,
            is_of_every_motion: accepted.is_of_every_motion,
            evidence: Evidence::Certificate(proofs.len() - 1),
        }
    });

    let CriticalGround {
        families,
        necessary,
        at_friction,
        threshold,
    } = ground;
    let condensed = families.condensed(&necessary);

    Ok(Analysis {
        name: None,
        warnings: Vec::new(),
        problem_sha256: friction.is_positive().then(|| at_friction.problem.sha256()),
        friction: friction.clone(),
        sizes: sizes(system),
        particles: names(system),
        zero: families.zero.len(),
        flutter,
        without_friction: by_theorem::without_friction(&necessary, families.zero.len()).verdict,
        divergence: at_friction.divergence,
        threshold,
        critical: of_ranges.critical,
        unbounded,
        stability,
        members,
        ranges: of_ranges.ranges,
        samples: of_ranges.samples,
        necessary,
        condensed,
        sufficient: at_friction.sufficient,
        proofs,
        interrupted: watch.is_cancelled(),
    })
}

/// What every search for the critical mu of one body begins with.
struct CriticalGround {
    families: Families,
    necessary: Necessary,
    at_friction: AtFriction,
    threshold: StaticThreshold,
}

impl CriticalGround {
    fn of(
        model: &AnalysisModel<'_>,
        friction: &Rational,
        proofs: &mut Vec<Proof>,
    ) -> Result<CriticalGround, AnalysisError> {
        let (families, necessary) = families_and_condition(model)?;
        let at_zero = model.problem(None)?;
        let stage = "static threshold, all mu >= 0";
        let decide = || {
            let decided = AtFriction::decide(model, &families, &necessary, friction);
            model.watch.report(&Progress::stage(stage));
            decided
        };
        let search_threshold = || {
            let found = model.quiet().complete(stage, &at_zero, Some("mu"))?;
            let certificate = ProofCertificate::Solutions(found.proved.clone());
            let proof = proof(model, "mu", at_zero, certificate);
            Ok::<_, AnalysisError>((found, proof))
        };
        let (at_friction, at_zero) = rayon::join(decide, search_threshold);
        let mut at_friction = at_friction?;
        let (found, proof_at_zero) = at_zero?;
        proofs.extend(at_friction.proof.take());

        let threshold = StaticThreshold::of(&found, proofs.len());
        let slip = families.own.stiffness.slip();
        let of_threshold = starts(&found, &slip, |value| [0.0, value]);
        at_friction.starts.extend(of_threshold);
        proofs.push(proof_at_zero);

        let stage = "critical mu: all lambda^2 >= 0 and all smaller mu";
        model.watch.report(&Progress::stage(stage));
        Ok(CriticalGround {
            families,
            necessary,
            at_friction,
            threshold,
        })
    }

    fn known<'a>(&'a self, friction: &'a Rational) -> KnownOfSystem<'a> {
        KnownOfSystem {
            families: &self.families,
            necessary: &self.necessary,
            friction,
            problem: &self.at_friction.problem,
            divergence: &self.at_friction.divergence,
            threshold: &self.threshold,
            starts: self.at_friction.starts.clone(),
        }
    }
}

/// What is proved of every member of a system with radii; `found` is known of the body as given.
fn members(
    model: &AnalysisModel<'_>,
    with_radii: &System,
    friction: &Rational,
    found: &CriticalFound,
    proofs: &mut Vec<Proof>,
) -> Members {
    let middle = with_radii.middle();
    let has_own_factors = middle
        .particles()
        .iter()
        .zip(model.system.particles())
        .all(|(p, q)| p.friction_factor == q.friction_factor);
    if has_own_factors {
        return members::members(model, with_radii, friction, found, proofs);
    }

    // The body in the middle has other factors. What is proved of it is not kept: it would take the
    // names of what is proved of the body as given.
    let of_middle = AnalysisModel {
        system: &middle,
        watch: model.watch.kept_by(None),
        ..*model
    };
    let mut unused = Vec::new();
    let found = CriticalGround::of(&of_middle, friction, &mut unused)
        .and_then(|ground| critical::critical(&of_middle, &ground.known(friction), &mut unused));
    match found {
        Ok(found) => members::members(model, with_radii, friction, &found, proofs),
        Err(error) => Members::hindered(&error),
    }
}

/// The first answer of [`analyse`] alone: divergence at a mu, with the certificate where a search
/// decided it. If `earlier` is a certificate of this system at this mu, and the checker accepts it,
/// only what it leaves open is searched.
///
/// # Errors
/// As [`analyse`].
pub fn divergence_at(
    system: &System,
    friction: &Rational,
    earlier: Option<&Certificate>,
    options: &AnalysisOptions,
    watch: &Watch<'_>,
) -> Result<(Divergence, Option<Proof>), AnalysisError> {
    error::require_question(system, friction)?;
    if system.slip_particles().is_empty() {
        let by_theorem = by_theorem::nothing_slips(system, friction);
        return Ok((by_theorem.divergence, None));
    }

    let model = AnalysisModel {
        system,
        options,
        earlier,
        watch: *watch,
    };
    let (families, necessary) = families_and_condition(&model)?;
    let at_friction = AtFriction::decide(&model, &families, &necessary, friction)?;

    Ok((at_friction.divergence, at_friction.proof))
}

/// Up to which mu the equilibrium is stable, with its proof; `None` where none is found.
fn stability(
    model: &AnalysisModel<'_>,
    known: &KnownOfSystem<'_>,
) -> Option<(AcceptedStability, Proof)> {
    let proved = stability::stable_until(known.families, known.problem, &model.watch)?;
    let accepted = proved.accepted().clone();
    let certificate = ProofCertificate::Stability(proved);
    let proof = proof(model, "stable", known.problem.clone(), certificate);
    Some((accepted, proof))
}

/// A certificate that the equilibrium is stable for every mu up to one, as large a one as is found;
/// `None` where there is none. The system needs a mass and particles that slip.
///
/// # Errors
/// As [`analyse`].
pub fn stable_until(
    system: &System,
    watch: &Watch<'_>,
) -> Result<Option<Proved<StabilityCertificate>>, AnalysisError> {
    error::require_doubles(system)?;
    let options = AnalysisOptions::default();
    let model = AnalysisModel {
        system,
        options: &options,
        earlier: None,
        watch: *watch,
    };
    let problem = model.problem(Some(&whole(1)))?;
    let families = Families::of(system)?;

    Ok(stability::stable_until(&families, &problem, watch))
}

/// What every search of a system in which something slips begins with.
fn families_and_condition(
    model: &AnalysisModel<'_>,
) -> Result<(Families, Necessary), AnalysisError> {
    error::require_doubles(model.system)?;
    let families = Families::of(model.system)?;

    model
        .watch
        .report(&Progress::stage("conditions (19), (20)"));
    let necessary = in_threads(model.options.threads, || {
        Necessary::of(families.of_condition())
    })?;

    Ok((families, necessary))
}

/// What is known at the mu of the analysis.
struct AtFriction {
    /// MCEIP-lambda2 at this mu; for mu = 0, of which there is none, at mu = 1.
    problem: Problem,
    divergence: Divergence,
    sufficient: Option<bool>,
    /// The solutions in doubles.
    starts: Vec<BranchStart>,
    /// The certificate of a search.
    proof: Option<Proof>,
}

impl AtFriction {
    /// By a complete search, or for mu = 0 by a theorem.
    fn decide(
        model: &AnalysisModel<'_>,
        families: &Families,
        necessary: &Necessary,
        friction: &Rational,
    ) -> Result<AtFriction, AnalysisError> {
        if friction.is_zero() {
            let divergence = by_theorem::without_friction(necessary, families.zero.len());
            let is_absent = divergence.verdict == Verdict::Absent;
            let is_defined = families.zero.is_empty(); // else (17)-(18) say nothing
            return Ok(AtFriction {
                problem: model.problem(Some(&whole(1)))?,
                divergence,
                sufficient: (is_absent && is_defined).then_some(false),
                starts: Vec::new(),
                proof: None,
            });
        }

        let problem = model.problem(Some(friction))?;
        let stage = "divergence at mu, all lambda^2 >= 0";
        let found = model.complete(stage, &problem, Some("lambda2"))?;
        let divergence = divergence(model.system, &families.own, &found);
        let mu = to_f64(friction);
        let slip = families.own.stiffness.slip();

        Ok(AtFriction {
            sufficient: sufficient(families, &problem, &found, divergence.verdict),
            starts: starts(&found, &slip, |value| [value, mu]),
            proof: Some(proof(
                model,
                "lambda2",
                problem.clone(),
                ProofCertificate::Solutions(found.proved),
            )),
            problem,
            divergence,
        })
    }
}

/// A problem with a certificate for it, handed over to the keeper of the run.
fn proof(
    model: &AnalysisModel<'_>,
    name: &str,
    problem: Problem,
    certificate: ProofCertificate,
) -> Proof {
    model.keep(name, &problem, &certificate);
    Proof::new(name, problem, certificate)
}

/// The solutions of a complete search in doubles; `place` gives lambda^2 and mu of a value.
fn starts(found: &Completed, slip: &[usize], place: impl Fn(f64) -> [f64; 2]) -> Vec<BranchStart> {
    let mut starts = Vec::new();
    for (solution, x) in found.solutions() {
        let [lambda2, mu] = place(to_f64(&solution.value.mid()));
        let x: Vec<f64> = slip.iter().map(|&i| x[i]).collect();
        if x.iter().all(|v| v.is_finite()) {
            starts.push(BranchStart { lambda2, mu, x });
        }
    }

    starts
}

/// The particles by their names, or by their numbers.
fn names(system: &System) -> Vec<String> {
    let particles = system.particles().iter().enumerate();
    particles.map(|(k, particle)| particle.name_or(k)).collect()
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

/// (17)-(18): is one of the solutions of the problem an all-slip one? `None` where none of those
/// found is known to be one, and others may be or may exist, and for particles with zero reaction,
/// for which these conditions say nothing.
fn sufficient(
    families: &Families,
    problem: &Problem,
    found: &Completed,
    verdict: Verdict,
) -> Option<bool> {
    if !families.zero.is_empty() {
        return None;
    }

    let pencil = &families.own.stiffness;
    let mut is_known = verdict != Verdict::Undecided && found.cover.is_plain_list();
    for solution in &found.cover.solutions {
        match found.biactive(problem, solution) {
            Some(biactive) if is_all_slip(pencil, &solution.support, &biactive) => {
                return Some(true);
            }
            Some(_) => {}
            None => is_known = false,
        }
    }

    is_known.then_some(false)
}
