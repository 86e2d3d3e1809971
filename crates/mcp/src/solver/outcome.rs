//! What a run reports: the point, every residual, why it stopped, and the log of its pivots.
//!
//! Data only. [`Outcome`] holds the steps of the outer loop ([`MajorRecord`]), each with the paths
//! followed from there ([`PathRecord`]), each with its pivots, and the counts of all work.

use super::path::{PathEnd, Pivot, Start};
use super::residual::Residuals;

/// Where a value that is not finite was met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NonFinite {
    /// In F.
    Function {
        /// Its component.
        row: usize,
    },
    /// In the Jacobian of F.
    Jacobian {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        col: usize,
    },
}

impl std::fmt::Display for NonFinite {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NonFinite::Function { row } => write!(out, "F[{row}]"),
            NonFinite::Jacobian { row, col } => write!(out, "F'[{row}][{col}]"),
        }
    }
}

/// Why a run stopped. A reason, never a verdict: whether the point is a solution is decided
/// elsewhere, exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Termination {
    /// The residuals are within the tolerance ([`Residuals::within`]).
    ToleranceReached,
    /// The limit on linearisations.
    MajorLimit,
    /// The limit on pivots of one path, on the last path of the last attempt.
    MinorLimit,
    /// The limit on pivots of the run.
    CumulativeLimit,
    /// The last path ended on a ray, and no step from it was acceptable.
    Ray,
    /// The last path cycled, and no step from it was acceptable.
    Cycle,
    /// A basis of the last path was singular to rounding, and no step from it was acceptable.
    SingularBasis,
    /// A complete path, but neither a point on it nor a gradient step passes the test; or the last
    /// attempt has wandered through its share of the limits.
    NoProgress,
    /// F or its Jacobian is not finite where the run cannot avoid it.
    NonFinite(NonFinite),
    /// The problem's callback gave a Jacobian that is not n x n.
    JacobianShape {
        /// Its rows.
        rows: usize,
        /// Its columns.
        cols: usize,
    },
    /// The crash of the last attempt did not converge, and paths, which would follow, need a dense
    /// matrix: a problem that gives its Jacobian by entries is too large for one.
    TooLargeForPaths {
        /// Number of unknowns.
        order: usize,
        /// That of the largest problem with a sparse Jacobian that paths are followed of.
        limit: usize,
    },
    /// No attempt got on, and the Jacobian at the start is singular by its zeros alone, among the
    /// unknowns strictly between their bounds there: no permutation pairs this row and this column
    /// with non-zeros.
    StructurallySingular {
        /// Row of F'.
        row: usize,
        /// Column of F'.
        col: usize,
    },
}

impl std::fmt::Display for Termination {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Termination::ToleranceReached => write!(out, "the residuals are within the tolerance"),
            Termination::MajorLimit => write!(out, "the limit on linearisations is reached"),
            Termination::MinorLimit => write!(out, "the limit on pivots of a path is reached"),
            Termination::CumulativeLimit => write!(out, "the limit on pivots of a run is reached"),
            Termination::Ray => write!(out, "the last path ended on a ray"),
            Termination::Cycle => write!(out, "the last path cycled"),
            Termination::SingularBasis => write!(out, "a basis of the last path was singular"),
            Termination::NoProgress => write!(out, "no step from the last points was acceptable"),
            Termination::NonFinite(place) => write!(out, "expected a finite {place}"),
            Termination::JacobianShape { rows, cols } => {
                write!(
                    out,
                    "expected a square Jacobian, got {rows} rows and {cols} columns"
                )
            }
            Termination::TooLargeForPaths { order, limit } => write!(
                out,
                "Newton's method did not converge, and with a sparse Jacobian paths are followed \
                 of at most {limit} unknowns, got {order}"
            ),
            Termination::StructurallySingular { row, col } => write!(
                out,
                "the zeros of the Jacobian make it singular: no permutation pairs row {row} and \
                 column {col} with entries that are not zero"
            ),
        }
    }
}

impl Termination {
    /// Are the residuals within the tolerance? Only a candidate for certification.
    pub fn reached_tolerance(self) -> bool {
        self == Termination::ToleranceReached
    }

    /// The reason that goes with the end of a path that led nowhere.
    pub(super) fn of(end: PathEnd) -> Termination {
        match end {
            PathEnd::Complete => Termination::NoProgress,
            PathEnd::Ray => Termination::Ray,
            PathEnd::Cycle => Termination::Cycle,
            PathEnd::PivotLimit => Termination::MinorLimit,
            PathEnd::Singular => Termination::SingularBasis,
        }
    }
}

