//! What an exact claim takes from its candidate, and how narrow its interval has to be.

use super::*;
use crate::certify::propose;
use crate::tolerance::VALUE_RADIUS;
use mceip_check::certificate::Claim;
use mceip_exact::{Sparse, nonnegative_roots, rational, whole};

fn candidate(value: f64, x: &[f64]) -> Candidate {
    Candidate {
        value,
        x: x.to_vec(),
    }
}

/// The exact claim about a candidate, in the window of all values.
fn claim_of(pencil: &Pencil, value: f64, x: &[f64]) -> ExactSolution {
    let claim = propose(pencil, &Window::all(), &candidate(value, x)).unwrap();
    let Claim::ExactSolution(claim) = claim else {
        panic!("an exact claim")
    };
    claim
}

/// Is there a claim about a candidate?
fn is_claimed(pencil: &Pencil, window: &Window, value: f64, x: &[f64]) -> bool {
    propose(pencil, window, &candidate(value, x)).is_ok()
}

/// The constant coefficients of x.
fn constants(claim: &ExactSolution) -> Vec<Rational> {
    let mut constants = Vec::new();
    for component in &claim.x {
        let constant = component.first().map(|number| number.0.clone());
        constants.push(constant.unwrap_or_else(Rational::zero));
    }

    constants
}

/// -I + tI on n variables.
fn identity(n: usize, free: Vec<usize>) -> Pencil {
    let a = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(-1))));
    Pencil::new(a, Sparse::identity(n), free).unwrap()
}

/// In a kernel of several dimensions the candidate says which vector is meant.
#[test]
fn the_kernel_vector_is_the_candidates() {
    let p = identity(3, vec![]);

    let inside = claim_of(&p, 1.0, &[0.25, 0.125, 0.625]);
    let on_face = claim_of(&p, 1.0, &[0.75, 0.25, 0.0]);

    assert_eq!(constants(&inside), [2, 1, 5].map(whole));
    assert_eq!(constants(&on_face), [3, 1, 0].map(whole));
    assert_eq!(on_face.support, [0, 1]);
    assert_eq!(on_face.biactive, [2]);
}

/// The kernel of (0, 1, -4) at t = 1: the last coordinate of its second vector (0, 4, 1) counts,
/// not the first one at which the other vector vanishes.
#[test]
fn components_count_at_free_coordinates() {
    let a = Sparse::from_ints(&[&[-1, 1, -4], &[0, -1, 0], &[0, 0, -1]]);
    let p = Pencil::new(a, Sparse::identity(3), vec![]).unwrap();

    let claim = claim_of(&p, 1.0, &[1.0 / 131_072.0, 1.0, 0.25]);

    assert_eq!(constants(&claim), [1, 131_072, 32_768].map(whole));
}

/// Without a slip variable that moves x has no sign of its own: it points where the candidate does.
#[test]
fn a_free_solution_points_where_the_candidate_does() {
    let a = Sparse::from_ints(&[&[-1, 0], &[0, 2]]);
    let one_free = Pencil::new(a, Sparse::identity(2), vec![0]).unwrap();
    for x in [3.0, -2.0] {
        let claim = claim_of(&one_free, 1.0, &[x, 0.0]);

        assert_eq!(constants(&claim)[0].is_negative(), x < 0.0);
        assert!(claim.support.is_empty());
    }

    // Two free ones, of which the candidate's larger one decides: 2 x_0 + x_1 = 0 at t = 3.
    let a = Sparse::from_ints(&[&[-1, 1, 0], &[0, 3, 0], &[0, 0, 9]]);
    let b = Sparse::from_ints(&[&[1, 0, 0], &[0, -1, 0], &[0, 0, 0]]);
    let two_free = Pencil::new(a, b, vec![0, 1]).unwrap();
    for sign in [1.0, -1.0] {
        let claim = claim_of(&two_free, 3.0, &[-0.5 * sign, sign, 0.0]);

        let x = constants(&claim);
        assert_eq!(x[0].is_negative(), sign > 0.0);
        assert_eq!(x[1].is_negative(), sign < 0.0);
    }
}

