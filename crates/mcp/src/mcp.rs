//! Mixed complementarity problems in doubles: all that the solver sees of a problem.
//!
//! An MCP is (book, 3.1): given bounds l <= u and a function F, find z in [l, u] with
//!
//! - F_i(z) >= 0 where z_i = l_i,
//! - F_i(z) = 0 where z_i lies strictly inside,
//! - F_i(z) <= 0 where z_i = u_i.
//!
//! [`Mcp`] is the interface of a problem, [`FunctionMcp`] one made of closures, [`LinearMcp`] the
//! problem with F(z) = M z + q. [`check_jacobian`] holds a Jacobian against finite differences.

mod differences;
mod function;

pub use differences::{JacobianError, check_jacobian, difference_jacobian};
pub use function::FunctionMcp;

use nalgebra::DMatrix;

/// MCP(F, l, u): find z in [l, u] with F_i(z) >= 0 where z_i = l_i, F_i(z) = 0 strictly inside,
/// F_i(z) <= 0 where z_i = u_i (Dirkse and Ferris 1995, section 1).
pub trait Mcp {
    /// Number of unknowns n.
    fn dimension(&self) -> usize;
    /// Lower bounds, length n, -inf for none.
    fn lower(&self) -> &[f64];
    /// Upper bounds, length n, +inf for none.
    fn upper(&self) -> &[f64];
    /// Writes F(z) into `f`, both of length n.
    fn function(&self, z: &[f64], f: &mut [f64]);
    /// Writes the n x n Jacobian F'(z) into `j`, every entry.
    ///
    /// A problem that does not write it is asked for its [`Mcp::entries`]; one that has neither is
    /// differentiated by differences ([`difference_jacobian`]: 2n further values of F).
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let mut entries = Vec::new();
        if self.entries(z, &mut entries) {
            scatter(&entries, j);
        } else {
            difference_jacobian(self, z, j);
        }
    }

    /// Adds the entries (row, column, value) of a sparse F'(z) to an empty list and says true;
    /// false, as it is unless written, if F' is to be taken as a dense matrix. Entries of one place
    /// add up. A problem gives them at every point or at none.
    fn entries(&self, z: &[f64], entries: &mut Vec<(usize, usize, f64)>) -> bool {
        let _ = (z, entries);
        false
    }
}

/// Writes a matrix of these entries; NaN in all places if one of them lies beyond its order.
fn scatter(entries: &[(usize, usize, f64)], j: &mut DMatrix<f64>) {
    j.fill(0.0);
    for &(row, col, value) in entries {
        match j.get_mut((row, col)) {
            Some(entry) => *entry += value,
            None => return j.fill(f64::NAN),
        }
    }
}

/// A linear MCP: F(z) = M z + q.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearMcp {
    m: DMatrix<f64>,
    q: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// Why a linear MCP is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum McpError {
    /// A part has the wrong length or the matrix is not square.
    #[error("expected {what} of length {expected}, got {got}")]
    Shape {
        /// Which part.
        what: &'static str,
        /// Length wanted.
        expected: usize,
        /// Length found.
        got: usize,
    },
    /// An index of a sparse matrix beyond its order.
    #[error("expected row and column of M < {order}, got ({row}, {col})")]
    Index {
        /// Row.
        row: usize,
        /// Column.
        col: usize,
        /// Order of the matrix.
        order: usize,
    },
    /// An entry is NaN, or infinite where it must not be.
    #[error("expected a finite {what}[{row}][{col}], got {got}")]
    NotFinite {
        /// Which part.
        what: &'static str,
        /// Row.
        row: usize,
        /// Column, 0 for vectors.
        col: usize,
        /// The entry.
        got: f64,
    },
    /// A lower bound above the upper one, or NaN.
    #[error("expected lower <= upper at {index}, got {lower} and {upper}")]
    Bounds {
        /// The unknown.
        index: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
}

/// Refuses a part of another length than expected.
///
/// # Errors
/// [`McpError::Shape`] naming the part.
pub(crate) fn check_length(
    what: &'static str,
    expected: usize,
    got: usize,
) -> Result<(), McpError> {
    if got == expected {
        return Ok(());
    }

    Err(McpError::Shape {
        what,
        expected,
        got,
    })
}

