//! What `mceip simulate` says: sentences, `mceip-motion/1`, and the picture.

use crate::picture::{MotionSeries, Picture, Spread, motion_picture};
use mceip_engine::report::{Table, counted, six_digits};
use mceip_exact::{Interval, enclosing_decimals};
use mceip_motion::{
    AfterImpulse, AmplitudeRange, Growth, GrowthAgreement, GrowthPoint, MotionClass, StepSolutions,
    Trajectory,
};
use serde_json::{Value, json};

/// All that was proved and integrated.
pub(super) struct Simulation {
    pub(super) name: Option<String>,
    /// Of the MCEIP-lambda2 problem at this friction.
    pub(super) problem_sha256: String,
    pub(super) solutions_of_a_step: StepSolutions,
    /// The particle of each slip coordinate.
    pub(super) slip_particles: Vec<usize>,
    /// Is it proved that there are no other solutions?
    pub(super) is_complete: bool,
    /// Continua of solutions, which are not followed.
    pub(super) families: usize,
    /// Certified solutions whose displacement is not known to doubles, which are not followed.
    pub(super) unknown: usize,
    pub(super) modes: Vec<SimulatedMode>,
    pub(super) impulses: Vec<SimulatedImpulse>,
    pub(super) is_interrupted: bool,
}

/// A certified mode and the run along it.
pub(super) struct SimulatedMode {
    /// Encloses lambda^2.
    pub(super) lambda2: Interval,
    /// lambda.
    pub(super) rate: f64,
    /// Complementarity variables with x_i > 0.
    pub(super) support: Vec<usize>,
    /// The particles that slip.
    pub(super) slipping: Vec<usize>,
    pub(super) growth: Growth,
}

/// The motion after an impulse.
pub(super) struct SimulatedImpulse {
    pub(super) seed: u64,
    pub(super) motion: AfterImpulse,
}

/// Rows of the table of alpha.
const ROWS: usize = 8;

impl Simulation {
    /// Has the checker accepted that no solution exists?
    pub(super) fn is_proved_absent(&self) -> bool {
        let has_none = self.modes.is_empty() && self.families == 0 && self.unknown == 0;
        self.is_complete && has_none
    }
}

/// The answers for people.
pub(super) fn text(simulation: &Simulation) -> String {
    let mut out = String::new();
    if let Some(name) = &simulation.name {
        out += &format!("{name}\n");
    }

    out += &step_sentence(simulation);
    if simulation.solutions_of_a_step != StepSolutions::One {
        return out;
    }

    for (k, mode) in simulation.modes.iter().enumerate() {
        out += &mode_text(k + 1, mode);
    }
    if simulation.is_proved_absent() {
        out += "No divergence instability of the form (8): proved, a certificate was accepted.\n";
    } else if !simulation.is_complete {
        out += "Whether there are other modes is open: the search for them is not complete.\n";
    }
    if simulation.families > 0 {
        let families = counted(simulation.families, "family");
        out += &format!("Beside them, and not followed: {families} of modes.\n");
    }

    if simulation.unknown > 0 {
        out += &format!(
            "UNDECIDED: certified modes that are not followed, for their displacements are not \
             known to doubles: {}.\n",
            simulation.unknown
        );
    }

    for impulse in &simulation.impulses {
        out += &impulse_text(impulse);
    }
    if simulation.is_interrupted {
        out += "INTERRUPTED: what was not integrated is not said\n";
    }

    out + "An integration proves nothing, and absence of (8) is not stability.\n"
}

/// What is known of the problem of one step.
fn step_sentence(simulation: &Simulation) -> String {
    match &simulation.solutions_of_a_step {
        StepSolutions::Several { minor } => {
            let particles = minor_particles(simulation, minor);
            format!(
                "NOT INTEGRATED: M* has a principal minor that is not positive (slip particles \
                 {particles:?}), so a step may have several solutions or none\n"
            )
        }
        StepSolutions::One => "Every step has one solution (principal minors of M*).\n".into(),
        _ => "NOT INTEGRATED: not decided whether a step has one solution\n".into(),
    }
}

