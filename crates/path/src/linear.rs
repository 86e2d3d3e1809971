//! Exact solution of the contact equations: modulo primes until the reconstructed fractions
//! satisfy the equations, which is checked in integers. No bound is trusted, none is needed.
//!
//! For each imposed vector g, w = z + g is wanted, where z is zero outside the active components
//! and each equation, a combination of the rows of r = [C, -h_1, ...] w ([`Contact`]), is zero. The
//! steps are: Gauss-Jordan elimination modulo a prime; the Chinese remainder theorem over all
//! primes so far ([`Residues`]); rational reconstruction; insertion into the equations. Called by
//! `respond` and `pencils`.
//!
//! The numerators have the size of a minor of K (thousands of bits); elimination in fractions
//! on the condensed matrix would pass through numbers forty times as long.

use super::contact::Contact;
use mceip_exact::{Field, Integer, Residues, primes};
use num_integer::Integer as _;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Primes in a row at which the equations may be singular before they are taken to be.
const MAX_SINGULAR: usize = 8;

/// Bits of the modulus at which the first reconstruction is attempted, if nothing is known.
const FIRST_ATTEMPT_BITS: u64 = 128;

/// One term of an equation: coefficient times a component of r.
pub(super) struct Term {
    pub(super) row: usize,
    pub(super) coefficient: Integer,
}

/// A combination of the components of r that vanishes.
pub(super) type Equation = Vec<Term>;

/// The equation r_i = 0.
pub(super) fn no_reaction(component: usize) -> Equation {
    vec![Term {
        row: component,
        coefficient: Integer::one(),
    }]
}

/// Linear equations for the displacements w of the contact candidates.
pub(super) struct ContactEquations<'a> {
    pub(super) contact: &'a Contact,
    /// Unknown components.
    pub(super) active: Vec<usize>,
    /// One for each unknown.
    pub(super) equations: Vec<Equation>,
    /// The imposed g, one for each load, over all components.
    pub(super) imposed: Vec<Vec<Integer>>,
}

/// The vectors w, one for each load, as integers over one positive denominator.
pub(super) struct Displacements {
    pub(super) denominator: Integer,
    pub(super) w: Vec<Vec<Integer>>,
}

/// The rows of the contact modulo as many primes as were needed so far.
#[derive(Default)]
pub(super) struct Images {
    of: Vec<Image>,
    /// Bits of the modulus that the last solution needed.
    needed: u64,
}

impl Images {
    /// The image modulo prime number `k`.
    fn get(&mut self, k: usize, contact: &Contact) -> &Image {
        let known = self.of.len();
        if k >= known {
            for prime in primes().skip(known).take(k + 1 - known) {
                self.of.push(Image::new(prime, contact));
            }
        }

        &self.of[k]
    }
}

/// The rows of the contact modulo one prime, in Montgomery form.
struct Image {
    field: Field,
    /// Length of a row.
    columns: usize,
    /// By rows.
    entries: Vec<u64>,
}

impl Image {
    fn new(prime: u64, contact: &Contact) -> Image {
        let field = Field::new(prime);
        let numerators = contact.rows().iter().flatten();
        let entries = numerators.map(|value| enter(&field, value)).collect();
        Image {
            field,
            columns: contact.columns(),
            entries,
        }
    }

    fn row(&self, i: usize) -> &[u64] {
        let begin = i * self.columns;
        let end = begin + self.columns;
        &self.entries[begin..end]
    }

    /// The row vector that the equation stands for.
    fn combination(&self, equation: &Equation) -> Vec<u64> {
        let mut combined = vec![0u64; self.columns];
        for term in equation {
            let coefficient = enter(&self.field, &term.coefficient);
            for (sum, entry) in combined.iter_mut().zip(self.row(term.row)) {
                let product = self.field.mul(coefficient, *entry);
                *sum = self.field.add(*sum, product);
            }
        }

        combined
    }

    /// row * g.
    fn product(&self, row: &[u64], g: &[Integer]) -> u64 {
        let mut sum = 0;
        for (entry, component) in row.iter().zip(g) {
            if !component.is_zero() {
                let product = self.field.mul(*entry, enter(&self.field, component));
                sum = self.field.add(sum, product);
            }
        }

        sum
    }
}

/// An integer modulo p, in Montgomery form.
fn enter(field: &Field, value: &Integer) -> u64 {
    let remainder = value.magnitude() % field.prime();
    let magnitude = field.enter(remainder.to_u64().unwrap_or(0)); // below p: it fits
    if value.is_negative() {
        field.sub(0, magnitude)
    } else {
        magnitude
    }
}

