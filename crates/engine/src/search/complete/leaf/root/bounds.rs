//! The bounds by which the checker sees that a support has one null vector, in doubles.
//!
//! S is the support, k in S the pivot, T' the block of T on S without k, Y ~ T'^-1, and v, u ~ the
//! right and left null vectors with v_k = u_k = 1. The steps are those of `check::cover::root`:
//!
//! 1. |Y T' - I| <= rho < 1 and |T' Y - I| <= eta < 1;
//! 2. |v_true - v| <= |Y (T_'k + T'v)| / (1 - rho), likewise for u;
//! 3. phi' = u'(dT/dt)v is certainly not zero (*monotone*), phi being the Schur complement;
//! 4. the sign of phi at each end.
//!
//! The checker decides with exact numbers; margins here make it agree.

use crate::dense::transposed;
use crate::search::complete::pieces::expansion::Ends;
use crate::search::complete::pieces::matrix::Matrix;

/// rho and eta up to which a witness is offered: less than 1 by a margin.
const MAX_IDENTITY_ERROR: f64 = 0.9;

/// Factor by which the slope of phi must exceed its uncertainty.
const SLOPE_MARGIN: f64 = 1.05;

/// A number known up to a radius.
#[derive(Clone, Copy)]
struct Ball {
    center: f64,
    radius: f64,
}

impl Ball {
    fn exact(center: f64) -> Ball {
        Ball {
            center,
            radius: 0.0,
        }
    }

    /// Adds `factor * other`.
    fn add(&mut self, factor: f64, other: Ball) {
        self.center += factor * other.center;
        self.radius += factor.abs() * other.radius;
    }

    /// Largest modulus of the numbers in the ball.
    fn magnitude(self) -> f64 {
        self.center.abs() + self.radius
    }
}

/// Approximations on a support: the inverse without the pivot, and both null vectors.
pub(super) struct Approximation {
    /// Positions of the support without the pivot.
    pub(super) rest: Vec<usize>,
    /// Position of the pivot, whose component is 1 in both vectors.
    pub(super) pivot: usize,
    /// Y.
    pub(super) inverse: Matrix,
    /// u and v on `rest`.
    pub(super) left: Vec<f64>,
    pub(super) right: Vec<f64>,
}

/// Bounds of the largest component of u_true - u and v_true - v.
pub(super) struct Errors {
    left: f64,
    pub(super) right: f64,
}

#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
}

impl Approximation {
    /// Steps 1 and 2; `None` where the inverse is not good enough.
    pub(super) fn errors(&self, ends: &Ends) -> Option<Errors> {
        let right = self.one_sided(ends, Side::Right);
        let left = self.one_sided(ends, Side::Left);
        let rho = right.identity_error;
        let eta = left.identity_error;
        if rho < MAX_IDENTITY_ERROR && eta < MAX_IDENTITY_ERROR {
            Some(Errors {
                right: right.residual / (1.0 - rho),
                left: left.residual / (1.0 - eta),
            })
        } else {
            None
        }
    }

    /// The largest norms over both ends of the interval.
    fn one_sided(&self, ends: &Ends, side: Side) -> Norms {
        let mut norms = Norms {
            identity_error: 0.0,
            residual: 0.0,
        };

        for end in 0..2 {
            let system = OneSided::new(self, ends, end, side);
            norms.identity_error = system.identity_error(norms.identity_error);
            norms.residual = system.residual(norms.residual);
        }

        norms
    }

    /// Positions of the support, the pivot last.
    fn support(&self) -> Vec<usize> {
        let mut support = self.rest.clone();
        support.push(self.pivot);
        support
    }