/// Is the solution at t = 2 claimed in a window?
fn is_claimed_between(min: i64, max: i64) -> bool {
    let pencil = Pencil::new(Sparse::from_ints(&[&[-2]]), Sparse::identity(1), vec![]).unwrap();
    let window = Window::new(whole(min), Some(whole(max))).unwrap();
    is_claimed(&pencil, &window, 2.0, &[1.0])
}

/// A window of one point, which is the value, or beside it.
#[test]
fn the_ends_of_a_window_belong_to_it() {
    assert!(is_claimed_between(2, 2));
    assert!(is_claimed_between(0, 2));
    assert!(is_claimed_between(2, 5));
    assert!(!is_claimed_between(0, 1));
    assert!(!is_claimed_between(3, 4));
}

/// x = (1, 10^400): doubles would see infinity.
#[test]
fn components_beyond_doubles_are_compared_exactly() {
    let huge = Rational::from_integer(Integer::from(10).pow(400));
    let entries = [
        (0, 0, -&huge),
        (0, 1, whole(1)),
        (1, 0, whole(0)),
        (1, 1, whole(-1)),
    ];
    let a = Sparse::from_entries(2, 2, entries);
    let b = Sparse::from_entries(2, 2, [(1, 1, whole(1))]);
    let p = Pencil::new(a, b, vec![0]).unwrap();

    // x_0 = 1, x_1 = 10^400 at t = 1: relative to x_1 the free one is nothing.
    let claim = claim_of(&p, 1.0, &[0.0, 1.0]);

    assert_eq!(claim.support, [1]);
    assert_eq!(constants(&claim)[0], whole(1));
    assert!(!is_claimed(&p, &Window::all(), 1.0, &[5.0, 1.0]));
}

/// x = (1000, 1) with the first free, which is the scale: 2e-3 of it is far, for the slip component
/// as well.
#[test]
fn a_free_component_may_be_the_scale() {
    let a = Sparse::from_ints(&[&[1, -1000], &[0, -1]]);
    let b = Sparse::from_ints(&[&[0, 0], &[0, 1]]);
    let p = Pencil::new(a, b, vec![0]).unwrap();

    for near in [[1000.0, 1.0], [1000.01, 1.0], [1000.0, 1.5]] {
        assert!(is_claimed(&p, &Window::all(), 1.0, &near));
    }

    for far in [[1000.0, 3.0], [-1000.0, 1.0]] {
        assert!(!is_claimed(&p, &Window::all(), 1.0, &far));
    }
}

/// [`primitive`] of components, as rationals.
fn primitive_of(components: &[&[Rational]]) -> Vec<Vec<Rational>> {
    let components = components.iter().map(|c| c.to_vec()).collect();
    let mut rationals = Vec::new();
    for component in primitive(components) {
        rationals.push(component.into_iter().map(|number| number.0).collect());
    }

    rationals
}

#[test]
fn numbers_are_made_integers_without_a_common_factor() {
    assert_eq!(
        primitive_of(&[&[rational(1, 2), whole(3)], &[rational(-9, 4)]]),
        [vec![whole(2), whole(12)], vec![whole(-9)]]
    );
    assert_eq!(
        primitive_of(&[&[whole(4), whole(6)], &[]]),
        [vec![whole(2), whole(3)], vec![]]
    );
    assert_eq!(
        primitive_of(&[&[rational(2, 3)], &[rational(4, 9)]]),
        [vec![whole(3)], vec![whole(2)]]
    );
    assert_eq!(primitive_of(&[&[whole(0)], &[]]), [vec![whole(0)], vec![]]);
}

/// The interval of sqrt 2, narrowed for what is required.
fn tightened(required: &RequiredSigns<'_>) -> Algebraic {
    let mut value = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
    required.tighten(&mut value).unwrap();
    value
}

/// The sign of g all over the interval of a value.
fn sign_over_interval(g: &Poly, value: &Algebraic) -> i8 {
    let g = g.pseudo_rem(value.poly());
    value.interval().horner(&g).certain_sign()
}

