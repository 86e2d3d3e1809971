//! `mceip simulate`: the motion about the equilibrium in time, beside what certificates say of it.
//!
//! All modes of the system are looked for and proved first. Along each of them the equations
//! (1)-(4) are integrated and compared with u^0 + alpha(t) v; then the equilibrium is hit by random
//! impulses, and the motions are classified. What is integrated is never called proved.

mod report;

use super::common::{
    CliError, exit, friction_of, load, positive, print_answer, require_count, require_threads,
};
use super::job::Job;
use super::output::Output;
use crate::{Solution, SolutionSet};
use mceip_exact::to_f64;
use mceip_model::{Body, ContactState, Problem, System, Unknown, Window};
use mceip_motion::{
    AfterImpulse, Equations, GrowthAgreement, GrowthMode, MotionClass, Plan, StepSolutions,
    Stepper, along_mode,
};
use report::{SimulatedImpulse, SimulatedMode, Simulation};
use std::path::PathBuf;

/// Arguments of `simulate`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1) of a mechanical system with mass.
    file: PathBuf,
    /// Coefficient of friction instead of the file's (reactions in the file are then not used).
    #[arg(long, value_name = "MU", alias = "mu", allow_hyphen_values = true)]
    friction: Option<String>,
    /// Steps of a run; each is repeated with twice as many to state its error.
    #[arg(long, default_value_t = 400)]
    steps: usize,
    /// Time of a run along a mode (default: until alpha has grown to 27).
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    duration: Option<String>,
    /// Random impulses on the equilibrium; each motion lasts 20 of the longest periods.
    #[arg(long, value_name = "N", default_value_t = 2)]
    impulses: usize,
    /// Draw alpha(t) along the first mode beside its prediction; without a mode the norms after
    /// the impulses.
    #[arg(long, value_name = "OUT")]
    picture: Option<PathBuf>,
    /// Threads of the search for modes (default: all cores).
    #[arg(long)]
    threads: Option<usize>,
    /// Print mceip-motion/1.
    #[arg(long)]
    json: bool,
}

/// More steps or impulses than any picture has use for.
const MAX_STEPS: u64 = 1_000_000;
const MAX_IMPULSES: u64 = 1000;

/// Steps of an impulse's run for each step along a mode: 20 periods are longer.
const STEPS_OF_IMPULSE: usize = 5;

/// Longest periods that a run from an impulse lasts.
const PERIODS: f64 = 20.0;

/// Proves the modes, integrates, prints.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let problem = load(&args.file, None)?;
    let system = system_of(args, &problem)?;
    let duration = match &args.duration {
        Some(given) => Some(to_f64(&positive("duration", given)?)),
        None => None,
    };
    require_counts(args)?;
    require_threads(args.threads)?;
    let equations = Equations::new(&system)?;
    let output = Output::prepare_if("picture", args.picture.as_deref(), &[&args.file])?;

    let job = Job::begin("searching");
    let lambda2 = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;
    let lambda2 = crate::Problem::from(lambda2);
    let search = lambda2.complete().cancel(job.cancel());
    let mut search = search.on_progress(|progress| job.say(progress));
    if let Some(threads) = args.threads {
        search = search.threads(threads);
    }
    let set = search.run()?;
    let mut simulation = Simulation {
        name: problem.name.clone(),
        problem_sha256: lambda2.sha256(),
        solutions_of_a_step: Stepper::new(&equations, 0.0)?.solutions(),
        slip_particles: equations.slip_particles().to_vec(),
        is_complete: set.is_complete(),
        families: set.families().len(),
        unknown: set.solutions().iter().filter(|s| is_unknown(s)).count(),
        modes: Vec::new(),
        impulses: Vec::new(),
        is_interrupted: false,
    };

    if simulation.solutions_of_a_step == StepSolutions::One {
        simulation.modes = along_modes(args, duration, &set, &equations, &job)?;
        simulation.impulses = after_impulses(args, &equations, &job)?;
    }
    simulation.is_interrupted = job.is_cancelled();
    job.end();

    if let Some(output) = output {
        output.write(&report::picture(&simulation).to_svg())?;
    }
    print_answer(
        args.json,
        || report::json(&simulation),
        || report::text(&simulation),
    )?;
    Ok(exit_code(&simulation))
}

