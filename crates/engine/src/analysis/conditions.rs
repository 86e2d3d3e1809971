//! The necessary conditions (19), (20) and the sufficient condition (17)-(18), decided exactly.
//!
//! The smallest eigenvalue of the symmetric part of K* = K0 + mu K1 is a concave function of mu. So
//! where K0 is positive definite, the mu >= 0 at which K* is so form an interval from 0. The same
//! holds of M* = M0 + mu M1. (Only K_ff has to be definite. Where K0 is not, K* may be so on an
//! interval of larger mu: it is decided for one mu where it is asked for.) Divergence needs that K*
//! is not positive definite or M* not positive semidefinite (19), so it is excluded up to the end
//! of the shorter of the two intervals. Where M1 = 0 only K* counts (20).
//!
//! The end of an interval is the smallest positive root of det(A + mu B) with A, B the symmetric
//! parts. For small orders it is found as that root; otherwise doubles propose it and the null
//! vector there, an exact proof shows definiteness just before it, and the vector refutes it just
//! after it. As B has few rows, the variables beside them are eliminated once (`eliminated`).
//!
//! At lambda = 0 the free variables can be eliminated first: T(mu) = S + mu R_c, the matrix of
//! MCEIP-mu over the slip variables (T(0, mu) of `spec/reduction.md`, 2.3). A solution (mu, x) has
//! x'T(mu) x = 0 with x != 0, so there is none where the symmetric part of T is positive definite:
//! on an interval from 0 again, which contains that of K* ([`condensed`]). With lambda^2 > 0 the
//! matrix is another one, and nothing follows.
//!
//! Input: K* and M* as linear functions of mu ([`MuFamily`]). Output: [`Necessary`] and, of the
//! condensed form, a [`DefiniteUntil`]. Called by [`analyse`](super::analyse) and by the loading
//! path of `mceip block`.

use super::eliminated::Eliminated;
use crate::reduction::condense;
use crate::search::complete::pieces::skyline::Skyline;
use crate::tolerance::{BRACKET_BITS, BRACKET_START_BITS};
use mceip_exact::{
    Algebraic, DefiniteError, Dense, Integer, Interval, Rational, Sparse, common_denominator,
    determinant, from_f64, positive_definite, rational, roots_in, to_f64,
};
use mceip_model::{Admissible, ModelError, MuFamily, Pencil, Unknown, Window};
use mceip_oracle::{Enumeration, Solution, examine_support};
use num_traits::{One, Signed, Zero};

/// Up to which mu the symmetric part of A + mu B is positive definite, from mu = 0 on.
#[derive(Debug, Clone)]
pub enum DefiniteUntil {
    /// Not at mu = 0; it may be so for larger mu. The symmetric parts of A and B.
    NotAtZero(Box<[Sparse; 2]>),
    /// For every mu >= 0: A is positive definite and B positive semidefinite.
    Always,
    /// Exactly for 0 <= mu < end; at the end the matrix is semidefinite, beyond it is not.
    End {
        /// Encloses the end: proved definite at its lower end, proved not definite at its upper.
        end: Interval,
        /// The end as the root of a polynomial, for small orders.
        exact: Option<Box<Algebraic>>,
    },
}

/// Largest order for which the end is given as the root of a determinant.
const EXACT_ORDER: usize = 10;

/// Largest order of which no variable is eliminated: exact minors decide.
const ELIMINATED_ORDER: usize = 48;

/// The end is looked for between 2^-this and 2^this.
const END_EXPONENT: i32 = 64;

/// Halvings of the interval of the end: to the rounding of doubles.
const HALVINGS_OF_END: usize = 52;

/// Inverse iterations next to the end, where the null vector outweighs all others, and the bits to
/// which it is rounded.
const STEPS_TO_NULL_VECTOR: usize = 4;
const BITS_OF_NULL_VECTOR: i32 = 40;

