//! Exact claims: a root of the support's determinant near the candidate, and the kernel there.
//!
//! With x = 0 off the active variables (the free ones and the support), the problem is (24), (25):
//! the active rows and columns of A + tB form a square block, whose determinant vanishes at t and
//! whose kernel holds x. Then (26) asks for x > 0 on the support and y = (A + tB) x >= 0 off it.
//! All of it is decided exactly: t is an algebraic number, and each component of x is a polynomial
//! in t.
//!
//! Input: a candidate in doubles and a support. Output: a claim (`spec/certificates.md`, 5.3) whose
//! value is near the candidate's ([`Candidate::near`]) and whose x is within [`X_RADIUS`] of its x.
//! Called by `proposals`, for supports that are small and pencils whose numbers are short.

use super::failure::AttemptFailure;
use super::lifted;
use super::rows::{IntegralRows, PencilEntry, active};
use crate::candidate::{Candidate, distance, scaled_exactly};
use crate::tolerance::X_RADIUS;
use mceip_check::certificate::ExactSolution;
use mceip_exact::{
    Algebraic, Integer, Interval, Poly, Rational, Sign, cleared, common_denominator, determinant,
    from_f64, generic_kernel, kernel_and_free_columns_at, roots_in, to_f64,
};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use num_integer::Integer as _;
use num_traits::{Signed, Zero};

/// Most halvings of an isolating interval: far beyond any sign the corpus needs.
const MAX_HALVINGS: usize = 4_000;

/// The exact claim with this support whose value is nearest the candidate's.
///
/// # Errors
/// What failed first, at the nearest value that was tried.
pub(super) fn make(
    pencil: &Pencil,
    rows: &IntegralRows,
    window: &Window,
    support: &[usize],
    candidate: &Candidate,
) -> Result<ExactSolution, AttemptFailure> {
    let on_support = TriedSupport {
        pencil,
        rows,
        window,
        support,
        active: active(pencil, support),
        candidate,
    };

    let mut first_failure = None;
    for value in on_support.values_near()? {
        match on_support.claim_at(&value) {
            Ok(claim) => return Ok(claim),
            Err(failure) => first_failure = first_failure.or(Some(failure)),
        }
    }

    Err(first_failure.unwrap_or_else(|| no_root(candidate, window)))
}

/// There is no value near the candidate's in the window.
fn no_root(candidate: &Candidate, window: &Window) -> AttemptFailure {
    let [lo, hi] = candidate.near();
    let min = to_f64(window.min());
    let max = window.max().map_or(f64::INFINITY, to_f64);
    let is_outside = hi < min || lo > max;

    // Beside the window there is nothing to look at: the window itself is named.
    let [lo, hi] = if is_outside {
        [min, max]
    } else {
        [lo.max(min), hi.min(max)]
    };
    AttemptFailure::NoRootNear {
        lo: lo.to_string(),
        hi: hi.to_string(),
    }
}

/// A double as a rational.
fn finite(v: f64) -> Result<Rational, AttemptFailure> {
    from_f64(v).map_err(|_| AttemptFailure::NotFinite)
}

/// A candidate and the support it is tried with.
struct TriedSupport<'a> {
    pencil: &'a Pencil,
    rows: &'a IntegralRows,
    window: &'a Window,
    support: &'a [usize],
    active: Vec<usize>,
    candidate: &'a Candidate,
}

// The values: where the active block is singular.
impl TriedSupport<'_> {
    /// The values near the candidate's at which the support may have a solution, nearest first.
    fn values_near(&self) -> Result<Vec<Algebraic>, AttemptFailure> {
        let a = self.active_block(|entry| &entry.a);
        let b = self.active_block(|entry| &entry.b);
        let determinant = determinant(&[a, b]);

        if determinant.is_zero() {
            self.values_of_singular_pencil()
        } else {
            self.roots_near(&[determinant])
        }
    }

    /// The active rows and columns of A or of B.
    fn active_block(&self, coefficient: fn(&PencilEntry) -> &Integer) -> Vec<Vec<Integer>> {
        let mut block = Vec::new();
        for &i in &self.active {
            let mut row = vec![Integer::zero(); self.active.len()];
            for entry in self.rows.row(i) {
                if let Ok(position) = self.active.binary_search(&entry.column) {
                    row[position] = coefficient(entry).clone();
                }
            }
            block.push(row);
        }

        block
    }

    /// The values to try where the determinant is zero at every t: the candidate's own, moved into
    /// the window, and then those at which a component of x or y may change its sign.
    fn values_of_singular_pencil(&self) -> Result<Vec<Algebraic>, AttemptFailure> {
        let mut own = finite(self.candidate.value)?.max(self.window.min().clone());
        if let Some(max) = self.window.max() {
            own = own.min(max.clone());
        }

        let (kernel, ..) = generic_kernel(self.block(&[]));
        let mut components = Vec::new();
        for vector in &kernel {
            let x = self.spread(vector);
            let y = self.y(&x);
            components.extend(x);
            components.extend(y);
        }

        let mut values = vec![Algebraic::rational(own)];
        values.extend(self.roots_near(&components)?);
        Ok(values)
    }

    /// The roots of some polynomials near the candidate's value and in the window, nearest first.
    fn roots_near(&self, polynomials: &[Poly]) -> Result<Vec<Algebraic>, AttemptFailure> {
        let center = finite(self.candidate.value)?;
        let near = self.candidate.values_near(self.window);
        let [lo, hi] = near.ok_or(AttemptFailure::NotFinite)?;
        if lo > hi {
            return Err(no_root(self.candidate, self.window));
        }

        let mut roots = Vec::new();
        for polynomial in polynomials {
            if !polynomial.is_zero() {
                roots.extend(roots_in(polynomial, &lo, Some(&hi)));
            }
        }

        roots.iter_mut().for_each(narrow);
        roots.sort_by_cached_key(|root| (root.interval().mid() - &center).abs());
        Ok(roots)
    }
}

