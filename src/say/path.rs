//! Loading paths in words and as JSON: amounts of loads, states, causes of events and ends, and the
//! stretches for programs.

use mceip_exact::to_f64;
use mceip_model::ContactState;
use mceip_path::{Bound, Equilibrium, Event, LoadingPath, PathEnd, Stretch};
use serde_json::{Value, json};

/// What the letters mean by which contact states are shown.
pub(crate) const LETTERS: &str = "nodes in order: . stick, < impending slip against its tangent (S \
    = 1), > along it (S = -1), o free, z in contact without reaction";

/// A contact state, with the direction in which a candidate slips along its tangent.
pub(crate) fn state_word(state: ContactState) -> &'static str {
    match state {
        ContactState::Slip { sign } if sign > 0 => "slip-",
        ContactState::Slip { .. } => "slip+",
        other => other.word(),
    }
}

/// Why the path ends.
pub(crate) fn end_text(path: &LoadingPath) -> String {
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
pub(crate) fn causes_text(causes: &[Bound]) -> String {
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

/// The stretches for programs.
pub(crate) fn json_of(path: &LoadingPath, steps: &[&str]) -> Vec<Value> {
    let stretches = path.stretches.iter();
    stretches
        .map(|stretch| stretch_json(stretch, steps[stretch.step]))
        .collect()
}

fn stretch_json(stretch: &Stretch, step: &str) -> Value {
    let [stick, against, along, free] = stretch.counts();
    let stop = stretch.stop.as_ref();

    json!({
        "step": step,
        "from": to_f64(stretch.start.amount()),
        "to": stop.map(|stop| to_f64(stop.amount())),
        "states": states_json(&stretch.states),
        "equilibrium_states": states_json(stretch.equilibrium_states()),
        "stick": stick,
        "slip-": against,
        "slip+": along,
        "free": free,
        "zero": stretch.count(ContactState::Zero),
        "start": equilibrium_json(&stretch.start),
        "stop": stop.map(equilibrium_json),
        "event": event_json(&stretch.begin),
    })
}

fn event_json(event: &Event) -> Value {
    let causes: Vec<Value> = event.causes.iter().map(cause_json).collect();
    let mut changes = Vec::new();
    for change in &event.changes {
        changes.push(json!({
            "node": change.node + 1,
            "from": state_word(change.from),
            "to": state_word(change.to),
        }));
    }

    json!({
        "causes": causes,
        "changes": changes,
        "tried": event.tried,
    })
}

fn cause_json(bound: &Bound) -> Value {
    json!({ "node": bound.node() + 1, "what": bound.word() })
}

fn equilibrium_json(at: &Equilibrium) -> Value {
    let (tangential, normal) = at.resultants();
    let mut reactions = Vec::new();
    for (r_t, r_n) in at.reactions_f64() {
        reactions.push(json!([r_t, r_n]));
    }

    // The fraction of the exact amount fills pages: its size stands for it.
    let bits = at.amount().numer().bits() + at.amount().denom().bits();

    json!({
        "amount_bits": bits,
        "states": states_json(at.contact_states()),
        "resultant_T": to_f64(&tangential),
        "resultant_N": to_f64(&normal),
        "reactions_T_N": reactions,
    })
}

/// The states in words.
pub(crate) fn states_json(states: &[ContactState]) -> Vec<&'static str> {
    states.iter().map(|state| state_word(*state)).collect()
}
