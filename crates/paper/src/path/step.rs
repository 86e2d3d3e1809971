//! Ordinary incremental stepping in doubles, for comparison: equal steps of the motion, at each an
//! active set from the step before. What happens within a step is lost.
//!
//! A step solves r = C u - sum_l a_l h_l ([`Contact`]) for the displacements u at the new amounts
//! a_l of the loads, the places of the glued side, with these conditions by state: stick: u_T as
//! before and u_N = 0; slip: u_N = 0, r_T + S mu r_N = 0, where S is the sign of r_T; free: r = 0.
//! As in (1), u_N <= 0 without penetration and r_N <= 0 is pressure. States that the solution
//! contradicts are changed and the step is solved again (backward Euler in the friction law).
//! `mceip block --path` sets the result beside the exact path.
#![allow(clippy::float_arithmetic)]

use super::block_path::{MOVE, PRESS};
use super::error::BlockPathError;
use super::loading::Loading;
use crate::tolerance::STEP_SIGN;
use mceip_exact::{Rational, to_f64};
use mceip_mcp::linear::solve;
use mceip_model::ContactState;
use mceip_path::Contact;
use std::ops::ControlFlow;

/// Active-set iterations of one step. A step changes a few nodes, so that more iterations mean that
/// the states repeat.
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
        let mut tangential = 0.0;
        let mut normal = 0.0;
        for reaction in &self.reactions {
            tangential += reaction.0;
            normal += reaction.1;
        }

        (tangential, normal)
    }
}

/// `count` steps of `h` mm after the pressing, which is the first entry. `progress` hears of each
/// step and may break off; the steps so far are kept.
///
/// # Errors
/// [`mceip_path::PathError::NotPositive`] for the loading or a step that is not positive;
/// [`BlockPathError::StepNotConverged`].
pub fn step_path(
    contact: &Contact,
    loading: &Loading,
    h: &Rational,
    count: usize,
    progress: &dyn Fn(usize) -> ControlFlow<()>,
) -> Result<Vec<Step>, BlockPathError> {
    let stepped = Loading {
        until: Some(h.clone()),
        ..loading.clone()
    };
    stepped.validate()?;

    let model = CondensedBlock::new(contact, loading);
    let mut state = model.press(to_f64(&loading.force))?;
    let depth = state.glued.press;

    let mut steps = vec![state.step()];
    for step in 1..=count {
        if progress(step).is_break() {
            break;
        }

        let glued = GluedSide {
            press: depth,
            left: to_f64(h) * step as f64,
        };
        state = model.advance(&state, glued, step)?;
        steps.push(state.step());
    }

    Ok(steps)
}

/// Where the glued side is, mm from its unloaded place.
#[derive(Clone, Copy)]
struct GluedSide {
    /// Towards the obstacle.
    press: f64,
    /// To the left.
    left: f64,
}

impl GluedSide {
    /// The reaction that a row [C, -h_1, -h_2, 0] of the contact gives for displacements u.
    fn reaction(self, row: &[f64], u: &[f64]) -> f64 {
        let loads = &row[u.len()..];
        dot(&row[..u.len()], u) + loads[PRESS] * self.press + loads[MOVE] * self.left
    }
}

/// An equilibrium, with the states that led to it. Components as in [`Contact`].
#[derive(Clone)]
struct SteppedEquilibrium {
    glued: GluedSide,
    states: Vec<ContactState>,
    /// Displacements, mm.
    u: Vec<f64>,
    /// Reactions, N.
    r: Vec<f64>,
}

impl SteppedEquilibrium {
    fn step(&self) -> Step {
        Step {
            motion: self.glued.left,
            states: self.states.clone(),
            reactions: by_node(&self.r),
            displacements: by_node(&self.u),
        }
    }
}

/// The tangential and the normal component of each node.
fn by_node(components: &[f64]) -> Vec<(f64, f64)> {
    components
        .chunks(2)
        .map(|node| (node[0], node[1]))
        .collect()
}

/// The condensed block and its friction.
struct CondensedBlock {
    /// [C, -h_1, -h_2, 0], N/mm.
    rows: Vec<Vec<f64>>,
    mu: f64,
}

impl CondensedBlock {
    fn new(contact: &Contact, loading: &Loading) -> CondensedBlock {
        CondensedBlock {
            rows: contact.rows_f64(),
            mu: to_f64(&loading.friction),
        }
    }

    /// The unloaded block pressed until the normal resultant is -force: proportional to the
    /// depth, so it is solved for 1 mm and scaled.
    fn press(&self, force: f64) -> Result<SteppedEquilibrium, BlockPathError> {
        let components = self.rows.len();
        let unloaded = SteppedEquilibrium {
            glued: GluedSide {
                press: 0.0,
                left: 0.0,
            },
            states: vec![ContactState::Stick; components / 2],
            u: vec![0.0; components],
            r: vec![0.0; components],
        };
        let one_mm = GluedSide {
            press: 1.0,
            left: 0.0,
        };
        let mut state = self.advance(&unloaded, one_mm, 0)?;

        let normal_reactions = state.r.iter().skip(1).step_by(2);
        let per_mm: f64 = -normal_reactions.sum::<f64>();
        let depth = force / per_mm;
        for value in state.u.iter_mut().chain(&mut state.r) {
            *value *= depth;
        }

        state.glued.press = depth;
        Ok(state)
    }

