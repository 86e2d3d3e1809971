//! The stretches of a loading path as a table for people.

use super::path::{amount_text, causes_text};
use mceip_engine::report::{Table, fixed_decimals};
use mceip_model::{ContactState, Particle};
use mceip_path::{Event, Finder, LoadingPath, Stretch};

/// The table of the stretches; `steps` are the names of the steps, shown where there are several.
pub(super) fn table_of(path: &LoadingPath, steps: &[&str], candidates: &[Particle]) -> Table {
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
        row.push(event_text(&stretch.begin, candidates));
        table.row(row);
    }

    table
}

/// Candidates in contact without reaction.
fn zeros(stretch: &Stretch) -> usize {
    stretch.count(ContactState::Zero)
}

/// The cells that describe stretch k, but for its step and the event it begins with.
pub(crate) fn stretch_cells(k: usize, stretch: &Stretch) -> Vec<String> {
    let to = match &stretch.stop {
        Some(stop) => amount_text(stop),
        None => "-".into(),
    };
    let mut cells = vec![
        k.to_string(),
        amount_text(&stretch.start),
        to,
        stretch.picture(),
    ];
    cells.extend(stretch.counts().map(|count| count.to_string()));

    let (tangential, _) = stretch.start.resultants();
    cells.push(fixed_decimals(&tangential, 6));
    cells
}

/// Why the event happens, and how the states behind it were found.
fn event_text(event: &Event, candidates: &[Particle]) -> String {
    let causes = causes_text(&event.causes, candidates);
    match event.finder {
        Finder::ActiveSet => causes,
        Finder::OneByOne => format!("{causes} (states found one by one)"),
        Finder::Pivoting => format!("{causes} (states found by pivoting)"),
        Finder::Enumeration => format!("{causes} (states found by trying all)"),
    }
}
