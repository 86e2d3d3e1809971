//! Leaf `weighted_definite`: with weights for its rows the symmetric part of T is definite.
//!
//! A solution has x_i y_i = 0 for every i, so x'DTx = 0 for every diagonal D, and x = 0 where
//! sym(DT) is positive definite on what may be in the support. `definite` is the case D = 1. Few
//! P-matrices have a definite symmetric part, many more have one with weights: near a solution
//! whose support is all that may move, weights exist up to it.
//!
//! Positive weights for T in the middle of a region, its diagonal scaled to 1, are looked for among
//! those with the sum n by a barrier method (Boyd and Vandenberghe 2004, chapter 11):
//!
//! ```text
//!     maximise s  with  S - s I >= 0,   S = DT + T'D,   d >= 0,   sum d_i = n
//! ```
//!
//! For a weight tau of s the centre minimises -tau s - log det(S - s I) - sum log d_i, and s is
//! within 2n / tau of the largest. With P = (S - s I)^-1, Q = T P and R = Q T' the derivatives are
//!
//! ```text
//!     of d_i          -2 Q_ii - 1 / d_i           of s           tr P - tau
//!     of d_i, d_j      2 (Q_ij Q_ji + P_ij R_ij)  of d_i, s     -2 (Q P)_ii     of s, s    tr P^2
//! ```
//!
//! and 1 / d_i^2 more for i = j. Called by `analysis::absence`; `definite` tests what is found at
//! the corners. The checker's side is `check::cover::definite`.

use super::definite;
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::region::possible_support;
use crate::tolerance::{LEAST_PIVOT, NEWTON_DECREMENT};
use mceip_check::certificate::{Node, VariableState};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Bits tried for the largest weight, fewest first.
const BITS: [i32; 4] = [6, 12, 20, 40];

/// The weight tau of s grows by this factor from one centre to the next.
const STEP_OF_TAU: f64 = 8.0;

/// Newton's steps at most, for all centres together.
const MOST_STEPS: usize = 120;

/// Weights that make sym(DT) definite for one T.
#[derive(Clone)]
pub(crate) struct Weights {
    /// One per position; 1 for those at rest.
    d: Vec<f64>,
    /// (DT + T'D)^-1 on the possible support.
    inverse: DMatrix<f64>,
}

impl Weights {
    /// Weights for what may be in the support that hold at one value, given as an interval of width
    /// zero, whatever the radius there; `None` where none are found.
    pub(crate) fn of(point: &ChordEnds, states: &[VariableState]) -> Option<Weights> {
        let possible = possible_support(states);
        let block = least_block(point, &possible);
        let end = barrier(&with_unit_diagonal(&block)?.1)?;
        let found = end.has_weights.then_some(end.at.d)?;
        let mut d = vec![1.0; states.len()];
        for (p, &i) in possible.iter().enumerate() {
            d[i] = found[p];
        }
        if !definite::is_definite(&point.m[0], point.radius(0), states, &d) {
            return None;
        }

        let sum = weighted_sum(&block, &found);
        let inverse = Cholesky::new(sum)?.inverse();
        Some(Weights { d, inverse })
    }

    /// A guess at a vector x over the positions that excludes weights at a value: x_i (T x)_i <= 0
    /// for every i. `None` where there are weights, or rounding ends the search for them.
    ///
    /// On the central path P / tau is a semidefinite X with (T X)_ii at most the largest s for
    /// every i, and next to a solution it tends to xx' of that solution.
    pub(crate) fn obstacle(point: &ChordEnds, states: &[VariableState]) -> Option<Vec<f64>> {
        let possible = possible_support(states);
        let block = least_block(point, &possible);
        let mut x = vec![0.0; states.len()];
        let Some((scale, scaled)) = with_unit_diagonal(&block) else {
            // T_ii <= 0: the unit vector.
            x[possible[block.diagonal().imin()]] = 1.0;
            return Some(x);
        };

        let end = barrier(&scaled)?;
        if end.has_weights {
            return None;
        }

        // The column of P with the largest entry of the diagonal, for its leading eigenvector.
        let p = end.at.factor.inverse();
        let column = p.column(p.diagonal().imax());
        for (q, &i) in possible.iter().enumerate() {
            x[i] = scale[q] * column[q];
        }
        Some(x)
    }

