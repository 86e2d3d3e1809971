//! Predictor, corrector and events along a curve (Allgower and Georg 1990, chapter 2).
//!
//! From a point of the curve a step goes a length along the unit tangent and back to the curve by
//! Newton's method across the tangent. Some quantities must keep their sign on a piece of the
//! curve: the distance of an inside unknown to its bounds, the multiplier of an unknown at a bound,
//! and s. Where one vanishes on the way the step ends there exactly: an *event*. At a bound or a
//! zero multiplier the unknown changes its place and the curve goes on along another piece; at
//! s = 0 there is a solution, and the curve goes on as it came.
//!
//! Input: the equations of a `HomotopySystem` and a position on the curve. Output: the solutions
//! met and a [`CurveEnd`]. Called by `continuation`.

use super::super::active_bound::ActiveBound;
use super::super::options::Options;
use super::super::tolerance::{
    CURVE_ANGLE, CURVE_CLOSED, CURVE_FAR, CURVE_FEASIBLE, CURVE_FIRST, CURVE_GROWTH, CURVE_SAME,
    CURVE_SHORTEST,
};
use super::curve::{CurveEnd, Sense};
use super::system::{Border, Corrected, CurvePoint, HomotopySystem, Local, Places, Quantity};
use crate::mcp::Mcp;
use nalgebra::DVector;
use std::mem::replace;

/// A curve under way.
pub(super) struct Follower<'p, 'a, P: Mcp + ?Sized> {
    system: HomotopySystem<'p, 'a, P>,
    at: CurvePoint,
    start: CurvePoint,
    start_places: Places,
    /// Length of the next step.
    length: f64,
    steps_left: usize,
    /// The number of solutions to find.
    enough: usize,
    /// The solutions met, in order.
    found: Vec<DVector<f64>>,
}

/// Where a step has led.
struct Landing {
    there: Corrected,
    /// What has vanished there, if the step ends at an event.
    event: Option<Quantity>,
}

/// A quantity that must keep its sign.
#[derive(Debug, Clone, Copy)]
struct Guard {
    quantity: Quantity,
    /// 1 if it must stay positive, -1 if negative.
    sign: f64,
}

impl Guard {
    fn positive(quantity: Quantity) -> Guard {
        Guard {
            quantity,
            sign: 1.0,
        }
    }

    fn negative(quantity: Quantity) -> Guard {
        Guard {
            quantity,
            sign: -1.0,
        }
    }
}

/// What becomes of an unknown at an event.
struct PlaceChange {
    index: usize,
    /// Its new place.
    place: ActiveBound,
    /// What leaves zero after the event.
    leaving: Quantity,
    /// 1 if that grows, -1 if it falls.
    sign: f64,
}

impl<'p, 'a, P: Mcp + ?Sized> Follower<'p, 'a, P> {
    /// At the start of a curve.
    pub(super) fn new(
        system: HomotopySystem<'p, 'a, P>,
        at: CurvePoint,
        options: &Options,
        enough: usize,
    ) -> Self {
        let start_places = system.places.clone();
        Follower {
            system,
            start: at.clone(),
            at,
            start_places,
            length: CURVE_FIRST,
            steps_left: options.curve_step_limit,
            enough,
            found: Vec::new(),
        }
    }

    /// Follows the curve; the solutions met, in order, and the reason why it ended.
    pub(super) fn run(mut self, sense: Sense) -> (Vec<DVector<f64>>, CurveEnd) {
        let end = self.walk(sense).unwrap_or(CurveEnd::Stuck);
        (self.found, end)
    }

    /// Steps until there is a reason to stop; `None` where no step leads on.
    fn walk(&mut self, sense: Sense) -> Option<CurveEnd> {
        let mut local = self.system.local(&self.at.z.clone())?;
        let mut tangent = self.first_tangent(&local, sense)?;

        loop {
            if self.steps_left == 0 {
                return Some(CurveEnd::StepLimit);
            }

            self.steps_left -= 1;
            self.system.problem.counters.curve_steps += 1;

            let (landing, next) = self.step(&local, &tangent)?;
            let before = replace(&mut self.at, landing.there.at);
            local = landing.there.local;
            tangent = next;

            if landing.event == Some(Quantity::S)
                && let Some(end) = self.meet_solution()
            {
                return Some(end);
            }

            if self.is_far() {
                return Some(CurveEnd::Ray);
            }

            if self.is_back(&before) {
                return Some(CurveEnd::Closed);
            }
        }
    }

