//! The summary of a campaign: coverage per family, disagreements, a verdict. No times, so that
//! equal runs are equal.

use crate::cli::verify::covered_json;
use mceip_engine::report::Table;
use mceip_testkit::campaign::{Judgement, Replay, State, Tally};
use serde_json::{Value, json};

pub(super) fn text_of(state: &State) -> String {
    let header = [
        "family",
        "instances",
        "solutions",
        "found/findable",
        "closed",
        "undecided",
        "accepted",
        "forgeries",
        "uncertified",
        "degenerate",
        "disagreements",
    ];
    let mut table = Table::new(&header);
    for (name, t) in state.families.iter().zip(&state.tallies) {
        table.row(row(name, t));
    }
    let mut sum = Tally::default();
    state.tallies.iter().for_each(|t| add(&mut sum, t));
    table.row(row("all", &sum));
    let mut out = format!("{table}\n{}\n", coverage_of(state));
    for (name, t) in state.families.iter().zip(&state.tallies) {
        let corners: Vec<String> = t.corners.iter().map(|(c, n)| format!("{c} {n}")).collect();
        let corners = if corners.is_empty() {
            "none".into()
        } else {
            corners.join(", ")
        };
        out += &format!("{name}: corners reached: {corners}; {} pivots\n", t.pivots);
        out += &t
            .disagreements
            .iter()
            .map(|d| format!("  DISAGREEMENT {d}\n"))
            .collect::<String>();
    }
    out + &format!("\n{}\n", verdict(state))
}

/// What was found of the instances that have solutions, each rate beside its floor; then the rates
/// below it.
fn coverage_of(state: &State) -> String {
    let mut table = Table::new(&["coverage", "starts", "first start", "all solutions"]);
    for c in state.covered() {
        table.row(vec![
            c.family.clone(),
            c.starts.word().into(),
            c.first_text(),
            c.all_text(),
        ]);
    }

    let mut out = table.to_string();
    for shortfall in state.shortfalls() {
        out += &format!("  DISAGREEMENT coverage: {shortfall}\n");
    }
    out
}

fn add(sum: &mut Tally, t: &Tally) {
    sum.instances += t.instances;
    sum.solutions += t.solutions;
    sum.findable += t.findable;
    sum.found += t.found;
    sum.closed += t.closed;
    sum.accepted += t.accepted;
    sum.forgeries += t.forgeries;
    sum.uncertified += t.uncertified;
    sum.degenerate += t.degenerate;
    sum.disagreements.extend(t.disagreements.iter().cloned());
}

fn row(name: &str, t: &Tally) -> Vec<String> {
    vec![
        name.into(),
        t.instances.to_string(),
        t.solutions.to_string(),
        format!("{}/{}", t.found, t.findable),
        t.closed.to_string(),
        (t.instances - t.closed).to_string(),
        t.accepted.to_string(),
        t.forgeries.to_string(),
        t.uncertified.to_string(),
        t.degenerate.to_string(),
        t.disagreements.len().to_string(),
    ]
}

fn verdict(state: &State) -> String {
    let (seed, (i, n)) = (state.seed, state.shard);
    let part = if n == 1 {
        String::new()
    } else {
        format!(", part {} of {n}", i + 1)
    };
    match state.disagreements() {
        0 => format!(
            "CLEAN: no disagreement in {} instances (seed {seed}{part})",
            state.instances()
        ),
        wrong => format!(
            "DISAGREEMENT: {wrong} in {} instances (seed {seed}{part})",
            state.instances()
        ),
    }
}

pub(super) fn json_of(state: &State) -> Value {
    let family = |(name, t): (&String, &Tally)| {
        json!({
            "name": name,
            "instances": t.instances,
            "solutions": t.solutions,
            "findable": t.findable,
            "found": t.found,
            "closed": t.closed,
            "undecided": t.instances - t.closed,
            "accepted": t.accepted,
            "forgeries": t.forgeries,
            "uncertified": t.uncertified,
            "degenerate": t.degenerate,
            "pivots": t.pivots,
            "corners": t.corners,
            "disagreements": t.disagreements,
        })
    };
    json!({
        "seed": state.seed,
        "shard": [state.shard.0 + 1, state.shard.1],
        "instances": state.instances(),
        "disagreements": state.disagreements(),
        "coverage": state.covered().iter().map(covered_json).collect::<Vec<_>>(),
        "shortfalls": state.shortfalls().iter().map(ToString::to_string).collect::<Vec<_>>(),
        "families": state.families.iter().zip(&state.tallies).map(family).collect::<Vec<_>>(),
        "verdict": verdict(state),
    })
}

pub(super) fn replay_text(replay: &Replay, judged: &Judgement) -> String {
    let mut out = format!(
        "{}:{}:{} was: {}: {}\n",
        replay.family, replay.seed, replay.index, replay.engine, replay.disagreement
    );
    out += &judged
        .findings
        .iter()
        .map(|f| format!("DISAGREEMENT {}: {}\n", f.engine, f.disagreement))
        .collect::<String>();
    if judged.findings.is_empty() {
        out += &format!(
            "CLEAN: {} solutions, every engine agrees\n",
            judged.report.oracle
        );
    }
    out
}

pub(super) fn replay_json(replay: &Replay, judged: &Judgement) -> Value {
    let now: Vec<Value> = judged
        .findings
        .iter()
        .map(|f| {
            json!({
                "engine": f.engine,
                "kind": f.disagreement.kind(),
                "disagreement": f.disagreement.to_string(),
            })
        })
        .collect();
    json!({
        "family": replay.family,
        "seed": replay.seed,
        "index": replay.index,
        "was": replay.disagreement,
        "now": now,
    })
}
