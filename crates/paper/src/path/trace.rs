//! Following the path: press, then move; from event to event, each verified.
//!
//! The motion d is measured in units of the pressing. Each round of [`trace`] starts at an event:
//! the classes of the nodes there give a rate problem (`rates`), its solution the states of the
//! next stretch and the line on which u and r lie (`line`). The stretch must begin where the last
//! one ended, satisfy the laws at both ends (`check`), and ends at its next event. Input is the
//! condensed block and the loading; `LoadingPath::follow` calls it.

use super::check::PathPoint;
use super::contact::{Contact, Friction, Load};
use super::error::PathError;
use super::line::{AppliedLoad, Bound, Class, Line, NextEvent, classify, next_event};
use super::linear::Images;
use super::loading::Loading;
use super::loading_path::{LoadingPath, PathEnd};
use super::rates::{Rates, Solved, admissible};
use super::stretch::{Change, Event, Interval};
use mceip_exact::{Integer, Rational, to_f64, whole};
use mceip_model::ContactState;
use num_traits::{One, Signed, Zero};
use std::ops::ControlFlow;

/// Events per contact node after which a path is given up. Paths met so far have about two.
const EVENTS_PER_NODE: usize = 200;

/// What is common to the stretches of a path.
struct Tracer<'a> {
    contact: &'a Contact,
    friction: Friction,
    images: Images,
    /// u_T at which each node stuck when it last began to, per unit of pressing.
    held: Vec<Rational>,
}

/// States that solve a rate problem, and the line on which they lead on.
struct SolvedStretch {
    solved: Solved,
    line: Line,
}

/// Where the path has got to.
struct Position {
    /// The motion, in units of the pressing.
    d: Rational,
    /// What happens there: the bounds that became zero.
    causes: Vec<Bound>,
    /// The stretch that ends there.
    states: Vec<ContactState>,
    line: Line,
}

/// How a stretch ends.
enum StretchEnd {
    /// With an event.
    Event(NextEvent),
    /// At the end of the range asked for.
    Range(Rational),
    /// Not at all.
    Never,
}

impl StretchEnd {
    fn motion(&self) -> Option<&Rational> {
        match self {
            StretchEnd::Event(event) => Some(&event.d),
            StretchEnd::Range(until) => Some(until),
            StretchEnd::Never => None,
        }
    }
}

/// Follows the path; see [`LoadingPath::follow`].
pub(super) fn trace(
    contact: &Contact,
    loading: &Loading,
    progress: &dyn Fn(usize, &Rational) -> ControlFlow<()>,
) -> Result<LoadingPath, PathError> {
    loading.validate()?;
    let events_allowed = EVENTS_PER_NODE * contact.nodes();

    let mut tracer = Tracer::new(contact, loading);
    let pressing = tracer.press()?;
    let depth = depth(contact, &pressing.line, &loading.force)?;
    let pressing_states = pressing.solved.states;
    let mut position = Position {
        d: Rational::zero(),
        causes: Vec::new(),
        states: pressing_states.clone(),
        line: pressing.line,
    };
    let pressed = position.line.equilibrium(&position.d, &depth, contact);

    let until = loading.until.as_ref().map(|until| until / &depth); // in units of the pressing
    let mut intervals = Vec::new();
    let end = loop {
        let motion = &position.d * &depth;
        if progress(intervals.len(), &motion).is_break() {
            break PathEnd::Interrupted;
        }

        if intervals.len() > events_allowed {
            return Err(PathError::TooManyEvents {
                limit: events_allowed,
            });
        }

        let stretch = match tracer.pass(&position) {
            Ok(stretch) => stretch,
            Err(PathError::NoContinuation { tried, all }) => {
                break PathEnd::NoContinuation {
                    causes: position.causes,
                    tried,
                    proved: all,
                };
            }
            Err(error) => return Err(at_event(error, intervals.len(), &motion)),
        };

        let stretch_end = tracer.end_of(&stretch, until.as_ref());
        tracer
            .verify_end(&stretch, &stretch_end)
            .map_err(|error| at_event(error, intervals.len(), &motion))?;

        intervals.push(tracer.interval(&position, &stretch, &stretch_end, &depth));
        match stretch_end {
            StretchEnd::Range(_) => break PathEnd::Range,
            StretchEnd::Never => break PathEnd::NoFurtherEvent,
            StretchEnd::Event(event) => {
                position = Position {
                    d: event.d,
                    causes: event.causes,
                    states: stretch.solved.states,
                    line: stretch.line,
                };
            }
        }
    };

    Ok(LoadingPath {
        loading: loading.clone(),
        depth,
        pressing: pressing_states,
        pressed,
        intervals,
        end,
    })
}

