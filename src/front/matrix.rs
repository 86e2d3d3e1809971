//! Matrices from what callers have: doubles in rows, triplets or nalgebra, decimals, files.

use super::error::Error;
use mceip_exact::{NumberError, Rational, Sparse, from_f64, parse};
use mceip_model::ModelError;
use mceip_model::file::{read_matrix_market, read_text, require_order};
use std::path::Path;

/// A matrix of exact numbers.
///
/// A double stands for exactly the number that it is: 0.1 is
/// 3602879701896397 / 36028797018963968, and every proof is about that number. Where 1/10 is meant,
/// use [`Matrix::from_decimals`].
///
/// ```
/// use mceip::Matrix;
/// let rows = Matrix::from_rows(&[[2.0, -1.0], [-1.0, 2.0]])?;
/// let entries = [(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.0)];
/// assert_eq!(rows, Matrix::from_triplets(2, 2, entries)?);
/// assert!(Matrix::from_rows(&[[f64::NAN]]).is_err());
/// assert!(Matrix::from_triplets(usize::MAX, usize::MAX, []).is_err());
/// # Ok::<(), mceip::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Matrix(Sparse);

impl Matrix {
    /// A matrix by its rows.
    ///
    /// # Errors
    /// [`Error::Ragged`] for rows of different lengths, [`Error::Model`] for numbers that are not
    /// finite.
    pub fn from_rows<R: AsRef<[f64]>>(rows: &[R]) -> Result<Matrix, Error> {
        from_exact_rows(rows.iter().map(|row| exact_doubles(row.as_ref())))
    }

    /// A matrix of decimals or fractions ("0.1", "3e-4", "1/3"), each exactly the number it spells.
    ///
    /// # Errors
    /// [`Error::Ragged`] for rows of different lengths, [`Error::Model`] for text that is no
    /// number.
    pub fn from_decimals<R: AsRef<[S]>, S: AsRef<str>>(rows: &[R]) -> Result<Matrix, Error> {
        from_exact_rows(rows.iter().map(|row| exact_decimals(row.as_ref())))
    }

    /// A matrix by its entries (row, column, value), counted from 0. Entries at one place are
    /// added, without rounding, as in the assembly of finite elements.
    ///
    /// # Errors
    /// [`Error::Outside`] for an entry outside the matrix, [`Error::Model`] for a number that is
    /// not finite and an order beyond that of files.
    pub fn from_triplets(
        rows: usize,
        columns: usize,
        entries: impl IntoIterator<Item = (usize, usize, f64)>,
    ) -> Result<Matrix, Error> {
        require_order("the matrix", rows.max(columns))?;
        let mut exact = Vec::new();
        for (row, column, value) in entries {
            if row >= rows || column >= columns {
                return Err(Error::Outside {
                    row,
                    column,
                    rows,
                    columns,
                });
            }

            let value = from_f64(value).map_err(|source| number_at(row, column, source))?;
            exact.push((row, column, value));
        }

        Ok(Matrix(Sparse::from_entries(rows, columns, exact)))
    }

    /// A matrix from a Matrix Market file. Its numbers are read as the decimals they are.
    ///
    /// # Errors
    /// [`Error::Model`] with the place in the file.
    pub fn from_market(path: impl AsRef<Path>) -> Result<Matrix, Error> {
        let text = read_text("the matrix", path.as_ref())?;
        Ok(Matrix(read_matrix_market("the matrix", &text)?))
    }

    /// The unit matrix of order n.
    pub fn identity(n: usize) -> Matrix {
        Matrix(Sparse::identity(n))
    }

    /// The entries.
    pub fn into_exact(self) -> Sparse {
        self.0
    }
}

impl From<Sparse> for Matrix {
    fn from(exact: Sparse) -> Matrix {
        Matrix(exact)
    }
}

#[cfg(feature = "solver")]
impl TryFrom<&nalgebra::DMatrix<f64>> for Matrix {
    type Error = Error;