/// The particles of a principal minor.
fn minor_particles(simulation: &Simulation, minor: &[usize]) -> Vec<usize> {
    let particles = &simulation.slip_particles;
    minor.iter().map(|&slip| particles[slip]).collect()
}

fn mode_text(number: usize, mode: &SimulatedMode) -> String {
    let growth = &mode.growth;
    let (lo, hi) = enclosing_decimals(&mode.lambda2, 12);
    let slipping = &mode.slipping;
    let rate = six_digits(mode.rate);
    let mut out = format!(
        "Mode {number} (certified): lambda2 in [{lo}, {hi}], lambda = {rate}, particles \
         {slipping:?} slip\n"
    );

    let mut table = Table::new(&["  time", "alpha, predicted", "steps h", "steps h/2"]);
    let every = growth.points.len().div_ceil(ROWS).max(1);
    let duration = growth.points.last().map_or(0.0, |point| point.time);
    for point in growth.points.iter().step_by(every) {
        table.row(cells(point, duration));
    }
    out += &table.to_string();

    let verdict = agreement_word(growth);
    let order = match growth.order() {
        Some(order) => format!("order {order:.3} in h"),
        None => "at the level of rounding".into(),
    };
    out += &format!(
        "  {verdict}: largest relative error {:.2e}, stated {:.2e}, {order}\n",
        growth.error, growth.stated_error
    );
    if let Some(time) = growth.overtaken {
        let time = time_text(time, duration);
        out += &format!("  from {time} on a motion that grows faster has taken over\n");
    }

    out + &range_text(growth.trajectory.range.as_ref(), duration)
}

/// The verdict of a comparison.
fn agreement_word(growth: &Growth) -> &'static str {
    match growth.agreement() {
        GrowthAgreement::Agrees => "AGREES",
        GrowthAgreement::Disagrees => "DISAGREES",
        GrowthAgreement::TooShort => "TOO SHORT",
        GrowthAgreement::NotResolved => "NOT RESOLVED",
    }
}

/// Durations in whose unit six decimals tell the rows of a table apart.
const SIX_DECIMALS_FROM: f64 = 0.1;

/// A time within a run of this duration: six decimals where they suffice for the run.
fn time_text(time: f64, duration: f64) -> String {
    if duration >= SIX_DECIMALS_FROM {
        format!("{time:.6}")
    } else {
        format!("{time:.6e}")
    }
}

fn cells(point: &GrowthPoint, duration: f64) -> Vec<String> {
    vec![
        format!("  {}", time_text(point.time, duration)),
        format!("{:.9}", point.predicted),
        format!("{:.9}", point.coarse),
        format!("{:.9}", point.fine),
    ]
}

fn range_text(range: Option<&AmplitudeRange>, duration: f64) -> String {
    let Some(range) = range else {
        return String::new();
    };

    format!(
        "  with the file's reactions: (1)-(3) in the middle of every step for amplitudes up to \
         {:.3e}; beyond that particle {} {} at {}\n",
        range.amplitude,
        range.particle,
        range.limit.word(),
        time_text(range.time, duration)
    )
}

fn impulse_text(impulse: &SimulatedImpulse) -> String {
    let SimulatedImpulse { seed, motion } = impulse;
    let class = class_text(&motion.fine);
    let changes = counted(motion.fine.changes, "time");
    let mut out =
        format!("Impulse {seed}: {class}; the set of slipping particles changes {changes}\n");
    if !motion.is_resolved() {
        let coarse = class_text(&motion.coarse);
        out += &format!("  NOT RESOLVED: in steps twice as long {coarse}; take more --steps\n");
    }

    out
}

fn class_text(trajectory: &Trajectory) -> String {
    let class = trajectory.class.word();
    match trajectory.class {
        MotionClass::NoGrowth => class.into(),
        _ => format!("{class}, mean rate {}", six_digits(trajectory.rate)),
    }
}

