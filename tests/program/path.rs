//! `mceip path` from outside: the problem files of its states (texts are in `tests/transcripts`).
#![cfg(feature = "cli")]

use crate::common::{exits, repository};
use crate::program::Folder;
use std::collections::BTreeSet;

/// The names of the files in a folder.
fn names(folder: &str) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

/// Files of an earlier path would be taken for states of this one; what has another name stays.
#[test]
fn states_of_an_earlier_path_are_removed_and_nothing_else() {
    let loads = repository("spec/examples/loads.json");
    let folder = Folder::new();
    let states = folder.path("states");
    exits(0, &["path", &loads, "--states", &states]);
    let first = names(&states);
    assert!(!first.is_empty());

    for name in ["stretch-777.json", "stretch-x.json", "notes.txt"] {
        folder.write(&format!("states/{name}"), "of an earlier path");
    }
    exits(0, &["path", &loads, "--states", &states]);

    let mut kept = first;
    kept.extend(["stretch-x.json", "notes.txt"].map(String::from));
    assert_eq!(names(&states), kept);
}