    /// The leaf, if the weights hold at these corners; in the fewest bits with which they do.
    pub(crate) fn leaf(&self, corners: &[ChordEnds], states: &[VariableState]) -> Option<Node> {
        if !definite::holds_at_all(corners, states, &self.d) {
            return None;
        }

        let possible = possible_support(states);
        let largest = possible.iter().fold(0.0f64, |most, &i| most.max(self.d[i]));
        BITS.iter().find_map(|&bits| {
            let unit = f64::from(bits).exp2() / largest;
            let mut rounded = vec![0.0; states.len()];
            for &i in &possible {
                rounded[i] = (self.d[i] * unit).round();
            }

            let holds = definite::holds_at_all(corners, states, &rounded);
            let integers = || rounded.iter().map(|d| *d as i64).collect();
            holds.then(|| Node::WeightedDefinite(integers()))
        })
    }

    /// How far these ends are from the point at which the weights were found, in units of what they
    /// can bear: the largest over the ends of the Frobenius norm of L^-1 (S_e - S) L^-T, S = L L',
    /// and of what the radius there takes more. Below 1 the weights hold there.
    pub(crate) fn distance(
        &self,
        point: &ChordEnds,
        ends: &ChordEnds,
        states: &[VariableState],
    ) -> f64 {
        let possible = possible_support(states);
        let d = DVector::from_iterator(possible.len(), possible.iter().map(|&i| self.d[i]));
        let at_point = self.radius_share(point, 0, &possible);
        let mut farthest: f64 = 0.0;
        for (end, m) in ends.m.iter().enumerate() {
            let change = DMatrix::from_fn(possible.len(), possible.len(), |p, q| {
                m[possible[p]][possible[q]] - point.m[0][possible[p]][possible[q]]
            });
            let relative = &self.inverse * weighted_sum(&change, &d);
            // tr (S^-1 C)^2 is the square of the norm.
            let square = relative.component_mul(&relative.transpose()).sum();
            let of_radius = self.radius_share(ends, end, &possible) - at_point;
            farthest = farthest.max(square.max(0.0).sqrt() + of_radius);
        }

        farthest
    }

    /// The trace of S^-1 times what the radius of an end takes off the diagonal.
    fn radius_share(&self, ends: &ChordEnds, end: usize, possible: &[usize]) -> f64 {
        let Some(radius) = ends.radius(end) else {
            return 0.0;
        };

        let mut share = 0.0;
        for (p, &i) in possible.iter().enumerate() {
            let around = |&j: &usize| self.d[i] * radius[i][j] + self.d[j] * radius[j][i];
            share += self.inverse[(p, p)] * possible.iter().map(around).sum::<f64>();
        }

        share
    }
}

/// T at a point on these positions, its diagonal less what the radius takes from 2 sym(DT) if all
/// weights are 1.
fn least_block(point: &ChordEnds, possible: &[usize]) -> DMatrix<f64> {
    let mut block = DMatrix::from_fn(possible.len(), possible.len(), |p, q| {
        point.m[0][possible[p]][possible[q]]
    });
    if let Some(radius) = point.radius(0) {
        for (p, &i) in possible.iter().enumerate() {
            let around = possible.iter().map(|&j| radius[i][j] + radius[j][i]);
            block[(p, p)] -= 0.5 * around.sum::<f64>();
        }
    }

    block
}

/// C and C T C with a diagonal of ones, C > 0 diagonal; sym(DCTC) = C sym(DT) C is definite with
/// the same weights. `None` where an entry of the diagonal is not positive: then there are no
/// positive weights.
fn with_unit_diagonal(matrix: &DMatrix<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let diagonal = matrix.diagonal();
    if diagonal.iter().any(|&entry| entry <= 0.0 || entry.is_nan()) {
        return None;
    }

    let scale = diagonal.map(|entry| 1.0 / entry.sqrt());
    let scaled = DMatrix::from_fn(scale.len(), scale.len(), |i, j| {
        scale[i] * matrix[(i, j)] * scale[j]
    });
    Some((scale, scaled))
}

