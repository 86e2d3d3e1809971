//! The predicates of the enumerator at their edges.
//!
//! What a solution is, what an answer holds, when two answers are equal, and what is said of an
//! answer that is not complete. The truth is worked by hand for pencils A + t B of order two to
//! five. Each wrong vector, value or answer differs from a right one in one part, or in two that
//! could cancel, so that each line fails for one reason only.

use crate::small::{constants, integer, pencil, sparse};
use mceip_exact::{Algebraic, Poly, Rational, Sparse, parse, rational, whole};
use mceip_model::{Pencil, Window};
use mceip_oracle::{
    Cone, End, Enumeration, MAX_FREE, MAX_SLIP, OracleError, Solution, SupportRange, Undescribed,
    ValueInterval, WideKernel, enumerate, enumerate_with, examine_support, is_rational_solution,
    is_solution,
};
use std::ops::ControlFlow;

/// Every x >= 0 solves it at every t.
fn zero_pencil() -> Pencil {
    let zero = Sparse::zeros(2, 2);
    Pencil::new(zero.clone(), zero, vec![]).unwrap()
}

fn solution(value: i64, slip: &[usize], x: &[i64]) -> Solution {
    Solution {
        value: integer(value),
        multiplicity: 1,
        slip: slip.to_vec(),
        biactive: vec![],
        x: constants(x),
        y: constants(&vec![0; x.len()]),
    }
}

fn cone(value: i64, slip: &[usize], rays: Vec<Solution>) -> Cone {
    Cone {
        value: integer(value),
        slip: slip.to_vec(),
        biactive: vec![],
        kernel_dimension: 2,
        dimension: 2,
        rays,
        lineality: vec![],
    }
}

fn included(value: i64) -> End {
    End {
        value: integer(value),
        included: true,
    }
}

fn excluded(value: i64) -> End {
    End {
        value: integer(value),
        included: false,
    }
}

/// The support has solutions from one value to the other, both included, or without end.
fn range(support: &[usize], from: i64, to: Option<i64>) -> SupportRange {
    let piece = ValueInterval {
        from: Some(included(from)),
        to: to.map(included),
    };
    SupportRange {
        support: support.to_vec(),
        pieces: vec![piece],
        kernel: vec![],
    }
}

fn answer_of_solution(solution: Solution) -> Enumeration {
    Enumeration {
        solutions: vec![solution],
        ..Enumeration::default()
    }
}

fn answer_of_cone(cone: Cone) -> Enumeration {
    Enumeration {
        cones: vec![cone],
        ..Enumeration::default()
    }
}

fn answer_of_range(range: SupportRange) -> Enumeration {
    Enumeration {
        ranges: vec![range],
        ..Enumeration::default()
    }
}

#[test]
fn a_vector_of_the_wrong_length_or_at_a_negative_value_is_no_solution() {
    // (t + 2) x_0 = 0 at t = -2.
    let diagonal = pencil(&[&[2, 0], &[0, 3]], &[&[1, 0], &[0, 1]], &[]);
    let first_unit = constants(&[1, 0]);
    assert!(!is_solution(&diagonal, &integer(-2), &first_unit));

    let zero = zero_pencil();
    let two = integer(2);
    assert!(is_solution(&zero, &two, &first_unit));

    let zero_vector = constants(&[0, 0]);
    assert!(!is_solution(&zero, &two, &zero_vector));
    for x in [vec![1], vec![1, 0, 0], vec![]] {
        let of_wrong_length = constants(&x);
        assert!(!is_solution(&zero, &two, &of_wrong_length), "{x:?}");
    }
}

fn fraction(text: &str) -> Rational {
    parse(text).unwrap()
}

fn matrix_of_fractions(rows: [[&str; 2]; 2]) -> Sparse {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, text) in row.iter().enumerate() {
            entries.push((i, j, fraction(text)));
        }
    }
    Sparse::from_entries(2, 2, entries)
}

fn fractions_solve(pencil: &Pencil, t: &str, x: [&str; 2]) -> bool {
    let x = x.map(fraction);
    is_rational_solution(pencil, &fraction(t), &x)
}

