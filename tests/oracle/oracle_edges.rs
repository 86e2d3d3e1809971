//! The oracle's own predicates at their edges: what a solution is, what an answer holds, when two
//! answers are equal, and what is said of answers that are not complete. Made by hand, so that each
//! line fails for one reason only.

use mceip_exact::{Algebraic, Poly, Rational, Sparse, parse, rational, whole};
use mceip_model::{Pencil, Window};
use mceip_oracle::{
    Cone, End, Enumeration, MAX_FREE, MAX_SLIP, OracleError, Piece, Solution, SupportRange,
    WideKernel, enumerate, enumerate_with, examine_support, is_rational_solution, is_solution,
};
use std::ops::ControlFlow;

fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
    Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
}

fn at(v: i64) -> Algebraic {
    Algebraic::rational(whole(v))
}

fn constant(v: &[i64]) -> Vec<Poly> {
    v.iter().map(|&c| Poly::from_ints(&[c])).collect()
}

/// Every x >= 0 solves it at every t.
fn zero() -> Pencil {
    pencil(&[&[0, 0], &[0, 0]], &[&[0, 0], &[0, 0]], &[])
}

fn single(value: i64, slip: &[usize], x: &[i64]) -> Solution {
    Solution {
        value: at(value),
        multiplicity: 1,
        slip: slip.to_vec(),
        biactive: vec![],
        x: constant(x),
        y: constant(&vec![0; x.len()]),
    }
}

fn cone(value: i64, slip: &[usize], rays: Vec<Solution>) -> Cone {
    Cone {
        value: at(value),
        slip: slip.to_vec(),
        biactive: vec![],
        kernel_dimension: 2,
        dimension: 2,
        rays,
        lineality: vec![],
    }
}

fn range(support: &[usize], from: i64, to: Option<i64>) -> SupportRange {
    let end = |v| End {
        value: at(v),
        included: true,
    };
    SupportRange {
        support: support.to_vec(),
        pieces: vec![Piece {
            from: end(from),
            to: to.map(end),
        }],
        kernel: vec![],
    }
}

#[test]
fn a_vector_of_the_wrong_length_or_at_a_negative_value_is_no_solution() {
    let p = pencil(&[&[2, 0], &[0, 3]], &[&[1, 0], &[0, 1]], &[]);
    assert!(!is_solution(&p, &at(-2), &constant(&[1, 0]))); // (t + 2) x_0 = 0
    let z = zero();
    assert!(
        is_solution(&z, &at(2), &constant(&[1, 0])) && !is_solution(&z, &at(2), &constant(&[0, 0]))
    );
    for x in [vec![1], vec![1, 0, 0], vec![]] {
        assert!(!is_solution(&z, &at(2), &constant(&x)), "{x:?}");
    }
}

/// Rows and vectors with several denominators: x = (1/2, 1/3), rows (2/3 - t/6, -3/4 ...) made to
/// vanish at t = 1.
#[test]
fn fractions_are_cleared_row_by_row() {
    let q = |v: &str| parse(v).unwrap();
    let sparse = |rows: [[&str; 2]; 2]| {
        Sparse::from_entries(
            2,
            2,
            [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| (i, j, q(rows[i][j]))),
        )
    };
    let a = sparse([["2/3", "-3/4"], ["1/5", "-4/5"]]);
    let b = sparse([["-1/6", "0"], ["1/7", "2/7"]]);
    // Row 0: (2/3 - t/6)/2 - 1/4 = 0 at t = 1; row 1: (1/5 + t/7)/2 + (-4/5 + 2t/7)/3 = -1/6 + t/6
    // = 0 at t = 1.
    let p = Pencil::new(a, b, vec![]).unwrap();
    let x = |v: [&str; 2]| v.map(q);
    assert!(
        is_rational_solution(&p, &whole(1), &x(["1/2", "1/3"]))
            && is_rational_solution(&p, &whole(1), &x(["3/5", "2/5"]))
    );
    for (t, v) in [
        ("1", ["1/2", "1/4"]),
        ("1", ["1/3", "1/2"]),
        ("1", ["1", "1"]),
        ("2", ["1/2", "1/3"]),
        ("1", ["-1/2", "-1/3"]),
    ] {
        assert!(!is_rational_solution(&p, &q(t), &x(v)), "{t} {v:?}");
    }
}

