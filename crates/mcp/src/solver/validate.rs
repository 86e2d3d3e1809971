//! Refusals: options, shapes, bounds and starts that make no sense.
//!
//! Called at the beginning of every run and curve; what follows relies on it: options are in range,
//! bounds and start have length n, bounds are ordered, the start is finite.

use super::error::SolverError;
use super::options::Options;
use crate::mcp::{Mcp, check_bounds, check_length};

/// Refuses options, shapes, bounds and starts that make no sense.
///
/// # Errors
/// [`SolverError`] naming the option, part or index, what was expected and what was got.
pub(super) fn validate<P: Mcp + ?Sized>(
    problem: &P,
    start: &[f64],
    options: &Options,
) -> Result<(), SolverError> {
    options.validate()?;
    check_shapes(problem, start)
}

/// Refuses shapes, bounds and a start that make no sense.
fn check_shapes<P: Mcp + ?Sized>(problem: &P, start: &[f64]) -> Result<(), SolverError> {
    let n = problem.dimension();
    check_length("lower", n, problem.lower().len())?;
    check_length("upper", n, problem.upper().len())?;
    check_bounds(problem.lower(), problem.upper())?;

    check_start(n, start)
}

/// Refuses shapes and bounds that make no sense, and a point that does not lie within the bounds.
///
/// # Errors
/// [`SolverError`] naming the part or index, what was expected and what was got.
pub(crate) fn check_point<P: Mcp + ?Sized>(problem: &P, point: &[f64]) -> Result<(), SolverError> {
    check_shapes(problem, point)?;

    let bounds = problem.lower().iter().zip(problem.upper());
    for (index, (&got, (&lower, &upper))) in point.iter().zip(bounds).enumerate() {
        if got < lower || got > upper {
            return Err(SolverError::StartOutside {
                index,
                lower,
                upper,
                got,
            });
        }
    }
    Ok(())
}

/// Refuses a start of another length than n, or one that is not finite.
fn check_start(n: usize, start: &[f64]) -> Result<(), SolverError> {
    if start.len() != n {
        return Err(SolverError::StartLength {
            expected: n,
            got: start.len(),
        });
    }

    match start.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SolverError::StartNotFinite {
            index,
            got: start[index],
        }),
        None => Ok(()),
    }
}
