//! A stretch of the path on which everything is affine in the amount of the load, and the
//! conditions that end it.
//!
//! While the states of the candidates do not change, w(a) = w0 + a w1 and r(a) = r0 + a r1, where a
//! is the amount of the load that grows. So each quantity that contact and friction bound
//! ([`Bound`]) is affine as well, and the stretch ends at the smallest a at which one of them falls
//! to zero ([`next_event`]). There [`classify`] says what each candidate may do next.
//!
//! All numbers are integers over common denominators: only signs and zeros are asked for. Input is
//! the [`Response`] to each load in the states of the stretch. Called by `trace`, which follows the
//! path; `check` and `rates` read lines and classes.

use super::contact::{Contact, FrictionCoefficients, Load, NodalValues, Response};
use super::error::LawFailure;
use mceip_exact::{Integer, Rational, cleared, common_denominator, to_f64};
use mceip_model::ContactState;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;

/// A vector that is affine in the amount a of the growing load: constant + a slope.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Affine {
    pub(super) constant: Vec<Integer>,
    pub(super) slope: Vec<Integer>,
}

impl Affine {
    fn zeros(length: usize) -> Affine {
        Affine {
            constant: vec![Integer::zero(); length],
            slope: vec![Integer::zero(); length],
        }
    }

    /// Component `i` at a = m / n, times n.
    pub(super) fn at(&self, i: usize, a: &Rational) -> Integer {
        let constant = &self.constant[i] * a.denom();
        let growth = &self.slope[i] * a.numer();
        constant + growth
    }

    /// Every component at a = m / n, times n.
    pub(super) fn all_at(&self, a: &Rational) -> Vec<Integer> {
        (0..self.constant.len()).map(|i| self.at(i, a)).collect()
    }

    /// Adds factor * vector to the slope if it `grows`, else to the constant.
    fn add(&mut self, grows: bool, factor: &Integer, vector: &[Integer]) {
        let target = if grows {
            &mut self.slope
        } else {
            &mut self.constant
        };
        for (sum, component) in target.iter_mut().zip(vector) {
            *sum += factor * component;
        }
    }
}

/// A load, and how much of it is applied.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct AppliedLoad {
    pub(super) load: Load,
    pub(super) amount: Amount,
}

/// How much of a load is applied along a stretch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Amount {
    /// The same all along.
    Fixed(Rational),
    /// a itself: the load that grows.
    Growing,
}

/// Displacements and reactions w(a) = (w0 + a w1) / denominator, r(a) = (r0 + a r1) / (denominator
/// times that of the contact).
pub(super) struct EquilibriumLine {
    pub(super) denominator: Integer,
    pub(super) w: Affine,
    pub(super) r: Affine,
}

impl EquilibriumLine {
    /// The sum of all loads as they are applied. `loads` belong to `response`.
    pub(super) fn new(
        response: &Response,
        loads: &[AppliedLoad],
        contact: &Contact,
    ) -> EquilibriumLine {
        let fixed = loads.iter().filter_map(|applied| match &applied.amount {
            Amount::Fixed(amount) => Some(amount),
            Amount::Growing => None,
        });
        let clear = common_denominator(fixed);

        let mut w = Affine::zeros(contact.columns());
        let mut r = Affine::zeros(contact.rows().len());
        for (k, applied) in loads.iter().enumerate() {
            let (grows, factor) = match &applied.amount {
                Amount::Fixed(amount) => (false, cleared(amount, &clear)),
                Amount::Growing => (true, clear.clone()),
            };
            w.add(grows, &factor, &response.w[k]);
            r.add(grows, &factor, &response.r[k]);
        }

        EquilibriumLine {
            denominator: &response.denominator * clear,
            w,
            r,
        }
    }

