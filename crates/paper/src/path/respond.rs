//! What the contact nodes do in given states under imposed displacements: displacements and
//! reactions by (5), solved exactly.

use super::contact::{Contact, Friction, Load, Response};
use super::linear::{Images, solve};
use mceip_exact::Integer;
use mceip_model::ContactState;
use num_traits::One;

/// Solves (5) with each node in its state: free r = 0; stick u = 0; slip u_N = 0, r_T + S mu r_N =
/// 0.
///
/// `None` if these equations are singular (mu is an eigenvalue of the state's matrix).
pub(super) fn respond(
    contact: &Contact,
    images: &mut Images,
    friction: &Friction,
    states: &[ContactState],
    loads: &[Load],
) -> Option<Response> {
    let mut active = Vec::new(); // unknown components
    let mut equations = Vec::new(); // (row T, row N) combinations, one for each unknown
    for (k, state) in states.iter().enumerate() {
        match state {
            ContactState::Stick => {}
            ContactState::Slip { sign } => {
                active.push(2 * k);
                let (t, n) = friction.on_cone(*sign);
                equations.push(vec![(2 * k, t), (2 * k + 1, n)]);
            }
            ContactState::Free => {
                active.extend([2 * k, 2 * k + 1]);
                equations.extend([
                    vec![(2 * k, Integer::one())],
                    vec![(2 * k + 1, Integer::one())],
                ]);
            }
        }
    }
    let imposed: Vec<Vec<Integer>> = loads.iter().map(|&l| contact.relative(l)).collect();
    let (denominator, relative) = solve(contact, images, &active, &equations, &imposed)?;
    let r = relative.iter().map(|w| contact.times(w)).collect();
    let back = |(w, load): (Vec<Integer>, &Load)| match load {
        Load::Held(_) => w,
        _ => {
            let g = contact.relative(*load);
            w.iter()
                .zip(&g)
                .map(|(w, g)| w - g * &denominator)
                .collect()
        }
    };
    let u = relative.into_iter().zip(loads).map(back).collect();
    Some(Response { denominator, u, r })
}
