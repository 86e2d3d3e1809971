//! Exact Schur complements of large banded matrices: modulo many primes, put together by the
//! Chinese remainder theorem, correct by Hadamard's bound.
//!
//! For integer F (n x n, regular), C, R, D the number det(F) (D - R F^-1 C)_ij is the determinant
//! of F bordered by row i and column j: an integer, at most the product of the rows' Euclidean
//! norms (Hadamard 1893). Known modulo primes whose product exceeds twice that bound, it is known.
//! So for one prime after the other:
//!
//! 1. F is eliminated modulo p, within its band, in the bordered matrix [F C; R D]; what is left of
//!    D is the Schur complement modulo p, and the product of the pivots is det(F). Where the first
//!    columns of the bordered matrix are symmetric, as those of a stiffness beside loads, only what
//!    is on the diagonal or right of it is computed;
//! 2. Garner's algorithm (Knuth, The Art of Computer Programming 2, section 4.3.2) adds the
//!    residues to the numbers known modulo the primes before.
//!
//! Input: rational blocks, cleared of their common denominator. Called by `engine` and `path`,
//! which condense the stiffness of a finite-element mesh to its contact nodes.

use super::prime::{Field, primes};
use super::{Integer, Rational, Sparse, cleared, common_denominator};
use num_integer::Integer as _;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Why a Schur complement is not computed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CondenseError {
    /// A block has the wrong shape.
    #[error("condensation: expected {what} to be {expected:?}, got {got:?}")]
    Shape {
        /// Which block.
        what: &'static str,
        /// Rows and columns wanted.
        expected: (usize, usize),
        /// Rows and columns found.
        got: (usize, usize),
    },
    /// A leading minor of F vanishes modulo so many primes that it is taken to be zero; elimination
    /// without pivoting needs them all (positive definite matrices have them).
    #[error(
        "condensation: expected non-zero leading minors, got a zero modulo each of {primes} primes"
    )]
    ZeroMinor {
        /// Primes tried in a row.
        primes: usize,
    },
}

/// Primes in a row at which a leading minor may vanish before it is given up. A non-zero minor
/// has at most (its bits) / 61 prime factors of 62 bits: chance plays no part below that many.
const MAX_SKIPPED: usize = 8;

/// D - R F^-1 C over Q, for F with non-zero leading minors (symmetric definite, say).
///
/// F is n x n, C is n x c, R is r x n, D is r x c. The matrix is exact whatever primes were used.
/// Cost: one banded elimination per 61 bits of Hadamard's bound.
///
/// # Errors
/// [`CondenseError`].
///
/// ```
/// use mceip_exact::{schur_complement, rational, whole, Sparse};
/// let one = |v| Sparse::from_entries(1, 1, [(0, 0, whole(v))]);
/// let s = schur_complement(&one(3), &one(1), &one(2), &one(5)).unwrap(); // 5 - 2 * 1/3
/// assert_eq!(s.get(0, 0), rational(13, 3));
/// ```
pub fn schur_complement(
    f: &Sparse,
    c: &Sparse,
    r: &Sparse,
    d: &Sparse,
) -> Result<Sparse, CondenseError> {
    let n = f.rows();
    require_shape("F", f, (n, n))?;
    require_shape("C", c, (n, c.cols()))?;
    require_shape("R", r, (r.rows(), n))?;
    require_shape("D", d, (r.rows(), c.cols()))?;

    let bordered = BorderedMatrix::new(f, c, r, d);
    let minors = bordered.minors()?;
    let det_f = &minors[0];

    let mut entries = Vec::new();

    for ((i, j), minor) in bordered.places().zip(&minors[1..]) {
        let quotient = Rational::new(minor.clone(), det_f.clone());
        let entry = quotient * &bordered.unit;
        if bordered.is_mirrored(i, j) {
            entries.push((j, i, entry.clone()));
        }
        entries.push((i, j, entry));
    }

    Ok(Sparse::from_entries(r.rows(), c.cols(), entries))
}

