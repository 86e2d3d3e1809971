//! What the contact nodes do in given states under imposed displacements: displacements and
//! reactions by (5), solved exactly.
//!
//! Each state gives two conditions: free r = 0; stick u = 0; slip u_N = 0, r_T + S mu r_N = 0,
//! where S is the sign of r_T. The unknowns are therefore u_T and u_N of free nodes and u_T of slip
//! nodes. Called by `rates`.

use super::contact::{Contact, Friction, Load, Response};
use super::linear::{ContactEquations, Equation, Images, Term, no_reaction};
use mceip_exact::Integer;
use mceip_model::ContactState;

/// Solves (5) with each node in its state, for each load alone.
///
/// `None` if these equations are singular (mu is an eigenvalue of the state's matrix).
pub(super) fn respond(
    contact: &Contact,
    images: &mut Images,
    friction: &Friction,
    states: &[ContactState],
    loads: &[Load],
) -> Option<Response> {
    let mut active = Vec::new();
    let mut equations = Vec::new();
    for (node, state) in states.iter().enumerate() {
        let tangential = 2 * node;
        let normal = 2 * node + 1;
        match state {
            ContactState::Stick => {}
            ContactState::Slip { sign } => {
                active.push(tangential);
                equations.push(on_cone(node, friction, *sign));
            }
            ContactState::Free | ContactState::Zero => {
                active.extend([tangential, normal]);
                equations.extend([no_reaction(tangential), no_reaction(normal)]);
            }
        }
    }

    let imposed = loads.iter().map(|&load| contact.relative(load)).collect();
    let equations = ContactEquations {
        contact,
        active,
        equations,
        imposed,
    };
    let solved = equations.solve(images)?;

    let r = solved.w.iter().map(|w| contact.times(w)).collect();
    let mut u = Vec::with_capacity(loads.len());
    for (relative, load) in solved.w.into_iter().zip(loads) {
        u.push(absolute(relative, *load, &solved.denominator, contact));
    }

    Some(Response {
        denominator: solved.denominator,
        u,
        r,
    })
}

/// r_T + S mu r_N = 0. // (7)
fn on_cone(node: usize, friction: &Friction, sign: i8) -> Equation {
    let row = friction.on_cone(sign);
    vec![
        Term {
            row: 2 * node,
            coefficient: row.tangential,
        },
        Term {
            row: 2 * node + 1,
            coefficient: row.normal,
        },
    ]
}

/// Displacements u = w + g from those relative to the glued side. A held node displaces no glued
/// side: there u = w.
fn absolute(
    relative: Vec<Integer>,
    load: Load,
    denominator: &Integer,
    contact: &Contact,
) -> Vec<Integer> {
    if matches!(load, Load::Held(_)) {
        return relative;
    }

    let imposed = contact.relative(load); // -g
    let mut u = Vec::with_capacity(relative.len());
    for (w, imposed) in relative.iter().zip(&imposed) {
        u.push(w - imposed * denominator);
    }

    u
}
