//! The Farkas test as a matrix game, solved by the simplex method without a phase 1.
//!
//! The row player mixes rows of T (rows of the support with either sign), the column player the
//! columns that may be in the support, at both ends of the interval. The row player's value is the
//! largest margin with which some w makes every entry of w'T negative; the column player's mix is
//! the x closest to a solution when there is no such w. (von Neumann 1928; Dantzig 1951 for the
//! equivalence with LP.)
//!
//! All payoffs are made positive by a shift. Then the column player's problem is
//! `max sum q, P q <= 1, q >= 0`, which is feasible at q = 0, and its dual is the row player's.
//!
//! Called by the leaf `farkas` and by `analysis::absence`.

use super::pieces::skyline::dot;
use super::tableau::{GameTableau, Strategy};
use crate::tolerance::GAME_SHIFT;

/// A solved game.
pub(crate) struct Game {
    /// min over columns of -(w'T): positive if w proves the region empty.
    pub(crate) value: f64,
    /// The row player's weights, |w| summing to one.
    pub(crate) w: Vec<f64>,
    /// The column player's mix.
    pub(crate) mix: Vec<f64>,
}

/// Solves the game for `columns` of T; `either_sign[i]` says that w_i may be negative.
pub(crate) fn solve(either_sign: &[bool], columns: &[Vec<f64>]) -> Game {
    let rows = either_sign.len();
    if columns.is_empty() {
        return Game {
            value: f64::INFINITY,
            w: vec![0.0; rows],
            mix: Vec::new(),
        };
    }

    let mut strategies = Vec::with_capacity(2 * rows);
    for is_negative in [false, true] {
        for row in (0..rows).filter(|&row| !is_negative || either_sign[row]) {
            strategies.push(Strategy { row, is_negative });
        }
    }

    let shift = positive_shift(&strategies, columns);
    let numbers: Vec<usize> = (0..columns.len()).collect();
    let mut tableau = GameTableau::new(&strategies, columns, &numbers, shift);

    // Weights of a game that has stalled are worse, and their value says so.
    let _ = tableau.optimise();

    let w = tableau.weights(rows);
    let value = columns
        .iter()
        .map(|column| -dot(column, &w))
        .fold(f64::INFINITY, f64::min);
    let mix = tableau.mix(columns.len());
    Game { value, w, mix }
}

/// What makes every payoff positive by a tenth of their range at least.
fn positive_shift(strategies: &[Strategy], columns: &[Vec<f64>]) -> f64 {
    let mut least = f64::INFINITY;
    let mut most = f64::NEG_INFINITY;
    for strategy in strategies {
        for column in columns {
            let payoff = strategy.payoff(column);
            least = least.min(payoff);
            most = most.max(payoff);
        }
    }

    let margin = f64::MIN_POSITIVE.max(GAME_SHIFT * most.abs().max(least.abs()));
    0.1 * (most - least) - least + margin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_negative_row_wins() {
        // Row 1 is negative everywhere: w = e_1 with margin 2.
        let game = solve(&[false, false], &[vec![1.0, -2.0], vec![5.0, -3.0]]);

        approx::assert_relative_eq!(game.value, 2.0, epsilon = 1e-12);
        assert_eq!(game.w, vec![0.0, 1.0]);
    }

    #[test]
    fn the_identity_cannot_be_made_negative_but_with_free_signs_it_can() {
        let identity = [vec![1.0, 0.0], vec![0.0, 1.0]];

        assert!(solve(&[false, false], &identity).value < 0.0);
        let game = solve(&[true, true], &identity);
        approx::assert_relative_eq!(game.value, 0.5, epsilon = 1e-12);
        assert!(solve(&[true, false], &identity).value <= 0.0);
    }

    #[test]
    fn the_mix_is_the_relaxed_solution() {
        // T = [[1, -2], [-2, 1]]: the column player balances both columns.
        let game = solve(&[false, false], &[vec![1.0, -2.0], vec![-2.0, 1.0]]);

        approx::assert_relative_eq!(game.value, 0.5, epsilon = 1e-12);
        approx::assert_relative_eq!(game.mix[0], 0.5, epsilon = 1e-12);
    }
}