fn require_shape(
    what: &'static str,
    block: &Sparse,
    expected: (usize, usize),
) -> Result<(), CondenseError> {
    let got = (block.rows(), block.cols());
    if got != expected {
        return Err(CondenseError::Shape {
            what,
            expected,
            got,
        });
    }

    Ok(())
}

/// The integer matrix [F C; R D] in units of `unit`, as rows of (column, value).
struct BorderedMatrix {
    /// Order of F.
    n: usize,
    /// Columns of C and D.
    cols: usize,
    rows: Vec<Vec<(usize, Integer)>>,
    /// Largest |i - j| of F.
    band: usize,
    /// Whether entry (i, j) is entry (j, i) for all rows i and j.
    symmetric: bool,
    unit: Rational,
}

impl BorderedMatrix {
    fn new(f: &Sparse, c: &Sparse, r: &Sparse, d: &Sparse) -> BorderedMatrix {
        let n = f.rows();
        let mut rational = Vec::with_capacity(n + r.rows());

        for i in 0..n {
            rational.push(side_by_side(f.row(i), c.row(i), n));
        }

        for i in 0..r.rows() {
            rational.push(side_by_side(r.row(i), d.row(i), n));
        }

        // All entries as integers without a common factor, times the unit gcd / clear.
        let clear = common_denominator(rational.iter().flatten().map(|(_, entry)| entry));
        let mut gcd = Integer::zero();

        for (_, entry) in rational.iter().flatten() {
            gcd = gcd.gcd(&cleared(entry, &clear));
        }

        if gcd.is_zero() {
            gcd = Integer::one();
        }

        let rows = rational
            .iter()
            .map(|row| {
                row.iter()
                    .map(|(j, entry)| (*j, cleared(entry, &clear) / &gcd))
                    .collect()
            })
            .collect();

        let band = f.entries().map(|(i, j, _)| i.abs_diff(j)).max();
        BorderedMatrix {
            n,
            cols: c.cols(),
            band: band.unwrap_or(0),
            symmetric: is_symmetric(f, c, r, d),
            rows,
            unit: Rational::new(gcd, clear),
        }
    }

    /// The entries of D - R F^-1 C that are computed, row by row: of a symmetric matrix those on
    /// the diagonal and right of it.
    fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let border_rows = self.rows.len() - self.n;
        (0..border_rows).flat_map(move |i| {
            let first = if self.symmetric { i } else { 0 };
            (first..self.cols).map(move |j| (i, j))
        })
    }

    /// Whether entry (i, j) of D - R F^-1 C gives entry (j, i) as well.
    fn is_mirrored(&self, i: usize, j: usize) -> bool {
        let border_rows = self.rows.len() - self.n;
        self.symmetric && i < j && j < border_rows
    }

    /// det F, then det F (D - R F^-1 C) at each of the places.
    fn minors(&self) -> Result<Vec<Integer>, CondenseError> {
        let mut residues = Residues::new(1 + self.places().count());
        let bound = self.hadamard_bits() + 2; // the sign, and "exceeds"

        let mut skipped = 0;

        for p in primes() {
            if residues.bits() > bound {
                break;
            }
            match self.minors_modulo(p) {
                Some(values) => {
                    residues.add(p, &values);
                    skipped = 0;
                }
                None => skipped += 1,
            }
            if skipped > MAX_SKIPPED {
                return Err(CondenseError::ZeroMinor { primes: skipped });
            }
        }

        Ok(residues.symmetric())
    }

    /// An upper bound of log2 of every bordered determinant and of det F: the n rows of [F C] and
    /// the longest further row (or 1), each by its Euclidean norm.
    fn hadamard_bits(&self) -> u64 {
        let (inner, border) = self.rows.split_at(self.n);
        let inner_bits: u64 = inner.iter().map(|row| square_bits(row)).sum();
        let border_bits = border.iter().map(|row| square_bits(row)).max();

        let bits = inner_bits + border_bits.unwrap_or(0);
        bits.div_ceil(2)
    }

    /// [`BorderedMatrix::minors`] modulo p, or `None` if a leading minor vanishes modulo p.
    fn minors_modulo(&self, p: u64) -> Option<Vec<u64>> {
        let mut matrix = self.modulo(p);
        let det = matrix.eliminate(self.n, self.band, self.symmetric)?;

        let mut minors = vec![matrix.field.leave(det)];

        for (i, j) in self.places() {
            let entry = matrix.entries[(self.n + i) * matrix.width + self.n + j];
            let minor = matrix.field.mul(det, entry);
            minors.push(matrix.field.leave(minor));
        }

        Some(minors)
    }

    fn modulo(&self, p: u64) -> ModularMatrix {
        let field = Field::new(p);
        let width = self.n + self.cols;
        let mut entries = vec![0u64; self.rows.len() * width];

        for (i, row) in self.rows.iter().enumerate() {
            for (j, value) in row {
                entries[i * width + j] = field.enter(residue(value, p));
            }
        }

        ModularMatrix {
            field,
            width,
            entries,
        }
    }
}

