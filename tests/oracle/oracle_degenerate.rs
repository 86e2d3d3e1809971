//! Degenerate pencils: cones, ranges of values of singular supports, solutions of free variables
//! alone.
//!
//! The truth is worked by hand for each pencil A + t B, and the working stands beside it. A cone
//! listed twice, an end of a range open instead of closed, or a ray lost beside a line gives
//! another list than the one written down.

use crate::small::{constants, integer, pencil};
use mceip_exact::{
    Algebraic, Poly, Rational, Sparse, nonnegative_roots, rational, to_decimal, whole,
};
use mceip_model::{Pencil, Window};
use mceip_oracle::{
    Cone, Enumeration, SupportRange, ValueInterval, enumerate, is_rational_solution, is_solution,
};

/// (t - 1) I of order 3.
fn shifted_identity(free: &[usize]) -> Pencil {
    pencil(
        &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -1]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        free,
    )
}

/// The complete answer on the whole half line.
fn solve(pencil: &Pencil) -> Enumeration {
    let found = enumerate(pencil, &Window::all()).unwrap();
    assert!(found.is_complete_list());
    found
}

fn decimal(value: &Algebraic, digits: usize) -> String {
    let identity = Poly::from_ints(&[0, 1]);
    to_decimal(&mut value.clone(), &identity, digits)
}

/// "[1, 2)" and the like, five digits.
fn interval_text(piece: &ValueInterval) -> String {
    let from = match &piece.from {
        None => "(-inf".into(),
        Some(from) if from.included => format!("[{}", decimal(&from.value, 5)),
        Some(from) => format!("({}", decimal(&from.value, 5)),
    };
    let to = match &piece.to {
        None => "inf)".into(),
        Some(to) if to.included => format!("{}]", decimal(&to.value, 5)),
        Some(to) => format!("{})", decimal(&to.value, 5)),
    };
    format!("{from}, {to}")
}

fn intervals(range: &SupportRange) -> Vec<String> {
    range.pieces.iter().map(interval_text).collect()
}

/// Fails unless these are all ranges, each of one piece.
fn assert_ranges(answer: &Enumeration, expected: &[(&[usize], &str)]) {
    assert_eq!(answer.ranges.len(), expected.len());
    for (range, (support, interval)) in answer.ranges.iter().zip(expected) {
        assert_eq!(range.support, *support);
        assert_eq!(intervals(range), [*interval]);
    }
}

/// A solution by its value in decimals, its support and its biactive set.
#[derive(Debug, PartialEq)]
struct Row {
    value: String,
    slip: Vec<usize>,
    biactive: Vec<usize>,
}

fn row(value: &str, slip: &[usize], biactive: &[usize]) -> Row {
    Row {
        value: value.into(),
        slip: slip.to_vec(),
        biactive: biactive.to_vec(),
    }
}

fn rows(answer: &Enumeration) -> Vec<Row> {
    let mut rows = Vec::new();
    for solution in &answer.solutions {
        rows.push(row(
            &solution.decimal(6),
            &solution.slip,
            &solution.biactive,
        ));
    }
    rows
}

/// -I + tI: at t = 1 the whole octant; its faces are not listed again.
#[test]
fn a_cone_is_listed_once_and_its_faces_are_not() {
    let pencil = shifted_identity(&[]);
    let found = solve(&pencil);

    assert_eq!(found.solutions.len(), 3);
    assert_eq!(found.cones.len(), 1);
    assert_eq!(found.wide.len(), 4);

    let cone = &found.cones[0];
    assert_eq!(cone.slip, [0, 1, 2]);
    assert_eq!(cone.dimension, 3);
    assert_eq!(cone.kernel_dimension, 3);
    assert_eq!(cone.rays, found.solutions);

    let one = integer(1);
    assert!(found.contains(&pencil, &one, &constants(&[3, 0, 5])));
    assert!(found.contains(&pencil, &one, &constants(&[0, 7, 0])));
    assert!(!found.contains(&pencil, &one, &constants(&[3, -1, 5])));
    assert!(!found.contains(&pencil, &one, &constants(&[0, 0, 0])));

    let all = [0, 1, 2];
    let center = cone.center(&all).x_decimals(&all, 5);
    assert_eq!(center, ["0.33333", "0.33333", "0.33333"]);
}

