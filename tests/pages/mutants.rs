//! `spec/mutants`: the mutants listed as equivalent exist in the sources and have a reason, and
//! every part has a sufficient score. The mutants themselves are run by `spec/mutants/run`.
//!
//! The truth is the source files. An entry whose function or operator is gone, or a score below the
//! least one, fails here.

use crate::{read, root};

/// Mutants said to be equivalent: their file, the change, how many of them.
struct Listed {
    file: String,
    change: String,
    count: usize,
}

/// Entries of the list that share one reason.
struct Group {
    mutants: Vec<Listed>,
    reason: String,
}

/// The groups of `equivalent.txt`: lines of mutants, and after them the reason, indented.
fn listed() -> Vec<Group> {
    let mut groups = Vec::new();
    let mut mutants = Vec::new();
    let text = read("spec/mutants/equivalent.txt");

    for line in text.lines() {
        if line.starts_with('#') || line.trim().is_empty() {
            continue;
        }

        if let Some(reason) = line.strip_prefix("    ") {
            groups.push(Group {
                mutants: std::mem::take(&mut mutants),
                reason: reason.trim().to_string(),
            });
        } else {
            mutants.push(read_mutant(line));
        }
    }

    assert!(mutants.is_empty(), "entries without a reason at the end");
    groups
}

/// Reads a line `file | change | xN`.
fn read_mutant(line: &str) -> Listed {
    let parts: Vec<&str> = line.splitn(3, " | ").collect();
    let [file, change, count] = parts[..] else {
        panic!("{line}: expected file | change | xN")
    };
    let count = count
        .strip_prefix('x')
        .and_then(|number| number.parse().ok())
        .unwrap_or_else(|| panic!("{line}: xN"));

    Listed {
        file: file.into(),
        change: change.into(),
        count,
    }
}

#[test]
fn every_equivalent_mutant_has_its_function_and_a_reason() {
    let groups = listed();
    let total: usize = groups.iter().map(|group| group.mutants.len()).sum();
    assert!(total >= 20);

    for group in groups {
        let reason = &group.reason;
        assert!(!group.mutants.is_empty(), "{reason:?} of no mutant");
        assert!(reason.len() > 15, "{reason:?} is no reason");

        for mutant in &group.mutants {
            exists_in_its_file(mutant);
            assert!(mutant.count >= 1);
        }
    }
}

/// The file of a mutant has its function and, if an operator is replaced, that operator.
#[track_caller]
fn exists_in_its_file(mutant: &Listed) {
    let file = &mutant.file;
    let source = std::fs::read_to_string(root().join(file))
        .unwrap_or_else(|error| panic!("{file}: {error}: named in equivalent.txt, and gone"));

    // The name of the function, without its type.
    let (what, function) = mutant
        .change
        .rsplit_once(" in ")
        .unwrap_or_else(|| panic!("{}: no function", mutant.change));
    let name = function.rsplit("::").next().unwrap();

    assert!(
        source.contains(&format!("fn {name}")),
        "{file}: no function {name}"
    );

    let replacement = what.strip_prefix("replace ");
    if let Some((replaced, _)) = replacement.and_then(|words| words.split_once(" with ")) {
        let is_operator = !replaced.contains(' ');
        assert!(
            !is_operator || source.contains(replaced),
            "{file}: no {replaced}"
        );
    }
}

/// The score of a part in percent.
struct Score {
    part: String,
    percent: f64,
}

/// The rows of the table of scores in `spec/mutants/score.md`.
fn scores() -> Vec<Score> {
    let text = read("spec/mutants/score.md");
    let (_, after) = text.split_once("<!-- score -->").unwrap();
    let (table, _) = after.split_once("<!-- end of score -->").unwrap();

    table.lines().filter_map(read_score).collect()
}

/// Reads a row of the table; nothing for its head.
fn read_score(row: &str) -> Option<Score> {
    let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
    let percent = cells.last()?.strip_suffix(" %")?.parse().ok()?;
    let part = cells[0].to_string();

    Some(Score { part, percent })
}

/// Everything that decides has 100 %, the parts that feed it at least 95 %.
#[test]
fn every_room_has_its_score() {
    let scores = scores();

    for part in [
        "check",
        "oracle",
        "reduction",
        "exact",
        "model",
        "certify",
        "solver",
    ] {
        let score = scores
            .iter()
            .find(|score| score.part == part)
            .unwrap_or_else(|| panic!("no score of {part}"));

        let decides = ["check", "oracle", "reduction"].contains(&part);
        let least = if decides { 100.0 } else { 95.0 };
        let percent = score.percent;
        assert!((least..=100.0).contains(&percent), "{part}: {percent}");
    }
}
