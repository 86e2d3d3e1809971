//! Root leaves: T(t) on a support has at most one null vector over the interval, and what it is.
//!
//! Every variable is decided. The witness is that of `bordered`, for T(t) on the support with its
//! pivot k. All bounds hold for every T(t) of the enclosure:
//!
//! 1. rho < 1 and, for the transpose, eta < 1: T' is regular. A null vector of T on the support,
//!    scaled to 1 at k, is v_true, and it exists exactly where the Schur complement
//!    phi(t) = T_kk - T_k' T'^-1 T_'k is zero.
//! 2. |v_true - v| <= eps_v, |u_true - u| <= eps_u.
//! 3. phi' = u_true' (dT/dt) v_true. If this is certainly not zero (*monotone*), phi has at most
//!    one zero t.
//! 4. phi = u'Tv - (residual of u)' T'^-1 (residual of v), where the second term is at most the sum
//!    of |residual of u| times eps_v. So the sign of phi at an end can be told.
//! 5. If phi has the same sign at both ends there is no null vector. If it has opposite signs at
//!    the ends of [a, b], the only null vector is at a t in [a, b], and lies within eps of v there:
//!    signs of x = v_true and of y = T x outside the support decide whether it is a solution.
//!
//! The bounds of steps 1 to 3 are those of the *wide* ends, over the hull of the region's interval
//! and [a, b]; signs in [a, b] are those of the *narrow* ends. The outcome `claim` names the null
//! vector by a claim of the certificate, `infinity` by what it is at infinity (`infinity`). Called
//! by the walk through the trees.

use super::ball::Ball;
use super::bordered::{Bordered, SupportBlock};
use super::context::Context;
use super::ends::Ends;
use super::fault::CoverFault;
use super::infinity;
use super::leaf::{Leaf, Yield};
use super::proved::LeafSolution;
use super::region::Region;
use crate::AcceptedClaim;
use crate::certificate::{Root, RootOutcome, VariableState};
use mceip_exact::{Integer, Interval, Rational};
use mceip_model::Window;
use num_traits::{Signed, Zero};

impl Leaf for Root {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        let value = interval(self, context.window)?;
        is_meant_for(at, context, &self.outcome)?;

        // Uniqueness is proved over the hull of the region's interval and the root's.
        let family = &context.families[0];
        let anchor = context.anchor;
        let hull_lo = at.lo.as_ref().min(value.lo());
        let hull_hi = at.hi.as_deref().map(|hi| hi.max(value.hi()));
        // What is the only one up to infinity is the only one up to b.
        let hull_end = hull_hi.unwrap_or(value.hi());
        let hull =
            Interval::new(hull_lo.clone(), hull_end.clone()).ok_or_else(|| outside_window(self))?;

        let spend_matrix = |lo: &Rational, hi: Option<&Rational>| {
            let cost = family.matrix_work(anchor, lo, hi);
            context.matrix_budget.spend(cost)
        };
        spend_matrix(hull_lo, hull_hi)?;
        let wide = family.hull_ends(anchor, hull_lo, hull_hi)?;
        let narrow = || {
            spend_matrix(value.lo(), Some(value.hi()))?;
            family.ends(anchor, value.lo(), Some(value.hi()))
        };
        let support = context.problem_indices(at.support());
        let vanishing = context.rows.vanishing(&support);
        check(at, &wide, narrow, &context.index, &vanishing, self)?;

        let solution = match &self.outcome {
            RootOutcome::Absent | RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) => None,
            RootOutcome::Solution => Some(AcceptedClaim { support, value }),
            RootOutcome::Claim(claim) => {
                let known = claim_of_leaf(context, *claim, &support, &value)?;
                let is_here = known.support == support;
                is_here.then(|| known.clone())
            }
            RootOutcome::Infinity(x) => {
                let is_reversed = family.is_reversed(anchor);
                infinity::null_vector(context.rows, &support, at.hi.is_none(), is_reversed, x)?;
                None
            }
        };

        let found = solution.map(|solution| LeafSolution { solution, hull });
        Ok(Yield {
            found: found.into_iter().collect(),
            ..Yield::default()
        })
    }
}

/// The interval of a root leaf: within the window, and a point only where the outcome needs no
/// change of sign.
fn interval(leaf: &Root, window: &Window) -> Result<Interval, CoverFault> {
    let [a, b] = &leaf.interval;
    let value = Interval::new(a.0.clone(), b.0.clone()).ok_or_else(|| outside_window(leaf))?;

    let may_be_point = matches!(
        leaf.outcome,
        RootOutcome::Claim(_) | RootOutcome::Absent | RootOutcome::Infinity(_)
    );
    let is_below = value.lo() < window.min();
    let is_above = window.max().is_some_and(|max| value.hi() > max);
    if is_below || is_above || (value.is_point() && !may_be_point) {
        return Err(outside_window(leaf));
    }

    Ok(value)
}

