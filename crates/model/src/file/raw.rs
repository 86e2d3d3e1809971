//! The JSON shape of `mceip-problem/1` (`spec/formats.md`), and its way to a [`Problem`].
//!
//! Two steps. First `serde` reads the text into the `Raw` types, which say what fields there are
//! and nothing else; unknown fields are refused. Then `build` makes the types of the model out of
//! them, which establish every precondition.

use super::matrix::{RawMatrix, RawRadius};
use super::{Number, Object, SystemFile, Word};
use crate::{
    Body, BodyNode, ContactState, Coordinates, Curvature, LoadedBody, ModelError, Particle, Pencil,
    PrescribedDisplacement, Problem, QuadraticPencil, Radii, Reaction, RealWindow, System, Unknown,
    Window,
};
use mceip_exact::{Rational, Sparse, whole};
use num_traits::Zero;
use serde::Deserialize;
use std::path::Path;

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawProblem {
    name: Option<String>,
    comment: Option<String>,
    #[serde(default)]
    warnings: Vec<String>,
    coordinates: Option<Object<RawCoordinates>>,
    unknown: Word<Unknown>,
    window: Option<Object<RawWindow>>,
    pencil: Option<Object<RawPencil>>,
    system: Option<Object<RawSystem>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawWindow {
    min: Option<Number>,
    max: Option<Number>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPencil {
    a: RawMatrix,
    b: RawMatrix,
    c: Option<RawMatrix>,
    #[serde(default)]
    free: Vec<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSystem {
    stiffness: RawMatrix,
    mass: Option<RawMatrix>,
    friction: Option<Number>,
    particles: Vec<Object<RawParticle>>,
    radii: Option<Object<RawRadii>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawRadii {
    stiffness: Option<Object<RawRadius>>,
    mass: Option<Object<RawRadius>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCoordinates {
    /// Degrees of freedom along x and y, then x and y.
    nodes: Vec<(Option<usize>, Option<usize>, Number, Number)>,
    #[serde(default)]
    edges: Vec<[usize; 2]>,
    /// The names of the particles: older files have them here.
    #[serde(default)]
    particles: Vec<String>,
    /// Of a body under loads: step, node, displacement along x and y.
    #[serde(default)]
    prescribed: Vec<(usize, usize, Number, Number)>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawParticle {
    tangential: usize,
    normal: usize,
    state: Word<RawState>,
    sign: Option<i64>,
    normal_direction: Option<i64>,
    frame: Option<[[Number; 2]; 2]>,
    friction_factor: Option<Number>,
    friction_factor_range: Option<[Number; 2]>,
    reaction: Option<Object<RawReaction>>,
    curvature: Option<Object<RawCurvature>>,
    name: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum RawState {
    Free,
    Stick,
    Slip,
    Zero,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawReaction {
    normal: Number,
    tangential: Number,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCurvature {
    value: Number,
    normal_reaction: Number,
}

impl RawProblem {
    /// Builds the problem; Matrix Market files that it names are looked for in `folder`.
    pub(super) fn build(mut self, folder: &Path) -> Result<Problem, ModelError> {
        self.name_particles()?;
        let unknown = self.unknown.0;
        let body = match (self.pencil, self.system) {
            (Some(Object(pencil)), None) => pencil.build(folder)?,
            (None, Some(Object(system))) => Body::System(system.build(folder)?),
            (None, None) => return Err(ModelError::Body { got: "neither" }),
            (Some(_), Some(_)) => return Err(ModelError::Body { got: "both" }),
        };

        let coordinates = match (self.coordinates, &body) {
            (None, _) => None,
            (Some(Object(coordinates)), Body::System(system)) => Some(coordinates.build(system)?),
            (Some(_), Body::Pencil(_) | Body::Quadratic(_)) => {
                return Err(ModelError::Coordinates {
                    expected: "coordinates of a system only",
                    got: "those of a pencil".into(),
                });
            }
        };

        let window = self.window.map(|Object(window)| window);
        let mut problem = match unknown {
            Unknown::Lambda2 | Unknown::Mu => {
                Problem::new(body, unknown, RawWindow::build_given(window)?)?
            }
            Unknown::Eigenvalue => Problem::new(body, unknown, Window::all())?
                .with_real_window(&RawWindow::build_real(window)?),
        };
        problem.name = self.name;
        problem.comment = self.comment;
        problem.warnings = self.warnings;
        problem.coordinates = coordinates;

        Ok(problem)
    }

    /// Builds the system alone, without friction where that is 0; `None` for a pencil.
    pub(super) fn build_system(mut self, folder: &Path) -> Result<Option<SystemFile>, ModelError> {
        self.name_particles()?;
        let window = RawWindow::build_given(self.window.map(|Object(window)| window))?;
        let mut raw = match (self.pencil, self.system) {
            (None, Some(Object(raw))) => raw,
            (Some(_), None) => return Ok(None),
            (None, None) => return Err(ModelError::Body { got: "neither" }),
            (Some(_), Some(_)) => return Err(ModelError::Body { got: "both" }),
        };

        if self.unknown.0 == Unknown::Eigenvalue {
            let got = "a body".into();
            return Err(ModelError::Eigenvalue { got });
        }

        let friction = raw.friction.as_ref().map(|number| number.0.clone());
        if friction.as_ref().is_some_and(Rational::is_zero) {
            raw.friction = None;
        }

        let system = raw.build(folder)?;
        let coordinates = match self.coordinates {
            Some(Object(coordinates)) => Some(coordinates.build(&system)?),
            None => None,
        };

        Ok(Some(SystemFile {
            name: self.name,
            warnings: self.warnings,
            coordinates,
            unknown: self.unknown.0,
            window,
            system,
            friction,
        }))
    }

    /// Gives the particles the names that stand beside the coordinates.
    fn name_particles(&mut self) -> Result<(), ModelError> {
        if let (Some(Object(coordinates)), Some(Object(system))) =
            (&mut self.coordinates, &mut self.system)
        {
            let particles = system.particles.iter_mut();
            coordinates.give_names(particles.map(|Object(particle)| &mut particle.name))?;
        }

        Ok(())
    }
}

impl RawWindow {
    /// All values without a window.
    fn build_given(given: Option<RawWindow>) -> Result<Window, ModelError> {
        match given {
            None => Ok(Window::all()),
            Some(window) => window.build(),
        }
    }

    /// No `min` means -infinity, no `max` infinity.
    fn build_real(given: Option<RawWindow>) -> Result<RealWindow, ModelError> {
        let ends = given.map(|window| (window.min, window.max));
        let (min, max) = ends.unwrap_or_default();
        RealWindow::new(min.map(|number| number.0), max.map(|number| number.0))
    }

    /// No `min` means 0, no `max` means infinity.
    fn build(self) -> Result<Window, ModelError> {
        let min = match self.min {
            Some(number) => number.0,
            None => whole(0),
        };

        let max = self.max.map(|number| number.0);

        Window::new(min, max)
    }
}

impl RawPencil {
    fn build(self, folder: &Path) -> Result<Body, ModelError> {
        let a = self.a.build("a", folder)?;
        let b = self.b.build("b", folder)?;
        let Some(c) = self.c else {
            return Ok(Body::Pencil(Pencil::new(a, b, self.free)?));
        };

        if let Some(index) = self.free.first() {
            let got = format!("a quadratic pencil with the free variable {index}");
            return Err(ModelError::Eigenvalue { got });
        }
        let c = c.build("c", folder)?;
        Ok(Body::Quadratic(QuadraticPencil::new(a, b, c)?))
    }
}

impl RawSystem {
    fn build(self, folder: &Path) -> Result<System, ModelError> {
        let particles = particles(self.particles)?;
        let mass = match self.mass {
            Some(mass) => Some(mass.build("M", folder)?),
            None => None,
        };

        let stiffness = self.stiffness.build("K", folder)?;
        let friction = self.friction.map(|number| number.0);
        let radii = match self.radii {
            Some(Object(radii)) => radii.build(&stiffness, mass.as_ref(), folder)?,
            None => Radii::NONE,
        };

        System::new(stiffness, mass, friction, particles)?.with_radii(radii)
    }
}

impl RawRadii {
    fn build(
        self,
        stiffness: &Sparse,
        mass: Option<&Sparse>,
        folder: &Path,
    ) -> Result<Radii, ModelError> {
        let of_mass = match (self.mass, mass) {
            (None, _) => None,
            (Some(Object(radius)), Some(mass)) => {
                Some(radius.build(mass, "the radius of M", folder)?)
            }
            (Some(_), None) => return Err(ModelError::RadiusWithoutMass),
        };
        let of_stiffness = match self.stiffness {
            None => None,
            Some(Object(radius)) => Some(radius.build(stiffness, "the radius of K", folder)?),
        };

        Ok(Radii {
            stiffness: of_stiffness,
            mass: of_mass,
        })
    }
}

impl RawCoordinates {
    /// Gives the names that stand here to the particles.
    ///
    /// # Errors
    /// [`ModelError::Coordinates`] for another number of names than of particles, and for a
    /// particle that has a name.
    pub(super) fn give_names<'a>(
        &mut self,
        particles: impl ExactSizeIterator<Item = &'a mut Option<String>>,
    ) -> Result<(), ModelError> {
        let names = std::mem::take(&mut self.particles);
        if names.is_empty() {
            return Ok(());
        }
        if names.len() != particles.len() {
            return Err(ModelError::Coordinates {
                expected: "a name for each particle, or none",
                got: format!("{} names for {} particles", names.len(), particles.len()),
            });
        }

        for (own, name) in particles.zip(names) {
            if own.is_some() {
                return Err(ModelError::Coordinates {
                    expected: "the name of a particle in one place",
                    got: "one in the particle and one beside the coordinates".into(),
                });
            }
            *own = Some(name);
        }

        Ok(())
    }

    pub(super) fn build(self, system: &System) -> Result<Coordinates, ModelError> {
        if let Some((step, node, _, _)) = self.prescribed.first() {
            return Err(ModelError::Coordinates {
                expected: "prescribed displacements of a body under loads only",
                got: format!("that of node {node} in step {step}"),
            });
        }
        Coordinates::new(body_nodes(self.nodes), self.edges, system)
    }

    pub(super) fn build_under_loads(self, body: &LoadedBody) -> Result<Coordinates, ModelError> {
        let placed = Coordinates::under_loads(body_nodes(self.nodes), self.edges, body)?;
        let prescribed = self.prescribed.into_iter();
        let prescribed = prescribed.map(|(step, node, x, y)| PrescribedDisplacement {
            step,
            node,
            by: [x.0, y.0],
        });
        placed.with_prescribed(prescribed.collect(), body.steps().len())
    }
}

fn body_nodes(nodes: Vec<(Option<usize>, Option<usize>, Number, Number)>) -> Vec<BodyNode> {
    let nodes = nodes.into_iter();
    let nodes = nodes.map(|(along_x, along_y, x, y)| BodyNode {
        dofs: [along_x, along_y],
        place: [x.0, y.0],
    });
    nodes.collect()
}

/// The particles of a list, numbered in complaints.
pub(super) fn particles(list: Vec<Object<RawParticle>>) -> Result<Vec<Particle>, ModelError> {
    let mut particles = Vec::with_capacity(list.len());
    for (index, Object(particle)) in list.into_iter().enumerate() {
        particles.push(particle.build(index)?);
    }
    Ok(particles)
}

impl RawParticle {
    /// A particle that is not in contact, in the paper's own directions.
    pub(super) fn open(tangential: usize, normal: usize) -> RawParticle {
        RawParticle {
            tangential,
            normal,
            state: Word(RawState::Free),
            sign: None,
            normal_direction: None,
            frame: None,
            friction_factor: None,
            friction_factor_range: None,
            reaction: None,
            curvature: None,
            name: None,
        }
    }

    /// In these directions.
    pub(super) fn turned(
        self,
        normal_direction: Option<i64>,
        frame: Option<[[Number; 2]; 2]>,
    ) -> RawParticle {
        RawParticle {
            normal_direction,
            frame,
            ..self
        }
    }

    /// With this friction factor.
    pub(super) fn with_friction_factor(self, friction_factor: Option<Number>) -> RawParticle {
        RawParticle {
            friction_factor,
            ..self
        }
    }

    /// With this name.
    pub(super) fn named(self, name: Option<String>) -> RawParticle {
        RawParticle { name, ..self }
    }

    pub(super) fn build(self, index: usize) -> Result<Particle, ModelError> {
        let state = contact_state(index, self.state.0, self.sign)?;

        let frame: Option<[[Rational; 2]; 2]> = self
            .frame
            .map(|rows| rows.map(|row| row.map(|number| number.0)));
        let friction_factor = match self.friction_factor {
            Some(number) => number.0,
            None => whole(1),
        };
        let reaction = self.reaction.map(|Object(reaction)| Reaction {
            tangential: reaction.tangential.0,
            normal: reaction.normal.0,
        });

        let curvature = self.curvature.map(|Object(curvature)| Curvature {
            value: curvature.value.0,
            normal_reaction: curvature.normal_reaction.0,
        });

        let normal_direction = match self.normal_direction {
            Some(direction) => sign(index, "normal_direction", direction)?,
            None => 1,
        };

        Ok(Particle {
            tangential: self.tangential,
            normal: self.normal,
            state,
            normal_direction,
            frame,
            friction_factor,
            friction_factor_range: self
                .friction_factor_range
                .map(|ends| ends.map(|number| number.0)),
            reaction,
            curvature,
            name: self.name.filter(|name| !name.is_empty()), // an empty one is none
        })
    }
}

/// The state with its sign, which a slip particle has and no other.
fn contact_state(
    particle: usize,
    state: RawState,
    given: Option<i64>,
) -> Result<ContactState, ModelError> {
    match (state, given) {
        (RawState::Zero, None) => Ok(ContactState::Zero),
        (RawState::Free, None) => Ok(ContactState::Free),
        (RawState::Stick, None) => Ok(ContactState::Stick),
        (RawState::Slip, Some(value)) => Ok(ContactState::Slip {
            sign: sign(particle, "sign", value)?,
        }),
        (RawState::Slip, None) => Err(ModelError::Sign {
            particle,
            field: "sign",
            expected: "1 or -1 on a slip particle",
            got: "none".into(),
        }),
        (RawState::Free | RawState::Stick | RawState::Zero, Some(value)) => Err(ModelError::Sign {
            particle,
            field: "sign",
            expected: "none on a particle that does not slip",
            got: value.to_string(),
        }),
    }
}

fn sign(particle: usize, field: &'static str, value: i64) -> Result<i8, ModelError> {
    match value {
        1 => Ok(1),
        -1 => Ok(-1),
        other => Err(ModelError::Sign {
            particle,
            field,
            expected: "1 or -1",
            got: other.to_string(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{read_problem, write_problem};
    use super::*;
    use mceip_exact::rational;

    fn system(particles: &str) -> String {
        format!(
            r#"{{"format": "mceip-problem/1", "unknown": "lambda2",
                "system": {{"stiffness": [[2, 0], [0, 2]], "mass": [[1, 0], [0, 1]],
                            "friction": "1.1", "particles": [{particles}]}}}}"#
        )
    }

    fn read(text: &str) -> Result<Problem, ModelError> {
        read_problem(text, Path::new("."))
    }

    #[test]
    fn a_system_round_trips() {
        let text = system(
            r#"{"tangential": 0, "normal": 1, "state": "slip", "sign": -1, "normal_direction": -1,
                "frame": [["3/5", "4/5"], ["-4/5", "3/5"]],
                "reaction": {"normal": -1, "tangential": "-1.1"}}"#,
        );

        let problem = read(&text).unwrap();
        let again = read(&write_problem(&problem)).unwrap();

        assert_eq!(problem, again);
        assert_eq!(problem.sha256(), again.sha256());
    }

    /// The digest has the product of curvature and reaction, and not a product of 0.
    #[test]
    fn a_curvature_is_read_and_written() {
        let with = |curvature: &str| {
            let particle = r#"{"tangential": 0, "normal": 1, "state": "slip", "sign": 1 ITS}"#;
            read(&system(&particle.replace("ITS", curvature)))
        };
        let of = |value: &str, reaction: &str| {
            with(&format!(
                r#", "curvature": {{"value": {value}, "normal_reaction": {reaction}}}"#
            ))
        };
        let flat = with("").unwrap();
        let curved = of(r#""1/4""#, "-3").unwrap();

        assert_eq!(read(&write_problem(&curved)).unwrap(), curved);
        let expected = "normal 1 1\ngeometric_stiffness -3/4\nstiffness";
        assert!(curved.canonical_text().contains(expected));
        assert_eq!(
            of("-0.5", "-1.5").unwrap().sha256(),
            of("-1.5", "-0.5").unwrap().sha256()
        );
        assert_eq!(of("0", "-3").unwrap().sha256(), flat.sha256());

        for reaction in ["0", "2"] {
            assert!(matches!(
                of("1", reaction),
                Err(ModelError::Curvature { particle: 0, .. })
            ));
        }
        let malformed = with(r#", "curvature": {"value": 1}"#);
        assert!(
            matches!(malformed, Err(ModelError::Json { .. })),
            "{malformed:?}"
        );
    }

    /// The factor is part of the digest, and the factor 1 is none.
    #[test]
    fn a_friction_factor_is_read_and_written() {
        let with = |factor: &str| {
            let particle = r#"{"tangential": 0, "normal": 1, "state": "slip", "sign": 1 FACTOR}"#;
            read(&system(&particle.replace("FACTOR", factor)))
        };
        let plain = with("").unwrap();
        let rough = with(r#", "friction_factor": "3/2""#).unwrap();

        assert_eq!(read(&write_problem(&rough)).unwrap(), rough);
        assert!(!write_problem(&plain).contains("friction_factor"));
        assert_eq!(with(r#", "friction_factor": 1"#).unwrap(), plain);
        assert_ne!(rough.sha256(), plain.sha256());
        let expected = "normal 1 1\nfriction_factor 3/2\nstiffness";
        assert!(rough.canonical_text().contains(expected));

        for factor in ["0", "-0.5"] {
            let refused = with(&format!(r#", "friction_factor": {factor}"#));
            assert!(matches!(
                refused,
                Err(ModelError::FrictionFactor { particle: 0, .. })
            ));
        }
        for factor in [r#""rough""#, "[1]"] {
            let refused = with(&format!(r#", "friction_factor": {factor}"#));
            assert!(matches!(refused, Err(ModelError::Json { .. })));
        }
    }

    const SLIP: &str = r#"{"tangential": 0, "normal": 1, "state": "slip", "sign": 1}"#;

    /// The system with its fields `radii` and what a particle has beside its state.
    fn with_radii(radii: &str, of_particle: &str) -> Result<Problem, ModelError> {
        let particle = SLIP.replace('}', &format!("{of_particle}}}"));
        let text = system(&particle).replace(r#""mass""#, &format!(r#""radii": {radii}, "mass""#));
        read(&text)
    }

    /// The three spellings of one radius, and what the digest covers.
    #[test]
    fn radii_are_read_and_written() {
        let exact = read(&system(SLIP)).unwrap();
        let absolute = with_radii(r#"{"stiffness": {"absolute": 0.5}}"#, "").unwrap();
        assert!(exact.is_exact() && !absolute.is_exact());
        assert_eq!(absolute.as_given(), exact);
        assert_ne!(absolute.sha256(), exact.sha256());
        let expected = "mass 2 2\n0 0 1\n1 1 1\nstiffness_radius 2 2\n0 0 1/2\n1 1 1/2\n";
        assert!(absolute.canonical_text().ends_with(expected));

        for same in [
            r#"{"stiffness": {"relative": "1/4"}}"#,
            r#"{"stiffness": {"matrix": [[0.5, 0], [0, 0.5]]}, "mass": {"absolute": 0}}"#,
        ] {
            assert_eq!(with_radii(same, "").unwrap(), absolute, "{same}");
        }
        assert_eq!(read(&write_problem(&absolute)).unwrap(), absolute);

        let of_mass = with_radii(r#"{"mass": {"absolute": "1/8"}}"#, "").unwrap();
        assert!(
            of_mass
                .canonical_text()
                .contains("mass_radius 2 2\n0 0 1/8")
        );
        assert_eq!(with_radii("{}", "").unwrap(), exact);

        let range = r#", "friction_factor_range": [0.5, 1]"#;
        let range = with_radii("{}", range).unwrap();
        assert!(!range.is_exact() && range.as_given() == exact);
        assert!(
            range
                .canonical_text()
                .contains("friction_factor_range 1/2 1\n")
        );
        assert_eq!(read(&write_problem(&range)).unwrap(), range);
        let Body::System(system) = range.body() else {
            panic!("a system")
        };
        let particle = &system.particles()[0];
        assert_eq!(
            particle.friction_factor_ball(),
            (rational(3, 4), rational(1, 3))
        );
        assert_eq!(
            system.middle().particles()[0].friction_factor,
            rational(3, 4)
        );
    }

    #[test]
    fn radii_that_say_nothing_are_refused() {
        let not_symmetric = r#"{"stiffness": {"matrix": [[0, 1], [0, 0]]}}"#;
        let refused = with_radii(not_symmetric, "");
        assert!(matches!(refused, Err(ModelError::NotSymmetric { .. })));

        let negative = with_radii(r#"{"mass": {"absolute": -1}}"#, "");
        assert!(matches!(
            negative,
            Err(ModelError::RadiusNegative { row: 0, .. })
        ));

        let larger = with_radii(r#"{"mass": {"matrix": [[1]]}}"#, "");
        assert!(matches!(larger, Err(ModelError::Shape { .. })));

        for malformed in [
            "[]",
            r#"{"friction": {"absolute": 1}}"#,
            r#"{"stiffness": 1}"#,
            r#"{"stiffness": {"absolute": 1, "relative": 1}}"#,
            r#"{"stiffness": [[1, 0], [0, 1]]}"#,
        ] {
            let refused = with_radii(malformed, "");
            assert!(
                matches!(refused, Err(ModelError::Json { .. })),
                "{malformed}"
            );
        }

        for range in ["[1, 1]", "[2, 3]", "[-1, 1]", "[1, 0]"] {
            let refused = with_radii("{}", &format!(r#", "friction_factor_range": {range}"#));
            let is_range = matches!(refused, Err(ModelError::FrictionFactorRange { .. }));
            assert!(is_range, "{range}: {refused:?}");
        }

        let zero = r#"{"tangential": 0, "normal": 1, "state": "zero"}"#;
        let text =
            system(zero).replace("\"mass\"", r#""radii": {"mass": {"absolute": 1}}, "mass""#);
        assert!(read(&text).is_err());
    }

    #[test]
    fn particles_are_refused_by_name() {
        for (particle, field) in [
            (r#"{"tangential":0,"normal":1,"state":"slip"}"#, "sign"),
            (
                r#"{"tangential":0,"normal":1,"state":"slip","sign":0}"#,
                "sign",
            ),
            (
                r#"{"tangential":0,"normal":1,"state":"stick","sign":1}"#,
                "sign",
            ),
            (
                r#"{"tangential":0,"normal":1,"state":"zero","sign":1}"#,
                "sign",
            ),
            (
                r#"{"tangential":0,"normal":1,"state":"stick","normal_direction":2}"#,
                "normal_direction",
            ),
        ] {
            let Err(ModelError::Sign {
                particle: 0,
                field: refused,
                ..
            }) = read(&system(particle))
            else {
                panic!("{particle}")
            };
            assert_eq!(refused, field, "{particle}");
        }

        let twice = r#"{"tangential": 0, "normal": 1, "state": "stick"},
                       {"tangential": 0, "normal": 1, "state": "slip", "sign": 1}"#;
        assert!(matches!(
            read(&system(twice)),
            Err(ModelError::DofTwice {
                first: 0,
                second: 1,
                ..
            })
        ));
    }

    #[test]
    fn bodies_windows_and_versions_are_checked() {
        assert!(matches!(
            read(r#"{"format":"mceip-problem/1","unknown":"mu"}"#),
            Err(ModelError::Body { got: "neither" })
        ));
        assert!(matches!(
            read(r#"{"format":"mceip-problem/2"}"#),
            Err(ModelError::Format { .. })
        ));
        assert!(matches!(
            read(r#"{"unknown":"mu"}"#),
            Err(ModelError::Format { .. })
        ));

        let window = r#"{"format": "mceip-problem/1", "unknown": "mu",
                         "window": {"min": 2, "max": "1.5"},
                         "pencil": {"a": [[1]], "b": [[1]]}}"#;
        assert!(matches!(read(window), Err(ModelError::Window { .. })));

        let unknown_field =
            r#"{"format":"mceip-problem/1","unknown":"mu","pencil":{"a":[[1]],"b":[[1]],"c":1}}"#;
        assert!(matches!(read(unknown_field), Err(ModelError::Json { .. })));

        let slip = r#"{"tangential": 0, "normal": 1, "state": "slip", "sign": 1}"#;
        let no_mass = format!(
            r#"{{"format": "mceip-problem/1", "unknown": "lambda2",
                "system": {{"stiffness": [[1, 0], [0, 1]], "friction": 1,
                            "particles": [{slip}]}}}}"#
        );

        assert!(matches!(
            read(&no_mass),
            Err(ModelError::Missing { what: "mass", .. })
        ));
    }

    /// The window of an eigenvalue problem holds numbers of both signs, the real line if not said.
    #[test]
    fn an_eigenvalue_problem_is_read_and_written() {
        let with = |window: &str| {
            let pencil = r#""pencil": {"a": [[1, 2], [3, 4]], "b": [[0, "-1/2"], [0, 1]]}"#;
            let head = r#""format": "mceip-problem/1", "unknown": "eigenvalue""#;
            read(&format!("{{{head}, {window} {pencil}}}"))
        };
        let both = with(r#""window": {"min": "-7/2", "max": 3},"#).unwrap();
        assert_eq!(read(&write_problem(&both)).unwrap(), both);
        let reflected = both.reflected().unwrap();
        assert_eq!(reflected.window().max(), Some(&rational(7, 2)));
        assert!(reflected.reflected().is_none());
        let (Body::Pencil(own), Body::Pencil(other)) = (both.body(), reflected.body()) else {
            panic!("pencils");
        };
        assert_eq!((own.a(), &own.b().negated()), (other.a(), other.b()));

        for line in [
            "",
            r#""window": {},"#,
            r#""window": {"min": null, "max": null},"#,
        ] {
            let problem = with(line).unwrap();
            assert_eq!(problem.real_window(), RealWindow::ALL);
            assert_eq!(problem.sha256(), both.sha256());
        }
        assert!(
            with(r#""window": {"min": 0},"#)
                .unwrap()
                .reflected()
                .is_none()
        );
        let refused = with(r#""window": {"max": -1},"#);
        assert!(matches!(refused, Err(ModelError::RealWindow { .. })));
    }

    #[test]
    fn eigenvalues_are_those_of_a_pencil_without_free_variables() {
        let of_body = system(SLIP).replace("lambda2", "eigenvalue");
        let with_free = r#"{"format": "mceip-problem/1", "unknown": "eigenvalue",
            "pencil": {"a": [[1]], "b": [[1]], "free": [0]}}"#;
        for text in [of_body.as_str(), with_free] {
            assert!(
                matches!(read(text), Err(ModelError::Eigenvalue { .. })),
                "{text}"
            );
        }
    }
}
