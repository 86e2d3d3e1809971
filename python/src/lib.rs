//! The front door of `mceip` for Python: the module `mceip._native`, on which `mceip/__init__.py`
//! stands.
//!
//! A problem comes from a file or from triplets of doubles; answers go back as JSON text, which
//! Python turns into dataclasses. `answers` writes that text, `watched` runs long work on a thread
//! of its own, so that Ctrl-C and progress are attended to.

mod answers;
mod watched;

use mceip::{
    Certificate, ContactState, Error, Matrix, Particle, Problem, Rational, Rejected, Unknown, check,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::PathBuf;
use watched::watched;

pyo3::create_exception!(
    _native,
    MceipError,
    PyValueError,
    "What was given is no problem of the paper, or a question about it cannot be answered."
);
pyo3::create_exception!(
    _native,
    RejectedError,
    MceipError,
    "The checker refuses a certificate; the message names the obligation that fails."
);
pyo3::create_exception!(
    _native,
    NotCertifiedError,
    MceipError,
    "No proof was found for a point; that is no proof that there is no solution."
);

/// Rows, columns and values of a matrix, counted from 0.
type Triplets = (Vec<usize>, Vec<usize>, Vec<f64>);

/// What is read of a contact of Python.
#[derive(FromPyObject)]
struct Contact {
    tangential: usize,
    normal: usize,
    state: String,
    sign: Option<i8>,
    normal_direction: i8,
    frame: Option<[[String; 2]; 2]>,
}

/// A mixed complementarity eigenproblem.
#[pyclass(frozen, module = "mceip._native")]
struct NativeProblem(Problem);

#[pymethods]
impl NativeProblem {
    /// Reads a problem file.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<NativeProblem> {
        Problem::read(path).map(NativeProblem).map_err(refused)
    }

    /// A problem from the text of a file.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<NativeProblem> {
        Problem::from_json(text).map(NativeProblem).map_err(refused)
    }

    /// MCEIP-lambda2 of a mechanical system with `dofs` degrees of freedom.
    #[staticmethod]
    fn lambda2(
        dofs: usize,
        stiffness: Triplets,
        mass: Triplets,
        friction: &str,
        contacts: Vec<Contact>,
    ) -> PyResult<NativeProblem> {
        let stiffness = matrix(dofs, stiffness)?;
        let mass = matrix(dofs, mass)?;
        let friction = number("friction", friction)?;
        let contacts = particles(contacts)?;

        Problem::from_matrices(stiffness, mass, friction, contacts)
            .map(NativeProblem)
            .map_err(refused)
    }

    /// MCEIP-mu of a mechanical system with `dofs` degrees of freedom.
    #[staticmethod]
    fn friction_threshold(
        dofs: usize,
        stiffness: Triplets,
        contacts: Vec<Contact>,
    ) -> PyResult<NativeProblem> {
        let stiffness = matrix(dofs, stiffness)?;
        let contacts = particles(contacts)?;

        Problem::friction_threshold(stiffness, contacts)
            .map(NativeProblem)
            .map_err(refused)
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

        Problem::from_pencil(matrix(order, a)?, matrix(order, b)?, free, unknown)
            .map(NativeProblem)
            .map_err(refused)
    }

    /// The same problem with the values sought in [min, max], or from min on.
    fn in_window(&self, min: &str, max: Option<&str>) -> PyResult<NativeProblem> {
        let min = number("min", min)?;
        let max = max.map(|max| number("max", max)).transpose()?;

        let problem = self.0.clone().in_window(min, max);
        problem.map(NativeProblem).map_err(refused)
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

    /// All solutions in the window.
    fn complete(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        earlier: Option<&str>,
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
            search.cancel(cancel).on_progress(hear).run()
        })?;

        let all = all.map_err(refused)?;
        Ok(answers::solution_set(&all).to_string())
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
        Ok(answers::analysis(&analysis).to_string())
    }

    /// A proof for a point in doubles.
    fn certify(&self, value: f64, x: Vec<f64>) -> PyResult<String> {
        let certified = self.0.certify(value, &x).map_err(refused)?;
        Ok(answers::certified(&certified).to_string())
    }

    /// The verdict of the checker.
    fn check(&self, text: &str) -> PyResult<String> {
        let certificate = certificate(text)?;
        let accepted = check(&self.0, &certificate).map_err(|rejected| rejection(&rejected))?;
        Ok(answers::accepted(&accepted).to_string())
    }
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

fn particles(contacts: Vec<Contact>) -> PyResult<Vec<Particle>> {
    contacts.into_iter().enumerate().map(particle).collect()
}

fn particle((index, contact): (usize, Contact)) -> PyResult<Particle> {
    let state = match (contact.state.as_str(), contact.sign) {
        ("slip", Some(sign)) => ContactState::Slip { sign },
        ("stick", None) => ContactState::Stick,
        ("free", None) => ContactState::Free,
        (state, sign) => {
            return Err(MceipError::new_err(format!(
                "contact {index}: expected \"slip\" with a sign, \"stick\" or \"free\" without \
                 one, got {state:?} with the sign {sign:?}"
            )));
        }
    };

    let mut particle = Particle::plain(contact.tangential, contact.normal, state);
    particle.normal_direction = contact.normal_direction;
    if let Some([[a, b], [c, d]]) = contact.frame {
        let entry = |text: &str| number("frame", text);
        particle.frame = Some([[entry(&a)?, entry(&b)?], [entry(&c)?, entry(&d)?]]);
    }
    Ok(particle)
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
    module.add("MceipError", py.get_type::<MceipError>())?;
    module.add("RejectedError", py.get_type::<RejectedError>())?;
    module.add("NotCertifiedError", py.get_type::<NotCertifiedError>())
}
