//! Sparse linear problems: the unknowns without bounds are eliminated by one sparse factorisation,
//! and only the bounded ones are pivoted.
//!
//! With f the free unknowns and s the others, S = M_ss - M_sf M_ff^-1 M_fs is dense of the order of
//! s. Memory: the nonzeros of M and of the factors of M_ff, and |s|^2; never n^2. On f the path of
//! the whole problem is a function of that on s: from Lemke's ray, where the rows of f vanish at
//! the start, both are the same pivot for pivot.

use super::problem::SparseLinearMcp;
use crate::linear::SparseLu;
use crate::mcp::{LinearMcp, McpError};
use crate::solver::{
    Options, Outcome, Residuals, SolverError, Termination, solve, solve_linear, unmatched,
};
use crate::tolerance::REFINED;

/// Why a sparse problem is not condensed or not run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SparseError {
    /// Options or starts that make no sense.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The condensed problem is none: its numbers overflow.
    #[error("condensed: {0}")]
    Condensed(#[from] McpError),
    /// The block of the unknowns without bounds is singular whatever its values.
    #[error(
        "expected an unknown without bounds to solve row {row} for, got none: those of its entries \
         serve other rows"
    )]
    StructurallySingular {
        /// A row left over by a largest pairing of rows and unknowns.
        row: usize,
    },
    /// The block of the unknowns without bounds is singular to rounding.
    #[error(
        "expected a regular block of the unknowns without bounds, got solutions that refinement \
         changes by {change:e} of their size"
    )]
    SingularFreeBlock {
        /// Change by one step of iterative refinement, relative to the solution; infinite if there
        /// was none.
        change: f64,
    },
}

/// Right-hand sides solved for together. Unit: columns. Basis: dense kernels of the factors have
/// something to do, and the block stays small beside the factors.
const BLOCK: usize = 32;

/// A sparse linear MCP with its free unknowns eliminated. Serves any number of runs.
#[derive(Debug, Clone)]
pub struct CondensedMcp<'a> {
    whole: &'a SparseLinearMcp,
    /// Unknowns without any bound, ascending.
    free: Vec<usize>,
    /// All others, ascending.
    bounded: Vec<usize>,
    /// Index of each unknown in its list.
    place: Vec<usize>,
    is_free: Vec<bool>,
    factors: SparseLu,
    problem: LinearMcp,
}

impl<'a> CondensedMcp<'a> {
    /// Eliminates the unknowns that have no bound.
    ///
    /// # Errors
    /// [`SparseError::StructurallySingular`] if a row of theirs has no unknown to be solved for,
    /// [`SparseError::SingularFreeBlock`] if their block is singular to rounding.
    ///
    /// ```
    /// use mceip_mcp::{
    ///     solver::Options,
    ///     sparse::{CondensedMcp, SparseLinearMcp},
    /// };
    /// let inf = f64::INFINITY;
    /// // 2 x - y = 1 with x free, 0 <= y, 0 <= 3 - x + y.
    /// let m = [(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)];
    /// let problem =
    ///     SparseLinearMcp::new(m, vec![-1.0, 3.0], vec![-inf, 0.0], vec![inf; 2]).unwrap();
    /// let condensed = CondensedMcp::new(&problem).unwrap();
    /// assert_eq!(condensed.problem().matrix()[(0, 0)], 0.5);
    /// let outcome = condensed.solve_linear(&Options::default()).unwrap();
    /// assert!(outcome.termination.reached_tolerance());
    /// assert_eq!(outcome.point, [0.5, 0.0]);
    /// ```
    pub fn new(whole: &'a SparseLinearMcp) -> Result<Self, SparseError> {
        let n = whole.dimension();
        let is_free: Vec<bool> = (0..n)
            .map(|i| whole.lower()[i] == f64::NEG_INFINITY && whole.upper()[i] == f64::INFINITY)
            .collect();
        let (free, bounded): (Vec<usize>, Vec<usize>) = (0..n).partition(|&i| is_free[i]);
        let mut place = vec![0; n];
        for list in [&free, &bounded] {
            list.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        }
        let among = |&j: &usize| {
            let nonzero = |e: &(usize, f64)| is_free[e.0] && e.1 != 0.0;
            whole
                .column(j)
                .filter(nonzero)
                .map(|(i, v)| (place[i], v))
                .collect::<Vec<_>>()
        };
        let block: Vec<Vec<(usize, f64)>> = free.iter().map(among).collect();
        let pattern: Vec<Vec<usize>> = block
            .iter()
            .map(|column| column.iter().map(|e| e.0).collect())
            .collect();
        if let Some((row, _)) = unmatched(&pattern) {
            return Err(SparseError::StructurallySingular { row: free[row] });
        }
        drop(pattern);
        let entries = block
            .iter()
            .enumerate()
            .flat_map(|(j, column)| column.iter().map(move |&(i, v)| (i, j, v)));
        let factors = SparseLu::new(free.len(), entries).ok_or(SparseError::SingularFreeBlock {
            change: f64::INFINITY,
        })?;
        let problem = LinearMcp::new(nalgebra::DMatrix::zeros(0, 0), vec![], vec![], vec![])?;
        let mut condensed = CondensedMcp {
            whole,
            free,
            bounded,
            place,
            is_free,
            factors,
            problem,
        };
        condensed.problem = condensed.condense()?;
        Ok(condensed)
    }

