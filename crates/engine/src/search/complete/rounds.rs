//! The rounds of a search: every open leaf, then what the checker refuses, with more caution.
//!
//! 1. All open leaves are searched, and the checker reads the certificate.
//! 2. Leaves that it refuses are searched again with larger remainders, [`CAUTIOUS_ROUNDS`] times
//!    at most, because rounding errors in doubles have misled the search.
//! 3. What is still refused is decided support by support in exact arithmetic.
//! 4. Decided regions that stay open are tried in long numbers (`precise`).
//!
//! Called by `complete` and `resume`.

use super::audited::{Audited, audited};
use super::checkpoint::{Checkpoints, Snapshots, keep_solutions};
use super::error::CompleteError;
use super::given::Given;
use super::options::CompleteOptions;
use super::pieces::prepared::Prepared;
use super::precise;
use super::shares::Shares;
use super::splice::{Chosen, Pass, SearchedPiece, numbered};
use crate::run::{Watch, in_threads};
use mceip_check::certificate::{Certificate, CompleteSet};
use std::time::Instant;

/// Rounds of a search whose leaves were refused, each more cautious than the one before.
const CAUTIOUS_ROUNDS: usize = 2;

/// Refused leaves up to which exact arithmetic is asked.
const MAX_REFUSED: usize = 200;

/// A search under way.
pub(super) struct Rounds<'a> {
    pub(super) given: &'a Given<'a>,
    pub(super) options: &'a CompleteOptions,
    pub(super) prepared: Prepared,
}

impl Rounds<'_> {
    /// Searches all open leaves of a certificate. Only the first round tells the listener of its
    /// progress.
    pub(super) fn run(
        &mut self,
        certificate: Certificate,
        watch: &Watch<'_>,
    ) -> Result<Audited, CompleteError> {
        let begun = Instant::now();
        let mut audited = self.search(certificate, &Chosen::All, &Shares::new(*watch))?;

        // What was refused is open: that alone is searched again.
        let quiet = Shares::new(watch.quiet());
        for _ in 0..CAUTIOUS_ROUNDS {
            let is_done = audited.refused.is_empty() || watch.is_cancelled();
            if is_done || !self.prepared.enlarge_remainders() {
                break;
            }

            self.keep(&audited, watch, begun);
            let certificate = audited.proved.into_certificate();
            audited = self.search(certificate, &Chosen::Again(audited.refused), &quiet)?;
        }

        let is_few = !audited.refused.is_empty() && audited.refused.len() <= MAX_REFUSED;
        if is_few && !watch.is_cancelled() {
            self.keep(&audited, watch, begun);
            let certificate = audited.proved.into_certificate();
            audited = self.search(certificate, &Chosen::Exactly(audited.refused), &quiet)?;
        }

        if !watch.is_cancelled() && audited.open_count() > 0 {
            self.keep(&audited, watch, begun);
            audited = self.with_long_numbers(audited);
        }

        // What is read off it for reports may take long too.
        self.keep(&audited, watch, begun);
        Ok(audited)
    }

    /// Keeps what the checker has accepted so far, of a search that has gone on for long.
    fn keep(&self, audited: &Audited, watch: &Watch<'_>, begun: Instant) {
        if let Some(keeper) = watch.keeper()
            && begun.elapsed() >= keeper.every
        {
            keep_solutions(&keeper, self.given.problem, &audited.proved);
        }
    }

    /// One pass over the chosen open leaves, and what the checker says of the result.
    fn search(
        &self,
        mut certificate: Certificate,
        chosen: &Chosen,
        shares: &Shares<'_>,
    ) -> Result<Audited, CompleteError> {
        let set = certificate.complete_set.take();
        let set = set.ok_or(CompleteError::NoCompleteSet)?;
        let keeper = shares.keeper();
        let snapshots = keeper.map(|_| Snapshots::new(set.pieces.len()));
        let pass = Pass {
            given: self.given,
            prepared: &self.prepared,
            set: &set,
            options: self.options,
            chosen,
            shares,
            snapshots: snapshots.as_ref(),
        };

        let work = || in_threads(self.options.threads, || pass.run());
        let found = match (keeper, &snapshots) {
            (Some(keeper), Some(snapshots)) => {
                let checkpoints = Checkpoints {
                    problem: self.given.problem,
                    keeper,
                    set: &set,
                    claims: &certificate.claims,
                    snapshots,
                };
                checkpoints.during(work)
            }
            _ => work(),
        };

        let mut pieces = Vec::with_capacity(set.pieces.len());
        for (piece, searched) in set.pieces.iter().zip(found) {
            let claims = &mut certificate.claims;
            pieces.push(numbered(piece, searched.items, claims));
        }

        certificate.complete_set = Some(CompleteSet {
            condensation: set.condensation,
            pieces,
        });
        audited(certificate, self.given.problem)
    }

    /// Lets long numbers decide open regions, if fewer stay open according to the checker.
    fn with_long_numbers(&self, before: Audited) -> Audited {
        let certificate = before.proved.certificate();
        let longer = precise::closed(self.given, &self.prepared, certificate);
        let Some(longer) = longer else {
            return before;
        };

        match audited(longer, self.given.problem) {
            Ok(after) if after.open_count() < before.open_count() => after,
            _ => before,
        }
    }
}

/// Does a search leave regions open in the pieces next to the lower end of the window?
pub(super) fn is_open_below(
    given: &Given<'_>,
    options: &CompleteOptions,
    prepared: &Prepared,
    watch: &Watch<'_>,
) -> bool {
    let lower_pieces = 0..prepared.count_of_lower_pieces(given.window());
    let chosen = Chosen::Again(lower_pieces.clone().map(|piece| (piece, 0)).collect());
    let found = first_look(given, options, prepared, &chosen, watch);
    found[lower_pieces].iter().any(SearchedPiece::is_open)
}

/// The values of the null vectors that a first search of an open cover meets, ascending.
pub(super) fn values_met(
    given: &Given<'_>,
    options: &CompleteOptions,
    prepared: &Prepared,
    watch: &Watch<'_>,
) -> Vec<f64> {
    let found = first_look(given, options, prepared, &Chosen::All, watch);
    let mut values: Vec<f64> = found.into_iter().flat_map(|piece| piece.met).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Searches an open cover, and tells nobody.
fn first_look(
    given: &Given<'_>,
    options: &CompleteOptions,
    prepared: &Prepared,
    chosen: &Chosen,
    watch: &Watch<'_>,
) -> Vec<SearchedPiece> {
    let pass = Pass {
        given,
        prepared,
        set: &prepared.open_set(),
        options,
        chosen,
        shares: &Shares::new(watch.quiet()),
        snapshots: None,
    };

    in_threads(options.threads, || pass.run())
}