    /// Step 3: has phi' one sign over the interval?
    pub(super) fn is_monotone(&self, ends: &Ends, errors: &Errors) -> bool {
        let support = self.support();
        let left = Component::list(&self.left, errors.left);
        let right = Component::list(&self.right, errors.right);
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
    pub(super) fn sign_product(&self, ends: &Ends, errors: &Errors) -> i8 {
        let lower = self.schur_sign(ends, 0, errors);
        let upper = self.schur_sign(ends, 1, errors);
        lower * upper
    }

    /// The sign of phi = u'Tv - (residual of u)' T'^-1 (residual of v) at an end, 0 if not certain.
    fn schur_sign(&self, ends: &Ends, end: usize, errors: &Errors) -> i8 {
        let support = self.support();
        let left = Component::list(&self.left, 0.0);
        let right = Component::list(&self.right, 0.0);
        let mut product = 0.0;
        let mut around = 0.0;
        let mut left_residual = 0.0;

        for (v, &j) in right.iter().zip(&support) {
            let mut column = 0.0;
            let mut column_around = 0.0;
            for (u, &i) in left.iter().zip(&support) {
                let entry = ends.m[end][i][j];
                let entry_around = entry.abs() * 4.0 * f64::EPSILON + ends.radius(i, j);
                column += u.value * entry;
                column_around += u.value.abs() * entry_around;
            }

            product += column * v.value;
            around += column_around * v.value.abs();
            if j != self.pivot {
                left_residual += column.abs() + column_around;
            }
        }

        let error = around + 2.0 * left_residual * errors.right;
        if product > error {
            1
        } else if -product > error {
            -1
        } else {
            0
        }
    }
}

/// A component of a null vector and how far it may be off.
struct Component {
    value: f64,
    error: f64,
}

impl Component {
    /// The components on `rest`, then the pivot's, which is exactly 1.
    fn list(on_rest: &[f64], error: f64) -> Vec<Component> {
        let mut list = Vec::with_capacity(on_rest.len() + 1);
        for &value in on_rest {
            list.push(Component { value, error });
        }

        list.push(Component {
            value: 1.0,
            error: 0.0,
        });
        list
    }

    /// Bound of the error of a product of two components.
    fn product_error(&self, other: &Component) -> f64 {
        let by_first = self.error * other.value.abs();
        let by_second = self.value.abs() * other.error;
        by_first + by_second + self.error * other.error
    }
}

/// |Y T' - I| and |Y (T_'k + T'v)| or their like from the left.
struct Norms {
    identity_error: f64,
    residual: f64,
}

/// T at one end, seen from one side: from the left everything is transposed.
struct OneSided<'a> {
    /// Y.
    inverse: Matrix,
    /// T'.
    block: Vec<Vec<Ball>>,
    /// T_'k.
    column: Vec<Ball>,
    /// v.
    vector: &'a [f64],
}

impl OneSided<'_> {
    fn new<'a>(of: &'a Approximation, ends: &Ends, end: usize, side: Side) -> OneSided<'a> {
        let mut block = Vec::with_capacity(of.rest.len());
        let mut column = Vec::with_capacity(of.rest.len());
        for &i in &of.rest {
            let row = of.rest.iter().map(|&j| entry(ends, end, side, [i, j]));
            block.push(row.collect());
            column.push(entry(ends, end, side, [i, of.pivot]));
        }

        match side {
            Side::Right => OneSided {
                inverse: of.inverse.clone(),
                block,
                column,
                vector: &of.right,
            },
            Side::Left => OneSided {
                inverse: transposed(&of.inverse),
                block,
                column,
                vector: &of.left,
            },
        }
    }

    /// The largest row sum of Y T' - I, and no less than `least`.
    fn identity_error(&self, least: f64) -> f64 {
        let order = self.block.len();
        let mut largest = least;
        for (i, row) in self.inverse.iter().enumerate() {
            let mut row_sum = 0.0;
            for j in 0..order {
                let target = if i == j { 1.0 } else { 0.0 };
                let mut difference = Ball::exact(-target);
                for k in 0..order {
                    difference.add(row[k], self.block[k][j]);
                }

                row_sum += difference.magnitude();
            }

            largest = largest.max(row_sum);
        }

        largest
    }

    /// The largest component of Y (T_'k + T'v), and no less than `least`.
    fn residual(&self, least: f64) -> f64 {
        let mut product = self.column.clone();
        for (sum, row) in product.iter_mut().zip(&self.block) {
            for (&v, &entry) in self.vector.iter().zip(row) {
                sum.add(v, entry);
            }
        }

        let mut largest = least;
        for row in &self.inverse {
            let mut component = Ball::exact(0.0);
            for (&y, &p) in row.iter().zip(&product) {
                component.add(y, p);
            }

            largest = largest.max(component.magnitude());
        }

        largest
    }
}

/// Entry (i, j) of T, from the left entry (j, i).
fn entry(ends: &Ends, end: usize, side: Side, place: [usize; 2]) -> Ball {
    let [i, j] = match side {
        Side::Right => place,
        Side::Left => [place[1], place[0]],
    };

    Ball {
        center: ends.m[end][i][j],
        radius: ends.radius(i, j),
    }
}