    /// The unit tangent at the start along which s changes as asked.
    fn first_tangent(&mut self, local: &Local, sense: Sense) -> Option<DVector<f64>> {
        let inside = self.system.places.inside();
        let row = self.system.row(Quantity::S, local, &inside);
        let sign = match sense {
            Sense::Down => -1.0,
            Sense::Up => 1.0,
        };

        self.system.tangent(local, &row, sign)
    }

    /// Notes the solution at the current position; the reason to stop if it is known or the last
    /// one wanted.
    fn meet_solution(&mut self) -> Option<CurveEnd> {
        // A curve passes a point once, unless it is closed; one that has strayed from its start
        // closes elsewhere.
        let is_at_start = self.start.s == 0.0 && self.is_at(&self.start.z);
        let is_again = is_at_start || self.found.iter().any(|z| self.is_at(z));

        self.found.push(self.at.z.clone());
        if is_again {
            Some(CurveEnd::Closed)
        } else if self.found.len() >= self.enough {
            Some(CurveEnd::Enough)
        } else {
            None
        }
    }

    /// Is the current position this point?
    fn is_at(&self, z: &DVector<f64>) -> bool {
        let distance = (&self.at.z - z).amax();
        let size = 1.0 + z.amax();
        distance <= CURVE_SAME * size
    }

    /// Has the curve gone to infinity?
    fn is_far(&self) -> bool {
        let size = 1.0 + self.start.z.amax();
        let z_is_far = self.at.z.amax() > CURVE_FAR * size;
        let s_is_far = self.at.s.abs() > CURVE_FAR;
        z_is_far || s_is_far
    }

    /// Has the step from `before` passed the start again?
    fn is_back(&self, before: &CurvePoint) -> bool {
        let above_before = before.s - self.start.s;
        let above_after = self.at.s - self.start.s;
        let passed = above_before * above_after < 0.0;
        if !passed || self.system.places != self.start_places {
            return false;
        }

        // The point of the chord at the start's s.
        let share = (self.start.s - before.s) / (self.at.s - before.s);
        let there = before.z.lerp(&self.at.z, share);

        let distance = (there - &self.start.z).amax();
        let step = (&self.at.z - &before.z).amax();
        distance <= CURVE_CLOSED * step
    }

