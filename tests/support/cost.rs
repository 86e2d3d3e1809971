//! The runs behind `spec/figures/complete-cost.svg`, as a table.
//!
//! The table is `spec/figures/complete-cost.csv`: written from measured runs, read back for the
//! picture, and compared with the picture in the repository.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip::picture::{CostSeries, Picture, cost_picture};
use std::str::{FromStr, Split};

pub const CSV: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/spec/figures/complete-cost.csv"
);
pub const SVG: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/spec/figures/complete-cost.svg"
);
/// Seconds of the whole run, its own check included, and of a check of the result.
pub const HEAD: &str = "case,slip,free,complete_s,check_s,leaves,solutions,open,kB";

/// One run of a family of meshes.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub case: String,
    pub slip: usize,
    pub free: usize,
    pub complete: f64,
    pub check: f64,
    pub leaves: usize,
    pub solutions: usize,
    pub open: usize,
    pub kilobytes: usize,
}

impl Run {
    pub fn line(&self) -> String {
        let sizes = format!("{},{},{}", self.case, self.slip, self.free);
        let seconds = format!("{:.3},{:.3}", self.complete, self.check);
        let counts = [self.leaves, self.solutions, self.open, self.kilobytes];
        format!(
            "{sizes},{seconds},{}",
            counts.map(|n| n.to_string()).join(",")
        )
    }

    fn read(line: &str) -> Option<Run> {
        let mut fields = line.split(',');
        let run = Run {
            case: next(&mut fields)?,
            slip: next(&mut fields)?,
            free: next(&mut fields)?,
            complete: next(&mut fields)?,
            check: next(&mut fields)?,
            leaves: next(&mut fields)?,
            solutions: next(&mut fields)?,
            open: next(&mut fields)?,
            kilobytes: next(&mut fields)?,
        };
        fields.next().is_none().then_some(run)
    }
}

fn next<T: FromStr>(fields: &mut Split<'_, char>) -> Option<T> {
    fields.next()?.parse().ok()
}

/// The runs of a table; lines with a # are comments.
pub fn read(csv: &str) -> Option<Vec<Run>> {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    if lines.next() != Some(HEAD) {
        return None;
    }
    lines.map(Run::read).collect()
}

pub fn picture(runs: &[Run]) -> Picture {
    let mut series = Vec::new();
    for case in ["all slip", "a tenth stuck"] {
        series.push(CostSeries {
            name: format!("{case}: search and check"),
            points: points(runs, case, |run| run.complete),
        });
        series.push(CostSeries {
            name: format!("{case}: check alone"),
            points: points(runs, case, |run| run.check),
        });
    }

    cost_picture(
        "Complete MCEIP-\u{3bc} set over [0, \u{221e}) from K, refined crossed meshes",
        "slip nodes",
        &series,
    )
}

/// Seconds over the number of slip nodes, for the runs of one case.
fn points(runs: &[Run], case: &str, seconds: fn(&Run) -> f64) -> Vec<(f64, f64)> {
    runs.iter()
        .filter(|run| run.case == case)
        .map(|run| (run.slip as f64, seconds(run)))
        .collect()
}