    /// The unloaded body: every candidate at its gap, no reaction.
    pub(super) fn unloaded(contact: &Contact) -> EquilibriumLine {
        let denominator = common_denominator(contact.gaps());
        let mut w = Affine::zeros(contact.columns());
        for (node, gap) in contact.gaps().iter().enumerate() {
            w.constant[2 * node + 1] = -cleared(gap, &denominator);
        }
        w.constant[contact.component(Load::Gaps)] = denominator.clone();

        EquilibriumLine {
            denominator,
            w,
            r: Affine::zeros(contact.rows().len()),
        }
    }

    /// Displacements and reactions at a = 0.
    fn constants(&self) -> NodalValues<'_> {
        NodalValues {
            w: &self.w.constant,
            r: &self.r.constant,
        }
    }

    /// The rates of w and r: their growth with a.
    pub(super) fn rates(&self) -> NodalValues<'_> {
        NodalValues {
            w: &self.w.slope,
            r: &self.r.slope,
        }
    }

    /// Is it at `a` the same state as `other` at `b`, reaction for reaction and displacement for
    /// displacement?
    pub(super) fn meets(&self, a: &Rational, other: &EquilibriumLine, b: &Rational) -> bool {
        let here = &self.denominator * a.denom();
        let there = &other.denominator * b.denom();
        let components = self.r.constant.len();

        (0..components).all(|i| {
            self.w.at(i, a) * &there == other.w.at(i, b) * &here
                && self.r.at(i, a) * &there == other.r.at(i, b) * &here
        })
    }

    /// The equilibrium where `a` of the h of the growing load is applied, which is its amount.
    ///
    /// # Errors
    /// The first candidate at which (1) or (7) fails.
    pub(super) fn equilibrium(
        &self,
        a: &Rational,
        contact: &Contact,
        friction: &FrictionCoefficients,
    ) -> Result<Equilibrium, LawFailure> {
        let classes = classify(self, a, friction)?;
        let unit = a.denom() * &self.denominator;
        let r_denominator = &unit * contact.denominator();
        let mut w = self.w.all_at(a);
        w.truncate(contact.rows().len());

        Ok(Equilibrium {
            amount: a.clone(),
            states: classes.into_iter().map(Class::contact_state).collect(),
            gaps: contact.gaps().to_vec(),
            w,
            w_unit: Rational::new_raw(Integer::one(), unit),
            r: self.r.all_at(a),
            r_unit: Rational::new_raw(Integer::one(), r_denominator),
        })
    }
}

/// A quantity that contact and friction keep from being negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The gap of a free candidate, gap - u_N. // (1)
    Gap {
        /// The candidate, from 0.
        node: usize,
    },
    /// The pressure of a candidate in contact, -r_N. // (1)
    Pressure {
        /// The candidate, from 0.
        node: usize,
    },
    /// The distance from the friction cone, -mu r_N - sign r_T. // (7)
    Cone {
        /// The candidate, from 0.
        node: usize,
        /// Side of the cone: the sign of r_T there.
        sign: i8,
    },
}

impl Bound {
    /// The candidate it belongs to.
    pub fn node(self) -> usize {
        match self {
            Bound::Gap { node } | Bound::Pressure { node } | Bound::Cone { node, .. } => node,
        }
    }

    /// What happens when it reaches zero.
    pub fn word(self) -> &'static str {
        match self {
            Bound::Gap { .. } => "gap closes",
            Bound::Pressure { .. } => "pressure vanishes",
            Bound::Cone { .. } => "friction cone reached",
        }
    }

    /// Its value for these displacements and reactions, up to a positive factor.
    pub(super) fn value(self, values: NodalValues<'_>, friction: &FrictionCoefficients) -> Integer {
        match self {
            Bound::Gap { node } => -&values.w[2 * node + 1],
            Bound::Pressure { node } => -&values.r[2 * node + 1],
            Bound::Cone { node, sign } => {
                let row = friction.on_cone(node, 1);
                let tangential = &values.r[2 * node] * row.tangential * Integer::from(sign);
                let normal = &values.r[2 * node + 1] * row.normal;
                -(tangential + normal)
            }
        }
    }

    /// With rates for the displacements and reactions: is it about to become negative?
    pub(super) fn falls(self, rates: NodalValues<'_>, friction: &FrictionCoefficients) -> bool {
        self.value(rates, friction).is_negative()
    }

    /// The bounds that can end the stay of a node in this state.
    fn of(node: usize, state: ContactState) -> Vec<Bound> {
        match state {
            ContactState::Free | ContactState::Zero => vec![Bound::Gap { node }],
            ContactState::Slip { .. } => vec![Bound::Pressure { node }],
            // The two cones together imply the pressure.
            ContactState::Stick => vec![
                Bound::Cone { node, sign: 1 },
                Bound::Cone { node, sign: -1 },
            ],
        }
    }
}

