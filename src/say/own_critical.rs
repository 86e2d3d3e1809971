//! The own critical friction of a body under loads in words, as a table and as JSON.

use super::path::{LETTERS, amount_text, apart_text, end_text, states_json};
use super::{number_text, warnings_text};
use crate::front::{
    Bracket, ExaminedEquilibrium, FrictionAnswer, FrictionPoint, OwnCritical, PathPlace,
};
use mceip_engine::analysis::{Analysis, Mode, Verdict};
use mceip_engine::report::{Table, six_digits};
use mceip_exact::{Interval, Rational, enclosing_decimals};
use mceip_model::Particle;
use mceip_path::LoadingPath;
use serde_json::{Value, json};

/// For people: the bracket first, then the frozen one, then what was examined.
pub(crate) fn text_of(own: &OwnCritical) -> String {
    let out = headlines(own).join("\n");

    let mut warnings = warnings_text(&own.loads().as_file().warnings);
    let examined = own.points.iter().flat_map(|point| &point.examined);
    warnings += &apart_text(examined.map(|one| one.equilibrium.contact_states()));
    let mut table = Table::new(&HEADER);
    for row in rows_of(own) {
        table.row(row);
    }

    let rounded = if own.is_in_doubles() {
        " The path is that of the body condensed in doubles, which differs from the given one \
         by rounding; what is proved is proved of the given body."
    } else {
        ""
    };

    let examined = if own.is_end_alone() {
        "Examined is the equilibrium at the end of the loads on the path that is followed at each \
         mu (of a load without end: one inside the last stretch). What the path meets before is \
         NOT examined."
    } else {
        "Examined is the path that is followed at each mu: an equilibrium inside each stretch, up \
         to the first that can diverge, and the one at the end of the loads (of a load without \
         end: inside the last stretch), but not those at the events. The columns are about the one \
         that decides."
    };
    let refused = refused_text(own);
    format!(
        "{out}\n{warnings}\n{LETTERS}\n{table}\n{refused}\
         {examined} The path is exact, but has no certificate, and may be one of several. \
         \"Proved\" rests on a certificate or a theorem: that under these loads there is an \
         equilibrium in these contact states, and whether states can diverge. Other mu are not \
         examined.{rounded}\n"
    )
}

/// The states that were refused, and why.
fn refused_text(own: &OwnCritical) -> String {
    let mut out = String::new();
    for point in &own.points {
        for examined in &point.examined {
            if let Err(why) = &examined.divergence {
                let mu = number_text(point.friction());
                let place = place_text(examined.place);
                let states = examined.equilibrium.picture();
                out += &format!("NOT DECIDED at mu = {mu}, {place}, states {states}: {why}\n");
            }
        }
    }

    out
}

/// The columns of the table of what was examined.
pub(crate) const HEADER: [&str; 6] = [
    "mu",
    "where",
    "contact states",
    "of an equilibrium",
    "divergence",
    "largest growth rate proved",
];

/// What was examined, a row for each mu.
pub(crate) fn rows_of(own: &OwnCritical) -> Vec<Vec<String>> {
    let names = own.loads().step_names();
    let rows = own.points.iter().map(|point| cells(point, &names));
    rows.collect()
}

/// The bracket, then the frozen critical friction.
pub(crate) fn headlines(own: &OwnCritical) -> Vec<String> {
    let mut all = vec![headline(own, &own.loads().step_names())];
    all.extend(own.frozen.as_ref().map(|frozen| frozen_text(own, frozen)));
    all
}

fn headline(own: &OwnCritical, names: &[&str]) -> String {
    let count = own.points.len();
    if count == 0 {
        return "No own critical friction was found: nothing was examined.".into();
    }

    let none_diverges = if own.is_end_alone() {
        "the equilibrium in which the path of these loads ends cannot diverge in the form (8), \
         proved"
    } else {
        "none of the equilibria inside the stretches of the path of these loads, nor the one in \
         which it ends, can diverge in the form (8), proved"
    };
    match own.bracket() {
        Bracket::Between(absent, critical) => {
            let [lo, hi] = [absent, critical].map(|point| number_text(point.friction()));
            format!(
                "OWN CRITICAL FRICTION: between {lo} and {hi}, the first change among the mu \
                 examined. At mu = {lo} {none_diverges}; at mu = {hi} {}.{}{}",
                critical_text(critical, names),
                uncertified_text(&[absent, critical]),
                undecided_text(own, critical)
            )
        }
        Bracket::AtMost(first) => format!(
            "OWN CRITICAL FRICTION: not above {}: at this mu {}.{}{}",
            number_text(first.friction()),
            critical_text(first, names),
            uncertified_text(&[first]),
            undecided_text(own, first)
        ),
        Bracket::Undecided => format!(
            "No own critical friction was found at the {count} mu examined; some are undecided."
        ),
        Bracket::None => format!(
            "No own critical friction was found at the {count} mu examined: at each of them \
             {none_diverges}.{}",
            uncertified_text(&own.points.iter().collect::<Vec<_>>())
        ),
    }
}