/// Rows and vectors with several denominators: x = (1/2, 1/3), rows (2/3 - t/6, -3/4 ...) made to
/// vanish at t = 1.
///
/// Row 0 is (2/3 - t/6)/2 - 1/4, row 1 is (1/5 + t/7)/2 + (-4/5 + 2t/7)/3 = -1/6 + t/6.
#[test]
fn fractions_are_cleared_row_by_row() {
    let a = matrix_of_fractions([["2/3", "-3/4"], ["1/5", "-4/5"]]);
    let b = matrix_of_fractions([["-1/6", "0"], ["1/7", "2/7"]]);
    let pencil = Pencil::new(a, b, vec![]).unwrap();

    assert!(fractions_solve(&pencil, "1", ["1/2", "1/3"]));
    assert!(fractions_solve(&pencil, "1", ["3/5", "2/5"]));

    assert!(!fractions_solve(&pencil, "1", ["1/2", "1/4"]));
    assert!(!fractions_solve(&pencil, "1", ["1/3", "1/2"]));
    assert!(!fractions_solve(&pencil, "1", ["1", "1"]));
    assert!(!fractions_solve(&pencil, "2", ["1/2", "1/3"]));
    assert!(!fractions_solve(&pencil, "1", ["-1/2", "-1/3"]));
}

fn integers_solve(pencil: &Pencil, t: i64, x: [i64; 2]) -> bool {
    let x = constants(&x);
    is_solution(pencil, &integer(t), &x)
}

/// (t - 1) x_0 - x_1 = 0 for the free row, x_0 + x_1 for the other.
#[test]
fn free_rows_are_zero_and_free_variables_of_any_sign() {
    let pencil = pencil(&[&[-1, -1], &[1, 1]], &[&[1, 0], &[0, 0]], &[0]);

    assert!(integers_solve(&pencil, 0, [-1, 1]));
    assert!(integers_solve(&pencil, 1, [1, 0]));
    assert!(integers_solve(&pencil, 0, [-2, 2]));

    assert!(!integers_solve(&pencil, 0, [1, 1]));
    assert!(!integers_solve(&pencil, 1, [-1, 0]));
    assert!(!integers_solve(&pencil, 2, [1, 0]));
    assert!(!integers_solve(&pencil, 0, [1, -1]));
    assert!(!integers_solve(&pencil, 3, [1, 2]));
}

/// Does an answer for the zero pencil hold x at t?
fn holds(answer: &Enumeration, t: Rational, x: [i64; 2]) -> bool {
    let value = Algebraic::rational(t);
    let x = constants(&x);
    answer.contains(&zero_pencil(), &value, &x)
}

/// A listed solution holds its own ray at its own value, a cone what it spans, a range its values.
#[test]
fn an_answer_holds_what_it_lists_and_nothing_else() {
    let answer = answer_of_solution(solution(1, &[0, 1], &[1, 1]));
    assert!(holds(&answer, whole(1), [1, 1]));
    assert!(holds(&answer, whole(1), [3, 3]));
    assert!(!holds(&answer, whole(2), [1, 1]));
    assert!(!holds(&answer, whole(1), [1, 2]));
    assert!(!holds(&answer, whole(1), [1, 0]));
    assert!(!holds(&answer, whole(2), [1, 2]));

    let answer = answer_of_cone(cone(1, &[0], vec![]));
    assert!(holds(&answer, whole(1), [1, 0]));
    assert!(!holds(&answer, whole(2), [1, 0]));
    assert!(!holds(&answer, whole(1), [1, 1]));
    assert!(!holds(&answer, whole(1), [0, 1]));

    // y = (0, 1) of x = (1, 0): the cone of both variables, on which y_1 = 0, does not hold it.
    let with_second_row = pencil(&[&[0, 0], &[1, 0]], &[&[0, 0], &[0, 0]], &[]);
    let first_unit = constants(&[1, 0]);
    let answer = answer_of_cone(cone(1, &[0, 1], vec![]));
    assert!(is_solution(&with_second_row, &integer(1), &first_unit));
    assert!(!answer.contains(&with_second_row, &integer(1), &first_unit));
    assert!(holds(&answer, whole(1), [1, 0]));

    let answer = answer_of_range(range(&[0], 1, Some(2)));
    assert!(holds(&answer, rational(3, 2), [1, 0]));
    assert!(holds(&answer, whole(2), [1, 0]));
    assert!(!holds(&answer, whole(3), [1, 0]));
    assert!(!holds(&answer, rational(3, 2), [1, 1]));
    assert!(!holds(&answer, rational(3, 2), [0, 1]));
}

