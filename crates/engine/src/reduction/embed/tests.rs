//! The scaling, the way to the candidate and back, and what the starting points promise.

use super::*;
use mceip_exact::{Sparse, rational};
use mceip_model::{Pencil, Unknown};

/// Variable 1 is free. The diagonals of A are 4, 64, 1/16 and 0: scales 1/2, 1/8, 4 and that of B,
/// 1/4.
fn pencil() -> Pencil {
    let entries = |list: &[(usize, usize, i64, i64)]| {
        Sparse::from_entries(
            4,
            4,
            list.iter()
                .map(|&(i, j, p, q)| (i, j, rational(p, q)))
                .collect::<Vec<_>>(),
        )
    };
    let a = entries(&[
        (0, 0, -4, 1),
        (1, 1, 64, 1),
        (2, 2, 1, 16),
        (0, 1, 3, 1),
        (1, 0, 3, 1),
        (2, 0, -1, 2),
    ]);
    let b = entries(&[(0, 0, 2, 1), (1, 1, 5, 1), (2, 2, 1, 1), (3, 3, 16, 1)]);
    Pencil::new(a, b, vec![1]).unwrap()
}

fn embedding(side: Side) -> Embedding {
    Embedding::new(&Admissible::new(&pencil(), Unknown::Lambda2).unwrap(), side)
}

fn close(a: f64, b: f64) {
    approx::assert_relative_eq!(a, b, epsilon = 1e-12, max_relative = 1e-12);
}

#[test]
fn scales_are_powers_of_two_by_the_diagonal() {
    let list = [
        (4.0, 1000.0),
        (-16.0, 0.0),
        (0.0, -64.0),
        (0.0, 0.0),
        (0.25, 1e9),
        (8.0, 0.0),
        (5.0, 0.0),
    ];
    assert_eq!(
        list.map(|(a, b)| scale_of(a, b)),
        [0.5, 0.25, 0.125, 1.0, 2.0, 0.25, 0.5]
    );
    assert_eq!(
        [
            scale_of(f64::INFINITY, 1.0),
            scale_of(f64::NAN, 9.0),
            scale_of(0.0, f64::INFINITY)
        ],
        [1.0; 3]
    );
    assert_eq!(
        embedding(Side::Above(0.0)).diagonal,
        [0.5, 0.125, 4.0, 0.25]
    );
}

#[test]
fn a_candidate_and_its_point_are_the_same() {
    for (side, value) in [
        (Side::Above(0.0), 3.0),
        (Side::Above(2.0), 3.0),
        (Side::Below(7.0), 3.0),
        (Side::Below(-1.0), 0.5),
    ] {
        let e = embedding(side).with_c(2.5).unwrap();
        let x = [3.0, -7.0, 0.5, 2.0];
        let z = e.point(value, &x);
        close(z[0] + z[2] + z[3], 2.5);
        close(e.gamma(&z), 0.0);
        let back = e.candidate(&z);
        close(back.value, value);
        (1..4).for_each(|i| close(back.x[i] / back.x[0], x[i] / x[0]));
        // y of the MCP is D (A + tB) x by rows.
        let mut f = [0.0; 5];
        e.function(&z, &mut f);
        let p = pencil();
        for i in 0..4 {
            let y: f64 = (0..4)
                .map(|j| (to_f64(&p.a().get(i, j)) + value * to_f64(&p.b().get(i, j))) * back.x[j])
                .sum();
            close(f[i], e.diagonal[i] * y);
        }
    }
    let e = embedding(Side::Above(0.0));
    assert!(
        [0.0, -1.0, f64::NAN, f64::INFINITY]
            .into_iter()
            .all(|c| e.clone().with_c(c).is_none())
    );
}

