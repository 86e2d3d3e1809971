//! An exact claim about the pencil as a claim about the mechanical system: v and w for every line
//! of (9).

use mceip_check::certificate::{ExactSolution, LiftedSolution};
use mceip_exact::{Rational, Sparse};
use mceip_model::file::Number;
use mceip_model::{System, Unknown};
use num_traits::Zero;

/// Lifts x to v (E10: v_T = -S x, nothing else moves but the free dofs) and w = (t M + K) v, both
/// reduced modulo the claim's polynomial.
pub fn lifted(system: &System, unknown: Unknown, claim: &ExactSolution) -> LiftedSolution {
    let free = system.free_dofs();
    let mut v: Vec<Vec<Rational>> = vec![Vec::new(); system.dofs()];
    let one = Rational::from_integer(1.into());
    let number = |n: &Number| n.0.clone();
    for (dof, x) in free.iter().zip(&claim.x) {
        v[*dof] = x.iter().map(number).collect();
    }
    for ((particle, sign), x) in system
        .slip_particles()
        .into_iter()
        .zip(claim.x.iter().skip(free.len()))
    {
        let x: Vec<Rational> = x.iter().map(number).collect();
        let minus_s = Rational::from_integer((-sign).into());
        particle
            .tangent()
            .iter()
            .for_each(|(dof, c)| add(&mut v[*dof], &(c * &minus_s), &x, 0));
    }
    let mut w: Vec<Vec<Rational>> = vec![Vec::new(); system.dofs()];
    let mut accumulate = |m: &Sparse, shift| {
        m.entries()
            .for_each(|(i, j, value)| add(&mut w[i], value, &v[j], shift))
    };
    accumulate(system.stiffness(), 0);
    if let (Unknown::Lambda2, Some(mass)) = (unknown, system.mass()) {
        accumulate(mass, 1);
    }
    let p: Vec<Rational> = claim
        .polynomial
        .iter()
        .map(|c| &one * Rational::from_integer(c.clone()))
        .collect();
    let reduced = |list: Vec<Vec<Rational>>| {
        list.into_iter()
            .map(|g| remainder(g, &p).into_iter().map(Number).collect())
            .collect()
    };
    LiftedSolution {
        support: claim.support.clone(),
        biactive: claim.biactive.clone(),
        polynomial: claim.polynomial.clone(),
        interval: claim.interval.clone(),
        v: reduced(v),
        w: reduced(w),
    }
}

/// The pencil's x behind a lifted claim: the way back of [`lifted`].
pub fn flattened(system: &System, claim: &LiftedSolution) -> ExactSolution {
    let number = |p: &Vec<Number>| p.iter().map(|n| n.0.clone()).collect::<Vec<_>>();
    let mut x: Vec<Vec<Rational>> = system
        .free_dofs()
        .iter()
        .map(|&d| claim.v.get(d).map(number).unwrap_or_default())
        .collect();
    for (particle, sign) in system.slip_particles() {
        let minus_s = Rational::from_integer((-sign).into());
        let mut sum = Vec::new();
        for (dof, c) in particle.tangent() {
            add(
                &mut sum,
                &(c * &minus_s),
                &claim.v.get(dof).map(number).unwrap_or_default(),
                0,
            );
        }
        x.push(sum);
    }
    ExactSolution {
        support: claim.support.clone(),
        biactive: claim.biactive.clone(),
        polynomial: claim.polynomial.clone(),
        interval: claim.interval.clone(),
        x: x.into_iter()
            .map(|p| p.into_iter().map(Number).collect())
            .collect(),
    }
}

fn add(sum: &mut Vec<Rational>, factor: &Rational, p: &[Rational], shift: usize) {
    if sum.len() < p.len() + shift {
        sum.resize(p.len() + shift, Rational::zero());
    }
    for (k, c) in p.iter().enumerate() {
        sum[k + shift] += factor * c;
    }
}

/// g mod p over Q.
pub(super) fn remainder(mut rest: Vec<Rational>, p: &[Rational]) -> Vec<Rational> {
    let m = p.len();
    let Some(lead) = p.last().filter(|l| m > 1 && !l.is_zero()) else {
        return rest;
    };
    while rest.len() >= m {
        let top = rest.pop().unwrap_or_else(Rational::zero) / lead;
        let shift = rest.len() + 1 - m;
        for (k, c) in p[..m - 1].iter().enumerate() {
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

    #[test]
    fn remainders_are_shorter_than_the_divisor() {
        let of = |g: &[i64], p: &[i64]| {
            remainder(
                g.iter().map(|&c| whole(c)).collect(),
                &p.iter().map(|&c| whole(c)).collect::<Vec<_>>(),
            )
        };
        assert_eq!(of(&[1, 2, 3, 4], &[-2, 0, 1]), [whole(7), whole(10)]); // t^2 = 2
        assert_eq!(of(&[0, 0, 1], &[1, 0, 3]), [rational(-1, 3)]);
        assert_eq!(of(&[5, 1], &[-2, 1]), [whole(7)]);
        assert_eq!(of(&[-4, 2], &[-2, 1]), []);
        assert_eq!(of(&[5, 1], &[-2, 0, 1]), [whole(5), whole(1)]);
        assert_eq!(of(&[5, 1], &[3]), [whole(5), whole(1)]); // no polynomial to divide by
    }
}
