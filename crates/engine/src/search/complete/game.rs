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
use crate::tolerance::{GAME_PIVOT, GAME_SHIFT};

/// Pivots at most, for each row and column. Under Dantzig's rule a degenerate game may stall: w is
/// then worse than it could be and its value, computed from it afterwards, says so.
const PIVOTS: usize = 20;

/// A solved game.
pub(crate) struct Game {
    /// min over columns of -(w'T): positive if w proves the region empty.
    pub(crate) value: f64,
    /// The row player's weights, |w| summing to one.
    pub(crate) w: Vec<f64>,
    /// The column player's mix.
    pub(crate) mix: Vec<f64>,
}

/// A pure strategy of the row player: a row of T, times 1 or -1.
struct Strategy {
    row: usize,
    sign: f64,
}

impl Strategy {
    fn payoff(&self, column: &[f64]) -> f64 {
        -self.sign * column[self.row]
    }
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
    for row in 0..rows {
        strategies.push(Strategy { row, sign: 1.0 });
    }

    for row in (0..rows).filter(|&row| either_sign[row]) {
        strategies.push(Strategy { row, sign: -1.0 });
    }

    let mut tableau = Tableau::new(&strategies, columns);
    tableau.optimise();
    let solution = tableau.solution();

    let mut w = vec![0.0; rows];
    for (strategy, weight) in strategies.iter().zip(&solution.weights) {
        w[strategy.row] += strategy.sign * weight.max(0.0) / solution.total;
    }

    let value = columns
        .iter()
        .map(|column| -dot(column, &w))
        .fold(f64::INFINITY, f64::min);
    let mix = solution.mix.iter().map(|q| q / solution.total).collect();
    Game { value, w, mix }
}

/// The simplex tableau of the column player's problem.
struct Tableau {
    rows: usize,
    cols: usize,
    /// (rows + 1) x (cols + 1): right-hand sides last, objective below.
    entries: Vec<f64>,
    /// Labels of the variables: those of the columns first, then the slacks of the rows.
    nonbasic: Vec<usize>,
    basic: Vec<usize>,
}

/// Both players' weights before they are divided by their common sum.
struct Solution {
    weights: Vec<f64>,
    mix: Vec<f64>,
    total: f64,
}

impl Tableau {
    fn new(strategies: &[Strategy], columns: &[Vec<f64>]) -> Tableau {
        let rows = strategies.len();
        let cols = columns.len();
        let width = cols + 1;
        let shift = positive_shift(strategies, columns);

        let mut entries = vec![0.0; (rows + 1) * width];
        for (r, strategy) in strategies.iter().enumerate() {
            for (j, column) in columns.iter().enumerate() {
                entries[r * width + j] = strategy.payoff(column) + shift;
            }

            entries[r * width + cols] = 1.0;
        }

        entries[rows * width..rows * width + cols].fill(-1.0);
        Tableau {
            rows,
            cols,
            entries,
            nonbasic: (0..cols).collect(),
            basic: (cols..cols + rows).collect(),
        }
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        let width = self.cols + 1;
        self.entries[row * width + column]
    }

    fn optimise(&mut self) {
        for _ in 0..PIVOTS * (self.rows + self.cols) {
            let Some(entering) = self.entering() else {
                return;
            };

            let Some(leaving) = self.leaving(entering) else {
                return;
            };

            self.pivot(leaving, entering);
        }
    }

    /// The column with the most negative entry of the objective (Dantzig's rule).
    fn entering(&self) -> Option<usize> {
        let objective = &self.entries[self.rows * (self.cols + 1)..][..self.cols];
        let (column, least) = objective
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(b.1))?;
        (*least < -GAME_PIVOT).then_some(column)
    }

    /// The row with the least ratio of right-hand side and pivot; of equals the largest pivot.
    fn leaving(&self, entering: usize) -> Option<usize> {
        let mut best: Option<Candidate> = None;
        for row in 0..self.rows {
            let pivot = self.at(row, entering);
            if pivot > GAME_PIVOT {
                let candidate = Candidate {
                    row,
                    pivot,
                    ratio: self.at(row, self.cols) / pivot,
                };

                if best.as_ref().is_none_or(|b| candidate.is_better_than(b)) {
                    best = Some(candidate);
                }
            }
        }

        best.map(|candidate| candidate.row)
    }

    fn pivot(&mut self, leaving: usize, entering: usize) {
        let width = self.cols + 1;
        let inverse = 1.0 / self.at(leaving, entering);
        let (before, rest) = self.entries.split_at_mut(leaving * width);
        let (pivot_row, after) = rest.split_at_mut(width);
        pivot_row.iter_mut().for_each(|v| *v *= inverse);
        pivot_row[entering] = inverse;

        let other_rows = before
            .chunks_exact_mut(width)
            .chain(after.chunks_exact_mut(width));
        for row in other_rows {
            let factor = row[entering];
            if factor != 0.0 {
                row[entering] = 0.0;
                for (v, p) in row.iter_mut().zip(&*pivot_row) {
                    *v -= factor * p;
                }
            }
        }

        std::mem::swap(&mut self.nonbasic[entering], &mut self.basic[leaving]);
    }

    fn solution(&self) -> Solution {
        let mut weights = vec![0.0; self.rows];
        for (j, &label) in self.nonbasic.iter().enumerate() {
            if label >= self.cols {
                weights[label - self.cols] = self.at(self.rows, j);
            }
        }

        let mut mix = vec![0.0; self.cols];
        for (row, &label) in self.basic.iter().enumerate() {
            if label < self.cols {
                mix[label] = self.at(row, self.cols);
            }
        }

        let total = self.at(self.rows, self.cols);
        Solution {
            weights,
            mix,
            total: if total > 0.0 { total } else { 1.0 },
        }
    }
}

/// A row that may leave the basis.
struct Candidate {
    row: usize,
    pivot: f64,
    ratio: f64,
}

impl Candidate {
    fn is_better_than(&self, other: &Candidate) -> bool {
        if self.ratio == other.ratio {
            self.pivot > other.pivot
        } else {
            self.ratio < other.ratio
        }
    }
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
