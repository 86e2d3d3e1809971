//! The error of the equations against its definition, and the moves one by one.

use super::super::super::options::RatioTest;
use super::super::ratio::ratio_test;
use super::super::tests::at_start;
use super::super::{Start, Subproblem};
use super::*;
use nalgebra::{DMatrix, dmatrix};

const INF: f64 = f64::INFINITY;

/// |M z - w + v - t r + q + r| over the largest of |q| + |r| and of the terms of the basic
/// unknowns.
fn drift_by_definition(
    tableau: &PathTableau<'_, f64>,
    m: &DMatrix<f64>,
    q: &[f64],
    r: &[f64],
) -> f64 {
    let n = q.len();
    let mut sum: Vec<f64> = (0..n).map(|i| q[i] + r[i]).collect();
    let mut size: f64 = largest(q) + largest(r);
    let mut z = tableau.state.z.clone();

    for (variable, value) in tableau.basis.variables.iter().zip(&tableau.state.values) {
        size = size.max(match *variable {
            Variable::Z(i) => {
                z[i] = 0.0;
                let column: Vec<f64> = (0..n).map(|row| m[(row, i)]).collect();
                for row in 0..n {
                    sum[row] += column[row] * value;
                }
                largest(&column) * value.abs()
            }
            Variable::W(i) => {
                sum[i] -= value;
                value.abs()
            }
            Variable::V(i) => {
                sum[i] += value;
                value.abs()
            }
            Variable::T => {
                for row in 0..n {
                    sum[row] -= r[row] * value;
                }
                largest(r) * value.abs()
            }
            Variable::Artificial(_) => unreachable!("regular starts"),
        });
    }

    for i in 0..n {
        for j in 0..n {
            sum[i] += m[(i, j)] * z[j];
        }
    }

    largest(&sum) / size
}

fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
}

#[test]
fn drift_is_the_error_of_the_equations_relative_to_their_terms() {
    let m = dmatrix![2.0, 1.0, 0.5; 1.0, 3.0, -1.0; 0.0, 0.25, 4.0];

    // At the start w, v and z are basic; the errors are in one of them each, the sizes small and
    // large beside q and r.
    for (current, q) in [
        ([0.0, 2.0, 5.0], [9.0, -1.0, -30.0]),
        ([0.0, 300.0, 5.0], [0.0, 0.5, -21.0]),
        ([0.0, 1.0, 5.0], [0.0; 3]),
    ] {
        let sub = Subproblem {
            m: &m,
            q: &q,
            lower: &[0.0; 3],
            upper: &[INF, INF, 5.0],
        };
        at_start(&sub, Start::Regular, &current, |mut tableau| {
            assert_eq!(
                tableau.basis.variables,
                [Variable::W(0), Variable::Z(1), Variable::V(2)]
            );
            assert!(tableau.drift() < 1e-15);

            let r: Vec<f64> = tableau
                .columns
                .dense(Variable::T)
                .iter()
                .map(|v| -v)
                .collect();

            for place in 0..3 {
                for error in [1e-3, -7.0, 1e4] {
                    let exact = tableau.state.values[place];
                    tableau.state.values[place] += error;
                    let expected = drift_by_definition(&tableau, &m, &q, &r);

                    approx::assert_relative_eq!(tableau.drift(), expected, max_relative = 1e-9);

                    tableau.state.values[place] = exact;
                }
            }
        });
    }
}

/// An error just below DRIFT stays, one just above is mended by factors and values from scratch.
#[test]
fn values_are_made_anew_when_they_drift() {
    let m = dmatrix![1.0, 0.0; 0.0, 1.0];
    let sub = Subproblem {
        m: &m,
        q: &[-1.0, -1.0],
        lower: &[0.0; 2],
        upper: &[INF; 2],
    };

    for (share, refreshed) in [(0.9, 0), (1.1, 1)] {
        at_start(&sub, Start::Ray, &[0.0; 2], |mut tableau| {
            tableau.set_rates();
            let block = ratio_test(&mut tableau, RatioTest::Lexicographic, 0).unwrap();
            tableau.advance(&block.step);
            let place = block.place.unwrap();
            let other = 1 - place;

            // Both are zero there, and no term is larger than |q| + |r|.
            assert_eq!(tableau.state.values[other], 0.0);
            assert_eq!(tableau.columns.scale(), 3.0);

            tableau.state.values[other] = share * (DRIFT * 3.0);
            assert!(tableau.exchange(place, block.at_upper));
            assert_eq!(tableau.basis.refreshed, refreshed, "{share}");
        });
    }
}

/// Without q and r there is nothing to be relative to.
#[test]
fn nothing_does_not_drift() {
    let m = dmatrix![0.0];
    let sub = Subproblem {
        m: &m,
        q: &[0.0],
        lower: &[0.0],
        upper: &[INF],
    };
    at_start(&sub, Start::Regular, &[0.0], |mut tableau| {
        tableau.state.values[0] = 0.0;
        assert_eq!(tableau.drift(), 0.0);
    });
}