/// The factor times the value t itself.
fn times_value(factor: i64) -> Poly {
    Poly::from_ints(&[0, factor])
}

/// The adjacency matrix of a path of seven vertices, minus t I.
fn path_of_7() -> Pencil {
    let order = 7;
    let mut adjacency = Vec::new();
    let mut minus_identity = Vec::new();

    for i in 0..order {
        minus_identity.push((i, i, whole(-1)));
        if i + 1 < order {
            adjacency.push((i, i + 1, whole(1)));
            adjacency.push((i + 1, i, whole(1)));
        }
    }
    let a = Sparse::from_entries(order, order, adjacency);
    let b = Sparse::from_entries(order, order, minus_identity);
    Pencil::new(a, b, vec![]).unwrap()
}

/// A path of seven vertices: at sqrt 2 the two ends of three vertices each span a cone, biactive
/// between.
#[test]
fn an_irrational_cone() {
    let pencil = path_of_7();
    let found = solve(&pencil);

    // One solution for each sub-path.
    assert_eq!(found.solutions.len(), 28);

    let mut at_root_2 = Vec::new();
    for cone in &found.cones {
        if decimal(&cone.value, 6) == "1.41421" {
            at_root_2.push(cone);
        }
    }
    assert_eq!(at_root_2.len(), 1);
    let cone = at_root_2[0];
    assert_eq!(cone.slip, [0, 1, 2, 4, 5, 6]);
    assert!(cone.biactive.is_empty());
    assert_eq!(cone.dimension, 2);
    assert_eq!(cone.rays.len(), 2);
    assert_eq!(cone.rays[0].slip, [0, 1, 2]);
    assert_eq!(cone.rays[1].slip, [4, 5, 6]);

    // (1, sqrt 2, 1, 0, 2, 2 sqrt 2, 2) is inside; with 3 sqrt 2 it is not even a solution.
    let root_2 = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
    let mut x = constants(&[1, 0, 1, 0, 2, 0, 2]);
    x[1] = times_value(1);
    x[5] = times_value(2);
    assert!(is_solution(&pencil, &root_2, &x));
    assert!(found.contains(&pencil, &root_2, &x));

    x[5] = times_value(3);
    assert!(!is_solution(&pencil, &root_2, &x));
    assert!(!found.contains(&pencil, &root_2, &x));
}

/// The kernel on {0, 1} has two dimensions at t = 1; y_2 = x_0 - x_1, and y_3 has this row.
fn solve_with_row_3_at_one(row_3: &[i64]) -> Enumeration {
    let pencil = pencil(
        &[&[-1, 0, 1, 1], &[0, -1, 1, 1], &[1, -1, 9, 0], row_3],
        &[&[1, 0, 0, 0], &[0, 1, 0, 0], &[0, 0, 0, 0], &[0, 0, 0, 0]],
        &[],
    );
    let at_one = Window::new(whole(1), Some(whole(1))).unwrap();
    enumerate(&pencil, &at_one).unwrap()
}

/// The kernel on {0, 1} has two dimensions at t = 1, but y_2 = x_0 - x_1 and y_3 = x_1 - x_0 leave
/// one ray.
#[test]
fn a_wide_kernel_with_one_ray_is_an_ordinary_solution() {
    let found = solve_with_row_3_at_one(&[-1, 1, 0, 9]);
    assert_eq!(rows(&found), [row("1", &[0, 1], &[2, 3])]);
    assert!(found.cones.is_empty());
    assert!(found.is_plain_list());
    assert_eq!(found.kernel_dimension(&found.solutions[0]), 2);

    // With y_3 = x_1 - 2 x_0 instead nothing is left.
    let nothing = solve_with_row_3_at_one(&[-2, 1, 0, 9]);
    assert!(nothing.solutions.is_empty());
}

