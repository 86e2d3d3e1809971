//! Random changes of claims: most make a certificate false, some leave it true. Whoever checks the
//! result has to know which (`tests/checker/mutated_claims.rs` asks the oracle).

use mceip_check::certificate::{Certificate, Claim, EnclosedSolution, ExactSolution};
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::Unknown;
use mceip_model::file::Number;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Changes one thing in a certificate of claims.
pub fn mutate(certificate: &mut Certificate, rng: &mut ChaCha8Rng) {
    let count = certificate.claims.len();
    match rng.random_range(0..24) {
        0 => {
            certificate.unknown = if certificate.unknown == Unknown::Mu {
                Unknown::Lambda2
            } else {
                Unknown::Mu
            }
        }
        1 if count > 0 => {
            let claim = certificate.claims[rng.random_range(0..count)].clone();
            certificate.claims.push(claim);
        }
        _ if count == 0 => {}
        _ => match &mut certificate.claims[rng.random_range(0..count)] {
            Claim::ExactSolution(c) => exact(c, rng),
            Claim::LiftedSolution(c) => {
                let part = if rng.random_range(0..2) == 0 {
                    &mut c.v
                } else {
                    &mut c.w
                };

                common(
                    &mut c.support,
                    &mut c.biactive,
                    &mut c.polynomial,
                    &mut c.interval,
                    part,
                    rng,
                );
            }
            Claim::EnclosedSolution(c) => enclosed(c, rng),
        },
    }
}

fn exact(c: &mut ExactSolution, rng: &mut ChaCha8Rng) {
    common(
        &mut c.support,
        &mut c.biactive,
        &mut c.polynomial,
        &mut c.interval,
        &mut c.x,
        rng,
    );
}

/// What exact and lifted claims have in common.
fn common(
    support: &mut Vec<usize>,
    biactive: &mut Vec<usize>,
    polynomial: &mut Vec<Integer>,
    interval: &mut [Number; 2],
    x: &mut [Vec<Number>],
    rng: &mut ChaCha8Rng,
) {
    let variables = x.len().max(1);
    match rng.random_range(0..12) {
        0 => toggle(support, rng.random_range(0..variables)),
        1 => toggle(biactive, rng.random_range(0..variables)),
        2 => std::mem::swap(support, biactive),
        3 => {
            let k = rng.random_range(0..polynomial.len().max(1));
            if let Some(c) = polynomial.get_mut(k) {
                *c += Integer::from(rng.random_range(-2i64..=2));
            }
        }
        // A factor more: the root stays one, alone or not.
        4 => {
            let root = Integer::from(rng.random_range(-3i64..=3));
            let mut product = vec![Integer::default(); polynomial.len() + 1];

            for (k, c) in polynomial.iter().enumerate() {
                product[k] -= c * &root;
                product[k + 1] += c;
            }

            *polynomial = product;
        }
        5 => {
            let width = &interval[1].0 - &interval[0].0;
            let by = (width + small(rng)) * rational(rng.random_range(-8..=8), 8);
            interval[rng.random_range(0..2)].0 += by;
        }
        6 => interval.swap(0, 1),
        7 => {
            let factor = rational(rng.random_range(1..=9), rng.random_range(1..=9));
            x.iter_mut().flatten().for_each(|n| n.0 *= &factor);
        }
        8 => {
            let k = rng.random_range(0..variables);
            if let Some(p) = x.get_mut(k) {
                p.iter_mut().for_each(|n| n.0 = -n.0.clone());
            }
        }
        // A multiple of p added: the same number.
        9 => {
            let (k, factor) = (
                rng.random_range(0..variables),
                rational(rng.random_range(-3..=3), 2),
            );

            if let Some(g) = x.get_mut(k) {
                g.resize_with(g.len().max(polynomial.len()), || Number(whole(0)));
                g.iter_mut()
                    .zip(polynomial.iter())
                    .for_each(|(n, c)| n.0 += &factor * Rational::from_integer(c.clone()));
            }
        }
        10 => {
            let (i, j) = (
                rng.random_range(0..variables),
                rng.random_range(0..variables),
            );

            if i.max(j) < x.len() {
                x.swap(i, j);
            }
        }
        _ => {
            let k = rng.random_range(0..variables);
            let by = small(rng);

            if let Some(p) = x.get_mut(k) {
                match p.len() {
                    0 => p.push(Number(by)),
                    n => p[rng.random_range(0..n)].0 += by,
                }
            }
        }
    }
}

fn enclosed(c: &mut EnclosedSolution, rng: &mut ChaCha8Rng) {
    let (n, by) = (c.center.len().max(1), small(rng));
    let k = rng.random_range(0..n);

    match rng.random_range(0..7) {
        0 => toggle(&mut c.support, k),
        1 | 2 => c.center.iter_mut().skip(k).take(1).for_each(|v| v.0 += &by),
        3 => c
            .radius
            .iter_mut()
            .skip(k)
            .take(1)
            .for_each(|v| v.0 *= rational(1i64 << rng.random_range(0..24u32), 16)),
        4 => c.radius.iter_mut().skip(k).take(1).for_each(|v| v.0 += &by),
        5 => c.exponent = c.exponent.saturating_add_signed(rng.random_range(-1..=1)),
        _ => c
            .preconditioner
            .iter_mut()
            .skip(k)
            .flatten()
            .take(1)
            .for_each(|v| *v += Integer::from(rng.random_range(-3i64..=3))),
    }
}

fn toggle(set: &mut Vec<usize>, index: usize) {
    match set.binary_search(&index) {
        Ok(k) => {
            set.remove(k);
        }
        Err(k) => set.insert(k, index),
    }
}

/// A step between one and 1e-30, of either sign.
fn small(rng: &mut ChaCha8Rng) -> Rational {
    let sign = if rng.random_range(0..2) == 0 {
        1i64
    } else {
        -1
    };

    let size = Integer::from(10).pow(rng.random_range(0..=30));
    Rational::new(Integer::from(sign), size)
}
