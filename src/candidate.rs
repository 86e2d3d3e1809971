//! A claimed solution in doubles: what solvers hand over, untrusted.

use crate::exact::{NumberError, to_f64};
use crate::model::ModelError;
use crate::model::file::{Number, from_json, require_format};
use serde::Deserialize;

/// The format of solution reports.
pub const SOLUTIONS_FORMAT: &str = "mceip-solutions/1";

/// A claimed solution: a value of the unknown and x over the variables of the pencil.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The value of lambda^2 or mu.
    pub value: f64,
    /// x, in any positive scale.
    pub x: Vec<f64>,
}

/// The few fields of `mceip-solutions/1` a foreign report must have; the others are not believed.
#[derive(Deserialize)]
struct Report {
    problem_sha256: Option<String>,
    solutions: Vec<ReportedSolution>,
}

#[derive(Deserialize)]
struct ReportedSolution {
    value: Number,
    x: Vec<Number>,
}

/// Candidates from a `mceip-solutions/1` report, and the digest it names, if any.
///
/// # Errors
/// [`ModelError`]: not JSON of this shape, another version, a number that cannot be read or lies
/// beyond the range of doubles.
pub fn read_report(text: &str) -> Result<(Option<String>, Vec<Candidate>), ModelError> {
    require_format(text, SOLUTIONS_FORMAT)?;
    let report: Report = from_json(text)?;
    let mut candidates = Vec::with_capacity(report.solutions.len());
    for (k, s) in report.solutions.iter().enumerate() {
        let double = |n: &Number, field: &str| {
            let v = to_f64(&n.0);
            if v.is_finite() {
                return Ok(v);
            }
            let source = NumberError::NotFinite { text: "a value beyond the range of doubles".into() };
            Err(ModelError::Number { place: format!("solutions[{k}].{field}"), source })
        };
        let x = s.x.iter().map(|n| double(n, "x")).collect::<Result<Vec<_>, _>>()?;
        candidates.push(Candidate { value: double(&s.value, "value")?, x });
    }
    Ok((report.problem_sha256, candidates))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_and_x_suffice() {
        let text = r#"{"format":"mceip-solutions/1","solver":"mine","solutions":[{"value":"1/2","x":[1e0,"0.25"],"slip":[0]}]}"#;
        let (digest, list) = read_report(text).unwrap();
        assert_eq!((digest, list), (None, vec![Candidate { value: 0.5, x: vec![1.0, 0.25] }]));
    }

    #[test]
    fn hostile_numbers_are_refused() {
        for text in [
            r#"{"format":"mceip-solutions/1","solutions":[{"value":1e999,"x":[1]}]}"#,
            r#"{"format":"mceip-solutions/1","solutions":[{"value":"nan","x":[1]}]}"#,
            r#"{"format":"mceip-solutions/2","solutions":[]}"#,
            r#"{"format":"mceip-solutions/1","solutions":[{"x":[1]}]}"#,
            "",
        ] {
            assert!(read_report(text).is_err(), "{text}");
        }
    }
}