/// {0, 1} has the rows (1, t - 2) and (2, 2t - 4).
/// Its solution is x = (2 - t, 1), while t < 2 and y_2 >= 0.
///
/// y_2 = (p_0 + p_1 t) x_0 + (q_0 + q_1 t) x_1 for `of_x_0` = p and `of_x_1` = q.
/// The third column keeps x_2 = 0: without it {0, 1, 2} is singular too.
fn singular_pencil(of_x_0: [i64; 2], of_x_1: [i64; 2]) -> Pencil {
    pencil(
        &[&[1, -2, 1], &[2, -4, 3], &[of_x_0[0], of_x_1[0], 9]],
        &[&[0, 1, 0], &[0, 2, 0], &[of_x_0[1], of_x_1[1], 0]],
        &[],
    )
}

#[test]
fn ranges_have_open_and_closed_and_irrational_ends() {
    // y_2 = (t - 1)(2 - t)
    let found = solve(&singular_pencil([-1, 1], [0, 0]));
    assert_ranges(&found, &[(&[0, 1], "[1, 2)")]);
    // At t = 2 the vector (0, 1) of the smaller support {1} takes over.
    assert_eq!(rows(&found), [row("2", &[1], &[0, 2])]);

    // y_2 = t (2 - t) - 1/2 (times 2): [1 - sqrt(1/2), 1 + sqrt(1/2)]
    let found = solve(&singular_pencil([0, 2], [-1, 0]));
    assert_eq!(intervals(&found.ranges[0]), ["[0.29289, 1.7071]"]);

    // y_2 = (t - 1) (t - 3/2) (times 2) = 2 (t^2 - 5/2 t + 3/2) = (2 - t)(1 - 2t) + 1
    let found = solve(&singular_pencil([1, -2], [1, 0]));
    assert_eq!(intervals(&found.ranges[0]), ["[0, 1]", "[1.5, 2)"]);
}

#[test]
fn what_exists_at_one_value_of_a_singular_support_is_an_ordinary_solution() {
    // y_2 = t (2 - t) - 1 = -(t - 1)^2
    let pencil = singular_pencil([0, 1], [-1, 0]);
    let found = solve(&pencil);

    assert!(found.ranges.is_empty());
    assert_eq!(found.continua, [vec![0, 1]]);
    // The kernel at t = 1 has dimension 1.
    assert!(found.wide.is_empty());
    assert_eq!(rows(&found), [row("1", &[0, 1], &[2])]);
    assert_eq!(found.solutions[0].multiplicity, 0);
    let x = [whole(1), whole(1), whole(0)];
    assert!(is_rational_solution(&pencil, &whole(1), &x));

    // With a little less nothing is left: y_2 = t (2 - t) - 1.001, times 1000.
    let slightly_less = solve(&singular_pencil([0, 1000], [-1001, 0]));
    assert!(slightly_less.solutions.is_empty());
}

/// The pieces of the first range within a window, if there is one.
fn first_range_within(pencil: &Pencil, min: Rational, max: Rational) -> Option<Vec<String>> {
    let window = Window::new(min, Some(max)).unwrap();
    let found = enumerate(pencil, &window).unwrap();
    found.ranges.first().map(intervals)
}

#[test]
fn windows_cut_ranges_and_keep_touching_points() {
    // The range is [1, 2).
    let pencil = singular_pencil([-1, 1], [0, 0]);

    let cut = first_range_within(&pencil, rational(3, 2), whole(5));
    assert_eq!(cut, Some(vec!["[1.5, 2)".to_string()]));

    // At one value there is a solution, and no range.
    for (min, max, value) in [
        (whole(0), whole(1), "1"),
        (rational(5, 4), rational(5, 4), "1.25"),
    ] {
        let window = Window::new(min, Some(max)).unwrap();
        let found = enumerate(&pencil, &window).unwrap();
        assert!(found.ranges.is_empty() && found.is_complete_list());
        let values: Vec<String> = found.solutions.iter().map(|s| s.decimal(9)).collect();
        assert_eq!(values, [value]);
    }

    let missed = first_range_within(&pencil, whole(2), whole(3));
    assert_eq!(missed, None);
}

