//! Bodies under loads, and the paths that the loads lead them along.

use crate::contact::Contacts;
use crate::watched::watched;
use crate::{MceipError, NativeProblem, NotCertifiedError, Triplets};
use crate::{number, refused, rejection, symmetric};
use mceip::{Error, FrictionGrid, FrictionGridError, LoadPath, Loads, Rational};
use mceip_check::certificate::EquilibriumCertificate;
use mceip_check::check_equilibrium;
use mceip_model::file::LoadsFile;
use mceip_model::{BodyNode, ContactCandidate, Coordinates, LoadStep, LoadedBody, LoadedParts};
use mceip_paper::{Plausibility, PlausibilityInput, rows_alone};
use pyo3::prelude::*;

/// Places of nodes as text, their degrees of freedom along x and y, and edges between them.
type Mesh = (Vec<[String; 2]>, Vec<[Option<usize>; 2]>, Vec<[usize; 2]>);

/// Values at degrees of freedom, as text.
type Values = Vec<(usize, String)>;

/// What is read of a `mceip.Step`.
#[derive(FromPyObject)]
pub(crate) struct Step {
    name: String,
    forces: Values,
    displacements: Values,
    endless: bool,
}

/// A body under loads.
#[pyclass(frozen, module = "mceip._native")]
pub(crate) struct NativeLoads(Loads);

#[pymethods]
impl NativeLoads {
    /// A body with `dofs` degrees of freedom, its candidates with their gaps, and the steps.
    #[staticmethod]
    #[allow(
        clippy::too_many_arguments,
        reason = "the fields of a file, one by one"
    )]
    fn made(
        dofs: usize,
        stiffness: Triplets,
        mass: Option<Triplets>,
        candidates: Contacts,
        gaps: Vec<String>,
        held: Vec<usize>,
        steps: Vec<Step>,
        friction: &str,
        mesh: Option<Mesh>,
        accept_warnings: bool,
    ) -> PyResult<NativeLoads> {
        let mass = mass.map(|mass| symmetric("mass", dofs, mass)).transpose()?;
        let table = candidates.table(dofs, None)?;
        let gaps = gaps.iter().map(|gap| number("gap", gap));
        let gaps: Vec<Rational> = gaps.collect::<PyResult<_>>()?;
        let candidates = table.particles.iter().cloned().zip(gaps);
        let steps = steps.into_iter().map(step).collect::<PyResult<_>>()?;

        let stiffness = symmetric("stiffness", dofs, stiffness)?.into_exact();
        let alone = rows_alone(&stiffness);
        let body = LoadedBody::new(LoadedParts {
            stiffness,
            mass: mass.map(mceip::Matrix::into_exact),
            friction: Some(number("friction", friction)?),
            candidates: candidates
                .map(|(particle, gap)| ContactCandidate { particle, gap })
                .collect(),
            held,
            steps,
        });
        let body = body.map_err(|e| refused(e.into()))?;

        let coordinates = mesh.map(|mesh| coordinates(mesh, &body)).transpose()?;

        let warnings = if accept_warnings {
            Vec::new()
        } else {
            let looked_at = Plausibility::new(&PlausibilityInput {
                system: body.system(),
                rows_alone: &alone,
                places: Some(body.places()),
                reactions: &table.reactions,
                asks_for_reactions: false,
                displacements: None,
                coordinates: coordinates.as_ref(),
                dof_names: None,
            });
            looked_at.warnings
        };
        Ok(NativeLoads(Loads::from(LoadsFile {
            name: None,
            comment: None,
            warnings,
            body,
            coordinates,
        })))
    }

    /// What looks wrong in the body.
    fn warnings(&self) -> Vec<String> {
        self.0.as_file().warnings.clone()
    }

    /// The path; `None` if it was interrupted before it begins.
    fn path(
        &self,
        py: Python<'_>,
        in_doubles: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Option<NativeLoadPath>> {
        let path = watched(py, progress.as_ref(), |cancel, hear| {
            let question = self.0.path().in_doubles(in_doubles);
            question.cancel(cancel).on_progress(hear).run()
        })?;
        Ok(path.map_err(refused)?.map(NativeLoadPath))
    }
}

/// The nodes, with the degrees of freedom of the given matrices.
fn coordinates((points, dofs, edges): Mesh, body: &LoadedBody) -> PyResult<Coordinates> {
    let mut nodes = Vec::with_capacity(points.len());
    for ([x, y], dofs) in points.into_iter().zip(dofs) {
        nodes.push(BodyNode {
            dofs,
            place: [number("mesh", &x)?, number("mesh", &y)?],
        });
    }
    Coordinates::under_loads(nodes, edges, body).map_err(|e| refused(e.into()))
}

