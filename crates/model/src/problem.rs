//! A problem: a pencil or a mechanical system, the unknown, and the window.
//!
//! The question is always the same: for which t in the window is there an x != 0 with
//! y = (A + tB) x, y_f = 0 and 0 <= x_s _|_ y_s >= 0? A system has to be reduced to its pencil
//! first ([`crate::reduction::reduce`]).
//!
//! A problem is read from a file ([`crate::file::read_problem`]) or put together here.

use super::{
    Coordinates, ModelError, Pencil, QuadraticPencil, RealWindow, System, Unknown, Window,
    canonical,
};

/// What the eigenproblem is posed on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Body {
    /// A pencil given directly.
    Pencil(Pencil),
    /// A quadratic pencil, whose eigenvalues are sought.
    Quadratic(QuadraticPencil),
    /// A mechanical system, to be reduced by (10)-(16).
    System(System),
}

/// A mixed complementarity eigenproblem: (12)-(14) or (21)-(23).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// A name for people.
    pub name: Option<String>,
    /// A remark for people.
    pub comment: Option<String>,
    /// What looked wrong when the problem was made, for people: sentences without a full stop.
    pub warnings: Vec<String>,
    /// Where the nodes of a system are, for pictures.
    pub coordinates: Option<Coordinates>,
    unknown: Unknown,
    window: Window,
    /// The s >= 0 whose -s are wanted, of an eigenvalue problem.
    negative: Option<Window>,
    /// Is it the reflection of an eigenvalue problem?
    is_reflected: bool,
    body: Body,
}

impl Problem {
    /// A problem for the given unknown in the given window.
    ///
    /// # Errors
    /// [`ModelError`] where a system lacks what the unknown needs, and where a pencil has what an
    /// eigenvalue problem has not.
    pub fn new(body: Body, unknown: Unknown, window: Window) -> Result<Self, ModelError> {
        match &body {
            Body::System(system) => system.require_for(unknown)?,
            Body::Pencil(pencil) if unknown == Unknown::Eigenvalue => pencil.require_no_free()?,
            Body::Pencil(_) => {}
            Body::Quadratic(_) if unknown == Unknown::Eigenvalue => {}
            Body::Quadratic(_) => {
                return Err(ModelError::Quadratic {
                    got: unknown.word(),
                });
            }
        }

        Ok(Problem {
            name: None,
            comment: None,
            warnings: Vec::new(),
            coordinates: None,
            unknown,
            window,
            negative: None,
            is_reflected: false,
            body,
        })
    }

    /// The same problem with a name.
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The same problem in another window, of values that are not negative.
    pub fn with_window(mut self, window: Window) -> Self {
        self.window = window;
        self.negative = None;
        self
    }

    /// The same eigenvalue problem in another window.
    pub fn with_real_window(mut self, window: &RealWindow) -> Self {
        self.window = window.non_negative();
        self.negative = window.negative();
        self
    }

    /// Which number is sought.
    pub fn unknown(&self) -> Unknown {
        self.unknown
    }

    /// Is it the reflection of an eigenvalue problem, whose values are those with their sign
    /// changed?
    pub fn is_reflected(&self) -> bool {
        self.is_reflected
    }

    /// Where it is sought among the numbers that are not negative.
    pub fn window(&self) -> &Window {
        &self.window
    }

    /// Where it is sought.
    pub fn real_window(&self) -> RealWindow {
        RealWindow::joined(self.negative.as_ref(), &self.window)
    }

    /// The problem of (A, -B) whose values are those below 0, with their sign changed, and 0;
    /// `None` where none are wanted.
    pub fn reflected(&self) -> Option<Problem> {
        let window = self.negative.clone()?;
        let body = match &self.body {
            Body::Pencil(pencil) => Body::Pencil(pencil.reflected()),
            Body::Quadratic(quadratic) => Body::Quadratic(quadratic.reflected()),
            Body::System(_) => return None,
        };

        let mut reflected = self.clone().with_window(window);
        reflected.body = body;
        reflected.is_reflected = true;
        Some(reflected)
    }

    /// What it is posed on.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The same question of the body as given, without radii.
    #[must_use]
    pub fn as_given(&self) -> Problem {
        let mut given = self.clone();
        if let Body::System(system) = &mut given.body {
            *system = system.as_given();
        }

        given
    }

    /// Is it posed on one body, or on a pencil?
    pub fn is_exact(&self) -> bool {
        match &self.body {
            Body::Pencil(_) | Body::Quadratic(_) => true,
            Body::System(system) => system.is_exact(),
        }
    }

    /// The canonical text that the digest is taken of (`spec/formats.md`).
    pub fn canonical_text(&self) -> String {
        canonical::text(self)
    }

    /// SHA-256 of [`Problem::canonical_text`], in lower-case hexadecimal: what certificates and
    /// reports name, so that they are bound to these matrices.
    pub fn sha256(&self) -> String {
        canonical::sha256(&canonical::text(self))
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{read_problem, write_problem};
    use crate::{ModelError, Problem};
    use std::path::Path;

    fn read(warnings: &str) -> Result<Problem, ModelError> {
        let text = format!(
            r#"{{"format": "mceip-problem/1", "unknown": "mu", "warnings": {warnings},
                "pencil": {{"a": [[1]], "b": [[-1]]}}}}"#
        );
        read_problem(&text, Path::new("."))
    }

    #[test]
    fn warnings_are_read_written_and_no_part_of_the_digest() {
        let with = read(r#"["K and M", "a \"name\""]"#).unwrap();
        let without = read("[]").unwrap();
        assert_eq!(with.warnings, ["K and M", "a \"name\""]);

        let again = read_problem(&write_problem(&with), Path::new(".")).unwrap();
        assert_eq!(again, with);
        assert_eq!(with.sha256(), without.sha256());
        assert!(!write_problem(&without).contains("warnings"));
    }

    #[test]
    fn warnings_that_are_no_list_of_texts_are_refused() {
        for malformed in ["null", "{}", "[1]", "[null]", r#""K and M""#] {
            let refused = read(malformed);
            let is_malformed = matches!(refused, Err(ModelError::Json { .. }));
            assert!(is_malformed, "{malformed}: {refused:?}");
        }
    }
}
