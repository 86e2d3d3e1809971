//! All solutions of a small problem by the plain enumerator, which shares nothing with the solver.

use super::error::Error;
use super::problem::Problem;
use super::run::{Watched, unless_cancelled, watched_question};
use crate::say;
use mceip_engine::report::{Claimed, Listed, Report, solutions_json, solutions_text};
use mceip_engine::run::Progress;
use mceip_model::Reduced;
use mceip_model::reduction::reduce;
use mceip_oracle::{Enumeration, IntegerPencil, ModeList, enumerate_modes_with, enumerate_with};
use serde_json::Value;
use std::fmt;

/// An enumeration; see [`Problem::enumerate`].
pub struct Enumerate<'a> {
    problem: &'a Problem,
    watched: Watched<'a>,
}

/// What the enumerator has listed.
#[derive(Debug)]
pub struct Enumerated {
    problem: mceip_model::Problem,
    reduced: Reduced,
    listing: Listing,
}

/// Supports; with particles in contact with zero reaction choices of modes.
#[derive(Debug)]
enum Listing {
    Supports(Enumeration),
    Modes(ModeList),
}

impl Enumerated {
    /// Was everything examined?
    pub fn is_finished(&self) -> bool {
        match &self.listing {
            Listing::Supports(found) => found.is_finished(),
            Listing::Modes(found) => found.is_finished(),
        }
    }

    /// Is everything that there is listed, or described as a family?
    pub fn is_complete(&self) -> bool {
        match &self.listing {
            Listing::Supports(found) => found.is_complete_list(),
            Listing::Modes(found) => found.is_complete_list(),
        }
    }

    /// The list as `mceip-solutions/1`.
    pub fn to_json(&self) -> Value {
        solutions_json(&self.report())
    }

    fn report(&self) -> Report<'_> {
        let solutions = match &self.listing {
            Listing::Supports(found) => &found.solutions,
            Listing::Modes(found) => &found.solutions,
        };
        let listed = solutions.iter();
        let listed = listed.map(|s| Listed::of_solution(&self.problem, &self.reduced, s));

        let (claim, evidence, enumeration) = match &self.listing {
            Listing::Supports(found) => (
                Claimed::of_enumeration(found),
                say::enumeration::of_supports(found),
                Some(found),
            ),
            Listing::Modes(found) => (
                Claimed::complete_if(found.is_complete_list()),
                say::enumeration::of_modes(found),
                None,
            ),
        };

        Report {
            problem: &self.problem,
            reduced: &self.reduced,
            solutions: listed.collect(),
            claim,
            evidence,
            enumeration,
            cover: None,
        }
    }
}

/// A table of the solutions, and what was examined.
impl fmt::Display for Enumerated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&solutions_text(&self.report()))
    }
}

impl Problem {
    /// Lists all solutions by examining every support in exact arithmetic: for up to 16 slip and 16
    /// free variables.
    ///
    /// ```
    /// use mceip::Problem;
    /// let problem = Problem::read("spec/examples/fold.json")?;
    /// let all = problem.enumerate().run()?;
    /// assert!(all.is_complete());
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn enumerate(&self) -> Enumerate<'_> {
        Enumerate {
            problem: self,
            watched: Watched::default(),
        }
    }
}

watched_question!(Enumerate, "what was examined is kept");

impl<'a> Enumerate<'a> {
    /// Enumerates.
    ///
    /// # Errors
    /// [`Error::Enumerate`] for a problem that is too large.
    pub fn run(self) -> Result<Enumerated, Error> {
        let problem = self.problem.as_model();
        let reduced = reduce(problem)?;
        let watch = self.watched.watch();
        let step = |what: &str, done: u64, total: u64| {
            watch.report(&Progress::of(what, done as usize, total as usize));
            unless_cancelled(&watch)
        };

        let window = problem.window();
        let real_window = &problem.real_window();
        let listing = if reduced.zero.is_empty() {
            let step = |done, total| step("supports", done, total);
            let pencil = IntegerPencil::of(problem, &reduced);
            Listing::Supports(enumerate_with(pencil, real_window, step)?)
        } else {
            let step = |done, total| step("choices of modes", done, total);
            Listing::Modes(enumerate_modes_with(&reduced, window, step)?)
        };

        Ok(Enumerated {
            problem: problem.clone(),
            reduced,
            listing,
        })
    }
}