impl LinearMcp {
    /// The problem with F(z) = M z + q on [lower, upper].
    ///
    /// # Errors
    /// [`McpError`] naming the part, row and column.
    ///
    /// ```
    /// use mceip_mcp::mcp::LinearMcp;
    /// let inf = f64::INFINITY;
    /// assert!(LinearMcp::new(nalgebra::dmatrix![2.0], vec![-1.0], vec![0.0], vec![inf]).is_ok());
    /// assert!(LinearMcp::new(nalgebra::dmatrix![2.0], vec![-1.0], vec![1.0], vec![0.0]).is_err());
    /// ```
    pub fn new(
        m: DMatrix<f64>,
        q: Vec<f64>,
        lower: Vec<f64>,
        upper: Vec<f64>,
    ) -> Result<Self, McpError> {
        let n = q.len();
        check_length("rows of M", n, m.nrows())?;
        check_length("columns of M", n, m.ncols())?;
        check_length("lower", n, lower.len())?;
        check_length("upper", n, upper.len())?;

        for row in 0..n {
            if let Some(col) = (0..n).find(|&col| !m[(row, col)].is_finite()) {
                return Err(McpError::NotFinite {
                    what: "M",
                    row,
                    col,
                    got: m[(row, col)],
                });
            }

            if !q[row].is_finite() {
                return Err(McpError::NotFinite {
                    what: "q",
                    row,
                    col: 0,
                    got: q[row],
                });
            }
        }

        check_bounds(&lower, &upper)?;
        Ok(LinearMcp { m, q, lower, upper })
    }

    /// The linear complementarity problem 0 <= z, 0 <= M z + q, z'(M z + q) = 0.
    ///
    /// # Errors
    /// [`McpError`] naming the part, row and column.
    pub fn lcp(m: DMatrix<f64>, q: Vec<f64>) -> Result<Self, McpError> {
        let n = q.len();
        LinearMcp::new(m, q, vec![0.0; n], vec![f64::INFINITY; n])
    }

    /// The matrix M, n x n.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.m
    }

    /// The vector q, length n.
    pub fn vector(&self) -> &[f64] {
        &self.q
    }
}

/// Refuses bounds that are crossed, NaN, or infinite on the wrong side.
///
/// # Errors
/// [`McpError::Bounds`] with the first index.
pub fn check_bounds(lower: &[f64], upper: &[f64]) -> Result<(), McpError> {
    for (index, (&lower, &upper)) in lower.iter().zip(upper).enumerate() {
        if !are_bounds(lower, upper) {
            return Err(McpError::Bounds {
                index,
                lower,
                upper,
            });
        }
    }

    Ok(())
}

/// Is [lower, upper] an interval that contains a number?
fn are_bounds(lower: f64, upper: f64) -> bool {
    // False also where one of them is NaN.
    let is_ordered = lower <= upper;
    let is_lower_bound = lower != f64::INFINITY;
    let is_upper_bound = upper != f64::NEG_INFINITY;
    is_ordered && is_lower_bound && is_upper_bound
}

impl Mcp for LinearMcp {
    fn dimension(&self) -> usize {
        self.q.len()
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        for (i, f_i) in f.iter_mut().enumerate() {
            let terms = z.iter().enumerate().map(|(j, z_j)| self.m[(i, j)] * z_j);
            let product: f64 = terms.sum();
            *f_i = self.q[i] + product;
        }
    }
    fn jacobian(&self, _z: &[f64], j: &mut DMatrix<f64>) {
        j.copy_from(&self.m);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn evaluates_function_and_jacobian() {
        let lcp = LinearMcp::lcp(dmatrix![1.0, 2.0; 3.0, 4.0], vec![5.0, 6.0]).unwrap();
        let mut f = [0.0; 2];
        lcp.function(&[1.0, -1.0], &mut f);

        assert_eq!(f, [4.0, 5.0]);

        let mut j = DMatrix::zeros(2, 2);
        lcp.jacobian(&[0.0, 0.0], &mut j);
        assert_eq!(&j, lcp.matrix());
    }

    #[test]
    fn refusals_name_the_place() {
        let identity = || dmatrix![1.0, 0.0; 0.0, 1.0];
        let cases = [
            (
                LinearMcp::lcp(identity(), vec![0.0]),
                "expected rows of M of length 1, got 2",
            ),
            (
                LinearMcp::lcp(DMatrix::zeros(2, 3), vec![0.0; 2]),
                "expected columns of M of length 2, got 3",
            ),
            (
                LinearMcp::lcp(dmatrix![1.0, f64::NAN; 0.0, 1.0], vec![0.0; 2]),
                "expected a finite M[0][1], got NaN",
            ),
            (
                LinearMcp::lcp(identity(), vec![0.0, INF]),
                "expected a finite q[1][0], got inf",
            ),
            (
                LinearMcp::new(identity(), vec![0.0; 2], vec![0.0, 2.0], vec![1.0; 2]),
                "expected lower <= upper at 1, got 2 and 1",
            ),
            (
                LinearMcp::new(identity(), vec![0.0; 2], vec![INF, 0.0], vec![INF; 2]),
                "expected lower <= upper at 0, got inf and inf",
            ),
            (
                LinearMcp::new(identity(), vec![0.0; 2], vec![0.0; 2], vec![1.0, f64::NAN]),
                "expected lower <= upper at 1, got 0 and NaN",
            ),
        ];

        for (made, message) in cases {
            assert_eq!(made.unwrap_err().to_string(), message);
        }
    }
}
