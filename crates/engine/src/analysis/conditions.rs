//! The necessary conditions (19), (20) and the sufficient condition (17)-(18), decided exactly.
//!
//! K0 and M0 are symmetric positive definite, so the mu >= 0 at which K* = K0 + mu K1 is positive
//! definite (its symmetric part, that is) form an interval from 0: the smallest eigenvalue is a
//! concave function of mu. (19) holds from the end of the shorter of two such intervals on.

use crate::reduction::MuFamily;
use crate::tolerance::{BRACKET_BITS, BRACKET_START_BITS};
use mceip_exact::{
    Algebraic, DefiniteError, Interval, Rational, Sparse, common_denominator, determinant,
    from_f64, positive_definite, roots_in, to_f64, whole,
};
use mceip_mcp::linear::definite_eigenvalues;
use mceip_model::{ModelError, Pencil, Window};
use mceip_oracle::{Enumeration, Solution, examine_support};
use num_traits::{One, Signed, Zero};

/// The mu >= 0 at which the symmetric part of A + mu B is positive definite: an interval from 0.
#[derive(Debug, Clone)]
pub enum DefiniteUntil {
    /// Not even at mu = 0.
    Never,
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
        let (a, b) = (symmetric_part(a), symmetric_part(b));
        if !is_definite(what, &a)? {
            return Ok(DefiniteUntil::Never);
        }
        if is_semidefinite(&b) {
            return Ok(DefiniteUntil::Always);
        }
        if a.rows() <= EXACT_ORDER
            && let Some(mut end) = smallest_root(&a, &b)
        {
            end.try_rational();
            let width = end.interval().hi()
                / Rational::from_integer(num_bigint::BigInt::one() << BRACKET_BITS);
            end.refine_to(&width);
            return Ok(DefiniteUntil::End {
                end: end.interval().clone(),
                exact: Some(Box::new(end)),
            });
        }
        bracket(what, &a, &b)
    }
}

/// (A + A') / 2.
fn symmetric_part(a: &Sparse) -> Sparse {
    let half = mceip_exact::rational(1, 2);
    Sparse::zeros(a.rows(), a.cols())
        .add_scaled(&half, a)
        .add_scaled(&half, &a.transpose())
}

fn is_definite(what: &'static str, m: &Sparse) -> Result<bool, ModelError> {
    match positive_definite(m) {
        Ok(()) => Ok(true),
        Err(DefiniteError::Not(_)) => Ok(false),
        Err(DefiniteError::Undecided { index }) => Err(ModelError::DefinitenessUndecided {
            equation: "E19",
            what,
            index,
        }),
    }
}

/// Symmetric LDL' in fractions in which a zero pivot must have a zero row.
fn is_semidefinite(m: &Sparse) -> bool {
    // A zero on the diagonal beside something else refutes at once; zero rows drop out.
    if (0..m.rows()).any(|i| m.get(i, i).is_zero() && !m.row(i).is_empty()) {
        return false;
    }
    let rows: Vec<usize> = (0..m.rows()).filter(|&i| !m.row(i).is_empty()).collect();
    let mut a = m.submatrix(&rows, &rows).to_dense();
    for k in 0..rows.len() {
        let pivot = a[(k, k)].clone();
        if pivot.is_negative() || (pivot.is_zero() && (k..rows.len()).any(|j| !a[(k, j)].is_zero()))
        {
            return false;
        }
        for i in k + 1..rows.len() {
            if a[(i, k)].is_zero() {
                continue;
            }
            let factor = &a[(i, k)] / &pivot;
            for j in k + 1..rows.len() {
                let update = &factor * &a[(k, j)];
                a[(i, j)] -= update;
            }
        }
    }
    true
}

/// The smallest positive root of det(A + mu B), A definite: there definiteness ends.
fn smallest_root(a: &Sparse, b: &Sparse) -> Option<Algebraic> {
    let scale = common_denominator(a.entries().chain(b.entries()).map(|(_, _, v)| v));
    let integral = |m: &Sparse| -> Vec<Vec<_>> {
        let d = m.to_dense();
        (0..m.rows())
            .map(|i| {
                (0..m.rows())
                    .map(|j| (&d[(i, j)] * Rational::from_integer(scale.clone())).to_integer())
                    .collect()
            })
            .collect()
    };
    roots_in(
        &determinant(&integral(a), &integral(b)),
        &Rational::zero(),
        None,
    )
    .into_iter()
    .next()
}

