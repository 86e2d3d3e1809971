//! `mceip-mcp/1` and the file of a solution, `mceip-mcp-solution/1`.
//!
//! Input: JSON text with exact numbers. Output: an [`ExactMcp`], or the points of a solution file
//! with the digest of their problem; and both back to text. Called by `mceip solve`
//! and `mceip check` for plain problems.

use super::exact::{ExactMcp, ExactMcpError};
use mceip_exact::{Rational, whole};
use mceip_model::ModelError;
use mceip_model::file::{Number, from_json_of};
use serde::Deserialize;

/// The format of plain problems.
pub const MCP_FORMAT: &str = "mceip-mcp/1";
/// The format of their solutions, which are their own certificates.
pub const SOLUTION_FORMAT: &str = "mceip-mcp-solution/1";

/// A problem as it stands in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawProblemFile {
    #[serde(rename = "name")]
    _name: Option<String>,
    #[serde(rename = "comment")]
    _comment: Option<String>,
    m: Vec<Vec<Number>>,
    q: Vec<Number>,
    lower: Option<Vec<Option<Number>>>,
    upper: Option<Vec<Option<Number>>>,
}

/// Why a file is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// Not of this shape.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Parts that do not fit together.
    #[error(transparent)]
    Mcp(#[from] ExactMcpError),
}

/// Reads `{"format": "mceip-mcp/1", "m": [[...]], "q": [...], "lower": [...], "upper": [...]}`.
///
/// Numbers are read exactly. Bounds are optional: without `lower` all are 0, without `upper` there
/// are none; an entry `null` is an absent bound. An LCP needs m and q only.
///
/// # Errors
/// [`FileError`] with the place, what was expected and what was found.
///
/// ```
/// use mceip_engine::lcp::read_mcp;
/// let lcp = read_mcp(r#"{"format": "mceip-mcp/1", "m": [["1/2"]], "q": [-1]}"#).unwrap();
/// assert_eq!(lcp.dimension(), 1);
/// assert!(
///     read_mcp(r#"{"format": "mceip-mcp/1", "m": [[1]], "q": [-1], "lower": [2], "upper": [1]}"#)
///         .is_err()
/// );
/// ```
pub fn read_mcp(text: &str) -> Result<ExactMcp, FileError> {
    let raw: RawProblemFile = from_json_of(MCP_FORMAT, text)?;
    let n = raw.q.len();

    let lower = match raw.lower {
        Some(bounds) => exact_bounds(bounds),
        None => vec![Some(whole(0)); n],
    };

    let upper = match raw.upper {
        Some(bounds) => exact_bounds(bounds),
        None => vec![None; n],
    };

    let m = raw.m.into_iter().map(exact).collect();
    Ok(ExactMcp::new(m, exact(raw.q), lower, upper)?)
}

fn exact(numbers: Vec<Number>) -> Vec<Rational> {
    numbers.into_iter().map(|number| number.0).collect()
}

fn exact_bounds(bounds: Vec<Option<Number>>) -> Vec<Option<Rational>> {
    let bounds = bounds.into_iter();
    bounds.map(|bound| bound.map(|number| number.0)).collect()
}

/// A solution file as it stands.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSolutionFile {
    problem_sha256: String,
    z: Vec<Vec<Number>>,
}

/// A solution file: its own certificate, not yet checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct McpCertificate {
    /// Digest of the problem it claims to solve.
    pub problem_sha256: String,
    /// The points, each with one component per unknown.
    pub points: Vec<Vec<Rational>>,
}

/// Solutions as a file: the digest of the problem and the points, as exact fractions.
pub fn write_solution(problem: &ExactMcp, points: &[Vec<Rational>]) -> String {
    let z: Vec<Vec<String>> = points.iter().map(|z| fractions(z)).collect();
    let value = serde_json::json!({
        "format": SOLUTION_FORMAT,
        "problem_sha256": problem.sha256(),
        "z": z,
    });
    format!("{value:#}\n")
}

