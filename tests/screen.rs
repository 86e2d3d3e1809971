//! The screened enumerator against the plain one, on random and degenerate pencils; limits; threads.
#![cfg(feature = "search")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::exact::{Rational, Sparse, rational, whole};
use mceip::model::{Pencil, Window};
use mceip::oracle::{self, Enumeration};
use mceip::search::screen::{self, Screen, ScreenError, Statistics};
use num_traits::Zero;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::ops::ControlFlow;

type Row = (String, usize, Vec<usize>, Vec<usize>, Vec<String>);

/// Values, multiplicities, supports and x in decimals: what two equal answers share.
fn rows(p: &Pencil, e: &Enumeration) -> Vec<Row> {
    let slip = p.slip();
    e.solutions.iter().map(|s| (s.decimal(25), s.multiplicity, s.slip.clone(), s.biactive.clone(), s.x_decimals(&slip, 12))).collect()
}

/// Both enumerators; asserts that they agree. Wide kernels that hold nothing may have been refuted.
#[track_caller]
fn same(label: &str, p: &Pencil, window: &Window) -> (Enumeration, Statistics) {
    let plain = oracle::enumerate(p, window).unwrap();
    let (screened, statistics) = screen::enumerate(p, window).unwrap();
    assert_eq!(rows(p, &screened), rows(p, &plain), "{label}: {p:?} {window:?}");
    assert_eq!(screened.continua, plain.continua, "{label}: {p:?} {window:?}");
    let wide = |e: &Enumeration| e.wide.iter().map(|w| (w.support.clone(), w.dimension)).collect::<Vec<_>>();
    let all = wide(&plain);
    assert!(wide(&screened).iter().all(|w| all.contains(w)), "{label}");
    assert_eq!((screened.supports_done, screened.is_finished()), (plain.supports_done, true));
    assert_eq!(statistics.total(), plain.supports_total);
    (screened, statistics)
}

/// How the entries of a random pencil are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Family {
    /// Uniform in -9..=9, as `peers.md` has it.
    Digits,
    /// Mostly zeros and units: singular supports, ties, wide kernels.
    Sparse,
    /// B = I: standard eigenvalues, often repeated.
    Identity,
    /// Numbers with denominators, rows and columns of very different size.
    Fractions,
    /// Free variables with definite A_ff and no free rows in B: condensed.
    Mu,
    /// Free variables anywhere, A_ff possibly singular.
    Raw,
}

fn draw(family: Family, n: usize, rng: &mut ChaCha8Rng) -> Pencil {
    let free: Vec<usize> = match family {
        Family::Mu | Family::Raw => (0..n - 1).filter(|_| rng.random_range(0..3) == 0).collect(),
        _ => Vec::new(),
    };
    let mut number = |i: usize, j: usize, second: bool| -> Rational {
        match family {
            Family::Digits | Family::Mu => whole(rng.random_range(-9..=9)),
            Family::Sparse | Family::Raw => whole([0, 0, 0, 1, -1, 1, -1, 2][rng.random_range(0..8)]),
            Family::Identity if second => whole(i64::from(i == j)),
            Family::Identity => whole(rng.random_range(-2..=1)),
            Family::Fractions => rational(rng.random_range(-999..=999), rng.random_range(1..=99)) * whole(10i64.pow((i + 2 * j) as u32)),
        }
    };
    let mut matrix = |second: bool| -> Vec<Vec<Rational>> { (0..n).map(|i| (0..n).map(|j| number(i, j, second)).collect()).collect() };
    let (mut a, mut b) = (matrix(false), matrix(true));
    if family == Family::Mu {
        for &i in &free {
            b[i].fill(Rational::zero());
            for &j in &free {
                a[i][j] = whole(if i == j { 20 } else { 1 });
            }
        }
    }
    let sparse = |m: Vec<Vec<Rational>>| {
        Sparse::from_entries(n, n, m.into_iter().enumerate().flat_map(|(i, r)| r.into_iter().enumerate().map(move |(j, v)| (i, j, v))))
    };
    Pencil::new(sparse(a), sparse(b), free).unwrap()
}

