//! The simplex tableau of a matrix game's column player: `max sum q, P q <= 1, q >= 0`.
//!
//! All payoffs P are positive: `payoff = -sign entry + shift` for the strategy "row times sign" of
//! the row player. The dual variables are the row player's weights. A smaller game, in which the
//! column player loses columns or the row player gains strategies, starts from the solved tableau
//! by the dual simplex method (Lemke 1954): the objective stays optimal, only signs of basic
//! variables are repaired, and every tableau on the way has weights that are proved by it.
//!
//! Right-hand sides and reduced costs are stored apart from the entries: every step searches all of
//! them. Called by `game` (one game from nothing) and `ends_game` (games of a tree).

use crate::tolerance::GAME_PIVOT;

/// Pivots at most, for each row and column. Under Dantzig's rule a degenerate game may stall:
/// `optimise` and `repair` then return false. `game` goes on with the weights that were reached and
/// computes their value anew.
const PIVOTS: usize = 20;

/// A variable of the column player's problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GameVariable {
    /// The weight of a column, by its number.
    Column(usize),
    /// The slack of a strategy.
    Slack(Strategy),
}

/// A pure strategy of the row player: a row of T, times 1 or -1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Strategy {
    pub(super) row: usize,
    pub(super) is_negative: bool,
}

impl Strategy {
    pub(super) fn sign(self) -> f64 {
        if self.is_negative { -1.0 } else { 1.0 }
    }

    pub(super) fn payoff(self, column: &[f64]) -> f64 {
        -self.sign() * column[self.row]
    }
}

/// A tableau; its basis need not be optimal.
#[derive(Clone)]
pub(super) struct GameTableau {
    /// Length of a row in `entries`: its columns and room for one more, which `replace` needs.
    stride: usize,
    /// A row for each basic variable, a column for each nonbasic one.
    entries: Vec<f64>,
    /// The right-hand sides: what the basic variables are.
    values: Vec<f64>,
    /// The reduced costs of the nonbasic variables; those of slacks are the dual variables.
    costs: Vec<f64>,
    /// The sum of q, which is also the sum of the dual variables.
    total: f64,
    nonbasic: Vec<GameVariable>,
    basic: Vec<GameVariable>,
    shift: f64,
}

impl GameTableau {
    /// The tableau at q = 0. Column j has the number `numbers[j]`.
    pub(super) fn new(
        strategies: &[Strategy],
        columns: &[Vec<f64>],
        numbers: &[usize],
        shift: f64,
    ) -> GameTableau {
        let rows = strategies.len();
        let cols = columns.len();
        let stride = cols + 1;

        let mut entries = vec![0.0; rows * stride];
        for (row, strategy) in entries.chunks_exact_mut(stride).zip(strategies) {
            for (entry, column) in row.iter_mut().zip(columns) {
                *entry = strategy.payoff(column) + shift;
            }
        }

        GameTableau {
            stride,
            entries,
            values: vec![1.0; rows],
            costs: vec![-1.0; cols],
            total: 0.0,
            nonbasic: numbers.iter().copied().map(GameVariable::Column).collect(),
            basic: strategies
                .iter()
                .copied()
                .map(GameVariable::Slack)
                .collect(),
            shift,
        }
    }

