//! The engineer's answer for one mechanical system at one mu: divergence of the form (8), growth,
//! thresholds, conditions (17)-(20), and the evidence behind each sentence.
//!
//! [`analyse`] makes plain data ([`Analysis`]); [`Analysis::sentences`] says it in words,
//! [`Analysis::to_json`] as `mceip-analysis/1`. A sentence rests on a certificate that
//! [`crate::check`] has accepted, on an exact condition, or on a measurement in doubles, and says
//! which.

pub mod absence;
pub mod conditions;
mod critical;
mod error;
mod flutter;
mod json;
mod modes;
mod ranges;
mod sentences;

pub use critical::{CertifiedSolution, Critical};
pub use error::AnalysisError;
pub use flutter::Flutter;
pub use json::ANALYSIS_FORMAT;
pub use modes::Mode;
pub use ranges::{Range, Sample};
pub use sentences::Sentence;

use crate::certificate::{Certificate, Claim};
use crate::check::{OpenRegion, SolutionFamily};
use crate::exact::{Interval, Rational, Sparse};
use crate::model::{Body, Particle, Problem, System, Unknown, Window};
use crate::reduction::{MuFamily, mu_family};
use crate::run::{Progress, Watch};
use crate::search::complete::{self, Completed, complete};
use conditions::{Necessary, is_all_slip};

/// How much work an analysis may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Values of mu at which divergence is decided, to find the ranges in which it exists; 0: none.
    pub samples: usize,
    /// Threads, all cores if not given. The answer does not depend on it.
    pub threads: Option<usize>,
    /// Work for the bound of the critical mu.
    pub limits: absence::Limits,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            samples: 16,
            threads: None,
            limits: absence::Limits::default(),
        }
    }
}

/// What stands behind a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Evidence {
    /// A certificate, accepted by the checker: index into [`Analysis::proofs`].
    Certificate(usize),
    /// Decided in exact arithmetic, named here; running the analysis again is the check.
    Exact(&'static str),
    /// Computed in doubles: no proof.
    Measured(&'static str),
}

/// A problem and a certificate for it that the checker has accepted.
#[derive(Debug, Clone)]
pub struct Proof {
    /// Name of the pair, for files.
    pub name: String,
    /// The problem.
    pub problem: Problem,
    /// The certificate.
    pub certificate: Certificate,
}

/// Does divergence of the form (8) exist? Never "stable": flutter and stick-slip growth lie outside
/// (8).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// A solution of MCEIP-lambda2 is proved.
    Present,
    /// It is proved that there is none.
    Absent,
    /// Neither: what is left open is listed.
    Undecided,
}

impl Verdict {
    /// The word used in files.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Present => "present",
            Verdict::Absent => "absent",
            Verdict::Undecided => "undecided",
        }
    }
}

/// Divergence at the given mu.
#[derive(Debug, Clone)]
pub struct Divergence {
    /// The verdict.
    pub verdict: Verdict,
    /// Every proved solution, with growth rate and mode, by ascending lambda^2.
    pub modes: Vec<Mode>,
    /// Families beside them: cones, and supports with a range of lambda^2. The certificate
    /// describes them.
    pub families: usize,
    /// Parts of [0, infinity) x supports in which nothing is proved.
    pub open: Vec<OpenRegion>,
    /// The certificate.
    pub evidence: Evidence,
}

/// The static threshold: the smallest MCEIP-mu value (lambda = 0).
#[derive(Debug, Clone)]
pub struct StaticThreshold {
    /// All values found in [0, infinity), ascending.
    pub values: Vec<Interval>,
    /// Parts of [0, infinity) in which nothing is proved.
    pub open: Vec<OpenRegion>,
    /// The certificate.
    pub evidence: Evidence,
}

impl StaticThreshold {
    /// Single values of families count as values; of a family over an interval the ends alone are
    /// known, so that it is left open.
    fn of(found: &Completed) -> StaticThreshold {
        let (points, intervals): (Vec<_>, Vec<_>) =
            found.cover.families.iter().partition(|f| f.is_point);
        let mut values: Vec<Interval> = found
            .cover
            .solutions
            .iter()
            .map(|s| s.value.clone())
            .collect();
        values.extend(points.into_iter().map(|f| f.from.clone()));
        values.sort_by(|p, q| p.lo().cmp(q.lo()));
        let region = |f: &SolutionFamily| OpenRegion {
            min: f.from.lo().clone(),
            max: f.to.as_ref().map(|end| end.hi().clone()),
            moving: f.support.clone(),
            undecided: Vec::new(),
        };
        let open = found
            .cover
            .open
            .iter()
            .cloned()
            .chain(intervals.into_iter().map(region))
            .collect();
        StaticThreshold {
            values,
            open,
            evidence: Evidence::Certificate(1),
        }
    }

    /// The smallest value, if it is proved that there is no smaller one.
    pub fn smallest(&self) -> Option<&Interval> {
        self.values
            .first()
            .filter(|v| self.open.iter().all(|o| o.min > *v.hi()))
    }
}

/// Everything that is said about a system at one mu.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// Name of the problem.
    pub name: Option<String>,
    /// Digest of the MCEIP-lambda2 problem that was analysed.
    pub problem_sha256: String,
    /// mu.
    pub friction: Rational,
    /// Numbers of degrees of freedom, free degrees of freedom, slip particles, stick particles.
    pub sizes: [usize; 4],
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
    /// Complex eigenvalues of the all-slip pencil at mu.
    pub flutter: Option<Flutter>,
    /// The certificates.
    pub proofs: Vec<Proof>,
    /// Was the work interrupted?
    pub interrupted: bool,
}

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
    let stick = count(|p| p.state == crate::model::ContactState::Stick);
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

/// The system and how to search it.
struct Model<'a> {
    system: &'a System,
    options: &'a Options,
    watch: Watch<'a>,
}

impl Model<'_> {
    /// MCEIP-lambda2 at a mu, or MCEIP-mu, for the contact states of the system.
    fn problem(&self, friction: Option<&Rational>) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().cloned();
        self.with(self.system.stiffness().clone(), mass, friction)
    }

    /// MCEIP-mu at a fixed lambda^2: that of K + lambda^2 M.
    fn at_lambda2(&self, lambda2: &Rational) -> Result<Problem, AnalysisError> {
        let mass = self.system.mass().ok_or(AnalysisError::NoMass)?;
        self.with(
            self.system.stiffness().add_scaled(lambda2, mass),
            None,
            None,
        )
    }

    fn with(
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

    fn complete(&self, problem: &Problem) -> Result<Completed, AnalysisError> {
        let options = complete::Options {
            threads: self.options.threads,
            ..complete::Options::default()
        };
        Ok(complete(problem, &options, &self.watch)?)
    }

    fn stopped(&self) -> bool {
        self.watch.is_cancelled()
    }
}

fn verdict(found: &Completed) -> Verdict {
    match (
        found.cover.solutions.is_empty() && found.cover.families.is_empty(),
        found.is_complete(),
    ) {
        (false, _) => Verdict::Present,
        (true, true) => Verdict::Absent,
        (true, false) => Verdict::Undecided,
    }
}

fn divergence(system: &System, family: &MuFamily, found: &Completed) -> Divergence {
    let modes = found
        .solutions()
        .map(|(s, x)| Mode::of(system, family, s, x))
        .collect();
    let families = found.cover.families.len();
    Divergence {
        verdict: verdict(found),
        modes,
        families,
        open: found.cover.open.clone(),
        evidence: Evidence::Certificate(0),
    }
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
