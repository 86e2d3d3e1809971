//! What the contact candidates do in given states under given loads: displacements and reactions by
//! (5), solved exactly.
//!
//! Each state gives two conditions: free r = 0; stick w = 0; slip w_N = 0, r_T + S mu r_N = 0,
//! where S is the sign of r_T. The unknowns are therefore w_T and w_N of free candidates and w_T of
//! slip candidates. Called by `rates`.

use super::contact::{Contact, FrictionCoefficients, Load, Response};
use super::linear::{ContactEquations, Equation, Images, Term, no_reaction};
use mceip_model::ContactState;

/// Solves (5) with each candidate in its state, for each load alone.
///
/// `None` if these equations are singular (mu is an eigenvalue of the state's matrix).
pub(super) fn respond(
    contact: &Contact,
    images: &mut Images,
    friction: &FrictionCoefficients,
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

    let imposed = loads.iter().map(|&load| contact.unit(load)).collect();
    let equations = ContactEquations {
        contact,
        active,
        equations,
        imposed,
    };
    let solved = equations.solve(images)?;

    let r = solved.w.iter().map(|w| contact.times(w)).collect();
    Some(Response {
        denominator: solved.denominator,
        w: solved.w,
        r,
    })
}

/// r_T + S mu r_N = 0. // (7)
fn on_cone(node: usize, friction: &FrictionCoefficients, sign: i8) -> Equation {
    let row = friction.on_cone(node, sign);
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
