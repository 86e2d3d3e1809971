//! Two or more runs of `mceip conform` side by side: tables, and a performance profile.
//!
//! Input: what `mceip conform --json` has printed for each program, over the same cases of the same
//! pack. Output: Markdown, LaTeX, and the steps of the profile of Dolan and Moré (Mathematical
//! Programming 91, 2002): of all cases, the share that a program answers correctly within tau times
//! the least time of any program that does.
//!
//! ```text
//! rho_s(tau) = |{ p : s correct on p, t_(p,s) <= tau min_s' t_(p,s') }| / |{ p }|
//! ```

use super::case::Difficulty;
use super::judge::Label;
use super::summary::RUN_FORMAT;
use crate::error::TestkitError;
use mceip_engine::report::counted;
use mceip_model::file::from_json_of;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The fields of a run that are compared; it has others.
#[derive(Deserialize)]
struct RawRun {
    version: String,
    settings: String,
    pack: RawPackName,
    results: Vec<CaseRecord>,
}

/// Tier and version of the pack.
#[derive(Deserialize, PartialEq)]
struct RawPackName {
    tier: u8,
    version: String,
}

/// What a program did with a case.
#[derive(Debug, Clone, PartialEq, Deserialize)]
struct CaseRecord {
    #[serde(rename = "case")]
    id: String,
    problem_sha256: String,
    label: Label,
    seconds: f64,
    found: usize,
    expected: usize,
    difficulty: Option<Difficulty>,
}

/// A run of one program.
#[derive(Debug, Clone, PartialEq)]
pub struct ConformRun {
    name: String,
    version: String,
    pack: String,
    /// The options of the run: with other ones times mean something else.
    options: String,
    records: Vec<CaseRecord>,
}

impl ConformRun {
    /// Reads what `mceip conform --json` has printed; `name` is the program's in tables.
    ///
    /// # Errors
    /// [`TestkitError::Problem`] for other JSON, [`TestkitError::OtherRun`] for counts or a time
    /// that cannot be.
    pub fn read(name: &str, text: &str) -> Result<ConformRun, TestkitError> {
        let raw = from_json_of(RUN_FORMAT, text);
        let raw: RawRun = raw.map_err(|e| TestkitError::problem(name, e))?;
        for record in &raw.results {
            record.require_possible(name)?;
        }
        Ok(ConformRun {
            name: name.to_owned(),
            version: raw.version,
            options: options_of(&raw.settings),
            pack: format!("{} of tier {}", raw.pack.version, raw.pack.tier),
            records: raw.results,
        })
    }

    fn correct(&self) -> impl Iterator<Item = &CaseRecord> {
        self.records
            .iter()
            .filter(|record| record.label.is_correct())
    }

    fn count(&self, label: Label) -> usize {
        let records = self.records.iter();
        records.filter(|record| record.label == label).count()
    }

    /// The median of the seconds of the cases that are correct; none where none is.
    fn median_seconds(&self) -> Option<f64> {
        let mut seconds: Vec<f64> = self.correct().map(|record| record.seconds).collect();
        seconds.sort_by(f64::total_cmp);
        seconds.get(seconds.len() / 2).copied()
    }
}

impl CaseRecord {
    fn require_possible(&self, run: &str) -> Result<(), TestkitError> {
        let is_time = self.seconds.is_finite() && self.seconds >= 0.0;
        if self.found <= self.expected && is_time {
            return Ok(());
        }

        Err(TestkitError::OtherRun {
            run: run.to_owned(),
            expected: format!("{}: found <= expected and seconds >= 0", self.id),
            got: format!("{} of {} in {} s", self.found, self.expected, self.seconds),
        })
    }
}

/// Runs over the same cases.
#[derive(Debug, Clone, PartialEq)]
pub struct ConformComparison {
    runs: Vec<ConformRun>,
}

/// The share of the cases that a program answers correctly, over the ratio to the least time.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileSteps {
    /// The program.
    pub name: String,
    /// Ratios at which the share grows, ascending, and the share from there on.
    pub steps: Vec<(f64, f64)>,
}

