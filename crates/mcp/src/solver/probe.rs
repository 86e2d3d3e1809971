//! Problems made of closures that give a dense Jacobian, for tests.

use crate::mcp::FunctionMcp;
use nalgebra::DMatrix;

/// A problem with `n` unknowns without bounds.
pub(super) fn free<'a>(
    n: usize,
    function: impl Fn(&[f64], &mut [f64]) + 'a,
    jacobian: impl Fn(&[f64], &mut DMatrix<f64>) + 'a,
) -> FunctionMcp<'a> {
    let lower = vec![f64::NEG_INFINITY; n];
    let upper = vec![f64::INFINITY; n];
    bounded(&lower, &upper, function, jacobian)
}

/// A problem with bounds.
pub(super) fn bounded<'a>(
    lower: &[f64],
    upper: &[f64],
    function: impl Fn(&[f64], &mut [f64]) + 'a,
    jacobian: impl Fn(&[f64], &mut DMatrix<f64>) + 'a,
) -> FunctionMcp<'a> {
    FunctionMcp::new(lower.to_vec(), upper.to_vec(), function).with_jacobian(jacobian)
}
