//! Many starts, each certified: embed, solve, certify, list once. What section 4 does with PATH.

use crate::candidate::Candidate;
use crate::certificate::Claim;
use crate::certify::{NotCertified, certify};
use crate::exact::{Algebraic, Interval, Poly, to_f64};
use crate::model::{Admissible, ModelError, Pencil, Unknown, Window};
use crate::reduction::{CondensationError, Embedding, Expansion, Side, condense};
use crate::solver::{Options, Outcome, SolverError, Termination, solve};
use crate::tolerance::{SAME_POINT, WINDOW_GAP};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// How to search.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Starts on the whole window.
    pub starts: usize,
    /// Starts above and below each value found (zeta of section 4); 0 for none.
    pub window_starts: usize,
    /// Values around which windows are opened, at most: a singular pencil has a continuum of them.
    pub window_limit: usize,
    /// Further origins from which values above are sought.
    pub origins: Vec<f64>,
    /// Seed of the random starts.
    pub seed: u64,
    /// Options of each run.
    pub options: Options,
}

impl Default for Search {
    fn default() -> Self {
        Search { starts: 22, window_starts: 4, window_limit: 16, origins: Vec::new(), seed: 1, options: Options::default() }
    }
}

/// A point whose residuals were small but which could not be certified.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertified {
    /// The point.
    pub candidate: Candidate,
    /// Why.
    pub reason: NotCertified,
}

/// A certified solution and the start that led to it first.
#[derive(Debug, Clone, PartialEq)]
pub struct Certified {
    /// The claim for the certificate.
    pub claim: Claim,
    /// The candidate it was made from.
    pub candidate: Candidate,
    /// Number of the run, from 0.
    pub run: usize,
}

/// What a search found. It never says that nothing else exists.
#[derive(Debug, Clone, Default)]
pub struct Found {
    /// Distinct certified solutions, by value.
    pub certified: Vec<Certified>,
    /// Distinct candidates that stayed uncertified.
    pub uncertified: Vec<Uncertified>,
    /// Candidates outside the window (a search downwards may leave it): counted, not certified.
    pub outside: usize,
    /// Candidates equal to an earlier one within rounding ([`SAME_POINT`]).
    pub repeated: usize,
    /// How often each reason ended a run.
    pub terminations: BTreeMap<Termination, usize>,
    /// Runs made.
    pub runs: usize,
    /// Pivots made.
    pub pivots: usize,
    /// Was the search ended by its progress callback?
    pub interrupted: bool,
    /// Outcome of the very first run.
    pub first: Option<Outcome>,
}

/// Searches for solutions in the window: plain starts, then above and below each value found.
///
/// # Errors
/// [`SolverError`] for options out of range.
pub fn multistart(admissible: &Admissible<'_>, window: &Window, search: &Search) -> Result<Found, SolverError> {
    multistart_with(
        admissible,
        window,
        search,
        &|candidate| certify(admissible.pencil(), window, candidate),
        &|_| ControlFlow::Continue(()),
    )
}

/// Free variables from which MCEIP-mu is searched on its exactly condensed pencil.
pub const CONDENSE_FROM: usize = 12;

/// Why a search did not take place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The solver's options were refused.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The condensation failed.
    #[error(transparent)]
    Condensation(#[from] CondensationError),
    /// The condensed pencil was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// K_ff is singular in doubles.
    #[error("P1: expected K_ff regular in doubles, got a singular factorisation")]
    SingularInDoubles,
}

/// [`multistart`] for pencils of any size: MCEIP-mu with many free variables is condensed exactly,
/// searched on its slip variables, and *certified on the given pencil*, not on the condensed one.
///
/// # Errors
/// [`SearchError`].
pub fn multistart_large(
    admissible: &Admissible<'_>,
    window: &Window,
    search: &Search,
    progress: &Progress<'_>,
) -> Result<(Found, Option<Pencil>), SearchError> {
    let pencil = admissible.pencil();
    let direct = |c: &Candidate| certify(pencil, window, c);
    if admissible.unknown() != Unknown::Mu || pencil.free().len() < CONDENSE_FROM {
        return Ok((multistart_with(admissible, window, search, &direct, progress)?, None));
    }
    let condensed = condense(admissible)?;
    let expansion = Expansion::new(pencil).ok_or(SearchError::SingularInDoubles)?;
    let small = Admissible::new(&condensed, Unknown::Mu)?;
    let found = multistart_with(&small, window, search, &|c| direct(&expansion.expand(c)), progress)?;
    Ok((found, Some(condensed)))
}

/// Told after each run what has been found; breaking ends the search and keeps it.
pub type Progress<'a> = dyn Fn(&Found) -> ControlFlow<()> + 'a;

/// What turns a candidate into a claim: [`multistart_with`] takes any, so that a condensed pencil
/// can be searched and the claim made about the full one.
pub type Certifier<'a> = dyn Fn(&Candidate) -> Result<Claim, NotCertified> + 'a;

