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
//! Called by [`conditions`](super::conditions), which needs many values of mu.

use crate::search::complete::pieces::skyline::Skyline;
use mceip_exact::{
    Integer, Rational, Sparse, common_denominator, from_f64, positive_definite, to_f64, truncated,
};
use num_traits::Zero;

/// Bits of the largest entry of W.
const BITS_OF_W: i32 = 60;

/// Z and |R|^2 as polynomials of mu, from integral A and B and W in units of 2^-e. So Z and |R|^2
/// are in units of 2^-2e.
pub(super) struct Eliminated {
    /// The rows of Z, up to the diagonal, for each power of mu.
    z: [Vec<Vec<Integer>>; 3],
    /// 2 |R0|^2 and 2 |R1|^2.
    residual: [Integer; 2],
    sigma: Rational,
}

impl Eliminated {
    /// Eliminates all variables but `kept`, which have to be those in rows of B at least. `None`
    /// where F is not shown to be definite.
    pub(super) fn of(a: &Sparse, b: &Sparse, kept: &[usize]) -> Option<Eliminated> {
        let rest: Vec<usize> = (0..a.rows()).filter(|i| !kept.contains(i)).collect();
        let block = a.submatrix(&rest, &rest);
        let skyline = Skyline::symmetric(&block);
        let sigma = from_f64(skyline.below_spectrum()?).ok()?;

        let shift = Sparse::identity(rest.len());
        let shifted = block.add_scaled(&-sigma.clone(), &shift);
        positive_definite(&shifted).ok()?;

        let entries = a.entries().chain(b.entries());
        let scale = Rational::from_integer(common_denominator(entries.map(|(_, _, v)| v)));
        let block = integral(&block, &scale);
        let factor = skyline.cholesky()?;

        let mut columns = [a, b].map(|m| dense_rows(&m.submatrix(kept, &rest)));
        columns.iter_mut().for_each(|c| factor.solve_all(c));
        let unit = unit_of(columns.iter().flatten().flatten())?;

        let [of_a, of_b] = columns;
        let parts = [
            Part::of(
                &block,
                &integral(&a.submatrix(kept, &rest), &scale),
                &of_a,
                unit,
            )?,
            Part::of(
                &block,
                &integral(&b.submatrix(kept, &rest), &scale),
                &of_b,
                unit,
            )?,
        ];

        Some(Eliminated {
            z: schur(
                &parts,
                [a, b].map(|m| integral(&m.submatrix(kept, kept), &scale)),
                unit,
            ),
            residual: parts.each_ref().map(|part| part.square() * 2),
            sigma: sigma * scale,
        })
    }

    /// `true` proves that A + mu B is positive definite; `false` says nothing.
    pub(super) fn is_definite_at(&self, mu: &Rational) -> bool {
        let square = mu * mu;
        let residual = Rational::from_integer(self.residual[0].clone())
            + &square * Rational::from_integer(self.residual[1].clone());

        let [constant, linear, quadratic] = &self.z;
        let order = constant.len();
        let mut entries = Vec::new();
        for i in 0..order {
            for j in 0..=i {
                let [z_0, z_1, z_2] =
                    [constant, linear, quadratic].map(|z| Rational::from_integer(z[i][j].clone()));
                let z = z_0 + mu * z_1 + &square * z_2;

                if i == j {
                    entries.push((i, i, &self.sigma * z - &residual));
                } else {
                    let scaled = &self.sigma * z;
                    entries.push((j, i, scaled.clone()));
                    entries.push((i, j, scaled));
                }
            }
        }

        positive_definite(&Sparse::from_entries(order, order, entries)).is_ok()
    }
}

/// What belongs to A or to B: columns over the eliminated variables, one for each kept variable.
struct Part {
    /// The columns of C, without zeros.
    coupling: Vec<Vec<(usize, Integer)>>,
    /// W in units of 2^-e.
    w: Vec<Vec<Integer>>,
    /// R = C - F W in the same units.
    residual: Vec<Vec<Integer>>,
}

impl Part {
    /// `None` where a number of W is not finite.
    fn of(
        block: &[Vec<(usize, Integer)>],
        coupling: &[Vec<(usize, Integer)>],
        solution: &[Vec<f64>],
        unit: i32,
    ) -> Option<Part> {
        let mut w = Vec::with_capacity(coupling.len());
        let mut residual = Vec::with_capacity(coupling.len());
        for (given, column) in coupling.iter().zip(solution) {
            let rounded = |v: &f64| truncated((v * f64::from(unit).exp2()).round());
            let column: Vec<Integer> = column.iter().map(rounded).collect::<Option<_>>()?;

            let mut rest = vec![Integer::zero(); column.len()];
            for (i, entry) in given {
                rest[*i] = shifted(entry, unit);
            }
            for (rest_i, row) in rest.iter_mut().zip(block) {
                *rest_i -= sparse_dot(row, &column);
            }

            w.push(column);
            residual.push(rest);
        }

        Some(Part {
            coupling: coupling.to_vec(),
            w,
            residual,
        })
    }

