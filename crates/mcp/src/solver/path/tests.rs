//! Paths of small linear problems with known ends.

mod exact;
mod finite;

use super::super::options::RatioTest;
use super::*;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

const INF: f64 = f64::INFINITY;
const LIMITS: PathLimits = PathLimits {
    pivots: 200,
    cycle_entries: 20,
    rule: RatioTest::Lexicographic,
};

/// A breakpoint.
#[derive(Debug)]
struct Knot<T: PathNumber> {
    t: T,
    z: DVector<T>,
    multiplier: DVector<T>,
}

fn knots<T: PathNumber>(path: &Path<T>) -> Vec<Knot<T>> {
    let vector = DVector::from_column_slice;
    let knot = |k: usize| Knot {
        t: path.knots.t(k).clone(),
        z: vector(path.knots.z(k)),
        multiplier: vector(path.knots.multiplier(k)),
    };
    (0..path.knots.len()).map(knot).collect()
}

/// Follows in storage that another path has left behind.
fn walked<T: PathNumber>(
    sub: &Subproblem<'_, T>,
    start: Start,
    current: &[T],
    limits: PathLimits,
) -> Path<T> {
    let other = match start {
        Start::Ray => Start::Regular,
        Start::Regular => Start::Ray,
    };
    let few_pivots = PathLimits {
        pivots: 3,
        ..limits
    };

    let mut storage = PathStorage::default();
    let mut path = Path::default();
    storage.follow(sub, other, current, few_pivots, &mut path);
    storage.follow(sub, start, current, limits, &mut path);
    path
}

/// Follows and checks that every knot satisfies the path equation and the bounds.
fn followed(
    m: &DMatrix<f64>,
    q: &DVector<f64>,
    l: &[f64],
    u: &[f64],
    start: Start,
    current: &[f64],
) -> Path {
    let sub = Subproblem {
        m,
        q: q.as_slice(),
        lower: l,
        upper: u,
    };
    let path = walked(&sub, start, current, LIMITS);
    let knots = knots(&path);
    let r = knots.first().map(|k| &k.multiplier - m * &k.z - q);

    for knot in &knots {
        let equation = m * &knot.z - &knot.multiplier + q + r.clone().unwrap() * (1.0 - knot.t);
        assert!(equation.amax() < 1e-9, "{equation} at {knot:?}");

        for i in 0..l.len() {
            assert!(knot.z[i] >= l[i] - 1e-9, "{knot:?}");
            assert!(knot.z[i] <= u[i] + 1e-9, "{knot:?}");
            assert!(
                knot.multiplier[i] < 1e-9 || knot.z[i] <= l[i] + 1e-9,
                "{knot:?}"
            );
            assert!(
                knot.multiplier[i] > -1e-9 || knot.z[i] >= u[i] - 1e-9,
                "{knot:?}"
            );
        }
    }

    path
}