/// How an iterate was left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepKind {
    /// Projected Newton on a guessed active set, before the first path.
    Crash,
    /// Newton on the Fischer-Burmeister system, before the first path.
    FischerNewton,
    /// To the end of the path, or the part of it an attempt takes, checked against the reference.
    Path {
        /// Path parameter of the accepted point: 1 at a Newton point.
        t: f64,
    },
    /// The same inside the trust radius, unchecked.
    Unchecked {
        /// Path parameter of the point: 1 at a Newton point.
        t: f64,
    },
    /// Back along the path of this iterate to `t`.
    Search {
        /// Path parameter of the accepted point.
        t: f64,
    },
    /// Back to the checkpoint, and along its path to `t`.
    Watchdog {
        /// Path parameter of the accepted point.
        t: f64,
    },
    /// A projected-gradient step from the best point.
    Gradient,
    /// Along the curve of the Newton homotopy from the attempt's start.
    Curve,
    /// From the user's start again, with other settings.
    Restart,
    /// No acceptable step: the attempt ends here.
    Failed,
}

/// One path that was followed.
#[derive(Debug, Clone, PartialEq)]
pub struct PathRecord {
    /// From the iterate or from a ray.
    pub start: Start,
    /// Why it ended.
    pub end: PathEnd,
    /// The largest t on it: 1 if complete.
    pub reach: f64,
    /// Its pivots, in order.
    pub pivots: Vec<Pivot>,
}

/// One step of the outer loop.
#[derive(Debug, Clone, PartialEq)]
pub struct MajorRecord {
    /// Fischer merit Psi before the step, units of F squared.
    pub merit: f64,
    /// How the iterate was left.
    pub step: StepKind,
    /// Proximal term of the linearisation (added to the diagonal of F'), units of F'.
    pub proximal: f64,
    /// The paths followed from here: none for crashes and restart, a second one after a failure.
    pub paths: Vec<PathRecord>,
}

impl MajorRecord {
    /// The pivots of its paths, path after path.
    pub fn pivots(&self) -> impl Iterator<Item = &Pivot> {
        self.paths.iter().flat_map(|path| path.pivots.iter())
    }
}

/// How much work a run was.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Linearisations.
    pub majors: usize,
    /// Pivots of all paths, also of those given up.
    pub pivots: usize,
    /// Paths from a ray start.
    pub ray_starts: usize,
    /// Crash steps of both kinds.
    pub crash_steps: usize,
    /// Returns to a checkpoint.
    pub watchdogs: usize,
    /// Projected-gradient steps.
    pub gradient_steps: usize,
    /// Restarts from the user's start.
    pub restarts: usize,
    /// Steps along curves of the Newton homotopy.
    pub curve_steps: usize,
    /// Dense factorisations: starting bases and their repair, refreshed bases, crash and curve
    /// steps.
    pub factorisations: usize,
    /// Evaluations of F.
    pub functions: usize,
    /// Evaluations of F'.
    pub jacobians: usize,
}

/// The end of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The point with the least merit met, within the bounds; length n.
    pub point: Vec<f64>,
    /// The five residuals there.
    pub residuals: Residuals,
    /// Why the run stopped.
    pub termination: Termination,
    /// The steps of the outer loop, in order.
    pub log: Vec<MajorRecord>,
    /// The work done.
    pub counters: Counters,
}

impl Outcome {
    /// All pivots of the run with their t, path after path.
    pub fn trace(&self) -> impl Iterator<Item = &Pivot> {
        self.log.iter().flat_map(MajorRecord::pivots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reasons that name a place, or numbers, say them.
    #[test]
    fn reasons_are_sentences() {
        let place = NonFinite::Jacobian { row: 2, col: 1 };
        for (reason, sentence) in [
            (Termination::Ray, "the last path ended on a ray"),
            (Termination::NonFinite(place), "expected a finite F'[2][1]"),
            (
                Termination::JacobianShape { rows: 3, cols: 2 },
                "expected a square Jacobian, got 3 rows and 2 columns",
            ),
            (
                Termination::TooLargeForPaths {
                    order: 9000,
                    limit: 2000,
                },
                "Newton's method did not converge, and with a sparse Jacobian paths are followed \
                 of at most 2000 unknowns, got 9000",
            ),
        ] {
            assert_eq!(reason.to_string(), sentence);
        }
    }
}
