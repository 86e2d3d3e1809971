//! Determinants of all supports of a block modulo a prime, at all interpolation points at once.
//!
//! The supports form a tree: at index m - 1 a support either contains it or not. Containing it is
//! one elimination step (a rank-one update of what is left), so neighbouring supports share all
//! steps but the last few, and all 2^n determinants together cost O(2^n) multiplications per point
//! (Griffin and Tsatsomeros 2006). The last three indices are closed formulas.

use super::integral::Integral;
use crate::exact::{Field, Integer};
use num_integer::Integer as _;
use num_traits::ToPrimitive;

/// The pencil modulo one prime at the interpolation points, free variables eliminated.
#[derive(Debug)]
pub(super) struct Minors {
    pub(super) field: Field,
    /// The points, in Montgomery form.
    pub(super) points: Vec<u64>,
    free: usize,
    slip: usize,
    /// T_ij at point q: `(i * order + j) * points + q`.
    full: Vec<u64>,
    /// Schur complement of the free block, likewise over slip variables; `None` where the free
    /// block vanishes at a point.
    root: Option<Matrix>,
    /// What row k of the slip variables adds to the bits of a determinant, summed over rows < k.
    bits_below: Vec<f64>,
    /// The free rows' bits.
    bits_free: f64,
}

/// A square matrix at all points with the determinant that was divided out.
#[derive(Debug, Clone, Default)]
struct Matrix {
    stride: usize,
    entries: Vec<u64>,
    det: Vec<u64>,
}

impl Minors {
    /// The pencil modulo `prime` at `count` points.
    pub(super) fn new(pencil: &Integral, prime: u64, count: usize) -> Minors {
        let field = Field::new(prime);
        let mut points: Vec<u64> = Vec::with_capacity(count);
        for t in spread().map(|v| field.enter(v % prime)) {
            if points.len() == count {
                break;
            }
            if !points.contains(&t) {
                points.push(t); // interpolation needs them distinct
            }
        }
        let residue = |v: &Integer| field.enter(v.mod_floor(&prime.into()).to_u64().unwrap_or(0)); // 0 <= v < prime
        let n = pencil.a.len();
        let mut full = Vec::with_capacity(n * n * count);
        for (ra, rb) in pencil.a.iter().zip(&pencil.b) {
            for (a, b) in ra.iter().zip(rb) {
                let (a, b) = (residue(a), residue(b));
                full.extend(points.iter().map(|&t| field.add(a, field.mul(b, t))));
            }
        }
        let bits_below = (0..=pencil.slip).map(|k| (0..k).map(|i| pencil.row_bits(pencil.free + i)).sum()).collect();
        let bits_free = (0..pencil.free).map(|i| pencil.row_bits(i)).sum();
        let mut minors = Minors { field, points, free: pencil.free, slip: pencil.slip, full, root: None, bits_below, bits_free };
        minors.root = minors.eliminate_free();
        minors
    }

    /// Determinants of the supports `high << low_bits | sub` for all sub: `values[sub * points + q]`.
    /// Supports of which Hadamard's bound is below `from_bits` are left out (their values stay).
    pub(super) fn block(&self, high: u64, low_bits: usize, from_bits: f64, values: &mut Vec<u64>) {
        values.resize((1 << low_bits) * self.points.len(), 0);
        let mut walk = Walk { minors: self, high, low_bits, from_bits, values, scratch: vec![Matrix::default(); low_bits + 1] };
        let picked = |k: usize| high >> (k - low_bits) & 1 == 1;
        let bits =
            self.bits_free + (low_bits..self.slip).filter(|&k| picked(k)).map(|k| self.bits_below[k + 1] - self.bits_below[k]).sum::<f64>();
        if bits + self.bits_below[low_bits] < from_bits {
            return;
        }
        let mut matrix = self.root.clone();
        for k in (low_bits..self.slip).rev().filter(|&k| picked(k)) {
            let mut next = Matrix::default();
            let done = matrix.as_ref().is_some_and(|m| self.eliminate(m, k, &mut next));
            matrix = done.then_some(next);
        }
        match matrix {
            Some(m) => walk.descend(&m, low_bits, 0, bits),
            None => (0..1 << low_bits).for_each(|sub| walk.direct(sub)),
        }
    }