    /// The dense problem in the bounded unknowns, in ascending order.
    pub fn problem(&self) -> &LinearMcp {
        &self.problem
    }

    /// The bounded unknowns, ascending.
    pub fn bounded(&self) -> &[usize] {
        &self.bounded
    }

    /// Lemke's method, as [`solve_linear`]; pivots are named by the indices of the whole problem.
    ///
    /// # Errors
    /// [`SolverError::Option`] inside [`SparseError::Solver`] for an option out of range.
    pub fn solve_linear(&self, options: &Options) -> Result<Outcome, SparseError> {
        Ok(self.whole_outcome(solve_linear(&self.problem, options)?, options))
    }

    /// A run as [`solve`] from `start` (length n), of which only the bounded components matter.
    ///
    /// # Errors
    /// [`SparseError::Solver`] for options and starts that make no sense.
    pub fn solve(&self, start: &[f64], options: &Options) -> Result<Outcome, SparseError> {
        if start.len() != self.whole.dimension() {
            return Err(SolverError::StartLength {
                expected: self.whole.dimension(),
                got: start.len(),
            }
            .into());
        }
        if let Some(index) = start.iter().position(|v| !v.is_finite()) {
            return Err(SolverError::StartNotFinite {
                index,
                got: start[index],
            }
            .into());
        }
        let start: Vec<f64> = self.bounded.iter().map(|&i| start[i]).collect();
        Ok(self.whole_outcome(solve(&self.problem, &start, options)?, options))
    }

    /// All unknowns, length n, for values of the bounded ones: the free rows vanish.
    pub fn lift(&self, bounded: &[f64]) -> Vec<f64> {
        let mut z = vec![0.0; self.whole.dimension()];
        self.bounded
            .iter()
            .zip(bounded)
            .for_each(|(&i, v)| z[i] = *v);
        // The second round is iterative refinement.
        for _ in 0..2 {
            let f = self.whole.value(&z);
            let mut step = [self.free.iter().map(|&i| -f[i]).collect::<Vec<f64>>()];
            self.factors.solve(&mut step);
            self.free.iter().zip(&step[0]).for_each(|(&i, v)| z[i] += v);
        }
        z
    }

