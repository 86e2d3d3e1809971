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
use mceip::analysis::AnalysisError;
use mceip::{Certificate, Error, LEAN_FORMAT, Matrix, Problem, Rational, Rejected, Unknown};
use mceip_check::Provable;
use mceip_check::certificate::{
    CRITICAL_FORMAT, CriticalCertificate, PRESENCE_FORMAT, PresenceCertificate, STABILITY_FORMAT,
    StabilityCertificate,
};
use mceip_model::file::require_format;
use mceip_model::{Body, ModelError, Radii, Window};
use mceip_paper::{
    Asymmetry, ContactTable, Plausibility, PlausibilityInput, asymmetry, rows_alone,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
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

    /// MCEIP-lambda2 of a mechanical system with `dofs` degrees of freedom; `radii` are those of K
    /// and M.
    #[staticmethod]
    fn lambda2(
        py: Python<'_>,
        dofs: usize,
        stiffness: Triplets,
        mass: Triplets,
        friction: &str,
        contacts: Contacts,
        radii: (Option<Triplets>, Option<Triplets>),
    ) -> PyResult<NativeProblem> {
        let stiffness = symmetric("stiffness", dofs, stiffness)?;
        let mass = symmetric("mass", dofs, mass)?;
        let friction = number("friction", friction)?;
        let table = contacts.table(dofs, Some(&friction))?;
        let radius = |name, triplets: Option<Triplets>| {
            let radius = triplets.map(|triplets| matrix(name, dofs, triplets));
            Ok::<_, PyErr>(radius.transpose()?.map(Matrix::into_exact))
        };
        let radii = Radii {
            stiffness: radius("stiffness_radius", radii.0)?,
            mass: radius("mass_radius", radii.1)?,
        };

        made(py.detach(|| {
            let particles = table.particles.clone();
            let problem = Problem::from_matrices(stiffness, mass, friction, particles)?;
            let Body::System(system) = problem.as_model().body() else {
                return Ok(problem);
            };
            let body = Body::System(system.clone().with_radii(radii)?);
            let problem = mceip_model::Problem::new(body, Unknown::Lambda2, Window::all())?;
            Ok(looked_at(problem.into(), &table, true))
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
        let stiffness = symmetric("stiffness", dofs, stiffness)?;
        let table = contacts.table(dofs, None)?;

        made(py.detach(|| {
            let problem = Problem::friction_threshold(stiffness, table.particles.clone())?;
            Ok(looked_at(problem, &table, false))
        }))
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
            "eigenvalue" => Unknown::Eigenvalue,
            other => {
                let expected = "\"lambda2\", \"mu\" or \"eigenvalue\"";
                let message = format!("unknown: expected {expected}, got {other:?}");
                return Err(MceipError::new_err(message));
            }
        };

        made(Problem::from_pencil(
            matrix("a", order, a)?,
            matrix("b", order, b)?,
            free,
            unknown,
        ))
    }

    /// The quadratic eigenvalue complementarity problem of t^2 A + tB + C of this order.
    #[staticmethod]
    fn qeicp(order: usize, a: Triplets, b: Triplets, c: Triplets) -> PyResult<NativeProblem> {
        made(Problem::qeicp(
            matrix("a", order, a)?,
            matrix("b", order, b)?,
            matrix("c", order, c)?,
        ))
    }

    /// The same problem with the values sought in [min, max]; `None` is no end.
    fn in_window(&self, min: Option<&str>, max: Option<&str>) -> PyResult<NativeProblem> {
        let min = min.map(|min| number("min", min)).transpose()?;
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
            Body::Quadratic(quadratic) => {
                format!("a quadratic pencil of order {}", quadratic.order())
            }
        }
    }

    /// The friction of a system, as a fraction, if its problem is about one.
    fn friction(&self) -> Option<String> {
        match self.0.as_model().body() {
            Body::System(system) => system.friction().map(Rational::to_string),
            Body::Pencil(_) | Body::Quadratic(_) => None,
        }
    }

    /// Where values are sought, as text.
    fn window(&self) -> String {
        self.0.as_model().real_window().to_string()
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

    /// The verdict of the checker on a certificate about this problem, whatever its kind.
    fn check(&self, py: Python<'_>, text: &str) -> PyResult<String> {
        let full;
        let text = if require_format(text, LEAN_FORMAT).is_ok() {
            full = py.detach(|| self.0.elaborate(text)).map_err(refused)?;
            &full
        } else {
            text
        };
        let is = |format| require_format(text, format).is_ok();

        let accepted = if is(CRITICAL_FORMAT) {
            answers::absence(&self.accepted::<CriticalCertificate>(py, text)?)
        } else if is(PRESENCE_FORMAT) {
            answers::presence(&self.accepted::<PresenceCertificate>(py, text)?)
        } else if is(STABILITY_FORMAT) {
            answers::stability(&self.accepted::<StabilityCertificate>(py, text)?)
        } else {
            let windows = certificate(text)?.windows();
            answers::accepted(&self.accepted::<Certificate>(py, text)?, &windows)
        };
        Ok(accepted.to_string())
    }
}

impl NativeProblem {
    /// What an accepted certificate of this kind has proved.
    fn accepted<C>(&self, py: Python<'_>, text: &str) -> PyResult<C::Accepted>
    where
        C: Provable<Subject = mceip_model::Problem> + Sync,
        C::Accepted: Send,
    {
        let certificate = C::read(text).map_err(|e| MceipError::new_err(e.to_string()))?;
        let verdict = py.detach(|| certificate.check(self.0.as_model()));
        verdict.map_err(|rejected| rejection(&rejected))
    }
}

/// A problem of the front door as Python holds it.
fn made(problem: Result<Problem, Error>) -> PyResult<NativeProblem> {
    problem.map(NativeProblem).map_err(refused)
}

/// A matrix; what is refused begins with its name.
fn matrix(name: &str, order: usize, (rows, columns, values): Triplets) -> PyResult<Matrix> {
    let places = rows.into_iter().zip(columns);
    let entries = places.zip(values).map(|((i, j), value)| (i, j, value));
    let made = Matrix::from_triplets(order, order, entries);
    made.map_err(|error| MceipError::new_err(format!("{name}: {error}")))
}

/// A matrix that is symmetric, or else so far from it that `System` says where.
fn symmetric(name: &str, order: usize, triplets: Triplets) -> PyResult<Matrix> {
    let matrix = matrix(name, order, triplets)?.into_exact();
    if asymmetry(&matrix) == Asymmetry::Rounding {
        return Err(MceipError::new_err(format!(
            "{name}: expected a matrix that is symmetric to the last bit, got one that is so up \
             to rounding: (A + A.T) / 2 of it is"
        )));
    }
    Ok(matrix.into())
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
        Error::Lean(_) => RejectedError::new_err(error.to_string()),
        Error::NotCertified(why) if !why.is_no_candidate() => {
            NotCertifiedError::new_err(error.to_string())
        }
        _ => MceipError::new_err(message(&error)),
    }
}

/// Why there is no answer, with arguments of Python where the program names options.
fn message(error: &Error) -> String {
    match error {
        Error::NoFriction => "friction: expected a number (`friction=...`), got None".into(),
        Error::Analyze(AnalysisError::NoMass) => {
            "E3: expected a mass, got None (`Problem.from_matrices`, `Body` take `mass`): growth in \
             time needs K, M and mu; the mu of lambda = 0 alone needs no mass (`Problem.complete` \
             of `Problem.friction_threshold`)"
                .into()
        }
        Error::Model(ModelError::FrictionNotPositive { particle, friction }) => format!(
            "E7: expected friction > 0 where contacts slip (contact {particle}), got {friction}: \
             without friction nothing is in impending slip; `Problem.analyze(friction=0)` asks \
             for flat obstacles without friction"
        ),
        _ => error.to_string(),
    }
}

/// The problem of a system with warnings of what looks wrong in it; `asks_for_reactions` as in
/// [`PlausibilityInput`].
fn looked_at(problem: Problem, table: &ContactTable, asks_for_reactions: bool) -> Problem {
    let Body::System(system) = problem.as_model().body() else {
        return problem;
    };

    let found = Plausibility::new(&PlausibilityInput {
        system,
        rows_alone: &rows_alone(system.stiffness()),
        places: None,
        reactions: &table.reactions,
        asks_for_reactions,
        displacements: None,
        coordinates: None,
        dof_names: None,
    });
    problem.with_warnings(found.warnings)
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
