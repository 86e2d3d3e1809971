//! Benchmarks: enumerator against n, solver against n, condensation. Ratios, not absolute times,
//! are what to quote; `cargo bench` prints both.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use mceip_engine::reduction::{Embedding, Side, condense};
use mceip_exact::{Sparse, whole};
use mceip_mcp::solver::{Options, Solver, solve};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, ContactState, Pencil, Problem, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_paper::{Block, BlockModel, MassKind, PublishedState};
use std::hint::black_box;

/// A square matrix with these integer entries.
fn matrix(order: usize, mut entry: impl FnMut(usize, usize) -> i64) -> Sparse {
    let mut entries = Vec::with_capacity(order * order);
    for i in 0..order {
        for j in 0..order {
            entries.push((i, j, whole(entry(i, j))));
        }
    }
    Sparse::from_entries(order, order, entries)
}

/// A - t I, A the adjacency matrix of the complete graph. Every support has a solution, t = k - 1
/// on each of size k: 2^n - 1 in all.
fn complete_graph(n: usize) -> Pencil {
    let a = matrix(n, |i, j| i64::from(i != j));
    let b = matrix(n, |i, j| if i == j { -1 } else { 0 });
    Pencil::new(a, b, vec![]).expect("square")
}

/// A pencil with random one-digit integers, no free variables (the family that FLINT was timed on).
fn one_digit(n: usize) -> Pencil {
    let mut state = 42u64;
    let a = matrix(n, |_, _| next_digit(&mut state));
    let b = matrix(n, |_, _| next_digit(&mut state));

    Pencil::new(a, b, vec![]).expect("square")
}

/// From -9 to 9, by Knuth's linear congruential generator (its high bits).
fn next_digit(state: &mut u64) -> i64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as i64 % 19 - 9
}

/// A chain of particles: A = tridiag(-1, -3, -1) + t I, admissible for lambda^2.
fn chain(n: usize) -> Pencil {
    let a = matrix(n, |i, j| match i.abs_diff(j) {
        0 => -3,
        1 => -1,
        _ => 0,
    });

    Pencil::new(a, Sparse::identity(n), vec![]).expect("square")
}

fn engines(c: &mut Criterion) {
    enumerator(c);
    solver(c);
    condensation(c);
}

fn enumerator(c: &mut Criterion) {
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
}

fn solver(c: &mut Criterion) {
    let mut group = c.benchmark_group("solver, first start");
    for n in [2, 5, 10, 20] {
        let pencil = chain(n);
        let admissible = Admissible::new(&pencil, Unknown::Lambda2).expect("definite");
        let embedding = Embedding::new(&admissible, Side::Above(0.0));
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
}

fn condensation(c: &mut Criterion) {
    let mut group = c.benchmark_group("condensation, exact");
    group.sample_size(10);

    for cells in [(4, 2), (8, 4), (20, 10)] {
        let block = Block::new(&BlockModel {
            cells,
            mass: MassKind::Lumped,
            ..BlockModel::of_the_paper()
        })
        .expect("cells");
        let pencil = pencil_of(&block);

        let dofs = block.stiffness.rows();
        group.bench_with_input(BenchmarkId::new("dofs", dofs), &pencil, |b, p| {
            b.iter(|| condense(&Admissible::new(p, Unknown::Mu).expect("definite")));
        });
    }

    group.finish();
}

/// The MCEIP-mu pencil: on the paper's mesh with 17 slip nodes, on others with slip at every node.
fn pencil_of(block: &Block) -> Pencil {
    let nodes = block.contact.len();
    let states = if nodes == 21 {
        PublishedState::SeventeenSlip.states()
    } else {
        vec![ContactState::Slip { sign: 1 }; nodes]
    };

    let system = block.system(&states, None).expect("block");
    let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all()).expect("block");
    reduce(&problem).expect("block").pencil
}

criterion_group!(benches, engines);
criterion_main!(benches);
