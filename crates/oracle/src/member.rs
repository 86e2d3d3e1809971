//! "Is this (t, x) a solution?", "is it in this answer?", and equality of answers.
//!
//! All three are decided by signs of integer polynomials at algebraic numbers: of x_i and of
//! y_i = ((A + tB) x)_i, of a quadratic pencil ((A + tB + t^2 C) x)_i, against the definition
//! (12)-(14), (21)-(23), and of 2 x 2 minors of two vectors that may be one ray.
//!
//! Nothing here enumerates: the question whether (t, x) is a solution is answered from the matrices
//! as they are given alone. Called by tests of everything that claims a solution.

use super::degenerate::constants;
use super::degenerate::{Cone, End, SupportRange, ValueInterval};
use super::enumeration::Enumeration;
use super::solution::Solution;
use super::solution::equal_values;
use mceip_exact::{Algebraic, Poly, Rational, Sign, Sparse, cleared, common_denominator};
use mceip_model::{Body, Pencil, Problem, QuadraticPencil, Reduced, Unknown};

/// A pencil as it is given: what (t, x) is held against.
pub struct GivenPencil<'a> {
    /// The coefficients of 1, t and, of a quadratic pencil, t^2.
    coefficients: Vec<&'a Sparse>,
    free: &'a [usize],
    /// Are solutions with t < 0 asked for?
    has_both_signs: bool,
}

impl<'a> From<&'a Pencil> for GivenPencil<'a> {
    fn from(pencil: &'a Pencil) -> Self {
        GivenPencil {
            coefficients: vec![pencil.a(), pencil.b()],
            free: pencil.free(),
            has_both_signs: false,
        }
    }
}

impl<'a> From<&'a QuadraticPencil> for GivenPencil<'a> {
    fn from(quadratic: &'a QuadraticPencil) -> Self {
        GivenPencil {
            coefficients: quadratic.coefficients().into(),
            free: &[],
            has_both_signs: false,
        }
    }
}

impl<'a> GivenPencil<'a> {
    /// Of a problem: a quadratic pencil as it is given, else the reduced pencil; with t of both
    /// signs for the unknown `eigenvalue`.
    ///
    /// ```
    /// use mceip_exact::{Sparse, whole};
    /// use mceip_model::reduction::reduce;
    /// use mceip_model::{Body, Pencil, Problem, Unknown, Window};
    /// use mceip_oracle::{GivenPencil, is_rational_solution};
    /// let pencil = Pencil::new(Sparse::from_ints(&[&[2]]), Sparse::identity(1), vec![])?;
    /// for (unknown, has_it) in [(Unknown::Eigenvalue, true), (Unknown::Lambda2, false)] {
    ///     let body = Body::Pencil(pencil.clone());
    ///     let problem = Problem::new(body, unknown, Window::all())?;
    ///     let reduced = reduce(&problem)?;
    ///     let given = GivenPencil::of(&problem, &reduced);
    ///     assert_eq!(is_rational_solution(given, &whole(-2), &[whole(1)]), has_it);
    /// }
    /// # Ok::<(), mceip_model::ModelError>(())
    /// ```
    pub fn of(problem: &'a Problem, reduced: &'a Reduced) -> GivenPencil<'a> {
        let pencil = match problem.body() {
            Body::Quadratic(quadratic) => GivenPencil::from(quadratic),
            Body::Pencil(_) | Body::System(_) => GivenPencil::from(&reduced.pencil),
        };
        GivenPencil {
            has_both_signs: problem.unknown() == Unknown::Eigenvalue,
            ..pencil
        }
    }
}

impl GivenPencil<'_> {
    /// Number of variables.
    pub fn order(&self) -> usize {
        self.coefficients[0].rows()
    }

    /// A positive multiple of y_i, row i of (A + tB + ...) x.
    fn image(&self, i: usize, x: &[Poly]) -> Poly {
        let rows = || self.coefficients.iter().map(|matrix| matrix.row(i));
        let clear = common_denominator(rows().flatten().map(|(_, entry)| entry));

        let mut sum = Poly::default();
        for (power, row) in rows().enumerate() {
            for (j, entry) in row {
                sum += &x[*j].scale(&cleared(entry, &clear)).shift(power);
            }
        }

        sum
    }
}

