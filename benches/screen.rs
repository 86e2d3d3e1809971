//! The screened enumerator: time against n, growth per particle, `plain` beside it where that ends.
//!
//! `RAYON_NUM_THREADS=1 cargo bench --bench screen` prints a table; `-- FAMILY N` runs one size only
//! (families: digits, free, lambda2, zeros, complete). Medians over seeds; ratios are of one run.

use mceip::exact::{Sparse, whole};
use mceip::model::{Pencil, Window};
use mceip::{oracle, search::screen};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::Instant;

/// `peers.md`: entries of A and B uniform in -9..=9. With free variables: A_ff = GG' + I and no
/// free rows in B, as MCEIP-mu has it.
fn digits(slip: usize, free: usize, seed: u64) -> Pencil {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let n = slip + free;
    let mut draw = || -> Vec<Vec<i64>> { (0..n).map(|_| (0..n).map(|_| rng.random_range(-9..=9)).collect()).collect() };
    let (mut a, mut b, g) = (draw(), draw(), draw());
    for i in 0..free {
        b[i].fill(0);
        for j in 0..free {
            a[i][j] = (0..free).map(|k| g[i][k] % 3 * (g[j][k] % 3)).sum::<i64>() + i64::from(i == j);
        }
    }
    let rows = |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(|r| &r[..]).collect::<Vec<_>>());
    Pencil::new(rows(&a), rows(&b), (0..free).collect()).expect("square")
}

/// As MCEIP-lambda2 with four free variables has it: A_ff and B definite, so nothing is condensed.
fn lambda2(slip: usize, seed: u64) -> Pencil {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let n = slip + 4;
    let g: Vec<Vec<i64>> = (0..n).map(|_| (0..n).map(|_| rng.random_range(-2..=2)).collect()).collect();
    let gram = |i: usize, j: usize| (0..n).map(|k| g[i][k] * g[j][k]).sum::<i64>() + i64::from(i == j);
    let mut a = |i: usize, j: usize| if i < 4 && j < 4 { gram(i, j) } else { rng.random_range(-9..=9) };
    let entries =
        |f: &mut dyn FnMut(usize, usize) -> i64| Sparse::from_entries(n, n, (0..n * n).map(|k| (k / n, k % n, whole(f(k / n, k % n)))));
    Pencil::new(entries(&mut a), entries(&mut |i, j| gram(i, j)), (0..4).collect()).expect("square")
}

/// Three quarters zeros: many singular supports, repeated roots, vanishing pivots.
fn zeros(n: usize, seed: u64) -> Pencil {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut matrix =
        || Sparse::from_entries(n, n, (0..n * n).map(|k| (k / n, k % n, whole([0, 0, 0, 1, 0, 0, 0, -1][rng.random_range(0..8)]))));
    Pencil::new(matrix(), matrix(), vec![]).expect("square")
}

/// (C - t I) x = y with C the adjacency matrix: t = k - 1 on each support of size k, 2^n - 1 in all.
fn complete(n: usize) -> Pencil {
    let a = Sparse::from_entries(n, n, (0..n * n).filter(|k| k / n != k % n).map(|k| (k / n, k % n, whole(1))));
    let b = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(-1))));
    Pencil::new(a, b, vec![]).expect("square")
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Median seconds, and the sum over seeds of solutions.
fn measure(family: &str, n: usize, plain: bool) -> (f64, usize, screen::Statistics) {
    let seeds = if family == "complete" { 1 } else { 5 };
    let mut statistics = screen::Statistics::default();
    let (mut seconds, mut solutions) = (Vec::new(), 0);
    for seed in 1..=seeds {
        let pencil = match family {
            "digits" => digits(n, 0, seed),
            "free" => digits(n, 4, seed),
            "lambda2" => lambda2(n, seed),
            "zeros" => zeros(n, seed),
            _ => complete(n),
        };
        let start = Instant::now();
        let found = if plain {
            oracle::enumerate(&pencil, &Window::all()).expect("within limits")
        } else {
            let (found, s) = screen::enumerate(&pencil, &Window::all()).expect("within limits");
            statistics += s;
            found
        };
        seconds.push(start.elapsed().as_secs_f64());
        solutions += found.solutions.len();
    }
    (median(seconds), solutions, statistics)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let families = match &arguments[..] {
        [family, n] => vec![(family.clone(), vec![n.parse().expect("a number")])],
        _ => vec![
            ("digits".into(), vec![6, 8, 10, 12, 14, 16]),
            ("free".into(), vec![8, 10, 12, 14, 16]),
            ("complete".into(), vec![6, 8, 10]),
        ],
    };
    println!("{} thread(s)", rayon::current_num_threads());
    for (family, sizes) in families {
        let mut before: Option<(usize, f64)> = None;
        for n in sizes {
            let (seconds, solutions, statistics) = measure(&family, n, false);
            let growth = before.map_or(String::new(), |(m, s)| format!(", x{:.2} per particle", (seconds / s).powf(1.0 / (n - m) as f64)));
            before = Some((n, seconds));
            let beside = if n <= 8 { format!(", plain {:.3} s", measure(&family, n, true).0) } else { String::new() };
            println!("{family} n_s={n}: {seconds:.4} s, {solutions} solutions{growth}{beside}\n    {statistics}");
        }
    }
}
