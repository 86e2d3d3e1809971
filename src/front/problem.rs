//! A problem, from a file or from matrices, and the questions that can be put to it.

use super::error::Error;
use super::matrix::Matrix;
use mceip_check::certificate::Certificate;
use mceip_check::{Accepted, Rejected};
use mceip_exact::Rational;
use mceip_model::file::{read_problem, read_problem_file, write_problem};
use mceip_model::{Body, Particle, Pencil, QuadraticPencil, RealWindow, System, Unknown, Window};
use std::path::Path;

/// A mixed complementarity eigenproblem: find t and x != 0 with
///
/// ```text
/// (A + tB) x = y,   y_f = 0,   0 <= x_s _|_ y_s >= 0
/// ```
///
/// t is lambda^2, the square of a growth rate, (12)-(14), or a friction coefficient mu at which
/// there is a divergence with lambda = 0, (21)-(23), or an eigenvalue of either sign
/// ([`Problem::eicp`]). A and B come from a mechanical system or are given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem(mceip_model::Problem);

impl Problem {
    /// Reads a problem file (`mceip-problem/1`).
    ///
    /// # Errors
    /// [`Error::Model`] with the place in the file, what was expected and what was found.
    pub fn read(path: impl AsRef<Path>) -> Result<Problem, Error> {
        let problem = read_problem_file(path.as_ref())?;
        Ok(Problem(problem))
    }

    /// A problem from the text of a file. Matrix Market files that it names are looked for in the
    /// working directory.
    ///
    /// # Errors
    /// As [`Problem::read`].
    pub fn from_json(text: &str) -> Result<Problem, Error> {
        let working_directory = Path::new(".");
        let problem = read_problem(text, working_directory)?;
        Ok(Problem(problem))
    }