    /// One step: pivot at index k, the leading k x k rest into `out`. False where a pivot is zero.
    fn eliminate(&self, m: &Matrix, k: usize, out: &mut Matrix) -> bool {
        let (f, q) = (&self.field, self.points.len());
        let pivot = &m.entries[(k * m.stride + k) * q..][..q];
        if pivot.contains(&0) {
            return false;
        }
        out.det.clear();
        out.det.extend(m.det.iter().zip(pivot).map(|(&d, &p)| f.mul(d, p)));
        out.stride = k;
        out.entries.clear();
        if k == 0 {
            return true;
        }
        let inverse = invert_all(f, pivot);
        let mut factor = vec![0; q];
        for i in 0..k {
            let column = &m.entries[(i * m.stride + k) * q..][..q];
            factor.iter_mut().zip(column.iter().zip(&inverse)).for_each(|(x, (&c, &v))| *x = f.mul(c, v));
            let top = &m.entries[k * m.stride * q..][..k * q];
            let row = &m.entries[i * m.stride * q..][..k * q];
            for (entries, tops) in row.chunks_exact(q).zip(top.chunks_exact(q)) {
                out.entries.extend(entries.iter().zip(tops).zip(&factor).map(|((&e, &t), &x)| f.sub(e, f.mul(x, t))));
            }
        }
        true
    }

    /// The Schur complement of the free block at every point, or `None` where that is singular.
    fn eliminate_free(&self) -> Option<Matrix> {
        let (q, n) = (self.points.len(), self.free + self.slip);
        let mut root = Matrix { stride: self.slip, entries: vec![0; self.slip * self.slip * q], det: vec![0; q] };
        for point in 0..q {
            let mut m: Vec<Vec<u64>> = (0..n).map(|i| (0..n).map(|j| self.full[(i * n + j) * q + point]).collect()).collect();
            root.det[point] = triangulate(&self.field, &mut m, self.free)?;
            for i in 0..self.slip {
                for j in 0..self.slip {
                    root.entries[(i * self.slip + j) * q + point] = m[self.free + i][self.free + j];
                }
            }
        }
        Some(root)
    }

    /// The determinant of one support at one point, by elimination with row exchanges.
    fn determinant(&self, mask: u64, point: usize) -> u64 {
        let (q, n) = (self.points.len(), self.free + self.slip);
        let slip = (0..self.slip).filter(|k| mask >> k & 1 == 1).map(|k| self.free + k);
        let active: Vec<usize> = (0..self.free).chain(slip).collect();
        let mut m: Vec<Vec<u64>> = active.iter().map(|&i| active.iter().map(|&j| self.full[(i * n + j) * q + point]).collect()).collect();
        triangulate(&self.field, &mut m, active.len()).unwrap_or(0)
    }
}

/// The walk through the supports of one block.
struct Walk<'a> {
    minors: &'a Minors,
    high: u64,
    low_bits: usize,
    from_bits: f64,
    values: &'a mut Vec<u64>,
    scratch: Vec<Matrix>,
}

impl Walk<'_> {
    /// All supports that agree with `sub` from index `m` on; `bits` bounds their common rows.
    fn descend(&mut self, matrix: &Matrix, m: usize, sub: usize, bits: f64) {
        if bits + self.minors.bits_below[m] < self.from_bits {
            return;
        }
        match m {
            0 => self.values[sub * matrix.det.len()..][..matrix.det.len()].copy_from_slice(&matrix.det),
            3 => self.last_three(matrix, sub),
            _ => {
                let k = m - 1;
                self.descend(matrix, k, sub, bits);
                let mut next = std::mem::take(&mut self.scratch[k]);
                if self.minors.eliminate(matrix, k, &mut next) {
                    let row = self.minors.bits_below[m] - self.minors.bits_below[k];
                    self.descend(&next, k, sub | 1 << k, bits + row);
                } else {
                    (0..1 << k).for_each(|rest| self.direct(sub | 1 << k | rest));
                }
                self.scratch[k] = next;
            }
        }
    }

    /// The eight supports of the last three indices by Leibniz' formulas.
    fn last_three(&mut self, matrix: &Matrix, sub: usize) {
        let (f, q) = (&self.minors.field, matrix.det.len());
        for point in 0..q {
            let at = |i: usize, j: usize| matrix.entries[(i * matrix.stride + j) * q + point];
            let minor = |i: usize, j: usize, k: usize, l: usize| f.sub(f.mul(at(i, k), at(j, l)), f.mul(at(i, l), at(j, k)));
            let lower = minor(1, 2, 1, 2);
            let triple = f.add(f.sub(f.mul(at(0, 0), lower), f.mul(at(0, 1), minor(1, 2, 0, 2))), f.mul(at(0, 2), minor(1, 2, 0, 1)));
            let all = [at(0, 0), at(1, 1), minor(0, 1, 0, 1), at(2, 2), minor(0, 2, 0, 2), lower, triple];
            let det = matrix.det[point];
            self.values[sub * q + point] = det;
            for (k, &v) in all.iter().enumerate() {
                self.values[(sub + k + 1) * q + point] = f.mul(det, v);
            }
        }
    }

    /// Where a pivot vanishes: each support by itself.
    fn direct(&mut self, sub: usize) {
        let q = self.minors.points.len();
        let mask = self.high << self.low_bits | sub as u64;
        for point in 0..q {
            self.values[sub * q + point] = self.minors.determinant(mask, point);
        }
    }
}