// The claim at one value.
impl TriedSupport<'_> {
    /// The claim at a value.
    ///
    /// Where the kernel has more than one dimension, y >= 0 may hold in a face y_i = 0 of it only,
    /// which a vector taken from doubles does not hit. So the kernel within y_i = 0 is tried next,
    /// for each i at which y turned out negative.
    ///
    /// # Errors
    /// What failed first.
    fn claim_at(&self, value: &Algebraic) -> Result<ExactSolution, AttemptFailure> {
        let mut faces = Vec::new();
        let mut first_failure = None;

        loop {
            let failure = match self.claim_on_faces(&faces, value.clone()) {
                Ok(claim) => return Ok(claim),
                Err(failure) => failure,
            };
            let new_face = match failure {
                AttemptFailure::YNegative { index } if !faces.contains(&index) => Some(index),
                _ => None,
            };

            let first = first_failure.unwrap_or(failure);
            let Some(index) = new_face else {
                return Err(first);
            };
            first_failure = Some(first);
            faces.push(index);
        }
    }

    /// The claim at a value with a kernel vector for which y vanishes on `faces` too.
    fn claim_on_faces(
        &self,
        faces: &[usize],
        mut value: Algebraic,
    ) -> Result<ExactSolution, AttemptFailure> {
        value.try_rational();
        let x = self.kernel_vector(faces, &mut value)?;
        self.require_positive_x(&x, &mut value)?;

        let y = self.y(&x);
        let biactive = self.biactive(&y, &mut value)?;
        // A test for zero replaces the polynomial of the value by the factor that vanishes there.
        // After these tests each y_i of an active row is 0 modulo it, as the checker asks.
        for &i in &self.active {
            value.sign_of(&y[i]);
        }

        require_near_x(self.candidate, &x, &mut value)?;

        let required = self.required_signs(&x, &y, &biactive);
        required.tighten(&mut value)?;
        Ok(claim(self.support, biactive, &x, &value))
    }

    /// What the checker must see: x_i > 0 on the support, y_i > 0 off it where i is not biactive,
    /// and x != 0.
    fn required_signs<'b>(
        &'b self,
        x: &'b [Poly],
        y: &'b [Poly],
        biactive: &[usize],
    ) -> RequiredSigns<'b> {
        let mut positive = Vec::new();
        for &i in self.support {
            positive.push(&x[i]);
        }

        for i in self.inactive() {
            if !biactive.contains(&i) {
                positive.push(&y[i]);
            }
        }

        // On a support that is not empty x > 0 says that x is not zero.
        let not_all_zero = self.support.is_empty().then_some(x);
        RequiredSigns {
            window: self.window,
            positive,
            not_all_zero,
        }
    }

    /// Demands x_i > 0 on the support.
    fn require_positive_x(&self, x: &[Poly], value: &mut Algebraic) -> Result<(), AttemptFailure> {
        for &index in self.support {
            if value.sign_of(&x[index]) != Sign::Positive {
                return Err(AttemptFailure::XNotPositive { index });
            }
        }

        Ok(())
    }

    /// Demands y_i >= 0 off the support, and lists the i with y_i = 0 there.
    fn biactive(&self, y: &[Poly], value: &mut Algebraic) -> Result<Vec<usize>, AttemptFailure> {
        let mut biactive = Vec::new();
        for index in self.inactive() {
            match value.sign_of(&y[index]) {
                Sign::Negative => return Err(AttemptFailure::YNegative { index }),
                Sign::Zero => biactive.push(index),
                Sign::Positive => {}
            }
        }

        Ok(biactive)
    }

    /// y = (A + tB) x, each row times a positive number.
    fn y(&self, x: &[Poly]) -> Vec<Poly> {
        self.rows.iter().map(|row| times(row, x)).collect()
    }

    /// The complementarity variables off the support, ascending.
    fn inactive(&self) -> impl Iterator<Item = usize> {
        (0..self.pencil.order()).filter(|i| self.active.binary_search(i).is_err())
    }
}

