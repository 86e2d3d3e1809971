//! One step of Moreau and Jean's scheme with theta = 1/2.
//!
//! ```text
//! M* (v1 - v0) + h K* (q0 + q1) / 2 = P,    q1 = q0 + h (v0 + v1) / 2,
//! P_f = 0,    0 <= v1_s _|_ P_s >= 0
//! ```
//!
//! P is the impulse of the step. As long as the set of slipping particles does not change this is
//! the trapezoidal rule: errors are of order h^2, and a change of that set adds an error of order
//! h^2 too, because velocities have no jumps there. With A = M* + h^2/4 K* the unknown v1 solves
//!
//! ```text
//! A v1 = b + P,    b = M* v0 - h K* (q0 + h/4 v0),
//! C v1_s + c = P_s,    C = A_ss - A_sf A_ff^-1 A_fs,    c = A_sf A_ff^-1 b_f - b_s,
//! ```
//!
//! a linear complementarity problem. Murty's principal pivoting (least index) ends with its
//! solution whenever C is a P-matrix ([`super::uniqueness`]); it starts from the set of the step
//! before.

use super::equations::{Equations, MotionError};
use super::tolerance::STEP_SIGN;
use super::uniqueness::{StepSolutions, step_solutions};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Displacement and velocity at one time, in the coordinates of [`Equations`].
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// Time since the start.
    pub time: f64,
    /// q.
    pub displacement: DVector<f64>,
    /// q'.
    pub velocity: DVector<f64>,
    /// Which s particles slip.
    pub slips: Vec<bool>,
}

impl Instant {
    /// The start of a motion.
    pub fn start(
        equations: &Equations,
        displacement: DVector<f64>,
        velocity: DVector<f64>,
    ) -> Instant {
        Instant {
            time: 0.0,
            displacement,
            velocity,
            slips: vec![true; equations.slip_particles().len()],
        }
    }
}

/// A time step of one length on one system.
#[derive(Debug, Clone)]
pub struct Stepper<'a> {
    equations: &'a Equations,
    h: f64,
    /// A_ff, factored.
    free_factor: Cholesky<f64, Dyn>,
    /// A_ff^-1 A_fs.
    free_per_slip: DMatrix<f64>,
    /// A_sf.
    slip_row: DMatrix<f64>,
    /// C.
    schur: DMatrix<f64>,
    /// The sizes of the terms of each of its diagonal entries.
    sizes: Vec<f64>,
}

/// Pivots of one step beyond which it is given up.
const MAX_PIVOTS: usize = 10_000;

