//! The claims that a candidate suggests, unchecked, for each support tried.
//!
//! Where the system of the support is short, an exact number can be had, else a box. A search that
//! wants claims at the least cost has a box first on a support of more than a few variables, and an
//! exact number only where the box proves nothing ([`Preference`]).
//!
//! Supports come from [`support`]: guesses by thresholds, best first, and repairs of those at which
//! a sign is wrong. Input: the reduced pencil, the window of the problem, a candidate in doubles.
//! Called by [`Certifier`](super::Certifier), which has the checker decide.

use super::failure::{AttemptFailure, NotCertified, SupportAttempt};
use super::rows::IntegralRows;
use super::{enclose, exact_claim, support};
use crate::candidate::Candidate;
use mceip_check::certificate::Claim;
use mceip_model::{Pencil, Window};
use std::collections::VecDeque;

/// Largest number of active variables for which an exact claim is attempted; above, enclosures.
/// Exact algebraic numbers of higher degree cost more than they tell.
pub const EXACT_ORDER: usize = 16;

/// Largest number of active variables for which an exact claim is attempted before an enclosure,
/// unless [`Preference::Exact`] is asked for.
pub const EXACT_FIRST_ORDER: usize = 6;

/// Supports that are tried beyond the guesses, at most: each has one component more or less.
const MAX_REPAIRS: usize = 16;

/// Largest size, in bits, of a determinant for which an exact claim is attempted.
pub const EXACT_BITS: u64 = 4096;

/// Largest number of active variables for which an enclosure is attempted: it needs dense inverses.
pub const ENCLOSED_ORDER: usize = 3000;

/// Which form of claim is tried first on a support whose system is short.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preference {
    /// An exact number up to [`EXACT_FIRST_ORDER`] active variables, above that a box.
    #[default]
    Cheapest,
    /// An exact number.
    Exact,
}

/// The form of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ClaimForm {
    Exact,
    Enclosed,
}

/// A support to be tried with this form of claim.
struct WaitingSupport {
    support: Vec<usize>,
    form: ClaimForm,
}

/// A claim for one support, or what failed on it.
pub(super) struct Proposal {
    pub(super) support: Vec<usize>,
    pub(super) claim: Result<Claim, AttemptFailure>,
}

/// The claims that a candidate suggests, one per support that its components suggest, best first.
///
/// They are made when they are asked for: the first one is accepted in general. Where a sign is
/// wrong at a component that doubles cannot tell from zero, the support with that component changed
/// comes next (for enclosures: exact claims have the support that was guessed).
pub(super) struct Proposals<'a> {
    pencil: &'a Pencil,
    rows: &'a IntegralRows,
    window: &'a Window,
    candidate: &'a Candidate,
    preference: Preference,
    /// What is to be tried, the next one first.
    waiting: VecDeque<WaitingSupport>,
    guesses: Vec<Vec<usize>>,
    /// Supports that come from another one, by a component that doubles cannot tell from zero.
    repaired: Vec<Vec<usize>>,
}

/// The proposals for a candidate in a window.
///
/// # Errors
/// A candidate that is of another length than the pencil's order, not finite, or zero.
pub(super) fn proposals<'a>(
    pencil: &'a Pencil,
    rows: &'a IntegralRows,
    window: &'a Window,
    candidate: &'a Candidate,
    preference: Preference,
) -> Result<Proposals<'a>, NotCertified> {
    let guesses = support::guesses(pencil, candidate).map_err(NotCertified::of)?;
    let mut proposals = Proposals {
        pencil,
        rows,
        window,
        candidate,
        preference,
        waiting: VecDeque::new(),
        guesses: guesses.clone(),
        repaired: Vec::new(),
    };
    for support in guesses {
        let form = proposals.first_form(&support);
        proposals
            .waiting
            .push_back(WaitingSupport { support, form });
    }

    Ok(proposals)
}

