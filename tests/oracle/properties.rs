//! Laws of the problem on random pencils: scaling, permutation, shift, windows, files.
//!
//! No expected answer is written down. The truth is a law that takes the answer of one pencil to
//! that of another, which the enumerator computes from other numbers. A root lost, a support taken
//! for another or a wrong end of a window breaks it.

use mceip_exact::{Sparse, rational, whole};
use mceip_model::file::{read_problem, write_problem};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{Enumeration, Solution, enumerate, is_between};
use proptest::prelude::*;
use std::path::Path;

/// A pencil of order 1 to 4 with small integers, sparse on purpose so that corners occur.
fn pencils() -> impl Strategy<Value = Pencil> {
    (1usize..=4).prop_flat_map(|order| {
        let entry = prop_oneof![2 => Just(0i64), 3 => -4i64..=4];
        let entries = prop::collection::vec(entry, 2 * order * order);
        let free_pattern = 0u8..(1 << order);

        (entries, free_pattern)
            .prop_map(move |(entries, pattern)| pencil_of(order, &entries, pattern))
    })
}

/// The entries of A row by row, then those of B. Variables 0 and 2 are free where the pattern has
/// their bit.
fn pencil_of(order: usize, entries: &[i64], free_pattern: u8) -> Pencil {
    let (entries_of_a, entries_of_b) = entries.split_at(order * order);
    let a = matrix_of(order, entries_of_a);
    let b = matrix_of(order, entries_of_b);

    let may_be_free = 0b0101;
    let free = (0..order)
        .filter(|i| free_pattern & may_be_free & (1 << i) != 0)
        .collect();
    Pencil::new(a, b, free).unwrap()
}

fn matrix_of(order: usize, entries: &[i64]) -> Sparse {
    let rows: Vec<&[i64]> = entries.chunks(order).collect();
    Sparse::from_ints(&rows)
}

fn solve(pencil: &Pencil) -> Enumeration {
    enumerate(pencil, &Window::all()).unwrap()
}

/// What two equal solutions share.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Row {
    value: String,
    slip: Vec<usize>,
    biactive: Vec<usize>,
    x: Vec<String>,
}

/// Values, supports and x in decimals.
fn rows_of(pencil: &Pencil, answer: &Enumeration) -> Vec<Row> {
    let mut rows = Vec::new();
    for solution in &answer.solutions {
        rows.push(Row {
            value: solution.decimal(20),
            slip: solution.slip.clone(),
            biactive: solution.biactive.clone(),
            x: solution.x_decimals(&pencil.slip(), 12),
        });
    }
    rows
}

/// Value and support.
fn value_and_support(solution: &Solution) -> (String, Vec<usize>) {
    (solution.decimal(20), solution.slip.clone())
}

/// The supports and biactive sets of all solutions, in their order.
fn supports(answer: &Enumeration) -> Vec<(Vec<usize>, Vec<usize>)> {
    let mut list = Vec::new();
    for solution in &answer.solutions {
        list.push((solution.slip.clone(), solution.biactive.clone()));
    }
    list
}

fn value_as_double(solution: &Solution) -> f64 {
    solution.decimal(17).parse().unwrap()
}

/// Row i multiplied by the i-th factor.
fn with_scaled_rows(matrix: &Sparse, factors: &[i64]) -> Sparse {
    let entries = matrix.entries();
    let scaled = entries.map(|(i, j, value)| (i, j, value * whole(factors[i])));
    Sparse::from_entries(matrix.rows(), matrix.cols(), scaled)
}

/// The pencil with its variables in the opposite order.
fn reversed_pencil(pencil: &Pencil) -> Pencil {
    let order = pencil.order();
    let backwards: Vec<usize> = (0..order).rev().collect();

    let a = pencil.a().submatrix(&backwards, &backwards);
    let b = pencil.b().submatrix(&backwards, &backwards);
    let free = pencil.free().iter().map(|i| order - 1 - i).collect();
    Pencil::new(a, b, free).unwrap()
}

