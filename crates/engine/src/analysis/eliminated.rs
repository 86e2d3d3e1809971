//! Is A + mu B positive definite, where B has few rows? The other variables are eliminated once for
//! all mu.
//!
//! A and B are symmetric, s holds variables such that B_ff = 0 for the others f. Let F = A_ff,
//! C(mu) = A_fs + mu B_fs and D(mu) = A_ss + mu B_ss. With any W(mu), here a rounded value of
//! F^-1 C(mu), and R = C - F W,
//!
//! ```text
//!     P'(A + mu B) P = [ F   R ]      P = [ I  -W ]      Z = D - C'W - W'R.
//!                      [ R'  Z ],         [ 0   I ],
//! ```
//!
//! If F - sigma I is definite with sigma > 0, A + mu B is definite where Z - R'R / sigma is, and so
//! where
//!
//! ```text
//!     sigma Z - |R|^2 I
//! ```
//!
//! is, with the Frobenius norm of R. W = W0 + mu W1, so Z has degree two in mu, and |R|^2 is at
//! most 2 |R0|^2 + 2 mu^2 |R1|^2. Doubles propose W and sigma; everything else is exact.
//!
//! **Condensed.** Let A + mu B be the symmetric part of K* (16), with the free variables for f.
//! Then F = K_ff, and C(mu) = K_fs + mu R_f'/2 where R_f holds the columns f of the slip rows of
//! K1. The Schur complement D - C'F^-1 C is, coefficient by coefficient in mu,
//!
//! ```text
//!     sym T(mu) - (mu^2 / 4) R_f F^-1 R_f',     T(mu) = S + mu R_c the matrix of MCEIP-mu,
//! ```
//!
//! S and R_c as `condense` makes them. So the coefficients 1 and mu of Z are those of sym T but for
//! R'F^-1 R, of which |R0|^2 + 2 mu |R0||R1| bounds the same coefficients, and that is at most
//! 2 |R0|^2 + 2 mu^2 |R1|^2 again.
//!
//! Called by [`conditions`](super::conditions), which needs many values of mu.

use crate::search::complete::pieces::blocks::columns;
use crate::search::complete::pieces::skyline::Skyline;
use mceip_exact::{
    DefiniteError, Integer, Rational, Sparse, common_denominator, from_f64, positive_definite,
    truncated,
};
use num_traits::{One, Zero};

/// Bits of the largest entry of W.
const BITS_OF_W: i32 = 60;

/// Entries of a row, or of a column, that are not zero.
type SparseLine = Vec<(usize, Integer)>;

/// Z and |R|^2 as polynomials of mu, from integral A and B and W in units of 2^-e. So Z and |R|^2
/// are in units of 2^-2e.
pub(super) struct Eliminated {
    /// The coefficients of Z.
    z: [Sparse; 3],
    /// 2 |R0|^2 and 2 |R1|^2.
    residual: [Rational; 2],
    sigma: Rational,
}

impl Eliminated {
    /// Eliminates all variables but `kept`. `None` where B_ff is not zero, or F not shown to be
    /// definite.
    pub(super) fn of(a: &Sparse, b: &Sparse, kept: &[usize]) -> Option<Eliminated> {
        let eliminated: Vec<usize> = (0..a.rows()).filter(|i| !kept.contains(i)).collect();
        if b.submatrix(&eliminated, &eliminated).entries().count() > 0 {
            return None;
        }

        let block = a.submatrix(&eliminated, &eliminated);
        let skyline = Skyline::symmetric(&block);
        let sigma = from_f64(skyline.below_spectrum()?).ok()?;
        let identity = Sparse::identity(eliminated.len());
        positive_definite(&block.add_scaled(&-sigma.clone(), &identity)).ok()?;

        let factor = skyline.cholesky()?;
        let mut solutions = [a, b].map(|m| columns(&m.submatrix(&eliminated, kept)));
        for columns in &mut solutions {
            factor.solve_all(columns);
        }
        let unit = unit_of(solutions.iter().flatten().flatten())?;

        let entries = a.entries().chain(b.entries());
        let scale = Rational::from_integer(common_denominator(entries.map(|(_, _, v)| v)));
        let block = integral(&block, &scale);
        let [of_a, of_b] = &solutions;
        let [coupling_a, coupling_b] =
            [a, b].map(|m| integral(&m.submatrix(kept, &eliminated), &scale));
        let parts = [
            EliminatedPart::of(&block, coupling_a, of_a, unit)?,
            EliminatedPart::of(&block, coupling_b, of_b, unit)?,
        ];

        // D in the units of Z.
        let square_unit = Rational::from_integer(shifted(&Integer::one(), 2 * unit));
        let factor = &scale * square_unit;
        let none = Sparse::zeros(kept.len(), kept.len());
        let diagonal = [a, b].map(|m| none.add_scaled(&factor, &m.submatrix(kept, kept)));

        Some(Eliminated {
            z: schur(&parts, &diagonal, unit),
            residual: parts.each_ref().map(EliminatedPart::residual_bound),
            sigma: sigma * scale,
        })
    }

