//! Sparse linear problems: the same pivots as the dense code, and no dense matrix of all unknowns.
//!
//! The truth is the dense solver on 200 random problems, pivot by pivot, and an allocator that
//! counts bytes on a problem whose dense matrix would take 3 GB. Its solution is held against the
//! definition by the sparse matrix alone.
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
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    for i in 0..n {
        entries.push((i, i, shift + rng.random_range(0.0..1.0)));
    }

    for _ in 0..3 * n {
        let row = rng.random_range(0..n);
        let column = rng.random_range(0..n);
        let value = rng.random_range(-1.0..1.0);
        entries.push((row, column, value));
    }

    let q = (0..n).map(|_| rng.random_range(-1.0..1.0)).collect();

    // Kinds 0 to 3 are free, 4 has an upper bound, 5 and 6 a lower one, 7 both.
    let mut lower = Vec::new();
    let mut upper = Vec::new();

    for _ in 0..n {
        let kind: u8 = rng.random_range(0..8);
        lower.push(if kind < 5 { -INF } else { 0.0 });
        upper.push(if kind == 4 || kind == 7 { 0.5 } else { INF });
    }
    SparseLinearMcp::new(entries, q, lower, upper).unwrap()
}

fn dense(problem: &SparseLinearMcp) -> LinearMcp {
    let n = problem.dimension();
    let mut matrix = DMatrix::zeros(n, n);

    for (i, j, value) in problem.entries() {
        matrix[(i, j)] = value;
    }

    let q = problem.vector().to_vec();
    let lower = problem.lower().to_vec();
    let upper = problem.upper().to_vec();

    LinearMcp::new(matrix, q, lower, upper).unwrap()
}

/// The same variables enter and leave, by pivots of the same kinds.
#[track_caller]
fn same_pivots(ours: &[&Pivot], theirs: &[&Pivot], seed: u64) {
    assert_eq!(ours.len(), theirs.len(), "seed {seed}");
    for (a, b) in ours.iter().zip(theirs) {
        assert_eq!(a.entering, b.entering, "seed {seed}");
        assert_eq!(a.leaving, b.leaving, "seed {seed}");
        assert_eq!(a.kind, b.kind, "seed {seed}");
    }
}

#[test]
fn sparse_and_dense_walk_the_same_pivots() {
    let options = Options {
        preprocess: false,
        ..Options::default()
    };
    let mut complete = 0;
    let mut rays = 0;
    let mut pivots = 0;
    let mut refused = 0;

    for seed in 0..200 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let n = rng.random_range(1..40);
        let shift = [0.0, 1.0, 3.0][seed as usize % 3];
        let problem = random(&mut rng, n, shift);
        let Ok(condensed) = CondensedMcp::new(&problem) else {
            refused += 1;
            continue;
        };

        let sparse = condensed.solve_linear(&options).unwrap();
        let dense = solve_linear(&dense(&problem), &options).unwrap();

        let end = sparse.log[0].paths[0].end;
        let sparse_pivots: Vec<&Pivot> = sparse.trace().collect();
        let dense_pivots: Vec<&Pivot> = dense.trace().collect();
        same_pivots(&sparse_pivots, &dense_pivots, seed);

        assert_eq!(end, dense.log[0].paths[0].end, "seed {seed}");
        assert_eq!(sparse.termination, dense.termination, "seed {seed}");

        pivots += sparse.counters.pivots;
        match end {
            PathEnd::Complete => {
                complete += 1;
                for (ours, theirs) in sparse.point.iter().zip(&dense.point) {
                    let tolerance = 1e-8 * (1.0 + theirs.abs());
                    assert!((ours - theirs).abs() < tolerance, "seed {seed}");
                }
            }
            PathEnd::Ray => rays += 1,
            other => panic!("seed {seed}: {other:?}"),
        }
    }

    println!(
        "{pivots} pivots; {complete} complete, {rays} rays, {refused} with a singular free block"
    );

    assert!(pivots > 500, "{pivots}");
    assert!(complete > 100, "{complete}");
    assert!(rays > 3, "{rays}");
    assert!(refused < 20, "{refused}");
}

