//! Mixed complementarity problems whose F and F' are Python functions.
//!
//! Vectors go to Python as lists of floats; values come back as the bytes of doubles, a sparse
//! matrix as triplets. The interpreter's lock is held all along. The first exception of a function
//! is kept: from then on F is no number, nothing is called any more, and at the end of the run,
//! which is near, the exception goes on to the caller.

use crate::{MceipError, Triplets};
use mceip_mcp::mcp::{JacobianError, Mcp, check_jacobian, difference_jacobian};
use mceip_mcp::nalgebra::DMatrix;
use mceip_mcp::solver::{Options, solve};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use std::cell::{Cell, RefCell};

/// F' as Python gives it: the bytes of a dense matrix, column by column, or triplets.
#[derive(FromPyObject)]
enum GivenJacobian {
    Dense(PyBackedBytes),
    Sparse(Triplets),
}

/// F, F' and bounds.
struct PythonMcp<'py> {
    function: Bound<'py, PyAny>,
    jacobian: Option<Bound<'py, PyAny>>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The first exception of a function.
    raised: RefCell<Option<PyErr>>,
    /// A dense F' that was met where entries were asked for, for the question that follows.
    kept: RefCell<Option<Vec<f64>>>,
    calls: Cell<usize>,
}

/// The doubles of these bytes.
fn doubles(bytes: &[u8]) -> Vec<f64> {
    let (chunks, _) = bytes.as_chunks::<8>();
    chunks
        .iter()
        .map(|chunk| f64::from_ne_bytes(*chunk))
        .collect()
}

impl<'py> PythonMcp<'py> {
    /// The result of a call, or `None` where a function has raised.
    fn called<T>(&self, call: impl FnOnce() -> PyResult<T>) -> Option<T> {
        if self.raised.borrow().is_some() {
            return None;
        }

        match call() {
            Ok(result) => Some(result),
            Err(error) => {
                *self.raised.borrow_mut() = Some(error);
                None
            }
        }
    }

    /// F'(z) as Python gives it; `None` where there is no function, or it has raised.
    fn given(&self, z: &[f64]) -> Option<GivenJacobian> {
        let jacobian = self.jacobian.as_ref()?;
        self.called(|| {
            let given = jacobian.call1((z.to_vec(),))?;
            given.extract::<GivenJacobian>()
        })
    }

    /// The exception of a function, if one was raised.
    fn check_raised(&self) -> PyResult<()> {
        match self.raised.borrow_mut().take() {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }
}

impl Mcp for PythonMcp<'_> {
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
        self.calls.set(self.calls.get() + 1);
        let called = self.called(|| {
            let bytes = self.function.call1((z.to_vec(),))?;
            Ok(bytes.extract::<PyBackedBytes>()?)
        });
        match called.map(|bytes| doubles(&bytes)) {
            Some(values) if values.len() == f.len() => f.copy_from_slice(&values),
            _ => f.fill(f64::NAN),
        }
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        if self.jacobian.is_none() {
            return difference_jacobian(self, z, j);
        }

        let kept = self.kept.borrow_mut().take();
        let values = kept.or_else(|| match self.given(z)? {
            GivenJacobian::Dense(bytes) => Some(doubles(&bytes)),
            GivenJacobian::Sparse((rows, cols, values)) => {
                let n = z.len();
                let mut dense = vec![0.0; n * n];
                for ((row, col), value) in rows.into_iter().zip(cols).zip(values) {
                    *dense.get_mut(col * n + row)? += value;
                }
                Some(dense)
            }
        });
        match values {
            Some(values) if values.len() == j.len() => j.copy_from_slice(&values),
            _ => j.fill(f64::NAN),
        }
    }
    fn entries(&self, z: &[f64], entries: &mut Vec<(usize, usize, f64)>) -> bool {
        self.kept.borrow_mut().take();
        match self.given(z) {
            Some(GivenJacobian::Sparse((rows, cols, values))) => {
                let places = rows.into_iter().zip(cols);
                entries.extend(places.zip(values).map(|((row, col), v)| (row, col, v)));
                true
            }
            Some(GivenJacobian::Dense(bytes)) => {
                *self.kept.borrow_mut() = Some(doubles(&bytes));
                false
            }
            None => false,
        }
    }
}

/// The end of a run: the point, F there, the five residuals, whether they are within the
/// tolerance, the reason why it stopped, and the counts of steps, values of F, Jacobians,
/// factorisations and pivots.
type EndOfRun = (Vec<f64>, Vec<f64>, Vec<f64>, bool, String, [usize; 5]);

/// Solves MCP(F, l, u) from a start; with `check`, F' is held against finite differences there
/// first.
#[pyfunction]
#[allow(
    clippy::too_many_arguments,
    reason = "the interface to Python, by position"
)]
pub(crate) fn solve_mcp<'py>(
    function: Bound<'py, PyAny>,
    jacobian: Option<Bound<'py, PyAny>>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    start: Vec<f64>,
    tolerance: Option<f64>,
    check: bool,
) -> PyResult<EndOfRun> {
    let problem = PythonMcp {
        function,
        jacobian,
        lower,
        upper,
        raised: RefCell::default(),
        kept: RefCell::default(),
        calls: Cell::new(0),
    };
    let mut options = Options::default();
    if let Some(tolerance) = tolerance {
        options.convergence_tolerance = tolerance;
    }

    if check {
        let agreement = check_jacobian(&problem, &start);
        problem.check_raised()?;
        agreement.map_err(|error: JacobianError| MceipError::new_err(error.to_string()))?;
    }

    let outcome = solve(&problem, &start, &options);
    problem.check_raised()?;
    let outcome = outcome.map_err(|error| MceipError::new_err(error.to_string()))?;
    let calls = problem.calls.get();

    let mut f = vec![0.0; outcome.point.len()];
    problem.function(&outcome.point, &mut f);
    problem.check_raised()?;

    let residuals = &outcome.residuals;
    let counters = &outcome.counters;
    Ok((
        outcome.point,
        f,
        vec![
            residuals.complementarity,
            residuals.normal_map,
            residuals.minimum_map,
            residuals.fischer,
            residuals.fischer_gradient,
        ],
        outcome.termination.reached_tolerance(),
        outcome.termination.to_string(),
        [
            counters.crash_steps + counters.majors,
            calls,
            counters.jacobians,
            counters.factorisations,
            counters.pivots,
        ],
    ))
}
