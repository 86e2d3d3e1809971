//! The log of a run as text: every step, path and pivot, doubles in their shortest exact spelling.
//!
//! Called by searches that were asked for a trace.

use mceip_mcp::solver::Outcome;
use std::fmt::{Result, Write};

/// One line a step, a path, a pivot; the last line says why the run ended.
pub fn trace_outcome(outcome: &Outcome) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_outcome(&mut text, outcome);
    text
}

fn write_outcome(out: &mut String, outcome: &Outcome) -> Result {
    for (k, major) in outcome.log.iter().enumerate() {
        writeln!(
            out,
            "step {k}: merit {:e}, {:?}, proximal {:e}",
            major.merit, major.step, major.proximal
        )?;

        for path in &major.paths {
            writeln!(
                out,
                "  path, {:?} start, ended {:?} at t = {:?}",
                path.start, path.end, path.reach
            )?;
            for pivot in &path.pivots {
                writeln!(
                    out,
                    "    t = {:?}: {:?} leaves, {:?} enters ({:?})",
                    pivot.t, pivot.leaving, pivot.entering, pivot.kind
                )?;
            }
        }
    }

    writeln!(
        out,
        "ended: {:?} at {:?}, {:?}, {:?}",
        outcome.termination, outcome.point, outcome.residuals, outcome.counters
    )
}