/// The same set in the numbers of the opposite order, ascending.
fn reversed_set(set: &[usize], order: usize) -> Vec<usize> {
    let mut reversed = Vec::new();
    for i in set.iter().rev() {
        reversed.push(order - 1 - i);
    }
    reversed
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    /// Positive row scaling changes neither x nor t.
    #[test]
    fn rows_may_be_scaled(
        pencil in pencils(),
        factors in prop::collection::vec(1i64..9, 4),
    ) {
        let a = with_scaled_rows(pencil.a(), &factors);
        let b = with_scaled_rows(pencil.b(), &factors);
        let scaled = Pencil::new(a, b, pencil.free().to_vec()).unwrap();

        let expected = rows_of(&pencil, &solve(&pencil));
        prop_assert_eq!(expected, rows_of(&scaled, &solve(&scaled)));
    }

    /// B -> 3 B divides every value by 3.
    #[test]
    fn scaling_b_divides_the_values(pencil in pencils()) {
        let order = pencil.order();
        let b = Sparse::zeros(order, order).add_scaled(&whole(3), pencil.b());
        let scaled = Pencil::new(pencil.a().clone(), b, pencil.free().to_vec()).unwrap();

        let answer = solve(&pencil);
        let scaled_answer = solve(&scaled);

        prop_assert_eq!(answer.solutions.len(), scaled_answer.solutions.len());
        for (large, small) in answer.solutions.iter().zip(&scaled_answer.solutions) {
            prop_assert_eq!(&large.slip, &small.slip);

            let expected = value_as_double(small) * 3.0;
            let error = (value_as_double(large) - expected).abs();
            prop_assert!(error <= 1e-12 * (1.0 + expected));
        }
    }

    /// A -> A + B shifts values by -1; those below 1 leave the window.
    #[test]
    fn shifting_moves_the_window(pencil in pencils()) {
        let a = pencil.a().add_scaled(&whole(1), pencil.b());
        let shifted = Pencil::new(a, pencil.b().clone(), pencil.free().to_vec()).unwrap();

        let from_one = Window::new(whole(1), None).unwrap();
        let above_one = enumerate(&pencil, &from_one).unwrap();
        prop_assert_eq!(supports(&above_one), supports(&solve(&shifted)));
    }

    /// Reversing the order of the variables reverses supports and x.
    #[test]
    fn variables_may_be_permuted(pencil in pencils()) {
        let reversed = reversed_pencil(&pencil);

        let mut expected = Vec::new();
        for solution in solve(&pencil).solutions {
            expected.push(value_and_support(&solution));
        }
        let mut found = Vec::new();
        for solution in solve(&reversed).solutions {
            let slip = reversed_set(&solution.slip, pencil.order());
            found.push((solution.decimal(20), slip));
        }

        expected.sort();
        found.sort();
        prop_assert_eq!(expected, found);
    }

    /// Searching a window is filtering the whole; a range that meets the window in one value is a
    /// solution there.
    #[test]
    fn a_window_filters(pencil in pencils(), lo in 0i64..4, width in 0i64..6) {
        let min = rational(lo, 2);
        let max = rational(lo + width, 2);

        let window = Window::new(min.clone(), Some(max.clone())).unwrap();
        let inside = enumerate(&pencil, &window).unwrap();
        let whole = solve(&pencil);
        let is_in_range = |solution: &&Solution| {
            let mut ranges = whole.ranges.iter();
            ranges.any(|r| r.support == solution.slip && r.contains(&solution.value))
        };
        let beside_ranges = inside.solutions.iter().filter(|s| !is_in_range(s));
        let found: Vec<_> = beside_ranges.map(value_and_support).collect();

        let mut expected = Vec::new();
        for solution in whole.solutions.iter().filter(|s| !is_in_range(s)) {
            if is_between(&solution.value, &min, &max) {
                expected.push(value_and_support(solution));
            }
        }
        prop_assert_eq!(expected, found);
    }

    /// Every problem survives its file, digest included.
    #[test]
    fn files_round_trip(pencil in pencils(), lambda2 in any::<bool>()) {
        let unknown = if lambda2 { Unknown::Lambda2 } else { Unknown::Mu };
        let problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())
            .unwrap()
            .named("a \"name\"");

        let text = write_problem(&problem);
        let again = read_problem(&text, Path::new(".")).unwrap();

        prop_assert_eq!(again.sha256(), problem.sha256());
        prop_assert_eq!(again, problem);
    }
}
