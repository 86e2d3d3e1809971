//! The rate problem as a linear complementarity problem in doubles, for when the active set comes
//! back to states it has tried. It proposes states; exact signs decide about them.
//!
//! Rates v of the displacements and w = C v - h of the reactions, in units of the largest entry of
//! the condensed stiffness C; h is the load that grows. Each node contributes unknowns and rows by
//! its class
//! ([`RateUnknown`]); a row is F_i = 0 for an unknown without a sign and 0 <= z_i _|_ F_i >= 0 for
//! one with a sign, F(z) = M z + q. Lemke's method of `mceip_mcp` solves it, and positive unknowns
//! name the states. Called by `rates`.
#![allow(clippy::float_arithmetic)]

use super::contact::{Contact, FrictionCoefficients, Load};
use super::line::Class;
use mceip_exact::to_f64;
use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{Options, solve_linear};
use mceip_model::ContactState;
use nalgebra::DMatrix;

/// What an unknown of the rate problem is. Signs S are 1.0 or -1.0.
#[derive(Clone, Copy)]
enum RateUnknown {
    /// A component of the velocity, no sign.
    Component(usize),
    /// x = -S v_T >= 0 of a node on the cone, against y = -(S r_T' + mu r_N').
    Slip { node: usize, sign: f64 },
    /// -v_N >= 0 of a node with zero reaction, against -w_N.
    Opening { node: usize },
    /// Parts of v_T >= 0 against the direction of S of a node with zero reaction: v_T = -sum S
    /// part.
    Part { node: usize, sign: f64 },
    /// w_T of that node, against the row that puts v_T together.
    Shear { node: usize },
}

impl RateUnknown {
    /// The component of v to which it contributes, and the factor.
    fn velocity(self) -> Option<(usize, f64)> {
        match self {
            RateUnknown::Component(i) => Some((i, 1.0)),
            RateUnknown::Slip { node, sign } => Some((2 * node, -sign)),
            RateUnknown::Opening { node } => Some((2 * node + 1, -1.0)),
            RateUnknown::Part { .. } | RateUnknown::Shear { .. } => None,
        }
    }

    fn lower_bound(self) -> f64 {
        match self {
            RateUnknown::Slip { .. } | RateUnknown::Opening { .. } | RateUnknown::Part { .. } => {
                0.0
            }
            RateUnknown::Component(_) | RateUnknown::Shear { .. } => f64::NEG_INFINITY,
        }
    }
}

/// States proposed by Lemke's method, `None` if it ends without a solution.
pub(super) fn propose(
    contact: &Contact,
    friction: &FrictionCoefficients,
    classes: &[Class],
    growing: Load,
) -> Option<Vec<ContactState>> {
    let mut unknowns = Vec::new();
    for (node, &class) in classes.iter().enumerate() {
        unknowns.extend(unknowns_of(node, class));
    }

    let scaled = scaled_rows(contact);
    let growing = contact.component(growing);
    // The problem is homogeneous in the load: its size plays no part, but for tolerances.
    let load = scaled.column(growing);
    let size = load.amax();
    let load = load.iter().map(|h| if size > 0.0 { h / size } else { 0.0 });
    let order = 2 * contact.nodes();
    let rows = RateRows {
        stiffness: scaled.columns(0, order).into_owned(),
        load: load.collect(),
        friction: (0..contact.nodes())
            .map(|node| to_f64(friction.of(node)))
            .collect(),
        matrix: DMatrix::zeros(unknowns.len(), unknowns.len()),
        constant: vec![0.0; unknowns.len()],
        unknowns: &unknowns,
    };
    let problem = rows.assemble()?;

    let outcome = solve_linear(&problem, &Options::default()).ok()?;
    outcome
        .termination
        .reached_tolerance()
        .then(|| states_of(&unknowns, &outcome.point, classes))
}

/// [C, -h_1, ...] in doubles, divided by the largest entry of C.
fn scaled_rows(contact: &Contact) -> DMatrix<f64> {
    let rows = contact.rows_f64();
    let order = rows.len();
    let matrix = DMatrix::from_fn(order, contact.columns(), |i, j| rows[i][j]);

    let largest = matrix.columns(0, order).amax();
    matrix / largest
}

fn unknowns_of(node: usize, class: Class) -> Vec<RateUnknown> {
    let tangential = RateUnknown::Component(2 * node);
    let normal = RateUnknown::Component(2 * node + 1);
    match class {
        Class::Free => vec![tangential, normal],
        Class::Stick => Vec::new(),
        Class::Cone(sign) => vec![RateUnknown::Slip {
            node,
            sign: f64::from(sign),
        }],
        Class::Zero => vec![
            tangential,
            RateUnknown::Opening { node },
            RateUnknown::Part { node, sign: 1.0 },
            RateUnknown::Part { node, sign: -1.0 },
            RateUnknown::Shear { node },
        ],
    }
}