/// A range of which the window holds one value is a solution, at 0 as at any other end of a window.
/// It was listed as a range, with no solution: "0 solutions: complete".
#[test]
fn a_range_that_only_touches_zero_is_a_solution() {
    // {0}: 0 x_0 = 0 for every t; y_1 = -t x_0 >= 0 for t <= 0 only.
    let found = solve(&pencil(&[&[0, 1], &[0, 1]], &[&[0, 0], &[-1, 0]], &[]));
    assert_ranges(&found, &[]);
    assert_eq!(rows(&found), [row("0", &[0], &[1])]);

    // {0, 1}: x = (1, t), y_2 = -t x_1: nothing but t = 0 is left, where the support is {0}
    // because x_1 = t vanishes.
    let found = solve(&pencil(
        &[&[0, -1, 1], &[0, -2, 3], &[0, 0, 1]],
        &[&[1, 0, 0], &[2, 0, 0], &[0, -1, 0]],
        &[],
    ));
    assert!(found.ranges.is_empty());
    assert_eq!(rows(&found), [row("0", &[0], &[1, 2])]);
}

/// Kernel of dimension 2 for every t: for t > 1 there are x_0, x_1 > 0 with
/// y_2 = (t - 1) x_0 - x_1 >= 0.
#[test]
fn a_singular_support_of_higher_dimension() {
    let pencil = pencil(
        &[&[0, 0, 1], &[0, 0, 1], &[-1, -1, 9]],
        &[&[0, 0, 0], &[0, 0, 0], &[1, 0, 0]],
        &[],
    );
    let found = solve(&pencil);

    assert_ranges(&found, &[(&[0], "[1, inf)"), (&[0, 1], "(1, inf)")]);
    assert!(found.solutions.is_empty());

    let two = integer(2);
    assert!(found.contains(&pencil, &two, &constants(&[3, 2, 0])));
    assert!(!found.contains(&pencil, &two, &constants(&[2, 3, 0])));

    let one = integer(1);
    assert!(found.contains(&pencil, &one, &constants(&[1, 0, 0])));
    assert!(!found.contains(&pencil, &one, &constants(&[1, 1, 0])));
}

/// Nothing but zeros: every support at every value.
#[test]
fn the_zero_pencil() {
    let zero: &[&[i64]] = &[&[0, 0], &[0, 0]];
    let everywhere = "[0, inf)";

    let found = solve(&pencil(zero, zero, &[]));
    assert_ranges(
        &found,
        &[
            (&[0], everywhere),
            (&[0, 1], everywhere),
            (&[1], everywhere),
        ],
    );

    // All free: x_f arbitrary for every t, outside the propositions.
    let found = solve(&pencil(zero, zero, &[0, 1]));
    assert_ranges(&found, &[(&[], everywhere)]);
    assert!(found.is_outside_propositions());
}

