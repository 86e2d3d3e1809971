//! Amounts of loads, states, causes of events and ends of a loading path in words.

use mceip_engine::report::fixed_decimals;
use mceip_model::ContactState;
use mceip_path::{Bound, Equilibrium, LoadingPath, PathEnd};

/// The amount of the growing load at an equilibrium.
pub(in crate::cli) fn amount(at: &Equilibrium) -> String {
    fixed_decimals(at.amount(), 9)
}

/// A contact state, with the direction in which a candidate slips along its tangent.
pub(super) fn state_word(state: ContactState) -> &'static str {
    match state {
        ContactState::Slip { sign } if sign > 0 => "slip-",
        ContactState::Slip { .. } => "slip+",
        other => other.word(),
    }
}

/// Why the path ends.
pub(in crate::cli) fn end_text(path: &LoadingPath) -> String {
    match &path.end {
        PathEnd::NoFurtherEvent if path.slides() => {
            "the body slides: no state changes any more".into()
        }
        PathEnd::NoFurtherEvent => "no further event: no state changes any more".into(),
        PathEnd::AllApplied => "all loads are applied".into(),
        PathEnd::Interrupted => "INTERRUPTED".into(),
        PathEnd::NoContinuation { causes, why } => {
            let causes = causes_text(causes);
            if why.is_proved() {
                format!("the quasi-static path ends ({causes}): {why}")
            } else {
                format!("UNDECIDED ({causes}): {why}")
            }
        }
    }
}

/// The bounds that are reached at an event, candidate by candidate (from 1).
pub(in crate::cli) fn causes_text(causes: &[Bound]) -> String {
    if causes.is_empty() {
        return "the step begins".into();
    }

    let mut reached = Vec::new();
    for bound in causes {
        let text = format!("node {}: {}", bound.node() + 1, bound.word());
        // At the tip of the cone both its sides are reached.
        if !reached.contains(&text) {
            reached.push(text);
        }
    }

    reached.join(", ")
}
