//! Options, with PATH's names.

use super::SolverError;

/// Limits and tolerances of a run. Names and defaults are PATH's where it has them.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// A run ends with [`super::Termination::ToleranceReached`] when both the normal-map and the
    /// minimum-map residual (infinity norm, units of F) are below this. PATH: 1e-6; here 1e-10,
    /// because near thresholds 1e-6 accepts points where no solution exists, and because the
    /// digits are free at the end of Newton's method.
    pub convergence_tolerance: f64,
    /// Linearisations in one run. PATH: 500; here 100, failures being cheap to restart.
    pub major_iteration_limit: usize,
    /// Pivots on one path. PATH: 1000.
    pub minor_iteration_limit: usize,
    /// Pivots in one run. PATH: 10000.
    pub cumulative_iteration_limit: usize,
    /// Merit values remembered by the non-monotone test. PATH: 10.
    pub nms_memory_size: usize,
    /// The memory starts at this multiple of the first merit. PATH: 20.
    pub nms_initial_reference_factor: f64,
    /// Entries of one variable into the basis without a new maximum of t that are taken as a
    /// cycle. The lexicographic rule excludes cycles in exact arithmetic; this guards rounding.
    pub cycle_limit: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            convergence_tolerance: 1e-10,
            major_iteration_limit: 100,
            minor_iteration_limit: 1000,
            cumulative_iteration_limit: 10_000,
            nms_memory_size: 10,
            nms_initial_reference_factor: 20.0,
            cycle_limit: 20,
        }
    }
}

impl Options {
    /// Refuses limits of zero and tolerances that are not positive numbers.
    ///
    /// # Errors
    /// [`SolverError::Option`] naming the option.
    pub fn validate(&self) -> Result<(), SolverError> {
        for (name, got) in
            [("convergence_tolerance", self.convergence_tolerance), ("nms_initial_reference_factor", self.nms_initial_reference_factor)]
        {
            if !(got > 0.0 && got.is_finite()) {
                return Err(SolverError::Option { name, got });
            }
        }
        for (name, got) in [
            ("major_iteration_limit", self.major_iteration_limit),
            ("minor_iteration_limit", self.minor_iteration_limit),
            ("cumulative_iteration_limit", self.cumulative_iteration_limit),
            ("nms_memory_size", self.nms_memory_size),
            ("cycle_limit", self.cycle_limit),
        ] {
            if got == 0 {
                return Err(SolverError::Option { name, got: 0.0 });
            }
        }
        Ok(())
    }
}