impl DefiniteUntil {
    /// Encloses the end of the interval; `None` where there is no end.
    pub fn end(&self) -> Option<&Interval> {
        match self {
            DefiniteUntil::End { end, .. } => Some(end),
            _ => None,
        }
    }

    /// Decides definiteness of sym(A + mu B) for all mu >= 0, exactly; doubles only propose the
    /// end.
    ///
    /// # Errors
    /// [`ModelError::DefinitenessUndecided`] for a matrix of order above 48 too close to singular.
    ///
    /// ```
    /// use mceip_engine::analysis::conditions::DefiniteUntil;
    /// use mceip_exact::{Sparse, whole};
    /// // [1, mu; mu, 1] is definite below mu = 1.
    /// let b = Sparse::from_ints(&[&[0, 2], &[0, 0]]);
    /// let until = DefiniteUntil::of("K*", &Sparse::identity(2), &b).unwrap();
    /// assert!(until.end().unwrap().contains(&whole(1)));
    /// ```
    pub fn of(what: &'static str, a: &Sparse, b: &Sparse) -> Result<DefiniteUntil, ModelError> {
        let in_rows_of_b = (0..b.rows()).filter(|&i| !b.row(i).is_empty()).collect();
        let a = symmetric_part(a);
        let b = symmetric_part(b);
        if !is_definite(what, &a)? {
            return Ok(DefiniteUntil::NotAtZero(Box::new([a, b])));
        }

        if is_semidefinite(&b) {
            return Ok(DefiniteUntil::Always);
        }

        if a.rows() <= EXACT_ORDER
            && let Some(end) = smallest_root(&a, &b)
        {
            return Ok(DefiniteUntil::of_root(end));
        }

        bracket(what, &a, &b, in_rows_of_b)
    }

    /// The interval that ends at a root, which is enclosed to 2^-64 of its value.
    fn of_root(mut end: Algebraic) -> DefiniteUntil {
        end.try_rational();
        let parts = Rational::from_integer(Integer::one() << BRACKET_BITS);
        let width = end.interval().hi() / parts;
        end.refine_to(&width);

        DefiniteUntil::End {
            end: end.interval().clone(),
            exact: Some(Box::new(end)),
        }
    }

    /// mu up to which (this value not included) the matrix is proved definite; `None` if for all
    /// mu.
    fn proved_below(&self) -> Option<Rational> {
        match self {
            DefiniteUntil::NotAtZero(_) => Some(Rational::zero()),
            DefiniteUntil::Always => None,
            DefiniteUntil::End { end, .. } => Some(end.lo().clone()),
        }
    }
}

/// (A + A') / 2.
fn symmetric_part(a: &Sparse) -> Sparse {
    let half = rational(1, 2);
    Sparse::zeros(a.rows(), a.cols())
        .add_scaled(&half, a)
        .add_scaled(&half, &a.transpose())
}

/// Is a symmetric matrix positive definite? `what` names it in the error.
fn is_definite(what: &'static str, matrix: &Sparse) -> Result<bool, ModelError> {
    match positive_definite(matrix) {
        Ok(()) => Ok(true),
        Err(DefiniteError::Not(_)) => Ok(false),
        Err(DefiniteError::Undecided { index }) => Err(ModelError::DefinitenessUndecided {
            equation: "E19",
            what,
            index,
        }),
    }
}

/// Is a symmetric matrix positive semidefinite? By LDL' in fractions, in which no pivot may be
/// negative and a zero pivot must have a zero row.
fn is_semidefinite(matrix: &Sparse) -> bool {
    // A zero on the diagonal beside something else refutes at once; zero rows drop out.
    let order = matrix.rows();
    let mut rows = Vec::new();
    for i in 0..order {
        if matrix.row(i).is_empty() {
            continue;
        }
        if matrix.get(i, i).is_zero() {
            return false;
        }
        rows.push(i);
    }

    let mut rest = matrix.submatrix(&rows, &rows).to_dense();
    for k in 0..rows.len() {
        let pivot = rest[(k, k)].clone();
        let row_is_zero = (k..rows.len()).all(|j| rest[(k, j)].is_zero());
        if pivot.is_negative() || (pivot.is_zero() && !row_is_zero) {
            return false;
        }
        eliminate(&mut rest, k);
    }

    true
}

