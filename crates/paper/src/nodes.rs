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

use crate::table::{Layout, TableError};
use mceip_model::BodyNode;
use std::collections::HashMap;

/// A table of nodes, read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NodeTable {
    /// One for each line.
    pub nodes: Vec<BodyNode>,
    /// Pairs of indices of nodes, each pair once, the smaller one first.
    pub edges: Vec<[usize; 2]>,
}

const LAYOUT: Layout<6> = Layout {
    table: "coordinates",
    columns: ["x", "y", "dof_x", "dof_y", "node", "edges_to"],
    needed: 4,
    in_words: "x, y, dof_x, dof_y, and perhaps node and edges_to",
};
const X: usize = 0;
const Y: usize = 1;
const DOF_X: usize = 2;
const DOF_Y: usize = 3;
const NODE: usize = 4;
const EDGES_TO: usize = 5;

/// What belongs into the columns of degrees of freedom.
const DOF: &str =
    "a degree of freedom of the model, numbered from 0, or nothing where it is prescribed";

/// Reads the table. `dof` finds the 0-based degree of freedom that a cell names.
///
/// # Errors
/// [`TableError`] with line and column.
pub fn read_nodes(
    text: &str,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<NodeTable, TableError> {
    let table = LAYOUT.read(text)?;
    let rows = &table.rows;

    let mut index_of: HashMap<String, usize> = HashMap::new();
    let mut nodes = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let name = match row.cells[NODE] {
            "" if !table.has[NODE] => index.to_string(),
            name => name.to_string(),
        };
        if name.is_empty() || index_of.insert(name, index).is_some() {
            return Err(row.unexpected(NODE, "a name, each once"));
        }

        nodes.push(BodyNode {
            dofs: [row.dof(DOF_X, DOF, dof)?, row.dof(DOF_Y, DOF, dof)?],
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

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::parse;

    fn read(text: &str) -> Result<NodeTable, TableError> {
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
                matches!(refused, Err(TableError::Header { .. })),
                "{header}"
            );
        }

        let refused = read("x,y,dof_x,dof_y\n0,0,0\n");
        assert!(matches!(refused, Err(TableError::Cells { line: 2, .. })));

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
            let Err(TableError::Cell {
                line: 2, column, ..
            }) = refused
            else {
                panic!("{row}: {refused:?}")
            };
            assert_eq!(column, wrong, "{row}");
        }
    }
}
