//! Motions, causes of events and ends of a loading path in words.

use mceip_exact::to_f64;
use mceip_paper::path::{Bound, Equilibrium, LoadingPath, PathEnd};

pub(super) fn motion(at: &Equilibrium) -> String {
    format!("{:.9}", to_f64(at.motion()))
}

pub(super) fn end_text(path: &LoadingPath) -> String {
    match &path.end {
        PathEnd::NoFurtherEvent if path.slides() => {
            "the block slides: nothing changes any more".into()
        }
        PathEnd::NoFurtherEvent => "no further event: some nodes stick for ever".into(),
        PathEnd::Range => "end of the range".into(),
        PathEnd::Interrupted => "INTERRUPTED".into(),
        PathEnd::NoContinuation {
            causes,
            proved: true,
            ..
        } => {
            format!(
                "the quasi-static path ends ({}): no states satisfy the rate conditions, every set \
                 was tried",
                causes_text(causes)
            )
        }
        PathEnd::NoContinuation { causes, tried, .. } => {
            format!(
                "UNDECIDED ({}): no admissible states among {tried} sets tried",
                causes_text(causes)
            )
        }
    }
}

pub(super) fn causes_text(causes: &[Bound]) -> String {
    let causes: Vec<String> = causes
        .iter()
        .map(|b| format!("node {}: {}", b.node() + 1, b.word()))
        .collect();
    if causes.is_empty() {
        "motion begins".into()
    } else {
        causes.join(", ")
    }
}
