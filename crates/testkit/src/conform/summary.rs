//! Outcomes per flag: for people, as Markdown, as JSON.

use super::flag::Flag;
use super::judge::Label;
use super::run::Outcome;
use mceip_engine::report::Table;
use serde_json::{Value, json};
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
    pub failures: Vec<Outcome>,
}

/// Counts outcomes.
pub fn summarise(outcomes: &[Outcome]) -> Summary {
    let mut summary = Summary {
        cases: outcomes.len(),
        labels: BTreeMap::new(),
        flags: BTreeMap::new(),
        failures: Vec::new(),
    };

    for o in outcomes {
        *summary.labels.entry(o.judgement.label).or_default() += 1;
        for flag in &o.flags {
            *summary
                .flags
                .entry(*flag)
                .or_default()
                .entry(o.judgement.label)
                .or_default() += 1;
        }

        if !o.judgement.label.is_correct() {
            summary.failures.push(o.clone());
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

    fn count(&self, label: Label) -> usize {
        self.labels.get(&label).copied().unwrap_or(0)
    }

    fn rows(&self) -> Vec<Vec<String>> {
        let row = |name: &str, counts: &BTreeMap<Label, usize>| {
            let numbers = Label::ALL.iter().map(|l| {
                counts
                    .get(l)
                    .map_or_else(|| ".".into(), ToString::to_string)
            });

            let total: usize = counts.values().sum();
            [name.to_string(), total.to_string()]
                .into_iter()
                .chain(numbers)
                .collect()
        };

        let flags = Flag::ALL
            .iter()
            .filter_map(|f| self.flags.get(f).map(|c| row(f.word(), c)));
        flags.chain([row("all", &self.labels)]).collect()
    }

    fn verdict(&self) -> String {
        let parts: Vec<String> = Label::ALL
            .iter()
            .map(|&l| format!("{} {}", self.count(l), l.word()))
            .collect();

        format!("{} cases: {}", self.cases, parts.join(", "))
    }

    /// A table for people, the first failures, one line of verdict.
    pub fn text(&self) -> String {
        let header: Vec<&str> = ["flag", "cases"]
            .into_iter()
            .chain(Label::ALL.iter().map(|l| l.word()))
            .collect();
        let mut table = Table::new(&header);
        self.rows().into_iter().for_each(|r| table.row(r));

        let mut out = format!("{table}\n");
        for o in self.failures.iter().take(SHOWN) {
            out += &format!(
                "{}: {}: {}\n",
                o.id,
                o.judgement.label.word(),
                o.judgement.detail
            );
        }

        if self.failures.len() > SHOWN {
            out += &format!(
                "and {} more (--json or --markdown list all)\n",
                self.failures.len() - SHOWN
            );
        }

        out + &self.verdict() + "\n"
    }

    /// The same as Markdown, with the notes of the flags and all failures.
    pub fn markdown(&self, command: &[String]) -> String {
        let escape = |s: &str| s.replace('|', "\\|").replace('`', "'").replace('<', "&lt;");
        let labels = Label::ALL.map(Label::word).join(" | ");

        let mut out = format!(
            "# mceip conform\n\nCommand: `{}`\n\n{}\n\n",
            escape(&command.join(" ")),
            self.verdict()
        );

        out += &format!(
            "| flag | cases | {labels} | what it catches |\n|{}\n",
            "---|".repeat(Label::ALL.len() + 3)
        );

        for row in self.rows() {
            let note = Flag::of_word(&row[0]).map_or("", Flag::note);
            out += &format!("| {} | {} |\n", row.join(" | "), escape(note));
        }

        if !self.failures.is_empty() {
            out += "\n| case | label | why |\n|---|---|---|\n";
        }

        for o in &self.failures {
            out += &format!(
                "| {} | {} | {} |\n",
                o.id,
                o.judgement.label.word(),
                escape(&o.judgement.detail)
            );
        }

        out
    }

    /// The same for programs.
    pub fn json(&self, command: &[String]) -> Value {
        let counts = |c: &BTreeMap<Label, usize>| {
            c.iter()
                .map(|(l, n)| (l.word().to_string(), json!(n)))
                .collect::<serde_json::Map<_, _>>()
        };

        let flags: serde_json::Map<_, _> = self
            .flags
            .iter()
            .map(|(f, c)| (f.word().to_string(), json!(counts(c))))
            .collect();

        let failure = |o: &Outcome| {
            let flags: Vec<&str> = o.flags.iter().map(|f| f.word()).collect();
            json!({
                "case": o.id,
                "flags": flags,
                "label": o.judgement.label.word(),
                "detail": o.judgement.detail,
            })
        };

        json!({
            "command": command, "cases": self.cases, "labels": counts(&self.labels), "flags": flags,
            "failures": self.failures.iter().map(failure).collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conform::Judgement;

    #[test]
    fn a_case_counts_for_each_of_its_flags() {
        let outcome = |id: &str, label, flags: &[Flag]| Outcome {
            id: id.into(),
            flags: flags.iter().copied().collect(),
            judgement: Judgement {
                label,
                detail: "a | b".into(),
            },
        };

        let list = [
            outcome("p", Label::Correct, &[Flag::Mu]),
            outcome("q", Label::Wrong, &[Flag::Mu, Flag::Fold]),
        ];
        let s = summarise(&list);
        assert!(!s.all_correct() && summarise(&list[..1]).all_correct());

        assert_eq!(
            s.flags[&Flag::Mu],
            BTreeMap::from([(Label::Correct, 1), (Label::Wrong, 1)])
        );
        assert_eq!((s.flags[&Flag::Fold].len(), s.failures.len()), (1, 1));
        assert!(s.text().ends_with(
            "2 cases: 1 correct, 0 incomplete, 1 wrong, 0 crashed, 0 timed out, 0 malformed\n"
        ));

        assert!(
            s.markdown(&["prog".into()])
                .contains("| q | wrong | a \\| b |")
        );
        assert_eq!(s.json(&[])["failures"][0]["case"], "q");
    }
}
