//! Sparse linear problems: the same pivots as the dense code, and no dense matrix of all unknowns.
#![cfg(feature = "solver")]

use allocation_counter::measure;
use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{Options, PathEnd, Pivot, Residuals, Termination, solve_linear};
use mceip_mcp::sparse::{CondensedMcp, SparseLinearMcp};
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const INF: f64 = f64::INFINITY;

/// Random entries, a few in each row besides the diagonal; about half of the unknowns free, some
/// with two bounds. `shift` on the diagonal: small ones give secondary rays.
fn random(rng: &mut ChaCha8Rng, n: usize, shift: f64) -> SparseLinearMcp {
    let mut entries: Vec<(usize, usize, f64)> = (0..n)
        .map(|i| (i, i, shift + rng.random_range(0.0..1.0)))
        .collect();
    entries.extend((0..3 * n).map(|_| {
        (
            rng.random_range(0..n),
            rng.random_range(0..n),
            rng.random_range(-1.0..1.0),
        )
    }));
    let q = (0..n).map(|_| rng.random_range(-1.0..1.0)).collect();
    let kind: Vec<u8> = (0..n).map(|_| rng.random_range(0..8)).collect();
    let lower = kind
        .iter()
        .map(|k| if *k < 5 { -INF } else { 0.0 })
        .collect();
    let upper = kind
        .iter()
        .map(|k| if *k == 4 || *k == 7 { 0.5 } else { INF })
        .collect();
    SparseLinearMcp::new(entries, q, lower, upper).unwrap()
}

fn dense(problem: &SparseLinearMcp) -> LinearMcp {
    let n = problem.dimension();
    let mut m = DMatrix::zeros(n, n);
    problem.entries().for_each(|(i, j, v)| m[(i, j)] = v);
    LinearMcp::new(
        m,
        problem.vector().to_vec(),
        problem.lower().to_vec(),
        problem.upper().to_vec(),
    )
    .unwrap()
}

#[test]
fn sparse_and_dense_walk_the_same_pivots() {
    let options = Options {
        preprocess: false,
        ..Options::default()
    };
    let names = |pivots: Vec<&Pivot>| {
        pivots
            .iter()
            .map(|p| (p.entering, p.leaving, p.kind))
            .collect::<Vec<_>>()
    };
    let (mut ends, mut pivots, mut refused) = ([0; 2], 0, 0);
    for seed in 0..200 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let n = rng.random_range(1..40);
        let problem = random(&mut rng, n, [0.0, 1.0, 3.0][seed as usize % 3]);
        let Ok(condensed) = CondensedMcp::new(&problem) else {
            refused += 1;
            continue;
        };
        let (sparse, dense) = (
            condensed.solve_linear(&options).unwrap(),
            solve_linear(&dense(&problem), &options).unwrap(),
        );
        assert_eq!(
            names(sparse.trace().collect()),
            names(dense.trace().collect()),
            "seed {seed}"
        );
        assert_eq!(
            sparse.log[0].paths[0].end, dense.log[0].paths[0].end,
            "seed {seed}"
        );
        assert_eq!(sparse.termination, dense.termination, "seed {seed}");
        pivots += sparse.counters.pivots;
        match sparse.log[0].paths[0].end {
            PathEnd::Complete => {
                ends[0] += 1;
                sparse.point.iter().zip(&dense.point).for_each(|(a, b)| {
                    assert!((a - b).abs() < 1e-8 * (1.0 + b.abs()), "seed {seed}")
                });
            }
            PathEnd::Ray => ends[1] += 1,
            other => panic!("seed {seed}: {other:?}"),
        }
    }
    println!(
        "{pivots} pivots; {} complete, {} rays, {refused} with a singular free block",
        ends[0], ends[1]
    );
    assert!(
        pivots > 500 && ends[0] > 100 && ends[1] > 3 && refused < 20,
        "{pivots} {ends:?} {refused}"
    );
}

