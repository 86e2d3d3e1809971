//! The front door of `mceip` for Python: the module `mceip._native`, on which the Python files of
//! `mceip/` stand.
//!
//! A problem comes from a file or from triplets of doubles; answers go back as JSON text, which
//! Python turns into dataclasses. `contact` reads contacts, `loads` bodies under loads, `answers`
//! writes that text, `watched` runs long work on a thread of its own, so that Ctrl-C and progress
//! are attended to. `complementarity` solves plain problems given as functions.

mod answers;
mod complementarity;
mod contact;
mod loads;
mod watched;

use contact::Contacts;
use mceip::{Certificate, Error, Matrix, Problem, Rational, Rejected, Unknown, check};
use mceip_check::certificate::{CriticalCertificate, PresenceCertificate, StabilityCertificate};
use mceip_check::{check_critical, check_presence, check_stability};
use mceip_model::{Body, Coordinates, System};
use mceip_paper::{ContactTable, Plausibility, PlausibilityInput};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::path::PathBuf;
use watched::watched;

pyo3::create_exception!(
    mceip,
    MceipError,
    PyValueError,
    "What was given is no problem of the paper, or a question about it cannot be answered."
);
pyo3::create_exception!(
    mceip,
    RejectedError,
    MceipError,
    "The checker refuses a certificate; the message names the obligation that fails."
);
pyo3::create_exception!(
    mceip,
    NotCertifiedError,
    MceipError,
    "No proof was found for a point; that is no proof that there is no solution."
);

/// Rows, columns and values of the entries of a matrix, counted from 0.
type Triplets = (Vec<usize>, Vec<usize>, Vec<f64>);

/// A mixed complementarity eigenproblem.
#[pyclass(frozen, module = "mceip._native")]
struct NativeProblem(Problem);

