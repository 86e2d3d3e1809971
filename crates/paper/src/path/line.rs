//! A stretch of the path on which everything is affine in the motion, and the conditions that
//! end it.
//!
//! While the states of the nodes do not change, u(d) = u0 + d u1 and r(d) = r0 + d r1, where d is
//! the motion of the glued side in units of the pressing. So each quantity that contact and
//! friction bound ([`Bound`]) is affine as well, and the stretch ends at the smallest d at which
//! one of them falls to zero ([`next_event`]). There [`classify`] says what each node may do next.
//!
//! All numbers are integers over common denominators: only signs and zeros are asked for. Input is
//! the [`Response`] to each load in the states of the stretch. Called by `trace`, which follows the
//! path; `check` and `rates` read lines and classes.

use super::contact::{Contact, Friction, Load, NodalValues, Response};
use super::error::LawFailure;
use mceip_exact::{Integer, Rational, common_denominator, to_f64};
use mceip_model::ContactState;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

/// A vector that is affine in the motion d: constant + d slope.
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

    /// Component `i` at d = m / n, times n.
    pub(super) fn at(&self, i: usize, d: &Rational) -> Integer {
        let constant = &self.constant[i] * d.denom();
        let growth = &self.slope[i] * d.numer();
        constant + growth
    }

    /// Every component at d = m / n, times n.
    pub(super) fn all_at(&self, d: &Rational) -> Vec<Integer> {
        (0..self.constant.len()).map(|i| self.at(i, d)).collect()
    }

    /// Adds factor * vector to the slope if `moving`, else to the constant.
    fn add(&mut self, moving: bool, factor: &Integer, vector: &[Integer]) {
        let target = if moving {
            &mut self.slope
        } else {
            &mut self.constant
        };
        for (sum, component) in target.iter_mut().zip(vector) {
            *sum += factor * component;
        }
    }
}

/// A load, and how much of it is applied (mm per mm of pressing).
pub(super) struct AppliedLoad {
    pub(super) load: Load,
    pub(super) amount: Rational,
}

/// Displacements and reactions u(d) = (u0 + d u1) / denominator, r(d) = (r0 + d r1) / (denominator
/// times that of the contact), per unit of pressing; d is the motion in units of the pressing.
pub(super) struct Line {
    pub(super) denominator: Integer,
    pub(super) u: Affine,
    pub(super) r: Affine,
}

impl Line {
    /// Pressing + d times the motion + every held node at its place. `loads` belong to `response`.
    pub(super) fn new(response: &Response, loads: &[AppliedLoad]) -> Line {
        let clear = common_denominator(loads.iter().map(|applied| &applied.amount));
        let components = response.u.first().map_or(0, Vec::len);

        let mut u = Affine::zeros(components);
        let mut r = Affine::zeros(components);
        for (k, applied) in loads.iter().enumerate() {
            let factor = applied.amount.numer() * (&clear / applied.amount.denom());
            let moving = applied.load == Load::Left;
            u.add(moving, &factor, &response.u[k]);
            r.add(moving, &factor, &response.r[k]);
        }

        Line {
            denominator: &response.denominator * clear,
            u,
            r,
        }
    }

    /// Component `i` of u at d = m / n, times `denominator` n.
    pub(super) fn u_at(&self, i: usize, d: &Rational) -> Integer {
        self.u.at(i, d)
    }

