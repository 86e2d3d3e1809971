//! Where solutions of a support are single, where they are alone, and how far a leaf's word
//! reaches.

use super::*;
use crate::certificate::VariableState;
use crate::certificate::{Member, SupportPoint};
use mceip_exact::{Integer, rational, whole};
use mceip_model::file::Number;

type Pair = (i64, i64);

/// The pencil by its rows of (a, b), all variables slipping.
fn rows(list: &[&[Pair]]) -> Rows {
    let row = |r: &&[Pair]| {
        r.iter()
            .enumerate()
            .map(|(j, (a, b))| (j, (*a).into(), (*b).into()))
            .collect()
    };
    let rows: Vec<_> = list.iter().map(row).collect();
    Rows {
        halves: vec![],
        factor: vec![1.into(); rows.len()],
        is_free: vec![false; rows.len()],
        rows,
    }
}

fn region(lo: i64, hi: Option<i64>, moving: &[usize], order: usize) -> Region {
    let states = (0..order)
        .map(|i| {
            if moving.contains(&i) {
                VariableState::InSupport
            } else {
                VariableState::AtZero
            }
        })
        .collect();
    Region {
        states,
        ..Region::new(whole(lo).into(), hi.map(|hi| whole(hi).into()), None, 0)
    }
}

fn polynomials(list: &[&[i64]]) -> Polynomials {
    Polynomials(
        list.iter()
            .map(|p| p.iter().map(|&c| c.into()).collect())
            .collect(),
    )
}

/// The root of c[0] + c[1] t in an interval, or at a point.
fn point(c: [i64; 2], interval: [Rational; 2], reason: usize) -> SupportPoint {
    SupportPoint {
        polynomial: c.map(Integer::from).to_vec(),
        interval: interval.map(Number),
        reason,
    }
}

fn at(value: i64, reason: usize) -> SupportPoint {
    point([-value, 1], [whole(value), whole(value)], reason)
}

fn some(x: &[&[i64]], alone: Option<Alone>) -> Exact {
    Exact::Some(Box::new(Member {
        x: polynomials(x),
        alone,
    }))
}

fn verdict(rows: &Rows, region: &Region, leaf: &Support) -> Result<Yield, CoverFault> {
    check(rows, region, &region.support(), leaf, &SignBudget::new())
}

fn count(held: Yield) -> usize {
    held.found.len() + held.families.len()
}

/// (t - 1) x_0: one solution, at 1, between points where nothing is.
#[test]
fn a_single_solution_is_unique_half_way_to_its_neighbours() {
    let rows = rows(&[&[(-1, 1)]]);
    let alone = Alone {
        pivot: 0,
        rows: vec![],
    };
    let reasons = vec![
        Exact::None(polynomials(&[&[1]])),
        some(&[&[1]], Some(alone)),
    ];
    let beside = |c, a, b| point(c, [a, b], 0);
    let points = vec![
        at(0, 0),
        beside([-2, 5], rational(1, 5), rational(1, 2)),
        at(1, 1),
        beside([-2, 1], rational(3, 2), rational(5, 2)),
        at(3, 0),
    ];
    let leaf = Support {
        points,
        cells: vec![0; 4],
        reasons: reasons.clone(),
    };
    let held = verdict(&rows, &region(0, Some(3), &[0], 1), &leaf).unwrap();
    assert!(held.found.len() == 1 && held.families.is_empty());
    assert_eq!(held.found[0].solution.value, Interval::point(whole(1)));
    let half_way = Interval::new(rational(3, 4), rational(5, 4));
    assert_eq!(Some(&held.found[0].hull), half_way.as_ref());
    // At an end of the leaf nothing is known beyond it.
    for (lo, hi, points, hull) in [
        (1, Some(3), vec![at(1, 1), at(3, 0)], [1, 2]),
        (-1, Some(1), vec![at(-1, 0), at(1, 1)], [0, 1]),
    ] {
        let leaf = Support {
            cells: vec![0; points.len() - 1],
            points,
            reasons: reasons.clone(),
        };
        let held = verdict(&rows, &region(lo, hi, &[0], 1), &leaf).unwrap();
        let expected = Interval::new(whole(hull[0]), whole(hull[1]));
        assert_eq!(Some(&held.found[0].hull), expected.as_ref());
    }
}

