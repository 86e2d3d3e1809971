//! Laws of the mechanics on random problems: (19) is necessary, (17)-(18) suffice, spectra of
//! symmetric parts, changes of scale, mass, coordinates and numbering. Decided exactly.
#![cfg(feature = "testkit")]

use mceip_engine::reduction::{mu_family, reduce};
use mceip_exact::{
    Algebraic, Poly, Rational, Sparse, common_denominator, determinant, positive_definite,
    rational, roots_in, whole,
};
use mceip_model::{Body, Particle, Pencil, Problem, System, Unknown, Window};
use mceip_oracle::{Enumeration, Solution, enumerate, is_rational_solution};
use mceip_testkit::generators::{Seed, gram, permuted, raw, sparse, states, with_scaled_rows};
use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

fn rng(index: u64) -> ChaCha8Rng {
    Seed {
        family: 1000,
        seed: 1,
        index,
    }
    .rng()
}

fn run(p: &Pencil) -> Enumeration {
    enumerate(p, &Window::all()).unwrap()
}

fn symmetric(m: &Sparse) -> Sparse {
    let half = |m: &Sparse| Sparse::zeros(m.rows(), m.cols()).add_scaled(&rational(1, 2), m);
    half(m).add_scaled(&whole(1), &half(&m.transpose()))
}

/// a times the number, as a root of the polynomial with its roots multiplied by a.
fn times(a: &Rational, value: &Algebraic) -> Algebraic {
    let p = value.poly().coeffs();
    let power = |k: usize| (0..k).fold(whole(1), |q, _| q * a);
    let scaled: Vec<Rational> = p
        .iter()
        .enumerate()
        .map(|(k, c)| Rational::from_integer(c.clone()) * power(p.len() - 1 - k))
        .collect();
    let (lo, hi) = (value.interval().lo() * a, value.interval().hi() * a);
    Algebraic::from_claim(
        Poly::from_rationals(&scaled),
        mceip_exact::Interval::new(lo, hi).unwrap(),
    )
}

/// The same supports, values multiplied by `a`.
fn scaled_by(a: &Rational, p: &Enumeration, q: &Enumeration) -> bool {
    let same = |(s, t): (&Solution, &Solution)| {
        s.slip == t.slip
            && s.biactive == t.biactive
            && times(a, &s.value).equals(&mut t.value.clone())
    };
    p.solutions.len() == q.solutions.len()
        && p.cones.len() == q.cones.len()
        && p.solutions.iter().zip(&q.solutions).all(same)
}

/// (19): with M* positive semidefinite and K* positive definite nothing diverges. Both sides of the
/// condition occur.
#[test]
fn condition_19_is_necessary() {
    let (mut silent, mut diverging) = (0, 0);
    for index in 0..300 {
        let mut rng = rng(index);
        let (n_s, n_f) = (rng.random_range(1..=3), rng.random_range(0..=1));
        let pencil = if index % 3 == 0 {
            raw::elements(Unknown::Lambda2, &mut rng, n_s, n_f).unwrap()
        } else {
            // K* with a skew part, so that its symmetric part is not the whole.
            let n = n_s + n_f;
            let mut k = gram(&mut rng, n, if index % 3 == 1 { 1 } else { -2 });
            (0..n)
                .flat_map(|i| (0..i).map(move |j| (i, j)))
                .for_each(|(i, j)| {
                    let skew = rng.random_range(-4..=4);
                    k[i][j] += skew;
                    k[j][i] -= skew;
                });
            Pencil::new(
                sparse(&k),
                sparse(&gram(&mut rng, n, 1)),
                (0..n_f).collect(),
            )
            .unwrap()
        };
        let holds = positive_definite(&symmetric(pencil.b())).is_ok()
            && positive_definite(&symmetric(pencil.a())).is_ok();
        let found = run(&pencil);
        let diverges = !found.solutions.is_empty() || !found.cones.is_empty();
        assert!(
            !(holds && diverges),
            "{pencil:?}: (19) fails and {:?} diverges",
            found.solutions
        );
        silent += usize::from(holds);
        diverging += usize::from(diverges);
    }
    assert!(silent > 60 && diverging > 30, "{silent} {diverging}");
}

