//! A run: its samples, what kind of motion it is, and the amplitudes for which it is (1)-(3).
//!
//! The class of a run is read off its samples by these definitions; each is about what was computed
//! in the time of the run, and none is a proof. The energy norm is the root of twice the energy,
//! the elastic norm that of twice the elastic energy of a displacement.
//!
//! * *no growth*: the energy norm of the last quarter is less than twice that of the second one;
//! * *constant direction*: it grows, without decreasing in the last quarter, and there the
//!   displacements divided by their elastic norms differ by at most `TURN`;
//! * *stick-slip*: it grows, the direction turns, and the set of slipping particles changes in the
//!   last quarter; *flutter*: the same, and that set stays.
//!
//! Flutter does not last: while the set of slipping particles stays the motion is linear, and in a
//! linear motion that oscillates and grows a slip velocity changes its sign, which (2) does not
//! admit. What begins as flutter goes on as one of the other classes.

use super::equations::{Equations, MotionError, WatchedParticle, WatchedSlip};
use super::step::{Instant, Stepper};
use super::tolerance::{SAME_RATE, TURN};
use super::uniqueness::StepSolutions;
use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How long, and in how many steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Time to cover, > 0.
    pub duration: f64,
    /// Steps, >= 1.
    pub steps: usize,
}

/// Samples kept of a run, at most; at least one for each step of a shorter run.
const SAMPLES: usize = 200;

impl Plan {
    /// Length of a step.
    ///
    /// # Errors
    /// [`MotionError::Plan`].
    pub fn step(&self) -> Result<f64, MotionError> {
        let step = self.duration / self.steps as f64;
        let is_plan = self.duration > 0.0 && step > 0.0 && step.is_finite();
        if is_plan {
            return Ok(step);
        }

        Err(MotionError::Plan {
            duration: self.duration,
            steps: self.steps,
        })
    }

    /// The same time in twice as many steps.
    pub(crate) fn halved(self) -> Plan {
        Plan {
            steps: 2 * self.steps,
            ..self
        }
    }

    /// Steps from one sample to the next, for this plan and for those that halve its step.
    pub(crate) fn stride(&self) -> usize {
        self.steps.div_ceil(SAMPLES)
    }
}

/// A state of a run with its energy norm.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectorySample {
    /// The state.
    pub at: Instant,
    /// Energy norm.
    pub norm: f64,
}

/// What kind of motion a run is, by the definitions of this file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MotionClass {
    /// No growth in the time of the run. This is not stability.
    NoGrowth,
    /// Growth along a constant direction, as (8) has it.
    ConstantDirection,
    /// Growth that turns while the set of slipping particles stays.
    Flutter,
    /// Growth in which particles stick and slip by turns.
    StickSlip,
}

impl MotionClass {
    /// The word used in reports.
    pub fn word(self) -> &'static str {
        match self {
            MotionClass::NoGrowth => "no growth seen",
            MotionClass::ConstantDirection => "growth along a constant direction",
            MotionClass::Flutter => "flutter",
            MotionClass::StickSlip => "stick-slip growth",
        }
    }
}

/// What ends the range in which the law of the crate is (1) and (2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// r_N of a particle reaches 0.
    LiftsOff,
    /// The reaction of an s particle reaches the other side of its cone.
    OtherSide,
    /// The reaction of a d particle reaches its cone.
    StickEnds,
}

impl Limit {
    /// What the particle does there.
    pub fn word(self) -> &'static str {
        match self {
            Limit::LiftsOff => "lifts off",
            Limit::OtherSide => "reaches the other side of its friction cone",
            Limit::StickEnds => "reaches its friction cone",
        }
    }
}

/// The largest factor of a start for which (1)-(3) hold in the middle of every step of its run. A
/// motion that still grows leaves them within the half step after its last middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AmplitudeRange {
    /// The factor.
    pub amplitude: f64,
    /// The particle that bounds it.
    pub particle: usize,
    /// How.
    pub limit: Limit,
    /// When.
    pub time: f64,
}