/// From the first value, included, to the second, excluded.
fn piece(from: i64, to: Option<i64>) -> ValueInterval {
    ValueInterval {
        from: Some(included(from)),
        to: to.map(excluded),
    }
}

// Equality itself is under test, so the assertions name the operator they use.
#[test]
fn ends_pieces_and_ranges_are_equal_in_all_their_parts() {
    assert!(included(1) == included(1));
    assert!(excluded(1) == excluded(1));
    assert!(included(1) != included(2));
    assert!(included(1) != excluded(1));
    assert!(included(1) != excluded(2));

    let bounded = piece(1, Some(2));
    assert!(bounded == piece(1, Some(2)));
    assert!(bounded != piece(1, None));
    assert!(bounded != piece(0, Some(2)));
    assert!(bounded != piece(1, Some(3)));
    assert!(bounded != piece(0, Some(3)));
    let unbounded = piece(1, None);
    assert!(unbounded == piece(1, None));

    let of_first = range(&[0], 1, None);
    assert!(of_first == range(&[0], 1, None));
    assert!(of_first != range(&[1], 1, None));
    assert!(of_first != range(&[0], 2, None));
    assert!(of_first != range(&[1], 2, None));
}

/// The cone of both unit vectors, with a line.
fn cone_with_all_parts() -> Cone {
    let rays = vec![solution(1, &[0], &[1, 0]), solution(1, &[1], &[0, 1])];
    Cone {
        lineality: vec![constants(&[1, 1])],
        ..cone(1, &[0, 1], rays)
    }
}

/// Fails if the cone stays equal to the original when it is changed.
fn assert_differs(change: impl Fn(&mut Cone)) {
    let mut other = cone_with_all_parts();
    change(&mut other);
    assert!(cone_with_all_parts() != other, "{other:?}");
}

#[test]
fn cones_are_equal_in_all_their_parts() {
    let mut with_a_longer_line = cone_with_all_parts();
    with_a_longer_line.lineality = vec![constants(&[2, 2])];
    assert!(cone_with_all_parts() == cone_with_all_parts());
    assert!(cone_with_all_parts() == with_a_longer_line);

    // One part changed.
    assert_differs(|cone| cone.value = integer(2));
    assert_differs(|cone| cone.slip = vec![0]);
    assert_differs(|cone| cone.biactive = vec![1]);
    assert_differs(|cone| cone.dimension = 1);
    assert_differs(|cone| cone.rays.truncate(1));
    assert_differs(|cone| cone.rays[1] = solution(1, &[1], &[1, 1]));
    assert_differs(|cone| cone.lineality = vec![]);
    assert_differs(|cone| cone.lineality = vec![constants(&[1, 2])]);

    // Two parts changed.
    assert_differs(|cone| {
        cone.value = integer(2);
        cone.lineality = vec![constants(&[1, 2])];
    });
    assert_differs(|cone| {
        cone.rays = vec![];
        cone.lineality = vec![constants(&[1, 2])];
    });
}

/// The mean of the rays, each of l1 norm 1, whatever factors they are listed with; or a direction
/// where there is no ray.
#[test]
fn the_center_of_a_cone_is_inside() {
    let three_rays = vec![
        solution(1, &[0], &[2, 0, 0]),
        solution(1, &[1], &[0, 3, 0]),
        solution(1, &[2], &[0, 0, 5]),
    ];
    let center = cone(1, &[0, 1, 2], three_rays).center(&[0, 1, 2]);
    assert_eq!(center.x, constants(&[1, 1, 1]));
    assert_eq!(center.slip, [0, 1, 2]);

    // (1/2, 1/2) + (0, 1).
    let two_rays = vec![solution(1, &[0, 1], &[1, 1]), solution(1, &[1], &[0, 3])];
    let center = cone(1, &[0, 1], two_rays).center(&[0, 1]);
    assert_eq!(center.x, constants(&[1, 3]));

    // Two free variables at t = 1: a plane, without a ray.
    let all_free = pencil(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0, 1]);
    let found = enumerate(&all_free, &Window::all()).unwrap();
    assert_eq!(found.cones.len(), 1);
    let plane = &found.cones[0];
    assert!(plane.rays.is_empty());

    let center = plane.center(&[]);
    assert!(is_solution(&all_free, &integer(1), &center.x));
    assert_eq!(center.x, plane.lineality[0]);
}