    /// The entries of a row.
    fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.stride..][..self.costs.len()]
    }

    /// The sum of q, which is also the sum of the dual variables.
    pub(super) fn total(&self) -> f64 {
        self.total
    }

    /// 1/total - shift: the margin by which the row player's weights w make every entry of w'T
    /// negative, once no reduced cost is negative. Infinite where no column is left.
    pub(super) fn value(&self) -> f64 {
        if self.costs.is_empty() {
            return f64::INFINITY;
        }

        1.0 / self.total - self.shift
    }

    /// The total, or one where doubles have made nothing of the game.
    fn positive_total(&self) -> f64 {
        if self.total > 0.0 { self.total } else { 1.0 }
    }

    /// The column player's mix of the columns 0 to `count - 1`, summing to one.
    pub(super) fn mix(&self, count: usize) -> Vec<f64> {
        let total = self.positive_total();
        let mut mix = vec![0.0; count];
        for (variable, value) in self.basic.iter().zip(&self.values) {
            if let GameVariable::Column(number) = variable {
                mix[*number] = value / total;
            }
        }

        mix
    }

    /// What a variable is in the solution of the basis.
    pub(super) fn value_of(&self, variable: GameVariable) -> f64 {
        match position(&self.basic, variable) {
            Some(row) => self.values[row],
            None => 0.0,
        }
    }

    /// The weight of each of `order` rows, |w| summing to one; all zero where no column is left.
    pub(super) fn weights(&self, order: usize) -> Vec<f64> {
        let total = self.positive_total();
        let mut weights = vec![0.0; order];
        for (variable, cost) in self.nonbasic.iter().zip(&self.costs) {
            if let GameVariable::Slack(strategy) = variable {
                let weight = cost.max(0.0);
                weights[strategy.row] += strategy.sign() * weight / total;
            }
        }

        weights
    }

    /// The primal simplex method, from a basis whose right-hand sides are not negative. Returns
    /// false where reduced costs stay negative.
    pub(super) fn optimise(&mut self) -> bool {
        for _ in 0..self.most_pivots() {
            let Some(entering) = self.entering() else {
                return true;
            };

            let Some(leaving) = self.leaving(entering) else {
                return false;
            };

            self.pivot(leaving, entering);
        }

        false
    }

    /// The dual simplex method, from a basis whose reduced costs are not negative, until the basis
    /// is optimal or the value exceeds `enough`. Returns false where neither is reached.
    pub(super) fn repair(&mut self, enough: f64) -> bool {
        for _ in 0..self.most_pivots() {
            if self.value() > enough {
                return true;
            }

            let Some(leaving) = self.infeasible() else {
                // No comparison holds for NaN, so that it looks feasible.
                return !self.total.is_nan();
            };

            let Some(entering) = self.cheapest(leaving, -1.0) else {
                return false;
            };

            self.pivot(leaving, entering);
        }

        false
    }

    fn most_pivots(&self) -> usize {
        PIVOTS * (self.basic.len() + self.nonbasic.len())
    }

    /// The column with the most negative reduced cost (Dantzig's rule).
    fn entering(&self) -> Option<usize> {
        most_negative(&self.costs)
    }

    /// The row with the most negative right-hand side.
    fn infeasible(&self) -> Option<usize> {
        most_negative(&self.values)
    }

    /// The row with the least ratio of right-hand side and pivot; of equals the largest pivot.
    fn leaving(&self, entering: usize) -> Option<usize> {
        let rows = self.entries.chunks_exact(self.stride);
        let pivots: Vec<f64> = rows.map(|row| row[entering]).collect();
        least_ratio(&self.values, &pivots)
    }

    /// The column that costs the objective least where the basic variable of a row grows (sign -1)
    /// or falls (sign 1).
    fn cheapest(&self, row: usize, sign: f64) -> Option<usize> {
        let costs: Vec<f64> = self.costs.iter().map(|cost| cost.max(0.0)).collect();
        let pivots: Vec<f64> = self.row(row).iter().map(|entry| sign * entry).collect();
        least_ratio(&costs, &pivots)
    }

    /// Exchanges the basic variable of a row and the nonbasic variable of a column.
    fn pivot(&mut self, leaving: usize, entering: usize) {
        let inverse = 1.0 / self.row(leaving)[entering];
        let scaled = self.row(leaving).iter().map(|entry| entry * inverse);
        let mut pivot_row: Vec<f64> = scaled.collect();
        pivot_row[entering] = inverse;

        let width = pivot_row.len();
        let step = PivotStep {
            entering,
            row: pivot_row,
            value: self.values[leaving] * inverse,
        };

        let rows = self.entries.chunks_exact_mut(self.stride);
        for (place, (row, value)) in rows.zip(&mut self.values).enumerate() {
            let row = &mut row[..width];
            if place == leaving {
                row.copy_from_slice(&step.row);
                *value = step.value;
            } else {
                step.eliminate(row, value);
            }
        }
        step.eliminate(&mut self.costs, &mut self.total);

        let nonbasic = &mut self.nonbasic[entering];
        std::mem::swap(nonbasic, &mut self.basic[leaving]);
    }

    /// Takes a column from the column player; the reduced costs stay as they should be. Returns
    /// false where doubles find no pivot.
    pub(super) fn remove(&mut self, number: usize) -> bool {
        let variable = GameVariable::Column(number);
        if let Some(place) = position(&self.nonbasic, variable) {
            self.delete_column(place);
            return true;
        }

        let Some(row) = position(&self.basic, variable) else {
            return true;
        };

        let sign = if self.values[row] < 0.0 { -1.0 } else { 1.0 };
        let Some(entering) = self.cheapest(row, sign) else {
            return false;
        };

        self.pivot(row, entering);
        self.delete_column(entering);
        true
    }

    /// Deletes a column that is not in the basis; the last one takes its place.
    fn delete_column(&mut self, column: usize) {
        let last = self.costs.len() - 1;
        for row in self.entries.chunks_exact_mut(self.stride) {
            row[column] = row[last];
        }

        self.costs.swap_remove(column);
        self.nonbasic.swap_remove(column);
    }

    /// Gives the row player the negative of a row whose positive he has.
    ///
    /// The payoffs of both add up to `2 shift`, so that the slack is
    /// `s_ = 2 - 2 shift sum q - s` with the slack s of the positive.
    pub(super) fn add_negative(&mut self, row: usize) {
        let twice = 2.0 * self.shift;
        let mut slack = vec![0.0; self.stride];
        for (entry, cost) in slack.iter_mut().zip(&self.costs) {
            *entry = -twice * cost;
        }

        let mut value = 2.0 - twice * self.total;
        let positive = GameVariable::Slack(Strategy {
            row,
            is_negative: false,
        });
        if let Some(place) = position(&self.nonbasic, positive) {
            slack[place] += 1.0;
        } else if let Some(place) = position(&self.basic, positive) {
            value -= self.values[place];
            for (entry, of_positive) in slack.iter_mut().zip(self.row(place)) {
                *entry -= of_positive;
            }
        }

        self.entries.extend(slack);
        self.values.push(value);
        self.basic.push(GameVariable::Slack(Strategy {
            row,
            is_negative: true,
        }));
    }

    /// Puts a mix of two columns in the place of `numbers[replaced]`; the reduced costs stay as
    /// they should be for shares that are not negative and sum to one. Returns false where doubles
    /// find no pivot; the tableau is then of no use.
    pub(super) fn replace(
        &mut self,
        numbers: [usize; 2],
        shares: [f64; 2],
        replaced: usize,
    ) -> bool {
        self.append_mix(numbers, shares);
        if !self.remove(numbers[replaced]) {
            return false;
        }

        let mut variables = self.nonbasic.iter_mut().chain(&mut self.basic);
        if let Some(variable) = variables.find(|variable| **variable == INTERIM) {
            *variable = GameVariable::Column(numbers[replaced]);
        }

        true
    }

    /// Appends the sum of two columns times their shares.
    fn append_mix(&mut self, numbers: [usize; 2], shares: [f64; 2]) {
        let appended = self.costs.len();
        self.nonbasic.push(INTERIM);
        self.costs.push(0.0);
        for row in self.entries.chunks_exact_mut(self.stride) {
            row[appended] = 0.0;
        }

        for (number, share) in numbers.into_iter().zip(shares) {
            let variable = GameVariable::Column(number);
            if let Some(place) = position(&self.nonbasic, variable) {
                self.costs[appended] += share * self.costs[place];
                for row in self.entries.chunks_exact_mut(self.stride) {
                    row[appended] += share * row[place];
                }
            } else if let Some(place) = position(&self.basic, variable) {
                self.entries[place * self.stride + appended] += share;
            }
        }
    }
}

