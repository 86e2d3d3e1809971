//! Sparse Cholesky factors front by front (Duff and Reid 1983), and the Schur complement they end
//! with.
//!
//! With the eliminated unknowns first, the matrix is [F B; B' C]. The factor L with F = L L' is
//! built front by front: each front adds up its rows of the matrix and what its children leave,
//! eliminates its own unknowns in a dense matrix, and passes the rest on to its parent. What is
//! left at the end is the Schur complement Z = C - B' F^-1 B of the kept unknowns.
//!
//! Input: a [`SymbolicAnalysis`] of the pattern and a matrix. Output: a [`SchurFactor`], which
//! solves, extends and restricts. `mceip-engine` eliminates the unknowns of a body with it that are
//! free of contact.

use super::analysis::{Front, HELD, SymbolicAnalysis};
use super::dense::eliminate_front;
use super::symmetric::Symmetric;
use crate::tolerance::SINGULAR_PIVOT;
use std::mem::take;

/// The matrix is not positive definite on the eliminated unknowns, as far as doubles can tell.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "expected a positive definite matrix, got a pivot {pivot} at index {index} (diagonal entry \
     {diagonal})"
)]
pub struct PivotNotPositive {
    /// Unknown at which elimination ended, or the first one of the front in which it did.
    pub index: usize,
    /// The square of the factor's diagonal; NaN where it has none.
    pub pivot: f64,
    /// Entry of the matrix.
    pub diagonal: f64,
}

/// The factor L of the eliminated block F and the Schur complement Z = C - B' F^-1 B of the kept
/// one.
#[derive(Debug, Clone)]
pub struct SchurFactor<'a> {
    analysis: &'a SymbolicAnalysis,
    /// For each front its columns of L (own + border rows), by columns.
    panels: Vec<Vec<f64>>,
    /// Z by rows.
    schur: Vec<Vec<f64>>,
}

impl SymbolicAnalysis {
    /// Factors a matrix of the analysed pattern (or less).
    ///
    /// # Errors
    /// [`PivotNotPositive`] if a pivot is not positive, or so small that only rounding makes it so.
    pub fn factor(&self, matrix: &Symmetric) -> Result<SchurFactor<'_>, PivotNotPositive> {
        let mut elimination = FrontalElimination::new(self, matrix);
        let mut panels = Vec::with_capacity(self.fronts.len());

        for (k, front) in self.fronts.iter().enumerate() {
            let dense = elimination.eliminate(front)?;
            panels.push(dense.panel);
            elimination.updates[k] = dense.update;
        }

        // The kept unknowns are gathered like a front, which is not eliminated.
        let kept = Front {
            begin: self.eliminated,
            end: self.order.len(),
            border: Vec::new(),
            children: self.roots(),
        };

        let dense = elimination.gather(&kept);
        let schur = mirrored(&dense.panel, kept.own());

        Ok(SchurFactor {
            analysis: self,
            panels,
            schur,
        })
    }

    /// The fronts that are no child of another one.
    fn roots(&self) -> Vec<usize> {
        let mut is_child = vec![false; self.fronts.len()];
        for front in &self.fronts {
            for &child in &front.children {
                is_child[child] = true;
            }
        }

        (0..self.fronts.len()).filter(|&k| !is_child[k]).collect()
    }
}

/// The symmetric matrix, by rows, of which `lower` holds the lower triangle by columns.
fn mirrored(lower: &[f64], order: usize) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; order]; order];
    for i in 0..order {
        for j in 0..order {
            rows[i][j] = lower[i.min(j) * order + i.max(j)];
        }
    }
    rows
}

/// The dense matrix of a front, lower triangles by columns.
struct DenseFront {
    /// The columns of the front's own unknowns, order x own.
    panel: Vec<f64>,
    /// The rows and columns of its border.
    update: Vec<f64>,
}

/// A factorisation under way.
struct FrontalElimination<'m> {
    analysis: &'m SymbolicAnalysis,
    matrix: &'m Symmetric,
    /// What each eliminated front leaves of its border, until its parent takes it.
    updates: Vec<Vec<f64>>,
    /// The row of each place in the dense matrix of the current front.
    local: Vec<usize>,
}

impl<'m> FrontalElimination<'m> {
    fn new(analysis: &'m SymbolicAnalysis, matrix: &'m Symmetric) -> Self {
        FrontalElimination {
            analysis,
            matrix,
            updates: vec![Vec::new(); analysis.fronts.len()],
            local: vec![usize::MAX; analysis.order.len()],
        }
    }

