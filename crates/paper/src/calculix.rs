//! Matrices that CalculiX writes for `*FREQUENCY, SOLVER=MATRIXSTORAGE`: `.sti`, `.mas` and `.dof`.
//!
//! `.sti` and `.mas` have a line `row column value` for each entry of one triangle, from 1; `.dof`
//! has a line `node.direction` for each row. Degrees of freedom that `*BOUNDARY` fixes do not
//! appear. `mceip convert` reads K, M and the names of dofs from here.

use crate::lines::{TextLine, lines_not_empty, shown};
use mceip_exact::{Rational, Sparse, parse};
use std::collections::{BTreeMap, HashMap};

/// Why a file of CalculiX is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: expected {expected}, got {got:?}")]
pub struct CalculixError {
    /// Line of the file, from 1.
    pub line: usize,
    /// What belongs there.
    pub expected: &'static str,
    /// What stands there.
    pub got: String,
}

impl CalculixError {
    /// What was expected in a line, and what stands there.
    pub(crate) fn at(line: usize, expected: &'static str, text: &str) -> CalculixError {
        CalculixError {
            line,
            expected,
            got: shown(text),
        }
    }
}

/// The lines that are not empty.
fn lines_of(text: &str) -> Vec<TextLine<'_>> {
    lines_not_empty(text, |line| line)
}

impl TextLine<'_> {
    fn refuse(&self, expected: &'static str) -> CalculixError {
        CalculixError::at(self.number, expected, self.text)
    }
}

/// The names `node.direction` of the rows, in order, with their 0-based index.
///
/// # Errors
/// [`CalculixError`] for a line that is no `node.direction`, one that stands twice, or no line at
/// all.
pub fn read_dofs(text: &str) -> Result<HashMap<String, usize>, CalculixError> {
    let mut names = HashMap::new();
    for line in lines_of(text) {
        if !is_dof(line.text) {
            return Err(line.refuse("node.direction"));
        }

        let index = names.len();
        if names.insert(line.text.to_string(), index).is_some() {
            return Err(line.refuse("each degree of freedom once"));
        }
    }

    if names.is_empty() {
        let empty = TextLine {
            number: 1,
            text: "nothing",
        };
        return Err(empty.refuse("node.direction"));
    }

    Ok(names)
}

/// A node number, a dot, a direction from 1 to 6.
fn is_dof(text: &str) -> bool {
    let Some((node, direction)) = text.split_once('.') else {
        return false;
    };
    let direction_exists = direction.parse().is_ok_and(|d: u8| (1..=6).contains(&d));
    node.parse::<u64>().is_ok() && direction_exists
}

/// A symmetric matrix of the given order from the entries of one triangle, values exactly as spelt.
///
/// # Errors
/// [`CalculixError`] for a line that is no entry, an index beyond the order, an entry given twice.
///
/// ```
/// use mceip_exact::rational;
/// use mceip_paper::calculix::read_triangle;
/// let k = read_triangle("1 1  2.5e+00\n1 2 -1.0e+00\n2 2  2.5e+00\n", 2).unwrap();
/// assert_eq!((k.get(0, 0), k.get(1, 0)), (rational(5, 2), rational(-1, 1)));
/// ```
pub fn read_triangle(text: &str, order: usize) -> Result<Sparse, CalculixError> {
    let mut upper: BTreeMap<(usize, usize), Rational> = BTreeMap::new();
    for line in lines_of(text) {
        let entry = read_entry(&line, order)?;
        let place = (entry.row.min(entry.column), entry.row.max(entry.column));
        if upper.insert(place, entry.value).is_some() {
            return Err(line.refuse("each entry of one triangle once"));
        }
    }

    let mut entries = Vec::with_capacity(2 * upper.len());
    for ((row, column), value) in upper {
        if row != column {
            entries.push((column, row, value.clone()));
        }

        entries.push((row, column, value));
    }

    Ok(Sparse::from_entries(order, order, entries))
}

/// An entry, indices from 0.
struct TriangleEntry {
    row: usize,
    column: usize,
    value: Rational,
}

fn read_entry(line: &TextLine<'_>, order: usize) -> Result<TriangleEntry, CalculixError> {
    let words: Vec<&str> = line.text.split_whitespace().collect();
    let [row, column, value] = words[..] else {
        return Err(line.refuse("row column value"));
    };

    let indices_expected = "indices from 1 to the number of lines of .dof";
    let row = read_index(row, order).ok_or_else(|| line.refuse(indices_expected))?;
    let column = read_index(column, order).ok_or_else(|| line.refuse(indices_expected))?;
    match parse(value) {
        Ok(value) => Ok(TriangleEntry { row, column, value }),
        Err(_) => Err(line.refuse("a number")),
    }
}

/// A 0-based index below `order` from a 1-based one.
fn read_index(word: &str, order: usize) -> Option<usize> {
    let from_one: usize = word.parse().ok()?;
    let index = from_one.checked_sub(1)?;
    (index < order).then_some(index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_follow_the_lines() {
        let names = read_dofs("4.1\n4.2\n17.1\n").unwrap();
        assert_eq!(names["4.1"], 0);
        assert_eq!(names["17.1"], 2);
        assert_eq!(names.len(), 3);

        for bad in ["4\n", "4.7\n", "x.1\n", "4.1\n4.1\n", ""] {
            assert!(read_dofs(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn entries_are_held_against_the_order() {
        for (bad, expected_line) in [
            ("1 1\n", 1),
            ("1 1 2\n1 3 1\n", 2),
            ("0 1 1\n", 1),
            ("1 1 x\n", 1),
            ("1 2 1\n2 1 1\n", 2),
        ] {
            let refused = read_triangle(bad, 2).unwrap_err();
            assert_eq!(refused.line, expected_line, "{bad:?}");
        }
    }
}
