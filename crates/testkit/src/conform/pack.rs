//! The pack as files: one per group and an index with counts and digests, byte for byte the same
//! each time.
//!
//! [`pack_files`] writes: groups in, names and contents out. [`read_pack`] reads a folder back and
//! compares digests and answers. Called by `mceip conform --write`, `mceip conform --pack`, and by
//! the test that compares `spec/conformance-pack/` with what is written.

use super::case::{Case, Difficulty, Draft, Group};
use super::certified::Completeness;
use super::flag::Flag;
use super::wrong::Bug;
use crate::error::TestkitError;
use mceip_engine::run::{Progress, Watch};
use mceip_model::file::{from_json_of, read_problem, read_text};
use mceip_model::{ModelError, sha256};
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The format of a group of cases.
pub const PACK_FORMAT: &str = "mceip-pack/1";
/// The format of the index.
pub const INDEX_FORMAT: &str = "mceip-pack-index/1";
/// The version of the cases. Major: a case is changed or removed, or its answer corrected; minor:
/// cases or fields are added; patch: words only.
pub const PACK_VERSION: &str = "1.2.0";

/// Cases that belong together by size: a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PackName {
    /// 1: small, exact; 2: n = 10 to 200.
    pub tier: u8,
    /// [`PACK_VERSION`] of the program that wrote it; empty for a pack without a version.
    pub version: String,
}

impl PackName {
    /// The cases of this program.
    pub fn of_tier(tier: u8) -> PackName {
        PackName {
            tier,
            version: PACK_VERSION.into(),
        }
    }
}

/// A pack: what it is, and its cases.
#[derive(Debug, Clone)]
pub struct CasePack {
    /// Tier and version.
    pub name: PackName,
    /// Its cases.
    pub groups: Vec<Group>,
}

/// The files of the pack, name and content: groups in order, then `index.json`. `watch` hears how
/// many cases are answered.
///
/// # Errors
/// [`TestkitError`] for a problem whose answer is not found.
pub fn pack_files(
    pack: &CasePack,
    watch: &Watch<'_>,
) -> Result<Vec<(String, String)>, TestkitError> {
    let mut files = Vec::new();
    let total = pack.groups.iter().map(|group| group.drafts.len()).sum();
    let answered = AtomicUsize::new(0);
    let answer = |draft: &Draft| {
        let case = Case::answer(draft, false, watch)?;
        let count = answered.fetch_add(1, Ordering::Relaxed) + 1;
        watch.report(&Progress::of("cases", count, total));
        Ok(case)
    };
    let mut counts = Counts::default();

    for group in &pack.groups {
        let cases: Vec<Case> = group
            .drafts
            .par_iter()
            .map(answer)
            .collect::<Result<_, TestkitError>>()?;
        let lines: Vec<CaseLine> = cases.par_iter().map(CaseLine::of).collect();

        let text = group_text(group, &lines);
        let file = format!("{}.json", group.name);
        counts.add(&cases, &lines);
        counts.groups.push(json!({
            "file": file,
            "comment": group.comment,
            "cases": cases.len(),
            "wrong": lines.iter().map(|line| line.bugs.len()).sum::<usize>(),
            "sha256": sha256(&text),
        }));
        files.push((file, text));
    }

    files.push(("index.json".into(), counts.index_text(&pack.name)));
    Ok(files)
}

/// What the index says of all groups.
#[derive(Default)]
struct Counts {
    cases: usize,
    /// One entry per group: its file, how many cases, the digest.
    groups: Vec<Value>,
    /// Cases per flag.
    flags: BTreeMap<Flag, usize>,
    /// Wrong answers per bug.
    bugs: BTreeMap<Bug, usize>,
}

impl Counts {
    /// Adds the cases of a group.
    fn add(&mut self, cases: &[Case], lines: &[CaseLine]) {
        self.cases += cases.len();
        for flag in cases.iter().flat_map(|case| &case.flags) {
            *self.flags.entry(*flag).or_default() += 1;
        }
        for bug in lines.iter().flat_map(|line| &line.bugs) {
            *self.bugs.entry(*bug).or_default() += 1;
        }
    }

    /// The content of `index.json`.
    fn index_text(self, name: &PackName) -> String {
        let mut flags = Map::new();
        for (flag, count) in &self.flags {
            let entry = json!({ "cases": count, "note": flag.note() });
            flags.insert(flag.word().into(), entry);
        }

        let mut bugs = Map::new();
        for (bug, count) in &self.bugs {
            let entry = json!({
                "count": count,
                "label": bug.expected(),
                "reason": bug.note(),
            });
            bugs.insert(bug.word().into(), entry);
        }

        let index = json!({
            "format": INDEX_FORMAT,
            "version": name.version,
            "tier": name.tier,
            "cases": self.cases,
            "groups": self.groups,
            "flags": flags,
            "bugs": bugs,
        });
        format!("{index:#}\n")
    }
}

/// One case per line, so that differences can be read.
fn group_text(group: &Group, lines: &[CaseLine]) -> String {
    let cases: Vec<&str> = lines.iter().map(|line| &line.text[..]).collect();
    let mut out = String::from("{\n");
    out += &format!("\"format\": {},\n", json!(PACK_FORMAT));
    out += &format!("\"group\": {},\n", json!(group.name));
    out += &format!("\"comment\": {},\n", json!(group.comment));
    out += "\"cases\": [\n";
    out += &cases.join(",\n");
    out += "\n]\n}\n";
    out
}