/// Takes multiples of row k off the rows below it, so that column k vanishes there. The pivot may
/// be zero only if that column is zero already.
fn eliminate(matrix: &mut Dense, k: usize) {
    let order = matrix.rows();
    for i in k + 1..order {
        if matrix[(i, k)].is_zero() {
            continue;
        }
        let factor = &matrix[(i, k)] / &matrix[(k, k)];
        for j in k + 1..order {
            let update = &factor * &matrix[(k, j)];
            matrix[(i, j)] -= update;
        }
    }
}

/// The smallest positive root of det(A + mu B), A definite: there definiteness ends.
fn smallest_root(a: &Sparse, b: &Sparse) -> Option<Algebraic> {
    let entries = a.entries().chain(b.entries());
    let scale = Rational::from_integer(common_denominator(entries.map(|(_, _, v)| v)));
    let polynomial = determinant(&[integral(a, &scale), integral(b, &scale)]);

    let roots = roots_in(&polynomial, &Rational::zero(), None);
    roots.into_iter().next()
}

/// The entries of `scale` A by rows, which are integers.
fn integral(a: &Sparse, scale: &Rational) -> Vec<Vec<Integer>> {
    let mut rows = vec![vec![Integer::zero(); a.cols()]; a.rows()];
    for (i, j, v) in a.entries() {
        rows[i][j] = (v * scale).to_integer();
    }

    rows
}

/// The end between a value at which definiteness is proved and one at which a vector refutes it.
/// Beside the variables `kept` B is zero.
fn bracket(
    what: &'static str,
    a: &Sparse,
    b: &Sparse,
    kept: Vec<usize>,
) -> Result<DefiniteUntil, ModelError> {
    match enclosed_end(a, b, &kept) {
        Some(end) => Ok(DefiniteUntil::End { end, exact: None }),
        None => Err(ModelError::DefinitenessUndecided {
            equation: "E19",
            what,
            index: 0,
        }),
    }
}

fn enclosed_end(a: &Sparse, b: &Sparse, kept: &[usize]) -> Option<Interval> {
    let hi = refuted_from(a, b)?;
    let directly = |mu: &Rational| positive_definite(&a.add_scaled(mu, b)).is_ok();

    let eliminated = if a.rows() > ELIMINATED_ORDER {
        Eliminated::of(a, b, kept)
    } else {
        None
    };
    let condensed = eliminated.and_then(|e| proved_before(&hi, &|mu| e.is_definite_at(mu)));

    let lo = condensed.or_else(|| proved_before(&hi, &directly))?;
    Interval::new(lo, hi)
}

/// A mu at which A + mu B is not definite, next to the end. Doubles propose x near the null vector
/// there; exactly, x'(A + mu B)x <= 0 from mu = -x'Ax / x'Bx on, which exceeds the end by the
/// square of the error of x.
fn refuted_from(a: &Sparse, b: &Sparse) -> Option<Rational> {
    let x = near_null_vector(a, b)?;
    let of_a = quadratic_form(a, &x);
    let of_b = quadratic_form(b, &x);
    if !of_b.is_negative() {
        return None;
    }

    let end = -(&of_a / &of_b);
    let mu = from_f64(to_f64(&end) * (1.0 + f64::EPSILON * 4.0)).ok()?;
    let is_refuted = !(of_a + &mu * of_b).is_positive();
    (is_refuted && mu.is_positive()).then_some(mu)
}

