//! The rate problem against plain enumeration: every set of states tried by elimination in
//! fractions, the lines of (9) written out. For tests; shares nothing with the solver.

use super::contact::{Contact, FrictionCoefficients, Load};
use super::error::PathError;
use super::line::Class;
use super::linear::Images;
use super::propose::propose;
use super::rates::{Finder, Rates, Solved};
use super::unique::is_one_for_every_load;
use mceip_exact::{Rational, whole};
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
        let faces = 2 * k as u64 + 1;
        ((self.0 >> 33) % faces) as i64 - k
    }
}

/// A rate problem in small numbers.
struct RateInstance {
    /// C in (T, N) of each node.
    stiffness: Vec<Vec<i64>>,
    mu: Rational,
    classes: Vec<Class>,
}

impl RateInstance {
    /// Every fifth body can move without force where its candidates are open.
    fn random(dice: &mut Dice, nodes: usize, mu: Rational) -> RateInstance {
        let is_singular = dice.roll(2) == 2;
        let stiffness = random_stiffness(dice, 2 * nodes, is_singular);
        let classes = (0..nodes).map(|_| random_class(dice)).collect();
        RateInstance {
            stiffness,
            mu,
            classes,
        }
    }

    /// The load moves every candidate along its tangent: h = -C e_T.
    fn contact(&self) -> Contact {
        let mut stiffness = Vec::new();
        let mut load = Vec::new();
        for row in &self.stiffness {
            let tangential: i64 = row.iter().step_by(2).sum();
            load.push(whole(-tangential));
            stiffness.push(row.iter().map(|&entry| whole(entry)).collect());
        }

        Contact::plain(stiffness, vec![load])
    }
}

