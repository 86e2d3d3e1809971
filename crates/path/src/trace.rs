//! Following the path: one load after the other, from event to event, each verified.
//!
//! The path begins with the unloaded body. Each round of [`trace`] starts at an event or at the
//! beginning of a step: the classes of the candidates there give a rate problem (`rates`), its
//! solution the states of the next stretch and the line on which w and r lie (`line`). The stretch
//! must begin where the last one ended, satisfy the laws at both ends and inside (`check`), and
//! ends at its next event or with its step. Input is the condensed body and the steps;
//! `LoadingPath::follow` calls it.
//!
//! Contact and friction (1), (2) know no unit of length or force. Without gaps the path is followed
//! with all loads over that of the first step, whose numbers may be long, and comes out in the
//! loads that were given ([`LoadUnits`]).

use super::check::PathPoint;
use super::contact::{Contact, FrictionCoefficients, Load};
use super::error::PathError;
use super::line::{
    Amount, AppliedLoad, Bound, Class, EquilibriumLine, NextEvent, classify, next_event,
};
use super::linear::Images;
use super::load_steps::LoadSteps;
use super::loading_path::{LoadingPath, LoadingPathEnd};
use super::rates::{AllRates, Rates, Solved};
use super::stretch::{Change, Event, Stretch};
use mceip_exact::{Rational, simplest_between, to_f64, whole};
use mceip_model::ContactState;
use num_traits::Zero;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// Events per candidate and step after which a path is given up. Paths met so far have about two.
const EVENTS_PER_NODE: usize = 200;

/// How far a path has been followed.
#[derive(Debug, Clone, Copy)]
pub struct PathProgress<'a> {
    /// Number of the stretch, from 0.
    pub stretch: usize,
    /// The step whose load grows, from 0.
    pub step: usize,
    /// How much of its load is applied.
    pub amount: &'a Rational,
}

/// What is common to the stretches of a path.
struct Tracer<'a> {
    contact: &'a Contact,
    friction: FrictionCoefficients,
    units: LoadUnits,
    /// How much of h each load becomes, on this scale.
    amounts: Vec<Option<Rational>>,
    taken: &'a BTreeMap<usize, usize>,
    images: Images,
    /// u_T at which each candidate stuck when it last began to.
    held: Vec<Rational>,
}

/// States that solve a rate problem, and the line on which they lead on.
struct SolvedStretch {
    solved: Solved,
    applied: Vec<AppliedLoad>,
    line: EquilibriumLine,
}

/// Where the path has got to.
struct Position {
    /// The step whose load grows from here.
    step: usize,
    /// How much of h of that load is applied: 0 where the step begins, else where the stretch
    /// before ends.
    a: Rational,
    /// What happens there: the bounds that became zero.
    causes: Vec<Bound>,
    /// The stretch that ends there, and its own amount there.
    states: Vec<ContactState>,
    line: EquilibriumLine,
    end_of_line: Rational,
}

/// How a stretch ends.
enum StretchEnd {
    /// With an event.
    Event(NextEvent),
    /// When all of the load is applied.
    Step(Rational),
    /// Not at all.
    Never,
}

impl StretchEnd {
    fn amount(&self) -> Option<&Rational> {
        match self {
            StretchEnd::Event(event) => Some(&event.a),
            StretchEnd::Step(end) => Some(end),
            StretchEnd::Never => None,
        }
    }
}