impl<'a> Tracer<'a> {
    fn new(contact: &'a Contact, loading: &Loading) -> Tracer<'a> {
        Tracer {
            contact,
            friction: Friction::new(&loading.friction),
            images: Images::default(),
            held: vec![Rational::zero(); contact.nodes()],
        }
    }

    /// The pressing from the unloaded block, where every node is in contact with zero reaction.
    fn press(&mut self) -> Result<SolvedStretch, PathError> {
        let nodes = self.contact.nodes();
        let classes = vec![Class::Zero; nodes];
        let unloaded = vec![ContactState::Stick; nodes];

        let solved = self.rates(&classes, &unloaded, Load::Press)?;
        let line = self.line(&solved);
        let stretch = SolvedStretch { solved, line };
        self.verify(&stretch, &classes, &Rational::zero(), Load::Press)?;
        Ok(stretch)
    }

    /// The states after the event at a position, and the stretch that begins there.
    fn pass(&mut self, position: &Position) -> Result<SolvedStretch, PathError> {
        let d = &position.d;
        let classes = classify(&position.line, d, &self.friction)?;
        self.note_where_nodes_would_stick(position);

        let solved = self.rates(&classes, &position.states, Load::Left)?;
        let line = self.line(&solved);
        if !line.meets(&position.line, d) {
            return Err(PathError::Discontinuous);
        }

        let stretch = SolvedStretch { solved, line };
        self.verify(&stretch, &classes, d, Load::Left)?;
        Ok(stretch)
    }

    /// Notes u_T of every node that does not stick: if it sticks from here on, it does so there.
    fn note_where_nodes_would_stick(&mut self, position: &Position) {
        let unit = &position.line.denominator * position.d.denom();
        for (node, state) in position.states.iter().enumerate() {
            if *state != ContactState::Stick {
                let u_t = position.line.u_at(2 * node, &position.d);
                self.held[node] = Rational::new(u_t, unit.clone());
            }
        }
    }

    /// Solves the rate problem; `before` holds the states before.
    fn rates(
        &mut self,
        classes: &[Class],
        before: &[ContactState],
        moving: Load,
    ) -> Result<Solved, PathError> {
        let held = &self.held;
        let problem = Rates {
            contact: self.contact,
            friction: &self.friction,
            classes,
            loads: &|states| loads(states, held, moving),
            moving,
        };
        problem.solve(&mut self.images, before)
    }

    /// The line of the states found: every load as much as it is applied.
    fn line(&self, solved: &Solved) -> Line {
        let mut applied = Vec::with_capacity(solved.loads.len());
        for &load in &solved.loads {
            let amount = match load {
                Load::Held(node) => self.held[node].clone(),
                Load::Press | Load::Left => Rational::one(),
            };
            applied.push(AppliedLoad { load, amount });
        }

        Line::new(&solved.response, &applied)
    }

    /// The laws at d, and the rates just after it against the classes at d.
    fn verify(
        &self,
        stretch: &SolvedStretch,
        classes: &[Class],
        d: &Rational,
        moving: Load,
    ) -> Result<(), PathError> {
        self.point(stretch, d, moving).check()?;

        let rates = stretch.line.rates(moving);
        for (node, &class) in classes.iter().enumerate() {
            let state = stretch.solved.states[node];
            if !admissible(node, class, state, rates, &self.friction) {
                return Err(PathError::LawFails {
                    equation: "E9",
                    node,
                });
            }
        }

        Ok(())
    }

    /// The laws at the end of a stretch, if it has one.
    fn verify_end(&self, stretch: &SolvedStretch, end: &StretchEnd) -> Result<(), PathError> {
        if let Some(d) = end.motion() {
            self.point(stretch, d, Load::Left).check()?;
        }

        Ok(())
    }

    fn point<'b>(
        &'b self,
        stretch: &'b SolvedStretch,
        d: &'b Rational,
        moving: Load,
    ) -> PathPoint<'b> {
        PathPoint {
            contact: self.contact,
            friction: &self.friction,
            states: &stretch.solved.states,
            line: &stretch.line,
            d,
            moving,
        }
    }

    /// The next event, or the end of the range if that comes first.
    fn end_of(&self, stretch: &SolvedStretch, until: Option<&Rational>) -> StretchEnd {
        let event = next_event(&stretch.line, &self.friction, &stretch.solved.states);
        match (event, until) {
            (Some(event), None) => StretchEnd::Event(event),
            (Some(event), Some(until)) if event.d < *until => StretchEnd::Event(event),
            (_, Some(until)) => StretchEnd::Range(until.clone()),
            (None, None) => StretchEnd::Never,
        }
    }

    /// The stretch as users see it, from a position to its end; `depth` is the pressing in mm.
    fn interval(
        &self,
        from: &Position,
        stretch: &SolvedStretch,
        end: &StretchEnd,
        depth: &Rational,
    ) -> Interval {
        let line = &stretch.line;
        let solved = &stretch.solved;

        let begin = Event {
            causes: from.causes.clone(),
            changes: changes(&from.states, &solved.states),
            finder: solved.finder,
            tried: solved.tried,
        };
        let start = line.equilibrium(&from.d, depth, self.contact);
        let stop = end
            .motion()
            .map(|d| line.equilibrium(d, depth, self.contact));
        Interval {
            begin,
            states: solved.states.clone(),
            start,
            stop,
        }
    }
}