/// A vector in doubles, rounded to integers, near the null vector of A + mu B where definiteness
/// ends: by inverse iteration at the last mu with a Cholesky factor.
///
/// That mu is found by halving, first of the powers of two. `None` where no end is found.
fn near_null_vector(a: &Sparse, b: &Sparse) -> Option<Vec<Rational>> {
    let a = Skyline::symmetric(a);
    let b = Skyline::symmetric(b);
    let is_definite = |mu: f64| a.combine(mu, &b).cholesky().is_some();

    // A is definite, so the powers of two at which A + mu B is so are the lowest ones.
    let powers: Vec<f64> = (-END_EXPONENT..=END_EXPONENT)
        .map(|k| f64::from(k).exp2())
        .collect();
    let definite = powers.partition_point(|mu| is_definite(*mu));
    let mut below = powers[definite.checked_sub(1)?];
    let mut above = 2.0 * below;

    for _ in 0..HALVINGS_OF_END {
        let middle = 0.5 * (below + above);
        if is_definite(middle) {
            below = middle;
        } else {
            above = middle;
        }
    }

    let factor = a.combine(below, &b).cholesky()?;
    let mut vector = factor.without_symmetry();
    for _ in 0..STEPS_TO_NULL_VECTOR {
        factor.solve(&mut vector);
        let largest = vector.iter().fold(0.0f64, |s, v| s.max(v.abs()));
        vector.iter_mut().for_each(|v| *v /= largest);
    }

    let unit = f64::from(BITS_OF_NULL_VECTOR).exp2();
    let rounded = vector
        .into_iter()
        .map(|v| from_f64((v * unit).round()).ok());
    rounded.collect()
}

/// x'Mx.
fn quadratic_form(m: &Sparse, x: &[Rational]) -> Rational {
    let mut sum = Rational::zero();
    for (i, j, entry) in m.entries() {
        sum += entry * (&x[i] * &x[j]);
    }

    sum
}

/// The value nearest below a mu, among steps that grow by 4, at which definiteness is proved.
fn proved_before(end: &Rational, is_proved: &dyn Fn(&Rational) -> bool) -> Option<Rational> {
    let below = |step: Rational| shorten(&(end * (Rational::one() - step)));
    let mut tried = steps().map(below);
    tried.find(|mu| !mu.is_negative() && is_proved(mu))
}

/// The value nearest above a mu, among the same steps, at which definiteness is refuted.
fn refuted_after(end: &Rational, is_refuted: &dyn Fn(&Rational) -> bool) -> Option<Rational> {
    let above = |step: Rational| shorten(&(end * (Rational::one() + step)));
    let mut tried = steps().map(above);
    tried.find(|mu| is_refuted(mu))
}

/// Shares of an end, from the smallest to 1, each four times the one before.
fn steps() -> impl Iterator<Item = Rational> {
    let bits = (0..=BRACKET_START_BITS / 2).map(|k| BRACKET_START_BITS - 2 * k);
    bits.map(|bits| Rational::new(Integer::one(), Integer::one() << bits))
}

/// The same number to a double's digits: short numbers keep LDL' cheap.
fn shorten(v: &Rational) -> Rational {
    from_f64(to_f64(v)).unwrap_or_else(|_| v.clone())
}

/// From which mu the necessary condition (19), (20) for divergence holds.
#[derive(Debug, Clone)]
pub struct Necessary {
    /// Where K* is positive definite.
    pub stiffness: DefiniteUntil,
    /// Where M* is positive definite (semidefinite at the end); `None` without a mass.
    pub mass: Option<DefiniteUntil>,
    /// Does M* not depend on mu (M1 = 0)? Then (20) stands in place of (19).
    pub mass_is_constant: bool,
}

impl Necessary {
    /// Decides it for all mu >= 0.
    ///
    /// # Errors
    /// As [`DefiniteUntil::of`].
    pub fn of(family: &MuFamily) -> Result<Necessary, ModelError> {
        let k = &family.stiffness;
        let mass = family.mass.as_ref();
        let (of_stiffness, of_mass) = rayon::join(
            || DefiniteUntil::of("K*", k.a(), k.b()),
            || mass.map(|m| DefiniteUntil::of("M*", m.a(), m.b())),
        );

        Ok(Necessary {
            stiffness: of_stiffness?,
            mass: of_mass.transpose()?,
            mass_is_constant: mass.is_some_and(|m| m.b().entries().next().is_none()),
        })
    }