#[test]
fn screened_equals_plain_on_random_pencils_of_every_kind() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut sum = Statistics::default();
    let (mut solutions, mut biactive, mut repeated, mut zero, mut wide, mut continua, mut condensed) = (0, 0, 0, 0, 0, 0, 0);
    for k in 0..360 {
        let family = [Family::Digits, Family::Sparse, Family::Identity, Family::Fractions, Family::Mu, Family::Raw][k % 6];
        let p = draw(family, rng.random_range(1..=5), &mut rng);
        let window = match rng.random_range(0..4) {
            0 => Window::new(rational(rng.random_range(0..4), 2), Some(rational(rng.random_range(4..9), 2))).unwrap(),
            1 => Window::new(rational(rng.random_range(1..9), 3), None).unwrap(),
            _ => Window::all(),
        };
        let (found, statistics) = same(&format!("{k} {family:?}"), &p, &window);
        sum += statistics;
        solutions += found.solutions.len();
        biactive += found.solutions.iter().filter(|s| !s.biactive.is_empty()).count();
        repeated += found.solutions.iter().filter(|s| s.multiplicity > 1).count();
        zero += found.solutions.iter().filter(|s| s.decimal(5) == "0").count();
        wide += found.wide.len();
        continua += found.continua.len();
        condensed += usize::from(Screen::new(&p, &window).unwrap().is_condensed());
    }
    // Every filter and every corner was reached.
    let counts = [sum.no_root, sum.row_signs, sum.farkas, sum.open, sum.singular].map(|c| c as usize);
    for (what, count) in [
        ("filters", counts.into_iter().min().unwrap()),
        ("solutions", solutions),
        ("biactive", biactive),
        ("repeated", repeated),
        ("zero", zero),
        ("wide", wide),
        ("continua", continua),
        ("condensed", condensed),
    ] {
        assert!(count >= 3, "{what}: {count}");
    }
    // No filter is lame: most of what plain finds empty is proved empty.
    assert!(sum.open < sum.total() / 2, "{sum}");
}

#[test]
fn screened_equals_plain_on_larger_digits() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    for n in [7, 8] {
        let (_, statistics) = same("larger", &draw(Family::Digits, n, &mut rng), &Window::all());
        assert!(statistics.open <= 12, "{statistics}");
    }
}

/// A pencil with a solution planted at t = 3/7 on the support {0, 1, 2} of 5, y_4 = `y4`.
fn planted(seed: u64, y4: &Rational, x2: &Rational) -> Pencil {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut matrix = || -> Vec<Vec<Rational>> { (0..5).map(|_| (0..5).map(|_| whole(rng.random_range(-9..=9))).collect()).collect() };
    let (mut a, b) = (matrix(), matrix());
    let (t, x) = (rational(3, 7), [whole(2), whole(1), x2.clone()]);
    let y = [whole(0), whole(0), whole(0), whole(5), y4.clone()];
    for i in 0..5 {
        let rest: Rational = (0..3).map(|j| (&a[i][j] + &t * &b[i][j]) * &x[j]).sum();
        a[i][1] += &y[i] - rest; // x_1 = 1
    }
    let sparse = |m: Vec<Vec<Rational>>| {
        Sparse::from_entries(5, 5, m.into_iter().enumerate().flat_map(|(i, r)| r.into_iter().enumerate().map(move |(j, v)| (i, j, v))))
    };
    Pencil::new(sparse(a), sparse(b), vec![]).unwrap()
}

#[test]
fn ties_and_near_misses_are_decided_exactly() {
    let tiny = rational(1, 1 << 62) * rational(1, 1 << 30); // 2e-28: far below what doubles tell
    for seed in 0..8 {
        let holds = |y4: &Rational, x2: &Rational| {
            let (found, _) = same("planted", &planted(seed, y4, x2), &Window::all());
            found.solutions.iter().any(|s| s.slip == [0, 1, 2] && s.decimal(20) == "0.42857142857142857143")
        };
        assert!(holds(&whole(0), &whole(1)) && holds(&tiny, &whole(1)) && holds(&whole(3), &tiny));
        assert!(!holds(&-tiny.clone(), &whole(1)) && !holds(&whole(3), &-tiny.clone()));
    }
}

/// C - tI, C the adjacency matrix of the complete graph: t = k - 1 on every support of size k.
#[test]
fn complete_graphs_are_listed_completely() {
    let n = 9;
    let c = Sparse::from_entries(n, n, (0..n * n).filter(|k| k / n != k % n).map(|k| (k / n, k % n, whole(1))));
    let b = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(-1))));
    let (found, _) = screen::enumerate(&Pencil::new(c, b, vec![]).unwrap(), &Window::all()).unwrap();
    assert!(found.is_complete_list() && found.solutions.len() == (1 << n) - 1);
    assert!(found.solutions.iter().all(|s| s.decimal(5) == (s.slip.len() - 1).to_string()));
}