/// Is (t, x) a solution: x != 0, y = (A + tB) x with y_f = 0 and 0 <= x_s _|_ y_s >= 0, and t >= 0
/// unless values of both signs are asked for ([`GivenPencil::of`])?
/// x is given by integer polynomials at t, up to a positive factor. The window plays no part.
///
/// A vector of another length than the pencil's order is no solution.
///
/// ```
/// use mceip_exact::{Sparse, rational, whole};
/// use mceip_model::Pencil;
/// use mceip_oracle::is_rational_solution;
/// let pencil = Pencil::new(
///     Sparse::from_ints(&[&[1, -6], &[2, -6]]),
///     Sparse::identity(2),
///     vec![],
/// )
/// .unwrap();
/// assert!(is_rational_solution(
///     &pencil,
///     &whole(2),
///     &[whole(2), whole(1)]
/// ));
/// assert!(!is_rational_solution(
///     &pencil,
///     &rational(2001, 1000),
///     &[whole(2), whole(1)]
/// ));
/// ```
pub fn is_solution<'a>(pencil: impl Into<GivenPencil<'a>>, value: &Algebraic, x: &[Poly]) -> bool {
    Signs::of(&pencil.into(), value, x).is_some_and(|signs| signs.is_solution)
}

/// [`is_solution`] for a rational value and vector.
pub fn is_rational_solution<'a>(
    pencil: impl Into<GivenPencil<'a>>,
    value: &Rational,
    x: &[Rational],
) -> bool {
    is_solution(pencil, &Algebraic::rational(value.clone()), &constants(x))
}

/// The signs of x and y at the complementarity variables, and what follows from all signs.
struct Signs {
    /// Complementarity variables with x_i > 0, ascending.
    positive_x: Vec<usize>,
    /// Complementarity variables with y_i = 0, ascending.
    zero_y: Vec<usize>,
    /// Does the definition hold?
    is_solution: bool,
}

impl Signs {
    /// `None` for a vector of another length than the pencil's order, and for t < 0 that is not
    /// asked for.
    fn of(pencil: &GivenPencil<'_>, value: &Algebraic, x: &[Poly]) -> Option<Signs> {
        let mut value = value.clone();
        let is_negative = value.cmp_rational(&Rational::default()).is_lt();
        if x.len() != pencil.order() || is_negative && !pencil.has_both_signs {
            return None;
        }

        let mut positive_x = Vec::new();
        let mut zero_y = Vec::new();
        let mut conditions_hold = true;
        let mut is_zero_vector = true;

        for i in 0..pencil.order() {
            let sign_x = value.sign_of(&x[i]);
            let sign_y = value.sign_of(&pencil.image(i, x));
            is_zero_vector &= sign_x == Sign::Zero;

            if pencil.free.binary_search(&i).is_ok() {
                conditions_hold &= sign_y == Sign::Zero; // (13), (22)
                continue;
            }

            // (14), (23): both nonnegative, at least one of them zero.
            conditions_hold &= sign_x != Sign::Negative && sign_y != Sign::Negative;
            conditions_hold &= sign_x == Sign::Zero || sign_y == Sign::Zero;
            if sign_x == Sign::Positive {
                positive_x.push(i);
            }
            if sign_y == Sign::Zero {
                zero_y.push(i);
            }
        }

        Some(Signs {
            positive_x,
            zero_y,
            is_solution: conditions_hold && !is_zero_vector,
        })
    }
}

