//! Against the exact condensation of an oblique system, and the residuals against dense algebra.

use super::*;
use crate::reduction::{condense, reduce};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Admissible, Body, Problem, System, Unknown, Window};
use nalgebra::{DMatrix, DVector};

/// K, M: dofs 2 and 3 are free; (0, 1) slips along an oblique frame, (4, 5) along the axes.
fn exact(diagonal: i64, scale: i64) -> Sparse {
    let entry = |i: usize, j: usize| {
        let v = rational(((3 * i.min(j) + 5 * i.max(j)) % 7) as i64 - 3, scale);
        if i == j { v + whole(diagonal) } else { v }
    };
    Sparse::from_entries(
        6,
        6,
        (0..6)
            .flat_map(|i| (0..6).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, entry(i, j)))
            .collect::<Vec<_>>(),
    )
}

fn particles() -> Vec<Particle> {
    let r = rational;
    let slip = |sign| ContactState::Slip { sign };
    let oblique = Particle {
        frame: Some([[r(3, 5), r(4, 5)], [r(-4, 5), r(3, 5)]]),
        ..Particle::plain(0, 1, slip(1))
    };
    vec![
        oblique,
        Particle {
            normal_direction: -1,
            ..Particle::plain(4, 5, slip(-1))
        },
    ]
}

fn double(m: &Sparse) -> Symmetric {
    Symmetric::new(6, m.entries().map(|(i, j, v)| (i, j, to_f64(v)))).unwrap()
}

fn condensation(k: &Sparse, m: Option<&Sparse>) -> SparseCondensation {
    SparseCondensation::new(double(k), m.map(double), &particles(), None).unwrap()
}

fn close(a: f64, b: f64) {
    approx::assert_relative_eq!(a, b, epsilon = 1e-11, max_relative = 1e-11);
}

#[test]
fn a_and_b_are_those_of_the_exact_condensation() {
    let (k, m) = (exact(40, 1), exact(9, 3));
    let c = condensation(&k, Some(&m));
    assert_eq!((c.dofs(), c.slip_count()), (6, 2));
    for t in [whole(0), rational(5, 4)] {
        let at_t = k.add_scaled(&t, &m);
        let system = System::new(at_t, None, None, particles()).unwrap();
        let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap();
        let reduced = reduce(&problem).unwrap().pencil;
        let expected = condense(&Admissible::new(&reduced, Unknown::Mu).unwrap()).unwrap();
        let got = c.at(to_f64(&t)).unwrap();
        for p in 0..2 {
            for q in 0..2 {
                close(got.a[p][q], to_f64(&expected.a().get(p, q)));
                close(got.b[p][q], to_f64(&expected.b().get(p, q)));
            }
        }
    }
}

/// v of x: -S t on the slip particles, f in balance; the kinetic energy is v' M v.
#[test]
fn a_lifted_x_is_in_balance_and_has_its_energy() {
    let (k, m) = (exact(40, 1), exact(9, 3));
    let c = condensation(&k, Some(&m));
    let at = c.at(0.0).unwrap();
    let x = [2.0, 3.0];
    let v = at.lift(&x);
    [(0, -6.0 / 5.0), (1, -8.0 / 5.0), (4, 3.0), (5, 0.0)]
        .into_iter()
        .for_each(|(dof, value)| close(v[dof], value));
    let product = |m: &Sparse, i: usize| (0..6).map(|j| to_f64(&m.get(i, j)) * v[j]).sum::<f64>();
    [2, 3].into_iter().for_each(|i| close(product(&k, i), 0.0));
    close(
        at.kinetic(&x).unwrap(),
        (0..6).map(|i| v[i] * product(&m, i)).sum(),
    );
    assert_eq!(at.reduced(&x), [v[2], v[3], 2.0, 3.0]);
    assert!(
        v[2].abs() > 1e-3
            && condensation(&k, None)
                .at(0.0)
                .unwrap()
                .kinetic(&x)
                .is_none()
    );
}

fn dense(m: &Sparse) -> DMatrix<f64> {
    DMatrix::from_fn(6, 6, |i, j| to_f64(&m.get(i, j)))
}