    /// The dense matrix of a front after its own unknowns were eliminated.
    fn eliminate(&mut self, front: &Front) -> Result<DenseFront, PivotNotPositive> {
        let mut dense = self.gather(front);
        let order = front.order();
        let own = front.own();

        if own == 0 {
            return Ok(dense);
        }

        if !eliminate_front(&mut dense.panel, &mut dense.update, order, own) {
            return Err(self.not_definite(front.begin, f64::NAN));
        }

        for column in 0..own {
            let pivot = dense.panel[column * order + column].powi(2);
            self.check_pivot(front.begin + column, pivot)?;
        }
        Ok(dense)
    }

    /// Refuses a pivot that is too small beside the diagonal entry, or NaN after an overflow.
    fn check_pivot(&self, place: usize, pivot: f64) -> Result<(), PivotNotPositive> {
        let diagonal = self.matrix.diagonal(self.analysis.order[place]);
        let is_large = pivot > SINGULAR_PIVOT * diagonal.abs();

        if is_large && pivot.is_finite() {
            Ok(())
        } else {
            Err(self.not_definite(place, pivot))
        }
    }

    fn not_definite(&self, place: usize, pivot: f64) -> PivotNotPositive {
        let index = self.analysis.order[place];
        PivotNotPositive {
            index,
            pivot,
            diagonal: self.matrix.diagonal(index),
        }
    }

    /// The dense matrix of a front before elimination: its rows of the matrix, and what its
    /// children leave.
    fn gather(&mut self, front: &Front) -> DenseFront {
        let own = front.own();
        let order = front.order();
        let rest = order - own;

        let places = (front.begin..front.end).chain(front.border.iter().copied());
        for (row, place) in places.enumerate() {
            self.local[place] = row;
        }

        let mut dense = DenseFront {
            panel: vec![0.0; order * own],
            update: vec![0.0; rest * rest],
        };
        self.write_matrix(front, &mut dense);

        for &child in &front.children {
            self.add_child(front, child, &mut dense);
        }
        dense
    }

    /// Writes the entries of the matrix in the columns of the front's own unknowns, on and below
    /// the diagonal.
    fn write_matrix(&self, front: &Front, dense: &mut DenseFront) {
        let order = front.order();
        for (column, place) in (front.begin..front.end).enumerate() {
            for (unknown, value) in self.matrix.row(self.analysis.order[place]) {
                let other = self.analysis.place[unknown];
                if other != HELD && other >= place {
                    dense.panel[column * order + self.local[other]] = value;
                }
            }
        }
    }

    /// Adds the update of a child, and frees it.
    fn add_child(&mut self, front: &Front, child: usize, dense: &mut DenseFront) {
        let own = front.own();
        let order = front.order();
        let rest = order - own;
        let border = &self.analysis.fronts[child].border;
        let size = border.len();
        let update = take(&mut self.updates[child]);

        for (k, &place) in border.iter().enumerate() {
            let given = &update[k * size..(k + 1) * size];
            let column = self.local[place];

            // The column of the dense matrix to which this one adds, and its first row.
            let (target, first_row) = if column < own {
                (&mut dense.panel[column * order..][..order], 0)
            } else {
                (&mut dense.update[(column - own) * rest..][..rest], own)
            };

            // Places ascend in both lists, so lower triangles add to lower triangles.
            for row in k..size {
                target[self.local[border[row]] - first_row] += given[row];
            }
        }
    }
}

/// The columns of a front's panel; none of a front in which nothing is eliminated, which may have
/// no rows either.
fn columns<'a>(front: &Front, panel: &'a [f64]) -> std::slice::ChunksExact<'a, f64> {
    panel.chunks_exact(front.order().max(1))
}

