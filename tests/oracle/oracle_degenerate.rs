//! Degenerate cases worked by hand: cones, ranges of values of singular supports, free-only
//! solutions.

use mceip_exact::{Algebraic, Poly, Sparse, nonnegative_roots, rational, to_decimal, whole};
use mceip_model::{Pencil, Window};
use mceip_oracle::{
    Cone, End, Enumeration, SupportRange, enumerate, is_rational_solution, is_solution,
};

fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
    Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
}

fn all(p: &Pencil) -> Enumeration {
    let found = enumerate(p, &Window::all()).unwrap();
    assert!(found.is_complete_list());
    found
}

/// "[1, 2)" and the like, five digits.
fn intervals(r: &SupportRange) -> Vec<String> {
    let number = |e: &End| to_decimal(&mut e.value.clone(), &Poly::from_ints(&[0, 1]), 5);
    let text = |p: &mceip_oracle::Piece| {
        let from = format!(
            "{}{}",
            if p.from.included { "[" } else { "(" },
            number(&p.from)
        );
        match &p.to {
            Some(to) => format!(
                "{from}, {}{}",
                number(to),
                if to.included { "]" } else { ")" }
            ),
            None => format!("{from}, inf)"),
        }
    };
    r.pieces.iter().map(text).collect()
}

fn ranges(e: &Enumeration) -> Vec<(Vec<usize>, Vec<String>)> {
    e.ranges
        .iter()
        .map(|r| (r.support.clone(), intervals(r)))
        .collect()
}

fn supports(e: &Enumeration) -> Vec<(String, Vec<usize>, Vec<usize>)> {
    e.solutions
        .iter()
        .map(|s| (s.decimal(6), s.slip.clone(), s.biactive.clone()))
        .collect()
}

/// -I + tI: at t = 1 the whole octant; its faces are not listed again.
#[test]
fn a_cone_is_listed_once_and_its_faces_are_not() {
    let p = pencil(
        &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -1]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[],
    );
    let found = all(&p);
    assert_eq!(
        (found.solutions.len(), found.cones.len(), found.wide.len()),
        (3, 1, 4)
    );
    let cone = &found.cones[0];
    assert_eq!(
        (cone.slip.clone(), cone.dimension, cone.kernel_dimension),
        (vec![0, 1, 2], 3, 3)
    );
    assert_eq!(cone.rays, found.solutions);
    let one = Algebraic::rational(whole(1));
    let constant = |v: [i64; 3]| v.map(|c| Poly::from_ints(&[c]));
    assert!(
        found.contains(&p, &one, &constant([3, 0, 5]))
            && found.contains(&p, &one, &constant([0, 7, 0]))
    );
    assert!(
        !found.contains(&p, &one, &constant([3, -1, 5]))
            && !found.contains(&p, &one, &constant([0, 0, 0]))
    );
    assert_eq!(
        cone.center(&[0, 1, 2]).x_decimals(&[0, 1, 2], 5),
        ["0.33333", "0.33333", "0.33333"]
    );
}

/// A path of seven vertices: at sqrt 2 the two ends of three vertices each span a cone, biactive
/// between.
#[test]
fn an_irrational_cone() {
    let adjacency: Vec<Vec<i64>> = (0..7i64)
        .map(|i| (0..7i64).map(|j| i64::from((i - j).abs() == 1)).collect())
        .collect();
    let minus: Vec<Vec<i64>> = (0..7)
        .map(|i| (0..7).map(|j| -i64::from(i == j)).collect())
        .collect();
    let rows = |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(|r| &r[..]).collect::<Vec<_>>());
    let p = Pencil::new(rows(&adjacency), rows(&minus), vec![]).unwrap();
    let found = all(&p);
    assert_eq!(found.solutions.len(), 28); // sub-paths
    let at_root_2: Vec<_> = found
        .cones
        .iter()
        .filter(|c| to_decimal(&mut c.value.clone(), &Poly::from_ints(&[0, 1]), 6) == "1.41421")
        .collect();
    assert_eq!(at_root_2.len(), 1);
    let cone = at_root_2[0];
    assert_eq!(
        (cone.slip.clone(), cone.biactive.clone(), cone.dimension),
        (vec![0, 1, 2, 4, 5, 6], vec![], 2)
    );
    let supports: Vec<_> = cone.rays.iter().map(|r| r.slip.clone()).collect();
    assert_eq!(supports, [vec![0, 1, 2], vec![4, 5, 6]]);
    // (1, sqrt 2, 1, 0, 2, 2 sqrt 2, 2) is inside; with 3 sqrt 2 it is not even a solution.
    let root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
    let x = |c: i64| {
        [[1, 0], [0, 1], [1, 0], [0, 0], [2, 0], [0, c], [2, 0]].map(|v| Poly::from_ints(&v))
    };
    assert!(is_solution(&p, &root, &x(2)) && found.contains(&p, &root, &x(2)));
    assert!(!is_solution(&p, &root, &x(3)) && !found.contains(&p, &root, &x(3)));
}