/// The system of the problem, at the friction of the option if there is one; with its radii, so
/// that a set of bodies is refused either way.
fn system_of(args: &Args, problem: &Problem) -> Result<System, CliError> {
    let Body::System(system) = problem.body() else {
        return Err(CliError::SimulatedPencil);
    };
    let Some(given) = &args.friction else {
        return Ok(system.clone());
    };

    let friction = friction_of("friction", given)?;
    let states: Vec<ContactState> = system.particles().iter().map(|p| p.state).collect();
    Ok(system.with_states(&states, Some(friction))?)
}

fn require_counts(args: &Args) -> Result<(), CliError> {
    require_count("steps", args.steps as u64, 1..=MAX_STEPS)?;
    require_count("impulses", args.impulses as u64, 0..=MAX_IMPULSES)
}

/// Is the displacement of this solution not known to doubles?
fn is_unknown(solution: &Solution) -> bool {
    solution.v.as_ref().is_none_or(Vec::is_empty)
}

/// A run along each certified mode whose displacement is known.
fn along_modes(
    args: &Args,
    duration: Option<f64>,
    set: &SolutionSet,
    equations: &Equations,
    job: &Job,
) -> Result<Vec<SimulatedMode>, CliError> {
    let unit = equations.longest_period()?;

    let mut modes = Vec::new();
    for solution in set.solutions().iter().filter(|s| !is_unknown(s)) {
        if job.is_cancelled() {
            break;
        }

        job.say(format!("mode {}", modes.len() + 1));
        let v = solution.v.as_deref().unwrap_or_default();
        let mode = GrowthMode {
            lambda2: solution.value,
            displacement: equations.coordinates(v)?,
        };
        let plan = Plan {
            duration: duration.unwrap_or_else(|| mode.usual_duration(unit)),
            steps: args.steps,
        };

        let growth = along_mode(equations, &mode, plan)?;
        let particles = equations.slip_particles();
        let slipping = solution.support.iter();
        modes.push(SimulatedMode {
            lambda2: solution.enclosure.clone(),
            rate: mode.rate(),
            support: solution.support.clone(),
            slipping: slipping.map(|&i| particles[i - equations.free()]).collect(),
            growth,
        });
    }

    Ok(modes)
}

/// The motions that random impulses set off.
fn after_impulses(
    args: &Args,
    equations: &Equations,
    job: &Job,
) -> Result<Vec<SimulatedImpulse>, CliError> {
    let plan = Plan {
        duration: PERIODS * equations.longest_period()?,
        steps: STEPS_OF_IMPULSE * args.steps,
    };

    let mut impulses = Vec::new();
    for seed in 0..args.impulses as u64 {
        if job.is_cancelled() {
            break;
        }

        job.say(format!("impulse {}", seed + 1));
        let motion = AfterImpulse::new(equations, seed, plan)?;
        impulses.push(SimulatedImpulse { seed, motion });
    }

    Ok(impulses)
}

/// Disagreement: a mode that does not grow as predicted, or, where it is proved that there is none,
/// growth along a constant direction.
fn exit_code(simulation: &Simulation) -> u8 {
    let is_absent = simulation.is_proved_absent();
    let is_contradicted = is_absent && simulation.impulses.iter().any(grows_along_a_direction);
    let agreements = simulation.modes.iter().map(|mode| mode.growth.agreement());
    let agreements: Vec<GrowthAgreement> = agreements.collect();
    let is_open = simulation.solutions_of_a_step != StepSolutions::One
        || !simulation.is_complete
        || simulation.unknown > 0
        || agreements.contains(&GrowthAgreement::TooShort)
        || agreements.contains(&GrowthAgreement::NotResolved);

    if simulation.is_interrupted {
        exit::INTERRUPTED
    } else if is_contradicted || agreements.contains(&GrowthAgreement::Disagrees) {
        exit::REJECTED
    } else if is_open {
        exit::UNDECIDED
    } else {
        exit::DONE
    }
}

fn grows_along_a_direction(impulse: &SimulatedImpulse) -> bool {
    let motion = &impulse.motion;
    motion.is_resolved() && motion.fine.class == MotionClass::ConstantDirection
}