    /// The entries of a dense matrix of nalgebra.
    fn try_from(matrix: &nalgebra::DMatrix<f64>) -> Result<Matrix, Error> {
        let rows = matrix.nrows();
        let columns = matrix.ncols();
        let mut entries = Vec::new();
        for i in 0..rows {
            for j in 0..columns {
                entries.push((i, j, matrix[(i, j)]));
            }
        }

        Matrix::from_triplets(rows, columns, entries)
    }
}

fn number_at(row: usize, column: usize, source: NumberError) -> ModelError {
    let place = format!("entry ({row}, {column})");
    ModelError::Number { place, source }
}

/// A row of exact numbers, or the first entry that is none.
type ExactRow = Result<Vec<Rational>, NumberError>;

fn exact_doubles(row: &[f64]) -> ExactRow {
    row.iter().map(|value| from_f64(*value)).collect()
}

fn exact_decimals<S: AsRef<str>>(row: &[S]) -> ExactRow {
    row.iter().map(|text| parse(text.as_ref())).collect()
}

/// The matrix of these rows; all must be as long as the first one.
fn from_exact_rows(rows: impl Iterator<Item = ExactRow>) -> Result<Matrix, Error> {
    let mut entries = Vec::new();
    let mut count = 0;
    let mut width = 0;
    for (i, row) in rows.enumerate() {
        let row = row.map_err(|source| {
            let place = format!("row {i}");
            ModelError::Number { place, source }
        })?;
        if i == 0 {
            width = row.len();
        } else if row.len() != width {
            return Err(Error::Ragged {
                row: i,
                expected: width,
                got: row.len(),
            });
        }

        count += 1;
        for (j, value) in row.into_iter().enumerate() {
            entries.push((i, j, value));
        }
    }

    Ok(Matrix(Sparse::from_entries(count, width, entries)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    #[test]
    fn every_source_gives_the_same_matrix() {
        let rows = Matrix::from_rows(&[[2.0, 0.5], [0.0, -1.0]]).unwrap();

        let triplets = [(0, 0, 1.5), (1, 1, -1.0), (0, 1, 0.5), (0, 0, 0.5)];
        let decimals = [["2", "1/2"], ["0", "-1e0"]];

        assert_eq!(Matrix::from_triplets(2, 2, triplets).unwrap(), rows);
        assert_eq!(Matrix::from_decimals(&decimals).unwrap(), rows);
        assert_eq!(rows.into_exact().get(0, 1), rational(1, 2));
    }

    #[cfg(feature = "solver")]
    #[test]
    fn a_matrix_of_nalgebra_keeps_its_rows_and_columns() {
        let dense = nalgebra::dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0];

        let exact = Matrix::try_from(&dense).unwrap().into_exact();

        assert_eq!((exact.rows(), exact.cols()), (2, 3));
        assert_eq!(exact.get(0, 2), rational(3, 1));
    }

    #[test]
    fn a_double_is_the_number_it_is_and_a_decimal_the_one_it_spells() {
        let double = Matrix::from_rows(&[[0.1]]).unwrap().into_exact();
        let decimal = Matrix::from_decimals(&[["0.1"]]).unwrap().into_exact();

        assert_eq!(decimal.get(0, 0), rational(1, 10));
        assert!(double.get(0, 0) > rational(1, 10));
    }

    #[test]
    fn what_is_no_matrix_is_refused_with_its_place() {
        let ragged = message(Matrix::from_rows(&[vec![1.0, 2.0], vec![3.0]]));
        assert_eq!(ragged, "matrix: expected 2 numbers in row 1, got 1");

        let outside = message(Matrix::from_triplets(2, 2, [(0, 2, 1.0)]));
        let expected = "matrix: expected entries within 2 x 2, got one at (0, 2)";
        assert_eq!(outside, expected);

        let infinite = message(Matrix::from_triplets(2, 2, [(1, 0, f64::INFINITY)]));
        assert!(infinite.contains("(1, 0)"), "{infinite}");

        let word = message(Matrix::from_decimals(&[["1"], ["one"]]));
        assert!(word.contains("row 1") && word.contains("one"), "{word}");
    }

    fn message(refused: Result<Matrix, Error>) -> String {
        refused.unwrap_err().to_string()
    }
}
