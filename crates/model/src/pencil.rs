//! The generic problem (A + tB) x = y, and the type that carries the hypotheses of Propositions 1
//! and 2.
//!
//! ```text
//! find t >= 0, x != 0:   y = (A + tB) x,   y_f = 0,   0 <= x_s _|_ y_s >= 0
//! ```
//!
//! with f the free and s the complementarity variables. A [`Pencil`] is any such problem; an
//! [`Admissible`] one is proved to satisfy what the mixed complementarity problems MCP-mu and
//! MCP-lambda2 need in order to find all of its solutions.

use super::ModelError;
use mceip_exact::{DefiniteError, Sparse, positive_definite};
use num_traits::Zero;

/// Which number is sought: t = lambda^2 in (12)-(14), t = mu in (21)-(23), or an eigenvalue of a
/// pencil without a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Unknown {
    /// MCEIP-lambda2: A = K*, B = M*, t = lambda^2.
    Lambda2,
    /// MCEIP-mu: A = K0, B = K1, t = mu.
    Mu,
    /// The eigenvalue complementarity problem: t of either sign, no free variables.
    Eigenvalue,
}

impl Unknown {
    /// The word used in files.
    pub fn word(self) -> &'static str {
        match self {
            Unknown::Lambda2 => "lambda2",
            Unknown::Mu => "mu",
            Unknown::Eigenvalue => "eigenvalue",
        }
    }

    /// The proposition that embeds this problem in an MCP.
    pub fn proposition(self) -> &'static str {
        match self {
            // Of eigenvalues only a linear form has free variables, and their block is definite.
            Unknown::Lambda2 | Unknown::Eigenvalue => "P2",
            Unknown::Mu => "P1",
        }
    }
}

/// The pencil A + tB of a mixed complementarity eigenproblem: find t >= 0 and x != 0 with
/// y = (A + tB) x, y_f = 0 and 0 <= x_s _|_ y_s >= 0 (equations (12)-(14) and (21)-(23)).
///
/// A and B are any square rational matrices of the same order; what needs a hypothesis asks for
/// [`Admissible`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pencil {
    a: Sparse,
    b: Sparse,
    free: Vec<usize>,
}

impl Pencil {
    /// The pencil (a, b) whose variables `free` (0-based, any order) have y = 0 and no sign.
    ///
    /// # Errors
    /// [`ModelError`] for shapes that do not fit, an order of zero, an index out of range or twice.
    pub fn new(a: Sparse, b: Sparse, free: Vec<usize>) -> Result<Self, ModelError> {
        let n = a.rows();
        require_square("E12", "a", &a, n)?;
        require_square("E12", "b", &b, n)?;
        if n == 0 {
            return Err(ModelError::Empty { what: "pencil" });
        }

        let free = sorted_indices("free", free, n)?;

        Ok(Pencil { a, b, free })
    }

    /// The matrix A.
    pub fn a(&self) -> &Sparse {
        &self.a
    }

    /// The matrix B.
    pub fn b(&self) -> &Sparse {
        &self.b
    }

    /// Order of the pencil, N* in the paper.
    pub fn order(&self) -> usize {
        self.a.rows()
    }

    /// Indices of the free variables, ascending.
    pub fn free(&self) -> &[usize] {
        &self.free
    }

    /// (A, -B): its solutions with the value s are those of this pencil with the value -s.
    #[must_use]
    pub fn reflected(&self) -> Pencil {
        Pencil {
            b: self.b.negated(),
            ..self.clone()
        }
    }

    /// Refuses free variables, which an eigenvalue problem has not.
    pub(super) fn require_no_free(&self) -> Result<(), ModelError> {
        match self.free.first() {
            None => Ok(()),
            Some(index) => Err(ModelError::Eigenvalue {
                got: format!("a pencil with the free variable {index}"),
            }),
        }
    }

    /// Indices of the complementarity variables, ascending: the impending-slip particles.
    pub fn slip(&self) -> Vec<usize> {
        (0..self.order())
            .filter(|i| self.free.binary_search(i).is_err())
            .collect()
    }
}

/// Sorts a list of indices below `limit`, each allowed once.
pub(super) fn sorted_indices(
    what: &'static str,
    mut list: Vec<usize>,
    limit: usize,
) -> Result<Vec<usize>, ModelError> {
    list.sort_unstable();
    if let Some(&index) = list.iter().find(|&&i| i >= limit) {
        return Err(ModelError::IndexOutOfRange { what, index, limit });
    }

    match list.windows(2).find(|w| w[0] == w[1]) {
        Some(w) => Err(ModelError::IndexTwice { what, index: w[0] }),
        None => Ok(list),
    }
}

/// A pencil that satisfies what Propositions 1 and 2 need, proved exactly:
/// A_ff symmetric positive definite; B_f = 0 for mu (equation (16)), B_ff symmetric positive
/// definite for lambda^2. Then every solution has x_s != 0, and the MCP finds all of them.
#[derive(Debug, Clone, Copy)]
pub struct Admissible<'a> {
    pencil: &'a Pencil,
    unknown: Unknown,
}

impl<'a> Admissible<'a> {
    /// Proves the hypotheses, by exact LDL'.
    ///
    /// # Errors
    /// [`ModelError::NotSymmetric`], [`ModelError::NotDefinite`] or [`ModelError::NotZero`] naming
    /// the proposition, the block and the index within the pencil; [`ModelError::Empty`] without
    /// complementarity variables (x_s could not be normalised).
    pub fn new(pencil: &'a Pencil, unknown: Unknown) -> Result<Self, ModelError> {
        if pencil.slip().is_empty() {
            return Err(ModelError::Empty {
                what: "the complementarity variables (P1, P2 normalise e'x_s)",
            });
        }

        let f = pencil.free();
        let a_ff = pencil.a.submatrix(f, f);

        match unknown {
            Unknown::Mu => {
                require_definite("P1", "A_ff (K_ff)", &a_ff)?;
                require_zero_rows(&pencil.b, f)?;
            }
            Unknown::Lambda2 | Unknown::Eigenvalue => {
                let b_ff = pencil.b.submatrix(f, f);
                require_definite("P2", "A_ff (K_ff)", &a_ff)?;
                require_definite("P2", "B_ff (M_ff)", &b_ff)?;
            }
        }

        Ok(Admissible { pencil, unknown })
    }

