//! Linear MCPs with a sparse matrix: F(z) = M z + q on [l, u], M by columns.
//!
//! Made from entries in any order; entries of one place add up. Everything is checked once, here:
//! indices, lengths, finite numbers, bounds. `condensed` reads the columns.

use crate::mcp::{McpError, check_bounds, check_length};

/// Row, column and value.
type Entry = (usize, usize, f64);

/// F(z) = M z + q on [l, u], M by columns with no entry stored twice.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseLinearMcp {
    /// For each column the index of its first entry, then the number of entries.
    start: Vec<usize>,
    /// The row of each entry, ascending in a column.
    rows: Vec<usize>,
    /// The value of each entry.
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
        check_length("lower", order, lower.len())?;
        check_length("upper", order, upper.len())?;

        let entries: Vec<Entry> = entries.into_iter().collect();
        check_entries(&entries, order)?;
        check_vector(&q)?;
        check_bounds(&lower, &upper)?;

        let mut problem = SparseLinearMcp {
            start: vec![0; order + 1],
            rows: Vec::new(),
            values: Vec::new(),
            q,
            lower,
            upper,
        };

        problem.fill_columns(entries);
        problem.check_sums()?;
        Ok(problem)
    }

    /// Stores the entries by columns; those of one place add up in the order given.
    fn fill_columns(&mut self, mut entries: Vec<Entry>) {
        // The sort is stable.
        entries.sort_by_key(|&(row, col, _)| (col, row));

        let mut last_place = None;
        for (row, col, value) in entries {
            if last_place == Some((row, col))
                && let Some(sum) = self.values.last_mut()
            {
                *sum += value;
                continue;
            }
            last_place = Some((row, col));
            self.rows.push(row);
            self.values.push(value);
            self.start[col + 1] += 1;
        }

        for col in 0..self.dimension() {
            self.start[col + 1] += self.start[col];
        }
    }

    /// Refuses entries that overflow: sums of finite ones.
    fn check_sums(&self) -> Result<(), McpError> {
        match self.entries().find(|(_, _, value)| !value.is_finite()) {
            Some(entry) => Err(not_finite(entry)),
            None => Ok(()),
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
        let rows = self.rows[place.clone()].iter().copied();
        let values = self.values[place].iter().copied();

        rows.zip(values)
    }

    /// (row, column, value) of M, by columns.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.dimension())
            .flat_map(|col| self.column(col).map(move |(row, value)| (row, col, value)))
    }

    /// F(z), of length n; `z` is of that length.
    pub fn value(&self, z: &[f64]) -> Vec<f64> {
        let mut f = self.q.clone();
        for (col, z) in z.iter().enumerate() {
            if *z == 0.0 {
                continue;
            }

            for (row, value) in self.column(col) {
                f[row] += value * z;
            }
        }
        f
    }
}

/// Refuses indices beyond the order, and entries that are not finite.
fn check_entries(entries: &[Entry], order: usize) -> Result<(), McpError> {
    for &(row, col, value) in entries {
        if row >= order || col >= order {
            return Err(McpError::Index { row, col, order });
        }

        if !value.is_finite() {
            return Err(not_finite((row, col, value)));
        }
    }

    Ok(())
}

/// The refusal of an entry of M.
fn not_finite((row, col, got): Entry) -> McpError {
    McpError::NotFinite {
        what: "M",
        row,
        col,
        got,
    }
}

/// Refuses a vector q that is not finite.
fn check_vector(q: &[f64]) -> Result<(), McpError> {
    match q.iter().position(|value| !value.is_finite()) {
        Some(row) => Err(McpError::NotFinite {
            what: "q",
            row,
            col: 0,
            got: q[row],
        }),
        None => Ok(()),
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
        let made = |entry: (usize, usize, f64), q: f64, lower: Vec<f64>| {
            SparseLinearMcp::new([(0, 0, 1.0), entry], vec![0.0, q], lower, vec![1.0; 2])
                .map(|_| ())
        };
        let zero = || vec![0.0; 2];

        assert_eq!(made((1, 1, 3.0), 0.0, zero()), Ok(()));

        let cases = [
            (
                made((1, 2, 3.0), 0.0, zero()),
                "expected row and column of M < 2, got (1, 2)",
            ),
            (
                made((1, 0, f64::NAN), 0.0, zero()),
                "expected a finite M[1][0], got NaN",
            ),
            (
                made((1, 1, 3.0), INF, zero()),
                "expected a finite q[1][0], got inf",
            ),
            (
                made((1, 1, 3.0), 0.0, vec![0.0]),
                "expected lower of length 2, got 1",
            ),
            (
                made((1, 1, 3.0), 0.0, vec![0.0, 2.0]),
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
