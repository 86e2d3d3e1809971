//! The contact states of a path as statements that the checker has accepted.
//!
//! A path is exact, but it is the work of `mceip_path` alone. What can be said of one of its
//! equilibria without that program is `mceip-equilibrium/1`: under these loads, with this friction,
//! the body has an equilibrium in these contact states.

use mceip_check::Proved;
use mceip_check::certificate::{EquilibriumCertificate, StatedEquilibrium, StatedState};
use mceip_engine::equilibrium::{Uncertified, certify_equilibrium};
use mceip_exact::{Rational, from_f64, to_f64};
use mceip_model::file::Number;
use mceip_model::{ContactState, LoadedBody};
use mceip_path::{Equilibrium, LoadingPath, Stretch};

/// Contact states that are proved to be those of an equilibrium, or why they are not.
pub(super) type Certified = Result<Proved<EquilibriumCertificate>, Uncertified>;

/// Certifies the contact states of an equilibrium of a stretch.
pub(super) fn certify(
    body: &LoadedBody,
    path: &LoadingPath,
    stretch: &Stretch,
    equilibrium: &Equilibrium,
) -> Certified {
    certify_equilibrium(body, stated(path, stretch, equilibrium))
}

fn stated(path: &LoadingPath, stretch: &Stretch, equilibrium: &Equilibrium) -> StatedEquilibrium {
    let states = equilibrium.contact_states();
    // Without reaction a candidate is on the edge of opening: nothing may be rounded.
    let is_degenerate = states.contains(&ContactState::Zero);

    let mut candidates = Vec::with_capacity(states.len());
    for (node, state) in states.iter().enumerate() {
        candidates.push(match *state {
            ContactState::Free => StatedState::Free {},
            ContactState::Zero => StatedState::Zero {},
            ContactState::Slip { sign } => StatedState::Slip { sign },
            ContactState::Stick => {
                let (tangential, _) = equilibrium.displacement(node);
                let tangential = if is_degenerate {
                    tangential
                } else {
                    short(tangential)
                };
                StatedState::Stick {
                    tangential: Number(tangential),
                }
            }
        });
    }

    StatedEquilibrium {
        friction: path.steps.friction.clone(),
        amounts: path.applied_at(stretch, equilibrium),
        candidates,
    }
}

/// Bits of a fraction up to which it is stated as it is.
const SHORT: u64 = 128;

/// The number itself where it is short, else the nearest double: a candidate inside its friction
/// cone sticks there as well.
fn short(value: Rational) -> Rational {
    if value.numer().bits() + value.denom().bits() <= SHORT {
        return value;
    }

    from_f64(to_f64(&value)).unwrap_or(value)
}