/// A dense matrix modulo a prime, by rows, in Montgomery form.
struct ModularMatrix {
    field: Field,
    width: usize,
    entries: Vec<u64>,
}

impl ModularMatrix {
    /// Eliminates the first n columns below the diagonal, where the first n rows have entries
    /// within the band and in the columns from n on. Returns the product of the pivots, or `None`
    /// if one is zero.
    ///
    /// What is left of a symmetric matrix after each pivot is symmetric: with `symmetric`, entries
    /// left of the diagonal are neither read nor computed.
    fn eliminate(&mut self, n: usize, band: usize, symmetric: bool) -> Option<u64> {
        let width = self.width;
        let rows = self.entries.len().checked_div(width).unwrap_or(0);
        let field = &self.field;
        let mut det = field.enter(1);

        for k in 0..n {
            let pivot = self.entries[k * width + k];
            if pivot == 0 {
                return None;
            }
            det = field.mul(det, pivot);
            let inverse = field.invert(pivot);

            let end = (k + band + 1).min(n); // no fill outside the band
            let (above, below) = self.entries.split_at_mut((k + 1) * width);
            let pivot_row = &above[k * width..];
            for i in (k + 1..end).chain(n..rows) {
                let row = &mut below[(i - k - 1) * width..(i - k) * width];
                let in_pivot_column = if symmetric { pivot_row[i] } else { row[k] };
                if in_pivot_column == 0 {
                    continue;
                }
                let factor = field.mul(in_pivot_column, inverse);
                let first = if symmetric { i } else { k + 1 };
                for columns in [first.min(end)..end, first.max(n)..width] {
                    let above = &pivot_row[columns.clone()];
                    for (entry, above) in row[columns].iter_mut().zip(above) {
                        *entry = field.sub(*entry, field.mul(factor, *above));
                    }
                }
            }
        }

        Some(det)
    }
}

/// A row of two blocks, the second one n columns to the right.
fn side_by_side(
    left: &[(usize, Rational)],
    right: &[(usize, Rational)],
    n: usize,
) -> Vec<(usize, Rational)> {
    let mut row = left.to_vec();
    for (j, entry) in right {
        row.push((j + n, entry.clone()));
    }
    row
}

/// Whether [F C; R D] is symmetric but for columns of C and D beyond the rows of R and D.
fn is_symmetric(f: &Sparse, c: &Sparse, r: &Sparse, d: &Sparse) -> bool {
    if c.cols() < r.rows() {
        return false;
    }

    let inner: Vec<usize> = (0..f.rows()).collect();
    let border: Vec<usize> = (0..r.rows()).collect();
    let is_mirrored = c.submatrix(&inner, &border).transpose() == *r;

    let corner = d.submatrix(&border, &border);
    is_mirrored && f.first_asymmetry().is_none() && corner.first_asymmetry().is_none()
}