#[test]
fn free_rows_are_zero_and_free_variables_of_any_sign() {
    // (t - 1) x_0 - x_1 = 0 for the free row, x_0 + x_1 for the other.
    let p = pencil(&[&[-1, -1], &[1, 1]], &[&[1, 0], &[0, 0]], &[0]);
    assert!(is_solution(&p, &at(0), &constant(&[-1, 1])));
    assert!(is_solution(&p, &at(1), &constant(&[1, 0])));
    for (t, x) in [
        (0, [1, 1]),
        (1, [-1, 0]),
        (2, [1, 0]),
        (0, [1, -1]),
        (0, [-2, 2]),
        (3, [1, 2]),
    ] {
        assert_eq!(
            is_solution(&p, &at(t), &constant(&x)),
            x == [-2, 2],
            "{t} {x:?}"
        );
    }
}

/// A listed solution holds its own ray at its own value, a cone what it spans, a range its values.
#[test]
fn an_answer_holds_what_it_lists_and_nothing_else() {
    let z = zero();
    let held = |e: &Enumeration, t: Rational, x: [i64; 2]| {
        e.contains(&z, &Algebraic::rational(t), &constant(&x))
    };
    let e = Enumeration {
        solutions: vec![single(1, &[0, 1], &[1, 1])],
        ..Enumeration::default()
    };
    assert!(held(&e, whole(1), [1, 1]) && held(&e, whole(1), [3, 3]));
    assert!(
        !held(&e, whole(2), [1, 1])
            && !held(&e, whole(1), [1, 2])
            && !held(&e, whole(1), [1, 0])
            && !held(&e, whole(2), [1, 2])
    );
    let e = Enumeration {
        cones: vec![cone(1, &[0], vec![])],
        ..Enumeration::default()
    };
    assert!(held(&e, whole(1), [1, 0]));
    assert!(
        !held(&e, whole(2), [1, 0]) && !held(&e, whole(1), [1, 1]) && !held(&e, whole(1), [0, 1])
    );
    // y = (0, 1) of x = (1, 0): the cone of both variables, on which y_1 = 0, does not hold it.
    let p = pencil(&[&[0, 0], &[1, 0]], &[&[0, 0], &[0, 0]], &[]);
    let e = Enumeration {
        cones: vec![cone(1, &[0, 1], vec![])],
        ..Enumeration::default()
    };
    assert!(
        is_solution(&p, &at(1), &constant(&[1, 0])) && !e.contains(&p, &at(1), &constant(&[1, 0]))
    );
    assert!(held(&e, whole(1), [1, 0]));
    let e = Enumeration {
        ranges: vec![range(&[0], 1, Some(2))],
        ..Enumeration::default()
    };
    assert!(held(&e, rational(3, 2), [1, 0]) && held(&e, whole(2), [1, 0]));
    assert!(
        !held(&e, whole(3), [1, 0])
            && !held(&e, rational(3, 2), [1, 1])
            && !held(&e, rational(3, 2), [0, 1])
    );
}

#[test]
fn ends_pieces_and_ranges_are_equal_in_all_their_parts() {
    let end = |v: i64, included| End {
        value: at(v),
        included,
    };
    assert!(end(1, true) == end(1, true) && end(1, false) == end(1, false));
    assert!(
        end(1, true) != end(2, true)
            && end(1, true) != end(1, false)
            && end(1, true) != end(2, false)
    );
    let piece = |from: i64, to: Option<i64>| Piece {
        from: end(from, true),
        to: to.map(|v| end(v, false)),
    };
    assert!(piece(1, Some(2)) == piece(1, Some(2)) && piece(1, None) == piece(1, None));
    assert!(
        piece(1, Some(2)) != piece(1, None)
            && piece(1, Some(2)) != piece(0, Some(2))
            && piece(1, Some(2)) != piece(1, Some(3))
    );
    assert!(piece(1, Some(2)) != piece(0, Some(3)));
    assert!(range(&[0], 1, None) == range(&[0], 1, None));
    assert!(
        range(&[0], 1, None) != range(&[1], 1, None)
            && range(&[0], 1, None) != range(&[0], 2, None)
            && range(&[0], 1, None) != range(&[1], 2, None)
    );
}

