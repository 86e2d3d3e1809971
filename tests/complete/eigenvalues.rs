//! Eigenvalue complementarity problems, linear and quadratic: values of both signs, against the
//! exact enumerator, which goes through the whole real line and knows no reflection and no linear
//! form; and what the literature has counted.
#![cfg(feature = "testkit")]

use crate::cover::disagreements;
use mceip::{Matrix, Problem, check};
use mceip_check::certificate::Certificate;
use mceip_check::{Accepted, Reason};
use mceip_engine::analysis::ProofCertificate;
use mceip_engine::run::{Keeper, OnProof, Watch};
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Body, Pencil, RealWindow, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate};
use mceip_testkit::generators::raw::{digits, of_kind, quadratic};
use mceip_testkit::pareto::pareto_matrices;
use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::Duration;

/// The eigenvalue problem of a pencil.
fn posed(body: Body, window: &RealWindow) -> Problem {
    let problem = mceip_model::Problem::new(body, Unknown::Eigenvalue, Window::all()).unwrap();
    Problem::from(problem.with_real_window(window))
}

/// A window that holds 0, or begins above it; often the real line.
fn drawn_window(rng: &mut ChaCha8Rng) -> RealWindow {
    let mut end = |probability: f64, low: i64| {
        let is_there = rng.random_bool(probability);
        is_there.then(|| rational(rng.random_range(low..low + 12), 2))
    };
    let (min, max) = (end(0.4, -8), end(0.4, 0));
    RealWindow::new(min, max).unwrap_or(RealWindow::ALL)
}

