//! The stretches of a loading path as a table for people and as JSON for programs: `mceip path` and
//! `mceip block --path` print them.

use super::words::{amount, causes_text, state_word};
use mceip_engine::report::{Table, fixed_decimals};
use mceip_exact::to_f64;
use mceip_model::ContactState;
use mceip_path::{Bound, Equilibrium, Event, Finder, LoadingPath, Stretch};
use serde_json::{Value, json};

/// What the letters of the column "nodes" mean.
pub(in crate::cli) const LETTERS: &str = "nodes in order: . stick, < impending slip against its \
    tangent (S = 1), > along it (S = -1), o free, z in contact without reaction";

/// The table of the stretches; `steps` are the names of the steps, shown where there are several.
pub(in crate::cli) fn table_of(path: &LoadingPath, steps: &[&str]) -> Table {
    let first = path.stretches.first().map(|stretch| stretch.step);
    let has_steps = path
        .stretches
        .iter()
        .any(|stretch| Some(stretch.step) != first);
    let mut header = vec![
        "#",
        "from",
        "to",
        "nodes",
        "stick",
        "slip-",
        "slip+",
        "free",
        "T at start",
        "event it begins with",
    ];
    let has_zero = path.stretches.iter().any(|stretch| zeros(stretch) > 0);
    if has_zero {
        header.insert(8, "zero");
    }
    if has_steps {
        header.insert(1, "step");
    }

    let mut table = Table::new(&header);
    for (k, stretch) in path.stretches.iter().enumerate() {
        let mut row = stretch_cells(k, stretch);
        if has_zero {
            row.insert(8, zeros(stretch).to_string());
        }
        if has_steps {
            row.insert(1, steps[stretch.step].to_string());
        }
        row.push(event_text(&stretch.begin));
        table.row(row);
    }

    table
}

/// Candidates in contact without reaction.
fn zeros(stretch: &Stretch) -> usize {
    stretch.count(ContactState::Zero)
}

/// The cells that describe stretch k, but for its step and the event it begins with.
pub(in crate::cli) fn stretch_cells(k: usize, stretch: &Stretch) -> Vec<String> {
    let to = match &stretch.stop {
        Some(stop) => amount(stop),
        None => "-".into(),
    };
    let mut cells = vec![k.to_string(), amount(&stretch.start), to, stretch.picture()];
    cells.extend(stretch.counts().map(|count| count.to_string()));

    let (tangential, _) = stretch.start.resultants();
    cells.push(fixed_decimals(&tangential, 6));
    cells
}

/// Why the event happens, and how the states behind it were found.
fn event_text(event: &Event) -> String {
    let causes = causes_text(&event.causes);
    match event.finder {
        Finder::ActiveSet => causes,
        Finder::OneByOne => format!("{causes} (states found one by one)"),
        Finder::Pivoting => format!("{causes} (states found by pivoting)"),
        Finder::Enumeration => format!("{causes} (states found by trying all)"),
    }
}

/// The stretches for programs.
pub(in crate::cli) fn json_of(path: &LoadingPath, steps: &[&str]) -> Vec<Value> {
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
        "zero": zeros(stretch),
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
pub(in crate::cli) fn states_json(states: &[ContactState]) -> Vec<&'static str> {
    states.iter().map(|state| state_word(*state)).collect()
}
