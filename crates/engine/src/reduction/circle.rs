//! The eigenproblem without the bound t >= 0 and without a point at infinity.
//!
//! With t = beta / alpha the problem is (alpha A + beta B) x = y, alpha^2 + beta^2 = 1. Unknowns
//! (u_s, alpha, beta), x = D u as in [`Embedding`], the free variables condensed in doubles. Rows:
//!
//!   (alpha A + beta unit B) u  complementary to u_s >= 0,
//!   e'u_s = 1,
//!   alpha^2 + beta^2 = 1.
//!
//! Where alpha <= 0 or beta < 0 its solutions are none of the eigenproblem; curves pass there from
//! one solution to another. With e'u_s = 1 and a residual direction of both signs u, alpha, beta
//! and the multiple of the direction are all bounded: every curve closes, where those of the
//! embedding mostly run off to t = 0 or to infinity.
//!
//! Input: an embedding of which the rows f of B vanish. Output: an [`Mcp`] for the solver's curves,
//! and the way between its points and candidates. Called by `multistart`.
#![allow(clippy::float_arithmetic)]

use super::embed::{Embedding, normals};
use crate::candidate::Candidate;
use crate::tolerance::CIRCLE_END;
use mceip_mcp::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// An eigenproblem on the circle, in doubles, with n_s slip variables.
#[derive(Debug, Clone)]
pub struct CirclePencil {
    /// A condensed to the slip variables, n_s x n_s.
    a: DMatrix<f64>,
    /// unit B condensed to the slip variables, n_s x n_s.
    b: DMatrix<f64>,
    slip: Vec<usize>,
    free: Vec<usize>,
    /// The matrix L of u_f = -L u_s, one row for each free variable.
    lines: DMatrix<f64>,
    /// The diagonal of D over all variables.
    diagonal: Vec<f64>,
    /// t = unit beta / alpha.
    unit: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl CirclePencil {
    /// The problem of an embedding. `None` if a free row of B is not zero, as in MCEIP-lambda2
    /// (then the free variables cannot be condensed once for all t), or if A_ff is singular in
    /// doubles.
    pub fn new(embedding: &Embedding) -> Option<CirclePencil> {
        let order = embedding.is_free.len();
        let (free, slip): (Vec<usize>, Vec<usize>) =
            (0..order).partition(|&i| embedding.is_free[i]);
        let b_f = embedding.b.select_rows(&free);
        if b_f.iter().any(|v| *v != 0.0) {
            return None;
        }

        // L = A_ff^-1 A_fs; nalgebra's triangular solve underflows on 0 x 0.
        let lines = if free.is_empty() {
            DMatrix::zeros(0, slip.len())
        } else {
            let a_ff = block(&embedding.a, &free, &free);
            let a_fs = block(&embedding.a, &free, &slip);
            a_ff.lu().solve(&a_fs)?
        };

        let a = condensed(&embedding.a, &slip, &free, &lines);
        let b = condensed(&embedding.b, &slip, &free, &lines) * embedding.unit;
        let is_finite = a.iter().chain(b.iter()).all(|v| v.is_finite());
        if !is_finite {
            return None;
        }

        let n = slip.len();
        let mut lower = vec![0.0; n];
        lower.extend([f64::NEG_INFINITY; 2]);

        Some(CirclePencil {
            a,
            b,
            slip,
            free,
            lines,
            diagonal: embedding.diagonal.clone(),
            unit: embedding.unit,
            lower,
            upper: vec![f64::INFINITY; n + 2],
        })
    }

    /// The point of a value and x over all variables of the pencil (any positive scale with e'x_s >
    /// 0).
    pub fn point(&self, value: f64, x: &[f64]) -> Vec<f64> {
        let slip = self.slip.iter();
        let mut z: Vec<f64> = slip.map(|&i| x[i] / self.diagonal[i]).collect();
        let sum: f64 = z.iter().sum();
        for u in &mut z {
            *u /= sum;
        }

        // (1, tangent) / norm lies on the circle.
        let tangent = value / self.unit;
        let norm = tangent.hypot(1.0);
        z.extend([1.0 / norm, tangent / norm]);
        z
    }

    /// The candidate that a point stands for, over all variables; `None` where t would be negative
    /// or infinite.
    pub fn candidate(&self, z: &[f64]) -> Option<Candidate> {
        let n = self.slip.len();
        let alpha = *z.get(n)?;
        let beta = *z.get(n + 1)?;
        let value = self.unit * beta / alpha;
        if !(alpha > CIRCLE_END && beta >= 0.0 && value.is_finite()) {
            return None;
        }

        let u_s = &z[..n];
        let u_f = -(&self.lines * DVector::from_column_slice(u_s));
        let mut x = vec![0.0; self.diagonal.len()];
        for (&i, u) in self.slip.iter().zip(u_s) {
            x[i] = u * self.diagonal[i];
        }
        for (&i, u) in self.free.iter().zip(u_f.iter()) {
            x[i] = u * self.diagonal[i];
        }

        Some(Candidate { value, x })
    }

    /// A random residual direction as [`Embedding::direction`]'s: zero in the last two rows.
    pub fn direction(&self, seed: u64, uneven: bool) -> Vec<f64> {
        let mut direction = normals(self.slip.len(), seed, uneven);
        direction.extend([0.0; 2]);
        direction
    }

    /// Row i of (alpha A + beta B) u.
    fn row(&self, i: usize, u: &[f64], alpha: f64, beta: f64) -> f64 {
        let terms = u.iter().enumerate();
        terms
            .map(|(j, u_j)| (alpha * self.a[(i, j)] + beta * self.b[(i, j)]) * u_j)
            .sum()
    }
}

fn block(matrix: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(rows).select_columns(columns)
}

/// M_ss - M_sf L, which is M with u_f = -L u_s put in.
fn condensed(
    matrix: &DMatrix<f64>,
    slip: &[usize],
    free: &[usize],
    lines: &DMatrix<f64>,
) -> DMatrix<f64> {
    let slip_slip = block(matrix, slip, slip);
    let slip_free = block(matrix, slip, free);
    slip_slip - slip_free * lines
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
        let u = &z[..n];
        let alpha = z[n];
        let beta = z[n + 1];

        for (i, f_i) in f[..n].iter_mut().enumerate() {
            *f_i = self.row(i, u, alpha, beta);
        }

        f[n] = u.iter().sum::<f64>() - 1.0;
        f[n + 1] = alpha * alpha + beta * beta - 1.0;
    }

    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.slip.len();
        let alpha = z[n];
        let beta = z[n + 1];
        j.fill(0.0);

