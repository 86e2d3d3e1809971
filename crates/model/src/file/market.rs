//! Matrix Market, read exactly. Our own reader because the libraries read values as doubles.
//!
//! The format (Boisvert, Pozo and Remington, The Matrix Market Exchange Formats, NISTIR 5935,
//! 1996): a banner, comments (`%`), a size line, and then one entry a line:
//!
//! ```text
//! %%MatrixMarket matrix coordinate real general      %%MatrixMarket matrix array real symmetric
//! rows columns entries                               rows columns
//! row column value                                   value, down the columns
//! ```
//!
//! Indices count from 1. A symmetric file holds the lower triangle. A value may also be a fraction
//! `p/q`, which other programs do not read.

use super::order::require_order;
use crate::ModelError;
use mceip_exact::{Integer, NumberError, Rational, Sparse, nearest_decimal, parse};
use num_traits::{One as _, Zero as _};
use std::collections::BTreeSet;

/// Reads a real or integer Matrix Market file, `coordinate` or `array`, `general` or `symmetric`;
/// decimals and fractions as exactly the value they spell. `what` names the matrix in complaints.
///
/// # Errors
/// [`ModelError::MatrixMarket`] with the line, what was expected and what stands there.
///
/// ```
/// use mceip_exact::rational;
/// use mceip_model::file::read_matrix_market;
/// let text = "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1.1\n2 1 -3e-1\n";
/// let m = read_matrix_market("K", text).unwrap();
/// assert_eq!((m.get(0, 0), m.get(0, 1)), (rational(11, 10), rational(-3, 10)));
/// ```
pub fn read_matrix_market(what: &'static str, text: &str) -> Result<Sparse, ModelError> {
    read(&Reader { what, value: parse }, text)
}

/// The radius of each entry of a Matrix Market file as printed: half a unit of its last digit, for
/// entries that are spelt out as zero too. A fraction is exact.
///
/// # Errors
/// As [`read_matrix_market`].
///
/// ```
/// use mceip_exact::rational;
/// use mceip_model::file::read_printed_radius;
/// let text = "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1.10\n2 1 -3e-1\n";
/// let r = read_printed_radius("K", text).unwrap();
/// assert_eq!((r.get(0, 0), r.get(0, 1)), (rational(1, 200), rational(1, 20)));
/// ```
pub fn read_printed_radius(what: &'static str, text: &str) -> Result<Sparse, ModelError> {
    let reader = Reader {
        what,
        value: half_a_unit,
    };
    read(&reader, text)
}

/// Half a unit of the last digit of a number.
fn half_a_unit(text: &str) -> Result<Rational, NumberError> {
    parse(text)?;
    if text.contains('/') {
        return Ok(Rational::zero());
    }

    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, after)| after.len());
    let exponent: i64 = exponent.parse().unwrap_or_default();
    parse(&format!("5e{}", exponent - decimals as i64 - 1))
}

fn read(reader: &Reader, text: &str) -> Result<Sparse, ModelError> {
    let mut lines = text.lines().enumerate().map(|(i, text)| (i + 1, text));
    let end = text.lines().count() + 1;

    let banner = reader.banner(lines.next().map_or("", |(_, text)| text))?;
    let mut lines =
        lines.filter(|(_, text)| words_of(text).next().is_some() && !text.starts_with('%'));
    let (line, size) = lines.next().unwrap_or((end, ""));
    let layout = reader.size_line(line, size, banner)?;

    let mut entries: Vec<(usize, usize, Rational)> = Vec::new();
    let mut seen = BTreeSet::new();
    let mut got = 0;

    for (line, text) in lines {
        if got == layout.count {
            let expected = "no more entries than the size line announces";
            return Err(reader.complain(line, expected, text));
        }
        let (i, j, value) = reader.entry(line, text, &layout, got)?;
        if !seen.insert((i, j)) {
            return Err(reader.complain(line, "each entry once", text));
        }
        if layout.banner.symmetric && i != j {
            entries.push((j, i, value.clone()));
        }
        entries.push((i, j, value));
        got += 1;
    }

    if got != layout.count {
        let expected = "as many entries as the size line announces";
        let found = format!("{got} of {}", layout.count);
        return Err(reader.complain(end, expected, &found));
    }

    Ok(Sparse::from_entries(layout.rows, layout.cols, entries))
}