impl SchurFactor<'_> {
    /// The Schur complement, symmetric, by rows, in the order of the kept unknowns.
    pub fn schur(&self) -> &[Vec<f64>] {
        &self.schur
    }

    /// E c = (-F^-1 B c, c): all unknowns that balance the given values of the kept ones; held ones
    /// 0.
    pub fn extend(&self, kept: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.analysis.order.len()];
        x[self.analysis.eliminated..].copy_from_slice(kept);

        self.backward(&mut x);
        self.by_unknowns(&x)
    }

    /// E' g = g_c - B' F^-1 g_f: what loads on all unknowns are worth on the kept ones.
    pub fn restrict(&self, g: &[f64]) -> Vec<f64> {
        let mut x = self.by_places(g);
        self.forward(&mut x);
        x.split_off(self.analysis.eliminated)
    }

    /// F^-1 g on the eliminated unknowns, 0 elsewhere.
    pub fn solve(&self, g: &[f64]) -> Vec<f64> {
        let mut x = self.by_places(g);
        self.forward(&mut x);

        x[self.analysis.eliminated..].fill(0.0);
        self.backward(&mut x);
        self.by_unknowns(&x)
    }

    /// A vector over the unknowns in the order of elimination, without those held.
    fn by_places(&self, g: &[f64]) -> Vec<f64> {
        self.analysis.order.iter().map(|&i| g[i]).collect()
    }

    /// A vector in the order of elimination as one over the unknowns, 0 where they are held.
    fn by_unknowns(&self, x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.analysis.place.len()];
        for (&unknown, value) in self.analysis.order.iter().zip(x) {
            out[unknown] = *value;
        }
        out
    }

    /// Replaces x_f by L^-1 x_f on the eliminated places and x_c by x_c - B' F^-1 x_f on the kept
    /// ones.
    fn forward(&self, x: &mut [f64]) {
        for (front, panel) in self.analysis.fronts.iter().zip(&self.panels) {
            for (c, column) in columns(front, panel).enumerate() {
                let pivot = front.begin + c;
                let value = x[pivot] / column[c];
                x[pivot] = value;

                let (own, border) = column.split_at(front.own());
                for row in c + 1..own.len() {
                    x[front.begin + row] -= own[row] * value;
                }

                for (&place, l) in front.border.iter().zip(border) {
                    x[place] -= l * value;
                }
            }
        }
    }

    /// Replaces x_f by L^-T (x_f - L^-1 B x_c) on the eliminated places, for the x_c of the kept
    /// ones.
    fn backward(&self, x: &mut [f64]) {
        for (front, panel) in self.analysis.fronts.iter().zip(&self.panels).rev() {
            for (c, column) in columns(front, panel).enumerate().rev() {
                let pivot = front.begin + c;
                let (own, border) = column.split_at(front.own());

                let own_values = &x[front.begin..front.end];
                let own_terms = own_values.iter().zip(own).skip(c + 1);
                let inside: f64 = own_terms.map(|(x, l)| x * l).sum();

                let border_terms = front.border.iter().zip(border);
                let outside: f64 = border_terms.map(|(&place, l)| x[place] * l).sum();

                x[pivot] = (x[pivot] - inside - outside) / column[c];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The five-point Laplacian of a grid of n x n nodes plus a shift of the diagonal.
    fn laplacian(n: usize, shift: f64) -> Symmetric {
        let mut entries = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let node = i * n + j;
                let mut neighbours = Vec::new();
                if i > 0 {
                    neighbours.push(node - n);
                }
                if i + 1 < n {
                    neighbours.push(node + n);
                }
                if j > 0 {
                    neighbours.push(node - 1);
                }
                if j + 1 < n {
                    neighbours.push(node + 1);
                }

                entries.push((node, node, shift + neighbours.len() as f64));
                for neighbour in neighbours {
                    entries.push((node, neighbour, -1.0));
                }
            }
        }

        Symmetric::new(n * n, entries).unwrap()
    }

    /// The positions of the nodes.
    fn positions(n: usize) -> Vec<[f64; 2]> {
        let nodes = 0..n * n;
        nodes.map(|k| [(k / n) as f64, (k % n) as f64]).collect()
    }

    /// Uncoupled unknowns make fronts in which nothing is eliminated and nothing touches anything.
    #[test]
    fn uncoupled_unknowns_are_eliminated_too() {
        let n = 60;
        let mut entries: Vec<(usize, usize, f64)> = (0..n).map(|i| (i, i, 4.0)).collect();
        entries.extend([(0, n - 1, 2.0), (n - 1, 0, 2.0)]);
        let matrix = Symmetric::new(n, entries).unwrap();
        let analysis = SymbolicAnalysis::new(&matrix, &[n - 1], &[], None);
        let factor = analysis.factor(&matrix).unwrap();

        assert_eq!(factor.schur(), [vec![3.0]]);
        let extended = factor.extend(&[1.0]);
        assert_eq!((extended[0], extended[1]), (-0.5, 0.0));
        let ones = vec![1.0; n];
        assert_eq!(factor.restrict(&ones), [0.5]);
        assert_eq!(factor.solve(&ones)[1], 0.25);
    }

    /// Rows and columns of a matrix as a dense one.
    fn dense(m: &Symmetric, rows: &[usize], cols: &[usize]) -> Vec<Vec<f64>> {
        let mut block = vec![vec![0.0; cols.len()]; rows.len()];
        for (a, &row) in rows.iter().enumerate() {
            for (col, value) in m.row(row) {
                if let Some(b) = cols.iter().position(|&c| c == col) {
                    block[a][b] = value;
                }
            }
        }

        block
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(x, y)| x * y).sum()
    }

    /// C - B' F^-1 B by dense LU.
    fn schur_by_lu(m: &Symmetric, kept: &[usize], held: &[usize]) -> Vec<Vec<f64>> {
        let all = 0..m.order();
        let rest: Vec<usize> = all
            .filter(|i| !kept.contains(i) && !held.contains(i))
            .collect();
        let right = dense(m, kept, &rest);
        let solved = crate::linear::solve(&dense(m, &rest, &rest), &right).unwrap();

        let mut schur = dense(m, kept, kept);
        for i in 0..kept.len() {
            for j in 0..kept.len() {
                schur[i][j] -= dot(&right[i], &solved[j]);
            }
        }

        schur
    }

    /// The Schur complement of the kept unknowns, without positions.
    fn schur(m: &Symmetric, kept: &[usize]) -> Result<Vec<Vec<f64>>, PivotNotPositive> {
        let analysis = SymbolicAnalysis::new(m, kept, &[], None);
        let factor = analysis.factor(m)?;
        Ok(factor.schur().to_vec())
    }

    #[test]
    fn the_schur_complement_is_that_of_dense_elimination() {
        let m = laplacian(13, 0.1);
        let points = positions(13);
        let kept = [4, 2, 100, 168, 0];
        let held = [7, 8, 90];
        let expected = schur_by_lu(&m, &kept, &held);

        for points in [None, Some(points.as_slice())] {
            let analysis = SymbolicAnalysis::new(&m, &kept, &held, points);
            assert!(analysis.fronts.len() > 5);

            let factor = analysis.factor(&m).unwrap();
            for i in 0..kept.len() {
                for j in 0..kept.len() {
                    let got = factor.schur()[i][j];
                    approx::assert_abs_diff_eq!(got, expected[i][j], epsilon = 1e-13);
                }
            }
        }
    }

    #[test]
    fn extension_balances_and_restriction_is_its_transpose() {
        let m = laplacian(9, 0.01);
        let kept = [40, 3];
        let held = [11];
        let eliminated: Vec<usize> = (0..81).filter(|i| ![40, 3, 11].contains(i)).collect();
        let analysis = SymbolicAnalysis::new(&m, &kept, &held, None);
        let factor = analysis.factor(&m).unwrap();

        // An extension takes the values of the kept unknowns and loads no eliminated one.
        let x = factor.extend(&[2.0, -1.0]);
        assert_eq!(x[40], 2.0);
        assert_eq!(x[3], -1.0);
        assert_eq!(x[11], 0.0);

        let load = m.times(&x);
        for &i in &eliminated {
            assert!(load[i].abs() < 1e-13, "{i}");
        }
        for (k, &i) in kept.iter().enumerate() {
            let row = &factor.schur()[k];
            let expected = 2.0 * row[0] - row[1];
            approx::assert_relative_eq!(load[i], expected, epsilon = 1e-13);
        }

        let g: Vec<f64> = (0..81).map(|i| (i as f64).sin()).collect();
        let restricted = factor.restrict(&g);
        let on_kept = dot(&restricted, &[2.0, -1.0]);

        approx::assert_relative_eq!(on_kept, dot(&g, &x), epsilon = 1e-12);

        let balanced = m.times(&factor.solve(&g));
        for &i in &eliminated {
            assert!((balanced[i] - g[i]).abs() < 1e-12, "{i}");
        }
    }

    #[test]
    fn singular_and_indefinite_matrices_are_refused() {
        let singular = laplacian(8, 0.0);
        let refused = schur(&singular, &[]).unwrap_err();
        assert!(refused.diagonal > 0.0, "{refused:?}");
        assert!(
            refused.pivot.is_nan() || refused.pivot <= 1e-12,
            "{refused:?}"
        );
        assert!(schur(&laplacian(8, -0.5), &[]).is_err());

        // With one unknown kept the others are definite, and nothing is left of the kept one.
        assert!(schur(&singular, &[5]).unwrap()[0][0].abs() < 1e-13);

        let row_of_zeros = Symmetric::new(2, [(0, 0, 1.0)]).unwrap();
        assert!(schur(&row_of_zeros, &[]).is_err());

        let nothing = Symmetric::new(0, []).unwrap();
        assert!(schur(&nothing, &[]).unwrap().is_empty());
    }
}
