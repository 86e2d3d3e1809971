//! The eigenproblem without the bound t >= 0 and without a point at infinity: (alpha A + beta B) x
//! = y with alpha^2 + beta^2 = 1, t = beta / alpha. On it the curves through solutions have nowhere
//! to end.
//!
//! Unknowns (u_s, alpha, beta), x = D u as in [`Embedding`], free variables condensed in doubles.
//! Rows: (alpha A + beta unit B) u complementary to u_s, e'u_s = 1, alpha^2 + beta^2 = 1. Where
//! alpha <= 0 or beta < 0 its solutions are none of the eigenproblem; curves pass there from one
//! solution to another. With e'u_s = 1 and a residual direction of both signs u, alpha, beta and s
//! are all bounded: every curve closes, where those of the embedding mostly run off to t = 0 or to
//! infinity.
#![allow(clippy::float_arithmetic)]

use super::embed::Embedding;
use crate::candidate::Candidate;
use crate::tolerance::CIRCLE_END;
use mceip_mcp::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// An eigenproblem on the circle, in doubles.
#[derive(Debug, Clone)]
pub struct CirclePencil {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    slip: Vec<usize>,
    free: Vec<usize>,
    /// u_f = -lines u_s.
    lines: DMatrix<f64>,
    diagonal: Vec<f64>,
    unit: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl CirclePencil {
    /// The problem of an embedding. `None` if a free row of B is not zero, as in MCEIP-lambda2
    /// (then the free variables cannot be condensed once for all t), or if A_ff is singular in
    /// doubles.
    pub fn new(embedding: &Embedding) -> Option<CirclePencil> {
        let Embedding {
            a,
            b,
            is_free,
            diagonal,
            unit,
            ..
        } = embedding;
        let (free, slip): (Vec<usize>, Vec<usize>) = (0..is_free.len()).partition(|&i| is_free[i]);
        if free.iter().any(|&i| b.row(i).iter().any(|v| *v != 0.0)) {
            return None;
        }
        let block = |m: &DMatrix<f64>, rows: &[usize], cols: &[usize]| {
            m.select_rows(rows).select_columns(cols)
        };
        // nalgebra's triangular solve underflows on 0 x 0.
        let lines = if free.is_empty() {
            DMatrix::zeros(0, slip.len())
        } else {
            block(a, &free, &free).lu().solve(&block(a, &free, &slip))?
        };
        let condensed = |m: &DMatrix<f64>| block(m, &slip, &slip) - block(m, &slip, &free) * &lines;
        let (a, b) = (condensed(a), condensed(b) * *unit);
        let n = slip.len();
        let lower = vec![0.0; n]
            .into_iter()
            .chain([f64::NEG_INFINITY; 2])
            .collect();
        let is_finite = a.iter().chain(b.iter()).all(|v| v.is_finite());
        is_finite.then(|| CirclePencil {
            a,
            b,
            slip,
            free,
            lines,
            diagonal: diagonal.clone(),
            unit: *unit,
            lower,
            upper: vec![f64::INFINITY; n + 2],
        })
    }

    /// The point of a value and x over all variables of the pencil (any positive scale with e'x_s >
    /// 0).
    pub fn point(&self, value: f64, x: &[f64]) -> Vec<f64> {
        let u: Vec<f64> = self.slip.iter().map(|&i| x[i] / self.diagonal[i]).collect();
        let (sum, beta) = (u.iter().sum::<f64>(), value / self.unit);
        let norm = beta.hypot(1.0);
        u.iter()
            .map(|v| v / sum)
            .chain([1.0 / norm, beta / norm])
            .collect()
    }

    /// The candidate that a point stands for, over all variables; `None` where t would be negative
    /// or infinite.
    pub fn candidate(&self, z: &[f64]) -> Option<Candidate> {
        let n = self.slip.len();
        let (alpha, beta) = (*z.get(n)?, *z.get(n + 1)?);
        let value = self.unit * beta / alpha;
        if !(alpha > CIRCLE_END && beta >= 0.0 && value.is_finite()) {
            return None;
        }
        let u_f = -(&self.lines * DVector::from_column_slice(&z[..n]));
        let mut x = vec![0.0; self.diagonal.len()];
        self.slip
            .iter()
            .zip(z)
            .for_each(|(&i, u)| x[i] = u * self.diagonal[i]);
        self.free
            .iter()
            .zip(u_f.iter())
            .for_each(|(&i, u)| x[i] = u * self.diagonal[i]);
        Some(Candidate { value, x })
    }

    /// A random residual direction as [`Embedding::direction`]'s: zero in the last two rows.
    pub fn direction(&self, seed: u64, uneven: bool) -> Vec<f64> {
        super::embed::normals(self.slip.len(), seed, uneven)
            .into_iter()
            .chain([0.0; 2])
            .collect()
    }
}

impl Mcp for CirclePencil {
    fn dimension(&self) -> usize {
        self.slip.len() + 2
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        let n = self.slip.len();
        let (alpha, beta) = (z[n], z[n + 1]);
        for i in 0..n {
            f[i] = (0..n)
                .map(|j| (alpha * self.a[(i, j)] + beta * self.b[(i, j)]) * z[j])
                .sum();
        }
        f[n] = z[..n].iter().sum::<f64>() - 1.0;
        f[n + 1] = alpha * alpha + beta * beta - 1.0;
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.slip.len();
        let (alpha, beta) = (z[n], z[n + 1]);
        j.fill(0.0);
        for i in 0..n {
            for k in 0..n {
                let (a, b) = (self.a[(i, k)], self.b[(i, k)]);
                j[(i, k)] = alpha * a + beta * b;
                j[(i, n)] += a * z[k];
                j[(i, n + 1)] += b * z[k];
            }
            j[(n, i)] = 1.0;
        }
        (j[(n + 1, n)], j[(n + 1, n + 1)]) = (2.0 * alpha, 2.0 * beta);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reduction::Side;
    use mceip_exact::{Sparse, parse};
    use mceip_mcp::solver::{CurveEnd, Options, Residuals, Sense, continuation_through};
    use mceip_model::{Admissible, Pencil, Unknown};

    fn embedding(a: &[&[&str]], b: &[&[&str]], free: &[usize], unknown: Unknown) -> Embedding {
        let sparse = |rows: &[&[&str]]| {
            let entries = rows.iter().enumerate().flat_map(|(i, r)| {
                r.iter()
                    .enumerate()
                    .map(move |(j, v)| (i, j, parse(v).unwrap()))
            });
            Sparse::from_entries(rows.len(), rows.len(), entries.collect::<Vec<_>>())
        };
        let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
        Embedding::new(
            &Admissible::new(&pencil, unknown).unwrap(),
            Side::Above(0.0),
        )
    }

    /// Variable 0 free: x_0 = -x_1 / 4, condensed A = diag(15/4, 2), B = [[0, -3], [-1, 0]], mu^2 =
    /// 5/2.
    fn free() -> CirclePencil {
        let a: [&[&str]; 3] = [&["4", "1", "0"], &["1", "4", "0"], &["0", "0", "2"]];
        let b: [&[&str]; 3] = [&["0", "0", "0"], &["0", "0", "-3"], &["0", "-1", "0"]];
        CirclePencil::new(&embedding(&a, &b, &[0], Unknown::Mu)).unwrap()
    }

    #[test]
    fn solutions_solve_it_and_come_back() {
        let circle = free();
        let mu = 2.5f64.sqrt();
        let x = [-0.25, 1.0, mu / 2.0];
        let z = circle.point(mu, &x);
        assert!(Residuals::at(&circle, &z).minimum_map < 1e-14);
        assert!(Residuals::at(&circle, &circle.point(1.01 * mu, &x)).minimum_map > 1e-4);
        let back = circle.candidate(&z).unwrap();
        approx::assert_relative_eq!(back.value, mu, epsilon = 1e-14);
        approx::assert_relative_eq!(back.x[0] / back.x[1], -0.25, epsilon = 1e-14);
        // t < 0, the far side of the circle, and infinity stand for nothing.
        for (alpha, beta) in [
            (0.6, -0.8),
            (-0.6, -0.8),
            (0.0, 1.0),
            (-1.0, 0.0),
            (0.9 * CIRCLE_END, 1.0),
            (CIRCLE_END, 1.0),
        ] {
            assert!(circle.candidate(&[0.5, 0.5, alpha, beta]).is_none());
        }
        assert_eq!(circle.candidate(&[0.5, 0.5, 1.0, 0.0]).unwrap().value, 0.0);
        assert!(
            circle
                .candidate(&[0.5, 0.5, 1.1 * CIRCLE_END, 1.0])
                .is_some()
        );
    }

    /// The variables of the pencil are scaled by its diagonal, here 4096 and 2: there and back.
    #[test]
    fn points_and_candidates_are_inverse_whatever_the_scale() {
        let circle = CirclePencil::new(&embedding(
            &[&["4096", "0"], &["0", "2"]],
            &[&["0", "-3"], &["-1", "0"]],
            &[],
            Unknown::Mu,
        ))
        .unwrap();
        assert_ne!(circle.diagonal[0], circle.diagonal[1]);
        let back = circle.candidate(&circle.point(1.5, &[1.0, 3.0])).unwrap();
        approx::assert_relative_eq!(back.value, 1.5, max_relative = 1e-14);
        approx::assert_relative_eq!(back.x[1] / back.x[0], 3.0, max_relative = 1e-14);
    }

    #[test]
    fn the_jacobian_is_that_of_the_function() {
        let circle = free();
        let (z, step, n) = ([0.3, 0.7, 0.6, -0.8], 1e-6, 4);
        let mut j = DMatrix::zeros(n, n);
        circle.jacobian(&z, &mut j);
        for k in 0..n {
            let at = |sign: f64| {
                let (mut moved, mut f) = (z, vec![0.0; n]);
                moved[k] += sign * step;
                circle.function(&moved, &mut f);
                f
            };
            for (i, (p, q)) in at(1.0).iter().zip(at(-1.0)).enumerate() {
                approx::assert_relative_eq!((p - q) / (2.0 * step), j[(i, k)], epsilon = 1e-8);
            }
        }
    }

    #[test]
    fn free_rows_that_move_with_t_have_no_circle() {
        let i: [&[&str]; 2] = [&["1", "0"], &["0", "1"]];
        assert!(CirclePencil::new(&embedding(&i, &i, &[0], Unknown::Lambda2)).is_none());
        assert!(CirclePencil::new(&embedding(&i, &i, &[], Unknown::Lambda2)).is_some());
    }

    /// A = ones, B = -I, order 4: every support of k variables solves at t = k, 15 solutions.
    #[test]
    fn curves_close_and_meet_what_they_left() {
        let a: [&[&str]; 4] = [&["1"; 4]; 4];
        let b: [&[&str]; 4] = [
            &["-1", "0", "0", "0"],
            &["0", "-1", "0", "0"],
            &["0", "0", "-1", "0"],
            &["0", "0", "0", "-1"],
        ];
        let circle = CirclePencil::new(&embedding(&a, &b, &[], Unknown::Mu)).unwrap();
        let start = circle.point(4.0, &[1.0; 4]);
        let (mut closed, mut others) = (0, 0);
        for seed in 0..8 {
            let d = circle.direction(seed, false);
            let options = Options {
                curve_step_limit: 400,
                ..Options::default()
            };
            let curve =
                continuation_through(&circle, &start, &d, Sense::Down, 64, &options).unwrap();
            let has_both_signs = d.iter().any(|v| *v > 0.0) && d.iter().any(|v| *v < 0.0);
            assert!(
                curve.end == CurveEnd::Closed || !has_both_signs,
                "{seed}: {:?}",
                curve.end
            );
            closed += usize::from(curve.end == CurveEnd::Closed);
            let is_other = |z: &&Vec<f64>| {
                circle
                    .candidate(z)
                    .is_some_and(|c| (c.value - 4.0).abs() > 1e-6)
            };
            others += curve.solutions.iter().filter(is_other).count();
        }
        assert!(closed >= 5 && others >= 5, "{closed} {others}");
    }
}