impl ConformComparison {
    /// Takes the runs together.
    ///
    /// # Errors
    /// [`TestkitError::OtherRun`] where a run is of another version of `mceip` or of the pack, of
    /// other cases, with other options, or has the name of another run.
    pub fn new(runs: Vec<ConformRun>) -> Result<ConformComparison, TestkitError> {
        for (k, run) in runs.iter().enumerate() {
            let first = &runs[0];
            let refuse = |expected: String, got: String| TestkitError::OtherRun {
                run: run.name.clone(),
                expected,
                got,
            };

            if run.version != first.version {
                let expected = format!("mceip {} as {}", first.version, first.name);
                return Err(refuse(expected, run.version.clone()));
            }
            if run.pack != first.pack {
                let expected = format!("the pack {} as {}", first.pack, first.name);
                return Err(refuse(expected, run.pack.clone()));
            }
            if cases_of(run) != cases_of(first) {
                let count = counted(first.records.len(), "case");
                let expected = format!("the {count} of {}", first.name);
                return Err(refuse(expected, differing_case(run, first)));
            }
            if run.options != first.options {
                let expected = format!("the options {} as {}", first.options, first.name);
                return Err(refuse(expected, run.options.clone()));
            }
            if runs[..k].iter().any(|other| other.name == run.name) {
                let expected = "a file with a name of its own, which is that of the program";
                return Err(refuse(expected.into(), run.name.clone()));
            }
        }

        Ok(ConformComparison { runs })
    }

    /// Cases of each run.
    fn cases(&self) -> &[CaseRecord] {
        self.runs.first().map_or(&[], |run| &run.records)
    }

    /// The header and a row for each program, and one for a program that always answers "none".
    fn table(&self) -> Vec<Vec<String>> {
        let header = [
            "program",
            "correct",
            "with solutions",
            "solutions",
            "incomplete",
            "inaccurate",
            "wrong",
            "no answer",
            "median s",
        ];
        let mut rows = vec![header.map(str::to_owned).to_vec()];

        let cases = self.cases();
        let with_solutions = cases.iter().filter(|case| case.expected > 0).count();
        let solutions: usize = cases.iter().map(|case| case.expected).sum();
        for run in &self.runs {
            let correct = run.correct().count();
            let of_those = run.correct().filter(|record| record.expected > 0).count();
            let found: usize = run.records.iter().map(|record| record.found).sum();
            let incomplete = run.count(Label::Incomplete);
            let inaccurate = run.count(Label::Inaccurate);
            let wrong = run.count(Label::Wrong);
            let judged = correct + incomplete + inaccurate + wrong;
            let median = run.median_seconds().map(|s| format!("{s:.3}"));
            rows.push(vec![
                run.name.clone(),
                format!("{correct} of {}", cases.len()),
                format!("{of_those} of {with_solutions}"),
                format!("{found} of {solutions}"),
                incomplete.to_string(),
                inaccurate.to_string(),
                wrong.to_string(),
                (cases.len() - judged).to_string(),
                median.unwrap_or_else(|| "-".into()),
            ]);
        }

        let nothing = cases.len() - with_solutions;
        rows.push(vec![
            "always none".into(),
            format!("{nothing} of {}", cases.len()),
            format!("0 of {with_solutions}"),
            format!("0 of {solutions}"),
            with_solutions.to_string(),
            "0".into(),
            "0".into(),
            "0".into(),
            "-".into(),
        ]);
        rows
    }

    /// The header and a row for each program: correct cases of each difficulty. Empty where no case
    /// has one.
    fn table_of_difficulties(&self) -> Vec<Vec<String>> {
        let mut totals: BTreeMap<Difficulty, usize> = BTreeMap::new();
        for case in self.cases() {
            if let Some(difficulty) = case.difficulty {
                *totals.entry(difficulty).or_default() += 1;
            }
        }
        if totals.is_empty() {
            return Vec::new();
        }

        let mut header = vec!["program".to_owned()];
        header.extend(totals.keys().map(|difficulty| difficulty.word().to_owned()));
        let mut rows = vec![header];
        for run in &self.runs {
            let mut row = vec![run.name.clone()];
            for (difficulty, total) in &totals {
                let of_it = |record: &&CaseRecord| record.difficulty == Some(*difficulty);
                let correct = run.correct().filter(of_it).count();
                row.push(format!("{correct} of {total}"));
            }
            rows.push(row);
        }
        rows
    }

    /// What was run, in a line.
    fn caption(&self) -> String {
        let first = self.runs.first();
        let version = first.map_or("", |run| &run.version);
        let pack = first.map_or("", |run| &run.pack);
        format!(
            "{} of the pack {pack}, mceip {version}",
            counted(self.cases().len(), "case")
        )
    }