/// Where a stretch ends by itself.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct NextEvent {
    /// The amount of the growing load.
    pub(super) a: Rational,
    /// Every bound that becomes zero there on its way down.
    pub(super) causes: Vec<Bound>,
}

/// The first amount at which a bound of these states becomes zero on its way down, and every bound
/// that does so there; `None` if none ever does.
pub(super) fn next_event(
    line: &EquilibriumLine,
    friction: &FrictionCoefficients,
    states: &[ContactState],
) -> Option<NextEvent> {
    let mut first: Option<NextEvent> = None;

    for (node, &state) in states.iter().enumerate() {
        for bound in Bound::of(node, state) {
            let slope = bound.value(line.rates(), friction);
            if !slope.is_negative() {
                continue;
            }

            // constant + a slope = 0 at a = constant / fall.
            let constant = bound.value(line.constants(), friction);
            let fall = -slope;
            match compare_with_first(first.as_ref(), &constant, &fall) {
                Ordering::Greater => {}
                Ordering::Equal => {
                    if let Some(event) = &mut first {
                        event.causes.push(bound);
                    }
                }
                Ordering::Less => {
                    first = Some(NextEvent {
                        a: Rational::new_raw(constant, fall),
                        causes: vec![bound],
                    });
                }
            }
        }
    }

    // Only the fraction of the first event is reduced.
    first.map(|event| NextEvent {
        a: event.a.reduced(),
        causes: event.causes,
    })
}

/// Compares constant / fall (fall > 0) with the first event so far by products; less if there is
/// none.
fn compare_with_first(first: Option<&NextEvent>, constant: &Integer, fall: &Integer) -> Ordering {
    match first {
        Some(event) => (constant * event.a.denom()).cmp(&(event.a.numer() * fall)),
        None => Ordering::Less,
    }
}

/// An equilibrium (5) on the path: exact displacements and reactions of the contact candidates.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    amount: Rational,
    states: Vec<ContactState>,
    /// Distance of each candidate from the obstacle in the unloaded body.
    gaps: Vec<Rational>,
    /// u_T and u_N - gap, in units of `w_unit`.
    w: Vec<Integer>,
    w_unit: Rational,
    /// Reactions, in units of `r_unit`.
    r: Vec<Integer>,
    r_unit: Rational,
}

impl Equilibrium {
    /// The equilibrium of the body without gaps under `factor` > 0 times these loads; what its
    /// amount is called.
    pub(super) fn times(self, factor: &Rational, amount: Rational) -> Equilibrium {
        let scaled = |unit: &Rational| {
            let numer = unit.numer() * factor.numer();
            Rational::new_raw(numer, unit.denom() * factor.denom())
        };

        Equilibrium {
            amount,
            w_unit: scaled(&self.w_unit),
            r_unit: scaled(&self.r_unit),
            ..self
        }
    }

    /// The amount of the load that grows.
    pub fn amount(&self) -> &Rational {
        &self.amount
    }

    /// The contact states, by gap and reaction alone: a candidate that sticks on the friction cone
    /// is in impending slip, one without reaction is in z.
    pub fn contact_states(&self) -> &[ContactState] {
        &self.states
    }

    /// One letter for each candidate: `.` stick, `<` impending slip against the tangent, `>` along
    /// it, `o` free, `z` in contact without reaction.
    pub fn picture(&self) -> String {
        self.states.iter().map(|state| state.letter()).collect()
    }