    /// Does the condition hold at this mu: may there be divergence? `None` if mu lies inside the
    /// enclosure of an end that is not known exactly, or the matrix is too close to a singular one.
    pub fn holds_at(&self, mu: &Rational) -> Option<bool> {
        let stiffness_not_definite = past(&self.stiffness, mu, false);
        let mass_not_semidefinite = match &self.mass {
            Some(mass) => past(mass, mu, true),
            None => Some(false),
        };

        // "Or" of two answers, each of which may be undecided.
        if stiffness_not_definite == Some(true) || mass_not_semidefinite == Some(true) {
            Some(true)
        } else if stiffness_not_definite.is_none() || mass_not_semidefinite.is_none() {
            None
        } else {
            Some(false)
        }
    }

    /// mu up to which (this value not included) divergence is excluded by the condition; `None` if
    /// for all mu.
    pub fn excluded_below(&self) -> Option<Rational> {
        let stiffness = self.stiffness.proved_below();
        let mass = self.mass.as_ref().and_then(DefiniteUntil::proved_below);
        match (stiffness, mass) {
            (Some(k), Some(m)) => Some(k.min(m)),
            (k, m) => k.or(m),
        }
    }
}

/// Has definiteness ended at mu? `open`: the end itself does not count (semidefinite is enough).
fn past(until: &DefiniteUntil, mu: &Rational, open: bool) -> Option<bool> {
    match until {
        DefiniteUntil::NotAtZero(parts) => not_definite_at(parts, mu, open),
        DefiniteUntil::Always => Some(false),
        DefiniteUntil::End {
            exact: Some(end), ..
        } => {
            let order = end.clone().cmp_rational(mu);
            Some(if open { order.is_lt() } else { order.is_le() })
        }
        DefiniteUntil::End { end, exact: None } => {
            if mu <= end.lo() {
                Some(false)
            } else if mu > end.hi() || (!open && mu == end.hi()) {
                Some(true)
            } else {
                None
            }
        }
    }
}

/// Is A + mu B not positive definite, or where `open` not positive semidefinite?
fn not_definite_at([a, b]: &[Sparse; 2], mu: &Rational, open: bool) -> Option<bool> {
    let matrix = a.add_scaled(mu, b);
    match positive_definite(&matrix) {
        Ok(()) => Some(false),
        Err(DefiniteError::Undecided { .. }) => None,
        Err(DefiniteError::Not(_)) if !open => Some(true),
        Err(DefiniteError::Not(_)) if matrix.rows() <= ELIMINATED_ORDER => {
            Some(!is_semidefinite(&matrix))
        }
        Err(DefiniteError::Not(_)) => None,
    }
}

