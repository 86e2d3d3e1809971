//! All solutions, with a proof that there are no others.

use super::error::Error;
use super::problem::Problem;
use super::run::Watched;
use super::solution::Solution;
use mceip_check::certificate::Certificate;
use mceip_check::{OpenRegion, Proved, SolutionFamily};
use mceip_engine::certify::Certifier;
use mceip_engine::report::Listed;
use mceip_engine::run::{Cancel, Progress};
use mceip_engine::search::complete::{Options, complete, resume};
use mceip_model::reduction::reduce;

/// A search for all solutions; see [`Problem::complete`].
pub struct Complete<'a> {
    problem: &'a Problem,
    earlier: Option<&'a Certificate>,
    options: Options,
    watched: Watched<'a>,
}

/// All solutions in the problem's window, as far as they are proved.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SolutionSet {
    /// The isolated solutions, by value.
    pub solutions: Vec<Solution>,
    /// Continua of solutions: a support that has more than one at a value, or one at every value of
    /// an interval.
    pub families: Vec<SolutionFamily>,
    /// What is left open: intervals of values with variables not decided.
    pub open: Vec<OpenRegion>,
    proved: Proved<Certificate>,
}

impl SolutionSet {
    /// Is it proved that there are no solutions but those of `solutions` and `families`?
    pub fn is_complete(&self) -> bool {
        self.open.is_empty()
    }

    /// Is it proved that the window holds no solution?
    ///
    /// For lambda squared over the window [0, ∞) this excludes divergence of the form (8).
    pub fn is_empty(&self) -> bool {
        self.is_complete() && self.solutions.is_empty() && self.families.is_empty()
    }

    /// The certificate, which the checker has accepted.
    pub fn certificate(&self) -> &Certificate {
        self.proved.certificate()
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
    /// assert_eq!(all.solutions.len(), 2);
    /// check(&problem, all.certificate())?;
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn complete(&self) -> Complete<'_> {
        Complete {
            problem: self,
            earlier: None,
            options: Options::default(),
            watched: Watched::default(),
        }
    }
}

impl<'a> Complete<'a> {
    /// Threads, at most 1024; all cores if not said. The certificate does not depend on it.
    pub fn threads(mut self, threads: usize) -> Self {
        self.options.threads = Some(threads);
        self
    }

    /// Goes on with a certificate that leaves regions open: only these are searched.
    pub fn resume(mut self, earlier: &'a Certificate) -> Self {
        self.earlier = Some(earlier);
        self
    }

    /// The switch that ends the search early; what is not done is left open.
    pub fn cancel(mut self, cancel: &Cancel) -> Self {
        self.watched.cancel(cancel);
        self
    }

    /// Hears how far the search has come.
    pub fn on_progress(mut self, hear: impl Fn(&Progress<'_>) + Sync + 'a) -> Self {
        self.watched.on_progress(hear);
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

        let reduced = reduce(problem)?;
        let certifier = Certifier::new(problem, &reduced.pencil);
        let mut solutions = Vec::new();
        for (proved, x) in completed.solutions() {
            let listed = Listed::of_cover(problem, &reduced, &certifier, proved, x);
            solutions.push(Solution::new(problem.unknown(), proved, &listed));
        }

        Ok(SolutionSet {
            solutions,
            families: completed.cover.families,
            open: completed.cover.open,
            proved: completed.proved,
        })
    }
}
