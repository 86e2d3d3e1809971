//! Certificates of contact states against plain elimination on the uncondensed body.
//!
//! For every combination of contact states the displacements and reactions under a load are
//! eliminated in fractions and held against (1), (2), (7) as they are defined. A certificate has to
//! be found, and accepted, exactly where they hold.
#![cfg(feature = "solver")]

use crate::loads::{Instance, Rates, in_states};
use mceip_check::certificate::{SlipSign, StatedEquilibrium, StatedState};
use mceip_engine::equilibrium::certify_equilibrium;
use mceip_exact::{Rational, rational, whole};
use mceip_model::ContactState;
use mceip_model::file::Number;
use mceip_path::{Equilibrium, LoadingPath, Stretch};
use num_traits::{Signed, Zero};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;

const STATES: [ContactState; 5] = [
    ContactState::Free,
    ContactState::Stick,
    ContactState::Slip { sign: 1 },
    ContactState::Slip { sign: -1 },
    ContactState::Zero,
];

/// Do (1) and (7) hold of (u_T, u_N), (r_T, r_N), strictly where the state says so?
fn holds(
    state: ContactState,
    [_, u_n, r_t, r_n]: &[Rational; 4],
    mu: &Rational,
    gap: &Rational,
) -> bool {
    let limit = -(mu * r_n);
    match state {
        ContactState::Free => u_n < gap && r_t.is_zero() && r_n.is_zero(),
        ContactState::Stick => u_n == gap && r_n.is_negative() && r_t.abs() < limit,
        ContactState::Slip { sign } => {
            u_n == gap && r_n.is_negative() && r_t * whole(sign.into()) == limit
        }
        ContactState::Zero => u_n == gap && r_t.is_zero() && r_n.is_zero(),
    }
}

fn is_equilibrium(instance: &Instance, states: &[ContactState], found: &Rates) -> bool {
    let gaps = instance.body.gaps();
    (0..2).all(|k| holds(states[k], &found[k], &instance.mu(k), &gaps[k]))
}

fn stated(
    friction: &Rational,
    amounts: Vec<Rational>,
    states: &[ContactState],
    places: &[Rational],
) -> StatedEquilibrium {
    let state = |k: usize| match states[k] {
        ContactState::Free => StatedState::Free {},
        ContactState::Zero => StatedState::Zero {},
        ContactState::Slip { sign } => StatedState::Slip {
            sign: SlipSign::of(sign),
        },
        ContactState::Stick => StatedState::Stick {
            tangential: Number(places[k].clone()),
        },
    };
    StatedEquilibrium {
        friction: friction.clone(),
        amounts,
        candidates: (0..states.len()).map(state).collect(),
    }
}

/// Every combination of states under the loads of an equilibrium of the path; what sticks does so
/// where the path has it.
fn compare(
    instance: &Instance,
    path: &LoadingPath,
    stretch: &Stretch,
    at: &Equilibrium,
    met: &mut BTreeMap<&'static str, usize>,
) {
    let amounts = path.applied_at(stretch, at);
    let mut load = vec![whole(0); instance.body.system().dofs()];
    for (amount, step) in amounts.iter().zip(instance.body.loads()) {
        for (sum, value) in load.iter_mut().zip(step) {
            *sum += amount * value;
        }
    }
    let places = [0, 1].map(|k| at.displacement(k).0);
    let gaps = instance.body.gaps();
    let given = [0, 1].map(|k| [places[k].clone(), gaps[k].clone()]);

    for first in STATES {
        for second in STATES {
            let states = [first, second];
            let found = in_states(instance, &states, &load, &given);
            let is_true = found.is_some_and(|found| is_equilibrium(instance, &states, &found));
            let stated = stated(&instance.friction, amounts.clone(), &states, &places);
            let certified = certify_equilibrium(&instance.body, stated);
            assert_eq!(certified.is_ok(), is_true, "{states:?}: {certified:?}");

            if states == *at.contact_states() {
                assert!(is_true, "the path has {states:?}");
            } else if is_true {
                *met.entry("other states of the same loads").or_default() += 1;
            }
            if is_true {
                *met.entry(first.word()).or_default() += 1;
            } else {
                *met.entry("refused").or_default() += 1;
            }
        }
    }
}

#[test]
fn states_are_certified_exactly_where_they_hold() {
    let mut met = BTreeMap::new();
    for seed in 0..60 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let instance = Instance::random(&mut rng);
        let path = instance.follow();
        for stretch in &path.stretches {
            compare(&instance, &path, stretch, &stretch.inside, &mut met);
            compare(&instance, &path, stretch, &stretch.start, &mut met);
        }
    }

    println!("{met:?}");
    for what in [
        "free",
        "stick",
        "slip",
        "zero",
        "refused",
        "other states of the same loads",
    ] {
        let times = met.get(what).copied().unwrap_or_default();
        assert!(times > 20, "{what} met {times} times: {met:?}");
    }
}

/// A statement that holds is none about a body with another load, another gap or more friction.
#[test]
fn a_certificate_is_bound_to_its_body() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let one = Instance::random(&mut rng);
    let other = Instance::random(&mut rng);
    let path = one.follow();
    let stretch = path.stretches.last().unwrap();
    let at = &stretch.inside;
    let places = [0, 1].map(|k| at.displacement(k).0);
    let stated = stated(
        &one.friction,
        path.applied_at(stretch, at),
        at.contact_states(),
        &places,
    );

    let proved = certify_equilibrium(&one.body, stated).unwrap();
    let certificate = proved.certificate().clone();
    assert!(mceip_check::check_equilibrium(&one.body, &certificate).is_ok());
    assert!(mceip_check::check_equilibrium(&other.body, &certificate).is_err());

    let mut more = certificate;
    more.stated.friction += rational(1, 1_000_000);
    let has_slip = at
        .contact_states()
        .iter()
        .any(|state| matches!(state, ContactState::Slip { .. }));
    assert_eq!(
        mceip_check::check_equilibrium(&one.body, &more).is_err(),
        has_slip
    );
}