/// (17)-(18): a null vector with x_s >= 0 at lambda^2 >= 0 is a solution, and the enumerator has
/// it; the same vector with one sign turned is none.
#[test]
fn conditions_17_and_18_suffice() {
    for index in 0..60 {
        let mut rng = rng(1000 + index);
        let n = rng.random_range(2..=4);
        let value = rational(rng.random_range(0..=20), rng.random_range(1..=5));
        let mut x: Vec<Rational> = (0..n)
            .map(|_| rational(rng.random_range(0..=5), rng.random_range(1..=3)))
            .collect();
        x[0] = whole(1);
        let b = sparse(&gram(&mut rng, n, 1));
        let mut a = raw::digits(&mut rng, n, 0).unwrap().a().clone();
        let image = a.add_scaled(&value, &b).times(&x);
        a = a.add_scaled(
            &whole(-1),
            &Sparse::from_entries(n, n, image.into_iter().enumerate().map(|(i, v)| (i, 0, v))),
        );
        let pencil = Pencil::new(a, b, vec![]).unwrap();
        assert!(is_rational_solution(&pencil, &value, &x));
        let clear = common_denominator(&x);
        let poly = |x: &[Rational]| {
            x.iter()
                .map(|v| Poly::constant(v.numer() * (&clear / v.denom())))
                .collect::<Vec<_>>()
        };
        let found = run(&pencil);
        assert!(
            found.contains(&pencil, &Algebraic::rational(value.clone()), &poly(&x)),
            "{index}"
        );
        x[0] = whole(-1);
        assert!(
            !found.contains(&pencil, &Algebraic::rational(value), &poly(&x)),
            "{index}"
        );
    }
}

/// The least eigenvalue of the symmetric part is no larger than any real eigenvalue: sym(A) - r I
/// is not positive definite for any r at or above one. And below all of them it may be.
#[test]
fn symmetric_parts_bound_the_real_spectrum() {
    let mut eigenvalues = 0;
    for index in 0..120 {
        let mut rng = rng(2000 + index);
        let n = rng.random_range(1..=4);
        let rows: Vec<Vec<i64>> = (0..n)
            .map(|_| (0..n).map(|_| rng.random_range(-5..=5)).collect())
            .collect();
        let a = sparse(&rows);
        let integers: Vec<Vec<_>> = rows
            .iter()
            .map(|r| r.iter().map(|v| (*v).into()).collect())
            .collect();
        let minus: Vec<Vec<_>> = (0..n)
            .map(|i| (0..n).map(|j| (-i64::from(i == j)).into()).collect())
            .collect();
        let shifted = |r: &Rational| symmetric(&a).add_scaled(&-r, &Sparse::identity(n));
        for mut root in roots_in(
            &determinant(&integers, &minus),
            &whole(-100),
            Some(&whole(100)),
        ) {
            root.refine_to(&rational(1, 1 << 30));
            assert!(
                positive_definite(&shifted(root.interval().hi())).is_err(),
                "{rows:?}"
            );
            eigenvalues += 1;
        }
        // Gershgorin: at -100 the symmetric part is definite, so the law above is not empty.
        assert!(positive_definite(&shifted(&whole(-100))).is_ok());
    }
    assert!(eigenvalues > 100);
}

/// Section 3: K0 and M0 are definite, so are K* and M* for small mu, and then nothing diverges; a
/// lumped M gives M* = M0, diagonal. The first mu of 1, 1/2, 1/4, ... at which both are definite is
/// taken; larger ones are not always silent.
#[test]
fn small_friction_is_silent_and_a_lumped_mass_stays_diagonal() {
    let (mut lumped, mut coupled, mut diverging) = (0, 0, 0);
    for index in 0..140 {
        let mut rng = rng(5000 + index);
        let system = states::system(&mut rng, &states::mixture(index), &mut Vec::new()).unwrap();
        let family = mu_family(&system).unwrap();
        let (k, m) = (&family.stiffness, family.mass.as_ref().unwrap());
        assert!(
            positive_definite(k.a()).is_ok() && positive_definite(m.a()).is_ok(),
            "{index}"
        );
        if system.mass().unwrap().entries().all(|(i, j, _)| i == j) {
            assert!(
                m.b().entries().all(|(_, _, v)| *v == whole(0))
                    && m.a().entries().all(|(i, j, v)| i == j || *v == whole(0))
            );
            lumped += 1;
        } else {
            coupled += usize::from(m.b().entries().any(|(_, _, v)| *v != whole(0)));
        }
        let star = |p: &Pencil, mu: &Rational| p.a().add_scaled(mu, p.b());
        let definite =
            |p: &Pencil, mu: &Rational| positive_definite(&symmetric(&star(p, mu))).is_ok();
        let solutions = |mu: &Rational| {
            run(&Pencil::new(star(k, mu), star(m, mu), k.free().to_vec()).unwrap())
                .solutions
                .len()
        };
        let mut mu = whole(1);
        while !(definite(k, &mu) && definite(m, &mu)) {
            mu /= whole(2);
        }
        assert_eq!(solutions(&mu), 0, "{index}: mu = {mu}");
        diverging += usize::from(solutions(&whole(64)) > 0);
    }
    assert!(
        lumped > 40 && coupled > 20 && diverging > 20,
        "{lumped} {coupled} {diverging}"
    );
}

