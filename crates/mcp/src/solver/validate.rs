//! Refusals: options, shapes, bounds and starts that make no sense.

use super::error::SolverError;
use super::options::Options;
use crate::mcp::{Mcp, McpError, check_bounds};

/// Refuses options, shapes, bounds and starts that make no sense.
pub(super) fn validate<P: Mcp + ?Sized>(
    problem: &P,
    start: &[f64],
    options: &Options,
) -> Result<(), SolverError> {
    options.validate()?;
    let n = problem.dimension();
    for (what, got) in [
        ("lower", problem.lower().len()),
        ("upper", problem.upper().len()),
    ] {
        if got != n {
            return Err(McpError::Shape {
                what,
                expected: n,
                got,
            }
            .into());
        }
    }
    check_bounds(problem.lower(), problem.upper())?;
    if start.len() != n {
        return Err(SolverError::StartLength {
            expected: n,
            got: start.len(),
        });
    }
    if let Some(index) = start.iter().position(|v| !v.is_finite()) {
        return Err(SolverError::StartNotFinite {
            index,
            got: start[index],
        });
    }
    Ok(())
}
