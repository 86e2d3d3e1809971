//! A run along a mode, held against u^0 + alpha(t) v with alpha'' = lambda^2 alpha.
//!
//! The start is z = v at rest, so that alpha = cosh(lambda t); for lambda = 0 it is z = v with the
//! velocity v / T, so that alpha = 1 + t / T over the time T. The scheme keeps the direction v, and
//! its alpha is that of the trapezoidal rule: wrong by lambda^3 h^2 t / 12, relatively, to leading
//! order.
//!
//! What a run says of its own error comes from halving the step: for errors C h^2 two runs differ
//! by 3 C h^2 / 4, so the finer one is wrong by a third of their difference. To this are added the
//! rounding of every step, as the forces that cancel enlarge it, and what a motion beside v may
//! change of alpha. The agreement is judged by that stated error, and not at all where it is large.

use super::equations::{Equations, MotionError};
use super::step::{Instant, Stepper};
use super::tolerance::{BESIDE, OF_BESIDE, ROUNDING, UNRESOLVED};
use super::trajectory::{Plan, Trajectory, run_every};
use nalgebra::DVector;

/// A solution of (9): v and lambda^2.
#[derive(Debug, Clone, PartialEq)]
pub struct GrowthMode {
    /// lambda^2 >= 0.
    pub lambda2: f64,
    /// v in the coordinates of [`Equations`].
    pub displacement: DVector<f64>,
}

/// A run along a mode in steps of h and of h/2, beside what (8) predicts.
#[derive(Debug, Clone, PartialEq)]
pub struct Growth {
    /// The length h of the longer steps.
    pub step: f64,
    /// Samples, as long as the motion is along v.
    pub points: Vec<GrowthPoint>,
    /// When another motion has taken over.
    pub overtaken: Option<f64>,
    /// Is the first step along v, up to rounding? Of what is no mode it is not.
    pub begins_along_v: bool,
    /// Largest relative error of alpha in steps of h.
    pub coarse_error: f64,
    /// Largest relative error of alpha in steps of h/2.
    pub error: f64,
    /// What that error should be by the two runs, the rounding and the motion beside v.
    pub stated_error: f64,
    /// What rounding may add to it.
    pub rounding: f64,
    /// The run in steps of h/2.
    pub trajectory: Trajectory,
}

/// alpha at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrowthPoint {
    /// Time since the start.
    pub time: f64,
    /// By (8).
    pub predicted: f64,
    /// In steps of h.
    pub coarse: f64,
    /// In steps of h/2.
    pub fine: f64,
}

/// The stated error is the leading term; this is for the next ones.
const NEXT_TERMS: f64 = 1.5;

/// alpha up to which a comparison says nothing: growth by a tenth.
const COMPARED_FROM: f64 = 1.1;

/// Does the motion grow as (8) predicts, within the error it states?
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GrowthAgreement {
    /// It does, as long as it is along v.
    Agrees,
    /// It does not, or leaves v at once.
    Disagrees,
    /// The run ends, or a motion set off by rounding takes over, before alpha has grown by a tenth.
    TooShort,
    /// The steps are too long for the run: the stated error is large, or alpha leaves the doubles.
    NotResolved,
}

impl Growth {
    /// The motion held against its prediction.
    pub fn agreement(&self) -> GrowthAgreement {
        let compared_to = self.points.last().map_or(0.0, |point| point.predicted);
        let has_grown = compared_to >= COMPARED_FROM;
        let is_resolved = self.stated_error <= UNRESOLVED; // not so if it is not a number
        let is_accurate = self.error <= NEXT_TERMS * self.stated_error;

        if !is_resolved {
            GrowthAgreement::NotResolved
        } else if is_accurate && has_grown {
            GrowthAgreement::Agrees
        } else if is_accurate && (self.overtaken.is_none() || self.begins_along_v) {
            GrowthAgreement::TooShort
        } else {
            GrowthAgreement::Disagrees
        }
    }

    /// The order of the error in h: 2 up to higher terms, where rounding plays no part.
    ///
    /// `None` where it plays the larger part, as for lambda = 0, where the scheme is exact.
    pub fn order(&self) -> Option<f64> {
        let is_rounding = self.error <= 2.0 * self.rounding;
        (!is_rounding).then(|| (self.coarse_error / self.error).log2())
    }
}

impl GrowthMode {
    /// lambda.
    pub fn rate(&self) -> f64 {
        self.lambda2.max(0.0).sqrt()
    }

