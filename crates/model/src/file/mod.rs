//! `mceip-problem/1`: reading and writing problem files, every number exactly as spelt; with the
//! same pieces `mceip-loads/1`, bodies under loads (`loads`).
//!
//! A file is text of bounded size (`read_text`), JSON of a known format (`format`), a
//! problem whose preconditions are established (`raw`). Each step refuses with a
//! [`ModelError`] that names the place. The format is specified in `spec/formats.md`.
//!
//! Other crates read their own formats with the same pieces: [`Number`], [`Object`], [`Word`].

mod format;
mod loads;
mod market;
mod matrix;
mod number;
mod object;
mod order;
mod private;
mod raw;
mod unique;
mod write;

pub use format::{
    from_json_of, from_json_of_with_unique_keys, require_format, to_json_of, to_pretty_json_of,
};
pub use loads::{LOADS_FORMAT, LoadsFile, read_loads};
pub use market::{FRACTIONS, read_matrix_market, read_printed_radius, write_matrix_market};
pub use number::Number;
pub use object::{HasWords, Object, Word, WordOrKind};
pub use order::{MAX_ORDER, require_order};
pub use write::{write_loads, write_problem, write_problem_beside_matrices, write_sparse};

use super::{Coordinates, ErrorLocation, ModelError, Problem, System, Unknown, Window};
use mceip_exact::Rational;
use std::io::Read as _;
use std::path::{Component, Path};
use unique::Unique;

/// The format this program reads and writes.
pub const PROBLEM_FORMAT: &str = "mceip-problem/1";
/// Largest file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Reads a problem from JSON text; Matrix Market files it names are looked for in `folder`.
///
/// # Errors
/// [`ModelError`] with the place, what was expected and what was found.
///
/// ```
/// use mceip_model::file::read_problem;
/// let text = r#"{"format": "mceip-problem/1", "unknown": "mu",
///                "pencil": {"a": [["1.1"]], "b": [[-1]], "free": []}}"#;
/// let problem = read_problem(text, std::path::Path::new(".")).unwrap();
/// assert_eq!(problem.unknown().word(), "mu");
/// assert!(read_problem("{}", std::path::Path::new(".")).is_err());
/// ```
pub fn read_problem(text: &str, folder: &Path) -> Result<Problem, ModelError> {
    let raw: raw::RawProblem = from_json_of(PROBLEM_FORMAT, text)?;
    raw.build(folder)
}

/// Reads a problem file.
///
/// # Errors
/// [`ModelError::Unreadable`], [`ModelError::TooLarge`], or what [`read_problem`] finds.
pub fn read_problem_file(path: &Path) -> Result<Problem, ModelError> {
    let text = read_text("the problem", path)?;
    read_problem(&text, folder_of(path))
}

/// A mechanical system as a problem file gives it, whatever is asked of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SystemFile {
    /// A name for people.
    pub name: Option<String>,
    /// What looked wrong when the file was made.
    pub warnings: Vec<String>,
    /// Where its nodes are.
    pub coordinates: Option<Coordinates>,
    /// What the file seeks.
    pub unknown: Unknown,
    /// Where the file seeks it.
    pub window: Window,
    /// The system; without friction where `friction` is 0, which a [`System`] with slip particles
    /// cannot have.
    pub system: System,
    /// mu of the file, 0 or positive.
    pub friction: Option<Rational>,
}

/// Reads the system of a problem file for questions that have an answer without a [`Problem`]: with
/// mu = 0, or with no particle in impending slip. All else that a problem file has to be is
/// established. `None` for a pencil.
///
/// # Errors
/// As [`read_problem`].
pub fn read_system(text: &str, folder: &Path) -> Result<Option<SystemFile>, ModelError> {
    let raw: raw::RawProblem = from_json_of(PROBLEM_FORMAT, text)?;
    raw.build_system(folder)
}

/// The folder in which a problem file looks for others.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().map_or(Path::new("."), or_here)
}

/// The folder of a plain file name is the empty path, which stands for the current folder.
fn or_here(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    }
}

