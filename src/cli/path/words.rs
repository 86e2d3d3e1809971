//! Motions, causes of events and ends of a loading path in words.

use mceip_exact::to_f64;
use mceip_path::{Bound, Equilibrium, LoadingPath, PathEnd};

/// The motion of CD at an equilibrium, mm.
pub(super) fn motion(at: &Equilibrium) -> String {
    format!("{:.9}", to_f64(at.amount()))
}

/// Why the path ends.
pub(super) fn end_text(path: &LoadingPath) -> String {
    match &path.end {
        PathEnd::NoFurtherEvent if path.slides() => {
            "the block slides: nothing changes any more".into()
        }
        PathEnd::NoFurtherEvent => "no further event: some nodes stick for ever".into(),
        PathEnd::AllApplied => "end of the range".into(),
        PathEnd::Interrupted => "INTERRUPTED".into(),
        PathEnd::NoContinuation {
            causes,
            tried,
            proved,
        } => {
            let causes = causes_text(causes);
            if *proved {
                format!(
                    "the quasi-static path ends ({causes}): no states satisfy the rate conditions, \
                     every set was tried"
                )
            } else {
                format!("UNDECIDED ({causes}): no admissible states among {tried} sets tried")
            }
        }
    }
}

/// The bounds that are reached at an event, node by node (from 1 at the left).
pub(super) fn causes_text(causes: &[Bound]) -> String {
    if causes.is_empty() {
        return "motion begins".into();
    }

    let mut reached = Vec::new();
    for bound in causes {
        reached.push(format!("node {}: {}", bound.node() + 1, bound.word()));
    }

    reached.join(", ")
}