/// x_0 solves for all t on one side of 1, where y_1 = +-(t - 1) >= 0: the point at 1 is an end of
/// them, not single.
#[test]
fn a_solution_beside_a_cell_of_them_is_not_single() {
    for (sign, cells, held_cell) in [(1, vec![1, 0], 2), (-1, vec![0, 1], 1)] {
        // On the left of 1 for sign 1 nothing is there by y_1 < 0.
        let rows = rows(&[&[(0, 0), (0, 0)], &[(-sign, sign), (0, 0)]]);
        let alone = Alone {
            pivot: 0,
            rows: vec![],
        };
        let reasons = vec![
            some(&[&[1], &[]], Some(alone)),
            Exact::None(polynomials(&[&[], &[1]])),
        ];
        let ends = if sign == 1 { [1, 0] } else { [0, 1] };
        let points = vec![at(0, ends[0]), at(1, 0), at(2, ends[1])];
        let leaf = Support {
            points,
            cells,
            reasons,
        };
        let held = verdict(&rows, &region(0, Some(2), &[0], 2), &leaf).unwrap();
        assert!(held.found.is_empty(), "{sign}");
        let [_, cell, _] = &held.families[..] else {
            panic!("two points and a cell")
        };
        assert!(!cell.is_point);
        assert_eq!(cell.from, Some(Interval::point(whole(held_cell - 1))));
        assert_eq!(cell.to, Some(Interval::point(whole(held_cell))));
    }
}

/// Weights on resting rows may leave a moving column at zero, if not all of them.
#[test]
fn a_farkas_vector_may_vanish_on_some_columns() {
    let rows = rows(&[
        &[(1, 0), (0, 0), (0, 0)],
        &[(0, 0), (1, 0), (0, 0)],
        &[(-1, 0), (0, 0), (0, 0)],
    ]);
    let none = |w: &[&[i64]]| {
        let leaf = Support {
            points: vec![at(0, 0)],
            cells: vec![0],
            reasons: vec![Exact::None(polynomials(w))],
        };
        verdict(&rows, &region(0, None, &[0, 1], 3), &leaf).map(count)
    };
    assert_eq!(none(&[&[], &[], &[1]]), Ok(0));
    assert_eq!(none(&[&[], &[-1], &[1]]), Ok(0));
    let fault = |expected, index| {
        Err(CoverFault::Place {
            place: 0,
            expected,
            index,
        })
    };
    assert_eq!(
        none(&[&[], &[1], &[1]]),
        fault("w'T <= 0 on the moving columns", 1)
    );
    assert_eq!(
        none(&[&[1], &[], &[1]]),
        fault("w'T of one sign and not zero", 0)
    );
    assert_eq!(
        none(&[&[], &[], &[-1]]),
        fault("weights >= 0 off the moving set", 2)
    );
    assert_eq!(
        [none(&[&[1], &[1], &[]]), none(&[&[-1], &[-1], &[]])],
        [Ok(0), Ok(0)]
    );
    assert_eq!(
        none(&[&[-1], &[1], &[]]),
        fault("w'T of one sign and not zero", 0)
    );
}

/// y_1 = x_0 and y_2 = 0: x_0 > 0 solves. A weight on either resting row asks for w'T <= 0,
/// wherever the other one stands.
#[test]
fn one_weight_on_a_resting_row_makes_a_farkas_vector_one_sided() {
    let fault = Err(CoverFault::Place {
        place: 0,
        expected: "w'T <= 0 on the moving columns",
        index: 0,
    });
    let none = |rows: &Rows, w: &[&[i64]]| {
        let leaf = Support {
            points: vec![at(0, 0)],
            cells: vec![0],
            reasons: vec![Exact::None(polynomials(w))],
        };
        verdict(rows, &region(0, None, &[0], 3), &leaf).map(count)
    };

    let empty: &[Pair] = &[(0, 0), (0, 0), (0, 0)];
    let first: &[Pair] = &[(1, 0), (0, 0), (0, 0)];
    assert_eq!(
        none(&rows(&[empty, first, empty]), &[&[], &[1], &[]]),
        fault
    );
    assert_eq!(
        none(&rows(&[empty, empty, first]), &[&[], &[], &[1]]),
        fault
    );
}

/// x_0 = x_1 = x_2 by the equations, x_k from the pivot's through its neighbour.
#[test]
fn a_chain_of_equations_determines_all() {
    let rows = rows(&[
        &[(1, 0), (-1, 0), (0, 0)],
        &[(0, 0), (1, 0), (-1, 0)],
        &[(0, 0), (0, 0), (0, 0)],
    ]);
    let leaf = |l: Vec<(usize, Polynomials)>| {
        let member = some(&[&[1], &[1], &[1]], Some(Alone { pivot: 0, rows: l }));
        let leaf = Support {
            points: vec![at(0, 0)],
            cells: vec![0],
            reasons: vec![member],
        };
        verdict(&rows, &region(0, None, &[0, 1, 2], 3), &leaf)
            .map(|held| held.families.iter().all(|h| h.is_alone))
    };
    let (first, both) = (
        polynomials(&[&[1], &[], &[]]),
        polynomials(&[&[1], &[1], &[]]),
    );
    let fault = |expected, index| {
        Err(CoverFault::Place {
            place: 0,
            expected,
            index,
        })
    };
    assert_eq!(leaf(vec![(1, first.clone()), (2, both.clone())]), Ok(true));
    assert_eq!(
        leaf(vec![(1, first.clone())]),
        fault("x determined by the pivot's component", 2)
    );
    assert_eq!(
        leaf(vec![(1, both.clone()), (2, both)]),
        fault("l'T zero but in its own column and the pivot's", 1)
    );
    assert_eq!(
        leaf(vec![(1, first), (2, polynomials(&[&[], &[1], &[]]))]),
        fault("l'T zero but in its own column and the pivot's", 1)
    );
}

