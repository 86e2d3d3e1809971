//! From v over all degrees of freedom back to x of the pencil: the other direction of (10).
//!
//! x_f = v_f, and x_s = -S v_T for each slip particle, with v_T the component of v along its unit
//! tangent. What x does not explain of v is measured; nothing is left of a v that x lifts to.
//! Exact.
//!
//! Input: the variables that `reduce` names, and v. Output: [`Projected`]. Called by `foreign`,
//! which reads modes that other programs report.

use mceip_exact::Rational;
use mceip_model::ReducedVariable;
use num_traits::{Signed, Zero};
use std::cmp::Reverse;

/// x of (10) for a given v, and what of v it leaves unexplained.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Projected {
    /// x over the variables of the pencil.
    pub x: Vec<Rational>,
    /// The dof at which v differs most from what x lifts to (v_d = 0, v_Ns = 0), and by how much,
    /// relative to the largest component of v. `None` where v is what x lifts to.
    pub off: Option<(usize, Rational)>,
}

/// x_f = v_f and x_s = -S v_Ts for each slip particle, exactly; `variables` as `reduce` gives them.
///
/// The constraints v_d = 0 and v_Ns = 0 of (9) are not imposed: `off` says how far v is from them.
/// Components of v beyond those the variables name count as constrained.
///
/// ```
/// use mceip_exact::whole;
/// use mceip_engine::reduction::project;
/// use mceip_model::ReducedVariable;
/// let slip = ReducedVariable::Slip {
///     sign: 1,
///     tangent: vec![(0, whole(1))],
///     normal: vec![(1, whole(1))],
/// };
/// let p = project(&[slip], &[whole(-2), whole(1)]);
/// assert_eq!(
///     (p.x, p.off),
///     (vec![whole(2)], Some((1, whole(1) / whole(2))))
/// );
/// ```
pub fn project(variables: &[ReducedVariable], v: &[Rational]) -> Projected {
    let mut unexplained = v.to_vec();
    let mut x = Vec::with_capacity(variables.len());
    for variable in variables {
        let column = variable.column();
        let terms = column.iter().map(|(dof, c)| c * component(v, *dof));
        let along: Rational = terms.sum();
        if variable.is_half() && along.is_negative() {
            x.push(Rational::zero()); // v_T is that of the other half
            continue;
        }

        for (dof, c) in &column {
            if let Some(rest) = unexplained.get_mut(*dof) {
                *rest -= c * &along;
            }
        }
        x.push(along);
    }

    Projected {
        x,
        off: largest_share(&unexplained, v),
    }
}

/// v of a dof, zero beyond the end of v.
fn component(v: &[Rational], dof: usize) -> Rational {
    v.get(dof).cloned().unwrap_or_else(Rational::zero)
}

/// The dof of the largest component of `unexplained` (the first of several) and its size relative
/// to the largest component of v; `None` if all are zero.
fn largest_share(unexplained: &[Rational], v: &[Rational]) -> Option<(usize, Rational)> {
    let sizes = unexplained.iter().map(Signed::abs).enumerate();
    let (dof, size) = sizes.max_by_key(|(dof, size)| (size.clone(), Reverse(*dof)))?;
    if size.is_zero() {
        return None;
    }

    let largest = v.iter().map(Signed::abs).max()?;
    Some((dof, size / largest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Algebraic, Poly, rational, whole};
    use mceip_model::reduction::{lift, reduce};
    use mceip_model::{Body, System};
    use mceip_testkit::mechanical;

    fn system(body: &Body) -> &System {
        let Body::System(system) = body else {
            unreachable!()
        };
        system
    }

    /// What is lifted comes back; a component in a forbidden direction is named.
    #[test]
    fn the_inverse_of_the_lift() {
        let mut seen = 0;
        for instance in mechanical(30, 5).unwrap() {
            let system = system(instance.problem.body());
            let variables = reduce(&instance.problem).unwrap().variables;
            let count = variables.len() as i64;
            let x: Vec<Poly> = (1..=count).map(|i| Poly::from_ints(&[i])).collect();
            let lifted = lift(system, instance.problem.unknown(), &variables, &x);
            let scale = Rational::from_integer(lifted.v_scale.clone());
            let zero = Algebraic::rational(whole(0)).interval().lo().clone();
            let mut v: Vec<Rational> = lifted.v.iter().map(|p| p.eval(&zero) / &scale).collect();

            let back = project(&variables, &v);

            assert_eq!(back.x, (1..=count).map(whole).collect::<Vec<_>>());
            assert_eq!(back.off, None);

            // The first particle slips. Half its normal is no motion of the system.
            let normal = system.particles()[0].into_obstacle();
            for (dof, c) in &normal {
                v[*dof] += c * rational(1, 2);
            }
            let projected = project(&variables, &v);
            assert_eq!(projected.x, back.x, "the normal component does not enter x");
            let (worst, size) = projected.off.unwrap();
            assert!(normal.iter().any(|(dof, _)| *dof == worst));
            assert!(size.is_positive());
            seen += 1;
        }

        assert_eq!(seen, 30);
    }
}