/// A case as the pack has it.
struct CaseLine {
    /// The JSON object, in one line.
    text: String,
    /// The mistakes behind its wrong answers.
    bugs: Vec<Bug>,
}

impl CaseLine {
    fn of(case: &Case) -> CaseLine {
        let mut bugs = Vec::new();
        let mut wrong = Vec::new();
        for answer in case.wrong_answers() {
            bugs.push(answer.bug);
            wrong.push(json!({
                "bug": answer.bug,
                "label": answer.bug.expected(),
                "reason": answer.bug.note(),
                "report": answer.report,
            }));
        }

        let mut line = case.json();
        line["wrong"] = wrong.into();

        CaseLine {
            text: line.to_string(),
            bugs,
        }
    }
}

/// `index.json`; fields with an underscore are for people.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawIndex {
    #[serde(default)]
    version: String,
    #[serde(default = "first_tier")]
    tier: u8,
    groups: Vec<RawEntry>,
    #[serde(rename = "cases")]
    _cases: usize,
    #[serde(rename = "flags")]
    _flags: Value,
    #[serde(rename = "bugs")]
    _bugs: Value,
}

/// The tier of a pack that does not say it.
fn first_tier() -> u8 {
    1
}

/// A group in the index.
#[derive(Deserialize)]
struct RawEntry {
    file: String,
    sha256: String,
}

/// The file of a group.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGroup {
    group: String,
    comment: String,
    cases: Vec<RawCase>,
}

/// A case in the file of its group.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCase {
    id: String,
    comment: String,
    flags: Vec<Flag>,
    problem: Value,
    answer: Value,
    #[serde(rename = "wrong")]
    _wrong: Value,
    completeness: Option<Completeness>,
    difficulty: Option<Difficulty>,
    /// Of the certificate that was checked when the case was written; another search may make
    /// another one, so it is not compared.
    #[serde(rename = "certificate_sha256")]
    _certificate: Option<String>,
}

/// Reads a pack from a folder by its index. Nothing in it is taken for granted: digests are
/// compared, and each case is answered again by the plain oracle ([`Case::answer`]) and the answer
/// compared. Where the oracle does not find it, the list is carried along and held against what is
/// found when [`Case::answer`] is called: that may take seconds for a case.
///
/// # Errors
/// [`TestkitError`]: unreadable or of another version, a digest, a problem, or an answer that
/// differs.
pub fn read_pack(folder: &Path) -> Result<CasePack, TestkitError> {
    let index = read_index(folder).map_err(|e| TestkitError::problem("index.json", e))?;
    let groups = index.groups.iter().map(|entry| read_group(folder, entry));
    Ok(CasePack {
        groups: groups.collect::<Result<_, _>>()?,
        name: PackName {
            tier: index.tier,
            version: index.version,
        },
    })
}

/// Reads `index.json`.
fn read_index(folder: &Path) -> Result<RawIndex, ModelError> {
    let text = read_text("the index", &folder.join("index.json"))?;
    from_json_of(INDEX_FORMAT, &text)
}

/// Reads the file of a group and answers its cases again.
fn read_group(folder: &Path, entry: &RawEntry) -> Result<Group, TestkitError> {
    let text = read_group_text(folder, &entry.file);
    let text = text.map_err(|e| TestkitError::problem(&entry.file, e))?;

    let got = sha256(&text);
    if got != entry.sha256 {
        return Err(TestkitError::Digest {
            file: entry.file.clone(),
            expected: entry.sha256.chars().take(80).collect(),
            got,
        });
    }

    let raw = from_json_of(PACK_FORMAT, &text);
    let raw: RawGroup = raw.map_err(|e| TestkitError::problem(&entry.file, e))?;
    let drafts = raw
        .cases
        .par_iter()
        .map(read_case)
        .collect::<Result<_, _>>()?;

    Ok(Group {
        name: raw.group,
        comment: raw.comment,
        drafts,
    })
}

/// The text of a group's file, which has to lie beside the index.
fn read_group_text(folder: &Path, file: &str) -> Result<String, ModelError> {
    let has_plain_letters = file
        .chars()
        .all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    if !has_plain_letters || file.starts_with('.') {
        return Err(ModelError::Unreadable {
            what: "a group",
            path: file.chars().take(80).collect(),
            problem: "expected a name beside the index".into(),
        });
    }

    read_text("a group", &folder.join(file))
}

/// Reads a case and compares its answer with that of the plain oracle.
fn read_case(raw: &RawCase) -> Result<Draft, TestkitError> {
    // Files beside the pack are not read: its problems are inlined.
    let problem = read_problem(&raw.problem.to_string(), Path::new("/nonexistent"));
    let problem = problem.map_err(|e| TestkitError::problem(&raw.id, e))?;

    let draft = Draft {
        id: raw.id.clone(),
        comment: raw.comment.clone(),
        flags: raw
            .flags
            .iter()
            .copied()
            .filter(|flag| flag.is_given())
            .collect(),
        problem,
        completeness: raw.completeness,
        listed: raw.completeness.map(|_| raw.answer.clone()),
        difficulty: raw.difficulty,
    };
    if draft.completeness.is_some() {
        return Ok(draft);
    }

    let case = Case::answer(&draft, false, &Watch::nobody())?;
    if case.answer_json() != raw.answer {
        return Err(TestkitError::Answer { case: draft.id });
    }

    Ok(draft)
}
