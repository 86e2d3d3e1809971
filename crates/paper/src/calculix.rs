//! Matrices that CalculiX writes for `*FREQUENCY, SOLVER=MATRIXSTORAGE`: `.sti`, `.mas` and `.dof`.
//!
//! `.sti` and `.mas` have a line `row column value` for each entry of one triangle, from 1; `.dof`
//! has a line `node.direction` for each row. Degrees of freedom that `*BOUNDARY` fixes do not
//! appear.

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

fn refuse(line: usize, expected: &'static str, text: &str) -> CalculixError {
    CalculixError {
        line,
        expected,
        got: text.chars().filter(|c| !c.is_control()).take(60).collect(),
    }
}

/// The names `node.direction` of the rows, in order, with their 0-based index.
///
/// # Errors
/// [`CalculixError`] for a line that is no `node.direction`, one that stands twice, or no line at
/// all.
pub fn read_dofs(text: &str) -> Result<HashMap<String, usize>, CalculixError> {
    let mut names = HashMap::new();
    for (line, row) in text
        .lines()
        .enumerate()
        .map(|(i, l)| (i + 1, l.trim()))
        .filter(|(_, l)| !l.is_empty())
    {
        let parts = row.split_once('.').map(|(a, b)| {
            (
                a.parse::<u64>().is_ok(),
                b.parse::<u8>().is_ok_and(|d| (1..=6).contains(&d)),
            )
        });
        if parts != Some((true, true)) {
            return Err(refuse(line, "node.direction", row));
        }
        let index = names.len();
        if names.insert(row.to_string(), index).is_some() {
            return Err(refuse(line, "each degree of freedom once", row));
        }
    }
    if names.is_empty() {
        Err(refuse(1, "node.direction", "nothing"))
    } else {
        Ok(names)
    }
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
    let mut entries: BTreeMap<(usize, usize), Rational> = BTreeMap::new();
    for (line, row) in text
        .lines()
        .enumerate()
        .map(|(i, l)| (i + 1, l.trim()))
        .filter(|(_, l)| !l.is_empty())
    {
        let words: Vec<&str> = row.split_whitespace().collect();
        let [i, j, value] = words[..] else {
            return Err(refuse(line, "row column value", row));
        };
        let index = |w: &str| {
            w.parse::<usize>()
                .ok()
                .and_then(|v| v.checked_sub(1))
                .filter(|v| *v < order)
        };
        let (Some(i), Some(j)) = (index(i), index(j)) else {
            return Err(refuse(
                line,
                "indices from 1 to the number of lines of .dof",
                row,
            ));
        };
        let value = parse(value).map_err(|_| refuse(line, "a number", row))?;
        if entries.insert((i.min(j), i.max(j)), value).is_some() {
            return Err(refuse(line, "each entry of one triangle once", row));
        }
    }
    let mirrored = entries.into_iter().flat_map(|((i, j), v)| {
        let mirror = (i != j).then(|| (j, i, v.clone()));
        [(i, j, v)].into_iter().chain(mirror)
    });
    Ok(Sparse::from_entries(order, order, mirrored))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_follow_the_lines() {
        let names = read_dofs("4.1\n4.2\n17.1\n").unwrap();
        assert_eq!((names["4.1"], names["17.1"], names.len()), (0, 2, 3));
        for bad in ["4\n", "4.7\n", "x.1\n", "4.1\n4.1\n", ""] {
            assert!(read_dofs(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn entries_are_held_against_the_order() {
        for (bad, line) in [
            ("1 1\n", 1),
            ("1 1 2\n1 3 1\n", 2),
            ("0 1 1\n", 1),
            ("1 1 x\n", 1),
            ("1 2 1\n2 1 1\n", 2),
        ] {
            assert!(
                matches!(read_triangle(bad, 2), Err(CalculixError { line: l, .. }) if l == line),
                "{bad:?}"
            );
        }
    }
}
