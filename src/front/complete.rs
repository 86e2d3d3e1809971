//! All solutions, with a proof that there are no others.

use super::error::Error;
use super::problem::Problem;
use super::run::{Watched, watched_question};
use super::solution::Solution;
use crate::say;
use mceip_check::certificate::Certificate;
use mceip_check::{OpenRegion, Proved, SolutionFamily};
use mceip_engine::reduction::reversed;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json};
use mceip_engine::run::Kept;
use mceip_engine::search::complete::{CompleteOptions, Completed, Shard, complete, merge, resume};
use mceip_exact::Rational;
use mceip_model::reduction::reduce;
use mceip_model::{Reduced, Window};
use num_traits::Zero as _;
use serde_json::Value;
use std::fmt;
use std::sync::OnceLock;
use std::time::Duration;

/// A search for all solutions; see [`Problem::complete`].
pub struct Complete<'a> {
    problem: &'a Problem,
    earlier: Option<&'a Certificate>,
    options: CompleteOptions,
    watched: Watched<'a>,
}

/// All solutions in the problem's window, as far as they are proved. Its text says what is proved,
/// a line each.
#[derive(Debug, Clone)]
pub struct SolutionSet {
    problem: mceip_model::Problem,
    reduced: Reduced,
    completed: Completed,
    /// Made when it is first asked for: many digits may cost more than the proof.
    listed: OnceLock<(Vec<Solution>, Vec<Listed>)>,
}

impl SolutionSet {
    /// The problem that was searched.
    pub fn problem(&self) -> &mceip_model::Problem {
        &self.problem
    }

    fn new(problem: &mceip_model::Problem, completed: Completed) -> Result<SolutionSet, Error> {
        Ok(SolutionSet {
            reduced: reduce(problem)?,
            problem: problem.clone(),
            completed,
            listed: OnceLock::new(),
        })
    }

    /// The isolated solutions, by value.
    pub fn solutions(&self) -> &[Solution] {
        let (solutions, _) = self.listed();
        solutions
    }

    /// Continua of solutions: a support that has more than one at a value, or one at every value of
    /// an interval.
    pub fn families(&self) -> &[SolutionFamily] {
        &self.completed.cover.families
    }

    /// What is left open: intervals of values with variables not decided.
    pub fn open(&self) -> &[OpenRegion] {
        &self.completed.cover.open
    }

    /// Is it proved that there are no solutions but those of `solutions` and `families`?
    pub fn is_complete(&self) -> bool {
        self.completed.is_complete()
    }

    /// Is it proved that the window holds no solution?
    ///
    /// For lambda squared over the window [0, ∞) this excludes divergence of the form (8).
    pub fn is_empty(&self) -> bool {
        let cover = &self.completed.cover;
        self.is_complete() && cover.solutions.is_empty() && cover.families.is_empty()
    }

    /// The certificate, which the checker has accepted.
    pub fn certificate(&self) -> &Certificate {
        self.completed.proved.certificate()
    }

    /// The certificate with the checker's verdict; its [`Proved::file`] is what is written.
    pub fn proved(&self) -> &Proved<Certificate> {
        &self.completed.proved
    }

    /// The set as `mceip-solutions/1`.
    pub fn to_json(&self) -> Value {
        let cover = &self.completed.cover;
        let evidence = format!(
            "certificate of a complete set, {} leaves, {} open, accepted by the checker",
            cover.leaves,
            cover.open.len()
        );

        let (_, listed) = self.listed();
        solutions_json(&Report {
            problem: &self.problem,
            reduced: &self.reduced,
            solutions: listed.clone(),
            claim: Claimed::of_cover(cover),
            evidence,
            enumeration: None,
            cover: Some(cover),
        })
    }

    /// What is proved of the limit at infinity, for a set of the problem [`Problem::at_infinity`].
    pub fn text_at_infinity(&self) -> String {
        say::cover::text_at_infinity(&self.completed.cover)
    }

    /// What the search has found, as the engine has it.
    pub fn as_completed(&self) -> &Completed {
        &self.completed
    }

