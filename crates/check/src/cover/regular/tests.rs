//! The leaf against determinants: what it accepts has no singular matrix between its corners.

use super::super::ball::BallMatrix;
use super::*;
use crate::certificate::VariableState;
use mceip_exact::{Integer, rational, whole};
use num_traits::Zero;

const INDEX: [usize; 3] = [10, 11, 12];

/// Entries of a matrix of order 2 or 3, in units of 1/8.
type Small = Vec<Vec<i64>>;

fn integers(m: &Small) -> Vec<Vec<Integer>> {
    m.iter()
        .map(|row| row.iter().map(|&v| Integer::from(v)).collect())
        .collect()
}

fn region(states: &[VariableState]) -> Region {
    let mut region = Region::new(whole(0).into(), Some(whole(1).into()), None, 0);
    region.states = states.to_vec();
    region
}

/// Y, u and v of order `left.len()`, with 11 as the pivot.
fn witness(inverse: &Small, left: &[i64], right: &[i64], exponent: u32) -> Regular {
    let vector = |list: &[i64]| list.iter().map(|&v| Integer::from(v)).collect();
    Regular {
        pivot: 11,
        inverse: integers(inverse),
        inverse_exponent: exponent,
        left: vector(left),
        right: vector(right),
        exponent,
    }
}

/// The verdict on corners in units of 1/8, on the first `order` variables.
fn verdict_on(
    order: usize,
    corners: &[(Small, Small)],
    witness: &Regular,
) -> Result<(), CoverFault> {
    let scale = Integer::from(8);
    let matrices: Vec<BallMatrix<Integer>> = corners
        .iter()
        .map(|(m, r)| BallMatrix {
            m: integers(m),
            r: integers(r),
        })
        .collect();
    let corners: Vec<EndMatrix<'_>> = matrices
        .iter()
        .map(|matrix| EndMatrix {
            matrix,
            scale: &scale,
            name: "lower",
            is_limit: false,
        })
        .collect();

    let bordered = Bordered::new((0..order).collect(), &INDEX, witness.into())?;
    check_corners(&bordered, &corners)
}

/// T = [[8, 0], [0, 4]] / 8 on the variables 10 and 11, with a radius in one place.
fn with_radius(i: usize, j: usize, radius: i64) -> (Small, Small) {
    let mut r = vec![vec![0; 2]; 2];
    r[i][j] = radius;
    (vec![vec![8, 0], vec![0, 4]], r)
}

/// By hand: with Y = 1 and u = v = 0, rho is the radius of T_00, q and p are the radii of T_01 and
/// T_10, h is 1/2 and g the radius of T_11.
#[test]
fn the_radius_of_each_entry_counts() {
    let witness = witness(&vec![vec![4]], &[0], &[0], 2);
    let verdict = |corners: &[(Small, Small)]| verdict_on(2, corners, &witness);

    // rho = 7/8 < 1, and rho = 1.
    assert_eq!(verdict(&[with_radius(0, 0, 7)]), Ok(()));
    let got = whole(1);
    assert_eq!(
        verdict(&[with_radius(0, 0, 8)]),
        Err(CoverFault::NotRegular { got })
    );

    // h - g = 1/8, and 0.
    assert_eq!(verdict(&[with_radius(1, 1, 3)]), Ok(()));
    assert_eq!(
        verdict(&[with_radius(1, 1, 4)]),
        Err(CoverFault::SignChange)
    );

    // P epsilon = P 1/8 with P = 3/8 at another corner: 3/64; h = 1/2 and g = 3/8.
    let others = [with_radius(0, 1, 1), with_radius(1, 0, 3)];
    let [first, second] = others.clone();
    assert_eq!(verdict(&[first, second, with_radius(1, 1, 3)]), Ok(()));

    // With epsilon = 3/8, 9/64 is more than 1/8.
    let [_, second] = others;
    assert_eq!(
        verdict(&[with_radius(0, 1, 3), second, with_radius(1, 1, 3)]),
        Err(CoverFault::SignChange)
    );

    // rho enters epsilon: 3/64 / (1 - 5/8) = 1/8, and 3/64 / (1 - 4/8) = 3/32.
    for (rho, expected) in [(4, Ok(())), (5, Err(CoverFault::SignChange))] {
        let corners = [
            with_radius(0, 0, rho),
            with_radius(0, 1, 1),
            with_radius(1, 0, 3),
            with_radius(1, 1, 3),
        ];
        assert_eq!(verdict(&corners), expected, "{rho}");
    }
}