    /// `true` proves that A + mu B is positive definite; `false` says nothing.
    pub(super) fn is_definite_at(&self, mu: &Rational) -> bool {
        let [.., quadratic] = &self.z;
        let z = self.condensed_at(mu).add_scaled(&(mu * mu), quadratic);
        let less = self.beside(&z, &-self.residual_at(mu));

        positive_definite(&less).is_ok()
    }

    /// `true` proves that the condensed matrix sym T is positive definite at this mu; `false` says
    /// nothing.
    pub(super) fn is_condensed_definite_at(&self, mu: &Rational) -> bool {
        let less = self.beside(&self.condensed_at(mu), &-self.residual_at(mu));

        positive_definite(&less).is_ok()
    }

    /// `true` proves that sym T is not positive definite at this mu; `false` says nothing.
    pub(super) fn is_condensed_refuted_at(&self, mu: &Rational) -> bool {
        let more = self.beside(&self.condensed_at(mu), &self.residual_at(mu));

        matches!(positive_definite(&more), Err(DefiniteError::Not(_)))
    }

    /// The coefficients of sym T, but for the part of R'F^-1 R in them.
    pub(super) fn condensed(&self) -> [&Sparse; 2] {
        let [constant, linear, _] = &self.z;
        [constant, linear]
    }

    /// Sym T at mu, but for the same part.
    fn condensed_at(&self, mu: &Rational) -> Sparse {
        let [constant, linear] = self.condensed();
        constant.add_scaled(mu, linear)
    }

    /// A bound of |R|^2 at mu, in the units of sigma Z.
    fn residual_at(&self, mu: &Rational) -> Rational {
        let [of_a, of_b] = &self.residual;
        of_a + mu * mu * of_b
    }

    /// sigma Z + s I.
    fn beside(&self, z: &Sparse, s: &Rational) -> Sparse {
        let order = z.rows();
        Sparse::zeros(order, order)
            .add_scaled(&self.sigma, z)
            .add_scaled(s, &Sparse::identity(order))
    }
}

/// What belongs to A or to B: columns over the eliminated variables, one for each kept variable.
struct EliminatedPart {
    /// The columns of C.
    coupling: Vec<SparseLine>,
    /// W in units of 2^-e.
    w: Vec<Vec<Integer>>,
    /// R = C - F W in the same units.
    residual: Vec<Vec<Integer>>,
}

impl EliminatedPart {
    /// `block` holds the rows of F. `None` where a number of W is not finite.
    fn of(
        block: &[SparseLine],
        coupling: Vec<SparseLine>,
        solutions: &[Vec<f64>],
        unit: i32,
    ) -> Option<EliminatedPart> {
        let in_units = |v: &f64| truncated((v * f64::from(unit).exp2()).round());

        let mut w = Vec::with_capacity(coupling.len());
        let mut residual = Vec::with_capacity(coupling.len());
        for (given, solution) in coupling.iter().zip(solutions) {
            let column: Vec<Integer> = solution.iter().map(in_units).collect::<Option<_>>()?;

            let mut r = vec![Integer::zero(); column.len()];
            for (i, entry) in given {
                r[*i] = shifted(entry, unit);
            }
            for (r_i, row) in r.iter_mut().zip(block) {
                *r_i -= sparse_dot(row, &column);
            }

            w.push(column);
            residual.push(r);
        }

        Some(EliminatedPart {
            coupling,
            w,
            residual,
        })
    }

