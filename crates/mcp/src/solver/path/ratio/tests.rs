//! The two rules at their limits, on tableaus whose rates and blocks are given.

use super::super::tests::at_start;
use super::super::{Start, Subproblem};
use super::*;
use nalgebra::{DMatrix, dmatrix};

const INF: f64 = f64::INFINITY;

#[test]
fn first_difference_decides_and_rounding_does_not() {
    assert_eq!(lexicographic(&[1.0, 2.0], &[1.0, 3.0]), Ordering::Less);
    assert_eq!(
        lexicographic(&[1.0 + 1e-15, 4.0], &[1.0, 3.0]),
        Ordering::Greater
    );
    assert_eq!(lexicographic(&[1.0, 3.0], &[1.0, 3.0]), Ordering::Equal);
}

/// Equal within LEXICOGRAPHIC times the largest entry of either row.
#[test]
fn components_are_compared_relative_to_the_larger_row() {
    for size in [1e-9, 1.0, 1e6] {
        let row = |more: f64, scale: f64| [scale * size, more * LEXICOGRAPHIC * size, 0.0];
        for (a, b) in [(1.0, 0.5), (-0.5, -1.0)] {
            // The second components decide only if they differ by enough; else the third ones.
            let order = |more: f64| {
                lexicographic(
                    &[row(more, 0.0).as_slice(), &[a * size]].concat(),
                    &[row(0.0, 0.0).as_slice(), &[b * size]].concat(),
                )
            };

            assert_eq!(order(0.9), Ordering::Greater);
            assert_eq!(order(-0.9), Ordering::Greater);
            assert_eq!(order(-1.1), Ordering::Less);
            assert_eq!(order(1.1), Ordering::Greater);
        }
    }

    assert_eq!(lexicographic(&[0.0; 2], &[0.0; 2]), Ordering::Equal);
}

fn with_two_rows<R>(look: impl FnOnce(PathTableau<'_, f64>) -> R) -> R {
    let m = DMatrix::from_element(2, 2, 1.0);
    let sub = Subproblem {
        m: &m,
        q: &[-1.0, -1.0],
        lower: &[0.0; 2],
        upper: &[INF; 2],
    };
    at_start(&sub, Start::Ray, &[0.0; 2], look)
}

fn at(step: f64, place: Option<usize>) -> BlockingVariable<f64> {
    BlockingVariable {
        step,
        place,
        at_upper: false,
    }
}

/// Perturbed by (eps, eps^2) place 1 comes before place 0: where the two are tied it is the first,
/// else the nearer one.
#[test]
fn steps_are_tied_within_a_width_relative_to_one_and_the_step() {
    with_two_rows(|mut tableau| {
        tableau.state.rates = vec![-1.0, -1.0];
        for least in [0.0, 3.0, 1000.0] {
            let mut first = |width: f64| {
                lexicographic_test(
                    &mut tableau,
                    &[
                        at(least, Some(0)),
                        at(least + width * TIE * (1.0 + least), Some(1)),
                    ],
                )
            };

            assert_eq!(
                [first(0.9), first(1.1)].map(|b| b.unwrap().place),
                [Some(1), Some(0)],
                "{least}"
            );
        }

        assert_eq!(lexicographic_test(&mut tableau, &[]), None);

        // The faster its value falls, the less the perturbation delays it.
        tableau.state.rates = vec![-1e6, -1.0];
        let tied = [at(2.0, Some(0)), at(2.0, Some(1))];

        assert_eq!(
            lexicographic_test(&mut tableau, &tied).unwrap().place,
            Some(1)
        );

        // The own bound is not perturbed: what decreases with eps comes before it, what increases
        // after it.
        for (rate, expected) in [(-1.0, None), (1.0, Some(0))] {
            tableau.state.rates = vec![rate, rate];
            tableau.entering = Variable::Z(0);
            for tied in [
                [at(2.0, Some(0)), at(2.0, None)],
                [at(2.0, None), at(2.0, Some(0))],
            ] {
                assert_eq!(
                    lexicographic_test(&mut tableau, &tied).unwrap().place,
                    expected,
                    "{rate}"
                );
            }
        }
    });
}

/// Two bounds, the farther one with the larger pivot: it is taken as long as it lies within the
/// width, which grows with the pivots.
#[test]
fn bounds_widen_with_every_pivot() {
    with_two_rows(|tableau| {
        tableau.state.rates = vec![-1.0, -2.0];
        for pivots in [0, 1, 500, 999] {
            let width = EXPAND_WIDTH + pivots as f64 * EXPAND_STEP;
            let first = |share: f64| {
                expand_test(
                    &tableau,
                    &[at(0.0, Some(0)), at(share * width, Some(1))],
                    pivots,
                )
                .unwrap()
                .place
            };

            assert_eq!(first(0.9), Some(1), "{pivots}");
            assert_eq!(first(1.1), Some(0), "{pivots}");
        }

        // The width is that of the bound: a slow value takes longer to cross it.
        tableau.state.rates = vec![-0.25, -0.5];
        let first = |share: f64| {
            expand_test(
                &tableau,
                &[at(0.0, Some(0)), at(share * EXPAND_WIDTH, Some(1))],
                0,
            )
            .unwrap()
            .place
        };

        assert_eq!(first(3.9), Some(1));
        assert_eq!(first(4.1), Some(0));
        assert_eq!(expand_test(&tableau, &[], 0), None);
    });
}

/// Every step goes forward by EXPAND_STEP at the bound; those that stop at their bound exactly do
/// not.
#[test]
fn expand_steps_forward_unless_the_stop_is_exact() {
    with_two_rows(|mut tableau| {
        tableau.state.rates = vec![-4.0, -2.0];
        let step = |tableau: &PathTableau<'_, f64>, block: BlockingVariable<f64>| {
            expand_test(tableau, &[block], 7).unwrap().step
        };

        assert_eq!(step(&tableau, at(0.0, Some(0))), EXPAND_STEP / 4.0);
        assert_eq!(step(&tableau, at(1.0, Some(0))), 1.0);

        // A flip: the moving z stops at its other bound.
        tableau.entering = Variable::Z(0);
        assert_eq!(step(&tableau, at(0.0, None)), 0.0);

        // t at 1, and artificials at 0, which go before all others within reach.
        for exact in [Variable::T, Variable::Artificial(1)] {
            tableau.basis.variables[1] = exact;
            assert_eq!(step(&tableau, at(0.0, Some(1))), 0.0);
            assert_eq!(
                expand_test(&tableau, &[at(0.0, Some(0)), at(0.0, Some(1))], 0)
                    .unwrap()
                    .place,
                Some(1)
            );
        }
    });
}

