//! The verdict on a solution file: is it of this problem, and is every point of it a solution?
//!
//! Input: the problem and the file's content. Output: the number of points, or the first obligation
//! that fails. Called by `mceip check`.

use super::check::Violated;
use super::check::check;
use super::exact::ExactMcp;
use super::file::McpCertificate;

/// Why a solution file is rejected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum McpRejected {
    /// It was made for other data.
    #[error("digest: expected {expected}, got {got:?}")]
    Digest {
        /// Digest of the problem at hand.
        expected: String,
        /// Digest the file names.
        got: String,
    },
    /// A file without a point proves nothing.
    #[error("z: expected at least one solution, got none")]
    NoClaims,
    /// A point is no solution.
    #[error("solution {index}: {violated}")]
    Solution {
        /// Its place in the file.
        index: usize,
        /// The line that fails.
        violated: Violated,
    },
}

impl McpRejected {
    /// The obligation's name, as `spec/corpus` states it: `Digest`, `NoClaims`, `Length`,
    /// `TooLarge`, `Bounds`, `Sign`.
    pub fn name(&self) -> String {
        let text = match self {
            McpRejected::Solution { violated, .. } => format!("{violated:?}"),
            other => format!("{other:?}"),
        };
        let name = text.chars().take_while(char::is_ascii_alphanumeric);
        name.collect()
    }
}

/// The number of points of an accepted file; an accepted file has one at least, and each is a
/// solution.
///
/// # Errors
/// [`McpRejected`], the first obligation that fails.
pub fn judge(problem: &ExactMcp, certificate: &McpCertificate) -> Result<usize, McpRejected> {
    let expected = problem.sha256();
    if certificate.problem_sha256 != expected {
        return Err(McpRejected::Digest {
            expected,
            got: certificate.problem_sha256.chars().take(80).collect(),
        });
    }

    if certificate.points.is_empty() {
        return Err(McpRejected::NoClaims);
    }

    for (index, z) in certificate.points.iter().enumerate() {
        check(problem, z).map_err(|violated| McpRejected::Solution { index, violated })?;
    }

    Ok(certificate.points.len())
}
