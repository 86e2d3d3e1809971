//! What an accepted cover has proved, in lines: solutions, families, open regions, and the verdict.

use mceip_check::{AcceptedCover, OpenRegion, SolutionFamily};
use mceip_exact::enclosing_decimals;
use mceip_model::Problem;

/// Families and open regions printed in full.
const SHOWN: usize = 20;

/// What a cover has proved, for people.
pub(crate) fn text(problem: &Problem, cover: &AcceptedCover) -> String {
    let word = problem.unknown().word();
    let mut out = String::new();
    for solution in &cover.solutions {
        let (lo, hi) = enclosing_decimals(&solution.value, 15);
        let support = &solution.support;
        out += &format!("solution: {word} in [{lo}, {hi}], slip {support:?}\n");
    }

    for family in cover.families.iter().take(SHOWN) {
        out += &format!("family: {}\n", family_text(word, family));
    }

    let more = cover.families.len().saturating_sub(SHOWN);
    if more > 0 {
        out += &format!("family: {more} more (see the certificate)\n");
    }

    for region in cover.open.iter().take(SHOWN) {
        out += &format!("open: {}\n", open_text(word, region));
    }

    let more = cover.open.len().saturating_sub(SHOWN);
    if more > 0 {
        out += &format!("open: {more} more regions (see the certificate)\n");
    }

    out + &verdict_text(problem, cover)
}

/// The last line: is the set complete, and how large is it?
fn verdict_text(problem: &Problem, cover: &AcceptedCover) -> String {
    let window = problem.window();
    let leaves = cover.leaves;
    let open = cover.open.len();
    let count = count_text(cover);
    if open > 0 {
        return format!("UNDECIDED: {count} proved in {window}, {open} regions open\n");
    }

    let is_empty = cover.solutions.is_empty() && cover.families.is_empty();
    let set = if is_empty {
        format!("no solution in {window}")
    } else {
        format!("{count} in {window}, and no other")
    };

    format!("COMPLETE: {set}; {leaves} leaves, accepted by the checker\n")
}

/// "2 solutions and 1 families of them".
fn count_text(cover: &AcceptedCover) -> String {
    let mut count = match cover.solutions.len() {
        1 => "1 solution".into(),
        n => format!("{n} solutions"),
    };
    if !cover.families.is_empty() {
        count += &format!(" and {} families of them", cover.families.len());
    }

    count
}

fn open_text(word: &str, region: &OpenRegion) -> String {
    let max = match &region.max {
        Some(max) => max.to_string(),
        None => "infinity".into(),
    };

    format!(
        "{word} in [{}, {max}], moving {:?}, undecided {:?}",
        region.min, region.moving, region.undecided
    )
}

fn family_text(word: &str, family: &SolutionFamily) -> String {
    let (lo, hi) = enclosing_decimals(&family.from, 15);
    let values = match &family.to {
        _ if family.is_point => format!("{word} in [{lo}, {hi}] (one value)"),
        None => format!("every {word} above a value in [{lo}, {hi}]"),
        Some(to) => {
            let (a, b) = enclosing_decimals(to, 15);
            format!("every {word} between values in [{lo}, {hi}] and [{a}, {b}]")
        }
    };

    let how_many = if family.is_alone {
        "one solution at each"
    } else {
        "a cone of solutions"
    };

    format!("{values}, slip {:?}, {how_many}", family.support)
}

/// What a cover of the limit at infinity has proved, for people.
pub(crate) fn text_at_infinity(cover: &AcceptedCover) -> String {
    let mut out = String::new();
    for solution in &cover.solutions {
        out += &format!("at infinity: slip {:?}\n", solution.support);
    }

    for family in &cover.families {
        let support = &family.support;
        out += &format!("at infinity: a cone of solutions, slip {support:?}\n");
    }

    for region in &cover.open {
        out += &format!(
            "at infinity: open, moving {:?}, undecided {:?}\n",
            region.moving, region.undecided
        );
    }

    let verdict = verdict_at_infinity(cover);
    let leaves = cover.leaves;
    out +=
        &format!("{verdict}; {leaves} leaves, accepted by the checker for the reversed problem\n");

    out
}

/// Is everything at infinity known, and how much is it?
fn verdict_at_infinity(cover: &AcceptedCover) -> String {
    let count = cover.solutions.len() + cover.families.len();
    let open = cover.open.len();

    if open > 0 {
        format!("UNDECIDED at infinity: {count} proved, {open} regions open")
    } else if count == 0 {
        "COMPLETE: nothing at infinity".into()
    } else {
        format!("COMPLETE: {count} at infinity (limits of x, no value of the window), and no other")
    }
}
