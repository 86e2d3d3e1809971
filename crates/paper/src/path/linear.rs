//! Exact solution of the contact equations: modulo primes until the reconstructed fractions
//! satisfy the equations, which is checked in integers. No bound is trusted, none is needed.
//!
//! The numerators have the size of a minor of K (thousands of bits); elimination in fractions
//! on the condensed matrix would pass through numbers forty times as long.

use super::contact::Contact;
use mceip_exact::{Field, Integer, Residues, primes};
use num_integer::Integer as _;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The condensed stiffness modulo as many primes as were needed so far.
#[derive(Default)]
pub(super) struct Images {
    of: Vec<(Field, Vec<u64>)>,
    /// Bits of the modulus that the last solution needed.
    needed: u64,
}

impl Images {
    fn get(&mut self, k: usize, contact: &Contact) -> &(Field, Vec<u64>) {
        if k >= self.of.len() {
            for p in primes().skip(self.of.len()).take(k + 1 - self.of.len()) {
                let field = Field::new(p);
                let image = contact
                    .rows()
                    .iter()
                    .flatten()
                    .map(|v| enter(&field, v))
                    .collect();
                self.of.push((field, image));
            }
        }
        &self.of[k]
    }
}

/// An integer modulo p, in Montgomery form.
fn enter(field: &Field, v: &Integer) -> u64 {
    let magnitude = (v.magnitude() % field.prime()).to_u64().unwrap_or(0); // below p
    let value = field.enter(magnitude);
    if v.is_negative() {
        field.sub(0, value)
    } else {
        value
    }
}

/// A row of equations: a combination of rows of the contact matrix, (row, coefficient).
pub(super) type Equation = Vec<(usize, Integer)>;

/// Primes in a row at which the equations may be singular before they are taken to be.
const MAX_SINGULAR: usize = 8;

/// w = z + g for each imposed g, with z zero outside `active` and every equation 0 on S w; as
/// integers over one positive denominator. `None` if the equations are singular.
pub(super) fn solve(
    contact: &Contact,
    images: &mut Images,
    active: &[usize],
    equations: &[Equation],
    imposed: &[Vec<Integer>],
) -> Option<(Integer, Vec<Vec<Integer>>)> {
    let assemble = |den: &Integer, z: &[Integer]| -> Vec<Vec<Integer>> {
        let mut w: Vec<Vec<Integer>> = imposed
            .iter()
            .map(|g| g.iter().map(|v| v * den).collect())
            .collect();
        for (k, value) in z.iter().enumerate() {
            w[k % imposed.len()][active[k / imposed.len()]] += value;
        }
        w
    };
    if active.is_empty() {
        return Some((Integer::one(), assemble(&Integer::one(), &[])));
    }
    let mut residues = Residues::new(active.len() * imposed.len());
    let mut singular = 0;
    let mut attempt_at = images.needed.max(128);
    for k in 0.. {
        let (field, image) = images.get(k, contact);
        match solve_modulo(
            field,
            image,
            contact.rows().len(),
            active,
            equations,
            imposed,
        ) {
            Some(z) => {
                residues.add(field.prime(), &z);
                singular = 0;
            }
            None => singular += 1,
        }
        if singular > MAX_SINGULAR {
            return None;
        }
        if residues.bits() < attempt_at {
            continue;
        }
        if let Some((den, z)) = reconstruct(&residues) {
            let w = assemble(&den, &z);
            if w.iter().all(|w| satisfied(contact, equations, w)) {
                images.needed = residues.bits();
                return Some((den, w));
            }
        }
        attempt_at += attempt_at / 8 + 1;
    }
    None
}

/// Do the equations hold on S w, exactly?
fn satisfied(contact: &Contact, equations: &[Equation], w: &[Integer]) -> bool {
    let s = contact.times(w);
    equations.iter().all(|e| {
        e.iter()
            .map(|(row, c)| c * &s[*row])
            .sum::<Integer>()
            .is_zero()
    })
}

/// z modulo p, unknown by unknown, load by load; `None` where the equations are singular.
fn solve_modulo(
    field: &Field,
    image: &[u64],
    order: usize,
    active: &[usize],
    equations: &[Equation],
    imposed: &[Vec<Integer>],
) -> Option<Vec<u64>> {
    let (n, loads) = (active.len(), imposed.len());
    let add = |a: u64, b: u64| field.sub(a, field.sub(0, b));
    let mut m = Vec::with_capacity(n);
    for equation in equations {
        let mut whole = vec![0u64; order];
        for (row, c) in equation {
            let c = enter(field, c);
            for (sum, s) in whole.iter_mut().zip(&image[row * order..(row + 1) * order]) {
                *sum = add(*sum, field.mul(c, *s));
            }
        }
        let mut line: Vec<u64> = active.iter().map(|&j| whole[j]).collect();
        for g in imposed {
            let known = whole
                .iter()
                .zip(g)
                .filter(|(_, g)| !g.is_zero())
                .map(|(s, g)| field.mul(*s, enter(field, g)));
            let known = known.fold(0, add);
            line.push(field.sub(0, known));
        }
        m.push(line);
    }
    for k in 0..n {
        let pivot = (k..n).find(|&i| m[i][k] != 0)?;
        m.swap(k, pivot);
        let inverse = field.invert(m[k][k]);
        m[k][k..]
            .iter_mut()
            .for_each(|v| *v = field.mul(*v, inverse));
        let pivot_row = m[k].clone();
        for (i, row) in m.iter_mut().enumerate() {
            if i == k || row[k] == 0 {
                continue;
            }
            let factor = row[k];
            for j in k..n + loads {
                row[j] = field.sub(row[j], field.mul(factor, pivot_row[j]));
            }
        }
    }
    Some(
        m.iter()
            .flat_map(|row| row[n..].iter().map(|v| field.leave(*v)))
            .collect(),
    )
}

