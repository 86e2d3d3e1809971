//! What the bounds decide before any pivot, on linear problems (the presolve of PATH: Ferris and
//! Munson, "Preprocessing complementarity problems", 2001; here its three simplest rules).
//!
//! Rules, repeated until none applies: equal bounds fix z_i; a row whose value has one sign over
//! all bounds fixes z_i at the bound of that sign; a row that depends on a fixed point of z_i
//! alone, with a positive diagonal, is solved. A row whose sign has no bound is left alone: the
//! path ends on a ray.
//!
//! Input: a linear problem. Output: the problem in the unknowns that are left, and the values of
//! the others. Called by `linear`.

use super::tolerance::SIGN_SURE;
use crate::mcp::{LinearMcp, Mcp};
use nalgebra::DMatrix;

/// A linear problem without the unknowns that were decided.
#[derive(Debug, Clone)]
pub(super) struct Preprocessed {
    /// Problem in the unknowns that are left; `None` if nothing was decided.
    pub(super) reduced: Option<LinearMcp>,
    /// Which unknowns are left, ascending.
    pub(super) kept: Vec<usize>,
    /// Values of the decided ones, `None` for those kept.
    decided: Vec<Option<f64>>,
}

impl Preprocessed {
    /// Applies the rules.
    pub(super) fn new(problem: &LinearMcp) -> Preprocessed {
        let n = problem.dimension();
        let mut decided: Vec<Option<f64>> = vec![None; n];

        while let Some((i, value)) = next_decision(problem, &decided) {
            decided[i] = Some(value);
        }

        let kept: Vec<usize> = (0..n).filter(|&i| decided[i].is_none()).collect();
        if kept.len() == n {
            return Preprocessed::nothing(n);
        }

        match reduce(problem, &decided, &kept) {
            Some(reduced) => Preprocessed {
                reduced: Some(reduced),
                kept,
                decided,
            },
            None => Preprocessed::nothing(n),
        }
    }

    /// Of `n` unknowns none is decided.
    pub(super) fn nothing(n: usize) -> Preprocessed {
        Preprocessed {
            reduced: None,
            kept: (0..n).collect(),
            decided: vec![None; n],
        }
    }

    /// The point of the whole problem over one of the reduced one.
    pub(super) fn restore(&self, z: &[f64]) -> Vec<f64> {
        let mut kept_values = z.iter();
        let mut whole = Vec::with_capacity(self.decided.len());

        for decided in &self.decided {
            let value = decided.or_else(|| kept_values.next().copied());
            whole.push(value.unwrap_or(f64::NAN));
        }
        whole
    }
}

/// The first unknown that a rule decides, with its value.
fn next_decision(problem: &LinearMcp, decided: &[Option<f64>]) -> Option<(usize, f64)> {
    for i in 0..decided.len() {
        if decided[i].is_some() {
            continue;
        }

        if let Some(value) = decide(problem, decided, i) {
            return Some((i, value));
        }
    }
    None
}

/// The value of z_i, if a rule decides it.
fn decide(problem: &LinearMcp, decided: &[Option<f64>], i: usize) -> Option<f64> {
    let lower = problem.lower()[i];
    let upper = problem.upper()[i];
    if lower == upper {
        return Some(lower);
    }

    if let Some(value) = solve_alone(problem, decided, i) {
        return Some(value.max(lower).min(upper));
    }

    let range = range(problem, decided, i);
    let sure = SIGN_SURE * range.size;

    if range.least > sure && lower.is_finite() {
        Some(lower)
    } else if range.most < -sure && upper.is_finite() {
        Some(upper)
    } else {
        None
    }
}

/// The z_i with F_i = 0, if F_i depends on decided unknowns and on z_i alone, on that with a
/// positive slope.
fn solve_alone(problem: &LinearMcp, decided: &[Option<f64>], i: usize) -> Option<f64> {
    let row = problem.matrix().row(i);
    let is_alone = (0..row.len()).all(|j| j == i || row[j] == 0.0 || decided[j].is_some());
    let slope = row[i];

    if !is_alone || slope <= 0.0 {
        return None;
    }

    let terms = (0..row.len()).filter_map(|j| decided[j].map(|z| row[j] * z));
    let rest: f64 = terms.sum();
    Some(-(problem.vector()[i] + rest) / slope)
}

