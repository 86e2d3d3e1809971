//! A stretch of the path on which everything is affine in the motion, and the conditions that
//! end it. All numbers are integers over common denominators: only signs and zeros are asked for.

use super::contact::{Contact, Friction, Load, Response};
use mceip_exact::{Integer, Rational, common_denominator};
use mceip_model::ContactState;
use num_traits::{Signed, Zero};

/// Displacements and reactions u(d) = (u0 + d u1) / den, r(d) = (r0 + d r1) / (den contact), per
/// unit of pressing; d is the motion in units of the pressing.
pub(super) struct Line {
    pub(super) denominator: Integer,
    pub(super) u: [Vec<Integer>; 2],
    pub(super) r: [Vec<Integer>; 2],
}

impl Line {
    /// Pressing + d times the motion + every held node at its place. `loads` belong to `response`.
    pub(super) fn new(response: &Response, loads: &[(Load, Rational)]) -> Line {
        let clear = common_denominator(loads.iter().map(|l| &l.1));
        let scale: Vec<Integer> = loads
            .iter()
            .map(|(_, c)| c.numer() * (&clear / c.denom()))
            .collect();
        let sum = |fields: &[Vec<Integer>], moving: bool| -> Vec<Integer> {
            let chosen = || {
                loads
                    .iter()
                    .zip(&scale)
                    .zip(fields)
                    .filter(|((l, _), _)| (l.0 == Load::Left) == moving)
            };
            let n = fields.first().map_or(0, Vec::len);
            (0..n)
                .map(|i| chosen().map(|((_, c), f)| c * &f[i]).sum())
                .collect()
        };
        Line {
            denominator: &response.denominator * clear,
            u: [sum(&response.u, false), sum(&response.u, true)],
            r: [sum(&response.r, false), sum(&response.r, true)],
        }
    }

    /// Component `i` of u at d = m / n, times `denominator` n.
    pub(super) fn u_at(&self, i: usize, d: &Rational) -> Integer {
        &self.u[0][i] * d.denom() + &self.u[1][i] * d.numer()
    }

    /// Component `i` of r at d = m / n, times `denominator` n and the contact's denominator.
    pub(super) fn r_at(&self, i: usize, d: &Rational) -> Integer {
        &self.r[0][i] * d.denom() + &self.r[1][i] * d.numer()
    }

    /// The value (constant, slope) of a bound, up to a positive factor.
    pub(super) fn form(&self, bound: Bound, friction: &Friction) -> [Integer; 2] {
        std::array::from_fn(|k| bound.value(&self.u[k], &self.r[k], friction))
    }

    /// Is it the same state as `other` at d, displacement for displacement?
    pub(super) fn meets(&self, other: &Line, d: &Rational) -> bool {
        (0..self.u[0].len())
            .all(|i| self.u_at(i, d) * &other.denominator == other.u_at(i, d) * &self.denominator)
    }

    /// The equilibrium at d, in mm and N for a pressing of `depth` mm.
    pub(super) fn equilibrium(
        &self,
        d: &Rational,
        depth: &Rational,
        contact: &Contact,
    ) -> Equilibrium {
        let n = self.u[0].len();
        let over = |extra: &Integer| {
            Rational::new_raw(
                depth.numer().clone(),
                depth.denom() * d.denom() * &self.denominator * extra,
            )
        };
        Equilibrium {
            motion: d * depth,
            u: (0..n).map(|i| self.u_at(i, d)).collect(),
            u_unit: over(&Integer::from(1)),
            r: (0..n).map(|i| self.r_at(i, d)).collect(),
            r_unit: over(contact.denominator()),
        }
    }
}

/// A quantity that contact and friction keep from being negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The gap of a free node, -u_N. // E1
    Gap {
        /// The node, from 0 at the left.
        node: usize,
    },
    /// The pressure of a node in contact, -r_N. // E1
    Pressure {
        /// The node, from 0 at the left.
        node: usize,
    },
    /// The distance from the friction cone, -mu r_N - sign r_T. // E7
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
    pub(super) fn value(self, u: &[Integer], r: &[Integer], friction: &Friction) -> Integer {
        match self {
            Bound::Gap { node } => -&u[2 * node + 1],
            Bound::Pressure { node } => -&r[2 * node + 1],
            Bound::Cone { node, sign } => {
                let (t, n) = friction.on_cone(1);
                -(&r[2 * node] * t * Integer::from(sign) + &r[2 * node + 1] * n)
            }
        }
    }

    /// The bounds that can end the stay of a node in this state.
    pub(super) fn of(node: usize, state: ContactState) -> Vec<Bound> {
        match state {
            ContactState::Free => vec![Bound::Gap { node }],
            ContactState::Slip { .. } => vec![Bound::Pressure { node }],
            // The two cones together imply the pressure.
            ContactState::Stick => vec![
                Bound::Cone { node, sign: 1 },
                Bound::Cone { node, sign: -1 },
            ],
        }
    }
}

