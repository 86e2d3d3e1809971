//! Vectors of polynomials in t, and rays and circuits of the rows of a matrix of them.
//!
//! A *ray* of { z : G z >= 0 } is given by the rows that vanish on it, a *circuit* mu >= 0 with
//! mu'G = 0 by its zeros. Both are found at one value of t, where G is a matrix of numbers, and
//! carried over to polynomials that hold around the value. Called by `reasons` and `alone`.

use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sign, cleared, common_denominator, cone_generators, dot,
    generic_kernel,
};
use num_traits::Signed;

/// The k-th unit vector.
pub(super) fn unit(length: usize, k: usize) -> Vec<Poly> {
    let mut unit = vec![Poly::default(); length];
    unit[k] = Poly::from_ints(&[1]);
    unit
}

pub(super) fn negated(v: &[Poly]) -> Vec<Poly> {
    v.iter().map(|p| -p).collect()
}

/// The sum of z_k basis_k.
pub(super) fn combined(basis: &[Vec<Poly>], z: &[Poly]) -> Vec<Poly> {
    let mut sum = vec![Poly::default(); basis[0].len()];
    for (vector, z_k) in basis.iter().zip(z) {
        for (s, v) in sum.iter_mut().zip(vector) {
            *s = &*s + &(v * z_k);
        }
    }

    sum
}

/// The sum of vectors of one length, `None` for no vector.
pub(super) fn sum(mut vectors: impl Iterator<Item = Vec<Poly>>) -> Option<Vec<Poly>> {
    let mut sum = vectors.next()?;
    for vector in vectors {
        for (s, v) in sum.iter_mut().zip(&vector) {
            *s = &*s + v;
        }
    }

    Some(sum)
}

/// The values of a row at t as constants, their denominators cleared.
pub(super) fn constants(row: &[Poly], t: &Rational) -> Vec<Poly> {
    let values: Vec<Rational> = row.iter().map(|p| p.eval(t)).collect();
    let clear = common_denominator(&values);
    values
        .iter()
        .map(|v| Poly::constant(cleared(v, &clear)))
        .collect()
}

/// The coefficients of each polynomial, constant term first.
pub(super) fn coefficients(v: &[Poly]) -> Vec<Vec<Integer>> {
    let mut coefficients = Vec::with_capacity(v.len());
    for p in v {
        coefficients.push(p.coeffs().to_vec());
    }

    coefficients
}

/// A vector and one more polynomial.
pub(super) struct Extended {
    pub(super) vector: Vec<Poly>,
    pub(super) more: Poly,
}

/// The vector without the factor that all its polynomials share.
pub(super) fn primitive(vector: Vec<Poly>) -> Vec<Poly> {
    let extended = Extended {
        vector,
        more: Poly::default(),
    };

    extended.primitive().vector
}

impl Extended {
    /// The same without the factor that all of them share.
    pub(super) fn primitive(self) -> Extended {
        let mut shared = self.more.clone();
        for p in &self.vector {
            shared = shared.gcd(p);
        }

        let shared = shared.primitive();
        if shared.degree().is_none() {
            return self;
        }

        let mut content = Integer::default();
        for p in self.vector.iter().chain([&self.more]) {
            content = num_integer::Integer::gcd(&content, &p.content());
        }

        Extended {
            vector: self
                .vector
                .iter()
                .map(|p| divided(p, &shared, &content))
                .collect(),
            more: divided(&self.more, &shared, &content),
        }
    }
}

/// p without a factor, and without a positive content; both divide it.
fn divided(p: &Poly, factor: &Poly, content: &Integer) -> Poly {
    let quotient = p.exact_div(factor).unwrap_or_else(|| p.clone());
    if content.is_positive() {
        Poly::new(quotient.coeffs().iter().map(|c| c / content).collect())
    } else {
        quotient
    }
}

/// An extreme mu >= 0 with mu'G = 0 at a value, not zero on all of the first `strict` rows.
/// `dimension` is the number of columns of G.
pub(super) fn circuit_at(
    rows: &[Vec<Poly>],
    strict: usize,
    dimension: usize,
    value: &mut Algebraic,
) -> Option<Vec<Poly>> {
    if dimension == 1 {
        return circuit_of_column(rows, strict, value);
    }

    let mut conditions: Vec<Vec<Poly>> = Vec::new();
    for k in 0..dimension {
        let column: Vec<Poly> = rows.iter().map(|row| row[k].clone()).collect();
        conditions.push(negated(&column));
        conditions.push(column);
    }

    for k in 0..rows.len() {
        conditions.push(unit(rows.len(), k));
    }

    let rays = cone_generators(&conditions, rows.len(), value).rays;
    for mu in rays {
        let is_strict = mu[..strict]
            .iter()
            .any(|m| value.clone().sign_of(m) != Sign::Zero);
        if is_strict {
            return Some(value.reduce(&mu));
        }
    }

    None
}