/// Where the symmetric part of T(mu) = S + mu R_c is positive definite, so that MCEIP-mu has no
/// solution; K* = K0 + mu K1 is the pencil, `whole` says where it is definite itself.
///
/// T has the slip variables: S = K_ss - K_sf K_ff^-1 K_fs, and R_c likewise from K1. Small pencils
/// are condensed exactly; of large ones K_ff^-1 K_fs is rounded, and its error bounded. `None`
/// without free variables, where T is K*, and where no end is found.
///
/// ```
/// use mceip_engine::analysis::conditions::{DefiniteUntil, condensed};
/// use mceip_exact::{Sparse, whole};
/// use mceip_model::Pencil;
/// // K_ff = 1, and K1 has a free column: K* = [1, 0; 2 mu, 4] is definite below mu = 2, T = 4.
/// let k1 = Sparse::from_ints(&[&[0, 0], &[2, 0]]);
/// let pencil = Pencil::new(Sparse::from_ints(&[&[1, 0], &[0, 4]]), k1, vec![0]).unwrap();
/// let of_k = DefiniteUntil::of("K*", pencil.a(), pencil.b()).unwrap();
/// assert!(of_k.end().unwrap().contains(&whole(2)));
/// assert!(matches!(condensed(&pencil, &of_k), Some(DefiniteUntil::Always)));
/// ```
pub fn condensed(pencil: &Pencil, whole: &DefiniteUntil) -> Option<DefiniteUntil> {
    if pencil.free().is_empty() {
        return None;
    }

    // T(0) = S is definite where K0 is, because K_ff is; and T where K* is.
    if !matches!(whole, DefiniteUntil::End { .. }) {
        return Some(whole.clone());
    }

    if pencil.order() <= ELIMINATED_ORDER {
        let admissible = Admissible::new(pencil, Unknown::Mu).ok()?;
        let matrix = condense(&admissible).ok()?;
        return DefiniteUntil::of("T", matrix.a(), matrix.b()).ok();
    }

    let a = symmetric_part(pencil.a());
    let b = symmetric_part(pencil.b());
    let eliminated = Eliminated::of(&a, &b, &pencil.slip())?;
    let [constant, linear] = eliminated.condensed();
    let near = refuted_from(constant, linear)?;

    let hi = refuted_after(&near, &|mu| eliminated.is_condensed_refuted_at(mu))?;
    let lo = proved_before(&hi, &|mu| eliminated.is_condensed_definite_at(mu))?;
    let end = Interval::new(lo, hi)?;
    Some(DefiniteUntil::End { end, exact: None })
}

/// Is K* positive definite and M* positive semidefinite at this mu, so that no divergence is
/// possible? // (19)
///
/// Two factorisations only, for a single mu; [`Necessary`] answers for all of them.
///
/// # Errors
/// As [`DefiniteUntil::of`].
pub fn excluded_at(family: &MuFamily, mu: &Rational) -> Result<bool, ModelError> {
    let stiffness = symmetric_part_at(&family.stiffness, mu);
    if !is_definite("K*", &stiffness)? {
        return Ok(false);
    }

    let Some(mass) = &family.mass else {
        return Ok(false);
    };

    let mass = symmetric_part_at(mass, mu);
    Ok(is_semidefinite(&mass) || is_definite("M*", &mass)?)
}

/// The symmetric part of A + mu B.
fn symmetric_part_at(pencil: &Pencil, mu: &Rational) -> Sparse {
    symmetric_part(&pencil.a().add_scaled(mu, pencil.b()))
}

/// The all-slip solutions of a pencil in a window, exactly: (17)-(18), sufficient for divergence.
/// With the pencil (K0, K1) the same at lambda = 0.
///
/// Solutions with x > 0 on every slip variable; where (18) holds with some x_i = 0 the solution
/// belongs to a smaller support with biactive indices: [`is_all_slip`] knows it. The exact
/// eigenproblem costs the order's determinant polynomial: for condensed or small pencils.
pub fn all_slip(pencil: &Pencil, window: &Window) -> Vec<Solution> {
    let mut found = Enumeration::default();
    examine_support(pencil, &pencil.slip(), window, &mut found);
    found.solutions
}