    /// Both tables as Markdown.
    pub fn markdown(&self) -> String {
        let mut out = format!("{}.\n", self.caption());
        for table in [self.table(), self.table_of_difficulties()] {
            for (k, row) in table.iter().enumerate() {
                if k == 0 {
                    out += "\n";
                }
                let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
                out += &format!("| {} |\n", cells.join(" | "));
                if k == 0 {
                    out += &format!("|{}\n", "---|".repeat(row.len()));
                }
            }
        }
        out
    }

    /// Both tables as LaTeX, for the package booktabs.
    pub fn latex(&self) -> String {
        let mut out = format!("% {}; needs \\usepackage{{booktabs}}\n", self.caption());
        for table in [self.table(), self.table_of_difficulties()] {
            let Some(header) = table.first() else {
                continue;
            };
            let columns = "r".repeat(header.len() - 1);
            out += &format!("\\begin{{tabular}}{{l{columns}}}\n\\toprule\n");
            for (k, row) in table.iter().enumerate() {
                let cells: Vec<String> = row.iter().map(|cell| escaped(cell)).collect();
                out += &format!("{} \\\\\n", cells.join(" & "));
                if k == 0 {
                    out += "\\midrule\n";
                }
            }
            out += "\\bottomrule\n\\end{tabular}\n\n";
        }
        out
    }

    /// The performance profile.
    pub fn profile(&self) -> Vec<ProfileSteps> {
        let count = self.cases().len();
        let mut least = vec![f64::INFINITY; count];
        for run in &self.runs {
            for (best, record) in least.iter_mut().zip(&run.records) {
                if record.label.is_correct() {
                    *best = best.min(time(record));
                }
            }
        }

        let steps_of = |run: &ConformRun| {
            let pairs = run.records.iter().zip(&least);
            let correct = pairs.filter(|(record, _)| record.label.is_correct());
            let mut ratios: Vec<f64> = correct.map(|(record, best)| time(record) / best).collect();
            ratios.sort_by(f64::total_cmp);

            let shares = (1..=ratios.len()).map(|k| k as f64 / count as f64);
            ratios.iter().copied().zip(shares).collect()
        };
        let profiles = self.runs.iter().map(|run| ProfileSteps {
            name: run.name.clone(),
            steps: steps_of(run),
        });
        profiles.collect()
    }
}

/// How hard a case is by the runs of several programs: [`Difficulty::Easy`] where each is correct,
/// [`Difficulty::Hard`] where none is and none finds half of the solutions. `None` where a run does
/// not have the case, or without runs.
pub fn measured_difficulty(runs: &[ConformRun], case: &str) -> Option<Difficulty> {
    let mut records = Vec::new();
    for run in runs {
        records.push(run.records.iter().find(|record| record.id == case)?);
    }
    if records.is_empty() {
        return None;
    }

    let is_half = |r: &CaseRecord| r.expected > 0 && 2 * r.found >= r.expected;
    let is_correct = |r: &CaseRecord| r.label.is_correct();
    Some(if records.iter().all(|r| is_correct(r)) {
        Difficulty::Easy
    } else if records.iter().any(|r| is_correct(r) || is_half(r)) {
        Difficulty::Medium
    } else {
        Difficulty::Hard
    })
}

/// What the seconds of a run are rounded to.
const MICROSECOND: f64 = 1.0 / 1_000_000.0;

/// The seconds of a case, at least what they are rounded to.
fn time(record: &CaseRecord) -> f64 {
    record.seconds.max(MICROSECOND)
}

/// The options in a run's settings: not the version, and not where the pack stands.
fn options_of(settings: &str) -> String {
    let options = settings.split("; ").filter(|word| word.starts_with("--"));
    options.collect::<Vec<_>>().join(" ")
}

/// The cases of a run by id and problem, in its order.
fn cases_of(run: &ConformRun) -> Vec<(&str, &str)> {
    let records = run.records.iter();
    let names = records.map(|record| (record.id.as_str(), record.problem_sha256.as_str()));
    names.collect()
}

/// Where the cases of a run begin to differ from those of the first one, in words.
fn differing_case(run: &ConformRun, first: &ConformRun) -> String {
    let pairs = cases_of(run).into_iter().zip(cases_of(first));
    for (got, expected) in pairs {
        if got.0 != expected.0 {
            return format!("{} where {} is expected", got.0, expected.0);
        }
        if got.1 != expected.1 {
            return format!("another problem as {} (--as-pencil?)", got.0);
        }
    }
    counted(run.records.len(), "case")
}