    fn listed(&self) -> &(Vec<Solution>, Vec<Listed>) {
        self.listed.get_or_init(|| {
            let mut solutions = Vec::new();
            let mut all_listed = Vec::new();
            let found = Listed::of_cover(&self.problem, &self.reduced, &self.completed);
            for (proved, listed) in found {
                solutions.push(Solution::new(self.problem.unknown(), proved, &listed));
                all_listed.push(listed);
            }

            (solutions, all_listed)
        })
    }
}

impl fmt::Display for SolutionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&say::cover::text(&self.problem, &self.completed.cover))
    }
}

impl Problem {
    /// Looks for all solutions in the window, with a proof that there are no others.
    ///
    /// ```
    /// use mceip::{Problem, check};
    /// let problem = Problem::read("spec/examples/fold.json")?;
    /// let all = problem.complete().run()?;
    /// assert!(all.is_complete());
    /// assert_eq!(all.solutions().len(), 2);
    /// check(&problem, all.certificate())?;
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn complete(&self) -> Complete<'_> {
        Complete {
            problem: self,
            earlier: None,
            options: CompleteOptions::default(),
            watched: Watched::default(),
        }
    }

    /// What the parts of a search ([`Complete::part`]) prove together.
    ///
    /// # Errors
    /// [`Error::Complete`]: parts of another problem, window or search, a piece that no part has
    /// searched, a part that the checker refuses.
    pub fn merge(&self, parts: &[Certificate]) -> Result<SolutionSet, Error> {
        let problem = self.as_model();
        SolutionSet::new(problem, merge(problem, parts)?)
    }

    /// The problem whose solutions are those at infinity: the reversed one, sA + B with s = 1/t, at
    /// the value s = 0.
    ///
    /// # Errors
    /// [`Error::Model`] with particles in contact with zero reaction: the reversed problem is a
    /// pencil, of which (9) says nothing.
    pub fn at_infinity(&self) -> Result<Problem, Error> {
        let zero = Window::new(Rational::zero(), Some(Rational::zero()))?;
        let mut at_zero = reversed(self.as_model())?.with_window(zero);
        let digest = self.sha256();
        let comment = format!("the limit at infinity of problem {digest}, at the value 0");
        at_zero.comment = Some(comment);
        Ok(at_zero.into())
    }
}

watched_question!(Complete, "what is not done is left open");

impl<'a> Complete<'a> {
    /// Threads, at most 1024; all cores if not said. The certificate does not depend on it.
    pub fn threads(mut self, threads: usize) -> Self {
        self.options.threads = Some(threads);
        self
    }

    /// Pieces the window is cut into; more of them for more parts.
    pub fn pieces(mut self, pieces: usize) -> Self {
        self.options.pieces = pieces;
        self
    }

    /// Searches part `index` of `count` of the pieces, counted from 0, and leaves the others open;
    /// [`Problem::merge`] joins the parts. There are as many pieces as parts at least.
    pub fn part(mut self, index: usize, count: usize) -> Self {
        self.options.pieces = self.options.pieces.max(count);
        self.options.shard = Some(Shard { index, count });
        self
    }

    /// Goes on with a certificate that leaves regions open: only these are searched.
    pub fn resume(mut self, earlier: &'a Certificate) -> Self {
        self.earlier = Some(earlier);
        self
    }

    /// Hands over what is proved so far, about as often as said: a certificate to go on with.
    pub fn keep(mut self, every: Duration, keep: impl Fn(&Kept<'_>) + Sync + 'a) -> Self {
        self.watched.keep(every, keep);
        self
    }

    /// Searches.
    ///
    /// # Errors
    /// [`Error::Complete`] where the problem is outside the hypotheses of the search, or the
    /// earlier certificate belongs to another problem.
    pub fn run(self) -> Result<SolutionSet, Error> {
        let problem = self.problem.as_model();
        let watch = self.watched.watch();
        let completed = match self.earlier {
            None => complete(problem, &self.options, &watch)?,
            Some(earlier) => resume(problem, earlier, &self.options, &watch)?,
        };

        SolutionSet::new(problem, completed)
    }
}
