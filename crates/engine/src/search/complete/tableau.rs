//! The simplex tableau of a matrix game's column player: `max sum q, P q <= 1, q >= 0`.
//!
//! All payoffs P are positive: `payoff = -sign entry + shift` for the strategy "row times sign" of
//! the row player. The dual variables are the row player's weights. A smaller game, in which the
//! column player loses columns or the row player gains strategies, starts from the solved tableau
//! by the dual simplex method (Lemke 1954): the objective stays optimal, only signs of basic
//! variables are repaired, and every tableau on the way has weights that are proved by it.
//!
//! Row 0 holds the objective and entry 0 of each row the right-hand side, so that rows and columns
//! can be appended. Called by `game` (one game from nothing) and `ends_game` (games of a tree).

use crate::tolerance::GAME_PIVOT;

/// Pivots at most, for each row and column. Under Dantzig's rule a degenerate game may stall: w is
/// then worse than it could be and its value, computed from it afterwards, says so.
const PIVOTS: usize = 20;

/// A variable of the column player's problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Variable {
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
pub(super) struct Tableau {
    rows: usize,
    cols: usize,
    /// Length of a row in `entries`: one column more than there are fits in.
    stride: usize,
    /// (rows + 1) x stride.
    entries: Vec<f64>,
    nonbasic: Vec<Variable>,
    basic: Vec<Variable>,
    shift: f64,
}

