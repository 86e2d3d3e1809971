//! Sparse Cholesky factors front by front (Duff and Reid 1983), and the Schur complement they end
//! with.
//!
//! Each front adds up its rows of the matrix and what its children leave, eliminates its own
//! unknowns by dense kernels and passes the rest on. What is left at the end is the Schur
//! complement of the kept unknowns: no right-hand sides.

use super::analysis::{Analysis, Front};
use super::dense::eliminate_front;
use super::symmetric::Symmetric;
use crate::tolerance::SINGULAR_PIVOT;

/// The matrix is not positive definite on the eliminated unknowns, as far as doubles can tell.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "expected a positive definite matrix, got a pivot {pivot} at index {index} (diagonal entry \
     {diagonal})"
)]
pub struct NotDefinite {
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
    analysis: &'a Analysis,
    /// For each front its columns of L (own + border rows), by columns.
    panels: Vec<Vec<f64>>,
    /// Z by rows.
    schur: Vec<Vec<f64>>,
}

impl Analysis {
    /// Factors a matrix of the analysed pattern (or less).
    ///
    /// # Errors
    /// [`NotDefinite`].
    pub fn factor(&self, matrix: &Symmetric) -> Result<SchurFactor<'_>, NotDefinite> {
        let kept = self.order.len() - self.eliminated;
        let mut local = vec![usize::MAX; self.order.len()];
        let mut updates: Vec<Vec<f64>> = vec![Vec::new(); self.fronts.len()];
        let mut panels = Vec::with_capacity(self.fronts.len());
        for (k, front) in self.fronts.iter().enumerate() {
            (front.begin..front.end)
                .chain(front.border.iter().copied())
                .enumerate()
                .for_each(|(l, p)| local[p] = l);
            let (panel, update) = self.eliminate(matrix, front, &mut updates, &local)?;
            panels.push(panel);
            updates[k] = update;
        }
        let all = Front {
            begin: self.eliminated,
            end: self.order.len(),
            border: Vec::new(),
            children: self.roots(),
        };
        (all.begin..all.end).for_each(|p| local[p] = p - all.begin);
        let (panel, _) = self.gather(matrix, &all, &mut updates, &local);
        let schur = (0..kept)
            .map(|i| {
                (0..kept)
                    .map(|j| panel[i.min(j) * kept + i.max(j)])
                    .collect()
            })
            .collect();
        Ok(SchurFactor {
            analysis: self,
            panels,
            schur,
        })
    }

    /// Fronts that pass what is left to no other.
    fn roots(&self) -> Vec<usize> {
        let mut is_child = vec![false; self.fronts.len()];
        self.fronts
            .iter()
            .flat_map(|f| &f.children)
            .for_each(|&c| is_child[c] = true);
        (0..self.fronts.len()).filter(|&k| !is_child[k]).collect()
    }

    /// The columns of a front and its lower right part, before elimination.
    fn gather(
        &self,
        matrix: &Symmetric,
        front: &Front,
        updates: &mut [Vec<f64>],
        local: &[usize],
    ) -> (Vec<f64>, Vec<f64>) {
        let (own, order) = (front.own(), front.order());
        let rest = order - own;
        let (mut panel, mut update) = (vec![0.0; order * own], vec![0.0; rest * rest]);
        for (c, place) in (front.begin..front.end).enumerate() {
            for (j, v) in matrix.row(self.order[place]) {
                let p = self.place[j];
                if p != usize::MAX && p >= place {
                    panel[c * order + local[p]] = v;
                }
            }
        }
        for &child in &front.children {
            let (border, given) = (
                &self.fronts[child].border,
                std::mem::take(&mut updates[child]),
            );
            let size = border.len();
            for (c, &p) in border.iter().enumerate() {
                let (column, rows) = (local[p], &given[c * size..(c + 1) * size]);
                // Places ascend in both lists, so lower triangles add to lower triangles.
                let (target, shift) = match column < own {
                    true => (&mut panel[column * order..(column + 1) * order], 0),
                    false => (
                        &mut update[(column - own) * rest..(column - own + 1) * rest],
                        own,
                    ),
                };
                (c..size).for_each(|r| target[local[border[r]] - shift] += rows[r]);
            }
        }
        (panel, update)
    }

    fn eliminate(
        &self,
        matrix: &Symmetric,
        front: &Front,
        updates: &mut [Vec<f64>],
        local: &[usize],
    ) -> Result<(Vec<f64>, Vec<f64>), NotDefinite> {
        let (mut panel, mut update) = self.gather(matrix, front, updates, local);
        if front.own() == 0 {
            return Ok((panel, update));
        }
        let at = |c: usize| {
            (
                self.order[front.begin + c],
                matrix.diagonal(self.order[front.begin + c]),
            )
        };
        if !eliminate_front(&mut panel, &mut update, front.order(), front.own()) {
            let (index, diagonal) = at(0);
            return Err(NotDefinite {
                index,
                pivot: f64::NAN,
                diagonal,
            });
        }
        for c in 0..front.own() {
            let (pivot, (index, diagonal)) = (panel[c * front.order() + c].powi(2), at(c));
            // Also refuses NaN, of an overflow.
            if !(pivot > SINGULAR_PIVOT * diagonal.abs() && pivot.is_finite()) {
                return Err(NotDefinite {
                    index,
                    pivot,
                    diagonal,
                });
            }
        }
        Ok((panel, update))
    }
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
        self.scattered(&x)
    }

    /// E' g = g_c - B' F^-1 g_f: what loads on all unknowns are worth on the kept ones.
    pub fn restrict(&self, g: &[f64]) -> Vec<f64> {
        let mut x = self.gathered(g);
        self.forward(&mut x);
        x.split_off(self.analysis.eliminated)
    }

    /// F^-1 g on the eliminated unknowns, 0 elsewhere.
    pub fn solve(&self, g: &[f64]) -> Vec<f64> {
        let mut x = self.gathered(g);
        self.forward(&mut x);
        x[self.analysis.eliminated..].fill(0.0);
        self.backward(&mut x);
        self.scattered(&x)
    }

    fn gathered(&self, g: &[f64]) -> Vec<f64> {
        self.analysis.order.iter().map(|&i| g[i]).collect()
    }

    fn scattered(&self, x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.analysis.place.len()];
        self.analysis
            .order
            .iter()
            .zip(x)
            .for_each(|(&i, v)| out[i] = *v);
        out
    }

    /// L^-1 on the eliminated places; the kept ones have their part taken off.
    fn forward(&self, x: &mut [f64]) {
        for (front, panel) in self.analysis.fronts.iter().zip(&self.panels) {
            for (c, column) in panel.chunks_exact(front.order()).enumerate() {
                let value = x[front.begin + c] / column[c];
                x[front.begin + c] = value;
                let (own, border) = column.split_at(front.own());
                x[front.begin..front.end]
                    .iter_mut()
                    .zip(own)
                    .skip(c + 1)
                    .for_each(|(x, l)| *x -= l * value);
                front
                    .border
                    .iter()
                    .zip(border)
                    .for_each(|(&p, l)| x[p] -= l * value);
            }
        }
    }

    /// L^-T on the eliminated places, given the kept ones.
    fn backward(&self, x: &mut [f64]) {
        for (front, panel) in self.analysis.fronts.iter().zip(&self.panels).rev() {
            for (c, column) in panel.chunks_exact(front.order()).enumerate().rev() {
                let (own, border) = column.split_at(front.own());
                let inside: f64 = x[front.begin..front.end]
                    .iter()
                    .zip(own)
                    .skip(c + 1)
                    .map(|(x, l)| x * l)
                    .sum();
                let outside: f64 = front
                    .border
                    .iter()
                    .zip(border)
                    .map(|(&p, l)| x[p] * l)
                    .sum();
                x[front.begin + c] = (x[front.begin + c] - inside - outside) / column[c];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The five-point Laplacian of an n x n grid plus a shift, with positions.
    fn laplacian(n: usize, shift: f64) -> (Symmetric, Vec<[f64; 2]>) {
        let at = |i: usize, j: usize| i * n + j;
        let mut list = Vec::new();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let near = [
                (i.wrapping_sub(1), j),
                (i + 1, j),
                (i, j.wrapping_sub(1)),
                (i, j + 1),
            ];
            let near: Vec<_> = near.into_iter().filter(|&(a, b)| a < n && b < n).collect();
            list.push((at(i, j), at(i, j), shift + near.len() as f64));
            list.extend(near.into_iter().map(|(a, b)| (at(i, j), at(a, b), -1.0)));
        }
        let points = (0..n * n)
            .map(|k| [(k / n) as f64, (k % n) as f64])
            .collect();
        (Symmetric::new(n * n, list).unwrap(), points)
    }

    fn dense(m: &Symmetric, rows: &[usize], cols: &[usize]) -> Vec<Vec<f64>> {
        let at = |i: usize, j: usize| m.row(i).find(|e| e.0 == j).map_or(0.0, |e| e.1);
        rows.iter()
            .map(|&i| cols.iter().map(|&j| at(i, j)).collect())
            .collect()
    }

    /// C - B' F^-1 B by dense LU.
    fn by_lu(m: &Symmetric, kept: &[usize], held: &[usize]) -> Vec<Vec<f64>> {
        let rest: Vec<usize> = (0..m.order())
            .filter(|i| !kept.contains(i) && !held.contains(i))
            .collect();
        let right = dense(m, kept, &rest);
        let w = crate::linear::solve(&dense(m, &rest, &rest), &right).unwrap();
        let c = dense(m, kept, kept);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        (0..kept.len())
            .map(|i| {
                (0..kept.len())
                    .map(|j| c[i][j] - dot(&right[i], &w[j]))
                    .collect()
            })
            .collect()
    }

    #[test]
    fn the_schur_complement_is_that_of_dense_elimination() {
        let (m, points) = laplacian(13, 0.1);
        let (kept, held) = ([4, 2, 100, 168, 0], [7, 8, 90]);
        let expected = by_lu(&m, &kept, &held);
        for points in [None, Some(points.as_slice())] {
            let analysis = Analysis::new(&m, &kept, &held, points);
            assert!(analysis.fronts.len() > 5);
            let factor = analysis.factor(&m).unwrap();
            for (row, other) in factor.schur().iter().zip(&expected) {
                row.iter()
                    .zip(other)
                    .for_each(|(a, b)| approx::assert_abs_diff_eq!(*a, *b, epsilon = 1e-13));
            }
        }
    }

    #[test]
    fn extension_balances_and_restriction_is_its_transpose() {
        let (m, _) = laplacian(9, 0.01);
        let (kept, held) = ([40, 3], [11]);
        let analysis = Analysis::new(&m, &kept, &held, None);
        let factor = analysis.factor(&m).unwrap();
        let x = factor.extend(&[2.0, -1.0]);
        assert_eq!((x[40], x[3], x[11]), (2.0, -1.0, 0.0));
        let load = m.times(&x);
        let free = |i: &usize| ![40, 3, 11].contains(i);
        assert!((0..81).filter(free).all(|i| load[i].abs() < 1e-13));
        for (k, &i) in kept.iter().enumerate() {
            approx::assert_relative_eq!(
                load[i],
                2.0 * factor.schur()[k][0] - factor.schur()[k][1],
                epsilon = 1e-13
            );
        }
        let g: Vec<f64> = (0..81).map(|i| (i as f64).sin()).collect();
        let small = factor.restrict(&g);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        approx::assert_relative_eq!(dot(&small, &[2.0, -1.0]), dot(&g, &x), epsilon = 1e-12);
        let solved = m.times(&factor.solve(&g));
        assert!(
            (0..81)
                .filter(free)
                .all(|i| (solved[i] - g[i]).abs() < 1e-12)
        );
    }

    #[test]
    fn singular_and_indefinite_matrices_are_refused() {
        let (singular, _) = laplacian(8, 0.0);
        let at = |m: &Symmetric, kept: &[usize]| {
            Analysis::new(m, kept, &[], None)
                .factor(m)
                .map(|f| f.schur().to_vec())
        };
        let refused = at(&singular, &[]).unwrap_err();
        assert!(
            refused.diagonal > 0.0 && (refused.pivot.is_nan() || refused.pivot <= 1e-12),
            "{refused:?}"
        );
        assert!(at(&laplacian(8, -0.5).0, &[]).is_err());
        // With one unknown kept the others are definite, and nothing is left of the kept one.
        assert!(at(&singular, &[5]).unwrap()[0][0].abs() < 1e-13);
        assert!(
            at(&Symmetric::new(2, [(0, 0, 1.0)]).unwrap(), &[]).is_err(),
            "a row of zeros"
        );
        assert!(at(&Symmetric::new(0, []).unwrap(), &[]).unwrap().is_empty());
    }
}