/// What a campaign has met, so that it cannot pass by meeting nothing.
#[derive(Default)]
struct Met(BTreeMap<&'static str, usize>);

impl Met {
    fn note(&mut self, truth: &Enumeration, window: &RealWindow, is_complete: bool) {
        let mut count = |name, is_met| *self.0.entry(name).or_default() += usize::from(is_met);
        let sign = |s: &mceip_oracle::Solution| s.value.clone().cmp_rational(&whole(0)) as i8;
        let of_sign = |wanted| truth.solutions.iter().any(|s| sign(s) == wanted);

        count("a solution below 0", of_sign(-1));
        count("a solution at 0", of_sign(0));
        count("a solution above 0", of_sign(1));
        count(
            "none",
            truth.solutions.is_empty() && truth.ranges.is_empty(),
        );
        let mut pieces = truth.ranges.iter().flat_map(|range| &range.pieces);
        count(
            "a continuum from -infinity",
            pieces.any(|piece| piece.from.is_none()),
        );
        count("the real line", *window == RealWindow::ALL);
        count(
            "no value below 0",
            window.min().is_some_and(|min| *min >= whole(0)),
        );
        count("complete", is_complete);
    }

    #[track_caller]
    fn assert_floors(&self, floors: &[(&str, usize)]) {
        println!("{:?}", self.0);
        for (what, floor) in floors {
            assert!(self.0[what] >= *floor, "{what}: {:?}", self.0);
        }
    }
}

/// The search finds what the enumerator finds, or leaves it open; is nothing open?
#[track_caller]
fn assert_agrees(problem: &Problem, truth: &Enumeration) -> bool {
    let found = problem.complete().run().unwrap();
    let cover = found.proved().accepted().cover.as_ref().unwrap();
    let wrong = disagreements(cover, truth);
    assert!(wrong.is_empty(), "{wrong:?}: {}", problem.to_json());

    // What is written is read, and accepted as what was found.
    let file = found.proved().file().unwrap();
    let again = Certificate::from_json(&file).unwrap();
    assert_eq!(
        check(problem, &again).as_ref(),
        Ok(found.proved().accepted()),
        "{}",
        problem.to_json()
    );
    found.is_complete()
}

/// Quadratic pencils of orders up to this one, against the enumerator.
fn quadratic_campaign(pencils: usize, largest_order: usize) -> Met {
    let mut met = Met::default();
    for k in 0..pencils {
        let mut rng = mceip_testkit::generators::rng(44, k as u64);
        let n = rng.random_range(1..=largest_order);
        let quadratic = quadratic(&mut rng, k as u64, n).unwrap();
        let window = drawn_window(&mut rng);
        let truth = enumerate(&quadratic, &window).unwrap();
        let problem = posed(Body::Quadratic(quadratic), &window);

        let is_complete = assert_agrees(&problem, &truth);
        met.note(&truth, &window, is_complete);
    }

    met
}

/// 240 quadratic pencils.
#[test]
fn quadratic_eigenvalues_are_those_of_the_enumerator() {
    quadratic_campaign(240, 3).assert_floors(&[
        ("a solution below 0", 70),
        ("a solution at 0", 30),
        ("a solution above 0", 70),
        ("none", 30),
        ("a continuum from -infinity", 3),
        ("the real line", 60),
        ("no value below 0", 20),
        ("complete", 238),
    ]);
}

/// Dense quadratic pencils of order 8 over the real line. What the remainders of anchors of degree
/// 2 leave open is closed by closer ones; what is left has degenerate solutions, as that with the
/// slip sets [2] and [2, 7] at t = 1 of number 2.
#[test]
fn little_stays_open_of_larger_quadratic_pencils() {
    let mut complete = Vec::new();
    for k in 0..10 {
        let mut rng = mceip_testkit::generators::rng(45, k);
        let quadratic = quadratic(&mut rng, 0, 8).unwrap();
        let problem = posed(Body::Quadratic(quadratic), &RealWindow::ALL);
        if problem.complete().run().unwrap().is_complete() {
            complete.push(k);
        }
    }
    println!("{complete:?}");
    assert!(complete.len() >= 9, "{complete:?}");
}

/// A window that stays open is searched twice. What the first search has found is handed over
/// before the second begins, however short it was: a kill does not lose it.
#[test]
fn what_the_first_search_found_is_kept_while_the_second_goes_on() {
    let mut rng = mceip_testkit::generators::rng(45, 2);
    let quadratic = quadratic(&mut rng, 0, 8).unwrap();
    let body = Body::Quadratic(quadratic);
    let problem = mceip_model::Problem::new(body, Unknown::Eigenvalue, Window::all()).unwrap();

    let kept = Mutex::new(Vec::new());
    let keep: &OnProof<'_> = &|proved| {
        let ProofCertificate::Solutions(proved) = proved.certificate else {
            panic!("a complete set")
        };
        kept.lock().unwrap().push(proved.clone());
    };
    let keeper = Keeper::new(Duration::from_secs(3600), keep);
    let watch = Watch::nobody().kept_by(Some(keeper));
    let found = complete(&problem, &CompleteOptions::default(), &watch).unwrap();

    let kept = kept.into_inner().unwrap();
    assert!(!found.is_complete() && !found.cover.solutions.is_empty());
    assert_eq!(kept.len(), 1);
    assert_eq!(kept[0].certificate(), found.proved.certificate());
}

/// 2,000 of them, of larger orders as well.
#[test]
#[ignore = "takes four minutes on two quiet cores"]
fn more_quadratic_eigenvalues_are_those_of_the_enumerator() {
    quadratic_campaign(2000, 4).assert_floors(&[
        ("a solution below 0", 700),
        ("a solution at 0", 300),
        ("a solution above 0", 700),
        ("none", 300),
        ("a continuum from -infinity", 30),
        ("the real line", 600),
        ("no value below 0", 200),
        ("complete", 1990),
    ]);
}

/// 250 pencils.
#[test]
fn eigenvalues_of_both_signs_are_those_of_the_enumerator() {
    let mut met = Met::default();
    for k in 0..250 {
        let mut rng = mceip_testkit::generators::rng(42, k);
        let n = rng.random_range(1..=5);
        let pencil = of_kind(&mut rng, k, n).unwrap();
        let window = drawn_window(&mut rng);
        let truth = enumerate(&pencil, &window).unwrap();
        let problem = posed(Body::Pencil(pencil), &window);

        let is_complete = assert_agrees(&problem, &truth);
        met.note(&truth, &window, is_complete);
    }

    met.assert_floors(&[
        ("a solution below 0", 50),
        ("a solution at 0", 70),
        ("a solution above 0", 100),
        ("none", 25),
        ("a continuum from -infinity", 15),
        ("the real line", 80),
        ("no value below 0", 20),
        ("complete", 245),
    ]);
}

