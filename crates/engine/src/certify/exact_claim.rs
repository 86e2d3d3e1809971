//! Exact claims: the root of the support's determinant nearest the candidate, and the kernel there.

use super::failure::AttemptFailure;
use super::rows::{IntegralRows, active};
use crate::candidate::Candidate;
use crate::tolerance::{VALUE_RADIUS, X_RADIUS};
use mceip_check::certificate::ExactSolution;
use mceip_exact::{
    Algebraic, Poly, Rational, Sign, determinant, from_f64, generic_kernel, kernel_at, roots_in,
    to_f64,
};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use num_traits::{Signed, Zero};

/// Most halvings of an isolating interval: far beyond any sign the corpus needs.
const MAX_HALVINGS: usize = 4_000;

/// The exact claim with this support whose value is nearest the candidate's.
pub(super) fn make(
    pencil: &Pencil,
    rows: &IntegralRows,
    window: &Window,
    support: &[usize],
    candidate: &Candidate,
) -> Result<ExactSolution, AttemptFailure> {
    let at = Support {
        pencil,
        rows,
        window,
        support,
        active: active(pencil, support),
        candidate,
    };
    let mut last = None;
    for value in at.values_near()? {
        let mut faces = Vec::new();
        loop {
            match at.value(&faces, value.clone()) {
                Ok(claim) => return Ok(claim),
                // A wide kernel may meet y >= 0 in a face only, which no double hits: the kernel
                // within y_i = 0 is tried.
                Err(AttemptFailure::YNegative { index }) if !faces.contains(&index) => {
                    last = last.or(Some(AttemptFailure::YNegative { index }));
                    faces.push(index);
                }
                Err(failure) => break last = last.or(Some(failure)),
            }
        }
    }
    Err(last.unwrap_or_else(|| no_root(candidate)))
}

fn no_root(candidate: &Candidate) -> AttemptFailure {
    let (lo, hi) = around(candidate);
    AttemptFailure::NoRootNear {
        lo: lo.to_string(),
        hi: hi.to_string(),
    }
}

fn around(candidate: &Candidate) -> (f64, f64) {
    let radius = VALUE_RADIUS * (1.0 + candidate.value.abs());
    (candidate.value - radius, candidate.value + radius)
}

/// A candidate and the support it is tried with.
struct Support<'a> {
    pencil: &'a Pencil,
    rows: &'a IntegralRows,
    window: &'a Window,
    support: &'a [usize],
    active: Vec<usize>,
    candidate: &'a Candidate,
}

