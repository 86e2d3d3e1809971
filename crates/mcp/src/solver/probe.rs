//! Problems made of closures, for tests.

use crate::mcp::Mcp;
use nalgebra::DMatrix;

/// F and F' as given, between the bounds.
pub(super) struct Probe<F, J> {
    lower: Vec<f64>,
    upper: Vec<f64>,
    function: F,
    jacobian: J,
}

/// A problem with `n` unknowns without bounds.
pub(super) fn free<F: Fn(&[f64], &mut [f64]), J: Fn(&[f64], &mut DMatrix<f64>)>(
    n: usize,
    function: F,
    jacobian: J,
) -> Probe<F, J> {
    let lower = vec![f64::NEG_INFINITY; n];
    let upper = vec![f64::INFINITY; n];
    bounded(&lower, &upper, function, jacobian)
}

/// A problem with bounds.
pub(super) fn bounded<F: Fn(&[f64], &mut [f64]), J: Fn(&[f64], &mut DMatrix<f64>)>(
    lower: &[f64],
    upper: &[f64],
    function: F,
    jacobian: J,
) -> Probe<F, J> {
    Probe {
        lower: lower.to_vec(),
        upper: upper.to_vec(),
        function,
        jacobian,
    }
}

impl<F: Fn(&[f64], &mut [f64]), J: Fn(&[f64], &mut DMatrix<f64>)> Mcp for Probe<F, J> {
    fn dimension(&self) -> usize {
        self.lower.len()
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        (self.function)(z, f);
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        (self.jacobian)(z, j);
    }
}
