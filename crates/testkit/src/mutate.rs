//! Random changes of certificates: most make a certificate false, some leave it true.
//!
//! Whoever checks the result has to know which: `tests/checker/mutated_claims.rs` asks the oracle
//! whether every claim that the checker still accepts is a solution.
//!
//! Input: a certificate and a source of random numbers. The same source gives the same change.

use mceip_check::certificate::{Certificate, Claim, EnclosedSolution};
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::Unknown;
use mceip_model::file::Number;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Changes one thing in a certificate of claims.
pub fn mutate(certificate: &mut Certificate, rng: &mut ChaCha8Rng) {
    let count = certificate.claims.len();
    match rng.random_range(0..24) {
        0 => certificate.unknown = other(certificate.unknown),
        1 if count > 0 => {
            let claim = certificate.claims[rng.random_range(0..count)].clone();
            certificate.claims.push(claim);
        }
        _ if count == 0 => {}
        _ => {
            let k = rng.random_range(0..count);
            mutate_claim(&mut certificate.claims[k], rng);
        }
    }
}

/// The other unknown.
fn other(unknown: Unknown) -> Unknown {
    match unknown {
        Unknown::Mu => Unknown::Lambda2,
        Unknown::Lambda2 => Unknown::Mu,
    }
}

/// Changes one thing in a claim.
fn mutate_claim(claim: &mut Claim, rng: &mut ChaCha8Rng) {
    match claim {
        Claim::ExactSolution(c) => {
            let mut parts = Parts {
                support: &mut c.support,
                biactive: &mut c.biactive,
                polynomial: &mut c.polynomial,
                interval: &mut c.interval,
                components: &mut c.x,
            };
            parts.mutate(rng);
        }
        Claim::LiftedSolution(c) => {
            let components = match rng.random_range(0..2) {
                0 => &mut c.v,
                _ => &mut c.w,
            };
            let mut parts = Parts {
                support: &mut c.support,
                biactive: &mut c.biactive,
                polynomial: &mut c.polynomial,
                interval: &mut c.interval,
                components,
            };
            parts.mutate(rng);
        }
        Claim::EnclosedSolution(c) => mutate_enclosed(c, rng),
    }
}

/// What exact and lifted claims have in common.
struct Parts<'a> {
    support: &'a mut Vec<usize>,
    biactive: &'a mut Vec<usize>,
    /// The polynomial of which the value is a root, coefficients from the constant term up.
    polynomial: &'a mut Vec<Integer>,
    /// The ends of the interval that isolates the value.
    interval: &'a mut [Number; 2],
    /// x, v or w: each component is a polynomial in the value.
    components: &'a mut [Vec<Number>],
}