/// The matrix as a coordinate file; a number without a finite decimal expansion as a fraction.
pub fn write_matrix_market(m: &Sparse) -> String {
    let mut lines = String::new();
    for (i, j, value) in m.entries() {
        lines += &format!("{} {} {}\n", i + 1, j + 1, exact_text(value));
    }

    let mut out = String::from("%%MatrixMarket matrix coordinate real general\n");
    if lines.contains('/') {
        out += FRACTIONS;
    }
    out += &format!("{} {} {}\n", m.rows(), m.cols(), m.entries().count());
    out + &lines
}

/// The comment of a file with fractions.
pub const FRACTIONS: &str = "% p/q is the fraction; other readers may take it for p\n";

/// The most digits of an exact decimal that is written: those of a double are fewer.
const EXACT_DIGITS: usize = 770;

/// A decimal that is exactly the number, or else a fraction.
fn exact_text(value: &Rational) -> String {
    let mut rest = value.denom().clone();
    for prime in [2u8, 5] {
        let prime = Integer::from(prime);
        while (&rest % &prime).is_zero() {
            rest /= &prime;
        }
    }
    if !rest.is_one() {
        return value.to_string();
    }

    for digits in [17, 60, EXACT_DIGITS] {
        let decimal = nearest_decimal(value, digits);
        if parse(&decimal).is_ok_and(|read| read == *value) {
            return decimal;
        }
    }
    value.to_string()
}

/// What the first line says.
#[derive(Clone, Copy)]
struct Banner {
    /// Entries with their indices, not all values in order.
    coordinate: bool,
    /// Whole numbers only.
    integer: bool,
    /// The lower triangle only.
    symmetric: bool,
}

/// How the entries of the file map to places of the matrix.
struct MarketLayout {
    banner: Banner,
    rows: usize,
    cols: usize,
    /// Number of entry lines.
    count: usize,
}

impl MarketLayout {
    /// Place of the k-th value of an array file: column by column, lower triangle if symmetric.
    fn place_in_array(&self, k: usize) -> (usize, usize) {
        if !self.banner.symmetric {
            return (k % self.rows, k / self.rows);
        }

        let mut below_diagonal = k;
        let mut column = 0;

        while below_diagonal >= self.rows - column {
            below_diagonal -= self.rows - column;
            column += 1;
        }

        (column + below_diagonal, column)
    }
}

/// The words of a line: blanks and tabs stand between them, and nothing else.
fn words_of(line: &str) -> impl Iterator<Item = &str> {
    line.split([' ', '\t']).filter(|word| !word.is_empty())
}

/// An index or a size: digits and nothing else.
fn index(word: &str) -> Option<usize> {
    let is_plain = word.bytes().all(|b| b.is_ascii_digit());
    if is_plain { word.parse().ok() } else { None }
}

/// An index of the file, which counts from 1, as one that counts from 0.
fn index_from_one(word: &str) -> Option<usize> {
    index(word)?.checked_sub(1)
}

/// Reads single lines and names the matrix in complaints.
struct Reader {
    what: &'static str,
    /// What stands for a word that spells a number.
    value: fn(&str) -> Result<Rational, NumberError>,
}

impl Reader {
    fn complain(&self, line: usize, expected: &'static str, got: &str) -> ModelError {
        let got = got.chars().filter(|c| !c.is_control()).take(60).collect();
        ModelError::MatrixMarket {
            what: self.what,
            line,
            expected,
            got,
        }
    }

    /// `%%MatrixMarket matrix {coordinate|array} {real|integer|double} {general|symmetric}`.
    fn banner(&self, line: &str) -> Result<Banner, ModelError> {
        let words: Vec<String> = words_of(line).map(str::to_lowercase).collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();

        match words[..] {
            [
                "%%matrixmarket",
                "matrix",
                layout @ ("coordinate" | "array"),
                field @ ("real" | "integer" | "double"),
                symmetry @ ("general" | "symmetric"),
            ] => Ok(Banner {
                coordinate: layout == "coordinate",
                integer: field == "integer",
                symmetric: symmetry == "symmetric",
            }),
            _ => Err(self.complain(
                1,
                "%%MatrixMarket matrix {coordinate|array} {real|integer} {general|symmetric}",
                line,
            )),
        }
    }