#[pymethods]
impl NativeProblem {
    /// Reads a problem file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<NativeProblem> {
        made(py.detach(|| Problem::read(path)))
    }

    /// A problem from the text of a file.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<NativeProblem> {
        made(py.detach(|| Problem::from_json(text)))
    }

    /// MCEIP-lambda2 of a mechanical system with `dofs` degrees of freedom.
    #[staticmethod]
    fn lambda2(
        py: Python<'_>,
        dofs: usize,
        stiffness: Triplets,
        mass: Triplets,
        friction: &str,
        contacts: Contacts,
    ) -> PyResult<NativeProblem> {
        let stiffness = matrix(dofs, stiffness)?;
        let mass = matrix(dofs, mass)?;
        let friction = number("friction", friction)?;
        let table = contacts.table(dofs, Some(&friction))?;

        made(py.detach(|| {
            let particles = table.particles.clone();
            let problem = Problem::from_matrices(stiffness, mass, friction, particles)?;
            let Body::System(system) = problem.as_model().body() else {
                return Ok(problem);
            };
            let warnings = warnings(system, &table, None, None);
            Ok(problem.with_warnings(warnings))
        }))
    }

    /// MCEIP-mu of a mechanical system with `dofs` degrees of freedom.
    #[staticmethod]
    fn friction_threshold(
        py: Python<'_>,
        dofs: usize,
        stiffness: Triplets,
        contacts: Contacts,
    ) -> PyResult<NativeProblem> {
        let stiffness = matrix(dofs, stiffness)?;
        let table = contacts.table(dofs, None)?;

        made(py.detach(|| Problem::friction_threshold(stiffness, table.particles)))
    }

    /// The problem of a pencil A + tB of this order.
    #[staticmethod]
    fn pencil(
        order: usize,
        a: Triplets,
        b: Triplets,
        free: Vec<usize>,
        unknown: &str,
    ) -> PyResult<NativeProblem> {
        let unknown = match unknown {
            "lambda2" => Unknown::Lambda2,
            "mu" => Unknown::Mu,
            other => {
                let message = format!("unknown: expected \"lambda2\" or \"mu\", got {other:?}");
                return Err(MceipError::new_err(message));
            }
        };

        made(Problem::from_pencil(
            matrix(order, a)?,
            matrix(order, b)?,
            free,
            unknown,
        ))
    }

    /// The same problem with the values sought in [min, max], or from min on.
    fn in_window(&self, min: &str, max: Option<&str>) -> PyResult<NativeProblem> {
        let min = number("min", min)?;
        let max = max.map(|max| number("max", max)).transpose()?;

        made(self.0.clone().in_window(min, max))
    }

    fn to_json(&self) -> String {
        self.0.to_json()
    }

    fn sha256(&self) -> String {
        self.0.sha256()
    }

    fn unknown(&self) -> &'static str {
        self.0.unknown().word()
    }

    /// What is given, and how large it is.
    fn kind(&self) -> String {
        match self.0.as_model().body() {
            Body::System(system) => format!(
                "a system, degrees of freedom: {}, contacts: {}",
                system.dofs(),
                system.particles().len()
            ),
            Body::Pencil(pencil) => format!("a pencil of order {}", pencil.order()),
        }
    }

    /// What looked wrong when the problem was made.
    fn warnings(&self) -> Vec<String> {
        self.0.warnings().to_vec()
    }

    /// The same problem with no warning.
    fn without_warnings(&self) -> NativeProblem {
        NativeProblem(self.0.clone().with_warnings(Vec::new()))
    }

    /// Solutions by the PATH-style solver.
    fn solve(
        &self,
        py: Python<'_>,
        starts: usize,
        seed: u64,
        all: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let found = watched(py, progress.as_ref(), |cancel, hear| {
            let mut search = self.0.solve().starts(starts).seed(seed);
            if all {
                search = search.all();
            }
            search.cancel(cancel).on_progress(hear).run()
        })?;

        let found = found.map_err(refused)?;
        Ok(answers::found(&found).to_string())
    }

    /// All solutions in the window; with `part` = (k, n) those in part k of n, counted from 0, and
    /// the others open.
    fn complete(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        earlier: Option<&str>,
        part: Option<(usize, usize)>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let earlier = earlier.map(certificate).transpose()?;

        let all = watched(py, progress.as_ref(), |cancel, hear| {
            let mut search = self.0.complete();
            if let Some(threads) = threads {
                search = search.threads(threads);
            }
            if let Some(earlier) = &earlier {
                search = search.resume(earlier);
            }
            if let Some((index, count)) = part {
                search = search.part(index, count);
            }
            search.cancel(cancel).on_progress(hear).run()
        })?;

        let all = all.map_err(refused)?;
        Ok(answers::solution_set(&all).to_string())
    }

    /// What the certificates of the parts of one search prove together.
    fn merge(&self, py: Python<'_>, parts: Vec<String>) -> PyResult<String> {
        let parts = parts.iter().map(|part| certificate(part));
        let parts = parts.collect::<PyResult<Vec<_>>>()?;
        let merged = py.detach(|| self.0.merge(&parts)).map_err(refused)?;
        Ok(answers::solution_set(&merged).to_string())
    }

    /// The engineer's answer.
    fn analyze(
        &self,
        py: Python<'_>,
        friction: Option<&str>,
        samples: usize,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let friction = friction.map(|mu| number("friction", mu)).transpose()?;

        let analysis = watched(py, progress.as_ref(), |cancel, hear| {
            let mut question = self.0.analyze().samples(samples);
            if let Some(friction) = friction {
                question = question.friction(friction);
            }
            if let Some(threads) = threads {
                question = question.threads(threads);
            }
            question.cancel(cancel).on_progress(hear).run()
        })?;

        let analysis = analysis.map_err(refused)?;
        let answer = answers::analysis(&analysis).map_err(|e| refused(e.into()))?;
        Ok(answer.to_string())
    }

    /// A proof for a point in doubles.
    fn certify(&self, py: Python<'_>, value: f64, x: Vec<f64>) -> PyResult<String> {
        let certified = py.detach(|| self.0.certify(value, &x));
        Ok(answers::certified(&certified.map_err(refused)?).to_string())
    }

    /// The verdict of the checker on `mceip-certificate/1`.
    fn check(&self, py: Python<'_>, text: &str) -> PyResult<String> {
        let certificate = certificate(text)?;
        let verdict = py.detach(|| check(&self.0, &certificate));
        let accepted = verdict.map_err(|rejected| rejection(&rejected))?;
        Ok(answers::accepted(&accepted).to_string())
    }

    /// The verdict of the checker on `mceip-critical/1`: the smallest and the largest friction
    /// coefficient of which absence is proved, and the number of leaves that prove it.
    fn check_absence(&self, py: Python<'_>, text: &str) -> PyResult<(String, String, usize)> {
        let read = CriticalCertificate::from_json(text);
        let certificate = read.map_err(|e| MceipError::new_err(e.to_string()))?;

        let verdict = py.detach(|| check_critical(self.0.as_model(), &certificate));
        let accepted = verdict.map_err(|rejected| rejection(&rejected))?;
        let from = accepted.from.to_string();
        let below = accepted.below.to_string();
        Ok((from, below, accepted.leaves))
    }

    /// The verdict of the checker on `mceip-presence/1`: the smallest and the largest friction
    /// coefficient of which presence is proved, and the number of pieces that prove it.
    fn check_presence(&self, py: Python<'_>, text: &str) -> PyResult<(String, String, usize)> {
        let read = PresenceCertificate::from_json(text);
        let certificate = read.map_err(|e| MceipError::new_err(e.to_string()))?;

        let verdict = py.detach(|| check_presence(self.0.as_model(), &certificate));
        let accepted = verdict.map_err(|rejected| rejection(&rejected))?;
        let from = accepted.from.to_string();
        let to = accepted.to.to_string();
        Ok((from, to, accepted.pieces))
    }

    /// The verdict of the checker on `mceip-stability/1`: the smallest and the largest friction
    /// coefficient of which stability is proved, and whether of every motion.
    fn check_stability(&self, py: Python<'_>, text: &str) -> PyResult<(String, String, bool)> {
        let read = StabilityCertificate::from_json(text);
        let certificate = read.map_err(|e| MceipError::new_err(e.to_string()))?;

        let verdict = py.detach(|| check_stability(self.0.as_model(), &certificate));
        let accepted = verdict.map_err(|rejected| rejection(&rejected))?;
        let from = accepted.from.to_string();
        let to = accepted.to.to_string();
        Ok((from, to, accepted.is_of_every_motion))
    }
}