/// One sign at all corners, whichever it is, but not one at each.
#[test]
fn both_signs_will_do_but_not_together() {
    let witness = witness(&vec![vec![4]], &[0], &[0], 2);
    let corner = |last: i64| (vec![vec![8, 0], vec![0, last]], vec![vec![0; 2]; 2]);
    let verdict = |corners: &[(Small, Small)]| verdict_on(2, corners, &witness);

    assert_eq!(verdict(&[corner(1), corner(4)]), Ok(()));
    assert_eq!(verdict(&[corner(-1), corner(-4)]), Ok(()));
    let refused = Err(CoverFault::SignChange);
    assert_eq!(verdict(&[corner(-1), corner(4)]), refused);
    assert_eq!(verdict(&[corner(4), corner(-1)]), refused);
    assert_eq!(verdict(&[corner(0), corner(4)]), refused);
}

#[test]
fn the_witness_belongs_to_the_variables_that_move() {
    let one = witness(&vec![vec![4]], &[0], &[0], 2);
    let support = |states: [VariableState; 3], witness: &Regular| {
        let bordered = Bordered::of_leaf(&region(&states), &INDEX, witness.into());
        bordered.map(|bordered| bordered.support)
    };
    let states = [
        VariableState::InSupport,
        VariableState::InSupport,
        VariableState::AtZero,
    ];
    assert_eq!(support(states, &one), Ok(vec![0, 1]));

    let open = [
        VariableState::InSupport,
        VariableState::InSupport,
        VariableState::Undecided,
    ];
    let early = Err(CoverFault::RootTooEarly);
    assert_eq!(support(open, &one), early);
    assert_eq!(support([VariableState::AtZero; 3], &one), early);

    let resting = [
        VariableState::InSupport,
        VariableState::AtZero,
        VariableState::InSupport,
    ];
    let pivot = Err(CoverFault::Pivot { index: 11 });
    assert_eq!(support(resting, &one), pivot);

    let first = Regular {
        pivot: 10,
        ..one.clone()
    };
    assert_eq!(support(states, &first), Ok(vec![1, 0]));

    let longest = Regular {
        exponent: 1 << 14,
        ..one.clone()
    };
    assert!(support(states, &longest).is_ok());
    for (exponent, inverse_exponent) in [((1 << 14) + 1, 0), (0, (1 << 14) + 1)] {
        let longer = Regular {
            exponent,
            inverse_exponent,
            ..one.clone()
        };
        let refused = support(states, &longer);
        assert!(matches!(refused, Err(CoverFault::TooLarge { .. })));
    }

    let short = Regular {
        left: vec![],
        ..one.clone()
    };
    let refused = support(states, &short);
    assert!(matches!(refused, Err(CoverFault::Length { .. })));
}

/// 8 q^3 y e' with y = 1 + b / 64 for the longest of numbers and exponents.
#[test]
fn the_work_is_that_of_the_page() {
    let work = |number: i64, [inverse_exponent, exponent]: [u32; 2], corner_bits| {
        let witness = Regular {
            inverse_exponent,
            ..witness(&vec![vec![number]], &[number], &[number], exponent)
        };
        NullWitness::from(&witness).work(2, corner_bits)
    };

    assert_eq!(work(3, [0, 0], 0), 64);
    assert_eq!(work(3, [0, 0], 128), 64 * 3);
    assert_eq!(work(3, [64, 0], 127), 64 * 2 * 2);
    assert_eq!(work(3, [0, 130], 0), 64 * 3);
    assert_eq!(work(i64::MIN, [0, 0], 0), 64 * 2);
}

/// A generator of digits (Knuth's multiplier).
struct Digits(u64);

impl Digits {
    /// From -most to most.
    fn next(&mut self, most: i64) -> i64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let size = 2 * most.unsigned_abs() + 1;
        ((self.0 >> 33) % size) as i64 - most
    }
}

