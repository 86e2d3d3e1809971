//! x of the solutions that a complete set lists: in reports, and in doubles for modes.
//!
//! The truth is the enumerator's list, digit by digit where the claim is exact. The problems have a
//! value at which doubles are of little help: 0, where a step relative to the value is none, values
//! with several supports, and rows without an entry. Each stands for a report that was wrong: x =
//! (1, 1) at the value 0, x = 0 at the value 3, a biactive index that was not named.
#![cfg(feature = "solver")]

use mceip_engine::report::Listed;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, Completed, complete};
use mceip_exact::{Integer, Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{
    Body, ContactState, Particle, Pencil, Problem, Reduced, System, Unknown, Window,
};
use mceip_oracle::{Solution, enumerate};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn problem_of(a: Sparse, b: Sparse, free: Vec<usize>, unknown: Unknown) -> Problem {
    let pencil = Pencil::new(a, b, free).unwrap();
    Problem::new(Body::Pencil(pencil), unknown, Window::all()).unwrap()
}

fn searched(problem: &Problem) -> Completed {
    complete(problem, &CompleteOptions::default(), &Watch::nobody()).unwrap()
}

/// The solution of the enumerator that a listed one is.
fn truth<'a>(solutions: &'a [Solution], listed: &Listed, reduced: &Reduced) -> &'a Solution {
    let value: f64 = listed.value.parse().unwrap();
    let is_it = |solution: &&Solution| {
        let its_value: f64 = solution.decimal(17).parse().unwrap();
        solution.slip == listed.slip && (its_value - value).abs() <= 1e-9 * (1.0 + value.abs())
    };
    let mut known = solutions.iter().filter(is_it);
    let found = known.next();
    found.unwrap_or_else(|| panic!("{} {:?} of {reduced:?}", listed.value, listed.slip))
}

/// Demands that every solution has the enumerator's x; how many there are.
#[track_caller]
fn assert_x_is_that_of_the_enumerator(problem: &Problem) -> usize {
    let reduced = reduce(problem).unwrap();
    let solutions = enumerate(&reduced.pencil, problem.window())
        .unwrap()
        .solutions;
    let found = searched(problem);

    let mut count = 0;
    let listed = Listed::of_cover(problem, &reduced, &found);
    for ((_, listed), (_, in_doubles)) in listed.zip(found.solutions()) {
        let solution = truth(&solutions, &listed, &reduced);
        let expected = Listed::of_solution(problem, &reduced, solution);
        if listed.exact.is_some() {
            assert_eq!(listed.x, expected.x, "{:?}", listed.value);
            assert_eq!(listed.biactive, expected.biactive, "{:?}", listed.value);
        }

        let expected: Vec<f64> = expected.x.iter().map(|x_i| x_i.parse().unwrap()).collect();
        for (x_i, expected) in in_doubles.iter().zip(&expected) {
            assert!((x_i - expected).abs() < 1e-9, "{in_doubles:?}, {expected}");
        }
        count += 1;
    }

    assert_eq!(count, found.cover.solutions.len());
    count
}

#[test]
fn a_value_of_zero_has_its_own_x() {
    let a = Sparse::from_ints(&[&[0, 0], &[-2, 3]]);
    let b = Sparse::from_ints(&[&[1, 3], &[2, 0]]);
    let problem = problem_of(a, b, vec![], Unknown::Mu);

    assert_eq!(assert_x_is_that_of_the_enumerator(&problem), 1);
}

#[test]
fn three_supports_at_one_value_have_their_own_x() {
    let a = Sparse::from_ints(&[&[-3, 6, -9], &[-6, -10, -7], &[0, -3, 3]]);
    let b = Sparse::from_ints(&[&[1, -2, 3], &[2, 3, 3], &[0, 1, -1]]);
    let problem = problem_of(a, b, vec![], Unknown::Lambda2);

    assert_eq!(assert_x_is_that_of_the_enumerator(&problem), 4);
}

/// The isolating interval of the claim is wider than the enclosure of the cover.
#[test]
fn a_row_without_an_entry_is_biactive() {
    let a = Sparse::from_ints(&[&[-3, 1, -3], &[0, 3, 1], &[0, 0, 0]]);
    let b = Sparse::from_ints(&[&[0, -1, 3], &[3, 2, -3], &[0, 0, 0]]);
    let window = Window::new(whole(1), None).unwrap();
    let problem = problem_of(a, b, vec![1], Unknown::Mu).with_window(window);

    assert_eq!(assert_x_is_that_of_the_enumerator(&problem), 1);
    let reduced = reduce(&problem).unwrap();
    let found = searched(&problem);
    let (_, listed) = Listed::of_cover(&problem, &reduced, &found).next().unwrap();
    assert_eq!(listed.biactive, [2]);
}