    /// Growth rates of a mechanical system at a friction coefficient: MCEIP-lambda2, (12)-(14).
    ///
    /// `stiffness` and `mass` are N x N over the degrees of freedom, symmetric; `contacts` are the
    /// particles that touch the obstacle, each with the degrees of freedom of its tangential and
    /// normal displacement. Units must agree: lambda^2 comes in those of stiffness / mass.
    ///
    /// # Errors
    /// [`Error::Model`]: shapes, symmetry, K_ff or M not positive definite, contacts that are none.
    ///
    /// ```
    /// use mceip::{ContactState, Matrix, Particle, Problem};
    /// let stiffness = Matrix::from_rows(&[[2.0, -1.0], [-1.0, 2.0]])?;
    /// let slips = Particle::plain(0, 1, ContactState::Slip { sign: 1 });
    /// let problem =
    ///     Problem::from_matrices(stiffness, Matrix::identity(2), "0.5".parse()?, vec![slips])?;
    /// assert_eq!(problem.unknown().word(), "lambda2");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_matrices(
        stiffness: Matrix,
        mass: Matrix,
        friction: Rational,
        contacts: Vec<Particle>,
    ) -> Result<Problem, Error> {
        let mass = Some(mass.into_exact());
        let system = System::new(stiffness.into_exact(), mass, Some(friction), contacts)?;
        Problem::new(Body::System(system), Unknown::Lambda2)
    }

    /// Friction coefficients at which there is a divergence with lambda = 0: MCEIP-mu, (21)-(23).
    /// The arguments are as in [`Problem::from_matrices`].
    ///
    /// # Errors
    /// As [`Problem::from_matrices`].
    pub fn friction_threshold(
        stiffness: Matrix,
        contacts: Vec<Particle>,
    ) -> Result<Problem, Error> {
        let system = System::new(stiffness.into_exact(), None, None, contacts)?;
        Problem::new(Body::System(system), Unknown::Mu)
    }

    /// The problem of a pencil A + tB, both n x n; `free` lists the indices f, for which x is
    /// unrestricted and y = 0. `unknown` says which conditions the solver relies on: those of
    /// Proposition 1 or of Proposition 2; for eigenvalues no variable is free.
    ///
    /// # Errors
    /// [`Error::Model`]: shapes, indices.
    pub fn from_pencil(
        a: Matrix,
        b: Matrix,
        free: Vec<usize>,
        unknown: Unknown,
    ) -> Result<Problem, Error> {
        let pencil = Pencil::new(a.into_exact(), b.into_exact(), free)?;
        Problem::new(Body::Pencil(pencil), unknown)
    }

    /// The eigenvalue complementarity problem of two n x n matrices: all t of either sign and
    /// x != 0 with
    ///
    /// ```text
    /// 0 <= x _|_ (t B - A) x >= 0
    /// ```
    ///
    /// ("Pareto eigenvalues", where B is the identity). Those of the other convention,
    /// 0 <= x _|_ (A - t B) x >= 0, are those of -A and -B.
    ///
    /// # Errors
    /// [`Error::Model`]: shapes.
    ///
    /// ```
    /// use mceip::{Matrix, Problem};
    /// let a = Matrix::from_rows(&[[8.0, -1.0], [3.0, 4.0]])?;
    /// let problem = Problem::eicp(a, Matrix::identity(2))?;
    /// assert_eq!(problem.window(), mceip::RealWindow::ALL);
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn eicp(a: Matrix, b: Matrix) -> Result<Problem, Error> {
        let minus_a = a.into_exact().negated();
        let pencil = Pencil::new(minus_a, b.into_exact(), Vec::new())?;
        Problem::new(Body::Pencil(pencil), Unknown::Eigenvalue)
    }

    /// The quadratic eigenvalue complementarity problem of three n x n matrices: all t of either
    /// sign and x != 0 with
    ///
    /// ```text
    /// 0 <= x _|_ (t^2 A + t B + C) x >= 0
    /// ```
    ///
    /// # Errors
    /// [`Error::Model`]: shapes.
    ///
    /// ```
    /// use mceip::{Matrix, Problem};
    /// // x = 1: t^2 - 3 t + 2 = 0.
    /// let [a, b, c] = [1.0, -3.0, 2.0].map(|v| Matrix::from_rows(&[[v]]));
    /// let problem = Problem::qeicp(a?, b?, c?)?;
    /// assert_eq!(problem.window(), mceip::RealWindow::ALL);
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn qeicp(a: Matrix, b: Matrix, c: Matrix) -> Result<Problem, Error> {
        let [a, b, c] = [a, b, c].map(Matrix::into_exact);
        let quadratic = QuadraticPencil::new(c, b, a)?;
        Problem::new(Body::Quadratic(quadratic), Unknown::Eigenvalue)
    }

    /// The problem over all values that the unknown can have.
    fn new(body: Body, unknown: Unknown) -> Result<Problem, Error> {
        let problem = mceip_model::Problem::new(body, unknown, Window::all())?;
        Problem(problem).in_window(None, None)
    }

    /// The same problem with the values sought in [min, max]; `None` is the lowest value that the
    /// unknown can have (0, for eigenvalues -infinity), and infinity.
    ///
    /// # Errors
    /// [`Error::Model`] for a max below min, and, but for eigenvalues, for a negative min; for a
    /// negative max, see `spec/formats.md`.
    pub fn in_window(
        self,
        min: impl Into<Option<Rational>>,
        max: Option<Rational>,
    ) -> Result<Problem, Error> {
        let window = match self.unknown() {
            Unknown::Lambda2 | Unknown::Mu => {
                let window = Window::new(min.into().unwrap_or_default(), max)?;
                RealWindow::from(&window)
            }
            Unknown::Eigenvalue => RealWindow::new(min.into(), max)?,
        };
        Ok(Problem(self.0.with_real_window(&window)))
    }

    /// Which number is sought.
    pub fn unknown(&self) -> Unknown {
        self.0.unknown()
    }

    /// Where it is sought.
    pub fn window(&self) -> RealWindow {
        self.0.real_window()
    }

    /// What looked wrong when the problem was made: `mceip convert` writes its warnings into the
    /// file, and an analysis repeats them. No answer depends on them.
    pub fn warnings(&self) -> &[String] {
        &self.0.warnings
    }

    /// The same problem with these warnings in place of its own.
    pub fn with_warnings(mut self, warnings: Vec<String>) -> Self {
        self.0.warnings = warnings;
        self
    }

    /// SHA-256 of the problem's canonical text: what certificates name, so that a proof cannot be
    /// shown for another problem.
    pub fn sha256(&self) -> String {
        self.0.sha256()
    }

    /// The problem as a file, `mceip-problem/1`.
    pub fn to_json(&self) -> String {
        write_problem(&self.0)
    }

    /// The problem as the parts of the library take it.
    pub fn as_model(&self) -> &mceip_model::Problem {
        &self.0
    }
}

impl From<mceip_model::Problem> for Problem {
    fn from(problem: mceip_model::Problem) -> Problem {
        Problem(problem)
    }
}

/// Checks a certificate against a problem, in exact arithmetic. Nothing else of this library has to
/// be trusted: whoever made the certificate, and however, an accepted one is a proof.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails: equation, index, expected, got.
pub fn check(problem: &Problem, certificate: &Certificate) -> Result<Accepted, Rejected> {
    mceip_check::check(&problem.0, certificate)
}