/// A run.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// States from the start on, at equal distances in time.
    pub samples: Vec<TrajectorySample>,
    /// Steps after which another set of particles slips.
    pub changes: usize,
    /// What kind of motion it is.
    pub class: MotionClass,
    /// Mean growth rate of the energy norm over the last quarter.
    pub rate: f64,
    /// Where the law ends; `None` if no reaction at equilibrium is known or none bounds it.
    pub range: Option<AmplitudeRange>,
}

/// Energy norm, relative to the start, at which a run ends early: the motion is homogeneous.
const LARGE: f64 = 1e100;

/// Integrates from a start.
///
/// # Errors
/// [`MotionError`]: a plan that is none, steps that are too long or have no solution, numbers
/// beyond doubles.
pub fn run(equations: &Equations, start: Instant, plan: Plan) -> Result<Trajectory, MotionError> {
    run_every(equations, start, plan, plan.stride())
}

/// The same with a sample every `stride` steps.
pub(crate) fn run_every(
    equations: &Equations,
    start: Instant,
    plan: Plan,
    stride: usize,
) -> Result<Trajectory, MotionError> {
    let step = plan.step()?;
    let stepper = Stepper::new(equations, step)?;
    if let StepSolutions::Several { .. } = stepper.solutions() {
        return Err(MotionError::LongStep { step });
    }

    let first = TrajectorySample::of(equations, start);
    let end_norm = LARGE * first.norm;

    let mut at = first.at.clone();
    let mut samples = vec![first];
    let mut changes = 0;
    let mut range = None;
    for k in 1..=plan.steps {
        let (next, _) = stepper.advance(&at)?;
        for watched in &equations.watched {
            narrow(&mut range, watched, &at, &next);
        }
        changes += usize::from(k > 1 && next.slips != at.slips);
        at = next;

        if k % stride == 0 {
            let sample = TrajectorySample::of(equations, at.clone());
            let norm = sample.norm;
            samples.push(sample);
            if !norm.is_finite() {
                return Err(MotionError::Doubles {
                    what: "a displacement that is not finite",
                });
            }
            if norm > end_norm {
                break;
            }
        }
    }

    Ok(Trajectory {
        class: class(equations, &samples),
        rate: rate(last_quarter(&samples)),
        samples,
        changes,
        range,
    })
}

/// The motion after an impulse, in steps of a plan and in half of them.
#[derive(Debug, Clone, PartialEq)]
pub struct AfterImpulse {
    /// In steps of h.
    pub coarse: Trajectory,
    /// In steps of h/2.
    pub fine: Trajectory,
}

impl AfterImpulse {
    /// Integrates from [`impulse`] with this seed.
    ///
    /// # Errors
    /// [`MotionError`]: as [`run`].
    pub fn new(equations: &Equations, seed: u64, plan: Plan) -> Result<AfterImpulse, MotionError> {
        let start = impulse(equations, seed);
        Ok(AfterImpulse {
            coarse: run(equations, start.clone(), plan)?,
            fine: run(equations, start, plan.halved())?,
        })
    }

    /// Do both runs say the same: one class and, where they grow, one growth rate up to 5 %?
    pub fn is_resolved(&self) -> bool {
        let is_same_class = self.coarse.class == self.fine.class;
        let grows = self.fine.class != MotionClass::NoGrowth;
        let difference = (self.coarse.rate - self.fine.rate).abs();
        is_same_class && (!grows || difference <= SAME_RATE * self.fine.rate)
    }
}

/// The start of a run: the equilibrium, hit by a random impulse.
///
/// Free coordinates get velocities in [-1, 1], slip coordinates in [0, 1], as (2) admits.
pub fn impulse(equations: &Equations, seed: u64) -> Instant {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let order = equations.order();
    let mut velocity = DVector::zeros(order);
    for c in 0..order {
        let least = if c < equations.free() { -1.0 } else { 0.0 };
        velocity[c] = rng.random_range(least..=1.0);
    }

    Instant::start(equations, DVector::zeros(order), velocity)
}

impl TrajectorySample {
    fn of(equations: &Equations, at: Instant) -> TrajectorySample {
        TrajectorySample {
            norm: equations.energy_norm(&at.displacement, &at.velocity),
            at,
        }
    }
}

