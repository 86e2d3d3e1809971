//! What a search from many starts was, in words.

use mceip_engine::multistart::MultistartFound;
use mceip_engine::report::counted;

/// What the search was and how it went.
pub(crate) fn evidence(found: &MultistartFound, certified: usize, seed: u64) -> String {
    let search = if found.interrupted {
        "an interrupted search of "
    } else {
        ""
    };

    let continua = if found.on_continua > 0 {
        format!("{} of continua, ", counted(found.on_continua, "more point"))
    } else {
        String::new()
    };

    format!(
        "{certified} certified found in {search}{} (seed {seed}, {}, {}, {}, \
         {continua}{} outside the window, endings {:?}); completeness unknown",
        counted(found.runs, "run"),
        counted(found.pivots, "pivot"),
        counted(found.factorisations, "factorisation"),
        counted(found.repeated, "repeat"),
        found.outside,
        found.terminations
    )
}
