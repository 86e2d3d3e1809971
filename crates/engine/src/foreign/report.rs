//! Reading a foreign `mceip-solutions/1` against the problem it is about.
//!
//! Each solution of the file becomes a candidate for the reduced pencil, or the reason why it is
//! none. Numbers are read exactly; where the report has v, x is its projection by (10). x is scaled
//! to largest |x_i| = 1 before it is rounded to doubles. Called by the command `check` and by the
//! conformance runner, which then [`judge`](super::judge) each solution.

use crate::candidate::{Candidate, SOLUTIONS_FORMAT, scaled_exactly};
use crate::reduction::project;
use crate::tolerance::X_RADIUS;
use mceip_exact::{Rational, to_f64};
use mceip_model::file::{Number, Object, from_json_of_with_unique_keys, require_format};
use mceip_model::{Body, ModelError, Problem, Reduced};
use mceip_oracle::GivenPencil;
use num_traits::Zero as _;
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
    #[error(
        "solutions[{solution}]: x is missing: expected {expected} (see spec/formats.md for their \
         order)"
    )]
    NoVector {
        /// Index in the report.
        solution: usize,
        /// What would do.
        expected: String,
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
    /// Lower and upper end of each interval.
    #[serde(deserialize_with = "objects")]
    pub intervals: Vec<ForeignInterval>,
}

/// An interval of values.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct ForeignInterval {
    /// Lower end; none where the interval reaches to -infinity.
    #[serde(deserialize_with = "optional")]
    pub from: Option<ForeignEnd>,
    /// Upper end; none where it reaches to infinity.
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
    /// Numbers of so many digits that reading them exactly takes too long.
    #[error(
        "numbers of the report: expected at most {limit} for the sum of their squared lengths, got \
         {got}; give fewer digits"
    )]
    Digits {
        /// The limit.
        limit: u64,
        /// The sum over the report.
        got: u64,
    },
    /// A report on another problem.
    #[error("the report names another problem: expected {expected}, got {got}")]
    Digest {
        /// Digest of the problem.
        expected: String,
        /// Digest in the report.
        got: String,
    },
}

/// A field that stands in JSON as an object, not as a list of its fields, or is null.
fn optional<'de, T, D>(deserializer: D) -> Result<Option<T>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    let value = Option::<Object<T>>::deserialize(deserializer)?;
    Ok(value.map(|Object(value)| value))
}

/// A list of such objects.
fn objects<'de, T, D>(deserializer: D) -> Result<Vec<T>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    let list = Vec::<Object<T>>::deserialize(deserializer)?;
    Ok(list.into_iter().map(|Object(value)| value).collect())
}

/// The file as it is.
#[derive(Deserialize)]
struct RawReport {
    problem_sha256: Option<String>,
    solutions: Vec<Object<RawSolution>>,
    #[serde(default, deserialize_with = "objects")]
    continua: Vec<ForeignContinuum>,
}

/// A solution as it is in the file: the value, and x or v.
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
        require_short_numbers(text)?;
        let raw: RawReport = from_json_of_with_unique_keys(SOLUTIONS_FORMAT, text)?;
        let expected = problem.sha256();
        if let Some(got) = raw.problem_sha256.filter(|d| *d != expected) {
            return Err(ForeignError::Digest {
                expected,
                got: got.chars().take(80).collect(),
            });
        }

        let mut solutions = Vec::new();
        for (index, Object(raw)) in raw.solutions.iter().enumerate() {
            solutions.push(reported(index, raw, problem, reduced));
        }

        Ok(ForeignReport {
            solutions,
            continua: raw.continua,
        })
    }
}

/// Sum of the squared lengths of the numbers of a report, at most: the time to bring them to lowest
/// terms grows like it, and is some three seconds here. Two numbers of 100,000 digits are read, and
/// tens of millions of those that doubles are printed with.
const MAX_SQUARES: u64 = 20_000_000_000;

/// Refuses a text whose numbers take too long to be read.
fn require_short_numbers(text: &str) -> Result<(), ForeignError> {
    let mut squares: u64 = 0;
    let is_of_no_number = |byte: &u8| !matches!(byte, b'0'..=b'9' | b'.' | b'/' | b'+' | b'-');
    for number in text.as_bytes().split(is_of_no_number) {
        let length = number.len() as u64;
        squares = squares.saturating_add(length.saturating_mul(length));
    }

    if squares > MAX_SQUARES {
        return Err(ForeignError::Digits {
            limit: MAX_SQUARES,
            got: squares,
        });
    }
    Ok(())
}

/// The candidate for the reduced pencil that a solution of the file stands for.
fn reported(
    index: usize,
    raw: &RawSolution,
    problem: &Problem,
    reduced: &Reduced,
) -> Result<Reported, BadPoint> {
    let given = given_x(index, raw, problem, reduced)?;
    if let Some(Off { dof, size }) = given.off.filter(|off| off.size > X_RADIUS) {
        return Err(BadPoint::OffConstraints { dof, size });
    }

    let value = normal_double(&raw.value.0).ok_or(BadPoint::OutOfRange {
        solution: index,
        field: "value",
    })?;
    let x = scaled_exactly(&given.x).unwrap_or_else(|| vec![0.0; given.x.len()]);
    let candidate = Candidate::given(problem, value, x);
    Ok(Reported {
        candidate: candidate.one_sided(&reduced.zero),
        off: given.off,
    })
}

/// The x of a solution, exactly as given or projected.
struct GivenX {
    x: Vec<Rational>,
    off: Option<Off>,
}

/// x where the file has it, else for a system the projection of v by (10).
fn given_x(
    index: usize,
    raw: &RawSolution,
    problem: &Problem,
    reduced: &Reduced,
) -> Result<GivenX, BadPoint> {
    let order = GivenPencil::of(problem, reduced).order();
    if let Some(x) = &raw.x {
        require_length(index, "x", order, x.len())?;
        let x = rationals(x);
        return Ok(GivenX { x, off: None });
    }

    let missing = |expected| BadPoint::NoVector {
        solution: index,
        expected,
    };
    let Body::System(system) = problem.body() else {
        return Err(missing(format!("x with {order} components")));
    };
    let Some(v) = &raw.v else {
        let dofs = system.dofs();
        return Err(missing(format!(
            "x with {order} components, or v with {dofs}"
        )));
    };
    require_length(index, "v", system.dofs(), v.len())?;
    let projected = project(&reduced.variables, &rationals(v));
    let off = projected.off.map(|(dof, size)| Off {
        dof,
        size: to_f64(&size),
    });
    Ok(GivenX {
        x: projected.x,
        off,
    })
}

fn rationals(numbers: &[Number]) -> Vec<Rational> {
    numbers.iter().map(|number| number.0.clone()).collect()
}

/// Demands a vector of the expected length.
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
