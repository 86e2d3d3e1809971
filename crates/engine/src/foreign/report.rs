//! Reading a foreign `mceip-solutions/1` against the problem it is about.

use crate::candidate::{Candidate, SOLUTIONS_FORMAT};
use crate::reduction::{Reduced, project};
use crate::tolerance::X_RADIUS;
use mceip_exact::{Rational, to_f64};
use mceip_model::file::{Number, Object, from_json, require_format};
use mceip_model::{Body, ModelError, Problem};
use num_traits::{Signed as _, Zero as _};
use serde::{Deserialize, Deserializer};

/// A report, as far as it is read: solutions in the order of the file, and ranges of values.
#[derive(Debug, Clone, PartialEq)]
pub struct ForeignReport {
    /// One entry per solution: a candidate for the reduced pencil, or why it is none.
    pub solutions: Vec<Result<Reported, BadPoint>>,
    /// Supports said to have solutions for whole intervals of values.
    pub continua: Vec<ForeignContinuum>,
}

/// A reported solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Reported {
    /// Value and x; where the report has v, x is its projection by (10).
    pub candidate: Candidate,
    /// Where v is furthest from v_d = 0 and v_Ns = 0, if it is not on them.
    pub off: Option<Off>,
}

/// A component of v that should be zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Off {
    /// The degree of freedom.
    pub dof: usize,
    /// Size there, relative to the largest component of v.
    pub size: f64,
}

/// Why one solution of a report is no candidate. The others are judged all the same.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BadPoint {
    /// A v that leaves (9): v_d = 0 and v_Ns = 0 do not hold.
    #[error(
        "E9: v[{dof}]: expected no rate of sticking or into the obstacle, got {size:e} of the \
         largest component"
    )]
    OffConstraints {
        /// The degree of freedom where it is worst.
        dof: usize,
        /// Size there, relative to the largest component of v.
        size: f64,
    },
    /// A vector of the wrong length.
    #[error(
        "solutions[{solution}]: expected {what} with {expected} components (see spec/formats.md \
         for their order), got {got}"
    )]
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
    /// A number beyond the range of doubles that have all their digits.
    #[error(
        "solutions[{solution}].{field}: expected 0 or a number between 2^-1022 and 2^1024 in size, \
         got another one"
    )]
    OutOfRange {
        /// Index in the report.
        solution: usize,
        /// `value`.
        field: &'static str,
    },
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
    /// Reads a report on `problem`, whose reduction is `reduced`. Where a solution of a system has
    /// no x, its v is projected by (10); what v_d and v_Ns may be at most is `X_RADIUS` of
    /// `tolerance.rs`.
    ///
    /// # Errors
    /// [`ForeignError`]: not JSON of this shape, another version or problem. A solution that does
    /// not fit the problem is no error of the report: its entry says why it is none.
    pub fn read(
        text: &str,
        problem: &Problem,
        reduced: &Reduced,
    ) -> Result<ForeignReport, ForeignError> {
        require_format(text, SOLUTIONS_FORMAT)?;
        let Object(raw): Object<Raw> = from_json(text)?;
        let expected = problem.sha256();
        if let Some(got) = raw.problem_sha256.filter(|d| *d != expected) {
            return Err(ForeignError::Digest {
                expected,
                got: got.chars().take(80).collect(),
            });
        }

        let numbered = raw.solutions.iter().enumerate();
        let solutions = numbered
            .map(|(k, Object(s))| solution(k, s, problem, reduced))
            .collect();
        Ok(ForeignReport {
            solutions,
            continua: raw.continua,
        })
    }
}

fn solution(
    k: usize,
    s: &RawSolution,
    problem: &Problem,
    reduced: &Reduced,
) -> Result<Reported, BadPoint> {
    let mut off = None;
    let exact: Vec<Rational> = match (&s.x, &s.v, problem.body()) {
        (Some(x), _, _) => {
            require_length(k, "x", reduced.pencil.order(), x.len())?;
            x.iter().map(|n| n.0.clone()).collect()
        }
        (None, Some(v), Body::System(system)) => {
            require_length(k, "v", system.dofs(), v.len())?;
            let v: Vec<Rational> = v.iter().map(|n| n.0.clone()).collect();
            let projected = project(&reduced.variables, &v);
            off = projected.off.map(|(dof, size)| Off {
                dof,
                size: to_f64(&size),
            });
            projected.x
        }
        (None, _, Body::System(_)) => {
            return Err(BadPoint::NoVector {
                solution: k,
                expected: "x or v",
            });
        }
        (None, _, Body::Pencil(_)) => {
            return Err(BadPoint::NoVector {
                solution: k,
                expected: "x",
            });
        }
    };
    if let Some(Off { dof, size }) = off.filter(|off| off.size > X_RADIUS) {
        return Err(BadPoint::OffConstraints { dof, size });
    }

    let value = normal_double(&s.value.0).ok_or(BadPoint::OutOfRange {
        solution: k,
        field: "value",
    })?;
    Ok(Reported {
        candidate: Candidate {
            value,
            x: scaled_doubles(&exact),
        },
        off,
    })
}

fn require_length(
    solution: usize,
    what: &'static str,
    expected: usize,
    got: usize,
) -> Result<(), BadPoint> {
    if got == expected {
        Ok(())
    } else {
        Err(BadPoint::Length {
            solution,
            what,
            expected,
            got,
        })
    }
}

/// The nearest double, where it has all its digits.
fn normal_double(v: &Rational) -> Option<f64> {
    let rounded = to_f64(v);
    if v.is_zero() || rounded.is_normal() {
        Some(rounded)
    } else {
        None
    }
}

/// x with its largest component 1, rounded after that: x may be given in any scale, also beyond the
/// doubles.
fn scaled_doubles(x: &[Rational]) -> Vec<f64> {
    let largest = x.iter().map(|v| v.abs()).max().filter(|v| !v.is_zero());
    match largest {
        Some(largest) => x.iter().map(|v| to_f64(&(v / &largest))).collect(),
        None => vec![0.0; x.len()],
    }
}