/// Free components far from the anchor of the condensation: they had six digits.
#[test]
fn free_variables_have_all_their_digits() {
    let stiffness = Sparse::from_entries(
        3,
        3,
        [
            (0, 0, whole(9)),
            (0, 1, whole(-2)),
            (0, 2, whole(-4)),
            (1, 0, whole(-2)),
            (1, 1, whole(4)),
            (1, 2, whole(2)),
            (2, 0, whole(-4)),
            (2, 1, whole(2)),
            (2, 2, rational(41, 10)),
        ],
    );
    let mass = Sparse::from_ints(&[&[2, 0, 0], &[0, 1, 0], &[0, 0, 2]]);
    let slips = Particle::plain(0, 1, ContactState::Slip { sign: 1 });
    let friction = Some(rational(209, 2));
    let system = System::new(stiffness, Some(mass), friction, vec![slips]).unwrap();
    let body = Body::System(system);
    let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();

    assert_eq!(assert_x_is_that_of_the_enumerator(&problem), 2);
}

/// Entries of 1e-20 beside 3: no claim is made, and y on the support is 0 all the same.
#[test]
fn y_is_zero_on_the_support() {
    let tiny = Rational::new(2.into(), Integer::from(10).pow(20));
    let entries = [
        (0, 0, whole(-3)),
        (0, 1, tiny.clone()),
        (1, 0, whole(3)),
        (1, 1, -tiny),
    ];
    let a = Sparse::from_entries(2, 2, entries);
    let problem = problem_of(a, Sparse::identity(2), vec![], Unknown::Lambda2);
    let reduced = reduce(&problem).unwrap();
    let found = searched(&problem);

    let mut count = 0;
    for (_, listed) in Listed::of_cover(&problem, &reduced, &found) {
        for &i in &listed.slip {
            assert_eq!(listed.y[i], "0", "{listed:?}");
        }
        count += 1;
    }
    assert!(count > 0);
}

/// A random pencil of integers with A x = 0 for a positive x: the value 0 is a solution.
fn with_value_zero(rng: &mut ChaCha8Rng, order: usize) -> Problem {
    let x: Vec<i64> = (0..order).map(|_| rng.random_range(1..6)).collect();
    let mut a = Vec::new();
    let mut b = Vec::new();
    for i in 0..order {
        let mut product = Rational::default();
        for j in 0..order - 1 {
            let entry = whole(rng.random_range(-3..4));
            product += &entry * whole(x[j]);
            a.push((i, j, entry));
        }
        a.push((i, order - 1, -product / whole(x[order - 1])));
        for j in 0..order {
            b.push((i, j, whole(rng.random_range(-3..4))));
        }
    }

    let a = Sparse::from_entries(order, order, a);
    let b = Sparse::from_entries(order, order, b);
    problem_of(a, b, vec![], Unknown::Mu)
}

#[test]
fn planted_values_of_zero_have_the_x_that_was_planted() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut checked = 0;
    let mut at_zero = 0;
    for k in 0..300 {
        let problem = with_value_zero(&mut rng, 2 + k % 3);
        let pencil = reduce(&problem).unwrap().pencil;
        let answer = enumerate(&pencil, problem.window()).unwrap();
        if !answer.is_plain_list() {
            continue;
        }

        checked += assert_x_is_that_of_the_enumerator(&problem);
        let values = answer.solutions.iter().map(|solution| solution.decimal(17));
        at_zero += values.filter(|value| value == "0").count();
    }

    assert!(checked > 300 && at_zero > 150, "{checked}, {at_zero} at 0");
}

/// The support {0, 1} has two roots, 2 -+ 3e-8; at the lower one x_1 is negative. In a window there
/// is no claim beside the cover, and doubles reach the lower one.
#[test]
fn a_root_that_is_no_solution_lends_no_x_to_one_that_is() {
    let number = |text: &str| mceip_exact::parse(text).unwrap();
    let entries = [
        (0, 0, number("-2")),
        (0, 1, number("-1e-6")),
        (1, 0, number("-9e-16")),
        (1, 1, number("-2e-6")),
    ];
    let a = Sparse::from_entries(2, 2, entries);
    let b = Sparse::from_entries(2, 2, [(0, 0, whole(1)), (1, 1, number("1e-6"))]);
    let window = Window::new(number("1.999699"), Some(number("2.0003"))).unwrap();
    let problem = problem_of(a, b, vec![], Unknown::Lambda2).with_window(window);

    assert_eq!(assert_x_is_that_of_the_enumerator(&problem), 1);
}