#[test]
fn cones_are_equal_in_all_their_parts() {
    let rays = || vec![single(1, &[0], &[1, 0]), single(1, &[1], &[0, 1])];
    let whole_cone = || Cone {
        lineality: vec![constant(&[1, 1])],
        ..cone(1, &[0, 1], rays())
    };
    assert!(whole_cone() == whole_cone());
    assert!(
        whole_cone()
            == Cone {
                lineality: vec![constant(&[2, 2])],
                ..whole_cone()
            }
    );
    let changed = [
        Cone {
            value: at(2),
            ..whole_cone()
        },
        Cone {
            slip: vec![0],
            ..whole_cone()
        },
        Cone {
            biactive: vec![1],
            ..whole_cone()
        },
        Cone {
            dimension: 1,
            ..whole_cone()
        },
        Cone {
            rays: rays()[..1].to_vec(),
            ..whole_cone()
        },
        Cone {
            rays: vec![rays()[0].clone(), single(1, &[1], &[1, 1])],
            ..whole_cone()
        },
        Cone {
            lineality: vec![],
            ..whole_cone()
        },
        Cone {
            lineality: vec![constant(&[1, 2])],
            ..whole_cone()
        },
        Cone {
            value: at(2),
            lineality: vec![constant(&[1, 2])],
            ..whole_cone()
        },
        Cone {
            rays: vec![],
            lineality: vec![constant(&[1, 2])],
            ..whole_cone()
        },
    ];
    for other in changed {
        assert!(whole_cone() != other, "{other:?}");
    }
}

/// The mean of the rays, each of l1 norm 1, whatever factors they are listed with; or a direction
/// where there is no ray.
#[test]
fn the_center_of_a_cone_is_inside() {
    let rays = vec![
        single(1, &[0], &[2, 0, 0]),
        single(1, &[1], &[0, 3, 0]),
        single(1, &[2], &[0, 0, 5]),
    ];
    let center = cone(1, &[0, 1, 2], rays).center(&[0, 1, 2]);
    assert!(center.x == constant(&[1, 1, 1]) && center.slip == [0, 1, 2]);
    let two = vec![single(1, &[0, 1], &[1, 1]), single(1, &[1], &[0, 3])];
    assert!(cone(1, &[0, 1], two).center(&[0, 1]).x == constant(&[1, 3])); // (1/2, 1/2) + (0, 1)
    let all_free = pencil(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[0, 1]);
    let found = enumerate(&all_free, &Window::all()).unwrap();
    assert!(found.cones.len() == 1 && found.cones[0].rays.is_empty());
    let center = found.cones[0].center(&[]);
    assert!(is_solution(&all_free, &at(1), &center.x) && center.x == found.cones[0].lineality[0]);
}

/// (t - 1) on two free variables; `rows`: y of the slip variables by the free ones. At t = 1 the
/// first free row is the sum of the slip variables, so that none of them moves.
fn free_kernel(rows: &[[i64; 2]]) -> Pencil {
    let n = rows.len() + 2;
    let mut a = vec![vec![0; n]; n];
    let mut b = a.clone();
    for i in 0..2 {
        (a[i][i], b[i][i]) = (-1, 1);
    }
    for (k, row) in rows.iter().enumerate() {
        a[k + 2][..2].copy_from_slice(row);
        a[k + 2][k + 2] = 1;
        a[0][k + 2] = 1;
    }
    let list = |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(Vec::as_slice).collect::<Vec<_>>());
    Pencil::new(list(&a), list(&b), vec![0, 1]).unwrap()
}

/// t = 1 alone.
fn at_one(p: &Pencil) -> Enumeration {
    enumerate(p, &Window::new(whole(1), Some(whole(1))).unwrap()).unwrap()
}

