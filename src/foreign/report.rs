//! Reading a foreign `mceip-solutions/1` against the problem it is about.

use crate::candidate::{Candidate, SOLUTIONS_FORMAT};
use crate::exact::{NumberError, Rational, to_f64};
use crate::model::file::{Number, Object, from_json, require_format};
use crate::model::{Body, ModelError, Problem};
use crate::reduction::{Reduced, project};
use crate::tolerance::X_RADIUS;
use serde::{Deserialize, Deserializer};

/// A report, as far as it is read: solutions in the order of the file, and ranges of values.
#[derive(Debug, Clone, PartialEq)]
pub struct ForeignReport {
    /// One entry per solution: a candidate for the reduced pencil, or why its v is none.
    pub solutions: Vec<Result<Candidate, OffConstraints>>,
    /// Supports said to have solutions for whole intervals of values.
    pub continua: Vec<ForeignContinuum>,
}

/// A v that leaves (9): v_d = 0 and v_Ns = 0 do not hold.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("E9: v[{dof}]: expected no rate of sticking or into the obstacle, got {size:e} of the largest component")]
pub struct OffConstraints {
    /// The degree of freedom where it is worst.
    pub dof: usize,
    /// Size there, relative to the largest component of v.
    pub size: f64,
}

/// A support with intervals of values.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct ForeignContinuum {
    /// The support.
    pub slip: Vec<usize>,
    /// Lower and upper end of each interval; no upper end means infinity.
    #[serde(deserialize_with = "objects")]
    pub intervals: Vec<ForeignInterval>,
}

/// An interval of values.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct ForeignInterval {
    /// Lower end.
    #[serde(deserialize_with = "object")]
    pub from: ForeignEnd,
    /// Upper end.
    #[serde(default, deserialize_with = "optional")]
    pub to: Option<ForeignEnd>,
}

/// An end of an interval.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct ForeignEnd {
    /// The value.
    pub value: Number,
    /// Does it belong to the interval? Not compared where absent.
    pub included: Option<bool>,
}

/// Why a report is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ForeignError {
    /// Not a report of this version, or a number that cannot be read.
    #[error(transparent)]
    File(#[from] ModelError),
    /// A report on another problem.
    #[error("the report names another problem: expected {expected}, got {got}")]
    Digest {
        /// Digest of the problem.
        expected: String,
        /// Digest in the report.
        got: String,
    },
    /// A vector of the wrong length.
    #[error("solutions[{solution}]: expected {what} with {expected} components (see spec/formats.md for their order), got {got}")]
    Length {
        /// Index in the report.
        solution: usize,
        /// `x` or `v`.
        what: &'static str,
        /// Components wanted.
        expected: usize,
        /// Components given.
        got: usize,
    },
    /// Neither x nor, for a system, v.
    #[error("solutions[{solution}]: expected {expected}, got neither")]
    NoVector {
        /// Index in the report.
        solution: usize,
        /// What would do.
        expected: &'static str,
    },
}

fn object<'de, T: Deserialize<'de>, D: Deserializer<'de>>(d: D) -> Result<T, D::Error> {
    Object::deserialize(d).map(|o| o.0)
}

fn optional<'de, T: Deserialize<'de>, D: Deserializer<'de>>(d: D) -> Result<Option<T>, D::Error> {
    Option::<Object<T>>::deserialize(d).map(|o| o.map(|o| o.0))
}

fn objects<'de, T: Deserialize<'de>, D: Deserializer<'de>>(d: D) -> Result<Vec<T>, D::Error> {
    Vec::<Object<T>>::deserialize(d).map(|list| list.into_iter().map(|o| o.0).collect())
}

#[derive(Deserialize)]
struct Raw {
    problem_sha256: Option<String>,
    solutions: Vec<Object<RawSolution>>,
    #[serde(default, deserialize_with = "objects")]
    continua: Vec<ForeignContinuum>,
}

#[derive(Deserialize)]
struct RawSolution {
    value: Number,
    x: Option<Vec<Number>>,
    v: Option<Vec<Number>>,
}

impl ForeignReport {
    /// Reads a report on `problem`, whose reduction is `reduced`. Where a solution of a system has no x,
    /// its v is projected by (10); what v_d and v_Ns may be by rounding is `X_RADIUS` of `tolerance.rs`.
    ///
    /// # Errors
    /// [`ForeignError`]: not JSON of this shape, another version or problem, vectors that do not fit,
    /// numbers beyond the range of doubles.
    pub fn read(text: &str, problem: &Problem, reduced: &Reduced) -> Result<ForeignReport, ForeignError> {
        require_format(text, SOLUTIONS_FORMAT)?;
        let Object(raw): Object<Raw> = from_json(text)?;
        let expected = problem.sha256();
        if let Some(got) = raw.problem_sha256.filter(|d| *d != expected) {
            return Err(ForeignError::Digest { expected, got: got.chars().take(80).collect() });
        }
        let one = |(k, Object(s)): (usize, &Object<RawSolution>)| solution(k, s, problem, reduced);
        let solutions = raw.solutions.iter().enumerate().map(one).collect::<Result<_, _>>()?;
        Ok(ForeignReport { solutions, continua: raw.continua })
    }
}

fn solution(k: usize, s: &RawSolution, problem: &Problem, reduced: &Reduced) -> Result<Result<Candidate, OffConstraints>, ForeignError> {
    let length = |what, expected, got| match got == expected {
        true => Ok(()),
        false => Err(ForeignError::Length { solution: k, what, expected, got }),
    };
    let value = double(&s.value.0, k, "value")?;
    let exact = match (&s.x, &s.v, problem.body()) {
        (Some(x), _, _) => {
            length("x", reduced.pencil.order(), x.len())?;
            x.iter().map(|n| n.0.clone()).collect()
        }
        (None, Some(v), Body::System(system)) => {
            length("v", system.dofs(), v.len())?;
            let v: Vec<Rational> = v.iter().map(|n| n.0.clone()).collect();
            let projected = project(&reduced.variables, &v);
            if let Some((dof, size)) = projected.off.map(|(dof, size)| (dof, to_f64(&size))).filter(|(_, size)| *size > X_RADIUS) {
                return Ok(Err(OffConstraints { dof, size }));
            }
            projected.x
        }
        (None, _, Body::System(_)) => return Err(ForeignError::NoVector { solution: k, expected: "x or v" }),
        (None, _, Body::Pencil(_)) => return Err(ForeignError::NoVector { solution: k, expected: "x" }),
    };
    let x = exact.iter().map(|v| double(v, k, "x")).collect::<Result<Vec<_>, _>>()?;
    Ok(Ok(Candidate { value, x }))
}

/// The nearest double, if there is one.
fn double(v: &Rational, k: usize, field: &str) -> Result<f64, ForeignError> {
    let rounded = to_f64(v);
    if rounded.is_finite() {
        return Ok(rounded);
    }
    let source = NumberError::NotFinite { text: "a value beyond the range of doubles".into() };
    Err(ModelError::Number { place: format!("solutions[{k}].{field}"), source }.into())
}