impl ContactEquations<'_> {
    /// Solves them for every load; `None` if the equations are singular.
    pub(super) fn solve(&self, images: &mut Images) -> Option<Displacements> {
        if self.active.is_empty() {
            let no_unknowns = CommonFractions {
                denominator: Integer::one(),
                numerators: Vec::new(),
            };
            return Some(self.displacements(no_unknowns));
        }

        let mut residues = Residues::new(self.active.len() * self.imposed.len());
        let mut singular = 0;
        let mut attempt_at = images.needed.max(FIRST_ATTEMPT_BITS);
        for k in 0.. {
            let image = images.get(k, self.contact);
            match self.solve_modulo(image) {
                Some(z) => {
                    residues.add(image.field.prime(), &z);
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

            if let Some(solved) = self.reconstruct_and_verify(&residues) {
                images.needed = residues.bits();
                return Some(solved);
            }

            attempt_at += attempt_at / 8 + 1;
        }

        None
    }

    /// The fractions that the residues stand for, if they satisfy the equations exactly.
    fn reconstruct_and_verify(&self, residues: &Residues) -> Option<Displacements> {
        let solved = self.displacements(reconstruct(residues)?);
        solved
            .w
            .iter()
            .all(|w| satisfied(self.contact, &self.equations, w))
            .then_some(solved)
    }

    /// w = g + z, where z lists unknown by unknown, load by load.
    fn displacements(&self, z: CommonFractions) -> Displacements {
        let mut w = Vec::with_capacity(self.imposed.len());
        for g in &self.imposed {
            let scaled: Vec<Integer> = g.iter().map(|value| value * &z.denominator).collect();
            w.push(scaled);
        }

        let loads = self.imposed.len();
        for (k, value) in z.numerators.iter().enumerate() {
            let component = self.active[k / loads];
            w[k % loads][component] += value;
        }

        Displacements {
            denominator: z.denominator,
            w,
        }
    }

    /// z modulo p, unknown by unknown, load by load; `None` where the equations are singular.
    fn solve_modulo(&self, image: &Image) -> Option<Vec<u64>> {
        let mut rows = self.augmented(image);
        eliminate(&image.field, &mut rows)?;

        let unknowns = self.active.len();
        let mut z = Vec::with_capacity(unknowns * self.imposed.len());
        for row in &rows {
            for value in &row[unknowns..] {
                z.push(image.field.leave(*value));
            }
        }

        Some(z)
    }

    /// The equations as rows: coefficients of the unknowns, then a right side for each load.
    fn augmented(&self, image: &Image) -> Vec<Vec<u64>> {
        let mut rows = Vec::with_capacity(self.equations.len());
        for equation in &self.equations {
            let combined = image.combination(equation);

            let mut row: Vec<u64> = self.active.iter().map(|&j| combined[j]).collect();
            for g in &self.imposed {
                let known = image.product(&combined, g);
                row.push(image.field.sub(0, known));
            }

            rows.push(row);
        }

        rows
    }
}

/// Turns the square block on the left of the rows into the identity (Gauss-Jordan); `None` if it is
/// singular.
fn eliminate(field: &Field, rows: &mut [Vec<u64>]) -> Option<()> {
    let unknowns = rows.len();

    for k in 0..unknowns {
        let pivot = (k..unknowns).find(|&i| rows[i][k] != 0)?;
        rows.swap(k, pivot);

        let inverse = field.invert(rows[k][k]);
        for value in &mut rows[k][k..] {
            *value = field.mul(*value, inverse);
        }

        let pivot_row = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[k];
            if i == k || factor == 0 {
                continue;
            }

            for j in k..row.len() {
                let multiple = field.mul(factor, pivot_row[j]);
                row[j] = field.sub(row[j], multiple);
            }
        }
    }

    Some(())
}

/// Do the equations hold on C w, exactly?
fn satisfied(contact: &Contact, equations: &[Equation], w: &[Integer]) -> bool {
    let product = contact.times(w);

    for equation in equations {
        let mut sum = Integer::zero();
        for term in equation {
            sum += &term.coefficient * &product[term.row];
        }

        if !sum.is_zero() {
            return false;
        }
    }

    true
}

/// Fractions over one denominator.
struct CommonFractions {
    denominator: Integer,
    numerators: Vec<Integer>,
}

/// Fractions with one denominator, numerators and denominator below the root of the modulus.
fn reconstruct(residues: &Residues) -> Option<CommonFractions> {
    let modulus = &residues.modulus;
    let limit = residues.bits() / 2 - 1;

    // The denominator grows by what the next value needs besides it.
    let mut denominator = Integer::one();
    for residue in &residues.values {
        let value = balanced(residue * &denominator, modulus);
        if value.bits() > limit {
            denominator *= denominator_of(&value, modulus, limit)?;
            if denominator.bits() > limit {
                return None;
            }
        }
    }

    let mut numerators = Vec::with_capacity(residues.values.len());
    for residue in &residues.values {
        let numerator = balanced(residue * &denominator, modulus);
        if numerator.bits() > limit {
            return None;
        }

        numerators.push(numerator);
    }

    Some(CommonFractions {
        denominator,
        numerators,
    })
}