/// Fractions with one denominator, numerators and denominator below the root of the modulus.
fn reconstruct(residues: &Residues) -> Option<(Integer, Vec<Integer>)> {
    let modulus = &residues.modulus;
    let limit = residues.bits() / 2 - 1;
    let balanced = |v: Integer| {
        let v = v.mod_floor(modulus);
        if &v << 1u32 > *modulus {
            v - modulus
        } else {
            v
        }
    };
    let mut den = Integer::one();
    for x in &residues.values {
        let v = balanced(x * &den);
        if v.bits() > limit {
            den *= denominator_of(&v, modulus, limit)?;
            if den.bits() > limit {
                return None;
            }
        }
    }
    let z: Vec<Integer> = residues.values.iter().map(|x| balanced(x * &den)).collect();
    z.iter().all(|v| v.bits() <= limit).then_some((den, z))
}

/// The denominator of the fraction that `v` stands for (Wang 1981: Euclid's algorithm halfway).
fn denominator_of(v: &Integer, modulus: &Integer, limit: u64) -> Option<Integer> {
    let (mut r0, mut r1) = (modulus.clone(), v.mod_floor(modulus));
    let (mut t0, mut t1) = (Integer::zero(), Integer::one());
    while r1.bits() > limit {
        let (q, r) = r0.div_rem(&r1);
        (r0, r1) = (r1, r);
        let t = &t0 - q * &t1;
        (t0, t1) = (t1, t);
    }
    let den = t1.abs();
    (!den.is_zero() && den.bits() <= limit).then_some(den)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, whole};

    fn z(v: &[i64]) -> Vec<Integer> {
        v.iter().map(|&v| v.into()).collect()
    }

    /// In (x, y) with y away from the obstacle: the coupling changes its sign.
    fn contact(t: i64, coupling: i64, n: i64) -> Contact {
        Contact::from_condensed(&Sparse::from_ints(&[&[t, -coupling], &[-coupling, n]]))
    }

    #[test]
    fn slip_equation_in_closed_form() {
        // (2 + 5 * 1) z + (1 + 5 * 3) g_N + (2 + 5) g_T = 0 for r_T + 5 r_N = 0, g = (1, 2).
        let equation = vec![(0, Integer::from(1)), (1, Integer::from(5))];
        let (den, w) = solve(
            &contact(2, 1, 3),
            &mut Images::default(),
            &[0],
            &[equation],
            &[z(&[1, 2]), z(&[0, 7])],
        )
        .unwrap();
        assert_eq!(
            (den.clone(), w),
            (Integer::from(7), vec![z(&[-32, 14]), z(&[-112, 49])])
        );
        assert!(den.is_positive());
    }

    #[test]
    fn long_fractions_are_reconstructed() {
        let big: Integer = "170141183460469231731687303715884105727".parse().unwrap();
        let s = Sparse::from_entries(
            2,
            2,
            [
                (
                    0,
                    0,
                    mceip_exact::Rational::from_integer(&big * &big * &big),
                ),
                (1, 1, whole(1)),
                (0, 1, whole(5)),
                (1, 0, whole(5)),
            ],
        );
        let (den, w) = solve(
            &Contact::from_condensed(&s),
            &mut Images::default(),
            &[0],
            &[vec![(0, 1.into())]],
            &[z(&[0, 1])],
        )
        .unwrap();
        assert_eq!((&den, &w[0][0]), (&(&big * &big * &big), &Integer::from(5)));
    }

    #[test]
    fn singular_equations_have_no_answer() {
        // r_T + r_N = 0 with S_TT + S_NT = 0.
        let equation = vec![(0, Integer::from(1)), (1, Integer::from(1))];
        assert!(
            solve(
                &contact(1, -1, 3),
                &mut Images::default(),
                &[0],
                &[equation],
                &[z(&[1, 2])]
            )
            .is_none()
        );
    }

    #[test]
    fn wrong_numbers_do_not_satisfy_the_equations() {
        let equations = [vec![(0, Integer::from(1)), (1, Integer::from(5))]];
        assert!(satisfied(&contact(2, 1, 3), &equations, &z(&[-32, 14])));
        assert!(!satisfied(&contact(2, 1, 3), &equations, &z(&[-31, 14])));
    }
}
