//! Maximum transversals (Duff 1981, algorithm MC21): can rows and columns of a sparse matrix be
//! paired along its entries? If not it is singular whatever the values.

/// A row and a column without a partner in a maximum matching of rows and columns, the first ones;
/// `None` if all have one. `columns[j]` lists the rows (< the number of columns) of column j.
pub fn unmatched(columns: &[Vec<usize>]) -> Option<(usize, usize)> {
    const NONE: usize = usize::MAX;
    let n = columns.len();
    let mut partner = vec![NONE; n]; // column of each row
    let mut seen = vec![NONE; n]; // the search that has met each row
    let mut cheap = vec![0; n]; // entries of each column already tried for a row without partner
    // Depth first, (column, next entry), each column but the first reached through its partner.
    let mut way: Vec<(usize, usize)> = Vec::with_capacity(n);
    // Row taken from each column of the way but the last.
    let mut steps: Vec<usize> = Vec::with_capacity(n);
    let mut alone = None; // the first column without partner: what has one keeps one
    for root in 0..n {
        way.clear();
        way.push((root, 0));
        steps.clear();
        while let Some(&(column, next)) = way.last() {
            let rows = &columns[column];
            let end = rows[cheap[column]..]
                .iter()
                .position(|&row| partner[row] == NONE);
            cheap[column] = end.map_or(rows.len(), |k| cheap[column] + k);
            if let Some(&row) = rows.get(cheap[column]) {
                steps.push(row);
                way.iter()
                    .zip(&steps)
                    .for_each(|(&(column, _), &row)| partner[row] = column);
                break;
            }
            match rows[next..].iter().position(|&row| seen[row] != root) {
                Some(k) => {
                    let row = rows[next + k];
                    seen[row] = root;
                    if let Some(last) = way.last_mut() {
                        last.1 = next + k + 1;
                    }
                    steps.push(row);
                    way.push((partner[row], 0));
                }
                None => {
                    way.pop();
                    steps.pop();
                }
            }
        }
        if way.is_empty() {
            alone = alone.or(Some(root));
        }
    }
    partner.iter().position(|&column| column == NONE).zip(alone)
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
        let (mut state, mut counts) = (1u64, [0; 2]);
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
