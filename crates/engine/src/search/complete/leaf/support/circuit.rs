//! Rays and circuits of the rows of G, at a value and carried over to polynomials in t around one.

use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sign, common_denominator, cone_generators, dot,
    generic_kernel,
};
use num_traits::Signed;

/// mu >= 0 with mu'G = 0, not zero on the first `moving` rows: an extreme one.
pub(crate) fn impossible(
    rows: &[Vec<Poly>],
    moving: usize,
    dimension: usize,
    value: &mut Algebraic,
) -> Option<Vec<Poly>> {
    let mut conditions: Vec<Vec<Poly>> = Vec::new();
    for k in 0..dimension {
        let column: Vec<Poly> = rows.iter().map(|r| r[k].clone()).collect();
        conditions.push(column.iter().map(|p| -p).collect());
        conditions.push(column);
    }
    let unit = |k: usize| {
        (0..rows.len())
            .map(|i| {
                if i == k {
                    Poly::from_ints(&[1])
                } else {
                    Poly::default()
                }
            })
            .collect()
    };
    conditions.extend((0..rows.len()).map(unit));
    let found = cone_generators(&conditions, rows.len(), value).rays;
    let fits = |mu: &&Vec<Poly>| {
        mu[..moving]
            .iter()
            .any(|m| value.clone().sign_of(m) != Sign::Zero)
    };
    found.iter().find(fits).map(|mu| value.reduce(mu))
}

/// The mu over Q(t) with the zeros of an extreme one at t.
pub(crate) fn generic_circuit(rows: &[Vec<Poly>], mu: &[Poly], t: &Rational) -> Option<Vec<Poly>> {
    let chosen: Vec<usize> = (0..rows.len()).filter(|&i| mu[i].sign_at(t) != 0).collect();
    let width = rows.first().map_or(0, Vec::len);
    let transposed = (0..width)
        .map(|k| chosen.iter().map(|&i| rows[i][k].clone()).collect())
        .collect();
    let [circuit] = &generic_kernel(transposed).0[..] else {
        return None;
    };
    let (mut circuit, _) = divided(circuit.clone(), Poly::default());
    if circuit.first()?.sign_at(t) < 0 {
        circuit = circuit.iter().map(|p| -p).collect();
    }
    let mut all = vec![Poly::default(); rows.len()];
    chosen
        .into_iter()
        .zip(circuit)
        .for_each(|(i, p)| all[i] = p);
    Some(all)
}

/// The ray over Q(t) with the tight rows that z has at t.
pub(crate) fn extended(
    rows: &[Vec<Poly>],
    here: &[Vec<Poly>],
    z: &[Poly],
    t: &Rational,
) -> Option<Vec<Poly>> {
    if z.len() == 1 {
        return Some(z.to_vec());
    }
    let tight: Vec<Vec<Poly>> = rows
        .iter()
        .zip(here)
        .filter(|(_, h)| dot(h, z).sign_at(t) == 0)
        .map(|(r, _)| r.clone())
        .collect();
    let [ray] = &generic_kernel(tight).0[..] else {
        return None;
    };
    let k = (0..z.len()).find(|&k| z[k].sign_at(t) != 0)?;
    let same = ray[k].sign_at(t) * z[k].sign_at(t);
    (same != 0).then(|| {
        if same > 0 {
            ray.clone()
        } else {
            ray.iter().map(|p| -p).collect()
        }
    })
}

pub(crate) fn combined(basis: &[Vec<Poly>], z: &[Poly]) -> Vec<Poly> {
    (0..basis[0].len())
        .map(|i| {
            basis
                .iter()
                .zip(z)
                .fold(Poly::default(), |s, (v, z_k)| &s + &(&v[i] * z_k))
        })
        .collect()
}

pub(crate) fn constants(row: &[Poly], t: &Rational) -> Vec<Poly> {
    let values: Vec<Rational> = row.iter().map(|p| p.eval(t)).collect();
    let clear = common_denominator(&values);
    values
        .iter()
        .map(|v| Poly::constant(v.numer() * (&clear / v.denom())))
        .collect()
}

/// The vector and one more polynomial without the factor that all of them share.
pub(crate) fn divided(v: Vec<Poly>, more: Poly) -> (Vec<Poly>, Poly) {
    let shared = v.iter().fold(more.clone(), |g, p| g.gcd(p)).primitive();
    if shared.degree().is_none() {
        return (v, more);
    }
    let content = v.iter().chain([&more]).fold(Integer::default(), |g, p| {
        num_integer::Integer::gcd(&g, &p.content())
    });
    let without = |p: &Poly| -> Poly {
        let q = p.exact_div(&shared).unwrap_or_else(|| p.clone()); // exact: the gcd divides
        if content.is_positive() {
            Poly::new(q.coeffs().iter().map(|c| c / &content).collect())
        } else {
            q
        }
    };
    (v.iter().map(without).collect(), without(&more))
}

pub(crate) fn coefficients(v: &[Poly]) -> Vec<Vec<Integer>> {
    v.iter().map(|p| p.coeffs().to_vec()).collect()
}
