//! The rate problem as a linear complementarity problem in doubles, for when the active set goes
//! round in circles. It proposes states; exact signs decide about them.
#![allow(clippy::float_arithmetic)]

use super::contact::{Contact, Friction, Load};
use super::line::Class;
use mceip_exact::{Rational, to_f64};
use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{Options, solve_linear};
use mceip_model::ContactState;
use nalgebra::DMatrix;

/// What an unknown of the rate problem is.
#[derive(Clone, Copy)]
enum Unknown {
    /// A component of the velocity, no sign.
    Component(usize),
    /// x = -S v_T >= 0 of a node on the cone, against y = -(S w_T + mu w_N).
    Slip(usize, f64),
    /// -v_N >= 0 of a node with zero reaction, against -w_N.
    Opening(usize),
    /// Parts of v_T >= 0 in the direction of S of a node with zero reaction: v_T = -sum S part.
    Part(usize, f64),
    /// w_T of that node, against the row that puts v_T together.
    Shear(usize),
}

/// States proposed by Lemke's method, `None` if it ends without a solution.
pub(super) fn propose(
    contact: &Contact,
    friction: &Friction,
    classes: &[Class],
    moving: Load,
) -> Option<Vec<ContactState>> {
    let mu = to_f64(&Rational::new(
        friction.numerator.clone(),
        friction.denominator.clone(),
    ));
    let unknowns: Vec<Unknown> = classes
        .iter()
        .enumerate()
        .flat_map(|(k, c)| unknowns_of(k, *c))
        .collect();
    let s = doubles(contact);
    let g: Vec<f64> = contact
        .relative(moving)
        .iter()
        .map(|v| to_f64(&Rational::from_integer(v.clone())))
        .collect();
    let problem = assemble(&s, &g, &unknowns, mu)?;
    let outcome = solve_linear(&problem, &Options::default()).ok()?;
    outcome
        .termination
        .reached_tolerance()
        .then(|| states_of(&unknowns, &outcome.point, classes))
}

/// The condensed stiffness in doubles, N/mm, divided by its largest entry.
fn doubles(contact: &Contact) -> DMatrix<f64> {
    let n = contact.rows().len();
    let s = DMatrix::from_fn(n, n, |i, j| {
        to_f64(&Rational::new_raw(
            contact.rows()[i][j].clone(),
            contact.denominator().clone(),
        ))
    });
    let largest = s.amax();
    s / largest
}

fn unknowns_of(k: usize, class: Class) -> Vec<Unknown> {
    match class {
        Class::Free => vec![Unknown::Component(2 * k), Unknown::Component(2 * k + 1)],
        Class::Stick => Vec::new(),
        Class::Cone(sign) => vec![Unknown::Slip(k, f64::from(sign))],
        Class::Zero => {
            vec![
                Unknown::Component(2 * k),
                Unknown::Opening(k),
                Unknown::Part(k, 1.0),
                Unknown::Part(k, -1.0),
                Unknown::Shear(k),
            ]
        }
    }
}

/// F(z) = M z + q. Velocities enter through v = sum of (component, factor) of each unknown.
fn assemble(s: &DMatrix<f64>, g: &[f64], unknowns: &[Unknown], mu: f64) -> Option<LinearMcp> {
    let n = unknowns.len();
    let velocity = |u: &Unknown| match *u {
        Unknown::Component(i) => Some((i, 1.0)),
        Unknown::Slip(k, sign) => Some((2 * k, -sign)),
        Unknown::Opening(k) => Some((2 * k + 1, -1.0)),
        Unknown::Part(..) | Unknown::Shear(_) => None,
    };
    let has_shear = |i: usize| {
        unknowns
            .iter()
            .position(|u| matches!(u, Unknown::Shear(k) if 2 * k == i))
    };
    let place = |i: usize| {
        unknowns
            .iter()
            .position(|u| matches!(u, Unknown::Component(c) if *c == i))
    };
    let (mut m, mut q) = (DMatrix::zeros(n, n), vec![0.0; n]);
    // w_i = sum_j S_ij v_j + (S g)_i, added to row `row` with a factor.
    let mut add = |m: &mut DMatrix<f64>, row: usize, i: usize, factor: f64| {
        for (col, u) in unknowns.iter().enumerate() {
            if let Some((j, c)) = velocity(u) {
                m[(row, col)] += factor * s[(i, j)] * c;
            }
        }
        q[row] += factor
            * g.iter()
                .enumerate()
                .map(|(j, g)| s[(i, j)] * g)
                .sum::<f64>();
    };
    for (row, u) in unknowns.iter().enumerate() {
        match *u {
            Unknown::Component(i) => {
                add(&mut m, row, i, 1.0);
                if let Some(shear) = has_shear(i) {
                    m[(row, shear)] -= 1.0; // (S v)_T - w_T = 0
                }
            }
            Unknown::Slip(k, sign) => {
                add(&mut m, row, 2 * k, -sign);
                add(&mut m, row, 2 * k + 1, -mu);
            }
            Unknown::Opening(k) => add(&mut m, row, 2 * k + 1, -1.0),
            Unknown::Part(k, sign) => {
                add(&mut m, row, 2 * k + 1, -mu); // -mu w_N - S w_T >= 0
                m[(row, has_shear(2 * k)?)] -= sign;
            }
            Unknown::Shear(k) => {
                m[(row, place(2 * k)?)] += 1.0; // v_T + sum S part = 0
                for (col, part) in unknowns.iter().enumerate() {
                    if let Unknown::Part(node, sign) = part {
                        m[(row, col)] += if *node == k { *sign } else { 0.0 };
                    }
                }
            }
        }
    }
    let signed = |u: &Unknown| {
        matches!(
            u,
            Unknown::Slip(..) | Unknown::Opening(_) | Unknown::Part(..)
        )
    };
    let lower = unknowns
        .iter()
        .map(|u| if signed(u) { 0.0 } else { f64::NEG_INFINITY })
        .collect();
    LinearMcp::new(m, q, lower, vec![f64::INFINITY; n]).ok()
}

/// Positive unknowns name the states; the exact active set corrects what rounding blurs.
fn states_of(unknowns: &[Unknown], z: &[f64], classes: &[Class]) -> Vec<ContactState> {
    let mut states: Vec<ContactState> = classes
        .iter()
        .map(|c| {
            if *c == Class::Free {
                ContactState::Free
            } else {
                ContactState::Stick
            }
        })
        .collect();
    for (u, &value) in unknowns.iter().zip(z) {
        match *u {
            Unknown::Slip(k, sign) | Unknown::Part(k, sign)
                if value > 0.0 && states[k] != ContactState::Free =>
            {
                states[k] = ContactState::Slip {
                    sign: if sign > 0.0 { 1 } else { -1 },
                };
            }
            Unknown::Opening(k) if value > 0.0 => states[k] = ContactState::Free,
            _ => {}
        }
    }
    states
}