    /// The equilibrium with the glued side at its new place, after `from`; `step` is named in the
    /// error.
    fn advance(
        &self,
        from: &SteppedEquilibrium,
        glued: GluedSide,
        step: usize,
    ) -> Result<SteppedEquilibrium, BlockPathError> {
        self.converge(from, glued)
            .ok_or(BlockPathError::StepNotConverged {
                step,
                motion: glued.left,
                limit: ITERATIONS,
            })
    }

    /// Changes states until the equilibrium contradicts none of them. `None` for singular
    /// equations, and after too many iterations.
    fn converge(&self, from: &SteppedEquilibrium, glued: GluedSide) -> Option<SteppedEquilibrium> {
        let mut states = from.states.clone();

        for _ in 0..ITERATIONS {
            let next = self.equilibrium(&states, from, glued)?;
            let increment = Increment {
                mu: self.mu,
                from,
                next: &next,
                small_u: largest(&next.u) * STEP_SIGN,
                small_r: largest(&next.r) * STEP_SIGN,
            };

            let mut changed = false;
            for (node, state) in states.iter_mut().enumerate() {
                let better = increment.better(node, *state);
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
        from: &SteppedEquilibrium,
        glued: GluedSide,
    ) -> Option<SteppedEquilibrium> {
        let Conditions {
            mut u,
            active,
            rows,
        } = self.conditions(states, from);

        if !active.is_empty() {
            let right = rows.iter().map(|row| -glued.reaction(row, &u)).collect();
            let mut matrix = Vec::with_capacity(rows.len());
            for row in &rows {
                let coefficients: Vec<f64> = active.iter().map(|&j| row[j]).collect();
                matrix.push(coefficients);
            }

            let solved = solve(&matrix, &[right])?;
            for (&component, value) in active.iter().zip(&solved[0]) {
                u[component] = *value;
            }
        }

        let rows = self.rows.iter();
        let r = rows.map(|row| glued.reaction(row, &u)).collect();
        Some(SteppedEquilibrium {
            glued,
            states: states.to_vec(),
            u,
            r,
        })
    }

    /// What the states say of displacements and reactions.
    fn conditions(&self, states: &[ContactState], from: &SteppedEquilibrium) -> Conditions {
        let mut conditions = Conditions {
            u: vec![0.0; self.rows.len()],
            active: Vec::new(),
            rows: Vec::new(),
        };

        for (node, state) in states.iter().enumerate() {
            let tangential = 2 * node;
            let normal = 2 * node + 1;
            match state {
                ContactState::Stick => conditions.u[tangential] = from.u[tangential],
                ContactState::Slip { sign } => {
                    conditions.active.push(tangential);
                    conditions.rows.push(self.slip_row(node, *sign));
                }
                ContactState::Free | ContactState::Zero => {
                    for component in [tangential, normal] {
                        conditions.active.push(component);
                        conditions.rows.push(self.rows[component].clone());
                    }
                }
            }
        }

        conditions
    }

    /// The row of r_T + S mu r_N. // (7)
    fn slip_row(&self, node: usize, sign: i8) -> Vec<f64> {
        let factor = f64::from(sign) * self.mu;
        let tangential = &self.rows[2 * node];
        let normal = &self.rows[2 * node + 1];

        let entries = tangential.iter().zip(normal);
        entries.map(|(t, n)| t + factor * n).collect()
    }
}

/// The equations of an equilibrium in given states.
struct Conditions {
    /// The known components of the displacements; zero for the active ones.
    u: Vec<f64>,
    /// The unknown components.
    active: Vec<usize>,
    /// A combination of rows of the contact that vanishes, one for each unknown.
    rows: Vec<Vec<f64>>,
}

fn dot(row: &[f64], vector: &[f64]) -> f64 {
    row.iter().zip(vector).map(|(a, b)| a * b).sum()
}

/// The largest absolute value.
fn largest(values: &[f64]) -> f64 {
    let mut largest: f64 = 0.0;
    for value in values {
        largest = largest.max(value.abs());
    }

    largest
}

/// The equilibria before and after a step.
struct Increment<'a> {
    mu: f64,
    from: &'a SteppedEquilibrium,
    next: &'a SteppedEquilibrium,
    /// Displacements below this count as zero, mm.
    small_u: f64,
    /// Reactions below this count as zero, N.
    small_r: f64,
}

impl Increment<'_> {
    /// The state to take instead if the equilibrium contradicts this one, else the same.
    fn better(&self, node: usize, state: ContactState) -> ContactState {
        let u_n = self.next.u[2 * node + 1];
        let r_t = self.next.r[2 * node];
        let r_n = self.next.r[2 * node + 1];
        let slid = self.next.u[2 * node] - self.from.u[2 * node];

        let in_contact = state != ContactState::Free;
        if in_contact && r_n > self.small_r {
            return ContactState::Free;
        }

        match state {
            ContactState::Free if u_n > self.small_u => ContactState::Stick,
            ContactState::Stick if r_t.abs() + self.mu * r_n > self.small_r => {
                let sign = if r_t > 0.0 { 1 } else { -1 };
                ContactState::Slip { sign }
            }
            ContactState::Slip { sign } if f64::from(sign) * slid > self.small_u => {
                ContactState::Stick
            }
            _ => state,
        }
    }
}