impl Enumeration {
    /// Does this answer hold the solution (t, x)? True exactly if (t, x) solves the pencil *and* is
    /// listed, lies in a cone, or has its value in the range of its support. For a complete
    /// enumeration of `pencil` that is every solution in the window.
    pub fn contains<'a>(
        &self,
        pencil: impl Into<GivenPencil<'a>>,
        value: &Algebraic,
        x: &[Poly],
    ) -> bool {
        let Some(signs) = Signs::of(&pencil.into(), value, x) else {
            return false;
        };

        signs.is_solution
            && (self.lists(&signs, value, x)
                || self.has_cone_with(&signs, value)
                || self.has_range_with(&signs, value))
    }

    fn lists(&self, signs: &Signs, value: &Algebraic, x: &[Poly]) -> bool {
        self.solutions.iter().any(|solution| {
            solution.slip == signs.positive_x
                && equal_values(&solution.value, value)
                && same_ray(&solution.value, &solution.x, x)
        })
    }

    /// A solution is in a cone exactly if x = 0 off the cone's support and y = 0 on it.
    fn has_cone_with(&self, signs: &Signs, value: &Algebraic) -> bool {
        self.cones.iter().any(|cone| {
            signs.positive_x.iter().all(|i| cone.slip.contains(i))
                && cone.slip.iter().all(|i| signs.zero_y.contains(i))
                && equal_values(&cone.value, value)
        })
    }

    fn has_range_with(&self, signs: &Signs, value: &Algebraic) -> bool {
        self.ranges
            .iter()
            .any(|range| range.support == signs.positive_x && range.contains(value))
    }
}

/// Do two non-zero vectors u and v agree up to a positive factor?
///
/// With u_k != 0 they do exactly if u_k v_i = u_i v_k for all i, and u_k and v_k have one sign.
fn same_ray(value: &Algebraic, u: &[Poly], v: &[Poly]) -> bool {
    let mut value = value.clone();
    if u.len() != v.len() {
        return false;
    }

    let Some(k) = (0..u.len()).find(|&k| value.sign_of(&u[k]) != Sign::Zero) else {
        return false;
    };

    for i in 0..u.len() {
        let minor = &(&u[k] * &v[i]) - &(&u[i] * &v[k]);
        if value.sign_of(&minor) != Sign::Zero {
            return false;
        }
    }

    value.sign_of(&u[k]) == value.sign_of(&v[k])
}

/// Equal values, supports and rays; x and y count up to the positive factor they share.
impl PartialEq for Solution {
    fn eq(&self, other: &Solution) -> bool {
        self.slip == other.slip
            && self.biactive == other.biactive
            && self.x.len() == other.x.len()
            && equal_values(&self.value, &other.value)
            && same_ray(&self.value, &self.x, &other.x)
    }
}

/// Equal as sets: values, supports, rays and lineality spaces, whose forms are canonical.
impl PartialEq for Cone {
    fn eq(&self, other: &Cone) -> bool {
        self.slip == other.slip
            && self.biactive == other.biactive
            && self.dimension == other.dimension
            && self.lineality.len() == other.lineality.len()
            && equal_values(&self.value, &other.value)
            && self.rays == other.rays
            && self
                .lineality
                .iter()
                .zip(&other.lineality)
                .all(|(own, others)| same_ray(&self.value, own, others))
    }
}

impl PartialEq for End {
    fn eq(&self, other: &End) -> bool {
        let is_same_kind = self.included == other.included;
        is_same_kind && equal_values(&self.value, &other.value)
    }
}

impl PartialEq for ValueInterval {
    fn eq(&self, other: &ValueInterval) -> bool {
        let is_same_beginning = self.from == other.from;
        is_same_beginning && self.to == other.to
    }
}

/// Equal supports and values; the kernel is a description, not compared.
impl PartialEq for SupportRange {
    fn eq(&self, other: &SupportRange) -> bool {
        self.support == other.support && self.pieces == other.pieces
    }
}

/// Equal answers: solutions, cones, ranges and what is undescribed. How many supports were examined
/// and which wide kernels and singular supports were met on the way is no part of the answer.
impl PartialEq for Enumeration {
    fn eq(&self, other: &Enumeration) -> bool {
        self.solutions == other.solutions
            && self.cones == other.cones
            && self.ranges == other.ranges
            && self.undescribed == other.undescribed
    }
}
