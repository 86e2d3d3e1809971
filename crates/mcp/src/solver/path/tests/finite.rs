//! The finiteness theorem of the lexicographic rule, held against the pivoting code itself run over
//! exact rationals: from a ray no basis comes twice, and a path ends complete or on a ray
//! (Cottle, Pang and Stone 1992, section 4.9; Eaves 1971).

use super::super::super::normal_map::least_residual;
use super::super::super::number::Number;
use super::exact::Exact;
use super::*;
use num_traits::Zero;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::HashSet;

/// An integer problem: M, q, and bounds with `None` for infinite.
struct Case {
    m: DMatrix<i64>,
    q: DVector<i64>,
    lower: Vec<Option<i64>>,
    upper: Vec<Option<i64>>,
}

const LIMITS: Limits = Limits {
    pivots: 5000,
    cycle_entries: usize::MAX,
    rule: RatioTest::Lexicographic,
};

/// Small integers, many of them zero or equal: ties in nearly every ratio test.
fn degenerate(rng: &mut ChaCha8Rng, bounded: bool) -> Case {
    let n = rng.random_range(1..=6);
    let span = rng.random_range(1..=2);
    let m = DMatrix::from_fn(n, n, |_, _| rng.random_range(-span..=span));
    let q = DVector::from_fn(n, |_, _| rng.random_range(-1..=1));
    let kind: Vec<u8> = (0..n)
        .map(|_| if bounded { rng.random_range(0..5) } else { 0 })
        .collect();
    let lower = kind.iter().map(|k| (*k != 3).then_some(0)).collect();
    let upper = kind.iter().map(|k| match k {
        1 => Some(1),
        2 => Some(0),
        3 => Some(2),
        _ => None,
    });
    Case {
        m,
        q,
        lower,
        upper: upper.collect(),
    }
}

impl Case {
    fn exact(&self) -> (DMatrix<Exact>, DVector<Exact>, Vec<Exact>, Vec<Exact>) {
        let bound = |b: &Option<i64>, none: Exact| b.map_or(none, Exact::integer);
        let lower = self
            .lower
            .iter()
            .map(|b| bound(b, -Exact::infinity()))
            .collect();
        let upper = self
            .upper
            .iter()
            .map(|b| bound(b, Exact::infinity()))
            .collect();
        (
            self.m.map(Exact::integer),
            self.q.map(Exact::integer),
            lower,
            upper,
        )
    }

    fn follow_exactly(&self) -> Path<Exact> {
        let (m, q, lower, upper) = self.exact();
        let sub = Subproblem {
            m: &m,
            q: q.as_slice(),
            lower: &lower,
            upper: &upper,
        };
        walked(&sub, Start::Ray, &vec![Exact::zero(); q.len()], LIMITS)
    }

    fn follow_in_doubles(&self, rule: RatioTest) -> Path {
        let bound = |b: &Option<i64>, none: f64| b.map_or(none, |v| v as f64);
        let lower: Vec<f64> = self
            .lower
            .iter()
            .map(|b| bound(b, f64::NEG_INFINITY))
            .collect();
        let upper: Vec<f64> = self.upper.iter().map(|b| bound(b, f64::INFINITY)).collect();
        let m = self.m.map(|v| v as f64);
        let q = self.q.map(|v| v as f64);
        let sub = Subproblem {
            m: &m,
            q: q.as_slice(),
            lower: &lower,
            upper: &upper,
        };
        walked(
            &sub,
            Start::Ray,
            &vec![0.0; q.len()],
            Limits { rule, ..LIMITS },
        )
    }

    /// The least residual of the normal map, with bounds overstepped counted as residual.
    fn residual_in_doubles(&self, z: &[f64]) -> f64 {
        let f = self.m.map(|v| v as f64) * DVector::from_column_slice(z) + self.q.map(|v| v as f64);
        let residual = |i: usize| {
            let l = self.lower[i].map_or(f64::NEG_INFINITY, |v| v as f64);
            let u = self.upper[i].map_or(f64::INFINITY, |v| v as f64);
            let nearest = z[i].max(l).min(u);
            let bound = [l, u].into_iter().find(|b| (b - z[i]).abs() < 1e-8);
            let snapped = bound.unwrap_or(nearest);
            let overstepped = (z[i] - nearest).abs();
            least_residual(snapped, f[i], l, u).abs().max(overstepped)
        };
        (0..z.len()).map(residual).fold(0.0, f64::max)
    }

