//! From v over all degrees of freedom back to x of the pencil: the other direction of (10).

use mceip_exact::Rational;
use mceip_model::reduction::Variable;
use num_traits::{Signed, Zero};

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
/// // E10
///
/// The constraints v_d = 0 and v_Ns = 0 of (9) are not imposed: `off` says how far v is from them.
/// Components of v beyond those the variables name count as constrained.
///
/// ```
/// use mceip_exact::whole;
/// use mceip_engine::reduction::{Variable, project};
/// let slip = Variable::Slip {
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
pub fn project(variables: &[Variable], v: &[Rational]) -> Projected {
    let at = |dof: usize| v.get(dof).cloned().unwrap_or_else(Rational::zero);
    let mut rest = v.to_vec();
    let mut x = Vec::with_capacity(variables.len());
    for variable in variables {
        let x_i = match variable {
            Variable::Free { dof } => {
                rest.get_mut(*dof)
                    .into_iter()
                    .for_each(|r| *r = Rational::zero());
                at(*dof)
            }
            Variable::Slip { sign, tangent, .. } => {
                let v_t: Rational = tangent.iter().map(|(dof, c)| c * at(*dof)).sum();
                for (dof, c) in tangent {
                    rest.get_mut(*dof).into_iter().for_each(|r| *r -= c * &v_t);
                }
                v_t * Rational::from_integer((-*sign).into())
            }
        };
        x.push(x_i);
    }
    let largest = v
        .iter()
        .map(Signed::abs)
        .max()
        .unwrap_or_else(Rational::zero);
    let worst = rest
        .iter()
        .map(Signed::abs)
        .enumerate()
        .max_by(|a, b| a.1.cmp(&b.1).then(b.0.cmp(&a.0)));
    let off = worst
        .filter(|(_, size)| !size.is_zero())
        .map(|(dof, size)| (dof, size / largest));
    Projected { x, off }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reduction::{lift, reduce};
    use mceip_exact::{Algebraic, Poly, rational, whole};
    use mceip_testkit::mechanical;

    /// What is lifted comes back; a component in a forbidden direction is named.
    #[test]
    fn the_inverse_of_the_lift() {
        let mut seen = 0;
        for instance in mechanical(30, 5).unwrap() {
            let mceip_model::Body::System(system) = instance.problem.body() else {
                unreachable!()
            };
            let variables = reduce(&instance.problem).unwrap().variables;
            let x: Vec<Poly> = (0..variables.len())
                .map(|i| Poly::from_ints(&[i as i64 + 1]))
                .collect();
            let lifted = lift(system, instance.problem.unknown(), &variables, &x);
            let scale = Rational::from_integer(lifted.v_scale.clone());
            let zero = Algebraic::rational(whole(0)).interval().lo().clone();
            let mut v: Vec<Rational> = lifted.v.iter().map(|p| p.eval(&zero) / &scale).collect();
            let back = project(&variables, &v);
            assert_eq!(
                back.x,
                (0..x.len())
                    .map(|i| whole(i as i64 + 1))
                    .collect::<Vec<_>>()
            );
            assert_eq!(back.off, None);
            let particle = &system.particles()[0]; // slips
            let normal = particle.into_obstacle();
            normal
                .iter()
                .for_each(|(dof, c)| v[*dof] += c * rational(1, 2));
            let off = project(&variables, &v);
            assert_eq!(off.x, back.x, "the normal component does not enter x");
            assert!(
                off.off.is_some_and(
                    |(dof, size)| normal.iter().any(|n| n.0 == dof) && size.is_positive()
                )
            );
            seen += 1;
        }
        assert_eq!(seen, 30);
    }
}
