//! What a search from many starts was, in words.

use super::counted;
use mceip_engine::multistart::MultistartFound;

/// What the search was and how it went.
pub(crate) fn evidence(found: &MultistartFound, certified: usize, seed: u64) -> String {
    let search = if found.interrupted {
        "an interrupted search of "
    } else {
        ""
    };

    let continua = if found.on_continua > 0 {
        format!("{} more points of continua, ", found.on_continua)
    } else {
        String::new()
    };

    format!(
        "{certified} certified found in {search}{} (seed {seed}, {} pivots, {} factorisations, \
         {} repeats, {continua}{} outside the window, endings {:?}); completeness unknown",
        counted(found.runs, "run"),
        found.pivots,
        found.factorisations,
        found.repeated,
        found.outside,
        found.terminations
    )
}
