//! `spec/mutants`: what it lists exists, and every room has its score. The mutants are run by
//! `spec/mutants/run`.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join("spec/mutants").join(name)).unwrap()
}

/// Mutants said to be equivalent: their file, the change, how many of them.
struct Listed {
    file: String,
    change: String,
    count: usize,
}

/// The entries, each group with its reason.
fn listed() -> Vec<(Vec<Listed>, String)> {
    let (mut groups, mut group) = (Vec::new(), Vec::new());
    for line in read("equivalent.txt")
        .lines()
        .filter(|l| !l.starts_with('#') && !l.trim().is_empty())
    {
        if let Some(reason) = line.strip_prefix("    ") {
            groups.push((std::mem::take(&mut group), reason.trim().to_string()));
            continue;
        }
        let parts: Vec<&str> = line.splitn(3, " | ").collect();
        let [file, change, count] = parts[..] else {
            panic!("{line}: expected file | change | xN")
        };
        let count = count
            .strip_prefix('x')
            .and_then(|n| n.parse().ok())
            .unwrap_or_else(|| panic!("{line}: xN"));
        group.push(Listed {
            file: file.into(),
            change: change.into(),
            count,
        });
    }
    assert!(group.is_empty(), "entries without a reason at the end");
    groups
}

#[test]
fn every_equivalent_mutant_has_its_function_and_a_reason() {
    let groups = listed();
    assert!(groups.iter().map(|(g, _)| g.len()).sum::<usize>() >= 20);
    for (group, reason) in groups {
        assert!(
            reason.len() > 15 && !group.is_empty(),
            "{reason:?} of {} mutants",
            group.len()
        );
        for m in group {
            let path = root().join(&m.file);
            let source = std::fs::read_to_string(&path)
                .unwrap_or_else(|e| panic!("{}: {e}: gone from under equivalent.txt", m.file));
            // The function it is in, without its type and generics.
            let (what, function) = m
                .change
                .rsplit_once(" in ")
                .unwrap_or_else(|| panic!("{}: no function", m.change));
            let name = function.rsplit("::").next().unwrap();
            assert!(
                source.contains(&format!("fn {name}")),
                "{}: no function {name}",
                m.file
            );
            assert!(m.count >= 1);
            // What is replaced stands in the file, if it is an operator.
            if let Some(operator) = what
                .strip_prefix("replace ")
                .and_then(|w| w.split_once(" with "))
                .map(|(o, _)| o)
                .filter(|o| !o.contains(' '))
            {
                assert!(source.contains(operator), "{}: no {operator}", m.file);
            }
        }
    }
}

/// Room, score: the rows of the table in `README.md`.
fn scores() -> Vec<(String, f64)> {
    let text = read("README.md");
    let table = text
        .split_once("<!-- score -->")
        .unwrap()
        .1
        .split_once("<!-- end of score -->")
        .unwrap()
        .0
        .to_string();
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let score = cells.last()?.strip_suffix(" %")?.parse().ok()?;
        Some((cells[0].to_string(), score))
    };
    table.lines().filter_map(row).collect()
}

/// All of what decides, and a sample of the rooms that feed it.
#[test]
fn every_room_has_its_score() {
    let scores = scores();
    for room in [
        "check",
        "oracle",
        "reduction",
        "exact",
        "model",
        "certify",
        "solver",
    ] {
        let (_, score) = scores
            .iter()
            .find(|(r, _)| r == room)
            .unwrap_or_else(|| panic!("no score of {room}"));
        let least = if ["check", "oracle", "reduction"].contains(&room) {
            100.0
        } else {
            95.0
        };
        assert!((least..=100.0).contains(score), "{room}: {score}");
    }
}
