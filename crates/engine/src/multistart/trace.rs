//! The log of a run as text: every step, path and pivot, doubles in their shortest exact spelling.

use mceip_mcp::solver::Outcome;
use std::fmt::Write as _;

/// One line a step, a path, a pivot; the last line says why the run ended.
pub fn trace_outcome(outcome: &Outcome) -> String {
    let mut out = String::new();
    for (k, major) in outcome.log.iter().enumerate() {
        let _ = writeln!(
            out,
            "step {k}: merit {:e}, {:?}, proximal {:e}",
            major.merit, major.step, major.proximal
        );
        for path in &major.paths {
            let _ = writeln!(
                out,
                "  path, {:?} start, ended {:?} at t = {:?}",
                path.start, path.end, path.reach
            );
            for p in &path.pivots {
                let _ = writeln!(
                    out,
                    "    t = {:?}: {:?} leaves, {:?} enters ({:?})",
                    p.t, p.leaving, p.entering, p.kind
                );
            }
        }
    }
    let _ = writeln!(
        out,
        "ended: {:?} at {:?}, {:?}, {:?}",
        outcome.termination, outcome.point, outcome.residuals, outcome.counters
    );
    out
}
