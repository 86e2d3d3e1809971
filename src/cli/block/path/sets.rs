//! The complete MCEIP-mu set of each stretch of the loading path.

use crate::check::AcceptedCover;
use crate::cli::common::CliError;
use crate::exact::{enclosing_decimals, to_f64};
use crate::report::Table;
use crate::search::complete::{Options, complete};
use crate::source::Block;
use crate::source::path::LoadingPath;
use serde_json::{Value, json};
use std::sync::atomic::{AtomicBool, Ordering};

/// A stretch and what was proved of it over mu in [0, infinity).
pub(super) struct Set {
    stretch: usize,
    picture: String,
    slip: usize,
    pub(super) cover: AcceptedCover,
}

/// The sets of all stretches in which a node slips, until `stop` is set.
pub(super) fn of(block: &Block, path: &LoadingPath, stop: &AtomicBool, progress: &dyn Fn(String)) -> Result<Vec<Set>, CliError> {
    let mut sets = Vec::new();
    for (stretch, interval) in path.intervals.iter().enumerate() {
        let [_, left, right, _] = interval.counts();
        if left + right == 0 || stop.load(Ordering::Relaxed) {
            continue;
        }
        progress(format!("stretch {stretch}: all solutions"));
        let problem = interval.problem(block, None)?;
        let cover = complete(&problem, &Options::default(), stop, &|_| {})?.cover;
        sets.push(Set { stretch, picture: interval.picture(), slip: left + right, cover });
    }
    Ok(sets)
}

/// A table for people.
pub(super) fn text_of(sets: &[Set]) -> String {
    let mut table = Table::new(&["#", "nodes", "slip", "MCEIP-mu solutions in [0, infinity)", "leaves", "verdict"]);
    for s in sets {
        let value = |c: &crate::check::AcceptedClaim| {
            let (lo, hi) = enclosing_decimals(&c.value, 10);
            format!("mu in [{lo}, {hi}], {} slipping", c.support.len())
        };
        let values: Vec<String> = s.cover.solutions.iter().map(value).collect();
        let values = if values.is_empty() { "none".into() } else { values.join("; ") };
        let verdict = if s.cover.open.is_empty() { "complete, proved".into() } else { format!("{} regions open", s.cover.open.len()) };
        table.row(vec![s.stretch.to_string(), s.picture.clone(), s.slip.to_string(), values, s.cover.leaves.to_string(), verdict]);
    }
    format!("\n{table}\n")
}

/// The same for programs.
pub(super) fn json_of(sets: &[Set]) -> Value {
    let one = |s: &Set| {
        let solutions: Vec<Value> = s
            .cover
            .solutions
            .iter()
            .map(|c| {
                let (lo, hi) = enclosing_decimals(&c.value, 15);
                json!({ "mu": to_f64(&c.value.mid()), "enclosure": [lo, hi], "slipping": c.support.len() })
            })
            .collect();
        json!({ "stretch": s.stretch, "slip": s.slip, "solutions": solutions, "complete": s.cover.open.is_empty(), "leaves": s.cover.leaves })
    };
    sets.iter().map(one).collect()
}