    /// The pencil itself.
    pub fn pencil(&self) -> &'a Pencil {
        self.pencil
    }

    /// The unknown whose hypotheses were proved.
    pub fn unknown(&self) -> Unknown {
        self.unknown
    }
}

/// Refuses a matrix of another shape than n x n, naming the equation that needs it.
pub(super) fn require_square(
    equation: &'static str,
    what: &'static str,
    m: &Sparse,
    n: usize,
) -> Result<(), ModelError> {
    if m.rows() == n && m.cols() == n {
        return Ok(());
    }

    Err(ModelError::Shape {
        equation,
        what,
        expected_rows: n,
        expected_cols: n,
        rows: m.rows(),
        cols: m.cols(),
    })
}

/// Refuses a matrix B with an entry in one of the rows f: K1 has none there. // (16)
fn require_zero_rows(b: &Sparse, f: &[usize]) -> Result<(), ModelError> {
    for &row in f {
        if let Some((col, value)) = b.row(row).iter().find(|(_, value)| !value.is_zero()) {
            return Err(ModelError::NotZero {
                equation: "E16",
                what: "B (K1)",
                row,
                col: *col,
                value: value.clone(),
            });
        }
    }

    Ok(())
}

/// Refuses a matrix that is not symmetric positive definite, naming who needs it.
pub(super) fn require_definite(
    equation: &'static str,
    what: &'static str,
    m: &Sparse,
) -> Result<(), ModelError> {
    require_symmetric(equation, what, m)?;

    match positive_definite(m) {
        Ok(()) => Ok(()),
        Err(DefiniteError::Not(refuted)) => Err(ModelError::NotDefinite {
            equation,
            what,
            index: refuted.index,
            pivot: refuted.pivot,
        }),
        Err(DefiniteError::Undecided { index }) => Err(ModelError::DefinitenessUndecided {
            equation,
            what,
            index,
        }),
    }
}

/// Refuses a matrix that differs from its transpose.
pub(super) fn require_symmetric(
    equation: &'static str,
    what: &'static str,
    m: &Sparse,
) -> Result<(), ModelError> {
    match m.first_asymmetry() {
        None => Ok(()),
        Some((row, col)) => Err(ModelError::NotSymmetric {
            equation,
            what,
            row,
            col,
            upper: m.get(row, col),
            lower: m.get(col, row),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Dense, Rational, whole};

    #[test]
    fn shapes_and_index_sets_are_checked() {
        let square = Sparse::from_ints(&[&[1, 0], &[0, 1]]);
        assert!(matches!(
            Pencil::new(square.clone(), Sparse::from_ints(&[&[1, 0]]), vec![]),
            Err(ModelError::Shape { what: "b", .. })
        ));
        assert!(matches!(
            Pencil::new(square.clone(), square.clone(), vec![2]),
            Err(ModelError::IndexOutOfRange {
                index: 2,
                limit: 2,
                ..
            })
        ));
        assert!(matches!(
            Pencil::new(square.clone(), square.clone(), vec![1, 1]),
            Err(ModelError::IndexTwice { index: 1, .. })
        ));
        assert!(matches!(
            Pencil::new(Sparse::zeros(0, 0), Sparse::zeros(0, 0), vec![]),
            Err(ModelError::Empty { .. })
        ));

        let pencil = Pencil::new(square.clone(), square, vec![1]).unwrap();
        assert_eq!((pencil.free(), pencil.slip()), (&[1][..], vec![0]));
    }

    #[test]
    fn hypotheses_are_proved_or_refused_by_name() {
        let a = Sparse::from_ints(&[&[1, 0], &[5, 2]]);
        let b = Sparse::from_ints(&[&[-1, 0], &[0, 1]]);
        let pencil = Pencil::new(a.clone(), b.clone(), vec![1]).unwrap();

        assert!(Admissible::new(&pencil, Unknown::Lambda2).is_ok());
        assert!(matches!(
            Admissible::new(&pencil, Unknown::Mu),
            Err(ModelError::NotZero { row: 1, col: 1, .. })
        ));

        let indefinite = Pencil::new(b, a, vec![0]).unwrap();
        let refused = Admissible::new(&indefinite, Unknown::Lambda2);
        assert!(matches!(
            refused,
            Err(ModelError::NotDefinite {
                equation: "P2",
                index: 0,
                pivot,
                ..
            }) if pivot == whole(-1)
        ));

        let all_free = Pencil::new(
            Sparse::from_ints(&[&[1]]),
            Sparse::from_ints(&[&[0]]),
            vec![0],
        )
        .unwrap();
        assert!(matches!(
            Admissible::new(&all_free, Unknown::Mu),
            Err(ModelError::Empty { .. })
        ));
    }

    #[test]
    fn dense_view_is_the_same_matrix() {
        let sparse = Sparse::from_ints(&[&[1, 2], &[3, 4]]);

        let dense = sparse.to_dense();

        let rows = vec![vec![whole(1), whole(2)], vec![whole(3), whole(4)]];
        assert_eq!(dense, Dense::from_rows(rows));
        assert_eq!(dense[(1, 0)], Rational::from_integer(3.into()));
    }
}