/// Reads a JSON list of particles, each as in `system.particles` of a problem file.
///
/// # Errors
/// [`ModelError`] naming the particle.
pub fn read_particles(text: &str) -> Result<Vec<super::Particle>, ModelError> {
    raw::particles(from_json(text)?)
}

/// Reads a text file of bounded size.
///
/// # Errors
/// [`ModelError::Unreadable`] or [`ModelError::TooLarge`], naming what the file was wanted for.
pub fn read_text(what: &'static str, path: &Path) -> Result<String, ModelError> {
    let name = path.display().to_string();
    match std::fs::File::open(path) {
        Ok(file) => read_from(what, &name, file),
        Err(e) => Err(ModelError::Unreadable {
            what,
            path: name,
            problem: e.to_string(),
        }),
    }
}

/// Reads text of bounded size from an open file or a pipe; `name` stands for it in complaints.
///
/// # Errors
/// As [`read_text`].
pub fn read_from(
    what: &'static str,
    name: &str,
    source: impl std::io::Read,
) -> Result<String, ModelError> {
    read_at_most(MAX_FILE_BYTES, what, name, source)
}

fn read_at_most(
    limit: u64,
    what: &'static str,
    name: &str,
    source: impl std::io::Read,
) -> Result<String, ModelError> {
    // Bounded by what is read, not by what the directory says: devices and pipes have no length.
    let mut bounded = source.take(limit + 1);
    let mut text = String::new();
    let got = match bounded.read_to_string(&mut text) {
        Ok(bytes) => bytes as u64,
        Err(e) => {
            return Err(ModelError::Unreadable {
                what,
                path: name.to_string(),
                problem: e.to_string(),
            });
        }
    };

    if got > limit {
        return Err(ModelError::TooLarge {
            what: "file size in bytes",
            limit,
            got,
        });
    }

    Ok(text)
}

/// The path of a file that a problem names: beside the problem, a regular file.
///
/// # Errors
/// [`ModelError::Unreadable`] for absolute names, names with `..`, devices, folders and links out
/// of the folder.
pub(super) fn beside(
    what: &'static str,
    folder: &Path,
    name: &str,
) -> Result<std::path::PathBuf, ModelError> {
    let path = folder.join(name);

    let problem = if !Path::new(name).components().all(stays_below) {
        "expected a name beside the problem file"
    } else if path.exists() && !path.is_file() {
        "expected a regular file"
    } else if leads_out_of(or_here(folder), &path) {
        "expected a file beside the problem file, got a link out of its folder"
    } else {
        return Ok(path);
    };

    Err(ModelError::Unreadable {
        what,
        path: name.chars().take(200).collect(),
        problem: problem.into(),
    })
}

/// Is this component of a path neither a root nor `..`?
fn stays_below(component: Component<'_>) -> bool {
    matches!(component, Component::Normal(_) | Component::CurDir)
}

/// Is the path a link to a place outside of the folder? A path that does not exist is none.
fn leads_out_of(folder: &Path, path: &Path) -> bool {
    match (path.canonicalize(), folder.canonicalize()) {
        (Ok(real), Ok(real_folder)) => !real.starts_with(&real_folder),
        _ => false,
    }
}

/// Parses JSON into a type, turning the reader's complaint into a typed one with its place.
///
/// # Errors
/// [`ModelError::Json`].
pub fn from_json<'a, T: serde::Deserialize<'a>>(text: &'a str) -> Result<T, ModelError> {
    private::refuse_keys(text)?;
    serde_json::from_str(text).map_err(|e| complaint(text, &e))
}

/// [`from_json`] for formats that let unknown fields pass, or keep a part of a file as it is: a
/// text in which any object has a key twice is refused.
///
/// # Errors
/// [`ModelError::Json`].
///
/// ```
/// use mceip_model::file::{from_json, from_json_with_unique_keys};
/// let text = r#"{"problem": {"a": 1, "a": 2}}"#;
/// assert!(from_json::<serde_json::Value>(text).is_ok());
/// assert!(from_json_with_unique_keys::<serde_json::Value>(text).is_err());
/// ```
pub fn from_json_with_unique_keys<'a, T: serde::Deserialize<'a>>(
    text: &'a str,
) -> Result<T, ModelError> {
    private::refuse_keys(text)?;
    serde_json::from_str::<Unique>(text).map_err(|e| complaint(text, &e))?;
    serde_json::from_str(text).map_err(|e| complaint(text, &e))
}