/// A factor of one matrix measured against another one, so that nothing is small: both numbers by
/// dense algebra.
#[test]
fn the_residual_is_that_of_dense_algebra() {
    let (k, mut other) = (exact(40, 1), exact(40, 1));
    let change: Vec<(usize, usize, Rational)> = (0..6)
        .flat_map(|i| (0..6).map(move |j| (i, j)))
        .map(|(i, j)| (i, j, rational(((i + 1) * (j + 1) % 5) as i64, 10)))
        .collect();
    other = other.add_scaled(&whole(1), &Sparse::from_entries(6, 6, change));
    let (made, measured) = (condensation(&k, None), condensation(&other, None));
    let at = made.at(0.0).unwrap();
    let mixed = SparseCondensed {
        system: &measured,
        t: 0.0,
        a: at.a,
        b: at.b,
        factor: at.factor,
    };
    let (k, other) = (dense(&k), dense(&other));
    let (free, kept) = ([2, 3], made.analysis.kept().to_vec());
    let block = |m: &DMatrix<f64>, r: &[usize], c: &[usize]| {
        DMatrix::from_fn(r.len(), c.len(), |i, j| m[(r[i], c[j])])
    };
    let inverse = block(&k, &free, &free).try_inverse().unwrap();
    let schur =
        block(&k, &kept, &kept) - block(&k, &kept, &free) * &inverse * block(&k, &free, &kept);
    let (mut balance, mut change) = (0f64, 0f64);
    for probes in 0..4 {
        // One probe more than before.
        let entry = |i: usize| {
            if probes == 0 {
                [1.0, 0.0][i % 2]
            } else {
                sign(probes, i)
            }
        };
        let c = DVector::from_fn(4, |i, _| entry(i));
        let mut u = DVector::zeros(6);
        let f = -&inverse * block(&k, &free, &kept) * &c;
        kept.iter().enumerate().for_each(|(i, &dof)| u[dof] = c[i]);
        free.iter().enumerate().for_each(|(i, &dof)| u[dof] = f[i]);
        let load = &other * &u;
        let size = |i: usize| (0..6).map(|j| (other[(i, j)] * u[j]).abs()).sum::<f64>();
        let largest = free.iter().map(|&i| size(i)).fold(0.0, f64::max);
        balance = free
            .iter()
            .map(|&i| load[i].abs() / largest)
            .fold(balance, f64::max);
        let step = &inverse * DVector::from_fn(2, |i, _| load[free[i]]);
        free.iter()
            .enumerate()
            .for_each(|(i, &dof)| u[dof] -= step[i]);
        let (refined, z) = (&other * &u, &schur * &c);
        let largest = kept.iter().map(|&i| refined[i].abs()).fold(0.0, f64::max);
        change = kept
            .iter()
            .enumerate()
            .map(|(k, &i)| (refined[i] - z[k]).abs() / largest)
            .fold(change, f64::max);
        let got = mixed.residual(probes);
        close(got.balance, balance);
        close(got.change, change);
    }
    assert!(balance > 1e-4 && change > 1e-4);
    let good = made.at(0.0).unwrap().residual(5);
    assert!(good.balance < 1e-14 && good.change < 1e-14, "{good:?}");
}

/// The patterns are those of the hash as written, and not all the same.
#[test]
fn probes_are_reproducible_patterns_of_signs() {
    let wrap = |a: u128, b: u128| a * b % (1 << 64);
    for probe in 1..20usize {
        let pattern: Vec<f64> = (0..64).map(|i| sign(probe, i)).collect();
        for (i, s) in pattern.iter().enumerate() {
            let mixed = wrap(i as u128, 0x9e37_79b9_7f4a_7c15) ^ (probe as u128 * 131_072);
            let bit = wrap(mixed, 0xbf58_476d_1ce4_e5b9) / (1 << 40) % 2;
            assert_eq!(*s, [1.0, -1.0][usize::try_from(bit).unwrap()]);
        }
        let plus = pattern.iter().filter(|s| **s > 0.0).count();
        assert!((12..52).contains(&plus), "{probe}: {plus}");
    }
}