impl Proposals<'_> {
    /// The form of claim that is tried first on a support.
    fn first_form(&self, support: &[usize]) -> ClaimForm {
        let exact_comes_first = match self.preference {
            Preference::Exact => true,
            Preference::Cheapest => self.active_order(support) <= EXACT_FIRST_ORDER,
        };
        if exact_comes_first && self.is_short(support) {
            ClaimForm::Exact
        } else {
            ClaimForm::Enclosed
        }
    }

    /// A claim about the solution with this support near the candidate.
    fn claim(&self, waiting: &WaitingSupport) -> Result<Claim, AttemptFailure> {
        let WaitingSupport { support, form } = waiting;
        let order = self.active_order(support);
        if order > ENCLOSED_ORDER {
            return Err(AttemptFailure::TooLarge {
                limit: ENCLOSED_ORDER,
                got: order,
            });
        }

        if *form == ClaimForm::Exact {
            let claim =
                exact_claim::make(self.pencil, self.rows, self.window, support, self.candidate)?;
            return Ok(Claim::ExactSolution(claim));
        }

        let claim = enclose::make(self.pencil, self.rows, self.window, support, self.candidate)?;
        if self.repaired.iter().any(|repaired| repaired == support) {
            support::require_within_rounding(self.pencil, self.candidate, &claim)?;
        }

        Ok(Claim::EnclosedSolution(claim))
    }

    /// Number of active variables.
    fn active_order(&self, support: &[usize]) -> usize {
        self.pencil.free().len() + support.len()
    }

    /// Is the system of this support short enough for an exact claim?
    fn is_short(&self, support: &[usize]) -> bool {
        let order = self.active_order(support);
        if order > EXACT_ORDER {
            return false;
        }

        // A determinant has about so many bits.
        let bits = order as u64 * self.rows.bits();
        bits <= EXACT_BITS
    }

    /// Puts the support with the component of a wrong sign changed next, where claims about it are
    /// enclosures.
    fn repair(&mut self, support: &[usize], failure: &AttemptFailure) {
        let repaired = support::repaired(self.pencil, self.candidate, support, failure);
        let Some(repaired) = repaired else { return };

        let was_guessed = self.guesses.contains(&repaired);
        let was_repaired = self.repaired.contains(&repaired);
        if was_guessed || was_repaired || self.repaired.len() >= MAX_REPAIRS {
            return;
        }
        if self.is_short(&repaired) {
            return;
        }

        self.repaired.push(repaired.clone());
        self.waiting.push_front(WaitingSupport {
            support: repaired,
            form: ClaimForm::Enclosed,
        });
    }
}

impl Iterator for Proposals<'_> {
    type Item = Proposal;

    fn next(&mut self) -> Option<Proposal> {
        let waiting = self.waiting.pop_front()?;
        let claim = self.claim(&waiting);
        let WaitingSupport { support, form } = waiting;
        if form == ClaimForm::Enclosed && self.is_short(&support) {
            // Comes next unless this claim is accepted.
            self.waiting.push_front(WaitingSupport {
                support: support.clone(),
                form: ClaimForm::Exact,
            });
        }
        if let Err(failure) = &claim {
            self.repair(&support, failure);
        }

        Some(Proposal { support, claim })
    }
}