/// Until the column that it replaces has left, a mix has a number that no other column has.
const INTERIM: GameVariable = GameVariable::Column(usize::MAX);

/// A pivot step: the pivot row divided by the pivot, with 1/pivot in the entering column, which
/// belongs to the leaving variable from then on, and its right-hand side.
struct PivotStep {
    entering: usize,
    row: Vec<f64>,
    value: f64,
}

impl PivotStep {
    /// Eliminates the entering variable from another row and its right-hand side.
    fn eliminate(&self, row: &mut [f64], value: &mut f64) {
        let factor = row[self.entering];
        if factor == 0.0 {
            return;
        }

        row[self.entering] = 0.0; // the column is that of the leaving variable
        for (entry, of_pivot_row) in row.iter_mut().zip(&self.row) {
            *entry -= factor * of_pivot_row;
        }
        *value -= factor * self.value;
    }
}

/// The place of the most negative of some numbers; `None` if none is clearly negative.
fn most_negative(numbers: &[f64]) -> Option<usize> {
    let mut least = -GAME_PIVOT;
    let mut place = None;
    for (k, number) in numbers.iter().enumerate() {
        if *number < least {
            least = *number;
            place = Some(k);
        }
    }

    place
}

fn position(variables: &[GameVariable], variable: GameVariable) -> Option<usize> {
    variables.iter().position(|v| *v == variable)
}

/// The place of the least ratio of a numerator and its pivot; of equals the largest pivot. Only
/// pivots above [`GAME_PIVOT`] count.
fn least_ratio(numerators: &[f64], pivots: &[f64]) -> Option<usize> {
    // All ratios first: the compiler divides several at a time, and no branch depends on the signs
    // of pivots, which are as good as random.
    let ratios: Vec<f64> = numerators
        .iter()
        .zip(pivots)
        .map(|(numerator, pivot)| positive_ratio(*numerator, *pivot))
        .collect();

    let mut least = f64::INFINITY;
    let mut place = None;
    for (k, ratio) in ratios.iter().enumerate() {
        let is_better = match place {
            Some(best) if *ratio == least => pivots[k] > pivots[best],
            _ => *ratio < least,
        };
        if is_better {
            least = *ratio;
            place = Some(k);
        }
    }

    place
}

/// The ratio, infinite where the pivot is too small or negative.
fn positive_ratio(numerator: f64, pivot: f64) -> f64 {
    let quotient = numerator / pivot;
    if pivot > GAME_PIVOT {
        quotient
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_ratio_with_the_largest_pivot_is_taken() {
        assert_eq!(least_ratio(&[1.0, 1.0, 4.0], &[1.0, 2.0, 8.0]), Some(2));
        assert_eq!(least_ratio(&[4.0, 1.0, 1.0], &[8.0, 2.0, 1.0]), Some(0));
        assert_eq!(least_ratio(&[3.0, 1.0], &[1.0, 2.0]), Some(1));
    }

    #[test]
    fn places_without_a_positive_pivot_are_not_taken() {
        assert_eq!(least_ratio(&[1.0, 0.0, 0.0], &[1.0, 0.0, -1.0]), Some(0));
        assert_eq!(least_ratio(&[0.0, 1.0], &[0.5 * GAME_PIVOT, -1.0]), None);
        assert_eq!(least_ratio(&[], &[]), None);
    }
}