/// The first motion after `from` at which a bound of these states becomes zero on its way down,
/// and every bound that does so there; `None` if none ever does.
pub(super) fn next_event(
    line: &Line,
    friction: &Friction,
    states: &[ContactState],
) -> Option<(Rational, Vec<Bound>)> {
    let mut first: Option<(Rational, Vec<Bound>)> = None;
    for bound in states
        .iter()
        .enumerate()
        .flat_map(|(k, &s)| Bound::of(k, s))
    {
        let [constant, slope] = line.form(bound, friction);
        if !slope.is_negative() {
            continue;
        }
        let fall = -slope;
        // Compare by products; a fraction is reduced for the winner only.
        let order = first
            .as_ref()
            .map(|(d, _)| (&constant * d.denom()).cmp(&(d.numer() * &fall)));
        match order {
            Some(std::cmp::Ordering::Greater) => {}
            Some(std::cmp::Ordering::Equal) => first.iter_mut().for_each(|f| f.1.push(bound)),
            _ => first = Some((Rational::new_raw(constant, fall), vec![bound])),
        }
    }
    first.map(|(d, bounds)| (d.reduced(), bounds))
}

/// An equilibrium (5) on the path: exact displacements and reactions of the contact nodes.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    motion: Rational,
    u: Vec<Integer>,
    u_unit: Rational,
    r: Vec<Integer>,
    r_unit: Rational,
}

impl Equilibrium {
    /// Motion of the glued side to the left, mm.
    pub fn motion(&self) -> &Rational {
        &self.motion
    }

    /// (u_T, u_N) of a node (from 0 at the left), mm: to the right, and into the obstacle.
    pub fn displacement(&self, node: usize) -> (Rational, Rational) {
        let part = |i: usize| {
            Rational::new(
                &self.u[i] * self.u_unit.numer(),
                self.u_unit.denom().clone(),
            )
        };
        (part(2 * node), part(2 * node + 1))
    }

    /// (r_T, r_N) of a node (from 0 at the left), N: r_N <= 0 in contact.
    pub fn reaction(&self, node: usize) -> (Rational, Rational) {
        (
            self.force(&self.r[2 * node]),
            self.force(&self.r[2 * node + 1]),
        )
    }

    /// Sums of r_T and of r_N over the contact nodes, N.
    pub fn resultants(&self) -> (Rational, Rational) {
        let sum = |offset: usize| self.force(&self.r.iter().skip(offset).step_by(2).sum());
        (sum(0), sum(1))
    }

    /// (r_T, r_N) of every node, each correctly rounded to a double, N.
    pub fn reactions_f64(&self) -> Vec<(f64, f64)> {
        let round = |r: &Integer| {
            mceip_exact::to_f64(&Rational::new_raw(
                r * self.r_unit.numer(),
                self.r_unit.denom().clone(),
            ))
        };
        self.r
            .chunks(2)
            .map(|p| (round(&p[0]), round(&p[1])))
            .collect()
    }