/// Follows the path; see [`LoadingPath::follow`].
pub(super) fn trace(
    contact: &Contact,
    steps: &LoadSteps,
    progress: &dyn Fn(PathProgress<'_>) -> ControlFlow<()>,
) -> Result<LoadingPath, PathError> {
    steps.validate(contact)?;
    let events_allowed = EVENTS_PER_NODE * contact.nodes() * steps.amounts.len();

    let mut tracer = Tracer::new(contact, steps);
    let mut position = tracer.unloaded();
    let mut stretches = Vec::new();
    let end = loop {
        let amount = &position.a / tracer.units.of(position.step);
        let here = PathProgress {
            stretch: stretches.len(),
            step: position.step,
            amount: &amount,
        };
        if progress(here).is_break() {
            break LoadingPathEnd::Interrupted;
        }

        if stretches.len() > events_allowed {
            return Err(PathError::TooManyEvents {
                limit: events_allowed,
            });
        }

        let stretch = match tracer.pass(&position, stretches.len()) {
            Ok(stretch) => stretch,
            Err(PathError::NoContinuation(why)) => {
                break LoadingPathEnd::NoContinuation {
                    causes: position.causes,
                    why,
                };
            }
            Err(error) => return Err(at(error, here)),
        };

        let stretch_end = tracer.end_of(&stretch, position.step);
        let finished = tracer
            .finished(&position, &stretch, &stretch_end)
            .map_err(|error| at(error, here))?;
        stretches.push(finished);

        position = match stretch_end {
            StretchEnd::Never => break LoadingPathEnd::NoFurtherEvent,
            StretchEnd::Step(_) if position.step + 1 == steps.amounts.len() => {
                break LoadingPathEnd::AllApplied;
            }
            StretchEnd::Step(end) => Position {
                step: position.step + 1,
                a: Rational::zero(),
                causes: Vec::new(),
                states: stretch.solved.states,
                line: stretch.line,
                end_of_line: end,
            },
            StretchEnd::Event(event) => Position {
                step: position.step,
                a: event.a.clone(),
                causes: event.causes,
                states: stretch.solved.states,
                line: stretch.line,
                end_of_line: event.a,
            },
        };
    };

    let mut asked = steps.taken.keys();
    if let Some(stretch) = asked.find(|&&stretch| stretch >= stretches.len())
        && end != LoadingPathEnd::Interrupted
    {
        return Err(PathError::Steps {
            expected: format!(
                "a stretch of this path, numbered from 0 to {}",
                stretches.len().saturating_sub(1)
            ),
            got: format!("a continuation of stretch {stretch}"),
        });
    }

    Ok(LoadingPath {
        steps: steps.clone(),
        stretches,
        end,
    })
}

impl<'a> Tracer<'a> {
    fn new(contact: &'a Contact, steps: &'a LoadSteps) -> Tracer<'a> {
        let units = LoadUnits::new(contact, steps);
        let mut amounts = Vec::with_capacity(steps.amounts.len());
        for (load, amount) in steps.amounts.iter().enumerate() {
            amounts.push(amount.as_ref().map(|amount| amount * units.of(load)));
        }

        Tracer {
            contact,
            friction: FrictionCoefficients::new(&steps.friction, contact),
            units,
            amounts,
            taken: &steps.taken,
            images: Images::default(),
            held: vec![Rational::zero(); contact.nodes()],
        }
    }

    /// The beginning: candidates without a gap are in contact with zero reaction.
    fn unloaded(&self) -> Position {
        let mut states = Vec::with_capacity(self.contact.nodes());
        for gap in self.contact.gaps() {
            states.push(if gap.is_zero() {
                ContactState::Stick
            } else {
                ContactState::Free
            });
        }

        Position {
            step: 0,
            a: Rational::zero(),
            causes: Vec::new(),
            states,
            line: EquilibriumLine::unloaded(self.contact),
            end_of_line: Rational::zero(),
        }
    }

    /// The states after the event at a position, and the stretch that begins there; its number.
    fn pass(&mut self, position: &Position, number: usize) -> Result<SolvedStretch, PathError> {
        let classes = classify(&position.line, &position.end_of_line, &self.friction)?;
        self.note_where_nodes_would_stick(position);

        let solved = self.rates(&classes, position, number)?;
        let mut applied = Vec::with_capacity(solved.loads.len());
        for &load in &solved.loads {
            let amount = self.amount_of(load, position.step);
            applied.push(AppliedLoad { load, amount });
        }

        let line = EquilibriumLine::new(&solved.response, &applied, self.contact);
        if !line.meets(&position.a, &position.line, &position.end_of_line) {
            return Err(PathError::Discontinuous);
        }

        let stretch = SolvedStretch {
            solved,
            applied,
            line,
        };
        self.verify(&stretch, &classes, &position.a)?;
        Ok(stretch)
    }

    /// Notes u_T of every candidate that does not stick: if it sticks from here on, it does so
    /// there.
    fn note_where_nodes_would_stick(&mut self, position: &Position) {
        let a = &position.end_of_line;
        let unit = &position.line.denominator * a.denom();
        for (node, state) in position.states.iter().enumerate() {
            if *state != ContactState::Stick {
                let u_t = position.line.w.at(2 * node, a);
                self.held[node] = Rational::new(u_t, unit.clone());
            }
        }
    }

    /// Solves the rate problem at a position, where a stretch begins.
    fn rates(
        &mut self,
        classes: &[Class],
        position: &Position,
        stretch: usize,
    ) -> Result<Solved, PathError> {
        let held = &self.held;
        let gaps = self.contact.gaps();
        let problem = Rates {
            contact: self.contact,
            friction: &self.friction,
            classes,
            causes: &position.causes,
            loads: &|states| loads(states, held, gaps, position.step),
            growing: Load::Step(position.step),
        };
        match self.taken.get(&stretch) {
            None => problem.solve(&mut self.images, &position.states),
            Some(&number) => taken(problem.all(&mut self.images), stretch, number),
        }
    }

    /// How much of a load is applied while that of `step` grows.
    fn amount_of(&self, load: Load, step: usize) -> Amount {
        match load {
            Load::Gaps => Amount::Fixed(whole(1)),
            Load::Held(node) => Amount::Fixed(self.held[node].clone()),
            Load::Step(of) if of == step => Amount::Growing,
            // A step that is over has an end.
            Load::Step(of) => Amount::Fixed(self.amounts[of].clone().unwrap_or_default()),
        }
    }

    /// The laws at `a`, and the rates just after it against the classes there.
    fn verify(
        &self,
        stretch: &SolvedStretch,
        classes: &[Class],
        a: &Rational,
    ) -> Result<(), PathError> {
        let point = self.point(stretch, a);
        point.check()?;
        point.check_rates(classes)?;
        Ok(())
    }

    fn point<'b>(&'b self, stretch: &'b SolvedStretch, a: &'b Rational) -> PathPoint<'b> {
        PathPoint {
            contact: self.contact,
            friction: &self.friction,
            states: &stretch.solved.states,
            line: &stretch.line,
            applied: &stretch.applied,
            a,
        }
    }

    /// The next event, or the end of the step if that comes first.
    fn end_of(&self, stretch: &SolvedStretch, step: usize) -> StretchEnd {
        let event = next_event(&stretch.line, &self.friction, &stretch.solved.states);
        match (event, &self.amounts[step]) {
            (Some(event), None) => StretchEnd::Event(event),
            (Some(event), Some(end)) if event.a < *end => StretchEnd::Event(event),
            (_, Some(end)) => StretchEnd::Step(end.clone()),
            (None, None) => StretchEnd::Never,
        }
    }

    /// The stretch as users see it, from a position to its end; the laws hold there and inside too.
    fn finished(
        &self,
        from: &Position,
        stretch: &SolvedStretch,
        end: &StretchEnd,
    ) -> Result<Stretch, PathError> {
        let line = &stretch.line;
        let solved = &stretch.solved;
        let one = self.units.of(from.step);
        let start = &from.a / one;
        let inside = match end.amount() {
            Some(end) => {
                self.point(stretch, end).check()?;
                let end = end / one;
                let quarter = (&end - &start) / whole(4);
                simplest_between(&(&start + &quarter), &(end - quarter))
            }
            None => simplest_between(&(&start + whole(1)), &(&start + whole(2))),
        };
        let inside = inside * one;
        self.point(stretch, &inside).check()?;
        let equilibrium = |a: &Rational| {
            let found = line.equilibrium(a, self.contact, &self.friction)?;
            Ok::<_, PathError>(found.times(&self.units.factor, a / one))
        };

        Ok(Stretch {
            step: from.step,
            begin: Event {
                causes: from.causes.clone(),
                changes: changes(&from.states, &solved.states),
                finder: solved.finder,
                tried: solved.tried,
            },
            states: solved.states.clone(),
            start: equilibrium(&from.a)?,
            inside: equilibrium(&inside)?,
            stop: end.amount().map(equilibrium).transpose()?,
        })
    }
}