    /// Displacements and reactions at d = 0.
    fn constants(&self) -> NodalValues<'_> {
        NodalValues {
            u: &self.u.constant,
            r: &self.r.constant,
        }
    }

    /// Their growth with d.
    fn slopes(&self) -> NodalValues<'_> {
        NodalValues {
            u: &self.u.slope,
            r: &self.r.slope,
        }
    }

    /// The rates of u and r. During the pressing u and r are proportional to it: the constants are
    /// their rates.
    pub(super) fn rates(&self, moving: Load) -> NodalValues<'_> {
        if moving == Load::Left {
            self.slopes()
        } else {
            self.constants()
        }
    }

    /// Is it the same state as `other` at d, displacement for displacement?
    pub(super) fn meets(&self, other: &Line, d: &Rational) -> bool {
        for i in 0..self.u.constant.len() {
            let here = self.u_at(i, d) * &other.denominator;
            let there = other.u_at(i, d) * &self.denominator;
            if here != there {
                return false;
            }
        }

        true
    }

    /// The equilibrium at d, in mm and N for a pressing of `depth` mm.
    pub(super) fn equilibrium(
        &self,
        d: &Rational,
        depth: &Rational,
        contact: &Contact,
    ) -> Equilibrium {
        let unit = depth.denom() * d.denom() * &self.denominator;
        let r_denominator = &unit * contact.denominator();

        Equilibrium {
            motion: d * depth,
            u: self.u.all_at(d),
            u_unit: Rational::new_raw(depth.numer().clone(), unit),
            r: self.r.all_at(d),
            r_unit: Rational::new_raw(depth.numer().clone(), r_denominator),
        }
    }
}

/// A quantity that contact and friction keep from being negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The gap of a free node, -u_N. // (1)
    Gap {
        /// The node, from 0 at the left.
        node: usize,
    },
    /// The pressure of a node in contact, -r_N. // (1)
    Pressure {
        /// The node, from 0 at the left.
        node: usize,
    },
    /// The distance from the friction cone, -mu r_N - sign r_T. // (7)
    Cone {
        /// The node, from 0 at the left.
        node: usize,
        /// Side of the cone: the sign of r_T there.
        sign: i8,
    },
}

impl Bound {
    /// The node it belongs to.
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
    pub(super) fn value(self, values: NodalValues<'_>, friction: &Friction) -> Integer {
        match self {
            Bound::Gap { node } => -&values.u[2 * node + 1],
            Bound::Pressure { node } => -&values.r[2 * node + 1],
            Bound::Cone { node, sign } => {
                let row = friction.on_cone(1);
                let tangential = &values.r[2 * node] * row.tangential * Integer::from(sign);
                let normal = &values.r[2 * node + 1] * row.normal;
                -(tangential + normal)
            }
        }
    }

    /// With rates for the displacements and reactions: is it about to become negative?
    pub(super) fn falls(self, rates: NodalValues<'_>, friction: &Friction) -> bool {
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
    /// The motion, in units of the pressing.
    pub(super) d: Rational,
    /// Every bound that becomes zero there on its way down.
    pub(super) causes: Vec<Bound>,
}

/// The first motion at which a bound of these states becomes zero on its way down, and every bound
/// that does so there; `None` if none ever does.
pub(super) fn next_event(
    line: &Line,
    friction: &Friction,
    states: &[ContactState],
) -> Option<NextEvent> {
    let mut first: Option<NextEvent> = None;

    for (node, &state) in states.iter().enumerate() {
        for bound in Bound::of(node, state) {
            let slope = bound.value(line.slopes(), friction);
            if !slope.is_negative() {
                continue;
            }

            // constant + d slope = 0 at d = constant / fall.
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
                        d: Rational::new_raw(constant, fall),
                        causes: vec![bound],
                    });
                }
            }
        }
    }

    // Only the fraction of the first event is reduced.
    first.map(|event| NextEvent {
        d: event.d.reduced(),
        causes: event.causes,
    })
}

/// Compares constant / fall (fall > 0) with the first event so far by products; less if there is
/// none.
fn compare_with_first(first: Option<&NextEvent>, constant: &Integer, fall: &Integer) -> Ordering {
    match first {
        Some(event) => (constant * event.d.denom()).cmp(&(event.d.numer() * fall)),
        None => Ordering::Less,
    }
}

/// An equilibrium (5) on the path: exact displacements and reactions of the contact nodes.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// mm.
    motion: Rational,
    /// Displacements, in units of `u_unit`.
    u: Vec<Integer>,
    /// mm.
    u_unit: Rational,
    /// Reactions, in units of `r_unit`.
    r: Vec<Integer>,
    /// N.
    r_unit: Rational,
}

impl Equilibrium {
    /// Motion of the glued side to the left, mm.
    pub fn motion(&self) -> &Rational {
        &self.motion
    }