/// DT + T'D
fn weighted_sum(matrix: &DMatrix<f64>, d: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(d.len(), d.len(), |i, j| {
        d[i] * matrix[(i, j)] + d[j] * matrix[(j, i)]
    })
}

/// A point inside: weights, s, and a factor of S - s I.
struct Inside {
    d: DVector<f64>,
    s: f64,
    factor: Cholesky<f64, Dyn>,
}

impl Inside {
    fn new(t: &DMatrix<f64>, d: DVector<f64>, s: f64) -> Option<Inside> {
        if d.iter().any(|&weight| weight <= 0.0 || weight.is_nan()) {
            return None;
        }

        let mut slack = weighted_sum(t, &d);
        for i in 0..d.len() {
            slack[(i, i)] -= s;
        }

        Cholesky::new(slack).map(|factor| Inside { d, s, factor })
    }

    /// -tau s - log det(S - s I) - sum log d_i
    fn value(&self, tau: f64) -> f64 {
        let log_det: f64 = self.factor.l_dirty().diagonal().map(f64::ln).sum();
        -tau * self.s - 2.0 * log_det - self.d.map(f64::ln).sum()
    }
}

/// Newton's step for a point: the change of (d, s), which keeps the sum of d, and its decrement,
/// twice the decrease that the quadratic model promises.
fn newton(t: &DMatrix<f64>, at: &Inside, tau: f64) -> Option<(DVector<f64>, f64)> {
    let n = at.d.len();
    let p = at.factor.inverse();
    let q = t * &p;
    let r = &q * t.transpose();

    let mut gradient = DVector::zeros(n + 1);
    let mut hessian = DMatrix::zeros(n + 1, n + 1);
    for i in 0..n {
        gradient[i] = -2.0 * q[(i, i)] - 1.0 / at.d[i];
        for j in 0..n {
            hessian[(i, j)] = 2.0 * (q[(i, j)] * q[(j, i)] + p[(i, j)] * r[(i, j)]);
        }

        hessian[(i, i)] += 1.0 / (at.d[i] * at.d[i]);
        let mixed = -2.0 * q.row(i).dot(&p.row(i));
        hessian[(i, n)] = mixed;
        hessian[(n, i)] = mixed;
    }

    gradient[n] = p.trace() - tau;
    hessian[(n, n)] = p.norm_squared();

    // The step -H^-1 (g + z 1), with z such that the weights keep their sum.
    let factor = Cholesky::new(hessian)?;
    let mut ones = DVector::from_element(n + 1, 1.0);
    ones[n] = 0.0;
    let towards_sum = factor.solve(&ones);
    let downhill = factor.solve(&gradient);
    let z = downhill.dot(&ones) / towards_sum.dot(&ones);
    let step = towards_sum * z - downhill;
    let decrement = -gradient.dot(&step);
    Some((step, decrement))
}

/// Where the barrier method ends.
struct BarrierEnd {
    at: Inside,
    /// Is S definite there?
    has_weights: bool,
}

/// Looks for weights with the sum n for a matrix with a diagonal of ones, at least half as good as
/// the best ones; `None` where rounding ends the search.
fn barrier(t: &DMatrix<f64>) -> Option<BarrierEnd> {
    let n = t.nrows();
    let start = DVector::from_element(n, 1.0);
    let lowest = -t.map(f64::abs).row_sum().max() - t.map(f64::abs).column_sum().max();
    let mut at = Inside::new(t, start, lowest)?;
    let mut tau = n as f64;

    for _ in 0..MOST_STEPS {
        let (step, decrement) = newton(t, &at, tau)?;
        if decrement < NEWTON_DECREMENT {
            let largest_possible = at.s + 2.0 * n as f64 / tau;
            let has_weights = at.s > 0.5 * largest_possible;
            if has_weights || largest_possible < LEAST_PIVOT {
                return Some(BarrierEnd { at, has_weights });
            }

            tau *= STEP_OF_TAU;
            continue;
        }

        at = searched(t, &at, &step, decrement, tau)?;
    }

    let has_weights = at.s > LEAST_PIVOT;
    Some(BarrierEnd { at, has_weights })
}

