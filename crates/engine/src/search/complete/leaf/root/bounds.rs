//! The bounds by which the checker sees that a support has one null vector, in doubles.
//!
//! The witness is that of `bordered`. The steps are those of `check::cover::root`:
//!
//! 1. |I - Y T'| <= rho < 1 and |I - T'Y| <= eta < 1;
//! 2. |v_true - v| <= |Y (T_'k + T'v)| / (1 - rho), likewise for u;
//! 3. phi' = u'(dT/dt)v is certainly not zero (*monotone*), phi being the Schur complement;
//! 4. the sign of phi at each end.
//!
//! The checker decides with exact numbers; margins here make it agree.

use crate::bordered::{BoxCorner, NullVectors, largest};
use crate::search::complete::pieces::expansion::ChordEnds;

/// rho and eta up to which a witness is offered: less than 1 by a margin.
const MAX_IDENTITY_ERROR: f64 = 0.9;

/// Factor by which the slope of phi must exceed its uncertainty.
const SLOPE_MARGIN: f64 = 1.05;

/// Factor by which the second term of phi may exceed its bound here.
const RESIDUAL_MARGIN: f64 = 2.0;

/// Bounds of the largest component of u_true - u and v_true - v.
pub(super) struct Errors {
    left: f64,
    pub(super) right: f64,
}

impl Errors {
    /// Steps 1 and 2; `None` where the inverse is not good enough.
    pub(super) fn of(vectors: &NullVectors, ends: &ChordEnds) -> Option<Errors> {
        let mirrored = vectors.mirrored();
        Some(Errors {
            right: one_sided([0, 1].map(|end| BoxCorner::of(ends, end, vectors)))?,
            left: one_sided([0, 1].map(|end| BoxCorner::mirrored(ends, end, &mirrored)))?,
        })
    }
}

/// The bound of |v_true - v| over both ends.
fn one_sided(corners: [BoxCorner<'_>; 2]) -> Option<f64> {
    let mut norm: f64 = 0.0;
    let mut residual: f64 = 0.0;
    for corner in corners {
        let ones = vec![1.0; corner.order()];
        norm = norm.max(largest(corner.deviations(&ones)));
        residual = residual.max(largest(corner.errors(&corner.products())));
    }

    (norm < MAX_IDENTITY_ERROR).then(|| residual / (1.0 - norm))
}

/// Step 3: has phi' one sign over the interval?
pub(super) fn is_monotone(vectors: &NullVectors, ends: &ChordEnds, errors: &Errors) -> bool {
    let support = vectors.support();
    let left = VectorComponent::list(&vectors.left, errors.left);
    let right = VectorComponent::list(&vectors.right, errors.right);
    let mut slope = 0.0;
    let mut around = 0.0;

    for (u, &i) in left.iter().zip(&support) {
        for (v, &j) in right.iter().zip(&support) {
            let difference = ends.m[1][i][j] - ends.m[0][i][j];
            let radius = ends.slope_radius(i, j);
            slope += u.value * difference * v.value;

            // What u v may differ from its approximation by, for each unit of the entry.
            let product_error = u.product_error(v);
            let by_radius = radius * (u.value * v.value).abs();
            let by_vectors = (difference.abs() + radius) * product_error;
            around += by_radius + by_vectors;
        }
    }

    slope.abs() > SLOPE_MARGIN * around
}

/// Step 4: the product of the signs of phi at both ends, 0 where one of them is not certain.
pub(super) fn sign_product(vectors: &NullVectors, ends: &ChordEnds, errors: &Errors) -> i8 {
    let [lower, upper] = [0, 1].map(|end| schur_sign(&BoxCorner::of(ends, end, vectors), errors));
    lower * upper
}

/// The sign of phi = u'Tv - (residual of u)' T'^-1 (residual of v) at an end, 0 if not certain.
fn schur_sign(corner: &BoxCorner<'_>, errors: &Errors) -> i8 {
    let ones = vec![1.0; corner.order()];
    let mut phi = corner.value(&corner.products());
    phi.radius += RESIDUAL_MARGIN * corner.left_residual(&ones) * errors.right;
    phi.sign()
}

/// A component of a null vector and how far it may be off.
struct VectorComponent {
    value: f64,
    error: f64,
}

impl VectorComponent {
    /// The components on `rest`, then the pivot's, which is exactly 1.
    fn list(on_rest: &[f64], error: f64) -> Vec<VectorComponent> {
        let mut list = Vec::with_capacity(on_rest.len() + 1);
        for &value in on_rest {
            list.push(VectorComponent { value, error });
        }

        list.push(VectorComponent {
            value: 1.0,
            error: 0.0,
        });
        list
    }

    /// Bound of the error of a product of two components.
    fn product_error(&self, other: &VectorComponent) -> f64 {
        let by_first = self.error * other.value.abs();
        let by_second = self.value.abs() * other.error;
        by_first + by_second + self.error * other.error
    }
}
