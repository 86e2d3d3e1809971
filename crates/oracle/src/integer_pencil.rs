//! The pencil A + tB, or A + tB + t^2 C, with integer entries, and the linear algebra that
//! (24)-(26) ask of its blocks.
//!
//! Each row of the coefficients is multiplied by a positive integer that clears its denominators.
//! Neither the kernel of a block of rows and columns nor the sign of an entry of y = (A + tB) x
//! changes, and (24)-(26) speak of nothing else.
//!
//! A block is named by the list `active` of its rows and columns, ascending: the free variables and
//! the variables of a support. Vectors are lists of integer polynomials in t.
//!
//! Called by `plain` (one support after the other), `cone` (one support at one value), `range`
//! (supports whose block is singular for every t), and by makers of wrong answers.

use mceip_exact::{
    Algebraic, Dense, Integer, Poly, Sign, determinant, first_row_cofactors, kernel_at, submatrix,
};
use mceip_model::{Body, Pencil, Problem, QuadraticPencil, Reduced};

/// A pencil whose rows have been made integral, and its free variables.
pub struct IntegerPencil<'a> {
    /// Those of 1, t and, of a quadratic pencil, t^2.
    coefficients: Vec<Vec<Vec<Integer>>>,
    free: &'a [usize],
}

/// The kernel of a block at a root of its determinant.
pub(super) struct Eigenspace {
    pub(super) value: Algebraic,
    /// A basis of the kernel over the variables of the block, to be evaluated at `value`.
    pub(super) basis: Vec<Vec<Poly>>,
}

/// The pencil with each row times what clears its denominators.
impl<'a> From<&'a Pencil> for IntegerPencil<'a> {
    fn from(pencil: &'a Pencil) -> Self {
        let [a, b] = [pencil.a(), pencil.b()].map(|matrix| matrix.to_dense());
        IntegerPencil {
            coefficients: Dense::clear_rows([&a, &b]).into(),
            free: pencil.free(),
        }
    }
}

/// The same of a quadratic pencil, as it is given.
impl From<&QuadraticPencil> for IntegerPencil<'_> {
    fn from(quadratic: &QuadraticPencil) -> Self {
        let [a, b, c] = quadratic.coefficients().map(|matrix| matrix.to_dense());
        IntegerPencil {
            coefficients: Dense::clear_rows([&a, &b, &c]).into(),
            free: &[],
        }
    }
}

impl<'a> IntegerPencil<'a> {
    /// Of a problem: a quadratic pencil as it is given, else the reduced pencil.
    pub fn of(problem: &Problem, reduced: &'a Reduced) -> IntegerPencil<'a> {
        match problem.body() {
            Body::Quadratic(quadratic) => quadratic.into(),
            Body::Pencil(_) | Body::System(_) => (&reduced.pencil).into(),
        }
    }
}

impl IntegerPencil<'_> {
    /// Number of variables.
    pub fn order(&self) -> usize {
        self.coefficients[0].len()
    }

    /// Number of free variables.
    pub(super) fn free(&self) -> usize {
        self.free.len()
    }

    /// The complementarity variables, ascending.
    pub(super) fn complementarity_variables(&self) -> Vec<usize> {
        let all = 0..self.order();
        all.filter(|&i| self.is_complementarity(i)).collect()
    }

    /// Is variable i a complementarity variable, that is, not a free one?
    pub(super) fn is_complementarity(&self, i: usize) -> bool {
        self.free.binary_search(&i).is_err()
    }

    /// A bound, as a power of two, of every coefficient of the determinant of every block: its
    /// exponent.
    ///
    /// The determinant at |t| = 1 is at most prod_i (|a_i| + |b_i| + ...) over the rows (Hadamard's
    /// inequality), and so is each of its coefficients (Cauchy's estimate). The exponent is summed
    /// up row by row from (|a_i| + |b_i|)^2 <= 2 (|a_i|^2 + |b_i|^2), with 3 for three.
    pub(super) fn coefficient_bits(&self) -> u64 {
        let mut bits = 0;
        for i in 0..self.order() {
            let row = self.coefficients.iter().flat_map(|matrix| &matrix[i]);
            let square: Integer = row.map(|entry| entry * entry).sum();
            let bound: Integer = square * self.coefficients.len();
            bits += bound.bits().div_ceil(2);
        }

        bits
    }

