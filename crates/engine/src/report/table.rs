//! A plain text table with aligned columns, two blanks between them.

/// Rows of cells; the first row is the header.
#[derive(Debug, Default)]
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with this header.
    pub fn new(header: &[&str]) -> Table {
        Table {
            rows: vec![header.iter().map(ToString::to_string).collect()],
        }
    }

    /// The length of the longest cell of each column.
    fn widths(&self) -> Vec<usize> {
        let mut widths = Vec::new();
        for row in &self.rows {
            widths.resize(widths.len().max(row.len()), 0);
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = cell.chars().count().max(*width);
            }
        }

        widths
    }

    /// Adds a row.
    pub fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }
}

impl std::fmt::Display for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let widths = self.widths();
        for row in &self.rows {
            let mut cells = Vec::with_capacity(row.len());
            for (cell, &width) in row.iter().zip(&widths) {
                // Formatting pads to 65,535 characters at most, and panics beyond.
                let missing = width - cell.chars().count();
                cells.push(format!("{cell}{}", " ".repeat(missing)));
            }
            writeln!(f, "{}", cells.join("  ").trim_end())?;
        }

        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_may_be_longer_than_a_format_width() {
        let mut table = Table::new(&["a", "b"]);
        table.row(vec!["x".repeat(70_000), "y".into()]);

        assert_eq!(table.to_string().lines().next().unwrap().len(), 70_003);
    }

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(&["a", "long"]);
        table.row(vec!["wide".into(), "x".into()]);

        assert_eq!(table.to_string(), "a     long\nwide  x\n");
    }
}
