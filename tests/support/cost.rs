//! The runs behind `spec/figures/complete-cost.svg`, as a table.
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
        let number = |s: &str| s.parse::<usize>().ok();
        Some(Run {
            case: case.into(),
            slip: number(slip)?,
            free: number(free)?,
            complete: complete.parse().ok()?,
            check: check.parse().ok()?,
            leaves: number(leaves)?,
            solutions: number(solutions)?,
            open: number(open)?,
            kilobytes: number(kilobytes)?,
        })
    }
}

/// The runs of a table; lines with a # are comments.
pub fn read(csv: &str) -> Option<Vec<Run>> {
    let mut lines = csv.lines().filter(|l| !l.starts_with('#'));
    (lines.next() == Some(HEAD)).then(|| lines.map(Run::read).collect())?
}

pub fn picture(runs: &[Run]) -> Picture {
    let of = |case: &str, part: &str, seconds: fn(&Run) -> f64| {
        let points = runs
            .iter()
            .filter(|r| r.case == case)
            .map(|r| (r.slip as f64, seconds(r)))
            .collect();
        CostSeries {
            name: format!("{case}: {part}"),
            points,
        }
    };
    let both = |case| {
        [
            of(case, "search and check", |r| r.complete),
            of(case, "check alone", |r| r.check),
        ]
    };
    let series: Vec<CostSeries> = ["all slip", "a tenth stuck"]
        .into_iter()
        .flat_map(both)
        .collect();
    cost_picture(
        "Complete MCEIP-\u{3bc} set over [0, \u{221e}) from K, refined crossed meshes",
        "slip nodes",
        &series,
    )
}
