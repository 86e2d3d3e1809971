//! The scaling, the way to the candidate and back, and what the starting points promise.

use super::*;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Pencil, Unknown};

/// Variable 1 is free. The diagonals of A are 4, 64, 1/16 and 0: scales 1/2, 1/8, 4 and that of B,
/// 1/4.
fn pencil() -> Pencil {
    let a = sparse(&[
        (0, 0, whole(-4)),
        (1, 1, whole(64)),
        (2, 2, rational(1, 16)),
        (0, 1, whole(3)),
        (1, 0, whole(3)),
        (2, 0, rational(-1, 2)),
    ]);
    let b = sparse(&[
        (0, 0, whole(2)),
        (1, 1, whole(5)),
        (2, 2, whole(1)),
        (3, 3, whole(16)),
    ]);
    Pencil::new(a, b, vec![1]).unwrap()
}

fn sparse(entries: &[(usize, usize, Rational)]) -> Sparse {
    Sparse::from_entries(4, 4, entries.iter().cloned())
}

fn embedding(side: Side) -> Embedding {
    Embedding::new(&Admissible::new(&pencil(), Unknown::Lambda2).unwrap(), side)
}

/// Row i of (A + t B) x of [`pencil`].
fn row_of_pencil(i: usize, t: f64, x: &[f64]) -> f64 {
    let pencil = pencil();
    let mut sum = 0.0;
    for (j, x_j) in x.iter().enumerate() {
        let a = to_f64(&pencil.a().get(i, j));
        let b = to_f64(&pencil.b().get(i, j));
        sum += (a + t * b) * x_j;
    }

    sum
}

fn function_at(embedding: &Embedding, z: &[f64]) -> Vec<f64> {
    let mut f = vec![0.0; 5];
    embedding.function(z, &mut f);
    f
}

/// e'u_s: variable 1 is free.
fn slip_sum(z: &[f64]) -> f64 {
    z[0] + z[2] + z[3]
}

fn assert_close(a: f64, b: f64) {
    approx::assert_relative_eq!(a, b, epsilon = 1e-12, max_relative = 1e-12);
}

#[test]
fn scales_are_powers_of_two_by_the_diagonal() {
    let diagonals = [
        (4.0, 1000.0),
        (-16.0, 0.0),
        (0.0, -64.0),
        (0.0, 0.0),
        (0.25, 1e9),
        (8.0, 0.0),
        (5.0, 0.0),
    ];
    assert_eq!(
        diagonals.map(|(a, b)| scale_of(a, b)),
        [0.5, 0.25, 0.125, 1.0, 2.0, 0.25, 0.5]
    );

    let without_scale = [
        scale_of(f64::INFINITY, 1.0),
        scale_of(f64::NAN, 9.0),
        scale_of(0.0, f64::INFINITY),
    ];
    assert_eq!(without_scale, [1.0; 3]);

    let embedding = embedding(Side::Above(0.0));
    assert_eq!(embedding.diagonal, [0.5, 0.125, 4.0, 0.25]);
}

#[test]
fn a_candidate_and_its_point_are_the_same() {
    for (side, value) in [
        (Side::Above(0.0), 3.0),
        (Side::Above(2.0), 3.0),
        (Side::Below(7.0), 3.0),
        (Side::Below(-1.0), 0.5),
    ] {
        let embedding = embedding(side).with_c(2.5).unwrap();
        let x = [3.0, -7.0, 0.5, 2.0];

        let z = embedding.point(value, &x);
        let back = embedding.candidate(&z);

        assert_close(slip_sum(&z), 2.5);
        assert_close(embedding.gamma(&z), 0.0);
        assert_close(back.value, value);
        for i in 1..4 {
            assert_close(back.x[i] / back.x[0], x[i] / x[0]);
        }
        // y of the MCP is D (A + tB) x by rows.
        let f = function_at(&embedding, &z);
        for i in 0..4 {
            let y_i = row_of_pencil(i, value, &back.x);
            assert_close(f[i], embedding.diagonal[i] * y_i);
        }
    }

    let embedding = embedding(Side::Above(0.0));
    for c in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(embedding.clone().with_c(c).is_none());
    }
}

