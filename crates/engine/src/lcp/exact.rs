//! A linear MCP over Q: F(z) = M z + q on [l, u], with its canonical text.

use mceip_exact::{Rational, to_f64};
use mceip_mcp::mcp::{LinearMcp, McpError};
use nalgebra::DMatrix;
use num_traits::Zero;
use sha2::{Digest as _, Sha256};

/// A linear MCP over Q; `None` is an absent bound.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactMcp {
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
        let rows = m
            .iter()
            .enumerate()
            .map(|(i, row)| (format!("row {i} of m"), row.len()));
        let parts = [
            ("m".to_string(), m.len()),
            ("lower".into(), lower.len()),
            ("upper".into(), upper.len()),
        ];
        for (what, got) in parts.into_iter().chain(rows) {
            if got != n {
                return Err(ExactMcpError::Shape {
                    what,
                    expected: n,
                    got,
                });
            }
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
        let row = |i: usize| {
            self.m[i]
                .iter()
                .zip(z)
                .filter(|(a, _)| !a.is_zero())
                .fold(self.q[i].clone(), |sum, (a, b)| sum + a * b)
        };
        (0..self.q.len()).map(row).collect()
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
        let bound = |b: &Option<Rational>, none: f64| b.as_ref().map_or(none, to_f64);
        LinearMcp::new(
            DMatrix::from_fn(n, n, |i, j| to_f64(&self.m[i][j])),
            self.q.iter().map(to_f64).collect(),
            self.lower
                .iter()
                .map(|b| bound(b, f64::NEG_INFINITY))
                .collect(),
            self.upper.iter().map(|b| bound(b, f64::INFINITY)).collect(),
        )
    }

    /// SHA-256, lower-case hex, of the canonical text: `mceip-mcp-canonical/1`, n, then a line for
    /// each row of M with q, l and u appended, rationals in lowest terms, `-` for an absent bound.
    pub fn sha256(&self) -> String {
        let mut text = format!("mceip-mcp-canonical/1\n{}\n", self.q.len());
        let bound = |b: &Option<Rational>| b.as_ref().map_or("-".to_string(), ToString::to_string);
        for i in 0..self.q.len() {
            let row: Vec<String> = self.m[i].iter().map(ToString::to_string).collect();
            text += &format!(
                "{} {} {} {}\n",
                row.join(" "),
                self.q[i],
                bound(&self.lower[i]),
                bound(&self.upper[i])
            );
        }
        Sha256::digest(text.as_bytes())
            .iter()
            .map(|b| format!("{b:02x}"))
            .collect()
    }
}