impl Parts<'_> {
    /// Changes one thing.
    fn mutate(&mut self, rng: &mut ChaCha8Rng) {
        let variables = self.components.len().max(1);
        match rng.random_range(0..12) {
            0 => toggle(self.support, rng.random_range(0..variables)),
            1 => toggle(self.biactive, rng.random_range(0..variables)),
            2 => std::mem::swap(self.support, self.biactive),
            3 => self.change_a_coefficient(rng),
            4 => self.multiply_polynomial_by_a_linear_factor(rng),
            5 => self.move_an_end(rng),
            6 => self.interval.swap(0, 1),
            7 => self.scale_all_components(rng),
            8 => self.negate_a_component(rng.random_range(0..variables)),
            9 => self.add_a_multiple_of_the_polynomial(rng.random_range(0..variables), rng),
            10 => self.exchange_two_components(variables, rng),
            _ => self.move_a_component(rng.random_range(0..variables), rng),
        }
    }

    /// Adds up to 2 to a coefficient of the polynomial, or takes it away.
    fn change_a_coefficient(&mut self, rng: &mut ChaCha8Rng) {
        let k = rng.random_range(0..self.polynomial.len().max(1));
        if let Some(coefficient) = self.polynomial.get_mut(k) {
            *coefficient += Integer::from(rng.random_range(-2i64..=2));
        }
    }

    /// Multiplies the polynomial by t - r. The value stays a root; it may not stay isolated.
    fn multiply_polynomial_by_a_linear_factor(&mut self, rng: &mut ChaCha8Rng) {
        let root = Integer::from(rng.random_range(-3i64..=3));
        let mut product = vec![Integer::default(); self.polynomial.len() + 1];

        for (k, coefficient) in self.polynomial.iter().enumerate() {
            product[k] -= coefficient * &root;
            product[k + 1] += coefficient;
        }

        *self.polynomial = product;
    }

    /// Moves an end of the interval by up to its width and a small number.
    fn move_an_end(&mut self, rng: &mut ChaCha8Rng) {
        let [lo, hi] = &self.interval;
        let most = &hi.0 - &lo.0 + step(rng);
        let share = rational(rng.random_range(-8..=8), 8);

        let end = rng.random_range(0..2);
        self.interval[end].0 += most * share;
    }

    /// Multiplies x by a positive number: the same ray.
    fn scale_all_components(&mut self, rng: &mut ChaCha8Rng) {
        let numerator = rng.random_range(1..=9);
        let denominator = rng.random_range(1..=9);
        let factor = rational(numerator, denominator);

        for number in self.components.iter_mut().flatten() {
            number.0 *= &factor;
        }
    }

    /// Changes the sign of a component.
    fn negate_a_component(&mut self, k: usize) {
        if let Some(component) = self.components.get_mut(k) {
            component.iter_mut().for_each(|n| n.0 = -n.0.clone());
        }
    }

    /// Adds a multiple of the polynomial to a component: the same number, because the polynomial
    /// vanishes at the value.
    fn add_a_multiple_of_the_polynomial(&mut self, k: usize, rng: &mut ChaCha8Rng) {
        let factor = rational(rng.random_range(-3..=3), 2);
        let Some(component) = self.components.get_mut(k) else {
            return;
        };

        let length = component.len().max(self.polynomial.len());
        component.resize_with(length, || Number(whole(0)));
        for (number, coefficient) in component.iter_mut().zip(self.polynomial.iter()) {
            number.0 += &factor * Rational::from_integer(coefficient.clone());
        }
    }

    /// Exchanges two components, which may be the same.
    fn exchange_two_components(&mut self, variables: usize, rng: &mut ChaCha8Rng) {
        let i = rng.random_range(0..variables);
        let j = rng.random_range(0..variables);
        if i.max(j) < self.components.len() {
            self.components.swap(i, j);
        }
    }

    /// Adds a number to a coefficient of a component.
    fn move_a_component(&mut self, k: usize, rng: &mut ChaCha8Rng) {
        let by = step(rng);
        let Some(component) = self.components.get_mut(k) else {
            return;
        };

        match component.len() {
            0 => component.push(Number(by)),
            n => component[rng.random_range(0..n)].0 += by,
        }
    }
}

/// Changes the box, the exponent or the preconditioner. A list that has no `k`-th entry is left as
/// it is.
fn mutate_enclosed(c: &mut EnclosedSolution, rng: &mut ChaCha8Rng) {
    let variables = c.center.len().max(1);
    let by = step(rng);
    let k = rng.random_range(0..variables);

    match rng.random_range(0..7) {
        0 => toggle(&mut c.support, k),
        1 | 2 => {
            if let Some(center) = c.center.get_mut(k) {
                center.0 += &by;
            }
        }
        3 => {
            if let Some(radius) = c.radius.get_mut(k) {
                let power = rng.random_range(0..24u32);
                radius.0 *= rational(1i64 << power, 16);
            }
        }
        4 => {
            if let Some(radius) = c.radius.get_mut(k) {
                radius.0 += &by;
            }
        }
        5 => c.exponent = c.exponent.saturating_add_signed(rng.random_range(-1..=1)),
        _ => {
            let entry = c.preconditioner.iter_mut().skip(k).flatten().next();
            if let Some(entry) = entry {
                *entry += Integer::from(rng.random_range(-3i64..=3));
            }
        }
    }
}

/// Adds the index to the sorted set, or takes it away.
fn toggle(set: &mut Vec<usize>, index: usize) {
    match set.binary_search(&index) {
        Ok(k) => {
            set.remove(k);
        }
        Err(k) => set.insert(k, index),
    }
}

/// A number of size 1 to 1e-30, of either sign.
fn step(rng: &mut ChaCha8Rng) -> Rational {
    let sign = if rng.random_range(0..2) == 0 {
        1i64
    } else {
        -1
    };

    let size = Integer::from(10).pow(rng.random_range(0..=30));
    Rational::new(Integer::from(sign), size)
}
