//! A third opinion on complete answers: `tests/oracle/third` shares no line with `exact` or
//! `oracle` and goes another way at every step, over the integers of another library.

use crate::third::field::Alpha;
use crate::third::poly::P;
use crate::third::{Ray, Third, at, same_ray};
use dashu_int::IBig;
use dashu_ratio::RBig;
use mceip_exact::{Algebraic, Poly, Rational, Sparse, rational};
use mceip_model::{Pencil, Window};
use mceip_oracle::{Enumeration, Solution, enumerate};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn number(v: &Rational) -> RBig {
    let big = |i: &num_bigint::BigInt| -> IBig { i.to_string().parse().unwrap() };
    RBig::from(big(v.numer())) / RBig::from(big(v.denom()))
}

fn polynomial(p: &Poly) -> P {
    p.coeffs()
        .iter()
        .map(|c| number(&Rational::from_integer(c.clone())))
        .collect()
}

fn is(alpha: &mut Alpha, value: &Algebraic) -> bool {
    alpha.is_root_in(
        &polynomial(value.poly()),
        &number(value.interval().lo()),
        &number(value.interval().hi()),
    )
}

fn vector(s: &Solution) -> Vec<P> {
    s.x.iter().map(polynomial).collect()
}

fn is_irrational(value: &Algebraic) -> bool {
    let mut value = value.clone();
    value.try_rational();
    value.as_rational().is_none()
}

/// What the comparison reached.
#[derive(Debug, Default)]
struct Seen {
    solutions: usize,
    irrational: usize,
    biactive: usize,
    free_only: usize,
    cones: usize,
    ranges: usize,
    isolated: usize,
    lines: usize,
}

/// Compares everything; returns what was there.
fn compare(a: Vec<Vec<i64>>, b: Vec<Vec<i64>>, free: Vec<usize>, seen: &mut Seen) {
    let label = format!("A = {a:?}, B = {b:?}, free {free:?}");
    let matrix = |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(|r| &r[..]).collect::<Vec<_>>());
    let pencil = Pencil::new(matrix(&a), matrix(&b), free.clone()).unwrap();
    let ours = enumerate(&pencil, &Window::all()).unwrap();
    assert!(ours.is_complete_list(), "{label}");
    let theirs = Third { a, b, free };
    let (mut values, singular) = theirs.values();
    let mut continua = ours.continua.clone();
    let mut named = singular.clone();
    continua.sort();
    named.sort();
    assert_eq!(continua, named, "{label}");
    // What a singular support has at one value only may be at none of these roots: add it.
    seen.isolated += ours
        .solutions
        .iter()
        .filter(|s| s.multiplicity == 0)
        .count();
    let at_isolated = ours
        .solutions
        .iter()
        .filter(|s| s.multiplicity == 0)
        .map(|s| &s.value);
    for v in at_isolated.chain(ours.cones.iter().map(|c| &c.value)) {
        if !values.iter_mut().any(|alpha| is(alpha, v)) {
            values.push(Alpha::new(
                &polynomial(v.poly()),
                (number(v.interval().lo()), number(v.interval().hi())),
            ));
        }
    }
    let mut matched = (0, 0);
    for alpha in &mut values {
        let (solutions, cones) = compare_at(alpha, &theirs, &singular, &ours, &label, seen);
        matched = (matched.0 + solutions, matched.1 + cones);
    }
    assert_eq!(matched, (ours.solutions.len(), ours.cones.len()), "{label}");
    compare_ranges(&theirs, &singular, &ours, &label);
    compare_ends(&theirs, &ours, &label);
    seen.solutions += matched.0;
    seen.cones += matched.1;
    seen.ranges += ours.ranges.len();
    seen.irrational += ours
        .solutions
        .iter()
        .filter(|s| is_irrational(&s.value))
        .count();
    seen.biactive += ours
        .solutions
        .iter()
        .filter(|s| !s.biactive.is_empty())
        .count();
    seen.free_only += ours.solutions.iter().filter(|s| s.is_free_only()).count();
}