/// The reader's complaint in one line of bounded length, its place as numbers.
fn complaint(text: &str, error: &serde_json::Error) -> ModelError {
    let full = error.to_string();
    // serde_json ends its messages with the place.
    let without_place = match full.rsplit_once(" at line ") {
        Some((head, _)) => head,
        None => &full,
    };

    let without_place = match without_place {
        "expected value" => format!("expected value{}", found_at(text, error)),
        other => other.to_owned(),
    };
    let problem = without_place
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .take(300)
        .collect();

    ModelError::Json {
        location: ErrorLocation {
            line: error.line(),
            column: error.column(),
        },
        problem,
    }
}

/// What stands where a value was expected, as a clause; empty where nothing does.
fn found_at(text: &str, error: &serde_json::Error) -> String {
    const LONGEST: usize = 24;

    let line = text.lines().nth(error.line().saturating_sub(1));
    let rest = line.and_then(|line| line.get(error.column().saturating_sub(1)..));
    let letters = rest.unwrap_or_default().chars();
    let ends_word = |c: &char| c.is_whitespace() || matches!(c, ',' | ']' | '}');
    let word: String = letters
        .take_while(|c| !ends_word(c))
        .take(LONGEST)
        .collect();
    match word.as_str() {
        "" => String::new(),
        "NaN" | "Infinity" => {
            format!(", got {word}, which is no number of JSON (leave out what has no value)")
        }
        matrix if matrix.starts_with("%%MatrixMarket") => {
            ", got a Matrix Market file (`mceip convert` makes a problem of matrices and contacts)"
                .to_owned()
        }
        other => format!(", got {other:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_in_place_of_a_value_is_named() {
        let complaint = |text: &str| {
            from_json::<serde_json::Value>(text)
                .unwrap_err()
                .to_string()
        };

        let of_nan = complaint("{\"value\":\n  [1, NaN, 2]}");
        assert!(of_nan.starts_with("line 2, column "), "{of_nan}");
        assert!(of_nan.contains("got NaN, which is no number"), "{of_nan}");
        assert!(complaint("%%MatrixMarket matrix\n1 1 1").contains("mceip convert"));
        assert!(complaint("loading numpy").contains("got \"loading\""));
        assert!(complaint("{\"value\": \u{e4}\u{f6}}").contains("expected value"));
    }

    #[test]
    fn a_table_of_contact_states_keeps_its_order() {
        use crate::{ContactState, Particle};
        let text = r#"[{"tangential": 1, "normal": 2, "state": "stick"},
                       {"tangential": 3, "normal": 0, "state": "slip", "sign": -1}]"#;

        let particles = read_particles(text);

        let expected = [
            Particle::plain(1, 2, ContactState::Stick),
            Particle::plain(3, 0, ContactState::Slip { sign: -1 }),
        ];

        assert_eq!(particles, Ok(expected.to_vec()));
        assert!(read_particles("[{}]").is_err());
    }

    /// As long as the limit, and one byte more of whatever length.
    #[test]
    fn sizes_are_bounded_by_what_is_read() {
        let read = |text: &'static str| read_at_most(3, "text", "-", text.as_bytes());
        assert_eq!(
            [read(""), read("abc")],
            [Ok(String::new()), Ok("abc".into())]
        );

        let refused = ModelError::TooLarge {
            what: "file size in bytes",
            limit: 3,
            got: 4,
        };

        assert_eq!(
            [read("abcd"), read("abcdefgh")],
            [Err(refused.clone()), Err(refused)]
        );

        assert!(matches!(
            read_at_most(3, "text", "-", &[0xff, 0xff][..]),
            Err(ModelError::Unreadable { what: "text", .. })
        ));
    }
}
