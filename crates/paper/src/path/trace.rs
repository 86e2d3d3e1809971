//! Following the path: press, then move; from event to event, each verified.

use super::check::check;
use super::contact::{Contact, Friction, Load};
use super::error::PathError;
use super::line::{Class, Line, classify, next_event};
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

/// What does not change along a path.
struct Tracer<'a> {
    contact: &'a Contact,
    friction: Friction,
    images: Images,
    /// u_T at which each node stuck when it last began to, per unit of pressing.
    held: Vec<Rational>,
}

pub(super) fn trace(
    contact: &Contact,
    loading: &Loading,
    progress: &dyn Fn(usize, &Rational) -> ControlFlow<()>,
) -> Result<LoadingPath, PathError> {
    loading.validate()?;
    let n = contact.nodes();
    let friction = Friction::new(&loading.friction);
    let mut tracer = Tracer {
        contact,
        friction,
        images: Images::default(),
        held: vec![Rational::zero(); n],
    };
    let pressing = tracer.rates(
        &vec![Class::Zero; n],
        &vec![ContactState::Stick; n],
        Load::Press,
    )?;
    let mut line = tracer.line(&pressing);
    let mut d = Rational::zero();
    tracer.verify(&pressing, &vec![Class::Zero; n], &line, &d, Load::Press)?;
    let depth = depth(contact, &line, &loading.force)?;
    let pressed = line.equilibrium(&d, &depth, contact);
    let (mut intervals, mut states) = (Vec::new(), pressing.states.clone());
    let mut causes = Vec::new();
    let until = loading.until.as_ref().map(|u| u / &depth);
    let end = loop {
        if progress(intervals.len(), &(&d * &depth)).is_break() {
            break PathEnd::Interrupted;
        }
        if intervals.len() > EVENTS_PER_NODE * n {
            return Err(PathError::TooManyEvents {
                limit: EVENTS_PER_NODE * n,
            });
        }
        let at = |source: PathError| {
            let motion = format!("{:.6}", to_f64(&(&d * &depth)));
            PathError::AtEvent {
                event: intervals.len(),
                motion,
                source: Box::new(source),
            }
        };
        let (solved, next) = match tracer.pass(&states, &line, &d) {
            Err(PathError::NoContinuation { tried, all }) => {
                break PathEnd::NoContinuation {
                    causes,
                    tried,
                    proved: all,
                };
            }
            passed => passed.map_err(at)?,
        };
        let event = Event::new(
            std::mem::take(&mut causes),
            changes(&states, &solved.states),
            solved.finder,
            solved.tried,
        );
        states = solved.states;
        let found = next_event(&next, &tracer.friction, &states);
        let in_range = |(to, _): &(Rational, Vec<_>)| until.as_ref().is_none_or(|u| to < u);
        let (to, reason) = match found.filter(in_range) {
            Some((to, bounds)) => {
                causes = bounds;
                (Some(to), None)
            }
            None => (
                until.clone(),
                Some(if until.is_some() {
                    PathEnd::Range
                } else {
                    PathEnd::NoFurtherEvent
                }),
            ),
        };
        if let Some(to) = &to {
            check(contact, &tracer.friction, &states, &next, to, Load::Left)
                .map_err(law)
                .map_err(at)?;
        }
        let equilibrium = |d: &Rational| next.equilibrium(d, &depth, contact);
        let interval = Interval {
            begin: event,
            states: states.clone(),
            start: equilibrium(&d),
            stop: to.as_ref().map(equilibrium),
        };
        intervals.push(interval);
        line = next;
        match (to, reason) {
            (_, Some(reason)) => break reason,
            (Some(to), None) => d = to,
            (None, None) => break PathEnd::NoFurtherEvent,
        }
    };
    Ok(LoadingPath {
        loading: loading.clone(),
        depth,
        pressing: pressing.states,
        pressed,
        intervals,
        end,
    })
}

impl Tracer<'_> {
    fn rates(
        &mut self,
        classes: &[Class],
        start: &[ContactState],
        moving: Load,
    ) -> Result<Solved, PathError> {
        let held = &self.held;
        let loads = |states: &[ContactState]| {
            let shifted = (0..states.len())
                .filter(|&k| states[k] == ContactState::Stick && !held[k].is_zero())
                .map(Load::Held);
            let rigid = if moving == Load::Press {
                vec![Load::Press]
            } else {
                vec![Load::Press, Load::Left]
            };
            rigid.into_iter().chain(shifted).collect()
        };
        Rates {
            contact: self.contact,
            friction: &self.friction,
            classes,
            loads: &loads,
            moving,
        }
        .solve(&mut self.images, start)
    }

    /// The states after the event at d, and the stretch that begins there.
    fn pass(
        &mut self,
        before: &[ContactState],
        line: &Line,
        d: &Rational,
    ) -> Result<(Solved, Line), PathError> {
        let classes = classify(line, d, &self.friction).map_err(law)?;
        for (k, state) in before.iter().enumerate() {
            if *state != ContactState::Stick {
                let unit = &line.denominator * d.denom();
                // Where it sticks if it does.
                self.held[k] = Rational::new(line.u_at(2 * k, d), unit);
            }
        }
        let solved = self.rates(&classes, before, Load::Left)?;
        let next = self.line(&solved);
        if !next.meets(line, d) {
            return Err(PathError::Discontinuous);
        }
        self.verify(&solved, &classes, &next, d, Load::Left)?;
        Ok((solved, next))
    }

    fn line(&self, solved: &Solved) -> Line {
        let coefficient = |l: &Load| match l {
            Load::Held(k) => self.held[*k].clone(),
            _ => Rational::one(),
        };
        let loads: Vec<(Load, Rational)> =
            solved.loads.iter().map(|l| (*l, coefficient(l))).collect();
        Line::new(&solved.response, &loads)
    }

    /// The laws at d, and the rates just after it against the classes at d.
    fn verify(
        &self,
        solved: &Solved,
        classes: &[Class],
        line: &Line,
        d: &Rational,
        moving: Load,
    ) -> Result<(), PathError> {
        check(
            self.contact,
            &self.friction,
            &solved.states,
            line,
            d,
            moving,
        )
        .map_err(law)?;
        let rate = usize::from(moving == Load::Left);
        let (u, r) = (&line.u[rate], &line.r[rate]);
        let fits = |k: &usize| admissible(classes[*k], solved.states[*k], *k, u, r, &self.friction);
        match (0..classes.len()).find(|k| !fits(k)) {
            Some(node) => Err(PathError::LawFails {
                equation: "E9",
                node,
            }),
            None => Ok(()),
        }
    }
}

fn law((node, equation): (usize, &'static str)) -> PathError {
    PathError::LawFails { equation, node }
}

fn changes(before: &[ContactState], after: &[ContactState]) -> Vec<Change> {
    let change = |(node, (&from, &to))| (from != to).then_some(Change { node, from, to });
    before
        .iter()
        .zip(after)
        .enumerate()
        .filter_map(change)
        .collect()
}

/// The pressing (mm) at which the normal resultant is -force, by proportion.
fn depth(contact: &Contact, line: &Line, force: &Rational) -> Result<Rational, PathError> {
    let sum: Integer = line.r[0].iter().skip(1).step_by(2).sum();
    if !sum.is_negative() {
        return Err(PathError::NoPressure);
    }
    let per_mm = Rational::new(-sum, &line.denominator * contact.denominator());
    debug_assert!(per_mm > whole(0));
    Ok(force / per_mm)
}
