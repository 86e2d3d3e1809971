//! A matrix in a file: dense rows, sparse entries, or a Matrix Market file beside the problem.
//!
//! ```text
//! [[2, "1/2"], ["0.5", 0]]
//! {"dense": [[...]]}
//! {"rows": 2, "cols": 2, "symmetric": true, "entries": [[0, 0, 2], [1, 0, "0.5"]]}
//! {"matrix_market": "K.mtx"}
//! ```
//!
//! Indices count from 0. Any object may say `"read_as": "f64"`: then each number stands for the
//! nearest double's exact value.
//!
//! The radius of a matrix ([`crate::Radii`]) stands in one of these forms; the first two are of its
//! entries that are not zero:
//!
//! ```text
//! {"absolute": "5e-5"}      this radius each
//! {"relative": "1e-5"}      this share of the absolute value of each
//! {"matrix": [[0, 1], [1, 0]]}
//! ```

use super::market::read_matrix_market;
use super::order::require_order;
use super::{Number, Word, beside, read_text};
use crate::{ModelError, Radii};
use mceip_exact::{NumberError, Rational, Sparse};
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use std::collections::BTreeSet;
use std::path::Path;

/// The radius of a matrix: by a rule, or entry by entry.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum RawRadius {
    Absolute(Number),
    Relative(Number),
    Matrix(RawMatrix),
}

impl RawRadius {
    /// The radius of `matrix`, named `what` in complaints.
    pub(super) fn build(
        self,
        matrix: &Sparse,
        what: &'static str,
        folder: &Path,
    ) -> Result<Sparse, ModelError> {
        match self {
            RawRadius::Absolute(radius) => Ok(Radii::absolute(matrix, &radius.0)),
            RawRadius::Relative(share) => Ok(Radii::relative(matrix, &share.0)),
            RawRadius::Matrix(entries) => entries.build(what, folder),
        }
    }
}

/// The three spellings of a matrix.
#[derive(Debug)]
pub(super) enum RawMatrix {
    Dense(Vec<Vec<Number>>),
    Object(RawObject),
}

/// The fields of the three objects above; which of them stand together is checked afterwards.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawObject {
    dense: Option<Vec<Vec<Number>>>,
    rows: Option<usize>,
    cols: Option<usize>,
    #[serde(default)]
    symmetric: bool,
    entries: Option<Vec<(usize, usize, Number)>>,
    matrix_market: Option<String>,
    read_as: Option<Word<ReadAs>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ReadAs {
    Exact,
    F64,
}

/// A list is dense, a map is one of the objects.
impl<'de> Deserialize<'de> for RawMatrix {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ListOrObject;
        impl<'de> Visitor<'de> for ListOrObject {
            type Value = RawMatrix;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("dense rows, or an object with dense, entries or matrix_market")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<RawMatrix, A::Error> {
                Deserialize::deserialize(de::value::SeqAccessDeserializer::new(seq))
                    .map(RawMatrix::Dense)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RawMatrix, A::Error> {
                Deserialize::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(RawMatrix::Object)
            }
        }

        deserializer.deserialize_any(ListOrObject)
    }
}

impl RawMatrix {
    /// The matrix itself, named `what` in complaints.
    pub(super) fn build(self, what: &'static str, folder: &Path) -> Result<Sparse, ModelError> {
        match self {
            RawMatrix::Dense(rows) => dense(what, rows),
            RawMatrix::Object(object) => object.build(what, folder),
        }
    }
}

impl RawObject {
    fn build(self, what: &'static str, folder: &Path) -> Result<Sparse, ModelError> {
        let read_as = self.read_as.as_ref().map_or(ReadAs::Exact, |word| word.0);
        let matrix = match self {
            RawObject {
                dense: Some(rows),
                entries: None,
                matrix_market: None,
                rows: None,
                cols: None,
                symmetric: false,
                ..
            } => dense(what, rows)?,
            RawObject {
                dense: None,
                entries: Some(entries),
                matrix_market: None,
                rows: Some(rows),
                cols: Some(cols),
                symmetric: false,
                ..
            } => general(what, rows, cols, entries)?,
            RawObject {
                dense: None,
                entries: Some(entries),
                matrix_market: None,
                rows: Some(rows),
                cols: Some(cols),
                symmetric: true,
                ..
            } => symmetric(what, rows, cols, entries)?,
            RawObject {
                dense: None,
                entries: None,
                matrix_market: Some(file),
                rows: None,
                cols: None,
                symmetric: false,
                ..
            } => {
                let path = beside(what, folder, &file)?;
                let text = read_text(what, &path)?;
                read_matrix_market(what, &text)?
            }
            _ => return Err(not_one_spelling(what)),
        };

        match read_as {
            ReadAs::Exact => Ok(matrix),
            ReadAs::F64 => nearest_doubles(what, &matrix),
        }
    }
}

