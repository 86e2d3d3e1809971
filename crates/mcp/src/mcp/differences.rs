//! F' by finite differences, and a given F' held against them.
//!
//! A column is computed from F at the point and at two steps a and b of one unknown, by the
//! derivative at 0 of the parabola through the three values:
//! F' = -(a + b) F(0) / (a b) + b F(a) / (a (b - a)) - a F(b) / (b (b - a)). In the middle of the
//! bounds b = -a, the central difference; near a bound both steps lead to the side with more room,
//! so that F is never asked for a value outside [l, u]. Either way the error is of second order.
//!
//! The comparison computes each column a second time with half the steps. What the two differ by,
//! and what rounding of F adds, is the *doubt* of an entry, and an entry disagrees with what was
//! given only beyond its doubt.

use super::Mcp;
use crate::solver::{NonFinite, SolverError, check_point};
use crate::tolerance::{DIFFERENCE_AGREEMENT, DIFFERENCE_DOUBT, DIFFERENCE_STEP};
use nalgebra::DMatrix;

/// Why a given Jacobian is not that of F, as far as finite differences tell.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JacobianError {
    /// Bounds or point make no sense.
    #[error(transparent)]
    Input(#[from] SolverError),
    /// F at or beside the point, or the given F', is not finite.
    #[error("expected a finite {0}")]
    NotFinite(NonFinite),
    /// The entry that differs most, relative to the larger of the two values.
    #[error(
        "expected F'[{row}][{col}] near {expected} by finite differences, got {got} (relative \
         difference {relative:.1e})"
    )]
    Entry {
        /// Row: the component of F.
        row: usize,
        /// Column: the unknown.
        col: usize,
        /// By finite differences.
        expected: f64,
        /// As given.
        got: f64,
        /// |got - expected| over the larger of their magnitudes.
        relative: f64,
    },
}

/// Holds F' as the problem gives it against finite differences at a point of length n within the
/// bounds, by 4n + 1 values of F.
///
/// Columns of unknowns with equal bounds are not compared: nothing moves there. An error is not
/// seen where it is smaller than what differences are sure of: a millionth of an entry, or more
/// where F bends, is rough, or cancels.
///
/// # Errors
/// [`JacobianError::Entry`] names row, column, expected and got of the entry that differs most.
///
/// ```
/// use mceip_mcp::mcp::{FunctionMcp, check_jacobian};
///
/// let cube = || FunctionMcp::new(vec![0.0], vec![9.0], |z, f| f[0] = z[0].powi(3));
/// let right = cube().with_jacobian(|z, j| j[(0, 0)] = 3.0 * z[0] * z[0]);
/// assert_eq!(check_jacobian(&right, &[2.0]), Ok(()));
///
/// let wrong = cube().with_jacobian(|z, j| j[(0, 0)] = 2.0 * z[0] * z[0]);
/// let error = check_jacobian(&wrong, &[2.0]).unwrap_err().to_string();
/// assert!(error.starts_with("expected F'[0][0] near 12"), "{error}");
/// assert!(error.contains("got 8 "), "{error}");
/// ```
pub fn check_jacobian<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> Result<(), JacobianError> {
    check_point(problem, z)?;

    let n = z.len();
    let mut given = DMatrix::zeros(n, n);
    problem.jacobian(z, &mut given);

    let mut differences = Differences::new(problem, z);
    let mut worst: Option<Mismatch> = None;

    for col in 0..n {
        let Some([first, second]) = differences.steps(col) else {
            continue;
        };
        differences.column(col, [first, second]);
        let coarse = differences.derivative.clone();
        differences.column(col, [0.5 * first, 0.5 * second]);

        for row in 0..n {
            let got = given.get((row, col)).copied().unwrap_or(f64::NAN);
            if !got.is_finite() {
                return Err(JacobianError::NotFinite(NonFinite::Jacobian { row, col }));
            }

            let expected = differences.derivative[row];
            if !expected.is_finite() || !coarse[row].is_finite() {
                return Err(JacobianError::NotFinite(NonFinite::Function { row }));
            }

            let doubt = (expected - coarse[row]).abs() + differences.rounding[row];
            let mismatch = Mismatch::of(row, col, expected, got);
            let is_sure = (got - expected).abs() > DIFFERENCE_DOUBT * doubt;
            let is_worst = worst.is_none_or(|worst| mismatch.relative > worst.relative);
            if is_sure && is_worst && mismatch.relative > DIFFERENCE_AGREEMENT {
                worst = Some(mismatch);
            }
        }
    }

    match worst {
        None => Ok(()),
        Some(Mismatch {
            row,
            col,
            expected,
            got,
            relative,
        }) => Err(JacobianError::Entry {
            row,
            col,
            expected,
            got,
            relative,
        }),
    }
}

