//! The rate problem against plain enumeration: every set of states tried by elimination in
//! fractions, the lines of (9) written out. For tests; shares nothing with the solver.

use super::contact::{Contact, Friction, Load};
use super::error::PathError;
use super::line::Class;
use super::linear::Images;
use super::propose::propose;
use super::rates::{Finder, Rates};
use mceip_exact::{Rational, Sparse, whole};
use mceip_model::ContactState;
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;

/// A small deterministic generator of integers in [-k, k].
struct Dice(u64);

impl Dice {
    fn roll(&mut self, k: i64) -> i64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % (2 * k as u64 + 1)) as i64 - k
    }
}

/// B'B + I in (T, N) of each node: symmetric positive definite, with strong coupling of T and N.
fn random_stiffness(dice: &mut Dice, n: usize) -> Vec<Vec<i64>> {
    let b: Vec<Vec<i64>> = (0..n)
        .map(|_| (0..n).map(|_| dice.roll(4)).collect())
        .collect();
    (0..n)
        .map(|i| {
            (0..n)
                .map(|j| (0..n).map(|k| b[k][i] * b[k][j]).sum::<i64>() + i64::from(i == j))
                .collect()
        })
        .collect()
}

fn contact_of(s: &[Vec<i64>]) -> Contact {
    let n = s.len();
    // The block's y points away.
    let sign = |i: usize, j: usize| if (i + j).is_multiple_of(2) { 1 } else { -1 };
    let entries = (0..n).flat_map(|i| (0..n).map(move |j| (i, j, whole(sign(i, j) * s[i][j]))));
    Contact::from_condensed(&Sparse::from_entries(n, n, entries))
}

fn random_class(dice: &mut Dice) -> Class {
    match dice.roll(2) {
        -2 => Class::Free,
        -1 => Class::Stick,
        0 => Class::Zero,
        1 => Class::Cone(1),
        _ => Class::Cone(-1),
    }
}

const SLIPS: [ContactState; 2] = [
    ContactState::Slip { sign: 1 },
    ContactState::Slip { sign: -1 },
];

fn choices(class: Class) -> Vec<ContactState> {
    match class {
        Class::Free => vec![ContactState::Free],
        Class::Stick => vec![ContactState::Stick],
        Class::Cone(sign) => vec![ContactState::Stick, ContactState::Slip { sign }],
        Class::Zero => vec![ContactState::Stick, ContactState::Free, SLIPS[0], SLIPS[1]],
    }
}

/// (v, w) in these states by Gauss-Jordan elimination, `None` if singular; g = e_T to be overcome.
fn rates(
    s: &[Vec<i64>],
    mu: &Rational,
    states: &[ContactState],
) -> Option<(Vec<Rational>, Vec<Rational>)> {
    let n = s.len();
    // Unknowns (v, w): S v - w = -S g, and two conditions for each node.
    let g = |j: usize| i64::from(j.is_multiple_of(2));
    let mut m = vec![vec![whole(0); 2 * n + 1]; 2 * n];
    for i in 0..n {
        for j in 0..n {
            m[i][j] = whole(s[i][j]);
        }
        m[i][n + i] = whole(-1);
        m[i][2 * n] = whole(-(0..n).map(|j| s[i][j] * g(j)).sum::<i64>());
    }
    for (k, state) in states.iter().enumerate() {
        let (t, normal) = (2 * k, 2 * k + 1);
        match state {
            ContactState::Free => {
                (m[n + t][n + t], m[n + normal][n + normal]) = (whole(1), whole(1))
            }
            ContactState::Stick => (m[n + t][t], m[n + normal][normal]) = (whole(1), whole(1)),
            ContactState::Slip { sign } => {
                m[n + t][normal] = whole(1);
                m[n + normal][n + t] = whole((*sign).into());
                m[n + normal][n + normal] = mu.clone();
            }
        }
    }
    for k in 0..2 * n {
        let pivot = (k..2 * n).find(|&i| !m[i][k].is_zero())?;
        m.swap(k, pivot);
        for i in (0..2 * n).filter(|&i| i != k) {
            let factor = &m[i][k] / &m[k][k];
            if factor.is_zero() {
                continue;
            }
            for j in k..=2 * n {
                let update = &factor * &m[k][j];
                m[i][j] -= update;
            }
        }
    }
    let x: Vec<Rational> = (0..2 * n).map(|i| &m[i][2 * n] / &m[i][i]).collect();
    Some((x[..n].to_vec(), x[n..].to_vec()))
}