fn outside_window(leaf: &Root) -> CoverFault {
    let [a, b] = &leaf.interval;
    CoverFault::Interval {
        a: a.0.clone(),
        b: b.0.clone(),
    }
}

/// Refuses outcomes that need a narrow interval on a chord: over a half line without a reversed
/// anchor only `absent`, `infinity` and `claim` are read.
fn is_meant_for(
    at: &Region,
    context: &Context<'_>,
    outcome: &RootOutcome,
) -> Result<(), CoverFault> {
    let is_chord = at.hi.is_none() && !context.families[0].is_reversed(context.anchor);

    let outcome = match outcome {
        RootOutcome::Solution => "solution",
        RootOutcome::NegativeX(_) => "negative_x",
        RootOutcome::NegativeY(_) => "negative_y",
        RootOutcome::Absent | RootOutcome::Claim(_) | RootOutcome::Infinity(_) => return Ok(()),
    };

    if is_chord {
        return Err(CoverFault::OutcomeOnHalfLine { outcome });
    }

    Ok(())
}

/// The claim with this number, whose x is a null vector of the leaf's block at a value in the
/// leaf's interval.
///
/// That is so if x is zero off the leaf's support and y is zero on it: the claim's support is
/// part of the leaf's, and the rest of the leaf's support is biactive.
fn claim_of_leaf<'c>(
    context: &'c Context<'_>,
    claim: usize,
    support: &[usize],
    interval: &Interval,
) -> Result<&'c AcceptedClaim, CoverFault> {
    let not_the_claim = CoverFault::NotTheClaim { claim };
    let Some(known) = context.claims.get(claim) else {
        return Err(not_the_claim);
    };
    let own = &known.claim.support;
    let value = &known.claim.value;

    let is_part = !own.is_empty() && own.iter().all(|i| support.contains(i));
    let is_null = support
        .iter()
        .all(|i| own.contains(i) || known.biactive.contains(i));
    let is_inside = value.lo() >= interval.lo() && value.hi() <= interval.hi();

    if is_part && is_null && is_inside {
        Ok(&known.claim)
    } else {
        Err(not_the_claim)
    }
}

/// Checks the witness. `vanishing` are variables at rest of which y = 0 follows from y = 0 on the
/// support: a solution needs no sign there. For [`RootOutcome::Claim`] and
/// [`RootOutcome::Infinity`] it checks uniqueness only, steps 1 to 3.
fn check(
    region: &Region,
    wide: &Ends,
    narrow: impl FnOnce() -> Result<Ends, CoverFault>,
    index: &[usize],
    vanishing: &[usize],
    root: &Root,
) -> Result<(), CoverFault> {
    let witness = Bordered::of_leaf(region, index, root.into())?;
    let blocks = blocks(&witness, wide);

    let rho = witness.norm(&blocks)?;
    let left = witness.left_error(&blocks)?;
    let right = witness.error(&blocks, &rho);
    if !is_monotone(&witness, wide, &left, &right) {
        return Err(CoverFault::NotMonotone);
    }

    match root.outcome {
        RootOutcome::Claim(_) | RootOutcome::Infinity(_) => return Ok(()),
        RootOutcome::Absent if schur_signs(&witness, &blocks, &rho) == 1 => return Ok(()),
        RootOutcome::Absent => return Err(CoverFault::SignChange),
        RootOutcome::Solution | RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) => {}
    }

    let narrow = narrow()?;
    let narrow_blocks = self::blocks(&witness, &narrow);
    if schur_signs(&witness, &narrow_blocks, &rho) != -1 {
        let [lo, hi] = &root.interval;
        return Err(CoverFault::NoSignChange {
            lo: lo.0.clone(),
            hi: hi.0.clone(),
        });
    }

    // rho bounds |I - Y T'(t)| for every t of the hull, so for those of [a, b].
    let candidate = NullVectorCandidate {
        error: witness.error(&narrow_blocks, &rho) * Rational::from_integer(witness.one.clone()),
        witness: &witness,
        ends: &narrow,
        region,
        index,
        vanishing,
    };
    candidate.check_outcome(&root.outcome)
}

/// T at both ends on the support.
fn blocks<'a>(witness: &Bordered<'_>, ends: &'a Ends) -> [SupportBlock<'a>; 2] {
    ends.at
        .each_ref()
        .map(|end| witness.block(end, &ends.scale))
}

/// Is u_true' (dT/dt) v_true certainly not zero over the interval?
///
/// `left` and `right` bound |u_true - u| and |v_true - v|. The interval's length times dT/dt lies
/// within D (`slope`) of M1 - M0.
fn is_monotone(witness: &Bordered<'_>, ends: &Ends, left: &Rational, right: &Rational) -> bool {
    let Some(slope_radius) = &ends.slope else {
        return false;
    };
    let in_units = |bound: &Rational| (bound * Rational::from_integer(witness.one.clone())).ceil();
    let left = in_units(left).to_integer();
    let right = in_units(right).to_integer();
    let exact = Integer::zero();
    let order = witness.order();
    let [lower, upper] = &ends.at;

    let mut slope: Ball<Integer> = Ball::default();
    for (i, &row) in witness.support.iter().enumerate() {
        let u = &witness.u[i];
        let e_u = if i < order { &left } else { &exact };

        for (j, &column) in witness.support.iter().enumerate() {
            let v = &witness.v[j];
            let e_v = if j < order { &right } else { &exact };

            let difference = &upper.m[row][column] - &lower.m[row][column];
            let around = &slope_radius[row][column];
            let size = difference.abs() + around;
            slope.center += u * &difference * v;
            slope.radius += around * u.abs() * v.abs();
            slope.radius += size * (e_u * v.abs() + u.abs() * e_v + e_u * e_v);
        }
    }

    slope.sign() != 0
}

