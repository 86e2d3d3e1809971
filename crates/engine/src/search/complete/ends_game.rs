//! The Farkas game of both ends of an interval, kept solved while a region is divided.
//!
//! Deciding a variable takes columns from the column player (x_i = 0) or gives the row player a
//! strategy (y_i = 0). Cutting the interval replaces the columns of one end by those of the cut: T
//! is linear, so they are mixes of the columns of both ends. Each way the game of the part is a
//! restriction of the game of the whole, and the dual simplex method solves it in a few pivots from
//! the tableau of the whole (`tableau`).
//!
//! Only for finite intervals over which the chord is exact. Rounding adds up from part to part, so
//! the weights are tried on the columns themselves before they become a leaf (`leaf::farkas`).
//!
//! Called by `gains`.

use super::pieces::expansion::ChordEnds;
use super::region::possible_support;
use super::tableau::{GameTableau, GameVariable, Strategy};
use crate::tolerance::{ENOUGH_MARGIN, GAME_SHIFT};
use mceip_check::certificate::VariableState;

/// Entries of the columns are at most one in modulus, so that this makes all payoffs positive by a
/// tenth of their range.
const SHIFT: f64 = 1.2 + GAME_SHIFT;

/// A game of both ends, solved.
#[derive(Clone)]
pub(super) struct EndsGame {
    tableau: GameTableau,
    /// By end and position: what a column of T was divided by.
    sizes: [Vec<f64>; 2],
}

impl EndsGame {
    /// Solves the game of a region from nothing; `None` where doubles do not get there.
    pub(super) fn new(ends: &ChordEnds, states: &[VariableState]) -> Option<EndsGame> {
        let order = states.len();
        let mut columns = Vec::new();
        let mut numbers = Vec::new();
        let mut sizes = [vec![1.0; order], vec![1.0; order]];
        for end in 0..2 {
            for position in possible_support(states) {
                let column: Vec<f64> = ends.m[end].iter().map(|row| row[position]).collect();
                let size = column.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
                columns.push(column.into_iter().map(|v| v / size).collect());
                numbers.push(number(position, end));
                sizes[end][position] = size;
            }
        }

        let mut strategies = Vec::with_capacity(order);
        for row in 0..order {
            strategies.push(Strategy {
                row,
                is_negative: false,
            });
        }

        let mut tableau = GameTableau::new(&strategies, &columns, &numbers, SHIFT);
        if !tableau.optimise() {
            return None;
        }

        for (position, state) in states.iter().enumerate() {
            if *state == VariableState::InSupport {
                tableau.add_negative(position);
            }
        }

        tableau
            .repair(ENOUGH_MARGIN)
            .then_some(EndsGame { tableau, sizes })
    }

    /// The margin by which the weights exclude solutions; [`ENOUGH_MARGIN`] ends the search for a
    /// larger one.
    pub(super) fn value(&self) -> f64 {
        self.tableau.value()
    }

    /// The weights, |w| summing to one.
    pub(super) fn weights(&self) -> Vec<f64> {
        self.tableau.weights(self.sizes[0].len())
    }

    /// By how much the mix of the column player breaks the complementarity of a variable:
    /// min(x_i, y_i), in the units of the game.
    pub(super) fn violation(&self, position: usize) -> f64 {
        let [lower, upper] = [0, 1].map(|end| GameVariable::Column(number(position, end)));
        let x = self.tableau.value_of(lower) + self.tableau.value_of(upper);
        let slack = self.tableau.value_of(GameVariable::Slack(Strategy {
            row: position,
            is_negative: false,
        }));
        // The slack is 1 - shift sum q + y.
        let y = slack - 1.0 + SHIFT * self.tableau.total();
        x.min(y)
    }

    /// The game of a region that differs in its states: variables decided since.
    pub(super) fn decided(
        &self,
        before: &[VariableState],
        after: &[VariableState],
    ) -> Option<EndsGame> {
        let mut part = self.clone();
        for (position, (old, state)) in before.iter().zip(after).enumerate() {
            if old == state {
                continue;
            }

            match state {
                VariableState::AtZero => {
                    let are_removed = part.tableau.remove(number(position, 0))
                        && part.tableau.remove(number(position, 1));
                    if !are_removed {
                        return None;
                    }
                }
                VariableState::InSupport => part.tableau.add_negative(position),
                VariableState::Undecided => return None,
            }
        }

        part.tableau.repair(ENOUGH_MARGIN).then_some(part)
    }

