//! The library as its users meet it: read a problem, ask, get what the checker has accepted.

#[cfg(feature = "solver")]
mod analyze;
#[cfg(feature = "solver")]
mod certify;
#[cfg(feature = "solver")]
mod complete;
#[cfg(feature = "solver")]
mod enumerate;
mod error;
#[cfg(feature = "solver")]
mod loads;
mod matrix;
#[cfg(feature = "solver")]
mod own_critical;
#[cfg(feature = "solver")]
mod path_analysis;
mod problem;
#[cfg(feature = "solver")]
mod run;
#[cfg(feature = "solver")]
mod solution;
#[cfg(feature = "solver")]
mod solve;

#[cfg(feature = "solver")]
pub use analyze::Analyze;
#[cfg(feature = "solver")]
pub use certify::Certified;
#[cfg(feature = "solver")]
pub use complete::{Complete, SolutionSet};
#[cfg(feature = "solver")]
pub use enumerate::{Enumerate, Enumerated};
pub use error::Error;
#[cfg(feature = "cli")]
pub(crate) use loads::left_behind_if;
#[cfg(feature = "solver")]
pub use loads::{FollowPath, LoadPath, Loads, ProvedStates};
pub use matrix::Matrix;
#[cfg(feature = "cli")]
pub(crate) use own_critical::require_mass;
#[cfg(feature = "solver")]
pub use own_critical::{
    Bracket, ExaminedEquilibrium, FindOwnCritical, FrictionAnswer, FrictionGrid, FrictionGridError,
    FrictionPoint, OwnCritical, PathPlace,
};
#[cfg(feature = "solver")]
pub use path_analysis::{AnalyzePath, PathAnalysis, StateAnalysis};
pub use problem::{Problem, check};
#[cfg(feature = "solver")]
pub use solution::Solution;
#[cfg(feature = "solver")]
pub use solve::{Found, Solve};
