//! Positions of the nodes of a model of one's own, as a CSV table: what `mceip convert
//! --coordinates` reads.
//!
//! A header line names the columns, in any order. Needed are `x`, `y` (the place, in the unit of
//! length of the model), `dof_x` and `dof_y` (the degrees of freedom that move the node along x and
//! along y; empty where the displacement is prescribed). Optional are
//!
//! * `node`: a name; without it the nodes are 0, 1, ... in the order of the lines;
//! * `edges_to`: names of nodes, with blanks between, to which a line is drawn.
//!
//! Lines that begin with # are comments.

use crate::contacts::{TextLine, lines_with_content, shown};
use mceip_exact::{Rational, parse};
use mceip_model::Node;
use std::collections::HashMap;

/// Why a table of nodes is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NodesError {
    /// A needed column is missing, one means nothing, or one is named twice.
    #[error(
        "coordinates: expected the columns x, y, dof_x, dof_y, and perhaps node and edges_to, each \
         once and with commas between, in the header; got {got:?}"
    )]
    Header {
        /// The header.
        got: String,
    },
    /// A line has another number of cells than the header.
    #[error("coordinates line {line}: expected {expected} cells, got {got}")]
    Cells {
        /// Line of the file, from 1.
        line: usize,
        /// Cells of the header.
        expected: usize,
        /// Cells of the line.
        got: usize,
    },
    /// A cell cannot be read.
    #[error("coordinates line {line}, column {column}: expected {expected}, got {got:?}")]
    Cell {
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

/// A table of nodes, read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NodeTable {
    /// One for each line.
    pub nodes: Vec<Node>,
    /// Pairs of indices of nodes, each pair once, the smaller one first.
    pub edges: Vec<[usize; 2]>,
}

/// The columns, the needed ones first.
const COLUMNS: [&str; 6] = ["x", "y", "dof_x", "dof_y", "node", "edges_to"];
const NEEDED: usize = 4;
const X: usize = 0;
const Y: usize = 1;
const DOF_X: usize = 2;
const DOF_Y: usize = 3;
const NODE: usize = 4;
const EDGES_TO: usize = 5;

/// Reads the table. `dof` finds the 0-based degree of freedom that a cell names.
///
/// # Errors
/// [`NodesError`] with line and column.
pub fn read_nodes(
    text: &str,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<NodeTable, NodesError> {
    let mut lines = lines_with_content(text).into_iter();
    let header = lines.next().map_or("", |line| line.text);
    let places = places_of_columns(header)?;
    let width = header.split(',').count();

    let mut rows = Vec::new();
    for line in lines {
        rows.push(Row::new(&line, &places, width)?);
    }

    let mut index_of: HashMap<String, usize> = HashMap::new();
    let mut nodes = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let name = match row.cells[NODE] {
            "" if places[NODE].is_none() => index.to_string(),
            name => name.to_string(),
        };
        if name.is_empty() || index_of.insert(name, index).is_some() {
            return Err(row.unexpected(NODE, "a name, each once"));
        }

        nodes.push(Node {
            dofs: [row.dof(DOF_X, dof)?, row.dof(DOF_Y, dof)?],
            place: [row.number(X)?, row.number(Y)?],
        });
    }

    let mut edges = Vec::new();
    for (from, row) in rows.iter().enumerate() {
        for name in row.cells[EDGES_TO].split_whitespace() {
            match index_of.get(name) {
                Some(&to) if to != from => edges.push([from.min(to), from.max(to)]),
                _ => return Err(row.unexpected(EDGES_TO, "names of other nodes")),
            }
        }
    }
    edges.sort_unstable();
    edges.dedup();

    Ok(NodeTable { nodes, edges })
}

/// Where each of [`COLUMNS`] stands in the header.
fn places_of_columns(header: &str) -> Result<[Option<usize>; 6], NodesError> {
    let mut places = [None; 6];
    for (place, name) in header.split(',').map(str::trim).enumerate() {
        let known = COLUMNS.iter().position(|column| *column == name);
        match known {
            Some(column) if places[column].is_none() => places[column] = Some(place),
            _ => return Err(NodesError::Header { got: shown(header) }),
        }
    }

    if places[..NEEDED].contains(&None) {
        return Err(NodesError::Header { got: shown(header) });
    }
    Ok(places)
}

