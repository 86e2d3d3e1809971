//! A null vector of T(t) on a support, and its value, in doubles.
//!
//! Newton's method for T(t) v = 0 from the middle of an interval, as nonlinear inverse iteration
//! for both vectors (Unger 1950; Ruhe 1973):
//!
//! ```text
//!     T(t) v+ = T'(t) v,    T(t)^T u+ = T'(t)^T u,    t+ = t - u+^T T(t) v+ / u+^T T'(t) v+,
//! ```
//!
//! Called by the leaves `root` and `infinity`, by `precise`, and for the x of an accepted solution
//! (`accepted_x`). Nothing is proved here.

use super::pieces::expansion::Expansion;
use super::pieces::matrix::{SquareMatrix, bilinear, principal_block, times};
use super::region::support;
use crate::dense::transposed;
use crate::tolerance::ROUNDING;
use mceip_check::certificate::VariableState;
use mceip_mcp::linear::solve;

/// Newton steps at most.
const NEWTON_STEPS: usize = 40;

/// Steps of plain inverse iteration before the value is moved, tried one after the other. A value
/// far above the others has u'Bv so small that what the first vectors have of other null vectors
/// throws Newton's first step far off.
const SETTLING_STEPS: [usize; 2] = [0, 2];

/// Where in the interval the iteration starts: near the middle, but not at it, where a hand-made
/// problem may have a value.
const START: f64 = 0.47;

/// A null vector of T on the support and its value.
pub(crate) struct NullVector {
    pub(crate) value: f64,
    /// Positions of the variables in the support.
    pub(crate) support: Vec<usize>,
    /// u'T = 0 and T v = 0 over the support; the largest component of each is 1.
    pub(crate) left: Vec<f64>,
    pub(crate) right: Vec<f64>,
    /// Was a step of the iteration possible? Where T is singular at every step, the vectors are
    /// those of the start; a search that meets such a support decides it exactly.
    is_solved: bool,
}

/// The null vector that Newton's method reaches from the middle of [lo, hi]; `None` if it ends
/// outside the interval enlarged by half on each side.
pub(crate) fn null_vector(
    expansion: &Expansion,
    states: &[VariableState],
    lo: f64,
    hi: f64,
) -> Option<NullVector> {
    Iteration::new(expansion, states, [lo, hi]).started_at_ones()
}

/// [`null_vector`] where there surely is one. Vectors of ones may be null vectors of another value,
/// which the iteration does not leave; then it starts from vectors of no pattern.
pub(crate) fn existing_null_vector(
    expansion: &Expansion,
    states: &[VariableState],
    lo: f64,
    hi: f64,
) -> Option<NullVector> {
    let iteration = Iteration::new(expansion, states, [lo, hi]);
    let found = iteration.started_at_ones().filter(|null| null.is_solved);
    found.or_else(|| {
        let start = Vectors::without_pattern(iteration.support.len());
        let found = iteration.run(SETTLING_STEPS[1], start);
        found.filter(|null| null.is_solved)
    })
}

impl NullVector {
    /// Have all components on the support one sign?
    pub(crate) fn has_one_sign(&self) -> bool {
        let mut components = self.right.iter();
        components.all(|v| *v > 0.0) || self.right.iter().all(|v| *v < 0.0)
    }

    /// x over all `order` positions, signed so that its sum is not negative.
    pub(crate) fn spread(&self, order: usize) -> Vec<f64> {
        let sum: f64 = self.right.iter().sum();
        let sign = if sum < 0.0 { -1.0 } else { 1.0 };

        let mut x = vec![0.0; order];
        for (&i, v) in self.support.iter().zip(&self.right) {
            x[i] = sign * v;
        }

        x
    }
}

struct Iteration<'a> {
    expansion: &'a Expansion,
    support: Vec<usize>,
    lo: f64,
    hi: f64,
}