/// The kernel on {0, 1} has two dimensions at t = 1, but y_2 = x_0 - x_1 and y_3 = x_1 - x_0 leave
/// one ray.
#[test]
fn a_wide_kernel_with_one_ray_is_an_ordinary_solution() {
    let a: &[&[i64]] = &[
        &[-1, 0, 1, 1],
        &[0, -1, 1, 1],
        &[1, -1, 9, 0],
        &[-1, 1, 0, 9],
    ];
    let b: &[&[i64]] = &[&[1, 0, 0, 0], &[0, 1, 0, 0], &[0, 0, 0, 0], &[0, 0, 0, 0]];
    let at_1 = Window::new(whole(1), Some(whole(1))).unwrap();
    let found = enumerate(&pencil(a, b, &[]), &at_1).unwrap();
    assert_eq!(supports(&found), [("1".into(), vec![0, 1], vec![2, 3])]);
    assert!(found.cones.is_empty() && found.is_plain_list());
    assert_eq!(found.kernel_dimension(&found.solutions[0]), 2);
    // With y_3 = x_1 - 2 x_0 instead nothing is left.
    let a: &[&[i64]] = &[
        &[-1, 0, 1, 1],
        &[0, -1, 1, 1],
        &[1, -1, 9, 0],
        &[-2, 1, 0, 9],
    ];
    assert!(
        enumerate(&pencil(a, b, &[]), &at_1)
            .unwrap()
            .solutions
            .is_empty()
    );
}

/// {0, 1} has the rows (1, t - 2) and (2, 2t - 4).
/// Its solution is x = (2 - t, 1), while t < 2 and y_2 >= 0.
///
/// The third column keeps x_2 = 0: without it {0, 1, 2} is singular too.
fn singular(row: [[i64; 2]; 2]) -> Pencil {
    pencil(
        &[&[1, -2, 1], &[2, -4, 3], &[row[0][0], row[1][0], 9]],
        &[&[0, 1, 0], &[0, 2, 0], &[row[0][1], row[1][1], 0]],
        &[],
    )
}

#[test]
fn ranges_have_open_and_closed_and_irrational_ends() {
    // y_2 = (t - 1)(2 - t)
    let found = all(&singular([[-1, 1], [0, 0]]));
    assert_eq!(ranges(&found), [(vec![0, 1], vec!["[1, 2)".to_string()])]);
    // At t = 2 the vector (0, 1) of the smaller support {1} takes over.
    assert_eq!(supports(&found), [("2".into(), vec![1], vec![0, 2])]);
    // y_2 = t (2 - t) - 1/2 (times 2): [1 - sqrt(1/2), 1 + sqrt(1/2)]
    let found = all(&singular([[0, 2], [-1, 0]]));
    assert_eq!(ranges(&found)[0].1, ["[0.29289, 1.7071]"]);
    // y_2 = (t - 1) (t - 3/2) (times 2) = 2 (t^2 - 5/2 t + 3/2) = (2 - t)(1 - 2t) + 1
    let found = all(&singular([[1, -2], [1, 0]]));
    assert_eq!(ranges(&found)[0].1, ["[0, 1]", "[1.5, 2)"]);
}

#[test]
fn what_exists_at_one_value_of_a_singular_support_is_an_ordinary_solution() {
    // y_2 = t (2 - t) - 1 = -(t - 1)^2
    let p = singular([[0, 1], [-1, 0]]);
    let found = all(&p);
    assert!(found.ranges.is_empty() && found.continua == vec![vec![0, 1]]);
    assert!(found.wide.is_empty()); // its kernel there has dimension 1
    assert_eq!(supports(&found), [("1".into(), vec![0, 1], vec![2])]);
    assert_eq!(found.solutions[0].multiplicity, 0);
    assert!(is_rational_solution(
        &p,
        &whole(1),
        &[whole(1), whole(1), whole(0)]
    ));
    // A hair lower and nothing is left: y_2 = t (2 - t) - 1.001.
    assert!(all(&singular([[0, 1000], [-1001, 0]])).solutions.is_empty());
}

