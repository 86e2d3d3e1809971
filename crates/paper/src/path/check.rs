//! The laws at a point of the path, from their definitions: equilibrium (5) by multiplying out the
//! condensed stiffness C, then contact (1), friction (2), the cone (7) and the state (9) node by
//! node.
//!
//! Shares nothing with the search for states but the numbers it checks. Called by `trace` at both
//! ends of every stretch.

use super::contact::{Contact, Friction, Load};
use super::error::LawFailure;
use super::line::Line;
use mceip_exact::{Integer, Rational};
use mceip_model::ContactState;
use num_traits::{Signed, Zero};

/// A point of the path, with the states and rates that are taken to hold there.
pub(super) struct PathPoint<'a> {
    pub(super) contact: &'a Contact,
    pub(super) friction: &'a Friction,
    pub(super) states: &'a [ContactState],
    pub(super) line: &'a Line,
    /// The motion, in units of the pressing.
    pub(super) d: &'a Rational,
    /// What grows.
    pub(super) moving: Load,
}

impl PathPoint<'_> {
    /// Do (1), (2), (5), (7) hold, with these states?
    ///
    /// # Errors
    /// The first law that fails: equilibrium first, then node by node.
    pub(super) fn check(&self) -> Result<(), LawFailure> {
        let u = self.line.u.all_at(self.d);
        let r = self.line.r.all_at(self.d);
        self.check_equilibrium(&u, &r)?;

        let velocities = self.line.rates(self.moving).u;
        for (node, &state) in self.states.iter().enumerate() {
            let values = NodeValues {
                friction: self.friction,
                u_n: &u[2 * node + 1],
                r_t: &r[2 * node],
                r_n: &r[2 * node + 1],
                v_t: &velocities[2 * node],
            };
            if let Some(equation) = values.first_failure(state) {
                return Err(LawFailure { node, equation });
            }
        }

        Ok(())
    }

    /// r = C (u - g), where g is the motion of the glued side. // (5)
    fn check_equilibrium(&self, u: &[Integer], r: &[Integer]) -> Result<(), LawFailure> {
        let press = self.contact.relative(Load::Press);
        let left = self.contact.relative(Load::Left);

        // With d = m / n, everything in units of 1 / (n times the denominator of the line).
        let mut relative = Vec::with_capacity(u.len());
        for i in 0..u.len() {
            let imposed = &press[i] * self.d.denom() + &left[i] * self.d.numer();
            relative.push(&u[i] + imposed * &self.line.denominator);
        }

        let expected = self.contact.times(&relative);
        for i in 0..r.len() {
            if expected[i] != r[i] {
                return Err(LawFailure {
                    node: i / 2,
                    equation: "E5",
                });
            }
        }

        Ok(())
    }
}

/// Displacement, reaction and tangential velocity of one node, each up to a positive factor.
struct NodeValues<'a> {
    friction: &'a Friction,
    u_n: &'a Integer,
    r_t: &'a Integer,
    r_n: &'a Integer,
    v_t: &'a Integer,
}

impl NodeValues<'_> {
    /// The first equation that fails, if one does.
    fn first_failure(&self, state: ContactState) -> Option<&'static str> {
        if !self.contact_holds() {
            return Some("E1");
        }
        if !self.is_in_cone() {
            return Some("E7");
        }
        if !self.friction_holds() {
            return Some("E2");
        }
        if !self.is_in(state) {
            return Some("E9");
        }

        None
    }

    /// u_N <= 0, r_N <= 0, u_N r_N = 0. // (1)
    fn contact_holds(&self) -> bool {
        let does_not_penetrate = !self.u_n.is_positive();
        let pushes = !self.r_n.is_positive();
        let one_is_zero = self.u_n.is_zero() || self.r_n.is_zero();
        does_not_penetrate && pushes && one_is_zero
    }

    /// |r_T| <= -mu r_N. // (7)
    fn is_in_cone(&self) -> bool {
        let tangential = self.r_t.abs() * &self.friction.denominator;
        tangential <= -self.mu_r_n()
    }

    /// |v_T| r_T = mu v_T r_N (2): a node that moves is on the cone, on the side against its
    /// motion.
    fn friction_holds(&self) -> bool {
        let speed_times_r_t = self.v_t.abs() * self.r_t;
        let tangential = speed_times_r_t * &self.friction.denominator;
        tangential == self.v_t * self.mu_r_n()
    }

    /// The state is that of the rates: where it says slip, the law holds along the way. // (9)
    fn is_in(&self, state: ContactState) -> bool {
        match state {
            ContactState::Free | ContactState::Zero => self.r_t.is_zero() && self.r_n.is_zero(),
            ContactState::Stick => self.u_n.is_zero() && self.v_t.is_zero(),
            ContactState::Slip { sign } => {
                let sign = Integer::from(sign);
                let tangential = self.r_t * &self.friction.denominator;
                let is_on_cone = tangential == -(self.mu_r_n() * &sign);
                let slides_against = !(self.v_t * sign).is_positive();
                self.u_n.is_zero() && is_on_cone && slides_against
            }
        }
    }

    /// mu r_N times the denominator of mu.
    fn mu_r_n(&self) -> Integer {
        &self.friction.numerator * self.r_n
    }
}