impl<'a> Iteration<'a> {
    fn new(
        expansion: &'a Expansion,
        states: &[VariableState],
        [lo, hi]: [f64; 2],
    ) -> Iteration<'a> {
        Iteration {
            expansion,
            support: support(states),
            lo,
            hi,
        }
    }

    /// From vectors of ones, after so many settling steps as lead to a null vector.
    fn started_at_ones(&self) -> Option<NullVector> {
        let ones = Vectors::ones(self.support.len());
        let mut attempts = SETTLING_STEPS.iter();
        attempts.find_map(|settling| self.run(*settling, ones.clone()))
    }

    fn run(&self, settling: usize, start: Vectors) -> Option<NullVector> {
        let width = self.hi - self.lo;
        let mut t = self.lo + START * width;
        let mut vectors = start;
        let mut is_solved = false;

        for step in 0..NEWTON_STEPS {
            let matrix = principal_block(&self.expansion.at(t), &self.support);
            let derivative = principal_block(&self.expansion.derivative(t), &self.support);
            let Some(next) = vectors.solved(&matrix, &derivative) else {
                // The factorisation is singular: t is the value, to rounding. Move off a little.
                t += ROUNDING * (t.abs() + width);
                continue;
            };

            vectors = next.normalised()?;
            is_solved = true;
            if step < settling {
                continue;
            }

            let slope = bilinear(&vectors.left, &derivative, &vectors.right);
            let correction = bilinear(&vectors.left, &matrix, &vectors.right) / slope;
            t -= correction;
            let is_outside = t < self.lo - 0.5 * width || t > self.hi + 0.5 * width;
            if !t.is_finite() || is_outside {
                return None;
            }

            if correction.abs() <= 4.0 * f64::EPSILON * t.abs().max(width) {
                break;
            }
        }

        Some(NullVector {
            value: t,
            support: self.support.clone(),
            left: vectors.left,
            right: vectors.right,
            is_solved,
        })
    }
}

/// Approximate null vectors from both sides.
#[derive(Clone)]
struct Vectors {
    left: Vec<f64>,
    right: Vec<f64>,
}

impl Vectors {
    fn ones(order: usize) -> Vectors {
        Vectors {
            left: vec![1.0; order],
            right: vec![1.0; order],
        }
    }

    /// Components from 1 to 2 that no small matrix has for a null vector: 1 + the fractional part
    /// of k times the golden ratio.
    fn without_pattern(order: usize) -> Vectors {
        let golden = (1.0 + 5f64.sqrt()) / 2.0;
        let component = |k: usize| 1.0 + (k as f64 * golden).fract();
        Vectors {
            left: (0..order).map(|k| component(k + 1)).collect(),
            right: (0..order).map(|k| component(k + 2)).collect(),
        }
    }

    /// T^-1 T' v, and T^-T T'^T u from the left; `None` where T is singular in doubles.
    fn solved(&self, matrix: &SquareMatrix, derivative: &SquareMatrix) -> Option<Vectors> {
        let right = times(derivative, &self.right);
        let left = times(&transposed(derivative), &self.left);
        Some(Vectors {
            right: solve_one(matrix, right)?,
            left: solve_one(&transposed(matrix), left)?,
        })
    }

    fn normalised(self) -> Option<Vectors> {
        Some(Vectors {
            right: normalised(self.right)?,
            left: normalised(self.left)?,
        })
    }
}

fn solve_one(matrix: &SquareMatrix, right_hand_side: Vec<f64>) -> Option<Vec<f64>> {
    let mut columns = solve(matrix, &[right_hand_side])?;
    Some(columns.swap_remove(0))
}

/// Divided by the component of largest modulus; `None` unless all components are finite.
fn normalised(mut v: Vec<f64>) -> Option<Vec<f64>> {
    let largest = v
        .iter()
        .copied()
        .max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    v.iter_mut().for_each(|x| *x /= largest);
    v.iter().all(|x| x.is_finite()).then_some(v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::complete::pieces::view::View;
    use mceip_exact::Sparse;
    use mceip_model::Pencil;

    /// The values are 4500.33 and -0.33: like those of eighty supports of the plane-strain `\\`
    /// block, from which Newton's first step went astray.
    #[test]
    fn a_value_far_above_the_others_is_found() {
        let a = Sparse::from_ints(&[&[2000, -3000], &[1000, 0]]);
        let b = Sparse::from_ints(&[&[-1001, -2000], &[1000, 2000]]);
        let view = View::of(&Pencil::new(a, b, vec![]).unwrap());
        let iteration = Iteration {
            expansion: &view.expansions[0],
            support: vec![0, 1],
            lo: 4410.0,
            hi: 4636.0,
        };

        assert!(iteration.run(0, Vectors::ones(2)).is_none());
        let found = null_vector(
            &view.expansions[0],
            &[VariableState::InSupport; 2],
            iteration.lo,
            iteration.hi,
        )
        .unwrap();

        // det (A + tB) = -2000 t^2 + 9,000,000 t + 3,000,000 = 0 at 2250 + sqrt(2250^2 + 1500)
        let expected = 2250.0 + (2250.0f64 * 2250.0 + 1500.0).sqrt();
        approx::assert_relative_eq!(found.value, expected, max_relative = 1e-9);
    }
}