fn step(step: Step) -> PyResult<LoadStep> {
    let values = |values: Values| -> PyResult<Vec<(usize, Rational)>> {
        let values = values.into_iter();
        values
            .map(|(dof, value)| Ok((dof, number("step", &value)?)))
            .collect()
    };

    Ok(LoadStep {
        name: step.name,
        forces: values(step.forces)?,
        displacements: values(step.displacements)?,
        is_endless: step.endless,
    })
}

/// A path that was followed.
#[pyclass(frozen, module = "mceip._native")]
pub(crate) struct NativeLoadPath(LoadPath);

#[pymethods]
impl NativeLoadPath {
    /// The body and its loads as the text of a file, `mceip-loads/1`.
    fn loads(&self) -> String {
        self.0.loads().to_json()
    }

    /// The stretches, those of `mceip path --json`, as JSON text.
    fn stretches(&self) -> String {
        serde_json::Value::from(self.0.to_json()).to_string()
    }

    /// In words, with a table.
    fn text(&self) -> String {
        self.0.text()
    }

    /// Why it ends.
    fn end(&self) -> String {
        self.0.end_text()
    }

    /// The problem in the contact states inside a stretch; `None` where nothing slips.
    fn problem(&self, stretch: usize) -> PyResult<Option<NativeProblem>> {
        match self.0.problem(stretch) {
            Ok(problem) => Ok(Some(NativeProblem(problem))),
            Err(Error::Model(mceip::ModelError::NothingSlips)) => Ok(None),
            Err(error) => Err(refused(error)),
        }
    }

    /// The states inside its stretches, analysed: `analyses` of `mceip path --json` and in words.
    fn analyze(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<(String, String)> {
        let analysed = watched(py, progress.as_ref(), |cancel, hear| {
            self.0.analyze().cancel(cancel).on_progress(hear).run()
        })?;
        let analysed = analysed.map_err(refused)?;
        Ok((analysed.to_json().to_string(), analysed.text()))
    }

    /// For each degree of freedom of the body that of its problems; `None` for a held one.
    fn places(&self) -> Vec<Option<usize>> {
        self.0.loads().body().places().to_vec()
    }

    /// The verdict of the checker on the certificate of an equilibrium: the friction, the amounts
    /// of the steps and the contact states, as text.
    fn check(
        &self,
        py: Python<'_>,
        text: &str,
    ) -> PyResult<(String, Vec<String>, Vec<&'static str>)> {
        let read = EquilibriumCertificate::from_json(text);
        let certificate = read.map_err(|e| MceipError::new_err(e.to_string()))?;

        let body = self.0.loads().body();
        let verdict = py.detach(|| check_equilibrium(body, &certificate));
        let accepted = verdict.map_err(|rejected| rejection(&rejected))?;
        let amounts = accepted.amounts.iter().map(ToString::to_string);
        let states = accepted.states.iter().map(|state| state.directed_word());
        Ok((
            accepted.friction.to_string(),
            amounts.collect(),
            states.collect(),
        ))
    }

    /// The own critical friction of its loads, as that of `mceip path --own-critical --json` and in
    /// words; the range is that of mu.
    fn own_critical(
        &self,
        py: Python<'_>,
        range: (String, String),
        parts: usize,
        width: &str,
        end_alone: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, String)> {
        let [least, greatest] = [&range.0, &range.1].map(|end| number("own_critical", end));
        let told = |e: FrictionGridError| MceipError::new_err(e.to_string());
        let grid = FrictionGrid::new(least?, greatest?).and_then(|grid| grid.with_parts(parts));
        let width = number("width", width)?;
        let grid = grid.and_then(|grid| grid.with_width(width)).map_err(told)?;

        let own = watched(py, progress.as_ref(), |cancel, hear| {
            let question = self.0.own_critical(grid).end_alone(end_alone);
            question.cancel(cancel).on_progress(hear).run()
        })?;
        let own = own.map_err(refused)?;
        Ok((own.to_json().to_string(), own.text()))
    }

    /// The certificate of the contact states inside a stretch, `mceip-equilibrium/1`.
    fn certify(&self, py: Python<'_>, stretch: usize) -> PyResult<String> {
        let certified = py.detach(|| self.0.certify(stretch));
        let proved = certified.map_err(|why| NotCertifiedError::new_err(why.to_string()))?;
        proved
            .file()
            .map_err(|e| MceipError::new_err(e.to_string()))
    }
}