#[cfg(test)]
mod tests {
    use super::super::line::Affine;
    use super::*;
    use mceip_exact::{Sparse, rational, whole};

    const SLIP: ContactState = ContactState::Slip { sign: 1 };

    fn affine(constant: [i64; 2], slope: [i64; 2]) -> Affine {
        Affine {
            constant: constant.map(Integer::from).to_vec(),
            slope: slope.map(Integer::from).to_vec(),
        }
    }

    /// One node with stiffness 2 along and 3 across, pressed by 1 and moved by d with mu = 1: it
    /// sticks with r = (2 d, -3) up to d = 3/2 and then slips with r = (3, -3), u_T = 3/2 - d.
    fn check_at(
        state: ContactState,
        d: Rational,
        change: impl Fn(&mut Line),
    ) -> Result<(), LawFailure> {
        let contact = Contact::from_condensed(&Sparse::from_ints(&[&[2, 0], &[0, 3]]));
        let mut line = match state {
            ContactState::Stick => Line {
                denominator: 1.into(),
                u: affine([0, 0], [0, 0]),
                r: affine([0, -3], [2, 0]),
            },
            _ => Line {
                denominator: 2.into(),
                u: affine([3, 0], [-2, 0]),
                r: affine([6, -6], [0, 0]),
            },
        };
        change(&mut line);

        let point = PathPoint {
            contact: &contact,
            friction: &Friction::new(&whole(1)),
            states: &[state],
            line: &line,
            d: &d,
            moving: Load::Left,
        };
        point.check()
    }

    fn unchanged(_: &mut Line) {}

    /// r_T is not what C gives.
    fn reaction_differs(line: &mut Line) {
        line.r.constant[0] += 1;
    }

    /// In equilibrium, but the node stands in the obstacle, which pulls: u_N = 2, r_N = 3.
    fn obstacle_pulls(line: &mut Line) {
        line.u.constant[1] = 2.into();
        line.r.constant[1] = 3.into();
    }

    /// Equilibrium with r = (3, -3) at d = 2, but sliding to the right, where r_T > 0 drives:
    /// u_T = d - 5/2.
    fn slides_backwards(line: &mut Line) {
        line.u = affine([-5, 0], [2, 0]);
        line.r = affine([-10, -6], [8, 0]);
    }

    fn fails(equation: &'static str) -> Result<(), LawFailure> {
        Err(LawFailure { node: 0, equation })
    }

    #[test]
    fn true_states_pass_and_each_law_catches_its_breach() {
        let stick = ContactState::Stick;
        assert_eq!(check_at(stick, whole(1), unchanged), Ok(()));
        assert_eq!(check_at(stick, rational(3, 2), unchanged), Ok(()));
        assert_eq!(check_at(SLIP, whole(2), unchanged), Ok(()));

        assert_eq!(check_at(stick, rational(8, 5), unchanged), fails("E7"));
        assert_eq!(check_at(stick, whole(1), reaction_differs), fails("E5"));
        assert_eq!(check_at(stick, whole(1), obstacle_pulls), fails("E1"));
        assert_eq!(check_at(SLIP, whole(2), slides_backwards), fails("E2"));

        // The reaction (3, -3) is on the other side of the cone than S = -1 says, and not zero.
        let other_side = ContactState::Slip { sign: -1 };
        assert_eq!(check_at(other_side, whole(2), unchanged), fails("E9"));
        assert_eq!(
            check_at(ContactState::Free, whole(2), unchanged),
            fails("E9")
        );
    }
}