impl Tableau {
    /// The tableau at q = 0. Column j has the number `numbers[j]`.
    pub(super) fn new(
        strategies: &[Strategy],
        columns: &[Vec<f64>],
        numbers: &[usize],
        shift: f64,
    ) -> Tableau {
        let rows = strategies.len();
        let cols = columns.len();
        let stride = cols + 2;

        let mut entries = vec![0.0; (rows + 1) * stride];
        entries[1..=cols].fill(-1.0);
        for (r, strategy) in strategies.iter().enumerate() {
            let row = &mut entries[(r + 1) * stride..][..stride];
            row[0] = 1.0;
            for (entry, column) in row[1..].iter_mut().zip(columns) {
                *entry = strategy.payoff(column) + shift;
            }
        }

        Tableau {
            rows,
            cols,
            stride,
            entries,
            nonbasic: numbers.iter().copied().map(Variable::Column).collect(),
            basic: strategies.iter().copied().map(Variable::Slack).collect(),
            shift,
        }
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.stride + column]
    }

    /// The sum of q, which is also the sum of the dual variables.
    pub(super) fn total(&self) -> f64 {
        self.at(0, 0)
    }

    /// What the row player's weights make of the game: once no reduced cost is negative, the margin
    /// by which they make every entry of w'T negative.
    pub(super) fn value(&self) -> f64 {
        1.0 / self.total() - self.shift
    }

    /// The total, or one where doubles have made nothing of the game.
    fn positive_total(&self) -> f64 {
        if self.total() > 0.0 {
            self.total()
        } else {
            1.0
        }
    }

    /// The column player's mix of the columns 0 to `count - 1`, summing to one.
    pub(super) fn mix(&self, count: usize) -> Vec<f64> {
        let total = self.positive_total();
        let mut mix = vec![0.0; count];
        for (r, variable) in self.basic.iter().enumerate() {
            if let Variable::Column(number) = variable {
                mix[*number] = self.at(r + 1, 0) / total;
            }
        }

        mix
    }

    /// What a variable is in the solution of the basis.
    pub(super) fn value_of(&self, variable: Variable) -> f64 {
        match position(&self.basic, variable) {
            Some(place) => self.at(place + 1, 0),
            None => 0.0,
        }
    }

    /// The weight of each of `order` rows, |w| summing to one.
    pub(super) fn weights(&self, order: usize) -> Vec<f64> {
        let total = self.positive_total();
        let mut weights = vec![0.0; order];
        for (j, variable) in self.nonbasic.iter().enumerate() {
            if let Variable::Slack(strategy) = variable {
                let weight = self.at(0, j + 1).max(0.0);
                weights[strategy.row] += strategy.sign() * weight / total;
            }
        }

        weights
    }

    /// The primal simplex method, from a basis whose right-hand sides are not negative.
    pub(super) fn optimise(&mut self) {
        for _ in 0..self.most_pivots() {
            let Some(entering) = self.entering() else {
                return;
            };

            let Some(leaving) = self.leaving(entering) else {
                return;
            };

            self.pivot(leaving, entering);
        }
    }

    /// The dual simplex method, from a basis whose reduced costs are not negative, until the basis
    /// is optimal or the value exceeds `enough`. Returns false where neither is reached.
    pub(super) fn repair(&mut self, enough: f64) -> bool {
        for _ in 0..self.most_pivots() {
            if self.value() > enough {
                return true;
            }

            let Some(leaving) = self.most_negative() else {
                return true;
            };

            let Some(entering) = self.cheapest(leaving, -1.0) else {
                return false;
            };

            self.pivot(leaving, entering);
        }

        false
    }

    fn most_pivots(&self) -> usize {
        PIVOTS * (self.rows + self.cols)
    }

    /// The column with the most negative entry of the objective (Dantzig's rule).
    fn entering(&self) -> Option<usize> {
        let mut least = -GAME_PIVOT;
        let mut entering = None;
        for column in 1..=self.cols {
            if self.at(0, column) < least {
                least = self.at(0, column);
                entering = Some(column);
            }
        }

        entering
    }

    /// The row with the least ratio of right-hand side and pivot; of equals the largest pivot.
    fn leaving(&self, entering: usize) -> Option<usize> {
        let mut best: Option<Candidate> = None;
        for row in 1..=self.rows {
            let pivot = self.at(row, entering);
            if pivot > GAME_PIVOT {
                let ratio = self.at(row, 0) / pivot;
                Candidate::offer(&mut best, row, pivot, ratio);
            }
        }

        best.map(|candidate| candidate.place)
    }

    /// The row with the most negative right-hand side.
    fn most_negative(&self) -> Option<usize> {
        let mut least = -GAME_PIVOT;
        let mut leaving = None;
        for row in 1..=self.rows {
            if self.at(row, 0) < least {
                least = self.at(row, 0);
                leaving = Some(row);
            }
        }

        leaving
    }

    /// The column that costs the objective least where the basic variable of a row grows (sign -1)
    /// or falls (sign 1).
    fn cheapest(&self, row: usize, sign: f64) -> Option<usize> {
        let mut best: Option<Candidate> = None;
        for column in 1..=self.cols {
            let pivot = sign * self.at(row, column);
            if pivot > GAME_PIVOT {
                let ratio = self.at(0, column).max(0.0) / pivot;
                Candidate::offer(&mut best, column, pivot, ratio);
            }
        }

        best.map(|candidate| candidate.place)
    }

    fn pivot(&mut self, leaving: usize, entering: usize) {
        let width = self.cols + 1;
        let stride = self.stride;
        let inverse = 1.0 / self.at(leaving, entering);
        let (before, rest) = self.entries.split_at_mut(leaving * stride);
        let (pivot_row, after) = rest.split_at_mut(stride);
        let pivot_row = &mut pivot_row[..width];
        pivot_row.iter_mut().for_each(|v| *v *= inverse);
        pivot_row[entering] = inverse;

        let other_rows = before
            .chunks_exact_mut(stride)
            .chain(after.chunks_exact_mut(stride));
        for row in other_rows {
            let row = &mut row[..width];
            let factor = row[entering];
            if factor != 0.0 {
                row[entering] = 0.0;
                for (v, p) in row.iter_mut().zip(&*pivot_row) {
                    *v -= factor * p;
                }
            }
        }

        let nonbasic = &mut self.nonbasic[entering - 1];
        std::mem::swap(nonbasic, &mut self.basic[leaving - 1]);
    }

    /// Takes a column from the column player; the reduced costs stay as they should be. Returns
    /// false where doubles find no pivot.
    pub(super) fn remove(&mut self, number: usize) -> bool {
        let variable = Variable::Column(number);
        if let Some(place) = position(&self.nonbasic, variable) {
            self.delete_column(place + 1);
            return true;
        }

        let Some(place) = position(&self.basic, variable) else {
            return true;
        };

        let row = place + 1;
        let sign = if self.at(row, 0) < 0.0 { -1.0 } else { 1.0 };
        let Some(entering) = self.cheapest(row, sign) else {
            return false;
        };

        self.pivot(row, entering);
        self.delete_column(entering);
        true
    }

    /// Deletes a column that is not in the basis; the last one takes its place.
    fn delete_column(&mut self, column: usize) {
        let last = self.cols;
        for row in self.entries.chunks_exact_mut(self.stride) {
            row[column] = row[last];
        }

        self.nonbasic.swap_remove(column - 1);
        self.cols -= 1;
    }

    /// Gives the row player the negative of a row whose positive he has.
    ///
    /// The payoffs of both add up to `2 shift`, so that the slack is
    /// `s_ = 2 - 2 shift sum q - s` with the slack s of the positive.
    pub(super) fn add_negative(&mut self, row: usize) {
        let twice = 2.0 * self.shift;
        let mut slack = vec![0.0; self.stride];
        for column in 1..=self.cols {
            slack[column] = -twice * self.at(0, column);
        }

        slack[0] = 2.0 - twice * self.total();
        let positive = Variable::Slack(Strategy {
            row,
            is_negative: false,
        });
        if let Some(place) = position(&self.nonbasic, positive) {
            slack[place + 1] += 1.0;
        } else if let Some(place) = position(&self.basic, positive) {
            for column in 0..=self.cols {
                slack[column] -= self.at(place + 1, column);
            }
        }

        self.entries.extend(slack);
        self.rows += 1;
        self.basic.push(Variable::Slack(Strategy {
            row,
            is_negative: true,
        }));
    }

    /// Puts a mix of two columns in the place of `numbers[replaced]`; the reduced costs stay as
    /// they should be for shares that are not negative and sum to one.
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
            *variable = Variable::Column(numbers[replaced]);
        }

        true
    }

    /// Appends the sum of two columns times their shares.
    fn append_mix(&mut self, numbers: [usize; 2], shares: [f64; 2]) {
        self.cols += 1;
        let appended = self.cols;
        self.nonbasic.push(INTERIM);
        for row in self.entries.chunks_exact_mut(self.stride) {
            row[appended] = 0.0;
        }

        for (number, share) in numbers.into_iter().zip(shares) {
            let variable = Variable::Column(number);
            if let Some(place) = position(&self.nonbasic, variable) {
                for row in self.entries.chunks_exact_mut(self.stride) {
                    row[appended] += share * row[place + 1];
                }
            } else if let Some(place) = position(&self.basic, variable) {
                self.entries[(place + 1) * self.stride + appended] += share;
            }
        }
    }
}

/// Until the column that it replaces has left, a mix has a number that no other column has.
const INTERIM: Variable = Variable::Column(usize::MAX);

fn position(variables: &[Variable], variable: Variable) -> Option<usize> {
    variables.iter().position(|v| *v == variable)
}

/// A row that may leave the basis, or a column that may enter it.
struct Candidate {
    place: usize,
    pivot: f64,
    ratio: f64,
}

impl Candidate {
    /// Keeps the candidate with the least ratio; of equals the one with the largest pivot.
    fn offer(best: &mut Option<Candidate>, place: usize, pivot: f64, ratio: f64) {
        let is_better = best.as_ref().is_none_or(|b| {
            if ratio == b.ratio {
                pivot > b.pivot
            } else {
                ratio < b.ratio
            }
        });
        if is_better {
            *best = Some(Candidate {
                place,
                pivot,
                ratio,
            });
        }
    }
}