/// Why this mu is critical, as what follows "at mu = ...".
fn critical_text(point: &FrictionPoint, names: &[&str]) -> String {
    match point.deciding() {
        Some(examined) if point.deciding_diverges() => format!(
            "the equilibrium {} can diverge, proved{}",
            where_text(examined.place, &point.path, names),
            rate_of(examined.modes())
                .map(|rate| format!(" (a growth rate of {rate} 1/s)"))
                .unwrap_or_default()
        ),
        _ => format!(
            "the path ends before ({}): no contact states go on from there, every set was tried, \
             and what follows is dynamic",
            last_place(&point.path, names)
        ),
    }
}

/// Where on a path an equilibrium is.
fn where_text(place: PathPlace, path: &LoadingPath, names: &[&str]) -> String {
    let stretch = place.stretch(path);
    match place {
        PathPlace::End => "in which the path ends".into(),
        PathPlace::Inside(number) => format!(
            "inside stretch {number} ({}, {} of it)",
            names[stretch.step],
            amount_text(&stretch.inside)
        ),
    }
}

fn place_text(place: PathPlace) -> String {
    match place {
        PathPlace::Inside(stretch) => format!("stretch {stretch}"),
        PathPlace::End => "end".into(),
    }
}

/// How much of which load is applied at the end of a path.
fn last_place(path: &LoadingPath, names: &[&str]) -> String {
    let last = path.stretches.last();
    match last.and_then(|stretch| Some((stretch, stretch.stop.as_ref()?))) {
        None => "at the beginning".into(),
        Some((stretch, stop)) => format!("{}, {} of it", names[stretch.step], amount_text(stop)),
    }
}

/// The mu before a critical one that are undecided.
fn undecided_text(own: &OwnCritical, critical: &FrictionPoint) -> String {
    let before = own.points.iter();
    let before = before.filter(|point| point.friction() < critical.friction());
    let undecided = before.filter(|point| point.answer().is_undecided());
    let undecided: Vec<String> = undecided
        .map(|point| number_text(point.friction()))
        .collect();
    if undecided.is_empty() {
        return String::new();
    }

    format!(" Undecided below it: {}.", undecided.join(", "))
}

/// That what is said of these points rests on contact states without a certificate, where it does.
fn uncertified_text(points: &[&FrictionPoint]) -> &'static str {
    let is_uncertified = |point: &&FrictionPoint| matches!(point.states, Some(Err(_)));
    if points.iter().any(is_uncertified) {
        " What is proved is divergence or its absence in the contact states of the path; that an \
         equilibrium has them is not certified at each of these mu."
    } else {
        ""
    }
}

/// The frozen critical friction, and why it is another number.
fn frozen_text(own: &OwnCritical, frozen: &Analysis) -> String {
    let mu = number_text(&frozen.friction);
    let bracket = bracket_text(frozen);
    let is_smallest = matches!(own.bracket(), Bracket::Undecided | Bracket::None)
        && frozen.critical.absent_below.is_some();
    let smallest = if is_smallest {
        ", the smallest over the contact states in the table"
    } else {
        ""
    };

    format!(
        "FROZEN CRITICAL FRICTION: {bracket}, with the contact states held that the table shows \
         at mu = {mu}{smallest}. That is a statement about these states at every mu; but with \
         another friction the same loads may lead to other states, of which the own one tells."
    )
}

/// Between which bounds the critical friction of held states lies.
pub(super) fn bracket_text(held: &Analysis) -> String {
    let critical = &held.critical;
    match (&critical.absent_below, &critical.solution) {
        (None, _) => "none, no divergence at any mu".into(),
        (Some(below), None) => format!("not below {}", rounded_down(below)),
        (Some(below), Some(solution)) => {
            let above = enclosing_decimals(&solution.mu, DIGITS).1;
            format!("between {} and {above}", rounded_down(below))
        }
    }
}

/// The largest growth rate that is proved.
pub(super) fn rate_of(modes: &[Mode]) -> Option<String> {
    modes.last().map(|mode| six_digits(mode.growth_rate))
}