/// A solution file. Nothing of it is checked here: see [`judge`](super::judge).
///
/// # Errors
/// [`FileError`].
pub fn read_solution(text: &str) -> Result<McpCertificate, FileError> {
    let raw: RawSolutionFile = from_json_of(SOLUTION_FORMAT, text)?;
    Ok(McpCertificate {
        problem_sha256: raw.problem_sha256,
        points: raw.z.into_iter().map(exact).collect(),
    })
}

/// The problem as a file on one line, every bound spelt out; reading it gives the same problem.
pub fn write_mcp(problem: &ExactMcp) -> String {
    let mut m = Vec::new();
    let mut q = Vec::new();
    let mut lower = Vec::new();
    let mut upper = Vec::new();
    for i in 0..problem.dimension() {
        let (row, q_i) = problem.row(i);
        m.push(fractions(row));
        q.push(q_i.to_string());

        let (lower_bound, upper_bound) = problem.bounds(i);
        lower.push(lower_bound.map(ToString::to_string));
        upper.push(upper_bound.map(ToString::to_string));
    }

    let value = serde_json::json!({
        "format": MCP_FORMAT,
        "m": m,
        "q": q,
        "lower": lower,
        "upper": upper,
    });
    value.to_string()
}

/// Exact fractions as text.
fn fractions(list: &[Rational]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lcp::{McpRejected, Violated, judge};
    use mceip_exact::rational;

    #[test]
    fn defaults_round_trip_and_refusals() {
        let problem = read_mcp(
            r#"{"format":"mceip-mcp/1","m":[[2,1],[1,2]],"q":[-5,"-6"],
                "lower":[null,0],"upper":[3,null]}"#,
        )
        .unwrap();
        assert_eq!(problem.bounds(0), (None, Some(&whole(3))));
        assert_eq!(problem.bounds(1), (Some(&whole(0)), None));

        // z = (1, 2) is no solution, z = (4/3, 7/3) is one.
        let text = write_solution(&problem, &[vec![whole(1), whole(2)]]);
        let certificate = read_solution(&text).unwrap();
        assert_eq!(certificate.points, vec![vec![whole(1), whole(2)]]);
        assert!(matches!(
            judge(&problem, &certificate),
            Err(McpRejected::Solution {
                index: 0,
                violated: Violated::Sign { index: 0, .. }
            })
        ));
        let good = McpCertificate {
            points: vec![vec![rational(4, 3), rational(7, 3)]],
            ..certificate.clone()
        };

        assert_eq!(judge(&problem, &good), Ok(1));

        let empty = McpCertificate {
            points: vec![],
            ..certificate
        };

        assert_eq!(judge(&problem, &empty), Err(McpRejected::NoClaims));

        let lcp = read_mcp(r#"{"format":"mceip-mcp/1","m":[[2,1],[1,2]],"q":[-5,-6]}"#).unwrap();
        assert!(matches!(
            judge(&lcp, &good),
            Err(McpRejected::Digest { .. })
        ));

        assert_eq!(read_mcp(&write_mcp(&problem)).unwrap(), problem);
        assert_eq!(read_mcp(&write_mcp(&lcp)).unwrap(), lcp);

        for (bad, message) in [
            (
                r#"{"format":"mceip-mcp/1","m":[[2,1]],"q":[-5,1]}"#,
                "expected m of length 2, got 1",
            ),
            (
                r#"{"format":"mceip-mcp/1","m":[[2,1],[1]],"q":[-5,1]}"#,
                "expected row 1 of m of length 2, got 1",
            ),
            (
                r#"{"format":"mceip-mcp/1","m":[[2]],"q":[-5],"lower":[1],"upper":["1/2"]}"#,
                "expected lower <= upper at 0, got 1 and 1/2",
            ),
            (
                r#"{"format":"mceip-mcp/1","m":[["nan"]],"q":[-5]}"#,
                "expected a decimal or p/q",
            ),
            (r#"{"format":"mceip-problem/1"}"#, "mceip-mcp/1"),
        ] {
            let error = read_mcp(bad).unwrap_err().to_string();
            assert!(
                error.contains(message) && error.lines().count() == 1,
                "{error}"
            );
        }
    }
}