/// The tableau at the beginning of a path.
pub(super) fn at_start<R>(
    sub: &Subproblem<'_, f64>,
    start: Start,
    current: &[f64],
    look: impl FnOnce(PathTableau<'_, f64>) -> R,
) -> R {
    let PathStorage {
        mut frame,
        mut basis,
        mut state,
        mut free,
        ..
    } = PathStorage::default();
    start_point(sub, start, current, &mut state, &mut free);
    frame.set(sub, &state.z, &state.multiplier);

    assert!(starting_basis(
        sub,
        &mut frame,
        &mut basis,
        &state,
        &mut Path::default()
    ));

    look(PathTableau::new(frame.columns(sub), &mut basis, &mut state))
}

#[test]
fn one_by_one_from_both_starts() {
    for start in [Start::Regular, Start::Ray] {
        let path = followed(
            &dmatrix![2.0],
            &dvector![-3.0],
            &[0.0],
            &[INF],
            start,
            &[0.0],
        );

        assert_eq!(path.end, PathEnd::Complete);
        assert!((path.last().unwrap()[0] - 1.5).abs() < 1e-15);
        assert_eq!(path.pivots.last().unwrap().kind, PivotKind::Complete);
    }
}

#[test]
fn a_zero_residual_is_complete_at_once() {
    let path = followed(
        &dmatrix![1.0],
        &dvector![1.0],
        &[0.0],
        &[INF],
        Start::Regular,
        &[0.0],
    );

    assert_eq!(path.end, PathEnd::Complete);
    assert_eq!(path.pivots.len(), 1);
    assert_eq!(path.reach(), 1.0);
}

#[test]
fn a_doubly_bounded_unknown_flips() {
    let path = followed(
        &dmatrix![1.0, 0.0; 0.0, 1.0],
        &dvector![-5.0, -1.0],
        &[0.0; 2],
        &[1.0, INF],
        Start::Ray,
        &[0.0; 2],
    );

    assert_eq!(path.end, PathEnd::Complete);
    assert!((DVector::from_column_slice(path.last().unwrap()) - dvector![1.0, 1.0]).amax() < 1e-14);

    // M = -1: z runs from bound to bound while t stands still or turns back.
    let path = followed(
        &dmatrix![-1.0],
        &dvector![0.5],
        &[0.0],
        &[1.0],
        Start::Regular,
        &[0.9],
    );

    assert_eq!(path.end, PathEnd::Complete);
}

#[test]
fn an_infeasible_problem_ends_on_a_ray() {
    for start in [Start::Regular, Start::Ray] {
        let path = followed(
            &dmatrix![-1.0],
            &dvector![-1.0],
            &[0.0],
            &[INF],
            start,
            &[0.0],
        );

        assert_eq!(path.end, PathEnd::Ray, "{start:?}");
        assert!(path.knots.len() >= 2);
    }
}

#[test]
fn singular_starts_leave_through_artificials() {
    // Both z strictly inside: the block of ones is singular. Solutions z1 + z2 = 1.
    let m = dmatrix![1.0, 1.0; 1.0, 1.0];
    let q = dvector![-1.0, -1.0];
    let path = followed(&m, &q, &[0.0; 2], &[INF; 2], Start::Regular, &[2.0, 3.0]);

    assert_eq!(path.end, PathEnd::Complete, "{path:?}");

    // A zero matrix with free unknowns has only artificials, and no way to move.
    let path = followed(
        &dmatrix![0.0],
        &dvector![1.0],
        &[-INF],
        &[INF],
        Start::Regular,
        &[0.0],
    );

    assert_eq!(path.end, PathEnd::Ray);
}

#[test]
fn equal_bounds_fix_an_unknown() {
    for start in [Start::Regular, Start::Ray] {
        let path = followed(
            &dmatrix![1.0, 1.0; 1.0, 2.0],
            &dvector![-9.0, -4.0],
            &[1.0, 0.0],
            &[1.0, INF],
            start,
            &[1.0, 0.0],
        );

        assert_eq!(path.end, PathEnd::Complete);
        assert_eq!(path.last().unwrap(), [1.0, 1.5]);
    }
}

#[test]
fn points_along_the_path_are_found_by_t() {
    let path = followed(
        &dmatrix![2.0],
        &dvector![-3.0],
        &[0.0],
        &[INF],
        Start::Regular,
        &[0.0],
    );

    assert!((path.at(0.5).unwrap()(0) - 0.75).abs() < 1e-15);
    assert!(path.at(1.5).is_none());
}

#[test]
fn ties_go_to_the_lexicographically_least() {
    // Both w are tied; perturbed by (eps, eps^2) the second one is the smaller.
    let m = DMatrix::from_element(2, 2, 1.0);
    let q = dvector![-1.0, -1.0];
    let path = followed(&m, &q, &[0.0; 2], &[INF; 2], Start::Ray, &[0.0; 2]);

    assert_eq!(path.pivots[0].leaving, Variable::W(1));
    assert_eq!(path.end, PathEnd::Complete);
}

#[test]
fn the_multiplier_of_equal_bounds_changes_sign_without_a_pivot() {
    let m = dmatrix![0.0, -1.0; 0.0, 1.0];
    let q = dvector![1.0, -5.0];
    let path = followed(
        &m,
        &q,
        &[1.0, 0.0],
        &[1.0, INF],
        Start::Regular,
        &[1.0, 0.0],
    );

    assert_eq!(path.end, PathEnd::Complete, "{:?}", path.pivots);
    assert_eq!(path.pivots.len(), 2, "{:?}", path.pivots);
    assert_eq!(path.knots.multiplier(path.knots.len() - 1), [-4.0, 0.0]);
}

#[test]
fn drift_is_noticed_and_mended() {
    let m = dmatrix![2.0, 1.0; 1.0, 2.0];
    let sub = Subproblem {
        m: &m,
        q: &[-5.0, -6.0],
        lower: &[0.0; 2],
        upper: &[INF; 2],
    };
    at_start(&sub, Start::Ray, &[0.0, 0.0], |mut tableau| {
        tableau.set_rates();
        let block = ratio::ratio_test(&mut tableau, RatioTest::Lexicographic, 0).unwrap();
        tableau.advance(&block.step);
        let exact = tableau.state.values.clone();
        tableau.state.values[0] += 1e-6;

        assert!(tableau.exchange(block.place.unwrap(), block.at_upper));

        let values = &tableau.state.values;
        assert!((values[0] - exact[0]).abs() < 1e-12, "{values:?} {exact:?}");
    });
}

#[test]
fn a_path_reaches_the_largest_t_of_its_knots() {
    /// A path with knots at these t, z = 4 t.
    fn path(list: &[f64]) -> Path {
        let mut path = Path::default();
        path.knots.clear(1);
        for &t in list {
            path.knots.push(t, &[4.0 * t], &[0.0]);
        }
        path
    }

    assert_eq!(path(&[0.0, 0.25, 0.75, 0.5]).reach(), 0.75);
    assert_eq!(path(&[0.0, 1.0]).reach(), 1.0);
    assert_eq!(path(&[]).reach(), 0.0);
    assert_eq!(
        path(&[0.0, 0.25, 0.75, 0.5]).at(0.5).map(|z| z(0)),
        Some(2.0)
    );
    assert!(path(&[0.0, 0.25]).at(0.5).is_none());
}

/// One for the start: a short path makes no other.
#[test]
fn factorisations_are_counted() {
    let path = followed(
        &dmatrix![2.0],
        &dvector![-3.0],
        &[0.0],
        &[INF],
        Start::Regular,
        &[0.0],
    );

    assert_eq!(path.factorisations, 1);
}