/// The values of a row over all bounds.
#[derive(Debug, PartialEq)]
struct RowRange {
    least: f64,
    most: f64,
    /// |q_i| and the largest finite value of each term, added up.
    size: f64,
}

/// Least and largest F_i over all bounds, and the size of its finite terms.
fn range(problem: &LinearMcp, decided: &[Option<f64>], i: usize) -> RowRange {
    let q = problem.vector()[i];
    let mut range = RowRange {
        least: q,
        most: q,
        size: q.abs(),
    };

    for (j, &m) in problem.matrix().row(i).iter().enumerate() {
        if m == 0.0 {
            continue;
        }

        let lower = decided[j].unwrap_or(problem.lower()[j]);
        let upper = decided[j].unwrap_or(problem.upper()[j]);
        let rises = m > 0.0;
        let least = if rises { m * lower } else { m * upper };
        let most = if rises { m * upper } else { m * lower };

        range.least += least;
        range.most += most;
        range.size += finite_size(least).max(finite_size(most));
    }
    range
}

/// The magnitude of a finite number, else 0.
fn finite_size(value: f64) -> f64 {
    if value.is_finite() { value.abs() } else { 0.0 }
}

/// The problem in the kept unknowns; `None` if its numbers overflow.
fn reduce(problem: &LinearMcp, decided: &[Option<f64>], kept: &[usize]) -> Option<LinearMcp> {
    let m = problem.matrix();
    let matrix = DMatrix::from_fn(kept.len(), kept.len(), |a, b| m[(kept[a], kept[b])]);

    let mut q = Vec::with_capacity(kept.len());
    for &i in kept {
        let values = decided.iter().enumerate();
        let terms = values.filter_map(|(j, z)| z.map(|z| m[(i, j)] * z));
        let constant: f64 = terms.sum();
        q.push(problem.vector()[i] + constant);
    }

    let lower = kept.iter().map(|&i| problem.lower()[i]).collect();
    let upper = kept.iter().map(|&i| problem.upper()[i]).collect();
    LinearMcp::new(matrix, q, lower, upper).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn each_rule_decides_and_its_near_miss_does_not() {
        let preprocessed = |m: DMatrix<f64>, q: &[f64], l: &[f64], u: &[f64]| {
            Preprocessed::new(&LinearMcp::new(m, q.to_vec(), l.to_vec(), u.to_vec()).unwrap())
        };
        let coupled = dmatrix![0.0, 1.0; 1.0, 0.0];

        // Equal bounds fix z_1 = 2, then F_2 = 2 + 1 > 0 puts z_2 on its lower bound.
        let both = preprocessed(coupled.clone(), &[0.0, 1.0], &[2.0, 0.0], &[2.0, INF]);
        assert!(both.kept.is_empty());
        assert!(both.restore(&[]) == [2.0, 0.0]);

        // F_2 = z_1 - 1 has no sign over [0, inf).
        assert!(
            preprocessed(coupled.clone(), &[0.0, -1.0], &[0.0; 2], &[INF; 2])
                .reduced
                .is_none()
        );

        // F_2 = z_1 - 9 < 0 over [0, 1]: the upper bound, or nothing where there is none.
        assert_eq!(
            preprocessed(coupled.clone(), &[0.0, -9.0], &[0.0; 2], &[1.0, 3.0]).restore(&[0.5])[1],
            3.0
        );
        assert!(
            preprocessed(coupled, &[0.0, -9.0], &[0.0; 2], &[1.0, INF])
                .reduced
                .is_none()
        );

        // A row of its own: solved and kept within the bounds; not with a diagonal of the other
        // sign.
        assert_eq!(
            preprocessed(dmatrix![2.0], &[-3.0], &[0.0], &[INF]).restore(&[]),
            [1.5]
        );
        assert_eq!(
            preprocessed(dmatrix![2.0], &[-3.0], &[0.0], &[1.0]).restore(&[]),
            [1.0]
        );
        assert!(
            preprocessed(dmatrix![-2.0], &[3.0], &[0.0], &[INF])
                .reduced
                .is_none()
        );
    }

    #[test]
    fn the_reduced_problem_carries_the_decided_values() {
        let m = dmatrix![1.0, 5.0, 2.0; 0.0, 0.0, 3.0; 4.0, 0.0, 1.0];
        let problem =
            LinearMcp::new(m, vec![7.0, 1.0, -50.0], vec![-INF, 0.0, 0.0], vec![INF; 3]).unwrap();
        let less = Preprocessed::new(&problem);

        assert_eq!(less.kept, vec![0, 2], "F_2 >= 1 puts z_2 on 0");

        let expected = LinearMcp::new(
            dmatrix![1.0, 2.0; 4.0, 1.0],
            vec![7.0, -50.0],
            vec![-INF, 0.0],
            vec![INF; 2],
        )
        .unwrap();

        assert_eq!(less.reduced, Some(expected));
        assert_eq!(less.restore(&[3.0, 4.0]), [3.0, 0.0, 4.0]);
    }

    /// F_0 = 1 + 2 z_0 - 3 z_1 over [-1, 4] x [-2, 5]: from -16 to 15; decided values are points.
    #[test]
    fn the_range_of_a_row_takes_the_right_ends() {
        let p = LinearMcp::new(
            dmatrix![2.0, -3.0; 0.0, 0.0],
            vec![1.0, -7.0],
            vec![-1.0, -2.0],
            vec![4.0, 5.0],
        )
        .unwrap();
        let nothing = [None, None];
        let first = [Some(3.0), None];
        let both = [Some(3.0), Some(-2.0)];

        assert_range(range(&p, &nothing, 0), -16.0, 15.0, 1.0 + 8.0 + 15.0);
        assert_range(range(&p, &first, 0), -8.0, 13.0, 1.0 + 6.0 + 15.0);
        assert_range(range(&p, &both, 0), 13.0, 13.0, 1.0 + 6.0 + 6.0);
        assert_range(range(&p, &nothing, 1), -7.0, -7.0, 7.0);

        let unbounded = LinearMcp::new(
            dmatrix![2.0, -3.0; 0.0, 0.0],
            vec![1.0, -7.0],
            vec![-1.0, 0.0],
            vec![INF, INF],
        )
        .unwrap();

        assert_range(range(&unbounded, &nothing, 0), -INF, INF, 1.0 + 2.0);
    }

    fn assert_range(got: RowRange, least: f64, most: f64, size: f64) {
        assert_eq!(got, RowRange { least, most, size });
    }

    /// A sign is sure from SIGN_SURE of the row's terms on; zero has none, and a bound that is
    /// infinite takes nothing.
    #[test]
    fn a_sign_is_sure_beyond_rounding() {
        let decided = |q: f64, l: f64, u: f64| {
            // F_0 = q + z_1 with z_1 in [-1, -1 + 0]: terms of size 1 + |q|.
            let p = LinearMcp::new(
                dmatrix![0.0, 1.0; 0.0, 0.0],
                vec![q, 0.0],
                vec![l, -1.0],
                vec![u, -1.0],
            )
            .unwrap();
            decide(&p, &[None, None], 0)
        };
        let sure = SIGN_SURE * 2.0; // |q| + |z_1|

        assert_eq!(decided(1.0 + 1.01 * sure, 0.0, 4.0), Some(0.0));
        assert_eq!(decided(1.0 + 0.99 * sure, 0.0, 4.0), None);
        assert_eq!(decided(1.0 - 1.01 * sure, 0.0, 4.0), Some(4.0));
        assert_eq!(decided(1.0 - 0.99 * sure, 0.0, 4.0), None);
        assert_eq!(decided(2.0, -INF, 4.0), None);
        assert_eq!(decided(0.0, 0.0, INF), None);

        let zero = LinearMcp::new(dmatrix![0.0], vec![0.0], vec![0.0], vec![4.0]).unwrap();
        assert_eq!(decide(&zero, &[None], 0), None);
    }

    /// A row of one unknown is solved whatever others are open; a row of two waits for the other
    /// one.
    #[test]
    fn a_row_alone_is_solved() {
        let p = LinearMcp::new(
            dmatrix![2.0, 0.0; 1.0, 4.0],
            vec![-3.0, -5.0],
            vec![-INF; 2],
            vec![INF; 2],
        )
        .unwrap();

        assert_eq!(decide(&p, &[None, None], 0), Some(1.5));
        assert_eq!(decide(&p, &[None, None], 1), None);
        assert_eq!(decide(&p, &[Some(1.5), None], 1), Some(0.875));
        assert_eq!(Preprocessed::new(&p).restore(&[]), [1.5, 0.875]);
    }
}
