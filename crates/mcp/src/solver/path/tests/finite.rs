//! The finiteness theorem of the lexicographic rule, held against the pivoting code itself run over
//! exact rationals: from a ray no basis comes twice, and a path ends complete or on a ray
//! (Cottle, Pang and Stone 1992, section 4.9; Eaves 1971).

use super::super::super::normal_map::least_residual;
use super::super::super::number::PathNumber;
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

const LIMITS: PathLimits = PathLimits {
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
            PathLimits { rule, ..LIMITS },
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
            let is_within = z[i] >= lower[i] && z[i] <= upper[i];
            let not_positive = f[i] <= Exact::zero() || z[i] == lower[i];
            let not_negative = f[i] >= Exact::zero() || z[i] == upper[i];
            is_within && not_positive && not_negative
        })
    }
}

/// The sets of basic unknowns along a path from a ray, replayed from its pivots.
fn bases(path: &Path<Exact>, case: &Case) -> Vec<Vec<Variable>> {
    let n = case.q.len();
    let mut basis = Vec::new();
    for i in 0..n {
        let is_bounded_below = case.lower[i].is_some();
        basis.push(if is_bounded_below {
            Variable::W(i)
        } else {
            Variable::V(i)
        });
    }

    let mut seen = Vec::new();

    for pivot in &path.pivots {
        if pivot.kind == PivotKind::Exchange {
            let place = basis
                .iter()
                .position(|v| *v == pivot.leaving)
                .expect("a basic unknown leaves");
            basis[place] = pivot.entering;
        }

        // A flip keeps the basis and changes the side.
        let mut key = basis.clone();
        key.push(pivot.leaving);
        key[..n].sort_by_key(|v| format!("{v:?}"));
        seen.push(key);
    }

    seen
}

/// Are two knots in a row the same point?
fn is_tie(pair: &[Knot<Exact>]) -> bool {
    let [a, b] = pair else { return false };
    a.t == b.t && a.z == b.z && a.multiplier == b.multiplier
}

/// What happened at the pivots, without their t.
fn names(pivots: &[Pivot]) -> Vec<(Variable, Variable, PivotKind)> {
    let mut names = Vec::new();
    for pivot in pivots {
        names.push((pivot.entering, pivot.leaving, pivot.kind));
    }
    names
}

#[test]
fn from_a_ray_no_basis_comes_twice_and_the_end_is_complete_or_a_ray() {
    let mut ties = 0;
    let mut complete = 0;
    let mut rays = 0;
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
        ties += knots(&path).windows(2).filter(|w| is_tie(w)).count();

        match path.end {
            PathEnd::Complete => {
                complete += 1;
                assert!(case.is_solved_by(path.last().unwrap()), "seed {seed}");
            }
            PathEnd::Ray => rays += 1,
            other => panic!("seed {seed}: {other:?}"),
        }
    }

    println!("{ties} degenerate pivots; {complete} complete, {rays} rays");
    assert!(ties > 500);
    assert!(complete > 500);
    assert!(rays > 100);
}

#[test]
fn doubles_walk_the_exact_path_and_expand_ends_where_it_may() {
    let mut same = 0;
    let mut solved_lexicographic = 0;
    let mut solved_expand = 0;
    for seed in 0..600 {
        let case = degenerate(&mut ChaCha8Rng::seed_from_u64(10_000 + seed), seed % 2 == 1);
        let exact = case.follow_exactly();
        let doubles = case.follow_in_doubles(RatioTest::Lexicographic);

        assert_eq!(exact.end, doubles.end, "seed {seed}");

        if names(&exact.pivots) == names(&doubles.pivots) {
            same += 1;
        }
        if exact.end == PathEnd::Complete {
            solved_lexicographic += 1;
        }

        let expand = case.follow_in_doubles(RatioTest::Expand);
        if expand.end == PathEnd::Complete {
            solved_expand += 1;
            let residual = case.residual_in_doubles(expand.last().unwrap());
            assert!(residual < 1e-8, "seed {seed}");
        }
    }

    println!("{same} of 600 paths pivot for pivot alike");
    println!("complete: lexicographic {solved_lexicographic}, EXPAND {solved_expand}");
    assert_eq!(same, 600);
    assert!(solved_expand * 10 >= solved_lexicographic * 9);
}