    /// S and q_s - M_sf M_ff^-1 q_f.
    fn condense(&self) -> Result<LinearMcp, SparseError> {
        let count = self.bounded.len();
        // Also where no column is solved for: a generic right-hand side, which no singular block
        // reaches.
        let golden = |i: usize| 0.5 + (i as f64 * 0.618_033_988_749_895).fract();
        self.solve_refined(&[(0..self.free.len()).map(golden).collect()])?;
        let mut m = nalgebra::DMatrix::zeros(count, count);
        for first in (0..count).step_by(BLOCK) {
            let columns: Vec<usize> = (first..count.min(first + BLOCK)).collect();
            let right: Vec<Vec<f64>> = columns
                .iter()
                .map(|&k| self.free_rows(self.bounded[k]))
                .collect();
            let solved = self.solve_refined(&right)?;
            for (&k, x) in columns.iter().zip(&solved) {
                for (row, value) in self
                    .whole
                    .column(self.bounded[k])
                    .filter(|e| !self.is_free[e.0])
                {
                    m[(self.place[row], k)] += value;
                }
                for (&j, x) in self.free.iter().zip(x).filter(|(_, x)| **x != 0.0) {
                    let rows = self.whole.column(j).filter(|e| !self.is_free[e.0]);
                    rows.for_each(|(row, value)| m[(self.place[row], k)] -= value * x);
                }
            }
        }
        let f = self.whole.value(&self.lift(&vec![0.0; count]));
        let of = |values: &[f64]| {
            self.bounded
                .iter()
                .map(|&i| values[i])
                .collect::<Vec<f64>>()
        };
        Ok(LinearMcp::new(
            m,
            of(&f),
            of(self.whole.lower()),
            of(self.whole.upper()),
        )?)
    }

    /// The free rows of a column of M, as a dense vector over f.
    fn free_rows(&self, column: usize) -> Vec<f64> {
        let mut out = vec![0.0; self.free.len()];
        self.whole
            .column(column)
            .filter(|e| self.is_free[e.0])
            .for_each(|(row, value)| out[self.place[row]] = value);
        out
    }

