//! Outcomes per flag: for people, as Markdown, as JSON.
//!
//! Input: the outcomes of a run. Output: how many cases of each flag and difficulty got which
//! label, every case that is not correct, and the score beside that of a program that always says
//! that there is nothing. Called by `mceip conform`; `compare` reads the JSON back.

use super::case::Difficulty;
use super::flag::Flag;
use super::judge::Label;
use super::pack::PackName;
use super::run::CaseOutcome;
use mceip_engine::report::{Table, counted};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The format of the JSON of a run.
pub const RUN_FORMAT: &str = "mceip-conform/1";

/// What was run and how.
#[derive(Debug, Clone)]
pub struct RunHead<'a> {
    /// The program and its arguments.
    pub command: &'a [String],
    /// Version of `mceip`.
    pub version: &'a str,
    /// The pack.
    pub pack: &'a PackName,
    /// Which cases were run and how, in words.
    pub settings: &'a str,
}

/// How many cases are correct, beside a program that always answers that there is nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ConformScore {
    /// Cases that are correct.
    pub correct: usize,
    /// Cases that are correct without any work: nothing is to be found.
    pub always_none: usize,
    /// Cases with solutions.
    pub with_solutions: usize,
    /// Of these, how many are correct.
    pub correct_with_solutions: usize,
}

impl ConformScore {
    fn of(outcomes: &[CaseOutcome]) -> ConformScore {
        let is_correct = |outcome: &&CaseOutcome| outcome.judgement.label.is_correct();
        let with_solutions = || outcomes.iter().filter(|outcome| outcome.expected > 0);
        ConformScore {
            correct: outcomes.iter().filter(is_correct).count(),
            always_none: outcomes.len() - with_solutions().count(),
            with_solutions: with_solutions().count(),
            correct_with_solutions: with_solutions().filter(is_correct).count(),
        }
    }
}

/// Counts per flag and label, and every case that is not correct.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Cases run.
    pub cases: usize,
    /// How many are correct.
    pub score: ConformScore,
    /// Cases per label.
    pub labels: BTreeMap<Label, usize>,
    /// Cases per flag and label; a case counts for each of its flags.
    pub flags: BTreeMap<Flag, BTreeMap<Label, usize>>,
    /// Cases per difficulty and label, where it is known.
    pub difficulties: BTreeMap<Difficulty, BTreeMap<Label, usize>>,
    /// What came of each case, in the order of the cases.
    pub outcomes: Vec<CaseOutcome>,
}

/// Counts outcomes.
pub fn summarise(outcomes: &[CaseOutcome]) -> Summary {
    let mut summary = Summary {
        cases: outcomes.len(),
        score: ConformScore::of(outcomes),
        labels: BTreeMap::new(),
        flags: BTreeMap::new(),
        difficulties: BTreeMap::new(),
        outcomes: outcomes.to_vec(),
    };

    for outcome in outcomes {
        let label = outcome.judgement.label;
        *summary.labels.entry(label).or_default() += 1;
        for flag in &outcome.flags {
            let counts = summary.flags.entry(*flag).or_default();
            *counts.entry(label).or_default() += 1;
        }

        if let Some(difficulty) = outcome.difficulty {
            let counts = summary.difficulties.entry(difficulty).or_default();
            *counts.entry(label).or_default() += 1;
        }
    }

    summary
}

/// Failures printed in full for people.
const SHOWN: usize = 20;

impl Summary {
    /// Was every case correct?
    pub fn all_correct(&self) -> bool {
        self.score.correct == self.cases
    }

    /// What was not correct.
    pub fn failures(&self) -> impl Iterator<Item = &CaseOutcome> {
        let outcomes = self.outcomes.iter();
        outcomes.filter(|outcome| !outcome.judgement.label.is_correct())
    }

    /// One row per flag and difficulty that occurs, and one for all cases.
    fn rows(&self) -> Vec<Vec<String>> {
        let mut rows = Vec::new();
        for flag in Flag::ALL {
            if let Some(counts) = self.flags.get(flag) {
                rows.push(row(flag.word(), counts));
            }
        }
        for (difficulty, counts) in &self.difficulties {
            rows.push(row(difficulty.word(), counts));
        }
        rows.push(row("all", &self.labels));
        rows
    }

    /// The score in one line: all cases, those with solutions, and what is had for nothing.
    fn score_text(&self) -> String {
        let score = &self.score;
        let mut line = format!(
            "score: {} of {}; {} of the {} cases with solutions; a program that always answers \
             \"none\": {}",
            score.correct,
            self.cases,
            score.correct_with_solutions,
            score.with_solutions,
            score.always_none
        );

        let unlisted: usize = self.outcomes.iter().map(|o| o.judgement.unlisted).sum();
        if unlisted > 0 {
            line += &format!("; {unlisted} certified that best known answers do not have");
        }
        line
    }