#[test]
fn windows_cut_ranges_and_keep_touching_points() {
    let p = singular([[-1, 1], [0, 0]]); // [1, 2)
    let within = |lo, hi| {
        let found = enumerate(&p, &Window::new(lo, Some(hi)).unwrap()).unwrap();
        ranges(&found).first().map(|r| r.1.clone())
    };
    assert_eq!(
        within(rational(3, 2), whole(5)),
        Some(vec!["[1.5, 2)".into()])
    );
    assert_eq!(within(whole(0), whole(1)), Some(vec!["[1, 1]".into()]));
    assert_eq!(within(whole(2), whole(3)), None);
    assert_eq!(
        within(rational(5, 4), rational(5, 4)),
        Some(vec!["[1.25, 1.25]".into()])
    );
}

/// What is isolated does not depend on where the line is cut. Found by `shifting_moves_the_window`:
/// a range that ends at 0 from below was listed as a solution, one that ends at a window was not.
#[test]
fn a_range_that_only_touches_zero_is_no_isolated_solution() {
    // {0}: 0 x_0 = 0 for every t; y_1 = -t x_0 >= 0 for t <= 0 only.
    let found = all(&pencil(&[&[0, 1], &[0, 1]], &[&[0, 0], &[-1, 0]], &[]));
    assert_eq!(ranges(&found), [(vec![0], vec!["[0, 0]".to_string()])]);
    assert!(found.solutions.is_empty());
    // {0, 1}: x = (1, t), y_2 = -t x_1: nothing but t = 0 is left, where the support is {0}.
    let found = all(&pencil(
        &[&[0, -1, 1], &[0, -2, 3], &[0, 0, 1]],
        &[&[1, 0, 0], &[2, 0, 0], &[0, -1, 0]],
        &[],
    ));
    assert!(found.ranges.is_empty());
    assert_eq!(supports(&found), [("0".into(), vec![0], vec![1, 2])]); // x_1 = t vanishes there
}

/// Kernel of dimension 2 for every t: x_0, x_1 > 0 with y_2 = (t - 1) x_0 - x_1 >= 0 exist for t >
/// 1.
#[test]
fn a_singular_support_of_higher_dimension() {
    let p = pencil(
        &[&[0, 0, 1], &[0, 0, 1], &[-1, -1, 9]],
        &[&[0, 0, 0], &[0, 0, 0], &[1, 0, 0]],
        &[],
    );
    let found = all(&p);
    assert_eq!(
        ranges(&found),
        [
            (vec![0], vec!["[1, inf)".to_string()]),
            (vec![0, 1], vec!["(1, inf)".to_string()])
        ]
    );
    assert!(found.solutions.is_empty());
    let x = |v: [i64; 3]| v.map(|c| Poly::from_ints(&[c]));
    let at = |t: i64| Algebraic::rational(whole(t));
    assert!(
        found.contains(&p, &at(2), &x([3, 2, 0])) && !found.contains(&p, &at(2), &x([2, 3, 0]))
    );
    assert!(
        found.contains(&p, &at(1), &x([1, 0, 0])) && !found.contains(&p, &at(1), &x([1, 1, 0]))
    );
}

/// Nothing but zeros: every support at every value.
#[test]
fn the_zero_pencil() {
    let zero: &[&[i64]] = &[&[0, 0], &[0, 0]];
    let found = all(&pencil(zero, zero, &[]));
    assert_eq!(
        ranges(&found)
            .iter()
            .map(|r| r.0.clone())
            .collect::<Vec<_>>(),
        [vec![0], vec![0, 1], vec![1]]
    );
    assert!(found.ranges.iter().all(|r| intervals(r) == ["[0, inf)"]));
    // All free: x_f arbitrary for every t, outside the propositions.
    let found = all(&pencil(zero, zero, &[0, 1]));
    assert_eq!(ranges(&found), [(vec![], vec!["[0, inf)".to_string()])]);
    assert!(found.is_outside_propositions());
}