/// A line of the table.
struct Row<'a> {
    /// Line of the file, from 1.
    line: usize,
    /// What stands in each of [`COLUMNS`]; empty where the table has no such column.
    cells: [&'a str; 6],
}

impl<'a> Row<'a> {
    fn new(
        line: &TextLine<'a>,
        places: &[Option<usize>; 6],
        width: usize,
    ) -> Result<Row<'a>, NodesError> {
        let given: Vec<&str> = line.text.split(',').map(str::trim).collect();
        if given.len() != width {
            return Err(NodesError::Cells {
                line: line.number,
                expected: width,
                got: given.len(),
            });
        }

        let cells = places.map(|place| place.map_or("", |place| given[place]));
        Ok(Row {
            line: line.number,
            cells,
        })
    }

    /// The error that something else was expected in a column.
    fn unexpected(&self, column: usize, expected: &'static str) -> NodesError {
        NodesError::Cell {
            line: self.line,
            column: COLUMNS[column],
            expected,
            got: shown(self.cells[column]),
        }
    }

    /// A degree of freedom; none where the cell is empty.
    fn dof(
        &self,
        column: usize,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<Option<usize>, NodesError> {
        let name = self.cells[column];
        if name.is_empty() {
            return Ok(None);
        }

        let expected =
            "a degree of freedom of the model, numbered from 0, or nothing where it is prescribed";
        match dof(name) {
            Some(index) => Ok(Some(index)),
            None => Err(self.unexpected(column, expected)),
        }
    }

    fn number(&self, column: usize) -> Result<Rational, NodesError> {
        parse(self.cells[column]).map_err(|_| self.unexpected(column, "a number"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<NodeTable, NodesError> {
        read_nodes(text, &|name| name.parse().ok().filter(|dof| *dof < 4))
    }

    #[test]
    fn nodes_and_edges_are_read_in_any_order_of_columns() {
        let table = read(
            "node,edges_to,x,y,dof_y,dof_x\n# the foot\na, b c ,0,0,1,0\nb,a,1.5,0,3,2\nc,,0,1,,\n",
        );

        let table = table.unwrap();
        assert_eq!(table.nodes[0].dofs, [Some(0), Some(1)]);
        assert_eq!(table.nodes[1].place[0], parse("3/2").unwrap());
        assert_eq!(table.nodes[2].dofs, [None, None]);
        assert_eq!(table.edges, [[0, 1], [0, 2]]);

        let without_names = read("x,y,dof_x,dof_y,edges_to\n0,0,0,1,1\n1,0,,,\n").unwrap();
        assert_eq!(without_names.edges, [[0, 1]]);
    }

    #[test]
    fn tables_are_refused_with_line_and_column() {
        for header in [
            "",
            "x,y,dof_x",
            "x,x,y,dof_x,dof_y",
            "x;y;dof_x;dof_y",
            "x,y,dof_x,dof_y,z",
        ] {
            let refused = read(&format!("{header}\n0,0,0,1\n"));
            assert!(
                matches!(refused, Err(NodesError::Header { .. })),
                "{header}"
            );
        }

        let refused = read("x,y,dof_x,dof_y\n0,0,0\n");
        assert!(matches!(refused, Err(NodesError::Cells { line: 2, .. })));

        for (row, wrong) in [
            ("a,zero,0,0,1,", "x"),
            ("a,,0,0,1,", "x"),
            ("a,0,0,4,1,", "dof_x"),
            ("a,0,0,0,-1,", "dof_y"),
            (",0,0,0,1,", "node"),
            ("a,0,0,0,1,b", "edges_to"),
            ("a,0,0,0,1,a", "edges_to"),
        ] {
            let refused = read(&format!("node,x,y,dof_x,dof_y,edges_to\n{row}\n"));
            let Err(NodesError::Cell {
                line: 2, column, ..
            }) = refused
            else {
                panic!("{row}: {refused:?}")
            };
            assert_eq!(column, wrong, "{row}");
        }
    }
}