/// lambda^2 of each mode, between two decimals.
pub(super) fn lambda2_json(modes: &[Mode]) -> Value {
    let values = modes.iter();
    let values = values.map(|mode| enclosing_decimals(&mode.lambda2, 2 * DIGITS));
    json!(values.collect::<Vec<_>>())
}

/// Digits of printed values.
pub(super) const DIGITS: usize = 6;

/// A lower bound in decimals.
fn rounded_down(mu: &Rational) -> String {
    enclosing_decimals(&Interval::point(mu.clone()), DIGITS).0
}

fn cells(point: &FrictionPoint, names: &[&str]) -> Vec<String> {
    let mu = number_text(point.friction());
    let answer = point.answer();
    let none = || String::from("-");
    let examined = match (point.deciding(), answer) {
        (Some(examined), FrictionAnswer::Equilibrium(_)) => examined,
        (_, answer) => {
            let word = if answer.is_critical() {
                "no path"
            } else {
                "undecided: the path stops"
            };
            let place = last_place(&point.path, names);
            return vec![mu, place, none(), none(), word.into(), none()];
        }
    };

    let verdict = match answer {
        FrictionAnswer::Equilibrium(Verdict::Absent) => "absent, proved",
        FrictionAnswer::Equilibrium(Verdict::Present) => "present, proved",
        _ => "undecided",
    };
    let place = place_text(examined.place);
    let states = match &point.states {
        Some(Ok(_)) => "proved",
        Some(Err(_)) | None => "not certified",
    };
    vec![
        mu,
        place,
        examined.equilibrium.picture(),
        states.into(),
        verdict.into(),
        rate_of(examined.modes()).unwrap_or_else(none),
    ]
}

/// For programs.
pub(crate) fn json_of(own: &OwnCritical) -> Value {
    let names = own.loads().step_names();
    let (word, ends) = match own.bracket() {
        Bracket::Between(absent, critical) => {
            let [absent, critical] = [absent, critical].map(|point| number_text(point.friction()));
            ("between", json!({ "absent": absent, "critical": critical }))
        }
        Bracket::AtMost(first) => {
            let critical = number_text(first.friction());
            ("at_most", json!({ "absent": null, "critical": critical }))
        }
        Bracket::Undecided => ("undecided", Value::Null),
        Bracket::None => ("none", Value::Null),
    };
    let candidates = own.loads().candidates();
    let points = own.points.iter();
    let points = points.map(|point| point_json(point, &names, candidates));

    json!({
        "found": word,
        "bracket": ends,
        "frozen": own.frozen.as_ref().map(frozen_json),
        "points": points.collect::<Vec<_>>(),
    })
}

fn frozen_json(frozen: &Analysis) -> Value {
    let mut out = held_json(frozen);
    out["states_of"] = json!(number_text(&frozen.friction));
    out
}

/// The bounds of the critical friction of held states.
pub(super) fn held_json(held: &Analysis) -> Value {
    let solution = held.critical.solution.as_ref();
    json!({
        "absent_below": held.critical.absent_below.as_ref().map(rounded_down),
        "present_at": solution.map(|s| {
            let (lo, hi) = enclosing_decimals(&s.mu, DIGITS);
            [lo, hi]
        }),
    })
}

fn point_json(point: &FrictionPoint, names: &[&str], candidates: &[Particle]) -> Value {
    let mu = number_text(point.friction());
    let mut out = match (point.deciding(), point.answer()) {
        (Some(examined), FrictionAnswer::Equilibrium(verdict)) => {
            examined_json(examined, verdict, point)
        }
        (_, answer) => json!({
            "no_path": {
                "at": last_place(&point.path, names),
                "why": end_text(&point.path, candidates),
                "all_tried": answer.is_critical(),
            },
        }),
    };
    out["mu"] = json!(mu);
    out["examined"] = json!(point.examined.len());
    out
}

/// The equilibrium that decides, with what is known of the whole path.
fn examined_json(examined: &ExaminedEquilibrium, verdict: Verdict, point: &FrictionPoint) -> Value {
    let stretch = match examined.place {
        PathPlace::Inside(stretch) => Some(stretch),
        PathPlace::End => None,
    };

    json!({
        "stretch": stretch,
        "states": states_json(examined.equilibrium.contact_states()),
        "states_certified": matches!(point.states, Some(Ok(_))),
        "divergence": verdict.word(),
        "families": examined.divergence.as_ref().map_or(0, |divergence| divergence.families),
        "refused": examined.divergence.as_ref().err().map(ToString::to_string),
        "lambda2": lambda2_json(examined.modes()),
    })
}