#[test]
fn rooms_are_up_to_the_bound_ahead() {
    let m = dmatrix![1.0, 0.0; 0.0, 1.0];
    let sub = Subproblem {
        m: &m,
        q: &[-1.0, 7.0],
        lower: &[-2.0, 3.0],
        upper: &[8.0, 3.0],
    };
    at_start(&sub, Start::Regular, &[2.0, 3.0], |mut tableau| {
        let room = |tableau: &mut PathTableau<'_, f64>, entering, sign| {
            tableau.entering = entering;
            tableau.sign = sign;
            tableau.own_room()
        };

        assert_eq!(room(&mut tableau, Variable::Z(0), 1.0), 6.0);
        assert_eq!(room(&mut tableau, Variable::Z(0), -1.0), 4.0);

        tableau.t = 0.25;
        assert_eq!(room(&mut tableau, Variable::T, 1.0), 0.75);
        assert_eq!(room(&mut tableau, Variable::T, -1.0), INF);

        tableau.state.multiplier[0] = -5.0; // v = 5
        assert_eq!(room(&mut tableau, Variable::V(0), 1.0), INF);
        assert_eq!(room(&mut tableau, Variable::V(0), -1.0), 5.0);

        tableau.state.multiplier[0] = 5.0; // w = 5
        assert_eq!(room(&mut tableau, Variable::W(0), 1.0), INF);
        assert_eq!(room(&mut tableau, Variable::W(0), -1.0), 5.0);

        // The multiplier of equal bounds is free; an artificial stays where it is.
        assert_eq!(room(&mut tableau, Variable::W(1), 1.0), INF);
        assert_eq!(room(&mut tableau, Variable::W(1), -1.0), INF);
        assert_eq!(room(&mut tableau, Variable::Artificial(0), 1.0), 0.0);
        assert_eq!(room(&mut tableau, Variable::Artificial(0), -1.0), 0.0);
    });
}

/// After a flip the multiplier of the bound just reached grows.
#[test]
fn a_flip_ends_at_the_other_bound() {
    let m = dmatrix![1.0];
    let sub = Subproblem {
        m: &m,
        q: &[-1.0],
        lower: &[-2.0],
        upper: &[8.0],
    };

    for (sign, bound, next) in [(1.0, 8.0, Variable::V(0)), (-1.0, -2.0, Variable::W(0))] {
        at_start(&sub, Start::Ray, &[0.0], |mut tableau| {
            tableau.entering = Variable::Z(0);
            tableau.sign = sign;
            tableau.flip();
            assert_eq!(tableau.state.z[0], bound);
            assert_eq!(tableau.entering, next);
            assert_eq!(tableau.sign, 1.0);
        });
    }
}

/// The complement of what leaves moves next: a multiplier up from zero, z away from its bound.
#[test]
fn the_complement_moves_next() {
    let m = dmatrix![1.0];
    let sub = Subproblem {
        m: &m,
        q: &[-1.0],
        lower: &[-2.0],
        upper: &[8.0],
    };
    at_start(&sub, Start::Ray, &[0.0], |mut tableau| {
        for (leaving, at_upper, next, sign) in [
            (Variable::W(0), false, Variable::Z(0), 1.0),
            (Variable::V(0), false, Variable::Z(0), -1.0),
            (Variable::Z(0), false, Variable::W(0), 1.0),
            (Variable::Z(0), true, Variable::V(0), 1.0),
        ] {
            tableau.set_successor(leaving, at_upper);
            assert_eq!(tableau.entering, next);
            assert_eq!(tableau.sign, sign);
        }

        assert_eq!(tableau.state.z[0], 8.0);
    });
}

/// Held inside by an artificial, z_i may move both ways: the one in which t rises.
#[test]
fn after_an_artificial_t_rises() {
    for (slope, sign) in [(2.0, 1.0), (-2.0, -1.0)] {
        let m = dmatrix![1.0, slope; 0.0, 1.0];
        let sub = Subproblem {
            m: &m,
            q: &[3.0, 0.0],
            lower: &[-INF; 2],
            upper: &[INF; 2],
        };
        at_start(&sub, Start::Regular, &[1.0, 0.0], |mut tableau| {
            // The artificial stands for z_1, t for z_0.
            let mut given = Vec::new();
            let mut column = vec![0.0; 2];

            for (place, variable) in [(1, Variable::Artificial(1)), (0, Variable::T)] {
                tableau.columns.write(variable, &mut given);
                tableau.basis.solve(&given, &mut column);
                tableau.basis.replace(place, variable, &column);
            }

            tableau.set_successor(Variable::Artificial(1), false);

            // M z - t r = const in its first row: with z_0 at rest t changes by slope / r_0 for
            // each unit of z_1.
            let r = -tableau.columns.dense(Variable::T)[0];

            assert_eq!(tableau.entering, Variable::Z(1));
            assert_eq!(tableau.sign, sign * r.signum());
        });
    }
}