/// The same as `mceip-motion/1`.
pub(super) fn json(simulation: &Simulation) -> Value {
    let modes: Vec<Value> = simulation.modes.iter().map(mode_json).collect();
    let impulses: Vec<Value> = simulation.impulses.iter().map(impulse_json).collect();
    let (solutions, minor) = match &simulation.solutions_of_a_step {
        StepSolutions::One => ("one", None),
        StepSolutions::Several { minor } => ("several", Some(minor_particles(simulation, minor))),
        _ => ("undecided", None),
    };

    json!({
        "format": "mceip-motion/1",
        "name": simulation.name,
        "problem_sha256": simulation.problem_sha256,
        "solutions_of_a_step": solutions,
        "minor": minor,
        "complete": simulation.is_complete,
        "families": simulation.families,
        "unknown": simulation.unknown,
        "modes": modes,
        "impulses": impulses,
        "interrupted": simulation.is_interrupted,
    })
}

fn mode_json(mode: &SimulatedMode) -> Value {
    let growth = &mode.growth;
    let (lo, hi) = enclosing_decimals(&mode.lambda2, 17);
    let mut points = Vec::new();
    for point in &growth.points {
        points.push(json!([
            point.time,
            point.predicted,
            point.coarse,
            point.fine
        ]));
    }

    json!({
        "lambda2": [lo, hi],
        "growth_rate": mode.rate,
        "support": mode.support,
        "step": growth.step,
        "points": points,
        "error": growth.error,
        "stated_error": growth.stated_error,
        "order": growth.order(),
        "overtaken": growth.overtaken,
        "agreement": agreement_word(growth),
        "range": growth.trajectory.range.as_ref().map(range_json),
    })
}

fn range_json(range: &AmplitudeRange) -> Value {
    json!({
        "amplitude": range.amplitude,
        "particle": range.particle,
        "limit": range.limit.word(),
        "time": range.time,
    })
}

fn impulse_json(impulse: &SimulatedImpulse) -> Value {
    let fine = &impulse.motion.fine;
    let mut points = Vec::new();
    for sample in &fine.samples {
        points.push(json!([sample.at.time, sample.norm]));
    }

    json!({
        "seed": impulse.seed,
        "class": fine.class.word(),
        "growth_rate": fine.rate,
        "changes": fine.changes,
        "resolved": impulse.motion.is_resolved(),
        "points": points,
    })
}

/// alpha of the first mode beside its prediction, or the norms after the impulses.
pub(super) fn picture(simulation: &Simulation) -> Picture {
    let name = simulation.name.as_deref().unwrap_or("the equilibrium");
    match simulation.modes.first() {
        Some(mode) => {
            let title = format!("Motion along a certified mode: {name}");
            let series = mode_series(mode);
            motion_picture(&title, "displacement / v", Spread::Linear, &series)
        }
        None => {
            let title = format!("Motion after an impulse: {name}");
            let series = impulse_series(simulation);
            let quantity = "energy norm / that of the impulse";
            motion_picture(&title, quantity, Spread::Log, &series)
        }
    }
}

fn mode_series(mode: &SimulatedMode) -> [MotionSeries; 2] {
    let points = &mode.growth.points;
    let step = mode.growth.step / 2.0;
    [
        MotionSeries {
            name: format!("predicted by (8), lambda = {}", six_digits(mode.rate)),
            points: points.iter().map(|p| (p.time, p.predicted)).collect(),
            is_dotted: false,
        },
        MotionSeries {
            name: format!("integrated from (1)-(3) in steps of {step:.3e}"),
            points: points.iter().map(|p| (p.time, p.fine)).collect(),
            is_dotted: true,
        },
    ]
}

fn impulse_series(simulation: &Simulation) -> Vec<MotionSeries> {
    let mut series = Vec::new();
    for impulse in &simulation.impulses {
        let fine = &impulse.motion.fine;
        let samples = &fine.samples;
        let at_start = samples[0].norm;
        let points = samples.iter().map(|s| (s.at.time, s.norm / at_start));
        series.push(MotionSeries {
            name: format!("impulse {}: {}", impulse.seed, fine.class.word()),
            points: points.collect(),
            is_dotted: false,
        });
    }

    series
}