fn not_one_spelling(what: &'static str) -> ModelError {
    ModelError::Missing {
        equation: what,
        what: "one of {dense}, {rows, cols, entries[, symmetric]}, {matrix_market}",
        unknown: "any",
    }
}

fn dense(what: &'static str, rows: Vec<Vec<Number>>) -> Result<Sparse, ModelError> {
    let cols = rows.first().map_or(0, Vec::len);
    let count = rows.len();
    require_order(what, count)?;
    for (row, numbers) in rows.iter().enumerate() {
        if numbers.len() != cols {
            return Err(ModelError::Ragged {
                what,
                row,
                expected: cols,
                got: numbers.len(),
            });
        }
    }

    let mut entries = Vec::with_capacity(count * cols);
    for (i, numbers) in rows.into_iter().enumerate() {
        for (j, number) in numbers.into_iter().enumerate() {
            entries.push((i, j, number.0));
        }
    }

    Ok(Sparse::from_entries(count, cols, entries))
}

/// An entry as it stands in a file: row, column, value.
type SpeltEntry = (usize, usize, Number);

/// A matrix by its non-zero entries.
fn general(
    what: &'static str,
    rows: usize,
    cols: usize,
    entries: Vec<SpeltEntry>,
) -> Result<Sparse, ModelError> {
    require_order(what, rows)?;
    require_order(what, cols)?;

    let mut seen = BTreeSet::new();
    for &(i, j, _) in &entries {
        require_within(what, [i, j], [rows, cols])?;
        if !seen.insert((i, j)) {
            return Err(ModelError::EntryTwice {
                what,
                row: i,
                col: j,
            });
        }
    }

    let entries = entries.into_iter().map(|(i, j, number)| (i, j, number.0));

    Ok(Sparse::from_entries(rows, cols, entries))
}

/// A symmetric matrix by the non-zero entries of one triangle. An entry and its mirror are the same
/// one, and both must lie within the shape.
fn symmetric(
    what: &'static str,
    rows: usize,
    cols: usize,
    entries: Vec<SpeltEntry>,
) -> Result<Sparse, ModelError> {
    require_order(what, rows)?;
    require_order(what, cols)?;

    let order = rows.min(cols);
    let mut seen = BTreeSet::new();

    for &(i, j, _) in &entries {
        require_within(what, [i, j], [order, order])?;
        if !seen.insert((i.min(j), i.max(j))) {
            return Err(ModelError::EntryTwice {
                what,
                row: i,
                col: j,
            });
        }
    }

    let mut mirrored = Vec::with_capacity(2 * entries.len());
    for (i, j, number) in entries {
        if i != j {
            mirrored.push((j, i, number.0.clone()));
        }
        mirrored.push((i, j, number.0));
    }

    Ok(Sparse::from_entries(rows, cols, mirrored))
}

fn require_within(
    what: &'static str,
    [row, col]: [usize; 2],
    [rows, cols]: [usize; 2],
) -> Result<(), ModelError> {
    if row < rows && col < cols {
        return Ok(());
    }

    Err(ModelError::EntryOutside {
        what,
        row,
        col,
        rows,
        cols,
    })
}