impl Support<'_> {
    /// Roots of the support's determinant near the candidate, nearest first. For a singular pencil
    /// every value is one, so the candidate's own is taken, and then those where a sign may change.
    fn values_near(&self) -> Result<Vec<Algebraic>, AttemptFailure> {
        let place = |i: usize, which: usize| {
            let mut row = vec![mceip_exact::Integer::zero(); self.active.len()];
            for (j, a, b) in &self.rows.0[i] {
                if let Ok(k) = self.active.binary_search(j) {
                    row[k] = if which == 0 { a.clone() } else { b.clone() };
                }
            }
            row
        };
        let select = |which: usize| {
            self.active
                .iter()
                .map(|&i| place(i, which))
                .collect::<Vec<_>>()
        };
        let det = determinant(&select(0), &select(1));
        if !det.is_zero() {
            return self.roots_near(&[det]);
        }
        let center = from_f64(self.candidate.value)
            .map_err(|_| AttemptFailure::NotFinite)?
            .max(self.window.min().clone());
        let own = Algebraic::rational(
            self.window
                .max()
                .map_or(center.clone(), |m| center.min(m.clone())),
        );
        let (kernel, ..) = generic_kernel(self.block(&[]));
        let vectors = kernel.iter().map(|v| self.spread(v));
        let signs: Vec<Poly> = vectors
            .flat_map(|x| {
                x.iter()
                    .cloned()
                    .chain(self.rows.0.iter().map(|r| times(r, &x)))
                    .collect::<Vec<_>>()
            })
            .collect();
        Ok(std::iter::once(own)
            .chain(self.roots_near(&signs)?)
            .collect())
    }

    /// The roots of some polynomials near the candidate and in the window, nearest first.
    fn roots_near(&self, polynomials: &[Poly]) -> Result<Vec<Algebraic>, AttemptFailure> {
        let exact = |v: f64| from_f64(v).map_err(|_| AttemptFailure::NotFinite);
        let center = exact(self.candidate.value)?;
        let (lo, hi) = around(self.candidate);
        let (lo, hi) = (exact(lo)?.max(self.window.min().clone()), exact(hi)?);
        let hi = self.window.max().map_or(hi.clone(), |m| hi.min(m.clone()));
        if lo > hi {
            return Err(no_root(self.candidate));
        }
        let mut roots: Vec<Algebraic> = polynomials
            .iter()
            .filter(|p| !p.is_zero())
            .flat_map(|p| roots_in(p, &lo, Some(&hi)))
            .collect();
        roots.iter_mut().for_each(narrow);
        roots.sort_by_cached_key(|r| (r.interval().mid() - &center).abs());
        Ok(roots)
    }

    /// The claim at this value; y vanishes on `faces` too.
    fn value(
        &self,
        faces: &[usize],
        mut value: Algebraic,
    ) -> Result<ExactSolution, AttemptFailure> {
        value.try_rational();
        let x = self.kernel_vector(faces, &mut value)?;
        if let Some(&index) = self
            .support
            .iter()
            .find(|&&i| value.sign_of(&x[i]) != Sign::Positive)
        {
            return Err(AttemptFailure::XNotPositive { index });
        }
        let y: Vec<Poly> = self.rows.0.iter().map(|row| times(row, &x)).collect();
        let mut biactive = Vec::new();
        for index in (0..self.pencil.order()).filter(|i| self.active.binary_search(i).is_err()) {
            match value.sign_of(&y[index]) {
                Sign::Negative => return Err(AttemptFailure::YNegative { index }),
                Sign::Zero => biactive.push(index),
                Sign::Positive => {}
            }
        }
        // Zero tests have shrunk the polynomial until everything that vanishes is 0 modulo it.
        for &i in &self.active {
            value.sign_of(&y[i]);
        }
        close_enough(self.pencil, self.candidate, &x, &mut value)?;
        let strict: Vec<&Poly> = self.support.iter().map(|&i| &x[i]).collect();
        let inactive = (0..self.pencil.order())
            .filter(|i| self.active.binary_search(i).is_err() && !biactive.contains(i));
        let strict: Vec<&Poly> = strict.into_iter().chain(inactive.map(|i| &y[i])).collect();
        tighten(
            self.window,
            &strict,
            self.support.is_empty().then_some(&x[..]),
            &mut value,
        )?;
        Ok(claim(self.support, biactive, &x, &value))
    }

    /// The rows of the active variables and of `faces`, in the columns of the active ones.
    fn block(&self, faces: &[usize]) -> Vec<Vec<Poly>> {
        let entry = |i: usize, j: usize| {
            let found = self.rows.0[i].iter().find(|e| e.0 == j);
            found.map_or_else(Poly::default, |(_, a, b)| {
                Poly::new(vec![a.clone(), b.clone()])
            })
        };
        self.active
            .iter()
            .chain(faces)
            .map(|&i| self.active.iter().map(|&j| entry(i, j)).collect())
            .collect()
    }

    /// A vector over the active variables as one over all.
    fn spread(&self, part: &[Poly]) -> Vec<Poly> {
        let mut x = vec![Poly::default(); self.pencil.order()];
        self.active
            .iter()
            .zip(part)
            .for_each(|(&i, p)| x[i] = p.clone());
        x
    }

    /// The kernel vector nearest the candidate: the kernel's free coordinates are taken from it.
    fn kernel_vector(
        &self,
        faces: &[usize],
        value: &mut Algebraic,
    ) -> Result<Vec<Poly>, AttemptFailure> {
        let basis = kernel_at(self.block(faces), value);
        if basis.is_empty() {
            // Faces that leave nothing; without them every value here is a root.
            return Err(no_root(self.candidate));
        }
        // Each basis vector is the same polynomial at its own free coordinate, zero at the others'.
        let weights = match &basis[..] {
            [_] => vec![Rational::from_integer(1.into())],
            _ => (0..basis.len())
                .map(|k| coordinate(k, &basis, value, &self.active, self.candidate))
                .collect::<Result<Vec<_>, _>>()?,
        };
        let clear = mceip_exact::common_denominator(&weights);
        let mut x = vec![Poly::default(); self.pencil.order()];
        for (vector, weight) in basis.iter().zip(&weights) {
            let factor = weight.numer() * (&clear / weight.denom());
            for (&i, p) in self.active.iter().zip(vector) {
                x[i] = &x[i] + &p.scale(&factor);
            }
        }
        let slip_sign = self
            .pencil
            .slip()
            .iter()
            .map(|&i| value.sign_of(&x[i]))
            .find(|s| *s != Sign::Zero);
        let flip = match slip_sign {
            Some(sign) => sign == Sign::Negative,
            None => dot_sign(&x, self.candidate, value),
        };
        Ok(if flip {
            x.iter().map(|p| -p).collect()
        } else {
            x
        })
    }
}

/// The candidate's component at the one coordinate where, of all basis vectors, only the k-th is
/// not zero (at this value: a polynomial that only vanishes there is no zero of the ring).
fn coordinate(
    k: usize,
    basis: &[Vec<Poly>],
    value: &mut Algebraic,
    active: &[usize],
    candidate: &Candidate,
) -> Result<Rational, AttemptFailure> {
    let mut only_k = |c: &usize| {
        basis
            .iter()
            .enumerate()
            .all(|(other, v)| (value.sign_of(&v[*c]) == Sign::Zero) != (other == k))
    };
    let component = (0..active.len())
        .find(&mut only_k)
        .map_or(0.0, |c| candidate.x[active[c]]);
    from_f64(component).map_err(|_| AttemptFailure::NotFinite)
}