    /// One step, shortened until it succeeds; with the tangent at its end.
    fn step(&mut self, local: &Local, tangent: &DVector<f64>) -> Option<(Landing, DVector<f64>)> {
        let inside = self.system.places.inside();
        while self.length > CURVE_SHORTEST {
            if let Some(landing) = self.land(local, tangent, &inside)
                && let Some(next) = self.turn(&landing, tangent)
            {
                let is_easy = landing.there.steps <= 2;
                if is_easy && landing.event.is_none() {
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
        // An event that the tangent shows within the step is tried first.
        if let Some((event, distance)) = self.predicted_event(local, tangent, inside)
            && distance <= self.length
        {
            let mut near = self.at.clone();
            self.system.shift(&mut near, inside, tangent, distance);
            if let Some(landing) = self.land_on(event, &near, local) {
                return Some(landing);
            }
        }

        let mut predicted = self.at.clone();
        self.system
            .shift(&mut predicted, inside, tangent, self.length);
        let there = self.system.correct(&predicted, &Border::Plane(tangent))?;
        let at = &there.at;
        let Some((event, share)) = self.first_crossing(local, at, &there.local) else {
            return Some(Landing { there, event: None });
        };

        let near = CurvePoint {
            z: self.at.z.lerp(&at.z, share),
            s: self.at.s + share * (at.s - self.at.s),
        };

        self.land_on(event, &near, local)
    }

    /// Newton to the event; refused if another quantity has crossed on the way or the way is long.
    fn land_on(&mut self, event: Quantity, near: &CurvePoint, local: &Local) -> Option<Landing> {
        let mut there = self.system.correct(near, &Border::Zero(event))?;
        let at = &mut there.at;
        let way = (&at.z - &self.at.z).norm() + (at.s - self.at.s).abs();

        if way > 4.0 * self.length {
            return None;
        }

        // The quantity is zero exactly, not to rounding.
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
        let local = &landing.there.local;
        let change = match landing.event {
            None | Some(Quantity::S) => {
                let next = match &landing.there.tangent {
                    Some(known) if known.dot(tangent) < 0.0 => -known,
                    Some(known) => known.clone(),
                    None => self.system.tangent(local, tangent, 1.0)?,
                };
                return (next.dot(tangent) > CURVE_ANGLE).then_some(next);
            }
            Some(Quantity::Z(i, bound)) => self.change_to_bound(i, bound),
            Some(Quantity::Multiplier(i)) => self.change_to_inside(i),
        };

        self.change_places(&change, local)
    }

    /// z_i has met a bound: its multiplier leaves zero.
    fn change_to_bound(&self, i: usize, bound: f64) -> PlaceChange {
        // By the bound, not by the tangent: a curve that bends may come back to the bound it is
        // leaving.
        let is_lower = bound <= self.system.problem.problem.lower()[i];

        PlaceChange {
            index: i,
            place: if is_lower {
                ActiveBound::Lower
            } else {
                ActiveBound::Upper
            },
            leaving: Quantity::Multiplier(i),
            sign: if is_lower { 1.0 } else { -1.0 },
        }
    }

    /// The multiplier of z_i has vanished: z_i leaves its bound.
    fn change_to_inside(&self, i: usize) -> PlaceChange {
        let was_lower = self.system.places.0[i] == ActiveBound::Lower;
        PlaceChange {
            index: i,
            place: ActiveBound::None,
            leaving: Quantity::Z(i, 0.0),
            sign: if was_lower { 1.0 } else { -1.0 },
        }
    }

    /// Changes the place of an unknown; the tangent along which the quantity leaves zero. Without
    /// one the places stay.
    fn change_places(&mut self, change: &PlaceChange, local: &Local) -> Option<DVector<f64>> {
        let place_before = replace(&mut self.system.places.0[change.index], change.place);
        let inside = self.system.places.inside();
        let row = self.system.row(change.leaving, local, &inside);
        let next = self.system.tangent(local, &row, change.sign);

        if next.is_none() {
            self.system.places.0[change.index] = place_before;
        }
        next
    }

    /// The quantities that must keep their sign from the current position on.
    fn guards(&self) -> Vec<Guard> {
        let mcp = self.system.problem.problem;
        let mut guards = Vec::new();

        for (i, place) in self.system.places.0.iter().enumerate() {
            match place {
                ActiveBound::None => {
                    let lower = mcp.lower()[i];
                    if lower.is_finite() {
                        guards.push(Guard::positive(Quantity::Z(i, lower)));
                    }
                    let upper = mcp.upper()[i];
                    if upper.is_finite() {
                        guards.push(Guard::negative(Quantity::Z(i, upper)));
                    }
                }
                ActiveBound::Lower => guards.push(Guard::positive(Quantity::Multiplier(i))),
                ActiveBound::Upper => guards.push(Guard::negative(Quantity::Multiplier(i))),
                ActiveBound::Fixed => {}
            }
        }

        if self.at.s != 0.0 {
            guards.push(Guard {
                quantity: Quantity::S,
                sign: self.at.s.signum(),
            });
        }
        guards
    }

    /// The first guarded quantity to vanish along the tangent, with its distance.
    fn predicted_event(
        &self,
        local: &Local,
        tangent: &DVector<f64>,
        inside: &[usize],
    ) -> Option<(Quantity, f64)> {
        let mut events = Vec::new();
        for Guard { quantity, sign } in self.guards() {
            let row = self.system.row(quantity, local, inside);
            let rate = sign * row.dot(tangent);
            let value = (sign * self.system.value(quantity, &self.at, local)).max(0.0);

            if rate < 0.0 {
                events.push((quantity, value / -rate));
            }
        }

        least(events)
    }

    /// The first guarded quantity that has the wrong sign at `to`, with its share of the way.
    fn first_crossing(
        &self,
        local: &Local,
        to: &CurvePoint,
        there: &Local,
    ) -> Option<(Quantity, f64)> {
        let tolerance = CURVE_FEASIBLE * (1.0 + to.s.abs());
        let mut crossings = Vec::new();

        for Guard { quantity, sign } in self.guards() {
            let before = (sign * self.system.value(quantity, &self.at, local)).max(0.0);
            let after = sign * self.system.value(quantity, to, there);
            if after < -tolerance {
                let share = before / (before - after);
                crossings.push((quantity, share.clamp(0.0, 1.0)));
            }
        }

        least(crossings)
    }
}

/// The pair with the least number, the first one of equal ones.
fn least(pairs: Vec<(Quantity, f64)>) -> Option<(Quantity, f64)> {
    pairs.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests;