/// Does an accepted solution with this support and these biactive indices satisfy (17)-(18)?
pub fn is_all_slip(pencil: &Pencil, support: &[usize], biactive: &[usize]) -> bool {
    let slip = pencil.slip();
    slip.iter()
        .all(|i| support.contains(i) || biactive.contains(i))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use mceip_model::reduction::mu_family;
    use mceip_model::{ContactState, Particle, System};
    use mceip_oracle::{TwoParticles, table1, thresholds};
    use mceip_paper::two_particles;

    fn two_particle_data(mu: Rational, signs: (i8, i8)) -> TwoParticles {
        TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(7),
            m: whole(2),
            mu,
            signs,
        }
    }

    fn family(data: &TwoParticles) -> MuFamily {
        mu_family(&two_particles(data).unwrap()).unwrap()
    }

    /// Two particles: S1 = S2 loses definiteness exactly at the threshold sqrt(c^2 + 2) / s, the
    /// pair (1, -1) before it, at c / s; (-1, 1) loses it as well but never diverges.
    #[test]
    fn two_particles_in_closed_form() {
        let data = two_particle_data(whole(1), (1, 1));

        let necessary = Necessary::of(&family(&data)).unwrap();

        assert!(necessary.mass_is_constant);
        let threshold = thresholds(&data).unwrap().remove(0).value;
        let end = necessary.stiffness.end().unwrap();
        assert!(threshold.within(end.lo(), end.hi()));
        assert!(end.width() < rational(1, 1_000_000_000_000));

        let pair = Necessary::of(&family(&two_particle_data(whole(1), (1, -1)))).unwrap();
        assert_eq!(pair.stiffness.end(), Some(&Interval::point(rational(3, 4))));
        // Singular is not definite.
        assert_eq!(pair.holds_at(&rational(3, 4)), Some(true));
        assert_eq!(pair.holds_at(&rational(74, 100)), Some(false));
        assert_eq!(pair.excluded_below(), Some(rational(3, 4)));
    }

    /// Where the condition excludes divergence the table has none, on both sides of the end.
    #[test]
    fn one_value_of_mu_agrees_with_all_of_them() {
        let mut excluded = 0;
        for k in 1..24 {
            for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let mu = rational(k, 8);
                let data = two_particle_data(mu.clone(), signs);
                let family = family(&data);

                let necessary = Necessary::of(&family).unwrap();
                let is_excluded = excluded_at(&family, &mu).unwrap();

                assert_eq!(
                    necessary.holds_at(&mu),
                    Some(!is_excluded),
                    "mu = {mu}, {signs:?}"
                );
                assert!(!is_excluded || table1(&data).is_empty());
                excluded += usize::from(is_excluded);
            }
        }

        assert!(excluded > 10 && excluded < 80);
    }

    /// A mass that couples T and N ends PSD first; at the end itself M* is still semidefinite.
    #[test]
    fn a_consistent_mass_may_come_first() {
        let k = Sparse::from_ints(&[&[4, 0], &[0, 4]]);
        let m = Sparse::from_ints(&[&[4, -2], &[-2, 4]]);
        let particle = Particle::plain(0, 1, ContactState::Slip { sign: 1 });
        let system = System::new(k, Some(m), None, vec![particle]).unwrap();

        let necessary = Necessary::of(&mu_family(&system).unwrap()).unwrap();

        assert!(!necessary.mass_is_constant);
        assert!(matches!(necessary.stiffness, DefiniteUntil::Always));
        let mass = necessary.mass.as_ref().unwrap();
        assert_eq!(mass.end(), Some(&Interval::point(whole(2))));
        assert_eq!(necessary.holds_at(&whole(2)), Some(false));
        assert_eq!(necessary.holds_at(&rational(21, 10)), Some(true));
    }

    #[test]
    fn large_matrices_are_bracketed_and_semidefinite_slopes_never_end() {
        for order in [EXACT_ORDER + 1, 60] {
            let identity = Sparse::identity(order);
            let coupling = Sparse::from_entries(order, order, [(0, 1, whole(2))]);

            let until = DefiniteUntil::of("K*", &identity, &coupling).unwrap();

            let end = until.end().unwrap();
            assert!(end.contains(&whole(1)) && !end.is_point(), "{end:?}");
            assert!(end.width() < rational(1, 1_000_000), "{end:?}");
        }

        let semidefinite = Sparse::from_ints(&[&[1, 1], &[1, 1]]);
        let always = DefiniteUntil::of("K*", &Sparse::identity(2), &semidefinite).unwrap();
        assert!(matches!(always, DefiniteUntil::Always));
        let never = DefiniteUntil::of("K*", &semidefinite, &semidefinite).unwrap();
        assert!(matches!(never, DefiniteUntil::NotAtZero(_)));
    }

    /// A chain of order 60, of which the last two variables slip; K1 is in their rows, and not
    /// symmetric. The end of the rounded elimination encloses that of the exact one, which is a
    /// root, and lies beyond that of (19). Negated rows end at another mu.
    #[test]
    fn a_large_matrix_is_condensed_as_a_small_one() {
        let order = 60;
        let slip = [58, 59];
        let mut entries = Vec::new();
        for i in 0..order {
            entries.push((i, i, rational(21, 10)));
            if i > 0 {
                entries.push((i, i - 1, whole(-1)));
                entries.push((i - 1, i, whole(-1)));
            }
        }
        let stiffness = Sparse::from_entries(order, order, entries);
        let slope = |factor: i64| {
            let rows = [
                (58, 57, 4),
                (58, 40, -2),
                (58, 59, 1),
                (59, 59, -1),
                (59, 3, 1),
            ];
            let entries = rows.map(|(i, j, v)| (i, j, rational(v * factor, 3)));
            Sparse::from_entries(order, order, entries)
        };

        for factor in [1, -1] {
            let free = (0..slip[0]).collect();
            let pencil = Pencil::new(stiffness.clone(), slope(factor), free).unwrap();
            let whole_matrix = DefiniteUntil::of("K*", pencil.a(), pencil.b()).unwrap();

            let condensed = condensed(&pencil, &whole_matrix).unwrap();

            let admissible = Admissible::new(&pencil, Unknown::Mu).unwrap();
            let exact = condense(&admissible).unwrap();
            let exact = DefiniteUntil::of("T", exact.a(), exact.b()).unwrap();
            let enclosed = condensed.end().unwrap();
            let root = exact.end().unwrap();
            assert!(enclosed.lo() < root.lo() && root.hi() < enclosed.hi());
            assert!(enclosed.width() < rational(1, 1_000_000), "{enclosed:?}");
            assert!(whole_matrix.end().unwrap().hi() < enclosed.lo());
        }
    }

    /// K0 = [2, -1; -1, 2] with the first variable free, K1 = [0, 0; 3, -3]: S = 3/2 and
    /// R_c = -3 + 3/2, so that T = 3/2 (1 - mu) ends at 1, which is the static threshold, and K*
    /// with det sym K* = 3 - 3 mu - 9/4 mu^2 at 2/3. Without free variables T is K* itself, and
    /// without definiteness at mu = 0 there is none of T either.
    #[test]
    fn the_condensed_form_by_hand() {
        let k0 = Sparse::from_ints(&[&[2, -1], &[-1, 2]]);
        let k1 = Sparse::from_ints(&[&[0, 0], &[3, -3]]);
        let pencil = Pencil::new(k0.clone(), k1.clone(), vec![0]).unwrap();
        let of_k = DefiniteUntil::of("K*", pencil.a(), pencil.b()).unwrap();

        let end = condensed(&pencil, &of_k).unwrap();

        assert_eq!(end.end(), Some(&Interval::point(whole(1))));
        assert_eq!(of_k.end(), Some(&Interval::point(rational(2, 3))));

        let without = Pencil::new(k0, k1.clone(), vec![]).unwrap();
        assert!(condensed(&without, &of_k).is_none());

        let indefinite = Sparse::from_ints(&[&[2, -1], &[-1, 0]]);
        let never = Pencil::new(indefinite, k1, vec![0]).unwrap();
        let of_k = DefiniteUntil::of("K*", never.a(), never.b()).unwrap();
        let of_t = condensed(&never, &of_k);
        assert!(matches!(of_t, Some(DefiniteUntil::NotAtZero(_))));
    }

    #[test]
    fn all_slip_solutions_are_those_of_17_and_18() {
        // The fold of errata.md: both particles slip, at lambda^2 = 2 and 3.
        let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
        let fold = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        assert_eq!(all_slip(&fold, &Window::all()).len(), 2);
        assert!(is_all_slip(&fold, &[0], &[1]));
        assert!(!is_all_slip(&fold, &[0], &[]));

        // Slip-stick alone is no all-slip mode.
        let a = Sparse::from_ints(&[&[-1, 0], &[5, 1]]);
        let one = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        assert!(all_slip(&one, &Window::all()).is_empty());
    }
}