/// Writes F'(z) by finite differences into `j`, n x n, at a point within the bounds. Columns of
/// unknowns with equal bounds are zero. An entry is not finite where F is not.
pub fn difference_jacobian<P: Mcp + ?Sized>(problem: &P, z: &[f64], j: &mut DMatrix<f64>) {
    j.fill(0.0);
    let mut differences = Differences::new(problem, z);

    for (col, mut column) in j.column_iter_mut().enumerate().take(z.len()) {
        if let Some(steps) = differences.steps(col) {
            differences.column(col, steps);
            for (entry, derivative) in column.iter_mut().zip(&differences.derivative) {
                *entry = *derivative;
            }
        }
    }
}

/// An entry by differences, and as given.
#[derive(Debug, Clone, Copy)]
struct Mismatch {
    row: usize,
    col: usize,
    expected: f64,
    got: f64,
    relative: f64,
}

impl Mismatch {
    fn of(row: usize, col: usize, expected: f64, got: f64) -> Mismatch {
        let size = expected.abs().max(got.abs());
        let relative = if size > 0.0 {
            (got - expected).abs() / size
        } else {
            0.0
        };

        Mismatch {
            row,
            col,
            expected,
            got,
            relative,
        }
    }
}

/// The differences of F at one point, column after column.
struct Differences<'a, P: Mcp + ?Sized> {
    problem: &'a P,
    z: &'a [f64],
    /// F(z).
    at_point: Vec<f64>,
    /// z with one component moved.
    moved: Vec<f64>,
    /// F at the first and at the second step.
    at_steps: [Vec<f64>; 2],
    /// The last column computed.
    derivative: Vec<f64>,
    /// What the rounding of F may change in it.
    rounding: Vec<f64>,
}

impl<'a, P: Mcp + ?Sized> Differences<'a, P> {
    fn new(problem: &'a P, z: &'a [f64]) -> Self {
        let n = z.len();
        let mut at_point = vec![0.0; n];
        problem.function(z, &mut at_point);

        Differences {
            problem,
            z,
            at_point,
            moved: z.to_vec(),
            at_steps: [vec![0.0; n], vec![0.0; n]],
            derivative: vec![0.0; n],
            rounding: vec![0.0; n],
        }
    }

    /// Two steps of an unknown that stay within its bounds; `None` where the bounds leave no room.
    fn steps(&self, col: usize) -> Option<[f64; 2]> {
        let z = self.z[col];
        let step = DIFFERENCE_STEP * z.abs().max(1.0);
        let below = z - self.problem.lower()[col];
        let above = self.problem.upper()[col] - z;

        if below >= step && above >= step {
            return Some([-step, step]);
        }

        let (room, sign) = if above >= below {
            (above, 1.0)
        } else {
            (below, -1.0)
        };
        let second = sign * room.min(2.0 * step);
        (room > 0.0).then_some([0.5 * second, second])
    }

