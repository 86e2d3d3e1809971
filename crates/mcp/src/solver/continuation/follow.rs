//! Predictor, corrector and events along a curve.

use super::super::options::Options;
use super::super::tolerance::{
    CURVE_ANGLE, CURVE_CLOSED, CURVE_FAR, CURVE_FEASIBLE, CURVE_FIRST, CURVE_GROWTH, CURVE_SAME,
    CURVE_SHORTEST,
};
use super::curve::{CurveEnd, Sense};
use super::system::{Border, Corrected, Local, Place, Places, Position, Quantity, System};
use crate::mcp::Mcp;
use nalgebra::DVector;

/// A curve under way.
pub(super) struct Follower<'p, 'a, P: Mcp + ?Sized> {
    system: System<'p, 'a, P>,
    at: Position,
    start: Position,
    start_places: Places,
    length: f64,
    steps_left: usize,
    enough: usize,
    found: Vec<DVector<f64>>,
}

/// Where a step has led.
struct Landing {
    there: Corrected,
    event: Option<Quantity>,
}

impl<'p, 'a, P: Mcp + ?Sized> Follower<'p, 'a, P> {
    pub(super) fn new(
        system: System<'p, 'a, P>,
        at: Position,
        options: &Options,
        enough: usize,
    ) -> Self {
        let (start, start_places) = (at.clone(), system.places.clone());
        Follower {
            system,
            at,
            start,
            start_places,
            length: CURVE_FIRST,
            steps_left: options.curve_step_limit,
            enough,
            found: Vec::new(),
        }
    }

    pub(super) fn run(mut self, sense: Sense) -> (Vec<DVector<f64>>, CurveEnd) {
        let end = self.walk(sense).unwrap_or(CurveEnd::Stuck);
        (self.found, end)
    }

    /// `None` where no step leads on.
    fn walk(&mut self, sense: Sense) -> Option<CurveEnd> {
        let mut local = self.system.local(&self.at.z.clone())?;
        let inside = self.system.places.inside();
        let row = self.system.row(Quantity::S, &local, &inside);
        let mut tangent =
            self.system
                .tangent(&local, &row, if sense == Sense::Down { -1.0 } else { 1.0 })?;
        loop {
            if self.steps_left == 0 {
                return Some(CurveEnd::StepLimit);
            }
            self.steps_left -= 1;
            self.system.problem.counters.curve_steps += 1;
            let (landing, next) = self.step(&local, &tangent)?;
            let before = std::mem::replace(&mut self.at, landing.there.at);
            (local, tangent) = (landing.there.local, next);
            if landing.event == Some(Quantity::S) {
                // A curve passes a point once, unless it is closed; one that has strayed from its
                // start closes elsewhere.
                let is_at =
                    |z: &DVector<f64>| (&self.at.z - z).amax() <= CURVE_SAME * (1.0 + z.amax());
                let again =
                    self.start.s == 0.0 && is_at(&self.start.z) || self.found.iter().any(is_at);
                self.found.push(self.at.z.clone());
                if again {
                    return Some(CurveEnd::Closed);
                }
                if self.found.len() >= self.enough {
                    return Some(CurveEnd::Enough);
                }
            }
            if self.at.z.amax() > CURVE_FAR * (1.0 + self.start.z.amax())
                || self.at.s.abs() > CURVE_FAR
            {
                return Some(CurveEnd::Ray);
            }
            if self.is_back(&before) {
                return Some(CurveEnd::Closed);
            }
        }
    }

    /// Has the step from `before` passed the start again?
    fn is_back(&self, before: &Position) -> bool {
        let passed = (before.s - self.start.s) * (self.at.s - self.start.s) < 0.0;
        if !passed || self.system.places != self.start_places {
            return false;
        }
        let share = (self.start.s - before.s) / (self.at.s - before.s);
        let there = before.z.lerp(&self.at.z, share);
        (there - &self.start.z).amax() <= CURVE_CLOSED * (&self.at.z - &before.z).amax()
    }

    /// One step, shortened until it succeeds; with the tangent at its end.
    fn step(&mut self, local: &Local, tangent: &DVector<f64>) -> Option<(Landing, DVector<f64>)> {
        let inside = self.system.places.inside();
        while self.length > CURVE_SHORTEST {
            if let Some(landing) = self.land(local, tangent, &inside)
                && let Some(next) = self.turn(&landing, tangent)
            {
                if landing.there.steps <= 2 && landing.event.is_none() {
                    self.length *= CURVE_GROWTH;
                }
                return Some((landing, next));
            }
            self.length *= 0.5;
        }
        None
    }

    /// The end of a step of the current length, or the event before it.
    fn land(&mut self, local: &Local, tangent: &DVector<f64>, inside: &[usize]) -> Option<Landing> {
        let mut predicted = self.at.clone();
        self.system
            .shift(&mut predicted, inside, tangent, self.length);
        if let Some((event, distance)) = self.predicted_event(local, tangent, inside)
            && distance <= self.length
        {
            let mut near = self.at.clone();
            self.system.shift(&mut near, inside, tangent, distance);
            if let Some(landing) = self.land_on(event, &near, local) {
                return Some(landing);
            }
        }
        let there = self.system.correct(&predicted, &Border::Plane(tangent))?;
        let at = &there.at;
        let Some((event, share)) = self.first_crossing(local, at, &there.local) else {
            return Some(Landing { there, event: None });
        };
        let near = Position {
            z: self.at.z.lerp(&at.z, share),
            s: self.at.s + share * (at.s - self.at.s),
        };
        self.land_on(event, &near, local)
    }