#[test]
fn residuals_are_those_of_the_dense_problem() {
    let problem = random(&mut ChaCha8Rng::seed_from_u64(3), 12, 3.0);
    let condensed = CondensedMcp::new(&problem).unwrap();
    let z: Vec<f64> = (0..12)
        .map(|i| problem.lower()[i].clamp(-0.3, 0.4) + 0.01 * i as f64)
        .collect();
    let (ours, theirs) = (condensed.residuals(&z), Residuals::at(&dense(&problem), &z));
    let all = |r: Residuals| {
        [
            r.complementarity,
            r.normal_map,
            r.minimum_map,
            r.fischer,
            r.fischer_gradient,
        ]
    };
    all(ours)
        .iter()
        .zip(all(theirs))
        .for_each(|(a, b)| assert!((a - b).abs() < 1e-13, "{ours:?} {theirs:?}"));
    assert!(all(theirs).iter().all(|r| *r > 1e-3), "{theirs:?}");
}

/// A membrane on a grid of `side` x `side` nodes, pulled down onto an obstacle along its middle
/// line, or with `side * side - side` free unknowns and `side` complementary pairs.
fn membrane(side: usize) -> SparseLinearMcp {
    let at = |i: usize, j: usize| i * side + j;
    let mut entries = Vec::new();
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        entries.push((at(i, j), at(i, j), 4.0));
        let near = [
            (i.wrapping_sub(1), j),
            (i + 1, j),
            (i, j.wrapping_sub(1)),
            (i, j + 1),
        ];
        let near = near.into_iter().filter(|&(a, b)| a < side && b < side);
        entries.extend(near.map(|(a, b)| (at(i, j), at(a, b), -1.0)));
    }
    let load = 8.0 / (side * side) as f64;
    let obstacle = |k: usize| {
        if k / side == side / 2 {
            -0.35 - 0.1 * (k as f64 * 0.37).sin()
        } else {
            -INF
        }
    };
    let n = side * side;
    SparseLinearMcp::new(
        entries,
        vec![load; n],
        (0..n).map(obstacle).collect(),
        vec![INF; n],
    )
    .unwrap()
}

#[test]
fn a_large_problem_is_solved_without_a_dense_matrix() {
    let side = 142; // 20,164 unknowns, 142 of them bounded
    let mut solved = None;
    let info = measure(|| {
        let problem = membrane(side);
        let condensed = CondensedMcp::new(&problem).unwrap();
        assert_eq!(
            (problem.dimension(), condensed.bounded().len()),
            (20_164, 142)
        );
        let outcome = condensed.solve_linear(&Options::default()).unwrap();
        let start = vec![0.0; problem.dimension()];
        let other = condensed.solve(&start, &Options::default()).unwrap();
        solved = Some((problem, outcome, other));
    });
    let (problem, outcome, other) = solved.unwrap();
    println!(
        "{} pivots; at most {} MB at once",
        outcome.counters.pivots,
        info.bytes_max / 1_000_000
    );
    // A dense matrix would take 3253 MB.
    assert!(info.bytes_max < 200_000_000, "{}", info.bytes_max);
    for outcome in [&outcome, &other] {
        assert_eq!(
            outcome.termination,
            Termination::ToleranceReached,
            "{:?}",
            outcome.residuals
        );
    }
    // Every line of the definition, by the sparse matrix alone.
    let f = problem.value(&outcome.point);
    let mut touching = 0;
    for (i, (z, f)) in outcome.point.iter().zip(&f).enumerate() {
        let lower = problem.lower()[i];
        assert!(
            *z >= lower && (*f >= -1e-10) && (f.abs() < 1e-10 || *z <= lower + 1e-12),
            "{i}: {z} {f}"
        );
        touching += usize::from(*z == lower);
    }
    assert!(touching > 5 && touching < 142, "{touching}");
    outcome
        .point
        .iter()
        .zip(&other.point)
        .for_each(|(a, b)| assert!((a - b).abs() < 1e-9));
}
