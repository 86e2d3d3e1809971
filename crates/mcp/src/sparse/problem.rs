//! Linear MCPs with a sparse matrix.

use crate::mcp::{McpError, check_bounds};

/// F(z) = M z + q on [l, u], M by columns with no entry stored twice.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseLinearMcp {
    start: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    q: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl SparseLinearMcp {
    /// From entries (row, column, value) of M in any order; entries of one place add up.
    ///
    /// # Errors
    /// [`McpError`] naming the part, row and column.
    ///
    /// ```
    /// use mceip_mcp::sparse::SparseLinearMcp;
    /// let inf = f64::INFINITY;
    /// let m = [
    ///     (0, 0, 2.0),
    ///     (0, 1, -1.0),
    ///     (1, 0, -1.0),
    ///     (1, 1, 1.0),
    ///     (1, 1, 1.0),
    /// ];
    /// let problem =
    ///     SparseLinearMcp::new(m, vec![-1.0, 3.0], vec![-inf, 0.0], vec![inf; 2]).unwrap();
    /// assert_eq!(problem.value(&[1.0, 1.0]), [0.0, 4.0]);
    /// assert!(SparseLinearMcp::new([(0, 1, 2.0)], vec![0.0], vec![0.0], vec![1.0]).is_err());
    /// ```
    pub fn new(
        entries: impl IntoIterator<Item = (usize, usize, f64)>,
        q: Vec<f64>,
        lower: Vec<f64>,
        upper: Vec<f64>,
    ) -> Result<Self, McpError> {
        let order = q.len();
        for (what, got) in [("lower", lower.len()), ("upper", upper.len())] {
            if got != order {
                return Err(McpError::Shape {
                    what,
                    expected: order,
                    got,
                });
            }
        }
        let mut entries: Vec<(usize, usize, f64)> = entries.into_iter().collect();
        for &(row, col, got) in &entries {
            if row >= order || col >= order {
                return Err(McpError::Index { row, col, order });
            }
            if !got.is_finite() {
                return Err(McpError::NotFinite {
                    what: "M",
                    row,
                    col,
                    got,
                });
            }
        }
        if let Some(row) = q.iter().position(|v| !v.is_finite()) {
            return Err(McpError::NotFinite {
                what: "q",
                row,
                col: 0,
                got: q[row],
            });
        }
        check_bounds(&lower, &upper)?;
        entries.sort_by_key(|&(row, col, _)| (col, row)); // stable: sums in the order given
        let (mut start, mut rows, mut values) = (vec![0; order + 1], Vec::new(), Vec::new());
        let mut last = None;
        for (row, col, value) in entries {
            if last == Some((row, col)) {
                // There is one: `last` is set.
                if let Some(sum) = values.last_mut() {
                    *sum += value;
                }
                continue;
            }
            last = Some((row, col));
            rows.push(row);
            values.push(value);
            start[col + 1] += 1;
        }
        (0..order).for_each(|col| start[col + 1] += start[col]);
        let problem = SparseLinearMcp {
            start,
            rows,
            values,
            q,
            lower,
            upper,
        };
        let overflown = problem.entries().find(|e| !e.2.is_finite()); // a sum of two
        match overflown {
            Some((row, col, got)) => Err(McpError::NotFinite {
                what: "M",
                row,
                col,
                got,
            }),
            None => Ok(problem),
        }
    }

    /// Number of unknowns n.
    pub fn dimension(&self) -> usize {
        self.q.len()
    }

    /// Lower bounds, length n, -inf for none.
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// Upper bounds, length n, +inf for none.
    pub fn upper(&self) -> &[f64] {
        &self.upper
    }

    /// The vector q, length n.
    pub fn vector(&self) -> &[f64] {
        &self.q
    }

    /// (row, value) of a column of M, rows ascending.
    pub fn column(&self, col: usize) -> impl Iterator<Item = (usize, f64)> {
        let place = self.start[col]..self.start[col + 1];
        self.rows[place.clone()]
            .iter()
            .copied()
            .zip(self.values[place].iter().copied())
    }

    /// (row, column, value) of M, by columns.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.dimension())
            .flat_map(|col| self.column(col).map(move |(row, value)| (row, col, value)))
    }

    /// F(z), of length n; `z` is of that length.
    pub fn value(&self, z: &[f64]) -> Vec<f64> {
        let mut f = self.q.clone();
        for (col, z) in z.iter().enumerate().filter(|(_, z)| **z != 0.0) {
            self.column(col)
                .for_each(|(row, value)| f[row] += value * z);
        }
        f
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn entries_in_any_order_add_up() {
        let list = [
            (1, 1, 2.0),
            (0, 1, 5.0),
            (2, 0, -1.0),
            (1, 1, 0.5),
            (0, 0, 1.0),
        ];
        let problem =
            SparseLinearMcp::new(list, vec![1.0, 2.0, 3.0], vec![0.0; 3], vec![INF; 3]).unwrap();
        let all: Vec<_> = problem.entries().collect();
        assert_eq!(all, [(0, 0, 1.0), (2, 0, -1.0), (0, 1, 5.0), (1, 1, 2.5)]);
        assert_eq!(problem.value(&[1.0, 2.0, 7.0]), [12.0, 7.0, 2.0]);
    }

    #[test]
    fn refusals_name_the_place() {
        let of = |entry: (usize, usize, f64), q: f64, lower: Vec<f64>| {
            SparseLinearMcp::new([(0, 0, 1.0), entry], vec![0.0, q], lower, vec![1.0; 2])
                .map(|_| ())
        };
        let zero = || vec![0.0; 2];
        assert_eq!(of((1, 1, 3.0), 0.0, zero()), Ok(()));
        let cases = [
            (
                of((1, 2, 3.0), 0.0, zero()),
                "expected row and column of M < 2, got (1, 2)",
            ),
            (
                of((1, 0, f64::NAN), 0.0, zero()),
                "expected a finite M[1][0], got NaN",
            ),
            (
                of((1, 1, 3.0), INF, zero()),
                "expected a finite q[1][0], got inf",
            ),
            (
                of((1, 1, 3.0), 0.0, vec![0.0]),
                "expected lower of length 2, got 1",
            ),
            (
                of((1, 1, 3.0), 0.0, vec![0.0, 2.0]),
                "expected lower <= upper at 1, got 2 and 1",
            ),
        ];
        for (got, message) in cases {
            assert_eq!(got.unwrap_err().to_string(), message);
        }
        let twice = [(0, 0, f64::MAX), (0, 0, f64::MAX)];
        let overflow = SparseLinearMcp::new(twice, vec![0.0], vec![0.0], vec![1.0]).unwrap_err();
        assert_eq!(overflow.to_string(), "expected a finite M[0][0], got inf");
    }
}
