//! What an exact claim takes from its candidate, and how narrow its interval has to be.

use super::*;
use crate::certify::propose;
use mceip_check::certificate::Claim;
use mceip_exact::{Interval, Sparse, nonnegative_roots, rational, whole};

fn claim_of(pencil: &Pencil, window: &Window, value: f64, x: &[f64]) -> ExactSolution {
    let Claim::ExactSolution(c) = propose(
        pencil,
        window,
        &Candidate {
            value,
            x: x.to_vec(),
        },
    )
    .unwrap() else {
        panic!("an exact claim")
    };
    c
}

fn constants(c: &ExactSolution) -> Vec<Rational> {
    c.x.iter()
        .map(|p| p.first().map_or_else(Rational::zero, |n| n.0.clone()))
        .collect()
}

/// -I + tI on n variables.
fn identity(n: usize, free: Vec<usize>) -> Pencil {
    Pencil::new(
        Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(-1)))),
        Sparse::identity(n),
        free,
    )
    .unwrap()
}

/// In a kernel of several dimensions the candidate says which vector is meant.
#[test]
fn the_kernel_vector_is_the_candidates() {
    let p = identity(3, vec![]);
    let c = claim_of(&p, &Window::all(), 1.0, &[0.25, 0.125, 0.625]);
    assert_eq!(constants(&c), [2, 1, 5].map(whole));
    let c = claim_of(&p, &Window::all(), 1.0, &[0.75, 0.25, 0.0]);
    assert_eq!(
        (constants(&c), c.support, c.biactive),
        ([3, 1, 0].map(whole).to_vec(), vec![0, 1], vec![2])
    );
}

/// Without a slip variable that moves x has no sign of its own: it points where the candidate does.
#[test]
fn a_free_solution_points_where_the_candidate_does() {
    let p = Pencil::new(
        Sparse::from_ints(&[&[-1, 0], &[0, 2]]),
        Sparse::from_ints(&[&[1, 0], &[0, 1]]),
        vec![0],
    )
    .unwrap();
    for x in [3.0, -2.0] {
        let c = claim_of(&p, &Window::all(), 1.0, &[x, 0.0]);
        assert_eq!(
            (constants(&c)[0].is_negative(), c.support.len()),
            (x < 0.0, 0)
        );
    }
    // Two free ones, of which the candidate's larger one decides.
    let p = Pencil::new(
        Sparse::from_ints(&[&[-1, 1, 0], &[0, 3, 0], &[0, 0, 9]]),
        Sparse::from_ints(&[&[1, 0, 0], &[0, -1, 0], &[0, 0, 0]]),
        vec![0, 1],
    )
    .unwrap();
    for sign in [1.0, -1.0] {
        // 2 x_0 + x_1 = 0 at t = 3.
        let c = claim_of(&p, &Window::all(), 3.0, &[-0.5 * sign, sign, 0.0]);
        assert_eq!(
            (
                constants(&c)[0].is_negative(),
                constants(&c)[1].is_negative()
            ),
            (sign > 0.0, sign < 0.0)
        );
    }
}

/// A window of one point, which is the value, or beside it.
#[test]
fn the_ends_of_a_window_belong_to_it() {
    let p = Pencil::new(Sparse::from_ints(&[&[-2]]), Sparse::identity(1), vec![]).unwrap();
    let at = |min: i64, max: i64| {
        let window = Window::new(whole(min), Some(whole(max))).unwrap();
        propose(
            &p,
            &window,
            &Candidate {
                value: 2.0,
                x: vec![1.0],
            },
        )
        .is_ok()
    };
    assert!(at(2, 2) && at(0, 2) && at(2, 5) && !at(0, 1) && !at(3, 4));
}

/// x = (1, 10^400): doubles would see infinity.
#[test]
fn components_beyond_doubles_are_compared_exactly() {
    let huge = Rational::from_integer(mceip_exact::Integer::from(10).pow(400));
    let a = Sparse::from_entries(
        2,
        2,
        [
            (0, 0, -&huge),
            (0, 1, whole(1)),
            (1, 0, whole(0)),
            (1, 1, whole(-1)),
        ],
    );
    let p = Pencil::new(a, Sparse::from_entries(2, 2, [(1, 1, whole(1))]), vec![0]).unwrap();
    // x_0 = 1, x_1 = 10^400 at t = 1: relative to x_1 the free one is nothing.
    let c = claim_of(&p, &Window::all(), 1.0, &[0.0, 1.0]);
    assert_eq!(
        (c.support.clone(), constants(&c)[0].clone()),
        (vec![1], whole(1))
    );
    assert!(
        propose(
            &p,
            &Window::all(),
            &Candidate {
                value: 1.0,
                x: vec![5.0, 1.0]
            }
        )
        .is_err()
    );
}

/// x = (1000, 1) with the first free: distances are in units of e'x_s, so that 0.01 of the free one
/// is far.
#[test]
fn free_components_are_compared_in_units_of_the_slip_ones() {
    let p = Pencil::new(
        Sparse::from_ints(&[&[1, -1000], &[0, -1]]),
        Sparse::from_ints(&[&[0, 0], &[0, 1]]),
        vec![0],
    )
    .unwrap();
    let at = |free: f64| {
        propose(
            &p,
            &Window::all(),
            &Candidate {
                value: 1.0,
                x: vec![free, 1.0],
            },
        )
        .is_ok()
    };
    assert!(at(1000.0) && at(1000.0001) && !at(1000.01) && !at(999.99));
}