/// x_0 = x_1 by two inequalities of resting rows, y_2 = x_0 - x_1 = 0 and y_3 = x_1 - x_0 = 0: both
/// are needed.
#[test]
fn one_inequality_bounds_one_side() {
    let none = [(0, 0); 4];
    let rows = rows(&[
        &none,
        &none,
        &[(1, 0), (-1, 0), (0, 0), (0, 0)],
        &[(-1, 0), (1, 0), (0, 0), (0, 0)],
    ]);
    let (below, above): (&[&[i64]], &[&[i64]]) = (&[&[], &[], &[1], &[]], &[&[], &[], &[], &[1]]);
    let leaf = |l: &[&[&[i64]]]| {
        let alone = Alone {
            pivot: 0,
            rows: l.iter().map(|l| (1, polynomials(l))).collect(),
        };
        let member = some(&[&[1], &[1], &[], &[]], Some(alone));
        let leaf = Support {
            points: vec![at(1, 0)],
            cells: vec![],
            reasons: vec![member],
        };
        verdict(&rows, &region(1, Some(1), &[0, 1], 4), &leaf).map(count)
    };
    let one_side = Err(CoverFault::Place {
        place: 0,
        expected: "x determined by the pivot's component",
        index: 1,
    });
    assert_eq!(
        [leaf(&[below, above]), leaf(&[above, below])],
        [Ok(1), Ok(1)]
    );
    for list in [
        vec![below],
        vec![above],
        vec![below, below],
        vec![above, above],
    ] {
        assert_eq!(leaf(&list), one_side);
    }
    // A weight t - 1 is zero at the point, and may be.
    assert_eq!(leaf(&[below, &[&[], &[], &[-1, 1], &[1]]]), Ok(1));
    let negative = Err(CoverFault::Place {
        place: 0,
        expected: "weights >= 0 where y = 0, and none where y > 0",
        index: 2,
    });
    assert_eq!(leaf(&[below, &[&[], &[], &[-1], &[1]]]), negative);
}

/// 2^23 coefficients and places times bits are the most that is multiplied out.
#[test]
fn a_leaf_has_a_largest_size() {
    let of = |up: u64, down: u64| {
        let value = Rational::new(
            Integer::from(1) << (up - 1),
            (Integer::from(1) << (down - 1)) + 1,
        );
        bounded(&Support {
            points: vec![point([0, 1], [whole(0), value], 0)],
            cells: vec![],
            reasons: vec![],
        })
    };
    // Two coefficients and one place: 3 bits <= 2^23.
    let edge = (1u64 << 23) / 3;
    assert_eq!(
        [of(edge - 2, 2), of(edge / 2, edge - edge / 2)],
        [Ok(2), Ok(2)]
    );
    let large = |got| {
        Err(CoverFault::TooLarge {
            what: "coefficients and places times bits",
            limit: 1 << 23,
            got,
        })
    };
    assert_eq!(of(edge - 1, 2), large(3 * (edge + 1)));
    let long = |length: usize| {
        let leaf = Support {
            points: vec![],
            cells: vec![],
            reasons: vec![Exact::None(Polynomials(vec![vec![1.into(); length]]))],
        };
        bounded(&leaf)
    };
    assert_eq!(long(256), Ok(256));
    assert_eq!(
        long(257),
        Err(CoverFault::TooLarge {
            what: "coefficients of a polynomial",
            limit: 256,
            got: 257
        })
    );
}

/// Horner's rule for 2 coefficients of at most G bits between ends of b bits counts k (k + G) / 2^8
/// with k = 2 (b + 64): 68 for the point [0, 0], where b = 2, and 84 for [3/2, 5/2], where b = 9.
#[test]
fn isolating_a_point_is_counted() {
    let leaf = Support {
        points: vec![
            at(0, 0),
            point([-2, 1], [rational(3, 2), rational(5, 2)], 0),
        ],
        cells: vec![0; 2],
        reasons: vec![],
    };
    let region = region(0, None, &[0], 1);

    assert!(points(&region, &leaf, &SignBudget::of(68 + 84)).is_ok());

    let spent = SignBudget::of(68 + 83);
    assert!(matches!(
        points(&region, &leaf, &spent),
        Err(CoverFault::OutOfBudget)
    ));
    assert!(spent.is_spent());
}