/// Each basic value meets the bound it moves to; a pivot counts from PIVOT of the fastest rate (at
/// least 1) on.
#[test]
fn blocks_are_the_bounds_ahead_of_values_that_move() {
    let m = dmatrix![1.0, 0.0; 0.0, 1.0];
    let sub = Subproblem {
        m: &m,
        q: &[-1.0, -1.0],
        lower: &[0.0, -INF],
        upper: &[8.0, 8.0],
    };
    at_start(&sub, Start::Regular, &[2.0, 5.0], |tableau| {
        assert_eq!(tableau.basis.variables, [Variable::Z(0), Variable::Z(1)]);

        let mut blocks = |rates: [f64; 2]| {
            tableau.state.rates = rates.to_vec();
            let mut list = vec![at(9.0, None)];
            list_blocks(&tableau, &mut list);
            list
        };
        let block = |step, place, at_upper| BlockingVariable {
            step,
            place,
            at_upper,
        };
        let own = block(1.0, None, true); // t from 0 to 1

        // The other falls without end.
        assert_eq!(
            blocks([0.5, -2.0]),
            [block(12.0, Some(0), true), own.clone()]
        );
        assert_eq!(
            blocks([-0.5, 2.0]),
            [
                block(4.0, Some(0), false),
                block(1.5, Some(1), true),
                own.clone()
            ]
        );

        for fast in [1.0, 0.25, 100.0] {
            let least = PIVOT * f64::max(fast, 1.0);
            assert_eq!(
                [1.1, 0.9].map(|share| blocks([share * least, fast]).len()),
                [3, 2],
                "{fast}"
            );
        }

        assert_eq!(blocks([0.0, 0.0]), [own]);

        // A value beyond its bound blocks at once.
        tableau.state.values[0] = -1e-13;
        tableau.state.rates = vec![-1.0, 0.0];
        let mut list = Vec::new();
        list_blocks(&tableau, &mut list);

        assert_eq!(list[0].step, 0.0);
    });
}

/// A row is kept for the best block alone: after one that came before by its rank, it is another's.
#[test]
fn rows_are_compared_with_that_of_the_best() {
    let m = DMatrix::from_element(4, 4, 1.0);
    let sub = Subproblem {
        m: &m,
        q: &[-1.0; 4],
        lower: &[0.0; 4],
        upper: &[INF; 4],
    };
    at_start(&sub, Start::Ray, &[0.0; 4], |mut tableau| {
        tableau.state.rates = vec![-1.0; 4];
        (tableau.basis.variables[2], tableau.basis.variables[3]) =
            (Variable::Artificial(2), Variable::Artificial(3));

        for order in [[0, 1, 3, 2], [1, 0, 2, 3], [0, 3, 2, 1], [3, 1, 0, 2]] {
            let tied = order.map(|place| at(1.0, Some(place)));
            assert_eq!(
                lexicographic_test(&mut tableau, &tied).unwrap().place,
                Some(3),
                "{order:?}"
            );
        }
    });
}