    /// The time in which alpha grows to cosh(4) = 27; for lambda = 0 the given unit of time.
    pub fn usual_duration(&self, unit: f64) -> f64 {
        let rate = self.rate();
        if rate > 0.0 { 4.0 / rate } else { unit }
    }

    /// alpha(t) in a run of length `duration`.
    fn predicted(&self, time: f64, duration: f64) -> f64 {
        let rate = self.rate();
        if rate > 0.0 {
            (rate * time).cosh()
        } else {
            1.0 + time / duration
        }
    }

    fn start(&self, equations: &Equations, duration: f64) -> Instant {
        let velocity = if self.rate() > 0.0 {
            DVector::zeros(self.displacement.len())
        } else {
            &self.displacement / duration
        };
        Instant::start(equations, self.displacement.clone(), velocity)
    }

    /// Rounding of alpha, relative: that of each step, for forces K v that cancel down to
    /// lambda^2 M v.
    fn rounding(&self, equations: &Equations, Plan { duration, steps }: Plan) -> f64 {
        let sizes = self.displacement.abs();
        let forces = (equations.stiffness.abs() * sizes).amax();
        let square = self.lambda2.max(1.0 / (duration * duration));
        let inertia = square * (&equations.mass * &self.displacement).amax();
        (ROUNDING + f64::EPSILON * steps as f64) * (1.0 + forces / inertia)
    }
}

/// Runs along a mode in steps of the plan and in half of them.
///
/// # Errors
/// [`MotionError`]: as [`super::run`].
pub fn along_mode(
    equations: &Equations,
    mode: &GrowthMode,
    plan: Plan,
) -> Result<Growth, MotionError> {
    let stride = plan.stride();
    let start = mode.start(equations, plan.duration);
    let coarse = run_every(equations, start.clone(), plan, stride)?;
    let fine = run_every(equations, start.clone(), plan.halved(), 2 * stride)?;

    let rounding = mode.rounding(equations, plan.halved());
    let (first, _) = Stepper::new(equations, plan.step()?)?.advance(&start)?;
    let begins_along_v = Along::of(equations, mode, &first).beside <= rounding;

    let mut points = Vec::new();
    let mut coarse_error: f64 = 0.0;
    let mut error: f64 = 0.0;
    // A step that is longer than 1 / lambda follows no growth.
    let is_long = plan.step()? * mode.rate() > 1.0;
    let mut difference: f64 = if is_long { f64::INFINITY } else { 0.0 };
    let mut beside: f64 = 0.0;
    let mut overtaken = None;
    for (coarse, fine) in coarse.samples.iter().zip(&fine.samples) {
        let along_coarse = Along::of(equations, mode, &coarse.at);
        let along_fine = Along::of(equations, mode, &fine.at);
        if along_fine.beside > BESIDE {
            overtaken = Some(fine.at.time);
            break;
        }

        let point = GrowthPoint {
            time: fine.at.time,
            predicted: mode.predicted(fine.at.time, plan.duration),
            coarse: along_coarse.alpha,
            fine: along_fine.alpha,
        };

        let all = [point.predicted, point.coarse, point.fine];
        if !all.iter().all(|alpha| alpha.is_finite()) {
            difference = f64::INFINITY;
            break;
        }

        beside = beside.max(along_fine.beside);
        let scale = point.predicted;
        coarse_error = coarse_error.max((point.coarse - point.predicted).abs() / scale);
        error = error.max((point.fine - point.predicted).abs() / scale);
        difference = difference.max((point.coarse - point.fine).abs() / scale);
        points.push(point);
    }

    Ok(Growth {
        step: plan.step()?,
        points,
        overtaken,
        begins_along_v,
        coarse_error,
        error,
        stated_error: difference / 3.0 + rounding + OF_BESIDE * beside,
        rounding,
        trajectory: fine,
    })
}

/// A displacement split along v and beside it, orthogonally in the elastic product.
struct Along {
    alpha: f64,
    /// Norm of the part beside v, relative to the whole.
    beside: f64,
}

impl Along {
    fn of(equations: &Equations, mode: &GrowthMode, at: &Instant) -> Along {
        let v = &mode.displacement;
        let forces = &equations.energy_stiffness * v;
        let alpha = at.displacement.dot(&forces) / v.dot(&forces);

        let rest = &at.displacement - v * alpha;
        let whole = equations.elastic_norm(&at.displacement);
        Along {
            alpha,
            beside: equations.elastic_norm(&rest) / whole,
        }
    }
}