/// A kernel of dimension 2 of which y >= 0 leaves nothing, a line, a half plane.
#[test]
fn a_wide_kernel_of_free_variables_may_hold_nothing() {
    let found = |rows: &[[i64; 2]]| at_one(&free_kernel(rows));
    let none = found(&[[1, 0], [-1, 0], [0, 1], [0, -1]]);
    assert!(none.is_plain_list() && none.solutions.is_empty() && !none.wide.is_empty());
    let line = found(&[[1, 0], [-1, 0]]);
    assert!(line.is_plain_list());
    let x: Vec<&Vec<Poly>> = line.solutions.iter().map(|s| &s.x).collect();
    assert_eq!(x.len(), 2);
    for x in x {
        assert!(
            x[0] == Poly::default() && is_solution(&free_kernel(&[[1, 0], [-1, 0]]), &at(1), x)
        );
    }
}

/// Rays vanish where the lineality space has its pivot, and still solve: whichever ray the cone was
/// found with.
#[test]
fn rays_are_canonical_beside_a_lineality_space() {
    for row in [[1, 1], [2, 1], [1, -3], [-2, 5], [0, 1], [1, 0]] {
        let p = free_kernel(&[row]);
        let found = at_one(&p);
        assert_eq!(found.cones.len(), 1, "{row:?}");
        let cone = &found.cones[0];
        assert_eq!(
            (cone.dimension, cone.lineality.len(), cone.rays.len()),
            (2, 1, 1)
        );
        let pivot = cone.lineality[0]
            .iter()
            .position(|p| *p != Poly::default())
            .unwrap();
        let ray = &cone.rays[0];
        assert!(
            ray.x[pivot] == Poly::default() && is_solution(&p, &at(1), &ray.x),
            "{row:?}: {:?}",
            ray.x
        );
    }
}

/// Two free directions that no ray can be written without: the lineality (1, 1, 1) of y_3 = x_0 -
/// x_1 and y_4 = x_1 - x_2.
#[test]
fn rays_of_a_wedge_are_reduced_by_its_line() {
    let mut a = vec![vec![0; 5]; 5];
    let mut b = a.clone();
    for i in 0..3 {
        (a[i][i], b[i][i]) = (-1, 1);
    }
    a[0] = vec![-1, 0, 0, 1, 1];
    a[3] = vec![1, -1, 0, 1, 0];
    a[4] = vec![0, 1, -1, 0, 1];
    let list = |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(Vec::as_slice).collect::<Vec<_>>());
    let p = Pencil::new(list(&a), list(&b), vec![0, 1, 2]).unwrap();
    let found = at_one(&p);
    let cone = &found.cones[0];
    assert_eq!(
        (found.cones.len(), cone.lineality.len(), cone.rays.len()),
        (1, 1, 2)
    );
    for ray in &cone.rays {
        assert!(
            ray.x[0] == Poly::default() && is_solution(&p, &at(1), &ray.x),
            "{:?}",
            ray.x
        );
    }
}

/// The largest problems are taken on, and left at the first word; one variable more is refused.
#[test]
fn limits_are_allowed_and_no_more() {
    let of = |slip: usize, free: usize| {
        let n = slip + free;
        let identity = || Sparse::identity(n);
        let p = Pencil::new(identity(), identity(), (0..free).collect()).unwrap();
        enumerate_with(&p, &Window::all(), |_, _| ControlFlow::Break(())).map(|e| e.supports_done)
    };
    assert_eq!([of(MAX_SLIP, 1), of(1, MAX_FREE)], [Ok(1), Ok(1)]);
    assert_eq!(
        of(MAX_SLIP + 1, 0),
        Err(OracleError::TooLarge {
            what: "slip variables",
            limit: MAX_SLIP as u64,
            got: MAX_SLIP as u64 + 1
        })
    );
    assert_eq!(
        of(0, MAX_FREE + 1),
        Err(OracleError::TooLarge {
            what: "free variables",
            limit: MAX_FREE as u64,
            got: MAX_FREE as u64 + 1
        })
    );
}