/// The class of a run by the definitions of this file.
fn class(equations: &Equations, samples: &[TrajectorySample]) -> MotionClass {
    let n = samples.len();
    let second = &samples[n / 4..n / 2 + 1];
    let last = last_quarter(samples);

    let grows = largest_norm(last) >= 2.0 * largest_norm(second);
    if !grows {
        return MotionClass::NoGrowth;
    }

    let is_rising = last.windows(2).all(|pair| pair[1].norm >= pair[0].norm);
    if is_rising && turn(equations, last) <= TURN {
        return MotionClass::ConstantDirection;
    }

    let slips = &last[0].at.slips;
    if last.iter().all(|sample| sample.at.slips == *slips) {
        MotionClass::Flutter
    } else {
        MotionClass::StickSlip
    }
}

fn last_quarter(samples: &[TrajectorySample]) -> &[TrajectorySample] {
    let n = samples.len();
    &samples[n - n.div_ceil(4)..]
}

fn largest_norm(samples: &[TrajectorySample]) -> f64 {
    samples.iter().map(|sample| sample.norm).fold(0.0, f64::max)
}

/// The largest distance of unit displacements from the last one.
fn turn(equations: &Equations, samples: &[TrajectorySample]) -> f64 {
    let Some(end) = samples.last().map(|sample| unit(equations, sample)) else {
        return 0.0;
    };

    let mut turn: f64 = 0.0;
    for sample in samples {
        let difference = unit(equations, sample) - &end;
        turn = turn.max(equations.elastic_norm(&difference));
    }
    turn
}

/// The displacement divided by its elastic norm.
fn unit(equations: &Equations, sample: &TrajectorySample) -> DVector<f64> {
    let norm = equations.elastic_norm(&sample.at.displacement);
    &sample.at.displacement / norm
}

/// The mean growth rate of the norm over the samples.
fn rate(samples: &[TrajectorySample]) -> f64 {
    let (Some(from), Some(to)) = (samples.first(), samples.last()) else {
        return 0.0;
    };
    (to.norm / from.norm).ln() / (to.at.time - from.at.time)
}

/// Narrows the range by the reactions of one particle in the middle of one step.
///
/// A condition is g^0 + a g <= 0 with g^0 < 0 at equilibrium; it holds up to a = -g^0 / g.
fn narrow(
    range: &mut Option<AmplitudeRange>,
    watched: &WatchedParticle,
    from: &Instant,
    to: &Instant,
) {
    let h = to.time - from.time;
    let displacement = (&from.displacement + &to.displacement) / 2.0;
    let acceleration = (&to.velocity - &from.velocity) / h;

    let tangential = &watched.tangential_rate;
    let normal = &watched.normal_rate;
    let rho_t = (&tangential.mass * &acceleration + &tangential.stiffness * &displacement)[0];
    let rho_n = (&normal.mass * &acceleration + &normal.stiffness * &displacement)[0];
    let r_t = watched.tangential;
    let r_n = watched.normal;
    let mu = watched.friction;

    // On the side S of the cone that a slipping particle keeps to, r_N <= 0 is the only condition.
    let conditions = match watched.slip {
        Some(slip) if to.slips[slip.number] => vec![(Limit::LiftsOff, r_n, rho_n)],
        Some(WatchedSlip { sign, .. }) => {
            let at_rest = mu * r_n - sign * r_t;
            let change = mu * rho_n - sign * rho_t;
            vec![(Limit::OtherSide, at_rest, change)]
        }
        None => vec![
            (Limit::StickEnds, mu * r_n + r_t, mu * rho_n + rho_t),
            (Limit::StickEnds, mu * r_n - r_t, mu * rho_n - rho_t),
        ],
    };

    for (limit, at_rest, change) in conditions {
        if change <= 0.0 {
            continue;
        }

        let amplitude = -at_rest / change;
        if range.is_none_or(|range| amplitude < range.amplitude) {
            *range = Some(AmplitudeRange {
                amplitude,
                particle: watched.particle,
                limit,
                time: from.time + h / 2.0,
            });
        }
    }
}