/// The rows F(z) = M z + q of the complementarity problem, while they are assembled.
struct RateRows<'a> {
    /// C, scaled.
    stiffness: DMatrix<f64>,
    /// -h, divided by its largest entry.
    load: Vec<f64>,
    /// Coefficient of friction of each candidate.
    friction: Vec<f64>,
    unknowns: &'a [RateUnknown],
    /// M.
    matrix: DMatrix<f64>,
    /// q.
    constant: Vec<f64>,
}

impl RateRows<'_> {
    /// Assembles every row. `None` for a matrix that is no problem (an entry that is not finite).
    fn assemble(mut self) -> Option<LinearMcp> {
        for (row, &unknown) in self.unknowns.iter().enumerate() {
            match unknown {
                RateUnknown::Component(i) => self.set_equilibrium(row, i),
                RateUnknown::Slip { node, sign } => {
                    self.add_reaction(row, 2 * node, -sign);
                    self.add_reaction(row, 2 * node + 1, -self.friction[node]);
                }
                RateUnknown::Opening { node } => self.add_reaction(row, 2 * node + 1, -1.0),
                RateUnknown::Part { node, sign } => self.set_cone(row, node, sign)?,
                RateUnknown::Shear { node } => self.set_velocity(row, node)?,
            }
        }

        let lower = self.unknowns.iter().map(|u| u.lower_bound()).collect();
        let upper = vec![f64::INFINITY; self.unknowns.len()];
        LinearMcp::new(self.matrix, self.constant, lower, upper).ok()
    }

    /// w_i = 0; for the tangential component of a node with zero reaction: (C v)_T - w_T = 0.
    fn set_equilibrium(&mut self, row: usize, component: usize) {
        self.add_reaction(row, component, 1.0);
        if let Some(shear) = self.shear_of(component) {
            self.matrix[(row, shear)] -= 1.0;
        }
    }

    /// -mu w_N - S w_T >= 0.
    fn set_cone(&mut self, row: usize, node: usize, sign: f64) -> Option<()> {
        self.add_reaction(row, 2 * node + 1, -self.friction[node]);
        let shear = self.shear_of(2 * node)?;
        self.matrix[(row, shear)] -= sign;
        Some(())
    }

    /// v_T + sum S part = 0.
    fn set_velocity(&mut self, row: usize, node: usize) -> Option<()> {
        let tangential = self.place_of(2 * node)?;
        self.matrix[(row, tangential)] += 1.0;
        for (column, unknown) in self.unknowns.iter().enumerate() {
            match unknown {
                RateUnknown::Part { node: of, sign } if *of == node => {
                    self.matrix[(row, column)] += *sign
                }
                _ => {}
            }
        }

        Some(())
    }

    /// Adds factor * w_i, w_i = sum_j C_ij v_j - h_i, to a row.
    fn add_reaction(&mut self, row: usize, i: usize, factor: f64) {
        for (column, unknown) in self.unknowns.iter().enumerate() {
            if let Some((j, share)) = unknown.velocity() {
                self.matrix[(row, column)] += factor * self.stiffness[(i, j)] * share;
            }
        }

        self.constant[row] += factor * self.load[i];
    }

    /// Place of the unknown w_T of the node whose tangential component this is.
    fn shear_of(&self, component: usize) -> Option<usize> {
        self.unknowns
            .iter()
            .position(|u| matches!(u, RateUnknown::Shear { node } if 2 * node == component))
    }

    /// Place of the unknown that is this component of the velocity.
    fn place_of(&self, component: usize) -> Option<usize> {
        self.unknowns
            .iter()
            .position(|u| matches!(u, RateUnknown::Component(c) if *c == component))
    }
}

/// Positive unknowns name the states; the exact active set corrects what rounding blurs.
fn states_of(unknowns: &[RateUnknown], z: &[f64], classes: &[Class]) -> Vec<ContactState> {
    let mut states: Vec<ContactState> = classes.iter().map(state_at_zero).collect();

    let positive = unknowns.iter().zip(z).filter(|(_, value)| **value > 0.0);
    for (unknown, _) in positive {
        match *unknown {
            RateUnknown::Slip { node, sign } | RateUnknown::Part { node, sign }
                if states[node] != ContactState::Free =>
            {
                let sign = if sign > 0.0 { 1 } else { -1 };
                states[node] = ContactState::Slip { sign };
            }
            RateUnknown::Opening { node } => states[node] = ContactState::Free,
            _ => {}
        }
    }

    states
}

/// The state of a node whose unknowns with a sign are all zero.
fn state_at_zero(class: &Class) -> ContactState {
    if *class == Class::Free {
        ContactState::Free
    } else {
        ContactState::Stick
    }
}
