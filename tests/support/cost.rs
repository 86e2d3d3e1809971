//! The runs behind `spec/figures/complete-cost.svg`, as a table.
//!
//! The table is `spec/figures/complete-cost.csv`: written from measured runs, read back for the
//! picture, and compared with the picture in the repository.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip::picture::{CostSeries, Picture, cost_picture};

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
        let Run {
            case,
            slip,
            free,
            complete,
            check,
            leaves,
            solutions,
            open,
            kilobytes,
        } = self;
        format!(
            "{case},{slip},{free},{complete:.3},{check:.3},{leaves},{solutions},{open},{kilobytes}"
        )
    }

    fn read(line: &str) -> Option<Run> {
        let fields: Vec<&str> = line.split(',').collect();
        let [
            case,
            slip,
            free,
            complete,
            check,
            leaves,
            solutions,
            open,
            kilobytes,
        ] = fields[..]
        else {
            return None;
        };
        Some(Run {
            case: case.into(),
            slip: slip.parse().ok()?,
            free: free.parse().ok()?,
            complete: complete.parse().ok()?,
            check: check.parse().ok()?,
            leaves: leaves.parse().ok()?,
            solutions: solutions.parse().ok()?,
            open: open.parse().ok()?,
            kilobytes: kilobytes.parse().ok()?,
        })
    }
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
