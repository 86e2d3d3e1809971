//! Against the exact condensation of an oblique system, and the residuals against dense algebra.

use super::*;
use crate::reduction::condense;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, Pencil, Problem, System, Unknown, Window};
use nalgebra::{DMatrix, DVector};

const ORDER: usize = 6;

/// K or M of order 6: dofs 2 and 3 are free; (0, 1) slips along an oblique frame, (4, 5) along the
/// axes. The entries are integers over `scale`, and `diagonal` is added on the diagonal.
fn exact(diagonal: i64, scale: i64) -> Sparse {
    from_function(|i, j| {
        let pattern = (3 * i.min(j) + 5 * i.max(j)) % 7;
        let entry = rational(pattern as i64 - 3, scale);
        if i == j {
            entry + whole(diagonal)
        } else {
            entry
        }
    })
}

fn from_function(entry: impl Fn(usize, usize) -> Rational) -> Sparse {
    let mut entries = Vec::new();
    for i in 0..ORDER {
        for j in 0..ORDER {
            entries.push((i, j, entry(i, j)));
        }
    }

    Sparse::from_entries(ORDER, ORDER, entries)
}

fn particles() -> Vec<Particle> {
    let oblique_frame = [
        [rational(3, 5), rational(4, 5)],
        [rational(-4, 5), rational(3, 5)],
    ];
    vec![
        Particle {
            frame: Some(oblique_frame),
            ..Particle::plain(0, 1, ContactState::Slip { sign: 1 })
        },
        Particle {
            normal_direction: -1,
            ..Particle::plain(4, 5, ContactState::Slip { sign: -1 })
        },
    ]
}

fn double(matrix: &Sparse) -> Symmetric {
    let entries = matrix.entries().map(|(i, j, v)| (i, j, to_f64(v)));
    Symmetric::new(ORDER, entries).unwrap()
}

fn condensation(k: &Sparse, m: Option<&Sparse>) -> SparseCondensation {
    SparseCondensation::new(double(k), m.map(double), &particles(), None).unwrap()
}

/// The pencil of MCEIP-mu with this stiffness, condensed exactly.
fn condensed_exactly(stiffness: Sparse) -> Pencil {
    let system = System::new(stiffness, None, None, particles()).unwrap();
    let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all()).unwrap();
    let reduced = reduce(&problem).unwrap().pencil;
    condense(&Admissible::new(&reduced, Unknown::Mu).unwrap()).unwrap()
}

fn assert_close(a: f64, b: f64) {
    approx::assert_relative_eq!(a, b, epsilon = 1e-11, max_relative = 1e-11);
}

#[test]
fn a_and_b_are_those_of_the_exact_condensation() {
    let k = exact(40, 1);
    let m = exact(9, 3);
    let condensation = condensation(&k, Some(&m));
    assert_eq!((condensation.dofs(), condensation.slip_count()), (6, 2));

    for t in [whole(0), rational(5, 4)] {
        let got = condensation.at(to_f64(&t)).unwrap();

        let expected = condensed_exactly(k.add_scaled(&t, &m));
        for p in 0..2 {
            for q in 0..2 {
                assert_close(got.a[p][q], to_f64(&expected.a().get(p, q)));
                assert_close(got.b[p][q], to_f64(&expected.b().get(p, q)));
            }
        }
    }
}

/// v of x: -S t on the slip particles, f in balance; the kinetic energy is v' M v.
#[test]
fn a_lifted_x_is_in_balance_and_has_its_energy() {
    let k = exact(40, 1);
    let m = exact(9, 3);
    let condensation_with_mass = condensation(&k, Some(&m));
    let at_zero = condensation_with_mass.at(0.0).unwrap();
    let x = [2.0, 3.0];

    let v = at_zero.lift(&x);

    for (dof, value) in [(0, -6.0 / 5.0), (1, -8.0 / 5.0), (4, 3.0), (5, 0.0)] {
        assert_close(v[dof], value);
    }

    let v_vector = DVector::from_vec(v.clone());
    let load = dense(&k) * &v_vector;
    for dof in [2, 3] {
        assert_close(load[dof], 0.0);
    }

    let energy = v_vector.dot(&(dense(&m) * &v_vector));
    assert_close(at_zero.kinetic(&x).unwrap(), energy);
    assert_eq!(at_zero.reduced(&x), [v[2], v[3], 2.0, 3.0]);
    assert!(v[2].abs() > 1e-3);

    let massless = condensation(&k, None);
    assert!(massless.at(0.0).unwrap().kinetic(&x).is_none());
}

fn dense(matrix: &Sparse) -> DMatrix<f64> {
    DMatrix::from_fn(ORDER, ORDER, |i, j| to_f64(&matrix.get(i, j)))
}