fn determinant(m: &[Vec<Rational>]) -> Rational {
    if m.is_empty() {
        return whole(1);
    }

    let mut sum = whole(0);
    for (j, entry) in m[0].iter().enumerate() {
        let minor: Vec<Vec<Rational>> = m[1..]
            .iter()
            .map(|row| {
                let mut row = row.clone();
                row.remove(j);
                row
            })
            .collect();
        let term = entry * determinant(&minor);
        sum = if j % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}

/// Four matrices about one, with radii, and a witness about its own: where the leaf is accepted, no
/// mean of matrices within the radii is singular.
#[test]
fn what_is_accepted_has_no_singular_matrix() {
    let mut digits = Digits(20_240_717);
    let mut accepted = 0;
    let mut refused = 0;

    for round in 0..4000 {
        let order = 2 + round % 2;
        let center: Small = (0..order)
            .map(|i| {
                (0..order)
                    .map(|j| digits.next(7) + if i == j { 9 } else { 0 })
                    .collect()
            })
            .collect();
        let corners: Vec<(Small, Small)> = (0..4)
            .map(|_| {
                let m = center
                    .iter()
                    .map(|row| row.iter().map(|v| v + digits.next(2)).collect())
                    .collect();
                let r = center
                    .iter()
                    .map(|row| row.iter().map(|_| digits.next(1).max(0)).collect())
                    .collect();
                (m, r)
            })
            .collect();

        let Some(witness) = witness_of(&center, &mut digits) else {
            continue;
        };
        if verdict_on(order, &corners, &witness).is_err() {
            refused += 1;
            continue;
        }

        accepted += 1;
        for _ in 0..20 {
            assert!(!determinant(&mean(&corners, &mut digits)).is_zero());
        }
    }

    assert!(accepted > 200 && refused > 200, "{accepted} {refused}");
}

/// Y, u and v of a matrix in units of 1/8, rounded to units of 2^-8, and u and v moved a little.
fn witness_of(center: &Small, digits: &mut Digits) -> Option<Regular> {
    let rest: Vec<usize> = (0..center.len()).filter(|&i| i != 1).collect();
    let entry = |i: usize, j: usize| rational(center[i][j], 8);
    let block: Vec<Vec<Rational>> = rest
        .iter()
        .map(|&i| rest.iter().map(|&j| entry(i, j)).collect())
        .collect();
    let size = determinant(&block);
    if size.is_zero() {
        return None;
    }

    let inverse = match block.len() {
        1 => vec![vec![block[0][0].recip()]],
        _ => vec![
            vec![&block[1][1] / &size, -&block[0][1] / &size],
            vec![-&block[1][0] / &size, &block[0][0] / &size],
        ],
    };
    let rounded = |v: Rational| (v * whole(256)).round().to_integer();
    let mut left = Vec::new();
    let mut right = Vec::new();
    for place in 0..rest.len() {
        let mut u = whole(0);
        let mut v = whole(0);
        for (k, &i) in rest.iter().enumerate() {
            u -= entry(1, i) * &inverse[k][place];
            v -= &inverse[place][k] * entry(i, 1);
        }
        left.push(rounded(u) + digits.next(8));
        right.push(rounded(v) + digits.next(8));
    }

    Some(Regular {
        pivot: 11,
        inverse: inverse
            .into_iter()
            .map(|row| row.into_iter().map(rounded).collect())
            .collect(),
        inverse_exponent: 8,
        left,
        right,
        exponent: 8,
    })
}

/// A mean of matrices within the radii of the corners, each entry at one end of its radius.
fn mean(corners: &[(Small, Small)], digits: &mut Digits) -> Vec<Vec<Rational>> {
    let mut shares: Vec<Rational> = corners.iter().map(|_| whole(digits.next(3) + 3)).collect();
    let total: Rational = shares.iter().sum();
    if total.is_zero() {
        shares[0] = whole(1);
    } else {
        shares.iter_mut().for_each(|share| *share /= &total);
    }

    let order = corners[0].0.len();
    let mut mean = vec![vec![whole(0); order]; order];
    for ((m, r), share) in corners.iter().zip(&shares) {
        for i in 0..order {
            for j in 0..order {
                let side = digits.next(1);
                mean[i][j] += whole(m[i][j] + side * r[i][j]) * share;
            }
        }
    }
    mean
}