/// Bits of the square of a row's Euclidean norm.
fn square_bits(row: &[(usize, Integer)]) -> u64 {
    let square: Integer = row.iter().map(|(_, value)| value * value).sum();
    square.bits()
}

/// The number modulo p, between 0 and p - 1.
pub(super) fn residue(value: &Integer, p: u64) -> u64 {
    value.mod_floor(&p.into()).to_u64().unwrap_or(0)
}

/// Numbers known modulo a growing product of primes.
pub struct Residues {
    /// One number each, between 0 and the modulus.
    pub values: Vec<Integer>,
    /// The product of the primes so far.
    pub modulus: Integer,
}

impl Residues {
    /// As many zeros, modulo 1.
    pub fn new(count: usize) -> Self {
        Residues {
            values: vec![Integer::zero(); count],
            modulus: Integer::one(),
        }
    }

    /// floor(log2 modulus): the product exceeds 2^bits.
    pub fn bits(&self) -> u64 {
        self.modulus.bits() - 1
    }

    /// Garner's step: x + M ((a - x) / M mod p) is x modulo M and a modulo p.
    pub fn add(&mut self, p: u64, values: &[u64]) {
        let field = Field::new(p);
        let modulus = field.enter(residue(&self.modulus, p));
        let inverse = field.invert(modulus);

        for (x, &a) in self.values.iter_mut().zip(values) {
            let difference = field.sub(a, residue(x, p));
            let digit = field.leave(field.mul(field.enter(difference), inverse));
            *x += &self.modulus * digit;
        }

        self.modulus *= p;
    }

