//! A pencil in integers, and the linear algebra that the definition asks of its blocks.

use mceip_exact::{Algebraic, Integer, Poly, Sign, determinant, first_row_cofactors, kernel_at};
use mceip_model::Pencil;

/// The pencil with each row multiplied by a positive integer that clears its denominators.
pub(super) struct Integral<'a> {
    a: Vec<Vec<Integer>>,
    b: Vec<Vec<Integer>>,
    pub(super) free: &'a [usize],
}

impl<'a> Integral<'a> {
    pub(super) fn of(pencil: &'a Pencil) -> Self {
        let (a, b) = pencil.a().to_dense().clear_rows(&pencil.b().to_dense());
        Integral {
            a,
            b,
            free: pencil.free(),
        }
    }

    /// log2 of a bound of every coefficient of every determinant, rounded up: prod_i (|a_i| +
    /// |b_i|) over the rows. (Hadamard's inequality on |t| = 1 and Cauchy's estimate; (|a| + |b|)^2
    /// <= 2 (|a|^2 + |b|^2).)
    pub(super) fn coefficient_bits(&self) -> u64 {
        let square = |row: &Vec<Integer>| row.iter().map(|v| v * v).sum::<Integer>();
        let row_bits = |(a, b): (&Vec<Integer>, &Vec<Integer>)| {
            let twice: Integer = (square(a) + square(b)) * 2;
            twice.bits().div_ceil(2)
        };
        self.a.iter().zip(&self.b).map(row_bits).sum()
    }

    pub(super) fn order(&self) -> usize {
        self.a.len()
    }

    /// Entry (i, j) of A + tB.
    fn entry(&self, i: usize, j: usize) -> Poly {
        Poly::new(vec![self.a[i][j].clone(), self.b[i][j].clone()])
    }

    /// The free variables and the support, ascending.
    pub(super) fn active(&self, support: &[usize]) -> Vec<usize> {
        let mut active: Vec<usize> = self.free.iter().chain(support).copied().collect();
        active.sort_unstable();
        active
    }

    /// The rows and columns `active` of A + tB.
    pub(super) fn block(&self, active: &[usize]) -> Vec<Vec<Poly>> {
        active
            .iter()
            .map(|&i| active.iter().map(|&j| self.entry(i, j)).collect())
            .collect()
    }

    /// A and B on the rows and columns `active`.
    fn matrices(&self, active: &[usize]) -> [Vec<Vec<Integer>>; 2] {
        [&self.a, &self.b].map(|m| {
            active
                .iter()
                .map(|&i| active.iter().map(|&j| m[i][j].clone()).collect())
                .collect()
        })
    }

    /// The determinant of the block.
    pub(super) fn determinant(&self, active: &[usize]) -> Poly {
        let [a, b] = self.matrices(active);
        determinant(&a, &b)
    }

    /// The kernel of the block at each root of its determinant. Cramer's rule gives it for all
    /// roots at once where the rank is one less than the order; elimination at the root decides the
    /// rest.
    pub(super) fn kernels(
        &self,
        active: &[usize],
        roots: Vec<Algebraic>,
    ) -> Vec<(Algebraic, Vec<Vec<Poly>>)> {
        if roots.is_empty() {
            return Vec::new();
        }
        let [a, b] = self.matrices(active);
        let cofactors = first_row_cofactors(&a, &b);
        let kernel = |mut value: Algebraic| {
            let regular = cofactors.iter().any(|c| value.sign_of(c) != Sign::Zero);
            let kernel = if regular {
                vec![cofactors.clone()]
            } else {
                kernel_at(self.block(active), &mut value)
            };
            (value, kernel)
        };
        roots.into_iter().map(kernel).collect()
    }

    /// A vector over `active` as one over all variables.
    pub(super) fn extend(&self, active: &[usize], vector: &[Poly]) -> Vec<Poly> {
        let mut x = vec![Poly::default(); self.order()];
        for (&i, p) in active.iter().zip(vector) {
            x[i] = p.clone();
        }
        x
    }

    /// (A + tB) x.
    pub(super) fn times(&self, x: &[Poly]) -> Vec<Poly> {
        let row = |i: usize| {
            x.iter().enumerate().fold(Poly::default(), |sum, (j, x_j)| {
                &sum + &(&self.entry(i, j) * x_j)
            })
        };
        (0..self.order()).map(row).collect()
    }
}

/// Multiplicity of a root: the first derivative that does not vanish there.
pub(super) fn multiplicity(det: &Poly, value: &mut Algebraic) -> usize {
    let mut derivative = det.derivative();
    let mut m = 1;
    while !derivative.is_zero() && value.sign_of(&derivative) == Sign::Zero {
        derivative = derivative.derivative();
        m += 1;
    }
    m
}