/// Even at the origin and one beyond it, single particles where their own diagonal vanishes, then
/// random faces.
#[test]
fn starts_are_on_the_simplex_and_where_they_say() {
    for (side, ritz_values) in [
        (Side::Above(0.0), [2.0, 0.0, 0.0]),
        (Side::Above(3.0), [3.0; 3]),
        (Side::Below(1.0), [1.0, -1.0 / 16.0, 0.0]),
    ] {
        let embedding = embedding(side).with_c(2.0).unwrap();

        let starts = embedding.starts(400, 5);

        assert_eq!(starts.len(), 400);
        for z in &starts {
            assert_close(slip_sum(z), 2.0);
            assert!(z[1] == 0.0 && z.iter().all(|u| *u >= 0.0), "{z:?}");
        }

        let values: Vec<f64> = starts
            .iter()
            .map(|z| embedding.candidate(z).value)
            .collect();
        assert_close(values[0], embedding.origin);
        assert_close(values[1], embedding.origin + embedding.direction);
        for even in &starts[..2] {
            for i in [0, 2, 3] {
                assert!((even[i] - 2.0 / 3.0).abs() < 1e-12);
            }
        }
        for (k, i) in [0, 2, 3].into_iter().enumerate() {
            assert_eq!(starts[2 + k][i], 2.0);
            assert_close(values[2 + k], ritz_values[k]);
        }

        assert_faces_are_random(&starts[5..]);

        assert_eq!(embedding.starts(400, 5), starts);
        assert_eq!(embedding.starts(3, 5), starts[..3]);
        assert_ne!(embedding.starts(9, 6)[8], starts[8]);
    }
}

/// Of 395 random starts. A particle is kept with probability 0.2 to 1: three fifths of them; all
/// where none was. None is kept with the mean probability of (1 - keep)^3, 0.128.
fn assert_faces_are_random(starts: &[Vec<f64>]) {
    let weights = starts.iter().flat_map(|z| [z[0], z[2], z[3]]);
    let moving = weights.filter(|u| *u > 0.0).count();
    assert!((700..950).contains(&moving), "{moving} of 1185");

    let is_even = |z: &&Vec<f64>| z[0] == z[2] && z[2] == z[3];
    let even = starts.iter().filter(is_even).count();
    assert!((25..85).contains(&even), "{even} of 395");

    let decades: Vec<f64> = starts.iter().map(|z| z[4].log10()).collect();
    assert!(decades.iter().all(|d| (-3.0..=3.0).contains(d)));
    assert!(decades.iter().any(|d| *d < -2.0));
    assert!(decades.iter().any(|d| *d > 2.0));
}

/// The mean of the powers of some numbers.
fn moment(numbers: &[f64], power: i32) -> f64 {
    numbers.iter().map(|v| v.powi(power)).sum::<f64>() / numbers.len() as f64
}

/// Standard normal numbers, or their cubes; zero in the row of e'u_s.
#[test]
fn directions_are_normal() {
    let embedding = embedding(Side::Above(0.0));

    let numbers: Vec<f64> = (0..10_000)
        .flat_map(|seed| embedding.direction(seed, false)[..4].to_vec())
        .collect();
    let mean = moment(&numbers, 1);
    let variance = moment(&numbers, 2);
    let fourth = moment(&numbers, 4);
    assert!(mean.abs() < 0.025, "{mean}");
    assert!((variance - 1.0).abs() < 0.04, "{variance}");
    assert!((fourth - 3.0).abs() < 0.25, "{fourth}");

    for seed in 0..5 {
        let even = embedding.direction(seed, false);
        let uneven = embedding.direction(seed, true);
        assert_eq!((even.len(), even[4], uneven[4]), (5, 0.0, 0.0));
        for i in 0..4 {
            assert_close(uneven[i], even[i].powi(3));
        }
    }
}

/// F is quadratic: its central differences are the Jacobian but for rounding.
#[test]
fn the_jacobian_is_the_derivative() {
    for side in [Side::Above(2.0), Side::Below(7.0)] {
        let embedding = embedding(side);
        let z = [0.25, -0.75, 0.5, 0.125, 0.625];

        let mut jacobian = DMatrix::zeros(5, 5);
        embedding.jacobian(&z, &mut jacobian);

        for column in 0..5 {
            let mut above = z;
            above[column] += 0.5;
            let mut below = z;
            below[column] -= 0.5;
            let up = function_at(&embedding, &above);
            let down = function_at(&embedding, &below);
            for row in 0..5 {
                assert_close(jacobian[(row, column)], up[row] - down[row]);
            }
        }
    }
}