/// The end between a value at which LDL' proves definiteness and one at which it refutes it.
fn bracket(what: &'static str, a: &Sparse, b: &Sparse) -> Result<DefiniteUntil, ModelError> {
    let undecided = || ModelError::DefinitenessUndecided {
        equation: "E19",
        what,
        index: 0,
    };
    let dense = |m: &Sparse| -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; m.cols()]; m.rows()];
        m.entries().for_each(|(i, j, v)| rows[i][j] = to_f64(v));
        rows
    };
    // 1 + mu t >= 0 for the eigenvalues t of B v = t A v.
    let smallest = *definite_eigenvalues(&dense(b), &dense(a))
        .ok_or_else(undecided)?
        .first()
        .ok_or_else(undecided)?;
    let guess = from_f64(-smallest.recip())
        .ok()
        .filter(Rational::is_positive)
        .ok_or_else(undecided)?;
    let definite_at = |mu: &Rational| match positive_definite(&a.add_scaled(mu, b)) {
        Ok(()) => Some(true),
        Err(DefiniteError::Not(_)) => Some(false),
        Err(DefiniteError::Undecided { .. }) => None,
    };
    // Each end steps outwards until it is proved.
    let end = |sense: i64, wanted: bool| {
        (0..=BRACKET_START_BITS / 2).find_map(|k| {
            let step = Rational::new(
                sense.into(),
                num_bigint::BigInt::one() << (BRACKET_START_BITS - 2 * k),
            );
            let mu = shorten(&(&guess * (Rational::one() + step)));
            (mu.is_positive() || mu.is_zero())
                .then_some(mu)
                .filter(|mu| definite_at(mu) == Some(wanted))
        })
    };
    let lo = end(-1, true).ok_or_else(undecided)?;
    let hi = end(1, false).ok_or_else(undecided)?;
    Ok(DefiniteUntil::End {
        end: Interval::new(lo, hi).ok_or_else(undecided)?,
        exact: None,
    })
}

/// The same number to a double's digits: short numbers keep LDL' cheap.
fn shorten(v: &Rational) -> Rational {
    from_f64(to_f64(v)).unwrap_or_else(|_| v.clone())
}

/// From which mu the necessary condition for divergence holds. // E19, E20
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
        let stiffness = DefiniteUntil::of("K*", family.stiffness.a(), family.stiffness.b())?;
        let mass = family
            .mass
            .as_ref()
            .map(|m| DefiniteUntil::of("M*", m.a(), m.b()))
            .transpose()?;
        let mass_is_constant = family
            .mass
            .as_ref()
            .is_some_and(|m| m.b().entries().next().is_none());
        Ok(Necessary {
            stiffness,
            mass,
            mass_is_constant,
        })
    }

    /// Does the condition hold at this mu: may there be divergence? `None` if mu lies inside the
    /// enclosure of an end that is not known exactly.
    pub fn holds_at(&self, mu: &Rational) -> Option<bool> {
        let not_definite = past(&self.stiffness, mu, false);
        match self.mass.as_ref().map(|m| past(m, mu, true)) {
            Some(Some(true)) => Some(true),
            Some(None) => not_definite.filter(|k| *k),
            _ => not_definite,
        }
    }

    /// mu up to which (this value not included) divergence is excluded by the condition; `None` if
    /// for all mu.
    pub fn excluded_below(&self) -> Option<Rational> {
        let lo = |until: &DefiniteUntil| match until {
            DefiniteUntil::Never => Some(Rational::zero()),
            DefiniteUntil::Always => None,
            DefiniteUntil::End { end, .. } => Some(end.lo().clone()),
        };
        match (lo(&self.stiffness), self.mass.as_ref().and_then(lo)) {
            (Some(k), Some(m)) => Some(k.min(m)),
            (k, m) => k.or(m),
        }
    }
}