    /// The game of the part of the interval beside a cut at `place` in (0, 1): the columns of the
    /// end `replaced` become those of the cut.
    pub(super) fn cut(
        &self,
        replaced: usize,
        place: f64,
        states: &[VariableState],
    ) -> Option<EndsGame> {
        let mut part = self.clone();
        for position in possible_support(states) {
            let lower = (1.0 - place) * self.sizes[0][position];
            let upper = place * self.sizes[1][position];
            let size = lower + upper;
            let numbers = [number(position, 0), number(position, 1)];
            let shares = [lower / size, upper / size];
            if !part.tableau.replace(numbers, shares, replaced) {
                return None;
            }

            part.sizes[replaced][position] = size;
        }

        part.tableau.repair(ENOUGH_MARGIN).then_some(part)
    }
}

/// The number of the column of a position at an end.
fn number(position: usize, end: usize) -> usize {
    2 * position + end
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::complete::pieces::expansion::Expansion;
    use crate::search::complete::pieces::matrix::SquareMatrix;
    use approx::assert_relative_eq;

    /// A = I with some coupling, B with both signs: no entry is special.
    fn expansion() -> Expansion {
        let a: SquareMatrix = vec![
            vec![1.0, 0.25, -0.5],
            vec![0.125, 1.0, 0.75],
            vec![-0.25, 0.5, 1.5],
        ];
        let b: SquareMatrix = vec![
            vec![-1.0, 0.5, 0.25],
            vec![0.75, -0.5, -1.0],
            vec![0.5, -0.25, 0.125],
        ];
        Expansion::linear(a, b)
    }

    const OPEN: [VariableState; 3] = [VariableState::Undecided; 3];

    /// Deciding a variable gives the game that one would solve from nothing.
    #[test]
    fn a_decided_variable_gives_the_game_of_the_part() {
        let ends = expansion().ends(0.5, 1.0);
        let whole = EndsGame::new(&ends, &OPEN).unwrap();

        for position in 0..3 {
            for state in [VariableState::AtZero, VariableState::InSupport] {
                let mut states = OPEN;
                states[position] = state;
                let from_nothing = EndsGame::new(&ends, &states).unwrap();
                let part = whole.decided(&OPEN, &states).unwrap();

                assert_relative_eq!(part.value(), from_nothing.value(), epsilon = 1e-12);
                assert!(part.value() >= whole.value() - 1e-12);
            }
        }
    }

    /// With x = 0 nothing is left that could be a solution: the value says so.
    #[test]
    fn a_game_without_columns_is_won_by_any_margin() {
        let ends = expansion().ends(0.5, 1.0);
        let whole = EndsGame::new(&ends, &OPEN).unwrap();

        let none = whole.decided(&OPEN, &[VariableState::AtZero; 3]).unwrap();

        assert_eq!(none.value(), f64::INFINITY);
        assert_eq!(none.weights(), [0.0; 3]);
    }

    /// Narrower ends give the game of the narrower interval, up to the scale of its columns: who
    /// wins is the same, and so is the value where both ends are one.
    #[test]
    fn a_cut_gives_the_game_of_the_part() {
        let expansion = expansion();
        for hi in [0.75, 1.0, 2.0, 4.0, 8.0] {
            let whole = EndsGame::new(&expansion.ends(0.25, hi), &OPEN).unwrap();
            let middle = 0.25 + 0.5 * (hi - 0.25);
            for (replaced, lo, hi) in [(1, 0.25, middle), (0, middle, hi)] {
                let from_nothing = EndsGame::new(&expansion.ends(lo, hi), &OPEN).unwrap();
                let part = whole.cut(replaced, 0.5, &OPEN).unwrap();

                assert!(part.value() >= whole.value() - 1e-12);
                assert_eq!(part.value() > 0.0, from_nothing.value() > 0.0, "{lo} {hi}");
            }
        }
    }
}