    /// `rows columns entries` of a coordinate file, `rows columns` of an array.
    fn size_line(
        &self,
        line: usize,
        text: &str,
        banner: Banner,
    ) -> Result<MarketLayout, ModelError> {
        let sizes = self.integers(line, text, if banner.coordinate { 3 } else { 2 })?;
        let rows = sizes[0];
        let cols = sizes[1];
        require_order(self.what, rows)?;
        require_order(self.what, cols)?;
        if banner.symmetric && rows != cols {
            return Err(self.complain(line, "a square size for a symmetric matrix", text));
        }

        let count = match (banner.coordinate, banner.symmetric) {
            (true, _) => sizes[2],
            (false, true) => rows * (rows + 1) / 2,
            (false, false) => rows * cols,
        };

        Ok(MarketLayout {
            banner,
            rows,
            cols,
            count,
        })
    }

    fn integers(&self, line: usize, text: &str, count: usize) -> Result<Vec<usize>, ModelError> {
        let numbers: Vec<usize> = words_of(text).map_while(index).collect();
        let words = words_of(text).count();

        if numbers.len() != count || words != count {
            return Err(self.complain(line, "a size line", text));
        }

        Ok(numbers)
    }

    /// The k-th entry line.
    fn entry(
        &self,
        line: usize,
        text: &str,
        layout: &MarketLayout,
        k: usize,
    ) -> Result<(usize, usize, Rational), ModelError> {
        let words: Vec<&str> = words_of(text).collect();
        let (i, j, value) = match words[..] {
            [i, j, value] if layout.banner.coordinate => {
                let (Some(i), Some(j)) = (index_from_one(i), index_from_one(j)) else {
                    return Err(self.complain(line, "1-based indices", text));
                };
                (i, j, value)
            }
            [value] if !layout.banner.coordinate => {
                let (i, j) = layout.place_in_array(k);
                (i, j, value)
            }
            _ if layout.banner.coordinate => {
                return Err(self.complain(line, "row column value", text));
            }
            _ => return Err(self.complain(line, "one value", text)),
        };

        if i >= layout.rows || j >= layout.cols {
            return Err(self.complain(line, "indices within the size", text));
        }

        if layout.banner.symmetric && i < j {
            return Err(self.complain(line, "the lower triangle of a symmetric matrix", text));
        }

        let of_number = |source| ModelError::Number {
            place: format!("{} line {line}", self.what),
            source,
        };
        let given = parse(value).map_err(of_number)?;
        if layout.banner.integer && !given.is_integer() {
            return Err(self.complain(line, "an integer, as line 1 says (or `real` there)", text));
        }
        let value = (self.value)(value).map_err(of_number)?;

        Ok((i, j, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    const HEAD: &str = "%%MatrixMarket matrix coordinate real general\n";

    #[test]
    fn arrays_run_down_the_columns() {
        let m = read_matrix_market(
            "K",
            "%%MatrixMarket matrix array real general\n% c\n2 2\n1\n2\n3\n4\n",
        )
        .unwrap();
        assert_eq!((m.get(1, 0), m.get(0, 1)), (whole(2), whole(3)));
        let s = read_matrix_market(
            "K",
            "%%MatrixMarket matrix array integer symmetric\n2 2\n1\n2\n3\n",
        )
        .unwrap();
        assert_eq!((s.get(0, 1), s.get(1, 1)), (whole(2), whole(3)));
        let wide = read_matrix_market(
            "K",
            "%%MatrixMarket matrix array real general\n2 3\n1\n2\n3\n4\n5\n6\n",
        )
        .unwrap();
        assert_eq!((wide.get(1, 1), wide.get(0, 2)), (whole(4), whole(5)));
    }

    #[test]
    fn a_file_of_integers_holds_no_fraction() {
        let of_integers = HEAD.replace("real", "integer");
        let read = |value| read_matrix_market("K", &format!("{of_integers}1 1 1\n1 1 {value}\n"));

        assert_eq!(read("20e-1").unwrap().get(0, 0), whole(2));
        for value in ["1.5", "1e-1"] {
            let message = read(value).unwrap_err().to_string();
            assert!(message.contains("an integer, as line 1 says"), "{message}");
        }
    }

    /// Decimals where there are, so that other programs read the file; 1/3 has none.
    #[test]
    fn what_is_written_is_read_back() {
        let double = mceip_exact::from_f64(0.1).unwrap();
        let values = [whole(0), whole(-7), rational(1, 8), rational(1, 3), double];
        let entries = values
            .into_iter()
            .enumerate()
            .map(|(k, v)| (k / 3, k % 3, v));
        let m = Sparse::from_entries(2, 3, entries);

        let text = write_matrix_market(&m);
        assert!(
            text.contains("\n1 3 0.125\n2 1 1/3\n2 2 0.1000000000000000055511"),
            "{text}"
        );
        let read = read_matrix_market("K", &text).unwrap();
        assert!(read.entries().eq(m.entries()));
        assert_eq!((read.rows(), read.cols()), (2, 3));
    }

    /// Lines end in LF or in CR LF; a CR alone is part of a word.
    #[test]
    fn a_cr_alone_ends_no_line() {
        let banner = "%%MatrixMarket matrix array real general";

        let with_crlf = format!("{banner}\r\n1 1\r\n7\r\n");
        assert_eq!(
            read_matrix_market("K", &with_crlf).unwrap().get(0, 0),
            whole(7)
        );

        let with_cr_at_the_end = format!("{banner}\n1 1\n7\r");
        let refused = read_matrix_market("K", &with_cr_at_the_end);
        assert!(
            matches!(refused, Err(ModelError::Number { .. })),
            "{refused:?}"
        );
    }

    /// As many numbers as asked for and nothing else; what is quoted is fit for a terminal.
    #[test]
    fn size_lines_are_numbers_only() {
        let reader = Reader {
            what: "K",
            value: parse,
        };
        assert_eq!(reader.integers(2, " 3 4 ", 2).unwrap(), [3, 4]);
        for text in ["3", "3 4 5", "3 4 x", "3 x", "x 3 4", "3 x 4"] {
            assert!(reader.integers(2, text, 2).is_err(), "{text}");
        }

        let ModelError::MatrixMarket { got, .. } =
            reader.complain(2, "a size line", "a\u{1b}[2Jb\u{7}")
        else {
            panic!()
        };

        assert_eq!(got, "a[2Jb");
    }

    #[test]
    fn decimals_are_exact() {
        let m = read_matrix_market("K", &format!("{HEAD}1 1 1\n1 1 0.1\n")).unwrap();
        assert_eq!(m.get(0, 0), rational(1, 10));
    }

    #[test]
    fn malformed_files_are_refused_with_the_line() {
        for (text, line) in [
            ("", 1),
            (
                "%%MatrixMarket matrix coordinate complex general\n1 1 0\n",
                1,
            ),
            ("%%MatrixMarket matrix coordinate real general\n", 2),
            ("%%MatrixMarket matrix coordinate real general\n1 1\n", 2),
            (
                "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 2 3\n",
                3,
            ),
            (
                "%%MatrixMarket matrix coordinate real general\n1 1 1\n0 1 3\n",
                3,
            ),
            (
                "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1\n",
                3,
            ),
            (
                "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n1 1 1\n",
                4,
            ),
            (
                "%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 2 1\n",
                3,
            ),
            (
                "%%MatrixMarket matrix coordinate real symmetric\n2 3 1\n1 1 1\n",
                2,
            ),
        ] {
            let got = read_matrix_market("K", text);
            assert!(
                matches!(got, Err(ModelError::MatrixMarket { line: l, .. }) if l == line),
                "{text:?}: {got:?}"
            );
        }

        assert!(matches!(
            read_matrix_market("K", &format!("{HEAD}1 1 1\n1 1 nan\n")),
            Err(ModelError::Number { .. })
        ));
        assert!(matches!(
            read_matrix_market("K", &format!("{HEAD}1 1 2\n1 1 1\n")),
            Err(ModelError::MatrixMarket { .. })
        ));
        assert!(matches!(
            read_matrix_market("K", &format!("{HEAD}1 1 2\n1 1 1\n1 1 1\n")),
            Err(ModelError::MatrixMarket { line: 4, .. })
        ));
    }
}