    /// How many cases got which label, in one line.
    fn verdict(&self) -> String {
        let count = |label| self.labels.get(label).copied().unwrap_or(0);
        let parts = Label::ALL.iter();
        let parts = parts.map(|label| format!("{} {}", count(label), label.word()));
        let parts: Vec<String> = parts.collect();
        format!("{}: {}", counted(self.cases, "case"), parts.join(", "))
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
        for failure in self.failures().take(SHOWN) {
            let judgement = &failure.judgement;
            let label = judgement.label.word();
            out += &format!("{}: {label}: {}\n", failure.id, judgement.detail);
        }
        let failures = self.cases - self.score.correct;
        if failures > SHOWN {
            let more = failures - SHOWN;
            out += &format!("and {more} more (--json or --markdown list all)\n");
        }

        out += &format!("{}\n{}\n", self.score_text(), self.verdict());
        out
    }

    /// The same as Markdown, with the notes of the flags and all failures.
    pub fn markdown(&self, head: &RunHead<'_>) -> String {
        let command = escaped(&head.command.join(" "));
        let settings = escaped(head.settings);
        let verdict = self.verdict();
        let score = self.score_text();
        let mut out = format!(
            "# mceip conform\n\nCommand: `{command}`\n\nSettings: {settings}\n\n\
             {score}\n\n{verdict}\n\n"
        );

        let labels: Vec<&str> = Label::ALL.iter().map(|label| label.word()).collect();
        let labels = labels.join(" | ");
        let rule = "---|".repeat(Label::ALL.len() + 3);
        out += &format!("| flag | cases | {labels} | what it catches |\n|{rule}\n");
        for row in self.rows() {
            let of_flag = Flag::of_word(&row[0]).map(Flag::note);
            let of_difficulty = || Difficulty::of_word(&row[0]).map(Difficulty::note);
            let note = of_flag.or_else(of_difficulty).unwrap_or_default();
            out += &format!("| {} | {} |\n", row.join(" | "), escaped(note));
        }

        if !self.all_correct() {
            out += "\n| case | label | why |\n|---|---|---|\n";
        }
        for failure in self.failures() {
            let label = failure.judgement.label.word();
            let why = escaped(&failure.judgement.detail);
            out += &format!("| {} | {label} | {why} |\n", failure.id);
        }

        out
    }

    /// The same for programs, with every case.
    pub fn json(&self, head: &RunHead<'_>) -> Value {
        let failures: Vec<Value> = self.failures().map(failure_json).collect();
        let tier = head.pack.tier;
        let results = self
            .outcomes
            .iter()
            .map(|outcome| result_json(outcome, tier));
        let results: Vec<Value> = results.collect();
        json!({
            "format": RUN_FORMAT,
            "version": head.version,
            "pack": { "tier": tier, "version": head.pack.version },
            "command": head.command,
            "settings": head.settings,
            "cases": self.cases,
            "score": self.score,
            "labels": self.labels,
            "flags": self.flags,
            "difficulties": self.difficulties,
            "failures": failures,
            "results": results,
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

/// What came of a case.
fn result_json(outcome: &CaseOutcome, tier: u8) -> Value {
    let mut out = json!({
        "case": outcome.id,
        "tier": tier,
        "problem_sha256": outcome.problem_sha256,
        "label": outcome.judgement.label,
        "seconds": (outcome.seconds * 1e6).round() / 1e6,
        "found": outcome.judgement.found,
        "expected": outcome.expected,
        "flags": outcome.flags,
    });
    if let Some(difficulty) = outcome.difficulty {
        out["difficulty"] = json!(difficulty);
    }
    if let Some(completeness) = outcome.completeness {
        out["completeness"] = json!(completeness);
        out["unlisted"] = json!(outcome.judgement.unlisted);
    }
    out
}

/// A case that is not correct.
fn failure_json(failure: &CaseOutcome) -> Value {
    json!({
        "case": failure.id,
        "flags": failure.flags,
        "label": failure.judgement.label,
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
            problem_sha256: "0".repeat(64),
            flags: flags.iter().copied().collect(),
            difficulty: None,
            completeness: None,
            expected: usize::from(label == Label::Wrong),
            judgement: Judgement::new(label, "a | b"),
            seconds: 0.25,
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
        assert_eq!(summary.failures().count(), 1);

        assert!(summary.text().ends_with(
            "score: 1 of 2; 0 of the 1 cases with solutions; a program that always answers \
             \"none\": 1\n\
             2 cases: 1 correct, 0 incomplete, 0 inaccurate, 1 wrong, 0 crashed, 0 timed out, 0 malformed, 0 undecided\n"
        ));
        let head = RunHead {
            command: &["prog".into()],
            version: "1",
            pack: &PackName::of_tier(1),
            settings: "mceip 1; a | b",
        };
        let markdown = summary.markdown(&head);
        assert!(markdown.contains("| q | wrong | a \\| b |"));
        assert!(markdown.contains("Settings: mceip 1; a \\| b\n"));

        let json = summary.json(&head);
        assert_eq!(json["failures"][0]["case"], "q");
        assert_eq!(json["results"][0]["case"], "p");
        assert_eq!(json["results"][0]["seconds"], 0.25);
        assert_eq!(json["score"]["always_none"], 1);
    }
}
