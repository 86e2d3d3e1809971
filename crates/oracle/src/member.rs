//! "Is this (t, x) a solution?", and equality of answers: both by exact signs alone.

use super::degenerate::{Cone, End, Piece, SupportRange, constants};
use super::enumeration::Enumeration;
use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Rational, Sign, Sparse, common_denominator};
use mceip_model::Pencil;

/// Is (t, x) a solution: t >= 0, x != 0, y = (A + tB) x with y_f = 0 and 0 <= x_s _|_ y_s >= 0?
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
pub fn is_solution(pencil: &Pencil, value: &Algebraic, x: &[Poly]) -> bool {
    Signs::of(pencil, value, x).is_some_and(|s| s.solves)
}

/// [`is_solution`] for a rational value and vector.
pub fn is_rational_solution(pencil: &Pencil, value: &Rational, x: &[Rational]) -> bool {
    is_solution(pencil, &Algebraic::rational(value.clone()), &constants(x))
}

/// Where x is positive and y vanishes, and whether the definition holds.
struct Signs {
    positive: Vec<usize>,
    y_zero: Vec<usize>,
    solves: bool,
}

impl Signs {
    fn of(pencil: &Pencil, value: &Algebraic, x: &[Poly]) -> Option<Signs> {
        if x.len() != pencil.order() || value.clone().cmp_rational(&Rational::default()).is_lt() {
            return None;
        }
        let mut value = value.clone();
        let mut signs = Signs {
            positive: Vec::new(),
            y_zero: Vec::new(),
            solves: false,
        };
        let (mut holds, mut zero) = (true, true);
        for i in 0..pencil.order() {
            let (s_x, s_y) = (value.sign_of(&x[i]), value.sign_of(&image(pencil, i, x)));
            zero &= s_x == Sign::Zero;
            if pencil.free().binary_search(&i).is_ok() {
                holds &= s_y == Sign::Zero;
                continue;
            }
            holds &= matches!(
                (s_x, s_y),
                (Sign::Zero, Sign::Zero | Sign::Positive) | (Sign::Positive, Sign::Zero)
            );
            signs.positive.extend((s_x == Sign::Positive).then_some(i));
            signs.y_zero.extend((s_y == Sign::Zero).then_some(i));
        }
        signs.solves = holds && !zero;
        Some(signs)
    }
}

/// A positive multiple of row i of (A + tB) x.
fn image(pencil: &Pencil, i: usize, x: &[Poly]) -> Poly {
    let row = |m: &Sparse| m.row(i).to_vec();
    let (a, b) = (row(pencil.a()), row(pencil.b()));
    let clear = common_denominator(a.iter().chain(&b).map(|e| &e.1));
    let term = |(j, v): &(usize, Rational), power: usize| {
        x[*j]
            .scale(&(v.numer() * (&clear / v.denom())))
            .shift(power)
    };
    let terms = a
        .iter()
        .map(|e| term(e, 0))
        .chain(b.iter().map(|e| term(e, 1)));
    terms.fold(Poly::default(), |sum, p| &sum + &p)
}

impl Enumeration {
    /// Does this answer hold the solution (t, x)? True exactly if (t, x) solves the pencil *and* is
    /// listed, lies in a cone, or has its value in the range of its support. For a complete
    /// enumeration of `pencil` that is every solution in the window.
    pub fn contains(&self, pencil: &Pencil, value: &Algebraic, x: &[Poly]) -> bool {
        let Some(signs) = Signs::of(pencil, value, x).filter(|s| s.solves) else {
            return false;
        };
        let at = |v: &Algebraic| v.clone().equals(&mut value.clone());
        let subset = |a: &[usize], b: &[usize]| a.iter().all(|i| b.contains(i));
        self.solutions.iter().any(|s| {
            s.slip == signs.positive && at(&s.value) && same_ray(&mut s.value.clone(), &s.x, x)
        }) || self.cones.iter().any(|c| {
            subset(&signs.positive, &c.slip) && subset(&c.slip, &signs.y_zero) && at(&c.value)
        }) || self
            .ranges
            .iter()
            .any(|r| r.support == signs.positive && r.contains(value))
    }
}

/// Do two non-zero vectors agree up to a positive factor?
fn same_ray(value: &mut Algebraic, u: &[Poly], v: &[Poly]) -> bool {
    let Some(k) = (0..u.len()).find(|&k| value.sign_of(&u[k]) != Sign::Zero) else {
        return false;
    };
    let parallel =
        (0..u.len()).all(|i| value.sign_of(&(&(&u[k] * &v[i]) - &(&u[i] * &v[k]))) == Sign::Zero);
    u.len() == v.len() && parallel && value.sign_of(&u[k]) == value.sign_of(&v[k])
}

/// Equal values, supports and rays; x and y count up to the positive factor they share.
impl PartialEq for Solution {
    fn eq(&self, other: &Solution) -> bool {
        (&self.slip, &self.biactive, self.x.len()) == (&other.slip, &other.biactive, other.x.len())
            && self.value.clone().equals(&mut other.value.clone())
            && same_ray(&mut self.value.clone(), &self.x, &other.x)
    }
}

/// Equal as sets: values, supports, rays and lineality spaces, whose forms are canonical.
impl PartialEq for Cone {
    fn eq(&self, other: &Cone) -> bool {
        (
            &self.slip,
            &self.biactive,
            self.dimension,
            self.lineality.len(),
        ) == (
            &other.slip,
            &other.biactive,
            other.dimension,
            other.lineality.len(),
        ) && self.value.clone().equals(&mut other.value.clone())
            && self.rays == other.rays
            && self
                .lineality
                .iter()
                .zip(&other.lineality)
                .all(|(a, b)| same_ray(&mut self.value.clone(), a, b))
    }
}

impl PartialEq for End {
    fn eq(&self, other: &End) -> bool {
        self.included == other.included && self.value.clone().equals(&mut other.value.clone())
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Piece) -> bool {
        self.from == other.from && self.to == other.to
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
        (&self.solutions, &self.cones) == (&other.solutions, &other.cones)
            && (&self.ranges, &self.undescribed) == (&other.ranges, &other.undescribed)
    }
}