    /// 2 |R|^2.
    fn residual_bound(&self) -> Rational {
        let square: Integer = self.residual.iter().flatten().map(|v| v * v).sum();
        Rational::from_integer(square * 2)
    }

    /// (C'W + W'R)_ij with W and R of the other part, in units of 2^-2e.
    fn product(&self, other: &EliminatedPart, i: usize, j: usize, unit: i32) -> Integer {
        let of_coupling = sparse_dot(&self.coupling[i], &other.w[j]);
        let mut sum = shifted(&of_coupling, unit);
        for (w, r) in self.w[i].iter().zip(&other.residual[j]) {
            sum += w * r;
        }

        sum
    }
}

/// The coefficients of Z(mu) in units of 2^-2e, from those of D in the same units.
fn schur([of_a, of_b]: &[EliminatedPart; 2], [d_a, d_b]: &[Sparse; 2], unit: i32) -> [Sparse; 3] {
    let order = of_a.w.len();
    let constant = |i, j| of_a.product(of_a, i, j, unit);
    let linear = |i, j| of_a.product(of_b, i, j, unit) + of_b.product(of_a, i, j, unit);
    let quadratic = |i, j| of_b.product(of_b, i, j, unit);

    let minus_one = -Rational::one();
    [
        d_a.add_scaled(&minus_one, &symmetric(order, constant)),
        d_b.add_scaled(&minus_one, &symmetric(order, linear)),
        Sparse::zeros(order, order).add_scaled(&minus_one, &symmetric(order, quadratic)),
    ]
}

/// The symmetric matrix with these entries on and below the diagonal.
fn symmetric(order: usize, entry: impl Fn(usize, usize) -> Integer) -> Sparse {
    let mut entries = Vec::new();
    for i in 0..order {
        for j in 0..=i {
            let value = Rational::from_integer(entry(i, j));
            if i != j {
                entries.push((j, i, value.clone()));
            }
            entries.push((i, j, value));
        }
    }

    Sparse::from_entries(order, order, entries)
}

/// e for which the largest number has about [`BITS_OF_W`] bits, but at least 0.
fn unit_of<'a>(values: impl Iterator<Item = &'a f64>) -> Option<i32> {
    let mut largest = f64::MIN_POSITIVE;
    for v in values {
        largest = largest.max(v.abs());
    }

    let exponent = largest.log2().ceil();
    let unit = (f64::from(BITS_OF_W) - exponent).max(0.0);
    (unit <= f64::from(f64::MAX_EXP)).then_some(unit as i32)
}

/// v 2^e.
fn shifted(v: &Integer, unit: i32) -> Integer {
    v << unit.unsigned_abs()
}

fn sparse_dot(line: &SparseLine, column: &[Integer]) -> Integer {
    let mut sum = Integer::zero();
    for (j, v) in line {
        sum += v * &column[*j];
    }

    sum
}

