//! Laws of the problem on structured random pencils: scaling, permutation, shift, window, round
//! trips.

use mceip_exact::{Sparse, rational, whole};
use mceip_model::file::{read_problem, write_problem};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate};
use proptest::prelude::*;
use std::path::Path;

/// A pencil of order 1 to 4 with small integers, sparse on purpose so that corners occur.
fn pencils() -> impl Strategy<Value = Pencil> {
    (1usize..=4).prop_flat_map(|n| {
        let entries =
            prop::collection::vec(prop_oneof![2 => Just(0i64), 3 => -4i64..=4], 2 * n * n);
        (entries, 0u8..(1 << n)).prop_map(move |(e, mask)| {
            let matrix = |o: usize| {
                Sparse::from_entries(n, n, (0..n * n).map(|k| (k / n, k % n, whole(e[o + k]))))
            };
            let free = (0..n).filter(|i| mask & 0x5 & (1 << i) != 0).collect();
            Pencil::new(matrix(0), matrix(n * n), free).unwrap()
        })
    })
}

fn run(p: &Pencil) -> Enumeration {
    enumerate(p, &Window::all()).unwrap()
}

type Row = (String, Vec<usize>, Vec<usize>, Vec<String>);

/// Values, supports and x in decimals: what two equal answers share.
fn summary(p: &Pencil, e: &Enumeration) -> Vec<Row> {
    e.solutions
        .iter()
        .map(|s| {
            (
                s.decimal(20),
                s.slip.clone(),
                s.biactive.clone(),
                s.x_decimals(&p.slip(), 12),
            )
        })
        .collect()
}

fn scaled(m: &Sparse, factors: &[i64]) -> Sparse {
    Sparse::from_entries(
        m.rows(),
        m.cols(),
        m.entries().map(|(i, j, v)| (i, j, v * whole(factors[i]))),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    /// Positive row scaling changes neither x nor t.
    #[test]
    fn rows_may_be_scaled(p in pencils(), f in prop::collection::vec(1i64..9, 4)) {
        let q = Pencil::new(scaled(p.a(), &f), scaled(p.b(), &f), p.free().to_vec()).unwrap();
        prop_assert_eq!(summary(&p, &run(&p)), summary(&q, &run(&q)));
    }

    /// B -> 3 B divides every value by 3.
    #[test]
    fn scaling_b_divides_the_values(p in pencils()) {
        let b = Sparse::zeros(p.order(), p.order()).add_scaled(&whole(3), p.b());
        let q = Pencil::new(p.a().clone(), b, p.free().to_vec()).unwrap();
        let (e, f) = (run(&p), run(&q));
        prop_assert_eq!(e.solutions.len(), f.solutions.len());
        for (s, t) in e.solutions.iter().zip(&f.solutions) {
            prop_assert_eq!(&s.slip, &t.slip);
            let thrice: f64 = t.decimal(17).parse::<f64>().unwrap() * 3.0;
            prop_assert!((s.decimal(17).parse::<f64>().unwrap() - thrice).abs() <= 1e-12 * (1.0 + thrice));
        }
    }

    /// A -> A + B shifts values by -1; those below 1 leave the window.
    #[test]
    fn shifting_moves_the_window(p in pencils()) {
        let q = Pencil::new(p.a().add_scaled(&whole(1), p.b()), p.b().clone(), p.free().to_vec()).unwrap();
        let above = enumerate(&p, &Window::new(whole(1), None).unwrap()).unwrap();
        let shifted = run(&q);
        let supports = |e: &Enumeration| e.solutions.iter().map(|s| (s.slip.clone(), s.biactive.clone())).collect::<Vec<_>>();
        prop_assert_eq!(supports(&above), supports(&shifted));
    }

    /// Reversing the order of the variables reverses supports and x.
    #[test]
    fn variables_may_be_permuted(p in pencils()) {
        let n = p.order();
        let back: Vec<usize> = (0..n).rev().collect();
        let q = Pencil::new(p.a().submatrix(&back, &back), p.b().submatrix(&back, &back), p.free().iter().map(|i| n - 1 - i).collect()).unwrap();
        let key = |s: &[usize]| s.iter().map(|i| n - 1 - i).rev().collect::<Vec<_>>();
        let mut left: Vec<_> = run(&p).solutions.iter().map(|s| (s.decimal(20), s.slip.clone())).collect();
        let mut right: Vec<_> = run(&q).solutions.iter().map(|s| (s.decimal(20), key(&s.slip))).collect();
        left.sort();
        right.sort();
        prop_assert_eq!(left, right);
    }

    /// Searching a window is filtering the whole.
    #[test]
    fn a_window_filters(p in pencils(), lo in 0i64..4, width in 0i64..6) {
        let (lo, hi) = (rational(lo, 2), rational(lo + width, 2));
        let all = run(&p);
        let inside = enumerate(&p, &Window::new(lo.clone(), Some(hi.clone())).unwrap()).unwrap();
        let filtered: Vec<_> = all.solutions.iter()
            .filter(|s| s.value.clone().cmp_rational(&lo).is_ge() && s.value.clone().cmp_rational(&hi).is_le())
            .map(|s| (s.decimal(20), s.slip.clone())).collect();
        prop_assert_eq!(filtered, inside.solutions.iter().map(|s| (s.decimal(20), s.slip.clone())).collect::<Vec<_>>());
    }

    /// Every problem survives its file, digest included.
    #[test]
    fn files_round_trip(p in pencils(), lambda2 in any::<bool>()) {
        let unknown = if lambda2 { Unknown::Lambda2 } else { Unknown::Mu };
        let problem = Problem::new(Body::Pencil(p), unknown, Window::all()).unwrap().named("a \"name\"");
        let again = read_problem(&write_problem(&problem), Path::new(".")).unwrap();
        prop_assert_eq!(again.sha256(), problem.sha256());
        prop_assert_eq!(again, problem);
    }
}
