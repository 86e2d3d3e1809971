//! `mceip-problem/1`: reading and writing problem files, every number exactly as spelt.

mod market;
mod matrix;
mod number;
mod object;
mod private;
mod raw;
mod write;

pub use market::read_matrix_market;
pub use number::Number;
#[doc(hidden)]
pub use object::word_or_kind;
pub use object::{Object, Word};
pub use write::{write_problem, write_sparse};

use super::{ErrorLocation, ModelError, Problem};
use std::io::Read as _;
use std::path::Path;

/// The format this program reads and writes.
pub const PROBLEM_FORMAT: &str = "mceip-problem/1";
/// Largest file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;
/// Largest order of a matrix that is read.
pub const MAX_ORDER: usize = 1_000_000;

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
    require_format(text, PROBLEM_FORMAT)?;
    let Object(raw): Object<raw::RawProblem> = from_json(text)?;
    raw.build(folder)
}

/// Reads a problem file.
///
/// # Errors
/// [`ModelError::Unreadable`], [`ModelError::TooLarge`], or what [`read_problem`] finds.
pub fn read_problem_file(path: &Path) -> Result<Problem, ModelError> {
    let text = read_text("the problem", path)?;
    read_problem(
        &text,
        path.parent()
            .filter(|p| !p.as_os_str().is_empty())
            .unwrap_or(Path::new(".")),
    )
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
    let unreadable = |e: std::io::Error| ModelError::Unreadable {
        what,
        path: name.to_string(),
        problem: e.to_string(),
    };
    let mut text = String::new();
    // Bounded by what is read, not by what the directory says: devices and pipes have no length.
    let got = source
        .take(limit + 1)
        .read_to_string(&mut text)
        .map_err(unreadable)? as u64;
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
    use std::path::Component;
    let refused = |problem: &str| ModelError::Unreadable {
        what,
        path: name.chars().take(200).collect(),
        problem: problem.into(),
    };
    if !Path::new(name)
        .components()
        .all(|c| matches!(c, Component::Normal(_) | Component::CurDir))
    {
        return Err(refused("expected a name beside the problem file"));
    }
    let path = folder.join(name);
    if path.exists() && !path.is_file() {
        return Err(refused("expected a regular file"));
    }
    // The folder of a plain file name is the empty path.
    let here = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    if let (Ok(real), Ok(real_folder)) = (path.canonicalize(), here.canonicalize())
        && !real.starts_with(&real_folder)
    {
        return Err(refused(
            "expected a file beside the problem file, got a link out of its folder",
        ));
    }
    Ok(path)
}

/// Checks the `format` field before anything else, so that another version is named as such.
///
/// # Errors
/// [`ModelError::Json`] if the text is no JSON object, [`ModelError::Format`] for another version.
pub fn require_format(text: &str, expected: &'static str) -> Result<(), ModelError> {
    #[derive(serde::Deserialize)]
    struct Header {
        format: Option<serde_json::Value>,
    }
    let Object(header): Object<Header> = from_json(text)?;
    match header.format {
        Some(serde_json::Value::String(s)) if s == expected => Ok(()),
        Some(other) => Err(ModelError::Format {
            expected,
            got: other.to_string().chars().take(60).collect(),
        }),
        None => Err(ModelError::Format {
            expected,
            got: "no format field".into(),
        }),
    }
}

/// Parses JSON into a type, turning the reader's complaint into a typed one with its place.
///
/// # Errors
/// [`ModelError::Json`].
pub fn from_json<'a, T: serde::Deserialize<'a>>(text: &'a str) -> Result<T, ModelError> {
    private::refuse_keys(text)?;
    serde_json::from_str(text).map_err(|e| {
        let full = e.to_string();
        // serde_json ends its messages with the place, which we carry as numbers.
        let problem = full
            .rsplit_once(" at line ")
            .map_or(full.as_str(), |(head, _)| head);
        let problem: String = problem
            .chars()
            .map(|c| if c.is_control() { ' ' } else { c })
            .take(300)
            .collect();
        ModelError::Json {
            location: ErrorLocation {
                line: e.line(),
                column: e.column(),
            },
            problem,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_contact_states_keeps_its_order() {
        use crate::{ContactState, Particle};
        let text = r#"[{"tangential": 1, "normal": 2, "state": "stick"}, {"tangential": 3, "normal": 0, "state": "slip", "sign": -1}]"#;
        let expected = [
            Particle::plain(1, 2, ContactState::Stick),
            Particle::plain(3, 0, ContactState::Slip { sign: -1 }),
        ];
        assert_eq!(read_particles(text), Ok(expected.to_vec()));
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