/// The rows of `scale` A, which are integral.
fn integral(a: &Sparse, scale: &Rational) -> Vec<SparseLine> {
    let mut rows = Vec::with_capacity(a.rows());
    for i in 0..a.rows() {
        let scaled = |(j, v): &(usize, Rational)| (*j, (v * scale).to_integer());
        rows.push(a.row(i).iter().map(scaled).collect());
    }

    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// A chain of order 60, definite, and B in the rows and columns of the last two variables.
    fn chain() -> [Sparse; 2] {
        let order = 60;
        let mut entries = Vec::new();
        for i in 0..order {
            entries.push((i, i, rational(21, 10)));
            if i > 0 {
                entries.push((i, i - 1, whole(-1)));
                entries.push((i - 1, i, whole(-1)));
            }
        }
        let a = Sparse::from_entries(order, order, entries);

        let coupling = [(58, 57, 1), (58, 40, -2), (59, 59, -1), (59, 3, 1)];
        let mut entries = Vec::new();
        for (i, j, v) in coupling {
            entries.push((i, j, rational(v, 3)));
            if i != j {
                entries.push((j, i, rational(v, 3)));
            }
        }
        let b = Sparse::from_entries(order, order, entries);

        [a, b]
    }

    /// The largest mu, to 2^-40, at which exact LDL' proves definiteness.
    fn end(a: &Sparse, b: &Sparse) -> Rational {
        let mut below = whole(0);
        let mut step = whole(4);
        for _ in 0..42 {
            let mu = &below + &step;
            if positive_definite(&a.add_scaled(&mu, b)).is_ok() {
                below = mu;
            }
            step /= whole(2);
        }

        below
    }

    #[test]
    fn it_agrees_with_the_whole_matrix_next_to_the_end() {
        let [a, b] = chain();
        let end = end(&a, &b);
        assert!(end > rational(1, 2) && end < whole(3), "{end}");

        let eliminated = Eliminated::of(&a, &b, &[58, 59]).unwrap();

        let near = rational(1, 1 << 30);
        for mu in [whole(0), rational(1, 3), &end - &near] {
            assert!(eliminated.is_definite_at(&mu), "{mu}");
        }
        for mu in [&end + &near, &end + rational(1, 2), whole(100)] {
            assert!(!eliminated.is_definite_at(&mu), "{mu}");
        }
    }

    /// With W = 0, or too coarse, R is large, and what is proved stays true.
    #[test]
    fn a_bad_w_proves_less_and_nothing_false() {
        let [a, b] = chain();
        let end = end(&a, &b);
        let kept = [58, 59];
        let rest: Vec<usize> = (0..58).collect();
        let block = integral(&a.submatrix(&rest, &rest), &whole(30));
        let coupling = [&a, &b].map(|m| integral(&m.submatrix(&kept, &rest), &whole(30)));
        let zero = vec![vec![0.0; 58]; 2];

        let parts = coupling.map(|c| EliminatedPart::of(&block, c, &zero, 0).unwrap());
        let none = Sparse::zeros(2, 2);
        let diagonal = [&a, &b].map(|m| none.add_scaled(&whole(30), &m.submatrix(&kept, &kept)));
        let eliminated = Eliminated {
            z: schur(&parts, &diagonal, 0),
            residual: parts.each_ref().map(EliminatedPart::residual_bound),
            sigma: whole(3), // below the least eigenvalue of 30 F, which is 30 (0.1 + 0.003)
        };

        // Z = D = 30 [[2.1, -1], [-1, 2.1 - mu / 3]], and |R|^2 counts the couplings.
        assert_eq!(
            eliminated.z[0],
            Sparse::from_ints(&[&[63, -30], &[-30, 63]])
        );
        assert!(!eliminated.is_definite_at(&(end + rational(1, 1000))));
    }

    /// The form by hand: F = 4, C = 2 + 2 mu, D = 2. With W = C / 4 the residual is 0, and
    /// Z = 2 - (1 + mu)^2.
    #[test]
    fn a_system_by_hand() {
        let a = Sparse::from_ints(&[&[4, 2], &[2, 2]]);
        let b = Sparse::from_ints(&[&[0, 2], &[2, 0]]);

        let eliminated = Eliminated::of(&a, &b, &[1]).unwrap();

        let unit = Rational::from_integer(shifted(&Integer::one(), 2 * 61));
        let z = eliminated.z.each_ref().map(|z| z.get(0, 0) / &unit);
        assert_eq!(z, [whole(1), whole(-2), whole(-1)]);
        assert_eq!(eliminated.residual, [whole(0), whole(0)]);
        assert!(eliminated.is_definite_at(&rational(41, 100)));
        assert!(!eliminated.is_definite_at(&rational(42, 100)));

        let indefinite = Sparse::from_ints(&[&[-4, 2], &[2, 2]]);
        assert!(Eliminated::of(&indefinite, &b, &[1]).is_none());

        // B moves the variable that is to be eliminated.
        let everywhere = Sparse::from_ints(&[&[1, 2], &[2, 0]]);
        assert!(Eliminated::of(&a, &everywhere, &[1]).is_none());
    }
}