/// For a solution without slip variables: does x point away from the candidate?
fn dot_sign(x: &[Poly], candidate: &Candidate, value: &mut Algebraic) -> bool {
    narrow(value);
    let mid = value.interval().mid();
    let dot: f64 = x
        .iter()
        .zip(&candidate.x)
        .map(|(p, c)| to_f64(&p.eval(&mid)) * c)
        .sum();
    dot < 0.0
}

/// Narrows the interval of a value to 2^-62: its middle may be compared with what the candidate
/// says.
fn narrow(value: &mut Algebraic) {
    value.refine_to(&Rational::new(
        1.into(),
        mceip_exact::Integer::from(1u64 << 62),
    ));
}

fn close_enough(
    pencil: &Pencil,
    candidate: &Candidate,
    x: &[Poly],
    value: &mut Algebraic,
) -> Result<(), AttemptFailure> {
    let slip = pencil.slip();
    let over = |list: &[f64]| {
        let sum: f64 = slip.iter().map(|&i| list[i]).sum();
        if sum > 0.0 {
            sum
        } else {
            list.iter().map(|v| v.abs()).sum()
        }
    };
    // Polynomials at the midpoint may be huge: divide exactly before rounding.
    narrow(value);
    let mid = value.interval().mid();
    let exact: Vec<Rational> = x.iter().map(|p| p.eval(&mid)).collect();
    let largest = exact
        .iter()
        .map(|v| v.abs())
        .max()
        .unwrap_or_else(Rational::zero);
    if largest.is_zero() {
        return Err(AttemptFailure::ZeroX);
    }
    let ours: Vec<f64> = exact.iter().map(|v| to_f64(&(v / &largest))).collect();
    let (norm_ours, norm_theirs) = (over(&ours), over(&candidate.x));
    let distance = ours
        .iter()
        .zip(&candidate.x)
        .map(|(a, b)| (a / norm_ours - b / norm_theirs).abs())
        .fold(0.0, f64::max);
    if distance <= X_RADIUS {
        Ok(())
    } else {
        Err(AttemptFailure::TooFar {
            distance,
            limit: X_RADIUS,
        })
    }
}

/// Narrows the interval until the checker's interval Horner sees every strict sign, the slope of
/// the polynomial and the window.
fn tighten(
    window: &Window,
    strict: &[&Poly],
    nonzero: Option<&[Poly]>,
    value: &mut Algebraic,
) -> Result<(), AttemptFailure> {
    for _ in 0..MAX_HALVINGS {
        let (interval, p) = (value.interval().clone(), value.poly().clone());
        let sure = |g: &Poly| interval.horner(&g.pseudo_rem(&p)).certain_sign();
        let isolated = interval.is_point() || interval.horner(&p.derivative()).certain_sign() != 0;
        let inside =
            interval.lo() >= window.min() && window.max().is_none_or(|m| interval.hi() <= m);
        let positive = strict.iter().all(|g| sure(g) == 1);
        if isolated && inside && positive && nonzero.is_none_or(|x| x.iter().any(|g| sure(g) != 0))
        {
            return Ok(());
        }
        if interval.is_point() {
            break; // nothing left to narrow: a sign that stays uncertain is a zero
        }
        value.refine();
    }
    Err(AttemptFailure::Precision {
        limit: MAX_HALVINGS,
    })
}

fn claim(support: &[usize], biactive: Vec<usize>, x: &[Poly], value: &Algebraic) -> ExactSolution {
    let p = value.poly();
    let x = x.iter().map(|g| remainder(g, p)).collect::<Vec<_>>();
    let x = primitive(x);
    let interval = [
        Number(value.interval().lo().clone()),
        Number(value.interval().hi().clone()),
    ];
    ExactSolution {
        support: support.to_vec(),
        biactive,
        polynomial: p.coeffs().to_vec(),
        interval,
        x,
    }
}

/// g mod p over Q.
fn remainder(g: &Poly, p: &Poly) -> Vec<Rational> {
    let rational = |p: &Poly| {
        p.coeffs()
            .iter()
            .map(|c| Rational::from_integer(c.clone()))
            .collect::<Vec<_>>()
    };
    super::lifted::remainder(rational(g), &rational(p))
}

/// All components times one positive rational that makes them integers without a common factor.
fn primitive(x: Vec<Vec<Rational>>) -> Vec<Vec<Number>> {
    use num_integer::Integer as _;
    let clear = mceip_exact::common_denominator(x.iter().flatten());
    let gcd = x
        .iter()
        .flatten()
        .fold(mceip_exact::Integer::zero(), |g, v| {
            g.gcd(&(v.numer() * (&clear / v.denom())))
        });
    let factor = if gcd.is_zero() {
        Rational::from_integer(clear)
    } else {
        Rational::new(clear, gcd)
    };
    x.into_iter()
        .map(|p| p.into_iter().map(|v| Number(v * &factor)).collect())
        .collect()
}

/// A row of (A + tB) x.
fn times(row: &[(usize, mceip_exact::Integer, mceip_exact::Integer)], x: &[Poly]) -> Poly {
    row.iter().fold(Poly::default(), |sum, (j, a, b)| {
        &sum + &(&Poly::new(vec![a.clone(), b.clone()]) * &x[*j])
    })
}

#[cfg(test)]
mod tests;
