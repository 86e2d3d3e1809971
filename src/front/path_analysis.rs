//! Which states on a loading path can diverge at its friction, and from which friction on each of
//! them does, held.
//!
//! The state inside each stretch is analysed as [`Problem::analyze`] does it, without samples:
//! divergence at the mu of the path, and the critical friction with the contact states held.
//! Stretches in the same states are one analysis.
//!
//! [`Problem::analyze`]: super::Problem::analyze

use super::error::Error;
use super::loads::LoadPath;
use super::own_critical::require_mass;
use super::run::{Watched, watched_question};
use crate::say;
use mceip_engine::analysis::{Analysis, AnalysisError, AnalysisOptions, Mode, Verdict, analyse};
use mceip_engine::run::Progress;
use serde_json::Value;

/// The states on a path, analysed; its text is what `mceip path --analyze` prints.
#[derive(Debug, Clone)]
pub struct PathAnalysis {
    path: LoadPath,
    /// One for each stretch that was examined, in order.
    pub states: Vec<StateAnalysis>,
}

/// The state inside a stretch, analysed.
#[derive(Debug, Clone)]
pub struct StateAnalysis {
    /// The stretch, from 0.
    pub stretch: usize,
    /// An earlier stretch in the same states: the analysis is that of it.
    pub same_as: Option<usize>,
    /// The analysis, its contact states held; an error for states that are refused.
    pub analysis: Result<Analysis, AnalysisError>,
}

impl StateAnalysis {
    /// Whether it diverges at the friction of the path; undecided where its states are refused.
    pub fn verdict(&self) -> Verdict {
        let analysis = self.analysis.as_ref();
        analysis.map_or(Verdict::Undecided, |analysis| analysis.divergence.verdict)
    }

    /// Every motion that is proved to grow, by ascending lambda^2.
    pub fn modes(&self) -> &[Mode] {
        let analysis = self.analysis.as_ref();
        analysis.map_or(&[], |analysis| &analysis.divergence.modes)
    }
}

impl PathAnalysis {
    /// The path.
    pub fn path(&self) -> &LoadPath {
        &self.path
    }

    /// Were all stretches examined?
    pub fn is_whole(&self) -> bool {
        self.states.len() == self.path.as_path().stretches.len()
    }

    /// Is it not known of a state whether it diverges?
    pub fn is_undecided(&self) -> bool {
        let mut verdicts = self.states.iter().map(StateAnalysis::verdict);
        verdicts.any(|verdict| verdict == Verdict::Undecided)
    }

    /// In words, with a table.
    pub fn text(&self) -> String {
        say::path_analysis::text_of(self)
    }

    /// For programs: `analyses` of `mceip path --json`.
    pub fn to_json(&self) -> Value {
        say::path_analysis::json_of(self)
    }
}

/// A question about the states on a path; see [`LoadPath::analyze`].
pub struct AnalyzePath<'a> {
    path: &'a LoadPath,
    watched: Watched<'a>,
}

impl LoadPath {
    /// Can the states inside the stretches of this path diverge in the form (8) at its friction,
    /// and from which friction on, each held?
    ///
    /// ```
    /// use mceip::Loads;
    /// use mceip::analysis::Verdict;
    /// let loads = Loads::read("spec/examples/own-critical.json")?;
    /// let path = loads.path().friction("1.12".parse()?).run()?.expect("nobody has cancelled it");
    /// let states = path.analyze().run()?.states;
    /// assert_eq!(states[3].verdict(), Verdict::Present);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn analyze(&self) -> AnalyzePath<'_> {
        AnalyzePath {
            path: self,
            watched: Watched::default(),
        }
    }
}

watched_question!(AnalyzePath, "the stretches that were examined are kept");

impl AnalyzePath<'_> {
    /// Analyses, stretch by stretch.
    ///
    /// # Errors
    /// [`Error::Analyze`] for a body without mass.
    pub fn run(self) -> Result<PathAnalysis, Error> {
        let body = self.path.loads().body();
        require_mass(body)?;
        let watch = self.watched.watch();
        let path = self.path.as_path();
        let mu = &path.steps.friction;
        let options = AnalysisOptions {
            samples: 0,
            ..AnalysisOptions::default()
        };

        let mut states: Vec<StateAnalysis> = Vec::new();
        for (k, stretch) in path.stretches.iter().enumerate() {
            let stage = format!("stretch {k} of {}: analysis", path.stretches.len());
            watch.report(&Progress::stage(&stage));
            let held = stretch.equilibrium_states();
            let in_the_same = |e: &&StateAnalysis| {
                path.stretches[e.stretch].equilibrium_states() == held && e.same_as.is_none()
            };
            let same = states.iter().find(in_the_same);
            let (same_as, analysis) = match same {
                Some(same) => (Some(same.stretch), same.analysis.clone()),
                None => {
                    let system = body.system().with_states(held, Some(mu.clone()));
                    let system = system.map_err(AnalysisError::from);
                    let analysis =
                        system.and_then(|system| analyse(&system, mu, &options, &watch.quiet()));
                    (None, analysis)
                }
            };
            if watch.is_cancelled() {
                break;
            }

            states.push(StateAnalysis {
                stretch: k,
                same_as,
                analysis,
            });
        }

        Ok(PathAnalysis {
            path: self.path.clone(),
            states,
        })
    }
}