/// Rays and cones at one value; returns how many of our solutions and cones belong to it.
fn compare_at(
    alpha: &mut Alpha,
    theirs: &Third,
    singular: &[Vec<usize>],
    ours: &Enumeration,
    label: &str,
    seen: &mut Seen,
) -> (usize, usize) {
    // A singular support within its range has solutions here that nobody lists.
    let in_range = |support: &[usize], alpha: &mut Alpha| {
        singular.iter().any(|s| s == support)
            && ours
                .ranges
                .iter()
                .any(|r| r.support == support && holds(r, alpha))
    };
    let mut rays: Vec<Ray> = Vec::new();
    for ray in theirs.rays(alpha) {
        if !in_range(&ray.slip, alpha) {
            rays.push(ray);
        }
    }
    let solutions: Vec<&Solution> = ours
        .solutions
        .iter()
        .filter(|s| is(alpha, &s.value))
        .collect();
    let cones: Vec<_> = ours.cones.iter().filter(|c| is(alpha, &c.value)).collect();
    if cones.iter().any(|c| !c.lineality.is_empty()) {
        // Extreme rays modulo a subspace: compared by hand in tests/oracle/oracle_degenerate.rs.
        seen.lines += 1;
        return (solutions.len(), cones.len());
    }
    let mut generators: Vec<&Solution> = solutions.clone();
    for ray in cones.iter().flat_map(|c| &c.rays) {
        if !in_range(&ray.slip, alpha) && !generators.iter().any(|g| **g == *ray) {
            generators.push(ray);
        }
    }
    assert_eq!(generators.len(), rays.len(), "{label}: at {alpha:?}");
    for g in &generators {
        let twin = rays
            .iter()
            .find(|r| r.slip == g.slip && same_ray(alpha, &r.x, &vector(g)));
        let twin = twin
            .unwrap_or_else(|| panic!("{label}: {:?} {:?} is not confirmed", g.decimal(9), g.slip));
        let biactive: Vec<usize> = twin
            .y_zero
            .iter()
            .copied()
            .filter(|i| !twin.slip.contains(i))
            .collect();
        assert_eq!(biactive, g.biactive, "{label}");
    }
    let mut regular = Vec::new();
    for s in theirs.supports() {
        if !in_range(&s, alpha) {
            regular.push(s);
        }
    }
    let all_rays = theirs.rays(alpha);
    let mut maximal: Vec<(Vec<usize>, usize)> = theirs
        .cones(alpha, &all_rays, &regular)
        .into_iter()
        .map(|(j, r)| (j, r.len()))
        .collect();
    let mut listed: Vec<(Vec<usize>, usize)> = cones
        .iter()
        .map(|c| (c.slip.clone(), c.rays.len()))
        .collect();
    maximal.sort();
    listed.sort();
    assert_eq!(maximal, listed, "{label}: cones at {alpha:?}");
    (solutions.len(), cones.len())
}

fn holds(r: &mceip_oracle::SupportRange, alpha: &mut Alpha) -> bool {
    let mut side = |end: &mceip_oracle::End| {
        let (p, lo, hi) = (
            polynomial(end.value.poly()),
            number(end.value.interval().lo()),
            number(end.value.interval().hi()),
        );
        if alpha.is_root_in(&p, &lo, &hi) {
            return 0;
        }
        // Another number: narrow the end until it lies on one side.
        let mut end = Alpha::new(&p, (lo, hi));
        loop {
            let (below, above) = (
                alpha.sign(&[-end.lo.clone(), 1.into()]),
                alpha.sign(&[-end.hi.clone(), 1.into()]),
            );
            match (below, above) {
                (-1 | 0, _) => return -1,
                (_, 0 | 1) => return 1,
                _ => end.halve(),
            }
        }
    };
    r.pieces.iter().any(|p| {
        let from = side(&p.from);
        let to = p.to.as_ref().map(|to| (side(to), to.included));
        (from > 0 || (from == 0 && p.from.included))
            && to.is_none_or(|(s, included)| s < 0 || (s == 0 && included))
    })
}

/// Both ends of every range: does their existence test say what `included` says?
fn compare_ends(theirs: &Third, ours: &Enumeration, label: &str) {
    for r in &ours.ranges {
        for end in r
            .pieces
            .iter()
            .flat_map(|p| [Some(&p.from), p.to.as_ref()])
            .flatten()
        {
            let v = &end.value;
            let mut alpha = Alpha::new(
                &polynomial(v.poly()),
                (number(v.interval().lo()), number(v.interval().hi())),
            );
            assert_eq!(
                theirs.exists(&mut alpha, &r.support),
                r.contains(v),
                "{label}: end of {:?} at {v:?}",
                r.support
            );
        }
    }
}