    /// The free variables and those of the support, ascending.
    pub fn active(&self, support: &[usize]) -> Vec<usize> {
        let mut active = [self.free, support].concat();
        active.sort_unstable();
        active
    }

    /// Entry (i, j) of A + tB + ...
    fn entry(&self, i: usize, j: usize) -> Poly {
        let coefficients = self.coefficients.iter();
        Poly::new(coefficients.map(|matrix| matrix[i][j].clone()).collect())
    }

    /// The block of A + tB + ..., over `Z[t]`.
    pub fn block(&self, active: &[usize]) -> Vec<Vec<Poly>> {
        active
            .iter()
            .map(|&i| active.iter().map(|&j| self.entry(i, j)).collect())
            .collect()
    }

    /// The determinant of the block, a polynomial in t.
    pub fn determinant(&self, active: &[usize]) -> Poly {
        determinant(&self.coefficients_of(active))
    }

    /// The coefficients of the block.
    fn coefficients_of(&self, active: &[usize]) -> Vec<Vec<Vec<Integer>>> {
        let coefficients = self.coefficients.iter();
        coefficients
            .map(|matrix| submatrix(matrix, active, active))
            .collect()
    }

    /// The kernel of the block at each of the given roots of its determinant.
    ///
    /// The cofactors of the first row are in the kernel (Cramer's rule), for all roots at once.
    /// Where one of them is not zero, the rank is one less than the order and they span the kernel.
    /// They all vanish where the rank is less, and where the null vector from the left begins with
    /// 0, as for diag(1, 0). There the kernel is found by elimination at the root.
    pub(super) fn eigenspaces(&self, active: &[usize], roots: Vec<Algebraic>) -> Vec<Eigenspace> {
        if roots.is_empty() {
            return Vec::new();
        }

        let cofactors = first_row_cofactors(&self.coefficients_of(active));

        let mut eigenspaces = Vec::with_capacity(roots.len());
        for mut value in roots {
            let spans_kernel = cofactors.iter().any(|c| value.sign_of(c) != Sign::Zero);
            let basis = if spans_kernel {
                vec![cofactors.clone()]
            } else {
                kernel_at(self.block(active), &mut value)
            };
            eigenspaces.push(Eigenspace { value, basis });
        }

        eigenspaces
    }

    /// A vector over `active` as one over all variables, zero elsewhere.
    pub fn extend(&self, active: &[usize], vector: &[Poly]) -> Vec<Poly> {
        let mut x = vec![Poly::default(); self.order()];
        for (&i, x_i) in active.iter().zip(vector) {
            x[i] = x_i.clone();
        }
        x
    }

    /// y = (A + tB + ...) x.
    pub fn times(&self, x: &[Poly]) -> Vec<Poly> {
        let mut y = Vec::with_capacity(self.order());
        for i in 0..self.order() {
            let mut y_i = Poly::default();
            for (j, x_j) in x.iter().enumerate() {
                y_i += &(&self.entry(i, j) * x_j);
            }
            y.push(y_i);
        }

        y
    }

    /// The inequalities of (26) for a combination z of the basis vectors v_1, ..., v_k of a kernel:
    /// one row of coefficients for each x_i >= 0 on the support, then one for each y_i >= 0 off the
    /// block.
    pub(super) fn inequalities(&self, support: &[usize], basis: &[Vec<Poly>]) -> Vec<Vec<Poly>> {
        let active = self.active(support);
        let images: Vec<Vec<Poly>> = basis.iter().map(|v| self.times(v)).collect();

        let mut rows = Vec::new();

        for &i in support {
            rows.push(entries_of(basis, i));
        }

        for i in (0..self.order()).filter(|i| !active.contains(i)) {
            rows.push(entries_of(&images, i));
        }

        rows
    }
}

/// Entry i of each of the vectors.
pub(super) fn entries_of(vectors: &[Vec<Poly>], i: usize) -> Vec<Poly> {
    vectors.iter().map(|vector| vector[i].clone()).collect()
}