/// B'B + I in (T, N) of each node: symmetric positive definite, with strong coupling of T and N; or
/// B'B with one row less.
fn random_stiffness(dice: &mut Dice, order: usize, is_singular: bool) -> Vec<Vec<i64>> {
    let rows = order - usize::from(is_singular);
    let mut factor = vec![vec![0; order]; rows];
    for row in &mut factor {
        for entry in row {
            *entry = dice.roll(4);
        }
    }

    let mut stiffness = vec![vec![0; order]; order];
    for i in 0..order {
        stiffness[i][i] = i64::from(!is_singular);
        for j in 0..order {
            for row in &factor {
                stiffness[i][j] += row[i] * row[j];
            }
        }
    }

    stiffness
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

fn choices(class: Class) -> Vec<ContactState> {
    match class {
        Class::Free => vec![ContactState::Free],
        Class::Stick => vec![ContactState::Stick],
        Class::Cone(sign) => vec![ContactState::Stick, ContactState::Slip { sign }],
        Class::Zero => vec![
            ContactState::Stick,
            ContactState::Free,
            ContactState::Slip { sign: 1 },
            ContactState::Slip { sign: -1 },
        ],
    }
}

/// Rates of displacements and reactions.
#[derive(PartialEq)]
struct VelocityAndReaction {
    v: Vec<Rational>,
    w: Vec<Rational>,
}

/// (v, w) in these states by Gauss-Jordan elimination, `None` if singular; g = e_T to be overcome.
fn rates(instance: &RateInstance, states: &[ContactState]) -> Option<VelocityAndReaction> {
    let order = instance.stiffness.len();
    let mut rows = equations(instance, states);
    eliminate(&mut rows)?;

    let mut solution = Vec::with_capacity(2 * order);
    for (i, row) in rows.iter().enumerate() {
        solution.push(&row[2 * order] / &row[i]);
    }

    let w = solution.split_off(order);
    Some(VelocityAndReaction { v: solution, w })
}

/// The equations for the unknowns (v, w), each row with its right side at the end: C v - w = -C g,
/// and two conditions for each node.
fn equations(instance: &RateInstance, states: &[ContactState]) -> Vec<Vec<Rational>> {
    let stiffness = &instance.stiffness;
    let order = stiffness.len();
    let mut rows = vec![vec![whole(0); 2 * order + 1]; 2 * order];

    for i in 0..order {
        let mut right = 0;
        for j in 0..order {
            rows[i][j] = whole(stiffness[i][j]);
            if j.is_multiple_of(2) {
                right -= stiffness[i][j]; // g_j = 1
            }
        }

        rows[i][order + i] = whole(-1);
        rows[i][2 * order] = whole(right);
    }

    for (node, state) in states.iter().enumerate() {
        let v_t = 2 * node;
        let v_n = 2 * node + 1;
        let w_t = order + v_t;
        let w_n = order + v_n;
        // Two more rows, in the places below those of the node's components.
        match state {
            ContactState::Free | ContactState::Zero => {
                rows[w_t][w_t] = whole(1);
                rows[w_n][w_n] = whole(1);
            }
            ContactState::Stick => {
                rows[w_t][v_t] = whole(1);
                rows[w_n][v_n] = whole(1);
            }
            ContactState::Slip { sign } => {
                rows[w_t][v_n] = whole(1);
                rows[w_n][w_t] = whole((*sign).into());
                rows[w_n][w_n] = instance.mu.clone();
            }
        }
    }

    rows
}

/// Makes the square block on the left of the rows diagonal; `None` if it is singular.
fn eliminate(rows: &mut [Vec<Rational>]) -> Option<()> {
    let order = rows.len();
    for k in 0..order {
        let pivot = (k..order).find(|&i| !rows[i][k].is_zero())?;
        rows.swap(k, pivot);

        let pivot_row = rows[k].clone();
        for i in (0..order).filter(|&i| i != k) {
            let factor = &rows[i][k] / &pivot_row[k];
            if factor.is_zero() {
                continue;
            }

            for j in k..=order {
                rows[i][j] -= &factor * &pivot_row[j];
            }
        }
    }

    Some(())
}

/// The lines of (9) for one node, with rates (T, N) for v and w.
fn holds(class: Class, v: &[Rational], w: &[Rational], mu: &Rational) -> bool {
    let [v_t, v_n] = v else { return false };
    let [w_t, w_n] = w else { return false };
    let zero = Rational::zero();

    match class {
        Class::Free => w_t.is_zero() && w_n.is_zero(),
        Class::Stick => v_t.is_zero() && v_n.is_zero(),
        Class::Cone(sign) => {
            let sign = whole(sign.into());
            let y = w_t * &sign + mu * w_n;
            *v_n == zero && v_t * &sign <= zero && y <= zero && (y * v_t).is_zero()
        }
        Class::Zero => {
            let contact = *v_n <= zero && *w_n <= zero && (v_n * w_n).is_zero();
            let cone = w_t.abs() + mu * w_n <= zero;
            let friction = v_t.abs() * w_t - mu * v_t * w_n == zero;
            contact && cone && friction
        }
    }
}

/// What plain enumeration finds.
struct EnumeratedRates {
    /// Every set of states that solves the rate problem.
    solutions: Vec<Vec<ContactState>>,
    /// Their rates, the same ones once.
    distinct: Vec<VelocityAndReaction>,
    /// The equations of some set are singular.
    singular: bool,
}

fn enumerate(instance: &RateInstance) -> EnumeratedRates {
    let mut sets: Vec<Vec<ContactState>> = vec![Vec::new()];
    for &class in &instance.classes {
        let mut longer = Vec::new();
        for set in &sets {
            for state in choices(class) {
                let mut set = set.clone();
                set.push(state);
                longer.push(set);
            }
        }

        sets = longer;
    }

    let mut solutions = Vec::new();
    let mut distinct: Vec<VelocityAndReaction> = Vec::new();
    let mut singular = false;
    for states in sets {
        match rates(instance, &states) {
            None => singular = true,
            Some(rates) if all_hold(instance, &rates) => {
                solutions.push(states);
                if !distinct.contains(&rates) {
                    distinct.push(rates);
                }
            }
            Some(_) => {}
        }
    }

    EnumeratedRates {
        solutions,
        distinct,
        singular,
    }
}

fn all_hold(instance: &RateInstance, rates: &VelocityAndReaction) -> bool {
    let nodes = rates.v.chunks(2).zip(rates.w.chunks(2));
    instance
        .classes
        .iter()
        .zip(nodes)
        .all(|(&class, (v, w))| holds(class, v, w, &instance.mu))
}

/// Holds what the solver found against the enumeration; returns how it was found.
fn compare(
    round: usize,
    found: &Result<Solved, PathError>,
    expected: &EnumeratedRates,
    classes: &[Class],
) -> &'static str {
    let solutions = &expected.solutions;
    match found {
        Ok(solved) => {
            let states = &solved.states;
            assert!(
                solutions.contains(states),
                "round {round}: {states:?} {classes:?}"
            );
            match solved.finder {
                Finder::ActiveSet => "active set",
                Finder::OneByOne => "one by one",
                Finder::Pivoting => "pivoting",
                Finder::Enumeration => "enumeration",
            }
        }
        Err(PathError::NoContinuation(why)) => {
            assert!(
                solutions.is_empty(),
                "round {round}: {classes:?} has {solutions:?}"
            );
            assert_eq!(why.is_proved(), !expected.singular, "round {round}");
            "none exists"
        }
        Err(error) => panic!("{error}"),
    }
}