    /// M_ff^-1 of columns, with one step of iterative refinement and a check that it contracts.
    fn solve_refined(&self, right: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, SparseError> {
        let mut x = right.to_vec();
        self.factors.solve(&mut x);
        let mut rest: Vec<Vec<f64>> = right.iter().zip(&x).map(|(b, x)| self.rest(b, x)).collect();
        self.factors.solve(&mut rest);
        let largest = |v: &[f64]| {
            v.iter().fold(0.0, |a: f64, v| {
                if v.is_nan() {
                    f64::INFINITY
                } else {
                    a.max(v.abs())
                }
            })
        };
        for (x, step) in x.iter_mut().zip(&rest) {
            let (change, size) = (largest(step), largest(x));
            if !size.is_finite() || change > REFINED * size {
                return Err(SparseError::SingularFreeBlock {
                    change: if size > 0.0 { change / size } else { change },
                });
            }
            x.iter_mut().zip(step).for_each(|(x, step)| *x += step);
        }
        Ok(x)
    }

    /// b - M_ff x.
    fn rest(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut rest = b.to_vec();
        for (&j, x) in self.free.iter().zip(x) {
            let rows = self.whole.column(j).filter(|e| self.is_free[e.0]);
            rows.for_each(|(row, value)| rest[self.place[row]] -= value * x);
        }
        rest
    }

    /// The outcome for the whole problem: its point, its residuals, its names.
    fn whole_outcome(&self, mut outcome: Outcome, options: &Options) -> Outcome {
        outcome.point = self.lift(&outcome.point);
        outcome.residuals = self.residuals(&outcome.point);
        if outcome.termination.reached_tolerance()
            && !outcome.residuals.within(options.convergence_tolerance)
        {
            outcome.termination = Termination::NoProgress;
        }
        let pivots = outcome
            .log
            .iter_mut()
            .flat_map(|major| &mut major.paths)
            .flat_map(|path| &mut path.pivots);
        pivots.for_each(|pivot| *pivot = pivot.renamed(&self.bounded));
        outcome
    }

    /// The five residuals of the whole problem at a point of length n.
    pub fn residuals(&self, z: &[f64]) -> Residuals {
        let product = |y: &[f64], out: &mut [f64]| {
            let along = |j: usize| {
                self.whole
                    .column(j)
                    .map(|(row, value)| value * y[row])
                    .sum::<f64>()
            };
            out.iter_mut().enumerate().for_each(|(j, o)| *o = along(j));
        };
        Residuals::of(
            self.whole.lower(),
            self.whole.upper(),
            z,
            &self.whole.value(z),
            product,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INF: f64 = f64::INFINITY;

    fn problem(entries: &[(usize, usize, f64)], q: &[f64], free: usize) -> SparseLinearMcp {
        let lower = (0..q.len())
            .map(|i| if i < free { -INF } else { 0.0 })
            .collect();
        SparseLinearMcp::new(
            entries.iter().copied(),
            q.to_vec(),
            lower,
            vec![INF; q.len()],
        )
        .unwrap()
    }

    #[test]
    fn singular_blocks_are_refused_with_their_row_or_residual() {
        let refused = |p: &SparseLinearMcp| CondensedMcp::new(p).map(|_| ()).unwrap_err();
        // Row 1 has the same single unknown as row 0.
        let structural = problem(&[(0, 0, 1.0), (1, 0, 1.0), (2, 1, 1.0)], &[0.0; 3], 2);
        assert_eq!(
            refused(&structural),
            SparseError::StructurallySingular { row: 1 }
        );
        let zeros = problem(&[(0, 0, 0.0), (1, 1, 1.0)], &[0.0; 2], 1);
        assert_eq!(
            refused(&zeros),
            SparseError::StructurallySingular { row: 0 }
        );
        let ones = [
            (0, 0, 1.0),
            (0, 1, 1.0),
            (1, 0, 1.0),
            (1, 1, 1.0),
            (0, 2, 1.0),
            (2, 2, 1.0),
        ];
        assert!(matches!(
            refused(&problem(&ones, &[0.0; 3], 2)),
            SparseError::SingularFreeBlock { .. }
        ));
        assert!(matches!(
            refused(&problem(&ones[..4], &[0.0; 2], 2)),
            SparseError::SingularFreeBlock { .. }
        ));
        // The near miss is regular.
        let mut near = ones;
        near[3].2 = 1.5;
        assert!(CondensedMcp::new(&problem(&near, &[0.0; 3], 2)).is_ok());
    }

    #[test]
    fn without_free_or_without_bounded_unknowns() {
        let all_bounded = problem(
            &[(0, 0, 2.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 2.0)],
            &[-5.0, -6.0],
            0,
        );
        let outcome = CondensedMcp::new(&all_bounded)
            .unwrap()
            .solve(&[0.0; 2], &Options::default())
            .unwrap();
        assert!(
            (outcome.point[0] - 4.0 / 3.0).abs() < 1e-12 && outcome.termination.reached_tolerance()
        );
        let all_free = problem(&[(0, 0, 2.0), (1, 0, 1.0), (1, 1, 2.0)], &[-4.0, -6.0], 2);
        let outcome = CondensedMcp::new(&all_free)
            .unwrap()
            .solve_linear(&Options::default())
            .unwrap();
        assert_eq!(
            (outcome.point, outcome.termination),
            (vec![2.0, 2.0], Termination::ToleranceReached)
        );
    }

    #[test]
    fn starts_are_checked() {
        let one = problem(&[(0, 0, 1.0)], &[-1.0], 0);
        let condensed = CondensedMcp::new(&one).unwrap();
        let refused = |start: &[f64]| condensed.solve(start, &Options::default()).unwrap_err();
        assert_eq!(
            refused(&[]),
            SolverError::StartLength {
                expected: 1,
                got: 0
            }
            .into()
        );
        assert!(matches!(
            refused(&[f64::NAN]),
            SparseError::Solver(SolverError::StartNotFinite { index: 0, .. })
        ));
    }
}