    /// (u_T, u_N) of a node (from 0 at the left), mm: to the right, and into the obstacle.
    pub fn displacement(&self, node: usize) -> (Rational, Rational) {
        let tangential = times_unit(&self.u[2 * node], &self.u_unit);
        let normal = times_unit(&self.u[2 * node + 1], &self.u_unit);
        (tangential, normal)
    }

    /// (r_T, r_N) of a node (from 0 at the left), N: r_N <= 0 in contact.
    pub fn reaction(&self, node: usize) -> (Rational, Rational) {
        let tangential = times_unit(&self.r[2 * node], &self.r_unit);
        let normal = times_unit(&self.r[2 * node + 1], &self.r_unit);
        (tangential, normal)
    }

    /// Sums of r_T and of r_N over the contact nodes, N.
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

    /// (r_T, r_N) of every node, each correctly rounded to a double, N.
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

/// What (1), (2) and (7) say of a node at an equilibrium: its class in the list after (9).
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

/// The class of each node at d.
///
/// # Errors
/// The first node at which (1) or (7) fails.
pub(super) fn classify(
    line: &Line,
    d: &Rational,
    friction: &Friction,
) -> Result<Vec<Class>, LawFailure> {
    let u = line.u.all_at(d);
    let r = line.r.all_at(d);
    let values = NodalValues { u: &u, r: &r };

    let nodes = u.len() / 2;
    (0..nodes)
        .map(|node| class_of(node, values, friction))
        .collect()
}

fn class_of(
    node: usize,
    values: NodalValues<'_>,
    friction: &Friction,
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

    fn line(u: Affine, r: Affine) -> Line {
        Line {
            denominator: 1.into(),
            u,
            r,
        }
    }

    fn mu_two() -> Friction {
        Friction::new(&whole(2))
    }

    fn event(d: Rational, causes: Vec<Bound>) -> NextEvent {
        NextEvent { d, causes }
    }

    #[test]
    fn the_first_bound_on_its_way_down_ends_the_stretch() {
        // Two nodes, in the order u_T, u_N.
        let free_and_stick = [ContactState::Free, ContactState::Stick];

        // Node 0 free, gap 3 - 2 d; node 1 sticks, r = (d, -1): cone 2 - d.
        let gap_first = line(
            affine(&[0, -3, 0, 0], &[0, 2, 0, 0]),
            affine(&[0, 0, 0, -1], &[0, 0, 1, 0]),
        );
        assert_eq!(
            next_event(&gap_first, &mu_two(), &free_and_stick),
            Some(event(rational(3, 2), vec![Bound::Gap { node: 0 }]))
        );

        // Slope 3/2 instead of 2 (twice everything): both at d = 2.
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

    /// The class of one node with u_T = 0, at any d.
    fn class_with(u_n: i64, r: [i64; 2]) -> Result<Vec<Class>, LawFailure> {
        let constant = line(affine(&[0, u_n], &[0, 0]), affine(&r, &[0, 0]));
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
            u: vec![integers(&[1, 0]), integers(&[5, 0]), integers(&[7, 0])],
            r: vec![integers(&[2, 0]), integers(&[4, 0]), integers(&[6, 0])],
        };
        let loads = [
            AppliedLoad {
                load: Load::Press,
                amount: whole(1),
            },
            AppliedLoad {
                load: Load::Left,
                amount: whole(1),
            },
            AppliedLoad {
                load: Load::Held(0),
                amount: rational(-1, 2),
            },
        ];

        let sum = Line::new(&response, &loads);

        // Twice everything, over twice the denominator, because of the half.
        assert_eq!(sum.denominator, Integer::from(6));
        assert_eq!(sum.u, affine(&[2 - 7, 0], &[10, 0]));
        assert_eq!(sum.r, affine(&[4 - 6, 0], &[8, 0]));

        let other_slope = Line {
            u: affine(&[-5, 0], &[11, 0]),
            ..Line::new(&response, &loads)
        };
        assert!(sum.meets(&other_slope, &whole(0)));
        assert!(!sum.meets(&other_slope, &whole(1)));
    }
}