    /// |R|^2.
    fn square(&self) -> Integer {
        self.residual.iter().flatten().map(|v| v * v).sum()
    }

    /// (C'W + W'R)_ij with W and R of the other part, in units of 2^-2e.
    fn product(&self, other: &Part, i: usize, j: usize, unit: i32) -> Integer {
        let of_coupling = sparse_dot(&self.coupling[i], &other.w[j]);
        let mut sum = shifted(&of_coupling, unit);
        for (w, r) in self.w[i].iter().zip(&other.residual[j]) {
            sum += w * r;
        }

        sum
    }
}

/// The coefficients of Z(mu), up to the diagonal, in units of 2^-2e.
fn schur(
    [of_a, of_b]: &[Part; 2],
    [d_a, d_b]: [Vec<Vec<(usize, Integer)>>; 2],
    unit: i32,
) -> [Vec<Vec<Integer>>; 3] {
    let mut z: [Vec<Vec<Integer>>; 3] = Default::default();
    for i in 0..of_a.w.len() {
        let mut rows: [Vec<Integer>; 3] = Default::default();
        for j in 0..=i {
            let mixed = of_a.product(of_b, i, j, unit) + of_b.product(of_a, i, j, unit);
            rows[0].push(shifted(&entry(&d_a[i], j), 2 * unit) - of_a.product(of_a, i, j, unit));
            rows[1].push(shifted(&entry(&d_b[i], j), 2 * unit) - mixed);
            rows[2].push(-of_b.product(of_b, i, j, unit));
        }

        for (z, row) in z.iter_mut().zip(rows) {
            z.push(row);
        }
    }

    z
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

fn entry(row: &[(usize, Integer)], column: usize) -> Integer {
    let found = row.iter().find(|(j, _)| *j == column);
    found.map_or_else(Integer::zero, |(_, v)| v.clone())
}

fn sparse_dot(row: &[(usize, Integer)], column: &[Integer]) -> Integer {
    let mut sum = Integer::zero();
    for (j, v) in row {
        sum += v * &column[*j];
    }

    sum
}

/// The rows of `scale` A, which are integral, without zeros.
fn integral(a: &Sparse, scale: &Rational) -> Vec<Vec<(usize, Integer)>> {
    let mut rows = Vec::with_capacity(a.rows());
    for i in 0..a.rows() {
        let scaled = |(j, v): &(usize, Rational)| (*j, (v * scale).to_integer());
        rows.push(a.row(i).iter().map(scaled).collect());
    }

    rows
}

/// The rows of A in doubles.
fn dense_rows(a: &Sparse) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; a.cols()]; a.rows()];
    for (i, j, v) in a.entries() {
        rows[i][j] = to_f64(v);
    }

    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use num_traits::One;

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

        let parts = coupling.map(|c| Part::of(&block, &c, &zero, 0).unwrap());
        let diagonal = [&a, &b].map(|m| integral(&m.submatrix(&kept, &kept), &whole(30)));
        let eliminated = Eliminated {
            z: schur(&parts, diagonal, 0),
            residual: parts.each_ref().map(|part| part.square() * 2),
            sigma: whole(3), // below the least eigenvalue of 30 F, which is 30 (0.1 + 0.003)
        };

        // Z = D = 30 diag(2.1, 2.1 - mu / 3), and |R|^2 counts the couplings.
        assert_eq!(
            eliminated.z[0],
            [vec![63.into()], vec![(-30).into(), 63.into()]]
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
        let z = eliminated
            .z
            .each_ref()
            .map(|z| Rational::from_integer(z[0][0].clone()) / &unit);
        assert_eq!(z, [whole(1), whole(-2), whole(-1)]);
        assert_eq!(eliminated.residual, [Integer::zero(), Integer::zero()]);
        assert!(eliminated.is_definite_at(&rational(41, 100)));
        assert!(!eliminated.is_definite_at(&rational(42, 100)));

        let indefinite = Sparse::from_ints(&[&[-4, 2], &[2, 2]]);
        assert!(Eliminated::of(&indefinite, &b, &[1]).is_none());
    }
}