    /// (u_T, u_N) of a candidate (from 0): along its tangent, and into the obstacle.
    pub fn displacement(&self, node: usize) -> (Rational, Rational) {
        let tangential = times_unit(&self.w[2 * node], &self.w_unit);
        let beyond_gap = times_unit(&self.w[2 * node + 1], &self.w_unit);
        (tangential, beyond_gap + &self.gaps[node])
    }

    /// (r_T, r_N) of a candidate (from 0): r_N <= 0 in contact.
    pub fn reaction(&self, node: usize) -> (Rational, Rational) {
        let tangential = times_unit(&self.r[2 * node], &self.r_unit);
        let normal = times_unit(&self.r[2 * node + 1], &self.r_unit);
        (tangential, normal)
    }

    /// Sums of r_T and of r_N over the candidates.
    pub fn resultants(&self) -> (Rational, Rational) {
        let mut tangential = Integer::zero();
        let mut normal = Integer::zero();
        for reaction in self.r.chunks(2) {
            tangential += &reaction[0];
            normal += &reaction[1];
        }

        (
            times_unit(&tangential, &self.r_unit),
            times_unit(&normal, &self.r_unit),
        )
    }

    /// (r_T, r_N) of every candidate, each correctly rounded to a double.
    pub fn reactions_f64(&self) -> Vec<(f64, f64)> {
        let mut reactions = Vec::with_capacity(self.r.len() / 2);
        for reaction in self.r.chunks(2) {
            let tangential = to_f64(&times_unit_raw(&reaction[0], &self.r_unit));
            let normal = to_f64(&times_unit_raw(&reaction[1], &self.r_unit));
            reactions.push((tangential, normal));
        }

        reactions
    }
}

/// value * unit, in lowest terms.
fn times_unit(value: &Integer, unit: &Rational) -> Rational {
    Rational::new(value * unit.numer(), unit.denom().clone())
}

/// value * unit, not in lowest terms: enough for rounding.
fn times_unit_raw(value: &Integer, unit: &Rational) -> Rational {
    Rational::new_raw(value * unit.numer(), unit.denom().clone())
}

/// What (1), (2) and (7) say of a candidate at an equilibrium: its class in the list after (9).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Class {
    /// Open.
    Free,
    /// In contact with zero reaction.
    Zero,
    /// Strictly inside the cone.
    Stick,
    /// On the cone, at this sign of r_T.
    Cone(i8),
}

impl Class {
    /// The class of a contact state at an equilibrium.
    pub(super) fn of(state: ContactState) -> Class {
        match state {
            ContactState::Free => Class::Free,
            ContactState::Zero => Class::Zero,
            ContactState::Stick => Class::Stick,
            ContactState::Slip { sign } => Class::Cone(sign),
        }
    }

    /// The contact state of an equilibrium, as section 2 defines it: by gap and reaction alone.
    pub(super) fn contact_state(self) -> ContactState {
        match self {
            Class::Free => ContactState::Free,
            Class::Zero => ContactState::Zero,
            Class::Stick => ContactState::Stick,
            Class::Cone(sign) => ContactState::Slip { sign },
        }
    }
}

/// The class of each candidate at the amount `a`.
///
/// # Errors
/// The first candidate at which (1) or (7) fails.
pub(super) fn classify(
    line: &EquilibriumLine,
    a: &Rational,
    friction: &FrictionCoefficients,
) -> Result<Vec<Class>, LawFailure> {
    let w = line.w.all_at(a);
    let r = line.r.all_at(a);
    let values = NodalValues { w: &w, r: &r };

    let nodes = r.len() / 2;
    (0..nodes)
        .map(|node| class_of(node, values, friction))
        .collect()
}