#[test]
fn numbers_are_made_integers_without_a_common_factor() {
    let n = |list: &[&[Rational]]| {
        primitive(list.iter().map(|p| p.to_vec()).collect())
            .iter()
            .map(|p| p.iter().map(|v| v.0.clone()).collect())
            .collect::<Vec<Vec<_>>>()
    };
    let (r, w) = (rational, whole);
    assert_eq!(
        n(&[&[r(1, 2), w(3)], &[r(-9, 4)]]),
        [vec![w(2), w(12)], vec![w(-9)]]
    );
    assert_eq!(n(&[&[w(4), w(6)], &[]]), [vec![w(2), w(3)], vec![]]);
    assert_eq!(n(&[&[r(2, 3)], &[r(4, 9)]]), [vec![w(3)], vec![w(2)]]);
    assert_eq!(n(&[&[w(0)], &[]]), [vec![w(0)], vec![]]);
}

/// sqrt 2: the interval left proves all there is to prove, each of which asks for another width.
#[test]
fn an_interval_is_narrowed_until_every_sign_is_sure() {
    let root = || nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
    let poly = |c: &[i64]| Poly::from_ints(c);
    let near = poly(&[-141_421, 100_000]); // t - 1.41421 > 0
    let all = Window::all();
    let tight = Window::new(rational(14_142, 10_000), Some(rational(14_143, 10_000))).unwrap();
    let free = [poly(&[-14_142_135, 10_000_000]), Poly::default()];
    type Case<'a> = (&'a Window, Vec<&'a Poly>, Option<&'a [Poly]>);
    let cases: [Case<'_>; 4] = [
        (&all, vec![], None),
        (&all, vec![&near], None),
        (&tight, vec![], None),
        (&all, vec![], Some(&free)),
    ];
    for (k, (window, strict, nonzero)) in cases.into_iter().enumerate() {
        let mut value = root();
        tighten(window, &strict, nonzero, &mut value).unwrap();
        let interval: &Interval = value.interval();
        let sure = |g: &Poly| interval.horner(&g.pseudo_rem(value.poly())).certain_sign();
        assert!(
            interval.horner(&value.poly().derivative()).certain_sign() != 0,
            "{k}"
        );
        assert!(
            interval.lo() >= window.min() && window.max().is_none_or(|m| interval.hi() <= m),
            "{k}"
        );
        assert!(strict.iter().all(|g| sure(g) == 1), "{k}");
        assert!(
            nonzero.is_none_or(|x| x.iter().any(|g| sure(g) != 0)),
            "{k}"
        );
    }
    // A sign that is never sure, at a point: nothing to narrow.
    let mut one = Algebraic::rational(whole(1));
    assert_eq!(
        tighten(&all, &[&poly(&[-1, 1])], None, &mut one),
        Err(AttemptFailure::Precision {
            limit: MAX_HALVINGS
        })
    );
    assert_eq!(
        tighten(&all, &[], Some(&[poly(&[-1, 1])]), &mut one),
        Err(AttemptFailure::Precision {
            limit: MAX_HALVINGS
        })
    );
    assert_eq!(
        tighten(&all, &[], Some(&[poly(&[-2, 1])]), &mut one),
        Ok(())
    );
}

/// A radius relative to 1 + |value|, within which roots are taken, the nearest first.
#[test]
fn roots_are_taken_near_the_candidate_nearest_first() {
    let (p, window) = (identity(1, vec![]), Window::all());
    let candidate = Candidate {
        value: -3.0,
        x: vec![1.0],
    };
    assert_eq!(
        around(&candidate),
        (-3.0 - 4.0 * VALUE_RADIUS, -3.0 + 4.0 * VALUE_RADIUS)
    );
    let candidate = Candidate {
        value: 2.0,
        x: vec![1.0],
    };
    let rows = IntegralRows::of(&p);
    let at = Support {
        pencil: &p,
        rows: &rows,
        window: &window,
        support: &[0],
        active: active(&p, &[0]),
        candidate: &candidate,
    };
    let root = |n: i64| Poly::new([-n, 10_000].map(mceip_exact::Integer::from).to_vec());
    let found = at
        .roots_near(&[
            root(19_999),
            root(20_002),
            root(20_000),
            root(20_004),
            root(19_000),
        ])
        .unwrap();
    let expected = [20_000, 19_999, 20_002].map(|n| rational(n, 10_000));
    assert_eq!(found.len(), 3);
    for (mut got, want) in found.into_iter().zip(expected) {
        got.refine_to(&rational(1, 1 << 40));
        assert!((got.interval().mid() - want).abs() < rational(1, 1 << 39));
    }
}

/// 2t - 3 is 1 at t = 2, and 0 or less in the middle of an interval that begins at 0 or 1.
#[test]
fn a_direction_is_compared_at_the_value_itself() {
    let of = |c: [i64; 2]| Poly::new(c.map(mceip_exact::Integer::from).to_vec());
    for (x, away) in [(1.0, false), (-1.0, true)] {
        let mut two = nonnegative_roots(&of([-2, 1])).remove(0);
        assert_eq!(
            dot_sign(
                &[of([-3, 2])],
                &Candidate {
                    value: 2.0,
                    x: vec![x]
                },
                &mut two
            ),
            away
        );
        assert!((two.interval().mid() - whole(2)).abs() < rational(1, 1 << 60));
    }
}
