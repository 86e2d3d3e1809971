//! What an enumeration has done so far, as a file: checkpoints and parts (`spec/enumeration.md`).
//!
//! No algebraic number has a file form: a record lists the supports that hold something, and the
//! exact code finds again what they hold.

use super::common::{CliError, text};
use super::output::Output;
use crate::exact::parse;
use crate::model::file::{from_json, require_format};
use crate::model::{ModelError, Problem, Window};
use crate::search::screen::{Part, Statistics, examine_exactly};
use crate::{model::Pencil, oracle::Enumeration};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;

/// The format of a checkpoint.
pub(super) const CHECKPOINT: &str = "mceip-checkpoint/1";
/// The format of a part of an enumeration.
pub(super) const PART: &str = "mceip-part/1";

/// Which enumerator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Engine {
    /// The oracle: every support by exact arithmetic.
    Plain,
    /// The screened enumerator: filters with proof, the oracle's code for what they leave.
    Screened,
}

impl Engine {
    pub(super) fn word(self) -> &'static str {
        match self {
            Engine::Plain => "plain",
            Engine::Screened => "screened",
        }
    }
}

/// A checkpoint or a part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Record {
    pub(super) format: String,
    pub(super) problem_sha256: String,
    pub(super) window: [Option<String>; 2],
    pub(super) engine: Engine,
    /// Supports of the problem, 2^n_s.
    pub(super) supports: u64,
    /// The supports wanted: first, and one past the last.
    pub(super) range: [u64; 2],
    /// One past the last support examined.
    pub(super) done: u64,
    /// The supports among them that hold something, ascending.
    pub(super) holders: Vec<u64>,
    /// What settled the supports examined (screened engine).
    pub(super) statistics: Option<Statistics>,
    /// The problem itself (parts only).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) problem: Option<serde_json::Value>,
    /// SHA-256 of this record with an empty checksum, against damage.
    pub(super) checksum: String,
}

/// Why a record is refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub(super) enum RecordError {
    /// Not readable as a record.
    #[error(transparent)]
    File(#[from] ModelError),
    /// It belongs to something else.
    #[error("{what}: expected {expected}, got {got}")]
    Mismatch {
        /// What differs.
        what: &'static str,
        /// What is wanted.
        expected: String,
        /// What the record says.
        got: String,
    },
    /// It contradicts itself.
    #[error("damaged: {what}")]
    Damaged {
        /// The contradiction.
        what: &'static str,
    },
    /// It lists a support on which the exact code finds nothing.
    #[error("support {support} is said to hold a solution and holds nothing")]
    EmptyHolder {
        /// The support, as a bit set.
        support: u64,
    },
}

impl Record {
    /// A record of an enumeration that has not begun.
    pub(super) fn new(problem: &Problem, engine: Engine, supports: u64, range: [u64; 2]) -> Record {
        Record {
            format: CHECKPOINT.into(),
            problem_sha256: problem.sha256(),
            window: window_text(problem.window()),
            engine,
            supports,
            range,
            done: range[0],
            holders: Vec::new(),
            statistics: (engine == Engine::Screened).then(Statistics::default),
            problem: None,
            checksum: String::new(),
        }
    }

    /// This record continued by a run of the screened engine from where it ended.
    pub(super) fn followed_by(&self, part: &Part) -> Record {
        let mut next = self.clone();
        next.done = part.range.end;
        next.holders.extend(&part.holders);
        if let Some(sum) = &mut next.statistics {
            *sum += part.statistics;
        }
        next
    }

    pub(super) fn is_finished(&self) -> bool {
        self.done == self.range[1]
    }

    /// Reads a record of the given format and checks that it does not contradict itself.
    pub(super) fn read(path: &Path, format: &'static str) -> Result<Record, CliError> {
        let content = text("the record", path)?;
        Record::parse(&content, format).map_err(|e| refused(path, e))
    }