/// -I + tI: each support has its own solution or cone; a run that is broken off keeps those of the
/// first supports.
#[test]
fn supports_are_counted_in_binary() {
    let p = pencil(&[&[-1, 0], &[0, -2]], &[&[1, 0], &[0, 1]], &[]);
    let after = |count: u64| {
        let stop = |done: u64, _| {
            if done == count {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        enumerate_with(&p, &Window::all(), stop)
            .unwrap()
            .solutions
            .iter()
            .map(|s| s.slip.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        [after(1), after(2), after(3)],
        [vec![], vec![vec![0]], vec![vec![0], vec![1]]]
    );
    let mut found = Enumeration::default();
    examine_support(&p, &[1], &Window::all(), &mut found);
    assert!(found.solutions.len() == 1 && found.solutions[0].slip == [1]);
}

/// (t - 1) (x_0 + x_1) on row 0: both move at t = 1 only, where the kernel is wide; a zero column
/// moves from there on.
#[test]
fn a_wide_kernel_at_one_value_of_a_singular_support_is_named() {
    let p = pencil(&[&[-1, -1], &[0, 0]], &[&[1, 1], &[0, 0]], &[]);
    let found = enumerate(&p, &Window::all()).unwrap();
    assert!(found.is_complete_list());
    assert_eq!(
        found
            .wide
            .iter()
            .map(|w| (w.support.clone(), w.dimension))
            .collect::<Vec<_>>(),
        [(vec![0, 1], 2)]
    );
    assert_eq!((found.cones.len(), found.ranges.len()), (1, 1));
}

/// 6 moving variables and 9 resting rows, nothing else: C(15, 6) minors are too many, and that is
/// said.
#[test]
fn too_many_minors_are_named_with_their_number() {
    let n = 15;
    let mut a = vec![vec![0; n]; n];
    for i in 6..n {
        for j in 0..6 {
            a[i][j] = ((i * i + 3 * i * j + j * j * j) % 17) as i64 - 8;
        }
    }
    let list = Sparse::from_ints(&a.iter().map(Vec::as_slice).collect::<Vec<_>>());
    let p = Pencil::new(list, Sparse::from_entries(n, n, []), vec![]).unwrap();
    let mut found = Enumeration::default();
    examine_support(&p, &[0, 1, 2, 3, 4, 5], &Window::all(), &mut found);
    found.describe(&p, &Window::all());
    assert_eq!(
        found
            .undescribed
            .iter()
            .map(|u| (u.minors, u.limit))
            .collect::<Vec<_>>(),
        [(5005, 4096)]
    );
    // C(10, 4) = 210 are not.
    let mut found = Enumeration::default();
    let small: Vec<&[i64]> = a[6 - 4..][..10].iter().map(|r| &r[..10]).collect();
    let p = Pencil::new(
        Sparse::from_ints(&small),
        Sparse::from_entries(10, 10, []),
        vec![],
    )
    .unwrap();
    examine_support(&p, &[0, 1, 2, 3], &Window::all(), &mut found);
    found.describe(&p, &Window::all());
    assert!(found.undescribed.is_empty() && found.described == (0, 1));
}

/// Finished, everything met described, nothing left out: all three, and merged parts add what they
/// have described.
#[test]
fn a_complete_list_is_finished_and_described() {
    let p = zero();
    let complete = enumerate(&p, &Window::all()).unwrap();
    assert!(complete.is_complete_list() && !complete.continua.is_empty());
    let undescribed = || mceip_oracle::Undescribed {
        support: vec![0],
        minors: 9000,
        limit: 4096,
    };
    let not = [
        Enumeration {
            supports_total: 8,
            ..complete.clone()
        },
        Enumeration {
            described: (0, 0),
            ..complete.clone()
        },
        Enumeration {
            undescribed: vec![undescribed()],
            ..complete.clone()
        },
        Enumeration {
            supports_total: 8,
            described: (0, 0),
            ..complete.clone()
        },
        Enumeration {
            described: (0, 0),
            undescribed: vec![undescribed()],
            ..complete.clone()
        },
        Enumeration {
            supports_total: 8,
            undescribed: vec![undescribed()],
            ..complete.clone()
        },
    ];
    for e in not {
        assert!(!e.is_complete_list());
    }
    let named = |described: (usize, usize)| Enumeration {
        described,
        ..Enumeration::default()
    };
    assert_eq!(
        Enumeration::merge([named((2, 3)), named((5, 7))]).described,
        (7, 10)
    );
    let mut by_hand = Enumeration {
        continua: complete.continua.clone(),
        supports_done: 4,
        supports_total: 4,
        ..Enumeration::default()
    };
    assert!(!by_hand.is_complete_list());
    by_hand.describe(&p, &Window::all());
    assert!(by_hand.is_complete_list() && by_hand == complete);
}

#[test]
fn the_kernel_of_a_solution_is_that_of_its_support_and_value() {
    let wide = |value: i64, support: &[usize], dimension| WideKernel {
        value: at(value),
        support: support.to_vec(),
        dimension,
    };
    let e = Enumeration {
        wide: vec![wide(1, &[0, 1], 2), wide(2, &[0], 3), wide(1, &[0], 4)],
        ..Enumeration::default()
    };
    let dimension = |value: i64, slip: &[usize]| e.kernel_dimension(&single(value, slip, &[1, 1]));
    assert_eq!(
        [
            dimension(1, &[0, 1]),
            dimension(2, &[0]),
            dimension(1, &[0])
        ],
        [2, 3, 4]
    );
    assert_eq!(
        [
            dimension(2, &[0, 1]),
            dimension(3, &[0]),
            dimension(1, &[1])
        ],
        [1, 1, 1]
    );
}

/// The pencil with the rows and columns of a support and of the free variables alone, as (24) has
/// it, and the indices these have in the whole pencil.
fn without_stick(whole: &Pencil, support: &[usize]) -> (Pencil, Vec<usize>) {
    let mut kept = [support, whole.free()].concat();
    kept.sort_unstable();

    let is_free = |k: &usize| whole.free().contains(&kept[*k]);
    let free = (0..kept.len()).filter(is_free).collect();
    let a = whole.a().submatrix(&kept, &kept);
    let b = whole.b().submatrix(&kept, &kept);
    (Pencil::new(a, b, free).unwrap(), kept)
}

/// The solutions of the linear eigenproblem (25) of one support with x_s > 0 that also meet the
/// inequalities (26) of the whole pencil: value and x.
fn solutions_of_support(pencil: &Pencil, support: &[usize]) -> Vec<(Algebraic, Vec<Poly>)> {
    let (smaller, kept) = without_stick(pencil, support);
    let mut list = Vec::new();

    for solution in enumerate(&smaller, &Window::all()).unwrap().solutions {
        if solution.slip.len() < support.len() {
            continue; // belongs to a smaller support
        }
        let mut x = vec![Poly::default(); pencil.order()];
        for (position, &index) in kept.iter().enumerate() {
            x[index] = solution.x[position].clone();
        }
        if is_solution(pencil, &solution.value, &x) {
            list.push((solution.value, x));
        }
    }
    list
}

/// (24): what sticks is left out. The solutions of a pencil are those of its supports, each found in
/// the pencil without the other complementarity variables, with y >= 0 there.
#[test]
fn stick_variables_are_left_out() {
    let pencils = [
        pencil(
            &[&[-3, 1, 0], &[1, -2, 1], &[0, 1, -4]],
            &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
            &[],
        ),
        pencil(
            &[&[2, -3, -1], &[-3, 1, 0], &[-1, 2, -3]],
            &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
            &[0],
        ),
        pencil(
            &[
                &[-2, 1, 3, 0],
                &[1, -5, 1, 2],
                &[3, 1, -2, 1],
                &[0, 2, 1, -1],
            ],
            &[&[1, 0, 0, 0], &[0, 2, 0, 0], &[0, 0, 1, 0], &[0, 0, 0, 1]],
            &[],
        ),
    ];
    let mut with_stick = 0;

    for pencil in &pencils {
        let answer = enumerate(pencil, &Window::all()).unwrap();
        let slip = pencil.slip();
        let mut found = 0;

        for subset in 1..1_usize << slip.len() {
            let chosen = (0..slip.len()).filter(|k| subset >> k & 1 == 1);
            let support: Vec<usize> = chosen.map(|k| slip[k]).collect();
            for (value, x) in solutions_of_support(pencil, &support) {
                assert!(answer.contains(pencil, &value, &x), "{support:?}");
                found += 1;
                with_stick += usize::from(support.len() < slip.len());
            }
        }

        assert_eq!(found, answer.solutions.len());
    }
    assert!(with_stick > 3, "{with_stick}");
}