fn block(matrix: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(rows).select_columns(columns)
}

/// Both numbers of [`CondensationResidual`] by dense algebra: a factor of `made`, measured against
/// `measured`.
struct DenseResidual {
    measured: DMatrix<f64>,
    free: Vec<usize>,
    kept: Vec<usize>,
    /// K_ff^-1 of `made`.
    inverse: DMatrix<f64>,
    /// K_ff^-1 K_fk of `made`.
    elimination: DMatrix<f64>,
    /// The Schur complement of `made` on the kept dofs.
    schur: DMatrix<f64>,
}

impl DenseResidual {
    fn new(made: &DMatrix<f64>, measured: DMatrix<f64>, kept: &[usize]) -> DenseResidual {
        let free = vec![2, 3];
        let inverse = block(made, &free, &free).try_inverse().unwrap();
        let elimination = &inverse * block(made, &free, kept);
        let schur = block(made, kept, kept) - block(made, kept, &free) * &elimination;
        DenseResidual {
            measured,
            free,
            kept: kept.to_vec(),
            inverse,
            elimination,
            schur,
        }
    }

    fn of(&self, c: &DVector<f64>) -> CondensationResidual {
        let mut u = DVector::zeros(ORDER);
        let u_free = -&self.elimination * c;
        for (i, &dof) in self.kept.iter().enumerate() {
            u[dof] = c[i];
        }

        for (i, &dof) in self.free.iter().enumerate() {
            u[dof] = u_free[i];
        }

        let load = &self.measured * &u;
        let sizes = self.measured.abs() * u.abs();
        let load_free = load.select_rows(&self.free);
        let balance = load_free.amax() / sizes.select_rows(&self.free).amax();

        let step = &self.inverse * load_free;
        for (i, &dof) in self.free.iter().enumerate() {
            u[dof] -= step[i];
        }

        let refined = (&self.measured * &u).select_rows(&self.kept);
        let change = (&refined - &self.schur * c).amax() / refined.amax();

        CondensationResidual { balance, change }
    }
}

/// A factor of one matrix measured against another one, so that nothing is small: both numbers by
/// dense algebra.
#[test]
fn the_residual_is_that_of_dense_algebra() {
    let k = exact(40, 1);
    let change = from_function(|i, j| rational(((i + 1) * (j + 1) % 5) as i64, 10));
    let other = k.add_scaled(&whole(1), &change);
    let made = condensation(&k, None);
    let measured = condensation(&other, None);
    let at_zero = made.at(0.0).unwrap();
    let mixed = SparseCondensed {
        system: &measured,
        t: 0.0,
        a: at_zero.a,
        b: at_zero.b,
        factor: at_zero.factor,
    };

    let by_dense_algebra = DenseResidual::new(&dense(&k), dense(&other), made.analysis.kept());

    let mut balance: f64 = 0.0;
    let mut change: f64 = 0.0;
    for probes in 0..4 {
        // One probe more than in the round before.
        let c = if probes == 0 {
            DVector::from_column_slice(&[1.0, 0.0, 1.0, 0.0])
        } else {
            DVector::from_fn(4, |i, _| sign(probes, i))
        };
        let expected = by_dense_algebra.of(&c);
        balance = balance.max(expected.balance);
        change = change.max(expected.change);

        let got = mixed.residual(probes);
        assert_close(got.balance, balance);
        assert_close(got.change, change);
    }

    assert!(balance > 1e-4 && change > 1e-4);

    let good = made.at(0.0).unwrap().residual(5);
    assert!(good.balance < 1e-14 && good.change < 1e-14, "{good:?}");
}

/// Multiplication of 64-bit numbers that drops what lies above.
fn wrapping_product(a: u128, b: u128) -> u128 {
    a * b % (1 << 64)
}

/// The patterns are those of the hash as written, and not all the same.
#[test]
fn probes_are_reproducible_patterns_of_signs() {
    for probe in 1..20usize {
        let pattern: Vec<f64> = (0..64).map(|i| sign(probe, i)).collect();

        for (i, s) in pattern.iter().enumerate() {
            let spread = wrapping_product(i as u128, 0x9e37_79b9_7f4a_7c15);
            let mixed = spread ^ (probe as u128 * 131_072);
            let bit = wrapping_product(mixed, 0xbf58_476d_1ce4_e5b9) / (1 << 40) % 2;
            assert_eq!(*s, if bit == 0 { 1.0 } else { -1.0 });
        }
        let plus = pattern.iter().filter(|s| **s > 0.0).count();
        assert!((12..52).contains(&plus), "{probe}: {plus}");
    }
}
