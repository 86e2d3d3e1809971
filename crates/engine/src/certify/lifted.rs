//! An exact claim about the pencil as a claim about the mechanical system, and the way back.
//!
//! The claim about the system has v and w for every line of (9). With x = (x_f, x_s), (10) gives
//!
//! ```text
//! v_f = x_f,    v_Ts = -S x_s,    all other components of v are 0,    w = (t M + K) v,
//! ```
//!
//! w = K v for MCEIP-mu. With x = (.., g, v+, v-) a particle in contact with zero reaction has
//! v_N = -g and v_T = v+ - v-, where v+ or v- is 0 (`spec/zero-reaction.md`, Z.3).
//!
//! Components are polynomials in the value t, the constant coefficient first, reduced modulo the
//! claim's polynomial. Nothing is checked here. Called by the command `certify` and by reports.

use mceip_check::certificate::{ExactSolution, LiftedSolution};
use mceip_exact::{Rational, Sparse};
use mceip_model::file::Number;
use mceip_model::reduction::variables;
use mceip_model::{Direction, System, Unknown};
use num_traits::Zero;

/// A polynomial in the value, the constant coefficient first.
type Coefficients = Vec<Rational>;

/// Lifts x to v (E10: v_T = -S x, nothing else moves but the free dofs) and w = (t M + K) v, both
/// reduced modulo the claim's polynomial.
pub fn lifted(system: &System, unknown: Unknown, claim: &ExactSolution) -> LiftedSolution {
    let mut v: Vec<Coefficients> = vec![Vec::new(); system.dofs()];
    for (variable, x) in variables(system).iter().zip(&claim.x) {
        let x = rationals(x);
        for (dof, c) in variable.column() {
            add(&mut v[dof], &c, &x, 0);
        }
    }

    let mut w: Vec<Coefficients> = vec![Vec::new(); system.dofs()];
    add_product(&mut w, system.stiffness(), &v, 0);
    if let (Unknown::Lambda2, Some(mass)) = (unknown, system.mass()) {
        add_product(&mut w, mass, &v, 1);
    }

    let polynomial = claim.polynomial.iter().cloned();
    let polynomial: Coefficients = polynomial.map(Rational::from_integer).collect();
    LiftedSolution {
        support: claim.support.clone(),
        biactive: claim.biactive.clone(),
        polynomial: claim.polynomial.clone(),
        interval: claim.interval.clone(),
        v: reduced(v, &polynomial),
        w: reduced(w, &polynomial),
    }
}

/// The pencil's x behind a lifted claim: the way back of [`lifted`]. A v that is too short counts
/// as continued with zeros.
pub fn flattened(system: &System, claim: &LiftedSolution) -> ExactSolution {
    let mut x: Vec<Coefficients> = Vec::new();
    for (index, variable) in variables(system).iter().enumerate() {
        // v_T > 0 is said by the support.
        let is_at_rest = variable.is_half() && !claim.support.contains(&index);
        x.push(if is_at_rest {
            Vec::new()
        } else {
            along(&variable.column(), &claim.v)
        });
    }

    ExactSolution {
        support: claim.support.clone(),
        biactive: claim.biactive.clone(),
        polynomial: claim.polynomial.clone(),
        interval: claim.interval.clone(),
        x: x.into_iter().map(numbers).collect(),
    }
}

/// The component of v along a direction.
fn along(direction: &Direction, v: &[Vec<Number>]) -> Coefficients {
    let mut sum = Vec::new();
    for (dof, c) in direction {
        add(&mut sum, c, &component(v, *dof), 0);
    }

    sum
}

/// Component `dof` of v; zero beyond its end.
fn component(v: &[Vec<Number>], dof: usize) -> Coefficients {
    v.get(dof).map(|p| rationals(p)).unwrap_or_default()
}

fn rationals(numbers: &[Number]) -> Coefficients {
    numbers.iter().map(|number| number.0.clone()).collect()
}

fn numbers(coefficients: Coefficients) -> Vec<Number> {
    coefficients.into_iter().map(Number).collect()
}

/// Adds `factor * t^shift * p` to a sum.
fn add(sum: &mut Coefficients, factor: &Rational, p: &[Rational], shift: usize) {
    if sum.len() < p.len() + shift {
        sum.resize(p.len() + shift, Rational::zero());
    }

    for (k, c) in p.iter().enumerate() {
        sum[k + shift] += factor * c;
    }
}

/// Adds `t^shift * matrix * v` to w.
fn add_product(w: &mut [Coefficients], matrix: &Sparse, v: &[Coefficients], shift: usize) {
    for (row, column, value) in matrix.entries() {
        add(&mut w[row], value, &v[column], shift);
    }
}

/// All components modulo the polynomial.
fn reduced(components: Vec<Coefficients>, polynomial: &[Rational]) -> Vec<Vec<Number>> {
    let mut reduced = Vec::new();
    for component in components {
        reduced.push(numbers(remainder(component, polynomial)));
    }

    reduced
}

/// `rest` mod p over Q, without leading zeros; `rest` itself where p is constant.
pub(super) fn remainder(mut rest: Coefficients, p: &[Rational]) -> Coefficients {
    let length = p.len();
    let lead = p.last().filter(|lead| length > 1 && !lead.is_zero());
    let Some(lead) = lead else {
        return rest;
    };

    while rest.len() >= length {
        let top = rest.pop().unwrap_or_else(Rational::zero) / lead;
        let shift = rest.len() + 1 - length;
        for (k, c) in p[..length - 1].iter().enumerate() {
            rest[shift + k] -= &top * c;
        }
    }

    while rest.last().is_some_and(Zero::is_zero) {
        rest.pop();
    }

    rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn remainder_of(g: &[i64], p: &[i64]) -> Vec<Rational> {
        let g = g.iter().map(|&c| whole(c)).collect();
        let p: Vec<Rational> = p.iter().map(|&c| whole(c)).collect();
        remainder(g, &p)
    }

    #[test]
    fn remainders_are_shorter_than_the_divisor() {
        // t^2 = 2
        assert_eq!(
            remainder_of(&[1, 2, 3, 4], &[-2, 0, 1]),
            [whole(7), whole(10)]
        );
        assert_eq!(remainder_of(&[0, 0, 1], &[1, 0, 3]), [rational(-1, 3)]);
        assert_eq!(remainder_of(&[5, 1], &[-2, 1]), [whole(7)]);
        assert_eq!(remainder_of(&[-4, 2], &[-2, 1]), []);
        assert_eq!(remainder_of(&[5, 1], &[-2, 0, 1]), [whole(5), whole(1)]);
        // No polynomial to divide by.
        assert_eq!(remainder_of(&[5, 1], &[3]), [whole(5), whole(1)]);
    }
}
