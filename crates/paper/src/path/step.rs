//! Ordinary incremental stepping in doubles, for comparison: equal steps of the motion, at each
//! an active set from the step before. What happens within a step is lost.
#![allow(clippy::float_arithmetic)]

use super::contact::Contact;
use super::error::PathError;
use super::loading::Loading;
use crate::tolerance::STEP_SIGN;
use mceip_exact::{Rational, to_f64};
use mceip_mcp::linear::solve;
use mceip_model::ContactState;
use std::ops::ControlFlow;

/// Active-set iterations of one step. A step changes a few nodes; cycling is the only reason for
/// more.
const ITERATIONS: usize = 200;

/// An equilibrium of the stepped path.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// Motion of the glued side to the left, mm.
    pub motion: f64,
    /// States of the increment that led here.
    pub states: Vec<ContactState>,
    /// (r_T, r_N) of each node, N.
    pub reactions: Vec<(f64, f64)>,
    /// (u_T, u_N) of each node, mm.
    pub displacements: Vec<(f64, f64)>,
}

impl Step {
    /// Sums of r_T and r_N over the nodes, N.
    pub fn resultants(&self) -> (f64, f64) {
        self.reactions
            .iter()
            .fold((0.0, 0.0), |s, r| (s.0 + r.0, s.1 + r.1))
    }
}

/// `count` steps of `h` mm after the pressing, which is the first entry. `progress` hears of each
/// step and may break off; the steps so far are kept.
///
/// # Errors
/// [`PathError::NotPositive`] for the loading or a step that is not positive;
/// [`PathError::StepNotConverged`].
pub fn step_path(
    contact: &Contact,
    loading: &Loading,
    h: &Rational,
    count: usize,
    progress: &dyn Fn(usize) -> ControlFlow<()>,
) -> Result<Vec<Step>, PathError> {
    Loading {
        until: Some(h.clone()),
        ..loading.clone()
    }
    .validate()?;
    let n = contact.nodes();
    let model = Model {
        s: contact
            .rows()
            .iter()
            .map(|row| row.iter().map(|v| ratio(v, contact)).collect())
            .collect(),
        mu: to_f64(&loading.friction),
    };
    let start = State {
        states: vec![ContactState::Stick; n],
        u: vec![0.0; 2 * n],
        r: vec![0.0; 2 * n],
    };
    let unit = model
        .advance(&start, 1.0, 0.0)
        .ok_or(PathError::StepNotConverged {
            step: 0,
            motion: 0.0,
            limit: ITERATIONS,
        })?;
    let pressure: f64 = -unit.r.iter().skip(1).step_by(2).sum::<f64>();
    let depth = to_f64(&loading.force) / pressure;
    let mut state = unit.scaled(depth);
    let mut steps = vec![state.step(0.0)];
    for step in 1..=count {
        if progress(step).is_break() {
            break;
        }
        let motion = to_f64(h) * step as f64;
        state = model
            .advance(&state, depth, motion)
            .ok_or(PathError::StepNotConverged {
                step,
                motion,
                limit: ITERATIONS,
            })?;
        steps.push(state.step(motion));
    }
    Ok(steps)
}

fn ratio(v: &mceip_exact::Integer, contact: &Contact) -> f64 {
    to_f64(&Rational::new_raw(v.clone(), contact.denominator().clone()))
}

struct Model {
    s: Vec<Vec<f64>>,
    mu: f64,
}

#[derive(Clone)]
struct State {
    states: Vec<ContactState>,
    u: Vec<f64>,
    r: Vec<f64>,
}

impl State {
    fn scaled(mut self, factor: f64) -> State {
        self.u
            .iter_mut()
            .chain(&mut self.r)
            .for_each(|v| *v *= factor);
        self
    }

    fn step(&self, motion: f64) -> Step {
        let pairs = |v: &[f64]| v.chunks(2).map(|p| (p[0], p[1])).collect();
        Step {
            motion,
            states: self.states.clone(),
            reactions: pairs(&self.r),
            displacements: pairs(&self.u),
        }
    }
}

impl Model {
    /// The equilibrium at (press, left) after `from`: backward Euler in the friction law.
    fn advance(&self, from: &State, press: f64, left: f64) -> Option<State> {
        let mut states = from.states.clone();
        for _ in 0..ITERATIONS {
            let next = self.equilibrium(&states, from, press, left)?;
            let size = |v: &[f64]| v.iter().fold(0.0f64, |m, x| m.max(x.abs())) * STEP_SIGN;
            let (small_u, small_r) = (size(&next.u), size(&next.r));
            let mut changed = false;
            for (k, state) in states.iter_mut().enumerate() {
                let better = self.better(*state, &next, from, k, small_u, small_r);
                changed |= better != *state;
                *state = better;
            }
            if !changed {
                return Some(next);
            }
        }
        None
    }

    /// Displacements and reactions in given states.
    fn equilibrium(
        &self,
        states: &[ContactState],
        from: &State,
        press: f64,
        left: f64,
    ) -> Option<State> {
        let n = self.s.len();
        // u = known + unknown; relative to the glued side u + shift.
        let mut u = vec![0.0; n];
        let shift = |i: usize| if i.is_multiple_of(2) { left } else { -press };
        let (mut active, mut rows) = (Vec::new(), Vec::new());
        for (k, state) in states.iter().enumerate() {
            let (t, normal) = (&self.s[2 * k], &self.s[2 * k + 1]);
            match state {
                ContactState::Stick => u[2 * k] = from.u[2 * k],
                ContactState::Slip { sign } => {
                    active.push(2 * k);
                    rows.push(
                        t.iter()
                            .zip(normal)
                            .map(|(t, n)| t + f64::from(*sign) * self.mu * n)
                            .collect::<Vec<f64>>(),
                    );
                }
                ContactState::Free => {
                    active.extend([2 * k, 2 * k + 1]);
                    rows.extend([t.clone(), normal.clone()]);
                }
            }
        }
        if !active.is_empty() {
            let right = rows
                .iter()
                .map(|row| -(0..n).map(|j| row[j] * (u[j] + shift(j))).sum::<f64>())
                .collect();
            let matrix: Vec<Vec<f64>> = rows
                .iter()
                .map(|row| active.iter().map(|&j| row[j]).collect())
                .collect();
            let z = solve(&matrix, &[right])?;
            active.iter().zip(&z[0]).for_each(|(&i, z)| u[i] = *z);
        }
        let r = self
            .s
            .iter()
            .map(|row| (0..n).map(|j| row[j] * (u[j] + shift(j))).sum())
            .collect();
        Some(State {
            states: states.to_vec(),
            u,
            r,
        })
    }

    fn better(
        &self,
        state: ContactState,
        next: &State,
        from: &State,
        k: usize,
        small_u: f64,
        small_r: f64,
    ) -> ContactState {
        let (u_n, r_t, r_n) = (next.u[2 * k + 1], next.r[2 * k], next.r[2 * k + 1]);
        let slid = next.u[2 * k] - from.u[2 * k];
        match state {
            ContactState::Free if u_n > small_u => ContactState::Stick,
            ContactState::Stick | ContactState::Slip { .. } if r_n > small_r => ContactState::Free,
            ContactState::Stick if r_t.abs() + self.mu * r_n > small_r => ContactState::Slip {
                sign: if r_t > 0.0 { 1 } else { -1 },
            },
            ContactState::Slip { sign } if f64::from(sign) * slid > small_u => ContactState::Stick,
            _ => state,
        }
    }
}