/// What `mceip convert` warns of in such a model.
pub(crate) fn warnings(
    system: &System,
    table: &ContactTable,
    dof_names: Option<&HashMap<String, usize>>,
    coordinates: Option<&Coordinates>,
) -> Vec<String> {
    let plausibility = Plausibility::new(&PlausibilityInput {
        system,
        // K may be that of a body without the dofs that are held, whose rows say nothing.
        rows_alone: &[],
        places: None,
        reactions: &table.reactions,
        asks_for_reactions: false,
        displacements: None,
        coordinates,
        dof_names,
    });
    plausibility.warnings
}

/// A problem of the front door as Python holds it.
fn made(problem: Result<Problem, Error>) -> PyResult<NativeProblem> {
    problem.map(NativeProblem).map_err(refused)
}

fn matrix(order: usize, (rows, columns, values): Triplets) -> PyResult<Matrix> {
    let places = rows.into_iter().zip(columns);
    let entries = places.zip(values).map(|((i, j), value)| (i, j, value));
    Matrix::from_triplets(order, order, entries).map_err(refused)
}

/// A decimal or a fraction, exactly what it spells.
fn number(name: &str, text: &str) -> PyResult<Rational> {
    let expected = |_| {
        MceipError::new_err(format!(
            "{name}: expected a number like 0.5, 1e-3 or 1/3, got {text:?}"
        ))
    };
    text.parse().map_err(expected)
}

fn certificate(text: &str) -> PyResult<Certificate> {
    Certificate::from_json(text).map_err(|e| MceipError::new_err(e.to_string()))
}

fn refused(error: Error) -> PyErr {
    match &error {
        Error::Rejected(rejected) => rejection(rejected),
        Error::NotCertified(_) => NotCertifiedError::new_err(error.to_string()),
        _ => MceipError::new_err(error.to_string()),
    }
}

fn rejection(rejected: &Rejected) -> PyErr {
    RejectedError::new_err(rejected.to_string())
}

/// `mceip._native`.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add_class::<NativeProblem>()?;
    module.add_class::<loads::NativeLoads>()?;
    module.add_class::<loads::NativeLoadPath>()?;
    module.add_function(wrap_pyfunction!(complementarity::solve_mcp, module)?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("MceipError", py.get_type::<MceipError>())?;
    module.add("RejectedError", py.get_type::<RejectedError>())?;
    module.add("NotCertifiedError", py.get_type::<NotCertifiedError>())
}