    fn parse(content: &str, format: &'static str) -> Result<Record, RecordError> {
        require_format(content, format)?;
        let record: Record = from_json(content)?;
        let damaged = |what| Err(RecordError::Damaged { what });
        if record.checksum != record.sum() {
            return damaged("its checksum is not that of its content");
        }
        let [start, end] = record.range;
        if !record.supports.is_power_of_two() || start > end || end > record.supports || !(start..=end).contains(&record.done) {
            return damaged("its range, done and supports contradict each other");
        }
        if record.holders.windows(2).any(|w| w[0] >= w[1]) || record.holders.iter().any(|m| !(start..record.done).contains(m)) {
            return damaged("its holders are not an ascending list of supports examined");
        }
        if record.statistics.is_some_and(|s| s.total() != record.done - start) {
            return damaged("its statistics do not add up to the supports examined");
        }
        if record.statistics.is_some() != (record.engine == Engine::Screened) || record.problem.is_some() != (format == PART) {
            return damaged("it lacks a field or has one too many");
        }
        Ok(record)
    }

    /// Checks that this is a record of the same work as `wanted`, whatever has been done of it.
    pub(super) fn require_same(&self, wanted: &Record, with_range: bool) -> Result<(), RecordError> {
        let windows = [wanted, self].map(|r| r.window.clone().map(|w| w.unwrap_or_else(|| "infinity".into())).join(", "));
        let pairs = [
            ("problem_sha256", wanted.problem_sha256.clone(), self.problem_sha256.clone()),
            ("window", windows[0].clone(), windows[1].clone()),
            ("engine", wanted.engine.word().into(), self.engine.word().into()),
            ("supports", wanted.supports.to_string(), self.supports.to_string()),
            ("range", format!("{:?}", wanted.range), format!("{:?}", self.range)),
        ];
        match pairs.into_iter().find(|(what, expected, got)| expected != got && (with_range || *what != "range")) {
            Some((what, expected, got)) => Err(RecordError::Mismatch { what, expected, got: got.chars().take(80).collect() }),
            None => Ok(()),
        }
    }

    /// What the supports listed hold, found again by the exact code.
    pub(super) fn recompute(&self, pencil: &Pencil, window: &Window) -> Result<Enumeration, RecordError> {
        let mut found = examine_exactly(pencil, window, &self.holders).map_err(|support| RecordError::EmptyHolder { support })?;
        found.supports_total = self.supports;
        found.supports_done = self.done - self.range[0];
        Ok(found)
    }

    /// The record as JSON, with its checksum.
    pub(super) fn to_json(&self) -> String {
        let sealed = Record { checksum: self.sum(), ..self.clone() };
        // Strings, numbers and lists: serialisation cannot fail.
        serde_json::to_string(&sealed).unwrap_or_default() + "\n"
    }

    /// Writes the record to a file, whole or not at all.
    pub(super) fn save(&self, option: &'static str, path: &Path, inputs: &[&Path]) -> Result<(), CliError> {
        Output::prepare(option, path, inputs)?.write(&self.to_json())
    }

    fn sum(&self) -> String {
        let open = Record { checksum: String::new(), ..self.clone() };
        let digest = Sha256::digest(serde_json::to_string(&open).unwrap_or_default().as_bytes());
        digest.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// A refusal that names the file.
pub(super) fn refused(path: &Path, source: RecordError) -> CliError {
    CliError::Record { path: path.display().to_string(), source }
}

fn window_text(window: &Window) -> [Option<String>; 2] {
    [Some(window.min().to_string()), window.max().map(ToString::to_string)]
}

/// The window of a record.
pub(super) fn window_of(record: &Record) -> Result<Window, RecordError> {
    let bad = RecordError::Damaged { what: "its window is none" };
    let [Some(min), max] = &record.window else { return Err(bad) };
    let (Ok(min), max) = (parse(min), max.as_ref().map(|m| parse(m)).transpose()) else { return Err(bad) };
    match max {
        Ok(max) => Ok(Window::new(min, max)?),
        Err(_) => Err(bad),
    }
}
