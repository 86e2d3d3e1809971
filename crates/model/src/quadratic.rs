//! The quadratic eigenvalue complementarity problem (QEiCP), and the pencil that it is for t >= 0.
//!
//! ```text
//! find t, x != 0:   y = (A + tB + t^2 C) x,   0 <= x _|_ y >= 0
//! ```
//!
//! With z = x / (1 + t) the *linear form* has t alone, because t / (1 + t) = 1 - 1 / (1 + t) and
//! t^2 / (1 + t) = t - 1 + 1 / (1 + t):
//!
//! ```text
//! y / (1 + t) = ((B - C) + t C) x + (A - B + C) z,      0 = (1 + t) z - x
//! ```
//!
//! It has the variables x and then z, which are free, and for t >= 0 the same t, x and supports.
//! Its free block (1 + t) I satisfies what Proposition 2 asks for. (`spec/eigenvalues.md`, 11.5.)

use super::pencil::require_square;
use super::{ModelError, Pencil};
use mceip_exact::{Rational, Sparse};
use num_traits::One as _;

/// A + tB + t^2 C, square matrices of one order; all variables are complementarity variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QuadraticPencil {
    a: Sparse,
    b: Sparse,
    c: Sparse,
}

impl QuadraticPencil {
    /// The quadratic pencil (a, b, c).
    ///
    /// # Errors
    /// [`ModelError`] for shapes that do not fit, and an order of zero.
    pub fn new(a: Sparse, b: Sparse, c: Sparse) -> Result<QuadraticPencil, ModelError> {
        let n = a.rows();
        for (what, matrix) in [("a", &a), ("b", &b), ("c", &c)] {
            require_square("E12", what, matrix, n)?;
        }
        if n == 0 {
            return Err(ModelError::Empty { what: "pencil" });
        }

        Ok(QuadraticPencil { a, b, c })
    }

    /// A, B and C.
    pub fn coefficients(&self) -> [&Sparse; 3] {
        [&self.a, &self.b, &self.c]
    }

    /// Number of variables.
    pub fn order(&self) -> usize {
        self.a.rows()
    }

    /// (A, -B, C): its solutions with the value s are those of this pencil with the value -s.
    #[must_use]
    pub fn reflected(&self) -> QuadraticPencil {
        QuadraticPencil {
            b: self.b.negated(),
            ..self.clone()
        }
    }

    /// The pencil of order 2n that has the same solutions with t >= 0: x and then z, which are
    /// free.
    ///
    /// # Errors
    /// As [`Pencil::new`]; these shapes fit.
    pub fn linear_form(&self) -> Result<Pencil, ModelError> {
        let n = self.order();
        let one = Rational::one();
        let of_x = self.b.add_scaled(&-&one, &self.c);
        let of_z = self.a.add_scaled(&-&one, &of_x);

        let mut constant = Vec::new();
        let mut slope = Vec::new();
        for (i, j, value) in of_x.entries() {
            constant.push((i, j, value.clone()));
        }
        for (i, j, value) in of_z.entries() {
            constant.push((i, n + j, value.clone()));
        }
        for (i, j, value) in self.c.entries() {
            slope.push((i, j, value.clone()));
        }
        for i in 0..n {
            constant.push((n + i, i, -&one));
            constant.push((n + i, n + i, one.clone()));
            slope.push((n + i, n + i, one.clone()));
        }

        let [a, b] = [constant, slope].map(|list| Sparse::from_entries(2 * n, 2 * n, list));
        Pencil::new(a, b, (n..2 * n).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn quadratic() -> QuadraticPencil {
        let a = Sparse::from_ints(&[&[2, -1], &[3, 6]]);
        let b = Sparse::from_ints(&[&[-3, 1], &[0, 5]]);
        let c = Sparse::from_ints(&[&[1, 4], &[-2, 0]]);
        QuadraticPencil::new(a, b, c).unwrap()
    }

    /// (1 + t) times the first rows of the linear form are those of the quadratic pencil, and its
    /// last rows vanish, at values of x and t that determine the polynomials.
    #[test]
    fn the_linear_form_is_the_quadratic_pencil() {
        let quadratic = quadratic();
        let [a, b, c] = quadratic.coefficients();
        let linear = quadratic.linear_form().unwrap();
        assert_eq!((linear.free(), linear.slip()), (&[2, 3][..], vec![0, 1]));

        for t in [whole(0), whole(1), rational(7, 3), whole(100)] {
            for x in [[whole(1), whole(0)], [whole(2), rational(-5, 7)]] {
                let z = x.clone().map(|x_i| x_i / (whole(1) + &t));
                let both = [x.clone(), z].concat();
                let y = linear.a().add_scaled(&t, linear.b()).times(&both);

                let at_t = a.add_scaled(&t, b).add_scaled(&(&t * &t), c);
                let divided = at_t.times(&x).into_iter().map(|y_i| y_i / (whole(1) + &t));
                assert_eq!(y[..2], divided.collect::<Vec<_>>());
                assert_eq!(y[2..], [whole(0), whole(0)]);
            }
        }
    }

    #[test]
    fn the_reflected_pencil_has_the_values_with_their_sign_changed() {
        let quadratic = quadratic();
        let [a, b, c] = quadratic.coefficients();
        let reflected = quadratic.reflected();
        let [same_a, minus_b, same_c] = reflected.coefficients();
        assert_eq!((same_a, same_c), (a, c));
        assert_eq!(*minus_b, b.negated());
    }

    #[test]
    fn shapes_are_checked() {
        let square = Sparse::identity(2);
        for [a, b, c] in [[2, 2, 3], [2, 3, 2], [3, 2, 2]].map(|n| n.map(Sparse::identity)) {
            let refused = QuadraticPencil::new(a, b, c);
            assert!(matches!(refused, Err(ModelError::Shape { .. })));
        }
        let empty = || Sparse::zeros(0, 0);
        assert!(matches!(
            QuadraticPencil::new(empty(), empty(), empty()),
            Err(ModelError::Empty { .. })
        ));
        assert!(QuadraticPencil::new(square.clone(), square.clone(), square).is_ok());
    }
}