/// A claim that *nobody has checked*, for tools and tests that submit it themselves;
/// [`certify`](super::certify) is what to call.
///
/// `pencil` is the reduced pencil of the problem in whose window the value must lie.
///
/// # Errors
/// [`NotCertified`] with every attempt and what failed in it.
pub fn propose(
    pencil: &Pencil,
    window: &Window,
    candidate: &Candidate,
) -> Result<Claim, NotCertified> {
    let rows = IntegralRows::of(pencil);
    let mut attempts = Vec::new();
    for Proposal { support, claim } in
        proposals(pencil, &rows, window, candidate, Preference::Exact)?
    {
        match claim {
            Ok(claim) => return Ok(claim),
            Err(failure) => attempts.push(SupportAttempt { support, failure }),
        }
    }

    Err(NotCertified { attempts })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Integer, Rational, Sparse, rational, whole};

    /// -`entry` I + tI.
    fn diagonal(n: usize, entry: &Rational) -> Pencil {
        let a = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, -entry.clone())));
        Pencil::new(a, Sparse::identity(n), vec![]).unwrap()
    }

    /// -P + tI with P the cyclic shift: the null vector at t = 1 is the only one.
    fn cycle(n: usize) -> Pencil {
        let a = Sparse::from_entries(n, n, (0..n).map(|i| (i, (i + 1) % n, whole(-1))));
        Pencil::new(a, Sparse::identity(n), vec![]).unwrap()
    }

    /// A number near 1 whose numerator has `bits` - 1 bits.
    fn long_number(bits: u64) -> Rational {
        rational(1, 1) + Rational::new(1.into(), Integer::from(1) << (bits - 2))
    }

    /// The kind of claim that is proposed at value 1 for equal components of x.
    fn kind(pencil: &Pencil) -> &'static str {
        let n = pencil.order();
        let candidate = Candidate {
            value: 1.0,
            x: vec![1.0 / n as f64; n],
        };
        let refused = match propose(pencil, &Window::all(), &candidate) {
            Ok(Claim::ExactSolution(_)) => return "exact",
            Ok(_) => return "enclosed",
            Err(refused) => refused,
        };
        match refused.attempts.last().map(|attempt| &attempt.failure) {
            Some(AttemptFailure::TooLarge { .. }) => "too large",
            _ => "refused",
        }
    }

    /// The forms of claims that are tried at value 1 on the cycle of n variables, all of which a
    /// checker refuses.
    fn forms(n: usize, preference: Preference) -> Vec<&'static str> {
        let pencil = cycle(n);
        let rows = IntegralRows::of(&pencil);
        let candidate = Candidate {
            value: 1.0,
            x: vec![1.0; n],
        };
        let window = Window::all();
        let tried = proposals(&pencil, &rows, &window, &candidate, preference).unwrap();
        let claims = tried.filter_map(|proposal| proposal.claim.ok());
        let forms = claims.map(|claim| match claim {
            Claim::ExactSolution(_) => "exact",
            _ => "enclosed",
        });
        forms.collect()
    }

    #[test]
    fn the_cheaper_form_is_tried_first_and_the_exact_one_after_a_box() {
        assert_eq!(forms(EXACT_FIRST_ORDER, Preference::Cheapest), ["exact"]);
        assert_eq!(
            forms(EXACT_FIRST_ORDER + 1, Preference::Cheapest),
            ["enclosed", "exact"]
        );
        assert_eq!(forms(EXACT_FIRST_ORDER + 1, Preference::Exact), ["exact"]);
        assert_eq!(forms(EXACT_ORDER + 1, Preference::Exact), ["enclosed"]);
    }

    /// Small supports of short numbers are solved exactly; order times bits decides, and the order
    /// alone.
    #[test]
    fn the_kind_of_a_claim_follows_the_size() {
        let short = diagonal(1, &long_number(100));
        let longest = diagonal(1, &long_number(EXACT_BITS));
        let too_long = diagonal(1, &long_number(EXACT_BITS + 3));
        assert_eq!(IntegralRows::of(&diagonal(2, &long_number(100))).bits(), 99);
        assert_eq!([kind(&short), kind(&longest)], ["exact", "exact"]);
        assert_eq!(kind(&too_long), "enclosed");

        // Two variables on one cycle, so that the null vector is the only one.
        let half = long_number(EXACT_BITS / 2 + 10);
        let a = Sparse::from_entries(2, 2, [(0, 1, -half.clone()), (1, 0, -half)]);
        let too_long_together = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        assert_eq!(kind(&too_long_together), "enclosed");

        assert_eq!(kind(&cycle(EXACT_ORDER)), "exact");
        assert_eq!(kind(&cycle(EXACT_ORDER + 1)), "enclosed");
        let too_large = diagonal(ENCLOSED_ORDER + 2, &whole(1));
        assert_eq!(kind(&too_large), "too large");
    }
}