/// Free variables whose K_ff is not definite: at t = 1 the plane of two free variables is a
/// subspace of solutions, and with the slip variable a half-space.
#[test]
fn free_only_solutions_and_lineality() {
    let found = solve(&shifted_identity(&[0, 1]));
    assert!(found.is_outside_propositions());
    assert!(found.solutions.is_empty());
    assert_eq!(found.cones.len(), 1);
    let half_space = &found.cones[0];
    assert_eq!(half_space.slip, [2]);
    assert_eq!(half_space.dimension, 3);
    assert_eq!(half_space.rays.len(), 1);
    assert_eq!(half_space.lineality.len(), 2);

    // One free variable with y_1 = x_0: only x_0 >= 0; with y_1 = 0 both signs.
    let one_sided = solve(&pencil(&[&[-1, 0], &[1, 5]], &[&[1, 0], &[0, 0]], &[0]));
    assert_eq!(rows(&one_sided), [row("1", &[], &[]), row("1", &[1], &[])]);
    assert!(one_sided.solutions[0].is_free_only());
    assert!(!one_sided.solutions[1].is_free_only());

    // x_f and -x_f, and the half-plane.
    let both = solve(&pencil(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0]));
    assert_eq!(both.solutions.len(), 2);
    assert_eq!(both.cones.len(), 1);
    let half_plane = &both.cones[0];
    assert_eq!(half_plane.rays.len(), 1);
    assert_eq!(half_plane.lineality.len(), 1);

    // Admissible pencils have none of it.
    let admissible = solve(&pencil(&[&[1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0]));
    assert!(!admissible.is_outside_propositions());
}

/// lambda^2 = 0 with a kernel of dimension 2 there: gamma is free, x is a cone.
#[test]
fn value_zero_is_a_value_like_others() {
    let found = solve(&pencil(
        &[&[1, -1, 0], &[-1, 1, 0], &[0, 0, 0]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[],
    ));

    let expected = [row("0", &[0, 1], &[2]), row("0", &[2], &[0, 1])];
    assert_eq!(rows(&found), expected);
    assert_eq!(found.cones.len(), 1);
    assert_eq!(found.cones[0].slip, [0, 1, 2]);
}

/// The matrix of order 3 with row i multiplied by `factor` (i + 1).
fn with_scaled_rows(rows: &[&[i64]], factor: i64) -> Sparse {
    let mut entries = Vec::new();
    for i in 0..3 {
        let factor_of_row = factor * (i as i64 + 1);
        for j in 0..3 {
            entries.push((i, j, whole(factor_of_row * rows[i][j])));
        }
    }
    Sparse::from_entries(3, 3, entries)
}

/// Equality is by value: other polynomials and scales for the same numbers do not matter.
#[test]
fn equality_is_exact_and_blind_to_scale() {
    let a: &[&[i64]] = &[&[0, 1, 0], &[1, 0, 1], &[0, 1, 0]];
    let minus_identity: &[&[i64]] = &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -1]];
    let answer = solve(&pencil(a, minus_identity, &[]));
    // {0, 2} at t = 0.
    assert_eq!(answer.cones.len(), 1);

    let scaled_a = with_scaled_rows(a, 7);
    let scaled_b = with_scaled_rows(minus_identity, 7);
    let scaled = solve(&Pencil::new(scaled_a, scaled_b, vec![]).unwrap());
    assert_eq!(answer, scaled);

    let other_a: &[&[i64]] = &[&[0, 1, 0], &[2, 0, 1], &[0, 1, 0]];
    let other = solve(&pencil(other_a, minus_identity, &[]));
    assert_ne!(answer, other);

    let mut without_cones = answer.clone();
    without_cones.cones.clear();
    assert_ne!(answer, without_cones);

    let mut with_opposite_vector = answer.clone();
    for component in &mut with_opposite_vector.solutions[0].x {
        *component = -&*component;
    }
    assert_ne!(answer, with_opposite_vector);
}

/// An answer put together from the answers of parts is the same; a face known to one part only
/// goes.
#[test]
fn merged_parts_are_the_whole() {
    let answer = solve(&shifted_identity(&[]));

    let mut second = Enumeration {
        supports_total: 8,
        supports_done: 3,
        ..Enumeration::default()
    };
    let mut first = answer.clone();
    first.supports_done = 5;
    second.solutions = first.solutions.split_off(1);
    second.cones = first.cones.split_off(0);
    let face = Cone {
        slip: vec![0, 1],
        biactive: vec![2],
        dimension: 2,
        ..second.cones[0].clone()
    };
    first.cones.push(face);

    let merged = Enumeration::merge([second, first]);

    assert_eq!(merged, answer);
    assert!(merged.is_complete_list());
}