/// What is imposed while the nodes are in these states: the pressing, after it the motion, and the
/// places of the nodes that stick elsewhere than at zero.
fn loads(states: &[ContactState], held: &[Rational], moving: Load) -> Vec<Load> {
    let mut loads = vec![Load::Press];
    if moving != Load::Press {
        loads.push(Load::Left);
    }

    for (node, state) in states.iter().enumerate() {
        if *state == ContactState::Stick && !held[node].is_zero() {
            loads.push(Load::Held(node));
        }
    }

    loads
}

/// Says at which event, and at which motion (mm), an error came up.
fn at_event(error: PathError, event: usize, motion: &Rational) -> PathError {
    PathError::AtEvent {
        event,
        motion: format!("{:.6}", to_f64(motion)),
        source: Box::new(error),
    }
}

/// The nodes that change their state.
fn changes(before: &[ContactState], after: &[ContactState]) -> Vec<Change> {
    let mut changes = Vec::new();
    for (node, (&from, &to)) in before.iter().zip(after).enumerate() {
        if from != to {
            changes.push(Change { node, from, to });
        }
    }

    changes
}

/// The pressing (mm) at which the normal resultant is -force, by proportion.
fn depth(contact: &Contact, line: &Line, force: &Rational) -> Result<Rational, PathError> {
    let resultant: Integer = line.r.constant.iter().skip(1).step_by(2).sum();
    if !resultant.is_negative() {
        return Err(PathError::NoPressure);
    }

    let per_mm = Rational::new(-resultant, &line.denominator * contact.denominator());
    debug_assert!(per_mm > whole(0));
    Ok(force / per_mm)
}