/// (t - 1) on two free variables; `rows`: y of the slip variables by the free ones.
///
/// At t = 1 the first free row is the sum of the slip variables, so that none of them moves.
fn pencil_with_free_kernel(rows: &[[i64; 2]]) -> Pencil {
    let order = rows.len() + 2;
    let mut a = vec![vec![0; order]; order];
    let mut b = vec![vec![0; order]; order];

    for i in 0..2 {
        a[i][i] = -1;
        b[i][i] = 1;
    }
    for (k, row) in rows.iter().enumerate() {
        let slip = k + 2;
        a[slip][..2].copy_from_slice(row);
        a[slip][slip] = 1;
        a[0][slip] = 1;
    }
    Pencil::new(sparse(&a), sparse(&b), vec![0, 1]).unwrap()
}

/// The solutions at t = 1 alone.
fn solve_at_one(pencil: &Pencil) -> Enumeration {
    let window = Window::new(whole(1), Some(whole(1))).unwrap();
    enumerate(pencil, &window).unwrap()
}

/// A kernel of dimension 2 of which y >= 0 leaves nothing, or a line.
#[test]
fn a_wide_kernel_of_free_variables_may_hold_nothing() {
    let pencil_of_nothing = pencil_with_free_kernel(&[[1, 0], [-1, 0], [0, 1], [0, -1]]);
    let nothing = solve_at_one(&pencil_of_nothing);
    assert!(nothing.is_plain_list());
    assert!(nothing.solutions.is_empty());
    assert!(!nothing.wide.is_empty());

    let pencil_of_line = pencil_with_free_kernel(&[[1, 0], [-1, 0]]);
    let line = solve_at_one(&pencil_of_line);
    assert!(line.is_plain_list());
    assert_eq!(line.solutions.len(), 2);
    for solution in &line.solutions {
        assert_eq!(solution.x[0], Poly::default());
        assert!(is_solution(&pencil_of_line, &integer(1), &solution.x));
    }
}

/// Rays vanish where the lineality space has its pivot, and still solve: whichever ray the cone was
/// found with.
#[test]
fn rays_are_canonical_beside_a_lineality_space() {
    for row in [[1, 1], [2, 1], [1, -3], [-2, 5], [0, 1], [1, 0]] {
        let pencil = pencil_with_free_kernel(&[row]);
        let found = solve_at_one(&pencil);

        assert_eq!(found.cones.len(), 1, "{row:?}");
        let cone = &found.cones[0];
        assert_eq!(cone.dimension, 2);
        assert_eq!(cone.lineality.len(), 1);
        assert_eq!(cone.rays.len(), 1);

        let mut line = cone.lineality[0].iter();
        let pivot = line.position(|p| *p != Poly::default()).unwrap();
        let x = &cone.rays[0].x;
        assert_eq!(x[pivot], Poly::default(), "{row:?}: {x:?}");
        assert!(is_solution(&pencil, &integer(1), x), "{row:?}: {x:?}");
    }
}

/// Three free variables with y_3 = x_0 - x_1 and y_4 = x_1 - x_2: a wedge of two rays beside the
/// line (1, 1, 1), by which each ray is reduced.
#[test]
fn rays_of_a_wedge_are_reduced_by_its_line() {
    let pencil = pencil(
        &[
            &[-1, 0, 0, 1, 1],
            &[0, -1, 0, 0, 0],
            &[0, 0, -1, 0, 0],
            &[1, -1, 0, 1, 0],
            &[0, 1, -1, 0, 1],
        ],
        &[
            &[1, 0, 0, 0, 0],
            &[0, 1, 0, 0, 0],
            &[0, 0, 1, 0, 0],
            &[0, 0, 0, 0, 0],
            &[0, 0, 0, 0, 0],
        ],
        &[0, 1, 2],
    );

    let found = solve_at_one(&pencil);

    assert_eq!(found.cones.len(), 1);
    let cone = &found.cones[0];
    assert_eq!(cone.lineality.len(), 1);
    assert_eq!(cone.rays.len(), 2);
    for ray in &cone.rays {
        assert_eq!(ray.x[0], Poly::default(), "{:?}", ray.x);
        assert!(is_solution(&pencil, &integer(1), &ray.x), "{:?}", ray.x);
    }
}

