//! The one reader of `spec/corpus`, whose README defines the files: every test that goes over
//! certificates with known verdicts takes them from here.
#![allow(dead_code, missing_docs, unreachable_pub)]

use serde_json::Value;
use std::path::{Path, PathBuf};

/// Exit codes of the checkers.
pub const ACCEPTED: i32 = 0;
pub const REJECTED: i32 = 1;
pub const MALFORMED: i32 = 2;
pub const UNDECIDED: i32 = 3;

/// The folders, and the verdicts that belong to each.
const FOLDERS: [(&str, &[&str]); 3] = [
    ("accept", &["accepted", "undecided"]),
    ("reject", &["rejected"]),
    ("malformed", &["malformed"]),
];

/// A file of the corpus.
pub struct Entry {
    /// Folder and name: `reject/cover-pivot`.
    pub name: String,
    /// As it stands on the disk.
    pub file: Value,
    /// The exit code of a checker.
    pub code: i32,
    /// The obligation that fails; empty where none does.
    pub reason: String,
    /// The text of the problem.
    pub problem: String,
    /// The text that claims to be its certificate, repetitions spelt out.
    pub certificate: String,
}

impl Entry {
    /// About an LCP or MCP, not an eigenproblem.
    pub fn is_plain(&self) -> bool {
        self.file["problem"]["format"] == "mceip-mcp/1"
    }

    /// About a body under loads and its contact states.
    pub fn is_loads(&self) -> bool {
        self.file["problem"]["format"] == "mceip-loads/1"
    }

    /// A long text that is spelt short.
    pub fn is_repeated(&self) -> bool {
        self.file.get("repeat").is_some()
    }

    /// Writes both texts to a folder: problem and certificate.
    pub fn write(&self, folder: &Path) -> [PathBuf; 2] {
        let stem = self.name.replace('/', "-");
        [
            ("problem", &self.problem),
            ("certificate", &self.certificate),
        ]
        .map(|(what, text)| {
            let path = folder.join(format!("{stem}.{what}.json"));
            std::fs::write(&path, text).unwrap();
            path
        })
    }
}

/// All files, by name.
pub fn entries() -> Vec<Entry> {
    let mut list = Vec::new();
    for (folder, _) in FOLDERS {
        for file in std::fs::read_dir(root().join(folder)).unwrap() {
            let path = file.unwrap().path();
            let stem = path.file_stem().unwrap().to_str().unwrap();
            list.push(entry(&format!("{folder}/{stem}")));
        }
    }

    list.sort_by(|a, b| a.name.cmp(&b.name));
    list
}

/// The file with this folder and name. Its frame has to be right: the format, a note, and a verdict
/// that belongs to the folder.
pub fn entry(name: &str) -> Entry {
    let text = std::fs::read_to_string(root().join(format!("{name}.json"))).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(file["format"], "mceip-corpus/1", "{name}");

    let note = file["note"].as_str().unwrap_or_default();
    assert!(!note.is_empty(), "{name}: which bug does it stand for?");

    let verdict = file["verdict"].as_str().unwrap();
    let belongs = |(folder, verdicts): &(&str, &[&str])| {
        name.starts_with(&format!("{folder}/")) && verdicts.contains(&verdict)
    };
    assert!(FOLDERS.iter().any(belongs), "{name}: {verdict}");

    Entry {
        name: name.into(),
        code: code(verdict),
        reason: file["reason"].as_str().unwrap_or_default().into(),
        problem: file["problem"].to_string(),
        certificate: spelt_out(&file),
        file,
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/corpus")
}

fn code(verdict: &str) -> i32 {
    match verdict {
        "accepted" => ACCEPTED,
        "rejected" => REJECTED,
        "malformed" => MALFORMED,
        "undecided" => UNDECIDED,
        other => panic!("{other}"),
    }
}

/// The certificate's text: as it stands, or with the mark replaced by copies of the unit.
fn spelt_out(file: &Value) -> String {
    let Some(text) = file["certificate_text"].as_str() else {
        return file["certificate"].to_string();
    };
    let Some(repeat) = file.get("repeat") else {
        return text.into();
    };

    let mark = repeat["mark"].as_str().unwrap();
    let unit = repeat["unit"].as_str().unwrap();
    let count = usize::try_from(repeat["count"].as_u64().unwrap()).unwrap();
    text.replacen(mark, &unit.repeat(count), 1)
}