/// Each entry as the exact value of its nearest double.
fn nearest_doubles(what: &'static str, m: &Sparse) -> Result<Sparse, ModelError> {
    let mut entries: Vec<(usize, usize, Rational)> = Vec::new();
    for (i, j, value) in m.entries() {
        let Some(rounded) = Number(value.clone()).through_f64() else {
            return Err(ModelError::Number {
                place: format!("{what}[{i}][{j}]"),
                source: NumberError::NotFinite {
                    text: "a value beyond the range of doubles".into(),
                },
            });
        };
        entries.push((i, j, rounded.0));
    }

    Ok(Sparse::from_entries(m.rows(), m.cols(), entries))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{from_f64, rational, whole};

    fn read(text: &str) -> Result<Sparse, ModelError> {
        super::super::from_json::<RawMatrix>(text)?.build("K", Path::new("."))
    }

    #[test]
    fn the_spellings_agree() {
        let dense = read("[[2, \"1/2\"], [\"0.5\", 0]]").unwrap();
        let sparse =
            read(r#"{"rows": 2, "cols": 2, "symmetric": true, "entries": [[0,0,2],[1,0,"0.5"]]}"#)
                .unwrap();
        assert_eq!(dense, sparse);
        assert_eq!(dense.get(0, 1), rational(1, 2));
    }

    /// Is a matrix with one entry refused for the place of that?
    fn is_outside([rows, cols]: [usize; 2], symmetric: bool, [i, j]: [usize; 2]) -> bool {
        let text = format!(
            r#"{{"rows": {rows}, "cols": {cols}, "symmetric": {symmetric},
                "entries": [[{i}, {j}, 2]]}}"#
        );

        match read(&text) {
            Err(ModelError::EntryOutside { row, col, .. }) => [row, col] == [i, j],
            _ => false,
        }
    }

    #[test]
    fn entries_lie_within_the_matrix_and_their_mirrors_too() {
        let cases = [
            ([3, 2], false, [2, 1], false),
            ([3, 2], false, [3, 0], true),
            ([3, 2], false, [0, 2], true),
            ([3, 2], true, [1, 0], false),
            ([3, 2], true, [2, 0], true),
            ([2, 3], true, [0, 2], true),
        ];

        for (shape, symmetric, place, expected) in cases {
            assert_eq!(is_outside(shape, symmetric, place), expected);
        }
    }

    #[test]
    fn doubles_only_on_request() {
        assert_eq!(read("[[0.1]]").unwrap().get(0, 0), rational(1, 10));
        let rounded = read(r#"{"dense": [[0.1]], "read_as": "f64"}"#).unwrap();
        assert_eq!(rounded.get(0, 0), from_f64(0.1).unwrap());
        assert!(matches!(
            read(r#"{"dense": [["1e399"]], "read_as": "f64"}"#),
            Err(ModelError::Number { .. })
        ));
    }

    #[test]
    fn malformed_matrices_are_named() {
        assert!(matches!(
            read("[[1,2],[3]]"),
            Err(ModelError::Ragged {
                row: 1,
                expected: 2,
                got: 1,
                ..
            })
        ));
        assert!(matches!(
            read(r#"{"rows":1,"cols":1,"entries":[[0,1,3]]}"#),
            Err(ModelError::EntryOutside { row: 0, col: 1, .. })
        ));
        assert!(matches!(
            read(r#"{"rows":1,"cols":1,"entries":[[0,0,3],[0,0,3]]}"#),
            Err(ModelError::EntryTwice { .. })
        ));
        assert!(matches!(
            read(r#"{"rows":2,"cols":2,"symmetric":true,"entries":[[0,1,3],[1,0,3]]}"#),
            Err(ModelError::EntryTwice { .. })
        ));
        assert!(matches!(
            read(r#"{"rows":99999999999,"cols":1,"entries":[]}"#),
            Err(ModelError::TooLarge { .. })
        ));
        assert!(matches!(
            read(r#"{"rows":1,"entries":[]}"#),
            Err(ModelError::Missing { .. })
        ));
        assert!(matches!(
            read(r#"{"rows":1,"rows":1,"cols":1,"entries":[]}"#),
            Err(ModelError::Json { .. })
        ));
        for name in ["/dev/zero", "../K.mtx", "src"] {
            assert!(
                matches!(
                    read(&format!(r#"{{"matrix_market":"{name}"}}"#)),
                    Err(ModelError::Unreadable { .. })
                ),
                "{name}"
            );
        }

        assert_eq!(
            read("[[0, 0]]").unwrap(),
            Sparse::from_entries(1, 2, [(0, 0, whole(0))])
        );
    }
}