/// Eliminates the first `count` columns with row exchanges among the first `count` rows. Their
/// determinant, or `None` if it is zero.
fn triangulate(f: &Field, m: &mut [Vec<u64>], count: usize) -> Option<u64> {
    let mut det = f.enter(1);
    for k in 0..count {
        let r = (k..count).find(|&i| m[i][k] != 0)?;
        if r != k {
            m.swap(r, k);
            det = f.sub(0, det);
        }
        det = f.mul(det, m[k][k]);
        let inverse = f.invert(m[k][k]);
        let (above, below) = m.split_at_mut(k + 1);
        let pivot_row = &above[k];
        for row in below.iter_mut().filter(|row| row[k] != 0) {
            let factor = f.mul(row[k], inverse);
            for j in k + 1..row.len() {
                row[j] = f.sub(row[j], f.mul(factor, pivot_row[j]));
            }
        }
    }
    Some(det)
}

/// All inverses for the price of one (Montgomery 1987); no value is zero.
fn invert_all(f: &Field, values: &[u64]) -> Vec<u64> {
    let mut out = Vec::with_capacity(values.len());
    let mut product = f.enter(1);
    for &v in values {
        out.push(product);
        product = f.mul(product, v);
    }
    let mut inverse = f.invert(product);
    for (o, &v) in out.iter_mut().zip(values).rev() {
        *o = f.mul(*o, inverse);
        inverse = f.mul(inverse, v);
    }
    out
}

/// Points spread over 64 bits (the generator SplitMix64): a minor that is not identically zero
/// vanishes at one of them only by chance, and then costs time, not correctness.
fn spread() -> impl Iterator<Item = u64> {
    (1u64..).map(|k| {
        let z = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Sparse, primes};
    use crate::model::Pencil;

    fn check(a: &[&[i64]], b: &[&[i64]], free: &[usize]) {
        let pencil = Integral::of(&Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap());
        let minors = Minors::new(&pencil, primes().next().unwrap(), 4);
        for low in 0..=pencil.slip {
            for high in 0..1u64 << (pencil.slip - low) {
                let mut values = Vec::new();
                minors.block(high, low, 0.0, &mut values);
                for (sub, at) in values.chunks(4).enumerate() {
                    let mask = high << low | sub as u64;
                    let want: Vec<u64> = (0..4).map(|q| minors.determinant(mask, q)).collect();
                    assert_eq!(at, want, "mask {mask} in blocks of 2^{low}");
                }
            }
        }
    }

    #[test]
    fn the_tree_agrees_with_single_determinants() {
        let a: &[&[i64]] = &[&[3, -9, 1, 2, 5], &[4, 5, 0, 1, -1], &[-7, 2, 8, 0, 3], &[1, 1, 2, 3, 5], &[0, 4, -4, 2, 1]];
        let b: &[&[i64]] = &[&[1, 0, 2, -2, 0], &[1, -2, 6, 0, 7], &[9, 9, -9, 1, 0], &[0, 0, 0, 0, 0], &[1, 2, 3, 4, 5]];
        check(a, b, &[]);
        check(a, b, &[1, 3]);
    }

    #[test]
    fn vanishing_pivots_cost_time_not_truth() {
        let a: &[&[i64]] = &[&[0, 1, 1, 1], &[1, 0, 1, 1], &[1, 1, 0, 0], &[2, 1, 0, 0]];
        check(a, &[&[0, 1, 0, 0], &[0, 0, 0, 0], &[0, 0, 0, 3], &[0, 1, 0, 0]], &[]);
        check(a, a, &[0]);
    }

    #[test]
    fn small_bounds_are_left_out() {
        let a = Sparse::from_ints(&[&[2, 1], &[1, 3]]);
        let pencil = Integral::of(&Pencil::new(a.clone(), a, vec![]).unwrap());
        let minors = Minors::new(&pencil, primes().next().unwrap(), 3);
        let mut values = Vec::new();
        minors.block(0, 2, 3.0, &mut values);
        assert!(values[..3].iter().all(|&v| v == 0) && values[9..].iter().all(|&v| v != 0));
    }
}
