//! The claims that a candidate suggests, unchecked, one for each support tried: exact where the
//! system of the support is short, else an enclosure.

use super::failure::{Attempt, AttemptFailure, NotCertified};
use super::rows::IntegralRows;
use super::{enclose, exact_claim, support};
use crate::candidate::Candidate;
use mceip_check::certificate::Claim;
use mceip_model::{Pencil, Window};
use std::collections::VecDeque;

/// Largest number of active variables for which an exact claim is attempted; above, enclosures.
/// Exact algebraic numbers of higher degree cost more than they tell.
pub const EXACT_ORDER: usize = 16;

/// Supports that are tried beyond the guesses, at most: each has one component more or less.
const MAX_REPAIRS: usize = 16;

/// Largest size, in bits, of a determinant for which an exact claim is attempted.
pub const EXACT_BITS: u64 = 4096;

/// Largest number of active variables for which an enclosure is attempted: it needs dense inverses.
pub const ENCLOSED_ORDER: usize = 3000;

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
    waiting: VecDeque<Vec<usize>>,
    guesses: Vec<Vec<usize>>,
    /// Supports that come from another one, by a component that doubles cannot tell from zero.
    repaired: Vec<Vec<usize>>,
}

impl Proposals<'_> {
    /// Puts the support with the component of a wrong sign changed next, where claims about it are
    /// enclosures.
    pub(super) fn repair(&mut self, support: &[usize], failure: &AttemptFailure) {
        let Some(repaired) = support::repaired(self.pencil, self.candidate, support, failure)
        else {
            return;
        };
        let is_known = self.guesses.contains(&repaired) || self.repaired.contains(&repaired);
        if is_known
            || self.repaired.len() >= MAX_REPAIRS
            || is_short(self.pencil, self.rows, &repaired)
        {
            return;
        }
        self.repaired.push(repaired.clone());
        self.waiting.push_front(repaired);
    }
}

pub(super) fn proposals<'a>(
    pencil: &'a Pencil,
    rows: &'a IntegralRows,
    window: &'a Window,
    candidate: &'a Candidate,
) -> Result<Proposals<'a>, NotCertified> {
    let guesses = support::guesses(pencil, candidate).map_err(NotCertified::of)?;
    let waiting = guesses.iter().cloned().collect();
    Ok(Proposals {
        pencil,
        rows,
        window,
        candidate,
        waiting,
        guesses,
        repaired: Vec::new(),
    })
}

impl Iterator for Proposals<'_> {
    type Item = Proposal;

    fn next(&mut self) -> Option<Proposal> {
        let support = self.waiting.pop_front()?;
        let is_repaired = self.repaired.contains(&support);
        let mut claim = claim(
            self.pencil,
            self.rows,
            self.window,
            &support,
            self.candidate,
        );
        if is_repaired {
            claim = claim
                .and_then(|claim| support::within_rounding(self.pencil, self.candidate, claim));
        }

        if let Err(failure) = &claim {
            self.repair(&support, failure);
        }
        Some(Proposal { support, claim })
    }
}

/// A claim about the solution with this support near the candidate: exact where that is short, else
/// an enclosure.
fn claim(
    pencil: &Pencil,
    rows: &IntegralRows,
    window: &Window,
    support: &[usize],
    candidate: &Candidate,
) -> Result<Claim, AttemptFailure> {
    let order = pencil.free().len() + support.len();
    if order > ENCLOSED_ORDER {
        return Err(AttemptFailure::TooLarge {
            limit: ENCLOSED_ORDER,
            got: order,
        });
    }

    if is_short(pencil, rows, support) {
        exact_claim::make(pencil, rows, window, support, candidate).map(Claim::ExactSolution)
    } else {
        enclose::make(pencil, rows, window, support, candidate).map(Claim::EnclosedSolution)
    }
}

/// Is the system of this support short enough for an exact claim?
fn is_short(pencil: &Pencil, rows: &IntegralRows, support: &[usize]) -> bool {
    let order = pencil.free().len() + support.len();
    order <= EXACT_ORDER && order as u64 * rows.bits() <= EXACT_BITS
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
    for Proposal { support, claim } in proposals(pencil, &rows, window, candidate)? {
        match claim {
            Ok(claim) => return Ok(claim),
            Err(failure) => attempts.push(Attempt { support, failure }),
        }
    }
    Err(NotCertified { attempts })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Integer, Rational, Sparse, rational, whole};

    fn diagonal(n: usize, entry: &Rational) -> Pencil {
        let a = Sparse::from_entries(n, n, (0..n).map(|i| (i, i, -entry.clone())));
        Pencil::new(a, Sparse::identity(n), vec![]).unwrap()
    }

    fn kind(pencil: &Pencil, value: f64) -> &'static str {
        let n = pencil.order();
        let candidate = Candidate {
            value,
            x: vec![1.0 / n as f64; n],
        };
        match propose(pencil, &Window::all(), &candidate) {
            Ok(Claim::ExactSolution(_)) => "exact",
            Ok(_) => "enclosed",
            Err(e) if matches!(e.attempts.last(), Some(a) if matches!(a.failure, AttemptFailure::TooLarge { .. })) => {
                "too large"
            }
            Err(_) => "refused",
        }
    }

    /// Small supports of short numbers are solved exactly; order times bits decides, and the order
    /// alone.
    #[test]
    fn the_kind_of_a_claim_follows_the_size() {
        // B - 1 bits over b - 1.
        let bits = |b: u64| rational(1, 1) + Rational::new(1.into(), Integer::from(1) << (b - 2));
        assert_eq!(IntegralRows::of(&diagonal(2, &bits(100))).bits(), 99);
        assert_eq!(
            [
                kind(&diagonal(1, &bits(100)), 1.0),
                kind(&diagonal(1, &bits(EXACT_BITS)), 1.0)
            ],
            ["exact", "exact"]
        );
        assert_eq!(kind(&diagonal(1, &bits(EXACT_BITS + 3)), 1.0), "enclosed");
        // Two variables on one cycle, so that the null vector is the only one.
        let long = bits(EXACT_BITS / 2 + 10);
        let a = Sparse::from_entries(2, 2, [(0, 1, -long.clone()), (1, 0, -long)]);
        assert_eq!(
            kind(&Pencil::new(a, Sparse::identity(2), vec![]).unwrap(), 1.0),
            "enclosed"
        );
        let cycle = |n: usize| {
            let a = Sparse::from_entries(n, n, (0..n).map(|i| (i, (i + 1) % n, whole(-1))));
            Pencil::new(a, Sparse::identity(n), vec![]).unwrap()
        };
        assert_eq!(
            [
                kind(&cycle(EXACT_ORDER), 1.0),
                kind(&cycle(EXACT_ORDER + 1), 1.0)
            ],
            ["exact", "enclosed"]
        );
        assert_eq!(
            kind(&diagonal(ENCLOSED_ORDER + 2, &whole(1)), 1.0),
            "too large"
        );
    }
}