/// Text for a cell of a LaTeX table.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                out.push('\\');
                out.push(letter);
            }
            '\\' => out += "\\textbackslash{}",
            '~' => out += "\\textasciitilde{}",
            '^' => out += "\\textasciicircum{}",
            _ => out.push(letter),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    /// A run over two cases, with these labels and seconds.
    fn run(name: &str, results: [(&str, f64); 2]) -> ConformRun {
        ConformRun::read(name, &text(results).to_string()).unwrap()
    }

    fn text(results: [(&str, f64); 2]) -> Value {
        let results = results
            .iter()
            .zip(["p", "q"])
            .map(|((label, seconds), id)| {
                json!({
                    "case": id, "problem_sha256": id, "label": label, "seconds": seconds,
                    "found": usize::from(*label == "correct"), "expected": 1, "difficulty": "easy",
                })
            });
        json!({
            "format": RUN_FORMAT,
            "version": "1",
            "settings": "mceip 1; the pack in a folder; --lines; --time-limit 10",
            "pack": { "tier": 1, "version": "1.1.0" },
            "results": results.collect::<Vec<_>>(),
        })
    }

    #[test]
    fn a_profile_has_the_shares_of_dolan_and_more() {
        let fast = run("fast", [("correct", 1.0), ("wrong", 1.0)]);
        let sure = run("sure_one", [("correct", 4.0), ("correct", 2.0)]);
        let comparison = ConformComparison::new(vec![fast, sure]).unwrap();

        let profile = comparison.profile();
        assert_eq!(profile[0].steps, [(1.0, 0.5)]);
        assert_eq!(profile[1].steps, [(1.0, 0.5), (4.0, 1.0)]);

        let markdown = comparison.markdown();
        assert!(
            markdown.contains("| sure_one | 2 of 2 | 2 of 2 | 2 of 2 | 0 | 0 | 0 | 0 | 4.000 |")
        );
        assert!(markdown.contains("| fast | 1 of 2 | 1 of 2 | 1 of 2 | 0 | 0 | 1 | 0 | 1.000 |"));
        assert!(markdown.contains("| always none | 0 of 2 |"));
        assert!(markdown.contains("| fast | 1 of 2 |\n"), "{markdown}");
        assert!(comparison.latex().contains("sure\\_one & 2 of 2"));

        // Where the pack stands is not an option.
        let mut elsewhere = text([("correct", 1.0), ("correct", 1.0)]);
        elsewhere["settings"] = json!("mceip 1; the pack in another; --lines; --time-limit 10");
        let elsewhere = ConformRun::read("elsewhere", &elsewhere.to_string()).unwrap();
        let runs = vec![comparison.runs[0].clone(), elsewhere];
        assert!(ConformComparison::new(runs).is_ok());
    }

    #[test]
    fn runs_that_are_not_over_the_same_cases_are_refused() {
        let good = [("correct", 1.0), ("correct", 1.0)];
        let base = run("base", good);

        for (path, value) in [
            ("/version", json!("2")),
            ("/settings", json!("mceip 1; --time-limit 10")),
            ("/pack/tier", json!(2)),
            ("/results/1/case", json!("r")),
            ("/results/1/problem_sha256", json!("r")),
        ] {
            let mut changed = text(good);
            *changed.pointer_mut(path).unwrap() = value;
            let other = ConformRun::read("other", &changed.to_string()).unwrap();
            let compared = ConformComparison::new(vec![base.clone(), other]);
            let is_refused = matches!(compared, Err(TestkitError::OtherRun { .. }));
            assert!(is_refused, "{path}: {compared:?}");
        }

        let same_name = ConformComparison::new(vec![base.clone(), base]);
        assert!(matches!(same_name, Err(TestkitError::OtherRun { .. })));
    }

    #[test]
    fn malformed_runs_are_refused() {
        let good = text([("correct", 1.0), ("correct", 1.0)]);
        for (path, value) in [
            ("/format", json!("mceip-conform/2")),
            ("/results", json!(1)),
            ("/results/0/label", json!("perfect")),
            ("/results/0/difficulty", json!("trivial")),
            ("/results/0/seconds", json!(-1)),
            ("/results/0/found", json!(2)),
        ] {
            let mut changed = good.clone();
            *changed.pointer_mut(path).unwrap() = value;
            let read = ConformRun::read("bad", &changed.to_string());
            assert!(read.is_err(), "{path}");
        }
        assert!(ConformRun::read("bad", "{").is_err());
    }
}