// The kernel of the active block.
impl TriedSupport<'_> {
    /// The rows of the active variables and of `faces`, in the columns of the active ones.
    fn block(&self, faces: &[usize]) -> Vec<Vec<Poly>> {
        let mut block = Vec::new();
        for &i in self.active.iter().chain(faces) {
            let columns = self.active.iter();
            let row = columns.map(|&j| self.entry(i, j)).collect();
            block.push(row);
        }

        block
    }

    /// The entry a + t b of the pencil's integral rows.
    fn entry(&self, row: usize, column: usize) -> Poly {
        let row = self.rows.row(row);
        let entry = row.iter().find(|entry| entry.column == column);
        entry.map_or_else(Poly::default, polynomial)
    }

    /// A vector over the active variables as one over all.
    fn spread(&self, part: &[Poly]) -> Vec<Poly> {
        let mut x = vec![Poly::default(); self.pencil.order()];
        for (&i, component) in self.active.iter().zip(part) {
            x[i] = component.clone();
        }

        x
    }

    /// The kernel vector nearest the candidate: a combination of the basis that has the candidate's
    /// components at the kernel's free coordinates, turned so that its slip part is positive.
    fn kernel_vector(
        &self,
        faces: &[usize],
        value: &mut Algebraic,
    ) -> Result<Vec<Poly>, AttemptFailure> {
        let (basis, free) = kernel_and_free_columns_at(self.block(faces), value);
        if basis.is_empty() {
            // Only faces leave nothing: without them every value that is tried is a root.
            return Err(no_root(self.candidate, self.window));
        }

        // Each basis vector is the same polynomial at its own free coordinate, zero at the others'.
        let weights = self.weights(&free)?;
        let denominator = common_denominator(&weights);
        let mut x = vec![Poly::default(); self.pencil.order()];
        for (vector, weight) in basis.iter().zip(&weights) {
            let factor = cleared(weight, &denominator);
            for (&i, component) in self.active.iter().zip(vector) {
                x[i] = &x[i] + &component.scale(&factor);
            }
        }

        if self.points_away(&x, value) {
            Ok(x.iter().map(|component| -component).collect())
        } else {
            Ok(x)
        }
    }

    /// The weight of each basis vector: 1 for one that is alone, else the candidate's component at
    /// its free coordinate.
    fn weights(&self, free: &[usize]) -> Result<Vec<Rational>, AttemptFailure> {
        if free.len() == 1 {
            return Ok(vec![Rational::from_integer(1.into())]);
        }

        let components = free.iter().map(|&c| self.candidate.x[self.active[c]]);
        components.map(finite).collect()
    }

    /// Is -x the direction that is meant? The first slip variable that moves decides, which must
    /// move forward; without one, x points where the candidate does.
    fn points_away(&self, x: &[Poly], value: &mut Algebraic) -> bool {
        for &i in &self.pencil.slip() {
            match value.sign_of(&x[i]) {
                Sign::Zero => {}
                sign => return sign == Sign::Negative,
            }
        }

        has_negative_product(x, self.candidate, value)
    }
}

/// Is the inner product of x and the candidate's negative? In doubles, x at the middle of the
/// narrowed interval.
fn has_negative_product(x: &[Poly], candidate: &Candidate, value: &mut Algebraic) -> bool {
    narrow(value);
    let mid = value.interval().mid();

    let mut terms = Vec::new();
    for (component, given) in x.iter().zip(&candidate.x) {
        let component = to_f64(&component.eval(&mid));
        terms.push(component * given);
    }

    let product: f64 = terms.iter().sum();
    product < 0.0
}

/// Narrows the interval of a value to 2^-62: its middle may be compared with what the candidate
/// says.
fn narrow(value: &mut Algebraic) {
    let width = Rational::new(1.into(), Integer::from(1u64 << 62));
    value.refine_to(&width);
}