/// [`multistart`] with a certifier of one's own.
///
/// # Errors
/// As [`multistart`].
pub fn multistart_with(
    admissible: &Admissible<'_>,
    window: &Window,
    search: &Search,
    certifier: &Certifier<'_>,
    progress: &Progress<'_>,
) -> Result<Found, SolverError> {
    let mut found = Found::default();
    let bottom = to_f64(window.min());
    let mut hunt = Hunt { admissible, window, search, certifier, progress, found: &mut found };
    for (k, origin) in [bottom].into_iter().chain(search.origins.iter().copied()).enumerate() {
        hunt.side(Side::Above(origin), search.starts, k as u64)?;
    }
    let mut treated = 0;
    while treated < hunt.found.certified.len().min(search.window_limit) && search.window_starts > 0 {
        let value = hunt.found.certified[treated].candidate.value;
        // Strictly on either side: at the value itself the solution found would be found again.
        let gap = WINDOW_GAP * (1.0 + value.abs());
        hunt.side(Side::Above(value + gap), search.window_starts, 1000 + 2 * treated as u64)?;
        hunt.side(Side::Below(value - gap), search.window_starts, 1001 + 2 * treated as u64)?;
        treated += 1;
    }
    found.certified.sort_by(|a, b| a.candidate.value.total_cmp(&b.candidate.value).then_with(|| support(&a.claim).cmp(support(&b.claim))));
    Ok(found)
}

/// Is `b` the same point as `a` within rounding, in any scale of x?
fn repeats(a: &Candidate, b: &Candidate) -> bool {
    let norm = |c: &Candidate| c.x.iter().map(|v| v.abs()).sum::<f64>();
    let (na, nb) = (norm(a), norm(b));
    (a.value - b.value).abs() <= SAME_POINT * (1.0 + a.value.abs())
        && a.x.len() == b.x.len()
        && a.x.iter().zip(&b.x).all(|(p, q)| (p / na - q / nb).abs() <= SAME_POINT)
}

struct Hunt<'a> {
    admissible: &'a Admissible<'a>,
    window: &'a Window,
    search: &'a Search,
    certifier: &'a Certifier<'a>,
    progress: &'a Progress<'a>,
    found: &'a mut Found,
}

impl Hunt<'_> {
    fn side(&mut self, side: Side, starts: usize, salt: u64) -> Result<(), SolverError> {
        let embedding = Embedding::new(self.admissible, side);
        for start in embedding.starts(starts, self.search.seed.wrapping_add(salt)) {
            if self.found.interrupted {
                return Ok(());
            }
            let outcome = solve(&embedding, &start, &self.search.options)?;
            *self.found.terminations.entry(outcome.termination).or_default() += 1;
            self.found.pivots += outcome.counters.pivots;
            let run = self.found.runs;
            self.found.runs += 1;
            if outcome.termination.reached_tolerance() {
                self.file(embedding.candidate(&outcome.point), run);
            }
            self.found.first.get_or_insert(outcome);
            self.found.interrupted = (self.progress)(self.found).is_break();
        }
        Ok(())
    }

    /// Certifies a candidate and lists it, once.
    fn file(&mut self, candidate: Candidate, run: usize) {
        let slack = WINDOW_GAP * (1.0 + candidate.value.abs());
        if candidate.value < to_f64(self.window.min()) - slack || self.window.max().is_some_and(|m| candidate.value > to_f64(m) + slack) {
            self.found.outside += 1;
            return;
        }
        let certified = self.found.certified.iter().map(|c| &c.candidate);
        if certified.chain(self.found.uncertified.iter().map(|u| &u.candidate)).any(|c| repeats(c, &candidate)) {
            self.found.repeated += 1;
            return;
        }
        match (self.certifier)(&candidate) {
            Ok(claim) => {
                if !self.found.certified.iter().any(|c| same(&c.claim, &claim)) {
                    self.found.certified.push(Certified { claim, candidate, run });
                }
            }
            Err(reason) => self.found.uncertified.push(Uncertified { candidate, reason }),
        }
    }
}

/// The support of a claim.
pub fn support(claim: &Claim) -> &[usize] {
    match claim {
        Claim::ExactSolution(c) => &c.support,
        Claim::EnclosedSolution(c) => &c.support,
    }
}

/// The exact value of an exact claim.
pub fn exact_value(claim: &Claim) -> Option<Algebraic> {
    match claim {
        Claim::ExactSolution(c) => {
            let interval = Interval::new(c.interval[0].0.clone(), c.interval[1].0.clone())?;
            Some(Algebraic::from_claim(Poly::new(c.polynomial.clone()), interval))
        }
        Claim::EnclosedSolution(_) => None,
    }
}

/// Do two claims speak of the same solution: same support and equal value (exact), or a box that
/// holds the other's centre (each box holds exactly one solution of its support)?
pub fn same(a: &Claim, b: &Claim) -> bool {
    if support(a) != support(b) {
        return false;
    }
    match (a, b) {
        (Claim::EnclosedSolution(a), Claim::EnclosedSolution(b)) => {
            let inside = |k: usize| {
                let (d, r) = (&a.center[k].0 - &b.center[k].0, &a.radius[k].0);
                &d <= r && -d <= *r
            };
            a.center.len() == b.center.len() && (0..a.center.len()).all(inside)
        }
        _ => match (exact_value(a), exact_value(b)) {
            (Some(mut a), Some(mut b)) => a.equals(&mut b),
            _ => false,
        },
    }
}