    /// Newton to the event; refused if another quantity has crossed on the way or the way is long.
    fn land_on(&mut self, event: Quantity, near: &Position, local: &Local) -> Option<Landing> {
        let mut there = self.system.correct(near, &Border::Zero(event))?;
        let at = &mut there.at;
        let far = (&at.z - &self.at.z).norm() + (at.s - self.at.s).abs();
        if far > 4.0 * self.length {
            return None;
        }
        match event {
            Quantity::Z(i, bound) => at.z[i] = bound,
            Quantity::S => at.s = 0.0,
            Quantity::Multiplier(_) => {}
        }
        match self.first_crossing(local, &there.at, &there.local) {
            Some((other, _)) if other != event => None,
            _ => Some(Landing {
                there,
                event: Some(event),
            }),
        }
    }

    /// The tangent after a landing: across an event the pair changes places; elsewhere the new
    /// tangent must be near the old one.
    fn turn(&mut self, landing: &Landing, tangent: &DVector<f64>) -> Option<DVector<f64>> {
        let kept = self.system.places.0.clone();
        let (index, place, quantity, sign) = match landing.event {
            None | Some(Quantity::S) => {
                let known = landing
                    .there
                    .tangent
                    .as_ref()
                    .map(|v| if v.dot(tangent) < 0.0 { -v } else { v.clone() });
                let next =
                    known.or_else(|| self.system.tangent(&landing.there.local, tangent, 1.0))?;
                return (next.dot(tangent) > CURVE_ANGLE).then_some(next);
            }
            Some(Quantity::Z(i, bound)) => {
                // By the bound, not by the tangent: a curve that bends may come back to the bound
                // it is leaving.
                let is_lower = bound <= self.system.problem.problem.lower()[i];
                (
                    i,
                    if is_lower { Place::Lower } else { Place::Upper },
                    Quantity::Multiplier(i),
                    if is_lower { 1.0 } else { -1.0 },
                )
            }
            Some(Quantity::Multiplier(i)) => (
                i,
                Place::Inside,
                Quantity::Z(i, 0.0),
                if kept[i] == Place::Lower { 1.0 } else { -1.0 },
            ),
        };
        self.system.places.0[index] = place;
        let now = self.system.places.inside();
        let row = self.system.row(quantity, &landing.there.local, &now);
        let next = self.system.tangent(&landing.there.local, &row, sign);
        if next.is_none() {
            self.system.places.0 = kept;
        }
        next
    }

    /// The quantities that must keep their sign: each with +1 if it must stay positive.
    fn guarded(&self) -> Vec<(Quantity, f64)> {
        let (l, u) = (
            self.system.problem.problem.lower(),
            self.system.problem.problem.upper(),
        );
        let mut list = Vec::new();
        for (i, place) in self.system.places.0.iter().enumerate() {
            match place {
                Place::Inside => {
                    if l[i].is_finite() {
                        list.push((Quantity::Z(i, l[i]), 1.0));
                    }
                    if u[i].is_finite() {
                        list.push((Quantity::Z(i, u[i]), -1.0));
                    }
                }
                Place::Lower => list.push((Quantity::Multiplier(i), 1.0)),
                Place::Upper => list.push((Quantity::Multiplier(i), -1.0)),
                Place::Fixed => {}
            }
        }
        if self.at.s != 0.0 {
            list.push((Quantity::S, self.at.s.signum()));
        }
        list
    }

    /// The first guarded quantity to vanish along the tangent, with its distance.
    fn predicted_event(
        &self,
        local: &Local,
        tangent: &DVector<f64>,
        inside: &[usize],
    ) -> Option<(Quantity, f64)> {
        let distance = |&(q, sign): &(Quantity, f64)| {
            let rate = sign * self.system.row(q, local, inside).dot(tangent);
            let value = (sign * self.system.value(q, &self.at, local)).max(0.0);
            (rate < 0.0).then(|| (q, value / -rate))
        };
        self.guarded()
            .iter()
            .filter_map(distance)
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The first guarded quantity that has the wrong sign at `to`, with its share of the way.
    fn first_crossing(
        &self,
        local: &Local,
        to: &Position,
        there: &Local,
    ) -> Option<(Quantity, f64)> {
        let scale = CURVE_FEASIBLE * (1.0 + to.s.abs());
        let share = |&(q, sign): &(Quantity, f64)| {
            let (before, after) = (
                sign * self.system.value(q, &self.at, local),
                sign * self.system.value(q, to, there),
            );
            (after < -scale).then(|| {
                (
                    q,
                    (before.max(0.0) / (before.max(0.0) - after)).clamp(0.0, 1.0),
                )
            })
        };
        self.guarded()
            .iter()
            .filter_map(share)
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

#[cfg(test)]
mod tests;