/// Even at the origin and one beyond it, single particles where their own diagonal vanishes, then
/// random faces.
#[test]
fn starts_are_on_the_simplex_and_where_they_say() {
    for (side, own) in [
        (Side::Above(0.0), [2.0, 0.0, 0.0]),
        (Side::Above(3.0), [3.0; 3]),
        (Side::Below(1.0), [1.0, -1.0 / 16.0, 0.0]),
    ] {
        let e = embedding(side).with_c(2.0).unwrap();
        let origin = e.origin;
        let starts = e.starts(400, 5);
        assert_eq!(starts.len(), 400);
        for z in &starts {
            close(z[0] + z[2] + z[3], 2.0);
            assert!(z[1] == 0.0 && z.iter().all(|u| *u >= 0.0), "{z:?}");
        }
        let value = |k: usize| e.candidate(&starts[k]).value;
        close(value(0), origin);
        close(value(1), origin + e.direction);
        assert!([0, 1].iter().all(|&k: &usize| {
            [0, 2, 3]
                .iter()
                .all(|&i| (starts[k][i] - 2.0 / 3.0).abs() < 1e-12)
        }));
        for (k, i) in [0, 2, 3].into_iter().enumerate() {
            assert_eq!(starts[2 + k][i], 2.0);
            close(value(2 + k), own[k]);
        }
        // A particle is kept with probability 0.2 to 1: three fifths of them; all where none was.
        let moving = starts[5..]
            .iter()
            .flat_map(|z| [z[0], z[2], z[3]])
            .filter(|u| *u > 0.0)
            .count();
        let even = starts[5..]
            .iter()
            .filter(|z| z[0] == z[2] && z[2] == z[3])
            .count();
        // None kept: the mean of (1 - keep)^3, 0.128.
        assert!(
            (700..950).contains(&moving) && (25..85).contains(&even),
            "{moving} of 1185, {even} of 395"
        );
        let decades: Vec<f64> = starts[5..].iter().map(|z| z[4].log10()).collect();
        assert!(
            decades.iter().all(|d| (-3.0..=3.0).contains(d))
                && decades.iter().any(|d| *d < -2.0)
                && decades.iter().any(|d| *d > 2.0)
        );
        assert_eq!(e.starts(400, 5), starts);
        assert_eq!(e.starts(3, 5), starts[..3]);
        assert_ne!(e.starts(9, 6)[8], starts[8]);
    }
}

/// Standard normal numbers, or their cubes; zero in the row of e'u_s.
#[test]
fn directions_are_normal() {
    let e = embedding(Side::Above(0.0));
    let list: Vec<f64> = (0..10_000)
        .flat_map(|seed| e.direction(seed, false)[..4].to_vec())
        .collect();
    let moment = |k: i32| list.iter().map(|v| v.powi(k)).sum::<f64>() / list.len() as f64;
    assert!(
        moment(1).abs() < 0.025 && (moment(2) - 1.0).abs() < 0.04 && (moment(4) - 3.0).abs() < 0.25,
        "{} {} {}",
        moment(1),
        moment(2),
        moment(4)
    );
    for seed in 0..5 {
        let (even, uneven) = (e.direction(seed, false), e.direction(seed, true));
        assert_eq!((even.len(), even[4], uneven[4]), (5, 0.0, 0.0));
        (0..4).for_each(|i| close(uneven[i], even[i].powi(3)));
    }
}

/// F is quadratic: its central differences are the Jacobian but for rounding.
#[test]
fn the_jacobian_is_the_derivative() {
    for side in [Side::Above(2.0), Side::Below(7.0)] {
        let e = embedding(side);
        let z = [0.25, -0.75, 0.5, 0.125, 0.625];
        let mut j = DMatrix::zeros(5, 5);
        e.jacobian(&z, &mut j);
        for k in 0..5 {
            let at = |h: f64| {
                let mut moved = z;
                moved[k] += h;
                let mut f = [0.0; 5];
                e.function(&moved, &mut f);
                f
            };
            let (up, down) = (at(0.5), at(-0.5));
            (0..5).for_each(|i| close(j[(i, k)], up[i] - down[i]));
        }
    }
}
