//! Maximum transversals (Duff 1981, algorithm MC21): can rows and columns of a sparse matrix be
//! paired along its entries? If not it is singular whatever the values.
//!
//! Columns are given partners one after the other. A column without a free row takes a row from
//! another column, which looks for another row in turn: an *augmenting path*, found by depth-first
//! search. A column for which there is none stays alone in every largest pairing that keeps the
//! partners of the columns before it.
//!
//! Called by `structure` for dense Jacobians and by `sparse/condensed.rs`.

/// The partner of a row that has none, and the search that has met a row that none has met.
const NONE: usize = usize::MAX;

/// A row and a column without a partner in a maximum matching of rows and columns, the first ones;
/// `None` if all have one. `columns[j]` lists the rows (< the number of columns) of column j.
pub fn unmatched(columns: &[Vec<usize>]) -> Option<(usize, usize)> {
    let mut matching = Matching::new(columns);

    // A column that has a partner keeps one, so that the first one alone stays alone.
    let mut first_alone = None;

    for column in 0..columns.len() {
        if !matching.pair(column) {
            first_alone = first_alone.or(Some(column));
        }
    }

    let row = matching.partner.iter().position(|&column| column == NONE);
    row.zip(first_alone)
}

/// A column on the path of a search.
#[derive(Debug, Clone, Copy)]
struct Visit {
    column: usize,
    /// The first of its entries that the search has not tried.
    next: usize,
}

/// A pairing of rows and columns under way.
struct Matching<'a> {
    columns: &'a [Vec<usize>],
    /// The column of each row.
    partner: Vec<usize>,
    /// The last search that has met each row, named by the column it began at.
    met_by: Vec<usize>,
    /// For each column the number of its first entries whose rows are known to have a partner.
    paired_entries: Vec<usize>,
    /// The path of the search: each column but the first is the partner of the row taken before.
    path: Vec<Visit>,
    /// The row taken from each column of the path; from the last one only at the end.
    rows: Vec<usize>,
}

impl<'a> Matching<'a> {
    fn new(columns: &'a [Vec<usize>]) -> Self {
        let n = columns.len();
        Matching {
            columns,
            partner: vec![NONE; n],
            met_by: vec![NONE; n],
            paired_entries: vec![0; n],
            path: Vec::with_capacity(n),
            rows: Vec::with_capacity(n),
        }
    }

    /// Gives a column a partner along an augmenting path; false if there is none.
    fn pair(&mut self, root: usize) -> bool {
        self.rows.clear();
        self.path.clear();
        self.path.push(Visit {
            column: root,
            next: 0,
        });

        while let Some(&visit) = self.path.last() {
            if let Some(row) = self.free_row(visit.column) {
                self.rows.push(row);
                self.take_rows();
                return true;
            }

            if !self.go_on(visit, root) {
                self.path.pop();
                self.rows.pop();
            }
        }
        false
    }

    /// The first row of a column that has no partner.
    fn free_row(&mut self, column: usize) -> Option<usize> {
        let rows = &self.columns[column];
        let tried = &mut self.paired_entries[column];

        while *tried < rows.len() && self.partner[rows[*tried]] != NONE {
            *tried += 1;
        }

        rows.get(*tried).copied()
    }

    /// Gives each column of the path the row taken from it.
    fn take_rows(&mut self) {
        for (visit, &row) in self.path.iter().zip(&self.rows) {
            self.partner[row] = visit.column;
        }
    }

    /// Takes the next row of the last column that this search has not met, and goes on at its
    /// partner; false if there is no such row.
    fn go_on(&mut self, visit: Visit, root: usize) -> bool {
        let rows = &self.columns[visit.column];
        let untried = &rows[visit.next..];
        let Some(k) = untried.iter().position(|&row| self.met_by[row] != root) else {
            return false;
        };

        let row = untried[k];
        self.met_by[row] = root;
        if let Some(last) = self.path.last_mut() {
            last.next = visit.next + k + 1;
        }

        self.rows.push(row);
        self.path.push(Visit {
            column: self.partner[row],
            next: 0,
        });

        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Is there a permutation along the entries? By all of them.
    fn by_all(columns: &[Vec<usize>], taken: u32) -> bool {
        columns.split_first().is_none_or(|(first, rest)| {
            first
                .iter()
                .any(|&row| taken >> row & 1 == 0 && by_all(rest, taken | 1 << row))
        })
    }

    #[test]
    fn agrees_with_trying_all_permutations() {
        let mut state = 1u64;
        let mut counts = [0; 2];
        for k in 0..2000 {
            let n = k % 8;

            // Knuth's linear congruential generator, high bits.
            let mut bit = |density: u64| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                (state >> 40) % 10 < density
            };
            let columns: Vec<Vec<usize>> = (0..n)
                .map(|_| (0..n).filter(|_| bit(if n < 7 { 3 } else { 4 })).collect())
                .collect();
            let regular = by_all(&columns, 0);
            counts[usize::from(regular)] += 1;

            assert_eq!(unmatched(&columns).is_none(), regular, "{columns:?}");
        }

        assert!(counts.iter().all(|&c| c > 300), "{counts:?}");
        assert_eq!(unmatched(&[vec![0], vec![0]]), Some((1, 1)));

        // Rows 1 and 2 share what they have; columns 0 and 2 are nobody's.
        assert_eq!(unmatched(&[vec![], vec![0, 1, 2], vec![]]), Some((1, 0)));
    }

    #[test]
    fn long_ways_need_no_stack() {
        // Column j has rows j and j + 1, the last one only row 0: everything moves by one.
        let n = 100_000;
        let columns: Vec<Vec<usize>> = (0..n)
            .map(|j| if j + 1 < n { vec![j, j + 1] } else { vec![0] })
            .collect();

        assert_eq!(unmatched(&columns), None);
    }
}