/// The lines of (9) for one node, rates for (v, w).
fn holds(class: Class, v: &[Rational], w: &[Rational], mu: &Rational) -> bool {
    let (v_t, v_n, w_t, w_n) = (&v[0], &v[1], &w[0], &w[1]);
    let zero = Rational::zero();
    match class {
        Class::Free => w_t.is_zero() && w_n.is_zero(),
        Class::Stick => v_t.is_zero() && v_n.is_zero(),
        Class::Cone(sign) => {
            let s = whole(sign.into());
            let y = w_t * &s + mu * w_n;
            *v_n == zero && v_t * &s <= zero && y <= zero && (y * v_t).is_zero()
        }
        Class::Zero => {
            *v_n <= zero
                && *w_n <= zero
                && (v_n * w_n).is_zero()
                && w_t.abs() + mu * w_n <= zero
                && v_t.abs() * w_t - mu * v_t * w_n == zero
        }
    }
}

/// Every set of states that solves the rate problem; whether some set was singular.
fn enumerate(s: &[Vec<i64>], mu: &Rational, classes: &[Class]) -> (Vec<Vec<ContactState>>, bool) {
    let mut all: Vec<Vec<ContactState>> = vec![Vec::new()];
    for class in classes {
        all = all
            .into_iter()
            .flat_map(|p| {
                choices(*class)
                    .into_iter()
                    .map(move |c| p.iter().copied().chain([c]).collect())
            })
            .collect();
    }
    let mut singular = false;
    all.retain(|states| match rates(s, mu, states) {
        None => {
            singular = true;
            false
        }
        Some((v, w)) => (0..classes.len())
            .all(|k| holds(classes[k], &v[2 * k..2 * k + 2], &w[2 * k..2 * k + 2], mu)),
    });
    (all, singular)
}

/// Found states are among those of the enumeration, and where none are found there are none. What
/// was met is counted: every finder, several solutions, none at all, singular sets.
#[test]
fn rate_problems_agree_with_enumeration() {
    let mut dice = Dice(7);
    let mut met: BTreeMap<&str, usize> = BTreeMap::new();
    for round in 0..600 {
        let nodes = 2 + round % 2;
        let s = random_stiffness(&mut dice, 2 * nodes);
        let classes: Vec<Class> = (0..nodes).map(|_| random_class(&mut dice)).collect();
        let mu = [whole(1) / whole(2), whole(1), whole(3)][round % 3].clone();
        let (contact, friction) = (contact_of(&s), Friction::new(&mu));
        let (solutions, singular) = enumerate(&s, &mu, &classes);
        let rates = Rates {
            contact: &contact,
            friction: &friction,
            classes: &classes,
            loads: &|_| vec![Load::Left],
            moving: Load::Left,
        };
        let found = rates.solve(&mut Images::default(), &vec![ContactState::Stick; nodes]);
        let word = match &found {
            Ok(solved) => {
                assert!(
                    solutions.contains(&solved.states),
                    "round {round}: {:?} {classes:?}",
                    solved.states
                );
                match solved.finder {
                    Finder::ActiveSet => "active set",
                    Finder::OneByOne => "one by one",
                    Finder::Pivoting => "pivoting",
                    Finder::Enumeration => "enumeration",
                }
            }
            Err(PathError::NoContinuation { all, .. }) => {
                assert!(
                    solutions.is_empty(),
                    "round {round}: {classes:?} has {solutions:?}"
                );
                assert_eq!(*all, !singular, "round {round}");
                "none exists"
            }
            Err(e) => panic!("{e}"),
        };
        *met.entry(word).or_default() += 1;
        *met.entry("several solutions").or_default() += usize::from(solutions.len() > 1);
        *met.entry("singular").or_default() += usize::from(singular);
        if let Some(states) = propose(&contact, &friction, &classes, Load::Left) {
            *met.entry("proposed").or_default() += 1;
            *met.entry("proposed rightly").or_default() += usize::from(solutions.contains(&states));
        }
    }
    for word in [
        "active set",
        "one by one",
        "pivoting",
        "enumeration",
        "none exists",
        "several solutions",
        "singular",
    ] {
        assert!(
            met.get(word).is_some_and(|&n| n > 0),
            "{word} never met: {met:?}"
        );
    }
}