/// The solution of the rate problem at the beginning of a stretch that was asked for.
fn taken(all: Option<AllRates>, stretch: usize, number: usize) -> Result<Solved, PathError> {
    let mut solved = all.map_or_else(Vec::new, |all| all.solved);
    if number < solved.len() {
        return Ok(solved.swap_remove(number));
    }

    Err(PathError::Steps {
        expected: match solved.len() {
            0 => format!("no continuation to be taken at stretch {stretch}: none is listed"),
            count => format!(
                "a continuation of stretch {stretch} from 0 to {}",
                count - 1
            ),
        },
        got: number.to_string(),
    })
}

/// In which multiples loads and gaps are applied while a path is followed.
struct LoadUnits {
    /// What is applied, times this, is what was asked for. 1 where there are gaps, and where the
    /// first load has no end.
    factor: Rational,
    /// How much of h one of each load is on this scale.
    ones: Vec<Rational>,
}

impl LoadUnits {
    fn new(contact: &Contact, steps: &LoadSteps) -> LoadUnits {
        let has_gaps = contact.gaps().iter().any(|gap| !gap.is_zero());
        let factor = match &steps.amounts[0] {
            Some(first) if !has_gaps => first * contact.content(0),
            _ => whole(1),
        };

        let loads = 0..steps.amounts.len();
        let ones = loads.map(|load| contact.content(load) / &factor).collect();
        LoadUnits { factor, ones }
    }

    /// How much of h one of a load is.
    fn of(&self, load: usize) -> &Rational {
        &self.ones[load]
    }
}

/// What is imposed while the candidates are in these states: the loads of all steps so far, the
/// gaps, and the places of the candidates that stick elsewhere than at zero.
fn loads(states: &[ContactState], held: &[Rational], gaps: &[Rational], step: usize) -> Vec<Load> {
    let mut loads: Vec<Load> = (0..=step).map(Load::Step).collect();
    if gaps.iter().any(|gap| !gap.is_zero()) {
        loads.push(Load::Gaps);
    }

    for (node, state) in states.iter().enumerate() {
        if *state == ContactState::Stick && !held[node].is_zero() {
            loads.push(Load::Held(node));
        }
    }

    loads
}

/// Says where on the path an error came up.
fn at(error: PathError, here: PathProgress<'_>) -> PathError {
    PathError::At {
        stretch: here.stretch,
        step: here.step + 1,
        amount: format!("{:.6}", to_f64(here.amount)),
        source: Box::new(error),
    }
}

/// The candidates that change their state.
fn changes(before: &[ContactState], after: &[ContactState]) -> Vec<Change> {
    let mut changes = Vec::new();
    for (node, (&from, &to)) in before.iter().zip(after).enumerate() {
        if from != to {
            changes.push(Change { node, from, to });
        }
    }

    changes
}
