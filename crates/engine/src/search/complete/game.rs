//! The Farkas test as a matrix game, solved by the simplex method without a phase 1.
//!
//! The row player mixes rows of T (rows of moving variables with either sign), the column player
//! the columns that may move, at both ends of the interval. The row player's value is the largest
//! margin with which some w makes every entry of w'T negative; the column player's mix is the x
//! closest to a solution when there is no such w. (von Neumann 1928; Dantzig 1951 for the
//! equivalence with LP.)

use crate::search::complete::pieces::skyline::dot;
use crate::tolerance::{GAME_PIVOT, GAME_SHIFT};

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
    let mut strategies: Vec<(usize, f64)> = (0..rows).map(|i| (i, 1.0)).collect();
    strategies.extend((0..rows).filter(|&i| either_sign[i]).map(|i| (i, -1.0)));
    let mut tableau = Tableau::new(&strategies, columns);
    tableau.optimise();
    let (weights, mix, total) = tableau.solution();
    let mut w = vec![0.0; rows];
    for (&(i, sign), p) in strategies.iter().zip(weights) {
        w[i] += sign * p.max(0.0) / total;
    }
    let value = columns
        .iter()
        .map(|c| -dot(c, &w))
        .fold(f64::INFINITY, f64::min);
    Game {
        value,
        w,
        mix: mix.into_iter().map(|q| q / total).collect(),
    }
}

/// max sum q, P q <= 1, q >= 0 with P > 0 by a shift: feasible at q = 0, its dual is the row
/// player's problem.
struct Tableau {
    rows: usize,
    cols: usize,
    /// (rows + 1) x (cols + 1): right-hand sides last, objective below.
    t: Vec<f64>,
    nonbasic: Vec<usize>,
    basic: Vec<usize>,
}

impl Tableau {
    fn new(strategies: &[(usize, f64)], columns: &[Vec<f64>]) -> Tableau {
        let (rows, cols) = (strategies.len(), columns.len());
        let payoff = |&(i, sign): &(usize, f64), c: &[f64]| -sign * c[i];
        let all = strategies
            .iter()
            .flat_map(|s| columns.iter().map(move |c| payoff(s, c)));
        let (lo, hi) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| {
            (lo.min(v), hi.max(v))
        });
        let shift =
            0.1 * (hi - lo) - lo + f64::MIN_POSITIVE.max(GAME_SHIFT * hi.abs().max(lo.abs()));
        let width = cols + 1;
        let mut t = vec![0.0; (rows + 1) * width];
        for (r, s) in strategies.iter().enumerate() {
            for (j, c) in columns.iter().enumerate() {
                t[r * width + j] = payoff(s, c) + shift;
            }
            t[r * width + cols] = 1.0;
        }
        t[rows * width..rows * width + cols].fill(-1.0);
        Tableau {
            rows,
            cols,
            t,
            nonbasic: (0..cols).collect(),
            basic: (cols..cols + rows).collect(),
        }
    }

    fn optimise(&mut self) {
        // Dantzig's rule; a degenerate game may stall, so the number of pivots is capped: w is then
        // worse than it could be and its value, computed from it afterwards, says so.
        for _ in 0..20 * (self.rows + self.cols) {
            let Some(entering) = self.entering() else {
                return;
            };
            let Some(leaving) = self.leaving(entering) else {
                return;
            };
            self.pivot(leaving, entering);
        }
    }

    fn entering(&self) -> Option<usize> {
        let objective = &self.t[self.rows * (self.cols + 1)..][..self.cols];
        let best = objective
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(b.1))?;
        (*best.1 < -GAME_PIVOT).then_some(best.0)
    }

    fn leaving(&self, entering: usize) -> Option<usize> {
        let width = self.cols + 1;
        let mut best: Option<(f64, f64, usize)> = None; // ratio, -pivot, row
        for r in 0..self.rows {
            let pivot = self.t[r * width + entering];
            if pivot > GAME_PIVOT {
                let candidate = (self.t[r * width + self.cols] / pivot, -pivot, r);
                if best
                    .is_none_or(|b| candidate.0 < b.0 || (candidate.0 == b.0 && candidate.1 < b.1))
                {
                    best = Some(candidate);
                }
            }
        }
        best.map(|b| b.2)
    }

    fn pivot(&mut self, leaving: usize, entering: usize) {
        let width = self.cols + 1;
        let inverse = 1.0 / self.t[leaving * width + entering];
        let (before, rest) = self.t.split_at_mut(leaving * width);
        let (pivot_row, after) = rest.split_at_mut(width);
        pivot_row.iter_mut().for_each(|v| *v *= inverse);
        pivot_row[entering] = inverse;
        for row in before
            .chunks_exact_mut(width)
            .chain(after.chunks_exact_mut(width))
        {
            let factor = row[entering];
            if factor != 0.0 {
                row[entering] = 0.0;
                row.iter_mut()
                    .zip(&*pivot_row)
                    .for_each(|(v, p)| *v -= factor * p);
            }
        }
        std::mem::swap(&mut self.nonbasic[entering], &mut self.basic[leaving]);
    }

    /// Dual weights of the rows, the mix of the columns, and their common sum.
    fn solution(&self) -> (Vec<f64>, Vec<f64>, f64) {
        let width = self.cols + 1;
        let (mut weights, mut mix) = (vec![0.0; self.rows], vec![0.0; self.cols]);
        for (j, &label) in self.nonbasic.iter().enumerate() {
            if label >= self.cols {
                weights[label - self.cols] = self.t[self.rows * width + j];
            }
        }
        for (r, &label) in self.basic.iter().enumerate() {
            if label < self.cols {
                mix[label] = self.t[r * width + self.cols];
            }
        }
        let total = self.t[self.rows * width + self.cols];
        (weights, mix, if total > 0.0 { total } else { 1.0 })
    }
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