/// What is said of values below 0 is said of the reflected pencil: with the pencil itself in its
/// place, a window cut short or the parts exchanged no certificate that lists one is accepted.
#[test]
fn what_is_said_of_the_wrong_sign_is_refused() {
    let mut refused = 0;
    for k in 0..60 {
        let mut rng = mceip_testkit::generators::rng(43, k);
        let pencil = digits(&mut rng, 3, 0).unwrap();
        let problem = posed(Body::Pencil(pencil), &RealWindow::ALL);
        let found = problem.complete().run().unwrap();
        if !found.is_complete() || found.solutions().is_empty() {
            continue;
        }

        let certificate = found.certificate().clone();
        let negative = certificate.negative.clone().unwrap();
        let exchanged = Certificate {
            window: negative.window,
            claims: negative.claims,
            complete_set: negative.complete_set,
            negative: None,
            ..certificate.clone()
        }
        .with_negative(certificate);
        assert!(check(&problem, &exchanged).is_err(), "{k}");
        refused += 1;
    }
    assert!(refused >= 30, "{refused}");
}

/// Of P x - lambda x >= 0 there are 3, 9, 23 and 57 Pareto eigenvalues, for orders 2 to 5.
#[test]
fn the_counts_of_the_literature_are_proved() {
    for pareto in pareto_matrices() {
        let n = pareto.matrix.rows();
        // (P - lambda I) x = (t B - A) x with A = -P and B = -I.
        let minus = |m: &Sparse| Matrix::from(m.negated());
        let identity = Sparse::identity(n);
        let problem = Problem::eicp(minus(&pareto.matrix), minus(&identity)).unwrap();

        let found = problem.complete().run().unwrap();
        assert!(found.is_complete());
        assert_eq!(found.solutions().len(), pareto.count);

        let largest = found.solutions().last().unwrap().value;
        let solved = problem.solve().all().run().unwrap();
        assert!(solved.solutions.len() >= pareto.count / 2);
        assert!(solved.solutions.iter().all(|s| s.value <= largest));
        for file in solved.certificates() {
            check(&problem, file.certificate()).unwrap();
        }
    }
}

/// t = -2 alone: it is certified near by, and nowhere else.
#[test]
fn a_point_below_zero_is_certified() {
    let two = Matrix::from_rows(&[[-2.0]]).unwrap();
    let problem = Problem::eicp(two, Matrix::identity(1)).unwrap();

    let certified = problem.certify(-2.000001, &[1.0]).unwrap();
    assert_eq!(certified.solution.value, -2.0);
    let accepted: Accepted = check(&problem, certified.certificate()).unwrap();
    assert_eq!(accepted.claims[0].value.lo(), &whole(-2));
    assert!(problem.certify(2.0, &[1.0]).is_err());

    let above = problem.in_window(Rational::default(), None).unwrap();
    assert!(above.certify(-2.0, &[1.0]).is_err());
    assert!(above.complete().run().unwrap().is_empty());
}

/// (t - 2)(t + 3) x: both roots are certified from x alone, and no other value.
#[test]
fn a_point_of_a_quadratic_problem_is_certified() {
    let [a, b, c] = [1.0, 1.0, -6.0].map(|v| Matrix::from_rows(&[[v]]).unwrap());
    let problem = Problem::qeicp(a, b, c).unwrap();

    for root in [2, -3] {
        let certified = problem.certify(f64::from(root) + 1e-7, &[5.0]).unwrap();
        assert_eq!(certified.solution.value, f64::from(root));
        assert_eq!(certified.solution.x, [1.0]);
        let accepted = check(&problem, certified.certificate()).unwrap();
        assert!(accepted.claims[0].value.contains(&whole(root.into())));
    }
    for other in [-2.0, 3.0, 0.0] {
        assert!(problem.certify(other, &[5.0]).is_err());
    }
}

