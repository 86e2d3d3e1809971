//! The linear subproblem of a path: find z with M z + q complementary to the bounds on it.

use super::super::dense::subtract;
use super::super::number::PathNumber;
use nalgebra::DMatrix;

/// The linear MCP: M z + q on [lower, upper].
pub(in super::super) struct Subproblem<'a, T: PathNumber = f64> {
    pub(in super::super) m: &'a DMatrix<T>,
    pub(in super::super) q: &'a [T],
    pub(in super::super) lower: &'a [T],
    pub(in super::super) upper: &'a [T],
}

impl<T: PathNumber> Subproblem<'_, T> {
    /// A column of M.
    pub(super) fn column(&self, j: usize) -> &[T] {
        let n = self.q.len();
        &self.m.as_slice()[j * n..(j + 1) * n]
    }

    /// M z + q, into `out`.
    pub(super) fn value(&self, z: &[T], out: &mut Vec<T>) {
        out.clear();
        out.extend_from_slice(self.q);

        for (j, z) in z.iter().enumerate() {
            subtract(out, &-z.clone(), self.column(j));
        }
    }
}