/// Has definiteness ended at mu? `open`: the end itself does not count (semidefinite is enough).
fn past(until: &DefiniteUntil, mu: &Rational, open: bool) -> Option<bool> {
    match until {
        DefiniteUntil::Never => Some(true),
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

/// Is K* positive definite and M* positive semidefinite at this mu, so that no divergence is
/// possible? // E19
///
/// Two factorisations only, for a single mu; [`Necessary`] answers for all of them.
///
/// # Errors
/// As [`DefiniteUntil::of`].
pub fn excluded_at(family: &MuFamily, mu: &Rational) -> Result<bool, ModelError> {
    let at = |p: &Pencil| symmetric_part(&p.a().add_scaled(mu, p.b()));
    Ok(is_definite("K*", &at(&family.stiffness))?
        && match &family.mass {
            None => false,
            Some(m) => is_semidefinite(&at(m)) || is_definite("M*", &at(m))?,
        })
}

/// The all-slip solutions of a pencil in a window, exactly: (17)-(18), sufficient for divergence.
/// With the pencil (K0, K1) the same at lambda = 0. // E17, E18
///
/// Solutions with x > 0 on every slip variable; where (18) holds with some x_i = 0 the solution
/// belongs to a smaller support with biactive indices: [`is_all_slip`] knows it. The exact
/// eigenproblem costs the order's determinant polynomial: for condensed or small pencils.
pub fn all_slip(pencil: &Pencil, window: &Window) -> Vec<Solution> {
    let mut found = Enumeration::default();
    let slip = pencil.slip();
    examine_support(pencil, &slip, window, &mut found);
    found.solutions
}

/// Does an accepted solution with this support and these biactive indices satisfy (17)-(18)? //
/// E17, E18
pub fn is_all_slip(pencil: &Pencil, support: &[usize], biactive: &[usize]) -> bool {
    pencil
        .slip()
        .iter()
        .all(|i| support.contains(i) || biactive.contains(i))
}

/// The value of mu in the middle of an enclosure, for people.
pub fn approximately(interval: &Interval) -> f64 {
    to_f64(&((interval.lo() + interval.hi()) / whole(2)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reduction::mu_family;
    use mceip_exact::rational;
    use mceip_model::{ContactState, Particle, System};
    use mceip_oracle::{TwoParticles, table1, thresholds};
    use mceip_paper::two_particles;

    fn table(mu: Rational, signs: (i8, i8)) -> (TwoParticles, MuFamily) {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(7),
            m: whole(2),
            mu,
            signs,
        };
        let family = mu_family(&two_particles(&data).unwrap()).unwrap();
        (data, family)
    }

    /// Two particles: S1 = S2 loses definiteness exactly at the threshold sqrt(c^2 + 2) / s, the
    /// pair (1, -1) before it, at c / s; (-1, 1) loses it as well but never diverges.
    #[test]
    fn two_particles_in_closed_form() {
        let (data, family) = table(whole(1), (1, 1));
        let necessary = Necessary::of(&family).unwrap();
        assert!(necessary.mass_is_constant);
        let threshold = thresholds(&data).unwrap().remove(0).value;
        let end = necessary.stiffness.end().unwrap();
        assert!(
            threshold.within(end.lo(), end.hi()) && end.width() < rational(1, 1_000_000_000_000)
        );
        let pair = Necessary::of(&table(whole(1), (1, -1)).1).unwrap();
        assert_eq!(pair.stiffness.end(), Some(&Interval::point(rational(3, 4))));
        assert_eq!(pair.holds_at(&rational(3, 4)), Some(true)); // singular is not definite
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
                let (data, family) = table(mu.clone(), signs);
                let necessary = Necessary::of(&family).unwrap();
                let out = excluded_at(&family, &mu).unwrap();
                assert_eq!(necessary.holds_at(&mu), Some(!out), "mu = {mu}, {signs:?}");
                assert!(!out || table1(&data).is_empty());
                excluded += usize::from(out);
            }
        }
        assert!(excluded > 10 && excluded < 80);
    }

    /// A mass that couples T and N ends PSD first; at the end itself M* is still semidefinite.
    #[test]
    fn a_consistent_mass_may_come_first() {
        let k = Sparse::from_ints(&[&[4, 0], &[0, 4]]);
        let m = Sparse::from_ints(&[&[4, -2], &[-2, 4]]);
        let system = System::new(
            k,
            Some(m),
            None,
            vec![Particle::plain(0, 1, ContactState::Slip { sign: 1 })],
        )
        .unwrap();
        let necessary = Necessary::of(&mu_family(&system).unwrap()).unwrap();
        assert!(
            !necessary.mass_is_constant && matches!(necessary.stiffness, DefiniteUntil::Always)
        );
        assert_eq!(
            necessary.mass.as_ref().unwrap().end(),
            Some(&Interval::point(whole(2)))
        );
        assert_eq!(
            (
                necessary.holds_at(&whole(2)),
                necessary.holds_at(&rational(21, 10))
            ),
            (Some(false), Some(true))
        );
    }

    #[test]
    fn large_matrices_are_bracketed_and_semidefinite_slopes_never_end() {
        let coupling = |n| Sparse::from_entries(n, n, [(0, 1, whole(2))]);
        for n in [EXACT_ORDER + 1, 60] {
            let until = DefiniteUntil::of("K*", &Sparse::identity(n), &coupling(n)).unwrap();
            let end = until.end().unwrap();
            assert!(
                end.contains(&whole(1)) && end.width() < rational(1, 1_000_000) && !end.is_point(),
                "{end:?}"
            );
        }
        let semi = Sparse::from_ints(&[&[1, 1], &[1, 1]]);
        assert!(matches!(
            DefiniteUntil::of("K*", &Sparse::identity(2), &semi).unwrap(),
            DefiniteUntil::Always
        ));
        assert!(matches!(
            DefiniteUntil::of("K*", &semi, &semi).unwrap(),
            DefiniteUntil::Never
        ));
    }

    #[test]
    fn all_slip_solutions_are_those_of_17_and_18() {
        // The fold of errata.md: both particles slip, at lambda^2 = 2 and 3.
        let fold = Pencil::new(
            Sparse::from_ints(&[&[1, -6], &[2, -6]]),
            Sparse::identity(2),
            vec![],
        )
        .unwrap();
        assert_eq!(all_slip(&fold, &Window::all()).len(), 2);
        assert!(is_all_slip(&fold, &[0], &[1]) && !is_all_slip(&fold, &[0], &[]));
        // Slip-stick alone is no all-slip mode.
        let one = Pencil::new(
            Sparse::from_ints(&[&[-1, 0], &[5, 1]]),
            Sparse::identity(2),
            vec![],
        )
        .unwrap();
        assert!(all_slip(&one, &Window::all()).is_empty());
    }
}