    /// The representatives of least absolute value.
    fn symmetric(self) -> Vec<Integer> {
        let half: Integer = &self.modulus >> 1;
        self.values
            .into_iter()
            .map(|x| if x.abs() > half { x - &self.modulus } else { x })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    /// D - R F^-1 C by elimination in fractions.
    fn plain(f: &Sparse, c: &Sparse, r: &Sparse, d: &Sparse) -> Sparse {
        let n = f.rows();
        let rows = n + r.rows();
        let width = n + c.cols();
        let mut m = vec![vec![whole(0); width]; rows];

        for i in 0..rows {
            for j in 0..width {
                m[i][j] = match (i < n, j < n) {
                    (true, true) => f.get(i, j),
                    (true, false) => c.get(i, j - n),
                    (false, true) => r.get(i - n, j),
                    (false, false) => d.get(i - n, j - n),
                };
            }
        }

        for k in 0..n {
            for i in k + 1..rows {
                let factor = &m[i][k] / &m[k][k];
                for j in k..width {
                    let update = &factor * &m[k][j];
                    m[i][j] -= update;
                }
            }
        }

        let mut entries = Vec::new();
        for i in n..rows {
            for j in n..width {
                entries.push((i - n, j - n, m[i][j].clone()));
            }
        }

        Sparse::from_entries(r.rows(), c.cols(), entries)
    }

    #[test]
    fn agrees_with_elimination_in_fractions() {
        let f = Sparse::from_ints(&[
            &[4, -1, 0, 2],
            &[-1, 5, 3, 0],
            &[0, 3, 6, -2],
            &[2, 0, -2, 9],
        ])
        .add_scaled(&rational(1, 7), &Sparse::identity(4));
        let c = Sparse::from_ints(&[&[1, 0], &[0, 2], &[-3, 1], &[5, 5]]);
        let r = Sparse::from_ints(&[&[1, 2, 3, 4], &[0, 0, 0, 1], &[-7, 0, 2, 0]]);
        let d = Sparse::from_ints(&[&[1, 0], &[0, 0], &[2, -9]]);

        let complement = schur_complement(&f, &c, &r, &d).unwrap();

        assert_eq!(complement, plain(&f, &c, &r, &d));
    }

    /// A stiffness beside a load: half of it is computed. With one entry that has no mirror image
    /// nothing is left out.
    #[test]
    fn symmetric_matrices_beside_further_columns() {
        let f = Sparse::from_ints(&[&[4, -1, 0], &[-1, 5, 3], &[0, 3, 6]]);
        let c = Sparse::from_ints(&[&[1, 0, 7], &[0, 2, 0], &[-3, 1, 5]]);
        let r = Sparse::from_ints(&[&[1, 0, -3], &[0, 2, 1]]);
        let d = Sparse::from_ints(&[&[8, 1, -2], &[1, 9, 0]]);
        let other_r = Sparse::from_ints(&[&[1, 0, -3], &[0, 2, 4]]);
        let other_d = Sparse::from_ints(&[&[8, 1, -2], &[3, 9, 0]]);

        assert!(is_symmetric(&f, &c, &r, &d));
        assert!(!is_symmetric(&f, &c, &other_r, &d));
        assert!(!is_symmetric(&f, &c, &r, &other_d));
        for (r, d) in [(&r, &d), (&other_r, &d), (&r, &other_d)] {
            let complement = schur_complement(&f, &c, r, d).unwrap();
            assert_eq!(complement, plain(&f, &c, r, d));
        }
    }

    #[test]
    fn a_determinant_divisible_by_the_first_prime_is_survived() {
        let p = Rational::from_integer(primes().next().unwrap().into());
        let f = Sparse::from_entries(2, 2, [(0, 0, p), (1, 1, whole(3))]);
        let c = Sparse::from_ints(&[&[1], &[1]]);
        let r = Sparse::from_ints(&[&[1, 1]]);
        let d = Sparse::from_ints(&[&[0]]);

        let complement = schur_complement(&f, &c, &r, &d).unwrap();

        assert_eq!(complement, plain(&f, &c, &r, &d));
    }

    #[test]
    fn empty_singular_and_misshapen() {
        let empty = [(0, 0), (0, 1), (1, 0)].map(|(rows, cols)| Sparse::zeros(rows, cols));
        let four = Sparse::from_ints(&[&[4]]);
        let complement = schur_complement(&empty[0], &empty[1], &empty[2], &four);
        assert_eq!(complement, Ok(four));

        let singular = Sparse::from_ints(&[&[1, 1], &[1, 1]]);
        let c = Sparse::from_ints(&[&[1], &[1]]);
        let r = Sparse::from_ints(&[&[1, 1]]);
        let d = Sparse::from_ints(&[&[0]]);
        assert!(matches!(
            schur_complement(&singular, &c, &r, &d),
            Err(CondenseError::ZeroMinor { .. })
        ));
        assert!(matches!(
            schur_complement(&singular, &r, &r, &d),
            Err(CondenseError::Shape { what: "C", .. })
        ));
    }

    #[test]
    fn a_singular_block_is_given_up_after_nine_primes() {
        let f = Sparse::from_ints(&[&[1, 1], &[1, 1]]);
        let c = Sparse::from_ints(&[&[1], &[1]]);
        let r = Sparse::from_ints(&[&[1, 1]]);
        let d = Sparse::from_ints(&[&[1]]);

        let refused = schur_complement(&f, &c, &r, &d);

        let primes = MAX_SKIPPED + 1;
        assert_eq!(refused, Err(CondenseError::ZeroMinor { primes }));
    }

    #[test]
    fn the_representative_of_least_absolute_value_is_taken() {
        let p = primes().next().unwrap();
        let mut residues = Residues::new(4);

        residues.add(p, &[(p - 1) / 2, (p - 1) / 2 + 1, 0, p - 1]);

        let half = Integer::from((p - 1) / 2);
        assert_eq!(
            residues.symmetric(),
            [half.clone(), -half, 0.into(), (-1).into()]
        );
    }
}