    /// Computes a column by two steps of its unknown.
    fn column(&mut self, col: usize, steps: [f64; 2]) {
        let z = self.z[col];
        let mut taken = steps;

        for (k, step) in steps.into_iter().enumerate() {
            // The step that is taken differs from the one that was asked for by rounding.
            self.moved[col] = z + step;
            taken[k] = self.moved[col] - z;
            self.at_steps[k].fill(0.0);
            self.problem.function(&self.moved, &mut self.at_steps[k]);
        }
        self.moved[col] = z;

        let [a, b] = taken;
        let weights = [-(a + b) / (a * b), b / (a * (b - a)), -a / (b * (b - a))];

        for row in 0..self.derivative.len() {
            let values = [
                self.at_point[row],
                self.at_steps[0][row],
                self.at_steps[1][row],
            ];
            let mut derivative = 0.0;
            let mut rounding = 0.0;
            for (weight, value) in weights.iter().zip(values) {
                derivative += weight * value;
                rounding += (weight * value).abs() * f64::EPSILON;
            }

            self.derivative[row] = derivative;
            self.rounding[row] = rounding;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::FunctionMcp;
    use super::*;

    const INF: f64 = f64::INFINITY;

    /// F = (exp z_0 + z_1^2, z_0 z_1), and the bounds of both unknowns.
    fn problem(lower: f64, upper: f64) -> FunctionMcp<'static> {
        FunctionMcp::new(vec![lower; 2], vec![upper; 2], move |z, f| {
            assert!(z.iter().all(|v| (lower..=upper).contains(v)), "{z:?}");
            f[0] = z[0].exp() + z[1] * z[1];
            f[1] = z[0] * z[1];
        })
    }

    /// In the middle, at either bound, between near bounds: F is never asked for a value outside.
    #[test]
    fn differences_stay_within_the_bounds() {
        for (lower, upper, z) in [
            (-INF, INF, [0.5, -2.0]),
            (0.0, INF, [0.0, 3.0]),
            (-1.0, 2.0, [2.0, -1.0]),
            (1.0, 1.0 + 1e-4, [1.0, 1.0 + 1e-4]),
        ] {
            let mut j = DMatrix::zeros(2, 2);
            difference_jacobian(&problem(lower, upper), &z, &mut j);
            let exact = nalgebra::dmatrix![z[0].exp(), 2.0 * z[1]; z[1], z[0]];
            assert!((&j - &exact).amax() < 1e-8, "{z:?}: {j}");
        }
    }

    /// Nothing moves between equal bounds.
    #[test]
    fn a_fixed_unknown_has_no_column() {
        let fixed = FunctionMcp::new(vec![2.0], vec![2.0], |z, f| f[0] = 1.0 / (z[0] - 2.0).abs());
        let mut j = DMatrix::from_element(1, 1, 7.0);
        difference_jacobian(&fixed, &[2.0], &mut j);

        assert_eq!(j[(0, 0)], 0.0);
        assert_eq!(check_jacobian(&fixed, &[2.0]), Ok(()));
    }

    /// Each entry of F' is found wrong by itself, and a right one is not, whatever its size.
    #[test]
    fn every_wrong_entry_is_named() {
        let scales = [1.0, 1e-7, 1e9];
        for scale in scales {
            for wrong in [None, Some((0, 0)), Some((0, 1)), Some((1, 0)), Some((1, 1))] {
                let problem = FunctionMcp::new(vec![0.0; 2], vec![INF; 2], move |z, f| {
                    f[0] = scale * (z[0].exp() + z[1] * z[1]);
                    f[1] = scale * z[0] * z[1];
                })
                .with_jacobian(move |z, j| {
                    j[(0, 0)] = scale * z[0].exp();
                    j[(0, 1)] = scale * 2.0 * z[1];
                    j[(1, 0)] = scale * z[1];
                    j[(1, 1)] = scale * z[0];
                    if let Some(place) = wrong {
                        j[place] *= 1.0 + 1e-4;
                    }
                });

                let named = match check_jacobian(&problem, &[1.5, 2.5]) {
                    Ok(()) => None,
                    Err(JacobianError::Entry { row, col, .. }) => Some((row, col)),
                    Err(other) => panic!("{other}"),
                };
                assert_eq!(named, wrong, "{scale}");
            }
        }
    }

    /// A zero that should be none, and the other way round.
    #[test]
    fn entries_left_out_or_too_many_are_named() {
        let rows = |z: &[f64], f: &mut [f64]| {
            f[0] = z[0] + 3.0 * z[1];
            f[1] = 2.0 * z[1];
        };
        let upper = vec![INF; 2];
        let left_out = FunctionMcp::new(vec![0.0; 2], upper.clone(), rows)
            .with_entries(|_, entries| entries.extend([(0, 0, 1.0), (1, 1, 2.0)]));
        let too_many = FunctionMcp::new(vec![0.0; 2], upper, rows).with_entries(|_, entries| {
            entries.extend([(0, 0, 1.0), (0, 1, 3.0), (1, 0, 0.5), (1, 1, 2.0)]);
        });

        for (problem, row, col, message) in [
            (left_out, 0, 1, "got 0 (relative difference 1.0e0)"),
            (too_many, 1, 0, "got 0.5 (relative difference 1.0e0)"),
        ] {
            let error = check_jacobian(&problem, &[1.0, 0.0]).unwrap_err();
            assert!(error.to_string().ends_with(message), "{error}");
            assert!(
                error
                    .to_string()
                    .starts_with(&format!("expected F'[{row}][{col}] near")),
                "{error}"
            );
        }
    }

    #[test]
    fn what_is_no_point_or_no_number_is_refused() {
        let of = |f: fn(f64) -> f64| {
            FunctionMcp::new(vec![0.0], vec![INF], move |z, value| value[0] = f(z[0]))
        };
        let message = |problem: &FunctionMcp<'_>, z: &[f64]| {
            check_jacobian(problem, z).unwrap_err().to_string()
        };

        let square = of(|z| z * z);
        assert_eq!(
            message(&square, &[1.0, 2.0]),
            "expected a start of length 1, got 2"
        );
        assert_eq!(
            message(&square, &[f64::NAN]),
            "expected a finite start at 0, got NaN"
        );
        assert_eq!(
            message(&square, &[-1.0]),
            "expected a start within [0, inf] at 0, got -1"
        );

        let reciprocal = of(|z| 1.0 / z).with_jacobian(|_, j| j[(0, 0)] = -1.0);
        assert_eq!(message(&reciprocal, &[0.0]), "expected a finite F[0]");

        let not_given = of(|z| z).with_jacobian(|_, j| j[(0, 0)] = f64::NAN);
        assert_eq!(message(&not_given, &[1.0]), "expected a finite F'[0][0]");
    }
}