/// Free variables whose K_ff is not definite: at t = 1 the plane of two free variables is a
/// subspace of solutions, and with the slip variable a half-space.
#[test]
fn free_only_solutions_and_lineality() {
    let p = pencil(
        &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -1]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[0, 1],
    );
    let found = all(&p);
    assert!(found.is_outside_propositions() && found.solutions.is_empty());
    let cones: Vec<_> = found
        .cones
        .iter()
        .map(|c| (c.slip.clone(), c.dimension, c.rays.len(), c.lineality.len()))
        .collect();
    assert_eq!(cones, [(vec![2], 3, 1, 2)]);
    // One free variable with y_1 = x_0: only x_0 >= 0; with y_1 = 0 both signs.
    let one_sided = all(&pencil(&[&[-1, 0], &[1, 5]], &[&[1, 0], &[0, 0]], &[0]));
    assert_eq!(
        supports(&one_sided),
        [("1".into(), vec![], vec![]), ("1".into(), vec![1], vec![])]
    );
    assert!(one_sided.solutions[0].is_free_only() && !one_sided.solutions[1].is_free_only());
    let p = pencil(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0]);
    let both = all(&p);
    assert_eq!((both.solutions.len(), both.cones.len()), (2, 1)); // x_f and -x_f; the half-plane
    assert_eq!(
        (both.cones[0].rays.len(), both.cones[0].lineality.len()),
        (1, 1)
    );
    // Admissible pencils have none of it.
    let admissible = all(&pencil(&[&[1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0]));
    assert!(!admissible.is_outside_propositions());
}

/// lambda^2 = 0 with a kernel of dimension 2 there: gamma is free, x is a cone.
#[test]
fn value_zero_is_a_value_like_others() {
    let p = pencil(
        &[&[1, -1, 0], &[-1, 1, 0], &[0, 0, 0]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[],
    );
    let found = all(&p);
    assert_eq!(
        supports(&found),
        [
            ("0".into(), vec![0, 1], vec![2]),
            ("0".into(), vec![2], vec![0, 1])
        ]
    );
    assert_eq!(
        found
            .cones
            .iter()
            .map(|c| c.slip.clone())
            .collect::<Vec<_>>(),
        [vec![0, 1, 2]]
    );
}

/// Equality is by value: other polynomials and scales for the same numbers do not matter.
#[test]
fn equality_is_exact_and_blind_to_scale() {
    let (a, b): (&[&[i64]], &[&[i64]]) = (
        &[&[0, 1, 0], &[1, 0, 1], &[0, 1, 0]],
        &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -1]],
    );
    let scaled = |m: &[&[i64]], f: i64| {
        Sparse::from_entries(
            3,
            3,
            (0..9).map(|k| {
                (
                    k / 3,
                    k % 3,
                    whole(f * (k as i64 / 3 + 1) * m[k / 3][k % 3]),
                )
            }),
        )
    };
    let left = all(&pencil(a, b, &[]));
    let right = all(&Pencil::new(scaled(a, 7), scaled(b, 7), vec![]).unwrap());
    assert_eq!(left, right);
    assert_eq!(left.cones.len(), 1); // {0, 2} at t = 0
    let other = all(&pencil(&[&[0, 1, 0], &[2, 0, 1], &[0, 1, 0]], b, &[]));
    assert_ne!(left, other);
    let mut fewer = left.clone();
    fewer.cones.clear();
    assert_ne!(left, fewer);
    let mut turned = left.clone();
    turned.solutions[0].x.iter_mut().for_each(|p| *p = -&*p);
    assert_ne!(left, turned);
}

/// An answer put together from the answers of parts is the same; a face known to one part only
/// goes.
#[test]
fn merged_parts_are_the_whole() {
    let p = pencil(
        &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -1]],
        &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        &[],
    );
    let answer = all(&p);
    let (mut first, mut second) = (
        answer.clone(),
        Enumeration {
            supports_total: 8,
            supports_done: 3,
            ..Enumeration::default()
        },
    );
    first.supports_done = 5;
    second.solutions = first.solutions.split_off(1);
    second.cones = first.cones.split_off(0);
    first.cones.push(Cone {
        slip: vec![0, 1],
        biactive: vec![2],
        dimension: 2,
        ..second.cones[0].clone()
    });
    let merged = Enumeration::merge([second, first]);
    assert_eq!(merged, answer);
    assert!(merged.is_complete_list());
}