/// Demands that x is the candidate's up to [`X_RADIUS`] ([`distance`]).
fn require_near_x(
    candidate: &Candidate,
    x: &[Poly],
    value: &mut Algebraic,
) -> Result<(), AttemptFailure> {
    narrow(value);
    let mid = value.interval().mid();
    let exact: Vec<Rational> = x.iter().map(|component| component.eval(&mid)).collect();
    let ours = scaled_exactly(&exact).ok_or(AttemptFailure::ZeroX)?;
    let distance = distance(&ours, &candidate.x);
    if distance <= X_RADIUS {
        Ok(())
    } else {
        Err(AttemptFailure::TooFar {
            distance,
            limit: X_RADIUS,
        })
    }
}

/// What the checker must be able to read off the interval of a value by interval arithmetic.
struct RequiredSigns<'a> {
    /// It must hold the interval.
    window: &'a Window,
    /// Polynomials in the value that must be positive.
    positive: Vec<&'a Poly>,
    /// Polynomials in the value of which one must not be zero: x, where the support is empty.
    not_all_zero: Option<&'a [Poly]>,
}

impl RequiredSigns<'_> {
    /// Halves the interval of a value until all that is required can be read off it.
    ///
    /// # Errors
    /// [`AttemptFailure::Precision`] after [`MAX_HALVINGS`], or where the interval is a point: a
    /// sign that is not certain there is zero.
    fn tighten(&self, value: &mut Algebraic) -> Result<(), AttemptFailure> {
        for _ in 0..MAX_HALVINGS {
            if self.are_certain(value) {
                return Ok(());
            }
            if value.interval().is_point() {
                break;
            }
            value.refine();
        }

        Err(AttemptFailure::Precision {
            limit: MAX_HALVINGS,
        })
    }

    /// Does the interval lie in the window, hold one root of the value's polynomial only, and show
    /// every sign?
    fn are_certain(&self, value: &Algebraic) -> bool {
        let interval = value.interval();
        let polynomial = value.poly();

        let slope = interval.horner(&polynomial.derivative());
        if !interval.is_point() && slope.certain_sign() == 0 {
            return false;
        }

        let is_below_max = self.window.max().is_none_or(|max| interval.hi() <= max);
        if interval.lo() < self.window.min() || !is_below_max {
            return false;
        }

        let mut positive = self.positive.iter();
        if !positive.all(|g| certain_sign(interval, polynomial, g) == 1) {
            return false;
        }

        match self.not_all_zero {
            Some(x) => x.iter().any(|g| certain_sign(interval, polynomial, g) != 0),
            None => true,
        }
    }
}

/// The sign of g, reduced modulo the polynomial of the value, all over the interval; 0 where it is
/// not certain.
fn certain_sign(interval: &Interval, polynomial: &Poly, g: &Poly) -> i8 {
    interval.horner(&g.pseudo_rem(polynomial)).certain_sign()
}

/// Puts a claim together: x modulo the polynomial of the value, in integers.
fn claim(support: &[usize], biactive: Vec<usize>, x: &[Poly], value: &Algebraic) -> ExactSolution {
    let polynomial = value.poly();
    let x = x.iter().map(|component| remainder(component, polynomial));
    let x = primitive(x.collect());

    let interval = value.interval();
    ExactSolution {
        support: support.to_vec(),
        biactive,
        polynomial: polynomial.coeffs().to_vec(),
        interval: [Number(interval.lo().clone()), Number(interval.hi().clone())],
        x,
    }
}

/// g mod p over Q.
fn remainder(g: &Poly, p: &Poly) -> Vec<Rational> {
    lifted::remainder(coefficients(g), &coefficients(p))
}

/// The coefficients of a polynomial, the constant first.
fn coefficients(p: &Poly) -> Vec<Rational> {
    let integers = p.coeffs().iter().cloned();
    integers.map(Rational::from_integer).collect()
}

/// All components times one positive rational that makes them integers without a common factor.
fn primitive(x: Vec<Vec<Rational>>) -> Vec<Vec<Number>> {
    let denominator = common_denominator(x.iter().flatten());
    let mut divisor = Integer::zero();
    for coefficient in x.iter().flatten() {
        divisor = divisor.gcd(&cleared(coefficient, &denominator));
    }

    let factor = if divisor.is_zero() {
        Rational::from_integer(denominator)
    } else {
        Rational::new(denominator, divisor)
    };
    let mut scaled = Vec::new();
    for component in x {
        scaled.push(component.into_iter().map(|c| Number(c * &factor)).collect());
    }

    scaled
}

/// A row of (A + tB) x.
fn times(row: &[PencilEntry], x: &[Poly]) -> Poly {
    let mut sum = Poly::default();
    for entry in row {
        sum += &(&polynomial(entry) * &x[entry.column]);
    }

    sum
}

/// a + t b.
fn polynomial(entry: &PencilEntry) -> Poly {
    Poly::new(vec![entry.a.clone(), entry.b.clone()])
}

#[cfg(test)]
mod tests;