#[test]
fn parts_make_the_whole_for_any_number_of_threads_and_any_cut() {
    let p = draw(Family::Digits, 11, &mut ChaCha8Rng::seed_from_u64(4));
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (found, statistics) = pool.install(|| screen::enumerate(&p, &Window::all()).unwrap());
        (format!("{:?}", found.solutions), statistics)
    };
    let whole = run(1);
    assert_eq!(whole, run(3));
    let window = Window::all();
    let screen = Screen::new(&p, &window).unwrap();
    let (mut holders, mut statistics) = (Vec::new(), Statistics::default());
    for cut in [0..1, 1..700, 700..700, 700..1536, 1536..2048] {
        let part = screen.run(cut.clone(), |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(part.range, cut);
        holders.extend(part.holders);
        statistics += part.statistics;
    }
    assert_eq!(statistics, whole.1);
    let mut again = Enumeration::default();
    holders.iter().for_each(|&mask| oracle::examine_support(&p, &screen::support(&p, mask), &window, &mut again));
    again.describe(&p, &window);
    assert_eq!(format!("{:?}", again.solutions), whole.0);
}

#[test]
fn an_interrupted_run_names_the_range_it_finished() {
    let p = draw(Family::Digits, 14, &mut ChaCha8Rng::seed_from_u64(5));
    let window = Window::all();
    let part = Screen::new(&p, &window).unwrap().run(0..1 << 14, |_| ControlFlow::Break(())).unwrap();
    assert!(part.range.start == 0 && part.range.end >= 512 && part.range.end < 1 << 14);
    assert!(!part.enumeration.is_finished() && part.enumeration.supports_done == part.range.end);
}

#[test]
fn limits_are_said_before_the_work() {
    let window = Window::all();
    let large = Pencil::new(Sparse::identity(25), Sparse::identity(25), vec![]).unwrap();
    assert!(matches!(screen::enumerate(&large, &window), Err(ScreenError::TooLarge { what: "slip variables", limit: 24, got: 25 })));
    let free = Pencil::new(Sparse::identity(18), Sparse::identity(18), (0..17).collect()).unwrap();
    assert!(matches!(screen::enumerate(&free, &window), Err(ScreenError::TooLarge { what: "free variables", .. })));
    let long = mceip::exact::parse(&format!("1{}", "0".repeat(4000))).unwrap();
    let a = Sparse::from_entries(2, 2, [(0, 0, long.clone()), (0, 1, whole(1)), (1, 0, whole(1)), (1, 1, long)]);
    let long = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
    assert!(matches!(screen::enumerate(&long, &window), Err(ScreenError::TooLarge { what: "bits of a determinant's coefficients", .. })));
    let p = Pencil::new(Sparse::identity(2), Sparse::identity(2), vec![]).unwrap();
    let screen = Screen::new(&p, &window).unwrap();
    #[allow(clippy::reversed_empty_ranges, reason = "what is refused")]
    let reversed = screen.run(3..2, |_| ControlFlow::Continue(()));
    assert_eq!(reversed.unwrap_err(), ScreenError::Range { start: 3, end: 2, total: 4 });
    assert!(screen.run(0..5, |_| ControlFlow::Continue(())).is_err());
}

/// Found by an hour of fuzzing (`screened` target): entries of 1e6 and 1e-6 beside B = I. The determinant of a support falls from
/// 1 to 1e-21 of its largest Bernstein coefficient on the way to infinity, so that over the last ten-thousandth of the line no
/// piece could be told free of roots, and pieces were halved 2^44 times 1e-4: 19 s where the plain enumerator takes 0.02 s. A
/// support that needs more than 4,096 pieces goes to the exact code.
#[test]
fn entries_of_very_different_size_cost_no_more_than_exact_arithmetic() {
    let q = |n: i64, d: i64| rational(n, d);
    let (large, small) = (-3_000_009, 1_000_003);
    let a = [
        [q(0, 1), q(1, 1), q(1, small), q(large, 1)],
        [q(1, small), q(large, 1), q(-1, 1), q(3, small)],
        [q(2 * small, 1), q(4, 1), q(-4, 1), q(-4, 1)],
        [q(-3, 1), q(-4, 1), q(-4, 1), q(-4, 1)],
    ];
    let a = Sparse::from_entries(4, 4, a.iter().enumerate().flat_map(|(i, r)| r.iter().enumerate().map(move |(j, v)| (i, j, v.clone()))));
    let start = std::time::Instant::now();
    let (found, statistics) = same("sizes", &Pencil::new(a, Sparse::identity(4), vec![]).unwrap(), &Window::all());
    assert_eq!((found.solutions.len(), statistics.total()), (3, 16));
    assert!(start.elapsed() < std::time::Duration::from_secs(5), "{:?}", start.elapsed());
}
