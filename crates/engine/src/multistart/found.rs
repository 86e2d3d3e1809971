//! What a search has found: certified solutions, candidates that stayed uncertified, and counts of
//! the work.
//!
//! Filled by [`Hunt`](super::hunt::Hunt) while a search goes on, and returned to the caller of
//! [`multistart`](super::multistart).

use super::same::{repeats, same, support};
use crate::candidate::Candidate;
use crate::certify::NotCertified;
use crate::tolerance::WINDOW_GAP;
use mceip_check::certificate::Claim;
use mceip_mcp::solver::{CurveEnd, Outcome, Termination};
use std::collections::{BTreeMap, BTreeSet};

/// A point whose residuals were small but which could not be certified.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertified {
    /// The point.
    pub candidate: Candidate,
    /// Why.
    pub reason: NotCertified,
}

/// A certified solution (the checker has accepted its claim) and the start that led to it first.
#[derive(Debug, Clone, PartialEq)]
pub struct CertifiedCandidate {
    /// The claim for the certificate; where the value is below 0, for its part `negative`.
    pub claim: Claim,
    /// The candidate it was made from.
    pub candidate: Candidate,
    /// Number of the run, from 0.
    pub run: usize,
    /// What kind of run.
    pub origin: Origin,
}

/// The kinds of runs of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// A run of the solver from a start.
    Start,
    /// A curve of the Newton homotopy from a start.
    Curve,
    /// A curve through a solution found before.
    Departure,
}

/// What a search found. It never says that nothing else exists.
#[derive(Debug, Clone, Default)]
pub struct MultistartFound {
    /// Distinct certified solutions, by value.
    pub certified: Vec<CertifiedCandidate>,
    /// Distinct candidates that stayed uncertified.
    pub uncertified: Vec<Uncertified>,
    /// Candidates outside the window (a search downwards may leave it): counted, not certified.
    pub outside: usize,
    /// Candidates equal to an earlier one within rounding
    /// ([`SAME_POINT`](crate::tolerance::SAME_POINT)).
    pub repeated: usize,
    /// Certified points on supports that are singular at all values: counted, not listed, once as
    /// many values are listed as prove that.
    pub on_continua: usize,
    /// Points of curves that are a known solution within rounding: not polished again.
    pub met_again: usize,
    /// How often each reason ended a run of the solver, also those that polish a point of a curve.
    pub terminations: BTreeMap<Termination, usize>,
    /// How often each reason ended a curve.
    pub curves: BTreeMap<CurveEnd, usize>,
    /// Runs and curves made.
    pub runs: usize,
    /// Pivots made.
    pub pivots: usize,
    /// Dense factorisations made.
    pub factorisations: usize,
    /// The log of every run and curve, if it was asked for.
    pub trace: Vec<String>,
    /// Runs from starts, and their pivots and factorisations in all.
    pub plain: (usize, usize),
    /// Was the search cancelled?
    pub interrupted: bool,
    /// Outcome of the very first run.
    pub first: Option<Outcome>,
}

impl MultistartFound {
    /// Together with what was found of the reflected problem: values change their sign, counts are
    /// added, and runs are numbered on.
    #[must_use]
    pub fn with_reflected(mut self, reflected: MultistartFound) -> MultistartFound {
        for mut found in reflected.certified {
            found.candidate = found.candidate.reflected();
            found.run += self.runs;
            self.certified.push(found);
        }
        self.certified
            .sort_by(|p, q| p.candidate.value.total_cmp(&q.candidate.value));

        for mut point in reflected.uncertified {
            point.candidate = point.candidate.reflected();
            self.uncertified.push(point);
        }
        for (end, count) in reflected.terminations {
            *self.terminations.entry(end).or_default() += count;
        }
        for (end, count) in reflected.curves {
            *self.curves.entry(end).or_default() += count;
        }

        self.outside += reflected.outside;
        self.repeated += reflected.repeated;
        self.on_continua += reflected.on_continua;
        self.met_again += reflected.met_again;
        self.runs += reflected.runs;
        self.pivots += reflected.pivots;
        self.factorisations += reflected.factorisations;
        self.plain.0 += reflected.plain.0;
        self.plain.1 += reflected.plain.1;
        self.trace.extend(reflected.trace);
        self.interrupted |= reflected.interrupted;
        self
    }

    /// Is `candidate` the same point as one that was found, certified or not, within rounding?
    pub fn knows(&self, candidate: &Candidate) -> bool {
        let certified = self.certified.iter().map(|entry| &entry.candidate);
        let uncertified = self.uncertified.iter().map(|entry| &entry.candidate);
        let mut known = certified.chain(uncertified);
        known.any(|known| repeats(known, candidate))
    }

    /// The supports of which more values are certified than a determinant of their order has roots,
    /// as far as doubles tell the values apart: it vanishes identically, and every value is an
    /// eigenvalue. `free` is the number of free variables.
    pub fn singular_supports(&self, free: usize) -> Vec<Vec<usize>> {
        let supports = self.certified.iter().map(|entry| support(&entry.claim));
        let supports: BTreeSet<&[usize]> = supports.collect();
        let singular = supports.into_iter().filter(|s| self.is_singular(s, free));
        singular.map(<[usize]>::to_vec).collect()
    }

    /// Is this one of them? Values within [`WINDOW_GAP`] count as one.
    pub(super) fn is_singular(&self, support: &[usize], free: usize) -> bool {
        let mut values: Vec<f64> = Vec::new();
        for entry in &self.certified {
            let value = entry.candidate.value;
            let is_near = |v: &f64| (v - value).abs() <= WINDOW_GAP * (1.0 + value.abs());
            if super::support(&entry.claim) == support && !values.iter().any(is_near) {
                values.push(value);
            }
        }

        values.len() > support.len() + free
    }

    /// Lists a candidate with its claim, unless the same solution is listed, or with the reason why
    /// it has none.
    pub fn file(
        &mut self,
        candidate: Candidate,
        claim: Result<Claim, NotCertified>,
        run: usize,
        origin: Origin,
    ) {
        let claim = match claim {
            Ok(claim) => claim,
            Err(reason) => {
                self.uncertified.push(Uncertified { candidate, reason });
                return;
            }
        };

        let mut listed = self.certified.iter().map(|entry| &entry.claim);
        let is_listed = listed.any(|listed| same(listed, &claim));
        if !is_listed {
            self.certified.push(CertifiedCandidate {
                claim,
                candidate,
                run,
                origin,
            });
        }
    }
}