/// Ranges of singular supports at rational samples: inside or outside, as their own existence test
/// says.
fn compare_ranges(theirs: &Third, singular: &[Vec<usize>], ours: &Enumeration, label: &str) {
    for support in singular {
        for (n, d) in [
            (0, 1),
            (1, 3),
            (1, 2),
            (1, 1),
            (4, 3),
            (3, 2),
            (2, 1),
            (5, 2),
            (3, 1),
            (9, 2),
            (100, 1),
        ] {
            let value = Algebraic::rational(rational(n, d));
            let expected = theirs.exists(&mut at(n, d), support);
            let in_range = ours
                .ranges
                .iter()
                .any(|r| r.support == *support && r.contains(&value));
            let single = ours
                .solutions
                .iter()
                .any(|s| s.slip == *support && s.value.clone().equals(&mut value.clone()))
                || ours
                    .cones
                    .iter()
                    .any(|c| c.slip == *support && c.value.clone().equals(&mut value.clone()))
                || (expected
                    && !in_range
                    && ours
                        .cones
                        .iter()
                        .any(|c| support.iter().all(|i| c.slip.contains(i))));
            assert_eq!(
                expected,
                in_range || single,
                "{label}: support {support:?} at {n}/{d}"
            );
        }
    }
}

fn random(rng: &mut ChaCha8Rng, n: usize, largest: i64, zeros: f64) -> Vec<Vec<i64>> {
    (0..n)
        .map(|_| {
            (0..n)
                .map(|_| {
                    if rng.random::<f64>() < zeros {
                        0
                    } else {
                        rng.random_range(-largest..=largest)
                    }
                })
                .collect()
        })
        .collect()
}

#[test]
fn random_pencils_regular_and_degenerate() {
    let mut rng = ChaCha8Rng::seed_from_u64(20_261_121);
    let mut seen = Seen::default();
    for k in 0..400 {
        let n = 1 + k % 4;
        // From dense and generic to sparse, small and singular.
        let (largest, zeros) = [(9, 0.0), (3, 0.2), (1, 0.3), (1, 0.5), (2, 0.6)][k / 4 % 5];
        let (a, b) = (
            random(&mut rng, n, largest, zeros),
            random(&mut rng, n, largest, zeros),
        );
        let free = (0..n)
            .filter(|_| k % 3 == 2 && rng.random_range(0..3) == 0)
            .collect();
        compare(a, b, free, &mut seen);
    }
    eprintln!("{seen:?}");
    assert!(
        seen.solutions > 200 && seen.irrational > 20 && seen.biactive > 20 && seen.free_only > 5,
        "{seen:?}"
    );
    assert!(seen.ranges > 20 && seen.isolated > 0, "{seen:?}");
}

/// Scalar-like and symmetric pencils: wide kernels with cones of all shapes.
#[test]
fn wide_kernels() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut seen = Seen::default();
    for k in 0..90 {
        let n = 3 + k % 2;
        // -I (or a multiple) with a few coupling entries, B = I.
        let mut a: Vec<Vec<i64>> = (0..n)
            .map(|i| (0..n).map(|j| if i == j { -1 } else { 0 }).collect())
            .collect();
        for _ in 0..k % 5 {
            let (i, j) = (rng.random_range(0..n), rng.random_range(0..n));
            a[i][j] += rng.random_range(-1..=1);
        }
        let mut b: Vec<Vec<i64>> = (0..n)
            .map(|i| (0..n).map(|j| i64::from(i == j)).collect())
            .collect();
        if k % 7 == 0 {
            let (i, j) = (rng.random_range(0..n), rng.random_range(0..n));
            b[i][j] += 1;
        }
        let free = if k % 6 == 5 {
            vec![rng.random_range(0..n)]
        } else {
            vec![]
        };
        compare(a, b, free, &mut seen);
    }
    eprintln!("{seen:?}");
    assert!(seen.cones > 60, "{seen:?}");
}
