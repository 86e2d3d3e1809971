//! The summary of a campaign: coverage per family, disagreements, a verdict. No times, so that
//! equal runs are equal.

use crate::cli::verify::{coverage_text, covered_json};
use mceip_engine::report::{Table, counted};
use mceip_testkit::Tally;
use mceip_testkit::campaign::{CaseFindings, Replay, State};
use serde_json::{Value, json};

/// The summary for people.
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
    let mut sum = Tally::default();
    for (name, tally) in state.families.iter().zip(&state.tallies) {
        table.row(row(name, tally));
        add(&mut sum, tally);
    }

    table.row(row("all", &sum));

    let coverage = coverage_text(&state.covered(), &state.shortfalls());
    let mut out = format!("{table}\n{coverage}\n");
    for (name, tally) in state.families.iter().zip(&state.tallies) {
        let corners = corners_of(tally);
        let pivots = counted(tally.pivots, "pivot");
        out += &format!("{name}: corners reached: {corners}; {pivots}\n");
        for disagreement in &tally.disagreements {
            out += &format!("  DISAGREEMENT {disagreement}\n");
        }
    }

    out + &format!("\n{}\n", verdict(state))
}

/// The corners of the solver that were reached, each with its count.
fn corners_of(tally: &Tally) -> String {
    if tally.corners.is_empty() {
        return "none".into();
    }

    let mut corners = Vec::new();
    for (corner, count) in &tally.corners {
        corners.push(format!("{corner} {count}"));
    }

    corners.join(", ")
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
    let seed = state.seed;
    let instances = counted(state.instances(), "instance");
    let (index, count) = state.shard;
    let part = match count {
        1 => String::new(),
        _ => format!(", part {} of {count}", index + 1),
    };

    match state.disagreements() {
        0 => format!("CLEAN: no disagreement in {instances} (seed {seed}{part})"),
        wrong => format!("DISAGREEMENT: {wrong} in {instances} (seed {seed}{part})"),
    }
}

/// The summary for programs.
pub(super) fn json_of(state: &State) -> Value {
    let coverage: Vec<Value> = state.covered().iter().map(covered_json).collect();
    let shortfalls: Vec<String> = state.shortfalls().iter().map(ToString::to_string).collect();
    let mut families = Vec::new();
    for (name, tally) in state.families.iter().zip(&state.tallies) {
        families.push(family_json(name, tally));
    }

    json!({
        "seed": state.seed,
        "shard": [state.shard.0 + 1, state.shard.1],
        "instances": state.instances(),
        "disagreements": state.disagreements(),
        "coverage": coverage,
        "shortfalls": shortfalls,
        "families": families,
        "verdict": verdict(state),
    })
}

/// The counts of a family as a state file has them; coverage stands in a list of its own.
fn family_json(name: &str, tally: &Tally) -> Value {
    let mut out = json!(tally);
    out["name"] = json!(name);
    out["undecided"] = json!(tally.instances - tally.closed);
    if let Some(fields) = out.as_object_mut() {
        fields.remove("coverage");
    }
    out
}

/// What a replay file was about, and what its case gives when it is judged again.
pub(super) fn replay_text(replay: &Replay, judged: &CaseFindings) -> String {
    let mut out = format!(
        "{}:{}:{} was: {}: {}\n",
        replay.family, replay.seed, replay.index, replay.engine, replay.disagreement
    );

    for finding in &judged.findings {
        out += &format!(
            "DISAGREEMENT {}: {}\n",
            finding.engine, finding.disagreement
        );
    }

    if judged.findings.is_empty() {
        let solutions = counted(judged.report.oracle, "solution");
        out += &format!("CLEAN: {solutions}, every engine agrees\n");
    }

    out
}

/// The same for programs.
pub(super) fn replay_json(replay: &Replay, judged: &CaseFindings) -> Value {
    let mut now = Vec::new();
    for finding in &judged.findings {
        now.push(json!({
            "engine": finding.engine,
            "kind": finding.disagreement.kind(),
            "disagreement": finding.disagreement.to_string(),
        }));
    }

    json!({
        "family": replay.family,
        "seed": replay.seed,
        "index": replay.index,
        "was": replay.disagreement,
        "now": now,
    })
}