/// Enumerates a problem of this size up to the first support; returns how many were done.
fn supports_done_at_once(slip_count: usize, free_count: usize) -> Result<u64, OracleError> {
    let identity = Sparse::identity(slip_count + free_count);
    let free = (0..free_count).collect();
    let pencil = Pencil::new(identity.clone(), identity, free).unwrap();

    let answer = enumerate_with(&pencil, &Window::all(), |_, _| ControlFlow::Break(()))?;
    Ok(answer.supports_done)
}

fn too_large(what: &'static str, limit: usize) -> OracleError {
    OracleError::TooLarge {
        what,
        limit: limit as u64,
        got: limit as u64 + 1,
    }
}

/// The largest problems are taken on, and left at the first word; one variable more is refused.
#[test]
fn limits_are_allowed_and_no_more() {
    assert_eq!(supports_done_at_once(MAX_SLIP, 1), Ok(1));
    assert_eq!(supports_done_at_once(1, MAX_FREE), Ok(1));

    let slip_refused = supports_done_at_once(MAX_SLIP + 1, 0);
    assert_eq!(slip_refused, Err(too_large("slip variables", MAX_SLIP)));
    let free_refused = supports_done_at_once(0, MAX_FREE + 1);
    assert_eq!(free_refused, Err(too_large("free variables", MAX_FREE)));
}