/// The point along a step, halved until it is inside and the value falls by a tenth of what it
/// should.
fn searched(
    t: &DMatrix<f64>,
    at: &Inside,
    step: &DVector<f64>,
    decrement: f64,
    tau: f64,
) -> Option<Inside> {
    let n = at.d.len();
    let value = at.value(tau);
    let mut length = 1.0;
    for _ in 0..f64::MANTISSA_DIGITS {
        let d = &at.d + step.rows(0, n) * length;
        let found = Inside::new(t, d, at.s + length * step[n]);
        if let Some(found) = found
            && found.value(tau) <= value - 0.1 * length * decrement
        {
            return Some(found);
        }

        length *= 0.5;
    }

    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::complete::pieces::matrix::SquareMatrix;

    const UNDECIDED: VariableState = VariableState::Undecided;

    fn weights_of(matrix: &SquareMatrix, states: &[VariableState]) -> Option<Weights> {
        let point = ChordEnds::exact(1.0, 1.0, [matrix.clone(), matrix.clone()]);
        Weights::of(&point, states)
    }

    /// sym(T) is singular, and with d = (1, d) it is definite for every d > 1.
    #[test]
    fn weights_are_found_where_the_symmetric_part_is_not_definite() {
        let matrix = vec![vec![1.0, -2.0], vec![0.0, 1.0]];
        let states = [UNDECIDED; 2];
        let found = weights_of(&matrix, &states).unwrap();
        assert!(found.d[1] > found.d[0], "{:?}", found.d);
        assert!(definite::is_definite(&matrix, None, &states, &found.d));
        assert!(!definite::is_definite(&matrix, None, &states, &[1.0; 2]));
    }

    /// At x = (1, 1) T = [[1, -1], [-1, 1]] has a solution; a little beyond, (1, 1) is near it.
    #[test]
    fn what_excludes_weights_is_next_to_a_solution() {
        let obstacle = |matrix: &SquareMatrix| {
            let point = ChordEnds::exact(1.0, 1.0, [matrix.clone(), matrix.clone()]);
            Weights::obstacle(&point, &[UNDECIDED; 2])
        };

        let x = obstacle(&vec![vec![1.0, -1.001], vec![-1.0, 1.0]]).unwrap();
        assert!((x[0] / x[1] - 1.0).abs() < 0.01, "{x:?}");
        assert_eq!(obstacle(&vec![vec![1.0, -0.999], vec![-1.0, 1.0]]), None);
        let at_first = Some(vec![1.0, 0.0]);
        assert_eq!(obstacle(&vec![vec![-1.0, 0.0], vec![0.0, 1.0]]), at_first);
    }

    /// No weights where T is no P-matrix, nor for this P-matrix: a cyclic one whose rotation is too
    /// strong. What rests does not count.
    #[test]
    fn there_are_none_where_none_can_be() {
        let singular = vec![vec![1.0, -2.0], vec![-0.5, 1.0]];
        assert!(weights_of(&singular, &[UNDECIDED; 2]).is_none());

        let cyclic = vec![
            vec![1.0, 3.0, 0.0],
            vec![0.0, 1.0, 3.0],
            vec![3.0, 0.0, 1.0],
        ];
        assert!(weights_of(&cyclic, &[UNDECIDED; 3]).is_none());
        let states = [UNDECIDED, UNDECIDED, VariableState::AtZero];
        assert!(weights_of(&cyclic, &states).is_some());

        let negative = vec![vec![-1.0]];
        assert!(weights_of(&negative, &[UNDECIDED]).is_none());
    }
}