/// sqrt 2: the interval left proves all there is to prove, each of which asks for another width.
#[test]
fn an_interval_is_narrowed_until_every_sign_is_sure() {
    let all = Window::all();
    let tight = Window::new(rational(14_142, 10_000), Some(rational(14_143, 10_000))).unwrap();
    let above = Poly::from_ints(&[-141_421, 100_000]); // t - 1.41421 > 0
    let free = [Poly::from_ints(&[-14_142_135, 10_000_000]), Poly::default()];
    let nothing = RequiredSigns {
        window: &all,
        positive: vec![],
        not_all_zero: None,
    };
    let in_window = RequiredSigns {
        window: &tight,
        positive: vec![],
        not_all_zero: None,
    };
    let positive = RequiredSigns {
        window: &all,
        positive: vec![&above],
        not_all_zero: None,
    };
    let not_zero = RequiredSigns {
        window: &all,
        positive: vec![],
        not_all_zero: Some(&free),
    };

    for required in [&nothing, &in_window, &positive, &not_zero] {
        let value = tightened(required);
        let window = required.window;
        assert!(value.interval().lo() >= window.min());
        assert!(window.max().is_none_or(|max| value.interval().hi() <= max));

        let slope = value.interval().horner(&value.poly().derivative());
        assert!(slope.certain_sign() != 0);
    }

    assert_eq!(sign_over_interval(&above, &tightened(&positive)), 1);
    assert!(sign_over_interval(&free[0], &tightened(&not_zero)) != 0);
}

/// At a point there is nothing to narrow: a sign that is not sure there is zero.
#[test]
fn a_sign_that_is_zero_at_a_point_stays_unsure() {
    let all = Window::all();
    let zero_at_one = Poly::from_ints(&[-1, 1]);
    let negative_at_one = Poly::from_ints(&[-2, 1]);
    let not_zero = [negative_at_one];
    let zero = [zero_at_one.clone()];
    let mut one = Algebraic::rational(whole(1));
    let unsure = Err(AttemptFailure::Precision {
        limit: MAX_HALVINGS,
    });

    let positive = RequiredSigns {
        window: &all,
        positive: vec![&zero_at_one],
        not_all_zero: None,
    };
    assert_eq!(positive.tighten(&mut one), unsure);
    let all_zero = RequiredSigns {
        window: &all,
        positive: vec![],
        not_all_zero: Some(&zero),
    };
    assert_eq!(all_zero.tighten(&mut one), unsure);
    let one_not_zero = RequiredSigns {
        window: &all,
        positive: vec![],
        not_all_zero: Some(&not_zero),
    };
    assert_eq!(one_not_zero.tighten(&mut one), Ok(()));
}

/// numerator / 10,000 as a linear polynomial's root.
fn ten_thousandths(numerator: i64) -> Poly {
    Poly::from_ints(&[-numerator, 10_000])
}

/// A radius relative to 1 + |value|, within which roots are taken, the nearest first.
#[test]
fn roots_are_taken_near_the_candidate_nearest_first() {
    assert_eq!(
        candidate(-3.0, &[1.0]).near(),
        [-3.0 - 4.0 * VALUE_RADIUS, -3.0 + 4.0 * VALUE_RADIUS]
    );

    let p = identity(1, vec![]);
    let rows = IntegralRows::of(&p);
    let on_support = TriedSupport {
        pencil: &p,
        rows: &rows,
        window: &Window::all(),
        support: &[0],
        active: active(&p, &[0]),
        candidate: &candidate(2.0, &[1.0]),
    };
    let polynomials = [19_999, 20_002, 20_000, 20_004, 19_000].map(ten_thousandths);

    let found = on_support.roots_near(&polynomials).unwrap();

    let expected = [20_000, 19_999, 20_002];
    assert_eq!(found.len(), expected.len());
    for (mut root, numerator) in found.into_iter().zip(expected) {
        root.refine_to(&rational(1, 1 << 40));
        let distance = (root.interval().mid() - rational(numerator, 10_000)).abs();
        assert!(distance < rational(1, 1 << 39));
    }
}

/// 2t - 3 is 1 at t = 2, and 0 or less in the middle of an interval that begins at 0 or 1.
#[test]
fn a_direction_is_compared_at_the_value_itself() {
    for (given, is_away) in [(1.0, false), (-1.0, true)] {
        let mut two = nonnegative_roots(&Poly::from_ints(&[-2, 1])).remove(0);
        let x = [Poly::from_ints(&[-3, 2])];

        let is_negative = has_negative_product(&x, &candidate(2.0, &[given]), &mut two);

        assert_eq!(is_negative, is_away);
        assert!((two.interval().mid() - whole(2)).abs() < rational(1, 1 << 60));
    }
}