/// The representative of least absolute value modulo `modulus`.
fn balanced(value: Integer, modulus: &Integer) -> Integer {
    let remainder = value.mod_floor(modulus);
    if &remainder << 1u32 > *modulus {
        remainder - modulus
    } else {
        remainder
    }
}

/// The denominator of the fraction that `value` stands for (Wang 1981: Euclid's algorithm, left as
/// soon as the remainder is small enough for a numerator).
fn denominator_of(value: &Integer, modulus: &Integer, limit: u64) -> Option<Integer> {
    // remainder = factor * value modulo `modulus`, for both pairs.
    let mut last_remainder = modulus.clone();
    let mut last_factor = Integer::zero();
    let mut remainder = value.mod_floor(modulus);
    let mut factor = Integer::one();

    while remainder.bits() > limit {
        let (quotient, next_remainder) = last_remainder.div_rem(&remainder);
        let next_factor = &last_factor - quotient * &factor;

        last_remainder = remainder;
        remainder = next_remainder;
        last_factor = factor;
        factor = next_factor;
    }

    let denominator = factor.abs();
    let fits = !denominator.is_zero() && denominator.bits() <= limit;
    fits.then_some(denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Rational, whole};

    fn integers(values: &[i64]) -> Vec<Integer> {
        values.iter().map(|&value| value.into()).collect()
    }

    /// One candidate without loads or a gap: w has two components, and the amount of the gap.
    fn one_candidate(stiffness: [[Rational; 2]; 2]) -> Contact {
        Contact::plain(stiffness.map(Vec::from).to_vec(), Vec::new())
    }

    fn contact(tangential: i64, coupling: i64, normal: i64) -> Contact {
        one_candidate([
            [whole(tangential), whole(coupling)],
            [whole(coupling), whole(normal)],
        ])
    }

    /// r_T + factor r_N = 0 of the one node.
    fn slip_equation(factor: i64) -> Equation {
        vec![
            Term {
                row: 0,
                coefficient: 1.into(),
            },
            Term {
                row: 1,
                coefficient: factor.into(),
            },
        ]
    }

    #[test]
    fn slip_equation_in_closed_form() {
        // (2 + 5 * 1) z + (1 + 5 * 3) g_N + (2 + 5) g_T = 0 for r_T + 5 r_N = 0, g = (1, 2).
        let equations = ContactEquations {
            contact: &contact(2, 1, 3),
            active: vec![0],
            equations: vec![slip_equation(5)],
            imposed: vec![integers(&[1, 2, 0]), integers(&[0, 7, 0])],
        };

        let solved = equations.solve(&mut Images::default()).unwrap();

        assert_eq!(solved.denominator, Integer::from(7));
        assert_eq!(
            solved.w,
            vec![integers(&[-32, 14, 0]), integers(&[-112, 49, 0])]
        );
        assert!(solved.denominator.is_positive());
    }

    #[test]
    fn long_fractions_are_reconstructed() {
        let big: Integer = "170141183460469231731687303715884105727".parse().unwrap();
        let cube = &big * &big * &big;
        let stiffness = [
            [Rational::from_integer(cube.clone()), whole(-5)],
            [whole(-5), whole(1)],
        ];
        let equations = ContactEquations {
            contact: &one_candidate(stiffness),
            active: vec![0],
            equations: vec![vec![Term {
                row: 0,
                coefficient: 1.into(),
            }]],
            imposed: vec![integers(&[0, 1, 0])],
        };

        let solved = equations.solve(&mut Images::default()).unwrap();

        assert_eq!(solved.denominator, cube);
        assert_eq!(solved.w[0][0], Integer::from(5));
    }

    #[test]
    fn singular_equations_have_no_answer() {
        // r_T + r_N = 0 with C_TT + C_NT = 0.
        let equations = ContactEquations {
            contact: &contact(1, -1, 3),
            active: vec![0],
            equations: vec![slip_equation(1)],
            imposed: vec![integers(&[1, 2, 0])],
        };
        assert!(equations.solve(&mut Images::default()).is_none());
    }

    #[test]
    fn wrong_numbers_do_not_satisfy_the_equations() {
        let contact = contact(2, 1, 3);
        let equations = [slip_equation(5)];
        assert!(satisfied(&contact, &equations, &integers(&[-32, 14, 0])));
        assert!(!satisfied(&contact, &equations, &integers(&[-31, 14, 0])));
    }
}