impl<'a> Stepper<'a> {
    /// Steps of length h > 0; h = 0 gives the limit of small steps.
    ///
    /// # Errors
    /// [`MotionError::Doubles`] where A_ff is not definite in doubles.
    pub fn new(equations: &'a Equations, h: f64) -> Result<Stepper<'a>, MotionError> {
        let f = equations.free();
        let s = equations.order() - f;
        let a = &equations.mass + &equations.stiffness * (h * h / 4.0);

        let free_factor = a.view((0, 0), (f, f)).into_owned().cholesky();
        let free_factor = free_factor.ok_or(MotionError::Doubles {
            what: "an M + h^2/4 K that is not definite",
        })?;

        let free_per_slip = free_factor.solve(&a.view((0, f), (f, s)).into_owned());
        let slip_row = a.view((f, 0), (s, f)).into_owned();
        let schur = a.view((f, f), (s, s)) - &slip_row * &free_per_slip;
        let eliminated = slip_row.abs() * free_per_slip.abs();
        let size = |i: usize| a[(f + i, f + i)].abs() + eliminated[(i, i)];
        let sizes = (0..s).map(size).collect();
        Ok(Stepper {
            equations,
            h,
            free_factor,
            free_per_slip,
            slip_row,
            schur,
            sizes,
        })
    }

    /// How many solutions may a step have?
    pub fn solutions(&self) -> StepSolutions {
        step_solutions(&self.schur, &self.sizes)
    }

    /// The state one step later, and the impulse P.
    ///
    /// # Errors
    /// [`MotionError::Pivots`] where the step has no solution that pivoting finds.
    pub fn advance(&self, from: &Instant) -> Result<(Instant, DVector<f64>), MotionError> {
        let f = self.equations.free();
        let s = self.equations.order() - f;
        let h = self.h;

        let ahead = &from.displacement + &from.velocity * (h / 4.0);
        let b = &self.equations.mass * &from.velocity - &self.equations.stiffness * ahead * h;
        let free_alone = self.free_factor.solve(&b.rows(0, f).into_owned());
        let c = &self.slip_row * &free_alone - b.rows(f, s);

        let Some(slip) = principal_pivoting(&self.schur, &c, &from.slips) else {
            return Err(MotionError::Pivots {
                time: from.time,
                pivots: MAX_PIVOTS,
            });
        };

        let mut velocity = DVector::zeros(f + s);
        velocity
            .rows_mut(0, f)
            .copy_from(&(free_alone - &self.free_per_slip * &slip.velocity));
        velocity.rows_mut(f, s).copy_from(&slip.velocity);

        let mut impulse = DVector::zeros(f + s);
        impulse.rows_mut(f, s).copy_from(&slip.impulse);

        let displacement = &from.displacement + (&from.velocity + &velocity) * (h / 2.0);
        let to = Instant {
            time: from.time + h,
            displacement,
            velocity,
            slips: slip.is_moving,
        };
        Ok((to, impulse))
    }
}

/// The solution of the problem of a step.
struct SlipStep {
    velocity: DVector<f64>,
    impulse: DVector<f64>,
    is_moving: Vec<bool>,
}

/// Solves 0 <= v _|_ C v + c >= 0 from a guess of the set of positive v (Murty 1974).
fn principal_pivoting(
    c_matrix: &DMatrix<f64>,
    c: &DVector<f64>,
    guess: &[bool],
) -> Option<SlipStep> {
    let mut is_moving = guess.to_vec();

    for _ in 0..MAX_PIVOTS {
        let velocity = velocity_of(c_matrix, c, &is_moving)?;
        let mut impulse = c_matrix * &velocity + c;
        let velocity_noise = STEP_SIGN * velocity.amax();
        let impulse_noise = STEP_SIGN * (c.amax() + c_matrix.amax() * velocity.amax());

        let mut wrong = None;
        for i in 0..c.len() {
            let is_wrong = if is_moving[i] {
                velocity[i] < -velocity_noise
            } else {
                impulse[i] < -impulse_noise
            };
            if is_wrong {
                wrong = Some(i);
                break;
            }
        }

        match wrong {
            Some(i) => is_moving[i] = !is_moving[i],
            None => {
                for (impulse_i, moves) in impulse.iter_mut().zip(&is_moving) {
                    if *moves {
                        *impulse_i = 0.0;
                    }
                }

                return Some(SlipStep {
                    velocity: velocity.map(|v_i| v_i.max(0.0)),
                    impulse,
                    is_moving,
                });
            }
        }
    }

    None
}

/// v with (C v + c)_i = 0 where i moves and v_i = 0 elsewhere.
fn velocity_of(
    c_matrix: &DMatrix<f64>,
    c: &DVector<f64>,
    is_moving: &[bool],
) -> Option<DVector<f64>> {
    let moving: Vec<usize> = (0..c.len()).filter(|&i| is_moving[i]).collect();
    let matrix = c_matrix.select_rows(&moving).select_columns(&moving);
    let right = -c.select_rows(&moving);
    let solved = if moving.is_empty() {
        right
    } else {
        matrix.lu().solve(&right)?
    };

    let mut velocity = DVector::zeros(c.len());
    for (k, &i) in moving.iter().enumerate() {
        velocity[i] = solved[k];
    }
    Some(velocity)
}
