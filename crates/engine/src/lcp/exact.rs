//! A linear MCP over Q: F(z) = M z + q on [l, u], with its canonical text.
//!
//! Made by `file`; the other files of this folder search, certify and check its solutions.

use mceip_exact::{Rational, to_f64};
use mceip_mcp::mcp::{LinearMcp, McpError};
use mceip_model::sha256;
use nalgebra::DMatrix;
use num_traits::Zero;

/// A linear MCP over Q; `None` is an absent bound.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactMcp {
    /// M by rows, n x n.
    m: Vec<Vec<Rational>>,
    q: Vec<Rational>,
    lower: Vec<Option<Rational>>,
    upper: Vec<Option<Rational>>,
}

/// Why an exact MCP is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExactMcpError {
    /// A part has the wrong length.
    #[error("expected {what} of length {expected}, got {got}")]
    Shape {
        /// Which part, with its row.
        what: String,
        /// Length wanted.
        expected: usize,
        /// Length found.
        got: usize,
    },
    /// Bounds are crossed.
    #[error("expected lower <= upper at {index}, got {lower} and {upper}")]
    Bounds {
        /// The unknown.
        index: usize,
        /// Its lower bound.
        lower: Rational,
        /// Its upper bound.
        upper: Rational,
    },
}

impl ExactMcp {
    /// The problem with F(z) = M z + q, M by rows (n x n), all parts of length n.
    ///
    /// # Errors
    /// [`ExactMcpError`] naming the part or the index.
    pub fn new(
        m: Vec<Vec<Rational>>,
        q: Vec<Rational>,
        lower: Vec<Option<Rational>>,
        upper: Vec<Option<Rational>>,
    ) -> Result<Self, ExactMcpError> {
        let n = q.len();
        require_length("m".into(), m.len(), n)?;
        require_length("lower".into(), lower.len(), n)?;
        require_length("upper".into(), upper.len(), n)?;
        for (i, row) in m.iter().enumerate() {
            require_length(format!("row {i} of m"), row.len(), n)?;
        }

        for (index, bounds) in lower.iter().zip(&upper).enumerate() {
            if let (Some(l), Some(u)) = bounds
                && l > u
            {
                return Err(ExactMcpError::Bounds {
                    index,
                    lower: l.clone(),
                    upper: u.clone(),
                });
            }
        }

        Ok(ExactMcp { m, q, lower, upper })
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.q.len()
    }

    /// Lower and upper bound of an unknown.
    pub fn bounds(&self, i: usize) -> (Option<&Rational>, Option<&Rational>) {
        (self.lower[i].as_ref(), self.upper[i].as_ref())
    }

    /// M z + q, exactly; z of length n.
    pub fn function(&self, z: &[Rational]) -> Vec<Rational> {
        let mut f = self.q.clone();
        for (f_i, row) in f.iter_mut().zip(&self.m) {
            for (m, z_j) in row.iter().zip(z) {
                if !m.is_zero() {
                    *f_i += m * z_j;
                }
            }
        }

        f
    }

    /// Row of M, and its entry of q.
    pub(crate) fn row(&self, i: usize) -> (&[Rational], &Rational) {
        (&self.m[i], &self.q[i])
    }

    /// Entry of M.
    pub(crate) fn entry(&self, i: usize, j: usize) -> &Rational {
        &self.m[i][j]
    }

    /// The problem in doubles, each number rounded to the nearest.
    ///
    /// # Errors
    /// [`McpError`] for a number beyond the range of doubles.
    pub fn to_f64(&self) -> Result<LinearMcp, McpError> {
        let n = self.q.len();
        let m = DMatrix::from_fn(n, n, |i, j| to_f64(&self.m[i][j]));
        let q = self.q.iter().map(to_f64).collect();
        let lower = self.lower.iter();
        let upper = self.upper.iter();

        LinearMcp::new(
            m,
            q,
            lower.map(|b| bound_or(b, f64::NEG_INFINITY)).collect(),
            upper.map(|b| bound_or(b, f64::INFINITY)).collect(),
        )
    }

    /// SHA-256, lower-case hex, of the canonical text: `mceip-mcp-canonical/1`, n, then a line for
    /// each row of M with q, l and u appended, rationals in lowest terms, `-` for an absent bound.
    pub fn sha256(&self) -> String {
        let mut text = format!("mceip-mcp-canonical/1\n{}\n", self.q.len());
        for i in 0..self.q.len() {
            let row: Vec<String> = self.m[i].iter().map(ToString::to_string).collect();
            let row = row.join(" ");
            let q = &self.q[i];
            let lower = canonical_bound(&self.lower[i]);
            let upper = canonical_bound(&self.upper[i]);
            text += &format!("{row} {q} {lower} {upper}\n");
        }

        sha256(&text)
    }
}

fn require_length(what: String, got: usize, expected: usize) -> Result<(), ExactMcpError> {
    if got == expected {
        Ok(())
    } else {
        Err(ExactMcpError::Shape {
            what,
            expected,
            got,
        })
    }
}

/// The bound in doubles, `absent` where there is none.
fn bound_or(bound: &Option<Rational>, absent: f64) -> f64 {
    bound.as_ref().map_or(absent, to_f64)
}

/// The bound in the canonical text, `-` where there is none.
fn canonical_bound(bound: &Option<Rational>) -> String {
    match bound {
        Some(bound) => bound.to_string(),
        None => "-".into(),
    }
}