/// The five measures of a residual.
fn measures(residuals: &Residuals) -> [f64; 5] {
    [
        residuals.complementarity,
        residuals.normal_map,
        residuals.minimum_map,
        residuals.fischer,
        residuals.fischer_gradient,
    ]
}

#[test]
fn residuals_are_those_of_the_dense_problem() {
    let problem = random(&mut ChaCha8Rng::seed_from_u64(3), 12, 3.0);
    let condensed = CondensedMcp::new(&problem).unwrap();
    let z: Vec<f64> = (0..12)
        .map(|i| problem.lower()[i].clamp(-0.3, 0.4) + 0.01 * i as f64)
        .collect();

    let ours = measures(&condensed.residuals(&z));
    let theirs = measures(&Residuals::at(&dense(&problem), &z));

    for (a, b) in ours.iter().zip(&theirs) {
        assert!((a - b).abs() < 1e-13, "{ours:?} {theirs:?}");
    }

    assert!(theirs.iter().all(|value| *value > 1e-3), "{theirs:?}");
}

/// A membrane on a grid of `side` x `side` nodes, pulled down onto an obstacle along its middle
/// line: `side * side - side` free unknowns and `side` complementary pairs.
fn membrane(side: usize) -> SparseLinearMcp {
    let n = side * side;

    let mut entries = Vec::new();
    for node in 0..n {
        entries.push((node, node, 4.0));
        for neighbour in neighbours(node, side) {
            entries.push((node, neighbour, -1.0));
        }
    }

    let mut lower = vec![-INF; n];
    for column in 0..side {
        let node = side / 2 * side + column;
        lower[node] = -0.35 - 0.1 * (node as f64 * 0.37).sin();
    }

    let load = 8.0 / n as f64;
    SparseLinearMcp::new(entries, vec![load; n], lower, vec![INF; n]).unwrap()
}

/// The nodes above, below, to the left and to the right of a node that are on the grid.
fn neighbours(node: usize, side: usize) -> Vec<usize> {
    let row = node / side;
    let column = node % side;
    let mut list = Vec::new();

    if row > 0 {
        list.push(node - side);
    }

    if row + 1 < side {
        list.push(node + side);
    }

    if column > 0 {
        list.push(node - 1);
    }

    if column + 1 < side {
        list.push(node + 1);
    }
    list
}

#[test]
fn a_large_problem_is_solved_without_a_dense_matrix() {
    let mut solved = None;
    let allocated = measure(|| {
        let problem = membrane(142);
        let condensed = CondensedMcp::new(&problem).unwrap();
        assert_eq!(problem.dimension(), 20_164);
        assert_eq!(condensed.bounded().len(), 142);

        let linear = condensed.solve_linear(&Options::default()).unwrap();
        let start = vec![0.0; problem.dimension()];
        let general = condensed.solve(&start, &Options::default()).unwrap();
        solved = Some((problem, linear, general));
    });
    let (problem, linear, general) = solved.unwrap();

    // A dense matrix would take 3253 MB.
    let megabytes = allocated.bytes_max / 1_000_000;
    println!(
        "{} pivots; at most {megabytes} MB at once",
        linear.counters.pivots
    );

    assert!(allocated.bytes_max < 200_000_000, "{}", allocated.bytes_max);

    for outcome in [&linear, &general] {
        assert_eq!(
            outcome.termination,
            Termination::ToleranceReached,
            "{:?}",
            outcome.residuals
        );
    }

    // Every line of the definition, by the sparse matrix alone.
    let mut touching = 0;
    let values = problem.value(&linear.point);

    for (i, &f) in values.iter().enumerate() {
        let z = linear.point[i];
        let lower = problem.lower()[i];
        assert!(z >= lower, "{i}: {z}");
        assert!(f >= -1e-10, "{i}: {f}");
        assert!(f.abs() < 1e-10 || z <= lower + 1e-12, "{i}: {z} {f}");
        touching += usize::from(z == lower);
    }

    assert!(touching > 5 && touching < 142, "{touching}");

    for (a, b) in linear.point.iter().zip(&general.point) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}