/// A certificate of a pencil is none of its eigenvalue problem.
#[test]
fn another_unknown_is_another_problem() {
    let pencil = || Pencil::new(minus_two(), Sparse::identity(1), vec![]).unwrap();
    let of = |unknown| {
        let body = Body::Pencil(pencil());
        Problem::from(mceip_model::Problem::new(body, unknown, Window::all()).unwrap())
    };
    let (eigenvalue, lambda2) = (of(Unknown::Eigenvalue), of(Unknown::Lambda2));

    let found = eigenvalue.complete().run().unwrap();
    let refused = check(&lambda2, found.certificate()).unwrap_err();
    assert!(matches!(refused.reason, Reason::Digest { .. }));
}

fn minus_two() -> Sparse {
    Sparse::from_ints(&[&[-2]])
}

/// R (I - x x' / x'x) with x > 0, rounded: a value within rounding of 0, whose sign doubles do not
/// tell. One side of 0 has it, the other one has none, and both are proved. (One of the 14 stays
/// open away from 0.)
#[test]
fn a_value_next_to_0_leaves_neither_side_open() {
    const ORDER: usize = 12;
    let away = rational(1, 1_000_000);
    let mut complete = 0;
    for seed in 0..14 {
        let mut rng = mceip_testkit::generators::rng(46, seed);
        let x: Vec<f64> = (0..ORDER).map(|_| rng.random_range(0.5..1.5)).collect();
        let square: f64 = x.iter().map(|x_i| x_i * x_i).sum();
        let mut rows = Vec::new();
        for _ in 0..ORDER {
            let row: Vec<f64> = (0..ORDER).map(|_| rng.random_range(-1.0..1.0)).collect();
            let product: f64 = row.iter().zip(&x).map(|(r, x_i)| r * x_i).sum();
            let singular = row
                .iter()
                .zip(&x)
                .map(|(r, x_i)| r - product / square * x_i);
            rows.push(singular.collect::<Vec<f64>>());
        }

        let a = Matrix::from_rows(&rows).unwrap();
        let problem = Problem::eicp(a, Matrix::identity(ORDER)).unwrap();
        let found = problem.complete().run().unwrap();
        let solutions = found.solutions().iter();
        let next_to_0 = solutions.filter(|solution| solution.value.abs() < 1e-12);

        assert_eq!(next_to_0.count(), 1, "seed {seed}");
        for region in found.open() {
            let is_above = region.min.as_ref().is_some_and(|min| *min > away);
            let is_below = region.max.as_ref().is_some_and(|max| *max < -&away);
            assert!(is_above || is_below, "seed {seed}: {region:?}");
        }
        complete += usize::from(found.is_complete());
    }

    assert!(complete >= 13, "{complete}");
}

/// With C = diag(0, 1, 1, 1) the limit at infinity is singular, and the radius of the reversed
/// anchor hides how far from singular T is before. Exact arithmetic closes whole pieces there, not
/// hundreds of their parts.
#[test]
fn a_singular_leading_matrix_is_closed_by_few_leaves() {
    for seed in 0..4 {
        let mut rng = mceip_testkit::generators::rng(47, seed);
        let mut drawn = || {
            let rows = (0..4).map(|_| (0..4).map(|_| rng.random_range(-1.0..1.0)).collect());
            let rows: Vec<Vec<f64>> = rows.collect();
            Matrix::from_rows(&rows).unwrap()
        };
        let (a, b) = (drawn(), drawn());
        let c = Sparse::from_entries(4, 4, (1..4).map(|i| (i, i, whole(1))));
        let problem = Problem::qeicp(a, b, c.into()).unwrap();
        let found = problem.complete().run().unwrap();

        assert!(found.is_complete(), "seed {seed}");
        let leaves = found.proved().accepted().cover.as_ref().unwrap().leaves;
        assert!(leaves < 1_000, "seed {seed}: {leaves}");
    }
}