/// The same for one column g: a unit vector where a strict g_i is zero, else positive entries at
/// two rows in which g has opposite signs.
fn circuit_of_column(
    rows: &[Vec<Poly>],
    strict: usize,
    value: &mut Algebraic,
) -> Option<Vec<Poly>> {
    let signs: Vec<Sign> = rows.iter().map(|row| value.sign_of(&row[0])).collect();
    if let Some(i) = signs[..strict].iter().position(|sign| *sign == Sign::Zero) {
        return Some(unit(rows.len(), i));
    }

    for i in 0..strict {
        let is_opposite = |sign: &Sign| *sign != Sign::Zero && *sign != signs[i];
        let Some(k) = signs.iter().position(is_opposite) else {
            continue;
        };
        // |g_k| g_i + |g_i| g_k = 0.
        let mut mu = vec![Poly::default(); rows.len()];
        for [own, other] in [[i, k], [k, i]] {
            let g = &rows[other][0];
            mu[own] = match signs[other] {
                Sign::Negative => -g,
                Sign::Zero | Sign::Positive => g.clone(),
            };
        }
        return Some(value.reduce(&mu));
    }

    None
}

/// The mu over Q(t) with the zeros of an extreme one at t.
pub(super) fn generic_circuit(rows: &[Vec<Poly>], mu: &[Poly], t: &Rational) -> Option<Vec<Poly>> {
    let chosen: Vec<usize> = (0..rows.len()).filter(|&i| mu[i].sign_at(t) != 0).collect();
    let width = rows.first().map_or(0, Vec::len);
    let transposed = (0..width)
        .map(|k| chosen.iter().map(|&i| rows[i][k].clone()).collect())
        .collect();

    let [circuit] = &generic_kernel(transposed).0[..] else {
        return None;
    };

    let mut circuit = primitive(circuit.clone());
    if circuit.first()?.sign_at(t) < 0 {
        circuit = negated(&circuit);
    }

    let mut all = vec![Poly::default(); rows.len()];
    for (i, p) in chosen.into_iter().zip(circuit) {
        all[i] = p;
    }

    Some(all)
}

/// The ray over Q(t) with the rows that vanish on the ray z at t. `here` are the rows at t.
pub(super) fn generic_ray(
    rows: &[Vec<Poly>],
    here: &[Vec<Poly>],
    z: &[Poly],
    t: &Rational,
) -> Option<Vec<Poly>> {
    if z.len() == 1 {
        return Some(z.to_vec());
    }

    let mut tight = Vec::new();
    for (row, row_here) in rows.iter().zip(here) {
        if dot(row_here, z).sign_at(t) == 0 {
            tight.push(row.clone());
        }
    }

    let [ray] = &generic_kernel(tight).0[..] else {
        return None;
    };

    let k = (0..z.len()).find(|&k| z[k].sign_at(t) != 0)?;
    match ray[k].sign_at(t) * z[k].sign_at(t) {
        0 => None,
        1.. => Some(ray.clone()),
        _ => Some(negated(ray)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::nonnegative_roots;

    /// A column at sqrt 2, and the mu that is expected of it; the first two rows are strict.
    #[track_caller]
    fn assert_circuit(column: [&[i64]; 3], expected: Option<[&[i64]; 3]>) {
        let mut sqrt_2 = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
        let rows = column.map(|g| vec![Poly::from_ints(g)]);
        let mu = circuit_at(&rows, 2, 1, &mut sqrt_2);
        let expected = expected.map(|mu| mu.map(Poly::from_ints).to_vec());
        assert_eq!(mu, expected);
    }

    #[test]
    fn a_circuit_of_one_column_is_a_zero_or_two_signs() {
        let (above, below): (&[i64], &[i64]) = (&[-1, 1], &[-2, 1]); // t - 1 > 0 > t - 2
        let zero: &[i64] = &[-2, 0, 1];

        assert_circuit([above, zero, below], Some([&[], &[1], &[]]));
        assert_circuit([above, above, below], Some([&[2, -1], &[], &[-1, 1]]));
        assert_circuit([below, above, above], Some([&[-1, 1], &[2, -1], &[]]));
        // Every row is satisfied by one z, or only rows that are not strict contradict it.
        assert_circuit([above, above, zero], None);
        assert_circuit([below, below, below], None);
    }
}
