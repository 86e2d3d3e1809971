//! The analysis of the states on a loading path in words, as a table and as JSON.

use super::number_text;
use super::own_critical::{DIGITS, bracket_text, held_json, lambda2_json, rate_of};
use super::path::{amount_text, not_carried_text};
use crate::front::PathAnalysis;
use mceip_engine::analysis::Verdict;
use mceip_engine::report::{Table, counted};
use mceip_exact::{Interval, Rational, enclosing_decimals};
use serde_json::{Value, json};

/// Whether the path meets a state that can diverge, then a row for each stretch.
pub(crate) fn text_of(found: &PathAnalysis) -> String {
    if found.states.is_empty() {
        return format!("{}\n", verdict_text(found));
    }

    let mut table = Table::new(&HEADER);
    for row in rows_of(found) {
        table.row(row);
    }

    let missing = if found.is_whole() {
        ""
    } else {
        " NOT EXAMINED are the stretches that are not listed."
    };
    format!(
        "{}{}\n{}{missing}\n{table}\n\
         The states are those of the equilibria inside each stretch; \"proved\" rests on a \
         certificate that the checker has accepted, or on a theorem. The path is exact, but has \
         no certificate; --certificates certifies its states. Of the critical friction the \
         contact states are held: at another mu the loads may lead to others (--own-critical). \
         `path --states FOLDER` writes each state, `analyze` its certificates.\n",
        not_carried_text(found.path()),
        verdict_text(found),
        lowest_text(found),
    )
}

/// The columns of the table.
pub(crate) const HEADER: [&str; 5] = [
    "#",
    "nodes",
    "divergence at the mu of the path",
    "largest growth rate proved",
    "critical friction, states held",
];

/// A row for each stretch that was examined.
pub(crate) fn rows_of(found: &PathAnalysis) -> Vec<Vec<String>> {
    let path = found.path().as_path();
    let mut rows = Vec::with_capacity(found.states.len());
    for state in &found.states {
        let verdict = match state.verdict() {
            Verdict::Undecided => "undecided".into(),
            decided => format!("{}, proved", decided.word()),
        };
        let held = match state.same_as {
            Some(earlier) => format!("as in stretch {earlier}"),
            None => match &state.analysis {
                Ok(analysis) => bracket_text(analysis),
                Err(why) => format!("NOT DECIDED: {why}"),
            },
        };
        rows.push(vec![
            state.stretch.to_string(),
            path.stretches[state.stretch].picture(),
            verdict,
            rate_of(state.modes()).unwrap_or_else(|| "-".into()),
            held,
        ]);
    }

    rows
}

/// Does the path meet a state that can diverge at its friction?
pub(crate) fn verdict_text(found: &PathAnalysis) -> String {
    if found.states.is_empty() {
        return "No state of the path was analysed.".into();
    }

    let path = found.path().as_path();
    let mu = number_text(&path.steps.friction);
    let with = |verdict| {
        let states = found.states.iter();
        states.filter(move |state| state.verdict() == verdict)
    };

    if let Some(first) = with(Verdict::Present).next() {
        let stretch = &path.stretches[first.stretch];
        let names = found.path().loads().step_names();
        let rate = rate_of(first.modes());
        let rate = rate.map_or_else(String::new, |rate| format!(", at up to about {rate} 1/s"));
        return format!(
            "At mu = {mu} the path MEETS AN EQUILIBRIUM THAT CAN DIVERGE: the first that is known \
             inside stretch {} ({}, {} of it), where a motion in a fixed direction can grow \
             exponentially, without oscillation{rate}; proved.",
            first.stretch,
            names[stretch.step],
            amount_text(&stretch.inside),
        );
    }

    let undecided = with(Verdict::Undecided).count();
    if undecided > 0 {
        let of_how_many = counted(undecided, "stretch");
        return format!("At mu = {mu} it is UNDECIDED whether states of {of_how_many} diverge.");
    }
    let examined = counted(found.states.len(), "stretch");
    format!(
        "At mu = {mu} none of the equilibria inside {examined} can diverge in the form (8): no \
         motion in a fixed direction grows; proved."
    )
}

/// The lowest critical friction of a state on the path.
fn lowest_text(found: &PathAnalysis) -> String {
    let bounds = found.states.iter().filter_map(|state| {
        let analysis = state.analysis.as_ref().ok()?;
        let solution = analysis.critical.solution.as_ref()?;
        Some((solution.mu.hi(), state.stretch))
    });
    match bounds.min() {
        None => "No divergence is known of these states, held, at any friction.".into(),
        Some((mu, stretch)) => format!(
            "The lowest friction at which one of these states, held, is proved to diverge is {}, \
             in stretch {stretch}.",
            above(mu)
        ),
    }
}

/// An upper bound in decimals.
fn above(mu: &Rational) -> String {
    enclosing_decimals(&Interval::point(mu.clone()), DIGITS).1
}

/// For programs.
pub(crate) fn json_of(found: &PathAnalysis) -> Value {
    let states = found.states.iter().map(|state| {
        let mut out = match &state.analysis {
            Ok(analysis) => held_json(analysis),
            Err(why) => {
                json!({ "absent_below": null, "present_at": null, "refused": why.to_string() })
            }
        };
        out["stretch"] = json!(state.stretch);
        out["same_as"] = json!(state.same_as);
        out["divergence"] = json!(state.verdict().word());
        out["lambda2"] = lambda2_json(state.modes());
        out
    });

    Value::Array(states.collect())
}
