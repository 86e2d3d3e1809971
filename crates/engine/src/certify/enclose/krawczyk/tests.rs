//! Bits of the preconditioner, and the inequality for the radii.

use super::*;

/// [[v, -v / 2], [0, v / 4]].
fn inverse_of_size(v: f64) -> Vec<Vec<f64>> {
    vec![vec![v, -0.5 * v], vec![0.0, 0.25 * v]]
}

fn power_of_two(exponent: u32) -> Integer {
    Integer::from(1) << exponent
}

fn slope(column: usize, value: f64) -> Slope {
    Slope {
        column,
        value,
        size: value.abs(),
    }
}

/// The largest entry has PRECONDITIONER_BITS bits, or as many after the point as are needed.
#[test]
fn a_preconditioner_keeps_its_bits() {
    let bits = PRECONDITIONER_BITS as u32;
    for (largest, log) in [(1.0, 0i64), (8.0, 3), (0.125, -3), (1024.0, 10)] {
        let inverse = inverse_of_size(largest);
        let exponent = exponent(&inverse, &[0, 0], 0.0);
        let rows = round(&inverse, &[0, 0], exponent);

        assert_eq!(i64::from(exponent), i64::from(bits) - log);
        assert_eq!(rows[0], [power_of_two(bits), -power_of_two(bits - 1)]);
    }

    let inverse = inverse_of_size(1.0);
    assert_eq!(exponent(&inverse, &[3, 0], 100.0), 103);
    let rows = round(&inverse, &[3, 0], 103);
    assert_eq!(rows[0], [power_of_two(100), -power_of_two(102)]);

    // A need beyond doubles is beyond the limit, and nothing of that length is computed.
    assert!(exponent(&inverse, &[3, 0], f64::INFINITY) > MAX_EXPONENT);
}

/// Bits for n entries of a row against the narrowest side: n = 2, reaches 4.25 and 120.5, sides 4
/// and 1/8: 1928 < 2^11.
#[test]
fn rounding_is_small_beside_the_narrowest_side() {
    let first = vec![slope(0, 1.0), slope(1, -2.0)];
    let second = vec![slope(0, 30.0), slope(1, 4.0)];

    let bits = rounding_bits(&[first, second], &[4.0, 0.125]);

    assert_eq!(bits, 11.0 + f64::from(PRECONDITIONER_LOSS_BITS));
}

/// Of [[2, 0], [0, 1]] with Y = [[1/2, 1/8], [0, 1]] the product leaves |I - YJ| = [[0, 1/8], [0,
/// 0]], and the units of the second component are four times those of the first.
#[test]
fn the_contraction_is_counted_in_units_of_the_grid() {
    let jacobian = [vec![slope(0, 2.0)], vec![slope(1, 1.0)]];
    let y = [vec![0.5, 0.125], vec![0.0, 1.0]];

    let error = contraction(&y, &jacobian, &[1.0, 4.0]);

    assert!((error[0][1] - 0.5).abs() < 1e-12, "{error:?}");
    assert!(error[0][0] < 1e-12, "{error:?}");
    assert!(error[1][0] < 1e-12, "{error:?}");
    assert!(error[1][1] < 1e-12, "{error:?}");
}

#[test]
fn powers_of_two_are_not_below() {
    assert_eq!(
        [0.0, 1.0, 1.5, 2.0, 1025.0].map(power_above),
        [1.0, 1.0, 2.0, 2.0, 2048.0]
    );
    assert_eq!([power(3), power(-2), power(-5000)], [8.0, 0.25, 0.0]);
}