        for row in 0..n {
            for column in 0..n {
                let a = self.a[(row, column)];
                let b = self.b[(row, column)];
                j[(row, column)] = alpha * a + beta * b;
                // By alpha it is row of A u, by beta row of B u.
                j[(row, n)] += a * z[column];
                j[(row, n + 1)] += b * z[column];
            }
            j[(n, row)] = 1.0;
        }

        j[(n + 1, n)] = 2.0 * alpha;
        j[(n + 1, n + 1)] = 2.0 * beta;
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
        let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
        let admissible = Admissible::new(&pencil, unknown).unwrap();
        Embedding::new(&admissible, Side::Above(0.0))
    }

    fn sparse(rows: &[&[&str]]) -> Sparse {
        let mut entries = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            for (j, number) in row.iter().enumerate() {
                entries.push((i, j, parse(number).unwrap()));
            }
        }

        Sparse::from_entries(rows.len(), rows.len(), entries)
    }

    fn function_at(circle: &CirclePencil, z: &[f64]) -> Vec<f64> {
        let mut f = vec![0.0; circle.dimension()];
        circle.function(z, &mut f);
        f
    }

    /// Variable 0 free: x_0 = -x_1 / 4, condensed A = diag(15/4, 2), B = [[0, -3], [-1, 0]], mu^2 =
    /// 5/2.
    fn with_a_free_variable() -> CirclePencil {
        let a: [&[&str]; 3] = [&["4", "1", "0"], &["1", "4", "0"], &["0", "0", "2"]];
        let b: [&[&str]; 3] = [&["0", "0", "0"], &["0", "0", "-3"], &["0", "-1", "0"]];
        CirclePencil::new(&embedding(&a, &b, &[0], Unknown::Mu)).unwrap()
    }

    #[test]
    fn solutions_solve_it_and_come_back() {
        let circle = with_a_free_variable();
        let mu = 2.5f64.sqrt();
        let x = [-0.25, 1.0, mu / 2.0];

        let z = circle.point(mu, &x);

        let beside = circle.point(1.01 * mu, &x);
        assert!(Residuals::at(&circle, &z).minimum_map < 1e-14);
        assert!(Residuals::at(&circle, &beside).minimum_map > 1e-4);
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
        let just_before_infinity = [0.5, 0.5, 1.1 * CIRCLE_END, 1.0];
        assert!(circle.candidate(&just_before_infinity).is_some());
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
        let circle = with_a_free_variable();
        let z = [0.3, 0.7, 0.6, -0.8];
        let n = circle.dimension();
        let step = 1e-6;

        let mut jacobian = DMatrix::zeros(n, n);
        circle.jacobian(&z, &mut jacobian);

        for column in 0..n {
            let mut above = z;
            above[column] += step;
            let mut below = z;
            below[column] -= step;
            let up = function_at(&circle, &above);
            let down = function_at(&circle, &below);
            for row in 0..n {
                let difference = (up[row] - down[row]) / (2.0 * step);
                approx::assert_relative_eq!(difference, jacobian[(row, column)], epsilon = 1e-8);
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
        let options = Options {
            curve_step_limit: 400,
            ..Options::default()
        };

        let mut closed = 0;
        let mut others = 0;
        for seed in 0..8 {
            let direction = circle.direction(seed, false);
            let curve =
                continuation_through(&circle, &start, &direction, Sense::Down, 64, &options)
                    .unwrap();

            let is_closed = curve.end == CurveEnd::Closed;
            let has_positive = direction.iter().any(|v| *v > 0.0);
            let has_negative = direction.iter().any(|v| *v < 0.0);
            assert!(
                is_closed || !(has_positive && has_negative),
                "{seed}: {:?}",
                curve.end
            );

            closed += usize::from(is_closed);
            for solution in &curve.solutions {
                let candidate = circle.candidate(solution);
                let is_other = candidate.is_some_and(|c| (c.value - 4.0).abs() > 1e-6);
                others += usize::from(is_other);
            }
        }

        assert!(closed >= 5 && others >= 5, "{closed} {others}");
    }
}
