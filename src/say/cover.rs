//! What an accepted cover has proved, in lines: solutions, families, open regions, and the verdict.

use super::{range_text, support_text};
use mceip_check::{AcceptedCover, OpenRegion, SolutionFamily};
use mceip_engine::report::counted;
use mceip_engine::search::complete::continua::joined;
use mceip_exact::{Interval, enclosing_decimals};
use mceip_model::{Body, Problem};

/// Families and open regions printed in full.
const SHOWN: usize = 20;

/// What a cover of this window has proved, for people.
pub(crate) fn text(problem: &Problem, window: &str, cover: &AcceptedCover) -> String {
    let word = problem.unknown().word();
    let mut out = String::new();
    for solution in &cover.solutions {
        let (lo, hi) = enclosing_decimals(&solution.value, 15);
        let support = support_text(problem, &solution.support);
        out += &format!("solution: {word} in [{lo}, {hi}], {support}\n");
    }

    let families = joined(&cover.families);
    for family in families.iter().take(SHOWN) {
        out += &format!("family: {}\n", family_text(problem, family));
    }

    let more = families.len().saturating_sub(SHOWN);
    if more > 0 {
        out += &format!("family: {more} more (see the certificate)\n");
    }

    for region in cover.open.iter().take(SHOWN) {
        out += &format!("open: {}\n", open_text(word, region));
    }

    let more = cover.open.len().saturating_sub(SHOWN);
    if more > 0 {
        let more = counted(more, "more region");
        out += &format!("open: {more} (see the certificate)\n");
    }

    out + &verdict_text(problem, window, cover)
}

/// The last line: is the set complete, and how large is it?
fn verdict_text(problem: &Problem, window: &str, cover: &AcceptedCover) -> String {
    let leaves = counted(cover.leaves, "leaf");
    let open = cover.open.len();
    let count = count_text(cover);
    if open > 0 {
        let open = counted(open, "region");
        let remedy = remedy_text(problem, cover);
        return format!("UNDECIDED: {count} proved in {window}, {open} open{remedy}\n");
    }

    let is_empty = cover.solutions.is_empty() && cover.families.is_empty();
    let set = if is_empty {
        format!("no solution in {window}")
    } else {
        format!("{count} in {window}, and no other")
    };

    format!("COMPLETE: {set}; {leaves}, accepted by the checker\n")
}

/// What to do where a search over all values of a quadratic problem has gone out to infinity in
/// vain; empty elsewhere.
///
/// There every variable is decided and the region stays open all the same. Regions that no search
/// has reached, as after an interrupt, have undecided variables.
fn remedy_text(problem: &Problem, cover: &AcceptedCover) -> String {
    let is_vain = |region: &&OpenRegion| {
        let is_unbounded = region.min.is_none() || region.max.is_none();
        is_unbounded && region.undecided.is_empty()
    };

    let count = cover.open.iter().filter(is_vain).count();
    let is_quadratic = matches!(problem.body(), Body::Quadratic(_));
    if !is_quadratic || count == 0 {
        return String::new();
    }
    format!(
        ", {count} of them out to infinity, as where c is singular: a bounded window (mceip \
         complete --window=-1e6,1e6) leaves them out, and mceip enumerate decides them exactly"
    )
}

/// "2 solutions and 1 family of them".
fn count_text(cover: &AcceptedCover) -> String {
    let solutions = counted(cover.solutions.len(), "solution");
    match joined(&cover.families).len() {
        0 => solutions,
        n => format!("{solutions} and {} of them", counted(n, "family")),
    }
}

fn open_text(word: &str, region: &OpenRegion) -> String {
    let range = range_text(region.min.as_ref(), region.max.as_ref());
    format!("{word} in {range}, {}", open_supports_text(region))
}

/// "support [0] and any of [1, 2]": the supports of which nothing is proved.
fn open_supports_text(region: &OpenRegion) -> String {
    let OpenRegion {
        moving, undecided, ..
    } = region;
    if undecided.is_empty() {
        format!("support {moving:?}")
    } else {
        format!("support {moving:?} and any of {undecided:?}")
    }
}

fn family_text(problem: &Problem, family: &SolutionFamily) -> String {
    let values = family_values(problem.unknown().word(), family);
    let support = support_text(problem, &family.support);
    let how_many = family_size(family);
    format!("{values}, {support}, {how_many}")
}

/// Where the values of a family lie.
pub(crate) fn family_values(word: &str, family: &SolutionFamily) -> String {
    match (&family.from, &family.to) {
        (Some(value), _) if family.is_point => format!("{word} = {}", end_text(value)),
        (None, None) => format!("every {word}"),
        (Some(from), None) => format!("every {word} above {}", end_text(from)),
        (None, Some(to)) => format!("every {word} below {}", end_text(to)),
        (Some(from), Some(to)) => {
            format!(
                "every {word} between {} and {}",
                end_text(from),
                end_text(to)
            )
        }
    }
}

/// How many solutions a family has at each of its values.
pub(crate) fn family_size(family: &SolutionFamily) -> &'static str {
    if family.is_alone {
        "one solution at each"
    } else {
        "a cone of solutions"
    }
}

/// An end of a family: the number, or where it lies.
fn end_text(end: &Interval) -> String {
    let (lo, hi) = enclosing_decimals(end, 15);
    if lo == hi {
        lo
    } else {
        format!("a value in [{lo}, {hi}]")
    }
}

/// What a cover of the limit at infinity has proved, for people.
pub(crate) fn text_at_infinity(cover: &AcceptedCover) -> String {
    let mut out = String::new();
    for solution in &cover.solutions {
        out += &format!("at infinity: support {:?}\n", solution.support);
    }

    for family in &cover.families {
        let support = &family.support;
        out += &format!("at infinity: a cone of solutions, support {support:?}\n");
    }

    for region in &cover.open {
        out += &format!("at infinity: open, {}\n", open_supports_text(region));
    }

    let verdict = verdict_at_infinity(cover);
    let leaves = counted(cover.leaves, "leaf");
    out += &format!("{verdict}; {leaves}, accepted by the checker for the reversed problem\n");

    out
}

/// Is everything at infinity known, and how much is it?
fn verdict_at_infinity(cover: &AcceptedCover) -> String {
    let count = cover.solutions.len() + cover.families.len();
    let open = cover.open.len();

    if open > 0 {
        let open = counted(open, "region");
        format!("UNDECIDED at infinity: {count} proved, {open} open")
    } else if count == 0 {
        "COMPLETE: nothing at infinity".into()
    } else {
        let what = "what limits of x can be, no value of the window";
        format!("COMPLETE: {count} at infinity ({what}), and no other")
    }
}
