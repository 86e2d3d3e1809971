//! Outcomes per flag: for people, as Markdown, as JSON.
//!
//! Input: the outcomes of a run. Output: how many cases of each flag got which label, and every
//! case that is not correct. Called by `mceip conform`.

use super::flag::Flag;
use super::judge::Label;
use super::run::CaseOutcome;
use mceip_engine::report::Table;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// Counts per flag and label, and every case that is not correct.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// Cases run.
    pub cases: usize,
    /// Cases per label.
    pub labels: BTreeMap<Label, usize>,
    /// Cases per flag and label; a case counts for each of its flags.
    pub flags: BTreeMap<Flag, BTreeMap<Label, usize>>,
    /// What was not correct, in the order of the cases.
    pub failures: Vec<CaseOutcome>,
}

/// Counts outcomes.
pub fn summarise(outcomes: &[CaseOutcome]) -> Summary {
    let mut summary = Summary {
        cases: outcomes.len(),
        labels: BTreeMap::new(),
        flags: BTreeMap::new(),
        failures: Vec::new(),
    };

    for outcome in outcomes {
        let label = outcome.judgement.label;
        *summary.labels.entry(label).or_default() += 1;
        for flag in &outcome.flags {
            let counts = summary.flags.entry(*flag).or_default();
            *counts.entry(label).or_default() += 1;
        }

        if !label.is_correct() {
            summary.failures.push(outcome.clone());
        }
    }

    summary
}

/// Failures printed in full for people.
const SHOWN: usize = 20;

impl Summary {
    /// Was every case correct?
    pub fn all_correct(&self) -> bool {
        self.failures.is_empty()
    }

    /// One row per flag that occurs, and one for all cases.
    fn rows(&self) -> Vec<Vec<String>> {
        let mut rows = Vec::new();
        for flag in Flag::ALL {
            if let Some(counts) = self.flags.get(flag) {
                rows.push(row(flag.word(), counts));
            }
        }
        rows.push(row("all", &self.labels));
        rows
    }

    /// How many cases got which label, in one line.
    fn verdict(&self) -> String {
        let count = |label| self.labels.get(label).copied().unwrap_or(0);
        let parts = Label::ALL.iter();
        let parts = parts.map(|label| format!("{} {}", count(label), label.word()));
        let parts: Vec<String> = parts.collect();
        format!("{} cases: {}", self.cases, parts.join(", "))
    }

    /// A table for people, the first failures, one line of verdict.
    pub fn text(&self) -> String {
        let mut header = vec!["flag", "cases"];
        header.extend(Label::ALL.iter().map(|label| label.word()));
        let mut table = Table::new(&header);
        for row in self.rows() {
            table.row(row);
        }

        let mut out = format!("{table}\n");
        for failure in self.failures.iter().take(SHOWN) {
            let judgement = &failure.judgement;
            let label = judgement.label.word();
            out += &format!("{}: {label}: {}\n", failure.id, judgement.detail);
        }
        if self.failures.len() > SHOWN {
            let more = self.failures.len() - SHOWN;
            out += &format!("and {more} more (--json or --markdown list all)\n");
        }

        out += &self.verdict();
        out += "\n";
        out
    }

    /// The same as Markdown, with the notes of the flags and all failures.
    ///
    /// `settings` says which cases were run and how.
    pub fn markdown(&self, command: &[String], settings: &str) -> String {
        let command = escaped(&command.join(" "));
        let settings = escaped(settings);
        let verdict = self.verdict();
        let mut out = format!(
            "# mceip conform\n\nCommand: `{command}`\n\nSettings: {settings}\n\n{verdict}\n\n"
        );

        let labels: Vec<&str> = Label::ALL.iter().map(|label| label.word()).collect();
        let labels = labels.join(" | ");
        let rule = "---|".repeat(Label::ALL.len() + 3);
        out += &format!("| flag | cases | {labels} | what it catches |\n|{rule}\n");
        for row in self.rows() {
            let note = Flag::of_word(&row[0]).map_or("", Flag::note);
            out += &format!("| {} | {} |\n", row.join(" | "), escaped(note));
        }

        if !self.failures.is_empty() {
            out += "\n| case | label | why |\n|---|---|---|\n";
        }
        for failure in &self.failures {
            let label = failure.judgement.label.word();
            let why = escaped(&failure.judgement.detail);
            out += &format!("| {} | {label} | {why} |\n", failure.id);
        }

        out
    }

    /// The same for programs.
    pub fn json(&self, command: &[String]) -> Value {
        let mut flags = Map::new();
        for (flag, counts) in &self.flags {
            flags.insert(flag.word().to_string(), counts_json(counts));
        }

        let failures: Vec<Value> = self.failures.iter().map(failure_json).collect();
        json!({
            "command": command,
            "cases": self.cases,
            "labels": counts_json(&self.labels),
            "flags": flags,
            "failures": failures,
        })
    }
}

/// A name, how many cases, how many per label; a dot for none.
fn row(name: &str, counts: &BTreeMap<Label, usize>) -> Vec<String> {
    let total: usize = counts.values().sum();
    let mut out = vec![name.to_string(), total.to_string()];
    for label in Label::ALL {
        let number = counts.get(label).map(ToString::to_string);
        out.push(number.unwrap_or_else(|| ".".into()));
    }
    out
}

/// Text for a cell of a Markdown table.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|")
        .replace('`', "'")
        .replace('<', "&lt;")
}

/// Counts by the words of their labels.
fn counts_json(counts: &BTreeMap<Label, usize>) -> Value {
    let mut out = Map::new();
    for (label, count) in counts {
        out.insert(label.word().to_string(), json!(count));
    }
    Value::Object(out)
}

/// A case that is not correct.
fn failure_json(failure: &CaseOutcome) -> Value {
    let flags: Vec<&str> = failure.flags.iter().map(|f| f.word()).collect();
    json!({
        "case": failure.id,
        "flags": flags,
        "label": failure.judgement.label.word(),
        "detail": failure.judgement.detail,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conform::Judgement;

    fn outcome(id: &str, label: Label, flags: &[Flag]) -> CaseOutcome {
        CaseOutcome {
            id: id.into(),
            flags: flags.iter().copied().collect(),
            judgement: Judgement {
                label,
                detail: "a | b".into(),
            },
        }
    }

    #[test]
    fn a_case_counts_for_each_of_its_flags() {
        let list = [
            outcome("p", Label::Correct, &[Flag::Mu]),
            outcome("q", Label::Wrong, &[Flag::Mu, Flag::Fold]),
        ];

        let summary = summarise(&list);
        let first_alone = summarise(&list[..1]);

        assert!(!summary.all_correct());
        assert!(first_alone.all_correct());
        assert_eq!(
            summary.flags[&Flag::Mu],
            BTreeMap::from([(Label::Correct, 1), (Label::Wrong, 1)])
        );
        assert_eq!(summary.flags[&Flag::Fold].len(), 1);
        assert_eq!(summary.failures.len(), 1);

        assert!(summary.text().ends_with(
            "2 cases: 1 correct, 0 incomplete, 0 inaccurate, 1 wrong, 0 crashed, 0 timed out, 0 malformed, 0 undecided\n"
        ));
        let markdown = summary.markdown(&["prog".into()], "mceip 1; a | b");
        assert!(markdown.contains("| q | wrong | a \\| b |"));
        assert!(markdown.contains("Settings: mceip 1; a \\| b\n"));
        assert_eq!(summary.json(&[])["failures"][0]["case"], "q");
    }
}
