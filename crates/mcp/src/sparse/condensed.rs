//! Sparse linear problems: the unknowns without bounds are eliminated by one sparse factorisation,
//! and only the bounded ones are pivoted.
//!
//! Let f be the free unknowns (those without any bound) and s the others. The rows of f read
//! M_ff z_f + M_fs z_s + q_f = 0. With z_f solved for, the rows of s become S z_s + q_S, where
//!
//! - S = M_ss - M_sf M_ff^-1 M_fs,
//! - q_S = q_s - M_sf M_ff^-1 q_f.
//!
//! S is dense, of the order of s. Memory: the nonzeros of M and of the factors of M_ff, and |s|^2;
//! never n^2. A path of the condensed problem gives one of the whole problem: from Lemke's ray,
//! where the rows of f vanish at the start, both are the same pivot for pivot.
//!
//! Input: a [`SparseLinearMcp`] whose block M_ff is regular. Output: a [`CondensedMcp`], whose runs
//! report all unknowns. For users of the crate; the engine itself condenses with `linear`.

use super::problem::SparseLinearMcp;
use crate::linear::SparseLu;
use crate::mcp::{LinearMcp, McpError};
use crate::solver::{
    Options, Outcome, Residuals, SolverError, Termination, check_start, solve, solve_linear,
    unmatched,
};
use crate::tolerance::REFINED;
use nalgebra::DMatrix;

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

/// The fractional part of the golden ratio, whose multiples spread evenly over [0, 1).
const GOLDEN: f64 = 0.618_033_988_749_895;

/// A sparse linear MCP with its free unknowns eliminated. Serves any number of runs.
#[derive(Debug, Clone)]
pub struct CondensedMcp<'a> {
    whole: &'a SparseLinearMcp,
    partition: Partition,
    /// The factors of M_ff.
    factors: SparseLu,
    /// The problem in the bounded unknowns.
    problem: LinearMcp,
}

/// The unknowns of a problem by whether they have a bound.
#[derive(Debug, Clone)]
struct Partition {
    /// Unknowns without any bound, ascending.
    free: Vec<usize>,
    /// All others, ascending.
    bounded: Vec<usize>,
    /// Index of each unknown in its list.
    place: Vec<usize>,
    is_free: Vec<bool>,
}

impl Partition {
    fn new(problem: &SparseLinearMcp) -> Partition {
        let n = problem.dimension();
        let mut partition = Partition {
            free: Vec::new(),
            bounded: Vec::new(),
            place: Vec::with_capacity(n),
            is_free: Vec::with_capacity(n),
        };

        for i in 0..n {
            let has_lower = problem.lower()[i] != f64::NEG_INFINITY;
            let has_upper = problem.upper()[i] != f64::INFINITY;
            let is_free = !has_lower && !has_upper;
            let list = if is_free {
                &mut partition.free
            } else {
                &mut partition.bounded
            };

            partition.place.push(list.len());
            partition.is_free.push(is_free);
            list.push(i);
        }
        partition
    }

    /// The components of a vector that belong to the bounded unknowns.
    fn bounded_part(&self, values: &[f64]) -> Vec<f64> {
        self.bounded.iter().map(|&i| values[i]).collect()
    }
}

/// (row, value) of the non-zeros of a column.
type Column = Vec<(usize, f64)>;

/// The columns of M_ff, rows counted among the free unknowns.
fn free_block(whole: &SparseLinearMcp, partition: &Partition) -> Vec<Column> {
    let mut block = Vec::with_capacity(partition.free.len());
    for &unknown in &partition.free {
        let mut column = Column::new();
        for (row, value) in whole.column(unknown) {
            if partition.is_free[row] && value != 0.0 {
                column.push((partition.place[row], value));
            }
        }

        block.push(column);
    }
    block
}

/// A row of a matrix, given by columns, that is left over by a largest pairing of rows and columns
/// along the non-zeros; `None` if none is.
fn unpaired_row(columns: &[Column]) -> Option<usize> {
    let mut pattern: Vec<Vec<usize>> = Vec::with_capacity(columns.len());
    for column in columns {
        pattern.push(column.iter().map(|entry| entry.0).collect());
    }

    unmatched(&pattern).map(|(row, _)| row)
}

