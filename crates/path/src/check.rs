//! The laws at a point of the path, from their definitions: the loads applied as they are asked
//! for, equilibrium (5) by multiplying out the condensed stiffness C, then contact (1), friction
//! (2), the cone (7) and the state (9) candidate by candidate.
//!
//! Shares nothing with the search for states but the numbers it checks. Called by `trace` at both
//! ends of every stretch.

use super::contact::{Contact, FrictionCoefficients};
use super::error::LawFailure;
use super::line::{Amount, AppliedLoad, Class, EquilibriumLine};
use mceip_exact::{Integer, Rational};
use mceip_model::ContactState;
use num_traits::{Signed, Zero};

/// A point of the path, with the states and rates that are taken to hold there.
pub(super) struct PathPoint<'a> {
    pub(super) contact: &'a Contact,
    pub(super) friction: &'a FrictionCoefficients,
    pub(super) states: &'a [ContactState],
    pub(super) line: &'a EquilibriumLine,
    /// How much of each load is applied.
    pub(super) applied: &'a [AppliedLoad],
    /// The amount of the load that grows.
    pub(super) a: &'a Rational,
}

impl PathPoint<'_> {
    /// Do (1), (2), (5), (7) hold, with these states?
    ///
    /// # Errors
    /// The first law that fails: equilibrium first, then node by node.
    pub(super) fn check(&self) -> Result<(), LawFailure> {
        let w = self.line.w.all_at(self.a);
        let r = self.line.r.all_at(self.a);
        self.check_loads(&w)?;
        self.check_equilibrium(&w, &r)?;

        let velocities = self.line.rates().w;
        for (node, &state) in self.states.iter().enumerate() {
            let values = NodeValues {
                friction: self.friction.of(node),
                w_n: &w[2 * node + 1],
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

    /// Do the rates just after this point fit the classes of the candidates here? // (9)
    ///
    /// # Errors
    /// The first candidate at which they do not.
    pub(super) fn check_rates(&self, classes: &[Class]) -> Result<(), LawFailure> {
        let rates = self.line.rates();
        for (node, &class) in classes.iter().enumerate() {
            let rates = NodeRates {
                friction: self.friction.of(node),
                v_t: &rates.w[2 * node],
                v_n: &rates.w[2 * node + 1],
                r_t: &rates.r[2 * node],
                r_n: &rates.r[2 * node + 1],
            };
            if !rates.fit(class) {
                return Err(LawFailure {
                    node,
                    equation: "E9",
                });
            }
        }

        Ok(())
    }

    /// The amounts in w are those asked for; of a load that is not asked for there is none.
    fn check_loads(&self, w: &[Integer]) -> Result<(), LawFailure> {
        // With a = m / n, w is in units of 1 / (n times the denominator of the line).
        let unit = Rational::from_integer(self.a.denom() * &self.line.denominator);

        for component in self.contact.rows().len()..w.len() {
            let mut applied = self.applied.iter();
            let asked = match applied.find(|load| self.contact.component(load.load) == component) {
                None => Rational::zero(),
                Some(load) => match &load.amount {
                    Amount::Fixed(amount) => amount.clone(),
                    Amount::Growing => self.a.clone(),
                },
            };
            if Rational::from_integer(w[component].clone()) != asked * &unit {
                return Err(LawFailure {
                    node: 0,
                    equation: "E5",
                });
            }
        }

        Ok(())
    }

    /// r = C u - sum a_l h_l, one product with w. // (5)
    fn check_equilibrium(&self, w: &[Integer], r: &[Integer]) -> Result<(), LawFailure> {
        let expected = self.contact.times(w);
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

/// Displacement, reaction and tangential velocity of one candidate, each up to a positive factor.
struct NodeValues<'a> {
    /// mu of this candidate.
    friction: &'a Rational,
    /// u_N - gap.
    w_n: &'a Integer,
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

    /// w_N <= 0, r_N <= 0, w_N r_N = 0 for w_N = u_N - gap. // (1)
    fn contact_holds(&self) -> bool {
        let does_not_penetrate = !self.w_n.is_positive();
        let pushes = !self.r_n.is_positive();
        let one_is_zero = self.w_n.is_zero() || self.r_n.is_zero();
        does_not_penetrate && pushes && one_is_zero
    }

    /// |r_T| <= -mu r_N. // (7)
    fn is_in_cone(&self) -> bool {
        let tangential = self.r_t.abs() * self.friction.denom();
        tangential <= -self.mu_r_n()
    }

    /// |v_T| r_T = mu v_T r_N (2): a node that moves is on the cone, on the side against its
    /// motion.
    fn friction_holds(&self) -> bool {
        let speed_times_r_t = self.v_t.abs() * self.r_t;
        let tangential = speed_times_r_t * self.friction.denom();
        tangential == self.v_t * self.mu_r_n()
    }

    /// The state is that of the rates: where it says slip, the law holds along the way. // (9)
    fn is_in(&self, state: ContactState) -> bool {
        match state {
            ContactState::Free | ContactState::Zero => self.r_t.is_zero() && self.r_n.is_zero(),
            ContactState::Stick => self.w_n.is_zero() && self.v_t.is_zero(),
            ContactState::Slip { sign } => {
                let sign = Integer::from(sign);
                let tangential = self.r_t * self.friction.denom();
                let is_on_cone = tangential == -(self.mu_r_n() * &sign);
                let slides_against = !(self.v_t * sign).is_positive();
                self.w_n.is_zero() && is_on_cone && slides_against
            }
        }
    }

    /// mu r_N times the denominator of mu.
    fn mu_r_n(&self) -> Integer {
        self.friction.numer() * self.r_n
    }
}

/// Rates of displacement and reaction of one candidate, each up to a positive factor.
struct NodeRates<'a> {
    /// mu of this candidate.
    friction: &'a Rational,
    v_t: &'a Integer,
    v_n: &'a Integer,
    r_t: &'a Integer,
    r_n: &'a Integer,
}

impl NodeRates<'_> {
    /// The line of (9) for this class, with rates.
    fn fit(&self, class: Class) -> bool {
        let mu_r_n = self.friction.numer() * self.r_n;
        match class {
            Class::Free => self.r_t.is_zero() && self.r_n.is_zero(),
            Class::Stick => self.v_t.is_zero() && self.v_n.is_zero(),
            Class::Cone(sign) => {
                let sign = Integer::from(sign);
                let x = -(&sign * self.v_t);
                let y = -(&sign * self.r_t * self.friction.denom() + mu_r_n);
                let are_signs = !x.is_negative() && !y.is_negative();
                self.v_n.is_zero() && are_signs && (x.is_zero() || y.is_zero())
            }
            Class::Zero => {
                let are_signs = !self.v_n.is_positive() && !self.r_n.is_positive();
                let is_contact = are_signs && (self.v_n.is_zero() || self.r_n.is_zero());
                let is_in_cone = self.r_t.abs() * self.friction.denom() <= -&mu_r_n;
                let work = self.v_t.abs() * self.r_t * self.friction.denom();
                is_contact && is_in_cone && work == self.v_t * mu_r_n
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::contact::Load;
    use super::super::line::Affine;
    use super::*;
    use mceip_exact::{rational, whole};

    const SLIP: ContactState = ContactState::Slip { sign: 1 };

    fn affine<const N: usize>(constant: [i64; N], slope: [i64; N]) -> Affine {
        Affine {
            constant: constant.map(Integer::from).to_vec(),
            slope: slope.map(Integer::from).to_vec(),
        }
    }

    /// One candidate with stiffness 2 along and 3 across, under the loads (0, 3) and a (-2, 0) with
    /// mu = 1: it sticks with r = (2 a, -3) up to a = 3/2 and then slips with r = (3, -3),
    /// u_T = 3/2 - a. Components of w: w_T, w_N, the amounts of the two loads and of the gap.
    fn check_at(
        state: ContactState,
        a: Rational,
        change: impl Fn(&mut EquilibriumLine),
    ) -> Result<(), LawFailure> {
        let contact = Contact::plain(
            vec![vec![whole(2), whole(0)], vec![whole(0), whole(3)]],
            vec![vec![whole(0), whole(3)], vec![whole(-2), whole(0)]],
        );
        let applied = [
            AppliedLoad {
                load: Load::Step(0),
                amount: Amount::Fixed(whole(1)),
            },
            AppliedLoad {
                load: Load::Step(1),
                amount: Amount::Growing,
            },
        ];
        let mut line = match state {
            ContactState::Stick => EquilibriumLine {
                denominator: 1.into(),
                w: affine([0, 0, 1, 0, 0], [0, 0, 0, 1, 0]),
                r: affine([0, -3], [2, 0]),
            },
            _ => EquilibriumLine {
                denominator: 2.into(),
                w: affine([3, 0, 2, 0, 0], [-2, 0, 0, 2, 0]),
                r: affine([6, -6], [0, 0]),
            },
        };
        change(&mut line);

        let point = PathPoint {
            contact: &contact,
            friction: &FrictionCoefficients::new(&whole(1), &contact),
            states: &[state],
            line: &line,
            applied: &applied,
            a: &a,
        };
        point.check()
    }

    fn unchanged(_: &mut EquilibriumLine) {}

    /// r_T is not what C gives.
    fn reaction_differs(line: &mut EquilibriumLine) {
        line.r.constant[0] += 1;
    }

    /// In equilibrium, but the node stands in the obstacle, which pulls: u_N = 2, r_N = 3.
    fn obstacle_pulls(line: &mut EquilibriumLine) {
        line.w.constant[1] = 2.into();
        line.r.constant[1] = 3.into();
    }

    /// Half as much again of the second load as asked for, with its reaction.
    fn load_differs(line: &mut EquilibriumLine) {
        line.w.slope[3] = 3.into();
        line.r.slope[0] = 3.into();
    }

    /// Equilibrium with r = (3, -3) at a = 2, but sliding to the right, where r_T > 0 drives:
    /// u_T = a - 5/2.
    fn slides_backwards(line: &mut EquilibriumLine) {
        line.w = affine([-5, 0, 2, 0, 0], [2, 0, 0, 2, 0]);
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
        assert_eq!(check_at(stick, whole(1), load_differs), fails("E5"));
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

    /// Do rates (v_T, v_N), (r_T', r_N') fit a class, with mu = 1/2?
    fn fit(class: Class, v: [i64; 2], r: [i64; 2]) -> bool {
        let [v_t, v_n, r_t, r_n] = [v[0], v[1], r[0], r[1]].map(Integer::from);
        let rates = NodeRates {
            friction: &rational(1, 2),
            v_t: &v_t,
            v_n: &v_n,
            r_t: &r_t,
            r_n: &r_n,
        };
        rates.fit(class)
    }

    /// Each line of (9) for rates, and a near miss beside each.
    #[test]
    fn rates_fit_their_class_alone() {
        assert!(fit(Class::Free, [5, -7], [0, 0]));
        assert!(!fit(Class::Free, [5, -7], [0, -1]));
        assert!(!fit(Class::Free, [5, -7], [1, 0]));

        assert!(fit(Class::Stick, [0, 0], [9, 9]));
        assert!(!fit(Class::Stick, [1, 0], [9, 9]));
        assert!(!fit(Class::Stick, [0, -1], [9, 9]));

        // y = -(2 r_T' + r_N') / 2 and x = -v_T at S = 1.
        let cone = Class::Cone(1);
        assert!(fit(cone, [-3, 0], [1, -2]), "slips, y = 0");
        assert!(fit(cone, [0, 0], [-1, -2]), "sticks, y > 0");
        assert!(!fit(cone, [-3, 0], [-1, -2]), "x y > 0");
        assert!(!fit(cone, [3, 0], [1, -2]), "slides with friction");
        assert!(!fit(cone, [0, 0], [2, -2]), "leaves the cone");
        assert!(!fit(cone, [-3, -1], [1, -2]), "opens with a reaction");
        assert!(fit(Class::Cone(-1), [3, 0], [-1, -2]));

        assert!(fit(Class::Zero, [4, -1], [0, 0]), "opens");
        assert!(fit(Class::Zero, [0, 0], [1, -4]), "sticks");
        assert!(fit(Class::Zero, [-3, 0], [2, -4]), "slips");
        assert!(!fit(Class::Zero, [0, 1], [0, 0]), "penetrates");
        assert!(!fit(Class::Zero, [0, 0], [0, 1]), "is pulled");
        assert!(!fit(Class::Zero, [0, -1], [0, -1]), "pressed at a distance");
        assert!(!fit(Class::Zero, [0, 0], [3, -4]), "outside the cone");
        assert!(!fit(Class::Zero, [-3, 0], [1, -4]), "slips inside the cone");
        assert!(!fit(Class::Zero, [3, 0], [2, -4]), "slides with friction");
    }
}