/// 1 if phi certainly has one sign at both ends, -1 if it certainly changes, else 0.
fn schur_signs(
    witness: &Bordered<'_>,
    [lower, upper]: &[SupportBlock<'_>; 2],
    norm: &Rational,
) -> i8 {
    schur_sign(witness, lower, norm) * schur_sign(witness, upper, norm)
}

/// Certain sign of phi at an end, 0 if none.
fn schur_sign(witness: &Bordered<'_>, block: &SupportBlock<'_>, norm: &Rational) -> i8 {
    let mut phi = witness.value(&witness.products(block));

    let left_residual = witness.left_residual(block) * &witness.one;
    let error = witness.error(std::slice::from_ref(block), norm);
    let second_term = Rational::from_integer(left_residual) * error;
    phi.radius += second_term.ceil().to_integer();
    phi.sign()
}

/// The only null vector of the leaf: v_true, at a value of the narrow interval.
struct NullVectorCandidate<'a> {
    witness: &'a Bordered<'a>,
    /// Of the narrow interval.
    ends: &'a Ends,
    /// eps in units of v, as a fraction that is not rounded.
    error: Rational,
    region: &'a Region,
    index: &'a [usize],
    vanishing: &'a [usize],
}

impl NullVectorCandidate<'_> {
    /// Demands the signs of x and y that the outcome states.
    fn check_outcome(&self, outcome: &RootOutcome) -> Result<(), CoverFault> {
        match *outcome {
            RootOutcome::Solution => self.check_solution(),
            RootOutcome::NegativeX(stated) => {
                let support = &self.witness.support;
                match support.iter().position(|&i| self.index[i] == stated) {
                    Some(p) if self.x_sign(p) == -1 => Ok(()),
                    _ => Err(sign_fault("x", stated, "< 0")),
                }
            }
            RootOutcome::NegativeY(stated) => {
                let is_at_zero = |i: &usize| self.region.states[*i] == VariableState::AtZero;
                let at_zero = self.index.iter().position(|&i| i == stated);
                match at_zero.filter(is_at_zero) {
                    Some(i) if self.y_sign(i) == -1 => Ok(()),
                    _ => Err(sign_fault("y", stated, "< 0")),
                }
            }
            // `check` has returned before for these.
            RootOutcome::Claim(_) | RootOutcome::Absent | RootOutcome::Infinity(_) => Ok(()),
        }
    }

    /// Demands x > 0 and y > 0, but no sign of y where it vanishes.
    fn check_solution(&self) -> Result<(), CoverFault> {
        for (p, &i) in self.witness.support.iter().enumerate() {
            if self.x_sign(p) != 1 {
                return Err(sign_fault("x", self.index[i], "> 0"));
            }
        }

        for i in self
            .region
            .positions(|state| state == VariableState::AtZero)
        {
            let needs_sign = !self.vanishing.contains(&self.index[i]);
            if needs_sign && self.y_sign(i) != 1 {
                return Err(sign_fault("y", self.index[i], "> 0"));
            }
        }

        Ok(())
    }

    /// Certain sign of component p of v_true; that of the pivot is 1.
    fn x_sign(&self, p: usize) -> i8 {
        if p == self.witness.order() {
            return 1;
        }

        let x = Ball {
            center: &self.witness.v[p] * self.error.denom(),
            radius: self.error.numer().clone(),
        };
        x.sign()
    }

    /// Certain sign of row i of T v_true over the interval.
    fn y_sign(&self, i: usize) -> i8 {
        let [lower, upper] = self.ends.at.each_ref().map(|end| {
            let line = self.witness.line(end, i);
            let mut y = self.witness.times_v(&line);

            // Every component of v_true but the pivot's is within the error of that of v.
            let mut reach = Integer::zero();
            for (m, r) in &line[..self.witness.order()] {
                reach += m.abs() + *r;
            }

            y.center *= self.error.denom();
            y.radius = y.radius * self.error.denom() + reach * self.error.numer();
            y.sign()
        });
        if lower == upper { lower } else { 0 }
    }
}

pub(super) fn sign_fault(
    component: &'static str,
    index: usize,
    expected: &'static str,
) -> CoverFault {
    CoverFault::Sign {
        component,
        index,
        expected,
    }
}

#[cfg(test)]
mod tests;