/// The LU factors of a block given by columns.
fn factor(block: &[Column]) -> Result<SparseLu, SparseError> {
    let columns = block.iter().enumerate();
    let entries = columns.flat_map(|(j, column)| column.iter().map(move |&(i, v)| (i, j, v)));

    SparseLu::new(block.len(), entries).ok_or(SparseError::SingularFreeBlock {
        change: f64::INFINITY,
    })
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
        let partition = Partition::new(whole);
        let block = free_block(whole, &partition);
        if let Some(row) = unpaired_row(&block) {
            let row = partition.free[row];
            return Err(SparseError::StructurallySingular { row });
        }

        let empty = LinearMcp::lcp(DMatrix::zeros(0, 0), vec![])?;
        let mut condensed = CondensedMcp {
            whole,
            partition,
            factors: factor(&block)?,
            problem: empty,
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
        &self.partition.bounded
    }

    /// Lemke's method, as [`solve_linear`]; pivots are named by the indices of the whole problem.
    ///
    /// # Errors
    /// [`SolverError::Option`] inside [`SparseError::Solver`] for an option out of range.
    pub fn solve_linear(&self, options: &Options) -> Result<Outcome, SparseError> {
        let outcome = solve_linear(&self.problem, options)?;
        Ok(self.whole_outcome(outcome, options))
    }

    /// A run as [`solve`] from `start` (length n), of which only the bounded components matter.
    ///
    /// # Errors
    /// [`SparseError::Solver`] for options and starts that make no sense.
    pub fn solve(&self, start: &[f64], options: &Options) -> Result<Outcome, SparseError> {
        check_start(self.whole.dimension(), start)?;
        let start = self.partition.bounded_part(start);
        let outcome = solve(&self.problem, &start, options)?;

        Ok(self.whole_outcome(outcome, options))
    }

    /// All unknowns, length n, for values of the bounded ones: the free rows vanish.
    pub fn lift(&self, bounded: &[f64]) -> Vec<f64> {
        let mut z = vec![0.0; self.whole.dimension()];
        for (&i, value) in self.partition.bounded.iter().zip(bounded) {
            z[i] = *value;
        }

        // The second round is iterative refinement.
        for _ in 0..2 {
            let f = self.whole.value(&z);
            let right: Vec<f64> = self.partition.free.iter().map(|&i| -f[i]).collect();
            let mut step = [right];
            self.factors.solve(&mut step);

            for (&i, value) in self.partition.free.iter().zip(&step[0]) {
                z[i] += value;
            }
        }
        z
    }

    /// The condensed problem: S and q_S, with the bounds of the bounded unknowns.
    fn condense(&self) -> Result<LinearMcp, SparseError> {
        self.check_free_block()?;

        let count = self.partition.bounded.len();
        let mut s = DMatrix::zeros(count, count);

        for first in (0..count).step_by(BLOCK) {
            let columns = first..count.min(first + BLOCK);
            let right: Vec<Vec<f64>> = columns.clone().map(|k| self.free_rows(k)).collect();
            let solved = self.solve_refined(&right)?;

            for (k, x) in columns.zip(&solved) {
                self.add_column(k, x, &mut s);
            }
        }

        // F_s where z_s = 0 and the rows of f vanish.
        let f = self.whole.value(&self.lift(&vec![0.0; count]));
        let q = self.partition.bounded_part(&f);
        let lower = self.partition.bounded_part(self.whole.lower());
        let upper = self.partition.bounded_part(self.whole.upper());

        Ok(LinearMcp::new(s, q, lower, upper)?)
    }

    /// Refuses a singular block M_ff, also where no column has to be solved for: solves for a
    /// generic right-hand side, which is in the range of no singular block.
    fn check_free_block(&self) -> Result<(), SparseError> {
        let mut right = Vec::with_capacity(self.partition.free.len());
        for i in 0..self.partition.free.len() {
            right.push(0.5 + (i as f64 * GOLDEN).fract());
        }

        self.solve_refined(&[right]).map(drop)
    }

    /// Adds column k of S = M_ss - M_sf M_ff^-1 M_fs, where `x` is column k of M_ff^-1 M_fs.
    fn add_column(&self, k: usize, x: &[f64], s: &mut DMatrix<f64>) {
        let place = &self.partition.place;
        for (row, value) in self.bounded_rows(self.partition.bounded[k]) {
            s[(place[row], k)] += value;
        }

        for (&j, x) in self.partition.free.iter().zip(x) {
            if *x == 0.0 {
                continue;
            }

            for (row, value) in self.bounded_rows(j) {
                s[(place[row], k)] -= value * x;
            }
        }
    }

    /// (row, value) of a column of M in the rows of the bounded unknowns.
    fn bounded_rows(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let entries = self.whole.column(column);
        entries.filter(|(row, _)| !self.partition.is_free[*row])
    }

    /// Column k of M_fs, as a dense vector over f.
    fn free_rows(&self, k: usize) -> Vec<f64> {
        let mut out = vec![0.0; self.partition.free.len()];
        for (row, value) in self.whole.column(self.partition.bounded[k]) {
            if self.partition.is_free[row] {
                out[self.partition.place[row]] = value;
            }
        }
        out
    }

    /// M_ff^-1 of columns, with one step of iterative refinement and a check that it contracts.
    fn solve_refined(&self, right: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, SparseError> {
        let mut solutions = right.to_vec();
        self.factors.solve(&mut solutions);

        let mut steps = Vec::with_capacity(right.len());
        for (b, x) in right.iter().zip(&solutions) {
            steps.push(self.residual(b, x));
        }

        self.factors.solve(&mut steps);

        for (x, step) in solutions.iter_mut().zip(&steps) {
            check_contraction(x, step)?;
            for (x, step) in x.iter_mut().zip(step) {
                *x += step;
            }
        }
        Ok(solutions)
    }

    /// b - M_ff x.
    fn residual(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut residual = b.to_vec();
        for (&j, x) in self.partition.free.iter().zip(x) {
            for (row, value) in self.whole.column(j) {
                if self.partition.is_free[row] {
                    residual[self.partition.place[row]] -= value * x;
                }
            }
        }
        residual
    }

    /// The outcome for the whole problem: its point, its residuals, its names.
    fn whole_outcome(&self, mut outcome: Outcome, options: &Options) -> Outcome {
        outcome.point = self.lift(&outcome.point);
        outcome.residuals = self.residuals(&outcome.point);

        let is_within = outcome.residuals.within(options.convergence_tolerance);
        if outcome.termination.reached_tolerance() && !is_within {
            outcome.termination = Termination::NoProgress;
        }

        for major in &mut outcome.log {
            for path in &mut major.paths {
                for pivot in &mut path.pivots {
                    *pivot = pivot.renamed(&self.partition.bounded);
                }
            }
        }
        outcome
    }

    /// The five residuals of the whole problem at a point of length n.
    pub fn residuals(&self, z: &[f64]) -> Residuals {
        let f = self.whole.value(z);
        Residuals::of(self.whole.lower(), self.whole.upper(), z, &f, |y, out| {
            self.transposed_product(y, out)
        })
    }

    /// Writes M' y into `out`.
    fn transposed_product(&self, y: &[f64], out: &mut [f64]) {
        for (j, out) in out.iter_mut().enumerate() {
            let terms = self.whole.column(j).map(|(row, value)| value * y[row]);
            *out = terms.sum();
        }
    }
}

/// Refuses a solution that is not finite, or that a step of refinement changes by more than
/// [`REFINED`] of its size.
fn check_contraction(x: &[f64], step: &[f64]) -> Result<(), SparseError> {
    let change = largest(step);
    let size = largest(x);
    if size.is_finite() && change <= REFINED * size {
        return Ok(());
    }

    let change = if size > 0.0 { change / size } else { change };
    Err(SparseError::SingularFreeBlock { change })
}

/// The largest absolute value, infinite if there is a NaN; 0 of nothing.
fn largest(values: &[f64]) -> f64 {
    let mut largest: f64 = 0.0;
    for value in values {
        if value.is_nan() {
            return f64::INFINITY;
        }
        largest = largest.max(value.abs());
    }
    largest
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

        assert!((outcome.point[0] - 4.0 / 3.0).abs() < 1e-12);
        assert!(outcome.termination.reached_tolerance());

        let all_free = problem(&[(0, 0, 2.0), (1, 0, 1.0), (1, 1, 2.0)], &[-4.0, -6.0], 2);
        let outcome = CondensedMcp::new(&all_free)
            .unwrap()
            .solve_linear(&Options::default())
            .unwrap();

        assert_eq!(outcome.point, vec![2.0, 2.0]);
        assert_eq!(outcome.termination, Termination::ToleranceReached);
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
