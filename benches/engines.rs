//! Benchmarks: enumerator against n, solver against n, condensation. Ratios, not absolute times,
//! are what to quote; `cargo bench` prints both.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use mceip_engine::reduction::{Embedding, Side, condense, reduce};
use mceip_exact::{Sparse, whole};
use mceip_mcp::solver::{Options, Solver, solve};
use mceip_model::{Admissible, Pencil, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_paper::{Block, BlockModel, MassKind, PublishedState};
use std::hint::black_box;

/// -(adjacency of the complete graph) + t I: every support has a solution, 2^n - 1 in all.
fn complete_graph(n: usize) -> Pencil {
    let entry = |i: usize, j: usize| whole(if i == j { -1 } else { 0 });
    let a = Sparse::from_entries(
        n,
        n,
        (0..n * n).map(|k| (k / n, k % n, whole(i64::from(k / n != k % n)))),
    );
    let b = Sparse::from_entries(
        n,
        n,
        (0..n * n).map(|k| (k / n, k % n, entry(k / n, k % n))),
    );
    // (A - t I) x = y with A the adjacency matrix: t = k - 1 on each support of size k.
    Pencil::new(a, b, vec![]).expect("square")
}

/// A pencil with random one-digit integers, no free variables (the family that FLINT was timed on).
fn one_digit(n: usize) -> Pencil {
    let mut state = 42u64;
    let mut digit = move || {
        // Knuth's linear congruential generator, high bits.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        whole((state >> 40) as i64 % 19 - 9)
    };
    let mut matrix = || {
        Sparse::from_entries(
            n,
            n,
            (0..n * n)
                .map(|k| (k / n, k % n, digit()))
                .collect::<Vec<_>>(),
        )
    };
    Pencil::new(matrix(), matrix(), vec![]).expect("square")
}

/// A chain of particles: A = tridiag(-1, -3, -1) + t I, admissible for lambda^2.
fn chain(n: usize) -> Pencil {
    let band = |k: usize| match (k / n).abs_diff(k % n) {
        0 => -3,
        1 => -1,
        _ => 0,
    };
    let a = Sparse::from_entries(n, n, (0..n * n).map(|k| (k / n, k % n, whole(band(k)))));
    Pencil::new(a, Sparse::identity(n), vec![]).expect("square")
}

fn engines(c: &mut Criterion) {
    let mut group = c.benchmark_group("enumerator");
    group.sample_size(10);
    for n in [2, 4, 6, 8] {
        let pencil = complete_graph(n);
        group.bench_with_input(BenchmarkId::from_parameter(n), &pencil, |b, p| {
            b.iter(|| enumerate(black_box(p), &Window::all()))
        });
    }
    group.finish();
    let mut group = c.benchmark_group("enumerator, one-digit pencils");
    group.sample_size(10);
    for n in [6, 8, 10] {
        let pencil = one_digit(n);
        group.bench_with_input(BenchmarkId::from_parameter(n), &pencil, |b, p| {
            b.iter(|| enumerate(black_box(p), &Window::all()))
        });
    }
    group.finish();
    let mut group = c.benchmark_group("solver, first start");
    for n in [2, 5, 10, 20] {
        let pencil = chain(n);
        let embedding = Embedding::new(
            &Admissible::new(&pencil, Unknown::Lambda2).expect("definite"),
            Side::Above(0.0),
        );
        let start = embedding.starts(1, 1).remove(0);
        group.bench_with_input(BenchmarkId::from_parameter(n), &start, |b, s| {
            b.iter(|| solve(&embedding, black_box(s), &Options::default()))
        });
        let mut solver = Solver::new();
        group.bench_with_input(BenchmarkId::new("storage kept", n), &start, |b, s| {
            b.iter(|| solver.run(&embedding, black_box(s), &Options::default()))
        });
    }
    group.finish();
    let mut group = c.benchmark_group("condensation, exact");
    group.sample_size(10);
    for (nx, ny) in [(4, 2), (8, 4), (20, 10)] {
        let block = Block::new(&BlockModel {
            cells: (nx, ny),
            mass: MassKind::Lumped,
            ..BlockModel::of_the_paper()
        })
        .expect("cells");
        let states = vec![mceip_model::ContactState::Slip { sign: 1 }; nx + 1];
        let states = if nx == 20 {
            PublishedState::SeventeenSlip.states()
        } else {
            states
        };
        let problem = mceip_model::Problem::new(
            mceip_model::Body::System(block.system(&states, None).expect("block")),
            Unknown::Mu,
            Window::all(),
        );
        let pencil = reduce(&problem.expect("block")).expect("block").pencil;
        group.bench_with_input(
            BenchmarkId::new("dofs", block.stiffness.rows()),
            &pencil,
            |b, p| {
                b.iter(|| condense(&Admissible::new(p, Unknown::Mu).expect("definite")));
            },
        );
    }
    group.finish();
}

criterion_group!(benches, engines);
criterion_main!(benches);