    /// Every line of the definition, exactly.
    fn is_solved_by(&self, z: &[Exact]) -> bool {
        let (m, q, lower, upper) = self.exact();
        let f = m * DVector::from_column_slice(z) + q;
        (0..z.len()).all(|i| {
            let inside = z[i] >= lower[i] && z[i] <= upper[i];
            inside
                && (f[i] <= Exact::zero() || z[i] == lower[i])
                && (f[i] >= Exact::zero() || z[i] == upper[i])
        })
    }
}

/// The sets of basic unknowns along a path from a ray, replayed from its pivots.
fn bases(path: &Path<Exact>, case: &Case) -> Vec<Vec<Variable>> {
    let n = case.q.len();
    let mut basis: Vec<Variable> = (0..n)
        .map(|i| {
            if case.lower[i].is_some() {
                Variable::W(i)
            } else {
                Variable::V(i)
            }
        })
        .collect();
    let mut seen = Vec::new();

    for pivot in &path.pivots {
        if pivot.kind == PivotKind::Exchange {
            let place = basis
                .iter()
                .position(|v| *v == pivot.leaving)
                .expect("a basic unknown leaves");
            basis[place] = pivot.entering;
        }

        let mut key = basis.clone();
        key.push(pivot.leaving); // a flip keeps the basis and changes the side
        key[..n].sort_by_key(|v| format!("{v:?}"));
        seen.push(key);
    }

    seen
}

#[test]
fn from_a_ray_no_basis_comes_twice_and_the_end_is_complete_or_a_ray() {
    let mut ties = 0;
    let mut ends = [0; 2];
    for seed in 0..3000 {
        let case = degenerate(&mut ChaCha8Rng::seed_from_u64(seed), seed % 2 == 1);
        let path = case.follow_exactly();
        let bases = bases(&path, &case);
        let distinct: HashSet<_> = bases.iter().collect();

        assert_eq!(
            distinct.len(),
            bases.len(),
            "seed {seed}: a basis came twice"
        );

        // Steps of length zero: the degenerate pivots in which a careless rule cycles.
        ties += knots(&path)
            .windows(2)
            .filter(|w| w[0].t == w[1].t && w[0].z == w[1].z && w[0].multiplier == w[1].multiplier)
            .count();
        match path.end {
            PathEnd::Complete => {
                ends[0] += 1;
                assert!(case.is_solved_by(path.last().unwrap()), "seed {seed}");
            }
            PathEnd::Ray => ends[1] += 1,
            other => panic!("seed {seed}: {other:?}"),
        }
    }

    println!(
        "{ties} degenerate pivots; {} complete, {} rays",
        ends[0], ends[1]
    );

    assert!(ties > 500, "{ties} {ends:?}");
    assert!(ends[0] > 500, "{ties} {ends:?}");
    assert!(ends[1] > 100, "{ties} {ends:?}");
}

#[test]
fn doubles_walk_the_exact_path_and_expand_ends_where_it_may() {
    let mut same = 0;
    let mut solved = [0; 2];
    for seed in 0..600 {
        let case = degenerate(&mut ChaCha8Rng::seed_from_u64(10_000 + seed), seed % 2 == 1);
        let exact = case.follow_exactly();
        let doubles = case.follow_in_doubles(RatioTest::Lexicographic);

        assert_eq!(exact.end, doubles.end, "seed {seed}");

        let names = |pivots: &[Pivot]| {
            pivots
                .iter()
                .map(|p| (p.entering, p.leaving, p.kind))
                .collect::<Vec<_>>()
        };
        same += usize::from(names(&exact.pivots) == names(&doubles.pivots));
        let expand = case.follow_in_doubles(RatioTest::Expand);
        solved[0] += usize::from(exact.end == PathEnd::Complete);

        if expand.end == PathEnd::Complete {
            solved[1] += 1;
            assert!(
                case.residual_in_doubles(expand.last().unwrap()) < 1e-8,
                "seed {seed}"
            );
        }
    }

    println!(
        "{same} of 600 paths pivot for pivot alike; complete: lexicographic {}, EXPAND {}",
        solved[0], solved[1]
    );

    assert_eq!(same, 600);
    assert!(solved[1] * 10 >= solved[0] * 9, "{solved:?}");
}
