//! The laws at a point of the path, from their definitions: (5) by multiplying out S, then (1),
//! (2) and (7) node by node. Shares nothing with the search for states but the numbers it checks.

use super::contact::{Contact, Friction, Load};
use super::line::Line;
use mceip_exact::{Integer, Rational};
use mceip_model::ContactState;
use num_traits::{Signed, Zero};

/// A law that fails: node (from 0 at the left) and equation.
pub(super) type Failure = (usize, &'static str);

/// Do (1), (2), (5), (7) hold at d on the line, with these states? `moving` says what grows.
pub(super) fn check(
    contact: &Contact,
    friction: &Friction,
    states: &[ContactState],
    line: &Line,
    d: &Rational,
    moving: Load,
) -> Result<(), Failure> {
    let n = contact.rows().len();
    let u: Vec<Integer> = (0..n).map(|i| line.u_at(i, d)).collect();
    let r: Vec<Integer> = (0..n).map(|i| line.r_at(i, d)).collect();
    // Displacements relative to the glued side, in the same unit 1 / (line n).
    let (press, left) = (contact.relative(Load::Press), contact.relative(Load::Left));
    let imposed = |i: usize| &press[i] * d.denom() + &left[i] * d.numer();
    let w: Vec<Integer> = (0..n)
        .map(|i| &u[i] + imposed(i) * &line.denominator)
        .collect();
    if let Some(i) = contact.times(&w).iter().zip(&r).position(|(s, r)| s != r) {
        return Err((i / 2, "E5"));
    }
    let velocity = |i: usize| {
        if moving == Load::Press {
            &line.u[0][i]
        } else {
            &line.u[1][i]
        }
    };
    for (k, state) in states.iter().enumerate() {
        let (u_n, r_t, r_n, v_t) = (&u[2 * k + 1], &r[2 * k], &r[2 * k + 1], velocity(2 * k));
        let (mu, one) = (&friction.numerator, &friction.denominator); // mu = mu / one
        let laws = [
            (
                "E1",
                !u_n.is_positive() && !r_n.is_positive() && (u_n * r_n).is_zero(),
            ),
            ("E7", r_t.abs() * one <= -(mu * r_n)),
            ("E2", v_t.abs() * r_t * one == mu * v_t * r_n),
            // The state is that of the rates: where it says slip, the law holds along the way.
            (
                "E9",
                match state {
                    ContactState::Free => r_t.is_zero() && r_n.is_zero(),
                    ContactState::Stick => u_n.is_zero() && v_t.is_zero(),
                    ContactState::Slip { sign } => {
                        let sign = Integer::from(*sign);
                        u_n.is_zero()
                            && r_t * one == -(mu * r_n * &sign)
                            && !(v_t * sign).is_positive()
                    }
                },
            ),
        ];
        if let Some((equation, _)) = laws.into_iter().find(|l| !l.1) {
            return Err((k, equation));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, rational, whole};

    const SLIP: ContactState = ContactState::Slip { sign: 1 };

    fn z(v: [i64; 2]) -> Vec<Integer> {
        v.map(Integer::from).to_vec()
    }

    /// One node with stiffness 2 along and 3 across, pressed by 1 and moved by d with mu = 1: it
    /// sticks with r = (2 d, -3) up to d = 3/2 and then slips with r = (3, -3), u_T = 3/2 - d.
    fn check_at(
        states: ContactState,
        d: Rational,
        change: impl Fn(&mut Line),
    ) -> Result<(), Failure> {
        let contact = Contact::from_condensed(&Sparse::from_ints(&[&[2, 0], &[0, 3]]));
        let mut line = match states {
            ContactState::Stick => Line {
                denominator: 1.into(),
                u: [z([0, 0]), z([0, 0])],
                r: [z([0, -3]), z([2, 0])],
            },
            _ => Line {
                denominator: 2.into(),
                u: [z([3, 0]), z([-2, 0])],
                r: [z([6, -6]), z([0, 0])],
            },
        };
        change(&mut line);
        check(
            &contact,
            &Friction::new(&whole(1)),
            &[states],
            &line,
            &d,
            Load::Left,
        )
    }

    #[test]
    fn true_states_pass_and_each_law_catches_its_breach() {
        assert_eq!(check_at(ContactState::Stick, whole(1), |_| ()), Ok(()));
        assert_eq!(
            check_at(ContactState::Stick, rational(3, 2), |_| ()),
            Ok(())
        );
        assert_eq!(check_at(SLIP, whole(2), |_| ()), Ok(()));
        assert_eq!(
            check_at(ContactState::Stick, rational(8, 5), |_| ()),
            Err((0, "E7"))
        );
        assert_eq!(
            check_at(ContactState::Stick, whole(1), |l| l.r[0][0] += 1),
            Err((0, "E5"))
        );
        // In equilibrium, but the obstacle pulls: u_N = -2 in contact.
        assert_eq!(
            check_at(ContactState::Stick, whole(1), |l| (l.u[0][1], l.r[0][1]) =
                (2.into(), 3.into())),
            Err((0, "E1"))
        );
        // Equilibrium with r = (3, -3) at d = 2, but sliding to the right, where r_T > 0 drives:
        // u_T = d - 5/2.
        let backwards = |l: &mut Line| {
            (l.u, l.r) = ([z([-5, 0]), z([2, 0])], [z([-10, -6]), z([8, 0])]);
        };
        assert_eq!(check_at(SLIP, whole(2), backwards), Err((0, "E2")));
        // A node on the cone that does not move may be called either; inside the cone it sticks.
        assert_eq!(
            check_at(ContactState::Slip { sign: -1 }, whole(2), |_| ()),
            Err((0, "E9"))
        );
        assert_eq!(
            check_at(ContactState::Free, whole(2), |_| ()),
            Err((0, "E9"))
        );
    }
}