fn class_of(
    node: usize,
    values: NodalValues<'_>,
    friction: &FrictionCoefficients,
) -> Result<Class, LawFailure> {
    let gap = Bound::Gap { node }.value(values, friction);
    let pressure = Bound::Pressure { node }.value(values, friction);
    let one_is_zero = gap.is_zero() || pressure.is_zero();
    if gap.is_negative() || pressure.is_negative() || !one_is_zero {
        return Err(LawFailure {
            node,
            equation: "E1",
        });
    }

    let positive_side = Bound::Cone { node, sign: 1 }.value(values, friction);
    let negative_side = Bound::Cone { node, sign: -1 }.value(values, friction);
    if positive_side.is_negative() || negative_side.is_negative() {
        return Err(LawFailure {
            node,
            equation: "E7",
        });
    }

    Ok(if !gap.is_zero() {
        Class::Free
    } else if pressure.is_zero() {
        Class::Zero
    } else if positive_side.is_zero() {
        Class::Cone(1)
    } else if negative_side.is_zero() {
        Class::Cone(-1)
    } else {
        Class::Stick
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn integers(values: &[i64]) -> Vec<Integer> {
        values.iter().map(|&value| value.into()).collect()
    }

    fn affine(constant: &[i64], slope: &[i64]) -> Affine {
        Affine {
            constant: integers(constant),
            slope: integers(slope),
        }
    }

    fn line(w: Affine, r: Affine) -> EquilibriumLine {
        EquilibriumLine {
            denominator: 1.into(),
            w,
            r,
        }
    }

    /// So many candidates with unit stiffness and two loads; only their number plays a part.
    fn candidates(nodes: usize) -> Contact {
        let mut stiffness = vec![vec![whole(0); 2 * nodes]; 2 * nodes];
        for (i, row) in stiffness.iter_mut().enumerate() {
            row[i] = whole(1);
        }

        Contact::plain(stiffness, vec![vec![whole(0); 2 * nodes]; 2])
    }

    fn mu_two() -> FrictionCoefficients {
        FrictionCoefficients::new(&whole(2), &candidates(2))
    }

    fn event(a: Rational, causes: Vec<Bound>) -> NextEvent {
        NextEvent { a, causes }
    }

    #[test]
    fn the_first_bound_on_its_way_down_ends_the_stretch() {
        // Two candidates, in the order w_T, w_N.
        let free_and_stick = [ContactState::Free, ContactState::Stick];

        // Node 0 free, gap 3 - 2 a; node 1 sticks, r = (a, -1): cone 2 - a.
        let gap_first = line(
            affine(&[0, -3, 0, 0], &[0, 2, 0, 0]),
            affine(&[0, 0, 0, -1], &[0, 0, 1, 0]),
        );
        assert_eq!(
            next_event(&gap_first, &mu_two(), &free_and_stick),
            Some(event(rational(3, 2), vec![Bound::Gap { node: 0 }]))
        );

        // Slope 3/2 instead of 2 (twice everything): both at a = 2.
        let both_at_once = line(
            affine(&[0, -6, 0, 0], &[0, 3, 0, 0]),
            affine(&[0, 0, 0, -2], &[0, 0, 2, 0]),
        );
        let gap_and_cone = vec![Bound::Gap { node: 0 }, Bound::Cone { node: 1, sign: 1 }];
        assert_eq!(
            next_event(&both_at_once, &mu_two(), &free_and_stick),
            Some(event(whole(2), gap_and_cone))
        );

        // A slip node ends with its pressure, and nothing ends what only grows.
        let free_and_slip = [ContactState::Free, ContactState::Slip { sign: -1 }];
        let relief = line(
            affine(&[0, -3, 0, 0], &[0, -1, 0, 0]),
            affine(&[0, 0, -2, -1], &[0, 0, 2, 1]),
        );
        assert_eq!(
            next_event(&relief, &mu_two(), &free_and_slip),
            Some(event(whole(1), vec![Bound::Pressure { node: 1 }]))
        );
        let growth = line(
            affine(&[0, -3, 0, 0], &[0, -1, 0, 0]),
            affine(&[0, 0, -2, -1], &[0, 0, -2, -1]),
        );
        assert_eq!(next_event(&growth, &mu_two(), &free_and_slip), None);
    }

    /// The class of one candidate with w_T = 0, at any amount.
    fn class_with(w_n: i64, r: [i64; 2]) -> Result<Vec<Class>, LawFailure> {
        let constant = line(affine(&[0, w_n], &[0, 0]), affine(&r, &[0, 0]));
        classify(&constant, &whole(5), &mu_two())
    }

    fn fails(equation: &'static str) -> Result<Vec<Class>, LawFailure> {
        Err(LawFailure { node: 0, equation })
    }

    #[test]
    fn classes_and_the_equations_that_forbid_others() {
        assert_eq!(class_with(-1, [0, 0]), Ok(vec![Class::Free]));
        assert_eq!(class_with(0, [0, 0]), Ok(vec![Class::Zero]));
        assert_eq!(class_with(0, [1, -1]), Ok(vec![Class::Stick]));
        assert_eq!(class_with(0, [2, -1]), Ok(vec![Class::Cone(1)]));
        assert_eq!(class_with(0, [-2, -1]), Ok(vec![Class::Cone(-1)]));

        assert_eq!(class_with(1, [0, 0]), fails("E1"));
        assert_eq!(class_with(0, [0, 1]), fails("E1"));
        assert_eq!(class_with(-1, [0, -1]), fails("E1"));
        assert_eq!(class_with(0, [3, -1]), fails("E7"));
    }

    #[test]
    fn held_nodes_enter_at_their_places() {
        let response = Response {
            denominator: 3.into(),
            w: vec![
                integers(&[1, 0, 3, 0, 0]),
                integers(&[5, 0, 0, 3, 0]),
                integers(&[7, 0, 0, 0, 0]),
            ],
            r: vec![integers(&[2, 0]), integers(&[4, 0]), integers(&[6, 0])],
        };
        let loads = [
            AppliedLoad {
                load: Load::Step(0),
                amount: Amount::Fixed(whole(1)),
            },
            AppliedLoad {
                load: Load::Step(1),
                amount: Amount::Growing,
            },
            AppliedLoad {
                load: Load::Held(0),
                amount: Amount::Fixed(rational(-1, 2)),
            },
        ];

        let contact = candidates(1);
        let sum = EquilibriumLine::new(&response, &loads, &contact);

        // Twice everything, over twice the denominator, because of the half.
        assert_eq!(sum.denominator, Integer::from(6));
        assert_eq!(sum.w, affine(&[2 - 7, 0, 6, 0, 0], &[10, 0, 0, 6, 0]));
        assert_eq!(sum.r, affine(&[4 - 6, 0], &[8, 0]));

        let other_slope = EquilibriumLine {
            w: affine(&[-5, 0, 6, 0, 0], &[11, 0, 0, 6, 0]),
            ..EquilibriumLine::new(&response, &loads, &contact)
        };
        assert!(sum.meets(&whole(0), &other_slope, &whole(0)));
        assert!(!sum.meets(&whole(1), &other_slope, &whole(1)));
    }

    #[test]
    fn an_equilibrium_has_displacements_reactions_and_states() {
        let contact = candidates(1);
        let one = line(
            affine(&[1, 0, 1, 0, 0], &[2, 0, 0, 0, 0]),
            affine(&[4, -2], &[0, 0]),
        );
        let at = one.equilibrium(&whole(3), &contact, &mu_two()).unwrap();

        assert_eq!(at.displacement(0), (whole(7), whole(0)));
        assert_eq!(at.reaction(0), (whole(4), whole(-2)));
        assert_eq!(at.amount(), &whole(3));
        assert_eq!(at.contact_states(), [ContactState::Slip { sign: 1 }]);
        assert_eq!(at.picture(), "<");

        let twice = at.times(&whole(2), whole(6));
        assert_eq!(twice.displacement(0), (whole(14), whole(0)));
        assert_eq!(twice.reaction(0), (whole(8), whole(-4)));
        assert_eq!(twice.amount(), &whole(6));
        assert_eq!(twice.contact_states(), [ContactState::Slip { sign: 1 }]);
    }
}
