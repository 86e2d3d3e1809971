//! Tables with named columns in any order, cells separated by commas: lines, header, cells, numbers
//! and degrees of freedom. `nodes` and `steps` read their tables through this.
//!
//! A table of contacts has errors of its own and takes [`ColumnPlaces`] alone from here.
//!
//! Lines that begin with # are comments; a cell may be empty where its column says so.

use crate::lines::{TextLine, lines_with_content, shown};
use mceip_exact::{Rational, parse};

/// Why a table is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A needed column is missing, one means nothing, or one is named twice.
    #[error(
        "{table}: expected the columns {columns}, each once and with commas between, in the \
         header; got {got:?}"
    )]
    Header {
        /// Which table.
        table: &'static str,
        /// Its columns, in words.
        columns: &'static str,
        /// The header.
        got: String,
    },
    /// A line has another number of cells than the header.
    #[error("{table} line {line}: expected {expected} cells, got {got}")]
    Cells {
        /// Which table.
        table: &'static str,
        /// Line of the file, from 1.
        line: usize,
        /// Cells of the header.
        expected: usize,
        /// Cells of the line.
        got: usize,
    },
    /// A cell cannot be read.
    #[error("{table} line {line}, column {column}: expected {expected}, got {got:?}")]
    Cell {
        /// Which table.
        table: &'static str,
        /// Line of the file, from 1.
        line: usize,
        /// Name of the column.
        column: &'static str,
        /// What belongs there.
        expected: &'static str,
        /// What stands there.
        got: String,
    },
}

/// A kind of table.
pub(crate) struct Layout<const N: usize> {
    /// Its name in errors.
    pub(crate) table: &'static str,
    /// Its columns, the needed ones first.
    pub(crate) columns: [&'static str; N],
    /// How many are needed.
    pub(crate) needed: usize,
    /// The columns in words.
    pub(crate) in_words: &'static str,
}

/// A table, cut into cells.
pub(crate) struct CellTable<'a, const N: usize> {
    pub(crate) rows: Vec<TableRow<'a, N>>,
    /// Which of the columns the table has.
    pub(crate) has: [bool; N],
}

impl<const N: usize> Layout<N> {
    /// Cuts a text into cells.
    pub(crate) fn read<'a>(&'a self, text: &'a str) -> Result<CellTable<'a, N>, TableError> {
        let mut lines = lines_with_content(text).into_iter();
        let header = lines.next().map_or("", |line| line.text);
        let places = self.places(header)?;

        let mut rows = Vec::new();
        for line in lines {
            rows.push(self.row(&line, &places)?);
        }
        Ok(CellTable {
            rows,
            has: std::array::from_fn(|column| places.has(column)),
        })
    }

    /// Where each column stands in the header, the needed ones among them.
    fn places(&self, header: &str) -> Result<ColumnPlaces<N>, TableError> {
        let places = ColumnPlaces::of(header, &self.columns).ok();
        let complete = places.filter(|places| (0..self.needed).all(|column| places.has(column)));

        complete.ok_or_else(|| TableError::Header {
            table: self.table,
            columns: self.in_words,
            got: shown(header),
        })
    }

    fn row<'a>(
        &'a self,
        line: &TextLine<'a>,
        places: &ColumnPlaces<N>,
    ) -> Result<TableRow<'a, N>, TableError> {
        let cells = places.cells(line.text).map_err(|got| TableError::Cells {
            table: self.table,
            line: line.number,
            expected: places.width,
            got,
        })?;

        Ok(TableRow {
            layout: self,
            line: line.number,
            cells,
        })
    }
}

/// Where each of N columns stands in a header.
pub(crate) struct ColumnPlaces<const N: usize> {
    places: [Option<usize>; N],
    /// Number of cells.
    pub(crate) width: usize,
}

impl<const N: usize> ColumnPlaces<N> {
    /// Finds the columns of these names. The error is a name that is none of them or stands twice.
    pub(crate) fn of<'a>(header: &'a str, columns: &[&str; N]) -> Result<ColumnPlaces<N>, &'a str> {
        let mut places = [None; N];
        let mut width = 0;
        for name in header.split(',').map(str::trim) {
            let known = columns.iter().position(|column| *column == name);
            match known {
                Some(column) if places[column].is_none() => places[column] = Some(width),
                _ => return Err(name),
            }
            width += 1;
        }

        Ok(ColumnPlaces { places, width })
    }

    pub(crate) fn has(&self, column: usize) -> bool {
        self.places[column].is_some()
    }

    /// What a line has in each column, empty where there is no such column. The error is its number
    /// of cells, where that is not the header's.
    pub(crate) fn cells<'a>(&self, line: &'a str) -> Result<[&'a str; N], usize> {
        let given: Vec<&str> = line.split(',').map(str::trim).collect();
        if given.len() != self.width {
            return Err(given.len());
        }

        Ok(self
            .places
            .map(|place| place.map_or("", |place| given[place])))
    }
}

/// A line of a table.
pub(crate) struct TableRow<'a, const N: usize> {
    layout: &'a Layout<N>,
    /// Line of the file, from 1.
    line: usize,
    /// What stands in each column; empty where the table has no such column.
    pub(crate) cells: [&'a str; N],
}

impl<const N: usize> TableRow<'_, N> {
    /// The error that something else was expected in a column.
    pub(crate) fn unexpected(&self, column: usize, expected: &'static str) -> TableError {
        TableError::Cell {
            table: self.layout.table,
            line: self.line,
            column: self.layout.columns[column],
            expected,
            got: shown(self.cells[column]),
        }
    }

    /// The index that `dof` gives to the name in a column; none where the cell is empty.
    pub(crate) fn dof(
        &self,
        column: usize,
        expected: &'static str,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<Option<usize>, TableError> {
        let name = self.cells[column];
        if name.is_empty() {
            return Ok(None);
        }

        match dof(name) {
            Some(index) => Ok(Some(index)),
            None => Err(self.unexpected(column, expected)),
        }
    }

    pub(crate) fn number(&self, column: usize) -> Result<Rational, TableError> {
        parse(self.cells[column]).map_err(|_| self.unexpected(column, "a number"))
    }
}
