//! Solutions by the PATH-style solver from many starts.

use super::error::Error;
use super::problem::Problem;
use super::run::{Watched, watched_question};
use super::solution::{Solution, SolutionEntry, entries_of_both_signs};
use crate::say;
use mceip_check::Proved;
use mceip_check::certificate::{Certificate, Claim};
use mceip_engine::certify::{Preference, of_both_signs};
use mceip_engine::multistart::{self, Search, Uncertified, multistart};
use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_model::Reduced;
use mceip_model::reduction::reduce;
use serde_json::Value;
use std::fmt;

/// A search for solutions; see [`Problem::solve`].
pub struct Solve<'a> {
    problem: &'a Problem,
    search: Search,
    watched: Watched<'a>,
}

/// What a search has found. It does not say that there is nothing else: for that,
/// [`Problem::complete`].
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Found {
    /// The solutions, by value. The checker has accepted each of them.
    pub solutions: Vec<Solution>,
    /// Points at which the solver stopped and that could not be certified, each with the reason.
    pub uncertified: Vec<Uncertified>,
    /// Runs made.
    pub runs: usize,
    /// Was the search cancelled?
    pub is_cancelled: bool,
    certificates: Vec<Proved<Certificate>>,
    problem: mceip_model::Problem,
    reduced: Reduced,
    listed: Vec<Listed>,
    search: Search,
    run: multistart::MultistartFound,
}

impl Found {
    /// The certificates of all solutions, none without solutions. There is one, unless the
    /// solutions cost more together than the checker allows for one file.
    pub fn certificates(&self) -> &[Proved<Certificate>] {
        &self.certificates
    }

    /// The solutions as `mceip-solutions/1`.
    pub fn to_json(&self) -> Value {
        solutions_json(&self.report())
    }

    /// What the search has found, as the engine has it.
    pub fn as_run(&self) -> &multistart::MultistartFound {
        &self.run
    }

    /// How was searched.
    pub fn search(&self) -> &Search {
        &self.search
    }

    fn report(&self) -> Report<'_> {
        Report {
            problem: &self.problem,
            reduced: &self.reduced,
            solutions: self.listed.clone(),
            claim: Claimed::Solutions,
            evidence: say::search::evidence(&self.run, self.solutions.len(), self.search.seed),
            enumeration: None,
            cover: None,
        }
    }
}

/// A table of the solutions, and what the search was.
impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&solutions_text(&self.report()))
    }
}

impl Problem {
    /// Looks for solutions with the PATH-style solver, from many starts.
    ///
    /// ```
    /// use mceip::Problem;
    /// let problem = Problem::read("spec/examples/fold.json")?;
    /// let found = problem.solve().starts(22).run()?;
    /// let values: Vec<f64> = found.solutions.iter().map(|s| s.value).collect();
    /// assert_eq!(values, [2.0, 3.0]);
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn solve(&self) -> Solve<'_> {
        let search = Search {
            window_starts: 0,
            curves: false,
            ..Search::default()
        };

        Solve {
            problem: self,
            search,
            watched: Watched::default(),
        }
    }
}

watched_question!(Solve, "what has been found is kept");

impl<'a> Solve<'a> {
    /// Starts on the whole window; 22 if not said.
    pub fn starts(mut self, starts: usize) -> Self {
        self.search.starts = starts;
        self
    }

    /// Seed of the random starts; 1 if not said. One seed gives one result.
    pub fn seed(mut self, seed: u64) -> Self {
        self.search.seed = seed;
        self
    }

    /// Looks for all solutions: also above and below each value found, and along curves through
    /// each solution. Slower.
    pub fn all(mut self) -> Self {
        self.search.window_starts = Search::default().window_starts;
        self.search.curves = true;
        self
    }

    /// Keeps the log of every run: [`Found::as_run`].
    pub fn trace(mut self) -> Self {
        self.search.trace = true;
        self
    }

    /// Gives every solution an exact value where that can be had, also where a box is cheaper.
    pub fn exact(mut self) -> Self {
        self.search.preference = Preference::Exact;
        self
    }

    /// Searches.
    ///
    /// # Errors
    /// [`Error::Model`] where the hypotheses of the propositions fail, [`Error::Solve`] where the
    /// problem is beyond the solver.
    pub fn run(self) -> Result<Found, Error> {
        let problem = self.problem.as_model();
        let FoundOfSign {
            mut run,
            mut certificates,
            mut entries,
        } = self.of_sign(problem)?;
        if let Some(reflected) = problem.reflected() {
            let negative = self.of_sign(&reflected)?;
            run = run.with_reflected(negative.run);
            certificates = of_both_signs(problem, certificates, negative.certificates)?;
            entries = entries_of_both_signs(entries, negative.entries);
        }

        let mut solutions = Vec::new();
        let mut all_listed = Vec::new();
        for (proved, listed) in entries {
            solutions.push(Solution::new(problem.unknown(), &proved, &listed));
            all_listed.push(listed);
        }

        Ok(Found {
            solutions,
            uncertified: run.uncertified.clone(),
            runs: run.runs,
            is_cancelled: run.interrupted,
            certificates,
            problem: problem.clone(),
            reduced: reduce(problem)?,
            listed: all_listed,
            search: self.search,
            run,
        })
    }

    /// Searches for values of one sign.
    fn of_sign(&self, problem: &mceip_model::Problem) -> Result<FoundOfSign, Error> {
        let reduced = reduce(problem)?;
        let watch = self.watched.watch();
        let run = multistart(problem, &reduced, &self.search, &watch)?;

        let claims: Vec<Claim> = run.certified.iter().map(|c| c.claim.clone()).collect();
        let certificates = Proved::claims(problem, claims)?;

        let mut entries = Vec::new();
        for file in &certificates {
            let proved = file.accepted().claims.iter();
            for (proved, claim) in proved.zip(&file.certificate().claims) {
                let listed = Listed::of_claim(problem, &reduced, claim);
                entries.push((proved.clone(), listed));
            }
        }

        Ok(FoundOfSign {
            run,
            certificates,
            entries,
        })
    }
}

/// What has been found among the values of one sign.
struct FoundOfSign {
    run: multistart::MultistartFound,
    certificates: Vec<Proved<Certificate>>,
    entries: Vec<SolutionEntry>,
}

#[cfg(test)]
mod tests {
    use crate::{Error, Matrix, Problem, Unknown};

    #[test]
    fn a_problem_without_solutions_is_no_error() -> Result<(), Error> {
        // (1 + t) x = y > 0 for every x > 0.
        let one = Matrix::identity(1);
        let problem = Problem::from_pencil(one.clone(), one, Vec::new(), Unknown::Lambda2)?;

        let found = problem.solve().run()?;

        assert!(found.solutions.is_empty());
        assert!(found.certificates().is_empty());
        Ok(())
    }
}
