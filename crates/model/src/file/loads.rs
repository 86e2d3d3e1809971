//! The JSON shape of `mceip-loads/1` (`spec/formats.md`): the system of a problem file with
//! candidates in place of particles, and the steps of its loading.

use super::matrix::RawMatrix;
use super::raw::{RawCoordinates, RawParticle};
use super::{Number, Object, from_json_of};
use crate::loaded::{ContactCandidate, LoadStep, LoadedBody, LoadedParts};
use crate::{Coordinates, ModelError};
use mceip_exact::{Rational, whole};
use serde::Deserialize;
use std::path::Path;

/// The format of a body under loads.
pub const LOADS_FORMAT: &str = "mceip-loads/1";

/// A file of a body under loads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadsFile {
    /// A name for people.
    pub name: Option<String>,
    /// A remark for people.
    pub comment: Option<String>,
    /// What looked wrong when the file was made.
    pub warnings: Vec<String>,
    /// The body and its loads.
    pub body: LoadedBody,
    /// Where its nodes are.
    pub coordinates: Option<Coordinates>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawLoads {
    name: Option<String>,
    comment: Option<String>,
    #[serde(default)]
    warnings: Vec<String>,
    system: Object<RawBody>,
    steps: Vec<Object<RawStep>>,
    coordinates: Option<Object<RawCoordinates>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawBody {
    stiffness: RawMatrix,
    mass: Option<RawMatrix>,
    friction: Option<Number>,
    candidates: Vec<Object<RawCandidate>>,
    #[serde(default)]
    held: Vec<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCandidate {
    tangential: usize,
    normal: usize,
    normal_direction: Option<i64>,
    frame: Option<[[Number; 2]; 2]>,
    friction_factor: Option<Number>,
    gap: Option<Number>,
    name: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStep {
    name: Option<String>,
    #[serde(default)]
    forces: Vec<(usize, Number)>,
    #[serde(default)]
    displacements: Vec<(usize, Number)>,
    #[serde(default)]
    endless: bool,
}

/// Reads a body under loads from JSON text; Matrix Market files it names are looked for in
/// `folder`.
///
/// # Errors
/// [`ModelError`] with the place, what was expected and what was found.
pub fn read_loads(text: &str, folder: &Path) -> Result<LoadsFile, ModelError> {
    let raw: RawLoads = from_json_of(LOADS_FORMAT, text)?;
    raw.build(folder)
}

impl RawLoads {
    fn build(mut self, folder: &Path) -> Result<LoadsFile, ModelError> {
        let Object(mut system) = self.system;
        if let Some(Object(coordinates)) = &mut self.coordinates {
            let candidates = system.candidates.iter_mut();
            coordinates.give_names(candidates.map(|Object(candidate)| &mut candidate.name))?;
        }
        let mut steps = Vec::with_capacity(self.steps.len());
        for (index, Object(step)) in self.steps.into_iter().enumerate() {
            steps.push(step.build(index));
        }

        let body = LoadedBody::new(system.build(steps, folder)?)?;
        let coordinates = match self.coordinates {
            None => None,
            Some(Object(coordinates)) => Some(coordinates.build_under_loads(&body)?),
        };

        Ok(LoadsFile {
            name: self.name,
            comment: self.comment,
            warnings: self.warnings,
            body,
            coordinates,
        })
    }
}

impl RawBody {
    fn build(self, steps: Vec<LoadStep>, folder: &Path) -> Result<LoadedParts, ModelError> {
        let mass = match self.mass {
            Some(mass) => Some(mass.build("M", folder)?),
            None => None,
        };
        let mut candidates = Vec::with_capacity(self.candidates.len());
        for (index, Object(candidate)) in self.candidates.into_iter().enumerate() {
            candidates.push(candidate.build(index)?);
        }

        Ok(LoadedParts {
            stiffness: self.stiffness.build("K", folder)?,
            mass,
            friction: self.friction.map(|number| number.0),
            candidates,
            held: self.held,
            steps,
        })
    }
}

impl RawCandidate {
    fn build(self, index: usize) -> Result<ContactCandidate, ModelError> {
        let gap = self.gap.map_or_else(|| whole(0), |number| number.0);
        let particle = RawParticle::open(self.tangential, self.normal)
            .turned(self.normal_direction, self.frame)
            .with_friction_factor(self.friction_factor)
            .named(self.name);

        Ok(ContactCandidate {
            particle: particle.build(index)?,
            gap,
        })
    }
}

impl RawStep {
    fn build(self, index: usize) -> LoadStep {
        let values = |pairs: Vec<(usize, Number)>| -> Vec<(usize, Rational)> {
            pairs
                .into_iter()
                .map(|(dof, number)| (dof, number.0))
                .collect()
        };

        LoadStep {
            name: self.name.unwrap_or_else(|| format!("step {}", index + 1)),
            forces: values(self.forces),
            displacements: values(self.displacements),
            is_endless: self.endless,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::write_loads;
    use mceip_exact::rational;

    const FILE: &str = r#"{
        "format": "mceip-loads/1",
        "name": "one particle",
        "warnings": ["soft"],
        "system": {
            "stiffness": [[2, 0, -1], [0, 1, 0], [-1, 0, 2]],
            "friction": 0.5,
            "candidates": [{"tangential": 0, "normal": 1, "normal_direction": -1, "gap": 0.1}],
            "held": [2]
        },
        "steps": [
            {"name": "press", "forces": [[1, -3]]},
            {"displacements": [[2, "1/3"]], "endless": true}
        ],
        "coordinates": {"nodes": [[0, 1, 0, 0], [2, null, 1, 0]], "particles": ["heel"]}
    }"#;

    fn read(text: &str) -> Result<LoadsFile, ModelError> {
        read_loads(text, Path::new("."))
    }

    #[test]
    fn a_file_is_read_as_it_is_spelt() {
        let file = read(FILE).unwrap();
        let body = &file.body;

        assert_eq!(file.name.as_deref(), Some("one particle"));
        assert_eq!(body.gaps(), [rational(1, 10)]);
        assert_eq!(body.steps()[1].name, "step 2");
        assert!(body.steps()[1].is_endless);
        assert_eq!(body.loads()[1], [rational(1, 3), whole(0)]);
        assert_eq!(body.system().friction(), Some(&rational(1, 2)));

        // The names beside the coordinates are those of the candidates.
        assert_eq!(body.system().particles()[0].name.as_deref(), Some("heel"));

        // The held dof moves no node.
        let coordinates = file.coordinates.unwrap();
        assert_eq!(coordinates.nodes()[1].dofs, [None, None]);

        // The second step moves it by 1/3, of which a half is applied.
        let moved = coordinates.prescribed_at(&[whole(1), rational(1, 2)]);
        assert_eq!(moved[0], [whole(0), whole(0)]);
        assert_eq!(moved[1], [rational(1, 6), whole(0)]);
    }

    #[test]
    fn a_file_that_is_written_is_the_body_without_its_held_dofs() {
        let file = read(FILE).unwrap();
        let again = read(&write_loads(&file)).unwrap();

        assert_eq!(again.name, file.name);
        assert_eq!(again.warnings, ["soft"]);
        assert_eq!(again.coordinates, file.coordinates);
        assert_eq!(again.body.system(), file.body.system());
        assert_eq!(again.body.gaps(), file.body.gaps());
        assert_eq!(again.body.loads(), file.body.loads());
        assert_eq!(again.body.sha256(), file.body.sha256());
        assert!(again.body.steps()[1].is_endless);
    }

    #[test]
    fn fields_and_versions_are_checked() {
        for (from, to, word) in [
            ("loads/1", "loads/2", "mceip-loads/1"),
            ("\"gap\"", "\"gaps\"", "gaps"),
            (
                "\"held\": [2]",
                "\"held\": [0]",
                "candidate 0, tangential 0",
            ),
            ("\"gap\": 0.1", "\"state\": \"stick\"", "state"),
            ("[2, null, 1, 0]", "[7, null, 1, 0]", "coordinates"),
            (
                "\"particles\": [",
                "\"prescribed\": [[0, 2, 0, 1]], \"particles\": [",
                "2 of 2",
            ),
            (
                "\"particles\": [",
                "\"prescribed\": [[2, 1, 0, 1]], \"particles\": [",
                "step 2 of 2",
            ),
            (
                "\"particles\": [",
                "\"prescribed\": [[0, 0, 0, 1]], \"particles\": [",
                "node 0 in",
            ),
            (
                "\"particles\": [",
                "\"prescribed\": [[1, 1, 1, 0]], \"particles\": [",
                "node 1 in",
            ),
            ("\"gap\"", "\"name\": \"toe\", \"gap\"", "one place"),
            ("[\"heel\"]", "[\"heel\", \"toe\"]", "2 names"),
            (
                "\"normal_direction\": -1",
                "\"normal_direction\": 2",
                "normal_direction",
            ),
        ] {
            let error = read(&FILE.replace(from, to)).unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
        }
    }
}