/// M -> aM divides lambda^2 by a, K -> aK multiplies lambda^2 by a and leaves mu alone.
#[test]
fn mass_and_stiffness_may_be_scaled() {
    let mut solutions = 0;
    for index in 0..140 {
        let mut rng = rng(3000 + index);
        let system = states::system(&mut rng, &states::mixture(index), &mut Vec::new()).unwrap();
        let a = rational(rng.random_range(1..=9), rng.random_range(1..=9));
        let by = |m: &Sparse, a: &Rational| Sparse::zeros(m.rows(), m.cols()).add_scaled(a, m);
        let with = |k: &Rational, m: &Rational| {
            let mass = system.mass().map(|mass| by(mass, m));
            System::new(
                by(system.stiffness(), k),
                mass,
                system.friction().cloned(),
                system.particles().to_vec(),
            )
            .unwrap()
        };
        let solve = |s: System, unknown| {
            run(
                &reduce(&Problem::new(Body::System(s), unknown, Window::all()).unwrap())
                    .unwrap()
                    .pencil,
            )
        };
        let (one, lambda2, mu) = (whole(1), Unknown::Lambda2, Unknown::Mu);
        let (dynamic, fixed) = (solve(system.clone(), lambda2), solve(system.clone(), mu));
        assert!(
            scaled_by(&a.recip(), &dynamic, &solve(with(&one, &a), lambda2)),
            "{index}"
        );
        assert!(
            scaled_by(&a, &dynamic, &solve(with(&a, &one), lambda2)),
            "{index}"
        );
        assert!(
            scaled_by(&one, &fixed, &solve(with(&a, &one), mu)),
            "{index}"
        );
        assert!(!scaled_by(&whole(2), &fixed, &fixed) || fixed.solutions.is_empty());
        solutions += dynamic.solutions.len() + fixed.solutions.len();
    }
    assert!(solutions > 50);
}

/// Other numbers for the dofs, another order of the particles: the same values.
#[test]
fn dofs_and_particles_may_be_renumbered() {
    for index in 0..70 {
        let mut rng = rng(4000 + index);
        let system = states::system(&mut rng, &states::mixture(index), &mut Vec::new()).unwrap();
        let n = system.dofs();
        let place = |d: usize| (d + 1) % n;
        let back: Vec<usize> = (0..n).map(|d| (d + n - 1) % n).collect();
        let turn = |m: &Sparse| m.submatrix(&back, &back);
        let moved = |p: &Particle| Particle {
            tangential: place(p.tangential),
            normal: place(p.normal),
            ..p.clone()
        };
        let particles = system.particles().iter().rev().map(moved).collect();
        let other = System::new(
            turn(system.stiffness()),
            system.mass().map(turn),
            system.friction().cloned(),
            particles,
        )
        .unwrap();
        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let values = |s: &System| {
                let problem =
                    Problem::new(Body::System(s.clone()), unknown, Window::all()).unwrap();
                let mut list: Vec<(String, usize)> = run(&reduce(&problem).unwrap().pencil)
                    .solutions
                    .iter()
                    .map(|s| (s.decimal(20), s.slip.len()))
                    .collect();
                list.sort();
                list
            };
            assert_eq!(values(&system), values(&other), "{index}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    /// D A D and D B D with a positive diagonal D: the same values and supports, D^-1 x for x.
    #[test]
    fn positive_diagonal_congruence(index in 0u64..100_000, d in prop::collection::vec((1i64..20, 1i64..20), 5)) {
        let mut rng = rng(index);
        let n = rng.random_range(1..=4);
        let p = if index % 2 == 0 { raw::free_anywhere(&mut rng, n) } else { raw::zeros(&mut rng, n) }.unwrap();
        let d: Vec<Rational> = d.iter().map(|(u, v)| rational(*u, *v)).collect();
        let by = |m: &Sparse| Sparse::from_entries(n, n, m.entries().map(|(i, j, v)| (i, j, v * &d[i] * &d[j])));
        let q = Pencil::new(by(p.a()), by(p.b()), p.free().to_vec()).unwrap();
        let (left, right) = (run(&p), run(&q));
        prop_assert!(scaled_by(&whole(1), &left, &right));
        let clear = common_denominator(d.iter().map(|v| v.recip()).collect::<Vec<_>>().iter());
        for s in &left.solutions {
            let x: Vec<Poly> = s.x.iter().zip(&d).map(|(x, d)| x.scale(&(Rational::from_integer(clear.clone()) / d).to_integer())).collect();
            prop_assert!(right.contains(&q, &s.value, &x));
        }
    }

    /// Any order of the variables and any positive scale of the rows: the same values and as large
    /// supports.
    #[test]
    fn any_permutation_and_row_scaling(index in 0u64..100_000) {
        let mut rng = rng(index);
        let n = rng.random_range(1..=4);
        let p = if index % 2 == 0 { raw::free_anywhere(&mut rng, n) } else { raw::identity(&mut rng, n) }.unwrap();
        let turned = permuted(&mut rng, &p);
        let q = with_scaled_rows(&mut rng, &turned);
        let key = |p: &Pencil| {
            let found = run(p);
            let mut list: Vec<_> = found.solutions.iter().map(|s| (s.decimal(20), s.slip.len(), s.biactive.len(), s.multiplicity)).collect();
            list.sort();
            (list, found.cones.len(), found.ranges.len(), found.continua.len())
        };
        prop_assert_eq!(key(&p), key(&q));
    }
}