/// The supports of the solutions of a run that is broken off after so many supports.
fn solved_supports_after(pencil: &Pencil, count: u64) -> Vec<Vec<usize>> {
    let stop = |done: u64, _| {
        if done == count {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let answer = enumerate_with(pencil, &Window::all(), stop).unwrap();

    let mut supports = Vec::new();
    for solution in answer.solutions {
        supports.push(solution.slip);
    }
    supports
}

/// -I + tI: each support has its own solution or cone; a run that is broken off keeps those of the
/// first supports.
#[test]
fn supports_are_counted_in_binary() {
    let pencil = pencil(&[&[-1, 0], &[0, -2]], &[&[1, 0], &[0, 1]], &[]);
    let none: [Vec<usize>; 0] = [];
    assert_eq!(solved_supports_after(&pencil, 1), none);
    assert_eq!(solved_supports_after(&pencil, 2), [vec![0]]);
    assert_eq!(solved_supports_after(&pencil, 3), [vec![0], vec![1]]);

    let mut found = Enumeration::default();
    examine_support(&pencil, &[1], &Window::all(), &mut found);
    assert_eq!(found.solutions.len(), 1);
    assert_eq!(found.solutions[0].slip, [1]);
}

/// (t - 1) (x_0 + x_1) on row 0: both move at t = 1 only, where the kernel is wide; a zero column
/// moves from there on.
#[test]
fn a_wide_kernel_at_one_value_of_a_singular_support_is_named() {
    let pencil = pencil(&[&[-1, -1], &[0, 0]], &[&[1, 1], &[0, 0]], &[]);

    let found = enumerate(&pencil, &Window::all()).unwrap();

    assert!(found.is_complete_list());
    assert_eq!(found.wide.len(), 1);
    assert_eq!(found.wide[0].support, [0, 1]);
    assert_eq!(found.wide[0].dimension, 2);
    assert_eq!(found.cones.len(), 1);
    assert_eq!(found.ranges.len(), 1);
}

/// A matrix of order 15 with entries in the rows from 6 on and the columns before 6.
fn matrix_of_6_moving_and_9_resting() -> Sparse {
    let order = 15;
    let moving = 6;
    let mut rows = vec![vec![0; order]; order];

    for i in moving..order {
        for j in 0..moving {
            let hash = i * i + 3 * i * j + j * j * j;
            rows[i][j] = (hash % 17) as i64 - 8;
        }
    }
    sparse(&rows)
}

/// Examines one support of the constant pencil A and describes what was met.
fn describe_support(a: Sparse, support: &[usize]) -> Enumeration {
    let zero = Sparse::zeros(a.rows(), a.cols());
    let pencil = Pencil::new(a, zero, vec![]).unwrap();

    let mut found = Enumeration::default();
    examine_support(&pencil, support, &Window::all(), &mut found);
    found.describe(&pencil, &Window::all());
    found
}

/// 6 moving variables and 9 resting rows, nothing else: C(15, 6) minors are too many, and that is
/// said.
#[test]
fn too_many_minors_are_named_with_their_number() {
    let large = matrix_of_6_moving_and_9_resting();
    // Four columns and the six first resting rows below them.
    let rows: Vec<usize> = (2..12).collect();
    let columns: Vec<usize> = (0..10).collect();
    let small = large.submatrix(&rows, &columns);

    let found = describe_support(large, &[0, 1, 2, 3, 4, 5]);
    assert_eq!(found.undescribed.len(), 1);
    assert_eq!(found.undescribed[0].minors, 5005);
    assert_eq!(found.undescribed[0].limit, 4096);

    // C(10, 4) = 210 are not too many.
    let found = describe_support(small, &[0, 1, 2, 3]);
    assert!(found.undescribed.is_empty());
    assert_eq!(found.described, (0, 1));
}

fn undescribed_support() -> Undescribed {
    Undescribed {
        support: vec![0],
        minors: 9000,
        limit: 4096,
    }
}

/// Fails if the answer stays a complete list when it is changed.
fn assert_incomplete(complete: &Enumeration, change: impl Fn(&mut Enumeration)) {
    let mut answer = complete.clone();
    change(&mut answer);
    assert!(!answer.is_complete_list());
}

fn answer_with_described(described: (usize, usize)) -> Enumeration {
    Enumeration {
        described,
        ..Enumeration::default()
    }
}

/// Finished, everything met described, nothing left out: all three, and merged parts add what they
/// have described.
#[test]
fn a_complete_list_is_finished_and_described() {
    let zero = zero_pencil();
    let complete = enumerate(&zero, &Window::all()).unwrap();
    assert!(complete.is_complete_list());
    assert!(!complete.continua.is_empty());

    // One of the three missing.
    assert_incomplete(&complete, |answer| answer.supports_total = 8);
    assert_incomplete(&complete, |answer| answer.described = (0, 0));
    assert_incomplete(&complete, |answer| {
        answer.undescribed = vec![undescribed_support()];
    });

    // Two of the three missing.
    assert_incomplete(&complete, |answer| {
        answer.supports_total = 8;
        answer.described = (0, 0);
    });
    assert_incomplete(&complete, |answer| {
        answer.described = (0, 0);
        answer.undescribed = vec![undescribed_support()];
    });
    assert_incomplete(&complete, |answer| {
        answer.supports_total = 8;
        answer.undescribed = vec![undescribed_support()];
    });

    let first = answer_with_described((2, 3));
    let second = answer_with_described((5, 7));
    assert_eq!(Enumeration::merge([first, second]).described, (7, 10));

    let mut by_hand = Enumeration {
        continua: complete.continua.clone(),
        supports_done: 4,
        supports_total: 4,
        ..Enumeration::default()
    };
    assert!(!by_hand.is_complete_list());
    by_hand.describe(&zero, &Window::all());
    assert!(by_hand.is_complete_list());
    assert_eq!(by_hand, complete);
}

fn wide_kernel(value: i64, support: &[usize], dimension: usize) -> WideKernel {
    WideKernel {
        value: integer(value),
        support: support.to_vec(),
        dimension,
    }
}

/// The dimension of the kernel of the solution with this value and support.
fn dimension(answer: &Enumeration, value: i64, slip: &[usize]) -> usize {
    let solution = solution(value, slip, &[1, 1]);
    answer.kernel_dimension(&solution)
}

#[test]
fn the_kernel_of_a_solution_is_that_of_its_support_and_value() {
    let answer = Enumeration {
        wide: vec![
            wide_kernel(1, &[0, 1], 2),
            wide_kernel(2, &[0], 3),
            wide_kernel(1, &[0], 4),
        ],
        ..Enumeration::default()
    };

    assert_eq!(dimension(&answer, 1, &[0, 1]), 2);
    assert_eq!(dimension(&answer, 2, &[0]), 3);
    assert_eq!(dimension(&answer, 1, &[0]), 4);

    // No wide kernel has both this value and this support.
    assert_eq!(dimension(&answer, 2, &[0, 1]), 1);
    assert_eq!(dimension(&answer, 3, &[0]), 1);
    assert_eq!(dimension(&answer, 1, &[1]), 1);
}

/// The pencil of one support and of the free variables alone, as (24) has it.
struct WithoutStick {
    pencil: Pencil,
    /// The indices of its variables in the whole pencil.
    kept: Vec<usize>,
}

impl WithoutStick {
    fn of(whole: &Pencil, support: &[usize]) -> WithoutStick {
        let mut kept = [support, whole.free()].concat();
        kept.sort_unstable();

        let mut free = Vec::new();
        for (position, index) in kept.iter().enumerate() {
            if whole.free().contains(index) {
                free.push(position);
            }
        }
        let a = whole.a().submatrix(&kept, &kept);
        let b = whole.b().submatrix(&kept, &kept);
        let pencil = Pencil::new(a, b, free).unwrap();

        WithoutStick { pencil, kept }
    }
}

/// A value and a vector of the whole pencil that solve it.
struct Pair {
    value: Algebraic,
    x: Vec<Poly>,
}

/// The solutions of the linear eigenproblem (25) of one support with x_s > 0 that also meet the
/// inequalities (26) of the whole pencil.
fn solutions_of_support(whole: &Pencil, support: &[usize]) -> Vec<Pair> {
    let smaller = WithoutStick::of(whole, support);
    let answer = enumerate(&smaller.pencil, &Window::all()).unwrap();
    let mut list = Vec::new();

    for solution in answer.solutions {
        let belongs_to_smaller_support = solution.slip.len() < support.len();
        if belongs_to_smaller_support {
            continue;
        }

        let mut x = vec![Poly::default(); whole.order()];
        for (position, &index) in smaller.kept.iter().enumerate() {
            x[index] = solution.x[position].clone();
        }
        if is_solution(whole, &solution.value, &x) {
            let value = solution.value;
            list.push(Pair { value, x });
        }
    }
    list
}

/// All subsets but the empty one.
fn nonempty_subsets(set: &[usize]) -> Vec<Vec<usize>> {
    let mut subsets = Vec::new();
    for pattern in 1..1_usize << set.len() {
        let chosen = (0..set.len()).filter(|k| pattern >> k & 1 == 1);
        subsets.push(chosen.map(|k| set[k]).collect());
    }
    subsets
}

/// (24): what sticks is left out. The solutions of a pencil are those of its supports, each found
/// in the pencil without the other complementarity variables, with y >= 0 there.
#[test]
fn stick_variables_are_left_out() {
    let all_slip = pencil(
        &[&[-3, 1, 0], &[1, -2, 1], &[0, 1, -4]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[],
    );
    let with_a_free_variable = pencil(
        &[&[2, -3, -1], &[-3, 1, 0], &[-1, 2, -3]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[0],
    );
    let of_order_4 = pencil(
        &[
            &[-2, 1, 3, 0],
            &[1, -5, 1, 2],
            &[3, 1, -2, 1],
            &[0, 2, 1, -1],
        ],
        &[&[1, 0, 0, 0], &[0, 2, 0, 0], &[0, 0, 1, 0], &[0, 0, 0, 1]],
        &[],
    );
    let mut with_stick = 0;

    for pencil in [all_slip, with_a_free_variable, of_order_4] {
        let answer = enumerate(&pencil, &Window::all()).unwrap();
        let slip = pencil.slip();
        let mut found = 0;

        for support in nonempty_subsets(&slip) {
            for pair in solutions_of_support(&pencil, &support) {
                let is_held = answer.contains(&pencil, &pair.value, &pair.x);
                assert!(is_held, "{support:?}");
                found += 1;
                with_stick += usize::from(support.len() < slip.len());
            }
        }

        assert_eq!(found, answer.solutions.len());
    }
    assert!(with_stick > 3, "{with_stick}");
}