    fn force(&self, r: &Integer) -> Rational {
        Rational::new(r * self.r_unit.numer(), self.r_unit.denom().clone())
    }
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

/// The class of each node at d; `Err` with the node and the equation that fails there.
pub(super) fn classify(
    line: &Line,
    d: &Rational,
    friction: &Friction,
) -> Result<Vec<Class>, (usize, &'static str)> {
    let u: Vec<Integer> = (0..line.u[0].len()).map(|i| line.u_at(i, d)).collect();
    let r: Vec<Integer> = (0..line.u[0].len()).map(|i| line.r_at(i, d)).collect();
    let class = |node: usize| {
        let value = |b: Bound| b.value(&u, &r, friction);
        let (gap, pressure) = (value(Bound::Gap { node }), value(Bound::Pressure { node }));
        let [right, left] = [1, -1].map(|sign| value(Bound::Cone { node, sign }));
        if gap.is_negative() || pressure.is_negative() || !(gap.is_zero() || pressure.is_zero()) {
            return Err((node, "E1"));
        }
        if right.is_negative() || left.is_negative() {
            return Err((node, "E7"));
        }
        Ok(match (gap.is_zero(), pressure.is_zero()) {
            (false, _) => Class::Free,
            (true, true) => Class::Zero,
            _ if right.is_zero() => Class::Cone(1),
            _ if left.is_zero() => Class::Cone(-1),
            _ => Class::Stick,
        })
    };
    (0..u.len() / 2).map(class).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn z(v: &[i64]) -> Vec<Integer> {
        v.iter().map(|&v| v.into()).collect()
    }

    /// Two nodes, in the order u_T, u_N: constant and slope.
    fn line(u: [&[i64]; 2], r: [&[i64]; 2]) -> Line {
        Line {
            denominator: 1.into(),
            u: u.map(z),
            r: r.map(z),
        }
    }

    fn mu_two() -> Friction {
        Friction::new(&whole(2))
    }

    #[test]
    fn the_first_bound_on_its_way_down_ends_the_stretch() {
        // Node 0 free, gap 3 - 2 d; node 1 sticks, r = (d, -1): cone 2 - d.
        let path = line(
            [&[0, -3, 0, 0], &[0, 2, 0, 0]],
            [&[0, 0, 0, -1], &[0, 0, 1, 0]],
        );
        let states = [ContactState::Free, ContactState::Stick];
        assert_eq!(
            next_event(&path, &mu_two(), &states),
            Some((rational(3, 2), vec![Bound::Gap { node: 0 }]))
        );
        // Slope 3/2 instead of 2 (twice everything): both at d = 2.
        let both = line(
            [&[0, -6, 0, 0], &[0, 3, 0, 0]],
            [&[0, 0, 0, -2], &[0, 0, 2, 0]],
        );
        let bounds = vec![Bound::Gap { node: 0 }, Bound::Cone { node: 1, sign: 1 }];
        assert_eq!(
            next_event(&both, &mu_two(), &states),
            Some((whole(2), bounds))
        );
        // A slip node ends with its pressure, and nothing ends what only grows.
        let slip = [ContactState::Free, ContactState::Slip { sign: -1 }];
        let relief = line(
            [&[0, -3, 0, 0], &[0, -1, 0, 0]],
            [&[0, 0, -2, -1], &[0, 0, 2, 1]],
        );
        assert_eq!(
            next_event(&relief, &mu_two(), &slip),
            Some((whole(1), vec![Bound::Pressure { node: 1 }]))
        );
        let growth = line(
            [&[0, -3, 0, 0], &[0, -1, 0, 0]],
            [&[0, 0, -2, -1], &[0, 0, -2, -1]],
        );
        assert_eq!(next_event(&growth, &mu_two(), &slip), None);
    }

    #[test]
    fn classes_and_the_equations_that_forbid_others() {
        let of = |u_n: i64, r: [i64; 2]| {
            classify(
                &line([&[0, u_n], &[0, 0]], [&r, &[0, 0]]),
                &whole(5),
                &mu_two(),
            )
        };
        assert_eq!(of(-1, [0, 0]), Ok(vec![Class::Free]));
        assert_eq!(of(0, [0, 0]), Ok(vec![Class::Zero]));
        assert_eq!(of(0, [1, -1]), Ok(vec![Class::Stick]));
        assert_eq!(of(0, [2, -1]), Ok(vec![Class::Cone(1)]));
        assert_eq!(of(0, [-2, -1]), Ok(vec![Class::Cone(-1)]));
        assert_eq!(of(1, [0, 0]), Err((0, "E1")));
        assert_eq!(of(0, [0, 1]), Err((0, "E1")));
        assert_eq!(of(-1, [0, -1]), Err((0, "E1")));
        assert_eq!(of(0, [3, -1]), Err((0, "E7")));
    }

    #[test]
    fn held_nodes_enter_at_their_places() {
        let response = Response {
            denominator: 3.into(),
            u: vec![z(&[1, 0]), z(&[5, 0]), z(&[7, 0])],
            r: vec![z(&[2, 0]), z(&[4, 0]), z(&[6, 0])],
        };
        let loads = [
            (Load::Press, whole(1)),
            (Load::Left, whole(1)),
            (Load::Held(0), rational(-1, 2)),
        ];
        let sum = Line::new(&response, &loads);
        assert_eq!(
            (sum.denominator.clone(), sum.u.clone()),
            (Integer::from(6), [z(&[2 - 7, 0]), z(&[10, 0])])
        );
        assert_eq!(sum.r, [z(&[4 - 6, 0]), z(&[8, 0])]);
        let other = Line {
            u: [z(&[-5, 0]), z(&[11, 0])],
            ..Line::new(&response, &loads)
        };
        assert!(sum.meets(&other, &whole(0)) && !sum.meets(&other, &whole(1)));
    }
}