/// Found states are among those of the enumeration, and where none are found there are none. What
/// was met is counted: every finder, several solutions, none at all, singular sets.
#[test]
fn rate_problems_agree_with_enumeration() {
    let mut dice = Dice(7);
    let mut met: BTreeMap<&str, usize> = BTreeMap::new();

    for round in 0..600 {
        let nodes = 2 + round % 2;
        let mu = [whole(1) / whole(2), whole(1), whole(3)][round % 3].clone();
        let instance = RateInstance::random(&mut dice, nodes, mu);
        let contact = instance.contact();
        let friction = FrictionCoefficients::new(&instance.mu, &contact);
        let classes = &instance.classes;

        let expected = enumerate(&instance);
        let rates = Rates {
            contact: &contact,
            friction: &friction,
            classes,
            causes: &[],
            loads: &|_| vec![Load::Step(0)],
            growing: Load::Step(0),
        };
        let found = rates.solve(&mut Images::default(), &vec![ContactState::Stick; nodes]);
        let finder = compare(round, &found, &expected, classes);

        let all = rates.all(&mut Images::default()).unwrap();
        assert_eq!(all.solved.len(), expected.distinct.len(), "round {round}");
        assert_eq!(all.singular > 0, expected.singular, "round {round}");
        for solved in &all.solved {
            assert!(expected.solutions.contains(&solved.states), "round {round}");
        }

        let states: Vec<_> = classes.iter().map(|class| class.contact_state()).collect();
        let is_one = is_one_for_every_load(&mut contact.pencils(), &instance.mu, &states).unwrap();
        let is_here = expected.distinct.len() == 1 && !expected.singular;
        assert!(!is_one || is_here, "round {round}: {classes:?}");
        *met.entry("one for every load").or_default() += usize::from(is_one);
        let can_float = expected.singular && expected.distinct.len() == 1;
        *met.entry("one here, and singular").or_default() += usize::from(can_float);
        *met.entry("one for this load only").or_default() += usize::from(is_here && !is_one);

        let several = expected.distinct.len() > 1;
        *met.entry(finder).or_default() += 1;
        *met.entry("several solutions").or_default() += usize::from(several);
        *met.entry("singular").or_default() += usize::from(expected.singular);
        if let Some(states) = propose(&contact, &friction, classes, Load::Step(0)) {
            let rightly = expected.solutions.contains(&states);
            *met.entry("proposed").or_default() += 1;
            *met.entry("proposed rightly").or_default() += usize::from(rightly);
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
        "one for every load",
        "one for this load only",
        "one here, and singular",
    ] {
        let times = met.get(word).copied().unwrap_or_default();
        assert!(times > 0, "{word} never met: {met:?}");
    }
}
